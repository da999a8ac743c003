//! Drawings of a linkage: sampling the branch, and the two files.

use crate::cli::complain;
use crate::cli::failure::Failure;
use crate::cli::files::output::Output;
use mechaudit::machine::class_iii::{Branch, Linkage, Reach};
use mechaudit::report::svg::reduced;
use mechaudit::report::svg::scene::{Bar, Joint, Pivot, Pose, Scene};
use mechaudit::solvers::class_iii::{Geometry, State};
use mechaudit::solvers::units::Angle;
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
        self.mechanism
            .text(&mechanism(name, geometry, &path, whole))?;
        let (Some(masses), Some(drawing)) = (&linkage.masses, self.reduced) else {
            complain("reduced.svg is not drawn: the file gives no masses");
            return Ok(());
        };
        let rows: Vec<_> = path
            .iter()
            .map(|s| (s.phi1.to_degrees(), masses.solver.reduce(s)))
            .collect();
        drawing.text(&reduced::draw(name, &rows, whole)?)
    }
}

/// The branch over one turn from its start, or over its whole range.
fn path(linkage: &Linkage, branch: &Branch) -> Result<Vec<State>, Failure> {
    let (from, to) = match branch.reach {
        Reach::Whole { .. } => (branch.start.phi1, branch.start.phi1 + TAU),
        Reach::Part { low, high } => (low.reached, high.reached),
    };
    let angle = |k: u32| from + (to - from) * f64::from(k) / f64::from(SAMPLES);
    let angles = (0..=SAMPLES).map(|k| Angle::from_rad(angle(k)));
    linkage
        .solver
        .sweep(&branch.start, angles)
        .map_err(|(_, e)| Failure::caused(e))
}

/// The mechanism at its positions.
fn mechanism(name: &str, geometry: &Geometry, path: &[State], whole: bool) -> String {
    let g = geometry;
    let [o1, o3, o5] = [[0.0; 2], [g.x3.m(), g.y3.m()], [g.x5.m(), g.y5.m()]];
    let pivot = |label, at, joint| Pivot { label, at, joint };
    let joints = [
        ("A", "#8a8f98"),
        ("B", "#c2571a"),
        ("C", "#1f6fb2"),
        ("D", "#2f8f4e"),
    ];
    let pose = |s: &State| {
        let [a, b, c, d] = s.joints();
        let bars = [
            ("1", [o1, a]),
            ("2", [a, b]),
            ("3", [o3, c]),
            ("5", [o5, d]),
        ];
        Pose {
            crank_deg: s.phi1.to_degrees(),
            joints: vec![a, b, c, d],
            bars: bars.map(|(label, ends)| Bar { label, ends }).to_vec(),
            plate: Some(("4", [b, c, d])),
        }
    };
    let scene = Scene {
        name,
        pivots: &[pivot("O1", o1, 0), pivot("O3", o3, 2), pivot("O5", o5, 3)],
        joints: &joints.map(|(label, colour)| Joint { label, colour }),
        guide: None,
        path: &path.iter().map(pose).collect::<Vec<_>>(),
        whole,
    };
    scene.draw()
}
