use super::*;
use crate::at_points::{pieces_hold_what_is_due, square};
use crate::grid::power_of_two;
use crate::interval::sum_up;
use crate::lower::phase::U;
use crate::pinned::{bit_by_bit, counted, of_binades, units};
use mechaudit_reference::faddeeva::w_f64;
use std::sync::LazyLock;

/// The solver's code, with bounds of the exponential that `the_exponential_has_bounds` proves.
pub(crate) static CODE: LazyLock<Code> = LazyLock::new(|| Code {
    tables: Tables::of_the_solver().expect("decided"),
    formula: code::formula,
    exponential: Exponential {
        pair: 0.28 * U,
        rounded: 4.0 * U,
        short: [8.0 * U, 4.0 * U],
        leading: 4.0 * U,
        boxes: 0,
    },
    limits: code::LIMITS,
    rounding: Rounding::default(),
});

/// A square in each formula: which one it is, and the bound no larger than it was found to be.
#[test]
fn every_formula_has_its_bound() {
    let all = [
        (0.002, 0.002, 1e-3, "Maclaurin, 9 terms", 1.5),
        (0.1, 0.1, 1e-2, "Maclaurin, 21 terms", 1.5),
        (0.6, 0.6, 1e-2, "Taylor, lower half-disc", 1.5),
        (3.0, 0.01, 1e-3, "Taylor, real axis", 1.5),
        (9.5, 1e-4, 1e-6, "strip", 1.5),
        (12.0, 1e-12, 1e-14, "real line", 1.5),
        (3.0, 3.0, 1e-2, "cell, both terms", 2.5),
        (3.0, 2.5, 1e-2, "cell, both terms", 2.5),
        (6.0, 5.9, 1e-2, "26 terms, both terms", 2.5),
        (10.0, 9.9, 1e-2, "14 terms, both terms", 2.5),
        (40.0, 39.5, 1e-2, "6 terms, both terms", 2.5),
        (3.5, 1.0, 1e-2, "one term dominates", 0.0),
        (1.0, 3.5, 1e-2, "one term dominates", 0.0),
    ];
    for (a, b, side, name, most) in all {
        let at = square(a, b, side);
        let found = regions(&CODE, &at).expect("few formulas");
        assert!(
            !found.is_empty() && found.iter().all(|(_, r)| r.name() == name),
            "{a} {b} {found:?}"
        );
        for (piece, region) in found {
            let norm = bound(&CODE, region, &piece).expect("a bound");
            assert!(norm <= most, "{region:?} {norm}");
        }
    }
}

/// Checks that what is used is at least `cancelled` of w(−z), or the part of the larger component.
#[test]
fn the_part_that_is_used() {
    let with = |cancelled: f64, both_cancelled: f64| {
        used(&code::Limits {
            cancelled,
            both_cancelled,
            ..code::LIMITS
        })
    };
    assert_eq!(with(0.5, 0.1), 0.5);
    let both = with(0.1, 0.5);
    assert!(both <= 0.5 * 0.5f64.sqrt() && both > 0.353);
    assert!(sum_up(0.0, used(&code::LIMITS)) > 0.0);
}

/// Returns what the code uses at `a − ib`, or may use where rounding decides.
fn at_point(a: f64, b: f64) -> Vec<Region> {
    // Of e^{−z²}: it is below e^{−d}.
    let d = a * a - b * b;
    let limit = CODE.limits.dominant;
    let room = 1e-9;
    match (CODE.formula)(a, b) {
        Branch::Maclaurin { terms } => vec![Region::Maclaurin { terms }],
        Branch::LowerCell { .. } => vec![Region::Disc {
            centre: disc_at(a, b).0,
        }],
        Branch::RealAxis { .. } => vec![Region::RealAxis {
            centre: real_axis_at(a).0,
        }],
        Branch::Strip { .. } => vec![Region::Strip],
        Branch::RealLine { .. } => vec![Region::RealLine],
        Branch::Cell { .. } => {
            let cell = Region::Cell {
                centre: cell_at(a, b).0,
            };
            let mut all = Vec::new();
            if d.abs() > limit - room {
                all.push(Region::Dominated);
            }
            if d.abs() < limit + room {
                all.push(cell);
            }
            all
        }
        Branch::Asymptotic { terms } if terms == 26 && d > limit + room => vec![Region::Dominated],
        // w overflows.
        Branch::Asymptotic { .. } if d < -708.0 => vec![],
        Branch::Asymptotic { terms } => vec![Region::Asymptotic { terms }],
        Branch::Huge => vec![],
        other => panic!("{other:?}"),
    }
}

/// Wherever the code takes a formula, that is among the regions, on a piece with the point.
#[test]
fn the_formula_of_each_point_is_among_the_regions() {
    let all = |at: &Rectangle| regions(&CODE, at);
    pieces_hold_what_is_due(all, at_point, MANY, |at| Rectangle {
        a: [0.0, at.a[1]],
        ..at
    });
}

/// `|w(z)|`, or `|w(−z)|` for what is reflected, is within what each formula gives on each way.
#[test]
fn values_are_enclosed() {
    for (a, b, side) in [
        (0.001, 0.002, 1e-4),
        (0.1, 0.3, 1e-3),
        (0.61, 0.68, 1e-3),
        (0.68, 0.61, 1e-3),
        (3.01, 2.26, 1e-3),
        (3.0, 0.01, 1e-3),
        (3.03, 0.01, 0.03),
        (6.5, 6.4, 1e-3),
        (9.5, 1e-4, 1e-5),
        (12.0, 1e-12, 1e-13),
        (12.0, 12.01, 1e-3),
        (40.0, 40.01, 1e-3),
    ] {
        let at = square(a, b, side);
        let all = regions(&CODE, &at).expect("few");
        assert!(!all.is_empty());
        for (piece, region) in all {
            for (x, y) in [
                (piece.a[0], piece.b[0]),
                (piece.a[0], piece.b[1]),
                (piece.a[1], piece.b[0]),
                (piece.a[1], piece.b[1]),
            ] {
                let sign = if region.is_reflected() { 1.0 } else { -1.0 };
                let w = w_f64(x, sign * y, 60).expect("decided");
                let size = f64::hypot(w.re.mid().to_f64(), w.im.mid().to_f64());
                let room = 1e-13 * size;
                for v in values(&CODE, region, &piece).expect("a value") {
                    let inside = v.least <= size + room && size - room <= v.most;
                    assert!(inside, "{region:?} {piece:?} {size} {v:?}");
                    assert!(v.most < 1.1 * v.least, "{region:?} {v:?}");
                }
            }
        }
    }
}

/// At the limits, within what rounding of |Re z²| may decide, both formulas count; beyond one does.
#[test]
fn both_formulas_count_at_the_limits() {
    let limit = CODE.limits.dominant;
    let names = |d: f64, b: f64| -> Vec<bool> {
        // a² − b² = d but for the rounding of a.
        let a = (d + b * b).sqrt();
        let at = square(a, b, 0.0);
        let found = decay(&at);
        assert!((found.lo - d).abs() < 1e-13 && (found.hi - d).abs() < 1e-13);
        let all = regions(&CODE, &at).expect("few");
        all.iter().map(|(_, r)| *r == Region::Dominated).collect()
    };
    // |z|² = 44 where b is the larger one.
    for (b, sign) in [(1.0, 1.0), (f64::sqrt(0.5 * (44.0 + limit)), -1.0)] {
        for off in [-0.8e-12, -0.3e-12, 0.3e-12, 0.8e-12] {
            assert_eq!(names(sign * limit + off, b), [true, false], "{sign} {off}");
        }
        let [inside, beyond] = [-1.5e-12, 1.5e-12].map(|off| names(sign * (limit + off), b));
        assert_eq!((inside, beyond), (vec![false], vec![true]), "{sign}");
    }
    // Of the series the image alone may dominate.
    let b = f64::sqrt(0.5 * (60.0 - limit));
    for off in [-0.8e-12, -0.3e-12, 0.3e-12, 0.8e-12] {
        assert_eq!(names(limit + off, b), [true, false], "{off}");
    }
    let [inside, beyond] = [-1.5e-12, 1.5e-12].map(|off| names(limit + off, b));
    assert_eq!((inside, beyond), (vec![false], vec![true]));
}

/// Rows are wrong by most at the farthest point of the rectangle.
#[test]
fn rows_are_wrong_by_most_at_the_farthest_point() {
    let at = Rectangle {
        a: [2.99, 3.01],
        b: [1e-9, 0.12],
    };
    for (piece, region) in regions(&CODE, &at).expect("few") {
        let Region::RealAxis { centre } = region else {
            continue;
        };
        let errors = |code: &Code| code.tables.real_axis(centre).expect("a row").1.clone();
        let far = piece.a.map(|a| (a - centre).abs());
        let [far, b] = [far[0].max(far[1]), piece.b[1]];
        let due = errors(&CODE).within(far, b).norm;
        let near = errors(&CODE).within(far, 0.0).norm;
        let error = |code: &Code| values(code, region, &piece).expect("a value")[0].error;
        assert!(error(&CODE) >= due && due > near, "{due:e} {near:e}");
        // A last coefficient that is off counts by the power of that distance.
        let mut faulty = CODE.clone();
        let of = |row: &mut upper::Row| row.iter_mut().for_each(|c| *c += 1e-3);
        faulty.tables.change((centre, 0.0), of);
        let due = errors(&faulty).within(far, b).norm;
        assert!(error(&faulty) >= due, "{due:e}");
    }
}

/// Which formulas rectangles have, their bounds, and how a shell is halved.
#[test]
fn leaves_bit_by_bit() {
    use crate::certificate::Watch;
    use crate::lower::prove::{LOWER_HALF_PLANE, Target, lower_half_plane};
    let mut unit = units(7);
    let squares = (0..300).map(|i| {
        let [a, b] = match i % 3 {
            0 => [3.0 * unit(), 3.0 * unit()],
            1 => [12.0 * unit(), 12.0 * unit()],
            _ => [0; 2].map(|_| of_binades(&mut unit, [-40, 6])),
        };
        square(a, b, of_binades(&mut unit, [-12, -5]))
    });
    let mut squares: Vec<Rectangle> = squares.collect();
    // Next to the real axis and beside the first zero, where the bound by the size of w is better.
    squares.extend([square(0.0, 0.002, 1e-5), square(9.5, 1e-4, 1e-5)]);
    squares.extend([0.01, 0.04, 0.12].map(|off| square(1.991 + off, 1.355, 0.004)));
    squares.push(Rectangle {
        a: [1.0, 1.0625f64.next_down()],
        b: [power_of_two(-28), 0.125],
    });
    let regions: Vec<_> = squares.iter().map(|r| super::regions(&CODE, r)).collect();
    let some = regions.iter().flatten().rev().step_by(4).flatten();
    let bounds: Vec<_> = some.map(|(at, region)| bound(&CODE, *region, at)).collect();
    let shell = |r: &Rectangle| [r.a, r.b] == [[2.0, 4f64.next_down()]; 2];
    let of = |target: Target| {
        let found = lower_half_plane(&CODE, target, &Watch::default(), shell);
        let found = found.expect("not stopped");
        (found.leaves, found.open)
    };
    let due = Target {
        depth: 9,
        ..LOWER_HALF_PLANE
    };
    let single = Target {
        single: 0.0,
        depth: 5,
        ..due
    };
    let found = [
        counted("regions", &regions),
        counted("bounds", &bounds),
        counted("proved", [of(due), of(single)]),
    ];
    let due = [
        ("regions", 0x8494d76280fa3f58, 306.0),
        ("bounds", 0x7f71d8c2c27a7468, 94.0),
        ("proved", 0x803bb54923e761f3, 2.0),
    ];
    bit_by_bit(&found, &due);
}
