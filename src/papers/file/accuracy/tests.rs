//! Tests of claims about algorithms.

use super::super::PaperFile;
use crate::papers::FindingVerdict;

/// (1 − cos x)/x² as it stands, and by the half angle.
const STUDY: &str = r#"
[inputs]
x = { from = "1e-9", to = 3, spacing = "log" }
[outputs]
y = { is = "(1 - cos(x))/x^2", budget = "8 ulp", why = "a test" }
[[region]]
name = "large"
x = { from = 1, to = 3 }
[solver.naive]
y = "(1 - cos(x))/x^2"
[solver.stable]
y = "2*(sin(x/2)/x)^2"
"#;

fn paper(claims: &str) -> Result<PaperFile, String> {
    let text = crate::study::intern(&format!("title = 'T'\n{claims}"));
    let texts = vec![("paper.toml", text), ("half.toml", STUDY)];
    PaperFile::parse("planted", texts.leak()).map_err(|e| e.to_string())
}

fn claim(rest: &str) -> String {
    format!("[[accuracy]]\nid = 'c'\nplace = 'p'\nclaims = 'It is accurate.'\n{rest}\n")
}

/// The verdict, and whether it is the recorded one.
fn decided(rest: &str) -> (FindingVerdict, bool) {
    let report = paper(&claim(rest)).unwrap().report(&|_, _, _| {}).unwrap();
    let found = report.findings.iter().find(|f| f.id == "c").unwrap();
    (found.verdict, found.as_recorded)
}

#[test]
fn claims_are_held_or_refuted_by_an_input() {
    use FindingVerdict::{Confirmed, Refuted};
    let stable = "study = 'half.toml'\nsolver = 'stable'\n";
    let naive = "study = 'half.toml'\nsolver = 'naive'\n";
    assert_eq!(
        decided(&format!("{stable}bound = '1e-15'")),
        (Confirmed, true)
    );
    assert_eq!(
        decided(&format!("{stable}bound = '1e-17'")),
        (Refuted, false)
    );
    assert_eq!(
        decided(&format!("{naive}bound = '1e-9'\nverdict = 'refuted'")),
        (Refuted, true)
    );
    assert_eq!(
        decided(&format!("{naive}bound = '1e-14'\nregion = 'large'")),
        (Confirmed, true)
    );
    let absolute = format!("{naive}bound = '0.6'\nmeasure = 'absolute'\noutput = 'y'");
    assert_eq!(decided(&absolute), (Confirmed, true));
    assert_eq!(
        decided(&format!("{stable}bound = '1e-15'\nstatistic = 'mean'")),
        (Confirmed, true)
    );
    assert!(decided("verdict = 'not testable'").1);
}

#[test]
fn faults_of_claims_are_named() {
    for (rest, due) in [
        ("", "a claim has a bound"),
        ("bound = '1e-9'", "\"study\" is missing"),
        (
            "bound = '-1'\nstudy = 'half.toml'\nsolver = 'naive'",
            "a bound is a positive number",
        ),
        (
            "bound = '1'\nstudy = 'none.toml'\nsolver = 'naive'",
            "none.toml",
        ),
        (
            "bound = '1'\nstudy = 'half.toml'\nsolver = 'stabel'",
            "there is no solver \"stabel\"",
        ),
        (
            "bound = '1'\nstudy = 'half.toml'\nsolver = 'naive'\nregion = 'lrage'",
            "lrage",
        ),
        (
            "bound = '1'\nstudy = 'half.toml'\nsolver = 'naive'\nmeasure = 'size'",
            "none of: relative",
        ),
    ] {
        let fault = paper(&claim(rest)).unwrap_err();
        assert!(fault.contains(due), "{rest}: {fault}");
    }
}
