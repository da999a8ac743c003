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
    /// Those of the same kind that do not.
    pub others: Vec<String>,
}

impl Advice {
    /// What meets the need, or, where that is shorter, what does not.
    pub fn words(&self) -> String {
        match (self.codes.len(), self.others.len()) {
            (0, _) => "none of these".into(),
            (_, 0) => "all of these".into(),
            (good, bad) if bad < good => format!("all but {}", self.others.join(", ")),
            _ => self.codes.join(", "),
        }
    }
}

/// For each need that users have, what meets it.
pub fn advice(rows: &[Row]) -> Vec<Advice> {
    let double: Vec<&Row> = rows.iter().filter(|r| !r.single).collect();
    let single: Vec<&Row> = rows.iter().filter(|r| r.single).collect();
    // A real part alone has no norm of its own, and no derivative.
    let whole: Vec<&Row> = double
        .iter()
        .copied()
        .filter(|r| !r.real_part_only)
        .collect();
    let mut all = Vec::new();
    for (k, target) in ["1e-4", "1e-6", "1e-10", "2 ε"].into_iter().enumerate() {
        for (words, floor) in [
            ("every Im z >= 0", f64::NEG_INFINITY),
            ("Im z >= 0.01", -2.0),
        ] {
            let reached = |h: Option<f64>| h.is_some_and(|y| y <= floor);
            let norm = |r: &Row| r.heights.get(k).is_some_and(|h| reached(h.norm));
            let parts = |r: &Row| r.heights.get(k).is_some_and(|h| reached(h.parts));
            all.push(divided(
                format!("{target} of the norm, {words}"),
                &whole,
                norm,
            ));
            all.push(divided(
                format!("{target} of each part, {words}"),
                &double,
                parts,
            ));
        }
    }
    for (words, bound) in [("1e-6", 1e-6), ("1e-12", 1e-12)] {
        let good = |r: &Row| r.derivative.as_ref().is_some_and(|d| d.worst <= bound);
        let need = format!(
            "W' by -2zW + 2i/sqrt(pi) within {words} of its norm, -8 < Re z < 8, Im z = 0.1..8"
        );
        all.push(divided(need, &whole, good));
    }
    for (words, k) in [("1e-4", 0), ("1e-6", 1)] {
        let good = |r: &Row| {
            let height = r.heights.get(k).and_then(|h| h.norm);
            height.is_some_and(|y| y <= -2.0)
        };
        let need = format!("in single precision, {words} of the norm, Im z >= 0.01");
        all.push(divided(need, &single, good));
    }
    all.retain(|a| !(a.codes.is_empty() && a.others.is_empty()));
    all
}

fn divided(need: String, rows: &[&Row], good: impl Fn(&Row) -> bool) -> Advice {
    let (codes, others) = rows.iter().copied().partition(|r| good(r));
    Advice {
        need,
        codes: named(codes),
        others: named(others),
    }
}

fn named(mut rows: Vec<&Row>) -> Vec<String> {
    let time = |r: &Row| r.nanoseconds.unwrap_or(f64::INFINITY);
    rows.sort_by(|a, b| {
        time(a)
            .total_cmp(&time(b))
            .then_with(|| a.name.cmp(&b.name))
    });
    rows.into_iter().map(|r| r.name.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::heights::Height;
    use serde_json::Value;

    /// A height of Im z = 0.01 itself is enough, a higher one is not.
    #[test]
    fn what_is_reached_down_to_a_hundredth() {
        let row = |name: &str, single: bool, y: f64| Row {
            name: name.into(),
            title: String::new(),
            source: String::new(),
            whole_plane: false,
            real_part_only: false,
            single,
            parts: Vec::new(),
            derivative: None,
            heights: vec![Height {
                target: 1e-4,
                norm: Some(y),
                parts: Some(y),
            }],
            jumps: Vec::new(),
            nanoseconds: None,
        };
        for single in [false, true] {
            let rows = [row("down", single, -2.0), row("above", single, -1.0)];
            let needs = advice(&rows);
            let met = needs.iter().filter(|a| !a.codes.is_empty());
            let met: Vec<&Advice> = met.collect();
            assert!(!met.is_empty());
            for a in met {
                assert!(a.need.ends_with("Im z >= 0.01"), "{}", a.need);
                assert_eq!(
                    (&a.codes[..], &a.others[..]),
                    (&["down".into()][..], &["above".into()][..])
                );
            }
        }
    }

    /// The book's advice is the committed table's, line by line.
    #[test]
    fn the_book_gives_this_advice_and_no_other() {
        let held: Value =
            serde_json::from_str(include_str!("../../reference/atlas/atlas.json")).unwrap();
        let words = |v: &Value| -> Vec<String> {
            let all = v.as_array().unwrap().iter();
            all.map(|c| c.as_str().unwrap().to_string()).collect()
        };
        let advice = held["advice"].as_array().unwrap().iter().map(|a| Advice {
            need: a["need"].as_str().unwrap().into(),
            codes: words(&a["codes"]),
            others: words(&a["others"]),
        });
        let due: Vec<String> = advice
            .map(|a| format!("| {} | {} |", a.need, a.words()))
            .collect();
        let book = include_str!("../book/atlas.md");
        let (_, table) = book.split_once("| need | met by |\n|---|---|\n").unwrap();
        let lines: Vec<&str> = table.lines().take_while(|l| l.starts_with('|')).collect();
        assert_eq!(lines, due);
    }
}
