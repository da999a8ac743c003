//! Drawings of a linkage of class III: the two files.

use crate::cli::complain;
use crate::cli::failure::Failure;
use crate::cli::files::output::Output;
use mechaudit::machine::class_iii::{Branch, Linkage, path};
use mechaudit::report::svg::linkage::{self as drawn, SAMPLES};
use mechaudit::report::svg::reduced;
use std::path::Path;

/// The files that they go to.
pub struct Drawings {
    mechanism: Output,
    /// With masses.
    reduced: Option<Output>,
}

impl Drawings {
    /// `mechanism.svg` and, with masses, `reduced.svg` in the folder, which is made if missing.
    pub fn open(folder: &Path, linkage: &Linkage) -> Result<Drawings, Failure> {
        let masses = linkage.masses.as_ref();
        let reduced = masses.map(|_| Output::within(folder, "reduced.svg"));
        Ok(Drawings {
            mechanism: Output::within(folder, "mechanism.svg")?,
            reduced: reduced.transpose()?,
        })
    }

    pub fn draw(self, linkage: &Linkage, branch: &Branch) -> Result<(), Failure> {
        let path = path(linkage, branch, SAMPLES).map_err(Failure::caused)?;
        self.mechanism
            .text(drawn::class_iii(linkage, branch, &path))?;
        let (Some(masses), Some(drawing)) = (&linkage.masses, self.reduced) else {
            complain("reduced.svg is not drawn: the file gives no masses");
            return Ok(());
        };
        let name = linkage.name.as_deref().unwrap_or("class-III linkage");
        let whole = branch.reach.is_whole();
        let rows: Vec<_> = path
            .iter()
            .map(|s| (s.phi1.to_degrees(), masses.solver.reduce(s)))
            .collect();
        drawing.text(reduced::draw(name, &rows, whole))
    }
}
