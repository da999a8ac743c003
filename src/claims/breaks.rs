//! Jumps of a code whose formulas are not known, a program's for one: looked for where its error changes most.
//!
//! On a segment the error of Re w, relative to the certified value, is taken at equal distances; the pair of
//! neighbours that differ most is divided in the same way, until its ends are neighbours among the floats. A smooth
//! error has gone by then. What is left is a jump if it is far above the changes among the floats on either side of it,
//! which are rounding.

use super::code::Code;
use super::regions::log_uniform;
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
            true => (log_uniform(&mut d, 1e-12, 30.0), [0.01, 40.0]),
            false => (d.uniform(0.0, 20.0), [1e-12, 40.0]),
        };
        Segment { level, other, ends }
    }

    fn point(&self, s: f64) -> Vec<f64> {
        match self.level {
            true => vec![s, self.other],
            false => vec![self.other, s],
        }
    }

    /// The floats before the first end and those after the second.
    fn beside(&self) -> Vec<Vec<f64>> {
        let [a, b] = self.ends;
        let before = std::iter::successors(Some(a), |s| Some(s.next_down()));
        let after = std::iter::successors(Some(b), |s| Some(s.next_up()));
        let all = before.take(BESIDE).chain(after.take(BESIDE));
        all.map(|s| self.point(s)).collect()
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
                self.point(s)
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
        let errors: Vec<Option<f64>> = points
            .par_iter()
            .zip(&values)
            .map(|(z, re)| error(z, *re))
            .collect();
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
    let nearby: Vec<Option<f64>> = values(code, &beside)
        .into_iter()
        .zip(&beside)
        .map(|(re, z)| error(z, re))
        .collect();
    let mut found: Option<Jump> = None;
    let nearby = nearby.chunks(2 * BESIDE);
    for ((segment, [inner, outer]), nearby) in segments.iter().zip(last).zip(nearby) {
        let a = segment.ends[0];
        let place = match segment.level {
            true => [a, segment.other],
            false => [segment.other, a],
        };
        let Some([due, size]) = due(place) else {
            continue;
        };
        let re = ((outer - inner) / due).abs();
        let least = LEAST + QUANTA * size / due + ABOVE * rounding(nearby);
        if !re.is_finite() || re <= least {
            continue;
        }
        let jump = found.get_or_insert(Jump {
            between: None,
            norm: None,
            re: 0.0,
            at: place,
            crossings: 0,
            rising: 0,
        });
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
    let due = w_f64(z[0], z[1], BITS).ok()?.re.mid().to_f64();
    Some((re? - due) / due)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solvers::faddeeva::faddeeva;
    use mechaudit_atlas::{Parts, Plane, find};
    use num_complex::Complex;

    fn found(name: &str) -> Vec<Jump> {
        breaks(&Code::double(find(name).unwrap()), 1)
    }

    #[test]
    fn segments_are_drawn_to_the_ends_of_their_ranges() {
        let all: Vec<Segment> = (0..40).flat_map(segments).collect();
        assert_eq!(all.len(), 40 * 48);
        let (level, upright): (Vec<&Segment>, Vec<&Segment>) = all.iter().partition(|s| s.level);
        assert!(level.iter().all(|s| s.ends == [0.01, 40.0]));
        assert!(upright.iter().all(|s| s.ends == [1e-12, 40.0]));
        let range = |of: &[&Segment]| {
            let others = || of.iter().map(|s| s.other);
            let least = others().fold(f64::INFINITY, f64::min);
            [least, others().fold(0.0, f64::max)]
        };
        let [least, most] = range(&level);
        assert!((1e-12..1.5e-12).contains(&least) && (25.0..30.0).contains(&most));
        let [least, most] = range(&upright);
        assert!((0.0..0.1).contains(&least) && (19.0..20.0).contains(&most));
    }

    #[test]
    fn wide_segments_are_divided_by_ratios() {
        let middle = |ends| {
            let (level, other) = (true, 1.0);
            Segment { level, other, ends }.points()[PARTS / 2][0]
        };
        assert_eq!(middle([2.0, 6.0]), 4.0);
        assert!((middle([2.0, 18.0]) - 6.0).abs() < 1e-12);
    }

    /// Jumps of W times a function of Re z, on four segments.
    fn planted(factor: fn(f64) -> f64) -> Vec<Jump> {
        let name = ("planted".into(), String::new(), String::new());
        let code = Code::other(name, Plane::Upper, Parts::Both, |inputs| {
            let w = |z: &Vec<f64>| {
                let w = faddeeva(Complex::new(z[0], z[1])) * factor(z[0]);
                SolverAnswer::Values(vec![w.re, w.im])
            };
            inputs.iter().map(w).collect()
        });
        on(&code, (0..4).map(|k| Segment::drawn(1, k)).collect())
    }

    #[test]
    fn jumps_up_and_down_are_counted_on_level_segments() {
        for (factor, rising) in [
            (
                (|x| if x < 10.0 { 1.0 } else { 1.0 + 1e-6 }) as fn(f64) -> f64,
                2,
            ),
            (|x| if x < 10.0 { 1.0 } else { 1.0 - 1e-6 }, 0),
        ] {
            let jump = &planted(factor)[0];
            assert!((jump.re - 1e-6).abs() < 1e-9, "{jump:?}");
            assert_eq!((jump.crossings, jump.rising), (2, rising));
            assert_eq!(jump.at[0], 10f64.next_down());
        }
    }

    /// The rounding on either side counts.
    #[test]
    fn a_jump_into_noise_is_none() {
        let after = |x: f64| match x < 10.0 {
            true => 1.0,
            false => 1.0 + 2e-6 + 1e-6 * (x.to_bits() & 1) as f64,
        };
        let before = |x: f64| match x < 10.0 {
            true => 1.0 + 2e-6 + 1e-6 * (x.to_bits() & 1) as f64,
            false => 1.0,
        };
        assert_eq!((planted(after), planted(before)), (vec![], vec![]));
    }

    #[test]
    fn a_known_seam_is_found_without_being_told() {
        // w4 changes its formula at |x| + y = 15 and 5.5 and at y = 0.195 |x| − 0.176.
        let jump = &found("humlicek-1982")[0];
        assert!(jump.re > 1e-5, "{jump:?}");
        let [x, y] = jump.at;
        let seams = [x + y - 15.0, x + y - 5.5, y - 0.195 * x + 0.176];
        assert!(seams.iter().any(|s| s.abs() < 1e-9), "{jump:?}");
    }

    #[test]
    fn a_single_formula_has_none() {
        assert_eq!(found("weideman-1994-16"), []);
        assert_eq!(found("schreier-2018-16"), []);
        assert_eq!(found("schreier-2018-20"), []);
    }
}
