//! Tests of `chirp`.

use super::*;
use crate::report::gallery::Gallery;

/// The ends of each column within its envelope.
#[test]
fn histories() {
    let column = |t: f64, ranges, envelope, speed| Column {
        times: [t, t + 0.5],
        ranges,
        envelope,
        speed,
    };
    let columns = vec![
        column(0.0, [[-1.0, 1.0], [-2.0, 2.25], [-30.0, 40.0]], 3.0, 5.0),
        column(1.0, [[-1.5, 1.25], [0.25, 0.5], [10.0, 20.0]], 2.0, 10.0),
    ];
    let mut all = Gallery::default();
    let drawing = history(&History {
        name: "cam",
        note: "as told".into(),
        unit: "mm",
        mean: 0.5,
        columns,
    });
    all.add("history", drawing);
    all.pin("histories");
}

/// Each law has a row with formula and peak over its own abscissa.
#[test]
fn charts() {
    let point = |k: f64| ChartPoint {
        xi_rise: 3.0 * k,
        xi_turn: 7.0 * k,
        t: 0.0,
        speed: 0.0,
        bound: 2.0 * k,
        displacement: k,
        acceleration_bound: 6.0 * k,
        acceleration: 5.0 * k,
        dynamic_coefficients: [0.0; 3],
        dwell_amplitude: 0.0,
        dwell_phase: 0.0,
    };
    let mut all = Gallery::default();
    for period in [Period::Turn, Period::Rise] {
        let chart = |points| Chart {
            period,
            rigid: [3.0, 100.0, 200.0],
            points,
        };
        let (full, none) = (chart(vec![point(1.0), point(4.0)]), chart(Vec::new()));
        let laws = [("cycloidal", &full), ("3-4-5", &none)];
        all.add(format!("{period:?}"), super::chart("cam", "as told", &laws));
    }
    all.pin("charts");
}

/// Orders from 0.9 to a tenth beyond the last, which is ten at least; amplitudes between whole
/// powers of ten. Harmonics that vanish are left out.
#[test]
fn spectra() {
    type Points = &'static [(f64, f64)];
    let mut all = Gallery::default();
    let several: [(Points, Points); 6] = [
        (
            // A harmonic on the lowest line has no height.
            &[(1.0, 0.5), (4.0, 0.02), (5.0, 1e-4), (10.0, 5e-4)],
            &[
                (1.0, 2.0),
                (2.0, 1e-3),
                (2.5, 1e-4),
                (3.0, 5e-5),
                (4.0, f64::INFINITY),
            ],
        ),
        (&[(1.0, 0.5), (20.0, 2e-3)], &[]),
        // One that is a thousand millionth of the largest, and one that is less.
        (&[(1.0, 0.5), (2.0, 6e-10)], &[]),
        (&[(1.0, 0.5), (2.0, 4e-10)], &[]),
        (&[(1.0, 0.5), (2.0, 0.0), (10.0, 5e-4)], &[]),
        (&[(1.0, 0.0)], &[]),
    ];
    for (harmonics, beyond) in several {
        let drawing = spectrum(&Spectrum {
            name: "a",
            law: "b",
            harmonics: harmonics.to_vec(),
            beyond: beyond.to_vec(),
        });
        all.add(format!("{harmonics:?}, {beyond:?}"), drawing);
    }
    all.pin("spectra");
}
