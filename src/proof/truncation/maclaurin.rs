//! Maclaurin series.

use super::Truncation;
use crate::bounds::power_up;
use crate::interval::{product_up, quotient_up};

/// `Σ_{n>last} |z|ⁿ/Γ(n/2 + 1)`, last 8 or 20, `|z| ≤ r < ½`; the imaginary part divided by `Re z`.
///
/// Γ grows there, and `|Im vⁿ| ≤ n |Im v| |v|^{n−1}`, `n r^{n−1}` summed at most twice its first
/// term, because `(n + 1) r/n ≤ ½` for `r ≤ 9/20`.
pub(crate) fn maclaurin(last: u32, r: f64) -> Truncation {
    // Γ(5.5) = 945 √π/32 and Γ(11.5) = 13749310575 √π/2048, rounded down.
    let inside = r <= 0.45;
    let gamma = match last {
        8 if inside => 52.3,
        20 if inside => 1.189e7,
        // Nothing is known.
        _ => 0.0,
    };
    let first = quotient_up(power_up(r, last + 1), gamma);
    let norm = product_up(2.0, first);
    let slope = quotient_up(power_up(r, last), gamma);
    let im = product_up(2.0 * f64::from(last + 1), slope);
    Truncation {
        im,
        ..Truncation::all(norm)
    }
}

#[cfg(test)]
mod tests;
