//! W(z) of this project beside the public double-precision codes: accuracy through the certified
//! reference, speed in one run on the same points.

mod accuracy;
mod c_libraries;
mod code;
mod errors;
mod markdown;
mod own;
mod points;
mod report;
mod rust_crates;
mod scipy;
mod special;
mod speed;
mod spread;

use clap::{Parser, ValueEnum};
use code::{Code, Codes};
use indicatif::{ProgressBar, ProgressStyle};
use points::{REGIONS, Region};
use report::{AccuracyReport, Report, SpeedReport};
use std::process::ExitCode;

/// W(z) = exp(-z²) erfc(-iz) of this project beside the public double-precision codes.
///
/// Without --accuracy, --special and --speed: all three.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// Accuracy against the certified reference on N points a region (2000 by default).
    #[arg(long, value_name = "N")]
    accuracy: Option<Option<u64>>,
    /// Special values: NaN, infinities, the edges of the range.
    #[arg(long)]
    special: bool,
    /// Speed: ns per value.
    #[arg(long)]
    speed: bool,
    /// Output.
    #[arg(long, value_enum, default_value_t = Format::Markdown)]
    format: Format,
    /// Regions, such as a,b,d; all by default.
    #[arg(long, value_delimiter = ',', value_name = "LETTERS")]
    regions: Vec<String>,
    /// Codes whose name contains one of these words; all by default.
    #[arg(long, value_delimiter = ',', value_name = "WORDS")]
    codes: Vec<String>,
    /// Seed of the points.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Points of each region for the speed.
    #[arg(long, default_value_t = 16384, value_name = "N")]
    speed_points: usize,
    /// Passes over the points for the speed.
    #[arg(long, default_value_t = 25, value_name = "N")]
    passes: usize,
    /// Threads for the accuracy; all cores by default. The speed is that of one thread.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Markdown,
    Json,
}

/// Points of each region for the accuracy when no number is given.
const POINTS: u64 = 2000;

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &Arguments) -> Result<String, String> {
    let regions = regions(&arguments.regions)?;
    if arguments.accuracy == Some(Some(0)) || arguments.speed_points == 0 || arguments.passes == 0 {
        return Err("the numbers of points and passes are at least 1".into());
    }
    if let Some(n) = arguments.threads {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(n)
            .build_global();
        pool.map_err(|e| e.to_string())?;
    }
    let all = arguments.accuracy.is_none() && !arguments.special && !arguments.speed;
    let codes = codes(&arguments.codes);
    let found: Vec<&dyn Code> = codes.found.iter().map(|c| &**c).collect();
    if found.is_empty() {
        let mut message = format!("no code found is called {}", arguments.codes.join(" or "));
        for m in &codes.missing {
            message.push_str(&format!("\n{} is missing: {}", m.name, m.reason));
        }
        return Err(message);
    }

    let accuracy = match arguments.accuracy {
        Some(n) => Some(n.unwrap_or(POINTS)),
        None => all.then_some(POINTS),
    };
    let accuracy = accuracy.map(|points| {
        let settings = accuracy::Settings {
            seed: arguments.seed,
            points,
        };
        let bar = bar("accuracy", points * regions.len() as u64);
        let measured = quiet(|| accuracy::measure(&found, &regions, &settings, &|n| bar.inc(n)));
        bar.finish_and_clear();
        AccuracyReport {
            settings,
            reference_bits: accuracy::BITS,
            regions: measured,
        }
    });
    let special_values = (all || arguments.special).then(|| quiet(|| special::table(&found)));
    let speed = (all || arguments.speed).then(|| speed_report(arguments, &regions));

    let report = Report {
        compiled_for: report::compiled_for(),
        codes: report::compared(&found),
        missing: codes.missing.clone(),
        accuracy,
        special_values,
        speed: speed.transpose()?,
    };
    Ok(match arguments.format {
        Format::Markdown => markdown::report(&report),
        Format::Json => report::json(&report),
    })
}

fn regions(letters: &[String]) -> Result<Vec<&'static Region>, String> {
    if let Some(l) = letters
        .iter()
        .find(|l| REGIONS.iter().all(|r| r.name != **l))
    {
        let known: Vec<&str> = REGIONS.iter().map(|r| r.name).collect();
        return Err(format!("no region {l}; there are {}", known.join(", ")));
    }
    let chosen = |r: &&Region| letters.is_empty() || letters.iter().any(|l| r.name == l);
    Ok(REGIONS.iter().filter(chosen).collect())
}

/// Looks for the codes whose name contains one of the words.
fn codes(words: &[String]) -> Codes {
    let mut codes = Codes::default();
    own::add(&mut codes);
    rust_crates::add(&mut codes);
    c_libraries::add(&mut codes);
    scipy::add(&mut codes);
    let chosen = |name: &str| words.is_empty() || words.iter().any(|w| name.contains(w.as_str()));
    codes.found.retain(|c| chosen(c.name()));
    codes.missing.retain(|m| chosen(&m.name));
    codes
}

/// Measures the speed in a thread bound to one core; a Python process started there inherits it.
fn speed_report(arguments: &Arguments, regions: &[&'static Region]) -> Result<SpeedReport, String> {
    let measure = || {
        let core = core_affinity::get_core_ids().and_then(|cores| cores.last().copied());
        let core = core.filter(|&c| core_affinity::set_for_current(c));
        let codes = codes(&arguments.codes);
        let found: Vec<&dyn Code> = codes.found.iter().map(|c| &**c).collect();
        let settings = speed::Settings {
            seed: arguments.seed,
            points: arguments.speed_points,
            passes: arguments.passes,
        };
        let bar = bar("speed", (settings.passes * regions.len()) as u64);
        let timings = speed::measure(&found, regions, &settings, &|| bar.inc(1));
        bar.finish_and_clear();
        SpeedReport {
            settings,
            block: speed::BLOCK,
            core: core.map(|c| c.id),
            regions: timings,
        }
    };
    std::thread::scope(|s| s.spawn(measure).join())
        .map_err(|_| "a code panicked while its speed was measured".into())
}

/// A progress line on standard error, hidden where that is no terminal.
fn bar(what: &'static str, length: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{prefix} {wide_bar} {human_pos}/{human_len} {eta}");
    ProgressBar::new(length)
        .with_style(style.expect("a valid template"))
        .with_prefix(what)
}

/// Runs `f` without the messages of panics: codes that panic are counted.
fn quiet<T>(f: impl FnOnce() -> T) -> T {
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| ()));
    let result = f();
    std::panic::set_hook(hook);
    result
}
