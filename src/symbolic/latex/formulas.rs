//! LaTeX says the same formula: names, signs, brackets.

use super::*;
use crate::parse;

#[test]
fn names() {
    for (name, tex) in [
        ("a", "a"),
        ("erf", r"\mathrm{erf}"),
        ("phi", r"\varphi"),
        ("a_1", "a_{1}"),
        ("a_12", "a_{12}"),
        ("a_123", "a_{123}"),
        ("a_k", "a_{k}"),
        ("a_mu", r"a_{\mu}"),
        ("a_pi", r"a_{\pi}"),
        ("a_alpha", r"a_{\alpha}"),
        ("a_phi", r"a_{\varphi}"),
        ("a_max", r"a_{\mathrm{max}}"),
        ("a_m12", r"a_{\mathrm{m12}}"),
        ("V_n0", "V_{n0}"),
        ("v_S2", "v_{S2}"),
        ("m_ip1", "m_{i+1}"),
        ("mu_n_star", r"\mu_{n*}"),
        ("dI_n", r"\frac{dI_{n}}{d\varphi}"),
        ("dv_S2", r"\frac{dv_{S2}}{d\varphi}"),
        ("domega_3", r"\frac{d\omega_{3}}{d\varphi}"),
        ("d_n", "d_{n}"),
        ("dx", r"\mathrm{dx}"),
        ("omega''", r"\omega''"),
    ] {
        assert_eq!(symbol(name), tex, "{name}");
    }
}

#[test]
fn signs_and_brackets() {
    for (text, tex) in [
        ("a*(-b)", r"a\, \left(-b\right)"),
        ("(-b)*a", r"\left(-b\right)\, a"),
        ("a*(b + c)", r"a\, \left(b + c\right)"),
        ("a*(b*c)*d", r"a\, b\, c\, d"),
        ("-a + b", "-a + b"),
        ("(a + b) + c", r"\left(a + b\right) + c"),
        ("a + (-b)", "a - b"),
        ("a - (-b)", r"a - \left(-b\right)"),
        ("-(a + b)", r"-\left(a + b\right)"),
        ("(a + b)^2", r"{\left(a + b\right)}^{2}"),
        ("(-a)^2", r"{\left(-a\right)}^{2}"),
        ("(a/b)^2", r"{\left(\frac{a}{b}\right)}^{2}"),
        ("(a^2)^3", r"{\left({a}^{2}\right)}^{3}"),
        ("sin(x)^2", r"\left(\sin x\right)^{2}"),
        ("x^(-2)", "{x}^{-2}"),
        ("sin(-x)", r"\sin\left(-x\right)"),
        ("sin(x^2)", r"\sin\left({x}^{2}\right)"),
        ("D(a*b, t)", r"\frac{d}{dt}\left(a\, b\right)"),
        ("D(a^2, t)", r"\frac{d}{dt}{a}^{2}"),
        ("D(a, t)", r"\frac{da}{dt}"),
        ("at(a + b, x, 0)", r"\left.\left(a + b\right)\right|_{x=0}"),
        ("2*10*a", r"2 \cdot 10\, a"),
        ("abs(-x)", r"\left|-x\right|"),
    ] {
        assert_eq!(latex(&parse(text).unwrap()), tex, "{text}");
    }
}

/// An integral or a sum swallows what follows it, not what stands before.
#[test]
fn what_follows_a_sum() {
    let sum = r"\sum_{n=1}^{3} a_{n}";
    let integral = r"\int_{0}^{t} x \, dx";
    for (text, tex) in [
        ("b*sum(n, 1, 3, a[n])", format!(r"b\, {sum}")),
        ("sum(n, 1, 3, a[n])*b", format!(r"\left({sum}\right)\, b")),
        (
            "b*sum(n, 1, 3, a[n])*c*d",
            format!(r"b\, \left({sum}\right)\, c\, d"),
        ),
        ("2*int(x, 0, t, x)", format!(r"2\, {integral}")),
        ("int(x, 0, t, x)*y", format!(r"\left({integral}\right)\, y")),
    ] {
        assert_eq!(latex(&parse(text).unwrap()), tex, "{text}");
    }
}
