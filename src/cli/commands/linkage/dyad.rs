//! A four-bar linkage or slider-crank given in a file, computed over the turn of its crank.

use super::{dyad_facts as facts, shown, undecided_in};
use crate::cli::args::LinkageArgs;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::progress::Progress;
use mechaudit::machine::crank_angles::{Grid, decimal};
use mechaudit::machine::dyad::{self, ASSEMBLIES, Dyad, Proved, number};
use mechaudit::reference::nearest_f64;
use mechaudit::report::cell::Cell;
use mechaudit::report::rows::Rows;
use mechaudit::report::svg::linkage as drawn;
use mechaudit::solvers::dyad::Assembly;

/// Computes the linkage as the arguments ask for.
pub fn linkage(args: &LinkageArgs, dyad: &Dyad) -> Result<Outcome, Failure> {
    let kind = dyad.shape.type_name();
    if dyad.shape.has_bodies() {
        return Err(Failure::new(format!(
            "{}: [bodies] is not possible with type = {kind:?} here: rows with masses are for class-iii only; runup takes them",
            args.file.display()
        )));
    }
    let assemblies = match (args.all_branches, args.branch) {
        (true, _) => ASSEMBLIES.to_vec(),
        (false, None) => vec![dyad.assembly],
        (false, Some(n)) => match ASSEMBLIES.get(n) {
            Some(assembly) => vec![*assembly],
            None => {
                return Err(Failure::new(format!(
                    "--branch {n}: a {kind} has the branches 0 (positive assembly) and 1 (negative)"
                )));
            }
        },
    };
    let grid = args.grid(dyad.start.clone())?;
    let columns = args.columns(dyad::names(dyad), args.digits.is_some())?;
    let output = Output::open(args.output.as_deref())?;
    if let (Some(folder), [assembly]) = (&args.svg, &assemblies[..]) {
        let drawing = Output::within(folder, "mechanism.svg")?;
        drawing.text(drawn::dyad(dyad, *assembly))?;
    }
    if let (Some(cad), [assembly]) = (shown::Cad::open(args)?, &assemblies[..]) {
        let motion = shown::dyad(args, dyad, *assembly, None);
        cad.draw(motion.map_err(|f| f.about(args.file.display()))?)?;
    }
    let lines = facts::lines(dyad, &assemblies);
    let mut count = 0;
    let outcome = output.write(|out| {
        let Some(form) = args.format.rows() else {
            count = 1;
            let motion = shown::dyad(args, dyad, assemblies[0], Some((&grid, &columns)))?;
            return shown::page(out, &motion, &lines);
        };
        let about = facts::json(dyad, &assemblies);
        let mut rows = Rows::begin(out, form, columns, &about)?;
        let outcome = all_rows(args, dyad, &assemblies, &grid, &mut rows, &mut count);
        let outcome = outcome.map_err(|f| f.about(args.file.display()))?;
        rows.end()?;
        Ok(outcome)
    })?;
    lines.iter().for_each(|l| complain(l));
    if count == 0 {
        complain("no crank angle of the window asked for lies in that range");
    }
    Ok(outcome)
}

fn all_rows(
    args: &LinkageArgs,
    dyad: &Dyad,
    assemblies: &[Assembly],
    grid: &Grid,
    rows: &mut Rows,
    count: &mut u64,
) -> Result<Outcome, Failure> {
    let progress = Progress::new();
    let mut undecided = 0;
    for k in 0..grid.count {
        let degrees = grid.angle(k as i64);
        for &assembly in assemblies {
            let (shown, values) = match args.digits {
                None => {
                    let row = dyad::floating(dyad, &degrees, assembly);
                    let row = row.map_err(Failure::caused)?;
                    (
                        Cell::Float(nearest_f64(&degrees)),
                        row.map(|v| v.map(Cell::Float)),
                    )
                }
                Some(digits) => {
                    let row = match dyad::certified(dyad, &degrees, assembly, digits) {
                        Proved::Values(digits) => Some(digits.map(Cell::certified)),
                        Proved::Unreachable => None,
                    };
                    (Cell::Decimal(decimal(&degrees)), row)
                }
            };
            let Some(values) = values else { continue };
            let mut cells = vec![shown, Cell::Count(number(assembly))];
            cells.extend(values);
            undecided += undecided_in(&cells);
            rows.row(&cells)?;
            *count += 1;
        }
        progress.reach("rows", k, grid.count);
    }
    Ok(Outcome::decided(undecided, args.digits.unwrap_or(0)))
}
