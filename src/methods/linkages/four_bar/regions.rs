//! Where the four-bar linkage is audited.

use super::input::{FourBarInput, motion};
use crate::audit::{Domain, Draw};
use crate::methods::common::{point, region};
use crate::solvers::dyad::{CrankRange, FourBar};
use crate::solvers::units::Length;
use std::f64::consts::PI;

pub(super) fn domain() -> Domain {
    Domain {
        regions: vec![
            region(
                "crank-rocker",
                "a in [0.1, 1], b, c, d in [1, 5] with s + l < p + q, phi1 in [-pi, pi]",
                |r| turning(r, crank_rocker).to_vec(),
            ),
            region(
                "double-crank",
                "d in [0.1, 1], a, b, c in [1, 5] with s + l < p + q, phi1 over several turns",
                |r| {
                    let i = turning(r, |r| {
                        let [d, a, b, c] = crank_rocker(r);
                        [a, b, c, d]
                    });
                    let phi1 = r.uniform(-20.0, 20.0);
                    FourBarInput { phi1, ..i }.to_vec()
                },
            ),
            region(
                "near-change-point",
                "s + l < p + q by 1e-9 to 1e-2 of l, phi1 down to 1e-6 from the change point",
                |r| near_change_point(r).to_vec(),
            ),
            region(
                "near-stretched",
                "coupler and rocker within 1e-10 to 1e-2 of stretched or folded",
                |r| near_stretched(r).to_vec(),
            ),
            region(
                "different-lengths",
                "two neighbours 1e-8 to 1 of the other two",
                |r| different_lengths(r).to_vec(),
            ),
            region(
                "swinging-crank",
                "s + l > p + q, phi1 within the crank's range",
                |r| swinging(r).to_vec(),
            ),
            region(
                "unreachable",
                "phi1 outside the crank's range, the span 1e-9 to 1 too long or too short",
                |r| unreachable(r).to_vec(),
            ),
        ],
        check_points: vec![
            point("triangle-3-4-5", [1.0, 3.0, 4.0, 6.0, 0.0, 1.0]),
            point("triangle-3-4-5-mirrored", [1.0, 3.0, 4.0, 6.0, 0.0, -1.0]),
            point("parallelogram", [2.0, 5.0, 2.0, 5.0, 1.0, 1.0]),
            point("antiparallelogram", [2.0, 5.0, 2.0, 5.0, 1.0, -1.0]),
            point("tall-parallelogram", [5.0, 2.0, 5.0, 2.0, 1.0, 1.0]),
            point("isosceles-dyad", [1.0, 3.0, 3.0, 4.0, 2.0, 1.0]),
            point("chebyshev", [2.0, 5.0, 5.0, 4.0, 1.25, 1.0]),
            point("never-closed", [1.0, 2.0, 3.0, 6.0, 0.0, 1.0]),
            point("folded-exactly", [2.0, 7.0, 3.0, 6.0, 0.0, 1.0]),
            point("out-of-reach", [1.0, 2.0, 3.5, 6.0, PI, 1.0]),
            point("too-near", [2.0, 8.0, 3.0, 6.0, 0.0, 1.0]),
            point("crank-along-frame", [1.0, 4.0, 3.5, 4.0, PI, -1.0]),
        ],
    }
}

/// Crank shortest, `s + l < p + q` by at least 1 %.
fn crank_rocker(r: &mut Draw) -> [f64; 4] {
    loop {
        let a = r.uniform(0.1, 1.0);
        let [b, c, d] = [(); 3].map(|()| r.uniform(1.0, 5.0));
        let longest = b.max(c).max(d);
        if a + 2.0 * longest < (b + c + d) * 0.99 {
            return [a, b, c, d];
        }
    }
}

fn with_angle(r: &mut Draw, [a, b, c, d]: [f64; 4], phi1: f64) -> FourBarInput<'static> {
    let assembly = r.signed(1.0);
    FourBarInput {
        a,
        b,
        c,
        d,
        phi1,
        assembly,
    }
}

fn turning(r: &mut Draw, lengths: fn(&mut Draw) -> [f64; 4]) -> FourBarInput<'static> {
    let l = lengths(r);
    let phi = r.uniform(-PI, PI);
    with_angle(r, l, phi)
}

fn near_change_point(r: &mut Draw) -> FourBarInput<'static> {
    let gap = r.log_uniform(1e-9, 1e-2);
    let (s, p) = (r.uniform(0.5, 1.0), r.uniform(1.0, 3.0));
    let q = p * r.uniform(1.0, 1.5);
    // s + l = p + q less a little; q and l next to each other or opposite.
    let l = (p + q - s) * (1.0 - gap);
    let lengths = match r.integer(0, 3) {
        0 => [s, p, q, l],
        1 => [s, l, p, q],
        2 => [p, q, l, s],
        _ => [l, q, p, s],
    };
    // The links lie on one line at φ1 = 0 or π.
    let at = [0.0, PI][r.integer(0, 1)];
    let away = r.log_uniform(1e-6, 1.0);
    let phi = at + r.signed(away);
    let i = with_angle(r, lengths, phi);
    match motion(i).is_ok() {
        true => i,
        // Rounding of the gap may leave the linkage open there: a quarter turn is always closed.
        false => FourBarInput {
            phi1: PI / 2.0,
            ..i
        },
    }
}

/// Lengths so that the dyad spans `(b + c)(1 − gap)` or `|b − c| (1 + gap)`.
fn near_limit(r: &mut Draw, gap: f64) -> FourBarInput<'static> {
    let (a, d) = (r.uniform(0.5, 2.0), r.uniform(2.5, 5.0));
    let phi = r.uniform(-PI, PI);
    let span = (a * a + d * d - 2.0 * a * d * libm::cos(phi)).sqrt();
    let (b, c) = if r.chance(0.5) {
        let sum = span / (1.0 - gap);
        let share = r.uniform(0.2, 0.8);
        (sum * share, sum * (1.0 - share))
    } else {
        let difference = span / (1.0 + gap);
        let short = r.uniform(0.5, 5.0);
        if r.chance(0.5) {
            (short + difference, short)
        } else {
            (short, short + difference)
        }
    };
    with_angle(r, [a, b, c, d], phi)
}

fn near_stretched(r: &mut Draw) -> FourBarInput<'static> {
    let gap = r.log_uniform(1e-10, 1e-2);
    near_limit(r, gap)
}

fn unreachable(r: &mut Draw) -> FourBarInput<'static> {
    let gap = r.log_uniform(1e-9, 0.5);
    loop {
        let i = near_limit(r, -gap);
        let FourBarInput { a, b, c, d, .. } = i;
        // The linkage as such has to close.
        if 2.0 * a.max(b).max(c).max(d) < (a + b + c + d) * (1.0 - 1e-9) {
            return i;
        }
    }
}

fn different_lengths(r: &mut Draw) -> FourBarInput<'static> {
    let small = r.log_uniform(1e-8, 1.0);
    loop {
        let (long, phi) = (r.uniform(1.0, 5.0), r.uniform(-PI, PI));
        // Two neighbours small, the other two long and nearly equal.
        let s = small * r.uniform(0.2, 1.0);
        let t = small * r.uniform(1.0, 2.0);
        let other = long + s * r.uniform(-0.9, 0.9);
        let l = match r.integer(0, 3) {
            0 => [s, t, other, long],
            1 => [s, other, t, long],
            2 => [s, other, long, t],
            _ => [other, t, long, s],
        };
        let i = with_angle(r, l, phi);
        if within(i) {
            return i;
        }
    }
}

/// Closed, and not next to a limit of the crank.
fn within(i: FourBarInput) -> bool {
    motion(i).is_ok_and(|m| m.transmission.rad().sin() > 1e-3)
}

fn swinging(r: &mut Draw) -> FourBarInput<'static> {
    loop {
        let [a, b, c, d] = [(); 4].map(|()| r.uniform(0.5, 3.0));
        let Ok(bar) = FourBar::new(
            Length::from_m(a),
            Length::from_m(b),
            Length::from_m(c),
            Length::from_m(d),
        ) else {
            continue;
        };
        let t = r.uniform(0.001, 0.999);
        let phi = match bar.crank_range() {
            CrankRange::Full => continue,
            CrankRange::Within { limit } => limit.rad() * t,
            CrankRange::Beyond { limit } => limit.rad() + (PI - limit.rad()) * t,
            CrankRange::Between { lower, upper } => lower.rad() + (upper.rad() - lower.rad()) * t,
        };
        let phi = r.signed(phi);
        return with_angle(r, [a, b, c, d], phi);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Crank and ground in line: b, c and 2 are a triangle with the transmission angle μ, its sine
    /// about 2√(b + c − 2).
    #[test]
    fn links_next_to_a_limit_are_not_drawn() {
        let stretched = |sine: f64| FourBarInput {
            a: 1.0,
            b: 1.0,
            c: 1.0 + sine * sine / 4.0,
            d: 1.0,
            phi1: PI,
            assembly: 1.0,
        };
        assert!(within(stretched(1.1e-3)));
        assert!(!within(stretched(0.9e-3)));
    }
}
