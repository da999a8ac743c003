//! Exact algebra, just large enough to prove the formulas of a paper.
//!
//! A formula is data: an [`Expr`], read from text by [`parse()`]. It is evaluated in two ways that
//! share nothing but the data: to a normal form ([`Exact`]) and to an enclosure at a rational point
//! ([`enclose`]).
//!
//! | layer | values | normal form |
//! |---|---|---|
//! | [`Gauss`] | `a + b i`, a and b rational | the pair |
//! | [`Poly`] | polynomials over them | non-zero terms by monomial |
//! | [`Fraction`] | rational functions | lowest terms, monic denominator |
//! | [`Algebra`] | square roots `s² = P` adjoined | roots to the first power, none in a denominator |
//! | [`ExpSum`] | `Σ c_j e^{p_j}` | distinct exponents, non-zero coefficients |
//! | [`Algebra::antiderivative`] | `G(z) = ∫_0^z e^{s²} ds` | odd in z, one symbol for each argument |
//! | kernels | exponentials of exponentials, inverses of sums, arc tangents | one symbol for each argument |
//!
//! Sines and cosines are exponentials, so that trigonometric polynomials and finite Fourier sums
//! need nothing else. Integrals of `c e^p` with p of degree two at most are done in closed form
//! with G; the probability integral W is made of G. Derivations act by the chain rule.
//!
//! # Conventions
//! * Free symbols stand for positive real numbers, `pi` and `i` for the constants.
//! * An equation is *proved* if the normal form of left minus right is zero: the sides are equal
//!   for all values of the symbols at which both are defined. It is *refuted* if an enclosure of
//!   left minus right excludes zero at a rational point. Otherwise it is *undecided*.
//! * A square root is the principal one, an argument lies in (−π, π]. Where a branch depends on the
//!   values of the symbols, nothing is simplified.
//! * Nothing is divided by a value that is not shown to differ from zero: a root is adjoined only
//!   if its radicand is no square in the field so far, which is decided; where kernels are
//!   involved, an enclosure has to exclude zero.
//! * `sum(n, a, inf, f)` and integrals with a limit `inf` are the limits, proved in closed form.
//!   `series(n, f)` is a formal sum over an integer index, compared term by term.
//! * The work of a decision is limited; past the limit it is undecided.
//!
//! # Other crates
//! Looked at in November 2026. `symbolica` does all of this, but is free of charge for some uses
//! only. `feanor-math` (MIT) has polynomial rings with generic coefficients, but neither fraction
//! fields in several variables nor exponentials, which are the larger part here. `algebraics`
//! (LGPL) has numbers, not functions. What remains is small enough to be written for the purpose,
//! on the numbers of `rug`.
//!
//! # An identity
//! ```
//! use mechaudit_symbolic::{Definitions, Identity, Outcome, parse_equation};
//!
//! let double = parse_equation("sin(2*x) = 2*sin(x)*cos(x)")?;
//! let none = Definitions::default();
//! assert_eq!(Identity::of(&none, &double).outcome, Outcome::Proved);
//!
//! let wrong = Identity::of(&none, &parse_equation("sin(2*x) = sin(x)*cos(x)")?);
//! assert_eq!(wrong.outcome, Outcome::Refuted);
//! assert_eq!(wrong.residual.unwrap(), "1/4*i*exp(-2*i*x) -1/4*i*exp(2*i*x)");
//! assert!(wrong.witness.is_some());
//! # Ok::<(), mechaudit_symbolic::SymbolicError>(())
//! ```
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod algebra;
mod argument;
mod complex;
mod coprime;
mod dimension;
mod edit;
mod enclosure;
mod error;
pub mod evaluation;
mod exact;
mod expr;
mod expsum;
pub mod fpcore;
mod fraction;
mod function;
mod gauss;
mod gcd;
pub mod graph;
mod identity;
mod integral;
mod kernel;
mod latex;
#[cfg(test)]
mod normal_form_tests;
mod parse;
#[cfg(test)]
mod pinned_tests;
mod poly;
pub mod requirement;
mod root;
mod series;
mod square;
mod sums;
mod symbol;
#[cfg(test)]
mod tests;
mod turn;
mod unit;
mod walk;
mod work;

pub use algebra::{Algebra, Derivation};
pub use dimension::{Dimensions, Powers, Undimensional};
pub use edit::{Edit, Family, edits};
pub use enclosure::{BITS, Enclosures, Point, enclose, enclose_form, has_derivative, is_real};
pub use error::{Place, SymbolicError};
pub use exact::Exact;
pub use expr::{Bound, Constant, Equation, Expr, Loop, Relation, Roots};
pub use expsum::ExpSum;
pub use fraction::Fraction;
pub use function::Func;
pub use gauss::Gauss;
pub use gcd::gcd;
pub use identity::{Identity, Outcome, Witness};
pub use latex::{latex, latex_equation};
pub use parse::{parse, parse_declared, parse_declared_equation, parse_equation};
pub use poly::{Monomial, Poly};
pub use symbol::Symbol;
pub use unit::{KNOWN_UNITS, Unit, UnitError, unit};
pub use walk::{Definitions, Domain, Scope, number, walk};
