//! Running audits: everything, a method, a region or one case.

use super::args::{AuditArgs, RunArgs, TextOrJson};
use super::case;
use super::failure::{Failure, Outcome};
use super::output::write_to;
use super::progress::Progress;
use super::text::{BAD, BOLD, DIM, GOOD, paint, width};
use super::{complain, text_method, text_paper};
use mechaudit::audit::{
    Case, CaseReport, Domain, Draw, Input, Law, Method, MethodReport, NormBudget, Origin, Output,
    ReferenceAnswer, Settings, SolverAnswer, Verdict, audit_case, audit_method,
};
use mechaudit::papers::PaperReport;
use mechaudit::reference::Undecided;
use mechaudit::{methods, papers};
use rug::Rational;
use serde_json::{Value, json};

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

/// Audits every paper and every method.
pub fn everything(args: &RunArgs) -> Result<Outcome, Failure> {
    let settings = settings(args)?;
    let width = width();
    let progress = Progress::new();
    let mut good = true;
    let mut found = 0;
    let keys = papers::keys();
    for key in &keys {
        let report = paper(key, &progress);
        progress.clear();
        match report {
            Some(Ok(report)) => {
                good &= report.as_recorded();
                found += report.findings.len();
                let text = text_paper::paper(&report, width);
                write_to(None, |out| Ok(writeln!(out, "{text}")?))?;
            }
            Some(Err(e)) => {
                good = false;
                complain(&format!("paper {key}: {e}"));
            }
            None => {}
        }
    }
    let mut totals = Totals::default();
    for method in methods::registry() {
        let report = run(method.as_ref(), &settings, &progress);
        totals.add(&report);
        progress.clear();
        let text = text_method::method(&report, width);
        write_to(None, |out| Ok(writeln!(out, "{text}")?))?;
    }
    good &= totals.good();
    let summary = format!(
        "{} with {}; {}",
        number(keys.len(), "paper"),
        number(found, "finding"),
        totals.words()
    );
    close(&summary, good, &settings)?;
    Ok(Outcome::of(good))
}

fn close(summary: &str, good: bool, settings: &Settings) -> Result<(), Failure> {
    let (word, style) = match good {
        true => ("All as expected", GOOD),
        false => ("NOT as expected", BAD),
    };
    write_to(None, |out| {
        writeln!(out, "{}: {summary}.", paint(style, word))?;
        Ok(writeln!(out, "{}", paint(DIM, &settings_line(settings)))?)
    })
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
}

impl Totals {
    fn add(&mut self, report: &MethodReport) {
        self.methods += 1;
        self.passed_methods += usize::from(report.passed());
        self.cases += report.cases;
        self.passed_cases += report.passed;
    }

    /// An audit of nothing is not a good one.
    fn good(&self) -> bool {
        self.methods > 0 && self.methods == self.passed_methods
    }

    fn words(&self) -> String {
        format!(
            "{} of {} methods pass, {} of {} cases",
            self.passed_methods, self.methods, self.passed_cases, self.cases
        )
    }
}

fn run(method: &dyn Method, settings: &Settings, progress: &Progress) -> MethodReport {
    let domain = method.domain();
    let random = domain.regions.len() as u64 * settings.cases_per_region;
    let total = random + domain.check_points.len() as u64;
    progress.restart();
    let report = audit_method(method, settings, &|| progress.tick(method.name(), total));
    progress.clear();
    report
}

/// Audits methods as the arguments ask for.
pub fn methods(args: &AuditArgs) -> Result<Outcome, Failure> {
    let settings = settings(&args.run)?;
    let chosen = match &args.method {
        None => methods::registry(),
        Some(name) => vec![find(name)?],
    };
    if let (Some(_), Some(method)) = (&args.method, chosen.first())
        && let Some(case) = one_case(method.as_ref(), args, &settings)?
    {
        return single(method.as_ref(), case, &settings, args.format);
    }
    let progress = Progress::new();
    let mut totals = Totals::default();
    let mut reports = Vec::new();
    for method in &chosen {
        let restricted = Restricted::new(method.as_ref(), args.region.as_deref())?;
        let report = run(&restricted, &settings, &progress);
        totals.add(&report);
        match args.format {
            TextOrJson::Text => {
                let text = text_method::method(&report, width());
                write_to(None, |out| Ok(writeln!(out, "{text}")?))?;
            }
            TextOrJson::Json => reports.push(json_report(&report)),
        }
    }
    match args.format {
        TextOrJson::Text => close(&totals.words(), totals.good(), &settings)?,
        TextOrJson::Json => print_json(&json!({
            "mechaudit_version": env!("CARGO_PKG_VERSION"),
            "passed": totals.good(),
            "methods": reports,
        }))?,
    }
    Ok(Outcome::of(totals.good()))
}

pub fn print_json(value: &Value) -> Result<(), Failure> {
    write_to(None, |out| {
        serde_json::to_writer_pretty(&mut *out, value)?;
        Ok(writeln!(out)?)
    })
}

fn json_report(report: &MethodReport) -> Value {
    let mut value = serde_json::to_value(report).unwrap_or(Value::Null);
    let failures: Vec<Value> = report.failures.iter().map(case::json).collect();
    value["passed_all"] = json!(report.passed());
    value["failures"] = json!(failures);
    value
}

fn find(name: &str) -> Result<Box<dyn Method>, Failure> {
    methods::find(name).ok_or_else(|| {
        let known: Vec<&str> = methods::registry().iter().map(|m| m.name()).collect();
        Failure::new(format!(
            "there is no method {name:?}; there are: {}",
            known.join(", ")
        ))
    })
}

fn one_case(
    method: &dyn Method,
    args: &AuditArgs,
    settings: &Settings,
) -> Result<Option<Case>, Failure> {
    let domain = method.domain();
    if let Some(name) = &args.check_point {
        let names: Vec<&str> = domain.check_points.iter().map(|p| p.name).collect();
        let found = domain.check_points.iter().find(|p| p.name == name);
        let point = found.ok_or_else(|| no_such("check point", name, method, &names))?;
        return Ok(Some(Case {
            method: method.name(),
            region: "check-points",
            input: point.input.clone(),
            origin: Origin::CheckPoint { name: point.name },
        }));
    }
    let (Some(region), Some(index)) = (&args.region, args.case) else {
        return Ok(None);
    };
    let names: Vec<&str> = domain.regions.iter().map(|r| r.name).collect();
    let found = domain.regions.iter().find(|r| r.name == region);
    let region = found.ok_or_else(|| no_such("region", region, method, &names))?;
    let seed = settings.seed;
    let mut draw = Draw::new(seed, method.name(), region.name, index);
    Ok(Some(Case {
        method: method.name(),
        region: region.name,
        input: (region.sample)(&mut draw),
        origin: Origin::Random { seed, index },
    }))
}

fn no_such(what: &str, name: &str, method: &dyn Method, known: &[&str]) -> Failure {
    Failure::new(format!(
        "{} has no {what} {name:?}; it has: {}",
        method.name(),
        known.join(", ")
    ))
}

fn single(
    method: &dyn Method,
    case: Case,
    settings: &Settings,
    format: TextOrJson,
) -> Result<Outcome, Failure> {
    let report: CaseReport = audit_case(method, case, settings);
    let laws: Vec<(Law, Option<f64>)> = method
        .laws()
        .into_iter()
        .map(|l| (l, (l.residual)(&report.case.input)))
        .collect();
    let held = |x: &Option<f64>| x.is_none_or(|x| x <= 1.0);
    let good = report.judgement.verdict == Verdict::Pass && laws.iter().all(|(_, x)| held(x));
    match format {
        TextOrJson::Text => write_to(None, |out| {
            write!(out, "{}", case::text(&report, width()))?;
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
        TextOrJson::Json => {
            let mut value = case::json(&report);
            let laws = laws
                .iter()
                .map(|(l, x)| json!({ "name": l.name, "residual": x }));
            value["laws"] = laws.collect();
            value["passed"] = json!(good);
            print_json(&value)?;
        }
    }
    Ok(Outcome::of(good))
}

/// A method over one region of its domain.
struct Restricted<'a> {
    method: &'a dyn Method,
    region: Option<&'a str>,
}

impl<'a> Restricted<'a> {
    fn new(method: &'a dyn Method, region: Option<&'a str>) -> Result<Restricted<'a>, Failure> {
        if let Some(name) = region {
            let domain = method.domain();
            let names: Vec<&str> = domain.regions.iter().map(|r| r.name).collect();
            if !names.contains(&name) {
                return Err(no_such("region", name, method, &names));
            }
        }
        Ok(Restricted { method, region })
    }
}

impl Method for Restricted<'_> {
    fn name(&self) -> &'static str {
        self.method.name()
    }
    fn summary(&self) -> &'static str {
        self.method.summary()
    }
    fn source(&self) -> &'static str {
        self.method.source()
    }
    fn inputs(&self) -> Vec<Input> {
        self.method.inputs()
    }
    fn outputs(&self) -> Vec<Output> {
        self.method.outputs()
    }
    fn norm_budget(&self) -> Option<NormBudget> {
        self.method.norm_budget()
    }
    fn domain(&self) -> Domain {
        let mut domain = self.method.domain();
        if let Some(name) = self.region {
            domain.regions.retain(|r| r.name == name);
            domain.check_points.clear();
        }
        domain
    }
    fn solve(&self, input: &[f64]) -> SolverAnswer {
        self.method.solve(input)
    }
    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer {
        self.method.reference(input, bits)
    }
    fn reference_not_finite(&self, input: &[f64]) -> ReferenceAnswer {
        self.method.reference_not_finite(input)
    }
    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        self.method.conditions(input)
    }
    fn laws(&self) -> Vec<Law> {
        self.method.laws()
    }
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
