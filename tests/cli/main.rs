//! The program as its user meets it: output, messages and exit codes.
#![cfg(feature = "cli")]

// As in the program.
#[allow(unused_extern_crates)]
extern crate mechaudit_cli as mechaudit;

mod bounds;
#[cfg(unix)]
mod campaign;
#[cfg(unix)]
mod candidates;
mod chirp;
mod common;
mod compare;
mod dyad;
mod eval;
mod eval_chirp;
mod examples;
mod hunt;
mod identity;
mod interrupt;
#[cfg(unix)]
mod judge;
mod linkage;
mod linkage_files;
mod mechanism_motion;
mod motion;
mod output;
mod papers;
mod pinned;
mod planar;
mod planar_ranks;
mod prove;
mod regenerate;
mod reports;
mod runup;
#[cfg(unix)]
mod samples;
mod shown;
mod studies;
mod study_algebra;
mod study_commands;
mod usage;
