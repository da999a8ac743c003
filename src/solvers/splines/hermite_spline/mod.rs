//! Piecewise cubic Hermite interpolants whose slopes come from a few neighbouring points: PCHIP,
//! Akima's and the modified Akima interpolant.
//!
//! With steps `h_i = x_{i+1} − x_i`, chord slopes `δ_i = (y_{i+1} − y_i)/h_i` and slopes `s_i` at
//! the knots, a segment is the cubic with the ordinates and slopes of its two ends. With
//! `k = (x − x_i)/h`, `w = 1 − k`:
//!
//! ```text
//! S    = w²(1 + 2k) y_i + k²(1 + 2w) y_{i+1} + h k w (w s_i − k s_{i+1})
//!      = y_i + h (k w² s_i + k² w (3δ_i − s_{i+1}) + k³ δ_i)
//! S'   = w² s_i + k² s_{i+1} + 2 k w (3δ_i − s_i − s_{i+1})
//! S''  = 2 (k (a + 2b) − w (2a + b)) / h         with a = s_i − δ_i, b = s_{i+1} − δ_i
//! S''' = 6 (a + b) / h²
//! ```
//!
//! `S` and `S'` are continuous; at a knot `S''` and `S'''` are those of the segment to the right,
//! at the last knot those of the last segment.
//!
//! # Slopes
//! Two points give the line, in all three.
//!
//! **PCHIP** ([`Slopes::Pchip`]; F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984)
//! 300–304; subroutine `PCHIM` of SLATEC; C. Moler, *Numerical Computing with MATLAB*, sections 3.4
//! and 3.6). At an inner knot the slope is 0 unless the two chords rise or fall both; else it is
//! the harmonic mean with the weights of Fritsch and Butland:
//!
//! ```text
//! (w_1 + w_2)/s_i = w_1/δ_{i−1} + w_2/δ_i,   w_1 = h_{i−1} + 2 h_i,   w_2 = 2 h_{i−1} + h_i
//! ```
//!
//! `w_1`, which has twice the step of the other side, belongs to `δ_{i−1}`. At the first knot the
//! slope is that of the parabola through three points,
//! `d = ((2h_0 + h_1) δ_0 − h_0 δ_1)/(h_0 + h_1)`, but 0 if the sign of `d` is not that of `δ_0`,
//! and `3δ_0` if the signs of `δ_0` and `δ_1` differ and `|d| > 3|δ_0|`; likewise at the last knot.
//! So `0 ≤ s/δ ≤ 3` at both ends of each segment, which is enough for monotonicity (F. N. Fritsch
//! and R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238–246). MATLAB's `pchip`, SLATEC's `PCHIM`
//! and scipy's `PchipInterpolator` since 0.17 have these slopes. Programs that exchange `w_1` and
//! `w_2`, take a chord's slope or an unclipped parabola at the ends, or the arithmetic mean of
//! Fritsch and Carlson 1980, give other values.
//!
//! **Akima** ([`Slopes::Akima`]; H. Akima, J. ACM 17 (1970) 589–602, eq. (1)):
//!
//! ```text
//! s_i = (|δ_{i+1} − δ_i| δ_{i−1} + |δ_{i−1} − δ_{i−2}| δ_i)
//!       / (|δ_{i+1} − δ_i| + |δ_{i−1} − δ_{i−2}|)
//! ```
//!
//! Beyond each end two more points continue the parabola through the last three (section 2.3
//! there), which extrapolates the chord slopes linearly: `δ_{−1} = 2δ_0 − δ_1`,
//! `δ_{−2} = 2δ_{−1} − δ_0`. Where both weights are 0, two straight pieces meet and the formula is
//! 0/0: the slope is `(δ_{i−1} + δ_i)/2`, by Akima's convention. The slope depends discontinuously
//! on the data there. This solver decides about the zero exactly, from the given numbers. scipy
//! takes its fallback `(δ_{i−2} + δ_{i+1})/2`, whose value is the same where both weights vanish,
//! as soon as the sum of the weights is below 10⁻⁹ of the largest anywhere in the data, which gives
//! other values beside steep parts far away. Other programs take one weight's zero for both.
//!
//! **Modified Akima** ([`Slopes::ModifiedAkima`]; MATLAB's `makima`, scipy's `method="makima"`; C.
//! Moler and C. Ionita, *Makima piecewise cubic interpolation*, 2019): the weights are
//!
//! ```text
//! |δ_{i+1} − δ_i| + |δ_{i+1} + δ_i|/2   and   |δ_{i−1} − δ_{i−2}| + |δ_{i−1} + δ_{i−2}|/2
//! ```
//!
//! and both are 0 only where all four chords are level, where the slope is 0. scipy's threshold
//! applies here too.
//!
//! # Accuracy
//! Differences of neighbouring chord slopes are computed in twice the working precision, so that
//! Akima's weights keep their relative accuracy and a slope's distance from its chords does not
//! come from a cancelling difference. Where slopes at both ends of a segment are equal, opposite or
//! three chords by definition, values and integrals do not feel the slopes' rounding. Chord slopes
//! below the normal range (2⁻¹⁰²²) have the absolute accuracy of that range only, and so has all
//! that follows from them. `mechaudit audit pchip`, `akima` and `modified-akima` search for the
//! worst inputs.

mod slopes;
mod spline;

pub use super::cubic_spline::{CubicSplineError, EvaluationError, Extrapolation, Jet};
pub use slopes::Slopes;
pub use spline::HermiteSpline;

#[cfg(test)]
mod tests;
