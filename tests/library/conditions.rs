//! Conditions that a method works out itself are those that differences of its reference give.

use mechaudit::audit::{Cases, Layout, Method, Settings, Variant, conditions_by_differences};
use mechaudit::methods;
use rug::{Float, Rational};

/// Of the method's random cases but those at knots, where differences step over a jump: its
/// conditions, and differences.
fn all(method: &dyn Method) -> Vec<(String, Vec<f64>, Vec<f64>)> {
    all_but(method, |_, _| false)
}

/// As [`all`], without numbers of the input that are exact.
fn all_but(
    method: &dyn Method,
    is_exact: impl Fn(&[f64], usize) -> bool,
) -> Vec<(String, Vec<f64>, Vec<f64>)> {
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
        let due = conditions_by_differences(method, &case.input, |j| {
            is_data[j] && !is_exact(&case.input, j)
        });
        let Some(due) = due else { continue };
        let place = case.reproduce();
        let own = method.conditions(&case.input).expect(&place);
        assert_eq!(own.len(), due.len(), "{place}");
        all.push((place, own, due));
    }
    assert!(all.len() >= 3, "{}", method.name());
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
        "cubic-spline-mixed-ends",
        "class-iii",
        "class-iii-assembly-modes",
    ] {
        for (place, own, due) in all(&*methods::find(name).unwrap()) {
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
            for (k, (own, due)) in own.iter().zip(&due).enumerate() {
                assert!(
                    *own >= due * (1.0 - 1e-5),
                    "value {k}: {own} for {due}, {place}"
                );
            }
        }
    }
}

/// At a kink the larger side counts. Where both of Akima's weights vanish, which whole numbers
/// make, the reference jumps and the condition does not.
#[test]
fn those_of_local_slopes_are_no_smaller() {
    for name in ["pchip", "akima", "modified-akima"] {
        for (place, own, due) in all(&*methods::find(name).unwrap()) {
            if place.contains("whole-numbers") {
                continue;
            }
            for (k, (own, due)) in own.iter().zip(&due).enumerate() {
                assert!(
                    *own >= due * (1.0 - 1e-5),
                    "value {k}: {own} for {due}, {place}"
                );
            }
        }
    }
}

/// The first and the last ordinate of a periodic spline move together.
#[test]
fn those_of_periodic_splines() {
    const STEP: u32 = 80;
    let method = methods::find("cubic-spline-periodic").unwrap();
    let layout = Layout::new(&*method);
    let cases = Cases::new(&*method, &Settings::default());
    let value = |x: &[Rational]| method.reference(x, 320).certified().unwrap();
    let region = (0..cases.len()).map(|i| cases.get(i));
    for case in region.filter(|c| c.region == "well-scaled").take(6) {
        let x = &case.input;
        let n = layout.lengths(x).unwrap()[0];
        let mut due = conditions_by_differences(&*method, x, |j| j != n && j != 2 * n - 1).unwrap();
        let mut exact: Vec<Rational> = x.iter().map(|x| Rational::from_f64(*x).unwrap()).collect();
        let base = value(&exact);
        for j in [n, 2 * n - 1] {
            exact[j] *= Rational::from(1) + (Rational::from(1) >> STEP);
        }
        for ((sum, a), b) in due.iter_mut().zip(value(&exact)).zip(base) {
            let moved = Float::with_val(64, a.mid() - b.mid()) << STEP;
            *sum += moved.to_f64().abs();
        }
        let own = method.conditions(x).unwrap();
        for (k, (own, due)) in own.iter().zip(&due).enumerate() {
            let off = (own - due).abs();
            assert!(
                off <= 1e-5 * due,
                "value {k}: {own} for {due}, {}",
                case.reproduce()
            );
        }
    }
}

/// Of a law by a table the place, its inner knots and ordinates; the share of the stroke and the
/// ends are exact.
#[test]
fn those_of_tables_are_of_place_and_data() {
    let method = methods::find("cam-law").unwrap();
    let tables = Variant::new(&*method).region("tables").unwrap();
    // Place, kind, share, count, knots, ordinates.
    const TABLE: usize = 4;
    let is_exact = |input: &[f64], j: usize| {
        let knots = (input.len() - TABLE) / 2;
        j == 2 || j >= TABLE && [0, knots - 1].contains(&((j - TABLE) % knots))
    };
    for (place, own, due) in all_but(&tables, is_exact) {
        for (k, (own, due)) in own.iter().zip(&due).enumerate() {
            let off = (own - due).abs();
            assert!(off <= 1e-5 * due, "value {k}: {own} for {due}, {place}");
        }
    }
}
