//! A four-bar linkage or slider-crank given in a file, computed over the turn of its crank.

use super::{dyad_facts as facts, shown, undecided_in};
use crate::cli::args::LinkageArgs;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::progress::Progress;
use mechaudit::machine::crank_angles::{Grid, decimal};
use mechaudit::machine::dyad::{self, ASSEMBLIES, Dyad, Proved, number};
use mechaudit::machine::planar::{Columns, Further};
use mechaudit::reference::nearest_f64;
use mechaudit::report::cell::Cell;
use mechaudit::report::rows::Rows;
use mechaudit::report::svg::linkage as drawn;
use mechaudit::solvers::dyad::Assembly;

/// Computes the linkage as the arguments ask for.
pub fn linkage(args: &LinkageArgs, dyad: &Dyad) -> Result<Outcome, Failure> {
    let kind = dyad.shape.type_name();
    let further = further(args, dyad).map_err(|f| f.about(args.file.display()))?;
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
    let mut names = dyad::names(dyad);
    names.extend(further.iter().flat_map(Further::names));
    let columns = args.columns(names, args.digits.is_some())?;
    let output = Output::open(args.output.as_deref())?;
    if let (Some(folder), [assembly]) = (&args.svg, &assemblies[..]) {
        let drawing = Output::within(folder, "mechanism.svg")?;
        drawing.text(drawn::dyad(dyad, *assembly))?;
    }
    if let (Some(cad), [assembly]) = (shown::Cad::open(args)?, &assemblies[..]) {
        let motion = shown::dyad(args, dyad, *assembly, None, None);
        cad.draw(motion.map_err(|f| f.about(args.file.display()))?)?;
    }
    let meetings = dyad::meetings(dyad, &grid);
    let mut lines = facts::lines(dyad, &assemblies);
    lines.extend(facts::meeting_lines(&meetings));
    let mut count = 0;
    let outcome = output.write(|out| {
        let Some(form) = args.format.rows() else {
            count = 1;
            let shown = Some((&grid, &columns));
            let motion = shown::dyad(args, dyad, assemblies[0], shown, further.as_ref())?;
            return shown::page(out, &motion, &lines);
        };
        let about = facts::json(dyad, &assemblies, &meetings);
        let mut rows = Rows::begin(out, form, columns, &about)?;
        let asked = (dyad, further.as_ref());
        let outcome = all_rows(args, asked, &assemblies, &grid, &mut rows, &mut count);
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

/// The columns beyond those of the linkage itself.
fn further(args: &LinkageArgs, dyad: &Dyad) -> Result<Option<Further>, Failure> {
    let columns = Columns {
        paths: args.paths,
        reactions: args.reactions,
    };
    if args.digits.is_some() {
        if let Some((_, name)) = [(args.paths, "--paths"), (args.reactions, "--reactions")]
            .iter()
            .find(|asked| asked.0)
        {
            let kind = dyad.shape.type_name();
            let text =
                format!("{name} has no certified digits with type = {kind:?}: leave out --digits");
            return Err(Failure::new(text));
        }
        if dyad.shape.has_bodies() {
            complain("the reduced masses have no certified digits and are left out");
        }
        return Ok(None);
    }
    Further::of(dyad, columns).map_err(Failure::caused)
}

/// A value that does not exist is NaN.
fn number_or_none(x: f64) -> Cell {
    match x.is_nan() {
        true => Cell::Empty,
        false => Cell::Float(x),
    }
}

fn all_rows(
    args: &LinkageArgs,
    (dyad, further): (&Dyad, Option<&Further>),
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
                        row.map(|row| {
                            let at = nearest_f64(&degrees);
                            let more = further.map(|f| f.values(at, &row));
                            let all = row.into_iter().chain(more.unwrap_or_default());
                            all.map(number_or_none).collect::<Vec<_>>()
                        }),
                    )
                }
                Some(digits) => {
                    let row = match dyad::certified(dyad, &degrees, assembly, digits) {
                        Proved::Values(digits) => Some(digits.map(Cell::certified).to_vec()),
                        Proved::Singular(digits) => Some(
                            digits
                                .map(|d| d.map_or(Cell::Empty, Cell::Decimal))
                                .to_vec(),
                        ),
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
