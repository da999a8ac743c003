//! Error maps: a method of one complex variable, judged at a grid of points of the plane.

use super::case::{Case, Origin};
use super::judge::Verdict;
use super::judged::{answer_of, judge_case_briefly};
use super::method::Method;
use super::settings::Settings;
use rayon::prelude::*;
use serde::Serialize;
use std::sync::atomic::{AtomicBool, Ordering};

/// Columns and rows.
const GRID: [usize; 2] = [144, 104];
/// Lower left corner of the part of the plane, and the side of a cell.
const CORNER: [f64; 2] = [-9.0, -6.5];
const SIDE: f64 = 0.125;
/// Points lie off the middle of their cells by something that is no simple fraction.
const WITHIN: f64 = 0.527_864;

/// Errors over a part of the complex plane. The points are no cases: they do not count in the
/// verdict on the method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorMap {
    /// Cells along the real axis.
    pub columns: usize,
    /// Cells along the imaginary axis.
    pub rows: usize,
    /// Real and imaginary part of the lower left corner.
    pub corner: [f64; 2],
    /// Side of a cell.
    pub side: f64,
    /// For each output.
    pub outputs: Vec<MapOutput>,
    /// Points at which the method is over budget, wrong in kind or undecided.
    pub not_passed: usize,
}

/// The errors of one output.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MapOutput {
    /// The output.
    pub name: &'static str,
    /// In ulps, row by row from below; NaN where a value is no number or wrong in kind.
    pub ulps: Vec<f64>,
}

impl ErrorMap {
    /// Returns the number of points.
    pub fn points(&self) -> usize {
        self.columns * self.rows
    }

    /// The point judged in a cell.
    pub fn at(&self, column: usize, row: usize) -> [f64; 2] {
        let place = |k: usize, from: f64| from + self.side * (k as f64 + WITHIN);
        [place(column, self.corner[0]), place(row, self.corner[1])]
    }
}

/// Returns the number of points of the method's map; none if it is no function of one complex
/// variable.
pub fn map_points(method: &dyn Method) -> Option<usize> {
    let names: Vec<&str> = method.inputs().iter().map(|i| i.name).collect();
    let complex = matches!(names[..], [re, im] if re.starts_with("Re ") && im.starts_with("Im "));
    complex.then_some(GRID[0] * GRID[1])
}

/// The method's error map, judged on all cores. None if it has none ([`map_points`]), or if `stop`
/// was set before its end. `progress` is called once for each point.
pub fn error_map(
    method: &dyn Method,
    settings: &Settings,
    progress: &(dyn Fn() + Sync),
    stop: &AtomicBool,
) -> Option<ErrorMap> {
    let points = map_points(method)?;
    let [columns, rows] = GRID;
    let place = |k: usize, from: f64| from + SIDE * (k as f64 + WITHIN);
    let judged: Option<Vec<(Vec<f64>, bool)>> = (0..points)
        .into_par_iter()
        .map(|i| {
            if stop.load(Ordering::Relaxed) {
                return None;
            }
            let input = vec![place(i % columns, CORNER[0]), place(i / columns, CORNER[1])];
            let answer = answer_of(method, &input);
            let case = Case {
                method: method.name(),
                region: "map",
                input,
                origin: Origin::Given,
            };
            let judgement = judge_case_briefly(method, case, answer, settings).judgement;
            progress();
            let ulps = match judgement.verdict {
                Verdict::Pass | Verdict::Over => {
                    judgement.components.iter().map(|c| c.ulps).collect()
                }
                _ => Vec::new(),
            };
            Some((ulps, judgement.verdict == Verdict::Pass))
        })
        .collect();
    let judged = judged?;
    let of = |o: usize| judged.iter().map(move |(u, _)| u.get(o).copied());
    let outputs = method.outputs().into_iter().enumerate();
    let outputs = outputs.map(|(o, output)| MapOutput {
        name: output.name,
        ulps: of(o).map(|u| u.unwrap_or(f64::NAN)).collect(),
    });
    Some(ErrorMap {
        columns,
        rows,
        corner: CORNER,
        side: SIDE,
        outputs: outputs.collect(),
        not_passed: judged.iter().filter(|(_, passed)| !passed).count(),
    })
}

#[cfg(test)]
mod tests;
