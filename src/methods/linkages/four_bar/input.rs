//! The input of the four-bar linkage and the solver's motion of it.

use crate::methods::inputs::inputs;
use crate::solvers::dyad::{self, Assembly, FourBarMotion};
use crate::solvers::units::{Angle, Length};

inputs! {
    /// A four-bar linkage at a crank angle.
    pub struct FourBarInput {
        a: number "a (crank)", "m";
        b: number "b (coupler)", "m";
        c: number "c (rocker)", "m";
        d: number "d (frame)", "m";
        phi1: number "phi1", "rad";
        assembly: choice "assembly (1 or -1)", "1";
    }
}

pub(super) fn motion(i: FourBarInput) -> Result<FourBarMotion, &'static str> {
    let [a, b, c, d] = [i.a, i.b, i.c, i.d].map(Length::from_m);
    dyad::FourBar::new(a, b, c, d)
        .and_then(|bar| bar.position(Angle::from_rad(i.phi1), side(i.assembly)))
        .map_err(|e| e.name())
}

/// The assembly that an input chooses.
pub(in crate::methods::linkages) fn side(assembly: f64) -> Assembly {
    match assembly > 0.0 {
        true => Assembly::Positive,
        false => Assembly::Negative,
    }
}

pub(super) fn values(m: &FourBarMotion) -> Vec<f64> {
    let (b, c) = (m.coupler, m.rocker);
    vec![
        b.angle.rad(),
        c.angle.rad(),
        b.first,
        c.first,
        b.second,
        c.second,
        m.transmission.rad(),
        m.joint.position_m[0],
        m.joint.position_m[1],
    ]
}
