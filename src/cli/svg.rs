//! Drawings of a linkage: sampling the branch, and the two files.

use super::branch::{Branch, Reach};
use super::complain;
use super::failure::Failure;
use super::linkage_file::Linkage;
use super::{svg_mechanism, svg_panel, svg_reduced};
use mechaudit::solvers::class_iii::State;
use std::f64::consts::TAU;
use std::path::Path;

/// Positions along the branch that the curves are drawn through.
const SAMPLES: u32 = 720;

/// Draws `mechanism.svg` and, with masses, `reduced.svg` into the folder, which is made if
/// missing.
pub fn draw(folder: &Path, linkage: &Linkage, branch: &Branch) -> Result<(), Failure> {
    let path = path(linkage, branch)?;
    let name = linkage.name.as_deref().unwrap_or("class-III linkage");
    let whole = matches!(branch.reach, Reach::Whole { .. });
    let save = |file: &str, text: String| svg_panel::save(folder, file, &text);
    let geometry = linkage.solver.geometry();
    save(
        "mechanism.svg",
        svg_mechanism::draw(name, geometry, &path, whole),
    )?;
    match &linkage.masses {
        Some(masses) => {
            let reduced: Vec<_> = path
                .iter()
                .map(|s| (s.phi1.to_degrees(), masses.solver.reduce(s)))
                .collect();
            save("reduced.svg", svg_reduced::draw(name, &reduced, whole)?)
        }
        None => {
            complain("reduced.svg is not drawn: the file gives no masses");
            Ok(())
        }
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
        .map_err(|(_, e)| Failure::new(e.to_string()))
}
