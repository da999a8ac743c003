//! Bounds at which a sweep changes its way.

use super::*;

/// λ = −3/4 ± i: `η`, `Im λ` and the gap are exact.
fn roots() -> Roots {
    let roots = Roots::new(1.25, 0.75);
    assert_eq!(roots.lambda, [C::new(-0.75, 1.0), C::new(-0.75, -1.0)]);
    assert_eq!(roots.gap, C::new(0.0, 2.0));
    roots
}

fn sweep(omega0: f64, eps: f64, delta: f64) -> Sweep {
    Sweep::new(&roots(), 1.0, &Chirp { omega0, eps }, delta)
}

/// `(|ν| + κt)t + |δ| < 2³⁰`.
#[test]
fn small_phases() {
    let large = LARGE_PHASE;
    for delta in [0.5, -0.5] {
        for nu in [3.0, -3.0] {
            // (3 + 2·4)·4 + 1/2
            let s = sweep(nu * large / 64.0, 2.0 * large / 64.0, delta * large / 64.0);
            assert!(s.phases_are_small(4.0));
            let half = s.phases_are_small(5.0);
            assert!(!half, "(3 + 2·5)·5 + 1/2 is above 64");
        }
    }
    let s = sweep(0.5 * large - 3.0, 1.0, 2.0);
    assert!(!s.phases_are_small(2.0) && s.phases_are_small(2f64.next_down()));
    assert!(!sweep(f64::MAX, 0.0, 0.0).phases_are_small(1.0));
}

/// A resonance is behind where `ω + Im λ > −Re λ`, and for roots passed together where `ω > n`.
#[test]
fn what_is_behind() {
    let s = sweep(-2.0, 0.125, 0.0);
    assert!(!s.joint);
    let (r, dd) = (roots(), |x: f64| Dd::from(x));
    for (i, edge) in [(0, -0.25), (1, 1.75)] {
        assert!(!s.beyond(&r, i, dd(edge)) && s.beyond(&r, i, dd(edge + 1e-15)));
        assert!(!s.beyond(&r, i, dd(edge - 1e-15)));
    }
    let s = sweep(-2.0, 9.0, 0.0);
    assert!(s.joint);
    for i in [0, 1] {
        assert!(!s.beyond(&r, i, dd(0.75)) && s.beyond(&r, i, dd(0.75f64.next_up())));
    }
}

/// Two values are told apart where the gap is at least half of `|p|`, or of √κ if that is larger.
#[test]
fn told_apart() {
    let (s, r) = (sweep(-2.0, 0.125, 0.0), roots());
    let p = |x: f64| C::new(-x, 0.0);
    assert!(s.apart(&r, [p(4.0), p(9.0)]) && s.apart(&r, [p(9.0), p(4.0)]));
    assert!(!s.apart(&r, [p(4.001), p(9.0)]) && !s.apart(&r, [p(9.0), p(4.001)]));
    let (slow, fast) = (sweep(0.0, 16.0, 0.0), sweep(0.0, 16.01, 0.0));
    assert!(slow.apart(&r, [p(0.0); 2]) && !fast.apart(&r, [p(0.0); 2]));
    // By their series where it is more than the nearer |p|.
    assert!(s.apart_far(&r, 3.999) && !s.apart_far(&r, 4.0) && s.apart_far(&r, 0.0));
}

/// The series serves from `|z|² = |p|²/2κ = 49` on, where it is the same number as by w.
#[test]
fn one_root_by_its_series() {
    let s = sweep(-2.0, 0.125, 0.0);
    let edge = (49.0f64 * 0.25).sqrt();
    assert_eq!(s.distance(C::new(0.0, edge)), FAR);
    assert_eq!(s.far_single(C::new(0.0, edge - 1e-9)), None);
    for p in [
        C::new(-edge, 0.0),
        C::new(-0.75, -edge),
        C::new(-0.75, -9.0),
    ] {
        let f = s.far_single(p).expect("far");
        let due = s.factor() * faddeeva(s.z(p));
        assert!((f - due).norm() < 1e-15 * due.norm(), "{f} {due}");
    }
}
