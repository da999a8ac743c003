//! Certified run-up: an enclosure of the motion of a linkage's crank under a motor.
//!
//! ```text
//! dψ/dt = (M_d(ψ) + M_o(φ) − ½ ψ² S(φ)) / (I_n(φ) + I_1)      dφ/dt = ψ
//! ```
//!
//! (Zinchenko 2008, (1) and (2), with S for dI_n/dφ.) S is the derivative of the I_n in use
//! ([`Coefficients::exact`], [`Coefficients::splines`], [`Coefficients::constant`]) or of a spline
//! beside the exact I_n ([`Coefficients::hybrid`]).
//!
//! # What is proved, and how
//! The crank angle is the independent variable. Between two stops of the crank the speed is the
//! solution of **one scalar** equation `d(½ψ²)/dφ = (M_d + M_o − ½ψ² S)/(I_n + I_1)` that does not
//! contain the time, and the time is an integral over its solution. There is no box that could
//! turn and wrap: the error of the speed is one number, which the motor's falling characteristic
//! makes smaller from step to step, and the error of the time adds up.
//!
//! 1. `linkage_panel`: I_n, dI_n/dφ, M_o as Taylor models (polynomial + bound) over panels of crank
//!    angles: a contraction on a complex disc for the joints, Cauchy's estimate for derivatives.
//!    The panels of one turn are used again in the next once the branch is proved to be closed.
//! 2. `series`: Taylor coefficients of the speed along the path by the recurrences of series
//!    arithmetic, in plain floating point.
//! 3. `step`, `proof`: the defect of that polynomial, bounded over the whole step in Taylor models,
//!    and the error that follows from it by a differential inequality in a tube that proves itself.
//!    No a-priori box has to be found first, and no high derivative is evaluated over a box. The
//!    start from rest is a step in `√(φ − φ_0)`, in which the motion is analytic.
//! 4. Steps end at the ends of panels, hence at every knot of a spline.
//!
//! Everything is proved, over long runs too; nothing rests on the agreement of two precisions. A
//! bound that cannot be shown gives [`Undecided`](crate::Undecided), as does a crank that
//! comes to a stop.
//!
//! ```
//! use mechaudit_reference::class_iii::ExactAngle;
//! use mechaudit_reference::run_up::{Coefficients, Motor, Run, integrate};
//! use rug::Rational;
//! let q = |a, b| Rational::from((a, b));
//! // I = 0.9 kg m², no load: t = (I ω_c/2M_k) (S_k ln(1/S) + (1 − S²)/(2 S_k)).
//! let run = Run {
//!     motor: Motor::Kloss {
//!         breakdown_torque: q(22, 1),
//!         breakdown_slip: q(1, 5),
//!         synchronous: q(157, 1),
//!     },
//!     rotor_inertia: q(0, 1),
//!     angle: ExactAngle::Radians(q(0, 1)),
//!     speed: q(0, 1),
//! };
//! let model = Coefficients::constant(&q(9, 10), &q(0, 1), 128);
//! let motion = integrate(&model, &run, &[q(10, 1)])?;
//! // S(10) = 0.04526068701523353825770…
//! assert_eq!(motion.samples[0].speed.to_fixed(20).unwrap(), "149.89407213860833449354");
//! # Ok::<(), mechaudit_reference::Undecided>(())
//! ```

mod coefficients;
mod free_motion;
mod integrate;
mod linkage_curve;
mod linkage_panel;
mod motor;
mod piece;
mod proof;
mod series;
mod setting;
#[cfg(test)]
mod soundness_tests;
mod step;
#[cfg(test)]
mod tests;
mod twin;

pub use coefficients::Coefficients;
pub use free_motion::{FreeTurn, free_motion_factor};
pub use integrate::{Motion, Run, Sample, integrate, integrate_with};
pub use linkage_curve::LinkageCurve;
pub use motor::Motor;
pub use twin::{Leg, RungeKutta, follow_steps};
