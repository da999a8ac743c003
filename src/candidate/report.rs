//! The findings of an audit of a user's code, in words that can be acted on.

use crate::audit::{
    Budget, CaseReport, ComponentJudgement, Kinds, Layout, Method, MethodReport, Origin, Proof,
    SolverAnswer, Spread, Verdict, hex_float,
};
use std::fmt::{self, Display, Formatter};
use std::ops::Deref;

/// Failing cases written out in full.
const SHOWN: usize = 5;

/// The findings; written out, the statistics and the first failing cases with everything that is
/// known of them.
#[derive(Clone, Debug)]
pub struct Report {
    found: MethodReport,
    layout: Layout,
    /// Names of the outputs that share a budget, with the budget.
    budgets: Vec<(Vec<&'static str>, Budget)>,
}

impl Deref for Report {
    type Target = MethodReport;

    fn deref(&self) -> &MethodReport {
        &self.found
    }
}

impl Report {
    pub(super) fn new(method: &dyn Method, found: MethodReport) -> Report {
        let mut budgets: Vec<(Vec<&'static str>, Budget)> = Vec::new();
        for o in method.outputs() {
            match budgets.iter_mut().find(|g| g.1 == o.budget) {
                Some(group) => group.0.push(o.name),
                None => budgets.push((vec![o.name], o.budget)),
            }
        }
        Report {
            found,
            layout: Layout::new(method),
            budgets,
        }
    }

    /// Goes on only if every case passed.
    ///
    /// # Panics
    /// Otherwise, with the report.
    pub fn assert_within_budget(&self) -> &Report {
        assert!(self.passed(), "\n{self}");
        self
    }

    fn case(&self, f: &mut Formatter<'_>, report: &CaseReport) -> fmt::Result {
        let case = &report.case;
        let reason = report.judgement.why().unwrap_or("pass".into());
        writeln!(f, "\n{} / {}: {reason}", case.method, case.region)?;
        let names = self.layout.names(&case.input);
        for (i, (x, (name, _))) in case.input.iter().zip(names).enumerate() {
            let label = if i == 0 { "input" } else { "" };
            writeln!(f, "  {label:<11}{name} = {x:?} = {}", hex_float(*x))?;
        }
        match &report.answer {
            Some(SolverAnswer::Values(got)) => values(f, report, got)?,
            Some(SolverAnswer::Fails(_) | SolverAnswer::Unanswered(_)) | None => {
                writeln!(f, "  {:<11}no answer", "got")?
            }
            Some(refusal) => {
                let word = refusal.refusal().unwrap_or("no reason");
                writeln!(f, "  {:<11}a refusal: {word}", "got")?;
            }
        }
        if let Some(at) = &report.branch {
            let branch = at.branch.as_ref();
            let branch = branch.map_or(String::new(), |b| format!("{b}, "));
            let (distance, seam) = (short(at.distance), &at.seam);
            writeln!(
                f,
                "  {:<11}{branch}{distance} from the seam {seam}",
                "branch"
            )?;
        }
        let proof = match report.proof {
            Some(Proof::Exact) => ", exact",
            Some(Proof::Bounded(why)) => &format!(", {why}"),
            None => "",
        };
        writeln!(f, "  {:<11}{} bits{proof}", "reference", report.bits)?;
        let chosen = match &case.origin {
            Origin::CheckPoint { name } => format!(".check_point({name:?})"),
            Origin::Hard { number, .. } => format!(".hard_case({number})"),
            Origin::Random { seed, index } => {
                format!(".region({:?}).seed({seed}).case({index})", case.region)
            }
            Origin::Line { number } => format!("line {number}"),
            Origin::Box { text, seed, index } => {
                format!(".sample_box({text:?}).seed({seed}).case({index})")
            }
            Origin::Near {
                text,
                radius,
                seed,
                index,
            } => format!(".near({text:?}, {radius:e}).seed({seed}).case({index})"),
            Origin::Given => "the input itself".into(),
        };
        writeln!(f, "  {:<11}{chosen}", "reproduce")?;
        let (method, place) = (case.method, case.place());
        writeln!(f, "  {:<11}mechaudit points {method} {place}", "")
    }
}

fn values(f: &mut Formatter<'_>, report: &CaseReport, got: &[f64]) -> fmt::Result {
    let judged = &report.judgement.components;
    for (i, x) in got.iter().enumerate() {
        let c = judged.get(i);
        let label = c.map_or("got", |c| c.output);
        writeln!(f, "  {label:<11}{x:?} = {}", hex_float(*x))?;
        let expected = report.reference.get(i).and_then(Option::as_deref);
        match (expected, report.radii.get(i)) {
            (Some(digits), Some(r)) if *r > 0.0 => {
                writeln!(f, "  {:<11}due {digits} ± {r:.1e}", "")?;
            }
            (Some(digits), _) => writeln!(f, "  {:<11}due {digits}", "")?,
            _ => {}
        }
        if let Some(c) = c {
            writeln!(f, "  {:<11}{}", "", error(c))?;
        }
    }
    Ok(())
}

/// The error of one value in words.
fn error(c: &ComponentJudgement) -> String {
    let mut parts = Vec::new();
    if !c.ulps.is_nan() {
        parts.push(format!("{} ulps", short(c.ulps)));
    }
    if !c.conditioned.is_nan() {
        parts.push(format!("{} u (1 + condition)", short(c.conditioned)));
    }
    parts.push(format!("{} of its budget", short(c.of_budget)));
    if c.condition.is_finite() {
        parts.push(format!("condition {}", short(c.condition)));
    }
    parts.join(", ")
}

/// Four figures or so, with an exponent only where it is needed.
fn short(x: f64) -> String {
    match x.abs() {
        s if (1e3..1e6).contains(&s) => format!("{x:.0}"),
        s if s == 0.0 || (1e-3..1e3).contains(&s) || !s.is_finite() => format!("{x:.3}"),
        _ => format!("{x:.2e}"),
    }
}

/// Answers of each wrong kind, after a semicolon; nothing if there are none.
fn wrong(kinds: &Kinds) -> String {
    let each: Vec<String> = kinds
        .nonzero()
        .map(|(kind, n)| format!("{n} {}", kind.name()))
        .collect();
    match each.is_empty() {
        true => String::new(),
        false => format!("; wrong in kind: {}", each.join(", ")),
    }
}

/// Worst, 99th percentile, median and root mean square.
fn figures(s: &Spread) -> String {
    let [max, p99, median, rms] = [s.max, s.p99, s.median, s.rms].map(short);
    let beyond = match s.beyond {
        0 => String::new(),
        n => format!(", {n} beyond 1e308"),
    };
    format!("worst found {max}, 99 % below {p99}, median {median}, RMS {rms}{beyond}")
}

impl Report {
    /// The head, the statistics and the budgets: what is the same from run to run and from machine
    /// to machine.
    fn statistics(&self, f: &mut dyn fmt::Write) -> fmt::Result {
        let r = &self.found;
        let word = if r.passed() { "pass" } else { "FAIL" };
        let recorded = match r.recorded {
            0 => String::new(),
            n => format!(", {n} hard cases over it by no more than the method's own solver"),
        };
        let counted = match r.failed() {
            0 => format!("{} of {} cases within budget", r.passed, r.cases),
            n => format!("{n} of {} cases failed", r.cases),
        };
        writeln!(
            f,
            "{}: {word}, {counted}{recorded} (seed {}, {} cases per region)",
            r.method, r.settings.seed, r.settings.cases_per_region
        )?;
        for o in r.outputs() {
            let found = match o.max_of_budget.is_nan() {
                true => "no error measured".into(),
                false => format!(
                    "in ulps {}; {} of its budget",
                    figures(&o.ulps),
                    short(o.max_of_budget)
                ),
            };
            let (values, wrong) = (o.values, wrong(&o.kinds));
            writeln!(f, "  {:<11}{values} values; {found}{wrong}", o.name)?;
        }
        if let Some(norm) = r.total.normwise.filter(|n| n.count > 0) {
            writeln!(f, "  {:<11}in u {}", "norm", figures(&norm))?;
        }
        for (names, budget) in &self.budgets {
            let (names, why) = (names.join(", "), budget.reason);
            writeln!(f, "  {:<11}{names}: {} ({why})", "budget", budget.limit)?;
        }
        if let Some(norm) = r.norm_budget {
            let shown = norm.shown(r.format);
            writeln!(f, "  {:<11}all together: {shown} ({})", "", norm.reason)?;
        }
        for (k, region) in r.regions.iter().enumerate() {
            let label = if k == 0 { "regions" } else { "" };
            let failed = match region.failed() {
                0 => String::new(),
                n => format!(", {n} failed"),
            };
            writeln!(
                f,
                "  {label:<11}{}: {} cases{failed}{}{}",
                region.name,
                region.cases,
                match region.max_of_budget.is_nan() {
                    true => String::new(),
                    false => format!(", {} of a budget at most", short(region.max_of_budget)),
                },
                wrong(&region.kinds)
            )?;
        }
        Ok(())
    }

    /// The report as text that stays the same as long as the code, the seed and this crate's
    /// version do: no times, no paths, no colours. For snapshots:
    ///
    /// ```
    /// let report = mechaudit::audit_by_name("erfc", |x| {
    ///     let z = mechaudit::Complex64::new(x[0], x[1]);
    ///     mechaudit::solvers::faddeeva::erfc(z)
    /// })?
    /// .region("mid")
    /// .effort(0.1)
    /// .run()?;
    /// let text = report.snapshot();
    /// assert!(text.starts_with("erfc: pass, 20 of 20 cases within budget"), "{text}");
    /// // In a test: insta::assert_snapshot!(report.snapshot());
    /// # Ok::<(), mechaudit::candidate::AuditError>(())
    /// ```
    pub fn snapshot(&self) -> String {
        let mut text = String::new();
        self.statistics(&mut text)
            .expect("a text takes all that is written");
        for case in self.found.worst.iter().chain(&self.found.wrong) {
            let input: Vec<String> = case.case.input.iter().map(|x| hex_float(*x)).collect();
            let reason = case.judgement.why().unwrap_or("pass".into());
            let (region, place) = (case.case.region, case.case.place());
            let input = input.join(",");
            let share = short(case.judgement.share());
            text.push_str(&format!(
                "\n{region}: {reason}; {share} of a budget\n  {input}\n  {place}\n"
            ));
        }
        text
    }
}

impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let r = &self.found;
        self.statistics(f)?;
        let over = r.worst.iter();
        let over = over.filter(|c| c.judgement.verdict == Verdict::Over);
        let mut shown = 0;
        for failure in over.take(SHOWN).chain(&r.wrong).take(2 * SHOWN) {
            self.case(f, failure)?;
            shown += 1;
        }
        let left = r.failed().saturating_sub(shown);
        if left > 0 {
            writeln!(f, "\n{left} more failing cases")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
