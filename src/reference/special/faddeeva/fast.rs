//! W to about 100 bits, quickly: Taylor series in 128-bit fixed point for |Re z|, |Im z|
//! below 9.74, and the asymptotic series beyond.
//!
//! Whoever asks for more bits than come out, or for a component that loses too many, gets the
//! general evaluation: this file only ever answers with proven balls or not at all. [`parts`] also
//! has `D = w − e^{−z²}` in the first quadrant.
//!
//! # Cells
//! The centres are the points of the closed first quadrant with coordinates that are multiples of
//! 1/2; z, moved to the quadrant by the symmetries, belongs to the nearest one, and both
//! coordinates of δ = z − centre are at most 1/4, |δ| ≤ 2^-1.5. From
//! `w(z) = (2/√π) ∫_0^∞ e^{−t² + 2izt} dt`,
//!
//! ```text
//! |w^{(n)}(z)/n!| ≤ (2/√π) 2^n/n! ∫ t^n e^{−t²} dt = 2^n Γ((n+1)/2)/(√π n!)
//!               = 1/Γ(n/2 + 1),  Im z ≥ 0
//! ```
//!
//! and the same for `D = w − e^{−z²} = (2i/√π) F` on the real axis, since
//! `(2/√π) F(x) = Im w(x) = (2/√π) ∫ e^{−t²} sin 2xt dt`. With N = 40 terms the tail is below
//! `2 · 2^-60/Γ(21) < 2^-120`. The coefficients come from [`super::taylor`], rounded to units of
//! 2^-122 with an error of at most one unit.
//!
//! * Centre off the axes: complex Horner scheme for w.
//! * On the imaginary axis: `w(z) = erfcx(y − ix)`, whose coefficients are real, by the recurrence
//!   of [`super::fixed`]; Im w comes out as −x times a number.
//! * On the real axis: the same for D, whose real part comes out as −y times a number, and
//!   `w = D + e^{−z²}` with the exponential by MPFR.
//! * At the origin: D as z times a series in z², so that both components keep their relative
//!   accuracy.
//!
//! Below the axis `w(x − iy) = 2e^{−z²} − conj w(x + iy)`.
//!
//! # Rounding, in units of 2^-122
//! A product is wrong by at most 3 units (`mul`), a coordinate of δ by one (truncated), a
//! coefficient by one. Sums and partial sums are below 2 in modulus, S below 3 (from the bound
//! above).
//!
//! * Complex Horner: the modulus of the error obeys `E' ≤ 2^-1.5 E + √2 (6 + 4 + 1)`, so `E ≤ 25`.
//! * Real coefficients, δ = s + iv, |s|, |v| ≤ 1/4, v² wrong by 4:
//!   `E' ≤ E/4 + F/16 + 6 + 2 + 12 + 1`, `F' ≤ E + F/4 + 3 + 3`, so `E ≤ 33`, `F ≤ 52`.
//! * In z²: |p| ≤ 1/16, q² ≤ 1/64, p wrong by 8 and q² by 16: `E' ≤ E/16 + F/64 + 6 + 16 + 48 + 1`,
//!   `F' ≤ E + F/16 + 3 + 24`, so `E ≤ 80`, `F ≤ 115`; the final `P ± 2a²S` adds
//!   `F/8 + 2 (3 + 12)`.
//! * Tails: below 4 units in P; in S at most `Σ_{n≥40} n 2^{−1.5(n−1)}/Γ(n/2+1)`, below 240 units.
//!
//! Everything is below 2^9 units.

mod cells;
mod coordinate;
mod far;
mod fixed_point;
mod gaussian;
mod part;
mod series;

use super::argument::{Member, Real};
use crate::{Ball, ComplexBall};
use cells::{Cell, SIDE, cell};
use coordinate::Coordinate;
use far::{Wanted, far};
use fixed_point::{complex_series, mul, real_series};
use gaussian::gaussian;
use part::Part;

/// Bits that can be hoped for.
pub(super) const MOST_BITS: u32 = 104;
/// Beyond the cells, 1/100 less than where the nearest centre is none of theirs.
const LIMIT: f64 = SIDE as f64 / 2.0 - 0.26;
const _: () = assert!(2.0 * LIMIT < SIDE as f64 - 0.5);

/// An enclosure of w(x + iy), or of D with y not negative, x being taken without its sign: of a
/// relative radius of about 2^-bits if no component is much smaller than what it is the difference
/// of.
pub(super) fn parts(x: &Real, y: &Real, member: Member, bits: u32) -> Option<ComplexBall> {
    let (a, h) = (Coordinate::new(x)?, Coordinate::new(y)?);
    let wanted = match (member, y.is_negative()) {
        (Member::W, false) => Wanted::Upper,
        (Member::W, true) => Wanted::Lower,
        (Member::Dawson, false) => Wanted::Dawson,
        (Member::Dawson, true) => return None,
    };
    match a.double < LIMIT && h.double < LIMIT {
        true => near(&a, &h, wanted),
        false => far(&a, &h, wanted, bits),
    }
}

/// w(x + iy) with components of at least `bits` bits, or nothing.
pub(super) fn w(x: &Real, y: &Real, bits: u32) -> Option<ComplexBall> {
    let w = parts(x, y, Member::W, bits)?;
    let enough = |b: &Ball| b.is_zero() || b.accuracy_bits() >= i64::from(bits);
    if !(enough(&w.re) && enough(&w.im)) {
        return None;
    }
    Some(if x.is_negative() {
        ComplexBall::new(w.re, -w.im)
    } else {
        w
    })
}

/// The cells.
fn near(a: &Coordinate, h: &Coordinate, wanted: Wanted) -> Option<ComplexBall> {
    let (i, j) = (a.centre(), h.centre());
    let (fs, fv) = (a.offset()?, h.offset()?);
    let (re, im) = match (cell(i as usize, j as usize)?, i == 0.0, j == 0.0) {
        (Cell::Real(c), true, true) => {
            // D = i z Σ d_{2k+1} z^{2k}, z² = p + iq: Re D = −h (P + 2a²S), Im D = a (P − 2h²S).
            let (aa, hh) = (mul(fs, fs), mul(fv, fv));
            let odd = c.iter().skip(1).step_by(2);
            let (p, q) = real_series(odd, aa - hh, 4 * mul(aa, hh));
            let re = Part::sum(-(p + 2 * mul(aa, q)), &h.value);
            (re, Part::sum(p - 2 * mul(hh, q), &a.value))
        }
        (Cell::Real(c), _, true) => {
            let (p, q) = real_series(c.iter(), fs, mul(fv, fv));
            (Part::sum(-q, &h.value), Part::plain(p))
        }
        (Cell::Real(c), ..) => {
            // erfcx at h − ia: the real shift is v, the imaginary one −a.
            let (p, q) = real_series(c.iter(), fv, mul(fs, fs));
            (Part::plain(p), Part::sum(-q, &a.value))
        }
        (Cell::Complex(c), ..) => {
            let (p, q) = complex_series(c, fs, fv);
            (Part::plain(p), Part::plain(q))
        }
    };
    // The stored function: D in the cells on the real axis, else w.
    let dawson = j == 0.0;
    if (wanted == Wanted::Dawson) == dawson && wanted != Wanted::Lower {
        return Some(ComplexBall::new(re.ball(), im.ball()));
    }
    let (c, s, slack) = gaussian(a, h)?;
    // Above, w = D + E with E = c − is. Below, w = 2E − conj of that, E at a − ih being c + is.
    let (re, im) = match (wanted, dawson) {
        (Wanted::Upper, _) => (re.plus(&c, 1, slack), im.plus(&s, -1, slack)),
        (Wanted::Dawson, _) => (re.plus(&c, -1, slack), im.plus(&s, 1, slack)),
        (Wanted::Lower, true) => (re.negated().plus(&c, 1, slack), im.plus(&s, 1, slack)),
        (Wanted::Lower, false) => (re.negated().plus(&c, 2, slack), im.plus(&s, 2, slack)),
    };
    Some(ComplexBall::new(re.ball(), im.ball()))
}

#[cfg(test)]
mod tests;
