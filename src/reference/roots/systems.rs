//! Certified solutions of systems of n equations in n unknowns.
//!
//! For numbers z, a matrix Y and a box X around z let `K = z − Y F(z) + (I − Y F'(X)) (X − z)`. All
//! zeros of F in X lie in K, for any Y. If K lies in the interior of X, there is exactly one
//! (Krawczyk, *Computing* 4 (1969) 187–201; Neumaier, *Interval Methods for Systems of Equations*,
//! 1990, Thm 5.1.8). Y is an approximate inverse taken as exact; a bad one can only make the test
//! fail.

use crate::arithmetic::ball::{greater, lesser};
use crate::linear::matrix::{LinearError, Matrix};
use crate::linear::verified::approximate_inverse;
use crate::{Ball, Mag, Undecided, dot};
use rug::Float;
use std::collections::VecDeque;

/// Equations `F(x) = 0` by enclosures over balls.
pub trait System {
    /// The reason why the equations cannot be evaluated.
    type Error;
    /// Encloses the values over a box. A ball without a bound says that nothing is known.
    ///
    /// # Errors
    /// Ends the search.
    fn values(&mut self, x: &[Ball], bits: u32) -> Result<Vec<Ball>, Self::Error>;
    /// Encloses the derivatives over a box by rows: those of one equation by all unknowns.
    ///
    /// # Errors
    /// Ends the search.
    fn jacobian(&mut self, x: &[Ball], bits: u32) -> Result<Vec<Ball>, Self::Error>;
}

/// The reason why a system has no certified solution.
#[derive(Clone, Debug, thiserror::Error)]
pub enum SystemError<E> {
    /// A list has another length than the number of unknowns asks for, or a start is no number.
    #[error(transparent)]
    Data(#[from] LinearError),
    /// The lower end of a side does not lie below the upper one.
    #[error("side {row} of the box: {lo} does not lie below {hi}")]
    Side {
        /// The side, counted from 0.
        row: usize,
        /// The lower end.
        lo: f64,
        /// The upper end.
        hi: f64,
    },
    /// The equations could not be evaluated.
    #[error("the equations: {0}")]
    Function(E),
    /// The box is proved to hold no solution.
    #[error("the box holds no solution")]
    None,
    /// The box is proved to hold more than one solution.
    #[error("the box holds {} solutions or more", .solutions.len())]
    Several {
        /// Enclosures of different solutions.
        solutions: Vec<Vec<Ball>>,
    },
    /// No proof was found; solutions may lie in the boxes returned.
    #[error("{reason}")]
    Undecided {
        /// The precision reached, and what stayed open.
        reason: Undecided,
        /// Boxes that may hold solutions, by the ends of their sides.
        open: Vec<Vec<[f64; 2]>>,
    },
}

/// Bits of precision beyond the accuracy asked for that are tried first, and the number of times
/// that the precision is doubled.
const SPARE: u32 = 64;
const DOUBLINGS: u32 = 4;

/// Bits of precision of boxes that are not small.
const COARSE: u32 = 96;

/// Newton steps; they converge quadratically from a start that is near.
const STEPS: u32 = 60;

/// Boxes that are tried around an approximate solution, each four times as wide as the last.
const INFLATIONS: u32 = 12;

/// The system and what is known at one place: an approximate inverse of the Jacobian.
struct At<'a, S> {
    system: &'a mut S,
    n: usize,
}

/// Krawczyk's operator over a box: the centre, the radii of the box and the image.
struct Image {
    image: Vec<Ball>,
    is_inside: bool,
}

fn exact(z: &[Float]) -> Vec<Ball> {
    z.iter().map(|x| Ball::new(x.clone(), Mag::ZERO)).collect()
}

fn midpoints(x: &[Ball], bits: u32) -> Vec<Float> {
    x.iter().map(|x| Float::with_val(bits, x.mid())).collect()
}

impl<S: System> At<'_, S> {
    fn values(&mut self, x: &[Ball], bits: u32) -> Result<Vec<Ball>, SystemError<S::Error>> {
        let values = self.system.values(x, bits).map_err(SystemError::Function)?;
        check("values of the equations", values.len(), self.n)?;
        Ok(values)
    }

    fn jacobian(&mut self, x: &[Ball], bits: u32) -> Result<Matrix<Ball>, SystemError<S::Error>> {
        let entries = self
            .system
            .jacobian(x, bits)
            .map_err(SystemError::Function)?;
        Ok(Matrix::new(self.n, self.n, entries)?)
    }

    /// An approximate inverse of the Jacobian at a point.
    fn inverse(
        &mut self,
        z: &[Float],
        bits: u32,
    ) -> Result<Option<Matrix<Ball>>, SystemError<S::Error>> {
        let jacobian = self.jacobian(&exact(z), bits)?;
        if jacobian.entries().iter().any(|x| !x.is_finite()) {
            return Ok(None);
        }
        let inverse = approximate_inverse(&jacobian, bits);
        Ok(inverse.map(|y| y.map(|x| Ball::new(x.clone(), Mag::ZERO))))
    }

    /// `Y F(z)`.
    fn step(
        &mut self,
        y: &Matrix<Ball>,
        z: &[Float],
        bits: u32,
    ) -> Result<Vec<Ball>, SystemError<S::Error>> {
        let values = self.values(&exact(z), bits)?;
        Ok((0..self.n)
            .map(|i| dot(bits, y.row(i).iter().zip(&values)))
            .collect())
    }

    /// Krawczyk's operator over the box of half-widths r around z.
    fn krawczyk(
        &mut self,
        y: &Matrix<Ball>,
        z: &[Float],
        r: &[Mag],
        bits: u32,
    ) -> Result<Image, SystemError<S::Error>> {
        let n = self.n;
        let step = self.step(y, z, bits)?;
        let area: Vec<Ball> = exact(z).iter().zip(r).map(|(x, r)| x.widened(*r)).collect();
        let jacobian = self.jacobian(&area, bits)?;
        let columns: Vec<Vec<Ball>> = (0..n)
            .map(|k| (0..n).map(|m| jacobian.at(m, k).clone()).collect())
            .collect();
        let mut image = Vec::with_capacity(n);
        let mut is_inside = true;
        for (i, (x, s)) in exact(z).iter().zip(&step).enumerate() {
            let entry = |k: usize| {
                let product = dot(bits, y.row(i).iter().zip(&columns[k]));
                (Ball::integer(bits, i64::from(i == k)) - product).magnitude()
            };
            let reach = (0..n).fold(Mag::ZERO, |sum, k| sum.add(entry(k).mul(r[k])));
            is_inside &= s.magnitude().add(reach) < r[i];
            image.push((x - s).widened(reach));
        }
        Ok(Image { image, is_inside })
    }

    /// Newton's method at rising precision from z; none where it does not converge.
    fn approach(
        &mut self,
        start: &[Float],
        bits: u32,
    ) -> Result<Option<Vec<Float>>, SystemError<S::Error>> {
        let mut z: Vec<Float> = start.iter().map(|x| Float::with_val(bits, x)).collect();
        let mut last = Mag::INFINITY;
        for round in 0..STEPS {
            let Some(y) = self.inverse(&z, bits)? else {
                return Ok(None);
            };
            let step = self.step(&y, &z, bits)?;
            let size = step.iter().fold(Mag::ZERO, |m, x| m.max(x.magnitude()));
            if !size.is_finite() {
                return Ok(None);
            }
            for (z, s) in z.iter_mut().zip(&step) {
                *z -= s.mid();
            }
            // Settled: steps are rounding, and no longer shrink.
            let largest = z.iter().fold(Mag::ZERO, |m, x| m.max(Mag::above(x)));
            let tiny = largest.shift(-i64::from(bits) / 2);
            if size.is_zero() || round > 0 && size <= tiny && size >= last.shift(-1) {
                break;
            }
            last = size;
        }
        Ok(Some(z))
    }

    /// A box around z that is proved to hold exactly one zero, and the zero's enclosure.
    fn proved(
        &mut self,
        z: &[Float],
        bits: u32,
    ) -> Result<Option<[Vec<Ball>; 2]>, SystemError<S::Error>> {
        let Some(y) = self.inverse(z, bits)? else {
            return Ok(None);
        };
        let step = self.step(&y, z, bits)?;
        let largest = z.iter().fold(Mag::ZERO, |m, x| m.max(Mag::above(x)));
        let tiny = match largest.is_zero() {
            true => Mag::power_of_two(-i64::from(bits)),
            false => largest.shift(-i64::from(bits)),
        };
        let mut r: Vec<Mag> = step
            .iter()
            .map(|s| s.magnitude().shift(1).add(tiny))
            .collect();
        for _ in 0..INFLATIONS {
            let Image { image, is_inside } = self.krawczyk(&y, z, &r, bits)?;
            if is_inside {
                let area = exact(z)
                    .iter()
                    .zip(&r)
                    .map(|(x, r)| x.widened(*r))
                    .collect();
                return Ok(Some([area, image]));
            }
            r.iter_mut().for_each(|r| *r = r.shift(2));
        }
        Ok(None)
    }

    /// The zero near z to the accuracy asked for; with `owner`, only if it is the one in that box.
    fn refined(
        &mut self,
        start: &[Float],
        owner: Option<&[Ball]>,
        goal: u32,
    ) -> Result<Vec<Ball>, SystemError<S::Error>> {
        let mut bits = goal + SPARE;
        let mut z = start.to_vec();
        let mut reason =
            "Newton's method or Krawczyk's test fails: no solution near, or a singular one";
        for _ in 0..=DOUBLINGS {
            if let Some(near) = self.approach(&z, bits)?
                && let Some([area, image]) = self.proved(&near, bits)?
            {
                let is_owned =
                    |owner: &[Ball]| owner.iter().zip(&area).all(|(x, a)| x.contains_ball(a));
                if !owner.is_none_or(is_owned) {
                    reason = "the solution that Newton's method finds lies outside its box";
                } else if is_known(&image, goal) {
                    return Ok(image);
                } else {
                    reason = "the solution is known to fewer bits than were asked for";
                    z = near;
                }
            }
            bits *= 2;
        }
        let reason = Undecided::new(bits / 2, reason);
        let open = owner
            .map(|x| x.iter().map(ends).collect())
            .into_iter()
            .collect();
        Err(SystemError::Undecided { reason, open })
    }
}

fn ends(x: &Ball) -> [f64; 2] {
    [x.lower().to_f64().next_down(), x.upper().to_f64().next_up()]
}

/// Checks that each component is known to `2^-goal` of its size, or of `2^-goal` of the largest one
/// where it is smaller than that; all are measured by 1 where none is known to differ from zero.
fn is_known(x: &[Ball], goal: u32) -> bool {
    // Two bits more, which `Ball::accuracy_bits` may round off.
    let shift = -i64::from(goal) - 2;
    let largest = x.iter().fold(Mag::ZERO, |m, x| m.max(x.mignitude()));
    let reach = match largest.is_zero() {
        true => Mag::from_f64(1.0),
        false => largest,
    };
    let is_known = |x: &Ball| x.rad() <= x.mignitude().max(reach.shift(shift)).shift(shift);
    x.iter().all(is_known)
}

fn check<E>(name: &'static str, found: usize, due: usize) -> Result<(), SystemError<E>> {
    match found == due {
        true => Ok(()),
        false => Err(LinearError::Length { name, found, due }.into()),
    }
}

fn finite<E>(row: usize, x: f64) -> Result<Float, SystemError<E>> {
    match x.is_finite() {
        true => Ok(Float::with_val(COARSE, x)),
        false => Err(LinearError::NotFinite { row, column: 0 }.into()),
    }
}

/// Encloses the solution that Newton's method finds from a start, each unknown to `2^-goal` of its
/// size, or of `2^-goal` of the largest one where it is smaller than that. It is proved to exist,
/// and to be the only one in a box around it.
///
/// ```
/// use mechaudit_reference::{Ball, roots::systems};
/// use std::convert::Infallible;
/// /// A circle and a line.
/// struct Meeting;
/// impl systems::System for Meeting {
///     type Error = Infallible;
///     fn values(&mut self, x: &[Ball], bits: u32) -> Result<Vec<Ball>, Infallible> {
///         let circle = x[0].square() + x[1].square() - Ball::integer(bits, 1);
///         Ok(vec![circle, &x[0] - &x[1]])
///     }
///     fn jacobian(&mut self, x: &[Ball], bits: u32) -> Result<Vec<Ball>, Infallible> {
///         let one = Ball::integer(bits, 1);
///         Ok(vec![x[0].shift(1), x[1].shift(1), one.clone(), -one])
///     }
/// }
/// let x = systems::near(&mut Meeting, &[1.0, 0.5], 100).unwrap();
/// let due = Ball::integer(300, 2).sqrt().recip();
/// assert!(x.iter().all(|x| x.contains_ball(&due) && x.accuracy_bits() >= 100));
/// ```
///
/// # Errors
/// [`SystemError`]: lengths, starts that are no numbers, equations that fail, or undecided.
pub fn near<S: System>(
    system: &mut S,
    start: &[f64],
    goal: u32,
) -> Result<Vec<Ball>, SystemError<S::Error>> {
    let numbers = start.iter().enumerate().map(|(row, x)| finite(row, *x));
    let z = numbers.collect::<Result<Vec<Float>, _>>()?;
    let n = z.len();
    At { system, n }.refined(&z, None, goal)
}

/// A part of the box by the exact ends of its sides.
type Part = Vec<[Float; 2]>;

/// Encloses the solution in a box, given by the ends of its sides; it is proved to be the only one
/// there. The accuracy is as in [`near`]. At most `limit` parts of the box are looked at.
///
/// # Errors
/// [`SystemError`]: as [`near`], and where no solution or more than one is proved. A solution on
/// the boundary stays undecided.
pub fn in_box<S: System>(
    system: &mut S,
    sides: &[[f64; 2]],
    goal: u32,
    limit: usize,
) -> Result<Vec<Ball>, SystemError<S::Error>> {
    let side = |(row, &[lo, hi]): (usize, &[f64; 2])| -> Result<_, SystemError<S::Error>> {
        let ends = [finite(row, lo)?, finite(row, hi)?];
        match lo < hi {
            true => Ok(ends),
            false => Err(SystemError::Side { row, lo, hi }),
        }
    };
    let first = sides
        .iter()
        .enumerate()
        .map(side)
        .collect::<Result<Part, _>>()?;
    let n = first.len();
    let mut at = At { system, n };
    let mut parts = VecDeque::from([first]);
    let (mut found, mut open): (Vec<Vec<Ball>>, Vec<Part>) = (Vec::new(), Vec::new());
    let mut looked = 0;
    while let Some(part) = parts.pop_front() {
        looked += 1;
        if looked > limit {
            open.push(part);
            continue;
        }
        match at.judge(&part)? {
            Verdict::None => {}
            Verdict::One(area, image) => {
                let x = at.refined(&midpoints(&image, COARSE), Some(&area), goal)?;
                // The ball over the part may be wider than the part.
                if within(&x, &part) {
                    found.push(x);
                } else if !apart(&x, &part) {
                    open.push(part);
                }
            }
            Verdict::Parts(smaller) => parts.extend(smaller),
            Verdict::Open => open.push(part),
        }
        if found.len() > 1 {
            return Err(SystemError::Several { solutions: found });
        }
    }
    if !open.is_empty() {
        let reason = "parts of the box may hold solutions: multiple ones, or on a boundary";
        let ends = |[lo, hi]: &[Float; 2]| [lo.to_f64().next_down(), hi.to_f64().next_up()];
        return Err(SystemError::Undecided {
            reason: Undecided::new(COARSE, reason),
            open: open
                .iter()
                .map(|part| part.iter().map(ends).collect())
                .collect(),
        });
    }
    found.pop().ok_or(SystemError::None)
}

/// Returns true if the enclosure lies in the interior of the part.
fn within(x: &[Ball], part: &Part) -> bool {
    x.iter()
        .zip(part)
        .all(|(x, [lo, hi])| x.lower() > *lo && x.upper() < *hi)
}

/// Returns true if the enclosure has no point in common with the part.
fn apart(x: &[Ball], part: &Part) -> bool {
    x.iter()
        .zip(part)
        .any(|(x, [lo, hi])| x.upper() < *lo || x.lower() > *hi)
}

enum Verdict {
    None,
    /// The ball over the part holds exactly one zero, which is in the image.
    One(Vec<Ball>, Vec<Ball>),
    Parts(Vec<Part>),
    Open,
}

impl<S: System> At<'_, S> {
    fn judge(&mut self, part: &Part) -> Result<Verdict, SystemError<S::Error>> {
        let bits = COARSE;
        let area: Vec<Ball> = part
            .iter()
            .map(|[lo, hi]| Ball::between(bits, lo, hi))
            .collect();
        let values = self.values(&area, bits)?;
        if values.iter().any(|f| f.is_finite() && !f.contains_zero()) {
            return Ok(Verdict::None);
        }
        let z = midpoints(&area, bits);
        let r: Vec<Mag> = area.iter().map(Ball::rad).collect();
        let Some(y) = self.inverse(&z, bits)? else {
            return Ok(halves(part));
        };
        let Image { image, is_inside } = self.krawczyk(&y, &z, &r, bits)?;
        if is_inside {
            return Ok(Verdict::One(area, image));
        }
        if apart(&image, part) {
            return Ok(Verdict::None);
        }
        let meet = |(x, [lo, hi]): (&Ball, &[Float; 2])| match x.is_finite() {
            true => [
                greater(x.lower(), lo.clone()),
                lesser(x.upper(), hi.clone()),
            ],
            false => [lo.clone(), hi.clone()],
        };
        let met: Part = image.iter().zip(part).map(meet).collect();
        let shrinks = |([lo, hi], [from, to]): (&[Float; 2], &[Float; 2])| {
            width(lo, hi) < width(from, to) * 0.75f64
        };
        match met.iter().zip(part).any(shrinks) {
            true => Ok(Verdict::Parts(vec![met])),
            false => Ok(halves(part)),
        }
    }
}

fn width(lo: &Float, hi: &Float) -> Float {
    Float::with_val(COARSE, hi - lo)
}

/// Two parts, divided beside the middle of the widest side, where solutions are rarer than there;
/// open where the side cannot be divided.
fn halves(part: &Part) -> Verdict {
    let by_width = |i: &usize, j: &usize| {
        let [a, b] = [*i, *j].map(|k| width(&part[k][0], &part[k][1]));
        a.total_cmp(&b)
    };
    let Some(k) = (0..part.len()).max_by(by_width) else {
        return Verdict::Open;
    };
    let [lo, hi] = &part[k];
    let middle = Float::with_val(COARSE, width(lo, hi) * 0.484375f64) + lo;
    if !(middle > *lo && middle < *hi) {
        return Verdict::Open;
    }
    let (mut first, mut second) = (part.clone(), part.clone());
    first[k][1] = middle.clone();
    second[k][0] = middle;
    Verdict::Parts(vec![first, second])
}

#[cfg(test)]
mod tests;
