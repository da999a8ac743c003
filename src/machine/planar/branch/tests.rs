//! Tests of `branch`.

use super::*;
use crate::machine::Source;

const BOOM: &str = include_str!("../../../../examples/cylinder-boom.toml");

fn read(text: &str) -> Machine {
    Machine::read(&Source::toml(text)).unwrap()
}

/// A four-bar linkage on the pivots A and D.
fn four_bar([crank, coupler, rocker, frame]: [f64; 4], more: &str) -> Machine {
    let body = |name: &str, ends: &str, l: f64| {
        format!("[[body]]\nname = \"{name}\"\nends = [{ends}]\nlength = \"{l} m\"\n")
    };
    let bodies = [
        body("crank", "\"A\", \"B\"", crank),
        body("coupler", "\"B\", \"C\"", coupler),
        body("rocker", "\"D\", \"C\"", rocker),
    ];
    let pins =
        ["A", "B", "C", "D"].map(|p| format!("[[joint]]\nkind = \"pin\"\npoint = \"{p}\"\n"));
    read(&format!(
        "type = \"planar\"\n[ground.points]\nA = [\"0 m\", \"0 m\"]\nD = [\"{frame} m\", \"0 m\"]\n\
         {}{}[drive]\nbody = \"crank\"\n{more}",
        bodies.concat(),
        pins.concat()
    ))
}

/// A crank with a wheel beside it that turns by `teeth[0] / teeth[1]` of a turn for each of the
/// crank's.
fn geared(teeth: [u32; 2]) -> Machine {
    let pins = ["O", "N"].map(|p| format!("[[joint]]\nkind = \"pin\"\npoint = \"{p}\"\n"));
    read(&format!(
        "type = \"planar\"\n[ground.points]\nO = [\"0 m\", \"0 m\"]\nN = [\"1 m\", \"0 m\"]\n\
         [[body]]\nname = \"crank\"\nends = [\"O\", \"A\"]\nlength = \"1 m\"\n\
         [[body]]\nname = \"wheel\"\nends = [\"N\", \"B\"]\nlength = \"1 m\"\n{}\
         [[joint]]\nkind = \"gears\"\nwheels = [\"crank\", \"wheel\"]\nteeth = {teeth:?}\n\
         [drive]\nbody = \"crank\"\n",
        pins.concat()
    ))
}

const CRANK_ROCKER: [f64; 4] = [1.0, 3.0, 3.0, 4.0];
/// The crank swings between the angles at which coupler and rocker are in line.
const DOUBLE_ROCKER: [f64; 4] = [3.0, 3.0, 3.0, 3.5];

fn swing() -> f64 {
    f64::acos((9.0 + 3.5 * 3.5 - 36.0) / (2.0 * 3.0 * 3.5))
}

#[test]
fn angles_are_wrapped_to_half_a_turn() {
    for turns in -3..=3 {
        for angle in [-3.1, -1.0, 0.0, 0.5, 3.1] {
            let found = wrapped(angle + TAU * f64::from(turns));
            assert!((found - angle).abs() < 1e-14, "{angle} {turns}: {found}");
        }
    }
}

/// To a billionth of a degree, or a picometre; zero has no sign.
#[test]
fn the_drive_is_said_in_its_unit() {
    let angle = four_bar(CRANK_ROCKER, "");
    for (degrees, due) in [
        (30.0, "30 deg"),
        (-12.345_678_912_3, "-12.345678912 deg"),
        (0.123_456_789_7, "0.12345679 deg"),
        (400.0, "400 deg"),
        (-1e-11, "0 deg"),
    ] {
        assert_eq!(angle.drive_text(f64::to_radians(degrees)), due);
    }
    let length = read(BOOM);
    for (metres, due) in [
        (0.9, "0.9 m"),
        (-1.234_567_890_123_4, "-1.234567890123 m"),
        (1e-12, "0.000000000001 m"),
        (-1e-14, "0 m"),
    ] {
        assert_eq!(length.drive_text(metres), due);
    }
}

#[test]
fn a_drive_is_turned_to_where_the_branch_reaches() {
    let machine = four_bar(CRANK_ROCKER, "");
    let found = choose(&machine, 1.0, Some(0)).unwrap();
    let part = |machine: &Machine, low: Option<f64>, high: Option<f64>, drive: f64| {
        let end = |drive| End { drive, kind: None };
        let reach = Reach::Part {
            low: low.map(end),
            high: high.map(end),
        };
        let branch = Branch {
            reach,
            ..found.clone()
        };
        branch.turned_to(machine, drive)
    };
    assert_eq!(found.turned_to(&machine, 50.0), Some(50.0));
    for (low, high, drive, turns) in [
        (1.0, 3.0, 2.0, Some(0.0)),
        (1.0, 3.0, 2.0 - 3.0 * TAU, Some(3.0)),
        (1.0, 3.0, 2.0 + 2.0 * TAU, Some(-2.0)),
        (-8.0, -6.0, 0.0, Some(-1.0)),
        (1.0, 3.0, 0.9, None),
        (1.0, 3.0, 3.1, None),
        (1.0, 3.0, 3.1 - TAU, None),
        // Rows keep a millionth of a radian off the ends.
        (1.0, 3.0, 1.0 + 0.9e-6, None),
        (1.0, 3.0, 1.0 + 1.1e-6, Some(0.0)),
        (1.0, 3.0, 3.0 - 0.9e-6, None),
        (1.0, 3.0, 3.0 - 1.1e-6, Some(0.0)),
        // The first of two turns.
        (1.0, 10.0, 2.0, Some(0.0)),
        (1.0, 10.0, 0.5, Some(1.0)),
    ] {
        let at = part(&machine, Some(low), Some(high), drive);
        let due = turns.map(|t: f64| drive + t * TAU);
        assert_eq!(at.is_some(), due.is_some(), "{low} {high} {drive}");
        let apart = at.unwrap_or(0.0) - due.unwrap_or(0.0);
        assert!(apart.abs() < 1e-14, "{at:?} {due:?}");
    }
    // A displacement is where it is; without an end nothing bounds it.
    let boom = read(BOOM);
    for (low, high, drive, reached) in [
        (Some(1.0), Some(2.0), 1.5, true),
        (Some(1.0), Some(2.0), 0.5, false),
        (Some(1.0), Some(2.0), 2.5, false),
        (None, Some(2.0), -50.0, true),
        (None, Some(2.0), 2.5, false),
        (Some(1.0), None, 50.0, true),
        (Some(1.0), Some(2.0), 1.0 + MARGIN, true),
        (Some(1.0), Some(2.0), 2.0 - MARGIN, true),
        (None, None, 50.0, true),
    ] {
        let due = reached.then_some(drive);
        assert_eq!(
            part(&boom, low, high, drive),
            due,
            "{low:?} {high:?} {drive}"
        );
    }
    assert_eq!(part(&machine, None, Some(2.0), 1.0), Some(1.0));
}

/// The ends are where the triangle of the other links is flat.
#[test]
fn a_branch_ends_at_folds_or_at_its_range() {
    let fold = |found: Option<End>, due: f64| {
        let found = found.unwrap();
        assert!((found.drive - due).abs() < 1e-9, "{found:?}, due {due}");
        assert_eq!(found.kind, Some(SingularKind::Fold));
    };
    let machine = four_bar(DOUBLE_ROCKER, "");
    for (start, turns) in [(0.5, 0.0), (-0.5, 0.0), (0.5 + TAU, TAU)] {
        for mode in [0, 1] {
            let branch = choose(&machine, start, Some(mode)).unwrap();
            assert_eq!(
                (branch.mode, branch.modes, branch.complete),
                (mode, 2, true)
            );
            let Reach::Part { low, high } = branch.reach else {
                panic!("no full turn");
            };
            fold(low, turns - swing());
            fold(high, turns + swing());
        }
    }
    let [frame, arm] = [0.4f64.hypot(0.6), 1.2f64.hypot(0.1)];
    for (range, ends) in [
        ("[\"0.9 m\", \"1.4 m\"]", [None, None]),
        ("[\"0.1 m\", \"1.4 m\"]", [Some(arm - frame), None]),
        ("[\"0.9 m\", \"3 m\"]", [None, Some(arm + frame)]),
        (
            "[\"0.1 m\", \"3 m\"]",
            [Some(arm - frame), Some(arm + frame)],
        ),
    ] {
        let machine = read(&BOOM.replace("[\"0.9 m\", \"1.4 m\"]", range));
        let Reach::Part { low, high } = choose(&machine, 1.0, None).unwrap().reach else {
            panic!("a range");
        };
        for (found, due) in [low, high].into_iter().zip(ends) {
            match due {
                Some(due) => fold(found, due),
                None => assert_eq!(found, None),
            }
        }
    }
}

/// A wheel that turns by 1/n of the crank's turn is back after n, and is looked at for 12.
#[test]
fn a_branch_closes_after_turns() {
    let of = |machine: &Machine| choose(machine, 0.5, Some(0)).unwrap().reach;
    for mode in [0, 1] {
        let machine = four_bar(CRANK_ROCKER, "");
        let found = choose(&machine, 0.5, Some(mode)).unwrap().reach;
        assert_eq!(found, Reach::Whole { turns: Some(1) });
    }
    for (teeth, turns) in [
        ([20, 20], Some(1)),
        ([20, 10], Some(1)),
        ([20, 40], Some(2)),
        ([20, 30], Some(3)),
        ([10, 120], Some(12)),
        ([10, 130], None),
    ] {
        assert_eq!(of(&geared(teeth)), Reach::Whole { turns }, "{teeth:?}");
    }
}

/// The crank at 60 deg: the two modes are mirror images at the line from B to D.
#[test]
fn a_mode_is_chosen_by_its_number_or_by_angles_near_it() {
    let at = TAU / 6.0;
    let plain = four_bar(CRANK_ROCKER, "");
    let modes = plain.solver.assembly_modes(at).states;
    assert_eq!(modes.len(), 2);
    let line = |k: usize, body: usize| plain.line(&modes[k], body).to_degrees();
    let chosen = |more: &str, number: Option<usize>| {
        let machine = four_bar(CRANK_ROCKER, &format!("[start]\n{more}\n"));
        choose(&machine, at, number).map(|b| b.mode)
    };
    for mode in [0, 1] {
        assert_eq!(chosen("", Some(mode)), Ok(mode));
        assert_eq!(chosen(&format!("mode = {mode}"), None), Ok(mode));
        // A number that is asked for comes before the file's.
        assert_eq!(
            chosen(&format!("mode = {mode}"), Some(1 - mode)),
            Ok(1 - mode)
        );
        let near = |body: usize, name: &str, off: f64| {
            format!("near.{name} = \"{:?} deg\"", line(mode, body) + off)
        };
        for off in [0.0, 14.9, -14.9, 360.0, -374.9] {
            assert_eq!(chosen(&near(3, "rocker", off), None), Ok(mode), "{off}");
        }
        for off in [15.1, -15.1, 180.0] {
            let refused = chosen(&near(3, "rocker", off), None).unwrap_err();
            let PlanarError::NoModeNear { at, what, .. } = &refused else {
                panic!("{refused}");
            };
            assert_eq!((&**at, *what), ("60 deg", "start.near"));
        }
        // All of the bodies have to be near.
        let both = |off: f64| format!("{}\n{}", near(2, "coupler", 0.0), near(3, "rocker", off));
        assert_eq!(chosen(&both(14.0), None), Ok(mode));
        assert!(chosen(&both(16.0), None).is_err());
        // A file's angles are not asked of a mode by number.
        assert_eq!(chosen(&near(3, "rocker", 180.0), Some(mode)), Ok(mode));
    }
    for (more, number) in [("", Some(2)), ("mode = 2", None)] {
        let due = "there is no branch 2 at 60 deg; there are 2, counted from 0";
        assert_eq!(chosen(more, number).unwrap_err().to_string(), due);
    }
    let listed = [0, 1].map(|k| {
        let [coupler, rocker] = [2, 3].map(|b| wrapped(line(k, b).to_radians()).to_degrees());
        format!("{k}: crank 60.000, coupler {coupler:.3}, rocker {rocker:.3} deg")
    });
    let due = format!(
        "which branch? there are {}; write --branch N, --all-branches, or start.near in the file",
        listed.join("; ")
    );
    assert_eq!(chosen("", None).unwrap_err().to_string(), due);
    // The only mode needs no choice.
    let one = choose(&geared([20, 20]), at, None).unwrap();
    assert_eq!((one.mode, one.modes), (0, 1));
}

#[test]
fn where_nothing_closes_is_told_with_where_it_does() {
    let refused = |machine: &Machine, at: f64| choose(machine, at, None).unwrap_err().to_string();
    let rocker = four_bar(DOUBLE_ROCKER, "");
    let due = "the mechanism cannot be assembled at 180 deg, but can be at 0 deg";
    assert_eq!(refused(&rocker, TAU / 2.0), due);
    // B comes no nearer to D than 1.95 m: from 58.4 deg on.
    let later = four_bar([2.0, 3.0, 1.05, 2.0], "");
    assert_eq!(
        refused(&later, 0.0),
        "the mechanism cannot be assembled at 0 deg, but can be at 59 deg"
    );
    let never = four_bar([1.0, 1.0, 1.0, 9.0], "");
    let due = "the mechanism cannot be assembled at 0 deg, nor at any of 360 values of the drive";
    assert_eq!(refused(&never, 0.0), due);
    // In steps of 1/360 of the range: 3.6 m to 0.0 m by a centimetre, from 0.484 m on.
    let boom = read(&BOOM.replace("[\"0.9 m\", \"1.4 m\"]", "[\"0 m\", \"3.6 m\"]"));
    assert_eq!(
        refused(&boom, 0.2),
        "the mechanism cannot be assembled at 0.2 m, but can be at 0.49 m"
    );
}
