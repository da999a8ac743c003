//! g and its Jacobian G.

use super::{ANGLES, POINTS, places};
use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::{Formula, Statement};

/// The printed constraints.
const CONSTRAINTS: [&str; 6] = [
    "g_1 = rr*cos(beta) - d*cos(beta + Theta) - ss*sin(gamma) - xb",
    "g_2 = rr*sin(beta) - d*sin(beta + Theta) + ss*cos(gamma) - yb",
    "g_3 = rr*cos(beta) - d*cos(beta + Theta) - e*sin(Phi + delta) - zt*cos(delta) - xa",
    "g_4 = rr*sin(beta) - d*sin(beta + Theta) + e*cos(Phi + delta) - zt*sin(delta) - ya",
    "g_5 = rr*cos(beta) - d*cos(beta + Theta) - zf*cos(Omega + epsilon) - u*sin(epsilon) - xa",
    "g_6 = rr*sin(beta) - d*sin(beta + Theta) - zf*sin(Omega + epsilon) + u*cos(epsilon) - ya",
];

pub(super) fn items() -> Vec<Item> {
    let mut all = loops();
    all.extend(jacobian());
    all.push(mirror());
    all
}

fn loops() -> Vec<Item> {
    let item = |id, printed, loop_closed: &'static [&'static str]| {
        Item::new(id, "g", Formula)
            .printed(printed)
            .claims("The bodies that meet at P meet there.")
            .with(&POINTS)
            .requires(loop_closed)
    };
    let [g1, g2, g3, g4, g5, g6] = CONSTRAINTS;
    vec![
        item("an-g1", g1, &["g_1 = re(P_2 - P_3)"]),
        item("an-g2", g2, &["i*g_2 = P_2 - P_3 - re(P_2 - P_3)"]),
        item("an-g3", g3, &["g_3 = re(P_2 - P_4)"]),
        item("an-g4", g4, &["i*g_4 = P_2 - P_4 - re(P_2 - P_4)"]),
        item("an-g5", g5, &["g_5 = re(P_2 - P_6)"]),
        item("an-g6", g6, &["i*g_6 = P_2 - P_6 - re(P_2 - P_6)"]),
    ]
}

/// The printed elements of G that are not zero.
fn jacobian() -> Vec<Item> {
    let element = |id, printed| {
        let [i, j] = places(printed);
        let angle = ANGLES[j - 1];
        Item::new(id, "G", Formula)
            .printed(printed)
            .claims("An element of the Jacobian of g.")
            .with(&CONSTRAINTS)
            .requires(&[format!("G_{i}{j} = D(g_{i}, {angle})")])
    };
    vec![
        element("an-g11", "G_11 = -rr*sin(beta) + d*sin(beta + Theta)"),
        element("an-g12", "G_12 = d*sin(beta + Theta)"),
        element("an-g13", "G_13 = -ss*cos(gamma)"),
        element("an-g21", "G_21 = rr*cos(beta) - d*cos(beta + Theta)"),
        element("an-g22", "G_22 = -d*cos(beta + Theta)"),
        element("an-g23", "G_23 = -ss*sin(gamma)"),
        element("an-g31", "G_31 = -rr*sin(beta) + d*sin(beta + Theta)"),
        element("an-g32", "G_32 = d*sin(beta + Theta)"),
        element("an-g34", "G_34 = -e*cos(Phi + delta)"),
        element("an-g35", "G_35 = -e*cos(Phi + delta) + zt*sin(delta)"),
        element("an-g41", "G_41 = rr*cos(beta) - d*cos(beta + Theta)"),
        element("an-g42", "G_42 = -d*cos(beta + Theta)"),
        element("an-g44", "G_44 = -e*sin(Phi + delta)"),
        element("an-g45", "G_45 = -e*sin(Phi + delta) - zt*cos(delta)"),
        element("an-g51", "G_51 = -rr*sin(beta) + d*sin(beta + Theta)"),
        element("an-g52", "G_52 = d*sin(beta + Theta)"),
        element("an-g56", "G_56 = zf*sin(Omega + epsilon)"),
        element("an-g57", "G_57 = zf*sin(Omega + epsilon) - u*cos(epsilon)"),
        element("an-g61", "G_61 = rr*cos(beta) - d*cos(beta + Theta)"),
        element("an-g62", "G_62 = -d*cos(beta + Theta)"),
        element("an-g66", "G_66 = -zf*cos(Omega + epsilon)"),
        element("an-g67", "G_67 = -zf*cos(Omega + epsilon) - u*sin(epsilon)"),
    ]
}

/// |P − A|² by both chains.
fn mirror() -> Item {
    Item::new("an-mirror", "reference solution", Statement)
        .claims("e = zf and zt = u: the chains K5-K4 and K7-K6 from A to P are mirror images, Φ = -Ω.")
        .with(&["w = e*exp(-i*Phi)", "x = zf*exp(i*Omega)"])
        .model()
        .also("(zt - re(i*w))^2 + (re(w))^2 = zt^2 + e^2 + 2*zt*e*sin(-Phi)")
        .also("at(at(zt^2 + e^2 + 2*zt*e*sin(Phi), zt, u), e, zf) = at(u^2 + zf^2 - 2*u*zf*sin(Omega), Omega, -Phi)")
        .note(
            "The distance of P from A fixes sin Φ by one chain and -sin Ω by the other; both start \
             in the same quadrant and neither reaches a right angle.",
        )
}
