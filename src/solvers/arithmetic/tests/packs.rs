//! Taylor rows by rows and by columns: the same operations on the same numbers.

use super::Random;
use crate::pack::{Pack, by_columns, by_rows};
use pulp::x86::V3;
use pulp::{NullaryFnOnce, cast};

/// The interleaved polynomials of a few rows, one way and the other.
struct BothWays<'a>(V3, &'a [[f64; 40]; 4], [[f64; 4]; 2], (usize, usize));

impl NullaryFnOnce for BothWays<'_> {
    type Output = [[[[f64; 4]; 4]; 2]; 2];
    #[inline(always)]
    fn call(self) -> Self::Output {
        let BothWays(simd, rows, d4, ends) = self;
        let rows: [&[f64; 40]; 8] = std::array::from_fn(|i| &rows[i % 4]);
        let d4 = (Pack(simd, cast(d4[0])), Pack(simd, cast(d4[1])));
        let numbers = |p: [Pack<V3>; 4]| p.map(|v| cast(v.1));
        let both = |(re, im)| [numbers(re), numbers(im)];
        [
            both(by_columns(simd, &rows, ends, d4)),
            both(by_rows(simd, &rows, ends, d4)),
        ]
    }
}

#[test]
fn rows_and_columns_agree() {
    let Some(simd) = V3::try_new() else { return };
    let mut random = Random(5);
    for round in 0..100 {
        let mut number = |_| random.between(-1.0, 1.0);
        let mut row = |_| std::array::from_fn(&mut number);
        let rows: [[f64; 40]; 4] = std::array::from_fn(&mut row);
        let d4: [[f64; 4]; 2] = std::array::from_fn(|_| std::array::from_fn(&mut number));
        let ends = (8, [8, 16, 24, 32][round % 4]);
        let [columns, by_rows] = simd.vectorize(BothWays(simd, &rows, d4, ends));
        let bits = |x: [[[f64; 4]; 4]; 2]| x.map(|x| x.map(|x| x.map(f64::to_bits)));
        assert_eq!(bits(columns), bits(by_rows));

        // And both are sums in δ⁴.
        for m in 0..4 {
            let (x, y) = (d4[0][m], d4[1][m]);
            for k in 0..4 {
                let (mut re, mut im) = (0.0, 0.0);
                for at in (ends.0..=ends.1).rev().step_by(8) {
                    let (a, b) = (rows[m][at + k], rows[m][at + 4 + k]);
                    (re, im) = (re * x - im * y + a, re * y + im * x + b);
                }
                let (p, q) = (columns[0][k][m], columns[1][k][m]);
                assert!((re - p).abs() < 1e-13, "{re} {p}");
                assert!((im - q).abs() < 1e-13, "{im} {q}");
            }
        }
    }
}
