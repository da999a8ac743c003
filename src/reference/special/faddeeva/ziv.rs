//! Choice of the series, symmetries, and the loop that raises the working precision.

use super::argument::{Argument, Real};
use super::scaled::Scaled;
use super::{asymptotic, fast, kummer};
use crate::{ComplexBall, Undecided};
use rug::Integer;

/// Which function of the pair: both come from the same series.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// `w(z)`.
    W,
    /// `w(z) − e^{−z²} = (2i/√π) F(z)`, F Dawson's function; in the first quadrant only.
    Dawson,
}

/// One evaluation for `z.x ≥ 0`. `None` where |z|² is beyond 10^8 and the asymptotic series does
/// not reach the precision.
pub(super) fn at(z: &Argument, kind: Kind, prec: u32) -> Option<[Scaled; 2]> {
    if let Some(parts) = asymptotic::parts(z, kind, prec) {
        return Some(parts);
    }
    if !(z.norm_f64() < 1e8) {
        return None;
    }
    let value = kummer::parts(z, kind, prec);
    Some([value.re, value.im].map(|b| Scaled::new(b, Integer::new())))
}

/// One evaluation of w anywhere; `w(−conj z) = conj w(z)`.
pub(super) fn once(x: Real, y: Real, prec: u32) -> Option<[Scaled; 2]> {
    let mirrored = x.is_negative();
    let z = Argument::new(if mirrored { x.negated() } else { x }, y);
    let [re, im] = at(&z, Kind::W, prec)?;
    Some(if mirrored { [re, -im] } else { [re, im] })
}

/// One evaluation of `w − e^{−z²}` anywhere, from the first quadrant: Dawson's function is odd and
/// real on the real axis.
pub(super) fn once_dawson(x: &Real, y: &Real, prec: u32) -> Option<[Scaled; 2]> {
    let (a, b) = (x.is_negative(), y.is_negative());
    let positive = |r: &Real, flip| if flip { r.negated() } else { r.clone() };
    let z = Argument::new(positive(x, a), positive(y, b));
    let [re, im] = at(&z, Kind::Dawson, prec)?;
    Some([if b { -re } else { re }, if a { -im } else { im }])
}

/// Bits that are missing from what is asked for; zero for an exact zero, `None` if nothing is
/// known.
fn missing(part: &Scaled, bits: u32) -> Option<u32> {
    if part.ball.is_zero() {
        return Some(0);
    }
    let have = part.ball.accuracy_bits();
    if !part.ball.is_finite() || have < 1 {
        return None;
    }
    u32::try_from(i64::from(bits) - have.min(i64::from(bits))).ok()
}

/// The cap on the working precision for inputs of so many bits.
pub(super) fn cap(bits: u32, length: u32) -> u32 {
    bits.saturating_add(length)
        .saturating_mul(4)
        .saturating_add(4096)
}

/// Ziv's loop: `once` at rising precision until both components have a relative radius of at most
/// 2^-bits or are exactly zero.
pub(super) fn decide(
    name: &str,
    bits: u32,
    length: u32,
    once: impl Fn(u32) -> Option<[Scaled; 2]>,
) -> Result<[Scaled; 2], Undecided> {
    let bits = bits.max(2);
    let cap = cap(bits, length);
    let mut prec = bits + 12;
    loop {
        let mut more = prec;
        if let Some(parts) = once(prec) {
            match (missing(&parts[0], bits), missing(&parts[1], bits)) {
                (Some(0), Some(0)) => return Ok(parts),
                (Some(a), Some(b)) => more = a.max(b) + 6,
                _ => {}
            }
        }
        if prec == cap {
            return Err(Undecided {
                bits: prec,
                reason: format!("a component of {name} is zero or cannot be told from zero"),
            });
        }
        prec = prec.saturating_add(more).min(cap);
    }
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
        return Ok([w.re, w.im].map(|part| Scaled::new(part, Integer::new())));
    }
    let length = x.length().saturating_add(y.length());
    let mirrored = x.is_negative();
    let z = Argument::new(if mirrored { x.negated() } else { x }, y);
    let [re, im] = decide("w", bits, length, |prec| at(&z, Kind::W, prec))?;
    Ok(if mirrored { [re, -im] } else { [re, im] })
}

/// Both components of a scaled result as balls.
pub(super) fn balls(parts: [Scaled; 2], bits: u32) -> Result<ComplexBall, Undecided> {
    for (name, part) in ["real", "imaginary"].iter().zip(&parts) {
        if !part.to_ball().is_finite() {
            return Err(Undecided {
                bits,
                reason: format!(
                    "the {name} part has a binary exponent of {} bits, beyond what a ball holds",
                    part.exponent.significant_bits()
                ),
            });
        }
    }
    let [re, im] = parts;
    Ok(ComplexBall::new(re.to_ball(), im.to_ball()))
}
