//! Running audits: everything, a method, a region or one case.

use crate::cli::args::{AuditArgs, AuditFormat, Numbers, RunArgs};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, write_json, write_to};
use crate::cli::progress::Progress;
use crate::cli::terminal::width;
use crate::cli::{
    commands::hunt::hard_folder, complain, forecast, process::candidate, process::exec,
    process::interrupt,
};
use mechaudit::audit::{
    Case, CaseReport, Cases, ConvergenceReport, Law, Layout, Method, MethodReport, NoSuch, Origin,
    Settings, Uncertified, Variant, Verdict, answer_of, audit_case, audit_method_until,
    convergence, map_points,
};
use mechaudit::papers::PaperReport;
use mechaudit::reference::Decimal;
use mechaudit::reference::Undecided;
use mechaudit::report::text::style::{BAD, BOLD, paint};
use mechaudit::report::text::summary::{self, End};
use mechaudit::report::words::audit::{all_pass, settings as settings_line, totals};
use mechaudit::report::words::numbers::{count, percent};
use mechaudit::report::{html, json as in_json, junit, text};
use mechaudit::{methods, papers};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::Instant;

/// The settings that arguments and environment ask for.
pub fn settings(args: &RunArgs) -> Result<Settings, Failure> {
    let default = Settings::default();
    let cases = args.cases.unwrap_or(default.cases_per_region);
    let effort = effort(std::env::var_os("MECHAUDIT_EFFORT").as_deref())?;
    // Saturates; at least one case unless none were asked for.
    let scaled = (cases as f64 * effort).ceil() as u64;
    Ok(Settings {
        seed: args.seed.unwrap_or(default.seed),
        cases_per_region: if effort == 1.0 { cases } else { scaled },
        ..default
    })
}

fn effort(value: Option<&std::ffi::OsStr>) -> Result<f64, Failure> {
    let Some(value) = value else { return Ok(1.0) };
    let text = value.to_string_lossy();
    match Decimal::nearest(&text) {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err(Failure::new(format!(
            "MECHAUDIT_EFFORT = {text:?} must be a positive number, for instance 0.1 or 10"
        ))),
    }
}

/// Audits every paper and every method: the verdict first, then what is new, then a line for each
/// method and finding. With `verbose` all of it in full, below.
pub fn everything(args: &RunArgs, verbose: bool) -> Result<Outcome, Failure> {
    let settings = settings(args)?;
    foresee(&methods::registry(), &settings)?;
    let progress = Arc::new(Progress::new());
    let started = Instant::now();
    let (mut good, mut stopped) = (true, false);
    let (mut papers_read, mut reports) = (Vec::new(), Vec::new());
    for key in papers::keys() {
        let shown = Arc::clone(&progress);
        let report = interrupt::unless_asked(move || paper(key, &shown));
        progress.clear();
        match report {
            None => {
                stopped = true;
                break;
            }
            Some(Some(Ok(report))) => {
                good &= report.as_recorded();
                papers_read.push(report);
            }
            Some(Some(Err(e))) => {
                good = false;
                complain(&format!("paper {key}: {e}"));
            }
            Some(None) => {}
        }
    }
    let mut judging = 0.0;
    for method in methods::registry() {
        if stopped {
            break;
        }
        let (report, seconds) = run(method.as_ref(), &settings, &progress);
        judging += seconds;
        stopped = report.interrupted;
        reports.push(report);
    }
    good &= all_pass(&reports);
    let outcome = Outcome::unless_interrupted(stopped, good);
    let seconds = started.elapsed().as_secs_f64();
    let time = format!("{seconds:.1} s, {}", rate(&reports, judging));
    let width = width();
    write_to(None, |out| {
        let end = (end(outcome), time.as_str());
        let text = summary::everything(end, &papers_read, &reports, width);
        write!(out, "{text}")?;
        if verbose {
            for report in &papers_read {
                write!(out, "\n{}", text::paper::paper(report, width))?;
            }
            for report in &reports {
                let text = text::method::method(report, &Case::reproduce, width);
                write!(out, "\n{text}")?;
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
    let cases: usize = reports.iter().map(|r| r.cases).sum();
    let cores = rayon::current_num_threads();
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

/// The report, and the seconds that it took.
fn run(method: &dyn Method, settings: &Settings, progress: &Progress) -> (MethodReport, f64) {
    let started = Instant::now();
    let mapped = map_points(method).filter(|_| settings.maps).unwrap_or(0);
    let total = (Cases::new(method, settings).len() + mapped) as u64;
    progress.restart();
    let tick = || progress.tick(method.name(), total);
    let report = audit_method_until(method, settings, &tick, interrupt::flag());
    progress.clear();
    (report, started.elapsed().as_secs_f64())
}

/// The method as the arguments ask for it, over its whole domain.
fn scoped<'a>(method: &'a dyn Method, args: &AuditArgs) -> Result<Variant<'a>, Failure> {
    let variant = candidate::scoped(method, &args.scope)?;
    let variant = match args.program.exec {
        Some(_) => variant.without_laws(),
        None => variant,
    };
    Ok(match (&args.hard, &args.method) {
        (None, _) => variant,
        (Some(folder), Some(_)) => variant.hard_cases(hard_folder::of_method(folder, method)?),
        (Some(folder), None) => {
            variant.hard_cases(hard_folder::read(folder, method)?.unwrap_or_default())
        }
    })
}

/// Says what very many cases will take, and refuses what cannot end.
fn foresee(methods: &[Box<dyn Method>], settings: &Settings) -> Result<(), Failure> {
    let methods: Vec<&dyn Method> = methods.iter().map(|m| &**m).collect();
    forecast::audit(&methods, settings)
}

/// Audits methods as the arguments ask for.
pub fn methods(args: &AuditArgs) -> Result<Outcome, Failure> {
    let settings = Settings {
        maps: args.maps || args.format == AuditFormat::Html,
        ..settings(&args.run)?
    };
    let chosen = match &args.method {
        None => methods::registry(),
        Some(name) => vec![find(name)?],
    };
    let output = Output::open(args.output.as_deref())?;
    foresee(&chosen, &settings)?;
    // All of them before the first is judged: what cannot be read is refused.
    let chosen: Result<Vec<Variant>, Failure> =
        chosen.iter().map(|m| scoped(m.as_ref(), args)).collect();
    let chosen = chosen?;
    if let (Some(_), [method]) = (&args.method, chosen.as_slice())
        && let Some(case) = one_case(method, args, &settings)?
    {
        return match &args.program.exec {
            Some(command) => exec::audit(method, Some(case), args, command, &settings, output),
            None => single(method, case, &settings, args, output),
        };
    }
    let chosen: Result<Vec<Variant>, NoSuch> = chosen
        .into_iter()
        .map(|method| match &args.region {
            Some(region) => method.region(region),
            None => Ok(method),
        })
        .collect();
    let chosen = chosen?;
    if let (Some(method), Some(command)) = (chosen.first(), &args.program.exec) {
        return exec::audit(method, None, args, command, &settings, output);
    }
    let progress = Progress::new();
    let (mut reports, mut judging, mut stopped) = (Vec::new(), 0.0, false);
    for method in &chosen {
        let (report, seconds) = run(method, &settings, &progress);
        judging += seconds;
        if args.format == AuditFormat::Text && output.is_standard() {
            let text = text::method::method(&report, &Case::reproduce, width());
            write_to(None, |out| Ok(writeln!(out, "{text}")?))?;
        }
        stopped = report.interrupted;
        reports.push(report);
        if stopped {
            break;
        }
    }
    let good = all_pass(&reports);
    let mut outcome = Outcome::unless_interrupted(stopped, good);
    match args.format {
        AuditFormat::Text if output.is_standard() => {
            let how = [settings_line(&settings), rate(&reports, judging)];
            let text = summary::verdict(end(outcome), &totals(&reports), &how, width());
            output.text(&text)?;
        }
        AuditFormat::Text => output.write(|out| {
            for report in &reports {
                let text = text::method::method(report, &Case::reproduce, width());
                writeln!(out, "{text}")?;
            }
            let mark = if stopped { "Interrupted: " } else { "" };
            Ok(writeln!(out, "{mark}{}.", totals(&reports))?)
        })?,
        AuditFormat::Json => {
            let methods = reports.iter();
            let methods = methods.map(|r| in_json::method(r, &Case::reproduce));
            let value = json!({
                "schema_version": 1,
                "mechaudit_version": env!("CARGO_PKG_VERSION"),
                "passed": good,
                "interrupted": stopped,
                "methods": methods.collect::<Vec<Value>>(),
            });
            write_json(output, &value)?;
        }
        AuditFormat::Junit => {
            let text = junit::document(&reports).map_err(Failure::caused)?;
            output.write(|out| Ok(writeln!(out, "{text}")?))?;
        }
        AuditFormat::Html => {
            let all = args.method.is_none() && !stopped;
            let approximations = all.then(approximations).flatten();
            stopped |= all && approximations.is_none();
            outcome = Outcome::unless_interrupted(stopped, good);
            let page = html::audit::page(&reports, approximations.as_deref(), stopped);
            output.text(&page)?;
        }
    }
    Ok(outcome)
}

/// The convergence of all approximations, unless the user asks to stop.
fn approximations() -> Option<Vec<Result<ConvergenceReport, Uncertified>>> {
    interrupt::unless_asked(|| {
        let all = methods::approximations();
        all.par_iter().map(|a| convergence(&**a)).collect()
    })
}

/// The method of that name.
pub fn find(name: &str) -> Result<Box<dyn Method>, Failure> {
    methods::find(name).ok_or_else(|| {
        let known: Vec<&str> = methods::registry().iter().map(|m| m.name()).collect();
        Failure::no_such("method", name, &known)
    })
}

/// The one case that the arguments ask for, if they do.
fn one_case(
    method: &dyn Method,
    args: &AuditArgs,
    settings: &Settings,
) -> Result<Option<Case>, Failure> {
    let cases = Cases::new(method, settings);
    if let Some(Numbers(input)) = &args.at {
        return given(method, input).map(Some);
    }
    if let Some(number) = args.hard_case {
        return Ok(Some(cases.hard_case(number)?));
    }
    Ok(match (&args.check_point, &args.region, args.case) {
        (Some(name), ..) => Some(cases.at_check_point(name)?),
        (None, Some(region), Some(index)) => Some(cases.in_region(region, index)?),
        _ => None,
    })
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
    Ok(Case {
        method: method.name(),
        region: "given",
        input: input.to_vec(),
        origin: Origin::Given,
    })
}

fn single(
    method: &dyn Method,
    case: Case,
    settings: &Settings,
    args: &AuditArgs,
    output: Output,
) -> Result<Outcome, Failure> {
    let report: CaseReport = audit_case(method, case, settings);
    let laws: Vec<(Law, Option<f64>)> = method
        .laws()
        .into_iter()
        .map(|l| (l, (l.residual)(&report.case.input)))
        .collect();
    let held = |x: &Option<f64>| x.is_none_or(|x| x <= 1.0);
    let good = report.judgement.verdict == Verdict::Pass && laws.iter().all(|(_, x)| held(x));
    match args.format {
        AuditFormat::Text => output.write(|out| {
            write!(
                out,
                "{}",
                text::case::text(&report, &report.case.reproduce(), width())
            )?;
            for (law, residual) in &laws {
                if let Some(x) = residual {
                    let style = if *x <= 1.0 { BOLD } else { BAD };
                    let share = percent(*x);
                    let name = paint(style, law.name);
                    writeln!(out, "    law        {name}: {share} of what is allowed")?;
                }
            }
            Ok(())
        })?,
        AuditFormat::Json => {
            let mut value = in_json::case(&report, &report.case.reproduce());
            let laws = laws
                .iter()
                .map(|(l, x)| json!({ "name": l.name, "residual": x }));
            value["laws"] = laws.collect();
            value["passed"] = json!(good);
            write_json(output, &value)?;
        }
        AuditFormat::Junit | AuditFormat::Html => {
            return Err(Failure::new("one case is reported as text or json"));
        }
    }
    Ok(Outcome::of(good))
}

#[cfg(test)]
mod tests {
    use super::effort;

    #[test]
    fn effort_is_a_positive_number() {
        assert_eq!(effort(None).unwrap(), 1.0);
        assert_eq!(effort(Some("2.5".as_ref())).unwrap(), 2.5);
        for bad in ["", "0", "-1", "nan", "inf", "ten"] {
            assert!(effort(Some(bad.as_ref())).is_err(), "{bad}");
        }
    }
}
