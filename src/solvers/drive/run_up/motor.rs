//! Torque of a motor at its own shaft as a function of its speed.

use super::motor_error::{MotorError, finite, positive};
use super::timed::TimedTorque;
use crate::cubic_spline::{Boundary, CubicSpline};
use crate::units::{AngularVelocity, Torque};

/// The speed is outside a tabulated curve.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the motor turns at {speed} rad/s, but its torque is tabulated from {first} to {last} rad/s only"
)]
pub struct OutsideTable {
    /// Speed in rad/s.
    pub speed: f64,
    /// First speed of the table.
    pub first: f64,
    /// Last speed of the table.
    pub last: f64,
}

/// An induction motor by Kloss's formula, Zinchenko 2008, (2), in the form without `0/0` at no
/// slip:
///
/// ```text
/// M_d = 2 M_k S S_k / (S² + S_k²),   S = (ω_c − ω)/ω_c,   S_k = s_n (k + √(k² − 1)),   M_k = k M_n
/// ```
///
/// It holds for both signs of the slip: `S < 0` is the range of the generator, `S > 1` that of
/// plugging. `M(s_n) = M_n` and the largest torque is `M_k`, at `S = S_k`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kloss {
    synchronous: f64,
    pull_out: f64,
    critical_slip: f64,
}

impl Kloss {
    /// From the rated torque M_n, the overload factor k and the rated slip s_n.
    ///
    /// ```
    /// use mechaudit_solvers::run_up::Kloss;
    /// use mechaudit_solvers::units::{AngularVelocity, Torque};
    /// let w = AngularVelocity::from_rad_per_s;
    /// let motor = Kloss::rated(w(10.0), Torque::from_n_m(200.0), 2.2, 0.05)?;
    /// assert!((motor.critical_slip() - 0.207980).abs() < 1e-6);
    /// assert!((motor.torque(9.5) - 200.0).abs() < 1e-12);
    /// # Ok::<(), mechaudit_solvers::run_up::MotorError>(())
    /// ```
    ///
    /// # Errors
    /// [`MotorError`]: a number that is not finite, a speed or torque that is not positive,
    /// `k < 1`, a slip outside (0, 1).
    pub fn rated(
        synchronous: AngularVelocity,
        rated_torque: Torque,
        overload: f64,
        rated_slip: f64,
    ) -> Result<Kloss, MotorError> {
        let torque = positive("rated torque", rated_torque.n_m(), "N m")?;
        if !(finite("overload factor", overload)? >= 1.0) {
            return Err(MotorError::Overload { value: overload });
        }
        if !(finite("rated slip", rated_slip)? > 0.0 && rated_slip < 1.0) {
            return Err(MotorError::Slip { value: rated_slip });
        }
        // k² − 1 as a product: no cancellation beside k = 1.
        let root = ((overload - 1.0) * (overload + 1.0)).sqrt();
        Kloss::critical(
            synchronous,
            Torque::from_n_m(overload * torque),
            rated_slip * (overload + root),
        )
    }

    /// From the pull-out torque M_k and the critical slip S_k.
    ///
    /// # Errors
    /// As [`Kloss::rated`].
    pub fn critical(
        synchronous: AngularVelocity,
        pull_out: Torque,
        critical_slip: f64,
    ) -> Result<Kloss, MotorError> {
        Ok(Kloss {
            synchronous: positive("synchronous speed", synchronous.rad_per_s(), "rad/s")?,
            pull_out: positive("pull-out torque", pull_out.n_m(), "N m")?,
            critical_slip: positive("critical slip", critical_slip, "")?,
        })
    }

    /// Synchronous speed ω_c in rad/s.
    pub fn synchronous(&self) -> f64 {
        self.synchronous
    }

    /// Pull-out torque M_k in N·m.
    pub fn pull_out(&self) -> f64 {
        self.pull_out
    }

    /// Critical slip S_k.
    pub fn critical_slip(&self) -> f64 {
        self.critical_slip
    }

    /// Slip at a speed in rad/s.
    pub fn slip(&self, speed: f64) -> f64 {
        (self.synchronous - speed) / self.synchronous
    }

    /// Torque in N·m at a speed in rad/s.
    pub fn torque(&self, speed: f64) -> f64 {
        let (s, k) = (self.slip(speed), self.critical_slip);
        2.0 * self.pull_out * s * k / (s * s + k * k)
    }

    /// `dM/dω` in N·m·s: `2 M_k S_k (S_k² − S²)/(S² + S_k²)² · (−1/ω_c)`.
    pub fn slope(&self, speed: f64) -> f64 {
        let (s, k) = (self.slip(speed), self.critical_slip);
        let d = s * s + k * k;
        -2.0 * self.pull_out * k * ((k - s) * (k + s)) / (d * d) / self.synchronous
    }
}

/// How a torque–speed table is read between its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableReading {
    /// Straight lines. The torque has kinks; the integration stops at each.
    Linear,
    /// A cubic spline, not-a-knot at the ends.
    Cubic,
}

/// The part of a table's range by which a speed may lie outside of it.
const ROUNDING: f64 = 1e-12;

/// A tabulated torque–speed curve. Nothing is read outside its first and last speed.
#[derive(Clone, Debug)]
pub struct TorqueTable {
    speeds: Vec<f64>,
    torques: Vec<f64>,
    cubic: Option<CubicSpline>,
}

impl TorqueTable {
    /// A curve through the points (speed in rad/s, torque in N·m), speeds increasing.
    ///
    /// # Errors
    /// [`MotorError::Table`]: fewer than two points, a number that is not finite, speeds that do
    /// not increase.
    pub fn new(points: &[(f64, f64)], reading: TableReading) -> Result<TorqueTable, MotorError> {
        let (speeds, torques): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        // The spline's rules are those of a table, whichever way it is read.
        let spline = CubicSpline::fit(speeds.clone(), torques.clone(), Boundary::NOT_A_KNOT)?;
        Ok(TorqueTable {
            speeds,
            torques,
            cubic: (reading == TableReading::Cubic).then_some(spline),
        })
    }

    /// Torque and its slope.
    fn read(&self, speed: f64) -> Result<(f64, f64), OutsideTable> {
        let (first, last) = (self.speeds[0], self.speeds[self.speeds.len() - 1]);
        // A step that ends at the first or last speed does so within rounding.
        let slack = ROUNDING * (last - first);
        if !(first - slack <= speed && speed <= last + slack) {
            return Err(OutsideTable { speed, first, last });
        }
        let speed = speed.clamp(first, last);
        if let Some(spline) = &self.cubic {
            let jet = spline
                .jet(speed)
                .map_err(|_| OutsideTable { speed, first, last })?;
            return Ok((jet.value, jet.first));
        }
        let i = self.speeds.partition_point(|s| *s <= speed);
        let i = i.clamp(1, self.speeds.len() - 1);
        let (x0, x1) = (self.speeds[i - 1], self.speeds[i]);
        let (y0, y1) = (self.torques[i - 1], self.torques[i]);
        let slope = (y1 - y0) / (x1 - x0);
        let k = (speed - x0) / (x1 - x0);
        Ok(((1.0 - k) * y0 + k * y1, slope))
    }
}

/// Describes what drives the crank.
#[derive(Clone, Debug)]
pub enum Motor {
    /// Nothing: a run-down.
    Off,
    /// The same torque at every speed, N·m.
    Constant(Torque),
    /// `M = M_0 (1 − ω/ω_0)`: a shunt motor, or any characteristic taken as straight.
    Linear {
        /// Torque at standstill M_0.
        standstill: Torque,
        /// Speed without load ω_0.
        no_load: AngularVelocity,
    },
    /// An induction motor.
    Kloss(Kloss),
    /// A tabulated curve.
    Table(TorqueTable),
    /// A torque over time.
    Timed(TimedTorque),
}

impl Motor {
    /// A constant torque.
    ///
    /// # Errors
    /// When it is not finite.
    pub fn constant(torque: Torque) -> Result<Motor, MotorError> {
        finite("torque", torque.n_m())?;
        Ok(Motor::Constant(torque))
    }

    /// A straight characteristic.
    ///
    /// # Errors
    /// When the torque is not finite or the speed not positive.
    pub fn linear(standstill: Torque, no_load: AngularVelocity) -> Result<Motor, MotorError> {
        finite("standstill torque", standstill.n_m())?;
        positive("no-load speed", no_load.rad_per_s(), "rad/s")?;
        Ok(Motor::Linear {
            standstill,
            no_load,
        })
    }

    /// Torque in N·m and its slope in N·m·s at a speed in rad/s, both at the motor's shaft, at the
    /// beginning of a run.
    ///
    /// # Errors
    /// [`OutsideTable`] for a speed that a table does not cover.
    pub fn torque_and_slope(&self, speed: f64) -> Result<(f64, f64), OutsideTable> {
        self.torque_and_slope_at(0.0, speed)
    }

    /// The same at a time in s, for motors whose torque depends on it.
    ///
    /// # Errors
    /// As [`Motor::torque_and_slope`].
    pub fn torque_and_slope_at(&self, time: f64, speed: f64) -> Result<(f64, f64), OutsideTable> {
        Ok(match self {
            Motor::Off => (0.0, 0.0),
            Motor::Constant(m) => (m.n_m(), 0.0),
            Motor::Linear {
                standstill,
                no_load,
            } => {
                let (m, w) = (standstill.n_m(), no_load.rad_per_s());
                (m * (w - speed) / w, -m / w)
            }
            Motor::Kloss(k) => (k.torque(speed), k.slope(speed)),
            Motor::Table(t) => t.read(speed)?,
            Motor::Timed(t) => (t.torque(time), 0.0),
        })
    }

    /// Speeds in rad/s at which the torque has a kink.
    pub fn kinks(&self) -> &[f64] {
        match self {
            Motor::Table(t) => &t.speeds,
            _ => &[],
        }
    }

    /// Returns whether the torque is known on that side (±1) of standstill.
    #[cfg(feature = "run-up")]
    pub(super) fn is_known_beside_rest(&self, sign: f64) -> bool {
        match self {
            Motor::Table(t) => t.speeds.iter().any(|w| sign * w > 0.0),
            _ => true,
        }
    }

    /// The torque over time, where that is what the motor gives.
    pub fn timed(&self) -> Option<&TimedTorque> {
        match self {
            Motor::Timed(t) => Some(t),
            _ => None,
        }
    }

    /// The speed in rad/s below which a motor with a pull-out torque works on the wrong side of
    /// it: `(1 − S_k) ω_c`. `None` for other motors and for `S_k ≥ 1`.
    pub fn pull_out_speed(&self) -> Option<f64> {
        match self {
            Motor::Kloss(k) if k.critical_slip < 1.0 => {
                Some((1.0 - k.critical_slip) * k.synchronous)
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests;
