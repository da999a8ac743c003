//! W to about 100 bits, quickly: Taylor series in 128-bit fixed point for |Re z|, |Im z|
//! below 9.74, and the asymptotic series beyond.
//!
//! Whoever asks for more bits than come out, or for a component that loses too many, gets the
//! general evaluation: this file only ever answers with proven balls or not at all. [`parts`] also has
//! `D = w − e^{−z²}` in the first quadrant.
//!
//! # Cells
//! The centres are the points of the closed first quadrant with coordinates that are multiples of
//! 1/2; z, moved to the quadrant by the symmetries, belongs to the nearest one, and both
//! coordinates of δ = z − centre are at most 1/4, |δ| ≤ 2^-1.5. From
//! `w(z) = (2/√π) ∫_0^∞ e^{−t² + 2izt} dt`,
//!
//! ```text
//! |w^{(n)}(z)/n!| ≤ (2/√π) 2^n/n! ∫ t^n e^{−t²} dt = 2^n Γ((n+1)/2)/(√π n!) = 1/Γ(n/2 + 1),  Im z ≥ 0
//! ```
//!
//! and the same for `D = w − e^{−z²} = (2i/√π) F` on the real axis, since
//! `(2/√π) F(x) = Im w(x) = (2/√π) ∫ e^{−t²} sin 2xt dt`. With N = 40 terms the tail is below
//! `2 · 2^-60/Γ(21) < 2^-120`. The coefficients come from [`super::taylor`], rounded to units of
//! 2^-122 with an error of at most one unit.
//!
//! * Centre off the axes: complex Horner scheme for w.
//! * On the imaginary axis: `w(z) = erfcx(y − ix)`, whose coefficients are real, by the recurrence of
//!   [`super::fixed`]; Im w comes out as −x times a number.
//! * On the real axis: the same for D, whose real part comes out as −y times a number, and
//!   `w = D + e^{−z²}` with the exponential by MPFR.
//! * At the origin: D as z times a series in z², so that both components keep their relative
//!   accuracy.
//!
//! Below the axis `w(x − iy) = 2e^{−z²} − conj w(x + iy)`.
//!
//! # Rounding, in units of 2^-122
//! A product is wrong by at most 3 units (`mul`), a coordinate of δ by one (truncated), a coefficient
//! by one. Sums and partial sums are below 2 in modulus, S below 3 (from the bound above).
//!
//! * Complex Horner: the modulus of the error obeys `E' ≤ 2^-1.5 E + √2 (6 + 4 + 1)`, so `E ≤ 25`.
//! * Real coefficients, δ = s + iv, |s|, |v| ≤ 1/4, v² wrong by 4:
//!   `E' ≤ E/4 + F/16 + 6 + 2 + 12 + 1`, `F' ≤ E + F/4 + 3 + 3`, so `E ≤ 33`, `F ≤ 52`.
//! * In z²: |p| ≤ 1/16, q² ≤ 1/64, p wrong by 8 and q² by 16: `E' ≤ E/16 + F/64 + 6 + 16 + 48 + 1`,
//!   `F' ≤ E + F/16 + 3 + 24`, so `E ≤ 80`, `F ≤ 115`; the final `P ± 2a²S` adds `F/8 + 2 (3 + 12)`.
//! * Tails: below 4 units in P; in S at most `Σ_{n≥40} n 2^{−1.5(n−1)}/Γ(n/2+1)`, below 240 units.
//!
//! Everything is below 2^9 units.

use super::argument::Real;
use super::asymptotic::{remainder, terms};
use super::derivatives::taylor;
use super::pair::Member;
use crate::{Ball, ComplexBall, Mag};
use rug::{Float, Rational};
use std::sync::OnceLock;

/// Fixed point: units of 2^-SCALE.
const SCALE: u32 = 122;
/// Terms of a Taylor series.
const TERMS: usize = 40;
/// Centres are at 0, 1/2, …, (SIDE − 1)/2.
const SIDE: usize = 20;
/// Bits that can be hoped for.
pub(super) const MOST_BITS: u32 = 104;
/// What is proved about the sums: an error of 2^9 units.
const SUM_ERROR: i64 = 9 - SCALE as i64;
/// Precision of the floats here.
const PREC: u32 = 160;

type Cell = Box<[[i128; 2]]>;
static CELLS: [OnceLock<Option<Cell>>; SIDE * SIDE] = [const { OnceLock::new() }; SIDE * SIDE];

/// `a b 2^-SCALE`, wrong by less than 3 units. Exact parts of the 256-bit product are shifted
/// one by one; each floor loses less than one unit. |a b| must stay below 32 (in units of one).
fn mul(a: i128, b: i128) -> i128 {
    let (a1, a0) = (a >> 64, a & i128::from(u64::MAX));
    let (b1, b0) = (b >> 64, b & i128::from(u64::MAX));
    // a0 b0 < 2^128 as an unsigned number.
    let low = ((a0 as u128 * b0 as u128) >> SCALE) as i128;
    ((a1 * b1) << (128 - SCALE)) + ((a1 * b0) >> (SCALE - 64)) + ((a0 * b1) >> (SCALE - 64)) + low
}

/// x in units, truncated; |x| < 16.
fn fixed(x: f64) -> i128 {
    let bits = x.abs().to_bits();
    let exponent = (bits >> 52) as i32 - 1075;
    if exponent < -1074 {
        return 0;
    }
    let mantissa = i128::from(bits & ((1 << 52) - 1) | 1 << 52);
    let shift = exponent + SCALE as i32;
    let n = match shift {
        0.. => mantissa << shift,
        -126.. => mantissa >> -shift,
        _ => 0,
    };
    if x < 0.0 { -n } else { n }
}

/// The coefficients of a cell: of w for a centre off the axes, else real ones in the first place.
fn cell(i: usize, j: usize) -> Option<&'static Cell> {
    CELLS[i * SIDE + j]
        .get_or_init(|| {
            let half = |k: usize| Rational::from((k as i64, 2));
            let c = taylor(&half(i), &half(j), TERMS - 1, 150).ok()?;
            let units = |b: &Ball| {
                let scaled = b.mid().clone() << SCALE;
                let small = b.rad() <= Mag::power_of_two(-140);
                scaled.to_integer().filter(|_| small)?.to_i128()
            };
            c.iter()
                .enumerate()
                .map(|(n, c)| {
                    Some(match (i, j) {
                        // D = i Σ d_n δ^n with d_n = Im c_n.
                        (_, 0) => [units(&c.im)?, 0],
                        // e_n = i^n c_n, real.
                        (0, _) => match n % 4 {
                            0 => [units(&c.re)?, 0],
                            1 => [-units(&c.im)?, 0],
                            2 => [-units(&c.re)?, 0],
                            _ => [units(&c.im)?, 0],
                        },
                        _ => [units(&c.re)?, units(&c.im)?],
                    })
                })
                .collect()
        })
        .as_ref()
}

/// `Σ c_n (s + iv)^n = P + i v S` for real coefficients; `square` is v².
fn real_series<'a>(
    coefficients: impl DoubleEndedIterator<Item = &'a [i128; 2]>,
    s: i128,
    square: i128,
) -> (i128, i128) {
    let (mut p, mut q) = (0, 0);
    for c in coefficients.rev() {
        (p, q) = (mul(s, p) - mul(square, q) + c[0], p + mul(s, q));
    }
    (p, q)
}

/// The modulus of a coordinate: a float with a relative error below 2^-158, and the nearest double.
struct Coordinate {
    value: Float,
    double: f64,
    exact: bool,
}

impl Coordinate {
    fn new(x: &Real) -> Coordinate {
        if let Real::Double(x) = x {
            return Coordinate {
                value: Float::with_val(PREC, x.abs()),
                double: x.abs(),
                exact: true,
            };
        }
        let value = x.ball(PREC).mid().clone().abs();
        Coordinate {
            double: value.to_f64(),
            value,
            exact: false,
        }
    }

    /// Twice the coordinate of the nearest centre.
    fn centre(&self) -> f64 {
        (2.0 * self.double).round()
    }

    /// The distance from there in units, wrong by one unit at most. For a double the difference is
    /// exact (Sterbenz, or the centre is zero).
    fn offset(&self) -> Option<i128> {
        let centre = self.centre() / 2.0;
        if self.exact {
            return Some(fixed(self.double - centre));
        }
        let s = Float::with_val(PREC, &self.value - centre) << SCALE;
        s.to_integer()?.to_i128()
    }
}

/// A number with an error bound.
struct Part {
    mid: Float,
    error: Mag,
}

impl Part {
    /// `n 2^-SCALE factor`, n wrong by 2^9 units.
    fn sum(n: i128, factor: &Float) -> Part {
        let mid = (Float::with_val(PREC, n) >> SCALE) * factor;
        let error = Mag::above(factor).mul(Mag::power_of_two(SUM_ERROR));
        Part { mid, error }
    }

    /// The same with the factor one.
    fn plain(n: i128) -> Part {
        let mid = Float::with_val(PREC, n) >> SCALE;
        let error = Mag::power_of_two(SUM_ERROR);
        Part { mid, error }
    }

    /// `self + k g`, |k| ≤ 2, where g has a relative error of 2^-140 and the absolute error `slack`.
    fn plus(self, g: &Float, k: i32, slack: Mag) -> Part {
        let term = Float::with_val(PREC, g * k);
        let relative = Mag::above(&term).shift(-140);
        let error = self.error.add(relative).add(slack.shift(1));
        let mid = self.mid + term;
        Part { mid, error }
    }

    fn negated(self) -> Part {
        let mid = -self.mid;
        Part { mid, ..self }
    }

    /// The ball, with the roundings of the few operations on floats (each relative to a result of
    /// 160 bits): 2^-150 of the number and of what it may have been cancelled from.
    fn ball(self, cancelled: Mag) -> Ball {
        let rounding = Mag::above(&self.mid).add(cancelled).shift(-150);
        Ball::new(self.mid, self.error.add(rounding))
    }
}

/// `e^{−(x+iy)²} = c − i s`, each with a relative error below 2^-140 and an absolute one of the third
/// result; nothing where t = y² − x² is beyond 2^15, or a coordinate that is not exact beyond 40.
///
/// Exact coordinates: y − x, y + x and their product are rounded once each, so the error of t is below
/// 2^-158 |t| ≤ 2^-143, and the angle 2xy is exact (106 bits). Others are known to 2^-158: the error of
/// y − x is below 2^-151, that of t below 2^-143. The angle has a relative error below 2^-156, and so sin
/// and cos the absolute error 2xy 2^-156.
fn gaussian(x: &Coordinate, y: &Coordinate) -> Option<(Float, Float, Mag)> {
    let (a, b) = (&x.value, &y.value);
    let exact = x.exact && y.exact;
    let t = Float::with_val(PREC, b - a) * Float::with_val(PREC, b + a);
    if *t.as_abs() > 1u32 << 15 || !exact && x.double.max(y.double) >= 40.0 {
        return None;
    }
    let e = t.exp();
    let angle = Float::with_val(PREC, a * b) << 1u32;
    let slack = if exact {
        Mag::ZERO
    } else {
        Mag::above(&angle).mul(Mag::above(&e)).shift(-155)
    };
    let (s, c) = angle.sin_cos(Float::new(PREC));
    Some((c * &e, s * e, slack))
}

/// What is asked for, at a ± ih.
#[derive(Clone, Copy, PartialEq)]
enum Wanted {
    /// w above the axis.
    Upper,
    /// w below it.
    Lower,
    /// D above it.
    Dawson,
}

/// An enclosure of w(x + iy), or of D with y not negative, x being taken without its sign: of a relative radius
/// of about 2^-bits if no component is much smaller than what it is the difference of.
pub(super) fn parts(x: &Real, y: &Real, member: Member, bits: u32) -> Option<ComplexBall> {
    let (a, h) = (Coordinate::new(x), Coordinate::new(y));
    let wanted = match (member, y.is_negative()) {
        (Member::W, false) => Wanted::Upper,
        (Member::W, true) => Wanted::Lower,
        (Member::Dawson, false) => Wanted::Dawson,
        (Member::Dawson, true) => return None,
    };
    let limit = SIDE as f64 / 2.0 - 0.26;
    match a.double < limit && h.double < limit {
        true => near(&a, &h, wanted),
        false => far(&a, &h, wanted, bits),
    }
}

/// w(x + iy) with components of at least `bits` bits, or nothing.
pub(super) fn w(x: &Real, y: &Real, bits: u32) -> Option<ComplexBall> {
    let w = parts(x, y, Member::W, bits)?;
    let enough = |b: &Ball| b.is_zero() || b.accuracy_bits() >= i64::from(bits);
    if !(enough(&w.re) && enough(&w.im)) {
        return None;
    }
    Some(if x.is_negative() {
        ComplexBall::new(w.re, -w.im)
    } else {
        w
    })
}

/// The cells.
fn near(a: &Coordinate, h: &Coordinate, wanted: Wanted) -> Option<ComplexBall> {
    let (i, j) = (a.centre(), h.centre());
    let cell = cell(i as usize, j as usize)?;
    let (fs, fv) = (a.offset()?, h.offset()?);
    let (re, im) = match (i == 0.0, j == 0.0) {
        (true, true) => {
            // D = i z Σ d_{2k+1} z^{2k}, z² = p + iq: Re D = −h (P + 2a²S), Im D = a (P − 2h²S).
            let (aa, hh) = (mul(fs, fs), mul(fv, fv));
            let odd = cell.iter().skip(1).step_by(2);
            let (p, q) = real_series(odd, aa - hh, 4 * mul(aa, hh));
            let re = Part::sum(-(p + 2 * mul(aa, q)), &h.value);
            (re, Part::sum(p - 2 * mul(hh, q), &a.value))
        }
        (_, true) => {
            let (p, q) = real_series(cell.iter(), fs, mul(fv, fv));
            (Part::sum(-q, &h.value), Part::plain(p))
        }
        (true, _) => {
            // erfcx at h − ia: the real shift is v, the imaginary one −a.
            let (p, q) = real_series(cell.iter(), fv, mul(fs, fs));
            (Part::plain(p), Part::sum(-q, &a.value))
        }
        _ => {
            let (mut p, mut q) = (0, 0);
            for c in cell.iter().rev() {
                (p, q) = (
                    mul(fs, p) - mul(fv, q) + c[0],
                    mul(fs, q) + mul(fv, p) + c[1],
                );
            }
            (Part::plain(p), Part::plain(q))
        }
    };
    // What there is: D in the cells on the real axis, else w.
    let dawson = j == 0.0;
    if (wanted == Wanted::Dawson) == dawson && wanted != Wanted::Lower {
        return Some(ComplexBall::new(re.ball(Mag::ZERO), im.ball(Mag::ZERO)));
    }
    let (c, s, slack) = gaussian(a, h)?;
    let (cm, sm) = (Mag::above(&c).shift(1), Mag::above(&s).shift(1));
    // Above, w = D + E with E = c − is. Below, w = 2E − conj of that, E at a − ih being c + is.
    let (re, im) = match (wanted, dawson) {
        (Wanted::Upper, _) => (re.plus(&c, 1, slack), im.plus(&s, -1, slack)),
        (Wanted::Dawson, _) => (re.plus(&c, -1, slack), im.plus(&s, 1, slack)),
        (Wanted::Lower, true) => (re.negated().plus(&c, 1, slack), im.plus(&s, 1, slack)),
        (Wanted::Lower, false) => (re.negated().plus(&c, 2, slack), im.plus(&s, 2, slack)),
    };
    Some(ComplexBall::new(re.ball(cm), im.ball(sm)))
}

/// The asymptotic series with its plain remainder bound or, for |Im z| ≤ |Re z|, with that of the real
/// part beside the real axis where that is less, on both sides of it ([`super::asymptotic`] has the derivation).
///
/// Fixed point with units of 2^-114 here. With `v = C/z² = p + iq`, |v| ≤ 1, ρ = (2k+1)/(2C) and the
/// sum from term k on equal to P + iqS: `P ← 1 + ρ (pP − q²S)`, `S ← ρ (P + pS)`. The errors E of P and
/// F of S obey `E' = ρ (|p| E + q² F + 6 + 3|P| + 20|S|) + 1`, `F' = ρ (E + |p| F + 3 + 3|S|) + 1` (Ca² and
/// Cb² are wrong by one unit, hence p by 3 and `q² = 4 Ca² Cb²` by 4 (3 + 2)), evaluated in `f64` and enlarged by 1 %.
fn far(x: &Coordinate, y: &Coordinate, wanted: Wanted, bits: u32) -> Option<ComplexBall> {
    const UNIT: u32 = 114;
    let square = |x: &Float| Float::with_val(PREC, x.square_ref());
    let norm = square(&x.value) + square(&y.value);
    let (m, e) = norm.to_f64_exp();
    let log_r = m.log2() + f64::from(e) - 1e-8;
    let n = terms(log_r, bits + 4)?;
    let over = |x: &Float| Float::with_val(PREC, x / &norm);
    let (a, b) = (over(&x.value), over(&y.value));
    let log_c = (log_r.floor() as i64).clamp(0, 40) as u32;
    let units = |f: &Float| -> Option<i128> {
        let square = Float::with_val(PREC, f.square_ref()) << (log_c + UNIT);
        square.to_integer()?.to_i128()
    };
    let (aa, bb) = (units(&a)?, units(&b)?);
    // The product routine counts in 2^-122: 8 bits are missing in a factor.
    let times = |x: i128, y: i128| mul(x, y << (SCALE - UNIT));
    let p = aa - bb;
    let q2 = 4 * times(aa, bb);
    let one = 1i128 << UNIT;
    let size = |x: i128| x as f64 / one as f64;
    let (pm, qm) = (size(p).abs(), size(q2));
    let (mut sum, mut rest) = (one, 0i128);
    let (mut error, mut rest_error) = (0.0f64, 0.0f64);
    for k in (0..n - 1).rev() {
        let factor = 2 * k as i128 + 1;
        let rho = factor as f64 / (log_c as f64 + 1.0).exp2();
        let (ps, rs) = (size(sum).abs(), size(rest).abs());
        if ps.max(rs) > 30.0 {
            return None;
        }
        (error, rest_error) = (
            rho * (pm * error + qm * rest_error + 6.0 + 3.0 * ps + 20.0 * rs) + 1.0,
            rho * (error + pm * rest_error + 3.0 + 3.0 * rs) + 1.0,
        );
        let grown = |x: i128| Some(x.checked_mul(factor)? >> (log_c + 1));
        (sum, rest) = (
            one + grown(times(p, sum) - times(q2, rest))?,
            grown(sum + times(p, rest))?,
        );
    }
    // P + 2a²S, P − 2b²S; a², b² ≤ 1 with three units, products with three.
    let total = (error + 2.0 * (rest_error + 3.0 * size(rest).abs() + 3.0)) * 1.01 + 1.0;
    let wide = Mag::from_f64(total).shift(-i64::from(UNIT));
    let root_pi = ROOT_PI.get_or_init(|| Ball::pi(PREC + 8).sqrt().mid().clone());
    let part = |factor: Float, n: i128| {
        let factor = factor / root_pi;
        let mid = (Float::with_val(PREC, n) >> UNIT) * &factor;
        let error = Mag::above(&factor)
            .mul(wide)
            .add(Mag::above(&mid).shift(-150));
        Ball::new(mid, error)
    };
    let [below, beside] = [Mag::above(&a), Mag::above(&b)];
    let re = part(b, sum + 2 * times(aa, rest));
    let im = part(a, sum - 2 * times(bb, rest));
    let bound = remainder(n, log_r);
    // An angle to an axis is at most π/2 times its sine: (π/2) |z| x/|z|² to the imaginary axis.
    let arc = |sine: Mag| sine.mul(above_power(0.5 * log_r + 0.66));
    let plain = above_power(bound.plain);
    let im = im.widened(plain.min(arc(below).mul(above_power(bound.turning))));
    let ball = |f: Float, slack: Mag| {
        let error = Mag::above(&f).shift(-140).add(slack);
        Ball::new(f, error)
    };
    // D_N + 2|z|² e^{−Re z²}.
    let gauss = gaussian_bound(x, y);
    let turning = above_power(bound.turning).add(gauss.mul(above_power(log_r + 1.01)));
    let turned = arc(beside).mul(turning);
    if y.double >= 0.999 * x.double || plain <= turned {
        let re = re.widened(plain);
        if wanted == Wanted::Upper {
            return Some(ComplexBall::new(re, im));
        }
        let (c, s, slack) = gaussian(x, y)?;
        let (c, s) = (ball(c, slack), ball(s, slack));
        return Some(match wanted {
            Wanted::Dawson => ComplexBall::new(&re - &c, &im + &s),
            // 2E − conj w, E = c + is.
            _ => ComplexBall::new(&c.shift(1) - &re, &im + &s.shift(1)),
        });
    }
    let re = re.widened(turned);
    let re = if wanted == Wanted::Lower { -re } else { re };
    if wanted == Wanted::Dawson {
        // Re D is what the series gives.
        let im = match gauss <= im.mignitude().shift(-i64::from(bits) - 8) {
            true => im.widened(gauss),
            false => {
                let (_, s, slack) = gaussian(x, y)?;
                &im + &ball(s, slack)
            }
        };
        return Some(ComplexBall::new(re, im));
    }
    if gauss <= re.mignitude().shift(-i64::from(bits) - 8) {
        let im = match wanted {
            Wanted::Lower => im.widened(gauss.shift(1)),
            _ => im,
        };
        return Some(ComplexBall::new(re.widened(gauss), im));
    }
    let (c, s, slack) = gaussian(x, y)?;
    // Below: 2E − conj w, E = c + is.
    let im = match wanted {
        Wanted::Lower => &im + &ball(s, slack).shift(1),
        _ => im,
    };
    Some(ComplexBall::new(&re + &ball(c, slack), im))
}

/// 2^x or more.
fn above_power(x: f64) -> Mag {
    Mag::power_of_two(x.ceil().max(-1e12) as i64)
}

/// A bound on `e^{−Re z²}` for |Im z| ≤ |Re z|; log₂ e is more than 1.442.
fn gaussian_bound(x: &Coordinate, y: &Coordinate) -> Mag {
    let (x, y) = (x.double * (1.0 - 1e-15), y.double * (1.0 + 1e-15));
    above_power(-1.442 * ((x - y) * (x + y)).max(0.0))
}

/// √π with a relative error below 2^-160.
static ROOT_PI: OnceLock<Float> = OnceLock::new();
