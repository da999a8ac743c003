//! The choice of the series for an argument, after reduction by symmetry: once, or until w is
//! decided.

use super::argument::{Argument, Member, Real, length};
use super::fast;
use super::general::{general, mirrored};
use super::scaled::Scaled;
use super::ziv::{balls, decide};
use crate::{ComplexBall, Undecided};

/// One evaluation for `z.x ≥ 0`, quick where that may do. `None` where |z|² is beyond 10^8 and the
/// asymptotic series does not reach the precision.
pub(super) fn at(z: &Argument, member: Member, prec: u32) -> Option<[Scaled; 2]> {
    if prec <= fast::MOST_BITS
        && let Some(value) = fast::parts(&z.x, &z.y, member, prec)
    {
        return Some([value.re, value.im].map(Scaled::from));
    }
    general(z, member, prec)
}

/// One evaluation of w anywhere.
pub(super) fn once(x: Real, y: Real, prec: u32) -> Option<[Scaled; 2]> {
    mirrored(x, y, |z| at(z, Member::W, prec))
}

/// One evaluation of `w − e^{−z²}` anywhere, from the first quadrant: Dawson's function is odd and
/// real on the real axis.
pub(super) fn once_dawson(x: &Real, y: &Real, prec: u32) -> Option<[Scaled; 2]> {
    let (a, b) = (x.is_negative(), y.is_negative());
    let positive = |r: &Real, flip| if flip { r.negated() } else { r.clone() };
    let z = Argument::new(positive(x, a), positive(y, b));
    let [re, im] = at(&z, Member::Dawson, prec)?;
    Some([if b { -re } else { re }, if a { -im } else { im }])
}

/// w with both components decided, as balls.
pub(super) fn value(x: Real, y: Real, bits: u32) -> Result<ComplexBall, Undecided> {
    balls(scaled(x, y, bits)?, bits)
}

/// w with both components decided.
pub(super) fn scaled(x: Real, y: Real, bits: u32) -> Result<[Scaled; 2], Undecided> {
    if bits <= fast::MOST_BITS
        && let Some(w) = fast::w(&x, &y, bits)
    {
        return Ok([w.re, w.im].map(Scaled::from));
    }
    let length = length(&x, &y);
    let mirrored = x.is_negative();
    let z = Argument::new(if mirrored { x.negated() } else { x }, y);
    let [re, im] = decide("w", bits, length, |prec| general(&z, Member::W, prec))?;
    Ok(if mirrored { [re, -im] } else { [re, im] })
}
