//! Initial value problems of graphs: certified solutions of `y′ = f(t, y, p)`, `y(t_0) = y_0(p)`.
//!
//! [`InitialValueProblem`] states the problem, [`Trajectory`] is its solution for one set of
//! inputs. A trajectory is extended as far as it is asked for, on both sides of the start.
//!
//! ```
//! use mechaudit_symbolic::evaluation::{Goal, InitialValueProblem, Limits, State};
//! use mechaudit_symbolic::{Definitions, parse};
//! use rug::Rational;
//!
//! let states = [
//!     State::new("theta", parse("3")?, parse("omega")?),
//!     State::new("omega", parse("0")?, parse("-g*sin(theta)")?),
//! ];
//! let problem = InitialValueProblem::new(&Definitions::default(), &["g"], "t", &parse("0")?, &states)?;
//! let g = Rational::from((981, 100));
//! let mut pendulum = problem.trajectory(&[g], Limits::default())?;
//! let at = pendulum.at(&Rational::from(1), Goal::Bits(67))?;
//! assert_eq!(at[0].to_decimal(20).unwrap(), "1.6022489019279171589");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod crossing;
mod field;
mod motion;
mod piece;
mod problem;
mod quantities;
mod sliding;
mod trajectory;

pub use problem::{InitialValueProblem, ProblemError, State};
pub use trajectory::{Derivatives, Limits, MotionError, Trajectory};
#[cfg(test)]
mod tests;
