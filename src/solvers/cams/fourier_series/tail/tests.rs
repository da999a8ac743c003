//! `T_p` against the variation of the law's own derivatives, point by point.

use super::super::Transform;
use super::{decays, variation};
use crate::cam_law::{MotionLaw, Shape};
use crate::cubic_spline::End;

/// Total variation on the whole line of values at steps across [0, 1].
fn variation_of(values: &[f64]) -> f64 {
    let inner: f64 = values.windows(2).map(|w| (w[1] - w[0]).abs()).sum();
    values[0].abs() + inner + values[values.len() - 1].abs()
}

/// The derivative of order `p`, of which one beyond `s'''` is made of differences.
fn sampled(law: &MotionLaw, p: i32) -> Vec<f64> {
    let n = 8000;
    let at = |i: usize| law.motion(i as f64 / n as f64).expect("a place");
    let of = |i: usize| match p {
        1 => at(i).velocity,
        2 => at(i).acceleration,
        _ => at(i).jerk,
    };
    let mut values: Vec<f64> = (0..=n).map(of).collect();
    for _ in 3..p {
        values = values
            .windows(2)
            .map(|w| (w[1] - w[0]) * n as f64)
            .collect();
    }
    values
}

const KNOTS: [f64; 6] = [0.0, 0.25, 0.375, 0.625, 0.875, 1.0];

/// Returns what bounds the variation of a spline's velocity: jumps at the ends, and in each step
/// the larger of its two accelerations.
fn of_parabolas(law: &MotionLaw) -> f64 {
    let at = |x: f64| law.motion(x).expect("a place");
    let steps = KNOTS.windows(2).map(|k| {
        let [a, b] = [at(k[0]), at(k[1])].map(|m| m.acceleration.abs());
        (k[1] - k[0]) * a.max(b)
    });
    at(0.0).velocity.abs() + steps.sum::<f64>() + at(1.0).velocity.abs()
}

fn laws() -> Vec<MotionLaw> {
    let mut laws: Vec<MotionLaw> = vec![
        MotionLaw::constant_acceleration(),
        MotionLaw::simple_harmonic(),
        MotionLaw::modified_trapezoid(),
        MotionLaw::modified_sine(),
        MotionLaw::cycloidal(),
        MotionLaw::scca(0.3, 0.5, 0.2).expect("a law"),
        MotionLaw::scca(0.4, 0.6, 0.0).expect("a law"),
        MotionLaw::scca(0.0, 0.3, 0.7).expect("a law"),
        MotionLaw::polynomial_345(),
        MotionLaw::polynomial_4567(),
    ];
    let halves = laws.clone();
    for fraction in [0.25, 0.625] {
        let shifted = |l: &MotionLaw| l.clone().with_acceleration_fraction(fraction);
        laws.extend(halves.iter().map(|l| shifted(l).expect("a law")));
    }
    for p in [
        &[0.0, 1.0][..],
        &[0.0, 0.0, 3.0, -2.0],
        &[0.0, 0.0, 0.0, 10.0, -15.0, 6.0],
        &[0.0, -2.0, 9.0, -6.0],
        &[0.0, 0.0, 7.0, -12.0, 8.0, -2.0],
    ] {
        laws.push(MotionLaw::polynomial(p).expect("a law"));
    }
    let x = KNOTS.to_vec();
    let y = vec![0.0, 0.1, 0.4, 0.6, 1.1, 1.0];
    for ends in [
        [End::FirstDerivative(0.0); 2],
        [End::NotAKnot; 2],
        [End::SecondDerivative(0.0); 2],
        [End::SecondDerivative(0.0), End::FirstDerivative(0.0)],
    ] {
        laws.push(MotionLaw::tabulated(x.clone(), y.clone(), ends).expect("a law"));
    }
    laws
}

#[test]
fn variations_are_those_of_the_derivatives() {
    let mut met = [0; 6];
    for law in laws() {
        let all = decays(&law, &Transform::new(&law));
        assert!(!all.is_empty());
        for d in all {
            let due = match (law.shape(), d.order) {
                (Shape::Tabulated(_), 1) => of_parabolas(&law),
                _ => variation_of(&sampled(&law, d.order)),
            };
            let ratio = d.variation / due;
            // The deficit of the samples at a peak, and the excess of Bernstein's coefficients.
            assert!((0.9999..1.01).contains(&ratio), "{law:?}, {d:?}: {due}");
            met[d.order as usize] += 1;
        }
    }
    assert!(
        met[1] > 2 && met[2] > 10 && met[3] > 10 && met[4] > 0,
        "{met:?}"
    );
}

/// A monotone polynomial varies by the difference of its ends, others by their turning points.
#[test]
fn variations_of_polynomials() {
    let close = |p: &[f64], due: f64, off: f64| {
        let got = variation(p);
        assert!((got - due).abs() <= off * due.abs(), "{p:?}: {got} {due}");
    };
    close(&[5.0], 0.0, 0.0);
    close(&[1.0, -3.0], 3.0, 1e-15);
    close(&[0.0, 0.0, 2.0], 2.0, 1e-14);
    close(&[0.0, 0.25, 0.25, 0.5], 1.0, 1e-14);
    // x − x²: up and down by a quarter.
    close(&[0.0, 1.0, -1.0], 0.5, 1e-3);
    // T₃(2x − 1) has four extremes of one: three sweeps of two.
    close(&[-1.0, 18.0, -48.0, 32.0], 6.0, 1e-2);
    // By its coefficients of the third degree, in 32 parts, in rational arithmetic; the variation
    // itself is 4/√3, 0.04 % less.
    close(&[0.0, -3.0, 0.0, 3.0], 9463.0 / 4096.0, 1e-14);
}
