//! Quotients, exponentials, logarithms and powers.

use super::super::support::{BITS, doubles, ends, exact, hull_of_doubles, is_narrow};
use super::super::trigonometric::{outwards, sin_cos};
use super::super::{self as real, ComplexEvaluated, NoValue};
use super::{GUARD, below, inner, is_across, middle, rounded, widened};
use crate::{Ball, ComplexBall, Mag};
use rug::Float;

/// `1/z`: `|1/z − 1/m| = |z − m|/(|z| |m|) ≤ ρ/(|z| |m|)`.
pub fn recip(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    if z.im.is_zero() {
        return Ok(ComplexBall::new(real::recip(&z.re, prec)?, exact(prec, 0)));
    }
    let one = ComplexBall::new(exact(BITS, 1), exact(BITS, 0));
    div(&one, z, prec)
}

/// Doubles of these sizes have squares far from the ends of their exponents.
const MODERATE: std::ops::Range<f64> = 1e-140..1e140;

/// Both ends of each part of a rectangle.
fn parts_of(z: &ComplexBall) -> [[f64; 2]; 2] {
    [&z.re, &z.im].map(|x| doubles(&ends(x, BITS)))
}

/// Leaves out a rectangle with ends that are neither zero nor of moderate size.
fn moderate(parts: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let is_moderate = |x: &f64| *x == 0.0 || MODERATE.contains(&x.abs());
    parts
        .as_flattened()
        .iter()
        .all(is_moderate)
        .then_some(parts)
}

/// The least and the greatest absolute value.
fn sizes([low, high]: [f64; 2]) -> [f64; 2] {
    [low.max(-high).max(0.0), high.max(-low)]
}

/// The inverse of a wide rectangle that does not hold zero, part by part.
///
/// `x/(x² + y²)` for x > 0 falls with |y|, and with x grows up to |y| and falls beyond. `−y/(x² +
/// y²)` is the same with the parts changed.
pub(super) fn inverse_of_doubles(parts: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let [x, y] = moderate(parts)?;
    let part = |[low, high]: [f64; 2], [near, far]: [f64; 2]| {
        let at = |x: f64, y: f64| x / (x * x + y * y);
        let top = |low: f64, high: f64| {
            let x = near.clamp(low, high);
            at(x, near)
        };
        let bottom = |low: f64, high: f64| at(low, far).min(at(high, far));
        let greatest = match high > 0.0 {
            true => top(low.max(0.0), high),
            false => -bottom(-high, -low),
        };
        let least = match low < 0.0 {
            true => -top((-high).max(0.0), -low),
            false => bottom(low, high),
        };
        outwards([least, greatest])
    };
    let [low, high] = part(y, sizes(x));
    Some([part(x, sizes(y)), [-high, -low]])
}

/// The ball around a rectangle between doubles.
fn around([re, im]: [[f64; 2]; 2], prec: u32) -> Option<ComplexBall> {
    let hull = |range| hull_of_doubles(prec, range).ok();
    Some(ComplexBall::new(hull(re)?, hull(im)?))
}

/// `z/w`: with the midpoints m and n, `z/w − m/n = ((z − m) − (m/n)(w − n))/w`, at most
/// `(ρ_z + |m/n| ρ_w)/|w|`.
pub fn div(z: &ComplexBall, w: &ComplexBall, prec: u32) -> ComplexEvaluated {
    if w.re.is_zero() && w.im.is_zero() {
        return Err(NoValue::Undefined("division by zero"));
    }
    let least = below(w);
    if least.is_zero() {
        return Err(NoValue::Undecided("the divisor may be zero"));
    }
    let p = prec + GUARD;
    if !is_narrow(w.radius(), least)
        && let Some(inverse) = inverse_of_doubles(parts_of(w)).and_then(|parts| around(parts, p))
    {
        let product = |x: &Ball, y: &Ball| real::mul(x, y, prec);
        let re = product(&z.re, &inverse.re)?;
        let im = product(&z.re, &inverse.im)?;
        if z.im.is_zero() {
            return Ok(ComplexBall::new(re, im));
        }
        let re = real::sub(&re, &product(&z.im, &inverse.im)?, prec)?;
        let im = real::add(&im, &product(&z.im, &inverse.re)?, prec)?;
        return Ok(ComplexBall::new(re, im));
    }
    let (m, n) = (middle(z), middle(w));
    let size = inner(real::hypot(&n.re, &n.im, p))?;
    // Divided by the modulus twice, which overflows only where the quotient does.
    let by = |x: &Ball| inner(real::div(x, &size, p));
    let (a, b) = (by(&n.re)?, by(&n.im)?);
    let times = |x: &Ball, y: &Ball| real::mul(x, y, p);
    let re = real::add(&times(&m.re, &a)?, &times(&m.im, &b)?, p)?;
    let im = real::sub(&times(&m.im, &a)?, &times(&m.re, &b)?, p)?;
    let quotient = ComplexBall::new(by(&re)?, by(&im)?);
    let turn = quotient.magnitude().mul(w.radius());
    widened(&quotient, z.radius().add(turn).div(least), prec)
}

/// `e^z = e^x (cos y + i sin y)`.
pub fn exp(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    let p = prec + GUARD;
    let e = real::exp(&z.re, p)?;
    let of = |x: &Ball| real::mul(&e, x, prec);
    if z.im.is_zero() {
        return Ok(ComplexBall::new(of(&exact(BITS, 1))?, exact(prec, 0)));
    }
    let [sin, cos] = sin_cos(&z.im, p)?;
    Ok(ComplexBall::new(of(&cos)?, of(&sin)?))
}

/// `e^z − 1 = (e^x − 1) cos y − 2 sin²(y/2) + i e^x sin y`.
pub fn expm1(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    let p = prec + GUARD;
    let e = real::expm1(&z.re, p)?;
    if z.im.is_zero() {
        return rounded(&ComplexBall::new(e, exact(BITS, 0)), prec);
    }
    let half = real::sqr(&real::sin(&z.im.shift(-1), p)?, p)?.shift(1);
    let re = real::mul(&e, &real::cos(&z.im, p)?, p)?;
    let grown = real::exp(&z.re, p)?;
    let im = real::mul(&grown, &real::sin(&z.im, p)?, prec)?;
    Ok(ComplexBall::new(real::sub(&re, &half, prec)?, im))
}

/// `ln |1 + z|` from `|1 + z|² − 1 = x (2 + x) + y²`, where that is above −1/2; in between from the
/// modulus. The gradient is at most `1/|1 + z|`.
fn log_modulus_1p(z: &ComplexBall, prec: u32) -> real::Evaluated {
    let p = prec + GUARD;
    let shifted = super::plus(z, 1, p)?;
    let of = |z: &ComplexBall| {
        let more = inner(real::add(&z.re, &exact(BITS, 2), p))?;
        let square = inner(real::sqr(&z.im, p))?;
        inner(real::fma(&z.re, &more, &square, p))
    };
    let near = of(&middle(z)).ok().filter(|q| {
        let half = Float::with_val(BITS, -0.5);
        *q.mid() > half && q.mid() < &Float::with_val(BITS, 4)
    });
    let Some(q) = near else {
        return real::log(&inner(real::hypot(&shifted.re, &shifted.im, p))?, prec);
    };
    let value = real::log1p(&q, p)?.shift(-1);
    let turn = slope_of_log(&shifted);
    real::error::widened(real::support::with_prec(&value, prec)?, turn)
        .or_else(|_| real::log(&inner(real::hypot(&shifted.re, &shifted.im, p))?, prec))
}

/// `(|x| r_x + |y| r_y)/|z|²`, a bound on the change of ln |z| over a box.
fn slope_of_log(z: &ComplexBall) -> Mag {
    let least = below(z);
    let turn = z.re.magnitude().mul(z.re.rad());
    let turn = turn.add(z.im.magnitude().mul(z.im.rad()));
    turn.div(least.mul_below(least))
}

/// The principal logarithm `ln |z| + i arg z`, arg z in (−π, π].
pub fn log(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    if z.re.is_zero() && z.im.is_zero() {
        return Err(NoValue::Undefined("the logarithm of zero"));
    }
    let im = real::atan2(&z.im, &z.re, prec)?;
    let size = inner(real::hypot(&z.re, &z.im, prec + GUARD))?;
    // Near the unit circle the logarithm is that of what is beyond one.
    let near = *size.mid() > 0.5 && *size.mid() < 2;
    let re = if near && !z.im.is_zero() {
        let mut less = super::plus(z, -1, z.re.prec().max(prec) + GUARD)?;
        if z.re.is_negative() {
            // |z| = |−z|
            less = super::plus(&-z, -1, z.re.prec().max(prec) + GUARD)?;
        }
        log_modulus_1p(&less, prec)?
    } else if near {
        real::log(&real::fabs(&z.re, z.re.prec().max(prec))?, prec)?
    } else {
        real::log(&size, prec)?
    };
    Ok(ComplexBall::new(re, im))
}

/// The principal logarithm of `1 + z`.
pub fn log1p(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    let shifted = super::plus(z, 1, prec + GUARD)?;
    if shifted.re.is_zero() && shifted.im.is_zero() {
        return Err(NoValue::Undefined("log1p at -1"));
    }
    let im = real::atan2(&shifted.im, &shifted.re, prec)?;
    Ok(ComplexBall::new(log_modulus_1p(z, prec)?, im))
}

/// The principal square root at a midpoint above the real axis or on it: with
/// `t = √((|z| + |x|)/2)` it is `t + i y/(2t)` for x ≥ 0, and `y/(2t) + i t` for x < 0.
pub(super) fn sqrt_above(m: &ComplexBall, p: u32) -> ComplexEvaluated {
    if m.re.is_zero() && m.im.is_zero() {
        return Ok(ComplexBall::zero(p));
    }
    let size = inner(real::hypot(&m.re, &m.im, p))?;
    let sum = inner(real::add(&size, &m.re.abs(), p))?;
    let t = real::sqrt(&sum.shift(-1), p)?;
    let other = inner(real::div(&m.im, &t, p))?.shift(-1);
    Ok(if m.re.mid().is_sign_negative() {
        ComplexBall::new(other, t)
    } else {
        ComplexBall::new(t, other)
    })
}

/// The root of a wide rectangle that does not cross its cut, part by part: the real part grows with
/// x and |y|, the modulus of the imaginary part with −x and |y|, and is the real part of √−z.
pub(super) fn root_of_doubles(parts: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let [[left, right], y] = moderate(parts)?;
    let at = |x: f64, y: f64| {
        let size = (x * x + y * y).sqrt();
        match x >= 0.0 {
            true => ((size + x) / 2.0).sqrt(),
            false => y / (2.0 * (size - x)).sqrt(),
        }
    };
    let [near, far] = sizes(y);
    let re = [at(left, near), at(right, far)];
    let im = match y {
        [low, _] if low >= 0.0 => [at(-right, near), at(-left, far)],
        [_, high] if high < 0.0 => [-at(-left, far), -at(-right, near)],
        [low, high] => [-at(-left, -low), at(-left, high)],
    };
    Some([outwards(re), outwards(im)])
}

/// The principal square root, with its real part not negative: the derivative is `1/(2√z)`.
pub fn sqrt(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    if z.im.is_zero() && z.re.is_positive() {
        return Ok(ComplexBall::new(real::sqrt(&z.re, prec)?, exact(prec, 0)));
    }
    off_cut(z)?;
    let rho = z.radius();
    if !is_narrow(rho, below(z))
        && let Some(root) = root_of_doubles(parts_of(z)).and_then(|parts| around(parts, prec))
    {
        return Ok(root);
    }
    let p = prec + GUARD;
    let m = middle(z);
    let root = if m.im.mid().is_sign_negative() {
        sqrt_above(&m.conj(), p)?.conj()
    } else {
        sqrt_above(&m, p)?
    };
    let change = rho.div(real::trigonometric::root_below(below(z))).shift(-1);
    widened(&root, change, prec)
}

/// Refuses a box that has points on both sides of the negative real axis.
pub(super) fn off_cut(z: &ComplexBall) -> Result<(), NoValue> {
    let low = || real::support::ends(&z.re, BITS)[0].clone();
    if is_across(z) && low() <= 0 {
        return Err(NoValue::Undecided(
            "the operand meets the negative real axis",
        ));
    }
    Ok(())
}

/// The principal cube root `e^{(log z)/3}`.
pub fn cbrt(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    if z.re.is_zero() && z.im.is_zero() {
        return Ok(ComplexBall::zero(prec));
    }
    let p = prec + GUARD + 32;
    let log = log(z, p)?;
    let three = exact(BITS, 3);
    let third = |x: &Ball| real::div(x, &three, p);
    exp(&ComplexBall::new(third(&log.re)?, third(&log.im)?), prec)
}

/// Exponents up to this one are multiplied out.
const MOST: i64 = 1 << 10;

/// The principal power `e^{w log z}`; `z^0 = 1`, and zero to a power with a positive real part is
/// zero. A power with an integer exponent has no cut: `|z^n − m^n| ≤ ρ |n| sup |z|^{n−1}`.
pub fn pow(z: &ComplexBall, w: &ComplexBall, prec: u32) -> ComplexEvaluated {
    let whole = w.im.is_zero() && w.re.rad().is_zero() && w.re.mid().is_integer();
    if whole && w.re.is_zero() {
        return Ok(ComplexBall::new(exact(prec, 1), exact(prec, 0)));
    }
    if z.re.is_zero() && z.im.is_zero() {
        return if w.re.is_positive() {
            Ok(ComplexBall::zero(prec))
        } else if w.re.is_negative() {
            Err(NoValue::Undefined("zero to a negative power"))
        } else {
            Err(NoValue::Undecided("zero to a power that may be negative"))
        };
    }
    let exponent = w.re.mid().to_integer().and_then(|n| n.to_i64());
    if let Some(n) = exponent.filter(|n| whole && n.abs() <= MOST) {
        if n < 0 {
            return recip(&integer_power(z, -n, prec + GUARD)?, prec);
        }
        return integer_power(z, n, prec);
    }
    // A power of the root; of a wide box the logarithm has less to lose.
    let twice = w.re.shift(1);
    let exponent = twice.mid().to_integer().and_then(|n| n.to_i64());
    if let Some(n) = exponent.filter(|n| n.abs() <= MOST && w.im.is_zero())
        && twice.rad().is_zero()
        && twice.mid().is_integer()
        && !whole
        && (n.abs() == 1 || is_narrow(z.radius(), below(z)))
    {
        let root = sqrt(z, prec + GUARD)?;
        let power = integer_power(&root, n.abs(), prec + GUARD)?;
        return match n < 0 {
            true => recip(&power, prec),
            false => rounded(&power, prec),
        };
    }
    // The logarithm is multiplied by w: as many bits more as that is long.
    let long = |x: &Ball| x.mid().get_exp().unwrap_or(0).clamp(0, 1 << 12) as u32;
    let p = prec + GUARD + 32 + long(&w.re).max(long(&w.im));
    // (−1)^n (−z)^n where z meets the cut.
    let turn = whole && off_cut(z).is_err();
    let log = if turn { log(&-z, p)? } else { log(z, p)? };
    let product = |a: &Ball, b: &Ball| real::mul(a, b, p);
    let re = real::sub(&product(&w.re, &log.re)?, &product(&w.im, &log.im)?, p)?;
    let im = real::add(&product(&w.re, &log.im)?, &product(&w.im, &log.re)?, p)?;
    let power = exp(&ComplexBall::new(re, im), prec)?;
    let half = Float::with_val(w.re.prec(), w.re.mid() >> 1u32);
    let odd = !half.is_integer();
    Ok(if turn && odd { -&power } else { power })
}

/// `z^n` for 0 < n ≤ [`MOST`].
fn integer_power(z: &ComplexBall, n: i64, prec: u32) -> ComplexEvaluated {
    let p = prec + GUARD + 2 * (64 - n.leading_zeros());
    let m = middle(z);
    let times = |a: &ComplexBall, b: &ComplexBall| -> ComplexEvaluated {
        let product = |x: &Ball, y: &Ball| real::mul(x, y, p);
        Ok(ComplexBall::new(
            real::sub(&product(&a.re, &b.re)?, &product(&a.im, &b.im)?, p)?,
            real::add(&product(&a.re, &b.im)?, &product(&a.im, &b.re)?, p)?,
        ))
    };
    let mut power = m.clone();
    for bit in (0..63 - n.leading_zeros()).rev() {
        power = inner(times(&power, &power))?;
        if n >> bit & 1 == 1 {
            power = inner(times(&power, &m))?;
        }
    }
    let size = z.magnitude();
    let grown = (1..n).fold(Mag::from_f64(n as f64), |all, _| all.mul(size));
    widened(&power, grown.mul(z.radius()), prec)
}
