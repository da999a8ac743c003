//! Tests of `survey`.

use super::*;
use crate::solvers::faddeeva::faddeeva;
use mechaudit_atlas::{Algorithm, PROFILES};
use num_complex::{Complex32, Complex64};
use std::cell::RefCell;

const EFFORT: Effort = Effort { cases: 4, seed: 1 };

/// W off by a thousandth.
fn off(z: Complex64) -> Complex64 {
    faddeeva(z) * 1.001
}

/// The negative of W to the left, no number to the right.
fn turned(z: Complex64) -> Complex64 {
    match z.re > 0.0 {
        true => Complex64::new(f64::NAN, 0.0),
        false => -faddeeva(z),
    }
}

fn in_single_precision(z: Complex32) -> Complex32 {
    let w = faddeeva(Complex64::new(z.re.into(), z.im.into()));
    Complex32::new(w.re as f32, w.im as f32)
}

/// An algorithm of one formula.
fn algorithm(name: &'static str, w: fn(Complex64) -> Complex64) -> Algorithm {
    Algorithm {
        name,
        w,
        plane: Plane::Upper,
        parts: Parts::Both,
        single: Some(in_single_precision),
        formula: Some(|_| 1),
        ..mechaudit_atlas::find("humlicek-1982").unwrap()
    }
}

/// One of each kind, in an order of no kind.
fn rows(told: &RefCell<Vec<String>>) -> Vec<Row> {
    let real = Algorithm {
        parts: Parts::Real,
        ..algorithm("real", off)
    };
    let whole = Algorithm {
        plane: Plane::Whole,
        ..algorithm("whole", faddeeva)
    };
    let mut codes = vec![
        Code::single(algorithm("single", faddeeva)).unwrap(),
        Code::double(algorithm("off", off)),
        Code::double(real),
        Code::double(algorithm("turned", turned)),
        Code::double(whole),
    ];
    codes[1].nanoseconds = Some(7.0);
    survey(&codes, &EFFORT, &|word| told.borrow_mut().push(word.into()))
}

#[test]
fn each_code_is_surveyed_as_what_it_is() {
    let told = RefCell::default();
    let rows = rows(&told);
    let names: Vec<&str> = rows.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(names, ["single (f32)", "off", "real", "turned", "whole"]);
    let steps = ["values", "derivatives", "heights", "seams"];
    assert_eq!(told.into_inner(), [steps; 3].concat());
    let [single, off, real, turned, whole] = &rows[..] else {
        panic!("five rows");
    };
    let kinds = [single, off, real, turned, whole].map(|r| {
        [
            r.single,
            r.real_part_only,
            r.whole_plane,
            r.nanoseconds.is_some(),
        ]
    });
    let o = false;
    assert_eq!(
        kinds,
        [
            [true, o, o, o],
            [o, o, o, true],
            [o, true, o, o],
            [o; 4],
            [o, o, true, o]
        ]
    );
    assert!(
        rows.iter()
            .all(|r| r.jumps.is_empty() && r.heights.len() == 4)
    );
    let regions = |r: &Row| -> Vec<&str> { r.parts.iter().map(|p| p.region).collect() };
    let names =
        |all: Vec<crate::audit::Region>| -> Vec<&str> { all.iter().map(|r| r.name).collect() };
    let upper = names(regions::upper());
    for r in [off, real, turned] {
        assert_eq!(regions(r), [&upper[..], &["all"]].concat());
    }
    let lower = names(regions::lower());
    assert_eq!(regions(whole), [upper, lower, vec!["all"]].concat());
    assert_eq!(
        regions(single),
        [names(regions::of_single()), vec!["all"]].concat()
    );
    for r in &rows {
        let cases = |region: &str| r.part(region).map(|p| p.cases);
        assert_eq!((cases("ordinary"), cases("on-axis")), (Some(4), Some(4)));
        // Codes of the upper half-plane are not asked below.
        assert_eq!(cases("lower"), r.whole_plane.then_some(4), "{}", r.name);
        let sum: u64 = r.parts.iter().map(|p| p.cases).sum();
        assert_eq!(sum, 2 * cases("all").unwrap());
        assert!(r.part("nowhere").is_none());
    }
}

#[test]
fn errors_are_those_that_are_planted() {
    let rows = rows(&RefCell::default());
    let [single, off, real, turned, whole] = &rows[..] else {
        panic!("five rows");
    };
    let p = off.part("ordinary").unwrap();
    let due = Figures {
        worst: 1e-3,
        p99: 1e-3,
        median: 1e-3,
    };
    assert_eq!((&p.norm, p.re, p.im), (&Some(due), Some(1e-3), Some(1e-3)));
    assert!(p.worst_at.as_ref().is_some_and(|z| z[1] >= 0.1));
    assert!(off.parts.iter().all(|p| p.wrong == 0 && p.negative == 0));
    let p = real.part("all").unwrap();
    assert_eq!((p.re, p.im), (Some(1e-3), None));
    assert!(real.derivative.is_none());
    // Rounded to 2⁻²⁴ and 2⁻⁵³.
    let worst = |r: &Row| r.part("all").unwrap().norm.as_ref().unwrap().worst;
    assert!((1e-9..6e-8).contains(&worst(single)), "{}", worst(single));
    assert!((1e-17..2e-15).contains(&worst(whole)), "{}", worst(whole));
    // −2zw and 2i/√π cancel to 1/(2z²) of them, or thereabouts.
    let slope = |r: &Row| r.derivative.as_ref().unwrap().worst;
    assert!((1e-9..1e-4).contains(&slope(single)), "{}", slope(single));
    assert!((1e-17..1e-12).contains(&slope(whole)), "{}", slope(whole));
    assert!((1e-3..1.0).contains(&slope(off)), "{}", slope(off));
    let p = turned.part("ordinary").unwrap();
    assert_eq!(p.wrong + p.negative, 4);
    assert!(p.wrong > 0 && p.negative > 0, "{p:?}");
    assert_eq!((p.re, p.im), (Some(2.0), Some(2.0)));
    let negative = turned.parts.iter().map(|p| p.negative);
    let all = turned.part("all").unwrap();
    assert_eq!(negative.sum::<u64>(), 2 * all.negative);
    // On the axis and below it all the same.
    assert!(turned.part("on-axis").unwrap().negative > 0);
}

#[test]
fn a_single_point_has_a_norm() {
    let effort = Effort { cases: 1, seed: 1 };
    let rows = survey(&[Code::double(algorithm("off", off))], &effort, &|_| ());
    for p in rows[0].parts.iter().filter(|p| p.region != "huge") {
        assert!(p.norm.as_ref().is_some_and(|f| f.worst == 1e-3), "{p:?}");
    }
}

/// Profiles of half of the parameters are asked for simple lines alone.
#[test]
fn profiles_are_surveyed_over_lines() {
    let half = PROFILES.iter().find(|p| !p.whole).unwrap();
    let whole = PROFILES.iter().find(|p| p.whole).unwrap();
    let effort = Effort { cases: 2, seed: 1 };
    let rows = survey_lines(&[Code::line(*half), Code::line(*whole)], &effort);
    let cases =
        |r: &Row| -> Vec<(&str, u64)> { r.parts.iter().map(|p| (p.region, p.cases)).collect() };
    assert_eq!(cases(&rows[0]), [("rautian", 2), ("all", 2)]);
    let regions = lines::regions();
    let each = regions.iter().map(|r| (r.name, 2));
    assert_eq!(
        cases(&rows[1]),
        each.chain([("all", 12)]).collect::<Vec<_>>()
    );
    for (r, p) in rows.iter().zip([half, whole]) {
        assert_eq!((r.name.as_str(), r.whole_plane), (p.name, p.whole));
        assert!(!r.single && !r.real_part_only && r.derivative.is_none());
        let norm = r.part("rautian").unwrap().norm.as_ref().unwrap();
        assert!((1e-17..0.1).contains(&norm.worst), "{norm:?}");
    }
}

#[test]
fn an_answer_of_one_part_has_no_slope() {
    let code = Code::other(Default::default(), Plane::Upper, Parts::Both, |inputs| {
        let answer = |_| SolverAnswer::Values(vec![1.0]);
        inputs.iter().map(answer).collect()
    });
    let settings = Settings {
        cases_per_region: 3,
        ..Settings::default()
    };
    let ordinary = vec![regions::upper().swap_remove(0)];
    let found = &judged_slopes(&[&code], ordinary, &settings)[0].total;
    assert_eq!((found.cases, found.kinds.total()), (3, 3));
}
