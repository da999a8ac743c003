//! Programs under audit: they read inputs and write answers.
//!
//! For each program one thread writes all inputs and one reads answers ahead ([`Answers`]); answers
//! are judged batch by batch, those of several programs to a case together.

use crate::cli::failure::Failure;
use crate::cli::process::answers::{AnswerLines, Answers, Batch, End, Form};
use crate::cli::process::inputs::Inputs;
use crate::cli::process::interrupt::{self, POLL};
use crate::cli::process::program::Program;
use crate::cli::process::{frames, wire};
use crate::cli::progress::Progress;
use mechaudit::audit::{
    Answered, CandidateReport, Case, Method, MethodReport, Panel, Settings, SolverAnswer, Tally,
    judge_case,
};
use std::cell::Cell;
use std::io::{BufWriter, Write};
use std::ops::Range;
use std::path::PathBuf;
use std::process::ChildStdin;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

/// A program under audit, and how it is spoken to.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The command that starts it.
    pub command: String,
    /// The folder that it is started in, where that is not the program's own.
    pub folder: Option<PathBuf>,
    /// The time without an answer after which it is ended.
    pub timeout: Duration,
    /// The time after which it is ended, however much it has answered.
    pub run_timeout: Duration,
    /// The form of inputs and answers.
    pub form: Form,
    /// True if inputs are written as decimals instead of hexadecimal floats.
    pub decimal: bool,
    /// The lines of its answers.
    pub lines: AnswerLines,
}

impl Candidate {
    /// The candidate that answers as a method does.
    pub fn answering(&self, method: &(impl Method + ?Sized)) -> Candidate {
        Candidate {
            lines: AnswerLines::of(method),
            ..self.clone()
        }
    }
}

/// A running candidate that gets a number of inputs, from the first to the last and round again.
pub struct CandidateProcess {
    command: String,
    child: Program,
    answers: Answers,
    timeout: Duration,
    /// The time for the whole run, and when it is over; never where the clock does not reach that
    /// far.
    run: Duration,
    deadline: Option<Instant>,
    total: usize,
    answered: usize,
}

impl CandidateProcess {
    /// Starts the candidate and writes the first `total` inputs to it.
    pub fn start(
        candidate: &Candidate,
        inputs: &Arc<Inputs>,
        total: usize,
    ) -> Result<CandidateProcess, Failure> {
        let (form, decimal) = (candidate.form, candidate.decimal);
        let protocol = match form {
            Form::Frames => "binary",
            Form::Lines => "text",
        };
        let mut child = Program::start(&candidate.command, candidate.folder.as_deref(), protocol)?;
        let (stdin, stdout) = child.pipes()?;
        let given = Arc::clone(inputs);
        thread::spawn(move || feed(stdin, &given, total, form, decimal));
        Ok(CandidateProcess {
            command: candidate.command.clone(),
            child,
            answers: Answers::of(stdout, form, candidate.lines),
            timeout: candidate.timeout,
            run: candidate.run_timeout,
            deadline: Instant::now().checked_add(candidate.run_timeout),
            total,
            answered: 0,
        })
    }

    /// Waits for that many answers more, or for their end.
    pub fn collect(&mut self, due: usize, batch: &mut Batch) -> Option<End> {
        let before = batch.len();
        while batch.len() < before + due {
            let Some(timeout) = self.patience() else {
                return Some(End::Late);
            };
            let left = before + due - batch.len();
            let here = batch.len();
            let taken = self.answers.take(left, timeout, batch);
            self.answered += batch.len() - here;
            match taken {
                Ok(_) => {}
                Err(End::Silent) if timeout < self.timeout => return Some(End::Late),
                Err(end) => return Some(end),
            }
        }
        None
    }

    /// Returns the time to wait for a line; none if the time for the whole run is over.
    fn patience(&self) -> Option<Duration> {
        let Some(deadline) = self.deadline else {
            return Some(self.timeout);
        };
        let left = deadline.saturating_duration_since(Instant::now());
        (!left.is_zero()).then(|| left.min(self.timeout))
    }

    /// Every input is answered: waits for the end of its output, which what it left behind may hold
    /// open.
    pub fn rest(&mut self) -> End {
        let start = Instant::now();
        loop {
            match self.answers.next(Some(POLL)) {
                Ok(_) => return End::TooMany,
                Err(End::Silent) if start.elapsed() <= self.timeout => {
                    if self.child.has_ended() {
                        self.child.end_group();
                    }
                }
                Err(end) => return end,
            }
        }
    }

    /// Ends it, and says what went wrong, if anything did.
    pub fn end(&mut self, end: End) -> Option<String> {
        let (answered, total) = (self.answered, self.total);
        if let End::Interrupted = end {
            return Some(format!(
                "Interrupted: the program had answered {answered} of {total} inputs."
            ));
        }
        let early = || (answered < total).then(|| EARLY.to_string());
        let seconds = self.run.as_secs_f64();
        let why = match end {
            End::Late => format!("its {seconds} s were over and it was ended (--run-timeout)"),
            end => self.child.end(end, self.timeout).or_else(early)?,
        };
        let tail = match total - answered {
            0 => String::new(),
            left => format!("; {left} of {total} inputs are unanswered"),
        };
        Some(format!(
            "The program answered {answered} times, then {why}{tail}."
        ))
    }

    /// Returns the report of the candidate itself.
    pub fn report(&self, trouble: Option<String>) -> CandidateReport {
        let header = self.answers.header();
        CandidateReport {
            name: header.name.unwrap_or_else(|| self.command.clone()),
            version: header.version,
            command: Some(self.command.clone()),
            answered: self.answered as u64,
            trouble,
        }
    }

    /// Returns the number of answers.
    pub fn answered(&self) -> usize {
        self.answered
    }
}

const EARLY: &str = "it ended its output, with exit status 0";

/// Audits a program at one input, or over the method's domain.
pub fn audit(
    method: &dyn Method,
    one: Option<Case>,
    candidate: &Candidate,
    settings: &Settings,
) -> Result<MethodReport, Failure> {
    let inputs = Inputs::of(method, one, settings)?;
    let total = inputs.len();
    let mut process = CandidateProcess::start(&candidate.answering(method), &inputs, total)?;
    let panel = Panel::new(method, settings);
    let progress = Progress::new();
    let show = |answered| progress.show(method.name(), answered, total as u64);
    let end = judged(&mut process, &inputs, &panel, &show);
    drop(progress);
    let mut tally = panel.into_tally();
    if let End::Interrupted = end {
        tally.interrupt();
    }
    let trouble = process.end(end);
    if let (Some(why), false) = (&trouble, tally.is_interrupted()) {
        unanswered(
            method,
            settings,
            &inputs,
            process.answered(),
            why,
            &mut tally,
        );
    }
    let mut report = tally.finish(method);
    report.candidate = Some(process.report(trouble));
    Ok(report)
}

/// Audits a program at the inputs of a shard on a panel; its report names what went wrong, and
/// nothing is counted in place of answers that did not come; no report if the user asked to stop.
/// `progress` is told of cases judged.
pub fn gather(
    panel: &Panel,
    inputs: Inputs,
    candidate: &Candidate,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Option<CandidateReport>, Failure> {
    let inputs = Arc::new(inputs);
    let candidate = candidate.answering(panel.method());
    let mut process = CandidateProcess::start(&candidate, &inputs, inputs.len())?;
    let told = Cell::new(0);
    let show = |answered| progress(answered - told.replace(answered));
    let end = judged(&mut process, &inputs, panel, &show);
    let stopped = matches!(end, End::Interrupted);
    let trouble = process.end(end);
    Ok((!stopped).then(|| process.report(trouble)))
}

/// Judges answers until there are no more; says why not. `show` is told how many there were.
fn judged(
    process: &mut CandidateProcess,
    inputs: &Inputs,
    panel: &Panel,
    show: &dyn Fn(u64),
) -> End {
    loop {
        let mut batch = Batch::default();
        let from = process.answered();
        let end = match inputs.len() - from {
            0 => Some(process.rest()),
            due => process.collect(due.min(BATCH), &mut batch),
        };
        let answered = |some: Range<usize>| {
            let cases = inputs.take(from + some.start..from + some.end);
            let answers = some.map(|i| batch.get(i));
            cases.into_iter().zip(answers).collect()
        };
        let whole = judge_batch(panel, batch.len(), &answered);
        show(process.answered() as u64);
        match end {
            _ if !whole => return End::Interrupted,
            Some(end) => return end,
            None => {}
        }
    }
}

/// Counts the inputs from `from` on as unanswered, region by region; the first of them is a case to
/// look at.
pub fn unanswered(
    method: &dyn Method,
    settings: &Settings,
    inputs: &Inputs,
    from: usize,
    why: &str,
    tally: &mut Tally,
) {
    if from >= inputs.len() {
        return;
    }
    let first = inputs.take_one(from);
    let answer = SolverAnswer::Unanswered(why.into());
    tally.add(&judge_case(method, first, answer, settings));
    let mut at = from + 1;
    while at < inputs.len() {
        let (region, end) = inputs.region_of(at);
        tally.unanswered(region, (end - at) as u64);
        at = end;
    }
}

/// Answers judged side by side.
pub const BATCH: usize = 1024;

/// The time for which a batch is still judged after the user has asked to stop.
const GRACE: Duration = Duration::from_secs(1);

/// Judges a batch of `total` answers on all cores, each block of them made where it is judged.
/// Returns false if the user asked to stop before the end.
pub fn judge_batch(panel: &Panel, total: usize, answered: &Answered) -> bool {
    let start = Instant::now();
    panel.judge(total, answered, &|| {
        !interrupt::is_requested() || start.elapsed() < GRACE
    })
}

/// Inputs that are drawn and written together.
const SHOWN: usize = 64;

/// Writes `total` inputs; a program that reads no more is noticed by its silence or its end.
fn feed(stdin: ChildStdin, inputs: &Inputs, total: usize, form: Form, decimal: bool) {
    let mut out = BufWriter::with_capacity(1 << 16, stdin);
    let (mut lines, mut frames) = (String::new(), Vec::new());
    let mut at = 0;
    while at < total {
        let from = at % inputs.len();
        let some = SHOWN.min(total - at).min(inputs.len() - from);
        let cases = inputs.take(from..from + some);
        lines.clear();
        frames.clear();
        for case in &cases {
            match form {
                Form::Lines => {
                    wire::write(&mut lines, &case.input, decimal);
                    lines.push('\n');
                }
                Form::Frames => frames::encode(&case.input, &mut frames),
            }
        }
        // Before the answers to them can come.
        inputs.keep(from, cases);
        let text = match form {
            Form::Lines => lines.as_bytes(),
            Form::Frames => &frames,
        };
        if out.write_all(text).is_err() {
            return;
        }
        at += some;
    }
    let _ = out.flush();
}

#[cfg(all(test, unix))]
mod tests;
