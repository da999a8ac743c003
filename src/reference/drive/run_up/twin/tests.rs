//! Derivatives of a step, and coefficients at the border of two panels.

use super::super::coefficients::Coefficients;
use super::super::linkage_panel::Panel;
use super::super::motor::Motor;
use super::*;
use rug::Rational;

const BITS: u32 = 160;

fn q(n: i64, d: i64) -> Rational {
    Rational::from((n, d))
}

fn ball(x: &Rational) -> Ball {
    Ball::rational(BITS, x)
}

/// A polynomial in the place from −1 to 1, with a radius.
fn model(c: &[(i64, i64)], rad: f64) -> TaylorModel {
    let c: Vec<Ball> = c.iter().map(|&(n, d)| ball(&q(n, d))).collect();
    TaylorModel::from_balls(&c).widened(Mag::from_f64(rad))
}

/// Two panels of half a turn each; I_n continues but for 1/64, within the radii of 1/32 and 1/16.
fn two_panels(rads: [f64; 2]) -> Coefficients {
    let panel = |i: &[(i64, i64)], s: &[(i64, i64)], m: &[(i64, i64)], rad: f64| Panel {
        inertia: model(i, rad),
        slope: model(s, rad),
        moment: model(m, rad),
    };
    Coefficients::of_panels(
        vec![
            panel(
                &[(5, 1), (1, 2), (1, 4)],
                &[(1, 3), (1, 5)],
                &[(2, 1), (-1, 3), (0, 1), (1, 7)],
                rads[0],
            ),
            panel(
                &[(449, 64), (3, 4), (-1, 2)],
                &[(1, 2), (-1, 9)],
                &[(1, 1), (2, 3)],
                rads[1],
            ),
        ],
        BITS,
    )
}

fn system(model: &Coefficients) -> System<'_> {
    let motor = Motor::Kloss {
        breakdown_torque: q(40, 1),
        breakdown_slip: q(1, 4),
        synchronous: q(10, 1),
    };
    System {
        model,
        motor: motor.at(BITS),
        rotor: ball(&q(3, 2)),
    }
}

/// A point with the derivatives of a start: its own.
fn start(x: &Rational, i: usize) -> Spread {
    Spread {
        at: ball(x),
        over: ball(x),
        rate: [0, 1].map(|k| Ball::integer(BITS, i64::from(k == i))),
    }
}

/// `∂ψ'/∂φ` and `∂ψ'/∂ψ` by differences over 2^-40, in either panel.
#[test]
fn derivatives_of_the_equation_are_limits_of_differences() {
    let model = two_panels([0.0; 2]);
    let system = system(&model);
    let at = |phi: &Rational, psi: &Rational| {
        let [_, rate] = system
            .right_hand_side(&[start(phi, 0), start(psi, 1)])
            .unwrap();
        rate
    };
    let h = q(1, 1) >> 40u32;
    for (phi, psi) in [
        (q(1, 2), q(7, 1)),
        (q(2, 1), q(-3, 1)),
        (q(4, 1), q(19, 2)),
        (q(11, 2), q(1, 3)),
    ] {
        let found = at(&phi, &psi);
        let slope = |up: Spread, down: Spread| ((&up.at - &down.at).shift(39)).to_f64();
        let sides = |x: &Rational| [Rational::from(x + &h), Rational::from(x - &h)];
        let [up, down] = sides(&phi).map(|x| at(&x, &psi));
        let by_phi = slope(up, down);
        let [up, down] = sides(&psi).map(|x| at(&phi, &x));
        let by_psi = slope(up, down);
        for (rate, due) in found.rate.iter().zip([by_phi, by_psi]) {
            assert!(
                (rate.to_f64() / due - 1.0).abs() < 1e-12,
                "{phi} {psi}: {due}"
            );
            assert!(rate.accuracy_bits() > 30);
        }
        // The value itself: (M_d + M_o − ½ψ² S)/(I_n + I_1).
        let [i, s, m] = model.over(&ball(&phi), &ball(&phi)).unwrap();
        let torque =
            system.motor.torque(&ball(&psi)) + &m.at - (ball(&psi).square() * &s.at).shift(-1);
        assert!((torque / (&i.at + &system.rotor)).overlaps(&found.at));
        let [phi_rate, _] = system
            .right_hand_side(&[start(&phi, 0), start(&psi, 1)])
            .unwrap();
        assert!(phi_rate.at.contains(&psi) && phi_rate.rate[0].is_zero());
    }
}

/// Checks that earlier errors propagate with the derivatives of the step, each with its own error.
#[test]
fn errors_go_on_with_the_derivatives() {
    // φ' = ψ, ψ' = 3 − 2ψ.
    let model = Coefficients::constant(&q(1, 1), &q(0, 1), BITS);
    let system = System {
        model: &model,
        motor: Motor::Linear {
            standstill: q(3, 1),
            slope: q(2, 1),
        }
        .at(BITS),
        rotor: Ball::integer(BITS, 0),
    };
    let euler = RungeKutta {
        a: vec![vec![]],
        b: vec![1.0],
    };
    let leg = Leg {
        method: &euler,
        from: 0.25,
        to: 0.5,
    };
    let point = [1.0, 0.5].map(|x| Float::with_val(BITS, x));
    for (e, due) in [
        ([1.0, 0.0], [1.0, 0.0]),
        ([0.0, 1.0], [0.25, 0.5]),
        ([8.0, 1.0], [8.25, 0.5]),
    ] {
        let error = e.map(|e| Mag::from_f64(e * 1e-3));
        let step = system.step(&leg, &point, error).unwrap();
        for (found, due) in step.error.iter().zip(due) {
            assert!((found.to_f64() - due * 1e-3).abs() < 1e-12, "{e:?}");
        }
        assert_eq!(step.point.map(|x| x.to_f64()), [1.125, 1.0]);
    }
    let endless = system
        .step(&leg, &point, [Mag::ZERO, Mag::INFINITY])
        .unwrap();
    assert!(!endless.error[0].is_finite());
    let far = |rad: [f64; 2]| {
        let run = Run {
            motor: Motor::Constant { torque: q(1, 1) },
            rotor_inertia: q(0, 1),
            angle: crate::class_iii::ExactAngle::Radians(q(0, 1)),
            speed: q(0, 1),
        };
        let start = rad.map(|r| Ball::integer(BITS, 1).widened(Mag::from_f64(r)));
        follow_from(&model, &run, start, &[leg])
    };
    // φ' = ψ, ψ' = 1: angle and speed have errors of their own.
    let [angle, speed] = far([0.0, 1e-3]).unwrap();
    assert!((angle.rad().to_f64() - 0.25e-3).abs() < 1e-12);
    assert!((speed.rad().to_f64() - 1e-3).abs() < 1e-12);
    assert!(far([f64::INFINITY, 0.0]).is_err() && far([0.0, f64::INFINITY]).is_err());
}

/// `ψ' = −½ψ² S/I` falls the faster the larger ψ: what a smaller ψ ends with is farther off.
#[test]
fn errors_go_on_with_the_largest_derivative() {
    let constant = |x: i64| model(&[(x, 1)], 0.0);
    let panel = || Panel {
        inertia: constant(1),
        slope: constant(1),
        moment: constant(0),
    };
    let model = Coefficients::of_panels(vec![panel()], BITS);
    let euler = RungeKutta {
        a: vec![vec![]],
        b: vec![1.0],
    };
    let leg = Leg {
        method: &euler,
        from: 0.0,
        to: 0.25,
    };
    let run = Run {
        motor: Motor::Constant { torque: q(0, 1) },
        rotor_inertia: q(0, 1),
        angle: crate::class_iii::ExactAngle::Radians(q(1, 1)),
        speed: q(1, 1),
    };
    let half = Mag::from_f64(0.5);
    let start = [Ball::integer(BITS, 1), Ball::integer(BITS, 1).widened(half)];
    let [angle, speed] = follow_from(&model, &run, start, &[leg]).unwrap();
    for psi in [q(1, 2), q(1, 1), q(3, 2)] {
        let end = psi.clone() - psi.clone() * &psi / 8;
        assert!(speed.contains(&end) && angle.contains(&(psi / 4 + 1u32)));
    }
    // sup |1 − ψ/4| is 7/8.
    assert!((speed.rad().to_f64() - 7.0 / 16.0).abs() < 1e-9);
}

/// Inside a panel its own values; across a border the union of both, widened by both radii once
/// more on either side.
#[test]
fn coefficients_across_a_border() {
    let (r0, r1) = (1.0 / 32.0, 1.0 / 16.0);
    let model = two_panels([r0, r1]);
    let pi = Ball::pi(BITS);
    let off = |x: f64| &pi + Ball::exact(BITS, x);
    let value = |c: &[f64], x: f64| c.iter().rev().fold(0.0, |s, c| s * x + c);
    let close = |b: &Ball, due: f64, rad: f64| {
        assert!((b.to_f64() - due).abs() < 1e-12, "{b:?} {due}");
        assert!((b.rad().to_f64() / rad - 1.0).abs() < 1e-9, "{b:?} {rad}");
    };
    let first = [5.0, 0.5, 0.25];
    let second = [449.0 / 64.0, 0.75, -0.5];
    // Half a panel before the border: the place 1/2 of the first panel.
    let quarter = &pi * Ball::exact(BITS, 0.75);
    let [inertia, ..] = model.over(&quarter, &quarter).unwrap();
    close(&inertia.at, value(&first, 0.5), r0);
    close(&inertia.over, value(&first, 0.5), r0);
    // dI/dφ of the polynomial: by the half-width of π/2.
    let slope = (0.5 + 0.5 * 0.5) / std::f64::consts::FRAC_PI_2;
    assert!((inertia.slope.to_f64() - slope).abs() < 1e-12);
    // Just beyond the border, with a box on both sides.
    let h = 1e-3;
    let at = off(h / 2.0);
    let over = off(0.0).widened(Mag::from_f64(h));
    let [inertia, _, moment] = model.over(&at, &over).unwrap();
    let x = h / 2.0 * 2.0 / std::f64::consts::PI * 2.0 - 1.0;
    let (left, right) = (value(&first, 1.0), value(&second, x / 2.0 - 0.5));
    let inside = |b: &Ball, x: f64| b.contains(&Rational::from_f64(x).unwrap());
    assert!(
        inside(&inertia.at, left) && inside(&inertia.at, right),
        "{:?}",
        inertia.at
    );
    // Both values with their radii, and both radii once more: 2 (r0 + r1).
    let jump = 2.0 * (r0 + r1);
    for ball in [&inertia.at, &inertia.over] {
        let least = 0.5 * (r0 + r1) + jump;
        let rad = ball.rad().to_f64();
        assert!(rad >= least && rad <= least + 0.6, "{ball:?}");
    }
    let ends = [value(&first, 1.0) - r0, value(&second, -1.0) + r1];
    let reach = [ends[0] - jump, ends[1] + jump];
    assert!(inside(&inertia.over, reach[0].max(left - r0 - jump + 1e-9)));
    assert!(inside(&inertia.over, left + r0 + jump - 1e-9));
    assert!(inside(
        &moment.over,
        value(&[1.0, 2.0 / 3.0], -1.0) - r1 - jump + 1e-9
    ));
    // Slopes of either side: of the first at 1, of the second at −1.
    let half = std::f64::consts::FRAC_PI_2;
    assert!(
        inside(&inertia.slope, (1.0 - 1e-6) / half) && inside(&inertia.slope, (1.75 - 1e-6) / half)
    );
    // From one panel to the next but one nothing is told.
    let three = off(1.6).widened(Mag::from_f64(1.65));
    assert!(model.over(&off(1.6), &three).is_err());
    let wide = off(0.0).widened(Mag::from_f64(3.3));
    assert!(model.over(&at, &wide).is_err());
    assert!(
        model
            .over(&at, &off(1.0).widened(Mag::from_f64(1.5)))
            .is_ok()
    );
}

/// Places are in panels from the offset on, whatever the units of both.
#[test]
fn places_of_angles() {
    use crate::class_iii::ExactAngle::{Degrees, Radians};
    let mut model = two_panels([0.0; 2]);
    let near = |b: &Ball, due: f64| assert!((b.to_f64() - due).abs() < 1e-14, "{b:?} {due}");
    near(&model.place(&Radians(q(3, 2))), 1.5 / std::f64::consts::PI);
    near(&model.place(&Degrees(q(90, 1))), 0.5);
    model.offset = Radians(q(1, 2));
    near(&model.place(&Radians(q(3, 2))), 1.0 / std::f64::consts::PI);
    near(
        &model.place(&Degrees(q(90, 1))),
        0.5 - 0.5 / std::f64::consts::PI,
    );
    near(&model.place_of(&ball(&q(3, 2))), 1.0 / std::f64::consts::PI);
    model.offset = Degrees(q(30, 1));
    near(&model.place(&Degrees(q(90, 1))), 1.0 / 3.0);
    assert!(model.place(&Degrees(q(210, 1))).contains(&q(1, 1)));
}

#[test]
fn places_are_cut_to_a_panel() {
    // A value inside stays as it is, known to far more bits than its ends would have.
    for n in [2, 5] {
        let mid = Float::with_val(BITS, n) / 3u32;
        let x = within(Ball::new(mid.clone(), Mag::power_of_two(-400)));
        assert!(
            *x.mid() == mid - 1u32 && x.rad() == Mag::power_of_two(-400),
            "{x:?}"
        );
    }
    let of = |lo: f64, hi: f64| {
        let mid = Float::with_val(BITS, 0.5 * (lo + hi));
        let x = within(Ball::new(mid, Mag::from_f64(0.5 * (hi - lo))));
        [x.lower().to_f64(), x.upper().to_f64()]
    };
    for (ends, due) in [
        ([0.0, 2.0], [-1.0, 1.0]),
        ([0.5, 1.75], [-0.5, 0.75]),
        ([-1.0, 0.5], [-1.0, -0.5]),
        ([1.5, 4.0], [0.5, 1.0]),
        ([-3.0, 5.0], [-1.0, 1.0]),
        ([2.5, 3.0], [1.0, 1.0]),
        ([-2.0, -1.0], [-1.0, -1.0]),
    ] {
        let found = of(ends[0], ends[1]);
        let near = found.iter().zip(due).all(|(x, d)| (x - d).abs() < 1e-15);
        assert!(near, "{ends:?}: {found:?}");
    }
}
