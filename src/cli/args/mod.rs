//! The grammar of the command line.

mod atlas;
mod audit;
mod campaign;
mod chirp;
mod compare;
mod converge;
mod eval;
mod hunt;
mod identity;
mod judge;
mod linkage;
mod list;
mod number;
mod paper;
mod points;
mod prove;
mod regenerate;
mod runup;
mod scope;
mod shell;
mod units;

pub use atlas::{AtlasArgs, AtlasFormat, AtlasTable};
pub use audit::{AuditArgs, AuditFormat, ProgramArgs};
pub use campaign::{
    CampaignArgs, CampaignReportArgs, CampaignRunArgs, CampaignStep, MergeArgs, PlanArgs,
    StatusArgs,
};
pub use chirp::{ChirpArgs, ChirpRows};
pub use compare::{CompareArgs, CompareFormat, DescribeArgs};
pub use converge::ConvergeArgs;
pub use eval::EvalArgs;
pub use hunt::HuntArgs;
pub use identity::IdentityArgs;
pub use judge::JudgeArgs;
pub use linkage::{LinkageArgs, LinkageFormat};
pub use list::ListArgs;
pub use paper::{PaperArgs, PaperFormat};
pub use points::PointsArgs;
pub use prove::{Part, ProveArgs};
pub use regenerate::RegenerateArgs;
pub use runup::RunupArgs;
pub use scope::{Numbers, ScopeArgs, WhereArgs};
pub use shell::{CompletionsArgs, ManArgs};
pub use units::UnitsArgs;

use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};

const AFTER_HELP: &str = "\
Examples:
  mechaudit                                    audit every paper and every method, in brief
  mechaudit --verbose                          the same with every finding and output in full
  mechaudit --cases 1000 --seed 7              more cases from another stream
  mechaudit list                               what is audited, where and how closely
  mechaudit linkage examples/sand-screen.toml --step-deg 7.5 --format csv
  echo 1.5,-0.25 | mechaudit eval faddeeva --digits 50

Environment:
  MECHAUDIT_EFFORT   a positive number that multiplies the numbers of random cases
  NO_COLOR           no colour; output that is not a terminal never has any

Exit codes:
  0    all as expected
  1    an accuracy finding that is not a recorded one, or a digit left undecided
  2    bad usage or input
  130  ended by Ctrl-C: the report holds what was judged until then and says so; a second Ctrl-C
       ends the program at once, without a report";

/// Audits the accuracy of mechanism solvers against certified references, and published tables
/// against recomputed ones.
#[derive(Debug, Parser)]
#[command(
    name = "mechaudit",
    version,
    after_help = AFTER_HELP,
    max_term_width = 100,
    args_conflicts_with_subcommands = true
)]
pub struct Args {
    #[command(flatten)]
    pub run: RunArgs,
    /// Every finding and every method in full, below the summary
    #[arg(long, short)]
    pub verbose: bool,
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// How much to run.
#[derive(ClapArgs, Clone, Debug)]
pub struct RunArgs {
    /// Key of the random stream [default: 1]
    #[arg(long, value_name = "SEED", value_parser = number::whole)]
    pub seed: Option<u64>,
    /// Random cases in each region of a method's domain [default: 200]
    #[arg(long, value_name = "N", value_parser = number::counting::<u64>())]
    pub cases: Option<u64>,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Audit all methods or one, a region of one or a single case
    #[command(after_help = audit::AFTER_HELP)]
    Audit(AuditArgs),
    /// Judge several programs at the same cases, side by side
    #[command(after_help = compare::AFTER_HELP)]
    Compare(CompareArgs),
    /// Published algorithms for W(z) and Voigt, and what is claimed about them, beside certified values
    #[command(after_help = atlas::AFTER_HELP)]
    Atlas(AtlasArgs),
    /// Describe a method to whoever writes a candidate: inputs, outputs, budgets, domain, protocol
    #[command(after_help = compare::AFTER_DESCRIBE)]
    Describe(DescribeArgs),
    /// List the methods with their domains and budgets, and the papers
    #[command(after_help = list::AFTER_HELP)]
    List(ListArgs),
    /// Write inputs of a method, for programs in any language
    #[command(after_help = points::AFTER_HELP)]
    Points(PointsArgs),
    /// Judge answers that somebody's program gave
    #[command(after_help = judge::AFTER_HELP)]
    Judge(JudgeArgs),
    /// Search a method's domain for its worst inputs
    #[command(after_help = hunt::AFTER_HELP)]
    Hunt(HuntArgs),
    /// Judge very many cases in shards, on one machine or many, and add them up exactly
    #[command(after_help = campaign::AFTER_HELP)]
    Campaign(CampaignArgs),
    /// Show where the errors of approximations come from and how fast they fall
    #[command(after_help = converge::AFTER_HELP)]
    Converge(ConvergeArgs),
    /// Prove an error bound of a function over a part of the plane, by machine
    #[command(after_help = prove::AFTER_HELP)]
    Prove(ProveArgs),
    /// Decide equations on standard input, one a line: proved, refuted at a point, or undecided
    #[command(after_help = identity::AFTER_HELP)]
    Identity(IdentityArgs),
    /// Audit a published paper: its tables, its claims or its formulas
    #[command(after_help = paper::AFTER_HELP)]
    Paper(PaperArgs),
    /// Compute a function at the points on standard input, one a line
    #[command(after_help = eval::AFTER_HELP)]
    Eval(EvalArgs),
    /// Compute a linkage given in a file over the crank's turn
    #[command(after_help = linkage::AFTER_HELP)]
    Linkage(LinkageArgs),
    /// Compute the run-up of a machine given in a file: its linkage under its motor
    #[command(after_help = runup::AFTER_HELP)]
    Runup(RunupArgs),
    /// Compute a cam-driven oscillator given in a file while its shaft changes speed
    #[command(after_help = chirp::AFTER_HELP)]
    Chirp(ChirpArgs),
    /// Make generated files anew, or check them
    #[command(after_help = regenerate::AFTER_HELP)]
    Regenerate(RegenerateArgs),
    /// Write completions for a shell
    #[command(after_help = shell::AFTER_COMPLETIONS)]
    Completions(CompletionsArgs),
    /// Write manual pages
    #[command(after_help = shell::AFTER_MAN)]
    Man(ManArgs),
}

/// Text for people or JSON for programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TextOrJson {
    /// For people
    Text,
    /// For programs
    Json,
}

/// The forms of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CsvOrJson {
    /// One line for each row
    Csv,
    /// The rows beside all that is known of the whole
    Json,
}

impl From<CsvOrJson> for mechaudit::report::rows::Form {
    fn from(form: CsvOrJson) -> Self {
        match form {
            CsvOrJson::Csv => Self::Csv,
            CsvOrJson::Json => Self::Json,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    /// The lines of a text that are commands of this program, what is piped or redirected left out.
    fn commands(text: &str) -> Vec<Vec<String>> {
        let ours = text.lines().filter_map(|line| {
            let line = line.trim().trim_start_matches("$ ");
            let at = line.find("mechaudit ")?;
            let piped = line[..at].trim_end().ends_with('|');
            (at == 0 || piped).then_some(&line[at..])
        });
        ours.map(|line| {
            let end = |w: &String| ["|", "<", ">", "#"].contains(&w.as_str());
            // A comment in a list of commands stands behind blanks.
            let line = line.split("  ").next().unwrap_or(line);
            let words = shell_words::split(line).expect("quotes");
            words.into_iter().take_while(|w| !end(w)).collect()
        })
        .collect()
    }

    /// The blocks of a page that are not Rust.
    fn blocks(page: &str) -> String {
        let parts = page.split("```").skip(1).step_by(2);
        let shell = parts.filter(|b| b.starts_with("sh\n") || b.starts_with("text\n"));
        shell.collect()
    }

    #[test]
    fn commands_in_help_readme_and_book_are_commands() {
        let pages = [
            include_str!("../../../README.md"),
            include_str!("../../book/atlas.md"),
            include_str!("../../book/campaigns.md"),
            include_str!("../../book/convergence.md"),
            include_str!("../../book/formats.md"),
            include_str!("../../book/hunting.md"),
            include_str!("../../book/proofs.md"),
            include_str!("../../book/reports.md"),
            include_str!("../../book/your_own_code.md"),
        ];
        let mut texts: Vec<String> = pages.into_iter().map(blocks).collect();
        let grammar = Args::command();
        let parts = grammar.get_subcommands().chain([&grammar]);
        texts.extend(parts.filter_map(|c| Some(c.get_after_help()?.to_string())));
        let all: Vec<Vec<String>> = texts.iter().flat_map(|t| commands(t)).collect();
        assert!(all.len() > 80, "{}", all.len());
        for command in all {
            let read = Args::try_parse_from(&command);
            let read = read.map(drop).or_else(|e| match e.use_stderr() {
                true => Err(e.to_string()),
                false => Ok(()),
            });
            assert_eq!(read, Ok(()), "{command:?}");
        }
    }

    #[test]
    fn the_grammar_is_sound() {
        Args::command().debug_assert();
    }
}
