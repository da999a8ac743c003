//! Motor, reducer and resistance of a motion, as formulas too.

use super::{Abscissa, LoadSection, MotorKind, MotorSection, Reading, drive};
use crate::machine::quantity::Quantity;
use crate::machine::source::{Refusal, Source};
use crate::solvers::run_up::Drive;
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

/// A quantity as a formula in SI units and radians.
fn text<D>(quantity: &Option<Quantity<D>>) -> String {
    match quantity {
        Some(q) if q.degrees => format!("({})*pi/180", q.value),
        Some(q) => format!("({})", q.value),
        None => "0".into(),
    }
}

/// Straight lines through points, by nested conditions; beyond the ends the lines go on, or stay
/// where `flat`.
fn lines(x: &str, points: &[(String, String)], flat: bool) -> String {
    let between = |w: &[(String, String)]| {
        let [(a, p), (b, q)] = w else {
            return "0".into();
        };
        format!("({p} + ({q} - {p})*({x} - {a})/({b} - {a}))")
    };
    let last = match (points, flat) {
        ([.., (_, y)], true) => y.clone(),
        ([(_, y)], _) => y.clone(),
        _ => between(&points[points.len() - 2..]),
    };
    let windows: Vec<&[(String, String)]> = points.windows(2).collect();
    let used = if flat {
        &windows[..]
    } else {
        &windows[..windows.len().saturating_sub(1)]
    };
    used.iter().rev().fold(last, |rest, w| {
        format!("if({x} < {}, {}, {rest})", w[1].0, between(w))
    })
}

impl Drivetrain {
    /// The torque on the driven body as a formula of its `speed` in rad/s and the time `t`, and the
    /// inertia that turns with it.
    ///
    /// # Errors
    /// A part that has no formula: a table read by a cubic spline, a constant resistance, which
    /// holds a body at rest.
    pub fn formulas(&self) -> Result<(String, String), String> {
        let m = &self.motor;
        let number = |x: Option<f64>| x.map_or("0".into(), |x| format!("({x})"));
        let ratio = number(Some(m.ratio.unwrap_or(1.0)));
        let speed = format!("({ratio}*speed)");
        let kloss = |pull_out: String, critical: String| {
            let slip = format!("(1 - {speed}/({}))", text(&m.synchronous_speed));
            format!("2*{pull_out}*{slip}*{critical}/({slip}^2 + ({critical})^2)")
        };
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
            MotorKind::Table => {
                if matches!(m.reading, Some(Reading::Cubic)) {
                    return Err("a table read by a cubic spline has no formula for a motion".into());
                }
                let points = m.points.as_deref().unwrap_or_default();
                let timed = matches!(points, [(Abscissa::Time(_), _), ..]);
                let point = |(x, torque): &(Abscissa, Quantity<_>)| {
                    let (Abscissa::Time(x) | Abscissa::Speed(x)) = x;
                    (format!("({x})"), format!("({})", torque.value))
                };
                let points: Vec<(String, String)> = points.iter().map(point).collect();
                lines(if timed { "t" } else { &speed }, &points, timed)
            }
        };
        if self.load.constant.is_some() {
            let rule = "load.constant holds a body at rest, which a motion does not know; \
                 a formula in motion.torque may stand for it";
            return Err(rule.into());
        }
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
        Ok((sum, inertia))
    }
}
