//! The results of a run, and their JSON form.

use crate::accuracy::{self, RegionAccuracy};
use crate::code::{Code, Missing, Shape};
use crate::special::SpecialValue;
use crate::speed::{self, RegionTimings, Statistic};
use serde::Serialize;

/// A compared code.
#[derive(Clone, Debug, Serialize)]
pub struct Compared {
    /// Name in the tables.
    pub code: String,
    /// Version, or where it came from.
    pub version: String,
    /// How it takes its points.
    pub shape: Shape,
}

/// Accuracy of all codes.
#[derive(Serialize)]
pub struct AccuracyReport {
    /// The number of points.
    pub settings: accuracy::Settings,
    /// Certified bits of each part of the reference.
    pub reference_bits: u32,
    /// One entry for each region.
    pub regions: Vec<RegionAccuracy>,
}

/// Speed of all codes.
#[derive(Serialize)]
pub struct SpeedReport {
    /// How it was measured.
    pub settings: speed::Settings,
    /// Points of a block.
    pub block: usize,
    /// The processor core, if the measuring thread could be bound to one.
    pub core: Option<usize>,
    /// One entry for each region.
    pub regions: Vec<RegionTimings>,
}

/// A run.
#[derive(Serialize)]
pub struct Report {
    /// Which instructions the Rust codes were compiled for.
    pub compiled_for: String,
    /// The codes.
    pub codes: Vec<Compared>,
    /// Codes that were looked for and not found.
    pub missing: Vec<Missing>,
    /// Accuracy, if asked for.
    pub accuracy: Option<AccuracyReport>,
    /// Special values, if asked for.
    pub special_values: Option<Vec<SpecialValue>>,
    /// Speed, if asked for.
    pub speed: Option<SpeedReport>,
}

/// Which instructions this program was compiled for.
pub fn compiled_for() -> String {
    let features = [
        ("avx512f", cfg!(target_feature = "avx512f")),
        ("avx2", cfg!(target_feature = "avx2")),
        ("fma", cfg!(target_feature = "fma")),
    ];
    let on: Vec<&str> = features.iter().filter(|f| f.1).map(|f| f.0).collect();
    let on = match on.is_empty() {
        true => "the target's baseline".to_owned(),
        false => on.join(", "),
    };
    format!("{}: {on}", std::env::consts::ARCH)
}

/// The codes.
pub fn compared(codes: &[&dyn Code]) -> Vec<Compared> {
    let describe = |c: &&dyn Code| Compared {
        code: c.name().to_owned(),
        version: c.version().to_owned(),
        shape: c.shape(),
    };
    codes.iter().map(describe).collect()
}

/// As JSON. Infinities and NaN (no values) are null.
pub fn json(report: &Report) -> String {
    let mut s = serde_json::to_string_pretty(report).expect("a tree of plain values");
    s.push('\n');
    s
}

/// An error for a table: three digits at most.
pub fn error(x: f64) -> String {
    if x.is_nan() {
        "-".into()
    } else if x.is_infinite() {
        "inf".into()
    } else if x < 9.995 {
        format!("{x:.2}")
    } else if x < 99.95 {
        format!("{x:.1}")
    } else if x < 9999.5 {
        format!("{x:.0}")
    } else {
        format!("{x:.0e}")
    }
}

/// The rows of a speed table: heading and one value for each region.
pub fn ratios(timings: &[RegionTimings], statistic: Statistic) -> Vec<(String, Vec<f64>)> {
    let Some(first) = timings.first() else {
        return Vec::new();
    };
    let own = first.codes.iter().enumerate().filter(|(_, c)| c.own);
    own.map(|(i, c)| {
        let ratio = |t: &RegionTimings| {
            t.best_peer(statistic).unwrap_or(f64::NAN) / t.codes[i].ns(statistic)
        };
        (c.code.clone(), timings.iter().map(ratio).collect())
    })
    .collect()
}

/// Returns true if a row of the accuracy tables would repeat that of the scalar function.
pub fn repeats(regions: &[RegionAccuracy], code: usize) -> bool {
    regions.iter().all(|r| r.codes[code].differs == Some(0))
}

/// Describes how this project's batch functions differ from the scalar one.
pub fn differences(regions: &[RegionAccuracy]) -> Vec<String> {
    let Some(first) = regions.first() else {
        return Vec::new();
    };
    let mut lines = Vec::new();
    for (i, code) in first.codes.iter().enumerate() {
        if code.differs.is_some() {
            let n: u64 = regions.iter().filter_map(|r| r.codes[i].differs).sum();
            lines.push(match n {
                0 => format!(
                    "{}: the same bits as the scalar function everywhere",
                    code.code
                ),
                n => format!(
                    "{}: bits differ from the scalar function at {n} points",
                    code.code
                ),
            });
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits() {
        let cases = [
            (0.456, "0.46"),
            (9.996, "10.0"),
            (99.96, "100"),
            (1234.4, "1234"),
            (2.34e10, "2e10"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "-"),
        ];
        for (x, text) in cases {
            assert_eq!(error(x), text);
        }
    }
}
