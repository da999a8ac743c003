//! Reads folders of FPCore files and writes a row for each core: points decided by this project and
//! by rival3, answers that contradict each other, and the time of both to the nearest binary64.
//!
//! `cargo run --release -- FOLDER... > rows.csv`; the last lines are geometric means.

mod convert;

use cpu_time::ThreadTime;
use mechaudit::audit::{Draw, Method};
use mechaudit::study::Study;
use mechaudit_symbolic::Definitions;
use mechaudit_symbolic::evaluation::{Answer, Goal};
use rival::{Discretization, Ival, MachineBuilder, RivalError};
use rug::{Float, Rational};
use std::path::{Path, PathBuf};
use std::time::Duration;

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Points of a core.
const POINTS: usize = 256;
/// Draws after which a core with fewer valid points takes those that were found.
const DRAWS: u64 = 4096;
/// Rounds of rival3, as Herbie allows them.
const ROUNDS: usize = 5;
/// Bits that both sides may go up to.
const LIMIT: u32 = 10_000;

/// Binary64, as rival3 asks for it.
#[derive(Clone)]
struct Binary64;

impl Discretization for Binary64 {
    fn target(&self) -> u32 {
        53
    }

    fn convert(&self, _: usize, v: &Float) -> Float {
        Float::with_val(53, v.to_f64())
    }

    fn distance(&self, _: usize, lo: &Float, hi: &Float) -> usize {
        let place = |x: f64| {
            let bits = (x.to_bits() & !(1 << 63)) as i64;
            if x.is_sign_negative() { -bits } else { bits }
        };
        place(hi.to_f64()).abs_diff(place(lo.to_f64())) as usize
    }
}

/// The answer of one side at a point.
#[derive(Clone, Copy, PartialEq)]
enum Said {
    Number(f64),
    Undefined,
    Undecided,
}

impl Said {
    fn is_decided(self) -> bool {
        self != Said::Undecided
    }

    /// Returns true if both cannot be right.
    fn contradicts(self, other: Said) -> bool {
        match (self, other) {
            // A zero has no sign over the reals.
            (Said::Number(a), Said::Number(b)) => a != b,
            (Said::Undecided, _) | (_, Said::Undecided) => false,
            (a, b) => a != b,
        }
    }
}

struct Row {
    points: usize,
    ours: usize,
    theirs: usize,
    contradictions: Vec<String>,
    times: [Duration; 2],
}

fn main() {
    let folders: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    if folders.is_empty() {
        eprintln!("usage: mechaudit-formulas FOLDER...");
        std::process::exit(2);
    }
    println!(
        "file,core,points,decided,rival_decided,contradictions,microseconds,rival_microseconds,ratio,first_contradiction"
    );
    let mut ratios: Vec<(String, f64)> = Vec::new();
    let (mut points, mut ours, mut theirs, mut wrong) = (0, 0, 0, 0);
    for folder in folders {
        for file in files(&folder) {
            let name = file
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            let studies = match Study::open_all(&file.to_string_lossy()) {
                Ok(studies) => studies,
                Err(e) => {
                    eprintln!("{name}: {e}");
                    continue;
                }
            };
            for study in studies {
                let study = match study {
                    Ok(study) => study,
                    Err(e) => {
                        eprintln!("refused: {e}");
                        continue;
                    }
                };
                let core = study
                    .name()
                    .rsplit('#')
                    .next()
                    .unwrap_or("")
                    .replace(',', ";");
                let Some(row) = measure(&study) else {
                    eprintln!("{name}#{core}: rival3 has no such operations");
                    continue;
                };
                let micro = row
                    .times
                    .map(|t| t.as_secs_f64() * 1e6 / row.points.max(1) as f64);
                let ratio = micro[1] / micro[0];
                let first = row.contradictions.first().cloned().unwrap_or_default();
                println!(
                    "{name},{core},{},{},{},{},{:.2},{:.2},{ratio:.2},{first}",
                    row.points,
                    row.ours,
                    row.theirs,
                    row.contradictions.len(),
                    micro[0],
                    micro[1]
                );
                points += row.points;
                ours += row.ours;
                theirs += row.theirs;
                wrong += row.contradictions.len();
                if row.points > 0 && ratio.is_finite() {
                    ratios.push((name.clone(), ratio));
                }
            }
        }
    }
    println!("# points {points}, decided {ours}, by rival3 {theirs}, contradictions {wrong}");
    let mean = |of: &mut dyn Iterator<Item = f64>| {
        let logs: Vec<f64> = of.map(f64::ln).collect();
        (logs.iter().sum::<f64>() / logs.len() as f64).exp()
    };
    let mut groups: Vec<String> = ratios.iter().map(|r| r.0.clone()).collect();
    groups.dedup();
    for group in groups {
        let own = ratios.iter().filter(|r| r.0 == group);
        println!(
            "# {group}: rival3's time over ours, geometric mean {:.2}",
            mean(&mut own.map(|r| r.1))
        );
    }
    println!("# all: {:.2}", mean(&mut ratios.iter().map(|r| r.1)));
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut all: Vec<PathBuf> = entries.map(|e| e.path()).collect();
    all.retain(|p| p.extension().is_some_and(|e| e == "fpcore"));
    all.sort();
    all
}

/// Both sides at valid points of a study; none where rival3 lacks an operation.
fn measure(study: &Study) -> Option<Row> {
    let problem = study.problem();
    let names: Vec<String> = problem.inputs.iter().map(|i| i.name.clone()).collect();
    let none = Definitions::default();
    let expression = convert::expression(&problem.outputs[0].is, &none)?;
    let mut machine = MachineBuilder::new(Binary64)
        .max_precision(LIMIT)
        .enable_profiling(false)
        .build(vec![expression], names);
    let mut their_answer = |input: &[f64]| {
        let arguments: Vec<Ival> = input
            .iter()
            .map(|x| Ival::from_lo_hi(Float::with_val(53, *x), Float::with_val(53, *x)))
            .collect();
        match machine.apply(&arguments, None, ROUNDS) {
            Ok(values) => Said::Number(values[0].lo().to_f64()),
            Err(RivalError::InvalidInput) => Said::Undefined,
            Err(_) => Said::Undecided,
        }
    };
    let our_answer = |input: &[Rational]| match study.answers(input, Goal::Nearest).pop() {
        Some(Answer::Undefined { .. }) => Said::Undefined,
        Some(Answer::Undecided(why)) => {
            if std::env::var_os("SHOW_UNDECIDED").is_some() {
                eprintln!("undecided: {why}");
            }
            Said::Undecided
        }
        None => Said::Undecided,
        Some(answer) => Said::Number(answer.to_f64()),
    };
    let region = study
        .domain()
        .regions
        .into_iter()
        .find(|r| r.name == "magnitudes" || r.name == "domain")?;
    let mut inputs = Vec::new();
    for k in 0..DRAWS {
        if inputs.len() == POINTS {
            break;
        }
        let input = (region.sample)(&mut Draw::new(1, "formulas", region.name, k));
        // A valid point has a real value within the range of binary64 by one side at least.
        let exact: Vec<Rational> = input
            .iter()
            .filter_map(|x| Rational::from_f64(*x))
            .collect();
        let sides = [our_answer(&exact), their_answer(&input)];
        if sides
            .iter()
            .any(|s| matches!(s, Said::Number(x) if x.is_finite()))
        {
            inputs.push((input, exact));
        }
    }
    // In turns, so that both see the same machine.
    let mut times = [Duration::ZERO; 2];
    let mut said = vec![[Said::Undecided; 2]; inputs.len()];
    for chunk in 0..inputs.len().div_ceil(32) {
        let range = chunk * 32..(chunk * 32 + 32).min(inputs.len());
        let start = ThreadTime::now();
        for k in range.clone() {
            said[k][0] = our_answer(&inputs[k].1);
        }
        times[0] += start.elapsed();
        let start = ThreadTime::now();
        for k in range {
            said[k][1] = their_answer(&inputs[k].0);
        }
        times[1] += start.elapsed();
    }
    let pairs = said.iter().zip(&inputs);
    let contradictions = pairs
        .filter(|(s, _)| s[0].contradicts(s[1]))
        .map(|(s, (input, _))| {
            let word = |s: Said| match s {
                Said::Number(x) => format!("{x:e}"),
                Said::Undefined => "undefined".into(),
                Said::Undecided => "undecided".into(),
            };
            format!("{input:?} ours {} theirs {}", word(s[0]), word(s[1])).replace(',', ";")
        });
    Some(Row {
        points: inputs.len(),
        ours: said.iter().filter(|s| s[0].is_decided()).count(),
        theirs: said.iter().filter(|s| s[1].is_decided()).count(),
        contradictions: contradictions.collect(),
        times,
    })
}
