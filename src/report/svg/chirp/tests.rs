//! Tests of `chirp`.

use super::super::panel::tests::{attributes, curves, dots, near, placed, texts};
use super::*;

/// Each law has a row of its own, as high as any, below the title.
#[test]
fn a_chart_has_a_row_for_each_law() {
    let laws = ["cycloidal", "modified-sine", "3-4-5"];
    for (period, axis) in [
        (Period::Turn, "ξ, the turn as period"),
        (Period::Rise, "ξ, the rise as period"),
    ] {
        let chart = Chart {
            period,
            rigid: [5.0; 3],
            points: Vec::new(),
        };
        for n in 1..=laws.len() {
            let all: Vec<(&str, &Chart)> = laws[..n].iter().map(|l| (*l, &chart)).collect();
            let svg = super::chart("cam", "", &all);
            let size = format!("viewBox=\"0 0 1240 {}\"", 100 + 360 * n);
            assert!(svg.contains(&size), "{size} is missing in {svg}");
            let texts = texts(&svg);
            assert_eq!(texts.iter().filter(|t| **t == axis).count(), 2 * n);
            for law in &laws[..n] {
                assert!(texts.contains(&&*format!("{law}: displacement, lifts")));
            }
        }
    }
}

#[test]
fn harmonics_that_vanish_are_left_out() {
    let of = |harmonics: &[(f64, f64)]| {
        spectrum(&Spectrum {
            name: "a",
            law: "b",
            harmonics: harmonics.to_vec(),
            beyond: Vec::new(),
        })
    };
    let [first, tenth] = dots(&of(&[(1.0, 0.5), (2.0, 0.0), (10.0, 5e-4)]))[..] else {
        panic!("two harmonics are there");
    };
    assert!(first.0 < tenth.0 && first.1 < tenth.1);
    let none = of(&[(1.0, 0.0)]);
    assert!(dots(&none).is_empty() && !none.contains("NaN"), "{none}");
}

/// The lines that the program draws, each with its width and whether it is dashed.
fn strokes(svg: &str) -> Vec<(&str, bool)> {
    let own = svg.lines().filter(|l| l.contains("stroke-linejoin"));
    own.map(|l| {
        let width = attributes(l, "polyline", "stroke-width")[0];
        (width, l.contains("dasharray"))
    })
    .collect()
}

#[test]
fn a_history_has_the_ends_of_each_column_within_its_envelope() {
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
    let svg = history(&History {
        name: "cam",
        note: "as told".into(),
        unit: "mm",
        mean: 0.5,
        columns,
    });
    let lines = curves(&svg);
    let values: [&[(f64, f64)]; 6] = [
        &[(0.0, -2.0), (0.5, 2.25), (1.0, 0.25), (1.5, 0.5)],
        &[(0.0, -1.0), (0.5, 1.0), (1.0, -1.5), (1.5, 1.25)],
        &[(0.0, 3.5), (1.0, 2.5)],
        &[(0.0, -2.5), (1.0, -1.5)],
        &[(0.0, -30.0), (0.5, 40.0), (1.0, 10.0), (1.5, 20.0)],
        &[(0.0, 5.0), (1.0, 10.0)],
    ];
    assert_eq!(lines.len(), values.len());
    // Curves of one panel share a scale: a twentieth of air on both sides of what is highest and
    // lowest.
    let spans: [(f64, f64, f64); 6] = [
        (1.5, -2.8, 3.8),
        (1.5, -2.8, 3.8),
        (1.5, -2.8, 3.8),
        (1.5, -2.8, 3.8),
        (1.5, -33.5, 43.5),
        (1.0, 4.75, 10.25),
    ];
    let heights = |k: usize| {
        let panel = [0, 0, 0, 0, 1, 2][k];
        // Of 994 pixels below title and note.
        let edge = |n: f64| 76.0 + n * 994.0 / 3.0;
        (
            edge(f64::from(panel)) + 34.0,
            edge(f64::from(panel) + 1.0) - 8.0 - 48.0 - 1.0,
        )
    };
    for (k, (line, values)) in lines.iter().zip(values).enumerate() {
        let (last, low, high) = spans[k];
        let (top, bottom) = heights(k);
        assert_eq!(line.len(), values.len(), "{k}");
        for (p, (t, v)) in line.iter().zip(values) {
            let due = (
                102.0 + t / last * (955.0 - 102.0),
                bottom - (v - low) / (high - low) * (bottom - top),
            );
            // Panels begin at whole pixels.
            assert!(
                (p.0 - due.0).abs() < 0.011 && (p.1 - due.1).abs() < 1.0,
                "{k}: {p:?}, {due:?}"
            );
        }
    }
    assert!(svg.contains("viewBox=\"0 0 1000 1080\""));
    let thin = ("1", false);
    let envelope = ("2", true);
    assert_eq!(
        strokes(&svg),
        [thin, thin, envelope, envelope, thin, ("2", false)]
    );
    let texts = texts(&svg);
    for (text, n) in [
        ("cam", 1),
        ("as told", 1),
        ("time, s", 3),
        ("displacement, mm", 1),
        ("acceleration, mm/s²", 1),
        ("speed, rad/s", 1),
        ("cam f", 1),
        ("y", 1),
        ("envelope", 1),
        ("y″", 1),
        ("shaft", 1),
    ] {
        assert_eq!(texts.iter().filter(|t| **t == text).count(), n, "{text}");
    }
}

#[test]
fn a_chart_has_formula_and_peak_over_its_own_abscissa() {
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
    for (period, first, last) in [(Period::Turn, 7.0, 28.0), (Period::Rise, 3.0, 12.0)] {
        let points = vec![point(1.0), point(4.0)];
        let rigid = [3.0, 100.0, 200.0];
        let chart = Chart {
            period,
            rigid,
            points,
        };
        let svg = super::chart("cam", "as told", &[("cycloidal", &chart)]);
        let lines = curves(&svg);
        assert_eq!(lines.len(), 5);
        // Of 0 to 8.35 lifts, and of 0 to 25.05.
        let heights = |line: &[(f64, f64)], most: f64| -> Vec<f64> {
            let bottom = 460.0 - 10.0 - 8.0 - 48.0 - 1.0;
            let part = |y: f64| (bottom - y) / (bottom - 76.0 - 34.0) * most;
            line.iter().map(|p| part(p.1)).collect()
        };
        for (line, most, due) in [
            (&lines[0], 8.35, [1.0, 4.0]),
            (&lines[1], 8.35, [2.0, 8.0]),
            (&lines[2], 25.05, [5.0, 20.0]),
            (&lines[3], 25.05, [6.0, 24.0]),
            (&lines[4], 25.05, [3.0, 3.0]),
        ] {
            for (seen, due) in heights(line, most).iter().zip(due) {
                assert!((seen - due).abs() < 0.05, "{seen}, {due}");
            }
        }
        // Side by side, each with half of 1206 pixels.
        let ends = |line: &[(f64, f64)]| (line[0].0, line[1].0);
        assert_eq!(
            (ends(&lines[0]), ends(&lines[2])),
            ((102.0, 592.0), (705.0, 1195.0))
        );
        let texts = placed(&svg);
        let across = texts.iter().filter(|t| t.1[1] > 395.0 && t.1[0] < 600.0);
        let ticks: Vec<f64> = across.filter_map(|t| t.0.parse().ok()).collect();
        assert!(
            ticks.iter().all(|t| (first..=last).contains(t)),
            "{ticks:?}"
        );
        assert!(ticks.len() >= 3, "{ticks:?}");
        assert_eq!(strokes(&svg).iter().filter(|s| s.1).count(), 2);
    }
}

/// Orders from 0.9 to a tenth beyond the last, which is ten at least; amplitudes between whole
/// powers of ten.
#[test]
fn harmonics_stand_on_logarithmic_axes() {
    type Points<'a> = &'a [(f64, f64)];
    let all: [(Points, Points, f64, (f64, f64)); 5] = [
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
            11.0,
            (-4.0, 1.0),
        ),
        (&[(1.0, 0.5), (20.0, 2e-3)], &[], 22.0, (-3.0, 0.0)),
        (
            &[(1.0, 0.5), (2.0, 0.06)],
            &[(2.0, 0.02)],
            11.0,
            (-2.0, 0.0),
        ),
        // One that is a thousand millionth of the largest, and one that is less.
        (&[(1.0, 0.5), (2.0, 6e-10)], &[], 11.0, (-10.0, 0.0)),
        (&[(1.0, 0.5), (2.0, 4e-10)], &[], 11.0, (-1.0, 0.0)),
    ];
    for (harmonics, beyond, last, (low, high)) in all {
        let svg = spectrum(&Spectrum {
            name: "a",
            law: "b",
            harmonics: harmonics.to_vec(),
            beyond: beyond.to_vec(),
        });
        let left = 0.9f64.log10();
        let at = |(n, d): (f64, f64)| {
            (
                102.0 + (n.log10() - left) / (last.log10() - left) * (955.0 - 102.0),
                573.0 - (d.log10() - low) / (high - low) * (573.0 - 110.0),
            )
        };
        let seen: Vec<(f64, f64)> = harmonics
            .iter()
            .copied()
            .filter(|h| h.1.log10() > low)
            .collect();
        let dots = dots(&svg);
        assert_eq!(dots.len(), seen.len(), "{harmonics:?}");
        let lines = curves(&svg);
        for (k, h) in seen.iter().enumerate() {
            assert!(near(dots[k], at(*h)), "{h:?}: {:?}, {:?}", dots[k], at(*h));
            assert!(near(lines[k][1], dots[k]) && near(lines[k][0], (dots[k].0, 573.0)));
        }
        let rest: Vec<(f64, f64)> = beyond
            .iter()
            .copied()
            .filter(|b| b.1.is_finite() && b.1.log10() >= low)
            .collect();
        let line = &lines[seen.len()];
        assert_eq!(line.len(), rest.len(), "{beyond:?}");
        for (p, b) in line.iter().zip(rest) {
            assert!(near(*p, at(b)), "{b:?}: {p:?}");
        }
        let (bound, stems) = strokes(&svg)
            .split_last()
            .map(|(b, s)| (*b, s.to_vec()))
            .unwrap();
        assert!(stems.iter().all(|s| *s == ("1", false)) && bound == ("2", true));
    }
    let svg = spectrum(&Spectrum {
        name: "a",
        law: "b",
        harmonics: all[0].0.to_vec(),
        beyond: Vec::new(),
    });
    assert!(svg.contains("viewBox=\"0 0 1000 640\""));
    let seen = placed(&svg);
    assert_eq!(seen[0], ("a", [24.0, 18.0, 19.0]));
    let note = "law b, amplitudes D_n of the displacement in lifts";
    assert_eq!(seen[1], (note, [24.0, 50.0, 12.0]));
    for text in ["harmonic n", "D_n, lifts", "1e-3", "1e-1", "1", "10"] {
        assert!(seen.iter().any(|t| t.0 == text), "{text}: {seen:?}");
    }
    assert!(seen.contains(&("D_n", [144.0, 86.0, 12.0])), "{seen:?}");
    for (text, size) in [("harmonic n", 14.0), ("D_n, lifts", 14.0), ("10", 12.0)] {
        assert!(seen.iter().any(|t| t.0 == text && t.1[2] == size), "{text}");
    }
}
