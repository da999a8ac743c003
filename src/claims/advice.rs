//! What follows from the rows for whoever has to choose.

use super::survey::Row;
use serde::Serialize;

/// A need with what meets it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Advice {
    /// The need.
    pub need: String,
    /// The codes that meet it at every point tried, the fastest first where times are known, else by name.
    pub codes: Vec<String>,
}

/// For each need that users have, what meets it.
pub fn advice(rows: &[Row]) -> Vec<Advice> {
    let mut all = Vec::new();
    let double: Vec<&Row> = rows.iter().filter(|r| !r.single).collect();
    for (k, target) in ["1e-4", "1e-6", "1e-10", "2 ε"].into_iter().enumerate() {
        for (words, floor) in [
            ("every Im z >= 0", f64::NEG_INFINITY),
            ("Im z >= 0.01", -2.0),
        ] {
            let of = |parts: bool| {
                let good = move |r: &&Row| {
                    let Some(h) = r.heights.get(k) else {
                        return false;
                    };
                    let height = if parts { h.parts } else { h.norm };
                    // A real part alone has no norm of its own.
                    (parts || !r.real_part_only) && height.is_some_and(|y| y <= floor)
                };
                named(double.iter().copied().filter(good))
            };
            all.push(Advice {
                need: format!("{target} of the norm, {words}"),
                codes: of(false),
            });
            all.push(Advice {
                need: format!("{target} of each part, {words}"),
                codes: of(true),
            });
        }
    }
    for (words, bound) in [("1e-6", 1e-6), ("1e-12", 1e-12)] {
        let good = |r: &&Row| r.derivative.as_ref().is_some_and(|d| d.worst <= bound);
        all.push(Advice {
            need: format!("W' by -2zW + 2i/sqrt(pi) within {words} of its norm, |Re z| < 8, Im z = 0.1..8"),
            codes: named(double.iter().copied().filter(good)),
        });
    }
    for (words, k) in [("1e-4", 0), ("1e-6", 1)] {
        let good = |r: &&Row| {
            let height = r.heights.get(k).and_then(|h| h.norm);
            r.single && height.is_some_and(|y| y <= -2.0)
        };
        all.push(Advice {
            need: format!("in single precision, {words} of the norm, Im z >= 0.01"),
            codes: named(rows.iter().filter(good)),
        });
    }
    all
}

fn named<'a>(rows: impl Iterator<Item = &'a Row>) -> Vec<String> {
    let mut rows: Vec<&Row> = rows.collect();
    let time = |r: &Row| r.nanoseconds.unwrap_or(f64::INFINITY);
    rows.sort_by(|a, b| time(a).total_cmp(&time(b)).then_with(|| a.name.cmp(&b.name)));
    rows.into_iter().map(|r| r.name.clone()).collect()
}
