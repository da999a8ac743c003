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
  mechaudit paper new my-paper
  mechaudit paper my-paper --check
  mechaudit paper my-paper other-paper --format html --output summary.html
  mechaudit paper reference/papers --check
  mechaudit paper gembara-senyk --ledger
  mechaudit paper gembara-senyk --ledger --format html --output ledger.html";

/// Arguments of `paper`.
#[derive(ClapArgs, Debug)]
pub struct PaperArgs {
    /// The paper's key, see `mechaudit list`; a folder with paper.toml, or a file. Several, or a
    /// folder of such folders, are summed up. `new FOLDER` writes a commented skeleton of a paper
    #[arg(value_name = "PAPER", required = true)]
    pub papers: Vec<String>,
    /// Show every formula with its proof, its refutation or its smallest repair
    #[arg(long)]
    pub ledger: bool,
    /// Print verdicts that are not those on record and nothing else; exit code 1 if there are any.
    /// With `--ledger --output FILE`: compare the ledger with the file instead of writing it
    #[arg(long)]
    pub check: bool,
    /// Run the programs that the papers name as solvers, each in its paper's folder
    #[arg(long)]
    pub exec: bool,
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
