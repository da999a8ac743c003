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
    use crate::audit::{Case, Origin, Settings, audit_case};
    use crate::methods::find;
    use crate::report::text::method::tests::fabricated;
    use crate::report::text::style::plain;

    fn of(name: &str) -> String {
        let method = find(name).unwrap();
        let point = &method.domain().check_points[0];
        let case = Case {
            method: method.name(),
            region: "check-points",
            input: point.input.clone(),
            origin: Origin::CheckPoint { name: point.name },
        };
        plain(&text(
            &audit_case(&*method, case, &Settings::default()),
            &Layout::new(&*method),
            "",
            200,
        ))
    }

    /// Outputs in rows are counted by row, those of one row are not counted.
    #[test]
    fn outputs_are_named() {
        let spline = of("cubic-spline-uniform");
        for name in [
            "S[0]",
            "S'[0]",
            "integral[0]",
            "S[1]",
            "S'[1]",
            "integral[1]",
        ] {
            assert!(spline.contains(name), "{name} is missing in {spline}");
        }
        assert!(!spline.contains("S[2]"), "{spline}");
        let system = of("tridiagonal");
        assert!(
            system.contains("x[0]") && system.contains("x[1]"),
            "{system}"
        );
        let w = of("faddeeva");
        assert!(w.contains("Re W") && !w.contains("W["), "{w}");
    }

    #[test]
    fn values_stand_in_columns_and_what_is_no_number_is_a_dash() {
        let mut report = crate::report::text::method::tests::fabricated()
            .failures
            .remove(0);
        let mut second = report.judgement.components[0].clone();
        (second.output, second.verdict) = ("p", Verdict::WrongKind);
        (second.ulps, second.of_budget, second.condition) = (f64::NAN, f64::INFINITY, 2.0);
        report.judgement.components.push(second);
        report.reference.push(None);
        let due = "    \
    output  got       reference                       ulps  of budget  condition
    phi2    0.75      0.75000000000000080491 ± 1e-30  7.25    175.0 %      31.00
    p       -0.00123  not certified                      –        inf       2.00
";
        assert_eq!(plain(&values(&report, &[0.75, -0.001_23])), due);
    }

    #[test]
    fn whatever_the_answer_is_the_case_says_so() {
        let text = |change: &dyn Fn(&mut CaseReport)| {
            let mut report = crate::report::text::method::tests::fabricated()
                .failures
                .remove(0);
            change(&mut report);
            plain(&super::text(&report, &fabricated().layout, "again", 100))
        };
        for (answer, due) in [
            (None, "no answer"),
            (Some(SolverAnswer::Fails("it broke".into())), "no answer"),
            (Some(SolverAnswer::Unanswered("late".into())), "no answer"),
            (Some(SolverAnswer::Refuses("singular")), "refusal: singular"),
            (
                Some(SolverAnswer::Declines(None)),
                "refusal: without a reason",
            ),
        ] {
            let text = text(&|r| r.answer = answer.clone());
            assert!(
                text.contains(&format!("\n    got        {due}\n")),
                "{text}"
            );
            assert!(!text.contains("reference"), "{text}");
        }
        let plain = text(&|r| (r.proof, r.judgement.reason) = (None, None));
        assert!(
            !plain.contains("proof") && !plain.contains("branch"),
            "{plain}"
        );
        assert!(plain.ends_with("    reproduce  again\n"), "{plain}");
        let bounded = text(&|r| {
            r.proof = Some(Proof::Bounded("a bound"));
            r.branch = Some(crate::audit::BranchAt {
                branch: Some("Taylor".into()),
                seam: "|z| = 7".into(),
                distance: 0.25,
            });
        });
        let due = "    proof      a bound\n    branch     Taylor; 0.250 from the seam |z| = 7\n    reproduce  again\n";
        assert!(bounded.ends_with(due), "{bounded}");
    }

    /// Values that were given and not judged are listed without a judgement.
    #[test]
    fn values_too_many_have_numbers_for_names() {
        let mut report = crate::report::text::method::tests::fabricated()
            .failures
            .remove(0);
        report.radii = vec![0.0];
        let text = plain(&values(&report, &[0.75, 2.0]));
        let words = |l: &str| l.split_whitespace().collect::<Vec<_>>().join(" ");
        let lines: Vec<String> = text.lines().map(words).collect();
        assert_eq!(
            lines[1],
            "phi2 0.75 0.75000000000000080491 7.25 175.0 % 31.00"
        );
        assert_eq!(lines[2], "[1] 2.0 none – – –");
        // Two rows of two outputs.
        let one = report.judgement.components[0].clone();
        let mut other = one.clone();
        other.output = "p";
        report.judgement.components = vec![one.clone(), other.clone(), one, other];
        let text = plain(&values(&report, &[1.0, 2.0, 3.0, 4.0]));
        let names: Vec<&str> = text
            .lines()
            .skip(1)
            .map(|l| l.split_whitespace().next().unwrap())
            .collect();
        assert_eq!(names, ["phi2[0]", "p[0]", "phi2[1]", "p[1]"]);
    }

    #[test]
    fn a_value_has_the_colour_of_its_verdict() {
        for (verdict, style) in [
            (Verdict::Pass, PLAIN),
            (Verdict::Undecided, DOUBT),
            (Verdict::Over, BAD),
            (Verdict::WrongKind, BAD),
        ] {
            let mut report = crate::report::text::method::tests::fabricated()
                .failures
                .remove(0);
            report.judgement.components[0].verdict = verdict;
            let text = values(&report, &[0.75]);
            for part in ["phi2", "7.25", "175.0 %"] {
                assert!(text.contains(&paint(style, part)), "{verdict:?}: {text:?}");
            }
            let painted = text.contains(&DOUBT.render().to_string());
            assert_eq!(painted, style == DOUBT);
            assert_eq!(text.contains(&BAD.render().to_string()), style == BAD);
        }
    }

    /// Behind the width of labels, and four characters from the edge.
    #[test]
    fn long_reasons_and_proofs_are_wrapped_below_their_beginning() {
        let mut report = crate::report::text::method::tests::fabricated()
            .failures
            .remove(0);
        report.judgement.reason = Some("one two three".to_string().into());
        report.proof = Some(Proof::Bounded("four five six"));
        let text = plain(&super::text(&report, &fabricated().layout, "again", 20));
        assert!(text.contains("\n    one two three\n"), "{text}");
        let due = "    proof      four\n               five\n               six\n";
        assert!(text.contains(due), "{text}");
        let text = plain(&super::text(&report, &fabricated().layout, "again", 12));
        assert!(text.contains("\n    one two\n    three\n"), "{text}");
    }
}
