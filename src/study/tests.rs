//! Studies as they are read, certified and sampled.

use super::Study;
use rug::Rational;

fn roots(keys: &str) -> String {
    format!("[inputs]\np = {{ from = 0, to = 9 }}\n[outputs]\nx = {{ {keys} }}\n")
}

/// Each root is an output; another number of roots is an answer of its own.
#[test]
fn all_roots_in_an_interval() {
    let keys = "roots_of = \"x^3 = p*x\", between = [-2, 2], count = 3, unit = \"m\"";
    let study = Study::parse(&roots(keys), "roots").unwrap();
    let outputs = study.problem().outputs.iter();
    let names: Vec<&str> = outputs.map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["x_1", "x_2", "x_3"]);
    let digits = |p: i64| -> Vec<String> {
        let found = study.digits(&[Rational::from(p)], 10).into_iter();
        found
            .map(|v| v.decimal.unwrap_or_else(|| "undecided".into()))
            .collect()
    };
    assert_eq!(digits(2), ["-1.414213562", "0", "1.414213562"]);
    // One root, and two of three outside.
    assert_eq!(digits(9), ["nan", "nan", "nan"]);
    // A double root is not proved to be one.
    assert_eq!(digits(0), ["undecided"; 3]);
}

#[test]
fn keys_of_roots_that_do_not_fit() {
    for (keys, due) in [
        (
            "roots_of = \"x^2 - p\", between = [0, 1]",
            "the roots x need count = NUMBER",
        ),
        (
            "roots_of = \"x^2 - p\", between = [0, 1], count = 0",
            "the number of roots is not from 1 to 1000",
        ),
        (
            "roots_of = \"x^2 - p\", between = [0, 1], count = 1.5",
            "the number of roots is not from 1 to 1000",
        ),
        (
            "root_of = \"x^2 - p\", between = [0, 1], count = 2",
            "count belongs to roots_of",
        ),
        (
            "root_of = \"x\", roots_of = \"x^2 - p\", between = [0, 1], count = 2",
            "the output x has root_of and roots_of",
        ),
        (
            "roots_of = \"y^2 - p\", between = [0, 1], count = 2",
            "the name y is not declared",
        ),
    ] {
        let fault = Study::parse(&roots(keys), "roots").err().unwrap();
        assert!(fault.to_string().contains(due), "{keys}: {fault}");
    }
}

/// The inputs of a solver in binary32 are numbers of binary32 within the range and the condition.
#[test]
fn cases_in_binary32_stay_in_the_domain() {
    use crate::audit::{Cases, Settings};
    let text = "where = \"y < x\"\n[inputs]\nx = { from = 0, to = 0.3 }\ny = { from = -0.1, to = 0.3 }\n\
                [outputs]\nz = \"sqrt(0.3 - x) + sqrt(0.1 + y)\"\n\
                [solver.wide]\nz = \"x\"\n[solver.short]\nformat = \"binary32\"\nz = \"x\"\n";
    let wide = Study::parse(text, "ends").unwrap();
    let short = wide.clone().with_solver("short").unwrap();
    for (study, is_single) in [(wide, false), (short, true)] {
        let cases = Cases::new(&study, &Settings::default());
        let all: Vec<Vec<f64>> = (0..cases.len()).map(|k| cases.get(k).input).collect();
        assert!(all.iter().all(|x| crate::audit::Method::admits(&study, x)));
        let singles = all.iter().filter(|x| f64::from(x[0] as f32) == x[0]);
        assert_eq!(singles.count() == all.len(), is_single);
    }
}
