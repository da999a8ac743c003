use super::*;
use crate::audit::{HuntSettings, hunt};
use crate::campaign::{Deal, Identity, run};
use crate::machine::Source;
use crate::report::json;
use crate::report::json::campaign as document;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

const PLAN: &str = r#"
    name = "three"
    [[part]]
    methods = ["slider-crank"]
    regions = ["central"]
    cases = 5
    [[part]]
    kind = "hunt"
    methods = ["slider-crank"]
    seeds = [11]
    hunts = 3
    evaluations = 20
    [[part]]
    kind = "candidate"
    methods = ["erf"]
    regions = ["small"]
    cases = 4
    ulps = 3
    exec = "w 1"
"#;

fn plan() -> Plan {
    Plan::read(&Source::toml(PLAN)).unwrap()
}

fn pool() -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(1).build().unwrap()
}

fn who(name: &str, version: Option<&str>) -> Who {
    Who {
        name: name.into(),
        version: version.map(Into::into),
    }
}

/// A shard whose program judges nothing and calls itself so.
fn shard(plan: &Plan, (k, n): (u64, u64), by: &Who) -> (Content, u64) {
    let told = Mutex::new(0);
    let tell = |more: u64| *told.lock().unwrap() += more;
    let stop = AtomicBool::new(false);
    let deal = Deal::new(plan, n);
    let found = run(
        (plan, &deal, k),
        &pool(),
        &|_, _, _, _| Ok(Some(by.clone())),
        &tell,
        &stop,
    );
    (found.unwrap().unwrap(), told.into_inner().unwrap())
}

#[test]
fn a_shard_tells_of_its_work() {
    let plan = plan();
    for (k, n) in [(0, 1), (0, 2), (1, 2)] {
        let deal = Deal::new(&plan, n);
        let asked = deal.of(k)[2].len();
        let (content, told) = shard(&plan, (k, n), &who("w", None));
        // The program tells of none of its cases.
        assert_eq!(told, deal.work_of(k) - asked, "{k} of {n}");
        assert_eq!(content.parts.len(), 3);
    }
}

/// Hunt j of a part has its seed plus j.
#[test]
fn hunts_of_a_part_have_seeds_one_after_the_other() {
    let plan = plan();
    let (content, _) = shard(&plan, (0, 1), &who("w", None));
    let PartContent::Hunt(found) = &content.parts[1] else {
        panic!("the second part hunts");
    };
    let method = plan.parts[1].method();
    let mut expected = HuntTally::default();
    for seed in 11..14 {
        let settings = HuntSettings {
            seed,
            evaluations: 20,
        };
        expected.add(&*method, seed, &hunt(&*method, &settings, &|_| ()));
    }
    assert_eq!(found, &expected);
    assert_eq!(found.hunts, 3);
}

#[test]
fn a_shard_that_is_stopped_or_fails_is_nothing() {
    let plan = plan();
    let deal = Deal::new(&plan, 1);
    let stop = AtomicBool::new(true);
    let found = run(
        (&plan, &deal, 0),
        &pool(),
        &|_, _, _, _| Ok(None),
        &|_| (),
        &stop,
    );
    assert_eq!(found.unwrap(), None);
    let stop = AtomicBool::new(false);
    let while_asked = run(
        (&plan, &deal, 0),
        &pool(),
        &|_, _, _, _| {
            stop.store(true, Ordering::Relaxed);
            Ok(None)
        },
        &|_| (),
        &stop,
    );
    assert_eq!(while_asked.unwrap(), None);
    let stop = AtomicBool::new(false);
    let failed = run(
        (&plan, &deal, 0),
        &pool(),
        &|_, _, _, _| Err("it hangs".into()),
        &|_| (),
        &stop,
    );
    assert_eq!(failed.unwrap_err().to_string(), "part 3: it hangs");
    // Where a shard has no case of a program, the program is not asked.
    let many = Deal::new(&plan, 12);
    let k = (0..12).find(|k| many.of(*k)[2].is_empty()).unwrap();
    let found = run(
        (&plan, &many, k),
        &pool(),
        &|_, _, _, _| panic!("asked"),
        &|_| (),
        &stop,
    );
    let parts = found.unwrap().unwrap().parts;
    assert!(matches!(&parts[2], PartContent::Candidate(_, None)));
}

fn sum_of<'a>(
    plan: &'a Plan,
    methods: &'a [Box<dyn Method>],
    shards: &[(u64, u64)],
    by: &Who,
) -> Sum<'a> {
    let mut sum = Sum::new(plan, methods);
    for at in shards {
        sum.add(shard(plan, *at, by).0).unwrap();
    }
    sum
}

#[test]
fn sums_are_the_same_however_they_are_made() {
    let plan = plan();
    let methods = plan.methods();
    let by = who("w", Some("2"));
    let identity = Identity::of(&plan);
    let shown = |sum: Sum| document(&plan, &identity, &sum.finish(true)).to_string();
    let expected = shown(sum_of(&plan, &methods, &[(0, 1)], &by));
    for order in [[0, 1, 2], [2, 0, 1]] {
        let sum = sum_of(&plan, &methods, &order.map(|k| (k, 3)), &by);
        assert_eq!(sum.shards(), 3);
        assert_eq!(shown(sum), expected);
    }
    let mut all = sum_of(&plan, &methods, &[(1, 3)], &by);
    all.merge(sum_of(&plan, &methods, &[(2, 3), (0, 3)], &by))
        .unwrap();
    all.merge(Sum::new(&plan, &methods)).unwrap();
    assert_eq!(all.shards(), 3);
    assert_eq!(shown(all), expected);
}

#[test]
fn what_is_no_shard_of_the_plan_is_not_added() {
    let plan = plan();
    let methods = plan.methods();
    let (content, _) = shard(&plan, (0, 1), &who("w", None));
    let mut sum = Sum::new(&plan, &methods);
    let mut bad = |parts: Vec<PartContent>| sum.add(Content { parts }).unwrap_err().to_string();
    let kind = "its content is of another kind than its plan's parts";
    assert_eq!(bad(content.parts[..2].to_vec()), kind);
    for [i, j] in [[0, 1], [0, 2], [1, 2]] {
        let mut swapped = content.parts.clone();
        swapped.swap(i, j);
        assert_eq!(bad(swapped), kind, "{i} {j}");
    }
    // An audit of another method has other regions.
    let erf = "name = \"x\"\n[[part]]\nmethods = [\"erf\"]\nregions = [\"small\"]\ncases = 2";
    let (erf, _) = shard(
        &Plan::read(&Source::toml(erf)).unwrap(),
        (0, 1),
        &who("w", None),
    );
    let other = [&erf.parts[..], &content.parts[1..]].concat();
    let why = bad(other);
    assert!(why.starts_with("the method has no "), "{why}");
    assert_eq!(sum.shards(), 0);
}

#[test]
fn two_programs_are_not_added_up() {
    let plan = plan();
    let methods = plan.methods();
    let one = who("w", Some("2"));
    for (other, name) in [(who("w", Some("3")), "w 3"), (who("v", None), "v")] {
        let why = format!("{name} answered here, w 2 elsewhere");
        let mut sum = sum_of(&plan, &methods, &[(0, 2)], &one);
        let (content, _) = shard(&plan, (1, 2), &other);
        assert_eq!(sum.add(content).unwrap_err().to_string(), why);
        assert_eq!(sum.shards(), 1);
        let more = sum_of(&plan, &methods, &[(1, 2)], &other);
        assert_eq!(sum.merge(more).unwrap_err().to_string(), why);
        assert_eq!(sum.shards(), 1);
    }
}

#[test]
fn a_sum_has_a_report_for_each_part() {
    let plan = plan();
    let methods = plan.methods();
    let finished = |complete: bool, by: Option<&Who>| {
        let mut sum = Sum::new(&plan, &methods);
        if let Some(by) = by {
            sum = sum_of(&plan, &methods, &[(0, 1)], by);
        }
        sum.finish(complete)
    };
    let report = |part: &PartSum| match part {
        PartSum::Report(report) => (**report).clone(),
        _ => panic!("no report"),
    };
    let parts = finished(true, Some(&who("w", Some("2"))));
    let own = report(&parts[0]);
    assert_eq!(
        (own.cases, own.interrupted, own.candidate),
        (5, false, None)
    );
    let program = report(&parts[2]);
    let candidate = program.candidate.unwrap();
    assert_eq!(
        (candidate.name.as_str(), candidate.version.as_deref()),
        ("w", Some("2"))
    );
    assert_eq!(
        (candidate.command.as_deref(), candidate.answered),
        (Some("w 1"), 0)
    );
    assert_eq!(program.reproduce.tail, " --exec 'w 1' --ulps 3.0");
    // As of a run that was ended; the program has not said who it is.
    let parts = finished(false, None);
    assert!(report(&parts[0]).interrupted && !parts[0].passed());
    let candidate = report(&parts[2]).candidate.unwrap();
    assert_eq!((candidate.name.as_str(), candidate.version), ("w 1", None));
}

#[test]
fn a_document_says_what_was_judged_and_by_what() {
    let plan = plan();
    let methods = plan.methods();
    let identity = Identity::of(&plan);
    let v = document(
        &plan,
        &identity,
        &sum_of(&plan, &methods, &[(0, 1)], &who("w", None)).finish(true),
    );
    assert_eq!(
        (&v["name"], &v["schema_version"]),
        (&"three".into(), &json::SCHEMA_VERSION.into())
    );
    // 5 cases, 3 hunts of 20 evaluations, 4 cases.
    assert_eq!(
        (&v["work"], &v["mechaudit_version"]),
        (&69.into(), &env!("CARGO_PKG_VERSION").into())
    );
    let digests = [plan.digest(), identity.references, identity.solvers];
    let found =
        ["plan", "references", "solvers"].map(|d| v["digests"][d].as_str().unwrap().to_string());
    assert_eq!(found, digests);
    let parts = v["parts"].as_array().unwrap();
    let kinds: Vec<&str> = parts.iter().map(|p| p["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["audit", "hunt", "candidate"]);
    assert_eq!(parts[0]["label"], "slider-crank, central, seed 1");
    assert_eq!(v["plan"].as_array().unwrap().len(), 3);
    // All as expected, or not.
    let of = |passed: &[bool]| {
        let proofs = passed.iter().map(|p| {
            let mut found = ProofTally::default();
            found.open = u64::from(!p);
            PartSum::Proof(found)
        });
        document(&plan, &Identity::of(&plan), &proofs.collect::<Vec<_>>())["passed"].clone()
    };
    assert_eq!([of(&[true, true]), of(&[true, false])], [true, false]);
}
