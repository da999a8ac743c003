//! The four-bar linkage.

mod input;
mod laws;
mod regions;

use crate::audit::{Domain, Law, Output, ReferenceAnswer, Uncertified};
use crate::methods::common::conditioned;
use crate::methods::definition::{Definition, method};
use crate::methods::inputs::Number;
use crate::reference::dyad::{DyadRefusal, four_bar};
use input::{motion, values};
use rug::Rational;
use std::cmp::Ordering;

pub use input::FourBarInput;
pub(super) use input::side;

/// Crank and RRR dyad: position, both derivatives, transmission angle.
///
/// A candidate is a `Fn([crank, coupler, rocker, frame], phi1, positive assembly) -> [phi2, phi3,
/// phi2', phi3', phi2'', phi3'', mu, x_C, y_C]`, metres and radians, derivatives by `phi1`.
#[derive(Clone, Copy, Debug)]
pub struct FourBar;

method! {
    FourBar "four-bar":
        Fn([f64; 4], f64, bool), |f, i| f([i.a, i.b, i.c, i.d], i.phi1, i.assembly > 0.0)
}

const POSITION: &str = "a mixed forward-backward stable position: a few roundings of each length \
    and of the crank angle, and of the three angles that are added";
const FIRST: &str = "the position's errors pass through the link directions into two quotients";
const SECOND: &str = "two squares of the first derivatives and the position's errors once more";

/// The word of a reference that gives no values.
pub(super) fn refusal(why: DyadRefusal) -> Uncertified {
    Uncertified::Refused(match why {
        DyadRefusal::NotPositive => "not positive",
        DyadRefusal::CannotClose => "cannot close",
        DyadRefusal::Unreachable => "unreachable",
        DyadRefusal::Singular => "singular",
        DyadRefusal::Undecided(u) => return u.into(),
    })
}

impl Definition for FourBar {
    type Input<'a, T: Number> = FourBarInput<'a, T>;
    const SUMMARY: &'static str =
        "four-bar linkage: angles, derivatives by the crank angle, transmission angle";
    const SOURCE: &'static str = "loop equation a e1 + b e2 = (d, 0) + c e3 and its derivatives, equations (1) to (6) of \
         the solver; Artobolevskii, Theory of Mechanisms and Machines, class-II groups";

    fn outputs() -> Vec<Output> {
        vec![
            conditioned("phi2", "rad", 4.0, POSITION),
            conditioned("phi3", "rad", 4.0, POSITION),
            conditioned("phi2'", "1", 8.0, FIRST),
            conditioned("phi3'", "1", 8.0, FIRST),
            conditioned("phi2''", "1", 12.0, SECOND),
            conditioned("phi3''", "1", 12.0, SECOND),
            conditioned("mu", "rad", 4.0, POSITION),
            conditioned("x_C", "m", 8.0, POSITION),
            conditioned("y_C", "m", 8.0, POSITION),
        ]
    }

    fn domain() -> Domain {
        regions::domain()
    }

    fn admits(i: Self::Input<'_, f64>) -> bool {
        i.assembly.abs() == 1.0
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        Ok(values(&motion(i)?))
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let lengths = [i.a, i.b, i.c, i.d].map(Rational::clone);
        let positive = i.assembly.cmp0() == Ordering::Greater;
        let m = four_bar(&lengths, i.phi1, positive, bits).map_err(refusal)?;
        let [phi2, first2, second2] = m.coupler;
        let [phi3, first3, second3] = m.rocker;
        let mut values = vec![phi2, phi3, first2, first3, second2, second3, m.transmission];
        values.extend(m.joint);
        Ok(ReferenceAnswer::bounded(
            values,
            "intersection of circles in ball arithmetic, implicit differentiation",
        ))
    }

    fn laws() -> Vec<Law> {
        laws::all()
    }
}
