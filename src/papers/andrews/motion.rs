//! The motion, enclosed.

use super::data;
use super::printed::QUANTITIES;
use crate::papers::number::Number;
use crate::reference::planar::{Course, Linkage, Moment, Position, Rates};
use crate::reference::{Ball, Undecided};

/// Times in seconds.
pub const TIMES: [&str; 3] = ["0.01", "0.02", "0.03"];
/// Certified digits that are given.
pub const DIGITS: usize = 30;

/// The mechanism from rest: at the start, then at [`TIMES`].
pub struct Motion {
    /// The proof's counts, and the moments.
    pub course: Course,
    /// The printed quantities at t = 0 and at each of the times.
    pub values: Vec<Vec<Ball>>,
}

/// Angles between bodies from the angles of their axes: β, Θ, γ, Φ, δ, Ω, ε.
fn relative(x: &[Ball]) -> Vec<Ball> {
    vec![
        x[0].clone(),
        &x[1] - &x[0],
        x[2].clone(),
        &x[3] - &x[4],
        x[4].clone(),
        &x[5] - &x[6],
        x[6].clone(),
    ]
}

fn quantities(position: &Position, rates: &Rates, multipliers: &[Ball]) -> Vec<Ball> {
    let mut all = relative(&position.x);
    all.extend(relative(&rates.first));
    all.extend(relative(&rates.second));
    all.extend(multipliers[..6].iter().cloned());
    debug_assert_eq!(all.len(), QUANTITIES.len());
    all
}

/// The motion from Θ = 0 at rest.
///
/// # Errors
/// [`Undecided`] if a proof fails.
pub fn motion(bits: u32) -> Result<Motion, Undecided> {
    let broken = |e: crate::reference::planar::MechanismError| Undecided {
        bits,
        reason: e.to_string(),
    };
    let mechanism = data::mechanism().map_err(broken)?;
    let folded = Linkage::new(&mechanism, &data::fold(), bits).map_err(broken)?;
    let start = folded.position(&Ball::integer(bits, 0), &data::near_the_start())?;
    let linkage = Linkage::new(&mechanism, &data::crank(), bits).map_err(broken)?;
    let times = TIMES.map(|t| Number::read(t).value.value);
    let course = linkage.from_rest(
        &linkage.driven(&start),
        &start.midpoints(),
        &data::forces(),
        &times,
    )?;
    let still = Ball::integer(bits, 0);
    let rates = linkage.in_time(&course.start, &still, &course.first_acceleration)?;
    let multipliers = linkage.multipliers(&course.start, &rates, &data::forces())?;
    let mut values = vec![quantities(&course.start, &rates, &multipliers)];
    let at = |m: &Moment| quantities(&m.position, &m.rates, &m.multipliers);
    values.extend(course.moments.iter().map(at));
    Ok(Motion { course, values })
}
