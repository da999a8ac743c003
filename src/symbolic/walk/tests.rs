//! Definitions, indices and what is bound.

use super::*;
use crate::{Enclosures, Exact, ExpSum, Point};

fn value(definitions: &Definitions, text: &str) -> Result<ExpSum, SymbolicError> {
    Exact::default().value(definitions, &parse(text).unwrap())
}

fn same(definitions: &Definitions, text: &str, due: &str) {
    let found = value(definitions, text).unwrap();
    assert_eq!(
        found,
        value(&Definitions::default(), due).unwrap(),
        "{text}"
    );
}

/// `a0` is defined by `a1` and so on; the last is x.
fn chain(length: usize) -> Definitions {
    let mut out = Definitions::default();
    for k in 0..length {
        let next = match k + 1 == length {
            true => "x".to_string(),
            false => format!("a{} + 1", k + 1),
        };
        out.set(&format!("a{k}"), parse(&next).unwrap());
    }
    out
}

/// Forty within each other and no more; side by side as many as there are.
#[test]
fn how_deep_definitions_may_be() {
    same(&chain(40), "a0", "x + 39");
    let found = value(&chain(41), "a0").unwrap_err();
    assert_eq!(found.to_string(), "the definition of a40 does not end");
    let many = vec!["a0"; 100].join(" + ");
    same(&chain(1), &many, "100*x");
    same(
        &chain(40),
        "a0 + a0*a1 + a0",
        "2*(x + 39) + (x + 39)*(x + 38)",
    );
}

#[test]
fn circles_are_refused() {
    let circle = Definitions::read(&["a = b + 1", "b = 2*a"]).unwrap();
    let found = value(&circle, "a").unwrap_err();
    assert!(matches!(found, SymbolicError::Circular(_)), "{found}");
}

/// From the lower limit to the upper one, either of them negative; the index is free again behind.
#[test]
fn sums_over_an_index() {
    let none = Definitions::default();
    for (text, due) in [
        ("sum(k, -2, 1, k*x^2)", "-2*x^2"),
        ("sum(k, -3, -2, k)", "-5"),
        ("sum(k, 1 - 3, 2, k^2)", "10"),
        ("sum(k, 2, 1, k)", "0"),
        ("sum(k, 1, 3, k) + k", "6 + k"),
        ("sum(k, 1, 2, a[k]) + b[k]", "a_1 + a_2 + b_k"),
        ("sum(k, 1, 2, a[k + 1])", "a_2 + a_3"),
        ("sum(k, 1, 2, a[-k + 3])", "a_2 + a_1"),
        ("sum(k, 1, 2, k*sum(k, 3, 4, a[k]))", "3*(a_3 + a_4)"),
        ("sum(k, 1, 2, x^0)", "2"),
    ] {
        same(&none, text, due);
    }
    for (text, due) in [
        (
            "sum(k, 1, m, k)",
            "outside the algebra: the limits of a sum",
        ),
        ("a[2*k]", "outside the algebra: the index 2*k"),
        // The index is another name's value there.
        (
            "sum(k, 1, 3, let(k, 5, a[k]))",
            "outside the algebra: the index k",
        ),
        (
            "sum(k, 1/2, 2, k)",
            "outside the algebra: the limits of a sum",
        ),
    ] {
        assert_eq!(value(&none, text).unwrap_err().to_string(), due);
    }
}

/// A definition that depends on what is bound is not kept for where it is not, nor taken from
/// there.
#[test]
fn nothing_bound_is_kept() {
    let definitions = Definitions::read(&["c = x^2", "d = a[k]", "a_1 = x"]).unwrap();
    let named = ["x", "k", "a_k"].map(|n| (n.to_string(), Rational::from(5)));
    let point = Point {
        named: named.into(),
        sample: None,
    };
    for (text, due) in [
        ("at(c, x, 2) + c", 29),
        ("c + at(c, x, 2)", 29),
        ("c*sum(x, 1, 2, c)", 125),
        ("sum(k, 1, 1, d + x) + c", 35),
    ] {
        let e = parse(text).unwrap();
        let found = Enclosures::new(&point).value(&definitions, &e);
        let found = found.unwrap();
        assert!(found.re.contains(&Rational::from(due)), "{text}: {found:?}");
        assert!(found.im.contains_zero());
    }
}

/// Through names, images of derivations and children, circles or not.
#[test]
fn what_an_expression_reaches() {
    let lines = [
        "a = b + 1",
        "b = 2*a",
        "c = exp(z)",
        "t: v = w*c",
        "t: q = 1",
    ];
    let definitions = Definitions::read(&lines).unwrap();
    for (text, name, due) in [
        ("a", "a", true),
        ("a", "b", true),
        ("a", "z", false),
        ("x/sin(c)", "z", true),
        ("D(u, t)", "w", true),
        ("D(u, t)", "z", true),
        ("D(u, s)", "w", false),
        ("v", "w", false),
        ("int(s, 0, c, s)", "z", true),
        ("y", "x", false),
    ] {
        let e = parse(text).unwrap();
        assert_eq!(definitions.reaches(&e, &[name]), due, "{name} in {text}");
        assert_eq!(definitions.reaches(&e, &["no", name]), due);
    }
    assert!(!definitions.reaches(&parse("a").unwrap(), &[]));
}

#[test]
fn definitions_as_text() {
    let lines = [" a = b + 1", "t : v = 3*v", "t: w = v", "a = c"];
    let found = Definitions::read(&lines).unwrap();
    assert_eq!(found.names.len(), 1);
    assert_eq!(found.names["a"], parse("c").unwrap());
    let images = [("v", "3*v"), ("w", "v")].map(|(s, e)| (s.to_string(), parse(e).unwrap()));
    assert_eq!(found.derivations["t"], images);
    for (line, due) in [
        ("a + b", r#"at character 0: expected '=' in "a + b""#),
        ("a = b = c", "at character 3: unexpected '='"),
        ("a = ", "at character 1: expected an expression"),
    ] {
        let found = Definitions::read(&["x = y", line]).unwrap_err();
        assert_eq!(found.to_string(), due);
    }
}

/// Integers: without quotients, functions and symbols.
struct Integers;

fn none<T>(what: &str) -> Result<T, SymbolicError> {
    Err(SymbolicError::Unsupported(what.into()))
}

impl Domain for Integers {
    type V = Rational;
    fn constant(&mut self, c: &Gauss) -> Rational {
        c.re.clone()
    }
    fn symbol(&mut self, _: &str) -> Result<Rational, SymbolicError> {
        none("a symbol")
    }
    fn add(&mut self, a: &Rational, b: &Rational) -> Rational {
        Rational::from(a + b)
    }
    fn mul(&mut self, a: &Rational, b: &Rational) -> Rational {
        Rational::from(a * b)
    }
    fn div(&mut self, _: &Rational, _: &Rational) -> Result<Rational, SymbolicError> {
        none("a quotient")
    }
    fn call(&mut self, _: Func, _: &[Rational]) -> Result<Rational, SymbolicError> {
        none("a function")
    }
    fn integral(&mut self, _: &mut Scope<Rational>, _: &Bound) -> Result<Rational, SymbolicError> {
        none("an integral")
    }
    fn derivative(
        &mut self,
        _: &mut Scope<Rational>,
        _: &Expr,
        _: &str,
    ) -> Result<Rational, SymbolicError> {
        none("a derivative")
    }
}

/// Only a negative power asks for a quotient.
#[test]
fn powers_without_quotients() {
    let none = Definitions::default();
    let value = |text: &str| walk(&mut Integers, &mut Scope::new(&none), &parse(text).unwrap());
    for (text, due) in [
        ("3^0", 1),
        ("0^0", 1),
        ("3^2", 9),
        ("at(x^2 - x, x, 5)", 20),
    ] {
        assert_eq!(value(text).unwrap(), due, "{text}");
    }
    for text in ["3^(-1)", "1/2", "x"] {
        assert!(value(text).is_err(), "{text}");
    }
}
