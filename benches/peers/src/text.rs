//! Text tables.

use crate::speed::RegionTimings;
use std::fmt::Write;

/// Speeds.
pub fn speed(timings: &[RegionTimings]) -> String {
    let mut s = String::new();
    let _ = write!(s, "{:<24}", "ns per value");
    for t in timings {
        let _ = write!(s, "{:>9}", t.region);
    }
    s.push('\n');
    let Some(first) = timings.first() else {
        return s;
    };
    for i in 0..first.codes.len() {
        let _ = write!(s, "{:<24}", first.codes[i].code);
        for t in timings {
            let _ = write!(s, "{:>9.1}", t.codes[i].median_ns);
        }
        s.push('\n');
    }
    for i in 0..first.codes.len() {
        if !first.codes[i].own {
            continue;
        }
        let _ = write!(s, "{:<24}", format!("best peer / {}", first.codes[i].code));
        for t in timings {
            let best = t.best_peer().map_or(f64::NAN, |b| b.median_ns);
            let _ = write!(s, "{:>9.2}", best / t.codes[i].median_ns);
        }
        s.push('\n');
    }
    s
}
