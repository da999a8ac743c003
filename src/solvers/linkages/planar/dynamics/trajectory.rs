//! The motion over time.

use super::super::chain::{Spot, spot};
use super::super::model::Point;
use super::super::motion::Motion;
use super::super::pose::Pose;
use super::super::reactions::{JointForce, ReactionError, Wrenches, without_teeth};
use super::assembly::Assembly;
use super::flow::{Flow, Instant};
use super::{Dynamics, DynamicsError, Law};
use crate::initial_value::{Dop853, first_crossing};

/// How a motion is integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The error allowed in a step, relative to one radian or the size of the mechanism.
    pub tolerance: f64,
    /// The most steps.
    pub steps: usize,
    /// True for accelerations at the times that are visited, which are NaN else. They take as long
    /// as the rest.
    pub accelerations: bool,
}

impl Default for Settings {
    /// A tolerance of 1e-12, a million steps, and accelerations.
    fn default() -> Settings {
        Settings {
            tolerance: 1e-12,
            steps: 1_000_000,
            accelerations: true,
        }
    }
}

/// The mechanism at one time.
#[derive(Clone, Debug)]
pub struct Moment {
    /// Time in seconds.
    pub time: f64,
    pub(super) pose: Pose,
    /// Velocities, and accelerations if they are asked for.
    pub(super) motion: Motion,
}

/// The basis may grow to this before other coordinates are independent: after complete pivoting it
/// is about one.
const AMPLIFIED: f64 = 3.0;

/// A motion under way: the state is (u, ż). Of the unknowns u the independent ones z count; the
/// others say next to which position the loops are closed, and that is how the branch is kept.
struct Run<'a> {
    dynamics: &'a Dynamics,
    flow: Flow,
    /// The number of unknowns.
    unknowns: usize,
    /// True if they are computed at the times that are visited.
    accelerations: bool,
    /// Memory for z̈.
    work: Vec<f64>,
}

impl Run<'_> {
    /// `d(u, ż)/dt`.
    fn rate(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> Result<(), DynamicsError> {
        self.place(t, y)?;
        self.flow.set_bias(self.dynamics);
        let (first, second) = out.split_at_mut(self.unknowns);
        first.copy_from_slice(&self.flow.rates);
        self.flow.accelerations(self.dynamics, t, second)
    }

    /// Positions and rates at a state.
    fn place(&mut self, t: f64, y: &[f64]) -> Result<(), DynamicsError> {
        let (u, speeds) = y.split_at(self.unknowns);
        match self.flow.set(self.dynamics, u, speeds) {
            true => Ok(()),
            false => Err(DynamicsError::Singular { t }),
        }
    }

    /// Sets a moment to a state.
    fn moment(&mut self, t: f64, y: &[f64], moment: &mut Moment) -> Result<(), DynamicsError> {
        self.place(t, y)?;
        if self.accelerations {
            self.flow.set_bias(self.dynamics);
            self.flow.accelerations(self.dynamics, t, &mut self.work)?;
            self.flow
                .accelerated(self.dynamics, &self.work, &mut moment.motion);
        } else {
            self.flow.set_velocities(self.dynamics);
            moment.motion.copy(&self.flow.flow);
        }
        moment.pose.copy(&self.flow.pose);
        moment.time = t;
        Ok(())
    }

    /// After a step: chooses other independent coordinates where these determine the others badly;
    /// then `y` is the state in the new ones.
    fn settle(&mut self, t: f64, y: &mut [f64]) -> Result<bool, DynamicsError> {
        // The basis at hand is that of some place in the step.
        if self.flow.amplification() <= AMPLIFIED {
            return Ok(false);
        }
        self.place(t, y)?;
        if !self.flow.choose(self.dynamics) {
            return Err(DynamicsError::Singular { t });
        }
        self.flow.state(y);
        Ok(true)
    }

    fn law(&mut self, law: &Law, t: f64, y: &[f64]) -> Result<f64, DynamicsError> {
        self.place(t, y)?;
        self.flow.set_velocities(self.dynamics);
        Ok(law(&Instant {
            dynamics: self.dynamics,
            pose: &self.flow.pose,
            flow: &self.flow.flow,
            time: t,
        }))
    }
}

impl Dynamics {
    /// The motion from a start at t = 0: calls `visit` at each of the times, which ascend from zero
    /// or later, until it returns `false`. The method is DOP853 with its interpolant; `visit` sees
    /// positions whose loops are closed to rounding.
    ///
    /// # Errors
    /// [`DynamicsError`]: a singular position, a coordinate without inertia, a law without value, a
    /// used-up budget.
    pub fn motion(
        &self,
        start: &Assembly,
        times: &[f64],
        settings: Settings,
        visit: impl FnMut(&Moment) -> bool,
    ) -> Result<(), DynamicsError> {
        self.motion_until(start, times, settings, None, visit)
            .map(|_| ())
    }

    /// [`Dynamics::motion`] until a law changes its sign, if it does before the last time: the time
    /// at which it does, which is visited last.
    ///
    /// # Errors
    /// As [`Dynamics::motion`].
    pub fn motion_until(
        &self,
        start: &Assembly,
        times: &[f64],
        settings: Settings,
        until: Option<&Law>,
        mut visit: impl FnMut(&Moment) -> bool,
    ) -> Result<Option<f64>, DynamicsError> {
        let singular = DynamicsError::Singular { t: 0.0 };
        let flow = Flow::new(self, &start.u).ok_or(singular)?;
        let (unknowns, freedoms) = (start.u.len(), flow.independent.len());
        let mut y = start.u.clone();
        y.extend(flow.independent.iter().map(|c| start.rates[*c]));
        let mut moment = Moment {
            time: 0.0,
            pose: flow.pose.clone(),
            motion: Motion::default(),
        };
        let mut run = Run {
            dynamics: self,
            flow,
            unknowns,
            accelerations: settings.accelerations,
            work: vec![0.0; freedoms],
        };
        let mut solution = Dop853::new(0.0, &y, settings.tolerance);
        let mut side = match until {
            Some(law) => run.law(law, 0.0, &y)?,
            None => 0.0,
        };
        let Some(&end) = times.last() else {
            return Ok(None);
        };
        let mut times = times.iter().copied().peekable();
        let mut at = y.clone();
        while let Some(t) = times.next_if(|t| *t <= 0.0) {
            run.moment(t, &y, &mut moment)?;
            if !visit(&moment) {
                return Ok(None);
            }
        }
        let mut steps = 0;
        while times.peek().is_some() {
            if steps == settings.steps {
                let t = solution.t();
                return Err(DynamicsError::Budget { t, steps });
            }
            steps += 1;
            solution.step(end, &mut |t, y: &[f64], out: &mut [f64]| {
                run.rate(t, y, out)
            })?;
            let mut stop = None;
            if let Some(law) = until {
                stop = crossing(&mut run, &mut solution, law, &mut side, &mut at)?;
            }
            let reached = stop.unwrap_or(solution.t());
            while let Some(t) = times.next_if(|t| *t <= reached) {
                solution.between(
                    t,
                    &mut |t, y: &[f64], out: &mut [f64]| run.rate(t, y, out),
                    &mut at,
                )?;
                run.moment(t, &at, &mut moment)?;
                if !visit(&moment) {
                    return Ok(None);
                }
            }
            if let Some(t) = stop {
                solution.between(
                    t,
                    &mut |t, y: &[f64], out: &mut [f64]| run.rate(t, y, out),
                    &mut at,
                )?;
                run.moment(t, &at, &mut moment)?;
                visit(&moment);
                return Ok(Some(t));
            }
            y.copy_from_slice(solution.y());
            if run.settle(solution.t(), &mut y)? {
                solution.set(&y);
            }
        }
        Ok(None)
    }

    /// A body's angle in radians, not reduced by whole turns, with its first and second derivative
    /// by time.
    pub fn angle(&self, moment: &Moment, body: usize) -> [f64; 3] {
        let [first, second] = moment.motion.bodies[body].turn;
        [moment.pose.angle(&self.chain, body), first, second]
    }

    /// The displacement of a slide or slot in metres and its rate; NaN for other joints.
    pub fn displacement(&self, moment: &Moment, joint: usize) -> [f64; 2] {
        self.displaced(&moment.pose, &moment.motion, joint)
    }

    /// A point's place, velocity and acceleration in metres and seconds.
    pub fn point(&self, moment: &Moment, point: &Point) -> [[f64; 2]; 3] {
        let metres = self.chain.metres;
        let jet = moment.motion.spot(&moment.pose, spot(point, metres));
        jet.map(|z| [z.re * metres, z.im * metres])
    }

    /// The forces in the joints, by the laws of Newton and Euler for every body.
    ///
    /// # Errors
    /// [`ReactionError`].
    pub fn reactions(&self, moment: &Moment) -> Result<Vec<JointForce>, ReactionError> {
        let joints = &self.description.joints;
        without_teeth(joints)?;
        let Moment { time, pose, motion } = moment;
        let mut all = Wrenches::none(&self.chain, pose);
        for body in &self.rigid {
            let Spot { body: on, at } = body.centre;
            let [_, _, a] = motion.spot(pose, body.centre);
            let due = (self.gravity - a * self.chain.metres) * body.kg;
            all.push(on, due, at);
            all.turn(on, -body.inertia * motion.bodies[on].turn[1]);
        }
        Instant {
            dynamics: self,
            pose,
            flow: motion,
            time: *time,
        }
        .act(&mut all);
        let flow = Flow::new(self, &pose.u).ok_or(ReactionError::Singular)?;
        let sizes = flow.closing(&all.known_work());
        let found = all.borne(joints, &sizes);
        let finite = |f: &JointForce| f.force_n.iter().all(|x| x.is_finite());
        match found.iter().all(finite) {
            true => Ok(found),
            false => Err(ReactionError::Singular),
        }
    }

    /// Kinetic and potential energy in J: the latter of weights and springs.
    pub fn energy(&self, moment: &Moment) -> [f64; 2] {
        self.energies(&moment.pose, &moment.motion)
    }

    /// The largest distance between the sides of a joint in metres (gears and racks: radians or
    /// metres).
    pub fn gap(&self, moment: &Moment) -> f64 {
        let mut rows = Vec::new();
        let chain = &self.chain;
        moment.pose.residual(chain, &chain.closures, &mut rows);
        rows.iter().fold(0.0, |m: f64, x| m.max(x.abs())) * chain.metres
    }
}

/// Where within the last step a law changes its sign.
fn crossing(
    run: &mut Run,
    solution: &mut Dop853,
    law: &Law,
    side: &mut f64,
    at: &mut [f64],
) -> Result<Option<f64>, DynamicsError> {
    let step = [solution.t_before(), solution.t()];
    let found = first_crossing(step, |t, is_forth| {
        solution.between(
            t,
            &mut |t, y: &[f64], out: &mut [f64]| run.rate(t, y, out),
            at,
        )?;
        let here = run.law(law, t, at)?;
        let crossed = *side * here < 0.0 || (*side != 0.0 && here == 0.0);
        if is_forth && !crossed && here != 0.0 {
            *side = here;
        }
        Ok::<_, DynamicsError>(crossed.then_some(()))
    })?;
    Ok(found.map(|(t, ())| t))
}
