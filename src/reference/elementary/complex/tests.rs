//! Identities, cuts, radii, and boxes of every kind.

use super::super::tests::hostile;
use super::*;
use rug::Float;

type Complex = fn(&ComplexBall, u32) -> ComplexEvaluated;

/// Functions, and the share of the radius of a small box that is used at least, away from their
/// singularities.
const ALL: [(&str, Complex, f64); 38] = [
    ("exp", exp, 0.5),
    ("expm1", expm1, 0.5),
    ("log", log, 0.5),
    ("log1p", log1p, 0.5),
    ("sqrt", sqrt, 0.5),
    ("cbrt", cbrt, 0.5),
    ("recip", recip, 0.4),
    ("sin", sin, 0.5),
    ("cos", cos, 0.5),
    ("tan", tan, 0.4),
    ("sinh", sinh, 0.5),
    ("cosh", cosh, 0.5),
    ("sech", sech, 0.4),
    ("tanh", tanh, 0.4),
    ("asin", asin, 0.5),
    ("acos", acos, 0.5),
    ("atan", atan, 0.5),
    ("asinh", asinh, 0.5),
    ("acosh", acosh, 0.5),
    ("atanh", atanh, 0.5),
    ("erf", erf, 0.4),
    ("erfc", erfc, 0.4),
    ("erfi", erfi, 0.4),
    ("erfcx", erfcx, 0.02),
    ("w", w, 0.02),
    ("dawson", dawson, 0.05),
    ("tgamma", tgamma, 0.1),
    ("inverse_gamma", inverse_gamma, 0.1),
    ("lgamma", lgamma, 0.05),
    ("airyai", airyai, 0.2),
    ("airyaiprime", airyaiprime, 0.05),
    ("airybi", airybi, 0.2),
    ("airybiprime", airybiprime, 0.05),
    ("si", si, 0.05),
    ("ci", ci, 0.05),
    ("e1", e1, 0.2),
    ("lambertw", lambertw, 0.4),
    ("zeta", zeta, 0.2),
];

const P: u32 = 160;
const HIGH: u32 = 400;

/// In each quadrant and on each axis.
pub(super) const PLACES: [(f64, f64); 9] = [
    (1.0, 0.0),
    (0.75, 0.5),
    (0.5, -0.75),
    (0.0, 1.0),
    (0.0, -1.0),
    (-0.5, 0.875),
    (-0.75, -0.25),
    (-1.0, 0.0),
    (0.97, 0.01),
];

pub(super) fn point(x: f64, y: f64) -> ComplexBall {
    ComplexBall::new(Ball::exact(64, x), Ball::exact(64, y))
}

fn about(x: f64, y: f64, r: f64) -> ComplexBall {
    point(x, y).widened(Mag::from_f64(r))
}

/// The places at these distances from zero.
pub(super) fn at_distances(sizes: [f64; 4]) -> Vec<(f64, f64)> {
    let at = |size| PLACES.map(|(x, y)| (size * x, size * y));
    sizes.into_iter().flat_map(at).collect()
}

/// Checks that values about these middles hold those at points of the boxes, where there are any.
pub(super) fn boxes_hold(
    f: impl Fn(&ComplexBall, u32) -> ComplexEvaluated,
    middles: &[(f64, f64)],
    radii: &[f64],
) {
    for &(x, y) in middles {
        for &r in radii {
            let Ok(found) = f(&about(x, y, r), 80) else {
                continue;
            };
            for (s, t) in PLACES {
                let value = f(&point(x + 0.99 * r * s, y + 0.99 * r * t), 120).unwrap();
                assert!(found.overlaps(&value), "{x} {y} {r}: {found:?} {value:?}");
            }
        }
    }
}

/// Exact points of a box.
fn points(z: &ComplexBall) -> Vec<ComplexBall> {
    let at = |x: &Ball, t: f64| {
        let off = Float::with_val(HIGH, x.rad().to_float() * Float::with_val(53, t));
        Ball::new(Float::with_val(HIGH, x.mid() + off), Mag::ZERO)
    };
    let places = [
        (0.0, 0.0),
        (1.0, 1.0),
        (1.0, -1.0),
        (-1.0, 1.0),
        (-1.0, -1.0),
        (1.0, 0.0),
        (0.0, 1.0),
        (0.3, -0.6),
    ];
    places
        .map(|(s, t)| ComplexBall::new(at(&z.re, s), at(&z.im, t)))
        .to_vec()
}

/// The greater share of the two radii at which a value lies.
fn share(found: &ComplexBall, value: &ComplexBall) -> f64 {
    let of = |b: &Ball, v: &Ball| {
        let off = Ball::new(Float::with_val(HIGH, v.mid() - b.mid()), Mag::ZERO);
        off.magnitude().div(b.rad()).to_f64()
    };
    of(&found.re, &value.re).max(of(&found.im, &value.im))
}

#[test]
fn small_boxes_hold_values_and_little_else() {
    for (name, f, needed) in ALL {
        for (x, y) in [
            (0.7, 0.6),
            (-1.3, 0.8),
            (2.5, -0.4),
            (-0.2, -2.5),
            (7.3, 3.1),
        ] {
            for r in [1e-18, 1e-9, 1e-6] {
                let z = about(x, y, r);
                let found = f(&z, P).unwrap();
                let shares = points(&z)
                    .into_iter()
                    .map(|z| share(&found, &f(&z, HIGH).unwrap()));
                let most = shares.fold(0.0, f64::max);
                assert!(most <= 1.0 + 1e-12, "{name} {x} {y} {r}: {most}");
                assert!(most >= needed, "{name} {x} {y} {r}: {most}");
            }
        }
    }
}

/// Checks values of a function in boxes of all widths and places.
fn wide_boxes_hold(name: &str, f: Complex) {
    for (x, y) in [
        (0.7, 0.6),
        (-1.3, 0.8),
        (2.5, -0.4),
        (-0.2, -2.5),
        (0.0, 0.0),
        (1.7, 4.5),
        (-3.3, 9.0),
        (6.0, 0.1),
    ] {
        for r in [1e-3, 0.03, 0.2, 1.0, 3.0] {
            let z = about(x, y, r);
            let Ok(found) = f(&z, P) else {
                continue;
            };
            for z in points(&z) {
                let value = f(&z, HIGH).unwrap();
                assert!(share(&found, &value) <= 1.0 + 1e-12, "{name} {x} {y} {r}");
            }
        }
    }
}

/// Functions whose parts over a wide rectangle have formulas of their own.
const BY_PARTS: [&str; 3] = ["recip", "sqrt", "sech"];

#[test]
fn wide_boxes_hold_values() {
    for (name, f, _) in ALL {
        if !BY_PARTS.contains(&name) {
            wide_boxes_hold(name, f);
        }
    }
}

#[test]
fn formulas_for_wide_rectangles_hold_values() {
    for (name, f, _) in ALL {
        if BY_PARTS.contains(&name) {
            wide_boxes_hold(name, f);
        }
    }
}

fn is_near(found: ComplexEvaluated, x: f64, y: f64) {
    let z = found.unwrap();
    let near = |b: &Ball, x: f64| {
        b.distance_from(x).1 <= Mag::from_f64(x).shift(-48).add(Mag::power_of_two(-90))
    };
    assert!(near(&z.re, x) && near(&z.im, y), "{z:?} {x} {y}");
}

/// On a cut the limit from above, or from the right; across it nothing.
#[test]
fn cuts_belong_to_the_upper_side() {
    use std::f64::consts::{FRAC_PI_2, PI};
    is_near(log(&point(-1.0, 0.0), 64), 0.0, PI);
    is_near(log(&point(-1.0, -0.0), 64), 0.0, PI);
    is_near(sqrt(&point(-4.0, -0.0), 64), 0.0, 2.0);
    is_near(
        asin(&point(2.0, 0.0), 64),
        FRAC_PI_2,
        1.316_957_896_924_816_7,
    );
    is_near(acos(&point(2.0, 0.0), 64), 0.0, -1.316_957_896_924_816_7);
    is_near(acosh(&point(-2.0, 0.0), 64), 1.316_957_896_924_816_7, PI);
    is_near(
        atanh(&point(2.0, 0.0), 64),
        0.549_306_144_334_054_8,
        FRAC_PI_2,
    );
    is_near(
        asinh(&point(0.0, 2.0), 64),
        1.316_957_896_924_816_7,
        FRAC_PI_2,
    );
    is_near(lgamma(&point(-0.5, 0.0), 64), 1.265_512_123_484_645_4, -PI);
    for f in [log, sqrt, cbrt, lgamma] {
        assert!(matches!(
            f(&about(-1.5, 0.01, 0.1), 64),
            Err(NoValue::Undecided(_))
        ));
        let on = ComplexBall::new(
            Ball::exact(64, -1.5),
            Ball::exact(64, 0.25).widened(Mag::from_f64(0.25)),
        );
        assert!(f(&on, 64).is_ok_and(|z| z.is_finite()));
    }
    for f in [asin, acos, atanh] {
        assert!(f(&about(1.5, 0.01, 0.1), 64).is_err() && f(&about(0.5, 0.01, 0.1), 64).is_ok());
    }
    for f in [asinh, atan] {
        assert!(f(&about(0.01, -1.5, 0.1), 64).is_err() && f(&about(0.01, 0.5, 0.1), 64).is_ok());
    }
    assert!(
        acosh(&about(0.5, 0.01, 0.1), 64).is_err() && acosh(&about(1.5, 0.01, 0.1), 64).is_ok()
    );
    for (f, x) in [
        (log as Complex, 0.0),
        (recip, 0.0),
        (log1p, -1.0),
        (atanh, 1.0),
        (lgamma, -2.0),
        (tgamma, 0.0),
    ] {
        assert!(
            matches!(f(&point(x, 0.0), 64), Err(NoValue::Undefined(_))),
            "{x}"
        );
        assert!(
            matches!(f(&about(x, 0.0, 0.01), 64), Err(NoValue::Undecided(_))),
            "{x}"
        );
    }
}

#[test]
fn powers_and_special_values() {
    let power = |x: &ComplexBall, y: &ComplexBall| pow(x, y, 64);
    is_near(power(&point(0.0, 1.0), &point(2.0, 0.0)), -1.0, 0.0);
    is_near(
        power(&point(0.0, 1.0), &point(0.0, 1.0)),
        0.207_879_576_350_761_9,
        0.0,
    );
    is_near(power(&point(3.0, 4.0), &point(-1.0, 0.0)), 0.12, -0.16);
    is_near(power(&point(0.0, 0.0), &point(0.0, 0.0)), 1.0, 0.0);
    is_near(power(&point(0.0, 0.0), &point(0.5, 3.0)), 0.0, 0.0);
    assert!(matches!(
        power(&point(0.0, 0.0), &point(-1.0, 0.0)),
        Err(NoValue::Undefined(_))
    ));
    // No cut where the exponent is an integer, small or large.
    for n in [3.0, 1025.0] {
        let z = about(-1.0, 0.0, 1e-6);
        let found = power(&z, &point(n, 0.0)).unwrap();
        assert!(found.re.is_negative() && found.im.contains_zero());
    }
    is_near(div(&point(1.0, 2.0), &point(3.0, 4.0), 64), 0.44, 0.08);
    is_near(tan(&point(1.0, 1e9), 64), 0.0, 1.0);
    is_near(
        erf(&point(1.0, 1.0), 64),
        1.316_151_281_697_947_6,
        0.190_453_469_237_834_68,
    );
    is_near(
        tgamma(&point(1.0, 1.0), 64),
        0.498_015_668_118_356,
        -0.154_949_828_301_810_7,
    );
    is_near(
        lgamma(&point(0.0, 10.0), 64),
        -15.940_317_281_241_316,
        12.232_116_647_435_004,
    );
}

/// `Γ(z + 1) = z Γ(z)`, left and right of where it is reflected, and `Γ(z̄) = conj Γ(z)`.
#[test]
fn gamma_obeys_its_equation() {
    for (x, y) in [
        (0.3, 0.1),
        (-0.4, 0.2),
        (-7.6, -0.3),
        (5.5, 20.0),
        (-3.0, 1e-6),
        (0.5, 40.0),
    ] {
        for bits in [30, 120, 600] {
            let z = point(x, y);
            let up = plus(&z, 1, 200).unwrap();
            let (a, b) = (tgamma(&z, bits).unwrap(), tgamma(&up, bits).unwrap());
            assert!((&a * &z).overlaps(&b), "{x} {y} {bits}");
            let good = |z: &ComplexBall| z.radius() <= z.magnitude().shift(4 - i64::from(bits));
            assert!(good(&a) && good(&b), "{x} {y} {bits}");
            let (a, b) = (lgamma(&z, bits).unwrap(), lgamma(&up, bits).unwrap());
            let sum = &a + &log(&z, bits).unwrap();
            // The sum has no jump off the cut.
            assert!(sum.overlaps(&b), "{x} {y} {bits}");
            let other = tgamma(&z.conj(), bits).unwrap();
            assert!(other.overlaps(&tgamma(&z, bits).unwrap().conj()));
        }
    }
}

#[test]
fn no_box_panics_or_runs_without_end() {
    let balls: Vec<Ball> = hostile().into_iter().step_by(101).collect();
    for x in &balls {
        for y in &balls {
            let z = ComplexBall::new(x.clone(), y.clone());
            for (name, f, _) in ALL {
                let found = f(&z, 64);
                assert!(!found.is_ok_and(|w| !w.is_finite()), "{name} {z:?}");
            }
            for other in [
                point(2.0, 0.0),
                point(0.5, 1.0),
                ComplexBall::new(y.clone(), x.clone()),
            ] {
                assert!(!pow(&z, &other, 64).is_ok_and(|w| !w.is_finite()));
                assert!(!div(&z, &other, 64).is_ok_and(|w| !w.is_finite()));
            }
        }
    }
}

/// Next to a cut, closer than any double.
#[test]
fn both_sides_of_a_cut_have_their_values() {
    let bessel = |which| move |z: &ComplexBall, p| bessel(which, &(1, 2).into(), z, p);
    let [first, modified] = [Bessel::First, Bessel::Modified].map(bessel);
    type Function<'a> = &'a dyn Fn(&ComplexBall, u32) -> ComplexEvaluated;
    let functions: [Function; 5] = [&lgamma, &first, &modified, &log, &e1];
    for (k, f) in functions.into_iter().enumerate() {
        let [above, below] = [1, -1].map(|sign| {
            let im = Float::with_val(53, sign) >> 5000u32;
            let re = Float::with_val(53, -1.5);
            let [re, im] = [re, im].map(|x| Ball::new(x, Mag::ZERO));
            f(&ComplexBall::new(re, im), 64).unwrap().im
        });
        assert!(below.overlaps(&-&above) && !below.overlaps(&above), "{k}");
    }
}
