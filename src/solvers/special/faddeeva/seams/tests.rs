//! Every change of the formula lies on a seam, and every seam is one.

use super::super::pairs::w;
use super::super::places::One;
use super::super::rows::{cell, cell_number, nearest_zero, on_real_axis};
use super::super::slope::derivative;
use super::super::taylor::LONG;
use super::super::tests::Random;
use super::super::{Branch, branch};
use super::*;
use crate::lanes::Plain;
use num_complex::Complex;

/// Returns what serves a point: the formula, and which row of a table.
fn key(a: f64, y: f64) -> (Branch, u16, f64) {
    let branch = branch(Complex::new(a, y));
    match branch {
        Branch::Cell { .. } => (branch, cell_number(cell(a, y.abs())[0]), 0.0),
        Branch::RealAxis { .. } => (branch, 0, on_real_axis(a).0),
        _ => (branch, 0, 0.0),
    }
}

/// Returns whether two numbers are the same but for a few roundings.
fn same(p: f64, q: f64) -> bool {
    (p - q).abs() <= 4e-16 * p.max(q)
}

/// The seam on which the point lies, if it does: a name and a place.
fn seam(a: f64, y: f64) -> Option<(&'static str, f64)> {
    let b = y.abs();
    let r2 = a.mul_add(a, b * b);
    let on = |name, all: &[f64], t: f64| all.iter().find(|&&s| same(s, t)).map(|&s| (name, s));
    let edge = |t: f64| {
        SEAMS.pitches.iter().find_map(|&pitch| {
            let n = t / pitch - 0.5;
            ((n - n.round()).abs() < 1e-13 * n.abs().max(1.0)).then_some(("pitch", pitch))
        })
    };
    on("circle", SEAMS.circles, r2)
        .or_else(|| on("im", SEAMS.im, b))
        .or_else(|| on("re", SEAMS.re, a))
        .or_else(|| edge(a))
        .or_else(|| edge(b))
        .or_else(|| {
            // The edge of the square around a zero.
            let beside = |t: f64| [t * (1.0 - 1e-14), t * (1.0 + 1e-14)];
            let inside = |a: f64, b: f64| nearest_zero(a, b).is_some();
            let around: Vec<bool> = beside(a)
                .into_iter()
                .flat_map(|a| beside(b).map(|b| inside(a, b)))
                .collect();
            (y < 0.0 && around.contains(&true) && around.contains(&false)).then_some(("zero", 0.0))
        })
}

/// The changes along a line from `p` to `q`, of which there may be many, by bisection.
fn changes(p: (f64, f64), q: (f64, f64), found: &mut Vec<(f64, f64)>, depth: u32) {
    let middle = (0.5 * (p.0 + q.0), 0.5 * (p.1 + q.1));
    if key(p.0, p.1) == key(q.0, q.1) && depth > 6 {
        return;
    }
    if middle == p || middle == q {
        if key(p.0, p.1) != key(q.0, q.1) {
            found.push(q);
        }
        return;
    }
    changes(p, middle, found, depth + 1);
    changes(middle, q, found, depth + 1);
}

#[test]
fn every_change_is_on_a_seam() {
    let mut random = Random(19);
    let mut seen = std::collections::BTreeSet::new();
    for k in 0..1500 {
        // A line parallel to an axis: three quarters where the formulas are many.
        let size = match k % 4 {
            0 => random.power(-30.0, 700.0),
            1 => random.power(-3.0, 6.0),
            _ => random.between(0.0, 9.0),
        };
        let across = match k % 3 {
            0 => random.between(0.0, 0.3),
            1 => random.power(-40.0, 0.0) * size,
            _ => random.between(0.0, 9.0),
        };
        let low = if random.below(2) == 0 { 1.0 } else { -1.0 };
        let mut found = Vec::new();
        match random.below(2) {
            0 => changes((1e-280, low * across), (size, low * across), &mut found, 0),
            _ => changes((across, low * 1e-280), (across, low * size), &mut found, 0),
        }
        for (a, y) in found {
            let on = seam(a, y);
            let Some((name, at)) = on else {
                panic!(
                    "{:?} to {:?} at {a:e}, {y:e}, |z|² = {:e}: on no seam",
                    key(a.next_down(), y),
                    key(a, y),
                    a.mul_add(a, y * y)
                );
            };
            seen.insert((name, at.to_bits()));
        }
    }
    let all = |name, all: &'static [f64]| all.iter().map(move |t| (name, t.to_bits()));
    // Batches alone tell [`TINY`]; the hyperbolas choose between two ways of one formula.
    for seam in all("circle", SEAMS.circles)
        .chain(all("im", &SEAMS.im[..3]))
        .chain(all("pitch", SEAMS.pitches))
    {
        let shown = f64::from_bits(seam.1);
        assert!(
            seen.contains(&seam),
            "{} {shown:e} was never crossed",
            seam.0
        );
    }
}

/// Where the relatives change the formula, or its number of terms, both serve.
#[test]
fn circles_of_the_relatives_are_told_apart() {
    let circles = SEAMS_OF_RELATIVES.circles;
    assert!(circles.windows(2).all(|pair| pair[0] < pair[1]));
    let values = |a: f64, b: f64| {
        let places = One(Plain);
        let ((p, q), ((r, s), _)) = (
            w::<_, LONG>(places, a, b, true),
            derivative(places, a, b, true),
        );
        [p, q, r, s].map(|part| part.value())
    };
    for (r2, part) in circles[1..]
        .iter()
        .flat_map(|r2| [(r2, 0.1), (r2, 0.4), (r2, 0.7)])
    {
        let (a, b) = (part * r2.sqrt(), (1.0 - part * part).sqrt() * r2.sqrt());
        for (a, b) in [(a, b), (b, a), (r2.sqrt(), 0.1)] {
            let off = 1e-9;
            let before = values(a * (1.0 - off), b * (1.0 - off));
            let after = values(a * (1.0 + off), b * (1.0 + off));
            for (p, q) in before.iter().zip(after) {
                // The slope of e^{−a²} is the steepest.
                let bound = off * (20.0 + 5.0 * r2.min(800.0));
                assert!(
                    (p - q).abs() <= bound * q.abs(),
                    "{r2} at {a} {b}: {p:e} {q:e}"
                );
            }
        }
    }
}
