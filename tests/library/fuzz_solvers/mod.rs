//! Every solver with numbers of any bits: an answer as documented or a typed error, no panic.
//!
//! `PROPTEST_CASES=100000 cargo test --release --test library fuzz_solvers` looks longer.

mod faddeeva;
mod linkages;
mod motion;
mod run_up;
mod systems;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// The number of cases: as many as are quick, or what `PROPTEST_CASES` says.
pub fn cases(quick: u32) -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES")
        .ok()
        .and_then(|n| n.parse().ok());
    let usual = ProptestConfig::default();
    ProptestConfig {
        cases: asked.unwrap_or(quick),
        failure_persistence: None,
        // The same cases every time, unless more are asked for.
        rng_seed: match asked {
            Some(_) => usual.rng_seed,
            None => RngSeed::Fixed(1),
        },
        ..usual
    }
}

/// Any bits: half of them anything, the rest numbers at which code turns.
fn any_f64() -> impl Strategy<Value = f64> {
    const EDGES: [f64; 25] = [
        0.0,
        0.5,
        1.0,
        2.0,
        7.0,
        26.6,
        27.3,
        708.4,
        745.2,
        1e6,
        1e16,
        1e100,
        1e154,
        1e300,
        f64::MAX,
        f64::MIN_POSITIVE,
        5e-324,
        1e-310,
        1e-160,
        1e-20,
        f64::EPSILON,
        f64::INFINITY,
        f64::NAN,
        std::f64::consts::PI,
        std::f64::consts::TAU,
    ];
    prop_oneof![
        4 => any::<u64>().prop_map(f64::from_bits),
        3 => (prop::sample::select(&EDGES[..]), any::<bool>(), -2i8..=2)
            .prop_map(|(x, negative, steps)| {
                let x = if negative { -x } else { x };
                (0..steps.unsigned_abs()).fold(x, |x, _| match steps > 0 {
                    true => x.next_up(),
                    false => x.next_down(),
                })
            }),
        3 => usual(),
    ]
}

/// Numbers near one, of either sign: with them solvers get somewhere.
fn usual() -> impl Strategy<Value = f64> {
    prop_oneof![-4.0..4.0, -40.0..40.0, (1u8..9).prop_map(f64::from)]
}

/// Either all of any bits or all usual.
fn numbers<const N: usize>() -> impl Strategy<Value = [f64; N]> {
    let array = |s: BoxedStrategy<f64>| prop::collection::vec(s, N);
    prop_oneof![array(any_f64().boxed()), array(usual().boxed()), mixed(N)]
        .prop_map(|v| v.try_into().expect("as many as were drawn"))
}

/// Usual numbers, all but one.
fn mixed(n: usize) -> impl Strategy<Value = Vec<f64>> {
    (prop::collection::vec(usual(), n), any_f64(), 0..n).prop_map(|(mut v, odd, place)| {
        v[place] = odd;
        v
    })
}

fn all_finite(values: &[f64]) -> bool {
    values.iter().all(|x| x.is_finite())
}

/// The text of an error names something.
fn said<T, E: std::error::Error>(result: Result<T, E>) -> Option<T> {
    match result {
        Ok(value) => Some(value),
        Err(e) => {
            assert!(e.to_string().len() > 8, "{e:?}");
            None
        }
    }
}
