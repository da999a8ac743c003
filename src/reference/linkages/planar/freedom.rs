//! Degrees of freedom at a drawn position, by ranks of exact matrices.
//!
//! A count of bodies and joints holds for dimensions in general; a parallelogram with a third crank
//! moves although it is over-constrained by count. At one position it is the rank that tells. With
//! the velocity `v_k + ω_k × p` of body k's point at p, a pin at p has two equations in six
//! velocities; p being a fraction, the matrix is exact.
//!
//! Of `n` velocities and `m` equations of rank r, `n − r` is the number of infinitesimal degrees of
//! freedom, `m − r` that of redundant equations. Vectors that the matrix takes to zero are
//! velocities of all bodies; those that its transpose takes to zero are forces in the pins that
//! hold one another, and bodies with such forces are those held too often.
//!
//! * `r = n`: nothing moves, the equations being one to one near a position where their derivative
//!   is.
//! * `r = m`: the positions near are a manifold of dimension `n − r`, by the theorem on implicit
//!   functions. This is so too at every position that
//!   [`Linkage::position`](super::Linkage::position) encloses.
//! * Else `n − r` is an upper bound alone: a velocity need not be that of a motion. It is if
//!   turning every body k by `ω_k θ` keeps the pins for all θ: origins move by sums of `z e^{iωθ}`,
//!   and a loop closes for all θ exactly if its terms of every frequency ω add up to zero. So
//!   parallelograms and their chains are proved to move. Else it is open.

use super::parts::{Frame, MechanismError, Point};
use rug::Rational;

/// A pin of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPin {
    /// Whose points it holds together.
    pub frames: [Frame; 2],
    /// Where it is drawn.
    pub at: Point,
}

/// Bodies and pins in the position in which they are drawn, of any number of degrees of freedom.
///
/// ```
/// use mechaudit_reference::planar::{Drawing, DrawnPin, Frame, Mobility};
/// use rug::Rational;
/// // A parallelogram with a third crank: one constraint too many, and it moves.
/// let pin = |a, b, x: i32, y: i32| DrawnPin {
///     frames: [a, b],
///     at: [Rational::from(x), Rational::from(y)],
/// };
/// let (ground, coupler) = (Frame::Ground, Frame::Body(3));
/// let mut pins = Vec::new();
/// for (k, x) in [0, 2, 5].into_iter().enumerate() {
///     pins.push(pin(ground, Frame::Body(k), x, 0));
///     pins.push(pin(Frame::Body(k), coupler, x + 1, 2));
/// }
/// let freedom = Drawing::new(4, pins)?.freedom();
/// assert_eq!((freedom.velocities, freedom.equations, freedom.rank), (12, 12, 11));
/// assert_eq!(freedom.mobility, Mobility::Turning { most: 1 });
/// # Ok::<(), mechaudit_reference::planar::MechanismError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Drawing {
    bodies: usize,
    pins: Vec<DrawnPin>,
}

/// Describes what is proved of the motions near a drawn position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mobility {
    /// No body can move.
    Locked,
    /// No equation is redundant: the exact number of degrees of freedom.
    Regular {
        /// How many.
        freedoms: usize,
    },
    /// Some equations are redundant, and it moves all the same: at least one degree of freedom.
    Turning {
        /// The largest possible number.
        most: usize,
    },
    /// Some equations are redundant; whether it moves is not decided.
    Undecided {
        /// The largest possible number of degrees of freedom.
        most: usize,
    },
}

/// Ranks at a drawn position, exact.
#[derive(Clone, Debug, PartialEq)]
pub struct Freedom {
    /// Three for every moving body.
    pub velocities: usize,
    /// Two for every pin.
    pub equations: usize,
    /// The rank.
    pub rank: usize,
    /// The bodies that have a velocity in some infinitesimal motion, ascending.
    pub movable: Vec<usize>,
    /// The bodies with pins whose forces can hold one another, ascending: held too often.
    pub strained: Vec<usize>,
    /// Holds what follows for motions.
    pub mobility: Mobility,
}

impl Freedom {
    /// The number of equations that follow from the others.
    pub fn redundant(&self) -> usize {
        self.equations - self.rank
    }

    /// The number of infinitesimal degrees of freedom.
    pub fn infinitesimal(&self) -> usize {
        self.velocities - self.rank
    }
}

impl Drawing {
    /// Creates the drawing of a number of moving bodies with their pins.
    ///
    /// # Errors
    /// [`MechanismError::Missing`] if a pin names a body that does not exist,
    /// [`MechanismError::Itself`] if it joins a body to itself.
    pub fn new(bodies: usize, pins: Vec<DrawnPin>) -> Result<Drawing, MechanismError> {
        for (joint, pin) in pins.iter().enumerate() {
            let exists = |f: &Frame| f.body().is_none_or(|k| k < bodies);
            if !pin.frames.iter().all(exists) {
                return Err(MechanismError::Missing { joint });
            }
            if pin.frames[0] == pin.frames[1] {
                return Err(MechanismError::Itself { joint });
            }
        }
        Ok(Drawing { bodies, pins })
    }

    /// Two rows for every pin: the velocity of its first point less that of its second.
    fn matrix(&self) -> Vec<Vec<Rational>> {
        let rows = self.pins.iter().flat_map(|p| rows_of(p, self.bodies));
        rows.collect()
    }

    /// The ranks and what follows.
    pub fn freedom(&self) -> Freedom {
        let matrix = self.matrix();
        let velocities = 3 * self.bodies;
        let motions = kernel(&matrix, velocities);
        let rank = velocities - motions.len();
        let transposed: Vec<Vec<Rational>> = (0..velocities)
            .map(|k| matrix.iter().map(|row| row[k].clone()).collect())
            .collect();
        let strains = kernel(&transposed, matrix.len());
        let some = |v: &[Rational]| v.iter().any(|x| !x.is_zero());
        let movable = (0..self.bodies)
            .filter(|k| motions.iter().any(|m| some(&m[3 * k..3 * k + 3])))
            .collect();
        let strained = |k: &usize| {
            let holds = |i: usize| self.pins[i].frames.contains(&Frame::Body(*k));
            let force = |s: &Vec<Rational>, i: usize| some(&s[2 * i..2 * i + 2]);
            (0..self.pins.len()).any(|i| holds(i) && strains.iter().any(|s| force(s, i)))
        };
        let most = motions.len();
        let mobility = match (most, strains.is_empty()) {
            (0, _) => Mobility::Locked,
            (freedoms, true) => Mobility::Regular { freedoms },
            _ if motions.iter().any(|m| self.turns(m)) => Mobility::Turning { most },
            _ => Mobility::Undecided { most },
        };
        Freedom {
            velocities,
            equations: matrix.len(),
            rank,
            movable,
            strained: (0..self.bodies).filter(strained).collect(),
            mobility,
        }
    }

    /// Returns whether turning every body k by `ω_k θ` keeps the pins for every θ, with the angular
    /// velocities of that motion, and moves something.
    ///
    /// Body k's points at p go to `T_k(θ) + e^{iω_kθ} p`; from body a to b at a pin,
    /// `T_b = T_a + (e^{iω_aθ} − e^{iω_bθ}) p`.
    fn turns(&self, motion: &[Rational]) -> bool {
        let zero = Rational::new();
        let omega = |frame: Frame| frame.body().map_or(&zero, |k| &motion[3 * k + 2]);
        if (0..self.bodies).all(|k| motion[3 * k + 2].is_zero()) {
            return false;
        }
        let step = |pin: &DrawnPin| {
            let mut sum = Sum::default();
            sum.add(omega(pin.frames[0]), &pin.at, 1);
            sum.add(omega(pin.frames[1]), &pin.at, -1);
            sum
        };
        // The ground, then the bodies.
        let mut shifts: Vec<Option<Sum>> = vec![None; self.bodies + 1];
        let place = |frame: Frame| frame.body().map_or(0, |k| k + 1);
        shifts[0] = Some(Sum::default());
        let mut open: Vec<&DrawnPin> = self.pins.iter().collect();
        loop {
            let before = open.len();
            let mut closed = true;
            open.retain(|pin| {
                let [a, b] = pin.frames.map(place);
                match (&shifts[a], &shifts[b]) {
                    (Some(from), Some(to)) => {
                        closed &= from.moved(&step(pin), 1).is(to);
                        false
                    }
                    (Some(from), None) => {
                        shifts[b] = Some(from.moved(&step(pin), 1));
                        false
                    }
                    (None, Some(to)) => {
                        shifts[a] = Some(to.moved(&step(pin), -1));
                        false
                    }
                    (None, None) => true,
                }
            });
            if !closed {
                return false;
            }
            if open.len() == before {
                // A body that hangs on nothing is free.
                return open.is_empty();
            }
        }
    }
}

/// `Σ z e^{iωθ}` by ω.
#[derive(Clone, Debug, Default)]
struct Sum(Vec<(Rational, Point)>);

impl Sum {
    fn add(&mut self, omega: &Rational, z: &Point, sign: i32) {
        let z = z.clone().map(|x| x * sign);
        match self.0.iter_mut().find(|t| t.0 == *omega) {
            Some((_, sum)) => sum.iter_mut().zip(z).for_each(|(s, x)| *s += x),
            None => self.0.push((omega.clone(), z)),
        }
    }

    fn moved(&self, by: &Sum, sign: i32) -> Sum {
        let mut out = self.clone();
        by.0.iter().for_each(|(omega, z)| out.add(omega, z, sign));
        out
    }

    /// Equal for every θ: terms of different frequencies are linearly independent.
    fn is(&self, other: &Sum) -> bool {
        let rest = self.moved(other, -1);
        rest.0.iter().all(|(_, z)| z.iter().all(Rational::is_zero))
    }
}

/// The two rows of a pin, in `(v_x, v_y, ω)` of every body.
fn rows_of(pin: &DrawnPin, bodies: usize) -> [Vec<Rational>; 2] {
    let mut rows = [0, 1].map(|_| vec![Rational::new(); 3 * bodies]);
    for (frame, sign) in pin.frames.into_iter().zip([1, -1]) {
        let Some(k) = frame.body() else { continue };
        let [x, y]: Point = pin.at.clone().map(|c| c * sign);
        rows[0][3 * k] = sign.into();
        rows[1][3 * k + 1] = sign.into();
        rows[0][3 * k + 2] = -y;
        rows[1][3 * k + 2] = x;
    }
    rows
}

/// A basis of the vectors of that length that the matrix takes to zero.
fn kernel(matrix: &[Vec<Rational>], columns: usize) -> Vec<Vec<Rational>> {
    let mut rows: Vec<Vec<Rational>> = matrix.to_vec();
    let mut pivots = Vec::new();
    for c in 0..columns {
        let r = pivots.len();
        let Some(found) = (r..rows.len()).find(|&i| !rows[i][c].is_zero()) else {
            continue;
        };
        rows.swap(r, found);
        let scale = rows[r][c].clone();
        rows[r].iter_mut().for_each(|x| *x /= &scale);
        let pivot = rows[r].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[c].clone();
            if i != r && !factor.is_zero() {
                let pairs = row.iter_mut().zip(&pivot);
                pairs.for_each(|(x, p)| *x -= Rational::from(&factor * p));
            }
        }
        pivots.push(c);
    }
    let free = (0..columns).filter(|c| !pivots.contains(c));
    free.map(|f| {
        let mut v = vec![Rational::new(); columns];
        v[f] = Rational::from(1);
        for (row, &c) in rows.iter().zip(&pivots) {
            v[c] = Rational::from(-&row[f]);
        }
        v
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: i32, y: i32) -> Point {
        [x, y].map(Rational::from)
    }

    /// Sums are equal if the terms of every frequency are.
    #[test]
    fn sums_differ_in_one_frequency() {
        let sum = |terms: &[(i32, Point)]| {
            let mut sum = Sum::default();
            terms
                .iter()
                .for_each(|(omega, z)| sum.add(&Rational::from(*omega), z, 1));
            sum
        };
        let both = sum(&[(1, point(1, 2)), (3, point(0, 4))]);
        let one = sum(&[(1, point(1, 2))]);
        assert!(!both.is(&one) && !one.is(&both));
        let parts = [(3, point(5, 1)), (1, point(1, 2)), (3, point(-5, 3))];
        assert!(both.is(&sum(&parts)));
    }

    /// A motion without a turn is none of those that turning proves, be it of bodies on the ground
    /// or of none.
    #[test]
    fn a_shift_does_not_turn() {
        let [x, o] = [1, 0].map(Rational::from);
        let free = Drawing::new(1, Vec::new()).unwrap();
        assert!(!free.turns(&[x.clone(), o.clone(), o.clone()]));
        assert!(free.turns(&[o.clone(), o, x]));
    }
}
