//! A linkage given in a file, computed over the turn of its crank.

use super::args::LinkageArgs;
use super::branch::{self, Branch, Reach};
use super::certified::Certifier;
use super::columns::Columns;
use super::complain;
use super::crank_angles::{Grid, Plan, plan, start_degrees};
use super::failure::{Failure, Outcome};
use super::linkage_columns as columns;
use super::linkage_drawing::Drawings;
use super::linkage_file::{self, Described, Linkage};
use super::output::Output;
use super::progress::Progress;
use super::quantity::nearest;
use super::result::{decided, write_to_result};
use super::rows::{Cell, Rows};
use mechaudit::solvers::class_iii::{BranchMap, Fold};
use rug::Rational;
use serde_json::{Map, Value, json};

/// Computes the linkage as the arguments ask for.
pub fn linkage(args: &LinkageArgs) -> Result<Outcome, Failure> {
    match linkage_file::read(&args.file)? {
        Described::ClassIii(linkage) => class_iii(args, &linkage),
        Described::Dyad(dyad) => super::dyad::linkage(args, &dyad),
    }
}

fn class_iii(args: &LinkageArgs, linkage: &Linkage) -> Result<Outcome, Failure> {
    let grid = Grid::new(args, start_degrees(linkage))?;
    let certified = args.digits.is_some();
    let names = columns::names(linkage, certified);
    let columns = Columns::of(names, &args.units.units, certified)?;
    let about = |f: Failure| match f {
        Failure::Message(text) => Failure::new(format!("{}: {text}", args.file.display())),
        other => other,
    };
    if args.all_branches {
        if args.svg.is_some() {
            return Err(Failure::new(
                "--svg draws one branch: leave out --all-branches",
            ));
        }
        return all_branches(args, linkage, &grid, columns).map_err(about);
    }
    let output = Output::open(args.output.as_deref())?;
    let drawings = args.svg.as_ref().map(|f| Drawings::open(f, linkage));
    let drawings = drawings.transpose()?;
    let start = match args.branch {
        None => start_degrees(linkage).unwrap_or_else(|| grid.from.clone()),
        Some(_) => grid.from.clone(),
    };
    let branch =
        branch::choose(&linkage.solver, &start, args.branch, &linkage.start).map_err(about)?;
    if let Some(drawings) = drawings {
        drawings.draw(linkage, &branch)?;
    }
    let plan = plan(&grid, &branch);
    let reached = plan.len();
    let outcome = write_to_result(output, |out| {
        let facts = facts(linkage, &branch);
        let mut rows = Rows::begin(out, args.format, columns, &facts)?;
        let outcome = match args.digits {
            None => floating(linkage, &branch, plan, &mut rows)?,
            Some(digits) => certified_rows(linkage, &branch, plan, digits, &mut rows)?,
        };
        rows.end()?;
        Ok(outcome)
    })?;
    complain(&branch.range_line());
    if let Some(line) = branch.dead_line() {
        complain(&line);
    }
    if reached == 0 {
        complain("no crank angle of the window asked for lies in that range");
    }
    Ok(outcome)
}

fn floating(
    linkage: &Linkage,
    branch: &Branch,
    plan: Plan,
    rows: &mut Rows,
) -> Result<Outcome, Failure> {
    let progress = Progress::new();
    let mut here = branch.start;
    let total = plan.len();
    for (done, (shown, at)) in plan.angles().enumerate() {
        here = linkage
            .solver
            .follow(&here, nearest(&at).to_radians())
            .map_err(|e| Failure::new(e.to_string()))?;
        rows.row(&columns::row(linkage, nearest(&shown), branch.mode, &here))?;
        if done % 1024 == 0 {
            progress.show("rows", done as u64, total);
        }
    }
    Ok(Outcome::AsExpected)
}

fn certified_rows(
    linkage: &Linkage,
    branch: &Branch,
    plan: Plan,
    digits: u32,
    rows: &mut Rows,
) -> Result<Outcome, Failure> {
    let progress = Progress::new();
    let mut certifier = Certifier::new(linkage, digits);
    let mut here = branch.start;
    let mut undecided = 0;
    let total = plan.len();
    for (done, (shown, at)) in plan.angles().enumerate() {
        here = linkage
            .solver
            .follow(&here, nearest(&at).to_radians())
            .map_err(|e| Failure::new(e.to_string()))?;
        let Some(q) = certifier.advance(&at, &here) else {
            complain(&format!(
                "undecided: the reference cannot prove the branch up to phi1 = {} deg; rows end before it",
                nearest(&shown)
            ));
            return Ok(Outcome::Finding);
        };
        let cells = certifier.row(&shown, &at, branch.mode, &q);
        undecided += cells.iter().filter(|c| **c == Cell::Undecided).count();
        rows.row(&cells)?;
        progress.show("certified rows", done as u64, total);
    }
    Ok(decided(undecided, digits))
}

fn all_branches(
    args: &LinkageArgs,
    linkage: &Linkage,
    grid: &Grid,
    columns: Columns,
) -> Result<Outcome, Failure> {
    let output = Output::open(args.output.as_deref())?;
    let degrees: Vec<Rational> = (0..grid.count as i64).map(|k| grid.angle(k)).collect();
    let angles: Vec<f64> = degrees.iter().map(|q| nearest(q).to_radians()).collect();
    let map = linkage.solver.trace_branches(&angles);
    if map.rows.iter().all(Vec::is_empty) {
        return Err(branch::unassembled(&linkage.solver, nearest(&grid.from)));
    }
    let outcome = write_to_result(output, |out| {
        let mut facts = head(linkage);
        facts.insert("branches".into(), json!(map.branches));
        let folds: Vec<Value> = map.folds.iter().map(fold_json).collect();
        facts.insert("folds".into(), json!(folds));
        let mut rows = Rows::begin(out, args.format, columns, &facts)?;
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
                None => columns::row(linkage, nearest(at), s.branch, &s.state),
                Some(certifier) => {
                    // The branch's number is that of the continuation in floating point; the
                    // position itself is proved afresh.
                    certifier.lift();
                    let Some(q) = certifier.advance(at, &s.state) else {
                        undecided += 1;
                        continue;
                    };
                    certifier.row(at, at, s.branch, &q)
                }
            };
            undecided += cells.iter().filter(|c| **c == Cell::Undecided).count();
            rows.row(&cells)?;
        }
        progress.show("rows", done as u64, degrees.len() as u64);
    }
    Ok(decided(undecided, args.digits.unwrap_or(0)))
}

fn fold_json(fold: &Fold) -> Value {
    json!({
        "phi1_deg": fold.phi1.to_degrees(),
        "phi4_deg": fold.phi4.to_degrees(),
        "branches": fold.branches,
        "begins": fold.begins,
    })
}

/// What a JSON file begins with.
fn head(linkage: &Linkage) -> Map<String, Value> {
    let mut map = Map::new();
    map.insert("schema_version".into(), json!(1));
    map.insert("mechaudit_version".into(), json!(env!("CARGO_PKG_VERSION")));
    map.insert("type".into(), json!("class-iii"));
    map.insert("name".into(), json!(linkage.name));
    if let Some(c) = &linkage.crank {
        map.insert("crank_speed_rad_per_s".into(), json!(c.omega.to_f64()));
        map.insert(
            "crank_acceleration_rad_per_s2".into(),
            json!(c.epsilon.to_f64()),
        );
    }
    map
}

/// What is known of the branch.
fn facts(linkage: &Linkage, branch: &Branch) -> Map<String, Value> {
    let mut map = head(linkage);
    map.insert("branch".into(), json!(branch.mode));
    let (full, turns, low, high) = match branch.reach {
        Reach::Whole { turns } => (true, turns, None, None),
        Reach::Part { low, high } => (false, None, Some(low), Some(high)),
    };
    map.insert("full_rotation".into(), json!(full));
    map.insert("turns_to_close".into(), json!(turns));
    let end = |e: branch::End| json!({ "phi1_deg": e.phi1.to_degrees(), "phi4_deg": e.phi4.to_degrees() });
    let range = low
        .zip(high)
        .map(|(a, b)| json!({ "from": end(a), "to": end(b) }));
    map.insert("crank_range".into(), json!(range));
    let dead: Vec<Value> = branch
        .dead
        .iter()
        .map(|d| json!({ "phi1_deg": d.state.phi1.to_degrees(), "stretched": d.stretched }))
        .collect();
    map.insert("dead_positions".into(), json!(dead));
    map
}
