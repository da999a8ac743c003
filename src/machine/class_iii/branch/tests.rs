//! Tests of `branch`.

use super::*;
use crate::machine::{Linkage, Source, class_iii};

fn linkage() -> class_iii::Linkage {
    let text = include_str!("../../../../examples/no-full-turn.toml");
    match Linkage::read(&Source::toml(text)).unwrap() {
        Linkage::ClassIii(linkage) => *linkage,
        _ => unreachable!("of class III"),
    }
}

/// Beside the fold the margin is half of what is left to the last position before it.
#[test]
fn a_branch_that_starts_within_the_margin_reaches_half_way_to_the_fold() {
    let linkage = linkage();
    let at = |phi1: f64| {
        let degrees = Rational::from_f64(phi1.to_degrees()).unwrap();
        choose(&linkage.solver, &degrees, Some(0), &linkage.start).unwrap()
    };
    let Reach::Part { low, high } = at(0.0).reach else {
        panic!("the crank does not turn fully");
    };
    for (fold, sign) in [(low.phi1, 1.0), (high.phi1, -1.0)] {
        let branch = at(fold + sign * 1.5e-6);
        let Reach::Part { low, high } = branch.reach else {
            panic!("a fold is near");
        };
        let end = if sign > 0.0 { low } else { high };
        let parts = [end.reached, end.phi1].map(|x| sign * (branch.start.phi1 - x));
        assert!((parts[1] - 1.5e-6).abs() < 1e-9, "{parts:?}");
        assert!((0.48..0.5).contains(&(parts[0] / parts[1])), "{parts:?}");
    }
}

#[test]
fn several_modes_are_not_chosen_among() {
    let linkage = linkage();
    let start = Start::default();
    let refused = choose(&linkage.solver, &Rational::new(), None, &start);
    let modes = linkage.solver.assembly_modes(Angle::from_deg(0.0)).modes;
    let modes = modes.iter().map(|m| m.phi4).collect();
    assert_eq!(refused.err(), Some(BranchError::Ambiguous { modes }));
}

/// Both ways begin there.
#[test]
fn a_dead_position_at_the_start_counts_once() {
    let solver = linkage().solver;
    let degrees = Rational::new();
    let branch = choose(&solver, &degrees, Some(0), &Start::default()).unwrap();
    let mut start = branch.dead[0].state;
    start.positions.phi2 = start.phi1;
    let dead = explore(&solver, 0, start).unwrap().dead;
    assert_eq!(dead.len(), 1);
    assert_eq!(dead[0].state.phi1, start.phi1);
}

fn screen() -> ClassIii {
    let text = include_str!("../../../../examples/sand-screen.toml");
    match Linkage::read(&Source::toml(text)).unwrap() {
        Linkage::ClassIii(linkage) => linkage.solver,
        _ => unreachable!("of class III"),
    }
}

/// Two modes meet there: before it there are two more than behind it.
#[test]
fn ends_are_folds() {
    let linkage = linkage();
    let solver = &linkage.solver;
    let modes = |phi1: f64| solver.assembly_modes(Angle::from_rad(phi1)).modes;
    let mut met = 0;
    for mode in 0..modes(0.0).len() {
        let branch = choose(solver, &Rational::new(), Some(mode), &linkage.start).unwrap();
        assert_eq!((branch.mode, branch.start.phi1), (mode, 0.0));
        let Reach::Part { low, high } = branch.reach else {
            panic!("the crank does not turn fully");
        };
        assert!(low.phi1 < 0.0 && 0.0 < high.phi1);
        for (end, outwards) in [(low, -1.0), (high, 1.0)] {
            let inside = outwards * (end.phi1 - end.reached);
            assert!((1e-6..1.2e-6).contains(&inside), "{inside}");
            assert_eq!(
                modes(end.phi1 - outwards * 1e-6).len(),
                modes(end.phi1 + outwards * 1e-6).len() + 2
            );
            // The square of their distance falls in proportion to what is left to the fold.
            let apart = |left: f64| {
                let all = modes(end.phi1 - outwards * left);
                let near = |m: &&Positions| (0.5 * (m.phi4 - end.phi4)).sin().abs() < 0.02;
                let pair: Vec<f64> = all.iter().filter(near).map(|m| m.phi4).collect();
                assert_eq!(pair.len(), 2, "{pair:?}");
                assert!((0.5 * (pair[0] + pair[1]) - end.phi4).sin().abs() < 20.0 * left);
                (pair[0] - pair[1]).sin().powi(2)
            };
            let [near, far] = [1e-6, 2e-6].map(apart);
            let at = (1e-6 * far - 2e-6 * near) / (far - near);
            assert!(at.abs() < 1e-10, "{at:e}");
            met += 1;
        }
        // In the order of the crank's angle, between the ends.
        let dead: Vec<f64> = branch.dead.iter().map(|d| d.state.phi1).collect();
        assert!(dead.is_sorted_by(|a, b| a < b), "{dead:?}");
        for d in &branch.dead {
            assert!(low.reached <= d.state.phi1 && d.state.phi1 <= high.reached);
            let off = d.state.phi1 - d.state.positions.phi2;
            assert!(off.sin().abs() < 1e-9, "{off}");
        }
    }
    assert!(met >= 4);
}

/// From wherever on the branch it is explored, its ends and dead positions are the same.
#[test]
fn a_branch_is_the_same_from_each_of_its_positions() {
    let solver = linkage().solver;
    let first = choose(&solver, &Rational::new(), Some(0), &Start::default()).unwrap();
    let Reach::Part { low, high } = first.reach else {
        panic!("the crank does not turn fully");
    };
    for share in [0.1, 0.5, 0.9] {
        let phi1 = low.reached + share * (high.reached - low.reached);
        let there = solver.follow(&first.start, Angle::from_rad(phi1)).unwrap();
        let other = explore(&solver, 7, there).unwrap();
        assert_eq!(other.mode, 7);
        let Reach::Part { low: l, high: h } = other.reach else {
            panic!("the crank does not turn fully");
        };
        for (a, b) in [(low, l), (high, h)] {
            assert!((a.phi1 - b.phi1).abs() < 1e-9 && (a.reached - b.reached).abs() < 1e-8);
        }
        assert_eq!(other.dead.len(), first.dead.len());
        for (a, b) in first.dead.iter().zip(&other.dead) {
            assert!((a.state.phi1 - b.state.phi1).abs() < 1e-9);
        }
    }
}

/// All round once; dead positions are those of one turn from the start, also where the turns are
/// not known.
#[test]
fn a_crank_that_turns_has_the_dead_positions_of_its_turns() {
    let solver = screen();
    let branch = choose(&solver, &15.into(), Some(2), &Start::default()).unwrap();
    assert!(matches!(branch.reach, Reach::Whole { turns: Some(1) }));
    let start = branch.start;
    assert!(!branch.dead.is_empty());
    for d in &branch.dead {
        let phi1 = d.state.phi1;
        assert!(start.phi1 <= phi1 && phi1 <= start.phi1 + TAU, "{phi1}");
        assert!((phi1 - d.state.positions.phi2).sin().abs() < 1e-9);
    }
    let mut other = start;
    // Where the linkage never comes back to.
    other.positions.phi5 += 1e-5;
    let open = explore(&solver, 2, other).unwrap();
    assert!(matches!(open.reach, Reach::Whole { turns: None }));
    assert_eq!(open.dead.len(), branch.dead.len());
}

/// Angles apart by whole turns are the same; all four have to be, within two millionths of a
/// radian.
#[test]
fn positions_are_the_same_but_for_turns() {
    let start = choose(&screen(), &15.into(), Some(2), &Start::default())
        .unwrap()
        .start;
    assert!(same(&start, &start));
    for k in 0..4 {
        for (off, due) in [
            (TAU, true),
            (-3.0 * TAU, true),
            (1.9e-6, true),
            (-1.9e-6, true),
            (2.1e-6, false),
            (-2.1e-6, false),
            (TAU / 2.0, false),
            (1.0, false),
        ] {
            let mut other = start;
            let p = &mut other.positions;
            *[&mut p.phi2, &mut p.phi3, &mut p.phi4, &mut p.phi5][k] += off;
            assert_eq!(same(&start, &other), due, "{k} {off}");
        }
    }
}

/// By number, or by φ4 within 15 degrees whatever the turn.
#[test]
fn a_mode_is_chosen_by_its_number_or_by_phi4() {
    let solver = screen();
    let modes = solver.assembly_modes(Angle::from_deg(15.0)).modes;
    let phi4: Vec<f64> = modes.iter().map(|m| m.phi4).collect();
    let at = |number: Option<usize>, start: &Start| {
        choose(&solver, &15.into(), number, start).map(|b| b.mode)
    };
    let by_phi4 = |degrees: f64| Start {
        phi4: Some(format!("{degrees:?} deg").parse().unwrap()),
        ..Start::default()
    };
    let by_mode = |mode: usize| Start {
        mode: Some(mode),
        ..Start::default()
    };
    for k in 0..phi4.len() {
        assert_eq!(at(Some(k), &Start::default()), Ok(k));
        assert_eq!(at(None, &by_mode(k)), Ok(k));
        assert_eq!(at(Some(k), &by_mode(0)), Ok(k));
        // A number comes before the file's angle.
        assert_eq!(at(Some(k), &by_phi4(phi4[0].to_degrees())), Ok(k));
        for off in [-374.9, -14.9, 0.0, 14.9, 360.0] {
            let given = phi4[k].to_degrees() + off;
            let chord = |j: &usize| (0.5 * (phi4[*j] - given.to_radians())).sin().abs();
            let nearest = (0..phi4.len()).min_by(|a, b| chord(a).total_cmp(&chord(b)));
            assert_eq!(at(None, &by_phi4(given)).ok(), nearest, "{k} {off}");
        }
        for off in [-15.1, 15.1, 40.0, 180.0] {
            let given = phi4[k].to_degrees() + off;
            let near = |m: &f64| {
                ((m.to_degrees() - given + 180.0).rem_euclid(360.0) - 180.0).abs() < 15.05
            };
            if phi4.iter().any(near) {
                continue;
            }
            let refused = at(None, &by_phi4(given)).unwrap_err();
            assert!(matches!(
                refused,
                BranchError::NoModeNear { degrees: 15.0, .. }
            ));
            let listed: Vec<String> = phi4
                .iter()
                .enumerate()
                .map(|(k, x)| format!("{k} (phi4 = {:.3} deg)", x.to_degrees()))
                .collect();
            let due = format!("; the assembly modes there are {}", listed.join(", "));
            assert!(refused.to_string().ends_with(&due), "{refused}");
        }
    }
    for refused in [
        at(Some(phi4.len()), &by_mode(0)),
        at(None, &by_mode(phi4.len())),
    ] {
        let due = BranchError::NoSuchMode {
            number: phi4.len(),
            degrees: 15.0,
            modes: phi4.clone(),
        };
        assert_eq!(refused, Err(due));
    }
    let parts = vec![[0.0, 10.5], [100.0, 359.9]];
    let not_here = BranchError::NotHere {
        degrees: 12.5,
        parts,
    };
    assert_eq!(
        not_here.to_string(),
        "the linkage cannot be assembled at phi1 = 12.5 deg, but can be from 0.0 to 10.5 deg and from 100.0 to 359.9 deg; \
         choose start.phi1 or --from-deg there"
    );
}
