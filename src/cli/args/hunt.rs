//! Arguments of `mechaudit hunt`.

use super::audit::ExecArgs;
use super::number;
use clap::Args as ClapArgs;
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit hunt four-bar --evals 20000 --seed 3
  mechaudit hunt faddeeva --evals 100000 --hard found
  mechaudit hunt study.toml --exec './candidate'

A third of the evaluations go to seeds: check points, earlier hard cases, random inputs of every \
region, inputs between those, inputs with few significant bits, and neighbours of such. The others \
climb from the worst seeds by changing some bits or one coordinate, each within a factor of four of \
its seed.

With --hard an input that takes up more of an output's budget than any recorded one is added to \
METHOD.csv in that folder, with its share of the budget and how it was found; nothing is ever taken \
away. Without it nothing is written. `mechaudit audit METHOD --hard DIR` judges all of them; those \
that are built in are judged by every audit. Hunts may add to the same folder at the same time. \
An audit expects the recorded share of a hard case again, so that a folder belongs to one solver or \
program.

With --exec the program is started for each batch of inputs, a few dozen times or more, and speaks as in \
an audit. A crash, a wrong exit status or a silence ends the hunt, with the first input that was not \
answered, and is a finding.

Exit codes: 0, nothing over budget but what was recorded; 1, a finding; 2, bad usage or input; 130, \
ended by Ctrl-C, what was found until then is reported and recorded.";

/// Arguments of `hunt`.
#[derive(ClapArgs, Debug)]
pub struct HuntArgs {
    /// The method
    pub method: String,
    /// Number of evaluations of solver and reference
    #[arg(long, value_name = "N", default_value = "10000", value_parser = number::counting::<u64>())]
    pub evals: u64,
    /// Seed of the random stream
    #[arg(long, value_name = "SEED", default_value = "1", value_parser = number::whole)]
    pub seed: u64,
    /// Climb from the hard cases in this folder and add worse inputs; without it climb from the
    /// built-in ones and add nothing
    #[arg(long, value_name = "DIR")]
    pub hard: Option<PathBuf>,
    /// Hunt with this solver of a study's file instead of the first
    #[arg(long, value_name = "NAME", conflicts_with = "exec")]
    pub solver: Option<String>,
    #[command(flatten)]
    pub program: ExecArgs,
}
