//! The bound that is proved on a rectangle.

use crate::interval::larger;

/// The errors that are proved on a rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// `|faddeeva(z) − w(z)| ≤ norm · 2⁻⁵² |w(z)|`, and what underflows.
    pub norm: f64,
    /// Of the real part, in units in its last place; infinite where nothing is proved.
    pub re: f64,
    /// Of the imaginary part.
    pub im: f64,
    /// The bound on the error by underflow of either component, in units of 2⁻¹⁰⁷⁵, where the
    /// component may be below 2⁻⁹⁶⁰.
    pub tiny: f64,
}

impl Bound {
    /// The worse of both in each respect.
    pub fn max(self, other: Bound) -> Bound {
        Bound {
            norm: larger(self.norm, other.norm),
            re: larger(self.re, other.re),
            im: larger(self.im, other.im),
            tiny: larger(self.tiny, other.tiny),
        }
    }

    /// Nothing wrong at all.
    pub const NONE: Bound = Bound {
        norm: 0.0,
        re: 0.0,
        im: 0.0,
        tiny: 0.0,
    };
}
