//! Real balls in machine words: a midpoint of 128 bits and a radius in units of its last place.
//!
//! The contract is that of [`Ball`]: the result of an operation on balls contains the result of the
//! operation on any numbers in them. Midpoints are cut off towards zero, which is off by less than
//! one unit in the last place. Every value is of one size and on the stack: an operation takes
//! between a tenth and a third of the time that it takes in MPFR with as many bits.

mod elementary;

use crate::{Ball, Mag};
use gmp_mpfr_sys::gmp::LIMB_BITS;
use rug::{Float, Rational};
use std::cmp::Ordering;

/// The number `±m 2^e`, known to within `r 2^e`.
///
/// `m` has its highest bit set, or is zero. The radius is finite.
#[derive(Clone, Copy, Debug)]
pub struct Ball128 {
    m: u128,
    e: i64,
    negative: bool,
    r: f64,
}

/// The highest bit of a midpoint.
const HIGHEST: u128 = 1 << 127;

/// The largest radius in units of the last place; it is beyond the midpoint.
const WIDEST: f64 = 1e60;

/// Radii up to this one have doubles in units of any exponent that is neither tiny nor huge.
const HUGE: f64 = 1e48;

/// The least radius but zero, so that no product of it underflows.
const LEAST: f64 = 1e-30;

/// The largest exponent in magnitude.
const FARTHEST: i64 = 1 << 40;

/// More than the relative error of eight operations on doubles that are not negative, and of
/// midpoints of which the leading 64 bits are taken: `(1 + 2^-53)^8 (1 + 2^-63) < 1 + 2^-49`.
const UP: f64 = 1.0 + 8.0 * f64::EPSILON;

const LOW: u128 = u64::MAX as u128;

/// `2^k`; zero below the normal numbers and infinity above them.
fn power_of_two(k: i64) -> f64 {
    match k {
        -1022..=1023 => f64::from_bits(((k + 1023) as u64) << 52),
        ..=-1023 => 0.0,
        _ => f64::INFINITY,
    }
}

/// `m 2^-128` from its leading 64 bits.
fn fraction(m: u128) -> f64 {
    (m >> 64) as u64 as f64 * power_of_two(-64)
}

/// The product of two numbers as its upper and lower half.
fn product(a: u128, b: u128) -> (u128, u128) {
    let [(a1, a0), (b1, b0)] = [a, b].map(|x| (x >> 64, x & LOW));
    let (low, left, right) = (a0 * b0, a0 * b1, a1 * b0);
    let middle = (low >> 64) + (left & LOW) + (right & LOW);
    let high = a1 * b1 + (left >> 64) + (right >> 64) + (middle >> 64);
    (high, middle << 64 | low & LOW)
}

/// A number of 256 bits: its upper and its lower half.
type Wide = (u128, u128);

/// `a − b`, of which the upper half is signed.
fn difference(a: Wide, b: Wide) -> (i128, u128) {
    let (low, borrow) = a.1.overflowing_sub(b.1);
    (
        a.0.wrapping_sub(b.0).wrapping_sub(borrow.into()) as i128,
        low,
    )
}

/// Brings a guess with 50 bits right to within a few units, by two steps of Newton's method in
/// doubles: each brings 50 bits more. `rest` is the exact residual, and `slope` its derivative.
fn refined(guess: f64, slope: f64, rest: impl Fn(u128) -> (i128, u128)) -> u128 {
    // Saturates.
    let mut x = guess as u128;
    for _ in 0..2 {
        let (high, low) = rest(x);
        let left = high as f64 * power_of_two(128) + (low >> 64) as u64 as f64 * power_of_two(64);
        x = x.saturating_add_signed((left / slope) as i128);
    }
    x
}

/// The quotient of `high 2^128 + low` by `d` without its fraction, and whether it is exact;
/// `high < d`, and the highest bit of `d` is set.
fn quotient(high: u128, low: u128, d: u128) -> (u128, bool) {
    let divisor = fraction(d);
    let guess = fraction(high) / divisor * power_of_two(128);
    let rest = |q: u128| difference((high, low), product(q, d));
    let mut q = refined(guess, divisor * power_of_two(128), rest);
    loop {
        let (above, left) = rest(q);
        if above < 0 {
            q -= 1;
        } else if above > 0 || left >= d {
            q += 1;
        } else {
            return (q, left == 0);
        }
    }
}

/// The integer below the root of `high 2^128 + low`, where one of the two highest bits of `high` is
/// set, and whether it is the root.
fn root(high: u128, low: u128) -> (u128, bool) {
    let guess = fraction(high).sqrt() * power_of_two(128);
    let rest = |s: u128| difference((high, low), product(s, s));
    let mut s = refined(guess, 2.0 * guess, rest);
    loop {
        let (above, left) = rest(s);
        if above < 0 {
            s -= 1;
        } else if (above as u128, left) > (s >> 127, s << 1) {
            s += 1;
        } else {
            return (s, above == 0 && left == 0);
        }
    }
}

impl Ball128 {
    /// Zero.
    pub const ZERO: Ball128 = Ball128 {
        m: 0,
        e: 0,
        negative: false,
        r: 0.0,
    };

    /// Brings the highest bit into its place. None if the radius or the exponent is too large.
    fn normal(negative: bool, m: u128, e: i64, r: f64) -> Option<Ball128> {
        let shift = m.leading_zeros();
        let (m, e, r) = match shift {
            0 => (m, e, r),
            128 if r == 0.0 => return Some(Ball128::ZERO),
            128 => (0, e, r),
            _ => (
                m << shift,
                e - i64::from(shift),
                r * power_of_two(shift.into()),
            ),
        };
        let r = if r == 0.0 { r } else { r.max(LEAST) };
        (r <= WIDEST && e.abs() <= FARTHEST).then_some(Ball128 { m, e, negative, r })
    }

    /// An integer, exactly.
    pub fn integer(n: i64) -> Ball128 {
        let m = u128::from(n.unsigned_abs());
        Ball128::normal(n < 0, m, 0, 0.0).unwrap_or(Ball128::ZERO)
    }

    /// A rational number whose denominator is a power of two and whose numerator has at most 128
    /// bits but for limbs of zeros, exactly.
    pub fn dyadic(q: &Rational) -> Option<Ball128> {
        let (one, zeros) = q.denom().as_limbs().split_last()?;
        if LIMB_BITS != 64 || !one.is_power_of_two() || zeros.iter().any(|&limb| limb != 0) {
            return None;
        }
        let places = 64 * zeros.len() as i64 + i64::from(one.trailing_zeros());
        let mut limbs = q.numer().as_limbs();
        let mut e = -places;
        while let [0, rest @ ..] = limbs {
            limbs = rest;
            e += 64;
        }
        let m = match *limbs {
            [] => return Some(Ball128::ZERO),
            [low] => u128::from(low),
            [low, high] => u128::from(high) << 64 | u128::from(low),
            _ => return None,
        };
        Ball128::normal(q.is_negative(), m, e, 0.0)
    }

    /// The ball of 128 bits around a ball. None if it is unbounded or too wide.
    pub fn of_ball(x: &Ball) -> Option<Ball128> {
        let units = |e: i64| {
            let r = x.rad().shift(-e).to_f64();
            if r == 0.0 { r } else { r.max(LEAST) }
        };
        if x.mid().is_zero() {
            // In units in which the radius is a number of moderate size.
            let e = x.rad().exponent().unwrap_or(0);
            return Ball128::normal(false, 0, e, units(e));
        }
        let e = i64::from(x.mid().get_exp()?) - 128;
        let significand = x.mid().get_significand()?;
        let (m, is_cut) = match (significand.as_limbs(), LIMB_BITS) {
            (&[high], 64) => (u128::from(high) << 64, false),
            (&[ref rest @ .., low, high], 64) => (
                u128::from(high) << 64 | u128::from(low),
                rest.iter().any(|&limb| limb != 0),
            ),
            _ => return None,
        };
        let r = (units(e) + f64::from(u8::from(is_cut))) * UP;
        Ball128::normal(x.mid().is_sign_negative(), m, e, r)
    }

    /// The same ball with a midpoint in MPFR. None beyond its exponents.
    pub fn to_ball(&self) -> Option<Ball> {
        let e = i32::try_from(self.e).ok().filter(|e| e.abs() < 1 << 29)?;
        // A midpoint of which the lower half is zero takes one limb.
        let mid = match (self.m >> 64) as u64 {
            high if self.m & LOW == 0 => Float::with_val(64, high) << (e + 64),
            _ => Float::with_val(128, self.m) << e,
        };
        let mid = if self.negative { -mid } else { mid };
        Some(Ball::new(mid, Mag::from_f64(self.r).shift(self.e)))
    }

    /// Returns true if the number is known exactly.
    pub fn is_exact(&self) -> bool {
        self.r == 0.0
    }

    /// Returns true if the number is certainly zero.
    pub fn is_zero(&self) -> bool {
        self.m == 0 && self.r == 0.0
    }

    /// Returns true if the radius is less than the magnitude of the midpoint.
    fn is_off_zero(&self) -> bool {
        // Rounded down.
        self.m != 0 && self.r < (self.m >> 64) as u64 as f64 * (power_of_two(64) / UP)
    }

    /// Doubles below and above the number; none where it is tiny or huge.
    pub fn doubles(&self) -> Option<[f64; 2]> {
        if self.is_zero() {
            return Some([0.0; 2]);
        }
        if !(-900..=700).contains(&self.e) || self.r > HUGE {
            return None;
        }
        let unit = power_of_two(self.e);
        let size = (self.m >> 64) as u64 as f64 * power_of_two(64) * unit;
        // The rounding of the leading 64 bits and what is cut off them.
        let off = (size * f64::EPSILON + self.r * unit) * UP;
        let mid = if self.negative { -size } else { size };
        Some([(mid - off).next_down(), (mid + off).next_up()])
    }

    /// The sign of the number: zero if it is exactly zero, none if it is not known.
    pub fn sign(&self) -> Option<Ordering> {
        match (self.is_off_zero(), self.negative) {
            (true, false) => Some(Ordering::Greater),
            (true, true) => Some(Ordering::Less),
            (false, _) => self.is_zero().then_some(Ordering::Equal),
        }
    }

    /// The greatest integer that is at most the number. None if numbers of the ball have several, or
    /// ones beyond 2^62.
    pub fn floor(&self) -> Option<i64> {
        if self.is_zero() {
            return Some(0);
        }
        if self.m != 0 && self.e + 128 > 62 {
            return None;
        }
        // The midpoint is between `units` and the next integer, in units of 2^-places; so is the radius.
        let places = match self.m {
            0 => 120,
            _ => 124 - (self.e + 128).max(0),
        };
        let shift = -places - self.e;
        let (size, rest) = match shift {
            _ if self.m == 0 => (0, 0),
            ..=127 => (self.m >> shift, self.m << (128 - shift)),
            _ => (0, self.m),
        };
        let units = if self.negative {
            -(size as i128)
        } else {
            size as i128
        };
        let [below, above] = match (rest != 0, self.negative) {
            (false, _) => [0, 0],
            (true, false) => [0, 1],
            (true, true) => [1, 0],
        };
        // An exact number between integers stays between them when its last bits are cut off.
        let whole = |x: i128| (x >> places) as i64;
        if self.r == 0.0 {
            return Some(whole(units - below));
        }
        let r = self.r * power_of_two(-shift) * UP;
        if !(r < power_of_two(122)) {
            return None;
        }
        let r = r as i128 + 1;
        let [low, high] = [whole(units - below - r), whole(units + above + r)];
        (low == high).then_some(low)
    }

    /// Bits of relative accuracy; the largest number for one that is exact, none if zero is not
    /// excluded.
    pub fn accuracy(&self) -> Option<i64> {
        match self.r == 0.0 {
            true => Some(i64::MAX),
            // The midpoint is at least 2^127, and `|x| ≥ |m| − r ≥ |m|/2` from one bit on.
            false => {
                let above = (self.r.to_bits() >> 52) as i64 - 1022;
                self.is_off_zero().then_some(126 - above)
            }
        }
    }

    /// Exponents of two above the magnitude, at most the magnitude and above the radius; none where
    /// these are zero or may be.
    pub fn exponents(&self) -> [Option<i64>; 3] {
        // The exponent above a number.
        let above = |r: f64| (r > 0.0).then(|| self.e + (r.to_bits() >> 52) as i64 - 1022);
        let radius = above(self.r);
        let middle = (self.m != 0).then_some(self.e + 128);
        let upper = match (middle, radius) {
            (Some(a), Some(b)) => Some(a.max(b) + 1),
            (a, b) => a.or(b),
        };
        // At least a 2^-49th of the midpoint is left.
        let lower = self
            .is_off_zero()
            .then(|| match self.r < power_of_two(126) {
                true => self.e + 126,
                false => self.e + 70,
            });
        [upper, lower, radius]
    }

    /// The binary64 nearest to all numbers of the ball; none if they have several, or if it is
    /// subnormal or infinite.
    pub fn nearest_f64(&self) -> Option<f64> {
        /// Half a unit in the last place of a number of 53 bits.
        const HALF: u128 = 1 << 74;
        if self.is_zero() {
            return Some(0.0);
        }
        // The spacing below a power of two is half of that above.
        if self.m == 0 || self.r >= power_of_two(72) || !(-1140..=890).contains(&self.e) {
            return None;
        }
        let (kept, rest) = (self.m >> 75, self.m & (2 * HALF - 1));
        let r = self.r.ceil() as u128;
        let kept = match () {
            () if rest + r < HALF => kept,
            () if rest > HALF + r => kept + 1,
            // A tie goes to the even one.
            () if rest == HALF && self.r == 0.0 => kept + (kept & 1),
            () => return None,
        };
        // In two steps, of which neither leaves the normal numbers.
        let e = self.e + 75;
        let x = kept as u64 as f64 * power_of_two(e / 2) * power_of_two(e - e / 2);
        Some(if self.negative { -x } else { x })
    }

    /// `−x`.
    #[must_use]
    pub fn negative(&self) -> Ball128 {
        Ball128 {
            negative: !self.negative && self.m != 0,
            ..*self
        }
    }

    /// `x + y`.
    pub fn add(&self, other: &Ball128) -> Option<Ball128> {
        if self.is_zero() {
            return Some(*other);
        }
        if other.is_zero() {
            return Some(*self);
        }
        let (a, b) = match self.e >= other.e {
            true => (self, other),
            false => (other, self),
        };
        // A midpoint of zero has no place of its own: a unit of the other one's is as good.
        if a.m == 0 {
            let r = a.r * power_of_two(a.e - b.e) + b.r;
            return Ball128::normal(b.negative, b.m, b.e, r * UP);
        }
        let d = a.e - b.e;
        let (shifted, is_cut) = match d {
            0 => (b.m, false),
            1..=127 => (b.m >> d, b.m << (128 - d) != 0),
            _ => (0, b.m != 0),
        };
        // A power of two that is less than every number counts as the least radius.
        let b_radius = match b.r == 0.0 {
            true => 0.0,
            false => (b.r * power_of_two(-d)).max(LEAST),
        };
        let mut r = a.r + b_radius;
        let mut e = a.e;
        let (m, negative, is_cut) = if a.negative == b.negative {
            match a.m.overflowing_add(shifted) {
                (sum, false) => (sum, a.negative, is_cut),
                (sum, true) => {
                    e += 1;
                    r *= 0.5;
                    (sum >> 1 | HIGHEST, a.negative, is_cut || sum & 1 != 0)
                }
            }
        } else {
            match a.m >= shifted {
                true => (a.m - shifted, a.negative, is_cut),
                // Only where nothing was cut off.
                false => (shifted - a.m, b.negative, is_cut),
            }
        };
        if is_cut {
            r += 1.0;
        }
        Ball128::normal(negative && m != 0, m, e, r * UP)
    }

    /// `x − y`.
    pub fn sub(&self, other: &Ball128) -> Option<Ball128> {
        self.add(&other.negative())
    }

    /// `x y`: off by `|x| r_y + |y| r_x + r_x r_y` and what is cut off.
    pub fn mul(&self, other: &Ball128) -> Option<Ball128> {
        if self.is_zero() || other.is_zero() {
            return Some(Ball128::ZERO);
        }
        let (high, low) = product(self.m, other.m);
        let r = self.r * fraction(other.m)
            + other.r * fraction(self.m)
            + self.r * other.r * power_of_two(-128);
        let negative = self.negative != other.negative;
        let e = self.e + other.e + 128;
        match high & HIGHEST == 0 && high != 0 {
            false => {
                let cut = f64::from(u8::from(low != 0));
                Ball128::normal(negative && high != 0, high, e, (r + cut) * UP)
            }
            true => {
                let cut = f64::from(u8::from(low << 1 != 0));
                let r = (2.0 * r + cut) * UP;
                Ball128::normal(negative, high << 1 | low >> 127, e - 1, r)
            }
        }
    }

    /// `x / y`: off by `(r_x + |x/y| r_y) / (|y| − r_y)` and what is cut off. None unless `y` is
    /// known to some bits.
    pub fn div(&self, other: &Ball128) -> Option<Ball128> {
        if other.m == 0 || other.r > power_of_two(100) {
            return None;
        }
        if self.is_zero() {
            return Some(Ball128::ZERO);
        }
        let [a, b] = [self.m, other.m].map(fraction);
        // The leading 64 bits of the divisor are below it, by less than 2^-63 of itself.
        let b_least = (b - other.r * power_of_two(-128)) / UP;
        let mut r = (self.r + a / b * UP * other.r) / b_least;
        let (q, is_exact, e) = if self.m < other.m {
            let (q, is_exact) = quotient(self.m, 0, other.m);
            (q, is_exact, self.e - other.e - 128)
        } else {
            r *= 0.5;
            let (q, is_exact) = quotient(self.m >> 1, self.m << 127, other.m);
            (q, is_exact, self.e - other.e - 127)
        };
        let cut = f64::from(u8::from(!is_exact));
        let negative = self.negative != other.negative && q != 0;
        Ball128::normal(negative, q, e, (r + cut) * UP)
    }

    /// `√x`: off by `r/√x` and what is cut off. None where the number may be negative.
    pub fn sqrt(&self) -> Option<Ball128> {
        if self.is_zero() {
            return Some(Ball128::ZERO);
        }
        if self.sign() != Some(Ordering::Greater) {
            return None;
        }
        // `|√x − √m| ≤ r/√m`, because the sum of the roots is at least √m.
        let r = self.r / fraction(self.m).sqrt();
        let odd = self.e & 1;
        let (s, is_exact) = match odd {
            0 => root(self.m, 0),
            _ => root(self.m >> 1, self.m << 127),
        };
        let cut = f64::from(u8::from(!is_exact));
        let r = match odd {
            0 => r,
            _ => r * std::f64::consts::FRAC_1_SQRT_2,
        };
        Ball128::normal(false, s, (self.e - 128 + odd) / 2, (r + cut) * UP)
    }

    /// `x^k` by squaring.
    pub fn power(&self, k: i32) -> Option<Ball128> {
        let mut left = k.unsigned_abs();
        let mut square = *self;
        let mut found = Ball128::integer(1);
        while left > 0 {
            if left & 1 == 1 {
                found = found.mul(&square)?;
            }
            left >>= 1;
            if left > 0 {
                square = square.mul(&square)?;
            }
        }
        match k < 0 {
            true => Ball128::integer(1).div(&found),
            false => Some(found),
        }
    }
}

#[cfg(test)]
mod tests;
