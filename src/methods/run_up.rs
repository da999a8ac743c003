//! The run-up of a class-III linkage under a motor: crank angle and speed after a given time.

use super::class_iii as linkage_input;
use super::run_up_twin;
use crate::audit::{
    Budget, CheckPoint, Domain, Draw, HardCase, Input, Law, Limit, Method, Output, Proof,
    Reference, ReferenceAnswer, Region, SolverAnswer,
};
use crate::reference::Ball;
use crate::reference::class_iii::{self as exact, ExactAngle};
use crate::reference::run_up as certified;
use crate::reference::run_up::LinkageCurve;
use crate::solvers::class_iii::State;
use crate::solvers::run_up::{
    ClassIiiModel, ConstantInertia, Drive, Equation, Hybrid, Kloss, Method as Integration, Motion,
    Motor, Outcome, Plan, ReducedModel, Resistance, Settings, Splined, Stretch, run_recorded,
};
use crate::solvers::units::{AngularVelocity, Inertia, Torque};
use rug::Rational;
use std::sync::{Arc, Mutex};

/// See the module.
pub struct Audit;

// The layout of the input; the linkage's own follows.
const MODEL: usize = 0;
const NODES: usize = 1;
const MOTOR: usize = 2;
const MOTOR_VALUES: usize = 3;
pub(super) const ROTOR: usize = 7;
pub(super) const ANGLE: usize = 8;
pub(super) const SPEED: usize = 9;
pub(super) const DURATION: usize = 10;
const LINKAGE: usize = 11;
pub(super) const LENGTH: usize = LINKAGE + linkage_input::LENGTH;

/// Values of [`MODEL`].
const CONSTANT: f64 = 0.0;
pub(super) const EXACT: f64 = 1.0;
pub(super) const SPLINES: f64 = 2.0;
pub(super) const HYBRID: f64 = 3.0;

/// Values of [`MOTOR`].
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

fn solver_model(x: &[f64]) -> Result<Box<dyn ReducedModel>, &'static str> {
    if x[MODEL] == CONSTANT {
        return Ok(Box::new(ConstantInertia(0.0)));
    }
    let y = &x[LINKAGE..];
    let first = y[linkage_input::PHI1];
    let nodes = x[NODES] as usize;
    let linkage = linkage_input::linkage(y).ok_or("geometry")?;
    let masses = linkage_input::masses(y).ok_or("masses")?;
    let modes = linkage.assembly_modes(first).modes;
    if modes.is_empty() {
        return Err("cannot be assembled");
    }
    let mode = modes[y[linkage_input::MODE] as usize % modes.len()];
    let state: State = linkage.state(first, mode).ok_or("singular")?;
    let model = ClassIiiModel::new(linkage, masses, state);
    Ok(match x[MODEL] {
        EXACT => Box::new(model),
        SPLINES => Box::new(Splined::new(&model, first, nodes).map_err(|_| "splines")?),
        HYBRID => Box::new(Hybrid::new(model, first, nodes).map_err(|_| "splines")?),
        _ => return Err("layout"),
    })
}

fn solver_motor(x: &[f64]) -> Option<Motor> {
    let m = |k: usize| x[MOTOR_VALUES + k];
    let (torque, speed) = (Torque::from_n_m, AngularVelocity::from_rad_per_s);
    match x[MOTOR] {
        STEADY => Motor::constant(torque(m(0))).ok(),
        STRAIGHT => Motor::linear(torque(m(0)), speed(m(3))).ok(),
        KLOSS => Kloss::rated(speed(m(3)), torque(m(0)), m(1), m(2))
            .ok()
            .map(Motor::Kloss),
        _ => None,
    }
}

/// The motion by the code under test, for a duration of its own.
fn motion(x: &[f64], from: (f64, f64), duration: f64) -> Result<Motion, &'static str> {
    let settings = Settings {
        tolerance: TOLERANCE,
        ..Settings::default()
    };
    motion_with(x, from, duration, settings).map(|(motion, _)| motion)
}

/// The motion and the stretches that make it up.
pub(super) fn motion_with(
    x: &[f64],
    from: (f64, f64),
    duration: f64,
    settings: Settings,
) -> Result<(Motion, Vec<Stretch>), &'static str> {
    if x.len() != LENGTH {
        return Err("layout");
    }
    let model = solver_model(x)?;
    let motor = solver_motor(x).ok_or("motor")?;
    let none = Inertia::from_kg_m2(0.0);
    let rotor = Inertia::from_kg_m2(x[ROTOR]);
    let drive = Drive::new(motor, 1.0, none, rotor, Resistance::default()).map_err(|_| "motor")?;
    let plan = Plan {
        psi: from.1,
        settings,
        ..Plan::new(from.0, duration)
    };
    let (motion, stretches) =
        run_recorded(&Equation::new(&*model, &drive), &plan).map_err(|_| "no motion")?;
    match motion.outcome {
        Outcome::TimeUp => Ok((motion, stretches)),
        _ => Err("stopped"),
    }
}

/// Curves of linkages met lately, by input and precision.
static CURVES: Mutex<Vec<Known>> = Mutex::new(Vec::new());
type Known = (Vec<Rational>, u32, Arc<LinkageCurve>);
const CURVES_KEPT: usize = 8;

fn curve(y: &[Rational], bits: u32) -> Result<Arc<LinkageCurve>, ReferenceAnswer> {
    let mut known = CURVES.lock().unwrap_or_else(|e| e.into_inner());
    if let Some((_, _, c)) = known.iter().find(|(k, b, _)| *b == bits && k == y) {
        return Ok(c.clone());
    }
    let geometry = y[..11].try_into().map(exact::Geometry::from_values);
    let geometry = geometry.map_err(|_| ReferenceAnswer::Refuses("layout"))?;
    let offset = ExactAngle::Radians(y[linkage_input::PHI1].clone());
    let linkage = exact::Linkage::new(&geometry, bits);
    let mut modes = linkage
        .modes(&offset.to_ball(bits))
        .map_err(|e| ReferenceAnswer::Undecided(e.reason))?;
    if modes.is_empty() {
        return Err(ReferenceAnswer::Refuses("cannot be assembled"));
    }
    let index = y[linkage_input::MODE].to_f64() as usize % modes.len();
    let start = modes.swap_remove(index).configuration;
    let masses = linkage_input::exact_masses(y);
    let made = Arc::new(LinkageCurve::new(
        &geometry, &masses, &offset, &start, PANELS, bits,
    ));
    if known.len() == CURVES_KEPT {
        known.remove(0);
    }
    known.push((y.to_vec(), bits, made.clone()));
    Ok(made)
}

pub(super) fn reference_model(
    x: &[Rational],
    bits: u32,
) -> Result<certified::Coefficients, ReferenceAnswer> {
    let undecided = |e: crate::reference::Undecided| ReferenceAnswer::Undecided(e.reason);
    let (kind, nodes) = (x[MODEL].to_f64(), x[NODES].to_f64() as u32);
    if kind == CONSTANT {
        let zero = Rational::new();
        return Ok(certified::Coefficients::constant(&zero, &zero, bits));
    }
    let curve = curve(&x[LINKAGE..], bits)?;
    match kind {
        EXACT => Ok(certified::Coefficients::exact(&curve)),
        SPLINES => certified::Coefficients::splines(&curve, nodes).map_err(undecided),
        HYBRID => certified::Coefficients::hybrid(&curve, nodes).map_err(undecided),
        _ => Err(ReferenceAnswer::Refuses("layout")),
    }
}

fn reference_motor(x: &[Rational]) -> Option<certified::Motor> {
    let m = |k: usize| x[MOTOR_VALUES + k].clone();
    Some(match x[MOTOR].to_f64() {
        STEADY => certified::Motor::Constant { torque: m(0) },
        // M_0 (1 − ψ/ω_0).
        STRAIGHT => certified::Motor::Linear {
            standstill: m(0),
            slope: m(0) / m(3),
        },
        KLOSS => certified::Motor::Rated {
            torque: m(0),
            overload: m(1),
            slip: m(2),
            synchronous: m(3),
        },
        _ => return None,
    })
}

/// What the reference starts from.
pub(super) fn reference_run(x: &[Rational]) -> Option<certified::Run> {
    Some(certified::Run {
        motor: reference_motor(x)?,
        rotor_inertia: x[ROTOR].clone(),
        angle: ExactAngle::Radians(x[ANGLE].clone()),
        speed: x[SPEED].clone(),
    })
}

impl Method for Audit {
    fn name(&self) -> &'static str {
        "run-up"
    }

    fn summary(&self) -> &'static str {
        "crank angle and speed of a linkage under a motor after a given time, at tolerance 1e-12"
    }

    fn source(&self) -> &'static str {
        "Zinchenko (2008), eqs (1), (2), with I_n by (4), dI_n/dphi by (5), M_o by (7), or splines"
    }

    fn inputs(&self) -> Vec<Input> {
        let i = |name, unit| Input { name, unit };
        let mut all = vec![
            i(
                "coefficients (0 none but I1, 1 exact, 2 splines, 3 exact with S' for dI_n/dphi)",
                "1",
            ),
            i("nodes (of the splines, the first at phi1)", "1"),
            i("motor (0 constant, 1 straight, 2 Kloss)", "1"),
            i("torque (Kloss: rated)", "N m"),
            i("overload", "1"),
            i("rated_slip", "1"),
            i("no_load_speed", "rad/s"),
            i("I1", "kg m^2"),
            i("phi0 (phi at the start)", "rad"),
            i("psi0 (psi at the start)", "rad/s"),
            i("duration", "s"),
        ];
        all.extend(linkage_input::inputs());
        all
    }

    fn outputs(&self) -> Vec<Output> {
        let o = |name, unit| Output {
            name,
            unit,
            budget: BUDGET,
        };
        vec![o("phi", "rad"), o("psi", "rad/s")]
    }

    fn domain(&self) -> Domain {
        let region = |name, description, sample| Region {
            name,
            description,
            sample,
        };
        let point = |name, input| CheckPoint { name, input };
        Domain {
            regions: vec![
                region(
                    "bare-rotor",
                    "constant inertia, any motor, forward and backward, for 0.01 to 3 times the \
                     time that the torque takes to bring it to speed",
                    bare_rotor,
                ),
                region(
                    "from-rest",
                    "the sand screen under a Kloss motor from rest near a dead position, with and \
                     without a rotor, 0.5 to 4 ms",
                    from_rest,
                ),
                region(
                    "moving",
                    "the sand screen at any crank angle and speed, any motor and coefficients, \
                     10 µs to 2 ms",
                    moving,
                ),
            ],
            check_points: vec![
                point("exact-100-ms", sand_screen(EXACT, 0.0, 0.1)),
                point("splines-12-100-ms", sand_screen(SPLINES, 12.0, 0.1)),
                point("hybrid-12-100-ms", sand_screen(HYBRID, 12.0, 0.1)),
            ],
        }
    }

    fn hard(&self) -> Vec<HardCase> {
        HardCase::included(include_str!("../../reference/hard/run-up.csv"))
    }

    /// As short as in the regions: a reference costs the more the longer it runs.
    fn admits(&self, x: &[f64]) -> bool {
        let whole = |x: &[f64]| [MODEL, NODES, MOTOR].iter().all(|k| x[*k].fract() == 0.0);
        x.len() == LENGTH
            && whole(x)
            && linkage_input::choices_are_whole(&x[LINKAGE..])
            && (x[MODEL] == CONSTANT || x[DURATION] <= 5e-3)
    }

    fn solve(&self, x: &[f64]) -> SolverAnswer {
        if x.len() != LENGTH {
            return SolverAnswer::Refuses("layout");
        }
        match motion(x, (x[ANGLE], x[SPEED]), x[DURATION]) {
            Ok(m) => SolverAnswer::Values(vec![m.end.phi, m.end.psi]),
            Err(word) => SolverAnswer::Refuses(word),
        }
    }

    fn reference(&self, x: &[Rational], bits: u32) -> ReferenceAnswer {
        if x.len() != LENGTH {
            return ReferenceAnswer::Refuses("layout");
        }
        // The budget is far above an ulp: fewer bits decide, and more are asked for if not. 80 leave
        // radii of a few ulps after a start from rest.
        let bits = bits * 5 / 8;
        let model = match reference_model(x, bits) {
            Ok(model) => model,
            Err(answer) => return answer,
        };
        let Some(run) = reference_run(x) else {
            return ReferenceAnswer::Refuses("layout");
        };
        match certified::integrate(&model, &run, std::slice::from_ref(&x[DURATION])) {
            Ok(m) => ReferenceAnswer::Values(Reference {
                values: vec![m.samples[0].angle.clone(), m.samples[0].speed.clone()],
                proof: Proof::Bounded(
                    "Taylor polynomials with their defect bounded in Taylor models and the error \
                     by a differential inequality in the crank angle (Walter 1998, §9); the \
                     linkage by a contraction and Cauchy's estimate",
                ),
            }),
            Err(e) => ReferenceAnswer::Undecided(e.reason),
        }
    }

    fn twin(&self, x: &[f64]) -> Option<Vec<Ball>> {
        run_up_twin::twin(x, TOLERANCE, Integration::default())
    }

    fn laws(&self) -> Vec<Law> {
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
    if x.len() != LENGTH || x[MODEL] == HYBRID {
        return None;
    }
    let m = motion(x, (x[ANGLE], x[SPEED]), x[DURATION]).ok()?;
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
    let from = (*x.get(ANGLE)?, *x.get(SPEED)?);
    let t = *x.get(DURATION)?;
    let whole = motion(x, from, t).ok()?.end;
    let half = motion(x, from, 0.5 * t).ok()?.end;
    let end = motion(x, (half.phi, half.psi), 0.5 * t).ok()?.end;
    let off = |a: f64, b: f64| (a - b).abs() / (1e-10 * a.abs());
    Some(off(whole.phi, end.phi).max(off(whole.psi, end.psi)))
}

/// Evaluations made and the end of the motion, by another method or at another tolerance.
pub(super) fn at_tolerance(x: &[f64], tolerance: f64, method: Integration) -> (u64, SolverAnswer) {
    let settings = Settings {
        tolerance,
        method,
        ..Settings::default()
    };
    match motion_with(x, (x[ANGLE], x[SPEED]), x[DURATION], settings) {
        Ok((m, _)) => (
            m.counts.evaluations,
            SolverAnswer::Values(vec![m.end.phi, m.end.psi]),
        ),
        Err(word) => (0, SolverAnswer::Refuses(word)),
    }
}

/// The enclosed end of the motion.
pub(super) fn truth(x: &[f64], bits: u32) -> ReferenceAnswer {
    let exact: Option<Vec<Rational>> = x.iter().map(|&v| Rational::from_f64(v)).collect();
    match exact {
        Some(exact) => Audit.reference(&exact, bits),
        None => Audit.reference_not_finite(x),
    }
}

/// 0.5 kg m² under the motor of the sand screen, to nearly its speed.
pub(super) fn bare_rotor_under_kloss() -> Vec<f64> {
    let mut x = sand_screen(CONSTANT, 0.0, 0.03125);
    x[ROTOR] = 0.5;
    x
}

/// The sand screen with exact coefficients.
pub(super) fn sand_screen_from_rest(duration: f64) -> Vec<f64> {
    sand_screen(EXACT, 0.0, duration)
}

/// Kloss motor with ω_c = 10 rad/s, M_n = 200 N·m, k = 2.2, s_n = 0.05 at the crank of the sand
/// screen, from rest at 14.426°.
pub(super) fn sand_screen(model: f64, nodes: f64, duration: f64) -> Vec<f64> {
    let first = 14.426f64.to_radians();
    let mut x = vec![
        model, nodes, KLOSS, 200.0, 2.2, 0.05, 10.0, 0.0, first, 0.0, duration,
    ];
    x.extend(linkage_input::at_degrees(14.426, 2.0));
    x
}

fn any_motor(d: &mut Draw, x: &mut [f64], torque: f64, speed: f64) {
    x[MOTOR] = d.integer(0, 2) as f64;
    x[MOTOR_VALUES] = torque * d.log_uniform(0.3, 3.0);
    x[MOTOR_VALUES + 1] = d.uniform(1.0, 4.0);
    x[MOTOR_VALUES + 2] = d.log_uniform(0.01, 0.2);
    x[MOTOR_VALUES + 3] = speed * d.log_uniform(0.5, 2.0);
}

fn bare_rotor(d: &mut Draw) -> Vec<f64> {
    let mut x = sand_screen(CONSTANT, 0.0, 0.0);
    any_motor(d, &mut x, 10.0, 50.0);
    let (torque, speed) = (x[MOTOR_VALUES], x[MOTOR_VALUES + 3]);
    x[ROTOR] = d.log_uniform(0.01, 1.0);
    // In units of the time that the torque takes to bring it to that speed.
    x[DURATION] = x[ROTOR] * speed / torque * d.log_uniform(0.01, 3.0);
    x[ANGLE] = d.uniform(1.0, 6.0);
    if d.chance(0.5) {
        // Moving with its motor, at up to twice its speed.
        x[SPEED] = speed * d.uniform(0.01, 2.0);
    }
    if x[MOTOR] == STEADY && d.chance(0.5) {
        for k in [MOTOR_VALUES, ANGLE, SPEED] {
            x[k] = -x[k];
        }
    }
    x
}

fn from_rest(d: &mut Draw) -> Vec<f64> {
    let mut x = sand_screen(EXACT, 0.0, d.log_uniform(5e-4, 4e-3));
    x[MOTOR_VALUES] = d.uniform(100.0, 400.0);
    x[MOTOR_VALUES + 1] = d.uniform(1.5, 3.0);
    x[MOTOR_VALUES + 2] = d.uniform(0.02, 0.1);
    x[ANGLE] += d.uniform(0.0, 0.3);
    if d.chance(0.5) {
        x[ROTOR] = d.log_uniform(1e-3, 2.0);
    }
    x
}

fn moving(d: &mut Draw) -> Vec<f64> {
    let model = [EXACT, SPLINES, HYBRID][d.integer(0, 2)];
    let nodes = [12.0, 24.0, 48.0][d.integer(0, 2)];
    let mut x = sand_screen(model, nodes, d.log_uniform(1e-5, 2e-3));
    any_motor(d, &mut x, 200.0, 10.0);
    x[ANGLE] = d.uniform(1.0, 12.0);
    x[SPEED] = d.uniform(5.0, 12.0);
    if d.chance(0.5) {
        x[ROTOR] = d.log_uniform(1e-3, 2.0);
    }
    x
}
