//! Identities of every position of a four-bar linkage.

use super::input::{FourBarInput, motion, values};
use crate::audit::Law;
use crate::methods::common::{central_difference, held};
use crate::methods::inputs::Fields;
use std::f64::consts::TAU;

pub(super) fn all() -> Vec<Law> {
    vec![
        Law {
            name: "closure",
            statement: "a e1 + b e2 - c e3 = (d, 0) within 16 u of the perimeter and of the angles' size",
            residual: closure,
        },
        Law {
            name: "scale",
            statement: "lengths times 2^7 leave every angle and derivative bit for bit unchanged",
            residual: scale_law,
        },
        Law {
            name: "mirror",
            statement: "-phi1 in the other assembly negates angles and derivatives bit for bit",
            residual: mirror,
        },
        Law {
            name: "angle-sum",
            statement: "|phi3 - phi2| is the transmission angle within 8 u of the angles' size",
            residual: angle_sum,
        },
        Law {
            name: "velocity",
            statement: "phi3' is the central difference of phi3 within 1e-6 of its size, away from \
                        singular positions and for lengths within a factor 1000",
            residual: velocity,
        },
    ]
}

const U: f64 = f64::EPSILON / 2.0;

fn closure(x: &[f64]) -> Option<f64> {
    let i = FourBarInput::unpack(x)?;
    let m = motion(i).ok()?;
    let FourBarInput {
        a, b, c, d, phi1, ..
    } = i;
    let (p2, p3) = (m.coupler.angle.rad(), m.rocker.angle.rad());
    let (s1, c1) = phi1.sin_cos();
    let (s2, c2) = p2.sin_cos();
    let (s3, c3) = p3.sin_cos();
    let along = a * c1 + b * c2 - c * c3 - d;
    let across = a * s1 + b * s2 - c * s3;
    // The residual of the rounded angles alone is u |φ| times the length.
    let size = (a + b + c + d) * (1.0 + p2.abs().max(p3.abs()));
    // Next to a singular position the angles move by √u without opening the loop that far, but
    // their errors need not cancel: there the law is not applied.
    (m.transmission.rad().sin() > 0.1).then(|| along.hypot(across) / (16.0 * U * size * spread(i)))
}

/// The sum of the lengths over the span of the dyad.
fn spread(i: FourBarInput) -> f64 {
    let FourBarInput {
        a, b, c, d, phi1, ..
    } = i;
    (a + b + c + d) / (d - a * phi1.cos()).hypot(a * phi1.sin())
}

fn scale_law(x: &[f64]) -> Option<f64> {
    let i = FourBarInput::unpack(x)?;
    let here = values(&motion(i).ok()?);
    let [a, b, c, d] = [i.a, i.b, i.c, i.d].map(|l| l * 128.0);
    let there = values(&motion(FourBarInput { a, b, c, d, ..i }).ok()?);
    held(same_turns(&here, &there))
}

/// Angles and derivatives, before the joint's coordinates.
fn same_turns(here: &[f64], there: &[f64]) -> bool {
    here[..7] == there[..7]
}

fn mirror(x: &[f64]) -> Option<f64> {
    let i = FourBarInput::unpack(x)?;
    let here = values(&motion(i).ok()?);
    let (phi1, assembly) = (-i.phi1, -i.assembly);
    let there = values(
        &motion(FourBarInput {
            phi1,
            assembly,
            ..i
        })
        .ok()?,
    );
    held(mirrored(&here, &there))
}

/// φ2, φ3, their second derivatives and the joint's ordinate are odd in φ1; first derivatives,
/// transmission angle and abscissa are even.
fn mirrored(here: &[f64], there: &[f64]) -> bool {
    let signs = [-1.0, -1.0, 1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0];
    let turned = there.iter().zip(signs).map(|(x, sign)| sign * x);
    here.iter().copied().eq(turned)
}

fn angle_sum(x: &[f64]) -> Option<f64> {
    let i = FourBarInput::unpack(x)?;
    let m = motion(i).ok()?;
    let (p2, p3) = (m.coupler.angle.rad(), m.rocker.angle.rad());
    let sine = m.transmission.rad().sin();
    let left = ((p3 - p2).abs() - m.transmission.rad()).abs();
    let size = p2.abs() + p3.abs() + TAU;
    (sine > 0.1).then(|| left / (8.0 * U * size * spread(i)))
}

fn velocity(x: &[f64]) -> Option<f64> {
    const H: f64 = 1e-4;
    let i = FourBarInput::unpack(x)?;
    let m = motion(i).ok()?;
    let angle = |phi1: f64| {
        let mut moved = i;
        moved.phi1 = phi1;
        motion(moved).ok().map(|m| m.rocker.angle.rad())
    };
    let rate = central_difference(angle, i.phi1, H)?;
    let size = 1.0 + m.rocker.first.abs() + m.rocker.second.abs();
    // Where one step changes the second derivative by little, the third is of the size allowed.
    let lengths = [i.a, i.b, i.c, i.d];
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let alike = lengths.iter().all(|&l| l < 1e3 * shortest);
    let calm = alike && m.transmission.rad().sin() > 0.3 && spread(i) < 10.0 && size < 10.0;
    calm.then(|| (rate - m.rocker.first).abs() / (1e2 * H * H * size))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    /// Each value by itself is looked at.
    #[test]
    fn one_value_that_is_not_mirrored_breaks_the_law() {
        let here = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        let there = [-1.0, -2.0, 3.0, 4.0, -5.0, -6.0, 7.0, 8.0, -9.0];
        assert!(mirrored(&here, &there));
        for k in 0..9 {
            let mut off = there;
            off[k] = -off[k];
            assert!(!mirrored(&here, &off), "{k}");
        }
    }

    #[test]
    fn one_angle_or_derivative_that_differs_breaks_the_law_of_scale() {
        let here = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        for k in 0..9 {
            let mut there = here;
            there[k] *= 128.0;
            assert_eq!(same_turns(&here, &there), k >= 7, "{k}");
        }
    }

    /// Links of 1 on a span of 2 cos(μ/2): a crank of 0.1, upright.
    fn nearly_stretched(sine: f64) -> [f64; 6] {
        let span = 2.0 * (sine.asin() / 2.0).cos();
        [0.1, 1.0, 1.0, (span * span - 0.01).sqrt(), FRAC_PI_2, 1.0]
    }

    #[test]
    fn laws_apply_away_from_singular_positions() {
        for (name, least) in [("closure", 0.1), ("angle-sum", 0.1), ("velocity", 0.3)] {
            let laws = all();
            let law = laws.iter().find(|l| l.name == name).unwrap().residual;
            let above = law(&nearly_stretched(least + 0.01));
            assert!(above.is_some_and(|r| r <= 1.0), "{name}: {above:?}");
            assert_eq!(law(&nearly_stretched(least - 0.01)), None, "{name}");
        }
    }

    #[test]
    fn rates_are_compared_where_they_are_calm() {
        for (input, applies) in [
            // The shortest link is 1/900 and 1/1100 of the others.
            ([1.0 / 900.0, 1.0, 1.0, 1.0, 1.0, 1.0], true),
            ([1.0 / 1100.0, 1.0, 1.0, 1.0, 1.0, 1.0], false),
            ([1.0, 1000.0, 1000.0, 1000.0, 1.0, 1.0], false),
            // The lengths are 9.7 and 10.03 times the span of the dyad.
            ([1.0, 0.26, 0.26, 1.0, 0.26, 1.0], true),
            ([1.0, 0.25, 0.25, 1.0, 0.25, 1.0], false),
            // 1 + |φ3'| + |φ3''| = 1 + 2.99 + 4.82 and 1 + 3.12 + 6.31.
            ([1.392, 0.759, 0.438, 1.621, 0.62, 1.0], true),
            ([1.392, 0.759, 0.438, 1.621, 0.644, 1.0], false),
        ] {
            let law = velocity(&input);
            assert_eq!(law.is_some(), applies, "{input:?}");
            assert!(law.is_none_or(|r| r <= 1.0), "{input:?} {law:?}");
        }
    }
}
