//! Running audits: of everything, of methods, of a part of one, or of one case.
//!
//! An audit is a pipeline: the arguments give a [`Workload`] and perhaps a [`Candidate`], a panel
//! judges its cases, and the reports are written in the selected form.

use crate::cli::args::{AuditArgs, AuditFormat, Numbers, RunArgs};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, print, write_to};
use crate::cli::process::candidate::{self, Candidate};
use crate::cli::process::interrupt;
use crate::cli::progress::Progress;
use crate::cli::report::{self, ReportExtras};
use crate::cli::terminal::width;
use crate::cli::workload::{self, Selection, Workload, reproduce_command};
use crate::cli::{complain, lookup};
use mechaudit::audit::{
    Cases, ConvergenceReport, Method, MethodReport, Settings, Uncertified, audit_method_until,
    audit_one, convergence, map_points,
};
use mechaudit::methods::Evaluable;
use mechaudit::papers::PaperReport;
use mechaudit::reference::Undecided;
use mechaudit::report::text;
use mechaudit::report::text::summary::{self, End};
use mechaudit::report::words::audit::{all_pass, settings as settings_line, totals};
use mechaudit::report::words::numbers::count;
use mechaudit::{methods, papers};
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Instant;

/// Audits every paper and every method: the verdict first, then what is new, then a line for each
/// method and finding. With `verbose` all of it in full, below.
pub fn everything(args: &RunArgs, verbose: bool) -> Result<Outcome, Failure> {
    let methods = methods::registry();
    let (place, scope) = Default::default();
    let selection = Selection {
        laws: true,
        ..Selection::new(&place, &scope)
    };
    let workload = Workload::of_all(&methods, selection, workload::settings(args)?)?;
    workload.check()?;
    let progress = Arc::new(Progress::new());
    let started = Instant::now();
    // Side by side: parts of a paper that follow one from another leave a core to the others.
    let shown = Arc::clone(&progress);
    let read = interrupt::unless_requested(move || {
        let keys = papers::keys().into_par_iter();
        keys.filter_map(|key| Some((key, paper(key, &shown)?)))
            .collect::<Vec<_>>()
    });
    progress.clear();
    let (mut good, stopped) = (true, read.is_none());
    let mut papers_read = Vec::new();
    for (key, report) in read.unwrap_or_default() {
        match report {
            Ok(report) => {
                good &= report.as_recorded();
                papers_read.push(report);
            }
            Err(e) => {
                good = false;
                complain(&format!("paper {key}: {e}"));
            }
        }
    }
    let mut panel = Panel::new(&progress);
    let reports = match stopped {
        true => Vec::new(),
        false => panel.judge_all(&workload, |_| Ok(()))?,
    };
    good &= all_pass(&reports);
    let stopped = stopped || is_stopped(&reports);
    let outcome = Outcome::unless_interrupted(stopped, good);
    let seconds = started.elapsed().as_secs_f64();
    let time = format!("{seconds:.1} s, {}", panel.rate(&reports));
    let width = width();
    write_to(|out| {
        let end = (end(outcome), time.as_str());
        let text = summary::everything(end, &papers_read, &reports, width);
        write!(out, "{text}")?;
        if verbose {
            for report in &papers_read {
                write!(out, "\n{}", text::paper::paper(report, width))?;
            }
            for report in &reports {
                write!(out, "\n{}", text::method::method(report, width))?;
            }
        }
        Ok(())
    })?;
    Ok(outcome)
}

fn is_stopped(reports: &[MethodReport]) -> bool {
    reports.iter().any(|r| r.interrupted)
}

fn end(outcome: Outcome) -> End {
    match outcome {
        Outcome::AsExpected => End::AsExpected,
        Outcome::Finding => End::NotAsExpected,
        Outcome::Interrupted => End::Interrupted,
    }
}

/// Audits a paper; `None` if there is none of that key.
pub fn paper(key: &str, progress: &Progress) -> Option<Result<PaperReport, Undecided>> {
    papers::audit(key, &|phase: &str, done, total| {
        progress.show(phase, done, total);
    })
}

/// Judges methods' own solvers, one method after the other.
struct Panel<'a> {
    progress: &'a Progress,
    /// The seconds spent judging.
    seconds: f64,
}

impl<'a> Panel<'a> {
    fn new(progress: &'a Progress) -> Panel<'a> {
        let seconds = 0.0;
        Panel { progress, seconds }
    }

    /// Judges all methods until the user asks to stop; `show` gets each report as soon as it is
    /// there.
    fn judge_all(
        &mut self,
        workload: &Workload,
        mut show: impl FnMut(&mut MethodReport) -> Result<(), Failure>,
    ) -> Result<Vec<MethodReport>, Failure> {
        let mut reports = Vec::new();
        for method in &workload.methods {
            let mut report = self.judge(method, &workload.settings);
            show(&mut report)?;
            reports.push(report);
            if is_stopped(&reports) {
                break;
            }
        }
        Ok(reports)
    }

    fn judge(&mut self, method: &dyn Method, settings: &Settings) -> MethodReport {
        let started = Instant::now();
        let total = work(method, settings);
        self.progress.restart();
        let tick = || self.progress.tick(method.name(), total);
        let report = audit_method_until(method, settings, &tick, interrupt::flag());
        self.progress.clear();
        self.seconds += started.elapsed().as_secs_f64();
        report
    }

    /// Formats the number of cases drawn, solved, judged and counted in a second.
    fn rate(&self, reports: &[MethodReport]) -> String {
        let cases = reports.iter().map(|r| r.cases).sum();
        rate_of(cases, self.seconds, rayon::current_num_threads())
    }
}

fn rate_of(cases: u64, seconds: f64, cores: usize) -> String {
    let each = cases as f64 / seconds.max(1e-9) / cores as f64;
    let each = match each {
        x if x >= 1e4 => format!("{:.0}e3", x / 1e3),
        x => format!("{x:.0}"),
    };
    format!("{each} cases a second on each of {}", count(cores, "core"))
}

/// Returns the number of cases and points of a map.
fn work(method: &dyn Method, settings: &Settings) -> u64 {
    let mapped = map_points(method).filter(|_| settings.maps).unwrap_or(0);
    (Cases::new(method, settings).len() + mapped) as u64
}

/// Returns the settings, with the additional parts of a page.
fn settings(args: &AuditArgs) -> Result<Settings, Failure> {
    let page = args.format == AuditFormat::Html;
    Ok(Settings {
        maps: args.maps || (page && args.program.exec.is_none()),
        points: if page { report::POINTS } else { 0 },
        ..workload::settings(&args.run)?
    })
}

/// Returns the part of the arguments that selects cases.
fn selection(args: &AuditArgs) -> Selection<'_> {
    Selection {
        input: args.at.as_ref().map(|Numbers(input)| input.as_slice()),
        laws: args.program.exec.is_none(),
        ..Selection::new(&args.place, &args.scope)
    }
}

/// Returns the program in place of the methods' solvers, if the arguments name one.
fn candidate(args: &AuditArgs) -> Option<Candidate> {
    let command = args.program.exec.as_deref()?;
    Some(workload::candidate(command, &args.program.program))
}

/// Audits methods as the arguments say.
pub fn methods(args: &AuditArgs) -> Result<Outcome, Failure> {
    let settings = settings(args)?;
    let lookup::Named {
        mut methods,
        refused,
    } = lookup::named(&args.method)?;
    for method in &mut methods {
        if let Some(name) = &args.solver {
            method.select_solver(name).map_err(Failure::new)?;
        }
        if args.program.exec.is_none() {
            lookup::has_solver(&**method)?;
        }
    }
    if args.program.exec.is_some() && methods.len() > 1 {
        return Err(Failure::new(
            "--exec audits a program as one method, and several are named",
        ));
    }
    for error in &refused {
        complain(&format!("refused: {error}"));
    }
    let outcome = judge_named(args, &methods, settings)?;
    Ok(match refused.is_empty() {
        true => outcome,
        false => outcome.or_finding(),
    })
}

/// Audits methods that are resolved.
fn judge_named(
    args: &AuditArgs,
    methods: &[Box<dyn Evaluable>],
    settings: Settings,
) -> Result<Outcome, Failure> {
    let output = Output::open(args.output.as_deref())?;
    let mut extras = ReportExtras {
        baseline: report::baseline(args.baseline.as_deref(), args.format)?,
        ..ReportExtras::default()
    };
    let workload = match methods {
        [method] if !args.method.is_empty() => {
            Workload::of_one(&**method, selection(args), settings)?
        }
        all => Workload::of_all(all, selection(args), settings)?,
    };
    workload.check()?;
    let candidate = candidate(args);
    let mut tail = reproduce_command(candidate.as_ref(), selection(args));
    if let Some(name) = &args.solver {
        tail += &format!(" --solver {}", shell_words::quote(name));
    }
    if let [method] = workload.methods.as_slice()
        && let Some(mut report) = judged_alone(method, &workload, candidate.as_ref())?
    {
        report.reproduce.tail = tail;
        return report::write(&[report], args.format, output, &extras);
    }
    let as_it_goes = args.format == AuditFormat::Text && output.is_standard();
    let progress = Progress::new();
    let mut panel = Panel::new(&progress);
    let mut reports = panel.judge_all(&workload, |report| {
        report.reproduce.tail.clone_from(&tail);
        match as_it_goes {
            true => print(&format!("{}\n", text::method::method(report, width()))),
            false => Ok(()),
        }
    })?;
    if as_it_goes {
        let outcome = Outcome::unless_interrupted(is_stopped(&reports), all_pass(&reports));
        let how = [settings_line(&workload.settings), panel.rate(&reports)];
        let mut text = summary::verdict(end(outcome), &totals(&reports), &how, width());
        if let Some(before) = &extras.baseline {
            let changes = before.changes(&reports);
            text += &text::comparison::changes(&changes, width());
        }
        output.text(&text)?;
        return Ok(outcome);
    }
    if args.format == AuditFormat::Html && args.method.is_empty() && !is_stopped(&reports) {
        extras.approximations = approximations();
        mark_incomplete(&extras, &mut reports);
    }
    report::write(&reports, args.format, output, &extras)
}

/// Judges a candidate, or the solver at a single case.
fn judged_alone(
    method: &dyn Method,
    workload: &Workload,
    candidate: Option<&Candidate>,
) -> Result<Option<MethodReport>, Failure> {
    let (one, settings) = (workload.one.clone(), &workload.settings);
    match (candidate, one) {
        (Some(candidate), one) => candidate::audit(method, one, candidate, settings).map(Some),
        (None, Some(case)) => Ok(Some(audit_one(method, case, None, settings))),
        (None, None) => Ok(None),
    }
}

/// Marks a page as interrupted if its approximations are missing.
fn mark_incomplete(extras: &ReportExtras, reports: &mut [MethodReport]) {
    if let (None, Some(last)) = (&extras.approximations, reports.last_mut()) {
        last.interrupted = true;
    }
}

/// Returns the convergence of all approximations, unless the user asks to stop.
fn approximations() -> Option<Vec<Result<ConvergenceReport, Uncertified>>> {
    interrupt::unless_requested(|| {
        let all = methods::approximations();
        all.par_iter().map(|a| convergence(&**a)).collect()
    })
}

#[cfg(test)]
mod tests;
