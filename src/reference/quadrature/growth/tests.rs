use super::*;
use crate::Ball;
use proptest::prelude::*;

/// `C s^p L^q e^(−σ s^−r)` at `s = e^−t`, enclosed.
fn exact(g: &Growth, t: &Float) -> Ball {
    let of = |x: &Float| Ball::new(x.clone(), Mag::ZERO).with_prec(400);
    let number = |x: f64| Ball::exact(400, x);
    let t = of(t);
    let mut exponent = t.ln() * number(g.q) - &t * &number(g.p);
    exponent = exponent - (&t * &number(g.r)).exp() * number(g.sigma);
    of(&g.c.to_float()) * exponent.exp()
}

fn is_above(bound: Mag, value: &Ball) -> bool {
    !bound.is_finite() || !(Ball::new(bound.to_float(), Mag::ZERO) - value).is_negative()
}

fn is_below(bound: Mag, value: &Ball) -> bool {
    !(Ball::new(bound.to_float(), Mag::ZERO) - value).is_positive()
}

fn any() -> impl Strategy<Value = Growth> {
    let orders = prop_oneof![Just(0.5), Just(1.0), Just(2.0)];
    let sigma = prop_oneof![Just(0.0), -2.0..2.0f64];
    (
        2u32..7,
        0.01..50.0f64,
        -3.0..3.0f64,
        -2.0..2.0f64,
        sigma,
        orders,
    )
        .prop_map(|(k, c, p, q, sigma, r)| {
            let c = Mag::from_f64(c);
            Growth {
                k,
                c,
                p,
                q,
                sigma,
                r,
            }
        })
}

/// Points `t ≥ k ln 2` for every bound in use.
fn point() -> impl Strategy<Value = f64> {
    prop_oneof![4.159..4.3f64, 4.159..9.0f64]
}

proptest! {
    #[test]
    fn operations_bound_their_values(a in any(), b in any(), t in point(), e in 0.1..3.0f64) {
        let t = Float::with_val(BITS, t);
        let (x, y) = (exact(&a, &t), exact(&b, &t));
        for side in [Upper, Lower] {
            let holds = |bound: &Growth, value: &Ball| {
                let value = value.widened(value.magnitude().shift(-300));
                match side {
                    Upper => is_above(bound.at(&t, Upper), &value),
                    Lower => is_below(bound.at(&t, Lower), &value),
                }
            };
            prop_assert!(holds(&a, &x));
            prop_assert!(holds(&a.mul(&b, side), &(&x * &y)));
            prop_assert!(holds(&a.inverse(side).unwrap(), &x.recip()));
            let power = (x.ln() * Ball::exact(400, e)).exp();
            prop_assert!(holds(&a.raised([e, e], side).unwrap(), &power));
            prop_assert!(holds(&a.raised([e / 2.0, e * 1.5], side).unwrap(), &power));
        }
        if let Some(sum) = a.add(&b) {
            prop_assert!(is_above(sum.at(&t, Upper), &(&x + &y)));
        }
        if let Some(most) = a.greatest() {
            prop_assert!(is_above(most, &x));
        }
        if let Some(ratio) = a.over(&b) {
            prop_assert!(is_above(ratio, &(&x / &y)));
        }
    }

    /// The integral of the bound between two points, by the least value on short steps, is less
    /// than the rest.
    #[test]
    fn rests_bound_the_integral(g in any(), k in 7u32..9) {
        for infinite in [false, true] {
            let rest = g.rest(k, infinite);
            if !rest.is_finite() {
                continue;
            }
            let start = f64::from(k) * std::f64::consts::LN_2 + 1e-9;
            let steps = 400;
            let width = 1.0 / 64.0;
            let mut sum = 0.0f64;
            let sign = if infinite { 1.0 } else { -1.0 };
            let at = |t: f64| {
                let value = exact(&g, &Float::with_val(BITS, t));
                value.mid().to_f64() * (sign * t).exp()
            };
            let mut here = at(start);
            for i in 1..=steps {
                let next = at(start + f64::from(i) * width);
                // Monotone or with one maximum: the less of the two ends is below the mean but for
                // rounding.
                sum += here.min(next) * width;
                here = next;
            }
            prop_assert!(sum * (1.0 - 1e-9) <= rest.to_f64(), "{sum} {rest:?} {g:?} {infinite}");
        }
    }
}

/// Powers, of which the rest is the integral itself, and no more than is rounded.
#[test]
fn rests_of_powers_are_exact() {
    for (p, infinite, due) in [
        (0.0, false, 1.0 / 1024.0),
        (-0.5, false, 2.0 / 32.0),
        (1.0, false, 0.5 / 1024.0 / 1024.0),
        (2.0, true, 1.0 / 1024.0),
        (3.0, true, 0.5 / 1024.0 / 1024.0),
        (1.5, true, 2.0 / 32.0),
    ] {
        let g = Growth::power(2, Mag::from_f64(3.0), p);
        let found = g.rest(10, infinite).to_f64();
        assert!(
            found >= 3.0 * due && found < 3.0 * due * (1.0 + 1e-9),
            "{p} {infinite} {found}"
        );
    }
    // Not integrable, or not known to be.
    for (p, infinite) in [(-1.0, false), (-1.5, false), (1.0, true), (0.0, true)] {
        assert!(
            !Growth::power(2, Mag::from_f64(1.0), p)
                .rest(50, infinite)
                .is_finite()
        );
    }
    assert!(!Growth::exponential(2, -1.0, 1.0).rest(50, true).is_finite());
    // ∫ e^−x from 2^k on.
    let found = Growth::exponential(2, 1.0, 1.0).rest(5, true).to_f64();
    assert!(
        found >= (-32.0f64).exp() && found < 1.1 * (-32.0f64).exp(),
        "{found}"
    );
}

/// Sums and products of doubles are rounded to the side asked for.
#[test]
fn exponents_are_rounded_to_the_safe_side() {
    let mut draw = crate::draw::Draw(5);
    for _ in 0..2000 {
        let [a, b] = [0; 2].map(|_| draw.ball(53, -3, 3).mid().to_f64());
        let exact = |x: f64| rug::Rational::from_f64(x).unwrap();
        let (sum, product) = (exact(a) + exact(b), exact(a) * exact(b));
        assert!(exact(Upper.add(a, b)) >= sum && exact(Lower.add(a, b)) <= sum);
        assert!(exact(Upper.mul(a, b)) >= product && exact(Lower.mul(a, b)) <= product);
        assert!(Upper.mul(a, b) <= Lower.mul(a, b).next_up());
        assert!(Upper.add(a, b) <= Lower.add(a, b).next_up());
    }
    assert_eq!(Upper.add(0.5, 1.0), 1.5);
    assert!(Lower.mul(1e-200, -1e-200) < 0.0);
}
