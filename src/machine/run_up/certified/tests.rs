use super::*;
use crate::machine::run_up::{Machine, Overrides};
use crate::solvers::run_up::{Equation, run};

const FOUR_BAR: &str = include_str!("../../../../examples/four-bar-run-up.toml");

fn read(text: &str, digits: u32) -> CertifiedRun {
    CertifiedRun::read(&Source::toml(text), digits).unwrap_or_else(|e| panic!("{e}"))
}

fn refused(text: &str) -> String {
    match CertifiedRun::read(&Source::toml(text), 15) {
        Ok(_) => "read".into(),
        Err(e) => e.to_string(),
    }
}

/// Angle in degrees, speed and acceleration in floating point after `seconds` seconds.
fn floating(text: &str, seconds: f64) -> [f64; 3] {
    let mut machine = Machine::read(&Source::toml(text), Overrides::default()).unwrap();
    machine.plan.duration = seconds;
    machine.plan.settings.tolerance = 1e-12;
    let model = machine.reduced().unwrap();
    let end = run(&Equation::new(&*model, &machine.drive), &machine.plan).unwrap();
    let end = end.end;
    [end.phi.to_degrees(), end.psi, end.acceleration]
}

/// Certified runs of machines of every type are those of the solver of runs.
#[test]
fn machines_of_every_type_run_with_certified_digits() {
    let slider = r#"
        type = "slider-crank"
        [geometry]
        crank = "5 cm"
        rod = "20 cm"
        offset = "1 cm"
        direction = "20 deg"
        [start]
        phi1 = "30 deg"
        assembly = "negative"
        speed = "2 rad/s"
        [bodies.crank]
        mass = "1 kg"
        inertia = "0.01 kg m^2"
        radius = "2 cm"
        angle = "10 deg"
        [bodies.rod]
        mass = "2 kg"
        inertia = "0.02 kg m^2"
        radius = "9 cm"
        [bodies.slider]
        mass = "3 kg"
        [motor]
        kind = "linear"
        standstill_torque = "4 N m"
        no_load_speed = "20 rad/s"
        [load]
        quadratic = "0.01 N m s^2"
        [run]
        duration = "1 s"
    "#;
    let planar = format!(
        "{}\n{}",
        include_str!("../../../../examples/sand-screen-bodies.toml"),
        "[motor]\nkind = \"constant\"\ntorque = \"90 N m\"\n[run]\nduration = \"1 s\"\n"
    );
    let cubic = FOUR_BAR.replace("\"linear\"", "\"cubic\"");
    let screen = include_str!("../../../../examples/sand-screen-run-up.toml");
    for (text, seconds) in [
        (FOUR_BAR, (1, 10)),
        (&*cubic, (1, 20)),
        (slider, (1, 5)),
        (&*planar, (1, 100)),
        (screen, (1, 1000)),
    ] {
        let time = Rational::from(seconds);
        let found = read(text, 13).motion.at(&time);
        assert_eq!((found.reason, found.ended), (None, None), "{text}");
        let due = floating(text, time.to_f64());
        for (found, due) in found.digits.iter().zip(due) {
            let found: f64 = found.as_deref().unwrap().parse().unwrap();
            let size = due.abs().max(1.0);
            assert!((found - due).abs() < 2e-9 * size, "{found} {due}: {text}");
        }
    }
    // From rest, where the resistance changes its sign.
    let found = read(FOUR_BAR, 13).motion.at(&Rational::new());
    let digit = found.digits[2].as_deref().unwrap();
    let due = floating(FOUR_BAR, 1e-9)[2];
    assert!(
        (digit.parse::<f64>().unwrap() - due).abs() < 1e-6,
        "{digit} {due}"
    );
    let back = FOUR_BAR.replace("[\"0 rpm\", \"3 N m\"]", "[\"-900 rpm\", \"-30 N m\"]");
    let back = read(&back, 13);
    let mut motion = back.motion;
    // Backwards from rest the resistance acts forwards, as it does a moment later.
    let [first, soon] = [(0, 1), (1, 100_000_000)].map(|time| {
        let found = motion.at(&Rational::from(time)).digits.remove(2);
        found.unwrap().parse::<f64>().unwrap()
    });
    assert!(first < 0.0 && (first - soon).abs() < 1e-3, "{first} {soon}");
    // As recorded: enclosed by the special reference.
    let found = read(screen, 20).motion.at(&Rational::from((1, 1000)));
    assert_eq!(found.digits[1].as_deref(), Some("7.3358305137009154505"));
}

/// A crank that is let go swings to and fro; the special reference ends where it comes to rest.
#[test]
fn a_crank_swings_through_standstill() {
    let text = r#"
        type = "four-bar"
        gravity = "9.81 m/s^2"
        [geometry]
        crank = "0.5 m"
        coupler = "1 m"
        rocker = "0.6 m"
        frame = "0.9 m"
        [start]
        phi1 = "-60 deg"
        assembly = "negative"
        [bodies.crank]
        mass = "1 kg"
        inertia = "0.0208 kg m^2"
        radius = "25 cm"
        [bodies.coupler]
        mass = "2 kg"
        inertia = "0.1667 kg m^2"
        radius = "50 cm"
        [bodies.rocker]
        mass = "1.2 kg"
        inertia = "0.036 kg m^2"
        radius = "30 cm"
        [motor]
        kind = "off"
        [run]
        duration = "3 s"
    "#;
    let found = read(text, 13).motion.at(&Rational::from((3, 2)));
    let due = floating(text, 1.5);
    for (found, due) in found.digits.iter().zip(due) {
        let found: f64 = found.as_deref().unwrap().parse().unwrap();
        assert!(
            (found - due).abs() < 1e-7 * due.abs().max(1.0),
            "{found} {due}"
        );
    }
}

#[test]
fn a_speed_beyond_the_table_has_no_digits() {
    let (before, rest) = FOUR_BAR.split_once("points = [").unwrap();
    let (_, after) = rest.split_once("]\nreading").unwrap();
    let table = "[\"0 rpm\", \"3 N m\"], [\"60 rpm\", \"3 N m\"]]";
    let mut run = read(&format!("{before}points = [{table}\nreading{after}"), 10);
    let found = run.motion.at(&Rational::from((1, 10)));
    assert_eq!(
        found.reason.as_deref(),
        Some("the speed has left the motor's table")
    );
    assert!(found.digits.iter().all(Option::is_none));
    assert_eq!(run.motion.at(&Rational::from((1, 100))).reason, None);
}

#[test]
fn what_has_no_certified_digits_is_refused() {
    for (from, to, due) in [
        (
            "step = \"2 ms\"",
            "coefficients = \"splines\"",
            "run.coefficients",
        ),
        ("step = \"2 ms\"", "settle = 1e-6", "run.settle"),
        (
            "step = \"2 ms\"",
            "step = \"1e-9 s\"",
            "at most 1000000 rows",
        ),
        ("step = \"2 ms\"", "step = \"0 s\"", "have to be positive"),
    ] {
        let found = refused(&FOUR_BAR.replacen(from, to, 1));
        assert!(found.contains(due) && !found.contains('\n'), "{found}");
    }
}
