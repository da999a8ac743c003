//! Forces in the pins of a planar linkage in motion.

use super::input::{PlanarForcesInput, SOURCE};
use super::{conditions, laws, points, regions};
use crate::audit::{Domain, Law, Output, ReferenceAnswer, Rows, Uncertified};
use crate::methods::common::conditioned;
use crate::methods::definition::{Definition, method};
use crate::methods::inputs::Number;
use crate::reference::Ball;
use rug::Rational;

/// A planar linkage in motion: what every pin exerts on its body b, and the opposite on a.
///
/// A candidate is a `Fn(PlanarForcesInput) -> ` two values for every pin, force components in the
/// axes of the ground.
#[derive(Clone, Copy, Debug)]
pub struct PlanarReactions;

method! {
    PlanarReactions "planar-reactions": Fn(PlanarForcesInput<'_>), |f, i| f(i)
}

const FORCE: &str = "one system of three equations a body, its matrix and right side with the errors of positions and \
    accelerations";

impl Definition for PlanarReactions {
    type Input<'a, T: Number> = PlanarForcesInput<'a, T>;
    const SUMMARY: &'static str =
        "planar linkage of any structure: forces in its pins under weight and inertia";
    const SOURCE: &'static str = SOURCE;

    fn outputs() -> Vec<Output> {
        vec![
            conditioned("F_x", "N", 2.0, FORCE),
            conditioned("F_y", "N", 2.0, FORCE),
        ]
    }

    fn rows() -> Option<Rows> {
        Some(Rows {
            index: "j",
            count: "pins",
            meaning: "of pin j on its body b",
        })
    }

    fn domain() -> Domain {
        Domain {
            regions: regions::of_forces(),
            check_points: points::of_forces(),
        }
    }

    fn admits(i: Self::Input<'_, f64>) -> bool {
        i.is_placed()
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        i.forces()
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let (linkage, at) = i.placed(bits)?;
        let [speed, acceleration] = [i.speed, i.acceleration].map(|q| Ball::rational(bits, q));
        let series = linkage.series(&at, 2)?;
        let rates = series.in_time(&speed, &acceleration);
        let forces = linkage.joint_forces(&series, &rates, &i.weight())?;
        let values = forces.pins.into_iter().flatten().collect();
        Ok(ReferenceAnswer::bounded(values, PROOF))
    }

    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        conditions::of_reactions(numbers)
    }

    fn laws() -> Vec<Law> {
        laws::of_reactions()
    }
}

const PROOF: &str = "Krawczyk (1969); equations of Newton and Euler, eliminated in balls";
