//! Arguments of `mechaudit atlas`.

use super::number;
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit atlas                              every algorithm, every claim
  mechaudit atlas --only humlicek-1982 weideman-1994-32
  mechaudit atlas --only weideman-1994-32 --at 6,0
  mechaudit atlas --only tran-ngo-hartmann-2013 --at 0.01,0.02,0.002,0,0,0,0,0.03
  mechaudit atlas --libraries                  with scipy, libcerf and others that are installed
  mechaudit atlas --exec ./w --only zaghloul-ali-2011
  mechaudit atlas --format html --output atlas.html
  mechaudit atlas --cases 20 --no-speed --format csv --table claims

Errors are relative and upper bounds; worst is the worst found, never a bound. A claim holds as far as searched: an \
audit of its domain and a hunt found nothing against it. It is refuted by the point that is named. Seams: the largest \
jump of Re w between neighbouring floats where an algorithm changes its formula; of programs, whose formulas are not \
known, where their error changes most. Heights: the power of ten from which \
Im z on no larger error was found. Times are of one run on one core, each code in turn.

Exit codes: 0, whatever became of the claims; 2, bad usage or input; 130, ended by Ctrl-C.";

/// Arguments of `atlas`.
#[derive(ClapArgs, Debug)]
pub struct AtlasArgs {
    /// Only these algorithms and the claims about them
    #[arg(long, value_name = "NAME", num_args = 1..)]
    pub only: Vec<String>,
    /// Show the algorithms at this point beside the certified value, and nothing else; the
    /// Hartmann-Tran profile at a line of eight numbers,
    /// Gamma_D,Gamma_0,Gamma_2,Delta_0,Delta_2,nu_VC,eta,detuning
    #[arg(long, value_name = "RE,IM", allow_hyphen_values = true)]
    pub at: Option<String>,
    /// Add the libraries of the built-in list that are installed
    #[arg(long)]
    pub libraries: bool,
    /// Add a program that speaks the protocol of `faddeeva`; may be given several times
    #[arg(long, value_name = "COMMAND")]
    pub exec: Vec<String>,
    /// Points in each region, up to a million; searches are multiples of it [default: 200]
    #[arg(long, value_name = "N", value_parser = number::within::<u64>(1..=1_000_000))]
    pub cases: Option<u64>,
    /// Key of the random stream [default: 1]
    #[arg(long, value_name = "SEED", value_parser = number::whole)]
    pub seed: Option<u64>,
    /// Do not measure speed
    #[arg(long)]
    pub no_speed: bool,
    /// Form of the report
    #[arg(long, value_enum, default_value = "text")]
    pub format: AtlasFormat,
    /// Which table, in CSV
    #[arg(long, value_enum, default_value = "rows")]
    pub table: AtlasTable,
    /// Write atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// The forms of the atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AtlasFormat {
    /// For people
    Text,
    /// For programs
    Json,
    /// One line for each row of a table
    Csv,
    /// A page with error maps and a diagram of work and precision
    Html,
}

/// The tables of the atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AtlasTable {
    /// A line for each code and region
    Rows,
    /// A line for each claim
    Claims,
}
