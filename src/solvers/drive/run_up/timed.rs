//! Torque of a motor as a table over time, as of a soft start.

use super::motor_error::{MotorError, finite};

/// A torque that is given at moments, joined by straight lines, whatever the speed. After the last
/// moment it stays.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedTorque {
    times: Vec<f64>,
    torques: Vec<f64>,
}

/// Beyond a limit by less than this part of the largest torque it counts as not beyond: a crank at
/// rest that would be let go earlier could not be told from one that is held.
#[cfg(feature = "run-up")]
const BEYOND: f64 = 1e-9;

impl TimedTorque {
    /// Through the points (time in s, torque in N·m at the motor's shaft). The first time is 0, and
    /// times increase.
    ///
    /// ```
    /// use mechaudit_solvers::run_up::TimedTorque;
    /// let soft = TimedTorque::new(&[(0.0, 0.0), (2.0, 40.0)])?;
    /// assert_eq!((soft.torque(0.5), soft.torque(3.0)), (10.0, 40.0));
    /// # Ok::<(), mechaudit_solvers::run_up::MotorError>(())
    /// ```
    ///
    /// # Errors
    /// [`MotorError`]: no points, a number that is not finite, a first time other than 0, times
    /// that do not increase.
    pub fn new(points: &[(f64, f64)]) -> Result<TimedTorque, MotorError> {
        let (times, torques): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        for (t, m) in points {
            finite("time of the torque table", *t)?;
            finite("torque of the torque table", *m)?;
        }
        match times.first() {
            None => return Err(MotorError::NoPoints),
            Some(0.0) => {}
            Some(&time) => return Err(MotorError::FirstTime { time }),
        }
        if let Some(k) = (1..times.len()).find(|&k| !(times[k] > times[k - 1])) {
            return Err(MotorError::TimesNotIncreasing {
                point: k + 1,
                time: times[k],
                before: times[k - 1],
            });
        }
        Ok(TimedTorque { times, torques })
    }

    /// The moments, at which the torque has a kink.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The torque in N·m at a time in s.
    pub fn torque(&self, time: f64) -> f64 {
        let k = self.times.partition_point(|t| *t <= time);
        match (k.checked_sub(1), self.times.get(k)) {
            (None, _) => self.torques[0],
            (Some(last), None) => self.torques[last],
            (Some(i), Some(next)) => {
                let part = (time - self.times[i]) / (next - self.times[i]);
                (1.0 - part) * self.torques[i] + part * self.torques[k]
            }
        }
    }

    /// The first time from `from` on at which the torque is below or above these limits.
    #[cfg(feature = "run-up")]
    pub(super) fn first_outside(&self, from: f64, [low, high]: [f64; 2]) -> Option<f64> {
        let largest = self.torques.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let (low, high) = (low - BEYOND * largest, high + BEYOND * largest);
        let here = self.torque(from);
        if !(low <= here && here <= high) {
            return Some(from);
        }
        let (mut t0, mut m0) = (from, here);
        let later = self.times.iter().zip(&self.torques);
        for (&t1, &m1) in later.filter(|(t, _)| **t > from) {
            let limit = if m1 > high { high } else { low };
            if m1 > high || m1 < low {
                return Some(t0 + (limit - m0) / (m1 - m0) * (t1 - t0));
            }
            (t0, m0) = (t1, m1);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_over_time_is_read_by_straight_lines() {
        let table = TimedTorque::new(&[(0.0, 2.0), (1.0, 4.0), (3.0, -4.0)]).unwrap();
        for (t, due) in [
            (0.0, 2.0),
            (0.5, 3.0),
            (1.0, 4.0),
            (2.0, 0.0),
            (3.0, -4.0),
            (9.0, -4.0),
        ] {
            assert_eq!(table.torque(t), due, "{t}");
        }
        let constant = TimedTorque::new(&[(0.0, 5.0)]).unwrap();
        assert_eq!((constant.torque(0.0), constant.torque(7.0)), (5.0, 5.0));
    }

    #[test]
    fn bad_tables_over_time_are_refused() {
        let refused = |points: &[(f64, f64)]| TimedTorque::new(points).unwrap_err().to_string();
        for (points, due) in [
            (&[][..], "the torque over time has no points"),
            (
                &[(1.0, 0.0)],
                "the first time of the torque, 1 s, must be 0 s",
            ),
            (
                &[(0.0, 0.0), (2.0, 1.0), (2.0, 3.0)],
                "the time of point 3, 2 s, must be greater than the one before, 2 s",
            ),
            (
                &[(0.0, 0.0), (f64::NAN, 1.0)],
                "time of the torque table = NaN is not a finite number",
            ),
            (
                &[(0.0, f64::INFINITY)],
                "torque of the torque table = inf is not a finite number",
            ),
        ] {
            assert_eq!(refused(points), due);
        }
    }

    #[cfg(feature = "run-up")]
    #[test]
    fn limits_are_left_where_a_line_crosses_them() {
        let table = TimedTorque::new(&[(0.0, 0.0), (2.0, 4.0), (4.0, -4.0)]).unwrap();
        for (from, limits, due) in [
            (0.0, [-1.0, 1.0], Some(0.5)),
            (0.25, [-1.0, 1.0], Some(0.5)),
            (1.0, [-1.0, 1.0], Some(1.0)),
            (0.0, [-1.0, 5.0], Some(3.25)),
            (2.5, [-1.0, 3.0], Some(3.25)),
            (0.0, [-5.0, 5.0], None),
            (9.0, [-1.0, 1.0], Some(9.0)),
            (9.0, [-5.0, 1.0], None),
        ] {
            let found = table.first_outside(from, limits);
            let same = match (found, due) {
                (Some(a), Some(b)) => (a - b).abs() < 1e-8,
                (a, b) => a == b,
            };
            assert!(same, "{from} {limits:?}: {found:?}");
        }
    }
}
