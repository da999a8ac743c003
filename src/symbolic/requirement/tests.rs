//! Requirements that are decided at a point, over domains and over boxes.

use super::boxes::{Function, Region};
use super::*;
use crate::parse;

/// Neither sign of √2·√2 − 2 can be told in balls.
const OPEN: &str = "sqrt(2)*sqrt(2) < 2";

#[test]
fn numbers_are_compared_within_bounds() {
    let decided = |text: &str| {
        let found = Requirement::parse(text)
            .unwrap()
            .decide(&Definitions::default(), &BTreeMap::new());
        (found.outcome, found.witness.map(|w| w.residual))
    };
    let (yes, no) = (Outcome::Proved, Outcome::Refuted);
    for (text, due, residual) in [
        ("1 < 2", yes, None),
        ("2 < 1", no, Some("1.00000")),
        ("1 < 1", no, Some("0")),
        ("1 ~ 1.25 within 0.5", yes, None),
        ("1 ~ 1.5 within 0.5", yes, None),
        ("1.5 ~ 1 within 0.5", yes, None),
        ("1 ~ 1.625 within 0.5", no, Some("-0.625000")),
        ("1.625 ~ 1 within 0.5", no, Some("0.625000")),
        (OPEN, Outcome::Undecided, None),
        // One point proves nothing of a symbol, and complex numbers have no order.
        ("x < 200", Outcome::Undecided, None),
        ("x ~ 1 within 100", Outcome::Undecided, None),
        ("i < 2", Outcome::Undecided, None),
        ("1 + i ~ 1 within 0.5", no, Some("0")),
    ] {
        assert_eq!(decided(text), (due, residual.map(String::from)), "{text}");
    }
    assert!(Requirement::parse("1 ~ 2").is_err());
    for text in ["a ~ b within c", "a < b", "a = b"] {
        assert_eq!(Requirement::parse(text).unwrap().to_string(), text);
    }
}

/// √x² is |x|, which a symbol of either sign is in a part of its domain alone.
#[test]
fn a_domain_has_its_negative_part() {
    let root = Requirement::parse("sqrt(x^2) = x").unwrap();
    let decided = |[from, to]: [i32; 2]| {
        let domain = Domain::Between(Rational::from(from), Rational::from(to));
        let conditions = Conditions {
            domains: [("x".to_string(), domain)].into(),
            ..Conditions::default()
        };
        conditions.decide(&root, &Definitions::default())
    };
    assert_eq!(decided([1, 2]).outcome, Outcome::Proved);
    for range in [[-2, -1], [-1, 1]] {
        let found = decided(range);
        assert_eq!(found.outcome, Outcome::Refuted);
        assert!(found.witness.unwrap().point[0].1.starts_with('-'));
    }
}

fn over(text: &str, names: &[&str], ends: &[Rational; 2]) -> Function {
    let region = names.iter().map(|n| (n.to_string(), ends.clone()));
    let region: Region = region.collect();
    let none = Definitions::default();
    Function::new(&none, &parse(text).unwrap(), &region).unwrap()
}

/// A cubic with its extremes inside, and a product of two variables at a corner; by hand.
#[test]
fn the_largest_value_over_a_box_is_enclosed() {
    let unit = [0, 1].map(Rational::from);
    for (text, names, [above, below]) in [
        ("x*(1 - x)", &["x"][..], [1, 4]),
        ("x - x^3/3", &["x"], [2, 3]),
        ("2*x*y - x", &["x", "y"], [1, 1]),
    ] {
        let due = Rational::from((above, below));
        let found = over(text, names, &unit).largest(1e-3).unwrap();
        assert!(
            found.contains(&due) && found.rad().to_f64() <= 1e-3,
            "{text}"
        );
    }
    // Beyond binary64.
    let far = [Rational::new(), Rational::from(1) << 1100u32];
    let found = over("x", &["x"], &far).largest(1e300).unwrap();
    assert!(found.contains(&far[1]));
}

#[test]
fn a_function_is_positive_over_a_whole_box() {
    let unit = [0, 1].map(Rational::from);
    // Negative next to 1/2 alone.
    let dip = over("0.24999 - x*(1 - x)", &["x"], &unit);
    assert!(!dip.is_positive() && over("x + 1", &["x"], &unit).is_positive());
}
