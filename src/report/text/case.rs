//! One judged case.

use super::style::{self, BAD, BOLD, DIM, DOUBT, PLAIN, paint, paragraph, wrap};
use super::table::Table;
use crate::audit::{Case, CaseReport, Layout, Proof, SolverAnswer, Verdict, hex_float};
use crate::report::words::audit::of_case;
use crate::report::words::numbers::{percent, short, unit};

/// The input in decimal and in hexadecimal, named as the layout says.
pub fn input(case: &Case, layout: &Layout, indent: usize) -> String {
    let names = layout.names(&case.input);
    let mut table = Table::new(&["input", "unit", "decimal", "hexadecimal"], &[0, 1, 3]);
    for (i, x) in case.input.iter().enumerate() {
        let (name, of) = names.get(i).cloned().unwrap_or_default();
        table.row(vec![
            (name, PLAIN),
            (unit(of), DIM),
            (format!("{x:?}"), PLAIN),
            (hex_float(*x), DIM),
        ]);
    }
    table.render(indent)
}

/// The case with everything that was found about it.
///
/// `again` is the command that judges it again.
pub fn text(report: &CaseReport, layout: &Layout, again: &str, width: usize) -> String {
    let case = &report.case;
    let (word, tone) = of_case(report.judgement.verdict);
    let mut out = format!(
        "  {}  {} / {}, decided at {} bits\n",
        paint(style::of(tone), word),
        paint(BOLD, case.method),
        case.region,
        report.bits
    );
    if let Some(reason) = report.judgement.why() {
        out.push_str(&paragraph(&reason, 4, width));
    }
    out.push_str(&input(case, layout, 4));
    match &report.answer {
        Some(SolverAnswer::Values(got)) => out.push_str(&values(report, got)),
        Some(SolverAnswer::Fails(_) | SolverAnswer::Unanswered(_)) | None => {
            out.push_str("    got        no answer\n")
        }
        Some(refusal) => {
            let word = refusal.refusal().unwrap_or("without a reason");
            out.push_str(&format!("    got        refusal: {word}\n"));
        }
    }
    if let Some(proof) = report.proof {
        let proof = match proof {
            Proof::Exact => "exact arithmetic",
            Proof::Bounded(why) => why,
        };
        out.push_str("    proof      ");
        out.push_str(&wrap(proof, 15, width));
        out.push('\n');
    }
    if let Some(at) = &report.branch {
        let branch = at.branch.as_ref();
        let branch = branch.map_or(String::new(), |b| format!("{b}; "));
        let (distance, seam) = (short(at.distance), &at.seam);
        out.push_str(&format!(
            "    branch     {branch}{distance} from the seam {seam}\n"
        ));
    }
    out.push_str(&format!("    reproduce  {again}\n"));
    out
}

fn values(report: &CaseReport, got: &[f64]) -> String {
    let judged = &report.judgement.components;
    // Outputs that share a name are counted.
    let first = judged.first().map(|c| c.output);
    let outputs = judged.iter().skip(1).position(|c| Some(c.output) == first);
    let cycle = outputs.map_or(judged.len(), |k| k + 1);
    let mut table = Table::new(
        &[
            "output",
            "got",
            "reference",
            "ulps",
            "of budget",
            "condition",
        ],
        &[0, 1, 2],
    );
    for (i, x) in got.iter().enumerate() {
        let name = match judged.get(i) {
            None => format!("[{i}]"),
            Some(c) if cycle == judged.len() => c.output.to_string(),
            Some(c) => format!("{}[{}]", c.output, i / cycle),
        };
        let radius = report.radii.get(i).filter(|r| **r > 0.0);
        let radius = radius.map_or(String::new(), |r| format!(" ± {r:.0e}"));
        let reference = match report.reference.get(i) {
            Some(Some(digits)) => format!("{digits}{radius}"),
            Some(None) => "not certified".into(),
            None => "none".into(),
        };
        let judged = judged.get(i);
        let number = |x: Option<f64>| x.filter(|x| !x.is_nan()).map_or("–".into(), short);
        let style = judged.map_or(PLAIN, |c| match c.verdict {
            Verdict::Pass => PLAIN,
            Verdict::Undecided => DOUBT,
            _ => BAD,
        });
        table.row(vec![
            (name, style),
            (format!("{x:?}"), PLAIN),
            (reference, PLAIN),
            (number(judged.map(|c| c.ulps)), style),
            (judged.map_or("–".into(), |c| percent(c.of_budget)), style),
            (number(judged.map(|c| c.condition)), DIM),
        ]);
    }
    table.render(4)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{BranchAt, Case, Origin, Settings, audit_case};
    use crate::methods::find;
    use crate::report::gallery::Gallery;
    use crate::report::text::method::tests::fabricated;

    /// Outputs in rows are counted by row, those of one row are not counted.
    #[test]
    fn cases_of_methods() {
        let mut all = Gallery::default();
        for name in ["cubic-spline-uniform", "tridiagonal", "faddeeva"] {
            let method = find(name).unwrap();
            let point = &method.domain().check_points[0];
            let case = Case {
                method: method.name(),
                region: "check-points",
                input: point.input.clone(),
                origin: Origin::CheckPoint { name: point.name },
            };
            let report = audit_case(&*method, case, &Settings::default());
            all.add(name, text(&report, &Layout::new(&*method), "", 200));
        }
        all.pin("cases-of-methods");
    }

    /// Answers of each kind, values of each verdict in its colour, values that are missing or too
    /// many, and long texts.
    #[test]
    fn cases() {
        let mut all = Gallery::default();
        let layout = fabricated().layout;
        let failure = || fabricated().failures.remove(0);
        for answer in [
            None,
            Some(SolverAnswer::Fails("it broke".into())),
            Some(SolverAnswer::Unanswered("late".into())),
            Some(SolverAnswer::Refuses("singular")),
            Some(SolverAnswer::Declines(None)),
        ] {
            let mut report = failure();
            report.answer = answer;
            (report.proof, report.judgement.reason) = (None, None);
            let name = format!("{:?}", report.answer);
            all.add(name, text(&report, &layout, "again", 100));
        }
        let mut report = failure();
        report.proof = Some(Proof::Bounded("four five six"));
        report.judgement.reason = Some("one two three".to_string().into());
        report.branch = Some(BranchAt {
            branch: Some("Taylor".into()),
            seam: "|z| = 7".into(),
            distance: 0.25,
        });
        for width in [100, 20, 12] {
            all.add(
                format!("on {width}"),
                text(&report, &layout, "again", width),
            );
        }
        for verdict in [
            Verdict::Pass,
            Verdict::Undecided,
            Verdict::Over,
            Verdict::WrongKind,
        ] {
            report.judgement.components[0].verdict = verdict;
            all.add(format!("{verdict:?}"), values(&report, &[0.75]));
        }
        report.radii = vec![0.0];
        all.add("one too many", values(&report, &[0.75, 2.0]));
        let one = report.judgement.components[0].clone();
        let mut other = one.clone();
        (other.output, other.ulps, other.of_budget) = ("p", f64::NAN, f64::INFINITY);
        report.judgement.components = vec![one.clone(), other.clone()];
        report.reference.push(None);
        all.add("not certified", values(&report, &[0.75, -0.001_23]));
        report.judgement.components = vec![one.clone(), other.clone(), one, other];
        all.add("two rows", values(&report, &[1.0, 2.0, 3.0, 4.0]));
        all.pin("cases");
    }
}
