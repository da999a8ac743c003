//! The ledger: constraints, their Jacobian, mass matrix, forces, each from the geometry and the
//! energies of the bodies.
//!
//! Symbols are those of the print; the rates of β, Θ, γ, Φ, δ, Ω, ε are `v_1` to `v_7`.

mod constraints;
mod dynamics;

use crate::papers::ledger::Item;

/// Points of the bodies as complex numbers.
const POINTS: [&str; 6] = [
    "P_2 = rr*exp(i*beta) - d*exp(i*(beta + Theta))",
    "P_3 = xb + i*yb - i*ss*exp(i*gamma)",
    "E_5 = xa + i*ya + zt*exp(i*delta)",
    "P_4 = E_5 - i*e*exp(i*(Phi + delta))",
    "E_7 = xa + i*ya - i*u*exp(i*epsilon)",
    "P_6 = E_7 + zf*exp(i*(Omega + epsilon))",
];

/// The angles, as their numbers in M, f and G count them.
const ANGLES: [&str; 7] = ["beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon"];

/// Row and column of a printed element, `G_12 = …`.
fn places(printed: &str) -> [usize; 2] {
    [2, 3].map(|at| usize::from(printed.as_bytes()[at] - b'0'))
}

/// All entries in the order of the print.
pub fn items() -> Vec<Item> {
    let mut all = dynamics::items();
    all.extend(constraints::items());
    all
}
