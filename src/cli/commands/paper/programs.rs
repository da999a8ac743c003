//! Programs that a paper names as solvers.

use crate::cli::process::answers::{AnswerLines, Form};
use crate::cli::process::batches::Batches;
use crate::cli::process::candidate::Candidate;
use mechaudit::audit::{Method, SolverAnswer};
use mechaudit::papers::file::{Program, Programs};
use std::time::Duration;

/// The time without an answer after which a program is ended, and that for a batch of inputs, in
/// seconds: the defaults of `audit --exec`.
const TIMES: [u64; 2] = [60, 3600];

/// Starts a program for each batch of inputs, as candidates of an audit.
#[derive(Debug)]
pub struct Runner;

impl Programs for Runner {
    fn answers(
        &self,
        program: &Program,
        method: &dyn Method,
        inputs: &[Vec<f64>],
    ) -> (Vec<SolverAnswer>, Option<String>) {
        let [timeout, run_timeout] = TIMES.map(Duration::from_secs);
        let candidate = Candidate {
            command: shell_words::join(&program.command),
            folder: Some(program.folder.clone()),
            timeout,
            run_timeout,
            form: Form::Lines,
            decimal: false,
            lines: AnswerLines::of(method),
        };
        let mut batches = Batches::new(&candidate);
        let answers = batches.answers(method.name(), inputs);
        let why = batches.failure.map(|e| e.to_string());
        (answers, why.or(batches.report.trouble))
    }
}
