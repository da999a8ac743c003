//! Condition numbers of linear problems, from inverses in balls.

use super::{Linear, NoValues, Task};
use crate::reference::{Ball, Matrix, dense};
use rug::Rational;

/// The largest order for which an inverse is computed.
const MOST: usize = 100;

/// Bits of inverses and solutions.
const BITS: u32 = 64;

type Table = Matrix<f64>;

fn sizes(x: &Matrix<Ball>) -> Table {
    x.map(|x| x.magnitude().to_f64())
}

fn exact_sizes(x: &Matrix<Rational>) -> Table {
    x.map(|x| x.to_f64().abs())
}

fn product(a: &Table, b: &Table) -> Table {
    let entry = |i: usize, j: usize| (0..a.columns()).map(|k| a.at(i, k) * b.at(k, j)).sum();
    Matrix::from_fn(a.rows(), b.columns(), entry)
}

fn sum(a: &Table, b: &Table) -> Table {
    Matrix::from_fn(a.rows(), a.columns(), |i, j| a.at(i, j) + b.at(i, j))
}

fn turned<T: Clone>(a: &Matrix<T>) -> Matrix<T> {
    Matrix::from_fn(a.columns(), a.rows(), |i, j| a.at(j, i).clone())
}

fn norm(a: &Matrix<Rational>) -> f64 {
    a.entries()
        .iter()
        .map(|x| x.to_f64().powi(2))
        .sum::<f64>()
        .sqrt()
}

/// `Σ_j |x_j ∂f_i/∂x_j|` of all values; of eigenvalues the bound by the norms of the matrices,
/// which perturbations that keep them symmetric can reach. None for large matrices, and where there
/// are no values.
pub(in super::super) fn conditions(linear: &Linear, numbers: &[Rational]) -> Option<Vec<f64>> {
    let open = linear.open(numbers.len())?;
    let parts = linear.parts(numbers, open);
    let is_small = |t: &Task| {
        let a = &linear.tensors[t.matrix()];
        a.rows.at(open).max(a.columns_at(open)) <= MOST
    };
    if !linear.tasks.iter().all(is_small) {
        return None;
    }
    let all = linear
        .tasks
        .iter()
        .map(|task| of_task(linear, *task, &parts, open));
    let all: Vec<Vec<f64>> = all.collect::<Result<_, _>>().ok()?;
    let count = all.first().map_or(0, Vec::len);
    Some(
        (0..count)
            .flat_map(|i| all.iter().map(move |row| row[i]))
            .collect(),
    )
}

fn of_task(
    linear: &Linear,
    task: Task,
    parts: &[&[Rational]],
    open: usize,
) -> Result<Vec<f64>, NoValues> {
    let dense = |which: usize| linear.dense(which, parts, open);
    let a = dense(task.matrix())?;
    let size = exact_sizes(&a);
    Ok(match task {
        // |A⁻¹| (|A| |x| + |b|).
        Task::Solve(_, b) => {
            let b = dense(b)?;
            let inverse = sizes(&dense::inverse(&a, BITS)?);
            let x = sizes(&dense::solve(&a, &b, BITS)?);
            product(&inverse, &sum(&product(&size, &x), &exact_sizes(&b)))
                .entries()
                .to_vec()
        }
        // |det| Σ |a_ij| |A⁻¹|_ji; of a singular matrix not known.
        Task::Determinant(_) => {
            let inverse = sizes(&dense::inverse(&a, BITS)?);
            let det = dense::determinant(&a, BITS)?.magnitude().to_f64();
            let n = a.rows();
            let trace: f64 = (0..n).map(|i| *product(&size, &inverse).at(i, i)).sum();
            vec![det * trace]
        }
        // |A⁻¹| |A| |A⁻¹|.
        Task::Inverse(_) => {
            let inverse = sizes(&dense::inverse(&a, BITS)?);
            product(&product(&inverse, &size), &inverse)
                .entries()
                .to_vec()
        }
        // With G = (AᵀA)⁻¹ and r = b − A x: dx = G Aᵀ (db − dA x) + G dAᵀ r.
        Task::LeastSquares(_, b) => {
            let b = dense(b)?;
            let x = dense::least_squares_exactly(&a, &b)?;
            let gram = Matrix::from_fn(a.columns(), a.columns(), |i, j| {
                (0..a.rows())
                    .map(|k| Rational::from(a.at(k, i) * a.at(k, j)))
                    .sum::<Rational>()
            });
            let inverse = dense::inverse_exactly(&gram)?;
            let exact = |a: &Matrix<Rational>, b: &Matrix<Rational>| {
                Matrix::from_fn(a.rows(), b.columns(), |i, j| {
                    let terms = (0..a.columns()).map(|k| Rational::from(a.at(i, k) * b.at(k, j)));
                    terms.sum::<Rational>()
                })
            };
            let image = exact(&a, &x);
            let residual = Matrix::from_fn(b.rows(), b.columns(), |i, j| {
                Rational::from(b.at(i, j) - image.at(i, j))
            });
            let pseudo = exact(&inverse, &turned(&a));
            let float = |x: &Matrix<Rational>| x.map(Rational::to_f64);
            let [a, b, x] = [&a, &b, &x].map(float);
            let [pseudo, inverse, residual] = [&pseudo, &inverse, &residual].map(float);
            let entry = |i: usize, j: usize| -> f64 {
                let of_row = |k: usize| -> f64 {
                    let of = |l: usize| {
                        let slope =
                            inverse.at(i, l) * residual.at(k, j) - pseudo.at(i, k) * x.at(l, j);
                        (a.at(k, l) * slope).abs()
                    };
                    (0..a.columns()).map(of).sum::<f64>() + (pseudo.at(i, k) * b.at(k, j)).abs()
                };
                (0..a.rows()).map(of_row).sum()
            };
            Matrix::from_fn(x.rows(), x.columns(), entry)
                .entries()
                .to_vec()
        }
        Task::Eigenvalues(_, None) => vec![norm(&a); a.rows()],
        Task::Eigenvalues(_, Some(b)) => {
            let values = linear.values_at(task, parts, open, BITS)?;
            let b = dense(b)?;
            let inverse = sizes(&dense::inverse(&b, BITS)?);
            let inverse = inverse.entries().iter().map(|x| x * x).sum::<f64>().sqrt();
            let of = |x: &Ball| inverse * (norm(&a) + x.magnitude().to_f64() * norm(&b));
            values.iter().map(of).collect()
        }
    })
}
