//! Masses and weights of a planar linkage reduced to its drive.

use super::input::{PROOF, PlanarForcesInput, SOURCE};
use super::{conditions, laws, points, regions};
use crate::audit::{Domain, Law, Output, ReferenceAnswer, Uncertified};
use crate::methods::common::conditioned;
use crate::methods::definition::{Definition, method};
use crate::methods::inputs::Number;
use crate::reference::Ball;
use rug::Rational;

/// A planar linkage in motion: reduced inertia, reduced weight, drive torque.
///
/// A candidate is a `Fn(PlanarForcesInput) -> [I_n, dI_n/dphi, M_o, dM_o/dphi, Q]` with
/// `I_n = Σ m |S'|² + J θ'²`, `M_o = Σ m g·S'` and the drive torque
/// `Q = I_n φ̈ + ½ I_n' φ̇² − M_o`.
#[derive(Clone, Copy, Debug)]
pub struct PlanarReduction;

method! {
    PlanarReduction "planar-reduction": Fn(PlanarForcesInput<'_>), |f, i| f(i)
}

const REDUCED: &str = "all bodies summed from rates that carry the linkage's error";
const TORQUE: &str = "three products of reduced quantities, each with its error";

impl Definition for PlanarReduction {
    type Input<'a, T: Number> = PlanarForcesInput<'a, T>;
    const SUMMARY: &'static str = "planar linkage of any structure: I_n, dI_n/dphi, M_o, dM_o/dphi and the drive torque of a motion";
    const SOURCE: &'static str = SOURCE;

    fn outputs() -> Vec<Output> {
        vec![
            conditioned("I_n", "kg m^2", 2.0, REDUCED),
            conditioned("dI_n/dphi", "kg m^2", 2.0, REDUCED),
            conditioned("M_o", "N m", 2.0, REDUCED),
            conditioned("dM_o/dphi", "N m", 2.0, REDUCED),
            conditioned("Q", "N m", 2.0, TORQUE),
        ]
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
        let mechanism = i.linkage.solver()?;
        let loads = i.loads(&mechanism)?;
        let state = i.linkage.state(&mechanism)?;
        let r = loads.reduce(&mechanism, &state);
        Ok(vec![
            r.inertia,
            r.inertia_derivative,
            r.moment,
            r.moment_derivative,
            r.drive(i.speed, i.acceleration),
        ])
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let (linkage, at) = i.placed(bits)?;
        let series = linkage.series(&at, 2)?;
        let inertia = linkage.reduced_inertia(&series);
        let [moment, slope] = linkage.reduced_force(&series, &i.weight());
        let [speed, acceleration] = [i.speed, i.acceleration].map(|q| Ball::rational(bits, q));
        let torque =
            &inertia[0] * &acceleration + (&inertia[1] * &speed.square()).shift(-1) - &moment;
        let [value, derivative] = [inertia[0].clone(), inertia[1].clone()];
        let values = vec![value, derivative, moment, slope, torque];
        Ok(ReferenceAnswer::bounded(values, PROOF))
    }

    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        conditions::of_reduction(numbers)
    }

    fn laws() -> Vec<Law> {
        laws::of_reduction()
    }
}
