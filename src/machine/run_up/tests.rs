//! Tests of `run_up`.

use super::*;
use crate::solvers::run_up::Motor;

const FOUR_BAR: &str = include_str!("../../../examples/four-bar-run-up.toml");

/// The example with other lines in place of its own.
fn changed(changes: &[(&str, &str)]) -> Result<Machine, MachineError> {
    read(changes, Overrides::default())
}

fn read(changes: &[(&str, &str)], overrides: Overrides) -> Result<Machine, MachineError> {
    let mut text = FOUR_BAR.to_string();
    for (from, to) in changes {
        let other = text.replacen(from, to, 1);
        assert_ne!(other, text, "{from}");
        text = other;
    }
    Machine::read(&Source::toml(text), overrides)
}

fn motor(text: &str) -> Result<Motor, Refusal> {
    let section: MotorSection = toml::from_str(text).unwrap();
    section.read(&Source::toml(format!("[motor]\n{text}")))
}

#[test]
fn each_kind_of_motor_has_its_torque() {
    let speed = |w: f64| (format!("\"{w} rad/s\""), w);
    let (synchronous, ten) = speed(10.0);
    for (text, at, due) in [
        ("kind = \"off\"".to_string(), 3.0, 0.0),
        ("kind = \"constant\"\ntorque = \"7 N m\"".to_string(), 3.0, 7.0),
        (
            format!("kind = \"linear\"\nstandstill_torque = \"6 N m\"\nno_load_speed = {synchronous}"),
            0.25 * ten,
            4.5,
        ),
        // The rated torque at the rated slip, and the pull-out torque at the critical slip.
        (
            format!(
                "kind = \"kloss\"\nsynchronous_speed = {synchronous}\nrated_torque = \"200 N m\"\noverload = 2.2\nrated_slip = 0.05"
            ),
            0.95 * ten,
            200.0,
        ),
        (
            format!(
                "kind = \"kloss\"\nsynchronous_speed = {synchronous}\npull_out_torque = \"300 N m\"\ncritical_slip = 0.2"
            ),
            0.8 * ten,
            300.0,
        ),
        (
            "kind = \"table\"\nreading = \"linear\"\npoints = [[\"0 rad/s\", \"1 N m\"], [\"4 rad/s\", \"9 N m\"], [\"5 rad/s\", \"0 N m\"]]"
                .to_string(),
            1.0,
            3.0,
        ),
    ] {
        let (found, _) = motor(&text).unwrap().torque_and_slope(at).unwrap();
        assert!((found - due).abs() < 1e-12 * due.max(1.0), "{text}: {found}");
    }
    let points =
        "points = [[\"0 rad/s\", \"1 N m\"], [\"4 rad/s\", \"9 N m\"], [\"5 rad/s\", \"0 N m\"]]";
    let [linear, cubic] = ["linear", "cubic"].map(|reading| {
        let motor = motor(&format!(
            "kind = \"table\"\nreading = \"{reading}\"\n{points}"
        ));
        motor.unwrap().torque_and_slope(1.0).unwrap().0
    });
    assert!((linear - cubic).abs() > 0.1);
}

/// Every kind needs its own fields and takes none of the others.
#[test]
fn motors_have_the_fields_of_their_kind() {
    let fields = [
        ("synchronous_speed", "\"10 rad/s\""),
        ("rated_torque", "\"200 N m\""),
        ("overload", "2.2"),
        ("rated_slip", "0.05"),
        ("pull_out_torque", "\"300 N m\""),
        ("critical_slip", "0.2"),
        ("standstill_torque", "\"6 N m\""),
        ("no_load_speed", "\"10 rad/s\""),
        ("torque", "\"7 N m\""),
        (
            "points",
            "[[\"0 rad/s\", \"1 N m\"], [\"4 rad/s\", \"9 N m\"]]",
        ),
        ("reading", "\"linear\""),
    ];
    for (kind, own) in [
        (MotorKind::Off, ""),
        (MotorKind::Constant, "torque"),
        (MotorKind::Linear, "standstill_torque no_load_speed"),
        (
            MotorKind::Kloss,
            "synchronous_speed rated_torque overload rated_slip",
        ),
        (
            MotorKind::Kloss,
            "synchronous_speed pull_out_torque critical_slip",
        ),
        (MotorKind::Table, "points reading"),
    ] {
        let own: Vec<&str> = own.split_whitespace().collect();
        let text = |names: &[&str]| {
            let given = fields.iter().filter(|f| names.contains(&f.0));
            let lines = given.map(|(name, value)| format!("{name} = {value}\n"));
            format!("kind = \"{}\"\n{}", kind.name(), lines.collect::<String>())
        };
        assert!(motor(&text(&own)).is_ok(), "{}", kind.name());
        for missing in &own {
            let rest: Vec<&str> = own.iter().copied().filter(|f| f != missing).collect();
            let refused = motor(&text(&rest)).err().unwrap();
            let due = format!("motor.{missing} is missing");
            // Without the fields that choose the formula it is the rated one.
            let rated = kind == MotorKind::Kloss && rest.len() == 1;
            assert!(rated || refused.to_string().ends_with(&due), "{refused}");
            assert_eq!(refused.place(), "motor");
        }
        for (name, _) in fields.iter().filter(|f| !own.contains(&f.0)) {
            let refused = motor(&text(&[&own[..], &[*name]].concat())).err().unwrap();
            let due = match kind.fields().contains(name) {
                true => {
                    "rated_slip and pull_out_torque, critical_slip exclude each other".to_string()
                }
                false => format!("motor.{name} has no meaning with kind = {:?}", kind.name()),
            };
            assert!(refused.to_string().ends_with(&due), "{refused}");
        }
    }
    let refused = motor("kind = \"kloss\"\nsynchronous_speed = \"1 rad/s\"").unwrap_err();
    assert!(
        refused
            .to_string()
            .ends_with("motor.rated_torque is missing")
    );
}

#[test]
fn machines_have_what_the_file_says_and_defaults() {
    let machine = changed(&[]).unwrap();
    assert_eq!(
        (&*machine.name, machine.linkage),
        ("crank-rocker, run-up", "four-bar")
    );
    assert_eq!(
        (machine.motor, machine.coefficients),
        (MotorKind::Table, Coefficients::Exact)
    );
    assert_eq!((machine.nodes, machine.fluctuation), (48, None));
    assert!(machine.branch.is_none());
    let drive = &machine.drive;
    // The rotor's inertia by the square of the ratio.
    assert_eq!((drive.ratio(), drive.inertia()), (5.0, 0.5));
    let resistance = drive.resistance();
    let found = (
        resistance.constant.n_m(),
        resistance.viscous_n_m_s,
        resistance.quadratic_n_m_s2,
    );
    assert_eq!(found, (2.0, 0.05, 0.0));
    let plan = &machine.plan;
    assert_eq!((plan.phi, plan.psi, plan.duration), (0.0, 0.0, 2.0));
    assert_eq!(
        (plan.target, plan.settled, plan.sampling),
        (None, None, Some(0.002))
    );
    let due = Settings {
        switch_when_stiff: true,
        ..Settings::default()
    };
    assert_eq!(plan.settings, due);
    let other = changed(&[
        ("name = \"crank-rocker, run-up\"\n", ""),
        ("phi1 = \"0 deg\"", "phi1 = \"30 deg\""),
        ("speed = \"0 rad/s\"", "speed = \"3 rad/s\""),
        (
            "ratio = 5\nrotor_inertia = \"0.02 kg m^2\"\n",
            "flywheel = \"4 kg m^2\"\n",
        ),
        (
            "constant = \"2 N m\"\nviscous = \"0.05 N m s\"",
            "quadratic = \"7 N m s^2\"",
        ),
        (
            "step = \"2 ms\"",
            "tolerance = 1e-6\nmethod = \"radau5\"\ncoefficients = \"hybrid\"\nnodes = 12\n\
             target_speed = \"9 rad/s\"\nsettle = 0.01\nfluctuation = 0.05",
        ),
    ])
    .unwrap();
    assert_eq!(other.name, "four-bar linkage");
    assert_eq!((other.drive.ratio(), other.drive.inertia()), (1.0, 4.0));
    let resistance = other.drive.resistance();
    let found = (
        resistance.constant.n_m(),
        resistance.viscous_n_m_s,
        resistance.quadratic_n_m_s2,
    );
    assert_eq!(found, (0.0, 0.0, 7.0));
    let plan = &other.plan;
    assert_eq!((plan.phi, plan.psi), (30f64.to_radians(), 3.0));
    assert_eq!(
        (plan.target, plan.settled, plan.sampling),
        (Some(9.0), Some(0.01), Some(0.002))
    );
    let due = Settings {
        tolerance: 1e-6,
        method: Method::Radau5,
        switch_when_stiff: false,
        ..Settings::default()
    };
    assert_eq!(plan.settings, due);
    assert_eq!(
        (other.coefficients, other.nodes),
        (Coefficients::Hybrid, 12)
    );
    assert_eq!(other.fluctuation, Some(0.05));
    let still = changed(&[(
        "[start]\nphi1 = \"0 deg\"\nspeed = \"0 rad/s\"\nassembly = \"positive\"\n",
        "",
    )]);
    let plan = still.unwrap().plan;
    assert_eq!((plan.phi, plan.psi), (0.0, 0.0));
}

/// Arguments replace the file's values, which may have nodes that exact coefficients do not use.
#[test]
fn overrides_stand_in_place_of_the_file() {
    let nodes = ("step = \"2 ms\"", "nodes = 12");
    let splines = ("step = \"2 ms\"", "nodes = 12\ncoefficients = \"splines\"");
    let asked = |coefficients| Overrides {
        coefficients,
        ..Overrides::default()
    };
    for (change, overrides, due) in [
        (splines, asked(None), Some((Coefficients::Splines, 12))),
        (
            splines,
            asked(Some(Coefficients::Exact)),
            Some((Coefficients::Exact, 12)),
        ),
        (
            nodes,
            asked(Some(Coefficients::Hybrid)),
            Some((Coefficients::Hybrid, 12)),
        ),
        (
            nodes,
            asked(Some(Coefficients::Exact)),
            Some((Coefficients::Exact, 12)),
        ),
        (nodes, asked(None), None),
        (
            ("step = \"2 ms\"", "coefficients = \"exact\""),
            asked(None),
            Some((Coefficients::Exact, 48)),
        ),
    ] {
        match (read(&[change], overrides), due) {
            (Ok(machine), Some(due)) => assert_eq!((machine.coefficients, machine.nodes), due),
            (Err(refused), None) => {
                assert!(
                    refused.to_string().contains("run.nodes has no meaning"),
                    "{refused}"
                );
            }
            _ => panic!("{change:?}"),
        }
    }
    let all = Overrides {
        coefficients: Some(Coefficients::Splines),
        nodes: Some(24),
        tolerance: Some(1e-5),
        method: Some(Method::Dop853),
    };
    let given = (
        "step = \"2 ms\"",
        "tolerance = 1e-6\nmethod = \"radau5\"\nnodes = 12\ncoefficients = \"hybrid\"",
    );
    for change in [given, ("step = \"2 ms\"", "")] {
        let machine = read(&[change], all).unwrap();
        assert_eq!(
            (machine.coefficients, machine.nodes),
            (Coefficients::Splines, 24)
        );
        let settings = machine.plan.settings;
        assert_eq!(
            (settings.tolerance, settings.method),
            (1e-5, Method::Dop853)
        );
        assert!(!settings.switch_when_stiff);
        assert_eq!(machine.plan.sampling, Some(0.002));
    }
    assert_eq!(
        Coefficients::ALL.map(Coefficients::name),
        ["exact", "splines", "hybrid"]
    );
}

#[test]
fn mechanisms_need_masses() {
    let tail = "[motor]\nkind = \"constant\"\ntorque = \"1 N m\"\n[run]\nduration = \"1 s\"\n";
    let of = |text: &str| {
        Machine::read(
            &Source::toml(format!("{text}\n{tail}")),
            Overrides::default(),
        )
    };
    let watt = include_str!("../../../examples/watt-1.toml");
    let refused = of(watt).err().unwrap();
    assert_eq!(
        refused.to_string(),
        "a run needs masses: no [[body]] has one"
    );
    let heavy = |name: &str| {
        let from = format!("name = \"{name}\"\n");
        let to = format!("{from}mass = \"1 kg\"\ncentre = [\"1 cm\", \"2 cm\"]\n");
        watt.replacen(&from, &to, 1)
    };
    let machine = of(&heavy("crank")).unwrap();
    assert_eq!((&*machine.name, machine.linkage), ("Watt I", "planar"));
    // The angle of the line that is drawn from A to B.
    assert!((machine.plan.phi - 2f64.atan2(1.0)).abs() < 1e-15);

    let bodiless = FOUR_BAR.split_once("[bodies.crank]").unwrap().0;
    let refused = of(bodiless).err().unwrap();
    let due = "a run needs masses: the sections [bodies.…] are missing";
    assert_eq!(refused.to_string(), due);
}

/// Neither a motor that is off nor a crank at rest has a cycle to look for.
#[test]
fn a_cycle_is_looked_for_where_the_motor_turns_the_crank() {
    use crate::solvers::run_up::{Equation, run};
    let of = |changes: &[(&str, &str)], psi: f64| {
        let machine = changed(changes).unwrap();
        let equation = Equation::new(&*machine.model, &machine.drive);
        let plan = Plan {
            duration: 1e-4,
            ..machine.plan.clone()
        };
        let mut motion = run(&equation, &plan).unwrap();
        motion.end.psi = psi;
        let steady = Steady::of(&machine, &equation, &motion);
        (
            steady.cycle.is_some(),
            steady.flywheel.is_some(),
            steady.wanted,
        )
    };
    let fluctuation = ("step = \"2 ms\"", "step = \"0.1 ms\"\nfluctuation = 0.05");
    let none = ("step = \"2 ms\"", "step = \"0.1 ms\"");
    let (_, motor) = FOUR_BAR.split_once("[motor]\n").unwrap();
    let (motor, _) = motor.split_once("ratio").unwrap();
    let off = (motor, "kind = \"off\"\n");
    for (changes, psi, due) in [
        (&[fluctuation][..], 30.0, (true, true, 0.05)),
        (&[none], 30.0, (true, false, f64::NAN)),
        (&[fluctuation], 0.0, (false, false, 0.05)),
        (&[fluctuation, off], 30.0, (false, false, 0.05)),
    ] {
        let found = of(changes, psi);
        assert_eq!((found.0, found.1), (due.0, due.1), "{psi}");
        assert!(found.2 == due.2 || (found.2.is_nan() && due.2.is_nan()));
    }
}
