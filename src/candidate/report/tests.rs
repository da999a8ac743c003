use super::*;
use crate::audit::Kind;

/// Unknown facts, and only those, are left out of the words.
#[test]
fn errors_in_words() {
    let of = |ulps: f64, conditioned: f64, condition: f64| {
        error(&ComponentJudgement {
            output: "y",
            verdict: Verdict::Over,
            kind: None,
            ulps,
            conditioned,
            of_budget: 1.5,
            condition,
        })
    };
    assert_eq!(
        of(3.0, 0.25, 20.0),
        "3.000 ulps, 0.250 u (1 + condition), 1.500 of its budget, condition 20.000"
    );
    let nan = f64::NAN;
    assert_eq!(
        of(nan, 2e7, nan),
        "2.00e7 u (1 + condition), 1.500 of its budget"
    );
    assert_eq!(
        of(2000.0, nan, f64::INFINITY),
        "2000 ulps, 1.500 of its budget"
    );
    assert_eq!(of(nan, nan, nan), "1.500 of its budget");
}

#[test]
fn figures_are_short() {
    for (x, expected) in [
        (0.0, "0.000"),
        (-1.0, "-1.000"),
        (0.001, "0.001"),
        (0.0009, "9.00e-4"),
        (999.9996, "1000.000"),
        (1234.5, "1234"),
        (1e6, "1.00e6"),
        (f64::INFINITY, "inf"),
    ] {
        assert_eq!(short(x), expected);
    }
}

#[test]
fn wrong_answers_are_counted_by_kind() {
    let mut kinds = Kinds::default();
    assert_eq!(wrong(&kinds), "");
    (kinds[Kind::Nan], kinds[Kind::Missing]) = (2, 1);
    let [nan, missing] = [Kind::Nan, Kind::Missing].map(Kind::name);
    assert_eq!(
        wrong(&kinds),
        format!("; wrong in kind: 2 {nan}, 1 {missing}")
    );
}

fn of(answer: impl Fn(&[f64]) -> SolverAnswer + Sync) -> Report {
    let audit = crate::audit_by_name("erf", answer).unwrap();
    audit.region("mid").cases(20).seed(3).run().unwrap()
}

fn ours() -> impl Fn(&[f64]) -> SolverAnswer + Sync {
    let method = crate::methods::find("erf").unwrap();
    move |x| method.solve(x)
}

/// Far off, as far as `k` says: none, some or all of the answers are wrong, some of them refusals.
fn counted(off: usize, refused: usize) -> Report {
    let seen = std::sync::Mutex::new(std::collections::BTreeMap::new());
    let own = ours();
    of(move |x: &[f64]| {
        let mut seen = seen.lock().unwrap();
        let n = seen.len();
        let key: Vec<u64> = x.iter().map(|x| x.to_bits()).collect();
        let k = *seen.entry(key).or_insert(n);
        match k {
            k if k < off => SolverAnswer::Values(vec![1e9, 1e9]),
            k if k < off + refused => SolverAnswer::Declines(None),
            _ => own(x),
        }
    })
}

#[test]
fn a_few_failing_cases_are_written_out() {
    for (off, refused, shown) in [
        (0, 0, 0),
        (4, 0, 4),
        (5, 0, 5),
        (9, 0, 5),
        (0, 3, 3),
        // Three of each wrong kind are kept.
        (7, 8, 8),
        (2, 9, 5),
    ] {
        let report = counted(off, refused);
        let text = report.to_string();
        assert_eq!(report.failed() as usize, off + refused);
        assert_eq!(text.matches("\nerf / mid: ").count(), shown, "{text}");
        let left = off + refused - shown;
        let more = format!("\n{left} more failing cases\n");
        assert_eq!(text.ends_with(&more), left > 0, "{text}");
        assert_eq!(text.contains("more failing cases"), left > 0, "{text}");
    }
}

fn spread() -> Spread {
    Spread {
        count: 40,
        beyond: 0,
        max: 2.0,
        p99: 1.5,
        p9999: None,
        median: 0.5,
        rms: 0.75,
    }
}

#[test]
fn figures_name_what_is_beyond_all_numbers() {
    let expected = "worst found 2.000, 99 % below 1.500, median 0.500, RMS 0.750";
    assert_eq!(figures(&spread()), expected);
    let beyond = Spread {
        beyond: 3,
        ..spread()
    };
    assert_eq!(figures(&beyond), format!("{expected}, 3 beyond 1e308"));
}

#[test]
fn statistics_are_a_head_and_a_line_for_each_part() {
    let mut report = of(ours());
    let found = &mut report.found;
    found.total.normwise = Some(spread());
    for o in &mut found.total.outputs {
        (o.values, o.ulps, o.max_of_budget) = (40, spread(), 0.25);
    }
    found.total.outputs[1].kinds[crate::audit::Kind::Nan] = 2;
    let more = found.regions[0].clone();
    found.regions[0].max_of_budget = 0.25;
    found.regions.push(more);
    found.regions[1].name = "other";
    (found.regions[1].over, found.regions[1].passed) = (3, 17);
    found.regions[1].max_of_budget = 4.0;
    let text = report.snapshot();
    let ulps = "worst found 2.000, 99 % below 1.500, median 0.500, RMS 0.750";
    let nan = crate::audit::Kind::Nan.name();
    let lines: Vec<&str> = text.lines().collect();
    let expected = [
        "erf: pass, 20 of 20 cases within budget (seed 3, 20 cases per region)".to_string(),
        format!("  Re erf     40 values; in ulps {ulps}; 0.250 of its budget"),
        format!(
            "  Im erf     40 values; in ulps {ulps}; 0.250 of its budget; wrong in kind: 2 {nan}"
        ),
        format!("  norm       in u {ulps}"),
    ];
    assert_eq!(lines[..4], expected);
    let budget = lines
        .iter()
        .position(|l| l.starts_with("  budget     Re erf"))
        .unwrap();
    assert_eq!(budget, 4);
    let regions = [
        "  regions    mid: 20 cases, 0.250 of a budget at most",
        "             other: 20 cases, 3 failed, 4.000 of a budget at most",
    ];
    let at = lines
        .iter()
        .position(|l| *l == regions[0])
        .unwrap_or_else(|| panic!("{text}"));
    assert_eq!(lines[at + 1], regions[1]);
    report.found.recorded = 2;
    let head = "20 of 20 cases within budget, 2 hard cases over it by no more than the method's own solver (seed 3,";
    assert!(report.snapshot().contains(head));
    // Nothing is said of a norm without values.
    report.found.total.normwise = Some(Spread {
        count: 0,
        ..spread()
    });
    assert!(!report.snapshot().contains("\n  norm "));
}

/// Outputs of one budget share a line.
#[test]
fn budgets_are_grouped() {
    let of = |name: &str| {
        let method = crate::methods::find(name).unwrap();
        let settings = crate::audit::Settings {
            cases_per_region: 1,
            ..Default::default()
        };
        let case = crate::audit::Cases::new(&*method, &settings).get(0);
        let found = crate::audit::audit_one(&*method, case, None, &settings);
        let outputs: Vec<_> = method.outputs();
        (Report::new(&*method, found), outputs)
    };
    for name in ["erf", "four-bar", "run-up"] {
        let (report, outputs) = of(name);
        let names: Vec<&str> = report.budgets.iter().flat_map(|b| b.0.clone()).collect();
        assert_eq!(names.len(), outputs.len(), "{name}");
        for o in &outputs {
            let own: Vec<_> = report
                .budgets
                .iter()
                .filter(|b| b.0.contains(&o.name))
                .collect();
            assert!(own.len() == 1 && own[0].1 == o.budget, "{name} {}", o.name);
        }
        for (k, a) in report.budgets.iter().enumerate() {
            assert!(report.budgets[..k].iter().all(|b| b.1 != a.1), "{name}");
        }
    }
}

/// The answer that came, and the command that judges the case again.
#[test]
fn a_case_says_what_came_and_where_it_is() {
    use crate::candidate::Audit;
    let of = |answer: SolverAnswer, place: &dyn Fn(Audit<'_>) -> Audit<'_>| {
        let audit = crate::audit_by_name("erf", move |_: &[f64]| answer.clone()).unwrap();
        let report = place(audit).cases(3).seed(7).run().unwrap();
        assert_eq!((report.cases, report.passed()), (1, false));
        report.to_string()
    };
    let wrong = SolverAnswer::Values(vec![0.25, 1e9]);
    let point = crate::methods::find("erf").unwrap().domain().check_points[0].name;
    let boxed = "Re z=1..2,Im z=1..2";
    type Place<'a> = &'a dyn Fn(Audit<'_>) -> Audit<'_>;
    let places: [(Place, String); 5] = [
        (
            &|a| a.check_point(point),
            format!(".check_point({point:?})"),
        ),
        (&|a| a.hard_case(1), ".hard_case(1)".into()),
        (
            &|a| a.region("mid").case(2),
            ".region(\"mid\").seed(7).case(2)".into(),
        ),
        (
            &|a| a.sample_box(boxed).case(1),
            format!(".sample_box({boxed:?}).seed(7).case(1)"),
        ),
        (
            &|a| a.near("1.5,1.5", 1e-3).case(0),
            ".near(\"1.5,1.5\", 1e-3).seed(7).case(0)".into(),
        ),
    ];
    for (place, expected) in places {
        let text = of(wrong.clone(), place);
        assert!(
            text.contains(&format!(
                "\n  reproduce  {expected}\n             mechaudit points erf --"
            )),
            "{text}"
        );
        assert!(text.contains("\n  Re erf     0.25 = 0x1p-2\n"), "{text}");
    }
    let got = |answer: SolverAnswer| of(answer, &|a| a.region("mid").case(2));
    for (answer, expected) in [
        (SolverAnswer::Declines(None), "a refusal: no reason"),
        (
            SolverAnswer::Declines(Some("singular".into())),
            "a refusal: singular",
        ),
        (SolverAnswer::Fails("it cannot be read".into()), "no answer"),
        (SolverAnswer::Unanswered("it is silent".into()), "no answer"),
    ] {
        let text = got(answer);
        assert!(
            text.contains(&format!("\n  got        {expected}\n")),
            "{text}"
        );
    }
    // A value more than there are outputs has no name.
    let text = got(SolverAnswer::Values(vec![0.0, 0.0, 0.5]));
    assert!(text.contains("\n  got        0.5 = 0x1p-1\n"), "{text}");
}
