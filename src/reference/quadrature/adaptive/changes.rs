//! Places at which choices of an integrand change: jumps of steps, kinks of absolute values.

use super::{Budget, Panel, Path, Value, difference, exponent, finer};
use crate::{Ball, Mag};
use rug::Float;
use rug::ops::CompleteRound;

/// A change of choices between two numbers, as it is guessed from the values there.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// The share of the way from the one to the other at which the first choice changes.
    pub share: f64,
    /// True if one choice changes, once.
    pub is_single: bool,
}

/// Steps after which the value over what is left is looked at again.
const LOOK: u32 = 6;

/// Bits that a guess at the place of a change is tried to gain at first, and at most.
const GUESSED: [u32; 2] = [3, 48];

/// Returns true if a part of a panel is so short that what machine words tell apart limits it.
pub(super) fn is_close([low, high]: [&Float; 2], panel: &Panel<impl Value>) -> bool {
    const SHORTER: i32 = 60;
    let width = |a: &Float, b: &Float| exponent(&(b - a).complete(64));
    width(low, high) < width(&panel.lower, &panel.upper) - SHORTER
}

/// A number up to which choices seem to change once from a panel's lower end on; none where that is
/// not told.
fn next_change<P: Path>(
    path: &mut P,
    panel: &Panel<P::Value>,
    budget: &mut Budget,
) -> Option<Float> {
    const TRIED: u32 = 32;
    let low = &panel.first;
    let [mut before, mut after] = [low, &panel.upper].map(Float::clone);
    let mut end = after.clone();
    for _ in 0..TRIED {
        budget.spend_words(2);
        match path.crossing([low, &end]) {
            Some(crossing) if crossing.is_single => return Some(end),
            Some(_) => after.clone_from(&end),
            None if end == panel.upper => return None,
            None => before.clone_from(&end),
        }
        let bits = 64 + finer(&before, &after);
        let width = (&after - &before).complete(64);
        end = Float::with_val(bits, &before + (width >> 2u32));
        if !(before < end && end < after) {
            break;
        }
    }
    None
}

/// The parts of an interval on either side of a guess at a change, if every choice is settled on
/// both.
fn guessed<P: Path>(
    path: &mut P,
    [low, high]: [&Float; 2],
    gain: u32,
    budget: &mut Budget,
) -> Option<[Float; 2]> {
    budget.spend_words(4);
    let share = path.crossing([low, high])?.share;
    let bits = 67 + gain + finer(low, high);
    let width = (high - low).complete(bits);
    let place = Float::with_val(bits, &width * share) + low;
    let reach = width >> gain;
    let before = Float::with_val(bits, &place - &reach).max(low);
    let after = Float::with_val(bits, &place + &reach).min(high);
    let mut is_settled =
        |a: &Float, b: &Float| a == b || path.is_settled(&Ball::between(bits, a, b));
    (is_settled(low, &before) && is_settled(&after, high)).then_some([before, after])
}

/// Half of an interval or a little more or less of it, without a part on which every choice is
/// settled.
fn halved<P: Path>(
    path: &mut P,
    [low, high]: [&Float; 2],
    budget: &mut Budget,
) -> Option<[Float; 2]> {
    // A change at the middle itself leaves both halves unsettled, and enclosures that are wide settle
    // shorter parts only. Still shorter ones would close in on two changes in vain.
    for eighths in [4u32, 3, 5] {
        let bits = 67 + finer(low, high);
        let width = (high - low).complete(bits);
        let middle = Float::with_val(bits, low + ((width * eighths) >> 3u32));
        if !(*low < middle && middle < *high) {
            break;
        }
        budget.spend_words(2);
        let mut is_settled = |a: &Float, b: &Float| path.is_settled(&Ball::between(bits, a, b));
        match (is_settled(low, &middle), is_settled(&middle, high)) {
            (true, true) => return Some([middle.clone(), middle]),
            (true, false) => return Some([middle, high.clone()]),
            (false, true) => return Some([low.clone(), middle]),
            (false, false) => {}
        }
    }
    None
}

/// The part of a panel on which a choice changes: on either side of it every choice is settled. It
/// is so short that its error is small, or holds several changes; the other side ends at the third
/// number, before the next change. None where nothing is settled.
pub(super) fn unsettled<P: Path>(
    path: &mut P,
    panel: &Panel<P::Value>,
    tolerance: Mag,
    budget: &mut Budget,
) -> Option<[Float; 3]> {
    let mut low = panel.first.clone();
    let end = next_change(path, panel, budget).unwrap_or_else(|| panel.upper.clone());
    let mut high = end.clone();
    // The error of a guess is of the order of the square of the width.
    let mut gain = GUESSED[0];
    let mut step = 0;
    while budget.spent < budget.limit {
        step += 1;
        let found = match guessed(path, [&low, &high], gain, budget) {
            Some(ends) => {
                gain = (2 * gain).min(GUESSED[1]);
                Some(ends)
            }
            None if gain > GUESSED[0] => {
                gain = (gain / 2).max(GUESSED[0]);
                if gain <= 2 * GUESSED[0] && is_close([&low, &high], panel) {
                    break;
                }
                continue;
            }
            None => halved(path, [&low, &high], budget),
        };
        let Some(ends) = found else { break };
        [low, high] = ends;
        if low == high {
            break;
        }
        if step % LOOK == 0 || gain > GUESSED[1] / 2 {
            let bits = 64 + finer(&low, &high);
            // A singularity is no choice.
            let values = path.value(&Ball::between(bits, &low, &high), bits)?;
            let width = difference(&high, &low, bits);
            if values.times(&width).radius() <= tolerance {
                break;
            }
        }
    }
    (low > panel.first || high < end).then_some([low, high, end])
}
