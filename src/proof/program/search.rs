//! Branch and bound over the domain.

use super::bound::{Bounds, widest};
use super::{Measure, Program};
use crate::certificate::Watch;
use crate::interval::Interval;
use std::cmp::Ordering;
use std::collections::{BinaryHeap, VecDeque};
use std::sync::atomic::Ordering as Access;

/// When a proof ends.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// The most boxes that are looked at.
    pub boxes: u64,
    /// Cutting ends where the bound is at most this; zero for the best that the limit allows.
    pub target: f64,
}

/// A box with the bound over it.
#[derive(Clone, Debug)]
pub struct ProvedBox {
    /// The ends of every input, both included.
    pub at: Vec<Interval>,
    /// The bound in the measure of the proof; infinite where nothing is proved.
    pub bound: f64,
    /// The first input that a cut would halve.
    cut: usize,
    /// Why nothing is proved.
    pub why: Option<&'static str>,
}

impl PartialEq for ProvedBox {
    fn eq(&self, other: &ProvedBox) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for ProvedBox {}
impl PartialOrd for ProvedBox {
    fn partial_cmp(&self, other: &ProvedBox) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for ProvedBox {
    fn cmp(&self, other: &ProvedBox) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// A bound over a domain.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The bound: no input of the domain has a larger error. Infinite where none is proved.
    pub bound: f64,
    /// The box where it is attained; none of a domain without inputs that the condition admits.
    pub at: Option<ProvedBox>,
    /// The largest of the sums at single points: no further cutting brings the bound below it.
    pub floor: f64,
    /// All boxes, which cover what the condition admits of the domain.
    pub boxes: Vec<ProvedBox>,
    /// The number of boxes that were looked at.
    pub looked_at: u64,
    /// True if the limit ended it.
    pub limited: bool,
}

impl Proof {
    /// Returns the bound, if one is proved.
    pub fn proved(&self) -> Option<f64> {
        Some(self.bound).filter(|bound| bound.is_finite())
    }
}

/// How near the bound comes to its floor before cutting ends.
const NEAR: f64 = 1.0 + 1.0 / 1024.0;

/// The number between two others at which a box is cut.
fn middle(x: Interval, measure: Measure) -> f64 {
    let by_size = measure != Measure::Absolute && x.mignitude() > 0.0;
    if by_size && x.magnitude() / x.mignitude() > 16.0 {
        let middle = x.mignitude().sqrt() * x.magnitude().sqrt();
        return if x.lo > 0.0 { middle } else { -middle };
    }
    x.lo / 2.0 + x.hi / 2.0
}

/// Two parts of a box. Inputs that are not rounded are numbers of the format: none lies between the
/// parts.
fn halves(
    program: &Program,
    at: &[Interval],
    cut: usize,
    measure: Measure,
) -> Option<[Vec<Interval>; 2]> {
    let k = [cut].into_iter().chain(0..at.len());
    let k = k
        .into_iter()
        .find(|k| at.get(*k).is_some_and(|x| !x.is_point()))?;
    let x = at[k];
    let next = |m: f64| match program.setting {
        s if s.round_inputs => m,
        s if s.is_single() => f64::from((m as f32).next_up()),
        _ => m.next_up(),
    };
    let mut m = middle(x, measure);
    if program.setting.is_single() {
        m = f64::from(m as f32);
    }
    let mut m = m.clamp(x.lo, x.hi);
    if m == x.hi {
        m = x.lo;
    }
    // Conditions change at numbers such as zero: these begin the upper part where there is room.
    let (low, high) = match program.setting.round_inputs {
        true if m == x.lo => return None,
        true => (m, m),
        false => {
            let before = match program.setting.is_single() {
                true => f64::from((m as f32).next_down()),
                false => m.next_down(),
            };
            if before >= x.lo {
                (before, m)
            } else {
                (m, next(m))
            }
        }
    };
    let mut parts = [at.to_vec(), at.to_vec()];
    parts[0][k] = Interval::new(x.lo, low);
    parts[1][k] = Interval::new(high.min(x.hi), x.hi);
    Some(parts)
}

/// Parts of the domain that are proved apart, that number where there are enough numbers: each the
/// half of one that was the first to be cut.
pub fn parts(program: &Program, many: usize) -> Vec<Vec<Interval>> {
    let mut whole = Vec::new();
    let mut left = VecDeque::from([program.domain.clone()]);
    while whole.len() + left.len() < many
        && let Some(at) = left.pop_front()
    {
        let cut = widest(program, &at);
        match halves(program, &at, cut, Measure::Absolute) {
            Some(halves) => left.extend(halves),
            None => whole.push(at),
        }
    }
    whole.extend(left);
    whole
}

/// Proves a bound over the domain; nothing if it was stopped.
pub fn prove(program: &Program, measure: Measure, limits: &Limits, watch: &Watch) -> Option<Proof> {
    let mut bounds = Bounds::new(program, measure);
    let mut heap: BinaryHeap<ProvedBox> = BinaryHeap::new();
    let mut whole: Vec<ProvedBox> = Vec::new();
    let mut floor = 0.0f64;
    let mut signs = [false; 2];
    let mut looked_at = 0;
    watch.done.store(0, Access::Relaxed);
    watch.of.store(limits.boxes, Access::Relaxed);
    let mut look = |at: Vec<Interval>, heap: &mut BinaryHeap<ProvedBox>, floor: &mut f64| {
        looked_at += 1;
        watch.done.store(looked_at, Access::Relaxed);
        if !bounds.is_admitted(&at) {
            return looked_at;
        }
        let found = bounds.on(&at);
        if found.lower.is_finite() {
            *floor = floor.max(found.lower);
        }
        if program.condition.is_none() {
            signs[0] |= found.sign > 0.0;
            signs[1] |= found.sign < 0.0;
        }
        heap.push(ProvedBox {
            at,
            bound: found.bound,
            cut: found.cut,
            why: found.why,
        });
        // A value of both signs is zero somewhere, or jumps.
        match signs == [true; 2] && measure != Measure::Absolute {
            true => u64::MAX,
            false => looked_at,
        }
    };
    let mut count = look(program.domain.clone(), &mut heap, &mut floor);
    let mut limited = false;
    while let Some(top) = heap.pop() {
        if watch.is_stopped() {
            return None;
        }
        let near = top.bound <= floor * NEAR || top.bound <= limits.target;
        limited = !near && count >= limits.boxes;
        if near || limited || is_hopeless(program, &top) {
            heap.push(top);
            break;
        }
        match halves(program, &top.at, top.cut, measure) {
            None => {
                whole.push(top);
                // A point: nothing is gained by cutting others.
                if heap.peek().is_none_or(|next| Some(next) <= whole.last()) {
                    break;
                }
            }
            Some(parts) => {
                for part in parts {
                    count = look(part, &mut heap, &mut floor);
                }
            }
        }
    }
    whole.extend(heap);
    let at = whole.iter().max().cloned();
    Some(Proof {
        bound: at.as_ref().map_or(0.0, |b| b.bound),
        at,
        floor,
        boxes: whole,
        looked_at: match count {
            u64::MAX => watch.done.load(Access::Relaxed),
            count => count,
        },
        limited,
    })
}

/// A box without a bound that is already tiny beside the domain.
fn is_hopeless(program: &Program, of: &ProvedBox) -> bool {
    let tiny = |k: usize| {
        let (here, all) = (of.at[k], program.domain[k]);
        (here.hi / 2.0 - here.lo / 2.0) <= (all.hi / 2.0 - all.lo / 2.0) * 1e-15
    };
    // A condition may leave out the only number without a bound.
    program.condition.is_none() && of.bound == f64::INFINITY && (0..of.at.len()).all(tiny)
}
