//! Taylor rows by rows and by columns: the same operations on the same numbers.

use super::super::pack::Pack;
use super::super::taylor_packs::{by_columns, by_rows};
use super::Random;
use pulp::x86::V3;
use pulp::{NullaryFnOnce, cast};

/// Sums of a few rows, real and imaginary parts, one way and the other.
struct BothWays<'a>(V3, &'a [[f64; 40]; 4], [[f64; 4]; 10], (usize, usize));

impl NullaryFnOnce for BothWays<'_> {
    type Output = [[[f64; 4]; 2]; 2];
    #[inline(always)]
    fn call(self) -> Self::Output {
        let BothWays(simd, rows, powers, ends) = self;
        let rows: [&[f64; 40]; 8] = std::array::from_fn(|i| &rows[i % 4]);
        let pack = |x: [f64; 4]| Pack(simd, cast(x));
        let powers = std::array::from_fn(|k| (pack(powers[2 * k]), pack(powers[2 * k + 1])));
        let numbers = |(re, im): (Pack<V3>, Pack<V3>)| [cast(re.1), cast(im.1)];
        [
            numbers(by_columns(simd, &rows, ends, powers)),
            numbers(by_rows(simd, &rows, ends, powers)),
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
        let powers: [[f64; 4]; 10] = std::array::from_fn(|k| match k {
            0 => [1.0; 4],
            1 => [0.0; 4],
            _ => std::array::from_fn(&mut number),
        });
        let ends = (8, [8, 16, 24, 32][round % 4]);
        let [columns, by_rows] = simd.vectorize(BothWays(simd, &rows, powers, ends));
        assert_eq!(
            columns.map(|x| x.map(f64::to_bits)),
            by_rows.map(|x| x.map(f64::to_bits))
        );

        // And both are Σ q_n δⁿ, four coefficients at a time.
        for m in 0..4 {
            let power = |k: usize| (powers[2 * k][m], powers[2 * k + 1][m]);
            let times = |(a, b): (f64, f64), (c, d): (f64, f64)| (a * c - b * d, a * d + b * c);
            let (mut re, mut im) = (0.0, 0.0);
            for k in 0..4 {
                let mut sum = (0.0, 0.0);
                for at in (ends.0..=ends.1).rev().step_by(8) {
                    let next = times(sum, power(4));
                    sum = (next.0 + rows[m][at + k], next.1 + rows[m][at + 4 + k]);
                }
                let part = if k == 0 { sum } else { times(sum, power(k)) };
                (re, im) = (re + part.0, im + part.1);
            }
            assert!((re - columns[0][m]).abs() < 1e-13, "{re} {}", columns[0][m]);
            assert!((im - columns[1][m]).abs() < 1e-13, "{im} {}", columns[1][m]);
        }
    }
}
