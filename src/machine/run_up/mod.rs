//! A machine as its file describes it: the linkage, and the sections of its motor, load and run.

#[cfg(feature = "report")]
mod certified;
mod columns;
mod drivetrain;
mod motor;
mod precision;
mod steady;

#[cfg(feature = "report")]
pub use certified::{CertifiedRun, CertifiedRunError};
pub use columns::{COLUMNS, row};
pub use drivetrain::{Drivetrain, Formulas, drivetrain, start_speed};
pub use motor::MotorKind;
pub use precision::{FINEST, MOMENTS, Point, work_precision};
pub use steady::Steady;

use super::class_iii::{self, Branch, BranchError};
use super::dyad::{Dyad, Shape};
use super::linkage::Linkage;
use super::planar;
use super::quantity::{Quantity, Time};
use super::source::{Refusal, Source};
use crate::reference::nearest_f64;
use crate::solvers::run_up::{
    ClassIiiModel, Drive, FourBarModel, Hybrid, Method, Plan, PlanarModel, ReducedModel, Settings,
    SliderCrankModel, Splined, SplinedError,
};
use crate::solvers::units::AngularVelocity;
use motor::{LoadSection, MotorSection, drive};
use serde::Deserialize;
use serde::de::{Deserializer, Error as _};

/// The sections read here; those of the linkage are read with it.
#[derive(Deserialize)]
struct File {
    start: Option<StartSection>,
    motor: MotorSection,
    #[serde(default)]
    load: LoadSection,
    run: RunSection,
}

#[derive(Deserialize)]
struct StartSection {
    speed: Option<Quantity<AngularVelocity>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RunSection {
    duration: Quantity<Time>,
    step: Option<Quantity<Time>>,
    tolerance: Option<f64>,
    #[serde(default, deserialize_with = "method")]
    method: Option<Method>,
    coefficients: Option<Coefficients>,
    nodes: Option<usize>,
    target_speed: Option<Quantity<AngularVelocity>>,
    settle: Option<f64>,
    fluctuation: Option<f64>,
}

fn method<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Method>, D::Error> {
    const NAMES: &[&str] = &["verner98", "dop853", "radau5"];
    let name = String::deserialize(from)?;
    let method = Method::ALL.into_iter().find(|m| m.name() == name);
    match method {
        Some(method) => Ok(Some(method)),
        None => Err(D::Error::unknown_variant(&name, NAMES)),
    }
}

/// Where the coefficients come from.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Coefficients {
    /// The linkage itself.
    #[default]
    Exact,
    /// Splines of all three.
    Splines,
    /// A spline of dI_n/dφ, the others exact.
    Hybrid,
}

impl Coefficients {
    /// All of them.
    pub const ALL: [Coefficients; 3] = [
        Coefficients::Exact,
        Coefficients::Splines,
        Coefficients::Hybrid,
    ];

    /// As the file names them.
    pub fn name(self) -> &'static str {
        match self {
            Coefficients::Exact => "exact",
            Coefficients::Splines => "splines",
            Coefficients::Hybrid => "hybrid",
        }
    }
}

/// Values that replace those of the file's run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Overrides {
    /// In place of `run.coefficients`.
    pub coefficients: Option<Coefficients>,
    /// In place of `run.nodes`.
    pub nodes: Option<usize>,
    /// In place of `run.tolerance`.
    pub tolerance: Option<f64>,
    /// In place of `run.method`.
    pub method: Option<Method>,
}

/// A machine and its run.
pub struct Machine {
    /// Its name, or one made of its type.
    pub name: String,
    /// The linkage's type as the file names it.
    pub linkage: &'static str,
    /// The linkage reduced to the crank.
    pub model: Box<dyn ReducedModel>,
    /// Motor, load and added inertia.
    pub drive: Drive,
    /// The kind of its motor.
    pub motor: MotorKind,
    /// The task to compute.
    pub plan: Plan,
    /// Where the coefficients come from.
    pub coefficients: Coefficients,
    /// Nodes of the splines.
    pub nodes: usize,
    /// The coefficient of fluctuation that a flywheel is wanted for.
    pub fluctuation: Option<f64>,
    /// The branch of a linkage of class III.
    pub branch: Option<Branch>,
}

/// Why a file describes no machine that can be run.
#[derive(Debug, thiserror::Error)]
pub enum MachineError {
    /// The file is refused.
    #[error(transparent)]
    File(#[from] Refusal),
    /// The linkage has no such branch.
    #[error(transparent)]
    Branch(#[from] BranchError),
    /// The mechanism has no such branch.
    #[error(transparent)]
    Mechanism(#[from] planar::PlanarError),
    /// The mechanism has neither masses nor loads.
    #[error("a run needs masses: no [[body]] has one")]
    NoMasses,
    /// The linkage has no masses.
    #[error("a run needs masses: the sections [bodies.…] are missing")]
    NoBodies,
}

/// Nodes of the splines if nobody says how many: one for each row of the paper's tables.
const NODES: usize = 48;
/// Rows of a run without a step.
const ROWS: f64 = 1000.0;

impl Machine {
    /// The reduced linkage with coefficients as the file wants them: exact, from splines through
    /// nodes of one turn from the start, or with the derivative of the inertia alone from splines.
    ///
    /// # Errors
    /// [`SplinedError`].
    pub fn reduced(&self) -> Result<Box<dyn ReducedModel + '_>, SplinedError> {
        let (exact, first) = (&*self.model, self.plan.phi);
        Ok(match self.coefficients {
            Coefficients::Exact => Box::new(exact),
            Coefficients::Splines => Box::new(Splined::new(exact, first, self.nodes)?),
            Coefficients::Hybrid => Box::new(Hybrid::new(exact, first, self.nodes)?),
        })
    }

    /// Reads the description of a machine.
    ///
    /// ```
    /// use mechaudit_cli::machine::{run_up, Source};
    /// use mechaudit::solvers::run_up::{run, Equation};
    /// let source = Source::toml(include_str!(concat!(
    ///     env!("CARGO_MANIFEST_DIR"), "/../../examples/four-bar-run-up.toml"
    /// )));
    /// let machine = run_up::Machine::read(&source, run_up::Overrides::default())?;
    /// let motion = run(&Equation::new(&*machine.reduced()?, &machine.drive), &machine.plan)?;
    /// assert!(motion.end.t > 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`MachineError`].
    pub fn read(source: &Source, overrides: Overrides) -> Result<Machine, MachineError> {
        let linkage = Linkage::read(source)?;
        let File {
            start,
            motor,
            load,
            run,
        } = source.parse()?;
        let drive = drive(source, &motor, &load)?;
        let type_name = match &linkage {
            Linkage::ClassIii(_) => "class-iii",
            Linkage::Dyad(dyad) => dyad.shape.type_name(),
            Linkage::Planar(_) => "planar",
        };
        let (name, model, phi, branch) = match linkage {
            Linkage::ClassIii(linkage) => {
                let (model, branch) = class_iii_model(&linkage)?;
                (linkage.name, model, branch.start.phi1, Some(branch))
            }
            Linkage::Dyad(dyad) => {
                let (model, phi) = dyad_model(source, &dyad)?;
                (dyad.name, model, phi, None)
            }
            Linkage::Planar(machine) => {
                let name = machine.name.clone();
                let (model, phi) = planar_model(source, *machine)?;
                (name, model, phi, None)
            }
        };
        let coefficients = overrides.coefficients.or(run.coefficients);
        let coefficients = coefficients.unwrap_or_default();
        // Exact in place of the file's own choice may stand against its nodes.
        let unused = run.nodes.is_some() && overrides.coefficients.is_none();
        if coefficients == Coefficients::Exact && unused {
            let rule = "run.nodes has no meaning with exact coefficients: choose coefficients splines or hybrid";
            return Err(source.breach("run.nodes", rule).into());
        }
        let psi = start.and_then(|s| s.speed).map_or(0.0, |q| q.to_f64());
        Ok(Machine {
            name: name.unwrap_or_else(|| format!("{type_name} linkage")),
            linkage: type_name,
            model,
            drive,
            motor: motor.kind,
            plan: run.plan(overrides, phi, psi),
            coefficients,
            nodes: overrides.nodes.or(run.nodes).unwrap_or(NODES),
            fluctuation: run.fluctuation,
            branch,
        })
    }
}

impl RunSection {
    fn plan(&self, overrides: Overrides, phi: f64, psi: f64) -> Plan {
        let duration = self.duration.to_f64();
        let step = self.step.as_ref().map_or(duration / ROWS, Quantity::to_f64);
        let method = overrides.method.or(self.method);
        let tolerance = overrides.tolerance.or(self.tolerance);
        let defaults = Settings::default();
        Plan {
            phi,
            psi,
            duration,
            target: self.target_speed.as_ref().map(Quantity::to_f64),
            settled: self.settle,
            sampling: Some(step),
            settings: Settings {
                tolerance: tolerance.unwrap_or(defaults.tolerance),
                method: method.unwrap_or_default(),
                switch_when_stiff: method.is_none(),
                ..defaults
            },
        }
    }
}

fn class_iii_model(
    linkage: &class_iii::Linkage,
) -> Result<(Box<dyn ReducedModel>, Branch), MachineError> {
    let masses = linkage.masses.as_ref().ok_or(MachineError::NoBodies)?;
    let start = linkage.start_degrees().unwrap_or_default();
    let branch = class_iii::choose(&linkage.solver, &start, None, &linkage.start)?;
    let model = ClassIiiModel::new(linkage.solver, masses.solver, branch.start);
    Ok((Box::new(model), branch))
}

fn dyad_model(source: &Source, dyad: &Dyad) -> Result<(Box<dyn ReducedModel>, f64), MachineError> {
    let degrees = dyad.start.as_ref();
    let phi = degrees.map_or(0.0, |d| nearest_f64(d).to_radians());
    let refused = |e| source.refuse("bodies", e);
    let model: Box<dyn ReducedModel> = match &dyad.shape {
        Shape::FourBar { solver, bodies, .. } => {
            let bodies = bodies.ok_or(MachineError::NoBodies)?;
            let model = FourBarModel::new(*solver, dyad.assembly, bodies, dyad.gravity);
            Box::new(model.map_err(refused)?)
        }
        Shape::SliderCrank { solver, bodies, .. } => {
            let (links, slider) = bodies.ok_or(MachineError::NoBodies)?;
            let gravity = dyad.gravity;
            let model = SliderCrankModel::new(*solver, dyad.assembly, links, slider, gravity);
            Box::new(model.map_err(refused)?)
        }
    };
    Ok((model, phi))
}

fn planar_model(
    source: &Source,
    machine: planar::Machine,
) -> Result<(Box<dyn ReducedModel>, f64), MachineError> {
    if !machine.has_loads() {
        return Err(MachineError::NoMasses);
    }
    let phi = machine.start.at.unwrap_or(0.0).to_radians();
    let branch = planar::choose(&machine, phi, None)?;
    let loads = branch.loads.ok_or(MachineError::NoMasses)?;
    let offset = machine.outer(0.0);
    let model = PlanarModel::new(machine.solver, loads, branch.start, offset);
    let model = model.map_err(|e| source.refuse("drive", e))?;
    Ok((Box::new(model), phi))
}

#[cfg(test)]
mod tests;
