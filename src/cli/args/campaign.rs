//! Arguments of `mechaudit campaign`.

use super::{TextOrJson, number};
use clap::{Args as ClapArgs, Subcommand};
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit campaign plan examples/campaign.toml --shards 16 --output target/campaign
  mechaudit campaign run target/campaign
  mechaudit campaign status target/campaign
  mechaudit campaign merge target/campaign > campaign.json
  mechaudit campaign report target/campaign --output campaign.html

A method may be the file of a study, by a path from the working directory of `plan`; its text is part \
of the campaign's identity, so that no shard is run after a change of it. \
A shard is a function of the plan and its number, and a file. `run` does the shards that are missing, on \
this machine, as often and in as many processes as it is called; what ends it loses the shard under way \
and nothing else. The merged JSON is the same, byte for byte, however many shards, processes and machines \
there were.

Exit codes: 0, done, or all as expected; 1, a finding (merge, report), shards missing (status); 2, bad usage \
or input, a shard that cannot be done or written; 130, ended by Ctrl-C.";

/// Arguments of `campaign`.
#[derive(ClapArgs, Debug)]
pub struct CampaignArgs {
    #[command(subcommand)]
    pub step: CampaignStep,
}

/// The steps of a campaign.
#[derive(Debug, Subcommand)]
pub enum CampaignStep {
    /// Cut a plan into shards and create the campaign's folder
    Plan(PlanArgs),
    /// Run the missing shards
    Run(CampaignRunArgs),
    /// Show which shards are done
    Status(StatusArgs),
    /// Add up all shards: JSON on standard output
    Merge(MergeArgs),
    /// Write one HTML page of the results so far
    Report(CampaignReportArgs),
}

/// Arguments of `campaign plan`.
#[derive(ClapArgs, Debug)]
pub struct PlanArgs {
    /// The plan: TOML or JSON, - for standard input
    pub file: PathBuf,
    /// Number of shards
    #[arg(long, value_name = "N", default_value = "64", value_parser = number::within::<u64>(1..=1_000_000))]
    pub shards: u64,
    /// The campaign's folder, made if missing
    #[arg(long, value_name = "DIR")]
    pub output: PathBuf,
}

/// Arguments of `campaign run`.
#[derive(ClapArgs, Debug)]
pub struct CampaignRunArgs {
    /// The campaign's folder
    pub folder: PathBuf,
    /// Only this shard, counted from 0, or those from K to L as K-L; may be given several times
    #[arg(long = "shard", value_name = "K", value_parser = shards)]
    pub shards: Vec<(u64, u64)>,
    /// Threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = number::within::<usize>(1..=1024))]
    pub jobs: Option<usize>,
}

/// Arguments of `campaign status`.
#[derive(ClapArgs, Debug)]
pub struct StatusArgs {
    /// The campaign's folder
    pub folder: PathBuf,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
    /// Print the numbers of the shards that are not done instead, one a line
    #[arg(long, conflicts_with = "format")]
    pub missing: bool,
}

/// Arguments of `campaign merge`.
#[derive(ClapArgs, Debug)]
pub struct MergeArgs {
    /// The campaign's folder
    pub folder: PathBuf,
    /// Add inputs worse than any recorded to METHOD.csv in this folder of hard cases, as hunts do
    #[arg(long, value_name = "DIR")]
    pub hard: Option<PathBuf>,
    /// Write atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// Arguments of `campaign report`.
#[derive(ClapArgs, Debug)]
pub struct CampaignReportArgs {
    /// The campaign's folder
    pub folder: PathBuf,
    /// Write atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

fn shards(text: &str) -> Result<(u64, u64), number::Refused> {
    let (from, to) = text.split_once('-').unwrap_or((text, text));
    let (from, to) = (number::whole(from)?, number::whole(to)?);
    match from <= to {
        true => Ok((from, to)),
        false => Err(number::Refused::Whole(from)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_one_or_from_one_to_another() {
        for (text, due) in [
            ("3", (3, 3)),
            ("2-5", (2, 5)),
            ("4-4", (4, 4)),
            ("0", (0, 0)),
        ] {
            assert_eq!(shards(text), Ok(due), "{text}");
        }
        assert_eq!(shards("5-2"), Err(number::Refused::Whole(5)));
        for text in ["", "x", "2-", "-2", "1-2-3"] {
            assert_eq!(shards(text), Err(number::Refused::Whole(0)), "{text}");
        }
    }
}
