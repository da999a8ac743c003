//! Arguments of `mechaudit chirp`.

use super::{RowsFormat, UnitsArgs, number};
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit chirp examples/chirp-run-up.toml --svg drawings > history.csv
  mechaudit chirp examples/chirp-chart.toml --rows chart --svg drawings
  mechaudit chirp examples/chirp-run-down.toml --format html --output run.html
  mechaudit chirp examples/chirp-chart.toml --rows spectrum --harmonics 50

The equation is y'' + 2n y' + w^2 y = w^2 f, f the cam's displacement. The file:
  name = \"paper machine\"            # optional
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
  laws = [\"К\", \"0050\"]              # optional: charts of these laws instead of the cam's";

/// Arguments of `chirp`.
#[derive(ClapArgs, Debug)]
pub struct ChirpArgs {
    /// The oscillator, its cam and its shaft in TOML or JSON; `-` reads standard input
    pub file: PathBuf,
    /// Rows to print [default: history with [run] in the file, else chart with [chart], else
    /// spectrum; on a page all that there is]
    #[arg(long, value_enum)]
    pub rows: Option<ChirpRows>,
    /// Form of the rows
    #[arg(long, value_enum, default_value = "csv")]
    pub format: RowsFormat,
    /// Harmonics of the cam, instead of harmonics in the file
    #[arg(long, value_name = "N", value_parser = number::within::<u32>(1..=100_000))]
    pub harmonics: Option<u32>,
    /// Draw spectrum.svg and, with [run], history.svg, with [chart], chart.svg into this folder
    #[arg(long, value_name = "DIR")]
    pub svg: Option<PathBuf>,
    #[command(flatten)]
    pub units: UnitsArgs,
    /// Write the rows or the page atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// The rows that `chirp` prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ChirpRows {
    /// The motion over time
    History,
    /// Peaks and bounds over the frequency criterion
    Chart,
    /// The harmonics of the cam's displacement
    Spectrum,
}
