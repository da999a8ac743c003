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
    (digits.collect(), values(machine, state, Columns::default()))
}

fn assert_near(digits: &[Option<f64>], values: &[f64]) {
    assert!(digits.len() <= values.len() && !digits.is_empty());
    for (digits, value) in digits.iter().zip(values) {
        assert!((digits.unwrap() - value).abs() < 1e-9, "{digits:?} {value}");
    }
}

/// Angles are those of the bodies' frames where nothing is drawn, after any number of turns, and whatever body the
/// drive is measured from.
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

/// A slider's point and the one that its guide goes through may share a name: the slider is drawn with its own.
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

/// What each kind of load does along the drive, by virtual work from the velocities of its points and the rates of its bodies. All
/// bodies are drawn, so that the angles of their lines are not those of their frames.
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
