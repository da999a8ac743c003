//! Every slip of a small equation, by kind, and no other.

use super::*;
use crate::{parse, parse_equation};

/// The right sides that edits of one kind make of `y = text`; U and V are confused, x is missing.
fn of_kind(kind: &str, text: &str) -> Vec<String> {
    let e = parse_equation(&format!("y = {text}")).unwrap();
    let all = edits(&e, &Family::new(&["U V"], "x"));
    let all = all.into_iter().filter(|(edit, _)| edit.kind == kind);
    let all = all.inspect(|(_, new)| assert_eq!(new.left, e.left));
    all.map(|(_, new)| new.right.to_string()).collect()
}

fn check(kind: &str, cases: &[(&str, &[&str])]) {
    for (text, due) in cases {
        assert_eq!(of_kind(kind, text), *due, "{kind} in {text}");
    }
}

/// Of terms of sums, exponents, integrands, and of a sign inside a product.
#[test]
fn signs() {
    check(
        "sign",
        &[
            ("U", &["-U"]),
            ("-U", &["U"]),
            ("a*b", &["-a*b"]),
            ("a*(-b)", &["-a*(-b)", "a*b"]),
            ("a - b", &["-(a - b)", "-a - b", "a + b"]),
            ("exp(a)", &["-exp(a)", "exp(-a)"]),
            ("sin(a)", &["-sin(a)"]),
            ("sin(-a)", &["-sin(-a)", "sin(a)"]),
            ("a/b", &["-a/b"]),
            ("int(s, a, b, s)", &["-int(s, a, b, s)", "int(s, a, b, -s)"]),
            (
                "int(s, -a, b, s)",
                &["-int(s, -a, b, s)", "int(s, a, b, s)", "int(s, -a, b, -s)"],
            ),
            ("sum(n, 1, 3, n)", &["-sum(n, 1, 3, n)", "sum(n, 1, 3, -n)"]),
            ("a[-n]", &["-a[-n]"]),
        ],
    );
}

#[test]
fn missing_factors() {
    check(
        "missing i",
        &[
            ("a*b", &["i*a*b"]),
            ("-a", &["-i*a"]),
            ("a/exp(b)", &["i*(a/exp(b))", "a/exp(i*b)"]),
        ],
    );
    check(
        "missing factor",
        &[
            ("a", &["x*a", "x^2*a", "x^(-1)*a", "x^(-2)*a"]),
            (
                "-a*b",
                &["-x*a*b", "-x^2*a*b", "-x^(-1)*a*b", "-x^(-2)*a*b"],
            ),
        ],
    );
    check(
        "zero for a symbol",
        &[("0", &["x"]), ("a*0", &["a*x"]), ("1", &[])],
    );
}

#[test]
fn symbols_and_exponents() {
    check(
        "symbol or index",
        &[("U*a*V", &["V*a*V", "U*a*U"]), ("a", &[])],
    );
    check(
        "missing exponent",
        &[
            ("a*b", &["a^2*b", "a*b^2"]),
            ("a^3*b", &["a^3*b^2"]),
            ("2", &[]),
        ],
    );
    check(
        "exponent",
        &[
            ("a^2", &["a", "a^3"]),
            ("a^3", &["a", "a^2"]),
            ("a^(-1)", &["a", "a^2", "a^3"]),
            ("b*(a + 1)^4", &["b*(a + 1)", "b*(a + 1)^2", "b*(a + 1)^3"]),
        ],
    );
}

/// One digit for another, and two, three or four times too much or too little.
#[test]
fn numbers() {
    let digits: Vec<String> = (0..10)
        .filter(|d| *d != 7)
        .map(|d| format!("a + {d}"))
        .collect();
    assert_eq!(of_kind("digit", "a + 7"), digits);
    let found = of_kind("digit", "3.5");
    let due: Vec<String> = (0..10)
        .filter(|d| *d != 3)
        .map(|d| format!("{d}.5"))
        .collect();
    assert_eq!(found[..9], due);
    let due: Vec<String> = (0..10)
        .filter(|d| *d != 5)
        .map(|d| format!("3.{d}"))
        .collect();
    assert_eq!(found[9..], due);
    check(
        "constant",
        &[
            ("36*a", &["72*a", "108*a", "144*a", "18*a", "12*a", "9*a"]),
            // 20 and 40 are slips of a digit.
            ("10*a", &["5*a"]),
            ("35*a", &["70*a", "105*a", "140*a"]),
            ("3.5*a", &[]),
            ("a", &[]),
            // Twice is a number of 63 bits, three times is none.
            (
                "4611686018427387903*a",
                &["9223372036854775806*a", "1537228672809129301*a"],
            ),
            ("9223372036854775807*a", &[]),
            ("9223372036854775808*a", &[]),
        ],
    );
}

#[test]
fn what_is_superfluous() {
    check(
        "superfluous factor",
        &[
            ("a*b", &["b", "a"]),
            ("a*b*c", &["b*c", "a*c", "a*b"]),
            ("(a + b)*c + d", &["c + d", "(a + b) + d"]),
        ],
    );
    check(
        "superfluous term",
        &[
            ("a + b", &["b", "a"]),
            ("a - b + c", &["-b + c", "a + c", "a - b"]),
            ("a*b", &[]),
        ],
    );
    check(
        "superfluous divisor",
        &[("a/b", &["a"]), ("c + a/2", &["c + a"])],
    );
}

/// A number below stays below; the argument is that of one and the same number.
#[test]
fn quotients() {
    check(
        "inverted quotient",
        &[
            ("a/b", &["b/a"]),
            ("a/2", &[]),
            ("2/a", &["a/2"]),
            ("c*(a/(2*b))", &["c*(2*b/a)"]),
        ],
    );
    check(
        "quadrant",
        &[
            ("arctan(im(A)/re(A))", &["arg(A)"]),
            ("arctan(im(A)/re(B))", &[]),
            ("arctan(re(A)/im(A))", &[]),
        ],
    );
}

/// Neither the terms that a sum or series has nor an index is in question; what is added is.
#[test]
fn numbering_is_left_alone() {
    let family = Family::new(&["U V n"], "x");
    let all = |text: &str| edits(&parse_equation(text).unwrap(), &family);
    let found = all("y = sum(n, 1, U, 2*a[n])");
    assert!(found.len() > 10);
    for (edit, new) in &found {
        let text = new.right.to_string();
        assert!(
            text.contains("sum(n, 1, U, ") && edit.before != "U",
            "{text}"
        );
        assert!(
            text.contains("a[n]") || edit.kind == "superfluous factor",
            "{text}"
        );
    }
    assert!(
        found
            .iter()
            .any(|(_, new)| new.right.to_string() == "sum(n, 1, U, x*2*a[n])")
    );
    for (_, new) in all("y = b*a[U]") {
        let text = new.right.to_string();
        assert!(text.contains("a[U]") || !text.contains("a["), "{text}");
    }
}

/// A left side that is a mere name stays; another has the slips of a term too.
#[test]
fn left_sides() {
    let all = |text: &str| -> Vec<String> {
        let found = edits(&parse_equation(text).unwrap(), &Family::new(&["U V"], "x"));
        let left = found.iter().map(|(_, new)| new.left.to_string());
        left.filter(|l| !text.starts_with(&format!("{l} =")))
            .collect()
    };
    assert!(all("U = a").is_empty() && all("U[n] = a").is_empty());
    let due = [
        "-U*b",
        "i*U*b",
        "x*U*b",
        "x^2*U*b",
        "x^(-1)*U*b",
        "x^(-2)*U*b",
        "b",
        "U",
        "V*b",
        "U^2*b",
        "U*b^2",
    ];
    assert_eq!(all("U*b = a"), due);
}

/// Checks that an edit does as it says, and that its text is read as the same expression.
#[test]
fn edits_are_what_they_say() {
    for text in [
        "y = a",
        "y = -(a - U)*b^2/12 + exp(-i*x)",
        "y = int(s, U, 0, s*exp(-s^2))/sqrt(V)",
    ] {
        let e = parse_equation(text).unwrap();
        for (edit, new) in edits(&e, &Family::new(&["U V"], "x w")) {
            assert_eq!(parse_equation(&new.to_string()).unwrap(), new);
            assert!(parse(&edit.before).is_ok() && parse(&edit.after).is_ok());
            assert_ne!(edit.before, edit.after);
        }
    }
}
