//! Joints that miss the true ones by a known analytic function: the panel has to hold the true
//! reduced quantities, and Cauchy's estimates have to be within a stated factor of necessary.

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

/// Each joint's coordinate missing by `size · x^k`: only q ≤ ½ is shown, so the radius is twice the
/// step back, and little more.
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

/// Second differences of the four equations, which are quadratic, against the bound on the change
/// of their Jacobian: it holds, and is no more than 3.5 times what occurs.
#[test]
fn entries_of_the_jacobian_change_by_no_more() {
    for (lb, turn) in [("0", 0), ("0.22", -39), ("2", 45), ("3", 100), ("3", 0)] {
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

/// The Jacobian over the disc is the derivative of the equations: exact central differences, as
/// they are quadratic.
#[test]
fn the_jacobian_is_that_of_the_equations() {
    let s = setup((1, 50));
    let links = |c: &Vector, d: &Vector| s.mechanism.links(&s.pin, c, d);
    let jacobian = s.mechanism.jacobian(&links(&s.c, &s.d));
    for joint in 0..4 {
        let moved = |way: f64| {
            let (mut c, mut d) = (s.c.clone(), s.d.clone());
            let v = if joint < 2 { &mut c } else { &mut d };
            v.0[joint % 2] = v.0[joint % 2].plus(&miss(way, 0));
            links(&c, &d).map(|v| v.squared(ORDER))
        };
        let (up, down) = (moved(1.0), moved(-1.0));
        for e in 0..4 {
            for x in [-1.0, 0.0, 0.5, 1.0] {
                let x = Ball::exact(BITS, x);
                // Half the squares, over a way of 2.
                let due = (up[e].eval(&x) - down[e].eval(&x)).shift(-2);
                let found = jacobian[e][joint].eval(&x.with_prec(64));
                assert!(
                    (found - due).magnitude() < Mag::power_of_two(-55),
                    "{e} {joint}"
                );
            }
        }
    }
}

/// Every entry of `I − Y J` counts, and every entry of Y.
#[test]
fn norms_count_every_entry() {
    let s = setup((1, 50));
    let jacobian = s.mechanism.jacobian(&s.mechanism.links(&s.pin, &s.c, &s.d));
    let centre = jacobian.each_ref().map(|row| {
        row.each_ref().map(|t| {
            let c = t.coefficients()[0].to_f64();
            TaylorModel::constant(&Ball::exact(64, c))
        })
    });
    let value = |i: usize, k: usize| centre[i][k].coefficients()[0].to_f64();
    let inverse = Matrix4::from_fn(value).try_inverse().unwrap();
    for i in 0..4 {
        for k in 0..4 {
            let mut y = inverse;
            for m in 0..4 {
                y[(i, m)] -= 5.0 * inverse[(k, m)];
            }
            let off = norms(&y, &centre).0.to_f64();
            assert!((off - 5.0).abs() < 1e-9, "{i} {k}: {off}");
            let mut y = Matrix4::from_element(0.25);
            y[(i, k)] = -7.0;
            assert!(
                (norms(&y, &centre).1.to_f64() - 7.75).abs() < 1e-9,
                "{i} {k}"
            );
        }
    }
    // Over the disc J changes; Y is the centre's.
    let over = norms(&inverse, &jacobian).0.to_f64();
    let at = |x: f64| {
        let j = Matrix4::from_fn(|i, k| jacobian[i][k].eval(&Ball::exact(64, x)).to_f64());
        let off = Matrix4::identity() - inverse * j;
        (0..4).map(|i| off.row(i).abs().sum()).fold(0.0, f64::max)
    };
    let most = at(1.0).max(at(-1.0));
    assert!(
        most > 0.005 && (most..3.0 * most).contains(&over),
        "{most} {over}"
    );
}

/// Functions of modulus one on the disc whose derivative at ¾ or ⅔ is the greatest there is, `1/(1
/// − x²)` (Schwarz and Pick): Cauchy's estimates hold them and are less than twice as large.
#[test]
fn the_fastest_functions_are_held() {
    let size = 1e-3;
    let blaschke = |a: f64| {
        let c = (0..600).map(|k| match k {
            0 => -a,
            _ => (1.0 - a * a) * a.powi(k - 1),
        });
        TaylorModel::polynomial(c.map(|x| Float::with_val(BITS, x * size)).collect())
    };
    let square = miss(1.0, 2);
    let one = Ball::integer(BITS, 1);
    let near = |found: &Ball, due: f64| {
        let way = (found.mid().to_f64() - due).abs() / found.rad().to_f64();
        assert!(way < 1.0 && way > 0.5, "{way}");
    };
    let outer = Ball::rational(BITS, &Rational::from((3, 4)));
    assert!(blaschke(0.75).eval(&one).magnitude() <= Mag::from_f64(size * (1.0 + 1e-9)));
    let found = rate(&square, &outer, Mag::from_f64(size)).eval(&one);
    near(&found, 0.75 * (1.5 + size / (1.0 - 0.75 * 0.75)));
    let inner = Ball::rational(BITS, &Rational::from((2, 3)));
    let found = slope(&square.widened(Mag::from_f64(size)), &inner).eval(&one);
    near(&found, 2.0 * 2.0 / 3.0 + size / (1.0 - 4.0 / 9.0));
}

/// I_n, its derivative and M_o of a panel against those of class III's own kinematics, over the
/// whole of it.
#[test]
fn panels_are_those_of_the_linkage() {
    let phi = ExactAngle::Degrees(Rational::from(50)).to_ball(BITS);
    let linkage = Linkage::new(&geometry(), BITS);
    let at = linkage.modes(&phi).unwrap()[2].configuration.clone();
    let masses = masses("9.81");
    let mechanism = Mechanism::new(&geometry(), &masses, BITS);
    let h = Ball::rational(BITS, &Rational::from((1, 50)));
    let panel = mechanism.panel(&phi, &at, &h).expect("it contracts");
    for w in [-1.0, -0.375, 0.0, 0.5, 1.0] {
        let w = Ball::exact(BITS, w);
        let there = linkage.follow(&at, &phi, &(&phi + &(&h * &w))).unwrap();
        let due = linkage.reduce(&linkage.kinematics(&there).unwrap(), &masses);
        for (found, due) in [
            (&panel.inertia, &due.inertia),
            (&panel.slope, &due.inertia_derivative),
            (&panel.moment, &due.moment),
        ] {
            let found = found.eval(&w);
            assert!(
                found.overlaps(due) && found.accuracy_bits() > 100,
                "{found:?} {due:?}"
            );
        }
    }
    // The uncertainty of the centre, in any coordinate, is part of the proof.
    for joint in 0..4 {
        let mut wide = at.clone();
        let parts = [
            &mut wide.c.re,
            &mut wide.c.im,
            &mut wide.d.re,
            &mut wide.d.im,
        ];
        for (k, part) in parts.into_iter().enumerate() {
            if k == joint {
                *part = part.widened(Mag::from_f64(0.1));
            }
        }
        assert!(mechanism.panel(&phi, &wide, &h).is_none(), "{joint}");
    }
}

/// The radius is no smaller than what is known of the centre, so that the zero there is the one
/// that is continued.
#[test]
fn the_radius_takes_in_the_centre() {
    let s = setup((1, 50));
    let known = Mag::power_of_two(-20);
    let radius = s.mechanism.contraction(&s.pin, &s.c, &s.d, ORDER, known);
    assert!(radius.is_some_and(|r| r >= known));
}

/// A contraction by no more than a half is enough, and the next larger radius is refused.
#[test]
fn contractions_go_up_to_a_half() {
    let s = setup((1, 50));
    let jacobian = s.mechanism.jacobian(&s.mechanism.links(&s.pin, &s.c, &s.d));
    let centre = |i: usize, k: usize| jacobian[i][k].coefficients()[0].to_f64();
    let y = Matrix4::from_fn(centre).try_inverse().unwrap();
    let (off, rows) = norms(&y, &jacobian);
    let change = s.mechanism.lipschitz().shift(2);
    let q = |bits: u64| off.add(rows.mul(change).mul(Mag::from_f64(f64::from_bits(bits))));
    let half = Mag::from_f64(0.5);
    let (mut low, mut high) = (1e-9f64.to_bits(), 1f64.to_bits());
    while high - low > 1 {
        let mid = low + (high - low) / 2;
        if q(mid) <= half {
            low = mid;
        } else {
            high = mid;
        }
    }
    let proved = |bits: u64| {
        let known = Mag::from_f64(f64::from_bits(bits));
        let r = s.mechanism.contraction(&s.pin, &s.c, &s.d, ORDER, known);
        r.is_some()
    };
    assert!(proved(low) && !proved(high));
}

/// 2 of the equations of two joints, or s², with the widths of κ and 1 − κ.
#[test]
fn changes_of_the_jacobian_count_what_is_not_known() {
    let mut mechanism = Mechanism::new(&geometry(), &masses("9.81"), BITS);
    let part = |mid: f64, rad: f64| Ball::exact(BITS, mid).widened(Mag::from_f64(rad));
    mechanism.one_minus_kappa = ComplexBall::new(part(0.0, 0.0), part(0.0, 0.0));
    for (re, im, due) in [
        (part(1.0, 0.0), part(-0.25, 0.0), 2.0),
        (part(1.0, 0.5), part(-0.5, 0.0), 4.0),
        (part(-1.0, 0.0), part(0.5, 0.5), 4.0),
    ] {
        mechanism.kappa = ComplexBall::new(re, im);
        let found = mechanism.lipschitz().to_f64();
        assert!((due..due * (1.0 + 1e-12)).contains(&found), "{found} {due}");
    }
}

/// Three terms in a row have to be small: how many are taken for panels of any width.
#[test]
fn how_many_terms_are_taken() {
    let s = setup((1, 50));
    let phi = ExactAngle::Degrees(Rational::from(50)).to_ball(BITS);
    let linkage = Linkage::new(&geometry(), BITS);
    let at = linkage.modes(&phi).unwrap()[2].configuration.clone();
    let terms = [1, 3, 9, 20, 31, 40, 57, 65, 83, 100, 140, 171, 200].map(|part| {
        let disc = Ball::rational(BITS, &Rational::from((part, 1000)));
        let (x, y) = TaylorModel::cos_sin(&phi, &disc, ORDER);
        let pin = Vector([x.scaled(&s.mechanism.crank), y.scaled(&s.mechanism.crank)]);
        let series = s.mechanism.series(&pin, &at, ORDER).unwrap();
        series.each_ref().map(Vec::len)
    });
    assert!(terms.iter().all(|n| n.iter().all(|k| *k == n[0])));
    let due = [18, 20, 23, 26, 29, 30, 33, 34, 36, 38, 42, 45, 47];
    assert_eq!(terms.map(|n| n[0]), due);
}

/// Without a finite pivot that is not zero there is no inverse.
#[test]
fn matrices_without_an_inverse() {
    let inverse = |rows: [[f64; 2]; 2]| {
        let rows = rows.map(|row| row.map(|x| Float::with_val(BITS, x)).to_vec());
        invert(rows.to_vec(), BITS)
    };
    let found = inverse([[0.0, 2.0], [4.0, 1.0]]).unwrap();
    let found: Vec<f64> = found.iter().flatten().map(Float::to_f64).collect();
    assert_eq!(found, [-0.125, 0.25, 0.5, 0.0]);
    assert!(inverse([[1.0, 2.0], [2.0, 4.0]]).is_none());
    assert!(inverse([[0.0, 2.0], [0.0, 4.0]]).is_none());
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(inverse([[bad, 1.0], [1.0, 1.0]]).is_none());
    }
}
