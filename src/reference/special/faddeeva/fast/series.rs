//! The asymptotic sum in fixed point, with units of 2^-114.
//!
//! With `v = C/z² = p + iq`, |v| ≤ 1, ρ = (2k+1)/(2C) and the sum from term k on equal to P + iqS:
//! `P ← 1 + ρ (pP − q²S)`, `S ← ρ (P + pS)`. The errors E of P and F of S obey
//!
//! ```text
//! E' = ρ (|p| E + q² F + 6 + 3|P| + 20|S|) + 1      F' = ρ (E + |p| F + 3 + 3|S|) + 1
//! ```
//!
//! (Ca² and Cb² are wrong by one unit, hence p by 3 and `q² = 4 Ca² Cb²` by 4 (3 + 2)), evaluated
//! in `f64`. Wanted are `P + 2Ca² S` and `P − 2Cb² S`; Ca² and Cb² are at most one, taken with an
//! error of three units, and a product brings three more: `E + 2 (F + 3|S| + 3)`, enlarged by 1 %
//! and one unit.

use super::fixed_point::{PREC, SCALE, mul};
use rug::Float;

/// Units of 2^-UNIT.
pub const UNIT: u32 = 114;
const ONE: i128 = 1 << UNIT;

/// In units of one.
#[inline]
fn size(x: i128) -> f64 {
    x as f64 / ONE as f64
}

/// [`mul`] counts in 2^-122: 8 bits are missing in a factor.
#[inline]
fn times(x: i128, y: i128) -> i128 {
    mul(x, y << (SCALE - UNIT))
}

/// Bounds on errors, in units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Errors {
    sum: f64,
    rest: f64,
}

impl Errors {
    /// With one term more, ρ; |p| and q², |P| and |S|.
    #[inline]
    fn next(self, rho: f64, [p, q2]: [f64; 2], [sum, rest]: [f64; 2]) -> Errors {
        Errors {
            sum: rho * (p * self.sum + q2 * self.rest + 6.0 + 3.0 * sum + 20.0 * rest) + 1.0,
            rest: rho * (self.sum + p * self.rest + 3.0 + 3.0 * rest) + 1.0,
        }
    }

    /// Of what is wanted, |S| given.
    #[inline]
    fn total(self, rest: f64) -> f64 {
        (self.sum + 2.0 * (self.rest + 3.0 * rest + 3.0)) * 1.01 + 1.0
    }
}

/// The powers of `C/z²`.
pub struct Powers {
    /// `Ca²` and `Cb²`, 1/z = a − ib.
    aa: i128,
    bb: i128,
    p: i128,
    q2: i128,
    /// log₂ C.
    log_c: u32,
}

/// From a term on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct State {
    sum: i128,
    rest: i128,
    errors: Errors,
}

/// `P + 2Ca² S` and `P − 2Cb² S` in units, and what they are wrong by.
#[derive(Debug)]
pub struct Sums {
    pub re: i128,
    pub im: i128,
    pub error: f64,
}

impl Powers {
    /// C is the greatest power of two that is not above |z|², up to 2^40; `log_r` is `log2 |z|²` or
    /// a little less.
    #[inline]
    pub fn new(a: &Float, b: &Float, log_r: f64) -> Option<Powers> {
        let log_c = (log_r.floor() as u32).min(40);
        let units = |f: &Float| -> Option<i128> {
            let square = Float::with_val(PREC, f.square_ref()) << (log_c + UNIT);
            square.to_integer()?.to_i128()
        };
        let (aa, bb) = (units(a)?, units(b)?);
        Some(Powers {
            aa,
            bb,
            p: aa - bb,
            q2: 4 * times(aa, bb),
            log_c,
        })
    }

    /// With one term more, the k-th; nothing where a part is beyond 30, of which products might
    /// overflow.
    #[inline]
    fn next(&self, now: State, k: u64) -> Option<State> {
        let factor = 2 * i128::from(k) + 1;
        let rho = factor as f64 / (f64::from(self.log_c) + 1.0).exp2();
        let sizes = [size(now.sum).abs(), size(now.rest).abs()];
        if sizes[0].max(sizes[1]) > 30.0 {
            return None;
        }
        let grown = |x: i128| Some(x.checked_mul(factor)? >> (self.log_c + 1));
        Some(State {
            sum: ONE + grown(times(self.p, now.sum) - times(self.q2, now.rest))?,
            rest: grown(now.sum + times(self.p, now.rest))?,
            errors: now
                .errors
                .next(rho, [size(self.p).abs(), size(self.q2)], sizes),
        })
    }

    /// Of n terms.
    #[inline]
    pub fn sums(&self, n: u64) -> Option<Sums> {
        let mut state = State {
            sum: ONE,
            rest: 0,
            errors: Errors::default(),
        };
        for k in (0..n - 1).rev() {
            state = self.next(state, k)?;
        }
        let State { sum, rest, errors } = state;
        Some(Sums {
            re: sum + 2 * times(self.aa, rest),
            im: sum - 2 * times(self.bb, rest),
            error: errors.total(size(rest).abs()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rug::{Integer, Rational};

    const E: Errors = Errors {
        sum: 8.0,
        rest: 16.0,
    };

    /// `ρ(|p|E + q²F + 6 + 3|P| + 20|S|) + 1` and `ρ(E + |p|F + 3 + 3|S|) + 1`.
    #[test]
    fn errors_of_a_term_more() {
        let found = E.next(0.5, [0.25, 0.5], [2.0, 3.0]);
        assert_eq!(found.sum, 0.5 * (2.0 + 8.0 + 6.0 + 6.0 + 60.0) + 1.0);
        assert_eq!(found.rest, 0.5 * (8.0 + 4.0 + 3.0 + 9.0) + 1.0);
        let found = Errors::default().next(2.0, [1.0; 2], [0.0; 2]);
        assert_eq!((found.sum, found.rest), (13.0, 7.0));
        // (8 + 2 (16 + 1.5 + 3)) 1.01 + 1.
        assert!((50.49..50.490_001).contains(&E.total(0.5)));
        assert!((7.06..7.060_001).contains(&Errors::default().total(0.0)));
    }

    /// At z = x + iy.
    fn powers(x: f64, y: f64) -> Powers {
        let f = |x: f64| Float::with_val(PREC, x);
        let norm = f(x).square() + f(y).square();
        let log_r = norm.to_f64().log2() - 1e-8;
        Powers::new(&(f(x) / &norm), &(f(y) / &norm), log_r).unwrap()
    }

    /// |v| ≤ 1 < 2|v| up to 2^40.
    #[test]
    fn powers_are_below_one() {
        for (x, log_c) in [
            (10.0, 6),
            (16.0, 7),
            (16.1, 8),
            (1e6, 39),
            (2e6, 40),
            (1e8, 40),
        ] {
            let v = powers(x, 0.0);
            assert_eq!(v.log_c, log_c);
            let due = 2f64.powi(log_c as i32) / x / x;
            assert!((size(v.aa) - due).abs() < 1e-12 && v.bb == 0 && v.q2 == 0 && v.p == v.aa);
            assert!(v.aa <= ONE);
        }
        let v = powers(6.0, 8.0);
        let off = |found: i128, n: i32, d: i32| {
            (Rational::from(found) - Rational::from((n, d)) * Integer::from(ONE)).abs()
        };
        // 64/100 = 16/25, cos² = 9/25, sin 2θ = 24/25.
        assert!(off(v.aa, 144, 625) < 1 && off(v.bb, 256, 625) < 1);
        assert!(off(v.p, -112, 625) < 2);
        assert!(off(v.q2, 4 * 144 * 256, 625 * 625) < 20);
    }

    /// P and S of n terms, by rationals.
    fn exact(v: &Powers, p: &Rational, q2: &Rational, n: u64) -> [Rational; 2] {
        let (mut sum, mut rest) = (Rational::from(1), Rational::new());
        for k in (0..n - 1).rev() {
            let rho = Rational::from((2 * k + 1, 2u64 << v.log_c));
            let next = rho.clone() * (p * sum.clone() - q2 * rest.clone()) + 1u32;
            rest = rho * (sum + p * rest);
            sum = next;
        }
        [sum, rest]
    }

    /// In units, from the exact ones of that point.
    fn off(x: f64, y: f64, n: u64) -> ([f64; 2], f64) {
        let v = powers(x, y);
        let q = |x: f64| Rational::from_f64(x).unwrap();
        let norm = q(x) * q(x) + q(y) * q(y);
        let c = Integer::from(1) << v.log_c;
        let square = |x: f64| q(x) * q(x) / &norm / &norm * &c;
        let (aa, bb) = (square(x), square(y));
        let [sum, rest] = exact(&v, &(aa.clone() - &bb), &(aa.clone() * &bb * 4u32), n);
        let found = v.sums(n).unwrap();
        let off = |found: i128, due: Rational| {
            (Rational::from(found) - due * Integer::from(ONE))
                .abs()
                .to_f64()
        };
        let re = off(found.re, sum.clone() + aa * &rest * 2u32);
        let im = off(found.im, sum - bb * rest * 2u32);
        ([re, im], found.error)
    }

    proptest! {
        #[test]
        fn sums_are_within_their_errors(r in 9.75f64..40.0, turn in 0.0f64..1.57, n in 1u64..60) {
            let (off, error) = off(r * turn.cos(), r * turn.sin(), n);
            prop_assert!(off[0] <= error && off[1] <= error, "{off:?} {error}");
        }
    }

    /// On the real axis Ca² is off by half a unit at most, and few roundings are off by more.
    #[test]
    fn errors_are_no_more_than_some_times_those_that_occur() {
        for n in [2, 4, 10, 40] {
            let mut share = 0.0f64;
            for k in 0..60 {
                let (r, turn) = (9.75 + f64::from(k) * 0.01, f64::from(k) * 0.026);
                let (off, error) = off(r * turn.cos(), r * turn.sin(), n);
                share = share.max(off[0].max(off[1]) / error);
            }
            assert!(share > 1.0 / 30.0, "{n}: {share}");
        }
    }

    /// One term is one, without error of its own; two are 1 + v/(2C), three have two factors.
    #[test]
    fn few_terms() {
        let v = Powers {
            aa: ONE / 2,
            bb: ONE / 4,
            p: ONE / 4,
            q2: ONE / 2,
            log_c: 3,
        };
        let one = v.sums(1).unwrap();
        assert_eq!((one.re, one.im), (ONE, ONE));
        assert_eq!(one.error, Errors::default().total(0.0));
        let whole = Powers {
            aa: ONE,
            bb: ONE,
            ..v
        };
        let one = whole.sums(1).unwrap();
        assert_eq!((one.re, one.im), (ONE, ONE));
        // ρ = 1/16: P = 1 + 1/64, S = 1/16; P + 2 S/2 and P − 2 S/4.
        let two = v.sums(2).unwrap();
        assert_eq!((two.re, two.im), (ONE / 64 * 69, ONE / 64 * 63));
        let due = Errors::default().next(1.0 / 16.0, [0.25, 0.5], [1.0, 0.0]);
        assert_eq!(two.error, due.total(1.0 / 16.0));
        // ρ = 3/16, P = 1 + 3/64, S = 3/16; then P = 1 + (P/4 − S/2)/16, S = (P + S/4)/16.
        let three = v.sums(3).unwrap();
        let due = |n: i128| ONE / 4096 * n;
        let (p, s) = (due(4096 + 67 - 24), due(268 + 12));
        assert_eq!((three.re, three.im), (p + s, p - s / 2));
        let first = Errors::default().next(3.0 / 16.0, [0.25, 0.5], [1.0, 0.0]);
        let second = first.next(1.0 / 16.0, [0.25, 0.5], [67.0 / 64.0, 3.0 / 16.0]);
        assert_eq!(three.error, second.total(280.0 / 4096.0));
    }

    /// A sum that grows that far: none of |z| above 9.74 does.
    #[test]
    fn sums_beyond_thirty_are_none() {
        let v = powers(10.0, 5.0);
        for (sum, rest) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
            for (by, due) in [(ONE * 30, true), (ONE * 30 + (ONE >> 40), false)] {
                let state = State {
                    sum: sum * by,
                    rest: rest * by,
                    errors: E,
                };
                assert_eq!(v.next(state, 1).is_some(), due, "{sum} {rest}");
            }
        }
        // Nor does a factor that large.
        let state = State {
            sum: ONE,
            rest: 0,
            errors: E,
        };
        assert!(v.next(state, 1 << 20).is_none() && v.next(state, 1 << 10).is_some());
    }
}
