//! The sections of the motor and of its load.

use crate::machine::quantity::{QuadraticResistance, Quantity, Time, ViscousResistance};
use crate::machine::source::{Refusal, Source};
use crate::solvers::run_up::{
    Drive, Kloss, Motor, MotorError, Resistance, TableReading, TimedTorque, TorqueTable,
};
use crate::solvers::units::{AngularVelocity, Inertia, Torque};
use serde::Deserialize;
use serde::de::{Deserializer, Error as _};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MotorSection {
    pub kind: MotorKind,
    pub synchronous_speed: Option<Quantity<AngularVelocity>>,
    pub rated_torque: Option<Quantity<Torque>>,
    pub overload: Option<f64>,
    pub rated_slip: Option<f64>,
    pub pull_out_torque: Option<Quantity<Torque>>,
    pub critical_slip: Option<f64>,
    pub standstill_torque: Option<Quantity<Torque>>,
    pub no_load_speed: Option<Quantity<AngularVelocity>>,
    pub torque: Option<Quantity<Torque>>,
    pub points: Option<Vec<(Abscissa, Quantity<Torque>)>>,
    pub reading: Option<Reading>,
    pub ratio: Option<f64>,
    pub rotor_inertia: Option<Quantity<Inertia>>,
    pub flywheel: Option<Quantity<Inertia>>,
}

/// Where a torque is given: a speed or a time, as its unit says.
#[derive(Clone)]
pub(super) enum Abscissa {
    Speed(Quantity<AngularVelocity>),
    Time(Quantity<Time>),
}

impl<'de> Deserialize<'de> for Abscissa {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Abscissa, D::Error> {
        let text = String::deserialize(from)?;
        if let Ok(time) = text.parse::<Quantity<Time>>() {
            return Ok(Abscissa::Time(time));
        }
        let speed = text.parse::<Quantity<AngularVelocity>>();
        let other = |e| D::Error::custom(format!("{e}, or a time, for instance in s"));
        speed.map(Abscissa::Speed).map_err(other)
    }
}

/// The kinds of motors.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum MotorKind {
    /// No torque.
    Off,
    /// The same torque at every speed.
    Constant,
    /// A straight line from standstill to no load.
    Linear,
    /// Kloss's formula.
    Kloss,
    /// Points of the curve over the speed, or of the torque over time.
    Table,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Reading {
    Linear,
    Cubic,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(super) struct LoadSection {
    pub constant: Option<Quantity<Torque>>,
    pub viscous: Option<Quantity<ViscousResistance>>,
    pub quadratic: Option<Quantity<QuadraticResistance>>,
}

fn si<D>(quantity: &Option<Quantity<D>>) -> f64 {
    quantity.as_ref().map_or(0.0, Quantity::to_f64)
}

pub(super) fn drive(
    source: &Source,
    motor: &MotorSection,
    load: &LoadSection,
) -> Result<Drive, Refusal> {
    let resistance = Resistance {
        constant: Torque::from_n_m(si(&load.constant)),
        viscous_n_m_s: si(&load.viscous),
        quadratic_n_m_s2: si(&load.quadratic),
    };
    let drive = Drive::new(
        motor.read(source)?,
        motor.ratio.unwrap_or(1.0),
        Inertia::from_kg_m2(si(&motor.rotor_inertia)),
        Inertia::from_kg_m2(si(&motor.flywheel)),
        resistance,
    );
    drive.map_err(|e| source.refuse("motor", e))
}

impl MotorKind {
    /// As the file names it.
    pub fn name(self) -> &'static str {
        match self {
            MotorKind::Off => "off",
            MotorKind::Constant => "constant",
            MotorKind::Linear => "linear",
            MotorKind::Kloss => "kloss",
            MotorKind::Table => "table",
        }
    }

    /// The fields that belong to it.
    pub(super) fn fields(self) -> &'static [&'static str] {
        match self {
            MotorKind::Off => &[],
            MotorKind::Constant => &["torque"],
            MotorKind::Linear => &["standstill_torque", "no_load_speed"],
            MotorKind::Kloss => &[
                "synchronous_speed",
                "rated_torque",
                "overload",
                "rated_slip",
                "pull_out_torque",
                "critical_slip",
            ],
            MotorKind::Table => &["points", "reading"],
        }
    }
}

impl MotorSection {
    pub fn read(&self, source: &Source) -> Result<Motor, Refusal> {
        let kind = self.kind;
        let given = self.given();
        if let Some(field) = given.iter().find(|f| !kind.fields().contains(f)) {
            let rule = format!("motor.{field} has no meaning with kind = {:?}", kind.name());
            return Err(source.breach(&format!("motor.{field}"), rule));
        }
        let missing = |field: &str| source.breach("motor", format!("motor.{field} is missing"));
        let torque = |field, q: &Option<Quantity<Torque>>| {
            let q = q.as_ref().ok_or_else(|| missing(field))?;
            Ok::<_, Refusal>(Torque::from_n_m(q.to_f64()))
        };
        let speed = |field, q: &Option<Quantity<AngularVelocity>>| {
            let q = q.as_ref().ok_or_else(|| missing(field))?;
            Ok::<_, Refusal>(AngularVelocity::from_rad_per_s(q.to_f64()))
        };
        let number = |field, x: Option<f64>| x.ok_or_else(|| missing(field));
        let motor: Result<Motor, MotorError> = match kind {
            MotorKind::Off => Ok(Motor::Off),
            MotorKind::Constant => Motor::constant(torque("torque", &self.torque)?),
            MotorKind::Linear => Motor::linear(
                torque("standstill_torque", &self.standstill_torque)?,
                speed("no_load_speed", &self.no_load_speed)?,
            ),
            MotorKind::Kloss => {
                let synchronous = speed("synchronous_speed", &self.synchronous_speed)?;
                let any = |fields: &[&str]| fields.iter().any(|f| given.contains(f));
                let rated = any(&["rated_torque", "overload", "rated_slip"]);
                let critical = any(&["pull_out_torque", "critical_slip"]);
                let motor = match (rated, critical) {
                    (true, true) => {
                        let rule = "motor: rated_torque, overload, rated_slip and pull_out_torque, critical_slip exclude each other";
                        return Err(source.breach("motor", rule));
                    }
                    (_, true) => Kloss::critical(
                        synchronous,
                        torque("pull_out_torque", &self.pull_out_torque)?,
                        number("critical_slip", self.critical_slip)?,
                    ),
                    _ => Kloss::rated(
                        synchronous,
                        torque("rated_torque", &self.rated_torque)?,
                        number("overload", self.overload)?,
                        number("rated_slip", self.rated_slip)?,
                    ),
                };
                motor.map(Motor::Kloss)
            }
            MotorKind::Table => {
                let points = self.points.as_ref().ok_or_else(|| missing("points"))?;
                let at = |time: bool| {
                    let of = |(x, m): &(Abscissa, Quantity<Torque>)| match x {
                        Abscissa::Time(t) if time => Some((t.to_f64(), m.to_f64())),
                        Abscissa::Speed(w) if !time => Some((w.to_f64(), m.to_f64())),
                        _ => None,
                    };
                    points.iter().map(of).collect::<Option<Vec<_>>>()
                };
                match (at(false), at(true), self.reading) {
                    (Some(_), Some(_), _) => {
                        let rule = "motor.points is empty";
                        return Err(source.breach("motor.points", rule));
                    }
                    (Some(points), _, reading) => {
                        let reading = match reading.ok_or_else(|| missing("reading"))? {
                            Reading::Linear => TableReading::Linear,
                            Reading::Cubic => TableReading::Cubic,
                        };
                        TorqueTable::new(&points, reading).map(Motor::Table)
                    }
                    (_, Some(_), Some(Reading::Cubic)) => {
                        let rule = "motor.reading = \"cubic\" has no meaning for a torque over time, which is read by straight lines";
                        return Err(source.breach("motor.reading", rule));
                    }
                    (_, Some(points), _) => TimedTorque::new(&points).map(Motor::Timed),
                    (None, None, _) => {
                        let rule =
                            "motor.points has speeds and times: it needs one of them throughout";
                        return Err(source.breach("motor.points", rule));
                    }
                }
            }
        };
        motor.map_err(|e| source.refuse("motor", e))
    }

    /// The fields given that belong to one kind of motor.
    pub fn given(&self) -> Vec<&'static str> {
        let all = [
            ("synchronous_speed", self.synchronous_speed.is_some()),
            ("rated_torque", self.rated_torque.is_some()),
            ("overload", self.overload.is_some()),
            ("rated_slip", self.rated_slip.is_some()),
            ("pull_out_torque", self.pull_out_torque.is_some()),
            ("critical_slip", self.critical_slip.is_some()),
            ("standstill_torque", self.standstill_torque.is_some()),
            ("no_load_speed", self.no_load_speed.is_some()),
            ("torque", self.torque.is_some()),
            ("points", self.points.is_some()),
            ("reading", self.reading.is_some()),
        ];
        all.into_iter().filter(|f| f.1).map(|f| f.0).collect()
    }
}
