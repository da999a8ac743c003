//! Every quantity that is measured matters: a finding notices when it is missing or another.

use super::*;
use crate::papers::on_figures;
use std::sync::LazyLock;

static MEASURED: LazyLock<Measured> = LazyLock::new(|| analysis().unwrap());

/// Names of the findings that are not as recorded.
fn lost(measured: &Measured) -> Vec<&'static str> {
    let all = on_figures("zinchenko", measured);
    all.iter()
        .filter(|f| !f.as_recorded)
        .map(|f| f.id)
        .collect()
}

/// Numbers that no finding notices a fault of; motions are measured alike, though not all is told.
fn unseen(fault: fn(&Ball) -> Option<Ball>) -> Vec<&'static str> {
    let all = MEASURED.quantities.iter();
    let all = all.filter(|(name, _)| !run_up::is_of_motion(name));
    all.filter(|(name, value)| {
        let mut planted = MEASURED.clone();
        let found = match value {
            Quantity::Number(x) => fault(x),
            Quantity::Exact(x) => fault(&Ball::rational(BITS, x)),
            _ => None,
        };
        match found {
            Some(x) => planted.add(name.as_str(), Quantity::Number(x)),
            None => drop(planted.quantities.remove(*name)),
        }
        lost(&planted).is_empty()
    })
    .map(|(name, _)| name.as_str())
    .collect()
}

/// The columns of some measurements are longer than what is told of them.
const UNTOLD: [&str; 6] = [
    "fitted_off",
    "inertia_24",
    "inertia_48",
    "inertia_96",
    "loop_24",
    "loop_96",
];

#[test]
fn every_quantity_is_needed() {
    assert_eq!(lost(&MEASURED), [""; 0]);
    assert_eq!(unseen(|_| None), UNTOLD);
}

/// Quantities on record, or with a limit, change their finding when they change; these are told.
const TOLD: [&str; 18] = [
    "all_s2",
    "all_s2_sd",
    "grid",
    "metres",
    "misfit",
    "moments",
    "off_worst",
    "printed_half",
    "printed_one",
    "printed_row",
    "rotor",
    "synchronous",
    "total",
    "true_row",
    "unused",
    "used",
    "x4_sd",
    "y4_sd",
];

#[test]
fn planted_figures_are_found() {
    let [more, less] = [
        unseen(|x| Some(x * &Ball::exact(BITS, 1.1) + Ball::exact(BITS, 0.1))),
        unseen(|x| Some(x * &Ball::exact(BITS, 0.5) - Ball::exact(BITS, 0.1))),
    ];
    let both = more.into_iter().filter(|name| less.contains(name));
    let both: Vec<&str> = both.filter(|name| !UNTOLD.contains(name)).collect();
    assert_eq!(both, TOLD);
}

#[test]
fn a_fitted_node_is_a_millionth_s_multiple() {
    for (x, due) in [
        (1.234_567_8, 1_234_568),
        (-0.000_002_4, -2),
        (12.0, 12_000_000),
    ] {
        let due = Rational::from((due, 1_000_000));
        let off = exact_micro(x) - Ball::rational(BITS, &due);
        assert!(off.contains_zero(), "{x}");
        assert!(exact_micro(x).rad().to_f64() < 1e-50);
    }
}
