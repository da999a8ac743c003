//! The grammar of the command line.

mod audit;
mod campaign;
mod chirp;
mod compare;
mod converge;
mod describe;
mod eval;
mod help;
mod hunt;
mod identity;
mod judge;
mod linkage;
mod motion;
mod number;
mod paper;
mod points;
mod prove;
mod regenerate;
mod runup;
mod scope;
mod shell;
mod units;

pub use audit::{AuditArgs, AuditFormat, ProgramArgs};
pub use campaign::{
    CampaignArgs, CampaignReportArgs, CampaignRunArgs, CampaignStep, MergeArgs, PlanArgs,
    StatusArgs,
};
pub use chirp::{ChirpArgs, ChirpRows};
pub use compare::{CompareArgs, CompareFormat};
pub use converge::ConvergeArgs;
pub use describe::{DescribeArgs, ListArgs};
pub use eval::EvalArgs;
pub use help::explained;
pub use hunt::HuntArgs;
pub use identity::IdentityArgs;
pub use judge::JudgeArgs;
pub use linkage::LinkageArgs;
pub use motion::{MotionArgs, MotionFormat};
pub use paper::{PaperArgs, PaperFormat};
pub use points::PointsArgs;
pub use prove::{Part, ProveArgs};
pub use regenerate::RegenerateArgs;
pub use runup::RunupArgs;
pub use scope::{Numbers, ScopeArgs, WhereArgs};
pub use shell::{CompletionsArgs, ManArgs};
pub use units::UnitsArgs;

use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};
use mechaudit::report::rows::Form;

const AFTER_HELP: &str = "\
Examples:
  mechaudit                                    audit every paper and every method, in brief
  mechaudit --verbose                          the same with every finding and output in full
  mechaudit --cases 1000 --seed 7              more cases from another stream
  mechaudit list                               every method and paper
  mechaudit linkage examples/sand-screen.toml --step-deg 7.5 --format csv
  echo 1.5,-0.25 | mechaudit eval faddeeva --digits 50

Environment:
  MECHAUDIT_EFFORT   a positive number that multiplies the numbers of random cases
  NO_COLOR           no colour; output that is not a terminal never has any

Exit codes:
  0    all as expected
  1    an accuracy finding that is not a recorded one, or a digit left undecided
  2    bad usage or input
  130  ended by Ctrl-C: the report holds what was judged until then; a second
       Ctrl-C ends the program at once, without a report";

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
    /// Show every finding and every method in full, below the summary
    #[arg(long, short)]
    pub verbose: bool,
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The amount of work.
#[derive(ClapArgs, Clone, Debug)]
pub struct RunArgs {
    /// Seed of the random stream [default: 1]
    #[arg(long, value_name = "SEED", value_parser = number::whole)]
    pub seed: Option<u64>,
    /// Random cases in each region of a method's domain [default: 200]
    #[arg(long, value_name = "N", value_parser = number::counting::<u64>())]
    pub cases: Option<u64>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Audit all methods or one, a region of one or a single case
    #[command(after_help = audit::AFTER_HELP)]
    Audit(AuditArgs),
    /// Judge several programs at the same cases, side by side
    #[command(after_help = compare::AFTER_HELP)]
    Compare(CompareArgs),
    /// Show a method's inputs, outputs, budgets and protocol
    #[command(after_help = describe::AFTER_DESCRIBE)]
    Describe(DescribeArgs),
    /// List the methods and the papers
    #[command(after_help = describe::AFTER_LIST)]
    List(ListArgs),
    /// Write inputs of a method, for programs in any language
    #[command(after_help = points::AFTER_HELP)]
    Points(PointsArgs),
    /// Judge a file of precomputed answers
    #[command(after_help = judge::AFTER_HELP)]
    Judge(JudgeArgs),
    /// Search a method's domain for its worst inputs
    #[command(after_help = hunt::AFTER_HELP)]
    Hunt(HuntArgs),
    /// Judge very many cases in shards, on one machine or many, and add up the results exactly
    #[command(after_help = campaign::AFTER_HELP)]
    Campaign(CampaignArgs),
    /// Show the sources of errors of approximations and their orders
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
    /// Compute the certified motion of an initial value problem given in a file
    #[command(after_help = motion::AFTER_HELP)]
    Motion(MotionArgs),
    /// Compute the run-up of a machine given in a file: its linkage under its motor
    #[command(after_help = runup::AFTER_HELP)]
    Runup(RunupArgs),
    /// Compute a cam-driven oscillator given in a file while its shaft changes speed
    #[command(after_help = chirp::AFTER_HELP)]
    Chirp(ChirpArgs),
    /// Regenerate generated files, or check them
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
pub enum RowsFormat {
    /// One line for each row
    Csv,
    /// The rows beside all that is known of the whole
    Json,
    /// One page without outside parts, with curves
    Html,
}

impl RowsFormat {
    /// The form of rows; none of a page.
    pub fn rows(self) -> Option<Form> {
        match self {
            RowsFormat::Csv => Some(Form::Csv),
            RowsFormat::Json => Some(Form::Json),
            RowsFormat::Html => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    /// The lines of a text that are commands of this program, what is piped or redirected left out.
    fn commands(text: &str) -> Vec<Vec<String>> {
        // A backslash continues a command.
        let text = text.replace("\\\n      ", "");
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

    /// Commands within the sentences of a page or a header: those without a placeholder.
    fn inline(page: &str) -> Vec<Vec<String>> {
        let sentences: String = page.split("```").step_by(2).collect();
        // A comment in C has an asterisk before each of its lines.
        let sentences = sentences.replace("\n * ", " ").replace('\n', " ");
        let spans = sentences.split('`').skip(1).step_by(2);
        let ours = spans.filter(|s| s.starts_with("mechaudit ") && !s.contains(['…', '=']));
        let placeholder = |w: &String| w.len() > 1 && w.chars().all(|c| c.is_ascii_uppercase());
        let split = ours.map(|s| shell_words::split(s).expect("quotes"));
        split
            .filter(|words| !words.iter().any(placeholder))
            .collect()
    }

    /// Pages of the repository and headers, all that shows commands.
    const PAGES: [&str; 22] = [
        include_str!("../../../README.md"),
        include_str!("../../../benches/README.md"),
        include_str!("../../../capi/README.md"),
        include_str!("../../../capi/include/mechaudit.h"),
        include_str!("../../../capi/include/mechaudit/cerf.h"),
        include_str!("../../../examples/README.md"),
        include_str!("../../../python/README.md"),
        include_str!("../../book/adding_a_method.md"),
        include_str!("../../book/atlas.md"),
        include_str!("../../book/campaigns.md"),
        include_str!("../../book/convergence.md"),
        include_str!("../../book/formats.md"),
        include_str!("../../book/hunting.md"),
        include_str!("../../book/judging.md"),
        include_str!("../../book/planar_mechanisms.md"),
        include_str!("../../book/proofs.md"),
        include_str!("../../book/references.md"),
        include_str!("../../book/reports.md"),
        include_str!("../../book/theorems.md"),
        include_str!("../../book/ulps.md"),
        include_str!("../../book/your_own_code.md"),
        include_str!("../../book/your_own_problem.md"),
    ];

    /// Returns the reason why a line is no command of this program; help and version are commands.
    fn refused(command: &[String]) -> Option<String> {
        let read = match Args::try_parse_from(command) {
            Ok(read) => read,
            Err(e) => return e.use_stderr().then(|| e.to_string()),
        };
        let method = match &read.command {
            Some(Command::Audit(a)) => a.method.first().map(String::as_str),
            Some(Command::Compare(a)) => Some(&*a.method),
            Some(Command::Describe(a)) => Some(&*a.method),
            Some(Command::Points(a)) => Some(&*a.method),
            Some(Command::Judge(a)) => Some(&*a.method),
            Some(Command::Hunt(a)) => Some(&*a.method),
            Some(Command::Eval(a)) => a.name.as_deref(),
            _ => None,
        };
        // A page of the book adds this one.
        let known = method.filter(|m| *m != "bessel-j0" && !mechaudit::study::is_path(m));
        known.and_then(|m| crate::cli::lookup::method(m).err().map(|e| e.to_string()))
    }

    /// Returns true if the words name a command or a subcommand.
    fn is_name(grammar: &clap::Command, words: &[String]) -> bool {
        let [first, rest @ ..] = words else {
            return true;
        };
        let found = grammar.find_subcommand(first);
        found.is_some_and(|c| is_name(c, rest))
    }

    #[test]
    fn commands_in_help_pages_and_headers_are_commands() {
        let mut texts: Vec<String> = PAGES.into_iter().map(blocks).collect();
        let grammar = explained(Args::command());
        let parts = grammar.get_subcommands().chain([&grammar]);
        texts.extend(parts.filter_map(|c| Some(c.get_after_help()?.to_string())));
        let all: Vec<Vec<String>> = texts.iter().flat_map(|t| commands(t)).collect();
        assert!(all.len() > 100, "{}", all.len());
        for command in all {
            assert_eq!(refused(&command), None, "{command:?}");
        }
        let all: Vec<Vec<String>> = PAGES.into_iter().flat_map(inline).collect();
        assert!(all.len() > 40, "{}", all.len());
        for command in all {
            // The name of a command alone may want arguments.
            if !is_name(&grammar, &command[1..]) {
                assert_eq!(refused(&command), None, "{command:?}");
            }
        }
    }

    /// A page with two methods in one evaluation, or with a name that there is not.
    #[test]
    fn what_is_no_command_is_found() {
        let page = "Use `mechaudit eval voigt voigt-hwhm` or\n`mechaudit audit\nvoight`, not `mechaudit audit METHOD`.";
        let all = inline(page);
        assert_eq!(all.len(), 2);
        assert!(all.iter().all(|c| refused(c).is_some()));
    }

    /// Examples and columns are printed as they stand.
    #[test]
    fn help_is_no_wider_than_a_terminal() {
        let grammar = explained(Args::command());
        let mut commands = vec![&grammar];
        let mut seen = 0;
        while let Some(command) = commands.pop() {
            commands.extend(command.get_subcommands());
            let after = command
                .get_after_help()
                .map(|h| h.to_string())
                .unwrap_or_default();
            for line in after.lines().filter(|l| l.starts_with("  ")) {
                assert!(line.chars().count() <= 80, "{}: {line}", command.get_name());
                seen += 1;
            }
        }
        assert!(seen > 300, "{seen}");
    }

    #[test]
    fn the_grammar_is_sound() {
        Args::command().debug_assert();
    }
}
