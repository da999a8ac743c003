//! Four numbers as an array are four numbers.

use super::Random;
use crate::real::{Four, ROUND, Real};

fn bits(x: Four) -> [u64; 4] {
    x.0.map(f64::to_bits)
}

fn each(f: impl Fn(usize) -> f64) -> [u64; 4] {
    std::array::from_fn(|i| f(i).to_bits())
}

#[test]
fn four_numbers_are_four_single_ones() {
    let mut random = Random(17);
    for round in 0..200 {
        let mut four = || Four(std::array::from_fn(|_| random.between(-3.0, 3.0)));
        let (mut x, mut y, z) = (four(), four(), four());
        // Equal numbers as well.
        y.0[round % 4] = x.0[round % 4];
        if round % 8 == 0 {
            x.0[1] = -0.0;
            y.0[1] = 0.0;
        }
        let (a, b, c) = (x.0, y.0, z.0);
        assert_eq!(bits(x + y), each(|i| a[i] + b[i]));
        assert_eq!(bits(x - y), each(|i| a[i] - b[i]));
        assert_eq!(bits(x * y), each(|i| a[i] * b[i]));
        assert_eq!(bits(z / x), each(|i| c[i] / a[i]));
        assert_eq!(bits(-x), each(|i| -a[i]));
        assert_eq!(bits(x.fma(y, z)), each(|i| a[i].mul_add(b[i], c[i])));
        assert_eq!(bits(x.magnitude()), each(|i| a[i].abs()));
        assert_eq!(
            bits(x.at_least(y)),
            each(|i| if a[i] < b[i] { b[i] } else { a[i] })
        );
        assert_eq!(
            bits(x.at_most(y)),
            each(|i| if a[i] > b[i] { b[i] } else { a[i] })
        );
        let (p, q) = (x.below(y), y.below(z));
        assert_eq!(p, std::array::from_fn(|i| a[i] < b[i]));
        assert_eq!(x.or(p, q), std::array::from_fn(|i| p[i] || q[i]));
        assert_eq!(
            bits(x.pick(p, y, z)),
            each(|i| if p[i] { b[i] } else { c[i] })
        );
        assert_eq!(x.all(p), p.iter().all(|p| *p));
        assert!(x.all([true; 4]));
        let k = Four(std::array::from_fn(|i| ROUND + (a[i] * 9.0).round()));
        let whole = |i: usize| (a[i] * 9.0).round() as i64;
        assert_eq!(bits(k.power_of_two()), each(|i| 2f64.powi(whole(i) as i32)));
        assert_eq!(k.is_odd(), std::array::from_fn(|i| whole(i) % 2 != 0));
        let flipped = |i: usize| if whole(i) & 2 != 0 { -b[i] } else { b[i] };
        assert_eq!(bits(k.flip(y)), each(flipped));
    }
}
