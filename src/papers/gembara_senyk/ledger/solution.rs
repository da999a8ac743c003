//! (8) to (15): the complex solution and the substitution that leads to the probability integral.

use super::{AT_THE_END, HARMONIC};
use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::{Formula, Step};

/// The equations that the solution of the n-th harmonic has to satisfy.
const MOTION: [&str; 3] = [
    "D(D(psi, t), t) + 2*n_star*D(psi, t) + omega_star^2*psi \
       = omega_star^2*series(n, D_n*exp(-i*Theta_n))",
    "at(psi, t, 0) = 0",
    "at(D(psi, t), t, 0) = 0",
];

pub(super) fn items() -> Vec<Item> {
    let mut all = equations();
    all.extend(substitution());
    all.extend(list());
    all
}

fn equations() -> Vec<Item> {
    vec![
        Item::new("gs-8", "(8)", Formula)
            .printed("phi = re(psi)")
            .claims("The real part of (9) is (7): real coefficients, and Re e^(-iΘ) = cos Θ.")
            .with(&["psi = x + i*y", "Theta_n = n*eps*t^2/2 + delta_n"])
            .requires(&[
                "phi = x",
                "re(omega_star^2*psi) = omega_star^2*phi",
                "re(D_n*exp(-i*Theta_n)) = D_n*cos(n*eps*t^2/2 + delta_n)",
            ]),
        Item::new("gs-9", "(9)", Formula)
            .printed(
                "psi_ddot + 2*n_star*psi_dot + omega_star^2*psi \
                 = omega_star^2*series(n, D[n]*exp(-i*Theta_n))",
            )
            .claims("The complex form of (7).")
            .with(&["Theta_n = n*eps*t^2/2 + delta_n"])
            .requires(&[
                "left = psi_ddot + 2*n_star*psi_dot + omega_star^2*psi",
                "re(right) = omega_star^2*series(n, D_n*cos(n*eps*t^2/2 + delta_n))",
            ]),
        Item::new("gs-theta", "after (9)", Step)
            .printed("Theta_n = n*eps*t^2/2 + delta_n")
            .claims("The argument of the cosine in (7).")
            .requires(&[
                "cos(Theta_n) = cos(n*eps*t^2/2 + delta_n)",
                "D(Theta_n, t) = n*eps*t",
            ]),
        Item::new("gs-i", "after (9)", Step)
            .printed("j = sqrt(-1)")
            .claims("The imaginary unit.")
            .requires(&["j = i", "j^2 = -1"])
            .note("Printed i; called j here, the name of i being taken."),
        Item::new("gs-10", "(10)", Formula)
            .printed(
                "psi = omega_star^2/omega_3*series(n, D[n]*int(tau, 0, t, \
                 exp(-i*at(Theta_n, t, tau) - n_star*(t - tau))*sin(omega_3*(t - tau))))",
            )
            .claims("Solves (9) with zero initial conditions.")
            .with(&HARMONIC)
            .requires(&MOTION),
        Item::new("gs-omega-3", "after (10)", Step)
            .printed("omega_3 = sqrt(omega_star^2 - n_star^2)")
            .claims(
                "The frequency of damped oscillations: -n_* ± iω₃ are the characteristic roots.",
            )
            .with(&["root = -n_star + i*omega_3"])
            .requires(&["root^2 + 2*n_star*root + omega_star^2 = 0"]),
        Item::new("gs-11", "(11)", Formula)
            .printed("W(z) = exp(-z^2)*(1 + 2*i/sqrt(pi)*int(z, 0, z, exp(z^2)))")
            .claims("The probability integral: W' = -2zW + 2i/√π, W(0) = 1.")
            .requires(&[
                "D(right, z) = -2*z*right + 2*i/sqrt(pi)",
                "at(right, z, 0) = 1",
            ]),
        Item::new("gs-euler", "after (11)", Step)
            .printed(
                "sin(omega_3*(t - tau)) \
                 = (exp(i*omega_3*(t - tau)) - exp(-i*omega_3*(t - tau)))/(2*i)",
            )
            .claims("Euler's formula.")
            .requires(&["left = right", "right = at(sin(x), x, omega_3*(t - tau))"]),
        Item::new("gs-split-first", "after (11), first integral", Step)
            .printed(
                "psi_1 = omega_star^2/(2*i*omega_3)*series(n, \
                 D[n]*exp((i*omega_3 - n_star)*t - i*delta_n)\
                 *int(tau, 0, t, exp(-i*n*eps*tau^2/2 - (i*omega_3 + n_star)*tau)))",
            )
            .claims("The part of (10) with e^(iω₃(t-τ)).")
            .with(&HARMONIC)
            .requires(&[
                "psi_1 = series(n, omega_star^2/omega_3*D_n*int(tau, 0, t, \
                   exp(-i*at(Theta_n, t, tau) - n_star*(t - tau))*exp(i*omega_3*(t - tau))/(2*i)))",
            ])
            .misprint(1, &["omega_3 n_star omega_star"], ""),
        Item::new("gs-split-second", "after (11), second integral", Step)
            .printed(
                "psi_2 = -omega_star^2/(2*i*omega_3)*series(n, \
                 D[n]*exp(-(i*omega_3 + n_star)*t - i*delta_n)\
                 *int(tau, 0, t, exp(-i*n*eps*tau^2/2 - (i*omega_3 - n_3)*tau)))",
            )
            .claims("The part of (10) with e^(-iω₃(t-τ)).")
            .with(&HARMONIC)
            .requires(&[
                "psi_2 = series(n, -omega_star^2/omega_3*D_n*int(tau, 0, t, \
                   exp(-i*at(Theta_n, t, tau) - n_star*(t - tau))*exp(-i*omega_3*(t - tau))/(2*i)))",
            ])
            .misprint(2, &["n_3 n_star", "omega_3 omega_star"], "")
            .note(
                "n_3 is not defined in the paper; it can only be n_*. The text calls this the \
                 solution of (10); it is the solution of (9).",
            ),
        Item::new("gs-split", "after (11), sum", Step)
            .composed("psi = first + second")
            .claims("Both integrals, corrected, are (10).")
            .with(&HARMONIC)
            .requires(&["psi = psi_10"]),
    ]
}

fn substitution() -> Vec<Item> {
    let confused = ["omega_3 n_star omega_star"];
    vec![
        Item::new("gs-12-v", "(12), V_n", Formula)
            .printed("V_n = (i - 1)/(2*sqrt(n*eps))*(n*eps*tau + omega_3 + i*n_star)")
            .claims("Completes the square of the first exponent; τ is linear in V_n.")
            .requires(&[
                "-i*n*eps*tau^2/2 - (i*omega_3 - n_star)*tau = V_n^2 - at(V_n, tau, 0)^2",
                "D(V_n, tau)*(-(1 + i)/sqrt(n*eps)) = 1",
            ]),
        Item::new("gs-12-u", "(12), U_n", Formula)
            .printed("U_n = (1 - i)/(2*sqrt(n*eps))*(n*eps*tau - omega_3 - i*n_star)")
            .claims("Completes the square of the second exponent; at τ = 0 it is the printed U_n0.")
            .requires(&[
                "-i*n*eps*tau^2/2 + (i*omega_3 + n_star)*tau = U_n^2 - at(U_n, tau, 0)^2",
                "D(U_n, tau)*(1 + i)/sqrt(n*eps) = 1",
                "at(U_n, tau, 0) = (1 - i)/(2*sqrt(n*eps))*(i*n_star - omega_3)",
            ])
            .misprint(1, &confused, "n eps"),
        Item::new("gs-13", "(13)", Formula)
            .printed(
                "psi = (i - 1)*omega_star^2/(2*omega_3)*series(n, D[n]/sqrt(n*eps)\
                 *(exp(-nabla_n^2)*int(V, V_n0, V_n, exp(V^2)) \
                 + exp(-U_n^2)*int(U, U_n0, U_n, exp(U^2)))*exp(-Theta_n))",
            )
            .claims("The solution (10) after the substitution.")
            .with(&HARMONIC)
            .with(&AT_THE_END)
            .requires(&["psi = series(n, psi_10)"])
            .misprint(2, &["nabla_n V_n U_n", "V_n0 U_n0"], "")
            .note("∇_n, not defined in the paper, is V_n; the last exponent has lost its i."),
        Item::new("gs-14-v", "(14), first term", Formula)
            .printed("B_1 = exp(-V_n^5)*int(V, V_n0, V_n, exp(V^2))")
            .claims("With the factor before the bracket and e^(-iΘ): the first integral.")
            .with(&HARMONIC)
            .with(&AT_THE_END)
            .requires(&["(i - 1)*omega_star^2/(2*omega_3)*D_n/s*B_1*exp(-i*Theta_n) = first"])
            .misprint(1, &["V_n U_n", "V_n0 U_n0"], ""),
        Item::new("gs-14-u", "(14), second term", Formula)
            .printed("B_2 = exp(-U_n^2)*int(U, U_n0, U_n, exp(-U^5))")
            .claims("With the factor before the bracket and e^(-iΘ): the second integral.")
            .with(&HARMONIC)
            .with(&AT_THE_END)
            .requires(&["(i - 1)*omega_star^2/(2*omega_3)*D_n/s*B_2*exp(-i*Theta_n) = second"])
            .misprint(2, &["V_n U_n", "V_n0 U_n0"], ""),
        Item::new("gs-14", "(14), with its terms corrected", Formula)
            .composed(
                "A_n = (i - 1)*omega_star^2/(2*omega_3)*(D_n/sqrt(n*eps))\
                 *(exp(-V_n^2)*int(V, V_n0, V_n, exp(V^2)) \
                 + exp(-U_n^2)*int(U, U_n0, U_n, exp(U^2)))",
            )
            .claims("The complex amplitude: A_n e^(-iΘ_n) is the n-th term of (10).")
            .with(&HARMONIC)
            .with(&AT_THE_END)
            .requires(&["A_n*exp(-i*Theta_n) = psi_10"]),
        Item::new("gs-15", "(15)", Formula)
            .printed("psi = series(n, A_n*exp(-i*Theta_n))")
            .claims("The solution by complex amplitudes.")
            .with(&HARMONIC)
            .with(&AT_THE_END)
            .with(&[
                "A_n = (1 + i)*omega_star^2*D_n*sqrt(pi)/(4*omega_3*s)*(W(U_n) + W(V_n) \
                       - W(U_n0)*exp(U_n0^2 - U_n^2) - W(V_n0)*exp(V_n0^2 - V_n^2))",
            ])
            .requires(&MOTION),
    ]
}

/// The list after (13).
fn list() -> Vec<Item> {
    let end = || [HARMONIC.as_slice(), AT_THE_END.as_slice()].concat();
    vec![
        Item::new("gs-u0", "after (13)", Step)
            .printed("U_n0 = (1 - i)/(2*sqrt(n*eps))*(i*n_star - omega_3)")
            .claims("U_n at τ = 0.")
            .with(&HARMONIC)
            .requires(&["U_n0 = at(U_n, tau, 0)"])
            .note("It belongs to the corrected U_n, not to the printed one."),
        Item::new("gs-v0", "after (13)", Step)
            .printed("V_n0 = (i - 1)/(2*sqrt(n*eps))*(i*n_star + omega_3)")
            .claims("V_n at τ = 0.")
            .with(&HARMONIC)
            .requires(&["V_n0 = at(V_n, tau, 0)"]),
        Item::new("gs-list-1", "list after (13), line 1", Step)
            .printed("-(i*omega_3 - n_star*t) - i*delta_n = -i*Theta_n - V_n^2 + V_n0^2")
            .claims("The exponent before the first integral at τ = t.")
            .with(&end())
            .requires(&["left = right", "left = (i*omega_3 - n_star)*t - i*delta_n"])
            .misprint(2, &[], "t")
            .note(
                "The minus sign is probably the dash of a list, and the bracket closes one factor \
                 too late.",
            ),
        Item::new("gs-list-2", "list after (13), line 2", Step)
            .printed("-i*(n*eps*tau^2/2) - (i*omega_3 - n_star)*tau = V_n^2 - V_n0^2")
            .claims("The exponent under the first integral.")
            .with(&HARMONIC)
            .requires(&["left = right"]),
        Item::new("gs-list-2-differential", "list after (13), line 2", Step)
            .printed("dtau = -(1 + i)/sqrt(n*eps)*dV")
            .claims("The differential of the first substitution.")
            .with(&HARMONIC)
            .with(&["dV = D(V_n, tau)"])
            .requires(&["dtau = 1"]),
        Item::new("gs-list-3", "list after (13), line 3", Step)
            .printed("-(i*omega_3 + n_star)*t - i*delta_n = -i*Theta_n - U_n^2 + U_n0^2")
            .claims("The exponent before the second integral at τ = t.")
            .with(&end())
            .requires(&["left = right"]),
        Item::new("gs-list-4", "list after (13), line 4", Step)
            .printed("-i*(n*eps*tau^2/2) + (i*omega_3 + n_star)*tau = U_n^2 - U_n0^2")
            .claims("The exponent under the second integral.")
            .with(&HARMONIC)
            .requires(&["left = right"]),
        Item::new("gs-list-4-differential", "list after (13), line 4", Step)
            .printed("dtau = (1 + i)/sqrt(n*eps)*dU")
            .claims("The differential of the second substitution.")
            .with(&HARMONIC)
            .with(&["dU = D(U_n, tau)"])
            .requires(&["dtau = 1"]),
    ]
}
