//! Describes what the passage through a resonance leaves behind.

use super::super::types::Chirp;
use super::*;

fn sweep(roots: &Roots, omega0: f64, eps: f64) -> Sweep {
    Sweep::new(roots, 1.0, &Chirp { omega0, eps }, 0.3)
}

/// Decayed beyond all numbers it is zero, whatever its phase.
#[test]
fn a_passage_long_ago() {
    let roots = Roots::new(1.25, 0.75);
    let s = sweep(&roots, 0.0, 1e-100);
    let gone = term(&s, Dd::from(800.0), Dd::ZERO, Dd::from(1e300));
    assert_eq!(gone, C::ZERO);
    let (s, zero) = (sweep(&roots, 0.0, 0.5), Dd::ZERO);
    assert!(term(&s, Dd::from(700.0), zero, zero).norm() > 0.0);
}

/// Both roots one by one are the divided difference times the gap.
#[test]
fn passages_of_one_root() {
    let roots = Roots::new(1.25, 0.75);
    let s = sweep(&roots, -3.0, 0.125);
    assert!(!s.joint);
    for (t, passed) in [(8.0, 0), (24.0, 1), (30.0, 1), (40.0, 2), (50.0, 2)] {
        let omega = s.omega(t);
        let one = |i: usize| passage_of_one(&s, &roots, i, t, omega);
        let (a, b) = (one(0), one(1));
        assert_eq!((a[0] != C::ZERO, b[0] != C::ZERO), (passed > 0, passed > 1));
        let both = passage(&s, &roots, t, omega);
        for j in 0..3 {
            let due = (a[j] - b[j]) / roots.gap;
            assert!((both[j] - due).norm() <= 1e-15 * due.norm(), "{t} {j}");
        }
    }
    // Nothing is left by a resonance that was behind from the start on.
    let s = sweep(&roots, 3.0, 0.125);
    assert_eq!(
        passage_of_one(&s, &roots, 0, 9.0, s.omega(9.0)),
        [C::ZERO; 3]
    );
}

/// A passage is folded into the start up to 300 nats: `n|ν + Im λ|/κ`, here of −i alone, from which
/// it is 0.134, and of `−3/4 − i` with 75/128.
#[test]
fn passages_folded_into_the_start() {
    let roots = Roots::new(1.0, 0.5);
    let folded = |eps: f64| left_behind(&sweep(&roots, 1.0, eps), &roots);
    let state = folded(1e-3).expect("a state");
    assert!(state[0] == [C::ZERO; 2] && state[1][0] != C::ZERO);
    assert!(folded(2.25e-4).is_some() && folded(2.20e-4).is_none());
    let roots = Roots::new(1.25, 0.75);
    let folded = |eps: f64| left_behind(&sweep(&roots, 1.0 + 75.0 / 128.0, eps), &roots);
    let eps = 0.75 * 0.5f64.powi(9);
    assert!(folded(eps).is_some() && folded(eps.next_down()).is_none());
    // Both ahead: the farther one decides.
    let roots = Roots::new(1.0, 0.5);
    let folded = |eps: f64| left_behind(&sweep(&roots, -10.0, eps), &roots);
    assert!(folded(0.0182).is_some() && folded(0.0180).is_none());
    // At constant speed there are none.
    assert_eq!(
        left_behind(&sweep(&roots, 1.0, 0.0), &roots),
        Some([[C::ZERO; 2]; 2])
    );
    // Those of roots passed together, and of exponentials, are not.
    assert_eq!(left_behind(&sweep(&roots, -3.0, 9.0), &roots), None);
    let over = Roots::new(1.0, 1.5);
    assert_eq!(left_behind(&sweep(&over, -3.0, 0.1), &over), None);
}

/// The folded state is the passage: as a free vibration it is the same at all times.
#[test]
fn a_folded_passage_is_the_passage() {
    use super::super::free::Free;
    let roots = Roots::new(1.25, 0.25);
    let s = sweep(&roots, -3.0, 0.25);
    let states = left_behind(&s, &roots).expect("states");
    for t in [9.0, 18.0, 25.0] {
        let omega = s.omega(t);
        let mut sum = [C::ZERO; 2];
        for i in [0, 1] {
            if s.beyond(&roots, i, omega) {
                sum = [sum[0] + states[i][0], sum[1] + states[i][1]];
            }
        }
        let own = Free::at(&roots, t).motion(roots.w, sum[0], sum[1]);
        for (own, due) in own.iter().zip(passage(&s, &roots, t, omega)) {
            assert!((own - due).norm() <= 1e-13 * due.norm(), "{t}: {own} {due}");
        }
    }
}
