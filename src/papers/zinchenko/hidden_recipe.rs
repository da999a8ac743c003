//! The hidden recipe, shown from the printed tables alone: each column is a periodic cubic spline
//! through twelve nodes at rows 0, 4, 8, …
//!
//! Two arguments, neither of which uses the linkage:
//!
//! * **Projection.** The 48 printed values of a column lie in the 12-dimensional space of such
//!   splines (or their derivatives) up to rounding; in no space with fewer nodes, nor with the
//!   nodes moved by one to three rows.
//! * **Aliases.** A cubic spline through N equally spaced nodes has Fourier coefficients
//!   `c_m ∝ ŷ_{m mod N} m⁻⁴`, so `c_{k±12}/c_k = (k/(k±12))⁴`, and one power less for its
//!   derivative. Sampling 48 times adds the coefficients 48 apart, which is summed here.

use super::design::{TURN, least_squares, observed, read, spline_rows};
use super::tables::{COLUMNS, DERIVATIVE_SLOPE, INERTIA, INERTIA_SLOPE, is_slope};
use crate::papers::file::Measured;
use crate::papers::number::Number;
use crate::solvers::cubic_spline::{Boundary, Extrapolation, UniformCubicSpline};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// An alias of a harmonic.
#[derive(Clone, Copy, Debug)]
struct Alias {
    column: usize,
    alias: i32,
    /// Amplitude ratio `|Y_alias / Y_harmonic|` in the print.
    observed: f64,
    /// The same by the law.
    predicted: f64,
    /// Distance from the law in standard deviations of rounding.
    deviations: f64,
    /// The alias itself in standard deviations of rounding: how much there is to see.
    signal: f64,
}

/// Root mean square of a column's residuals against a space of splines over what rounding explains;
/// about 1 if it lies in it.
fn project(printed: &[Vec<Number>], column: usize, nodes: usize, offset: usize) -> f64 {
    let [b, mut sigma] = observed(&printed[column..=column]);
    let slope = is_slope(column);
    let design = spline_rows(nodes, offset, slope);
    let mut fit = least_squares(&design, &b, &sigma);
    // Misprints would spoil the column for the rest: up to two entries off by more than four
    // standard deviations get no weight.
    let mut dropped = 0;
    while dropped < 2 && fit.residuals.amax() > 4.0 {
        sigma[fit.residuals.iamax()] *= 1e9;
        fit = least_squares(&design, &b, &sigma);
        dropped += 1;
    }
    // The derivatives of splines have one dimension less: constants vanish.
    let free = (TURN - dropped - nodes + usize::from(slope)) as f64;
    (fit.residuals.norm_squared() / free).sqrt()
}

/// `Σ_j (m + 48 j)^(−p)` over all integers j, summed to where the tail is below rounding.
fn sampled_power(m: i32, p: i32) -> f64 {
    (-3000..=3000).map(|j| f64::from(m + 48 * j).powi(-p)).sum()
}

/// The aliases `k − 12` and `k + 12` of the harmonics 1 to 5.
fn aliases(printed: &[Vec<Number>]) -> Vec<Alias> {
    let mut found = Vec::new();
    for column in 0..6 {
        let [entries, sigma] = observed(&printed[column..=column]);
        let harmonic = |m: i32| -> Complex64 {
            let phase = |row: usize| -TAU * f64::from(m) * row as f64 / TURN as f64;
            let rows = entries.iter().enumerate();
            rows.map(|(row, x)| Complex64::from_polar(*x, phase(row)))
                .sum()
        };
        let deviation = sigma.norm();
        let p = if is_slope(column) { 3 } else { 4 };
        for (k, m) in (1..=5).flat_map(|k| [(k, k - 12), (k, k + 12)]) {
            let law = sampled_power(m, p) / sampled_power(k, p);
            let (y, z) = (harmonic(k), harmonic(m));
            found.push(Alias {
                column,
                alias: m,
                observed: (z / y).norm(),
                predicted: law.abs(),
                deviations: (z - y * law).norm() / deviation,
                signal: z.norm() / deviation,
            });
        }
    }
    found
}

/// Worst deviation of the printed S'_In from the derivative of a spline through the thirteen
/// printed I_n of rows 0, 4, …, 48, with the given ends.
fn ends_misfit(printed: &[Vec<Number>], ends: Boundary) -> f64 {
    let nodes = printed[INERTIA].iter().step_by(4).map(|e| read(e)[0]);
    let spline = UniformCubicSpline::fit(0.0, TAU / 12.0, nodes.collect(), ends)
        .expect("a spline through printed numbers")
        .with_extrapolation(Extrapolation::Clamp);
    let slopes = printed[INERTIA_SLOPE].iter().enumerate();
    slopes.fold(0.0, |worst, (row, e)| {
        let x = row as f64 * (TAU / TURN as f64);
        let s = spline.jet(x).expect("within the turn or clamped").first;
        f64::max(worst, (s - read(e)[0]).abs())
    })
}

/// The columns against splines through 12 nodes and through others, their clear aliases, and the
/// ends.
pub(super) fn measure(printed: &[Vec<Number>], measured: &mut Measured) {
    let of = |nodes, offset| (0..6).map(move |c| (c, project(printed, c, nodes, offset)));
    let worst = of(12, 0)
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .expect("columns");
    measured.text("worst_column", COLUMNS[worst.0].1);
    measured.set("twelve", worst.1);
    // Splines through 12 nodes are splines through 24.
    let others = [(6, 0), (8, 0), (16, 0), (12, 1), (12, 2), (12, 3)].into_iter();
    let others = others.flat_map(|(nodes, offset)| of(nodes, offset).map(|p| p.1));
    measured.set("next_best", others.fold(f64::INFINITY, f64::min));
    let mut clear = aliases(printed);
    clear.retain(|a| a.signal > 20.0);
    let on_law = |a: &&Alias| 5.0 * (a.observed - a.predicted).abs() < a.predicted;
    measured.set("clear", clear.len() as f64);
    measured.set("on_law", clear.iter().filter(on_law).count() as f64);
    // Row 11 of S'_dIn is misprinted by 20 units, which no harmonic escapes.
    let off = clear
        .iter()
        .filter(|a| a.column != DERIVATIVE_SLOPE)
        .map(|a| a.deviations);
    measured.set("off_law", off.fold(0.0, f64::max));
    for a in clear.iter().filter(|a| a.column == INERTIA) {
        let m = a.alias.abs();
        measured.set(format!("alias_{m}"), a.observed);
        measured.set(format!("law_{m}"), a.predicted);
    }
    for (name, ends) in [
        ("periodic", Boundary::Periodic),
        ("natural", Boundary::NATURAL),
    ] {
        measured.set(name, ends_misfit(printed, ends));
    }
}

#[cfg(test)]
mod tests {
    use super::super::tables::printed;
    use super::*;

    #[test]
    fn only_twelve_nodes_at_row_0_fit() {
        let printed = printed();
        for (nodes, offset) in [
            (6, 0),
            (8, 0),
            (12, 0),
            (16, 0),
            (24, 0),
            (12, 1),
            (12, 2),
            (12, 3),
        ] {
            for column in 0..6 {
                let ratio = project(&printed, column, nodes, offset);
                let fits = matches!((nodes, offset), (12 | 24, 0));
                assert_eq!(ratio < 1.5, fits, "{column} {nodes} {offset}: {ratio}");
                assert!(fits || ratio > 10.0, "{column} {nodes} {offset}: {ratio}");
            }
        }
    }

    #[test]
    fn aliases_follow_the_law() {
        let all = aliases(&printed());
        let clear: Vec<&Alias> = all.iter().filter(|a| a.signal > 20.0).collect();
        assert!(clear.len() >= 20, "{}", clear.len());
        for a in clear {
            let limit = if a.column == DERIVATIVE_SLOPE {
                15.0
            } else {
                5.0
            };
            assert!(a.deviations < limit, "{a:?}");
        }
    }
}
