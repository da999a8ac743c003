//! A mechanism of bodies and joints given in a file, computed over its drive.

use super::planar_facts as facts;
use crate::cli::args::LinkageArgs;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::progress::Progress;
use mechaudit::machine::planar::{self, Branch, Columns, Machine};
use mechaudit::reference::nearest_f64;
use mechaudit::report::cell::Cell;
use mechaudit::report::columns::Columns as Shown;
use mechaudit::report::rows::Rows;
use mechaudit::report::svg::linkage as drawn;
use mechaudit::solvers::planar::BranchMap;
use rug::Rational;

/// The values of the drive: as shown (degrees or metres) and in radians or metres.
struct Values(Vec<(f64, f64)>);

impl Values {
    fn new(args: &LinkageArgs, machine: &Machine) -> Result<Values, Failure> {
        let Some([from, to, step]) = machine.window else {
            let start = machine.start.at.and_then(Rational::from_f64);
            let grid = args.grid(start)?;
            let angle = |k: u64| nearest_f64(&grid.angle(k as i64));
            let all = (0..grid.count).map(angle).map(|d| (d, d.to_radians()));
            return Ok(Values(all.collect()));
        };
        if args.from_deg.is_some() || args.to_deg.is_some() {
            return Err(Failure::new(
                "the drive is a displacement: drive.range and drive.step of the file say which rows there are, not --from-deg and --to-deg",
            ));
        }
        let count = ((to - from) / step + 1e-9).floor() as u64;
        let at = |k: u64| from + step * k as f64;
        Ok(Values((0..=count).map(|k| (at(k), at(k))).collect()))
    }
}

/// Computes the mechanism as the arguments ask for.
pub fn linkage(args: &LinkageArgs, machine: &Machine) -> Result<Outcome, Failure> {
    let in_file = |e| Failure::in_file(&args.file, e);
    if args.digits.is_some() {
        let text = "--digits is not there for type = \"planar\": its rows are in floating point";
        return Err(Failure::new(text).about(args.file.display()));
    }
    let columns = Columns {
        paths: args.paths,
        reactions: args.reactions,
    };
    if args.reactions && (machine.loads.is_none() || machine.speed.is_none()) {
        let text = "--reactions needs masses or loads, and drive.speed, in the file";
        return Err(Failure::new(text).about(args.file.display()));
    }
    if args.svg.is_some() && args.all_branches {
        return Err(Failure::new(
            "--svg draws one branch: leave out --all-branches",
        ));
    }
    let values = Values::new(args, machine)?;
    let shown = Shown::of(planar::names(machine, columns), &args.units.units, false)?;
    let first = values.0.first().map_or(0.0, |v| v.1);
    if args.all_branches {
        let outcome = all_branches(args, machine, &values, columns, shown);
        return outcome.map_err(|f| f.about(args.file.display()));
    }
    let start = match (args.branch, machine.start.at) {
        (None, Some(at)) if machine.rotary() => at.to_radians(),
        (None, Some(at)) => at,
        _ => first,
    };
    let output = Output::open(args.output.as_deref())?;
    let branch = planar::choose(machine, start, args.branch).map_err(in_file)?;
    if let Some(folder) = &args.svg {
        let drawing = Output::within(folder, "mechanism.svg")?;
        drawing.text(&drawn::planar(machine, &branch))?;
    }
    let mut written = 0;
    output.write(|out| {
        let about = facts::of_branch(machine, &branch);
        let mut rows = Rows::begin(out, args.format, shown, &about)?;
        written = one_branch(machine, &branch, &values, columns, &mut rows)?;
        rows.end()?;
        Ok(())
    })?;
    facts::lines(machine).iter().for_each(|l| complain(l));
    complain(&facts::modes_line(machine, &branch));
    complain(&facts::range_line(machine, &branch));
    if written == 0 {
        complain("no value of the drive asked for lies in that range");
    }
    Ok(Outcome::AsExpected)
}

fn one_branch(
    machine: &Machine,
    branch: &Branch,
    values: &Values,
    columns: Columns,
    rows: &mut Rows,
) -> Result<u64, Failure> {
    let progress = Progress::new();
    let mut here = branch.start.clone();
    let mut written = 0;
    for (done, &(shown, drive)) in values.0.iter().enumerate() {
        let Some(at) = branch.turned_to(machine, drive) else {
            continue;
        };
        let next = machine.solver.follow(&here, machine.inner(at));
        here = next.map_err(Failure::caused)?;
        let mut cells = vec![Cell::Float(shown), Cell::Count(branch.mode)];
        cells.extend(
            planar::values(machine, &here, columns)
                .into_iter()
                .map(Cell::Float),
        );
        rows.row(&cells)?;
        written += 1;
        if done % 1024 == 0 {
            progress.show("rows", done as u64, values.0.len() as u64);
        }
    }
    Ok(written)
}

fn all_branches(
    args: &LinkageArgs,
    machine: &Machine,
    values: &Values,
    columns: Columns,
    shown: Shown,
) -> Result<Outcome, Failure> {
    let output = Output::open(args.output.as_deref())?;
    let inner: Vec<f64> = values.0.iter().map(|v| machine.inner(v.1)).collect();
    let map: BranchMap = machine.solver.trace_branches(&inner);
    if map.rows.iter().all(Vec::is_empty) {
        let why = match map.complete {
            true => "the mechanism cannot be assembled at any value of the drive asked for",
            false => {
                "no position was found: a group has gears among its unknowns, is too large, or has special dimensions"
            }
        };
        return Err(Failure::new(why));
    }
    output.write(|out| {
        let about = facts::of_map(machine, &map);
        let mut rows = Rows::begin(out, args.format, shown, &about)?;
        for (&(drive, _), samples) in values.0.iter().zip(&map.rows) {
            for s in samples {
                let mut cells = vec![Cell::Float(drive), Cell::Count(s.branch)];
                let row = planar::values(machine, &s.state, columns);
                cells.extend(row.into_iter().map(Cell::Float));
                rows.row(&cells)?;
            }
        }
        rows.end()?;
        Ok(())
    })?;
    facts::lines(machine).iter().for_each(|l| complain(l));
    facts::map_lines(machine, &map)
        .iter()
        .for_each(|l| complain(l));
    Ok(Outcome::AsExpected)
}
