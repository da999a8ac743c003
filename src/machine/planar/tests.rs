//! Tests of mechanisms: rows certified, positions in motion, what is said of them.

use super::*;
use crate::reference::planar::{Drawing, DrawnPin, Frame};
use crate::solvers::planar::State;
use rug::Rational;
use std::f64::consts::TAU;

/// A four-bar linkage on the pivots A and D, whose coupler lies along the second axis of its frame.
fn four_bar(lengths: [&str; 4], more: &str) -> Machine {
    let [crank, coupler, rocker, frame] = lengths;
    let pins =
        ["A", "B", "C", "D"].map(|p| format!("[[joint]]\nkind = \"pin\"\npoint = \"{p}\"\n"));
    let text = format!(
        "type = \"planar\"\n\
         [ground.points]\nA = [\"0 m\", \"0 m\"]\nD = [\"{frame}\", \"0 m\"]\n\
         [[body]]\nname = \"crank\"\nends = [\"A\", \"B\"]\nlength = \"{crank}\"\n\
         [[body]]\nname = \"coupler\"\n\
         points = {{ B = [\"0 m\", \"0 m\"], C = [\"0 m\", \"{coupler}\"] }}\n\
         [[body]]\nname = \"rocker\"\n\
         points = {{ C = [\"{rocker}\", \"0 m\"], D = [\"0 m\", \"0 m\"] }}\n\
         {}[drive]\nbody = \"crank\"\n{more}",
        pins.concat()
    );
    Machine::read(&Source::toml(text)).unwrap()
}

const CRANK_ROCKER: [&str; 4] = ["1 m", "3 m", "3 m", "4 m"];

/// Digits of a row at an angle in degrees, and the solver's row.
fn row(machine: &Machine, degrees: i32, state: &State) -> (Vec<Option<f64>>, Vec<f64>) {
    let certifier = Certifier::new(machine, 20).unwrap();
    let digits = certifier.values(&Rational::from(degrees), state, false);
    let digits = digits
        .iter()
        .map(|d| d.as_ref().map(|d| d.parse().unwrap()));
    (
        digits.collect(),
        values(machine, None, state, Columns::default()),
    )
}

fn assert_near(digits: &[Option<f64>], values: &[f64]) {
    assert!(digits.len() <= values.len() && !digits.is_empty());
    for (digits, value) in digits.iter().zip(values) {
        assert!((digits.unwrap() - value).abs() < 1e-9, "{digits:?} {value}");
    }
}

/// Angles are those of the bodies' frames where nothing is drawn, after any number of turns, and
/// whatever body the drive is measured from.
#[test]
fn certified_rows_are_those_of_the_solver() {
    for (from, mode) in [("", 0), ("", 1), ("from = \"rocker\"\n", 0)] {
        let machine = four_bar(CRANK_ROCKER, from);
        let branch = choose(&machine, 40f64.to_radians(), Some(mode)).unwrap();
        let there = machine.inner(40f64.to_radians() + TAU);
        let further = machine.solver.follow(&branch.start, there).unwrap();
        for state in [&branch.start, &further] {
            for degrees in [40, 400] {
                let (digits, values) = row(&machine, degrees, state);
                assert_near(&digits, &values);
            }
        }
    }
}

#[test]
fn a_row_that_is_not_proved_has_all_its_columns() {
    let machine = four_bar(CRANK_ROCKER, "");
    let branch = choose(&machine, 40f64.to_radians(), Some(0)).unwrap();
    let (digits, _) = row(&machine, 90, &branch.start);
    assert_eq!(
        digits,
        vec![None; certified_names(&machine, false).len() - 2]
    );
}

#[test]
fn a_motion_goes_through_the_turns_after_which_it_closes() {
    let machine = four_bar(CRANK_ROCKER, "");
    let branch = choose(&machine, 1.0, Some(0)).unwrap();
    assert_eq!(branch.reach, Reach::Whole { turns: Some(1) });
    for (turns, due) in [(Some(1), 1.0), (Some(3), 3.0), (None, 1.0)] {
        let reach = Reach::Whole { turns };
        let branch = Branch {
            reach,
            ..branch.clone()
        };
        let (all, shown) = positions(&machine, &branch, 4, &branch.start);
        assert_eq!((all.len(), shown), (4, 0));
        for (k, (drive, _)) in all.iter().enumerate() {
            assert!((drive - 1.0 - k as f64 * due * TAU / 4.0).abs() < 1e-12);
        }
    }
}

/// A slider's point and the one that its guide goes through may share a name: the slider is drawn
/// with its own.
#[test]
fn bodies_are_drawn_through_their_own_points() {
    let pins = ["A", "B", "C"].map(|p| format!("[[joint]]\nkind = \"pin\"\npoint = \"{p}\"\n"));
    let text = format!(
        "type = \"planar\"\n\
         [ground.points]\nA = [\"0 m\", \"0 m\"]\nS = [\"1 m\", \"0 m\"]\n\
         [[body]]\nname = \"crank\"\nends = [\"A\", \"B\"]\nlength = \"1 m\"\n\
         [[body]]\nname = \"rod\"\nends = [\"B\", \"C\"]\nlength = \"3 m\"\n\
         [[body]]\nname = \"slider\"\npoints = {{ C = [\"0 m\", \"0 m\"], S = [\"0.5 m\", \"0 m\"] }}\n\
         {}[[joint]]\nkind = \"slide\"\nbody = \"slider\"\npoint = \"S\"\non = \"ground\"\nthrough = \"S\"\n\
         direction = \"0 deg\"\n[drive]\nbody = \"crank\"\n",
        pins.concat()
    );
    let machine = Machine::read(&Source::toml(text)).unwrap();
    let branch = choose(&machine, 1.0, Some(0)).unwrap();
    let (all, shown) = positions(&machine, &branch, 8, &branch.start);
    let drawn = motion(&machine, &all, shown, true);
    assert_eq!(drawn.links.len(), 3);
    for (outline, link) in machine.outlines[1..].iter().zip(&drawn.links) {
        for ((name, point), end) in outline.iter().zip(link) {
            for (k, (_, state)) in all.iter().enumerate() {
                let due = machine.solver.point(state, point).r;
                let at = drawn.points[*end].at(k);
                let apart = (at[0] - due[0]).hypot(at[1] - due[1]);
                assert!(apart < 1e-9, "{name} at {k}: {at:?} {due:?}");
            }
        }
    }
}

#[test]
fn where_the_loops_close_elsewhere_is_said_from_the_first_angle_on() {
    let machine = four_bar(["3 m", "1 m", "1 m", "3.9 m"], "");
    let refused = choose(&machine, TAU / 2.0, None).unwrap_err().to_string();
    let due = "the mechanism cannot be assembled at 180 deg, but can be at 0 deg";
    assert_eq!(refused, due);
}

#[test]
fn a_drawing_without_redundant_equations_names_no_strained_bodies() {
    let pin = DrawnPin {
        frames: [Frame::Ground, Frame::Body(0)],
        at: [Rational::new(), Rational::new()],
    };
    let freedom = Drawing::new(1, vec![pin]).unwrap().freedom();
    let due = "as drawn, proved: rank 2 of 2 equations for 3 velocities, one degree of freedom";
    let bodies = ["ground", "bar"].map(String::from);
    assert_eq!(drawn::words(&freedom, &bodies), due);
}

/// Each kind of load along the drive, by virtual work from the velocities of its points
/// and the rates of its bodies. All bodies are drawn, so that the angles of their lines are not
/// those of their frames.
#[test]
fn loads_work_along_the_motion() {
    let text = include_str!("../../../examples/watt-1.toml");
    let read = |from: &str, to: &str| {
        let text = text.replacen(from, to, 1);
        Machine::read(&Source::toml(text)).unwrap()
    };
    let machine = read("", "");
    let at = machine.start.at.unwrap().to_radians();
    let start = choose(&machine, at, None).unwrap().start;
    let number = |name: &str| machine.bodies.iter().position(|b| b == name).unwrap();
    let turn = |name: &str| machine.solver.body_angle(&start, number(name)).first;
    let line = |name: &str| machine.line(&start, number(name));
    let point = |name: &str| {
        let (_, point) = machine.points.iter().find(|p| p.0 == name).unwrap();
        let motion = machine.solver.point(&start, point);
        (motion.r, motion.first)
    };
    let along = |name: &str, degrees: f64| {
        let (_, [x, y]) = point(name);
        let (sin, cos) = degrees.to_radians().sin_cos();
        x * cos + y * sin
    };
    // From the pivot A, which is the origin.
    let [distance, parting] = {
        let ([x, y], [u, v]) = point("E");
        [x.hypot(y), (x * u + y * v) / x.hypot(y)]
    };
    let relative = turn("coupler") - turn("rocker");
    let free = line("coupler") - line("rocker") - 0.25;
    let spring = format!(
        "[[torsion_spring]]\nbody = \"coupler\"\nfrom = \"rocker\"\nstiffness = \"2 N m/rad\"\nangle = \"{free:?} rad\"\n"
    );
    let grounded = format!(
        "[[torsion_spring]]\nbody = \"FG\"\nstiffness = \"2 N m/rad\"\nangle = \"{:?} rad\"\n",
        line("FG") + 0.5
    );
    let between = at.to_degrees() / 90.0;
    for (load, moment, damping) in [
        (
            "[[force]]\nat = \"E\"\ndirection = \"30 deg\"\nvalue = \"5 N\"\n",
            5.0 * along("E", 30.0),
            0.0,
        ),
        // Frames lie as they are drawn.
        (
            "[[force]]\nat = \"rocker.F\"\nwith = \"rocker\"\ndirection = \"-50 deg\"\nvalue = \"4 N\"\n",
            4.0 * along("F", -50.0),
            0.0,
        ),
        (
            "[[force]]\nat = \"G\"\ndirection = \"0 deg\"\ntable = [[\"0 deg\", \"2 N\"], [\"90 deg\", \"6 N\"]]\n",
            (2.0 + 4.0 * between) * along("G", 0.0),
            0.0,
        ),
        (
            "[[torque]]\nbody = \"coupler\"\nfrom = \"rocker\"\nvalue = \"3 N m\"\n",
            3.0 * relative,
            0.0,
        ),
        (
            "[[torque]]\nbody = \"FG\"\ntable = [[\"0 deg\", \"1 N m\"], [\"90 deg\", \"-1 N m\"]]\n",
            (1.0 - 2.0 * between) * turn("FG"),
            0.0,
        ),
        (
            "[[spring]]\nends = [\"ground.A\", \"E\"]\nstiffness = \"100 N/m\"\nlength = \"2 cm\"\n",
            -100.0 * (distance - 0.02) * parting,
            0.0,
        ),
        (&spring, -2.0 * 0.25 * relative, 0.0),
        (&grounded, 2.0 * 0.5 * turn("FG"), 0.0),
        (
            "[[damper]]\nends = [\"ground.A\", \"E\"]\ndamping = \"7 N s/m\"\n",
            0.0,
            7.0 * parting * parting,
        ),
        (
            "[[torsion_damper]]\nbody = \"coupler\"\nfrom = \"rocker\"\ndamping = \"3 N m s\"\n",
            0.0,
            3.0 * relative * relative,
        ),
    ] {
        let machine = read("[drive]\n", &format!("{load}[drive]\n"));
        let found = machine.loads.unwrap().reduce(&machine.solver, &start);
        for (found, due) in [(found.moment, moment), (found.damping, damping)] {
            assert!((found - due).abs() < 1e-12, "{load}{found}, due {due}");
        }
    }
    let body = "name = \"EG\"\n";
    let weight = format!(
        "{body}mass = \"3 kg\"\ninertia = \"0.002 kg m^2\"\ncentre = [\"3 cm\", \"2 cm\"]\n"
    );
    let down = read(body, &weight);
    let aside = format!(
        "gravity = \"2 m/s^2\"\ngravity_direction = \"10 deg\"\n{}",
        text.replacen(body, &weight, 1)
    );
    let aside = Machine::read(&Source::toml(aside)).unwrap();
    for (machine, due) in [
        (down, 3.0 * 9.80665 * along("G", -90.0)),
        (aside, 3.0 * 2.0 * along("G", 10.0)),
    ] {
        let found = machine.loads.unwrap().reduce(&machine.solver, &start);
        assert!((found.moment - due).abs() < 1e-12, "{} {due}", found.moment);
        let (_, [x, y]) = point("G");
        let inertia = 3.0 * (x * x + y * y) + 0.002 * turn("EG").powi(2);
        assert!((found.inertia - inertia).abs() < 1e-12);
    }
}

/// The examples' mechanisms with a torsion spring between two bodies in place of their loads.
fn sprung(text: &str, [body, from]: [&str; 2], free: f64) -> Machine {
    let spring = format!(
        "[[torsion_spring]]\nbody = \"{body}\"\nfrom = \"{from}\"\nstiffness = \"2 N m/rad\"\nangle = \"{free:?} rad\"\n"
    );
    let text = text.replacen("[drive]\n", &format!("{spring}[drive]\n"), 1);
    Machine::read(&Source::toml(text)).unwrap()
}

/// A spring's moment for the turn of its bodies against each other: stiffness times the angle by
/// which it is wound.
fn wound(machine: &Machine, loads: &Loads, state: &State, [body, from]: [usize; 2]) -> f64 {
    let turn = |b: usize| machine.solver.body_angle(state, b).first;
    -loads.reduce(&machine.solver, state).moment / (2.0 * (turn(body) - turn(from)))
}

/// A spring that is free as rows show a mode is free there, whichever side of ±180° the lines lie
/// on, and whole turns count from there on: wherever on the branch it is first seen, the spring is
/// wound alike.
#[test]
fn torsion_springs_are_wound_from_the_start_of_their_branch() {
    let text = include_str!("../../../examples/watt-1.toml");
    let plain = Machine::read(&Source::toml(text)).unwrap();
    let number = |name: &str| plain.bodies.iter().position(|b| b == name).unwrap();
    let start = plain.inner(plain.start.at.unwrap().to_radians());
    let modes = plain.solver.assembly_modes(start).states;
    assert_eq!(modes.len(), 4);
    let shown = |state: &State, body: usize| {
        let line = plain.line(state, body);
        line - TAU * (line / TAU).round()
    };
    let mut turned = 0;
    for pair in [
        ["coupler", "rocker"],
        ["rocker", "coupler"],
        ["EG", "FG"],
        ["FG", "coupler"],
        ["EG", "rocker"],
    ] {
        let [body, from] = pair.map(number);
        for mode in &modes {
            let free = shown(mode, body) - shown(mode, from) - 0.25;
            let machine = sprung(text, pair, free);
            let loads = machine.loads_on(mode).unwrap();
            let at = wound(&machine, &loads, mode, [body, from]);
            assert!((at - 0.25).abs() < 1e-12, "{pair:?} wound by {at}");
            let as_read = machine.loads.as_ref().unwrap();
            turned += usize::from((wound(&machine, as_read, mode, [body, from]) - at).abs() > 6.0);
            // Seen first at another drive, within half a turn either way.
            for away in [-170.0_f64, -90.0, 60.0, 170.0] {
                let drive = start + away.to_radians();
                let (there, error) = machine.solver.follow_as_far(mode, drive);
                if error.is_some() {
                    continue;
                }
                let due = wound(&machine, &loads, &there, [body, from]);
                let same = |s: &State| {
                    let apart = (1..machine.bodies.len()).map(|b| shown(s, b) - shown(&there, b));
                    apart.fold(0.0, |m: f64, a| m.max((a - TAU * (a / TAU).round()).abs())) < 1e-9
                };
                let seen = machine.solver.assembly_modes(drive).states;
                let seen = seen.iter().find(|s| same(s)).unwrap();
                let loads = machine.loads_on(seen).unwrap();
                let found = wound(&machine, &loads, seen, [body, from]);
                assert!(
                    (found - due).abs() < 1e-9,
                    "{pair:?} {away}: {found}, due {due}"
                );
            }
        }
    }
    assert!(turned > 0, "no mode has a line on the other side");
}

/// A crank that swings from 41.4° over 180° to 318.6°: the start may be met the long way round, or
/// not at all.
#[test]
fn a_branch_with_ends_counts_turns_from_its_start_or_its_lower_end() {
    let spring =
        "[[torsion_spring]]\nbody = \"crank\"\nstiffness = \"2 N m/rad\"\nangle = \"0 deg\"\n";
    for (start, drive, due) in [
        // By the short way over the fold at 318.6° there is nothing: from 60° on to 300°, shown as
        // −60°.
        (300.0, 60.0, -300.0),
        (300.0, -170.0, -170.0),
        (60.0, 290.0, 290.0),
        (60.0, -70.0, 290.0),
        (180.0, 200.0, 200.0),
        // A start at which the loop does not close.
        (10.0, 60.0, 60.0),
        (10.0, 200.0, 200.0),
        (10.0, -160.0, 200.0),
    ] {
        let more = format!("{spring}[start]\nat = \"{start} deg\"\n");
        let machine = four_bar(["2 m", "4 m", "2 m", "3 m"], &more);
        for mode in &machine.solver.assembly_modes(f64::to_radians(drive)).states {
            let loads = machine.loads_on(mode).unwrap();
            let found = wound(&machine, &loads, mode, [1, 0]).to_degrees();
            assert!(
                (found - due).abs() < 1e-9,
                "{start} {drive}: {found}, due {due}"
            );
        }
    }
    // Coupler and rocker, from wherever on the branch; with the pivots exchanged their lines pass
    // 180 degrees.
    let at = f64::to_radians;
    let mut crossed = 0;
    for (frame, shift) in [("3 m", 0.0), ("-3 m", 180.0)] {
        for (body, name) in [(2, "coupler"), (3, "rocker")] {
            for start in [45.0, 90.0, 130.0, 230.0, 315.0].map(|d| d + shift) {
                let spring = spring.replace("crank", name);
                let more = format!("{spring}[start]\nat = \"{start} deg\"\n");
                let machine = four_bar(["2 m", "4 m", "2 m", frame], &more);
                let solver = &machine.solver;
                let line = |drive: f64, state: &State| {
                    machine.line(&solver.follow(state, at(drive)).unwrap(), body)
                };
                let turns = |angle: f64| (angle / TAU).round();
                for drive in [42.0, 100.0, 180.0, 260.0, 318.0].map(|d| d + shift) {
                    for mode in &solver.assembly_modes(at(drive)).states {
                        let begun = line(start, mode);
                        let due = line(drive, mode) - TAU * turns(begun);
                        let loads = machine.loads_on(mode).unwrap();
                        let found = wound(&machine, &loads, mode, [body, 0]);
                        assert!(
                            (found - due).abs() < 1e-9,
                            "{name} {start} {drive}: {found}, due {due}"
                        );
                        let low = line(41.5 + shift, mode);
                        crossed += usize::from(turns(low) != turns(begun));
                    }
                }
            }
        }
    }
    assert!(
        crossed > 0,
        "nothing passes 180 degrees between the lower end and a start"
    );
    // By displacement from the range's beginning, or from where the file says.
    let text = include_str!("../../../examples/cylinder-boom.toml");
    let (text, _) = text.split_once("[[force]]").unwrap();
    for (start, first) in [("", 0.9), ("[start]\nat = \"1 m\"\n", 1.0)] {
        let text = format!("{text}{start}").replacen("9.81 m/s^2", "0 m/s^2", 1);
        let plain = Machine::read(&Source::toml(&*text)).unwrap();
        let solver = &plain.solver;
        for start in solver.assembly_modes(first).states {
            let end = solver.follow(&start, 1.4).unwrap();
            for body in 1..plain.bodies.len() {
                let line = |state: &State| plain.line(state, body);
                let free = line(&start) - TAU * (line(&start) / TAU).round();
                let machine = sprung(&text, [&plain.bodies[body], "ground"], free);
                let loads = machine.loads_on(&end).unwrap();
                let found = wound(&machine, &loads, &end, [body, 0]);
                let due = line(&end) - line(&start);
                assert!((found - due).abs() < 1e-9, "{found}, due {due}");
            }
        }
    }
}
