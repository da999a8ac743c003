use super::*;
use crate::planted::{Planted, case, off};
use crate::{CaseReport, Law, MethodReport, ReferenceAnswer, audit_case};
use std::collections::BTreeMap;
use std::sync::atomic::AtomicI64;

/// `x` for `x`, some of them over the budget, with a law.
fn planted<'a>() -> Planted<'a> {
    Planted {
        solve: Box::new(|x| SolverAnswer::Values(vec![off(x[0], (x[0] * 7.0) as u64)])),
        laws: vec![Law {
            name: "law",
            statement: "planted",
            residual: |x| (x[0] > 0.1).then_some(x[0]),
        }],
        ..Planted::default()
    }
}

fn nth(i: u64) -> Case {
    case(i, &[i as f64 / 1000.0])
}

/// As the cases are counted one after the other.
fn one_by_one(method: &dyn Method, settings: &Settings, total: u64) -> Tally {
    let mut tally = Tally::lean(method, settings);
    for i in 0..total {
        let report: CaseReport = audit_case(method, nth(i), settings);
        let laws = method.laws();
        let residuals = laws.iter().map(|l| (l.residual)(&[i as f64 / 1000.0]));
        tally.laws(&report.case, &residuals.collect::<Vec<_>>());
        tally.add(&report);
    }
    tally
}

fn pool(threads: usize) -> rayon::ThreadPool {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().unwrap()
}

/// Whatever the number of cases and threads, blocks add up to what is counted one by one.
#[test]
fn how_cases_fall_to_threads_does_not_show() {
    let (method, settings) = (planted(), Settings::default());
    let stop = AtomicBool::new(false);
    for total in [0, 1, 31, 32, 33, 255, 1001] {
        let expected = one_by_one(&method, &settings, total).stored();
        for threads in [1, 2, 3] {
            let (panel, told) = (Panel::lean(&method, &settings), AtomicU64::new(0));
            let tell = |n: u64| {
                told.fetch_add(n, Ordering::Relaxed);
            };
            assert!(pool(threads).install(|| panel.audit(total, &nth, &tell, &stop)));
            assert_eq!(told.into_inner(), total);
            assert!(
                panel.into_tally().stored() == expected,
                "{total} on {threads}"
            );
        }
    }
}

/// Answers that have come from elsewhere, batch by batch: each is counted once, laws are not.
#[test]
fn batches_of_answers_add_up() {
    let (method, settings) = (planted(), Settings::default());
    let panel = Panel::new(&method, &settings);
    let mut from = 0;
    for expected in [1, 32, 0, 1000, 77] {
        let one = |i: u64| (nth(i), method.solve(&nth(i).input));
        let batch = |some: Range<usize>| some.map(|i| one(from + i as u64)).collect();
        assert!(panel.judge(expected as usize, &batch, &|| true));
        from += expected;
    }
    let report = panel.into_tally().finish(&method);
    assert_eq!(report.cases, 1110);
    assert_eq!(report.laws[0].cases, 0);
    let own = one_by_one(&method, &settings, 1110).finish(&method);
    assert_eq!(report.passed, own.passed);
    assert!(0 < report.passed && report.passed < 1110);
}

/// Cases judged when the run is stopped count; the rest are neither solved nor counted.
#[test]
fn a_stop_leaves_the_rest() {
    let solved = Mutex::new(BTreeMap::new());
    let stop = AtomicBool::new(false);
    let method = Planted {
        solve: Box::new(|x| {
            *solved.lock().unwrap().entry(x[0].to_bits()).or_insert(0) += 1;
            SolverAnswer::Values(x.to_vec())
        }),
        reference: Box::new(|x, bits| {
            if x[0] == nth(100).input[0] {
                stop.store(true, Ordering::Relaxed);
            }
            ReferenceAnswer::exact(x, bits)
        }),
        ..Planted::default()
    };
    let settings = Settings::default();
    let panel = Panel::new(&method, &settings);
    assert!(!pool(1).install(|| panel.audit(100_000, &nth, &|_| {}, &stop)));
    let report: MethodReport = panel.into_tally().finish(&method);
    let solved = solved.lock().unwrap();
    assert!(solved.values().all(|times| *times == 1));
    assert!(report.cases > 0 && report.cases <= solved.len() as u64);
    assert!(solved.len() < 99_000, "{}", solved.len());
    // The same for answers.
    let (panel, left) = (Panel::new(&method, &settings), AtomicI64::new(40));
    let one = |i: usize| (nth(i as u64), SolverAnswer::Values(nth(i as u64).input));
    let batch = |some: Range<usize>| some.map(one).collect();
    let go_on = || left.fetch_sub(1, Ordering::Relaxed) > 0 && !stop.load(Ordering::Relaxed);
    stop.store(false, Ordering::Relaxed);
    assert!(!pool(1).install(|| panel.judge(100, &batch, &go_on)));
    // An answer that is not there is no end.
    let short = |some: Range<usize>| some.skip(1).map(one).collect();
    assert!(!Panel::new(&method, &settings).judge(100, &short, &|| true));
    assert!(panel.into_tally().finish(&method).cases <= 40);
}

/// Eight blocks for each thread, of one case at least and 32 at most, one after the other.
#[test]
fn cases_are_judged_in_blocks() {
    for (threads, total, expected) in [
        (1, 5, 1),
        (2, 15, 1),
        (2, 100, 6),
        (3, 100, 4),
        (1, 256, 32),
        (2, 5000, 32),
    ] {
        let asked = Mutex::new(Vec::new());
        pool(threads).install(|| {
            Panel::in_blocks(total, |some| {
                asked.lock().unwrap().push((some.start, some.end))
            });
        });
        let mut asked = asked.into_inner().unwrap();
        asked.sort_unstable();
        let blocks =
            (0..total.div_ceil(expected)).map(|k| (k * expected, total.min((k + 1) * expected)));
        assert_eq!(asked, blocks.collect::<Vec<_>>(), "{total} on {threads}");
    }
}
