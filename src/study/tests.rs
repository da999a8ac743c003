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

const POLES: &str = "
[inputs]
x = { from = 1, to = 4 }
y = { from = 0, to = 1 }
[let]
z = \"x + i*y\"
pole = { is = \"c/(z - p)\", of = [\"c\", \"p\"] }
c = [\"1/2\", \"3\"]
squares = { is = \"n^2\", n = [0, 3] }
[outputs]
f = { is = \"re(1/z)\", budget = \"1e-9 relative\", why = \"a test\" }
[[region]]
name = \"left\"
x = { from = 1, to = 2 }
where = \"y < x/4\"
";

fn poles(solver: &str) -> Result<Study, super::StudyError> {
    Study::parse(&format!("{POLES}[solver.s]\n{solver}\n"), "poles")
}

fn solved(formula: &str) -> f64 {
    use crate::audit::{Method, SolverAnswer};
    let study = poles(&format!("f = \"{formula}\"")).unwrap();
    match study.solve(&[2.0, 0.5]) {
        SolverAnswer::Values(values) => values[0],
        other => panic!("{formula}: {other:?}"),
    }
}

/// The same text is another formula where the solver gives a constant another value; infinity is
/// nobody's name.
#[test]
fn constants_of_a_solver_and_no_name() {
    let text = "[inputs]\nx = {}\n[outputs]\ny = \"pi*x\"\n[solver.s]\ny = \"pi*x\"";
    let notes = |text: &str| Study::parse(text, "p").unwrap().problem().notes.len();
    let own = format!("{text}\n[solver.s.let]\npi = \"3\"");
    assert_eq!((notes(text), notes(&own)), (1, 0));
    let refused = Study::parse(&text.replace("x = {}", "inf = {}"), "p").unwrap_err();
    let said = refused.to_string();
    let why = "inf is infinity, and no name";
    assert!(said.contains(why), "{said}");
    let built = Study::formula("inf + 1").input("inf", 0.0..=1.0).study();
    assert_eq!(built.unwrap_err().to_string(), why);
}

#[test]
fn lists_indices_and_names_that_are_given() {
    assert_eq!(solved("c[1] + 10*c[2]"), 30.5);
    assert_eq!(solved("sum(k, 0, 3, squares[k]) + squares[3 - 1]"), 18.0);
    assert_eq!(solved("re(let(c, 1, p, i*y, pole))"), 0.5);
    assert_eq!(solved("re(let(c, 1, p, 0, z, 4, pole))"), 0.25);
    for (solver, due) in [
        ("f = \"z\"", "complex formula"),
        ("f = \"c\"", "c has no value"),
        ("f = \"d[1]\"", "d_1 has no value"),
        (
            "f = \"x\"\nlet = { a = { is = \"n\", n = [3, 1] } }",
            "an index goes from",
        ),
        (
            "f = \"x\"\nlet = { a = { is = \"n\", n = [0, 1000] } }",
            "an index goes from",
        ),
        (
            "f = \"x\"\nlet = { a = { is = \"n\", n = \"1\" } }",
            "unknown key \"n\"",
        ),
    ] {
        let fault = poles(solver).err().unwrap().to_string();
        assert!(fault.contains(due), "{solver}: {fault}");
    }
}

#[test]
fn a_part_of_the_domain_and_the_seams_of_a_solver() {
    use crate::audit::Method;
    let study = poles("f = \"if(x < 3, 1/x, 2/x)\"").unwrap();
    let left = study.within(Some("left"), &[]).unwrap();
    assert!(study.admits(&[3.0, 0.9]) && left.admits(&[1.5, 0.25]));
    assert!(!left.admits(&[3.0, 0.25]) && !left.admits(&[1.5, 0.5]));
    assert!(left.domain().regions.iter().all(|r| r.name != "left"));
    assert!(left.seams().is_empty());
    let seams = study.seams();
    assert!(!seams.is_empty());
    for [a, b] in seams {
        let low = a[0].min(b[0]);
        assert!(low.next_up() == a[0].max(b[0]) && low == 3f64.next_down() && a[1] == b[1]);
    }
    let fault = study.within(Some("lift"), &[]).err().unwrap().to_string();
    assert!(fault.contains("did you mean \"left\""), "{fault}");
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
