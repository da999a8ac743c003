//! Drawings of a linkage: sampling the branch, and the two files.

use super::complain;
use super::failure::Failure;
use super::output::Output;
use super::{svg_mechanism, svg_reduced};
use mechaudit::machine::class_iii::{Branch, Linkage, Reach};
use mechaudit::solvers::class_iii::State;
use std::f64::consts::TAU;
use std::path::Path;

/// Positions along the branch that the curves are drawn through.
const SAMPLES: u32 = 720;

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
        let path = path(linkage, branch)?;
        let name = linkage.name.as_deref().unwrap_or("class-III linkage");
        let whole = matches!(branch.reach, Reach::Whole { .. });
        let geometry = linkage.solver.geometry();
        let text = svg_mechanism::draw(name, geometry, &path, whole);
        self.mechanism.text(&text)?;
        let (Some(masses), Some(drawing)) = (&linkage.masses, self.reduced) else {
            complain("reduced.svg is not drawn: the file gives no masses");
            return Ok(());
        };
        let reduced: Vec<_> = path
            .iter()
            .map(|s| (s.phi1.to_degrees(), masses.solver.reduce(s)))
            .collect();
        drawing.text(&svg_reduced::draw(name, &reduced, whole)?)
    }
}

/// The branch over one turn from its start, or over its whole range.
fn path(linkage: &Linkage, branch: &Branch) -> Result<Vec<State>, Failure> {
    let (from, to) = match branch.reach {
        Reach::Whole { .. } => (branch.start.phi1, branch.start.phi1 + TAU),
        Reach::Part { low, high } => (low.reached, high.reached),
    };
    let angles = (0..=SAMPLES).map(|k| from + (to - from) * f64::from(k) / f64::from(SAMPLES));
    linkage
        .solver
        .sweep(&branch.start, angles)
        .map_err(|(_, e)| Failure::caused(e))
}
