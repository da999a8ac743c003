//! Recorded values of the run-up of the sand screen: `reference/values/run_up.csv`.
//!
//! `cargo test --release --test run_up_values -- --ignored` writes the file anew.
#![cfg(feature = "oracle")]

use mechaudit::papers::zinchenko::data;
use mechaudit::reference::Decimal;
use mechaudit::reference::run_up::{
    Coefficients, LinkageCurve, Motor, Run, free_motion_factor, integrate,
};
use rug::Rational;
use std::sync::Arc;

const BITS: u32 = 120;
const TIMES: [&str; 7] = ["0.001", "0.01", "0.1", "0.5", "1", "2", "3"];
const DIGITS: usize = 20;

fn q(text: &str) -> Rational {
    Decimal::parse(text).expect("a decimal").value
}

fn computed() -> String {
    let (_, start) = data::start(BITS).expect("decided");
    let offset = data::row_angle(&Rational::new());
    let masses = data::masses(data::RECOVERED);
    let curve = LinkageCurve::new(&data::geometry(), &masses, &offset, &start, 48, BITS);
    let curve = Arc::new(curve);
    let run = Run {
        motor: Motor::Rated {
            torque: q("200"),
            overload: q("2.2"),
            slip: q("0.05"),
            synchronous: q("10"),
        },
        rotor_inertia: Rational::new(),
        angle: offset,
        speed: Rational::new(),
    };
    let mut text = String::from("model,nodes,quantity,t_s,value\n");
    let models = [
        ("exact", 0),
        ("splines", 12),
        ("splines", 48),
        ("hybrid", 12),
        ("hybrid", 48),
    ];
    for (name, nodes) in models {
        let model = match name {
            "exact" => Ok(Coefficients::exact(&curve)),
            "splines" => Coefficients::splines(&curve, nodes),
            _ => Coefficients::hybrid(&curve, nodes),
        };
        let model = model.expect("decided");
        let motion = integrate(&model, &run, &TIMES.map(q)).expect("decided");
        for (s, t) in motion.samples.iter().zip(TIMES) {
            let phi = s.angle.to_decimal(DIGITS).expect("certified");
            let psi = s.speed.to_decimal(DIGITS).expect("certified");
            text += &format!(
                "{name},{nodes},phi_rad,{t},{phi}\n{name},{nodes},psi_rad_per_s,{t},{psi}\n"
            );
        }
        if name == "hybrid" {
            let turn = free_motion_factor(&model, &Rational::new()).expect("decided");
            let factor = turn.factor.to_decimal(DIGITS).expect("certified");
            text += &format!("{name},{nodes},free_motion_factor,,{factor}\n");
        }
    }
    text
}

#[test]
fn as_recorded() {
    assert_eq!(computed(), include_str!("../reference/values/run_up.csv"));
}

#[test]
#[ignore = "writes the file"]
fn write() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/reference/values/run_up.csv");
    std::fs::write(path, computed()).expect("written");
}
