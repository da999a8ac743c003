//! Sums with few places, where every bound matters.

use super::super::tests::point;
use super::*;

/// `Σ w^k/k! = e^w`.
#[test]
fn sums_hold_the_function() {
    let factorials = |k: u64| (1, k + 1);
    for bits in [2, 5, 8, 10, 13, 40, 300] {
        for (x, y) in [
            (0.25, 0.0),
            (15.0 / 1024.0, 0.0),
            (-5.5, 0.0),
            (3.0, 0.3),
            (-2.0, 7.0),
            (0.0, -4.6),
            (0.1, 1e-9),
        ] {
            let w = point(x, y);
            let found = series(&w, bits, factorials).unwrap();
            let value = super::super::exp(&w, 400).unwrap();
            assert!(found.overlaps(&value), "{x} {y} {bits}: {found:?}");
            // Twice the first omitted term, of 16 units in each part, and a unit of the last place for
            // each term, of which there are fewer than bits.
            let due = (64.0 + f64::from(bits)) * x.hypot(y).exp() * 2f64.powi(-(bits as i32));
            assert!(
                found.radius() <= Mag::from_f64(due),
                "{x} {y} {bits}: {found:?}"
            );
            let wide = series(&w.widened(Mag::from_f64(0.125)), bits, factorials).unwrap();
            for (s, t) in [(-0.12, 0.12), (0.12, 0.0)] {
                let value = super::super::exp(&point(x + s, y + t), 400).unwrap();
                assert!(wide.overlaps(&value), "{x} {y} {bits}: {wide:?}");
            }
        }
    }
}

#[test]
fn turned_sums_are_those_at_turned_numbers() {
    let factorials = |k: u64| (1, k + 1);
    let w = point(0.75, -0.5);
    let all = sum(&w, 200, Kind::Convergent, factorials).unwrap();
    let mut turned = w;
    for m in 0..4 {
        let value = super::super::exp(&turned, 300).unwrap();
        assert!(all.at(m).widened(all.next.shift(1)).overlaps(&value), "{m}");
        turned = turned.turned();
    }
}

#[test]
fn an_asymptotic_series_ends_before_its_terms_grow() {
    let found = sum(&point(0.1, 0.0), 200, Kind::Asymptotic, |k| {
        (-(k as i64) - 1, 1)
    })
    .unwrap();
    assert!((9..=11).contains(&found.terms), "{}", found.terms);
    assert!(found.next >= Mag::from_f64(3.6e-4) && found.next <= Mag::from_f64(1e-3));
}
