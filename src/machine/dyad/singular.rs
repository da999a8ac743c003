//! Positions in which the dyad is stretched, folded or square to its guide: both assemblies are one
//! there.
//!
//! Such a position has values of its angles, but none of their derivatives: at a fold these are
//! infinite, and at a change point there are two of each.

use super::{Dyad, Shape, Turn, Values, turn};
use crate::machine::crank_angles::Grid;
use crate::machine::first_bits;
use crate::reference::{Ball, ComplexBall, nearest_f64};
use rug::Rational;
use std::cmp::Ordering;

/// The reach of the dyad at a crank angle, where it can be stated exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// It cannot be joined.
    Beyond,
    /// It is stretched, folded or square to its guide.
    Singular,
}

/// A crank angle at which the assemblies are one.
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// The crank angle in degrees.
    pub degrees: Rational,
    /// True if the crank can go on from there: then it is a change point, else an end of its range.
    pub passes: bool,
}

impl Shape {
    /// Returns whether the dyad is stretched, folded or out of reach, where that can be told
    /// exactly. At no other angle of a rational number of degrees is it stretched or folded: the
    /// condition is a rational value of the cosine (four-bar) or sine (slider-crank).
    pub fn reached(&self, degrees: &Rational) -> Option<Reached> {
        let ends = match (self, self.rational_cos_sin(degrees)) {
            (Shape::FourBar { exact, .. }, (Some(cos), _)) => {
                let [_, b, c, _] = exact;
                let span = square_of_span(exact, &cos);
                [
                    span.cmp(&Rational::from(b + c).square()),
                    Rational::from(b - c).square().cmp(&span),
                ]
            }
            (Shape::SliderCrank { exact, .. }, (_, Some(sin))) => {
                let [a, b, e] = exact;
                let height = (Rational::from(e) - sin * a).abs();
                [height.cmp(b), Ordering::Less]
            }
            _ => return None,
        };
        match ends {
            [Ordering::Greater, _] | [_, Ordering::Greater] => Some(Reached::Beyond),
            [Ordering::Equal, _] | [_, Ordering::Equal] => Some(Reached::Singular),
            _ => None,
        }
    }
}

/// The squared distance of the crank's end from the rocker's pivot.
fn square_of_span([a, _, _, d]: &[Rational; 4], cos: &Rational) -> Rational {
    Rational::from(a * a) + Rational::from(d * d) - Rational::from(a * d) * cos * 2u32
}

/// The angles of the grid, within one turn, at which the assemblies are one.
pub fn meetings(dyad: &Dyad, grid: &Grid) -> Vec<Meeting> {
    let passes = matches!(turn(&dyad.shape), Turn::Full { .. });
    let turned = match &dyad.shape {
        Shape::SliderCrank { direction, .. } if direction.degrees => direction.value.clone(),
        _ => Rational::new(),
    };
    // By Niven's theorem there are none between.
    let all = (0..12).map(|k| Rational::from(30 * k) + &turned);
    let all = all.filter(|d| dyad.shape.reached(d) == Some(Reached::Singular));
    let shown = all.filter_map(|d| grid.first_at(&d));
    let mut found: Vec<Meeting> = shown.map(|degrees| Meeting { degrees, passes }).collect();
    found.sort_by(|a, b| a.degrees.cmp(&b.degrees));
    found
}

/// The position in floating point, angles in radians, NaN for the derivatives; nothing where the
/// coupler may have any angle, because crank and rocker end in one point.
pub(super) fn floating(shape: &Shape, degrees: &Rational) -> Option<Values<f64>> {
    let none = f64::NAN;
    let radians = nearest_f64(degrees).to_radians();
    let exact_or = |exact: Option<Rational>, near: f64| exact.map_or(near, |q| nearest_f64(&q));
    let (cos, sin) = shape.rational_cos_sin(degrees);
    match shape {
        Shape::FourBar { solver, .. } => {
            let (sin, cos) = (exact_or(sin, radians.sin()), exact_or(cos, radians.cos()));
            let [a, b, c, d] = [
                solver.crank(),
                solver.coupler(),
                solver.rocker(),
                solver.frame(),
            ]
            .map(|l| l.m());
            // From the crank's end to the rocker's pivot; 0 − x, so that no zero is negative.
            let (x, y) = (d - a * cos, 0.0 - a * sin);
            let span = x.hypot(y);
            let stretched = (span - (b + c)).abs() < (span - (b - c).abs()).abs();
            if span == 0.0 || (!stretched && b == c) {
                return None;
            }
            let (ahead, back) = (y.atan2(x), (0.0 - y).atan2(0.0 - x));
            let [coupler, rocker] = match (stretched, b > c) {
                (true, _) => [ahead, back],
                (false, true) => [ahead, ahead],
                (false, false) => [back, back],
            };
            let transmission = if stretched { std::f64::consts::PI } else { 0.0 };
            Some([coupler, rocker, none, none, none, none, transmission, 0.0])
        }
        Shape::SliderCrank { solver, .. } => {
            let direction = solver.direction().rad();
            let psi = radians - direction;
            let (sin, cos) = (exact_or(sin, psi.sin()), exact_or(cos, psi.cos()));
            let a = solver.crank().m();
            let height = solver.offset().m() - a * sin;
            let rod = direction + std::f64::consts::FRAC_PI_2.copysign(height);
            Some([a * cos, rod, none, none, none, none, 0.0, 0.0])
        }
    }
}

/// The position with `digits` digits, where it is singular exactly: `None` for what has no value,
/// or no proved digits.
pub(super) fn certified(
    shape: &Shape,
    degrees: &Rational,
    digits: u32,
) -> Option<Values<Option<String>>> {
    let bits = first_bits(digits).max(128);
    let text = |x: &Ball| x.to_decimal(digits as usize);
    let zero = || text(&Ball::integer(bits, 0));
    let (cos, sin) = shape.rational_cos_sin(degrees);
    let angle = shape.relative(degrees, bits);
    let degree = Ball::integer(bits, 180) / Ball::pi(bits);
    match shape {
        Shape::FourBar { exact, .. } => {
            let [a, b, c, d] = exact;
            let cos = cos?;
            let span = square_of_span(exact, &cos);
            let stretched = span == Rational::from(b + c).square();
            if span == 0 {
                return None;
            }
            let x = Rational::from(d) - cos * a;
            let arg = |x: Rational, forward: i64| match &sin {
                Some(sin) if *sin == 0 => Ball::integer(bits, if x > 0 { 0 } else { 180 }),
                _ => {
                    let y = angle.sin_cos().0 * Ball::rational(bits, a);
                    let y = y * Ball::integer(bits, -forward);
                    ComplexBall::new(Ball::rational(bits, &x), y).arg() * &degree
                }
            };
            let (ahead, back) = (arg(x.clone(), 1), arg(-x, -1));
            let [coupler, rocker] = match (stretched, b > c) {
                (true, _) => [&ahead, &back],
                (false, true) => [&ahead, &ahead],
                (false, false) => [&back, &back],
            };
            let transmission = Ball::integer(bits, if stretched { 180 } else { 0 });
            let (phi2, phi3, mu) = (text(coupler), text(rocker), text(&transmission));
            Some([phi2, phi3, None, None, None, None, mu, zero()])
        }
        Shape::SliderCrank {
            exact, direction, ..
        } => {
            let [a, _, e] = exact;
            let height = Rational::from(e) - sin? * a;
            let square = Rational::from(if height > 0 { 90 } else { -90 });
            let rod = match direction.degrees || direction.value == 0 {
                true => Ball::rational(bits, &(square + &direction.value)),
                false => Ball::rational(bits, &square) + direction.to_ball(bits) * &degree,
            };
            let slider = match cos {
                Some(cos) => Ball::rational(bits, &(cos * a)),
                None => angle.sin_cos().1 * Ball::rational(bits, a),
            };
            let (slider, rod) = (text(&slider), text(&rod));
            Some([slider, rod, None, None, None, None, zero(), zero()])
        }
    }
}

#[cfg(test)]
mod tests;
