//! The file that describes a machine, as the arguments name it.

use crate::cli::failure::Failure;
use mechaudit::machine::Source;
use std::path::Path;

/// The file, or standard input for `-`.
pub fn open(path: &Path) -> Result<Source, Failure> {
    let source = match path == Path::new("-") {
        true => Source::read(std::io::stdin().lock(), None),
        false => Source::open(path),
    };
    source.map_err(|e| Failure::in_file(path, e))
}
