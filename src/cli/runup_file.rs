//! The tables of a file that describe the machine around the linkage: motor, load and run.

use super::args::RunupArgs;
use super::branch::{self, Reach};
use super::crank_angles::start_degrees;
use super::dyad_file::{Dyad, Shape};
use super::failure::Failure;
use super::fields::{Written, may, need, parse};
use super::linkage_file::{self, BodyTable, Described, Linkage, rounded};
use super::quantity::{Kind, nearest};
use mechaudit::audit::did_you_mean;
use mechaudit::reference::class_iii as exact;
use mechaudit::solvers::reduction::Body;
use mechaudit::solvers::run_up::{
    ClassIiiModel, Drive, FourBarModel, Kloss, Method, Motor, MotorError, Plan, ReducedModel,
    Resistance, Settings, SliderCrankModel, TableReading, TorqueTable,
};
use mechaudit::solvers::units::{Acceleration, AngularVelocity, Inertia, Mass, Torque};
use rug::Rational;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The tables read here; those of the linkage are read elsewhere.
#[derive(Deserialize)]
struct File {
    gravity: Option<Written>,
    start: Option<StartTable>,
    #[serde(default)]
    bodies: BTreeMap<String, BodyTable>,
    motor: Option<MotorTable>,
    #[serde(default)]
    load: LoadTable,
    run: Option<RunTable>,
}

#[derive(Deserialize)]
struct StartTable {
    speed: Option<Written>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MotorTable {
    kind: Option<String>,
    synchronous_speed: Option<Written>,
    rated_torque: Option<Written>,
    overload: Option<f64>,
    rated_slip: Option<f64>,
    pull_out_torque: Option<Written>,
    critical_slip: Option<f64>,
    standstill_torque: Option<Written>,
    no_load_speed: Option<Written>,
    torque: Option<Written>,
    points: Option<Vec<[Written; 2]>>,
    reading: Option<String>,
    ratio: Option<f64>,
    rotor_inertia: Option<Written>,
    flywheel: Option<Written>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct LoadTable {
    constant: Option<Written>,
    viscous: Option<Written>,
    quadratic: Option<Written>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RunTable {
    duration: Option<Written>,
    step: Option<Written>,
    tolerance: Option<f64>,
    method: Option<String>,
    coefficients: Option<String>,
    nodes: Option<usize>,
    target_speed: Option<Written>,
    settle: Option<f64>,
    fluctuation: Option<f64>,
}

/// Where the coefficients come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coefficients {
    Exact,
    Splines,
    Hybrid,
}

impl Coefficients {
    pub fn name(self) -> &'static str {
        match self {
            Coefficients::Exact => "exact",
            Coefficients::Splines => "splines",
            Coefficients::Hybrid => "hybrid",
        }
    }
}

/// A machine and what it is to do.
pub struct Machine {
    pub name: String,
    pub kind: &'static str,
    pub model: Box<dyn ReducedModel>,
    pub drive: Drive,
    pub motor_kind: &'static str,
    pub plan: Plan,
    pub coefficients: Coefficients,
    pub nodes: usize,
    pub fluctuation: Option<f64>,
}

/// Nodes of the splines if nobody says how many: one for each row of the paper's tables.
const NODES: usize = 48;
/// Rows of a run without a step.
const ROWS: f64 = 1000.0;

/// Reads the machine that the arguments name.
pub fn read(args: &RunupArgs) -> Result<Machine, Failure> {
    let (text, json) = linkage_file::text(&args.file)?;
    let about = |what: String| Failure::new(format!("{}: {what}", args.file.display()));
    let described = linkage_file::described(&text, json, true).map_err(about)?;
    let file: File = parse(&text, json).map_err(about)?;
    machine(args, described, file).map_err(|f| match f {
        Failure::Message(what) => about(what),
        other => other,
    })
}

fn machine(args: &RunupArgs, described: Described, file: File) -> Result<Machine, Failure> {
    let motor = file.motor.as_ref();
    let motor = motor.ok_or_else(|| Failure::new("the table [motor] is missing"))?;
    let run = file.run.as_ref();
    let run = run.ok_or_else(|| Failure::new("the table [run] is missing"))?;
    let (drive, motor_kind) = drive(motor, &file.load).map_err(Failure::new)?;
    let (name, kind, model, phi) = match &described {
        Described::ClassIii(linkage) => {
            let (model, phi) = class_iii(linkage)?;
            (linkage.name.clone(), "class-iii", model, phi)
        }
        Described::Dyad(dyad) => {
            let (model, phi) = dyad_model(dyad, &file).map_err(Failure::new)?;
            (dyad.name.clone(), dyad.shape.kind(), model, phi)
        }
    };
    let name = name.unwrap_or_else(|| format!("{kind} linkage"));
    let speed = file.start.as_ref().and_then(|s| s.speed.clone());
    let speed = may(Kind::AngularVelocity, "start.speed", &speed).map_err(Failure::new)?;
    let psi = speed.map_or(0.0, |q| q.to_f64());
    let plan = plan(args, run, phi, psi).map_err(Failure::new)?;
    let coefficients = args.coefficients.as_deref().or(run.coefficients.as_deref());
    if coefficients.is_none_or(|c| c == "exact") {
        let field = match (args.nodes, run.nodes, args.coefficients.is_some()) {
            (Some(_), ..) => Some("--nodes"),
            // Exact on the command line may stand against splines in the file.
            (None, Some(_), false) => Some("run.nodes"),
            _ => None,
        };
        if let Some(field) = field {
            return Err(Failure::new(format!(
                "{field} has no meaning with exact coefficients: choose coefficients splines or hybrid"
            )));
        }
    }
    Ok(Machine {
        name,
        kind,
        model,
        drive,
        motor_kind,
        plan,
        coefficients: match coefficients {
            None | Some("exact") => Coefficients::Exact,
            Some("splines") => Coefficients::Splines,
            Some("hybrid") => Coefficients::Hybrid,
            Some(other) => {
                return Err(Failure::new(format!(
                    "coefficients = {other:?}{} must be \"exact\", \"splines\" or \"hybrid\"",
                    did_you_mean(other, &["exact", "splines", "hybrid"])
                )));
            }
        },
        nodes: args.nodes.or(run.nodes).unwrap_or(NODES),
        fluctuation: run.fluctuation,
    })
}

fn quoted(names: &[&str]) -> String {
    let all: Vec<String> = names.iter().map(|n| format!("{n:?}")).collect();
    all.join(", ")
}

fn plan(args: &RunupArgs, run: &RunTable, phi: f64, psi: f64) -> Result<Plan, String> {
    let duration = need(Kind::Time, "run.duration", &run.duration)?.to_f64();
    let step = may(Kind::Time, "run.step", &run.step)?;
    let target = may(Kind::AngularVelocity, "run.target_speed", &run.target_speed)?;
    let method = match args.method.as_deref().or(run.method.as_deref()) {
        None => Method::default(),
        Some(name) => *Method::ALL
            .iter()
            .find(|m| m.name() == name)
            .ok_or_else(|| {
                let all = Method::ALL.map(|m| m.name());
                let meant = did_you_mean(name, &all);
                format!("method = {name:?}{meant} must be one of {}", quoted(&all))
            })?,
    };
    let defaults = Settings::default();
    let tolerance = args.tolerance.or(run.tolerance);
    Ok(Plan {
        phi,
        psi,
        duration,
        target: target.map(|q| q.to_f64()),
        settled: run.settle,
        sampling: Some(step.map_or(duration / ROWS, |q| q.to_f64())),
        settings: Settings {
            tolerance: tolerance.unwrap_or(defaults.tolerance),
            method,
            switch_when_stiff: args.method.is_none() && run.method.is_none(),
            ..defaults
        },
    })
}

fn class_iii(linkage: &Linkage) -> Result<(Box<dyn ReducedModel>, f64), Failure> {
    let masses = linkage.masses.as_ref().ok_or_else(no_bodies)?;
    let start = start_degrees(linkage).unwrap_or_default();
    let branch = branch::choose(&linkage.solver, &start, None, &linkage.start)?;
    if let Reach::Part { .. } = branch.reach {
        super::complain(&branch.range_line());
    }
    let phi = branch.start.phi1;
    let model = ClassIiiModel::new(linkage.solver, masses.solver, branch.start);
    Ok((Box::new(model), phi))
}

fn no_bodies() -> Failure {
    Failure::new("a run needs masses: the tables [bodies.…] are missing")
}

fn dyad_model(dyad: &Dyad, file: &File) -> Result<(Box<dyn ReducedModel>, f64), String> {
    let gravity = may(Kind::Acceleration, "gravity", &file.gravity)?;
    let gravity = Acceleration::from_m_per_s2(gravity.map_or(9.806_65, |g| g.to_f64()));
    let phi = dyad.start.as_ref().map_or(0.0, |d| nearest(d).to_radians());
    if file.bodies.is_empty() {
        return Err("a run needs masses: the tables [bodies.…] are missing".into());
    }
    let known: &[&str] = match dyad.shape {
        Shape::FourBar { .. } => &["crank", "coupler", "rocker"],
        Shape::SliderCrank { .. } => &["crank", "rod", "slider"],
    };
    if let Some(key) = file.bodies.keys().find(|k| !known.contains(&k.as_str())) {
        let known = known.join(", ");
        return Err(format!("[bodies.{key}]: the links are {known}"));
    }
    let body = |key: &str| -> Result<Body, String> {
        Ok(rounded(&match file.bodies.get(key) {
            Some(table) => table.read(&format!("bodies.{key}"))?,
            None => nothing(),
        }))
    };
    let refused = |e| format!("bodies: {e}");
    let model: Box<dyn ReducedModel> = match &dyad.shape {
        Shape::FourBar { solver, .. } => {
            let bodies = [body("crank")?, body("coupler")?, body("rocker")?];
            let model = FourBarModel::new(*solver, dyad.assembly, bodies, gravity);
            Box::new(model.map_err(refused)?)
        }
        Shape::SliderCrank { solver, .. } => {
            let slider = match file.bodies.get("slider") {
                Some(table) => need(Kind::Mass, "bodies.slider.mass", &table.mass)?.to_f64(),
                None => 0.0,
            };
            let bodies = [body("crank")?, body("rod")?];
            let slider = Mass::from_kg(slider);
            let model = SliderCrankModel::new(*solver, dyad.assembly, bodies, slider, gravity);
            Box::new(model.map_err(refused)?)
        }
    };
    Ok((model, phi))
}

fn nothing() -> exact::Body {
    exact::Body {
        mass: Rational::new(),
        inertia: Rational::new(),
        about_pivot: false,
        radius: Rational::new(),
        angle: exact::ExactAngle::Radians(Rational::new()),
    }
}

fn drive(motor: &MotorTable, load: &LoadTable) -> Result<(Drive, &'static str), String> {
    let (source, kind) = motor.read()?;
    let inertia = |field: &str, w: &Option<Written>| -> Result<Inertia, String> {
        let q = may(Kind::Inertia, &format!("motor.{field}"), w)?;
        Ok(Inertia::from_kg_m2(q.map_or(0.0, |q| q.to_f64())))
    };
    let of = |kind, field: &str, w: &Option<Written>| -> Result<f64, String> {
        Ok(may(kind, &format!("load.{field}"), w)?.map_or(0.0, |q| q.to_f64()))
    };
    let resistance = Resistance {
        constant: Torque::from_n_m(of(Kind::Torque, "constant", &load.constant)?),
        viscous_n_m_s: of(Kind::Damping, "viscous", &load.viscous)?,
        quadratic_n_m_s2: of(Kind::QuadraticDamping, "quadratic", &load.quadratic)?,
    };
    let drive = Drive::new(
        source,
        motor.ratio.unwrap_or(1.0),
        inertia("rotor_inertia", &motor.rotor_inertia)?,
        inertia("flywheel", &motor.flywheel)?,
        resistance,
    );
    Ok((drive.map_err(|e| format!("motor: {e}"))?, kind))
}

impl MotorTable {
    fn read(&self) -> Result<(Motor, &'static str), String> {
        let refused = |e: MotorError| format!("motor: {e}");
        let kind = self.kind.as_deref().ok_or("motor.kind is missing")?;
        let known: &[(&'static str, &[&str])] = &[
            ("off", &[]),
            ("constant", &["torque"]),
            ("linear", &["standstill_torque", "no_load_speed"]),
            (
                "kloss",
                &[
                    "synchronous_speed",
                    "rated_torque",
                    "overload",
                    "rated_slip",
                    "pull_out_torque",
                    "critical_slip",
                ],
            ),
            ("table", &["points", "reading"]),
        ];
        let Some((kind, fields)) = known.iter().find(|k| k.0 == kind) else {
            let all: Vec<&str> = known.iter().map(|k| k.0).collect();
            let meant = did_you_mean(kind, &all);
            return Err(format!(
                "motor.kind = {kind:?}{meant} must be one of {}",
                quoted(&all)
            ));
        };
        if let Some(field) = self.given().into_iter().find(|f| !fields.contains(f)) {
            return Err(format!("motor.{field} has no meaning with kind = {kind:?}"));
        }
        let torque = |field: &str, w: &Option<Written>| {
            need(Kind::Torque, &format!("motor.{field}"), w).map(|q| Torque::from_n_m(q.to_f64()))
        };
        let speed = |field: &str, w: &Option<Written>| {
            need(Kind::AngularVelocity, &format!("motor.{field}"), w)
                .map(|q| AngularVelocity::from_rad_per_s(q.to_f64()))
        };
        let number =
            |field: &str, x: Option<f64>| x.ok_or_else(|| format!("motor.{field} is missing"));
        let motor = match *kind {
            "off" => Motor::Off,
            "constant" => Motor::constant(torque("torque", &self.torque)?).map_err(refused)?,
            "linear" => Motor::linear(
                torque("standstill_torque", &self.standstill_torque)?,
                speed("no_load_speed", &self.no_load_speed)?,
            )
            .map_err(refused)?,
            "kloss" => {
                let synchronous = speed("synchronous_speed", &self.synchronous_speed)?;
                let rated = self.rated_torque.is_some()
                    || self.overload.is_some()
                    || self.rated_slip.is_some();
                let critical = self.pull_out_torque.is_some() || self.critical_slip.is_some();
                let motor = match (rated, critical) {
                    (true, true) => {
                        return Err("motor: rated_torque, overload, rated_slip and pull_out_torque, critical_slip exclude each other".into());
                    }
                    (_, true) => Kloss::critical(
                        synchronous,
                        torque("pull_out_torque", &self.pull_out_torque)?,
                        number("critical_slip", self.critical_slip)?,
                    ),
                    _ => Kloss::rated(
                        synchronous,
                        torque("rated_torque", &self.rated_torque)?,
                        number("overload", self.overload)?,
                        number("rated_slip", self.rated_slip)?,
                    ),
                };
                Motor::Kloss(motor.map_err(refused)?)
            }
            _ => Motor::Table(self.table()?),
        };
        Ok((motor, kind))
    }

    /// The fields given that belong to one kind of motor.
    fn given(&self) -> Vec<&'static str> {
        let all = [
            ("synchronous_speed", self.synchronous_speed.is_some()),
            ("rated_torque", self.rated_torque.is_some()),
            ("overload", self.overload.is_some()),
            ("rated_slip", self.rated_slip.is_some()),
            ("pull_out_torque", self.pull_out_torque.is_some()),
            ("critical_slip", self.critical_slip.is_some()),
            ("standstill_torque", self.standstill_torque.is_some()),
            ("no_load_speed", self.no_load_speed.is_some()),
            ("torque", self.torque.is_some()),
            ("points", self.points.is_some()),
            ("reading", self.reading.is_some()),
        ];
        all.into_iter().filter(|f| f.1).map(|f| f.0).collect()
    }

    fn table(&self) -> Result<TorqueTable, String> {
        let written = self.points.as_ref().ok_or("motor.points is missing")?;
        let mut points = Vec::new();
        for (i, [speed, torque]) in written.iter().enumerate() {
            let read = |kind, w: &Written| {
                need(kind, &format!("motor.points[{i}]"), &Some(w.clone())).map(|q| q.to_f64())
            };
            points.push((
                read(Kind::AngularVelocity, speed)?,
                read(Kind::Torque, torque)?,
            ));
        }
        let reading = match self.reading.as_deref() {
            Some("linear") => TableReading::Linear,
            Some("cubic") => TableReading::Cubic,
            other => {
                let other = other.unwrap_or("");
                return Err(format!(
                    "motor.reading = {other:?} must be \"linear\" or \"cubic\""
                ));
            }
        };
        TorqueTable::new(&points, reading).map_err(|e| format!("motor: {e}"))
    }
}
