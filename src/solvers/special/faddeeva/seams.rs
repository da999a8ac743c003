//! Where the formulas of W(z) and of its relatives meet: the limits of the ladder, and the lines.

use super::branch::{FINE, NEAR, RINGS, STRIP, TINY};
use super::dawson::{BESIDE_MAXIMUM, ROUNDING_SHOWS};
use super::derivative::UNDERFLOW;
use super::erf::COMPLEMENT;
use super::odd_series;
use super::reflection::{DOMINANT, NEGLIGIBLE};
use super::relatives_tables::MAXIMUM_OF_DAWSON;
use super::rows::{COARSE_PITCH, FINE_PITCH, REAL_AXIS_PITCH};
use super::voigt::{LINEAR, LORENTZ};
use super::voigt_hwhm::{NORMAL, SERIES};

/// Where one formula ends and another begins: what a test of the function has to come close to.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Seams {
    /// |z|² on circles.
    pub circles: &'static [f64],
    /// |Re z| on lines parallel to the imaginary axis.
    pub re: &'static [f64],
    /// |Im z| on lines parallel to the real axis.
    pub im: &'static [f64],
    /// |Re z²| on hyperbolas, in the lower half-plane.
    pub hyperbolas: &'static [f64],
    /// Distances between centres of Taylor series; a cell ends halfway between two centres.
    pub pitches: &'static [f64],
}

/// The seams of [`faddeeva`](super::faddeeva()), whose formulas [`Branch`](super::Branch) names.
///
/// ```
/// use mechaudit_solvers::faddeeva::SEAMS;
///
/// assert_eq!(
///     SEAMS.circles,
///     [
///         0.25f64.powi(7), 0.0625, 1.0, 1.25, 48.0, 80.0, 112.0, 768.0, 1024.0, 5120.0,
///         1_048_576.0, 1e200,
///     ]
/// );
/// assert_eq!(SEAMS.re, [1e-290, 3.75]);
/// // A line that belongs to the strip beside the real axis is the next number.
/// let strip = 0.125f64.next_up();
/// assert_eq!(SEAMS.im, [0.5f64.powi(28), strip, 2.0 * strip, 3.75]);
/// assert_eq!(SEAMS.hyperbolas, [7.0, 47.0]);
/// assert_eq!(SEAMS.pitches, [0.0625, 0.25, 0.5]);
/// ```
pub const SEAMS: Seams = Seams {
    circles: &CIRCLES,
    re: &[TINY, FINE],
    im: &[NEAR, STRIP, 2.0 * STRIP, FINE],
    hyperbolas: &[DOMINANT, NEGLIGIBLE],
    pitches: &[REAL_AXIS_PITCH, FINE_PITCH, COARSE_PITCH],
};

/// The limits of the ladder.
const CIRCLES: [f64; RINGS.len() - 1] = {
    let mut all = [0.0; RINGS.len() - 1];
    let mut k = 0;
    while k < all.len() {
        all[k] = RINGS[k + 1].from;
        k += 1;
    }
    all
};

/// Those from where rows about the real axis begin, after the circle inside which the relatives
/// have series of their own.
const CIRCLES_OF_RELATIVES: [f64; CIRCLES.len() - 2] = {
    let mut all = [odd_series::REACH; CIRCLES.len() - 2];
    let mut k = 1;
    while k < all.len() {
        all[k] = CIRCLES[k + 2];
        k += 1;
    }
    all
};

/// On either axis of the relatives, which turn into each other by quarter turns.
const LINES: &[f64] = &[
    ROUNDING_SHOWS,
    STRIP,
    COMPLEMENT,
    2.0 * STRIP,
    MAXIMUM_OF_DAWSON[0] - BESIDE_MAXIMUM,
    MAXIMUM_OF_DAWSON[0] + BESIDE_MAXIMUM,
    FINE,
    UNDERFLOW,
];

/// The seams of [`erf`](super::erf()), [`erfc`](super::erfc()), [`erfi`](super::erfi()),
/// [`dawson`](super::dawson()) and [`w_derivative`](super::w_derivative); those of
/// [`erfcx`](super::erfcx()) are [`SEAMS`], turned.
///
/// ```
/// use mechaudit_solvers::faddeeva::SEAMS_OF_RELATIVES;
/// assert_eq!(
///     SEAMS_OF_RELATIVES.circles,
///     [0.5, 1.25, 48.0, 80.0, 112.0, 768.0, 1024.0, 5120.0, 1_048_576.0, 1e200]
/// );
/// ```
pub const SEAMS_OF_RELATIVES: Seams = Seams {
    circles: &CIRCLES_OF_RELATIVES,
    re: LINES,
    im: LINES,
    hyperbolas: &[],
    pitches: SEAMS.pitches,
};

/// The limits of `|x|/(σ√2)` and `γ/(σ√2)` at which [`voigt`](super::voigt()) leaves w, whose
/// [`SEAMS`] at `(x + iγ)/(σ√2)` are its others.
///
/// ```
/// use mechaudit_solvers::faddeeva::LIMITS_OF_VOIGT;
/// assert_eq!(LIMITS_OF_VOIGT, [0.5f64.powi(400), 2f64.powi(27)]);
/// ```
pub const LIMITS_OF_VOIGT: [f64; 2] = [LINEAR, LORENTZ];

/// The limits of `γ/(σ√2)` between which [`voigt_hwhm`](super::voigt_hwhm()) evaluates w, whose
/// [`SEAMS`] are its others.
///
/// ```
/// use mechaudit_solvers::faddeeva::LIMITS_OF_VOIGT_HWHM;
/// assert_eq!(LIMITS_OF_VOIGT_HWHM, [0.5f64.powi(60), 256.0]);
/// ```
pub const LIMITS_OF_VOIGT_HWHM: [f64; 2] = [NORMAL, SERIES];

#[cfg(test)]
mod tests;
