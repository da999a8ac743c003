//! Both sides of every seam between formulas and cells, and the seams themselves.

use super::super::{SEAMS, faddeeva, w_derivative};
use super::exact::{float, w};
use num_complex::Complex;
use rug::Float;
use rug::float::Constant;

/// The error by the modulus, in units of ε.
fn off(x: f64, y: f64) -> f64 {
    if y < 0.0 && (y - x.abs()) * (y + x.abs()) > 700.0 {
        // Next to overflow and beyond.
        return 0.0;
    }
    let got = faddeeva(Complex::new(x, y));
    let (re, im) = w(x.abs(), y);
    let im = if x.is_sign_negative() { -im } else { im };
    let size = Float::with_val(64, re.hypot_ref(&im));
    let d =
        Float::with_val(640, float(got.re) - re).hypot(&Float::with_val(640, float(got.im) - im));
    (d / size).to_f64() / f64::EPSILON
}

fn check(points: impl IntoIterator<Item = (f64, f64)>) {
    let mut bad = Vec::new();
    for (x, y) in points {
        for y in [y, -y] {
            let off = off(x, y);
            if !(off <= 2.0) {
                bad.push((x, y, off));
            }
        }
    }
    bad.sort_by(|p, q| q.2.total_cmp(&p.2));
    let shown = &bad[..bad.len().min(40)];
    assert!(bad.is_empty(), "{} points beyond 2 ε: {shown:?}", bad.len());
}

/// Middles and corners of all cells.
#[test]
fn cells() {
    let lattice = |n: usize| (0..n).map(|k| k as f64 / 16.0);
    check(lattice(118).flat_map(|x| lattice(118).map(move |y| (x, y))));
}

/// W′ next to the corners of the cells, where the Taylor series leave out the most: each component.
#[test]
fn slopes_in_corners() {
    let lattice = || (2..110).map(|k| f64::from(k) / 16.0 + 0.003);
    for (x, y) in lattice().flat_map(|x| lattice().map(move |y| (x, y))) {
        let got = w_derivative(Complex::new(x, y));
        let (u, v) = w(x, y);
        let times = |w: &Float, x: f64| Float::with_val(300, w * x);
        let root = Float::with_val(300, Constant::Pi).sqrt();
        let re = (times(&v, y) - times(&u, x)) * 2u32;
        let im = (root.recip() - times(&v, x) - times(&u, y)) * 2u32;
        for (got, exact) in [(got.re, re), (got.im, im)] {
            let off = (float(got) - &exact).abs().to_f64() / (got.abs() * f64::EPSILON);
            assert!(
                off <= 1.0,
                "w′({x} + {y} i) is {off} ε off: {got:e}, {exact:e}"
            );
        }
    }
}

/// Neighbours of the straight seams.
#[test]
fn lines() {
    let mut points = Vec::new();
    let crossings = SEAMS
        .circles
        .iter()
        .map(|r2| r2.sqrt())
        .filter(|r| *r < 30.0);
    for seam in SEAMS.im.iter().copied().chain(crossings) {
        for t in [seam, f64::next_up(seam), f64::next_down(seam)] {
            for k in 0..260 {
                let s = f64::from(k) * 0.11 + 1e-3;
                points.extend([(t, s), (s, t)]);
            }
            points.push((t, t));
        }
    }
    check(points);
}

/// Both sides of the circles.
#[test]
fn circles() {
    let mut points = Vec::new();
    for r in SEAMS.circles.iter().map(|r2| r2.sqrt()) {
        for k in 0..120 {
            let (s, c) = (f64::from(k) * 0.75 + 0.01).to_radians().sin_cos();
            for f in [1.0 - 1e-15, 1.0, 1.0 + 1e-15] {
                points.push((f * r * c, f * r * s));
            }
        }
    }
    check(points);
}
