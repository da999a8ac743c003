//! The Taylor coefficients at the centres of the cells, made on first use.

use super::fixed_point::SCALE;
use crate::faddeeva::{general::once, recurrence::taylor};
use crate::{Ball, Mag};
use rug::Rational;
use std::sync::OnceLock;

/// Terms of a Taylor series.
pub const TERMS: usize = 40;
/// Centres are at 0, 1/2, …, (SIDE − 1)/2.
pub const SIDE: usize = 20;

/// The coefficients of a cell.
pub enum Cell {
    /// On an axis: d_n with `D = i Σ d_n δ^n` on the real one, else `e_n = i^n c_n`.
    Real(Box<[i128]>),
    /// Of w.
    Complex(Box<[[i128; 2]]>),
}

static CELLS: [OnceLock<Option<Cell>>; SIDE * SIDE] = [const { OnceLock::new() }; SIDE * SIDE];

/// In units, to the nearest: wrong by one at most. Nothing for a radius of more than 2^-18 of a
/// unit.
fn units(b: &Ball) -> Option<i128> {
    let scaled = b.mid().clone() << SCALE;
    let small = b.rad() <= Mag::power_of_two(-140);
    scaled.to_integer().filter(|_| small)?.to_i128()
}

/// The cell about (i + ij)/2.
#[inline]
pub fn cell(i: usize, j: usize) -> Option<&'static Cell> {
    CELLS[i * SIDE + j].get_or_init(|| make(i, j)).as_ref()
}

fn make(i: usize, j: usize) -> Option<Cell> {
    let half = |k: usize| Rational::from((k as i64, 2));
    let c = taylor(once, &half(i), &half(j), TERMS - 1, 150).ok()?;
    if i > 0 && j > 0 {
        let both = c.iter().map(|c| Some([units(&c.re)?, units(&c.im)?]));
        return Some(Cell::Complex(both.collect::<Option<_>>()?));
    }
    let real = c.iter().enumerate().map(|(n, c)| {
        if j == 0 {
            return units(&c.im);
        }
        match n % 4 {
            0 => units(&c.re),
            1 => Some(-units(&c.im)?),
            2 => Some(-units(&c.re)?),
            _ => units(&c.im),
        }
    });
    Some(Cell::Real(real.collect::<Option<_>>()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Float;

    #[test]
    fn units_are_the_nearest() {
        let ball =
            |x: f64, rad| Ball::new(Float::with_val(300, x) >> SCALE, Mag::power_of_two(rad));
        for (x, due) in [(0.6, 1), (-0.6, -1), (5.4, 5), (-5.4, -5), (0.0, 0)] {
            assert_eq!(units(&ball(x, -140)), Some(due), "{x}");
            assert_eq!(units(&ball(x, -139)), None, "{x}");
        }
    }

    /// `w^{(n)}(z)/n!` again at another precision, n from 0 to 39.
    #[test]
    fn coefficients_are_those_of_the_series() {
        for (i, j) in [
            (0, 0),
            (5, 0),
            (19, 0),
            (0, 1),
            (0, 19),
            (1, 1),
            (7, 3),
            (19, 19),
        ] {
            let half = |k: usize| Rational::from((k as i64, 2));
            let due = taylor(once, &half(i), &half(j), 39, 400).unwrap();
            let near = |found: i128, due: &Ball| {
                let off = Float::with_val(400, due.mid() << SCALE) - found;
                assert!(off.clone().abs() < 0.51, "{i} {j}: {off}");
            };
            match cell(i, j).unwrap() {
                Cell::Complex(c) => {
                    assert!(i > 0 && j > 0 && c.len() == 40);
                    for (c, due) in c.iter().zip(&due) {
                        near(c[0], &due.re);
                        near(c[1], &due.im);
                    }
                }
                Cell::Real(c) => {
                    assert!((i == 0 || j == 0) && c.len() == 40);
                    for (n, (c, due)) in c.iter().zip(&due).enumerate() {
                        match (j, n % 4) {
                            (0, _) | (_, 3) => near(*c, &due.im),
                            (_, 0) => near(*c, &due.re),
                            (_, 1) => near(*c, &-&due.im),
                            _ => near(*c, &-&due.re),
                        }
                    }
                }
            }
        }
    }
}
