//! erf, erfc, erfcx and Dawson's function of a real argument: bounds of the error in units in the
//! last place of the value, for every finite `f64`.
//!
//! [`real_line`] proves them as [`upper_half_plane`](crate::upper_half_plane) does for w, on
//! intervals in place of rectangles. Each of the four functions is a sum of two numbers that is
//! rounded once at the end; the sum is known to much less than a unit in the last place, so that
//! the bounds are little more than one half.

mod choice;
mod evaluate;
mod prove;
mod summary;
mod tables;

pub use choice::{Formula, Inner, choice};
pub use prove::{Certificate, Code, Leaf, Open, hole, real_line};
pub use summary::{OfFormula, Summary};
pub use tables::Tables;

/// A function of a real argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// The error function.
    Erf,
    /// The complementary error function.
    Erfc,
    /// `e^{x²} erfc x`.
    Erfcx,
    /// Dawson's function.
    Dawson,
}

impl Function {
    /// All of them.
    pub const ALL: [Function; 4] = [
        Function::Erf,
        Function::Erfc,
        Function::Erfcx,
        Function::Dawson,
    ];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Function::Erf => "erf",
            Function::Erfc => "erfc",
            Function::Erfcx => "erfcx",
            Function::Dawson => "dawson",
        }
    }

    /// The bound that is proved, in units in the last place of the value.
    pub const fn ulps(self) -> f64 {
        mechaudit_solvers::faddeeva::PROVED_REAL_ULPS
    }

    /// The signs of the arguments for which something has to be proved: the code of an odd function
    /// takes |x| and gives the value the sign of x.
    pub(crate) fn signs(self) -> &'static [bool] {
        match self {
            Function::Erf | Function::Dawson => &[false],
            Function::Erfc | Function::Erfcx => &[false, true],
        }
    }
}

/// The `f64`s of one sign with `ends[0] ≤ |x| ≤ ends[1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Tells whether x is negative.
    pub negative: bool,
    /// The ends of |x|.
    pub ends: [f64; 2],
}

impl Interval {
    /// The ends of x.
    pub fn signed(&self) -> [f64; 2] {
        let [lo, hi] = self.ends;
        match self.negative {
            true => [-hi, -lo],
            false => [lo, hi],
        }
    }

    /// Returns whether it is one number.
    pub fn is_point(&self) -> bool {
        self.ends[0] == self.ends[1]
    }

    /// Two halves of it, by the number of `f64`s.
    pub(crate) fn halves(&self) -> [Interval; 2] {
        let [p, q] = self.ends.map(f64::to_bits);
        let middle = p + (q - p) / 2;
        let part = |p, q| Interval {
            negative: self.negative,
            ends: [f64::from_bits(p), f64::from_bits(q)],
        };
        [part(p, middle), part((middle + 1).min(q), q)]
    }
}
