//! Arguments of `mechaudit points`.

use super::number;
use super::scope::WhereArgs;
use clap::Args as ClapArgs;
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit points faddeeva --count 1000 --seed 7 > points.txt
  mechaudit points faddeeva --region lower --count 10 --decimal
  mechaudit points faddeeva --region lower --seed 1 --case 17
  mechaudit points study.toml --digits 25 --output values.csv
  mechaudit points study.toml --digits 25 --output values.csv --check

Lines that begin with # are comments: the layout of a line, the layout of the answer due for it, \
the regions. Every other line is one input, its fields separated by commas, each an exact \
hexadecimal float; with --decimal the shortest decimal that reads back as the same number.

An answer is one line with the values in the order of the outputs, separated by commas or \
blanks, hexadecimal or decimal (17 digits are enough), inf and nan included; or the word refuse \
where there are no values, with a reason after it or without.

With --digits the values come with the inputs: a CSV table with a column for each number of the input \
and each value, named and with its unit, for the tests of other programs and for mechaudit judge --table. \
A value is nan where it is undefined, and empty where it is undecided, which standard error tells (exit \
code 1); a comment stands for an input without values. With --check a file that differs is a finding.";

/// Arguments of `points`.
#[derive(ClapArgs, Debug)]
pub struct PointsArgs {
    /// The method
    pub method: String,
    #[command(flatten)]
    pub place: WhereArgs,
    /// Random inputs in each region
    #[arg(long, value_name = "N", default_value = "200", value_parser = number::whole)]
    pub count: u64,
    /// Seed of the random stream
    #[arg(long, value_name = "SEED", default_value = "1", value_parser = number::whole)]
    pub seed: u64,
    /// Round the numbers to single precision
    #[arg(long)]
    pub single: bool,
    /// Write decimals instead of hexadecimal floats
    #[arg(long)]
    pub decimal: bool,
    /// Write a table with that many certified digits of every value in place of lines of inputs
    #[arg(long, value_name = "N", value_parser = number::within::<u32>(1..=10_000))]
    pub digits: Option<u32>,
    /// Compare the file of --output, byte for byte, with what would be written; write nothing
    #[arg(long, requires = "output")]
    pub check: bool,
    /// Write atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}
