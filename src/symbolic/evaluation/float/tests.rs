//! Tests of floating point: complex numbers, and functions rounded from their enclosures.

use super::{Elementary, FloatValue, Floating, Format};
use crate::evaluation::Evaluator;
use crate::graph::Graph;
use crate::{Definitions, parse};
use mechaudit_reference::elementary::NoValue;
use std::sync::Arc;

fn value(text: &str, meaning: Floating, x: f64, y: f64) -> Result<FloatValue, NoValue> {
    let mut graph = Graph::new(["x".to_string(), "y".to_string()]);
    let id = graph.build(&Definitions::default(), &parse(text).unwrap());
    let mut evaluator = Evaluator::new(Arc::new(graph), meaning);
    evaluator.set_input(0, x.into());
    evaluator.set_input(1, y.into());
    evaluator
        .value(id.unwrap())
        .copied()
        .map_err(|stop| stop.reason)
}

fn double(text: &str, x: f64, y: f64) -> [f64; 2] {
    let found = value(text, Floating::default(), x, y).unwrap();
    [found.re(), found.im()]
}

#[test]
fn complex_operations_are_those_of_their_parts() {
    let (x, y) = (0.1, -0.7);
    assert_eq!(double("x + i*y", x, y), [x, y]);
    assert_eq!(double("(x + i*y)^2", x, y), [x * x - y * y, x * y + y * x]);
    assert_eq!(double("2*(x + i*y) - 1", x, y), [2.0 * x - 1.0, 2.0 * y]);
    assert_eq!(double("1 - (x + i*y)", x, y), [1.0 - x, -y]);
    assert_eq!(double("(x + i*y)/3", x, y), [x / 3.0, y / 3.0]);
    assert_eq!(double("conj(x + i*y)", x, y), [x, -y]);
    assert_eq!(double("abs(x + i*y)", x, y), [x.hypot(y), 0.0]);
    assert_eq!(double("arg(x + i*y)", x, y), [y.atan2(x), 0.0]);
    let e = x.exp();
    assert_eq!(double("exp(x + i*y)", x, y), [e * y.cos(), e * y.sin()]);
    let cos = [x.cos() * y.cosh(), -x.sin() * y.sinh()];
    assert_eq!(double("cos(x + i*y)", x, y), cos);
    assert_eq!(double("re(x)", x, y), [x, 0.0]);
    assert_eq!(double("im(x)", x, y), [0.0, 0.0]);
}

/// The imaginary unit has no real part that could make an infinity or NaN of a product.
#[test]
fn a_part_that_is_missing_is_exactly_zero() {
    assert_eq!(double("i*x", f64::INFINITY, 0.0), [0.0, f64::INFINITY]);
    let product = double("i*(x + i*y)", 3.0, f64::INFINITY);
    assert_eq!(product, [f64::NEG_INFINITY, 3.0]);
    assert_eq!(double("i*i", 0.0, 0.0), [-1.0, 0.0]);
}

/// Smith's quotient forms no square of the modulus.
#[test]
fn quotients_do_not_overflow() {
    let big = 1e300;
    assert_eq!(double("1/(x + i*y)", big, big), [0.5 / big, -0.5 / big]);
    assert_eq!(double("1/(x + i*y)", 0.0, 2.0), [0.0, -0.5]);
    for (x, y) in [(0.3, 0.2), (0.2, -0.9), (-3.0, 1e-9)] {
        let [re, im] = double("(x + i*y)*(1/(x + i*y))", x, y);
        assert!((re - 1.0).abs() < 1e-15 && im.abs() < 1e-15, "{x} {y}");
    }
}

#[test]
fn roots_and_powers_of_complex_numbers() {
    for (x, y) in [
        (3.0, 4.0),
        (-3.0, 4.0),
        (-3.0, -4.0),
        (1e-200, 1e-200),
        (1e200, -1e200),
    ] {
        let [re, im] = double("sqrt(x + i*y)", x, y);
        assert!(re >= 0.0 && im.is_sign_negative() == (y < 0.0), "{x} {y}");
        let size = x.hypot(y);
        let (back_re, back_im) = (re * re - im * im - x, 2.0 * re * im - y);
        assert!(back_re.hypot(back_im) <= 1e-15 * size, "{x} {y}");
    }
    assert_eq!(double("(x + i*y)^3", 1.0, 1.0), [-2.0, 2.0]);
    assert_eq!(double("(x + i*y)^(-2)", 0.0, 2.0), [-0.25, 0.0]);
    assert_eq!(double("(x + i*y)^0", 5.0, 2.0), [1.0, 0.0]);
}

#[test]
fn single_precision_rounds_each_part() {
    let single = Floating {
        format: Format::Single,
        ..Floating::default()
    };
    let (x, y) = (0.1f32, 0.7f32);
    let found = value("(x + i*y)*(y + i*x)", single, x.into(), y.into()).unwrap();
    assert_eq!(found.re(), f64::from(x * y - y * x));
    assert_eq!(found.im(), f64::from(x * x + y * y));
}

#[test]
fn what_has_no_complex_value_is_refused() {
    for text in ["if(i < x, 1, 2)", "erf(i*x)", "atan2(i, x)", "W(x)"] {
        assert!(
            value(text, Floating::default(), 1.0, 1.0).is_err(),
            "{text}"
        );
    }
}

/// mpmath: erfcx, erfi, dawson and digamma.
#[test]
fn functions_without_a_library_are_rounded_from_enclosures() {
    let correct = Floating {
        elementary: Elementary::Correct,
        ..Floating::default()
    };
    for (text, due) in [
        ("erfcx(x)", 0.427_583_576_155_807),
        ("erfi(x)", 1.650_425_758_797_542_8),
        ("dawson(x)", 0.538_079_506_912_768_4),
        ("digamma(x)", -0.577_215_664_901_532_9),
    ] {
        let found = value(text, correct, 1.0, 0.0).unwrap();
        assert_eq!(found.real(), Some(due), "{text}");
        assert!(
            value(text, Floating::default(), 1.0, 0.0).is_err(),
            "{text}"
        );
    }
    assert!(value("erfcx(x)", correct, f64::NAN, 0.0).is_err());
}
