//! Speed: all codes on the same points in one run, on one core, interleaved.

use crate::code::{Code, Shape};
use crate::points::Region;
use mechaudit::audit::Draw;
use num_complex::Complex64;
use serde::Serialize;

/// How to measure.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Settings {
    /// Key of the random points and orders.
    pub seed: u64,
    /// Points of each region.
    pub points: usize,
    /// Passes over them.
    pub passes: usize,
}

/// One code in one region.
#[derive(Clone, Debug, Serialize)]
pub struct Timing {
    /// The code.
    pub code: String,
    /// How it takes its points.
    pub shape: Shape,
    /// True if it is this project's.
    pub own: bool,
    /// Median over the blocks, ns a value.
    pub median_ns: f64,
    /// 5 % quantile of the blocks, ns a value.
    pub undisturbed_ns: f64,
}

/// The statistic of the times of the blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    /// The median: what a machine shared with others gives.
    Median,
    /// The 5 % quantile: hardly disturbed by other programs.
    Undisturbed,
}

impl Statistic {
    /// All of them, with their names.
    pub const ALL: [(Statistic, &str); 2] = [
        (Statistic::Median, "median of the blocks"),
        (
            Statistic::Undisturbed,
            "5 % quantile of the blocks, hardly disturbed by other programs",
        ),
    ];
}

impl Timing {
    /// ns a value.
    pub fn ns(&self, statistic: Statistic) -> f64 {
        match statistic {
            Statistic::Median => self.median_ns,
            Statistic::Undisturbed => self.undisturbed_ns,
        }
    }
}

/// One region.
#[derive(Clone, Debug, Serialize)]
pub struct RegionTimings {
    /// Its letter.
    pub region: &'static str,
    /// One entry for each code.
    pub codes: Vec<Timing>,
}

/// Points of a block: long enough that a code's tables are in the cache for most of it, short
/// enough that few blocks are disturbed by other programs.
pub const BLOCK: usize = 4096;

/// Measures. In every pass the points are put into a new random order and cut into blocks; each
/// code runs once over each block, the codes in a new random order for each. The median and the 5 %
/// quantile over all blocks of all passes count.
pub fn measure(
    codes: &[&dyn Code],
    regions: &[&'static Region],
    settings: &Settings,
    tick: &dyn Fn(),
) -> Vec<RegionTimings> {
    let mut draw = Draw::new(settings.seed, "faddeeva.w", "order", 0);
    let mut result = Vec::new();
    for region in regions {
        let mut z = region.points(settings.seed, 0, settings.points);
        let mut out = vec![Complex64::ZERO; z.len()];
        let mut order: Vec<usize> = (0..codes.len()).collect();
        let mut ns = vec![Vec::with_capacity(settings.passes); codes.len()];
        for code in codes {
            code.time(&z, &mut out);
        }
        for _ in 0..settings.passes {
            shuffle(&mut z, &mut draw);
            for z in z.chunks(BLOCK) {
                shuffle(&mut order, &mut draw);
                for &i in &order {
                    let out = &mut out[..z.len()];
                    let taken = codes[i].time(z, out);
                    std::hint::black_box(out);
                    ns[i].push(taken.as_secs_f64() * 1e9 / z.len() as f64);
                }
            }
            tick();
        }
        let timing = |(code, ns): (&&dyn Code, &mut Vec<f64>)| {
            ns.sort_by(f64::total_cmp);
            Timing {
                code: code.name().to_owned(),
                shape: code.shape(),
                own: code.own(),
                median_ns: median(ns),
                undisturbed_ns: ns.get(ns.len() / 20).copied().unwrap_or(f64::NAN),
            }
        };
        result.push(RegionTimings {
            region: region.name,
            codes: codes.iter().zip(&mut ns).map(timing).collect(),
        });
    }
    result
}

fn shuffle<T>(items: &mut [T], draw: &mut Draw) {
    for i in (1..items.len()).rev() {
        items.swap(i, draw.integer(0, i));
    }
}

fn median(sorted: &[f64]) -> f64 {
    match sorted.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => sorted[n / 2],
        n => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}

impl RegionTimings {
    /// The time of the fastest code of others.
    pub fn best_peer(&self, statistic: Statistic) -> Option<f64> {
        let peers = self.codes.iter().filter(|c| !c.own);
        peers.map(|c| c.ns(statistic)).min_by(f64::total_cmp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        assert_eq!(median(&[1.0, 2.0, 9.0]), 2.0);
        assert_eq!(median(&[1.0, 2.0, 4.0, 9.0]), 3.0);
        assert!(median(&[]).is_nan());
    }

    #[test]
    fn the_best_peer_by_each_statistic() {
        let code = |name: &str, own, median_ns, undisturbed_ns| Timing {
            code: name.into(),
            shape: Shape::Scalar,
            own,
            median_ns,
            undisturbed_ns,
        };
        let region = RegionTimings {
            region: "a",
            codes: vec![
                code("ours", true, 1.0, 1.0),
                code("p", false, 4.0, 3.5),
                code("q", false, 5.0, 3.0),
            ],
        };
        assert_eq!(region.best_peer(Statistic::Median), Some(4.0));
        assert_eq!(region.best_peer(Statistic::Undisturbed), Some(3.0));
    }

    #[test]
    fn a_shuffle_keeps_every_item() {
        let mut items: Vec<usize> = (0..100).collect();
        shuffle(&mut items, &mut Draw::new(1, "m", "r", 0));
        assert_ne!(items, (0..100).collect::<Vec<_>>());
        items.sort_unstable();
        assert_eq!(items, (0..100).collect::<Vec<_>>());
    }
}
