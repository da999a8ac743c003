//! Inputs that are none, harmonics in their order, laws of a series.

use super::*;
use crate::audit::SolverAnswer;
use crate::methods::find;
use std::f64::consts::{FRAC_PI_2, PI};

const CYCLE: CamCycleInput = CamCycleInput {
    lift: 2.0,
    start: 0.0,
    rise: 0.25,
    high_dwell: 0.25,
    fall: 0.25,
    first: 1.0,
    stride: 1.0,
};
/// A polynomial with one coefficient: s = x.
const LINE: [f64; 4] = [input::POLYNOMIAL, 0.5, 1.0, 1.0];

fn numbers(cycle: CamCycleInput, rise: &[f64], fall: &[f64]) -> Vec<f64> {
    [&cycle.to_vec()[..], rise, fall].concat()
}

fn changed(change: fn(&mut CamCycleInput)) -> Vec<f64> {
    let mut cycle = CYCLE;
    change(&mut cycle);
    numbers(cycle, &LINE, &LINE)
}

#[test]
fn what_is_no_cycle_is_refused_by_its_name() {
    let method = find("cam-fourier-series").unwrap();
    let good = numbers(CYCLE, &LINE, &LINE);
    assert!(method.admits(&good) && matches!(method.solve(&good), SolverAnswer::Values(_)));
    let no_law = [5.0, 0.5, 0.0];
    // Parts of a half and of three quarters.
    let too_much = [input::SCCA, 0.5, 2.0, 0.5, 0.75];
    for (input, due, admitted) in [
        (numbers(CYCLE, &no_law, &LINE), "bad layout", false),
        (numbers(CYCLE, &LINE, &no_law), "bad layout", false),
        (numbers(CYCLE, &too_much, &LINE), "law", true),
        (numbers(CYCLE, &LINE, &too_much), "law", true),
        (changed(|c| c.rise = -0.25), "cycle", true),
        (changed(|c| c.rise = 0.75), "cycle", true),
        (changed(|c| c.start = f64::INFINITY), "cycle", true),
        (changed(|c| c.first = 0.0), "harmonic", true),
        (changed(|c| c.first = 999_994.0), "harmonic", true),
    ] {
        assert_eq!(
            method.solve(&input),
            SolverAnswer::Refuses(due),
            "{input:?}"
        );
        assert_eq!(method.admits(&input), admitted, "{input:?}");
    }
    for input in [changed(|c| c.first = 1.5), changed(|c| c.stride = 0.5)] {
        assert!(!method.admits(&input), "{input:?}");
    }
    let last = changed(|c| c.first = 999_993.0);
    assert!(matches!(method.solve(&last), SolverAnswer::Values(_)));
}

/// 1 − 0.3 − 0.3 − 0.4 is −2^-54 in f64.
#[test]
fn a_cycle_may_fill_the_turn() {
    let full = changed(|c| (c.rise, c.high_dwell, c.fall) = (0.3, 0.3, 0.4));
    let method = find("cam-fourier-series").unwrap();
    assert!(matches!(method.solve(&full), SolverAnswer::Values(_)));
}

/// From the twentieth harmonic on they are taken in steps of up to seven.
#[test]
fn the_first_nineteen_harmonics_are_followed_by_their_neighbours() {
    let drawn = (0..4000).map(|k| {
        let mut d = Draw::new(1, "cam-fourier-series", "any", k);
        let cycle = any_cycle(&mut d, input::any_symmetric).cycle;
        (cycle.first, cycle.stride)
    });
    let (few, many): (Vec<_>, Vec<_>) = drawn.partition(|c| c.0 < 20.0);
    assert!(few.iter().all(|c| c.1 == 1.0) && few.iter().any(|c| c.0 == 19.0));
    assert!(many.iter().all(|c| (1.0..=7.0).contains(&c.1)));
    assert!(many.iter().any(|c| c.0 == 20.0 && c.1 > 1.0));
}

#[test]
fn the_reference_refuses_the_same_harmonics() {
    let word = |input: &[f64]| {
        let exact = exact(input).unwrap();
        let answer = CamFourierSeries::reference(CamFourierSeries::unpack(&exact).unwrap(), 96);
        answer.err().map(|e| e.to_string())
    };
    assert_eq!(word(&changed(|_| ())), None);
    assert_eq!(word(&changed(|c| c.first = 999_993.0)), None);
    for bad in [changed(|c| c.first = 0.0), changed(|c| c.first = 999_994.0)] {
        assert_eq!(word(&bad).as_deref(), Some("harmonic"));
    }
    let no_law = numbers(CYCLE, &[5.0, 0.5, 0.0], &LINE);
    assert_eq!(word(&no_law).as_deref(), Some("bad layout"));
}

/// A trapezoid: up by a straight line in the first quarter of a turn, high in the second, down in
/// the third. Its mean is half the lift; the n-th coefficients are integrals of pieces of straight
/// lines.
#[test]
fn coefficients_of_a_trapezoid() {
    let values =
        CamFourierSeries::solve(CamFourierSeries::unpack(&changed(|c| c.stride = 2.0)).unwrap())
            .unwrap();
    assert_eq!(values.len(), 24);
    for (k, row) in values.chunks(3).enumerate() {
        let n = f64::from(1 + 2 * k as u32);
        // a_n = −(1/πn) ∫ f' sin nθ, b_n = (1/πn) ∫ f' cos nθ, f' = ±2/(π/2).
        let slope = 2.0 / FRAC_PI_2;
        let sine = |from: f64, to: f64| ((n * from).cos() - (n * to).cos()) / n;
        let cosine = |from: f64, to: f64| ((n * to).sin() - (n * from).sin()) / n;
        let a = -slope * (sine(0.0, FRAC_PI_2) - sine(PI, 1.5 * PI)) / (PI * n);
        let b = slope * (cosine(0.0, FRAC_PI_2) - cosine(PI, 1.5 * PI)) / (PI * n);
        let due = [1.0, a, b];
        let off = |k: usize| (row[k] - due[k]).abs();
        assert!((0..3).all(|k| off(k) < 1e-13), "{n}: {row:?} {due:?}");
    }
}

/// Without a return the lift goes on: what is left is a sawtooth, of which the return's law is no
/// part.
#[test]
fn without_a_return_the_other_law_counts_nothing() {
    let solved = |fall: &[f64]| {
        let cycle = CamCycleInput {
            fall: 0.0,
            high_dwell: 0.0,
            ..CYCLE
        };
        let input = numbers(cycle, &LINE, fall);
        (
            CamFourierSeries::solve(CamFourierSeries::unpack(&input).unwrap()).unwrap(),
            CamFourierSeries::conditions(&input).unwrap(),
        )
    };
    let table = [input::TABLE, 0.5, 6.0, 0.0, 0.5, 1.0, 0.0, 0.25, 1.0];
    assert_eq!(solved(&LINE).0, solved(&table).0);
    assert_eq!(solved(&LINE).1[1], solved(&table).1[1]);
}

/// A harmonic that there is none of breaks both laws.
#[test]
fn laws_ask_for_every_harmonic() {
    for law in CamFourierSeries::laws() {
        let residual = |x: &[f64]| (law.residual)(x);
        assert!(
            residual(&changed(|_| ())).is_some_and(|r| r <= 1.0),
            "{}",
            law.name
        );
        for bad in [changed(|c| c.first = 0.0), changed(|c| c.first = 999_994.0)] {
            assert!(residual(&bad).is_some_and(f64::is_nan), "{}", law.name);
        }
        assert_eq!(residual(&changed(|c| c.rise = -0.25)), None, "{}", law.name);
        assert_eq!(residual(&[1.0]), None, "{}", law.name);
        // Nothing is lifted: all harmonics are zero.
        let flat = residual(&changed(|c| c.lift = 0.0));
        assert!(flat.is_none_or(|r| r == 0.0), "{} {flat:?}", law.name);
    }
}
