//! Arguments of `mechaudit eval`.

use super::number;
use clap::Args as ClapArgs;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit eval --list
  echo 1.5,-0.25 | mechaudit eval faddeeva
  echo 0x1.8p+0,-0x1p-2 | mechaudit eval faddeeva --digits 50
  echo 0.1,0.3,0,0,0,1 | mechaudit eval slider-crank --digits 30 --outputs x,mu
  echo 1/3 | mechaudit eval study.toml --digits 30
  mechaudit eval faddeeva --threads 4 < cases.csv > values.csv

Input: one case a line, its numbers as `mechaudit describe NAME` lays them out, separated by commas; \
each a decimal, a C99 hexadecimal float or a quotient of decimals, without --digits also inf and nan. Blank lines and lines \
that begin with # are skipped.

Output: one line for each case, in the same order. Without --digits the floating-point solver at \
the nearest 64-bit numbers, as hexadecimal floats; with --digits the reference at exactly the \
numbers given, each value correctly rounded or its last digit off by one at most, 0 where it is \
proved to be zero, nan where it is undefined, and undecided where its digits cannot be certified. Standard \
error tells why a value is nan or undecided, where the method says it.

With MECHAUDIT_PROTOCOL=binary in its environment, as audit --binary sets it, and without --digits: \
binary frames in place of lines, by one thread, see the book's chapter on formats; refusals are \
frames too.

A line that cannot be read ends the run with its number on standard error and exit code 2; one \
of which no value can be certified, with exit code 1. Lines before it are answered, lines after \
it are not. Values that are undecided beside others do not end it: the exit code is 1.";

/// Arguments of `eval`.
#[derive(ClapArgs, Debug)]
pub struct EvalArgs {
    /// The method, see --list
    #[arg(required_unless_present = "list")]
    pub name: Option<String>,
    /// Certified decimals with this many significant digits instead of floating-point numbers
    #[arg(long, value_name = "N", value_parser = number::within::<u32>(1..=10_000))]
    pub digits: Option<u32>,
    /// These outputs only, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub outputs: Option<Vec<String>>,
    /// Threads [default: one for each core]
    #[arg(long, value_name = "T", value_parser = number::within::<usize>(1..=1024))]
    pub threads: Option<usize>,
    /// List the methods instead
    #[arg(long, conflicts_with_all = ["name", "digits", "outputs", "threads"])]
    pub list: bool,
}
