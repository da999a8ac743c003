//! Bounds beside those that were proved before: a change has to be meant.

/// Asserts that these are the bounds of these formulas, to 1e-6; what was found is listed where they are not.
pub(crate) fn as_proved(found: &[(&str, f64)], due: &[(&str, f64)]) {
    let line = |(name, b): &(&str, f64)| format!("    ({name:?}, {b:.9e}),");
    let listed: Vec<String> = found.iter().map(line).collect();
    let listed = listed.join("\n").replace("inf", "f64::INFINITY");
    assert_eq!(found.len(), due.len(), "\n{listed}");
    for (p, q) in found.iter().zip(due) {
        let near = p.1 == q.1 || q.1.is_finite() && (p.1 - q.1).abs() <= 1e-6 * q.1;
        assert!(p.0 == q.0 && near, "{p:?} {q:?}\n{listed}");
    }
}

#[test]
fn other_bounds_and_formulas_are_told() {
    let due = [("a", 0.5), ("b", f64::INFINITY)];
    as_proved(&due, &due);
    for wrong in [
        vec![("a", 0.5)],
        vec![("a", 0.500_001), ("b", f64::INFINITY)],
        vec![("a", 0.5), ("b", 1.0)],
        vec![("a", 0.5), ("c", f64::INFINITY)],
        vec![("a", f64::NAN), ("b", f64::INFINITY)],
    ] {
        assert!(std::panic::catch_unwind(|| as_proved(&wrong, &due)).is_err());
    }
}
