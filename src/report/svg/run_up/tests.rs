//! Tests of `run_up`.

use super::*;
use crate::report::gallery::Gallery;

#[test]
fn few_samples_are_all_drawn_and_of_many_the_extremes() {
    let sample = |k: usize| Sample {
        t: (k / 4) as f64 + 0.1 + 1e-3 * (k % 4) as f64,
        psi: (k % 4) as f64,
        ..Sample::default()
    };
    let seen = |n: usize| {
        let samples: Vec<Sample> = (0..n).map(sample).collect();
        thinned(&samples, |s| s.psi, BINS as f64)
    };
    assert_eq!(seen(2 * BINS).len(), 2 * BINS);
    let many = seen(2 * BINS + 4);
    assert_eq!(many.len(), BINS + 2);
    assert!(many.chunks(2).all(|p| [p[0].1, p[1].1] == [0.0, 3.0]));
}

/// Whichever of the two comes first, on a scale of time that does not matter.
#[test]
fn extremes_stand_in_order_of_time() {
    let sample = |k: usize| Sample {
        t: 0.01 * ((k / 4) as f64 + 0.1 + 1e-3 * (k % 4) as f64),
        psi: 3.0 - (k % 4) as f64,
        ..Sample::default()
    };
    let samples: Vec<Sample> = (0..2 * BINS + 4).map(sample).collect();
    let line = thinned(&samples, |s| s.psi, 0.01 * BINS as f64);
    assert_eq!(line.len(), BINS + 2);
    assert!(line.is_sorted_by(|a, b| a.0 < b.0));
    assert!(line.chunks(2).all(|p| [p[0].1, p[1].1] == [3.0, 0.0]));
}

/// A motor that gives the speed and works; what is zero throughout is left out.
fn run(scale: f64) -> Vec<Sample> {
    let sample = |k: u32| {
        let t = f64::from(k);
        Sample {
            t: scale * t,
            psi: 10.0 * t,
            motor: 5.0 - t,
            kinetic_energy: 0.0,
            work: [t, 0.0, if k == 1 { -1.0 } else { 0.0 }],
            ..Sample::default()
        }
    };
    (0..3).map(sample).collect()
}

/// A run, one with its short start enlarged, and one that stands still.
#[test]
fn runs() {
    let mut all = Gallery::default();
    all.add("run", draw("a run", &run(1.0), None));
    all.add("start", draw("a run", &run(1.0), Some(&run(0.025))));
    let still = [0.0, 1.0].map(|t| Sample {
        t,
        ..Sample::default()
    });
    all.add("still", draw("a", &still, None));
    all.pin("runs");
}

/// Between whole powers of ten, errors falling to the right; no error at all stands at 1e-16, no
/// work where one evaluation does.
#[test]
fn work_over_precision() {
    let mut all = Gallery::default();
    type Points = &'static [(f64, u64)];
    let several: [Points; 4] = [
        &[(2e-4, 20), (5e-6, 500)],
        &[(1e-5, 100)],
        &[(1e-4, 30)],
        &[(3e-5, 40)],
    ];
    let wide: Points = &[(1e-2, 10), (1e-16, 100)];
    let exact: Points = &[(1e-3, 10), (1e-15, 1000), (0.0, 0)];
    for of in [&several[..], &[&[(1e-3, 100)]], &[wide], &[exact]] {
        let names = ["a", "b", "c", "d"].into_iter().zip(of);
        let work = names.map(|(method, points)| Work {
            method,
            points: points.to_vec(),
        });
        let svg = work_precision("a", &work.collect::<Vec<_>>());
        all.add(format!("{of:?}"), svg);
    }
    all.pin("work-precision");
}

/// However long the run is.
#[test]
fn a_run_has_two_points_in_each_of_seven_hundred_columns() {
    for end in [0.7, 7.0] {
        let sample = |k: u32| Sample {
            t: end * f64::from(k) / 7000.0,
            psi: f64::from(k % 2),
            ..Sample::default()
        };
        let samples: Vec<Sample> = (0..=7000).map(sample).collect();
        let seen = curves(&[PANELS[0].1[0]], &samples, 1.0);
        let n = seen[0].points.len();
        // The last sample may have a column of its own.
        assert!((1400..=1402).contains(&n), "{n}");
    }
}
