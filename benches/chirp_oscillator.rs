//! The chirp-forced oscillator: one harmonic at one time beside one W(z), and batches.
//!
//! `cargo bench --bench chirp_oscillator`. Items are values of one harmonic at one time.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use mechaudit::solvers::chirp_oscillator::{
    Chirp, ChirpResponse, Excitation, Forcing, Harmonic, InitialState, Motion, Oscillator,
};
use mechaudit::solvers::faddeeva::faddeeva;
use num_complex::Complex;

fn main() {
    divan::main();
}

/// The first `count` harmonics, from rest.
fn response(w: f64, n: f64, omega0: f64, eps: f64, count: u32) -> ChirpResponse {
    let harmonic = |k: u32| Harmonic {
        k: f64::from(k),
        amplitude: 1.0 / f64::from(k * k),
        phase: 0.3 * f64::from(k),
    };
    let excitation = Excitation {
        chirp: Chirp { omega0, eps },
        forcing: Forcing::Displacement,
        static_term: 0.0,
        harmonics: (1..=count).map(harmonic).collect(),
    };
    let oscillator = Oscillator::new(w, n).expect("an oscillator");
    ChirpResponse::new(oscillator, excitation, InitialState::default()).expect("finite")
}

/// A hundred turns from rest through the resonances of the harmonics 3 to 20.
fn sweep(count: u32) -> (ChirpResponse, Vec<f64>) {
    let end = (400.0 * std::f64::consts::PI / 4.0).sqrt();
    let times = (0..10_000).map(|i| end * f64::from(i) / 9999.0).collect();
    (response(200.0, 4.0, 0.0, 4.0, count), times)
}

/// Single values: 1000 times far from zero.
mod single {
    use super::*;

    fn times() -> Vec<f64> {
        (0..1000).map(|i| 5.0 + 0.01 * f64::from(i)).collect()
    }

    #[divan::bench]
    fn a_w(bencher: Bencher) {
        let z: Vec<_> = times()
            .iter()
            .map(|t| Complex::new(0.3 * t, 0.2 * t))
            .collect();
        bencher
            .counter(ItemsCount::new(z.len()))
            .bench_local(|| z.iter().map(|z| faddeeva(black_box(*z)).re).sum::<f64>());
    }

    /// The arguments that this oscillator meets: beside the diagonal, |z| from 0.01 to 10⁴ in no
    /// order, so that the branches are not foreseen.
    #[divan::bench]
    fn a_w_beside_the_diagonal(bencher: Bencher) {
        let golden = |i: u32, by: f64| (f64::from(i) * by).fract();
        let z: Vec<_> = (0..1000)
            .map(|i| {
                let s = 0.01 * 1e6f64.powf(golden(i, 0.618_033_988_749_894_9));
                let damping = 0.1 * golden(i, 0.414_213_562_373_095_1);
                Complex::new(s * (1.0 + damping), s * (damping - 1.0)) * 0.5f64.sqrt()
            })
            .collect();
        bencher
            .counter(ItemsCount::new(z.len()))
            .bench_local(|| z.iter().map(|z| faddeeva(black_box(*z)).re).sum::<f64>());
    }

    #[divan::bench]
    fn b_displacement(bencher: Bencher) {
        let (r, t) = (response(100.0, 2.0, 1.0, 2.0, 1), times());
        bencher.counter(ItemsCount::new(t.len())).bench_local(|| {
            t.iter()
                .map(|t| r.displacement(black_box(*t)).unwrap())
                .sum::<f64>()
        });
    }

    #[divan::bench]
    fn c_motion(bencher: Bencher) {
        let (r, t) = (response(100.0, 2.0, 1.0, 2.0, 1), times());
        bencher.counter(ItemsCount::new(t.len())).bench_local(|| {
            t.iter()
                .map(|t| r.motion(black_box(*t)).unwrap().acceleration)
                .sum::<f64>()
        });
    }

    #[divan::bench]
    fn d_from_scratch(bencher: Bencher) {
        let t = times();
        bencher.counter(ItemsCount::new(t.len())).bench_local(|| {
            let once = |t: &f64| response(100.0, 2.0, 1.0, 2.0, 1).displacement(*t).unwrap();
            t.iter().map(|t| once(black_box(t))).sum::<f64>()
        });
    }
}

/// 10 000 times, one core.
mod batch {
    use super::*;

    fn displacements(bencher: Bencher, r: &ChirpResponse, t: &[f64], harmonics: usize) {
        let mut out = vec![0.0; t.len()];
        bencher
            .counter(ItemsCount::new(t.len() * harmonics))
            .bench_local(|| r.displacements(black_box(t), &mut out).unwrap());
    }

    #[divan::bench(args = [1, 20])]
    fn a_off_resonance(bencher: Bencher, harmonics: u32) {
        let t: Vec<f64> = (0..10_000).map(|i| 1.0 + 0.01 * f64::from(i)).collect();
        let r = response(500.0, 5.0, 3.0, 0.05, harmonics);
        displacements(bencher, &r, &t, harmonics as usize);
    }

    #[divan::bench(args = [1, 20])]
    fn b_sweep(bencher: Bencher, harmonics: u32) {
        let (r, t) = sweep(harmonics);
        displacements(bencher, &r, &t, harmonics as usize);
    }

    #[divan::bench(args = [1, 20])]
    fn c_sweep_motions(bencher: Bencher, harmonics: u32) {
        let (r, t) = sweep(harmonics);
        let mut out = vec![Motion::default(); t.len()];
        bencher
            .counter(ItemsCount::new(t.len() * harmonics as usize))
            .bench_local(|| r.motions(black_box(&t), &mut out).unwrap());
    }

    #[cfg(feature = "parallel")]
    #[divan::bench(args = [1, 20])]
    fn d_sweep_all_cores(bencher: Bencher, harmonics: u32) {
        let (r, t) = sweep(harmonics);
        let mut out = vec![0.0; t.len()];
        bencher
            .counter(ItemsCount::new(t.len() * harmonics as usize))
            .bench_local(|| r.displacements_parallel(black_box(&t), &mut out).unwrap());
    }
}
