//! Motion from rest under conservative forces, enclosed.
//!
//! With one degree of freedom, `½ I(b) b'² = W(b)` for the work `W = Q (b − b0) − V(b) + V(b0)` of a constant force on
//! the drive, springs and weights, so that the time is an integral, `t = ∫ √(I/2W) db`, and needs no stepping in time.
//!
//! 1. Panels: Gauss and Legendre's rule on `c ± h`, whose error is bounded by a bound M of the integrand on an ellipse
//!    with ρ = 4. [`disc`](super::disc) proves one analytic position for every complex drive within `69h/32` of c, which
//!    holds that ellipse; enclosures of I and W there that exclude zero make the root analytic and bound it. They also prove
//!    that the mechanism does not stop on the way.
//! 2. The start from rest: with `b = b0 + x²` the integrand is `2 √(I x²/2W)`, analytic at x = 0 where
//!    `W/(b − b0) = Q − ∫_0^1 V'(b0 + s(b − b0)) ds` is not zero.
//! 3. Neighbouring panels lie on one branch: the enclosed position at their common end lies in both polydiscs.
//! 4. t → b by an interval Newton step, `b ∈ c − (t(c) − t)/t'(B)`.

use super::disc::Disc;
use super::energy::{Forces, Load};
use super::enclosure::{Linkage, Position};
use super::reactions::Rates;
use crate::gauss_legendre::GaussLegendre;
use crate::{Ball, Mag, Undecided};
use rug::float::Round;
use rug::{Float, Rational};

/// The mechanism at one moment.
#[derive(Clone, Debug)]
pub struct Moment {
    /// The time.
    pub time: Rational,
    /// The drive's coordinate.
    pub drive: Ball,
    /// Coordinates.
    pub position: Position,
    /// Their rates.
    pub rates: Rates,
    /// Multipliers of loops, relations, drive; the drive's contains zero.
    pub multipliers: Vec<Ball>,
    /// `½ I b'²`, the work done since the start.
    pub energy: Ball,
}

/// How much was proved on the way.
#[derive(Clone, Debug)]
pub struct Course {
    /// The moments asked for.
    pub moments: Vec<Moment>,
    /// Panels of the drive's coordinate.
    pub panels: usize,
    /// A lower bound of `W/(b − b0)` over all of them, the start's among them.
    pub least_force: f64,
}

/// ρ of the ellipses.
const RHO: u32 = 4;
/// Half-axis of an ellipse over h, `(ρ + 1/ρ)/2`.
const REACH: f64 = 2.125;
/// Radius of a disc over h: the ellipse with room for roundings.
const RADIUS: f64 = 2.15625;
/// Radius of the disc of positions over that of the disc where I and W are bounded.
const WIDER: f64 = 1.625;
/// Taylor coefficients that bound I and W.
const ORDER: usize = 20;
/// Halvings of a panel before the motion is given up.
const DEEPEST: u32 = 40;

/// Part of the path with a proved disc and a bound on the integrand.
struct Panel {
    disc: Disc,
    /// Left end and the position there.
    from: Ball,
    at: Position,
    half: Float,
    /// Where the bound holds, around the panel's middle.
    radius: Mag,
    /// Bound of `√(I/2W)` on the disc.
    most: Mag,
    least_force: f64,
}

/// Taylor coefficients of I and V about the centre of a disc, and bounds on the disc.
struct Expansion {
    radius: Mag,
    inertia: Vec<Ball>,
    potential: Vec<Ball>,
    most: [Mag; 2],
}

impl Expansion {
    /// A bound on `|Σ_{n≥from} a_n s^{n−down}|` for `|s| ≤ reach`: coefficients as far as they are known, then Cauchy's
    /// `|a_n| ≤ M/R^n`.
    fn spread(&self, which: usize, from: usize, down: usize, reach: Mag) -> Mag {
        let series = [&self.inertia, &self.potential][which];
        let mut power = Mag::from_f64(1.0);
        let mut sum = Mag::ZERO;
        for (n, a) in series.iter().enumerate().skip(down) {
            if n >= from {
                sum = sum.add(a.magnitude().mul(power));
            }
            power = power.mul(reach);
        }
        // M/R^n reach^(n − down) from the first unknown n on, a geometric series.
        let below = Mag::below(&self.radius.to_float());
        let ratio = reach.div(below);
        let mut first = self.most[which];
        for n in 0..series.len() {
            first = first.mul(if n < down { Mag::from_f64(1.0).div(below) } else { ratio });
        }
        sum.add(first.div(Mag::from_f64(1.0).sub_below(ratio)))
    }

    /// Bounds on I: upper and lower, for `|s| ≤ reach`.
    fn inertia(&self, reach: Mag) -> (Mag, Mag) {
        let spread = self.spread(0, 1, 0, reach);
        let first = &self.inertia[0];
        (first.magnitude().add(spread), first.mignitude().sub_below(spread))
    }
}

struct Path<'a> {
    linkage: &'a Linkage,
    /// The same with 64 bits.
    low: Linkage,
    forces: &'a Forces,
    fine: Load,
    coarse: Load,
    rule: GaussLegendre,
    start: Ball,
    resting: Position,
    potential: Ball,
}

impl Linkage {
    /// The motion from rest at `start`, drive increasing, at the given times in seconds, ascending and positive.
    ///
    /// # Errors
    /// [`Undecided`] if a proof fails: the force at the start is not certainly positive, the mechanism may stop, a change
    /// point or dead position is near the path, the precision is too low.
    pub fn from_rest(
        &self,
        start: &Ball,
        guess: &[Float],
        forces: &Forces,
        times: &[Rational],
    ) -> Result<Course, Undecided> {
        let resting = self.position(start, guess)?;
        let path = Path {
            linkage: self,
            forces,
            fine: Load::new(&self.mechanism, forces, self.bits()),
            coarse: Load::new(&self.mechanism, forces, 64),
            low: Linkage {
                fine: self.coarse.clone(),
                ..self.clone()
            },
            // 16^−N below 2^−bits.
            rule: GaussLegendre::new(self.bits() as usize / 4 + 2, self.bits() + 16)?,
            start: start.clone(),
            potential: self.potential(&resting, forces),
            resting,
        };
        path.follow(times)
    }
}

/// A lower bound in `f64` of a lower bound.
fn below(x: Mag) -> f64 {
    x.to_float().to_f64_round(Round::Down)
}

fn exact(x: &Float) -> Ball {
    Ball::new(x.clone(), Mag::ZERO)
}

impl Path<'_> {
    fn undecided(&self, reason: &str) -> Undecided {
        self.linkage.undecided(reason)
    }

    /// W at a position.
    fn work(&self, drive: &Ball, position: &Position) -> Ball {
        let pose = self.linkage.fine.pose(position.x.clone());
        &self.fine.drive * &(drive - &self.start) - self.fine.potential(&pose) + &self.potential
    }

    /// I at a position.
    fn inertia(&self, position: &Position) -> Result<Ball, Undecided> {
        let pose = self.linkage.fine.pose(position.x.clone());
        Ok(self.fine.inertia(&pose, &self.linkage.rates(position)?))
    }

    /// What is known of I and V about the centre of a disc.
    fn expand(&self, disc: &Disc, middle: &Position, radius: Mag) -> Option<Expansion> {
        let at = Position {
            x: middle.x.iter().map(|x| x.with_prec(64)).collect(),
        };
        let series = self.low.series(&at, ORDER + 1).ok()?;
        Some(Expansion {
            radius,
            inertia: self.coarse.inertia_series(&series),
            potential: self.coarse.potential_series(&series),
            most: [
                self.coarse.inertia(&disc.pose, &disc.rates).magnitude(),
                self.coarse.potential(&disc.pose).magnitude(),
            ],
        })
    }

    /// The position at a drive of a disc, on its branch.
    fn on(&self, disc: &Disc, centre: &Ball, drive: &Ball) -> Result<Position, Undecided> {
        let by = Float::with_val(64, drive.mid() - centre.mid()).to_f64();
        let position = self.linkage.position(drive, &disc.guess(by))?;
        if disc.owns(drive, &position) {
            Ok(position)
        } else {
            Err(self.undecided("a position is not shown to be on the branch"))
        }
    }

    /// The first panel, in `x = √(b − b0)` from 0 to the root of `width`, a power of four: its time and end.
    fn first(&self, width: &Float) -> Option<(Panel, Ball)> {
        // |x| ≤ (1 + 17/8) √width/2 on the ellipse.
        let reach = Mag::above(width).mul(Mag::from_f64(1.5625 * 1.5625));
        let radius = reach.mul(Mag::from_f64(WIDER));
        let disc = self.linkage.disc(&self.start, &self.resting, radius)?;
        if !disc.owns(&self.start, &self.resting) {
            return None;
        }
        let known = self.expand(&disc, &self.resting, radius)?;
        let (inertia, positive) = known.inertia(reach);
        // W/(b − b0) = Q − V_1 − V_2 (b − b0) − …
        let force = &self.coarse.drive - &known.potential[1];
        let least = force.mignitude().sub_below(known.spread(1, 2, 1, reach));
        if positive.is_zero() || least.is_zero() || !force.is_positive() {
            return None;
        }
        let most = inertia.div(least.shift(1)).sqrt();
        let root = exact(&width.clone().sqrt());
        let half = root.shift(-1);
        let mut sum = Ball::integer(self.linkage.bits(), 0);
        for (node, weight) in &self.rule.nodes {
            let x = &half + &(&half * node);
            let square = x.square();
            let drive = &self.start + &square;
            let position = self.on(&disc, &self.start, &drive).ok()?;
            let ratio = self.inertia(&position).ok()? * &square
                / self.work(&drive, &position).shift(1);
            sum = sum + (weight * &ratio.sqrt()).shift(1);
        }
        let time = &half * &sum.widened(self.rule.error(most.shift(1), RHO));
        let end = &self.start + &exact(width);
        let at = self.on(&disc, &self.start, &end).ok()?;
        let panel = Panel {
            disc,
            from: end,
            at,
            half: width.clone() >> 1,
            radius: reach,
            most,
            least_force: below(least),
        };
        Some((panel, time))
    }

    /// The panel of half-length `half` from a drive and a position; none if a proof fails.
    fn panel(&self, from: &Ball, at: &Position, guess: &[Float], half: &Float) -> Option<Panel> {
        let centre = from + &exact(half);
        let middle = self.linkage.position(&centre, guess).ok()?;
        let reach = Mag::above(half).mul(Mag::from_f64(RADIUS));
        let radius = reach.mul(Mag::from_f64(WIDER));
        let disc = self.linkage.disc(&centre, &middle, radius)?;
        if !disc.owns(from, at) || !disc.owns(&centre, &middle) {
            return None;
        }
        let known = self.expand(&disc, &middle, radius)?;
        let (inertia, positive) = known.inertia(reach);
        // W(c) + (Q − V_1) (b − c) − V_2 (b − c)² − …
        let work = self.work(&centre, &middle).with_prec(64);
        let force = &self.coarse.drive - &known.potential[1];
        let spread = force.magnitude().mul(reach).add(known.spread(1, 2, 0, reach));
        let least = work.mignitude().sub_below(spread);
        if positive.is_zero() || least.is_zero() || !work.is_positive() {
            return None;
        }
        let far = (&centre - &self.start).magnitude().add(Mag::above(half));
        Some(Panel {
            most: inertia.div(least.shift(1)).sqrt(),
            least_force: (below(least) / far.to_f64()).next_down(),
            disc,
            from: from.clone(),
            at: at.clone(),
            half: half.clone(),
            radius: reach,
        })
    }

    /// `∫ √(I/2W) db` from the panel's left end to `to`, which lies in the panel or next to its ends.
    fn integral(&self, panel: &Panel, to: &Ball) -> Result<Ball, Undecided> {
        let half = (to - &panel.from).shift(-1);
        let middle = &panel.from + &half;
        let centre = &panel.from + &exact(&panel.half);
        // The ellipse of the part lies in the panel's disc.
        let reach = half.magnitude().mul(Mag::from_f64(REACH));
        if !((&middle - &centre).magnitude().add(reach) <= panel.radius) {
            return Err(self.undecided("the end of an integral lies outside its panel"));
        }
        let mut sum = Ball::integer(self.linkage.bits(), 0);
        for (node, weight) in &self.rule.nodes {
            let drive = &middle + &(&half * node);
            sum = sum + weight * &self.slowness(panel, &centre, &drive)?;
        }
        Ok(&half * &sum.widened(self.rule.error(panel.most, RHO)))
    }

    /// `√(I/2W)` at a drive in a panel.
    fn slowness(&self, panel: &Panel, centre: &Ball, drive: &Ball) -> Result<Ball, Undecided> {
        let position = self.on(&panel.disc, centre, drive)?;
        let work = self.work(drive, &position);
        Ok((self.inertia(&position)? / work.shift(1)).sqrt())
    }

    fn follow(&self, times: &[Rational]) -> Result<Course, Undecided> {
        let bits = self.linkage.bits();
        let ball = |t: &Rational| Ball::rational(bits, t);
        let earliest = times.first().map(ball);
        let mut width = Float::with_val(bits, 1);
        let mut tries = 0;
        let (mut panel, mut time) = loop {
            let early = |t: &Ball| earliest.as_ref().is_some_and(|e| (e - t).is_positive());
            match self.first(&width) {
                Some((panel, time)) if early(&time) => break (panel, time),
                _ if tries == DEEPEST => {
                    let reason = "the start from rest is not proved";
                    return Err(self.undecided(reason));
                }
                _ => width >>= 2,
            }
            tries += 1;
        };
        let mut course = Course {
            moments: Vec::new(),
            panels: 1,
            least_force: panel.least_force,
        };
        let (mut from, mut at) = (panel.from.clone(), panel.at.clone());
        let mut due = times.iter().peekable();
        while due.peek().is_some() {
            let mut half = Float::with_val(64, &panel.half * 1.25f64);
            let mut tries = 0;
            panel = loop {
                let by = Float::with_val(64, from.mid() - panel.disc.drive.mid()).to_f64();
                let guess = panel.disc.guess(by + half.to_f64());
                if let Some(next) = self.panel(&from, &at, &guess, &half) {
                    break next;
                }
                tries += 1;
                if tries == DEEPEST {
                    return Err(self.undecided("the path cannot be continued"));
                }
                half *= 0.75;
            };
            let centre = &from + &exact(&panel.half);
            let end = &from + &exact(&panel.half).shift(1);
            let whole = self.integral(&panel, &end)?;
            let until = &time + &whole;
            while let Some(t) = due.next_if(|t| (&until - &ball(t)).is_positive()) {
                let ratio = (ball(t) - &time) / &whole;
                let first = &from + &(ratio * exact(&panel.half).shift(1));
                let drive = self.invert(&panel, &centre, &time, &ball(t), first.mid())?;
                course.moments.push(self.moment(&panel, &centre, t, drive)?);
            }
            course.panels += 1;
            course.least_force = course.least_force.min(panel.least_force);
            at = self.on(&panel.disc, &centre, &end)?;
            (from, time) = (end, until);
        }
        Ok(course)
    }

    /// The drive at time t, in a panel that begins at `since`.
    fn invert(
        &self,
        panel: &Panel,
        centre: &Ball,
        since: &Ball,
        t: &Ball,
        guess: &Float,
    ) -> Result<Ball, Undecided> {
        let left = t - since;
        let mut b = guess.clone();
        let tiny = Mag::power_of_two(-i64::from(self.linkage.bits()));
        let mut last = Mag::INFINITY;
        loop {
            let miss = &left - &self.integral(panel, &exact(&b))?;
            let step = &miss / &self.slowness(panel, centre, &exact(&b))?;
            let size = step.magnitude().max(tiny);
            if !(size < last.shift(-1)) {
                // B = b ± δ: the step over it has to stay in its interior.
                let wide = exact(&b).widened(size.shift(1));
                let newton = &miss / &self.slowness(panel, centre, &wide)?;
                return match newton.magnitude() < size.shift(1) {
                    true => Ok(exact(&b).widened(newton.magnitude())),
                    false => Err(self.undecided("the drive at a time is not proved")),
                };
            }
            b += step.mid();
            last = size;
        }
    }

    fn moment(
        &self,
        panel: &Panel,
        centre: &Ball,
        time: &Rational,
        drive: Ball,
    ) -> Result<Moment, Undecided> {
        let linkage = self.linkage;
        let position = self.on(&panel.disc, centre, &drive)?;
        let series = linkage.series(&position, 2)?;
        let inertia = self.fine.inertia_series(&series);
        let energy = self.work(&drive, &position);
        let square = energy.shift(1) / &inertia[0];
        let force = &self.fine.drive - &self.fine.potential_series(&series)[1];
        let acceleration = (force - (&inertia[1] * &square).shift(-1)) / &inertia[0];
        let rates = linkage.in_time(&position, &square.sqrt(), &acceleration)?;
        Ok(Moment {
            time: time.clone(),
            multipliers: linkage.multipliers(&position, &rates, self.forces)?,
            drive,
            position,
            rates,
            energy,
        })
    }
}
