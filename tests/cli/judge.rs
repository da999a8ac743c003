//! Tables, inputs and answers in files, and refusals of those that cannot be judged.

use crate::common::{cells, file, refused, run, said};
use serde_json::Value;
use std::time::{Duration, Instant};

#[test]
fn a_published_table() {
    let folder = tempfile::tempdir().unwrap();
    let judge = |method: &str, text: &str, more: &[&str]| {
        let path = folder.path().join("table.csv");
        std::fs::write(&path, text).unwrap();
        let args = ["judge", method, "--table", path.to_str().unwrap()];
        run(&[&args[..], more].concat())
    };
    // w(x + iy) to six decimals, as in Abramowitz and Stegun, table 7.9.
    let right = "Re z,Im z,Re W,Im W\n# first rows\n0,0,1.000000,0.000000\n0,0.2,0.809020,0\n\
                 1.0,1.0,0.304744,0.208219\n3.9,3.0,,0.0928\n";
    let d = judge("faddeeva", right, &["--format", "json"]);
    let v: Value = serde_json::from_str(&d.out).unwrap();
    let entries = v["entries"].as_array().unwrap();
    assert_eq!(entries.len(), 7);
    let verdict = |k: usize| entries[k]["judgement"]["agreement"].as_str().unwrap();
    assert!((0..6).all(|k| verdict(k) == "agrees"), "{}", d.out);
    // One report for tables, too.
    let m = &v["methods"][0];
    assert_eq!(
        (&v["schema_version"], &m["cases"], &m["passed"]),
        (&2.into(), &4.into(), &3.into())
    );
    let d = judge("faddeeva", right, &["--format", "junit"]);
    assert!(
        d.code == 1 && d.out.contains("0.5 of a unit of the last digit"),
        "{}",
        d.out
    );
    let d = judge("faddeeva", right, &["--line", "5"]);
    assert!(d.code == 0 && d.out.contains("2 of 2 entries"), "{}", d.out);
    // Misprints: a digit exchanged, the last digit off by one, a sign.
    let wrong = "Re z,Im z [1],Re W [1],Im W\n1,1,0.307444,0.208220\n1,1,0.304745,-0.208219\n1,1,0.3047,2.1e-1\n";
    let d = judge("faddeeva", wrong, &[]);
    assert_eq!((d.code, d.err.as_str()), (1, ""));
    for part in [
        "4 of 6 entries do not agree",
        "last digit off by one: 1, farther off: 3",
        "0.30474420525691259246",
    ] {
        assert!(d.out.contains(part), "{part} is missing in {}", d.out);
    }
    let long = format!("Re z,Im z,Re W,Im W\n0,0,1.{},0\n", "0".repeat(1000));
    refused(
        &judge("faddeeva", &long, &[]),
        "a field is longer than 1000 bytes",
    );
    let d = judge("faddeeva", wrong, &["--format", "csv"]);
    let rows: Vec<&str> = d.out.lines().collect();
    assert!(d.code == 1 && rows.len() == 1 + 2 * 3, "{}", d.out);
    assert!(
        rows[1].contains("--table") && rows[1].contains("--line"),
        "{}",
        rows[1]
    );
    let d = judge("faddeeva", wrong, &["--format", "html"]);
    assert!(
        d.code == 1 && d.out.contains("is not rounded from the value"),
        "{}",
        d.out
    );
    // The exact solution of a system: (1/3, 1/3).
    let names = "lower[0],diagonal[0],diagonal[1],upper[0],d[0],d[1],x[0],x[1]\n";
    let system = |row: &str| judge("tridiagonal", &format!("{names}{row}\n"), &[]);
    assert_eq!(system("1,2,2,1,1,1,0.333,0.33333").code, 0);
    let none = system("1,1,1,1,1,1,0.3,0.3");
    assert!(
        none.code == 1 && none.out.contains("no such value: 2"),
        "{}",
        none.out
    );
    let tables = r#"
        Re z,Im z\n1,2 | no column is named as an output of faddeeva: Re W, Im W
        Re z,Im z,Re W\n1,2,abc | line 2: "abc" is not a decimal number
        Re z,Im z,Re W\n1,2 | line 2: 2 fields where 3 are due
        Re z,Im z,Re W | there are no entries
        Re z,Im z,Re W\n1,,1 | line 2: Im z is empty
        x,Im z,Re W\n1,2,3 | faddeeva has no column "x"; it has: Re z, Im z, Re W, Im W
        Re z,Im z,Re w\n1,2,3 | no column "Re w" (did you mean "Re W"?)
        Re z,Re z,Re W\n1,2,3 | two columns are named Re z
        Re z,Re W\n1,2 | the column Im z of faddeeva is missing
        Re z,Im z [deg],Re W\n1,2,3 | Im z is in [1], not in [deg]
    "#;
    for [text, part] in cells(tables) {
        refused(&judge("faddeeva", &format!("{text}\n"), &[]), &part);
    }
}

/// Names decide, whatever the order of the columns.
#[test]
fn columns_of_a_table_are_known_by_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.csv");
    let judge = |method: &str, text: &str| {
        std::fs::write(&path, text).unwrap();
        run(&["judge", method, "--table", path.to_str().unwrap()])
    };
    let d = judge("erf", "Re erf,Im z,Re z\n0.5205,0,0.5\n0.8427,0,1\n");
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    let d = judge("erf", "Im z,Re z,Re erf\n0.5,0,0.5205\n");
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    // Lines of two lengths: the shorter system leaves fields empty.
    let system = "d[0],d[1],lower[0],upper[0],diagonal[1],diagonal[0],x[1],x[0]\n\
                  1,1,1,1,2,2,0.333,0.333\n1,,,,,2,,0.5\n";
    let d = judge("tridiagonal", system);
    assert!(
        d.code == 0 && d.out.contains("3 of 3"),
        "{}{}",
        d.out,
        d.err
    );
    let d = judge("tridiagonal", &system.replace("1,,,,,2", "1,1,,,,2"));
    assert_eq!(d.code, 2);
    said(&d, "line 3: 3 numbers are right for no n");
    let d = judge("tridiagonal", "diagonal[1],d[0],x[0]\n1,1,1\n");
    said(&d, "the column diagonal[0] of tridiagonal is missing");
    // The spline through (0, 0), (1, 1), (2, 4), (3, 9) is x^2: at 1.5 and at 2.
    let spline = "x[0],x[1],x[2],x[3],y[0],y[1],y[2],y[3],q0,q1,S[1],S[0],integral[0]\n\
                  0,1,2,3,0,1,4,9,1.5,2,4.0,2.25,1.5417\n";
    let d = judge("cubic-spline-not-a-knot", spline);
    assert!(
        d.code == 0 && d.out.contains("3 of 3"),
        "{}{}",
        d.out,
        d.err
    );
}

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
