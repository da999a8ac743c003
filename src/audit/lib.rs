//! The audit: domains, cases, budgets and the judge that compares a solver with its reference.
//!
//! Only a pass passes: NaN, the wrong infinity, an undecided reference, a missing value and a
//! panic all fail. The [`Method`] trait describes what is audited; this module knows no
//! particular method.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod answer;
mod budget;
mod by_integer;
mod case;
mod case_report;
mod comparison;
mod convergence;
mod csv_line;
mod domain;
mod exact;
mod expected;
mod hard;
mod hex_float;
mod hunt;
mod judge;
mod judged;
mod kept;
mod kind;
mod layout;
mod maps;
mod method;
mod nearest;
mod no_such;
mod panel;
mod parts;
#[cfg(test)]
mod planted;
mod printed;
mod ranking;
mod reason;
mod referee;
mod region_tally;
mod report;
mod run;
mod sampling;
mod settings;
#[cfg(test)]
mod soundness_tests;
mod spread;
mod tally;
mod ulp;
mod variant;

pub use answer::{Proof, Reference, ReferenceAnswer, SolverAnswer, Uncertified};
pub use budget::{Budget, Limit, NormBudget};
pub use case::{Case, Cases, Origin};
pub use case_report::CaseReport;
pub use comparison::{
    Compared, Comparison, Contender, Contest, Speed, Standing, compare, judge_together,
};
pub use convergence::{Approximation, ConvergenceReport, LevelError, LevelReport, convergence};
pub use csv_line::csv_line;
pub use domain::{CheckPoint, Domain, Draw, Region, Sampler};
pub use expected::Expected;
pub use hard::{HARD_HEADER, HardCase, HardCaseError, HardCaseFault, rounded_up};
pub use hex_float::{hex_float, write_hex_float};
pub use hunt::{Answers, Hunt, HuntSettings, Worst, hunt, hunt_answers, hunt_from, hunt_until};
pub use judge::{ComponentJudgement, Judgement, Rules, Verdict, judge, judge_by, judge_with_norm};
pub use judged::{answer_of, audit_case, judge_case, judge_case_briefly};
pub use kind::{Kind, Kinds};
pub use layout::{Column, Layout, LayoutError, Shape};
pub use maps::{ErrorMap, MapOutput, error_map, map_points};
pub use method::{
    BranchAt, Input, Law, Method, Output, ProvedBound, ProvedError, Rows,
    conditions_by_differences, largest,
};
pub use nearest::{did_you_mean, nearest};
pub use no_such::NoSuch;
pub use panel::{Answered, Panel};
pub use parts::ErrorParts;
pub use printed::{
    Agreement, EntryJudgement, Printed, PrintedNumber, PrintedUnit, agreement, judge_printed,
};
pub use reason::{Fault, Reason, written};
pub use referee::{Judge, Referee};
pub use report::{
    CandidateReport, LawReport, MethodReport, Octave, OutputBudget, OutputStatistics, Point,
    RegionReport, Reproduce,
};
pub use run::{audit_method, audit_method_until, audit_one};
pub use sampling::{Near, SampleBox, Sampling, SamplingError};
pub use settings::Settings;
pub use spread::{Spread, SpreadTally};
pub use tally::{StoredError, StoredTally, Tally};
pub use ulp::{Format, ulp_exponent, ulps};
pub use variant::{Variant, selected_outputs};
