//! Faults named in a table, each with the test that has to notice it.

use crate::mutate::{Kind, Place};
use crate::render::Mutant;
use crate::tests_run::{Ended, LONGEST, limit, names, run};
use crate::tree::{Executable, Tree};
use crate::{Source, Step, compile};
use anyhow::{Context, Result, bail};
use rayon::prelude::*;
use serde::Deserialize;
use std::collections::{BTreeSet, HashMap, HashSet};
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

/// A test that takes longer costs more than the condition of a row is worth.
const LONG: Duration = Duration::from_secs(5);

/// A condition on which a proof or a verdict rests.
#[derive(Deserialize)]
struct Row {
    package: String,
    file: String,
    /// Describes the condition in words.
    condition: String,
    /// The expression in the file, which stands there once.
    code: String,
    /// The text that replaces it in the fault.
    fault: String,
    /// The test, by its path in the crate.
    test: String,
}

/// Returns true if every fault makes its test fail and without one every test passes.
pub fn check(project: &Path, work: &Path, table: &Path) -> Result<bool> {
    let mut reader = csv::Reader::from_path(table).with_context(|| table.display().to_string())?;
    let rows = reader.deserialize().collect::<Result<Vec<Row>, _>>();
    let rows = rows.with_context(|| table.display().to_string())?;
    let (sources, mutants) = planted(project, &rows)?;
    let start = Instant::now();
    let told = |done: &str| println!("{:.0} s: {done}", start.elapsed().as_secs_f64());
    let tree = Tree::new(project, work, true)?;
    told("copied");
    let packages: BTreeSet<&str> = rows.iter().map(|row| row.package.as_str()).collect();
    let packages: Vec<&str> = packages.into_iter().collect();
    let mut left_out = HashSet::new();
    let targets = ["--lib".to_string()];
    // All that `cargo test` tests at once, with the same features, and without a check beforehand:
    // every fault is meant to compile.
    let first = Step::Build;
    let executables = compile(
        &tree,
        [&packages, &[]],
        &sources,
        &mutants,
        &targets,
        first,
        &mut left_out,
    )?;
    if let Some(n) = left_out.iter().min() {
        let row = &rows[*n as usize];
        bail!("{}: the fault {:?} does not compile", row.file, row.fault);
    }
    told("built");
    // The program that holds a test, by package and test.
    let mut there: HashMap<(String, String), &Executable> = HashMap::new();
    for e in &executables {
        for test in names(e, &[])? {
            there.insert((e.package.clone(), test), e);
        }
    }
    let named = |row: &Row| (row.package.clone(), row.test.clone());
    let asked: BTreeSet<(String, String)> = rows.iter().map(named).collect();
    // The time of each test without a fault; nothing if it fails.
    let sound = asked
        .par_iter()
        .filter_map(|test| Some((test, *there.get(test)?)));
    let sound = sound.map(|(test, program)| {
        let start = Instant::now();
        let ended = run(program, &test.1, &[], LONGEST)?;
        Ok((
            test,
            (program, (ended == Ended::Passed).then(|| start.elapsed())),
        ))
    });
    let sound = sound.collect::<Result<HashMap<_, (&Executable, Option<Duration>)>>>()?;
    for ((_, test), (_, takes)) in &sound {
        if let Some(takes) = takes.filter(|takes| *takes > LONG) {
            println!("{test} takes {:.0} s", takes.as_secs_f64());
        }
    }
    told("every test without a fault");
    let noticed = rows.par_iter().enumerate().map(|(n, row)| {
        let place = format!("{}: {} → {}", row.file, row.code, row.fault);
        let (program, takes) = match sound.get(&named(row)) {
            Some((program, Some(takes))) => (program, *takes),
            Some((_, None)) => {
                println!("{} fails without any fault", row.test);
                return Ok(false);
            }
            None => {
                println!("{place}: there is no test {}", row.test);
                return Ok(false);
            }
        };
        let number = n.to_string();
        let planted = [("MUTANT", number.as_str())];
        let ended = run(program, &row.test, &planted, limit(takes))?;
        if ended == Ended::Passed {
            println!("{place}: {} passes ({})", row.test, row.condition);
        }
        Ok(ended != Ended::Passed)
    });
    let noticed = noticed.collect::<Result<Vec<bool>>>()?;
    told("every test with its fault");
    let good = noticed.iter().filter(|n| **n).count();
    println!("{good} of {} faults make their tests fail", rows.len());
    Ok(good == rows.len())
}

/// The files with a place for each piece of code that is named.
fn planted(project: &Path, rows: &[Row]) -> Result<(Vec<Source>, Vec<Mutant>)> {
    let mut sources: Vec<Source> = Vec::new();
    let mut found = Vec::new();
    for row in rows {
        let file = match sources.iter().position(|s| s.name == row.file) {
            Some(file) => file,
            None => {
                let text = fs::read_to_string(project.join(&row.file));
                sources.push(Source {
                    name: row.file.clone(),
                    text: text.with_context(|| row.file.clone())?,
                    places: Vec::new(),
                });
                sources.len() - 1
            }
        };
        let text = &sources[file].text;
        let mut at = text.match_indices(row.code.as_str());
        let (Some((start, _)), None) = (at.next(), at.next()) else {
            bail!("{}: {:?} does not stand there once", row.file, row.code);
        };
        found.push((file, start..start + row.code.len()));
    }
    for (file, source) in sources.iter_mut().enumerate() {
        let here = found.iter().zip(rows).filter(|((f, _), _)| *f == file);
        for ((_, bytes), row) in here {
            if let Some(place) = source.places.iter_mut().find(|p| p.bytes == *bytes) {
                place.instead.push(row.fault.clone());
                continue;
            }
            source.places.push(Place {
                kind: Kind::Expression,
                line: source.text[..bytes.start].matches('\n').count() + 1,
                column: 1,
                function: row.condition.clone(),
                bytes: bytes.clone(),
                instead: vec![row.fault.clone()],
            });
        }
        source
            .places
            .sort_by_key(|p| (p.bytes.start, usize::MAX - p.bytes.end));
    }
    let mutants = found.iter().zip(rows).enumerate();
    let mutants = mutants.map(|(n, ((file, bytes), row))| {
        let places = &sources[*file].places;
        let place = places.iter().position(|p| p.bytes == *bytes);
        let place = place.context("a place for every row")?;
        let instead = places[place].instead.iter();
        let choice = instead.clone().position(|t| *t == row.fault);
        Ok(Mutant {
            number: n as u32,
            file: *file,
            place,
            choice: choice.context("a text for every row")?,
        })
    });
    let mutants = mutants.collect::<Result<Vec<Mutant>>>()?;
    Ok((sources, mutants))
}
