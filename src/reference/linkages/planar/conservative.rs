//! Motion from rest under conservative forces, enclosed.
//!
//! With one degree of freedom, `½ I(b) b'² = W(b)` for the work `W = Q (b − b0) − V(b) + V(b0)` of
//! a constant force on the drive, springs and weights, so that the time is an integral,
//! `t = ∫ √(I/2W) db`, and needs no stepping in time.
//!
//! 1. Panels: Gauss and Legendre's rule on `c ± h`, whose error is bounded by a bound M of the
//!    integrand on an ellipse with ρ = 4. A contraction on a wider disc of complex drives proves
//!    one position, analytic in the drive, for each; Taylor coefficients about c and Cauchy's
//!    estimate for the rest bound I and W on the ellipse away from zero, which makes the root
//!    analytic and bounds it. They also prove that the mechanism does not stop on the way.
//! 2. The start from rest: with `b = b0 + x²` the integrand is `2 √(I x²/2W)`, analytic at x = 0
//!    where `W/(b − b0)` is not zero.
//! 3. Neighbouring panels lie on one branch: the enclosed position at their common end lies in both
//!    polydiscs.
//! 4. t → b by an interval Newton step, `b ∈ c − (t(c) − t)/t'(B)`.

use super::enclosure::{Linkage, Position};
use super::energy::Forces;
use super::panel::{Loaded, Panel, REACH, exact, power_of_four};
use super::reactions::Rates;
use crate::gauss_legendre::GaussLegendre;
use crate::{Ball, Mag, Undecided};
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

/// A motion, and how much was proved on the way.
#[derive(Clone, Debug)]
pub struct Course {
    /// The mechanism at rest.
    pub start: Position,
    /// Acceleration of the drive there.
    pub first_acceleration: Ball,
    /// The moments asked for.
    pub moments: Vec<Moment>,
    /// Panels of the drive's coordinate.
    pub panels: usize,
    /// A lower bound of `W/(b − b0)` over all of them.
    pub least_force: f64,
}

/// ρ of the ellipses.
const RHO: u32 = 4;
/// Attempts at a panel before the motion is given up: its length shrinks by 2^−20 and more.
const ATTEMPTS: usize = 50;
/// Panels taken before the motion is given up: a drive that goes to infinity within a finite time
/// reaches no later one.
const MOST_PANELS: usize = 10_000;

pub(super) struct Path<'a> {
    loaded: Loaded<'a>,
    forces: &'a Forces,
    rule: GaussLegendre,
    bits: u32,
    most_panels: usize,
}

impl Linkage {
    /// The motion from rest at `start`, drive increasing, at the given times in seconds, ascending
    /// and positive.
    ///
    /// # Errors
    /// [`Undecided`] if a proof fails: the force at the start is not certainly positive, the
    /// mechanism may stop, a change point or dead position is near the path, the precision is too
    /// low, the times do not ascend or are not reached within ten thousand panels.
    pub fn from_rest(
        &self,
        start: &Ball,
        guess: &[Float],
        forces: &Forces,
        times: &[Rational],
    ) -> Result<Course, Undecided> {
        if times.first().is_some_and(|t| *t <= 0) || times.windows(2).any(|t| t[0] >= t[1]) {
            return Err(self.undecided("the times are not positive and ascending"));
        }
        let resting = self.position(start, guess)?;
        Path::new(Loaded::new(self, forces, start, resting), forces)?.follow(times)
    }
}

impl<'a> Path<'a> {
    pub(super) fn new(loaded: Loaded<'a>, forces: &'a Forces) -> Result<Path<'a>, Undecided> {
        let bits = loaded.linkage.bits();
        Ok(Path {
            // 16^−N below 2^−bits.
            rule: GaussLegendre::new(bits as usize / 4 + 2, bits + 16)?,
            loaded,
            forces,
            bits,
            most_panels: MOST_PANELS,
        })
    }
}

impl Path<'_> {
    fn undecided(&self, reason: &str) -> Undecided {
        self.loaded.linkage.undecided(reason)
    }

    fn ball(&self, t: &Rational) -> Ball {
        Ball::rational(self.bits, t)
    }

    /// The time of the first panel, whose length is a square: `∫ 2 √(I x²/2W) dx`.
    fn starting(&self, panel: &Panel, width: &Float) -> Result<Ball, Undecided> {
        let half = exact(&width.clone().sqrt()).shift(-1);
        self.quadrature(&half, panel.most.shift(1), |off| {
            let square = (&half + off).square();
            let drive = &panel.from + &square;
            let slowness = self.loaded.slowness(&panel.branch, &drive, &square)?;
            Ok(slowness.shift(1))
        })
    }

    /// The integral over an interval of half-length `half` of a function of the distance from its
    /// middle, which on the ellipse about it is at most `most`.
    fn quadrature(
        &self,
        half: &Ball,
        most: Mag,
        f: impl Fn(Ball) -> Result<Ball, Undecided>,
    ) -> Result<Ball, Undecided> {
        let mut sum = Ball::integer(self.bits, 0);
        for (node, weight) in &self.rule.nodes {
            sum = sum + weight * f(half * node)?;
        }
        Ok(half * sum.widened(self.rule.error(most, RHO)))
    }

    /// `∫ √(I/2W) db` from the panel's left end to `to`, which lies in the panel or next to its
    /// ends.
    pub(super) fn integral(&self, panel: &Panel, to: &Ball) -> Result<Ball, Undecided> {
        let half = (to - &panel.from).shift(-1);
        let middle = &panel.from + &half;
        let centre = &panel.from + &exact(&panel.half);
        // The ellipse of the part lies where the bound holds.
        let ellipse = half.magnitude().mul(Mag::from_f64(REACH));
        if !((&middle - &centre).magnitude().add(ellipse) <= panel.reach) {
            return Err(self.undecided("the end of an integral lies outside its panel"));
        }
        let one = Ball::integer(self.bits, 1);
        self.quadrature(&half, panel.most, |off| {
            self.loaded.slowness(&panel.branch, &(&middle + off), &one)
        })
    }

    /// The longest first panel that is found and ends before the first time.
    fn start(&self, before: Option<&Rational>) -> Result<(Panel, Ball, Ball), Undecided> {
        for k in 0..ATTEMPTS {
            let width = power_of_four(-(k as i32), self.bits);
            let Some(panel) = self.loaded.first(&width) else {
                continue;
            };
            let time = self.starting(&panel, &width)?;
            if before.is_none_or(|t| (self.ball(t) - &time).is_positive()) {
                let end = &panel.from + &exact(&width);
                return Ok((panel, time, end));
            }
        }
        Err(self.undecided("the start from rest is not proved"))
    }

    /// The panel after one that ends at `from`.
    fn next(&self, panel: &Panel, from: &Ball, at: &Position) -> Result<Panel, Undecided> {
        let mut half = Float::with_val(64, &panel.half * 1.25f64);
        for _ in 0..ATTEMPTS {
            if let Some(next) = self.loaded.panel(from, at, &panel.branch, &half) {
                return Ok(next);
            }
            half *= 0.75;
        }
        Err(self.undecided("the path cannot be continued"))
    }

    fn follow(&self, times: &[Rational]) -> Result<Course, Undecided> {
        let (mut panel, mut time, mut from) = self.start(times.first())?;
        let resting = &self.loaded.resting;
        let series = self.loaded.linkage.series(resting, 2)?;
        let force = &self.loaded.fine.drive - &self.loaded.fine.potential_series(&series)[1];
        let mut course = Course {
            start: resting.clone(),
            first_acceleration: force / &self.loaded.fine.inertia_series(&series)[0],
            moments: Vec::new(),
            panels: 1,
            least_force: panel.least_force,
        };
        let mut due = times.iter().peekable();
        while due.peek().is_some() {
            if course.panels >= self.most_panels {
                return Err(self.undecided("the times are not reached within as many panels"));
            }
            let at = self.loaded.on(&panel.branch, &from)?;
            panel = self.next(&panel, &from, &at)?;
            let length = exact(&panel.half).shift(1);
            let end = &from + &length;
            let whole = self.integral(&panel, &end)?;
            let until = &time + &whole;
            while let Some(t) = due.next_if(|t| (&until - &self.ball(t)).is_positive()) {
                let left = self.ball(t) - &time;
                let guess = &from + &(&left / &whole * &length);
                let drive = self.invert(&panel, &left, guess.mid())?;
                course.moments.push(self.moment(&panel, t, drive)?);
            }
            course.panels += 1;
            course.least_force = course.least_force.min(panel.least_force);
            (from, time) = (end, until);
        }
        Ok(course)
    }

    /// The drive at the time `left` after the panel's left end.
    pub(super) fn invert(
        &self,
        panel: &Panel,
        left: &Ball,
        guess: &Float,
    ) -> Result<Ball, Undecided> {
        let one = Ball::integer(self.bits, 1);
        let tiny = Mag::power_of_two(-i64::from(self.bits));
        let slowness = |b: &Ball| self.loaded.slowness(&panel.branch, b, &one);
        let mut b = exact(guess);
        let mut last = Mag::INFINITY;
        loop {
            let miss = left - &self.integral(panel, &b)?;
            let step = &miss / &slowness(&b)?;
            let size = step.magnitude().max(tiny);
            if !(size < last.shift(-1)) {
                // B = b ± δ: the step over it has to stay in its interior.
                let newton = (&miss / &slowness(&b.widened(size.shift(1)))?).magnitude();
                return match newton < size.shift(1) {
                    true => Ok(b.widened(newton)),
                    false => Err(self.undecided("the drive at a time is not proved")),
                };
            }
            b = exact((&b + &step).mid());
            last = size;
        }
    }

    fn moment(&self, panel: &Panel, time: &Rational, drive: Ball) -> Result<Moment, Undecided> {
        let (linkage, load) = (self.loaded.linkage, &self.loaded.fine);
        let position = self.loaded.on(&panel.branch, &drive)?;
        let series = linkage.series(&position, 2)?;
        let inertia = load.inertia_series(&series);
        let energy = self.loaded.work(&drive, &position);
        let square = energy.shift(1) / &inertia[0];
        let force = &load.drive - &load.potential_series(&series)[1];
        let acceleration = (force - (&inertia[1] * &square).shift(-1)) / &inertia[0];
        let rates = series.in_time(&square.sqrt(), &acceleration);
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

#[cfg(test)]
mod tests {
    use super::super::tests::oscillator;
    use super::super::{Attachment, Body, Drive, Joint, Mechanism, Real};
    use super::*;
    use crate::class_iii::ExactAngle;

    const BITS: u32 = 192;

    fn exactly(x: f64) -> Ball {
        Ball::exact(BITS, x)
    }

    /// A linkage of one slide from rest at its origin.
    fn path<'a>(linkage: &'a Linkage, forces: &'a Forces) -> Path<'a> {
        let at = [0.0, 0.0].map(|x| Float::with_val(64, x));
        let start = Ball::integer(BITS, 0);
        let resting = linkage.position(&start, &at).expect("proved");
        Path::new(Loaded::new(linkage, forces, &start, resting), forces).expect("a rule")
    }

    /// The first panel up to a power of four and the panel after it.
    fn panels(path: &Path, width: i32, half: f64) -> [Panel; 2] {
        let width = power_of_four(width, BITS);
        let first = path.loaded.first(&width).expect("a panel");
        let from = exact(&width);
        let at = path.loaded.on(&first.branch, &from).expect("a position");
        let half = Float::with_val(64, half);
        let next = path.loaded.panel(&from, &at, &first.branch, &half);
        [first, next.expect("a panel")]
    }

    /// With two nodes a quadrature is off by far more than roundings, and its bound is that of the
    /// rule: for `2 √(I x²/2W)` over half the root of the width, for `√(I/2W)` over the
    /// half-length.
    #[test]
    fn times_of_panels_hold_the_error_of_the_rule() {
        let (linkage, forces) = oscillator();
        let mut path = path(&linkage, &forces);
        let [first, next] = panels(&path, -1, 1.0 / 16.0);
        path.rule = GaussLegendre::new(2, BITS).expect("a rule");
        // cos 2t = 1 − 8b/3.
        let to_quarter = exactly(8.0).sqrt().atan2(&exactly(1.0)).shift(-1);
        let rest = Ball::pi(BITS).shift(-2) - &to_quarter;
        let start = path
            .starting(&first, &power_of_four(-1, BITS))
            .expect("a time");
        let later = path.integral(&next, &exactly(0.375)).expect("a time");
        for (found, due, half, most) in [
            (start, to_quarter, 0.25, first.most.to_f64() * 2.0),
            (later, rest, 0.0625, next.most.to_f64()),
        ] {
            assert!(found.overlaps(&due));
            assert!((found.mid().clone() - due.mid()).abs() > 1e-9);
            let error = path.rule.error(Mag::from_f64(most), RHO).to_f64() * half;
            let wide = found.rad().to_f64();
            assert!(
                wide > 0.999 * error && wide < 1.001 * error,
                "{wide} {error}"
            );
        }
    }

    /// The end of an integral with a radius lies in the panel as a whole: `17/8 (h + w/2) + w/2` is
    /// at most 69/32 h.
    #[test]
    fn the_end_of_an_integral_is_in_the_panel_with_its_radius() {
        let (linkage, forces) = oscillator();
        let path = path(&linkage, &forces);
        let [_, next] = panels(&path, -1, 1.0 / 16.0);
        let to = |w: f64| exactly(0.375).widened(Mag::from_f64(w / 16.0));
        assert!(path.integral(&next, &to(0.0)).is_ok());
        assert!(path.integral(&next, &to(0.019)).is_ok());
        for w in [0.021, 0.025, 0.029] {
            let refused = path.integral(&next, &to(w)).unwrap_err();
            assert!(refused.reason.contains("outside its panel"), "{w}");
        }
    }

    /// A time that takes more panels than there may be is not reached.
    #[test]
    fn panels_are_counted() {
        let (linkage, forces) = oscillator();
        let mut path = path(&linkage, &forces);
        let times = [Rational::from((6, 5))];
        let taken = path.follow(&times).expect("a course").panels;
        path.most_panels = taken;
        assert_eq!(path.follow(&times).expect("a course").panels, taken);
        path.most_panels = taken - 1;
        let refused = path.follow(&times).unwrap_err();
        assert!(refused.reason.contains("not reached"), "{refused:?}");
    }

    /// A mass of 2 under the force 3 has `t'(b) = 1/√(3b)`. In balls that is at least
    /// `t'(b) (1 − D/(b − D))` over `b ± D`, so that a step of a time within R, with D twice
    /// `R/t'(b)`, stays inside for D up to b/3.
    #[test]
    fn a_newton_step_stays_inside_up_to_a_third() {
        let mut mass = Body::massless("mass");
        mass.mass = Rational::from(2);
        let origin = || [Rational::new(), Rational::new()];
        let slide = Joint::Slide {
            a: Attachment::ground(origin()),
            direction: [Rational::from(1), Rational::new()].map(Real::from),
            b: Attachment::body(0, origin()),
            turn: ExactAngle::Radians(Rational::new()),
        };
        let mechanism = Mechanism::new(vec![mass], vec![slide]).expect("a mechanism");
        let linkage = Linkage::new(&mechanism, &Drive::coordinate(1), BITS).expect("a drive");
        let forces = Forces {
            drive: Rational::from(3),
            springs: Vec::new(),
            gravity: origin(),
        };
        let path = path(&linkage, &forces);
        let [_, next] = panels(&path, 0, 0.75);
        let b = 1.75f64;
        let left = path.integral(&next, &exactly(b)).expect("a time");
        let slowness = (3.0 * b).sqrt().recip();
        let most = b / 3.0 / 2.0 * slowness;
        let within = |part: f64| {
            let left = left.widened(Mag::from_f64(part * most));
            path.invert(&next, &left, &Float::with_val(BITS, b))
        };
        for part in [0.3, 0.98] {
            let drive = within(part).expect("a drive");
            let across = part * b / 3.0;
            let due = part * most / (slowness * (1.0 - across / (b - across)));
            let wide = drive.rad().to_f64();
            assert!(wide > 0.999 * due && wide < 1.001 * due, "{wide} {due}");
        }
        for part in [1.02, 1.2, 1.5] {
            let refused = within(part).unwrap_err();
            assert!(refused.reason.contains("is not proved"), "{part}");
        }
    }
}
