//! w, decided: by the fast evaluation where it serves, else by Ziv's loop.

use super::argument::{Argument, Real, length};
use super::fast;
use super::general::general;
use super::pair::Member;
use super::scaled::Scaled;
use super::ziv::{balls, decide};
use crate::{ComplexBall, Undecided};

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
