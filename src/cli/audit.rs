//! Running audits: everything, a method, a region or one case.

use super::args::{AuditArgs, AuditFormat, Numbers, RunArgs};
use super::case;
use super::failure::{Failure, Outcome};
use super::output::{Output, write_to};
use super::progress::Progress;
use super::text::{BAD, BOLD, DIM, GOOD, paint, width};
use super::{
    audit_html, audit_junit, candidate, complain, exec, forecast, hard_folder, interrupt,
    text_method, text_paper, text_summary,
};
use mechaudit::audit::{
    Case, CaseReport, Cases, Law, Layout, Method, MethodReport, NoSuch, Origin, Settings, Variant,
    Verdict, answer_of, audit_case, audit_method_until,
};
use mechaudit::papers::PaperReport;
use mechaudit::reference::Undecided;
use mechaudit::{methods, papers};
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
    match text.trim().parse::<f64>() {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err(Failure::new(format!(
            "MECHAUDIT_EFFORT = {text:?} must be a positive number, for instance 0.1 or 10"
        ))),
    }
}

/// A number of things in words.
fn number(n: usize, thing: &str) -> String {
    format!("{n} {thing}{}", if n == 1 { "" } else { "s" })
}

fn settings_line(s: &Settings) -> String {
    format!(
        "seed {}, {} random cases per region, references from {} to {} bits",
        s.seed, s.cases_per_region, s.first_bits, s.last_bits
    )
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
    let mut totals = Totals::default();
    for method in methods::registry() {
        if stopped {
            break;
        }
        let (report, seconds) = run(method.as_ref(), &settings, &progress);
        totals.add((&report, seconds));
        stopped = report.interrupted;
        reports.push(report);
    }
    good &= totals.good();
    let outcome = Outcome::unless_interrupted(stopped, good);
    let rate = rate(totals.cases, totals.seconds);
    let seconds = started.elapsed().as_secs_f64();
    let how = format!("{}\n{seconds:.1} s, {rate}", settings_line(&settings));
    let found = papers_read.iter().map(|p| p.findings.len()).sum();
    let summary = format!(
        "{} with {}; {}",
        number(papers_read.len(), "paper"),
        number(found, "finding"),
        totals.words()
    );
    let width = width();
    write_to(None, |out| {
        verdict(out, &summary, outcome, &how)?;
        let news = text_summary::news(&papers_read, &reports, width);
        if !news.is_empty() {
            writeln!(out, "\n{}\n{news}", paint(BAD, "New or over budget"))?;
        }
        writeln!(out, "\n{}", text_summary::methods(&reports))?;
        for report in &papers_read {
            writeln!(out, "{}", text_summary::paper(report, width))?;
        }
        if !verbose {
            let more = "In full: mechaudit --verbose, paper NAME, audit METHOD.";
            writeln!(out, "{}", paint(DIM, more))?;
            return Ok(());
        }
        for report in &papers_read {
            writeln!(out, "{}", text_paper::paper(report, width))?;
        }
        for report in &reports {
            let text = text_method::method(report, &Case::reproduce, width);
            writeln!(out, "{text}")?;
        }
        Ok(())
    })?;
    Ok(outcome)
}

/// What came of it, and how it was done.
fn verdict(
    out: &mut dyn std::io::Write,
    summary: &str,
    outcome: Outcome,
    how: &str,
) -> Result<(), Failure> {
    let (word, style) = match outcome {
        Outcome::AsExpected => ("All as expected", GOOD),
        Outcome::Finding => ("NOT as expected", BAD),
        Outcome::Interrupted => ("Interrupted", BAD),
    };
    writeln!(out, "{}: {summary}.", paint(style, word))?;
    for line in how.lines() {
        writeln!(out, "{}", paint(DIM, line))?;
    }
    Ok(())
}

/// Cases drawn, solved, judged and counted in a second.
fn rate(cases: usize, seconds: f64) -> String {
    let cores = rayon::current_num_threads();
    let each = cases as f64 / seconds.max(1e-9) / cores as f64;
    let each = match each {
        x if x >= 1e4 => format!("{:.0}e3", x / 1e3),
        x => format!("{x:.0}"),
    };
    format!("{each} cases a second on each of {}", number(cores, "core"))
}

/// Audits a paper; `None` if there is none of that key.
pub fn paper(key: &str, progress: &Progress) -> Option<Result<PaperReport, Undecided>> {
    let audit = papers::find(key)?;
    Some(audit(&|phase: &str, done, total| {
        progress.show(phase, done, total);
    }))
}

#[derive(Default)]
struct Totals {
    methods: usize,
    passed_methods: usize,
    cases: usize,
    passed_cases: usize,
    recorded: usize,
    seconds: f64,
}

impl Totals {
    fn add(&mut self, (report, seconds): (&MethodReport, f64)) {
        self.seconds += seconds;
        self.methods += 1;
        self.passed_methods += usize::from(report.passed());
        self.cases += report.cases;
        self.passed_cases += report.passed;
        self.recorded += report.recorded;
    }

    /// An audit of nothing is not a good one.
    fn good(&self) -> bool {
        self.methods > 0 && self.methods == self.passed_methods
    }

    fn words(&self) -> String {
        let recorded = match self.recorded {
            0 => String::new(),
            n => format!(", {n} over budget as recorded"),
        };
        format!(
            "{} of {} methods pass, {} of {} cases{recorded}",
            self.passed_methods, self.methods, self.passed_cases, self.cases
        )
    }
}

/// The report, and the seconds that it took.
fn run(method: &dyn Method, settings: &Settings, progress: &Progress) -> (MethodReport, f64) {
    let started = Instant::now();
    let total = Cases::new(method, settings).len() as u64;
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
    let settings = settings(&args.run)?;
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
    let mut totals = Totals::default();
    let mut reports = Vec::new();
    let mut stopped = false;
    for method in &chosen {
        let (report, seconds) = run(method, &settings, &progress);
        totals.add((&report, seconds));
        if args.format == AuditFormat::Text && output.is_standard() {
            let text = text_method::method(&report, &Case::reproduce, width());
            write_to(None, |out| Ok(writeln!(out, "{text}")?))?;
        }
        stopped = report.interrupted;
        reports.push(report);
        if stopped {
            break;
        }
    }
    let outcome = Outcome::unless_interrupted(stopped, totals.good());
    match args.format {
        AuditFormat::Text if output.is_standard() => {
            let rate = rate(totals.cases, totals.seconds);
            let how = format!("{}\n{rate}", settings_line(&settings));
            output.write(|out| verdict(out, &totals.words(), outcome, &how))?;
        }
        AuditFormat::Text => output.write(|out| {
            for report in &reports {
                let text = text_method::method(report, &Case::reproduce, width());
                writeln!(out, "{text}")?;
            }
            let mark = if stopped { "Interrupted: " } else { "" };
            Ok(writeln!(out, "{mark}{}.", totals.words())?)
        })?,
        AuditFormat::Json => {
            let reports: Vec<Value> = reports
                .iter()
                .map(|r| json_report(r, &Case::reproduce))
                .collect();
            let value = json!({
                "schema_version": 1,
                "mechaudit_version": env!("CARGO_PKG_VERSION"),
                "passed": totals.good(),
                "interrupted": stopped,
                "methods": reports,
            });
            write_json(output, &value)?;
        }
        AuditFormat::Junit => {
            let text = audit_junit::document(&reports).map_err(Failure::new)?;
            output.write(|out| Ok(writeln!(out, "{text}")?))?;
        }
        AuditFormat::Html => {
            let page = audit_html::page(&reports, &settings, args.method.is_none());
            output.text(&page)?;
        }
    }
    Ok(outcome)
}

/// JSON to standard output or a file.
pub fn write_json(output: Output, value: &Value) -> Result<(), Failure> {
    output.write(|out| {
        serde_json::to_writer_pretty(&mut *out, value)?;
        Ok(writeln!(out)?)
    })
}

pub fn print_json(value: &Value) -> Result<(), Failure> {
    write_json(Output::open(None)?, value)
}

/// The report for programs. `again` gives the command that judges a case again.
pub fn json_report(report: &MethodReport, again: &dyn Fn(&Case) -> String) -> Value {
    let mut value = serde_json::to_value(report).unwrap_or(Value::Null);
    let failures = report.failures.iter();
    let failures: Vec<Value> = failures.map(|f| case::json(f, &again(&f.case))).collect();
    value["passed_all"] = json!(report.passed());
    value["failures"] = json!(failures);
    value
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
        let (n, name) = (number(input.len(), "number"), method.name());
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
                case::text(&report, &report.case.reproduce(), width())
            )?;
            for (law, residual) in &laws {
                if let Some(x) = residual {
                    let style = if *x <= 1.0 { BOLD } else { BAD };
                    let share = super::text::percent(*x);
                    let name = paint(style, law.name);
                    writeln!(out, "    law        {name}: {share} of what is allowed")?;
                }
            }
            Ok(())
        })?,
        AuditFormat::Json => {
            let mut value = case::json(&report, &report.case.reproduce());
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
    use super::{Outcome, Totals, effort};

    #[test]
    fn one_failing_method_or_none_at_all_is_a_finding() {
        let totals = |methods, passed_methods| Totals {
            methods,
            passed_methods,
            ..Totals::default()
        };
        assert_eq!(Outcome::of(totals(2, 2).good()), Outcome::AsExpected);
        assert_eq!(Outcome::of(totals(2, 1).good()), Outcome::Finding);
        assert_eq!(Outcome::of(totals(0, 0).good()), Outcome::Finding);
    }

    #[test]
    fn effort_is_a_positive_number() {
        assert_eq!(effort(None).unwrap(), 1.0);
        assert_eq!(effort(Some("2.5".as_ref())).unwrap(), 2.5);
        for bad in ["", "0", "-1", "nan", "inf", "ten"] {
            assert!(effort(Some(bad.as_ref())).is_err(), "{bad}");
        }
    }
}
