//! The bounds of the head, and balls beside the general evaluation.

use super::cells::TERMS;
use super::fixed_point::SCALE;
use super::*;
use crate::Mag;
use crate::faddeeva::argument::Argument;
use crate::faddeeva::{general, ziv};
use rug::{Float, Rational};

/// Where a recurrence of error bounds ends.
fn settled(next: impl Fn([f64; 2]) -> [f64; 2]) -> [f64; 2] {
    (0..1000).fold([0.0; 2], |e, _| next(e))
}

/// `1/Γ(n/2 + 1)`.
fn coefficient(n: usize) -> f64 {
    let first = [1.0, std::f64::consts::FRAC_2_SQRT_PI][n % 2];
    (2..=n)
        .skip(n % 2)
        .step_by(2)
        .fold(first, |c, k| c * 2.0 / k as f64)
}

/// Sizes of sums and slopes, the recurrences of errors, and the tails, all in units of 2^-122 and
/// below 2^9.
#[test]
fn bounds_are_those_of_the_head() {
    let r = 2f64.powf(-1.5);
    let sum = |from: usize, slope: bool| -> f64 {
        let term = |n: usize| {
            let k = (n - from) as i32;
            let power = if slope {
                f64::from(k) * r.powi(k - 1)
            } else {
                r.powi(k)
            };
            coefficient(n) * power
        };
        (from..100).map(term).sum()
    };
    for from in 0..TERMS {
        assert!(sum(from, false) < 2.0 && sum(from, true) < 3.0, "{from}");
    }
    let [complex, _] = settled(|[e, _]| [r * e + 2f64.sqrt() * (6.0 + 4.0 + 1.0), 0.0]);
    assert!(complex <= 25.0);
    let [e, f] = settled(|[e, f]| {
        let product = 3.0;
        [
            e / 4.0 + f / 16.0 + 2.0 * product + 2.0 + 3.0 * 4.0 + 1.0,
            e + f / 4.0 + product + 3.0,
        ]
    });
    assert!(e <= 33.0 && f <= 52.0, "{e} {f}");
    let [ez, fz] = settled(|[e, f]| {
        let product = 3.0;
        [
            e / 16.0 + f / 64.0 + 2.0 * product + 2.0 * 8.0 + 3.0 * 16.0 + 1.0,
            e + f / 16.0 + product + 3.0 * 8.0,
        ]
    });
    assert!(ez <= 80.0 && fz <= 115.0, "{ez} {fz}");
    let twisted = ez + 2.0 * (fz / 16.0 + 3.0 * 4.0 + 3.0);
    let unit = 2f64.powi(SCALE as i32);
    let tail = |slope: bool| -> f64 {
        let term = |n: usize| {
            let power = r.powi(n as i32 - i32::from(slope));
            let factor = if slope { n as f64 } else { 1.0 };
            factor * power * coefficient(n) * unit
        };
        (TERMS..200).map(term).sum()
    };
    let [plain, steep] = [tail(false), tail(true)];
    assert!(plain <= 4.0 && steep <= 240.0, "{plain} {steep}");
    // The value of `Part` for each of these.
    let most = Part::plain(0).ball().rad().to_float().to_f64() * unit;
    for bound in [
        complex + plain,
        e + plain,
        f + steep,
        twisted + plain + 2.0 * steep / 16.0,
    ] {
        assert!(bound <= most, "{bound} {most}");
    }
}

fn real(x: f64) -> Real {
    Real::Double(x)
}

/// By the general evaluation.
fn truth(x: &Real, y: &Real, member: Member) -> ComplexBall {
    let z = Argument::new(x.clone(), y.clone());
    let value = ziv::decide("", 300, 3000, |prec| general::general(&z, member, prec));
    ziv::balls(value.unwrap(), 300).unwrap()
}

/// How much of either radius is taken.
fn shares(found: &ComplexBall, due: &ComplexBall) -> [f64; 2] {
    [(&found.re, &due.re), (&found.im, &due.im)].map(|(a, b)| {
        let off = Float::with_val(400, a.mid() - b.mid()).abs();
        match off.is_zero() {
            true => 0.0,
            false => (off / a.rad().to_float()).to_f64(),
        }
    })
}

/// In the corners of cells of all kinds, where the tails are largest.
#[test]
fn radii_of_cells_hold_and_a_four_hundredth_of_them_would_not() {
    for (i, j) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (6.0, 3.0)] {
        let mut most = 0.0f64;
        for s in -20..=20 {
            for t in [-19.99, -17.0, -11.0, 7.0, 17.0, 19.99] {
                let x: f64 = i / 2.0 + f64::from(s) / 80.003;
                let y: f64 = j / 2.0 + t / 80.003;
                if x < 0.0 || y < 0.0 {
                    continue;
                }
                for member in [Member::W, Member::Dawson] {
                    let found = parts(&real(x), &real(y), member, 60).unwrap();
                    let share = shares(&found, &truth(&real(x), &real(y), member));
                    assert!(share.iter().all(|s| *s <= 1.0), "{x} {y} {share:?}");
                    most = most.max(share[0]).max(share[1]);
                }
            }
        }
        assert!(most > 1.0 / 400.0, "{i} {j}: {most}");
    }
}

fn same(a: &ComplexBall, b: &ComplexBall) -> bool {
    let same = |a: &Ball, b: &Ball| a.mid() == b.mid() && a.rad() == b.rad();
    same(&a.re, &b.re) && same(&a.im, &b.im)
}

/// Cells end at 9.74 in either coordinate.
#[test]
fn the_border_of_the_cells() {
    let coordinate = |x: f64| Coordinate::new(&real(x)).unwrap();
    let inside = LIMIT.next_down();
    for (x, y) in [(inside, 3.0), (3.0, inside), (inside, inside)] {
        let found = parts(&real(x), &real(y), Member::W, 60).unwrap();
        let due = near(&coordinate(x), &coordinate(y), Wanted::Upper).unwrap();
        assert!(same(&found, &due), "{x} {y}");
    }
    for (x, y) in [(LIMIT, 3.0), (3.0, LIMIT), (LIMIT, LIMIT)] {
        let found = parts(&real(x), &real(y), Member::W, 60).unwrap();
        let due = far(&coordinate(x), &coordinate(y), Wanted::Upper, 60).unwrap();
        assert!(same(&found, &due), "{x} {y}");
    }
}

/// As many bits as are there, and no more.
#[test]
fn components_have_the_bits_asked_for() {
    for (x, y) in [(1.3, 0.7), (0.3, 0.1), (2.0, 6.0)] {
        let found = parts(&real(x), &real(y), Member::W, 60).unwrap();
        let bits = found.re.accuracy_bits().min(found.im.accuracy_bits()) as u32;
        assert!(
            bits > 100 && w(&real(x), &real(y), bits).is_some(),
            "{x} {y}"
        );
        assert!(w(&real(x), &real(y), bits + 1).is_none(), "{x} {y}");
    }
}

/// Far out the exponential is not computed where it is nothing: t would be beyond 2^15.
#[test]
fn far_out_nothing_is_declined() {
    for (x, y) in [
        (1e6, 1.0),
        (1e6, 1e-3),
        (1e4, 20.0),
        (300.0, 1e-6),
        (11.0, 0.5),
        (12.0, 1e-30),
    ] {
        for bits in [30, 60, 100] {
            let z = (real(x), real(y));
            let dawson = parts(&z.0, &z.1, Member::Dawson, bits);
            let [above, below] = [y, -y].map(|y| w(&z.0, &real(y), bits));
            for found in [dawson, above, below] {
                assert!(found.is_some(), "{x} {y} {bits}");
            }
        }
    }
    // Beside the imaginary axis too, the small component to as many bits.
    for (x, y) in [(1e-30, 20.0), (1e-300, 9.8), (1e-3, 1e5), (0.5, 11.0)] {
        assert!(w(&real(x), &real(y), 100).is_some(), "{x} {y}");
    }
}

/// `found` is `due` or a little more, in units of `of`.
fn is(found: Mag, due: f64, of: f64) {
    let found = found.to_float().to_f64() / of;
    assert!(
        found >= due * (1.0 - 1e-3) && found <= 1.5 * due,
        "{found} {due}"
    );
}

/// Beside the real axis W has the exponential in its radius once above the axis and twice below,
/// and D once.
#[test]
fn an_exponential_left_out_is_in_the_radius() {
    let (x, y) = (real(10.0), 2f64.powi(-20));
    let at = |y: f64, member| parts(&x, &real(y), member, 104).unwrap();
    let (above, below, dawson) = (at(y, Member::W), at(-y, Member::W), at(y, Member::Dawson));
    let more = |a: &Ball, b: &Ball| a.rad().sub_below(b.rad());
    let e = (-100f64).exp();
    is(more(&above.re, &dawson.re), 1.0, e);
    is(more(&below.re, &dawson.re), 1.0, e);
    is(more(&dawson.im, &above.im), 1.0, e);
    is(more(&below.im, &above.im), 2.0, e);
    // Nothing else is different.
    assert!(*above.re.mid() == -below.re.mid().clone() && above.im.mid() == below.im.mid());
    assert!(above.re.mid() == dawson.re.mid() && above.im.mid() == dawson.im.mid());
}

/// Where it is more than what may be missing of the real part, it is added: `c` above, `2c − c` and
/// `2s` below.
#[test]
fn an_exponential_that_counts_is_added() {
    let (x, y) = (9.75, 2f64.powi(-18));
    let at = |y: f64| parts(&real(x), &real(y), Member::W, 104).unwrap();
    let (above, below) = (at(y), at(-y));
    let e = (y * y - x * x).exp();
    let near = |found: Float, due: f64| assert!((found.to_f64() / due - 1.0).abs() < 1e-3);
    near(
        Float::with_val(300, below.im.mid() - above.im.mid()),
        2.0 * e * (2.0 * x * y).sin(),
    );
    near(
        Float::with_val(300, below.re.mid() + above.re.mid()),
        2.0 * e * (2.0 * x * y).cos(),
    );
    let shares =
        [(y, above), (-y, below)].map(|(y, w)| shares(&w, &truth(&real(x), &real(y), Member::W)));
    assert!(
        shares.as_flattened().iter().all(|s| *s <= 1.0),
        "{shares:?}"
    );
}

/// Floats whose squares or quotients leave MPFR's range, and coordinates whose doubles are
/// infinite.
#[test]
fn exponents_beyond_the_range_are_declined() {
    let p = |k: i32| Real::Float(Float::with_val(64, 1) << k);
    let (small, large) = (-1_000_000_000, 600_000_000);
    for (x, y) in [
        (large, 0),
        (small, large),
        (small, 5),
        (3, small),
        (small, small),
    ] {
        for member in [Member::W, Member::Dawson] {
            assert!(parts(&p(x), &p(y), member, 60).is_none(), "{x} {y}");
        }
    }
    // The double of x is infinite, that of y is not, and yet they are as near as may be.
    let edge = |n: i32| {
        let part = Rational::from(1) - Rational::from((n, 100)) / (1i64 << 54);
        part << 1024
    };
    let (x, y) = (Real::Rational(edge(99)), Real::Rational(edge(101)));
    assert!(parts(&x, &y, Member::W, 60).is_none());
}
