//! Tests of `run_up`.

use super::super::panel::tests::{attributes, curves as lines, dots, near, placed, texts};
use super::super::style::hex;
use super::*;

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

/// A dot for each point, errors falling to the right, on axes of whole powers of ten.
#[test]
fn work_stands_over_precision() {
    let work = |points: &[(f64, u64)]| Work {
        method: "DOP853",
        points: points.to_vec(),
    };
    let svg = work_precision("a", &[work(&[(1e-3, 10), (1e-15, 1000), (0.0, 0)])]);
    let [coarse, fine, exact] = dots(&svg)[..] else {
        panic!("{svg}");
    };
    assert!(coarse.0 < fine.0 && coarse.1 > fine.1, "{svg}");
    // No error at all stands at 1e-16, no work where one evaluation does.
    let decades = [(fine.0 - coarse.0) / 12.0, (coarse.1 - fine.1) / 2.0];
    assert!((exact.0 - fine.0 - decades[0]).abs() < 0.02, "{svg}");
    assert!((exact.1 - coarse.1 - decades[1]).abs() < 0.02, "{svg}");
    for power in 3..=16 {
        assert!(texts(&svg).contains(&&*format!("1e-{power}")), "{power}");
    }
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

#[test]
fn a_run_has_three_panels_over_one_time() {
    let svg = draw("a run", &run(1.0), None);
    assert!(svg.contains("viewBox=\"0 0 1000 1080\""));
    let texts = texts(&svg);
    let count = |text: &str| texts.iter().filter(|t| **t == text).count();
    for (text, n) in [
        ("a run", 1),
        ("time, s", 1),
        ("time, ms", 0),
        ("crank speed ω, rad/s", 1),
        ("torque at the crank, N·m", 1),
        ("energy, J", 1),
        ("motor", 1),
        ("weights M_o", 0),
        ("load", 0),
        ("kinetic", 0),
        ("work of the motor", 1),
        ("work of the weights", 0),
        ("work of the load", 1),
    ] {
        assert_eq!(count(text), n, "{text}: {texts:?}");
    }
    let lines = lines(&svg);
    assert_eq!(lines.len(), 4);
    let (left, right) = (102.0, 955.0);
    // The title takes 56 pixels, a panel 338.
    let (top, bottom) = (56.0 + 8.0, 56.0 + 338.0 - 8.0 - 28.0 - 1.0);
    assert!(near(lines[0][0], (left, bottom)), "{:?}", lines[0]);
    let high = bottom - (bottom - top) / 1.05;
    assert!(near(lines[0][2], (right, high)), "{:?}", lines[0]);
    // Energies of −1 to 2 with 0.15 of air.
    let (top, bottom) = (56.0 + 676.0 + 34.0, 1080.0 - 10.0 - 8.0 - 48.0 - 1.0);
    let at = |v: f64| bottom - (v + 1.15) / 3.3 * (bottom - top);
    assert!(
        near(lines[2][1], ((left + right) / 2.0, at(1.0))),
        "{:?}",
        lines[2]
    );
    assert!(
        near(lines[3][1], ((left + right) / 2.0, at(-1.0))),
        "{:?}",
        lines[3]
    );
    // A speed of zero is drawn all the same.
    let still = draw(
        "a",
        &[
            Sample::default(),
            Sample {
                t: 1.0,
                ..Sample::default()
            },
        ],
        None,
    );
    assert_eq!(super::super::panel::tests::curves(&still).len(), 1);
}

#[test]
fn a_short_start_stands_enlarged_beside_the_whole() {
    let svg = draw("a run", &run(1.0), Some(&run(0.025)));
    let all = texts(&svg);
    let note = "left: the start, 50 ms of 2 s, 40 times as wide; right: the whole run";
    for text in [
        note,
        "time, ms",
        "time, s",
        "crank speed ω, rad/s",
        "torque at the crank, N·m",
        "energy, J",
        "motor",
        "work of the motor",
        "work of the load",
    ] {
        assert_eq!(
            all.iter().filter(|t| **t == text).count(),
            1,
            "{text}: {all:?}"
        );
    }
    let lines = lines(&svg);
    // Speed, torque, two energies; each on the left and on the right at the same height.
    assert_eq!(lines.len(), 8);
    for (a, b) in [(0, 1), (2, 3), (4, 6), (5, 7)] {
        for (k, (p, q)) in lines[a].iter().zip(&lines[b]).enumerate() {
            let part = k as f64 / 2.0;
            let due = (102.0 + part * (359.0 - 102.0), q.1);
            assert!(near(*p, due), "{p:?}, {due:?}");
            assert!(
                (q.0 - (472.0 + part * (955.0 - 472.0))).abs() < 0.011,
                "{q:?}"
            );
        }
    }
    let below = placed(&svg)
        .into_iter()
        .filter(|(_, [x, y, _])| *x < 370.0 && *y > 1015.0);
    let ticks = below.filter_map(|(text, _)| text.parse::<f64>().ok());
    let last = ticks.fold(0.0, f64::max);
    assert!((30.0..=50.0).contains(&last), "{last} ms");
}

/// From 1e-3 to 1e-6 across and from 10 to 1000 evaluations up: whole powers of ten around what
/// there is.
#[test]
fn points_stand_between_whole_powers_of_ten() {
    let names = ["a", "b", "c", "d"];
    let points: [&[(f64, u64)]; 4] = [
        &[(2e-4, 20), (5e-6, 500)],
        &[(1e-5, 100)],
        &[(1e-4, 30)],
        &[(3e-5, 40)],
    ];
    let methods: Vec<Work> = names
        .into_iter()
        .zip(points)
        .map(|(method, points)| Work {
            method,
            points: points.to_vec(),
        })
        .collect();
    let svg = work_precision("a", &methods);
    let at = |(error, work): (f64, u64)| {
        (
            102.0 + (-error.log10() - 3.0) / 3.0 * (955.0 - 102.0),
            633.0 - ((work as f64).log10() - 1.0) / 2.0 * (633.0 - 110.0),
        )
    };
    let due: Vec<(f64, f64)> = points.concat().into_iter().map(at).collect();
    let seen = dots(&svg);
    assert_eq!(seen.len(), due.len());
    for (p, due) in seen.iter().zip(&due) {
        assert!(near(*p, *due), "{p:?}, {due:?}");
    }
    let lines = lines(&svg);
    assert!(near(lines[0][0], due[0]) && near(lines[0][1], due[1]));
    assert_eq!(lines.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1, 1, 1]);
    let colours = [BLUE, BLUE, ORANGE, GREEN, PURPLE].map(hex);
    assert_eq!(attributes(&svg, "circle", "fill"), colours);
    assert!(svg.contains("viewBox=\"0 0 1000 700\""));
    let seen = placed(&svg);
    assert_eq!(seen[0], ("a: work and precision", [24.0, 18.0, 19.0]));
    assert_eq!(seen[1].1, [24.0, 50.0, 12.0]);
    // The first name of the legend, in the corner of what the title leaves.
    assert!(
        seen.contains(&("a", [10.0 + 134.0, 76.0 + 10.0, 12.0])),
        "{seen:?}"
    );
    for (text, size) in [("evaluations of the right-hand side", 14.0), ("1000", 12.0)] {
        assert!(seen.iter().any(|t| t.0 == text && t.1[2] == size), "{text}");
    }
    for (text, n) in [
        ("worst error of the speed found, rad/s", 1),
        ("evaluations of the right-hand side", 1),
        ("10", 1),
        ("100", 1),
        ("1000", 1),
        // Decades, and nothing between them.
        ("1e-3", 1),
        ("1e-4", 1),
        ("1e-5", 1),
        ("1e-6", 1),
    ] {
        assert_eq!(seen.iter().filter(|t| t.0 == text).count(), n, "{text}");
    }
}

#[test]
fn what_has_one_value_has_a_decade() {
    let points = vec![(1e-3, 100)];
    let method = "a";
    let svg = work_precision("a", &[Work { method, points }]);
    assert!(near(dots(&svg)[0], (955.0, 633.0)), "{svg}");
    let seen = texts(&svg);
    for text in ["1e-3", "1e-2", "100", "1000"] {
        assert!(seen.contains(&text), "{text}: {seen:?}");
    }
}

#[test]
fn fourteen_decades_have_a_label_each_and_of_more_every_second() {
    let work = |points: &[(f64, u64)]| Work {
        method: "a",
        points: points.to_vec(),
    };
    let svg = work_precision("a", &[work(&[(1e-2, 10), (1e-16, 100)])]);
    let seen = texts(&svg);
    assert!(
        seen.contains(&"1e-4") && seen.contains(&"1e-14"),
        "{seen:?}"
    );
    assert!(
        !seen.contains(&"1e-3") && !seen.contains(&"1e-15"),
        "{seen:?}"
    );
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
