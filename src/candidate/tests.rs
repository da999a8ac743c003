use super::*;
use crate::audit::Method;
use crate::methods::*;
use crate::solvers::cubic_spline::{Boundary, CubicSpline};
use crate::solvers::cyclic_tridiagonal::CyclicSweep;
use crate::solvers::faddeeva::{dawson, erf, erfc, erfcx, erfi, faddeeva, voigt, w_derivative};
use crate::solvers::tridiagonal::Sweep;
use num_complex::Complex;
use std::sync::Mutex;

fn ours(name: &'static str) -> impl Fn(&[f64]) -> SolverAnswer + Sync {
    let method = methods::find(name).unwrap();
    move |x| method.solve(x)
}

fn few(audit: Audit) -> u64 {
    let report = audit.cases(2).seed(5).run().unwrap();
    report.assert_within_budget().cases
}

fn spline(boundary: fn(SplineProblem) -> Boundary) -> impl Candidate<CubicSplineClamped> {
    move |p: SplineProblem| {
        let s = CubicSpline::fit(p.x.to_vec(), p.y.to_vec(), boundary(p)).ok()?;
        let [a, b] = p.queries;
        let at = |q: f64, to: f64| {
            let j = s.jet(q).ok()?;
            let integral = s.integral(q, to).ok()?;
            Some([j.value, j.first, j.second, j.third, integral])
        };
        Some([at(a, b)?, at(b, a)?])
    }
}

fn sign(positive: bool) -> f64 {
    if positive { 1.0 } else { -1.0 }
}

#[test]
fn every_signature_reaches_its_method() {
    let clamped = |p: SplineProblem| {
        let [a, b] = p.ends.unwrap();
        Boundary::clamped(a, b)
    };
    let [class_iii, run_up] = ["class-iii", "run-up"].map(ours);
    let [cam_law, cam_series] = ["cam-law", "cam-fourier-series"].map(ours);
    let chirp = ours("chirp-response");
    let modes = ours("class-iii-assembly-modes");
    let bar = ours("four-bar");
    let slider = ours("slider-crank");
    let uniform = ours("cubic-spline-uniform");
    let natural = ours("cubic-spline-second-derivatives");
    let [knot, periodic] = ["cubic-spline-not-a-knot", "cubic-spline-periodic"].map(ours);
    let counts = [
        few(audit::<Tridiagonal>(
            |l: &[f64], d: &[f64], u: &[f64], r: &[f64]| Sweep::factor(l, d, u)?.solve(r),
        )),
        few(audit::<CyclicTridiagonal>(
            |l: &[f64], d: &[f64], u: &[f64], r: &[f64]| CyclicSweep::factor(l, d, u)?.solve(r),
        )),
        few(audit::<CubicSplineClamped>(spline(clamped))),
        few(audit::<CubicSplineSecondDerivatives>(
            move |p: SplineProblem| natural(&[p.x, p.y, &p.ends.unwrap(), &p.queries].concat()),
        )),
        few(audit::<CubicSplineNotAKnot>(move |p: SplineProblem| {
            knot(&[p.x, p.y, &p.queries].concat())
        })),
        few(audit::<CubicSplinePeriodic>(move |p: SplineProblem| {
            periodic(&[p.x, p.y, &p.queries].concat())
        })),
        few(audit::<CubicSplineUniform>(
            move |p: UniformSplineProblem| {
                let head = [p.x0, p.h, p.ends[0], p.ends[1], p.queries[0], p.queries[1]];
                uniform(&[&head[..], p.y].concat())
            },
        )),
        few(audit::<FourBar>(
            move |l: [f64; 4], phi: f64, positive: bool| {
                bar(&[&l[..], &[phi, sign(positive)]].concat())
            },
        )),
        few(audit::<SliderCrank>(
            move |l: [f64; 3], delta: f64, phi: f64, ahead: bool| {
                slider(&[&l[..], &[delta, phi, sign(ahead)]].concat())
            },
        )),
        few(audit::<ClassIiiAssemblyModes>(
            move |l: &[f64; 11], phi: f64| modes(&[&l[..], &[phi]].concat()),
        )),
        few(audit::<ClassIii>(move |i: ClassIiiInput| {
            class_iii(&i.to_vec())
        })),
        few(audit::<Faddeeva>(faddeeva)),
        few(audit::<RunUp>(move |i: RunUpInput| run_up(&i.to_vec()))),
        few(audit::<FaddeevaDerivative>(w_derivative)),
        few(audit::<Erf>(erf)),
        few(audit::<Erfc>(erfc)),
        few(audit::<Erfcx>(erfcx)),
        few(audit::<Erfi>(erfi)),
        few(audit::<Dawson>(dawson)),
        few(audit::<Voigt>(voigt)),
        few(audit::<CamLaw>(move |i: CamLawInput| cam_law(&i.to_vec()))),
        few(audit::<CamFourierSeries>(
            move |i: CamFourierSeriesInput| cam_series(&i.to_vec()),
        )),
        few(audit::<ChirpResponse>(move |i: ChirpResponseInput| {
            chirp(&i.to_vec())
        })),
    ];
    assert!(counts.iter().all(|n| *n > 4), "{counts:?}");
}

/// Wrong in the last digits of one component, in one half-plane.
fn faulty(z: Complex<f64>) -> Complex<f64> {
    let mut w = faddeeva(z);
    if z.im < 0.0 {
        w.re *= 1.0 + 1e-14;
    }
    w
}

#[test]
fn a_fault_is_described() {
    let lower = || audit::<Faddeeva>(faulty).region("lower").cases(10);
    let report = lower().run().unwrap();
    assert!(!report.passed() && report.cases == 10);
    let text = report.to_string();
    for part in [
        "faddeeva: FAIL, 10 of 10 cases failed",
        "faddeeva / lower: Re W (value 0) is ",
        "Re z = ",
        " = -0x1.",
        "due ",
        " ± ",
        "ulps",
        ".region(\"lower\").seed(1).case(",
        "mechaudit points faddeeva --region lower --seed 1 --case ",
        "regions    lower: 10 cases, 10 failed",
        "5 more failing cases",
    ] {
        assert!(text.contains(part), "{part:?} is missing in\n{text}");
    }
    // The formula of the method's own solver says nothing of this code.
    assert!(!text.contains("Cell {"), "{text}");
    let one = lower().case(3).run().unwrap();
    assert_eq!((one.cases, one.passed), (1, 0));
    // Its label stands before the first number alone, and one case has a norm.
    let text = one.to_string();
    assert_eq!(text.matches("  input      Re z = ").count(), 1, "{text}");
    assert_eq!(text.matches("\n             Im z = ").count(), 1, "{text}");
    assert!(text.contains("\n  norm       in u worst found "), "{text}");
    // The statistics, then the cases.
    let kept = one.snapshot();
    assert!(
        kept.starts_with("faddeeva: FAIL, 1 of 1 cases failed"),
        "{kept}"
    );
    assert!(kept.contains("\nlower: Re W (value 0) is "), "{kept}");
    let wide = lower().limit(Limit::Ulps(1e4)).run().unwrap();
    wide.assert_within_budget();
}

#[test]
#[should_panic(expected = "due ")]
fn the_assertion_says_what_is_wrong() {
    let zero = |_: Complex<f64>| Complex::new(0.0, 0.0);
    let report = audit::<Faddeeva>(zero).effort(0.01).run().unwrap();
    report.assert_within_budget();
}

#[test]
fn what_cannot_be_run() {
    let plain = || audit_by_name("four-bar", |_: &[f64]| Vec::<f64>::new()).unwrap();
    let refused = |a: Audit| a.run().unwrap_err().to_string();
    let none = audit_by_name("five-bar", |_: &[f64]| 0.0).unwrap_err();
    assert!(
        none.to_string()
            .contains("no method \"five-bar\"; there are: ")
    );
    assert!(refused(plain().region("nowhere")).contains("no region \"nowhere\""));
    assert!(refused(plain().check_point("none")).contains("no check point \"none\""));
    assert!(refused(plain().outputs(&["psi"])).contains("no output \"psi\"; it has: phi2"));
    assert!(refused(plain().effort(f64::NAN)).contains("positive"));
    assert!(refused(plain().limit(Limit::Ulps(0.0))).contains("positive"));
    for norm in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        assert!(
            refused(plain().normwise(norm)).contains("positive"),
            "{norm}"
        );
    }
    for effort in [0.0, f64::INFINITY] {
        assert!(
            refused(plain().effort(effort)).contains("positive"),
            "{effort}"
        );
    }
    assert!(refused(plain().case(3)).contains("which region"));
}

/// The code is asked about nothing outside.
#[test]
fn a_box_and_a_neighbourhood_are_where_cases_are_drawn() {
    let asked = Mutex::new(Vec::new());
    let seen = |z: Complex<f64>| {
        asked.lock().unwrap().push(z);
        faddeeva(z)
    };
    let plain = || audit::<Faddeeva>(seen).seed(5).cases(20);
    plain().sample_box("Re z=3..4,Im z=-2..-1").run().unwrap();
    let boxed = std::mem::take(&mut *asked.lock().unwrap());
    plain().near("3.5,-1.5", 1e-3).run().unwrap();
    let near = std::mem::take(&mut *asked.lock().unwrap());
    for (found, apart) in [(boxed, 0.5), (near, 0.01)] {
        assert!(found.len() >= 20, "{}", found.len());
        for z in found {
            let away = [z.re - 3.5, z.im + 1.5].map(f64::abs);
            assert!(away.iter().all(|d| *d <= apart), "{z}");
        }
    }
}

/// The code gets the cases that are set up, in its precision.
#[test]
fn a_choice_is_what_is_judged() {
    let asked = Mutex::new(Vec::new());
    let method = methods::find("four-bar").unwrap();
    let plain = || {
        let seen = |x: &[f64]| {
            asked.lock().unwrap().push(x.to_vec());
            method.solve(x)
        };
        audit_by_name("four-bar", seen).unwrap().cases(4)
    };
    let judged = |audit: Audit| {
        let report = audit.run().unwrap();
        let inputs = std::mem::take(&mut *asked.lock().unwrap());
        assert_eq!(report.cases, inputs.len() as u64);
        inputs
    };
    let region = method.domain().regions[0].name;
    let in_region = || plain().region(region);
    let ones = judged(in_region());
    assert_eq!(ones.len(), 4);
    let settings = Settings::default();
    let cases = Cases::new(&*method, &settings);
    let third = cases.in_region(region, 2).unwrap().input;
    assert!(ones.contains(&third));
    assert_eq!(judged(in_region().case(2)), [third]);
    assert_eq!(judged(in_region().effort(0.51)).len(), 3);
    assert_eq!(judged(in_region().effort(2.0)).len(), 8);
    let point = &method.domain().check_points[1];
    let held = judged(plain().check_point(point.name));
    assert_eq!(held, std::slice::from_ref(&point.input));
    let first = cases.hard_case(1).unwrap();
    let hard = judged(plain().hard_case(1));
    assert_eq!(hard, [first.input]);
    let all = judged(plain());
    assert!(all.contains(&ones[0]) && all.contains(&point.input) && all.contains(&hard[0]));
    let held = |x: &f64| x.is_nan() || f64::from(*x as f32) == *x;
    assert!(!ones.iter().flatten().all(held));
    assert!(judged(in_region().single()).iter().flatten().all(held));
}

/// A case is that of its check point or number, of one region, one box or one neighbourhood.
#[test]
fn one_case_is_of_one_place() {
    let plain = || audit_by_name("erf", ours("erf")).unwrap().cases(3);
    let place = |audit: Audit| {
        let (_, _, case) = audit.planned().unwrap();
        case.map(|c| c.place())
    };
    let refused = |audit: Audit| audit.run().unwrap_err();
    assert_eq!(place(plain()), None);
    assert_eq!(place(plain().region("mid")), None);
    let mid = Some("--region mid --seed 1 --case 2".to_string());
    assert_eq!(place(plain().region("mid").case(2)), mid);
    let two = || plain().region("mid").region("small");
    assert_eq!(place(two()), None);
    assert_eq!(refused(two().case(2)), AuditError::NoRegion(2));
    assert_eq!(refused(plain().case(4)), AuditError::NoRegion(4));
    let point = methods::find("erf").unwrap().domain().check_points[0].name;
    let at = Some(format!("--check-point {point}"));
    assert_eq!(place(plain().check_point(point)), at);
    assert_eq!(place(plain().check_point(point).case(2)), at);
    assert_eq!(
        place(plain().hard_case(1).check_point(point)),
        Some("--hard-case 1".into())
    );
    let text = "Re z=0..1";
    let boxed = place(plain().region("mid").sample_box(text).case(1)).unwrap();
    assert!(boxed.starts_with("--box "), "{boxed}");
    let near = place(plain().near("0.5,0.5", 0.25).case(1)).unwrap();
    assert!(near.starts_with("--near "), "{near}");
    assert!(matches!(
        refused(plain().hard_case(1_000_000)),
        AuditError::NoSuch(_)
    ));
    assert!(matches!(
        refused(plain().sample_box("Re y=1")),
        AuditError::Sampling(_)
    ));
    assert!(matches!(
        refused(plain().near("x", 0.5)),
        AuditError::Sampling(_)
    ));
}

/// Ten per cent more or less are rounded up; a number that is too large is the largest.
#[test]
fn effort_multiplies_the_cases() {
    let of = |cases: u64, effort: f64| {
        let audit = audit_by_name("erf", ours("erf")).unwrap();
        let (settings, ..) = audit.cases(cases).effort(effort).planned().unwrap();
        settings.cases_per_region
    };
    for (cases, effort, expected) in [
        (200, 1.0, 200),
        (200, 0.001, 1),
        (10, 1.05, 11),
        (0, 7.0, 0),
        (u64::MAX, 2.0, u64::MAX),
    ] {
        assert_eq!(of(cases, effort), expected, "{cases} {effort}");
    }
}

#[test]
fn what_is_asked_for_is_how_it_is_judged() {
    let method = methods::find("erf").unwrap();
    let plain = || {
        audit_by_name("erf", ours("erf"))
            .unwrap()
            .cases(2)
            .region("mid")
    };
    let budgets = |audit: Audit| {
        let (settings, variant, _) = audit.planned().unwrap();
        let variant: &dyn Method = &variant;
        let outputs = variant.outputs();
        let limits: Vec<Limit> = outputs.iter().map(|o| o.budget.limit).collect();
        (limits, variant.norm_budget().is_some(), settings.conditions)
    };
    let own: Vec<Limit> = method.outputs().iter().map(|o| o.budget.limit).collect();
    assert_eq!(
        budgets(plain()),
        (own.clone(), method.norm_budget().is_some(), false)
    );
    let strict = Limit::Relative(0.5);
    assert_eq!(budgets(plain().limit(strict)).0, [strict; 2]);
    assert_eq!(budgets(plain().outputs(&["Im erf"])).0.len(), 1);
    assert!(budgets(plain().normwise(0.5)).1 && budgets(plain().conditions()).2);
    let laws = |audit: Audit| audit.planned().unwrap().1.laws().len();
    assert_eq!(laws(plain()), 0);
    let regions = |audit: Audit| audit.planned().unwrap().1.domain().regions.len();
    let all = || audit_by_name("erf", ours("erf")).unwrap();
    assert!(regions(all().ordinary()) < regions(all()));
    assert_eq!(regions(plain().region("small")), 2);
    // Code that says nothing of itself is a closure.
    let named = |audit: Audit| {
        let candidate = audit.run().unwrap().candidate.clone().unwrap();
        assert_eq!(
            (candidate.answered, candidate.command, candidate.trouble),
            (2, None, None)
        );
        (candidate.name, candidate.version)
    };
    assert_eq!(named(plain()), ("closure".into(), None));
    assert_eq!(
        named(plain().named("mine", Some("2"))),
        ("mine".into(), Some("2".into()))
    );
}

/// Code beside code: each under its name, at the same cases.
#[test]
fn code_is_compared_over_many_cases() {
    let wrong = |_: Complex<f64>| Complex::new(2.0, 2.0);
    let pair = || {
        compare::<Erf>()
            .candidate("right", erf)
            .candidate("wrong", wrong)
    };
    let found = pair()
        .ours()
        .over(|a| a.region("mid").cases(3))
        .run()
        .unwrap();
    let names: Vec<&str> = found.candidates.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(
        (found.method, names),
        ("erf", vec!["right", "wrong", "ours"])
    );
    let all = &found.regions.last().unwrap().standings;
    let failed: Vec<(u64, u64)> = all.iter().map(|s| (s.cases, s.failed)).collect();
    assert_eq!(failed, [(3, 0), (3, 3), (3, 0)]);
    let one = pair().over(|a| a.region("mid").case(1)).run().unwrap_err();
    let place = "--region mid --seed 1 --case 1";
    assert_eq!(one, AuditError::OneCase(place.into()));
    assert_eq!(
        one.to_string(),
        format!("{place} is one case: a comparison is over many")
    );
    let shown = format!("{:?}", pair());
    assert!(
        shown.starts_with("Compare {") && shown.contains("contenders: 2"),
        "{shown}"
    );
    let shown = format!("{:?}", audit::<Erf>(erf).seed(77));
    assert!(
        shown.starts_with("Audit {") && shown.contains("\"erf\"") && shown.contains("seed: 77"),
        "{shown}"
    );
}
