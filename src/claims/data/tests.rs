//! Tests of `data`.

use super::*;

/// Within the part of the plane that is tried no zero is left out.
#[test]
fn the_last_zero_is_below() {
    assert!(ZEROS.last().unwrap()[1] < -6.2);
    assert!(!off_zeros(ZEROS[0][0], ZEROS[0][1]) && off_zeros(1.0, -1.0));
}

#[test]
fn every_claim_is_drawn_where_it_holds() {
    for claim in claims() {
        let mut lines = mechaudit_atlas::PROFILES.iter();
        let known = mechaudit_atlas::find(claim.algorithm).is_some()
            || lines.any(|p| p.name == claim.algorithm);
        let missing = mechaudit_atlas::NOT_AT_HAND.iter();
        let missing = missing.into_iter().any(|m| m.name == claim.algorithm);
        assert!(known || missing, "{}", claim.algorithm);
        let Some((place, _, _, bound)) = claim.test else {
            assert!(!claim.reading.is_empty());
            continue;
        };
        assert!(bound > 0.0 && bound.is_finite());
        let inside = (0..200).filter(|i| {
            let z = (place.draw)(&mut Draw::new(1, "atlas", "claim", *i));
            (place.holds)(&z)
        });
        assert!(inside.count() > 100, "{}", claim.statement);
    }
}

/// Uniform up to so much with that probability, else log-uniform.
#[test]
fn points_are_drawn_near_the_axis_and_far() {
    let all = 20_000;
    for (draw, share, flat, [low, high]) in [
        (any_height as fn(&mut Draw) -> f64, 0.5, 8.0, [1e-12, 10.0]),
        (any_real, 0.7, 12.0, [1e-3, 1e4]),
    ] {
        let drawn: Vec<f64> = (0..all)
            .map(|k| draw(&mut Draw::new(1, "atlas", "draws", k)))
            .collect();
        let below = |x: f64| {
            let log = f64::log10(x / low).max(0.0) / f64::log10(high / low);
            share * (x / flat).min(1.0) + (1.0 - share) * log
        };
        for x in [2.0 * low, 1e-6, 0.1, 1.0, 0.6 * flat, flat, 0.9 * high] {
            let found = drawn.iter().filter(|y| **y < x).count() as f64 / all as f64;
            assert!(
                (found - below(x)).abs() < 0.012,
                "{x}: {found} {}",
                below(x)
            );
        }
        let count =
            |range: std::ops::Range<f64>| drawn.iter().filter(|x| range.contains(*x)).count();
        assert!(count(low..1.05 * low) > 4 && count(0.0..low) < 6, "{low}");
        assert!(
            count(0.95 * high..high) > 4 && count(high..2.0 * high) == 0,
            "{high}"
        );
    }
}

#[test]
fn discs_about_the_zeros_are_left_out() {
    for [x, y] in ZEROS.iter() {
        for [dx, dy] in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
            let off = |r: f64| off_zeros(x + r * dx, y + r * dy);
            assert!(!off(0.125) && off(0.127) && off(0.25), "{x} {y}");
        }
    }
}

/// The committed atlas is of these claims, with these bounds.
#[test]
fn the_atlas_decides_these_claims() {
    let held = include_str!("../../../reference/atlas/atlas-claims.csv");
    let mut held = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(held.as_bytes());
    let held: Vec<csv::StringRecord> = held.records().collect::<Result<_, _>>().unwrap();
    let due = claims();
    assert_eq!(held.len(), due.len());
    for (held, due) in held.iter().zip(due) {
        let words = [due.algorithm, due.statement, due.source, due.reading];
        assert!(held.iter().take(4).eq(words), "{held:?} for {words:?}");
        assert_eq!(held[6].parse().ok(), due.test.map(|t| t.3), "{words:?}");
    }
}
