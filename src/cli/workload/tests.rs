use super::*;
use mechaudit::methods;

/// Selects from the method `erf`.
fn selected(place: &WhereArgs, scope: &ScopeArgs, test: impl FnOnce(Result<Workload, Failure>)) {
    let method = methods::find("erf").unwrap();
    let settings = Settings {
        cases_per_region: 4,
        ..Settings::default()
    };
    let selection = Selection {
        place,
        scope,
        input: None,
        laws: true,
    };
    test(Workload::of_one(&*method, selection, settings));
}

fn scope(ulps: Option<f64>, relative: Option<f64>, absolute: Option<f64>) -> ScopeArgs {
    ScopeArgs {
        ulps,
        relative,
        absolute,
        ..ScopeArgs::default()
    }
}

#[test]
fn a_limit_is_the_one_asked_for() {
    for (args, due) in [
        (scope(None, None, None), None),
        (scope(Some(3.0), None, None), Some(Limit::Ulps(3.0))),
        (scope(None, Some(0.5), None), Some(Limit::Relative(0.5))),
        (scope(None, None, Some(0.25)), Some(Limit::Absolute(0.25))),
        (
            scope(None, Some(0.5), Some(0.25)),
            Some(Limit::RelativeOrAbsolute(0.5, 0.25)),
        ),
    ] {
        assert_eq!(limit(&args), due);
        let own = methods::find("erf").unwrap().outputs();
        selected(&WhereArgs::default(), &args, |workload| {
            let judged: &dyn Method = &workload.unwrap().methods[0];
            for (a, b) in judged.outputs().iter().zip(&own) {
                assert_eq!(a.budget.limit, due.unwrap_or(b.budget.limit));
            }
        });
    }
}

#[test]
fn outputs_format_and_norm_are_those_asked_for() {
    let nowhere = WhereArgs::default();
    let args = ScopeArgs {
        outputs: Some(vec!["Im erf".into()]),
        normwise: Some(0.5),
        single: true,
        ..ScopeArgs::default()
    };
    selected(&nowhere, &args, |workload| {
        let found: &dyn Method = &workload.unwrap().methods[0];
        assert!(found.outputs().len() == 1 && found.outputs()[0].name == "Im erf");
        assert_eq!(found.format(), Format::Single);
        assert!(found.norm_budget().is_some());
    });
    selected(&nowhere, &ScopeArgs::default(), |workload| {
        let plain: &dyn Method = &workload.unwrap().methods[0];
        assert_eq!((plain.outputs().len(), plain.format()), (2, Format::Double));
    });
    let none = ScopeArgs {
        outputs: Some(vec!["Im".into()]),
        ..ScopeArgs::default()
    };
    selected(&nowhere, &none, |workload| assert!(workload.is_err()));
}

/// Cases are where the arguments say.
#[test]
fn places_are_those_asked_for() {
    let names = |place: &WhereArgs| {
        let mut all = Vec::new();
        selected(place, &ScopeArgs::default(), |workload| {
            let workload = workload.unwrap();
            let cases = Cases::new(&workload.methods[0], &workload.settings);
            all.extend((0..cases.len()).map(|i| cases.get(i).region));
        });
        all.dedup();
        all
    };
    let some = |list: &[&str]| list.iter().map(|r| r.to_string()).collect();
    let place = WhereArgs {
        regions: some(&["mid", "small"]),
        ..WhereArgs::default()
    };
    let mut two = names(&place);
    two.sort();
    assert_eq!(two, ["mid", "small"]);
    let boxed = WhereArgs {
        sides: Some("Re z=0..1,Im z=0..1".into()),
        ..place
    };
    assert_eq!(names(&boxed), ["box"]);
    let near = WhereArgs {
        near: Some("1,1".into()),
        radius: Some(0.25),
        ..WhereArgs::default()
    };
    assert_eq!(names(&near), ["near"]);
    let plain = names(&WhereArgs::default());
    let ordinary = names(&WhereArgs {
        ordinary: true,
        ..WhereArgs::default()
    });
    assert!(
        ordinary.len() < plain.len() && plain.contains(&"hard"),
        "{plain:?}"
    );
    let nowhere = WhereArgs {
        regions: some(&["nowhere"]),
        ..WhereArgs::default()
    };
    let scope = ScopeArgs::default();
    selected(&nowhere, &scope, |workload| assert!(workload.is_err()));
}
use crate::cli::args::{Args, Command};
use clap::Parser;

#[test]
fn effort_is_a_positive_number() {
    assert_eq!(effort(None).unwrap(), 1.0);
    assert_eq!(effort(Some("2.5".as_ref())).unwrap(), 2.5);
    for bad in ["", "0", "-1", "nan", "inf", "ten"] {
        assert!(effort(Some(bad.as_ref())).is_err(), "{bad}");
    }
}

fn run(words: &[&str]) -> RunArgs {
    let read = Args::try_parse_from([&["mechaudit", "audit"], words].concat());
    match read.unwrap().command {
        Some(Command::Audit(args)) => args.run,
        other => panic!("{other:?}"),
    }
}

#[test]
fn settings_are_the_usual_ones_but_for_what_is_asked() {
    let of = |words: &[&str], effort: f64| at_effort(&run(words), effort);
    let usual = Settings::default();
    let numbers = |s: Settings| (s.seed, s.cases_per_region);
    assert_eq!(numbers(of(&[], 1.0)), numbers(usual.clone()));
    assert_eq!(numbers(of(&["--seed", "7", "--cases", "3"], 1.0)), (7, 3));
    // Rounded up, and no more than there is.
    for (cases, effort, due) in [
        ("3", 0.1, 1),
        ("30", 0.1, 3),
        ("31", 0.1, 4),
        ("3", 2.0, 6),
        ("9007199254740993", 1.0, 9_007_199_254_740_993),
        ("9007199254740993", 1e30, u64::MAX),
    ] {
        let found = of(&["--cases", cases], effort);
        assert_eq!(found.cases_per_region, due, "{cases} {effort}");
    }
    let most = usual.cases_per_region * 2;
    assert_eq!(of(&[], 2.0).cases_per_region, most);
}
