//! Exact rationals with ordinary operators, and proofs of polynomial identities on grids.

use super::Outcome;
use rug::Rational;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// An exact rational number. The newtype only gives `rug`'s rational the operators that make a
/// formula look as it is printed.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Q(pub Rational);

/// `n/d`.
pub(super) fn q(n: i32, d: u32) -> Q {
    Q(Rational::from((n, d)))
}

impl Q {
    pub(super) fn is_zero(&self) -> bool {
        self.0 == 0
    }

    pub(super) fn abs(&self) -> Q {
        Q(self.0.clone().abs())
    }
}

impl From<i32> for Q {
    fn from(n: i32) -> Q {
        Q(Rational::from(n))
    }
}

impl fmt::Display for Q {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $op:tt) => {
        impl $trait<&Q> for &Q {
            type Output = Q;
            fn $method(self, other: &Q) -> Q {
                Q(Rational::from(&self.0 $op &other.0))
            }
        }
        impl $trait<Q> for &Q {
            type Output = Q;
            fn $method(self, other: Q) -> Q {
                Q(&self.0 $op other.0)
            }
        }
        impl $trait<&Q> for Q {
            type Output = Q;
            fn $method(self, other: &Q) -> Q {
                Q(self.0 $op &other.0)
            }
        }
        impl $trait<Q> for Q {
            type Output = Q;
            fn $method(self, other: Q) -> Q {
                Q(self.0 $op other.0)
            }
        }
        impl $trait<i32> for &Q {
            type Output = Q;
            fn $method(self, other: i32) -> Q {
                Q(Rational::from(&self.0 $op other))
            }
        }
        impl $trait<i32> for Q {
            type Output = Q;
            fn $method(self, other: i32) -> Q {
                Q(self.0 $op other)
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl Neg for Q {
    type Output = Q;
    fn neg(self) -> Q {
        Q(-self.0)
    }
}

impl Neg for &Q {
    type Output = Q;
    fn neg(self) -> Q {
        -self.clone()
    }
}

/// A grid with `degree + 1` distinct values, none of them zero, for each variable.
///
/// A polynomial whose degree in each variable is at most the one given here and that vanishes on
/// the whole grid is the zero polynomial: fixed at all variables but one it has more zeros than its
/// degree, so it vanishes for every value of that one, and so on through the variables. A rational
/// expression is covered when it becomes such a polynomial after multiplication by a denominator
/// that has no zero on the grid. Degrees are read off the formulas by eye; the bounds used are the
/// next larger ones where that costs nothing.
pub(super) struct Grid {
    axes: Vec<Vec<Q>>,
}

/// What came of evaluating an expression on a grid.
#[derive(Clone, Debug)]
pub(super) struct Identity {
    /// Points evaluated.
    pub points: usize,
    /// The first point where the expression is not zero, and its value there.
    pub failure: Option<(Vec<Q>, Q)>,
}

impl Grid {
    /// Variable number v takes the values `1/(v+2), 3/(v+2), 5/(v+2), …`.
    pub(super) fn new(degrees: &[u32]) -> Grid {
        let axis = |(v, &degree): (usize, &u32)| {
            (0..=degree)
                .map(|j| q(2 * j as i32 + 1, v as u32 + 2))
                .collect()
        };
        Grid {
            axes: degrees.iter().enumerate().map(axis).collect(),
        }
    }

    /// Evaluates `f` everywhere, or until it is not zero.
    pub(super) fn vanishes(&self, f: impl Fn(&[Q]) -> Q) -> Identity {
        let total: usize = self.axes.iter().map(Vec::len).product();
        for n in 0..total {
            let mut rest = n;
            let point: Vec<Q> = self
                .axes
                .iter()
                .map(|axis| {
                    let x = axis[rest % axis.len()].clone();
                    rest /= axis.len();
                    x
                })
                .collect();
            let value = f(&point);
            if !value.is_zero() {
                return Identity {
                    points: n + 1,
                    failure: Some((point, value)),
                };
            }
        }
        Identity {
            points: total,
            failure: None,
        }
    }
}

impl Identity {
    pub(super) fn outcome(&self) -> Outcome {
        match self.failure {
            None => Outcome::Holds,
            Some(_) => Outcome::Fails,
        }
    }

    /// The outcome of several identities together, and the points evaluated for them.
    pub(super) fn all(identities: &[Identity]) -> (Outcome, usize) {
        let points = identities.iter().map(|i| i.points).sum();
        (
            Outcome::all(identities.iter().map(Identity::outcome)),
            points,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_tells_identities_from_near_misses() {
        let grid = Grid::new(&[2, 2]);
        let square = |x: &Q| x * x;
        let good = grid.vanishes(|v| {
            square(&(&v[0] + &v[1])) - square(&v[0]) - square(&v[1]) - &v[0] * &v[1] * 2
        });
        assert_eq!((good.points, good.outcome()), (9, Outcome::Holds));
        let bad = grid.vanishes(|v| square(&(&v[0] + &v[1])) - square(&v[0]) - square(&v[1]));
        assert_eq!(bad.outcome(), Outcome::Fails);
        let (at, value) = bad.failure.unwrap();
        assert_eq!(value, &at[0] * &at[1] * 2);
        // On the diagonal alone, and on the first line alone.
        let bad = grid.vanishes(|v| &v[0] * 2 - &v[1] * 3);
        assert_eq!((bad.points, bad.outcome()), (2, Outcome::Fails));
        let bad = grid.vanishes(|v| &v[1] - q(1, 3));
        assert_eq!((bad.points, bad.outcome()), (4, Outcome::Fails));
        let only = |v: &[Q]| v[0] == q(1, 2) && v[1] == q(1, 3);
        let bad = grid.vanishes(|v| Q::from(i32::from(only(v))));
        assert_eq!((bad.points, bad.outcome()), (1, Outcome::Fails));
        // The largest degree allowed has to be caught: (x − 1/2)(x − 3/2) vanishes on two of three.
        let bad = grid.vanishes(|v| (&v[0] - q(1, 2)) * (&v[0] - q(3, 2)));
        assert_eq!((bad.points, bad.outcome()), (3, Outcome::Fails));
    }
}
