//! The coefficient functions I_n(φ), dI_n/dφ and M_o(φ), panel by panel over a turn of the crank.

use super::linkage_curve::LinkageCurve;
use super::linkage_panel::Panel;
use crate::class_iii::ExactAngle;
use crate::cubic_spline::{PeriodicUniform, periodic_uniform};
use crate::taylor_model::TaylorModel;
use crate::{Ball, Undecided};
use rug::Rational;
use std::sync::Arc;

/// Where the coefficients come from.
enum Source {
    Constant(Arc<Panel>),
    Exact(Arc<LinkageCurve>),
    Splines(Vec<Arc<Panel>>),
    /// Exact I_n and M_o, the slope from a spline.
    Hybrid(Arc<LinkageCurve>, Vec<TaylorModel>),
}

/// The coefficients of the equation of motion: one of the models below.
pub struct Coefficients {
    source: Source,
    pub(super) bits: u32,
    /// Panels in a period of `turns` turns.
    pub(super) panels: u32,
    pub(super) turns: u32,
    pub(super) offset: ExactAngle,
}

/// Turns in the one panel of constant coefficients, so that it limits no step.
const LONG: u32 = 1 << 16;

impl Coefficients {
    /// Constant inertia and moment.
    pub fn constant(inertia: &Rational, moment: &Rational, bits: u32) -> Coefficients {
        let model = |q: &Rational| TaylorModel::constant(&Ball::rational(bits, q));
        Coefficients {
            source: Source::Constant(Arc::new(Panel {
                inertia: model(inertia),
                slope: model(&Rational::new()),
                moment: model(moment),
            })),
            bits,
            panels: 1,
            turns: LONG,
            offset: ExactAngle::Radians(Rational::new()),
        }
    }

    /// These panels, the first from the angle zero on, in one turn.
    #[cfg(test)]
    pub(super) fn of_panels(panels: Vec<Panel>, bits: u32) -> Coefficients {
        Coefficients {
            bits,
            panels: panels.len() as u32,
            turns: 1,
            offset: ExactAngle::Radians(Rational::new()),
            source: Source::Splines(panels.into_iter().map(Arc::new).collect()),
        }
    }

    /// The exact functions of a linkage.
    pub fn exact(curve: &Arc<LinkageCurve>) -> Coefficients {
        Coefficients {
            bits: curve.bits(),
            panels: curve.panels,
            turns: 1,
            offset: curve.offset.clone(),
            source: Source::Exact(curve.clone()),
        }
    }

    /// Periodic cubic splines through the exact I_n and M_o at `nodes` equal steps from the curve's
    /// start angle; dI_n/dφ is the derivative of the same spline.
    ///
    /// # Errors
    /// As [`LinkageCurve::nodes`]; fewer than three nodes.
    pub fn splines(curve: &LinkageCurve, nodes: u32) -> Result<Coefficients, Undecided> {
        let (inertia, moment) = spline_pair(curve, nodes)?;
        let h = half_step(curve.bits(), nodes);
        let panel = |j: u32| {
            let i = cubic(&inertia, j as usize, &h);
            Arc::new(Panel {
                slope: per_radian(&i, &h),
                inertia: TaylorModel::from_balls(&i),
                moment: TaylorModel::from_balls(&cubic(&moment, j as usize, &h)),
            })
        };
        Ok(Coefficients {
            source: Source::Splines((0..nodes).map(panel).collect()),
            bits: curve.bits(),
            panels: nodes,
            turns: 1,
            offset: curve.offset.clone(),
        })
    }

    /// The model that Zinchenko (2008) recommends: exact I_n and M_o, and in the place of dI_n/dφ
    /// the derivative of the periodic spline through I_n at `nodes` equal steps.
    ///
    /// # Errors
    /// As [`LinkageCurve::nodes`]; fewer than three nodes, or a number of panels that is no
    /// multiple of theirs.
    pub fn hybrid(curve: &Arc<LinkageCurve>, nodes: u32) -> Result<Coefficients, Undecided> {
        let (inertia, _) = spline_pair(curve, nodes)?;
        if !curve.panels.is_multiple_of(nodes) {
            return Err(curve.undecided("the panels of the linkage do not end at every knot"));
        }
        let share = curve.panels / nodes;
        let h = half_step(curve.bits(), nodes);
        let slopes = (0..curve.panels).map(|k| {
            let whole = per_radian(&cubic(&inertia, (k / share) as usize, &h), &h);
            part(&whole, k % share, share, curve.bits())
        });
        Ok(Coefficients {
            bits: curve.bits(),
            panels: curve.panels,
            turns: 1,
            offset: curve.offset.clone(),
            source: Source::Hybrid(curve.clone(), slopes.collect()),
        })
    }

    /// The panel of that number; 0 begins at the offset, whole turns are taken off.
    pub(super) fn panel(&self, index: i64) -> Result<Arc<Panel>, Undecided> {
        let turn = index.rem_euclid(i64::from(self.panels)) as usize;
        match &self.source {
            Source::Constant(panel) => Ok(panel.clone()),
            Source::Exact(curve) => curve.panel(index),
            Source::Splines(panels) => Ok(panels[turn].clone()),
            Source::Hybrid(curve, slopes) => {
                let exact = curve.panel(index)?;
                Ok(Arc::new(Panel {
                    slope: slopes[turn].clone(),
                    ..(*exact).clone()
                }))
            }
        }
    }

    /// Half the width of a panel in radians.
    pub(super) fn half_width(&self) -> Ball {
        half_step(self.bits, self.panels) * Ball::integer(self.bits, i64::from(self.turns))
    }

    /// The working precision in bits.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// The crank angle in panels from the offset.
    pub(super) fn place(&self, phi: &ExactAngle) -> Ball {
        let b = |q: &Rational| Ball::rational(self.bits, q);
        let panels = Rational::from((self.panels, self.turns));
        match (phi, &self.offset) {
            (ExactAngle::Degrees(a), ExactAngle::Degrees(o)) => {
                b(&(Rational::from(a - o) / 360 * panels))
            }
            (ExactAngle::Radians(a), ExactAngle::Radians(o)) => {
                b(&(Rational::from(a - o) / 2 * panels)) / Ball::pi(self.bits)
            }
            (a, _) => self.place_of(&a.to_ball(self.bits)),
        }
    }

    /// [`place`](Self::place) of an angle in radians.
    pub(super) fn place_of(&self, phi: &Ball) -> Ball {
        let gap = phi - &self.offset.to_ball(self.bits);
        let panels = Rational::from((self.panels, self.turns)) / 2;
        gap * Ball::rational(self.bits, &panels) / Ball::pi(self.bits)
    }
}

fn half_step(bits: u32, parts: u32) -> Ball {
    Ball::pi(bits) / Ball::integer(bits, i64::from(parts))
}

fn spline_pair(
    curve: &LinkageCurve,
    nodes: u32,
) -> Result<(PeriodicUniform, PeriodicUniform), Undecided> {
    if nodes < 3 {
        return Err(curve.undecided("a periodic spline needs three nodes"));
    }
    let (inertia, moment) = curve.nodes(nodes)?;
    let h = half_step(curve.bits(), nodes).shift(1);
    let spline = |y: &[Ball]| periodic_uniform(y, &h).map_err(|e| curve.undecided(e.to_string()));
    Ok((spline(&inertia)?, spline(&moment)?))
}

/// The cubic of a segment in `w = (x − middle)/h`, from values and slopes at its ends (Hermite).
fn cubic(spline: &PeriodicUniform, segment: usize, h: &Ball) -> [Ball; 4] {
    let (zero, one) = (Rational::new(), Rational::from(1));
    let y = [spline.value(segment, &zero), spline.value(segment, &one)];
    let s = [&zero, &one].map(|k| &spline.derivative(segment, k) * h);
    let (sum, gap) = (&y[0] + &y[1], &y[1] - &y[0]);
    let (slopes, bend) = (&s[0] + &s[1], &s[1] - &s[0]);
    // f(±1) = y, f'(±1) = s.
    [
        sum.shift(-1) - bend.shift(-2),
        gap.shift(-1) + (gap.shift(-1) - slopes.shift(-1)).shift(-1),
        bend.shift(-2),
        (slopes.shift(-1) - gap.shift(-1)).shift(-1),
    ]
}

/// The derivative of such a cubic with respect to the angle.
fn per_radian(c: &[Ball; 4], h: &Ball) -> TaylorModel {
    let d: Vec<Ball> = (1..4)
        .map(|k| &(&c[k] * &Ball::integer(64, k as i64)) / h)
        .collect();
    TaylorModel::from_balls(&d)
}

/// The k-th of `parts` equal parts of a segment, on −1 … 1 again; its place is rounded to `bits`
/// bits.
fn part(whole: &TaylorModel, k: u32, parts: u32, bits: u32) -> TaylorModel {
    let part = Ball::rational(bits, &Rational::from((1, parts)));
    let centre = Rational::from((2 * k + 1, parts)) - 1u32;
    let x0 = Ball::rational(bits, &centre);
    whole
        .shifted(x0.mid(), part.magnitude())
        .widened(whole.motion(x0.rad()))
        .contracted(&part)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mag;

    /// Thirds and fifths, whose centres and widths are rounded to few bits.
    #[test]
    fn parts_of_a_segment_are_the_segment() {
        let coefficients = [2, -3, 5, 7].map(|n| Ball::integer(200, n));
        let whole = TaylorModel::from_balls(&coefficients);
        let exact = |x: &Rational| {
            let poly = [7, 5, -3, 2].map(Rational::from);
            poly.iter().fold(Rational::new(), |s, c| s * x + c)
        };
        for parts in [1, 2, 3, 5, 7] {
            for k in 0..parts {
                for bits in [12, 13, 150] {
                    let found = part(&whole, k, parts, bits);
                    for w in [-4, -1, 0, 1, 4] {
                        let w = Rational::from((w, 4));
                        let x = (Rational::from(2 * k + 1) + &w) / parts - 1u32;
                        let value = found.eval(&Ball::rational(200, &w));
                        assert!(value.contains(&exact(&x)), "{k} of {parts}, {bits} bits");
                        assert!(value.rad() < Mag::power_of_two(7 - i64::from(bits)));
                    }
                }
            }
        }
    }

    #[test]
    fn the_cubic_of_a_segment_is_the_spline() {
        let y: Vec<Ball> = [3, -1, 4, 1, -5]
            .iter()
            .map(|&v| Ball::integer(150, v))
            .collect();
        let step = Ball::rational(150, &Rational::from((7, 5)));
        let spline = periodic_uniform(&y, &step).unwrap();
        let h = step.shift(-1);
        for segment in 0..5 {
            let c = cubic(&spline, segment, &h);
            let (value, slope) = (TaylorModel::from_balls(&c), per_radian(&c, &h));
            for k in [(0, 1), (1, 3), (1, 2), (1, 1)] {
                let k = Rational::from(k);
                let w = Ball::rational(150, &(Rational::from(&k * 2) - 1u32));
                let (a, b) = (value.eval(&w), slope.eval(&w));
                assert!(a.overlaps(&spline.value(segment, &k)));
                assert!(b.overlaps(&spline.derivative(segment, &k)));
                assert!(a.rad() < Mag::power_of_two(-130) && b.rad() < Mag::power_of_two(-130));
            }
        }
    }
}
