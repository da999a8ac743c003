//! Charts over the frequency criterion.

use super::error::ChirpChartError;
use super::peak::largest;
use super::response::{CamResponse, Period, TurnPeaks};
use crate::cam_law::{CamCycle, Stroke};
use std::f64::consts::TAU;

/// The chart of one response.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Holds what `xi` is made of.
    pub period: Period,
    /// The largest acceleration, moment and power without elasticity, in the units of the points.
    pub rigid: [f64; 3],
    /// In the order asked for.
    pub points: Vec<ChartPoint>,
}

/// One abscissa of a chart. Displacements are in lifts `h`, accelerations in `h (Ω/β)²`, with `β`
/// the angle of the rise and `Ω` the speed at that time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChartPoint {
    /// ξ with the rise as the period (1).
    pub xi_rise: f64,
    /// ξ with the turn as the period.
    pub xi_turn: f64,
    /// Time.
    pub t: f64,
    /// Speed of the shaft, rad/s.
    pub speed: f64,
    /// `Σ|A_k|`, formula (19) corrected.
    pub bound: f64,
    /// The true peak of `|y − a_0|` in the turn.
    pub displacement: f64,
    /// `w² Σ|D_k − A_k|`, a bound on `y″ + 2n y′`.
    pub acceleration_bound: f64,
    /// `C_φ`, the true peak of `|y″|` in the turn.
    pub acceleration: f64,
    /// `K_dc`, `K_dM`, `K_dN` (2).
    pub dynamic_coefficients: [f64; 3],
    /// Amplitude of the free vibration at the end of the high dwell that is nearest; NaN if
    /// overdamped, and where nothing has dwelt: without a high dwell, and before the end of the
    /// first one.
    pub dwell_amplitude: f64,
    /// Its phase there, in (−π, π]; NaN where the amplitude is.
    pub dwell_phase: f64,
}

/// A local maximum of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeatZone {
    /// Its abscissa, on the parabola through three points.
    pub xi: f64,
    /// Its height there.
    pub value: f64,
    /// Distance from the maximum before; NaN for the first.
    pub spacing: f64,
}

/// The largest `|s''|` and `|s' s''|` of a cycle without elasticity, in units of the rise.
fn rigid(cycle: &CamCycle) -> [f64; 3] {
    let rise = cycle.rise();
    let of = |stroke: &Stroke| {
        let peaks = stroke.law.peaks();
        let ratio = rise.turns / stroke.turns;
        let product = |x: f64| {
            let m = stroke.law.motion(x.clamp(0.0, 1.0)).unwrap_or_default();
            m.velocity * m.acceleration
        };
        let places: Vec<f64> = (0..=1000).map(|i| f64::from(i) / 1000.0).collect();
        let values: Vec<f64> = places.iter().map(|&x| product(x)).collect();
        let power = largest(&places, &values, product).1;
        let acceleration = peaks.acceleration.max(peaks.deceleration);
        [acceleration * ratio.powi(2), power * ratio.powi(3)]
    };
    let up = of(rise);
    let down = cycle.fall().map_or([0.0; 2], of);
    let [acceleration, power] = [up[0].max(down[0]), up[1].max(down[1])];
    // On the camshaft the moment of a rigid follower is its power over the speed.
    [acceleration, power, power]
}

impl Chart {
    /// The chart at values of the criterion, on all cores with feature `parallel`.
    ///
    /// # Errors
    /// A criterion that is not positive or a speed that the shaft never has.
    pub fn new(
        response: &CamResponse,
        period: Period,
        grid: &[f64],
    ) -> Result<Chart, ChirpChartError> {
        Chart::with_peaks(response, period, grid, CamResponse::peaks)
    }

    /// [`Chart::new`] without `K_dM` and `K_dN`, which are NaN, in about half the time.
    ///
    /// # Errors
    /// As [`Chart::new`].
    pub fn of_motion(
        response: &CamResponse,
        period: Period,
        grid: &[f64],
    ) -> Result<Chart, ChirpChartError> {
        Chart::with_peaks(response, period, grid, CamResponse::motion_peaks)
    }

    fn with_peaks(
        response: &CamResponse,
        period: Period,
        grid: &[f64],
        peaks: Peaks,
    ) -> Result<Chart, ChirpChartError> {
        let rigid = rigid(&response.drive().cycle);
        let one = |&xi: &f64| point(response, period, xi, &rigid, peaks);
        #[cfg(feature = "parallel")]
        let points = {
            use rayon::prelude::*;
            grid.par_iter().map(one).collect::<Result<Vec<_>, _>>()?
        };
        #[cfg(not(feature = "parallel"))]
        let points = grid.iter().map(one).collect::<Result<Vec<_>, _>>()?;
        Ok(Chart {
            period,
            rigid,
            points,
        })
    }

    /// Abscissae of the points.
    pub fn xi(&self, point: &ChartPoint) -> f64 {
        match self.period {
            Period::Rise => point.xi_rise,
            Period::Turn => point.xi_turn,
        }
    }

    /// The beat zones of one curve.
    pub fn beats(&self, curve: fn(&ChartPoint) -> f64) -> Vec<BeatZone> {
        let points = self.points.iter().map(|p| (self.xi(p), curve(p)));
        beat_zones(&points.collect::<Vec<_>>())
    }
}

/// The peaks in the turn about a time.
type Peaks = fn(&CamResponse, f64) -> TurnPeaks;

fn point(
    response: &CamResponse,
    period: Period,
    xi: f64,
    rigid: &[f64; 3],
    peaks: Peaks,
) -> Result<ChartPoint, ChirpChartError> {
    let drive = response.drive();
    let t = drive.time_of(xi, period)?;
    let speed = drive.speed(t);
    let lift = drive.cycle.lift().abs();
    let rate = speed.abs() / (TAU * drive.cycle.rise().turns);
    let [bound, acceleration_bound] = response.bounds(t)?;
    let peaks = peaks(response, t);
    let acceleration = peaks.acceleration / (lift * rate * rate);
    // The moment is a force times df/dθ, in h²(Ω/β)²/β.
    let moment = peaks.moment * TAU * drive.cycle.rise().turns / (lift * rate).powi(2);
    let power = peaks.power / (lift * lift * rate.powi(3));
    let vibration = match response.end_of_dwell(t) {
        Some(end) => response.free_vibration(end)?,
        None => None,
    };
    Ok(ChartPoint {
        xi_rise: drive.criterion(speed, Period::Rise),
        xi_turn: drive.criterion(speed, Period::Turn),
        t,
        speed,
        bound: bound / lift,
        displacement: peaks.displacement / lift,
        acceleration_bound: acceleration_bound / (lift * rate * rate),
        acceleration,
        dynamic_coefficients: [acceleration / rigid[0], moment / rigid[1], power / rigid[2]],
        dwell_amplitude: vibration.map_or(f64::NAN, |v| v.amplitude / lift),
        dwell_phase: vibration.map_or(f64::NAN, |v| v.phase),
    })
}

/// Local maxima of a curve given by points with increasing abscissae.
///
/// ```
/// use mechaudit_solvers::chirp_chart::beat_zones;
/// let x = (0..200).map(|i| f64::from(i) * 0.1);
/// let curve: Vec<(f64, f64)> = x.map(|x| (x, x.sin())).collect();
/// let zones = beat_zones(&curve);
/// assert_eq!(zones.len(), 3);
/// assert!((zones[1].spacing - std::f64::consts::TAU).abs() < 1e-3);
/// ```
pub fn beat_zones(points: &[(f64, f64)]) -> Vec<BeatZone> {
    let mut zones: Vec<BeatZone> = Vec::new();
    for window in points.windows(3) {
        let [(x0, y0), (x1, y1), (x2, y2)] = [window[0], window[1], window[2]];
        if !(y1 > y0 && y1 >= y2) {
            continue;
        }
        // The vertex of the parabola, by divided differences.
        let (first, second) = ((y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1));
        let bend = (second - first) / (x2 - x0);
        let xi = 0.5 * (x0 + x1 - first / bend);
        let value = y1 + (xi - x1) * (second + bend * (xi - x2));
        let spacing = zones.last().map_or(f64::NAN, |z| xi - z.xi);
        zones.push(BeatZone { xi, value, spacing });
    }
    zones
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cam_law::MotionLaw;

    /// The power of a rigid follower has a peak on either half, of which the shorter one has the
    /// higher.
    #[test]
    fn the_power_of_a_rigid_follower() {
        for fraction in [0.2, 0.35, 0.65, 0.8] {
            let law = MotionLaw::cycloidal();
            let law = law.with_acceleration_fraction(fraction).expect("a law");
            let product = |x: f64| {
                let m = law.motion(x).expect("a place");
                (m.velocity * m.acceleration).abs()
            };
            let fine = (0..=100_000).map(|k| product(f64::from(k) / 1e5));
            let due = fine.fold(0.0, f64::max);
            let turns = 0.25;
            let stroke = || Stroke {
                law: law.clone(),
                turns,
            };
            let cycle = CamCycle::rise_return(
                1.0,
                stroke(),
                Stroke {
                    turns: 0.75,
                    ..stroke()
                },
            );
            let [_, power, moment] = rigid(&cycle.expect("a cycle"));
            assert!(
                (power / due - 1.0).abs() < 1e-6,
                "{fraction}: {power} {due}"
            );
            assert_eq!(power, moment);
        }
    }
}
