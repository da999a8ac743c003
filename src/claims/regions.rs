//! Where algorithms are surveyed.
//!
//! Powers and angles are those of the `libm` crate: the points come out the same on every machine.

use crate::audit::{Draw, Region};
use std::f64::consts::PI;

/// With either sign of the real part.
pub fn either_side(x: f64, y: f64, d: &mut Draw) -> Vec<f64> {
    vec![d.signed(x), y]
}

/// A multiple of 1/4 up to a quarter of `count`; not zero, where Im w is exactly zero.
pub fn fourth(d: &mut Draw, count: f64) -> f64 {
    (d.uniform(0.0, count).floor() + 1.0) * 0.25
}

fn polar(r: f64, angle: f64) -> Vec<f64> {
    let (sin, cos) = libm::sincos(angle);
    vec![r * cos, r * sin]
}

/// A region of that name.
pub fn region(
    name: &'static str,
    description: &'static str,
    sample: impl Fn(&mut Draw) -> Vec<f64> + Send + Sync + 'static,
) -> Region {
    Region::new(name, description, sample)
}

/// Of the upper half-plane.
pub fn upper() -> Vec<Region> {
    vec![
        region("ordinary", "|Re z| < 8, Im z = 0.1..8", |d| {
            either_side(d.uniform(0.0, 8.0), d.uniform(0.1, 8.0), d)
        }),
        region("beside-axis", "|Re z| < 8, Im z = 1e-8..0.1", |d| {
            either_side(d.uniform(0.0, 8.0), d.log_uniform(1e-8, 0.1), d)
        }),
        region("at-axis", "|Re z| < 8, Im z = 1e-300..1e-8", |d| {
            either_side(d.uniform(0.0, 8.0), d.log_uniform(1e-300, 1e-8), d)
        }),
        region("on-axis", "|Re z| < 8, Im z = 0", |d| {
            either_side(d.uniform(0.0, 8.0), 0.0, d)
        }),
        region("grid", "|Re z| = 1/4, 1/2, .. 8, Im z = 1e-12..0.1", |d| {
            // Nodes of quadrature, points of tables, and what users ask for.
            either_side(fourth(d, 32.0), d.log_uniform(1e-12, 0.1), d)
        }),
        region("wings", "|Re z| = 8..1e4, Im z = 1e-8..0.1", |d| {
            either_side(d.log_uniform(8.0, 1e4), d.log_uniform(1e-8, 0.1), d)
        }),
        region("far", "|z| = 8..1e8, every direction above the axis", |d| {
            polar(d.log_uniform(8.0, 1e8), d.uniform(0.0, PI))
        }),
        region("origin", "|z| = 1e-8..0.1, likewise", |d| {
            polar(d.log_uniform(1e-8, 0.1), d.uniform(0.0, PI))
        }),
        region("imaginary-axis", "|Re z| = 1e-8..0.1, Im z = 0..30", |d| {
            either_side(d.log_uniform(1e-8, 0.1), d.uniform(0.0, 30.0), d)
        }),
        region(
            "huge",
            "|z| = 1e8..1e300, every direction above the axis",
            |d| polar(d.log_uniform(1e8, 1e300), d.uniform(0.0, PI)),
        ),
    ]
}

/// Below the axis, for algorithms of the whole plane.
pub fn lower() -> Vec<Region> {
    vec![region("lower", "|Re z| < 8, -6 <= Im z < 0", |d| {
        either_side(d.uniform(0.0, 8.0), -d.uniform(0.0, 6.0), d)
    })]
}

/// The part of [`upper`] that a single-precision code is asked for.
pub fn of_single() -> Vec<Region> {
    let left = ["at-axis", "huge"];
    let mut all = upper();
    all.retain(|r| !left.contains(&r.name));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn multiples_of_a_fourth_are_all_drawn_but_zero() {
        let drawn = (0..2000).map(|k| fourth(&mut Draw::new(1, "atlas", "fourth", k), 32.0) * 4.0);
        let drawn: BTreeSet<u64> = drawn.map(f64::to_bits).collect();
        let due: BTreeSet<u64> = (1..=32).map(|k| f64::from(k).to_bits()).collect();
        assert_eq!(drawn, due);
    }

    #[test]
    fn single_precision_leaves_out_what_it_cannot_hold() {
        let names = |all: Vec<Region>| -> Vec<&str> { all.iter().map(|r| r.name).collect() };
        let mut due = names(upper());
        due.retain(|name| !["at-axis", "huge"].contains(name));
        assert_eq!(due.len(), 8);
        assert_eq!(names(of_single()), due);
    }

    #[test]
    fn each_region_is_drawn_on_its_side_of_the_axis() {
        for (regions, sign) in [(upper(), 1.0), (lower(), -1.0)] {
            for r in regions {
                let points = (0..100).map(|k| (r.sample)(&mut Draw::new(1, "atlas", r.name, k)));
                let points: Vec<Vec<f64>> = points.collect();
                assert!(
                    points.iter().all(|z| z.len() == 2 && z[1] * sign >= 0.0),
                    "{}",
                    r.name
                );
                let left = points.iter().filter(|z| z[0] < 0.0).count();
                assert!((25..75).contains(&left), "{}: {left}", r.name);
            }
        }
    }
}
