//! Motor, reducer and resistance of a motion, as formulas too.

use super::StartSection;
use super::motor::{Abscissa, LoadSection, MotorKind, MotorSection, Reading, drive};
use crate::machine::quantity::Quantity;
use crate::machine::source::{Refusal, Source};
use crate::reference::cubic_spline::Spline;
use crate::solvers::run_up::Drive;
use crate::solvers::units::{AngularVelocity, Torque};
use rug::Rational;
use serde::Deserialize;

/// The sections of the motor and its load, where there are any.
#[derive(Deserialize)]
struct File {
    motor: Option<MotorSection>,
    #[serde(default)]
    load: LoadSection,
}

/// A motor with its reducer, rotor, flywheel and resistance at the driven body.
pub struct Drivetrain {
    /// In floating point.
    pub drive: Drive,
    motor: MotorSection,
    load: LoadSection,
}

/// The speed at the start that the section `[start]` gives.
///
/// # Errors
/// [`Refusal`].
pub fn start_speed(source: &Source) -> Result<Option<Quantity<AngularVelocity>>, Refusal> {
    #[derive(Deserialize)]
    struct File {
        start: Option<StartSection>,
    }
    let file: File = source.parse()?;
    Ok(file.start.and_then(|s| s.speed))
}

/// The section `[motor]` with `[load]`; `None` without it.
///
/// # Errors
/// [`Refusal`].
pub fn drivetrain(source: &Source) -> Result<Option<Drivetrain>, Refusal> {
    let File { motor, load } = source.parse()?;
    let Some(motor) = motor else {
        return Ok(None);
    };
    let drive = drive(source, &motor, &load)?;
    Ok(Some(Drivetrain { drive, motor, load }))
}

/// A quantity as a formula, `0` where there is none.
fn text<D>(q: &Option<Quantity<D>>) -> String {
    q.as_ref().map_or("0".into(), quantity)
}

/// A quantity as a formula in SI units and radians.
pub(super) fn quantity<D>(q: &Quantity<D>) -> String {
    match q.degrees {
        true => format!("({})*pi/180", q.value),
        false => format!("({})", q.value),
    }
}

/// The pieces of a table, by nested conditions; the first and last go on beyond the ends.
fn nested(x: &str, knots: &[String], pieces: Vec<String>) -> String {
    let mut pieces = pieces.into_iter().rev();
    let last = pieces.next().unwrap_or_else(|| "0".into());
    let inner = knots[..pieces.len()].iter().rev();
    inner.zip(pieces).fold(last, |rest, (knot, piece)| {
        format!("if({x} < {knot}, {piece}, {rest})")
    })
}

/// Straight lines between neighbouring points.
fn lines(x: &str, points: &[(String, String)]) -> Vec<String> {
    let windows = points.windows(2);
    let line = |w: &[(String, String)]| {
        let [(a, p), (b, q)] = [&w[0], &w[1]];
        format!("({p} + ({q} - {p})*({x} - {a})/({b} - {a}))")
    };
    windows.map(line).collect()
}

/// The cubics between neighbouring points of an exact spline, not-a-knot at the ends, whose
/// abscissae are in `unit`.
fn cubics(x: &str, [knots, values]: [&[Rational]; 2], unit: &str) -> Vec<String> {
    // The table has been checked by the solver's spline.
    let Ok(spline) = Spline::not_a_knot(knots, values) else {
        return Vec::new();
    };
    let cubic = |(i, knot): (usize, &Rational)| {
        let [y, first, second, third] = spline.eval_on(i, knot);
        let u = format!("({x}/{unit} - ({knot}))");
        let (second, third) = (second / 2u32, third / 6u32);
        format!("(({y}) + {u}*(({first}) + {u}*(({second}) + {u}*({third}))))")
    };
    let starts = &knots[..knots.len() - 1];
    starts.iter().enumerate().map(cubic).collect()
}

/// A motor and its load as formulas of the driven body's `speed` in rad/s and the time `t`.
#[derive(Clone, Debug)]
pub struct Formulas {
    /// The torque on the body, without the constant resistance.
    pub torque: String,
    /// The size of the constant resistance.
    pub friction: Option<String>,
    /// The inertia that turns with it, `0` if none.
    pub inertia: String,
    /// A condition under which the motor's torque is not known, if there is one.
    pub outside: Option<String>,
}

impl Drivetrain {
    /// Returns true if a constant resistance holds the body at rest.
    pub fn holds(&self) -> bool {
        self.load.constant.is_some()
    }

    /// The motor and its load as formulas.
    pub fn formulas(&self) -> Formulas {
        let m = &self.motor;
        let number = |x: Option<f64>| x.map_or("0".into(), |x| format!("({x})"));
        let ratio = number(Some(m.ratio.unwrap_or(1.0)));
        let speed = format!("({ratio}*speed)");
        let kloss = |pull_out: String, critical: String| {
            let slip = format!("(1 - {speed}/({}))", text(&m.synchronous_speed));
            format!("2*{pull_out}*{slip}*{critical}/({slip}^2 + ({critical})^2)")
        };
        let mut outside = None;
        let torque = match m.kind {
            MotorKind::Off => "0".into(),
            MotorKind::Constant => text(&m.torque),
            MotorKind::Linear => format!(
                "{}*(1 - {speed}/({}))",
                text(&m.standstill_torque),
                text(&m.no_load_speed)
            ),
            MotorKind::Kloss if m.critical_slip.is_some() => {
                kloss(text(&m.pull_out_torque), number(m.critical_slip))
            }
            MotorKind::Kloss => {
                let (k, slip) = (number(m.overload), number(m.rated_slip));
                let pull_out = format!("({k}*{})", text(&m.rated_torque));
                kloss(pull_out, format!("({slip}*({k} + sqrt({k}^2 - 1)))"))
            }
            MotorKind::Table => self.table(&speed, &mut outside),
        };
        let mut sum = format!("{ratio}*({torque})");
        if self.load.viscous.is_some() {
            sum += &format!(" - {}*speed", text(&self.load.viscous));
        }
        if self.load.quadratic.is_some() {
            sum += &format!(" - {}*speed*abs(speed)", text(&self.load.quadratic));
        }
        let inertia = match (&m.rotor_inertia, &m.flywheel) {
            (None, None) => "0".into(),
            (rotor, flywheel) => format!("({}*{ratio}^2 + {})", text(rotor), text(flywheel)),
        };
        Formulas {
            torque: sum,
            friction: self.load.constant.as_ref().map(quantity),
            inertia,
            outside,
        }
    }

    /// The torque of a table, and the condition under which it says nothing.
    fn table(&self, speed: &str, outside: &mut Option<String>) -> String {
        let points = self.motor.points.as_deref().unwrap_or_default();
        let torques: Vec<String> = points.iter().map(|p| format!("({})", p.1.value)).collect();
        let knot = |(x, _): &(Abscissa, Quantity<Torque>)| match x {
            Abscissa::Speed(x) => format!("({})", quantity(x)),
            Abscissa::Time(x) => format!("({})", quantity(x)),
        };
        let knots: Vec<String> = points.iter().map(knot).collect();
        let pairs: Vec<_> = knots.iter().cloned().zip(torques.iter().cloned()).collect();
        let (Some(first), Some(last)) = (knots.first(), knots.last()) else {
            return "0".into();
        };
        if let [(Abscissa::Time(_), _), ..] = points {
            let mut pieces = lines("t", &pairs);
            pieces.extend(torques.last().cloned());
            return nested("t", &knots[1..], pieces);
        }
        // The solver reads as far beyond both ends.
        let slack = format!("({last} - {first})/10^12");
        *outside = Some(format!(
            "if({speed} < {first} - {slack}, 1, if({speed} > {last} + {slack}, 1, 0))"
        ));
        let pieces = match self.motor.reading {
            Some(Reading::Cubic) => {
                let of = |p: &(Abscissa, Quantity<Torque>)| match &p.0 {
                    Abscissa::Speed(x) => (x.degrees, x.value.clone()),
                    Abscissa::Time(x) => (false, x.value.clone()),
                };
                let values: Vec<Rational> = points.iter().map(|p| p.1.value.clone()).collect();
                let (degrees, x): (Vec<bool>, Vec<Rational>) = points.iter().map(of).unzip();
                let unit = if degrees[0] { "(pi/180)" } else { "1" };
                cubics(speed, [&x, &values], unit)
            }
            _ => lines(speed, &pairs),
        };
        nested(speed, &knots[1..], pieces)
    }
}
