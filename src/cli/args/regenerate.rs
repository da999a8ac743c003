//! Arguments of `mechaudit regenerate`.

use clap::Args as ClapArgs;
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit regenerate --check                 compare all of it, write nothing
  mechaudit regenerate faddeeva four-bar       write two files anew
  mechaudit regenerate --check --root ../other faddeeva-tables

Names are those of the methods, whose values at cases of every region go to reference/values, \
and sand-screen-run-up, andrews-motion, n-four-bar-motion, zinchenko-errata, gembara-senyk-errata, \
andrews-errata, n-four-bar-errata, pmksweb-errata, faddeeva-tables, faddeeva-constants, faddeeva-relatives-tables, columns (the chapter of the book). The header of each file says how it was made, \
with which precision, seed and counts, and holds SHA-256 digests of recipe and content.

Exit codes: 0, every file is what the references give, or written; 1, one that is not, named \
with the first line that differs, or a value left undecided; 2, bad usage.";

/// Arguments of `regenerate`.
#[derive(ClapArgs, Debug)]
pub struct RegenerateArgs {
    /// The files to make; all if left out
    #[arg(value_name = "NAME")]
    pub names: Vec<String>,
    /// Compare with the files, byte for byte, instead of writing them
    #[arg(long)]
    pub check: bool,
    /// Folder of mechaudit's sources
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub root: PathBuf,
}
