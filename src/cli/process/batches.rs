//! A program that answers batch by batch and is started anew for each of them: it may keep its
//! answers back until its input ends, as programs do whose output is buffered.

use crate::cli::failure::Failure;
use crate::cli::process::answers::{Batch, End};
use crate::cli::process::candidate::{Candidate, CandidateProcess};
use crate::cli::process::inputs::Inputs;
use crate::cli::workload::given;
use mechaudit::audit::{CandidateReport, SolverAnswer};
use std::sync::Arc;
use std::time::Instant;

/// The program, and what became of it.
pub struct Batches {
    candidate: Candidate,
    /// The time when the program's time is over; never where the clock does not reach that far.
    deadline: Option<Instant>,
    /// The program's own name and version, and the number of its answers to all batches.
    pub report: CandidateReport,
    /// The first input that it did not answer.
    pub unanswered: Option<Vec<f64>>,
    /// The reason why it could not be started.
    pub failure: Option<Failure>,
}

impl Batches {
    /// No batch was answered yet.
    pub fn new(candidate: &Candidate) -> Batches {
        Batches {
            deadline: Instant::now().checked_add(candidate.run_timeout),
            report: CandidateReport {
                name: candidate.command.clone(),
                command: Some(candidate.command.clone()),
                ..CandidateReport::default()
            },
            candidate: candidate.clone(),
            unanswered: None,
            failure: None,
        }
    }

    /// The answers to a batch: fewer than there are inputs where the program failed, and none
    /// after that.
    pub fn answers(&mut self, method: &'static str, inputs: &[Vec<f64>]) -> Vec<SolverAnswer> {
        if self.failure.is_some() || self.report.trouble.is_some() {
            return Vec::new();
        }
        let left = self
            .deadline
            .map(|end| end.saturating_duration_since(Instant::now()));
        let candidate = Candidate {
            run_timeout: left.unwrap_or(self.candidate.run_timeout),
            ..self.candidate.clone()
        };
        let cases = inputs.iter().map(|x| given(method, x.clone())).collect();
        let cases = Arc::new(Inputs::listed(cases));
        let total = inputs.len();
        let mut process = match CandidateProcess::start(&candidate, &cases, total) {
            Ok(process) => process,
            Err(why) => {
                self.failure = Some(why);
                return Vec::new();
            }
        };
        let mut batch = Batch::default();
        let end = process.collect(total, &mut batch);
        let trouble = match end.unwrap_or_else(|| process.rest()) {
            End::Interrupted => None,
            End::Late => Some(format!(
                "The program's {} s for all its answers were over and it was ended (--run-timeout).",
                self.candidate.run_timeout.as_secs_f64()
            )),
            end => process.end(end),
        };
        let before = self.report.answered;
        let found = process.report(trouble);
        self.report = CandidateReport {
            answered: before + found.answered,
            ..found
        };
        if self.report.trouble.is_some() {
            self.unanswered = inputs.get(batch.len()).cloned();
        }
        (0..batch.len()).map(|i| batch.get(i)).collect()
    }
}
