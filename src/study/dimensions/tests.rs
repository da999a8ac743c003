//! Tests of the dimensions of studies.

use super::super::read::problem;

const PENDULUM: &str = r#"
[inputs]
l = { from = 0.1, to = 10, unit = "m" }
[parameters]
g = { is = "9.81", unit = "m/s^2" }
[outputs]
period = { is = "2*pi*sqrt(l/g)", unit = "s", budget = "4 ulp", why = "a test" }
"#;

fn fault(text: &str) -> Option<String> {
    let notes = problem(text, "pendulum").unwrap().notes;
    notes
        .into_iter()
        .find(|n| n.starts_with("the dimension of"))
}

#[test]
fn a_wrong_dimension_is_a_note_on_its_output() {
    assert_eq!(fault(PENDULUM), None);
    let wrong = fault(&PENDULUM.replace("l/g", "g/l")).unwrap();
    assert!(
        wrong.contains("the dimension of period is wrong"),
        "{wrong}"
    );
    assert!(
        wrong.contains("period is in s, but 2*pi*sqrt(g/l) in s^-1"),
        "{wrong}"
    );
    assert!(fault(&PENDULUM.replace("sqrt(l/g)", "sqrt(l/g + 1)")).is_some());
    assert!(fault(&PENDULUM.replace("sqrt(l/g)", "sin(l/g)")).is_some());
}

/// Without a unit a name may have any, and a unit that nobody knows is named in a note.
#[test]
fn what_has_no_unit_is_not_checked() {
    assert_eq!(
        fault(
            &PENDULUM
                .replace(r#", unit = "m/s^2""#, "")
                .replace("l/g", "g/l")
        ),
        None
    );
    let furlongs = PENDULUM
        .replace(r#"unit = "m""#, r#"unit = "furlong""#)
        .replace("l/g", "g/l");
    let found = problem(&furlongs, "pendulum").unwrap();
    assert!(
        found.notes.iter().any(|n| n.contains("furlong")),
        "{:?}",
        found.notes
    );
}

/// An unknown of a system has the unit of its output.
#[test]
fn equations_of_a_system_have_equal_terms() {
    let text = r#"
[inputs]
F = { from = 1, to = 2, unit = "N" }
k = { from = 1, to = 2, unit = "N/m" }
[system]
unknowns = { x = { near = 1 } }
equations = ["k*x = F"]
[outputs]
x = { unit = "m" }
"#;
    assert_eq!(fault(text), None);
    assert!(fault(&text.replace("k*x = F", "k*x^2 = F")).is_some());
    assert!(fault(&text.replace(r#"x = { unit = "m" }"#, r#"x = { unit = "s" }"#)).is_some());
}
