//! Findings of planted papers.

use super::*;
use crate::papers::{PaperFile, PaperReport};

/// A paper with a symbol of 1.25 m, an entry that is proved and one that is not, and a finding.
fn paper(head: &str, finding: &str) -> Result<PaperFile, StudyError> {
    let text = format!(
        "title = 'T'\n{head}\n[symbols]\nx = {{ means = 'a length', value = 1.25 }}\ny = 'free'\n\
         [definitions]\ng = ['a = sqrt(2)']\n\
         [[entry]]\nid = 'e'\nplace = 'p'\nrequires = 'x = x'\n\
         [[entry]]\nid = 'h'\nplace = 'p'\nrequires = 'x = 2*x'\nverdict = 'refuted'\n\
         [[finding]]\nid = 'f'\nplace = 'p'\nverdict = 'recovered'\n{finding}"
    );
    let texts = vec![("paper.toml", intern(&text))];
    PaperFile::parse("planted", texts.leak())
}

const WORDS: &str = "title = 'T'\ntext = 't'\n";

fn one(report: PaperReport) -> Finding {
    let mut all = report.findings.into_iter();
    all.find(|f| f.id == "f").unwrap()
}

/// The finding of that paper, without an analysis.
fn plain(finding: &str) -> Finding {
    let file = paper("", finding).unwrap_or_else(|e| panic!("{finding}: {e}"));
    one(file.report(&|_, _, _| {}).unwrap())
}

/// The finding of that paper with what an analysis measures.
fn found(finding: &str) -> Finding {
    let third = &Ball::integer(64, 1) / &Ball::integer(64, 3);
    let mut measured = Measured::default();
    measured.add("third", Quantity::Number(third));
    measured.add("print", Quantity::Printed(Number::read("1.50")));
    measured.add("ratio", Quantity::Exact(Rational::from((6, 4))));
    measured.text("word", "M_o");
    measured.add("none", Quantity::Figures(Vec::new()));
    for (name, value) in [("list", "1"), ("open", "undecided")] {
        measured.add(name, Quantity::Figures(vec![figure("n", value, "1")]));
    }
    for (name, x) in [("half", 0.5), ("count", 12.0), ("lost", f64::NAN)] {
        measured.set(name, x);
    }
    let file = paper("analysis = 'own'", finding).unwrap_or_else(|e| panic!("{finding}: {e}"));
    one(file.analysed(|| Ok(measured), &|_, _, _| {}).unwrap())
}

/// A text of a finding, and whether every number in it is known.
fn written(text: &str) -> (String, bool) {
    let found = found(&format!("title = '{text}'\ntext = ''\nholds = '1 < 2'"));
    (found.title, found.as_recorded)
}

#[test]
fn numbers_are_written_in_their_forms() {
    for (text, due) in [
        ("none", "none"),
        ("m_{{n+1}} = {half}", "m_{n+1} = 0.5"),
        ("{half} of {count} in {word}", "0.5 of 12 in M_o"),
        (
            "{third:5}, {third:.2}, {third:.3e}",
            "0.33333, 0.33, 3.333e-1",
        ),
        (
            "{half:+.1e} {-half:+.2} {half - 0.5:.1e}",
            "+5.0e-1 -0.50 0.0e0",
        ),
        ("{100*(1 - half^2):.1} %, {2*x}", "75.0 %, 2.5"),
        ("{print}, {2*print}, {print:.1}", "1.50, 3, 1.5"),
        ("{ratio:/}, {ratio/3 - 1:/}, {x:/}", "3/2, -1/2, 5/4"),
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
        "{third:/}",
        "{lost}",
        "{other}",
        "{1/(half - 0.5)}",
        "{word + 1}",
    ] {
        assert_eq!(written(text), ("undecided".into(), false), "{text}");
    }
}

#[test]
fn conditions_hold_if_they_are_known_to() {
    for (text, due) in [
        ("half < third*2", true),
        ("half > third*2", false),
        ("count == 12 and 0.3 < third < 0.4", true),
        ("count == 13", false),
        ("third == 1/3", false),
        ("ratio == 3/2", true),
        ("other < 1", false),
        ("half", false),
        ("{word} {count} is M_o 12", true),
        ("{word} is M_n", false),
        ("{other} is undecided", false),
    ] {
        let holds = found(&format!("{WORDS}holds = '{text}'")).as_recorded;
        assert_eq!(holds, due, "{text}");
    }
}

#[test]
fn a_finding_is_its_figures_and_conditions() {
    for (figures, due) in [
        ("figures = [['twice', '{2*x}', 'm', '2.5']]", true),
        ("figures = [['twice', '{2*x}', 'm', '2.6']]", false),
        ("figures = [['twice', '{2*x}', 'm']]\nholds = 'x > 1'", true),
        ("holds = ['x > 1', 'x < 1']", false),
        (
            "with = 'g'\nfigures = [['n', '{3*a:5}', '1', '4.2426']]",
            true,
        ),
        (
            "with = 'g'\nfigures = [['n', '{3*a:5}', '1', '4.2427']]",
            false,
        ),
    ] {
        let found = plain(&format!(
            "title = '{{2*x:.2}} m'\ntext = '{{x}}'\n{figures}"
        ));
        assert_eq!((&*found.title, &*found.text), ("2.50 m", "1.25"));
        assert_eq!(found.as_recorded, due, "{figures}");
    }
    for (list, due) in [
        ("list", true),
        ("open", false),
        ("none", false),
        ("more", false),
    ] {
        let found = found(&format!("{WORDS}figures = ['{list}']"));
        assert_eq!(found.as_recorded, due, "{list}");
    }
}

/// Their numbers are known, and stand in place of a list of them where figures ask for it.
#[test]
fn findings_rest_on_entries() {
    let counts = "{recorded} of {entries} hold, {proved} proved";
    for (basis, title, figures) in [
        ("entries = ['e', 'h']", "2 of 2 hold, 1 proved", 2),
        ("entries = 'h'", "1 of 1 hold, 0 proved", 1),
        ("ledger = 'whole'", "2 of 2 hold, 1 proved", 2),
        (
            "entries = ['e', 'h']\nfigures = [['n', '{proved}', '1', '1']]",
            "2 of 2 hold, 1 proved",
            1,
        ),
    ] {
        let found = plain(&format!("title = '{counts}'\ntext = ''\n{basis}"));
        assert_eq!((&*found.title, found.figures.len()), (title, figures));
        assert!(found.as_recorded, "{basis}");
    }
    let off = "entries = 'e'\nfigures = [['n', '{proved}', '1', '2']]";
    assert!(!plain(&format!("{WORDS}{off}")).as_recorded);
}

#[test]
fn faults_of_findings_have_their_place() {
    for (rest, due) in [
        ("title = 'a {x'\ntext = ''", "a { without its }"),
        ("title = '{x:a}'\ntext = ''", "the form \"a\" is none of"),
        ("title = '{x:0}'\ntext = ''", "the form \"0\" is none of"),
        (
            "title = '{x:.60}'\ntext = ''",
            "the form \".60\" is none of",
        ),
        ("title = '{x +}'\ntext = ''", "expected"),
        ("title = '{z}'\ntext = ''", "z is not declared"),
        (
            "title = '{y}'\ntext = ''\nholds = 'x > 1'",
            "y has no value",
        ),
        ("title = 'T'\ntext = 't'", "a finding rests on entries"),
        (
            "title = 'T'\ntext = 't'\nentries = []",
            "at least one entry",
        ),
        (
            "title = 'T'\ntext = 't'\nentries = ['n']",
            "there is no entry",
        ),
        (
            "title = 'T'\ntext = 't'\nledger = 'all'",
            "none of: whole, proved",
        ),
        (
            "title = 'T'\ntext = 't'\nfigures = [['twice', '{2*x}', 'm']]",
            "at least one condition or value on record",
        ),
        (
            "title = 'T'\ntext = 't'\nfigures = ['list']",
            "a figure is [name, value, unit, value on record]",
        ),
        (
            "title = 'T'\ntext = 't'\nfigures = [['twice', '{2*x}']]",
            "a figure is [name, value, unit, value on record]",
        ),
    ] {
        let e = paper("", rest)
            .err()
            .unwrap_or_else(|| panic!("{rest} is read"));
        assert!(e.to_string().contains(due), "{rest}: {e}");
        assert!(e.place.is_some() && e.file.is_some(), "{rest}: {e}");
    }
}
