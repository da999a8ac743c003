//! Inputs that violate what the proofs of this folder rest on.

use super::tests::{q, zinchenko};
use super::{Configuration, ExactAngle, Geometry, Linkage};
use crate::{Ball, ComplexBall, Mag};
use rug::{Float, Rational};

fn degrees(d: &str, bits: u32) -> Ball {
    ExactAngle::Degrees(q(d)).to_ball(bits)
}

/// Link 2 too short by 40 cm to reach B anywhere near: the distance equations have no zero.
fn torn() -> Geometry {
    Geometry {
        l2: q("10"),
        ..zinchenko()
    }
}

fn coordinates(c: &Configuration) -> [&Ball; 4] {
    [&c.c.re, &c.c.im, &c.d.re, &c.d.im]
}

/// A box without a zero of the distance equations encloses none, from whatever guess.
#[test]
fn a_box_without_a_root_is_refused() {
    let linkage = Linkage::new(&torn(), 128);
    let phi = degrees("14.426", 128);
    assert!(linkage.modes(&phi).unwrap().is_empty());
    let whole = Linkage::new(&zinchenko(), 128);
    for mode in whole.modes(&phi).unwrap() {
        let [cx, cy, dx, dy] = coordinates(&mode.configuration).map(|b| b.mid().to_f64());
        let found = whole.near(&phi, [cx, cy], [dx, dy]).expect("it is there");
        let pairs = coordinates(&found).into_iter();
        assert!(
            pairs
                .zip(coordinates(&mode.configuration))
                .all(|(a, b)| a.overlaps(b))
        );
        for push in [-7.0, 0.0, 0.25, 30.0] {
            assert!(
                linkage
                    .near(&phi, [cx + push, cy], [dx, dy - push])
                    .is_none()
            );
        }
    }
}

/// Beyond a fold, where two modes have just met, the guess that was theirs finds nothing; on it,
/// where the zero is double, nothing is proved.
#[test]
fn a_double_root_is_refused() {
    // The fold lies between these two angles.
    let (before, beyond) = ("217.270876405", "217.270876407");
    let linkage = Linkage::new(&zinchenko(), 128);
    let modes = linkage.modes(&degrees(before, 128)).unwrap();
    let there = linkage.modes(&degrees(beyond, 128)).unwrap();
    let alive = |c: &Configuration| {
        there.iter().any(|m| {
            let pairs = coordinates(&m.configuration)
                .into_iter()
                .zip(coordinates(c));
            pairs
                .into_iter()
                .all(|(a, b)| (a - b).magnitude() < Mag::from_f64(1e-2))
        })
    };
    let met: Vec<_> = modes.iter().filter(|m| !alive(&m.configuration)).collect();
    assert_eq!(met.len(), 2);
    // A crank angle anywhere between the two.
    let wide = degrees(before, 128).union(&degrees(beyond, 128));
    for mode in &met {
        let at = coordinates(&mode.configuration).map(|b| b.mid().clone());
        for phi in [&degrees(beyond, 128), &wide] {
            assert!(linkage.enclose(&ComplexBall::unit(phi), &at).is_none());
        }
    }
    // The two on either side of the fold are no one branch over the arc, though both exist at its
    // end.
    let arc = ComplexBall::unit(&wide.with_prec(64));
    let [a, b] = [&met[0].configuration, &met[1].configuration];
    assert!(!linkage.joined(&arc, a, b));
    assert!(linkage.joined(&ComplexBall::unit(&degrees(before, 64)), a, a));
}

/// Two modes far from each other are no branch either, over an arc of any length.
#[test]
fn two_modes_are_not_joined() {
    let linkage = Linkage::new(&zinchenko(), 128);
    let phi = degrees("14.426", 128);
    let modes = linkage.modes(&phi).unwrap();
    for (i, a) in modes.iter().enumerate() {
        for (j, b) in modes.iter().enumerate() {
            for width in [0.0, 1e-9, 1e-3] {
                let arc = phi.with_prec(64).widened(Mag::from_f64(width));
                let arc = ComplexBall::unit(&arc);
                let joined = linkage.joined(&arc, &a.configuration, &b.configuration);
                assert_eq!(joined, i == j, "{i} {j} {width}");
            }
        }
    }
}

/// Checks what an enclosure for an uncertain crank angle holds: every position in it, and not much
/// more. A radius a tenth as large would miss some.
#[test]
fn radii_are_needed_and_enough() {
    let bits = 160;
    let linkage = Linkage::new(&zinchenko(), bits);
    let mut most = 0.0f64;
    for (d, k) in [("14.426", 0), ("14.426", 2), ("100", 1), ("300", 3)] {
        let phi = degrees(d, bits);
        let start = linkage.modes(&phi).unwrap()[k].configuration.clone();
        for size in [-20, -40] {
            let radius = Mag::power_of_two(size);
            let at = start.coordinates();
            let wide = linkage
                .enclose(&ComplexBall::unit(&phi.widened(radius)), &at)
                .expect("proved");
            let rates = linkage.kinematics(&wide).unwrap();
            for part in [-1.0, -0.5, 0.5, 1.0] {
                let moved = &phi + &Ball::new(radius.to_float() * part, Mag::ZERO);
                let exact = Ball::new(moved.mid().clone(), Mag::ZERO);
                let there = linkage
                    .enclose(&ComplexBall::unit(&exact), &at)
                    .expect("proved");
                let there_rates = linkage.kinematics(&there).unwrap();
                let joints = coordinates(&wide).into_iter().zip(coordinates(&there));
                let angles = rates.angles.iter().zip(&there_rates.angles);
                let first = rates.first.iter().zip(&there_rates.first);
                let second = rates.second.iter().zip(&there_rates.second);
                for (wide, inside) in joints.chain(angles).chain(first).chain(second) {
                    assert!(wide.contains_ball(inside), "{d} {k} {size} {part}");
                }
                for (wide, inside) in coordinates(&wide).into_iter().zip(coordinates(&there)) {
                    let way = Float::with_val(64, wide.mid() - inside.mid()).abs();
                    most = most.max((way / wide.rad().to_float()).to_f64());
                }
            }
        }
    }
    assert!(most > 0.1, "{most}: the radius is ten times what is needed");
}

/// The reduced quantities of an uncertain crank angle hold those of every angle in it; the
/// derivative of the inertia uses a good part of its radius.
#[test]
fn reduced_quantities_of_an_uncertain_angle() {
    use super::motion::{Body, Masses};
    let body = |m: i32, j: i32, about_pivot: bool| Body {
        mass: Rational::from(m),
        inertia: Rational::from(j),
        about_pivot,
        radius: Rational::from((m % 7 + 1, 3)),
        angle: ExactAngle::Degrees(Rational::from(10 * m)),
    };
    let masses = Masses {
        bodies: [
            body(1, 2, true),
            body(10, 8, false),
            body(5, 5, true),
            body(55, 18, false),
            body(3, 2, true),
        ],
        gravity: q("9.81"),
    };
    let bits = 160;
    let linkage = Linkage::new(&zinchenko(), bits);
    let phi = degrees("50", bits);
    let start = linkage.modes(&phi).unwrap()[0].configuration.coordinates();
    let reduced = |phi: &Ball| {
        let at = linkage.enclose(&ComplexBall::unit(phi), &start).unwrap();
        let r = linkage.reduce(&linkage.kinematics(&at).unwrap(), &masses);
        [
            r.inertia,
            r.inertia_derivative,
            r.moment,
            r.moment_derivative,
        ]
    };
    let radius = Mag::power_of_two(-30);
    let wide = reduced(&phi.widened(radius));
    let mut most = [0.0f64; 4];
    for part in [-1.0, 1.0] {
        let moved = &phi + &Ball::new(radius.to_float() * part, Mag::ZERO);
        let inside = reduced(&Ball::new(moved.mid().clone(), Mag::ZERO));
        for (k, (wide, inside)) in wide.iter().zip(&inside).enumerate() {
            assert!(wide.contains_ball(inside), "{k} {part}");
            let way = Float::with_val(64, wide.mid() - inside.mid()).abs();
            most[k] = most[k].max((way / wide.rad().to_float()).to_f64());
        }
    }
    assert!(most.iter().all(|m| *m > 1.0 / 500.0), "{most:?}");
}

/// The box of the proof holds both ends with all that is uncertain of them, and every crank angle
/// between them.
#[test]
fn the_way_between_two_positions_is_all_of_it() {
    let bits = 128;
    let linkage = Linkage::new(&zinchenko(), bits);
    let phi = degrees("14.426", bits);
    let at = linkage.modes(&phi).unwrap()[0].configuration.clone();
    let arc = ComplexBall::unit(&phi.with_prec(64));
    assert!(linkage.joined(&arc, &at, &at));
    let wide = |r: f64| Configuration {
        c: at.c.widened(Mag::from_f64(r)),
        ..at.clone()
    };
    assert!(linkage.joined(&arc, &wide(1e-6), &at) && linkage.joined(&arc, &at, &wide(1e-6)));
    assert!(!linkage.joined(&arc, &wide(60.0), &at) && !linkage.joined(&arc, &at, &wide(60.0)));
    // Two modes end in a fold at 217.27 degrees: a whole turn brings the crank back, and them not.
    let (start, turned) = (degrees("217.2", bits), degrees("577.2", bits));
    let modes = linkage.modes(&start).unwrap();
    let beyond = linkage.modes(&degrees("217.3", bits)).unwrap();
    assert_eq!(modes.len(), beyond.len() + 2);
    let ended = modes.iter().filter(|m| {
        let from = &m.configuration;
        linkage.follow(from, &start, &turned).is_none()
    });
    assert!(ended.count() >= 2);
}

/// The norm of `I − Y J` counts every entry: where `Y` leaves out one part of `J⁻¹`, the entry
/// there is 5.
#[test]
fn the_contraction_counts_every_entry() {
    let linkage = Linkage::new(&zinchenko(), 128);
    let mode = &linkage.modes(&degrees("14.426", 128)).unwrap()[0].configuration;
    let at = mode.coordinates();
    let inverse = linkage.approximate_inverse(&mode.a, &at).unwrap();
    let norm =
        |y: &nalgebra::Matrix4<f64>| linkage.contraction(y, &mode.a, &mode.c, &mode.d).to_f64();
    assert!(norm(&inverse) < 1e-10);
    for i in 0..4 {
        for k in 0..4 {
            let mut y = inverse;
            for m in 0..4 {
                y[(i, m)] -= 5.0 * inverse[(k, m)];
            }
            let found = norm(&y);
            assert!((found - 5.0).abs() < 1e-6, "{i} {k}: {found}");
        }
    }
}

/// A position with whole coordinates, rocker 3 upright: A (1, 0), B (6, 12), C (0, 4), D (4, 4).
fn upright(bits: u32) -> (Linkage, [Float; 4]) {
    let b = |x: f64| Ball::exact(bits, x);
    let z = |x: f64, y: f64| ComplexBall::new(b(x), b(y));
    let linkage = Linkage {
        bits,
        l1: b(1.0),
        l2: b(13.0),
        l3: b(4.0),
        l4: b(4.0),
        l5: b(5.0),
        o3: z(0.0, 0.0),
        o5: z(7.0, 0.0),
        phi_b: z(3.0, 4.0).arg(),
        kappa: z(1.5, 2.0),
        one_minus_kappa: z(-0.5, -2.0),
    };
    (linkage, [0, 4, 4, 4].map(|x| Float::with_val(bits, x)))
}

/// It solves the equations exactly, and is enclosed all the same.
#[test]
fn a_zero_hit_exactly_is_enclosed() {
    let (linkage, at) = upright(96);
    let e1 = ComplexBall::new(Ball::exact(96, 1.0), Ball::exact(96, 0.0));
    let found = linkage.enclose(&e1, &at).expect("proved");
    for (x, due) in coordinates(&found).into_iter().zip(&at) {
        assert!(x.mid() == due && x.rad() < Mag::power_of_two(-96));
    }
}

/// Joint C is at its highest, and an uncertain crank lowers it in second order. The step of
/// Newton's method does not see that; the term `(I − Y F'(X)) (X − z)` does.
#[test]
fn the_radius_holds_the_second_order() {
    let (linkage, at) = upright(160);
    let radius = Mag::power_of_two(-24);
    let enclosed = |phi: &Ball| {
        linkage
            .enclose(&ComplexBall::unit(phi), &at)
            .expect("proved")
    };
    let wide = enclosed(&Ball::integer(160, 0).widened(radius));
    for sign in [-1.0, 1.0] {
        let there = enclosed(&Ball::exact(160, sign * radius.to_f64()));
        assert!((&there.c.im - &Ball::integer(160, 4)).mignitude() > Mag::power_of_two(-52));
        for (wide, inside) in coordinates(&wide).into_iter().zip(coordinates(&there)) {
            assert!(wide.contains_ball(inside), "{sign}");
        }
    }
}
