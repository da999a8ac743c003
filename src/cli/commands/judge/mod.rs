//! Judging answers in a file against the inputs they belong to.

pub mod published;
mod trajectory;

use crate::cli::args::{AuditFormat, JudgeArgs, WhereArgs};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::bounded::Bounded;
use crate::cli::files::output::Output;
use crate::cli::lookup;
use crate::cli::number::LONGEST;
use crate::cli::process::answers::{AnswerLines, Answers, End, Form};
use crate::cli::process::candidate::{BATCH, judge_batch};
use crate::cli::process::wire::{Line, Lines};
use crate::cli::progress::Progress;
use crate::cli::report::{self, ReportExtras};
use crate::cli::workload::{Selection, Workload, reproduce_command};
use mechaudit::audit::{
    CandidateReport, Case, Layout, Method, Origin, Panel, Reproduce, Settings, SolverAnswer,
    judge_case,
};
use mechaudit::study::is_path;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// Judges them.
pub fn judge(args: &JudgeArgs) -> Result<Outcome, Failure> {
    if let Some(path) = args.table.as_ref().filter(|_| is_path(&args.method)) {
        let study = lookup::study(&args.method)?;
        if study.problem().initial_value.is_some() {
            let study = study.with_time_as_input().map_err(Failure::caused)?;
            return trajectory::judge(&study, path, args);
        }
    }
    let method = lookup::method(&args.method)?;
    if let Some(path) = &args.table {
        return published::judge(&*method, path, args);
    }
    let (Some(inputs_path), Some(values_path)) = (&args.inputs, &args.values) else {
        return Err(Failure::new(
            "--inputs and --values, or --table, are needed",
        ));
    };
    if [inputs_path, values_path].map(|p| p.as_path()) == [Path::new("-"); 2] {
        return Err(Failure::new(
            "--inputs and --values cannot both be standard input: name a file for one of them",
        ));
    }
    let output = Output::open(args.output.as_deref())?;
    let place = WhereArgs::default();
    let selection = Selection::new(&place, &args.scope);
    let settings = Settings {
        points: match args.format {
            AuditFormat::Html => report::POINTS,
            _ => 0,
        },
        ..Settings::default()
    };
    let workload = Workload::of_one(&*method, selection, settings)?;
    let (method, settings) = (&workload.methods[0], &workload.settings);
    let mut inputs = Inputs::open(method, inputs_path)?;
    let total = count(inputs_path);
    let mut values = Answers::of(reader(values_path)?, Form::Lines, AnswerLines::of(method));
    let unreadable = |e| Failure::cannot("read", values_path, e);
    let panel = Panel::new(method, settings);
    let mut next = || match values.next(None) {
        Err(End::Unreadable(e)) => Err(unreadable(e)),
        next => Ok(next),
    };
    let Judged {
        answered,
        open,
        interrupted,
    } = judged(&mut inputs, (args.line, total), &panel, &mut next)?;
    let mut tally = panel.into_tally();
    if interrupted {
        tally.interrupt();
    }
    let mut trouble = None;
    if tally.is_interrupted() {
        trouble = Some(format!("Interrupted after {answered} answers."));
    } else if let Some(case) = open {
        let why = format!("the values end after {answered} answers");
        let answer = SolverAnswer::Unanswered(why.clone());
        tally.add(&judge_case(method, case, answer, settings));
        let mut left = 1;
        while let Some(left_over) = inputs.read()? {
            tally.unanswered(left_over.region, 1);
            left += 1;
        }
        trouble = Some(format!("{why}; {left} inputs are left"));
    } else {
        match next()? {
            Ok(_) => {
                trouble = Some(format!("there are more values than the {answered} inputs"));
            }
            Err(End::Interrupted) => tally.interrupt(),
            Err(_) => {}
        }
    }
    let mut report = tally.finish(method);
    if report.cases == 0 && !report.interrupted {
        let what = args
            .line
            .map_or("no inputs".into(), |n| format!("no input on line {n}"));
        return Err(Failure::new(format!("{}: {what}", inputs_path.display())));
    }
    let header = values.header();
    let name = format!("answers in {}", values_path.display());
    report.candidate = Some(CandidateReport {
        name: header.name.unwrap_or(name),
        version: header.version,
        command: None,
        answered,
        trouble,
    });
    let file = |path: &Path| shell_words::quote(&path.to_string_lossy()).into_owned();
    report.reproduce = Reproduce {
        head: format!(
            "mechaudit judge {} --inputs {} --values {} ",
            shell_words::quote(method.name()),
            file(inputs_path),
            file(values_path)
        ),
        tail: reproduce_command(None, selection),
    };
    report::write(&[report], args.format, output, &ReportExtras::default())
}

/// The progress of judging.
#[derive(Default)]
struct Judged {
    answered: u64,
    /// The first input without an answer.
    open: Option<Case>,
    /// True if the user asked to stop.
    interrupted: bool,
}

/// Judges answers as long as there are some: of all inputs or that on a line, of `total` if that is
/// known.
fn judged(
    inputs: &mut Inputs,
    (line, total): (Option<u64>, Option<u64>),
    panel: &Panel,
    next: &mut dyn FnMut() -> Result<Result<SolverAnswer, End>, Failure>,
) -> Result<Judged, Failure> {
    let progress = Progress::new();
    let mut judged = Judged::default();
    let mut batch = Vec::new();
    while let Some(case) = inputs.read()? {
        let answer = match next()? {
            Ok(answer) => answer,
            Err(End::Interrupted) => {
                judged.interrupted = true;
                break;
            }
            Err(_) => {
                judged.open = Some(case);
                break;
            }
        };
        judged.answered += 1;
        let wanted = |n: u64| matches!(case.origin, Origin::Line { number } if number == n);
        if line.is_none_or(wanted) {
            batch.push((case, answer));
        }
        if batch.len() == BATCH {
            judged.interrupted = !judge_batch(panel, BATCH, &|some| batch[some].to_vec());
            batch.clear();
            let done = judged.answered;
            progress.show(inputs.method, done, total.unwrap_or(done));
        }
        if judged.interrupted {
            break;
        }
    }
    judged.interrupted |= !judge_batch(panel, batch.len(), &|some| batch[some].to_vec());
    Ok(judged)
}

/// Inputs of a file, for the progress; nothing is known of a pipe.
fn count(path: &Path) -> Option<u64> {
    if !path.metadata().ok()?.is_file() {
        return None;
    }
    let mut lines = Lines::new(reader(path).ok()?);
    let mut inputs = 0;
    while let Some(line) = lines.read().ok()? {
        inputs += u64::from(!line.is_blank());
    }
    Some(inputs)
}

fn reader(path: &Path) -> Result<Box<dyn BufRead + Send>, Failure> {
    let input: Box<dyn Read + Send> = match path == Path::new("-") {
        true => Box::new(std::io::stdin()),
        false => Box::new(File::open(path).map_err(|e| Failure::cannot("read", path, e))?),
    };
    // A line that is too long costs its own case; one without an end would cost all time.
    let bounded = Bounded::new(input, 64 * LONGEST, usize::MAX);
    Ok(Box::new(BufReader::new(bounded)))
}

/// The cases in a file of inputs.
struct Inputs {
    lines: Lines<Box<dyn BufRead + Send>>,
    path: PathBuf,
    method: &'static str,
    layout: Layout,
    regions: Vec<&'static str>,
    region: &'static str,
}

impl Inputs {
    fn open(method: &dyn Method, path: &Path) -> Result<Inputs, Failure> {
        let regions = method.domain().regions;
        Ok(Inputs {
            lines: Lines::new(reader(path)?),
            path: path.into(),
            method: method.name(),
            layout: Layout::new(method),
            regions: regions.iter().map(|r| r.name).collect(),
            region: "given",
        })
    }

    fn read(&mut self) -> Result<Option<Case>, Failure> {
        loop {
            let read = self.lines.read_any();
            let read = read.map_err(|e| Failure::cannot("read", &self.path, e))?;
            let Some(line) = read else { return Ok(None) };
            if let Some(comment) = line.comment() {
                self.region(comment);
            } else if !line.is_blank() {
                return self.case(&line).map(Some);
            }
        }
    }

    /// A comment that names a region is about the lines after it.
    fn region(&mut self, comment: &str) {
        let Some(named) = comment.strip_prefix("region ") else {
            return;
        };
        let name = named.split([' ', ':']).next().unwrap_or_default();
        let known = self.regions.iter().find(|r| **r == name);
        self.region = match name {
            "check-points" => "check-points",
            "hard" => "hard",
            _ => known.copied().unwrap_or("given"),
        };
    }

    fn case(&self, line: &Line) -> Result<Case, Failure> {
        let input = line.input()?;
        self.layout
            .lengths(&input)
            .map_err(|e| Failure::caused(e).about(format!("inputs, line {}", line.number)))?;
        Ok(Case {
            method: self.method,
            region: self.region,
            input,
            origin: Origin::Line {
                number: line.number,
            },
        })
    }
}

#[cfg(test)]
mod tests;
