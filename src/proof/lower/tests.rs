use super::phase::U;
use super::prove::leaves;
use super::reflection::least_of_w;
use super::*;
use crate::Rectangle;
use crate::at_points::{between, error, square};
use crate::pinned::{bit_by_bit, largest};
use mechaudit_solvers::faddeeva::proof::lower as solver;
use mechaudit_solvers::faddeeva::{Branch, faddeeva};
use num_complex::Complex;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use std::sync::LazyLock;

static CODE: LazyLock<Code> = LazyLock::new(|| Code::of_the_solver().expect("decided"));

fn worst(code: &Code, at: &Rectangle) -> f64 {
    let all = leaves(code, at).map_err(|_| ());
    all.map_or(f64::INFINITY, |l| {
        l.iter().map(|l| l.norm).fold(0.0, f64::max)
    })
}

#[test]
fn the_exponential_has_bounds_bit_by_bit() {
    let e = &CODE.exponential;
    assert!(e.pair < 0.28 * U && e.rounded < 4.0 * U, "{e:?}");
    let numbers = [e.pair, e.rounded, e.short[0], e.short[1], e.leading];
    let found = [
        largest("bounds", numbers.map(|x| x / U)),
        ("boxes", 0, e.boxes as f64),
    ];
    let due = [
        ("bounds", 0xef2cb8b204bf853c, 4.610867158567034),
        ("boxes", 0x0000000000000000, 43343.0),
    ];
    bit_by_bit(&found, &due);
}

#[test]
fn faults_of_the_exponential_show() {
    fn coefficient() -> solver::Constants {
        let mut c = solver::constants();
        c.exp[1] = f64::from_bits(c.exp[1].to_bits() + 8);
        c
    }
    fn half_pi() -> solver::Constants {
        let mut c = solver::constants();
        c.half_pi[2] = 0.0;
        c.half_pi[1] = 0.0;
        c
    }
    let sound = CODE.exponential.pair;
    let bound = |f: Factors| Exponential::of(&f).map_or(f64::INFINITY, |e| e.pair);
    let constants = |constants| Factors {
        constants,
        ..Factors::default()
    };
    for faulty in [
        bound(constants(coefficient)),
        bound(constants(half_pi)),
        bound(Factors {
            low_part: false,
            ..Factors::default()
        }),
    ] {
        assert!(faulty > 1.3 * sound, "{sound} {faulty}");
    }
}

#[test]
fn a_moved_limit_shows() {
    fn moved(a: f64, b: f64) -> Branch {
        match solver::formula(a, b) {
            Branch::Cell { .. } if a * a + b * b > 20.0 => Branch::Asymptotic { terms: 26 },
            b => b,
        }
    }
    let at = square(3.3, 3.1, 1e-3);
    let faulty = Code {
        formula: moved,
        ..CODE.clone()
    };
    assert!(worst(&CODE, &at) < 2.5 && worst(&faulty, &at) > 50.0);
    let mut faulty = CODE.clone();
    faulty.limits.cancelled = 0.001;
    faulty.limits.both_cancelled = 0.001;
    let at = square(20.0, 19.89, 1e-2);
    assert!(worst(&CODE, &at) < 2.5 && worst(&faulty, &at) > 50.0);
}

#[test]
fn a_coefficient_of_a_row_shows() {
    for (centre, at) in [
        ((0.5, -0.5), square(0.5, 0.5, 1e-2)),
        ((3.0, 3.0), square(3.0, 3.0, 1e-2)),
    ] {
        let mut faulty = CODE.clone();
        let off = |x: f64| f64::from_bits(x.to_bits() + 8);
        faulty.tables.change(centre, |row| row[0] = off(row[0]));
        let (sound, faulty) = (worst(&CODE, &at), worst(&faulty, &at));
        assert!(faulty > 1.3 * sound, "{centre:?} {sound} {faulty}");
    }
}

#[test]
fn the_first_partition_has_no_hole() {
    // With the real axis, and what is scaled.
    let least = f64::from_bits(1);
    let end = 2f64.powi(333);
    let mut all = roots();
    all.push(Rectangle {
        a: [0.0, f64::MAX],
        b: [0.0; 2],
    });
    all.push(Rectangle {
        a: [end, f64::MAX],
        b: [least, f64::MAX],
    });
    all.push(Rectangle {
        a: [0.0, f64::MAX],
        b: [end, f64::MAX],
    });
    assert_eq!(crate::hole(&all), None);
    all.remove(40);
    assert!(crate::hole(&all).is_some());
}

#[test]
fn rings_of_zeros_are_proved() {
    let watch = crate::Watch::default();
    let wanted = |r: &Rectangle| (1.0..16.0).contains(&r.a[1].max(r.b[1]));
    let found = lower_half_plane(&CODE, LOWER_HALF_PLANE, &watch, wanted).expect("not stopped");
    assert!(found.open.is_empty(), "{:?}", found.open.first());
    let most = found.leaves.iter().map(|l| l.norm).fold(0.0, f64::max);
    assert!(most > 2.0 && most <= LOWER_HALF_PLANE.norm, "{most}");
}

/// With a target that no bound reaches all of a shell is open, as often halved as may be.
#[test]
fn what_is_not_proved_is_open() {
    let watch = crate::Watch::default();
    let wanted = |r: &Rectangle| (1.0..2.0).contains(&r.a[1].max(r.b[1]));
    let shell = super::prove::roots().into_iter().filter(wanted).count();
    for depth in [0, 1, 2, 7] {
        let target = Target {
            norm: 1e-9,
            single: 1e-9,
            depth,
        };
        let found = lower_half_plane(&CODE, target, &watch, wanted).expect("not stopped");
        assert!(found.leaves.is_empty());
        assert_eq!(found.open.len(), shell << depth);
        let above = found
            .open
            .iter()
            .filter(|o| o.why.contains("above the target"));
        assert!(depth < 7 || above.count() > 10);
    }
    watch.stop.store(true, std::sync::atomic::Ordering::Relaxed);
    assert!(lower_half_plane(&CODE, LOWER_HALF_PLANE, &watch, wanted).is_none());
}

#[test]
#[ignore = "minutes"]
fn the_whole_half_plane() {
    let watch = crate::Watch::default();
    let found = theorem(LOWER_HALF_PLANE, None, &watch);
    let found = found.expect("decided").expect("not stopped");
    eprintln!("{found:#?}");
    assert!(found.open.is_empty());
    assert!(found.norm <= LOWER_HALF_PLANE.norm);
}

/// Returns whether the formula is that of the point; elsewhere another leaf has it.
fn is_used(region: Region, a: f64, b: f64) -> bool {
    let decay = a * a - b * b;
    let limit = CODE.limits.dominant - 1e-9;
    match (region, (CODE.formula)(a, b)) {
        (Region::Maclaurin { terms }, Branch::Maclaurin { terms: t }) => terms == t,
        (Region::Asymptotic { terms: 26 }, Branch::Asymptotic { terms: 26 }) => decay < limit,
        (Region::Asymptotic { terms }, Branch::Asymptotic { terms: t }) => terms == t,
        (Region::Cell { .. }, Branch::Cell { .. }) => decay.abs() < limit,
        (Region::Disc { .. }, Branch::LowerCell { .. })
        | (Region::RealAxis { .. }, Branch::RealAxis { .. })
        | (Region::Strip, Branch::Strip { .. })
        | (Region::RealLine, Branch::RealLine { .. }) => true,
        _ => false,
    }
}

#[test]
fn errors_at_points_are_below_their_bounds() {
    let watch = crate::Watch::default();
    let found = lower_half_plane(&CODE, LOWER_HALF_PLANE, &watch, |r| {
        r.a[1].max(r.b[1]) < 64.0
    });
    let found = found.expect("not stopped");
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut points = 0;
    let all = found.leaves.iter();
    for leaf in all.filter(|l| l.region != Region::Dominated) {
        for _ in 0..2 {
            let (a, b) = (
                between(&mut random, leaf.at.a),
                between(&mut random, leaf.at.b),
            );
            if !is_used(leaf.region, a, b) || !faddeeva(Complex::new(a, -b)).is_finite() {
                continue;
            }
            let off = error(a, -b);
            assert!(off <= leaf.norm, "{a} {b} {off} {leaf:?}");
            points += 1;
        }
    }
    assert!(points > 2000, "{points}");
}

/// Around a zero of w there is none, over rectangles too wide for the estimate as well.
#[test]
fn the_least_of_w_is_no_more_than_what_it_is_at_a_zero() {
    for row in solver::zero_rows().0 {
        let [a, b] = [row[0], -row[3]];
        for wide in [1e-3, 0.05, 0.1, 0.3, 1.0] {
            // The zero lies off the centre.
            let at = Rectangle {
                a: [a - wide, a + 0.5 * wide],
                b: [b - 0.5 * wide, b + wide],
            };
            assert_eq!(least_of_w(&at), 0.0, "{a} {b} {wide}");
        }
    }
    let off = Rectangle {
        a: [2.2, 2.21],
        b: [1.3, 1.31],
    };
    assert!(least_of_w(&off) > 0.0);
}
