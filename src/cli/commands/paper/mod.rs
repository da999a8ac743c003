//! One paper's report in the form asked for.

mod check;
mod ledger;
mod new;
mod programs;

use crate::cli::args::{PaperArgs, PaperFormat};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::progress::Progress;
use crate::cli::{complain, terminal};
use mechaudit::papers::file::Programs;
use mechaudit::papers::{self, PaperFile};
use mechaudit::report::{csv, html, text};
use programs::Runner;
use std::path::Path;

/// No paper of that key.
pub fn unknown(key: &str) -> Failure {
    Failure::no_such("paper", key, &papers::keys())
}

/// Audits the paper and writes its report.
pub fn paper(args: &PaperArgs) -> Result<Outcome, Failure> {
    match args.papers.as_slice() {
        [word, folder] if word == "new" => return new::write(Path::new(folder)),
        [word, ..] if word == "new" => {
            return Err(Failure::new(
                "paper new needs one folder: mechaudit paper new FOLDER",
            ));
        }
        _ => {}
    }
    let mut papers: Vec<(String, PaperFile)> = Vec::new();
    for text in &args.papers {
        let found = papers::open_all(text).map_err(Failure::caused)?;
        if found.is_empty() {
            return Err(unknown(text));
        }
        papers.extend(found);
    }
    let by: Option<&'static dyn Programs> = match args.exec {
        true => Some(&Runner),
        false => None,
    };
    for (_, paper) in &papers {
        paper.run_by(by).map_err(Failure::caused)?;
    }
    if args.check && !args.ledger {
        if args.output.is_some() {
            return Err(Failure::new(
                "--check compares a file with the ledger: add --ledger",
            ));
        }
        let all = papers.iter().map(|(text, paper)| check::check(paper, text));
        let all = all.collect::<Result<Vec<Outcome>, Failure>>()?;
        return Ok(Outcome::of(all.iter().all(|o| *o == Outcome::AsExpected)));
    }
    if args.ledger {
        return match papers.as_slice() {
            [(_, paper)] => ledger::ledger(args, paper),
            _ => Err(Failure::new("--ledger is for one paper at a time")),
        };
    }
    if matches!(args.format, PaperFormat::Latex | PaperFormat::Errata) {
        return Err(Failure::new("this form is one of the ledger: add --ledger"));
    }
    let output = Output::open(args.output.as_deref())?;
    let progress = Progress::new();
    let show = |phase: &str, done, total| progress.show(phase, done, total);
    let (report, motion) = match papers.as_slice() {
        [(_, paper)] => {
            let motion = paper.analysis.and_then(papers::motion_of);
            (paper.report(&show), motion)
        }
        _ => {
            let all = papers.into_iter().map(|(_, paper)| paper).collect();
            (papers::summary(all, &show), None)
        }
    };
    progress.clear();
    let report = match report {
        Ok(report) => report,
        Err(e) => {
            complain(&format!("paper {}: {e}", args.papers.join(" ")));
            return Ok(Outcome::Finding);
        }
    };
    let width = match output.is_standard() {
        true => terminal::width(),
        false => 100,
    };
    output.write(|out| match args.format {
        PaperFormat::Text => Ok(write!(out, "{}", text::paper::paper(&report, width))?),
        PaperFormat::Json => {
            serde_json::to_writer_pretty(&mut *out, &report)?;
            Ok(writeln!(out)?)
        }
        PaperFormat::Csv => Ok(csv::paper(&report, out)?),
        PaperFormat::Latex | PaperFormat::Errata => Ok(()),
        PaperFormat::Html => {
            Ok(out.write_all(html::paper::page(&report, motion.as_ref()).as_bytes())?)
        }
    })?;
    Ok(Outcome::of(report.as_recorded()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::{Args, Command};
    use crate::cli::commands::audit;
    use clap::Parser;

    /// A report in a file has 100 columns, and the forms of ledgers are for these.
    #[test]
    fn a_report_in_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("report");
        let run = |key: &str, more: &str| {
            let line = format!("mechaudit paper {key} --output {} {more}", path.display());
            match Args::parse_from(line.split_whitespace()).command {
                Some(Command::Paper(args)) => paper(&args),
                _ => unreachable!("a paper"),
            }
        };
        let mut told_apart = [false; 2];
        for key in ["pmksweb", "n-four-bar"] {
            let report = audit::paper(key, &Progress::new()).unwrap().unwrap();
            let wide = |width| {
                let text = text::paper::paper(&report, width);
                anstream::adapter::strip_str(&text).to_string()
            };
            assert_eq!(run(key, "").unwrap(), Outcome::of(report.as_recorded()));
            let due = wide(100);
            assert_eq!(std::fs::read_to_string(&path).unwrap(), due);
            let apart = [99, 101].map(|width| wide(width) != due);
            told_apart = [0, 1].map(|k| told_apart[k] || apart[k]);
        }
        assert_eq!(told_apart, [true; 2]);
        for (more, due) in [
            ("--format latex", false),
            ("--format errata", false),
            ("--format json", true),
            ("--format csv", true),
            ("--format latex --ledger", true),
        ] {
            assert_eq!(run("pmksweb", more).is_ok(), due, "{more}");
        }
        assert!(run("none", "").is_err());
    }
}
