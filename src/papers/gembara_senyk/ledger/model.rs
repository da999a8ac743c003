//! (1) to (7): the frequency criterion, the equation of motion, the Fourier series.

use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::{Formula, Statement, Step};

/// The series (4) with three harmonics.
const SERIES: [&str; 2] = [
    "Omega = 2*pi/T_B",
    "f = a_0 + sum(k, 1, 3, a[k]*cos(k*Omega*t) + b[k]*sin(k*Omega*t))",
];

/// a_n and b_n by D_n and δ_n.
const POLAR: [&str; 2] = ["a_n = D_n*cos(delta_n)", "b_n = -D_n*sin(delta_n)"];

/// The cosine law over its rise only: from 0 to 1 in T_B.
const COSINE_RISE: [&str; 2] = ["rise = (1 - cos(pi*t/T_B))/2", "Omega = 2*pi/T_B"];

pub(super) fn items() -> Vec<Item> {
    vec![
        Item::new("gs-period", "before (1)", Step)
            .printed("T_B = phi_y*30/(pi*n_phi)")
            .claims("The forced period is the time in which the shaft turns by φ_y at n_Φ rev/min.")
            .with(&["omega_cam = 2*pi*n_phi/60"])
            .requires(&["T_B = phi_y/omega_cam"]),
        Item::new("gs-1", "(1)", Formula)
            .printed("xi = phi_y*30/(pi*t_k)*(1/n_phi)")
            .claims("ξ is the ratio of the natural frequency 2π/t_k to the forcing frequency 2π/T_B.")
            .with(&["T_B = phi_y*30/(pi*n_phi)"])
            .requires(&["xi = (2*pi/t_k)/(2*pi/T_B)"]),
        Item::new("gs-rise-as-period", "before (1), after (4)", Statement)
            .claims("The forcing is periodic with T_B, the time of the rise.")
            .with(&COSINE_RISE)
            .model()
            .but_not("at(rise, t, T_B) = at(rise, t, 0)")
            .also("2/T_B*int(t, 0, T_B, rise*sin(Omega*t)) = -4/(3*pi)")
            .also("2/T_B*int(t, 0, T_B, rise*sin(2*Omega*t)) = -8/(15*pi)")
            .also("2/T_B*int(t, 0, T_B, rise*sin(3*Omega*t)) = -12/(35*pi)")
            .also("2/T_B*int(t, 0, T_B, rise*cos(2*Omega*t)) = 0")
            .note(
                "Continued with the period of the rise, the displacement jumps by the whole stroke, \
                 so the coefficients fall off like 1/n only: for the cosine law b_n is \
                 -4n/(π(4n²-1)), shown for n = 1, 2, 3. A cycle with dwells needs the whole turn of \
                 the shaft as its period; then the ξ of (19) is not the ξ of (1).",
            ),
        Item::new("gs-2a", "(2), first", Formula)
            .printed("K_a = C_phi/C")
            .claims("Dynamic factor of the acceleration.")
            .definition(),
        Item::new("gs-2b", "(2), second", Formula)
            .printed("K_N = D_phi/D_c")
            .claims("Dynamic factor of the kinetic power.")
            .definition()
            .note("D_c stands for the printed D."),
        Item::new("gs-2c", "(2), third", Formula)
            .printed("K_M = U_phi/U_c")
            .claims("Dynamic factor of the total moment.")
            .definition()
            .note("U_c stands for the printed U."),
        Item::new("gs-3", "(3)", Formula)
            .printed("phi_ddot + 2*n_star*phi_dot + omega_star^2*phi_dot = omega_star^2*f")
            .claims("At rest the driven link stands where the cam puts it; (7) has the same left side.")
            .requires(&[
                "at(at(at(left, phi_ddot, 0), phi_dot, 0), phi, f) = right",
                "left = phi_ddot + 2*n_star*phi_dot + omega_star^2*phi",
            ])
            .misprint(1, &["phi phi_dot phi_ddot", "n_star omega_star"], "")
            .note("A dot too many; (7) prints the term without it."),
        Item::new("gs-4", "(4)", Formula)
            .printed("f = a_0 + series(n, a[n]*cos(n*Omega*t) + b[n]*sin(n*Omega*t))")
            .claims("A function with the period T_B, mean a_0.")
            .with(&["Omega = 2*pi/T_B"])
            .requires(&["at(f, t, t + T_B) = f", "1/T_B*int(t, 0, T_B, f) = a_0"])
            .note("Shown for every term: n is any positive integer."),
        Item::new("gs-frequency", "after (4)", Step)
            .printed("Omega = 2*pi/T_B")
            .claims("The frequency of the forcing: cos Ωt returns after T_B.")
            .requires(&["cos(Omega*(t + T_B)) = cos(Omega*t)"]),
        Item::new("gs-5a", "(5), first", Formula)
            .printed("a[0] = 1/T_B*int(t, 0, T_B, f)")
            .claims("The mean.")
            .with(&SERIES)
            .requires(&["left = right"]),
        Item::new("gs-5b", "(5), second", Formula)
            .printed("a[n] = 2/T_B*int(t, 0, T_B, f*cos(n*Omega*t))")
            .claims("The cosine coefficients of (4).")
            .with(&SERIES)
            .requires(&[
                "sum(n, 1, 1, left) = sum(n, 1, 1, right)",
                "sum(n, 2, 2, left) = sum(n, 2, 2, right)",
                "sum(n, 3, 3, left) = sum(n, 3, 3, right)",
            ]),
        Item::new("gs-5c", "(5), third", Formula)
            .printed("b[n] = 2/T_B*int(t, 0, T_B, f*sin(n*Omega*t))")
            .claims("The sine coefficients of (4).")
            .with(&SERIES)
            .requires(&[
                "sum(n, 1, 1, left) = sum(n, 1, 1, right)",
                "sum(n, 2, 2, left) = sum(n, 2, 2, right)",
                "sum(n, 3, 3, left) = sum(n, 3, 3, right)",
            ]),
        Item::new("gs-polar-a", "after (5), first", Step)
            .printed("a = D*cos(delta)")
            .claims("With b_n = -D_n sin δ_n it gives D_n² = a_n² + b_n² and the terms of (6).")
            .with(&["b = -D*sin(delta)"])
            .requires(&[
                "a^2 + b^2 = D^2",
                "a*cos(x) + b*sin(x) = D*cos(x + delta)",
            ]),
        Item::new("gs-polar-b", "after (5), second", Step)
            .printed("b = -D*sin(delta)")
            .claims("With a_n = D_n cos δ_n it gives the terms of (6).")
            .with(&["a = D*cos(delta)"])
            .requires(&["a*cos(x) + b*sin(x) = D*cos(x + delta)"]),
        Item::new("gs-6", "(6)", Formula)
            .printed("f = a_0 + series(n, D[n]*cos(n*Omega*t + delta[n]))")
            .claims("The series (4) with D_n and δ_n.")
            .with(&POLAR)
            .requires(&[
                "f = a_0 + series(n, a[n]*cos(n*Omega*t) + b[n]*sin(n*Omega*t))",
            ]),
        Item::new("gs-7", "(7)", Formula)
            .printed(
                "phi_ddot + 2*n_star*phi_dot + omega_star^2*phi \
                 = omega_star^2*series(n, D[n]*cos(n*eps*t^2/2 + delta[n]))",
            )
            .claims("(3) with (6), a_0 left out, and the angle of the shaft at Ω = εt.")
            .requires(&[
                "left = phi_ddot + 2*n_star*phi_dot + omega_star^2*phi",
                "right = omega_star^2*series(n, D[n]*cos(n*int(tau, 0, t, eps*tau) + delta[n]))",
            ]),
        Item::new("gs-run-down", "(7)", Statement)
            .printed("theta = eps*t^2/2")
            .claims("The angle of the shaft in a run-down from the speed Ω_0 with Ω = Ω_0 + εt.")
            .with(&["Omega = Omega_0 + eps*t"])
            .model()
            .also("at(D(theta, t), t, 0) = 0")
            .but_not("theta = int(t, 0, t, Omega)")
            .note(
                "θ = εt²/2 is a run-up from rest. The experiments are run-downs, which need a speed \
                 Ω_0 > 0 to begin with and ε < 0; what is missing is Ω_0 t.",
            ),
        Item::new("gs-mean-left-out", "after (7)", Statement)
            .claims("Leaving out a_0 shifts the solution by a constant.")
            .with(&[
                "omega_star = sqrt(n_star^2 + omega_3^2)",
                "y = a_0*(1 - exp(-n_star*t)*(cos(omega_3*t) + n_star/omega_3*sin(omega_3*t)))",
                "f = a_0 + series(n, D[n]*cos(n*Omega*t + delta[n]))",
            ])
            .model()
            .also("D(D(y, t), t) + 2*n_star*D(y, t) + omega_star^2*y = omega_star^2*a_0")
            .also("at(y, t, 0) = 0")
            .also("at(D(y, t), t, 0) = 0")
            .but_not("y = a_0")
            .also("series(n, D[n]*cos(delta[n])) = at(f, t, 0) - a_0")
            .note(
                "With the zero initial conditions of (10) the response y to a_0 is a transient. \
                 Where the cam starts from rest at f(0) = 0 the remaining series starts at -a_0: a \
                 step that the mechanism does not have. Keep a_0, or start at φ(0) = -a_0.",
            ),
    ]
}
