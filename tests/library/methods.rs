//! Every audited method passes over its whole domain.
//!
//! `MECHAUDIT_EFFORT` (a positive number, default 1) multiplies the number of cases.

use mechaudit::audit::{
    Cases, Settings, audit_method, audit_method_until, error_map, hex_float, map_points,
};
use mechaudit::methods;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

fn effort() -> f64 {
    match std::env::var("MECHAUDIT_EFFORT") {
        Err(_) => 1.0,
        Ok(text) => match text.parse::<f64>() {
            Ok(x) if x.is_finite() && x > 0.0 => x,
            _ => panic!("MECHAUDIT_EFFORT={text:?} is not a positive number"),
        },
    }
}

#[test]
fn all_methods_pass() {
    let settings = Settings {
        seed: 20_081_127,
        cases_per_region: (20.0 * effort()).ceil() as u64,
        ..Settings::default()
    };
    let mut failed = String::new();
    for method in methods::registry() {
        let report = audit_method(&*method, &settings, &|| ());
        for f in report.failures.iter().take(3) {
            let hex: Vec<String> = f.case.input.iter().map(|&x| hex_float(x)).collect();
            failed += &format!(
                "{}: {:?} {}\n  {}\n  input {:?}\n  = {}\n",
                report.method,
                f.judgement.verdict,
                f.judgement.why().unwrap_or_default(),
                f.case.reproduce(),
                f.case.input,
                hex.join(" "),
            );
        }
        for law in report.laws.iter().filter(|l| !(l.worst <= 1.0)) {
            failed += &format!(
                "{}: law {} broken, {}\n",
                report.method, law.name, law.worst
            );
        }
        assert!(report.cases > 0, "{} has no cases", report.method);
    }
    assert!(failed.is_empty(), "\n{failed}");
}

/// A solver with a planted fault fails its own method's audit.
mod planted {
    use super::*;
    use mechaudit::audit::{Method, SolverAnswer, Variant, Verdict, audit_case};

    type Fault = fn(&mut Vec<f64>);

    fn faulty(method: &dyn Method, fault: Fault) -> Variant<'_> {
        Variant::new(method).solver(move |x| match method.solve(x) {
            SolverAnswer::Values(mut v) => {
                fault(&mut v);
                SolverAnswer::Values(v)
            }
            refused => refused,
        })
    }

    #[test]
    fn faults_are_found_in_every_method() {
        let faults: [(&str, Fault); 6] = [
            ("nan", |v| v[0] = f64::NAN),
            ("infinity", |v| *v.last_mut().unwrap() = f64::INFINITY),
            ("sign", |v| v.iter_mut().for_each(|x| *x = -*x)),
            ("relative error 1e-6", |v| {
                v.iter_mut().for_each(|x| *x *= 1.0 + 1e-6)
            }),
            ("one value missing", |v| v.truncate(v.len() - 1)),
            ("panic", |_| panic!("planted")),
        ];
        let hook = std::panic::take_hook();
        std::panic::set_hook(Box::new(|_| ()));
        let settings = Settings {
            cases_per_region: 2,
            ..Settings::default()
        };
        let mut missed = Vec::new();
        for name in methods::registry().iter().map(|m| m.name()) {
            for (what, fault) in faults {
                let method = methods::find(name).unwrap();
                let report = audit_method(&faulty(&*method, fault), &settings, &|| ());
                if report.passed() || report.failures.is_empty() {
                    missed.push(format!("{name}: {what}"));
                }
            }
        }
        std::panic::set_hook(hook);
        assert!(missed.is_empty(), "{missed:?}");
    }

    /// Where budgets are a few units in the last place and infinities are due.
    #[test]
    fn small_faults_are_found_in_the_relatives_of_w() {
        let faults: [(&str, Fault); 3] = [
            ("six units in the last place", |v| {
                let finite = v.iter_mut().filter(|x| x.is_finite() && **x != 0.0);
                finite.for_each(|x| *x = f64::from_bits(x.to_bits() + 6))
            }),
            ("infinities of the wrong sign", |v| {
                let infinite = v.iter_mut().filter(|x| x.is_infinite());
                infinite.for_each(|x| *x = -*x)
            }),
            ("a number for NaN", |v| {
                let nan = v.iter_mut().filter(|x| x.is_nan());
                nan.for_each(|x| *x = 0.0)
            }),
        ];
        let settings = Settings {
            cases_per_region: 2,
            ..Settings::default()
        };
        let names = ["erf", "erfc", "erfcx", "erfi", "dawson", "voigt"];
        let more = ["faddeeva-derivative", "voigt-hwhm"];
        for name in names.into_iter().chain(more) {
            for (what, fault) in faults {
                let method = methods::find(name).unwrap();
                let report = audit_method(&faulty(&*method, fault), &settings, &|| ());
                assert!(!report.failures.is_empty(), "{name}: {what}");
            }
        }
    }

    #[test]
    fn a_failing_case_is_reproduced_from_its_origin() {
        let method = methods::find("tridiagonal").unwrap();
        let method = faulty(&*method, |v| v[0] += 1.0);
        let settings = Settings {
            cases_per_region: 3,
            ..Settings::default()
        };
        let report = audit_method(&method, &settings, &|| ());
        let failure = &report.failures[0];
        let again = audit_case(&method, failure.case.clone(), &settings);
        assert_eq!(again.judgement.verdict, failure.judgement.verdict);
        assert_ne!(again.judgement.verdict, Verdict::Pass);
    }
}

#[test]
fn functions_of_a_complex_variable_have_maps() {
    let of_the_plane = |m: &dyn mechaudit::audit::Method| {
        let names: Vec<&str> = m.inputs().iter().map(|i| i.name).collect();
        names == ["Re z", "Im z"]
    };
    let all = methods::registry();
    assert_eq!(all.iter().filter(|m| of_the_plane(&***m)).count(), 7);
    for m in &all {
        assert_eq!(
            map_points(&**m).is_some(),
            of_the_plane(&**m),
            "{}",
            m.name()
        );
    }
}

#[test]
fn a_map_ends_where_it_is_stopped() {
    let method = methods::find("erf").unwrap();
    let settings = Settings {
        cases_per_region: 1,
        maps: true,
        ..Settings::default()
    };
    let cases = Cases::new(&*method, &settings).len();
    let (stop, seen) = (AtomicBool::new(false), AtomicUsize::new(0));
    let until = |most: usize| {
        stop.store(false, Ordering::Relaxed);
        seen.store(0, Ordering::Relaxed);
        move |stop: &AtomicBool, seen: &AtomicUsize| {
            if seen.fetch_add(1, Ordering::Relaxed) == most {
                stop.store(true, Ordering::Relaxed);
            }
        }
    };
    let tick = until(100);
    let map = error_map(&*method, &settings, &|| tick(&stop, &seen), &stop);
    assert!(map.is_none() && seen.load(Ordering::Relaxed) < 1000);
    // An audit keeps its cases, and does not pass.
    let tick = until(cases + 100);
    let report = audit_method_until(&*method, &settings, &|| tick(&stop, &seen), &stop);
    assert!(report.interrupted && !report.passed() && report.map.is_none());
    assert_eq!(report.cases, cases as u64);
}
