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
[solver.half]
y = "1/2"
[solver.none]
y = "(x - x)/(x - x)"
"#;

fn paper(claims: &str) -> Result<PaperFile, String> {
    let text = crate::study::intern(&format!("title = 'T'\n{claims}"));
    let shared = "[let]\ns = 'sin(x/2)/x'";
    let texts = vec![
        ("paper.toml", text),
        ("half.toml", STUDY),
        ("shared.toml", shared),
    ];
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
fn claims_hold_in_a_part_and_at_an_input() {
    use FindingVerdict::{Confirmed, Refuted};
    let naive = "study = 'half.toml'\nsolver = 'naive'\nbound = '1e-9'\n";
    for (rest, due) in [
        (
            "part = { x = { from = '0.01' } }\nverdict = 'in part'",
            Refuted,
        ),
        ("at = { x = '1e-6' }\nverdict = 'refuted'", Refuted),
        ("at = { x = 2 }", Confirmed),
        ("region = ['large', 'large']", Confirmed),
    ] {
        assert_eq!(decided(&format!("{naive}{rest}")), (due, true), "{rest}");
    }
    // The part has to be one where it holds.
    let rest = "part = { x = { from = '1e-6' } }\nverdict = 'in part'";
    assert_eq!(decided(&format!("{naive}{rest}")), (Refuted, false));
}

/// The interval of a mean is below the bound, above it, or holds it.
#[test]
fn means_are_decided_by_their_intervals() {
    use FindingVerdict::{Confirmed, Refuted, Unexplained};
    assert_eq!(super::search::mean(&[3.0]), [3.0, 0.0]);
    // The standard error of two values is half their distance.
    assert_eq!(super::search::mean(&[0.0, 1.0]), [0.5, 2.0]);
    let constant = "study = 'half.toml'\nsolver = 'half'\nregion = 'large'\nstatistic = 'mean'\nmeasure = 'absolute'\n";
    for (bound, due) in [
        ("0.5", Confirmed),
        ("0.01", Refuted),
        ("0.1505", Unexplained),
    ] {
        assert_eq!(
            decided(&format!("{constant}bound = '{bound}'")).0,
            due,
            "{bound}"
        );
    }
    // An answer that is no number is no part of a mean.
    let none = constant.replace("'half'\nr", "'none'\nr");
    assert_eq!(decided(&format!("{none}bound = '9'")).0, Unexplained);
}

/// A paper states solvers of its own, with definitions from another file.
#[test]
fn solvers_of_the_paper_itself() {
    let solver = "[solver.own]\nstudy = 'half.toml'\nwith = 'shared.toml'\ny = '2*s^2'\n";
    let own = |more: &str| {
        paper(&format!(
            "{solver}{more}{}",
            claim("solver = 'own'\nbound = '1e-15'")
        ))
    };
    let report = own("").unwrap().report(&|_, _, _| {}).unwrap();
    assert!(report.findings[0].as_recorded);
    for (more, due) in [
        ("[solver.other]\ny = '1'\n", "\"study\" is missing"),
        (
            "[solver.other]\nstudy = 'half.toml'\ny = 'z'\n",
            "the name z is not declared",
        ),
        (
            "[solver.other]\nstudy = 'half.toml'\nwith = 'none.toml'\ny = '1'\n",
            "none.toml",
        ),
        (
            "[solver.naive]\nstudy = 'half.toml'\ny = '1'\n",
            "stated twice",
        ),
    ] {
        let fault = own(more).unwrap_err();
        assert!(fault.contains(due), "{more}: {fault}");
    }
}

#[test]
fn faults_of_claims_are_named() {
    for (rest, due) in [
        ("", "a claim has a bound"),
        ("bound = '1e-9'", "\"solver\" is missing"),
        ("bound = '1e-9'\nsolver = 'naive'", "\"study\" is missing"),
        (
            "bound = '1'\nstudy = 'half.toml'\nsolver = 'naive'\nat = { y = 1 }",
            "there is no key \"y\"",
        ),
        (
            "bound = '1'\nstudy = 'half.toml'\nsolver = 'naive'\npart = { x = { from = 4 } }",
            "no region of the claim has a point",
        ),
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
