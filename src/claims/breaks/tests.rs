//! Tests of `breaks`.

use super::*;
use crate::solvers::faddeeva::faddeeva;
use mechaudit_atlas::{Parts, Plane, find};
use num_complex::Complex;

fn found(name: &str) -> Vec<Jump> {
    breaks(&Code::double(find(name).unwrap()), 1)
}

#[test]
fn segments_are_drawn_to_the_ends_of_their_ranges() {
    let all: Vec<Segment> = (0..40).flat_map(segments).collect();
    assert_eq!(all.len(), 40 * 48);
    let (level, upright): (Vec<&Segment>, Vec<&Segment>) = all.iter().partition(|s| s.level);
    assert!(level.iter().all(|s| s.ends == [0.01, 40.0]));
    assert!(upright.iter().all(|s| s.ends == [1e-12, 40.0]));
    let range = |of: &[&Segment]| {
        let others = || of.iter().map(|s| s.other);
        let least = others().fold(f64::INFINITY, f64::min);
        [least, others().fold(0.0, f64::max)]
    };
    let [least, most] = range(&level);
    assert!((1e-12..1.5e-12).contains(&least) && (25.0..30.0).contains(&most));
    let [least, most] = range(&upright);
    assert!((0.0..0.1).contains(&least) && (19.0..20.0).contains(&most));
}

#[test]
fn wide_segments_are_divided_by_ratios() {
    let middle = |ends| {
        let (level, other) = (true, 1.0);
        Segment { level, other, ends }.points()[PARTS / 2][0]
    };
    assert_eq!(middle([2.0, 6.0]), 4.0);
    assert_eq!(middle([2.0, 8.0]), 5.0);
    assert!((middle([2.0, 12.5]) - 5.0).abs() < 1e-12);
    assert!((middle([2.0, 18.0]) - 6.0).abs() < 1e-12);
}

/// A code that gives W times a function of z.
fn times<'a>(factor: impl Fn(f64, f64) -> f64 + 'a) -> Code<'a> {
    let name = ("planted".into(), String::new(), String::new());
    Code::other(name, Plane::Upper, Parts::Both, move |inputs| {
        let w = |z: &Vec<f64>| {
            let w = faddeeva(Complex::new(z[0], z[1])) * factor(z[0], z[1]);
            SolverAnswer::Values(vec![w.re, w.im])
        };
        inputs.iter().map(w).collect()
    })
}

/// Jumps of W times a function of Re z, on four segments.
fn planted(factor: fn(f64) -> f64) -> Vec<Jump> {
    let code = times(|x, _| factor(x));
    on(&code, (0..4).map(|k| Segment::drawn(1, k)).collect())
}

fn level(other: f64) -> Segment {
    let (level, ends) = (true, [0.01, 40.0]);
    Segment { level, other, ends }
}

#[test]
fn jumps_up_and_down_are_counted_on_level_segments() {
    for (factor, rising) in [
        (
            (|x| if x < 10.0 { 1.0 } else { 1.0 + 1e-6 }) as fn(f64) -> f64,
            2,
        ),
        (|x| if x < 10.0 { 1.0 } else { 1.0 - 1e-6 }, 0),
    ] {
        let jump = &planted(factor)[0];
        assert!((jump.re - 1e-6).abs() < 1e-9, "{jump:?}");
        assert_eq!((jump.crossings, jump.rising), (2, rising));
        assert_eq!(jump.at[0], 10f64.next_down());
    }
}

/// The rounding on either side counts.
#[test]
fn a_jump_into_noise_is_none() {
    let after = |x: f64| match x < 10.0 {
        true => 1.0,
        false => 1.0 + 2e-6 + 1e-6 * (x.to_bits() & 1) as f64,
    };
    let before = |x: f64| match x < 10.0 {
        true => 1.0 + 2e-6 + 1e-6 * (x.to_bits() & 1) as f64,
        false => 1.0,
    };
    assert_eq!((planted(after), planted(before)), (vec![], vec![]));
}

#[test]
fn a_known_seam_is_found_without_being_told() {
    // w4 changes its formula at |x| + y = 15 and 5.5 and at y = 0.195 |x| − 0.176.
    let jump = &found("humlicek-1982")[0];
    assert!(jump.re > 1e-5, "{jump:?}");
    let [x, y] = jump.at;
    let seams = [x + y - 15.0, x + y - 5.5, y - 0.195 * x + 0.176];
    assert!(seams.iter().any(|s| s.abs() < 1e-9), "{jump:?}");
}

#[test]
fn a_single_formula_has_none() {
    assert_eq!(found("weideman-1994-16"), []);
    assert_eq!(found("schreier-2018-16"), []);
    assert_eq!(found("schreier-2018-20"), []);
}

#[test]
fn parts_are_equal_from_end_to_end() {
    for (ends, due) in [
        ([2.0, 6.0], [2.0, 3.0, 4.0, 5.0, 6.0]),
        ([1.0, 16.0], [1.0, 2.0, 4.0, 8.0, 16.0]),
    ] {
        for level in [true, false] {
            let other = 7.0;
            let points = Segment { level, other, ends }.points();
            assert_eq!(points.len(), 65);
            for (k, due) in due.into_iter().enumerate() {
                let [x, y] = [&points[16 * k][0], &points[16 * k][1]];
                let (along, across) = if level { (x, y) } else { (y, x) };
                assert!(
                    (along - due).abs() < 1e-13 && *across == 7.0,
                    "{k}: {along} {across}"
                );
            }
        }
    }
}

#[test]
fn the_side_with_more_rounding_counts() {
    let spread = |size: f64| (0..BESIDE).map(move |k| Some(1.0 + size * (k as f64 / 15.0)));
    let both = |a: f64, b: f64| -> Vec<Option<f64>> { spread(a).chain(spread(b)).collect() };
    assert_eq!(rounding(&both(0.5, 0.25)), 0.5);
    assert_eq!(rounding(&both(0.25, 0.5)), 0.5);
    for place in [0, 31] {
        let mut one_missing = both(0.5, 0.25);
        one_missing[place] = None;
        assert_eq!(rounding(&one_missing), f64::INFINITY);
    }
}

/// w(1 + i) = 0.304744… + 0.208218…i.
#[test]
fn errors_are_relative_to_the_certified_value() {
    let re = 0.304_744_205_256_912_6;
    let size = f64::hypot(re, 0.208_218_938_202_831_62);
    let due = due([1.0, 1.0]).unwrap();
    assert!(
        (due[0] - re).abs() < 1e-15 && (due[1] - size).abs() < 1e-15,
        "{due:?}"
    );
    let off = error(&[1.0, 1.0], Some(1.5 * re)).unwrap();
    assert!((off - 0.5).abs() < 1e-14, "{off}");
    assert_eq!(error(&[1.0, 1.0], None), None);
}

/// Beside the axis Re w may be off by some units of a sum as large as |w|, far from it by next to
/// nothing.
#[test]
fn a_jump_is_above_what_sums_are_rounded_by() {
    for (y, below, above) in [(1e-3, 0.97, 1.05), (30.0, 0.7, 1.6)] {
        let [re, size] = due([10.0, y]).unwrap();
        let least = 1e-14 + 16.0 * f64::EPSILON * size / re;
        let found = |size: f64| {
            let code = times(move |x, _| if x < 10.0 { 1.0 } else { 1.0 + size });
            on(&code, vec![level(y)])
        };
        assert_eq!(found(below * least), [], "{y}");
        let jump = &found(above * least)[0];
        assert!((jump.re / (above * least) - 1.0).abs() < 0.1, "{jump:?}");
        assert_eq!(jump.re, rounded(jump.re));
    }
}

#[test]
fn the_largest_of_all_jumps_is_told() {
    let code = times(|x, y| if x < 10.0 { 1.0 } else { 1.0 + 1e-6 * y });
    let segments = [0.5, 2.0, 1.0].map(level).into();
    let jump = &on(&code, segments)[0];
    assert!(
        (jump.re - 2e-6).abs() < 1e-8 && jump.at == [10f64.next_down(), 2.0],
        "{jump:?}"
    );
    assert_eq!((jump.crossings, jump.rising), (3, 3));
}

/// Upright segments do not tell which way Re w goes along Re z.
#[test]
fn crossings_are_those_of_level_segments() {
    let code = times(|_, y| if y < 2.0 { 1.0 } else { 1.0 + 1e-6 });
    let upright = |other: f64| {
        let (level, ends) = (false, [1e-12, 40.0]);
        Segment { level, other, ends }
    };
    let jump = &on(&code, vec![upright(3.0), level(1.0), upright(4.0)])[0];
    assert_eq!((jump.crossings, jump.rising), (0, 0));
    assert_eq!(jump.at[1], 2f64.next_down());
}

#[test]
fn answers_that_are_no_numbers_hide_no_jump() {
    let factor = |x: f64| match x {
        _ if x < 5.0 => f64::NAN,
        _ if x < 10.0 => 1.0,
        _ if x < 20.0 => 1.0 + 1e-6,
        _ => f64::INFINITY,
    };
    let jump = &on(&times(|x, _| factor(x)), vec![level(1.0)])[0];
    assert!(
        (jump.re - 1e-6).abs() < 1e-8 && jump.at[0] == 10f64.next_down(),
        "{jump:?}"
    );
    let silent = |inputs: &[Vec<f64>]| {
        let answer = |_| SolverAnswer::Unanswered("nothing".into());
        inputs.iter().map(answer).collect()
    };
    let code = Code::other(Default::default(), Plane::Upper, Parts::Both, silent);
    assert_eq!(on(&code, vec![level(1.0)]), []);
}
