//! The search for zeros and roots: what it finds, and that it does no more work than it has to.

use super::*;
use std::cell::Cell;

/// The zero and the number of values asked for, that at the lower end aside.
fn search(f: impl Fn(f64) -> f64, lo: f64, hi: f64) -> (f64, u32) {
    let asked = Cell::new(0);
    let counted = |x: f64| {
        asked.set(asked.get() + 1);
        assert!((lo..=hi).contains(&x), "{x}");
        f(x)
    };
    let x = zero_between(counted, [lo, hi], f(lo));
    (x, asked.get())
}

/// Name, function, ends, zero, most evaluations.
type Bracketed<'a> = (&'a str, &'a dyn Fn(f64) -> f64, f64, f64, f64, u32);

#[test]
fn brackets_close_in_few_steps() {
    // The first secant of a line meets its zero: one value there, one at the upper end.
    assert_eq!(search(|x| 2.0 * x - 1.0, 0.0, 2.0), (0.5, 2));
    assert_eq!(search(|x| 3.0 - x, -1.0, 7.0), (3.0, 2));
    let cases: [Bracketed; 9] = [
        ("x² − 2", &|x| x * x - 2.0, 0.0, 2.0, 2f64.sqrt(), 8),
        ("2 − x²", &|x| 2.0 - x * x, 0.0, 2.0, 2f64.sqrt(), 8),
        (
            "x² − 2 from −2",
            &|x| x * x - 2.0,
            -2.0,
            -1.0,
            -(2f64.sqrt()),
            7,
        ),
        (
            "x³ − 20",
            &|x| x * x * x - 20.0,
            0.0,
            8.0,
            2.7144176165949063,
            11,
        ),
        ("x³ − x", &|x| x * x * x - x, 0.5, 100.0, 1.0, 16),
        // Halved from the first to the last.
        (
            "a sign",
            &|x| if x < 0.3 { -1.0 } else { 1.0 },
            0.0,
            1.0,
            0.3,
            51,
        ),
        ("at the end", &|x| (x - 1.0) - 1e-20, 1.0, 2.0, 1.0, 2),
        ("at the beginning", &|x| (x - 2.0) + 1e-20, 1.0, 2.0, 2.0, 2),
        ("x⁵", &|x| x * x * x * x * x, -1.0, 1.25, 0.0, 61),
    ];
    for (name, f, lo, hi, due, most) in cases {
        let (x, asked) = search(f, lo, hi);
        assert!(
            (x - due).abs() <= 4.0 * f64::EPSILON * (1.0 + due.abs()),
            "{name}: {x}"
        );
        assert_eq!(asked, most, "{name}");
    }
}

/// Evenly about the unit circle, but no two mirrored in it or in the real axis.
#[test]
fn starts_have_no_symmetry() {
    for n in 1..=6 {
        let z = starts(n);
        assert_eq!(z.len(), n);
        for (k, a) in z.iter().enumerate() {
            assert!((a.norm() - 1.0 - 0.03 * k as f64).abs() < 1e-15, "{n} {k}");
            let turn = std::f64::consts::TAU / n as f64 * k as f64;
            assert!(wrap(a.arg() - 0.4 - turn).abs() < 1e-14, "{n} {k}");
            for b in &z[..=k] {
                assert!((a.conj() - b).norm() > 0.01);
                assert!(k == 0 || (a.conj().inv() - b).norm() > 0.01);
            }
        }
    }
}

/// Coefficients of the polynomial with these roots.
pub(super) fn expanded(roots: &[Complex64]) -> Vec<Complex64> {
    let mut p = vec![Complex64::new(1.0, 0.0)];
    for r in roots {
        let mut next = vec![Complex64::new(0.0, 0.0); p.len() + 1];
        for (k, a) in p.iter().enumerate() {
            next[k + 1] += a;
            next[k] -= a * r;
        }
        p = next;
    }
    p
}

/// Rounds of Aberth's method: a few where roots are simple, whatever their size.
#[test]
fn rounds_until_the_roots_rest() {
    let c = Complex64::new;
    let sets = [
        vec![c(2.0, 1.0)],
        vec![c(0.0, 1.0), c(0.0, -1.0)],
        vec![c(1.0, 0.5), c(-1.0, 0.3), c(0.2, -1.5)],
        vec![c(1e-6, 2e-6), c(1e6, -1e6)],
        vec![c(1e5, 3e5), c(-2e5, 1e5), c(1e5, -1e5)],
        vec![c(1e-5, 3e-5), c(-2e-5, 1e-5), c(1e-5, -1e-5)],
    ];
    for (roots, most) in sets.iter().zip([2, 5, 4, 8, 19, 19]) {
        let p = expanded(roots);
        let mut z = starts(roots.len());
        let rounds = aberth(&p, &mut z);
        assert!(rounds <= most, "{roots:?}: {rounds}");
        for r in roots {
            let near = z.iter().map(|z| (z - r).norm()).fold(f64::MAX, f64::min);
            assert!(near <= 1e-14 * r.norm(), "{r}: {z:?}");
        }
    }
}

/// Two starts at one place, where the method has no direction, are set apart.
#[test]
fn starts_that_coincide() {
    let c = Complex64::new;
    let p = expanded(&[c(1.0, 0.0), c(-1.0, 0.5)]);
    let mut z = vec![c(0.5, 0.5); 2];
    let rounds = aberth(&p, &mut z);
    assert!(rounds <= 10, "{rounds}");
    assert!(z.iter().any(|z| (z - c(1.0, 0.0)).norm() < 1e-15));
    assert!(z.iter().any(|z| (z - c(-1.0, 0.5)).norm() < 1e-15));
}
