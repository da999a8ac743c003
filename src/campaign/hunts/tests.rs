use super::*;
use proptest::prelude::*;

fn found(seed: u64, share: u8, input: u64) -> HuntTally {
    let worst = Worst {
        order: !f64::from(share).to_bits(),
        input: vec![input],
        seed,
        reason: format!("seed {seed}"),
    };
    HuntTally {
        hunts: 1,
        evaluations: 10,
        failures: 1,
        first_failures: vec![(seed, 0, format!("failure {seed}"))],
        worst: vec![((seed % 2) as usize, vec![worst])],
    }
}

#[test]
fn new_worst_inputs_within_budget_pass() {
    let method = crate::methods::find("slider-crank").unwrap();
    let hunted = |share: f64| {
        let mut tally = HuntTally {
            failures: 0,
            ..found(0, 0, 1)
        };
        tally.worst[0].1[0].order = !share.to_bits();
        tally
    };
    // Over every recorded share, and over the budget.
    let output = method.outputs()[0].name;
    let recorded = method.hard();
    let before = recorded.iter().filter(|h| h.output == output);
    let before = before.map(|h| h.share).fold(0.0, f64::max);
    assert!(before < 0.9);
    let within = hunted(0.95);
    assert!(within.worst(&*method)[0].new && within.passed(&*method));
    let over = hunted(1.5);
    assert!(!over.passed(&*method));
    let failed = HuntTally {
        failures: 1,
        ..within
    };
    assert!(!failed.passed(&*method));
}

#[test]
fn an_input_that_two_hunts_find_is_kept_once() {
    let mut sum = found(0, 1, 1);
    for more in [found(2, 1, 1), found(4, 2, 2), found(6, 2, 3)] {
        sum.merge(more);
    }
    let inputs: Vec<u64> = sum.worst[0].1.iter().map(|w| w.input[0]).collect();
    assert_eq!(inputs, [2, 3, 1]);
    let worst = &sum.worst[0].1[0];
    assert_eq!(
        (worst.share(), worst.input()),
        (2.0, vec![f64::from_bits(2)])
    );
}

proptest! {
    #[test]
    fn hunts_add_up_in_any_order(
        // An input has one share.
        shares in prop::collection::vec((0u8..30, 0u64..3), 0..60), cut in 0usize..60,
    ) {
        let all: Vec<HuntTally> = shares.iter().enumerate()
            .map(|(k, (share, n))| found(k as u64, *share, u64::from(*share) + 100 * n))
            .collect();
        let sum = |part: &[HuntTally]| {
            let mut sum = HuntTally::default();
            part.iter().for_each(|t| sum.merge(t.clone()));
            sum
        };
        let whole = sum(&all);
        let (a, b) = all.split_at(cut.min(all.len()));
        for (a, b) in [(a, b), (b, a)] {
            let mut merged = sum(a);
            merged.merge(sum(b));
            let text = serde_json::to_string(&merged).unwrap();
            prop_assert_eq!(&serde_json::from_str::<HuntTally>(&text).unwrap(), &whole);
        }
        for (_, worst) in &whole.worst {
            prop_assert!(worst.len() <= WORST && worst.is_sorted_by(|a, b| a.order <= b.order));
        }
    }
}

/// A share above every recorded one by a hundredth is new; new and over budget is no pass.
#[test]
fn what_is_worse_than_recorded_is_new() {
    let methods = crate::methods::registry();
    let recorded = |m: &dyn Method| {
        let output = m.outputs()[0].name;
        let hard = m.hard();
        let own = hard.iter().filter(|h| h.output == output);
        own.map(|h| h.share).fold(0.0, f64::max)
    };
    let method = methods.iter().find(|m| recorded(&***m) > 0.0).unwrap();
    let before = recorded(&**method);
    let of = |share: f64| {
        let worst = Worst {
            order: !share.to_bits(),
            input: vec![0],
            seed: 1,
            reason: String::new(),
        };
        HuntTally {
            worst: vec![(0, vec![worst])],
            ..HuntTally::default()
        }
    };
    for (share, new) in [
        (0.5 * before, false),
        (1.009 * before, false),
        (1.011 * before, true),
        (f64::INFINITY, true),
    ] {
        let found = of(share).worst(&**method);
        assert_eq!((found.len(), found[0].new), (1, new), "{share}");
    }
    let least = 1.1 * before.max(1.0);
    assert!(!of(least).passed(&**method) && of(0.5 * before).passed(&**method));
    let failing = HuntTally {
        failures: 1,
        ..HuntTally::default()
    };
    assert!(!failing.passed(&**method));
}

/// A hunt of a seed: its worst inputs by the numbers of their outputs, its failures by their
/// commands.
#[test]
fn a_hunt_is_added_with_its_seed() {
    use crate::audit::Worst as Found;
    let method = crate::methods::find("slider-crank").unwrap();
    let outputs = method.outputs();
    let input = vec![1.0, 2.0, 0.25, 0.0, 0.5, 1.0];
    let found = |output: &'static str, share: f64| Found {
        output,
        share,
        input: input.clone(),
        reason: "climbed".into(),
    };
    let failure = |k: u64| Case {
        method: "slider-crank",
        region: "hunt",
        input: vec![k as f64; 6],
        origin: Origin::Given,
    };
    let hunt = Hunt {
        worst: vec![
            found(outputs[1].name, 0.5),
            found("no output", 9.0),
            found(outputs[0].name, 0.25),
        ],
        failures: (0..25).map(failure).collect(),
        evaluations: 77,
        interrupted: false,
    };
    let mut tally = HuntTally::default();
    tally.add(&*method, 42, &hunt);
    assert_eq!(
        (tally.hunts, tally.evaluations, tally.failures),
        (1, 77, 25)
    );
    assert_eq!(tally.first_failures.len(), FAILURES);
    assert_eq!(tally.first_failures[3], (42, 3, failure(3).reproduce()));
    let worst = tally.worst(&*method);
    let all: Vec<(&str, f64, u64)> = worst.iter().map(|w| (w.output, w.share, w.seed)).collect();
    assert_eq!(
        all,
        [(outputs[0].name, 0.25, 42), (outputs[1].name, 0.5, 42)]
    );
    assert!(
        worst
            .iter()
            .all(|w| w.input == input && w.reason == "climbed")
    );
    let v = tally.json(&*method);
    assert_eq!(
        (&v["method"], &v["hunts"], &v["evaluations"]),
        (&"slider-crank".into(), &1.into(), &77.into())
    );
    assert_eq!((&v["failures"], &v["passed"]), (&25.into(), &false.into()));
    assert_eq!(v["first_failures"][3], failure(3).reproduce());
    let one = &v["worst"][1];
    assert_eq!(
        (&one["output"], &one["share"], &one["seed"]),
        (&outputs[1].name.into(), &0.5.into(), &42.into())
    );
    assert_eq!(one["input_hexadecimal"][2], "0x1p-2");
    let again = "mechaudit audit slider-crank --at 0x1p+0,0x1p+1,0x1p-2,0x0p+0,0x1p-1,0x1p+0";
    assert_eq!(one["reproduce"], again);
}
