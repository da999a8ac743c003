//! Sets of errors that are carried through a motion: parallelepipeds in coordinates that turn with
//! the flow.
//!
//! Lohner (*Einschließung der Lösung gewöhnlicher Anfangs- und Randwertaufgaben*, 1988; *Enclosing
//! the solutions of ordinary initial and boundary value problems*, in Computerarithmetic, 1987,
//! 255–286) keeps an error as `B x` with `|x_i| ≤ r_i`. A step maps it to `Φ B x + δ`; the next
//! basis B′ is the orthogonal factor of Φ B with its columns in the order of their lengths, so that
//! the box of coordinates does not have to grow as the flow turns.

use super::enclosed::{Enclosed, orthogonal};
use crate::Mag;

/// Sets `{B x : |x_i| ≤ r_i}` of one basis B, each with radii r of its own. The first one decides
/// how the basis turns.
#[derive(Clone, Debug)]
pub(super) struct ErrorSet {
    basis: Enclosed,
    pub boxes: Vec<Vec<Mag>>,
}

impl ErrorSet {
    /// Boxes of some radii.
    pub fn of_boxes(radii: &[Vec<Mag>], weights: &[f64]) -> ErrorSet {
        let scaled = |radii: &Vec<Mag>| {
            let weighted = radii.iter().zip(weights);
            weighted.map(|(r, w)| r.div(Mag::from_f64(*w))).collect()
        };
        ErrorSet {
            basis: Enclosed::diagonal(weights),
            boxes: radii.iter().map(scaled).collect(),
        }
    }

    /// Bounds on the components of the first set.
    pub fn radii(&self) -> Vec<Mag> {
        self.basis.reach(&self.boxes[0])
    }

    /// Bounds on the components of `Φ e` for the errors e of each set.
    pub fn radii_after(&self, flow: &Enclosed) -> Vec<Vec<Mag>> {
        let image = flow.times(&self.basis);
        self.boxes.iter().map(|r| image.reach(r)).collect()
    }

    /// Sets that hold `Φ e + δ` for all errors e of these and `|δ_i| ≤ extra_i`, in coordinates of
    /// the sizes `weights`, which are powers of two.
    pub fn moved(&self, flow: &Enclosed, extra: &[Vec<Mag>], weights: &[f64]) -> ErrorSet {
        let image = flow.times(&self.basis);
        let rotated = rotation(&image, &self.boxes[0], weights)
            .and_then(|q| self.in_basis(&image, extra, weights, q));
        rotated.unwrap_or_else(|| {
            let radii = self.boxes.iter().map(|r| image.reach(r));
            let radii: Vec<Vec<Mag>> = radii.zip(extra).map(|(r, d)| sum(&r, d)).collect();
            ErrorSet::of_boxes(&radii, weights)
        })
    }

    /// The image in the basis `D Q`: `x = W e + (I − W D Q) x` with `W = Qᵀ D^{−1}`, and `|x| ≤ |W
    /// e| + κ/(1 − κ) max |W e|` for `κ = ‖I − W D Q‖_∞`.
    pub fn in_basis(
        &self,
        image: &Enclosed,
        extra: &[Vec<Mag>],
        weights: &[f64],
        q: Vec<f64>,
    ) -> Option<ErrorSet> {
        let n = self.basis.n;
        // Entries that are negligible would underflow when they are scaled.
        let kept = q
            .into_iter()
            .map(|x| if x.abs() < 1e-100 { 0.0 } else { x });
        let q = Enclosed::exact(n, kept.collect());
        let inverse = q.transposed();
        let product = inverse.times(&q);
        let mut kappa = 0.0f64;
        for i in 0..n {
            let row = (0..n).map(|j| {
                let due = f64::from(u8::from(i == j));
                (product.mid[i * n + j] - due).abs() + product.rad[i * n + j]
            });
            kappa = kappa.max(super::enclosed::up(row.sum::<f64>()));
        }
        if !(kappa < 0.25) {
            return None;
        }
        // Powers of two: the columns of W and the rows of the basis are scaled exactly.
        let scaled = |of: fn(usize, usize) -> usize, up: bool, matrix: &Enclosed| {
            let mid = (0..n * n).map(|k| {
                let w = weights[of(k, n)];
                matrix.mid[k] * if up { w } else { 1.0 / w }
            });
            Enclosed::exact(n, mid.collect())
        };
        let w = scaled(|k, n| k % n, false, &inverse);
        let basis = scaled(|k, n| k / n, true, &q);
        let turned = w.times(image);
        if !turned.is_finite() {
            return None;
        }
        let share = Mag::from_f64(super::enclosed::up(kappa / (1.0 - kappa)));
        let boxes = self.boxes.iter().zip(extra).map(|(r, extra)| {
            let r = sum(&turned.reach(r), &w.reach(extra));
            let rest = share.mul(r.iter().fold(Mag::ZERO, |m, r| m.max(*r)));
            r.into_iter().map(|r| r.add(rest)).collect()
        });
        Some(ErrorSet {
            boxes: boxes.collect(),
            basis,
        })
    }
}

fn sum(a: &[Mag], b: &[Mag]) -> Vec<Mag> {
    a.iter().zip(b).map(|(a, b)| a.add(*b)).collect()
}

/// The orthogonal factor of `D^{−1} A diag(r)`, in units of the largest r.
fn rotation(image: &Enclosed, r: &[Mag], weights: &[f64]) -> Option<Vec<f64>> {
    let n = image.n;
    let largest = r.iter().fold(Mag::ZERO, |m, r| m.max(*r));
    if largest.is_zero() || !largest.is_finite() || !image.is_finite() {
        return None;
    }
    let share: Vec<f64> = r.iter().map(|r| r.div(largest).to_f64()).collect();
    let a: Vec<f64> = (0..n * n)
        .map(|k| image.mid[k] / weights[k / n] * share[k % n])
        .collect();
    Some(orthogonal(n, &a))
}
