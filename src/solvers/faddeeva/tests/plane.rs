//! The choice of the formula: the scalar and the vector form are the same.

use super::super::plane::{BUCKETS, Kind, LOWER, bucket, kind};
use super::super::real::ROUND;
use super::Random;
use num_complex::Complex;

/// The bucket by the scalar rule.
fn expected(a: f64, y: f64) -> f64 {
    let kind = match a < 1e-290 {
        true => Kind::Other,
        false => kind(a, y),
    };
    let both = (kind as u8) <= Kind::RealAxis as u8;
    let lower = if both && y < 0.0 { LOWER } else { 0 };
    f64::from(kind as u8) + lower as f64 + ROUND
}

/// Points by chance and on all edges, with a right half.
fn points() -> Vec<(f64, f64)> {
    let mut random = Random(21);
    let mut points: Vec<_> = (0..40_000).map(|_| random.point()).collect();
    let edges = [
        0.0,
        5e-324,
        1e-290,
        0.125,
        0.25,
        1.0,
        1.125,
        9.0,
        0.007_812_5,
        3.75,
        7.0,
        10.0,
        16.0,
        27.5,
        31.622_776_601_683_793,
        70.710_678_118_654_75,
        1000.0,
        1e100,
        1e154,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
    ];
    for a in edges {
        for b in edges {
            for x in [a.next_down(), a, a.next_up()] {
                points.extend([b.next_down(), b, b.next_up()].map(|y| (x, y)));
                points.extend([b.next_down(), b, b.next_up()].map(|y| (x, -y)));
            }
        }
    }
    points.iter().map(|&(x, y)| (x.abs(), y)).collect()
}

#[test]
fn one_at_a_time() {
    for (a, y) in points() {
        let got = bucket(a, y);
        assert_eq!(got, expected(a, y), "{a:e} {y:e}");
        assert!(got - ROUND < BUCKETS as f64);
    }
}

#[cfg(target_arch = "x86_64")]
#[test]
fn side_by_side() {
    use super::super::pack::{Pack, Wide};
    use pulp::x86::{V3, V4};

    fn check<S: Wide>(simd: S) {
        let points = points();
        let (x, y): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        for at in (0..points.len() - 8).step_by(S::WIDTH) {
            let mut codes = [0.0; 8];
            let (a, b) = (Pack::load(simd, &x, at), Pack::load(simd, &y, at));
            bucket(a, b).store(&mut codes);
            for m in 0..S::WIDTH {
                let (a, y) = points[at + m];
                assert_eq!(codes[m], expected(a, y), "{a:e} {y:e}");
            }
        }
    }
    if let Some(simd) = V3::try_new() {
        check(simd);
    }
    if let Some(simd) = V4::try_new() {
        check(simd);
    }
}

#[test]
fn next_to_zero_it_does_not_grow_on_the_imaginary_axis() {
    let on_axis = |y: f64| crate::solvers::faddeeva::faddeeva(Complex::new(0.0, y)).re;
    // The first one was found by an audit.
    let found = 0.007_262_203_177_223_835_5;
    let evenly = (1..=200_000).map(|i| f64::from(i) * 3.9e-8);
    for y in std::iter::once(found).chain(evenly) {
        for y in [y, -y] {
            let (here, next) = (on_axis(y), on_axis(y.next_up()));
            assert!(next <= here, "{y}: {here} {next}");
        }
    }
}
