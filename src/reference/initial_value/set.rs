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

/// `{B x : |x_i| ≤ r_i}`.
#[derive(Clone, Debug)]
pub(super) struct ErrorSet {
    basis: Enclosed,
    r: Vec<Mag>,
}

impl ErrorSet {
    /// The box of some radii.
    pub fn of_box(radii: &[Mag], weights: &[f64]) -> ErrorSet {
        let weighted = radii.iter().zip(weights);
        ErrorSet {
            basis: Enclosed::diagonal(weights),
            r: weighted.map(|(r, w)| r.div(Mag::from_f64(*w))).collect(),
        }
    }

    /// Bounds on the components.
    pub fn radii(&self) -> Vec<Mag> {
        self.basis.reach(&self.r)
    }

    /// Bounds on the components of `Φ e` for the errors e of the set.
    pub fn radii_after(&self, flow: &Enclosed) -> Vec<Mag> {
        flow.times(&self.basis).reach(&self.r)
    }

    /// A set that holds `Φ e + δ` for all errors e of this one and `|δ_i| ≤ extra_i`, in
    /// coordinates of the sizes `weights`, which are powers of two.
    pub fn moved(&self, flow: &Enclosed, extra: &[Mag], weights: &[f64]) -> ErrorSet {
        let n = self.basis.n;
        let image = flow.times(&self.basis);
        let rotated = rotation(&image, &self.r, weights)
            .and_then(|q| self.in_basis(&image, extra, weights, q));
        rotated.unwrap_or_else(|| {
            let radii = image.reach(&self.r);
            let radii: Vec<Mag> = (0..n).map(|i| radii[i].add(extra[i])).collect();
            ErrorSet::of_box(&radii, weights)
        })
    }

    /// The image in the basis `D Q`: `x = W e + (I − W D Q) x` with `W = Qᵀ D^{−1}`, and `|x| ≤ |W
    /// e| + κ/(1 − κ) max |W e|` for `κ = ‖I − W D Q‖_∞`.
    fn in_basis(
        &self,
        image: &Enclosed,
        extra: &[Mag],
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
        let (turned, added) = (w.times(image), w.reach(extra));
        if !turned.is_finite() {
            return None;
        }
        let r = turned.reach(&self.r);
        let r: Vec<Mag> = (0..n).map(|i| r[i].add(added[i])).collect();
        let largest = r.iter().fold(Mag::ZERO, |m, r| m.max(*r));
        let rest = Mag::from_f64(super::enclosed::up(kappa / (1.0 - kappa))).mul(largest);
        Some(ErrorSet {
            basis,
            r: r.into_iter().map(|r| r.add(rest)).collect(),
        })
    }
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
