//! Identities that splines on arbitrary knots have to satisfy bit for bit.

use super::cubic_spline_common::Kind;
use crate::audit::{Law, SolverAnswer};

impl Kind {
    /// `S(x_i) = y_i` bit for bit.
    pub(super) fn knots_residual(self, input: &[f64]) -> Option<f64> {
        let p = self.split(input)?;
        let s = self.fit(&p).ok()?;
        let hit = |(x, y): (&f64, &f64)| s.value(*x).is_ok_and(|v| v == *y);
        Some(if p.x.iter().zip(p.y).all(hit) {
            0.0
        } else {
            f64::INFINITY
        })
    }

    /// Abscissae times 4 and ordinates times 8 give the same bits in the new units.
    pub(super) fn scaling_residual(self, input: &[f64]) -> Option<f64> {
        let SolverAnswer::Values(base) = self.solve(input) else {
            return None;
        };
        let p = self.split(input)?;
        let end = match self {
            Kind::SecondDerivatives => 0.5,
            _ => 2.0,
        };
        let times = |v: &[f64], f: f64| -> Vec<f64> { v.iter().map(|v| v * f).collect() };
        let parts = [
            times(p.x, 4.0),
            times(p.y, 8.0),
            times(p.ends, end),
            times(p.queries, 4.0),
        ];
        let SolverAnswer::Values(scaled) = self.solve(&parts.concat()) else {
            return Some(f64::INFINITY);
        };
        let units = [8.0, 2.0, 0.5, 0.125, 32.0];
        let same = base
            .iter()
            .zip(&scaled)
            .zip(units.iter().cycle())
            .all(|((a, b), u)| a * u == *b);
        Some(if same { 0.0 } else { f64::INFINITY })
    }

    /// `S'` at the ends is what was given there, bit for bit.
    pub(super) fn ends_residual(self, input: &[f64]) -> Option<f64> {
        let p = self.split(input)?;
        let s = self.fit(&p).ok()?;
        let hit = |x: Option<&f64>, due: f64| s.jet(*x?).ok().map(|j| j.first == due);
        let both = hit(p.x.first(), p.ends[0])? && hit(p.x.last(), p.ends[1])?;
        Some(if both { 0.0 } else { f64::INFINITY })
    }
}

/// The law of [`Kind::knots_residual`].
pub(super) fn knots_law(residual: fn(&[f64]) -> Option<f64>) -> Law {
    Law {
        name: "interpolation",
        statement: "S(x_i) = y_i at every knot, exactly",
        residual,
    }
}

/// The law of [`Kind::scaling_residual`].
pub(super) fn scaling_law(residual: fn(&[f64]) -> Option<f64>) -> Law {
    Law {
        name: "scaling",
        statement: "x -> 4x, y -> 8y changes every output by a power of two, exactly",
        residual,
    }
}

/// The law of [`Kind::ends_residual`].
pub(super) fn ends_law(residual: fn(&[f64]) -> Option<f64>) -> Law {
    Law {
        name: "ends",
        statement: "S'(x_0) = s_0 and S'(x_n) = s_n, exactly",
        residual,
    }
}
