//! What may be written on the command line.

use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};
use mechaudit::reference::Decimal;
use std::path::PathBuf;
use std::time::Duration;

const EXAMPLES: &str = "\
Examples:
  mechaudit                                    audit every paper and every method
  mechaudit --cases 1000 --seed 7              more cases from another stream
  mechaudit list                               what is audited, where and how closely
  mechaudit linkage examples/sand-screen.toml --step-deg 7.5 --format csv
  echo 1.5,-0.25 | mechaudit eval faddeeva.w --digits 50

Environment:
  MECHAUDIT_EFFORT   a positive number that multiplies the numbers of random cases
  NO_COLOR           no colour; output that is not a terminal never has any

Exit codes:
  0  all as expected
  1  an accuracy finding that is not a recorded one, or a digit left undecided
  2  bad usage or input";

const AUDIT_EXAMPLES: &str = "\
Examples:
  mechaudit audit                              every method
  mechaudit audit four-bar --cases 1000        one method, 1000 cases in each region
  mechaudit audit four-bar --region NAME --seed 1 --case 17
  mechaudit audit four-bar --check-point NAME --format json
  mechaudit audit --format html --output audit.html
  mechaudit audit --format junit --output audit.xml
  mechaudit audit faddeeva --exec ./candidate  a program in any language
  mechaudit audit faddeeva --exec 'python3 w.py' --cases 1000 --timeout 5 --ulps 100

With --exec the program reads inputs and writes answers, one a line, see mechaudit points --help. It
gets all inputs without waiting for its answers. A line that cannot be read fails its own case; after
a crash, a wrong exit status or a silence of --timeout seconds the inputs left fail as unanswered, and
what is judged stays judged.";

const POINTS_EXAMPLES: &str = "\
Examples:
  mechaudit points faddeeva --count 1000 --seed 7 > points.txt
  mechaudit points faddeeva --region lower --count 10 --decimal
  mechaudit points faddeeva --region lower --seed 1 --case 17

Lines that begin with # are comments: the layout of a line, the layout of the answer due for it, the
regions. Every other line is one input, its fields separated by commas, each an exact hexadecimal
float; with --decimal the shortest decimal that reads back as the same number.

An answer is one line with the values in the order of the outputs, separated by commas or blanks,
hexadecimal or decimal (17 digits are enough), inf and nan included; or the word refuse where there
are no values, with a reason after it or without.";

const JUDGE_EXAMPLES: &str = "\
Examples:
  mechaudit points faddeeva --count 1000 > points.txt
  ./candidate < points.txt > values.txt
  mechaudit judge faddeeva --inputs points.txt --values values.txt
  ./candidate < points.txt | mechaudit judge faddeeva --inputs points.txt --values -
  mechaudit judge faddeeva --inputs points.txt --values values.txt --line 17
  mechaudit judge faddeeva --table published.csv

Answers are matched with inputs in their order; comments (#) are skipped in both files. An answer
that cannot be read is judged as one, and those after it still count. See mechaudit points --help for
what an answer looks like.

A table begins with a line of names. Columns named as an output (see mechaudit list) hold printed
decimals, an empty field none; all others hold the inputs in their order, taken exactly as printed. An
entry agrees if the reference is certainly within half a unit of its last digit: 1.2e4 has units of
1000.

Exit codes: 0, every answer within its budget or entry in agreement; 1, an answer or entry that is
not, or not there, or one too many; 2, bad usage or an input that cannot be read.";

const HUNT_EXAMPLES: &str = "\
Examples:
  mechaudit hunt four-bar --evals 20000 --seed 3
  mechaudit hunt faddeeva --evals 100000 --hard reference/hard

A third of the evaluations go to seeds: check points, earlier hard cases, random inputs of every region,
inputs between them, inputs with few bits and next to such. The rest climbs from the worst of them by
moves of bits and of coordinates, each within a factor of four of its seed.

An input that takes up more of an output's budget than any recorded one is added to METHOD.csv in the
folder of hard cases, with its share of the budget and how it was found; nothing is ever taken away.
`mechaudit audit` judges all of them.

Exit codes: 0, nothing over budget but what was recorded; 1, a finding; 2, bad usage or input.";

const CONVERGE_EXAMPLES: &str = "\
Examples:
  mechaudit converge                           every approximation
  mechaudit converge spline-clamped
  mechaudit converge run-up-dop853-rotor --format json

Errors are upper bounds: total is result less truth, method is twin less truth, rounding result less
twin, where the twin is the same algorithm without rounding. The order observed compares a level with
the one before, of the method error where there is a twin; Richardson's uses the results alone. Work is
counted, not timed. A failed run is marked, and no order is observed across it.";

const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  mechaudit completions bash > ~/.local/share/bash-completion/completions/mechaudit
  mechaudit completions fish > ~/.config/fish/completions/mechaudit.fish";

const MAN_EXAMPLES: &str = "\
Examples:
  mechaudit man | man -l -
  mechaudit man --output ~/.local/share/man/man1";

const LIST_EXAMPLES: &str = "\
Examples:
  mechaudit list
  mechaudit list --format json";

const PAPER_EXAMPLES: &str = "\
Examples:
  mechaudit paper zinchenko
  mechaudit paper zinchenko --format html --output zinchenko.html
  mechaudit paper zinchenko --format csv | head
  mechaudit paper gembara-senyk --ledger
  mechaudit paper gembara-senyk --ledger --format html --output ledger.html";

const LINKAGE_EXAMPLES: &str = "\
Examples:
  mechaudit linkage examples/sand-screen.toml --step-deg 7.5 --format csv
  mechaudit linkage examples/sand-screen.toml --step-deg 30 --digits 30
  mechaudit linkage examples/sand-screen.toml --from-deg 0 --to-deg 90 --step-deg 1 --format json
  mechaudit linkage examples/no-full-turn.toml --step-deg 5 --svg drawings
  mechaudit linkage examples/four-bar.toml --step-deg 10 --all-branches
  mechaudit linkage examples/slider-crank.toml --step-deg 15 --digits 20

The file (TOML or JSON) gives every quantity as a string with its unit:
  type = \"class-iii\"                # or \"four-bar\", \"slider-crank\": see below
  name = \"sand screen\"
  gravity = \"9.81 m/s^2\"            # optional, standard gravity 9.80665 m/s^2 otherwise
  crank_speed = \"60 rpm\"            # optional: velocities at this speed instead of ratios
  [geometry]                        # crank pivot at the origin, y up
  l1 = \"10 cm\"                      # and l2, l3, l4, l5, lb, x3, y3, x5, y5
  phi_b = \"-39.3 deg\"
  [start]                           # optional: which branch
  phi1 = \"14.426 deg\"
  phi4 = \"22.6 deg\"                 # near enough to choose; or mode = 2
  [bodies.2]                        # optional, a link without a table has no mass
  mass = \"10 kg\"
  inertia = \"0.8 kg m^2\"
  inertia_about = \"centre of mass\"  # or \"pivot\"
  radius = \"50 cm\"
  angle = \"0 deg\"

With type = \"four-bar\" or \"slider-crank\", without [bodies]:
  [geometry]
  crank = \"10 cm\"                   # and coupler, rocker, frame: rocker pivot at (frame, 0)
                                    # or rod, offset (0 m if left out), direction (0 deg)
  [start]                           # optional
  phi1 = \"0 deg\"
  assembly = \"positive\"             # joint left of the line from the crank's end to the rocker's
                                    # pivot, slider ahead: branch 0; or \"negative\": branch 1";

const EVAL_EXAMPLES: &str = "\
Examples:
  mechaudit eval --list
  echo 1.5,-0.25 | mechaudit eval faddeeva.w
  echo 0x1.8p+0,-0x1p-2 | mechaudit eval faddeeva.w --digits 50
  mechaudit eval faddeeva.w --threads 4 < cases.csv > values.csv

Input: one case a line, its fields separated by commas; each a decimal or a C99 hexadecimal float,
without --digits also inf and nan. Blank lines and lines that begin with # are skipped.

Output: one line for each case, in the same order. Without --digits the floating-point solver at the
nearest 64-bit numbers, as hexadecimal floats; with --digits the reference at exactly the numbers
given, each value correctly rounded or its last digit off by one at most.

A line that cannot be read ends the run with its number on standard error and exit code 2; digits
that cannot be certified, with exit code 1. Lines before it are answered, lines after it are not.";

const RUNUP_EXAMPLES: &str = "\
Examples:
  mechaudit runup examples/sand-screen-run-up.toml --svg drawings > run.csv
  mechaudit runup examples/sand-screen-run-up.toml --coefficients hybrid --nodes 12
  mechaudit runup examples/sand-screen-run-up.toml --work-precision --svg drawings
  mechaudit runup examples/four-bar-run-up.toml --format json

The file describes the linkage as for `mechaudit linkage`, with masses, and besides:
  [bodies.coupler]                  # four-bar: crank, coupler, rocker; slider-crank: crank, rod and
                                    # slider, which has a mass only
  [start]
  speed = \"0 rad/s\"               # optional
  [motor]
  kind = \"kloss\"                  # or \"linear\", \"table\", \"constant\", \"off\"
  synchronous_speed = \"10 rad/s\"  # kloss: with rated_torque, overload, rated_slip,
  rated_torque = \"200 N m\"        #   or pull_out_torque, critical_slip
  overload = 2.2
  rated_slip = 0.05
  standstill_torque = \"40 N m\"    # linear: with no_load_speed
  torque = \"40 N m\"               # constant
  points = [[\"0 rad/s\", \"40 N m\"], [\"10 rad/s\", \"0 N m\"]]   # table, speeds increasing
  reading = \"linear\"              # table: or \"cubic\"
  ratio = 15                        # optional: motor speed over crank speed
  rotor_inertia = \"0.006 kg m^2\"  # optional, at the motor
  flywheel = \"1 kg m^2\"           # optional, at the crank
  [load]                            # optional resistance at the crank
  constant = \"5 N m\"              # and viscous = \"0.1 N m s\", quadratic = \"0.01 N m s^2\"
  [run]
  duration = \"3 s\"
  step = \"1 ms\"                   # between rows
  tolerance = 1e-10                 # optional, and the following
  method = \"verner98\"             # or \"dop853\", \"radau5\"
  coefficients = \"exact\"          # or \"splines\" (I_n, dI_n/dphi, M_o), \"hybrid\" (dI_n/dphi only)
  nodes = 48                        # of the splines, the first at start.phi1
  target_speed = \"9.5 rad/s\"      # end there
  settle = 1e-9                     # end when two turns in a row begin with equal speeds
  fluctuation = 0.05                # say which flywheel this coefficient needs";

const CHIRP_EXAMPLES: &str = "\
Examples:
  mechaudit chirp examples/chirp-run-up.toml --svg drawings > history.csv
  mechaudit chirp examples/chirp-chart.toml --rows chart --svg drawings
  mechaudit chirp examples/chirp-run-down.toml --format json
  mechaudit chirp examples/chirp-chart.toml --rows spectrum --harmonics 50

The equation is y'' + 2n y' + w^2 y = w^2 f, f the cam's displacement. The file:
  name = \"paper machine\"           # optional
  harmonics = 200                   # optional: as many as leave 1e-4 of the lift, and reach beyond
                                    # the resonance over the whole chart
  [oscillator]
  frequency = \"100 rad/s\"           # w
  damping = \"2 rad/s\"               # n; or damping_ratio = 0.02, which is n/w
  [cam]
  lift = \"20 mm\"                    # or an angle of the rocker
  law = \"modified-sine\"             # or К, 0050, simple-harmonic, constant-acceleration,
                                    #   modified-trapezoid, cycloidal, 3-4-5, 4-5-6-7
  # law = { scca = [0.25, 0.5, 0.25] }        shares of sine, constant, cosine acceleration
  # law = { polynomial = [0, 0, 3, -2] }      coefficients of 1, x, x^2, ...
  # law = { table = [[0, 0], [0.4, 0.3], [1, 1]] }  a spline at rest at both ends
  # law = { name = \"К\", acceleration_fraction = 0.4 }   not for polynomial and table
  return_law = \"cycloidal\"          # optional: the law of the return
  rise = \"120 deg\"                  # the four together one turn
  high_dwell = \"60 deg\"
  return = \"120 deg\"
  low_dwell = \"60 deg\"
  start = \"0 deg\"                   # optional: shaft angle at which the rise starts
  [speed]                           # from shaft angle 0
  start = \"0 rad/s\"                 # optional; may be negative
  acceleration = \"2 rad/s^2\"        # negative: run-down, and reversal after standstill
  [initial]                         # optional; the follower follows the cam otherwise
  displacement = \"0 mm\"
  velocity = \"0 m/s\"
  [run]                             # for the history
  duration = \"20 s\"
  step = \"1 ms\"                     # optional, a thousand rows otherwise
  [chart]
  from = 2.0                        # of the frequency criterion
  to = 14.0
  step = 0.1
  period = \"rise\"                   # xi = w / (2 pi / time of the rise), or \"turn\": xi = w / speed
  laws = [\"К\", \"0050\"]             # optional: charts of these laws instead of the cam's";

/// Audits the accuracy of mechanism solvers against certified references, and published tables
/// against recomputed ones.
#[derive(Debug, Parser)]
#[command(
    name = "mechaudit",
    version,
    after_help = EXAMPLES,
    max_term_width = 100,
    args_conflicts_with_subcommands = true
)]
pub struct Args {
    #[command(flatten)]
    pub run: RunArgs,
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// How much to run.
#[derive(ClapArgs, Clone, Debug)]
pub struct RunArgs {
    /// Key of the random stream [default: 1]
    #[arg(long, value_name = "SEED")]
    pub seed: Option<u64>,
    /// Random cases in each region of a method's domain [default: 200]
    #[arg(long, value_name = "N")]
    pub cases: Option<u64>,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Audit one method, one region or one case
    #[command(after_help = AUDIT_EXAMPLES)]
    Audit(AuditArgs),
    /// Inputs of a method, for programs in any language
    #[command(after_help = POINTS_EXAMPLES)]
    Points(PointsArgs),
    /// Judge answers that somebody's program gave
    #[command(after_help = JUDGE_EXAMPLES)]
    Judge(JudgeArgs),
    /// Search a method's domain for its worst inputs
    #[command(after_help = HUNT_EXAMPLES)]
    Hunt(HuntArgs),
    /// Where the error of approximations comes from and how fast it falls
    #[command(after_help = CONVERGE_EXAMPLES)]
    Converge(ConvergeArgs),
    /// List the methods with their domains and budgets, and the papers
    #[command(after_help = LIST_EXAMPLES)]
    List(ListArgs),
    /// Audit one paper
    #[command(after_help = PAPER_EXAMPLES)]
    Paper(PaperArgs),
    /// Compute a linkage given in a file over the crank's turn
    #[command(after_help = LINKAGE_EXAMPLES)]
    Linkage(LinkageArgs),
    /// Values of a function, one case a line on standard input
    #[command(after_help = EVAL_EXAMPLES)]
    Eval(EvalArgs),
    /// Completions for a shell
    #[command(after_help = COMPLETIONS_EXAMPLES)]
    Completions(CompletionsArgs),
    /// Manual pages
    #[command(after_help = MAN_EXAMPLES)]
    Man(ManArgs),
    /// Run a machine given in a file up or down: its linkage under its motor over time
    #[command(after_help = RUNUP_EXAMPLES)]
    Runup(RunupArgs),
    /// A cam-driven oscillator given in a file while its shaft speeds up or slows down
    #[command(after_help = CHIRP_EXAMPLES)]
    Chirp(ChirpArgs),
}

/// Arguments of `audit`.
#[derive(ClapArgs, Debug)]
pub struct AuditArgs {
    /// The method; all methods if left out
    pub method: Option<String>,
    /// Only this region of its domain
    #[arg(long, value_name = "REGION", requires = "method")]
    pub region: Option<String>,
    /// Only this case of the region
    #[arg(long, value_name = "I", requires = "region")]
    pub case: Option<u64>,
    /// Only this check point
    #[arg(long, value_name = "NAME", requires = "method", conflicts_with_all = ["region", "case"])]
    pub check_point: Option<String>,
    /// Only this hard case, counted from 1 in reference/hard
    #[arg(long, value_name = "N", requires = "method", conflicts_with_all = ["region", "case", "check_point"])]
    pub hard: Option<usize>,
    #[command(flatten)]
    pub run: RunArgs,
    /// Form of the report
    #[arg(long, value_enum, default_value = "text")]
    pub format: AuditFormat,
    /// Write to this file, whole or not at all
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
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
    /// Seconds without a line from the program after which it is ended
    #[arg(long, value_name = "S", default_value = "60", value_parser = seconds, requires = "exec")]
    pub timeout: Duration,
    /// Give the program decimals instead of hexadecimal floats
    #[arg(long, requires = "exec")]
    pub decimal: bool,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let x: f64 = text.parse().map_err(|_| "not a number".to_string())?;
    match Duration::try_from_secs_f64(x) {
        Ok(d) if !d.is_zero() => Ok(d),
        _ => Err("must be a positive number of seconds".into()),
    }
}

/// What is judged, and how strictly.
#[derive(ClapArgs, Clone, Debug)]
pub struct ScopeArgs {
    /// Judge these outputs only, separated by commas: an answer holds no others
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub outputs: Option<Vec<String>>,
    /// Allow K ulps for every output instead of the method's budget
    #[arg(long, value_name = "K", value_parser = positive)]
    pub ulps: Option<f64>,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err("must be a finite positive number".into()),
    }
}

/// Arguments of `points`.
#[derive(ClapArgs, Debug)]
pub struct PointsArgs {
    /// The method
    pub method: String,
    /// Only this region of its domain, without check points
    #[arg(long, value_name = "REGION")]
    pub region: Option<String>,
    /// Only this case of the region
    #[arg(long, value_name = "I", requires = "region")]
    pub case: Option<u64>,
    /// Only this check point
    #[arg(long, value_name = "NAME", conflicts_with_all = ["region", "case"])]
    pub check_point: Option<String>,
    /// Only this hard case, counted from 1 in reference/hard
    #[arg(long, value_name = "N", conflicts_with_all = ["region", "case", "check_point"])]
    pub hard: Option<usize>,
    /// Random inputs in each region
    #[arg(long, value_name = "N", default_value = "200")]
    pub count: u64,
    /// Key of the random stream
    #[arg(long, value_name = "SEED", default_value = "1")]
    pub seed: u64,
    /// Decimals instead of hexadecimal floats
    #[arg(long)]
    pub decimal: bool,
    /// Write to this file, whole or not at all
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// Arguments of `judge`.
#[derive(ClapArgs, Debug)]
pub struct JudgeArgs {
    /// The method
    pub method: String,
    /// The inputs, as `mechaudit points` writes them
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
    /// Only the input on this line of its file, with everything that is known of it
    #[arg(long, value_name = "N", requires = "inputs")]
    pub line: Option<u64>,
    /// A published table in CSV: inputs and printed decimals
    #[arg(long, value_name = "FILE", conflicts_with_all = ["inputs", "values", "outputs", "ulps"])]
    pub table: Option<PathBuf>,
    #[command(flatten)]
    pub scope: ScopeArgs,
    /// Form of the report
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Arguments of `hunt`.
#[derive(ClapArgs, Debug)]
pub struct HuntArgs {
    /// The method
    pub method: String,
    /// Evaluations of solver and reference
    #[arg(long, value_name = "N", default_value = "10000", value_parser = clap::value_parser!(u64).range(1..))]
    pub evals: u64,
    /// Key of the random stream
    #[arg(long, value_name = "SEED", default_value = "1")]
    pub seed: u64,
    /// Folder of the hard cases; nothing is recorded if it is not there
    #[arg(long, value_name = "DIR", default_value = "reference/hard")]
    pub hard: PathBuf,
}

/// Arguments of `converge`.
#[derive(ClapArgs, Debug)]
pub struct ConvergeArgs {
    /// The approximation; all of them if left out
    pub name: Option<String>,
    /// Form of the report
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Arguments of `completions`.
#[derive(ClapArgs, Debug)]
pub struct CompletionsArgs {
    /// The shell
    pub shell: clap_complete::Shell,
}

/// Arguments of `man`.
#[derive(ClapArgs, Debug)]
pub struct ManArgs {
    /// Write one page for each command into this folder
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

/// Arguments of `list`.
#[derive(ClapArgs, Debug)]
pub struct ListArgs {
    /// Form of the list
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Arguments of `paper`.
#[derive(ClapArgs, Debug)]
pub struct PaperArgs {
    /// The paper's key, see `mechaudit list`
    pub key: String,
    /// Every formula with its proof, its refutation or its smallest repair
    #[arg(long)]
    pub ledger: bool,
    /// Compare the ledger with the file instead of writing it; exit code 1 if they differ
    #[arg(long, requires_all = ["ledger", "output"])]
    pub check: bool,
    /// Form of the report
    #[arg(long, value_enum, default_value = "text")]
    pub format: PaperFormat,
    /// Write to this file, whole or not at all
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// Arguments of `linkage`.
#[derive(ClapArgs, Debug)]
pub struct LinkageArgs {
    /// The linkage in TOML or JSON; `-` reads standard input
    pub file: PathBuf,
    /// Step of the crank angle in degrees
    #[arg(
        long,
        value_name = "DEG",
        default_value = "7.5",
        value_parser = decimal,
        allow_hyphen_values = true
    )]
    pub step_deg: Decimal,
    /// Form of the rows
    #[arg(long, value_enum, default_value = "csv")]
    pub format: CsvOrJson,
    /// First crank angle in degrees [default: start.phi1 of the file, else 0]
    #[arg(long, value_name = "A", value_parser = decimal, allow_hyphen_values = true)]
    pub from_deg: Option<Decimal>,
    /// Last crank angle in degrees, itself included [default: one turn, its end left out]
    #[arg(long, value_name = "B", value_parser = decimal, allow_hyphen_values = true)]
    pub to_deg: Option<Decimal>,
    /// Follow the assembly mode of this number at the first crank angle, counted from 0 by phi4
    /// (four-bar, slider-crank: 0 positive, 1 negative assembly)
    #[arg(long, value_name = "N", conflicts_with = "all_branches")]
    pub branch: Option<usize>,
    /// Every assembly mode at every crank angle, numbered by branch
    #[arg(long)]
    pub all_branches: bool,
    /// Certified decimals with this many significant digits instead of floating-point numbers
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub digits: Option<u32>,
    /// Draw mechanism.svg and, with masses, reduced.svg into this folder
    #[arg(long, value_name = "DIR")]
    pub svg: Option<PathBuf>,
    /// Write the rows to this file, whole or not at all
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// Arguments of `eval`.
#[derive(ClapArgs, Debug)]
pub struct EvalArgs {
    /// The function, see --list
    #[arg(required_unless_present = "list")]
    pub name: Option<String>,
    /// Certified decimals with this many significant digits instead of floating-point numbers
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub digits: Option<u32>,
    /// Threads [default: one for each core]
    #[arg(long, value_name = "T", value_parser = threads)]
    pub threads: Option<usize>,
    /// List the functions instead
    #[arg(long, conflicts_with_all = ["name", "digits", "threads"])]
    pub list: bool,
}

fn threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n @ 1..=1024) => Ok(n),
        _ => Err("a number of threads is between 1 and 1024".into()),
    }
}

/// Arguments of `runup`.
#[derive(ClapArgs, Debug)]
pub struct RunupArgs {
    /// The machine in TOML or JSON; `-` reads standard input
    pub file: PathBuf,
    /// Form of the rows
    #[arg(long, value_enum, default_value = "csv")]
    pub format: CsvOrJson,
    /// Where I_n, dI_n/dphi and M_o come from, instead of run.coefficients
    #[arg(long, value_name = "MODEL")]
    pub coefficients: Option<String>,
    /// Nodes of the splines, instead of run.nodes
    #[arg(long, value_name = "N")]
    pub nodes: Option<usize>,
    /// Tolerance of a step, instead of run.tolerance
    #[arg(long, value_name = "TOL")]
    pub tolerance: Option<f64>,
    /// Method of integration, instead of run.method
    #[arg(long, value_name = "NAME")]
    pub method: Option<String>,
    /// Rows of method, tolerance, evaluations and error instead of the motion
    #[arg(long)]
    pub work_precision: bool,
    /// Draw run-up.svg, or work-precision.svg, into this folder
    #[arg(long, value_name = "DIR")]
    pub svg: Option<PathBuf>,
    /// Write the rows to this file, whole or not at all
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// Arguments of `chirp`.
#[derive(ClapArgs, Debug)]
pub struct ChirpArgs {
    /// The oscillator, its cam and its shaft in TOML or JSON; `-` reads standard input
    pub file: PathBuf,
    /// What to print [default: history with [run] in the file, else chart with [chart], else
    /// spectrum]
    #[arg(long, value_enum)]
    pub rows: Option<ChirpRows>,
    /// Form of the rows
    #[arg(long, value_enum, default_value = "csv")]
    pub format: CsvOrJson,
    /// Harmonics of the cam, instead of harmonics in the file
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub harmonics: Option<u32>,
    /// Draw spectrum.svg and, with [run], history.svg, with [chart], chart.svg into this folder
    #[arg(long, value_name = "DIR")]
    pub svg: Option<PathBuf>,
    /// Write the rows to this file, whole or not at all
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// What `chirp` prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ChirpRows {
    /// The motion over time
    History,
    /// Peaks and bounds over the frequency criterion
    Chart,
    /// The harmonics of the cam's displacement
    Spectrum,
}

fn decimal(text: &str) -> Result<Decimal, String> {
    Decimal::parse(text).map_err(|e| e.to_string())
}

/// Text for people or JSON for programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TextOrJson {
    /// For people
    Text,
    /// For programs
    Json,
}

/// The forms of an audit's report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AuditFormat {
    /// For people
    Text,
    /// Everything, as schema/audit.schema.json describes it
    Json,
    /// JUnit XML, for build servers
    Junit,
    /// One page without outside parts
    Html,
}

/// The forms of a paper's report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PaperFormat {
    /// Findings and tallies for people
    Text,
    /// Everything
    Json,
    /// One line for each printed entry and variant of the data
    Csv,
    /// One page without outside parts
    Html,
    /// The ledger as a LaTeX document
    Latex,
    /// What is wrong in the ledger, as JSON
    Errata,
}

/// The forms of a linkage's rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CsvOrJson {
    /// One line for each position
    Csv,
    /// With what is known of the whole turn
    Json,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_grammar_is_sound() {
        Args::command().debug_assert();
    }
}
