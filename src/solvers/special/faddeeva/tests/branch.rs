//! The choice of the formula: the scalar and the vector form are the same.

use super::super::SEAMS;
use super::super::batch::bucket::{
    BUCKETS, EXPONENTIAL_IN_CELL, IMAGE_BY_SERIES, IMAGE_IN_CELL, LOWER, SERIES_ALONE, bucket,
    places,
};
use super::super::branch::{
    Branch, CELL, NEAR, REAL_AXIS, RINGS, SERIES_6, SERIES_14, SERIES_26, TINY, formula_at,
};
use super::super::reflection::{DOMINANT, NEGLIGIBLE, decay};
use super::Random;
use crate::pack::{Pack, Wide};
use pulp::x86::{V3, V4};

/// The bucket by the scalar rule.
fn expected(x: f64, y: f64) -> usize {
    let a = x.abs();
    let formula = match a < TINY {
        true => Branch::Huge,
        false => formula_at(a, y),
    };
    let above = formula.number();
    if above > REAL_AXIS.number() || !(y < 0.0) {
        return above;
    }
    let decay = decay(x, y);
    match formula {
        CELL if decay > DOMINANT => IMAGE_IN_CELL,
        CELL if decay < -DOMINANT => EXPONENTIAL_IN_CELL,
        SERIES_26 if (DOMINANT..=NEGLIGIBLE).contains(&decay) => IMAGE_BY_SERIES,
        SERIES_26 | SERIES_14 | SERIES_6 if decay > NEGLIGIBLE && y.abs() >= NEAR => {
            above + LOWER + SERIES_ALONE
        }
        _ => above + LOWER,
    }
}

/// Points by chance and on all edges, with a right half.
fn points() -> Vec<(f64, f64)> {
    let mut random = Random(21);
    let mut points: Vec<_> = (0..40_000).map(|_| random.point()).collect();
    let special = [
        0.0,
        5e-324,
        1.0,
        9.0,
        1e154,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
    ];
    let edges: Vec<f64> = special
        .into_iter()
        .chain(SEAMS.circles.iter().map(|r2| r2.sqrt()))
        .chain(SEAMS.im.iter().chain(SEAMS.re).copied())
        .collect();
    for &a in &edges {
        for &b in &edges {
            for x in [a.next_down(), a, a.next_up()] {
                points.extend([b.next_down(), b, b.next_up()].map(|y| (x, y)));
                points.extend([b.next_down(), b, b.next_up()].map(|y| (x, -y)));
            }
        }
    }
    points
}

#[test]
fn side_by_side() {
    fn check<S: Wide>(simd: S) {
        let points = points();
        let (x, y): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        for at in (0..points.len() - 8).step_by(S::WIDTH) {
            let (a, b) = (Pack::load(simd, &x, at), Pack::load(simd, &y, at));
            let places = Pack(simd, simd.transmute_f64s_u64s(places(a, b))).array();
            for m in 0..S::WIDTH {
                let (x, y) = points[at + m];
                let got = bucket(places[m].to_bits()) as usize;
                assert_eq!(got, expected(x, y), "{x:e} {y:e}");
                assert!(got < BUCKETS);
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
fn as_told() {
    use num_complex::Complex;
    let told = [
        ((0.005, 0.005), Branch::Maclaurin { terms: 9 }),
        ((0.1, -0.2), Branch::Maclaurin { terms: 21 }),
        ((0.0, 0.2), Branch::ImaginaryAxis { terms: 18 }),
        ((-1.0, 1.0), Branch::Cell { terms: 18 }),
        ((1.0, -1.5), Branch::Cell { terms: 18 }),
        ((0.5, -0.5), Branch::LowerCell { terms: 18 }),
        ((0.1, 3.0), Branch::Cell { terms: 18 }),
        ((0.0, 3.0), Branch::ImaginaryAxis { terms: 18 }),
        ((0.0, -3.0), Branch::Cell { terms: 18 }),
        ((5.0, -0.1), Branch::RealAxis { terms: 18 }),
        ((12.0, 0.1), Branch::Strip { terms: 16 }),
        ((12.0, -1e-9), Branch::RealLine { terms: 10 }),
        ((7.0, 3.0), Branch::Asymptotic { terms: 26 }),
        ((9.0, 9.0), Branch::Asymptotic { terms: 14 }),
        ((30.0, 30.0), Branch::Asymptotic { terms: 6 }),
        ((300.0, -30.0), Branch::Asymptotic { terms: 6 }),
        ((300.0, 30.0), Branch::Asymptotic { terms: 4 }),
        ((1e5, 1e5), Branch::Asymptotic { terms: 2 }),
        ((1e200, 1e200), Branch::Huge),
        ((f64::NAN, 1.0), Branch::Huge),
        ((1.99, -1.35), Branch::Zero { zero: 1, terms: 21 }),
    ];
    for ((x, y), branch) in told {
        assert_eq!(super::super::branch(Complex::new(x, y)), branch, "{x} {y}");
    }
}

/// The limits are such that batches can tell the ring by the leading bits.
#[test]
fn limits_by_leading_bits() {
    let limits: Vec<f64> = RINGS[1..].iter().map(|ring| ring.from).collect();
    assert_eq!(limits, SEAMS.circles);
    assert!(limits.windows(2).all(|pair| pair[0] < pair[1]));
    let (_, told) = limits.split_last().expect("limits");
    assert!(told.iter().all(|limit| limit.to_bits() << 14 == 0));
}
