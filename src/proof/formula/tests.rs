use super::*;
use crate::code::Code;
use crate::pinned::{bit_by_bit, counted, of_binades, units};
use mechaudit_solvers::faddeeva::faddeeva;
use num_complex::Complex;
use std::sync::LazyLock;

static TABLES: LazyLock<Tables> = LazyLock::new(|| Code::of_the_solver().expect("decided").tables);

fn part(lo: f64, hi: f64, error: f64) -> Tracks {
    Tracks {
        exact: Interval::new(lo, hi),
        error,
        tiny: 0.0,
        small: false,
        relative: f64::INFINITY,
    }
}

const NONE: Truncation = Truncation {
    norm: 0.0,
    re: 0.0,
    im: 0.0,
    tiny: 0.0,
    sum: None,
};

/// Differences from a centre are exact below `2^{g+53}`, g the coarser grid's exponent, and refused
/// beyond.
#[test]
fn distances_that_are_rounded_are_refused() {
    let of = |ends: [f64; 2], centre: f64| offsets(ends, centre).map(|t| (t.ends, t.grain));
    assert_eq!(of([1.5, 1.75], 1.25), Ok(([0.25, 0.5], -52)));
    assert_eq!(of([1.5, 1.75], 2.0), Ok(([-0.5, -0.25], -52)));
    // The finer grid of the two, and the larger of both distances.
    assert_eq!(of([0.5, 1.0], 1.25), Ok(([-0.75, -0.25], -53)));
    assert!(of([0.25, 3.0], 1.25).is_err());
    assert!(of([0.25, 1.5], 1.25).is_err() && of([0.5, 0.75], 1.75).is_err());
    assert_eq!(of([1.25, 1.25], 1.25), Ok(([0.0, 0.0], -52)));
    assert_eq!(of([4.0, 4.5], 3.75), Ok(([0.25, 0.75], -51)));
    assert!(of([1.25, 3.5], 1.25).is_err());
    assert_eq!(of([1e-9, 0.5], 0.0), Ok(([1e-9, 0.5], grain_of(1e-9))));
    // All numbers of them: no difference is rounded.
    assert_eq!(of([1.1, 2.0], 3.0).map(|t| t.1), Ok(-52));
    assert!(of([1.0, 2.0], 3.0).is_err());
    assert!(of([0.1, 0.2], 1.5).is_err());
}

/// The formula without rounding is w but for its truncation, at corners of rectangles with and
/// without a small coordinate.
#[test]
fn values_are_enclosed() {
    let narrow = [1e-3, 0.9];
    let all = [
        (Formula::Maclaurin { terms: 9 }, [1e-3, 2e-3], [1e-3, 3e-3]),
        (Formula::Maclaurin { terms: 21 }, [0.1, 0.12], [0.3, 0.32]),
        (Formula::MaclaurinOnAxis, [0.0; 2], [1e-3, 3e-3]),
        (
            Formula::Cell { centre: (1.5, 1.5) },
            [1.53, 1.54],
            [1.55, 1.56],
        ),
        (
            Formula::Cell { centre: (0.0, 3.0) },
            [1e-3, 0.1],
            [3.05, 3.06],
        ),
        (
            Formula::RealAxis { centre: 3.0 },
            [3.001, 3.002],
            [0.01, 0.02],
        ),
        (
            Formula::ImaginaryAxis { centre: 3.0 },
            [0.0; 2],
            [3.01, 3.02],
        ),
        (Formula::Strip, [9.5, 9.501], [1e-5, 1e-4]),
        (Formula::RealLine, [12.0, 12.001], [1e-12, 1e-10]),
        (Formula::Asymptotic { terms: 26 }, [7.5, 8.5], narrow),
        (Formula::Asymptotic { terms: 26 }, narrow, [7.5, 8.5]),
        (Formula::Asymptotic { terms: 14 }, [12.0, 12.1], [3.0, 3.1]),
        (Formula::Asymptotic { terms: 6 }, [40.0, 60.0], narrow),
        (Formula::Asymptotic { terms: 4 }, narrow, [200.0, 300.0]),
        (Formula::Asymptotic { terms: 2 }, [5e4, 9e4], [5e4, 9e4]),
        (
            Formula::AsymptoticOnAxis { terms: 26 },
            [0.0; 2],
            [7.5, 7.6],
        ),
        (
            Formula::AsymptoticOnAxis { terms: 14 },
            [0.0; 2],
            [12.0, 12.1],
        ),
        (
            Formula::AsymptoticOnAxis { terms: 6 },
            [0.0; 2],
            [200.0, 210.0],
        ),
    ];
    for (formula, a, b) in all {
        let at = Rectangle { a, b };
        let (ways, t) = run(&TABLES, formula, &at, Rounding::default()).expect("a value");
        for (x, y) in [(a[0], b[0]), (a[0], b[1]), (a[1], b[0]), (a[1], b[1])] {
            let w = faddeeva(Complex::new(x, y));
            let room = 1e-13 * w.norm() + t.norm;
            let [re, im] = small(formula, &at);
            let factor = match (re, im) {
                (true, _) => x,
                (_, true) => y,
                _ => 1.0,
            };
            let holds = |r: &Tracks, w: f64| {
                let w = if r.small { w / factor } else { w };
                let room = if r.small { room / factor } else { room };
                r.exact.lo - room <= w && w <= r.exact.hi + room
            };
            let inside = ways.iter().any(|[p, q]| holds(p, w.re) && holds(q, w.im));
            assert!(inside, "{formula:?} {x} {y} {w} {ways:?}");
        }
    }
}

/// A row whose zeros are not stored as zero has no symmetry.
#[test]
fn rows_that_are_not_symmetric_are_refused() {
    let centre = (0.0, 3.0);
    let at = Rectangle {
        a: [1e-3, 0.1],
        b: [3.05, 3.06],
    };
    let of = |tables: &Tables| bound(tables, Formula::Cell { centre }, &at, Rounding::default());
    assert!(of(&TABLES).is_ok());
    let mut tables = TABLES.clone();
    tables.change(centre, |row| {
        let zero = row.iter_mut().find(|c| **c == 0.0).expect("a zero");
        *zero = 1e-40;
    });
    assert!(of(&tables).is_err());
}

/// Bounds of scaled rectangles are kept by all four ends.
#[test]
fn scaled_bounds_are_of_their_rectangle() {
    let ends =
        [[1.0, 1.1], [1.0, 1.2], [1.05, 1.1], [0.9, 1.1]].map(|e| e.map(|x| x * 2f64.powi(665)));
    let of = |tables: &Tables, at: &Rectangle| {
        bound(tables, Formula::Huge, at, Rounding::default()).expect("a bound")
    };
    let long = [1.5, 1.6].map(|x| x * 2f64.powi(665));
    let mut kept = TABLES.clone();
    kept.scaled = Default::default();
    for short in ends {
        for at in [
            Rectangle { a: long, b: short },
            Rectangle { a: short, b: long },
        ] {
            let mut tables = kept.clone();
            tables.scaled = Default::default();
            assert_eq!(of(&kept, &at), of(&tables, &at), "{at:?}");
            // Once more, from what is kept.
            assert_eq!(of(&kept, &at), of(&tables, &at));
        }
    }
}

/// Bounds hold where the number computed and the true one are as far apart as is allowed.
#[test]
fn bounds_hold_where_numbers_are_farthest_apart() {
    let mut unit = units(11);
    let mut closest = [0.0f64; 3];
    for round in 0..4000 {
        let sigma = [0.75, 1.0].map(|s| s * power_of_two(-(round % 40)));
        let t = 1e-4 * unit();
        let truncation = Truncation {
            norm: t,
            re: 0.8 * t,
            im: 0.5 * t,
            ..NONE
        };
        let parts = [0, 1].map(|i| {
            let lo = of_binades(&mut unit, [-2, 2]);
            Tracks {
                small: i == 0 && round % 2 == 1,
                ..part(lo, 1.001 * lo, 1e-4 * unit() * lo)
            }
        });
        let bound = Evaluated { parts, truncation }.bound(Interval::new(sigma[0], sigma[1]));
        for at in 0..8 {
            let ends = [0, 1].map(|i| {
                let p = &parts[i];
                let by = if p.small { sigma[at & 1] } else { 1.0 };
                let exact = if at & 2 == 0 { p.exact.lo } else { p.exact.hi };
                let left = [truncation.re, truncation.im][i];
                let side = if at & 4 == 0 { 1.0 } else { -1.0 };
                ((p.error + left) * by, (exact - side * left) * by)
            });
            let [(p, x), (q, y)] = ends;
            let ulp = |v: f64| power_of_two(exponent(v) - 52);
            let norm = p.hypot(q) / x.hypot(y) * TWO_52;
            let found = [
                norm / bound.norm,
                p / ulp(x) / bound.re,
                q / ulp(y) / bound.im,
            ];
            assert!(
                found.iter().all(|f| *f <= 1.0 + 1e-9),
                "{round} {at} {found:?}"
            );
            closest = [0, 1, 2].map(|k| closest[k].max(found[k]));
        }
    }
    assert!(closest.iter().all(|c| *c > 0.99), "{closest:?}");
    // Above 2⁻⁹⁶⁰ underflow counts among the units, below apart from them.
    let of = |lo: f64, tiny: f64| {
        let known = Tracks {
            tiny,
            ..part(lo, lo, 0.0)
        };
        let parts = [known, part(lo, lo, 0.0)];
        let truncation = NONE;
        Evaluated { parts, truncation }.bound(Interval::ZERO)
    };
    let above = of(1.001 * FAR_ABOVE, 3.0);
    assert!(above.tiny == 0.0 && above.re >= 1.5 * power_of_two(-62) && above.norm > 0.0);
    let below = of(0.5 * FAR_ABOVE, 3.0);
    assert_eq!((below.tiny, below.re, below.norm), (3.0, 0.0, 0.0));
}

/// Bounds of every formula over rectangles of several sizes; what a scaled one comes to is kept.
#[test]
fn formulas_bit_by_bit() {
    use crate::choice::parts;
    let mut unit = units(13);
    let code = Code::of_the_solver().expect("decided");
    let mut rectangles = Vec::new();
    for i in 0..320 {
        let [a, b] = match i % 5 {
            0 => [0.3 * unit(), 0.3 * unit()],
            1 => [7.0 * unit(), 7.0 * unit()],
            2 => [0.0, of_binades(&mut unit, [-6, 6])],
            3 => [8.0 + 30.0 * unit(), of_binades(&mut unit, [-70, 4])],
            _ => [0; 2].map(|_| of_binades(&mut unit, [-4, 6])),
        };
        let side = of_binades(&mut unit, [-14, -7]);
        let wide = |x: f64| {
            if x == 0.0 {
                [0.0; 2]
            } else {
                [x, x * (1.0 + side)]
            }
        };
        let b = if i % 7 == 0 { [0.0, b * side] } else { wide(b) };
        rectangles.push(Rectangle { a: wide(a), b });
    }
    let far = [[1e150, 1.1e150], [1e101, 1.1e101]];
    rectangles.extend(far.map(|a| Rectangle { a, b: a }));
    rectangles.push(Rectangle {
        a: [1e-9, 1e-3],
        b: [20.0, 20.5],
    });
    rectangles.push(Rectangle {
        a: [20.0, 20.5],
        b: [1e-9, 1e-3],
    });
    let all = rectangles.iter().flat_map(|at| parts(&code, at)).flatten();
    let all: Vec<(Rectangle, Formula)> = all.collect();
    let bounds = all
        .iter()
        .map(|(at, f)| bound(&code.tables, *f, at, Rounding::default()));
    let bounds: Vec<_> = bounds.collect();
    let norms = bounds.iter().flatten().map(|b| b.norm);
    let kept = code.tables.scaled.lock().expect("no panic").len();
    let mut names: Vec<&str> = all.iter().map(|(_, f)| f.name()).collect();
    names.sort_unstable();
    names.dedup();
    let found = [
        counted("names", names),
        (
            "bounds",
            crate::pinned::digest(&bounds),
            norms.fold(0.0, f64::max),
        ),
        ("kept", 0, kept as f64),
    ];
    let due = [
        ("names", 0x5db1b567a4d103ca, 13.0),
        ("bounds", 0xbdf4a84d764e4056, 1.2359560045701776),
        ("kept", 0x0000000000000000, 2.0),
    ];
    bit_by_bit(&found, &due);
}
