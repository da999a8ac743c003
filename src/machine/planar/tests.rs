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

/// Its free angle is that between the lines of two bodies as columns show them, wherever these lie in the bodies' frames; off
/// that it turns back by its stiffness.
#[test]
fn a_torsion_spring_is_free_at_the_angle_that_is_shown() {
    let text = include_str!("../../../examples/watt-1.toml");
    let read = |more: &str| {
        let text = text.replace(
            "[drive]\n",
            &format!("{more}[drive]\nspeed = \"1 rad/s\"\n"),
        );
        Machine::read(&Source::toml(text)).unwrap()
    };
    let row = |machine: &Machine| {
        let at = machine.start.at.unwrap_or(0.0).to_radians();
        let branch = choose(machine, at, None).unwrap();
        let row = values(machine, &branch.start, Columns::default());
        let names = names(machine, Columns::default());
        move |name: &str| row[names.iter().position(|n| n == name).unwrap() - 2]
    };
    let shown = row(&read(""));
    for (body, from) in [
        ("coupler", "rocker"),
        ("FG", "coupler"),
        ("crank", "ground"),
    ] {
        let angle = |name| match name {
            "ground" => 0.0,
            _ => shown(&format!("{name}_deg")),
        };
        let between = angle(body) - angle(from);
        for off in [0.0, 10.0] {
            let spring = format!(
                "[[torsion_spring]]\nbody = \"{body}\"\nfrom = \"{from}\"\n\
                 stiffness = \"2 N m/rad\"\nangle = \"{:?} deg\"\n",
                between - off
            );
            let moment = row(&read(&spring))("M_o_N_m");
            let rate = |name| match name {
                "ground" => 0.0,
                _ => shown(&format!("omega_{name}_rad_per_s")),
            };
            let due = -2.0 * f64::to_radians(off) * (rate(body) - rate(from));
            assert!((moment - due).abs() < 1e-9, "{body} {from}: {moment} {due}");
        }
    }
}
