//! The formulas of a rectangle against the code's choice at points of it.

use super::*;
use crate::at_points::{holds, pieces_hold_what_is_due};
use crate::cover::hole;
use crate::pinned::{bit_by_bit, counted, of_binades, units};
use mechaudit_solvers::faddeeva::branch;
use num_complex::Complex;
use std::sync::LazyLock;

static CODE: LazyLock<Code> = LazyLock::new(|| Code::of_the_solver().expect("decided"));

/// The formula of the code at a point, with the row that it takes there.
fn at_point(a: f64, b: f64) -> Formula {
    match branch(Complex::new(a, b)) {
        Branch::Cell { .. } => Formula::Cell {
            centre: cell_at(a, b).0,
        },
        Branch::RealAxis { .. } => Formula::RealAxis {
            centre: real_axis_at(a).0,
        },
        Branch::ImaginaryAxis { .. } => Formula::ImaginaryAxis {
            centre: imaginary_axis_at(b).0,
        },
        other => Formula::of(other, a == 0.0).expect("a branch"),
    }
}

/// Wherever the code takes a formula, that is among the parts, on a piece with the point.
#[test]
fn the_formula_of_each_point_is_among_the_parts() {
    let all = |at: &Rectangle| parts(&CODE, at);
    let due = |a, b| vec![at_point(a, b)];
    pieces_hold_what_is_due(all, due, MANY, |at| Rectangle { a: [0.0; 2], ..at });
    pieces_hold_what_is_due(all, due, MANY, |at| Rectangle {
        b: [0.0, at.b[1]],
        ..at
    });
}

/// Pieces of a rectangle together are it, and none is outside.
#[test]
fn parts_cover_their_rectangle() {
    for (a, b) in [
        ([6.9, 7.1], [6.9, 7.1]),
        ([2.95, 3.0], [1e-5, 0.13]),
        ([1.4, 1.6], [1.4, 1.6]),
        ([8.0, 8.1], [1e-9, 1e-3]),
        ([0.0, 0.0], [2.9, 3.2]),
    ] {
        let at = Rectangle { a, b };
        let all = parts(&CODE, &at).unwrap_or_else(|why| panic!("{at:?}: {why}"));
        let mut pieces: Vec<Rectangle> = all.iter().map(|(p, _)| *p).collect();
        assert!(
            pieces
                .iter()
                .all(|p| holds(&at, p.a[0], p.b[0]) && holds(&at, p.a[1], p.b[1]))
        );
        // The rest of the quadrant, and the others in their place.
        let (below, above) = (
            |x: f64| [0.0, x.next_down()],
            |x: f64| [x.next_up(), f64::MAX],
        );
        let rest = [
            (a[0] > 0.0).then(|| (below(a[0]), [0.0, f64::MAX])),
            Some((above(a[1]), [0.0, f64::MAX])),
            (b[0] > 0.0).then(|| (a, below(b[0]))),
            Some((a, above(b[1]))),
        ];
        pieces.extend(rest.into_iter().flatten().map(|(a, b)| Rectangle { a, b }));
        assert_eq!(hole(&pieces), None, "{at:?} {all:?}");
    }
}

/// With a third formula between, which the corners do not show, nothing is said.
#[test]
fn a_formula_between_those_of_the_corners_is_not_passed_over() {
    let at = |a: [f64; 2], b: [f64; 2]| parts(&CODE, &Rectangle { a, b });
    // Across the ring of 14 terms, and of 4.
    assert!(at([5.0, 60.0], [5.0, 60.0]).is_err());
    let far = at([50.0, 1e14], [50.0, 1e14]);
    assert!(far.is_err(), "{far:?}");
    // Two that follow, and one alone.
    let names = |all: Vec<Part>| all.iter().map(|(_, f)| f.name()).collect::<Vec<_>>();
    let two = at([1.0, 40.0], [27.0, 30.0]).map(names);
    assert_eq!(two, Ok(vec!["asymptotic, 14 terms", "asymptotic, 6 terms"]));
    let one = at([40.0, 41.0], [27.0, 30.0]).map(names);
    assert_eq!(one, Ok(vec!["asymptotic, 6 terms"]));
}

/// Pieces with their formulas, and on which side of lines numbers are.
#[test]
fn pieces_of_rectangles_bit_by_bit() {
    use mechaudit_solvers::faddeeva::branch;
    let code = |a: f64, b: f64| branch(num_complex::Complex::new(a, b));
    let mut unit = units(11);
    let lines = [0.5, 1.0, 2.0];
    let sides = [0.25, 0.5, 0.75, 1.0, 3.0].map(side(&lines));
    let floor = |a: f64, b: f64| (a.floor() + 10.0 * b.floor(), b.floor() - 10.0 * a.floor());
    let mut squares = Vec::new();
    for i in 0..300 {
        let [a, b] = [0; 2].map(|_| match i % 2 {
            0 => 8.0 * unit(),
            _ => of_binades(&mut unit, [-40, 5]),
        });
        let wide = of_binades(&mut unit, [-8, 0]);
        squares.push(Rectangle {
            a: [a, a + wide],
            b: [b, b + wide],
        });
    }
    let centres = squares.iter().map(|at| by_centre(at, floor));
    let axis = squares.iter().map(|at| {
        let mut out = Vec::new();
        let branch = code(0.0, at.b[0]);
        let at = Rectangle { a: [0.0; 2], ..*at };
        (on_axis(at, branch, &mut out), out)
    });
    let rows = squares.iter().map(|at| {
        let mut out = Vec::new();
        (with_rows(*at, code(at.a[0], at.b[0]), &mut out), out)
    });
    let found = [
        counted("sides", sides),
        counted("centres", centres),
        counted("axis", axis),
        counted("rows", rows),
        counted("choices", squares.iter().map(|at| choices(at, code, rank))),
    ];
    let due = [
        ("sides", 0x47e5efde30b820b1, 5.0),
        ("centres", 0x41f8eccf49e88694, 300.0),
        ("axis", 0xe17b249e9a643565, 300.0),
        ("rows", 0xdb8ef672d3b0c868, 300.0),
        ("choices", 0x7736f245eaa8f331, 300.0),
    ];
    bit_by_bit(&found, &due);
}
