//! The choice of the series for an argument, after reduction by symmetry.

use super::argument::{Argument, Real};
use super::fast;
use super::general::{general, mirrored};
use super::pair::Member;
use super::scaled::Scaled;

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
