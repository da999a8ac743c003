//! Arguments of `mechaudit paper`.

use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit paper zinchenko
  mechaudit paper zinchenko --format html --output zinchenko.html
  mechaudit paper zinchenko --format csv | head
  mechaudit paper andrews
  mechaudit paper n-four-bar
  mechaudit paper pmksweb
  mechaudit paper gembara-senyk --ledger
  mechaudit paper gembara-senyk --ledger --format html --output ledger.html";

/// Arguments of `paper`.
#[derive(ClapArgs, Debug)]
pub struct PaperArgs {
    /// The paper's key, see `mechaudit list`
    pub key: String,
    /// Show every formula with its proof, its refutation or its smallest repair
    #[arg(long)]
    pub ledger: bool,
    /// Compare the ledger with the file instead of writing it; exit code 1 if they differ
    #[arg(long, requires_all = ["ledger", "output"])]
    pub check: bool,
    /// Form of the report
    #[arg(long, value_enum, default_value = "text")]
    pub format: PaperFormat,
    /// Write atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// The forms of a paper's report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PaperFormat {
    /// Findings and tallies for people
    Text,
    /// Everything
    Json,
    /// One line for each printed entry and variant of the data
    Csv,
    /// One page without outside parts
    Html,
    /// The ledger as a LaTeX document
    Latex,
    /// The errata of the ledger, as JSON
    Errata,
}
