//! Functions that are known by a lower and an upper bound of their absolute values.

use super::growth::{Growth, Side};
use super::series::Series;
use crate::{Ball, Mag};
use Side::{Lower, Upper};
use rug::Float;
use rug::float::Round;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sign {
    Positive,
    Negative,
    Unknown,
}

/// `lower ≤ |f| ≤ upper`, and the sign of f.
#[derive(Clone, Debug)]
pub(super) struct Bounds {
    pub(super) sign: Sign,
    pub(super) lower: Option<Growth>,
    pub(super) upper: Growth,
}

impl Sign {
    pub(super) fn times(self, other: Sign) -> Sign {
        match (self, other) {
            (Sign::Unknown, _) | (_, Sign::Unknown) => Sign::Unknown,
            (a, b) if a == b => Sign::Positive,
            _ => Sign::Negative,
        }
    }
}

impl Bounds {
    pub(super) fn add(&self, other: &Bounds) -> Option<Bounds> {
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

    pub(super) fn mul(&self, other: &Bounds) -> Bounds {
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

    pub(super) fn recip(&self) -> Option<Bounds> {
        let upper = self.lower.as_ref()?.inverse(Upper)?;
        Some(Bounds {
            sign: self.sign,
            lower: self.upper.inverse(Lower),
            upper,
        })
    }

    /// `|f|^a`, a > 0.
    pub(super) fn raised(&self, a: [f64; 2], sign: Sign) -> Option<Bounds> {
        let lower = self.lower.as_ref().and_then(|lower| lower.raised(a, Lower));
        Some(Bounds {
            sign,
            lower,
            upper: self.upper.raised(a, Upper)?,
        })
    }

    pub(super) fn exp(&self) -> Option<Bounds> {
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
    pub(super) fn ln(&self) -> Option<Bounds> {
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
