//! The Faddeeva function `w(z) = e^{−z²} erfc(−iz)` (DLMF 7.2.3) in `f64`, on the whole plane.
//!
//! # Accuracy
//! Each component within a few units in its own last place wherever it is representable: beside the
//! axes, on the diagonals, in the lower half-plane and next to the zeros of w and of its
//! components. Worst found against the certified reference at 4.9 · 10⁷ points of 13 regions, the
//! seams between formulas among them (`reference/campaigns`): 1.69 · 2⁻⁵² of the norm (0.99 away
//! from the lower half-plane); of a component, 3.21 units in the last place, in the lower
//! half-plane; 1.8 in `small`, `mid` and `far`, 2.3 beside the real axis, 2.5 on the diagonals, 2.9
//! next to zeros. `mechaudit audit faddeeva` judges it; `benches/peers` measures it beside other
//! codes.
//!
//! Proved by machine for every finite z with Im z ≥ 0: 1.25 · 2⁻⁵² of the norm and 4 units in the
//! last place of each component, but for what underflows (`mechaudit prove faddeeva`); for Im z <
//! 0, where w does not overflow, 2.5 · 2⁻⁵² of the norm (`--part lower`), where points are computed
//! again by an analysis by hand.
//!
//! # Method
//! In the closed first quadrant, by `|z|` and the distance from the axes ([`Branch`]; [`SEAMS`] has
//! the limits):
//!
//! - inside the first two circles: Maclaurin series with 9 and 21 terms;
//! - up to the circle where the asymptotic series begins: Taylor series of 18 terms about tabulated
//!   centres, closer together where `|z|` is small, the two leading coefficients in double-double;
//!   beside the axes the centres lie on them (on the real axis closest together), so that the small
//!   component keeps its relative accuracy; on the imaginary axis with the real coefficients of
//!   erfcx;
//! - beyond: asymptotic series (DLMF 7.12.1) with 26, 14, 6, 4 or 2 terms, and `e^{−z²}` added
//!   beside the real axis; next to it two real polynomials serve instead.
//!
//! Batches are sorted by formula, 256 points at a time, by the leading bits of `|z|²` and a few
//! comparisons; in batches of 1024 points and more, those that fewer than eight of the 256 share a
//! formula with wait until there are more.
//!
//! In the lower half-plane `w(z) = 2e^{−z²} − w(−z)` (DLMF 7.4.3) with `z²` in double-double and
//! exponent and phase reduced accordingly (Payne–Hanek for huge phases), and with the formulas
//! above carried on to pairs of `f64`; single ones suffice in cells and with 26 terms beyond the
//! first hyperbola of [`SEAMS`], because one of the terms dominates there. Where a component is
//! smaller than a twenty-fifth of its terms, or both are small, w is computed again in
//! double-double by the trapezoidal rule with the residue at its pole, and where a component is
//! below 2⁻³⁶ of them once more in 256 bits (|z| < 4096; beyond, by the asymptotic series, below
//! 2⁻²²). So is a component whose phase is within 2⁻⁶⁰ of a multiple of π/2. Next to the first
//! twelve zeros w comes from Taylor series about the zero, which is stored to 160 bits.
//!
//! # Special values
//! | z | w(z) |
//! |---|---|
//! | `x + i∞` | `+0 ± 0i` (the sign of x) |
//! | `±∞ + iy`, y finite or `+∞` | `±0 ± 0i` (the signs of y and x) |
//! | `±0 + iy` | Im is ±0 |
//! | `±0 − i∞` | `+∞ ± 0i` |
//! | `x − i∞`, `x ≠ 0`; `±∞ − i∞` | `NaN + NaN i`: no limit |
//! | a component NaN | `NaN + NaN i`; `NaN ± 0i` on the imaginary axis, where w is real |
//! | `\|2e^{−z²}\|` above the range | the infinity of the right sign for each component above it |
//!
//! Underflow is gradual; nothing allocates and nothing panics.
//!
//! # Speed
//! All code is compiled twice, for processors with FMA and AVX2 and for any other (where the fused
//! operations are slow, but round alike), and chosen at run time; batches a third time, for
//! AVX-512. All give the same bits.

mod asymptotic;
mod axis;
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
mod batch;
mod branch;
mod constant_pairs;
mod constants;
mod dawson;
mod derivative;
mod erf;
mod erf_exact;
mod erf_zeros;
mod erfc_rows;
mod erfcx;
mod extended;
mod groups;
mod lengths;
mod long;
mod long_functions;
mod long_relatives;
mod long_w;
mod maclaurin;
mod many;
mod odd_series;
mod pairs;
mod places;
mod plane;
mod points;
#[cfg(feature = "proof")]
#[doc(hidden)]
pub mod proof;
mod quadrant;
mod real_argument;
mod real_line;
mod reflection;
mod relatives_tables;
mod rows;
mod seams;
mod slope;
mod special;
#[rustfmt::skip]
#[allow(clippy::all)]
mod tables;
mod taylor;
mod trapezoidal;
mod voigt;
mod voigt_hwhm;
mod zeros;

pub use branch::Branch;
pub use seams::{LIMITS_OF_VOIGT, LIMITS_OF_VOIGT_HWHM, SEAMS, SEAMS_OF_RELATIVES, Seams};

pub use dawson::{dawson, dawson_batch};
pub use derivative::{w_derivative, w_derivative_batch};
pub use erf::{erf, erf_batch, erfc, erfc_batch, erfi, erfi_batch};
pub use erfcx::{erfcx, erfcx_batch};
pub use lengths::LengthMismatch;
pub use real_argument::{
    dawson_real, dawson_real_batch, erf_real, erf_real_batch, erfc_real, erfc_real_batch,
    erfcx_real, erfcx_real_batch, erfi_real, erfi_real_batch,
};
pub use voigt::{voigt, voigt_batch, voigt_each};
pub use voigt_hwhm::voigt_hwhm;

use branch::{CELL, IMAGINARY_AXIS, MACLAURIN_21, formula_at};
pub(crate) use extended::w_extended;
/// √π/2.
pub(crate) const HALF_SQRT_PI: crate::double_double::Dd = constants::HALF_SQRT_PI;
use lengths::same_length;
use many::all;
use num_complex::Complex;
use points::{Apart, Interleaved};

/// The bound of `|faddeeva(z) − w(z)| / |w(z)|` in units of 2⁻⁵² that `mechaudit prove faddeeva`
/// proves for every `z` with `Im z ≥ 0`.
pub const PROVED_NORM: f64 = 1.25;

/// The bound of the error of [`erf_real`], [`erfc_real`], [`erfcx_real`] and [`dawson_real`], in
/// units in the last place of the value, that `mechaudit prove erf` (`erfc`, …) proves for every
/// argument.
pub const PROVED_REAL_ULPS: f64 = 0.875;

/// The Faddeeva function `w(z) = e^{−z²} erfc(−iz)`.
///
/// Accuracy, method and special values: [the module](self).
///
/// ```
/// use mechaudit_solvers::faddeeva::faddeeva;
/// use num_complex::Complex;
///
/// let w = faddeeva(Complex::new(1.0, 1.0));
/// assert!((w.re - 0.3047442052569126).abs() < 1e-16);
/// assert!((w.im - 0.2082189382028316).abs() < 1e-16);
/// // On the real axis the real part is e^{−x²}.
/// let w = faddeeva(Complex::new(3.0, 0.0));
/// assert!((w.re / (-9.0f64).exp() - 1.0).abs() < 1e-15);
/// ```
#[inline]
pub fn faddeeva(z: Complex<f64>) -> Complex<f64> {
    many::one(z)
}

/// [`faddeeva`] at many points, several times as fast; the values have the same bits.
///
/// # Errors
/// [`LengthMismatch`] if the slices differ in length; nothing is written then.
///
/// ```
/// use mechaudit_solvers::faddeeva::{faddeeva, faddeeva_batch};
/// use num_complex::Complex;
///
/// let z: Vec<_> = (0..1000).map(|k| Complex::new(0.01 * f64::from(k), 0.5)).collect();
/// let mut w = vec![Complex::default(); z.len()];
/// faddeeva_batch(&z, &mut w)?;
/// assert_eq!(w[700], faddeeva(z[700]));
/// # Ok::<(), mechaudit_solvers::faddeeva::LengthMismatch>(())
/// ```
pub fn faddeeva_batch(z: &[Complex<f64>], w: &mut [Complex<f64>]) -> Result<(), LengthMismatch> {
    same_length(z.len(), [w.len()])?;
    all(&mut Interleaved { z, w });
    Ok(())
}

/// [`faddeeva_batch`] for real and imaginary parts in slices of their own.
///
/// # Errors
/// [`LengthMismatch`] if the slices differ in length; nothing is written then.
///
/// ```
/// use mechaudit_solvers::faddeeva::faddeeva_soa;
///
/// let (mut re, mut im) = ([0.0; 2], [0.0; 2]);
/// faddeeva_soa(&[0.0, 1.0], &[0.0, 0.0], &mut re, &mut im)?;
/// assert_eq!((re[0], im[0]), (1.0, 0.0));
/// # Ok::<(), mechaudit_solvers::faddeeva::LengthMismatch>(())
/// ```
pub fn faddeeva_soa(
    x: &[f64],
    y: &[f64],
    re: &mut [f64],
    im: &mut [f64],
) -> Result<(), LengthMismatch> {
    same_length(x.len(), [y.len(), re.len(), im.len()])?;
    all(&mut Apart { x, y, re, im });
    Ok(())
}

/// Which formula [`faddeeva`] uses at `z`, and with how many terms.
///
/// In the lower half-plane this is the formula for the mirror image `z̄`, unless the branch says
/// otherwise; whether the terms cancel and are computed again is known only then.
///
/// ```
/// use mechaudit_solvers::faddeeva::{Branch, branch};
/// use num_complex::Complex;
///
/// assert_eq!(branch(Complex::new(3.0, 9.0)), Branch::Asymptotic { terms: 26 });
/// ```
pub fn branch(z: Complex<f64>) -> Branch {
    let (a, y) = (z.re.abs(), z.im);
    if y < 0.0
        && let Some(k) = rows::nearest_zero(a, -y)
    {
        return Branch::Zero {
            zero: k as u32 + 1,
            terms: 21,
        };
    }
    match formula_at(a, y) {
        CELL | MACLAURIN_21 if a == 0.0 && y >= 0.0 => IMAGINARY_AXIS,
        formula => formula,
    }
}

#[cfg(test)]
mod tests;
