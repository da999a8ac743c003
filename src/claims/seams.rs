//! Where an algorithm's formulas meet: how far its values jump, and whether Re w rises away from
//! the imaginary axis, where it falls.
//!
//! A segment whose ends have different formulas is halved until its ends are neighbours among the
//! floats; w itself changes there by a few ulps at most.

use super::rounded;
use crate::audit::Draw;
use mechaudit_atlas::{Algorithm, Parts};
use num_complex::{Complex, Complex64};
use serde::Serialize;

/// Segments that are tried.
const SEGMENTS: u64 = 3000;
/// Jumps below are rounding.
pub const LEAST: f64 = 1e-14;

/// The largest jump between two formulas that was found.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Jump {
    /// The numbers of the formulas; nothing where they are not known and the jump was searched for.
    pub between: Option<[u8; 2]>,
    /// `|w₁ − w₂|/|w₁|`, of known formulas.
    pub norm: Option<f64>,
    /// That of Re w.
    pub re: f64,
    /// Where the jump of Re w is largest.
    pub at: [f64; 2],
    /// Crossings at fixed Im z, and those of them at which Re w rises away from the imaginary axis
    /// by more than rounding.
    pub crossings: u64,
    /// See there.
    pub rising: u64,
}

/// Those of an algorithm of several formulas, by their numbers.
pub fn jumps(a: &Algorithm, seed: u64) -> Vec<Jump> {
    let Some(formula) = a.formula else {
        return Vec::new();
    };
    let mut found: Vec<Jump> = Vec::new();
    for k in 0..SEGMENTS {
        let mut d = Draw::new(seed, "atlas", "seams", k);
        let level = d.chance(0.6);
        let (p, q) = segment(&mut d, level);
        let Some((p, q)) = halved(formula, p, q) else {
            continue;
        };
        let (w, v) = ((a.w)(p), (a.w)(q));
        let re = ((w.re - v.re) / w.re).abs();
        let norm = match a.parts {
            Parts::Both => (w - v).norm() / w.norm(),
            Parts::Real => re,
        };
        // From the inner to the outer point.
        let (inner, outer) = match p.re.abs() < q.re.abs() {
            true => (w, v),
            false => (v, w),
        };
        let rises = level && rises(inner.re, outer.re, inner.re.abs());
        let (f, g) = (formula(p), formula(q));
        let between = Some([f.min(g), f.max(g)]);
        let known = found.iter().position(|j| j.between == between);
        let known = known.unwrap_or_else(|| {
            found.push(Jump {
                between,
                norm: Some(0.0),
                re: -1.0,
                ..Jump::default()
            });
            found.len() - 1
        });
        let jump = &mut found[known];
        jump.crossings += u64::from(level);
        jump.rising += u64::from(rises);
        jump.norm = jump.norm.map(|n| n.max(norm));
        if re > jump.re {
            (jump.re, jump.at) = (re, [p.re, p.im]);
        }
    }
    found.sort_by_key(|j| j.between);
    found.retain(|j| j.norm > Some(LEAST) || j.re > LEAST);
    for j in &mut found {
        (j.norm, j.re) = (j.norm.map(rounded), rounded(j.re));
    }
    found
}

/// Returns whether it grows by more than a hundred times what is called rounding.
pub(super) fn rises(inner: f64, outer: f64, size: f64) -> bool {
    outer - inner > 100.0 * LEAST * size
}

/// A segment of the right upper quadrant, level or upright.
fn segment(d: &mut Draw, level: bool) -> (Complex64, Complex64) {
    let mut side = |small: bool| match small {
        true => d.log_uniform(1e-12, 1.0),
        false => d.log_uniform(0.1, 300.0),
    };
    let (a, b) = (side(false), side(false));
    let other = side(a > b);
    match level {
        true => (Complex::new(a, other), Complex::new(b, other)),
        false => (Complex::new(other, a), Complex::new(other, b)),
    }
}

/// Neighbours with different formulas on the way from p to q.
fn halved(
    formula: fn(Complex64) -> u8,
    mut p: Complex64,
    mut q: Complex64,
) -> Option<(Complex64, Complex64)> {
    let first = formula(p);
    if formula(q) == first {
        return None;
    }
    for _ in 0..200 {
        let middle = (p + q) * 0.5;
        if middle == p || middle == q {
            break;
        }
        match formula(middle) == first {
            true => p = middle,
            false => q = middle,
        }
    }
    Some((p, q))
}

#[cfg(test)]
mod tests;
