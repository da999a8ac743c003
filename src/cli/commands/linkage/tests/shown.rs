//! The shown parts: windows, positions and pages.

use super::super::shown;
use super::*;

#[test]
fn units_of_length() {
    for unit in ["m", "mm", " in ", "um"] {
        assert!(shown::is_length(unit), "{unit}");
    }
    for unit in ["deg", "kg", "m/s", "", "furlong"] {
        assert!(!shown::is_length(unit), "{unit}");
    }
}

#[test]
fn windows_of_a_linkage_of_class_iii() {
    let linkage = screen(SCREEN);
    let whole = branch(&linkage);
    let columns = || Columns::from(class_iii::names(&linkage, false));
    let shown = |line: &str, branch: &Branch| {
        let args = args(line);
        let grid = args.grid(linkage.start_degrees()).unwrap();
        let (plan, columns) = (plan(&grid, branch), columns());
        let motion = shown::class_iii(&args, &linkage, branch, Some((&plan, &columns))).unwrap();
        assert!(motion.courses.len() > 3);
        let lengths = motion.courses.iter().map(|c| c.variants[0].1.len());
        assert!(lengths.into_iter().all(|n| n == motion.drive.values.len()));
        motion
    };
    // All that there is: 720 positions of the turn, from the file's start on.
    let all = shown("", &whole);
    assert_eq!(
        (all.drive.values.len(), all.start, all.closed),
        (720, 0, true)
    );
    assert!((shown_first(&all) - 14.426).abs() < 1e-9);
    let turns = |turns| Branch {
        reach: Reach::Whole { turns },
        ..whole.clone()
    };
    for (line, turned, due) in [
        ("--step-deg 90", Some(1), true),
        ("--from-deg 5 --step-deg 90", Some(1), true),
        ("--to-deg 300 --step-deg 90", Some(1), false),
        ("--step-deg 90", Some(2), false),
        ("--step-deg 90", None, false),
        ("--to-deg 300 --step-deg 90", Some(2), false),
    ] {
        let motion = shown(line, &turns(turned));
        assert_eq!((motion.closed, motion.start), (due, 0), "{line}");
    }
    let motion = shown("--from-deg 5 --to-deg 185 --step-deg 45", &whole);
    let due = [5.0, 50.0, 95.0, 140.0, 185.0];
    let near = |a: &[f64], b: &[f64]| {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9)
    };
    assert!(
        near(&motion.drive.values, &due),
        "{:?}",
        motion.drive.values
    );
}

/// Two turns are asked for, of a crank that does not turn: every position once, by its angle.
#[test]
fn a_part_of_a_turn_is_in_order() {
    let linkage = screen(SHORT);
    let part = branch(&linkage);
    let columns = Columns::from(class_iii::names(&linkage, false));
    let window = args("--from-deg 0 --to-deg 720 --step-deg 30");
    let plan = plan(&window.grid(None).unwrap(), &part);
    let motion = shown::class_iii(&window, &linkage, &part, Some((&plan, &columns))).unwrap();
    assert!(!motion.closed);
    // From -96.6 to more than 173 degrees.
    let due: Vec<f64> = (-3..=5).map(|k| 30.0 * f64::from(k)).collect();
    let found = &motion.drive.values;
    assert!(
        found.len() == due.len() && found.iter().zip(&due).all(|(a, b)| (a - b).abs() < 1e-9),
        "{found:?}"
    );
    let all = args("");
    let motion = shown::class_iii(&all, &linkage, &part, Some((&plan, &columns))).unwrap();
    assert!(!motion.closed && motion.drive.values.len() > 700);
}

/// Without courses, with that angle first; or not at all.
fn begins(found: Result<Motion, Failure>, due: Option<f64>, line: &str) {
    match (&found, due) {
        (Ok(motion), Some(due)) => {
            let first = shown_first(motion);
            assert!((first - due).abs() < 1e-9, "{line}: {first}");
            assert!(motion.courses.is_empty());
        }
        _ => assert!(found.is_err() && due.is_none(), "{line}"),
    }
}

/// At `--from-deg` on the branch's own count of turns, or at the start.
#[test]
fn a_position_of_a_linkage_of_class_iii() {
    for (text, line, due) in [
        (SCREEN, "", Some(14.426)),
        (SCREEN, "--from-deg 100", Some(100.0)),
        (SHORT, "", Some(14.426)),
        (SHORT, "--from-deg 300", Some(-60.0)),
        (SHORT, "--from-deg -60", Some(-60.0)),
        (SHORT, "--from-deg 200", None),
    ] {
        let linkage = screen(text);
        let found = shown::class_iii(&args(line), &linkage, &branch(&linkage), None);
        begins(found, due, line);
    }
}

#[test]
fn angles_on_the_branchs_own_count_of_turns() {
    let linkage = screen(SCREEN);
    let whole = branch(&linkage);
    let end = |reached: f64| End {
        phi1: reached,
        reached,
        phi4: 0.0,
    };
    let part = Branch {
        reach: Reach::Part {
            low: end(-1.0),
            high: end(1.0),
        },
        ..whole.clone()
    };
    for angle in [-7.0, 0.0, 40.0] {
        assert_eq!(shown::on_branch(angle, &whole), Some(angle));
    }
    for (angle, due) in [
        (1.0, Some(1.0)),
        (-1.0, Some(-1.0)),
        (0.5, Some(0.5)),
        (0.5 + TAU, Some(0.5)),
        (-0.5 - 2.0 * TAU, Some(-0.5)),
        (1.01, None),
        (-1.01, None),
        (PI, None),
    ] {
        let found = shown::on_branch(angle, &part);
        let same = match (found, due) {
            (Some(a), Some(b)) => f64::abs(a - b) < 1e-12,
            _ => found == due,
        };
        assert!(same, "{angle}: {found:?}");
    }
}

#[test]
fn windows_of_dyads() {
    let rocking = four_bar([1.0, 4.0, 3.0, 3.5]);
    // It reaches from 15.4 to 344.6 degrees.
    let held = four_bar([3.0, 4.0, 3.0, 3.5]);
    let shown = |line: &str, dyad: &Dyad| {
        let args = args(line);
        let grid = args.grid(dyad.start.clone()).unwrap();
        let columns = Columns::from(mechaudit::machine::dyad::names(dyad));
        let motion =
            shown::dyad(&args, dyad, ASSEMBLIES[0], Some((&grid, &columns)), None).unwrap();
        assert!(motion.courses.len() > 3);
        motion
    };
    for (line, dyad, due, closed) in [
        (
            "--step-deg 90",
            &rocking,
            &[0.0, 90.0, 180.0, 270.0][..],
            true,
        ),
        (
            "--step-deg 90 --to-deg 180",
            &rocking,
            &[0.0, 90.0, 180.0],
            false,
        ),
        (
            "--step-deg 90 --from-deg -90",
            &rocking,
            &[-90.0, 0.0, 90.0, 180.0],
            true,
        ),
        // Where it is, however it is counted.
        (
            "--step-deg 60 --from-deg -180 --to-deg 180",
            &held,
            &[60.0, 120.0, 180.0, 240.0, 300.0],
            false,
        ),
        (
            "--step-deg 60 --from-deg 360 --to-deg 480",
            &held,
            &[60.0, 120.0],
            false,
        ),
        ("--step-deg 120", &held, &[120.0, 240.0], false),
    ] {
        let motion = shown(line, dyad);
        let found = &motion.drive.values;
        let same = found.iter().zip(due).all(|(a, b)| f64::abs(a - b) < 1e-9);
        assert!(same && found.len() == due.len(), "{line}: {found:?}");
        assert_eq!((motion.closed, motion.start), (closed, 0), "{line}");
    }
    let motion = shown("", &rocking);
    assert_eq!((motion.drive.values.len(), motion.closed), (720, true));
    assert_eq!(shown_first(&motion), 0.0);
    let motion = shown("", &held);
    assert!(!motion.closed && motion.drive.values.len() > 700);
}

#[test]
fn a_position_of_a_dyad() {
    let rocking = four_bar([1.0, 4.0, 3.0, 3.5]);
    let held = four_bar([3.0, 4.0, 3.0, 3.5]);
    for (dyad, line, due) in [
        (&rocking, "", Some(0.0)),
        (&rocking, "--from-deg 75", Some(75.0)),
        (&held, "--from-deg 100", Some(100.0)),
        (&held, "--from-deg -100", Some(260.0)),
        (&held, "--from-deg 0", None),
    ] {
        let found = shown::dyad(&args(line), dyad, ASSEMBLIES[1], None, None);
        begins(found, due, line);
    }
    // Nobody has asked for 0 degrees, where it does not reach.
    let motion = shown::dyad(&args(""), &held, ASSEMBLIES[0], None, None).unwrap();
    assert!((15.0..17.0).contains(&shown_first(&motion)));
}

fn mechanism(text: &str) -> (Box<mechanisms::Machine>, mechanisms::Branch) {
    let machine::Linkage::Planar(machine) = read(text) else {
        unreachable!("bodies and joints")
    };
    let at = machine.start.at.unwrap_or(0.0);
    let at = if machine.rotary() {
        at.to_radians()
    } else {
        at
    };
    let branch = mechanisms::choose(&machine, at, None).unwrap();
    (machine, branch)
}

/// The motion over what `line` asks for, with the values of the drive in degrees or metres.
fn mechanism_shown(text: &str, line: &str, turns: Option<Option<u32>>) -> Motion {
    let (machine, mut branch) = mechanism(text);
    if let Some(turns) = turns {
        branch.reach = mechanisms::Reach::Whole { turns };
    }
    let args = args(line);
    let grid = args
        .grid(machine.start.at.and_then(Rational::from_f64))
        .unwrap();
    let degrees = (0..grid.count as i64).map(|k| nearest_f64(&grid.angle(k)));
    let drives: Vec<(f64, f64)> = degrees.map(|d| (d, d.to_radians())).collect();
    let columns = mechanisms::Columns {
        paths: false,
        reactions: false,
    };
    let window = shown::Window {
        drives: &drives,
        named: &Columns::from(mechanisms::names(&machine, columns)),
        columns,
    };
    let motion = shown::planar(&args, &machine, &branch, Some(window)).unwrap();
    assert!(motion.courses.len() > 3);
    motion
}

#[test]
fn windows_of_mechanisms() {
    for (line, turned, due) in [
        ("--step-deg 90", Some(1), true),
        ("--from-deg 5 --step-deg 90", Some(1), true),
        ("--to-deg 300 --step-deg 90", Some(1), false),
        ("--step-deg 90", Some(2), false),
        ("--step-deg 90", None, false),
        ("--to-deg 300 --step-deg 90", Some(2), false),
    ] {
        let motion = mechanism_shown(WATT_2, line, Some(turned));
        assert_eq!((motion.closed, motion.start), (due, 0), "{line}");
    }
    let motion = mechanism_shown(WATT_2, "--from-deg 5 --to-deg 185 --step-deg 45", None);
    let due = [5.0, 50.0, 95.0, 140.0, 185.0];
    let found = &motion.drive.values;
    assert!(
        found.len() == 5 && found.iter().zip(due).all(|(a, b)| (a - b).abs() < 1e-9),
        "{found:?}"
    );
    // From the start on, all round.
    let all = mechanism_shown(WATT_2, "", None);
    assert_eq!((all.drive.values.len(), all.closed), (720, true));
    // Two turns of a crank that does not turn: each position once.
    let part = mechanism_shown(CELL, "--from-deg 0 --to-deg 720 --step-deg 30", None);
    let found = &part.drive.values;
    assert!(
        found.len() > 2 && found.windows(2).all(|w| (w[1] - w[0] - 30.0).abs() < 1e-6),
        "{found:?}"
    );
    assert!(!part.closed);
    // A displacement has no window of angles.
    let boom = |line| mechanism_shown(BOOM, line, None).drive.values;
    let all = boom("");
    assert!(all.len() > 700 && (all[0] - 0.9).abs() < 1e-9);
    assert_eq!(boom("--step-deg 90"), all);
}

#[test]
fn a_position_of_a_mechanism() {
    for (text, line, due) in [
        (WATT_2, "--from-deg 75", Some(75.0)),
        (CELL, "--from-deg 30", Some(30.0)),
        (CELL, "--from-deg 390", Some(30.0)),
        (CELL, "--from-deg 170", None),
        (BOOM, "", Some(1.0)),
    ] {
        let (machine, branch) = mechanism(text);
        begins(
            shown::planar(&args(line), &machine, &branch, None),
            due,
            line,
        );
    }
}

#[test]
fn a_page_without_positions_is_refused() {
    let linkage = screen(SCREEN);
    let whole = branch(&linkage);
    let mut motion = shown::class_iii(&args("--from-deg 0"), &linkage, &whole, None).unwrap();
    let mut out = Vec::new();
    assert_eq!(
        shown::page(&mut out, &motion, &[]).unwrap(),
        Outcome::AsExpected
    );
    assert!(out.starts_with(b"<!doctype html>") || out.starts_with(b"<!DOCTYPE html>"));
    motion.drive.values.clear();
    out.clear();
    assert!(shown::page(&mut out, &motion, &[]).is_err() && out.is_empty());
}
