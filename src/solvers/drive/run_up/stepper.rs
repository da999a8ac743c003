//! The library's methods behind one face: begin, try a step, read between its ends.

use differential_equations::error::Error as LibraryError;
use differential_equations::interpolate::Interpolation;
use differential_equations::methods::{ExplicitRungeKutta, ImplicitRungeKutta};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;

/// State of the integration: φ, ψ, work of motor, weights and resistance, `∫ ∂(dψ/dt)/∂ψ dt`.
pub(super) type State = [f64; 6];

/// φ in the state.
pub(super) const PHI: usize = 0;
/// ψ in the state.
pub(super) const PSI: usize = 1;
/// Work of motor, weights and resistance in the state, J.
pub(super) const WORK: [usize; 3] = [2, 3, 4];
/// `∫ ∂(dψ/dt)/∂ψ dt` in the state.
pub(super) const DAMPING: usize = 5;

/// A method of time integration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Verner, explicit, order 9 with an error estimate of order 8, dense output of order 9.
    #[default]
    Verner98,
    /// Dormand and Prince, explicit, order 8 with error estimates of order 5 and 3. The cheapest at
    /// tight tolerances if few samples are wanted: its steps end at the samples, see
    /// [the module](super).
    Dop853,
    /// Radau IIA, implicit, order 5: for stiff motors and loose tolerances. Its dense output is of
    /// order 3 only, so samples are less accurate than the motion.
    Radau5,
}

impl Method {
    /// All of them.
    pub const ALL: [Method; 3] = [Method::Verner98, Method::Dop853, Method::Radau5];

    /// Its name in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Method::Verner98 => "verner98",
            Method::Dop853 => "dop853",
            Method::Radau5 => "radau5",
        }
    }

    /// Returns whether the dense output is not good enough for samples. In version 0.7.0 of the
    /// library that of DOP853 is evaluated with `s` and `1 − s` interchanged in its upper half:
    /// where the ends of the steps are right to 1e-13, it is off by up to 1e-7.
    pub(super) fn ends_steps_at_samples(self) -> bool {
        self == Method::Dop853
    }
}

/// Describes what became of a step.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Tried {
    Accepted,
    Rejected,
    /// The method thinks another one would do better and did not take the step.
    Stiff,
    /// The step became too small or a linear system singular.
    Failed(String),
}

/// One method at work.
pub(super) trait Stepper {
    /// Tries a step of `h`.
    fn step(&mut self, ode: &dyn ODE<f64, State>, h: f64) -> Tried;
    /// The step it would take next.
    fn proposed(&self) -> f64;
    fn t(&self) -> f64;
    fn y(&self) -> &State;
    fn t_before(&self) -> f64;
    /// The state between the ends of the last step.
    fn between(&mut self, t: f64) -> State;
}

/// The method, ready at `(t, y)`; `h` is the first step. The tolerances of the components are
/// relative and absolute ones.
pub(super) fn begin(
    method: Method,
    tolerances: &State,
    ode: &dyn ODE<f64, State>,
    (t, y): (f64, &State),
    (end, h): (f64, f64),
) -> Result<Box<dyn Stepper>, String> {
    // The budget of steps is kept by the caller.
    const STEPS: usize = usize::MAX;
    let (rtol, atol) = (tolerances.to_vec(), tolerances.to_vec());
    macro_rules! ready {
        ($method:expr) => {{
            let mut m = $method.rtol(rtol).atol(atol).h0(h).max_steps(STEPS);
            m.init(ode, t, end, y).map_err(|e| e.to_string_plain())?;
            Ok(Box::new(m))
        }};
    }
    match method {
        Method::Dop853 => ready!(ExplicitRungeKutta::dop853()),
        Method::Verner98 => ready!(ExplicitRungeKutta::rkv989e()),
        // A Newton tolerance of zero asks for the method's own rule. Its scale makes a state of a
        // size of its own dimension necessary: tolerances are given for each component.
        Method::Radau5 => ready!(ImplicitRungeKutta::radau5().newton_tol(0.0)),
    }
}

/// The library prints states with `Display`, which arrays do not have.
trait Plain {
    fn to_string_plain(&self) -> String;
}

impl Plain for LibraryError<f64, State> {
    fn to_string_plain(&self) -> String {
        match self {
            LibraryError::BadInput { msg } => msg.clone(),
            LibraryError::StepSize { t, .. } => format!("the step became too small at t = {t} s"),
            LibraryError::LinearAlgebra { t, msg, .. } => format!("{msg} (t = {t} s)"),
            other => format!("{other:?}"),
        }
    }
}

impl<M> Stepper for M
where
    M: OrdinaryNumericalMethod<f64, State> + Interpolation<f64, State>,
{
    fn step(&mut self, ode: &dyn ODE<f64, State>, h: f64) -> Tried {
        self.set_h(h);
        match OrdinaryNumericalMethod::step(self, ode) {
            Ok(_) if *self.status() == Status::RejectedStep => Tried::Rejected,
            Ok(_) => Tried::Accepted,
            Err(LibraryError::Stiffness { .. }) => Tried::Stiff,
            Err(e) => Tried::Failed(e.to_string_plain()),
        }
    }

    fn proposed(&self) -> f64 {
        self.h()
    }

    fn t(&self) -> f64 {
        OrdinaryNumericalMethod::t(self)
    }

    fn y(&self) -> &State {
        OrdinaryNumericalMethod::y(self)
    }

    fn t_before(&self) -> f64 {
        self.t_prev()
    }

    fn between(&mut self, t: f64) -> State {
        let (a, b) = (self.t_prev(), OrdinaryNumericalMethod::t(self));
        let y = *OrdinaryNumericalMethod::y(self);
        self.interpolate(t.clamp(a, b)).unwrap_or(y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_librarys_errors_in_plain_words() {
        let y = [0.0; 6];
        let text = |e: LibraryError<f64, State>| e.to_string_plain();
        assert_eq!(text(LibraryError::BadInput { msg: "a".into() }), "a");
        let small = text(LibraryError::StepSize { t: 2.5, y });
        assert_eq!(small, "the step became too small at t = 2.5 s");
        let msg = "singular".into();
        let singular = text(LibraryError::LinearAlgebra { t: 2.5, y, msg });
        assert_eq!(singular, "singular (t = 2.5 s)");
        assert!(text(LibraryError::MaxSteps { t: 2.5, y }).contains("2.5"));
    }
}
