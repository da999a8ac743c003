//! A branch as it is shown: in motion on a page, and a position of it in a DXF file.

use crate::cli::args::{LinkageArgs, RowsFormat};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use mechaudit::machine::crank_angles::{Grid, Plan};
use mechaudit::machine::{class_iii, dyad, planar};
use mechaudit::motion::Motion;
use mechaudit::reference::nearest_f64;
use mechaudit::report::columns::Columns;
use mechaudit::report::rows::Form;
use mechaudit::report::svg::linkage::SAMPLES;
use mechaudit::report::{dxf, html};
use mechaudit::solvers::dyad::Assembly;
use mechaudit::solvers::units::Angle;
use mechaudit::symbolic;
use rug::Rational;
use std::io::Write;

/// The form of rows where a page is refused before.
pub fn rows(format: RowsFormat) -> Form {
    format.rows().unwrap_or(Form::Json)
}

/// Returns true if a unit is one of length.
pub fn is_length(name: &str) -> bool {
    let dimension = |n: &str| symbolic::unit(n.trim()).ok().map(|u| u.dimension);
    dimension(name).is_some_and(|d| Some(d) == dimension("m"))
}

/// Writes the page.
pub fn page(out: &mut dyn Write, motion: &Motion, lines: &[String]) -> Result<Outcome, Failure> {
    if motion.drive.values.is_empty() {
        return Err(Failure::new(
            "no value of the drive asked for lies in the range of the branch: there is nothing to show",
        ));
    }
    out.write_all(html::linkage::page(motion, lines).as_bytes())?;
    Ok(Outcome::AsExpected)
}

/// The DXF file.
pub struct Cad {
    file: Output,
    unit: dxf::Unit,
}

impl Cad {
    /// `mechanism.dxf` in the folder, which is made if missing, if it is asked for.
    pub fn open(args: &LinkageArgs) -> Result<Option<Cad>, Failure> {
        let Some(folder) = &args.dxf else {
            return Ok(None);
        };
        let length = args.units.units.iter().find(|u| is_length(u));
        let unit = dxf::Unit::of(length.map_or("m", |u| u.trim())).map_err(Failure::caused)?;
        let file = Output::within(folder, "mechanism.dxf")?;
        Ok(Some(Cad { file, unit }))
    }

    pub fn draw(self, motion: Motion) -> Result<(), Failure> {
        let bytes = dxf::draw(&motion, &self.unit).map_err(Failure::caused)?;
        self.file.write(|out| Ok(out.write_all(&bytes)?))
    }
}

impl LinkageArgs {
    /// Returns true if the arguments say at which values of the drive.
    fn asks_for_window(&self) -> bool {
        self.step_deg.is_some() || self.from_deg.is_some() || self.to_deg.is_some()
    }

    /// The first crank angle in degrees, if it is given.
    fn from(&self) -> Option<f64> {
        self.from_deg.as_ref().map(|d| nearest_f64(&d.value))
    }

    fn unreached(&self) -> Failure {
        let from = self.from().unwrap_or_default();
        Failure::new(format!("the branch does not reach --from-deg {from}"))
    }
}

/// In motion: at the angles of the plan if the arguments ask for a window, else over all that there
/// is; with the columns' values. Without these for a drawing of the position at `--from-deg`, which
/// itself asks for a window, or the start.
pub fn class_iii(
    args: &LinkageArgs,
    linkage: &class_iii::Linkage,
    branch: &class_iii::Branch,
    page: Option<(&Plan, &Columns)>,
) -> Result<Motion, Failure> {
    let solver = &linkage.solver;
    let turns = branch.reach.turns();
    let (states, start, closed) = match page {
        Some((plan, _)) if args.asks_for_window() => {
            let mut angles: Vec<Rational> = plan.angles().map(|a| a.1).collect();
            angles.sort();
            angles.dedup();
            let angles = angles.iter().map(|a| Angle::from_deg(nearest_f64(a)));
            let states = solver.sweep(&branch.start, angles);
            let states = states.map_err(|e| Failure::caused(e.1))?;
            (states, 0, args.to_deg.is_none() && turns == Some(1))
        }
        _ => {
            let shown = match args.from() {
                None => branch.start,
                Some(degrees) => {
                    let at =
                        on_branch(degrees.to_radians(), branch).ok_or_else(|| args.unreached())?;
                    let followed = solver.follow(&branch.start, Angle::from_rad(at));
                    followed.map_err(Failure::caused)?
                }
            };
            let found = class_iii::positions(linkage, branch, SAMPLES, &shown);
            let (states, start) = found.map_err(Failure::caused)?;
            (states, start, turns.is_some())
        }
    };
    let mut motion = class_iii::motion(linkage, &states, start, closed);
    if let Some((_, columns)) = page {
        let rows: Vec<Vec<f64>> = states
            .iter()
            .map(|s| class_iii::values(linkage, s))
            .collect();
        motion.courses = html::linkage::courses(columns, &rows);
    }
    Ok(motion)
}

/// An angle in radians on the branch's own count of turns, if it is reached.
pub fn on_branch(angle: f64, branch: &class_iii::Branch) -> Option<f64> {
    let class_iii::Reach::Part { low, high } = branch.reach else {
        return Some(angle);
    };
    let at = low.reached + (angle - low.reached).rem_euclid(std::f64::consts::TAU);
    (at <= high.reached).then_some(at)
}

/// In ascending order, each once: whole turns taken off an angle leave a rounding.
fn in_order(angles: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = angles.collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|later, kept| *later - *kept < 1e-11);
    all
}

/// As [`class_iii`].
pub fn dyad(
    args: &LinkageArgs,
    dyad: &dyad::Dyad,
    assembly: Assembly,
    page: Option<(&Grid, &Columns)>,
    further: Option<&planar::Further>,
) -> Result<Motion, Failure> {
    let (all, start, closed) = match page {
        Some((grid, _)) if args.asks_for_window() => {
            let ([from, to], whole) = dyad::range(dyad);
            let angles = (0..grid.count as i64).map(|k| nearest_f64(&grid.angle(k)));
            let turned = |d: f64| {
                if whole {
                    d
                } else {
                    from + (d - from).rem_euclid(360.0)
                }
            };
            let all = angles.map(turned).filter(|d| whole || *d <= to);
            (in_order(all), 0, whole && args.to_deg.is_none())
        }
        _ => {
            let from = args.from();
            let shown = from.or(dyad.start.as_ref().map(nearest_f64)).unwrap_or(0.0);
            if from.is_some() && dyad::position(dyad, assembly, shown).is_none() {
                return Err(args.unreached());
            }
            dyad::drives(dyad, SAMPLES, shown)
        }
    };
    let mut positions = Vec::new();
    let mut rows = Vec::new();
    let mut first = 0;
    for (k, degrees) in all.iter().enumerate() {
        let exact = Rational::from_f64(*degrees).unwrap_or_default();
        let row = dyad::floating(dyad, &exact, assembly).map_err(Failure::caused)?;
        // At the ends of a range the dyad is singular.
        let position = dyad::position(dyad, assembly, *degrees);
        if let Some((position, row)) = position.zip(row) {
            if k == start {
                first = positions.len();
            }
            positions.push(position);
            let more = further.map(|f| f.values(*degrees, &row));
            rows.push([&row[..], &more.unwrap_or_default()].concat());
        }
    }
    let mut motion = dyad::motion(dyad, &positions, first, closed);
    if let Some((_, columns)) = page {
        motion.courses = html::linkage::courses(columns, &rows);
    }
    Ok(motion)
}

/// The rows of a mechanism's page.
pub struct Window<'a> {
    /// Values of the drive as shown and in radians or metres.
    pub drives: &'a [(f64, f64)],
    pub named: &'a Columns,
    pub columns: planar::Columns,
}

/// As [`class_iii`].
pub fn planar(
    args: &LinkageArgs,
    machine: &planar::Machine,
    branch: &planar::Branch,
    page: Option<Window>,
) -> Result<Motion, Failure> {
    let solver = &machine.solver;
    let turns = branch.reach.turns();
    let (positions, start, closed) = match &page {
        Some(window) if args.asks_for_window() && machine.rotary() => {
            let drives = window.drives.iter();
            let drives = drives.filter_map(|d| branch.turned_to(machine, d.1));
            let mut here = branch.start.clone();
            let mut all = Vec::new();
            for drive in in_order(drives) {
                let next = solver.follow(&here, machine.inner(drive));
                here = next.map_err(Failure::caused)?;
                all.push((drive, here.clone()));
            }
            (all, 0, args.to_deg.is_none() && turns == Some(1))
        }
        _ => {
            let shown = match args.from() {
                None => branch.start.clone(),
                Some(degrees) => {
                    let at = branch.turned_to(machine, degrees.to_radians());
                    let at = at.ok_or_else(|| args.unreached())?;
                    let followed = solver.follow(&branch.start, machine.inner(at));
                    followed.map_err(Failure::caused)?
                }
            };
            let (all, start) = planar::positions(machine, branch, SAMPLES, &shown);
            (all, start, turns.is_some())
        }
    };
    let mut motion = planar::motion(machine, &positions, start, closed);
    if let Some(Window { named, columns, .. }) = page {
        let rows = positions
            .iter()
            .map(|(_, s)| planar::values(machine, branch.loads.as_ref(), s, columns));
        motion.courses = html::linkage::courses(named, &rows.collect::<Vec<_>>());
    }
    Ok(motion)
}
