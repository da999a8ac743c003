//! A cam-driven oscillator whose shaft changes speed, as its file describes it.

use super::quantity::{AngularAcceleration, Dimension, Quantity, Time, Velocity, Written};
use super::source::{Refusal, Source};
use crate::audit::did_you_mean;
use crate::solvers::cam_law::{CamCycle, CamLawError, MotionLaw, NAMES, Stroke};
use crate::solvers::chirp_chart::{CamDrive, CamResponse, Chart, ChirpChartError, Period};
use crate::solvers::chirp_oscillator::{Chirp, InitialState, Oscillator};
use crate::solvers::cubic_spline::End;
use crate::solvers::fourier_series::{FourierSeries, FourierSeriesError};
use crate::solvers::units::{Angle, AngularVelocity, Length};
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error as _, MapAccess, Visitor};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: Option<String>,
    harmonics: Option<u32>,
    oscillator: OscillatorSection,
    cam: CamSection,
    speed: SpeedSection,
    #[serde(default)]
    initial: InitialSection,
    run: Option<RunSection>,
    chart: Option<ChartSection>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OscillatorSection {
    frequency: Quantity<AngularVelocity>,
    damping: Option<Quantity<AngularVelocity>>,
    damping_ratio: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CamSection {
    lift: Either<Length, Angle>,
    law: Law,
    return_law: Option<Law>,
    rise: Quantity<Angle>,
    high_dwell: Quantity<Angle>,
    #[serde(rename = "return")]
    fall: Quantity<Angle>,
    low_dwell: Quantity<Angle>,
    start: Option<Quantity<Angle>>,
}

/// A quantity of a slider, or of a rocker.
enum Either<A, B> {
    Slider(Quantity<A>),
    Rocker(Quantity<B>),
}

impl<'de, A: Dimension, B: Dimension> Deserialize<'de> for Either<A, B> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Either<A, B>, D::Error> {
        from.deserialize_any(Written(|text: &str| {
            text.parse().map(Either::Slider).or_else(|e| {
                let other = text.parse().map(Either::Rocker);
                other.map_err(|_| format!("{e} (or {})", B::NAME))
            })
        }))
    }
}

impl<A, B> Either<A, B> {
    fn to_f64(&self) -> f64 {
        match self {
            Either::Slider(q) => q.to_f64(),
            Either::Rocker(q) => q.to_f64(),
        }
    }

    /// The unit of the follower's displacement.
    fn unit(&self) -> &'static str {
        match self {
            Either::Slider(_) => "m",
            Either::Rocker(_) => "rad",
        }
    }
}

/// A law of motion: its name, or a section.
#[derive(Clone)]
enum Law {
    Name(String),
    Table(LawSection),
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct LawSection {
    name: Option<String>,
    scca: Option<[f64; 3]>,
    polynomial: Option<Vec<f64>>,
    table: Option<Vec<[f64; 2]>>,
    acceleration_fraction: Option<f64>,
}

impl<'de> Deserialize<'de> for Law {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Law, D::Error> {
        struct V;
        impl<'de> Visitor<'de> for V {
            type Value = Law;
            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str(
                    "the name of a law, or a section with one of name, scca (three shares), \
                     polynomial (coefficients), table (pairs), and perhaps acceleration_fraction",
                )
            }
            fn visit_str<E>(self, name: &str) -> Result<Law, E> {
                Ok(Law::Name(name.into()))
            }
            fn visit_map<M: MapAccess<'de>>(self, map: M) -> Result<Law, M::Error> {
                LawSection::deserialize(MapAccessDeserializer::new(map)).map(Law::Table)
            }
        }
        from.deserialize_any(V)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SpeedSection {
    start: Option<Quantity<AngularVelocity>>,
    acceleration: Quantity<AngularAcceleration>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct InitialSection {
    displacement: Option<Either<Length, Angle>>,
    velocity: Option<Either<Velocity, AngularVelocity>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RunSection {
    duration: Quantity<Time>,
    step: Option<Quantity<Time>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ChartSection {
    from: f64,
    to: f64,
    step: f64,
    #[serde(default = "rise", deserialize_with = "period")]
    period: Period,
    laws: Option<Vec<String>>,
}

fn rise() -> Period {
    Period::Rise
}

fn period<'de, D: Deserializer<'de>>(from: D) -> Result<Period, D::Error> {
    match String::deserialize(from)?.as_str() {
        "rise" => Ok(Period::Rise),
        "turn" => Ok(Period::Turn),
        other => Err(D::Error::unknown_variant(other, &["rise", "turn"])),
    }
}

/// Rows over time.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// In seconds.
    pub duration: f64,
    /// In seconds.
    pub step: f64,
    /// Their number.
    pub rows: u64,
}

/// A chart and whose.
pub struct ChartPlan {
    /// Frequency criteria.
    pub grid: Vec<f64>,
    /// Which period the criterion is taken with.
    pub period: Period,
    /// Names of laws and what is driven by them.
    pub drives: Vec<(String, CamDrive)>,
}

/// The chart of a law.
pub struct LawChart {
    /// The law's name.
    pub law: String,
    /// Its chart.
    pub chart: Chart,
}

/// An oscillator with its cam and its shaft.
pub struct CamOscillator {
    /// Its name, or one for all.
    pub name: String,
    /// Oscillator, cam and shaft.
    pub drive: CamDrive,
    /// The name of the cam's law.
    pub law: String,
    /// The unit of the follower's displacement, `m` or `rad`.
    pub unit: &'static str,
    /// Where it starts; the follower follows the cam otherwise.
    pub initial: Option<InitialState>,
    /// Harmonics of the cam's displacement that are taken.
    pub harmonics: u32,
    /// The motion over time, if asked for.
    pub run: Option<Run>,
    /// The chart over the frequency criterion, if asked for.
    pub chart: Option<ChartPlan>,
}

/// Rows of a run without a step.
const ROWS: f64 = 1000.0;
const MOST_ROWS: f64 = 1e10;
const MOST_POINTS: f64 = 1e5;
const MOST_HARMONICS: u32 = 100_000;
/// A bound on the harmonics left out, in lifts.
const TOLERANCE: f64 = 1e-4;
/// Nobody waits for more than these without having asked for them.
const MOST_UNASKED: u32 = 2000;
/// The factor by which the harmonics reach beyond the resonance.
const REACH: f64 = 2.0;

impl CamOscillator {
    /// Reads the description of a cam-driven oscillator; `harmonics` stands in place of the file's.
    ///
    /// ```
    /// use mechaudit_cli::machine::{CamOscillator, Source};
    /// let source = Source::toml(include_str!(concat!(
    ///     env!("CARGO_MANIFEST_DIR"), "/../../examples/chirp-run-up.toml"
    /// )));
    /// let machine = CamOscillator::read(&source, Some(50))?;
    /// let state = machine.response(&machine.drive)?.state(0.1)?;
    /// assert!(state.displacement.is_finite());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn read(source: &Source, harmonics: Option<u32>) -> Result<CamOscillator, Refusal> {
        let file: File = source.parse()?;
        let rising = law(source, "cam.law", &file.cam.law)?;
        let falling = match &file.cam.return_law {
            Some(own) => law(source, "cam.return_law", own)?,
            None => rising.clone(),
        };
        let speed = &file.speed;
        let drive = CamDrive {
            oscillator: oscillator(source, &file.oscillator)?,
            cycle: cycle(source, &file.cam, &rising, &falling)?,
            chirp: Chirp {
                omega0: speed.start.as_ref().map_or(0.0, Quantity::to_f64),
                eps: speed.acceleration.to_f64(),
            },
        };
        let run = file.run.as_ref().map(|section| run(source, section));
        let chart = file.chart.as_ref();
        let chart = chart.map(|section| chart_plan(source, section, &file.cam, &drive));
        let chart = chart.transpose()?;
        let harmonics = match harmonics.or(file.harmonics) {
            Some(n) if (1..=MOST_HARMONICS).contains(&n) => n,
            Some(n) => {
                let rule = format!("harmonics = {n} must be between 1 and {MOST_HARMONICS}");
                return Err(source.breach("harmonics", rule));
            }
            None => enough_harmonics(source, &drive, chart.as_ref())?,
        };
        Ok(CamOscillator {
            name: file.name.unwrap_or_else(|| "cam-driven oscillator".into()),
            initial: initial(source, &file.initial, &file.cam.lift)?,
            law: label(&file.cam.law),
            drive,
            unit: file.cam.lift.unit(),
            harmonics,
            run: run.transpose()?,
            chart,
        })
    }

    /// The response to a drive, with this oscillator's harmonics and start.
    ///
    /// # Errors
    /// [`ChirpChartError`].
    pub fn response(&self, drive: &CamDrive) -> Result<CamResponse, ChirpChartError> {
        CamResponse::new(drive.clone(), self.harmonics, self.initial)
    }

    /// The charts of all laws; none where the file asks for none.
    ///
    /// # Errors
    /// [`ChirpChartError`].
    pub fn charts(&self) -> Result<Vec<LawChart>, ChirpChartError> {
        let Some(plan) = &self.chart else {
            return Ok(Vec::new());
        };
        let one = |(law, drive): &(String, CamDrive)| {
            let chart = Chart::new(&self.response(drive)?, plan.period, &plan.grid)?;
            let law = law.clone();
            Ok(LawChart { law, chart })
        };
        plan.drives.iter().map(one).collect()
    }
}

fn oscillator(source: &Source, section: &OscillatorSection) -> Result<Oscillator, Refusal> {
    let w = section.frequency.to_f64();
    let n = match (&section.damping, section.damping_ratio) {
        (Some(n), None) => n.to_f64(),
        (None, Some(ratio)) => ratio * w,
        (None, None) => {
            let rule = "oscillator.damping is missing, or damping_ratio";
            return Err(source.breach("oscillator", rule));
        }
        (Some(_), Some(_)) => {
            let rule = "oscillator.damping and oscillator.damping_ratio exclude each other";
            return Err(source.breach("oscillator.damping_ratio", rule));
        }
    };
    Oscillator::new(w, n).map_err(|e| source.refuse("oscillator", e))
}

fn label(law: &Law) -> String {
    match law {
        Law::Name(name) => name.clone(),
        Law::Table(t) => match (&t.name, &t.scca, &t.polynomial) {
            (Some(name), ..) => name.clone(),
            (_, Some([b, c, d]), _) => format!("scca {b} {c} {d}"),
            (_, _, Some(_)) => "polynomial".into(),
            _ => "table".into(),
        },
    }
}

/// A law that there is not, and which one may have been meant.
fn refused(source: &Source, place: &str, e: CamLawError) -> Refusal {
    match &e {
        CamLawError::UnknownLaw { name } => {
            let meant = did_you_mean(name, &NAMES);
            source.breach(place, format!("{place}: {e}{meant}"))
        }
        _ => source.refuse(place, e),
    }
}

fn law(source: &Source, place: &str, law: &Law) -> Result<MotionLaw, Refusal> {
    let made = match law {
        Law::Name(name) => MotionLaw::by_name(name),
        Law::Table(LawSection {
            name,
            scca,
            polynomial,
            table,
            acceleration_fraction,
        }) => {
            let made = match (name, scca, polynomial, table) {
                (Some(name), None, None, None) => MotionLaw::by_name(name),
                (None, Some([b, c, d]), None, None) => MotionLaw::scca(*b, *c, *d),
                (None, None, Some(p), None) => MotionLaw::polynomial(p),
                (None, None, None, Some(points)) => {
                    let (x, y) = points.iter().map(|p| (p[0], p[1])).unzip();
                    MotionLaw::tabulated(x, y, [End::FirstDerivative(0.0); 2])
                }
                _ => {
                    let rule = "exactly one of name, scca, polynomial and table is due";
                    return Err(source.breach(place, format!("{place}: {rule}")));
                }
            };
            match acceleration_fraction {
                Some(fraction) => made.and_then(|m| m.with_acceleration_fraction(*fraction)),
                None => made,
            }
        }
    };
    made.map_err(|e| refused(source, place, e))
}

fn cycle(
    source: &Source,
    cam: &CamSection,
    rising: &MotionLaw,
    falling: &MotionLaw,
) -> Result<CamCycle, Refusal> {
    let stroke = |law: &MotionLaw, angle: &Quantity<Angle>| Stroke {
        law: law.clone(),
        turns: angle.in_turns(),
    };
    let cycle = CamCycle::new(
        cam.lift.to_f64(),
        stroke(rising, &cam.rise),
        cam.high_dwell.in_turns(),
        stroke(falling, &cam.fall),
        cam.low_dwell.in_turns(),
    );
    let cycle = match &cam.start {
        Some(start) => cycle.and_then(|c| c.starting_at(start.in_turns())),
        None => cycle,
    };
    cycle.map_err(|e| source.refuse("cam", e))
}

fn initial(
    source: &Source,
    section: &InitialSection,
    lift: &Either<Length, Angle>,
) -> Result<Option<InitialState>, Refusal> {
    let due = |place, fits: bool, names: [&str; 2]| match fits {
        true => Ok(()),
        false => {
            let name = names[usize::from(lift.unit() == "rad")];
            Err(source.breach(
                place,
                format!("{place} must be {name}, as cam.lift is given"),
            ))
        }
    };
    let (y, v) = (&section.displacement, &section.velocity);
    if let Some(y) = y {
        let names = [Length::NAME, Angle::NAME];
        due("initial.displacement", y.unit() == lift.unit(), names)?;
    }
    if let Some(v) = v {
        let names = [Velocity::NAME, AngularVelocity::NAME];
        due("initial.velocity", v.unit() == lift.unit(), names)?;
    }
    Ok((y.is_some() || v.is_some()).then(|| InitialState {
        displacement: y.as_ref().map_or(0.0, Either::to_f64),
        velocity: v.as_ref().map_or(0.0, Either::to_f64),
    }))
}

fn run(source: &Source, section: &RunSection) -> Result<Run, Refusal> {
    let duration = section.duration.to_f64();
    let step = section
        .step
        .as_ref()
        .map_or(duration / ROWS, Quantity::to_f64);
    if !(duration > 0.0) {
        let rule = format!("run.duration = {duration} s must be positive");
        return Err(source.breach("run.duration", rule));
    }
    if !(step > 0.0 && duration / step <= MOST_ROWS) {
        let rule = format!("run.step = {step} s must be positive and give at most 1e10 rows");
        return Err(source.breach("run.step", rule));
    }
    // A duration that is a whole number of steps within rounding ends with a row.
    let rows = (duration / step * (1.0 + 1e-12)).floor() as u64 + 1;
    Ok(Run {
        duration,
        step,
        rows,
    })
}

fn chart_plan(
    source: &Source,
    section: &ChartSection,
    cam: &CamSection,
    drive: &CamDrive,
) -> Result<ChartPlan, Refusal> {
    let ChartSection {
        from,
        to,
        step,
        period,
        ..
    } = *section;
    if !(from > 0.0 && to >= from && to.is_finite()) {
        let rule = format!(
            "chart.from = {from} and chart.to = {to} must be positive numbers in ascending order"
        );
        return Err(source.breach("chart.from", rule));
    }
    if !(step > 0.0 && (to - from) / step <= MOST_POINTS) {
        let rule = format!("chart.step = {step} must be positive and give at most 1e5 points");
        return Err(source.breach("chart.step", rule));
    }
    let last = ((to - from) / step * (1.0 + 1e-12)).floor() as u32;
    let grid: Vec<f64> = (0..=last).map(|k| from + f64::from(k) * step).collect();
    for xi in &grid {
        let time = drive.time_of(*xi, period);
        time.map_err(|e| source.refuse("chart", e))?;
    }
    let drives = match &section.laws {
        None => vec![(label(&cam.law), drive.clone())],
        Some(names) => {
            let one = |name: &String| {
                let law = MotionLaw::by_name(name);
                let law = law.map_err(|e| refused(source, "chart.laws", e))?;
                let mut drive = drive.clone();
                drive.cycle = cycle(source, cam, &law, &law)?;
                Ok((name.clone(), drive))
            };
            names.iter().map(one).collect::<Result<_, Refusal>>()?
        }
    };
    if drives.is_empty() {
        return Err(source.breach("chart.laws", "chart.laws names no law"));
    }
    Ok(ChartPlan {
        grid,
        period,
        drives,
    })
}

/// As many as leave a small part of the lift, and enough for the slowest point of a chart.
fn enough_harmonics(
    source: &Source,
    drive: &CamDrive,
    chart: Option<&ChartPlan>,
) -> Result<u32, Refusal> {
    let own = std::iter::once(drive);
    let all = own.chain(chart.iter().flat_map(|c| c.drives.iter().map(|(_, d)| d)));
    let mut most = 1;
    for drive in all {
        let series = FourierSeries::new(&drive.cycle);
        let tolerance = TOLERANCE * drive.cycle.lift().abs();
        match series.harmonics_for(tolerance, 0) {
            Ok(n) if n <= MOST_UNASKED => most = most.max(n),
            Ok(n) => {
                let rule = format!(
                    "{n} harmonics would be needed to leave {TOLERANCE} of the lift; say how many \
                     are to be taken: harmonics = ..."
                );
                return Err(source.breach("cam", rule));
            }
            Err(
                e @ FourierSeriesError::TooMany { .. } | e @ FourierSeriesError::Diverges { .. },
            ) => {
                let rule = format!("{e}; say how many are to be taken: harmonics = ...");
                return Err(source.breach("cam", rule));
            }
            Err(e) => return Err(source.refuse("cam", e)),
        }
    }
    let slowest = chart.and_then(|c| c.grid.last().map(|xi| (xi, c.period)));
    let reach = slowest.map_or(0.0, |(xi, period)| match period {
        Period::Turn => REACH * xi,
        Period::Rise => REACH * xi / drive.cycle.rise().turns,
    });
    Ok(most.max(reach.ceil() as u32).min(MOST_HARMONICS))
}

#[cfg(test)]
mod tests;
