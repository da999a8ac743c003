//! Judgements of W(z): solver, certified reference and verdict, on one core.
//!
//! `cargo bench --bench judgements`. Items are cases; the audit's own sampling and counting is part
//! of `audited`, the laws are not.

use divan::Bencher;
use divan::counter::ItemsCount;
use mechaudit::audit::{Case, Cases, Settings, Tally, Verdict, answer_of, judge_case_briefly};
use mechaudit::methods;
use mechaudit::reference::faddeeva;
use rug::Rational;

const REGIONS: [&str; 5] = ["mid", "far", "lower", "near-real-axis", "small"];
const COUNT: u64 = 1000;

fn main() {
    divan::main();
}

fn cases(region: &str) -> Vec<Case> {
    let method = methods::find("faddeeva").expect("in the registry");
    let cases = Cases::new(&*method, &Settings::default());
    (0..COUNT)
        .map(|i| cases.in_region(region, i).expect("a region"))
        .collect()
}

/// The solver alone.
#[divan::bench(args = REGIONS)]
fn solved(bencher: Bencher, region: &str) {
    let (method, cases) = (methods::find("faddeeva").expect("there"), cases(region));
    bencher.counter(ItemsCount::new(COUNT)).bench(|| {
        for case in &cases {
            divan::black_box(answer_of(&*method, &case.input));
        }
    });
}

/// The reference alone, as the audit asks for it.
#[divan::bench(args = REGIONS)]
fn enclosed(bencher: Bencher, region: &str) {
    let cases = cases(region);
    bencher.counter(ItemsCount::new(COUNT)).bench(|| {
        for case in &cases {
            let exact = [0, 1].map(|i| Rational::from_f64(case.input[i]).expect("finite"));
            divan::black_box(faddeeva::w(&exact[0], &exact[1], 80).expect("decided"));
        }
    });
}

/// Drawn, solved, judged and counted.
#[divan::bench(args = REGIONS)]
fn audited(bencher: Bencher, region: &str) {
    let method = methods::find("faddeeva").expect("there");
    let settings = Settings::default();
    let cases = Cases::new(&*method, &settings);
    bencher.counter(ItemsCount::new(COUNT)).bench(|| {
        let mut tally = Tally::new(&*method, &settings);
        for i in 0..COUNT {
            let case = cases.in_region(region, i).expect("a region");
            let answer = answer_of(&*method, &case.input);
            let report = judge_case_briefly(&*method, case, answer, &settings);
            assert_eq!(report.judgement.verdict, Verdict::Pass);
            tally.add(&report);
        }
        tally.finish(&*method)
    });
}
