use super::*;
use crate::pinned::{bit_by_bit, counted, largest, of_binades, units};
use mechaudit_reference::{ComplexBall, faddeeva};
use rug::Float;

const BITS: u32 = 400;

fn ball(x: f64) -> Ball {
    Ball::exact(BITS, x)
}

fn size(x: &Ball) -> f64 {
    x.mid().to_f64().abs()
}

/// `(i/√π) Σ_{k ≤ n} a_k f(k) z^{−2k−1−shift}`
fn sum(x: f64, y: f64, n: u32, slope: bool) -> ComplexBall {
    let z = ComplexBall::new(ball(x), ball(y));
    let norm = z.norm_sqr();
    let inverse = z.conj().scaled(&norm.recip());
    let q = &inverse * &inverse;
    let mut power = match slope {
        true => q.clone(),
        false => inverse,
    };
    let mut all = ComplexBall::zero(BITS);
    let mut a = Rational::from(1);
    for k in 0..=n {
        let by = if slope { -(2 * i64::from(k) + 1) } else { 1 };
        let factor = Ball::rational(BITS, &(Rational::from(by) * &a));
        all = &all + &power.scaled(&factor);
        power = &power * &q;
        a *= Rational::from((2 * k + 1, 2));
    }
    all.turned().scaled(&Ball::pi(BITS).sqrt().recip())
}

fn w(x: f64, y: f64) -> ComplexBall {
    let exact = |x: f64| Rational::from_f64(x).expect("finite");
    faddeeva::w(&exact(x), &exact(y), BITS).expect("decided")
}

/// `e^{−z²}`
fn gaussian(x: f64, y: f64) -> ComplexBall {
    let (x, y) = (ball(x), ball(y));
    let size = (&y.square() - &x.square()).exp();
    ComplexBall::unit(&-(&x * &y).shift(1)).scaled(&size)
}

/// The series at points of rectangles off the axes, beside each of them, and where `e^{−z²}`
/// counts: what it leaves out, of each component divided by the small coordinate where it has one.
#[test]
fn what_is_left_out_is_below_its_bounds() {
    let mut most = [0.0f64; 3];
    for (terms, near) in [
        (26u32, 7.2),
        (16, 8.0),
        (14, 11.0),
        (6, 30.0),
        (4, 150.0),
        (2, 1100.0),
    ] {
        for (a, b) in [
            ([1.0, 1.001], [1.0, 1.001]),
            ([1.0, 1.001], [0.3, 0.301]),
            ([1.0, 1.001], [1e-9, 0.01]),
            ([1.0, 1.001], [0.01, 0.2]),
            ([1e-9, 0.01], [1.0, 1.001]),
            ([0.3, 0.301], [1.0, 1.001]),
            ([1.0, 1.001], [0.9, 0.901]),
        ] {
            let at = Rectangle {
                a: a.map(|x| x * near),
                b: b.map(|x| x * near),
            };
            let found = asymptotic(terms, &at);
            for (x, y) in [(at.a[0], at.b[0]), (at.a[0], at.b[1]), (at.a[1], at.b[0])] {
                let off = &w(x, y) - &sum(x, y, terms, false);
                // Below the diagonal e^{−z²} is in the real part alone.
                let norm = size(&off.norm_sqr().sqrt());
                let beside = y <= x && size(&gaussian(x, y).re) > 1e-3 * norm;
                let tiny = found.tiny * f64::from_bits(1);
                let re = size(&off.re) / if at.small_im() { y } else { 1.0 };
                let im = size(&off.im) / if at.small_re() { x } else { 1.0 };
                assert!(re <= found.re + tiny, "{terms} {x} {y} {re:e} {found:?}");
                assert!(im <= found.im || beside, "{terms} {x} {y} {im:e} {found:?}");
                assert!(
                    norm <= found.norm || beside,
                    "{terms} {x} {y} {norm:e} {found:?}"
                );
                for (m, (off, bound)) in
                    most.iter_mut()
                        .zip([(norm, found.norm), (re, found.re), (im, found.im)])
                {
                    if !beside && bound > 0.0 {
                        *m = m.max(off / bound);
                    }
                }
            }
        }
    }
    assert!(most.into_iter().all(|m| m > 0.5), "{most:?}");
}

/// The bounds by their formulas.
#[test]
fn components_by_their_formulas() {
    let near = |x: f64, due: f64| x >= due * (1.0 - 1e-14) && x <= due * (1.0 + 1e-12);
    let pi_2 = std::f64::consts::FRAC_PI_2;
    let at = |a: [f64; 2], b: [f64; 2]| Rectangle { a, b };
    // Re z small.
    let r = at([0.01, 1.0], [30.0, 30.5]);
    let found = asymptotic(6, &r);
    let (least, slope) = (
        f64::hypot(0.01, 30.0),
        remainder_slope(7, f64::hypot(0.01, 30.0).next_down()),
    );
    assert!(near(found.norm, remainder(7, least)) && near(found.im, pi_2 * slope / least));
    assert!(found.re == found.norm && found.tiny == 0.0 && found.sum.is_none());
    // Not small: along the arc from the axis, or as a whole.
    let r = at([3.0, 3.1], [30.0, 30.5]);
    let least = f64::hypot(3.0, 30.0);
    let found = asymptotic(6, &r);
    let along = pi_2 * remainder_slope(7, least) / least * 3.1;
    assert!(near(found.im, remainder(7, least).min(along)), "{found:?}");
    // Im z small, the exponential below the smallest number; then in sight.
    let r = at([30.0, 30.5], [0.01, 1.0]);
    let found = asymptotic(6, &r);
    let least = f64::hypot(30.0, 0.01);
    let e = (1f64 - 900.0).exp();
    assert!(near(found.re, pi_2 * remainder_slope(7, least) / least) && e == 0.0);
    assert_eq!(found.tiny, 2.0);
    let r = at([9.0, 9.1], [0.1, 1.0]);
    let found = asymptotic(14, &r);
    let (least, far) = (f64::hypot(9.0, 0.1), f64::hypot(9.1, 1.0));
    let e = (1f64 - 81.0).exp();
    let along = pi_2 * (remainder_slope(15, least) + 2.0 * far * far * e) / least;
    assert!(
        near(found.re, along + e / 0.1) && found.tiny == 0.0,
        "{found:?} {along}"
    );
    let r = at([9.0, 9.1], [0.5, 1.0]);
    let found = asymptotic(14, &r);
    let least = f64::hypot(9.0, 0.5);
    let along = pi_2 * (remainder_slope(15, least) + 2.0 * far * far * e) / least;
    assert!(
        near(found.re, remainder(15, least).min(along + e)),
        "{found:?} {along}"
    );
    // Where the exponential is as large as the remainder.
    for (b, small) in [([0.1, 1.0], true), ([0.5, 1.0], false)] {
        let r = at([3.0, 3.1], b);
        let found = asymptotic(6, &r);
        let (least, far) = (f64::hypot(3.0, b[0]), f64::hypot(3.1, 1.0));
        let e = (1f64 - 9.0).exp();
        let along = pi_2 * (remainder_slope(7, least) + 2.0 * far * far * e) / least;
        let due = match small {
            true => along + e / b[0],
            false => remainder(7, least).min(along + e),
        };
        assert!(near(found.re, due), "{found:?} {due}");
        let slope = beside(7, &r);
        assert!(near(slope, along), "{slope} {along}");
    }
    // Components of the order of the other side of the quadrant, where the bound by the arc is the
    // better one.
    let r = at([0.5, 1.0], [3.9, 4.0]);
    let found = asymptotic(26, &r);
    let least = f64::hypot(0.5, 3.9);
    let along = pi_2 * remainder_slope(27, least) / least;
    assert!(near(found.im, remainder(27, least).min(along * 1.0)));
    // With the factor Im z on both sides of the diagonal nothing is known of the real part.
    let r = at([1.0, 30.0], [0.1, 20.0]);
    assert!(!r.small_im() && asymptotic(6, &r).re.is_finite());
    // A factor Im z, but e^{−z²} next to the diagonal or above it: nothing.
    let r = at([0.5, 30.0], [40.0, 41.0]);
    assert!(asymptotic(6, &r).re.is_finite());
    // Decay by the nearest and the farthest corner.
    let d = decay(&at([3.0, 5.0], [1.0, 2.0]));
    assert!(near(d, (4f64 - 9.0).exp()));
    assert_eq!(decay(&at([0.0, 1.0], [1.0, 30.0])), f64::INFINITY);
    assert!(decay(&at([0.0, 1.0], [1.0, 26.0])).is_finite());
    let one = huge();
    assert!(
        one.norm >= 2f64.powi(-600)
            && one.norm < 1e-170
            && one.re == one.norm
            && one.im == one.norm
    );
}

/// Beside the real axis: the two terms of the real part, `y U` and `e^{−z²}`.
#[test]
fn sums_beside_the_real_axis() {
    let at = Rectangle {
        a: [8.5, 8.501],
        b: [1e-9, 1e-6],
    };
    let found = strip(&at);
    let split = found.sum.expect("two terms");
    let mut most = 0.0f64;
    for (x, y) in [(8.5, 1e-9), (8.5, 1e-6), (8.501, 1e-7)] {
        let off = &w(x, y) - &sum(x, y, 16, false);
        assert!(size(&off.norm_sqr().sqrt()) <= found.norm && size(&off.im) <= found.im);
        let e = gaussian(x, y);
        let slope = size(&(&off.re - &e.re)) / y;
        assert!(slope <= split.slope, "{slope:e} {split:?}");
        assert!(size(&e.norm_sqr().sqrt()) <= split.most * (1.0 + 1e-15));
        most = most.max(slope / split.slope);
    }
    assert!(most > 0.3, "{most}");
    assert!(split.most < 1.001 * (-8.5f64 * 8.5).exp() && split.exponential.is_infinite());
    assert!(found.re.is_infinite());
    // The added term, and twice the right one.
    let near = Rectangle {
        a: [3.0, 3.001],
        ..at
    };
    let (found, most) = (strip(&near), decay(&near));
    let alone = asymptotic(16, &near).norm;
    assert!((found.norm - alone - 3.0 * most).abs() < 1e-9 * most);
    // Two terms of one size: the slope of the exponential is in it.
    let (near, far) = (f64::hypot(8.5, 1e-9), f64::hypot(8.501, 1e-6));
    let due = std::f64::consts::FRAC_PI_2
        * (remainder_slope(17, near) + 2.0 * far * far * split.most)
        / near;
    assert!((split.slope / due - 1.0).abs() < 1e-12);
}

/// Next to the real axis: 25 terms of the value and of the slope there, and `e^{−a²}`.
#[test]
fn sums_next_to_the_real_axis() {
    let at = Rectangle {
        a: [9.0, 9.001],
        b: [1e-12, 2f64.powi(-28)],
    };
    let found = on_real_line(&at, [0.0; 2], 0.0);
    let split = found.sum.expect("two terms");
    let mut most = [0.0f64; 3];
    for (a, b) in [(9.0, 1e-12), (9.0, 2f64.powi(-28)), (9.001, 1e-9)] {
        let exact = w(a, b);
        let (value, slope) = (sum(a, 0.0, 24, false), sum(a, 0.0, 24, true));
        let turned = slope.turned().scaled(&ball(b));
        let e = gaussian(a, 0.0);
        let off = &exact - &(&(&value + &turned) + &e);
        let norm = size(&off.norm_sqr().sqrt());
        assert!(
            norm <= found.norm && size(&off.im) <= found.im,
            "{norm:e} {found:?}"
        );
        let here = gaussian(a, b);
        let rest = size(&(&(&exact.re - &here.re) - &turned.re)) / b;
        assert!(rest <= split.slope, "{rest:e} {split:?}");
        let part = size(&(&here.re - &e.re)) / size(&e.re);
        assert!(part <= split.exponential, "{part:e} {split:?}");
        assert!(size(&e.re) <= split.most * (1.0 + 1e-14));
        assert!(turned.re.mid().to_f64() / b >= split.least);
        for (m, (off, bound)) in most.iter_mut().zip([
            (norm, found.norm),
            (rest, split.slope),
            (part, split.exponential),
        ]) {
            *m = m.max(off / bound);
        }
    }
    assert!(most[2] > 0.4 && split.least > 0.563 / 81.1, "{most:?}");
    // Each of what is left out by its formula.
    let near = |x: f64, due: f64| x >= due * (1.0 - 1e-9) && x <= due * (1.0 + 1e-9);
    let (a, b) = (9.0f64, at.b[1]);
    let e = split.most;
    let slope = remainder_slope(25, a) / a;
    let due = 0.0115 * b * b + remainder(25, a) + b * slope + e * (4.0 + 2.0 * at.a[1] * b);
    assert!(near(found.norm, due) && found.im == found.norm && found.re.is_infinite());
    assert!(near(
        split.exponential,
        1.01 * b * b + (2.0 * at.a[1] * b).powi(2)
    ));
    let cubed = 0.7 * a.powi(-4) * b * b;
    assert!(near(split.slope, beside(25, &at) + cubed), "{split:?}");
    assert!(near(split.least, 0.564 / at.a[1].powi(2)));
    // The errors of the polynomials and of the exponential.
    let size = 0.5642 / a.powi(3);
    let more = on_real_line(&at, [1e-3, 0.0], 0.0);
    assert!(near(more.norm - found.norm, size * 1e-3));
    let more = on_real_line(&at, [0.0, 1.0], 0.0);
    assert!(near(more.norm, due + b * size / a));
    assert!(near(
        more.sum.expect("two terms").slope - split.slope,
        size / (a * a)
    ));
    let more = on_real_line(&at, [0.0; 2], 1e-3).sum.expect("two terms");
    assert!(near(more.exponential, 1e-3));
    let below = Rectangle {
        a: [8.899, 8.9],
        ..at
    };
    let none = on_real_line(&below, [0.0; 2], 0.0);
    assert!(
        [none.norm, none.re, none.im]
            .iter()
            .all(|x| x.is_infinite())
            && none.sum.is_none()
    );
    assert!(
        on_real_line(
            &Rectangle {
                a: [8.9, 9.0],
                ..at
            },
            [0.0; 2],
            0.0
        )
        .norm
        .is_finite()
    );
}

/// `1 + s + s² Σ c_j s^j` in two parts of ln 2 against `e^x`.
#[test]
fn the_polynomial_of_the_exponential_is_within_its_error() {
    let ln_2 = std::f64::consts::LN_2;
    let exact = |n: u32| -> Vec<f64> {
        let mut f = 1.0;
        (2..n + 2)
            .map(|k| {
                f /= f64::from(k);
                f
            })
            .collect()
    };
    let worst = |c: &[f64]| {
        let all = (-20..=20).map(|i| {
            let s = Float::with_val(300, 0.348 * f64::from(i) / 20.0);
            let mut sum = Float::with_val(300, 0);
            for c in c.iter().rev() {
                sum = sum * &s + *c;
            }
            let sum = sum * s.clone().square() + &s + 1u32;
            let due = s.exp();
            ((sum - &due) / due).abs().to_f64()
        });
        all.fold(0.0, f64::max)
    };
    let low = (Float::with_val(300, 2).ln() - ln_2).to_f64();
    for n in [2, 3, 5] {
        let c = exact(n);
        let (found, off) = (exponential_error(&c, [ln_2, low], 1.0), worst(&c));
        assert!(off <= found && found <= 1.25 * off, "{n} {off:e} {found:e}");
    }
    for j in [0, 1, 4] {
        let mut c = exact(9);
        c[j] += 1e-3;
        let found = exponential_error(&c, [ln_2, low], 1.0);
        let due = 1e-3 * 0.348f64.powi(j as i32 + 2) / 0.7;
        assert!(
            worst(&c) <= found && found >= due && found <= 1.001 * due,
            "{j} {found}"
        );
    }
    // k times what the two parts lack.
    let found = exponential_error(&exact(12), [ln_2, 0.0], 1e9);
    let due = 1e9 * low * 1.01 / 0.7;
    assert!((found / due - 1.0).abs() < 1e-3, "{found} {due}");
}

/// The stored polynomials against the sums of 24 terms on `0 ≤ v ≤ 1/79`.
#[test]
fn polynomials_of_the_real_line_are_within_their_errors() {
    let line = mechaudit_solvers::faddeeva::proof::real_line_polynomials();
    for (stored, slope) in [(&line[0], false), (&line[1], true)] {
        let worst = |stored: &[f64; 10]| {
            let all = (0..=200).map(|i| {
                let v = Rational::from((i, 79 * 200));
                let (mut due, mut power, mut a) =
                    (Rational::new(), Rational::from(1), Rational::from(1));
                for k in 0..24 {
                    a *= Rational::from((2 * k + 1, 2));
                    let by = if slope { 2 * k + 3 } else { 1 };
                    due += Rational::from(&a * &power) * by;
                    power *= &v;
                }
                let found = stored.iter().rev().fold(Rational::new(), |s, c| {
                    s * &v + Rational::from_f64(*c).expect("finite")
                });
                (found - due).abs().to_f64()
            });
            all.fold(0.0, f64::max)
        };
        let (found, off) = (polynomial_error(stored, slope), worst(stored));
        assert!(off <= found && found <= 2.0 * off, "{off:e} {found:e}");
        for k in [0, 1, 9] {
            let mut other = *stored;
            other[k] += 1e-3 * 79f64.powi(k as i32);
            let (found, off) = (polynomial_error(&other, slope), worst(&other));
            assert!(off <= found && found <= 1.1 * off, "{k} {off:e} {found:e}");
        }
    }
}

/// On the small side of the diagonal a component is bounded along the arc by the farther end of its
/// coordinate; across it by the whole.
#[test]
fn components_by_their_farther_end() {
    let of = |a, b| asymptotic(2, &Rectangle { a, b });
    let near = f64::hypot(400.0, 10.0);
    let along = std::f64::consts::FRAC_PI_2 * remainder_slope(3, near) / near;
    let is = |x: f64| (x / (along * 20.0) - 1.0).abs() < 1e-12;
    let (right, left) = (
        of([400.0, 401.0], [10.0, 20.0]),
        of([10.0, 20.0], [400.0, 401.0]),
    );
    assert!(is(right.re) && is(left.im) && right.re < right.norm);
    // On both sides of the diagonal, e^{−z²} may be of any size.
    let across = of([40.0, 45.0], [20.0, 44.0]);
    assert_eq!(across.re, across.norm);
    let decayed = of([0.0, 2.0], [20.0, 44.0]);
    assert_eq!((decayed.re, decayed.tiny), (decayed.norm, 0.0));
}

/// Next to the real axis, where each of these counts little beside the others.
#[test]
fn small_parts_of_the_line() {
    let near = |x: f64, due: f64| (x / due - 1.0).abs() < 1e-12;
    let slope = remainder_slope(25, 9.0) / 9.0;
    assert!(near(line_slope(9.0, 0.0), slope));
    assert!(near(line_slope(9.0, 90.0 * slope), 11.0 * slope));
    assert!(near(exponentials_of_line(9.0, 0.5), 13.0));
    let at = Rectangle {
        a: [9.0, 9.1],
        b: [1e-9, 1e-8],
    };
    let strip = strip(&at);
    let line = on_real_line(&at, [0.0; 2], 0.0);
    assert_eq!((strip.sum.map(|s| s.least), line.tiny), (Some(0.0), 0.0));
    let none = on_real_line(
        &Rectangle {
            a: [1.0, 2.0],
            ..at
        },
        [0.0; 2],
        0.0,
    );
    assert_eq!((none.tiny, none.norm), (0.0, f64::INFINITY));
}

/// From zero to the end, each begins where the one before ends.
#[test]
fn pieces_cover_all() {
    let (centres, half) = pieces();
    let mut end = Rational::new();
    for centre in centres {
        assert_eq!(Rational::from(&centre - &half), end);
        end = centre + &half;
    }
    assert_eq!(end, Rational::from((1, 79)));
}

#[test]
fn a_polynomial_about_another_centre() {
    let c: Vec<Rational> = (1..8).map(|k| Rational::from((k * k, 7 - 2 * k))).collect();
    let value =
        |c: &[Rational], x: &Rational| c.iter().rev().fold(Rational::new(), |s, c| s * x + c);
    let centre = Rational::from((3, 5));
    let found = shifted(&c, &centre);
    for x in [0, 1, -2, 5] {
        let x = Rational::from((x, 3));
        let there = Rational::from(&x + &centre);
        assert_eq!(value(&found, &x), value(&c, &there));
    }
}

/// Truncations over rectangles beside both axes, the diagonal and where the exponential is nothing,
/// and errors of what is stored.
#[test]
fn truncations_bit_by_bit() {
    let mut unit = units(14);
    let at = |a: [f64; 2], b: [f64; 2]| Rectangle { a, b };
    let mut all = vec![
        at([8.0, 8.0], [8.0, 8.0]),
        at([8.0, 8.5], [7.5, 8.0]),
        at([8.0, 8.5], [7.5, 8.5]),
        at([0.0, 1e-3], [9.0, 9.5]),
        at([9.0, 9.5], [0.0, 1e-3]),
        at([9.0, 9.5], [1e-200, 1e-9]),
        at([26.0, 26.5], [1e-3, 1e-2]),
        at([30.0, 30.5], [1e-3, 1e-2]),
        at([27.0, 27.3], [1e-9, 1e-2]),
        at([8.9, 9.0], [0.0, 1e-9]),
        at([8.9f64.next_down(), 9.0], [0.0, 1e-9]),
        at([1.0, 2.0], [26.0, 27.0]),
        at([1.0, 2.0], [37.0, 38.0]),
        at([0.0, 1.0], [10.0 * 7f64.sqrt(), 10.0 * 7f64.sqrt()]),
    ];
    for _ in 0..60 {
        let [a, b] = [0; 2].map(|_| 6.0 + 20.0 * unit());
        let side = of_binades(&mut unit, [-8, 0]);
        all.push(at([a, a + side], [b, b + side]));
        all.push(at([a + 3.0, a + 3.0 + side], [0.0, 1e-9 * side]));
    }
    // An exponent that is the limit itself.
    let top = 700f64.sqrt().to_bits();
    let edge = (top - 20..top + 20).map(f64::from_bits);
    let edge = edge.map(|b| decay(&at([0.0, 1.0], [0.0, b])));
    let decays: Vec<f64> = all.iter().map(decay).chain(edge).collect();
    let series = all
        .iter()
        .flat_map(|r| [2, 4, 6, 14, 26].map(|n| asymptotic(n, r)));
    let lines = all.iter().map(|r| on_real_line(r, [1e-17, 1e-16], 1e-18));
    let c: Vec<f64> = (2..14)
        .map(|n| 1.0 / (1..=n).map(f64::from).product::<f64>())
        .collect();
    let ln_2 = [std::f64::consts::LN_2, 2.3e-17];
    let stored: [f64; 10] = std::array::from_fn(|k| (0..=k).map(|j| j as f64 + 0.5).product());
    let found = [
        ("decays", crate::pinned::digest(&decays), decays[5]),
        counted("series", series),
        counted("strips", all.iter().map(strip)),
        counted("lines", lines),
        counted("scaled", [huge()]),
        largest(
            "exponential",
            [0, 5, 12].map(|n| exponential_error(&c[..n], ln_2, 1200.0)),
        ),
        largest(
            "polynomials",
            [false, true].map(|slope| polynomial_error(&stored, slope)),
        ),
    ];
    let due = [
        ("decays", 0xca95d2f445a4e713, 6.639677199580923e-36),
        ("series", 0x0cea9d146b47197d, 670.0),
        ("strips", 0x81537f25f45f0e1c, 134.0),
        ("lines", 0x66931332802bf43a, 134.0),
        ("scaled", 0xba14ce170488dcb1, 1.0),
        ("exponential", 0x405429801a0531c6, 0.08909794285714327),
        ("polynomials", 0xd746ac7ac105f083, 1.03989204529308),
    ];
    bit_by_bit(&found, &due);
}
