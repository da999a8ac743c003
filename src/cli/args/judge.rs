//! Arguments of `mechaudit judge`.

use super::{AuditFormat, ScopeArgs, number};
use clap::Args as ClapArgs;
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit points faddeeva --count 1000 > points.txt
  ./candidate < points.txt > values.txt
  mechaudit judge faddeeva --inputs points.txt --values values.txt
  ./candidate < points.txt | mechaudit judge faddeeva --inputs points.txt --values -
  mechaudit judge faddeeva --inputs points.txt --values values.txt --line 17
  mechaudit judge faddeeva --table published.csv
  mechaudit judge faddeeva --table published.csv --format csv
  mechaudit judge examples/studies/motion/lorenz.toml --table simulation.csv

Answers are matched with inputs in their order; comments (#) are skipped in both files. An \
answer that cannot be read is judged as one, and those after it still count. See mechaudit \
points --help for what an answer looks like.

A table begins with a line of names, those of the inputs and of outputs (see mechaudit \
describe METHOD), in any order, with their unit in brackets or without: phi1 [rad]. Values in another unit \
of the same, as phi2 [deg] or x [mm], are judged in it; an input in degrees is refused, for it is no \
exact number of radians. Vectors and rows are counted from 0: diagonal[0], S[1]. Without a column \
Im z the inputs are real, and x and erf are short for Re z and Re erf. Inputs are taken exactly as \
printed; outputs are printed decimals, an empty field none, and NaN and infinities entries like \
others. An entry agrees if the reference is certainly within half a unit of its last digit: 1.2e4 \
has units of 1000. The reference is shown to as many digits as the entry has, and 20 at least.

Where METHOD is a study with [ode], the table is that of a simulation: the time and what else is an input in \
columns of their names, then states and outputs, some or all. Every entry is judged by the budget of its \
output; the report has the largest error of each column, the time of it and the digits that are \
right, csv has all rows, and html draws the errors over time.

Limits: a line has 1 MiB and 100000 fields at most, a table 64 MiB, a field of one 1000 bytes.

Exit codes: 0, every answer within its budget or entry in agreement; 1, an answer or entry that \
is not, or not there, or one too many; 2, bad usage or an input that cannot be read; 130, \
ended by Ctrl-C.";

/// Arguments of `judge`.
#[derive(ClapArgs, Debug)]
pub struct JudgeArgs {
    /// The method
    pub method: String,
    /// The inputs, as `mechaudit points` writes them; `-` reads standard input
    #[arg(
        long,
        value_name = "FILE",
        requires = "values",
        required_unless_present = "table"
    )]
    pub inputs: Option<PathBuf>,
    /// The answers; `-` reads standard input
    #[arg(long, value_name = "FILE", requires = "inputs")]
    pub values: Option<PathBuf>,
    /// Only the input on this line of its file, or the row of the table, with everything that is
    /// known of it
    #[arg(long, value_name = "N", value_parser = number::whole)]
    pub line: Option<u64>,
    /// A published table in CSV: inputs and printed decimals; `-` reads standard input
    #[arg(long, value_name = "FILE", conflicts_with_all = ["inputs", "values", "outputs", "ulps", "relative", "absolute", "normwise", "single"])]
    pub table: Option<PathBuf>,
    #[command(flatten)]
    pub scope: ScopeArgs,
    /// Form of the report
    #[arg(long, value_enum, default_value = "text")]
    pub format: AuditFormat,
    /// Write atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}
