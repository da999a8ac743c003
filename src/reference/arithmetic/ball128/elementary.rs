//! The exponential function and circular functions in machine words.
//!
//! Numbers in `[0, 1)` are integers of 128 bits in units of `u = 2^−128`. An argument is reduced,
//! `x = n c + f` with c = ln 2 or π/4 and `0 ≤ f < c`; f is off by less than 4u: what is cut off x
//! and off two parts of `n c`, and the part of c below `2^−192`, which is at most `2^21 2^−192`
//! times n. Then `f = t + s` with t in a table, and a few terms of a power series in s. All steps
//! are cut off downwards, each by less than u; entries of tables and coefficients are off by less
//! than 1.01u. With the errors of a sum of a product counted by its factors:
//!
//! * `e^f = T + T (A + E + A E)` with `T = e^t`, `t = k 2^−8`, and `A + 1` the same of `k 2^−16`.
//!   E is off by 1.3u and the bracket by 3.4u. T is less than 2 and in units of 2u, so that e^f is
//!   off by `(4 + 3.4 + 1 + 1.02) 2u`.
//! * With `S = sin t` and `D = 1 − cos t`, `t = k 2^−8`, and `v = 1 − cos s`:
//!   `sin f = S − S v + sin s − D sin s` and `1 − cos f = D + v − D v + S sin s`. The series are off
//!   by 1.2u and 1.7u, and the sums by less than 7u; with f by less than 12u.
//!
//! The omitted terms are below `2^−143` for the exponential function (`s < 2^−16`), and below
//! `2^−148` (`s < 2^−8`). The radius of the argument is that of sines, and `e^x (e^r − 1)` is at
//! most `e^x (r + r²)` for r ≤ 1.

use super::{Ball128, HIGHEST, LOW, UP, power_of_two, product};
use crate::arithmetic::fixed::Fraction;
use crate::arithmetic::nearest;
use std::sync::OnceLock;

/// The errors above, in units of the last place.
const EXP_ERROR: f64 = 10.0;
const WAVE_ERROR: f64 = 12.0;

/// Arguments are less than 2 to this power.
const TOP: i64 = 20;

/// Radii are at most this.
const WIDE: f64 = 0.25;

/// Sines and cosines below 2^−16 lose too many bits here.
const SMALL: u128 = 1 << 112;

/// Numbers of 192 bits below one: a part in units of `2^−128`, and the rest in units of `2^−192`.
type Long = (u128, u64);

struct Tables {
    ln_2: Long,
    quarter_pi: Long,
    /// `e^(k/2^8)` in units of `2^−127`.
    powers: Vec<u128>,
    /// `e^(k/2^16) − 1`.
    small_powers: Vec<u128>,
    /// `sin(k/2^8)` and `1 − cos(k/2^8)`.
    waves: Vec<[u128; 2]>,
    /// `1/k!`.
    inverse_factorials: [u128; 14],
}

/// The upper half of a fraction of 256 places.
fn upper(&[_, _, low, high]: &Fraction) -> u128 {
    u128::from(high) << 64 | u128::from(low)
}

fn tables() -> &'static Tables {
    static TABLES: OnceLock<Tables> = OnceLock::new();
    TABLES.get_or_init(|| {
        let all = nearest::tables();
        let long = |x: &nearest::Long| (upper(&x.high), x.high[1]);
        Tables {
            ln_2: long(&all.ln_2),
            quarter_pi: long(&all.quarter_pi),
            powers: all.powers.iter().map(upper).collect(),
            small_powers: all.small_powers.iter().map(upper).collect(),
            waves: all.waves.iter().map(|x| x.each_ref().map(upper)).collect(),
            inverse_factorials: std::array::from_fn(|k| upper(&all.inverse_factorials[k])),
        }
    })
}

/// The product of two numbers below one.
fn times(a: u128, b: u128) -> u128 {
    product(a, b).0
}

/// A number as an integer and a fraction, modulo 2^64.
type Fixed = (u64, u128);

fn less((a, b): Fixed, (c, d): Fixed) -> Fixed {
    let (low, borrow) = b.overflowing_sub(d);
    (a.wrapping_sub(c).wrapping_sub(borrow.into()), low)
}

fn plus((a, b): Fixed, (c, d): Fixed) -> Fixed {
    let (low, carry) = b.overflowing_add(d);
    (a.wrapping_add(c).wrapping_add(carry.into()), low)
}

/// `n c` for `n < 2^32`.
fn multiple(n: u64, (high, low): Long) -> Fixed {
    let n = u128::from(n);
    let (above, below) = (
        (high >> 64) * n,
        (high & LOW) * n + ((u128::from(low) * n) >> 64),
    );
    let middle = above + (below >> 64);
    ((middle >> 64) as u64, middle << 64 | below & LOW)
}

impl Ball128 {
    /// A finite binary64 of moderate size, exactly; zero for others.
    pub fn exact(x: f64) -> Ball128 {
        let bits = x.abs().to_bits();
        let (m, e) = ((bits & ((1 << 52) - 1)) | 1 << 52, (bits >> 52) as i64);
        match e {
            1..=2046 => Ball128::normal(x < 0.0, m.into(), e - 1075, 0.0),
            _ => None,
        }
        .unwrap_or(Ball128::ZERO)
    }

    /// `2^k x`.
    #[must_use]
    pub fn shift(&self, k: i64) -> Ball128 {
        let e = if self.is_zero() { 0 } else { self.e + k };
        Ball128 { e, ..*self }
    }

    /// The ball with `2^k` added to its radius. None if it is too large.
    pub fn widened(&self, k: i64) -> Option<Ball128> {
        let extra = Ball128::normal(false, 0, k, 1.0)?;
        self.add(&extra)
    }

    /// The radius as a number, rounded up; none where the argument or the radius is too large.
    fn reach(&self) -> Option<f64> {
        let is_large = self.m != 0 && self.e + 128 > TOP;
        // Below the normal numbers it is less than what the errors are rounded up by.
        let r = self.r * power_of_two(self.e) * UP;
        (!is_large && r <= WIDE).then_some(r)
    }

    /// `|x| = n c + f` of the midpoint, which is below 2^20.
    fn reduced(&self, c: Long) -> (u64, u128) {
        let places = -self.e;
        let x: Fixed = match places {
            _ if self.m == 0 => (0, 0),
            ..=127 => ((self.m >> places) as u64, self.m << (128 - places)),
            128..=255 => (0, self.m >> (places - 128)),
            _ => (0, 0),
        };
        let size = x.0 as f64 + (x.1 >> 64) as f64 * power_of_two(-64);
        let step = (c.0 >> 64) as f64 * power_of_two(-64);
        let mut n = (size / step) as u64;
        let mut f = less(x, multiple(n, c));
        // The quotient may be off by one.
        if f.0 == u64::MAX {
            n -= 1;
            f = plus(f, (0, c.0));
        } else if f.1 >= c.0 {
            n += 1;
            f = less(f, (0, c.0));
        }
        (n, f.1)
    }

    /// `e^x`. None where the argument is too large or too wide.
    pub fn exp(&self) -> Option<Ball128> {
        if self.is_zero() {
            return Some(Ball128::integer(1));
        }
        let r = self.reach()?;
        let tables = tables();
        let (n, mut f) = self.reduced(tables.ln_2);
        let mut n = i64::try_from(n).ok()?;
        if self.negative {
            // −n ln 2 − f = −(n + 1) ln 2 + (ln 2 − f)
            (n, f) = (-n - 1, tables.ln_2.0.saturating_sub(f));
        }
        let t = *tables.powers.get((f >> 120) as usize)?;
        let a = tables.small_powers[(f >> 112 & 255) as usize];
        let s = f & (SMALL - 1);
        let c = &tables.inverse_factorials;
        let series = (2..7).rev().fold(c[7], |sum, k| c[k] + times(sum, s));
        let e = s + times(s, times(s, series));
        let m = t.checked_add(times(t, a + e + times(a, e)))?;
        // The radius beside one, and m in units of its last place.
        let r = EXP_ERROR + (m as f64) * (r + r * r) * UP;
        Ball128::normal(false, m, n - 127, r * UP)
    }

    /// `sin x` and `cos x`. None where the argument is too large or too wide, or a value is small.
    pub fn sine_cosine(&self) -> Option<[Ball128; 2]> {
        let found = self.circle()?;
        let is_large = |x: &Ball128| x.m != 0 && x.e >= -128 - i64::from(SMALL.leading_zeros());
        found.iter().all(is_large).then_some(found)
    }

    /// `sin x` and `cos x`, accurate beside 1. None where the argument is too large or too wide.
    pub fn circle(&self) -> Option<[Ball128; 2]> {
        if self.is_zero() {
            return Some([Ball128::ZERO, Ball128::integer(1)]);
        }
        let r = self.reach()?;
        let tables = tables();
        let (n, f) = self.reduced(tables.quarter_pi);
        let is_odd = n % 2 == 1;
        // −f' + (n + 1) π/4 with f' = π/4 − f.
        let f = if is_odd {
            tables.quarter_pi.0.saturating_sub(f)
        } else {
            f
        };
        let [sine, rest] = *tables.waves.get((f >> 120) as usize)?;
        let s = f & ((HIGHEST >> 7) - 1);
        let square = times(s, s);
        let c = &tables.inverse_factorials;
        let series = |last: usize| {
            let places = (2..last).rev().filter(|k| (last - k).is_multiple_of(2));
            places.fold(c[last], |sum, k| c[k] - times(sum, square))
        };
        let small = s - times(s, times(square, series(13)));
        let v = times(square, series(12));
        let sine = (sine - times(sine, v)).checked_add(small - times(rest, small))?;
        let rest = (rest + v - times(rest, v))
            .checked_add(times(tables.waves[(f >> 120) as usize][0], small))?;
        // One less than 1 where nothing is left: a unit that the error has room for.
        let cosine = u128::MAX - rest.saturating_sub(1);
        let r = (WAVE_ERROR + r * power_of_two(128)) * UP;
        let of = |is_negative, m| Ball128::normal(is_negative && m != 0, m, -128, r);
        // sin(q π/2 ± f) and cos(q π/2 ± f), the lower sign where n is odd.
        let q = n.div_ceil(2) % 4;
        let is_below = self.negative;
        Some(match q {
            0 => [of(is_odd != is_below, sine)?, of(false, cosine)?],
            1 => [of(is_below, cosine)?, of(!is_odd, sine)?],
            2 => [of(is_odd == is_below, sine)?, of(true, cosine)?],
            _ => [of(!is_below, cosine)?, of(is_odd, sine)?],
        })
    }
}
