//! The quadrant `1 ≤ |z|`, `|z|² ≤ 126` below the axis.
//!
//! Around a zero `w′ = −2zw + 2i/√π` gives `|w| ≤ 1.13|δ| e^{2R|δ|}` and
//! `|w − (2i/√π)δ| ≤ 1.13 R|δ|² e^{2R|δ|}`, so that `|w| ≥ 0.9|δ|` where `8R|δ| ≤ 1`.

use super::super::reflection::{decay, exponential, least_of_w};
use crate::ProofError;
use crate::cover::Rectangle;
use crate::interval::{hypot_down, hypot_up, up};
use mechaudit_reference::{Ball, ComplexBall, Mag, faddeeva};

/// Above `√126`.
const REACH: f64 = 11.25;
/// `8R|δ| ≤ 1` so near to a zero, R the largest |z| there.
const NEAR: f64 = 0.0108;
const _: () = assert!(8.0 * (REACH + 2.0 * NEAR) * NEAR <= 1.0);
/// More zeros than there are: `|z_22|² > 130`.
const ZEROS: u32 = 22;
const DEPTH: u32 = 40;

/// Returns whether a component of a zero is 2⁻¹⁰⁰ or more off every `f64`.
fn is_off(z: &ComplexBall) -> bool {
    [&z.re, &z.im].into_iter().any(|x| {
        let nearest = x.mid().to_f64();
        (x - &Ball::exact(64, nearest)).mignitude() > Mag::power_of_two(-100)
    })
}

/// Returns whether the rectangle is within `1/(8R)` of one of the zeros.
fn is_beside(at: &Rectangle, zeros: &[(f64, f64)]) -> bool {
    zeros.iter().any(|&(x, y)| {
        let far = |[lo, hi]: [f64; 2], c: f64| up(hi - c).abs().max(up(c - lo).abs());
        up(hypot_up(far(at.a, x), far(at.b, y)) + 1e-12) < NEAR
    })
}

/// Returns whether `2|e^{−z²}|` is larger than `|w(−z)| ≤ 1` all over the rectangle, with room to
/// spare.
fn is_large(at: &Rectangle) -> bool {
    let d = decay(at);
    exponential([d.lo, d.hi])[0] > 3.0
}

fn count(at: Rectangle, depth: u32, zeros: &[(f64, f64)]) -> Result<usize, ProofError> {
    let far = hypot_up(at.a[1], at.b[1]);
    let near = hypot_down(at.a[0], at.b[0]);
    if far < 1.0 || near > REACH {
        return Ok(0);
    }
    if is_large(&at) || least_of_w(&at) > 1e-9 || is_beside(&at, zeros) {
        return Ok(1);
    }
    if depth == DEPTH {
        return Err(ProofError::Fails(format!("w may be zero in {at:?}")));
    }
    let middle = |[lo, hi]: [f64; 2]| lo + 0.5 * (hi - lo);
    let mut parts = [at, at];
    match at.a[1] - at.a[0] >= at.b[1] - at.b[0] {
        true => (parts[0].a[1], parts[1].a[0]) = (middle(at.a), middle(at.a)),
        false => (parts[0].b[1], parts[1].b[0]) = (middle(at.b), middle(at.b)),
    }
    Ok(count(parts[0], depth + 1, zeros)? + count(parts[1], depth + 1, zeros)?)
}

/// The number of squares that prove it.
///
/// # Errors
/// Where it is open.
pub(super) fn all() -> Result<usize, ProofError> {
    let zeros: Result<Vec<ComplexBall>, ProofError> = (1..=ZEROS)
        .map(|k| faddeeva::zero(k, 160).map_err(ProofError::from))
        .collect();
    count(WHOLE, 0, &places(&zeros?)?)
}

const WHOLE: Rectangle = Rectangle {
    a: [0.0, REACH],
    b: [0.0, REACH],
};

/// Zeros as `Re z` and `−Im z`.
///
/// # Errors
/// If one is next to an `f64`.
fn places(zeros: &[ComplexBall]) -> Result<Vec<(f64, f64)>, ProofError> {
    let at = |x: &Ball| x.mid().to_f64();
    let place = |z: &ComplexBall| match is_off(z) {
        true => Ok((at(&z.re), -at(&z.im))),
        false => Err(ProofError::Fails(format!("a zero next to an f64: {z:?}"))),
    };
    zeros.iter().map(place).collect()
}

#[cfg(test)]
mod tests;
