//! Tridiagonal systems, open and cyclic.

use super::{Answer, hold, lines, same};
use crate::cyclic_tridiagonal::CyclicSweep;
use crate::tridiagonal::{Pivoted, Sweep, TridiagonalError, solve};

fn word(e: TridiagonalError) -> String {
    match e {
        TridiagonalError::Pivot { .. } => "singular",
        TridiagonalError::NotFinite { .. } => "not finite",
        TridiagonalError::Overflow { .. } => "overflow",
        _ => "bad layout",
    }
    .into()
}

/// Lower, diagonal, upper, right side.
fn parts(x: &[f64]) -> [&[f64]; 4] {
    let n = (x.len() + 2) / 4;
    [
        &x[..n - 1],
        &x[n - 1..2 * n - 1],
        &x[2 * n - 1..3 * n - 2],
        &x[3 * n - 2..],
    ]
}

fn cyclic_parts(x: &[f64]) -> [&[f64]; 4] {
    let n = x.len() / 4;
    [0, 1, 2, 3].map(|k| &x[k * n..(k + 1) * n])
}

#[test]
fn open() {
    let sweep = |x: &[f64]| -> Answer {
        let [l, b, u, d] = parts(x);
        Sweep::factor(l, b, u)
            .and_then(|s| s.solve(d))
            .map_err(word)
    };
    // Two right sides, the second one doubled.
    let many = |x: &[f64]| -> Answer {
        let [l, b, u, d] = parts(x);
        let s = Sweep::factor(l, b, u).map_err(word)?;
        let mut all: Vec<f64> = d.iter().map(|d| d / 2.0).chain(d.iter().copied()).collect();
        s.solve_many_in_place(&mut all).map_err(word)?;
        let (first, second) = all.split_at(d.len());
        assert!(first.iter().zip(second).all(|(a, b)| 2.0 * a == *b));
        Ok(second.to_vec())
    };
    let checked = |x: &[f64]| -> Answer {
        let [l, b, u, d] = parts(x);
        let s = solve(l, b, u, d).map_err(word)?;
        Ok(s.x)
    };
    hold(
        "tridiagonal",
        &[("sweep", &sweep), ("many", &many), ("checked", &checked)],
    );
}

#[test]
fn pivoting() {
    let pivoted = |x: &[f64]| -> Answer {
        let [l, b, u, d] = parts(x);
        Pivoted::factor(l, b, u)
            .and_then(|p| p.solve(d))
            .map_err(word)
    };
    hold("tridiagonal-pivoting", &[("pivoted", &pivoted)]);
}

/// Pivoting has another error; three times what the sweep is allowed is ample, and the sweep's
/// refusals need not be its own.
#[test]
fn pivoted() {
    for line in lines("tridiagonal") {
        let Ok(due) = &line.due else { continue };
        let [l, b, u, d] = parts(&line.input);
        let x = Pivoted::factor(l, b, u)
            .and_then(|p| p.solve(d))
            .expect("regular");
        assert_eq!(x.len(), due.len());
        for (x, (value, allowed)) in x.iter().zip(due) {
            assert!(
                (x - value).abs() <= 3.0 * allowed,
                "{}: {x} for {value}",
                line.place
            );
        }
    }
}

#[test]
fn cyclic() {
    let sweep = |x: &[f64]| -> Answer {
        let [l, b, u, d] = cyclic_parts(x);
        CyclicSweep::factor(l, b, u)
            .and_then(|s| s.solve(d))
            .map_err(word)
    };
    let in_place = |x: &[f64]| -> Answer {
        let [l, b, u, d] = cyclic_parts(x);
        let mut x = d.to_vec();
        let s = CyclicSweep::factor(l, b, u).map_err(word)?;
        s.solve_in_place(&mut x).map_err(word)?;
        assert!(
            x.iter()
                .zip(sweep(&[l, b, u, d].concat())?)
                .all(|(a, b)| same(*a, b))
        );
        Ok(x)
    };
    hold(
        "cyclic-tridiagonal",
        &[("sweep", &sweep), ("in place", &in_place)],
    );
}
