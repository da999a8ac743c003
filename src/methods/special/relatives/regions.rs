//! Where the relatives of the Faddeeva function are audited.
//!
//! Their values turn into each other by quarter turns of the plane, so every region lies around
//! both axes.

use super::relative::Relative;
use crate::audit::{CheckPoint, Draw, Region};
use crate::methods::common::region;
use crate::methods::special::complex::C;
use crate::methods::special::faddeeva::curves::{
    Along, BITS_OF_ZEROS, Beside, FEW_BITS, Line, Part, w_roughly, zero as zero_of_w,
};
use crate::methods::special::faddeeva::regions::{
    TINY_PART, along_axis, any_exponents, beside, both_signs, diagonals, huge, in_either_order,
    listed, named_points, nearer, polar, small, tiny_part, whole,
};
use crate::reference::faddeeva::zero_of_erf as certified;
use crate::solvers::faddeeva::{SEAMS, SEAMS_OF_RELATIVES, Seams};
use rug::Rational;
use std::f64::consts::PI;
use std::sync::{LazyLock, OnceLock};

/// The last zero used.
const ZEROS: usize = 60;

/// The seams of W, on which erfcx rests, and of the other relatives.
static ON_CIRCLES: LazyLock<String> = LazyLock::new(|| {
    let (w, others) = (listed(SEAMS.circles), listed(SEAMS_OF_RELATIVES.circles));
    format!("|z|^2 = {others} or, for erfcx, {w}, exactly or off by 1e-17..1e-3")
});
static ON_LINES: LazyLock<String> = LazyLock::new(|| {
    let (w, others) = (listed(SEAMS.im), listed(SEAMS_OF_RELATIVES.re));
    format!("|Re z| or |Im z| = {others} or, for erfcx, {w}, exactly or off by 1e-17..1e-3")
});

/// The `f64` next to the k-th zero of erf in the first quadrant.
pub(super) fn zero_of_erf(k: usize) -> [f64; 2] {
    static ALL: [OnceLock<[f64; 2]>; ZEROS] = [const { OnceLock::new() }; ZEROS];
    *ALL[(k - 1) % ZEROS].get_or_init(|| match certified(k as u32, BITS_OF_ZEROS) {
        Ok(z) => [z.re.to_f64(), z.im.to_f64()],
        // An argument that the audit shows as not finite.
        Err(_) => [f64::NAN; 2],
    })
}

/// `−iζ` for the k-th zero ζ of erf, mirrored into the first quadrant: a zero of erfi and of
/// Dawson's function.
pub(super) fn zero_of_erfi(k: usize) -> [f64; 2] {
    let [x, y] = zero_of_erf(k);
    [y, x]
}

/// The `f64` next to the k-th zero of erfc in the third quadrant: `w(iz) = 0`.
pub(super) fn zero_of_erfc(k: usize) -> [f64; 2] {
    let [x, y] = zero_of_w(k);
    [y, -x]
}

/// The certified value and the derivative, roughly.
fn value_and_slope<F: Relative>(z: C) -> Option<[C; 2]> {
    let (re, im) = (Rational::from_f64(z.re)?, Rational::from_f64(z.im)?);
    let [re, im] = (F::EXACT)(&re, &im, FEW_BITS)
        .ok()?
        .map(|part| part.to_ball().to_f64());
    let value = C::new(re, im);
    Some([value, F::slope(z, value)])
}

/// A point next to a curve on which the component is zero, if a line parallel to an axis meets one
/// near its beginning; the beginning otherwise.
fn beside_curve<F: Relative>(d: &mut Draw, part: Part) -> Vec<f64> {
    let along = if d.chance(0.5) { Along::Re } else { Along::Im };
    let (x, y) = (d.uniform(0.0, 7.0), d.uniform(0.0, 7.0));
    let (x, y) = (d.signed(x), d.signed(y));
    let v = match along {
        Along::Re => y,
        Along::Im => x,
    };
    let line = Line {
        part,
        along,
        z: C::new(x, y),
        // The phase of e^{-z^2} turns by a quarter within one step.
        most: PI / (4.0 * v.abs().max(1.0)),
    };
    let rough = |z| {
        let value = F::from_w(w_roughly, z);
        Some([value, F::slope(z, value)])
    };
    let beside = Beside::draw(d, 1e-2);
    match (line.beside(beside, rough, value_and_slope::<F>), along) {
        (None, _) => vec![x, y],
        (Some(t), Along::Re) => vec![t, y],
        (Some(t), Along::Im) => vec![x, t],
    }
}

/// A zero between two of them, moved by `least` to 0.1, in any of its mirror images.
fn near<F: Relative>(d: &mut Draw, (first, last): (usize, usize), least: f64) -> Vec<f64> {
    let z = (F::ZEROS.at)(d.integer(first, last));
    let off = polar(d.log_uniform(least, 0.1), whole(d));
    let one = |j: usize| {
        let x = z[j] + off[j];
        if F::ZEROS.mirrored[j] { d.signed(x) } else { x }
    };
    [0, 1].map(one).to_vec()
}

/// Small in one coordinate, anything in the other, in either order.
fn beside_axis(imaginary: bool, small: f64, d: &mut Draw) -> Vec<f64> {
    let z = both_signs(along_axis(d), small, d);
    if imaginary { vec![z[1], z[0]] } else { z }
}

/// Those of W one time in three.
fn seams_of_either(d: &mut Draw) -> Seams {
    match d.chance(0.33) {
        true => SEAMS,
        false => SEAMS_OF_RELATIVES,
    }
}

/// The regions.
pub(super) fn all<F: Relative>() -> Vec<Region> {
    let mut regions = vec![
        small(),
        region("disc", "|z| < 1.5", |d| {
            polar(d.uniform(0.0, 1.5), whole(d))
        }),
        region("mid", "|Re z|, |Im z| < 8", |d| {
            vec![d.uniform(-8.0, 8.0), d.uniform(-8.0, 8.0)]
        }),
        region("wide", "|Re z|, |Im z| < 28", |d| {
            vec![d.uniform(-28.0, 28.0), d.uniform(-28.0, 28.0)]
        }),
        region("far", "|z| = 7..1e8, every direction", |d| {
            polar(d.log_uniform(7.0, 1e8), whole(d))
        }),
        huge(),
        region(
            "beside-real-axis",
            "|Re z| = 0..30 or 1e-3..1e5, |Im z| = 1e-300..0.3",
            |d| beside_axis(false, d.log_uniform(1e-300, 0.3), d),
        ),
        region(
            "beside-imaginary-axis",
            "|Im z| = 0..30 or 1e-3..1e5, |Re z| = 1e-300..0.3",
            |d| beside_axis(true, d.log_uniform(1e-300, 0.3), d),
        ),
        region("near-real-axis", "likewise with |Im z| = 1e-20..0.3", |d| {
            beside_axis(false, d.log_uniform(1e-20, 0.3), d)
        }),
        region(
            "near-imaginary-axis",
            "likewise with |Re z| = 1e-20..0.3",
            |d| beside_axis(true, d.log_uniform(1e-20, 0.3), d),
        ),
        region("real-axis", "Im z = 0, |Re z| = 0..30 or 1e-3..1e5", |d| {
            beside_axis(false, 0.0, d)
        }),
        region(
            "imaginary-axis",
            "Re z = 0, |Im z| = 0..30 or 1e-3..1e5",
            |d| beside_axis(true, 0.0, d),
        ),
        diagonals(),
        region(
            "edges-of-the-range",
            "|Re z^2| = 690..760, where the exponential overflows or underflows, \
             the smaller coordinate 1e-300..1e7",
            |d| {
                let a = nearer(d);
                let b = a.mul_add(a, d.uniform(690.0, 760.0)).sqrt();
                in_either_order(a, b, d)
            },
        ),
        region(
            "edge-of-the-small-component",
            "a coordinate 5e-324..1e-290, and |Re z^2| = 680..1480, where its product with the \
             exponential overflows or underflows",
            |d| {
                let a = d.log_uniform(5e-324, 1e-290);
                in_either_order(a, d.uniform(680.0, 1480.0).sqrt(), d)
            },
        ),
        region(
            "subnormal",
            "a coordinate 5e-324..1e-290, the other likewise or 1e-3..30 or beyond 1e290",
            |d| {
                let a = d.log_uniform(5e-324, 1e-290);
                let b = match d.integer(0, 2) {
                    0 => d.log_uniform(5e-324, 1e-290),
                    1 => d.log_uniform(1e-3, 30.0),
                    _ => d.log_uniform(1e290, 1.7e308),
                };
                in_either_order(a, b, d)
            },
        ),
        region("tiny-part", TINY_PART, |d| {
            let (tiny, other) = tiny_part(d);
            in_either_order(tiny, other, d)
        }),
        region(
            "phase",
            "|Re z|, |Im z| = 1e2..1e15 with |Re z^2| < 700",
            |d| {
                let a = d.log_uniform(1e2, 1e15);
                let b = a + d.uniform(-700.0, 700.0) / (2.0 * a);
                both_signs(a, b, d)
            },
        ),
        region("seam-circles", &ON_CIRCLES, |d| {
            let seams = seams_of_either(d);
            let z = polar(beside(d.one_of(seams.circles).sqrt(), d), whole(d));
            both_signs(z[0], z[1], d)
        }),
        region("seam-lines", &ON_LINES, |d| {
            let seams = seams_of_either(d);
            let t = beside(d.one_of(seams.im), d);
            let other = d.uniform_or_log(0.5, [0.0, 10.0], [1e-6, 40.0]);
            in_either_order(t, other, d)
        }),
        region(
            "zero-curves-of-re",
            "the f64 next to a curve with Re f = 0 and its neighbours, or off by a relative 1e-15..1e-2",
            |d| beside_curve::<F>(d, Part::Re),
        ),
        region(
            "zero-curves-of-im",
            "the f64 next to a curve with Im f = 0 and its neighbours, likewise",
            |d| beside_curve::<F>(d, Part::Im),
        ),
        region(
            "far-zeros",
            "within 1e-17..0.1 of a zero beyond those the solver stores, up to the 60th",
            |d| near::<F>(d, (F::ZEROS.stored + 1, ZEROS), 1e-17),
        ),
        region(
            "any-exponent",
            "both coordinates 1e-308..1e308",
            any_exponents,
        ),
        region("any-bits", "any pair of bit patterns", |d| {
            vec![d.any_bits(), d.any_bits()]
        }),
        region(
            "one-any-bits",
            "any bit pattern in one coordinate, the other within 8",
            |d| {
                let (x, y) = (d.any_bits(), d.uniform(-8.0, 8.0));
                match d.chance(0.5) {
                    true => vec![x, y],
                    false => vec![y, x],
                }
            },
        ),
    ];
    if F::ZEROS.stored > 0 {
        regions.push(region(
            "near-zeros",
            "within 1e-17..0.1 of a zero that the solver stores",
            |d| near::<F>(d, (1, F::ZEROS.stored), 1e-17),
        ));
    }
    regions.extend(F::regions());
    regions
}

/// Special arguments, and the first zeros.
pub(super) fn check_points<F: Relative>() -> Vec<CheckPoint> {
    let (inf, nan, max, min) = (f64::INFINITY, f64::NAN, f64::MAX, f64::from_bits(1));
    let normal = f64::MIN_POSITIVE;
    let named = [
        ("zero", 0.0, 0.0),
        ("zero-minus-re", -0.0, 0.0),
        ("zero-minus-im", 0.0, -0.0),
        ("one", 1.0, 0.0),
        ("minus-one", -1.0, 0.0),
        ("i", 0.0, 1.0),
        ("minus-i", 0.0, -1.0),
        ("one-plus-i", 1.0, 1.0),
        ("one-minus-i", 1.0, -1.0),
        ("smallest-re", min, 0.0),
        ("smallest-im", 0.0, min),
        ("smallest-both", -min, -min),
        ("smallest-normal-both", normal, normal),
        ("one-smallest-im", 1.0, min),
        ("smallest-re-one", min, 1.0),
        ("minus-one-smallest-im", -1.0, min),
        ("smallest-re-minus-one", min, -1.0),
        ("largest-re", max, 0.0),
        ("largest-im", 0.0, max),
        ("largest-minus-re", -max, 0.0),
        ("largest-minus-im", 0.0, -max),
        ("largest-both", max, max),
        ("largest-down-the-diagonal", max, -max),
        ("largest-minus-both", -max, -max),
        ("largest-re-smallest-im", max, min),
        ("smallest-re-largest-im", min, max),
        ("smallest-re-largest-minus-im", min, -max),
        ("underflow-on-the-real-axis", 27.3, 0.0),
        ("overflow-on-the-imaginary-axis", 0.0, 26.65),
        ("overflow-down-the-imaginary-axis", 0.0, -26.65),
        ("overflow-on-the-left", -26.65, 0.0),
        ("infinite-re", inf, 0.0),
        ("infinite-re-above", inf, 1.0),
        ("minus-infinite-re", -inf, 0.0),
        ("minus-infinite-re-below", -inf, -1.0),
        ("infinite-im", 0.0, inf),
        ("infinite-im-off-the-axis", 1.0, inf),
        ("minus-infinite-im", -0.0, -inf),
        ("minus-infinite-im-off-the-axis", 1.0, -inf),
        ("infinite-both", inf, inf),
        ("minus-infinite-both", -inf, -inf),
        ("nan-re", nan, 1.0),
        ("nan-im", 1.0, nan),
        ("nan-both", nan, nan),
        ("nan-on-the-real-axis", nan, 0.0),
        ("nan-on-the-imaginary-axis", 0.0, nan),
        ("infinite-re-nan-im", inf, nan),
        ("nan-re-infinite-im", nan, inf),
    ];
    named_points(&named, F::ZEROS.at, F::ZEROS.stored)
}
