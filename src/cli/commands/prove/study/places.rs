//! Inputs at which the bound of a proof may be attained.

use mechaudit::audit::{Format, Method, SolverAnswer};
use mechaudit::proof::program::{Interval, Proof, ProvedBox};
use mechaudit::study::Study;

/// Boxes that are looked into: those with the largest bounds.
const BOXES: usize = 8;
/// Inputs up to which all corners of a box are tried: 16 corners.
const INPUTS: usize = 4;
/// Numbers on either side of a jump that are tried.
const BESIDE: i64 = 4;

/// Corners and middles of the boxes with the largest bounds, and the numbers beside the jumps of
/// the solver between their corners: where a condition is decided wrongly, a branch is wrong by a
/// jump, at a few neighbouring numbers that no random input meets.
pub fn places(study: &Study, proof: &Proof) -> Vec<Vec<f64>> {
    let mut boxes: Vec<&ProvedBox> = proof.boxes.iter().collect();
    boxes.sort();
    let mut found = Vec::new();
    let mut corners = Vec::new();
    for leaf in boxes.iter().rev().take(BOXES) {
        let n = leaf.at.len();
        let (low, high) = (end(&leaf.at, |_| false), end(&leaf.at, |_| true));
        let middle = between(&low, &high);
        found.extend(jump(study, &low, &high));
        for k in (0..n).filter(|_| n > 1) {
            let (mut from, mut to) = (middle.clone(), middle.clone());
            (from[k], to[k]) = (low[k], high[k]);
            found.extend(jump(study, &from, &to));
        }
        corners.push(middle);
        match n {
            ..=INPUTS => {
                corners.extend((0..1u32 << n).map(|s| end(&leaf.at, |k| (s >> k) & 1 == 1)))
            }
            _ => corners.extend([low, high]),
        }
    }
    found.extend(corners);
    found.retain(|x| x.iter().all(|x| x.is_finite()));
    found
}

/// A corner: the upper ends of these inputs, the lower ones of the others.
fn end(at: &[Interval], is_upper: impl Fn(usize) -> bool) -> Vec<f64> {
    let ends = at.iter().enumerate();
    ends.map(|(k, x)| if is_upper(k) { x.hi } else { x.lo })
        .collect()
}

/// The place of a number among all of them, in their order; both zeros are one.
fn place(x: f64) -> i64 {
    let size = (x.to_bits() & (u64::MAX >> 1)) as i64;
    if x.is_sign_negative() { -size } else { size }
}

/// The number at a place.
fn number(place: i64) -> f64 {
    let size = f64::from_bits(place.unsigned_abs());
    if place < 0 { -size } else { size }
}

/// The input half-way between two others, counted in numbers.
fn between(a: &[f64], b: &[f64]) -> Vec<f64> {
    let half = |(a, b): (&f64, &f64)| {
        let (a, b) = (i128::from(place(*a)), i128::from(place(*b)));
        number((a + (b - a) / 2) as i64)
    };
    a.iter().zip(b).map(half).collect()
}

/// The numbers about the largest jump of the solver between two inputs, which halving finds where
/// the jump is larger than all changes beside it; none where it changes as much elsewhere.
fn jump(study: &Study, from: &[f64], to: &[f64]) -> Vec<Vec<f64>> {
    let format = study.format();
    let value = |x: &[f64]| {
        let x: Vec<f64> = x.iter().map(|x| format.representable(*x)).collect();
        match study.solve(&x) {
            SolverAnswer::Values(values) => Some(values),
            _ => None,
        }
    };
    let change =
        |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum() };
    let (mut a, mut b) = (from.to_vec(), to.to_vec());
    let (Some(mut at_a), Some(mut at_b)) = (value(&a), value(&b)) else {
        return Vec::new();
    };
    let whole = change(&at_a, &at_b);
    loop {
        let middle = between(&a, &b);
        if middle == a || middle == b {
            break;
        }
        let Some(at_middle) = value(&middle) else {
            return Vec::new();
        };
        if change(&at_a, &at_middle) > change(&at_middle, &at_b) {
            (b, at_b) = (middle, at_middle);
        } else {
            (a, at_a) = (middle, at_middle);
        }
    }
    if !(change(&at_a, &at_b) > whole / 4.0) {
        return Vec::new();
    }
    let step = match format {
        Format::Single => 1 << 29,
        Format::Double => 1,
    };
    let beside = |j: i64| {
        let each = a.iter().zip(from.iter().zip(to));
        each.map(|(x, (from, to))| {
            let way = place(*to).cmp(&place(*from)) as i64;
            number(place(*x) + way * j * step)
        })
        .collect()
    };
    (1 - BESIDE..=BESIDE).map(beside).collect()
}
