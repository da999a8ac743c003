//! A mechanism of bodies and joints given in a file, computed over its drive.

use super::{certified_row, floating_row, planar_facts as facts, shown, undecided_in};
use crate::cli::args::LinkageArgs;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::progress::Progress;
use mechaudit::machine::crank_angles::decimal;
use mechaudit::machine::planar::{
    self, Branch, Certifier, Columns, End, MARGIN, Machine, NotExact,
};
use mechaudit::reference::nearest_f64;
use mechaudit::report::cell::Cell;
use mechaudit::report::columns::Columns as Shown;
use mechaudit::report::rows::Rows;
use mechaudit::report::svg::linkage as drawn;
use mechaudit::solvers::planar::{BranchMap, Loads, State};
use rug::Rational;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// The values of the drive: as shown (degrees or metres) and in radians or metres; as shown,
/// exactly.
struct Values(Vec<(f64, f64)>, Vec<Rational>);

impl Values {
    fn new(args: &LinkageArgs, machine: &Machine) -> Result<Values, Failure> {
        let Some(window) = machine.window else {
            let start = machine.start.at.and_then(Rational::from_f64);
            let grid = args.grid(start)?;
            let exact: Vec<Rational> = (0..grid.count as i64).map(|k| grid.angle(k)).collect();
            let all = exact.iter().map(nearest_f64).map(|d| (d, d.to_radians()));
            return Ok(Values(all.collect(), exact));
        };
        if args.from_deg.is_some() || args.to_deg.is_some() {
            return Err(Failure::new(
                "the drive is a displacement: drive.range and drive.step of the file say which rows there are, not --from-deg and --to-deg",
            ));
        }
        let all: Vec<(f64, f64)> = displacements(window).map(|s| (s, s)).collect();
        let exact = match &machine.exact_window {
            Some([from, _, step]) => {
                let at = |k: usize| (step * Rational::from(k)) + from;
                (0..all.len()).map(at).collect()
            }
            None => Vec::new(),
        };
        Ok(Values(all, exact))
    }
}

/// From the first to the last, which is there if the steps end at it within rounding.
fn displacements([from, to, step]: [f64; 3]) -> impl Iterator<Item = f64> {
    let count = ((to - from) / step + 1e-9).floor() as u64;
    (0..=count).map(move |k| from + step * k as f64)
}

/// Computes the mechanism as the arguments ask for.
pub fn linkage(args: &LinkageArgs, machine: &Machine) -> Result<Outcome, Failure> {
    let in_file = |e| Failure::in_file(&args.file, e);
    let certifier = args.digits.map(|d| Certifier::new(machine, d));
    let unproved = |e: NotExact| Failure::in_file(&args.file, e);
    let certifier = certifier.transpose().map_err(unproved)?;
    if args.digits.is_some() && args.reactions {
        let text = "--reactions has no certified digits: leave out --digits";
        return Err(Failure::new(text).about(args.file.display()));
    }
    let columns = Columns {
        paths: args.paths,
        reactions: args.reactions,
    };
    if args.reactions && (!machine.has_loads() || machine.speed.is_none()) {
        let text = "--reactions needs masses or loads, and drive.speed, in the file";
        return Err(Failure::new(text).about(args.file.display()));
    }
    let values = Values::new(args, machine)?;
    let names = match certifier {
        None => planar::names(machine, columns),
        Some(_) => planar::certified_names(machine, args.paths),
    };
    let shown = args.columns(names, certifier.is_some())?;
    let first = values.0.first().map_or(0.0, |v| v.1);
    let asked = Asked {
        columns,
        certifier: certifier.as_ref(),
        reasons: Reasons::default(),
    };
    if args.all_branches {
        let outcome = all_branches(args, machine, &values, &asked, shown);
        return outcome.map_err(|f| f.about(args.file.display()));
    }
    let output = Output::open(args.output.as_deref())?;
    let branch = planar::choose(machine, start(args, machine, first), args.branch);
    let branch = branch.map_err(in_file)?;
    if let Some(folder) = &args.svg {
        let drawing = Output::within(folder, "mechanism.svg")?;
        drawing.text(drawn::planar(machine, &branch))?;
    }
    if let Some(cad) = shown::Cad::open(args)? {
        let motion = shown::planar(args, machine, &branch, None);
        cad.draw(motion.map_err(|f| f.about(args.file.display()))?)?;
    }
    let mut lines = facts::lines(machine);
    lines.push(facts::modes_line(machine, &branch));
    lines.push(facts::range_line(machine, &branch));
    // With certified digits the end of a branch has a row.
    let drives = values.0.iter().filter(|_| asked.certifier.is_none());
    let left_out =
        drives.filter_map(|(shown, drive)| Some((*shown, branch.end_at(machine, *drive)?)));
    let left_out: Vec<(f64, End)> = left_out.collect();
    lines.extend(facts::left_out_line(machine, &left_out));
    let (any, undecided) = output.write(|out| {
        let Some(form) = args.format.rows() else {
            let window = shown::Window {
                drives: &values.0,
                named: &shown,
                columns,
            };
            let motion = shown::planar(args, machine, &branch, Some(window))?;
            shown::page(out, &motion, &lines)?;
            return Ok((true, 0));
        };
        let about = facts::of_branch(machine, &branch, &left_out);
        let mut rows = Rows::begin(out, form, shown, &about)?;
        let written = one_branch(machine, &branch, &values, &asked, &mut rows)?;
        rows.end()?;
        Ok(written)
    })?;
    lines.iter().for_each(|l| complain(l));
    asked.reasons.say();
    if !any && left_out.is_empty() {
        complain("no value of the drive asked for lies in that range");
    }
    Ok(Outcome::decided(undecided, args.digits.unwrap_or(0)))
}

/// The value of the drive, in radians or metres, at which the branch is chosen: the file's own, or
/// the first one if its number is asked for.
fn start(args: &LinkageArgs, machine: &Machine, first: f64) -> f64 {
    match (args.branch, machine.start.at) {
        (None, Some(at)) if machine.rotary() => at.to_radians(),
        (None, Some(at)) => at,
        _ => first,
    }
}

/// The columns of a row, and its certifier, if it is certified.
struct Asked<'a> {
    columns: Columns,
    certifier: Option<&'a Certifier<'a>>,
    reasons: Reasons,
}

/// The reason why digits of rows are missing.
#[derive(Default)]
struct Reasons(RefCell<Vec<String>>);

impl Reasons {
    fn of_row(&self, machine: &Machine, value: &Rational, reason: Option<String>) {
        let unit = if machine.rotary() { "deg" } else { "m" };
        let line = |reason| format!("undecided at {} {unit}: {reason}", decimal(value));
        self.0.borrow_mut().extend(reason.map(line));
    }

    /// Says the first of them, and how many more there are.
    fn say(&self) {
        const MOST: usize = 10;
        let all = self.0.borrow();
        all.iter().take(MOST).for_each(|line| complain(line));
        if all.len() > MOST {
            complain(&format!("undecided in {} more rows", all.len() - MOST));
        }
    }
}

impl Asked<'_> {
    /// The certified row of the singular position at the value of that number, if the branch ends
    /// there.
    fn at_the_end(
        &self,
        machine: &Machine,
        values: &Values,
        number: usize,
        branch: &Branch,
    ) -> Option<Vec<Cell>> {
        let end = branch.end_at(machine, values.0[number].1)?;
        self.of_end(
            machine,
            values,
            number,
            end.drive,
            (branch.mode, &branch.start),
        )
    }

    /// The certified row of the singular position in which a branch ends, from a position on it, at
    /// the value of that number.
    fn of_end(
        &self,
        machine: &Machine,
        values: &Values,
        number: usize,
        end: f64,
        (branch, from): (usize, &State),
    ) -> Option<Vec<Cell>> {
        let (certifier, solver) = (self.certifier?, &machine.solver);
        let end = machine.inner(end);
        let beyond = (end - solver.drive_of(from)).signum() * 2.0 * MARGIN;
        let (last, _) = solver.follow_as_far(from, end + beyond);
        let at = solver.singularity(&last)?;
        let value = &values.1[number];
        let row = certifier.singular_row(value, &at.angles, &last, self.columns.paths);
        self.reasons.of_row(machine, value, row.reason);
        Some(certified_row(value, branch, row.digits))
    }

    /// The row of a position at the value of that number.
    fn row(
        &self,
        machine: &Machine,
        values: &Values,
        number: usize,
        branch: usize,
        (loads, state): (Option<&Loads>, &State),
    ) -> Vec<Cell> {
        match self.certifier {
            None => {
                let row = planar::values(machine, loads, state, self.columns);
                floating_row(values.0[number].0, branch, row)
            }
            Some(certifier) => {
                let value = &values.1[number];
                let row = certifier.row(value, state, self.columns.paths);
                self.reasons.of_row(machine, value, row.reason);
                certified_row(value, branch, row.digits)
            }
        }
    }
}

/// The rows of a branch: whether there are any, and how many values of them are undecided.
fn one_branch(
    machine: &Machine,
    branch: &Branch,
    values: &Values,
    asked: &Asked,
    rows: &mut Rows,
) -> Result<(bool, usize), Failure> {
    let progress = Progress::new();
    let mut here = branch.start.clone();
    let (mut any, mut undecided) = (false, 0);
    for (done, &(_, drive)) in values.0.iter().enumerate() {
        let Some(at) = branch.turned_to(machine, drive) else {
            if let Some(cells) = asked.at_the_end(machine, values, done, branch) {
                undecided += undecided_in(&cells);
                rows.row(&cells)?;
                any = true;
            }
            continue;
        };
        let next = machine.solver.follow(&here, machine.inner(at));
        here = next.map_err(Failure::caused)?;
        let cells = asked.row(
            machine,
            values,
            done,
            branch.mode,
            (branch.loads.as_ref(), &here),
        );
        undecided += undecided_in(&cells);
        rows.row(&cells)?;
        any = true;
        progress.reach("rows", done as u64, values.0.len() as u64);
    }
    Ok((any, undecided))
}

fn all_branches(
    args: &LinkageArgs,
    machine: &Machine,
    values: &Values,
    asked: &Asked,
    shown: Shown,
) -> Result<Outcome, Failure> {
    let output = Output::open(args.output.as_deref())?;
    let inner: Vec<f64> = values.0.iter().map(|v| machine.inner(v.1)).collect();
    let map: BranchMap = machine.solver.trace_branches(&inner);
    if map.rows.iter().all(Vec::is_empty) {
        let why = match map.complete {
            true => "the mechanism cannot be assembled at any value of the drive asked for",
            false => {
                "no position was found: a group has gears among its unknowns, is too large, has special dimensions, or the position is singular"
            }
        };
        return Err(Failure::new(why));
    }
    let drives = values.0.iter();
    let singular: Vec<Singular> = drives.map(|v| Singular::at(machine, &map, v.1)).collect();
    // With certified digits the end of a branch has a row.
    let both = values.0.iter().zip(&singular);
    let both = both.filter(|_| asked.certifier.is_none());
    let left_out = both.filter_map(|(v, s)| Some((v.0, s.missing.first()?.1)));
    let left_out: Vec<(f64, End)> = left_out.collect();
    let mut undecided = output.write(|out| {
        let about = facts::of_map(machine, &map, &left_out);
        let mut rows = Rows::begin(out, shown::rows(args.format), shown, &about)?;
        let mut undecided = 0;
        let mut loads = BTreeMap::new();
        for (number, (samples, singular)) in map.rows.iter().zip(&singular).enumerate() {
            let mut add = |cells: &[Cell]| {
                undecided += undecided_in(cells);
                rows.row(cells)
            };
            for s in samples.iter().filter(|s| !singular.is_missing(s.branch)) {
                let on = loads
                    .entry(s.branch)
                    .or_insert_with(|| machine.loads_on(&s.state));
                add(&asked.row(machine, values, number, s.branch, (on.as_ref(), &s.state)))?;
            }
            let ends = singular.missing.iter();
            for (branch, end) in ends.filter(|_| asked.certifier.is_some()) {
                let sample = samples.iter().find(|s| s.branch == *branch);
                let cells = match (sample, nearest(&map, number, *branch)) {
                    (Some(s), _) => {
                        Some(asked.row(machine, values, number, *branch, (None, &s.state)))
                    }
                    (None, Some(from)) => {
                        asked.of_end(machine, values, number, end.drive, (*branch, from))
                    }
                    (None, None) => None,
                };
                cells.map_or(Ok(()), |cells| add(&cells))?;
            }
        }
        rows.end()?;
        Ok(undecided)
    })?;
    facts::lines(machine).iter().for_each(|l| complain(l));
    facts::map_lines(machine, &map)
        .iter()
        .chain(&facts::left_out_line(machine, &left_out))
        .for_each(|l| complain(l));
    asked.reasons.say();
    if let Some(certifier) = asked.certifier {
        undecided += prove_counts(certifier, values, &map);
    }
    Ok(Outcome::decided(undecided, args.digits.unwrap_or(0)))
}

/// Branches that begin or end at a value of the drive, where the position is singular: they have no
/// row there in floating point.
struct Singular {
    missing: Vec<(usize, End)>,
}

impl Singular {
    fn at(machine: &Machine, map: &BranchMap, drive: f64) -> Singular {
        let mut missing: Vec<(usize, End)> = Vec::new();
        for e in &map.ends {
            let end = End {
                drive: facts::end_drive(machine, e),
                kind: e.at.as_ref().map(|s| s.kind),
            };
            if (end.drive - drive).abs() <= MARGIN {
                missing.extend(e.branches.iter().map(|&b| (b, end)));
            }
        }
        missing.sort_by_key(|(branch, _)| *branch);
        missing.dedup_by_key(|(branch, _)| *branch);
        Singular { missing }
    }

    fn is_missing(&self, branch: usize) -> bool {
        self.missing.iter().any(|(b, _)| *b == branch)
    }
}

/// The position on a branch at the value that is nearest to the one of that number.
fn nearest(map: &BranchMap, number: usize, branch: usize) -> Option<&State> {
    let all = map.rows.iter().enumerate().filter_map(|(k, samples)| {
        let found = samples.iter().find(|s| s.branch == branch)?;
        Some((k.abs_diff(number), &found.state))
    });
    all.min_by_key(|(apart, _)| *apart).map(|(_, state)| state)
}

/// Proves at every value of the drive how many modes there are; at how many that is open or another
/// number.
fn prove_counts(certifier: &Certifier, values: &Values, map: &BranchMap) -> usize {
    if !certifier.counts_modes() {
        complain(
            "undecided whether these are all assembly modes: slides and slots have displacements without a bound",
        );
        return 1;
    }
    let progress = Progress::new();
    let mut open = 0;
    for (number, (degrees, samples)) in values.1.iter().zip(&map.rows).enumerate() {
        let at = || nearest_f64(degrees);
        match certifier.modes(degrees) {
            Ok(modes) if modes.len() == samples.len() => continue,
            Ok(modes) => complain(&format!(
                "at {} deg there are {} assembly modes, proved; {} were found in floating point",
                at(),
                modes.len(),
                samples.len()
            )),
            Err(e) => complain(&format!(
                "undecided at {} deg whether these are all assembly modes: {e}",
                at()
            )),
        }
        open += 1;
        progress.show("proofs of all modes", number as u64, values.1.len() as u64);
    }
    let all = values.1.len();
    complain(&format!(
        "proved for {} of {all} values of the drive: these are all assembly modes",
        all - open
    ));
    open
}

#[cfg(test)]
mod tests;
