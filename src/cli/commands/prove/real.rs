//! Functions of a real argument.

use super::{boxes, head, line, opened, tell, up, versioned, watched};
use crate::cli::args::ProveArgs;
use crate::cli::failure::{Failure, Outcome};
use mechaudit::audit::hex_float;
use mechaudit::proof::real::{
    Certificate, Code, Formula, Function, Interval, Leaf, Summary, hole, real_line,
};
use mechaudit::report::text::style::{DIM, PLAIN};
use mechaudit::report::text::table::Table;
use serde_json::{Value, json};
use std::io::Write;
use std::time::Instant;

/// Proves of one function or of several, and prints what is proved.
pub fn prove(functions: &[Function], args: &ProveArgs) -> Result<Outcome, Failure> {
    let of_w = [
        ("--part", args.part.is_some() && functions.len() == 1),
        ("--norm", args.norm.is_some()),
        ("--within", args.within.is_some()),
    ];
    if let Some((name, _)) = of_w.into_iter().find(|(_, given)| *given) {
        let what = match functions {
            [one] => one.name(),
            _ => "the real line",
        };
        return Err(Failure::new(format!(
            "{name} is for faddeeva alone: {what} is proved for every real argument"
        )));
    }
    let boxes = boxes(args)?;
    let mut theorems = Vec::new();
    for &function in functions {
        match Theorem::of(function, args.component.unwrap_or(function.ulps()))? {
            None => return Ok(Outcome::Interrupted),
            Some(theorem) => theorems.push(theorem),
        }
    }
    tell(
        args,
        boxes,
        &theorems,
        (json!({ "part": "real" }), "functions"),
    )
}

struct Theorem {
    function: Function,
    found: Certificate,
    summary: Summary,
    missing: Option<f64>,
    seconds: f64,
}

fn place(at: &Interval) -> String {
    let [lo, hi] = at.signed();
    format!("[{lo:.4e}, {hi:.4e}]")
}

impl Theorem {
    /// Nothing if the user ends it.
    fn of(function: Function, target: f64) -> Result<Option<Theorem>, Failure> {
        let begin = Instant::now();
        let closer = target < function.ulps();
        let found = watched(function.name(), closer, move |watch| {
            let code = Code::of_the_solver(function)?;
            Ok(real_line(&code, function, target, watch))
        })?;
        let Some(found) = found else {
            return Ok(None);
        };
        let summary = found
            .summary(function)
            .ok_or_else(|| Failure::new("nothing was proved"))?;
        Ok(Some(Theorem {
            function,
            missing: hole(function, found.leaves.iter().map(|l| l.at)),
            seconds: begin.elapsed().as_secs_f64(),
            found,
            summary,
        }))
    }
}

impl super::Theorem for Theorem {
    fn is_proved(&self) -> bool {
        self.found.open.is_empty() && self.missing.is_none()
    }

    fn columns(&self) -> String {
        "function,from,to,formula,centre,ulps".into()
    }

    fn rows(&self, out: &mut dyn Write) -> Result<(), Failure> {
        let function = self.function;
        for Leaf { at, formula, ulps } in &self.found.leaves {
            let [p, q] = at.signed().map(hex_float);
            let centre = formula.centre().map(hex_float).unwrap_or_default();
            let of = formula.name(function, at.negative).replace(", ", " ");
            let (name, ulps) = (function.name(), hex_float(*ulps));
            writeln!(out, "{name},{p},{q},{of},{centre},{ulps}")?;
        }
        Ok(())
    }

    fn text(&self) -> String {
        let (name, summary) = (self.function.name(), &self.summary);
        let overflow = |l: &Leaf| l.formula == Formula::Overflow;
        let mut theorem = vec![format!(
            "|{name}_real(x) − {name} x| ≤ C ulp({name} x) for every finite f64 x: C = {}",
            up(summary.ulps)
        )];
        if self.found.leaves.iter().any(overflow) {
            theorem.push("but infinity where the value is above the range".into());
        }
        let theorem = self.is_proved().then_some(&theorem[..]);
        let title = format!("{name}, real argument");
        let mut out = head(&title, theorem, ("intervals", &self.found.open[..]), place);
        if let Some(x) = self.missing {
            out += &line(format!("{x:e} is in no interval with a bound"));
        }
        out += &line(format!("C is attained in {}", place(&summary.at)));
        let mut table = Table::new(&["formula", "intervals", "from", "to", "C"], &[0]);
        for f in &summary.formulas {
            table.row(vec![
                (f.name.to_string(), PLAIN),
                (f.intervals.to_string(), DIM),
                (format!("{:.4e}", f.ends[0]), PLAIN),
                (format!("{:.4e}", f.ends[1]), PLAIN),
                (up(f.ulps), PLAIN),
            ]);
        }
        out += &table.render(2);
        out += &line("ulp: the unit in the last place of the value, at least 2^-1074");
        out += &line(format!(
            "{} intervals, {:.1} s",
            summary.intervals, self.seconds
        ));
        out
    }

    fn document(&self) -> Value {
        let summary = &self.summary;
        let formulas: Vec<Value> = summary
            .formulas
            .iter()
            .map(|f| {
                json!({
                    "formula": f.name,
                    "intervals": f.intervals,
                    "range": f.ends,
                    "ulps": f.ulps,
                    "attained": f.at.signed(),
                })
            })
            .collect();
        versioned(json!({
            "function": self.function.name(),
            "part": "real",
            "proved": self.is_proved(),
            "ulps": { "bound": summary.ulps, "interval": summary.at.signed() },
            "intervals": summary.intervals,
            "seconds": self.seconds,
            "formulas": formulas,
            "open": opened(&self.found.open, "interval", |at: &Interval| json!(at.signed())),
            "missing": self.missing,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::commands::prove::Theorem as _;
    use mechaudit::proof::real::Open;

    /// Nothing open and no number left out: else it is no theorem, and is not said to be one.
    #[test]
    fn an_open_interval_or_a_hole_is_no_proof() {
        let at = Interval {
            negative: false,
            ends: [1.0, 2.0],
        };
        let of = |open: Vec<Open>, missing| Theorem {
            function: Function::Erf,
            found: Certificate {
                leaves: Vec::new(),
                open,
            },
            summary: Summary {
                ulps: 0.75,
                at,
                intervals: 0,
                formulas: Vec::new(),
            },
            missing,
            seconds: 0.0,
        };
        let open = Open {
            at,
            why: "too wide",
        };
        let said = |t: &Theorem| t.text().contains("for every finite f64");
        let whole = of(Vec::new(), None);
        assert!(whole.is_proved() && said(&whole));
        for part in [of(vec![open], None), of(Vec::new(), Some(1.5))] {
            assert!(!part.is_proved() && !said(&part));
        }
    }

    fn leaf(from: f64, to: f64, negative: bool, formula: Formula, ulps: f64) -> Leaf {
        Leaf {
            at: Interval {
                negative,
                ends: [from, to],
            },
            formula,
            ulps,
        }
    }

    /// Made up: a formula on two intervals, one of them negative, and one behind which the value
    /// overflows.
    fn theorem(open: Vec<Open>, missing: Option<f64>) -> Theorem {
        let function = Function::Erfc;
        let found = Certificate {
            leaves: vec![
                leaf(0.0, 1.0, false, Formula::Overflow, 0.0),
                leaf(1.0, 2.0, false, Formula::Overflow, 0.0),
                leaf(0.5, 1.0, true, Formula::Overflow, 0.0),
            ],
            open,
        };
        let summary = Summary {
            ulps: 0.75,
            at: found.leaves[2].at,
            intervals: 3,
            formulas: vec![mechaudit::proof::real::OfFormula {
                name: "some",
                intervals: 3,
                ends: [-1.0, 2.0],
                ulps: 0.75,
                at: found.leaves[2].at,
            }],
        };
        Theorem {
            function,
            found,
            summary,
            missing,
            seconds: 1.25,
        }
    }

    fn open(k: u32) -> Open {
        Open {
            at: Interval {
                negative: false,
                ends: [f64::from(k), 9.0],
            },
            why: "too wide",
        }
    }

    #[test]
    fn what_is_proved_in_words() {
        use mechaudit::report::text::style::plain;
        let due = "\
erfc, real argument
  |erfc_real(x) − erfc x| ≤ C ulp(erfc x) for every finite f64 x: C = 0.751
  but infinity where the value is above the range
  C is attained in [-1.0000e0, -5.0000e-1]
  formula  intervals        from        to      C
  some             3  -1.0000e0  2.0000e0  0.751
  ulp: the unit in the last place of the value, at least 2^-1074
  3 intervals, 1.2 s
";
        let squeezed = |text: &str| -> Vec<String> {
            let words = |l: &str| l.split_whitespace().collect::<Vec<_>>().join(" ");
            text.lines().map(words).collect()
        };
        let whole = theorem(Vec::new(), None);
        assert_eq!(squeezed(&plain(&whole.text())), squeezed(due));
        let part = plain(&theorem((0..6).map(open).collect(), Some(2.5)).text());
        assert!(
            part.contains("\n  not proved: 6 intervals are open\n"),
            "{part}"
        );
        assert!(
            part.contains("\n  2.5e0 is in no interval with a bound\n"),
            "{part}"
        );
        assert!(
            !part.contains("C = ") && !part.contains("infinity"),
            "{part}"
        );
        for k in 0..6 {
            let line = format!("\n  [{k}.0000e0, 9.0000e0]: too wide\n");
            assert_eq!(part.contains(&line), k < 5, "{part}");
        }
    }

    #[test]
    fn every_interval_has_a_row_and_a_place_in_json() {
        let whole = theorem(Vec::new(), None);
        let mut out = Vec::new();
        let both = [theorem(Vec::new(), None), theorem(Vec::new(), None)];
        crate::cli::commands::prove::write_boxes(&both, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        let rows: Vec<&str> = text.lines().collect();
        assert_eq!(rows.len(), 7);
        assert_eq!(rows[0], "function,from,to,formula,centre,ulps");
        let of = |negative| {
            Formula::Overflow
                .name(Function::Erfc, negative)
                .replace(", ", " ")
        };
        assert_eq!(rows[2], format!("erfc,0x1p+0,0x1p+1,{},,0x0p+0", of(false)));
        assert_eq!(
            rows[3],
            format!("erfc,-0x1p+0,-0x1p-1,{},,0x0p+0", of(true))
        );
        let v = whole.document();
        assert_eq!(
            (&v["function"], &v["part"], &v["proved"]),
            (&json!("erfc"), &json!("real"), &json!(true))
        );
        assert_eq!(
            v["ulps"],
            json!({ "bound": 0.75, "interval": [-1.0, -0.5] })
        );
        assert_eq!(
            (&v["intervals"], &v["seconds"], &v["missing"]),
            (&json!(3), &json!(1.25), &json!(null))
        );
        let of_formula = json!([{
            "formula": "some", "intervals": 3, "range": [-1.0, 2.0], "ulps": 0.75, "attained": [-1.0, -0.5],
        }]);
        assert_eq!(v["formulas"], of_formula);
        let v = theorem(vec![open(3)], Some(2.5)).document();
        assert_eq!((&v["proved"], &v["missing"]), (&json!(false), &json!(2.5)));
        assert_eq!(
            v["open"],
            json!([{ "interval": [3.0, 9.0], "why": "too wide" }])
        );
    }
}
