use super::*;
use mechaudit_symbolic::evaluation::{Balls, Evaluator, Value};
use std::sync::Arc;

pub(super) const EXAMPLES: [(&str, &str); 5] = [
    (
        "four-bar-damped",
        include_str!("../../../../examples/motion/four-bar-damped.toml"),
    ),
    (
        "four-bar-spring",
        include_str!("../../../../examples/motion/four-bar-spring.toml"),
    ),
    (
        "slider-crank-damped",
        include_str!("../../../../examples/motion/slider-crank-damped.toml"),
    ),
    (
        "double-pendulum",
        include_str!("../../../../examples/motion/double-pendulum.toml"),
    ),
    (
        "watt-six-bar",
        include_str!("../../../../examples/motion/watt-six-bar.toml"),
    ),
];

fn read(text: &str) -> Moving {
    Moving::read(&Source::toml(text)).unwrap_or_else(|e| panic!("{e}"))
}

fn refused(text: &str) -> String {
    match Moving::read(&Source::toml(text)) {
        Ok(moving) => match moving.assembly() {
            Ok(_) => "read".into(),
            Err(e) => e.to_string(),
        },
        Err(e) => e.to_string(),
    }
}

/// Starts, and rates at the start, of the equations in formulas, by balls.
fn at_start(moving: &Moving) -> (Vec<String>, Vec<[f64; 2]>) {
    let row = Row::Motion { reactions: false };
    let equations = moving.equations(&row).unwrap();
    let (graph, nodes, _) = equations.graph().unwrap();
    let graph = Arc::new(graph);
    let ball = |evaluator: &mut Evaluator<Balls>, id| {
        let value = evaluator
            .value(id)
            .unwrap_or_else(|e| panic!("{e:?}: {}", graph.text(e.node)));
        value.real().unwrap().clone()
    };
    let mut evaluator = Evaluator::new(graph.clone(), Balls::new(128));
    let starts: Vec<_> = nodes.iter().map(|n| ball(&mut evaluator, n.0)).collect();
    let mut evaluator = Evaluator::new(graph.clone(), Balls::new(128));
    evaluator.set_input(0, Value::Real(crate::reference::Ball::integer(128, 0)));
    for (k, start) in starts.iter().enumerate() {
        let is_zero = start.contains_zero() && start.rad().to_f64() < 1e-27;
        assert!(start.accuracy_bits() > 90 || is_zero, "{start:?}");
        evaluator.set_input(k + 1, Value::Real(start.clone()));
    }
    let rates = nodes.iter().map(|n| ball(&mut evaluator, n.1).to_f64());
    let pairs = starts
        .iter()
        .zip(rates)
        .map(|(s, r)| [s.to_f64(), r])
        .collect();
    (
        equations.states.into_iter().map(|s| s.name).collect(),
        pairs,
    )
}

fn first(moving: &Moving) -> Moment {
    let mut first = None;
    moving
        .run(&[0.0], Settings::default(), |m| first = Some(m.clone()))
        .unwrap();
    first.unwrap()
}

/// The formulas give the positions, velocities and accelerations that the solver finds by its own
/// kinematics.
fn assert_agree(name: &str, moving: &Moving) {
    let moment = first(moving);
    let (names, pairs) = at_start(moving);
    let quantities = moving.quantities(false).unwrap();
    let values = moving.values(&moment, false);
    let mut compared = 0;
    for (state, [start, rate]) in names.iter().zip(&pairs) {
        let Some(k) = quantities.iter().position(|q| q.name == *state) else {
            continue;
        };
        let size = values[k].abs().max(1.0);
        assert!(
            (start - values[k]).abs() < 1e-12 * size,
            "{name}: {state} {start} {}",
            values[k]
        );
        let Some(body) = (1..moving.bodies.len()).find(|b| moving.names.of_body(*b)[1] == *state)
        else {
            continue;
        };
        let due = moving.dynamics.angle(&moment, body)[2];
        assert!(
            (rate - due).abs() < 1e-10 * due.abs().max(1.0),
            "{name}: {state} {rate} {due}"
        );
        compared += 1;
    }
    assert!(compared > 0, "{name}");
}

#[test]
fn formulas_and_solver_agree_at_the_start() {
    for (name, text) in EXAMPLES {
        assert_agree(name, &read(text));
    }
}

/// Loads of every kind, gears and a rack.
#[test]
fn formulas_and_solver_agree_under_every_load() {
    let more = r#"
        [[force]]
        at = "B"
        direction = "30 deg"
        with = "coupler"
        value = "5 N"
        [[torque]]
        body = "rocker"
        from = "coupler"
        value = "-2 N m"
        [[torsion_spring]]
        body = "coupler"
        from = "crank"
        stiffness = "3 N m/rad"
        angle = "20 deg"
        [[damper]]
        ends = ["coupler.B", "O"]
        damping = "7 N s/m"
        [[spring]]
        ends = ["coupler.B", "O"]
        stiffness = "50 N/m"
        length = "0 m"
        [[motion.force]]
        at = "crank.A"
        x = "3*cos(theta_rocker)"
        y = "-s*omega_coupler"
        [motion.parameters]
        s = "1/3"
        [drive]
        body = "crank"
        [motor]
        kind = "kloss"
        synchronous_speed = "10 rad/s"
        rated_torque = "20 N m"
        overload = 2.2
        rated_slip = 0.05
        ratio = 2.5
        rotor_inertia = "0.001 kg m^2"
        [load]
        viscous = "0.3 N m s"
    "#;
    let text = format!("{}\n{more}", EXAMPLES[0].1);
    assert_agree("every load", &read(&text));
}

/// A crank whose pin slides in a turning lever, and a wheel that the crank turns through gears: a
/// displacement without inertia of its own, and a coordinate that follows from another.
const LEVER: &str = r#"
    type = "planar"
    [ground]
    points = { O = ["0 m", "0.12 m"], Q = ["0 m", "0 m"], W = ["-0.1 m", "0.12 m"] }
    [[body]]
    name = "crank"
    ends = ["O", "A"]
    length = "5 cm"
    mass = "0.5 kg"
    inertia = "0.0002 kg m^2"
    centre = ["1 cm", "0 cm"]
    [[body]]
    name = "lever"
    ends = ["Q", "B"]
    length = "24 cm"
    mass = "0.8 kg"
    inertia = "0.004 kg m^2"
    centre = ["12 cm", "1 cm"]
    [[body]]
    name = "wheel"
    ends = ["W", "P"]
    length = "3 cm"
    mass = "0.3 kg"
    inertia = "0.0001 kg m^2"
    centre = ["1 cm", "0 cm"]
    [[joint]]
    kind = "pin"
    point = "O"
    [[joint]]
    kind = "pin"
    point = "Q"
    [[joint]]
    kind = "pin"
    point = "W"
    [[joint]]
    kind = "slot"
    name = "slot"
    point = "A"
    body = "crank"
    on = "lever"
    through = "Q"
    toward = "B"
    [[joint]]
    kind = "gears"
    wheels = ["crank", "wheel"]
    teeth = [20, 30]
    phase = "10 deg"
    [[torsion_damper]]
    body = "lever"
    damping = "0.1 N m s"
    [[motion.torque]]
    body = "wheel"
    formula = "s_slot*v_slot - 0.1*theta_wheel"
    [motion.start]
    crank = { at = "40 deg", speed = "6 rad/s" }
    [motion.near]
    lever = "76 deg"
    wheel = "-17 deg"
"#;

#[test]
fn formulas_and_solver_agree_on_slides() {
    assert_agree("lever", &read(LEVER));
    // From the lever's angle, which the loop does not give alone.
    let other = LEVER.replace(
        "crank = { at = \"40 deg\", speed = \"6 rad/s\" }",
        "lever = { at = \"75 deg\", speed = \"1 rad/s\" }",
    );
    let other = other.replace("lever = \"76 deg\"", "crank = \"35 deg\"");
    assert_agree("lever from its own angle", &read(&other));
}

#[test]
fn bad_files_have_one_clear_line() {
    let bar = EXAMPLES[0].1;
    let crank = EXAMPLES[2].1;
    for (text, due) in [
        (bar.replace("60 deg", "60 kg"), "is not an angle"),
        (
            bar.replace("[motion.near]\nrocker = \"82 deg\"", ""),
            "which position? there are",
        ),
        (
            bar.replace("82 deg", "10 deg"),
            "no position at the start has its bodies within 15 deg",
        ),
        (
            bar.replace("crank = { at", "rocker = { at")
                .replace("60 deg", "0 deg"),
            "cannot be assembled",
        ),
        (
            bar.replace("crank = { at", "crnk = { at"),
            "did you mean \"crank\"?",
        ),
        (
            bar.replace(
                "[motion.start]\ncrank = { at = \"60 deg\", speed = \"3 rad/s\" }",
                "",
            ),
            "motion.start is missing",
        ),
        (
            bar.replace("mass = ", "# mass = ")
                .replace("inertia = ", "# ")
                .replace("centre = ", "# "),
            "no body has a mass",
        ),
        (
            crank.replace("omega_crank", "omega_crnk"),
            "motion.torque[0].formula",
        ),
        (
            crank.replace("omega_crank", "omega_crnk"),
            "the names are t, theta_crank, omega_crank",
        ),
        (
            crank.replace("amplitude*sin(5*t)", "sin("),
            "motion.torque[0].formula",
        ),
        (
            EXAMPLES[3].1.replace("lower = { at", "# lower = { at"),
            "has 2 degrees of freedom, and the start gives 1",
        ),
    ] {
        let found = refused(&text);
        assert!(found.contains(due), "{due:?}: {found:?}");
        assert!(!found.contains('\n'));
    }
}

/// The certified quantities at a time.
fn certified(moving: &Moving, row: &Row, time: (i32, i32)) -> CertifiedMoment {
    let mut certified = Certified::new(moving, 15, row).unwrap_or_else(|e| panic!("{e}"));
    certified.at(&rug::Rational::from(time))
}

/// All quantities with the forces in the joints, which the solver finds from the tree of bodies and
/// the formulas from all bodies at once.
fn assert_same_forces(name: &str, moving: &Moving) {
    let quantities = moving.quantities(true).unwrap();
    let due = moving.values(&first(moving), true);
    let found = certified(moving, &Row::Motion { reactions: true }, (0, 1));
    assert_eq!(found.reason, None, "{name}");
    assert_eq!(
        (due.len(), found.digits.len()),
        (quantities.len(), due.len())
    );
    let size = due.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    for ((q, due), found) in quantities.iter().zip(&due).zip(&found.digits) {
        let found: f64 = found.as_deref().unwrap().parse().unwrap();
        assert!(
            (found - due).abs() < 1e-10 * size,
            "{name}: {} {found} {due}",
            q.name
        );
    }
}

#[test]
fn forces_in_joints_are_those_of_the_solver() {
    for (name, text) in EXAMPLES {
        assert_same_forces(name, &read(text));
    }
    let gears = LEVER.find("[[joint]]\n    kind = \"gears\"").unwrap();
    let end = LEVER.find("[[torsion_damper]]").unwrap();
    let tooth = read(LEVER).quantities(true).unwrap_err().to_string();
    assert!(tooth.contains("is a gear or rack"), "{tooth}");
    let wheel = LEVER.find("[[body]]\n    name = \"wheel\"").unwrap();
    let after = LEVER
        .find("[[joint]]\n    kind = \"pin\"\n    point = \"O\"")
        .unwrap();
    let lever = [&LEVER[..wheel], &LEVER[after..gears], &LEVER[end..]].concat();
    let lever = lever
        .replace("[[joint]]\n    kind = \"pin\"\n    point = \"W\"", "")
        .replace("body = \"wheel\"", "body = \"lever\"")
        .replace("theta_wheel", "theta_lever")
        .replace("wheel = \"-17 deg\"", "");
    assert_same_forces("lever", &read(&lever));
    for text in [
        include_str!("../../../../examples/sand-screen-rotor.toml"),
        include_str!("../../../../examples/four-bar-run-up.toml"),
    ] {
        let moving = text.replace("constant = \"2 N m\"", "");
        assert_same_forces("a machine", &read(&moving));
    }
}

/// Names that are longer than those of the algebra.
#[test]
fn names_may_be_long() {
    let text = EXAMPLES[2]
        .1
        .replace("crank", "crank_of_a_press_with_a_flywheel");
    let moving = read(&text);
    let row = Row::Motion { reactions: false };
    let due = certified(&read(EXAMPLES[2].1), &row, (1, 20));
    assert_eq!(certified(&moving, &row, (1, 20)), due);
    assert_eq!(due.reason, None);
}

/// The certified end is that found in floating point; a switch of the motor's table comes before
/// it.
#[test]
fn the_end_of_a_motion_is_certified() {
    let text = include_str!("../../../../examples/four-bar-run-up.toml");
    let text = text.replace("constant = \"2 N m\"", "");
    let text = text.replace(
        "points = [\n",
        "points = [[\"-9 rpm\", \"3 N m\"], [\"100 rpm\", \"3.2 N m\"],\n",
    );
    let text = text.replace("[\"0 rpm\", \"3 N m\"],", "");
    let moving = read(&text);
    let row = Row::RunUp {
        target: Some("4".into()),
    };
    let found = certified(&moving, &row, (2, 5));
    let ended = found.ended.unwrap();
    let mut last = None;
    let times: Vec<f64> = (0..=16000).map(|k| f64::from(k) * 2.5e-5).collect();
    moving
        .run(&times, Settings::default(), |m| {
            let [_, speed, _] = moving.dynamics.angle(m, 1);
            if speed < 4.0 {
                last = Some((m.time, speed));
            }
        })
        .unwrap();
    let (before, speed) = last.unwrap();
    assert!(
        speed > 3.9 && (ended.to_f64() - before) < 2.6e-5 && ended > before,
        "{ended} {before}"
    );
    let digits: Vec<f64> = found
        .digits
        .iter()
        .map(|d| d.as_deref().unwrap().parse().unwrap())
        .collect();
    assert!((digits[1] - 4.0).abs() < 1e-12, "{digits:?}");
    // It has not ended a moment before.
    let early = rug::Rational::from_f64(before).unwrap();
    let mut motion = Certified::new(&moving, 15, &row).unwrap();
    assert_eq!(motion.at(&early).ended, None);
}

/// The digits of all quantities at a time.
fn digits_at(motion: &mut Certified, time: (i32, i32)) -> Vec<String> {
    let found = motion.at(&rug::Rational::from(time));
    assert_eq!(found.reason, None, "{time:?}");
    let digits = found.digits.iter().map(|d| d.as_deref().unwrap());
    digits.map(String::from).collect()
}

/// A wheel that a resistance of 2 N m holds until a torque of 8 N m/s times t overcomes it, and
/// again after the torque has ended: `0.5 ω̇ = 8 t − 2` from 1/4 s to 1 s, `14 − 8 t` to 2 s, and −2
/// to 33/8 s.
#[test]
fn a_resistance_holds_a_wheel_frees_and_stops_it() {
    let text = |end: &str| {
        format!(
            r#"
        type = "planar"
        [ground]
        points = {{ O = ["0 m", "0 m"] }}
        [[body]]
        name = "wheel"
        ends = ["O", "A"]
        length = "10 cm"
        mass = "1 kg"
        inertia = "0.5 kg m^2"
        centre = ["0 cm", "0 cm"]
        [[joint]]
        kind = "pin"
        point = "O"
        [drive]
        body = "wheel"
        [motor]
        kind = "table"
        points = [["0 s", "0 N m"], ["1 s", "8 N m"], ["2 s", "0 N m"]]
        [load]
        constant = "2 N m"
        [motion]
        {end}
        [motion.start]
        wheel = {{ at = "0 deg", speed = "0 rad/s" }}
    "#
        )
    };
    let run = Row::RunUp { target: None };
    let mut motion = Certified::new(&read(&text("")), 12, &run).unwrap();
    for (time, due) in [
        ((0, 1), ["0", "0", "0"]),
        ((1, 5), ["0", "0", "0"]),
        // The moment at which it is freed, and a corner of the torque.
        ((1, 4), ["0", "0", "0"]),
        ((1, 1), ["64.4577519522", "4.50000000000", "12.0000000000"]),
        ((2, 1), ["513.274691471", "8.50000000000", "-4.00000000000"]),
        (
            (4, 1),
            ["1028.93670709", "0.500000000000", "-4.00000000000"],
        ),
        ((5, 1), ["1030.72720020", "0", "0"]),
    ] {
        assert_eq!(digits_at(&mut motion, time), due, "{time:?}");
    }
    // Where it stops the acceleration jumps.
    let found = motion.at(&rug::Rational::from((33, 8)));
    assert_eq!(found.digits[1..], [Some("0".into()), None]);
    let forces = Row::Motion { reactions: true };
    let mut motion = Certified::new(&read(&text("")), 12, &forces).unwrap();
    let held = ["0", "0", "0", "9.80665000000"].map(String::from);
    assert_eq!(digits_at(&mut motion, (0, 1)), held);
    assert_eq!(digits_at(&mut motion, (1, 5)), held);
    // The motion may end where the wheel stops.
    let until = read(&text("until = \"omega_wheel - (1/2)\""));
    let mut motion = Certified::new(&until, 12, &Row::Motion { reactions: false }).unwrap();
    let found = motion.at(&rug::Rational::from(3));
    assert_eq!(found.reason, None);
    assert_eq!(found.ended.unwrap().to_f64(), 0.5);
}

/// A four-bar whose crank a resistance holds, until the torque grows, and stops at the end: values of
/// scipy's DOP853 from one event to the next, and of the statics of coupler and rocker.
#[test]
fn a_resistance_holds_and_stops_the_crank_of_a_four_bar() {
    let text = include_str!("../../../../examples/four-bar-run-up.toml");
    let (before, after) = text.split_once("[motor]").unwrap();
    let (_, load) = after.split_once("[load]").unwrap();
    let motor = r#"[motor]
        kind = "table"
        points = [["0 s", "3 N m"], ["0.5 s", "6 N m"], ["0.7 s", "2 N m"]]
        rotor_inertia = "0.02 kg m^2"
        [load]"#;
    let text = [before, motor, load].concat().replace("0 deg", "40 deg");
    let moving = read(&text);
    let mut motion = Certified::new(&moving, 9, &Row::RunUp { target: None }).unwrap();
    for (time, due) in [
        ((1, 10), ["40.0000000", "0", "0"]),
        ((1, 5), ["40.1671821", "0.160072137", "5.83163135"]),
        ((2, 5), ["55.8135451", "3.07113933", "20.5839157"]),
        ((9, 5), ["717.157701", "4.48938856", "-11.6631860"]),
        ((2, 1), ["744.055145", "0", "0"]),
    ] {
        assert_eq!(digits_at(&mut motion, time), due, "{time:?}");
    }
    let mut motion = Certified::new(&moving, 9, &Row::Motion { reactions: true }).unwrap();
    let held = digits_at(&mut motion, (1, 20));
    assert_eq!(digits_at(&mut motion, (0, 1))[6..], held[6..]);
    let statics = [
        "-6.88505742",
        "24.5605930",
        "-6.88505742",
        "14.7505930",
        "-6.88505742",
        "-24.4894070",
        "6.88505742",
        "53.9194070",
    ];
    assert_eq!(held[6..], statics);
}
