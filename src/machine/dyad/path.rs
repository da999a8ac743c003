//! Positions over the turn of the crank.

use super::{Dyad, Reached, Shape, Turn, turn};
use crate::reference::nearest_f64;
use crate::solvers::dyad::{Assembly, DyadError};
use crate::solvers::units::Angle;
use rug::Rational;

/// A position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Position {
    /// The crank angle in degrees.
    pub crank_deg: f64,
    /// The crank's end and the joint at the dyad's other end, in metres.
    pub joints_m: [[f64; 2]; 2],
}

/// The crank's end and the joint at the dyad's other end.
fn joints(shape: &Shape, crank_deg: f64, assembly: Assembly) -> Option<[[f64; 2]; 2]> {
    let (phi, degrees) = (Angle::from_deg(crank_deg), Rational::from_f64(crank_deg)?);
    let (sin, cos) = phi.rad().sin_cos();
    let meet = shape.reached(&degrees) == Some(Reached::Singular);
    let singular = || super::singular::floating(shape, &degrees);
    Some(match shape {
        Shape::FourBar { solver, .. } => {
            let end = [cos, sin].map(|x| solver.crank().m() * x);
            let joint = match (solver.position(phi, assembly), meet) {
                (Ok(m), false) => m.joint.position_m,
                (Err(DyadError::Singular { .. }), _) | (_, true) => {
                    let ([coupler, ..], b) = (singular()?, solver.coupler().m());
                    [end[0] + b * coupler.cos(), end[1] + b * coupler.sin()]
                }
                (Err(_), false) => return None,
            };
            [end, joint]
        }
        Shape::SliderCrank { solver, .. } => {
            let slider = match (solver.position(phi, assembly), meet) {
                (Ok(m), false) => m.slider_m,
                (Err(DyadError::Singular { .. }), _) | (_, true) => singular()?[0],
                (Err(_), false) => return None,
            };
            let (e, (s, c)) = (solver.offset().m(), solver.direction().rad().sin_cos());
            let end = [cos, sin].map(|x| solver.crank().m() * x);
            [end, [slider * c - e * s, slider * s + e * c]]
        }
    })
}

/// A turn from the start, or the range that holds the start, or the first one, in degrees; whether
/// it is a turn.
pub fn range(dyad: &Dyad) -> ([f64; 2], bool) {
    let start = dyad.start.as_ref().map_or(0.0, nearest_f64);
    match turn(&dyad.shape) {
        Turn::Full { .. } => ([start, start + 360.0], true),
        Turn::Parts(parts) => {
            let holds = |p: &&[f64; 2]| (start - p[0]).rem_euclid(360.0) <= p[1] - p[0];
            let part = parts.iter().find(holds).or(parts.first());
            (part.copied().unwrap_or([start, start]), false)
        }
    }
}

/// Up to `n + 1` positions of one assembly over a turn, or over the range of the crank that holds
/// the start; whether it is a turn.
pub fn path(dyad: &Dyad, assembly: Assembly, n: u32) -> (Vec<Position>, bool) {
    let ([from, to], whole) = range(dyad);
    let at = |k: u32| from + (to - from) * f64::from(k) / f64::from(n);
    let all = (0..=n).filter_map(|k| position(dyad, assembly, at(k)));
    (all.collect(), whole)
}

/// The position at a crank angle in degrees; nothing where the crank does not reach it.
pub fn position(dyad: &Dyad, assembly: Assembly, crank_deg: f64) -> Option<Position> {
    let joints_m = joints(&dyad.shape, crank_deg, assembly)?;
    Some(Position {
        crank_deg,
        joints_m,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{Linkage, Source};

    fn dyad(geometry: &str) -> Dyad {
        match Linkage::read(&Source::toml(geometry)).unwrap() {
            Linkage::Dyad(dyad) => *dyad,
            _ => unreachable!("a dyad"),
        }
    }

    /// Links keep their lengths; a slider stays on its guide, a rocker at its pivot.
    #[test]
    fn joints_are_where_the_links_put_them() {
        let slider = dyad(
            "type = \"slider-crank\"\n[geometry]\ncrank = \"2 m\"\nrod = \"5 m\"\noffset = \"1 m\"\n\
             direction = \"30 deg\"",
        );
        let bar = dyad(
            "type = \"four-bar\"\n[geometry]\ncrank = \"10 m\"\ncoupler = \"40 m\"\nrocker = \"30 m\"\n\
             frame = \"35 m\"",
        );
        let apart = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
        let near = |x: f64, due: f64| assert!((x - due).abs() < 1e-12 * 40.0, "{x} {due}");
        for assembly in [Assembly::Positive, Assembly::Negative] {
            for deg in [0.0, 40.0, 115.0, 250.0] {
                let [a, b] = position(&slider, assembly, deg).unwrap().joints_m;
                near(a[0].hypot(a[1]), 2.0);
                near(
                    a[1].atan2(a[0]).rem_euclid(std::f64::consts::TAU),
                    deg.to_radians(),
                );
                near(apart(a, b), 5.0);
                let (s, c) = 30f64.to_radians().sin_cos();
                near(c * b[1] - s * b[0], 1.0);
                let [a, b] = position(&bar, assembly, deg).unwrap().joints_m;
                near(a[0].hypot(a[1]), 10.0);
                near(apart(a, b), 40.0);
                near(apart(b, [35.0, 0.0]), 30.0);
            }
        }
    }

    #[test]
    fn the_range_is_the_one_that_holds_the_start_its_ends_included() {
        let mut bar = dyad(
            "type = \"four-bar\"\n[geometry]\ncrank = \"3 m\"\ncoupler = \"2 m\"\nrocker = \"3 m\"\n\
             frame = \"3 m\"",
        );
        let Turn::Parts(parts) = turn(&bar.shape) else {
            panic!("the crank does not turn fully");
        };
        assert_eq!(parts.len(), 2);
        for part in &parts {
            for start in [part[0], 0.5 * (part[0] + part[1]), part[1]] {
                bar.start = rug::Rational::from_f64(start);
                assert_eq!(range(&bar), (*part, false));
            }
        }
        bar.start = None;
        assert_eq!(range(&bar), (parts[0], false));
    }
}
