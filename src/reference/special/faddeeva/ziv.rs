//! Ziv's loop, which raises the working precision until a value is decided.

use super::scaled::Scaled;
use crate::{ComplexBall, Undecided};

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
