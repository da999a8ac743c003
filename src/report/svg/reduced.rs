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
    use super::super::panel::tests::{curves, points, texts};
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
        let drawn = |whole| points(&draw("a", &rows, whole)).len();
        assert_eq!((drawn(false), drawn(true)), (18, 20));
    }

    fn rows(values: &[f64]) -> Vec<(f64, Reduced)> {
        let row = |(k, v): (usize, &f64)| {
            let reduced = Reduced {
                inertia_kg_m2: *v,
                inertia_derivative_kg_m2: 2.0 * v,
                moment_n_m: -v,
                moment_derivative_n_m: 0.0,
            };
            (k as f64, reduced)
        };
        values.iter().enumerate().map(row).collect()
    }

    /// A twentieth of the rows at each end is not asked for the range, and may lie in it all the
    /// same.
    #[test]
    fn the_range_is_that_of_the_middle() {
        let slope = |n: u32| (0..n).map(f64::from).collect::<Vec<f64>>();
        let counted = |values: &[f64], whole| {
            let lines = curves(&draw("a", &rows(values), whole));
            lines.iter().map(Vec::len).collect::<Vec<_>>()
        };
        assert_eq!(counted(&slope(40), false), [36; 3]);
        assert_eq!(counted(&slope(40), true), [40; 3]);
        assert_eq!(counted(&slope(39), false), [37; 3]);
        assert_eq!(counted(&slope(19), false), [19; 3]);
        assert_eq!(counted(&slope(1), false), [1; 3]);
        assert!(counted(&[], false).is_empty());
        // A curve that comes back has a gap.
        let mut inside = slope(40);
        inside[39] = 20.0;
        assert_eq!(counted(&inside, false), [36, 1, 36, 1, 36, 1]);
        // Values cut off at both ends leave the abscissa as long as it is.
        let svg = draw("a", &rows(&slope(40)), false);
        let line = &curves(&svg)[0];
        let at = |k: f64| 102.0 + k / 39.0 * (955.0 - 102.0);
        assert!((line[0].0 - at(2.0)).abs() < 0.011 && (line[35].0 - at(37.0)).abs() < 0.011);
    }

    #[test]
    fn only_the_lowest_panel_names_the_angle() {
        for whole in [true, false] {
            let svg = draw("a", &rows(&[1.0, 2.0, 3.0]), whole);
            let texts = texts(&svg);
            for (text, n) in [
                ("crank angle φ1, degrees", 1),
                ("I_n, kg·m²", 1),
                ("dI_n/dφ1, kg·m²/rad", 1),
                ("M_o, N·m", 1),
            ] {
                assert_eq!(texts.iter().filter(|t| **t == text).count(), n, "{text}");
            }
            assert!(svg.contains("viewBox=\"0 0 1000 1080\""));
            let noted = texts.iter().any(|t| t.contains("does not turn fully"));
            assert_eq!(noted, !whole);
            // Rising, twice as steep, falling.
            let lines = curves(&svg);
            assert!(lines[0][0].1 > lines[0][2].1 && lines[2][0].1 < lines[2][2].1);
        }
    }
}
