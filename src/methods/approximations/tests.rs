//! Orders, names, levels and exact values of approximations.

use super::*;
use crate::audit::convergence;

#[test]
fn splines_converge_as_theory_says() {
    for a in approximations()
        .iter()
        .filter(|a| a.work_unit() == "intervals")
    {
        let report = convergence(&**a).unwrap();
        let last = report.levels.last().unwrap();
        for (k, (e, due)) in last.errors.iter().zip(&report.orders).enumerate() {
            let (order, method) = (e.order.unwrap(), e.method.unwrap());
            if let Some(due) = due {
                assert!((order - due).abs() < 0.4, "{} {k}: order {order}", a.name());
            }
            assert!(e.rounding.unwrap() < 1e-2 * method, "{} {k}", a.name());
            let parts = method + e.rounding.unwrap();
            assert!(e.total <= parts * (1.0 + 1e-9), "{} {k}", a.name());
        }
    }
}

#[test]
fn integrators_gain_with_their_tolerance() {
    for a in approximations()
        .iter()
        .filter(|a| a.work_unit() == "evaluations")
    {
        let report = convergence(&**a).unwrap();
        let ran: Vec<_> = report
            .levels
            .iter()
            .filter(|l| l.failed.is_none())
            .collect();
        let (first, last) = (ran[0], ran[ran.len() - 1]);
        assert!(last.work >= first.work, "{}", a.name());
        assert!(
            last.errors[1].total < 1e-9,
            "{}: {:?}",
            a.name(),
            last.errors
        );
        assert!(
            last.errors[1].total <= first.errors[1].total,
            "{}",
            a.name()
        );
    }
}

#[test]
fn every_approximation_has_its_name() {
    let all = approximations();
    let names: Vec<&str> = all.iter().map(|a| a.name()).collect();
    let due = [
        "spline-clamped",
        "spline-natural",
        "spline-not-a-knot",
        "run-up-verner98-rotor",
        "run-up-verner98-sand-screen",
        "run-up-dop853-rotor",
        "run-up-dop853-sand-screen",
        "run-up-radau5-rotor",
        "run-up-radau5-sand-screen",
    ];
    assert_eq!(names, due);
    for name in due {
        let found = find_approximation(name).unwrap();
        assert_eq!(found.name(), name);
        let of = |text: &str| found.summary().contains(text);
        match name.rsplit('-').next() {
            Some("rotor") => assert!(of("constant inertia"), "{name}"),
            Some("screen") => assert!(of("sand screen"), "{name}"),
            _ => assert!(of(name.trim_start_matches("spline-")), "{name}"),
        }
    }
    assert!(find_approximation("spline").is_none());
}

/// Intervals are halved from 8 on, tolerances go by tenths from 1e-3 on.
#[test]
fn levels_are_refined_by_a_fixed_factor() {
    for a in approximations() {
        let levels: Vec<f64> = a.levels().iter().map(|l| l.parse().unwrap()).collect();
        let is_spline = a.name().starts_with("spline");
        let (first, factor, count) = match is_spline {
            true => (8.0, 2.0, 6),
            false => (1e-3, 0.1, 11),
        };
        assert_eq!(levels.len(), count, "{}", a.name());
        for (k, level) in levels.iter().enumerate() {
            let due = first * f64::powi(factor, k as i32);
            assert!((level / due - 1.0).abs() < 1e-12, "{} {k}", a.name());
        }
        assert_eq!(a.is_regular(), is_spline, "{}", a.name());
    }
}

/// The largest error of the natural spline is next to an end, where it is of second order whatever
/// the rest is: 1.50e-6 with 256 intervals, by a search in multiple precision.
#[test]
fn errors_are_maxima_over_the_whole_range() {
    let natural = find_approximation("spline-natural").unwrap();
    let report = convergence(&*natural).unwrap();
    let last = report.levels.last().unwrap().errors[0];
    assert!((1.45e-6..1.55e-6).contains(&last.total), "{}", last.total);
    assert!((last.order.unwrap() - 2.0).abs() < 0.1, "{:?}", last.order);
    assert!((report.fitted[0].unwrap() - 2.0).abs() < 0.1);
    let due = "the largest error at 2050 places: both ends of [-1, 1] and 8 in each of 256 equal \
               intervals";
    assert_eq!(report.places, due);
    let places: Vec<f64> = queries().collect();
    assert_eq!((places.len(), places[0], places[2049]), (2050, -1.0, 1.0));
    let is_near = |w: &[f64]| w[0] < w[1] && w[1] - w[0] <= 1.001 / 1024.0;
    assert!(places.windows(2).all(is_near));
}

#[test]
fn a_spline_is_worked_out_on_its_intervals() {
    for (name, order) in [
        ("spline-clamped", 4.0),
        ("spline-natural", 2.0),
        ("spline-not-a-knot", 4.0),
    ] {
        let a = find_approximation(name).unwrap();
        let orders: Vec<_> = a.outputs().iter().map(|o| o.1).collect();
        let due = [0.0, 1.0, 2.0, 3.0].map(|k| Some(order - k));
        assert_eq!(orders, due, "{name}");
        for level in [0, 2] {
            let (work, answer) = a.run(level);
            assert_eq!(work, 8 << level);
            let SolverAnswer::Values(values) = answer else {
                panic!("{name}: {answer:?}");
            };
            // Four values at each place, those of the exact spline but for rounding.
            let twin = a.twin(level).unwrap();
            assert_eq!((values.len(), twin.len()), (4 * 2050, 4 * 2050));
            for (k, (value, due)) in values.iter().zip(&twin).enumerate() {
                let due = due.to_f64();
                assert!(
                    (value - due).abs() < 1e-11 * (1.0 + due.abs()),
                    "{name} {k}"
                );
            }
        }
    }
}

/// The n-th derivative of 1/(1 + x²) = −Im 1/(x + i) is −(−1)ⁿ n! Im (x + i)^{−n−1}.
#[test]
fn the_true_values_are_those_of_the_witch() {
    let truth = find_approximation("spline-natural")
        .unwrap()
        .truth()
        .unwrap();
    assert_eq!(truth.len(), 4 * 2050);
    for (x, of_place) in queries().zip(truth.chunks(4)) {
        let z = num_complex::Complex::new(x, 1.0);
        for (n, (value, factor)) in of_place.iter().zip([-1.0, 1.0, -2.0, 6.0]).enumerate() {
            let due = factor * z.powi(-1 - n as i32).im;
            assert!((value.to_f64() - due).abs() < 1e-13, "{x} {n}");
        }
    }
}

/// An implicit method has no twin. Steps cut in two end nearer to the solution, but not there.
#[test]
fn twins_take_the_steps_of_explicit_methods() {
    for name in ["run-up-verner98-rotor", "run-up-dop853-rotor"] {
        let a = find_approximation(name).unwrap();
        let (evaluations, answer) = a.run(0);
        let SolverAnswer::Values(values) = answer else {
            panic!("{name}: {answer:?}");
        };
        assert!(evaluations > 10 && values.len() == 2, "{name}");
        let twin: Vec<f64> = a.twin(0).unwrap().iter().map(Ball::to_f64).collect();
        let halves = a.twin_of_half_steps(0).unwrap();
        for k in [0, 1] {
            assert!((values[k] / twin[k] - 1.0).abs() < 1e-13, "{name} {k}");
            let moved = (halves[k].to_f64() / twin[k] - 1.0).abs();
            assert!(moved > 1e-15 && moved < 1e-3, "{name} {k}: {moved:e}");
        }
    }
    let implicit = find_approximation("run-up-radau5-rotor").unwrap();
    assert!(implicit.twin(0).is_none() && implicit.twin_of_half_steps(0).is_none());
    assert!(implicit.run(0).0 > 10);
}

/// The rotor under its motor for 31 ms, the sand screen's first 4 ms.
#[test]
fn run_ups_are_those_of_their_names() {
    let machines = [
        ("rotor", run_up::bare_rotor_under_kloss()),
        ("sand-screen", run_up::sand_screen_from_rest(0.004)),
    ];
    let methods = [
        ("verner98", Integration::Verner98),
        ("dop853", Integration::Dop853),
        ("radau5", Integration::Radau5),
    ];
    for (machine, input) in machines {
        for (name, method) in methods {
            let a = find_approximation(&format!("run-up-{name}-{machine}")).unwrap();
            assert_eq!(
                a.run(3),
                run_up::at_tolerance(input, 1e-6, method),
                "{name} {machine}"
            );
            assert_eq!(a.outputs(), [("phi", None), ("psi", None)]);
            assert_eq!(a.work_unit(), "evaluations");
            let of = "the error at the end of the run, at ";
            assert!(a.places().starts_with(of), "{name}: {}", a.places());
        }
    }
}
