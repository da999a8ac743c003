//! The steady cycle: a motion that repeats with every turn of the crank, found by shooting.
//!
//! The map P takes the speed at the section `φ = φ_0` to the speed one turn later. Newton's method
//! on `P(ψ) − ψ` needs `P'`, which the motion itself delivers: with `f = dψ/dt` and the crank angle
//! as the independent variable `dψ/dφ = f/ψ`, so
//!
//! ```text
//! P'(ψ_0) = exp ∮ ∂(f/ψ)/∂ψ dφ = (ψ_0/ψ_1) exp ∫ ∂f/∂ψ dt
//! ```
//!
//! At the cycle it is the multiplier: how much of a disturbance of the speed is left after a turn.

use super::crossing::{Limits, Pause};
use super::equation::Equation;
use super::integrate::{Counts, Integrator, Settings, Stuck};
use super::motion::RunError;
use super::runner::neighbours;
use super::stepper::{DAMPING, PHI, PSI, WORK};
use std::f64::consts::TAU;

/// A steady cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// Speed at the section, rad/s.
    pub psi: f64,
    /// Duration of a turn, s.
    pub period: f64,
    /// 2π over the period, rad/s.
    pub mean: f64,
    /// Least speed and the crank angle there, rad/s and rad.
    pub least: (f64, f64),
    /// Largest speed and the crank angle there, rad/s and rad.
    pub most: (f64, f64),
    /// δ = (ψ_max − ψ_min)/ψ_mean.
    pub fluctuation: f64,
    /// Holds what is left of a disturbance after one turn.
    pub multiplier: f64,
    /// Work of motor, weights and resistance in a turn, J.
    pub work: [f64; 3],
    /// Kinetic energy at the section, J.
    pub kinetic_energy: f64,
    /// `|P(ψ) − ψ|` of the last turn, rad/s.
    pub mismatch: f64,
    /// Newton steps.
    pub iterations: u32,
    /// Holds what all turns together cost.
    pub counts: Counts,
}

/// Why there is no cycle.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CycleError {
    /// A turn could not be computed.
    #[error(transparent)]
    Run(#[from] RunError),
    /// From that speed the crank does not get round.
    #[error(
        "the crank comes to rest at {phi} rad, {t} s after passing the section at {psi} rad/s: no steady cycle from there"
    )]
    Stalled {
        /// Crank angle where it rests, rad.
        phi: f64,
        /// Time since the section, s.
        t: f64,
        /// Speed at the section, rad/s.
        psi: f64,
    },
    /// A turn takes longer than allowed.
    #[error("a turn takes more than {limit} s")]
    Slow {
        /// The limit, s.
        limit: f64,
    },
    /// The speed to begin with is zero or not finite.
    #[error("the speed to begin with, {psi} rad/s, must be a finite number other than zero")]
    NoSpeed {
        /// The speed.
        psi: f64,
    },
    /// Newton's method did not settle.
    #[error(
        "no steady cycle found in {iterations} iterations: the speed at the section still changes by {change} rad/s in a turn"
    )]
    NotFound {
        /// Iterations.
        iterations: u32,
        /// Change of the speed in the last turn, rad/s.
        change: f64,
    },
}

/// Newton steps at most. From a speed of the motor's working range three are usual; a cycle that
/// needs more than thirty does not exist or cannot hold itself.
const MOST_ITERATIONS: u32 = 30;

/// A turn takes at most this many times as long as at the speed it began with.
const SLOWEST: f64 = 1000.0;

/// One turn from a section.
struct Lap {
    psi: f64,
    period: f64,
    slope: f64,
    least: (f64, f64),
    most: (f64, f64),
    work: [f64; 3],
    counts: Counts,
}

fn lap(
    equation: &Equation,
    settings: Settings,
    phi: f64,
    psi: f64,
    extrema: bool,
) -> Result<Lap, CycleError> {
    let sign = psi.signum();
    let limit = SLOWEST * TAU / psi.abs();
    let mut i = Integrator::new(*equation, settings, 0.0, phi, psi, sign);
    let goal = phi + sign * TAU;
    let mut angles = equation.model().knots().to_vec();
    angles.extend_from_slice(equation.model().dead_positions());
    let kinks = equation.drive().kinks();
    let mut lap = Lap {
        psi,
        period: 0.0,
        slope: 0.0,
        least: (psi, phi),
        most: (psi, phi),
        work: [0.0; 3],
        counts: Counts::default(),
    };
    loop {
        let (mut low, mut high) = neighbours(&angles, i.y[PHI]);
        (low, high) = (low.max(phi.min(goal)), high.min(phi.max(goal)));
        let speed = i.y[PSI];
        let below = kinks.iter().copied().filter(|k| *k < speed);
        let above = kinks.iter().copied().filter(|k| *k > speed);
        let slowest = below.fold(f64::NEG_INFINITY, f64::max);
        let fastest = above.fold(f64::INFINITY, f64::min);
        let limits = Limits {
            end: limit,
            angles: (low, high),
            speeds: match sign > 0.0 {
                true => (slowest.max(0.0), fastest),
                false => (slowest, fastest.min(0.0)),
            },
            extrema,
        };
        let pause = i
            .advance(&limits, &mut |_, _, _| ())
            .map_err(|s: Stuck| i.error(s))?;
        let here = (i.y[PSI], i.y[PHI]);
        if here.0 < lap.least.0 {
            lap.least = here;
        }
        if here.0 > lap.most.0 {
            lap.most = here;
        }
        match pause {
            Pause::End => return Err(CycleError::Slow { limit }),
            Pause::Speed(0.0) => {
                let (phi, t) = (i.y[PHI], i.t);
                return Err(CycleError::Stalled { phi, t, psi });
            }
            Pause::Angle(at) if at == goal => break,
            Pause::Angle(_) | Pause::Speed(_) | Pause::Extremum => {}
        }
    }
    lap.psi = i.y[PSI];
    lap.period = i.t;
    lap.slope = psi / lap.psi * i.y[DAMPING].exp();
    lap.work = WORK.map(|k| i.y[k]);
    lap.counts = i.counts;
    Ok(lap)
}

/// The steady cycle through the section at the crank angle `phi` (rad), sought from the speed
/// `guess` (rad/s) on; the sign of `guess` is the direction of motion.
///
/// # Errors
/// [`CycleError`]: the crank stalls, Newton's method does not settle, a turn cannot be computed.
pub fn steady_cycle(
    equation: &Equation,
    phi: f64,
    guess: f64,
    settings: Settings,
) -> Result<Cycle, CycleError> {
    settings.check().map_err(RunError::from)?;
    if !(guess.is_finite() && guess != 0.0) {
        return Err(CycleError::NoSpeed { psi: guess });
    }
    let mut psi = guess;
    let mut counts = Counts::default();
    let mut change = f64::INFINITY;
    // Where the last turn ended, in case Newton's step leads nowhere.
    let mut fallback = None;
    for iterations in 1..=MOST_ITERATIONS {
        let l = match (lap(equation, settings, phi, psi, false), fallback.take()) {
            (Err(_), Some(after)) => {
                psi = after;
                lap(equation, settings, phi, psi, false)?
            }
            (l, _) => l?,
        };
        counts = counts.plus(l.counts);
        let last = change;
        change = l.psi - psi;
        let newton = newton(psi, change, l.slope);
        fallback = newton.map(|_| l.psi);
        psi = newton.unwrap_or(l.psi);
        if settled(change, last, settings.tolerance, psi) {
            let l = lap(equation, settings, phi, psi, true)?;
            return finish(equation, phi, psi, l, iterations, counts);
        }
    }
    Err(CycleError::NotFound {
        iterations: MOST_ITERATIONS,
        change,
    })
}

/// Newton's step on `P(ψ) − ψ`, which is `change` where P has the slope `slope`. `None` where it
/// leads nowhere: beside a neutral cycle, which is one already, it is nearly 0/0.
fn newton(psi: f64, change: f64, slope: f64) -> Option<f64> {
    let newton = psi + change / (1.0 - slope);
    // Far from the cycle the straight line does not carry far.
    let near = newton
        .abs()
        .clamp(0.5 * psi.abs(), 2.0 * psi.abs())
        .copysign(psi);
    (newton * psi > 0.0 && slope < 0.9).then_some(near)
}

/// Returns whether a speed `psi` that changes by `change` in a turn, after `last` in the one
/// before, repeats to what the tolerance lets be told.
fn settled(change: f64, last: f64, tolerance: f64, psi: f64) -> bool {
    let small = change.abs() <= 4.0 * tolerance * psi.abs();
    // Rounding and the tolerance set the floor below which it no longer shrinks.
    let floor = change.abs() >= 0.5 * last.abs() && change.abs() <= 1e3 * tolerance * psi.abs();
    small || floor
}

fn finish(
    equation: &Equation,
    phi: f64,
    psi: f64,
    l: Lap,
    iterations: u32,
    counts: Counts,
) -> Result<Cycle, CycleError> {
    let forces = equation
        .forces(phi, psi, psi.signum())
        .map_err(|source| RunError::Equation { t: 0.0, source })?;
    let mean = psi.signum() * TAU / l.period;
    Ok(Cycle {
        psi,
        period: l.period,
        mean,
        least: l.least,
        most: l.most,
        fluctuation: (l.most.0 - l.least.0) / mean.abs(),
        multiplier: l.slope,
        work: l.work,
        kinetic_energy: 0.5 * forces.inertia * psi * psi,
        mismatch: (l.psi - psi).abs(),
        iterations,
        counts: counts.plus(l.counts),
    })
}

#[cfg(test)]
mod tests;
