//! The ledger of the paper: (1) to (19), the steps between them, and the numbers in the text.
//!
//! Symbols: `omega_star` ω_*, `n_star` n_*, `omega_3` ω₃, `n` the number of the harmonic, `V_n` and
//! `U_n` functions of `tau`. Series are compared term by term. The printed forms are those of the
//! text layer of a scan.

mod amplitude;
mod model;
mod numbers;
mod solution;

use crate::papers::ledger::Item;

/// One harmonic of the forced motion, with the corrected forms of (12) and of the steps before it.
const HARMONIC: [&str; 11] = [
    "omega_star = sqrt(n_star^2 + omega_3^2)",
    "s = sqrt(n*eps)",
    "Theta_n = n*eps*t^2/2 + delta_n",
    "Theta = Theta_n",
    "V_n = (i - 1)/(2*s)*(n*eps*tau + omega_3 + i*n_star)",
    "U_n = (1 - i)/(2*s)*(n*eps*tau - omega_3 + i*n_star)",
    "V_n0 = at(V_n, tau, 0)",
    "U_n0 = at(U_n, tau, 0)",
    "psi_10 = omega_star^2/omega_3*D_n*int(tau, 0, t, \
       exp(-i*at(Theta_n, t, tau) - n_star*(t - tau))*sin(omega_3*(t - tau)))",
    "first = omega_star^2/(2*i*omega_3)*D_n*exp((i*omega_3 - n_star)*t - i*delta_n)\
       *int(tau, 0, t, exp(-i*n*eps*tau^2/2 - (i*omega_3 - n_star)*tau))",
    "second = -omega_star^2/(2*i*omega_3)*D_n*exp(-(i*omega_3 + n_star)*t - i*delta_n)\
       *int(tau, 0, t, exp(-i*n*eps*tau^2/2 + (i*omega_3 + n_star)*tau))",
];

/// Puts τ = t into V_n and U_n.
const AT_THE_END: [&str; 1] = ["tau = t"];

/// All entries in the order of the paper.
pub fn items() -> Vec<Item> {
    let mut all = model::items();
    all.extend(solution::items());
    all.extend(amplitude::items());
    all.extend(numbers::items());
    all
}
