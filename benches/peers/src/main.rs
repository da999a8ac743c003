//! W(z) of this project beside the public double-precision codes: accuracy through the certified
//! reference, speed in one run on the same points.

mod c_libraries;
mod code;
mod own;
mod points;
mod rust_crates;
mod scipy;
mod speed;
mod text;

use clap::Parser;
use code::Codes;
use points::{REGIONS, Region};
use std::process::ExitCode;

/// W(z) = exp(-z²) erfc(-iz) of this project beside the public double-precision codes.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// Speed: ns per value.
    #[arg(long)]
    speed: bool,
    /// Regions, such as a,b,d; all by default.
    #[arg(long, value_delimiter = ',', value_name = "LETTERS")]
    regions: Vec<String>,
    /// Seed of the points.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Points of each region for the speed.
    #[arg(long, default_value_t = 16384, value_name = "N")]
    speed_points: usize,
    /// Passes over the points for the speed; the median counts.
    #[arg(long, default_value_t = 25, value_name = "N")]
    passes: usize,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let mut regions: Vec<&'static Region> = Vec::new();
    for region in &REGIONS {
        if arguments.regions.is_empty() || arguments.regions.iter().any(|r| r == region.name) {
            regions.push(region);
        }
    }
    let mut codes = Codes::default();
    if let Some(core) = core_affinity::get_core_ids().and_then(|c| c.last().copied()) {
        core_affinity::set_for_current(core);
    }
    own::add(&mut codes);
    rust_crates::add(&mut codes);
    c_libraries::add(&mut codes);
    scipy::add(&mut codes);
    let settings = speed::Settings {
        seed: arguments.seed,
        points: arguments.speed_points,
        passes: arguments.passes,
    };
    let found: Vec<_> = codes.found.iter().map(|c| &**c).collect();
    let timings = speed::measure(&found, &regions, &settings, &|| ());
    print!("{}", text::speed(&timings));
    for m in &codes.missing {
        println!("missing: {}: {}", m.name, m.reason);
    }
    ExitCode::SUCCESS
}
