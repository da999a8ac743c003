//! Describes what the code computes over a box of inputs: its value in exact arithmetic, and how
//! far rounding takes it from there.
//!
//! At every point of the box, for each operation number k there is an `ε_k` in `[−1, 1]` such that
//! the number computed is
//!
//! ```text
//! v = s (m + Σ_k c_k ε_k + r) + t        |r| ≤ rest,  |t| ≤ 2⁻¹⁰⁷⁵ tiny
//! ```
//!
//! with `m` what exact arithmetic gives, `c_k` a function of the point, and `s` one or the small
//! coordinate σ ([`Setting::sigma`]). `m` and every `c_k` are known by an interval over the box.
//! Since an `ε_k` is the same in all numbers that depend on operation k, `v₁ − v₂` has it with
//! `c_k − c′_k`: what a correction takes back is taken back here too.
//!
//! Transfer rules and their proofs: the chapter on proofs of the book of `mechaudit`.

use crate::exact::Exact;
use crate::interval::{Interval, product_up, quotient_up, sum_up, up};

/// `2^k`, `−1074 ≤ k ≤ 1023`.
pub(crate) fn power_of_two(k: i32) -> f64 {
    assert!((-1074..=1023).contains(&k), "{k} is no exponent of f64");
    if k < -1022 {
        f64::from_bits(1 << (k + 1074))
    } else {
        f64::from_bits(((k + 1023) as u64) << 52)
    }
}

/// `⌊log₂ x⌋` of a positive number; 1024 for infinity.
pub(crate) fn exponent(x: f64) -> i32 {
    let bits = x.to_bits();
    match (bits >> 52) as i32 {
        0 => 63 - bits.leading_zeros() as i32 - 1074,
        e => e - 1023,
    }
}

/// The smallest positive number, twice the unit of [`Form::tiny`].
pub(crate) const TINIEST: f64 = f64::from_bits(1);

/// One number over the box.
#[derive(Clone, Debug)]
pub(crate) struct Form {
    /// m.
    pub main: Exact,
    /// `(k, c_k)`, k ascending.
    pub terms: Vec<(u32, Interval)>,
    /// Bound of r.
    pub rest: f64,
    /// Bound of t in units of 2⁻¹⁰⁷⁵, what a rounding below the normal numbers may be off.
    pub tiny: f64,
    /// Tells whether s is σ.
    pub small: bool,
    /// v is a multiple of `2^grain`.
    pub grain: i32,
    /// `Σ |c_k| + rest`.
    pub deviation: f64,
    /// Bound of `|v − t − s m|/(s |m|)` that sums of numbers of one sign keep; see
    /// [`Form::relative`].
    pub share: f64,
}

impl Form {
    /// A number known exactly.
    pub fn point(x: f64) -> Form {
        Form::exact(Exact::point(x), grain_of_point(x))
    }

    /// Any `f64` of an interval.
    pub fn exact(main: Exact, grain: i32) -> Form {
        Form {
            main,
            terms: Vec::new(),
            rest: 0.0,
            tiny: 0.0,
            small: false,
            grain,
            deviation: 0.0,
            share: f64::INFINITY,
        }
    }

    /// The error as a part of m: of the sum of two numbers of one sign no larger than the larger of
    /// theirs, however different their sizes are over the box.
    pub fn relative(&self) -> f64 {
        let by_size = quotient_up(self.deviation, self.main.range.mignitude());
        self.share.min(by_size)
    }

    /// With its deviation computed.
    pub fn summed(mut self) -> Form {
        // Far out what underflowed is multiplied by |z|² again and again: its unit would overflow.
        if self.tiny > 1e100 && !self.small {
            self.rest = sum_up(self.rest, product_up(self.tiny, TINIEST));
            (self.tiny, self.share) = (0.0, f64::INFINITY);
        }
        let terms = self.terms.iter();
        self.deviation = terms.fold(self.rest, |sum, (_, c)| sum_up(sum, c.magnitude()));
        self
    }

    pub fn is_zero(&self) -> bool {
        self.main.is_zero() && self.terms.is_empty() && self.rest == 0.0 && self.tiny == 0.0
    }

    /// The number, if it is the same `f64` all over the box.
    pub fn constant(&self) -> Option<f64> {
        let alone = self.terms.is_empty() && self.rest == 0.0 && self.tiny == 0.0;
        (alone && !self.small && self.main.range.is_point()).then_some(self.main.range.lo)
    }

    /// An enclosure of `v/s`, t left out.
    pub fn value(&self) -> Interval {
        self.main.range.widened(self.deviation)
    }

    /// An enclosure of v.
    pub fn range(&self, sigma: Exact) -> Interval {
        let value = self.value();
        let value = if self.small {
            value * sigma.range
        } else {
            value
        };
        value.widened(product_up(self.tiny, TINIEST))
    }

    /// The same number with `s = 1`.
    pub fn plain(&self, sigma: Exact) -> Form {
        if !self.small {
            return self.clone();
        }
        Form {
            main: self.main * sigma,
            terms: mapped(&self.terms, |c| c * sigma.range),
            rest: product_up(self.rest, sigma.range.hi),
            small: false,
            ..*self
        }
        .summed()
    }

    /// `−v`, exactly.
    pub fn negative(&self) -> Form {
        Form {
            main: -self.main,
            terms: mapped(&self.terms, |c| -c),
            ..*self
        }
    }

    /// `2v`, exactly.
    pub fn doubled(&self) -> Form {
        let two = |c: Interval| Interval::new(c.lo * 2.0, c.hi * 2.0);
        Form {
            main: self.main.scaled(2.0, two(self.main.range)),
            terms: mapped(&self.terms, two),
            rest: self.rest * 2.0,
            tiny: self.tiny * 2.0,
            grain: self.grain.saturating_add(1),
            deviation: self.deviation * 2.0,
            ..*self
        }
    }
}

/// Each `c_k` changed alike.
pub(crate) fn mapped(
    terms: &[(u32, Interval)],
    f: impl Fn(Interval) -> Interval,
) -> Vec<(u32, Interval)> {
    terms.iter().map(|&(k, c)| (k, f(c))).collect()
}

/// `a + b` by the same `ε`.
fn merged(
    a: &[(u32, Interval)],
    b: &[(u32, Interval)],
    f: impl Fn(Option<Interval>, Option<Interval>) -> Interval,
) -> Vec<(u32, Interval)> {
    let mut out = Vec::with_capacity(a.len() + b.len() + 1);
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        let (p, q) = (a.get(i), b.get(j));
        let k = match (p, q) {
            (Some(p), Some(q)) => p.0.min(q.0),
            (Some(p), None) => p.0,
            (None, Some(q)) => q.0,
            (None, None) => break,
        };
        let take = |at: &mut usize, t: Option<&(u32, Interval)>| {
            let t = t.filter(|t| t.0 == k)?;
            *at += 1;
            Some(t.1)
        };
        let (x, y) = (take(&mut i, p), take(&mut j, q));
        let c = f(x, y);
        if !c.is_zero() {
            out.push((k, c));
        }
    }
    out
}

/// `x + y` before rounding; both with the same s.
pub(crate) fn sum(x: &Form, y: &Form) -> Form {
    let both = |a: Option<Interval>, b: Option<Interval>| {
        a.unwrap_or(Interval::ZERO) + b.unwrap_or(Interval::ZERO)
    };
    let share = match x.main.range.lo >= 0.0 && y.main.range.lo >= 0.0 {
        true => x.relative().max(y.relative()),
        false => f64::INFINITY,
    };
    Form {
        terms: merged(&x.terms, &y.terms, both),
        rest: sum_up(x.rest, y.rest),
        tiny: sum_up(x.tiny, y.tiny),
        small: x.small,
        share,
        ..Form::exact(x.main + y.main, x.grain.min(y.grain))
    }
    .summed()
}

/// `x y` before rounding, at most one of them with `s = σ`; `square` if they are the same number.
///
/// `(X + Σ x_k ε_k + r)(Y + Σ y_k ε_k + q) = XY + Σ (X y_k + Y x_k) ε_k + …`, what is left out at
/// most `|X| q + |Y| r` and the product of the deviations.
pub(crate) fn product(x: &Form, y: &Form, sigma: Exact, square: bool) -> Form {
    let main = match square {
        true => x.main.square(),
        false => x.main * y.main,
    };
    let (p, q) = (x.main.range, y.main.range);
    let (rx, ry) = (x.relative(), y.relative());
    let both = |a: Option<Interval>, b: Option<Interval>| {
        let a = a.map_or(Interval::ZERO, |a| a * q);
        let b = b.map_or(Interval::ZERO, |b| b * p);
        a + b
    };
    let cross = sum_up(
        product_up(p.magnitude(), y.rest),
        product_up(q.magnitude(), x.rest),
    );
    let tiny = match x.tiny == 0.0 && y.tiny == 0.0 {
        true => 0.0,
        false => sum_up(
            product_up(x.tiny, y.range(sigma).magnitude()),
            product_up(y.tiny, x.range(sigma).magnitude()),
        ),
    };
    Form {
        terms: merged(&x.terms, &y.terms, both),
        rest: sum_up(cross, product_up(x.deviation, y.deviation)),
        tiny,
        small: x.small || y.small,
        share: sum_up(sum_up(rx, ry), product_up(rx, ry)),
        ..Form::exact(main, x.grain.saturating_add(y.grain))
    }
    .summed()
}

/// `x/y` before rounding, y with `s = 1`; `None` if y may be zero.
///
/// With `Q = X/Y` and the deviations d, e: `(X + d)/(Y + e) = Q + (d − Q e)/(Y + e)`, whose
/// first-order part is `(x_k − Q y_k)/Y`; what is left out at most `(r + |Q| q)/|Y|` and
/// `(|d| + |Q| |e|) |e|/(|Y| |Y + e|)`.
pub(crate) fn quotient(x: &Form, y: &Form) -> Option<Form> {
    let least = y.value().mignitude();
    if y.small || least == 0.0 || y.tiny != 0.0 {
        return None;
    }
    let main = x.main.over(y.main);
    let (q, below) = (main.range, y.main.range);
    let (size, low) = (q.magnitude(), below.mignitude());
    let both = |a: Option<Interval>, b: Option<Interval>| {
        let a = a.unwrap_or(Interval::ZERO);
        let b = b.map_or(Interval::ZERO, |b| q * b);
        (a - b) / below
    };
    let first = quotient_up(sum_up(x.rest, product_up(size, y.rest)), low);
    let all = sum_up(x.deviation, product_up(size, y.deviation));
    let second = quotient_up(product_up(quotient_up(all, low), y.deviation), least);
    let quotient = Form {
        terms: merged(&x.terms, &y.terms, both),
        rest: sum_up(first, second),
        tiny: quotient_up(x.tiny, least),
        small: x.small,
        ..Form::exact(main, i32::MIN)
    };
    Some(quotient.summed())
}

/// The exponent of the spacing of numbers from `x ≥ 0` on: all of them are multiples of `2^` of it.
pub(crate) fn grain_of(x: f64) -> i32 {
    (exponent(x) - 52).max(-1074)
}

/// The same for one number, by its last bit that is set.
pub(crate) fn grain_of_point(x: f64) -> i32 {
    if x == 0.0 || !x.is_finite() {
        return grain_of(x.abs());
    }
    // The leading bit of a normal number is not stored; it ends the count.
    let zeros = (x.to_bits() | 1 << 52).trailing_zeros();
    grain_of(x.abs()) + zeros as i32
}

/// The error of one rounding of the number that `form` encloses, in units of s, and the part of it
/// that is absolute; `None` if the number is an `f64` all over the box. `factor` is 1 for rounding
/// to nearest.
pub(crate) fn rounding(form: &Form, sigma: Exact, factor: f64) -> Option<(f64, f64)> {
    let range = form.range(sigma);
    let most = range.magnitude();
    if most == 0.0 {
        return None;
    }
    let e = exponent(most);
    if form.grain >= -1074 && e < form.grain + 53 {
        return None;
    }
    if e >= 1023 {
        return Some((f64::INFINITY, 0.0));
    }
    let half = e - 53;
    if !form.small {
        return Some(match half < -1074 {
            true => (0.0, factor),
            false => (factor * power_of_two(half), 0.0),
        });
    }
    // Half a unit in the last place of v is at most 2⁻⁵³|v|.
    let relative = up(form.value().magnitude() * factor * power_of_two(-53));
    let by_size = match half >= -1074 && sigma.range.lo > 0.0 {
        true => quotient_up(factor * power_of_two(half), sigma.range.lo),
        false => f64::INFINITY,
    };
    if by_size <= relative {
        return Some((by_size, 0.0));
    }
    // At most 2⁻⁵³ (|s (v − t)| + |t|), or half the spacing of subnormal numbers.
    let of_tiny = if form.tiny == 0.0 {
        0.0
    } else {
        sum_up(1.0, form.tiny * 1e-15)
    };
    let subnormal = if range.mignitude() < f64::MIN_POSITIVE {
        1.0
    } else {
        0.0
    };
    Some((relative, factor * sum_up(of_tiny, subnormal)))
}

/// The form after its rounding with operation `k` as the error's ε.
pub(crate) fn rounded(
    mut form: Form,
    sigma: Exact,
    (error, absolute): (f64, f64),
    factor: f64,
    k: u32,
) -> Form {
    // At most 2⁻⁵³|v|, unless v may be below the normal numbers.
    let unit = factor * power_of_two(-53);
    let relative = form.relative();
    let least = match relative < 0.5 && !form.small {
        true => 0.5 * form.main.range.mignitude(),
        false => form.range(sigma).mignitude(),
    };
    let normal = form.tiny == 0.0 && least >= f64::MIN_POSITIVE;
    form.share = match normal {
        true => sum_up(sum_up(relative, unit), product_up(relative, unit)),
        false => f64::INFINITY,
    };
    if error != 0.0 {
        form.terms.push((k, Interval::point(error)));
        form.deviation = sum_up(form.deviation, error);
    }
    form.tiny = sum_up(form.tiny, absolute);
    regrained(form, sigma)
}

/// The form with the grain that its size gives.
pub(crate) fn regrained(mut form: Form, sigma: Exact) -> Form {
    let least = form.range(sigma).mignitude();
    form.grain = form.grain.max(grain_of(least));
    form
}

#[cfg(test)]
mod tests;
