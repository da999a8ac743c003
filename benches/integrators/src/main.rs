//! Runs the integrators of Rust crates on the problems of the atlas and prints where they end.
//!
//! A line is `problem,method,tolerance,evaluations,seconds` and the states at the end with 17
//! digits, or nothing after the tolerance where the crate gives up. `atlas.py` compares them with
//! certified states. Seconds are processor time, the least of three runs.

mod crates;
mod problems;

use problems::{Arenstorf, Hires, Kepler, Lorenz, Pleiades, VanDerPol};

/// The relative tolerances; absolute ones are a thousandth.
const TOLERANCES: [f64; 6] = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13];

fn main() {
    crates::run::<Lorenz, 3>();
    crates::run::<Kepler, 4>();
    crates::run::<Arenstorf, 4>();
    crates::run::<Pleiades, 28>();
    crates::run::<VanDerPol, 2>();
    crates::run::<Hires, 8>();
}
