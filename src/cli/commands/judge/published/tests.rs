use super::*;
use crate::cli::ran;
use mechaudit::methods;
use mechaudit::report::text::style::plain;
use serde_json::Value;
use std::error::Error;

/// erf 0.5 = 0.52049987781304653768…, erf 1 = 0.84270079294971486934…: an entry that agrees, one
/// whose last digit is off by one, and one that is 27 units off.
const ERF: &str = "Re z,Im z,Re erf\n0.5,0,0.5205\n# a note\n0.5,0,0.5204\n1,0,0.8400\n";

/// Judges a table in a file: what it came to, the report, and the table's place.
fn judged_as(method: &str, text: &str, more: &[&str]) -> (Result<Outcome, String>, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let [table, file] = ["a table.csv", "report"].map(|n| folder.path().join(n));
    std::fs::write(&table, text).unwrap();
    let [table, output] = [&table, &file].map(|p| p.to_str().unwrap());
    let words = ["judge", method, "--table", table, "--output", output];
    let outcome = ran(&[&words[..], more].concat()).map_err(|e| e.to_string());
    let report = std::fs::read_to_string(&file).unwrap_or_default();
    (outcome, report, table.to_string())
}

#[test]
fn entries_that_do_not_agree_are_listed() {
    let (outcome, text, _) = judged_as("erf", ERF, &[]);
    assert_eq!(outcome, Ok(Outcome::Finding));
    let due = "\
erf  FAIL  2 of 3 entries do not agree within half a unit of their last digit
  last digit off by one: 1, farther off: 1, undecided: 0, no such value: 0
  line  output  printed               reference  units off
     4  Re erf   0.5204  0.52049987781304653768     -0.999
     5  Re erf   0.8400  0.84270079294971486934     -27.01
";
    let squeezed = |text: &str| -> Vec<String> {
        let words = |l: &str| l.split_whitespace().collect::<Vec<_>>().join(" ");
        text.lines().map(words).collect()
    };
    assert_eq!(squeezed(&text), squeezed(due));
    let right = ERF
        .replace("0.5204\n", "0.520500\n")
        .replace("0.8400", "0.8427");
    let (outcome, text, _) = judged_as("erf", &right, &[]);
    assert_eq!(outcome, Ok(Outcome::AsExpected));
    let due = "\
erf  pass  3 of 3 entries agree within half a unit of their last digit
  last digit off by one: 0, farther off: 0, undecided: 0, no such value: 0
";
    assert_eq!(text, due);
}

/// Half a unit is the budget of each entry, and the row a case.
#[test]
fn a_table_is_a_report_of_cases() {
    let (outcome, text, path) = judged_as("erf", ERF, &["--format", "json"]);
    assert_eq!(outcome, Ok(Outcome::Finding));
    let v: Value = serde_json::from_str(&text).unwrap();
    let m = &v["methods"][0];
    assert_eq!((&m["cases"], &m["passed"]), (&3.into(), &1.into()));
    let candidate = &m["candidate"];
    assert_eq!(candidate["name"], format!("table {path}"));
    assert_eq!(candidate["answered"], 3);
    let share = m["total"]["outputs"][0]["max_of_budget"].as_f64().unwrap();
    assert!((share - 2.0 * 27.0079294971487).abs() < 1e-9, "{share}");
    let failures = m["failures"].as_array().unwrap();
    let again: Vec<&str> = failures
        .iter()
        .map(|f| f["reproduce"].as_str().unwrap())
        .collect();
    let command = |line: u32| format!("mechaudit judge erf --table '{path}' --line {line}");
    assert!(
        again.len() == 2 && again.contains(&&*command(4)) && again.contains(&&*command(5)),
        "{again:?}"
    );
    for f in failures {
        let reason = f["judgement"]["reason"].as_str().unwrap();
        assert!(
            reason.starts_with("Re erf is 0.") && reason.contains(", expected 0."),
            "{reason}"
        );
    }
    let entries = v["entries"].as_array().unwrap();
    let all: Vec<Value> = entries
        .iter()
        .map(|e| {
            json!([
                e["line"],
                e["output"],
                e["printed"],
                e["judgement"]["agreement"]
            ])
        })
        .collect();
    let due = [
        json!([2, "Re erf", "0.5205", "agrees"]),
        json!([4, "Re erf", "0.5204", "last_digit"]),
        json!([5, "Re erf", "0.8400", "differs"]),
    ];
    assert_eq!(all, due);
}

/// A singular system has no solution to print.
#[test]
fn an_entry_without_a_value_is_wrong_in_kind() {
    let text =
        "diagonal[0],diagonal[1],lower[0],upper[0],d[0],d[1],x[0],x[1]\n1,1,1,1,1,1,0.3,0.3\n";
    let (outcome, shown, _) = judged_as("tridiagonal", text, &[]);
    assert_eq!(outcome, Ok(Outcome::Finding));
    assert!(
        shown.contains("2 of 2 entries do not agree") && shown.contains("no such value: 2\n"),
        "{shown}"
    );
    assert_eq!(shown.matches('–').count(), 2, "{shown}");
    let (_, json, _) = judged_as("tridiagonal", text, &["--format", "json"]);
    let v: Value = serde_json::from_str(&json).unwrap();
    let m = &v["methods"][0];
    assert_eq!(
        m["failures"][0]["judgement"]["reason"],
        "x is 0.3, expected the reference refuses: singular"
    );
    assert_eq!((&m["cases"], &m["passed"]), (&1.into(), &0.into()));
}

#[test]
fn one_row_is_judged_by_its_line() {
    let of = |line: &str| judged_as("erf", ERF, &["--line", line]);
    let (outcome, text, _) = of("2");
    assert_eq!(outcome, Ok(Outcome::AsExpected));
    assert!(text.starts_with("erf  pass  1 of 1 entries"), "{text}");
    let (outcome, text, _) = of("5");
    assert_eq!(outcome, Ok(Outcome::Finding));
    assert!(text.starts_with("erf  FAIL  1 of 1 entries"), "{text}");
    for none in ["1", "3", "6"] {
        let (outcome, _, path) = of(none);
        assert_eq!(outcome, Err(format!("{path}: no row on line {none}")));
    }
}

#[test]
fn other_forms_are_those_of_an_audit() {
    let (outcome, text, _) = judged_as("erf", ERF, &["--format", "csv"]);
    assert_eq!(outcome, Ok(Outcome::Finding));
    assert!(text.starts_with("method,"), "{text}");
    let (_, page, _) = judged_as("erf", ERF, &["--format", "html"]);
    assert!(page.starts_with("<!doctype html>"));
}

fn read_as(method: &str, text: &[u8]) -> Result<(Vec<String>, Vec<Row>), TableError> {
    read(&*methods::find(method).unwrap(), text)
}

fn why(method: &str, text: &str) -> String {
    let e = match read_as(method, text.as_bytes()) {
        Ok(_) => panic!("{text} is a table"),
        Err(e) => e,
    };
    let source = e.source().filter(|_| matches!(e, TableError::Line { .. }));
    source.map_or(e.to_string(), |s| format!("{e}: {s}"))
}

#[test]
fn rows_hold_inputs_in_the_order_of_the_method() {
    let text = "Re erf [1], Im z [1] ,Re z,Im erf\n 0.5 ,2,1e-3,\n# no row\n,4,3,0.250\n";
    let (names, rows) = read_as("erf", text.as_bytes()).unwrap();
    assert_eq!(names, ["Re erf", "Im z", "Re z", "Im erf"]);
    let exact = |row: &Row| row.input.clone();
    assert_eq!(
        exact(&rows[0]),
        [Rational::from((1, 1000)), Rational::from(2)]
    );
    assert_eq!(exact(&rows[1]), [3, 4].map(Rational::from));
    let entries = |row: &Row| {
        let all = row.entries.iter();
        all.map(|e| (e.value, e.column, e.text.clone()))
            .collect::<Vec<_>>()
    };
    assert_eq!(entries(&rows[0]), [(0, 0, "0.5".to_string())]);
    assert_eq!(entries(&rows[1]), [(1, 3, "0.250".to_string())]);
    assert_eq!([rows[0].line, rows[1].line], [2, 4]);
    assert_eq!(rows[1].entries[0].printed, Printed::parse("0.250").unwrap());
}

/// Columns of a vector may be empty behind its end, not within it.
#[test]
fn vectors_may_be_shorter_than_their_columns() {
    let head = "lower[0],diagonal[0],diagonal[1],upper[0],d[0],d[1],x[0],x[1]\n";
    let rows = |text: &str| read_as("tridiagonal", format!("{head}{text}").as_bytes());
    let (_, all) = rows("1,2,3,4,5,6,0.5,0.5\n,2,,,5,,2.5,\n").unwrap();
    assert_eq!(all[0].input, [1, 2, 3, 4, 5, 6].map(Rational::from));
    assert_eq!(all[1].input, [2, 5].map(Rational::from));
    assert_eq!((all[0].entries.len(), all[1].entries.len()), (2, 1));
    let hole = why("tridiagonal", &format!("{head}1,,3,4,5,6,1,1\n"));
    assert_eq!(hole, "line 2: diagonal[0] is empty");
    // Six numbers are right for n = 2, but not these.
    let moved = "lower[0],lower[1],diagonal[0],diagonal[1],upper[0],d[0],x[0]\n1,1,2,2,1,1,1\n";
    let why = why("tridiagonal", moved);
    assert!(
        why.starts_with("line 2: the lengths do not fit: lower["),
        "{why}"
    );
}

#[test]
fn what_is_no_table_is_refused_in_one_line() {
    let digits = |n: usize| format!("Re z,Im z,Re erf\n0,0,0.{}\n", "0".repeat(n - 2));
    for (text, due) in [
        (
            "Re z,Im z\n1,2\n",
            "no column is named as an output of erf: Re erf, Im erf",
        ),
        ("Re z,Im z,Re erf\n", "there are no entries"),
        ("Re z,Im z,Re erf\n1,2,\n", "there are no entries"),
        (
            "Re z,Im z,Re z,Re erf\n1,2,1,1\n",
            "two columns are named Re z",
        ),
        ("Im z,Re erf\n1,2\n", "the column Re z of erf is missing"),
        ("x,Re z,erf\n1,2,3\n", "two columns are named Re z"),
        (
            "Re z,Im z [m],Re erf\n1,2,3\n",
            "Im z is in [1], and [m] is no unit of the same",
        ),
        (
            "Re z,Im z,Re erf\n1,2,3\n1,2\n",
            "line 3: 2 fields where 3 are due",
        ),
        (
            "Re z,Im z,Re erf\n1,2,3,4\n",
            "line 2: 4 fields where 3 are due",
        ),
        ("Re z,Im z,Re erf\n1,,3\n", "line 2: Im z is empty"),
        (
            &digits(FIELD + 1),
            "line 2: a field is longer than 1000 bytes",
        ),
    ] {
        assert_eq!(why("erf", text), due, "{text}");
    }
    assert!(read_as("erf", digits(FIELD).as_bytes()).is_ok());
    let unknown = why("erf", "Re z,Im z,Re erff\n1,2,3\n");
    let due = "erf has no column \"Re erff\" (did you mean \"Re erf\"?); it has: Re z, Im z, Re erf, Im erf";
    assert_eq!(unknown, due);
    let bad = read_as("erf", b"Re z,Im z,Re erf\n1,2,\xff\n")
        .map(|_| ())
        .unwrap_err();
    assert_eq!(bad.to_string(), "line 2 is not UTF-8");
    let columns = |n: usize| why("erf", &vec!["a"; n].join(","));
    assert_eq!(columns(FIELDS + 1), "more than 100000 columns");
    assert!(columns(FIELDS).starts_with("erf has no column \"a\""));
    let hole = why("tridiagonal", "diagonal[1],d[0],x[0]\n1,1,1\n");
    assert_eq!(hole, "the column diagonal[0] of tridiagonal is missing");
}

/// An undecided entry is marked as a doubt, with the reason in place of digits.
#[test]
fn what_is_open_is_listed_with_its_reason() {
    let entry = |agreement: Agreement, units: f64| Judged {
        line: 7,
        column: 0,
        text: "1.5".into(),
        found: EntryJudgement {
            agreement,
            units,
            reference: None,
            reason: Some("no digits".into()),
            bits: 64,
        },
    };
    let all = [
        entry(Agreement::Agrees, 0.25),
        entry(Agreement::Undecided, f64::NAN),
        entry(Agreement::Differs, 12.0),
    ];
    let text = table(&["y".to_string()], &all);
    let rows: Vec<Vec<String>> = plain(&text)
        .lines()
        .map(|l| {
            l.split("  ")
                .map(|w| w.trim().to_string())
                .filter(|w| !w.is_empty())
                .collect()
        })
        .collect();
    assert_eq!(rows.len(), 3, "{text}");
    assert_eq!(rows[1], ["7", "y", "1.5", "no digits", "–"]);
    assert_eq!(rows[2], ["7", "y", "1.5", "no digits", "12.00"]);
}

/// Comments and empty lines before a row are counted, whatever ends a line.
#[test]
fn a_row_has_the_number_of_its_line() {
    let text = "# head\n\nRe z,Im z,Re erf\n1,2,3\n\n# a\n# b, c\n4,5,6\n7,8,9\n#\n\n#\n\n1,1,1";
    for end in ["\n", "\r\n"] {
        let (_, rows) = read_as("erf", text.replace('\n', end).as_bytes()).unwrap();
        let lines: Vec<u64> = rows.iter().map(|r| r.line).collect();
        assert_eq!(lines, [4, 8, 9, 14], "{end:?}");
    }
    let bad = why("erf", "Re z,Im z,Re erf\n# a\n1,2\n");
    assert_eq!(bad, "line 3: 2 fields where 3 are due");
}

/// The row is as bad as its worst entry.
#[test]
fn a_row_is_a_case_with_a_component_for_each_entry() {
    let method = methods::find("erf").unwrap();
    let variant = Variant::new(&*method).limit(LIMIT).without_laws();
    let settings = Settings::default();
    let of = |text: &str| {
        let text = format!("Re z,Im z,Re erf,Im erf\n0.5,0,{text}\n");
        let row = read_as("erf", text.as_bytes()).unwrap().1.remove(0);
        judged(&variant, row, &settings)
    };
    let (case, entries) = of("0.52,0");
    let judgement = &case.judgement;
    assert_eq!(
        (judgement.verdict, judgement.why(), judgement.kind),
        (Verdict::Pass, None, None)
    );
    let due = (settings.first_bits, 2, 3);
    assert_eq!((case.bits, entries.len(), entries[1].column), due);
    assert!(matches!(&case.answer, Some(SolverAnswer::Values(v)) if v[..] == [0.52, 0.0]));
    assert_eq!(
        (case.case.input, case.case.origin),
        (vec![0.5, 0.0], Origin::Line { number: 2 })
    );
    for (text, verdict, reason) in [
        ("0.52,1", Verdict::Over, "Im erf is 1, expected 0"),
        (
            "0.53,0",
            Verdict::Over,
            "Re erf is 0.53, expected 0.52049987781304653768",
        ),
        (
            "0.9,0",
            Verdict::Over,
            "Re erf is 0.9, expected 0.52049987781304653768",
        ),
        (
            "NaN,0",
            Verdict::Over,
            "Re erf is NaN, expected 0.52049987781304653768",
        ),
    ] {
        let (case, _) = of(text);
        let found = (case.judgement.verdict, case.judgement.why());
        assert_eq!(found, (verdict, Some(reason.to_string())), "{text}");
    }
    let shares: Vec<f64> = of("0.53,0")
        .0
        .judgement
        .components
        .iter()
        .map(|c| c.of_budget)
        .collect();
    // 0.53 is 0.95001221869534623… units of a hundredth off, of which half a unit is allowed.
    assert!(
        (shares[0] - 1.900_024_437_390_692).abs() < 1e-12 && shares[1] < 1e-30,
        "{shares:?}"
    );
}

/// A table of a real function needs no imaginary parts; an entry that is no number fails alone.
#[test]
fn tables_of_real_functions_are_judged() {
    let text = "x,erf\n0.5,0.5205\n1,0.8427\n2,nan\n";
    let (outcome, shown, _) = judged_as("erf", text, &[]);
    assert_eq!(outcome, Ok(Outcome::Finding));
    assert!(shown.contains("1 of 3 entries do not agree"), "{shown}");
    assert!(shown.contains("0.99532226501895273416"), "{shown}");
    let digits = "0.520499877813046537682746653891964528736451575757963700058805725647";
    let (outcome, shown, _) = judged_as("erf", &format!("z,erf\n0.5,{digits}9\n"), &[]);
    assert_eq!(outcome, Ok(Outcome::Finding));
    assert!(shown.contains(&digits[..60]), "{shown}");
    assert!(
        shown.lines().last().unwrap().matches(&digits[..60]).count() == 2,
        "{shown}"
    );
}

/// Lengths in millimetres and angles in degrees beside the metres and radians of the method.
#[test]
fn columns_may_be_in_other_units() {
    let head = "a [mm],b [mm],e [mm],delta,phi1,assembly";
    let row = "3000,5000,0,0,0,1";
    let text = format!("{head},x [cm],x' [m],mu [deg]\n{row},800.0,0.0,90.000\n");
    let (outcome, shown, _) = judged_as("slider-crank", &text, &[]);
    assert_eq!(outcome, Ok(Outcome::AsExpected), "{shown}");
    let text = format!("{head},mu [deg]\n{row},90.001\n");
    let (outcome, shown, _) = judged_as("slider-crank", &text, &[]);
    assert_eq!(outcome, Ok(Outcome::Finding));
    assert!(shown.contains("90.000000000000000000"), "{shown}");
    let degrees = why(
        "slider-crank",
        "a,b,e,delta,phi1 [deg],assembly,x\n1,2,0,0,0,1,1\n",
    );
    assert!(
        degrees.starts_with("phi1 is in [rad]: a number in [deg] is no rational"),
        "{degrees}"
    );
}
