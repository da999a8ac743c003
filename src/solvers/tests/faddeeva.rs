//! The Faddeeva function and its relatives.

use super::{Line, half_ulp, hold, lines, same};
use crate::faddeeva::*;
use num_complex::Complex;

type C = Complex<f64>;

fn points(lines: &[Line]) -> Vec<C> {
    lines
        .iter()
        .map(|l| Complex::new(l.input[0], l.input[1]))
        .collect()
}

fn function(method: &str, f: fn(C) -> C) {
    hold(
        method,
        &[("one point", &|x| {
            let w = f(Complex::new(x[0], x[1]));
            Ok(vec![w.re, w.im])
        })],
    );
}

/// The batch has the bits of the single points, in any order and number.
fn batch(method: &str, one: fn(C) -> C, many: impl Fn(&[C]) -> Vec<C>) {
    let z = points(&lines(method));
    let mixed: Vec<C> = (0..z.len()).map(|i| z[i * 7919 % z.len()]).collect();
    for z in [&z[..], &mixed, &z[..63], &z[..64], &z[..65], &z[..1], &[]] {
        let w = many(z);
        assert_eq!(w.len(), z.len());
        for (z, w) in z.iter().zip(w) {
            let due = one(*z);
            let right = same(due.re, w.re) && same(due.im, w.im);
            assert!(right, "{method}, batch, at {z}: {w} where {due} is due");
        }
    }
}

/// Checks a function of a real argument against the lines on the real axis, to a unit in the last
/// place or what is allowed there.
fn real(method: &str, f: fn(f64) -> f64, part: usize, axis: usize) {
    let mut met = 0;
    for line in lines(method) {
        let (Ok(due), 0.0) = (&line.due, line.input[1 - axis]) else {
            continue;
        };
        let (value, allowed) = due[part];
        let got = f(line.input[axis]);
        let off = (got - value).abs();
        let right = same(got, value)
            || got == value
            || off <= allowed.max(2.0 * half_ulp(value)) + half_ulp(value);
        assert!(
            right,
            "{method}, real, at {}: {got} where {value} is due",
            line.input[axis]
        );
        met += 1;
    }
    assert!(met > 40, "{met} lines on the axis");
}

#[test]
fn w() {
    function("faddeeva", faddeeva);
}

#[test]
fn every_branch_is_met() {
    let kinds = lines("faddeeva");
    let mut met: Vec<String> = points(&kinds)
        .into_iter()
        .map(|z| format!("{:?}", branch(z)))
        .collect();
    met.sort();
    met.dedup();
    let starts = |name: &str| met.iter().filter(|b| b.starts_with(name)).count();
    for name in [
        "Maclaurin",
        "Cell",
        "LowerCell",
        "ImaginaryAxis",
        "RealAxis",
        "Strip",
        "Huge",
    ] {
        assert!(starts(name) > 0, "{name} is not met: {met:?}");
    }
    assert!(starts("Asymptotic") >= 4, "{met:?}");
    assert_eq!(starts("Zero"), 12, "{met:?}");
    let zeros: std::collections::BTreeSet<u32> = points(&kinds)
        .into_iter()
        .filter_map(|z| match branch(z) {
            Branch::Zero { zero, .. } => Some(zero),
            _ => None,
        })
        .collect();
    assert!(zeros.into_iter().eq(1..=12), "zeros are counted from 1");
}

#[test]
fn error_functions() {
    function("erf", erf);
    function("erfc", erfc);
    function("erfcx", erfcx);
    function("erfi", erfi);
    batch("erfcx", erfcx, |z| {
        let mut w = vec![C::default(); z.len()];
        erfcx_batch(z, &mut w).expect("the same length");
        w
    });
    real("erf", erf_real, 0, 0);
    real("erfc", erfc_real, 0, 0);
    real("erfcx", erfcx_real, 0, 0);
    real("erfi", erfi_real, 0, 0);
}

#[test]
fn dawson_and_the_derivative() {
    function("dawson", dawson);
    function("faddeeva-derivative", w_derivative);
    real("dawson", dawson_real, 0, 0);
}

#[test]
fn profiles() {
    hold(
        "voigt",
        &[("one point", &|x| Ok(vec![voigt(x[0], x[1], x[2])]))],
    );
    hold(
        "voigt-hwhm",
        &[("one pair", &|x| Ok(vec![voigt_hwhm(x[0], x[1])]))],
    );
    let all = lines("voigt");
    let x: Vec<f64> = all.iter().map(|l| l.input[0]).collect();
    for line in all.iter().step_by(3) {
        let (sigma, gamma) = (line.input[1], line.input[2]);
        let mut v = vec![0.0; x.len()];
        voigt_batch(&x, sigma, gamma, &mut v).expect("the same length");
        for (x, v) in x.iter().zip(v) {
            let due = voigt(*x, sigma, gamma);
            assert!(
                same(due, v),
                "voigt({x}, {sigma}, {gamma}): {v} where {due} is due"
            );
        }
    }
}

#[test]
fn lengths_have_to_agree() {
    assert!(erfcx_batch(&[C::default(); 3], &mut [C::default(); 2]).is_err());
    assert!(voigt_batch(&[0.0; 3], 1.0, 1.0, &mut [0.0; 4]).is_err());
}
