//! Tests of `findings`.

use super::*;
use crate::papers::{Finding, on_figures};
use crate::reference::Decimal;
use std::collections::BTreeMap;

/// The one whose last digit at t = 0 is wrong.
const LAMBDA_1: usize = 21;

#[test]
fn angles_that_are_not_opposite_once_are_found() {
    let row = |off: i64| -> Vec<Ball> {
        let values = (0..QUANTITIES.len() as i64).map(|k| match k {
            5 | 12 | 19 => -(k - 2),
            17 => 17 + off,
            k => k,
        });
        values.map(|k| Ball::integer(BITS, k)).collect()
    };
    assert!(opposite(&[row(0), row(0)]));
    assert!(!opposite(&[row(0), row(1)]));
    assert!(!opposite(&[row(1), row(0)]));
}

/// The committed motion; at t = 0 a 0 stands for what vanishes.
fn motion() -> Vec<Vec<Ball>> {
    let text = include_str!("../../../../reference/values/andrews-motion.csv");
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let names = reader.headers().unwrap().clone();
    let value = names.iter().position(|n| n == "value").unwrap();
    let mut all: BTreeMap<String, Vec<Ball>> = BTreeMap::new();
    for row in reader.records() {
        let row = row.unwrap();
        let ball = Ball::rational(BITS, &Decimal::parse(&row[value]).unwrap().value);
        all.entry(row[0].into()).or_default().push(ball);
    }
    let mut values: Vec<Vec<Ball>> = all.into_values().collect();
    // Thirty digits are too few for what is printed with as many.
    values[0][LAMBDA_1] = beside(LAMBDA_1, 1.79);
    values
}

/// A value at t = 0 that many units of the last digit above the printed one.
fn beside(quantity: usize, units: f64) -> Ball {
    let all = printed();
    let p = all.iter().find(|p| p.time == "0" && p.quantity == quantity);
    let number = &p.unwrap().number.value;
    let unit = Ball::rational(BITS, &number.unit());
    Ball::rational(BITS, &number.value) + unit * Ball::exact(BITS, units)
}

/// The findings on printed and certified values.
fn found(printed: &[Printed], values: &[Vec<Ball>]) -> Vec<Finding> {
    let of = [
        "start-values",
        "reference-solution",
        "later",
        "mirrored",
        "certified-motion",
    ];
    let mut all = on_figures("andrews", &digits(printed, values));
    all.retain(|f| of.contains(&f.id));
    assert_eq!(all.len(), 5);
    all
}

/// One of them.
fn one(id: &str, printed: &[Printed], values: &[Vec<Ball>]) -> Finding {
    let mut all = found(printed, values).into_iter();
    all.find(|f| f.id == id).unwrap()
}

/// The findings that are not as recorded with a value changed, in units of the last printed digit.
fn lost(time: usize, quantity: usize, units: f64) -> Vec<&'static str> {
    let all = printed();
    let mut values = motion();
    let place = ["0", TIMES[2]][time];
    let number = all
        .iter()
        .find(|p| p.time == place && p.quantity == quantity);
    let unit = number.map_or(1.0, |p| p.number.value.unit().to_f64());
    let value = &mut values[[0, 3][time]][quantity];
    let step = Ball::exact(BITS, units * unit);
    *value = &*value + &step;
    let found = found(&all, &values).into_iter();
    found.filter(|f| !f.as_recorded).map(|f| f.id).collect()
}

#[test]
fn findings_rest_on_every_value() {
    assert!(lost(0, 0, 0.0).is_empty());
    // The others are right to half a unit, λ₁ is off by 1.79.
    assert_eq!(lost(0, 0, 0.9), ["start-values"]);
    assert_eq!(lost(0, 22, -0.9), ["start-values"]);
    assert_eq!(lost(0, 21, -1.79), ["start-values"]);
    assert_eq!(lost(0, 21, 0.02), ["start-values"]);
    // An angle, a rate and a multiplier at the end, by 1e-12 or so of themselves.
    assert!(lost(1, 0, 3e4).contains(&"later"));
    assert!(lost(1, 6, 1e5).contains(&"later"));
    assert!(lost(1, 7, 1e12).contains(&"reference-solution"));
    assert!(lost(1, 26, 1e11).contains(&"reference-solution"));
    // Φ'' without Ω''.
    assert!(lost(1, 17, 1.0).contains(&"mirrored"));
}

/// λ₁ is the one that is off, and no other.
#[test]
fn another_value_that_is_off_is_told_from_lambda_1() {
    let all = printed();
    let mut values = motion();
    assert!(one("start-values", &all, &values).as_recorded);
    values[0][LAMBDA_1] = beside(LAMBDA_1, 0.0);
    values[0][LAMBDA_1 + 1] = beside(LAMBDA_1 + 1, 1.79);
    let found = one("start-values", &all, &values);
    assert!(found.figures[0].value == "-1.79" && !found.as_recorded);
}

/// Values within a unit are counted, of which there are none.
#[test]
fn a_reference_value_that_is_right_to_the_last_digit_is_counted() {
    let all = printed();
    let end: Vec<&Printed> = all.iter().filter(|p| p.time == TIMES[2]).collect();
    for (units, due) in [(0.9, "1 of"), (1.1, "0 of"), (-0.9, "1 of"), (-1.1, "0 of")] {
        let mut values = motion();
        let p = end[3];
        let exact = Ball::rational(BITS, &p.number.value.value);
        let unit = Ball::rational(BITS, &p.number.value.unit());
        values[3][p.quantity] = exact + unit * Ball::exact(BITS, units);
        let found = one("reference-solution", &all, &values);
        assert!(!found.as_recorded);
        assert!(
            found.text.contains(&format!("{due} {}", end.len())),
            "{}",
            found.text
        );
    }
}

/// Printed Φ'' and Ω'' that are opposite no longer contradict each other.
#[test]
fn the_print_contradicts_itself() {
    let (all, values) = (printed(), motion());
    let end: Vec<&Printed> = all.iter().filter(|p| p.time == TIMES[2]).collect();
    assert!(one("mirrored", &all, &values).as_recorded);
    let mut equal = all.clone();
    let text = end
        .iter()
        .find(|p| p.quantity == 17)
        .unwrap()
        .number
        .clone();
    for p in equal
        .iter_mut()
        .filter(|p| p.time == TIMES[2] && p.quantity == 19)
    {
        p.number = text.clone();
        p.number.text.insert(0, '-');
    }
    assert!(!one("mirrored", &equal, &values).as_recorded);
}

#[test]
fn one_moment_that_is_left_over_is_found() {
    let [none, some] = [0, 1].map(|k| Ball::integer(BITS, k));
    assert!(balanced(&[none.clone(), none.clone(), none.clone()]));
    assert!(!balanced(&[none.clone(), some, none.clone()]));
    assert!(!balanced(&[none.clone(), none.clone()]));
}

#[test]
fn a_motion_is_of_four_times_and_all_quantities() {
    let mut values = motion();
    assert!(figures_are(&values));
    values[2].pop();
    assert!(!figures_are(&values));
    assert!(!figures_are(&motion()[..3]));
}
