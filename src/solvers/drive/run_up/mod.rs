//! The machine runs up: motion of a linkage's crank under a motor.
//!
//! ```text
//! dψ/dt = (M_d(ψ) + M_r(ψ) + M_o(φ) − ½ ψ² dI_n/dφ) / (I_n(φ) + I_1)      dφ/dt = ψ        (1)
//! ```
//!
//! with the crank angle φ, its speed ψ, the reduced inertia I_n and moment of weights M_o of any
//! [`ReducedModel`], a [`Drive`] (motor, reducer, rotor, flywheel, resistance), and the
//! coefficients exact or by splines ([`Splined`], [`Hybrid`]). Source: Zinchenko 2008, (1) and (2).
//!
//! | what | where |
//! |---|---|
//! | motion over time, with events and the balance of energy | `run` |
//! | steady cycle, coefficient of fluctuation | `steady_cycle` |
//! | flywheel for a wanted fluctuation | `flywheel` |
//!
//! These three need feature `run-up`.
//!
//! # Time integration
//! The steps are taken by the crate `differential-equations`: Verner's 9(8) by default, DOP853 and
//! and Radau IIA of order 5 (`Method`). It was chosen because it is pure Rust
//! with two small dependencies, has explicit methods of high order (a tolerance of 1e-12 is asked
//! for) beside implicit ones, and lets its user take the steps, so that each can end where the
//! right-hand side has a kink. Against: `diffsol` (order 5 at most, brings faer and serde),
//! `russell_ode` (needs BLAS), `ode_solvers` (explicit only, no events, an older nalgebra, and an
//! open report of wrong nodes in its DOP853).
//!
//! Its version 0.7.0 was found to have these limits: the dense output of DOP853 is wrong
//! in its upper half, so that method's steps end at the samples; Verner's 8(7) has an error
//! estimate that does not fall below 1e-12 of the state; Radau5 adjusts a scalar tolerance once for
//! each component and keeps its linear system after a rejected step, so tolerances are given for
//! each component and the method is begun afresh after two rejections in a row.
//!
//! # Accuracy
//! The sand screen of Zinchenko (2008) from rest under ω_c = 10 rad/s, M_n = 200 N·m, k = 2.2,
//! s_n = 0.05 at a tolerance of 1e-12, worst found at 300 moments of 3 s against a certified
//! enclosure: Verner's 9(8) 1.5e-12 rad/s, DOP853 1.9e-11 rad/s. `tests/library/run_up_accuracy.rs` repeats
//! it; `mechaudit runup FILE --work-precision` compares the methods on any machine. On this one,
//! stiff near its dead positions, Radau5 is the cheapest down to an error of about 1e-10 rad/s.
//!
//! # Stops
//! A step that crosses a spline's knot, a dead position, a kink of the motor's curve, a target
//! speed or standstill is located on the dense output and then **taken again** up to there, so the
//! state at such a stop has the accuracy of the step and not that of the interpolation.
//!
//! From standstill the crank goes on in the direction of the torque there, as a pendulum does,
//! unless the constant resistance holds it. Then the run ends, or waits for a motor whose torque is
//! a table over time ([`TimedTorque`]).

mod coefficients;
mod drive;
mod dyad_model;
mod equation;
mod model;
mod motor;
mod motor_error;
mod planar_model;
mod timed;

#[cfg(feature = "run-up")]
mod crossing;
#[cfg(feature = "run-up")]
mod flywheel;
#[cfg(feature = "run-up")]
mod integrate;
#[cfg(feature = "run-up")]
mod motion;
#[cfg(feature = "run-up")]
mod record;
#[cfg(feature = "run-up")]
mod runner;
#[cfg(feature = "run-up")]
mod steady;
#[cfg(feature = "run-up")]
mod stepper;
#[cfg(all(test, feature = "run-up"))]
mod swing_tests;
#[cfg(all(test, feature = "run-up"))]
mod tests;

pub use coefficients::{Hybrid, MOST_NODES, Splined, SplinedError};
pub use drive::{Drive, Resistance};
pub use dyad_model::{FourBarModel, SliderCrankModel};
pub use equation::{Equation, EquationError, Forces};
pub use model::{
    ClassIiiModel, Coefficients, ConstantInertia, InertiaRange, ModelError, ReducedModel,
    inertia_range,
};
pub use motor::{Kloss, Motor, OutsideTable, TableReading, TorqueTable};
pub use motor_error::MotorError;
pub use planar_model::{PlanarModel, PlanarModelError};
pub use timed::TimedTorque;

#[cfg(feature = "run-up")]
pub use flywheel::{Flywheel, FlywheelError, flywheel};
#[cfg(feature = "run-up")]
pub use integrate::{Counts, Settings, SettingsError};
#[cfg(feature = "run-up")]
pub use motion::{Event, EventKind, Motion, Outcome, Plan, RunError, Sample, Turn};
#[cfg(feature = "run-up")]
pub use record::{Stretch, Tableau, Taken};
#[cfg(feature = "run-up")]
pub use runner::{run, run_recorded};
#[cfg(feature = "run-up")]
pub use steady::{Cycle, CycleError, steady_cycle};
#[cfg(feature = "run-up")]
pub use stepper::Method;
