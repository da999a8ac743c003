//! (1) to (7): the equation of motion, the motor, reduction to the crank.

use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::{Formula, Statement, Step};

const ENERGY: &str = "T = omega_1^2/2*(I_1 + m_2*(v_S2/omega_1)^2 + I_2*(omega_2/omega_1)^2 \
    + I_3*(omega_3/omega_1)^2 + m_4*(v_S4/omega_1)^2 + I_4*(omega_4/omega_1)^2 \
    + I_5*(omega_5/omega_1)^2)";

const INERTIA: &str = "I_n = 1/omega_1^2*(m_2*v_S2^2 + I_2*omega_2^2 + I_3*omega_3^2 \
    + I_4*omega_4^2 + m_4*v_S4^2 + I_5*omega_5^2)";

const KLOSS: &str = "M_d = 2*M_kr/(S_kr/S + S/S_kr)";

/// v and ω as functions of φ; ψ_j and ω_j are the same.
const SLOPES: [&str; 9] = [
    "phi: v_S2 = dv_S2",
    "phi: v_S4 = dv_S4",
    "phi: omega_2 = domega_2",
    "phi: omega_3 = domega_3",
    "phi: omega_4 = domega_4",
    "phi: omega_5 = domega_5",
    "psi_3 = omega_3",
    "psi_4 = omega_4",
    "psi_5 = omega_5",
];

/// The motion of the links: angles, their rates, the centre of mass of link 2.
const MOTION: [&str; 13] = [
    "t: phi_1 = psi_1",
    "t: phi_2 = psi_2",
    "t: psi_2 = eps_2",
    "t: psi_3 = eps_3",
    "t: psi_4 = eps_4",
    "t: psi_5 = eps_5",
    "x_S2 = l_1*cos(phi_1) + s_2*cos(phi_2)",
    "y_S2 = l_1*sin(phi_1) + s_2*sin(phi_2)",
    "u = D(x_S2, t)",
    "w = D(y_S2, t)",
    "a_x = -l_1*psi_1^2*cos(phi_1) - s_2*psi_2^2*cos(phi_2) - s_2*eps_2*sin(phi_2)",
    "a_y = -l_1*psi_1^2*sin(phi_1) - s_2*psi_2^2*sin(phi_2) + s_2*eps_2*cos(phi_2)",
    "I_n = (m_2*(u^2 + w^2) + I_2*psi_2^2 + I_3*psi_3^2 + I_4*psi_4^2 + I_5*psi_5^2)/psi_1^2",
];

pub(super) fn items() -> Vec<Item> {
    let mut all = equation_and_motor();
    all.extend(reduction());
    all
}

fn equation_and_motor() -> Vec<Item> {
    vec![
        Item::new("z-1", "(1), first", Formula)
            .printed("psi_dot = 1/I_n*(M_d + M_o - 1/2*psi^2*dI_n)")
            .claims("The kinetic energy I_n ψ²/2 changes by the power of both moments.")
            .with(&["t: I_n = dI_n*psi", "t: psi = psi_dot"])
            .requires(&["D(I_n*psi^2/2, t) = (M_d + M_o)*psi"])
            .but_not("D(I_n*psi^2/2, t) = (M_d - M_o)*psi")
            .also("D(I_n*psi^2/2, t) = (M_d - M_o)*psi + 2*M_o*psi")
            .note("M_o is a moment with sign, negative when it resists."),
        Item::new("z-1-angle", "(1), second", Formula)
            .printed("phi_dot = psi")
            .claims("ψ is the rate of φ.")
            .definition(),
        Item::new("z-1-legend", "legend of (1)", Statement)
            .claims("M_φ is the reduced driving moment, M_φ the reduced moment of resistance.")
            .undefined()
            .note("Both are called M_φ, which (1) does not contain; M_д and M_o are meant."),
        Item::new("z-2", "(2)", Formula)
            .printed(KLOSS)
            .claims("The moment has its extremum M_k at the critical slip.")
            .requires(&["at(M_d, S, S_kr) = M_kr", "at(D(M_d, S), S, S_kr) = 0"])
            .also("M_kr - M_d = M_kr*(S - S_kr)^2/(S^2 + S_kr^2)")
            .note("The gap to M_k is a square times M_k, so that M_k is the largest moment."),
        Item::new("z-2-slip", "after (2), slip", Step)
            .printed("S = (omega_c - omega)/omega_c")
            .claims("The slip is 0 at the synchronous speed and 1 at rest.")
            .requires(&["at(S, omega, omega_c) = 0", "at(S, omega, 0) = 1"]),
        Item::new("z-2-critical-slip", "after (2), critical slip", Step)
            .printed("S_kr = S_n*(k + sqrt(k^2 - 1))")
            .claims("With it (2) gives the rated moment M_n at the rated slip S_n.")
            .with(&[KLOSS, "M_kr = k*M_n"])
            .requires(&["at(M_d, S, S_n) = M_n"])
            .also("at(at(2*k*M_n/(x/S + S/x), x, S_n*(k - sqrt(k^2 - 1))), S, S_n) = M_n")
            .also("(k + sqrt(k^2 - 1))*(k - sqrt(k^2 - 1)) = 1")
            .also("2.2 + sqrt(2.2^2 - 1) ~ 4.159591794227 within 0.0000000000005")
            .note(
                "The other root, with a minus sign, gives M_n as well; the plus sign makes S_k \
                 larger than S_n, as it has to be.",
            ),
        Item::new("z-2-overload", "after (2), overload factor", Step)
            .printed("k = M_kr/M_n")
            .claims("The overload factor.")
            .definition(),
    ]
}

fn reduction() -> Vec<Item> {
    vec![
        Item::new("z-3", "(3)", Formula)
            .printed(ENERGY)
            .claims("The kinetic energy of the links, 3 and 5 turning about fixed pivots.")
            .with(&["J_3 = I_3 - m_3*s_3^2", "v_S3 = s_3*omega_3"])
            .requires(&[
                "T = I_1*omega_1^2/2 + m_2*v_S2^2/2 + I_2*omega_2^2/2 + I_3*omega_3^2/2 \
                 + m_4*v_S4^2/2 + I_4*omega_4^2/2 + I_5*omega_5^2/2",
                "I_3*omega_3^2/2 = J_3*omega_3^2/2 + m_3*v_S3^2/2",
            ])
            .note("So I_3 and I_5 are about the pivots, the others about the centres of mass."),
        Item::new("z-reduced-mass", "after (3)", Step)
            .printed("m_n = I_n/l_1^2")
            .claims("The reduced mass at the end of the crank has the same kinetic energy.")
            .requires(&["m_n*(l_1*omega_1)^2/2 = I_n*omega_1^2/2"]),
        Item::new("z-4", "(4)", Formula)
            .printed(INERTIA)
            .claims("The I_n of (3), for the printed I_1 = 0.")
            .with(&[ENERGY])
            .requires(&["I_n*omega_1^2/2 = at(T, I_1, 0)"])
            .but_not("I_n*omega_1^2/2 = T")
            .also("T - I_n*omega_1^2/2 = I_1*omega_1^2/2")
            .note("(4) leaves out I_1. The paper's data have I_1 = 0, so nothing computed is affected."),
        Item::new("z-4-units", "(4), (7)", Statement)
            .claims("Velocities from lengths without a unit give kg·m² and N·m.")
            .undefined()
            .also("m_2*(v/100)^2 = m_2*v^2/10000")
            .note(
                "No unit of length is printed. The tables come out with centimetres, which needs \
                 10⁻⁴ in (4) and (5) and 10⁻² in (7).",
            ),
        Item::new("z-5", "(5)", Formula)
            .printed(
                "dI_n = 2*m_2*v_S2*dv_S2 + 2*I_2*omega_2*domega_2 + 2*I_3*psi_3*domega_3 \
                 + 2*m_4*v_S4*dv_S4 + 2*I_4*psi_4*domega_4 + 2*I_5*psi_5*domega_5",
            )
            .claims("The derivative of (4) by φ.")
            .with(&[INERTIA])
            .with(&SLOPES)
            .requires(&["dI_n = D(I_n, phi)"])
            .misprint(1, &["omega_2 psi_3 psi_4 psi_5"], "omega_1")
            .also("dI_n = at(D(I_n, phi), omega_1, 1)")
            .also("dI_n = 4*at(D(I_n, phi), omega_1, 2)")
            .note(
                "1/ω_1² of (4) is missing; with the paper's ω_1 = 1 that makes no difference. ψ_j \
                 and ω_j are the same.",
            ),
        Item::new("z-5-motion", "(5), along the motion", Statement)
            .claims("v dv/dt is velocity times acceleration, so that (5) is dI_n/dt over ψ_1.")
            .with(&MOTION)
            .requires(&[
                "D(I_n, t) = (2*m_2*(u*a_x + w*a_y) + 2*I_2*psi_2*eps_2 + 2*I_3*psi_3*eps_3 \
                 + 2*I_4*psi_4*eps_4 + 2*I_5*psi_5*eps_5)/psi_1^2",
                "D(u, t) = a_x",
                "D(w, t) = a_y",
            ])
            .note("Shown with link 2 for the translating terms; link 4 has the same form."),
        Item::new("z-6", "(6)", Formula)
            .printed(
                "M_n = series(j, P[j]*(V[j]/omega_n)*cos(alpha[j])) \
                 + series(j, M[j]*(omega[j]/omega_n))",
            )
            .claims("The power of the reduced moment is that of all forces and moments.")
            .requires(&[
                "M_n*omega_n = series(j, \
                 P[j]*cos(beta[j])*V[j]*cos(beta[j] + alpha[j]) \
                 + P[j]*sin(beta[j])*V[j]*sin(beta[j] + alpha[j]) + M[j]*omega[j])",
            ])
            .note("Shown for every body; β_j is the direction of the force."),
        Item::new("z-7", "(7)", Formula)
            .printed(
                "M_o = -m_2*g*V_S2*sin(theta_2) - m_3*g*V_S3*sin(theta_3) \
                 - m_4*g*V_S4*sin(theta_4) - m_5*g*V_S5*sin(theta_5)",
            )
            .claims("(6) with the weights, which point down, at the crank's speed ω_1.")
            .with(&["down = -pi/2"])
            .requires(&[
                "M_o = (m_2*g*V_S2*cos(theta_2 - down) + m_3*g*V_S3*cos(theta_3 - down) \
                 + m_4*g*V_S4*cos(theta_4 - down) + m_5*g*V_S5*cos(theta_5 - down))/omega_1",
            ])
            .misprint(1, &["theta_2 theta_3 theta_4 theta_5"], "omega_1")
            .note("1/ω_1 is missing; with the paper's ω_1 = 1 that makes no difference."),
    ]
}
