use super::super::{ASSEMBLIES, Proved, certified as rows_certified, floating as rows};
use super::*;
use crate::machine::crank_angles::Window;
use crate::machine::{Linkage, Source};

fn read(text: &str) -> Dyad {
    match Linkage::read(&Source::toml(text)).unwrap() {
        Linkage::Dyad(dyad) => *dyad,
        _ => unreachable!("a dyad"),
    }
}

fn four_bar([a, b, c, d]: [f64; 4]) -> Dyad {
    read(&format!(
        "type = \"four-bar\"\ncrank_speed = \"3 rad/s\"\n[geometry]\ncrank = \"{a} m\"\n\
         coupler = \"{b} m\"\nrocker = \"{c} m\"\nframe = \"{d} m\""
    ))
}

fn slider_crank([a, b, e]: [f64; 3], direction: &str) -> Dyad {
    read(&format!(
        "type = \"slider-crank\"\n[geometry]\ncrank = \"{a} m\"\nrod = \"{b} m\"\n\
         offset = \"{e} m\"\ndirection = \"{direction}\""
    ))
}

/// The two coordinates and the transmission angle where both assemblies are one; other columns are
/// empty but for the determinant, which is zero. Certified digits say the same.
#[test]
fn positions_are_given_where_the_assemblies_meet() {
    for (dyad, degrees, due) in [
        // Stretched, at 180 deg on the frame's line and at 60 deg off it.
        (four_bar([1.0, 2.0, 4.0, 5.0]), 180, [0.0, 180.0, 180.0]),
        (four_bar([1.0, 0.5, 0.5, 1.0]), 60, [-60.0, 120.0, 180.0]),
        (four_bar([1.0, 0.5, 0.5, 1.0]), -60, [60.0, -120.0, 180.0]),
        // Folded, the coupler longer than the rocker and shorter.
        (four_bar([1.0, 2.0, 1.0, 1.0]), 60, [-60.0, -60.0, 0.0]),
        (four_bar([1.0, 1.0, 2.0, 1.0]), 60, [120.0, 120.0, 0.0]),
        (four_bar([2.0, 3.0, 2.0, 3.0]), 0, [0.0, 0.0, 0.0]),
        (four_bar([3.0, 2.0, 3.0, 2.0]), 360, [0.0, 0.0, 0.0]),
        // The rod square to the guide, below and above, and with a guide at 10 deg.
        (
            slider_crank([2.0, 2.0, 0.0], "0 deg"),
            90,
            [0.0, -90.0, 0.0],
        ),
        (
            slider_crank([2.0, 2.0, 0.0], "0 deg"),
            270,
            [0.0, 90.0, 0.0],
        ),
        (
            slider_crank([2.0, 1.0, 0.0], "0 deg"),
            30,
            [3f64.sqrt(), -90.0, 0.0],
        ),
        (
            slider_crank([2.0, 1.0, 0.0], "10 deg"),
            160,
            [-(3f64.sqrt()), -80.0, 0.0],
        ),
    ] {
        let at = Rational::from(degrees);
        assert_eq!(dyad.shape.reached(&at), Some(Reached::Singular));
        for assembly in ASSEMBLIES {
            let row = rows(&dyad, &at, assembly).unwrap().expect("a row");
            for (found, due) in [row[0], row[1], row[6]].iter().zip(due) {
                assert!((found - due).abs() < 1e-12, "{degrees}: {row:?}");
            }
            assert!(row[2..6].iter().all(|x| x.is_nan()) && row[7] == 0.0);
            let Proved::Singular(digits) = rows_certified(&dyad, &at, assembly, 20) else {
                panic!("a singular row at {degrees}");
            };
            for (k, x) in row.iter().enumerate() {
                match &digits[k] {
                    Some(text) => assert!((text.parse::<f64>().unwrap() - x).abs() < 1e-12),
                    None => assert!(x.is_nan(), "value {k} at {degrees}"),
                }
            }
            // The joint is where links and pivots put it.
            let place = super::super::position(&dyad, assembly, f64::from(degrees)).unwrap();
            let [a, b] = place.joints_m;
            let length = match &dyad.shape {
                Shape::FourBar { solver, .. } => solver.coupler().m(),
                Shape::SliderCrank { solver, .. } => solver.rod().m(),
            };
            assert!(((a[0] - b[0]).hypot(a[1] - b[1]) - length).abs() < 1e-12);
        }
        // Close by, both assemblies come to it.
        for assembly in ASSEMBLIES {
            let off = Rational::from((1, 10_000_000));
            let sides = [Rational::from(&at - &off), at.clone() + off];
            let near = sides.map(|x| rows(&dyad, &x, assembly).unwrap());
            let near = near
                .into_iter()
                .flatten()
                .next()
                .expect("one side is in reach");
            let apart = |k: usize| {
                let x: f64 = near[k] - due[k];
                if dyad.shape.angles().contains(&k) {
                    (x - 360.0 * (x / 360.0).round()).abs()
                } else {
                    x.abs()
                }
            };
            assert!(apart(0) < 0.01 && apart(1) < 0.01, "{degrees}: {near:?}");
        }
    }
}

/// Where crank and rocker end in one point, the coupler may have any angle.
#[test]
fn a_coupler_that_may_have_any_angle_has_no_row() {
    let dyad = four_bar([2.0, 1.0, 1.0, 2.0]);
    for assembly in ASSEMBLIES {
        assert_eq!(rows(&dyad, &0.into(), assembly), Ok(None));
        let proved = rows_certified(&dyad, &0.into(), assembly, 10);
        assert!(matches!(proved, Proved::Unreachable));
    }
}

#[test]
fn meetings_of_the_grid_are_listed_once() {
    let grid = |from: i32, step: (i32, i32), to: i32| {
        let window = Window {
            step: step.into(),
            from: Some(from.into()),
            to: Some(to.into()),
        };
        Grid::new(&window, None, 1_000_000).unwrap()
    };
    let found = |dyad: &Dyad, grid: &Grid| -> Vec<(f64, bool)> {
        let all = meetings(dyad, grid);
        all.iter().map(|m| (m.degrees.to_f64(), m.passes)).collect()
    };
    let change = four_bar([1.0, 2.0, 4.0, 5.0]);
    assert_eq!(found(&change, &grid(0, (1, 1), 360)), [(180.0, true)]);
    assert_eq!(found(&change, &grid(180, (1, 1), 180)), [(180.0, true)]);
    assert_eq!(found(&change, &grid(0, (7, 1), 200)), []);
    // 7 · 180 is 3 turns and a half.
    assert_eq!(found(&change, &grid(0, (7, 1), 2000)), [(1260.0, true)]);
    assert_eq!(found(&change, &grid(-190, (5, 2), -170)), [(-180.0, true)]);
    let part = slider_crank([2.0, 1.0, 0.0], "0 deg");
    let due = [30.0, 150.0, 210.0, 330.0].map(|d| (d, false));
    assert_eq!(found(&part, &grid(0, (10, 1), 350)), due);
    let crank = four_bar([1.0, 4.0, 3.0, 3.5]);
    assert_eq!(found(&crank, &grid(0, (1, 1), 360)), []);
}
