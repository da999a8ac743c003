//! Peaks of tabulated laws and motions of a cycle, point by point.

use crate::cam_law::{CamCycle, Motion, MotionLaw, Stroke};
use crate::cubic_spline::End;
use std::f64::consts::TAU;

fn table(ends: [End; 2]) -> MotionLaw {
    let x = vec![0.0, 0.2, 0.35, 0.6, 0.85, 1.0];
    let y = vec![0.0, 0.05, 0.4, 0.55, 1.05, 1.0];
    MotionLaw::tabulated(x, y, ends).expect("a law")
}

#[test]
fn peaks_of_tables() {
    use End::{FirstDerivative as First, NotAKnot, SecondDerivative as Second};
    // The derivative that jumps at the ends: the velocity, or the acceleration alone.
    for (ends, velocity, acceleration) in [
        ([First(0.0); 2], false, true),
        ([NotAKnot; 2], true, true),
        ([First(0.0), NotAKnot], true, true),
        ([NotAKnot, First(0.0)], true, true),
        ([Second(0.0), First(0.0)], true, true),
        ([First(0.0), First(-0.5)], true, true),
        ([First(0.4), First(0.0)], true, true),
    ] {
        let law = table(ends);
        let n = 40_000;
        let at = |i: u32| law.motion(f64::from(i) / f64::from(n)).expect("a place");
        let all: Vec<Motion> = (0..=n).map(at).collect();
        let most = |f: fn(&Motion) -> f64| all.iter().map(f).fold(0.0, f64::max);
        let p = law.peaks();
        let near = |got: f64, due: f64| (got / due - 1.0).abs() < 1e-6;
        assert!(
            near(p.velocity, most(|m| m.velocity.abs())),
            "{ends:?} {p:?}"
        );
        assert!(near(p.deceleration, most(|m| -m.acceleration)), "{ends:?}");
        match velocity {
            true => assert_eq!(p.acceleration, f64::INFINITY, "{ends:?}"),
            false => assert!(near(p.acceleration, most(|m| m.acceleration)), "{ends:?}"),
        }
        match acceleration {
            true => assert_eq!(p.jerk, f64::INFINITY, "{ends:?}"),
            false => assert!(near(p.jerk, most(|m| m.jerk.abs())), "{ends:?}"),
        }
    }
    // Neither jumps.
    let x: Vec<f64> = (0..=8).map(|k| f64::from(k) / 8.0).collect();
    let y = x.iter().map(|x| x - (TAU * x).sin() / TAU).collect();
    let law = MotionLaw::tabulated(x.clone(), y, [Second(0.0), Second(0.0)]).expect("a law");
    let v = law.motion(0.0).expect("a place").velocity;
    assert!(v.abs() > 0.0 && law.peaks().acceleration == f64::INFINITY);
    // A spline from data with zero slope and curvature: an odd one about the middle.
    let one_end = table([Second(0.0), First(0.0)]);
    assert_eq!(one_end.motion(0.0).expect("a place").acceleration, 0.0);
    assert_eq!(one_end.motion(1.0).expect("a place").velocity, 0.0);
}

/// Derivatives of a cycle in radians of the shaft, by differences.
#[test]
fn motions_of_a_cycle() {
    let stroke = |law: MotionLaw, turns| Stroke { law, turns };
    let (rise, fall) = (
        stroke(MotionLaw::polynomial_4567(), 0.3),
        stroke(MotionLaw::cycloidal(), 0.25),
    );
    let cycle = CamCycle::new(0.7, rise.clone(), 0.2, fall, 0.25)
        .and_then(|c| c.starting_at(2.1))
        .expect("a cycle");
    let indexing = CamCycle::rise_dwell(0.7, rise, 0.7).expect("a cycle");
    for cycle in [cycle, indexing] {
        for k in 0..170 {
            let at = |x: f64| cycle.at(x).expect("an angle");
            let (x, h) = (f64::from(k) / 170.0 + 1e-3, 1e-6);
            let (a, m, b) = (at(x - h), at(x), at(x + h));
            let per = 2.0 * h * TAU;
            let close = |got: f64, due: f64, size: f64| {
                assert!((got - due).abs() < 1e-6 * size, "{x}: {got} {due}");
            };
            close(m.velocity, (b.displacement - a.displacement) / per, 3.0);
            close(m.acceleration, (b.velocity - a.velocity) / per, 30.0);
            close(m.jerk, (b.acceleration - a.acceleration) / per, 600.0);
            // Whole turns on, the same.
            close(at(x + 1.0).displacement, m.displacement, 1e-6);
            close(at(x - 3.0).velocity, m.velocity, 1e-6);
        }
    }
}

#[test]
fn shares_of_the_stroke() {
    let law = MotionLaw::cycloidal;
    let least = 1e-3f64;
    let (below, above) = (least.next_down(), (1.0 - least).next_up());
    for bad in [0.0, 5e-324, below, above, 1.0, -0.1, 1.1, f64::NAN] {
        assert!(law().with_acceleration_fraction(bad).is_err(), "{bad}");
    }
    for good in [least, 1.0 - least] {
        let m = law()
            .with_acceleration_fraction(good)
            .expect("a law")
            .motion(good);
        assert!((m.expect("a place").velocity - 2.0).abs() < 1e-14, "{good}");
    }
    // Symmetric halves stretched to 2λ and 2 − 2λ.
    for share in [0.2, 0.5, 0.7] {
        let (a, p) = (
            law().peaks(),
            law().with_acceleration_fraction(share).expect("a law"),
        );
        assert_eq!(p.acceleration_fraction(), share);
        let (p, up, down) = (p.peaks(), 2.0 * share, 2.0 - 2.0 * share);
        let close = |got: f64, due: f64| assert!((got / due - 1.0).abs() < 1e-14);
        close(p.velocity, a.velocity);
        close(p.acceleration, a.acceleration / up);
        close(p.deceleration, a.deceleration / down);
        close(p.jerk, a.jerk / up.min(down).powi(2));
    }
}
