//! W(z) near its zeros in the lower half-plane.
//!
//! At a zero `w' = 2i/√π` exactly, so that with `δ = z − z_k`
//!
//! ```text
//! w(z_k + δ) = (2i/√π) (δ + δ²(g₀ + g₁δ + …))
//! ```
//!
//! and the zeros are stored as three `f64`, from which δ keeps 100 bits however small it is.

use super::double_double::{Dd, two_sum};
use super::lanes::Lanes;
use super::tables::ZEROS;
use super::taylor::{polynomial, square};

/// `Re z_k` and `Im z_k` in three parts each, then five blocks of four real and four imaginary
/// parts of `g`.
#[repr(align(16))]
pub(super) struct ZeroRow(pub [f64; 46]);

/// Half the side of the squares around the zeros in which the expansions are used.
const REACH: f64 = 0.0625;

/// 2/√π.
const TWO_OVER_SQRT_PI: Dd = Dd::new(1.128_379_167_095_512_6, 1.533_545_961_316_588e-17);

/// Beyond this no zero is stored.
const OUTERMOST: f64 = 6.5;

/// The zero next to `a − i b`, if the point lies in its square: `2ab/π` at the k-th zero is
/// `2k − 0.27`, nearly.
#[inline(always)]
pub(super) fn nearest(a: f64, b: f64) -> Option<usize> {
    if !(a < OUTERMOST && b < OUTERMOST && a > 1.0 && b > 1.0) {
        return None;
    }
    let k = (a * b * std::f64::consts::FRAC_1_PI - 0.365) as usize;
    let z = &ZEROS.get(k)?.0;
    ((a - z[0]).abs() <= REACH && (b + z[3]).abs() <= REACH).then_some(k)
}

/// `w(a − i b)` next to zero `k`; `None` if a component cannot be had to a few units in the last
/// place this way.
#[inline(always)]
pub(super) fn near_zero<L: Lanes>(lanes: L, k: usize, a: f64, b: f64) -> Option<(Dd, Dd)> {
    let c = &ZEROS[k].0;
    let difference = |x: f64, at: usize| {
        let s = two_sum(x, -c[at]);
        Dd::new(s.hi, s.lo).add_f(-c[at + 1]).add_f(-c[at + 2])
    };
    let (dx, dy) = (difference(a, 0), difference(-b, 3));
    let (x, y) = (dx.hi, dy.hi);
    let (x2, y2) = square(x, y);
    let (qr, qi) = polynomial(lanes, c, (6, 38), (x, y), (x2, y2));
    let (hr, hi) = (x2.mul_add(qr, -(y2 * qi)), x2.mul_add(qi, y2 * qr));
    let (u, v) = (dx.add_f(hr), dy.add_f(hi));
    // The last part is wrong by three units of its own in the last place at most.
    let size = 1.5 * hr.abs().max(hi.abs());
    if u.hi.abs() < size || v.hi.abs() < size {
        return None;
    }
    Some((-(v * TWO_OVER_SQRT_PI), u * TWO_OVER_SQRT_PI))
}

/// `w(a − i b)` if zero `k` is closer than `distance` in both components: to `distance` units in the
/// last place of `|w|`.
#[inline(always)]
pub(super) fn closer_than<L: Lanes>(
    lanes: L,
    k: usize,
    a: f64,
    b: f64,
    distance: f64,
) -> Option<(Dd, Dd)> {
    let c = &ZEROS[k].0;
    let difference = |x: f64, at: usize| {
        let s = two_sum(x, -c[at]);
        Dd::new(s.hi, s.lo).add_f(-c[at + 1]).add_f(-c[at + 2])
    };
    let (dx, dy) = (difference(a, 0), difference(-b, 3));
    let (x, y) = (dx.hi, dy.hi);
    if !(x.abs() < distance && y.abs() < distance) {
        return None;
    }
    let (x2, y2) = square(x, y);
    let (qr, qi) = polynomial(lanes, c, (6, 38), (x, y), (x2, y2));
    let (hr, hi) = (x2.mul_add(qr, -(y2 * qi)), x2.mul_add(qi, y2 * qr));
    let (u, v) = (dx.add_f(hr), dy.add_f(hi));
    Some((-(v * TWO_OVER_SQRT_PI), u * TWO_OVER_SQRT_PI))
}
