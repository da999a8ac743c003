//! Errors beside the real axis: |Re z| against the logarithm of Im z.

use super::code::Code;
use super::heights::errors;
use super::measured;
use crate::audit::SolverAnswer;
use crate::methods::find;
use rayon::prelude::*;
use serde::Serialize;

/// Columns over 0 ≤ Re z < 16 and rows over 1e-16 ≤ Im z < 1e2, from below.
const COLUMNS: usize = 64;
const ROWS: usize = 54;
const WIDTH: f64 = 16.0;
const LOWEST: f64 = -16.0;
const PER_DECADE: f64 = 3.0;
/// Points lie off the middle of their cells by something that is no simple fraction.
const WITHIN: f64 = 0.527_864;

/// A character for each level: the first for no number, then up to 1e-17, then a third of a decade
/// each.
pub const LEVELS: &str = "0ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";

/// The level of a relative error.
pub fn level(error: f64) -> usize {
    if !error.is_finite() {
        return 0;
    }
    let thirds = ((error.max(1e-300).log10() + 17.0) * 3.0).ceil();
    1 + thirds.clamp(0.0, (LEVELS.len() - 2) as f64) as usize
}

/// The errors of a code.
#[derive(Clone, Debug, Serialize)]
pub struct Map {
    /// Cells along Re z.
    pub columns: usize,
    /// Cells along log Im z.
    pub rows: usize,
    /// Of the norm, a character a cell, rows from below.
    pub norm: String,
    /// The larger of the two parts', likewise.
    pub parts: String,
}

/// The map of a code in double precision.
pub fn map(code: &Code) -> Map {
    let points: Vec<Vec<f64>> = (0..ROWS * COLUMNS)
        .map(|i| {
            let (column, row) = ((i % COLUMNS) as f64, (i / COLUMNS) as f64);
            let x = (column + WITHIN) * WIDTH / COLUMNS as f64;
            let power = LOWEST + (row + WITHIN) / PER_DECADE;
            vec![x, libm::exp10(power)]
        })
        .collect();
    let method = find("faddeeva").expect("a method of the registry");
    let variant = measured(&*method, Some(code));
    let answers: Vec<SolverAnswer> = code.answers(&points);
    let found: Vec<[f64; 2]> = points
        .par_iter()
        .enumerate()
        .map(|(i, z)| errors(&variant, z, std::iter::once(answers.get(i).cloned()))[0])
        .collect();
    let letters = |part: usize| {
        let letter = |e: &[f64; 2]| char::from(LEVELS.as_bytes()[level(e[part])]);
        found.iter().map(letter).collect()
    };
    Map {
        columns: COLUMNS,
        rows: ROWS,
        norm: letters(0),
        parts: letters(1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solvers::faddeeva::faddeeva;
    use mechaudit_atlas::Parts;
    use mechaudit_atlas::Plane;
    use num_complex::Complex;

    #[test]
    fn levels_are_thirds_of_decades() {
        assert_eq!((level(f64::NAN), level(0.0), level(1e-17)), (0, 1, 1));
        assert_eq!(level(1.1e-17), 2);
        assert_eq!(level(1e300), LEVELS.len() - 1);
        assert_eq!(LEVELS.len(), 53);
        assert!(level(1e-6) < level(1e-5));
    }

    #[test]
    fn a_level_holds_what_its_third_of_a_decade_ends_with() {
        for (error, due) in [
            (1e-300, 1),
            (1e-18, 1),
            (2.1e-17, 2),
            (2.2e-17, 3),
            (3e-5, 39),
            (0.4, 51),
            (0.9, 52),
            (f64::INFINITY, 0),
        ] {
            assert_eq!(level(error), due, "{error:e}");
        }
    }

    /// One answer that is a number, off in a single part, or of that part alone.
    #[test]
    fn each_cell_has_a_point_of_its_own() {
        let (row, column) = (46, 7);
        let off = 3e-5;
        for parts in [Parts::Both, Parts::Real] {
            let asked = std::cell::RefCell::new(Vec::new());
            let code = Code::other(Default::default(), Plane::Upper, parts, |points| {
                *asked.borrow_mut() = points.to_vec();
                let answer = |(i, z): (usize, &Vec<f64>)| {
                    let w = faddeeva(Complex::new(z[0], z[1]));
                    match (i == row * COLUMNS + column, parts) {
                        (false, _) => SolverAnswer::Values(vec![f64::NAN; 2]),
                        (_, Parts::Both) => SolverAnswer::Values(vec![w.re * (1.0 + off), w.im]),
                        (_, Parts::Real) => SolverAnswer::Values(vec![w.re * (1.0 + off)]),
                    }
                };
                points.iter().enumerate().map(answer).collect()
            });
            let map = map(&code);
            let points = asked.take();
            assert_eq!(points.len(), 54 * 64);
            assert_eq!((map.rows, map.columns), (54, 64));
            for (i, z) in points.iter().enumerate() {
                let (row, column) = ((i / 64) as f64, (i % 64) as f64);
                let place = [z[0] * 4.0 - column, (z[1].log10() + 16.0) * 3.0 - row];
                assert!(place.iter().all(|p| (0.4..0.6).contains(p)), "{i}: {z:?}");
            }
            let z = &points[row * 64 + column];
            let w = faddeeva(Complex::new(z[0], z[1]));
            let letter = |error: f64| LEVELS.chars().nth(level(error)).unwrap();
            let due = |error: f64| -> String {
                let at = |i: usize| {
                    if i == row * 64 + column {
                        letter(error)
                    } else {
                        '0'
                    }
                };
                (0..54 * 64).map(at).collect()
            };
            assert_eq!(map.parts, due(off), "{parts:?}");
            let of_norm = match parts {
                Parts::Both => off * w.re / w.norm(),
                Parts::Real => off,
            };
            assert!(level(of_norm) < level(off) || parts == Parts::Real);
            assert_eq!(map.norm, due(of_norm), "{parts:?}");
        }
    }
}
