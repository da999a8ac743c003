//! Arguments of `mechaudit prove`.

use super::TextOrJson;
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit prove faddeeva
  mechaudit prove faddeeva --boxes boxes.csv --format json
  mechaudit prove faddeeva --within 64 --component 6
  mechaudit prove erfcx
  mechaudit prove faddeeva --part lower
  mechaudit prove faddeeva --part real --boxes intervals.csv
  mechaudit prove kernels.fpcore#doppler1 --round-inputs
  mechaudit prove study.toml --solver horner --target 2ulp
  mechaudit prove study.toml --together re,im

Runs the solver's own code over rectangles that cover the closed upper half-plane, all of it or up to --within, with \
numbers that enclose the exact value and the error of every rounding, halves a rectangle until its bounds \
are below the targets, and prints the largest that are left: the theorem. The chapter on proofs \
of the book has the model of arithmetic and every inequality.

erf, erfc, erfcx and dawson are the functions of a real argument, every finite number of either sign: intervals in \
place of rectangles, and one bound in units in the last place of the value. --part real proves all four.

A file of boxes has a line for each: the ends of Re z and Im z, both included, the formula, the \
centre of its Taylor series, the bounds; for functions of a real argument the function, the ends of x, the formula, the centre, the \
bound. faddeeva_proof.py, faddeeva_lower_proof.py and real_line_proof.py in reference/independent/ check them.

For the lower half-plane the targets are fixed; its file has the bound of the norm alone, and none where an inequality \
serves. The output says what is not proved.

A study is proved of one of its solvers: what its evaluation in binary64 or binary32 is off at most from the same \
formula over the reals, absolute, relative and in units in the last place, for every number of the format in the domain \
(with --round-inputs for every real number in it). The domain is cut into boxes until the bound is within a thousandth of \
what single points show, or --limit boxes are looked at. A relative bound exists where the value is never zero. Below each \
bound stands the box where it is attained and the largest error that a hunt of --evals evaluations finds. The last line \
says whether the solver's formula is the definition. Elementary functions are as accurate as the platform states, which is \
printed; that is no theorem. --target proves a bound or refutes it by an input. --together takes two outputs for one complex \
number: the absolute value of its error, and that as a part of its own. The file of boxes has the output, the \
measure, the bound and the ends of every input.

A target that is closer than the default may be out of reach: the proof gives up after 3e7 rectangles or intervals, \
and says before what they take at most.

Exit codes: 0, proved; 1, rectangles are left on which nothing is proved, a target is refuted or undecided; 2, bad usage, or given up; 130, ended \
by Ctrl-C, without a theorem.";

/// The part of the plane of a proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Part {
    /// The closed upper half-plane
    Upper,
    /// The open lower half-plane: the norm
    Lower,
    /// The real line: erf, erfc, erfcx and dawson, one after the other
    Real,
}

/// The functions that have a proof of their own.
const FUNCTIONS: [&str; 5] = ["faddeeva", "erf", "erfc", "erfcx", "dawson"];

fn function(text: &str) -> Result<String, String> {
    match FUNCTIONS.contains(&text) || mechaudit::study::is_path(text) {
        true => Ok(text.into()),
        false => Err(format!(
            "possible values: {}, or a study, FILE.toml, FILE.fpcore or FILE.fpcore#NAME",
            FUNCTIONS.join(", ")
        )),
    }
}

/// Arguments of `prove`.
#[derive(ClapArgs, Debug)]
pub struct ProveArgs {
    /// The function: faddeeva, erf, erfc, erfcx, dawson; or a study, FILE.toml, FILE.fpcore or
    /// FILE.fpcore#NAME
    #[arg(value_parser = function)]
    pub function: String,
    /// Prove of this solver of a study's file instead of the first
    #[arg(long, value_name = "NAME")]
    pub solver: Option<String>,
    /// Of a study: prove this bound or refute it by an input: "2ulp", "1e-12 relative" or
    /// "1e-9 absolute"
    #[arg(long, value_name = "BOUND")]
    pub target: Option<String>,
    /// Of a study: prove the error of these two outputs as one complex number, the real and the
    /// imaginary part
    #[arg(long, value_name = "RE,IM")]
    pub together: Option<String>,
    /// Of a study: take inputs for real numbers that are rounded first
    #[arg(long)]
    pub round_inputs: bool,
    /// Of a study: take every elementary function for rounded correctly, in place of the
    /// platform's accuracy
    #[arg(long)]
    pub correctly_rounded: bool,
    /// Of a study: the most boxes for each bound
    #[arg(long, value_name = "N", default_value = "20000", value_parser = super::number::counting::<u64>())]
    pub limit: u64,
    /// Of a study: evaluations of the search for the worst input, for each bound; 0 for none
    #[arg(long, value_name = "N", default_value = "2000", value_parser = super::number::whole)]
    pub evals: u64,
    /// Part of the plane; only for faddeeva
    #[arg(long, value_enum)]
    pub part: Option<Part>,
    /// Halve rectangles until the error of the norm is at most this, in units of 2^-52; faddeeva
    /// alone [default: 1.25]
    #[arg(long, value_name = "K", value_parser = super::number::bound)]
    pub norm: Option<f64>,
    /// Halve rectangles until the error of each component is at most this, in units in its last
    /// place; intervals until that of the value is [default: 4; of a real argument 0.875]
    #[arg(long, value_name = "C", value_parser = super::number::bound)]
    pub component: Option<f64>,
    /// Only where Re z and Im z are below this, for faddeeva, or every input in magnitude, for a
    /// study
    #[arg(long, value_name = "R", value_parser = super::number::positive)]
    pub within: Option<f64>,
    /// Write the rectangles to this file
    #[arg(long, value_name = "FILE")]
    pub boxes: Option<PathBuf>,
    /// Form of the report
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}
