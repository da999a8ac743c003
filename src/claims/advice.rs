//! Describes what follows from the rows for whoever has to choose.

use super::survey::Row;
use serde::Serialize;

/// A need with what meets it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Advice {
    /// The need.
    pub need: String,
    /// The codes that meet it at every point tried, the fastest first where times are known, else
    /// by name.
    pub codes: Vec<String>,
    /// Those of the same kind that do not.
    pub others: Vec<String>,
}

impl Advice {
    /// Returns what meets the need, or, where that is shorter, what does not.
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
    use crate::claims::survey::Figures;
    use std::collections::BTreeMap;

    /// Of a code of both parts in double precision of which nothing is known.
    fn row(name: &str) -> Row {
        Row {
            name: name.into(),
            title: String::new(),
            source: String::new(),
            whole_plane: false,
            real_part_only: false,
            single: false,
            parts: Vec::new(),
            derivative: None,
            heights: Vec::new(),
            jumps: Vec::new(),
            nanoseconds: None,
        }
    }

    fn height(target: f64, norm: Option<f64>, parts: Option<f64>) -> Height {
        Height {
            target,
            norm,
            parts,
        }
    }

    /// Returns what the committed tables say of each code: its heights, and the errors of its
    /// derivative.
    fn committed() -> Vec<Row> {
        fn records(text: &str) -> Vec<csv::StringRecord> {
            let mut reader = csv::ReaderBuilder::new()
                .comment(Some(b'#'))
                .from_reader(text.as_bytes());
            reader.records().collect::<Result<_, _>>().unwrap()
        }
        // An algorithm has the same name in single precision.
        let mut rows = BTreeMap::new();
        for r in records(include_str!("../../reference/atlas/atlas-heights.csv")) {
            let reached = |text: &str| match text {
                "" => None,
                "everywhere" => Some(f64::NEG_INFINITY),
                power => Some(power.strip_prefix("1e").unwrap().parse().unwrap()),
            };
            let key = (r[0].to_string(), r[1].to_string());
            let row = rows.entry(key).or_insert_with(|| Row {
                single: &r[1] == "single",
                real_part_only: &r[2] == "Re",
                ..row(&r[0])
            });
            let target = r[3].parse().unwrap();
            row.heights
                .push(height(target, reached(&r[4]), reached(&r[5])));
        }
        for r in records(include_str!("../../reference/atlas/atlas-rows.csv")) {
            let key = (r[0].to_string(), r[1].to_string());
            if let (Some(row), Ok(worst)) = (rows.get_mut(&key), r[13].parse()) {
                let (p99, median) = (worst, worst);
                row.derivative = Some(Figures { worst, p99, median });
            }
        }
        rows.into_values().collect()
    }

    /// A height of Im z = 0.01 itself is enough, a higher one is not.
    #[test]
    fn what_is_reached_down_to_a_hundredth() {
        for single in [false, true] {
            let rows = [("down", -2.0), ("above", -1.0)].map(|(name, y)| Row {
                single,
                heights: vec![height(1e-4, Some(y), Some(y))],
                ..row(name)
            });
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
        let advice = advice(&committed()).into_iter();
        let due: Vec<String> = advice
            .map(|a| format!("| {} | {} |", a.need, a.words()))
            .collect();
        let book = include_str!("../book/atlas.md");
        let (_, table) = book.split_once("| need | met by |\n|---|---|\n").unwrap();
        let lines: Vec<&str> = table.lines().take_while(|l| l.starts_with('|')).collect();
        assert_eq!(lines, due);
    }

    #[test]
    fn the_shorter_list_is_told() {
        let words = |codes: &[&str], others: &[&str]| {
            let names = |all: &[&str]| all.iter().map(|n| n.to_string()).collect();
            let (codes, others) = (names(codes), names(others));
            let need = String::new();
            Advice {
                need,
                codes,
                others,
            }
            .words()
        };
        assert_eq!(words(&[], &["a"]), "none of these");
        assert_eq!(words(&["a", "b"], &[]), "all of these");
        assert_eq!(words(&["a", "b"], &["c"]), "all but c");
        assert_eq!(words(&["a", "b"], &["c", "d"]), "a, b");
        assert_eq!(words(&["a"], &["c", "d"]), "a");
    }

    /// One of both parts that reaches less and less, one of Re w alone, one in single precision;
    /// each with a worse one beside it.
    #[test]
    fn each_need_is_told_with_what_meets_it() {
        let everywhere = Some(f64::NEG_INFINITY);
        let derivative = |worst: f64| {
            let (p99, median) = (0.0, 0.0);
            Some(Figures { worst, p99, median })
        };
        let rows = [
            Row {
                heights: vec![
                    height(1e-4, everywhere, everywhere),
                    height(1e-6, everywhere, Some(-2.0)),
                    height(1e-10, Some(-3.0), Some(-1.0)),
                    height(2.0 * f64::EPSILON, None, None),
                ],
                derivative: derivative(1e-12),
                nanoseconds: Some(9.0),
                ..row("a")
            },
            Row {
                heights: vec![height(1e-4, everywhere, Some(-1.9)); 4],
                derivative: derivative(1.1e-12),
                nanoseconds: Some(5.0),
                ..row("b")
            },
            Row {
                derivative: derivative(1e-6),
                ..row("d")
            },
            Row {
                derivative: derivative(1.1e-6),
                ..row("c")
            },
            Row {
                real_part_only: true,
                heights: vec![height(1e-4, None, everywhere)],
                ..row("re")
            },
            Row {
                single: true,
                heights: vec![
                    height(1e-4, Some(-2.0), None),
                    height(1e-6, Some(-1.9), None),
                ],
                derivative: derivative(0.0),
                ..row("f")
            },
            Row {
                single: true,
                heights: vec![
                    height(1e-4, Some(-1.9), None),
                    height(1e-6, Some(-2.1), None),
                ],
                ..row("g")
            },
        ];
        let found = advice(&rows);
        let found: Vec<[String; 3]> = found
            .iter()
            .map(|a| [a.need.clone(), a.codes.join(" "), a.others.join(" ")])
            .collect();
        let slope = |within: &str| {
            format!(
                "W' by -2zW + 2i/sqrt(pi) within {within} of its norm, -8 < Re z < 8, Im z = 0.1..8"
            )
        };
        let single =
            |within: &str| format!("in single precision, {within} of the norm, Im z >= 0.01");
        let due = [
            ("1e-4 of the norm, every Im z >= 0".into(), "b a", "c d"),
            ("1e-4 of each part, every Im z >= 0".into(), "a re", "b c d"),
            ("1e-4 of the norm, Im z >= 0.01".into(), "b a", "c d"),
            ("1e-4 of each part, Im z >= 0.01".into(), "a re", "b c d"),
            ("1e-6 of the norm, every Im z >= 0".into(), "b a", "c d"),
            (
                "1e-6 of each part, every Im z >= 0".into(),
                "",
                "b a c d re",
            ),
            ("1e-6 of the norm, Im z >= 0.01".into(), "b a", "c d"),
            ("1e-6 of each part, Im z >= 0.01".into(), "a", "b c d re"),
            ("1e-10 of the norm, every Im z >= 0".into(), "b", "a c d"),
            (
                "1e-10 of each part, every Im z >= 0".into(),
                "",
                "b a c d re",
            ),
            ("1e-10 of the norm, Im z >= 0.01".into(), "b a", "c d"),
            ("1e-10 of each part, Im z >= 0.01".into(), "", "b a c d re"),
            ("2 ε of the norm, every Im z >= 0".into(), "b", "a c d"),
            ("2 ε of each part, every Im z >= 0".into(), "", "b a c d re"),
            ("2 ε of the norm, Im z >= 0.01".into(), "b", "a c d"),
            ("2 ε of each part, Im z >= 0.01".into(), "", "b a c d re"),
            (slope("1e-6"), "b a d", "c"),
            (slope("1e-12"), "a", "b c d"),
            (single("1e-4"), "f", "g"),
            (single("1e-6"), "g", "f"),
        ];
        let due = due
            .map(|(need, codes, others): (String, &str, &str)| [need, codes.into(), others.into()]);
        assert_eq!(found, due);
        // Nobody asks where there is nothing to choose from.
        let doubles: Vec<Row> = rows.into_iter().filter(|r| !r.single).collect();
        assert_eq!(advice(&doubles).len(), 18);
        let good = [Row {
            heights: vec![height(1e-4, everywhere, everywhere); 4],
            ..row("good")
        }];
        assert_eq!(advice(&good).len(), 18);
    }
}
