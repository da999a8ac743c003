//! Where the Faddeeva function is audited.

use super::curves;
use crate::audit::{CheckPoint, Draw, Region};
use crate::methods::common::{point, region};
use crate::solvers::faddeeva::SEAMS;
use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

/// `r e^{iθ}`.
pub(in crate::methods::special) fn polar(r: f64, theta: f64) -> Vec<f64> {
    let (sin, cos) = libm::sincos(theta);
    vec![r * cos, r * sin]
}

pub(in crate::methods::special) fn whole(d: &mut Draw) -> f64 {
    d.uniform(-PI, PI)
}

/// `x` moved by a relative 1e-17 to 1e-3, to either side, or by nothing.
pub(in crate::methods::special) fn beside(x: f64, d: &mut Draw) -> f64 {
    match d.chance(0.05) {
        true => x,
        false => x + x * d.log_signed(1e-17, 1e-3),
    }
}

pub(in crate::methods::special) fn both_signs(x: f64, y: f64, d: &mut Draw) -> Vec<f64> {
    vec![d.signed(x), d.signed(y)]
}

/// [`both_signs`], with the two exchanged in half of the cases.
pub(in crate::methods::special) fn in_either_order(x: f64, y: f64, d: &mut Draw) -> Vec<f64> {
    match d.chance(0.5) {
        true => both_signs(x, y, d),
        false => both_signs(y, x, d),
    }
}

/// Regions of W and of its relatives alike.
pub(in crate::methods::special) fn small() -> Region {
    region("small", "|z| = 1e-300..1, every direction", |d| {
        polar(d.log_uniform(1e-300, 1.0), whole(d))
    })
}

pub(in crate::methods::special) fn huge() -> Region {
    region("huge", "|z| = 1e8..1.7e308, every direction", |d| {
        polar(d.log_uniform(1e8, 1.7e308), whole(d))
    })
}

pub(in crate::methods::special) fn diagonals() -> Region {
    region(
        "diagonal-rays",
        "|z| = 0.01..1e8 on the four diagonals, exactly or off by 1e-17..1e-3",
        |d| {
            let x = d.log_uniform(0.007, 7e7);
            both_signs(x, beside(x, d), d)
        },
    )
}

/// Two numbers of any exponents.
pub(in crate::methods::special) fn any_exponents(d: &mut Draw) -> Vec<f64> {
    let (x, y) = (d.log_uniform(1e-308, 1e308), d.log_uniform(1e-308, 1e308));
    both_signs(x, y, d)
}

/// The coordinate nearer to an axis where the exponential leaves its range.
pub(in crate::methods::special) fn nearer(d: &mut Draw) -> f64 {
    match d.chance(0.7) {
        true => d.log_uniform(1e-3, 1e7),
        false => d.log_uniform(1e-300, 1e-3),
    }
}

/// Along an axis, near to the origin and far.
pub(in crate::methods::special) fn along_axis(d: &mut Draw) -> f64 {
    d.uniform_or_log(0.7, [0.0, 30.0], [1e-3, 1e5])
}

/// Named arguments, and the first `zeros` zeros.
pub(in crate::methods::special) fn named_points(
    named: &[(&'static str, f64, f64)],
    zero: fn(usize) -> [f64; 2],
    zeros: usize,
) -> Vec<CheckPoint> {
    let first = ["zero-1", "zero-2", "zero-3", "zero-4", "zero-5"];
    let first = first.into_iter().take(zeros).enumerate();
    let named = named.iter().map(|&(name, x, y)| point(name, [x, y]));
    named
        .chain(first.map(|(k, name)| point(name, zero(k + 1))))
        .collect()
}

/// A part so small that every product with it may be subnormal, and the other from where
/// exponentials leave the range of `f64`.
pub(in crate::methods::special) fn tiny_part(d: &mut Draw) -> (f64, f64) {
    let tiny = d.log_uniform(5e-324, 1e-250);
    let other = match d.chance(0.7) {
        true => d.log_uniform(25.0, 100.0),
        false => d.log_uniform(25.0, 1.7e308),
    };
    (tiny, other)
}

/// States what [`tiny_part`] draws.
pub(in crate::methods::special) const TINY_PART: &str =
    "one part 5e-324..1e-250, the other 25..1.7e308, where exponentials overflow or underflow";

/// Seams as text: powers of two as such where decimals would be long.
pub(in crate::methods::special) fn listed(seams: &[f64]) -> String {
    let one = |&t: &f64| {
        let exponent = (t.to_bits() >> 52) as i64 - 1023;
        match t.to_bits() << 12 == 0 {
            true if exponent.abs() > 9 => format!("2^{exponent}"),
            _ if (1e-3..1e7).contains(&t) => format!("{}", (t * 1e12).round() / 1e12),
            _ => format!("{t:e}"),
        }
    };
    seams.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// The largest radius of the circles that [`seam`] draws.
const FARTHEST_CIRCLE: f64 = 2000.0;

/// The radii that [`seam`] draws.
fn radii() -> impl Iterator<Item = f64> {
    let radii = SEAMS.circles.iter().map(|c| c.sqrt());
    radii.filter(|r| *r < FARTHEST_CIRCLE)
}

/// Draws a coordinate at which the function changes its formula: one of these lines, limits of its
/// own included, the radius of a circle, or the side of a cell.
pub(in crate::methods::special) fn seam(lines: &[f64], d: &mut Draw) -> f64 {
    match d.integer(0, 3) {
        0 => d.one_of(&radii().collect::<Vec<f64>>()),
        1 => d.one_of(SEAMS.pitches) / 2.0 * d.one_of(&[1.0, 3.0]),
        _ => d.one_of(lines),
    }
}

/// The coordinates that [`seam`] draws, as text.
pub(in crate::methods::special) fn listed_seams(lines: &[f64]) -> String {
    let radii: Vec<f64> = radii().collect();
    let sides: Vec<f64> = SEAMS.pitches.iter().map(|p| p / 2.0).collect();
    format!(
        "{}, a radius {}, or once or three times {}",
        listed(lines),
        listed(&radii),
        listed(&sides)
    )
}

/// Every coordinate that [`seam`] draws.
#[cfg(test)]
pub(in crate::methods::special) fn seams(lines: &[f64]) -> Vec<f64> {
    let sides = SEAMS.pitches.iter().flat_map(|p| [p / 2.0, 1.5 * p]);
    lines.iter().copied().chain(radii()).chain(sides).collect()
}

/// Within 1e-17 to 0.1 of the k-th zero or its mirror image.
fn near_zero(k: usize, d: &mut Draw) -> Vec<f64> {
    let off = polar(d.log_uniform(1e-17, 0.1), whole(d));
    let z = curves::zero(k);
    vec![d.signed(z[0] + off[0]), z[1] + off[1]]
}

static ON_CIRCLES: LazyLock<String> = LazyLock::new(|| {
    format!(
        "|z|^2 = {}, exactly or off by 1e-17..1e-3",
        listed(SEAMS.circles)
    )
});
static ON_LINES: LazyLock<String> = LazyLock::new(|| {
    let (re, im) = (listed(SEAMS.re), listed(SEAMS.im));
    format!("|Im z| = {im} or |Re z| = {re}, likewise")
});
static ON_HYPERBOLAS: LazyLock<String> = LazyLock::new(|| {
    let all = listed(SEAMS.hyperbolas);
    format!("Re z^2 = +-{all} below the real axis, |Re z| = 0.01..40, likewise")
});
static ON_CELLS: LazyLock<String> = LazyLock::new(|| {
    let edges: Vec<f64> = SEAMS.pitches.iter().map(|pitch| pitch / 2.0).collect();
    format!(
        "one coordinate an odd multiple of {}, likewise",
        listed(&edges)
    )
});

/// The regions.
pub(in crate::methods::special) fn all() -> Vec<Region> {
    vec![
        small(),
        region("mid", "0 <= Im z < 8, |Re z| < 8", |d| {
            vec![d.uniform(-8.0, 8.0), d.uniform(0.0, 8.0)]
        }),
        region("far", "|z| = 7..1e8, Im z >= 0", |d| {
            polar(d.log_uniform(7.0, 1e8), d.uniform(0.0, PI))
        }),
        huge(),
        region("lower", "-6 <= Im z < 0, |Re z| < 8", |d| {
            vec![d.uniform(-8.0, 8.0), d.uniform(-6.0, 0.0)]
        }),
        region("lower-wide", "-28 <= Im z < 0, |Re z| < 40", |d| {
            vec![d.uniform(-40.0, 40.0), d.uniform(-28.0, 0.0)]
        }),
        diagonals(),
        region(
            "chirp-rays",
            "z = (1 - i)(X + i n), |X| = 0.01..1e8, n = 0, +-1, ... +-20 or |n| = 1e-3..1e3",
            |d| {
                let x = d.log_signed(0.01, 1e8);
                let n = match d.chance(0.5) {
                    true => d.integer(0, 20) as f64,
                    false => d.log_uniform(1e-3, 1e3),
                };
                let n = d.signed(n);
                vec![x + n, n - x]
            },
        ),
        region(
            "beside-real-axis",
            "|Re z| = 1e-3..1e5 or 0..30, |Im z| = 1e-300..0.2 on both sides",
            |d| {
                let x = along_axis(d);
                both_signs(x, d.log_uniform(1e-300, 0.2), d)
            },
        ),
        region(
            "near-real-axis",
            "|Re z| < 30, |Im z| = 1e-20..0.3 on both sides",
            |d| both_signs(d.uniform(0.0, 30.0), d.log_uniform(1e-20, 0.3), d),
        ),
        region(
            "real-axis",
            "Im z = 0, |Re z| = 0..28 or 1e-300..1e300",
            |d| {
                let x = d.uniform_or_log(0.7, [0.0, 28.0], [1e-300, 1e300]);
                both_signs(x, 0.0, d)
            },
        ),
        region(
            "beside-imaginary-axis",
            "|Re z| = 1e-300..0.5, or 0, Im z = -27..30 or |Im z| = 1e-3..1e5",
            |d| {
                let x = d.zero_or_log(0.1, 1e-300, 0.5);
                let y = match d.chance(0.7) {
                    true => d.uniform(-27.0, 30.0),
                    false => d.log_signed(1e-3, 1e5),
                };
                vec![d.signed(x), y]
            },
        ),
        region(
            "near-zeros",
            "within 1e-17..0.1 of one of the first 12 zeros or its mirror image",
            |d| near_zero(d.integer(1, 12), d),
        ),
        region(
            "far-zeros",
            "within 1e-17..0.1 of one of the zeros 13 to 400",
            |d| near_zero(d.log_uniform(13.0, 400.0) as usize, d),
        ),
        region(
            "zero-curves-of-re",
            "the f64 next to a zero curve of Re W below the axis and its neighbours, or off by a relative \
             1e-15..1e-2; Im z = -0.3..-20 or to -1e6",
            |d| curves::beside_curve(d, curves::Part::Re),
        ),
        region(
            "zero-curves-of-im",
            "the f64 next to a zero curve of Im W below the axis and its neighbours, likewise",
            |d| curves::beside_curve(d, curves::Part::Im),
        ),
        region(
            "zero-curve-beside-real-axis",
            "the f64 next to the zero curve of Re W at Re z = 2.3..26.5 and its neighbours in Im z, or off by a \
             relative 1e-15..1e-1",
            curves::beside_flat_curve,
        ),
        region(
            "overflow-edge",
            "Im z < 0 where |W| is 1e303..1e313, |Re z| = 1e-300..1e7",
            |d| {
                let a = nearer(d);
                let b = a.mul_add(a, 709.0 + d.uniform(-12.0, 12.0)).sqrt();
                vec![d.signed(a), -b]
            },
        ),
        region(
            "overflow",
            "Im z < 0 where W overflows or nearly: |Im z| = 1..1e300 times |Re z| = 0..1e300",
            |d| {
                let b = d.log_uniform(1.0, 1e300);
                let a = match d.integer(0, 3) {
                    0 => 0.0,
                    1 => b * d.uniform(0.0, 1.0),
                    2 => beside(b, d),
                    _ => d.log_uniform(1e-300, 1e300),
                };
                vec![d.signed(a), -b]
            },
        ),
        region(
            "underflow-of-re",
            "Re W subnormal: |Re z| = 26.4..27.4 beside the axis, or 1e-3..1e150 with Im z = 1e-323..",
            |d| match d.chance(0.5) {
                true => both_signs(d.uniform(26.4, 27.4), d.log_uniform(1e-323, 1e-290), d),
                false => {
                    let x = d.log_uniform(30.0, 1e150);
                    both_signs(x, d.log_uniform(1e-323, 1e-300) * x, d)
                }
            },
        ),
        region(
            "underflow",
            "|z| = 1e290..1.7e308 beside an axis, and Re z or Im z = 5e-324..1e-290",
            |d| {
                let r = d.log_uniform(1e290, 1.7e308);
                let t = d.log_uniform(5e-324, 1e-290);
                let y = match d.chance(0.3) {
                    true => d.log_uniform(1.0, r),
                    false => t,
                };
                match d.integer(0, 2) {
                    0 => both_signs(r, y, d),
                    1 => vec![d.signed(y), r],
                    _ => both_signs(d.log_uniform(5e-324, 10.0), t, d),
                }
            },
        ),
        region("tiny-part", TINY_PART, |d| {
            let (tiny, other) = tiny_part(d);
            match d.chance(0.7) {
                true => vec![d.signed(tiny), -other],
                false => both_signs(other, tiny, d),
            }
        }),
        region("seam-circles", &ON_CIRCLES, |d| {
            let r = beside(d.one_of(SEAMS.circles).sqrt(), d);
            // A third each: everywhere, beside the real axis, beside the diagonals.
            let theta = match d.integer(0, 2) {
                0 => whole(d),
                1 => d.log_uniform(1e-20, 0.05),
                _ => PI / 4.0 + d.log_signed(1e-17, 1e-2),
            };
            let z = polar(r, theta);
            both_signs(z[0], z[1], d)
        }),
        region("seam-strips", &ON_LINES, |d| {
            let other = d.uniform_or_log(0.5, [0.0, 10.0], [1e-3, 40.0]);
            if d.chance(0.6) {
                let y = d.one_of(SEAMS.im);
                // Next to the real axis the strip alone tells distances apart.
                let other = match y < 1e-3 {
                    true => d.uniform(8.0, 28.0),
                    false => other,
                };
                return both_signs(other, beside(y, d), d);
            }
            both_signs(beside(d.one_of(SEAMS.re), d), other, d)
        }),
        region("seam-hyperbolas", &ON_HYPERBOLAS, |d| {
            let decay = beside(d.one_of(SEAMS.hyperbolas), d);
            let t = d.log_uniform(0.01, 40.0);
            let s = t.mul_add(t, decay).sqrt();
            match d.chance(0.5) {
                true => vec![d.signed(s), -t],
                false => vec![d.signed(t), -s],
            }
        }),
        region("seam-cells", &ON_CELLS, |d| {
            let step = d.one_of(SEAMS.pitches) / 2.0;
            let most = (7.5 / step) as usize / 2;
            let edge = step * (2 * d.integer(0, most) + 1) as f64;
            let edge = beside(edge, d);
            let other = d.uniform_or_log(0.8, [0.0, 7.5], [1e-6, 0.3]);
            in_either_order(edge, other, d)
        }),
        region(
            "any-bits",
            "both components with any exponent: 1e-308..1e308",
            any_exponents,
        ),
        region(
            "phase",
            "|Re z| and |Im z| = 1e2..1e15 within 700 of each other's square, below the axis",
            |d| {
                let a = d.log_uniform(1e2, 1e15);
                let t = d.uniform(-700.0, 700.0) / (2.0 * a);
                let theta = d.uniform(0.0, TAU);
                let b = a + t + theta * 1e-3 / a;
                vec![d.signed(a), -b]
            },
        ),
    ]
}

/// Special arguments.
pub(in crate::methods::special) fn check_points() -> Vec<CheckPoint> {
    let (inf, nan, max, min) = (f64::INFINITY, f64::NAN, f64::MAX, f64::from_bits(1));
    let normal = f64::MIN_POSITIVE;
    let named = [
        ("zero", 0.0, 0.0),
        ("zero-minus-re", -0.0, 0.0),
        ("zero-minus-im", 0.0, -0.0),
        ("zero-minus-both", -0.0, -0.0),
        ("one", 1.0, 0.0),
        ("minus-one", -1.0, 0.0),
        ("i", 0.0, 1.0),
        ("minus-i", 0.0, -1.0),
        ("one-minus-i", 1.0, -1.0),
        ("one-plus-i", 1.0, 1.0),
        ("smallest-re", min, 0.0),
        ("smallest-im", 0.0, min),
        ("smallest-minus-im", 0.0, -min),
        ("smallest-both", -min, -min),
        ("smallest-normal-both", normal, normal),
        ("one-smallest-im", 1.0, min),
        ("six-smallest-minus-im", 6.0, -min),
        ("largest-re", max, 0.0),
        ("largest-im", 0.0, max),
        ("largest-both", max, max),
        ("largest-re-smallest-im", max, min),
        ("largest-minus-im", 0.0, -max),
        ("largest-down-the-diagonal", max, -max),
        ("largest-down-the-other-diagonal", -max, -max),
        ("smallest-re-largest-minus-im", min, -max),
        ("last-on-the-axis", 27.297, 0.0),
        ("gone-on-the-axis", 27.3, 0.0),
        ("overflow-on-the-axis", 0.0, -26.65),
        ("last-down-the-axis", 0.0, -26.628),
        ("infinite-re", inf, 0.0),
        ("minus-infinite-re", -inf, 1.0),
        ("infinite-re-below", inf, -1.0),
        ("infinite-im", 0.0, inf),
        ("infinite-both", inf, inf),
        ("minus-infinite-im", 0.0, -inf),
        ("minus-infinite-im-off-the-axis", 1.0, -inf),
        ("infinite-re-minus-infinite-im", inf, -inf),
        ("nan-re", nan, 1.0),
        ("nan-im", 1.0, nan),
        ("nan-im-on-the-axis", 0.0, nan),
    ];
    named_points(&named, curves::zero, 5)
}

#[cfg(test)]
mod tests;
