//! What an audit costs beside the solver and the certified reference, on one core.
//!
//! `cargo bench --bench judgements`. Items are cases. `owed` is the solver and the reference as the audit asks
//! for it, with condition numbers where a budget needs them; `audited` draws, solves, judges and counts the same
//! cases (the laws are not part of it). `drawn`, `judged` and `counted` are parts of that.

use divan::Bencher;
use divan::counter::ItemsCount;
use mechaudit::audit::{
    Case, Cases, Method, Settings, Tally, Verdict, answer_of, judge_case_briefly,
};
use mechaudit::methods;
use rug::Rational;

/// Of W some regions, of other methods the first.
const WHERE: [&str; 12] = [
    "faddeeva mid",
    "faddeeva far",
    "faddeeva lower",
    "faddeeva near-real-axis",
    "faddeeva small",
    "erf",
    "voigt",
    "tridiagonal",
    "cubic-spline-natural",
    "four-bar",
    "class-iii",
    "chirp-response",
];
const COUNT: u64 = 1000;

fn main() {
    divan::main();
}

/// A method and cases of it that pass.
fn drawn_from(place: &str) -> (Box<dyn Method>, Vec<Case>) {
    let (name, region) = place.split_once(' ').unwrap_or((place, ""));
    let method = methods::find(name).expect("in the registry");
    let cases = Cases::new(&*method, &Settings::default());
    let region = match region {
        "" => method.domain().regions[0].name,
        named => named,
    };
    let cases = (0..COUNT).map(|i| cases.in_region(region, i).expect("a region"));
    let cases = cases.collect();
    (method, cases)
}

#[divan::bench(args = WHERE)]
fn solved(bencher: Bencher, place: &str) {
    let (method, cases) = drawn_from(place);
    bencher.counter(ItemsCount::new(COUNT)).bench(|| {
        for case in &cases {
            divan::black_box(answer_of(&*method, &case.input));
        }
    });
}

#[divan::bench(args = WHERE)]
fn owed(bencher: Bencher, place: &str) {
    let (method, cases) = drawn_from(place);
    let bits = Settings::default().first_bits;
    let outputs = method.outputs();
    let conditional = outputs.iter().any(|o| o.budget.limit.needs_conditions());
    bencher.counter(ItemsCount::new(COUNT)).bench(|| {
        for case in &cases {
            divan::black_box(answer_of(&*method, &case.input));
            let exact: Option<Vec<Rational>> =
                case.input.iter().map(|&x| Rational::from_f64(x)).collect();
            let reference = method.reference(&exact.expect("finite"), bits);
            if conditional {
                divan::black_box(method.conditions_beside(&case.input, &reference));
            }
            divan::black_box(reference);
        }
    });
}

#[divan::bench(args = WHERE)]
fn drawn(bencher: Bencher, place: &str) {
    let (method, drawn) = drawn_from(place);
    let (region, cases) = (drawn[0].region, Cases::new(&*method, &Settings::default()));
    bencher.counter(ItemsCount::new(COUNT)).bench(|| {
        for i in 0..COUNT {
            divan::black_box(cases.in_region(region, i).expect("a region"));
        }
    });
}

#[divan::bench(args = WHERE)]
fn judged(bencher: Bencher, place: &str) {
    let (method, cases) = drawn_from(place);
    let settings = Settings::default();
    let answers: Vec<_> = (cases.iter().map(|c| answer_of(&*method, &c.input))).collect();
    bencher.counter(ItemsCount::new(COUNT)).bench(|| {
        for (case, answer) in cases.iter().zip(&answers) {
            let (case, answer) = (case.clone(), answer.clone());
            divan::black_box(judge_case_briefly(&*method, case, answer, &settings));
        }
    });
}

/// Without what is done once at the end.
#[divan::bench(args = WHERE)]
fn counted(bencher: Bencher, place: &str) {
    let (method, cases) = drawn_from(place);
    let settings = Settings::default();
    let judged = cases.into_iter().map(|case| {
        let answer = answer_of(&*method, &case.input);
        judge_case_briefly(&*method, case, answer, &settings)
    });
    let judged: Vec<_> = judged.collect();
    bencher
        .counter(ItemsCount::new(COUNT))
        .with_inputs(|| {
            let mut tally = Tally::new(&*method, &settings);
            judged.iter().for_each(|report| tally.add(report));
            tally
        })
        .bench_refs(|tally| judged.iter().for_each(|report| tally.add(report)));
}

/// Without what is done once at the beginning and at the end.
#[divan::bench(args = WHERE)]
fn audited(bencher: Bencher, place: &str) {
    let (method, drawn) = drawn_from(place);
    let region = drawn[0].region;
    let settings = Settings::default();
    let cases = Cases::new(&*method, &settings);
    bencher
        .counter(ItemsCount::new(COUNT))
        .with_inputs(|| Tally::new(&*method, &settings))
        .bench_refs(|tally| {
            for i in 0..COUNT {
                let case = cases.in_region(region, i).expect("a region");
                let answer = answer_of(&*method, &case.input);
                let report = judge_case_briefly(&*method, case, answer, &settings);
                assert_eq!(report.judgement.verdict, Verdict::Pass);
                tally.add(&report);
            }
        });
}
