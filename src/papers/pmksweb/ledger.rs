//! The basis of the verdicts: two circles, the side of the line between their centres, a slider
//! next to a tangency.

use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::{Formula, Statement};

/// Foot and height of C over BD in units of |BD|, with n = |BD|².
const CIRCLES: [&str; 2] = ["p = (n + l^2 - s^2)/(2*n)", "q_2 = l^2/n - p^2"];
/// The guide's distance from a crank pin that reaches as far as the rod is long, r + e = L, in the
/// angle 2z from there.
const SLIDER: [&str; 1] = ["y = L - r + r*cos(2*z)"];

/// All entries.
pub fn items() -> Vec<Item> {
    let item = |id, place, form| Item::new(id, place, Formula).composed(form);
    vec![
        item("pm-frame", "issue 91", "n = r^2 + g^2 - 2*r*g*cos(psi)")
            .claims("|BD|² with the crank turned by ψ from the frame.")
            .requires(&["n = (g - r*cos(psi))^2 + (r*sin(psi))^2"]),
        item("pm-coupler", "issue 91", "l_2 = p^2*n + q_2*n")
            .claims("C at the foot p and the height q lies on the circle around B.")
            .with(&CIRCLES)
            .requires(&["l_2 = l^2"]),
        item("pm-rocker", "issue 91", "s_2 = (1 - p)^2*n + q_2*n")
            .claims("It lies on the circle around D.")
            .with(&CIRCLES)
            .requires(&["s_2 = s^2"]),
        item("pm-height", "issue 91", "h_2 = ((l + s)^2 - n)*(n - (l - s)^2)")
            .claims("The height vanishes where coupler and rocker are stretched or folded, and nowhere else.")
            .with(&CIRCLES)
            .requires(&["h_2 = 4*n^2*q_2"]),
        item("pm-simple", "issue 91", "n_1 = 2*r*g*sin(psi)")
            .claims("The zero of h² is simple where sin ψ is not zero: both modes join there smoothly.")
            .with(&["n = r^2 + g^2 - 2*r*g*cos(psi)"])
            .requires(&["n_1 = D(n, psi)"]),
        item("pm-touch", "pull request 231", "x_2 = 4*r*sin(z)^2*(L - r*sin(z)^2)")
            .claims("The square of the slider's distance from the foot, where the circle touches the guide at z = 0.")
            .with(&SLIDER)
            .requires(&["x_2 = L^2 - y^2"]),
        item("pm-through", "pull request 231", "v_2 = 4*r*L")
            .claims(
                "Half its second derivative: the smooth root is 2 sin z times a root that keeps its sign, so it goes through \
                 the foot with a rate that is not zero.",
            )
            .with(&["x_2 = 4*r*sin(z)^2*(L - r*sin(z)^2)"])
            .requires(&["2*v_2 = at(D(D(x_2, z), z), z, 0)"]),
        item("pm-apart", "pull request 231", "x_2 = c*(2*L + c)")
            .claims("The same at z = 0 with a rod longer by c: shorter, there is no position; longer, no passage.")
            .with(&SLIDER)
            .requires(&["x_2 = (L + c)^2 - at(y, z, 0)^2"]),
        Item::new("pm-roots", "pull request 231", Statement)
            .claims("Both roots keep rod and guide: nothing but the motion tells them apart.")
            .with(&SLIDER)
            .model()
            .also("(2*sin(z))^2*r*(L - r*sin(z)^2) + y^2 = L^2")
            .also("(-2*sin(z))^2*r*(L - r*sin(z)^2) + y^2 = L^2"),
    ]
}
