//! Arguments of `mechaudit audit`, and what `judge` shares with it.

use super::RunArgs;
use super::number::{self, Refused};
use super::scope::{Numbers, ScopeArgs, WhereArgs, numbers};
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;
use std::time::Duration;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit audit                              every method
  mechaudit audit four-bar --cases 1000        one method, 1000 cases in each region
  mechaudit audit four-bar --region NAME --seed 1 --case 17
  mechaudit audit four-bar --check-point NAME --format json
  mechaudit audit faddeeva --at 1.5,-0x1p-2    one input
  mechaudit audit erfc --hard my-hard-cases    what a hunt has recorded there
  mechaudit audit study.toml --solver stable   a problem of your own
  mechaudit audit cores/*.fpcore --format json many at once
  mechaudit audit --format html --output audit.html
  mechaudit audit --format junit --output audit.xml
  mechaudit audit erfc --maps --format json    errors over the complex plane
  mechaudit audit faddeeva --exec ./candidate  a program in any language
  mechaudit audit faddeeva --exec 'python3 w.py' --cases 1000 --timeout 5 --ulps 100
  mechaudit audit faddeeva --exec ./w --ordinary --relative 1e-12 --format html --output w.html
  mechaudit audit faddeeva --exec ./w --box 'Re z=0..8,Im z=+-log 1e-9..1' --cases 5000
  mechaudit audit faddeeva --exec ./w --near zero-4 --radius 1e-3
  mechaudit audit erfc --exec ./erfcf --single --region small --region mid --format csv

With --exec the program reads inputs and writes answers, one a line, see mechaudit points \
--help. It gets all inputs without waiting for its answers. A line that cannot be read fails its \
own case; after a crash, a wrong exit status, a silence of --timeout seconds or the end of the \
--run-timeout seconds for all its answers the inputs left fail as unanswered, and what is judged \
stays judged.

Ctrl-C ends an audit with a report of what is judged until then and exit code 130; see mechaudit \
--help for the others.";

/// Arguments of `audit`.
#[derive(ClapArgs, Debug)]
pub struct AuditArgs {
    /// The methods, or files of studies (.toml, .fpcore); all methods if left out
    pub method: Vec<String>,
    /// Audit this solver of a study's file instead of the first
    #[arg(
        long,
        value_name = "NAME",
        requires = "method",
        conflicts_with = "exec"
    )]
    pub solver: Option<String>,
    #[command(flatten)]
    pub place: WhereArgs,
    /// Only this input, its numbers separated by commas
    #[arg(long, value_name = "NUMBERS", requires = "method", allow_hyphen_values = true, value_parser = numbers, conflicts_with_all = ["region", "case", "check_point", "hard_case", "sides", "near"])]
    pub at: Option<Numbers>,
    #[command(flatten)]
    pub run: RunArgs,
    /// Form of the report
    #[arg(long, value_enum, default_value = "text")]
    pub format: AuditFormat,
    /// Judge a grid of the complex plane, too, for functions of a complex variable; a page always
    /// has it
    #[arg(long, conflicts_with_all = ["case", "check_point", "hard_case", "at", "exec"])]
    pub maps: bool,
    /// Write atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Show the changes since this report of `audit` in JSON
    #[arg(long, value_name = "FILE", requires = "method")]
    pub baseline: Option<PathBuf>,
    #[command(flatten)]
    pub program: ExecArgs,
    #[command(flatten)]
    pub scope: ScopeArgs,
}

/// A program in place of a method's solver.
#[derive(ClapArgs, Clone, Debug)]
pub struct ExecArgs {
    /// Audit this program in place of the method's solver
    #[arg(long, value_name = "COMMAND", requires = "method")]
    pub exec: Option<String>,
    #[command(flatten)]
    pub program: ProgramArgs,
}

/// The protocol between the audit and a program.
#[derive(ClapArgs, Clone, Debug)]
pub struct ProgramArgs {
    /// Seconds without an answer after which the program is ended
    #[arg(long, value_name = "S", default_value = "60", value_parser = seconds, requires = "exec")]
    pub timeout: Duration,
    /// Seconds after which the program is ended, however much it has answered
    #[arg(long, value_name = "S", default_value = "3600", value_parser = seconds, requires = "exec")]
    pub run_timeout: Duration,
    /// Write inputs as decimals instead of hexadecimal floats
    #[arg(long, requires = "exec")]
    pub decimal: bool,
    /// Use binary frames of 64-bit words instead of lines; the program finds
    /// MECHAUDIT_PROTOCOL=binary in its environment
    #[arg(long, requires = "exec", conflicts_with = "decimal")]
    pub binary: bool,
}

fn seconds(text: &str) -> Result<Duration, Refused> {
    let seconds = number::positive(text).ok();
    let duration = seconds.and_then(|x| Duration::try_from_secs_f64(x).ok());
    duration.filter(|d| !d.is_zero()).ok_or(Refused::Seconds)
}

/// The forms of an audit's report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AuditFormat {
    /// For people
    Text,
    /// Everything, as schema/audit.schema.json describes it
    Json,
    /// Statistics, a line for each region and output
    Csv,
    /// JUnit XML, for build servers
    Junit,
    /// One page without outside parts
    Html,
}

#[cfg(test)]
mod tests {
    use super::seconds;
    use std::time::Duration;

    #[test]
    fn a_timeout_is_not_over_before_it_begins() {
        assert_eq!(seconds("0.25").unwrap(), Duration::from_millis(250));
        assert_eq!(seconds("1e-9").unwrap(), Duration::from_nanos(1));
        for bad in ["0", "-1", "1e-10", "1e30", "nan", "inf", "x"] {
            assert!(seconds(bad).is_err(), "{bad}");
        }
    }
}
