//! Arguments of `mechaudit compare`.

use super::{ProgramArgs, RunArgs, ScopeArgs, WhereArgs};
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit compare faddeeva --exec 'python3 scipy_w.py' --exec ./cerf_w --with ours
  mechaudit compare erfc --exec ./old --exec ./new --ordinary --relative 1e-12 --format csv
  mechaudit compare faddeeva --exec ./w --baseline old.json

All programs get the same cases, and those of a case are judged by one reference. For each region: cases \
that fail, the largest share of a budget, how many times that of the best (marked *: the fewest answers \
of the wrong kind, then the smallest share). Speed is the time of a run of many inputs less that of a run \
of one, divided by their number: start-up apart, the protocol included. The method's own solver is \
called in this process.

The exit code is 1 if one of them is over budget.";

/// Arguments of `compare`.
#[derive(ClapArgs, Debug)]
pub struct CompareArgs {
    /// The method
    pub method: String,
    /// A program; may be given several times
    #[arg(long, value_name = "COMMAND", required = true)]
    pub exec: Vec<String>,
    /// Compare with the method's own solver, too
    #[arg(long, value_enum, value_name = "WHAT")]
    pub with: Option<With>,
    #[command(flatten)]
    pub program: ProgramArgs,
    #[command(flatten)]
    pub run: RunArgs,
    #[command(flatten)]
    pub place: WhereArgs,
    #[command(flatten)]
    pub scope: ScopeArgs,
    /// Do not measure speed
    #[arg(long)]
    pub no_speed: bool,
    /// Show the changes since this report of `compare` or `audit` in JSON
    #[arg(long, value_name = "FILE")]
    pub baseline: Option<PathBuf>,
    /// Form of the report
    #[arg(long, value_enum, default_value = "text")]
    pub format: CompareFormat,
    /// Write atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// The code compared in addition to programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum With {
    /// The method's own solver
    Ours,
}

/// The forms of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CompareFormat {
    /// For people
    Text,
    /// Everything, as schema/compare.schema.json describes it
    Json,
    /// A line for each region and candidate
    Csv,
    /// A page to be opened in a browser
    Html,
}
