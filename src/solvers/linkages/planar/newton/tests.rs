//! Describes what is promised of Newton's iteration: when it ends, how far it goes, and by which
//! factors.

use super::super::State;
use super::super::tests::*;
use super::*;

const EPS: f64 = f64::EPSILON;

/// Below four units of rounding, or where small corrections no longer halve.
#[test]
fn iterations_end_where_corrections_are_rounding() {
    let done = |size: f64, last: f64| after(size, last, true) == After::Done;
    assert!(done(4.0 * EPS, f64::INFINITY) && done(0.0, f64::INFINITY));
    assert!(!done((4.0 * EPS).next_up(), f64::INFINITY));
    assert!(done(1e-12, 2e-12) && !done(1e-12, 2e-12f64.next_up()));
    assert!(!done(1e-12f64.next_up(), 2e-12) && done(1e-14, 1e-14));
}

/// Beyond ten radians or units of length, and where the correction is no number.
#[test]
fn iterations_are_lost_where_corrections_are_large() {
    for fresh in [true, false] {
        assert_ne!(after(10.0, 20.0, fresh), After::Lost);
        for size in [10.0f64.next_up(), f64::INFINITY, f64::NAN] {
            assert_eq!(after(size, 1.0, fresh), After::Lost);
        }
    }
}

/// Factors serve again after a small correction of their own, and as long as each gains two digits.
#[test]
fn factors_serve_while_they_gain_two_digits() {
    let serves = |size: f64, last: f64, fresh: bool| {
        after(size, last, fresh) == After::Another { fresh: false }
    };
    assert!(serves(1e-5, 1.0, true) && serves(1e-5, 2e-5, true));
    assert!(!serves(1e-5f64.next_up(), 1.0, true));
    let gained = 1e-2 * 1e-5;
    assert!(serves(gained, 1e-5, false) && !serves(gained.next_up(), 1e-5, false));
    assert!(!serves(1e-4, 1.0, false));
    assert!(serves(0.9e-12, 0.9e-10, false));
}

#[test]
fn corrections_that_leave_nothing() {
    // Half a unit of the last place of an angle between a quarter and a half.
    let half = 0.25 * EPS;
    assert!(done_by_share(0.5, 2.0 * half) && !done_by_share(0.5, 2.1 * half));
    assert!(done_by_share(8.0, 0.125 * half) && !done_by_share(8.0, 0.13 * half));
    assert!(!done_by_share(f64::NAN, 0.0));
    // ½ · (2⁻²⁶)² = 2⁻⁵³ is twice of it.
    let size = 2f64.powi(-27);
    assert!(done_by_curvature(1.0, size) && !done_by_curvature(1.0, size.next_up()));
    assert!(done_by_curvature(4.0, 0.5 * size) && !done_by_curvature(4.0, 0.51 * size));
    assert!(done_by_curvature(0.25, 2.0 * size) && !done_by_curvature(0.25, 2.1 * size));
}

/// Displacements are measured by themselves where they are above one, angles never.
#[test]
fn sizes_of_corrections() {
    let m = slider_crank([0.3, 1.0, 0.1]);
    let chain = &m.chain;
    let length = chain.lengths.iter().position(|l| *l).unwrap();
    let angle = chain.lengths.iter().position(|l| !l).unwrap();
    let size = |k: usize, at: f64, by: f64| {
        let mut u = vec![0.0; chain.unknowns];
        u[k] = at;
        let mut pose = Pose::new(chain, 0.4, u);
        let mut step = vec![0.0; chain.unknowns];
        step[k] = by;
        let size = chain.moved(&mut pose, 0..chain.unknowns, &step);
        assert_eq!(pose.u[k], at + by);
        size
    };
    for sign in [1.0, -1.0] {
        assert_eq!(size(length, 4.0 * sign, -2.0), 0.5);
        assert_eq!(size(length, 0.25 * sign, 0.125), 0.125);
        assert_eq!(size(length, 1.5 * sign, 3.0), 2.0);
        assert_eq!(size(angle, 100.0 * sign, 0.5), 0.5);
        assert_eq!(size(angle, 0.0, 0.5 * sign), 0.5);
    }
    // One that is no number is not hidden by others.
    for bad in 0..chain.unknowns {
        let mut pose = Pose::new(chain, 0.4, vec![0.0; chain.unknowns]);
        let mut step = vec![0.5; chain.unknowns];
        step[bad] = f64::NAN;
        assert!(chain.moved(&mut pose, 0..chain.unknowns, &step).is_nan());
    }
}

/// From a tenth of a radian off every group is solved; where the Jacobian is singular, or nearly,
/// or no number, nothing is.
#[test]
fn starts_near_and_starts_that_lead_nowhere() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let chain = &m.chain;
    let mut work = Work::new(chain);
    let state = m.assembly_modes(0.7).states.remove(0);
    let blocks: Vec<Option<&Block>> = chain.blocks.iter().map(Some).chain([None]).collect();
    let blocks = blocks
        .iter()
        .filter(|b| b.is_none_or(|b| !b.unknowns.is_empty()));
    for block in blocks {
        let u = state.pose.u.iter().map(|u| u + 0.1).collect();
        let mut pose = Pose::new(chain, 0.7, u);
        assert!(chain.newton(&mut pose, *block, &mut work));
        for (a, b) in pose.u.iter().zip(&state.pose.u) {
            assert!((a - b).abs() < 1e-13, "{a} {b}");
        }
        // Coupler and rocker in one line.
        for u in [[0.0, 0.0], [1e-9, 0.0], [f64::NAN, 0.0]] {
            let mut pose = Pose::new(chain, 0.7, u.to_vec());
            assert!(!chain.newton(&mut pose, *block, &mut work), "{u:?}");
        }
    }
}

/// Where two positions have merged corrections halve, and end near the square root of rounding.
#[test]
fn merged_positions_are_settled() {
    let m = four_bar([0.25, 0.5, 0.25, 1.0]);
    let mut work = Work::new(&m.chain);
    let mut settled = 0;
    for k in 1..=20 {
        let off = 0.01 * f64::from(k);
        let u = vec![off, std::f64::consts::PI - 1.8 * off];
        let mut pose = Pose::new(&m.chain, 0.0, u);
        if m.chain.newton(&mut pose, None, &mut work) {
            settled += 1;
            assert!(pose.u.iter().all(|u| turn(2.0 * u, 0.0) < 1e-5), "{pose:?}");
        }
    }
    assert!(settled > 10, "{settled}");
}

/// A state, and one 1e-3 on with its unknowns predicted to first order.
fn ahead() -> (super::super::Mechanism, State, Pose, Vec<f64>) {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let state = m.assembly_modes(0.7).states.remove(0);
    let due = m.follow(&state, 0.701).unwrap().pose.u;
    let pairs = state.pose.u.iter().zip(&state.rates[0]);
    let u = pairs.map(|(u, d)| u + 1e-3 * d).collect();
    let pose = Pose::new(&m.chain, 0.701, u);
    (m, state, pose, due)
}

fn assert_solved(pose: &Pose, due: &[f64]) {
    for (a, b) in pose.u.iter().zip(due) {
        assert!((a - b).abs() < 4.0 * EPS, "{pose:?} {due:?}");
    }
    for (e, u) in pose.e[2..].iter().zip(due) {
        assert!((e.arg() - u).abs() < 8.0 * EPS, "{pose:?} {due:?}");
    }
}

/// Where corrections by the factors close by leave nothing, no Jacobian is formed; where they might
/// leave something, one is.
#[test]
fn factors_close_by_serve() {
    let (m, state, start, due) = ahead();
    let formed = |share: f64, size: f64| {
        let mut work = Work::new(&m.chain);
        work.size = size;
        let mut pose = start.clone();
        assert!(
            m.chain
                .newton_within(&mut pose, (&state.factors, share), 1e3, &mut work)
        );
        // Of a share that is told too small the rest is left: here that of the Jacobian's change.
        if share > 0.0 {
            assert_solved(&pose, &due);
        }
        work.jacobian.row(0).iter().any(|x| *x != 0.0)
    };
    assert!(!formed(0.0, 1.0));
    // Enough the last time, but not this time.
    assert!(formed(0.1, 0.0));
    // Not enough the last time.
    assert!(formed(0.1, 1e-3));
}

/// Factors that were not enough the last time are not tried: these would throw the position far
/// off.
#[test]
fn factors_that_do_not_serve_are_not_tried() {
    let (m, state, mut pose, due) = ahead();
    let n = m.chain.unknowns;
    let mut small = Matrix::new(n, n + 1);
    for r in 0..n {
        for c in 0..n {
            small[(r, c)] = 1e-7 * state.jacobian[(r, c)];
        }
    }
    let mut wrong = Factors::default();
    assert!(wrong.of(&small, n, 0));
    let mut work = Work::new(&m.chain);
    work.size = 1e-3;
    assert!(
        m.chain
            .newton_within(&mut pose, (&wrong, 1e-3), 1e3, &mut work)
    );
    assert_solved(&pose, &due);
    // The first correction by a Jacobian of its own is noted: half the second derivative times the
    // step's square.
    let off = state.rates[1].iter().fold(0.0f64, |m, x| m.max(x.abs())) * 0.5e-6;
    assert!((work.size / off - 1.0).abs() < 0.01, "{} {off}", work.size);
}

/// Checks that what one correction by the Jacobian leaves is corrected once more if the curvature
/// says so.
#[test]
fn what_a_correction_leaves_is_corrected() {
    let (m, state, start, due) = ahead();
    for (curvature, solved) in [(1e3, true), (0.0, false)] {
        let mut pose = start.clone();
        pose.u[0] += 1e-3;
        pose.place(&m.chain, &m.chain.order);
        let mut work = Work::new(&m.chain);
        work.size = 1.0;
        let near = (&state.factors, 1.0);
        assert!(m.chain.newton_within(&mut pose, near, curvature, &mut work));
        let off = pose.u.iter().zip(&due).map(|(a, b)| (a - b).abs());
        assert_eq!(off.fold(0.0, f64::max) < 1e-12, solved);
    }
    // A singular position has no correction.
    let mut pose = Pose::new(&m.chain, 0.7, vec![0.0; 2]);
    let mut work = Work::new(&m.chain);
    work.size = 1.0;
    let near = (&state.factors, 1.0);
    assert!(!m.chain.newton_within(&mut pose, near, 0.0, &mut work));
}
