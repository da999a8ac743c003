//! (16) to (19): amplitude and phase, the form with W, the sum of the amplitudes.

use super::{AT_THE_END, HARMONIC};
use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::{Formula, Statement, Step};

/// The amplitude by modulus and argument.
const MODULUS: [&str; 2] = ["A_n = rho*exp(i*alpha)", "Theta_n = n*eps*t^2/2 + delta_n"];

/// U_n as printed in (12).
const PRINTED_U: &str = "U_p = (1 - i)/(2*s)*(n*eps*t - omega_3 - i*n_star)";

pub(super) fn items() -> Vec<Item> {
    let end = [HARMONIC.as_slice(), AT_THE_END.as_slice()].concat();
    vec![
        Item::new("gs-16", "(16)", Formula)
            .printed("phi = series(n, abs(A_n)*cos(Theta + delta_star_n))")
            .claims("The real part of (15).")
            .with(&MODULUS)
            .with(&["delta_star_n = -alpha"])
            .requires(&["phi = series(n, re(A_n*exp(-i*Theta_n)))"])
            .misprint(1, &["Theta Theta_n"], "")
            .note("The index of Θ_n is missing."),
        Item::new("gs-17", "(17)", Formula)
            .printed("delta_star_n = -arctan(im(A_n)/re(A_n))")
            .claims("With it (16) is the real part of (15), whatever the quadrant of A_n.")
            .with(&MODULUS)
            .with(&["alpha = 2*pi/3"])
            .requires(&["rho*cos(Theta_n + delta_star_n) = re(A_n*exp(-i*Theta_n))"])
            .misprint(1, &[], "")
            .note(
                "The arc tangent loses the quadrant. Where Re A_n < 0 (here arg A_n = 2π/3) the \
                 harmonic changes its sign; the argument of A_n is meant.",
            ),
        Item::new("gs-18", "(18)", Formula)
            .printed(
                "A_n = (i + 1)*omega_star^2*D_n*sqrt(pi)/(4*omega_3*sqrt(n*eps))\
                 *(W(U_n) + W(V_n) - W(U_n0)*exp(U_n0^2 - U_n^2) - W(V_n0)*exp(V_n0^2 - V_n^2))",
            )
            .claims("The amplitude (14) by probability integrals.")
            .with(&end)
            .with(&[PRINTED_U])
            .requires(&["A_n*exp(-i*Theta_n) = psi_10"])
            .but_not(
                "(i + 1)*omega_star^2*D_n*sqrt(pi)/(4*omega_3*s)*(W(U_p) + W(V_n) \
                 - W(U_n0)*exp(U_n0^2 - U_p^2) - W(V_n0)*exp(V_n0^2 - V_n^2))*exp(-i*Theta_n) \
                 = psi_10",
            )
            .note("With the corrected U_n. With U_n as (12) prints it, (18) is false."),
        Item::new("gs-free", "after (18)", Statement)
            .claims("The last two terms of (18), times e^(-iΘ_n), are the free vibration.")
            .with(&end)
            .with(&[
                "y = (W(U_n0)*exp(U_n0^2 - U_n^2) + W(V_n0)*exp(V_n0^2 - V_n^2))*exp(-i*Theta_n)",
                "z = exp(-U_n^2 - i*Theta_n)",
            ])
            .model()
            .also("D(D(y, t), t) + 2*n_star*D(y, t) + omega_star^2*y = 0")
            .also("W(U_n) = 2*exp(-U_n^2) - W(-U_n)")
            .also("D(D(z, t), t) + 2*n_star*D(z, t) + omega_star^2*z = 0")
            .note(
                "They are a free vibration, but not all of it: after resonance W(U_n) contains \
                 2e^(-U_n²), and that term times e^(-iΘ_n) solves the equation without a right side \
                 too. It is the vibration excited by the passage.",
            ),
        Item::new("gs-xi-of-t", "before (19)", Step)
            .printed("t = omega_star/(eps*xi)")
            .claims("ξ = ω_*/Ω at the time t, Ω = εt.")
            .requires(&["omega_star/(eps*t) = xi"])
            .but_not("omega_star/(Omega_0 + eps*t) = xi")
            .note("Only for a run-up from rest; with an initial speed t = (ω_*/ξ - Ω_0)/ε."),
        Item::new("gs-19-factor", "(19), factor", Formula)
            .printed("c = omega_star^2/4*sqrt(2*pi)/(4*omega_3*sqrt(eps))")
            .claims("The modulus of the factor of (18), without D_n/√n.")
            .with(&["factor = (i + 1)*omega_star^2*D_n*sqrt(pi)/(4*omega_3*sqrt(n*eps))"])
            .requires(&["c*D_n/sqrt(n) = abs(factor)"])
            .misprint(1, &["omega_3 omega_star"], "eps n")
            .note("One of the two fours is too many; perhaps the star of ω_* read as 4."),
        Item::new("gs-19-bracket", "(19), bracket", Formula)
            .printed(
                "B = W(U_n) + W(V_n) - W(V_n0)*exp(U_n0^2 - U_n^2) - W(V_n0)*exp(V_n0^2 - V_n^2)",
            )
            .claims("The bracket of (18).")
            .with(&end)
            .requires(&[
                "(i + 1)*omega_star^2*D_n*sqrt(pi)/(4*omega_3*sqrt(n*eps))*B*exp(-i*Theta_n) \
                 = psi_10",
            ])
            .misprint(1, &["U_n V_n", "U_n0 V_n0"], ""),
        Item::new("gs-19-sum", "(16) and (19)", Statement)
            .claims("The largest deflection is the sum of the |A_n|.")
            .with(&["phi = abs(A_1)*cos(x) + abs(A_2)*cos(2*x - pi/2)"])
            .with(&["A_1 = 1", "A_2 = 1"])
            .model()
            .also(
                "4 - phi^2 = (2*sin(x)^2 + sin(x) - 7/5)^2 + 8/5*(sin(x) - 3/8)^2 + 163/200",
            )
            .also("sqrt(4 - 163/200) < 1.785")
            .also("1.785 < A_1 + A_2")
            .note(
                "The sum is an upper bound only. For two harmonics of modulus 1 with this phase \
                 4 - φ² is a sum of squares and 163/200, so the deflection stays below 1.785 where \
                 the sum is 2. And D_n of the displacement make (19) a bound of displacements, not \
                 of the accelerations that figure 5 compares.",
            ),
    ]
}
