//! The reduced quantities over the crank angle, in three panels.

use super::panel::{Curve, curve, drawn, panel_over, titled};
use super::style::{BLUE, GREEN, ORANGE, RGBColor};
use crate::solvers::reduction::Reduced;

/// A label, a colour and what is drawn.
type Course = (&'static str, RGBColor, fn(&Reduced) -> f64);

const PANELS: [Course; 3] = [
    ("I_n, kg·m²", BLUE, |r| r.inertia_kg_m2),
    ("dI_n/dφ1, kg·m²/rad", ORANGE, |r| {
        r.inertia_derivative_kg_m2
    }),
    ("M_o, N·m", GREEN, |r| r.moment_n_m),
];

/// The drawing of (crank angle in degrees, reduced quantities).
///
/// Beside the ends of a branch the quantities grow without bound; where the rows are not a `whole`
/// turn, the vertical range is that of their middle nine tenths.
pub fn draw(name: &str, rows: &[(f64, Reduced)], whole: bool) -> String {
    let note = match whole {
        true => "",
        false => {
            "the crank does not turn fully; beyond the drawing the curves grow without bound at both ends"
        }
    };
    let at = |row: Option<&(f64, Reduced)>| row.map_or(0.0, |r| r.0);
    let (first, last) = (at(rows.first()), at(rows.last()));
    drawn((1000, 1080), |root, page| {
        let areas = titled(root, page, name, note).split(PANELS.len(), 1);
        for (k, (area, (label, colour, value))) in areas.iter().zip(PANELS).enumerate() {
            let skip = if whole { 0 } else { rows.len() / 20 };
            let middle = rows[skip..rows.len() - skip].iter();
            let (low, high) = middle
                .map(|(_, r)| value(r))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
                    (a.min(v), b.max(v))
                });
            let line: Vec<(f64, f64)> = rows.iter().map(|(x, r)| (*x, value(r))).collect();
            let seen = line.split(|p| !(low..=high).contains(&p.1));
            let curves: Vec<Curve> = seen
                .filter(|part| !part.is_empty())
                .map(|part| curve("", part.to_vec(), colour))
                .collect();
            let angle = match k + 1 == PANELS.len() {
                true => "crank angle φ1, degrees",
                false => "",
            };
            panel_over((first, last), area, page, (angle, label), &curves);
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::gallery::Gallery;

    /// A curve that leaves the range of the middle nine tenths is cut off, and comes back behind a
    /// gap.
    #[test]
    fn turns_and_parts_of_turns() {
        let rows = |values: &[f64]| {
            let row = |(k, v): (usize, &f64)| {
                let reduced = Reduced {
                    inertia_kg_m2: *v,
                    inertia_derivative_kg_m2: 2.0 * v,
                    moment_n_m: -v,
                    moment_derivative_n_m: 0.0,
                };
                (k as f64, reduced)
            };
            values.iter().enumerate().map(row).collect::<Vec<_>>()
        };
        let slope = |n: u32| (0..n).map(f64::from).collect::<Vec<f64>>();
        let mut back = slope(20);
        (back[19], back[0]) = (10.0, 1e9);
        let mut all = Gallery::default();
        for (values, whole) in [
            (slope(3), true),
            (slope(19), false),
            (slope(20), false),
            (Vec::new(), false),
            (back, false),
        ] {
            let name = format!("{} rows, whole {whole}", values.len());
            all.add(name, draw("a", &rows(&values), whole));
        }
        all.pin("reduced");
    }
}
