//! Tests of `loads` and of what else a mechanism's file says.

use super::*;

/// A crank on the ground and a wheel that turns twice as fast the other way.
fn text(crank: &str, wheel: &str, more: &str) -> String {
    let pins = ["O", "N"].map(|p| format!("[[joint]]\nkind = \"pin\"\npoint = \"{p}\"\n"));
    format!(
        "{more}\n[ground.points]\nO = [\"0 m\", \"0 m\"]\nN = [\"3 m\", \"1 m\"]\n\
         [[body]]\nname = \"crank\"\nends = [\"O\", \"A\"]\nlength = \"2 m\"\n{crank}\n\
         [[body]]\nname = \"wheel\"\nends = [\"N\", \"B\"]\nlength = \"1 m\"\n{wheel}\n{}\
         [[joint]]\nkind = \"gears\"\nwheels = [\"crank\", \"wheel\"]\nteeth = [20, 10]\n\
         [drive]\nbody = \"crank\"\n",
        pins.concat()
    )
}

fn read(text: &str) -> Result<Machine, Refusal> {
    Machine::read(&Source::toml(text))
}

const MASS: &str = "mass = \"3 kg\"\ncentre = [\"1 m\", \"-50 cm\"]";

/// A pendulum about its pivot: m r² and J, and the weight's moment; of the wheel four times and
/// twice as much.
#[test]
fn masses_are_those_of_their_bodies() {
    let (phi, g) = (0.7_f64, 9.80665);
    let inertia = "inertia = \"2 kg m^2\"";
    let heavy = [MASS, inertia].join("\n");
    // The moment of a unit weight in a direction at the centre (1, −0.5) m, turned by the angle.
    let lever = |angle: f64, down: f64| {
        let (x, y) = (
            angle.cos() + 0.5 * angle.sin(),
            angle.sin() - 0.5 * angle.cos(),
        );
        x * down.sin() - y * down.cos()
    };
    let below = -90f64.to_radians();
    let aside = 200f64.to_radians();
    let other = "gravity = \"2 m/s^2\"\ngravity_direction = \"200 deg\"";
    for (crank, wheel, more, reduced, moment) in [
        (MASS, "", "", 3.75, 3.0 * g * lever(phi, below)),
        (&*heavy, "", "", 5.75, 3.0 * g * lever(phi, below)),
        (
            &*heavy,
            "",
            "gravity = \"2 m/s^2\"",
            5.75,
            6.0 * lever(phi, below),
        ),
        (&*heavy, "", other, 5.75, 6.0 * lever(phi, aside)),
        ("", &*heavy, "", 23.0, -6.0 * g * lever(-2.0 * phi, below)),
        ("", MASS, other, 15.0, -12.0 * lever(-2.0 * phi, aside)),
        (
            MASS,
            &*heavy,
            "",
            26.75,
            3.0 * g * (lever(phi, below) - 2.0 * lever(-2.0 * phi, below)),
        ),
    ] {
        let machine = read(&text(crank, wheel, more)).unwrap();
        assert!(machine.has_loads());
        let state = &machine.solver.assembly_modes(phi).states[0];
        let found = machine
            .loads_on(state)
            .unwrap()
            .reduce(&machine.solver, state);
        assert!(
            (found.inertia - reduced).abs() < 1e-12,
            "{} {reduced}",
            found.inertia
        );
        assert!(
            (found.moment - moment).abs() < 1e-11,
            "{} {moment}",
            found.moment
        );
    }
    let none = read(&text("", "", "")).unwrap();
    let state = &none.solver.assembly_modes(phi).states[0];
    assert!(!none.has_loads() && none.loads_on(state).is_none());
    // A load without any mass, and over a table that is read in degrees of the drive.
    for (value, due) in [
        ("value = \"5 N m\"", 5.0),
        (
            "table = [[\"0 deg\", \"1 N m\"], [\"1 rad\", \"11 N m\"]]",
            8.0,
        ),
    ] {
        let torque = format!(
            "{}[[torque]]\nbody = \"crank\"\n{value}\n",
            text("", "", "")
        );
        let machine = read(&torque).unwrap();
        let found = machine
            .loads_on(state)
            .unwrap()
            .reduce(&machine.solver, state);
        assert!((found.moment - due).abs() < 1e-12 && found.inertia == 0.0);
    }
}

/// Tables over a displacement are in metres.
#[test]
fn tables_are_over_the_drive() {
    let boom = include_str!("../../../../examples/cylinder-boom.toml");
    let text = boom.replace(
        "value = \"2 kN\"",
        "table = [[\"90 cm\", \"1 kN\"], [\"1.4 m\", \"3 kN\"]]",
    );
    let [constant, table] = [boom, &text].map(|t| read(t).unwrap());
    let start = super::super::choose(&constant, 1.0, None).unwrap().start;
    // 2 kN half way.
    let state = constant.solver.follow(&start, 1.15).unwrap();
    let [a, b] = [&constant, &table].map(|m| m.loads_on(&state).unwrap().reduce(&m.solver, &state));
    assert!((a.moment - b.moment).abs() < 1e-9 && (a.inertia - b.inertia).abs() < 1e-12);
}

#[test]
fn loads_that_are_not_whole_are_refused() {
    let load = |section: &str| text("", "", "") + section;
    let inertia = "inertia = \"2 kg m^2\"";
    let value = "value = \"1 N m\"";
    let table = "table = [[\"0 deg\", \"1 N m\"]]";
    for (text, place, part) in [
        (
            text(inertia, "", ""),
            "body[0]",
            "inertia and centre need mass",
        ),
        (
            text("", "centre = [\"0 m\", \"0 m\"]", ""),
            "body[1]",
            "inertia and centre need mass",
        ),
        (
            text("", "mass = \"1 kg\"", ""),
            "body[1]",
            "mass needs centre, in the body's frame",
        ),
        (
            load("[[torque]]\nbody = \"crank\"\n"),
            "torque[0]",
            "torque[0] needs either value or table",
        ),
        (
            load(&format!("[[torque]]\nbody = \"crank\"\n{value}\n{table}\n")),
            "torque[0]",
            "torque[0] needs either value or table",
        ),
        (
            load("[[torque]]\nbody = \"crank\"\nvalue = \"1 N\"\n"),
            "torque[0].value",
            "torque[0].value = \"1 N\" is not a torque",
        ),
        (
            load("[[torque]]\nbody = \"crank\"\ntable = [[\"0 m\", \"1 N m\"]]\n"),
            "torque[0].table",
            "torque[0].table = \"0 m\" is not an angle",
        ),
        (
            load("[[torque]]\nbody = \"crank\"\ntable = [[\"0 deg\", \"1 N\"]]\n"),
            "torque[0].table",
            "torque[0].table = \"1 N\" is not a torque",
        ),
        (
            load(&format!("[[torque]]\nbody = \"cronk\"\n{value}\n")),
            "torque[0].body",
            "torque[0].body = \"cronk\" is no body",
        ),
        (
            load(&format!(
                "[[torque]]\nbody = \"crank\"\nfrom = \"x\"\n{value}\n"
            )),
            "torque[0].from",
            "torque[0].from = \"x\" is no body",
        ),
        (
            load("[[force]]\nat = \"A\"\ndirection = \"0 deg\"\nwith = \"x\"\nvalue = \"1 N\"\n"),
            "force[0].with",
            "force[0].with = \"x\" is no body",
        ),
        (
            load("[[force]]\nat = \"X\"\ndirection = \"0 deg\"\nvalue = \"1 N\"\n"),
            "force[0].at",
            "force[0].at = \"X\" is no point of a body",
        ),
        (
            load("[[damper]]\nends = [\"A\", \"X\"]\ndamping = \"1 N s/m\"\n"),
            "damper[0].ends",
            "damper[0].ends = \"X\" is no point of a body",
        ),
        (
            load(
                "[[torsion_spring]]\nbody = \"crank\"\nstiffness = \"1 N m/deg\"\nangle = \"0 deg\"\n",
            ),
            "torsion_spring[0].stiffness",
            "write it for each radian, for instance in N m/rad",
        ),
        (
            load("[[torsion_damper]]\nbody = \"x\"\ndamping = \"1 N m s\"\n"),
            "torsion_damper[0].body",
            "torsion_damper[0].body = \"x\" is no body",
        ),
    ] {
        let refused = read(&text).err().expect(part);
        assert!(refused.to_string().contains(part), "{refused}");
        assert_eq!(refused.place(), place, "{refused}");
    }
}

/// The section's angles, or the drawing's if it says nothing and all bodies are drawn.
#[test]
fn the_start_is_told_or_drawn() {
    let watt = include_str!("../../../../examples/watt-1.toml");
    let start = |section: &str| read(&format!("{watt}[start]\n{section}\n")).unwrap().start;
    let drawn = read(watt).unwrap();
    let line = 2f64.atan2(1.0);
    assert!(drawn.start.drawn && drawn.start.mode.is_none());
    assert_eq!(drawn.start.at, Some(line.to_degrees()));
    let near: Vec<usize> = drawn.start.near.iter().map(|n| n.0).collect();
    assert_eq!(near, [1, 2, 3, 4, 5]);
    assert!(drawn.start.near.iter().all(|(b, a)| *a == drawn.lines[*b]));
    // The user's drive is the angle of the line from A to B.
    assert_eq!(
        (drawn.inner(line), drawn.outer(0.0), drawn.rotary()),
        (0.0, line, true)
    );
    assert_eq!(drawn.drawing_text(), None);
    let at = start("at = \"30 deg\"");
    assert_eq!(
        (at.at, at.mode, at.near.len(), at.drawn),
        (Some(30.0), None, 0, false)
    );
    let mode = start("mode = 1");
    assert_eq!(
        (mode.at, mode.mode, mode.near.len(), mode.drawn),
        (None, Some(1), 0, false)
    );
    let near = start("near = { coupler = \"10 deg\" }");
    assert_eq!((near.at, near.mode, near.drawn), (None, None, false));
    assert_eq!(near.near, [(2, 10f64.to_radians())]);
    let both = format!("{watt}[start]\nmode = 1\nnear = {{ coupler = \"10 deg\" }}\n");
    let refused = read(&both).err().unwrap();
    assert_eq!(refused.place(), "start.mode");
    assert!(
        refused
            .to_string()
            .ends_with("start.mode and start.near exclude each other")
    );
    // One body that is not drawn.
    let part = watt.replace(
        "name = \"FG\"\ndrawn = [\"F\", \"G\"]",
        "name = \"FG\"\nends = [\"F\", \"G\"]\nlength = \"3 cm\"",
    );
    let part = read(&part).unwrap();
    assert!(part.start.at.is_none() && part.start.near.is_empty() && part.drawing.is_none());
    // A displacement is in metres, and nothing is added to it.
    let boom = read(include_str!("../../../../examples/cylinder-boom.toml")).unwrap();
    assert_eq!(
        (boom.inner(1.25), boom.outer(1.25), boom.rotary()),
        (1.25, 1.25, false)
    );
    assert_eq!(boom.start.at, Some(1.0));
}

/// Where a file has no joints its bodies are at fault.
#[test]
fn what_cannot_be_solved_is_refused_at_its_joints() {
    let loose = "[[body]]\nname = \"bar\"\npoints = { A = [\"0 m\", \"0 m\"], B = [\"1 m\", \"0 m\"] }\n\
                 [[body]]\nname = \"rod\"\npoints = { C = [\"0 m\", \"0 m\"] }\n[drive]\nbody = \"bar\"\n";
    let held =
        format!("{loose}[[joint]]\nkind = \"pin\"\npoint = \"A\"\n").replace("{ C =", "{ A =");
    for (text, place) in [(loose, "body"), (&held, "joint")] {
        assert_eq!(read(text).err().unwrap().place(), place);
    }
}
