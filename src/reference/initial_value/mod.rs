//! Initial value problems: certified solutions of `y′ = f(t, y)`.
//!
//! A right-hand side is a [`Field`]: a straight-line [`Program`] for the rates, and one for their
//! derivatives by the states. A [`Solution`] follows the motion from an exact time in both
//! directions and gives the states at any time as balls.
//!
//! # Method
//! 1. `expansion`: Taylor coefficients of all values of the program, one order at a time, in
//!    floating point.
//! 2. `remainder`: a bound on what the polynomials leave out over the step, rounding included: the
//!    defect of the solution's polynomial.
//! 3. `variation`: the linearised flow over a tube around the polynomial, in doubles with radii. It
//!    is needed to a few digits only, because it is multiplied by errors.
//! 4. `step`: a differential inequality proves that the solution exists and stays in the tube.
//! 5. `set`: errors of the start of a step are carried on in coordinates that turn with the flow
//!    (Lohner's QR).
//!
//! The order follows from the digits asked for: N² operations a step, whose length falls as
//! `e^{−bits ln 2/N}`, are cheapest a unit of time for `N = bits (ln 2)/2` (Jorba, Zou,
//! *Experimental Mathematics* 14 (2005) 99–117, §3.2).
//!
//! # Example
//! Lorenz's equations at t = 1:
//! ```
//! use mechaudit_reference::Ball;
//! use mechaudit_reference::initial_value::{Constants, Field, Operation, Program, Solution};
//! use rug::Rational;
//!
//! # fn main() -> Result<(), mechaudit_reference::initial_value::Stopped> {
//! let mut rates = Program::new();
//! let [x, y, z] = [0, 1, 2].map(|i| rates.push(Operation::State(i)));
//! let [sigma, rho, beta] = [(); 3].map(|()| rates.constant());
//! let rise = rates.push(Operation::Sub(y, x));
//! let first = rates.push(Operation::Mul(sigma, rise));
//! let gap = rates.push(Operation::Sub(rho, z));
//! let pull = rates.push(Operation::Mul(x, gap));
//! let second = rates.push(Operation::Sub(pull, y));
//! let (xy, bz) = (rates.push(Operation::Mul(x, y)), rates.push(Operation::Mul(beta, z)));
//! let third = rates.push(Operation::Sub(xy, bz));
//!
//! let mut jacobian = Program::new();
//! let [x, y, z] = [0, 1, 2].map(|i| jacobian.push(Operation::State(i)));
//! let [sigma, rho, beta, one] = [(); 4].map(|()| jacobian.constant());
//! let [minus_sigma, minus_beta, minus_one, minus_x] =
//!     [sigma, beta, one, x].map(|a| jacobian.push(Operation::Neg(a)));
//! let gap = jacobian.push(Operation::Sub(rho, z));
//! let entries = vec![
//!     (0, 0, minus_sigma), (0, 1, sigma),
//!     (1, 0, gap), (1, 1, minus_one), (1, 2, minus_x),
//!     (2, 0, y), (2, 1, x), (2, 2, minus_beta),
//! ];
//! let field = Field::new(rates, vec![first, second, third], jacobian, entries);
//!
//! let bits = 128;
//! let constants = || {
//!     let [sigma, rho, beta, one] = [(10, 1), (28, 1), (8, 3), (1, 1)]
//!         .map(|q| Ball::rational(bits, &Rational::from(q)));
//!     let rates = vec![sigma.clone(), rho.clone(), beta.clone()];
//!     Constants { rates, jacobian: vec![sigma, rho, beta, one] }
//! };
//! let start = vec![Ball::integer(bits, 1); 3];
//! let mut solution = Solution::new(Rational::from(0), &start, bits);
//! let mut steps = 1000;
//! let at = solution.at(&field, &constants(), &Rational::from(1), &mut steps)?;
//! assert_eq!(at[0].to_decimal(20).unwrap(), "-9.3785700109250623608");
//! # Ok(())
//! # }
//! ```

mod coefficient;
mod enclosed;
mod expansion;
mod program;
mod remainder;
mod set;
mod solution;
mod step;
mod variation;

pub use expansion::Obstacle;
pub use program::{Operation, Primitive, Program, Slot};
pub use solution::{Solution, Stopped};

use crate::{Ball, Mag};
use rug::Float;

/// The right-hand side of a differential equation and its derivatives by the states.
#[derive(Clone, Debug)]
pub struct Field {
    rates: Program,
    outputs: Vec<Slot>,
    jacobian: Program,
    entries: Vec<(usize, usize, Slot)>,
}

impl Field {
    /// Creates a field of the rates of all states, and of the entries of the Jacobian that are not
    /// zero: row, column and place in its program.
    pub fn new(
        rates: Program,
        outputs: Vec<Slot>,
        jacobian: Program,
        entries: Vec<(usize, usize, Slot)>,
    ) -> Field {
        Field {
            rates,
            outputs,
            jacobian,
            entries,
        }
    }

    /// The number of states.
    pub fn dimension(&self) -> usize {
        self.outputs.len()
    }
}

/// The constants of a field's programs at a working precision.
#[derive(Clone, Debug)]
pub struct Constants {
    /// Those of the rates.
    pub rates: Vec<Ball>,
    /// Those of the Jacobian.
    pub jacobian: Vec<Ball>,
}

/// Values of a program for all times and states of some balls.
///
/// # Errors
/// An operation that is not defined, or not bounded, for all of them.
pub fn values(
    program: &Program,
    constants: &[Ball],
    time: &Ball,
    states: &[Ball],
    slots: &[Slot],
    bits: u32,
) -> Result<Vec<Ball>, Obstacle> {
    let rounded: Vec<Ball> = states.iter().map(|s| s.with_prec(bits)).collect();
    let middle: Vec<Float> = rounded.iter().map(|s| s.mid().clone()).collect();
    let radii: Vec<Mag> = rounded.iter().map(Ball::rad).collect();
    let mut expansion = expansion::Expansion::new(program, bits);
    expansion.begin(constants, time, &middle)?;
    let bounds = remainder::Remainders::new(&expansion, Mag::ZERO, &radii)?;
    let value = |slot: &Slot| {
        let middle = expansion.coefficients[*slot][0].clone();
        Ball::new(middle, bounds.radius(*slot))
    };
    Ok(slots.iter().map(value).collect())
}

#[cfg(test)]
mod tests;
