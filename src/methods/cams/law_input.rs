//! How a law of motion is laid out in the input of an audited method: kind, share of the stroke
//! spent accelerating, number of parameters, parameters.

use crate::audit::Draw;
use crate::methods::Number;
use crate::reference::cam_law::{Family, Law};
use crate::reference::cubic_spline::Spline;
use crate::solvers::cam_law::{CamLawError, MotionLaw};
use crate::solvers::cubic_spline::End;
use rug::Rational;

/// Parameters `b`, `d`.
pub(super) const SCCA: f64 = 0.0;
/// No parameters.
pub(super) const POLYNOMIAL_345: f64 = 1.0;
/// No parameters.
pub(super) const POLYNOMIAL_4567: f64 = 2.0;
/// Parameters `c_1`, `c_2`, …
pub(super) const POLYNOMIAL: f64 = 3.0;
/// Parameters `x_0` … `x_n`, `y_0` … `y_n`.
pub(super) const TABLE: f64 = 4.0;

/// A law taken apart.
pub(super) struct LawInput<'a, T: Number> {
    kind: f64,
    share: T::Of<'a>,
    parameters: &'a [T],
}

impl<'a, T: Number> LawInput<'a, T> {
    /// Nothing if the kind has another number of parameters.
    pub(super) fn new(kind: f64, share: T::Of<'a>, parameters: &'a [T]) -> Option<Self> {
        let fits = match kind {
            SCCA => parameters.len() == 2,
            POLYNOMIAL_345 | POLYNOMIAL_4567 => parameters.is_empty(),
            POLYNOMIAL => !parameters.is_empty(),
            TABLE => parameters.len() >= 4 && parameters.len().is_multiple_of(2),
            _ => false,
        };
        fits.then_some(LawInput {
            kind,
            share,
            parameters,
        })
    }

    /// Returns whether its parameters are a table whose data are known to half an ulp.
    pub(super) fn is_table(&self) -> bool {
        self.kind == TABLE
    }

    /// Returns whether a parameter is an inner knot or ordinate of a table.
    pub(super) fn is_inner(&self, place: usize) -> bool {
        let count = self.parameters.len();
        let half = count / 2;
        self.is_table() && place < count && ![0, half - 1, half, count - 1].contains(&place)
    }
}

impl LawInput<'_, f64> {
    pub(super) fn solver(&self) -> Result<MotionLaw, CamLawError> {
        let p = self.parameters;
        let symmetric = match self.kind {
            SCCA => MotionLaw::scca(p[0], 1.0 - p[0].max(p[1]) - p[0].min(p[1]), p[1])?,
            POLYNOMIAL_345 => MotionLaw::polynomial_345(),
            POLYNOMIAL_4567 => MotionLaw::polynomial_4567(),
            POLYNOMIAL => {
                let all: Vec<f64> = std::iter::once(0.0).chain(p.iter().copied()).collect();
                return MotionLaw::polynomial(&all);
            }
            _ => {
                let (x, y) = p.split_at(p.len() / 2);
                let still = [End::FirstDerivative(0.0); 2];
                return MotionLaw::tabulated(x.to_vec(), y.to_vec(), still);
            }
        };
        symmetric.with_acceleration_fraction(self.share)
    }
}

impl LawInput<'_, Rational> {
    /// Returns whether the parameters make a law of motion: shares that fill the rise, a share of
    /// the stroke between 0.001 and 0.999, a polynomial of degree 1 to 24 that ends at 1 within
    /// 1e-9, a table from (0, 0) to (1, 1).
    pub(super) fn is_law(&self) -> bool {
        let p = self.parameters;
        let (zero, one) = (Rational::new(), Rational::from(1));
        let is_share =
            (Rational::from((1, 1000))..=Rational::from((999, 1000))).contains(self.share);
        match self.kind {
            SCCA => {
                let constant = Rational::from(&one - &p[0]) - &p[1];
                is_share && [&p[0], &p[1], &constant].iter().all(|part| **part >= 0)
            }
            POLYNOMIAL => {
                let degree = p.iter().rposition(|c| *c != 0).map_or(0, |k| k + 1);
                let off = (p.iter().sum::<Rational>() - one).abs();
                (1..=24).contains(&degree) && off <= Rational::from((1, 1_000_000_000))
            }
            TABLE => {
                let (x, y) = p.split_at(p.len() / 2);
                let leads = |v: &[Rational]| v.first() == Some(&zero) && v.last() == Some(&one);
                leads(x) && leads(y)
            }
            _ => is_share,
        }
    }

    pub(super) fn reference(&self) -> Option<Law> {
        let p = self.parameters;
        let family = match self.kind {
            SCCA => Family::Scca {
                b: p[0].clone(),
                d: p[1].clone(),
            },
            POLYNOMIAL_345 => Family::Polynomial345,
            POLYNOMIAL_4567 => Family::Polynomial4567,
            POLYNOMIAL => {
                let mut all = vec![Rational::new()];
                all.extend(p.iter().cloned());
                return Law::polynomial(&all);
            }
            _ => {
                let (x, y) = p.split_at(p.len() / 2);
                let zero = Rational::new();
                let spline = Spline::clamped(x, y, &zero, &zero).ok()?;
                return Some(Law::spline(&spline, x));
            }
        };
        Some(Law::stretched(&family, self.share))
    }
}

fn laid_out(kind: f64, fraction: f64, parameters: &[f64]) -> Vec<f64> {
    let mut x = vec![kind, fraction, parameters.len() as f64];
    x.extend(parameters);
    x
}

pub(super) fn any_scca(d: &mut Draw) -> Vec<f64> {
    let named = [
        (0.0, 0.0),
        (0.0, 1.0),
        (0.25, 0.25),
        (0.25, 0.75),
        (0.5, 0.5),
        (1.0, 0.0),
    ];
    if d.chance(0.4) {
        let (b, dd) = named[d.integer(0, 5)];
        return laid_out(SCCA, 0.5, &[b, dd]);
    }
    // On a grid of 2^-20, so that c is exact.
    let grid = |x: f64| (x * 2f64.powi(20)).round() * 2f64.powi(-20);
    let b = grid(d.unit());
    let rest = 1.0 - b;
    let part = match d.integer(0, 3) {
        0 => 0.0,
        1 => rest,
        _ => grid(rest * d.unit()),
    };
    let pair = if d.chance(0.5) { [b, part] } else { [part, b] };
    laid_out(SCCA, 0.5, &pair)
}

pub(super) fn any_symmetric(d: &mut Draw) -> Vec<f64> {
    let kind = [POLYNOMIAL_345, POLYNOMIAL_4567][d.integer(0, 1)];
    laid_out(kind, 0.5, &[])
}

pub(super) fn any_asymmetric(d: &mut Draw) -> Vec<f64> {
    let law = [any_scca, any_symmetric][d.integer(0, 1)];
    let mut x = law(d);
    x[1] = d.uniform(0.05, 0.95);
    x
}

/// Coefficients on a grid of 1/16, so that they add up to one exactly.
pub(super) fn any_polynomial(d: &mut Draw) -> Vec<f64> {
    let degree = d.integer(1, 12);
    let first = d.integer(1, degree.min(4));
    let mut c = vec![0.0; degree];
    for c in &mut c[first - 1..] {
        *c = (d.uniform(-20.0, 20.0) * 16.0).round() / 16.0;
    }
    c[degree - 1] = 0.0;
    c[degree - 1] = 1.0 - c.iter().sum::<f64>();
    laid_out(POLYNOMIAL, 0.5, &c)
}

/// A rise through 3 to 7 knots.
pub(super) fn any_table(d: &mut Draw) -> Vec<f64> {
    let n = d.integer(3, 7);
    let mut increasing = || {
        let mut steps: Vec<f64> = (1..n).map(|_| d.uniform(0.5, 1.5)).collect();
        let sum: f64 = steps.iter().sum();
        let mut at = 0.0;
        for s in &mut steps {
            at += *s / sum;
            *s = at;
        }
        steps[n - 2] = 1.0;
        std::iter::once(0.0).chain(steps).collect::<Vec<f64>>()
    };
    let mut p = increasing();
    p.extend(increasing());
    laid_out(TABLE, 0.5, &p)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Shares b and d of the constant, harmonic, trapezoidal, modified sine, cycloidal laws and of
    /// one more.
    #[test]
    fn named_laws_are_drawn() {
        let drawn = |k| any_scca(&mut Draw::new(1, "cam-law", "scca", k))[3..].to_vec();
        let all: Vec<Vec<f64>> = (0..400).map(drawn).collect();
        for (b, d) in [
            (0.0, 0.0),
            (0.0, 1.0),
            (0.25, 0.25),
            (0.25, 0.75),
            (0.5, 0.5),
            (1.0, 0.0),
        ] {
            let count = all.iter().filter(|p| p[..] == [b, d]).count();
            assert!(count > 8, "{b} {d}: {count}");
        }
    }

    /// Ends of a table are given, not measured.
    #[test]
    fn inner_knots_and_ordinates_are_data() {
        let some = [0.0; 10];
        let inner = |kind: f64, count: usize| -> Vec<usize> {
            let law = LawInput::<f64>::new(kind, 0.5, &some[..count]).unwrap();
            (0..12).filter(|k| law.is_inner(*k)).collect()
        };
        assert_eq!(inner(TABLE, 10), [1, 2, 3, 6, 7, 8]);
        assert_eq!(inner(TABLE, 6), [1, 4]);
        assert!(inner(TABLE, 4).is_empty());
        assert!(inner(POLYNOMIAL, 10).is_empty() && inner(SCCA, 2).is_empty());
    }

    #[test]
    fn tables_alone_are_tables() {
        let some = [0.0; 4];
        for (kind, count, due) in [
            (SCCA, 2, false),
            (POLYNOMIAL_345, 0, false),
            (POLYNOMIAL_4567, 0, false),
            (POLYNOMIAL, 4, false),
            (TABLE, 4, true),
        ] {
            let law = LawInput::<f64>::new(kind, 0.5, &some[..count]).unwrap();
            assert_eq!(law.is_table(), due, "{kind}");
        }
    }

    #[test]
    fn a_kind_has_so_many_parameters() {
        let fits = |kind: f64| -> Vec<usize> {
            let some = [0.0; 8];
            let of = |n: &usize| LawInput::<f64>::new(kind, 0.5, &some[..*n]).is_some();
            (0..=8).filter(of).collect()
        };
        assert_eq!(fits(SCCA), [2]);
        assert_eq!(fits(POLYNOMIAL_345), [0]);
        assert_eq!(fits(POLYNOMIAL_4567), [0]);
        assert_eq!(fits(POLYNOMIAL), [1, 2, 3, 4, 5, 6, 7, 8]);
        // Two knots at least, an ordinate at each.
        assert_eq!(fits(TABLE), [4, 6, 8]);
        assert!(fits(5.0).is_empty());
    }
}
