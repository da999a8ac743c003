//! Conditions that a method works out itself are those that differences of its reference give.

use mechaudit::audit::{Cases, Layout, Method, Settings, conditions_by_differences};
use mechaudit::methods;

/// Of the method's random cases but those at knots, where differences step over a jump: its conditions, and differences.
fn all(method: &dyn Method) -> Vec<(String, Vec<f64>, Vec<f64>)> {
    let settings = Settings {
        cases_per_region: 3,
        ..Settings::default()
    };
    let layout = Layout::new(method);
    let cases = Cases::new(method, &settings);
    let mut all = Vec::new();
    for case in (0..cases.len()).map(|i| cases.get(i)) {
        if ["check-points", "hard", "near-knots"].contains(&case.region) {
            continue;
        }
        let is_data = layout.is_data(method, &case.input);
        let due = conditions_by_differences(method, &case.input, |j| is_data[j]);
        if let Some((own, due)) = method.conditions(&case.input).zip(due) {
            all.push((case.reproduce(), own, due));
        }
    }
    assert!(all.len() >= 6, "{}", method.name());
    all
}

#[test]
fn they_are_those_of_the_reference() {
    for name in [
        "tridiagonal",
        "cyclic-tridiagonal",
        "cubic-spline-second-derivatives",
        "cubic-spline-clamped",
        "cubic-spline-not-a-knot",
        "cubic-spline-uniform",
        "class-iii",
        "class-iii-assembly-modes",
    ] {
        for (place, own, due) in all(&*methods::find(name).unwrap()) {
            assert_eq!(own.len(), due.len(), "{place}");
            for (k, (own, due)) in own.iter().zip(&due).enumerate() {
                let off = (own - due).abs();
                assert!(off <= 1e-5 * due, "value {k}: {own} for {due}, {place}");
            }
        }
    }
}

/// To what the data make come the equations, each as if it had data of its own.
#[test]
fn those_of_planar_linkages_are_no_smaller() {
    for name in ["planar-linkage", "planar-reduction", "planar-reactions"] {
        for (place, own, due) in all(&*methods::find(name).unwrap()) {
            assert_eq!(own.len(), due.len(), "{place}");
            for (k, (own, due)) in own.iter().zip(&due).enumerate() {
                assert!(
                    *own >= due * (1.0 - 1e-5),
                    "value {k}: {own} for {due}, {place}"
                );
            }
        }
    }
}
