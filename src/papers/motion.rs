//! A paper's mechanism in motion: what an animation shows beside its reduced quantities.

use serde::Serialize;

/// A mechanism over one turn of its crank, at equal steps.
#[derive(Clone, Debug, Serialize)]
pub struct Motion {
    /// What moves.
    pub name: &'static str,
    /// Crank angles in degrees.
    pub crank_deg: Vec<f64>,
    /// Points in the order in which links name them: the fixed pivots first.
    pub points: Vec<Point>,
    /// Links between two points, by their indices.
    pub links: Vec<[usize; 2]>,
    /// Links of three points.
    pub plates: Vec<[usize; 3]>,
    /// Quantities over the crank angle.
    pub courses: Vec<Course>,
}

/// A point of the mechanism.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// Its letter.
    pub label: &'static str,
    /// Where it is, in metres: one place for a pivot, else one for each crank angle.
    pub path: Vec<[f64; 2]>,
}

/// A quantity over the crank angle.
#[derive(Clone, Debug, Serialize)]
pub struct Course {
    /// Its symbol.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Computed, by variant of the data, at each crank angle.
    pub variants: Vec<(&'static str, Vec<f64>)>,
    /// As printed: crank angle in degrees and value.
    pub printed: Vec<(f64, f64)>,
}

impl Motion {
    /// Least and largest coordinates of all points: `[[x, x], [y, y]]`, in metres.
    pub fn extent(&self) -> [[f64; 2]; 2] {
        let places = || self.points.iter().flat_map(|p| &p.path);
        [0, 1].map(|i| {
            let along = || places().map(|p| p[i]);
            let least = along().fold(f64::INFINITY, f64::min);
            [least, along().fold(f64::NEG_INFINITY, f64::max)]
        })
    }
}
