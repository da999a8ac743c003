//! Weights, laws and refusals of splines on equal steps.

use super::*;
use crate::audit::SolverAnswer;
use crate::methods::find;

fn steps(y: &[f64], x0: f64, h: f64) -> CubicSplineUniformInput<'_> {
    CubicSplineUniformInput {
        x0,
        h,
        m0: 0.0,
        mn: 0.0,
        q0: x0,
        q1: x0,
        y,
    }
}

#[test]
fn a_function_has_to_have_the_ordinates_at_knots_that_are_floats() {
    let y = [1.0, 2.0, 3.0];
    let line = |x: f64| Some(x + 1.0);
    let i = steps(&y, 0.0, 1.0);
    assert_eq!(interpolates(i, line), Some(true));
    for off in [0.0, 1.0, 2.0] {
        let moved = |x: f64| if x == off { Some(0.0) } else { line(x) };
        let lost = |x: f64| if x == off { None } else { line(x) };
        assert_eq!(interpolates(i, moved), Some(false), "{off}");
        assert_eq!(interpolates(i, lost), Some(false), "{off}");
    }
    // Three times the f64 nearest to a tenth is no float.
    let y = [1.0, 1.0, 1.0, 7.0];
    assert_eq!(interpolates(steps(&y, 0.0, 0.1), |_| Some(1.0)), Some(true));
    assert_eq!(interpolates(steps(&y, f64::NAN, 0.1), line), None);
    assert_eq!(interpolates(steps(&y, 0.0, f64::INFINITY), line), None);
}

/// Rows 1, 4, 1 between unit rows: `Aᵀ z = c` is looked at column by column of A.
#[test]
fn the_transposed_system_is_solved() {
    for n in 1..=6 {
        for one in 0..=n {
            let mut c = vec![0.0; n + 1];
            c[one] = 1.0;
            let z = transposed_solve(&c);
            let entry = |row: usize, column: usize| match row == 0 || row == n {
                true => f64::from(u8::from(row == column)),
                false if row == column => 4.0,
                false => f64::from(u8::from(row.abs_diff(column) == 1)),
            };
            for (column, due) in c.iter().enumerate() {
                let got: f64 = (0..=n).map(|row| entry(row, column) * z[row]).sum();
                assert!((got - due).abs() < 1e-15, "{n} {one} {column}: {z:?}");
            }
        }
    }
}

/// On one segment from 0 to 1 without second derivatives at the ends the spline is the chord 2 +
/// 4x.
#[test]
fn conditions_of_a_chord() {
    // x0, h, m0, mn, q0, q1, y0, y1
    let input = [0.0, 1.0, 0.0, 0.0, 0.25, 1.0, 2.0, 6.0];
    let found = CubicSplineUniform::conditions(&input).unwrap();
    // Ordinates by their weights, then |q ∂f/∂q|, then |h ∂f/∂h|: S = y0 + q (y1 − y0)/h.
    let slope = 2.0 + 6.0 + 4.0;
    let due_here = [0.75 * 2.0 + 0.25 * 6.0 + 1.0 + 1.0, slope, 0.0, 0.0];
    let due_there = [6.0 + 4.0 + 4.0, slope, 0.0, 0.0];
    // The integral from 1/4 to 1 has the weights (1 − ¼)²/2 and (1 − 1/16)/2; S(¼) = 3, S(1) = 6,
    // and the integral of −x S' is −15/8.
    let area = 2.0 * 9.0 / 32.0 + 6.0 * 15.0 / 32.0 + 0.25 * 3.0 + 6.0 + 15.0 / 8.0;
    let due = [&due_here[..], &[area], &due_there, &[area]].concat();
    let close = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12;
    assert!(found.iter().zip(&due).all(close), "{found:?} {due:?}");
    assert_eq!(found.len(), 10);
}

#[test]
fn what_is_no_spline_is_refused_by_its_name() {
    let method = find("cubic-spline-uniform").unwrap();
    let (inf, max) = (f64::INFINITY, f64::MAX);
    for (head, y, due) in [
        ([0.0, 1.0, 0.0, 0.0, 0.0, 0.0], &[1.0][..], "too few knots"),
        ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0], &[1.0, 2.0], "bad step"),
        ([0.0, -1.0, 0.0, 0.0, 0.0, 0.0], &[1.0, 2.0], "bad step"),
        ([0.0, 1.0, 0.0, 0.0, 0.0, 0.0], &[1.0, inf], "not finite"),
        ([0.0, 1.0, inf, 0.0, 0.0, 0.0], &[1.0, 2.0], "not finite"),
        ([0.0, 1.0, 0.0, 0.0, inf, 0.0], &[1.0, 2.0], "not finite"),
        (
            [0.0, 1.0, max, 0.0, 0.0, 0.0],
            &[max, -max, max],
            "overflow",
        ),
        ([0.0, 1.0, 0.0, 0.0, -0.5, 0.5], &[1.0, 2.0], "outside"),
        ([0.0, 1.0, 0.0, 0.0, 0.5, 1.5], &[1.0, 2.0], "outside"),
    ] {
        let input = [&head[..], y].concat();
        let answer = method.solve(&input);
        assert_eq!(answer, SolverAnswer::Refuses(due), "{input:?}");
    }
}
