//! The command-line program: arguments in, reports out. Numbers come from the library.

mod args;
mod commands;
mod failure;
mod files;
mod forecast;
#[cfg(test)]
mod fuzz;
mod lookup;
mod number;
mod process;
mod progress;
mod report;
mod terminal;
mod workload;

use args::{Args, Command};
use clap::{CommandFactory, FromArgMatches};
use commands::{
    audit, campaign, chirp, compare, converge, describe, eval, hunt, identity, judge, linkage,
    motion, paper, points, prove, regenerate, runup, shell,
};
use failure::{Failure, Outcome};
use mechaudit::message;
#[cfg(unix)]
use process::guard;
use process::interrupt;
use std::process::ExitCode;

/// Runs the program and turns its outcome into an exit code: 0 as expected, 1 a finding, 2 bad
/// usage or input, 130 ended by the user. A closed pipe ends it quietly.
pub fn main() -> ExitCode {
    #[cfg(unix)]
    if guard::served() {
        return ExitCode::SUCCESS;
    }
    let parsed = grammar().try_get_matches();
    let args = match parsed.and_then(|m| Args::from_arg_matches(&m)) {
        Ok(args) => args,
        Err(e) => return usage(&e),
    };
    match run(args) {
        Ok(Outcome::AsExpected) => ExitCode::SUCCESS,
        Ok(Outcome::Finding) => ExitCode::from(1),
        Ok(Outcome::Interrupted) => ExitCode::from(interrupt::EXIT_CODE),
        Err(Failure::ClosedPipe) => ExitCode::SUCCESS,
        Err(failure) => {
            complain(&failure.to_string());
            ExitCode::from(2)
        }
    }
}

fn run(args: Args) -> Result<Outcome, Failure> {
    match args.command {
        None => audit::everything(&args.run, args.verbose),
        Some(Command::Audit(a)) => audit::methods(&a),
        Some(Command::Compare(a)) => compare::compare(&a),
        Some(Command::Describe(a)) => describe::describe(&a),
        Some(Command::Points(a)) => points::points(&a),
        Some(Command::Judge(a)) => judge::judge(&a),
        Some(Command::Hunt(a)) => hunt::hunt(&a),
        Some(Command::Identity(a)) => identity::identity(&a),
        Some(Command::Campaign(a)) => campaign::campaign(&a),
        Some(Command::Converge(a)) => converge::converge(&a),
        Some(Command::Regenerate(a)) => regenerate::regenerate(&a),
        Some(Command::Completions(a)) => shell::completions(&a),
        Some(Command::Man(a)) => shell::man(&a),
        Some(Command::List(a)) => describe::list(&a),
        Some(Command::Prove(a)) => prove::prove(&a),
        Some(Command::Paper(a)) => paper::paper(&a),
        Some(Command::Linkage(a)) => linkage::linkage(&a),
        Some(Command::Eval(a)) => eval::eval(&a),
        Some(Command::Motion(a)) => motion::motion(&a),
        Some(Command::Runup(a)) => runup::runup(&a),
        Some(Command::Chirp(a)) => chirp::chirp(&a),
    }
}

/// Runs a command without the program around it.
#[cfg(test)]
fn ran(words: &[&str]) -> Result<Outcome, Failure> {
    let words = [&["mechaudit"], words].concat();
    let read = grammar().try_get_matches_from(words);
    let args = read.and_then(|m| Args::from_arg_matches(&m));
    run(args.expect("a command"))
}

/// One line on stderr.
fn complain(text: &str) {
    use std::io::Write;
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let line = message::readable(&line);
    // Nothing can be done if stderr is closed.
    let _ = writeln!(anstream::stderr(), "mechaudit: {line}");
}

/// The arguments; a negative number is a bad value, not an option that there is not.
fn grammar() -> clap::Command {
    fn negative_numbers(command: clap::Command) -> clap::Command {
        command
            .mut_args(|a| {
                let takes = a.get_action().takes_values();
                a.allow_negative_numbers(takes)
            })
            .mut_subcommands(negative_numbers)
    }
    negative_numbers(Args::command())
}

/// Prints help or version, or a usage error as one line.
fn usage(e: &clap::Error) -> ExitCode {
    if !e.use_stderr() {
        // The same once more, with all that help shows.
        if let Err(e) = args::explained(grammar()).try_get_matches() {
            let _ = e.print();
        }
        return ExitCode::SUCCESS;
    }
    let line = in_one_line(&e.to_string());
    let grammar = Args::command();
    let command = std::env::args().skip(1).find(|a| {
        let named = |c: &clap::Command| c.get_name() == a;
        grammar.get_subcommands().any(named)
    });
    let command = command.map_or(String::new(), |c| format!(" {c}"));
    complain(&format!("{line} (see mechaudit{command} --help)"));
    ExitCode::from(2)
}

/// Returns a message without the grammar's preface and its usage.
fn in_one_line(text: &str) -> String {
    let text = text.strip_prefix("error: ").unwrap_or(text);
    let end = text.find("\n\nUsage").or_else(|| text.find("\n\nFor more"));
    let line = text[..end.unwrap_or(text.len())].trim();
    // A tip is a part of the sentence, unless it is about names that begin with a hyphen.
    match line.split_once("\n\n  tip: ") {
        Some((line, tip)) if tip.starts_with("to pass") => line.to_string(),
        Some((line, tip)) => format!("{line}; {tip}"),
        None => line.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_of_the_grammar_is_a_line() {
        for (text, due) in [
            ("error: bad\n\nUsage: mechaudit\n\nFor more, --help", "bad"),
            ("error: bad\n\nFor more, try --help.\n", "bad"),
            ("bad thing\n", "bad thing"),
            ("error: bad\n\n  tip: some\n\nUsage: x", "bad; some"),
            ("error: bad\n\n  tip: to pass '-x' as\n\nUsage: x", "bad"),
        ] {
            assert_eq!(in_one_line(text), due);
        }
    }
}
