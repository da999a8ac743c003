//! Tests of `study::initial_value`.

use crate::audit::{Limit, Method, ReferenceAnswer};
use crate::methods::Evaluable;
use crate::study::Study;
use mechaudit_symbolic::evaluation::Goal;
use rug::Rational;

const DECAY: &str = r#"
[inputs]
k = { from = 1, to = 2 }
[parameters]
a = "3"
[let]
rate = "-k*y"
[ode]
time = "t"
start = "1"
until = "4"
[ode.states]
y = { start = "a/2", rate = "rate", unit = "m", budget = "1e-9 absolute", why = "a test" }
[outputs]
double = "2*y + t"
gone = { is = "log(y - 10)" }
"#;

fn fault(text: &str) -> String {
    match Study::parse(text, "motion") {
        Ok(_) => panic!("a study: {text}"),
        Err(e) => e.to_string(),
    }
}

/// A file with one state, of which one line is another.
fn with(ode: &str, states: &str) -> String {
    format!("[ode]\n{ode}\n[ode.states]\n{states}\n")
}

#[test]
fn the_time_is_the_last_input_and_states_are_outputs() {
    let study = Study::parse(DECAY, "decay").unwrap();
    let inputs: Vec<&str> = study.inputs().iter().map(|i| i.name).collect();
    assert_eq!(inputs, ["k", "t"]);
    let outputs = study.outputs();
    let names: Vec<&str> = outputs.iter().map(|o| o.name).collect();
    assert_eq!(names, ["y", "double", "gone"]);
    assert_eq!(
        (outputs[0].unit, outputs[0].budget.limit),
        ("m", Limit::Absolute(1e-9))
    );
    // The range of times, and no time before the start.
    let domain = study.domain();
    assert!(domain.check_points.iter().any(|c| c.input == [1.0, 1.0]));
    assert!(domain.check_points.iter().any(|c| c.input == [2.0, 4.0]));
    assert!(study.admits(&[1.5, 4.0]) && !study.admits(&[1.5, 4.5]));
    assert_eq!(study.refusal(&[1.0, 1.0]), None);
    let why = study.refusal(&[1.0, 0.5]).unwrap();
    assert_eq!(why, "the time 0.5 comes before the start 1");
}

/// y = 3/2 exp(−k (t − 1)), against mpmath.
#[test]
fn values_are_those_of_the_solution() {
    let study = Study::parse(DECAY, "decay").unwrap();
    let at = |k: (i32, i32), t: (i32, i32), digits| {
        let found = study.digits(&[Rational::from(k), Rational::from(t)], digits);
        found
            .into_iter()
            .map(|v| v.decimal.unwrap_or_default())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        at((3, 2), (2, 1), 25),
        [
            "0.3346952402226447433999207",
            "2.669390480445289486799841",
            "nan"
        ]
    );
    assert_eq!(
        at((3, 2), (1, 1), 10),
        ["1.500000000", "4.000000000", "nan"]
    );
    // Rows of the same inputs share a trajectory, whatever their order.
    assert_eq!(at((3, 2), (3, 1), 12)[0], "0.0746806025518");
    assert_eq!(at((3, 2), (2, 1), 12)[0], "0.334695240223");
    let before = study.answers(&[Rational::from(1), Rational::from((1, 2))], Goal::Bits(40));
    assert_eq!(before.len(), 3);
}

/// t y' and k ∂y/∂k are −k t y and −k (t − 1) y, and the start adds y.
#[test]
fn conditions_are_of_inputs_time_and_starts() {
    let study = Study::parse(DECAY, "decay").unwrap();
    let y = 1.5 * (-1.5f64).exp();
    let found = study.conditions(&[1.5, 2.0]).unwrap();
    let due = (1.5 * 2.0 + 1.5 * 1.0 + 1.0) * y;
    assert!((found[0] - due).abs() < 1e-6 * due, "{found:?} {due}");
    let due = (2.0 * (1.0 - 2.0 * 1.5 * y)).abs() + 2.0 * 1.5 * y + 2.0 * y;
    assert!((found[1] - due).abs() < 1e-6 * due, "{found:?} {due}");
}

#[test]
fn a_reference_is_undecided_beyond_a_blow_up() {
    let text = with("start = \"0\"", "x = { start = \"1\", rate = \"x^2\" }");
    let study = Study::parse(&text, "riccati").unwrap();
    let at = |t: (i32, i32)| study.reference(&[Rational::from(t)], 128);
    assert!(matches!(at((1, 2)), ReferenceAnswer::Expected(..)));
    let ReferenceAnswer::Undecided(why) = at((2, 1)) else {
        panic!("1/(1 − t) at 2");
    };
    assert!(why.contains("grows without bound"), "{why}");
}

#[test]
fn faults_have_their_place() {
    let good = "x = { start = \"1\", rate = \"-x\" }";
    for (ode, states, due) in [
        (
            "",
            "x = { start = \"1\" }",
            "line 4, column 5: the state x has no rate",
        ),
        ("", "x = { rate = \"x\" }", "the state x has no start"),
        ("", "x = \"1\"", "the state x has no start and no rate"),
        (
            "",
            "x = { start = \"1\", rate = \"-z\" }",
            "column 29: the name z is not declared",
        ),
        (
            "",
            "x = { start = \"1\", rate = \"-x\", speed = 1 }",
            "there is no key \"speed\"",
        ),
        (
            "",
            "x = { start = \"t\", rate = \"-x\" }",
            "the start of x depends on t",
        ),
        (
            "",
            "x = { start = \"y\", rate = \"-x\" }\ny = { start = \"1\", rate = \"x\" }",
            "the start of x depends on y",
        ),
        (
            "",
            "x = { start = \"0\", rate = \"1/x\" }",
            "the rate of x at the start is undefined: ",
        ),
        (
            "",
            "x = { start = \"log(-1)\", rate = \"x\" }",
            "the start of x is undefined: ",
        ),
        (
            "",
            "x = { start = \"1\", rate = \"i*x\" }",
            "the rate of x is not a real number",
        ),
        (
            "",
            "t = { start = \"1\", rate = \"1\" }",
            "the name t is declared twice",
        ),
        (
            "",
            "pi = { start = \"1\", rate = \"1\" }",
            "pi is a constant",
        ),
        ("time = \"pi\"", good, "pi is a constant"),
        ("start = \"x\"", good, "\"x\" is no finite number"),
        (
            "start = \"2\"\nuntil = \"2\"",
            good,
            "does not come after the start",
        ),
        ("end = \"2\"", good, "there is no key \"end\""),
    ] {
        let found = fault(&with(ode, states));
        assert!(found.contains(due), "{states}: {found}");
    }
    let two = format!("[inputs]\nt = {{ from = 0, to = 1 }}\n{}", with("", good));
    assert!(fault(&two).contains("the time t is an input already"));
    let none = "[ode]\ntime = \"t\"\n";
    assert!(fault(none).contains("[ode] has states"));
    let condition = format!("where = \"x > 0\"\n{}", with("", good));
    assert!(fault(&condition).contains("depends on the state x"));
    let system = format!(
        "{}[system]\nunknowns = {{ u = {{ near = 1 }} }}\nequations = [\"u = 1\"]\n",
        with("", good)
    );
    assert!(fault(&system).contains("either [ode] or [system]"));
}

/// Conditions of problems with and without inputs, against central differences of Taylor series in
/// mpmath's numbers of 60 digits.
#[test]
fn conditions_are_those_of_mpmath() {
    let text = |name: &str| {
        let path = format!(
            "{}/examples/studies/motion/{name}.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        std::fs::read_to_string(path).unwrap()
    };
    let cases: [(&str, &[f64], &[f64]); 5] = [
        (
            "lorenz",
            &[5.0],
            &[24.0412544469, 100.347457246, 93.8697398476],
        ),
        ("pendulum-swing", &[5.0], &[5.12551714039, 23.4725790683]),
        (
            "rigid-body",
            &[20.0],
            &[13.8973478437, 41.0932792847, 7.6340186344],
        ),
        ("van-der-pol", &[1.0, 5.0], &[11.3949925722, 11.0357134834]),
        (
            "kepler-orbit",
            &[3.0],
            &[105.627789322, 61.3863245568, 71.9384137373, 14.7673042139],
        ),
    ];
    for (name, input, due) in cases {
        let study = Study::parse(&text(name), name).unwrap();
        let found = study.conditions(input).unwrap();
        assert!(found.len() >= due.len());
        for (found, due) in found.iter().zip(due) {
            assert!((found - due).abs() <= 1e-9 * due, "{name}: {found} {due}");
        }
    }
}

/// The condition jumps where the rate does, and there is none where
/// the start moves off a switch.
#[test]
fn conditions_across_switches() {
    let at = |start: &str, t: f64| {
        let text = with(
            "",
            &format!("y = {{ start = \"{start}\", rate = \"if(y < 1, 1, 2)\" }}"),
        );
        Study::parse(&text, "switch").unwrap().conditions(&[t])
    };
    // y = 1 + 2 (t − 1 + y_0) past the switch, t + y_0 before it.
    let past = at("1/4", 2.0).unwrap()[0];
    assert!((past - (2.0 * 2.0 + 2.0 * 0.25)).abs() < 1e-9, "{past}");
    let before = at("1/4", 0.5).unwrap()[0];
    assert!((before - 0.75).abs() < 1e-9, "{before}");
    assert_eq!(at("1", 0.5), None);
}
