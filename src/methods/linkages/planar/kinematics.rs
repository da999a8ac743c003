//! Positions, rates and accelerations of a planar linkage.

use super::flow::Flow;
use super::input::{PROOF, PlanarLinkageInput, SOURCE};
use super::{conditions, laws, points, regions};
use crate::audit::{Domain, Law, Output, ReferenceAnswer, Rows, Uncertified};
use crate::methods::common::conditioned;
use crate::methods::definition::{Definition, method};
use crate::methods::inputs::Number;
use crate::reference::planar::{Attachment, Linkage, Position};
use crate::reference::{Ball, Undecided};
use rug::Rational;

/// A planar linkage of pins: angles, centres of mass, both derivatives at the position whose
/// largest difference from `near` over the angles of all moving bodies is least, if that is at most
/// 0.1 rad; angles are real numbers, not reduced by whole turns.
///
/// A candidate is a `Fn(PlanarLinkageInput) -> ` nine values for every moving body, as
/// `mechaudit describe planar-linkage` lays them out.
#[derive(Clone, Copy, Debug)]
pub struct PlanarLinkage;

method! {
    PlanarLinkage "planar-linkage": Fn(PlanarLinkageInput<'_>), |f, i| f(i)
}

const POSITION: &str = "the last Newton correction leaves a residual of a few rounding errors in each loop: the \
    effect of perturbing each coordinate and the drive by a few units";
const FIRST: &str =
    "one factored system whose matrix carries the position's errors, loops being summed around";
const SECOND: &str = "the same system with a right side of squared rates";
const OF_POINT: &str =
    "the angle's, and the point's own sum of products, each rounded with the direction";

fn values(
    linkage: &Linkage,
    at: &Position,
    i: &PlanarLinkageInput<Rational>,
) -> Result<Vec<Ball>, Undecided> {
    let series = linkage.series(at, 2)?;
    let mut all = Vec::new();
    for k in 0..i.near.len() {
        match k {
            // The drive itself, exactly.
            0 => {
                let bits = linkage.bits();
                all.push(Ball::rational(bits, i.phi));
                all.extend([1, 0].map(|n| Ball::integer(bits, n)));
            }
            _ => {
                all.extend([0, 1].map(|n| series.coefficient(k, n).clone()));
                all.push(series.coefficient(k, 2).shift(1));
            }
        }
        let centre = Attachment::body(k, [i.xs[k].clone(), i.ys[k].clone()]);
        all.extend(linkage.point_motion(&series, &centre).into_iter().flatten());
    }
    Ok(all)
}

impl Definition for PlanarLinkage {
    type Input<'a, T: Number> = PlanarLinkageInput<'a, T>;
    const SUMMARY: &'static str = "planar linkage of any structure: angles and centres of mass of its bodies, both derivatives by the drive";
    const SOURCE: &'static str = SOURCE;

    fn outputs() -> Vec<Output> {
        vec![
            conditioned("theta", "rad", 2.0, POSITION),
            conditioned("theta'", "1", 2.0, FIRST),
            conditioned("theta''", "1/rad", 2.0, SECOND),
            conditioned("x", "m", 2.0, POSITION),
            conditioned("y", "m", 2.0, POSITION),
            conditioned("x'", "m", 2.0, OF_POINT),
            conditioned("y'", "m", 2.0, OF_POINT),
            conditioned("x''", "m", 2.0, OF_POINT),
            conditioned("y''", "m", 2.0, OF_POINT),
        ]
    }

    fn rows() -> Option<Rows> {
        Some(Rows {
            index: "k",
            count: "bodies",
            meaning: "of moving body k + 1",
        })
    }

    fn domain() -> Domain {
        Domain {
            regions: regions::of_linkages(),
            check_points: points::of_linkages(),
        }
    }

    fn admits(i: Self::Input<'_, f64>) -> bool {
        i.is_placed()
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        i.motion()
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let (linkage, at) = i.placed(bits)?;
        Ok(ReferenceAnswer::bounded(values(&linkage, &at, &i)?, PROOF))
    }

    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        conditions::of_motion(numbers)
    }

    /// By implicit differentiation at the reference's angles.
    fn conditions_at(numbers: &[f64], values: &[Ball]) -> Option<Vec<f64>> {
        let angles: Vec<f64> = values.iter().step_by(9).map(Ball::to_f64).collect();
        Flow::new(&Self::unpack(numbers)?, &angles).map(|f| f.of_motion())
    }

    fn laws() -> Vec<Law> {
        laws::of_linkages()
    }
}
