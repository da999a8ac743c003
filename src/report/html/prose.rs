//! Prose and formulas as HTML.

use maud::{Markup, PreEscaped, html};
#[cfg(feature = "report")]
use pulldown_latex::config::DisplayMode;
#[cfg(feature = "report")]
use pulldown_latex::{Parser, RenderConfig, Storage, push_mathml};

#[cfg(feature = "report")]
/// MathML of a formula in LaTeX; its text if it cannot be typeset.
pub fn math(latex: &str, text: &str, display: DisplayMode) -> Markup {
    let storage = Storage::new();
    let parsed: Result<Vec<_>, _> = Parser::new(latex, &storage).collect();
    let mut out = String::new();
    let config = RenderConfig {
        display_mode: display,
        ..RenderConfig::default()
    };
    let written = !latex.is_empty()
        && parsed.is_ok()
        && push_mathml(&mut out, Parser::new(latex, &storage), config).is_ok();
    match written {
        true => PreEscaped(out),
        false => html! { code { (text) } },
    }
}

#[cfg(feature = "report")]
/// Longer expressions stay text, which wraps.
const LONGEST: usize = 90;

#[cfg(feature = "report")]
/// An expression of the ledger's own language, typeset.
pub fn expression(text: &str) -> Markup {
    let short = text.chars().count() <= LONGEST;
    let read = short.then(|| crate::symbolic::parse(text).ok());
    let latex = read.flatten().map(|e| crate::symbolic::latex(&e));
    math(&latex.unwrap_or_default(), text, DisplayMode::Inline)
}

/// Names that stand for a Greek letter when they have an index.
const GREEK: [(&str, &str); 9] = [
    ("phi", "φ"),
    ("omega", "ω"),
    ("eps", "ε"),
    ("epsilon", "ε"),
    ("eta", "η"),
    ("psi", "ψ"),
    ("theta", "θ"),
    ("lambda", "λ"),
    ("dphi", "dφ"),
];

/// Prose: `code` between backticks, indices after `_` and powers after `^` as such.
pub fn prose(text: &str) -> Markup {
    html! {
        @for (k, part) in text.split('`').enumerate() {
            @if k % 2 == 0 { (PreEscaped(raised(part))) } @else { code { (part) } }
        }
    }
}

/// Returns true if `_` after this begins an index: a symbol, not a word with underscores.
fn is_symbol(base: &str) -> bool {
    let letters = base.trim_start_matches(['d', 'D']);
    let greek = GREEK.iter().any(|(name, _)| *name == base);
    greek || (!base.is_empty() && letters.chars().count() <= 1)
}

fn raised(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let mut out = String::new();
    let mut word = String::new();
    let mut i = 0;
    while i < chars.len() {
        let c = chars[i];
        let sign = match c {
            '_' if is_symbol(&word) => Some("sub"),
            '^' if i > 0 => Some("sup"),
            _ => None,
        };
        if let Some((tag, (inner, next))) = sign.zip(group(&chars, i + 1)) {
            let greek = GREEK.iter().find(|(name, _)| *name == word);
            if let (Some((name, letter)), "sub") = (greek, tag) {
                out.truncate(out.len() - name.len());
                out.push_str(letter);
            }
            let named = GREEK.iter().find(|(name, _)| *name == inner);
            let inner = named.map_or_else(|| raised(&inner), |(_, letter)| letter.to_string());
            out.push_str(&format!("<{tag}>{inner}</{tag}>"));
            word.clear();
            i = next;
            continue;
        }
        match c {
            // A name with several parts is none of a symbol.
            '_' => word.push_str("__"),
            '∇' => word.push(c),
            '\'' => {}
            _ if c.is_alphabetic() => word.push(c),
            _ => word.clear(),
        }
        out.push_str(&html! { (c) }.into_string());
        i += 1;
    }
    out
}

/// An index or exponent from there, and where it ends.
fn group(chars: &[char], from: usize) -> Option<(String, usize)> {
    let close = match chars.get(from)? {
        '{' => '}',
        '(' => ')',
        '*' => return Some(("*".into(), from + 1)),
        _ => {
            let sign = usize::from(matches!(chars[from], '-' | '−' | '+'));
            let run = chars[from + sign..].iter();
            // Not ², which is no part of an index.
            let part = |c: &&char| c.is_ascii_alphanumeric() || c.is_alphabetic();
            let n = run.take_while(part).count();
            let end = from + sign + n;
            let word = chars.get(end) == Some(&'_');
            let text: String = chars[from..end].iter().collect();
            return (n > 0 && !word).then_some((text, end));
        }
    };
    let open = chars[from];
    let mut depth = 0;
    for (k, c) in chars.iter().enumerate().skip(from) {
        depth += i32::from(*c == open) - i32::from(*c == close);
        if depth == 0 {
            return Some((chars[from + 1..k].iter().collect(), k + 1));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prose_has_indices_powers_and_code() {
        for (text, due) in [
            ("dI_n/dφ < 1", "dI<sub>n</sub>/dφ &lt; 1"),
            ("S'_In, l_S2", "S'<sub>In</sub>, l<sub>S2</sub>"),
            ("e^(-iω₃(t-τ)).", "e<sup>-iω₃(t-τ)</sup>."),
            ("m_{i+1} and ω_*/Ω", "m<sub>i+1</sub> and ω<sub>*</sub>/Ω"),
            (
                "omega_1, eps_1 in cm/s^2",
                "ω<sub>1</sub>, ε<sub>1</sub> in cm/s<sup>2</sup>",
            ),
            ("1/ω_1²", "1/ω<sub>1</sub>²"),
            ("2^-100", "2<sup>-100</sup>"),
            (
                "`cargo run_up a_b` & more",
                "<code>cargo run_up a_b</code> &amp; more",
            ),
            ("S1_dI_n, run_up, x_", "S1_dI_n, run_up, x_"),
            ("e^(2", "e^(2"),
        ] {
            assert_eq!(prose(text).into_string(), due);
        }
    }

    #[test]
    fn an_index_belongs_to_a_symbol() {
        for (text, due) in [
            // One letter, which differentials may stand before, or the name of a Greek one.
            ("DI_n", "DI<sub>n</sub>"),
            ("d_n", "d<sub>n</sub>"),
            ("ab_n", "ab_n"),
            ("_n", "_n"),
            ("phi_1 and phi", "φ<sub>1</sub> and phi"),
            ("dphi_1", "dφ<sub>1</sub>"),
            ("C_phi", "C<sub>φ</sub>"),
            ("2 phi_1", "2 φ<sub>1</sub>"),
            ("∇_x", "∇<sub>x</sub>"),
            ("∇f_x", "∇f_x"),
            ("x_1_2", "x_1_2"),
            ("x_1 y_2", "x<sub>1</sub> y<sub>2</sub>"),
            ("a_b_c x_1", "a_b_c x<sub>1</sub>"),
            (
                "x_-1, x_−1, x_+1",
                "x<sub>-1</sub>, x<sub>−1</sub>, x<sub>+1</sub>",
            ),
            ("x_-", "x_-"),
            ("x_,", "x_,"),
            ("x_(a(b)c)d", "x<sub>a(b)c</sub>d"),
            ("x_{a", "x_{a"),
            ("x_*_1", "x<sub>*</sub>_1"),
        ] {
            assert_eq!(prose(text).into_string(), due, "{text}");
        }
    }

    #[test]
    fn a_power_belongs_to_whatever_stands_before_it() {
        for (text, due) in [
            ("x^2", "x<sup>2</sup>"),
            ("(a b)^2 c", "(a b)<sup>2</sup> c"),
            ("word^n", "word<sup>n</sup>"),
            ("^2", "^2"),
            ("x^", "x^"),
            ("x^{a+b}!", "x<sup>a+b</sup>!"),
            ("e^(x_1)", "e<sup>x<sub>1</sub></sup>"),
            ("phi^2", "phi<sup>2</sup>"),
            ("x^2_1", "x^2_1"),
            ("a^b·c", "a<sup>b</sup>·c"),
        ] {
            assert_eq!(prose(text).into_string(), due, "{text}");
        }
    }

    #[test]
    fn what_cannot_be_typeset_stays_text() {
        let sum = |first: &str| format!("{first}{}", "+a".repeat(44));
        let (longest, longer) = (sum("aa"), sum("aaa"));
        assert_eq!((longest.len(), longer.len()), (90, 91));
        let typeset = |text: &str| expression(text).into_string();
        assert!(typeset(&longest).starts_with("<math"));
        assert_eq!(typeset(&longer), format!("<code>{longer}</code>"));
        assert_eq!(typeset("a + ("), "<code>a + (</code>");
        let math = |latex: &str| math(latex, "a < b", DisplayMode::Inline).into_string();
        assert_eq!(math(""), "<code>a &lt; b</code>");
        assert_eq!(math(r"\frac{a"), "<code>a &lt; b</code>");
        assert!(math("a < b").starts_with("<math"));
    }
}
