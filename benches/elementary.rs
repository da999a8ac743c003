//! Elementary functions of exact numbers of moderate size: balls beside MPFR's own functions.
//!
//! `cargo bench --bench elementary`. Items are values.

use divan::Bencher;
use divan::counter::ItemsCount;
use mechaudit::reference::elementary::{self, Evaluated};
use mechaudit::reference::{Ball, Mag};
use rug::Float;
use rug::ops::Pow;

fn main() {
    divan::main();
}

const BITS: [u32; 3] = [64, 128, 192];

fn numbers(bits: u32) -> Vec<Ball> {
    let of = |k: u32| Ball::new(Float::with_val(bits, k) * 0.0137_f64, Mag::ZERO);
    (1..1000).map(of).collect()
}

/// Benchmarks a function of balls and one of MPFR.
macro_rules! beside {
    ($name:ident, $ours:expr, $mpfr:expr) => {
        mod $name {
            use super::*;

            #[divan::bench(args = BITS)]
            fn balls(bencher: Bencher, bits: u32) {
                let of: fn(&Ball, u32) -> Evaluated = $ours;
                let numbers = numbers(bits);
                bencher.counter(ItemsCount::new(numbers.len())).bench(|| {
                    for x in &numbers {
                        divan::black_box(of(x, bits).expect("a value"));
                    }
                });
            }

            #[divan::bench(args = BITS)]
            fn mpfr(bencher: Bencher, bits: u32) {
                let of: fn(&Float, u32) -> Float = $mpfr;
                let numbers = numbers(bits);
                bencher.counter(ItemsCount::new(numbers.len())).bench(|| {
                    for x in &numbers {
                        divan::black_box(of(x.mid(), bits));
                    }
                });
            }
        }
    };
}

fn exponent(bits: u32) -> Ball {
    Ball::new(Float::with_val(bits, -1.5), Mag::ZERO)
}

beside!(exp, elementary::exp, |x, p| Float::with_val(p, x.exp_ref()));
beside!(log, elementary::log, |x, p| Float::with_val(p, x.ln_ref()));
beside!(sin, elementary::sin, |x, p| Float::with_val(p, x.sin_ref()));
beside!(cos, elementary::cos, |x, p| Float::with_val(p, x.cos_ref()));
beside!(atan, elementary::atan, |x, p| Float::with_val(
    p,
    x.atan_ref()
));
beside!(pow, |x, p| elementary::pow(x, &exponent(p), p), |x, p| {
    Float::with_val(p, x.pow(exponent(p).mid()))
});
