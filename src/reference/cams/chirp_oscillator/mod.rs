//! Certified response of a damped oscillator to one harmonic of a shaft whose speed changes
//! linearly:
//!
//! ```text
//! y″ + 2n y′ + w² y = w² cos θ(t),   θ(t) = k (Ω₀ t + ε t²/2) + δ,   y(0) = y₀,  y′(0) = v₀
//! ```
//!
//! With `λ± = −n ± √(n² − w²)`, `ν = kΩ₀`, `κ = kε` and `ω = ν + κt` the response from rest is
//! `Re A e^{−iθ}`,
//!
//! ```text
//! A = w² ∫_0^t K(s) e^{i(ωs − κs²/2)} ds,   K(s) = (e^{λ₊s} − e^{λ₋s})/(λ₊ − λ₋)         (1)
//! ```
//!
//! (Gembara & Senyk (10), with `s = t − τ`). Three ways lead to it, each with a proven radius:
//!
//! * [`enclose`] and [`response`]: the closed form by the Faddeeva function (`closed_form.rs`), of
//!   the same cost whatever the phases are;
//! * [`taylor::enclose`]: the integral (1) itself by Taylor panels with a tail bound;
//! * Gauss–Legendre quadrature of (1) with a bound on Bernstein ellipses, in the tests.

mod closed_form;
mod condition;
mod free;
mod parts;
mod problem;
pub mod taylor;

pub use closed_form::{enclose, response};
pub use condition::conditions;
pub use problem::{Problem, ProblemError, Response};

#[cfg(test)]
mod tests;
