//! Running audits: everything, a method, a region or one case.

pub mod written;

use self::written::Besides;
use crate::cli::args::{AuditArgs, AuditFormat, Numbers, RunArgs};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, print, write_to};
use crate::cli::lookup::{self, settings};
use crate::cli::progress::Progress;
use crate::cli::terminal::width;
use crate::cli::{complain, forecast, process::exec, process::interrupt, scope};
use mechaudit::audit::{
    Case, Cases, ConvergenceReport, Layout, Method, MethodReport, Settings, Uncertified, Variant,
    answer_of, audit_method_until, audit_one, convergence, map_points,
};
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
    let settings = settings(args)?;
    foresee(&methods::registry(), &settings)?;
    let progress = Arc::new(Progress::new());
    let started = Instant::now();
    let (mut good, mut stopped) = (true, false);
    let (mut papers_read, mut reports) = (Vec::new(), Vec::new());
    // Side by side: parts of a paper that follow one from another leave a core to the others.
    let shown = Arc::clone(&progress);
    let read = interrupt::unless_asked(move || {
        let keys = papers::keys().into_par_iter();
        keys.filter_map(|key| Some((key, paper(key, &shown)?)))
            .collect::<Vec<_>>()
    });
    progress.clear();
    stopped |= read.is_none();
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
    let mut judging = 0.0;
    for method in methods::registry() {
        if stopped {
            break;
        }
        let report = run(method.as_ref(), &settings, &progress, &mut judging);
        stopped = report.interrupted;
        reports.push(report);
    }
    good &= all_pass(&reports);
    let outcome = Outcome::unless_interrupted(stopped, good);
    let seconds = started.elapsed().as_secs_f64();
    let time = format!("{seconds:.1} s, {}", rate(&reports, judging));
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

fn end(outcome: Outcome) -> End {
    match outcome {
        Outcome::AsExpected => End::AsExpected,
        Outcome::Finding => End::NotAsExpected,
        Outcome::Interrupted => End::Interrupted,
    }
}

/// Cases drawn, solved, judged and counted in a second.
fn rate(reports: &[MethodReport], seconds: f64) -> String {
    let cases = reports.iter().map(|r| r.cases).sum();
    rate_of(cases, seconds, rayon::current_num_threads())
}

fn rate_of(cases: u64, seconds: f64, cores: usize) -> String {
    let each = cases as f64 / seconds.max(1e-9) / cores as f64;
    let each = match each {
        x if x >= 1e4 => format!("{:.0}e3", x / 1e3),
        x => format!("{x:.0}"),
    };
    format!("{each} cases a second on each of {}", count(cores, "core"))
}

/// Audits a paper; `None` if there is none of that key.
pub fn paper(key: &str, progress: &Progress) -> Option<Result<PaperReport, Undecided>> {
    let audit = papers::find(key)?;
    Some(audit(&|phase: &str, done, total| {
        progress.show(phase, done, total);
    }))
}

/// The report; the seconds that it took are added to those spent judging.
fn run(
    method: &dyn Method,
    settings: &Settings,
    progress: &Progress,
    judging: &mut f64,
) -> MethodReport {
    let started = Instant::now();
    let total = work(method, settings);
    progress.restart();
    let tick = || progress.tick(method.name(), total);
    let report = audit_method_until(method, settings, &tick, interrupt::flag());
    progress.clear();
    *judging += started.elapsed().as_secs_f64();
    report
}

/// Cases, and points of a map.
fn work(method: &dyn Method, settings: &Settings) -> u64 {
    let mapped = map_points(method).filter(|_| settings.maps).unwrap_or(0);
    (Cases::new(method, settings).len() + mapped) as u64
}

/// The method as the arguments ask for it.
fn scoped<'a>(
    method: &'a dyn Method,
    args: &AuditArgs,
    settings: &Settings,
) -> Result<Variant<'a>, Failure> {
    let variant = scope::judged(method, &args.scope)?;
    let variant = match args.program.exec {
        Some(_) => variant.without_laws(),
        None => variant,
    };
    scope::placed(variant, &args.place, settings, args.method.is_some())
}

/// Says what very many cases will take, and refuses what cannot end.
fn foresee(methods: &[Box<dyn methods::Evaluable>], settings: &Settings) -> Result<(), Failure> {
    let methods: Vec<&dyn Method> = methods.iter().map(|m| &**m as _).collect();
    forecast::audit(&methods, settings)
}

/// The settings, with what a page shows besides.
fn asked(args: &AuditArgs) -> Result<Settings, Failure> {
    let page = args.format == AuditFormat::Html;
    Ok(Settings {
        maps: args.maps || (page && args.program.exec.is_none()),
        points: if page { written::POINTS } else { 0 },
        ..settings(&args.run)?
    })
}

/// Audits methods as the arguments ask for.
pub fn methods(args: &AuditArgs) -> Result<Outcome, Failure> {
    let settings = asked(args)?;
    let chosen = match &args.method {
        None => methods::registry(),
        Some(name) => vec![lookup::method(name)?],
    };
    let output = Output::open(args.output.as_deref())?;
    let mut besides = Besides {
        baseline: written::baseline(args.baseline.as_deref(), args.format)?,
        ..Besides::default()
    };
    foresee(&chosen, &settings)?;
    // All of them before the first is judged: what cannot be read is refused.
    let chosen: Result<Vec<Variant>, Failure> = (chosen.iter())
        .map(|m| scoped(m.as_ref(), args, &settings))
        .collect();
    let chosen = chosen?;
    let one = match (&args.method, chosen.as_slice()) {
        (Some(_), [method]) => one_case(method, args, &settings)?,
        _ => None,
    };
    let tail = tail(args);
    let finish = |mut report: MethodReport| {
        report.reproduce.tail.clone_from(&tail);
        report
    };
    if let (Some(case), [method], None) = (&one, chosen.as_slice(), &args.program.exec) {
        let report = finish(audit_one(method, case.clone(), None, &settings));
        return written::write(&[report], args.format, output, &besides);
    }
    let chosen: Result<Vec<Variant>, Failure> = chosen
        .into_iter()
        .map(|method| match one {
            None => scope::regions(method, &args.place),
            Some(_) => Ok(method),
        })
        .collect();
    let chosen = chosen?;
    if let (Some(method), Some(command)) = (chosen.first(), &args.program.exec) {
        let report = exec::audit(method, one, command, &args.program.program, &settings)?;
        return written::write(&[finish(report)], args.format, output, &besides);
    }
    let progress = Progress::new();
    let (mut reports, mut judging, mut stopped) = (Vec::new(), 0.0, false);
    for method in &chosen {
        let report = finish(run(method, &settings, &progress, &mut judging));
        if args.format == AuditFormat::Text && output.is_standard() {
            print(&format!("{}\n", text::method::method(&report, width())))?;
        }
        stopped = report.interrupted;
        reports.push(report);
        if stopped {
            break;
        }
    }
    if args.format == AuditFormat::Text && output.is_standard() {
        let outcome = Outcome::unless_interrupted(stopped, all_pass(&reports));
        let how = [settings_line(&settings), rate(&reports, judging)];
        let mut text = summary::verdict(end(outcome), &totals(&reports), &how, width());
        if let Some(before) = &besides.baseline {
            let changes = before.changes(&reports);
            text += &text::comparison::changes(&changes, width());
        }
        output.text(&text)?;
        return Ok(outcome);
    }
    if args.format == AuditFormat::Html && args.method.is_none() && !stopped {
        besides.approximations = approximations();
        stopped_before(&besides, &mut reports);
    }
    written::write(&reports, args.format, output, &besides)
}

/// A page without the approximations is not all of it.
fn stopped_before(besides: &Besides, reports: &mut [MethodReport]) {
    if let (None, Some(last)) = (&besides.approximations, reports.last_mut()) {
        last.interrupted = true;
    }
}

/// The options that a command needs besides to judge a case of this audit again.
fn tail(args: &AuditArgs) -> String {
    let command = args.program.exec.as_deref();
    let program = command.map(|c| (c, &args.program.program));
    scope::again(program, &args.scope, &args.place)
}

/// The convergence of all approximations, unless the user asks to stop.
fn approximations() -> Option<Vec<Result<ConvergenceReport, Uncertified>>> {
    interrupt::unless_asked(|| {
        let all = methods::approximations();
        all.par_iter().map(|a| convergence(&**a)).collect()
    })
}

/// The one case that the arguments ask for, if they do.
fn one_case(
    method: &dyn Method,
    args: &AuditArgs,
    settings: &Settings,
) -> Result<Option<Case>, Failure> {
    match &args.at {
        Some(Numbers(input)) => given(method, input).map(Some),
        None => scope::one_case(method, &args.place, settings),
    }
}

/// An input given by itself.
fn given(method: &dyn Method, input: &[f64]) -> Result<Case, Failure> {
    let refusal = answer_of(method, input);
    if let Some("layout" | "bad layout") = refusal.refusal() {
        let layout = Layout::new(method).input();
        let (n, name) = (count(input.len(), "number"), method.name());
        return Err(Failure::new(format!(
            "--at: {n} cannot be an input of {name}, which is: {layout}"
        )));
    }
    let held = input.iter().map(|x| method.format().representable(*x));
    Ok(scope::given(method.name(), held.collect()))
}

#[cfg(test)]
mod tests;
