//! Describes what a factored tridiagonal or cyclic system says of itself, against dense matrices.

use crate::cyclic_tridiagonal::CyclicSweep;
use crate::tridiagonal::{Stability, Sweep};
use nalgebra::DMatrix;

type Bands = [Vec<f64>; 3];

/// Entries between −2 and 2, with a diagonal that is larger in some.
fn bands(seed: u64, n: usize) -> Bands {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 51) as f64 - 2.0
    };
    let mut random = || (0..n).map(|_| next()).collect::<Vec<f64>>();
    let [lower, mut diagonal, upper] = [random(), random(), random()];
    let more = (seed % 4) as f64;
    for d in &mut diagonal {
        *d += more.copysign(*d);
    }
    [lower, diagonal, upper]
}

/// Row `i` is `lower[i] x_{i−1} + diagonal[i] x_i + upper[i] x_{i+1}`, around the circle if cyclic.
fn dense([lower, diagonal, upper]: &Bands, cyclic: bool) -> DMatrix<f64> {
    let n = diagonal.len();
    let mut a = DMatrix::zeros(n, n);
    for i in 0..n {
        a[(i, i)] += diagonal[i];
        if cyclic || i > 0 {
            a[(i, (i + n - 1) % n)] += lower[i];
        }
        if cyclic || i + 1 < n {
            a[(i, (i + 1) % n)] += upper[i];
        }
    }
    a
}

fn norm_1(a: &DMatrix<f64>) -> f64 {
    a.column_iter().map(|c| c.abs().sum()).fold(0.0, f64::max)
}

/// The factors without exchange of rows.
fn factors(a: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let n = a.nrows();
    let (mut l, mut u) = (DMatrix::identity(n, n), a.clone());
    for k in 0..n {
        for i in k + 1..n {
            let f = u[(i, k)] / u[(k, k)];
            l[(i, k)] = f;
            for j in k..n {
                u[(i, j)] -= f * u[(k, j)];
            }
        }
    }
    (l, u)
}

/// `(|L||U|)_ii` over the sum of the row, for a cyclic system with what is filled into the last
/// column.
fn growth(a: &DMatrix<f64>, cyclic: bool) -> f64 {
    let n = a.nrows();
    let (l, u) = factors(a);
    let (l, u) = (l.abs(), u.abs());
    let product = &l * &u;
    let of = |i: usize| {
        let row = a.row(i).abs().sum();
        let size = match cyclic {
            false => product[(i, i)],
            true if i + 1 < n => {
                let before = if i > 0 {
                    l[(i, i - 1)] * u[(i - 1, i)]
                } else {
                    0.0
                };
                before + u[(i, i)] + u[(i, n - 1)]
            }
            true => a[(i, i)].abs() + (0..i).map(|k| l[(i, k)] * u[(k, i)]).sum::<f64>(),
        };
        size / row
    };
    (0..n).map(of).fold(1.0, f64::max)
}

fn dominant(a: &DMatrix<f64>) -> bool {
    let n = a.nrows();
    let off = |i: usize, by_rows: bool| -> f64 {
        let entry = |j: usize| if by_rows { a[(i, j)] } else { a[(j, i)] };
        (0..n).filter(|&j| j != i).map(|j| entry(j).abs()).sum()
    };
    let all = |by_rows| (0..n).all(|i| a[(i, i)].abs() >= off(i, by_rows));
    all(true) || all(false)
}

/// The estimates are lower bounds within a factor of three, and mostly exact.
fn hold(s: &Stability, a: &DMatrix<f64>, cyclic: bool, exact: &mut [u32; 3]) {
    let inverse = a.clone().try_inverse().expect("regular");
    let due = growth(a, cyclic);
    assert!(
        (s.growth / due - 1.0).abs() < 1e-9,
        "{} {due} {a}",
        s.growth
    );
    assert_eq!(s.dominant, dominant(a), "{a}");
    let condition = norm_1(a) * norm_1(&inverse);
    let skeel = norm_1(&(inverse.abs() * a.abs()).transpose());
    for (k, (got, due)) in [(1.0 / s.rcond, condition), (s.skeel, skeel)]
        .into_iter()
        .enumerate()
    {
        let share = got / due;
        assert!(share < 1.0 + 1e-9 && share > 1.0 / 3.0, "{got} {due} {a}");
        exact[k] += u32::from(share > 1.0 - 1e-9);
    }
    exact[2] += 1;
    let error = 4.0 * 2f64.powi(-53) * s.growth * s.skeel;
    assert!((s.relative_error() / error - 1.0).abs() < 1e-15);
    assert_eq!(s.is_reliable(), error < 2f64.powi(-26));
}

/// Holds what is said of the systems of some seeds: their order, whether they are dominant, and
/// their stability, where they are regular.
fn every(cyclic: bool, told: impl Fn(&Bands) -> Option<(usize, bool, Stability)>) {
    let (mut exact, mut yes, mut many) = ([0; 3], 0, 0);
    for seed in 1..400 {
        let n = match cyclic {
            true => 3 + seed as usize % 7,
            false => 1 + seed as usize % 9,
        };
        let b = bands(seed, n);
        let Some((order, dominant, s)) = told(&b) else {
            continue;
        };
        if s.skeel > 1e6 || s.growth > 1e6 {
            continue;
        }
        assert_eq!((order, dominant), (n, s.dominant));
        hold(&s, &dense(&b, cyclic), cyclic, &mut exact);
        yes += u32::from(s.dominant);
        many += 1;
    }
    assert!(yes > 50 && many - yes > 50, "{yes} of {many}");
    assert!(
        4 * exact[0] > 3 * exact[2] && 4 * exact[1] > 3 * exact[2],
        "{exact:?}"
    );
}

#[test]
fn tridiagonal() {
    every(false, |[lower, diagonal, upper]| {
        let s = Sweep::factor(&lower[1..], diagonal, &upper[..upper.len() - 1]).ok()?;
        Some((s.n(), s.is_dominant(), s.stability()))
    });
}

#[test]
fn cyclic() {
    every(true, |[lower, diagonal, upper]| {
        let s = CyclicSweep::factor(lower, diagonal, upper).ok()?;
        Some((s.n(), s.is_dominant(), s.stability()))
    });
}

/// Both neighbours count, in rows and in columns.
#[test]
fn dominance_by_rows_and_by_columns() {
    let dominant = |lower: [f64; 2], upper: [f64; 2]| {
        Sweep::factor(&lower, &[4.0; 3], &upper)
            .unwrap()
            .is_dominant()
    };
    // Sums of rows 4, 4, 4, then of columns.
    assert!(dominant([1.0, 4.0], [-4.0, 3.0]) && dominant([3.0, 4.0], [-4.0, 1.0]));
    assert!(dominant([4.0, 3.0], [-1.0, 4.0]) && dominant([4.0, 1.0], [-3.0, 4.0]));
    // By neither, though the differences are small.
    assert!(!dominant([3.0, 3.0], [3.0, 3.0]) && !dominant([-3.0, 3.0], [-3.0, 3.0]));
    assert!(!dominant([3.0, -3.0], [-3.0, 3.0]));
}
