use super::*;
use crate::pinned::units;
use rug::Rational;

/// A rational function of two coordinates, over a rectangle and at a point of it.
#[test]
fn values_at_points_are_enclosed() {
    let mut unit = units(3);
    for _ in 0..500 {
        let (x0, y0) = (1.0 + 4.0 * unit(), 0.5 + unit());
        let (x1, y1) = (x0 + unit(), y0 + unit());
        let coordinates = [Interval::new(x0, x1), Interval::new(y0, y1)];
        let [x, y] = [0, 1].map(|i| Exact::coordinate(coordinates[i], i));
        let r2 = x.square() + y * y;
        let q = (x.square() + -(y.square())).over(r2);
        let value = q * x + -(x.over(y)) + Exact::within(Interval::new(0.5, 0.5));
        let halved = value.scaled(0.5, value.range * Interval::point(0.5));
        for _ in 0..20 {
            let at = |lo: f64, hi: f64, t: f64| (lo + (hi - lo) * t).clamp(lo, hi);
            let (a, b) = (at(x0, x1, unit()), at(y0, y1, unit()));
            let [a, b] = [a, b].map(|x| Rational::from_f64(x).expect("finite"));
            let (aa, bb) = (Rational::from(&a * &a), Rational::from(&b * &b));
            let q = Rational::from(&aa - &bb) / Rational::from(&aa + &bb);
            let due = (q * &a - Rational::from(&a / &b) + Rational::from((1, 2))) / 2;
            let [lo, hi] = [halved.range.lo, halved.range.hi];
            let end = |x: f64| Rational::from_f64(x).expect("finite");
            assert!(end(lo) <= due && due <= end(hi));
        }
    }
}

#[test]
fn what_two_values_share_cancels() {
    let x = Exact::coordinate(Interval::new(1.0, 1.25), 0);
    let square = x.square();
    let difference = square + -(x * x);
    assert!(difference.range.magnitude() < 0.05);
    assert!((square.range + -square.range).magnitude() > 0.5);
}

/// `c + s · ξ` within a radius.
fn linear(centre: f64, slopes: [f64; 2], radius: f64) -> Exact {
    let spread = sum_up(sum_up(slopes[0].abs(), slopes[1].abs()), radius);
    Exact {
        range: Interval::point(centre).widened(spread),
        centre,
        slopes,
        radius,
    }
}

/// The largest distance of `of(x, y)` from the linear part of a result, over the corners of ξ and
/// of both radii.
fn farthest(result: &Exact, [x, y]: [&Exact; 2], of: impl Fn(f64, f64) -> f64) -> f64 {
    const SIGNS: [f64; 2] = [1.0, -1.0];
    let mut most = 0.0f64;
    for (a, b) in SIGNS.into_iter().flat_map(|a| SIGNS.map(|b| (a, b))) {
        let at = |e: &Exact| e.centre + e.slopes[0] * a + e.slopes[1] * b;
        for (p, q) in SIGNS.into_iter().flat_map(|p| SIGNS.map(|q| (p, q))) {
            let exact = of(at(x) + p * x.radius, at(y) + q * y.radius);
            most = most.max((exact - at(result)).abs());
        }
    }
    most
}

/// Checks that what a linear function leaves out of sums, products and quotients is within its
/// radius, and little less.
#[test]
fn radii_are_needed_and_enough() {
    let numbers = [
        linear(3.0, [0.25, 0.0], 0.0),
        linear(-3.0, [0.25, -0.125], 0.0),
        linear(2.0, [0.0, 0.0], 0.0625),
        linear(5.0, [0.125, 0.25], 0.03125),
        linear(-1.5, [0.0, 0.25], 0.125),
    ];
    for x in &numbers {
        for y in &numbers {
            let near = |found: &Exact, off: f64, few: f64| {
                assert!(
                    found.radius >= off * (1.0 - 1e-12),
                    "{x:?} {y:?} {found:?} {off}"
                );
                assert!(
                    found.radius <= few * off + 1e-14,
                    "{x:?} {y:?} {found:?} {off}"
                );
            };
            let sum = *x + *y;
            near(&sum, farthest(&sum, [x, y], |p, q| p + q), 1.0 + 1e-12);
            let product = *x * *y;
            near(&product, farthest(&product, [x, y], |p, q| p * q), 2.0);
            let ratio = x.over(*y);
            near(&ratio, farthest(&ratio, [x, y], |p, q| p / q), 2.5);
            let scaled = x.scaled(-0.5, x.range * Interval::point(-0.5));
            near(
                &scaled,
                farthest(&scaled, [x, y], |p, _| -0.5 * p),
                1.0 + 1e-12,
            );
            // The range is the better of both.
            for found in [sum, product, ratio, scaled] {
                let spread = found.spread() + found.radius;
                let ends = [found.centre - spread, found.centre + spread];
                assert!(found.range.lo >= ends[0] - 1e-14 && found.range.hi <= ends[1] + 1e-14);
            }
        }
    }
    // All signs positive: attained.
    let (x, y) = (
        linear(3.0, [0.25, 0.0], 0.125),
        linear(5.0, [0.0, 0.5], 0.0625),
    );
    let product = x * y;
    let off = farthest(&product, [&x, &y], |p, q| p * q);
    assert!((product.radius - off).abs() < 1e-14);
    let square = x.square();
    assert!(square.radius >= farthest(&square, [&x, &x], |p, _| p * p));
    assert!(square.range.lo >= 0.0 && (-x).square().range.lo >= 0.0);
    let minus = -y;
    assert_eq!(
        (minus.centre, minus.slopes, minus.radius),
        (-5.0, [0.0, -0.5], 0.0625)
    );
}

/// The roundings of a centre and of slopes are in the radius.
#[test]
fn roundings_are_counted() {
    let mut more = units(5);
    let mut unit = || 1.0 + more();
    let exact = |x: f64| Rational::from_f64(x).expect("finite");
    let few = |sum: &Exact, off: Rational| {
        assert!(exact(sum.radius) >= off, "{sum:?} {off}");
        assert!(sum.radius < 1e-14, "{sum:?}");
    };
    for _ in 0..1000 {
        let (x, y, s) = (unit(), unit(), unit());
        let (p, q) = (Exact::point(x), Exact::point(3.0 * y));
        let sum = p + q;
        let due = exact(x) + exact(3.0 * y);
        few(&sum, (exact(sum.centre) - due).abs());
        let product = p * q;
        let due = exact(x) * exact(3.0 * y);
        few(&product, (exact(product.centre) - due).abs());
        let ratio = p.over(q);
        let due = exact(x) / exact(3.0 * y);
        few(&ratio, (exact(ratio.centre) - due).abs());
        // Slopes: 2⁻⁶⁰ of them, so that what is of second order is nothing.
        let small = 2f64.powi(-60);
        let (p, q) = (
            linear(x, [s * small, 0.0], 0.0),
            linear(y, [0.3 * s * small, small], 0.0),
        );
        let product = p * q;
        let due = [
            exact(x) * exact(q.slopes[0]) + exact(y) * exact(p.slopes[0]),
            exact(x) * exact(q.slopes[1]),
        ];
        let off = (0..2).map(|i| (exact(product.slopes[i]) - &due[i]).abs());
        let off = off.fold(
            (exact(product.centre) - exact(x) * exact(y)).abs(),
            |a, b| a + b,
        );
        few(&product, off);
        let sum = p + q;
        let off = (exact(sum.slopes[0]) - exact(p.slopes[0]) - exact(q.slopes[0])).abs();
        few(&sum, off);
        assert!(sum.slopes[1] == small);
        // A power of two below the normal numbers.
        let least = 2f64.powi(-537) * 2f64.powi(-530);
        let scaled = p.scaled(least, p.range * Interval::point(least));
        let off = (exact(scaled.centre) - exact(x) * exact(least)).abs();
        assert!(exact(scaled.radius) >= off && scaled.radius < 1e-320);
    }
}

#[test]
fn unknown_numbers_are_not_believed() {
    let whole = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
    let x = linear(3.0, [0.25, 0.0], 0.0);
    let wide = Exact::within(whole);
    for found in [x + wide, x * wide, wide.over(x), wide.square()] {
        assert!(found.range.hi == f64::INFINITY, "{found:?}");
    }
    // By what may be zero, or has a centre of zero.
    for y in [
        linear(0.125, [0.25, 0.0], 0.0),
        linear(0.0, [0.25, 0.0], 0.0),
    ] {
        assert_eq!(x.over(y).range, whole);
    }
    assert_eq!((x * Exact::ZERO).range, Interval::ZERO);
    assert_eq!(
        [(x + Exact::ZERO).range, (Exact::ZERO + x).range],
        [x.range; 2]
    );
    // A number beyond the range of f64 as a product.
    let far = Exact::point(1e300);
    assert!((far * far).range.hi == f64::INFINITY);
    assert!((far * far + x).range.hi == f64::INFINITY);
    assert_eq!(x.scaled(0.0, Interval::ZERO).range, Interval::ZERO);
}
