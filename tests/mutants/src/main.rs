//! Mutation testing with all mutants of the files in one binary.
//!
//! Each mutant stands behind a number that the program under test reads from its environment, so
//! that the crate is compiled once (and a few times more, until the mutants that do not compile are
//! out), and each mutant meets only the tests that reach it, until one fails.

mod mutate;
mod planted;
mod render;
mod switch;
mod tests_run;
mod tree;

use anyhow::{Context, Result, bail};
use clap::Parser;
use mutate::{Kind, Place};
use render::{Mutant, Rendered, render};
use serde::Serialize;
use std::collections::HashSet;
use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;
use tests_run::{Suite, Verdict};
use tree::{Executable, Tree};

/// Changes one operator, number, condition, bound or statement at a time and tells which changes no
/// test notices.
///
/// Exit codes: 0, every mutant is caught; 1, some are missed; 2, nothing could be judged.
#[derive(Parser, Debug)]
struct Args {
    /// Files of one package, relative to the project's root
    #[arg(required_unless_present = "planted")]
    files: Vec<String>,
    /// Plant the faults of this table, one at a time: the test named beside each has to fail
    #[arg(long, value_name = "CSV", conflicts_with_all = ["files", "sample", "list", "output", "filter", "lib", "bin", "test"])]
    planted: Option<PathBuf>,
    /// The package they belong to
    #[arg(long, default_value = "mechaudit-reference")]
    package: String,
    /// The package whose tests they meet, itself if left out
    #[arg(long, value_name = "PACKAGE")]
    tests_of: Option<String>,
    /// The tests in the package's library; the only ones if none are named
    #[arg(long)]
    lib: bool,
    /// The tests in a program of the package
    #[arg(long, value_name = "NAME")]
    bin: Vec<String>,
    /// Tests of the package beside its sources
    #[arg(long, value_name = "NAME")]
    test: Vec<String>,
    /// Only tests with this in their names
    #[arg(long, value_name = "TEXT")]
    filter: Vec<String>,
    /// Leave out tests that take longer than this many seconds
    #[arg(long, value_name = "S", default_value_t = 20.0)]
    longest: f64,
    /// Spend this number of seconds on one mutant; one that no test has noticed until then is
    /// missed
    #[arg(long, value_name = "S")]
    most: Option<f64>,
    /// The number of mutants, drawn by chance and judged in that order: those judged first are a sample
    /// too
    #[arg(long, value_name = "N")]
    sample: Option<usize>,
    /// The seed of the draw
    #[arg(long, value_name = "N", default_value_t = 1, requires = "sample")]
    seed: u64,
    /// List the mutants and judge none
    #[arg(long)]
    list: bool,
    /// Mutants judged at once; all cores if left out
    #[arg(long, value_name = "N")]
    jobs: Option<usize>,
    /// Where the copy of the project is changed and built, one folder for each run at a time;
    /// target/mutants if left out
    #[arg(long, value_name = "FOLDER")]
    work: Option<PathBuf>,
    /// Write every mutant with its verdict to this CSV file, as soon as it is judged
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Serialize)]
struct Row<'a> {
    file: &'a str,
    line: usize,
    column: usize,
    function: &'a str,
    original: String,
    instead: String,
    verdict: &'static str,
    test: String,
}

struct Source {
    name: String,
    text: String,
    places: Vec<Place>,
}

/// Rounds of compiling after which what is left to blame is not found.
const ROUNDS: usize = 40;

fn main() -> ExitCode {
    let ended = match std::env::var_os(tree::COMPILER) {
        Some(_) => tree::compiler(),
        None => audit(&Args::parse()).map(|good| ExitCode::from(u8::from(!good))),
    };
    match ended {
        Ok(code) => code,
        Err(e) => {
            eprintln!("mutants: {e:#}");
            ExitCode::from(2)
        }
    }
}

fn audit(args: &Args) -> Result<bool> {
    let project = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let project = project.canonicalize().context("the project")?;
    let folder = args.work.clone();
    let work = std::path::absolute(folder.unwrap_or_else(|| project.join("target/mutants")))?;
    if let Some(table) = &args.planted {
        return planted::check(&project, &work, table);
    }
    let sources = read(&project, &args.files)?;
    let mut mutants = all(&sources);
    if let Some(n) = args.sample {
        fastrand::Rng::with_seed(args.seed).shuffle(&mut mutants);
        mutants.truncate(n);
    }
    if args.list {
        for m in &mutants {
            let row = row(&sources, m, &Verdict::Unreached);
            println!(
                "{}:{}:{}: {} → {}",
                row.file, row.line, row.column, row.original, row.instead
            );
        }
        return Ok(true);
    }
    let tree = Tree::new(&project, &work, false)?;
    let named = |kind: &str, names: &[String]| -> Vec<String> {
        let each = names.iter();
        each.flat_map(|n| [kind.into(), n.clone()]).collect()
    };
    let mut targets = [named("--bin", &args.bin), named("--test", &args.test)].concat();
    if args.lib || targets.is_empty() {
        targets.push("--lib".into());
    }
    let mut left_out = HashSet::new();
    let tested = args.tests_of.as_deref().unwrap_or(&args.package);
    // Most of what does not compile is found without generating code.
    let first = Step::Check;
    let executables = compile(
        &tree,
        [&[&args.package], &[tested]],
        &sources,
        &mutants,
        &targets,
        first,
        &mut left_out,
    )?;
    let viable: Vec<&Mutant> = mutants
        .iter()
        .filter(|m| !left_out.contains(&m.number))
        .collect();
    let jobs = args
        .jobs
        .unwrap_or_else(|| std::thread::available_parallelism().map_or(1, Into::into));
    let longest = Duration::from_secs_f64(args.longest);
    let suite = Suite::new(&executables, &args.filter, longest, jobs, &work)?;
    eprintln!(
        "{} mutants, {} do not compile; {} tests, {} too long",
        mutants.len(),
        left_out.len(),
        suite.tests.len(),
        suite.too_long.len()
    );
    for name in &suite.too_long {
        eprintln!("too long: {name}");
    }
    let table = match &args.output {
        Some(path) => {
            Some(csv::Writer::from_path(path).with_context(|| path.display().to_string())?)
        }
        None => None,
    };
    let most = args.most.map(Duration::from_secs_f64);
    let verdicts = judge(&suite, &sources, &viable, jobs, most, table)?;
    report(args, &sources, &viable, &verdicts)
}

fn read(project: &std::path::Path, files: &[String]) -> Result<Vec<Source>> {
    files
        .iter()
        .map(|name| {
            let text = fs::read_to_string(project.join(name)).with_context(|| name.clone())?;
            let places = mutate::places(&text).with_context(|| name.clone())?;
            Ok(Source {
                name: name.clone(),
                text,
                places,
            })
        })
        .collect()
}

fn all(sources: &[Source]) -> Vec<Mutant> {
    let mut mutants = Vec::new();
    for (file, s) in sources.iter().enumerate() {
        for (place, p) in s.places.iter().enumerate() {
            for choice in 0..p.instead.len().max(1) {
                mutants.push(Mutant {
                    number: mutants.len() as u32,
                    file,
                    place,
                    choice,
                });
            }
        }
    }
    mutants
}

/// The work asked of the compiler.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Step {
    Check,
    Build,
}

/// Compiles all mutants of packages for the tests of the same or of others, fewer from round to
/// round, until what is left compiles.
fn compile(
    tree: &Tree,
    [changed, tested]: [&[&str]; 2],
    sources: &[Source],
    mutants: &[Mutant],
    targets: &[String],
    mut step: Step,
    left_out: &mut HashSet<u32>,
) -> Result<Vec<Executable>> {
    let roots = changed.iter().map(|p| tree.roots(p));
    let roots = roots.collect::<Result<Vec<_>>>()?.concat();
    for root in &roots {
        if !sources.iter().any(|s| s.name == *root) {
            // The tree is a fresh copy: no switch stands in it yet.
            let original = fs::read_to_string(tree.root.join(root))?;
            tree.write(root, &(original + switch::SOURCE))?;
        }
    }
    for _ in 0..ROUNDS {
        let mut rendered: Vec<Rendered> = Vec::new();
        for (file, s) in sources.iter().enumerate() {
            let here: Vec<&Mutant> = mutants.iter().filter(|m| m.file == file).collect();
            let mut r = render(
                &s.text,
                &s.places,
                &here,
                left_out,
                "crate::mutant_switch::on",
            );
            if roots.contains(&s.name) {
                r.text.push_str(switch::SOURCE);
            }
            tree.write(&s.name, &r.text)?;
            rendered.push(r);
        }
        let built = tree.cargo(tested, targets, step == Step::Build)?;
        if built.errors.is_empty() {
            if step == Step::Build {
                return Ok(built.executables);
            }
            step = Step::Build;
            continue;
        }
        let before = left_out.len();
        // A place beside the errors is to blame only where nothing at them is.
        for primary in [true, false] {
            for e in built.errors.iter().filter(|e| e.primary == primary) {
                let file = sources.iter().position(|s| s.name == e.file);
                if let Some(file) = file {
                    left_out.extend(rendered[file].blamed(&e.bytes));
                }
            }
            if left_out.len() > before {
                break;
            }
        }
        if left_out.len() == before {
            let e = &built.errors[0];
            bail!("{} at {:?}: {}", e.file, e.bytes, e.message);
        }
    }
    bail!("after {ROUNDS} rounds there are still mutants that do not compile");
}

fn judge(
    suite: &Suite,
    sources: &[Source],
    viable: &[&Mutant],
    jobs: usize,
    most: Option<Duration>,
    table: Option<csv::Writer<fs::File>>,
) -> Result<Vec<Verdict>> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new((Vec::new(), table));
    let job = || -> Result<()> {
        while let Some((i, m)) = {
            let i = next.fetch_add(1, Ordering::Relaxed);
            viable.get(i).map(|m| (i, m))
        } {
            let verdict = suite.judge(m, most)?;
            let mut done = done.lock().expect("no job panics");
            let (verdicts, table) = &mut *done;
            if let Some(table) = table {
                table.serialize(row(sources, m, &verdict))?;
                table.flush()?;
            }
            verdicts.push((i, verdict));
            if verdicts.len() % 50 == 0 {
                eprintln!("{} of {}", verdicts.len(), viable.len());
            }
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let jobs: Vec<_> = (0..jobs).map(|_| scope.spawn(job)).collect();
        let ended = jobs.into_iter().map(|j| j.join().expect("no job panics"));
        ended.collect::<Result<Vec<()>>>()
    })?;
    let (mut verdicts, _) = done.into_inner().expect("no job panics");
    verdicts.sort_by_key(|(i, _)| *i);
    Ok(verdicts.into_iter().map(|(_, v)| v).collect())
}

fn row<'a>(sources: &'a [Source], m: &Mutant, verdict: &Verdict) -> Row<'a> {
    let s = &sources[m.file];
    let place = &s.places[m.place];
    let one_line = |t: &str| t.split_whitespace().collect::<Vec<_>>().join(" ");
    let (word, test) = match verdict {
        Verdict::Caught(t) => ("caught", t.clone()),
        Verdict::TimedOut(t) => ("timed out", t.clone()),
        Verdict::Missed => ("missed", String::new()),
        Verdict::Unreached => ("unreached", String::new()),
    };
    Row {
        file: &s.name,
        line: place.line,
        column: place.column,
        function: &place.function,
        original: one_line(&s.text[place.bytes.clone()]),
        instead: match place.kind {
            Kind::Statement => "left out".into(),
            _ => one_line(&place.instead[m.choice]),
        },
        verdict: word,
        test,
    }
}

fn report(
    args: &Args,
    sources: &[Source],
    viable: &[&Mutant],
    verdicts: &[Verdict],
) -> Result<bool> {
    let mut counts = [0; 4];
    for (m, verdict) in viable.iter().zip(verdicts) {
        let row = row(sources, m, verdict);
        let k = match verdict {
            Verdict::Caught(_) => 0,
            Verdict::TimedOut(_) => 1,
            Verdict::Missed => 2,
            Verdict::Unreached => 3,
        };
        counts[k] += 1;
        if k >= 2 {
            println!(
                "{} {}:{}:{} in {}: {} → {}",
                row.verdict,
                row.file,
                row.line,
                row.column,
                row.function,
                row.original,
                row.instead
            );
        }
    }
    let [caught, timed_out, missed, unreached] = counts;
    let n = viable.len();
    println!(
        "{n} viable: {caught} caught, {timed_out} timed out, {missed} missed, {unreached} unreached"
    );
    if n > 0 {
        let share = (caught + timed_out) as f64 / n as f64;
        print!("{:.1} % caught or timed out", 100.0 * share);
        if args.sample.is_some() {
            let (low, high) = wilson(caught + timed_out, n);
            print!(
                " (95 % confidence: {:.1} to {:.1} %)",
                100.0 * low,
                100.0 * high
            );
        }
        println!();
    }
    Ok(missed + unreached == 0)
}

/// Wilson's interval (*JASA* 22 (1927) 209–212) for a share of k in n, 95 %.
fn wilson(k: usize, n: usize) -> (f64, f64) {
    const Z: f64 = 1.959_963_984_540_054;
    let (k, n) = (k as f64, n as f64);
    let p = k / n;
    let z2 = Z * Z / n;
    let centre = (p + z2 / 2.0) / (1.0 + z2);
    let half = Z / (1.0 + z2) * (p * (1.0 - p) / n + z2 / (4.0 * n)).sqrt();
    (centre - half, centre + half)
}

#[cfg(test)]
mod tests {
    #[test]
    fn wilson_is_inside_and_known() {
        // 8 of 10, worked out by hand.
        let (low, high) = super::wilson(8, 10);
        assert!((low - 0.4902).abs() < 1e-4 && (high - 0.9433).abs() < 1e-4);
        let (low, high) = super::wilson(10, 10);
        assert!(low > 0.7 && high <= 1.0 + 1e-12);
    }
}
