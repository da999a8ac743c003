//! The estimates by which the nearest position is proved.

use super::super::tests::*;
use super::super::*;
use super::tests::*;
use super::*;
use num_complex::Complex64;

/// A system of two pins with what the estimates make of it, by products of whole matrices.
#[test]
fn estimates_are_those_of_the_matrices() {
    let j: [[f64; 4]; 4] = [
        [0.9, 0.2, -0.1, 0.3],
        [0.1, 1.1, 0.2, -0.2],
        [-0.3, 0.1, 0.8, 0.4],
        [0.2, -0.1, 0.3, 1.2],
    ];
    let mut random = Random(31);
    let matrix = |of: &dyn Fn(usize, usize) -> f64| {
        let mut m = Matrix::new(4, 5);
        for (r, c) in (0..16).map(|k| (k / 4, k % 4)) {
            m[(r, c)] = of(r, c);
        }
        m
    };
    for off in [0.0, 0.02] {
        let other = std::array::from_fn::<f64, 16, _>(|_| random.between(-off, off));
        let at = matrix(&|r, c| j[r][c] + other[4 * r + c]);
        let mut factors = Factors::default();
        assert!(factors.of(&matrix(&|r, c| j[r][c]), 4, 0));
        let inverse: Vec<Vec<f64>> = (0..4)
            .map(|r| {
                let mut column = vec![0.0; 4];
                factors.solve(|k| f64::from(u8::from(k == r)), &mut column);
                column
            })
            .collect();
        let times = |i: usize, of: &dyn Fn(usize) -> f64| -> f64 {
            (0..4).map(|r| inverse[r][i] * of(r)).sum()
        };
        let turned = |r: usize, c: usize| match r % 2 {
            0 => -at[(r + 1, c)],
            _ => at[(r - 1, c)],
        };
        let residual = [0.3, -0.2, 0.5, 0.1];
        let most = |of: &dyn Fn(usize) -> f64| (0..4).map(of).fold(0.0, f64::max);
        for rounding in [0.0, 0.01] {
            let all = Estimate::new(&at, &factors, &residual, rounding);
            let size = |i: usize| (0..4).map(|r| inverse[r][i].abs()).sum::<f64>();
            let unit = |i: usize, c: usize| f64::from(u8::from(i == c));
            let defect = most(&|i| {
                let row = (0..4).map(|c| (unit(i, c) - times(i, &|r| at[(r, c)])).abs());
                row.sum::<f64>() + 4.0 * size(i) * rounding
            });
            let bend = most(&|i| {
                let row = (0..4).map(|c| times(i, &|r| turned(r, c)).abs());
                row.sum::<f64>() + 4.0 * size(i) * rounding
            });
            let correction = most(&|i| {
                let row = (0..4).map(|r| (inverse[r][i] * residual[r]).abs());
                row.sum::<f64>() + size(i) * rounding
            });
            for (x, due) in [
                (all.defect, defect),
                (all.bend, bend),
                (all.correction, correction),
            ] {
                assert!(
                    (x - due).abs() < 1e-14 * (1.0 + due),
                    "{off} {rounding}: {x} {due}"
                );
            }
            assert!(all.defect > 0.9 * off + 0.9 * rounding);
        }
    }
    let some = Estimate {
        defect: 0.125,
        bend: 3.0,
        correction: 7.0,
    };
    assert_eq!(some.norm(0.25, 0.5), 0.125 + 0.75 + 0.03125 + 0.5);
}

/// `‖I − A M‖` of columns turned and shortened as far as the estimate allows: never more than it,
/// and nearly as much.
#[test]
fn turned_columns_are_within_the_estimate() {
    let mut random = Random(32);
    let mut closest = 0.0f64;
    for m in some_linkages(&mut random) {
        let phi = random.between(-3.0, 3.0);
        for state in m.assembly_modes(phi).states {
            let n = m.chain.unknowns;
            let (turn, short) = (random.between(0.0, 0.2), random.between(0.0, 0.01));
            let at = Estimate::new(&state.jacobian, &state.factors, &vec![0.0; n], 0.0);
            // Signs of the turns that add up in the row that bends most.
            for _ in 0..20 {
                let turns: Vec<(f64, f64)> = (0..n)
                    .map(|_| {
                        (
                            turn * random.between(-1.0, 1.0).signum(),
                            1.0 - short * random.between(0.0, 1.0),
                        )
                    })
                    .collect();
                let mut sums = vec![0.0; n];
                for (k, (turn, length)) in turns.into_iter().enumerate() {
                    let (s, c) = (turn.sin() * length, turn.cos() * length);
                    let right = |r: usize| {
                        let j = |r: usize| state.jacobian[(r, k)];
                        match r % 2 {
                            0 => c * j(r) - s * j(r + 1),
                            _ => c * j(r) + s * j(r - 1),
                        }
                    };
                    let mut column = vec![0.0; n];
                    state.factors.solve(right, &mut column);
                    for (i, (sum, x)) in sums.iter_mut().zip(column).enumerate() {
                        *sum += (x - f64::from(u8::from(i == k))).abs();
                    }
                }
                let norm = sums.into_iter().fold(0.0, f64::max);
                let bound = at.norm(turn, short);
                assert!(norm <= bound * (1.0 + 1e-12), "{norm} {bound}");
                closest = closest.max(norm / bound);
            }
        }
    }
    assert!(closest > 0.99, "{closest}");
}

/// Poses off a position by a known distance: the bound holds it and is at most five times as large;
/// where the estimate does not contract there is none.
#[test]
fn errors_of_positions_are_bounded() {
    let mut random = Random(33);
    let (mut bounded, mut none) = (0, 0);
    for m in some_linkages(&mut random) {
        let phi = random.between(-3.0, 3.0);
        for exact in m.assembly_modes(phi).states {
            let chain = &m.chain;
            let mut work = Work::new(chain);
            // Of the rounding alone.
            let least = chain.error_of(&exact, &mut work);
            let sizes = (0..30).map(|k| 0.02 * 1.1f64.powi(k));
            for size in [1e-12, 1e-9, 1e-6, 1e-4].into_iter().chain(sizes) {
                let by: Vec<f64> = (0..chain.unknowns)
                    .map(|_| random.between(-size, size))
                    .collect();
                let u = exact.pose.u.iter().zip(&by).map(|(u, d)| u + d).collect();
                let mut off = exact.clone();
                off.pose = Pose::new(chain, exact.pose.drive, u);
                if !off.update(chain, &mut work) {
                    continue;
                }
                let distance = by.iter().fold(0.0f64, |d, x| d.max(x.abs()));
                off.pose
                    .residual(chain, &chain.closures, &mut work.residual);
                let rounding = chain.rounding(&off.pose);
                let at = Estimate::new(&off.jacobian, &off.factors, &work.residual, rounding);
                let radius = 4.0 * at.correction;
                let norm = at.norm(radius, radius * radius / 6.0);
                match chain.error_of(&off, &mut Work::new(chain)) {
                    Some(bound) => {
                        bounded += 1;
                        assert!(norm <= 0.5 && distance <= bound + least.unwrap_or(0.0));
                        assert_eq!(bound, radius);
                    }
                    None => {
                        none += 1;
                        assert!(!(norm <= 0.5), "{norm}");
                    }
                }
            }
        }
    }
    println!("{bounded} bounded, {none} not");
    assert!(bounded > 300 && none > 50);
}

/// 16 u for each body and unit of length, the coordinates of joints among them.
#[test]
fn rounding_grows_with_bodies_and_extent() {
    let unit = 16.0 * f64::EPSILON;
    let m = four_bar([0.125, 0.5, 0.5, 0.5]);
    // In units of 0.5 m: the coupler's origin 0.25 off, the rocker's no farther than one.
    let pose = m.assembly_modes(0.0).states[0].pose.clone();
    let farthest = pose.p.iter().fold(0.0f64, |d, p| d.max(p.norm()));
    assert_eq!(farthest, 1.0);
    assert_eq!(m.chain.rounding(&pose), unit * 4.0 * 4.0);
    assert_eq!(m.chain.body_count(), 4);
}

/// A single pin: told open where its gap is more than its two arms close by turns within reach, and
/// rounding.
#[test]
fn gaps_are_open_beyond_reach() {
    let m = four_bar([0.125, 0.5, 0.5, 0.75]);
    let chain = &m.chain;
    let mut work = Work::new(chain);
    let near = [0.0, 0.3, -0.4];
    let given = Pose::new(chain, 0.0, chain.unknowns_at(0.0, &near));
    let mut rows = Vec::new();
    given.residual(chain, &chain.closures, &mut rows);
    let gap = rows[0].hypot(rows[1]);
    let rounding = chain.rounding(&given);
    // Coupler and rocker, a unit each.
    let arms = 2.0 + 2.0 * rounding;
    for (share, open) in [
        (1.0 - 1.3e-9, true),
        (1.0 - 0.7e-9, false),
        (1.0 + 1e-9, false),
    ] {
        let reach = gap / arms * share;
        assert_eq!(
            chain.is_open(&given, &near, reach, &mut work),
            open,
            "{share}"
        );
    }
    // Without reach rounding alone decides.
    for (share, open) in [(1.9, false), (2.1, true)] {
        let exact = m.assembly_modes(0.0).states[0].clone();
        let mut pose = exact.pose.clone();
        let rounding = chain.rounding(&pose);
        let Closure::Pin { a, .. } = chain.closures[0] else {
            unreachable!()
        };
        pose.p[a.body] += Complex64::new(0.6, 0.8) * (share * rounding);
        pose.residual(chain, &chain.closures, &mut rows);
        let own = rows[0].hypot(rows[1]);
        assert!((own / rounding - share).abs() < 0.05, "{own}");
        let near = placed(&m, &exact);
        assert_eq!(chain.is_open(&pose, &near, 0.0, &mut work), open, "{share}");
    }
    // The crank's angle is the drive's.
    for (by, open) in [(0.05, false), (-0.05, false), (0.2, true), (-0.2, true)] {
        let exact = m.assembly_modes(0.0).states[0].clone();
        let mut near = placed(&m, &exact);
        near[0] += by;
        assert_eq!(chain.is_open(&exact.pose, &near, 0.1, &mut work), open);
    }
}

/// One of two loops that cannot be closed is enough.
#[test]
fn one_open_pin_is_enough() {
    let mut d = Description::new();
    let [crank, a, b, c, e] = ["crank", "a", "b", "c", "e"].map(|n| d.body(n));
    d.pin("O", &[(GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])]);
    d.pin(
        "A",
        &[(crank, [0.1, 0.0]), (a, [0.0, 0.0]), (c, [0.0, 0.0])],
    );
    d.pin("B", &[(a, [0.4, 0.0]), (b, [0.3, 0.0])]);
    d.pin("C", &[(GROUND, [0.35, 0.0]), (b, [0.0, 0.0])]);
    d.pin("D", &[(c, [0.2, 0.0]), (e, [0.1, 0.0])]);
    d.pin("E", &[(GROUND, [0.9, 0.0]), (e, [0.0, 0.0])]);
    let m = Mechanism::new(d).unwrap();
    let first = four_bar([0.1, 0.4, 0.3, 0.35]);
    let closed = placed(&first, &first.assembly_modes(0.5).states[0]);
    let near = [&closed[..], &[0.0, 0.0]].concat();
    assert!(matches!(m.nearest_by_newton(0.5, &near, 0.1), Way::None));
    let told = m.nearest(0.5, &angles(&near), Angle::from_rad(0.1));
    assert_eq!(told.unwrap_err(), NearestError::NoneWithin { reach: 0.1 });
}

/// Alone exactly where the norm at the middle, with half the distance, is below 0.95: on both sides
/// of that.
#[test]
fn positions_are_alone_within_the_estimate() {
    let mut random = Random(35);
    let mut far = 0;
    for m in some_linkages(&mut random) {
        let phi = random.between(-3.0, 3.0);
        let chain = &m.chain;
        for found in m.assembly_modes(phi).states {
            let moved = found.pose.u.iter().map(|u| u + random.between(-0.05, 0.05));
            let given = Pose::new(chain, found.pose.drive, moved.collect());
            let middle = given
                .u
                .iter()
                .zip(&found.pose.u)
                .map(|(a, b)| 0.5 * (a + b));
            let middle = Pose::new(chain, given.drive, middle.collect());
            let (mut j, mut factors) = (Work::new(chain).jacobian, Factors::default());
            middle.jacobian(chain, 0..chain.closures.len(), &mut j);
            let blocks = chain.blocks.iter().map(|b| b.rows.clone());
            assert!(factors.of_blocks(&j, 0, blocks));
            let nothing = vec![0.0; chain.unknowns];
            let at = Estimate::new(&j, &factors, &nothing, chain.rounding(&middle));
            let norm = |d: f64| at.norm(0.5 * d, d * d / 6.0);
            let (mut low, mut high) = (0.0, 4.0);
            for _ in 0..60 {
                let half = 0.5 * (low + high);
                (low, high) = if norm(half) < 0.95 {
                    (half, high)
                } else {
                    (low, half)
                };
            }
            far += usize::from(low > 0.3);
            let alone = |d: f64| chain.is_alone(&given, &found.pose, d, &mut Work::new(chain));
            assert!(alone(0.999 * low) || low == 0.0);
            assert!(!alone(1.001 * low + 1e-12));
        }
    }
    assert!(far > 20, "{far}");
    // Coupler and rocker on one line at the middle: no inverse.
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let state = &m.assembly_modes(0.3).states[0];
    let folded = Pose::new(&m.chain, 0.3, vec![0.0; m.chain.unknowns]);
    assert!(
        !m.chain
            .is_alone(&folded, &folded, 0.0, &mut Work::new(&m.chain))
    );
    let alone = m
        .chain
        .is_alone(&state.pose, &state.pose, 0.0, &mut Work::new(&m.chain));
    assert!(alone);
}

/// The error counts twice beside the distance, that of the position found and that of the exact
/// one, and once on either side of the reach.
#[test]
fn errors_of_both_positions_count() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let chain = &m.chain;
    let state = &m.assembly_modes(1.0).states[0];
    let mut work = Work::new(chain);
    let (mut low, mut high) = (0.0, 4.0);
    for _ in 0..60 {
        let half = 0.5 * (low + high);
        (low, high) = match chain.is_alone(&state.pose, &state.pose, half, &mut work) {
            true => (half, high),
            false => (low, half),
        };
    }
    let mut told =
        |off: [f64; 2], reach| chain.told(&state.pose, state.clone(), off, reach, &mut work);
    let off = 0.5 * low;
    assert!(told([off, 0.249 * low], 4.0).is_some());
    assert!(told([off, 0.251 * low], 4.0).is_none());
    for (reach, way) in [
        (1.11, "found"),
        (1.09, "open"),
        (0.91, "open"),
        (0.89, "none"),
    ] {
        let found = told([off, 0.1 * off], reach * off).unwrap();
        let name = match found {
            Way::Found(_) => "found",
            Way::None => "none",
            Way::Unknown => "open",
        };
        assert_eq!(name, way, "{reach}");
    }
    // As far as the reach with the error is within it.
    let unit = 2f64.powi(-7);
    for (off, within) in [(2.0, true), (4.0, false)] {
        let found = told([off * unit, unit], 3.0 * unit).unwrap();
        assert_eq!(matches!(found, Way::Found(_)), within);
        assert_eq!(matches!(found, Way::Unknown), !within);
    }
}
