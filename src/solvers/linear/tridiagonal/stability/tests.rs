//! The estimate of a norm: the vectors it asks for, and the value from each.

use super::*;
use std::cell::RefCell;

/// The vectors that `inverse_norm_1` has multiplied with `B` and with `Bᵀ`, and its estimate.
fn asked(
    n: usize,
    apply: impl Fn(&mut [f64]),
    transposed: impl Fn(&mut [f64]),
) -> (Vec<Vec<f64>>, Vec<Vec<f64>>, f64) {
    let (plain, other) = (RefCell::new(Vec::new()), RefCell::new(Vec::new()));
    let norm = inverse_norm_1(
        n,
        |v| {
            plain.borrow_mut().push(v.to_vec());
            apply(v);
        },
        |v| {
            other.borrow_mut().push(v.to_vec());
            transposed(v);
        },
    );
    (plain.into_inner(), other.into_inner(), norm)
}

/// The identity: no column is larger than the mean, so the search ends at once and the vector of
/// alternating signs follows.
#[test]
fn vectors_asked_for() {
    let (plain, other, norm) = asked(5, |_| {}, |_| {});
    assert_eq!(plain, [[0.2; 5], [1.0, -1.25, 1.5, -1.75, 2.0]]);
    assert_eq!((other, norm), (vec![vec![1.0; 5]], 1.0));
    let (plain, _, norm) = asked(2, |_| {}, |_| {});
    assert_eq!((plain[1].clone(), norm), (vec![1.0, -2.0], 1.0));
    let (plain, _, norm) = asked(1, |_| {}, |_| {});
    assert_eq!((plain, norm), (vec![vec![1.0], vec![1.0]], 1.0));
    // diag(1, 4, 2): the second column is the largest, and then none is larger.
    let scaled = |v: &mut [f64]| {
        for (v, f) in v.iter_mut().zip([1.0, 4.0, 2.0]) {
            *v *= f;
        }
    };
    let (plain, other, norm) = asked(3, scaled, scaled);
    assert_eq!((plain.len(), other.len(), norm), (3, 2, 4.0));
    assert_eq!(plain[1..], [[0.0, 1.0, 0.0], [1.0, -1.5, 2.0]]);
}

/// `v vᵀ` with the signs of `v` alternating: only the last vector sees anything (Higham, §15.2),
/// `‖v vᵀ x‖₁ = n · 3n/2` and with the factor `2/(3n)` the norm itself.
#[test]
fn signs_that_cancel() {
    let b = |v: &mut [f64]| {
        let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        let sum: f64 = v.iter().enumerate().map(|(i, v)| sign(i) * v).sum();
        for (i, v) in v.iter_mut().enumerate() {
            *v = sign(i) * sum + 0.0;
        }
    };
    for n in [2, 4, 6, 10] {
        let (plain, _, norm) = asked(n, b, b);
        assert_eq!(plain.len(), 2);
        assert!((norm / n as f64 - 1.0).abs() < 1e-14, "{n}: {norm}");
    }
}

/// `A = [1 2; 0 4]`: `|A⁻¹||A|` is `[1 4; 0 1]` of norm 5, by Hager's method exactly.
#[test]
fn skeel_of_a_triangle() {
    let run = |v: &mut [f64]| {
        v[1] /= 4.0;
        v[0] -= 2.0 * v[1];
    };
    let run_transposed = |v: &mut [f64]| v[1] = (v[1] - 2.0 * v[0]) / 4.0;
    let s = stability(1.0, false, 6.0, &[3.0, 4.0], run, run_transposed);
    assert_eq!(s.skeel, 5.0);
    // ‖A⁻¹‖₁ = 1: the columns of A⁻¹ are (1, 0) and (−½, ¼).
    assert_eq!(s.rcond, 1.0 / 6.0);
}

/// An estimate of exactly 2⁻²⁶ is no longer below it.
#[test]
fn reliable_below_half_of_the_digits() {
    let at = |skeel: f64| Stability {
        growth: 1.0,
        dominant: false,
        rcond: 0.0,
        skeel,
    };
    let limit = 2f64.powi(25);
    assert_eq!(at(limit).relative_error(), 2f64.powi(-26));
    assert!(!at(limit).is_reliable() && at(limit.next_down()).is_reliable());
}
