//! Texts of expressions: what is written, and what it is read as.

use crate::{Expr, Func, parse, parse_equation};

fn sym(name: &str) -> Box<Expr> {
    Box::new(Expr::Sym(name.into()))
}

/// No bracket too many and none too few.
#[test]
fn texts_are_their_own_form() {
    for text in [
        "x^0",
        "x^1",
        "x^(-1)",
        "x^(-12)",
        "(x^2)^3",
        "(-x)^2",
        "(a + b)^2",
        "(a*b)^2",
        "(a/b)^2",
        "a/b^2",
        "a/(b*c)",
        "a/(b/c)",
        "a/(-b)",
        "a/b/c",
        "a/b*c",
        "a*(b/c)",
        "a*(-b)",
        "a*(b*c)",
        "-a + b",
        "-(-a)",
        "-(a + b)",
        "-a*b",
        "-a^2",
        "a + (b + c)",
        "a + (b - c)",
        "(a + b) + c",
        "a - (b + c)",
        "a - (-b)",
        "(a + b)*(c - d)",
        "a[n + 1]^2",
        "exp(-x)^2",
        "series(n, a[n]*x)",
        "sum(n, 1, inf, a[n]*x)",
        "int(x, 0, 1, x + 1)*y",
        "D(x + y, x)",
        "at(x + y, x, -1)",
    ] {
        assert_eq!(parse(text).unwrap().to_string(), text);
    }
}

/// The same texts can be of other expressions, so here are the expressions themselves.
#[test]
fn exponents_have_their_sign() {
    for (text, k) in [
        ("x^2", 2),
        ("x ^ 2", 2),
        ("x^(2)", 2),
        ("x^(-2)", -2),
        ("x^( - 2 )", -2),
        ("x^0", 0),
        ("x^1000", 1000),
        ("x^(-1000)", -1000),
    ] {
        assert_eq!(parse(text).unwrap(), Expr::Pow(sym("x"), k), "{text}");
    }
    for text in ["x^1001", "x^(-1001)", "x^2.5", "x^y"] {
        let found = parse(text).unwrap();
        assert!(matches!(found, Expr::Call(Func::Pow, _)), "{text}");
    }
    assert_eq!(parse("x^-2").unwrap(), Expr::Pow(sym("x"), -2));
    assert!(parse("x^(2").is_err());
}

/// A minus stands for the whole product behind it, a quotient for what is on its left.
#[test]
fn signs_and_quotients_bind() {
    let negative = |e: Expr| Expr::Neg(Box::new(e));
    let [a, b, c] = ["a", "b", "c"].map(|n| *sym(n));
    let product = Expr::Mul(vec![a.clone(), b.clone()]);
    let below = Expr::Div(Box::new(product.clone()), sym("c"));
    assert_eq!(parse("-a*b").unwrap(), negative(product));
    assert_eq!(parse("a*b/c").unwrap(), below);
    assert_eq!(
        parse("a - b*c").unwrap(),
        Expr::Add(vec![a, negative(Expr::Mul(vec![b, c]))])
    );
}

fn nested(brackets: usize) -> String {
    format!("{}x{}", "(".repeat(brackets), ")".repeat(brackets))
}

/// 100 levels with the outermost; what is closed counts no more.
#[test]
fn how_deep_brackets_may_be() {
    assert_eq!(parse(&nested(99)).unwrap(), *sym("x"));
    let found = parse(&nested(100)).unwrap_err().to_string();
    assert_eq!(found, "at character 100: too many brackets");
    // Limits do not add to the depth of what is integrated, nor one side of an equation to the
    // other's.
    let integrals = (0..90).fold("x".to_string(), |e, _| format!("int(s, 0, 1, {e})"));
    assert!(parse(&integrals).is_ok());
    assert!(parse_equation(&format!("{0} = {0}", nested(99))).is_ok());
    let quotients = |k: usize| format!("a{}", "/b".repeat(k));
    assert!(parse(&quotients(99)).is_ok());
    let found = parse(&quotients(100)).unwrap_err().to_string();
    assert_eq!(found, "at character 200: too many quotients");
    for part in ["(x)", "x/y", &nested(98), "exp(x)/(y/z)"] {
        let sum = vec![part; 250].join(" + ");
        assert!(parse(&sum).is_ok(), "{part}");
    }
}

#[test]
fn strengths_in_their_order() {
    for (text, due) in [
        ("a + b", 0),
        ("-a", 1),
        ("a*b", 2),
        ("a/b", 2),
        ("a^2", 3),
        ("a", 4),
        ("exp(a + b)", 4),
    ] {
        assert_eq!(parse(text).unwrap().strength(), due, "{text}");
    }
}
