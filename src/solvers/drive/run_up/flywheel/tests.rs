//! The search for a flywheel, on fluctuations that are known functions of its inertia.

use super::*;

/// Returns what a bare machine of 2 kg·m² has at 3 rad/s.
fn cycle(fluctuation: f64) -> Cycle {
    Cycle {
        psi: 3.0,
        period: 2.0,
        mean: 3.0,
        least: (3.0, 0.0),
        most: (3.0, 0.0),
        fluctuation,
        multiplier: 0.5,
        work: [0.0; 3],
        kinetic_energy: 9.0,
        mismatch: 0.0,
        iterations: 1,
        counts: Counts::default(),
    }
}

/// A first trial, kg·m².
const FIRST: f64 = 1e-4 * 2.0;

/// Returns what is found, and what was tried for it.
fn searched(
    wanted: f64,
    fluctuation: impl Fn(f64) -> f64,
) -> (Result<(f64, Cycle), FlywheelError>, Vec<f64>) {
    let mut tried = Vec::new();
    let found = search(wanted, &mut |inertia| {
        tried.push(inertia);
        Ok(cycle(fluctuation(inertia)))
    });
    (found, tried)
}

#[test]
fn an_even_machine_needs_none() {
    let (found, tried) = searched(0.5, |_| 0.5);
    assert_eq!((found, tried), (Ok((0.0, cycle(0.5))), vec![0.0]));
}

#[test]
fn the_size_is_doubled_until_it_is_enough() {
    // Enough, to the last bit, after three doublings: the search between two sizes tries it again.
    let enough = 8.0 * FIRST;
    let (found, tried) = searched(0.5, |i| if i < enough { 1.0 } else { 0.5 });
    assert_eq!(found, Ok((enough, cycle(0.5))));
    let doubled = [1.0, 2.0, 4.0, 8.0].map(|k| k * FIRST);
    assert_eq!(tried, [&[0.0][..], &doubled, &[enough]].concat());
    // Enough with the first.
    let (found, tried) = searched(0.5, |i| if i < FIRST { 1.0 } else { 0.5 });
    assert_eq!(found, Ok((FIRST, cycle(0.5))));
    assert_eq!(tried, [0.0, FIRST, FIRST]);
}

#[test]
fn no_size_is_enough() {
    let (found, tried) = searched(0.5, |_| 0.75);
    let inertia = FIRST * 2.0f64.powi(45);
    let due = FlywheelError::NotFound {
        inertia,
        wanted: 0.5,
        found: 0.75,
    };
    assert_eq!(found, Err(due));
    assert_eq!((tried.len(), tried.last()), (47, Some(&inertia)));
}

/// Straight in the logarithm: the first size between the two is the one.
#[test]
fn a_straight_line_needs_one_size_between() {
    let wanted = 0.25f64;
    let (found, tried) = searched(wanted, |i| wanted * (2.0 - i / (3.0 * FIRST)).exp2());
    let (inertia, cycle) = found.unwrap();
    assert!((inertia / (6.0 * FIRST) - 1.0).abs() < 1e-14, "{inertia}");
    assert!((cycle.fluctuation / wanted - 1.0).abs() < 1e-14);
    assert_eq!(tried.len(), 6);
    assert_eq!(tried[4], 8.0 * FIRST);
    // Less than the first trial, from the machine as it is on.
    let (found, tried) = searched(wanted, |i| wanted * (0.75 - i / FIRST).exp2());
    let (inertia, _) = found.unwrap();
    assert!((inertia / (0.75 * FIRST) - 1.0).abs() < 1e-14, "{inertia}");
    assert_eq!(tried.len(), 3);
}

/// Bent either way: where one end stays, its excess is halved, so that it does not stay for long.
#[test]
fn bent_lines_need_few_sizes() {
    let wanted = 0.25f64;
    let at = 5.5 * FIRST;
    type Line = fn(f64) -> f64;
    let lines: [(Line, usize); 4] = [
        (|x| (1.0 / (x * x)).ln(), 5),
        (|x| 3.0 * (1.0 - x.powi(6)), 8),
        (|x| (x.powi(-9) - 1.0).min(50.0), 11),
        (|x| (1.0 - x).cbrt(), 40),
    ];
    for (line, sizes) in lines {
        let (found, tried) = searched(wanted, |i| wanted * line((i / at).max(1e-3)).exp());
        let (inertia, cycle) = found.unwrap();
        assert!((cycle.fluctuation / wanted).ln().abs() <= 1.1e-6);
        assert!((inertia / at - 1.0).abs() < 1e-6);
        assert_eq!(tried.len() - 5, sizes, "{tried:?}");
    }
}

/// A jump over the wanted fluctuation is closed in to neighbouring numbers.
#[test]
fn a_jump_is_closed_in() {
    let at = 5.3 * FIRST;
    for e in [1.0f64, 0.25] {
        let (found, tried) = searched(0.5, |i| 0.5 * if i < at { e } else { -e }.exp());
        let (inertia, _) = found.unwrap();
        assert!((inertia - at).abs() <= at * f64::EPSILON, "{inertia}");
        assert_eq!(tried.len() - 5, 60);
    }
}
