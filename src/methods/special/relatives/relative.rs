//! A function of a complex argument that is built on W, and what several of them share.

use crate::audit::{BranchAt, Expected, Law, ProvedBound, ProvedError, Region};
use crate::methods::definition::Registered;
use crate::methods::special::branches::nearest;
use crate::methods::special::complex::{C, exponential, infinity, number};
use crate::reference::Undecided;
use crate::reference::faddeeva::Scaled;
use crate::solvers::faddeeva::{PROVED_REAL_ULPS, SEAMS_OF_RELATIVES};
use num_complex::Complex;
use rug::Rational;

/// Components from `Re z, Im z` and the bits asked for.
pub type Exact = fn(&Rational, &Rational, u32) -> Result<[Scaled; 2], Undecided>;

/// The same for a product of W and an exponential.
pub(super) const NORM_OF_PRODUCTS: (f64, &str) = (
    4.0,
    "2 eps: half a unit of rounding in each component is 1 u of the norm at most, 3 u more for the \
     exponential and W",
);

/// The zeros of a function next to which it is audited.
pub struct Zeros {
    /// The `f64` next to the k-th one, k = 1, 2, …
    pub at: fn(usize) -> [f64; 2],
    /// Tells whether −x, −y belong to a zero as well.
    pub mirrored: [bool; 2],
    /// The number of them that the solver stores; beyond it sums in longer numbers.
    pub stored: usize,
}

/// A function of a complex argument: input `Re z, Im z`, output the two components.
pub trait Relative: Registered {
    const SUMMARY: &'static str;
    const SOURCE: &'static str;
    /// The components.
    const OUTPUTS: [&'static str; 2];
    /// States what a component may be wrong by, in units in its last place, and why.
    const ULPS: (f64, &'static str);
    /// States what the norm may be wrong by, in units of 2⁻⁵³, and why.
    const NORM: (f64, &'static str);
    /// The code under test.
    const VALUE: fn(C) -> C;
    /// The certified value.
    const EXACT: Exact;
    /// Where it is zero.
    const ZEROS: Zeros;

    /// The function by its definition from W, roughly: where the search for a point next to a zero
    /// curve begins.
    fn from_w(w: fn(C) -> C, z: C) -> C;
    /// The derivative at `z`, from the value there, to a few digits: points next to zero curves are
    /// found with it.
    fn slope(z: C, value: C) -> C;

    /// Returns the expected values at an argument that is not finite.
    fn limit(x: f64, y: f64) -> [Expected; 2];
    /// Returns whether the limit of each component, where it is zero, is −0; `None` where there is
    /// no limit of the sign.
    fn signs_of_zero(x: f64, y: f64) -> [Option<bool>; 2];
    /// Identities of the values.
    fn laws() -> Vec<Law>;
    /// Returns what is proved of the solver's error.
    fn proved() -> Vec<ProvedBound> {
        Vec::new()
    }
    /// Regions of this function alone.
    fn regions() -> Vec<Region> {
        Vec::new()
    }
    /// Where the solver's formulas meet next to `z`.
    fn branch(z: Complex<f64>) -> Option<BranchAt> {
        nearest(z, &SEAMS_OF_RELATIVES, None)
    }
}

/// erf z = 1 − e^{−z²} w(iz) on the side where w does not grow.
pub(super) fn erf_from_w(w: fn(C) -> C, z: C) -> C {
    match z.re < 0.0 {
        true => -erf_from_w(w, -z),
        false => 1.0 - exponential(-z * z) * w(C::i() * z),
    }
}

/// `−d`
pub(super) fn negated(d: Expected) -> Expected {
    match d {
        Expected::Number(ball) => Expected::Number(-ball),
        Expected::Infinity { negative } => Expected::Infinity {
            negative: !negative,
        },
        Expected::Zero { ball, negative } => Expected::Zero {
            ball,
            negative: !negative,
        },
        Expected::NotANumber => Expected::NotANumber,
    }
}

/// The limits of an odd function that is real on the real axis and imaginary on the imaginary one,
/// that tends to ±`right` for Re z → ±∞ and to ±i∞ along the imaginary axis.
pub(super) fn odd_limit(right: i64, x: f64, y: f64) -> [Expected; 2] {
    let known = |zero| {
        if zero {
            number(0)
        } else {
            Expected::NotANumber
        }
    };
    if x.is_nan() || y.is_nan() {
        return [known(x == 0.0), known(y == 0.0)];
    }
    match (x.is_infinite(), y.is_infinite()) {
        (true, false) => [
            number(if x.is_sign_negative() { -right } else { right }),
            number(0),
        ],
        (false, true) if x == 0.0 => [number(0), infinity(y)],
        // No limit.
        _ => [Expected::NotANumber, Expected::NotANumber],
    }
}

/// Returns what is proved of a function of a real argument.
pub(super) fn on_the_real_line(inputs: &'static str, command: &'static str) -> Vec<ProvedBound> {
    vec![ProvedBound {
        error: ProvedError::Ulps(PROVED_REAL_ULPS),
        inputs,
        command,
    }]
}

/// The sign of `x` times that of `factor`, where x is zero: the sign of a component that vanishes
/// with x and grows like `factor · x`.
pub(super) fn on_axis(x: f64, factor: f64) -> Option<bool> {
    (x == 0.0).then(|| x.is_sign_negative() != factor.is_sign_negative())
}

/// Signs of an odd function that is real and increasing on the real axis, and i times such a one on
/// the imaginary axis: its slope is positive on both.
pub(super) fn odd_signs(x: f64, y: f64) -> [Option<bool>; 2] {
    [on_axis(x, 1.0), on_axis(y, 1.0)]
}
