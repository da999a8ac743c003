//! Steady cycle and flywheel of a machine after its run.

use super::{Machine, MotorKind};
use crate::solvers::run_up::{
    Cycle, CycleError, Equation, Flywheel, FlywheelError, Motion, flywheel, steady_cycle,
};

/// The steady cycle after the run, and the flywheel if one was asked for.
pub struct Steady {
    /// The cycle; `None` where there is none to look for.
    pub cycle: Option<Result<Cycle, CycleError>>,
    /// The flywheel for the wanted fluctuation.
    pub flywheel: Option<Result<Flywheel, FlywheelError>>,
    /// The coefficient of fluctuation wanted; NaN if none is.
    pub wanted: f64,
}

impl Steady {
    /// Looks for it from the speed that the run ended with. A motor that is off, one whose torque
    /// depends on the time or a crank that has come to rest has none.
    pub fn of(machine: &Machine, equation: &Equation, motion: &Motion) -> Steady {
        let (phi, psi) = (machine.plan.phi, motion.end.psi);
        let timed = machine.drive.motor().timed().is_some();
        let turns = machine.motor != MotorKind::Off && !timed && psi != 0.0;
        let settings = machine.plan.settings;
        Steady {
            cycle: turns.then(|| steady_cycle(equation, phi, psi, settings)),
            flywheel: machine
                .fluctuation
                .filter(|_| turns)
                .map(|d| flywheel(equation, phi, psi, d, settings)),
            wanted: machine.fluctuation.unwrap_or(f64::NAN),
        }
    }
}
