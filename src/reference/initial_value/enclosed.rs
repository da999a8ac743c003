//! Matrices of double numbers with radii, for linear maps that are needed to a few digits only.

use crate::{Ball, Mag};

/// `n × n` matrices: every entry is within its radius of the double number.
#[derive(Clone, Debug)]
pub(super) struct Enclosed {
    pub n: usize,
    pub mid: Vec<f64>,
    pub rad: Vec<f64>,
}

/// More than the relative rounding of a sum of up to 2^12 products of numbers that are not
/// negative.
const UP: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;

/// More than all that underflows in such a sum lose.
const LEAST: f64 = 1e-300;

/// An upper bound on a sum of products of non-negative numbers, of which the rounded value is
/// given.
pub(super) fn up(sum: f64) -> f64 {
    sum * UP + LEAST
}

/// `n u/(1 − n u)` for a number of operations on doubles, rounded up.
pub(super) fn gamma(n: usize) -> f64 {
    n as f64 * 1.0002 * (f64::EPSILON / 2.0)
}

impl Enclosed {
    /// A matrix of exact entries.
    pub fn exact(n: usize, mid: Vec<f64>) -> Enclosed {
        let rad = vec![0.0; n * n];
        Enclosed { n, mid, rad }
    }

    /// The matrix of balls, row by row.
    pub fn of_balls(n: usize, entries: &[Ball]) -> Enclosed {
        let mid: Vec<f64> = entries.iter().map(|x| x.mid().to_f64()).collect();
        let rad = entries.iter().zip(&mid).map(|(x, mid)| {
            let rounding = mid.abs() * f64::EPSILON;
            up(x.rad().to_f64() + rounding)
        });
        let rad = rad.collect();
        Enclosed { n, mid, rad }
    }

    /// The radii, column by column.
    pub fn columns_of_radii(&self) -> impl Iterator<Item = Vec<Mag>> {
        let column = |j: usize| {
            let entries = self.rad.iter().skip(j).step_by(self.n);
            entries.map(|r| Mag::from_f64(*r)).collect()
        };
        (0..self.n).map(column)
    }

    /// A diagonal matrix.
    pub fn diagonal(entries: &[f64]) -> Enclosed {
        let n = entries.len();
        let mut mid = vec![0.0; n * n];
        for (i, x) in entries.iter().enumerate() {
            mid[i * n + i] = *x;
        }
        Enclosed::exact(n, mid)
    }

    /// The product. Its radius is `|A| r_B + r_A (|B| + r_B) + γ|A||B|`, with γ for n + 2
    /// roundings.
    pub fn times(&self, other: &Enclosed) -> Enclosed {
        let n = self.n;
        let gamma = gamma(n + 2);
        let (mut mid, mut rad) = (vec![0.0; n * n], vec![0.0; n * n]);
        for i in 0..n {
            for k in 0..n {
                let (a, r) = (self.mid[i * n + k], self.rad[i * n + k]);
                if a == 0.0 && r == 0.0 {
                    continue;
                }
                let reach = a.abs() * gamma + r;
                for j in 0..n {
                    let (b, s) = (other.mid[k * n + j], other.rad[k * n + j]);
                    mid[i * n + j] += a * b;
                    rad[i * n + j] += a.abs() * s + reach * (b.abs() + s);
                }
            }
        }
        rad.iter_mut().for_each(|r| *r = up(*r));
        Enclosed { n, mid, rad }
    }

    /// The transpose.
    pub fn transposed(&self) -> Enclosed {
        let n = self.n;
        let turn = |x: &[f64]| (0..n * n).map(|k| x[k % n * n + k / n]).collect();
        Enclosed {
            n,
            mid: turn(&self.mid),
            rad: turn(&self.rad),
        }
    }

    /// `|A| r`, rounded up, for a vector of bounds.
    pub fn reach(&self, r: &[Mag]) -> Vec<Mag> {
        let row = |i: usize| {
            let mut sum = Mag::ZERO;
            for (j, r) in r.iter().enumerate() {
                let k = i * self.n + j;
                let entry = Mag::from_f64(self.mid[k]).add(Mag::from_f64(self.rad[k]));
                sum = sum.add(entry.mul(*r));
            }
            sum
        };
        (0..self.n).map(row).collect()
    }

    /// True if all entries are finite.
    pub fn is_finite(&self) -> bool {
        self.mid.iter().chain(&self.rad).all(|x| x.is_finite())
    }
}

/// An upper bound, entry by entry, on the exponential of a matrix whose entries are not negative
/// and are given by upper bounds. `weights` are the sizes of the coordinates.
///
/// With `B = D^{−1} A D/2^s`, `‖B‖_∞ ≤ 1/4`, the terms of the exponential series above the power 6
/// add up to at most `2 ‖B‖^7/7!` in any entry, because the norm of each is at most 1/32 of that of
/// the one before.
pub(super) fn exponential_above(a: &[f64], weights: &[f64]) -> Vec<f64> {
    const TERMS: i32 = 6;
    let n = weights.len();
    // The weights are powers of two: the change of coordinates is exact.
    let change = |k: usize| match a[k] == 0.0 {
        true => 0.0,
        false => up(a[k] * weights[k % n] / weights[k / n]),
    };
    let mut b: Vec<f64> = (0..n * n).map(change).collect();
    let rows = (0..n).map(|i| up(b[i * n..(i + 1) * n].iter().sum::<f64>()));
    let norm = rows.fold(0.0, f64::max);
    if !(norm < 1e9) {
        return vec![f64::INFINITY; n * n];
    }
    let mut halvings = 0;
    let mut size = norm;
    while size > 0.25 {
        size /= 2.0;
        halvings += 1;
    }
    let factor = (-f64::from(halvings)).exp2();
    b.iter_mut().for_each(|x| *x *= factor);
    let product = |x: &[f64], y: &[f64]| {
        let mut z = vec![0.0; n * n];
        for i in 0..n {
            for k in 0..n {
                let x = x[i * n + k];
                if x != 0.0 {
                    (0..n).for_each(|j| z[i * n + j] += x * y[k * n + j]);
                }
            }
        }
        z.iter_mut()
            .filter(|z| **z != 0.0)
            .for_each(|z| *z = up(*z));
        z
    };
    let mut identity = vec![0.0; n * n];
    (0..n).for_each(|i| identity[i * n + i] = 1.0);
    let (mut sum, mut term) = (identity.clone(), identity);
    for k in 1..=TERMS {
        term = product(&term, &b);
        term.iter_mut()
            .for_each(|x| *x = (*x / f64::from(k)).next_up());
        sum.iter_mut().zip(&term).for_each(|(s, x)| *s = up(*s + x));
    }
    // ‖B‖^7/7!·2 < 2.5e-8.
    let tail = 2.0 * (1.01 * size).powi(7) / 5040.0 * 1.01;
    sum.iter_mut().for_each(|s| *s = up(*s + tail));
    for _ in 0..halvings {
        sum = product(&sum, &sum);
    }
    (0..n * n)
        .map(|k| up(sum[k] * weights[k / n] / weights[k % n]))
        .collect()
}

/// An orthogonal matrix, up to rounding, whose first columns span those of a matrix in the order of
/// their lengths: the factor Q of a QR decomposition by Householder's reflections.
pub(super) fn orthogonal(n: usize, a: &[f64]) -> Vec<f64> {
    let length = |j: usize| (0..n).map(|i| a[i * n + j] * a[i * n + j]).sum::<f64>();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|i, j| length(*j).total_cmp(&length(*i)));
    // Columns, sorted, each a vector.
    let mut columns: Vec<Vec<f64>> = order
        .iter()
        .map(|j| (0..n).map(|i| a[i * n + j]).collect())
        .collect();
    let mut q: Vec<Vec<f64>> = (0..n)
        .map(|j| (0..n).map(|i| f64::from(u8::from(i == j))).collect())
        .collect();
    let mut reflections = Vec::new();
    for k in 0..n {
        let mut v: Vec<f64> = columns[k].clone();
        v[..k].fill(0.0);
        let largest = v.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        if !(largest > 0.0 && largest.is_finite()) {
            continue;
        }
        v.iter_mut().for_each(|x| *x /= largest);
        let size = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v[k] += size.copysign(v[k]);
        let square = v.iter().map(|x| x * x).sum::<f64>();
        let reflect = |x: &mut [f64]| {
            let along = 2.0 * v.iter().zip(&*x).map(|(v, x)| v * x).sum::<f64>() / square;
            x.iter_mut().zip(&v).for_each(|(x, v)| *x -= along * v);
        };
        columns[k..].iter_mut().for_each(|x| reflect(x));
        reflections.push((v, square));
    }
    for (v, square) in reflections.iter().rev() {
        for x in &mut q {
            let along = 2.0 * v.iter().zip(&*x).map(|(v, x)| v * x).sum::<f64>() / square;
            x.iter_mut().zip(v).for_each(|(x, v)| *x -= along * v);
        }
    }
    (0..n * n).map(|k| q[k % n][k / n]).collect()
}
