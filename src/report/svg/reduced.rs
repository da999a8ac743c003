//! The reduced quantities over the crank angle, in three panels.

use super::panel::{CannotDraw, Curve, curve, drawn, panel_over, titled};
use super::style::{BLUE, GREEN, ORANGE};
use crate::solvers::reduction::Reduced;
use plotters::style::RGBColor;

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
pub fn draw(name: &str, rows: &[(f64, Reduced)], whole: bool) -> Result<String, CannotDraw> {
    let note = match whole {
        true => "",
        false => {
            "the crank does not turn fully; beyond the drawing the curves grow without bound at both ends"
        }
    };
    let (first, last) = match rows {
        [] => (0.0, 0.0),
        [(first, _), .., (last, _)] => (*first, *last),
        [(only, _)] => (*only, *only),
    };
    drawn((1000, 1080), |root, page| {
        let areas = titled(root, page, name, note)?.split_evenly((PANELS.len(), 1));
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
            panel_over((first, last), area, page, (angle, label), &curves)?;
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::super::panel::tests::points;
    use super::*;

    /// The middle nine tenths of a part of the turn are within the drawing, its ends without.
    #[test]
    fn what_grows_without_bound_at_the_ends_is_cut_off() {
        let row = |k: u32| {
            let moment = if [0, 19].contains(&k) {
                1e9
            } else {
                f64::from(k)
            };
            let reduced = Reduced {
                inertia_kg_m2: 1.0,
                inertia_derivative_kg_m2: 1.0,
                moment_n_m: moment,
                moment_derivative_n_m: 0.0,
            };
            (f64::from(k), reduced)
        };
        let rows: Vec<(f64, Reduced)> = (0..20).map(row).collect();
        let drawn = |whole| points(&draw("a", &rows, whole).unwrap()).len();
        assert_eq!((drawn(false), drawn(true)), (18, 20));
    }
}
