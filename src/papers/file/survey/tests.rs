//! Tests of surveys.

use crate::papers::{Finding, PaperFile};
use std::path::Path;

/// (1 − cos x)/x² as it stands, by the half angle, and with a seam at 1.
const STUDY: &str = r#"
[inputs]
x = { from = "1e-9", to = 3, spacing = "log" }
[outputs]
y = { is = "(1 - cos(x))/x^2", budget = "8 ulp", why = "a test" }
"#;

const PAPER: &str = r#"
title = "A survey"
[solver.naive]
study = "half.toml"
y = "(1 - cos(x))/x^2"
[solver.stable]
study = "half.toml"
y = "2*(sin(x/2)/x)^2"
[solver.patched]
study = "half.toml"
y = "if(x < 1, 1/2, 2*(sin(x/2)/x)^2)"
"#;

fn surveyed(survey: &str) -> Result<Vec<Finding>, String> {
    let text = crate::study::intern(&format!(
        "{PAPER}[[survey]]\nid = 's'\nstudy = 'half.toml'\nalong = 'x'\n{survey}\n"
    ));
    let texts = vec![("paper.toml", text), ("half.toml", STUDY)];
    let paper = PaperFile::parse("planted", texts.leak()).map_err(|e| e.to_string())?;
    Ok(paper.report(&|_, _, _| {}).unwrap().findings)
}

fn figures(finding: &Finding) -> Vec<(&str, &str)> {
    let figures = finding.figures.iter();
    figures
        .map(|f| (f.name.as_str(), f.value.as_str()))
        .collect()
}

/// The error of the naive formula is about 1e-16/x², and that of the patched one x²/12 up to 1.
#[test]
fn heights_jumps_and_advice() {
    let found = surveyed("targets = ['1e-9', '1e-17']\nfloors = ['0.01']").unwrap();
    let [heights, seams, advice] = &found[..] else {
        panic!("three findings");
    };
    assert_eq!(
        figures(heights),
        [
            ("naive", "1e-9: 1e-3, 1e-3; 1e-17: nowhere, nowhere"),
            (
                "stable",
                "1e-9: everywhere, everywhere; 1e-17: nowhere, nowhere"
            ),
            ("patched", "1e-9: 1e0, 1e0; 1e-17: nowhere, nowhere"),
        ]
    );
    let jumps = figures(seams);
    assert!(jumps.len() == 1 && jumps[0].0 == "patched");
    assert!(jumps[0].1.starts_with("8.1e-2 at x = ") || jumps[0].1.starts_with("8.8e-2 at x = "));
    let advice = figures(advice);
    assert_eq!(advice[0], ("1e-9 of the norm, every x", "stable"));
    assert_eq!(
        advice[2],
        ("1e-9 of the norm, x >= 0.01", "all but patched")
    );
    assert_eq!(advice[4], ("1e-17 of the norm, every x", "none"));
}

/// A height that is not the one on record, and one that is missing, are no longer as recorded.
#[test]
fn heights_are_compared_with_those_on_record() {
    let of = "targets = ['1e-9']\nsolvers = ['stable']\n[survey.recorded]\n";
    for (recorded, due) in [
        ("stable = '1e-9: everywhere, everywhere'", true),
        ("stable = '1e-9: 1e-3, everywhere'", false),
        (
            "stable = '1e-9: everywhere, everywhere'\nnaive = '1e-9: 1e-3, 1e-3'",
            false,
        ),
        ("", false),
    ] {
        let found = surveyed(&format!("{of}{recorded}")).unwrap();
        assert_eq!(found[0].as_recorded, due, "{recorded}");
    }
}

#[test]
fn faults_of_surveys_are_named() {
    for (survey, due) in [
        ("targets = []", "a survey has targets"),
        ("targets = ['-1']", "targets are positive numbers"),
        (
            "targets = ['1e-9']\nsolvers = ['none']",
            "there is no such solver",
        ),
        ("targets = ['1e-9']\nregion = 'none'", "no region"),
        (
            "targets = ['1e-9']\ncases = 100000",
            "no number from 0 to 10000",
        ),
    ] {
        let fault = surveyed(survey).unwrap_err();
        assert!(fault.contains(due), "{survey}: {fault}");
    }
}

/// The papers' algorithms are read, and each claim that can be tested has a solver.
#[test]
fn the_algorithms_of_the_atlas() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../reference/atlas");
    let paper = PaperFile::open(&root).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(paper.surveys[0].solvers.len(), 30);
    assert_eq!(paper.accuracies.len(), 72);
}
