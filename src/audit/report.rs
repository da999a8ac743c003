//! The report of an audit: one type for a method's own solver and for somebody's code, wherever its
//! answers come from.

use super::budget::{Budget, NormBudget};
use super::case::{Case, briefly, briefly_if};
use super::case_report::CaseReport;
use super::judge::Verdict;
use super::kind::Kinds;
use super::layout::Layout;
use super::maps::ErrorMap;
use super::method::ProvedBound;
use super::parts::ErrorParts;
use super::settings::Settings;
use super::spread::Spread;
use super::ulp::Format;
use serde::Serialize;

/// The findings for one output, in a region or in all.
#[derive(Clone, Debug, Serialize)]
pub struct OutputStatistics {
    /// The output.
    pub name: &'static str,
    /// Values judged, of every kind.
    pub values: u64,
    /// Those of the wrong kind; they are in no other member.
    pub kinds: Kinds,
    /// Errors in ulps, over the values that are not zero.
    pub ulps: Spread,
    /// Errors in units of `u (|ref| + Σ_j |x_j ∂ref/∂x_j|)`: what is left of them when each
    /// input's last half-ulp is forgiven. Nothing without condition numbers.
    pub conditioned: Spread,
    /// The errors in ulps counted by octaves, exact values first.
    pub histogram: Vec<Octave>,
    /// Largest share of the budget found; NaN where no error was measured.
    pub max_of_budget: f64,
    /// Largest finite condition number met.
    pub max_condition: f64,
    /// The case with the largest share of the budget.
    #[serde(serialize_with = "briefly_if")]
    pub worst: Option<Case>,
    /// Its error taken apart, where the method has a twin.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parts: Option<ErrorParts>,
}

/// Errors in an octave.
#[derive(Clone, Debug, Serialize)]
pub struct Octave {
    /// `k` for errors in `[2^k, 2^(k+1))` ulps; nothing for exact values.
    pub exponent: Option<i32>,
    /// The number.
    pub count: u64,
    /// The case with the largest of them, and the first of several.
    #[serde(serialize_with = "briefly")]
    pub worst: Case,
}

/// The findings in one region of the domain, or in all.
#[derive(Clone, Debug, Serialize)]
pub struct RegionReport {
    /// Its name: a region of the method, `check-points`, `hard`, `given`, `box` or `near`.
    pub name: &'static str,
    /// The contents.
    pub description: &'static str,
    /// Cases judged, those without an answer included.
    pub cases: u64,
    /// Cases passed.
    pub passed: u64,
    /// Hard cases over budget by no more than is recorded of the method's own solver.
    pub recorded: u64,
    /// The number of cases certainly over budget.
    pub over: u64,
    /// Cases that the reference could not decide.
    pub undecided: u64,
    /// Cases at which the reference failed.
    pub reference_failed: u64,
    /// Cases of the wrong kind.
    pub kinds: Kinds,
    /// For each output.
    pub outputs: Vec<OutputStatistics>,
    /// `‖got − ref‖₂ / ‖ref‖₂` over all values of an answer in units of u (for subnormal norms by
    /// the smallest normal number), where the outputs share a unit.
    pub normwise: Option<Spread>,
    /// Largest share of a budget, that of the norm included; NaN where there is none.
    pub max_of_budget: f64,
    /// The case with it.
    #[serde(serialize_with = "briefly_if")]
    pub worst: Option<Case>,
}

impl RegionReport {
    /// Cases that did not pass and are not recorded.
    pub fn failed(&self) -> u64 {
        self.cases - self.passed - self.recorded
    }
}

/// The findings about one law.
#[derive(Clone, Debug, Serialize)]
pub struct LawReport {
    /// Its name.
    pub name: &'static str,
    /// The identity.
    pub statement: &'static str,
    /// Cases it was tried on.
    pub cases: usize,
    /// Largest residual found, divided by what is allowed.
    pub worst: f64,
    /// The case with the largest residual.
    pub worst_case: Option<Case>,
}

/// An output and the budget that was in force for it.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct OutputBudget {
    /// The output.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The budget.
    pub budget: Budget,
}

/// The code that was audited, if it is not the method's own solver.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct CandidateReport {
    /// As it calls itself, or the command, or `closure`.
    pub name: String,
    /// The version that it names.
    pub version: Option<String>,
    /// The command that ran it, if it was a program.
    pub command: Option<String>,
    /// Answers that came.
    pub answered: u64,
    /// The trouble apart from the answers.
    pub trouble: Option<String>,
}

/// One case with the errors of all its outputs, of a sample that shows how errors depend on the
/// input.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// The case.
    #[serde(serialize_with = "briefly")]
    pub case: Case,
    /// The verdict.
    pub verdict: Verdict,
    /// The largest error of each output in ulps; NaN where it has none.
    pub ulps: Vec<f64>,
    /// The largest share of a budget.
    pub of_budget: f64,
}

/// The parts of a command that are the same for all cases of a report: the command is head, the
/// place of the case, tail.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reproduce {
    /// The words before the place of a case: `mechaudit audit METHOD ` with the blank.
    pub head: String,
    /// The words after it: nothing, or a blank and options.
    pub tail: String,
}

/// The findings about one method.
#[derive(Clone, Debug, Serialize)]
pub struct MethodReport {
    /// The method.
    pub method: &'static str,
    /// In plain words.
    pub summary: &'static str,
    /// Its source.
    pub source: &'static str,
    /// Remarks on the method.
    pub remarks: Vec<String>,
    /// The layout of its inputs and answers: cases take the names of their numbers from it.
    #[serde(skip)]
    pub layout: Layout,
    /// The code audited, if it is not the method's own solver.
    pub candidate: Option<CandidateReport>,
    /// The settings.
    pub settings: Settings,
    /// The format of the code's numbers.
    pub format: Format,
    /// Names of the inputs that are single numbers, with their place in an input where it is always
    /// the same.
    pub inputs: Vec<(&'static str, usize)>,
    /// The budgets in force.
    pub budgets: Vec<OutputBudget>,
    /// The budget of the norm, if one is in force.
    pub norm_budget: Option<NormBudget>,
    /// The proved bounds of the error of the method's own solver.
    pub proved: Vec<ProvedBound>,
    /// Cases judged.
    pub cases: u64,
    /// Cases passed.
    pub passed: u64,
    /// Hard cases over budget by no more than is recorded of the method's own solver.
    pub recorded: u64,
    /// True if the run was ended before all cases were judged.
    pub interrupted: bool,
    /// All regions together.
    pub total: RegionReport,
    /// Region by region, in the domain's order.
    pub regions: Vec<RegionReport>,
    /// For each law.
    pub laws: Vec<LawReport>,
    /// The error map, if one was requested and the method has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map: Option<ErrorMap>,
    /// The ten cases with the largest shares of a budget: the worst of each region first, then the
    /// rest.
    pub worst: Vec<CaseReport>,
    /// The first cases of each wrong kind, and those that the reference could not settle.
    pub wrong: Vec<CaseReport>,
    /// The cases that did not pass, the first of them if there are very many.
    pub failures: Vec<CaseReport>,
    /// The number of further cases that did not pass.
    pub failures_left_out: u64,
    /// A sample of all cases.
    pub points: Vec<Point>,
    /// The command that judges a case again.
    pub reproduce: Reproduce,
}

impl MethodReport {
    /// Returns true if all cases were judged and every one and every law passed, but for recorded
    /// findings, nothing else went wrong, and there was at least one case.
    pub fn passed(&self) -> bool {
        let all = self.passed + self.recorded == self.cases;
        let laws = self.laws.iter().all(|l| l.worst <= 1.0);
        let candidate = self.candidate.as_ref();
        let calm = candidate.is_none_or(|c| c.trouble.is_none());
        !self.interrupted && self.cases > 0 && all && laws && calm
    }

    /// For each output, over all regions.
    pub fn outputs(&self) -> &[OutputStatistics] {
        &self.total.outputs
    }

    /// Cases that did not pass and are not recorded.
    pub fn failed(&self) -> u64 {
        self.total.failed()
    }

    /// The command that judges a case again.
    pub fn reproduce_command(&self, case: &Case) -> String {
        let Reproduce { head, tail } = &self.reproduce;
        format!("{head}{}{tail}", case.place())
    }
}

#[cfg(test)]
mod tests {
    use crate::planted::{Planted, case};
    use crate::{Reproduce, Settings, audit_one};

    /// A case is judged again by the command with its place in the middle.
    #[test]
    fn a_case_has_a_command() {
        let mut report = audit_one(
            &Planted::default(),
            case(3, &[1.5]),
            None,
            &Settings::default(),
        );
        let place = "--region middle --seed 1 --case 3";
        let again = |report: &super::MethodReport| report.reproduce_command(&case(3, &[1.5]));
        assert_eq!(again(&report), format!("mechaudit audit planted {place}"));
        report.reproduce = Reproduce {
            head: "head ".into(),
            tail: " tail".into(),
        };
        assert_eq!(again(&report), format!("head {place} tail"));
    }
}
