//! The program as its user meets it: output, messages and exit codes.
#![cfg(feature = "cli")]

mod chirp;
#[path = "../common/mod.rs"]
mod common;
mod dyad;
mod eval;
mod eval_chirp;
mod interrupt;
mod linkage;
mod linkage_files;
mod output;
mod papers;
mod regenerate;
mod runup;
mod usage;
