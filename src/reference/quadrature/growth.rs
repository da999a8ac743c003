//! Bounds on a function next to an end, of the form `C s^p L^q e^(−σ s^−r)`, and the integral of
//! what is cut off.

use crate::Mag;
use rug::Float;
use rug::float::Constant;
use rug::ops::Pow;

/// `C s^p L^q e^(−σ s^−r)` with `L = ln(1/s)`, an upper or a lower bound for all `0 < s ≤ 2^−k`.
///
/// k is at least 2, so that L exceeds 1. Exponents are doubles rounded to the safe side: for an
/// upper bound p and σ are rounded down and q up, for a lower bound the other way.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    k: u32,
    c: Mag,
    p: f64,
    q: f64,
    sigma: f64,
    r: f64,
}

/// The side to which a bound is rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Upper,
    Lower,
}

use Side::{Lower, Upper};

impl Side {
    fn other(self) -> Side {
        match self {
            Upper => Lower,
            Lower => Upper,
        }
    }

    /// The sum, rounded up or down; what an addition rounds off is a double itself.
    pub(super) fn add(self, a: f64, b: f64) -> f64 {
        let sum = a + b;
        let back = sum - a;
        let rest = (a - (sum - back)) + (b - back);
        self.step(sum, rest)
    }

    /// The product, likewise.
    fn mul(self, a: f64, b: f64) -> f64 {
        let product = a * b;
        // The part that is rounded off may be too small for a double.
        if a != 0.0 && b != 0.0 && product.abs() < 1e-250 {
            return self.step(product, if self == Upper { 1.0 } else { -1.0 });
        }
        self.step(product, a.mul_add(b, -product))
    }

    fn step(self, x: f64, rest: f64) -> f64 {
        match self {
            Upper if rest > 0.0 => x.next_up(),
            Lower if rest < 0.0 => x.next_down(),
            _ => x,
        }
    }

    /// A bound from an upper bound that is above its value by less than one part in `2^50`.
    fn of_upper(self, x: Mag) -> Mag {
        match self {
            Upper => x,
            Lower => x.mul_below(Mag::from_f64(1.0 - 2.0 * f64::EPSILON - 6.0 * f64::EPSILON)),
        }
    }

    /// A bound from a float with more than 53 bits that is right to one part in `2^40`.
    fn of_float(self, x: &Float) -> Mag {
        const OFF: f64 = 1.0 / (1u64 << 40) as f64;
        match self {
            Upper => Mag::above(x).mul(Mag::from_f64(1.0 + OFF)),
            Lower => Mag::below(x).mul_below(Mag::from_f64(1.0 - OFF)),
        }
    }

    fn mul_mag(self, a: Mag, b: Mag) -> Mag {
        match self {
            Upper => a.mul(b),
            Lower => a.mul_below(b),
        }
    }
}

/// Bits of the logarithms and exponentials of bounds.
const BITS: u32 = 128;

/// `ln 2^k`.
fn logarithm(k: u32) -> Float {
    Float::with_val(BITS, Constant::Log2) * k
}

/// `2^(k r)`.
fn distance(k: u32, r: f64) -> Float {
    Float::with_val(BITS, 2).pow(Float::with_val(BITS, k) * r)
}

/// `e^x`, to the safe side.
fn exponential(x: &Float, side: Side) -> Mag {
    // Far inside the exponents of MPFR.
    const FAR: i32 = 1 << 28;
    if *x < -FAR {
        return match side {
            Upper => Mag::power_of_two(-i64::from(FAR)),
            Lower => Mag::ZERO,
        };
    }
    if !(*x <= FAR) {
        return match side {
            _ if x.is_nan() => {
                if side == Upper {
                    Mag::INFINITY
                } else {
                    Mag::ZERO
                }
            }
            Upper => Mag::INFINITY,
            Lower => Mag::power_of_two(i64::from(FAR)),
        };
    }
    side.of_float(&x.clone().exp())
}

impl Growth {
    /// The constant c.
    pub fn constant(k: u32, c: Mag) -> Growth {
        Growth::power(k, c, 0.0)
    }

    /// `c s^p`.
    pub fn power(k: u32, c: Mag, p: f64) -> Growth {
        Growth {
            k: k.max(2),
            c,
            p,
            q: 0.0,
            sigma: 0.0,
            r: 1.0,
        }
    }

    /// `c ln(1/s)^q`.
    pub fn logarithm(k: u32, c: Mag, q: f64) -> Growth {
        Growth {
            q,
            ..Growth::constant(k, c)
        }
    }

    /// `e^(−σ s^−r)`, for r > 0.
    pub fn exponential(k: u32, sigma: f64, r: f64) -> Growth {
        Growth {
            sigma,
            r,
            ..Growth::constant(k, Mag::from_f64(1.0))
        }
    }

    /// Returns true if the bound is finite and not zero, so that it has an inverse.
    fn is_proper(&self) -> bool {
        let exponents = [self.p, self.q, self.sigma, self.r];
        self.c.exponent().is_some() && exponents.iter().all(|x| x.is_finite())
    }

    /// The factor in front.
    pub(super) fn factor(&self) -> Mag {
        self.c
    }

    /// p, q and σ.
    pub(super) fn exponents(&self) -> [f64; 3] {
        [self.p, self.q, self.sigma]
    }

    /// r.
    pub(super) fn order(&self) -> f64 {
        self.r
    }

    /// The distance up to which the bound holds is `2^−k`.
    pub(super) fn reach(&self) -> u32 {
        self.k
    }

    /// The same for a smaller distance.
    pub(super) fn nearer(self, k: u32) -> Growth {
        Growth {
            k: self.k.max(k),
            ..self
        }
    }

    /// The bound times a constant.
    pub(super) fn scaled(&self, by: Mag, side: Side) -> Growth {
        Growth {
            c: side.mul_mag(self.c, by),
            ..self.clone()
        }
    }

    /// The product of two upper or of two lower bounds.
    pub(super) fn mul(&self, other: &Growth, side: Side) -> Growth {
        let against = side.other();
        let k = self.k.max(other.k);
        let (sigma, r) = exponent_sum([self, other], k, side);
        Growth {
            k,
            c: side.mul_mag(self.c, other.c),
            p: against.add(self.p, other.p),
            q: side.add(self.q, other.q),
            sigma,
            r,
        }
    }

    /// A bound on the inverse, on the other side; the argument is a bound on the side opposite to
    /// the result.
    pub(super) fn inverse(&self, side: Side) -> Option<Growth> {
        if !self.is_proper() {
            return None;
        }
        let c = side.of_upper(Mag::from_f64(1.0).div(self.c));
        Some(Growth {
            k: self.k,
            c,
            p: -self.p,
            q: -self.q,
            sigma: -self.sigma,
            r: self.r,
        })
    }

    /// A bound on the power with a positive exponent that lies between two numbers.
    pub(super) fn raised(&self, [low, high]: [f64; 2], side: Side) -> Option<Growth> {
        if !(0.0 < low && low <= high && high.is_finite() && self.is_proper()) {
            return None;
        }
        let of = |x: f64, side: Side| {
            let [a, b] = [low, high].map(|e| side.mul(x, e));
            if side == Upper { a.max(b) } else { a.min(b) }
        };
        let against = side.other();
        let base = self.c.to_float();
        let powers = [low, high].map(|e| {
            let power = Float::with_val(BITS, Float::with_val(BITS, base.ln_ref()) * e);
            exponential(&power, side)
        });
        let c = if side == Upper {
            powers[0].max(powers[1])
        } else {
            powers[0].min(powers[1])
        };
        let (p, q) = (of(self.p, against), of(self.q, side));
        Some(Growth {
            k: self.k,
            c,
            p,
            q,
            sigma: of(self.sigma, against),
            r: self.r,
        })
    }

    /// The value at `s = e^−t`, to the safe side.
    pub(super) fn at(&self, t: &Float, side: Side) -> Mag {
        let mut exponent = Float::with_val(BITS, t.ln_ref()) * self.q;
        exponent -= Float::with_val(BITS, t * self.p);
        if self.sigma != 0.0 {
            exponent -= Float::with_val(BITS, t * self.r).exp() * self.sigma;
        }
        side.mul_mag(self.c, exponential(&exponent, side))
    }

    /// The least upper bound for all s, where the bound decreases with s; none where that is not
    /// sure.
    ///
    /// In `t = ln(1/s)` the logarithm is `ln C − p t + q ln t − σ e^(rt)`, and its slope is at most
    /// `−p + max(q, 0)/T − σ r e^(rT)` for t ≥ T and σ ≥ 0.
    pub(super) fn greatest(&self) -> Option<Mag> {
        let fall = self.fall(self.p, self.k);
        // Nothing is lost to rounding where every factor falls.
        let falls = self.p >= 0.0 && self.q <= 0.0 && self.sigma >= 0.0;
        (falls || fall > 0.0).then(|| self.at(&logarithm(self.k), Upper))
    }

    /// A lower bound on `a + σ r e^(rT) − max(q, 0)/T`, not positive where that is not sure.
    fn fall(&self, a: f64, k: u32) -> f64 {
        if !(self.sigma >= 0.0) {
            return f64::NEG_INFINITY;
        }
        let t = f64::from(k) * std::f64::consts::LN_2;
        let decay = match self.sigma {
            0.0 => 0.0,
            sigma => (sigma * self.r * (f64::from(k) * self.r).exp2()).min(1e300),
        };
        let spread = self.q.max(0.0) / t;
        // Six operations, each right to a few parts in 10^16.
        let off = 1e-12 * (decay + spread + if decay + spread > 0.0 { a.abs() } else { 0.0 });
        a + decay - spread - off
    }

    /// A bound on the integral of the function from the end to the distance `2^−k`; in an infinite
    /// direction, from `2^k` on.
    ///
    /// With `s = e^−t`, `T = k ln 2` and `a = p + 1` (`p − 1` in an infinite direction, because `dx
    /// = ds/s²`) it is the integral of `C t^q e^(−at − σ e^(rt))` from T on. Because `ln t ≤ ln T +
    /// (t − T)/T` and `e^(rt) ≥ e^(rT) (1 + r (t − T))`, it is at most the integrand at T divided
    /// by `D = a + σ r e^(rT) − max(q, 0)/T`, if that is positive and σ ≥ 0.
    pub fn rest(&self, k: u32, infinite: bool) -> Mag {
        if self.c.is_zero() {
            return Mag::ZERO;
        }
        let k = k.max(self.k);
        let a = Lower.add(self.p, if infinite { -1.0 } else { 1.0 });
        let divisor = self.fall(a, k);
        if !self.is_proper() || !(divisor > 0.0) {
            return Mag::INFINITY;
        }
        let there = Growth {
            p: a,
            ..self.clone()
        };
        there.at(&logarithm(k), Upper).div(Mag::from_f64(divisor))
    }

    /// A bound on the sum of the function over all integers beyond `2^k`, in an infinite direction:
    /// the integral from there on, if the bound is known and falls from there on; none where that
    /// is not sure.
    pub fn rest_of_sum(&self, k: u32) -> Option<Mag> {
        let falls = self.k <= k && (self.c.is_zero() || self.fall(self.p, k) > 0.0);
        falls
            .then(|| self.rest(k, true))
            .filter(|rest| rest.is_finite())
    }

    /// The greatest value of the quotient of an upper and a lower bound.
    pub(super) fn over(&self, lower: &Growth) -> Option<Mag> {
        if self.c.is_zero() {
            return Some(Mag::ZERO);
        }
        self.mul(&lower.inverse(Upper)?, Upper)
            .greatest()
            .filter(|m| m.is_finite())
    }

    /// An upper bound on the sum of two upper bounds: the larger times a constant.
    pub(super) fn add(&self, other: &Growth) -> Option<Growth> {
        if self.c.is_zero() {
            return Some(other.clone());
        }
        if other.c.is_zero() {
            return Some(self.clone());
        }
        let one = Mag::from_f64(1.0);
        [[self, other], [other, self]]
            .into_iter()
            .find_map(|[large, small]| {
                // A bound on either side of itself.
                let ratio = small.over(large)?;
                Some(large.scaled(one.add(ratio), Upper))
            })
    }
}

/// σ and r of the product of two exponentials: that of the greater r, which takes in the other.
///
/// `e^(−σ s^−r)` with the smaller r is at most 1 for σ ≥ 0, and for σ < 0 `s^−r ≤ 2^(k (r − R))
/// s^−R`; for lower bounds the other way.
fn exponent_sum([a, b]: [&Growth; 2], k: u32, side: Side) -> (f64, f64) {
    let against = side.other();
    if a.sigma == 0.0 || b.sigma == 0.0 {
        let kept = if a.sigma == 0.0 { b } else { a };
        return (kept.sigma, kept.r);
    }
    if a.r == b.r {
        return (against.add(a.sigma, b.sigma), a.r);
    }
    let (large, small) = if a.r > b.r { (a, b) } else { (b, a) };
    let harmless = match side {
        Upper => small.sigma >= 0.0,
        Lower => small.sigma <= 0.0,
    };
    if harmless {
        return (large.sigma, large.r);
    }
    let shrink = distance(k, small.r - large.r).to_f64() * (1.0 + 1e-12);
    (
        against.add(large.sigma, against.mul(small.sigma, shrink)),
        large.r,
    )
}

#[cfg(test)]
mod tests;
