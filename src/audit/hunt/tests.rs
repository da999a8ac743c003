use super::*;
use crate::planted::{Planted, hard, off, output, point, region};
use crate::{Limit, ReferenceAnswer, SolverAnswer};
use std::sync::Mutex;
use std::sync::atomic::AtomicUsize;

mod moves;

/// A solver with an error in ulps that depends on the input; four ulps take up the budget.
fn wrong_by<'a>(ulps: impl Fn(&[f64]) -> u64 + Sync + 'a) -> Planted<'a> {
    Planted {
        solve: Box::new(move |x| {
            let n = ulps(x);
            SolverAnswer::Values(x.iter().map(|x| off(*x, n)).collect())
        }),
        ..Planted::default()
    }
}

/// Up to rounding.
fn is(share: f64, expected: f64) -> bool {
    (share / expected - 1.0).abs() < 1e-12
}

/// Outputs of these names for as many numbers.
fn with_outputs<'a>(names: &[&'static str], method: Planted<'a>) -> Planted<'a> {
    let outputs = names.iter().map(|name| output(name, Limit::Ulps(4.0)));
    Planted {
        outputs: outputs.collect(),
        ..method
    }
}

fn never() -> AtomicBool {
    AtomicBool::new(false)
}

fn hunter<'a>(
    method: &'a Planted<'a>,
    left: u64,
    progress: &'a (dyn Fn(u64) + Sync),
    stop: &'a AtomicBool,
) -> Hunter<'a> {
    Hunter {
        method,
        answers: None,
        worst: vec![None; method.outputs.len()],
        failures: Vec::new(),
        outputs: method.outputs.iter().map(|o| o.name).collect(),
        settings: Settings::default(),
        left,
        made: 0,
        progress,
        stop,
    }
}

fn found(input: &[f64], shares: Option<&[f64]>) -> Found {
    Found {
        input: input.to_vec(),
        shares: shares.map(Into::into),
        verdict: Verdict::Pass,
        refused: false,
    }
}

/// Returns the numbers shown as progress during a hunt, and its findings.
fn told(method: &Planted, evaluations: u64) -> (Vec<u64>, Hunt) {
    let told = Mutex::new(Vec::new());
    let settings = HuntSettings {
        evaluations,
        seed: 1,
    };
    let hunt = hunt(method, &settings, &|made| told.lock().unwrap().push(made));
    (told.into_inner().unwrap(), hunt)
}

/// Ends of parts of these sizes.
fn ends(sizes: impl IntoIterator<Item = u64>) -> Vec<u64> {
    let mut end = 0;
    let add = |size: u64| {
        end += size;
        end
    };
    sizes.into_iter().map(add).collect()
}

/// A third of the evaluations goes into seeds, a twelfth of the rest into each climb, until none is
/// left.
#[test]
fn evaluations_are_divided() {
    let method = wrong_by(|_| 0);
    // 100 drawn, 100 edges, 99 between; 601 are left.
    let (parts, hunt) = told(&method, 900);
    let mut expected = vec![256, 43];
    expected.extend([16, 16, 16, 2].repeat(12));
    expected.push(1);
    assert_eq!(parts, ends(expected));
    assert_eq!((hunt.evaluations, hunt.interrupted), (900, false));
    // Of more than a dozen outputs each has its share.
    let names = [
        "a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m",
    ];
    let method = with_outputs(&names, method);
    let mut expected = vec![256, 43];
    expected.extend([16, 16, 14].repeat(13));
    expected.push(3);
    assert_eq!(told(&method, 900).0, ends(expected));
}

/// With few evaluations two are drawn in the region, and the climb from each of five seeds has one.
#[test]
fn few_evaluations_are_used_up() {
    let method = wrong_by(|_| 0);
    assert_eq!(told(&method, 12).0, ends([5, 1, 1, 1, 1, 1]));
    assert_eq!(told(&method, 3).0, [3]);
    assert!(told(&method, 0).0.is_empty());
}

/// The same seed finds the same, and of several outputs the worst comes first.
#[test]
fn the_worst_comes_first() {
    let mut method = Planted {
        inputs: vec!["x", "y"],
        outputs: ["mild", "bad"]
            .map(|name| output(name, Limit::Absolute(1.0)))
            .into(),
        solve: Box::new(|x| SolverAnswer::Values(vec![x[0] + 0.25, x[1] + 1.75])),
        ..Planted::default()
    };
    method.domain.regions = vec![region("middle", |d| vec![d.uniform(1.0, 1.5), 1.0])];
    let (_, hunt) = told(&method, 60);
    let names: Vec<_> = hunt.worst.iter().map(|w| w.output).collect();
    assert_eq!(names, ["bad", "mild"]);
    assert!(is(hunt.worst[0].share, 1.75) && is(hunt.worst[1].share, 0.25));
    let again = told(&method, 60).1;
    assert_eq!(again.worst[0].input, hunt.worst[0].input);
    assert_eq!(again.worst[1].reason, hunt.worst[1].reason);
}

/// Findings until the end are kept, and nothing more is tried.
#[test]
fn a_hunt_may_be_ended_early() {
    let stop = AtomicBool::new(false);
    let asked = AtomicUsize::new(0);
    let admits = |_: &[f64]| {
        asked.fetch_add(1, Ordering::Relaxed);
        true
    };
    let method = Planted {
        admits: Box::new(admits),
        ..wrong_by(|_| 1)
    };
    let settings = HuntSettings {
        evaluations: 900,
        seed: 1,
    };
    let end = |_| stop.store(true, Ordering::Relaxed);
    let hunt = hunt_until(&method, &settings, &end, &stop);
    assert_eq!((hunt.evaluations, hunt.interrupted), (256, true));
    assert!(is(hunt.worst[0].share, 0.25));
    // The seeds alone were asked about.
    assert_eq!(asked.load(Ordering::Relaxed), 299);
    let hunt = hunt_until(&method, &settings, &|_| {}, &stop);
    assert_eq!((hunt.evaluations, hunt.worst.len()), (0, 0));
}

/// As many as are left, the first ones, in their order.
#[test]
fn inputs_are_judged_while_evaluations_are_left() {
    let (method, never) = (wrong_by(|x| x[0] as u64), never());
    let told = Mutex::new(Vec::new());
    let progress = |made| told.lock().unwrap().push(made);
    let mut h = hunter(&method, 700, &progress, &never);
    let inputs = |n: u64| (0..n).map(|i| vec![(i % 4) as f64 + 1.5]).collect();
    let found = h.judge(inputs(600));
    assert_eq!((found.len(), h.left, h.made), (600, 100, 600));
    for (i, f) in found.iter().enumerate() {
        assert_eq!(f.input, [(i % 4) as f64 + 1.5]);
        assert!(is(f.share(0), (i % 4 + 1) as f64 / 4.0));
    }
    assert_eq!(h.judge(inputs(600)).len(), 100);
    assert_eq!((h.left, h.made, h.judge(inputs(1)).len()), (0, 700, 0));
    assert_eq!(*told.lock().unwrap(), [256, 512, 600, 700]);
    let stop = AtomicBool::new(true);
    let mut h = hunter(&method, 700, &progress, &stop);
    assert_eq!((h.judge(inputs(3)).len(), h.left, h.made), (0, 0, 0));
}

/// Of each output what is worse than anything before it; of equals the first.
#[test]
fn the_worst_is_kept() {
    let (method, never) = (with_outputs(&["s", "t"], wrong_by(|_| 0)), never());
    let mut h = hunter(&method, 0, &|_| {}, &never);
    for (k, shares) in [
        Some([0.5, 0.0]),
        Some([0.5, 0.25]),
        None,
        Some([0.25, 1.5]),
        Some([0.75, 1.0]),
    ]
    .iter()
    .enumerate()
    {
        let found = found(&[k as f64], shares.as_ref().map(|s| s.as_slice()));
        h.record(&found, &|| format!("number {k}"));
        let worst = |o: usize| h.worst[o].as_ref().map(|w| w.input[0]);
        let expected = [(0.0, 0.0), (0.0, 1.0), (0.0, 1.0), (0.0, 3.0), (4.0, 3.0)][k];
        assert_eq!((worst(0), worst(1)), (Some(expected.0), Some(expected.1)));
    }
    let last = h.worst[0].as_ref().unwrap();
    assert_eq!((last.output, last.share), ("s", 0.75));
    assert_eq!(last.reason, "number 4");
    assert_eq!(h.worst[1].as_ref().unwrap().output, "t");
}

/// Outputs take turns, each its worst seed of the region chosen least for it.
#[test]
fn seeds_are_chosen_in_turn() {
    let seed = |(k, (region, shares)): (usize, (&'static str, [f64; 2]))| Seed {
        found: found(&[k as f64], Some(&shares)),
        kind: "random",
        region,
    };
    let seeds = [
        ("a", [0.9, 0.2]),
        ("a", [0.8, 0.3]),
        ("a", [0.7, 0.1]),
        ("b", [0.1, 0.25]),
    ];
    let seeds: Vec<Seed> = seeds.into_iter().enumerate().map(seed).collect();
    let chosen: Vec<(f64, usize)> = choose(&seeds, 2)
        .iter()
        .map(|(s, o)| (s.found.input[0], *o))
        .collect();
    let expected = [0.0, 1.0, 3.0, 3.0, 1.0, 0.0, 2.0, 2.0];
    let expected: Vec<(f64, usize)> = expected
        .into_iter()
        .zip([0, 1].into_iter().cycle())
        .collect();
    assert_eq!(chosen, expected);
    assert!([0, 1, 2].iter().all(|n| choose(&[], *n).is_empty()));
    // Twenty times as many places as there are climbs: a dozen, or one for each output.
    let many: Vec<Seed> = (0..300)
        .map(|k| seed((k, ("a", [k as f64, 0.0]))))
        .collect();
    let chosen = choose(&many, 1);
    assert_eq!(chosen.len(), 240);
    assert!((0..240).all(|k| chosen[k].0.found.input[0] == (299 - k) as f64));
    let mut wide = many;
    wide.iter_mut()
        .for_each(|s| s.found.shares = Some(vec![0.0; 13]));
    assert_eq!(choose(&wide, 13).len(), 260);
}

/// A share is never less than that of an input without values.
#[test]
fn without_values_there_is_no_share() {
    assert!(found(&[1.0], None).share(0) < 0.0);
    let some = found(&[1.0], Some(&[0.0, 3.0]));
    assert_eq!((some.share(0), some.share(1)), (0.0, 3.0));
}

/// Of each output the largest share of all rows; none where the answer is no number or a refusal.
#[test]
fn shares_are_those_of_outputs() {
    let ulps = [1, 5, 3, 2];
    let mut method = with_outputs(
        &["s", "t"],
        Planted {
            inputs: vec!["a", "b", "c", "d"],
            solve: Box::new(move |x| {
                let pairs = x.iter().zip(ulps);
                SolverAnswer::Values(pairs.map(|(x, n)| off(*x, n)).collect())
            }),
            ..Planted::default()
        },
    );
    let one = |method: &Planted, n: usize| {
        let input = vec![1.5; n];
        let answer = answer_of(method, &input);
        judged(method, &Settings::default(), 2, input, answer)
    };
    let f = one(&method, 4);
    assert!(is(f.share(0), 0.75) && is(f.share(1), 1.25) && f.verdict != Verdict::Pass);
    let f = one(&method, 1);
    assert!(is(f.share(0), 0.25) && f.share(1) == 0.0 && f.verdict == Verdict::Pass);
    method.solve = Box::new(|x| SolverAnswer::Values(vec![f64::NAN; x.len()]));
    let f = one(&method, 4);
    assert!(f.fails_anywhere() && f.shares.is_none());
    method.solve = Box::new(|_| SolverAnswer::Refuses("planted"));
    let f = one(&method, 4);
    assert!(!f.fails_anywhere() && (f.shares, f.verdict) == (None, Verdict::WrongKind));
    method.reference = Box::new(|_, _| ReferenceAnswer::Refuses("planted"));
    let f = one(&method, 4);
    assert_eq!((f.shares, f.verdict), (None, Verdict::Pass));
}

/// Returns kind, region and first number of each seed of a hunt.
fn seeds_of(h: &mut Hunter, budget: u64) -> (Vec<(&'static str, &'static str, f64)>, Vec<f64>) {
    let seeds = h.seeds(budget, &[]);
    let seeds = seeds.iter().map(|s| (s.kind, s.region, s.found.input[0]));
    let failures = h.failures.iter().map(|c| c.input[0]);
    (seeds.collect(), failures.collect())
}

/// Given inputs come first and up to a third of the evaluations.
#[test]
fn hunts_begin_at_given_inputs() {
    let method = Planted {
        solve: Box::new(|x| match x[0] {
            1e9 => SolverAnswer::Values(vec![f64::NAN]),
            v => SolverAnswer::Values(vec![off(v, if v == 1e8 { 3 } else { 0 })]),
        }),
        ..Planted::default()
    };
    let hunt = |given: &[f64]| {
        let given: Vec<Vec<f64>> = given.iter().map(|x| vec![*x]).collect();
        let settings = HuntSettings {
            evaluations: 9,
            seed: 1,
        };
        hunt_from(&method, &settings, &given, &|_| {}, &never())
    };
    let found = hunt(&[1e9, 2.0, 1e8, 3.0]);
    assert_eq!((found.worst[0].input[0], found.failures.len()), (1e8, 1));
    assert!(is(found.worst[0].share, 0.75));
    let found = hunt(&[1e9, 2.0, 3.0, 1e8]);
    assert!(found.worst[0].share < 0.75);
}

/// Check points at multiples of eight, which leave a place for each eighth between them.
fn points() -> Planted<'static> {
    let mut method = wrong_by(|_| 0);
    let names = ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j"];
    let points = names.iter().enumerate();
    let points = points.map(|(k, name)| point(name, &[8.0 * (k + 1) as f64]));
    method.domain.check_points = points.collect();
    method.domain.regions.clear();
    method.hard = [-1.0, -2.0].map(|x| hard(0.5, "x", &[x])).into();
    method
}

/// Each point, its edge, and between it and the next of its region one to seven eighths of the way
/// in turn.
#[test]
fn seeds_lie_at_between_and_beside_cases() {
    let (method, never) = (points(), never());
    let mut h = hunter(&method, 1000, &|_| {}, &never);
    let (seeds, failures) = seeds_of(&mut h, 100);
    assert_eq!((h.made, failures.len()), (12 + 12 + 10, 0));
    let of = |kind| {
        let of = seeds.iter().filter(move |s| s.0 == kind);
        of.map(|s| s.2).collect::<Vec<f64>>()
    };
    let tens: Vec<f64> = (1..=10).map(|k| 8.0 * f64::from(k)).collect();
    assert_eq!(of("check point"), tens);
    assert_eq!(of("hard case"), [-1.0, -2.0]);
    // The first hard case is number 10: 10 % 7 + 1 = 4 eighths of the way from -1 to -2.
    let between = [9.0, 18.0, 27.0, 36.0, 45.0, 54.0, 63.0, 65.0, 74.0, -1.5];
    assert_eq!(of("spaced"), between);
    let all = tens.iter().chain(&[-1.0, -2.0]).enumerate();
    let edges = all.map(|(k, x)| edge(&[*x], &mut Draw::new(1, "planted", "edge", k as u64))[0]);
    assert_eq!(of("edge"), edges.collect::<Vec<_>>());
    let regions = seeds.iter().filter(|s| s.1 == "hard").count();
    assert_eq!(regions, 2 + 2 + 1);
}

/// Layouts of two lengths have nothing between them.
#[test]
fn nothing_lies_between_inputs_of_two_lengths() {
    let (mut method, never) = (points(), never());
    method.hard[1].input.push(5.0);
    let (seeds, _) = seeds_of(&mut hunter(&method, 1000, &|_| {}, &never), 100);
    let spaced: Vec<_> = seeds.iter().filter(|s| s.0 == "spaced").collect();
    assert_eq!(spaced.len(), 9);
    assert!(spaced.iter().all(|s| s.1 == "check-points"));
}

/// Inputs outside of the domain are not judged; of what is undecided only what was drawn is a
/// failure.
#[test]
fn seeds_are_admitted() {
    let (mut method, never) = (points(), never());
    method.admits = Box::new(|x| x[0] < 60.0);
    method.solve = Box::new(|x| match x[0] {
        x if x < 0.0 => SolverAnswer::Refuses("negative"),
        x if x > 30.0 => SolverAnswer::Values(vec![f64::NAN]),
        x => SolverAnswer::Values(vec![off(x, 1)]),
    });
    method.reference = Box::new(|x, bits| match x[0] < 0 {
        true => ReferenceAnswer::Refuses("negative"),
        false => ReferenceAnswer::exact(x, bits),
    });
    let mut h = hunter(&method, 1000, &|_| {}, &never);
    let (seeds, failures) = seeds_of(&mut h, 100);
    let wrong = |h: &Hunter, x: f64| h.failures.iter().any(|c| c.input[0] == x);
    let drawn = [32.0, 40.0, 48.0, 56.0];
    // Between them, and an edge beside each.
    assert_eq!((failures.len(), h.failures.len()), (11, 11));
    let between = [36.0, 45.0, 54.0];
    assert!(
        drawn.iter().chain(&between).all(|x| wrong(&h, *x)),
        "{failures:?}"
    );
    assert!(seeds.iter().all(|s| (0.0..=30.0).contains(&s.2)));
    assert_eq!(seeds.iter().filter(|s| s.0 == "check point").count(), 3);
    // The first judged is the worst, as all are alike.
    let worst = h.worst[0].as_ref().unwrap();
    assert!(is(worst.share, 0.25));
    assert_eq!(worst.input, [8.0]);
    assert_eq!(worst.reason, "check point in check-points");
}

/// A climb that comes where an answer is no number has found a failure.
#[test]
fn climbs_find_failures() {
    let method = Planted {
        admits: Box::new(|x| (1.0..2.0).contains(&x[0])),
        ..Planted::default()
    };
    let solve = |x: &[Vec<f64>]| {
        let answer = |x: &Vec<f64>| match x[0] {
            x if x > 1.51 => SolverAnswer::Values(vec![f64::NAN]),
            x => SolverAnswer::Values(vec![off(x, 3)]),
        };
        x.iter().map(answer).collect::<Vec<_>>()
    };
    let never = never();
    let mut h = hunter(&method, 200, &|_| {}, &never);
    h.answers = Some(&solve);
    let start = Seed {
        found: found(&[1.505], Some(&[0.75])),
        kind: "random",
        region: "all",
    };
    h.climb(&start, 0, 200, &mut Draw::new(1, "planted", "climb", 0));
    assert!(h.failures.iter().all(|c| c.input[0] > 1.51) && !h.failures.is_empty());
}

/// A third of the seeds is drawn, in equal parts from all regions and two from each at least.
#[test]
fn seeds_come_from_all_regions() {
    let (mut method, never) = (wrong_by(|_| 0), never());
    for (regions, budget, each) in [
        (1, 300, 100),
        (1, 11, 3),
        (1, 5, 2),
        (2, 300, 50),
        (2, 0, 2),
    ] {
        method.domain.regions.truncate(1);
        if regions == 2 {
            let seam = region("seam-one", |d| vec![d.uniform(5.0, 6.0)]);
            method.domain.regions.push(seam);
        }
        let mut h = hunter(&method, 1000, &|_| {}, &never);
        let (seeds, _) = seeds_of(&mut h, budget);
        let count = |kind| seeds.iter().filter(|s| s.0 == kind).count();
        let drawn = [
            count("random"),
            count("seam"),
            count("edge"),
            count("spaced"),
        ];
        let seam = if regions == 2 { each } else { 0 };
        let expected = [each, seam, regions * each, regions * (each - 1)];
        assert_eq!(drawn, expected, "{regions} {budget}");
        let right = |s: &&(_, _, f64)| (s.2 > 3.5) == (s.1 == "seam-one");
        assert_eq!(seeds.iter().filter(right).count(), seeds.len());
    }
}

/// Answers from elsewhere are judged in place of the method's own; a batch that is answered in part
/// is the last one.
#[test]
fn answers_may_come_from_elsewhere() {
    let method = Planted {
        // One binade: an ulp is the same everywhere.
        admits: Box::new(|x| (1.0..1.5).contains(&x[0])),
        ..Planted::default()
    };
    let settings = HuntSettings {
        evaluations: 300,
        seed: 1,
    };
    let never = AtomicBool::new(false);
    let hunted = |answers: &Answers| hunt_answers(&method, &settings, answers, &|_| {}, &never);
    let off_by_three = |x: &[Vec<f64>]| {
        let off = |x: &Vec<f64>| f64::from_bits(x[0].to_bits() + 3);
        let answers = x.iter().map(|x| SolverAnswer::Values(vec![off(x)]));
        answers.collect::<Vec<_>>()
    };
    let found = hunted(&off_by_three);
    assert_eq!((found.evaluations, found.worst.len()), (300, 1));
    assert!(is(found.worst[0].share, 0.75), "{:?}", found.worst);
    let seven = |x: &[Vec<f64>]| off_by_three(&x[..7]);
    let found = hunted(&seven);
    assert_eq!((found.evaluations, found.interrupted), (7, false));
}
