//! Several programs at the same cases, side by side.

use crate::cli::args::{CompareArgs, CompareFormat};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, write_json};
use crate::cli::lookup;
use crate::cli::process::answers::{Batch, End};
use crate::cli::process::candidate::{Candidate, CandidateProcess, unanswered};
use crate::cli::process::inputs::Inputs;
use crate::cli::process::interrupt;
use crate::cli::progress::Progress;
use crate::cli::report::{self, POINTS};
use crate::cli::terminal::width;
use crate::cli::workload::{self, Selection, Workload, reproduce_command};
use mechaudit::audit::{
    Case, Comparison, Method, MethodReport, Settings, SolverAnswer, Speed, Tally, answer_of,
    judge_together,
};
use mechaudit::report::{csv, html, json, text};
use rayon::prelude::*;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Cases judged together.
const BATCH: usize = 1024;
/// Inputs of a first timed run, the most of any, and how long the last one takes at least if they
/// suffice.
const FEW: usize = 200;
const MANY: usize = 500_000;
const LONG: Duration = Duration::from_millis(400);
/// Runs of one input.
const STARTS: usize = 3;

/// Compares them.
pub fn compare(args: &CompareArgs) -> Result<Outcome, Failure> {
    let mut settings = workload::settings(&args.run)?;
    if args.format == CompareFormat::Html {
        settings.points = POINTS;
    }
    let method = lookup::method(&args.method)?;
    if args.with.is_some() {
        lookup::has_solver(&*method)?;
    }
    let selection = Selection::new(&args.place, &args.scope);
    let output = Output::open(args.output.as_deref())?;
    let before = args
        .baseline
        .as_deref()
        .map(report::read_baseline)
        .transpose()?;
    let workload = Workload::of_one(&*method, selection, settings)?;
    workload.check()?;
    let (variant, settings) = (&workload.methods[0], &workload.settings);
    let inputs = Inputs::of(variant, workload.one.clone(), settings)?;
    let commands = args.exec.iter();
    let candidates: Vec<Candidate> = commands
        .map(|command| workload::candidate(command, &args.program))
        .collect();
    let reports = judged(variant, &candidates, args.with.is_some(), &inputs, settings)?;
    let stopped = reports.iter().any(|r| r.interrupted);
    // The method's own solver comes after all candidates.
    let answered_by = candidates.iter().map(Some).chain([None]);
    let timed: Vec<(MethodReport, Option<Speed>)> = reports
        .into_iter()
        .zip(answered_by)
        .map(|(mut report, candidate)| {
            report.reproduce.tail = reproduce_command(candidate, selection);
            let speed = match candidate {
                _ if args.no_speed || stopped => None,
                Some(candidate) => speed(|n| timed(candidate, &inputs, n)),
                None => Some(called(variant, &inputs)),
            };
            (report, speed)
        })
        .collect();
    let found = Comparison::new(variant.name(), timed);
    let changes = before.as_ref().map(|b| b.changes_of(&found));
    match args.format {
        CompareFormat::Text => output.write(|out| {
            write!(out, "{}", text::comparison::comparison(&found, width()))?;
            if let Some(changes) = &changes {
                write!(out, "{}", text::comparison::changes(changes, width()))?;
            }
            Ok(())
        })?,
        CompareFormat::Json => write_json(output, &json::comparison(&found, changes.as_ref()))?,
        CompareFormat::Html => output.text(html::audit::comparison(&found, changes.as_ref()))?,
        CompareFormat::Csv => output.write(|out| Ok(csv::comparison(&found, out)?))?,
    }
    Ok(Outcome::unless_interrupted(
        found.interrupted(),
        found.passed(),
    ))
}

/// Runs all programs over all cases, one batch of cases after the other.
fn judged(
    method: &dyn Method,
    candidates: &[Candidate],
    with_ours: bool,
    inputs: &Arc<Inputs>,
    settings: &Settings,
) -> Result<Vec<MethodReport>, Failure> {
    let total = inputs.len();
    let start = |candidate| CandidateProcess::start(candidate, inputs, total);
    let mut programs: Vec<CandidateProcess> =
        candidates.iter().map(start).collect::<Result<_, _>>()?;
    let ours = usize::from(with_ours);
    let mut tallies = vec![Tally::new(method, settings); programs.len() + ours];
    let mut ends: Vec<Option<End>> = programs.iter().map(|_| None).collect();
    let progress = Progress::new();
    for from in (0..total).step_by(BATCH) {
        let to = total.min(from + BATCH);
        let mut answers: Vec<Vec<Option<SolverAnswer>>> = vec![Vec::new(); to - from];
        for (program, end) in programs.iter_mut().zip(&mut ends) {
            let mut batch = Batch::default();
            if end.is_none() {
                *end = program.collect(to - from, &mut batch);
            }
            let given = |i: usize| (i < batch.len()).then(|| batch.get(i));
            let all = answers.iter_mut().enumerate();
            all.for_each(|(i, a)| a.push(given(i)));
        }
        // The programs have been shown them by now.
        let cases = inputs.take(from..to).into_iter();
        let mut cases: Vec<(Case, _)> = cases.zip(answers).collect();
        if ours > 0 {
            cases
                .par_iter_mut()
                .for_each(|(case, answers)| answers.push(Some(answer_of(method, &case.input))));
        }
        judge_together(method, settings, cases, &mut tallies);
        progress.show(method.name(), to as u64, total as u64);
        if interrupt::is_requested() {
            tallies.iter_mut().for_each(Tally::interrupt);
            break;
        }
    }
    drop(progress);
    let mut troubles = Vec::new();
    for ((program, end), tally) in programs.iter_mut().zip(ends).zip(&mut tallies) {
        let end = match end {
            _ if tally.is_interrupted() => End::Interrupted,
            Some(end) => end,
            None => program.rest(),
        };
        let trouble = program.end(end);
        if let (Some(why), false) = (&trouble, tally.is_interrupted()) {
            unanswered(method, settings, inputs, program.answered(), why, tally);
        }
        troubles.push(program.report(trouble));
    }
    let mut known = troubles.into_iter();
    let reports = tallies.into_iter().map(|tally| {
        let mut report = tally.finish(method);
        report.candidate = known.next();
        report
    });
    Ok(reports.collect())
}

/// Returns the time that a candidate takes for `n` inputs, if it answers all of them and ends well.
fn timed(candidate: &Candidate, inputs: &Arc<Inputs>, n: usize) -> Option<Duration> {
    let start = Instant::now();
    let mut process = CandidateProcess::start(candidate, inputs, n).ok()?;
    let mut left = n;
    while left > 0 {
        let mut batch = Batch::default();
        if process.collect(left.min(BATCH), &mut batch).is_some() {
            return None;
        }
        left -= batch.len();
    }
    let end = process.rest();
    process.end(end).is_none().then(|| start.elapsed())
}

/// The time for an answer through the protocol, start-up apart; `run` takes that number of inputs.
fn speed(run: impl Fn(usize) -> Option<Duration>) -> Option<Speed> {
    let starts: Option<Vec<Duration>> = (0..STARTS).map(|_| run(1)).collect();
    let start = starts?.into_iter().min()?;
    // More and more of them, until starting it is no matter.
    let (mut n, mut taken) = (FEW, run(FEW)?.saturating_sub(start));
    while n < MANY && taken < LONG {
        n = more(n, taken);
        taken = run(n)?.saturating_sub(start);
    }
    Some(Speed {
        ns_per_answer: nanoseconds(taken, n - 1),
        start_up_ms: Some(start.as_secs_f64() * 1e3),
        answers: n as u64,
    })
}

/// Returns the number of inputs likely to take long enough, if `n` took `taken`: 2n to 16n.
fn more(n: usize, taken: Duration) -> usize {
    let wanted = LONG.as_secs_f64() / taken.as_secs_f64().max(1e-9) * n as f64 * 1.25;
    (wanted as usize).clamp(2 * n, 16 * n).min(MANY)
}

/// The time for each of `answers` answers.
fn nanoseconds(taken: Duration, answers: usize) -> f64 {
    taken.as_secs_f64() * 1e9 / answers as f64
}

/// The time for an answer of the method's own solver, called in this process on one core.
fn called(method: &dyn Method, inputs: &Inputs) -> Speed {
    let all: Vec<Vec<f64>> = spread(inputs.len())
        .map(|k| inputs.take_one(k).input)
        .collect();
    let n = all.len();
    let round = || {
        let start = Instant::now();
        for input in &all {
            std::hint::black_box(answer_of(method, std::hint::black_box(input)));
        }
        nanoseconds(start.elapsed(), n)
    };
    Speed {
        ns_per_answer: (0..STARTS).map(|_| round()).fold(f64::INFINITY, f64::min),
        start_up_ms: None,
        answers: n as u64,
    }
}

/// Numbers of as many inputs as are judged together, evenly spread over all.
fn spread(all: usize) -> impl Iterator<Item = usize> {
    let n = all.min(BATCH);
    (0..n).map(move |k| k * all / n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::{Args, Command};
    use clap::Parser;
    use std::cell::RefCell;
    use std::path::Path;

    fn compared(line: &str) -> CompareArgs {
        let words = line.split_whitespace();
        match Args::parse_from(["mechaudit", "compare"].into_iter().chain(words)).command {
            Some(Command::Compare(args)) => args,
            _ => unreachable!("a comparison"),
        }
    }

    /// Returns the file that a comparison of the method's own solver alone writes.
    fn ours(folder: &Path, line: &str) -> (Outcome, String) {
        let file = folder.join("found");
        let line = format!("{line} --with ours --exec none --output {}", file.display());
        let mut args = compared(&line);
        args.exec.clear();
        let outcome = compare(&args).unwrap();
        (outcome, std::fs::read_to_string(&file).unwrap())
    }

    /// More cases than are judged together, one of them, other budgets, with and without its speed.
    #[test]
    fn the_methods_own_solver_is_compared() {
        let folder = tempfile::tempdir().unwrap();
        let json = |more: &str| -> serde_json::Value {
            let line = format!("slider-crank --region central --format json {more}");
            let (outcome, text) = ours(folder.path(), &line);
            assert_eq!(outcome, Outcome::AsExpected, "{more}");
            serde_json::from_str(&text).unwrap()
        };
        let report = |v: &serde_json::Value| v["candidates"][0]["report"].clone();
        let many = json("--cases 1030 --no-speed");
        assert_eq!(many["candidates"].as_array().map(Vec::len), Some(1));
        assert_eq!(
            (&report(&many)["cases"], &report(&many)["passed"]),
            (&1030.into(), &1030.into())
        );
        assert!(many["candidates"][0]["speed"].is_null() && report(&many)["candidate"].is_null());
        assert_eq!(report(&many)["settings"]["points"], 0);
        assert_eq!(report(&many)["reproduce"]["tail"], "");
        let one = json("--case 3 --ulps 1000 --no-speed");
        assert_eq!(report(&one)["cases"], 1);
        assert_eq!(report(&one)["reproduce"]["tail"], " --ulps 1000.0");
        let timed = json("--cases 4");
        let speed = &timed["candidates"][0]["speed"];
        assert_eq!(
            (report(&timed)["cases"].as_u64(), speed["answers"].as_u64()),
            (Some(4), Some(4))
        );
        assert!(speed["ns_per_answer"].as_f64().unwrap() > 0.0 && speed["start_up_ms"].is_null());
    }

    #[test]
    fn a_comparison_has_four_forms() {
        let folder = tempfile::tempdir().unwrap();
        let line = "slider-crank --region central --region offset --cases 3 --no-speed";
        let form = |form: &str| ours(folder.path(), &format!("{line} --format {form}")).1;
        // A line for each region and one for all.
        assert_eq!(form("csv").lines().count(), 1 + 3);
        let page = form("html");
        assert!(page.trim_end().ends_with("</html>") && page.contains("class=\"heat\""));
        assert!(form("text").contains("times the best"));
        let old = folder.path().join("old.json");
        std::fs::write(&old, form("json")).unwrap();
        let line = format!("{line} --baseline {} --format json", old.display());
        let (outcome, text) = ours(folder.path(), &line);
        let found: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(outcome, Outcome::AsExpected);
        assert_eq!(
            found["baseline"]["changes"].as_array().map(Vec::len),
            Some(0)
        );
    }

    /// One input takes 50 ms or more, every other the same time.
    #[test]
    fn starting_a_program_is_no_part_of_its_speed() {
        let found = |each: Duration| {
            let asked = RefCell::new(Vec::new());
            let speed = speed(|n| {
                let late = [60, 50, 55].get(asked.borrow().len()).unwrap_or(&50);
                asked.borrow_mut().push(n);
                Some(Duration::from_millis(*late) + each * (n as u32 - 1))
            });
            let speed = speed.unwrap();
            let start = speed.start_up_ms.unwrap();
            assert!((start - 50.0).abs() < 1e-9, "{start}");
            let due = each.as_secs_f64() * 1e9;
            assert!((speed.ns_per_answer / due - 1.0).abs() < 1e-9, "{due}");
            assert_eq!(asked.borrow().last(), Some(&(speed.answers as usize)));
            (asked.into_inner(), speed.answers)
        };
        // 1999 others of 0.25 ms are enough.
        let (asked, answers) = found(Duration::from_micros(250));
        assert_eq!(asked[..4], [1, 1, 1, 200]);
        assert!((2000..=3200).contains(&answers), "{answers}");
        let (asked, answers) = found(Duration::from_millis(3));
        assert_eq!((&asked[..], answers), (&[1, 1, 1, 200][..], 200));
        // As many as there may be do not take long.
        let (asked, answers) = found(Duration::from_nanos(10));
        assert_eq!((asked[4..].len(), answers), (3, 500_000));
    }

    #[test]
    fn long_enough_is_long_enough() {
        let speed = speed(|n| Some(if n > 1 { LONG } else { Duration::ZERO }));
        assert_eq!(speed.map(|s| s.answers), Some(200));
    }

    /// Whichever run it is that fails.
    #[test]
    fn what_does_not_answer_has_no_speed() {
        for bad in [1, 200, 3200] {
            let run = |n: usize| (n != bad).then_some(Duration::ZERO);
            assert!(speed(run).is_none(), "{bad}");
        }
    }

    #[test]
    fn inputs_are_spread_over_all() {
        assert_eq!(spread(0).count(), 0);
        assert_eq!(spread(3).collect::<Vec<_>>(), [0, 1, 2]);
        assert!(spread(BATCH).eq(0..BATCH));
        assert!(spread(3 * BATCH).eq((0..BATCH).map(|k| 3 * k)));
        let last = spread(BATCH + 1).last();
        assert_eq!((spread(BATCH + 1).count(), last), (BATCH, Some(BATCH - 1)));
    }

    #[test]
    fn timed_runs_grow_until_they_are_long() {
        let more = |n: usize, ms: u64| more(n, Duration::from_millis(ms));
        assert_eq!(more(200, 100), 1000);
        assert_eq!(more(200, 399), 400);
        assert_eq!(more(200, 1), 3200);
        assert_eq!(more(200, 0), 3200);
        assert_eq!(more(100_000, 1), MANY);
    }

    #[test]
    fn the_time_of_an_answer() {
        assert_eq!(nanoseconds(Duration::from_millis(3), 1000), 3000.0);
        let method = lookup::method("slider-crank").unwrap();
        let inputs = Inputs::of(&*method, None, &Settings::default()).unwrap();
        let start = Instant::now();
        let speed = called(&*method, &inputs);
        let most = start.elapsed().as_secs_f64() * 1e9;
        // The quickest of its rounds, which are a part of the whole.
        let all = speed.ns_per_answer * speed.answers as f64 * STARTS as f64;
        assert!(0.0 < all && all <= most, "{all} ns of {most} ns");
        assert_eq!((speed.answers, speed.start_up_ms), (1024, None));
        // Roots and sines take more than nothing.
        assert!(speed.ns_per_answer > 20.0, "{}", speed.ns_per_answer);
    }
}
