//! How close a zero of w comes to an `f64`: `|w(z)| > 2⁻¹⁴⁰ M` at every `f64` point below the axis
//! with `|z| ≥ 1`, M as in [`super::again`]. For numbers of 106 bits this is decided by
//! enumeration.
//!
//! Let `z = a − ib`, `ζ = z² = D − iP`, `F = 2e^{−z²}/w(−z)`, so that `|w| = W|F − 1|`. For
//! `r² ≥ 126`, `0.55 ≤ rW ≤ 0.58`; where F is not within 2⁻¹³⁰ of one, `|w| ≥ 2⁻¹³² M`. Otherwise
//! `D = ln(2/W)` up to 2⁻¹²⁹, so that `3.6 < D`, and, with `w(−z) = −i A(ζ)/(√π z)`, for a whole m
//!
//! ```text
//! ζ = G(ζ) − 2πim + ε,   G = ln(2√π) + iπ/2 + ½ Ln ζ − Ln A,   |ε| < 2⁻¹²⁹
//! ```
//!
//! `A = 1 + 1/(2ζ) + …` is the asymptotic series, with the remainder `√(e(N + 3/2)) T_N/T_0` of the
//! closed quadrant. From w′ follows `dG/dζ = 1 − 1/A`, at most `1.4/|ζ|` for `|ζ| ≥ 50`.
//!
//! * **`r² ≤ 126`** ([`boxes`]): squares with a lower bound of |w|, and around the zeros in it,
//!   where w is nearly `(2i/√π)(z − z_k)`, the distance of the zero from the `f64` next to it.
//! * **`b < 2¹³`**: every m from 20 on. On `Im ζ < −50` the map `ζ ↦ G − 2πim` is a contraction of
//!   that half-plane into itself, by 0.03, for each complex m with `Re m ≥ 15`: what solves the
//!   equation is within `(|ρ| + |ε|)/0.97` of a point of residual ρ, and is an analytic function of
//!   m, `|z|² ≤ 8m₀ + 13` for `|m − m₀| ≤ m₀/4`. b in units of its last place may not be whole.
//! * **`b ≥ 2¹³`**: every pair of a binade `2^k ≤ b < 2^{k+1}` and `j = (a − b)/δ`, `δ = 2^{k−52}`,
//!   of which a and b are multiples. With the whole number `S = (a + b)/δ` it is `D = jSδ²`,
//!   `P = δ²(S² − j²)/2`, and the real part of the equation, `D = Re G(D − iP)`, determines S: as
//!   functions of D, `Re G = Ln D + const` up to terms of the order `1/(PD)`, a contraction by less
//!   than 0.2 where `D ≥ 10`. For complex j within a quarter of `j₀`, and `|D − D₀| ≤ 1`, it maps
//!   that disc into itself (`Ln(D/D₀)` is at most 0.11, `Ln(j/j₀)` 0.29), so that S is an analytic
//!   function of j, below 2⁵⁶. S may not be whole. From `k = 28` on `a − b` would be less than one
//!   unit.
//!
//! Both are tests whether a smooth function of a whole number comes close to a whole number
//! ([`smooth`]).

mod boxes;
mod curve;
mod smooth;

use crate::ProofError;
use crate::certificate::Watch;
use crate::interval::{down, up};
use smooth::Smooth;
use std::f64::consts::{SQRT_2, TAU};

/// The binary exponent of the part of M.
pub(super) const APART: i32 = -140;
/// The first m, and the binary exponent of the b from which there are lines.
const FIRST: u64 = 20;
const LINES: i32 = 13;

/// Describes what was enumerated.
#[derive(Clone, Copy, Debug, Default)]
pub struct Apart {
    /// Squares next to the origin.
    pub boxes: usize,
    /// Zeros.
    pub zeros: u64,
    /// Lines `a − b = const`.
    pub lines: u64,
}

/// The lines that meet a binade.
fn lines(k: i32) -> [u64; 2] {
    let d = |r: f64| (3.5449 * r).ln();
    let b = f64::from(k).exp2();
    let unit = f64::from(2 * k - 104).exp2();
    let least = d(SQRT_2 * b) * (1.0 - 1e-6) / (1.0001 * 54f64.exp2() * unit);
    let most = d(2.0001 * SQRT_2 * b) * (1.0 + 1e-6) / (53f64.exp2() * unit);
    [(least.floor() as u64).max(1), most.floor() as u64]
}

/// m up to which zeros have b below a power of two: `P ≤ 2b² + D`, `0 < Im G < 1`.
fn last(b: f64) -> u64 {
    ((2.0 * b * b + 14.0) / TAU) as u64 + 1
}

/// The exponent of 1 in units of the last place of b, or of half of them.
fn last_place(b: f64) -> i32 {
    52 - crate::grid::exponent(down(b * 0.999))
}

/// Above |b| within a quarter of m of zero m: `|ζ| ≤ 8m + 13` there.
fn most_of_b(m: u64) -> f64 {
    up((8.0 * m as f64 + 13.0).sqrt())
}

impl Apart {
    /// Enumerates all, or what is below `within` in `Im z`; `None` if it was stopped.
    ///
    /// # Errors
    /// Where a zero may be too close.
    pub fn all(within: Option<f64>, watch: &Watch) -> Result<Option<Apart>, ProofError> {
        let boxes = boxes::all()?;
        let [first, last] = of_zeros(within);
        let Some(zeros) = ZEROS.stays_off(first, last, watch)? else {
            return Ok(None);
        };
        let lines = count_lines(&binades(within), watch)?;
        Ok(lines.map(|lines| Apart {
            boxes,
            zeros,
            lines,
        }))
    }
}

/// The first and the last zero of those with b below a limit.
fn of_zeros(within: Option<f64>) -> [u64; 2] {
    let begin = f64::from(LINES).exp2();
    [FIRST, last(within.map_or(begin, |w| w.min(begin)))]
}

/// The binades of b below a limit that have lines, with them.
fn binades(within: Option<f64>) -> Vec<(i32, [u64; 2])> {
    let all = (LINES..).map(|k| (k, lines(k)));
    let some = all.take_while(|(_, [_, last])| *last > 0);
    some.filter(|(k, _)| !within.is_some_and(|w| f64::from(*k).exp2() >= w))
        .collect()
}

/// The number of lines that these binades have, none of them with a whole S; `None` if it was
/// stopped.
fn count_lines(binades: &[(i32, [u64; 2])], watch: &Watch) -> Result<Option<u64>, ProofError> {
    let mut lines = 0;
    for &(k, [first, last]) in binades {
        let value = |j, bits| curve::line(k, j, bits);
        let Some(n) = on_lines(&value).stays_off(first, last, watch)? else {
            return Ok(None);
        };
        lines += n;
    }
    Ok(Some(lines))
}

/// b at the zeros.
static ZEROS: Smooth = Smooth {
    value: &curve::zero,
    shift: &last_place,
    most: &most_of_b,
    few: true,
};

/// S on the lines of a binade.
fn on_lines(value: smooth::Value<'_>) -> Smooth<'_> {
    Smooth {
        value,
        shift: &|_| 0,
        most: &|_| 56f64.exp2(),
        few: false,
    }
}

#[cfg(test)]
mod tests;
