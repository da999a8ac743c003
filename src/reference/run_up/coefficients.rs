//! The coefficient functions I_n(φ), dI_n/dφ and M_o(φ), panel by panel over a turn of the crank.

use super::linkage_panel::{Mechanism, Panel};
use crate::reference::class_iii::{Configuration, ExactAngle, Geometry, Linkage, Masses};
use crate::reference::cubic_spline::{PeriodicUniform, periodic_uniform};
use crate::reference::taylor_model::TaylorModel;
use crate::reference::{Ball, Undecided};
use rug::Rational;
use std::sync::{Arc, Mutex};

/// The exact functions of a class-III linkage on one branch, computed where they are asked for.
///
/// A turn is cut into equal panels, the first of which begins at the start angle.
pub struct LinkageCurve {
    bits: u32,
    panels: u32,
    offset: ExactAngle,
    mechanism: Mechanism,
    linkage: Linkage,
    masses: Masses,
    start: Configuration,
    chain: Mutex<Chain>,
}

/// What has been computed: centres and panels forward and backward from the start.
#[derive(Default)]
struct Chain {
    forward: Vec<Link>,
    backward: Vec<Link>,
    closed: Option<bool>,
}

struct Link {
    configuration: Configuration,
    panel: Option<Arc<Panel>>,
}

impl LinkageCurve {
    /// The linkage on the branch of `start`, a configuration at the crank angle `offset`; the turn
    /// is cut into `panels` panels. More panels cost more Taylor models of lower degree.
    pub fn new(
        geometry: &Geometry,
        masses: &Masses,
        offset: &ExactAngle,
        start: &Configuration,
        panels: u32,
        bits: u32,
    ) -> LinkageCurve {
        LinkageCurve {
            bits,
            // Half a panel must stay well below a radian.
            panels: panels.max(12),
            offset: offset.clone(),
            mechanism: Mechanism::new(geometry, masses, bits),
            linkage: Linkage::new(geometry, bits),
            masses: masses.clone(),
            start: start.clone(),
            chain: Mutex::default(),
        }
    }

    /// The working precision in bits.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    fn undecided(&self, reason: impl Into<String>) -> Undecided {
        Undecided {
            bits: self.bits,
            reason: reason.into(),
        }
    }

    /// `offset + π k/panels`.
    fn angle(&self, k: i64) -> Ball {
        let part = Rational::from((k, self.panels));
        self.offset.to_ball(self.bits) + Ball::pi(self.bits) * Ball::rational(self.bits, &part)
    }

    fn follow(&self, from: &Configuration, a: &Ball, b: &Ball) -> Result<Configuration, Undecided> {
        self.linkage
            .follow(from, a, b)
            .ok_or_else(|| self.undecided("the linkage cannot be followed over the turn"))
    }

    /// Whether the branch is back after one turn: the configuration there touches that of the
    /// start and no other of all assembly modes, which are disjoint.
    fn closes(&self, chain: &mut Chain) -> Result<bool, Undecided> {
        if let Some(known) = chain.closed {
            return Ok(known);
        }
        let n = self.panels as usize;
        self.extend(&mut chain.forward, n - 1, 1)?;
        let last = &chain.forward[n - 1].configuration;
        let end = self.follow(
            last,
            &self.angle(2 * n as i64 - 1),
            &self.angle(2 * n as i64),
        )?;
        let touches = |a: &Configuration, b: &Configuration| {
            let pairs = [
                (&a.c.re, &b.c.re),
                (&a.c.im, &b.c.im),
                (&a.d.re, &b.d.re),
                (&a.d.im, &b.d.im),
            ];
            pairs.iter().all(|(x, y)| x.overlaps(y))
        };
        let modes = self.linkage.modes(&self.offset.to_ball(self.bits))?;
        let own: Vec<bool> = modes
            .iter()
            .map(|m| touches(&m.configuration, &self.start))
            .collect();
        let there: Vec<bool> = modes
            .iter()
            .map(|m| touches(&m.configuration, &end))
            .collect();
        let one = |v: &[bool]| v.iter().filter(|&&x| x).count() == 1;
        let closed = one(&own) && own == there;
        chain.closed = Some(closed);
        Ok(closed)
    }

    /// Follows the centres of the panels 0, 1, … (or −1, −2, …) up to number `last`.
    fn extend(&self, chain: &mut Vec<Link>, last: usize, sign: i64) -> Result<(), Undecided> {
        for i in chain.len()..=last {
            let at = self.angle(sign * (2 * i as i64 + 1));
            let configuration = match chain.last() {
                Some(link) => {
                    let before = self.angle(sign * (2 * i as i64 - 1));
                    self.follow(&link.configuration, &before, &at)?
                }
                None => self.follow(&self.start, &self.angle(0), &at)?,
            };
            chain.push(Link {
                configuration,
                panel: None,
            });
        }
        Ok(())
    }

    fn panel(&self, index: i64) -> Result<Arc<Panel>, Undecided> {
        let mut guard = self.chain.lock().unwrap_or_else(|e| e.into_inner());
        let chain = &mut *guard;
        let n = i64::from(self.panels);
        let mut index = index;
        if !(-n..n).contains(&index) {
            if !self.closes(chain)? {
                return Err(self.undecided("the linkage is not back after one turn of the crank"));
            }
            index = index.rem_euclid(n);
        }
        let (list, i, sign) = if index >= 0 {
            (&mut chain.forward, index as usize, 1)
        } else {
            (&mut chain.backward, (-1 - index) as usize, -1)
        };
        self.extend(list, i, sign)?;
        if let Some(panel) = &list[i].panel {
            return Ok(panel.clone());
        }
        let h = Ball::pi(self.bits) / Ball::integer(self.bits, n);
        let panel = self
            .mechanism
            .panel(&self.angle(2 * index + 1), &list[i].configuration, &h)
            .ok_or_else(|| self.undecided("a panel of the linkage is too wide for its proof"))?;
        let panel = Arc::new(panel);
        list[i].panel = Some(panel.clone());
        Ok(panel)
    }

    /// I_n and M_o at the angles `offset + 2π j/nodes`, from the enclosed configurations there.
    ///
    /// # Errors
    /// [`Undecided`] when the linkage cannot be followed over the turn, or is not back after it.
    pub fn nodes(&self, nodes: u32) -> Result<(Vec<Ball>, Vec<Ball>), Undecided> {
        {
            let mut guard = self.chain.lock().unwrap_or_else(|e| e.into_inner());
            if !self.closes(&mut guard)? {
                return Err(self.undecided("the linkage is not back after one turn of the crank"));
            }
        }
        let angle = |j: u32| {
            let part = Rational::from((2 * j, nodes));
            self.offset.to_ball(self.bits) + Ball::pi(self.bits) * Ball::rational(self.bits, &part)
        };
        let mut here = self.start.clone();
        let (mut inertia, mut moment) = (Vec::new(), Vec::new());
        for j in 0..nodes {
            if j > 0 {
                here = self.follow(&here, &angle(j - 1), &angle(j))?;
            }
            let r = self
                .linkage
                .reduce(&self.linkage.kinematics(&here)?, &self.masses);
            inertia.push(r.inertia);
            moment.push(r.moment);
        }
        Ok((inertia, moment))
    }
}

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

    /// The exact functions of a linkage.
    pub fn exact(curve: &Arc<LinkageCurve>) -> Coefficients {
        Coefficients {
            bits: curve.bits,
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
        let h = half_step(curve.bits, nodes);
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
            bits: curve.bits,
            panels: nodes,
            turns: 1,
            offset: curve.offset.clone(),
        })
    }

    /// What Zinchenko (2008) recommends: exact I_n and M_o, and in the place of dI_n/dφ the
    /// derivative of the periodic spline through I_n at `nodes` equal steps.
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
        let h = half_step(curve.bits, nodes);
        let part = Ball::rational(curve.bits, &Rational::from((1, share)));
        let slopes = (0..curve.panels).map(|k| {
            let whole = per_radian(&cubic(&inertia, (k / share) as usize, &h), &h);
            // Centre of the sub-panel on the segment's −1 … 1.
            let centre = Rational::from((2 * (k % share) + 1, share)) - 1u32;
            let x0 = Ball::rational(curve.bits, &centre);
            let exact = x0.mid().clone();
            let slack = whole.motion(x0.rad());
            whole
                .shifted(&exact, part.magnitude())
                .widened(slack)
                .contracted(&part)
        });
        Ok(Coefficients {
            bits: curve.bits,
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
            (a, o) => {
                let gap = a.to_ball(self.bits) - o.to_ball(self.bits);
                gap * b(&(panels / 2)) / Ball::pi(self.bits)
            }
        }
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
    let h = half_step(curve.bits, nodes).shift(1);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Mag;

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
