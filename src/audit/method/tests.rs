use super::*;
use crate::SolverAnswer;
use crate::planted::{Planted, output};
use crate::{HARD_HEADER, Limit};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A method of the required functions alone: `x² + 3y`, and `x / 3`.
struct Bare;

impl Method for Bare {
    fn name(&self) -> &'static str {
        "bare"
    }
    fn summary(&self) -> &'static str {
        ""
    }
    fn source(&self) -> &'static str {
        ""
    }
    fn inputs(&self) -> Vec<Input> {
        Vec::new()
    }
    fn outputs(&self) -> Vec<Output> {
        Vec::new()
    }
    fn domain(&self) -> Domain {
        Domain::default()
    }
    fn solve(&self, _: &[f64]) -> SolverAnswer {
        SolverAnswer::Declines(None)
    }
    fn reference(&self, x: &[Rational], bits: u32) -> ReferenceAnswer {
        let first = Rational::from(&x[0] * &x[0]) + Rational::from(&x[1] * 3);
        ReferenceAnswer::exact([&first, &(x[0].clone() / 3)], bits)
    }
}

#[test]
fn what_a_method_has_by_itself() {
    assert!(Bare.rows().is_none() && Bare.norm_budget().is_none());
    assert!(Bare.proved().is_empty() && Bare.laws().is_empty() && Bare.hard().is_empty());
    assert_eq!(Bare.sampling(), Sampling::Domain);
    assert_eq!(Bare.format(), Format::Double);
    assert!(Bare.signs_of_zero(&[0.0, 0.0]).is_empty());
    assert!(Bare.twin(&[1.0, 1.0]).is_none() && Bare.branch(&[1.0, 1.0]).is_none());
    assert!(Bare.is_data(0) && Bare.is_data(7) && Bare.admits(&[f64::MAX]));
    let refused = Bare.reference_not_finite(&[f64::NAN]);
    assert!(matches!(refused, ReferenceAnswer::Refuses("not finite")));
}

/// `2x² + 3|y|` and `|x|/3`, the square by a step of 2^-80 of x, each rounded up.
#[test]
fn conditions_are_sums_over_the_inputs() {
    let reference = Bare.reference(&[Rational::from(1), Rational::from(1)], 64);
    for (x, y) in [(1.0, 7.0), (-3.0, 2.0), (2.0, -1.0)] {
        let found = Bare.conditions(&[x, y]).unwrap();
        assert_eq!(Bare.conditions_beside(&[x, y], &reference).unwrap(), found);
        let expected = 2.0 * x * x + 3.0 * f64::abs(y);
        assert!(
            (expected..expected + 2f64.powi(-46)).contains(&found[0]),
            "{found:?} {expected}"
        );
        let third = Rational::from_f64(f64::abs(x)).unwrap() / 3;
        assert!(
            found[1] >= third && found[1].next_down() < third,
            "{found:?}"
        );
    }
    // A zero has no relative change.
    assert_eq!(Bare.conditions(&[0.0, 0.0]), Some(vec![0.0, 0.0]));
    let found = Bare.conditions(&[0.0, 5.0]).unwrap();
    assert!((15.0..15.0 + 1e-12).contains(&found[0]) && found[1] == 0.0);
    assert_eq!(Bare.conditions(&[1.0, f64::INFINITY]), None);
}

/// Only data that is not zero is moved, each number once.
#[test]
fn counts_and_zeros_are_left_alone() {
    let calls = AtomicUsize::new(0);
    let method = Planted {
        reference: Box::new(|x, bits| {
            calls.fetch_add(1, Ordering::Relaxed);
            assert_eq!(bits, 320);
            assert_eq!((&x[1], &x[2]), (&Rational::from(5), &Rational::new()));
            ReferenceAnswer::exact([&x[0], &x[3]], bits)
        }),
        ..Planted::default()
    };
    let found = conditions_by_differences(&method, &[1.0, 5.0, 0.0, 2.0], |j| j != 1);
    assert_eq!(found, Some(vec![1.0, 2.0]));
    assert_eq!(calls.load(Ordering::Relaxed), 3);
}

/// A reference that gives no values, or others beside the input, has no condition numbers.
#[test]
fn without_values_beside_there_are_no_conditions() {
    let at = |here: usize, beside: usize| {
        let method = Planted {
            reference: Box::new(move |x, bits| {
                let n = if x[0] == 1 { here } else { beside };
                match n {
                    0 => ReferenceAnswer::Undecided("planted".into()),
                    n => ReferenceAnswer::exact(vec![&x[0]; n], bits),
                }
            }),
            ..Planted::default()
        };
        conditions_by_differences(&method, &[1.0], |_| true)
    };
    assert_eq!(at(2, 2), Some(vec![1.0, 1.0]));
    for (here, beside) in [(0, 2), (2, 0), (2, 1), (1, 2)] {
        assert_eq!(at(here, beside), None, "{here} {beside}");
    }
}

/// At an end of the domain the differences are taken towards the inside.
#[test]
fn ends_of_the_domain_have_conditions() {
    for inside in [std::cmp::Ordering::Greater, std::cmp::Ordering::Less] {
        let method = Planted {
            reference: Box::new(move |x, bits| match x[0].cmp(&Rational::from(3)) {
                std::cmp::Ordering::Equal => ReferenceAnswer::exact([&x[0]], bits),
                side if side == inside => ReferenceAnswer::exact([&x[0]], bits),
                _ => ReferenceAnswer::Refuses("outside"),
            }),
            ..Planted::default()
        };
        let found = conditions_by_differences(&method, &[3.0], |_| true);
        assert_eq!(found, Some(vec![3.0]), "{inside:?}");
    }
}

/// Hard cases of a method name its outputs and lie in its domain.
#[test]
fn hard_cases_are_those_of_their_method() {
    let method = Planted {
        outputs: vec![output("x", Limit::Ulps(4.0)), output("y", Limit::Ulps(4.0))],
        admits: Box::new(|x| x[0] < 2.0),
        ..Planted::default()
    };
    let read = |line: &str| {
        let text = format!("{HARD_HEADER}\n0.5,x,planted,0x1p0\n{line}\n");
        HardCase::read_of(&method, &text)
    };
    let good = read("0,y,planted,0x1.8p0").unwrap();
    let each: Vec<_> = good
        .iter()
        .map(|h| (h.share, h.output.as_str(), h.input[0]))
        .collect();
    assert_eq!(each, [(0.5, "x", 1.0), (0.0, "y", 1.5)]);
    let e = read("0.5,z,planted,0x1p0").unwrap_err();
    assert!(
        e.line == 3 && matches!(e.fault, HardCaseFault::NoSuch(_)),
        "{e}"
    );
    let e = read("0.5,y,planted,0x1p1").unwrap_err();
    let outside = matches!(e.fault, HardCaseFault::OutsideDomain("planted"));
    assert!(e.line == 3 && outside, "{e}");
}

/// A difference is rounded to 64 bits, and then up to a number of `f64`.
#[test]
fn differences_have_64_bits() {
    let at = |bit: u32| {
        let d = Rational::from(1) + (Rational::from(1) >> bit);
        let method = Planted {
            reference: Box::new(move |x, bits| match x[0] == 1 {
                true => ReferenceAnswer::exact([&Rational::new()], bits),
                false => ReferenceAnswer::exact([&d], bits),
            }),
            ..Planted::default()
        };
        conditions_by_differences(&method, &[1.0], |_| true).unwrap()[0] / 2f64.powi(80)
    };
    assert_eq!((at(64), at(63)), (1.0, 1f64.next_up()));
}

#[test]
fn a_residual_that_is_no_number_is_the_largest() {
    assert_eq!(largest([]), 0.0);
    assert_eq!(largest([0.5, 2.0, 1.0]), 2.0);
    for all in [
        [f64::NAN, 1.0, 2.0],
        [1.0, f64::NAN, 2.0],
        [1.0, 2.0, f64::NAN],
    ] {
        assert!(largest(all).is_nan(), "{all:?}");
    }
}
