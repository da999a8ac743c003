//! The file of a cam-driven oscillator.

use super::args::ChirpArgs;
use super::failure::Failure;
use super::fields::{Written, may, need, parse};
use super::linkage_file;
use super::quantity::{Kind, Quantity, nearest};
use mechaudit::audit::did_you_mean;
use mechaudit::solvers::cam_law::{CamCycle, CamLawError, MotionLaw, NAMES, Stroke};
use mechaudit::solvers::chirp_chart::{CamDrive, Period};
use mechaudit::solvers::chirp_oscillator::{Chirp, InitialState, Oscillator};
use mechaudit::solvers::cubic_spline::End;
use mechaudit::solvers::fourier_series::{FourierSeries, FourierSeriesError};
use serde::Deserialize;
use std::f64::consts::TAU;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: Option<String>,
    harmonics: Option<u32>,
    oscillator: OscillatorTable,
    cam: CamTable,
    speed: SpeedTable,
    #[serde(default)]
    initial: InitialTable,
    run: Option<RunTable>,
    chart: Option<ChartTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OscillatorTable {
    frequency: Option<Written>,
    damping: Option<Written>,
    damping_ratio: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CamTable {
    lift: Option<Written>,
    law: Law,
    return_law: Option<Law>,
    rise: Option<Written>,
    high_dwell: Option<Written>,
    #[serde(rename = "return")]
    fall: Option<Written>,
    low_dwell: Option<Written>,
    start: Option<Written>,
}

#[derive(Clone, Deserialize)]
#[serde(
    untagged,
    expecting = "a law is a name, or a table with one of name, scca (three shares), polynomial \
                 (coefficients), table (pairs), and perhaps acceleration_fraction"
)]
enum Law {
    Name(String),
    Table(LawTable),
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct LawTable {
    name: Option<String>,
    scca: Option<[f64; 3]>,
    polynomial: Option<Vec<f64>>,
    table: Option<Vec<[f64; 2]>>,
    acceleration_fraction: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SpeedTable {
    start: Option<Written>,
    acceleration: Option<Written>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct InitialTable {
    displacement: Option<Written>,
    velocity: Option<Written>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RunTable {
    duration: Option<Written>,
    step: Option<Written>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ChartTable {
    from: f64,
    to: f64,
    step: f64,
    period: Option<String>,
    laws: Option<Vec<String>>,
}

/// Rows over time.
pub struct Run {
    pub duration: f64,
    pub step: f64,
    pub rows: u64,
}

/// A chart and whose.
pub struct ChartPlan {
    pub grid: Vec<f64>,
    pub period: Period,
    /// Names of laws and what is driven by them.
    pub drives: Vec<(String, CamDrive)>,
}

/// What the file holds.
pub struct Machine {
    pub name: String,
    pub drive: CamDrive,
    pub law: String,
    /// `m` or `rad`.
    pub unit: &'static str,
    pub initial: Option<InitialState>,
    pub harmonics: u32,
    pub run: Option<Run>,
    pub chart: Option<ChartPlan>,
}

/// Rows of a run without a step.
const ROWS: f64 = 1000.0;
const MOST_ROWS: f64 = 1e10;
const MOST_POINTS: f64 = 1e5;
/// What the harmonics left out may come to, in lifts.
const TOLERANCE: f64 = 1e-4;
/// Nobody waits for more than these without having asked for them.
const MOST_UNASKED: u32 = 2000;
/// How far the harmonics are to reach beyond the resonance.
const REACH: f64 = 2.0;

/// Reads the machine that the arguments name.
pub fn read(args: &ChirpArgs) -> Result<Machine, Failure> {
    let (text, json) = linkage_file::text(&args.file)?;
    let about = |what: String| Failure::new(format!("{}: {what}", args.file.display()));
    let file: File = parse(&text, json).map_err(about)?;
    machine(args, file).map_err(about)
}

fn machine(args: &ChirpArgs, file: File) -> Result<Machine, String> {
    let oscillator = oscillator(&file.oscillator)?;
    let law = law(&file.cam.law).map_err(|e| format!("cam.law: {e}"))?;
    let falling = match &file.cam.return_law {
        Some(own) => self::law(own).map_err(|e| format!("cam.return_law: {e}"))?,
        None => law.clone(),
    };
    let (cycle, unit) = cycle(&file.cam, &law, &falling)?;
    let speed = may(Kind::AngularVelocity, "speed.start", &file.speed.start)?;
    let field = "speed.acceleration";
    let chirp = Chirp {
        omega0: speed.map_or(0.0, |q| q.to_f64()),
        eps: need(Kind::AngularAcceleration, field, &file.speed.acceleration)?.to_f64(),
    };
    let drive = CamDrive {
        oscillator,
        cycle,
        chirp,
    };
    let run = file.run.as_ref().map(run).transpose()?;
    let chart = match &file.chart {
        Some(table) => Some(chart(table, &file.cam, &drive)?),
        None => None,
    };
    let harmonics = match args.harmonics.or(file.harmonics) {
        Some(n) if (1..=100_000).contains(&n) => n,
        Some(n) => return Err(format!("harmonics = {n} must be between 1 and 100000")),
        None => harmonics(&drive, chart.as_ref())?,
    };
    Ok(Machine {
        name: file.name.unwrap_or_else(|| "cam-driven oscillator".into()),
        initial: initial(&file.initial, unit)?,
        law: label(&file.cam.law),
        drive,
        unit,
        harmonics,
        run,
        chart,
    })
}

fn oscillator(table: &OscillatorTable) -> Result<Oscillator, String> {
    let w = need(
        Kind::AngularVelocity,
        "oscillator.frequency",
        &table.frequency,
    )?
    .to_f64();
    let damping = may(Kind::AngularVelocity, "oscillator.damping", &table.damping)?;
    let n = match (damping, table.damping_ratio) {
        (Some(n), None) => n.to_f64(),
        (None, Some(ratio)) => ratio * w,
        (None, None) => return Err("oscillator.damping is missing, or damping_ratio".into()),
        (Some(_), Some(_)) => {
            return Err(
                "oscillator.damping and oscillator.damping_ratio exclude each other".into(),
            );
        }
    };
    Oscillator::new(w, n).map_err(|e| format!("oscillator: {e}"))
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

/// What is wrong with a law, and which one may have been meant.
fn said(e: CamLawError) -> String {
    let meant = match &e {
        CamLawError::UnknownLaw { name } => did_you_mean(name, &NAMES),
        _ => String::new(),
    };
    format!("{e}{meant}")
}

fn law(law: &Law) -> Result<MotionLaw, String> {
    let table = match law {
        Law::Name(name) => return MotionLaw::by_name(name).map_err(said),
        Law::Table(table) => table,
    };
    let made = match (&table.name, table.scca, &table.polynomial, &table.table) {
        (Some(name), None, None, None) => MotionLaw::by_name(name),
        (None, Some([b, c, d]), None, None) => MotionLaw::scca(b, c, d),
        (None, None, Some(p), None) => MotionLaw::polynomial(p),
        (None, None, None, Some(points)) => {
            let (x, y) = points.iter().map(|p| (p[0], p[1])).unzip();
            MotionLaw::tabulated(x, y, [End::FirstDerivative(0.0); 2])
        }
        _ => return Err("exactly one of name, scca, polynomial and table is due".into()),
    };
    let made = made.map_err(said)?;
    match table.acceleration_fraction {
        Some(fraction) => made.with_acceleration_fraction(fraction).map_err(said),
        None => Ok(made),
    }
}

/// An angle in turns; one in degrees is divided exactly.
fn turns(angle: &Quantity) -> f64 {
    match angle.degrees {
        true => nearest(&(angle.value.clone() / 360u32)),
        false => angle.to_f64() / TAU,
    }
}

fn cycle(
    cam: &CamTable,
    rising: &MotionLaw,
    falling: &MotionLaw,
) -> Result<(CamCycle, &'static str), String> {
    let angle = |field: &str, written: &Option<Written>| {
        need(Kind::Angle, &format!("cam.{field}"), written).map(|q| turns(&q))
    };
    let (lift, unit) = match may(Kind::Length, "cam.lift", &cam.lift) {
        Ok(Some(length)) => (length.to_f64(), "m"),
        Ok(None) => return Err("cam.lift is missing".into()),
        Err(e) => match may(Kind::Angle, "cam.lift", &cam.lift) {
            Ok(Some(angle)) => (angle.to_f64(), "rad"),
            _ => return Err(format!("{e} (or an angle)")),
        },
    };
    let stroke = |law: &MotionLaw, turns| Stroke {
        law: law.clone(),
        turns,
    };
    let cycle = CamCycle::new(
        lift,
        stroke(rising, angle("rise", &cam.rise)?),
        angle("high_dwell", &cam.high_dwell)?,
        stroke(falling, angle("return", &cam.fall)?),
        angle("low_dwell", &cam.low_dwell)?,
    );
    let start = may(Kind::Angle, "cam.start", &cam.start)?;
    let cycle = cycle.and_then(|c| c.starting_at(start.map_or(0.0, |q| turns(&q))));
    Ok((cycle.map_err(|e| format!("cam: {e}"))?, unit))
}

fn initial(table: &InitialTable, unit: &str) -> Result<Option<InitialState>, String> {
    let (place, rate) = match unit {
        "m" => (Kind::Length, Kind::Velocity),
        _ => (Kind::Angle, Kind::AngularVelocity),
    };
    let displacement = may(place, "initial.displacement", &table.displacement)?;
    let velocity = may(rate, "initial.velocity", &table.velocity)?;
    Ok(match (displacement, velocity) {
        (None, None) => None,
        (y, v) => Some(InitialState {
            displacement: y.map_or(0.0, |q| q.to_f64()),
            velocity: v.map_or(0.0, |q| q.to_f64()),
        }),
    })
}

fn run(table: &RunTable) -> Result<Run, String> {
    let duration = need(Kind::Time, "run.duration", &table.duration)?.to_f64();
    let step = may(Kind::Time, "run.step", &table.step)?;
    let step = step.map_or(duration / ROWS, |q| q.to_f64());
    if !(duration > 0.0) {
        return Err(format!("run.duration = {duration} s must be positive"));
    }
    if !(step > 0.0 && duration / step <= MOST_ROWS) {
        return Err(format!(
            "run.step = {step} s must be positive and give at most 1e10 rows"
        ));
    }
    // A duration that is a whole number of steps within rounding ends with a row.
    let rows = (duration / step * (1.0 + 1e-12)).floor() as u64 + 1;
    Ok(Run {
        duration,
        step,
        rows,
    })
}

fn chart(table: &ChartTable, cam: &CamTable, drive: &CamDrive) -> Result<ChartPlan, String> {
    let ChartTable { from, to, step, .. } = *table;
    if !(from > 0.0 && to >= from && to.is_finite()) {
        return Err(format!(
            "chart.from = {from} and chart.to = {to} must be positive numbers in ascending order"
        ));
    }
    if !(step > 0.0 && (to - from) / step <= MOST_POINTS) {
        return Err(format!(
            "chart.step = {step} must be positive and give at most 1e5 points"
        ));
    }
    let period = match table.period.as_deref() {
        None | Some("rise") => Period::Rise,
        Some("turn") => Period::Turn,
        Some(other) => {
            return Err(format!(
                "chart.period = {other:?} must be \"rise\" or \"turn\""
            ));
        }
    };
    let last = ((to - from) / step * (1.0 + 1e-12)).floor() as u32;
    let grid: Vec<f64> = (0..=last).map(|k| from + f64::from(k) * step).collect();
    for xi in &grid {
        drive
            .time_of(*xi, period)
            .map_err(|e| format!("chart: {e}"))?;
    }
    let drives = match &table.laws {
        None => vec![(label(&cam.law), drive.clone())],
        Some(names) => {
            let one = |name: &String| {
                let law =
                    MotionLaw::by_name(name).map_err(|e| format!("chart.laws: {}", said(e)))?;
                let mut drive = drive.clone();
                (drive.cycle, _) = cycle(cam, &law, &law)?;
                Ok::<_, String>((name.clone(), drive))
            };
            names.iter().map(one).collect::<Result<_, _>>()?
        }
    };
    if drives.is_empty() {
        return Err("chart.laws names no law".into());
    }
    Ok(ChartPlan {
        grid,
        period,
        drives,
    })
}

/// As many as leave a small part of the lift, and enough for the slowest point of a chart.
fn harmonics(drive: &CamDrive, chart: Option<&ChartPlan>) -> Result<u32, String> {
    let own = std::iter::once(drive);
    let all = own.chain(chart.iter().flat_map(|c| c.drives.iter().map(|(_, d)| d)));
    let mut most = 1;
    for drive in all {
        let series = FourierSeries::new(&drive.cycle);
        let tolerance = TOLERANCE * drive.cycle.lift().abs();
        match series.harmonics_for(tolerance, 0) {
            Ok(n) if n <= MOST_UNASKED => most = most.max(n),
            Ok(n) => {
                return Err(format!(
                    "{n} harmonics would be needed to leave {TOLERANCE} of the lift; say how many \
                     are to be taken: harmonics = ..."
                ));
            }
            Err(
                e @ FourierSeriesError::TooMany { .. } | e @ FourierSeriesError::Diverges { .. },
            ) => {
                return Err(format!(
                    "{e}; say how many are to be taken: harmonics = ..."
                ));
            }
            Err(e) => return Err(e.to_string()),
        }
    }
    let slowest = chart.and_then(|c| c.grid.last().map(|xi| (xi, c.period)));
    let reach = slowest.map_or(0.0, |(xi, period)| match period {
        Period::Turn => REACH * xi,
        Period::Rise => REACH * xi / drive.cycle.rise().turns,
    });
    Ok(most.max(reach.ceil() as u32).min(100_000))
}
