//! A program under audit: it reads inputs and writes answers, one a line.
//!
//! One thread writes all inputs, one reads answers ahead ([`Answers`]), and the answers are judged as they come; inputs are drawn anew where they are needed, so that nothing grows with
//! their number.

use crate::cli::answers::{Answers, Next};
use crate::cli::args::{AuditArgs, AuditFormat, ExecArgs, TextOrJson};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::process::candidate::{BATCH, Judged, failures_kept, judge_batch};
use crate::cli::process::interrupt::POLL;
use crate::cli::process::program::Program;
use crate::cli::process::wire::{self, Line};
use crate::cli::progress::Progress;
use mechaudit::audit::{Case, Cases, Method, Settings, SolverAnswer, Tally, judge_case};
use std::io::{BufReader, BufWriter, Write};
use std::process::ChildStdin;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

/// The inputs of a run, drawn when they are asked for.
enum Inputs {
    All(Cases),
    One(Case),
}

impl Inputs {
    fn len(&self) -> usize {
        match self {
            Inputs::All(cases) => cases.len(),
            Inputs::One(_) => 1,
        }
    }

    fn get(&self, i: usize) -> Case {
        match self {
            Inputs::All(cases) => cases.get(i),
            Inputs::One(case) => case.clone(),
        }
    }
}

/// Audits the program as the arguments ask for: at one input, or over the method's domain.
pub fn audit(
    method: &dyn Method,
    one: Option<Case>,
    args: &AuditArgs,
    command: &str,
    settings: &Settings,
    output: Output,
) -> Result<Outcome, Failure> {
    let format = match args.format {
        AuditFormat::Text => TextOrJson::Text,
        AuditFormat::Json => TextOrJson::Json,
        _ => {
            return Err(Failure::new(
                "a program's audit is reported as text or json",
            ));
        }
    };
    let inputs = match one {
        Some(case) => Inputs::One(case),
        None => Inputs::All(Cases::new(method, settings)),
    };
    let inputs = Arc::new(inputs);
    let judged = run(method, settings, inputs, command, &args.program, format)?;
    let decimal = if args.program.decimal {
        " --decimal"
    } else {
        ""
    };
    let quoted = shell_words::quote(command);
    judged.write(output, format, &|case| {
        format!("{} --exec {quoted}{decimal}", case.reproduce())
    })
}

fn run(
    method: &dyn Method,
    settings: &Settings,
    inputs: Arc<Inputs>,
    command: &str,
    program: &ExecArgs,
    format: TextOrJson,
) -> Result<Judged, Failure> {
    let timeout = program.timeout;
    let total = inputs.len();
    if total == 0 {
        return Err(Failure::new("there are no cases to audit"));
    }
    let mut child = Program::start(command)?;
    let (stdin, stdout) = child.pipes()?;
    let (given, decimal) = (Arc::clone(&inputs), program.decimal);
    thread::spawn(move || feed(stdin, &given, decimal));
    let answers = Answers::of(BufReader::new(stdout));
    let mut tally = Tally::new(method, failures_kept(format));
    let progress = Progress::new();
    let mut answered = 0;
    let end = loop {
        let mut batch = Vec::new();
        let end = match total - answered {
            0 => Some(rest(&mut child, &answers, timeout)),
            due => collect(&answers, timeout, due, &mut batch),
        };
        let cases = batch.iter().enumerate();
        let pairs = cases.map(|(k, line)| (inputs.get(answered + k), line.answer()));
        let pairs: Vec<_> = pairs.collect();
        answered += pairs.len();
        judge_batch(method, settings, pairs, &mut tally);
        progress.show(method.name(), answered as u64, total as u64);
        match end {
            Some(end) => break end,
            None if tally.is_interrupted() => break End::Interrupted,
            None => {}
        }
    };
    drop(progress);
    if let End::Interrupted = end {
        tally.interrupt();
        return Ok(Judged {
            report: tally.finish(method, settings),
            answered,
            trouble: Some(format!(
                "Interrupted: the program had answered {answered} of {total} inputs."
            )),
        });
    }
    let trouble = child.end(end, timeout).or_else(|| {
        (answered < total).then(|| "it ended its output, with exit status 0".to_string())
    });
    let trouble = trouble.map(|why| {
        let left = total - answered;
        let tail = match left {
            0 => String::new(),
            _ => format!("; {left} of {total} inputs are unanswered"),
        };
        format!("The program answered {answered} times, then {why}{tail}.")
    });
    if answered < total {
        let why = trouble.clone().unwrap_or_default();
        let first = inputs.get(answered);
        let answer = SolverAnswer::Fails(why);
        tally.add(judge_case(method, first, answer, settings));
        tally.unanswered(total - answered - 1);
    }
    Ok(Judged {
        report: tally.finish(method, settings),
        answered,
        trouble,
    })
}

/// Why there are no more answers to judge.
pub enum End {
    /// Its output has ended.
    Closed,
    /// One answer more than there are inputs.
    TooMany,
    /// Nothing came for so long.
    Silent,
    /// Its output cannot be read.
    Unreadable(std::io::Error),
    /// The user has asked to stop.
    Interrupted,
}

/// Waits for an answer and takes what else is there.
fn collect(answers: &Answers, timeout: Duration, due: usize, batch: &mut Vec<Line>) -> Option<End> {
    let mut patience = timeout;
    loop {
        match answers.next(Some(patience)) {
            Next::Answer(_) if batch.len() == due => return Some(End::TooMany),
            Next::Answer(line) => batch.push(line),
            Next::Unreadable(why) => return Some(End::Unreadable(why)),
            Next::Silent if batch.is_empty() => return Some(End::Silent),
            Next::Silent => return None,
            Next::Closed => return Some(End::Closed),
            Next::Interrupted => return Some(End::Interrupted),
        }
        if batch.len() == BATCH {
            return None;
        }
        patience = Duration::ZERO;
    }
}

/// Every input is answered: waits for the end of its output, which what it left behind may hold open.
fn rest(child: &mut Program, answers: &Answers, timeout: Duration) -> End {
    let start = Instant::now();
    loop {
        match answers.next(Some(POLL)) {
            Next::Answer(_) => return End::TooMany,
            Next::Unreadable(why) => return End::Unreadable(why),
            Next::Closed => return End::Closed,
            Next::Interrupted => return End::Interrupted,
            Next::Silent if start.elapsed() > timeout => return End::Silent,
            Next::Silent if child.has_ended() => child.end_group(),
            Next::Silent => {}
        }
    }
}

/// Writes all inputs; a program that reads no more is noticed by its silence or its end.
fn feed(stdin: ChildStdin, inputs: &Inputs, decimal: bool) {
    let mut out = BufWriter::new(stdin);
    for i in 0..inputs.len() {
        if writeln!(out, "{}", wire::line(&inputs.get(i).input, decimal)).is_err() {
            return;
        }
    }
    let _ = out.flush();
}
