//! Tests of `motion`.

use super::*;
use crate::motion::{Drive, Wheel};
use crate::report::gallery::Gallery;
use serde_json::Value;

#[test]
fn a_few_values_at_the_ends_do_not_dwarf_the_others() {
    let shown = |bulk: f64, ends: [f64; 2]| {
        let inner = (0..=80).map(|k| 10.0 + bulk * f64::from(k) / 80.0);
        let values = inner.chain(ends).collect();
        range(&Course {
            name: "I".into(),
            unit: String::new(),
            variants: vec![(String::new(), values)],
            printed: Vec::new(),
        })
    };
    // The bulk, without two values at each end, and as much again on either side.
    assert_eq!(shown(80.0, [-1e3, 1e3]), [11.0 - 78.0, 89.0 + 78.0]);
    // Ends that are near stay, and so do those of what is otherwise constant.
    assert_eq!(shown(80.0, [-100.0, 50.0]), [-100.0, 90.0]);
    assert_eq!(shown(0.0, [-1e3, 1e3]), [-1e3, 1e3]);
}

fn course(name: &str, unit: &str, values: &[f64]) -> Course {
    Course {
        name: name.into(),
        unit: unit.into(),
        variants: vec![(String::new(), values.to_vec())],
        printed: Vec::new(),
    }
}

#[test]
fn a_chart_shows_what_there_is() {
    let of = |values: &[f64], printed: &[f64]| {
        range(&Course {
            printed: printed.iter().map(|y| (0.0, *y)).collect(),
            ..course("a", "", values)
        })
    };
    assert_eq!(of(&[], &[]), [0.0, 1.0]);
    assert_eq!(of(&[f64::NAN, f64::INFINITY], &[]), [0.0, 1.0]);
    assert_eq!(of(&[2.0, f64::NAN, 1.0], &[5.0]), [1.0, 5.0]);
    // A constant lies in the middle of its own size, or of one.
    for (x, due) in [
        (3.0, [1.5, 4.5]),
        (-4.0, [-6.0, -2.0]),
        (0.25, [-0.25, 0.75]),
        (0.0, [-0.5, 0.5]),
    ] {
        assert_eq!(of(&[x, x], &[]), due);
    }
    // So does what is constant to nine digits.
    let (same, other) = (1.0 + 0.7e-9, 1.0 + 1.5e-9);
    assert_eq!(of(&[1.0, same], &[]), [0.5, same + 0.5 * same]);
    assert_eq!(of(&[1.0, other], &[]), [1.0, other]);
    assert_eq!(of(&[-1e-12, 0.0], &[]), [-1e-12, 0.0]);
}

/// All is shown up to five times the bulk.
#[test]
fn what_is_far_off_is_cut_at_five_times_the_bulk() {
    let shown = |low: f64| {
        let inner = (0..=80).map(|k| 10.0 + f64::from(k));
        let all: Vec<f64> = inner.chain([low, 91.0]).collect();
        range(&course("a", "", &all))
    };
    // From 11 to 89 without two values at each end.
    assert_eq!(shown(91.0 - 391.0), [11.0 - 78.0, 91.0]);
    assert_eq!(shown(91.0 - 389.0), [91.0 - 389.0, 91.0]);
}

/// A fortieth of the values at each end.
#[test]
fn the_bulk_is_nineteen_twentieths() {
    let shown = |n: u32| {
        let inner = (0..n - 2).map(|k| 10.0 + f64::from(k));
        let all: Vec<f64> = inner.chain([-1e3, 1e3]).collect();
        range(&course("a", "", &all))
    };
    // From 11 to 86, and from 10 to 86.
    assert_eq!(shown(80), [11.0 - 75.0, 86.0 + 75.0]);
    assert_eq!(shown(79), [10.0 - 76.0, 86.0 + 76.0]);
}

#[test]
fn an_angle_that_jumps_by_a_turn_breaks_its_line() {
    let values = [0.0, 190.0, 10.0, 195.0, f64::NAN, 1.234_567_89];
    let angle = course("a", "°", &values);
    let row = super::row(&angle, true);
    assert_eq!(row.breaks, [1, 3]);
    let six = [
        Some(0.0),
        Some(190.0),
        Some(10.0),
        Some(195.0),
        None,
        Some(1.234_57),
    ];
    assert_eq!(row.variants, [six]);
    assert!(
        super::row(&course("a", "m", &values), true)
            .breaks
            .is_empty()
    );
    // The line that is drawn first.
    let mut two = angle.clone();
    two.variants.push((String::new(), vec![0.0; 6]));
    assert_eq!(super::row(&two, true).breaks, [1, 3]);
}

/// A metre is 100 pixels, from (160, 160).
fn moving() -> Motion {
    let quarter = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    let spot = Point {
        pivot: false,
        ..Point::fixed("S", [4.2, 0.5])
    };
    Motion {
        name: "a <crank>".into(),
        drive: Drive {
            symbol: "φ1",
            unit: "°",
            values: vec![0.0, 90.0, 180.0, 270.0],
        },
        closed: true,
        start: 1,
        points: vec![
            Point::fixed("O", [0.0, 0.0]),
            Point::moving("A", quarter.to_vec()),
            spot,
            Point::moving("", quarter.map(|[x, y]| [x, 0.5 * y]).to_vec()),
            Point::fixed("", [2.0, 0.0]),
        ],
        links: vec![[0, 1]],
        plates: vec![vec![1, 3, 4]],
        guides: Vec::new(),
        wheels: Vec::new(),
        courses: Vec::new(),
    }
}

fn read(motion: &Motion) -> Value {
    serde_json::from_str(&data(motion)).unwrap()
}

/// Three courses are all drawn; of more the reduced quantities, or the first three that are not the
/// drive's.
#[test]
fn some_courses_are_drawn_from_the_start() {
    let drawn = |courses: Vec<Course>| {
        let mut motion = moving();
        motion.courses = courses;
        let data = read(&motion);
        let all = data["courses"].as_array().unwrap();
        let pressed = section(&motion, &html! {}).into_string();
        if all.len() > 3 {
            let seen = all.iter().filter(|c| c["drawn"] == true).count();
            assert_eq!(pressed.matches("aria-pressed=\"true\"").count(), seen);
        } else {
            assert!(!pressed.contains("data-course"), "{pressed}");
        }
        assert_eq!(pressed.matches("<dt>").count(), all.len());
        let drawn = all.iter().map(|c| c["drawn"].as_bool().unwrap());
        drawn.map(|d| if d { 'x' } else { '-' }).collect::<String>()
    };
    let other = || course("y", "m", &[0.0, 1.0, 2.0, 3.0]);
    let others = |n: usize| vec![other(); n];
    assert_eq!(drawn(others(3)), "xxx");
    assert_eq!(drawn(others(5)), "xxx--");
    let with = |first: Course| drawn([vec![first], others(6)].concat());
    let angle = |values: [f64; 4]| course("x", "°", &values);
    assert_eq!(with(angle([0.0, 90.0, 180.0, 270.0])), "---xxx-");
    // But for whole turns.
    assert_eq!(with(angle([360.0, 90.0, -180.0, -90.0])), "---xxx-");
    assert_eq!(with(angle([0.0, 90.0, 180.0, 271.0])), "xxx----");
    assert_eq!(with(angle([0.0, 90.0, 180.0, 270.0 + 1e-6])), "xxx----");
    assert_eq!(
        with(course("x", "m", &[0.0, 90.0, 180.0, 270.0])),
        "xxx----"
    );
    // To a thousand millionth of a turn.
    let off = |turns: f64| with(angle([0.0, 90.0, 180.0, 360.0 * turns + 270.0]));
    assert_eq!((&*off(0.7e-9), &*off(1.5e-9)), ("---xxx-", "xxx----"));
    // The second course may be the drive's, but only the first is left out.
    let second = vec![other(), angle([0.0, 90.0, 180.0, 270.0]), other(), other()];
    assert_eq!(drawn(second), "xxx-");
    for name in ["I_n", "dI_n_dphi", "M_o", "m_n", "dm_n_ds", "F_o"] {
        let reduced = course(name, "", &[1.0; 4]);
        let mut all = others(5);
        all.insert(4, reduced);
        assert_eq!(drawn(all), "----x-", "{name}");
    }
}

/// Parts at the position shown first; a high mechanism in the middle, to hundredths of a pixel; the
/// sixth joint in the colour of the first.
#[test]
fn drawings_and_sections() {
    let mut all = Gallery::default();
    let mut motion = moving();
    motion.drive.values[1] = 90.123_456_789_4;
    motion.guides = vec![[0, 4]];
    motion.wheels = vec![Wheel {
        centre: 0,
        radius: 0.125,
    }];
    all.add("data", data(&motion));
    all.add("drawing", drawing(&motion).into_string());
    all.add(
        "section",
        section(&motion, &html! { "all about it" }).into_string(),
    );
    let joint = motion.points[1].clone();
    motion.points.extend(vec![joint; 5]);
    (motion.closed, motion.guides) = (false, Vec::new());
    motion.courses = vec![course("y", "m", &[0.0; 4]); 4];
    all.add("six joints", section(&motion, &html! {}).into_string());
    for points in [
        &[[0.0, 0.0], [1.0, 5.2], [1.0 / 3.0, 0.0]][..],
        &[[0.0, 0.0], [0.52, 0.0]],
        &[[3.0, -7.0]],
    ] {
        let fixed = points.iter().map(|p| Point::fixed("", *p));
        motion.points = fixed.collect();
        all.add(format!("{points:?}"), read(&motion)["points"].to_string());
    }
    all.pin("motions");
}
