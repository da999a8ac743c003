//! Describes what acts on the crank in addition to the linkage: motor, reducer, rotor, flywheel and
//! resistance.

use super::motor::{Motor, OutsideTable};
use super::motor_error::{MotorError, finite, not_negative};
use crate::units::{Inertia, Torque};

/// Resistance to the crank's motion: `−(c_0 sign ψ + c_1 ψ + c_2 |ψ| ψ)`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Resistance {
    /// c_0 in N·m. At rest it takes no sides: it holds the crank against any torque up to its own.
    pub constant: Torque,
    /// c_1 in N·m·s.
    pub viscous_n_m_s: f64,
    /// c_2 in N·m·s².
    pub quadratic_n_m_s2: f64,
}

impl Resistance {
    fn check(&self) -> Result<(), MotorError> {
        not_negative("constant resistance", self.constant.n_m(), "N m")?;
        not_negative("viscous resistance", self.viscous_n_m_s, "N m s")?;
        not_negative("quadratic resistance", self.quadratic_n_m_s2, "N m s^2")?;
        Ok(())
    }

    /// Torque and slope while the crank turns in the direction `sign`.
    fn torque_and_slope(&self, psi: f64, sign: f64) -> (f64, f64) {
        let (c0, c1, c2) = (
            self.constant.n_m(),
            self.viscous_n_m_s,
            self.quadratic_n_m_s2,
        );
        // From zero, so that no resistance is 0 and not −0.
        let torque = 0.0 - (c0 * sign + c1 * psi + c2 * psi.abs() * psi);
        (torque, -(c1 + 2.0 * c2 * psi.abs()))
    }
}

/// Motor, reducer and everything that turns with the crank, reduced to the crank.
///
/// With the ratio `i` (motor speed over crank speed) the crank feels the torque `i M(i ψ)` and the
/// rotor's inertia `i² J`. The reducer loses nothing; losses belong into [`Resistance`].
#[derive(Clone, Debug)]
pub struct Drive {
    motor: Motor,
    ratio: f64,
    inertia: f64,
    resistance: Resistance,
}

impl Drive {
    /// A motor on the crank itself, nothing else.
    pub fn direct(motor: Motor) -> Drive {
        Drive {
            motor,
            ratio: 1.0,
            inertia: 0.0,
            resistance: Resistance::default(),
        }
    }

    /// A drive. `rotor` turns with the motor; `at_crank` (flywheel, the I_1 of Zinchenko's (3)
    /// unless it is given among the bodies) turns with the crank.
    ///
    /// # Errors
    /// [`MotorError`]: a ratio of zero, a negative inertia or resistance, a number that is not
    /// finite.
    pub fn new(
        motor: Motor,
        ratio: f64,
        rotor: Inertia,
        at_crank: Inertia,
        resistance: Resistance,
    ) -> Result<Drive, MotorError> {
        if finite("ratio of the reducer", ratio)? == 0.0 {
            return Err(MotorError::NoRatio);
        }
        resistance.check()?;
        let rotor = not_negative("rotor inertia", rotor.kg_m2(), "kg·m²")?;
        let crank = not_negative("inertia at the crank", at_crank.kg_m2(), "kg·m²")?;
        let inertia = finite(
            "inertia reduced to the crank",
            rotor * ratio * ratio + crank,
        )?;
        Ok(Drive {
            motor,
            ratio,
            inertia,
            resistance,
        })
    }

    /// The same drive with so much more inertia at the crank.
    ///
    /// # Errors
    /// When the added inertia is negative or not finite.
    pub fn with_flywheel(&self, flywheel: Inertia) -> Result<Drive, MotorError> {
        let added = not_negative("flywheel inertia", flywheel.kg_m2(), "kg·m²")?;
        let inertia = finite("inertia reduced to the crank", self.inertia + added)?;
        Ok(Drive {
            inertia,
            ..self.clone()
        })
    }

    /// The motor.
    pub fn motor(&self) -> &Motor {
        &self.motor
    }

    /// Motor speed over crank speed.
    pub fn ratio(&self) -> f64 {
        self.ratio
    }

    /// I_1 + i² J in kg·m².
    pub fn inertia(&self) -> f64 {
        self.inertia
    }

    /// The resistance.
    pub fn resistance(&self) -> &Resistance {
        &self.resistance
    }

    /// Torque of the motor at the crank and its slope by ψ, at the beginning of a run.
    ///
    /// # Errors
    /// [`OutsideTable`].
    pub fn motor_torque(&self, psi: f64) -> Result<(f64, f64), OutsideTable> {
        self.motor_torque_at(0.0, psi)
    }

    /// The same at a time in s.
    ///
    /// # Errors
    /// [`OutsideTable`].
    pub fn motor_torque_at(&self, time: f64, psi: f64) -> Result<(f64, f64), OutsideTable> {
        let (m, d) = self.motor.torque_and_slope_at(time, self.ratio * psi)?;
        Ok((self.ratio * m, self.ratio * self.ratio * d))
    }

    /// Torque of the resistance at the crank and its slope by ψ, for motion in the direction
    /// `sign`.
    pub fn resisting_torque(&self, psi: f64, sign: f64) -> (f64, f64) {
        self.resistance.torque_and_slope(psi, sign)
    }

    /// Crank speeds at which the motor's torque has a kink.
    pub fn kinks(&self) -> Vec<f64> {
        self.motor.kinks().iter().map(|w| w / self.ratio).collect()
    }

    /// The crank speed of the motor's pull-out torque, see [`Motor::pull_out_speed`].
    pub fn pull_out_speed(&self) -> Option<f64> {
        self.motor.pull_out_speed().map(|w| w / self.ratio)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run_up::Kloss;
    use crate::units::AngularVelocity;

    #[test]
    fn a_reducer_multiplies_torque_and_inertia() {
        let w = AngularVelocity::from_rad_per_s;
        let slow = Kloss::rated(w(10.0), Torque::from_n_m(200.0), 2.2, 0.05).unwrap();
        let fast = Kloss::rated(w(150.0), Torque::from_n_m(200.0 / 15.0), 2.2, 0.05).unwrap();
        let j = Inertia::from_kg_m2;
        let none = Resistance::default();
        let geared = Drive::new(Motor::Kloss(fast), 15.0, j(0.006), j(0.05), none).unwrap();
        let direct = Drive::direct(Motor::Kloss(slow));
        for psi in [-1.0, 0.0, 4.0, 9.7, 11.0] {
            let (a, b) = (
                geared.motor_torque(psi).unwrap(),
                direct.motor_torque(psi).unwrap(),
            );
            assert!(
                (a.0 - b.0).abs() < 1e-10 && (a.1 - b.1).abs() < 1e-9,
                "{psi}"
            );
        }
        assert!((geared.inertia() - (225.0 * 0.006 + 0.05)).abs() < 1e-15);
        assert!(
            (geared.pull_out_speed().unwrap() - 10.0 * (1.0 - slow.critical_slip())).abs() < 1e-12
        );
    }

    /// At rest, where the motion has no direction, the constant part takes no sides.
    #[test]
    fn resistance_by_speed_and_direction() {
        let r = Resistance {
            constant: Torque::from_n_m(3.0),
            viscous_n_m_s: 0.5,
            quadratic_n_m_s2: 0.25,
        };
        let j = Inertia::from_kg_m2(0.0);
        let drive = Drive::new(Motor::Off, 1.0, j, j, r).unwrap();
        assert_eq!(*drive.resistance(), r);
        assert_eq!(drive.resisting_torque(4.0, 1.0), (-9.0, -2.5));
        assert_eq!(drive.resisting_torque(-4.0, -1.0), (9.0, -2.5));
        assert_eq!(drive.resisting_torque(0.0, 0.0), (0.0, -0.5));
    }

    /// Kinks are at the speeds of the crank, not of the motor.
    #[test]
    fn kinks_behind_a_reducer() {
        use crate::run_up::{TableReading, TorqueTable};
        let points = [(-30.0, 5.0), (12.0, 5.0), (90.0, 0.0)];
        let table = TorqueTable::new(&points, TableReading::Linear).unwrap();
        let j = Inertia::from_kg_m2(0.0);
        let none = Resistance::default();
        let drive = Drive::new(Motor::Table(table), 4.0, j, j, none).unwrap();
        assert_eq!(drive.kinks(), [-7.5, 3.0, 22.5]);
        assert!(Drive::direct(Motor::Off).kinks().is_empty());
    }

    #[test]
    fn bad_drives_are_refused() {
        let j = Inertia::from_kg_m2;
        let none = Resistance::default();
        let make = |ratio, rotor, crank, r| {
            Drive::new(Motor::Off, ratio, j(rotor), j(crank), r)
                .unwrap_err()
                .to_string()
        };
        assert!(make(0.0, 0.0, 0.0, none).contains("must not be zero"));
        assert!(make(f64::NAN, 0.0, 0.0, none).contains("not a finite"));
        assert!(make(1.0, -1.0, 0.0, none).contains("rotor inertia = -1 kg·m²"));
        assert!(make(1.0, 0.0, f64::INFINITY, none).contains("inertia at the crank"));
        assert!(make(1e200, 1.0, 0.0, none).contains("reduced to the crank"));
        let r = Resistance {
            viscous_n_m_s: -1.0,
            ..none
        };
        assert!(make(1.0, 0.0, 0.0, r).contains("viscous resistance"));
    }
}
