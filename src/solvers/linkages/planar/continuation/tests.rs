//! Steps are proved: what the proof says of a ball holds in samples of it, and no step is shorter
//! than it has to be.

use super::super::chain::Bound;
use super::super::dense::Matrix;
use super::super::equilibrium_tests::*;
use super::super::pose::Pose;
use super::super::tests::*;
use super::*;
use num_complex::Complex64;

/// Mechanisms with a drive at which they have modes.
fn all() -> [(&'static str, Mechanism, f64); 14] {
    [
        ("four-bar", four_bar([0.1, 0.4, 0.3, 0.35]), 0.7),
        ("class III", class_iii(&SAND_SCREEN), 0.25),
        ("slider-crank", slider_crank([0.1, 0.3, 0.02]), 0.4),
        ("quick return", quick_return(), 0.4),
        ("slotted lever", slotted_lever(), 2.2),
        ("slotted crank", slotted_crank(), 0.4),
        ("trammel", trammel(), 0.4),
        ("cylinder", cylinder(), 0.4),
        ("cross slides", cross_slides(), 0.4),
        ("elbow", elbow(), 0.4),
        ("slotted block", slotted_block(false), 0.4),
        ("two blocks", two_blocks(), 0.4),
        // At a position where the ball is what limits the step.
        ("class III", class_iii(&SAND_SCREEN), 1.63),
        ("turned block", turned_block(), 0.4),
    ]
}

fn states() -> impl Iterator<Item = (&'static str, Mechanism, State)> {
    all().into_iter().flat_map(|(what, mechanism, drive)| {
        let states = mechanism.assembly_modes(drive).states;
        assert!(!states.is_empty(), "{what}");
        states
            .into_iter()
            .map(move |s| (what, mechanism.clone(), s))
    })
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// `A b`.
fn solved(state: &State, b: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut x = vec![0.0; state.pose.u.len()];
    state.factors.solve(b, &mut x);
    x
}

/// κ, μ and ω from the rows' bounds.
fn norms(mechanism: &Mechanism, state: &State) -> [f64; 3] {
    let n = mechanism.chain.unknowns;
    let mut rows: Vec<Bound> = Vec::new();
    bounds(&mechanism.chain, &state.pose, &mut rows);
    let inverse: Vec<Vec<f64>> = (0..n)
        .map(|r| solved(state, |k| f64::from(u8::from(k == r))))
        .collect();
    let of = |part: fn(&Bound) -> f64| -> f64 {
        let row = |i: usize| {
            (0..n)
                .map(|r| inverse[r][i].abs() * part(&rows[r]))
                .sum::<f64>()
        };
        largest(&(0..n).map(row).collect::<Vec<f64>>())
    };
    [of(|b| b.k), of(|b| b.m), of(|b| b.w)]
}

#[test]
fn steps_are_as_long_as_the_proof_lets_them() {
    for (what, mechanism, state) in states() {
        let step = mechanism.longest_step(&state, &mut Work::new(&mechanism.chain));
        let [kappa, mu, omega] = norms(&mechanism, &state);
        let nu = largest(&state.rates[0]);
        let Step { length, radius, .. } = step;
        let proved = Step::proved([kappa, mu, omega], nu).length;
        assert!((length - proved).abs() <= 1e-12 * proved, "{what}");
        assert!(
            (step.kappa - kappa).abs() <= 1e-12 * kappa,
            "{what}: {step:?} {kappa}"
        );
        assert!((step.mu - mu).abs() <= 1e-12 * mu, "{what}: {step:?} {mu}");
        let due = (0.25 / kappa).min(0.5 * SLACK);
        assert!(
            (radius - due).abs() <= 1e-12 * due,
            "{what}: {radius} {due}"
        );
    }
}

/// Each of the three limits where it is the least, to the last digits.
#[test]
fn limits_of_a_step() {
    // The map contracts; the ball is mapped into itself; arms are bounded.
    for (kappa, mu, omega, nu, due) in [
        (8.0, 3.0, 1.0, 2.0, 0.25 / (8.0 * 2.0 + 3.0)),
        (
            5.0,
            0.5,
            90.0,
            0.25,
            (0.05f64 / (0.3125 + 0.25 + 90.0)).sqrt(),
        ),
        (
            0.01,
            0.5,
            900.0,
            0.25,
            (0.125f64 / (0.000625 + 0.25 + 900.0)).sqrt(),
        ),
        (5.0, 0.5, 20.0, 0.5, (0.05f64 / (1.25 + 0.5 + 20.0)).sqrt()),
        (0.1, 0.02, 0.01, 0.5, 0.125),
        (0.1, 0.02, 0.01, 2.5, 0.05),
    ] {
        let step = Step::proved([kappa, mu, omega], nu);
        let limits = [
            0.25 / (kappa * nu + mu),
            ((0.25 / kappa).min(0.125) / (kappa * nu * nu + 2.0 * mu * nu + omega)).sqrt(),
            0.125 / nu.max(1.0),
        ];
        let least = limits.into_iter().fold(f64::INFINITY, f64::min);
        assert!(
            (least - due).abs() < 1e-15 * due.max(1.0),
            "{limits:?} {due}"
        );
        assert!((step.length - SAFETY * due).abs() < 1e-15, "{step:?} {due}");
        assert_eq!((step.kappa, step.mu), (kappa, mu));
        assert_eq!(step.radius, (0.25 / kappa).min(0.125));
    }
    for at in 0..4 {
        for bad in [f64::NAN, f64::INFINITY] {
            let mut all = [1.0; 4];
            all[at] = bad;
            let [kappa, mu, omega, nu] = all;
            assert_eq!(Step::proved([kappa, mu, omega], nu).length, 0.0);
        }
    }
    // Below the smallest step there is none: μ is a quarter of the length's reciprocal.
    let with = |length: f64| Step::proved([0.0, 0.25 * SAFETY / length, 0.0], 0.0).length;
    for share in [1.000_001, 1.5] {
        let length = with(share * SMALLEST_STEP);
        assert!((length / (share * SMALLEST_STEP) - 1.0).abs() < 1e-12);
    }
    assert_eq!(with(0.999_999 * SMALLEST_STEP), 0.0);
}

#[test]
fn largest_differences() {
    assert_eq!(apart(&[1.0, 2.0], &[1.25, 1.5]), 0.5);
    assert_eq!(apart(&[-1.0, 2.0], &[1.0, 2.5]), 2.0);
    assert_eq!(apart(&[0.5, 0.25], &[0.5, 0.25]), 0.0);
}

/// As far as the step goes, to the last digit where that is all the way.
#[test]
fn steps_towards_a_drive() {
    let at = |drive: f64, length: f64| Anchor {
        drive,
        step: Step {
            length,
            ..Step::default()
        },
        ..Anchor::default()
    };
    let anchor = at(0.5, 0.125);
    let drives = [0.7, 0.6, 0.5, 0.45, -3.0].map(|to| anchor.towards(to));
    assert_eq!(drives, [0.625, 0.6, 0.5, 0.45, 0.375]);
    // A sum of a difference that is rounded.
    let (from, to) = (0.2, 0.9);
    assert_ne!(from + (to - from), to);
    assert_eq!(at(from, to - from).towards(to), to);
}

/// κ = ½, μ = ¼: a correction 1/8 off with the drive ½ off.
#[test]
fn what_a_correction_leaves() {
    let step = Step {
        kappa: 0.5,
        mu: 0.25,
        ..Step::default()
    };
    assert_eq!(step.left(0.125, -0.5), 0.75);
    assert_eq!(step.left(0.125, 0.5), 0.75);
}

#[test]
fn the_ball_is_mapped_into_itself() {
    let mut random = Random(41);
    // The largest shares of the bounds that are found.
    let mut reached = [0.0f64; 2];
    for (what, mechanism, state) in states() {
        let n = mechanism.chain.unknowns;
        let Step { length, radius, .. } =
            mechanism.longest_step(&state, &mut Work::new(&mechanism.chain));
        let mut jacobian = Matrix::new(n, n + 1);
        let mut rows = Vec::new();
        for k in 0..200 {
            let s = length * [1.0, -1.0, random.between(-1.0, 1.0)][k % 3];
            let drive = state.pose.drive + s;
            let on_tangent: Vec<f64> = (0..n)
                .map(|k| state.pose.u[k] + state.rates[0][k] * s)
                .collect();
            let pose = Pose::new(&mechanism.chain, drive, on_tangent.clone());
            pose.residual(&mechanism.chain, &mechanism.chain.closures, &mut rows);
            let defect = largest(&solved(&state, |r| rows[r])) / (0.5 * radius);
            let off = |x: &f64| x + radius * random.between(-1.0, 1.0).signum();
            let u = on_tangent.iter().map(off).collect();
            let pose = Pose::new(&mechanism.chain, drive, u);
            pose.jacobian(
                &mechanism.chain,
                0..mechanism.chain.closures.len(),
                &mut jacobian,
            );
            let mut sums = vec![0.0; n];
            for c in 0..n {
                let column = solved(&state, |r| jacobian[(r, c)]);
                for r in 0..n {
                    sums[r] += (column[r] - f64::from(u8::from(r == c))).abs();
                }
            }
            let found = [defect, 2.0 * largest(&sums)];
            assert!(found.iter().all(|x| *x <= 1.0), "{what}: {found:?}");
            reached = [0, 1].map(|i| reached[i].max(found[i]));
        }
    }
    assert!(reached[0] > 0.15 && reached[1] > 0.5, "{reached:?}");
}

/// A solution outside the ball is another one for all that is known.
#[test]
fn solutions_outside_the_ball_are_refused() {
    for (what, mechanism, state) in states() {
        let mut work = Work::new(&mechanism.chain);
        let step = mechanism.longest_step(&state, &mut work);
        let drive = state.pose.drive + 0.9 * step.length;
        let mut anchor = Anchor::default();
        anchor.moor(&state, step);
        let mut next = state.clone();
        assert!(
            mechanism.correct(
                &state,
                &mut next,
                drive,
                &anchor,
                &mut Work::new(&mechanism.chain)
            ),
            "{what}"
        );
        let off = |k: usize| (next.pose.u[k] - anchor.tangent(k, drive)).abs();
        let away = (0..mechanism.chain.unknowns).map(off).fold(0.0, f64::max);
        assert!(away <= step.radius && away > 0.0, "{what}: {away} {step:?}");
        for (share, inside) in [(1.01, true), (1.0, true), (0.99, false)] {
            anchor.step.radius = share * away;
            let mut next = state.clone();
            let found = mechanism.correct(
                &state,
                &mut next,
                drive,
                &anchor,
                &mut Work::new(&mechanism.chain),
            );
            assert_eq!(found, inside, "{what}: {share}");
        }
    }
}

#[test]
fn anchors_hold_for_their_own_states_within_their_steps() {
    let mechanism = four_bar([0.1, 0.4, 0.3, 0.35]);
    let state = mechanism.assembly_modes(0.75).states.remove(0);
    let mut anchor = Anchor::default();
    assert!(!anchor.holds(&state, 0.75));
    let step = Step {
        length: 0.125,
        ..Step::default()
    };
    anchor.moor(&state, step);
    let at = state.pose.drive;
    assert!(anchor.holds(&state, at + 0.1) && anchor.holds(&state, at - 0.1));
    assert!(anchor.holds(&state, 0.625) && anchor.holds(&state, 0.875));
    assert!(!anchor.holds(&state, at + 0.13) && !anchor.holds(&state, at - 0.13));
    let mut other = state.clone();
    other.pose.u[0] = other.pose.u[0].next_up();
    assert!(!anchor.holds(&other, at));
    anchor.step.length = 0.0;
    assert!(!anchor.holds(&state, at));
}

/// The first correction is the prediction's error: of the fourth order in the step where the state
/// before gives third derivatives, no more than two steps back, and of the third where it does not.
#[test]
fn orders_of_the_prediction() {
    for (what, mechanism, start) in [
        ("four-bar", four_bar([0.1, 0.4, 0.3, 0.35]), 0.75),
        ("class III", class_iii(&SAND_SCREEN), 0.25),
        ("quick return", quick_return(), 0.5),
        ("trammel", trammel(), 0.5),
    ] {
        let state = mechanism.assembly_modes(start).states.remove(0);
        let error = |s: f64, back: f64| {
            let mut work = Work::new(&mechanism.chain);
            let mut anchor = Anchor::default();
            anchor.moor(&state, mechanism.longest_step(&state, &mut work));
            // By a Jacobian of its own at once.
            work.size = 1.0;
            let mut next = match back {
                0.0 => state.clone(),
                _ => mechanism.follow(&state, start - back * s).unwrap(),
            };
            let drive = start + s;
            assert!(mechanism.correct(&state, &mut next, drive, &anchor, &mut work));
            work.size
        };
        let s = 2f64.powi(-8);
        for (back, order) in [(0.0, 3), (1.0, 4), (-1.0, 4), (2.0, 4), (2.1, 3), (0.5, 4)] {
            let ratio = error(s, back) / error(0.5 * s, back);
            let due = 2f64.powi(order);
            assert!((ratio / due - 1.0).abs() < 0.2, "{what} {back}: {ratio}");
        }
        // A state farther back tells nothing, whatever its rates.
        let size = |wild: f64| {
            let mut work = Work::new(&mechanism.chain);
            let mut anchor = Anchor::default();
            anchor.moor(&state, mechanism.longest_step(&state, &mut work));
            work.size = 1.0;
            let mut next = mechanism.follow(&state, start - 3.0 * s).unwrap();
            next.rates[1].fill(wild);
            assert!(mechanism.correct(&state, &mut next, start + s, &anchor, &mut work));
            work.size
        };
        assert_eq!(size(0.0), size(1e6), "{what}");
        // From a state b steps back the error is (b/12 + 1/24) of the fourth derivative.
        let [near, far] = [1.0, 2.0].map(|back| error(s, back));
        let ratio = far / near;
        assert!((ratio * 3.0 / 5.0 - 1.0).abs() < 0.1, "{what}: {ratio}");
    }
}

/// A prediction that is far off is given up for the tangent's end, which lies in the ball.
#[test]
fn wild_predictions_are_given_up() {
    for (what, mechanism, state) in states() {
        let mut work = Work::new(&mechanism.chain);
        let step = mechanism.longest_step(&state, &mut work);
        let drive = state.pose.drive + 0.5 * step.length;
        let mut anchor = Anchor::default();
        anchor.moor(&state, step);
        let mut due = state.clone();
        assert!(mechanism.correct(&state, &mut due, drive, &anchor, &mut work));
        for wild in [1e12, 1e300] {
            let mut next = state.clone();
            next.pose.drive -= 0.5 * step.length;
            next.rates[1].fill(wild);
            assert!(
                mechanism.correct(&state, &mut next, drive, &anchor, &mut work),
                "{what} {wild}"
            );
            assert!(apart(&next.pose.u, &due.pose.u) < 1e-13, "{what} {wild}");
        }
    }
}

/// One proof serves all rows within its step; where a row fails there, another is made from the
/// last state.
#[test]
fn proofs_serve_while_they_reach() {
    for (what, mechanism, start) in states() {
        let mut follower = Follower::new(&mechanism.chain);
        let from = start.pose.drive;
        let step = mechanism.longest_step(&start, &mut follower.work);
        let mut state = start.clone();
        let to = |share: f64| mechanism.outer_drive(from + share * step.length);
        for share in [0.2, 0.4, 0.6, 0.8] {
            mechanism
                .advance(&mut state, to(share), &mut follower)
                .unwrap();
            assert_eq!(follower.anchor.drive, from, "{what}");
            assert!(follower.anchor.last == state.pose.u, "{what}");
        }
        let last = state.pose.drive;
        follower.anchor.step.radius = 0.0;
        mechanism
            .advance(&mut state, to(0.9), &mut follower)
            .unwrap();
        assert_eq!(follower.anchor.drive, last, "{what}");
        mechanism
            .advance(&mut state, to(1.1), &mut follower)
            .unwrap();
        assert!(mechanism.drive_of(&state) == to(1.1), "{what}");
    }
}

/// Checks what Newton's correction would still change, over the rounding errors of residuals and
/// angles.
#[test]
fn corrections_leave_nothing() {
    let mut worst = 0.0f64;
    for (what, mechanism, start) in states() {
        let from = mechanism.drive_of(&start);
        for step in [1e-6, 1e-4, 6e-3, 0.05] {
            let step = if what == "cylinder" { 0.1 * step } else { step };
            let drives = (1..=60).map(|k| from + step * f64::from(k));
            let rows = mechanism
                .sweep(&start, drives)
                .unwrap_or_else(|(rows, _)| rows);
            assert!(!rows.is_empty(), "{what}: {step}");
            for row in &rows {
                let mut f = Vec::new();
                row.pose
                    .residual(&mechanism.chain, &mechanism.chain.closures, &mut f);
                let left = largest(&solved(row, |r| f[r]));
                let n = f.len();
                let inverse = |r: usize| largest(&solved(row, |k| f64::from(u8::from(k == r))));
                let size = 1.0 + (0..n).map(inverse).sum::<f64>() + largest(&row.pose.u);
                worst = worst.max(left / size);
            }
        }
    }
    assert!(worst < 2.0 * f64::EPSILON, "{worst:e}");
}

#[test]
fn drives_out_of_range_are_refused() {
    let mechanism = driver();
    let state = mechanism.assembly_modes(0.3).states.remove(0);
    assert_eq!(mechanism.checked(1e6).ok(), Some(1e6));
    for to in [1e6f64.next_up(), -1.1e6, f64::INFINITY, f64::NAN] {
        let refused = mechanism.follow(&state, to);
        assert!(
            matches!(refused, Err(PositionError::Drive { value }) if value.to_bits() == to.to_bits())
        );
    }
    // A stroke is measured in the chain's unit.
    let cylinder = cylinder();
    let state = cylinder.assembly_modes(0.4).states.remove(0);
    let to = 1.1e6 * cylinder.chain.metres;
    assert!(matches!(
        cylinder.follow(&state, to),
        Err(PositionError::Drive { .. })
    ));
}

/// A rocker driven beyond its range: the branch ends at the fold, in the drive's own unit, and what
/// is before it has been seen.
#[test]
fn branches_end_where_they_fold() {
    let mechanism = four_bar([0.3, 0.4, 0.2, 0.35]);
    // Coupler and rocker in one line.
    let cosine = (0.3f64.powi(2) + 0.35f64.powi(2) - 0.6f64.powi(2)) / (2.0 * 0.3 * 0.35);
    let fold = cosine.acos();
    let start = mechanism.assembly_modes(1.0).states.remove(0);
    let ends = |e: &PositionError| matches!(e, PositionError::Ends { drive } if (drive - fold).abs() < 1e-6);
    assert!(ends(&mechanism.follow(&start, 3.0).unwrap_err()));
    let (last, e) = mechanism.follow_as_far(&start, 3.0);
    assert!(e.as_ref().is_some_and(ends) && mechanism.gap(&last) < 1e-14);
    assert!((mechanism.drive_of(&last) - fold).abs() < 1e-6);
    let (last, e) = mechanism.follow_as_far(&start, 1.5);
    assert!(e.is_none() && mechanism.drive_of(&last) == 1.5);
    let drives = [1.0, 1.2, 1.5, 3.0, 1.0];
    let (rows, e) = mechanism.sweep(&start, drives).unwrap_err();
    assert!(ends(&e));
    let seen: Vec<f64> = rows.iter().map(|s| mechanism.drive_of(s)).collect();
    assert_eq!(seen, drives[..3]);
    let cylinder = cylinder();
    let start = cylinder.assembly_modes(0.4).states.remove(0);
    let e = cylinder.follow(&start, 3.0).unwrap_err();
    // Cylinder and arm in one line: the distance of the pivots and the arm give the reach of the
    // piston's pin.
    let reach = 0.9f64.hypot(0.1) + 0.5;
    let (turn, along) = (Complex64::cis(0.25), Complex64::cis(0.1));
    let pin = |s: f64| (0.05 + along * s + turn * Complex64::new(0.4, 0.02)).norm();
    assert!(
        matches!(e, PositionError::Ends { drive } if (pin(drive) - reach).abs() < 1e-6),
        "{e}"
    );
}

/// Coupler and rocker in one line at half a turn, where the two branches cross: neither is followed
/// through, whichever way it comes and wherever it starts.
#[test]
fn branches_end_at_a_change_point() {
    let mechanism = four_bar([1.0, 2.0, 4.0, 5.0]);
    for k in 0..20 {
        let from = -2.0 + 0.2 * f64::from(k);
        for start in mechanism.assembly_modes(from).states {
            for turn in [-6.0, 6.0] {
                let (last, e) = mechanism.follow_as_far(&start, from + turn);
                let end = std::f64::consts::PI.copysign(turn);
                assert!(e.is_some(), "{from} {turn}");
                assert!(
                    (mechanism.drive_of(&last) - end).abs() < 1e-5,
                    "{from} {turn}"
                );
            }
        }
    }
}
