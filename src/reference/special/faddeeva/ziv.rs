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

/// The cap on the working precision for inputs of `bits` bits.
pub(super) fn cap(bits: u32, length: u32) -> u32 {
    bits.saturating_add(length)
        .saturating_mul(4)
        .saturating_add(4096)
}

/// Returns what is found first at a working precision that grows by a part of itself up to the cap.
pub(super) fn first<T>(
    mut prec: u32,
    part: u32,
    cap: u32,
    open: &str,
    once: impl Fn(u32) -> Option<T>,
) -> Result<T, Undecided> {
    loop {
        if let Some(found) = once(prec) {
            return Ok(found);
        }
        if prec == cap {
            return Err(Undecided::new(prec, open));
        }
        prec = prec.saturating_add(prec / part).min(cap);
    }
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
            return Err(Undecided::new(
                prec,
                format!("a component of {name} is zero or cannot be told from zero"),
            ));
        }
        prec = prec.saturating_add(more).min(cap);
    }
}

/// Both components of a scaled result as balls.
pub(super) fn balls(parts: [Scaled; 2], bits: u32) -> Result<ComplexBall, Undecided> {
    for (name, part) in ["real", "imaginary"].iter().zip(&parts) {
        if !part.to_ball().is_finite() {
            return Err(Undecided::new(
                bits,
                format!(
                    "the {name} part has a binary exponent of {} bits, beyond what a ball holds",
                    part.exponent.significant_bits()
                ),
            ));
        }
    }
    let [re, im] = parts;
    Ok(ComplexBall::new(re.to_ball(), im.to_ball()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ball, Mag};
    use rug::Float;
    use std::cell::RefCell;

    /// About 1.5, with `accuracy` bits; none for what is exact.
    fn part(accuracy: i64) -> Scaled {
        let rad = Mag::power_of_two(-accuracy - 1);
        let part = Ball::new(Float::with_val(64, 1.5), rad);
        assert_eq!(part.accuracy_bits(), accuracy);
        Scaled::from(part)
    }

    /// Returns what a loop asks for, and the precision at which it is undecided.
    fn asked(bits: u32, once: impl Fn(u32) -> Option<[Scaled; 2]>) -> (Vec<u32>, Option<u32>) {
        let asked = RefCell::new(Vec::new());
        let end = decide("planted", bits, 10, |prec| {
            asked.borrow_mut().push(prec);
            once(prec)
        });
        (asked.into_inner(), end.err().map(|e| e.bits))
    }

    /// Twelve bits more than are due at first; then what is missing of the worse part, and six.
    #[test]
    fn precisions_rise_by_what_is_missing() {
        for losses in [[20, 5], [5, 20], [20, 20]] {
            let once = |prec| Some(losses.map(|loss| part(i64::from(prec) - loss)));
            assert_eq!(asked(100, once), (vec![112, 126], None), "{losses:?}");
        }
        let enough = |prec| Some([12, 12].map(|loss| part(i64::from(prec) - loss)));
        assert_eq!(asked(100, enough), (vec![112], None));
        // At least two bits are due.
        assert_eq!(asked(0, enough), (vec![14], None));
        assert_eq!(asked(3, enough), (vec![15], None));
        // A part that is zero is as good as any.
        let zero = || Scaled::from(Ball::integer(64, 0));
        let beside = |prec| Some([zero(), part(i64::from(prec) - 20)]);
        assert_eq!(asked(100, beside), (vec![112, 126], None));
        assert_eq!(asked(100, |_| Some([zero(), zero()])), (vec![112], None));
    }

    /// Doubled where nothing is known, of either part or at all, up to four times bits and length
    /// and 4096.
    #[test]
    fn the_precision_has_a_cap() {
        let due = vec![112, 224, 448, 896, 1792, 3584, 4536];
        assert_eq!(asked(100, |_| None), (due.clone(), Some(4536)));
        let unknown = || Scaled::from(Ball::new(Float::with_val(64, 1.5), Mag::from_f64(2.0)));
        assert_eq!(
            asked(100, |_| Some([unknown(), part(200)])),
            (due.clone(), Some(4536))
        );
        assert_eq!(
            asked(100, |_| Some([part(200), unknown()])),
            (due.clone(), Some(4536))
        );
        let infinite = || Scaled::from(Ball::new(Float::with_val(64, 1.5), Mag::INFINITY));
        assert_eq!(
            asked(100, |_| Some([part(200), infinite()])),
            (due, Some(4536))
        );
        // A single bit is something: 99 are missing, again and again.
        let (precisions, end) = asked(100, |_| Some([part(1), part(200)]));
        assert_eq!((precisions[1], end), (112 + 105, Some(4536)));
    }
}
