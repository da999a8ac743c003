//! A skeleton of a paper.

use crate::cli::failure::{Failure, Outcome};
use mechaudit::papers::file::SKELETON;
use std::io::Write;
use std::path::Path;

/// Writes the skeleton to a folder; files that are there are left alone.
pub fn write(folder: &Path) -> Result<Outcome, Failure> {
    std::fs::create_dir_all(folder).map_err(|e| Failure::cannot("create", folder, e))?;
    let taken = SKELETON
        .iter()
        .map(|(name, _)| folder.join(name))
        .find(|path| path.exists());
    if let Some(path) = taken {
        return Err(Failure::new(format!("{} is there already", path.display())));
    }
    for (name, text) in SKELETON {
        let path = folder.join(name);
        let file = std::fs::File::create_new(&path);
        let written = file.and_then(|mut file| file.write_all(text.as_bytes()));
        written.map_err(|e| Failure::cannot("write", &path, e))?;
    }
    println!("{0}: run mechaudit paper {0}", folder.display());
    Ok(Outcome::AsExpected)
}
