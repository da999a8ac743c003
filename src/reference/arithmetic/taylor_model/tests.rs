//! Tests of `taylor_model`.

use super::*;
use crate::draw::Draw;
use proptest::prelude::*;
use rug::Rational;

const P: u32 = 60;

fn model(c: &[f64]) -> TaylorModel {
    TaylorModel::polynomial(c.iter().map(|&x| Float::with_val(P, x)).collect())
}

fn exact(c: &[f64], x: &Rational) -> Rational {
    c.iter().rev().fold(Rational::new(), |s, &c| {
        s * x + Rational::from_f64(c).unwrap()
    })
}

fn holds(m: &TaylorModel, x: &Rational, value: &Rational) -> bool {
    m.eval(&Ball::rational(200, x)).contains(value)
}

proptest! {
    #[test]
    fn operations_hold_the_exact_polynomials(
        a in prop::collection::vec(-1.0f64..1.0, 1..9),
        b in prop::collection::vec(-1.0f64..1.0, 1..9),
        order in 0usize..14,
        t in -64i32..=64,
        s in -32i32..=32,
    ) {
        let x = Rational::from((t, 64));
        let (f, g) = (model(&a), model(&b));
        let (fx, gx) = (exact(&a, &x), exact(&b, &x));
        prop_assert!(holds(&f.plus(&g), &x, &Rational::from(&fx + &gx)));
        prop_assert!(holds(&f.minus(&g), &x, &Rational::from(&fx - &gx)));
        prop_assert!(holds(&f.times(&g, order), &x, &Rational::from(&fx * &gx)));
        prop_assert!(holds(&f.squared(order), &x, &fx.clone().square()));
        let third = Ball::rational(P, &Rational::from((1, 3)));
        let y = Rational::from(&x / 3);
        prop_assert!(holds(&f.contracted(&third), &x, &exact(&a, &y)));
        // x0 + y with |x0| + |y| ≤ 1/2 + 1/2.
        let x0 = Rational::from((s, 64));
        let y = Rational::from((t, 128));
        let moved = f.shifted(&Float::with_val(P, &x0), Mag::from_f64(0.5));
        prop_assert!(holds(&moved, &y, &exact(&a, &Rational::from(&x0 + &y))));
        prop_assert!(holds(&f.of_square(order), &x, &exact(&a, &x.clone().square())));
        prop_assert!(holds(&f.times_x(), &x, &Rational::from(&fx * &x)));
        let mut primitive = vec![0.0; 1];
        primitive.extend(a.iter());
        let whole: Rational = a.iter().enumerate().fold(Rational::new(), |sum, (k, &c)| {
            let mut p = Rational::from(1);
            for _ in 0..=k { p *= &x; }
            sum + Rational::from_f64(c).unwrap() * p / (k as u32 + 1)
        });
        prop_assert!(holds(&f.integral(), &x, &whole));
        let value = f.range();
        prop_assert!(value.contains(&fx));
    }
}

#[test]
fn cosine_and_sine() {
    let phi = Ball::exact(P, 0.7);
    let h = Ball::rational(P, &Rational::from((1, 3)));
    for order in [1, 4, 9, 20] {
        let (c, s) = TaylorModel::cos_sin(&phi, &h, order);
        for t in [-4i32, -1, 3, 4] {
            let x = Rational::from((t, 4));
            let angle = Ball::exact(300, 0.7) + Ball::rational(300, &Rational::from((t, 12)));
            let (sine, cosine) = angle.sin_cos();
            let at = Ball::rational(300, &x);
            assert!(c.eval(&at).contains_ball(&cosine));
            assert!(s.eval(&at).contains_ball(&sine));
        }
    }
}

#[test]
fn a_bound_that_forgets_the_left_out_powers_is_wrong() {
    // (1 + x)² to order 1 is 1 + 2x ± 1; without the bound it would miss the value at x = 1.
    let f = model(&[1.0, 1.0]);
    let square = f.squared(1);
    assert!(holds(&square, &Rational::from(1), &Rational::from(4)));
    assert!(!holds(
        &square.centre(),
        &Rational::from(1),
        &Rational::from(4)
    ));
}

/// 44 bits: roundings beside the radii given, which are of their size.
const SHORT: u32 = 44;

fn unit() -> f64 {
    2f64.powi(-(SHORT as i32))
}

/// Coefficients of 44 bits without a pattern, with a radius of some units.
fn rough(c: &[f64], units: f64) -> TaylorModel {
    let c = c.iter().map(|&x| Float::with_val(SHORT, x)).collect();
    TaylorModel::polynomial(c).widened(Mag::from_f64(units * unit()))
}

fn size(m: &TaylorModel) -> f64 {
    m.c.iter().map(|x| x.to_f64().abs()).sum()
}

/// A radius is what it should be to seven digits and not below it.
fn is_radius(m: &TaylorModel, due: f64) {
    let rad = m.rad().to_f64();
    assert!(rad >= due && rad <= due * (1.0 + 2e-4), "{rad:e} {due:e}");
}

const A: [f64; 5] = [0.7123, -0.3311, 0.5197, 0.1931, -0.8713];
const B: [f64; 3] = [-0.4177, 0.9311, 0.2273];

/// Every operation's radius by its formula, with the radii of what goes in.
#[test]
fn radii_are_those_of_the_formulas() {
    let (f, g) = (rough(&A, 3.0), rough(&B, 5.0));
    let u = unit();
    let (nf, ng) = (size(&f), size(&g));
    for sum in [f.plus(&g), f.minus(&g), g.plus(&f)] {
        is_radius(&sum, 8.0 * u + 2.0 * u * size(&sum));
    }
    // The fewer bits of the result count, those of the finer operand being kept.
    let fine = TaylorModel::polynomial(vec![Float::with_val(90, 1) / 3u32; 2]);
    for sum in [f.plus(&fine), fine.plus(&f), f.minus(&fine), fine.minus(&f)] {
        assert_eq!(sum.bits(), 90);
        is_radius(&sum, 3.0 * u);
    }
    assert_eq!(fine.times(&f, 9).bits(), 90);
    assert_eq!(f.times(&fine, 9).bits(), 90);
    is_radius(&f.times(&fine, 9), 3.0 * u * size(&fine));
    let cut = fine.with_prec(SHORT);
    is_radius(&cut, 2.0 * u * size(&cut));
    let cut = f.with_prec(SHORT - 2);
    is_radius(&cut, 3.0 * u + 8.0 * u * size(&cut));
    let third = Ball::rational(SHORT, &Rational::from((-1, 3))).widened(Mag::from_f64(7.0 * u));
    let by = f.scaled(&third);
    let magnitude = third.magnitude().to_f64();
    is_radius(
        &by,
        3.0 * u * magnitude + nf * third.rad().to_f64() + 2.0 * u * size(&by),
    );
    // A wide factor: its largest size counts.
    let wide = Ball::exact(SHORT, 0.5).widened(Mag::from_f64(0.25));
    let large = rough(&A, 1.0 / u);
    is_radius(&large.scaled(&wide), 0.75 + 0.25 * nf);
    // Sums of at most three products, of fewer where the order is less.
    for (order, terms) in [(0, 2.0), (1, 3.0), (2, 4.0), (6, 4.0), (9, 4.0)] {
        let mut left = 0.0;
        for (i, a) in f.c.iter().enumerate() {
            for (j, b) in g.c.iter().enumerate() {
                if i + j > order {
                    left += a.to_f64().abs() * b.to_f64().abs();
                }
            }
        }
        for product in [f.times(&g, order), g.times(&f, order)] {
            assert_eq!(product.c.len(), order.min(6) + 1);
            let radii = 5.0 * u * nf + 3.0 * u * ng + 15.0 * u * u;
            is_radius(&product, radii + terms * u * nf * ng + left);
        }
    }
    // Both radii large: their product counts.
    let (p, q) = (rough(&A, 0.25 / u), rough(&B, 0.5 / u));
    is_radius(&p.times(&q, 9), 0.5 * nf + 0.25 * ng + 0.125);
    let nothing = TaylorModel::polynomial(Vec::new()).widened(Mag::from_f64(0.25));
    for product in [nothing.times(&q, 9), q.times(&nothing, 9)] {
        is_radius(&product, 0.25 * (ng + 0.5));
        assert_eq!((product.c.len(), size(&product)), (1, 0.0));
    }
    let drawn = f.contracted(&third);
    let mut due = 3.0 * u;
    let mut power = Ball::integer(SHORT, 1);
    for (x, y) in f.c.iter().zip(&drawn.c) {
        due += x.to_f64().abs() * power.rad().to_f64() + 2.0 * u * y.to_f64().abs();
        power = power * &third;
    }
    is_radius(&drawn, due);
    // By |x0| + reach: 0.375 + 0.5.
    let moved = f.shifted(&Float::with_val(SHORT, -0.375), Mag::from_f64(0.5));
    let majorant = A.iter().rev().fold(0.0, |s, x| s * 0.875 + x.abs());
    is_radius(&moved, 3.0 * u + 11.0 * u * majorant);
    assert_eq!(
        f.shifted(&Float::new(SHORT), Mag::from_f64(0.5)).rad(),
        f.rad()
    );
    let slope: f64 = A.iter().enumerate().map(|(k, x)| k as f64 * x.abs()).sum();
    let motion = f.motion(Mag::from_f64(0.125)).to_f64();
    assert!((motion / (0.125 * slope) - 1.0).abs() < 1e-9);
    for (order, kept) in [(0, 1), (1, 1), (2, 2), (3, 2), (7, 4), (8, 5), (20, 5)] {
        let square = f.of_square(order);
        assert_eq!(square.c.len(), 2 * kept - 1);
        let left: f64 = A[kept..].iter().map(|x| x.abs()).sum();
        is_radius(&square, 3.0 * u + left);
    }
    let slope = f.derivative(Mag::from_f64(9.0 * u));
    is_radius(&slope, 9.0 * u + 2.0 * u * size(&slope));
    let none = rough(&[0.5], 3.0).derivative(Mag::ZERO);
    assert_eq!((none.c.len(), none.bits(), size(&none)), (1, SHORT, 0.0));
    let whole = f.integral();
    is_radius(&whole, 3.0 * u + 2.0 * u * size(&whole));
    is_radius(
        &f.plus_ball(&Ball::exact(90, 0.5)),
        3.0 * u + 2.0 * u * size(&f.plus_ball(&Ball::exact(90, 0.5))),
    );
    // With a radius of its own and a longer number cut.
    let number = Ball::rational(90, &Rational::from((1, 3))).widened(Mag::from_f64(0.5));
    let sum = f.plus_ball(&number);
    assert_eq!(sum.bits(), SHORT);
    is_radius(&sum, 0.5);
}

/// Coefficients of operations, next to the exact ones.
#[test]
fn coefficients_are_the_exact_ones_rounded() {
    let (f, g) = (rough(&A, 0.0), rough(&B, 0.0));
    let off = |m: &TaylorModel, due: &[f64]| {
        assert_eq!(m.c.len(), due.len());
        let apart = m.c.iter().zip(due).map(|(x, y)| (x.to_f64() - y).abs());
        assert!(
            apart.fold(0.0, f64::max) < 8.0 * unit(),
            "{:?} {due:?}",
            m.c
        );
    };
    let product = |a: &[f64], b: &[f64], k: usize| -> f64 {
        (0..=k)
            .map(|i| a.get(i).unwrap_or(&0.0) * b.get(k - i).unwrap_or(&0.0))
            .sum()
    };
    let all: Vec<f64> = (0..7).map(|k| product(&A, &B, k)).collect();
    off(&f.times(&g, 6), &all);
    off(&f.times(&g, 3), &all[..4]);
    let all: Vec<f64> = (0..9).map(|k| product(&A, &A, k)).collect();
    off(&f.squared(20), &all);
    off(&f.squared(5), &all[..6]);
    for k in 0..9 {
        for (from, to) in [(0, 99), (0, 2), (2, 3), (4, 4), (3, 1)] {
            let due: f64 = (0..=k)
                .filter(|&i| (from..=to).contains(&i))
                .map(|i| A.get(i).unwrap_or(&0.0) * B.get(k - i).unwrap_or(&0.0))
                .sum();
            let sum = convolution(&f.c, &g.c, k, from, to, SHORT).to_f64();
            assert!((sum - due).abs() < 8.0 * unit(), "{k} {from} {to}");
        }
    }
    assert!(convolution(&[], &g.c, 0, 0, 0, SHORT).is_zero());
    assert!(convolution(&f.c, &[], 0, 0, 0, SHORT).is_zero());
    off(&f.times_x(), &[0.0, A[0], A[1], A[2], A[3], A[4]]);
    off(&f.of_square(5), &[A[0], 0.0, A[1], 0.0, A[2]]);
    off(
        &f.derivative(Mag::ZERO),
        &[A[1], 2.0 * A[2], 3.0 * A[3], 4.0 * A[4]],
    );
    off(
        &f.integral(),
        &[0.0, A[0], A[1] / 2.0, A[2] / 3.0, A[3] / 4.0, A[4] / 5.0],
    );
    // Of the model's bits, the first coefficient's.
    let mixed = vec![Float::with_val(SHORT, 1), Float::with_val(90, 1)];
    assert_eq!(TaylorModel::polynomial(mixed).bits(), SHORT);
    assert_eq!(TaylorModel::polynomial(Vec::new()).bits(), 64);
    let range = f.range();
    assert_eq!(range.prec(), 64);
    let rest = size(&f) - A[0];
    assert!(
        (range.rad().to_f64() - rest).abs() < 1e-9 && (range.mid().to_f64() - A[0]).abs() < 1e-12
    );
    let nothing = TaylorModel::polynomial(Vec::new())
        .widened(Mag::from_f64(0.25))
        .range();
    assert_eq!(
        (
            nothing.prec(),
            nothing.rad().to_f64(),
            nothing.mid().to_f64()
        ),
        (64, 0.25, 0.0)
    );
}

/// Bounds are not below what they bound in their last digit: coefficients of 60 bits beside bounds
/// of 53.
#[test]
fn bounds_are_rounded_up() {
    let long = Float::with_val(P, 1) / 3u32;
    let exact = long.to_rational().unwrap();
    let holds = |m: Mag, factor: Rational| m.to_float().to_rational().unwrap() >= factor * &exact;
    let f = TaylorModel::polynomial(vec![long.clone()]);
    assert!(holds(f.norm(), Rational::from(1)));
    let g = TaylorModel::polynomial(vec![Float::new(P), long.clone()]);
    let one = model(&[0.0, 1.0]);
    // x · x/3 to the order 1: all is left out.
    assert!(holds(g.times(&one, 1).rad(), Rational::from(1)));
    assert!(holds(one.times(&g, 1).rad(), Rational::from(1)));
    assert!(holds(g.motion(Mag::from_f64(1.0)), Rational::from(1)));
    let wide = Ball::integer(P, 0).widened(Mag::from_f64(1.0));
    assert!(holds(g.contracted(&wide).rad(), Rational::from(1)));
}

/// Products of bounds are not below those of what they bound, whatever the bits beyond the 53rd.
#[test]
fn products_of_bounds_are_rounded_up() {
    let mut numbers = Draw(1);
    let mut draw = || {
        // From one to two.
        let x = Float::with_val(P, numbers.next() >> 5 | 1 << 59) >> 59u32;
        let exact = x.to_rational().unwrap();
        (x, exact)
    };
    let value = |m: Mag| m.to_float().to_rational().unwrap();
    for _ in 0..2000 {
        let ((x, a), (y, b)) = (draw(), draw());
        let zero = Float::new(P);
        let product = Rational::from(&a * &b);
        assert!(
            value(left_out(
                &[zero.clone(), x.clone()],
                &[zero.clone(), y.clone()],
                1
            )) >= product
        );
        let by = Mag::above(&y);
        let line = TaylorModel::polynomial(vec![zero.clone(), x.clone()]);
        assert!(value(line.motion(by)) >= &a * value(by));
        for k in 2..8 {
            let mut c = vec![zero.clone(); k];
            c.push(x.clone());
            let motion = TaylorModel::polynomial(c).motion(by);
            assert!(value(motion) >= Rational::from(&a * k as u32) * value(by));
        }
        let wide = Ball::integer(P, 0).widened(by);
        assert!(value(line.contracted(&wide).rad()) >= &a * value(wide.rad()));
    }
}

/// The terms above the order are at most twice the first of them where h is at most 1, and without
/// bound beyond.
#[test]
fn tails_of_cosine_and_sine() {
    let phi = Ball::exact(P, 0.7);
    for (h, order) in [(1.0, 1), (1.0, 4), (0.5, 3), (0.25, 1), (-1.0, 6)] {
        let factorial: f64 = (1..=order + 1).map(|k| k as f64).product();
        let due = 2.0 * f64::powi(f64::abs(h), order + 1) / factorial;
        let (c, s) = TaylorModel::cos_sin(&phi, &Ball::exact(P, h), order as usize);
        for m in [c, s] {
            let rad = m.rad().to_f64();
            assert!(
                rad >= due && rad < due * (1.0 + 1e-9),
                "{h} {order}: {rad} {due}"
            );
        }
    }
    // h within [0.25, 0.75]: the largest counts.
    let wide = Ball::exact(P, 0.5).widened(Mag::from_f64(0.25));
    let (c, _) = TaylorModel::cos_sin(&phi, &wide, 1);
    assert!(c.rad().to_f64() >= 0.5625);
    for (h, order) in [(1.0000001, 4), (1.5, 1), (2.0, 9), (1.0, 0), (0.25, 0)] {
        let (c, s) = TaylorModel::cos_sin(&phi, &Ball::exact(P, h), order);
        assert!(!c.rad().is_finite() && !s.rad().is_finite(), "{h} {order}");
    }
    let beyond = Ball::exact(P, 0.75).widened(Mag::from_f64(0.5));
    assert!(!TaylorModel::cos_sin(&phi, &beyond, 4).0.rad().is_finite());
}
