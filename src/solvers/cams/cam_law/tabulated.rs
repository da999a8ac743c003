//! Laws given by a table, through a cubic spline.

use super::error::CamLawError;
use super::motion::{Motion, Peaks};
use crate::cubic_spline::{Boundary, CubicSpline, End, Grid};

#[derive(Clone, Debug)]
pub(crate) struct Tabulated {
    spline: CubicSpline,
    /// Through `1 − y`, for what is left of the stroke near its end.
    left: CubicSpline,
    ends: [End; 2],
}

/// From this displacement on what is left is computed first.
const NEAR_END: f64 = 0.875;

/// The part of an end segment in which `s`, or what is left, comes from the slope given at that
/// end: there the ordinates' share cancels that of the bend.
const BESIDE: f64 = 0.25;

/// The condition for `1 − s`.
fn negated(end: End) -> End {
    match end {
        End::FirstDerivative(v) => End::FirstDerivative(-v),
        End::SecondDerivative(a) => End::SecondDerivative(-a),
        End::NotAKnot => End::NotAKnot,
    }
}

impl Tabulated {
    pub(super) fn new(x: Vec<f64>, y: Vec<f64>, ends: [End; 2]) -> Result<Tabulated, CamLawError> {
        let rest = y.iter().map(|y| 1.0 - y).collect();
        let opposite = Boundary::Ends(negated(ends[0]), negated(ends[1]));
        let left = CubicSpline::fit(x.clone(), rest, opposite);
        let spline = CubicSpline::fit(x, y, Boundary::Ends(ends[0], ends[1]))?;
        let (x0, x1) = spline.grid().span();
        let y = spline.values_at_knots();
        let (y0, y1) = (y[0], y[y.len() - 1]);
        if (x0, y0, x1, y1) != (0.0, 0.0, 1.0, 1.0) {
            return Err(CamLawError::TableEnds { x0, y0, x1, y1 });
        }
        let left = left?;
        Ok(Tabulated { spline, left, ends })
    }

    /// The motion and `1 − s`.
    pub(super) fn motion(&self, x: f64) -> Result<(Motion, f64), CamLawError> {
        let jet = self.spline.jet(x)?;
        let (second, third) = (jet.second, jet.third);
        let (displacement, remaining) = if let Some(v) = self.slope_beside(0, x) {
            let s = x * (v + x * (0.5 * second - third * x / 3.0));
            (s, 1.0 - s)
        } else if let Some(v) = self.slope_beside(1, 1.0 - x) {
            let u = 1.0 - x;
            let rest = u * (v - u * (0.5 * second + third * u / 3.0));
            (1.0 - rest, rest)
        } else if jet.value > NEAR_END {
            let rest = self.left.jet(x)?.value;
            (1.0 - rest, rest)
        } else {
            (jet.value, 1.0 - jet.value)
        };
        let motion = Motion {
            displacement,
            velocity: jet.first,
            acceleration: jet.second,
            jerk: jet.third,
        };
        Ok((motion, remaining))
    }

    /// The slope given at an end, that far beside it.
    fn slope_beside(&self, end: usize, distance: f64) -> Option<f64> {
        let knots = self.knots();
        let width = match end {
            0 => knots[1],
            _ => 1.0 - knots[knots.len() - 2],
        };
        match self.ends[end] {
            End::FirstDerivative(v) if distance < BESIDE * width => Some(v),
            _ => None,
        }
    }

    pub(crate) fn knots(&self) -> &[f64] {
        self.spline.grid().as_slice()
    }

    /// `S'''` on each segment.
    pub(crate) fn third(&self) -> Vec<f64> {
        let knots = self.knots();
        let last = knots.len() - 2;
        let at = |x: &f64| self.spline.jet(*x).map_or(f64::NAN, |j| j.third);
        knots[..=last].iter().map(at).collect()
    }

    /// `S'` and `S''` at both ends; where they are given, as they are given.
    pub(crate) fn at_ends(&self) -> [[f64; 2]; 2] {
        [(0.0, self.ends[0]), (1.0, self.ends[1])].map(|(x, end)| {
            let jet = self.spline.jet(x).unwrap_or_default();
            match end {
                End::FirstDerivative(v) => [v, jet.second],
                End::SecondDerivative(a) => [jet.first, a],
                End::NotAKnot => [jet.first, jet.second],
            }
        })
    }

    pub(crate) fn mean(&self) -> f64 {
        self.spline.integral(0.0, 1.0).unwrap_or(f64::NAN)
    }

    /// The acceleration is straight between the knots, the velocity extreme where it vanishes.
    pub(super) fn peaks(&self) -> Peaks {
        let knots = self.knots();
        let bend = self.spline.second_derivatives();
        let [start, end] = self.at_ends();
        let mut velocity = start[0].abs().max(end[0].abs());
        for (x, m) in knots.windows(2).zip(bend.windows(2)) {
            let mut places = vec![x[0]];
            if m[0] * m[1] < 0.0 {
                places.push(x[0] + (x[1] - x[0]) * (m[0] / (m[0] - m[1])));
            }
            for x in places {
                let jet = self.spline.jet(x).unwrap_or_default();
                velocity = velocity.max(jet.first.abs());
            }
        }
        let jumps = |k: usize| start[k] != 0.0 || end[k] != 0.0;
        let beyond = |infinite: bool, value: f64| if infinite { f64::INFINITY } else { value };
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        Peaks {
            velocity,
            acceleration: beyond(jumps(0), largest(&mut bend.iter().copied())),
            deceleration: largest(&mut bend.iter().map(|m| -m)),
            jerk: beyond(
                jumps(0) || jumps(1),
                largest(&mut self.third().into_iter().map(f64::abs)),
            ),
        }
    }
}
