//! Tests of `measured`.

use super::*;
use crate::papers::PaperFile;
use crate::study::Place;

fn node(text: &str) -> Node {
    Node {
        place: Place { line: 3, column: 1 },
        value: Value::Text(text.into()),
    }
}

fn measured() -> Measured {
    let mut all = Measured::default();
    let third = &Ball::integer(64, 1) / &Ball::integer(64, 3);
    all.add("third", Quantity::Number(third));
    all.set("half", 0.5);
    all.set("count", 12.0);
    all.add("word", Quantity::Text("M_o".into()));
    all.set("lost", f64::NAN);
    all.set("endless", f64::INFINITY);
    all
}

fn written(text: &str) -> (String, bool) {
    let (measured, definitions) = (measured(), Definitions::read(&["double = 2*half"]).unwrap());
    let names = Names {
        measured: &measured,
        definitions: &definitions,
    };
    Template::read(&node(text)).unwrap().written(&names)
}

#[test]
fn numbers_are_written_in_their_forms() {
    for (text, due) in [
        ("none", "none"),
        ("{half} of {count} in {word}", "0.5 of 12 in M_o"),
        (
            "{third:5}, {third:.2}, {third:.3e}",
            "0.33333, 0.33, 3.333e-1",
        ),
        (
            "{half:+.1e} {-half:+.2} {half - 0.5:.1e}",
            "+5.0e-1 -0.50 0.0e0",
        ),
        ("{100*(1 - half^2):.1} %, {double}", "75.0 %, 1"),
    ] {
        assert_eq!(written(text), (due.to_string(), true), "{text}");
    }
}

/// To more digits than it is known to, or at all.
#[test]
fn numbers_that_are_not_known_are_undecided() {
    for text in [
        "{third:30}",
        "{third:.30}",
        "{lost}",
        "{endless}",
        "{other}",
        "{1/(half - 0.5)}",
        "{word + 1}",
    ] {
        assert_eq!(written(text), ("undecided".into(), false), "{text}");
    }
}

#[test]
fn conditions_hold_if_they_are_known_to() {
    let measured = measured();
    let definitions = Definitions::default();
    let names = Names {
        measured: &measured,
        definitions: &definitions,
    };
    for (text, due) in [
        ("half < third*2", true),
        ("half > third*2", false),
        ("count == 12 and 0.3 < third < 0.4", true),
        ("count == 13", false),
        ("third == 1/3", false),
        ("other < 1", false),
        ("half", false),
        ("{word} {count} is M_o 12", true),
        ("{word} is M_n", false),
        ("{other} is undecided", false),
    ] {
        let condition = Condition::read(&node(text)).unwrap();
        assert_eq!(condition.holds(&names), due, "{text}");
    }
}

#[test]
fn faults_have_their_place() {
    for (text, part) in [
        ("a {half", "a { without its }"),
        ("{half:x}", "the form \"x\" is none of"),
        ("{half:0}", "the form \"0\" is none of"),
        ("{half:.60}", "the form \".60\" is none of"),
        ("{half +}", "\"half +\""),
    ] {
        let e = Template::read(&node(text)).unwrap_err();
        assert!(e.to_string().contains(part), "{e}");
        assert_eq!(e.place, Some(node("").place), "{text}");
    }
}

/// The finding of a paper with a symbol of 1.25 m.
fn finding(text: &str) -> Result<Finding, StudyError> {
    let paper = format!(
        "title = 'T'\n[symbols]\nx = {{ means = 'a length', value = 1.25 }}\n\
         [[claim]]\nid = 'c'\nplace = 'p'\nclaims = 'x'\nis = 'x'\nprinted = '1.25'\n\
         [[measured]]\nid = 'm'\nplace = 'p'\nverdict = 'confirmed'\n{text}"
    );
    let paper = PaperFile::parse("planted", Vec::leak(vec![("paper.toml", intern(&paper))]))?;
    let report = paper.report(&|_, _, _| {}).unwrap();
    Ok(report.findings.into_iter().find(|f| f.id == "m").unwrap())
}

#[test]
fn a_finding_is_its_figures_and_conditions() {
    let words = "title = '{2*x:.2} m'\ntext = 'of {x} m'\n";
    for (figures, due) in [
        ("figures = [['twice', '{2*x}', 'm', '2.5']]", true),
        ("figures = [['twice', '{2*x}', 'm', '2.6']]", false),
        ("figures = [['twice', '{2*x}', 'm']]\nholds = 'x > 1'", true),
        (
            "figures = [['twice', '{2*x}', 'm']]\nholds = ['x > 1', 'x < 1']",
            false,
        ),
        (
            "figures = [['twice', '{2*x}', 'm'], ['{lost}', '1', 'm']]\nholds = 'x > 1'",
            false,
        ),
        (
            "figures = [['twice', '{2*x}', 'm'], 'list']\nholds = 'x > 1'",
            false,
        ),
    ] {
        let found = finding(&format!("{words}{figures}")).unwrap();
        assert_eq!(
            (found.title.as_str(), found.text.as_str()),
            ("2.50 m", "of 1.25 m")
        );
        assert_eq!(found.figures[0].value, "2.5");
        assert_eq!(found.as_recorded, due, "{figures}");
    }
    let unknown = "title = '{y}'\ntext = ''\nfigures = []\nholds = 'x > 1'";
    assert!(!finding(unknown).unwrap().as_recorded);
}

#[test]
fn a_finding_has_something_on_record() {
    for (figures, rule) in [
        (
            "[['twice', '{2*x}', 'm']]",
            "at least one condition or value on record",
        ),
        (
            "[['twice', '{2*x}']]",
            "a figure is [name, value, unit, value on record]",
        ),
    ] {
        let e = finding(&format!("title = ''\ntext = ''\nfigures = {figures}")).unwrap_err();
        assert!(e.to_string().contains(rule), "{e}");
    }
}
