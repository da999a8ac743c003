//! Which way through the transform is taken where, and that the ways agree.

use super::*;
use std::cell::Cell;

fn knots(jumps: &[f64]) -> Vec<Knot> {
    let (place, jumps) = (0.5, jumps.to_vec());
    vec![Knot { place, jumps }]
}

/// From `1 + 60/q ≤ q/2` on, that is from q = 12, in steps of a tenth.
#[test]
fn where_the_jumps_serve() {
    let tenths = |times: usize| (0..times).fold(1.0, |t, _| t * 1.1);
    let from = where_jumps_serve(&knots(&[0.0, 1.0, 60.0]), 2);
    assert_eq!(from, tenths(7));
    assert!(TAU * from >= 12.0 && TAU * tenths(6) < 12.0);
    // The size of the jumps does not matter, nor those below the order.
    assert_eq!(where_jumps_serve(&knots(&[9.0, 8.0, 480.0]), 2), from);
    assert_eq!(where_jumps_serve(&knots(&[0.0, 0.0, 8.0, 480.0]), 3), from);
    // One turn at least, ten thousand at most.
    assert_eq!(where_jumps_serve(&knots(&[1.0, 1.0]), 1), 1.0);
    let most = where_jumps_serve(&knots(&[1.0, 1e12]), 1);
    assert!(most > 1e4 && most < 1.1e4, "{most}");
}

/// From `60/q² + 720/q⁴ ≤ 1` on, that is from q = 8.39, in steps of a tenth.
#[test]
fn where_the_jumps_are_small() {
    let tenths = |times: usize| (0..times).fold(1.0, |t, _| t * 1.1);
    let two = [knots(&[0.0, -60.0]), knots(&[0.0, 0.0, 0.0, 720.0])].concat();
    let from = where_jumps_are_small(&two);
    assert_eq!(from, tenths(4));
    assert!(TAU * from >= 8.39 && TAU * tenths(3) < 8.39);
    assert_eq!(where_jumps_are_small(&knots(&[6.0])), 1.0);
    assert!(where_jumps_are_small(&knots(&[6.5])) > 1.0);
    assert!(where_jumps_are_small(&knots(&[1e30])) >= 1e4);
}

fn polynomials() -> [MotionLaw; 3] {
    // With a velocity, an acceleration and a jerk at the ends.
    [
        &[0.0, 1.0, 20.0, -80.0, 100.0, -40.0][..],
        &[0.0, 0.0, 3.0, 98.0, -500.0, 900.0, -700.0, 200.0],
        &[
            0.0, 0.0, 0.0, 84.0, -378.0, 756.0, -840.0, 540.0, -189.0, 28.0,
        ],
    ]
    .map(|p| MotionLaw::polynomial(p).expect("a law"))
}

fn turns(t: f64) -> Turns {
    Turns::multiple(1.0, t)
}

/// Below one turn the velocity is integrated, from there its derivative, from `tail_from` on the
/// jumps are added; at each seam both ways are the same number but for rounding.
#[test]
fn three_ways_of_a_polynomial() {
    for (law, order) in polynomials().iter().zip(1..) {
        let t = Transform::new(law);
        let velocity = |x: f64| law.motion(x).expect("a place").velocity;
        let (found, p) = t.derivative.as_ref().expect("a derivative");
        assert_eq!(*found, order);
        let value = |x: f64| p.iter().rev().fold(0.0, |sum, c| sum * x + c);
        let from = t.tail_from;
        assert!(from > 1.0, "{from}");
        for at in [0.25, 1.0f64.next_down()] {
            assert_eq!(
                t.at(turns(at)),
                t.integrated(turns(at), Turns::cis, velocity)
            );
        }
        for at in [1.0, 0.5 * (1.0 + from), from.next_down()] {
            let at = turns(at);
            let power = Complex64::new(0.0, -1.0 / at.radians()).powi(order as i32 - 1);
            let due = t.integrated(at, Turns::cis, value) * power;
            assert_eq!(t.at(at), due);
            let plain = t.integrated(at, Turns::cis, velocity);
            assert!(
                (due - plain).norm() < 1e-13 * (1.0 + velocity(0.0).abs()),
                "{due} {plain}"
            );
        }
        for at in [from, 2.0 * from] {
            let at = turns(at);
            let due = jumps(t.knots().expect("knots"), t.centre, at);
            assert_eq!(t.at(at), due);
            let plain = t.integrated(at, Turns::cis, velocity);
            assert!(
                (due - plain).norm() < 1e-13 * (1.0 + velocity(0.0).abs()),
                "{due} {plain}"
            );
        }
    }
}

#[test]
fn two_ways_of_sines() {
    for (fraction, from) in [(0.25, 1.0), (0.96875, 1.496)] {
        let law = MotionLaw::modified_sine();
        let law = law.with_acceleration_fraction(fraction).expect("a law");
        let t = Transform::new(&law);
        let Shape::Scca(s) = law.shape() else {
            panic!("{law:?}")
        };
        let tail = t.tail_from;
        assert!((tail - from).abs() < 1e-3, "{tail}");
        let velocity = |x: f64| law.motion(x).expect("a place").velocity;
        let below = turns(tail.next_down());
        assert_eq!(t.at(below), t.integrated(below, Turns::cis, velocity));
        for at in [tail, 1.25 * tail, 2.0 * tail] {
            let due = scca(s, fraction, turns(at));
            assert_eq!(t.at(turns(at)), due);
            let plain = t.integrated(turns(at), Turns::cis, velocity);
            assert!((due - plain).norm() < 1e-14, "{at}: {due} {plain}");
        }
    }
}

/// Of the law with constant acceleration `F = (sin(q/4)/(q/4))²`: beside its double zeros all
/// digits stay.
#[test]
fn beside_double_zeros() {
    let t = Transform::new(&MotionLaw::constant_acceleration());
    for zero in [2.0, 10.0, 400.0] {
        for off in [1e-3, 1e-6, -1e-9] {
            let at = zero * (1.0 + off);
            // Exact: the zero is a few bits long.
            let (beyond, q) = (at - zero, TAU * at);
            let due = ((TAU * 0.25 * beyond).sin() / (0.25 * q)).powi(2);
            let got = t.at(turns(at));
            assert!((got.re / due - 1.0).abs() < 1e-14, "{at}: {got} {due}");
            assert_eq!(got.im, 0.0);
        }
    }
}

/// An even velocity has a real transform, whichever way it is computed.
#[test]
fn even_velocities() {
    for law in [MotionLaw::cycloidal(), MotionLaw::polynomial_345()] {
        let t = Transform::new(&law);
        for at in [0.05, 0.7, 3.3] {
            assert_eq!(t.at(turns(at)).im, 0.0);
        }
        assert_eq!(t.less_one(turns(0.05)).expect("short").im, 0.0);
        let uneven = Transform::new(&law.with_acceleration_fraction(0.4).expect("a law"));
        assert!(uneven.at(turns(0.7)).im.abs() > 1e-4);
    }
}

/// Each piece in as many panels as it has turns, with 20 nodes each.
#[test]
fn a_panel_for_each_turn() {
    let t = Transform::new(&MotionLaw::polynomial_345());
    assert_eq!(t.pieces, [0.0, 0.5, 1.0]);
    for (at, panels) in [(0.0, 2), (0.5, 2), (2.0, 2), (2.5, 4), (4.0, 4), (7.0, 8)] {
        let asked = Cell::new(0);
        let one = |_: f64| {
            asked.set(asked.get() + 1);
            1.0
        };
        t.integrated(turns(at), Turns::cis, one);
        assert_eq!(asked.get(), 20 * panels, "{at}");
    }
}

#[test]
fn jumps_in_the_middle_beside_equal_halves() {
    for fraction in [0.05f64, 0.3, 0.499, 0.6, 0.95] {
        for j in 0..=7 {
            let due = (2.0 - 2.0 * fraction).powi(-j) - (2.0 * fraction).powi(-j);
            let size = (2.0 - 2.0 * fraction)
                .powi(-j)
                .max((2.0 * fraction).powi(-j));
            assert!(
                (difference(j, fraction) - due).abs() <= 1e-14 * size,
                "{fraction} {j}"
            );
        }
    }
    // 2je of first order.
    let e = 2f64.powi(-40);
    for j in 1..=7 {
        let off = difference(j, 0.5 + 0.5 * e) / (2.0 * f64::from(j) * e) - 1.0;
        assert!(off.abs() < 1e-15, "{j}: {off:e}");
    }
}

/// The shortest half, too, has a number of turns from which its jumps, added up, are small.
#[test]
fn jumps_of_the_shortest_halves_serve_in_time() {
    for law in [MotionLaw::polynomial_345(), MotionLaw::polynomial_4567()] {
        for fraction in [1e-3, 1.0 - 1e-3] {
            let law = law.clone().with_acceleration_fraction(fraction);
            let from = Transform::new(&law.expect("a law")).tail_from;
            assert!((1.0..9e3).contains(&from), "{fraction}: {from}");
        }
    }
}
