//! Jumps of a code whose formulas are not known, a program's for one: looked for where its error
//! changes most.
//!
//! On a segment the error of Re w, relative to the certified value, is taken at equal distances;
//! the pair of neighbours that differ most is divided in the same way, until its ends are
//! neighbours among the floats. A smooth error has gone by then. What is left is a jump if it is
//! far above the changes among the floats on either side of it, which are rounding.

use super::code::Code;
use super::rounded;
use super::seams::{Jump, LEAST, rises};
use crate::audit::{Draw, SolverAnswer};
use crate::reference::faddeeva::w_f64;
use rayon::prelude::*;

/// Segments, half of them level; parts of a segment.
const SEGMENTS: u64 = 48;
const PARTS: usize = 64;
/// Divisions; 64¹² is beyond the floats of a segment.
const ROUNDS: usize = 12;
/// Floats on either side of a jump whose errors tell the rounding, and how far above it a jump is.
const BESIDE: usize = 16;
const ABOVE: f64 = 4.0;
/// Bits of certified values.
const BITS: u32 = 70;
/// A few units in which a sum as large as w is rounded.
const QUANTA: f64 = 16.0 * f64::EPSILON;

/// A segment along Re z or Im z, its ends and what is found there.
struct Segment {
    level: bool,
    other: f64,
    ends: [f64; 2],
}

impl Segment {
    fn drawn(seed: u64, k: u64) -> Segment {
        let mut d = Draw::new(seed, "atlas", "breaks", k);
        let level = k.is_multiple_of(2);
        let (other, ends) = match level {
            true => (d.log_uniform(1e-12, 30.0), [0.01, 40.0]),
            false => (d.uniform(0.0, 20.0), [1e-12, 40.0]),
        };
        Segment { level, other, ends }
    }

    fn place(&self, s: f64) -> [f64; 2] {
        match self.level {
            true => [s, self.other],
            false => [self.other, s],
        }
    }

    /// The floats before the first end and those after the second.
    fn beside(&self) -> Vec<Vec<f64>> {
        let [a, b] = self.ends;
        let before = std::iter::successors(Some(a), |s| Some(s.next_down()));
        let after = std::iter::successors(Some(b), |s| Some(s.next_up()));
        let all = before.take(BESIDE).chain(after.take(BESIDE));
        all.map(|s| self.place(s).to_vec()).collect()
    }

    fn points(&self) -> Vec<Vec<f64>> {
        let [a, b] = self.ends;
        // By ratios where they are large, as upright segments are at first.
        let wide = b > 4.0 * a;
        (0..=PARTS)
            .map(|i| {
                let t = i as f64 / PARTS as f64;
                let s = match (i, wide) {
                    (0, _) => a,
                    (PARTS, _) => b,
                    (_, true) => a * libm::exp(t * libm::log(b / a)),
                    (_, false) => a + (b - a) * t,
                };
                self.place(s).to_vec()
            })
            .collect()
    }
}

/// The largest difference of errors on one side; infinite where one is missing.
fn rounding(nearby: &[Option<f64>]) -> f64 {
    let side = |errors: &[Option<f64>]| {
        let known: Option<Vec<f64>> = errors.iter().copied().collect();
        known.map_or(f64::INFINITY, |e| {
            let most = e.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            most - e.iter().copied().fold(f64::INFINITY, f64::min)
        })
    };
    side(&nearby[..BESIDE]).max(side(&nearby[BESIDE..]))
}

/// Re w and |w|, of the upper half-plane.
fn due([x, y]: [f64; 2]) -> Option<[f64; 2]> {
    let w = w_f64(x, y, BITS).ok()?;
    let [re, im] = [w.re, w.im].map(|part| part.mid().to_f64());
    Some([re, re.hypot(im)])
}

/// The largest jump of Re w that was found, if any is above rounding.
pub fn breaks(code: &Code, seed: u64) -> Vec<Jump> {
    on(code, segments(seed))
}

fn segments(seed: u64) -> Vec<Segment> {
    (0..SEGMENTS).map(|k| Segment::drawn(seed, k)).collect()
}

fn on(code: &Code, mut segments: Vec<Segment>) -> Vec<Jump> {
    let mut last: Vec<[f64; 2]> = Vec::new();
    for _ in 0..ROUNDS {
        let points: Vec<Vec<f64>> = segments.iter().flat_map(Segment::points).collect();
        let values = values(code, &points);
        let both = points.par_iter().zip(&values);
        let errors: Vec<Option<f64>> = both.map(|(z, re)| error(z, *re)).collect();
        last = Vec::new();
        for (k, segment) in segments.iter_mut().enumerate() {
            let own = k * (PARTS + 1)..(k + 1) * (PARTS + 1);
            let (errors, values) = (&errors[own.clone()], &values[own.clone()]);
            let step = |i: usize| match (errors[i], errors[i + 1]) {
                (Some(e), Some(f)) => (f - e).abs(),
                _ => 0.0,
            };
            let worst = (0..PARTS)
                .max_by(|&i, &j| step(i).total_cmp(&step(j)))
                .unwrap_or(0);
            let along = usize::from(!segment.level);
            let at = |i: usize| points[own.start + i][along];
            segment.ends = [at(worst), at(worst + 1)];
            last.push([values[worst], values[worst + 1]].map(|v| v.unwrap_or(f64::NAN)));
        }
    }
    let beside: Vec<Vec<f64>> = segments.iter().flat_map(Segment::beside).collect();
    let both = beside.iter().zip(values(code, &beside));
    let nearby: Vec<Option<f64>> = both.map(|(z, re)| error(z, re)).collect();
    let mut found: Option<Jump> = None;
    let nearby = nearby.chunks(2 * BESIDE);
    for ((segment, [inner, outer]), nearby) in segments.iter().zip(last).zip(nearby) {
        let place = segment.place(segment.ends[0]);
        let Some([due, size]) = due(place) else {
            continue;
        };
        let re = ((outer - inner) / due).abs();
        let least = LEAST + QUANTA * size / due + ABOVE * rounding(nearby);
        if !re.is_finite() || re <= least {
            continue;
        }
        let jump = found.get_or_insert_default();
        jump.crossings += u64::from(segment.level);
        jump.rising += u64::from(segment.level && rises(inner, outer, due));
        if re > jump.re {
            (jump.re, jump.at) = (re, place);
        }
    }
    if let Some(jump) = &mut found {
        jump.re = rounded(jump.re);
    }
    found.into_iter().collect()
}

fn values(code: &Code, points: &[Vec<f64>]) -> Vec<Option<f64>> {
    let answers = code.answers(points).into_iter();
    answers
        .map(|answer| match answer {
            SolverAnswer::Values(w) => w.first().copied().filter(|re| re.is_finite()),
            _ => None,
        })
        .collect()
}

/// Relative, of Re w; nothing where there is no number.
fn error(z: &[f64], re: Option<f64>) -> Option<f64> {
    let [due, _] = due([z[0], z[1]])?;
    Some((re? - due) / due)
}

#[cfg(test)]
mod tests;
