//! Tables, inputs and answers in files, and refusals of those that cannot be judged.

use crate::common::{cells, file, refused, run, said};
use serde_json::Value;
use std::time::{Duration, Instant};

#[test]
fn an_answer_of_the_wrong_length_is_told_which_one_is_due() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| file(&folder, name, text);
    for (method, due, answer) in [
        (
            "cubic-spline-not-a-knot",
            "5 values, expected 10 values: S[q] [y],",
            "1,2,3,4,5",
        ),
        (
            "cam-fourier-series",
            "5 values, expected 24 values: a_0[k] [m], a_n[k] [m], b_n[k] [m]; for k = 0 to 7",
            "1,2,3,4,5",
        ),
        (
            "class-iii-assembly-modes",
            "5 values, expected 16 values: phi2[k] [rad],",
            "1,2,3,4,5",
        ),
        (
            "run-up",
            "1 value, expected 2 values: phi [rad], psi [rad/s]",
            "1",
        ),
    ] {
        let domain = mechaudit::methods::find(method).unwrap().domain();
        // A case that has an answer.
        let region = domain.regions.iter().map(|r| r.name);
        let region = region
            .clone()
            .find(|r| *r == "paper")
            .or(region.clone().next());
        let more = ["--region", region.unwrap(), "--case", "0"];
        let points = run(&[&["points", method][..], &more].concat()).out;
        let listed = run(&["list", method, "--format", "json"]).out;
        let listed: Value = serde_json::from_str(&listed).unwrap();
        let layout = listed["answer"].as_str().unwrap();
        assert!(
            points.contains(&format!("# answer: {layout}\n")),
            "{points}"
        );
        let (inputs, values) = (file("points", &points), file("values", answer));
        let d = run(&["judge", method, "--inputs", &inputs, "--values", &values]);
        assert_eq!(d.code, 1, "{}{}", d.out, d.err);
        let said = d.out.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(due) && said.contains(layout), "{said}");
    }
}

#[test]
fn inputs_of_the_wrong_length_are_bad_input() {
    let folder = tempfile::tempdir().unwrap();
    let judge = |method: &str, inputs: &str| {
        let path = folder.path().join("file");
        std::fs::write(&path, inputs).unwrap();
        let path = path.to_str().unwrap();
        run(&["judge", method, "--inputs", path, "--values", path])
    };
    let inputs = r"
        erf         | 1,2\n1,2,3 | inputs, line 2: 3 numbers where 2 are due: Re z, Im z
        tridiagonal | 1,2,3 | inputs, line 1: 3 numbers are right for no n: lower[n-1]
        cam-law     | 0.5,0,0.5,-2,1,1 | p = -2 is no number of parameters
    ";
    for [method, inputs, part] in cells(inputs) {
        refused(&judge(&method, &format!("{inputs}\n")), &part);
    }
}

#[test]
fn inputs_without_values_are_counted() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| file(&folder, name, text);
    let inputs = file("inputs", &"1,2\n".repeat(5));
    for (answers, left) in [(0, "5 inputs are left"), (2, "3 inputs are left")] {
        let values = file("values", &"0,0\n".repeat(answers));
        let d = run(&["judge", "erf", "--inputs", &inputs, "--values", &values]);
        assert_eq!(d.code, 1, "{}{}", d.out, d.err);
        let all = d.out + &d.err;
        assert!(
            all.contains(&format!("after {answers} answers")) && all.contains(left),
            "{all}"
        );
    }
}

/// More than are judged at a time.
#[test]
fn every_answer_is_judged() {
    let folder = tempfile::tempdir().unwrap();
    let lines = file(&folder, "lines", &"0,0\n".repeat(1500));
    let values = ["--values", &lines, "--format", "json"];
    let d = run(&[&["judge", "erf", "--inputs", &lines][..], &values].concat());
    assert_eq!(d.code, 0, "{}", d.err);
    let v: Value = serde_json::from_str(&d.out).unwrap();
    let m = &v["methods"][0];
    assert_eq!((&m["cases"], &m["passed"]), (&1500.into(), &1500.into()));
}

#[test]
fn points_in_single_precision_are_its_numbers() {
    let of = |more: &[&str]| {
        let args = [
            "points",
            "erf",
            "--region",
            "mid",
            "--count",
            "6",
            "--decimal",
        ];
        let d = run(&[&args[..], more].concat());
        assert_eq!(d.code, 0, "{}", d.err);
        let lines = d.out.lines().filter(|l| !l.starts_with('#'));
        let numbers = lines
            .flat_map(|l| l.split([',', ' ']))
            .filter(|x| !x.is_empty());
        let numbers: Vec<f64> = numbers.map(|x| x.parse().unwrap()).collect();
        let single = numbers
            .iter()
            .filter(|x| f64::from(**x as f32) == **x)
            .count();
        (numbers.len(), single)
    };
    let (all, single) = of(&["--single"]);
    assert!(all > 10 && single == all, "{single} of {all}");
    let (all, single) = of(&[]);
    assert!(single < all / 2, "{single} of {all}");
}

#[test]
fn what_has_no_end_is_refused() {
    let start = Instant::now();
    for args in [
        vec!["--table", "/dev/zero"],
        vec!["--inputs", "/dev/zero", "--values", "/dev/null"],
        vec!["--inputs", "README.md", "--values", "/dev/zero"],
    ] {
        let d = run(&[&["judge", "erf"][..], &args].concat());
        assert_eq!((d.code, d.out.as_str()), (2, ""), "{}", d.err);
        assert_eq!(d.err.lines().count(), 1, "{}", d.err);
    }
    let d = run(&["judge", "erf", "--table", "/dev/zero"]);
    said(&d, "line 1 is longer than the limit of 1 MiB");
    assert!(start.elapsed() < Duration::from_secs(60));
}
