//! Which position is nearest is told rightly or not at all.

use super::Position;
use super::soundness_tests::both;
use super::tests::{cranked, four_bar};
use crate::Ball;
use crate::class_iii::tests::q;

fn ball(text: &str) -> Ball {
    Ball::rational(160, &q(text))
}

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

/// From guesses all over, Newton's method often goes to the farther position: none of those is given as the nearest.
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
