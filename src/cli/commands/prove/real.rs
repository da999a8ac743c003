//! Functions of a real argument.

use super::{up, watched};
use crate::cli::args::{ProveArgs, TextOrJson};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, print_json, write_to};
use mechaudit::audit::hex_float;
use mechaudit::proof::real::{
    Certificate, Code, Formula, Function, Interval, Leaf, Summary, hole, real_line,
};
use mechaudit::report::text::style::{BAD, BOLD, DIM, PLAIN, paint};
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
    let boxes = args
        .boxes
        .as_deref()
        .map(|p| Output::open(Some(p)))
        .transpose()?;
    let mut theorems = Vec::new();
    for &function in functions {
        match Theorem::of(function, args.component.unwrap_or(function.ulps()))? {
            None => return Ok(Outcome::Interrupted),
            Some(theorem) => theorems.push(theorem),
        }
    }
    if let Some(output) = boxes {
        output.write(|out| write_intervals(&theorems, out))?;
    }
    match args.format {
        TextOrJson::Text => write_to(None, |out| {
            Ok(theorems
                .iter()
                .try_for_each(|t| write!(out, "{}", t.text()))?)
        })?,
        TextOrJson::Json => print_json(&match theorems.as_slice() {
            [one] => one.document(),
            all => json!({
                "schema_version": 1,
                "mechaudit_version": env!("CARGO_PKG_VERSION"),
                "part": "real",
                "proved": all.iter().all(Theorem::is_proved),
                "functions": all.iter().map(Theorem::document).collect::<Vec<Value>>(),
            }),
        })?,
    }
    Ok(Outcome::of(theorems.iter().all(Theorem::is_proved)))
}

struct Theorem {
    function: Function,
    found: Certificate,
    summary: Summary,
    missing: Option<f64>,
    seconds: f64,
}

fn write_intervals(theorems: &[Theorem], out: &mut dyn Write) -> Result<(), Failure> {
    writeln!(out, "function,from,to,formula,centre,ulps")?;
    for theorem in theorems {
        let function = theorem.function;
        for Leaf { at, formula, ulps } in &theorem.found.leaves {
            let [p, q] = at.signed().map(hex_float);
            let centre = formula.centre().map(hex_float).unwrap_or_default();
            let of = formula.name(function, at.negative).replace(", ", " ");
            let (name, ulps) = (function.name(), hex_float(*ulps));
            writeln!(out, "{name},{p},{q},{of},{centre},{ulps}")?;
        }
    }
    Ok(())
}

fn place(at: &Interval) -> String {
    let [lo, hi] = at.signed();
    format!("[{lo:.4e}, {hi:.4e}]")
}

impl Theorem {
    /// Nothing if the user ends it.
    fn of(function: Function, target: f64) -> Result<Option<Theorem>, Failure> {
        let begin = Instant::now();
        let found = watched(function.name(), move |watch| {
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

    fn is_proved(&self) -> bool {
        self.found.open.is_empty() && self.missing.is_none()
    }

    fn text(&self) -> String {
        let name = self.function.name();
        let title = format!("{name}, real argument");
        let mut out = format!("{}\n", paint(BOLD, &title));
        let line = |text: String| format!("  {text}\n");
        let overflow = |l: &Leaf| l.formula == Formula::Overflow;
        let summary = &self.summary;
        if self.is_proved() {
            out += &line(format!(
                "|{name}_real(x) − {name} x| ≤ C ulp({name} x) for every finite f64 x: C = {}",
                up(summary.ulps)
            ));
            if self.found.leaves.iter().any(overflow) {
                out += &line("but infinity where the value is above the range".into());
            }
        } else {
            let open = self.found.open.len();
            let text = format!("not proved: {open} intervals are open");
            out += &line(paint(BAD, &text));
            for open in self.found.open.iter().take(5) {
                out += &line(format!("{}: {}", place(&open.at), open.why));
            }
            if let Some(x) = self.missing {
                out += &line(format!("{x:e} is in no interval with a bound"));
            }
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
        out += &line("ulp: the unit in the last place of the value, at least 2^-1074".into());
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
        let open = self.found.open.iter();
        let open: Vec<Value> = open
            .map(|o| json!({ "interval": o.at.signed(), "why": o.why }))
            .collect();
        json!({
            "schema_version": 1,
            "mechaudit_version": env!("CARGO_PKG_VERSION"),
            "function": self.function.name(),
            "part": "real",
            "proved": self.is_proved(),
            "ulps": { "bound": summary.ulps, "interval": summary.at.signed() },
            "intervals": summary.intervals,
            "seconds": self.seconds,
            "formulas": formulas,
            "open": open,
            "missing": self.missing,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
}
