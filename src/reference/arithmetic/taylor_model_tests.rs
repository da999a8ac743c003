//! Tests of `taylor_model`.

use super::*;
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
