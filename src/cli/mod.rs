//! The command-line program: arguments in, reports out. Numbers come from the library.

mod answers;
mod args;
mod audit;
mod audit_html;
mod audit_junit;
mod audit_plots;
mod branch;
mod candidate;
mod case;
mod certified;
mod chirp;
mod chirp_file;
mod chirp_rows;
mod columns;
mod converge;
mod crank_angles;
mod dyad;
mod dyad_certified;
mod dyad_facts;
mod dyad_file;
mod dyad_values;
mod eval;
mod eval_chirp;
mod eval_functions;
mod eval_number;
mod exec;
mod failure;
mod fields;
#[cfg(test)]
mod fuzz;
mod html;
mod html_style;
mod html_text;
mod hunt;
mod interrupt;
mod judge;
mod ledger;
mod ledger_html;
mod ledger_latex;
mod ledger_text;
mod linkage;
mod linkage_columns;
mod linkage_file;
mod list;
mod output;
mod paper;
mod paper_csv;
mod points;
mod progress;
mod quantity;
mod regenerate;
mod result;
mod rows;
mod runup;
mod runup_facts;
mod runup_file;
mod runup_precision;
mod shell;
mod svg;
mod svg_chirp;
mod svg_dyad;
mod svg_mechanism;
mod svg_panel;
mod svg_reduced;
mod svg_runup;
mod svg_style;
mod table;
mod text;
mod text_method;
mod text_paper;
mod text_summary;
mod wire;

use args::{Args, Command};
use clap::Parser;
use failure::{Failure, Outcome};
use std::process::ExitCode;

/// Runs the program and turns its outcome into an exit code: 0 as expected, 1 a finding, 2 bad
/// usage or input, 130 ended by the user. A closed pipe ends it quietly.
pub fn main() -> ExitCode {
    let args = match Args::try_parse() {
        Ok(args) => args,
        Err(e) => return usage(&e),
    };
    match run(args) {
        Ok(Outcome::AsExpected) => ExitCode::SUCCESS,
        Ok(Outcome::Finding) => ExitCode::from(1),
        Ok(Outcome::Interrupted) => ExitCode::from(interrupt::EXIT_CODE),
        Err(Failure::ClosedPipe) => ExitCode::SUCCESS,
        Err(Failure::Message(text)) => {
            complain(&text);
            ExitCode::from(2)
        }
    }
}

fn run(args: Args) -> Result<Outcome, Failure> {
    match args.command {
        None => audit::everything(&args.run, args.verbose),
        Some(Command::Audit(a)) => audit::methods(&a),
        Some(Command::Points(a)) => points::points(&a),
        Some(Command::Judge(a)) => judge::judge(&a),
        Some(Command::Hunt(a)) => hunt::hunt(&a),
        Some(Command::Converge(a)) => converge::converge(&a),
        Some(Command::Regenerate(a)) => regenerate::regenerate(&a),
        Some(Command::Completions(a)) => shell::completions(&a),
        Some(Command::Man(a)) => shell::man(&a),
        Some(Command::List(a)) => list::list(&a),
        Some(Command::Paper(a)) => paper::paper(&a),
        Some(Command::Linkage(a)) => linkage::linkage(&a),
        Some(Command::Eval(a)) => eval::eval(&a),
        Some(Command::Runup(a)) => runup::runup(&a),
        Some(Command::Chirp(a)) => chirp::chirp(&a),
    }
}

/// One line on stderr.
fn complain(text: &str) {
    use std::io::Write;
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    // Nothing can be done if stderr is closed.
    let _ = writeln!(anstream::stderr(), "mechaudit: {line}");
}

/// Help and version as asked for; a usage error as one line.
fn usage(e: &clap::Error) -> ExitCode {
    if !e.use_stderr() {
        let _ = e.print();
        return ExitCode::SUCCESS;
    }
    let text = e.to_string();
    let text = text.strip_prefix("error: ").unwrap_or(&text);
    let end = text.find("\n\nUsage").or_else(|| text.find("\n\nFor more"));
    let line = text[..end.unwrap_or(text.len())].trim();
    complain(&format!("{line} (see mechaudit --help)"));
    ExitCode::from(2)
}
