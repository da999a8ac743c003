//! The run-up of a class-III linkage under a motor: crank angle and speed after a given time.

mod twin;

use crate::audit::{
    Budget, Domain, Draw, Law, Limit, Output, ReferenceAnswer, SolverAnswer, Uncertified,
};
use crate::methods::common::{output, point, region};
use crate::methods::definition::{Definition, exact, method};
use crate::methods::inputs::{Number, inputs};
use crate::methods::linkages::{ClassIiiInput, at_degrees};
use crate::reference::Ball;
use crate::reference::class_iii::{ExactAngle, Linkage};
use crate::reference::run_up as certified;
use crate::reference::run_up::LinkageCurve;
use crate::solvers::run_up::{
    ClassIiiModel, ConstantInertia, Drive, Equation, EventKind, Hybrid, Kloss,
    Method as Integration, Motion, Motor, Outcome, Plan, ReducedModel, Resistance, Settings,
    Splined, Stretch, run_recorded,
};
use crate::solvers::units::{AngularVelocity, Inertia, Torque};
use rug::Rational;
use std::sync::{Arc, Mutex};

pub(in crate::methods) use twin::{twin, twin_of_half_steps};

inputs! {
    /// A linkage under a motor, where it starts and for how long it runs.
    pub struct RunUpInput {
        coefficients: choice
            "coefficients (0 none but I1, 1 exact, 2 splines, 3 exact with S' for dI_n/dphi)", "1";
        nodes: choice "nodes (of the splines, the first at phi1)", "1";
        motor: choice "motor (0 constant, 1 straight, 2 Kloss)", "1";
        torque: number "torque (Kloss: rated)", "N m";
        overload: number "overload", "1";
        rated_slip: number "rated_slip", "1";
        no_load_speed: number "no_load_speed", "rad/s";
        i1: number "I1", "kg m^2";
        phi0: number "phi0 (phi at the start)", "rad";
        psi0: number "psi0 (psi at the start)", "rad/s";
        duration: number "duration", "s";
        linkage: (ClassIiiInput);
    }
}

/// The run-up of a class-III linkage under a motor: crank angle and speed after a given time.
///
/// A candidate is a `Fn(RunUpInput) -> [phi, psi]`.
#[derive(Clone, Copy, Debug)]
pub struct RunUp;

method! {
    RunUp "run-up": Fn(RunUpInput<'_>), |f, i| f(i)
}

/// Values of [`RunUpInput::coefficients`].
const CONSTANT: f64 = 0.0;
const EXACT: f64 = 1.0;
const SPLINES: f64 = 2.0;
const HYBRID: f64 = 3.0;

/// Values of [`RunUpInput::motor`].
const STEADY: f64 = 0.0;
const STRAIGHT: f64 = 1.0;
const KLOSS: f64 = 2.0;

/// Tolerance of the code under test.
const TOLERANCE: f64 = 1e-12;
/// Panels of a turn in the reference: a multiple of the nodes in use.
const PANELS: u32 = 48;

const BUDGET: Budget = Budget {
    limit: Limit::Ulps(45_036.0),
    reason: "2^52 · 1e-11: some hundreds of steps with a tolerance of 1e-12 each, most of whose \
             error the motor takes away again; at 10 rad/s it is 1e-10 rad/s",
};

fn solver_model(i: RunUpInput) -> Result<Box<dyn ReducedModel>, &'static str> {
    if i.coefficients == CONSTANT {
        return Ok(Box::new(ConstantInertia(0.0)));
    }
    let (first, nodes) = (i.linkage.phi1, i.nodes as usize);
    let linkage = i.linkage.geometry.solver()?;
    let masses = i.linkage.masses().ok_or("masses")?;
    let state = i.linkage.state(&linkage)?;
    let model = ClassIiiModel::new(linkage, masses, state);
    Ok(match i.coefficients {
        EXACT => Box::new(model),
        SPLINES => Box::new(Splined::new(&model, first, nodes).map_err(|_| "splines")?),
        HYBRID => Box::new(Hybrid::new(model, first, nodes).map_err(|_| "splines")?),
        _ => return Err("layout"),
    })
}

fn solver_motor(i: RunUpInput) -> Option<Motor> {
    let torque = Torque::from_n_m(i.torque);
    let speed = AngularVelocity::from_rad_per_s(i.no_load_speed);
    match i.motor {
        STEADY => Motor::constant(torque).ok(),
        STRAIGHT => Motor::linear(torque, speed).ok(),
        KLOSS => Kloss::rated(speed, torque, i.overload, i.rated_slip)
            .ok()
            .map(Motor::Kloss),
        _ => None,
    }
}

/// The motion by the code under test.
fn motion(i: RunUpInput) -> Result<Motion, &'static str> {
    motion_with(i, settings()).map(|(motion, _)| motion)
}

fn settings() -> Settings {
    Settings {
        tolerance: TOLERANCE,
        ..Settings::default()
    }
}

/// The motion and the stretches that make it up.
fn motion_with(i: RunUpInput, settings: Settings) -> Result<(Motion, Vec<Stretch>), &'static str> {
    motion_of(&*solver_model(i)?, i, settings)
}

/// The same of a model made before.
fn motion_of(
    model: &dyn ReducedModel,
    i: RunUpInput,
    settings: Settings,
) -> Result<(Motion, Vec<Stretch>), &'static str> {
    let motor = solver_motor(i).ok_or("motor")?;
    let none = Inertia::from_kg_m2(0.0);
    let rotor = Inertia::from_kg_m2(i.i1);
    let drive = Drive::new(motor, 1.0, none, rotor, Resistance::default()).map_err(|_| "motor")?;
    let plan = Plan {
        psi: i.psi0,
        settings,
        ..Plan::new(i.phi0, i.duration)
    };
    let (motion, stretches) =
        run_recorded(&Equation::new(model, &drive), &plan).map_err(|_| "no motion")?;
    // The reference does not follow a crank through standstill.
    let rests = motion.events.iter().any(|e| e.kind == EventKind::Rest);
    match motion.outcome {
        Outcome::TimeUp if !rests => Ok((motion, stretches)),
        _ => Err("stopped"),
    }
}

/// Curves of linkages met lately, by input and precision.
static CURVES: Mutex<Vec<Known>> = Mutex::new(Vec::new());
type Known = (Vec<Rational>, u32, Arc<LinkageCurve>);
const CURVES_KEPT: usize = 8;

fn curve(i: ClassIiiInput<Rational>, bits: u32) -> Result<Arc<LinkageCurve>, Uncertified> {
    let key = i.to_fractions();
    let mut known = CURVES.lock().unwrap_or_else(|e| e.into_inner());
    if let Some((_, _, c)) = known.iter().find(|(k, b, _)| *b == bits && *k == key) {
        return Ok(c.clone());
    }
    let geometry = i.geometry.exact()?;
    let offset = ExactAngle::Radians(i.phi1.clone());
    let linkage = Linkage::new(&geometry, bits);
    let start = i.configuration(&linkage, &offset.to_ball(bits))?;
    let made = Arc::new(LinkageCurve::new(
        &geometry,
        &i.exact_masses(),
        &offset,
        &start,
        PANELS,
        bits,
    ));
    keep(&mut known, (key, bits, made.clone()));
    Ok(made)
}

/// One more, the oldest being forgotten.
fn keep<T>(known: &mut Vec<T>, new: T) {
    if known.len() == CURVES_KEPT {
        known.remove(0);
    }
    known.push(new);
}

fn reference_model(
    i: RunUpInput<Rational>,
    bits: u32,
) -> Result<certified::Coefficients, Uncertified> {
    let (kind, nodes) = (i.coefficients.to_f64(), i.nodes.to_f64() as u32);
    if kind == CONSTANT {
        let zero = Rational::new();
        return Ok(certified::Coefficients::constant(&zero, &zero, bits));
    }
    let curve = curve(i.linkage, bits)?;
    Ok(match kind {
        EXACT => certified::Coefficients::exact(&curve),
        SPLINES => certified::Coefficients::splines(&curve, nodes)?,
        HYBRID => certified::Coefficients::hybrid(&curve, nodes)?,
        _ => return Err(Uncertified::Refused("layout")),
    })
}

fn reference_motor(i: RunUpInput<Rational>) -> Option<certified::Motor> {
    Some(match i.motor.to_f64() {
        STEADY => certified::Motor::Constant {
            torque: i.torque.clone(),
        },
        // M_0 (1 − ψ/ω_0).
        STRAIGHT => certified::Motor::Linear {
            standstill: i.torque.clone(),
            slope: Rational::from(i.torque / i.no_load_speed),
        },
        KLOSS => certified::Motor::Rated {
            torque: i.torque.clone(),
            overload: i.overload.clone(),
            slip: i.rated_slip.clone(),
            synchronous: i.no_load_speed.clone(),
        },
        _ => return None,
    })
}

/// Returns what the reference starts from.
fn reference_run(i: RunUpInput<Rational>) -> Option<certified::Run> {
    Some(certified::Run {
        motor: reference_motor(i)?,
        rotor_inertia: i.i1.clone(),
        angle: ExactAngle::Radians(i.phi0.clone()),
        speed: i.psi0.clone(),
    })
}

impl Definition for RunUp {
    type Input<'a, T: Number> = RunUpInput<'a, T>;
    const SUMMARY: &'static str =
        "crank angle and speed of a linkage under a motor after a given time, at tolerance 1e-12";
    const SOURCE: &'static str =
        "Zinchenko (2008), eqs (1), (2), with I_n by (4), dI_n/dphi by (5), M_o by (7), or splines";

    fn outputs() -> Vec<Output> {
        vec![output("phi", "rad", BUDGET), output("psi", "rad/s", BUDGET)]
    }

    fn domain() -> Domain {
        Domain {
            regions: vec![
                region(
                    "bare-rotor",
                    "constant inertia, any motor, forward and backward, for 0.01 to 3 times the \
                     time that the torque takes to bring it to speed",
                    |d| bare_rotor(d).to_vec(),
                ),
                region(
                    "from-rest",
                    "the sand screen under a Kloss motor from rest near a dead position, with and \
                     without a rotor, 0.5 to 4 ms",
                    |d| from_rest(d).to_vec(),
                ),
                region(
                    "moving",
                    "the sand screen at any crank angle and speed, any motor and coefficients, \
                     10 µs to 2 ms",
                    |d| moving(d).to_vec(),
                ),
            ],
            check_points: vec![
                point("exact-100-ms", sand_screen(EXACT, 0.0, 0.1).to_vec()),
                point(
                    "splines-12-100-ms",
                    sand_screen(SPLINES, 12.0, 0.1).to_vec(),
                ),
                point("hybrid-12-100-ms", sand_screen(HYBRID, 12.0, 0.1).to_vec()),
            ],
        }
    }

    /// As short as in the regions: a reference costs the more the longer it runs.
    fn admits(i: Self::Input<'_, f64>) -> bool {
        let whole = |x: f64| x.fract() == 0.0;
        [i.coefficients, i.nodes, i.motor].into_iter().all(whole)
            && i.linkage.is_whole()
            && (i.coefficients == CONSTANT || i.duration <= 5e-3)
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        let m = motion(i)?;
        Ok(vec![m.end.phi, m.end.psi])
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        // The budget is far above an ulp: fewer bits decide, and more are asked for if not. 80
        // leave radii of a few ulps after a start from rest.
        let bits = bits * 5 / 8;
        let model = reference_model(i, bits)?;
        let run = reference_run(i).ok_or(Uncertified::Refused("layout"))?;
        let m = certified::integrate(&model, &run, std::slice::from_ref(i.duration))?;
        Ok(ReferenceAnswer::bounded(
            vec![m.samples[0].angle.clone(), m.samples[0].speed.clone()],
            "Taylor polynomials with their defect bounded in Taylor models and the error by a \
             differential inequality in the crank angle (Walter 1998, §9); the linkage by a \
             contraction and Cauchy's estimate",
        ))
    }

    fn twin(i: Self::Input<'_, f64>) -> Option<Vec<Ball>> {
        twin(i, TOLERANCE, Integration::default())
    }

    fn laws() -> Vec<Law> {
        vec![
            Law {
                name: "energy",
                statement: "where dI_n/dphi belongs to I_n, the kinetic energy gained is the work \
                            done within 1e-10 of the largest of them",
                residual: energy_law,
            },
            Law {
                name: "restart",
                statement: "a run in two halves ends within 1e-10 of the whole one",
                residual: restart_law,
            },
        ]
    }
}

fn energy_law(x: &[f64]) -> Option<f64> {
    let i = RunUp::unpack(x).filter(|i| i.coefficients != HYBRID)?;
    let m = motion(i).ok()?;
    let sizes = [
        m.start.kinetic_energy,
        m.end.kinetic_energy,
        m.end.work[0],
        m.end.work[1],
    ];
    let largest = sizes.iter().fold(0.0f64, |s, e| s.max(e.abs()));
    Some(m.end.balance.abs() / (1e-10 * largest))
}

fn restart_law(x: &[f64]) -> Option<f64> {
    let i = RunUp::unpack(x)?;
    let model = solver_model(i).ok()?;
    let end = |i| Some(motion_of(&*model, i, settings()).ok()?.0.end);
    let whole = end(i)?;
    let first = RunUpInput {
        duration: 0.5 * i.duration,
        ..i
    };
    let half = end(first)?;
    let (phi0, psi0) = (half.phi, half.psi);
    let end = end(RunUpInput {
        phi0,
        psi0,
        ..first
    })?;
    let off = |a: f64, b: f64| (a - b).abs() / (1e-10 * a.abs());
    Some(off(whole.phi, end.phi).max(off(whole.psi, end.psi)))
}

/// Evaluations made and the end of the motion, by another method or at another tolerance.
pub(in crate::methods) fn at_tolerance(
    i: RunUpInput,
    tolerance: f64,
    method: Integration,
) -> (u64, SolverAnswer) {
    let settings = Settings {
        tolerance,
        method,
        ..Settings::default()
    };
    match motion_with(i, settings) {
        Ok((m, _)) => (
            m.counts.evaluations,
            SolverAnswer::Values(vec![m.end.phi, m.end.psi]),
        ),
        Err(word) => (0, SolverAnswer::Refuses(word)),
    }
}

/// The enclosed end of the motion.
pub(in crate::methods) fn truth(i: RunUpInput, bits: u32) -> Result<Vec<Ball>, Uncertified> {
    let exact = exact(&i.to_vec());
    match exact.as_deref().and_then(RunUp::unpack) {
        Some(i) => RunUp::reference(i, bits)?.certified(),
        None => RunUp::reference_not_finite(i).certified(),
    }
}

/// 0.5 kg m² under the motor of the sand screen, to nearly its speed.
pub(in crate::methods) fn bare_rotor_under_kloss() -> RunUpInput<'static> {
    RunUpInput {
        i1: 0.5,
        ..sand_screen(CONSTANT, 0.0, 0.03125)
    }
}

/// The sand screen with exact coefficients.
pub(in crate::methods) fn sand_screen_from_rest(duration: f64) -> RunUpInput<'static> {
    sand_screen(EXACT, 0.0, duration)
}

/// Kloss motor with ω_c = 10 rad/s, M_n = 200 N·m, k = 2.2, s_n = 0.05 at the crank of the sand
/// screen, from rest at 14.426°.
fn sand_screen(coefficients: f64, nodes: f64, duration: f64) -> RunUpInput<'static> {
    RunUpInput {
        coefficients,
        nodes,
        motor: KLOSS,
        torque: 200.0,
        overload: 2.2,
        rated_slip: 0.05,
        no_load_speed: 10.0,
        i1: 0.0,
        phi0: 14.426f64.to_radians(),
        psi0: 0.0,
        duration,
        linkage: at_degrees(14.426, 2.0),
    }
}

fn any_motor(d: &mut Draw, i: &mut RunUpInput, torque: f64, speed: f64) {
    i.motor = d.integer(0, 2) as f64;
    i.torque = torque * d.log_uniform(0.3, 3.0);
    i.overload = d.uniform(1.0, 4.0);
    i.rated_slip = d.log_uniform(0.01, 0.2);
    i.no_load_speed = speed * d.log_uniform(0.5, 2.0);
}

fn bare_rotor(d: &mut Draw) -> RunUpInput<'static> {
    let mut i = sand_screen(CONSTANT, 0.0, 0.0);
    any_motor(d, &mut i, 10.0, 50.0);
    let (torque, speed) = (i.torque, i.no_load_speed);
    i.i1 = d.log_uniform(0.01, 1.0);
    // In units of the time that the torque takes to bring it to that speed.
    i.duration = i.i1 * speed / torque * d.log_uniform(0.01, 3.0);
    i.phi0 = d.uniform(1.0, 6.0);
    if d.chance(0.5) {
        // Moving with its motor, at up to twice its speed.
        i.psi0 = speed * d.uniform(0.01, 2.0);
    }
    if i.motor == STEADY && d.chance(0.5) {
        for v in [&mut i.torque, &mut i.phi0, &mut i.psi0] {
            *v = -*v;
        }
    }
    i
}

fn from_rest(d: &mut Draw) -> RunUpInput<'static> {
    let mut i = sand_screen(EXACT, 0.0, d.log_uniform(5e-4, 4e-3));
    i.torque = d.uniform(100.0, 400.0);
    i.overload = d.uniform(1.5, 3.0);
    i.rated_slip = d.uniform(0.02, 0.1);
    i.phi0 += d.uniform(0.0, 0.3);
    if d.chance(0.5) {
        i.i1 = d.log_uniform(1e-3, 2.0);
    }
    i
}

fn moving(d: &mut Draw) -> RunUpInput<'static> {
    let coefficients = d.one_of(&[EXACT, SPLINES, HYBRID]);
    let nodes = d.one_of(&[12.0, 24.0, 48.0]);
    let mut i = sand_screen(coefficients, nodes, d.log_uniform(1e-5, 2e-3));
    any_motor(d, &mut i, 200.0, 10.0);
    i.phi0 = d.uniform(1.0, 12.0);
    i.psi0 = d.uniform(5.0, 12.0);
    if d.chance(0.5) {
        i.i1 = d.log_uniform(1e-3, 2.0);
    }
    i
}

#[cfg(test)]
mod tests;
