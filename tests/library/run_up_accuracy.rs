//! The run-up of the sand screen in floating point against its certified enclosure, over 3 s.

use crate::run_up_witness::certified_run;
use mechaudit::reference::run_up as certified;
use mechaudit::solvers::run_up::{
    ClassIiiModel, Drive, Equation, Hybrid, Kloss, Method, Motor, Plan, ReducedModel, Settings,
    Splined, run,
};
use mechaudit::solvers::units::{AngularVelocity, Torque};
use mechaudit_cli::papers::zinchenko::data;
use rug::Rational;

fn model() -> (ClassIiiModel, f64) {
    let (linkage, masses, start) = data::solver_start();
    (ClassIiiModel::new(linkage, masses, start), start.phi1)
}

fn drive() -> Drive {
    let w = AngularVelocity::from_rad_per_s(10.0);
    let motor = Kloss::rated(w, Torque::from_n_m(200.0), 2.2, 0.05).expect("a motor");
    Drive::direct(Motor::Kloss(motor))
}

fn plan(method: Method, phi: f64, duration: f64, sampling: Option<f64>) -> Plan {
    Plan {
        sampling,
        settings: Settings {
            tolerance: 1e-12,
            method,
            ..Settings::default()
        },
        ..Plan::new(phi, duration)
    }
}

/// At a tolerance of 1e-12 within 1e-10 rad/s at 300 moments of 3 s.
#[test]
fn within_1e_10_of_the_enclosure() {
    let (exact, request) = certified_run(72);
    let times: Vec<Rational> = (1..=300).map(|k| Rational::from((k, 100))).collect();
    let reference = certified::integrate(&exact, &request, &times).expect("decided");
    let (model, phi) = model();
    let drive = drive();
    let equation = Equation::new(&model, &drive);
    for method in [Method::Verner98, Method::Dop853] {
        let motion = run(&equation, &plan(method, phi, 3.0, Some(0.01))).expect("a motion");
        let mut worst = 0.0f64;
        for (sample, due) in motion.samples[1..].iter().zip(&reference.samples) {
            assert!(due.speed.rad().to_f64() < 1e-13, "{:?}", due.speed);
            let psi = (sample.psi - due.speed.mid().to_f64()).abs();
            let angle = (sample.phi - due.angle.mid().to_f64()).abs();
            assert!(angle < 1e-10, "{method:?} {}: {angle:e} rad", sample.t);
            worst = worst.max(psi);
        }
        println!("{method:?}: worst found {worst:.2e} rad/s");
        assert!(worst < 1e-10, "{method:?}: {worst:e}");
    }
}

/// Splines and hybrids too, against the recorded digits.
#[test]
fn every_model_meets_the_recorded_values() {
    let text = include_str!("../../reference/values/sand-screen-run-up.csv");
    let drive = drive();
    let mut seen = 0;
    for line in text.lines().filter(|l| !l.starts_with('#')).skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let [name, nodes, quantity, t, value] = fields[..] else {
            panic!("{line}")
        };
        if quantity != "psi_rad_per_s" {
            continue;
        }
        let nodes: usize = nodes.parse().expect("a count");
        let (exact, phi) = model();
        let model: Box<dyn ReducedModel> = match name {
            "exact" => Box::new(exact),
            "splines" => Box::new(Splined::new(&exact, phi, nodes).expect("splines")),
            _ => Box::new(Hybrid::new(exact, phi, nodes).expect("splines")),
        };
        let t: f64 = t.parse().expect("a time");
        let due: f64 = value.parse().expect("a speed");
        let motion = run(
            &Equation::new(&*model, &drive),
            &plan(Method::Verner98, phi, t, None),
        );
        let psi = motion.expect("a motion").end.psi;
        assert!((psi - due).abs() < 1e-10, "{line}: {:e}", psi - due);
        seen += 1;
    }
    assert_eq!(seen, 35);
}
