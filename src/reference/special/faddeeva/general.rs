//! The choice of the series for an argument, whatever the precision.

use super::argument::{Argument, Member, Real};
use super::scaled::Scaled;
use super::{asymptotic, kummer};

/// Returns one evaluation for `z.x ≥ 0`. `None` where |z|² is beyond 10^8 and the asymptotic series
/// does not reach the precision.
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

/// One evaluation of w anywhere.
pub(super) fn once(x: Real, y: Real, prec: u32) -> Option<[Scaled; 2]> {
    mirrored(x, y, |z| general(z, Member::W, prec))
}

/// Evaluates w anywhere by `at`, which does so for `z.x ≥ 0`; `w(−conj z) = conj w(z)`.
pub(super) fn mirrored(
    x: Real,
    y: Real,
    at: impl FnOnce(&Argument) -> Option<[Scaled; 2]>,
) -> Option<[Scaled; 2]> {
    let mirrored = x.is_negative();
    let z = Argument::new(if mirrored { x.negated() } else { x }, y);
    let [re, im] = at(&z)?;
    Some(if mirrored { [re, -im] } else { [re, im] })
}
