//! Tests of `dense`.

use super::*;

#[test]
fn solutions_of_both_systems() {
    let mut a = Matrix::new(3, 4);
    for (k, v) in [0.0, 2.0, 1.0, 9.0, 1.0, -1.0, 3.0, 9.0, 4.0, 0.5, 0.0, 9.0]
        .iter()
        .enumerate()
    {
        a[(k / 4, k % 4)] = *v;
    }
    let mut f = Factors::default();
    assert!(f.of(&a, 3, 0));
    // By the rule of Sarrus.
    approx::assert_relative_eq!(f.determinant(), 28.5, max_relative = 1e-15);
    let due = [1.0, -2.0, 0.5];
    let times = |r: usize| (0..3).map(|c| a[(r, c)] * due[c]).sum::<f64>();
    let mut x = [0.0; 3];
    f.solve(times, &mut x);
    let transposed: Vec<f64> = (0..3)
        .map(|c| (0..3).map(|r| a[(r, c)] * due[r]).sum())
        .collect();
    let mut y = [0.0; 3];
    f.solve_transposed(&transposed, &mut y);
    for k in 0..3 {
        assert!((x[k] - due[k]).abs() < 1e-15 && (y[k] - due[k]).abs() < 1e-15);
    }
    a[(0, 1)] = 0.0;
    a[(0, 2)] = 0.0;
    assert!(!f.of(&a, 3, 0));
}

/// By how much all entries of a row and b would have to change for x to solve it (Oettli and
/// Prager).
fn backward_error(a: impl Iterator<Item = (f64, f64)>, b: f64) -> f64 {
    let (mut sum, mut rest, mut size) = (b, 0.0, b.abs());
    for (a, x) in a {
        let product = a * x;
        let next = sum - product;
        let back = next - sum;
        rest += (sum - (next - back)) - (product + back) - a.mul_add(x, -product);
        (sum, size) = (next, size + product.abs());
    }
    (sum + rest).abs() / size
}

/// Entries of widely different sizes: elimination leaves rows that only much larger entries solve,
/// one correction none.
#[test]
fn uneven_systems_are_solved_closely() {
    let mut state = 7u64;
    let mut next = |n: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) % n
    };
    let n = 5;
    let (mut plain, mut closely) = ([0.0f64; 2], [0.0f64; 2]);
    for _ in 0..300 {
        let mut number = || (next(1000) as f64 - 499.5) * 2f64.powi(next(40) as i32 - 20);
        let mut a = Matrix::new(n, n);
        for (r, c) in (0..n).flat_map(|r| (0..n).map(move |c| (r, c))) {
            // Two blocks, the first of two rows.
            if r >= 2 || c < 2 {
                a[(r, c)] = number();
            }
        }
        let b: Vec<f64> = (0..n).map(|_| number()).collect();
        let mut factors = Factors::default();
        assert!(factors.of_blocks(&a, 0, [0..2, 2..n].into_iter()));
        let row = |r: usize, x: &[f64]| backward_error((0..n).map(|c| (a[(r, c)], x[c])), b[r]);
        let column = |c: usize, y: &[f64]| backward_error((0..n).map(|r| (a[(r, c)], y[r])), b[c]);
        let worst = |of: &dyn Fn(usize) -> f64| (0..n).map(of).fold(0.0, f64::max);
        let mut x = vec![0.0; n];
        factors.solve(|r| b[r], &mut x);
        plain[0] = plain[0].max(worst(&|r| row(r, &x)));
        factors.solve_closely(&a, |r| b[r], &mut x, &mut vec![9.0; 3]);
        closely[0] = closely[0].max(worst(&|r| row(r, &x)));
        factors.solve_transposed(&b, &mut x);
        plain[1] = plain[1].max(worst(&|r| column(r, &x)));
        factors.solve_transposed_closely(&a, &b, &mut x);
        closely[1] = closely[1].max(worst(&|r| column(r, &x)));
    }
    let told = format!("{plain:?} {closely:?}");
    assert!(plain.iter().all(|e| *e > 1e-12), "{told}");
    assert!(closely.iter().all(|e| *e < 4.0 * f64::EPSILON), "{told}");
}

/// Even pivots: the solution as elimination leaves it.
#[test]
fn even_systems_are_left_alone() {
    let mut a = Matrix::new(2, 2);
    for (k, v) in [16.0, 0.0, 1.0, 1.0].into_iter().enumerate() {
        a[(k / 2, k % 2)] = v;
    }
    let mut f = Factors::default();
    assert!(f.of(&a, 2, 0) && f.are_even());
    a[(0, 0)] = 16.0f64.next_up();
    assert!(f.of(&a, 2, 0) && !f.are_even());
    a[(0, 0)] = 1.0 / 16.0;
    a[(1, 0)] = 0.0;
    assert!(f.of(&a, 2, 0) && f.are_even());
    a[(0, 0)] = (1.0f64 / 16.0).next_down();
    assert!(f.of(&a, 2, 0) && !f.are_even());
    let mut random = super::super::tests::Random(17);
    let (mut x, mut y) = ([[0.0; 3]; 2], [[0.0; 3]; 2]);
    for _ in 0..20 {
        let mut a = Matrix::new(3, 3);
        for (r, c) in (0..3).flat_map(|r| (0..3).map(move |c| (r, c))) {
            a[(r, c)] = random.between(-0.3, 0.3) + f64::from(u8::from(r == c));
        }
        let b = [(); 3].map(|()| random.between(-1.0, 1.0));
        assert!(f.of(&a, 3, 0) && f.are_even());
        f.solve(|r| b[r], &mut x[0]);
        f.solve_closely(&a, |r| b[r], &mut x[1], &mut Vec::new());
        f.solve_transposed(&b, &mut y[0]);
        f.solve_transposed_closely(&a, &b, &mut y[1]);
        assert_eq!((x[0], y[0]), (x[1], y[1]));
    }
}

/// Blocks whose loops are unrolled are factored and solved as those of any size; solutions solve
/// their systems.
#[test]
fn blocks_of_every_size() {
    let mut random = super::super::tests::Random(31);
    for sizes in [
        &[4usize, 2, 3, 1][..],
        &[1, 2, 4, 4],
        &[2, 2],
        &[4],
        &[3, 4, 2],
    ] {
        let ends = sizes.iter().scan(0, |end, n| {
            *end += n;
            Some(*end - n..*end)
        });
        let blocks: Vec<Range<usize>> = ends.collect();
        let n: usize = sizes.iter().sum();
        for _ in 0..20 {
            let mut a = Matrix::new(n, n + 1);
            for block in &blocks {
                for (r, c) in block
                    .clone()
                    .flat_map(|r| (0..block.end).map(move |c| (r, c)))
                {
                    a[(r, c + 1)] = random.between(-1.0, 1.0);
                }
            }
            let b: Vec<f64> = (0..n).map(|_| random.between(-1.0, 1.0)).collect();
            let mut f = Factors::default();
            assert!(f.of_blocks(&a, 1, blocks.iter().cloned()));
            let mut any = Factors {
                n,
                lu: (0..n).flat_map(|r| a.row(r)[1..].to_vec()).collect(),
                rows: (0..n).collect(),
                blocks: blocks.clone(),
                pivots: [f64::INFINITY, 0.0],
                ..Factors::default()
            };
            assert!(blocks.iter().all(|k| any.eliminate_any(k.clone())));
            assert_eq!(format!("{f:?}"), format!("{any:?}"));
            let (mut x, mut y) = (vec![0.0; n], vec![0.0; n]);
            f.solve(|r| b[r], &mut x);
            blocks
                .iter()
                .for_each(|k| any.solve_any(k, |r| b[r], &mut y));
            assert_eq!(x, y);
            f.solve_transposed(&b, &mut y);
            let largest = |x: &[f64]| x.iter().fold(1.0f64, |m, x| m.max(x.abs()));
            for k in 0..n {
                let row = (0..n).fold(b[k], |sum, c| sum - a[(k, c + 1)] * x[c]);
                let column = (0..n).fold(b[k], |sum, r| sum - a[(r, k + 1)] * y[r]);
                assert!(row.abs() < 1e-13 * largest(&x), "{sizes:?}: {row:e}");
                assert!(column.abs() < 1e-13 * largest(&y), "{sizes:?}: {column:e}");
            }
            let mut whole = Factors::default();
            assert!(whole.of(&a, n, 1));
            let due = whole.determinant();
            assert!(
                (f.determinant() - due).abs() < 1e-10 * due.abs(),
                "{sizes:?}"
            );
        }
    }
}

/// A column of zeros below the diagonal, anywhere: no factors.
#[test]
fn singular_blocks_are_refused() {
    for n in 1..=5 {
        for zero in 0..n {
            let mut a = Matrix::new(n, n);
            for (r, c) in (0..n).flat_map(|r| (0..n).map(move |c| (r, c))) {
                a[(r, c)] = if c == zero {
                    0.0
                } else {
                    1.0 / (1 + r + c) as f64
                };
            }
            let mut f = Factors::default();
            assert!(!f.of(&a, n, 0), "{n} {zero}");
            for r in 0..n {
                a[(r, zero)] = if r == zero { f64::INFINITY } else { 0.0 };
            }
            assert!(!f.of(&a, n, 0), "{n} {zero}");
        }
    }
}
