//! A function next to an end of an interval: a truncated series, or bounds.

use super::End;
use super::bounds::{Bounds, Sign};
use super::growth::Growth;
use super::series::{Series, TERMS, sum_is_exact, whole};
use crate::{Ball, Mag};
use rug::Float;
use rug::float::Round;

/// A function of the distance s from an end, for all `0 < s ≤ 2^−k`.
///
/// A formula is evaluated in this arithmetic from [`Germ::variable`] on; [`Germ::growth`] then
/// bounds the integrand. Every operation is proved for all s at once, or answers none: the function
/// may be undefined somewhere, or a smaller distance may be needed. Points of a power of s with
/// series (`1 − x²` next to 1, `√(sin x)` next to 0) keep their zeros and poles; logarithms and
/// exponentials of what is unbounded are known by bounds alone.
#[derive(Clone, Debug)]
pub struct Germ {
    k: u32,
    form: Form,
}

#[derive(Clone, Debug)]
enum Form {
    Series(Series),
    Bounds(Bounds),
}

impl Germ {
    fn series(k: u32, series: Series) -> Germ {
        Germ {
            k,
            form: Form::Series(series.cut(k, TERMS)),
        }
    }

    fn bounds(&self) -> Option<Bounds> {
        match &self.form {
            Form::Series(series) => series.bounds(self.k),
            Form::Bounds(bounds) => Some(bounds.clone()),
        }
    }

    fn of(k: u32, bounds: Bounds) -> Germ {
        let lower = bounds.lower.map(|lower| lower.nearer(k));
        let upper = bounds.upper.nearer(k);
        let form = Form::Bounds(Bounds {
            lower,
            upper,
            ..bounds
        });
        Germ { k, form }
    }

    /// x itself, for all `0 < s ≤ 2^−k`; k is at least 2.
    pub fn variable(end: &End, k: u32, bits: u32) -> Germ {
        let one = |sign| whole(bits, sign);
        let (p, c) = match end {
            End::Above(a) => (0.0, vec![a.with_prec(bits.max(a.prec())), one(1)]),
            End::Below(a) => (0.0, vec![a.with_prec(bits.max(a.prec())), one(-1)]),
            End::PlusInfinity => (-1.0, vec![one(1)]),
            End::MinusInfinity => (-1.0, vec![one(-1)]),
        };
        Germ::series(k.max(2), Series::of(p, c))
    }

    /// A constant.
    pub fn constant(c: &Ball, k: u32) -> Germ {
        Germ::series(k.max(2), Series::of(0.0, vec![c.clone()]))
    }

    /// Any function whose values lie in a ball.
    pub fn within(values: &Ball, k: u32) -> Germ {
        let rest = values.clone();
        Germ {
            k: k.max(2),
            form: Form::Series(Series {
                p: 0.0,
                c: Vec::new(),
                rest,
            }),
        }
    }

    /// The upper bound on the absolute value.
    pub fn growth(&self) -> Option<Growth> {
        Some(self.bounds()?.upper)
    }

    /// Returns true if the function is certainly positive for all s.
    pub fn is_positive(&self) -> bool {
        self.bounds().is_some_and(|b| b.sign == Sign::Positive)
    }

    /// Returns true if the function is certainly negative for all s.
    pub fn is_negative(&self) -> bool {
        self.bounds().is_some_and(|b| b.sign == Sign::Negative)
    }

    /// The function, known to tend to zero.
    pub fn vanishing(&self) -> Germ {
        let mut germ = self.clone();
        if let Form::Series(series) = &mut germ.form
            && series.p == 0.0
            && let Some(first) = series.c.first_mut()
        {
            *first = whole(first.prec(), 0);
        }
        germ
    }

    /// `f + g`.
    pub fn add(&self, other: &Germ) -> Option<Germ> {
        let k = self.k.max(other.k);
        if let (Form::Series(a), Form::Series(b)) = (&self.form, &other.form)
            && let Some(sum) = a.add(b, k)
        {
            return Some(Germ::series(k, sum));
        }
        Some(Germ::of(k, self.bounds()?.add(&other.bounds()?)?))
    }

    /// `−f`.
    pub fn neg(&self) -> Germ {
        let form = match &self.form {
            Form::Series(a) => {
                let c = a.c.iter().map(|c| -c).collect();
                Form::Series(Series {
                    p: a.p,
                    c,
                    rest: -&a.rest,
                })
            }
            Form::Bounds(b) => {
                let sign = b.sign.times(Sign::Negative);
                Form::Bounds(Bounds { sign, ..b.clone() })
            }
        };
        Germ { k: self.k, form }
    }

    /// `f − g`.
    pub fn sub(&self, other: &Germ) -> Option<Germ> {
        self.add(&other.neg())
    }

    /// `f g`.
    pub fn mul(&self, other: &Germ) -> Option<Germ> {
        let k = self.k.max(other.k);
        if let (Form::Series(a), Form::Series(b)) = (&self.form, &other.form)
            && let Some(product) = a.mul(b, k)
        {
            return Some(Germ::series(k, product));
        }
        Some(Germ::of(k, self.bounds()?.mul(&other.bounds()?)))
    }

    /// `1/f`, where f is nowhere zero.
    pub fn recip(&self) -> Option<Germ> {
        if let Some(power) = self.series_power(-1.0, &|x, n| inverse_powers(x, n)) {
            return Some(power);
        }
        Some(Germ::of(self.k, self.bounds()?.recip()?))
    }

    /// `f/g`.
    pub fn div(&self, other: &Germ) -> Option<Germ> {
        self.mul(&other.recip()?)
    }

    /// A power of a series by a function `g(x) = x^a`, if the series without its power of s is off
    /// zero.
    fn series_power(&self, a: f64, g: &dyn Fn(&Ball, usize) -> Option<Vec<Ball>>) -> Option<Germ> {
        let Form::Series(series) = &self.form else {
            return None;
        };
        let (zeros, unit) = series.stripped();
        let p = sum_is_exact(series.p, zeros as f64)?;
        if unit.c.is_empty() || !exact_product(p, a) {
            return None;
        }
        let unit = Series { p: 0.0, ..unit };
        let power = unit.compose(self.k, g)?;
        Some(Germ::series(self.k, Series { p: p * a, ..power }))
    }

    /// `f^n`.
    pub fn powi(&self, n: i32) -> Option<Germ> {
        if n < 0 {
            return self.powi(n.checked_neg()?)?.recip();
        }
        let mut result = Germ::constant(&whole(128, 1), self.k);
        let mut square = self.clone();
        let mut left = n;
        while left > 0 {
            if left & 1 == 1 {
                result = result.mul(&square)?;
            }
            left >>= 1;
            if left > 0 {
                square = square.mul(&square)?;
            }
        }
        // An even power of a function known by bounds is not negative.
        if let Form::Bounds(bounds) = &mut result.form
            && n % 2 == 0
            && bounds.lower.is_some()
        {
            bounds.sign = Sign::Positive;
        }
        Some(result)
    }

    /// `f^a` for a positive f and a real exponent.
    pub fn pow(&self, a: &Ball) -> Option<Germ> {
        if !a.is_finite() || !self.is_positive() {
            return None;
        }
        if a.is_negative() {
            return self.pow(&-a)?.recip();
        }
        if a.is_zero() {
            return Some(Germ::constant(&whole(64, 1), self.k));
        }
        if !a.is_positive() {
            return None;
        }
        let ends = [
            a.lower().to_f64_round(Round::Down),
            a.upper().to_f64_round(Round::Up),
        ];
        if ends[0] == ends[1]
            && let Some(power) = self.series_power(ends[0], &|x, n| powers(x, a, n))
        {
            return Some(power);
        }
        Some(Germ::of(
            self.k,
            self.bounds()?.raised(ends, Sign::Positive)?,
        ))
    }

    /// `√f` for f ≥ 0, which is proved where f is positive or zero everywhere.
    pub fn sqrt(&self) -> Option<Germ> {
        let half = whole(64, 1).shift(-1);
        self.pow(&half)
    }

    /// `|f|`.
    pub fn abs(&self) -> Option<Germ> {
        let bounds = self.bounds()?;
        Some(match bounds.sign {
            Sign::Positive => self.clone(),
            Sign::Negative => self.neg(),
            Sign::Unknown => {
                let sign = if bounds.lower.is_some() {
                    Sign::Positive
                } else {
                    Sign::Unknown
                };
                Germ::of(self.k, Bounds { sign, ..bounds })
            }
        })
    }

    /// A function that lies between f and g at every s, which are positive, and f the smaller one.
    pub fn between(&self, other: &Germ) -> Option<Germ> {
        let (a, b) = (self.bounds()?, other.bounds()?);
        let positive = a.sign == Sign::Positive && b.sign == Sign::Positive;
        let (sign, lower, upper) = (a.sign, a.lower, b.upper);
        let bounds = Bounds { sign, lower, upper };
        positive.then(|| Germ::of(self.k.max(other.k), bounds))
    }

    /// A function that equals f or g at every s, as a maximum or a choice by cases does.
    pub fn either(&self, other: &Germ) -> Option<Germ> {
        let (a, b) = (self.bounds()?, other.bounds()?);
        let sign = if a.sign == b.sign {
            a.sign
        } else {
            Sign::Unknown
        };
        let upper = a.upper.add(&b.upper)?;
        Some(Germ::of(
            self.k.max(other.k),
            Bounds {
                sign,
                lower: None,
                upper,
            },
        ))
    }

    /// `g(f)` for a function g that has Taylor coefficients at the values of f: `g(x, n)` encloses
    /// the first n of them at all points of x, or none where it is not analytic there. None as well
    /// where f is not a series in s.
    pub fn map(&self, g: impl Fn(&Ball, usize) -> Option<Vec<Ball>>) -> Option<Germ> {
        let Form::Series(series) = &self.form else {
            return None;
        };
        let series = series.regular(self.k)?;
        if series.c.is_empty() {
            let range = series.range(self.k);
            return Some(Germ::within(g(&range, 1)?.first()?, self.k));
        }
        Some(Germ::series(self.k, series.compose(self.k, g)?))
    }

    /// `e^f`.
    pub fn exp(&self) -> Option<Germ> {
        let series = self.map(|x, n| {
            let value = x.exp();
            value
                .is_finite()
                .then(|| over_factorials(n, |_| value.clone()))
        });
        if series.is_some() {
            return series;
        }
        Some(Germ::of(self.k, self.bounds()?.exp()?))
    }

    /// `ln f` for a positive f.
    pub fn ln(&self) -> Option<Germ> {
        let series = self.map(|x, n| {
            if !x.is_positive() {
                return None;
            }
            let mut all = vec![x.ln()];
            let mut power = whole(x.prec(), 1);
            for j in 1..n {
                power = &power / x;
                let sign = if j % 2 == 1 { 1 } else { -1 };
                all.push(&power / whole(x.prec(), sign * j as i64));
            }
            Some(all)
        });
        if series.is_some() {
            return series;
        }
        Some(Germ::of(self.k, self.bounds()?.ln()?))
    }

    /// `sin f`.
    pub fn sin(&self) -> Option<Germ> {
        self.circular(0)
    }

    /// `cos f`.
    pub fn cos(&self) -> Option<Germ> {
        self.circular(1)
    }

    /// The derivative of the sine of some order.
    fn circular(&self, order: usize) -> Option<Germ> {
        let series = self.map(|x, n| {
            let (sine, cosine) = x.sin_cos();
            let all = [sine.clone(), cosine.clone(), -sine, -cosine];
            Some(over_factorials(n, |j| all[(j + order) % 4].clone()))
        });
        if series.is_some() {
            return series;
        }
        let one = Growth::constant(self.k, Mag::from_f64(1.0));
        let mut upper = one.clone();
        // |sin f| ≤ |f|, which is of use where f tends to zero.
        if let (0, Some(bounds)) = (order, self.bounds())
            && bounds.upper.over(&one).is_some()
        {
            upper = bounds.upper;
        }
        Some(Germ::of(
            self.k,
            Bounds {
                sign: Sign::Unknown,
                lower: None,
                upper,
            },
        ))
    }

    /// `atan f`.
    pub fn atan(&self) -> Option<Germ> {
        let series = self.map(|x, n| {
            let bits = x.prec();
            // (1 + x² + 2xu + u²) y' = 1 for y = atan(x + u).
            let first = (whole(bits, 1) + x.square()).recip();
            let mut rates: Vec<Ball> = Vec::new();
            for i in 0..n {
                let next = match i {
                    0 => first.clone(),
                    1 => -(x * &rates[0]).shift(1) * &first,
                    _ => -((x * &rates[i - 1]).shift(1) + &rates[i - 2]) * &first,
                };
                rates.push(next);
            }
            let mut all = vec![x.atan2(&whole(bits, 1))];
            all.extend((1..n).map(|i| &rates[i - 1] / whole(bits, i as i64)));
            Some(all)
        });
        let half_turn = Ball::new(Float::with_val(64, 0), Mag::from_f64(1.5707963267948968));
        series.or_else(|| Some(Germ::within(&half_turn, self.k)))
    }
}

fn exact_product(a: f64, b: f64) -> bool {
    let product = a * b;
    product.is_finite() && a.mul_add(b, -product) == 0.0
}

fn over_factorials(n: usize, derivative: impl Fn(usize) -> Ball) -> Vec<Ball> {
    let mut factorial = 1i64;
    let coefficient = |j: usize| {
        factorial *= (j as i64).max(1);
        let value = derivative(j);
        &value / whole(value.prec(), factorial)
    };
    (0..n).map(coefficient).collect()
}

/// Taylor coefficients of `1/x`.
fn inverse_powers(x: &Ball, n: usize) -> Option<Vec<Ball>> {
    if x.contains_zero() {
        return None;
    }
    let mut power = x.recip();
    let mut all = Vec::new();
    for _ in 0..n {
        all.push(power.clone());
        power = -(&power / x);
    }
    Some(all)
}

/// Taylor coefficients of `x^a`.
fn powers(x: &Ball, a: &Ball, n: usize) -> Option<Vec<Ball>> {
    if !x.is_positive() {
        return None;
    }
    let bits = x.prec();
    let mut term = (x.ln() * a).exp();
    let mut all = Vec::new();
    for j in 0..n as i64 {
        all.push(term.clone());
        let factor = (a - &whole(bits, j)) / whole(bits, j + 1);
        term = &(&term * &factor) / x;
    }
    Some(all)
}

#[cfg(test)]
mod tests;
