//! The velocity and acceleration systems: time derivatives of the loop equations.

use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::{Formula, Statement};

/// The loops O1-A-B-C-O3 and O3-C-D-O5, closed when all four vanish, and the motion of the angles
/// with a crank at constant speed.
const LOOPS: [&str; 13] = [
    "X_1 = l_1*cos(phi_1) + l_2*cos(phi_2) - x_3 - l_3*cos(phi_3) - l_B*cos(phi_4 + phi_B)",
    "Y_1 = l_1*sin(phi_1) + l_2*sin(phi_2) - y_3 - l_3*sin(phi_3) - l_B*sin(phi_4 + phi_B)",
    "X_2 = x_3 + l_3*cos(phi_3) + l_4*cos(phi_4) - x_5 - l_5*cos(phi_5)",
    "Y_2 = y_3 + l_3*sin(phi_3) + l_4*sin(phi_4) - y_5 - l_5*sin(phi_5)",
    "t: phi_1 = psi_1",
    "t: phi_2 = psi_2",
    "t: phi_3 = psi_3",
    "t: phi_4 = psi_4",
    "t: phi_5 = psi_5",
    "t: psi_2 = eps_2",
    "t: psi_3 = eps_3",
    "t: psi_4 = eps_4",
    "t: psi_5 = eps_5",
];

/// The left side of each velocity equation less its right side; the right side has the crank.
const VELOCITIES: [&str; 4] = [
    "v_1 = -l_2*psi_2*sin(phi_2) + l_3*psi_3*sin(phi_3) + l_B*psi_4*sin(phi_4 + phi_B) \
     - l_1*psi_1*sin(phi_1)",
    "v_2 = l_2*psi_2*cos(phi_2) - l_3*psi_3*cos(phi_3) - l_B*psi_4*cos(phi_4 + phi_B) \
     + l_1*psi_1*cos(phi_1)",
    "v_3 = -l_3*psi_3*sin(phi_3) - l_4*psi_4*sin(phi_4) + l_5*psi_5*sin(phi_5)",
    "v_4 = l_3*psi_3*cos(phi_3) + l_4*psi_4*cos(phi_4) - l_5*psi_5*cos(phi_5)",
];

pub(super) fn items() -> Vec<Item> {
    let of = |id, place, printed, required: &'static str| {
        Item::new(id, place, Formula)
            .printed(printed)
            .with(&LOOPS)
            .requires(&[required])
    };
    let velocity = "The first time derivative of a loop equation.";
    let acceleration =
        "The second time derivative of a loop equation, the crank at constant speed.";
    vec![
        of(
            "z-velocity-1",
            "velocity system, 1",
            "-l_2*psi_2*sin(phi_2) + l_3*psi_3*sin(phi_3) + l_B*psi_4*sin(phi_4 + phi_B) \
             = l_1*psi_1*sin(phi_1)",
            "left - right = D(X_1, t)",
        )
        .claims(velocity),
        of(
            "z-velocity-2",
            "velocity system, 2",
            "l_2*psi_2*cos(phi_2) - l_3*psi_3*cos(phi_3) - l_B*psi_4*cos(phi_4 + phi_B) \
             = -l_1*psi_1*cos(phi_1)",
            "left - right = D(Y_1, t)",
        )
        .claims(velocity),
        of(
            "z-velocity-3",
            "velocity system, 3",
            "-l_3*psi_3*sin(phi_3) - l_4*psi_4*sin(phi_4) + l_5*psi_5*sin(phi_5) = 0",
            "left - right = D(X_2, t)",
        )
        .claims(velocity),
        of(
            "z-velocity-4",
            "velocity system, 4",
            "l_3*psi_3*cos(phi_3) + l_4*psi_4*cos(phi_4) - l_5*psi_5*cos(phi_5) = 0",
            "left - right = D(Y_2, t)",
        )
        .claims(velocity),
        of(
            "z-acceleration-1",
            "acceleration system, 1",
            "-l_1*psi_1^2*cos(phi_1) - l_2*psi_2^2*cos(phi_2) - l_2*eps_2*sin(phi_2) \
             = -l_3*psi_3^2*cos(phi_3) - l_3*eps_3*sin(phi_3) \
             - l_B*psi_4^2*cos(phi_4 + phi_B) - l_B*eps_4*sin(phi_4 + phi_B)",
            "left - right = D(D(X_1, t), t)",
        )
        .with(&VELOCITIES)
        .claims(acceleration)
        .also("D(left - right, eps_2) = D(v_1, psi_2)")
        .also("D(left - right, eps_3) = D(v_1, psi_3)")
        .also("D(left - right, eps_4) = D(v_1, psi_4)"),
        of(
            "z-acceleration-2",
            "acceleration system, 2",
            "-l_1*psi_1^2*sin(phi_1) - l_2*psi_2^2*sin(phi_2) + l_2*eps_2*cos(phi_2) \
             = -l_3*psi_3^2*sin(phi_3) + l_3*eps_3*cos(phi_3) \
             - l_B*psi_4^2*sin(phi_4 + phi_B) + l_B*eps_4*cos(phi_4 + phi_B)",
            "left - right = D(D(Y_1, t), t)",
        )
        .with(&VELOCITIES)
        .claims(acceleration)
        .also("D(left - right, eps_2) = D(v_2, psi_2)")
        .also("D(left - right, eps_3) = D(v_2, psi_3)")
        .also("D(left - right, eps_4) = D(v_2, psi_4)"),
        of(
            "z-acceleration-3",
            "acceleration system, 3",
            "-l_5*psi_5^2*cos(phi_5) - l_5*eps_5*sin(phi_5) \
             = -l_3*psi_3^2*cos(phi_3) - l_3*eps_3*sin(phi_3) \
             - l_4*psi_4^2*cos(phi_4) - l_4*eps_4*sin(phi_4)",
            "left - right = -D(D(X_2, t), t)",
        )
        .with(&VELOCITIES)
        .claims(acceleration)
        .also("D(left - right, eps_3) = -D(v_3, psi_3)")
        .also("D(left - right, eps_4) = -D(v_3, psi_4)")
        .also("D(left - right, eps_5) = -D(v_3, psi_5)"),
        of(
            "z-acceleration-4",
            "acceleration system, 4",
            "-l_5*psi_5^2*sin(phi_5) + l_5*eps_5*cos(phi_5) \
             = -l_3*psi_3^2*sin(phi_3) + l_3*eps_3*cos(phi_3) \
             - l_4*psi_4^2*sin(phi_4) + l_4*eps_4*cos(phi_4)",
            "left - right = -D(D(Y_2, t), t)",
        )
        .with(&VELOCITIES)
        .claims(acceleration)
        .also("D(left - right, eps_3) = -D(v_4, psi_3)")
        .also("D(left - right, eps_4) = -D(v_4, psi_4)")
        .also("D(left - right, eps_5) = -D(v_4, psi_5)"),
        Item::new("z-acceleration-crank", "acceleration system", Statement)
            .claims("The system is that of a crank at constant speed.")
            .with(&LOOPS)
            .with(&["t: psi_1 = eps_1"])
            .model()
            .also("D(D(X_1, t), t) = at(D(D(X_1, t), t), eps_1, 0) + eps_1*D(D(X_1, t), psi_1)")
            .also("D(D(Y_1, t), t) = at(D(D(Y_1, t), t), eps_1, 0) + eps_1*D(D(Y_1, t), psi_1)")
            .also("D(D(X_1, t), psi_1) = -l_1*sin(phi_1)")
            .also("D(D(Y_1, t), psi_1) = l_1*cos(phi_1)")
            .also("D(D(X_2, t), psi_1) = 0")
            .also("D(D(Y_2, t), psi_1) = 0")
            .note(
                "An acceleration ε_1 of the crank adds its coefficient in the velocity system to \
                 the first two equations and nothing to the others. dI_n/dφ does not need it.",
            ),
    ]
}
