//! A program under audit: it reads inputs and writes answers, one a line.
//!
//! One thread writes all inputs, one reads answers ahead ([`Answers`]), and the answers are judged as they come; inputs are drawn anew where they are needed, so that nothing grows with
//! their number.

use super::answers::{Answers, Next};
use super::args::{AuditArgs, AuditFormat, ExecArgs, TextOrJson};
use super::audit::one_case;
use super::candidate::{BATCH, Judged, failures_kept, judge_batch, scoped};
use super::failure::{Failure, Outcome};
use super::progress::Progress;
use super::wire::{self, Line};
use mechaudit::audit::{Case, Cases, Method, Settings, SolverAnswer, Tally, judge_case};
use std::io::{BufReader, BufWriter, Write};
use std::process::{Child, ChildStdin, Command, ExitStatus, Stdio};
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

/// Audits the program as the arguments ask for.
pub fn audit(
    method: &dyn Method,
    args: &AuditArgs,
    command: &str,
    settings: &Settings,
) -> Result<Outcome, Failure> {
    let mut chosen = scoped(method, &args.scope)?.without_laws();
    let inputs = match one_case(method, args, settings)? {
        Some(case) => Inputs::One(case),
        None => {
            if let Some(region) = &args.region {
                chosen = chosen.region(region)?;
            }
            Inputs::All(Cases::new(&chosen, settings))
        }
    };
    let format = match args.format {
        AuditFormat::Text => TextOrJson::Text,
        AuditFormat::Json => TextOrJson::Json,
        _ => {
            return Err(Failure::new(
                "a program's audit is reported as text or json",
            ));
        }
    };
    let inputs = Arc::new(inputs);
    let judged = run(&chosen, settings, inputs, command, &args.program, format)?;
    let decimal = if args.program.decimal {
        " --decimal"
    } else {
        ""
    };
    let quoted = shell_words::quote(command);
    judged.write(format, &|case| {
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
    let answers = child.connect(Arc::clone(&inputs), program.decimal)?;
    let mut tally = Tally::new(method, failures_kept(format));
    let progress = Progress::new();
    let mut answered = 0;
    let end = loop {
        let mut batch = Vec::new();
        let end = collect(&answers, timeout, total - answered, &mut batch);
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
enum End {
    /// Its output has ended.
    Closed,
    /// One answer more than there are inputs.
    TooMany,
    /// Nothing came for so long.
    Silent,
    /// Its output cannot be read.
    Unreadable(String),
    /// The user has asked to stop.
    Interrupted,
}

/// Waits for an answer and takes what else is there. Every input answered, the end is waited for.
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

/// A running program; it is ended, with all it started, when this goes.
struct Program(Child);

impl Program {
    fn start(command: &str) -> Result<Program, Failure> {
        let words = shell_words::split(command)
            .map_err(|e| Failure::new(format!("--exec {command:?}: {e}")))?;
        let [program, arguments @ ..] = words.as_slice() else {
            return Err(Failure::new("--exec needs a command"));
        };
        let mut start = Command::new(program);
        start.args(arguments);
        start.stdin(Stdio::piped()).stdout(Stdio::piped());
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut start, 0);
        match start.spawn() {
            Ok(child) => Ok(Program(child)),
            Err(e) => Err(Failure::new(format!("cannot start {program:?}: {e}"))),
        }
    }

    /// Begins to write inputs to it and to read answers from it.
    fn connect(&mut self, inputs: Arc<Inputs>, decimal: bool) -> Result<Answers, Failure> {
        let (Some(stdin), Some(stdout)) = (self.0.stdin.take(), self.0.stdout.take()) else {
            return Err(Failure::new("the program has no standard input or output"));
        };
        thread::spawn(move || feed(stdin, &inputs, decimal));
        Ok(Answers::of(BufReader::new(stdout)))
    }

    /// Ends it and says what was wrong with its end, if anything was.
    fn end(&mut self, end: End, timeout: Duration) -> Option<String> {
        let seconds = timeout.as_secs_f64();
        match end {
            End::Closed => match self.wait(timeout) {
                None => Some(format!(
                    "ended its output but not itself within {seconds} s"
                )),
                Some(status) if status.success() => None,
                Some(status) => Some(format!("ended: {}", ended(status))),
            },
            End::TooMany => Some("wrote one more line than there are inputs".into()),
            End::Silent => Some(format!("wrote no line for {seconds} s and was ended")),
            End::Unreadable(why) => Some(format!("its output could not be read: {why}")),
            End::Interrupted => Some("was interrupted".into()),
        }
    }

    fn wait(&mut self, timeout: Duration) -> Option<ExitStatus> {
        let start = Instant::now();
        loop {
            match self.0.try_wait() {
                Ok(Some(status)) => return Some(status),
                _ if start.elapsed() > timeout => return None,
                _ => thread::sleep(Duration::from_millis(2)),
            }
        }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        #[cfg(unix)]
        {
            // Its group has the number of its first process, which is not waited for before.
            if let Ok(None) = self.0.try_wait()
                && let Ok(raw) = i32::try_from(self.0.id())
                && let Some(group) = rustix::process::Pid::from_raw(raw)
            {
                let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
            }
        }
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn ended(status: ExitStatus) -> String {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return format!("killed by signal {signal}");
    }
    match status.code() {
        Some(code) => format!("exit status {code}"),
        None => "for an unknown reason".into(),
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
