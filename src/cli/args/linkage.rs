//! Arguments of `mechaudit linkage`.

use super::{RowsFormat, UnitsArgs, number};
use clap::Args as ClapArgs;
use mechaudit::reference::Decimal;
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit linkage examples/sand-screen.toml --step-deg 7.5 --format csv
  mechaudit linkage examples/sand-screen.toml --step-deg 30 --digits 30
  mechaudit linkage examples/sand-screen.toml --from-deg 0 --to-deg 90 --step-deg 1 --format json
  mechaudit linkage examples/no-full-turn.toml --step-deg 5 --svg drawings
  mechaudit linkage examples/four-bar.toml --step-deg 10 --all-branches
  mechaudit linkage examples/slider-crank.toml --step-deg 15 --digits 20
  mechaudit linkage examples/jansen-leg.toml --paths --svg drawings
  mechaudit linkage examples/jansen-leg.toml --format html --output leg.html
  mechaudit linkage examples/peaucellier-cell.toml --dxf drawings --units mm --from-deg 30

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
  [bodies.2]                        # optional, a link without a section has no mass
  mass = \"10 kg\"
  inertia = \"0.8 kg m^2\"
  inertia_about = \"centre of mass\"  # or \"pivot\"
  radius = \"50 cm\"
  angle = \"0 deg\"

With type = \"four-bar\" or \"slider-crank\":
  [geometry]
  crank = \"10 cm\"                   # and coupler, rocker, frame: rocker pivot at (frame, 0)
                                    # or rod, offset (0 m if left out), direction (0 deg)
  [start]                           # optional
  phi1 = \"0 deg\"
  assembly = \"positive\"             # joint left of the line from the crank's end to the rocker's
                                    # pivot, slider ahead: branch 0; or \"negative\": branch 1
  [points.coupler]                  # optional, for --paths: points of a link (crank, coupler, rocker;
  P = [\"20 cm\", \"5 cm\"]           # crank, rod, slider), from its first joint toward the second
  [bodies.coupler]                  # optional: adds I_n and M_o, and with crank_speed --reactions

With type = \"planar\", any mechanism with one degree of freedom; `mechaudit::book` has all of it:
  [points]                          # where points are in a drawing, if there is one
  A = [\"4.1 cm\", \"3.75 cm\"]
  [ground]
  drawn = [\"A\"]                     # or points = { A = [\"4.1 cm\", \"3.75 cm\"] }
  [[body]]
  name = \"crank\"
  drawn = [\"A\", \"B\"]                # or ends = [\"A\", \"B\"] with length, or three with sides, or
                                    # points = { A = [\"0 cm\", \"0 cm\"], … } in its own frame
  mass = \"1 kg\"                     # optional, with inertia (about the centre) and centre
  [[joint]]
  kind = \"pin\"                      # or \"slide\", \"slot\", \"gears\", \"rack\"
  point = \"A\"                       # joins all bodies that have it
  [drive]
  body = \"crank\"                    # or joint = the name of a slide, with range and step
  speed = \"60 rpm\"                  # optional";

/// Arguments of `linkage`.
#[derive(ClapArgs, Debug)]
pub struct LinkageArgs {
    /// The linkage in TOML or JSON; `-` reads standard input
    pub file: PathBuf,
    /// Step of the crank angle in degrees [default: 7.5; of a page, the 720th part of what there
    /// is]
    #[arg(long, value_name = "DEG", value_parser = Decimal::parse, allow_hyphen_values = true)]
    pub step_deg: Option<Decimal>,
    /// Form of the rows
    #[arg(long, value_enum, default_value = "csv")]
    pub format: RowsFormat,
    /// First crank angle in degrees [default: start.phi1 of the file, else 0]
    #[arg(long, value_name = "A", value_parser = Decimal::parse, allow_hyphen_values = true)]
    pub from_deg: Option<Decimal>,
    /// Last crank angle in degrees, itself included [default: one turn, its end left out]
    #[arg(long, value_name = "B", value_parser = Decimal::parse, allow_hyphen_values = true)]
    pub to_deg: Option<Decimal>,
    /// Follow the assembly mode of this number at the first crank angle, counted from 0 by phi4
    /// (four-bar, slider-crank: 0 positive, 1 negative assembly)
    #[arg(long, value_name = "N", conflicts_with = "all_branches", value_parser = number::index)]
    pub branch: Option<usize>,
    /// Every assembly mode at every crank angle, numbered by branch
    #[arg(long)]
    pub all_branches: bool,
    /// Certified decimals with this many significant digits instead of floating-point numbers
    #[arg(long, value_name = "N", value_parser = number::within::<u32>(1..=1000))]
    pub digits: Option<u32>,
    /// Positions, derivatives and curvature of the paths of all named points (not for type =
    /// "class-iii")
    #[arg(long)]
    pub paths: bool,
    /// Forces in the joints at the drive's speed and acceleration (not for type = "class-iii")
    #[arg(long)]
    pub reactions: bool,
    /// Draw mechanism.svg and, with masses, reduced.svg into this folder
    #[arg(long, value_name = "DIR")]
    pub svg: Option<PathBuf>,
    /// Draw mechanism.dxf into this folder: the position at --from-deg, else at the start, and the
    /// paths of all named points; in metres, or in the length among --units
    #[arg(long, value_name = "DIR")]
    pub dxf: Option<PathBuf>,
    #[command(flatten)]
    pub units: UnitsArgs,
    /// Write the rows or the page atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}
