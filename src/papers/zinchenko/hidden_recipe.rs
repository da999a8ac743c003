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

use super::design::{TURN, least_squares, rounding_deviation, spline_rows};
use super::tables::{Column, Printed, Source, column};
use crate::solvers::cubic_spline::{Boundary, Extrapolation, UniformCubicSpline};
use nalgebra::DVector;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// How well a column lies in a space of splines.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projection {
    pub column: Column,
    pub nodes: usize,
    pub offset: usize,
    /// Root mean square of the residuals over what rounding explains; about 1 if it fits.
    pub ratio: f64,
}

/// An alias of a harmonic.
#[derive(Clone, Copy, Debug)]
pub(super) struct Alias {
    pub column: Column,
    pub harmonic: i32,
    pub alias: i32,
    /// Amplitude ratio `|Y_alias / Y_harmonic|` in the print.
    pub observed: f64,
    /// The same by the law.
    pub predicted: f64,
    /// Distance from the law in standard deviations of rounding.
    pub deviations: f64,
    /// The alias itself in standard deviations of rounding: how much there is to see.
    pub signal: f64,
}

impl Alias {
    /// Returns true if it is within a fifth of the law.
    pub(super) fn follows_law(&self) -> bool {
        5.0 * (self.observed - self.predicted).abs() < self.predicted
    }
}

/// Columns that are splines themselves (the difference column is not one).
const SPLINES: [Column; 6] = [
    Column::Inertia,
    Column::InertiaSlope,
    Column::Derivative,
    Column::DerivativeSlope,
    Column::Moment,
    Column::MomentSlope,
];

pub(super) fn is_slope(column: Column) -> bool {
    matches!(
        column.source(),
        Source::Inertia(true) | Source::Derivative(true) | Source::Moment(true)
    )
}

/// Residuals of a column against a space of splines.
pub(super) fn project(printed: &[Printed], c: Column, nodes: usize, offset: usize) -> Projection {
    let entries = column(printed, c);
    let b = DVector::from_fn(TURN, |row, _| entries[row].to_f64());
    let mut sigma = DVector::from_fn(TURN, |row, _| rounding_deviation(entries[row].unit()));
    let slope = is_slope(c);
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
    let kept = fit.residuals.norm_squared();
    Projection {
        column: c,
        nodes,
        offset,
        ratio: (kept / free).sqrt(),
    }
}

/// Every column against 6, 8, 12, 16 and 24 nodes at row 0, and 12 nodes at rows 1, 2, 3.
pub(super) fn projections(printed: &[Printed]) -> Vec<Projection> {
    let spaces = [
        (6, 0),
        (8, 0),
        (12, 0),
        (16, 0),
        (24, 0),
        (12, 1),
        (12, 2),
        (12, 3),
    ];
    SPLINES
        .iter()
        .flat_map(|&c| spaces.map(|(nodes, offset)| project(printed, c, nodes, offset)))
        .collect()
}

/// `Σ_j (m + 48 j)^(−p)` over all integers j, summed to where the tail is below rounding.
fn sampled_power(m: i32, p: i32) -> f64 {
    (-3000..=3000).map(|j| f64::from(m + 48 * j).powi(-p)).sum()
}

/// The aliases `k − 12` and `k + 12` of the harmonics 1 to 5.
pub(super) fn aliases(printed: &[Printed]) -> Vec<Alias> {
    let mut found = Vec::new();
    for c in SPLINES {
        let entries = column(printed, c);
        let harmonic = |m: i32| -> Complex64 {
            (0..TURN)
                .map(|row| {
                    let phase = -TAU * f64::from(m) * row as f64 / TURN as f64;
                    Complex64::from_polar(entries[row].to_f64(), phase)
                })
                .sum()
        };
        let variance: f64 = entries[..TURN]
            .iter()
            .map(|e| rounding_deviation(e.unit()).powi(2))
            .sum();
        let deviation = variance.sqrt();
        let p = if is_slope(c) { 3 } else { 4 };
        for k in 1..=5 {
            for m in [k - 12, k + 12] {
                let law = sampled_power(m, p) / sampled_power(k, p);
                let (y, z) = (harmonic(k), harmonic(m));
                found.push(Alias {
                    column: c,
                    harmonic: k,
                    alias: m,
                    observed: (z / y).norm(),
                    predicted: law.abs(),
                    deviations: (z - y * law).norm() / deviation,
                    signal: z.norm() / deviation,
                });
            }
        }
    }
    found
}

/// Worst deviation of the printed S'_In from the derivative of a spline through the thirteen
/// printed I_n of rows 0, 4, …, 48, with the given ends.
pub(super) fn ends_misfit(printed: &[Printed], ends: Boundary) -> f64 {
    let inertia = column(printed, Column::Inertia);
    let slope = column(printed, Column::InertiaSlope);
    let nodes = inertia.iter().step_by(4).map(|e| e.to_f64()).collect();
    let spline = UniformCubicSpline::fit(0.0, TAU / 12.0, nodes, ends)
        .expect("a spline through printed numbers")
        .with_extrapolation(Extrapolation::Clamp);
    slope.iter().fold(0.0, |worst, e| {
        let x = e.row as f64 * (TAU / TURN as f64);
        let s = spline.jet(x).expect("within the turn or clamped").first;
        f64::max(worst, (s - e.to_f64()).abs())
    })
}

#[cfg(test)]
mod tests {
    use super::super::tables::printed;
    use super::*;

    #[test]
    fn only_twelve_nodes_at_row_0_fit() {
        let all = projections(&printed());
        let tried = all
            .chunks(8)
            .map(|c| [0, 1, 2, 3, 4, 5, 6, 7].map(|k| (c[k].nodes, c[k].offset)));
        for spaces in tried {
            let at_row_0 = [6, 8, 12, 16, 24].map(|nodes| (nodes, 0));
            let moved = [1, 2, 3].map(|offset| (12, offset));
            assert_eq!(spaces[..], [&at_row_0[..], &moved].concat());
        }
        for p in all {
            let fits = matches!((p.nodes, p.offset), (12 | 24, 0));
            assert_eq!(p.ratio < 1.5, fits, "{p:?}");
            assert!(fits || p.ratio > 10.0, "{p:?}");
        }
    }

    #[test]
    fn a_fifth_is_off_the_law() {
        let follows = |observed: f64| {
            let alias = Alias {
                column: Column::Inertia,
                harmonic: 1,
                alias: 13,
                observed,
                predicted: 5.0,
                deviations: 0.0,
                signal: 0.0,
            };
            alias.follows_law()
        };
        assert!([4.1, 5.0, 5.9].into_iter().all(follows));
        assert!(![4.0, 6.0].into_iter().any(follows));
    }

    #[test]
    fn aliases_follow_the_law() {
        let all = aliases(&printed());
        let clear: Vec<&Alias> = all.iter().filter(|a| a.signal > 20.0).collect();
        assert!(clear.len() >= 20, "{}", clear.len());
        for a in clear {
            // Row 11 of S'_dIn is misprinted by 20 units, which no harmonic escapes.
            let limit = if a.column == Column::DerivativeSlope {
                15.0
            } else {
                5.0
            };
            assert!(a.deviations < limit, "{a:?}");
        }
    }
}
