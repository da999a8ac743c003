//! Tests that a fault never passes: a method whose solver, reference and laws go wrong on demand.

use super::*;
use crate::planted::{Planted, output, point, region};
use std::sync::atomic::{AtomicBool, Ordering};

/// The planted fault.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    /// The solver's square is NaN in one region.
    Nan,
    /// The solver gives nothing in one region.
    Silence,
    /// The reference never decides.
    Undecided,
    /// The reference decides at 512 bits.
    Late,
    /// The reference fails at check points.
    Failed,
    /// A law does not hold.
    Law,
    /// A law's residual is NaN.
    LawNan,
}

/// `x²` on `[1, 2)` and `[2, 4)`.
fn square(fault: Fault) -> Planted<'static> {
    Planted {
        outputs: vec![output("y", Limit::Ulps(0.5))],
        domain: Domain {
            regions: vec![
                region("low", |d| vec![d.uniform(1.0, 2.0)]),
                region("high", |d| vec![d.uniform(2.0, 4.0)]),
            ],
            check_points: vec![point("three", &[3.0])],
        },
        solve: Box::new(move |x| {
            let high = (2.0..4.0).contains(&x[0]) && x[0] != 3.0;
            SolverAnswer::Values(match fault {
                Fault::Nan if high => vec![f64::NAN],
                Fault::Silence if high => vec![],
                _ => vec![x[0] * x[0]],
            })
        }),
        reference: Box::new(move |x, bits| match fault {
            Fault::Undecided => ReferenceAnswer::Undecided("never".into()),
            Fault::Late if bits < 512 => ReferenceAnswer::Undecided("not yet".into()),
            Fault::Failed if x[0] == 3 => ReferenceAnswer::Failed("broken".into()),
            _ => ReferenceAnswer::exact([&x[0].clone().square()], bits),
        }),
        laws: vec![Law {
            name: "even",
            statement: "(-x)^2 = x^2",
            residual: match fault {
                Fault::Law => |x| Some(if x[0] > 3.9 { 1.5 } else { 0.0 }),
                Fault::LawNan => |_| Some(f64::NAN),
                _ => |_| Some(1.0),
            },
        }],
        ..Planted::default()
    }
}

fn settings() -> Settings {
    Settings {
        cases_per_region: 100,
        ..Settings::default()
    }
}

fn audited(fault: Fault) -> MethodReport {
    audit_method(&square(fault), &settings(), &|| ())
}

#[test]
fn an_undecided_reference_passes_nothing() {
    let report = audited(Fault::Undecided);
    assert!(!report.passed());
    assert_eq!((report.passed, report.total.undecided), (0, 201));
    let case = Cases::new(&square(Fault::Undecided), &settings()).get(0);
    let one = audit_case(&square(Fault::Undecided), case, &settings());
    assert_eq!(
        (one.judgement.verdict, one.bits),
        (Verdict::Undecided, 2048)
    );
}

#[test]
fn the_precision_grows_until_the_reference_decides() {
    let report = audited(Fault::Late);
    assert!(report.passed());
    let case = Cases::new(&square(Fault::Late), &settings()).get(0);
    let one = audit_case(&square(Fault::Late), case, &settings());
    assert_eq!((one.judgement.verdict, one.bits), (Verdict::Pass, 512));
    // But no farther than allowed.
    let short = Settings {
        last_bits: 256,
        ..settings()
    };
    assert_eq!(audit_method(&square(Fault::Late), &short, &|| ()).passed, 0);
}

#[test]
fn nan_is_a_failure_and_no_error() {
    let report = audited(Fault::Nan);
    assert!(!report.passed());
    assert_eq!((report.passed, report.failed()), (101, 100));
    let y = &report.total.outputs[0];
    // Counted apart: the statistics hold the numbers that came.
    assert_eq!((y.values, y.ulps.count), (201, 101));
    assert!(y.ulps.max <= 0.5 && y.ulps.max > 0.25);
    let high = report.regions.iter().find(|r| r.name == "high").unwrap();
    assert_eq!((high.passed, high.outputs[0].ulps.count), (0, 0));
}

#[test]
fn a_missing_answer_and_a_broken_reference_fail() {
    let silent = audited(Fault::Silence);
    assert!(!silent.passed());
    assert_eq!((silent.passed, silent.failed()), (101, 100));
    let broken = audited(Fault::Failed);
    assert!(!broken.passed());
    assert_eq!((broken.passed, broken.total.reference_failed), (200, 1));
}

#[test]
fn a_law_that_fails_once_fails_the_method() {
    for fault in [Fault::Law, Fault::LawNan] {
        let report = audited(fault);
        // Every case passes.
        assert_eq!(report.passed, 201);
        assert!(!report.passed(), "{fault:?}");
    }
}

#[test]
fn nothing_and_half_of_it_are_no_pass() {
    let none = Settings {
        cases_per_region: 0,
        ..settings()
    };
    // The check point alone is judged.
    assert_eq!(audit_method(&square(Fault::None), &none, &|| ()).cases, 1);
    let stopped = AtomicBool::new(false);
    let tick = || stopped.store(true, Ordering::Relaxed);
    let report = audit_method_until(&square(Fault::None), &settings(), &tick, &stopped);
    assert!(report.interrupted && !report.passed() && report.failed() == 0);
    let empty = Tally::new(&square(Fault::None), &settings()).finish(&square(Fault::None));
    assert!(!empty.passed());
}
