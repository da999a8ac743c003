use super::count;
use crate::cli::failure::Outcome;
use crate::cli::ran;
use serde_json::Value;
use std::path::Path;

/// Comments and blank lines are no inputs; what has no size has no number of them.
#[test]
fn inputs_of_a_file_are_counted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("inputs");
    std::fs::write(&path, "# region small\n1,2\n\n  \n3,4\nno number").unwrap();
    assert_eq!(count(&path), Some(3));
    assert_eq!(count(folder.path()), None);
    assert_eq!(count(&folder.path().join("none")), None);
    assert_eq!(count(Path::new("/dev/null")), None);
}

/// Judges answers in a file: what it came to, and the report.
struct Files {
    _folder: tempfile::TempDir,
    inputs: String,
    values: String,
    report: String,
}

fn files(inputs: &str, values: &str) -> Files {
    let folder = tempfile::tempdir().unwrap();
    let [i, v, r] = ["my inputs", "values", "report"].map(|n| folder.path().join(n));
    std::fs::write(&i, inputs).unwrap();
    std::fs::write(&v, values).unwrap();
    let [inputs, values, report] = [i, v, r].map(|p| p.to_str().unwrap().to_string());
    Files {
        _folder: folder,
        inputs,
        values,
        report,
    }
}

impl Files {
    fn judged(&self, more: &[&str]) -> Result<(Outcome, Value), String> {
        let files = ["--inputs", &self.inputs, "--values", &self.values];
        let form = ["--format", "json", "--output", &self.report];
        let words = [&["judge", "erf"], &files[..], &form[..], more].concat();
        let outcome = ran(&words).map_err(|e| e.to_string())?;
        let text = std::fs::read_to_string(&self.report).unwrap();
        Ok((outcome, serde_json::from_str(&text).unwrap()))
    }
}

/// Of a method: cases, cases passed, answers, what is said of them.
fn counts(v: &Value) -> (u64, u64, u64, Option<&str>) {
    let m = &v["methods"][0];
    let [cases, passed, answered] =
        [&m["cases"], &m["passed"], &m["candidate"]["answered"]].map(|n| n.as_u64().unwrap());
    (cases, passed, answered, m["candidate"]["trouble"].as_str())
}

#[test]
fn answers_are_matched_with_inputs_in_their_order() {
    // erf 0 = 0; erf 30 = 1 to many digits.
    let both = files(
        "0,0\n\n# note\n30,0\n",
        "# name: w\n# version: 3\n0,0\n1,0\n",
    );
    let (outcome, v) = both.judged(&[]).unwrap();
    assert_eq!(outcome, Outcome::AsExpected);
    assert_eq!(counts(&v), (2, 2, 2, None));
    let candidate = &v["methods"][0]["candidate"];
    assert_eq!(
        (&candidate["name"], &candidate["version"]),
        (&"w".into(), &"3".into())
    );
    let swapped = files("0,0\n\n# note\n30,0\n", "1,0\n0,0\n");
    let (outcome, v) = swapped.judged(&["--ulps", "2"]).unwrap();
    assert_eq!(outcome, Outcome::Finding);
    assert_eq!(counts(&v), (2, 0, 2, None));
    let name = format!("answers in {}", swapped.values);
    assert_eq!(v["methods"][0]["candidate"]["name"], name);
    let failures = v["methods"][0]["failures"].as_array().unwrap();
    let (inputs, values) = (&swapped.inputs, &swapped.values);
    let head = format!("mechaudit judge erf --inputs '{inputs}' --values {values} --line");
    let commands: Vec<&str> = failures
        .iter()
        .map(|f| f["reproduce"].as_str().unwrap())
        .collect();
    for line in [1, 4] {
        let due = format!("{head} {line} --ulps 2.0");
        assert!(commands.contains(&&*due), "{due} is none of {commands:?}");
    }
}

#[test]
fn one_input_is_judged_by_its_line() {
    let some = files("0,0\n\n30,0\n0,0\n", "0,0\n0,0\n0,0\n");
    for (line, passed) in [("1", 1), ("3", 0), ("4", 1)] {
        let (outcome, v) = some.judged(&["--line", line]).unwrap();
        assert_eq!(outcome, Outcome::of(passed == 1), "{line}");
        let (cases, found, answered, trouble) = counts(&v);
        assert_eq!(
            (cases, found, answered, trouble),
            (1, passed, 3, None),
            "{line}"
        );
    }
    let why = some.judged(&["--line", "2"]).unwrap_err();
    assert_eq!(why, format!("{}: no input on line 2", some.inputs));
    let none = files("# nothing\n", "");
    assert_eq!(
        none.judged(&[]).unwrap_err(),
        format!("{}: no inputs", none.inputs)
    );
}

/// Inputs that are left count as failures, and so does an answer too many.
#[test]
fn answers_are_as_many_as_inputs() {
    let (outcome, v) = files("0,0\n30,0\n0,0\n", "0,0\n").judged(&[]).unwrap();
    assert_eq!(outcome, Outcome::Finding);
    let said = "the values end after 1 answers; 2 inputs are left";
    assert_eq!(counts(&v), (3, 1, 1, Some(said)));
    let (outcome, v) = files("0,0\n", "0,0\n0,0\n").judged(&[]).unwrap();
    assert_eq!(outcome, Outcome::Finding);
    let said = "there are more values than the 1 inputs";
    assert_eq!(counts(&v), (1, 1, 1, Some(said)));
}

/// A comment that names a region is about the lines after it.
#[test]
fn inputs_belong_to_the_region_named_before_them() {
    let text = "0,0\n# region small 5\n0,0\n0,0\n# region: mid\n0,0\n# region mid: 3\n0,0\n# region hard\n0,0\n\
                # region check-points: all\n0,0\n# region nowhere\n0,0\n0,0\n# regions small\n0,0\n";
    let (_, v) = files(text, &"0,0\n".repeat(10)).judged(&[]).unwrap();
    let regions = v["methods"][0]["regions"].as_array().unwrap();
    let mut found: Vec<(String, u64)> = regions
        .iter()
        .map(|r| {
            (
                r["name"].as_str().unwrap().to_string(),
                r["cases"].as_u64().unwrap(),
            )
        })
        .filter(|r| r.1 > 0)
        .collect();
    found.sort();
    let due = [
        ("check-points", 1),
        ("given", 4),
        ("hard", 1),
        ("mid", 1),
        ("small", 3),
    ];
    assert_eq!(found, due.map(|(name, n)| (name.to_string(), n)));
}

#[test]
fn what_cannot_be_read_is_named() {
    let bad = files("0,0\n1,x\n", "0,0\n0,0\n").judged(&[]).unwrap_err();
    assert!(bad.starts_with("inputs, line 2: "), "{bad}");
    let long = files("0,0\n#\n1,2,3\n", "0,0\n0,0\n")
        .judged(&[])
        .unwrap_err();
    assert_eq!(
        long,
        "inputs, line 3: 3 numbers where 2 are due: Re z, Im z"
    );
    let mut gone = files("0,0\n", "");
    gone.values.push('x');
    let why = gone.judged(&[]).unwrap_err();
    assert!(
        why.starts_with(&format!("cannot read {}: ", gone.values)),
        "{why}"
    );
    gone.inputs.push('x');
    let why = gone.judged(&[]).unwrap_err();
    assert!(
        why.starts_with(&format!("cannot read {}: ", gone.inputs)),
        "{why}"
    );
}
