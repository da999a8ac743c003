//! The choice of the series for an argument, after reduction by symmetry.

use super::argument::{Argument, Real};
use super::pair::Member;
use super::scaled::Scaled;
use super::{asymptotic, fast, kummer};

/// One evaluation for `z.x ≥ 0`, quick where that may do. `None` where |z|² is beyond 10^8 and the asymptotic
/// series does not reach the precision.
pub(super) fn at(z: &Argument, member: Member, prec: u32) -> Option<[Scaled; 2]> {
    if prec <= fast::MOST_BITS
        && let Some(value) = fast::parts(&z.x, &z.y, member, prec)
    {
        return Some([value.re, value.im].map(Scaled::from));
    }
    general(z, member, prec)
}

/// [`at`], never quick.
pub(super) fn general(z: &Argument, member: Member, prec: u32) -> Option<[Scaled; 2]> {
    if let Some(parts) = asymptotic::parts(z, member, prec) {
        return Some(parts);
    }
    if !(z.norm_f64() < 1e8) {
        return None;
    }
    let value = kummer::parts(z, member, prec);
    Some([value.re, value.im].map(Scaled::from))
}

/// One evaluation of w anywhere; `w(−conj z) = conj w(z)`.
pub(super) fn once(x: Real, y: Real, prec: u32) -> Option<[Scaled; 2]> {
    let mirrored = x.is_negative();
    let z = Argument::new(if mirrored { x.negated() } else { x }, y);
    let [re, im] = at(&z, Member::W, prec)?;
    Some(if mirrored { [re, -im] } else { [re, im] })
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
