//! W(z) near its zeros in the lower half-plane.
//!
//! At a zero `w' = 2i/√π` exactly, so that with `δ = z − z_k`
//!
//! ```text
//! w(z_k + δ) = (2i/√π) (δ + δ²(g₀ + g₁δ + …))
//! ```
//!
//! and the zeros are stored as three `f64`, from which δ keeps 100 bits however small it is.

use super::constants::TWO_OVER_SQRT_PI;
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use super::taylor::polynomials;
use super::taylor::{polynomial, square};
use crate::double_double::{Dd, fast_two_sum, two_prod, two_sum};
use crate::lanes::{Lanes, Vectors};
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use crate::pack::{Pack, Wide, columns};
use crate::real::{ROUND, Real};
use std::f64::consts::{FRAC_1_PI, TAU};

/// `Re z_k` and `Im z_k` in three parts each, then five blocks of four real and four imaginary
/// parts of `g`.
#[repr(align(16))]
pub(super) struct ZeroRow(pub [f64; 46]);

/// Returns whether the point `a − i b` may lie in the square of a zero. There `p = 2ab` is near
/// `2π(k − 0.1325)`, and `a² − b²` near the straight line through the values at the zeros; squares
/// become squares, turned and `2|z|` times as large, inside circles with `|z|²/32` for the square
/// of the radius.
#[inline(always)]
pub(super) fn candidate<R: Real>(a: R, b: R) -> R::Mask {
    let like = |c: f64| a.like(c);
    let p = (a + a) * b;
    let p0 = p + like(0.1325 * TAU);
    let n = p0.fma(like(0.5 * FRAC_1_PI), like(ROUND)) - like(ROUND);
    let off = n.fma(like(-TAU), p0);
    let e = (a - b).fma(a + b, p.fma(like(-0.0163), like(-2.35)));
    off.fma(off, e * e).below(p.fma(like(0.04), like(0.36)))
}

/// `w(a − i b)` next to the zero of row `c`; `None` if a component is not known to a few units in
/// the last place this way.
#[inline(always)]
pub(super) fn near_zero<L: Lanes>(lanes: L, c: &[f64; 46], a: f64, b: f64) -> Option<(f64, f64)> {
    let (dx, dy) = offset(c, a, -b);
    let (re, im, lost) = at_offset(lanes, c, dx, dy);
    if lost { None } else { Some((re, im)) }
}

/// `a + i y` less the zero.
#[inline(always)]
pub(super) fn offset<R: Real>(c: &[f64; 46], a: R, y: R) -> (Dd<R>, Dd<R>) {
    let at = |k: usize| a.like(c[k]);
    (
        difference(a, at(0), at(1), at(2)),
        difference(y, at(3), at(4), at(5)),
    )
}

/// w at a distance from the zero; `true` where it fails.
#[inline(always)]
pub(super) fn at_offset<L: Vectors>(
    lanes: L,
    c: &[f64; 46],
    dx: Dd<L::Scalar>,
    dy: Dd<L::Scalar>,
) -> (L::Scalar, L::Scalar, <L::Scalar as Real>::Mask) {
    let d2 = square(dx.hi, dy.hi);
    let q = polynomial(lanes, c, (6, 38), (dx.hi, dy.hi), d2);
    assemble((dx, dy), d2, q)
}

/// `x − z`, `z` in three parts, for `|x − z|` below a sixteenth of `|z|`.
#[inline(always)]
fn difference<R: Real>(x: R, z0: R, z1: R, z2: R) -> Dd<R> {
    // The first difference is exact (Sterbenz).
    let d = two_sum(x - z0, -z1);
    fast_two_sum(d.hi, d.lo - z2)
}

/// `(2i/√π)(δ + δ²q)`; `true` where a component of the sum is too small for the rounding error of
/// the last part, three units in its last place at most.
#[inline(always)]
fn assemble<R: Real>(
    (dx, dy): (Dd<R>, Dd<R>),
    (x2, y2): (R, R),
    (qr, qi): (R, R),
) -> (R, R, R::Mask) {
    let (hr, hi) = (x2.fma(qr, -(y2 * qi)), x2.fma(qi, y2 * qr));
    let (u, v) = (two_sum(dx.hi, hr), two_sum(dy.hi, hi));
    let (u, v) = (
        fast_two_sum(u.hi, u.lo + dx.lo),
        fast_two_sum(v.hi, v.lo + dy.lo),
    );
    let (ah, bh) = (hr.magnitude(), hi.magnitude());
    let size = hr.like(1.5) * ah.pick(ah.below(bh), bh, ah);
    let lost = hr.or(u.hi.magnitude().below(size), v.hi.magnitude().below(size));
    (-times_two_over_sqrt_pi(v), times_two_over_sqrt_pi(u), lost)
}

#[inline(always)]
fn times_two_over_sqrt_pi<R: Real>(x: Dd<R>) -> R {
    let (ch, cl) = (
        x.hi.like(TWO_OVER_SQRT_PI.hi),
        x.hi.like(TWO_OVER_SQRT_PI.lo),
    );
    let p = two_prod(x.hi, ch);
    p.hi + x.hi.fma(cl, x.lo.fma(ch, p.lo))
}

/// [`near_zero`] for several points with a zero each: `true` where it fails.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
#[inline(always)]
pub(super) fn near_zeros<S: Wide>(
    simd: S,
    rows: &[&[f64; 46]; 8],
    a: Pack<S>,
    y: Pack<S>,
) -> (Pack<S>, Pack<S>, S::m64s) {
    let (z, t) = (columns(simd, rows, 0), columns(simd, rows, 4));
    let (dx, dy) = (
        difference(a, z[0], z[1], z[2]),
        difference(y, z[3], t[0], t[1]),
    );
    let d2 = square(dx.hi, dy.hi);
    let q = polynomials::<S, 46>(simd, rows, (6, 38), (dx.hi, dy.hi), d2);
    assemble((dx, dy), d2, q)
}

#[cfg(test)]
mod tests;
