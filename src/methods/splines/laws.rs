//! Identities that splines on arbitrary knots have to satisfy bit for bit.

use super::common::{Kind, SplineProblem};
use crate::audit::Law;
use crate::methods::common::held;

impl Kind {
    /// `S(x_i) = y_i` bit for bit.
    pub(super) fn knots_residual(self, p: SplineProblem) -> Option<f64> {
        let s = self.fit(p).ok()?;
        held(interpolates(p, |x| s.jet(x).ok().map(|j| j.value)))
    }

    /// Abscissae times 4 and ordinates times 8 give the same bits in the new units.
    pub(super) fn scaling_residual(self, p: SplineProblem) -> Option<f64> {
        let base = self.solve(p).ok()?;
        // An ordinate's unit over that of an abscissa, as often as the end value has it.
        let unit = |order: Option<i32>| 8.0 / 4f64.powi(order.unwrap_or(0));
        let [first, last] = self.end_orders().map(unit);
        let times = |v: &[f64], f: f64| -> Vec<f64> { v.iter().map(|v| v * f).collect() };
        let (x, y) = (times(p.x, 4.0), times(p.y, 8.0));
        let Ok(scaled) = self.solve(SplineProblem {
            x: &x,
            y: &y,
            ends: p.ends.map(|[a, b]| [a * first, b * last]),
            queries: p.queries.map(|q| q * 4.0),
        }) else {
            return held(false);
        };
        held(in_other_units(&base, &scaled))
    }

    /// Mirrored points give the mirrored `S` and `S'` bit for bit.
    pub(super) fn reflection_residual(self, p: SplineProblem) -> Option<f64> {
        let mirrored =
            |v: &[f64], sign: f64| -> Vec<f64> { v.iter().rev().map(|v| sign * v).collect() };
        let (x, y) = (mirrored(p.x, -1.0), mirrored(p.y, 1.0));
        let s = self.fit(p).ok()?;
        let Ok(turned) = self.fit(SplineProblem { x: &x, y: &y, ..p }) else {
            return held(false);
        };
        let same = p.queries.iter().map(|&q| {
            let (a, b) = (s.jet(q).ok()?, turned.jet(-q).ok()?);
            Some(a.value == b.value && a.first == -b.first)
        });
        held(
            same.collect::<Option<Vec<bool>>>()?
                .into_iter()
                .all(|same| same),
        )
    }

    /// At the ends of each segment the slope is between none and three times that of the chord,
    /// which makes the interpolant monotone there (Fritsch & Carlson 1980); 4 u are allowed for
    /// rounding.
    pub(super) fn monotone_residual(self, p: SplineProblem) -> Option<f64> {
        let s = self.fit(p).ok()?;
        let slopes: Option<Vec<f64>> = p.x.iter().map(|x| Some(s.jet(*x).ok()?.first)).collect();
        let slopes = slopes?;
        let segments = slopes.windows(2).zip(p.x.windows(2)).zip(p.y.windows(2));
        held(segments.into_iter().all(|((s, x), y)| {
            let chord = (y[1] - y[0]) / (x[1] - x[0]);
            let limit = 3.0 * chord.abs() * (1.0 + 2.0 * f64::EPSILON);
            s.iter()
                .all(|s| s.abs() <= limit && s * chord.signum() >= 0.0)
        }))
    }

    /// `S'` at the ends is what was given there, bit for bit.
    pub(super) fn ends_residual(self, p: SplineProblem) -> Option<f64> {
        let s = self.fit(p).ok()?;
        let slope = |x: f64| s.jet(x).ok().map(|j| j.first);
        let [first, last] = [p.x.first(), p.x.last()].map(|x| slope(*x?));
        held([first?, last?] == p.ends?)
    }
}

/// Returns whether a function has the ordinates at all knots.
fn interpolates(p: SplineProblem, value: impl Fn(f64) -> Option<f64>) -> bool {
    p.x.iter().zip(p.y).all(|(x, y)| value(*x) == Some(*y))
}

/// Returns whether `S, S', S'', S'''` and the integral of every query are those for x in units of
/// 1/4, y of 1/8.
fn in_other_units(here: &[f64], there: &[f64]) -> bool {
    let units = [8.0, 2.0, 0.5, 0.125, 32.0].into_iter().cycle();
    let due = here.iter().zip(units).map(|(x, unit)| x * unit);
    there.iter().copied().eq(due)
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

/// The law of [`Kind::reflection_residual`].
pub(super) fn reflection_law(residual: fn(&[f64]) -> Option<f64>) -> Law {
    Law {
        name: "reflection",
        statement: "x -> -x leaves S as it is and changes the sign of S', exactly",
        residual,
    }
}

/// The law of [`Kind::monotone_residual`].
pub(super) fn monotone_law(residual: fn(&[f64]) -> Option<f64>) -> Law {
    Law {
        name: "monotone",
        statement: "0 <= S'(x_i)/delta <= 3 for the chords delta on both sides, within 4 u",
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

#[cfg(test)]
mod tests {
    use super::*;

    fn problem<'a>(x: &'a [f64], y: &'a [f64]) -> SplineProblem<'a> {
        let queries = [x[0], x[0]];
        SplineProblem {
            x,
            y,
            ends: None,
            queries,
        }
    }

    #[test]
    fn a_function_has_to_have_every_ordinate() {
        let (x, y) = ([0.0, 1.0, 3.0], [5.0, 6.0, 8.0]);
        let p = problem(&x, &y);
        assert!(interpolates(p, |x| Some(x + 5.0)));
        for off in x {
            let moved = |x: f64| Some(if x == off { 0.0 } else { x + 5.0 });
            let lost = |x: f64| (x != off).then_some(x + 5.0);
            assert!(!interpolates(p, moved) && !interpolates(p, lost), "{off}");
        }
    }

    /// With x in quarters and y in eighths S is 8 times what it was, S' twice, S'' a half, S''' an
    /// eighth, the integral 32 times.
    #[test]
    fn every_value_is_measured_in_its_own_unit() {
        let here: Vec<f64> = (1..=10).map(f64::from).collect();
        let due = [8.0, 4.0, 1.5, 0.5, 160.0, 48.0, 14.0, 4.0, 1.125, 320.0];
        assert!(in_other_units(&here, &due));
        for k in 0..10 {
            let mut off = due;
            off[k] *= 2.0;
            assert!(!in_other_units(&here, &off), "{k}");
        }
        assert!(!in_other_units(&here, &due[..9]));
    }

    /// A straight line with slope 1 at both ends.
    #[test]
    fn laws_of_a_line() {
        let kind = Kind::CLAMPED;
        let p = SplineProblem {
            ends: Some([1.0, 1.0]),
            ..problem(&[0.0, 1.0, 3.0], &[5.0, 6.0, 8.0])
        };
        assert_eq!(kind.knots_residual(p), Some(0.0));
        assert_eq!(kind.scaling_residual(p), Some(0.0));
        assert_eq!(kind.ends_residual(p), Some(0.0));
        let lost = SplineProblem { x: &[0.0], ..p };
        assert_eq!(kind.knots_residual(lost), None);
        assert_eq!(kind.scaling_residual(lost), None);
        assert_eq!(kind.ends_residual(lost), None);
        // With second derivatives of 1 given a line is left, and its slopes are others.
        let bent = Kind::SECOND_DERIVATIVES;
        assert_eq!(bent.ends_residual(p), Some(f64::INFINITY));
    }
}
