//! Which position is nearest is told rightly or not at all.

use super::super::Position;
use super::super::soundness_tests::{ball, both};
use super::super::tests::{cranked, four_bar};
use crate::{Ball, Mag};

/// With two positions nearby, only a guess clearly next to one of them gets it; without any, none.
#[test]
fn the_nearest_position_is_told_or_not_at_all() {
    let linkage = cranked(&four_bar());
    let phi = ball("0.9");
    let [upper, lower] = both(&linkage, &phi);
    let near = |p: &Position, by: f64| -> Vec<f64> {
        let x = p.x.iter().skip(1).map(|x| x.to_f64() + by);
        std::iter::once(0.9).chain(x).collect()
    };
    for (position, by) in [(&upper, 1e-9), (&upper, -0.05), (&lower, 0.05)] {
        let found = linkage.nearest(&phi, &near(position, by), 0.1).unwrap();
        assert!(found.unwrap().x[1].overlaps(&position.x[1]), "{by}");
    }
    // Between both, where Newton's method goes to one of them.
    let middle: Vec<f64> = (0..3)
        .map(|k| 0.49 * upper.x[k].to_f64() + 0.51 * lower.x[k].to_f64())
        .collect();
    assert!(linkage.nearest(&phi, &middle, 10.0).is_err());
    // Far from both, and farther off than asked for.
    let far = [0.9, 2.5, -0.5];
    assert!(linkage.nearest(&phi, &far, 0.1).unwrap().is_none());
    assert!(linkage.nearest(&phi, &near(&upper, 0.2), 0.1).is_err());
}

/// From guesses all over, Newton's method often goes to the farther position: none of those is
/// given as the nearest.
#[test]
fn a_farther_position_is_never_the_nearest() {
    let linkage = cranked(&four_bar());
    let phi = ball("0.9");
    let positions = both(&linkage, &phi);
    // The larger difference of coupler and rocker, whole turns taken off.
    let off = |p: &Position, g: &[f64]| {
        let way = |k: usize| {
            let d = p.x[k].to_f64() - g[k];
            (d - std::f64::consts::TAU * (d / std::f64::consts::TAU).round()).abs()
        };
        way(1).max(way(2))
    };
    let (mut told, mut open) = (0, 0);
    for (i, k) in (-8..8).flat_map(|i| (-8..8).map(move |k| (i, k))) {
        let g = [0.9, 0.4 * f64::from(i), 0.4 * f64::from(k)];
        match linkage.nearest(&phi, &g, 10.0) {
            Ok(Some(found)) => {
                let way = (1..3).map(|k| (found.x[k].to_f64() - g[k]).abs());
                let way = way.fold(0.0, f64::max);
                assert!(positions.iter().all(|p| way <= off(p, &g) + 1e-12), "{g:?}");
                told += 1;
            }
            _ => open += 1,
        }
    }
    assert!(told > 0 && open > 0, "{told} {open}");
}

/// The loops of the four-bar are shown to be one to one up to the distance where `‖I − Y F'(X)‖` is
/// one: directions are off by the half-width d, so that the sum of row i is
/// `(2 + 7/2 + 3) d (|Y_i1| + |Y_i2|)`.
#[test]
fn a_position_is_the_nearest_as_far_as_the_contraction_shows() {
    let linkage = cranked(&four_bar());
    let phi = ball("0.9");
    let [upper, _] = both(&linkage, &phi);
    let x: Vec<f64> = upper.x.iter().map(Ball::to_f64).collect();
    // The largest such factor at a distance d in the coupler's angle.
    let sum = |d: f64| {
        let [(s, c), (t, k)] = [x[1] + d, x[2]].map(f64::sin_cos);
        // [a b; c d] = [−7/2 s, 3 t; 7/2 c, −3 k].
        let det = 10.5 * (s * k - c * t).abs();
        let coupler = 3.0 * (t.abs() + k.abs()) / det;
        let rocker = 3.5 * (s.abs() + c.abs()) / det;
        8.5 * d * coupler.max(rocker)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        let side = if sum(middle) < 1.0 {
            &mut low
        } else {
            &mut high
        };
        *side = middle;
    }
    let at = |d: f64| linkage.nearest(&phi, &[x[0], x[1] + d, x[2]], 10.0);
    let found = at(0.9999 * low).unwrap().expect("a position");
    assert!(found.x[1].overlaps(&upper.x[1]));
    for beyond in [1.0001, 1.2, 1.5, 1.9] {
        assert!(at(beyond * low).is_err(), "{beyond}");
    }
}

/// A position that is known within a radius only is as far off as its farthest part.
#[test]
fn a_position_has_to_lie_within_reach_as_a_whole() {
    let linkage = cranked(&four_bar());
    let phi = ball("0.9").widened(Mag::power_of_two(-20));
    let [upper, _] = both(&linkage, &ball("0.9"));
    let guess: Vec<f64> = upper.x.iter().map(Ball::to_f64).collect();
    let found = linkage.nearest(&phi, &guess, 0.1).unwrap().unwrap();
    let off = found.x.iter().zip(&guess).map(|(x, g)| {
        let way = (x.mid().to_f64() - g).abs();
        way + x.rad().to_f64()
    });
    let off = off.fold(0.0, f64::max);
    assert!(off > 5e-7 && off < 1e-4, "{off}");
    assert!(linkage.nearest(&phi, &guess, 1.01 * off).unwrap().is_some());
    assert!(linkage.nearest(&phi, &guess, 0.99 * off).is_err());
}
