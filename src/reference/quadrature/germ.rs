//! A function next to an end of an interval: a truncated series, or bounds.

use super::End;
use super::growth::{Growth, Side};
use crate::{Ball, Mag};
use Side::{Lower, Upper};
use rug::Float;
use rug::float::Round;

/// Terms of a series.
const TERMS: usize = 8;

/// A function of the distance s from an end, for all `0 < s ≤ 2^−k`.
///
/// A formula is evaluated in this arithmetic from [`Germ::variable`] on; [`Germ::growth`] then bounds the integrand. Every
/// operation is proved for all s at once, or answers none: the function may be undefined somewhere, or a
/// smaller distance may be needed. Points of a power of s with series (`1 − x²` next to 1, `√(sin x)` next to
/// 0) keep their zeros and poles; logarithms and exponentials of what is unbounded are known by bounds alone.
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

/// `s^p (c_0 + … + c_(n−1) s^(n−1) + R(s) s^n)` with R(s) in `rest` for all s.
#[derive(Clone, Debug)]
struct Series {
    p: f64,
    c: Vec<Ball>,
    rest: Ball,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    Positive,
    Negative,
    Unknown,
}

/// `lower ≤ |f| ≤ upper`, and the sign of f.
#[derive(Clone, Debug)]
struct Bounds {
    sign: Sign,
    lower: Option<Growth>,
    upper: Growth,
}

fn whole(bits: u32, n: i64) -> Ball {
    Ball::integer(bits, n)
}

/// All of `[0, 2^−k]^n`.
fn step(bits: u32, k: u32, n: usize) -> Ball {
    let half = i64::from(k) * n as i64 + 1;
    Ball::new(
        Float::with_val(bits, 1) >> half as u32,
        Mag::power_of_two(-half),
    )
}

fn sum_is_exact(a: f64, b: f64) -> Option<f64> {
    let sum = a + b;
    let back = sum - a;
    ((a - (sum - back)) + (b - back) == 0.0 && sum.is_finite()).then_some(sum)
}

impl Series {
    fn of(p: f64, c: Vec<Ball>) -> Series {
        let bits = c.first().map_or(64, Ball::prec);
        Series {
            p,
            c,
            rest: whole(bits, 0),
        }
    }

    fn bits(&self) -> u32 {
        self.rest.prec()
    }

    /// At most so many terms; the others go into the rest.
    fn cut(mut self, k: u32, terms: usize) -> Series {
        while self.c.len() > terms {
            let last = self.c.pop().expect("a term");
            self.rest = &last + &self.rest * step(self.bits(), k, 1);
        }
        self
    }

    /// Without the leading terms that are exactly zero; none for the function zero.
    fn stripped(mut self) -> Option<Series> {
        let zeros = self.c.iter().take_while(|c| c.is_zero()).count();
        if zeros == self.c.len() && self.rest.is_zero() {
            return None;
        }
        self.c.drain(..zeros);
        self.p = sum_is_exact(self.p, zeros as f64)?;
        if self.c.is_empty() {
            return Some(self);
        }
        Some(self.filled())
    }

    /// With zeros behind an exact end.
    fn filled(mut self) -> Series {
        if self.rest.is_zero() {
            let bits = self.bits();
            while self.c.len() < TERMS {
                self.c.push(whole(bits, 0));
            }
        }
        self
    }

    /// All values of the part without the power.
    fn range(&self, k: u32) -> Ball {
        let s = step(self.bits(), k, 1);
        self.c
            .iter()
            .rev()
            .fold(self.rest.clone(), |sum, c| c + &sum * &s)
    }

    /// Times `s^n`, without a change of p.
    fn shifted(&self, n: usize) -> Series {
        let mut c = vec![whole(self.bits(), 0); n];
        c.extend(self.c.iter().cloned());
        Series { c, ..self.clone() }
    }

    fn add(&self, other: &Series, k: u32) -> Option<Series> {
        if other.p < self.p {
            return other.add(self, k);
        }
        let gap = sum_is_exact(other.p, -self.p)?;
        if gap.fract() != 0.0 || gap > 1000.0 {
            return None;
        }
        let (a, b) = (self.clone().filled(), other.shifted(gap as usize).filled());
        let terms = a.c.len().min(b.c.len());
        let (a, b) = (a.cut(k, terms), b.cut(k, terms));
        let c = a.c.iter().zip(&b.c).map(|(x, y)| x + y).collect();
        Some(Series {
            p: self.p,
            c,
            rest: a.rest + b.rest,
        })
    }

    fn mul(&self, other: &Series, k: u32) -> Option<Series> {
        let p = sum_is_exact(self.p, other.p)?;
        let (a, b) = (self.clone().filled(), other.clone().filled());
        let terms = a.c.len().min(b.c.len());
        let (a, b) = (a.cut(k, terms), b.cut(k, terms));
        let bits = a.bits().max(b.bits());
        let mut c = vec![whole(bits, 0); 2 * terms];
        for (i, x) in a.c.iter().enumerate() {
            for (j, y) in b.c.iter().enumerate() {
                c[i + j] = &c[i + j] + &(x * y);
            }
        }
        // The rests times all of the other.
        let range = Series {
            rest: whole(bits, 0),
            ..a.clone()
        }
        .range(k);
        let rest = &b.rest * range + &a.rest * b.range(k);
        let beyond = c.split_off(terms);
        let s = step(bits, k, 1);
        let beyond = beyond
            .iter()
            .rev()
            .fold(whole(bits, 0), |sum, c| c + &sum * &s);
        Some(Series {
            p,
            c,
            rest: rest + beyond,
        })
    }

    /// The composition `g(f)` for p = 0, by the Taylor coefficients of g: those at `c_0`, and the one of the rest
    /// everywhere, times a power of `(f − c_0)/s`.
    fn compose(&self, k: u32, g: impl Fn(&Ball, usize) -> Option<Vec<Ball>>) -> Option<Series> {
        debug_assert!(self.p == 0.0 && !self.c.is_empty());
        let this = self.clone().filled();
        let n = this.c.len();
        let bits = this.bits();
        let at = g(&this.c[0], n)?;
        let along = g(&this.range(k), n + 1)?;
        let mut h = this.clone();
        h.c[0] = whole(bits, 0);
        let slope = Series {
            c: h.c[1..].to_vec(),
            ..h.clone()
        }
        .range(k);
        let mut sum = Series {
            p: 0.0,
            c: vec![whole(bits, 0); n],
            rest: whole(bits, 0),
        };
        for coefficient in at.iter().rev() {
            sum = sum.mul(&h, k)?;
            sum.c[0] = &sum.c[0] + coefficient;
        }
        let power = (0..n).fold(whole(bits, 1), |power, _| &power * &slope);
        sum.rest = &sum.rest + &along[n] * power;
        let finite = sum.c.iter().all(Ball::is_finite) && sum.rest.is_finite();
        finite.then_some(sum)
    }

    fn bounds(&self, k: u32) -> Option<Bounds> {
        let Some(stripped) = self.clone().stripped() else {
            let upper = Growth::constant(k, Mag::ZERO);
            return Some(Bounds {
                sign: Sign::Unknown,
                lower: None,
                upper,
            });
        };
        // Where nothing but a rest is left, the power is known nevertheless.
        let range = stripped.range(k);
        if !range.is_finite() {
            return None;
        }
        let bound = |c: Mag| Growth::power(k, c, stripped.p);
        Some(Bounds {
            sign: match () {
                () if range.is_positive() => Sign::Positive,
                () if range.is_negative() => Sign::Negative,
                () => Sign::Unknown,
            },
            lower: (!range.contains_zero()).then(|| bound(range.mignitude())),
            upper: bound(range.magnitude()),
        })
    }

    /// The same with p = 0, if p is a whole number that is not negative.
    fn regular(&self, k: u32) -> Option<Series> {
        if !(self.p >= 0.0 && self.p.fract() == 0.0 && self.p <= 1000.0) {
            return None;
        }
        let whole = Series {
            p: 0.0,
            ..self.shifted(self.p as usize)
        };
        Some(whole.cut(k, TERMS))
    }
}

impl Sign {
    fn times(self, other: Sign) -> Sign {
        match (self, other) {
            (Sign::Unknown, _) | (_, Sign::Unknown) => Sign::Unknown,
            (a, b) if a == b => Sign::Positive,
            _ => Sign::Negative,
        }
    }
}

impl Bounds {
    fn add(&self, other: &Bounds) -> Option<Bounds> {
        let upper = self.upper.add(&other.upper)?;
        let one = Mag::from_f64(1.0);
        if self.sign == other.sign && self.sign != Sign::Unknown {
            // Either bound is one; the larger in the end is taken.
            let lower = match (&self.lower, &other.lower) {
                (Some(a), Some(b)) if b.over(a).is_some() => Some(a.clone()),
                (Some(_), Some(b)) => Some(b.clone()),
                (a, b) => a.clone().or(b.clone()),
            };
            return Some(Bounds {
                sign: self.sign,
                lower,
                upper,
            });
        }
        // One of the two outweighs the other.
        for (large, small) in [(self, other), (other, self)] {
            let Some(lower) = &large.lower else { continue };
            let Some(ratio) = small.upper.over(lower) else {
                continue;
            };
            let left = one.sub_below(ratio);
            if !left.is_zero() {
                let lower = Some(lower.scaled(left, Lower));
                return Some(Bounds {
                    sign: large.sign,
                    lower,
                    upper,
                });
            }
        }
        Some(Bounds {
            sign: Sign::Unknown,
            lower: None,
            upper,
        })
    }

    fn mul(&self, other: &Bounds) -> Bounds {
        let lower = match (&self.lower, &other.lower) {
            (Some(a), Some(b)) => Some(a.mul(b, Lower)),
            _ => None,
        };
        let upper = self.upper.mul(&other.upper, Upper);
        Bounds {
            sign: self.sign.times(other.sign),
            lower,
            upper,
        }
    }

    fn recip(&self) -> Option<Bounds> {
        let upper = self.lower.as_ref()?.inverse(Upper)?;
        Some(Bounds {
            sign: self.sign,
            lower: self.upper.inverse(Lower),
            upper,
        })
    }

    /// `|f|^a`, a > 0.
    fn raised(&self, a: [f64; 2], sign: Sign) -> Option<Bounds> {
        let lower = self.lower.as_ref().and_then(|lower| lower.raised(a, Lower));
        Some(Bounds {
            sign,
            lower,
            upper: self.upper.raised(a, Upper)?,
        })
    }

    fn exp(&self) -> Option<Bounds> {
        let (least, most) = (self.lower.as_ref(), &self.upper);
        let one = || Growth::constant(most.reach(), Mag::from_f64(1.0));
        let (lower, upper) = match self.sign {
            Sign::Positive => (
                least.map_or_else(one, |g| grown(g, Lower).unwrap_or_else(one)),
                grown(most, Upper)?,
            ),
            Sign::Negative => (
                fallen(most, Lower).unwrap_or_else(|| Growth::constant(most.reach(), Mag::ZERO)),
                least.map_or_else(one, |g| fallen(g, Upper).unwrap_or_else(one)),
            ),
            Sign::Unknown => (
                fallen(most, Lower).unwrap_or_else(|| Growth::constant(most.reach(), Mag::ZERO)),
                grown(most, Upper)?,
            ),
        };
        let lower = (!lower.factor().is_zero()).then_some(lower);
        Some(Bounds {
            sign: Sign::Positive,
            lower,
            upper,
        })
    }

    /// The logarithm lies between those of the bounds.
    fn ln(&self) -> Option<Bounds> {
        if self.sign != Sign::Positive {
            return None;
        }
        let (low, high) = (logarithm(self.lower.as_ref()?)?, logarithm(&self.upper)?);
        Some(match (low.sign, high.sign) {
            (Sign::Positive, _) => Bounds {
                upper: high.upper,
                ..low
            },
            (_, Sign::Negative) => Bounds {
                upper: low.upper,
                ..high
            },
            _ => Bounds {
                sign: Sign::Unknown,
                lower: None,
                upper: low.upper.add(&high.upper)?,
            },
        })
    }
}

fn double(c: Mag, side: Side) -> f64 {
    let c = c.to_float();
    c.to_f64_round(if side == Upper {
        Round::Up
    } else {
        Round::Down
    })
}

/// A bound on `e^g` for a bound g on the same side, g > 0.
fn grown(g: &Growth, side: Side) -> Option<Growth> {
    let k = g.reach();
    let [p, q, sigma] = g.exponents();
    let c = double(g.factor(), side);
    // L ≥ 1: its power is a bound on the one side or on the other.
    let harmless = if side == Upper { q <= 0.0 } else { q >= 0.0 };
    if sigma == 0.0 && p < 0.0 && harmless {
        return Some(Growth::exponential(k, -c, -p));
    }
    if sigma == 0.0 && p == 0.0 && q == 1.0 {
        return Some(Growth::power(k, Mag::from_f64(1.0), -c));
    }
    let constant = match side {
        Upper => g.greatest()?,
        // The least value is not known but for a constant.
        Lower if [p, q, sigma] == [0.0; 3] => g.factor(),
        Lower => return None,
    };
    exponential_constant(k, constant.to_float(), side)
}

/// A bound on `e^−g` on the side opposite to that of the bound g, g > 0.
fn fallen(g: &Growth, side: Side) -> Option<Growth> {
    let k = g.reach();
    let [p, q, sigma] = g.exponents();
    let c = double(g.factor(), if side == Upper { Lower } else { Upper });
    let harmless = if side == Upper { q >= 0.0 } else { q <= 0.0 };
    if sigma == 0.0 && p < 0.0 && harmless {
        return Some(Growth::exponential(k, c, -p));
    }
    if sigma == 0.0 && p == 0.0 && q == 1.0 {
        return Some(Growth::power(k, Mag::from_f64(1.0), c));
    }
    // g ≥ c e^(|σ| s^−r) ≥ c |σ| s^−r.
    if side == Upper && sigma < 0.0 && p <= 0.0 && q >= 0.0 {
        let rate = double(g.factor().mul_below(Mag::from_f64(sigma)), Lower);
        return Some(Growth::exponential(k, rate, g.order()));
    }
    let constant = match side {
        Lower => g.greatest()?,
        Upper if [p, q, sigma] == [0.0; 3] => g.factor(),
        Upper => return None,
    };
    exponential_constant(k, -constant.to_float(), side)
}

fn exponential_constant(k: u32, x: Float, side: Side) -> Option<Growth> {
    let value = Ball::new(x, Mag::ZERO).with_prec(64).exp();
    let c = if side == Upper {
        value.magnitude()
    } else {
        value.mignitude()
    };
    c.is_finite().then(|| Growth::constant(k, c))
}

/// `ln(C s^p L^q e^(−σ s^−r)) = ln C − p L + q ln L − σ s^−r`.
fn logarithm(g: &Growth) -> Option<Bounds> {
    let k = g.reach();
    let [p, q, sigma] = g.exponents();
    // A double times such a function is both of its bounds.
    let exact = |factor: f64, g: Growth| {
        let sign = if factor < 0.0 {
            Sign::Negative
        } else {
            Sign::Positive
        };
        Bounds {
            sign,
            lower: Some(g.clone()),
            upper: g,
        }
    };
    let constant = Ball::new(g.factor().to_float(), Mag::ZERO)
        .with_prec(128)
        .ln();
    if !constant.is_finite() {
        return None;
    }
    let mut terms = vec![Series::of(0.0, vec![constant]).bounds(k)];
    if p != 0.0 {
        terms.push(Some(exact(-p, Growth::logarithm(k, Mag::from_f64(p), 1.0))));
    }
    if q != 0.0 {
        // ln 1.38 > 0.3; ln L ≤ 4 L^(1/4)/e.
        let size = Mag::from_f64(q);
        let lower = Growth::constant(k, Mag::from_f64(0.3)).scaled(size, Lower);
        let upper = Growth::logarithm(k, Mag::from_f64(1.472).mul(size), 0.25);
        let sign = if q < 0.0 {
            Sign::Negative
        } else {
            Sign::Positive
        };
        terms.push(Some(Bounds {
            sign,
            lower: Some(lower),
            upper,
        }));
    }
    if sigma != 0.0 {
        let size = Mag::from_f64(sigma);
        terms.push(Some(exact(-sigma, Growth::power(k, size, -g.order()))));
    }
    let mut terms = terms.into_iter();
    let first = terms.next()??;
    terms.try_fold(first, |sum, term| sum.add(&term?))
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

    /// Whether the function is certainly positive for all s.
    pub fn is_positive(&self) -> bool {
        self.bounds().is_some_and(|b| b.sign == Sign::Positive)
    }

    /// Whether the function is certainly negative for all s.
    pub fn is_negative(&self) -> bool {
        self.bounds().is_some_and(|b| b.sign == Sign::Negative)
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

    /// A power of a series by a function `g(x) = x^a`, if the series without its power of s is off zero.
    fn series_power(&self, a: f64, g: &dyn Fn(&Ball, usize) -> Option<Vec<Ball>>) -> Option<Germ> {
        let Form::Series(series) = &self.form else {
            return None;
        };
        let stripped = series.clone().stripped()?;
        let p = stripped.p * a;
        if stripped.c.is_empty() || !exact_product(stripped.p, a) {
            return None;
        }
        let unit = Series { p: 0.0, ..stripped };
        let power = unit.compose(self.k, g)?;
        Some(Germ::series(self.k, Series { p, ..power }))
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

    /// `g(f)` for a function g that has Taylor coefficients at the values of f: `g(x, n)` encloses the first n of them at all
    /// points of x, or none where it is not analytic there. None as well where f is not a series in s.
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
#[path = "germ_tests.rs"]
mod tests;
