//! The dead positions: crank and link 2 in one line, the other links momentarily at rest.

use super::data;
use crate::papers::file::{Measured, Quantity};
use crate::reference::class_iii::{Configuration, ExactAngle, Kinematics, Linkage};
use crate::reference::{Ball, Mag};

/// Working precision: 20 digits after the point and room for cancellation.
const BITS: u32 = 160;
/// Steps of Newton's method, of which four would do.
const STEPS: usize = 6;

/// The crank angles between which the two dead positions are looked for, in degrees.
const BRACKETS: [(&str, &str); 2] = [("14.42", "14.43"), ("196.01", "196.02")];

/// The derivative of `A × B`, which is `l1 l2 sin(φ2 − φ1)`, by the crank angle.
fn slope(k: &Kinematics) -> Ball {
    let [a, b, ..] = &k.joints;
    a.first.cross(&b.r) + a.r.cross(&b.first)
}

/// Encloses the dead position between two crank angles by the interval Newton method: an image
/// inside of its argument proves that there is one, and the only one between them (R. E. Moore,
/// *Interval Analysis*, 1966, §7). Every position on the way is proved to lie on the branch of row
/// 0. None without that proof.
fn dead(
    linkage: &Linkage,
    row0: &Configuration,
    bracket: (&str, &str),
) -> Option<(Ball, Kinematics)> {
    let degrees = |text| ExactAngle::Degrees(data::decimal(text)).to_ball(BITS);
    let low = degrees(bracket.0);
    let base = linkage.follow(row0, &degrees(data::START_DEG), &low)?;
    let at = |phi: &Ball| linkage.follow(&base, &low, phi);
    let mut arc = low.union(&degrees(bracket.1));
    for step in 0..STEPS {
        let slope = slope(&linkage.kinematics(&at(&arc)?).ok()?);
        let middle = Ball::new(arc.mid().clone(), Mag::ZERO);
        let here = at(&middle)?;
        let next = &middle - &(&here.a.cross(&here.b) / &slope);
        match arc.contains_ball(&next) {
            true => arc = next,
            false if step == 0 => return None,
            false => break,
        }
    }
    let motion = linkage.kinematics(&at(&arc)?).ok()?;
    Some((arc, motion))
}

/// The dead positions' angles in degrees; the largest speed of the links that are at rest there;
/// and the cosine of the angle between crank and link 2, which is positive if they are stretched.
pub(super) fn measure(measured: &mut Measured) {
    let Ok((linkage, row0)) = data::start(BITS) else {
        return;
    };
    let unit = &Ball::integer(BITS, 180) / &Ball::pi(BITS);
    for (name, bracket) in ["stretched", "folded"].into_iter().zip(BRACKETS) {
        let Some((phi1, motion)) = dead(&linkage, &row0, bracket) else {
            continue;
        };
        let mut ball = |part: &str, x| measured.add(format!("{name}_{part}"), Quantity::Number(x));
        ball("1", &phi1 * &unit);
        for (k, angle) in motion.angles.iter().enumerate() {
            ball(&(k + 2).to_string(), angle * &unit);
        }
        let [a, b, ..] = &motion.joints;
        ball("along", a.r.dot(&b.r));
        let rates = motion.first[1..]
            .iter()
            .map(|rate| rate.abs().upper().to_f64());
        measured.set(format!("{name}_rate"), rates.fold(0.0, f64::max));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_is_the_limit_of_difference_quotients() {
        let (linkage, row0) = data::start(BITS).unwrap();
        let from = ExactAngle::Degrees(data::decimal(data::START_DEG)).to_ball(BITS);
        let to = &from + &Ball::integer(BITS, 1).shift(-60);
        let next = linkage.follow(&row0, &from, &to).unwrap();
        let across = |q: &Configuration| q.a.cross(&q.b);
        let quotient = (across(&next) - across(&row0)).shift(60);
        let due = slope(&linkage.kinematics(&row0).unwrap());
        let off = (&quotient - &due).abs().upper();
        assert!(off < 1e-10 * due.abs().lower(), "{off:e} {due:?}");
    }

    /// Without a dead position in the bracket there is no proof, and with one there is.
    #[test]
    fn dead_positions_are_proved() {
        let (linkage, row0) = data::start(BITS).unwrap();
        let found = |low, high| dead(&linkage, &row0, (low, high)).is_some();
        assert!(found("14.42", "14.43") && found("196.01", "196.02"));
        assert!(!found("14.43", "14.44") && !found("14.40", "14.42"));
    }
}
