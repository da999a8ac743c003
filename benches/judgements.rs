//! What an audit costs beside the solver and the certified reference, on one core.
//!
//! `cargo bench --bench judgements`. Items are cases. `owed` is the solver and the reference as the audit asks
//! for it: at every precision until it decides, with condition numbers where a budget needs them; `audited` draws, solves, judges and counts the same
//! cases (the laws are not part of it). `drawn`, `judged` and `counted` are parts of that.

use divan::Bencher;
use divan::counter::ItemsCount;
use mechaudit::audit::{Case, Cases, Method, Settings, Tally, answer_of, judge_case_briefly};
use mechaudit::methods;
use rug::Rational;

/// Methods over all their regions, and W in some.
const WHERE: [&str; 13] = [
    "faddeeva",
    "faddeeva mid",
    "faddeeva far",
    "faddeeva lower",
    "faddeeva near-real-axis",
    "faddeeva small",
    "erf",
    "voigt",
    "tridiagonal",
    "cubic-spline-clamped",
    "four-bar",
    "class-iii",
    "chirp-response",
];
const COUNT: u64 = 1000;

fn main() {
    divan::main();
}

/// A method with the places of random cases: region and number.
fn places(place: &str) -> (Box<dyn Method>, Vec<(&'static str, u64)>) {
    let (name, region) = place.split_once(' ').unwrap_or((place, ""));
    let method = methods::find(name).expect("in the registry");
    let regions = method.domain().regions.into_iter().map(|r| r.name);
    let regions: Vec<_> = regions
        .filter(|r| region.is_empty() || *r == region)
        .collect();
    let n = regions.len() as u64;
    let places = (0..COUNT).map(|i| (regions[(i % n) as usize], i / n));
    (method, places.collect())
}

/// A method and cases.
fn drawn_from(place: &str) -> (Box<dyn Method>, Vec<Case>) {
    let (method, places) = places(place);
    let cases = Cases::new(&*method, &Settings::default());
    let cases = places.iter().map(|(r, i)| cases.in_region(r, *i));
    let cases = cases.map(|case| case.expect("a region")).collect();
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
    let settings = Settings::default();
    let first = settings.first_bits;
    // The precision that decides.
    let cases = cases.into_iter().map(|case| {
        let answer = answer_of(&*method, &case.input);
        let judged = judge_case_briefly(&*method, case.clone(), answer, &settings);
        (case, judged.bits)
    });
    let cases: Vec<(Case, u32)> = cases.collect();
    let outputs = method.outputs();
    let conditional = outputs.iter().any(|o| o.budget.limit.needs_conditions());
    bencher.counter(ItemsCount::new(COUNT)).bench(|| {
        for (case, last) in &cases {
            divan::black_box(answer_of(&*method, &case.input));
            let exact: Option<Vec<Rational>> =
                case.input.iter().map(|&x| Rational::from_f64(x)).collect();
            // Inputs that are not finite owe nothing.
            let Some(exact) = exact else { continue };
            let mut bits = first;
            while bits <= *last {
                let reference = method.reference(&exact, bits);
                if conditional && bits == first {
                    divan::black_box(method.conditions_beside(&case.input, &reference));
                }
                divan::black_box(reference);
                bits *= 2;
            }
        }
    });
}

#[divan::bench(args = WHERE)]
fn drawn(bencher: Bencher, place: &str) {
    let (method, places) = places(place);
    let cases = Cases::new(&*method, &Settings::default());
    bencher.counter(ItemsCount::new(COUNT)).bench(|| {
        for (region, i) in &places {
            divan::black_box(cases.in_region(region, *i).expect("a region"));
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
    let (method, places) = places(place);
    let settings = Settings::default();
    let cases = Cases::new(&*method, &settings);
    bencher
        .counter(ItemsCount::new(COUNT))
        .with_inputs(|| Tally::new(&*method, &settings))
        .bench_refs(|tally| {
            for (region, i) in &places {
                let case = cases.in_region(region, *i).expect("a region");
                let answer = answer_of(&*method, &case.input);
                let report = judge_case_briefly(&*method, case, answer, &settings);
                tally.add(&report);
            }
        });
}
