//! Inputs that are none, closed forms of a bare rotor, the curves that are kept.

use super::*;
use crate::methods::linkages::ClassIii;

#[test]
fn the_last_eight_curves_are_kept() {
    let mut known = Vec::new();
    (0..20).for_each(|k| keep(&mut known, k));
    assert_eq!(known, [12, 13, 14, 15, 16, 17, 18, 19]);
}

/// A constant inertia of 0.5 kg m² for 0.03125 s.
fn rotor(motor: f64, torque: f64, no_load_speed: f64) -> RunUpInput<'static> {
    RunUpInput {
        motor,
        torque,
        no_load_speed,
        phi0: 1.0,
        psi0: 2.0,
        ..bare_rotor_under_kloss()
    }
}

fn refusal(i: RunUpInput) -> Option<&'static str> {
    RunUp::solve(i).err()
}

fn reference(i: RunUpInput) -> Result<Vec<f64>, Uncertified> {
    let values = truth(i, 128)?;
    Ok(values.iter().map(Ball::to_f64).collect())
}

/// Solver and reference against `ψ = ψ0 + T t/I` and, under a straight motor,
/// `ψ = ω0 − (ω0 − ψ0) e^{−M0 t/(I ω0)}`.
#[test]
fn a_bare_rotor_moves_as_its_closed_form_says() {
    let t = 0.03125;
    let steady = [1.0 + 2.0 * t + 0.5 * 20.0 * t * t, 2.0 + 20.0 * t];
    let decay = (-8.0 * t / (0.5 * 4.0f64)).exp();
    let straight = [
        1.0 + 4.0 * t - (4.0 - 2.0) * (0.5 * 4.0 / 8.0) * (1.0 - decay),
        4.0 - (4.0 - 2.0) * decay,
    ];
    for (i, due) in [
        (rotor(STEADY, 10.0, 50.0), steady),
        (rotor(STRAIGHT, 8.0, 4.0), straight),
    ] {
        for found in [RunUp::solve(i).unwrap(), reference(i).unwrap()] {
            let off = |k: usize| (found[k] / due[k] - 1.0).abs();
            assert!(off(0) < 1e-12 && off(1) < 1e-12, "{found:?} {due:?}");
        }
    }
}

#[test]
fn what_does_not_run_is_refused_by_its_name() {
    let rotor = rotor(KLOSS, 200.0, 10.0);
    let screen = sand_screen_from_rest(1e-4);
    assert_eq!((refusal(rotor), refusal(screen)), (None, None));
    for (i, due) in [
        (
            RunUpInput {
                motor: 3.0,
                ..rotor
            },
            "motor",
        ),
        (
            RunUpInput {
                overload: 0.5,
                ..rotor
            },
            "motor",
        ),
        (RunUpInput { i1: -1.0, ..rotor }, "motor"),
        (
            RunUpInput {
                duration: -1.0,
                ..rotor
            },
            "no motion",
        ),
        // Against the way it turns: at rest after 0.025 s.
        (
            RunUpInput {
                torque: -40.0,
                motor: STEADY,
                psi0: 2.0,
                ..rotor
            },
            "stopped",
        ),
        (
            RunUpInput {
                coefficients: 4.0,
                ..screen
            },
            "layout",
        ),
        (
            RunUpInput {
                coefficients: SPLINES,
                nodes: 0.0,
                ..screen
            },
            "splines",
        ),
        (
            RunUpInput {
                coefficients: HYBRID,
                nodes: 0.0,
                ..screen
            },
            "splines",
        ),
    ] {
        assert_eq!(refusal(i), Some(due), "{i:?}");
    }
    let of_linkage = |change: fn(&mut ClassIiiInput)| {
        let mut i = screen;
        change(&mut i.linkage);
        refusal(i)
    };
    assert_eq!(of_linkage(|l| l.geometry.l1 = -0.1), Some("not positive"));
    assert_eq!(of_linkage(|l| l.m2 = -1.0), Some("masses"));
    assert_eq!(
        of_linkage(|l| l.geometry.x5 = 10.0),
        Some("cannot be assembled")
    );
    let layout = Uncertified::Refused("layout");
    for i in [
        RunUpInput {
            motor: 3.0,
            ..rotor
        },
        RunUpInput {
            coefficients: 4.0,
            ..screen
        },
    ] {
        assert_eq!(reference(i), Err(layout.clone()));
    }
    let lost = RunUpInput {
        torque: f64::NAN,
        ..rotor
    };
    assert_eq!(reference(lost), Err(Uncertified::Refused("not finite")));
    let bad = RunUpInput {
        motor: 3.0,
        ..rotor
    };
    let answer = at_tolerance(bad, 1e-6, Integration::default());
    assert_eq!(answer, (0, SolverAnswer::Refuses("motor")));
}

#[test]
fn short_runs_of_whole_kinds_are_admitted() {
    let rotor = RunUpInput {
        duration: 1.0,
        ..rotor(KLOSS, 200.0, 10.0)
    };
    let screen = sand_screen_from_rest(5e-3);
    for (i, due) in [
        (rotor, true),
        (screen, true),
        (
            RunUpInput {
                duration: 5e-3f64.next_up(),
                ..screen
            },
            false,
        ),
        (
            RunUpInput {
                coefficients: 1.5,
                ..screen
            },
            false,
        ),
        (
            RunUpInput {
                nodes: 12.5,
                ..screen
            },
            false,
        ),
        (
            RunUpInput {
                motor: 0.5,
                ..screen
            },
            false,
        ),
        (
            RunUpInput {
                linkage: ClassIiiInput {
                    mode: 1.5,
                    ..screen.linkage
                },
                ..screen
            },
            false,
        ),
        (
            RunUpInput {
                linkage: ClassIiiInput {
                    pivot3: 2.0,
                    ..screen.linkage
                },
                ..rotor
            },
            false,
        ),
    ] {
        assert_eq!(RunUp::admits(i), due, "{i:?}");
    }
}

/// Where the splines' slopes are not those of I_n the balance is no law.
#[test]
fn energy_is_balanced_but_for_hybrid_coefficients() {
    let of = |coefficients: f64| {
        let mut i = sand_screen(coefficients, 12.0, 1e-4);
        i.psi0 = 5.0;
        i.to_vec()
    };
    for coefficients in [CONSTANT, EXACT, SPLINES] {
        let mut x = of(coefficients);
        // An inertia of its own for the rotor without a linkage.
        x[7] = 0.5;
        assert!(energy_law(&x).is_some_and(|r| r <= 1.0), "{coefficients}");
        assert!(restart_law(&x).is_some_and(|r| r <= 1.0), "{coefficients}");
    }
    assert_eq!(energy_law(&of(HYBRID)), None);
    assert!(restart_law(&of(HYBRID)).is_some_and(|r| r <= 1.0));
    assert_eq!((energy_law(&[1.0]), restart_law(&[1.0])), (None, None));
    let mut x = of(EXACT);
    x[2] = 3.0;
    assert_eq!((energy_law(&x), restart_law(&x)), (None, None));
}

#[test]
fn more_evaluations_are_made_at_a_smaller_tolerance() {
    let i = bare_rotor_under_kloss();
    let [coarse, fine] = [1e-4, 1e-10].map(|t| at_tolerance(i, t, Integration::default()));
    assert!(coarse.0 > 0 && fine.0 > coarse.0, "{} {}", coarse.0, fine.0);
    let (SolverAnswer::Values(a), SolverAnswer::Values(b)) = (coarse.1, fine.1) else {
        panic!("no values");
    };
    assert!(a != b && (a[1] / b[1] - 1.0).abs() < 1e-3, "{a:?} {b:?}");
}

/// A curve of another linkage or of fewer bits is another curve.
#[test]
fn curves_are_kept_by_linkage_and_precision() {
    let kept = |change: fn(&mut ClassIiiInput), bits: u32| {
        let mut linkage = at_degrees(14.426, 2.0);
        change(&mut linkage);
        let numbers = exact(&linkage.to_vec()).unwrap();
        curve(ClassIii::unpack(&numbers).unwrap(), bits).unwrap()
    };
    let here = kept(|_| (), 64);
    assert!(!Arc::ptr_eq(&here, &kept(|_| (), 72)));
    assert!(!Arc::ptr_eq(&here, &kept(|l| l.m4 = 500.0, 64)));
}
