//! Arguments of `mechaudit runup`.

use super::{RowsFormat, UnitsArgs, number};
use clap::Args as ClapArgs;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use mechaudit::machine::run_up::Coefficients;
use mechaudit::solvers::run_up::{MOST_NODES, Method};
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit runup examples/sand-screen-run-up.toml --svg drawings > run.csv
  mechaudit runup examples/sand-screen-run-up.toml --coefficients hybrid --nodes 12
  mechaudit runup examples/sand-screen-run-up.toml --work-precision --svg drawings
  mechaudit runup examples/four-bar-run-up.toml --format html --output run.html
  mechaudit runup examples/soft-start.toml --units rpm
  mechaudit runup examples/four-bar-run-up.toml --digits 15

The file describes the linkage as for `mechaudit linkage`, with masses, and in addition:
  [bodies.coupler]                  # four-bar: crank, coupler, rocker; slider-crank: crank, rod and
                                    # slider, which has a mass only
  [start]
  speed = \"0 rad/s\"                 # optional
  [motor]
  kind = \"kloss\"                    # or \"linear\", \"table\", \"constant\", \"off\"
  synchronous_speed = \"10 rad/s\"    # kloss: with rated_torque, overload, rated_slip,
  rated_torque = \"200 N m\"          #   or pull_out_torque, critical_slip
  overload = 2.2
  rated_slip = 0.05
  standstill_torque = \"40 N m\"      # linear: with no_load_speed
  torque = \"40 N m\"                 # constant
  points = [[\"0 rad/s\", \"40 N m\"], [\"10 rad/s\", \"0 N m\"]]   # table, speeds increasing
                                    # or over time, from 0 s on: [[\"0 s\", \"0 N m\"],
                                    # [\"2 s\", \"40 N m\"]]; after the last time the torque stays
  reading = \"linear\"                # table of speeds: or \"cubic\"
  ratio = 15                        # optional: motor speed over crank speed
  rotor_inertia = \"0.006 kg m^2\"    # optional, at the motor
  flywheel = \"1 kg m^2\"             # optional, at the crank
  [load]                            # optional resistance at the crank
  constant = \"5 N m\"                # and viscous = \"0.1 N m s\", quadratic = \"0.01 N m s^2\"
  [run]
  duration = \"3 s\"
  step = \"1 ms\"                     # between rows
  tolerance = 1e-10                 # optional, and the following
  method = \"verner98\"               # or \"dop853\", \"radau5\"; left out, radau5 where stiff
  coefficients = \"exact\"            # or \"splines\" (I_n, dI_n/dphi, M_o), \"hybrid\" (dI_n/dphi only)
  nodes = 48                        # of the splines, the first at start.phi1
  target_speed = \"9.5 rad/s\"        # end there
  settle = 1e-9                     # end when two turns in a row begin with equal speeds
  fluctuation = 0.05                # say which flywheel this coefficient needs";

/// Arguments of `runup`.
#[derive(ClapArgs, Debug)]
pub struct RunupArgs {
    /// The machine in TOML or JSON; `-` reads standard input
    pub file: PathBuf,
    /// Form of the rows
    #[arg(long, value_enum, default_value = "csv")]
    pub format: RowsFormat,
    /// Source of I_n, dI_n/dphi and M_o, instead of run.coefficients
    #[arg(long, value_name = "MODEL", value_parser = coefficients())]
    pub coefficients: Option<Coefficients>,
    /// Nodes of the splines, instead of run.nodes; not with exact coefficients
    #[arg(long, value_name = "N", value_parser = number::within::<usize>(3..=MOST_NODES as u64))]
    pub nodes: Option<usize>,
    /// Tolerance of a step, instead of run.tolerance
    #[arg(long, value_name = "TOL", value_parser = number::positive)]
    pub tolerance: Option<f64>,
    /// Method of integration, instead of run.method
    #[arg(long, value_name = "NAME", value_parser = method())]
    pub method: Option<Method>,
    /// Certified digits of the drive's angle, speed and acceleration
    #[arg(long, value_name = "N", value_parser = number::within::<u32>(1..=1000),
        conflicts_with_all = ["coefficients", "nodes", "tolerance", "method", "work_precision", "svg", "units"])]
    pub digits: Option<u32>,
    /// Rows of method, tolerance, evaluations and error instead of the motion
    #[arg(long)]
    pub work_precision: bool,
    /// Draw run-up.svg, or work-precision.svg, into this folder
    #[arg(long, value_name = "DIR")]
    pub svg: Option<PathBuf>,
    #[command(flatten)]
    pub units: UnitsArgs,
    /// Write the rows or the page atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

fn coefficients() -> impl TypedValueParser<Value = Coefficients> {
    let named = |name: String| Coefficients::ALL.into_iter().find(|c| c.name() == name);
    PossibleValuesParser::new(Coefficients::ALL.map(Coefficients::name))
        .try_map(move |name| named(name).ok_or("unknown"))
}

fn method() -> impl TypedValueParser<Value = Method> {
    let named = |name: String| Method::ALL.into_iter().find(|m| m.name() == name);
    PossibleValuesParser::new(Method::ALL.map(|m| m.name()))
        .try_map(move |name| named(name).ok_or("unknown"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::{Args, Command};
    use clap::Parser;

    #[test]
    fn models_and_methods_are_known_by_their_names() {
        let read = |option: &str, name: &str| {
            let words = ["mechaudit", "runup", "file", option, name];
            match Args::try_parse_from(words).unwrap().command {
                Some(Command::Runup(args)) => args,
                other => panic!("{other:?}"),
            }
        };
        for model in Coefficients::ALL {
            let args = read("--coefficients", model.name());
            assert_eq!(
                args.coefficients.map(Coefficients::name),
                Some(model.name())
            );
        }
        for method in Method::ALL {
            let args = read("--method", method.name());
            assert_eq!(args.method.map(|m| m.name()), Some(method.name()));
        }
    }
}
