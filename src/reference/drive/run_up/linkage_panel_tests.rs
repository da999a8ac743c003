//! Joints that miss the true ones by a known analytic function: the panel has to hold the true reduced quantities,
//! and Cauchy's estimates have to be within a stated factor of necessary.

use super::*;
use crate::Decimal;
use crate::class_iii::{ExactAngle, Linkage};
use crate::run_up::tests::{geometry, masses};

const BITS: u32 = 160;
const ORDER: usize = 400;

struct Setup {
    mechanism: Mechanism,
    disc: Ball,
    pin: Vector,
    c: Vector,
    d: Vector,
}

/// A panel of the sand screen, of half-width `h` in radians.
fn setup(h: (i32, i32)) -> Setup {
    let phi = ExactAngle::Degrees(Rational::from(50)).to_ball(BITS);
    let linkage = Linkage::new(&geometry(), BITS);
    let at = linkage.modes(&phi).unwrap()[2].configuration.clone();
    let mechanism = Mechanism::new(&geometry(), &masses("9.81"), BITS);
    let disc = Ball::rational(BITS, &Rational::from(h)).shift(1);
    let crank = |order: usize| {
        let (c, s) = TaylorModel::cos_sin(&phi, &disc, order);
        Vector([c.scaled(&mechanism.crank), s.scaled(&mechanism.crank)])
    };
    let series = mechanism.series(&crank(ORDER), &at, ORDER);
    let series = series.expect("the joints are developed");
    let model = |k: usize| TaylorModel::polynomial(series[k].clone());
    Setup {
        pin: crank(series[0].len() - 1),
        c: Vector([model(0), model(1)]),
        d: Vector([model(2), model(3)]),
        mechanism,
        disc,
    }
}

/// `size · x^k` on the disc.
fn miss(size: f64, k: usize) -> TaylorModel {
    let mut c = vec![Float::new(BITS); k + 1];
    c[k] = Float::with_val(BITS, size);
    TaylorModel::polynomial(c)
}

#[test]
fn cauchy_s_estimates_hold_and_are_needed() {
    let s = setup((1, 50));
    let none = Mag::power_of_two(-120);
    let exact = s
        .mechanism
        .reduced(&s.pin, &s.c, &s.d, none, &s.disc, ORDER);
    let size = 1e-6;
    // The largest part of the radius that is used: of I_n, its slope and M_o.
    let mut most = [0.0f64; 3];
    for k in [1, 2, 3, 6] {
        for sign in [1.0, -1.0] {
            let c = Vector([s.c.0[0].plus(&miss(sign * size, k)), s.c.0[1].clone()]);
            let d = Vector([s.d.0[0].clone(), s.d.0[1].plus(&miss(size, k))]);
            let radius = Mag::from_f64(size).add(none);
            let panel = s.mechanism.reduced(&s.pin, &c, &d, radius, &s.disc, ORDER);
            let pairs = [
                (&panel.inertia, &exact.inertia),
                (&panel.slope, &exact.slope),
                (&panel.moment, &exact.moment),
            ];
            for (i, (model, truth)) in pairs.into_iter().enumerate() {
                for w in [-1.0, -0.5, 0.0, 0.75, 1.0] {
                    let w = Ball::exact(BITS, w);
                    let (model, truth) = (model.eval(&w), truth.eval(&w));
                    assert!(model.contains_ball(&truth), "{i} x^{k}");
                    let way = Float::with_val(64, model.mid() - truth.mid()).abs();
                    most[i] = most[i].max((way / model.rad().to_float()).to_f64());
                }
            }
        }
    }
    assert!(most.iter().all(|m| *m > 1.0 / 200.0), "{most:?}");
}

#[test]
fn what_does_not_contract_is_refused() {
    let s = setup((1, 50));
    let tiny = Mag::power_of_two(-100);
    let small = s.mechanism.contraction(&s.pin, &s.c, &s.d, ORDER, tiny);
    assert!(small.is_some_and(|r| r < Mag::power_of_two(-60)));
    // The centre known to centimetres only: the Jacobian turns too much over so wide a box.
    for known in [0.02, 0.05, 0.1, 0.3, 1.0] {
        let known = Mag::from_f64(known);
        let refused = s.mechanism.contraction(&s.pin, &s.c, &s.d, ORDER, known);
        assert!(refused.is_none(), "{known:?}");
    }
    // Joints that are not those of the linkage have a residual that no radius takes in.
    let moved = Vector([s.c.0[0].plus(&miss(0.05, 0)), s.c.0[1].clone()]);
    let refused = s.mechanism.contraction(&s.pin, &moved, &s.d, ORDER, tiny);
    assert!(refused.is_none());
}

/// Each joint's coordinate missing by `size · x^k`: only q ≤ ½ is shown, so the radius is twice the step back, and
/// little more.
#[test]
fn the_radius_is_twice_what_is_missing() {
    let s = setup((1, 50));
    let tiny = Mag::power_of_two(-120);
    let size = 1e-6;
    for joint in 0..4 {
        for k in [0, 1, 5] {
            let (mut c, mut d) = (s.c.clone(), s.d.clone());
            let v = if joint < 2 { &mut c } else { &mut d };
            v.0[joint % 2] = v.0[joint % 2].plus(&miss(size, k));
            let r = s.mechanism.contraction(&s.pin, &c, &d, ORDER, tiny);
            let r = r.expect("it contracts").to_f64();
            assert!((1.99..3.0).contains(&(r / size)), "{joint} x^{k}: {r}");
        }
    }
}

/// Second differences of the four equations, which are quadratic, against the bound on the change of their Jacobian:
/// it holds, and is no more than 3.5 times what occurs.
#[test]
fn entries_of_the_jacobian_change_by_no_more() {
    for (lb, turn) in [("0", 0), ("0.22", -39), ("2", 45), ("3", 100)] {
        let shape = Geometry {
            lb: Decimal::parse(lb).unwrap().value,
            phi_b: ExactAngle::Degrees(Rational::from(turn)),
            ..geometry()
        };
        let mechanism = Mechanism::new(&shape, &masses("9.81"), BITS);
        let of = |z: &ComplexBall| [z.re.to_f64(), z.im.to_f64()];
        let (k, l) = (of(&mechanism.kappa), of(&mechanism.one_minus_kappa));
        // Half the squared distances, whose constant and linear parts do not count.
        let g = |z: [f64; 4]| {
            let [cx, cy, dx, dy] = z;
            let square = |x: f64, y: f64| 0.5 * (x * x + y * y);
            [
                square(cx, cy),
                square(dx, dy),
                square(dx - cx, dy - cy),
                square(
                    l[0] * cx - l[1] * cy + k[0] * dx - k[1] * dy,
                    l[0] * cy + l[1] * cx + k[0] * dy + k[1] * dx,
                ),
            ]
        };
        let mut most = 0.0f64;
        for signs in 0..16u32 {
            let way: [f64; 4] =
                std::array::from_fn(|i| if signs >> i & 1 == 1 { 1.0 } else { -1.0 });
            for j in 0..4 {
                let unit: [f64; 4] = std::array::from_fn(|i| f64::from(u8::from(i == j)));
                let both = std::array::from_fn(|i| way[i] + unit[i]);
                for (e, x) in g(both).into_iter().enumerate() {
                    most = most.max((x - g(way)[e] - g(unit)[e]).abs());
                }
            }
        }
        let bound = mechanism.lipschitz().to_f64();
        assert!(
            most <= bound * (1.0 + 1e-12) && bound < 3.5 * most,
            "{lb}: {most} {bound}"
        );
    }
}

/// The radius is no smaller than what is known of the centre, so that the zero there is the one that is continued.
#[test]
fn the_radius_takes_in_the_centre() {
    let s = setup((1, 50));
    let known = Mag::power_of_two(-20);
    let radius = s.mechanism.contraction(&s.pin, &s.c, &s.d, ORDER, known);
    assert!(radius.is_some_and(|r| r >= known));
}
