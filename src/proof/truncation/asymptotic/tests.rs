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
