//! Findings that rest on figures.

use crate::papers::file::PaperFile;
use crate::papers::{Analysis, Finding, Found};
use crate::study::intern;

fn paper(head: &str, findings: &str) -> Result<PaperFile, String> {
    let text = format!(
        "title = 'T'\n{head}\n[definitions]\ng = ['a = sqrt(2)']\n\
         [[claim]]\nid = 'c'\nplace = 'p'\nclaims = 'c'\nis = '1'\nprinted = '1'\n{findings}"
    );
    let texts = vec![("paper.toml", intern(&text))];
    PaperFile::parse("planted", texts.leak()).map_err(|e| e.to_string())
}

fn stated(rest: &str) -> String {
    format!(
        "[[finding]]\nid = 'f'\nplace = 'p'\nverdict = 'recovered'\ntitle = 'T {{1}}'\ntext = 't'\n{rest}"
    )
}

/// The finding of that paper with an analysis.
fn found(rest: &str, found: Option<Found>) -> Finding {
    let file = paper("analysis = 'own'", &stated(rest)).unwrap();
    let mut analysis = Analysis::default();
    found.into_iter().for_each(|found| analysis.add("f", found));
    let report = file.analysed(|| Ok(analysis), &|_, _, _| {}).unwrap();
    let mut of = report.findings.into_iter();
    of.find(|f| f.id == "f").unwrap()
}

#[test]
fn figures_are_computed_from_their_expressions() {
    let figure = |value: &str| {
        let rest =
            format!("with = ['g']\nfigures = [{{ name = 'n', value = '{value}', is = '3*a' }}]");
        let file = paper("", &stated(&rest)).unwrap();
        let report = file.report(&|_, _, _| {}).unwrap();
        let f = report.findings.into_iter().find(|f| f.id == "f").unwrap();
        (f.figures[0].value.clone(), f.title, f.as_recorded)
    };
    let right = |value: &str| (value.to_string(), format!("T {value}"), true);
    assert_eq!(figure("4.2426"), right("4.2426"));
    assert_eq!(figure("0.42426407e1"), right("0.42426407e1"));
    let (value, _, as_recorded) = figure("4.2427");
    assert!(value.starts_with("4.24264068") && !as_recorded, "{value}");
}

#[test]
fn figures_of_the_analysis_are_compared_with_those_on_record() {
    let rest = "words = ['w']\nfigures = [\n{ name = 'n', unit = 'm', value = 'x' },\n\
                { name = 's', value = '1.414', is = 'sqrt(2)' },\n{ name = 'o', value = 'y' }]";
    let values = |values: &[&str], holds| {
        let values: Vec<String> = values.iter().map(|v| v.to_string()).collect();
        Some(Found::values(values, holds))
    };
    let worded = |found: Option<Found>, word: &str| found.map(|f| f.worded([word.to_string()]));
    let good = found(rest, worded(values(&["x", "y"], true), "w"));
    assert!(good.as_recorded);
    let shown = good.figures.iter().map(|g| (&*g.name, &*g.value, g.unit));
    let due = [("n", "x", "m"), ("s", "1.414", "1"), ("o", "y", "1")];
    assert_eq!(
        (shown.collect::<Vec<_>>(), &*good.title),
        (due.to_vec(), "T w")
    );
    for off in [
        None,
        worded(values(&["x", "y"], true), "v"),
        values(&["x", "y"], true),
        worded(values(&["x", "y"], false), "w"),
        worded(values(&["x", "z"], true), "w"),
        worded(values(&["x"], true), "w"),
        worded(values(&["x", "y", "z"], true), "w"),
    ] {
        assert!(!found(rest, off).as_recorded);
    }
    // Without a list those of the analysis stand as they are, known and at least one.
    assert!(found("", values(&["x"], true)).as_recorded);
    assert!(!found("", values(&[], true)).as_recorded);
    assert!(!found("", values(&["undecided"], true)).as_recorded);
}

#[test]
fn a_finding_that_no_file_states_is_not_as_recorded() {
    let file = paper("analysis = 'own'", "").unwrap();
    let mut analysis = Analysis::default();
    analysis.add("more", Found::new([], true));
    let report = file.analysed(|| Ok(analysis), &|_, _, _| {}).unwrap();
    assert!(!report.as_recorded());
}

#[test]
fn faults_of_findings_are_named() {
    for (head, rest, due) in [
        (
            "",
            "",
            "a finding rests on entries, on the ledger, or on figures",
        ),
        (
            "",
            "figures = [{ name = 'n', value = '1' }]",
            "a finding rests on entries",
        ),
        ("", "entries = []", "a finding rests on at least one entry"),
        ("", "entries = ['e']", "there is no entry"),
        ("", "ledger = 'proved'", "f: the paper has no entries"),
        ("", "ledger = 'all'", "none of: whole, proved"),
        (
            "",
            "figures = [{ name = 'n', value = 'x', is = '1' }]",
            "a decimal number",
        ),
        (
            "",
            "figures = [{ name = 'n', value = '1', is = '1 +' }]",
            "expected",
        ),
        (
            "analysis = 'own'",
            "figures = [{ name = 'n' }]",
            "\"value\" is missing",
        ),
    ] {
        let fault = paper(head, &stated(rest)).err();
        let fault = fault.unwrap_or_else(|| panic!("{rest} is read"));
        assert!(fault.contains(due), "{rest}: {fault}");
    }
}
