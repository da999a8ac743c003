//! Mass matrix and forces from the energies.

use super::places;
use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::Formula;

/// The kinetic energy, body by body: `m |S'|² + I ψ'²` with `|S'|² = S' conj S'`, written in x and
/// y.
const ENERGY: [&str; 20] = [
    "x_2 = rr*cos(beta) - da*cos(beta + Theta)",
    "y_2 = rr*sin(beta) - da*sin(beta + Theta)",
    "xv_2 = D(x_2, beta)*v_1 + D(x_2, Theta)*v_2",
    "yv_2 = D(y_2, beta)*v_1 + D(y_2, Theta)*v_2",
    "T_1 = (m1*ra^2 + i1)*v_1^2/2",
    "T_2 = m2*(xv_2^2 + yv_2^2)/2 + i2*(v_1 + v_2)^2/2",
    "T_3 = (m3*(sa^2 + sb^2) + i3)*v_3^2/2",
    "x_4 = zt*cos(delta) + (e - ea)*sin(Phi + delta)",
    "y_4 = zt*sin(delta) - (e - ea)*cos(Phi + delta)",
    "xv_4 = D(x_4, Phi)*v_4 + D(x_4, delta)*v_5",
    "yv_4 = D(y_4, Phi)*v_4 + D(y_4, delta)*v_5",
    "T_4 = m4*(xv_4^2 + yv_4^2)/2 + i4*(v_4 + v_5)^2/2",
    "T_5 = (m5*(ta^2 + tb^2) + i5)*v_5^2/2",
    "x_6 = u*sin(epsilon) + (zf - fa)*cos(Omega + epsilon)",
    "y_6 = -u*cos(epsilon) + (zf - fa)*sin(Omega + epsilon)",
    "xv_6 = D(x_6, Omega)*v_6 + D(x_6, epsilon)*v_7",
    "yv_6 = D(y_6, Omega)*v_6 + D(y_6, epsilon)*v_7",
    "T_6 = m6*(xv_6^2 + yv_6^2)/2 + i6*(v_6 + v_7)^2/2",
    "T_7 = (m7*(ua^2 + ub^2) + i7)*v_7^2/2",
    "T = T_1 + T_2 + T_3 + T_4 + T_5 + T_6 + T_7",
];

/// The spring; `2 L dL = d(L²)` with Q for L².
const SPRING: [&str; 3] = [
    "xd = sd*cos(gamma) + sc*sin(gamma) + xb",
    "yd = sd*sin(gamma) - sc*cos(gamma) + yb",
    "Q = (xd - xc)^2 + (yd - yc)^2",
];

pub(super) fn items() -> Vec<Item> {
    let mut all = masses();
    all.extend(forces());
    all.extend(spring());
    all
}

fn masses() -> Vec<Item> {
    let element = |id, printed| {
        let [i, j] = places(printed);
        Item::new(id, "M", Formula)
            .printed(printed)
            .claims("A second derivative of the kinetic energy by two rates.")
            .with(&ENERGY)
            .requires(&[format!("M_{i}{j} = D(D(T, v_{j}), v_{i})")])
    };
    vec![
        element(
            "an-m11",
            "M_11 = m1*ra^2 + m2*(rr^2 - 2*da*rr*cos(Theta) + da^2) + i1 + i2",
        ),
        element("an-m21", "M_21 = m2*(da^2 - da*rr*cos(Theta)) + i2"),
        element("an-m22", "M_22 = m2*da^2 + i2"),
        element("an-m33", "M_33 = m3*(sa^2 + sb^2) + i3"),
        element("an-m44", "M_44 = m4*(e - ea)^2 + i4"),
        element(
            "an-m54",
            "M_54 = m4*((e - ea)^2 + zt*(e - ea)*sin(Phi)) + i4",
        ),
        element(
            "an-m55",
            "M_55 = m4*(zt^2 + 2*zt*(e - ea)*sin(Phi) + (e - ea)^2) + m5*(ta^2 + tb^2) + i4 + i5",
        ),
        element("an-m66", "M_66 = m6*(zf - fa)^2 + i6"),
        element(
            "an-m76",
            "M_76 = m6*((zf - fa)^2 - u*(zf - fa)*sin(Omega)) + i6",
        ),
        element(
            "an-m77",
            "M_77 = m6*((zf - fa)^2 - 2*u*(zf - fa)*sin(Omega) + u^2) + m7*(ua^2 + ub^2) + i6 + i7",
        ),
    ]
}

/// `f = Q + ∂T/∂q − (∂²T/∂q'∂q) q'`.
fn forces() -> Vec<Item> {
    let component = |id, printed, lagrange: &'static [&'static str]| {
        Item::new(id, "f", Formula)
            .printed(printed)
            .claims("What Lagrange's equation leaves on the right of M q''.")
            .with(&ENERGY)
            .requires(lagrange)
    };
    vec![
        component(
            "an-f1",
            "f_1 = mom - m2*da*rr*v_2*(v_2 + 2*v_1)*sin(Theta)",
            &["f_1 = mom + D(T, beta) - D(D(T, v_1), beta)*v_1 - D(D(T, v_1), Theta)*v_2"],
        ),
        component(
            "an-f2",
            "f_2 = m2*da*rr*v_1^2*sin(Theta)",
            &["f_2 = D(T, Theta) - D(D(T, v_2), beta)*v_1 - D(D(T, v_2), Theta)*v_2"],
        ),
        component(
            "an-f4",
            "f_4 = m4*zt*(e - ea)*v_5^2*cos(Phi)",
            &["f_4 = D(T, Phi) - D(D(T, v_4), Phi)*v_4 - D(D(T, v_4), delta)*v_5"],
        ),
        component(
            "an-f5",
            "f_5 = -m4*zt*(e - ea)*v_4*(v_4 + 2*v_5)*cos(Phi)",
            &["f_5 = D(T, delta) - D(D(T, v_5), Phi)*v_4 - D(D(T, v_5), delta)*v_5"],
        ),
        component(
            "an-f6",
            "f_6 = -m6*u*(zf - fa)*v_7^2*cos(Omega)",
            &["f_6 = D(T, Omega) - D(D(T, v_6), Omega)*v_6 - D(D(T, v_6), epsilon)*v_7"],
        ),
        component(
            "an-f7",
            "f_7 = m6*u*(zf - fa)*v_6*(v_6 + 2*v_7)*cos(Omega)",
            &["f_7 = D(T, epsilon) - D(D(T, v_7), Omega)*v_6 - D(D(T, v_7), epsilon)*v_7"],
        ),
    ]
}

fn spring() -> Vec<Item> {
    vec![
        Item::new("an-d", "xd, yd", Formula)
            .printed("D_x = sd*cos(gamma) + sc*sin(gamma) + xb")
            .claims("The spring's end on K3, at (sd, -sc) in its axes.")
            .requires(&["D_x = re(xb + (sd - i*sc)*exp(i*gamma))"]),
        Item::new("an-d-y", "xd, yd", Formula)
            .printed("D_y = sd*sin(gamma) - sc*cos(gamma) + yb")
            .claims("The spring's end on K3, at (sd, -sc) in its axes.")
            .requires(&["D_y = re(yb - i*(sd - i*sc)*exp(i*gamma))"]),
        Item::new("an-l", "L", Formula)
            .printed("L = sqrt((xd - xc)^2 + (yd - yc)^2)")
            .claims("The spring's length.")
            .definition(),
        Item::new("an-force", "F", Formula)
            .printed("F = -c0*(L - l0)/L")
            .claims("The force for a vector of the spring's length: Hooke's law.")
            .requires(&["F*L = -D(c0*(L - l0)^2/2, L)"]),
        Item::new("an-fx", "Fx, Fy", Formula)
            .printed("F_x = F*(xd - xc)")
            .claims("The force on K3.")
            .with(&["F = -c0*(L - l0)/L"])
            .requires(&["F_x*L = -c0*(L - l0)*(xd - xc)"]),
        Item::new("an-fy", "Fx, Fy", Formula)
            .printed("F_y = F*(yd - yc)")
            .claims("The force on K3.")
            .with(&["F = -c0*(L - l0)/L"])
            .requires(&["F_y*L = -c0*(L - l0)*(yd - yc)"]),
        Item::new("an-f3", "f", Formula)
            .printed(
                "f_3 = Fx*(sc*cos(gamma) - sd*sin(gamma)) + Fy*(sd*cos(gamma) + sc*sin(gamma))",
            )
            .claims(
                "The moment of the spring: less the derivative of c0 (L - l0)²/2 by γ, with \
                 2L dL/dγ = dQ/dγ for Q = L².",
            )
            .with(&SPRING)
            .with(&[
                "Fx = -c0*(L - l0)/L*(xd - xc)",
                "Fy = -c0*(L - l0)/L*(yd - yc)",
            ])
            .requires(&["2*L*f_3 = -c0*(L - l0)*D(Q, gamma)"]),
    ]
}
