//! A linkage given in a file, computed over the turn of its crank.

mod drawing;
mod dyad;
mod dyad_facts;
pub mod facts;
mod planar;
mod planar_facts;
mod shown;

use crate::cli::args::{LinkageArgs, RowsFormat};
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::files::source;
use crate::cli::progress::Progress;
use drawing::Drawings;
use mechaudit::machine;
use mechaudit::machine::class_iii::{self, Branch, Certifier, Linkage};
use mechaudit::machine::crank_angles::{Grid, GridError, Plan, Window, decimal, plan};
use mechaudit::reference::nearest_f64;
use mechaudit::report::cell::Cell;
use mechaudit::report::columns::{self, Columns};
use mechaudit::report::rows::Rows;
use mechaudit::solvers::class_iii::BranchMap;
use mechaudit::solvers::units::Angle;
use rug::Rational;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// Rows at most.
const MOST_ROWS: u64 = 10_000_000;
/// Crank angles at most when every branch is kept in memory.
const MOST_ANGLES: u64 = 100_000;

/// Computes the linkage as the arguments ask for.
pub fn linkage(args: &LinkageArgs) -> Result<Outcome, Failure> {
    let source = source::open(&args.file)?;
    args.consistent()?;
    let linkage = machine::Linkage::read(&source).map_err(|e| Failure::in_file(&args.file, e))?;
    match linkage {
        machine::Linkage::ClassIii(linkage) => {
            args.not_of_class_iii()?;
            of_class_iii(args, &linkage)
        }
        machine::Linkage::Dyad(linkage) => dyad::linkage(args, &linkage),
        machine::Linkage::Planar(machine) => planar::linkage(args, &machine),
    }
}

impl LinkageArgs {
    /// Refuses what is there for the other types.
    fn not_of_class_iii(&self) -> Result<(), Failure> {
        for (given, name) in [(self.paths, "--paths"), (self.reactions, "--reactions")] {
            if given {
                let text = format!("{name} is not for files with type = \"class-iii\"");
                return Err(Failure::new(text).about(self.file.display()));
            }
        }
        Ok(())
    }

    /// Refuses what does not go together.
    fn consistent(&self) -> Result<(), Failure> {
        let page = self.format == RowsFormat::Html;
        let shown = [
            (self.svg.is_some(), "--svg draws"),
            (self.dxf.is_some(), "--dxf draws"),
            (page, "--format html shows"),
        ];
        if let (true, Some((_, what))) = (self.all_branches, shown.iter().find(|s| s.0)) {
            let text = format!("{what} one branch: leave out --all-branches");
            return Err(Failure::new(text));
        }
        match page && self.digits.is_some() {
            true => Err(Failure::new(
                "--format html shows floating-point numbers: leave out --digits",
            )),
            false => Ok(()),
        }
    }

    /// The columns in the units asked for; a length may be that of the DXF file alone.
    fn columns(&self, names: Vec<String>, certified: bool) -> Result<Columns, Failure> {
        let drawn = self.dxf.is_some() && !columns::any_length(&names);
        let units = self.units.units.iter();
        let units = units.filter(|u| !(drawn && shown::is_length(u))).cloned();
        Ok(Columns::of(names, &units.collect::<Vec<_>>(), certified)?)
    }

    /// The crank angles asked for; they begin at `start` if the arguments do not say where.
    pub fn grid(&self, start: Option<Rational>) -> Result<Grid, Failure> {
        let window = Window {
            step: match &self.step_deg {
                Some(step) => step.value.clone(),
                None => Rational::from((15, 2)),
            },
            from: self.from_deg.as_ref().map(|d| d.value.clone()),
            to: self.to_deg.as_ref().map(|d| d.value.clone()),
        };
        let most = match self.all_branches {
            true => MOST_ANGLES,
            false => MOST_ROWS,
        };
        Grid::new(&window, start, most).map_err(|e| {
            let text = match e {
                GridError::Step { step } => format!("--step-deg must be positive, got {step}"),
                GridError::Backwards { to, from } => {
                    format!("--to-deg {to} must not be less than the first crank angle, {from} deg")
                }
                GridError::TooMany { step, most } => format!(
                    "--step-deg {step:e} gives more than {most} crank angles; take a larger step"
                ),
            };
            Failure::Caused(text, e.into())
        })
    }
}

fn of_class_iii(args: &LinkageArgs, linkage: &Linkage) -> Result<Outcome, Failure> {
    let grid = args.grid(linkage.start_degrees())?;
    let certified = args.digits.is_some();
    let names = class_iii::names(linkage, certified);
    let columns = args.columns(names, certified)?;
    let in_file = |e| Failure::in_file(&args.file, e);
    if args.all_branches {
        let outcome = all_branches(args, linkage, &grid, columns);
        return outcome.map_err(|f| f.about(args.file.display()));
    }
    let output = Output::open(args.output.as_deref())?;
    let drawings = args.svg.as_ref().map(|f| Drawings::open(f, linkage));
    let drawings = drawings.transpose()?;
    let cad = shown::Cad::open(args)?;
    let start = match args.branch {
        None => linkage.start_degrees().unwrap_or_else(|| grid.from.clone()),
        Some(_) => grid.from.clone(),
    };
    let branch = class_iii::choose(&linkage.solver, &start, args.branch, &linkage.start);
    let branch = branch.map_err(in_file)?;
    if let Some(drawings) = drawings {
        drawings.draw(linkage, &branch)?;
    }
    if let Some(cad) = cad {
        let motion = shown::class_iii(args, linkage, &branch, None);
        cad.draw(motion.map_err(|f| f.about(args.file.display()))?)?;
    }
    let plan = plan(&grid, &branch);
    let mut lines = vec![facts::range_line(&branch)];
    lines.extend(facts::dead_line(&branch));
    let left_out = left_out(&grid, &branch);
    lines.extend(facts::left_out_line(&left_out));
    let reached = plan.count();
    let outcome = output.write(|out| {
        let Some(form) = args.format.rows() else {
            let motion = shown::class_iii(args, linkage, &branch, Some((&plan, &columns)))?;
            return shown::page(out, &motion, &lines);
        };
        let mut facts = facts::of_branch(linkage, &branch);
        facts.insert("rows_left_out_phi1_deg".into(), json!(left_out));
        let mut rows = Rows::begin(out, form, columns, &facts)?;
        let outcome = one_branch(linkage, &branch, plan, args.digits, &mut rows)?;
        rows.end()?;
        Ok(outcome)
    })?;
    lines.iter().for_each(|l| complain(l));
    if reached == 0 && left_out.is_empty() {
        complain("no crank angle of the window asked for lies in that range");
    }
    Ok(outcome)
}

/// Crank angles in degrees that are asked for and lie at an end of the branch, where no row is.
fn left_out(grid: &Grid, branch: &Branch) -> Vec<f64> {
    let class_iii::Reach::Part { low, high } = branch.reach else {
        return Vec::new();
    };
    // Rows end a millionth of a radian before the last position found.
    const NEAR: f64 = 3e-6;
    let at_end = |degrees: &f64| {
        let angle = degrees.to_radians();
        let off = |end: f64| (angle - end - ((angle - end) / TAU).round() * TAU).abs();
        off(low.phi1).min(off(high.phi1)) <= NEAR && shown::on_branch(angle, branch).is_none()
    };
    let asked = (0..grid.count as i64).map(|k| nearest_f64(&grid.angle(k)));
    asked.filter(at_end).collect()
}

fn undecided_in(cells: &[Cell]) -> usize {
    cells.iter().filter(|c| **c == Cell::Undecided).count()
}

/// The rows of a branch; certified, they end where it cannot be proved any further.
fn one_branch(
    linkage: &Linkage,
    branch: &Branch,
    plan: Plan,
    digits: Option<u32>,
    rows: &mut Rows,
) -> Result<Outcome, Failure> {
    let progress = Progress::new();
    let mut certifier = digits.map(|d| Certifier::new(linkage, d));
    let (mut here, mut undecided) = (branch.start, 0);
    let total = plan.count();
    for (done, (shown, at)) in plan.angles().enumerate() {
        let to = Angle::from_deg(nearest_f64(&at));
        here = linkage.solver.follow(&here, to).map_err(Failure::caused)?;
        let cells = match &mut certifier {
            None => {
                let values = class_iii::values(linkage, &here);
                floating_row(nearest_f64(&shown), branch.mode, values)
            }
            Some(certifier) => {
                let Some(q) = certifier.advance(&at, &here) else {
                    complain(&format!(
                        "undecided: the reference cannot prove the branch up to phi1 = {} deg; rows end before it",
                        nearest_f64(&shown)
                    ));
                    return Ok(Outcome::Finding);
                };
                certified_row(&shown, branch.mode, certifier.values(&at, &q))
            }
        };
        undecided += undecided_in(&cells);
        rows.row(&cells)?;
        match digits {
            None => progress.reach("rows", done as u64, total),
            Some(_) => progress.show("certified rows", done as u64, total),
        }
    }
    Ok(Outcome::decided(undecided, digits.unwrap_or(0)))
}

fn all_branches(
    args: &LinkageArgs,
    linkage: &Linkage,
    grid: &Grid,
    columns: Columns,
) -> Result<Outcome, Failure> {
    let output = Output::open(args.output.as_deref())?;
    let degrees: Vec<Rational> = (0..grid.count as i64).map(|k| grid.angle(k)).collect();
    let angles: Vec<Angle> = degrees
        .iter()
        .map(|q| Angle::from_deg(nearest_f64(q)))
        .collect();
    let map = linkage.solver.trace_branches(&angles);
    if map.rows.iter().all(Vec::is_empty) {
        let why = class_iii::unassembled(&linkage.solver, nearest_f64(&grid.from));
        return Err(Failure::caused(why));
    }
    let outcome = output.write(|out| {
        let mut facts = facts::of_linkage(linkage);
        facts.insert("branches".into(), json!(map.branches));
        let folds: Vec<Value> = map.folds.iter().map(facts::fold_json).collect();
        facts.insert("folds".into(), json!(folds));
        let mut rows = Rows::begin(out, shown::rows(args.format), columns, &facts)?;
        let outcome = branch_rows(args, linkage, &map, &degrees, &mut rows)?;
        rows.end()?;
        Ok(outcome)
    })?;
    let counts: Vec<usize> = map.rows.iter().map(Vec::len).collect();
    complain(&format!(
        "{} branches, from {} to {} assembly modes at a crank angle",
        map.branches,
        counts.iter().min().unwrap_or(&0),
        counts.iter().max().unwrap_or(&0)
    ));
    for fold in &map.folds {
        let mut branches = fold.branches.clone();
        branches.sort_unstable();
        let branches: Vec<String> = branches.iter().map(usize::to_string).collect();
        complain(&format!(
            "fold at phi1 = {:.9} deg, phi4 = {:.6} deg: branches {} {} there",
            fold.phi1.to_degrees(),
            fold.phi4.to_degrees(),
            branches.join(" and "),
            if fold.begins { "begin" } else { "end" }
        ));
    }
    Ok(outcome)
}

fn branch_rows(
    args: &LinkageArgs,
    linkage: &Linkage,
    map: &BranchMap,
    degrees: &[Rational],
    rows: &mut Rows,
) -> Result<Outcome, Failure> {
    let progress = Progress::new();
    let mut certifier = args.digits.map(|d| Certifier::new(linkage, d));
    let mut undecided = 0;
    for (done, (at, samples)) in degrees.iter().zip(&map.rows).enumerate() {
        for s in samples {
            let cells = match &mut certifier {
                None => {
                    let values = class_iii::values(linkage, &s.state);
                    floating_row(nearest_f64(at), s.branch, values)
                }
                Some(certifier) => {
                    // The branch's number is that of the continuation in floating point; the
                    // position itself is proved afresh.
                    certifier.lift();
                    let Some(q) = certifier.advance(at, &s.state) else {
                        undecided += 1;
                        continue;
                    };
                    certified_row(at, s.branch, certifier.values(at, &q))
                }
            };
            undecided += undecided_in(&cells);
            rows.row(&cells)?;
        }
        progress.show("rows", done as u64, degrees.len() as u64);
    }
    Ok(Outcome::decided(undecided, args.digits.unwrap_or(0)))
}

/// A row in floating point: the drive in degrees or metres, the branch, the values.
fn floating_row(drive: f64, branch: usize, values: Vec<f64>) -> Vec<Cell> {
    let head = [Cell::Float(drive), Cell::Count(branch)];
    head.into_iter()
        .chain(values.into_iter().map(Cell::Float))
        .collect()
}

fn certified_row(drive: &Rational, branch: usize, digits: Vec<Option<String>>) -> Vec<Cell> {
    let head = [Cell::Decimal(decimal(drive)), Cell::Count(branch)];
    head.into_iter()
        .chain(digits.into_iter().map(Cell::certified))
        .collect()
}

#[cfg(test)]
mod tests;
