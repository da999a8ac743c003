//! Elimination of the accelerations, pivot by pivot.

use super::equations::Writer;
use super::text::{mul, sub, sum, zero};

/// A quotient; of zero none is written.
fn over(x: &str, d: &str) -> String {
    match zero(x) {
        true => "0".into(),
        false => format!("{x}/{d}"),
    }
}

impl Writer<'_> {
    /// `q̈` from the lower half of M, f, G and γ.
    pub(super) fn eliminated(
        &mut self,
        m: Vec<Vec<String>>,
        f: Vec<String>,
        rows: &[Vec<String>],
        right: &[String],
    ) -> Vec<String> {
        let (l, d) = self.factored(m);
        let y = self.forward(&l, &f);
        let z: Vec<Vec<String>> = rows.iter().map(|row| self.forward(&l, row)).collect();
        let divided = |w: &mut Self, v: &[String]| -> Vec<String> {
            let quotients = v.iter().zip(&d).map(|(x, d)| over(x, d));
            quotients.map(|q| w.define(q)).collect()
        };
        let scaled: Vec<Vec<String>> = z.iter().map(|z| divided(self, z)).collect();
        let product = |a: &[String], b: &[String]| sum(a.iter().zip(b).map(|(a, b)| mul(a, b)));
        let mut multipliers = Vec::new();
        if !rows.is_empty() {
            let schur = (0..rows.len())
                .map(|i| (0..=i).map(|j| product(&scaled[i], &z[j])).collect())
                .collect();
            let due = (0..rows.len()).map(|i| sub(&product(&scaled[i], &y), &right[i]));
            let due: Vec<String> = due.collect();
            multipliers = self.solved(schur, due);
        }
        let mut rest = Vec::new();
        for (j, y) in y.iter().enumerate() {
            let held = sum(z.iter().zip(&multipliers).map(|(z, k)| mul(&z[j], k)));
            rest.push(over(&sub(y, &held), &d[j]));
        }
        self.backward(&l, &rest)
    }

    /// `x` with `A x = b`, from the lower half of a positive definite matrix.
    pub(super) fn solved(&mut self, a: Vec<Vec<String>>, b: Vec<String>) -> Vec<String> {
        let (l, d) = self.factored(a);
        let y = self.forward(&l, &b);
        let quotients: Vec<String> = y.iter().zip(&d).map(|(y, d)| over(y, d)).collect();
        self.backward(&l, &quotients)
    }

    /// `A = L D Lᵀ` from the lower half of a positive definite matrix.
    fn factored(&mut self, a: Vec<Vec<String>>) -> (Vec<Vec<String>>, Vec<String>) {
        let n = a.len();
        let mut l = vec![vec!["0".to_string(); n]; n];
        let mut d: Vec<String> = Vec::new();
        // The products L D.
        let mut ld = vec![vec!["0".to_string(); n]; n];
        for i in 0..n {
            for j in 0..=i {
                let taken = sum((0..j).map(|k| mul(&ld[i][k], &l[j][k])));
                let value = self.define(sub(&a[i][j], &taken));
                if i == j {
                    d.push(value);
                } else if !zero(&value) {
                    l[i][j] = self.define(format!("{value}/{}", d[j]));
                    ld[i][j] = value;
                }
            }
        }
        (l, d)
    }

    /// `L x = b`.
    fn forward(&mut self, l: &[Vec<String>], b: &[String]) -> Vec<String> {
        let mut x: Vec<String> = Vec::new();
        for (i, b) in b.iter().enumerate() {
            let taken = sum((0..i).map(|k| mul(&l[i][k], &x[k])));
            x.push(self.define(sub(b, &taken)));
        }
        x
    }

    /// `Lᵀ x = b`.
    fn backward(&mut self, l: &[Vec<String>], b: &[String]) -> Vec<String> {
        let n = b.len();
        let mut x = vec!["0".to_string(); n];
        for i in (0..n).rev() {
            let taken = sum((i + 1..n).map(|k| mul(&l[k][i], &x[k])));
            x[i] = self.define(sub(&b[i], &taken));
        }
        x
    }
}
