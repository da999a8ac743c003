//! Identities that splines on arbitrary knots have to satisfy bit for bit.

use super::common::{EndCondition, SplineProblem};
use crate::audit::Law;
use crate::methods::common::held;

impl EndCondition {
    /// `S(x_i) = y_i` bit for bit.
    pub(super) fn knots_residual(self, p: SplineProblem) -> Option<f64> {
        let s = self.fit(p).ok()?;
        let hit = |(x, y): (&f64, &f64)| s.value(*x).is_ok_and(|v| v == *y);
        held(p.x.iter().zip(p.y).all(hit))
    }

    /// Abscissae times 4 and ordinates times 8 give the same bits in the new units.
    pub(super) fn scaling_residual(self, p: SplineProblem) -> Option<f64> {
        let base = self.solve(p).ok()?;
        let end = match self {
            EndCondition::SecondDerivatives => 0.5,
            _ => 2.0,
        };
        let times = |v: &[f64], f: f64| -> Vec<f64> { v.iter().map(|v| v * f).collect() };
        let (x, y) = (times(p.x, 4.0), times(p.y, 8.0));
        let Ok(scaled) = self.solve(SplineProblem {
            x: &x,
            y: &y,
            ends: p.ends.map(|ends| ends.map(|v| v * end)),
            queries: p.queries.map(|q| q * 4.0),
        }) else {
            return held(false);
        };
        let units = [8.0, 2.0, 0.5, 0.125, 32.0];
        let mut all = base.iter().zip(&scaled).zip(units.iter().cycle());
        held(all.all(|((a, b), u)| a * u == *b))
    }

    /// `S'` at the ends is what was given there, bit for bit.
    pub(super) fn ends_residual(self, p: SplineProblem) -> Option<f64> {
        let s = self.fit(p).ok()?;
        let slope = |x: f64| s.jet(x).ok().map(|j| j.first);
        let [first, last] = [p.x.first(), p.x.last()].map(|x| slope(*x?));
        held([first?, last?] == p.ends?)
    }
}

/// The law of [`EndCondition::knots_residual`].
pub(super) fn knots_law(residual: fn(&[f64]) -> Option<f64>) -> Law {
    Law {
        name: "interpolation",
        statement: "S(x_i) = y_i at every knot, exactly",
        residual,
    }
}

/// The law of [`EndCondition::scaling_residual`].
pub(super) fn scaling_law(residual: fn(&[f64]) -> Option<f64>) -> Law {
    Law {
        name: "scaling",
        statement: "x -> 4x, y -> 8y changes every output by a power of two, exactly",
        residual,
    }
}

/// The law of [`EndCondition::ends_residual`].
pub(super) fn ends_law(residual: fn(&[f64]) -> Option<f64>) -> Law {
    Law {
        name: "ends",
        statement: "S'(x_0) = s_0 and S'(x_n) = s_n, exactly",
        residual,
    }
}
