//! Where splines on arbitrary knots are audited.

use super::common::EndCondition;
use crate::audit::{Domain, Draw};
use crate::methods::common::{point, region};

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Shape {
    Well,
    Scaled,
    NearKnots,
    Wild,
}

/// `x` or a float up to three places from it.
pub(super) fn a_few_floats_away(draw: &mut Draw, x: f64) -> f64 {
    let steps = draw.integer(0, 3);
    (0..steps).fold(x, |x, _| match draw.chance(0.5) {
        true => x.next_up(),
        false => x.next_down(),
    })
}

impl EndCondition {
    /// An input of that shape.
    pub(super) fn draw(self, draw: &mut Draw, shape: Shape) -> Vec<f64> {
        let n = draw.integer(if shape == Shape::Wild { 4 } else { 2 }, 9);
        let (sx, sy) = match shape {
            Shape::Scaled => (draw.log_uniform(1e-30, 1e30), draw.log_uniform(1e-30, 1e30)),
            _ => (1.0, 1.0),
        };
        let mut x = vec![draw.uniform(-5.0, 5.0) * sx];
        for _ in 1..n {
            let step = match shape {
                Shape::Wild => draw.log_uniform(1e-6, 1e3),
                _ => draw.uniform(0.3, 2.0),
            };
            x.push(x[x.len() - 1] + step * sx);
        }
        let ordinate = |draw: &mut Draw| {
            let v = draw.uniform(-5.0, 5.0) * sy;
            if shape == Shape::Scaled {
                v * draw.log_uniform(1e-8, 1e8)
            } else {
                v
            }
        };
        let mut y: Vec<f64> = (0..n).map(|_| ordinate(draw)).collect();
        if self == EndCondition::Periodic {
            y[n - 1] = y[0];
        }
        let end_unit = match self {
            EndCondition::SecondDerivatives => sy / sx / sx,
            _ => sy / sx,
        };
        let ends: Vec<f64> = (0..self.end_values())
            .map(|_| draw.uniform(-5.0, 5.0) * end_unit)
            .collect();
        let (first, last) = (x[0], x[n - 1]);
        let query = |draw: &mut Draw| {
            let q = match shape {
                Shape::NearKnots => {
                    let knot = x[draw.integer(0, n - 1)];
                    a_few_floats_away(draw, knot)
                }
                Shape::Wild => {
                    let i = draw.integer(0, n - 2);
                    x[i] + draw.unit() * (x[i + 1] - x[i])
                }
                _ => draw.uniform(first, last),
            };
            q.clamp(first, last)
        };
        let queries = vec![query(draw), query(draw)];
        [x, y, ends, queries].concat()
    }
}

/// Regions and check points; the samplers are those of `kind`.
macro_rules! domain {
    ($kind:expr) => {
        crate::methods::splines::domain::domain_of(
            $kind,
            [
                |d| $kind.draw(d, crate::methods::splines::domain::Shape::Well),
                |d| $kind.draw(d, crate::methods::splines::domain::Shape::Scaled),
                |d| $kind.draw(d, crate::methods::splines::domain::Shape::NearKnots),
                |d| $kind.draw(d, crate::methods::splines::domain::Shape::Wild),
            ],
        )
    };
}
pub(super) use domain;

pub(super) fn domain_of(kind: EndCondition, samplers: [fn(&mut Draw) -> Vec<f64>; 4]) -> Domain {
    let [well, scaled, near, wild] = samplers;
    let ends = |a: f64, b: f64| [a, b][..kind.end_values()].to_vec();
    let point = |name, x: &[f64], y: &[f64], q: [f64; 2]| {
        point(name, [x, y, &ends(3.0, -5.0), &q[..]].concat())
    };
    Domain {
        regions: vec![
            region(
                "well-scaled",
                "2 to 9 knots with steps 0.3..2, ordinates and end values -5..5",
                well,
            ),
            region(
                "badly-scaled",
                "as well-scaled, units of x and y from 1e-30 to 1e30, ordinates spread \
                              over 16 orders",
                scaled,
            ),
            region(
                "near-knots",
                "as well-scaled, queries at most three floats away from a knot",
                near,
            ),
            region(
                "wild-spacing",
                "4 to 9 knots with steps 1e-6..1e3, log-uniform",
                wild,
            ),
        ],
        check_points: vec![
            point("two-knots", &[0.0, 1.0], &[1.0, 1.0], [0.25, 1.0]),
            point(
                "three-knots",
                &[0.0, 1.0, 3.0],
                &[1.0, -2.0, 1.0],
                [0.0, 2.5],
            ),
            point(
                "four-knots",
                &[-1.0, 0.0, 1.0, 2.0],
                &[0.0, 1.0, 2.0, 0.0],
                [-1.0, 2.0],
            ),
            point("one-knot", &[0.0], &[1.0], [0.0, 0.0]),
            point(
                "equal-knots",
                &[0.0, 1.0, 1.0],
                &[1.0, 2.0, 1.0],
                [0.0, 1.0],
            ),
            point("outside", &[0.0, 1.0, 2.0], &[1.0, 2.0, 1.0], [0.0, 2.5]),
            point("same-point", &[0.0, 1.0, 2.0], &[1.0, 2.0, 1.0], [1.0, 1.0]),
        ],
    }
}
