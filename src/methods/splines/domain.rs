//! Where splines on arbitrary knots are audited.

use super::common::Kind;
use crate::audit::{Domain, Draw};
use crate::methods::common::{point, region};

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Shape {
    Well,
    Scaled,
    NearKnots,
    Wild,
    /// Queries up to 20 periods away.
    OtherPeriods,
    /// Small whole numbers, among which equal, level and opposite chords are frequent.
    WholeNumbers,
    /// As `WholeNumbers`, each ordinate up to three floats away from its number.
    NearWholeNumbers,
}

/// `x` or a float up to three places from it.
pub(super) fn a_few_floats_away(draw: &mut Draw, x: f64) -> f64 {
    let steps = draw.integer(0, 3);
    (0..steps).fold(x, |x, _| match draw.chance(0.5) {
        true => x.next_up(),
        false => x.next_down(),
    })
}

impl Kind {
    /// An input of that shape.
    pub(super) fn draw(self, draw: &mut Draw, shape: Shape) -> Vec<f64> {
        let n = draw.integer(if shape == Shape::Wild { 4 } else { 2 }, 9);
        let (sx, sy) = match shape {
            Shape::Scaled => (draw.log_uniform(1e-30, 1e30), draw.log_uniform(1e-30, 1e30)),
            _ => (1.0, 1.0),
        };
        let whole = matches!(shape, Shape::WholeNumbers | Shape::NearWholeNumbers);
        let mut x = vec![match whole {
            true => draw.integer(0, 8) as f64 - 4.0,
            false => draw.uniform(-5.0, 5.0) * sx,
        }];
        for _ in 1..n {
            let step = match shape {
                Shape::Wild => draw.log_uniform(1e-6, 1e3),
                Shape::WholeNumbers | Shape::NearWholeNumbers => draw.integer(1, 3) as f64,
                _ => draw.uniform(0.3, 2.0),
            };
            x.push(x[x.len() - 1] + step * sx);
        }
        let ordinate = |draw: &mut Draw| {
            if whole {
                let v = draw.integer(0, 6) as f64 - 3.0;
                return match shape {
                    // The neighbours of 0 are subnormal.
                    Shape::NearWholeNumbers if v != 0.0 => a_few_floats_away(draw, v),
                    _ => v,
                };
            }
            let v = draw.uniform(-5.0, 5.0) * sy;
            if shape == Shape::Scaled {
                v * draw.log_uniform(1e-8, 1e8)
            } else {
                v
            }
        };
        let mut y: Vec<f64> = (0..n).map(|_| ordinate(draw)).collect();
        if self == Kind::Periodic {
            y[n - 1] = y[0];
        }
        let ends: Vec<f64> = self
            .end_orders()
            .into_iter()
            .flatten()
            .map(|order| draw.uniform(-5.0, 5.0) * (0..order).fold(sy, |unit, _| unit / sx))
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
                Shape::OtherPeriods => {
                    return first + draw.uniform(-20.0, 20.0) * (last - first);
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
            |shape| {
                use crate::methods::splines::domain::Shape;
                match shape {
                    Shape::Well => |d| $kind.draw(d, Shape::Well),
                    Shape::Scaled => |d| $kind.draw(d, Shape::Scaled),
                    Shape::NearKnots => |d| $kind.draw(d, Shape::NearKnots),
                    Shape::Wild => |d| $kind.draw(d, Shape::Wild),
                    Shape::OtherPeriods => |d| $kind.draw(d, Shape::OtherPeriods),
                    Shape::WholeNumbers => |d| $kind.draw(d, Shape::WholeNumbers),
                    Shape::NearWholeNumbers => |d| $kind.draw(d, Shape::NearWholeNumbers),
                }
            },
            |x, y, q| $kind.check_point(x, y, q),
        )
    };
}
pub(super) use domain;

/// The numbers of an input with knots, ordinates and queries.
pub(super) type Laid = fn(&[f64], &[f64], [f64; 2]) -> Vec<f64>;

impl Kind {
    /// A check point's input; its end values are 3 and −5.
    pub(super) fn check_point(self, x: &[f64], y: &[f64], q: [f64; 2]) -> Vec<f64> {
        let ends = self.end_orders().into_iter().zip([3.0, -5.0]);
        let ends: Vec<f64> = ends.filter_map(|(order, v)| order.map(|_| v)).collect();
        [x, y, &ends, &q[..]].concat()
    }
}

pub(super) fn domain_of(
    kind: Kind,
    sampler: impl Fn(Shape) -> fn(&mut Draw) -> Vec<f64>,
    laid: Laid,
) -> Domain {
    let [well, scaled, near, wild] =
        [Shape::Well, Shape::Scaled, Shape::NearKnots, Shape::Wild].map(&sampler);
    let point = |name, x: &[f64], y: &[f64], q: [f64; 2]| point(name, laid(x, y, q));
    let mut domain = Domain {
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
    };
    let mut add_region = |name, description, shape| {
        domain
            .regions
            .push(region(name, description, sampler(shape)));
    };
    match kind {
        Kind::Periodic => {
            add_region(
                "other-periods",
                "as well-scaled, queries up to 20 periods away",
                Shape::OtherPeriods,
            );
            domain.check_points.extend([
                point(
                    "whole-period",
                    &[0.1, 0.5, 1.0],
                    &[1.0, 2.0, 1.0],
                    [0.1, 1.0],
                ),
                point("far-away", &[0.1, 0.5, 1.0], &[1.0, 2.0, 1.0], [1e9, -1e9]),
                point(
                    "knot-of-another-period",
                    &[0.0, 1.0, 3.0],
                    &[1.0, 2.0, 1.0],
                    [7.0, -2.0],
                ),
            ]);
        }
        Kind::Local(_) => {
            add_region(
                "whole-numbers",
                "knots with steps 1..3 and ordinates -3..3, all whole: equal, level and opposite chords",
                Shape::WholeNumbers,
            );
            add_region(
                "near-whole-numbers",
                "as whole-numbers, ordinates at most three floats away from whole numbers",
                Shape::NearWholeNumbers,
            );
            let five = &[0.0, 1.0, 2.0, 3.0, 4.0];
            let eight = &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
            domain.check_points.extend([
                point(
                    "two-straight-pieces",
                    five,
                    &[0.0, 0.0, 0.0, 1.0, 2.0],
                    [1.5, 2.5],
                ),
                point("level", five, &[3.0; 5], [0.5, 3.5]),
                point("a-step", five, &[0.0, 0.0, 0.0, 1.0, 1.0], [1.5, 2.5]),
                point(
                    "end-slope-zero",
                    five,
                    &[0.0, 1.0, 5.0, 5.0, 9.0],
                    [0.25, 3.75],
                ),
                point(
                    "end-slope-limited",
                    five,
                    &[0.0, 1.0, -9.0, 9.0, 8.0],
                    [0.25, 3.75],
                ),
                point(
                    "small-bend-far-from-a-large-one",
                    eight,
                    &[0.0, 0.0, 1e-12, 3e-12, 4e-12, 4e-12, 1.0, 2.0],
                    [0.5, 1.5],
                ),
            ]);
        }
        Kind::Ends(_) => {}
    }
    domain
}
