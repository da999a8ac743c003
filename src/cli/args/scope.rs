//! Arguments that select cases and say how strictly they are judged, shared by several commands.

use super::number;
use crate::cli::number::LineError;
use clap::Args as ClapArgs;
use std::path::PathBuf;

/// Where cases come from.
#[derive(ClapArgs, Clone, Debug, Default)]
pub struct WhereArgs {
    /// Only this region of its domain; may be given several times
    #[arg(
        long = "region",
        id = "region",
        value_name = "REGION",
        requires = "method"
    )]
    pub regions: Vec<String>,
    /// Only this case of the region, the box or the neighbourhood
    #[arg(long, value_name = "I", value_parser = number::whole)]
    pub case: Option<u64>,
    /// Only this check point
    #[arg(long, value_name = "NAME", requires = "method", conflicts_with_all = ["region", "case"])]
    pub check_point: Option<String>,
    /// The hard cases in this folder, METHOD.csv for each method, in place of those built in
    #[arg(long, value_name = "DIR", conflicts_with_all = ["region", "check_point"])]
    pub hard: Option<PathBuf>,
    /// Only this hard case, counted from 1 in its file
    #[arg(long, value_name = "N", requires = "method", conflicts_with_all = ["region", "case", "check_point"], value_parser = number::index)]
    pub hard_case: Option<usize>,
    /// Cases from a box: 'Re z=0..8,Im z=log 1e-9..1', +-log for either sign, NAME=X for one
    /// number; what it does not name is drawn from the regions
    #[arg(long = "box", value_name = "BOX", requires = "method", allow_hyphen_values = true, conflicts_with_all = ["check_point", "hard", "hard_case"])]
    pub sides: Option<String>,
    /// Cases about this one: numbers separated by commas, a check point, REGION/I or hard/N
    #[arg(long, value_name = "CASE", requires = "radius", allow_hyphen_values = true, conflicts_with_all = ["region", "check_point", "hard_case", "sides"])]
    pub near: Option<String>,
    /// Radius about it, relative to each of its numbers
    #[arg(long, value_name = "R", requires = "near", value_parser = number::positive)]
    pub radius: Option<f64>,
    /// Leave out regions, check points and hard cases at the ends of the range of floating-point
    /// numbers, beyond 1e-100 and 1e100
    #[arg(long)]
    pub ordinary: bool,
}

/// The outputs that are judged, and their limits.
#[derive(ClapArgs, Clone, Debug, Default)]
pub struct ScopeArgs {
    /// Judge only these outputs, separated by commas; answers contain no others
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub outputs: Option<Vec<String>>,
    /// Allow K ulps for every output instead of the method's budget
    #[arg(long, value_name = "K", value_parser = number::positive, conflicts_with_all = ["relative", "absolute"])]
    pub ulps: Option<f64>,
    /// Allow a relative error of R for every output instead; with --absolute the larger of the two
    #[arg(long, value_name = "R", value_parser = number::positive)]
    pub relative: Option<f64>,
    /// Allow an absolute error of A, in the output's unit, for every output instead
    #[arg(long, value_name = "A", value_parser = number::positive)]
    pub absolute: Option<f64>,
    /// Allow a norm of all errors of R times the norm of the values; alone, or with one of the
    /// others
    #[arg(long, value_name = "R", value_parser = number::positive)]
    pub normwise: Option<f64>,
    /// The code computes in single precision: inputs are f32, ulps are those of f32, answers are
    /// rounded to f32
    #[arg(long)]
    pub single: bool,
}

/// An input on the command line.
#[derive(Clone, Debug)]
pub struct Numbers(pub Vec<f64>);

pub fn numbers(text: &str) -> Result<Numbers, LineError> {
    crate::cli::number::numbers(text).map(Numbers)
}
