use super::*;
use crate::pinned::{bit_by_bit, counted, units};
use mechaudit_reference::Mag;
use rug::{Float, Rational};

fn at(a: [f64; 2], b: [f64; 2]) -> Rectangle {
    Rectangle { a, b }
}

fn value(w: f64, error: f64) -> Value {
    Value {
        least: w,
        most: w,
        error,
    }
}

fn is_near(x: f64, due: f64) -> bool {
    x >= due && x <= due * (1.0 + 1e-9)
}

#[test]
fn the_least_and_the_largest_of_re_z_squared() {
    for (a, b) in [
        ([3.1, 3.3], [1.7, 1.9]),
        ([0.0, 0.3], [2.1, 7.7]),
        ([0.1, 5.0], [0.2, 9.0]),
    ] {
        let found = decay(&at(a, b));
        let exact = |x: f64, y: f64| {
            let [x, y] = [x, y].map(|x| Rational::from_f64(x).expect("finite").square());
            x - y
        };
        let (lo, hi) = (exact(a[0], b[1]), exact(a[1], b[0]));
        assert!(found.lo <= lo && hi <= found.hi);
        let room = 1e-13;
        assert!(found.lo >= lo.to_f64() - room && found.hi <= hi.to_f64() + room);
    }
}

#[test]
fn the_exponential_is_between_its_bounds() {
    for t in [-680.0, -30.5, -1.0, 0.0, 2.5, 45.0, 680.0] {
        let [lo, hi] = exponential([t, t]);
        let exact = Float::with_val(200, Float::with_val(200, -t).exp_ref()) * 2;
        assert!(lo <= exact && exact <= hi, "{t}");
        assert!(hi <= lo * (1.0 + 1e-14), "{t}");
    }
    // Each from its own end.
    let [lo, hi] = exponential([1.0, 3.0]);
    assert!(lo < 0.1 && hi > 0.7);
    // Beyond, what is surely below and above.
    assert_eq!(exponential([690.5, 700.0])[0], 0.0);
    let [lo, hi] = exponential([-700.0, -690.5]);
    assert!(lo > 1e299 && lo < 2.0 * 690f64.exp() && hi == 1e300);
    assert!(!overflows(&at([0.0, 1.0], [26.6, 26.7])) && overflows(&at([0.0, 1.0], [26.8, 27.0])));
    // Not on the whole rectangle.
    assert!(!overflows(&at([0.0, 5.0], [26.8, 27.0])));
    // From what a component overflows on: 2^1024 and more in one of them.
    assert!(
        Float::with_val(100, Float::with_val(100, OVERFLOW).exp_ref())
            > (Float::with_val(100, 1) << 1025u32)
    );
}

/// The estimate is below |w| at all points, and not idle.
#[test]
fn the_least_of_w_is_below_w() {
    for (a, b) in [(0.5, 0.5), (2.2, 1.3), (3.0, 1.0), (1.0, 2.0)] {
        let r = at([a, a + 1e-3], [b, b + 1e-3]);
        let least = least_of_w(&r);
        let sizes = [
            (0.0, 0.0),
            (0.0, 1e-3),
            (1e-3, 0.0),
            (1e-3, 1e-3),
            (5e-4, 5e-4),
        ]
        .map(|(p, q)| {
            let w = w_f64(a + p, -b - q, 80).expect("decided");
            w.re.mid().to_f64().hypot(w.im.mid().to_f64())
        });
        let size = sizes.into_iter().fold(f64::INFINITY, f64::min);
        assert!(
            least <= size && least > 0.97 * size,
            "{a} {b} {least} {size}"
        );
        // The value at the centre less the distance of a corner times the slope there.
        let (d, far) = (
            0.5e-3 * std::f64::consts::SQRT_2,
            (a + 1e-3).hypot(b + 1e-3),
        );
        let most = (sizes[4] + 1.13 * d) / (1.0 - 2.0 * far * d);
        let due = sizes[4] - d * (2.0 * far * most + 1.13);
        assert!((least - due).abs() < 1e-9 * due, "{least} {due}");
    }
}

/// Checks what is known of a value, from those of its components.
#[test]
fn values_of_components() {
    let part = |lo: f64, hi: f64, error: f64, tiny: f64| Tracks {
        exact: Interval::new(lo, hi),
        error,
        tiny,
        small: false,
        relative: f64::INFINITY,
    };
    let w = Value::of(
        [part(3.0, 4.0, 3e-3, 0.0), part(-5.0, -4.0, 4e-3, 0.0)],
        1e-3,
    );
    assert!(w.least <= 4.999 && w.least > 4.9989);
    assert!(is_near(w.most, 41f64.sqrt() + 1e-3) && is_near(w.error, 6e-3));
    assert!(is_near(w.norm(), 6e-3 / w.least * TWO_52 * (1.0 - 1e-15)));
    let w = Value::of([part(3.0, 4.0, 0.0, 1.0), part(4.0, 5.0, 0.0, 2.0)], 0.0);
    assert!(w.error >= 1.5 * TINIEST && w.error <= 4.0 * TINIEST);
    // A value that may be zero has no bound.
    assert_eq!(value(0.0, 1.0).norm(), f64::INFINITY);
    assert_eq!(
        Value::of([part(-1.0, 1.0, 1.0, 0.0); 2], 0.0).norm(),
        f64::INFINITY
    );
}

/// `(e + ρx)/|W − x|` in units of 2⁻⁵² and the last rounding, where one term is the larger one by
/// far and where both are equal.
#[test]
fn errors_of_a_difference_of_two_terms() {
    let rho = 1e-17;
    let e = 1e-16;
    let bound = |w: Value, r: &Rectangle, cancelled: f64| reflected(w, r, rho, cancelled);
    // x = 2e^{−D} at a point.
    let point = |d: f64| {
        let (a, b) = (0.5 * (d / 0.5 + 0.5), 0.5 * (d / 0.5 - 0.5));
        at([a, a], [b, b])
    };
    let x = |d: f64| 2.0 * (-d).exp();
    let d = 3.0;
    for w in [0.5, 0.3, 0.12] {
        let due = (e + rho * x(d)) / (w - x(d)) * TWO_52 + ROUNDINGS;
        assert!(is_near(bound(value(w, e), &point(d), 1e-3), due), "{w}");
    }
    for w in [0.01, 0.05, 0.09] {
        let due = (e + rho * x(d)) / (x(d) - w) * TWO_52 + ROUNDINGS;
        assert!(is_near(bound(value(w, e), &point(d), 1e-3), due), "{w}");
    }
    // The code does not use what is below λW.
    let w = x(d);
    let due = (e + rho * w) / (0.25 * w) * TWO_52 + ROUNDINGS;
    let found = bound(value(w, e), &point(d), 0.25);
    assert!(found >= due && found <= due * 1.3, "{found} {due}");
    // Wide: from where both are equal up to each end.
    let wide = at([2.0, 2.5], [1.0, 1.5]);
    let found = bound(value(w, e), &wide, 0.25);
    let worst = [0.75 * w, 1.25 * w].map(|x| (e + rho * x) / (0.25 * w));
    let due = worst[0].max(worst[1]) * TWO_52 + ROUNDINGS;
    assert!(found >= due && found <= 1.3 * due);
    // An interval of values.
    let some = Value {
        least: 0.3,
        most: 0.5,
        error: e,
    };
    assert!(bound(some, &point(d), 1e-3) >= bound(value(0.3, e), &point(d), 1e-3));
    let some = Value {
        least: 0.01,
        most: 0.09,
        error: e,
    };
    assert!(bound(some, &point(d), 1e-3) >= bound(value(0.09, e), &point(d), 1e-3));
    // Without a lower bound of w there is none of the error.
    assert_eq!(bound(value(0.0, e), &wide, 0.25), f64::INFINITY);
    assert_eq!(bound(value(f64::NAN, e), &wide, 0.25), f64::INFINITY);
    // Nothing is left of λW beside an error of its size.
    assert_eq!(bound(value(w, 0.3 * w), &point(d), 0.25), f64::INFINITY);
}

/// Where e^{−z²} is below what is proved of it, its value counts whole.
#[test]
fn an_exponential_that_is_not_proved_counts_whole() {
    let far = at([27.0, 27.0], [0.5, 0.5]);
    let found = reflected(value(1e-300, 0.0), &far, 0.0, 1e-3);
    assert!(found >= 1e-303 / 1e-300 * TWO_52, "{found}");
    let near = at([25.0, 25.0], [0.5, 0.5]);
    assert!(reflected(value(1e-200, 0.0), &near, 0.0, 1e-3) < 1.0);
}

/// Beside a zero |w| is what it is, not a part of w(−z).
#[test]
fn beside_zeros_by_the_size_of_w() {
    let r = at([2.2, 2.2005], [1.3, 1.3005]);
    let (e, rho) = (1e-17, 1e-18);
    let found = reflected_off_zeros(value(0.3, e), &r, rho);
    let d = decay(&r);
    let due = (e + rho * 2.0 * (-d.lo).exp()) / least_of_w(&r) * TWO_52 + ROUNDINGS;
    assert!((found - due).abs() < 1e-9 * due, "{found} {due}");
    let zero = at([1.99, 2.0], [1.35, 1.36]);
    assert_eq!(
        reflected_off_zeros(value(0.3, e), &zero, rho),
        f64::INFINITY
    );
}

/// Both bounds of an absolute value, from those of its parts.
#[test]
fn sizes_of_numbers_known_to_few_digits() {
    let ball = |x: f64| Ball::exact(100, x).widened(Mag::from_f64(0.25));
    let [least, most] = sizes([&ball(3.25), &ball(-4.25)]);
    assert!((5.0 - 1e-12..=5.0).contains(&least), "{least}");
    let due = f64::hypot(3.5, 4.5);
    assert!((due..=due * (1.0 + 1e-12)).contains(&most), "{most}");
}

/// The bound against the worst of `(e + ρx)/|x − W|` on a grid of all x and W where the value is
/// used.
#[test]
fn differences_on_a_grid_are_below_their_bound() {
    let mut unit = units(31);
    let (mut close, mut finite) = (0, 0);
    for _ in 0..400 {
        let (a, b) = (0.5 + 2.0 * unit(), 0.5 + 2.0 * unit());
        let side = 0.3 * unit() * unit();
        let r = at([a, a + side], [b, b + side]);
        let d = decay(&r);
        let [lo, hi] = exponential([d.lo, d.hi]);
        let least = lo * 2f64.powf(6.0 * unit() - 3.0);
        let w = Value {
            least,
            most: least * (1.0 + 0.3 * unit()),
            error: 1e-17 * least,
        };
        let (rho, cancelled) = (1e-17 * unit(), 0.02 + 0.3 * unit());
        let found = reflected(w, &r, rho, cancelled);
        let mut worst = 0.0f64;
        let step = |i: u32, [lo, hi]: [f64; 2]| lo + (hi - lo) * f64::from(i) / 200.0;
        for i in 0..=200 {
            for j in [0, 50, 100, 150, 200] {
                let (x, size) = (step(i, [lo, hi]), step(j, [w.least, w.most]));
                let off = (x - size).abs();
                if off >= cancelled * size {
                    worst = worst.max((w.error + rho * x) / off);
                }
            }
        }
        let due = worst * TWO_52 + ROUNDINGS;
        assert!(
            found >= due * (1.0 - 1e-12),
            "{found} {due} {w:?} {lo} {hi}"
        );
        finite += usize::from(found.is_finite());
        close += usize::from(found <= 1.1 * due);
    }
    assert!(finite == 400 && close > 250, "{finite} {close}");
}

/// Bounds of a difference where its terms are equal at a corner or one is twice the other, and at
/// the ends of what is proved.
#[test]
fn differences_bit_by_bit() {
    let mut unit = units(5);
    let mut all = Vec::new();
    for i in 0..120 {
        let (a, b) = (0.5 + 3.0 * unit(), 0.5 + 3.0 * unit());
        let side = if i % 3 == 0 { 0.0 } else { 0.2 * unit() };
        let r = at([a, a + side], [b, b + side]);
        let [lo, hi] = exponential([decay(&r).lo, decay(&r).hi]);
        let least = [lo, hi, 2.0 * hi, 0.5 * lo, 0.5 * (lo + hi)][i % 5];
        let w = Value {
            least,
            most: least * [1.0, 1.3][i % 2],
            error: least * [0.0, 1e-30, 1e-17, 0.03][i % 4],
        };
        for (rho, cancelled) in [(0.0, 0.0), (1e-17, 0.25), (1e-31, 0.02)] {
            all.push(reflected(w, &r, rho, cancelled));
        }
        all.extend([least_of_w(&r), reflected_off_zeros(w, &r, 1e-31)]);
    }
    // Re z² meets the end of what is proved, and w overflows.
    let near = |x: f64| (0..17).map(move |i| f64::from_bits(x.to_bits() + i - 8));
    let points = |d: f64| {
        [0.0, 0.5, 1.5, 5.0].map(|b| near((d + b * b).sqrt()).map(move |a| at([a, a], [b, b])))
    };
    let far = points(700.0).into_iter().flatten();
    all.extend(far.map(|r| reflected(value(1e-303, 0.0), &r, 0.0, 1e-3)));
    let turned = points(OVERFLOW).into_iter().flatten();
    let over: Vec<bool> = turned.map(|r| overflows(&at(r.b, r.a))).collect();
    let found = [counted("differences", all), counted("overflow", over)];
    let due = [
        ("differences", 0xf34718d226584ea9, 668.0),
        ("overflow", 0xe1b6601fb417595e, 68.0),
    ];
    bit_by_bit(&found, &due);
}
