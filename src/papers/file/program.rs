//! Solvers that are programs: they read inputs and write answers as `mechaudit audit --exec` has it.

use super::source::Source;
use crate::audit::{Method, SolverAnswer};
use crate::study::{Study, StudyError};
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Mutex, OnceLock, PoisonError};

/// A program under test.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// The words of its command.
    pub command: Vec<String>,
    /// The folder that it is started in.
    pub folder: PathBuf,
}

/// Runs programs: the command line has the processes.
pub trait Programs: Sync + std::fmt::Debug {
    /// Returns the answers of a program in place of a method's solver, in the order of the inputs:
    /// where there are fewer, with the reason.
    fn answers(
        &self,
        program: &Program,
        method: &dyn Method,
        inputs: &[Vec<f64>],
    ) -> (Vec<SolverAnswer>, Option<String>);
}

/// A program with the answers that it has given: it is asked for no input twice.
#[derive(Debug)]
pub(super) struct Asked {
    program: Program,
    by: OnceLock<&'static dyn Programs>,
    known: Mutex<HashMap<Vec<u64>, SolverAnswer>>,
}

impl Asked {
    /// A program of a paper's folder.
    ///
    /// # Errors
    /// Papers that are no folder, and a command without words.
    pub(super) fn new(command: Vec<String>, source: &Source) -> Result<Asked, StudyError> {
        let fault = |reason: &str| Err(StudyError::new(reason));
        match source {
            _ if command.is_empty() => fault("a command has at least one word"),
            Source::Texts(_) => fault("programs are solvers of papers in folders"),
            Source::Folder(folder) => Ok(Asked {
                program: Program {
                    command,
                    folder: folder.clone(),
                },
                by: OnceLock::new(),
                known: Mutex::default(),
            }),
        }
    }

    pub(super) fn run_by(&self, by: &'static dyn Programs) {
        // Of two runners the first one stays.
        let _ = self.by.set(by);
    }

    /// The answers in place of a study's solver. An input without one is unanswered.
    pub(super) fn answers(&self, study: &Study, inputs: &[Vec<f64>]) -> Vec<SolverAnswer> {
        let key = |x: &Vec<f64>| -> Vec<u64> { x.iter().map(|x| x.to_bits()).collect() };
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let new = inputs.iter().filter(|x| !known.contains_key(&key(x)));
        let new: Vec<Vec<f64>> = new.cloned().collect();
        if !new.is_empty() {
            let not_run = || (Vec::new(), Some("the program was not run".to_string()));
            let found = self.by.get();
            let found = found.map(|by| by.answers(&self.program, study, &new));
            let (found, why) = found.unwrap_or_else(not_run);
            let why = SolverAnswer::Unanswered(why.unwrap_or_else(|| "no answer".into()));
            let mut found = found.into_iter();
            for input in &new {
                let answer = found.next().unwrap_or_else(|| why.clone());
                known.insert(key(input), answer);
            }
        }
        inputs.iter().map(|x| known[&key(x)].clone()).collect()
    }

    /// The answer to one input.
    pub(super) fn solve(&self, study: &Study, input: &[f64]) -> SolverAnswer {
        let one = [input.to_vec()];
        self.answers(study, &one).swap_remove(0)
    }
}

#[cfg(test)]
mod tests;
