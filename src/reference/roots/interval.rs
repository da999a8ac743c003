//! Certified roots of a function of one variable in an interval.
//!
//! The function and its derivative are given by enclosures over balls. An interval where the
//! enclosure of the function, or the mean-value form `f(m) + f'(X)(X − m)`, excludes zero has no
//! root. Where the derivative excludes zero the function is strictly monotone, so that the signs at
//! the ends decide between no root and exactly one, which the interval Newton method then encloses
//! (Moore, Kearfott and Cloud, *Introduction to Interval Analysis*, 2009, 8.1). Other intervals are
//! halved. Roots where the derivative vanishes too stay undecided, and the places are returned.
//!
//! ```
//! use mechaudit_reference::{Ball, roots};
//! use rug::Rational;
//! use std::convert::Infallible;
//! // x² − 2
//! let f = |x: &Ball, bits: u32| Ok::<_, Infallible>(x.square() - Ball::integer(bits, 2));
//! let df = |x: &Ball, _: u32| Ok(x.shift(1));
//! let root = roots::interval::unique_root(f, df, &Rational::from(0), &Rational::from(2), 100).unwrap();
//! assert!(root.accuracy_bits() >= 100 && root.contains_ball(&Ball::integer(300, 2).sqrt()));
//! ```

use crate::arithmetic::ball::{greater, lesser};
use crate::{Ball, Mag};
use rug::float::Round;
use rug::{Float, Rational};
use std::cmp::Ordering;
use std::collections::VecDeque;

/// Binary places of the length below which an interval is undecided, or of its share of the whole
/// where that is longer than 1.
const HALVINGS: u32 = 160;

/// Bits of precision that are tried first.
const FIRST: u32 = 64;

/// Bits up to which the sign at an end of the interval is sought.
const SIGN: u32 = 4096;

/// Pieces of an interval that [`unique_root`] looks at; a reasonable limit for [`all_roots`], too.
pub const PIECES: usize = 20_000;

/// Rounds of one refinement; Newton's method doubles the bits in a round once it converges.
const ROUNDS: u32 = 400;

/// An interval by its ends.
pub type Interval = (Rational, Rational);

/// The reason why roots have no certified answer.
#[derive(Clone, Debug, thiserror::Error)]
pub enum RootError<E> {
    /// The lower end lies above the upper one.
    #[error("the interval's lower end {lo} lies above its upper end {hi}")]
    Interval {
        /// The lower end.
        lo: Rational,
        /// The upper end.
        hi: Rational,
    },
    /// The function could not be evaluated.
    #[error("the function near {}: {error}", .at.mid().to_f64())]
    Function {
        /// The argument.
        at: Ball,
        /// The reason.
        error: E,
    },
    /// The interval is proved to hold no root.
    #[error("the interval holds no root")]
    None,
    /// The interval is proved to hold more than one root.
    #[error("the interval holds {} roots or more", .roots.len())]
    Several {
        /// Roots that are proved to be different.
        roots: Vec<Ball>,
    },
    /// Parts of the interval may hold further roots.
    #[error("undecided from {} to {}: {reason}", .open[0].0.to_f64(), .open[0].1.to_f64())]
    Undecided {
        /// The roots that are proved.
        roots: Vec<Ball>,
        /// The parts that may hold others, in ascending order; there is at least one.
        open: Vec<Interval>,
        /// The reason.
        reason: &'static str,
    },
}

#[derive(Clone, Copy, PartialEq)]
enum Sign {
    Negative,
    Zero,
    Positive,
    Unknown,
}

/// The point with the sign of the function there.
#[derive(Clone)]
struct End {
    x: Rational,
    sign: Sign,
}

struct Piece {
    low: End,
    high: End,
    depth: u32,
}

struct Function<F, D> {
    f: F,
    df: D,
}

impl<E, F, D> Function<F, D>
where
    F: FnMut(&Ball, u32) -> Result<Ball, E>,
    D: FnMut(&Ball, u32) -> Result<Ball, E>,
{
    fn value(&mut self, x: &Ball, bits: u32) -> Result<Ball, RootError<E>> {
        (self.f)(x, bits).map_err(|error| RootError::Function {
            at: x.clone(),
            error,
        })
    }

    fn slope(&mut self, x: &Ball, bits: u32) -> Result<Ball, RootError<E>> {
        (self.df)(x, bits).map_err(|error| RootError::Function {
            at: x.clone(),
            error,
        })
    }

    /// The sign at a point, with up to `last` bits.
    fn end(&mut self, x: Rational, first: u32, last: u32) -> Result<End, RootError<E>> {
        let mut bits = first;
        let mut sign = Sign::Unknown;
        while bits <= last && sign == Sign::Unknown {
            let value = self.value(&Ball::rational(bits, &x), bits)?;
            sign = sign_of(&value);
            bits *= 2;
        }
        Ok(End { x, sign })
    }

    /// A point near the middle where the function has a sign.
    fn split(&mut self, piece: &Piece, bits: u32) -> Result<Option<End>, RootError<E>> {
        let width = Rational::from(&piece.high.x - &piece.low.x);
        for sixteenths in [8, 7, 9, 5] {
            let x = &width * Rational::from((sixteenths, 16)) + &piece.low.x;
            let end = self.end(x, bits, 2 * bits)?;
            if matches!(end.sign, Sign::Negative | Sign::Positive) {
                return Ok(Some(end));
            }
        }
        Ok(None)
    }

    /// Looks at an interval.
    fn judge(&mut self, piece: &Piece, bits: u32) -> Result<Verdict, RootError<E>> {
        let x = over(bits, &piece.low.x, &piece.high.x);
        let value = self.value(&x, bits)?;
        if value.is_finite() && !value.contains_zero() {
            return Ok(Verdict::None);
        }
        let slope = self.slope(&x, bits)?;
        if !slope.is_finite() {
            return Ok(Verdict::Open);
        }
        let middle = Ball::new(x.mid().clone(), Mag::ZERO);
        let value = self.value(&middle, bits)? + &slope * (&x - &middle);
        if value.is_finite() && !value.contains_zero() {
            return Ok(Verdict::None);
        }
        let is_monotone = slope.is_positive() || slope.is_negative();
        let (low, high) = (piece.low.sign, piece.high.sign);
        Ok(match is_monotone {
            true => by_signs(low, high, slope.is_positive()),
            false => Verdict::Open,
        })
    }

    /// Encloses the root of an interval with one root, over which the function is monotone.
    fn refine(
        &mut self,
        piece: &Piece,
        reach: Mag,
        first: u32,
        goal: u32,
    ) -> Result<Option<Ball>, RootError<E>> {
        let mut bits = first;
        let most = 8 * goal + SIGN;
        let x = over(bits, &piece.low.x, &piece.high.x);
        let (mut lo, mut hi) = (x.lower(), x.upper());
        if x.contains_zero() && self.end(Rational::new(), bits, bits)?.sign == Sign::Zero {
            return Ok(Some(Ball::integer(goal, 0)));
        }
        for _ in 0..ROUNDS {
            let x = Ball::between(bits, &lo, &hi);
            // Two bits more, which `Ball::accuracy_bits` may round off.
            let shift = -i64::from(goal) - 2;
            if x.rad() <= x.mignitude().max(reach.shift(shift)).shift(shift) {
                return Ok(Some(x.with_prec(bits.min(goal + 32))));
            }
            let slope = self.slope(&x, bits)?;
            let middle = Ball::new(x.mid().clone(), Mag::ZERO);
            let value = self.value(&middle, bits)?;
            if value.is_zero() {
                return Ok(Some(middle));
            }
            let width = Float::with_val(64, &hi - &lo);
            if slope.is_finite() && !slope.contains_zero() {
                let newton = &middle - &value / &slope;
                lo = greater(lo, newton.lower());
                hi = lesser(hi, newton.upper());
                // The middle is left or right of the root by the sign of the function there.
                match (sign_of(&value), slope.is_positive()) {
                    (Sign::Negative, true) | (Sign::Positive, false) => {
                        lo = greater(lo, middle.mid().clone());
                    }
                    (Sign::Positive, true) | (Sign::Negative, false) => {
                        hi = lesser(hi, middle.mid().clone());
                    }
                    _ => {}
                }
            }
            // Where the slope varies the interval is halved at least, at any precision.
            let varies = !slope.contains_zero() && slope.rad() > slope.mignitude().shift(-2);
            let shrinks = Float::with_val(64, &hi - &lo) * if varies { 1u32 } else { 4 } < width;
            if !shrinks || value.contains_zero() {
                bits *= 2;
                if bits > most {
                    break;
                }
            }
        }
        Ok(None)
    }
}

enum Verdict {
    None,
    One,
    /// The root is the lower end, or the upper one.
    Low,
    High,
    Open,
}

/// The roots of a monotone function by its signs at the ends.
fn by_signs(low: Sign, high: Sign, is_rising: bool) -> Verdict {
    use Sign::{Negative, Positive, Unknown, Zero};
    // As if the function were rising.
    let turned = |sign| match (sign, is_rising) {
        (Negative, false) => Positive,
        (Positive, false) => Negative,
        (sign, _) => sign,
    };
    match (turned(low), turned(high)) {
        (Zero, _) => Verdict::Low,
        (_, Zero) => Verdict::High,
        (Positive, _) | (_, Negative) => Verdict::None,
        (Negative, Positive) => Verdict::One,
        (Unknown, _) | (_, Unknown) => Verdict::Open,
    }
}

fn sign_of(value: &Ball) -> Sign {
    match value {
        v if v.is_zero() => Sign::Zero,
        v if v.is_positive() => Sign::Positive,
        v if v.is_negative() => Sign::Negative,
        _ => Sign::Unknown,
    }
}

/// A ball that holds the interval.
fn over(bits: u32, lo: &Rational, hi: &Rational) -> Ball {
    let round = |x: &Rational, round| Float::with_val_round(bits, x, round).0;
    Ball::between(bits, &round(lo, Round::Down), &round(hi, Round::Up))
}

/// Joins open intervals that touch.
fn joined(mut open: Vec<Interval>) -> Vec<Interval> {
    open.sort();
    let mut all: Vec<Interval> = Vec::new();
    for (lo, hi) in open {
        match all.last_mut() {
            Some(last) if last.1 >= lo => {
                if hi > last.1 {
                    last.1 = hi;
                }
            }
            _ => all.push((lo, hi)),
        }
    }
    all
}

/// The roots that are known in an interval.
struct Found {
    roots: Vec<Ball>,
    open: Vec<Interval>,
    reason: &'static str,
}

/// Searches the interval, with a piece for each of `limit`; stops at `enough` roots.
fn search<E, F, D>(
    f: F,
    df: D,
    lo: &Rational,
    hi: &Rational,
    goal: u32,
    [limit, enough]: [usize; 2],
) -> Result<Found, RootError<E>>
where
    F: FnMut(&Ball, u32) -> Result<Ball, E>,
    D: FnMut(&Ball, u32) -> Result<Ball, E>,
{
    if lo > hi {
        let (lo, hi) = (lo.clone(), hi.clone());
        return Err(RootError::Interval { lo, hi });
    }
    let mut function = Function { f, df };
    let [low, high] = [lo, hi].map(|x| function.end(x.clone(), FIRST, SIGN));
    let (low, high) = (low?, high?);
    let mut found = Found {
        roots: Vec::new(),
        open: Vec::new(),
        reason: "the function or its derivative may vanish; a multiple root, or nearly one",
    };
    if lo == hi {
        match low.sign {
            Sign::Zero => found.roots.push(Ball::rational(goal + 2, lo)),
            Sign::Unknown => found.open.push((lo.clone(), hi.clone())),
            _ => {}
        }
        return Ok(found);
    }
    let width = Float::with_val(64, Rational::from(hi - lo)).get_exp();
    let deepest = HALVINGS + width.map_or(0, |e| e.max(0).unsigned_abs());
    let reach = over(FIRST, lo, hi).magnitude();
    let mut pieces = VecDeque::from([Piece {
        low,
        high,
        depth: 0,
    }]);
    let mut looked = 0;
    while let Some(piece) = pieces.pop_front() {
        let ends = (piece.low.x.clone(), piece.high.x.clone());
        looked += 1;
        if looked > limit {
            found.reason = "the number of pieces that may be looked at is used up";
            found.open.push(ends);
            continue;
        }
        let bits = FIRST + 2 * piece.depth;
        match function.judge(&piece, bits)? {
            Verdict::None => {}
            Verdict::Low => found.roots.push(Ball::rational(goal + 2, &ends.0)),
            Verdict::High => found.roots.push(Ball::rational(goal + 2, &ends.1)),
            Verdict::One => match function.refine(&piece, reach, bits, goal)? {
                Some(root) => found.roots.push(root),
                None => {
                    found.reason = "a simple root is known to fewer bits than were asked for";
                    found.open.push(ends);
                }
            },
            Verdict::Open if piece.depth >= deepest => found.open.push(ends),
            Verdict::Open => match function.split(&piece, bits)? {
                None => found.open.push(ends),
                Some(middle) => {
                    let depth = piece.depth + 1;
                    let (low, high) = (piece.low, piece.high);
                    pieces.push_back(Piece {
                        low,
                        high: middle.clone(),
                        depth,
                    });
                    pieces.push_back(Piece {
                        low: middle,
                        high,
                        depth,
                    });
                }
            },
        }
        if found.roots.len() >= enough {
            break;
        }
    }
    found
        .roots
        .sort_by(|a, b| a.mid().partial_cmp(b.mid()).unwrap_or(Ordering::Equal));
    found.open = joined(found.open);
    Ok(found)
}

/// Returns all roots of f in `[lo, hi]`, in ascending order, each to `2^-goal` of its size, or of
/// `2^-goal` of the end that is farther from zero where it is smaller than that. That there are no
/// others is proved, and that they are simple. At most `limit` pieces of the interval are looked
/// at. An end is a root where f is exactly zero there.
///
/// f and df enclose the function and its derivative over a ball, at a number of bits; a ball
/// without a bound says that nothing is known over so wide an argument.
///
/// # Errors
/// [`RootError`]: ends in the wrong order, a function that fails, or undecided parts.
pub fn all_roots<E, F, D>(
    f: F,
    df: D,
    lo: &Rational,
    hi: &Rational,
    goal: u32,
    limit: usize,
) -> Result<Vec<Ball>, RootError<E>>
where
    F: FnMut(&Ball, u32) -> Result<Ball, E>,
    D: FnMut(&Ball, u32) -> Result<Ball, E>,
{
    let found = search(f, df, lo, hi, goal, [limit, usize::MAX])?;
    if found.open.is_empty() {
        return Ok(found.roots);
    }
    let Found {
        roots,
        open,
        reason,
    } = found;
    Err(RootError::Undecided {
        roots,
        open,
        reason,
    })
}

/// Returns the root of f in `[lo, hi]`, proved to be the only one, and simple. The accuracy is as
/// in [`all_roots`]. An end is a root where f is exactly zero there.
///
/// # Errors
/// [`RootError`]: as [`all_roots`], and where no root or more than one is proved.
pub fn unique_root<E, F, D>(
    f: F,
    df: D,
    lo: &Rational,
    hi: &Rational,
    goal: u32,
) -> Result<Ball, RootError<E>>
where
    F: FnMut(&Ball, u32) -> Result<Ball, E>,
    D: FnMut(&Ball, u32) -> Result<Ball, E>,
{
    let Found {
        mut roots,
        open,
        reason,
    } = search(f, df, lo, hi, goal, [PIECES, 2])?;
    match (roots.len(), open.is_empty()) {
        (2.., _) => Err(RootError::Several { roots }),
        (_, false) => Err(RootError::Undecided {
            roots,
            open,
            reason,
        }),
        (0, true) => Err(RootError::None),
        (1, true) => Ok(roots.remove(0)),
    }
}

#[cfg(test)]
mod tests;
