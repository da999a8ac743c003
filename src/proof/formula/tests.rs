use super::*;
use crate::code::Code;
use crate::pinned::{bit_by_bit, counted, largest, of_binades, units};
use mechaudit_solvers::faddeeva::faddeeva;
use num_complex::Complex;
use std::sync::LazyLock;

static TABLES: LazyLock<Tables> = LazyLock::new(|| Code::of_the_solver().expect("decided").tables);

fn near(x: f64, due: f64) -> bool {
    x >= due * (1.0 - 1e-12) && x <= due * (1.0 + 1e-9)
}

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

/// A component's error in units in the last place of its least value.
#[test]
fn components_in_units_of_their_least_value() {
    let u = 2f64.powi(-52);
    let of = |r: &Tracks, truncated: f64, norm: f64| {
        component(r, truncated, norm, Interval::new(0.25, 0.5))
    };
    let (units, least) = of(&part(1.5, 1.75, u), 0.0, 0.0);
    assert!(near(units, 1.0) && near(least, 1.5));
    // The truncation is taken from the value and added to the error; the better of both bounds
    // serves.
    let (units, least) = of(&part(1.5, 1.75, u), 0.6, 0.9);
    assert!(near(units, (0.6 + u) * 2.0 / u) && near(least, 0.9));
    let (units, _) = of(&part(1.5, 1.75, u), 0.6, u);
    assert!(near(units, 2.0));
    let negative = part(-1.75, -1.5, u);
    assert!(near(of(&negative, 0.0, 0.0).0, 1.0));
    // A value that may be zero has no bound, unless it is zero.
    assert_eq!(of(&part(-1.0, 1.0, u), 0.0, 0.0).0, f64::INFINITY);
    assert_eq!(of(&part(0.5, 1.0, u), 0.5, 1.0).0, f64::INFINITY);
    assert_eq!(
        of(&part(0.5, 1.0, f64::INFINITY), 0.0, 0.0).0,
        f64::INFINITY
    );
    assert_eq!(of(&part(0.0, 0.0, 0.0), 0.5, 1.0), (0.0, f64::INFINITY));
    assert_eq!(of(&part(0.0, 0.0, u), 0.0, 1.0).0, f64::INFINITY);
    assert!(of(&part(1.0, 1.0, 0.0), 0.5, 1.0).0 > 1e14);
    // Below one unit of the normal numbers as well.
    let (units, _) = of(&part(0.26, 0.5, 0.25 * u), 0.0, 0.0);
    assert!(near(units, 1.0));
    let (units, _) = of(&part(1e-310, 2e-310, f64::from_bits(1)), 0.0, 0.0);
    assert!(near(units, 1.0));
    // Beside the factor σ: a part of the value is at most as many units of 2⁻⁵³, or by the least
    // value.
    let small = Tracks {
        small: true,
        ..part(1.5, 1.75, u)
    };
    let (units, least) = of(&small, 0.0, 0.0);
    assert!(near(least, 0.375) && near(units, 2.0 / 1.5));
    let (units, _) = component(&small, 0.0, 0.0, Interval::new(0.5, 0.5));
    assert!(near(units, 1.0));
    let (units, least) = component(&small, 0.0, 0.0, Interval::new(0.0, 0.5));
    assert!(near(units, 2.0 / 1.5) && least == 0.0);
    // The bound of the absolute value does not serve there.
    assert!(near(of(&small, 0.1, 0.0).0, 2.0 * (0.1 + u) / 1.4 / u));
}

/// Sums `y u + E`, E left out or added.
#[test]
fn sums_of_two_positive_terms() {
    let t = OfSum {
        slope: 0.01,
        exponential: 0.02,
        most: 0.001,
        least: 0.5,
    };
    let sigma = Interval::new(0.25, 0.5);
    let mut r = part(2.0, 3.0, 0.03);
    (r.small, r.relative) = (true, 0.001);
    // E/y and |u − U|, and rounding as a part or by its size.
    let left = 0.001 / 0.25 + 0.01;
    let (units, least) = of_sum(&r, &t, sigma);
    let size = 2.0 - left;
    assert!(near(units, (0.003 + left) / size * 2.0 * TWO_52) && near(least, size * 0.25));
    r.relative = 1.0;
    assert!(near(
        of_sum(&r, &t, sigma).0,
        (0.03 + left) / size * 2.0 * TWO_52
    ));
    // Nothing left of it, or a y that may be zero: no bound.
    for lo in [left, 0.0, -1.0] {
        let none = Tracks {
            exact: Interval::new(lo, 3.0),
            ..r
        };
        assert_eq!(of_sum(&none, &t, sigma).0, f64::INFINITY, "{lo}");
    }
    assert_eq!(of_sum(&r, &t, Interval::new(0.0, 0.5)).0, f64::INFINITY);
    // Both terms: no larger a part than one of them.
    (r.small, r.relative) = (false, 0.001);
    let part = |slope: f64, exponential: f64| {
        let worst = f64::max(slope / (0.5 - slope), exponential);
        (0.001 * (1.0 + worst) + worst) * 2.0 * TWO_52
    };
    let (units, least) = of_sum(&r, &t, sigma);
    assert!(near(units, part(0.01, 0.02)) && near(least, 2.0 * 0.99));
    let other = OfSum { slope: 0.1, ..t };
    assert!(near(of_sum(&r, &other, sigma).0, part(0.1, 0.02)));
    let none = OfSum { slope: 0.5, ..t };
    assert_eq!(of_sum(&r, &none, sigma).0, f64::INFINITY);
    let negative = Tracks {
        exact: Interval::new(-1.0, 3.0),
        ..r
    };
    assert_eq!(of_sum(&negative, &t, sigma).1, 0.0);
}

/// The norm from both components, the truncation, and what underflows.
#[test]
fn norms_from_components() {
    let of = |parts: [Tracks; 2], truncation: Truncation| {
        Evaluated { parts, truncation }.bound(Interval::new(0.25, 0.5))
    };
    let u = 1.0 / TWO_52;
    let both = [part(3.0, 3.5, 3.0 * u), part(-4.5, -4.0, 4.0 * u)];
    let found = of(both, NONE);
    assert!(
        near(found.norm, 1.0) && near(found.re, 1.5) && near(found.im, 2.0) && found.tiny == 0.0
    );
    let cut = Truncation {
        norm: 1.0,
        re: 1.0,
        im: 0.5,
        ..NONE
    };
    let found = of(both, cut);
    assert!(near(found.norm, (5.0 * u + 1.0) / 4.0 / u));
    assert!(
        near(found.re, 0.5 * (3.0 + 1.0 / u)) || near(found.re, 1.0 / u + 3.0),
        "{found:?}"
    );
    // A factor σ of one of them, from its least and its largest.
    let small = [
        Tracks {
            small: true,
            ..both[0]
        },
        both[1],
    ];
    let found = of(small, NONE);
    let due = f64::hypot(1.5, 4.0) / f64::hypot(0.75, 4.0);
    assert!(near(found.norm, due), "{found:?}");
    // Far above underflow what is lost is a part of a unit; beside it, it is told apart.
    let lost = |scale: f64, tiny: f64| {
        let part = |r: &Tracks| Tracks {
            exact: Interval::new(r.exact.lo * scale, r.exact.hi * scale),
            error: r.error * scale,
            tiny,
            ..*r
        };
        of([part(&both[0]), part(&both[1])], NONE)
    };
    let (above, below) = (2.0 * FAR_ABOVE, 0.125 * FAR_ABOVE);
    let found = lost(above, 1e16);
    let more = 2e16 * TINIEST / (5.0 * above) * TWO_52;
    assert!(
        found.tiny == 0.0 && near(found.norm, 1.0 + more),
        "{found:?} {more}"
    );
    let found = lost(below, 7.0);
    assert!(found.tiny == 7.0 && near(found.re, 1.5), "{found:?}");
    assert!(near(
        lost_units(2f64.powi(40), 1.5),
        2f64.powi(40) * TINIEST / u
    ));
    let sum = Some(OfSum {
        slope: 0.0,
        exponential: 0.0,
        most: 0.0,
        least: 1.0,
    });
    let with_sum = |scale: f64| {
        let mut re = part(3.0 * scale, 3.5 * scale, 0.0);
        (re.relative, re.tiny) = (u, 1e16);
        of([re, part(1.0, 1.0, 0.0)], Truncation { sum, ..NONE })
    };
    assert!(with_sum(FAR_ABOVE).tiny == 0.0 && with_sum(FAR_ABOVE).re > 2.0);
    assert!(with_sum(0.1 * FAR_ABOVE).tiny == 1e16 && near(with_sum(0.1 * FAR_ABOVE).re, 2.0));
    // A value that may be zero has no bound.
    assert_eq!(
        of([part(-1.0, 1.0, u), part(-1.0, 1.0, u)], NONE).norm,
        f64::INFINITY
    );
    let worst = found.max(Bound {
        norm: 9.0,
        re: 0.0,
        im: 9.0,
        tiny: 0.0,
    });
    assert_eq!(
        [worst.norm, worst.re, worst.im, worst.tiny],
        [9.0, found.re, 9.0, found.tiny]
    );
}

/// Which formula has a row, which coordinate is a factor, and which terms serve on the axis.
#[test]
fn formulas_and_their_rows() {
    let centre = (1.5, 2.0);
    assert_eq!(Formula::Cell { centre }.centre(), Some(centre));
    let (re, im) = (
        Formula::RealAxis { centre: 3.0 },
        Formula::ImaginaryAxis { centre: 2.5 },
    );
    assert_eq!(
        [re.centre(), im.centre()],
        [Some((3.0, 0.0)), Some((0.0, 2.5))]
    );
    assert_eq!(Formula::Strip.centre(), None);
    let on_axis = |terms| Formula::of(Branch::Asymptotic { terms }, true);
    for (terms, due) in [(26, 26), (14, 14), (6, 6), (4, 6), (2, 6)] {
        assert_eq!(
            on_axis(terms),
            Some(Formula::AsymptoticOnAxis { terms: due })
        );
    }
    let square = Rectangle {
        a: [8.0, 8.1],
        b: [9.0, 9.1],
    };
    let narrow = Rectangle {
        a: [8.0, 8.1],
        b: [1e-9, 1.0],
    };
    let at = |formula| small(formula, &square);
    assert_eq!(at(Formula::Cell { centre: (0.0, 3.0) }), [true, false]);
    assert_eq!(at(Formula::Cell { centre }), [false, false]);
    assert_eq!(at(Formula::Maclaurin { terms: 9 }), [true, false]);
    let series = Formula::Asymptotic { terms: 6 };
    assert_eq!(
        [at(series), small(series, &narrow)],
        [[false, false], [false, true]]
    );
    assert_eq!(
        [at(Formula::Strip), at(Formula::RealLine)],
        [[false, true]; 2]
    );
    let others = [
        re,
        im,
        Formula::MaclaurinOnAxis,
        Formula::AsymptoticOnAxis { terms: 6 },
    ];
    assert_eq!(others.map(at), [[false, false]; 4]);
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

/// Checks what a formula leaves out, by its terms and at its farthest point.
#[test]
fn truncations_of_formulas() {
    let of = |formula, a, b| {
        let at = Rectangle { a, b };
        run(&TABLES, formula, &at, Rounding::default())
            .expect("a value")
            .1
    };
    let near = |x: f64, due: f64| x >= due && x <= due * (1.0 + 1e-12);
    let far = [0.4, 0.43];
    let found = of(Formula::MaclaurinOnAxis, [0.0; 2], far);
    assert_eq!(found.norm, truncation::maclaurin(8, 0.43).norm);
    let size = f64::hypot(0.1, 0.43);
    for terms in [9, 21] {
        let found = of(Formula::Maclaurin { terms }, [0.05, 0.1], far);
        assert!(near(
            found.norm,
            truncation::maclaurin(terms - 1, size).norm
        ));
    }
    // Off the imaginary axis a cell's components have no better bound than the norm.
    let found = of(
        Formula::Cell { centre: (1.5, 1.5) },
        [1.53, 1.54],
        [1.55, 1.56],
    );
    assert_eq!(found.im, found.norm);
    let found = of(
        Formula::Cell { centre: (0.0, 3.0) },
        [1e-3, 0.1],
        [3.05, 3.06],
    );
    let (_, errors) = TABLES.cell((0.0, 3.0)).expect("a row");
    let within = errors.within(0.1, 3.06 - 3.0);
    assert!(found.im == within.im && found.norm == within.norm && found.im != found.norm);
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
    tables.change_cell(centre, |row| {
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

/// Bounds from results of every kind, and where a limit is met exactly.
#[test]
fn parts_of_bounds_bit_by_bit() {
    let tiny = f64::from_bits(1);
    let sigmas = [
        [0.0, 0.0],
        [0.0, 0.5],
        [0.25, 0.5],
        [1e-300, 1e-290],
        [FAR_ABOVE, 1.0],
    ];
    let sigmas = sigmas.map(|[lo, hi]| Interval::new(lo, hi));
    let u = power_of_two(-52);
    let mut results = Vec::new();
    for (lo, hi) in [
        (1.5, 1.75),
        (0.0, 0.0),
        (0.0, 1.0),
        (-1.0, 0.5),
        (tiny, 1.0),
        (f64::from_bits(2), 1.0),
        (FAR_ABOVE, 1.0),
        (FAR_ABOVE.next_up(), 1.0),
        (1.0, 1.5),
        (1f64.next_up(), 1.5),
        (1e-310, 1e-305),
    ] {
        for error in [0.0, u, 0.1] {
            for small in [false, true] {
                for t in [0.0, 3.0] {
                    results.push(Tracks {
                        tiny: t,
                        small,
                        relative: error * 0.75,
                        ..part(lo, hi, error)
                    });
                }
            }
        }
    }
    let sum = |slope: f64, exponential: f64, most: f64| OfSum {
        slope,
        exponential,
        most,
        least: 0.5,
    };
    let sums = [
        sum(0.0, 0.0, 0.0),
        sum(1e-20, 1e-18, 1e-17),
        sum(tiny, 0.0, 0.0),
        sum(0.75, f64::INFINITY, 1.0),
        sum(1e-17, f64::INFINITY, 0.0),
    ];
    let truncations = [
        NONE,
        Truncation {
            norm: 1e-18,
            re: 1e-17,
            im: 1e-16,
            tiny: 2.0,
            sum: None,
        },
    ];
    let (mut components, mut of_sums, mut bounds) = (Vec::new(), Vec::new(), Vec::new());
    for (i, re) in results.iter().enumerate() {
        for sigma in sigmas {
            components.extend([0.0, 1e-17, 0.5, 2.0].map(|t| component(re, t, 0.75 * t, sigma)));
            of_sums.extend(sums.map(|t| of_sum(re, &t, sigma)));
            for (k, mut truncation) in truncations.into_iter().enumerate() {
                let im = results[(7 * i + 31 * k) % results.len()];
                for sum in [None, Some(sums[(i + k) % sums.len()])] {
                    truncation.sum = sum;
                    let parts = [*re, im];
                    bounds.push(Evaluated { parts, truncation }.bound(sigma));
                }
            }
        }
    }
    let known = bounds.iter().filter(|b| b.norm.is_finite()).count();
    let lost = [FAR_ABOVE, 1.0, 1.5, 2.0]
        .iter()
        .flat_map(|l| [0.0, 1.0, 1e60].map(|t| lost_units(t, *l)));
    let found = [
        counted("components", components),
        counted("sums", of_sums),
        ("bounds", crate::pinned::digest(&bounds), known as f64),
        largest("lost", lost),
    ];
    let due = [
        ("components", 0x1004e16363b760d3, 2640.0),
        ("sums", 0x0fa1cd3638d97907, 3300.0),
        ("bounds", 0x00f535e82e99198f, 1330.0),
        ("lost", 0xbf118e36efc990ef, 2.1684043449710095e41),
    ];
    bit_by_bit(&found, &due);
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
        ("bounds", 0xe43ad7215f868b79, 1.769563358723438),
        ("kept", 0x0000000000000000, 2.0),
    ];
    bit_by_bit(&found, &due);
}
