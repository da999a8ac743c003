use super::*;
use crate::planted::{Planted, off, output};
use crate::{Limit, SolverAnswer};
use std::collections::BTreeSet;
use std::sync::Mutex;
use std::sync::atomic::AtomicUsize;

/// A function of one complex variable, up to a hundred ulps off.
fn complex<'a>() -> Planted<'a> {
    Planted {
        inputs: vec!["Re z", "Im z"],
        outputs: vec![
            output("Re w", Limit::Ulps(100.0)),
            output("Im w", Limit::Ulps(100.0)),
        ],
        ..Planted::default()
    }
}

/// The cell that holds a point: eight a unit, from the corner -9 - 6.5 i.
fn cell(z: &[f64]) -> (u64, u64) {
    (((z[0] + 9.0) * 8.0) as u64, ((z[1] + 6.5) * 8.0) as u64)
}

#[test]
fn functions_of_one_complex_variable_have_maps() {
    assert_eq!(map_points(&complex()), Some(144 * 104));
    for inputs in [
        vec!["x"],
        vec!["x", "y"],
        vec!["Re z", "x"],
        vec!["x", "Im z"],
        vec!["Im z", "Re z"],
        vec!["Re z", "Im z", "n"],
    ] {
        let other = Planted {
            inputs,
            ..complex()
        };
        assert_eq!(map_points(&other), None, "{:?}", other.inputs);
        let map = error_map(
            &other,
            &Settings::default(),
            &|| {},
            &AtomicBool::new(false),
        );
        assert!(map.is_none());
    }
}

/// Every cell is judged once, at its point; a value stands in the place of its cell.
#[test]
fn errors_stand_in_their_cells() {
    let seen = Mutex::new(BTreeSet::new());
    let method = Planted {
        solve: Box::new(|z| {
            seen.lock()
                .unwrap()
                .insert([z[0].to_bits(), z[1].to_bits()]);
            let (column, row) = cell(z);
            SolverAnswer::Values(match (column, row) {
                (3, 5) => vec![f64::NAN, z[1]],
                _ => vec![off(z[0], column), off(z[1], row)],
            })
        }),
        ..complex()
    };
    let ticks = AtomicUsize::new(0);
    let tick = || {
        ticks.fetch_add(1, Ordering::Relaxed);
    };
    let never = AtomicBool::new(false);
    let map = error_map(&method, &Settings::default(), &tick, &never).unwrap();
    assert_eq!((map.columns, map.rows, map.points()), (144, 104, 14976));
    assert_eq!((map.corner, map.side), ([-9.0, -6.5], 0.125));
    assert_eq!(ticks.into_inner(), 14976);
    let names: Vec<&str> = map.outputs.iter().map(|o| o.name).collect();
    assert_eq!(names, ["Re w", "Im w"]);
    let seen = seen.lock().unwrap();
    assert_eq!(seen.len(), 14976);
    assert!(map.outputs.iter().all(|o| o.ulps.len() == 14976));
    for row in 0..104 {
        for column in 0..144 {
            let z = map.at(column, row);
            assert!(seen.contains(&z.map(f64::to_bits)), "{z:?}");
            assert_eq!(cell(&z), (column as u64, row as u64));
            let ulps = [0, 1].map(|o: usize| map.outputs[o].ulps[row * 144 + column]);
            if (column, row) == (3, 5) {
                // A value of the wrong kind has no error in any output.
                assert!(ulps.iter().all(|u| u.is_nan()));
            } else {
                assert_eq!(ulps, [column as f64, row as f64]);
            }
        }
    }
    // Over a hundred ulps: columns from 101 on, rows from 101 on.
    assert_eq!(map.not_passed, 14976 - 101 * 101 + 1);
}

/// A point lies 0.527864 of a side from the lower left of its cell.
#[test]
fn points_are_no_simple_fractions() {
    let map = ErrorMap {
        columns: 4,
        rows: 4,
        corner: [-1.0, 2.0],
        side: 0.5,
        outputs: Vec::new(),
        not_passed: 0,
    };
    let expected = [(0, 0, -0.736_068, 2.263_932), (3, 1, 0.763_932, 2.763_932)];
    for (column, row, re, im) in expected {
        let z = map.at(column, row);
        assert!(
            (z[0] - re).abs() < 1e-15 && (z[1] - im).abs() < 1e-15,
            "{z:?}"
        );
    }
}

#[test]
fn a_map_may_be_stopped() {
    let stop = AtomicBool::new(true);
    assert_eq!(
        error_map(&complex(), &Settings::default(), &|| {}, &stop),
        None
    );
    let stop = AtomicBool::new(false);
    let end = || stop.store(true, Ordering::Relaxed);
    assert_eq!(
        error_map(&complex(), &Settings::default(), &end, &stop),
        None
    );
}
