//! Expressions in LaTeX.

use super::expr::{Constant, EACH, Equation, Expr, Func, Relation, Roots};
use super::parse::parse;

const GREEK: [&str; 24] = [
    "alpha", "beta", "gamma", "delta", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu",
    "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "chi", "psi", "omega", "Theta", "Omega",
    "Psi",
];

/// Names whose LaTeX is not made of their parts.
const SPECIAL: [(&str, &str); 9] = [
    ("inf", r"\infty"),
    ("n_star", "n_*"),
    ("omega_star", r"\omega_*"),
    ("nabla_n", r"\nabla_n"),
    ("phi_dot", r"\dot{\varphi}"),
    ("phi_ddot", r"\ddot{\varphi}"),
    ("psi_dot", r"\dot{\psi}"),
    ("psi_ddot", r"\ddot{\psi}"),
    ("delta_star_n", r"\delta_n^*"),
];

fn base(name: &str) -> String {
    match name {
        "phi" => r"\varphi".into(),
        "eps" => r"\varepsilon".into(),
        n if GREEK.contains(&n) => format!(r"\{n}"),
        n if n.chars().count() == 1 => n.into(),
        n => format!(r"\mathrm{{{n}}}"),
    }
}

fn subscript(name: &str) -> String {
    match name {
        "im1" => "i-1".into(),
        "ip1" => "i+1".into(),
        "nm1" => "n-1".into(),
        "np1" => "n+1".into(),
        "star" => "*".into(),
        "kr" => "k".into(),
        n if n.chars().all(|c| c.is_ascii_digit()) || n.chars().count() == 1 => n.into(),
        "phi" | "eps" => base(name),
        n if GREEK.contains(&n) => base(n),
        // Two indices without a separator, as in V_{n0} and v_{S2}.
        n if n.len() == 2 => n.into(),
        n => format!(r"\mathrm{{{n}}}"),
    }
}

/// A symbol in LaTeX: `omega_3` is ω₃, `m_im1` is m with the index i−1.
fn symbol(name: &str) -> String {
    if let Some((_, tex)) = SPECIAL.iter().find(|s| s.0 == name) {
        return (*tex).into();
    }
    // Derivatives by φ: dI_n, dv_S2, domega_3.
    if let Some(rest) = name.strip_prefix('d')
        && ["I_", "v_", "omega_"].iter().any(|p| rest.starts_with(p))
    {
        return format!(r"\frac{{d{}}}{{d\varphi}}", symbol(rest));
    }
    let primes = name.chars().rev().take_while(|c| *c == '\'').count();
    let bare = &name[..name.len() - primes];
    let mut parts = bare.split('_');
    let mut out = base(parts.next().unwrap_or(bare));
    let indices: Vec<String> = parts.map(subscript).collect();
    if !indices.is_empty() {
        out.push_str(&format!("_{{{}}}", indices.join("")));
    }
    out.push_str(&"'".repeat(primes));
    out
}

fn bracketed(e: &Expr) -> String {
    format!(r"\left({}\right)", latex(e))
}

fn at_least(e: &Expr, strength: u8) -> String {
    match e.strength() >= strength {
        true => latex(e),
        false => bracketed(e),
    }
}

/// Returns true if a factor after it would be read as a part of it: integrals, sums, derivatives,
/// products that end so.
fn swallows(e: &Expr) -> bool {
    match e {
        Expr::Int(_) | Expr::Sum(_) => true,
        Expr::Diff(x, _) => !matches!(**x, Expr::Sym(_)),
        Expr::Mul(factors) => factors.last().is_some_and(swallows),
        _ => false,
    }
}

fn product(factors: &[Expr]) -> String {
    let mut out = String::new();
    for (k, x) in factors.iter().enumerate() {
        let text = match x {
            x if k + 1 < factors.len() && swallows(x) => bracketed(x),
            Expr::Div(..) => latex(x),
            x => at_least(x, 2),
        };
        if k > 0 {
            // Two numbers side by side would be one, or a mixed one.
            let after = match factors[k - 1] {
                Expr::Num(_) => text.trim_start_matches(r"\frac"),
                _ => &text,
            };
            let digit = (after.trim_start_matches('{')).starts_with(|c: char| c.is_ascii_digit());
            out.push_str(if digit { r" \cdot " } else { r"\, " });
        }
        out.push_str(&text);
    }
    out
}

/// The expression in LaTeX, without delimiters.
pub fn latex(e: &Expr) -> String {
    match e {
        Expr::Num(n) => n.clone(),
        Expr::Constant(c) => match c {
            Constant::E => "e".into(),
            c => parse(c.definition()).map_or_else(|_| String::new(), |e| latex(&e)),
        },
        Expr::I => "i".into(),
        Expr::Sym(s) => symbol(s),
        Expr::Index(s, k) => format!("{}_{{{}}}", symbol(s), latex(k)),
        Expr::Neg(x) => format!("-{}", at_least(x, 2)),
        Expr::Add(terms) => {
            let mut out = String::new();
            for (k, x) in terms.iter().enumerate() {
                match (k, x) {
                    (0, x) => out.push_str(&at_least(x, 1)),
                    (_, Expr::Neg(y)) => out.push_str(&format!(" - {}", at_least(y, 2))),
                    (_, x) => out.push_str(&format!(" + {}", at_least(x, 2))),
                }
            }
            out
        }
        Expr::Mul(factors) => product(factors),
        Expr::Div(a, b) => format!(r"\frac{{{}}}{{{}}}", latex(a), latex(b)),
        Expr::Pow(x, k) => match &**x {
            Expr::Call(Func::Sin | Func::Cos, _) => format!("{}^{{{k}}}", bracketed(x)),
            Expr::Num(_) | Expr::I | Expr::Sym(_) | Expr::Index(..) => {
                format!("{{{}}}^{{{k}}}", latex(x))
            }
            Expr::Call(Func::Sqrt | Func::Abs | Func::W, _) => {
                format!("{{{}}}^{{{k}}}", latex(x))
            }
            x => format!("{{{}}}^{{{k}}}", bracketed(x)),
        },
        Expr::Call(f, x) => call(*f, x),
        Expr::Root(b, which) => format!(
            r"\operatorname{{{}}}_{{{}\in[{},{}]}} {}",
            match which {
                Roots::Only => "root".to_string(),
                Roots::One { place, count } => format!("root {place} of {count}"),
                Roots::Number => "number of roots".to_string(),
            },
            symbol(&b.var),
            latex(&b.from),
            latex(&b.to),
            at_least(&b.body, 2)
        ),
        Expr::Truth(t) => format!(r"\text{{{t}}}"),
        Expr::Compare(relation, x) => {
            let sign = match relation {
                Relation::Less => "<",
                Relation::LessEqual => r"\le",
                Relation::Greater => ">",
                Relation::GreaterEqual => r"\ge",
                Relation::Equal => "=",
                Relation::NotEqual => r"\ne",
            };
            let parts: Vec<String> = x.iter().map(latex).collect();
            parts.join(&format!(" {sign} "))
        }
        Expr::And(x) | Expr::Or(x) => {
            let sign = if matches!(e, Expr::And(_)) {
                r" \land "
            } else {
                r" \lor "
            };
            let parts: Vec<String> = x.iter().map(bracketed).collect();
            parts.join(sign)
        }
        Expr::Not(x) => format!(r"\lnot {}", bracketed(x)),
        Expr::If(parts) => {
            let [condition, a, b] = parts.each_ref().map(latex);
            format!(r"\begin{{cases}} {a} & {condition} \\ {b} & \text{{otherwise}} \end{{cases}}")
        }
        Expr::Let(_, values, body) => {
            let values = values.iter();
            let values: Vec<String> = values
                .map(|(name, v)| format!("{} = {}", symbol(name), latex(v)))
                .collect();
            format!(
                r"{} \quad\text{{with}}\quad {}",
                latex(body),
                values.join(r",\; ")
            )
        }
        Expr::While(l) => format!(
            r"\text{{loop while }} {} \text{{: }} {}",
            latex(&l.condition),
            latex(&l.body)
        ),
        Expr::Int(b) => format!(
            r"\int_{{{}}}^{{{}}} {} \, d{}",
            latex(&b.from),
            latex(&b.to),
            at_least(&b.body, 2),
            symbol(&b.var)
        ),
        Expr::Sum(b) if b.to == Expr::Sym(EACH.into()) => {
            format!(r"\sum_{{{}}} {}", symbol(&b.var), at_least(&b.body, 2))
        }
        Expr::Sum(b) => format!(
            r"\sum_{{{}={}}}^{{{}}} {}",
            symbol(&b.var),
            latex(&b.from),
            latex(&b.to),
            at_least(&b.body, 2)
        ),
        Expr::Diff(x, by) => match &**x {
            Expr::Sym(s) => format!(r"\frac{{d{}}}{{d{}}}", symbol(s), symbol(by)),
            x => format!(r"\frac{{d}}{{d{}}}{}", symbol(by), at_least(x, 3)),
        },
        Expr::At(x, s, v) => format!(
            r"\left.{}\right|_{{{}={}}}",
            at_least(x, 2),
            symbol(s),
            latex(v)
        ),
    }
}

fn call(f: Func, arguments: &[Expr]) -> String {
    let [x] = arguments else {
        let parts: Vec<String> = arguments.iter().map(latex).collect();
        return match (f, arguments) {
            (Func::Pow, [x, y]) => format!("{{{}}}^{{{}}}", at_least(x, 4), latex(y)),
            _ => format!(
                r"\operatorname{{{}}}\left({}\right)",
                f.name(),
                parts.join(", ")
            ),
        };
    };
    match f {
        Func::Exp => format!("e^{{{}}}", latex(x)),
        Func::Sqrt => format!(r"\sqrt{{{}}}", latex(x)),
        Func::Abs => format!(r"\left|{}\right|", latex(x)),
        Func::W => format!(r"W{}", bracketed(x)),
        Func::Sin | Func::Cos | Func::Arg => format!(r"\{}{}", f.name(), argument(x)),
        Func::Arctan => format!(r"\arctan{}", argument(x)),
        Func::Re => format!(r"\operatorname{{Re}}{}", argument(x)),
        Func::Im => format!(r"\operatorname{{Im}}{}", argument(x)),
        Func::Conj => format!(r"\overline{{{}}}", latex(x)),
        Func::Log => format!(r"\ln{}", argument(x)),
        Func::Tan | Func::Sinh | Func::Cosh | Func::Tanh => {
            format!(r"\{}{}", f.name(), argument(x))
        }
        Func::Asin => format!(r"\arcsin{}", argument(x)),
        Func::Acos => format!(r"\arccos{}", argument(x)),
        Func::Cbrt => format!(r"\sqrt[3]{{{}}}", latex(x)),
        Func::Floor => format!(r"\lfloor {} \rfloor", latex(x)),
        Func::Ceil => format!(r"\lceil {} \rceil", latex(x)),
        Func::Tgamma => format!(r"\Gamma{}", bracketed(x)),
        f => format!(r"\operatorname{{{}}}{}", f.name(), argument(x)),
    }
}

/// Without brackets where none are needed.
fn argument(x: &Expr) -> String {
    match x {
        Expr::Sym(_) | Expr::Div(..) => format!(" {}", latex(x)),
        x => bracketed(x),
    }
}

/// The equation in LaTeX, without delimiters.
pub fn latex_equation(e: &Equation) -> String {
    format!("{} = {}", latex(&e.left), latex(&e.right))
}

#[cfg(test)]
mod tests {
    use super::super::{parse, parse_equation};
    use super::*;

    #[test]
    fn typeset() {
        for (text, tex) in [
            ("omega_star^2*f", r"{\omega_*}^{2}\, f"),
            (
                "-(a - b)/sqrt(n*eps)",
                r"-\frac{a - b}{\sqrt{n\, \varepsilon}}",
            ),
            ("2*3*m_im1", r"2 \cdot 3\, m_{i-1}"),
            ("exp(-i*Theta_n)", r"e^{-i\, \Theta_{n}}"),
            (
                "int(x, 0, t, a + x)",
                r"\int_{0}^{t} \left(a + x\right) \, dx",
            ),
            (
                "sum(n, 1, inf, a[n]*cos(n*x))",
                r"\sum_{n=1}^{\infty} a_{n}\, \cos\left(n\, x\right)",
            ),
            ("a - (b + c)", r"a - \left(b + c\right)"),
            ("re(A)^2", r"{\left(\operatorname{Re} A\right)}^{2}"),
            ("exp(x)^2", r"{\left(e^{x}\right)}^{2}"),
            ("sqrt(x)^2", r"{\sqrt{x}}^{2}"),
            (
                "at(a*t, t, 2)^2",
                r"{\left(\left.a\, t\right|_{t=2}\right)}^{2}",
            ),
            ("D(a^2, t)*b", r"\left(\frac{d}{dt}{a}^{2}\right)\, b"),
            ("2*10^3", r"2 \cdot {10}^{3}"),
            ("2*(1/3)", r"2 \cdot \frac{1}{3}"),
            ("2*(a/3)", r"2\, \frac{a}{3}"),
            (
                "(a*sum(n, 1, 2, n))*b",
                r"\left(a\, \sum_{n=1}^{2} n\right)\, b",
            ),
            ("v_S2'", "v_{S2}'"),
        ] {
            assert_eq!(latex(&parse(text).unwrap()), tex);
        }
        let e = parse_equation("y = arctan(im(A)/re(A))").unwrap();
        assert_eq!(
            latex_equation(&e),
            r"y = \arctan \frac{\operatorname{Im} A}{\operatorname{Re} A}"
        );
    }
}

#[cfg(test)]
mod formulas;
