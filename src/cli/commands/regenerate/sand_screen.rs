//! The enclosed run-up of the sand screen: recovered masses, a motor by Kloss's formula at the
//! crank, from rest.

use crate::cli::files::artefact::{Made, Outcome, certified};
use mechaudit::papers::zinchenko::data;
use mechaudit::reference::run_up::{
    Coefficients, LinkageCurve, Motor, Run, free_motion_factor, integrate,
};
use mechaudit::reference::{Ball, Decimal};
use rug::Rational;
use std::fmt::Write as _;
use std::sync::Arc;

const BITS: u32 = 120;
const TIMES: [&str; 7] = ["0.001", "0.01", "0.1", "0.5", "1", "2", "3"];
const DIGITS: usize = 20;
const PANELS: u32 = 48;
const TORQUE: &str = "200";
const OVERLOAD: &str = "2.2";
const SLIP: &str = "0.05";
const SYNCHRONOUS: &str = "10";

#[derive(Clone, Copy, Debug)]
enum Model {
    Exact,
    Splines(u32),
    Hybrid(u32),
}

const MODELS: [Model; 5] = [
    Model::Exact,
    Model::Splines(12),
    Model::Splines(48),
    Model::Hybrid(12),
    Model::Hybrid(48),
];

fn exactly(text: &str) -> Outcome<Rational> {
    Ok(Decimal::parse(text)?.value)
}

fn digits(ball: &Ball) -> Outcome<String> {
    Ok(certified(ball, DIGITS, BITS)?)
}

/// Angle and speed at [`TIMES`], and the factor of the speed over a turn of free motion.
pub fn made() -> Outcome<Made> {
    let (_, start) = data::start(BITS)?;
    let offset = data::row_angle(&Rational::new());
    let (geometry, masses) = (data::geometry(), data::recovered());
    let curve = LinkageCurve::new(&geometry, &masses, &offset, &start, PANELS, BITS);
    let curve = Arc::new(curve);
    let run = Run {
        motor: Motor::Rated {
            torque: exactly(TORQUE)?,
            overload: exactly(OVERLOAD)?,
            slip: exactly(SLIP)?,
            synchronous: exactly(SYNCHRONOUS)?,
        },
        rotor_inertia: Rational::new(),
        angle: offset.clone(),
        speed: Rational::new(),
    };
    let times: Vec<Rational> = TIMES.into_iter().map(exactly).collect::<Outcome<_>>()?;
    let mut body = String::from("model,nodes,quantity,t_s,value\n");
    for model in MODELS {
        let (name, nodes, made) = match model {
            Model::Exact => ("exact", 0, Ok(Coefficients::exact(&curve))),
            Model::Splines(n) => ("splines", n, Coefficients::splines(&curve, n)),
            Model::Hybrid(n) => ("hybrid", n, Coefficients::hybrid(&curve, n)),
        };
        let made = made?;
        let motion = integrate(&made, &run, &times)?;
        for (s, t) in motion.samples.iter().zip(TIMES) {
            let (phi, psi) = (digits(&s.angle)?, digits(&s.speed)?);
            writeln!(body, "{name},{nodes},phi_rad,{t},{phi}")?;
            writeln!(body, "{name},{nodes},psi_rad_per_s,{t},{psi}")?;
        }
        if let Model::Hybrid(_) = model {
            let turn = free_motion_factor(&made, &Rational::new())?;
            let factor = digits(&turn.factor)?;
            writeln!(body, "{name},{nodes},free_motion_factor,,{factor}")?;
        }
    }
    Ok(Made {
        title: "The enclosed run-up of the sand screen from rest, with exact coefficients, splines and\n\
                the exact I_n with a spline's derivative; see reference/README.md."
            .into(),
        facts: vec![
            ("precision", format!("{DIGITS} certified digits at {BITS} bits")),
            ("counts", format!("{} models, {} times", MODELS.len(), TIMES.len())),
        ],
        recipe: format!(
            "{geometry:?} {masses:?} {offset:?} {PANELS} panels, {MODELS:?} at {TIMES:?}, motor \
             {TORQUE} {OVERLOAD} {SLIP} {SYNCHRONOUS}"
        ),
        body,
    })
}
