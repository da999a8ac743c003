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
    figures.map(|f| (f.name.as_str(), f.value.as_str())).collect()
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
            ("stable", "1e-9: everywhere, everywhere; 1e-17: nowhere, nowhere"),
            ("patched", "1e-9: 1e0, 1e0; 1e-17: nowhere, nowhere"),
        ]
    );
    let jumps = figures(seams);
    assert!(jumps.len() == 1 && jumps[0].0 == "patched");
    assert!(jumps[0].1.starts_with("8.1e-2 at x = ") || jumps[0].1.starts_with("8.8e-2 at x = "));
    let advice = figures(advice);
    assert_eq!(advice[0], ("1e-9 of the norm, every x", "stable"));
    assert_eq!(advice[2], ("1e-9 of the norm, x >= 0.01", "all but patched"));
    assert_eq!(advice[4], ("1e-17 of the norm, every x", "none"));
}

/// A height that is not the one on record, and one that is missing, are no longer as recorded.
#[test]
fn heights_are_compared_with_those_on_record() {
    let of = "targets = ['1e-9']\nsolvers = ['stable']\n[survey.recorded]\n";
    for (recorded, due) in [
        ("stable = '1e-9: everywhere, everywhere'", true),
        ("stable = '1e-9: 1e-3, everywhere'", false),
        ("stable = '1e-9: everywhere, everywhere'\nnaive = '1e-9: 1e-3, 1e-3'", false),
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
        ("targets = ['1e-9']\nsolvers = ['none']", "there is no such solver"),
        ("targets = ['1e-9']\nregion = 'none'", "no region"),
        ("targets = ['1e-9']\ncases = 100000", "no number from 0 to 10000"),
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

use crate::audit::{Method, SolverAnswer};
use crate::reference::faddeeva;
use num_complex::Complex;

#[test]
fn compare_with_rust() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../reference/atlas");
    let start = std::time::Instant::now();
    let paper = PaperFile::open(&root).unwrap_or_else(|e| panic!("{e}"));
    println!("read {:?}", start.elapsed());
    let solvers = &paper.surveys[0].solvers;
    println!("{} solvers, {} accuracies", solvers.len(), paper.accuracies.len());
    for a in mechaudit_atlas::all() {
        let Some((_, study)) = solvers.iter().find(|s| s.0 == a.name) else {
            println!("{} missing", a.name);
            continue;
        };
        let mut sizes = vec![0.0, 1e-300, 1e-20, 1e-9, 1e-5, 1e-3, 0.03];
        sizes.extend((1..90).map(|k| 0.1003 * f64::from(k)));
        sizes.extend((0..12).map(|k| 9.1 * 1.5f64.powi(k)));
        let (mut n, mut exact, mut worst, mut at) = (0, 0, 0.0f64, Complex::new(0.0, 0.0));
        let mut worst_re = 0.0f64;
        let begin = std::time::Instant::now();
        for (i, x) in sizes.iter().enumerate() {
            for (j, y) in sizes.iter().enumerate().filter(|(j, _)| (i + j) % 5 == 0) {
                let x = if (i + j) % 2 == 0 { *x } else { -x };
                let y = if a.plane == mechaudit_atlas::Plane::Whole && j % 3 == 1 && *y < 6.0 { -y } else { *y };
                let z = Complex::new(x, y);
                let due = (a.w)(z);
                let got = match study.solve(&[x, y]) {
                    SolverAnswer::Values(v) => Complex::new(v[0], v[1]),
                    other => panic!("{} {z}: {other:?}", a.name),
                };
                n += 1;
                let same = |a: f64, b: f64| a == b || a.is_nan() && b.is_nan();
                if same(got.re, due.re) && same(got.im, due.im) {
                    exact += 1;
                    continue;
                }
                let off = (got - due).norm() / due.norm();
                let off = if off.is_nan() { f64::INFINITY } else { off };
                worst_re = worst_re.max(((got.re - due.re) / due.re).abs());
                if off > worst {
                    (worst, at) = (off, z);
                }
            }
        }
        println!("{}: {exact}/{n} same, norm off by {worst:e} at {at}, re {worst_re:e}, {:?} each", a.name, begin.elapsed() / n);
    }
    let _ = faddeeva::zero(1, 60);
}
