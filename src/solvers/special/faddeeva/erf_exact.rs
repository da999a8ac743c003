//! The error functions at one point where sums of rounded terms keep too few digits, and where it
//! is huge.

use super::branch::{STRIP, is_huge};
use super::constants::{INV_SQRT_PI, TWO_OVER_SQRT_PI};
use super::erf_zeros;
use super::long::Long;
use super::long_relatives;
use super::long_w::{turned, vanishing_part};
use super::quadrant::{
    both_exact, circle, gaussian_exact, lifted, mirrored, pair_times_power, product, times_power,
};
use crate::double_double::Dd;
use crate::hex::hex;
use crate::lanes::{Lanes, Task};
use crate::real::{Masked, ROUND, is_zero, scaled};

/// xy below which, x being small, Re erf is linear in it.
pub(super) const LINEAR: f64 = hex("0x1p-32");
/// 2²⁰⁰, beside which 1 is nothing.
const LARGE: f64 = hex("0x1p200");

/// Which function: `offset + sign · erf` in the real part, `sign · erf` in the imaginary part.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Which {
    /// erf z.
    Erf,
    /// 1 − erf z.
    Erfc,
    /// 1 + erf z, for erfc(−z).
    Erfcm,
}

impl Which {
    /// `(offset, sign)` for erf.
    #[inline(always)]
    fn of_erf(self) -> (f64, f64) {
        match self {
            Which::Erf => (0.0, 1.0),
            Which::Erfc => (1.0, -1.0),
            Which::Erfcm => (1.0, 1.0),
        }
    }
    /// `(offset, sign)` for erfc.
    #[inline(always)]
    fn of_erfc(self) -> (f64, f64) {
        match self {
            Which::Erf => (1.0, -1.0),
            Which::Erfc => (0.0, 1.0),
            Which::Erfcm => (2.0, -1.0),
        }
    }
}

/// `offset + sign · t 2^k`, `n = ROUND + k`.
#[inline(always)]
pub(super) fn shifted<R: Masked>((offset, sign): (R, R), t: Dd<R>, n: R) -> R {
    let like = |c: f64| t.hi.like(c);
    let alone = times_power(sign * t.value(), n);
    let beside = t.hi.both(
        like(0.0).below(offset),
        alone.magnitude().below(like(LARGE)),
    );
    let alone = t.hi.pick(is_zero(t.hi), offset, alone);
    let p = pair_times_power(t, n.at_most(like(ROUND + 2040.0)));
    let sum = Dd::new(sign * p.hi, sign * p.lo).add_f(offset);
    t.hi.pick(beside, sum.value(), alone)
}

/// Returns whether a value of [`shifted`] is below a part of the larger one of the offset and the
/// terms of `t`, of size `term`.
#[inline(always)]
pub(super) fn cancels<R: Masked>(
    (value, part): (R, R),
    offset: R,
    (t, term, n): (Dd<R>, R, R),
) -> R::Mask {
    let like = |c: f64| value.like(c);
    let beside = value.both(
        like(0.0).below(offset),
        value.magnitude().below(like(LARGE)),
    );
    let term_here = scaled(term, n.raised(ROUND - 2040.0).at_most(like(ROUND + 2040.0)));
    let sum = value.magnitude().below(part * offset.at_least(term_here));
    let alone = t.hi.magnitude().below(part * term);
    value.or(value.both(beside, sum), value.except(alone, beside))
}

/// `e^{−z²} (u − i v)` in double-double.
struct Exact {
    which: Which,
    x: f64,
    y: f64,
    /// Exponents to subtract again.
    down: (f64, f64),
}

impl Task for Exact {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let Exact { which, x, y, down } = self;
        let zero = match which {
            Which::Erf => erf_zeros::near_zero_of_erf(x, y),
            Which::Erfc => None,
            Which::Erfcm => erf_zeros::near_zero_of_erfc(x, y),
        };
        if let Some((u, v)) = zero {
            let (c, s, n) = gaussian_exact(lanes, x, y);
            let (re, im, _) = product((c, s), (u, v));
            let (p, q) = (re.hi.abs(), im.hi.abs());
            if p.min(q) < vanishing_part(x, y) * p.max(q) {
                return self.vanishing();
            }
            return (times_power(re.value(), n), times_power(im.value(), n));
        }
        let ((u, v), e) = both_exact(lanes, y, x);
        let (c, s, n) = mirrored(e);
        let (product_re, im, _) = product((c, s), (u, -v));
        let (offset, sign) = which.of_erfc();
        let linear = x < STRIP && x * y < LINEAR;
        let re = if linear {
            // Re erf = (2/√π) x e^{y²} (1 − x²(2y² + 1)/3 + …), and c = e^{y²} (1 − x²(2y² + 1) +
            // …); e^{−z²}w is far larger.
            let linear = (c * TWO_OVER_SQRT_PI).mul_f(x);
            let second = 2.0 / 3.0 * (x * x) * (2.0 * y).mul_add(y, 1.0);
            let linear = linear.add_f(linear.hi * second);
            shifted(which.of_erf(), linear, n - down.0)
        } else {
            shifted((offset, sign), product_re, n - down.0)
        };
        let (part, t) = (vanishing_part(x, y), turned(x, y));
        let (u, v, e) = (u.hi.abs(), v.hi.abs(), c.hi.abs().max(s.hi.abs()));
        let (re_terms, im_terms) = (e * t.mul_add(v, u), e * t.mul_add(u, v));
        let within_range = (n - down.0).clamp(ROUND - 2040.0, ROUND + 900.0);
        let im_value = times_power(sign * im.value(), n - down.1);
        if linear {
            let vanishes = re.abs() < part * which.of_erf().0;
            return (if vanishes { self.linear() } else { re }, im_value);
        }
        let vanishes = (product_re.hi.abs() < part * re_terms)
            | (im.hi.abs() < part * im_terms)
            | (re.abs() < part * offset.max(scaled(re_terms, within_range)));
        if vanishes {
            return self.vanishing();
        }
        (re, im_value)
    }
}

impl Exact {
    /// Where a component is too small beside its terms for double-double.
    #[cold]
    #[inline(never)]
    fn vanishing(&self) -> (f64, f64) {
        let (offset, sign) = self.which.of_erfc();
        let (re, im) = long_relatives::erfc(self.x, self.y);
        let (re, im) = if sign < 0.0 { (-re, -im) } else { (re, im) };
        let re = Long::from(offset) + re;
        let down = [self.down.0, self.down.1].map(|k| -(k as i64));
        (re.scale(down[0]).value(), im.scale(down[1]).value())
    }

    /// The real part where that of erf is linear in x and next to 1.
    #[cold]
    #[inline(never)]
    fn linear(&self) -> f64 {
        let (offset, sign) = self.which.of_erf();
        let re = long_relatives::re_erf(self.x, self.y).scale(-(self.down.0 as i64));
        (Long::from(offset) + if sign < 0.0 { -re } else { re }).value()
    }
}

/// The function in the first quadrant at points that are huge or not finite.
#[cold]
#[inline(never)]
fn limits(which: Which, x: f64, y: f64) -> (f64, f64) {
    let (offset, sign) = which.of_erf();
    let one = offset + sign;
    if x.is_nan() || y.is_nan() {
        // Real on the real axis; Re erf is zero on the imaginary axis.
        let re = if x == 0.0 { offset } else { f64::NAN };
        let im = if y == 0.0 { sign * y } else { f64::NAN };
        return (re, im);
    }
    if x > y || y == 0.0 {
        return (one, sign * 0.0);
    }
    if x == 0.0 {
        return (offset, sign * f64::INFINITY);
    }
    if y.is_infinite() {
        return (f64::NAN, f64::NAN);
    }
    // erfc ~ e^{−2ixy} (x − i y)/(√π r²), of modulus e^{y² − x²}/(√π r).
    let (s, c) = circle(x, y);
    if y > x {
        // Exponents apart, so that nothing overflows; the signs are those of −erfc.
        let ratio = x / y;
        let re = c.hi.mul_add(ratio, -s.hi);
        let im = -s.hi.mul_add(ratio, c.hi);
        let sign = -sign;
        return (
            f64::INFINITY.copysign(sign * re),
            f64::INFINITY.copysign(sign * im),
        );
    }
    let size = 0.5 * INV_SQRT_PI.hi / x;
    let re = (c + -s).value() * size;
    let im = -(s + c).value() * size;
    let (offset, sign) = which.of_erfc();
    (offset + sign * re, sign * im)
}

/// The function at any point of the first quadrant.
#[inline(always)]
pub(super) fn alone<L: Lanes>(lanes: L, which: Which, a: f64, b: f64) -> (f64, f64) {
    if is_huge(a, b) {
        return limits(which, a, b);
    }
    let ((x, x_down), (y, y_down)) = (lifted(a, b), lifted(b, a));
    let down = (x_down, y_down);
    Exact { which, x, y, down }.run(lanes)
}
