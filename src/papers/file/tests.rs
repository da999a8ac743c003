//! Papers in texts: the skeleton, and faults with their places.

use super::*;
use crate::papers::ledger::{Verdict, decide};
use crate::papers::{EntryVerdict, FindingVerdict};

/// A paper of one file, kept for the test.
fn paper(text: &str) -> Result<PaperFile, StudyError> {
    with_table(text, "")
}

fn with_table(text: &str, table: &str) -> Result<PaperFile, StudyError> {
    let kept = |text: &str| -> &'static str { crate::study::intern(text) };
    let texts = vec![("paper.toml", kept(text)), ("t.csv", kept(table))];
    PaperFile::parse("planted", Vec::leak(texts))
}

/// A paper with these symbols and one entry.
fn entry(symbols: &str, entry: &str) -> PaperFile {
    let text =
        format!("title = 'T'\n[symbols]\n{symbols}\n[[entry]]\nid = 'e'\nplace = 'p'\n{entry}");
    paper(&text).unwrap()
}

fn verdict(symbols: &str, text: &str) -> Verdict {
    decide(&entry(symbols, text).items[0]).verdict
}

#[test]
fn the_skeleton_is_a_paper_with_its_verdicts_on_record() {
    let file = PaperFile::parse("skeleton", SKELETON).unwrap();
    assert_eq!(
        (file.items.len(), file.tables.len(), file.claims.len()),
        (10, 1, 2)
    );
    let ledger = file.ledger();
    let open: Vec<&str> = ledger
        .entries
        .iter()
        .filter(|e| !e.as_recorded)
        .map(|e| e.id)
        .collect();
    assert!(open.is_empty(), "{open:?}");
    assert_eq!(
        (
            ledger.count(Verdict::Proved),
            ledger.count(Verdict::Misprint)
        ),
        (8, 1)
    );
    let report = file.report(&|_, _, _| {}).unwrap();
    let changed: Vec<(&str, &str)> = report
        .findings
        .iter()
        .filter(|f| !f.as_recorded)
        .map(|f| (f.id, f.title.as_str()))
        .collect();
    assert!(changed.is_empty(), "{changed:?}");
    assert_eq!(report.entries.len(), 22);
    let misprints = report
        .entries
        .iter()
        .filter(|e| e.variants["as_printed"].verdict == EntryVerdict::Misprint);
    let misprints: Vec<(u32, &str, &str)> = misprints
        .map(|e| (e.row, e.column, e.printed.as_str()))
        .collect();
    assert_eq!(misprints, [(4, "a", "5.9775")]);
}

/// Returns true if the skeleton is as recorded with one text in place of another.
fn as_recorded(old: &str, new: &str) -> bool {
    let text = SKELETON[0].1;
    let new = text.replacen(old, new, 1);
    assert_ne!(new, text, "{old}");
    let texts = vec![("paper.toml", crate::study::intern(&new)), SKELETON[1]];
    let file = PaperFile::parse("k", Vec::leak(texts)).unwrap();
    file.report(&|_, _, _| {}).unwrap().as_recorded()
}

#[test]
fn rows_that_change_are_no_longer_as_recorded() {
    for rows in ["3", ""] {
        assert!(!as_recorded("wrong = [4]", &format!("wrong = [{rows}]")));
    }
}

#[test]
fn an_outcome_that_changes_is_no_longer_as_recorded() {
    for (old, new) in [("6.28", "6.29"), ("1.82", "1.81")] {
        let printed = |number: &str| format!("printed = \"{number}\"");
        assert!(!as_recorded(&printed(old), &printed(new)), "{old}");
    }
}

#[test]
fn a_repair_that_changes_is_no_longer_as_recorded() {
    let repair = "sin(2*pi*x)\"\nnote";
    assert!(!as_recorded(repair, &repair.replace('2', "3")));
}

/// A formula or statement whose verdict is not the one on record is told.
#[test]
fn what_changes_is_no_longer_as_recorded() {
    for (old, new) in [
        ("within 0.00005", "within 0.0000005"),
        (
            "at(v, x, 1/2) = h*omega/beta\" }",
            "at(v, x, 1/2) = 2*h*omega/beta\" }",
        ),
        ("(omega/beta)^3*cos", "(omega/beta)^2*cos"),
    ] {
        assert!(!as_recorded(old, new), "{old}");
    }
}

#[test]
fn faults_name_place_and_rule() {
    let head = "title = 'T'\n[symbols]\nx = 'a number'\n";
    let an_entry = |text: &str| format!("{head}[[entry]]\nid = 'e'\nplace = 'p'\n{text}");
    for (text, line, rule) in [
        (
            an_entry("printed = 'y = z'\nrequires = 'y = x'"),
            7,
            "the name z is not declared",
        ),
        (
            an_entry("printed = 'y = x'\nrequires = 'y = q'"),
            8,
            "the name q is not declared",
        ),
        (
            an_entry("printed = 'y = x'"),
            4,
            "the entry e has no requirement",
        ),
        (
            an_entry("printed = 'y = x'\nverdict = 'model'"),
            4,
            "has no requirement",
        ),
        (
            an_entry("printed = 'y = (x'\nrequires = 'y = x'"),
            7,
            "expected",
        ),
        (an_entry("printed = 'y'\nrequires = 'x = x'"), 7, "expected"),
        (an_entry("requires = 'x ~ 1'"), 7, "within"),
        (
            an_entry("requires = 'y = x'\nwith = ['y = w', 'w = y']"),
            8,
            "leads back to",
        ),
        (
            an_entry("printed = 'y = y + x'\nrequires = 'y = x'"),
            7,
            "leads back to y",
        ),
        (
            an_entry("requires = 'y = x'\nwith = ['y = 1', 'y = 2']"),
            8,
            "y is defined twice",
        ),
        (
            an_entry("requires = 'x = x'\nwith = ['grop']"),
            8,
            "neither a definition",
        ),
        (
            an_entry("requires = 'x = x'\nverdict = 'true'"),
            8,
            "is none of: proved",
        ),
        (
            an_entry("requires = 'x = x'\nvedict = 'proved'"),
            8,
            "there is no key \"vedict\"",
        ),
        (
            an_entry("requires = 'x = x'\nedits = 3"),
            8,
            "is no number from 0 to 2",
        ),
        (
            an_entry("requires = 'x = x'\nrepair = 'x = x'"),
            8,
            "a repair belongs to",
        ),
        (
            an_entry("requires = 'x = x'\n[[entry]]\nid = 'e'\nplace = 'p'\nrequires = 'x = x'"),
            9,
            "is taken",
        ),
        (
            format!("{head}y = {{ unit = 'm' }}"),
            4,
            "\"means\" is missing",
        ),
        (
            format!("{head}y = {{ means = 'm', domain = [1, 0] }}"),
            4,
            "the domain is empty",
        ),
        (
            format!("{head}y = {{ means = 'm', domain = 'complex' }}"),
            4,
            "is none of",
        ),
        (
            format!("{head}y = {{ means = 'm', value = 'three' }}"),
            4,
            "three is not declared",
        ),
        (
            format!("{head}a_name_of_too_many = 'm'"),
            4,
            "more than 16 characters",
        ),
        (format!("{head}pi = 'm'"), 4, "has a meaning of its own"),
        ("[[entry]]\nid = 'e'".into(), 1, "\"title\" is missing"),
        ("title = 'T'".into(), 0, "at least one [[entry]]"),
        (
            "title = 'T'\nparts = ['../x.toml']".into(),
            2,
            "not the name of a file",
        ),
        (
            "title = 'T'\nparts = ['none.toml']".into(),
            2,
            "there is no file",
        ),
        ("title = ".into(), 1, ""),
    ] {
        let error = paper(&text).expect_err(&text);
        let found = error.to_string();
        assert!(found.contains(rule), "{text}\n{found}");
        assert_eq!(error.place.map_or(0, |p| p.line), line, "{text}\n{found}");
        assert_eq!(error.file.as_deref(), Some("paper.toml"), "{found}");
        assert!(!found.contains('\n') || rule.is_empty(), "{found}");
    }
}

#[test]
fn faults_of_tables_name_the_line_of_the_file() {
    let text =
        "title = 'T'\n[[table]]\nnumber = 1\nfile = 't.csv'\ngiven = 'x'\ncolumns = { y = '2*x' }";
    assert!(with_table(text, "x,y\n1,2\n").is_ok());
    for (table, rule) in [
        (
            "# a remark\nx,y\n1,2\n3\n",
            "t.csv: line 4: the row has 1 cells where the head has 2",
        ),
        (
            "x,y\n1,2,3\n",
            "t.csv: line 2: the row has 3 cells where the head has 2",
        ),
        (
            "x,y\n1,two\n",
            "t.csv: line 2: column y: \"two\" is no number",
        ),
        ("x,y\n,2\n", "t.csv: line 2: column x: \"\" is no number"),
        ("x,z\n1,2\n", "t.csv has no column \"y\"; there are: x, z"),
        ("x,y\n", "the table has no rows"),
        ("", "the table has no rows"),
    ] {
        let found = with_table(text, table).expect_err(table).to_string();
        assert!(found.contains(rule), "{table}: {found}");
    }
    for (old, new, rule) in [
        ("'2*x'", "'2*z'", "z"),
        ("'2*x'", "'2*('", "expected"),
        (
            "'2*x'",
            "{ is = '2*x', wrong = [7] }",
            "the table has no row 7",
        ),
        (
            "'2*x'",
            "{ is = '2*x', rounding = 'up' }",
            "is none of: nearest",
        ),
        (
            "file = 't.csv'",
            "file = '/etc/hostname'",
            "not the name of a file",
        ),
        ("{ y = '2*x' }", "{}", "at least one column"),
    ] {
        let found = with_table(&text.replace(old, new), "x,y\n1,2\n")
            .expect_err(new)
            .to_string();
        assert!(found.contains(rule), "{new}: {found}");
    }
}

/// Numbers are right by the rule of their column, and a value without digits is never right.
#[test]
fn digits_are_judged_by_the_rule_of_the_column() {
    let of = |rule: &str, definition: &str, table: &str| {
        let text = format!(
            "title = 'T'\n[[table]]\nnumber = 1\nfile = 't.csv'\ngiven = 'x'\nrounding = '{rule}'\n\
             columns = {{ y = '{definition}' }}"
        );
        let report = with_table(&text, table)
            .unwrap()
            .report(&|_, _, _| {})
            .unwrap();
        (report.findings[0].verdict, report.as_recorded())
    };
    let (yes, no) = (
        (FindingVerdict::Confirmed, true),
        (FindingVerdict::ErrorOfPaper, false),
    );
    let third = |printed: &str| format!("x,y\n2,{printed}\n");
    assert_eq!(of("nearest", "x/3", &third("0.667")), yes);
    assert_eq!(of("nearest", "x/3", &third("0.666")), no);
    assert_eq!(of("last-digit", "x/3", &third("0.666")), yes);
    assert_eq!(of("last-digit", "x/3", &third("0.665")), no);
    assert_eq!(of("cut", "x/3", &third("0.666")), yes);
    assert_eq!(of("cut", "x/3", &third("0.667")), no);
    assert_eq!(of("cut", "-x/3", &third("-0.666")), yes);
    assert_eq!(of("cut", "-x/3", &third("-0.667")), no);
    // Exactly zero, undefined, and an empty cell, which leaves nothing to judge.
    assert_eq!(of("nearest", "x - 2", &third("0.00")), yes);
    assert!(!of("nearest", "1/(x - 2)", &third("0.00")).1);
    assert!(!of("nearest", "x/3", &third("")).1);
}

/// A claim is confirmed or refuted by a proved bound of the extreme, and by an exact value.
#[test]
fn claims_are_judged_by_their_numbers() {
    let of = |text: &str| {
        let text = format!("title = 'T'\n[[claim]]\nid = 'c'\nplace = 'p'\nclaims = 'C.'\n{text}");
        let report = paper(&text).unwrap().report(&|_, _, _| {}).unwrap();
        report.findings[0].verdict
    };
    let (yes, no) = (FindingVerdict::Confirmed, FindingVerdict::Refuted);
    assert_eq!(of("is = 'exp(1)'\nprinted = '2.718'"), yes);
    assert_eq!(of("is = 'exp(1)'\nprinted = '2.719'"), no);
    assert_eq!(
        of("is = 'exp(1)'\nprinted = '2.719'\nrounding = 'last-digit'"),
        yes
    );
    assert_eq!(of("is = '1/2'\nbelow = '0.5'\nabove = '0.5'"), yes);
    assert_eq!(of("is = '1/2'\nbelow = '0.49'"), no);
    let largest = "largest = 'x*(1 - x)'\nover = { x = [0, 1] }\n";
    assert_eq!(of(&format!("{largest}printed = '0.2500'")), yes);
    assert_eq!(of(&format!("{largest}printed = '0.2501'")), no);
    let smallest = "smallest = 'x^2 + y^2 + 1'\nover = { x = [-1, 1], y = [-1, 1] }\n";
    assert_eq!(of(&format!("{smallest}printed = '1.0'")), yes);
    assert_eq!(of(&format!("{smallest}above = '1.1'")), no);
    // A pole in the box is never bounded.
    assert_eq!(
        of("largest = '1/x'\nover = { x = [-1, 1] }\nprinted = '1'"),
        FindingVerdict::Unexplained
    );
}

/// Proved is proved on the whole domain, and refuted is refuted at a point of it.
#[test]
fn domains_decide_what_is_proved() {
    let real = "x = { means = 'a', domain = 'real' }";
    let positive = "x = 'a'";
    let between = "x = { means = 'a', domain = [-2, -1] }";
    let integer = "n = { means = 'a', domain = 'integer' }";
    let unit = "x = { means = 'a', domain = [0, 1] }";
    let root = "requires = 'sqrt(x^2) = x'";
    let (yes, no) = (Verdict::Proved, Verdict::Refuted);
    for (symbols, text, due) in [
        (positive, root, yes),
        (real, root, no),
        (between, root, no),
        (between, "requires = 'sqrt(x^2) = -x'", yes),
        (real, "requires = 'sin(-x) = -sin(x)'", yes),
        (
            real,
            "printed = 'y = x^3'\nrequires = 'D(y, x) = 3*x^2'",
            yes,
        ),
        (
            real,
            "printed = 'y = x^3'\nrequires = 'D(y, x) = 3*x*abs(x)'",
            no,
        ),
        // True at the one point that is not zero's side.
        (real, "requires = 'x/x = 1'", yes),
        ("n = 'a'", "requires = 'sin(pi*n) = 0'", no),
        // Inequalities are proved over bounded boxes.
        (unit, "requires = 'x*(1 - x) < 0.2501'", yes),
        (unit, "requires = 'x*(1 - x) < 0.2'", no),
        (unit, "requires = 'sin(x) ~ x within 0.16'", yes),
        (positive, "requires = 'x < x + 1'", Verdict::Undecided),
    ] {
        assert_eq!(verdict(symbols, text), due, "{text}");
    }
    // It fails next to 1/2 alone, where no sample lies.
    let near = verdict(unit, "requires = 'x*(1 - x) < 0.24999'");
    let sine = verdict(integer, "requires = 'sin(pi*n) = 0'");
    assert!(near != yes && sine != no);
    // The witness is a point of the domain.
    let found = decide(&entry(between, root).items[0]);
    let point = &found.obligations[0].witness.as_ref().unwrap().point;
    let value = crate::reference::Decimal::parse("0").unwrap().value
        + point[0].1.parse::<rug::Rational>().unwrap();
    assert!((-2..=-1).contains(&value), "{point:?}");
}

/// The printed values are put in after derivatives.
#[test]
fn values_are_put_in_where_the_entry_asks_for_them() {
    let symbols = "g = { means = 'a', value = '9.81' }\nt = { means = 'b', value = '2' }\nz = { means = 'c', value = '-1.5' }";
    let printed = "printed = 's = g*t^2/2'\n";
    for (text, due) in [
        ("values = true\nrequires = 's = 19.62'", Verdict::Proved),
        (
            "values = true\nrequires = 'D(s, t) = 19.62'",
            Verdict::Proved,
        ),
        ("requires = 's = 19.62'", Verdict::Refuted),
        ("values = true\nrequires = 'z*t = -3'", Verdict::Proved),
    ] {
        let found = verdict(symbols, &format!("{printed}{text}"));
        assert_eq!(found, due, "{text}");
    }
}
