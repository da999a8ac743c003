//! The gamma function and its logarithm.
//!
//! # Stirling's series
//! For Re z > 0 (DLMF 5.11.1 and 5.11.11, with `cos² (θ/2) = (|z| + x)/(2|z|)` for θ = arg z)
//!
//! ```text
//! ln Γ(z) = (z − 1/2) ln z − z + ln(2π)/2 + Σ_{k<n} B_2k/(2k (2k − 1) z^{2k−1}) + R_n
//! |R_n| ≤ |B_2n|/(2n (2n − 1) |z|^{2n−1}) (2|z|/(|z| + x))^n
//! ```
//!
//! after a shift by N: `ln Γ(z) = ln Γ(z + N) − Σ_{k<N} ln(z + k)`. The sum of the logarithms is
//! the logarithm of the product with the multiple of 2πi that is next to the sum of the angles.
//!
//! # Reflection
//! For Re z < 1/2 and Im z ≥ 0 `ln Γ(z) = ln π − L(z) − ln Γ(1 − z)` with `L(z) = ln(1 − e^{2πiz})
//! − ln 2 + iπ(1/2 − z)`, which is analytic there and equal to ln sin πz on (0, 1); conjugates
//! below the axis.
//!
//! # Derivative
//! `ψ(z) = ln z − ∫_0^∞ h(t) e^{−tz} dt` with `h(t) = 1/(1 − e^{−t}) − 1/t` for Re z > 0 (DLMF
//! 5.9.13). h grows from 1/2 to 1, because `h' = 1/t² − 1/(4 sinh²(t/2)) > 0`: by parts the integral
//! is `(1/2 + ∫ h' e^{−tz} dt)/z`, at most `1/|z|`. To the left of 1/2 `ψ(z) = ψ(1 − z) − π cot
//! πz`, `|cot πz|² ≤ 1 + 1/|sin πz|²` and `|sin πz|² = sin² πx + sinh² πy`. ln Γ changes over a box
//! of the half-widths r and s by at most `r |Re ψ| + s |Im ψ|` in its real part, and `r |Im ψ| +
//! s |Re ψ|` in its imaginary part.

use super::super::coarse;
use super::super::support::{BITS, exact};
use super::super::{self as real, ComplexEvaluated, NoValue};
use super::exponential::{exp, log};
use super::{GUARD, Kept, REACH, clipped, f64_down, is_across, rounded};
use crate::{Ball, ComplexBall, Mag};
use rug::float::Constant;
use rug::{Float, Integer, Rational};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::{Arc, Mutex};

/// `T_1 … T_n`, the tangent numbers: `tan x = Σ T_k x^{2k−1}/(2k − 1)!`.
fn tangent_numbers(n: usize) -> Vec<Integer> {
    let mut t = vec![Integer::from(1)];
    for k in 1..n {
        let next = Integer::from(&t[k - 1] * k as u64);
        t.push(next);
    }
    for k in 1..n {
        for j in k..n {
            let (a, b) = ((j - k) as u64, (j - k + 2) as u64);
            let next = Integer::from(&t[j - 1] * a) + Integer::from(&t[j] * b);
            t[j] = next;
        }
    }
    t
}

/// `B_2k/(2k (2k − 1))` for k = 1 … n, with `B_2k = (−1)^{k−1} 2k T_k/(4^k (4^k − 1))`.
pub(in crate::elementary) fn coefficients(n: usize) -> Arc<Vec<Rational>> {
    static KNOWN: Mutex<Option<Arc<Vec<Rational>>>> = Mutex::new(None);
    let mut known = KNOWN.lock().unwrap_or_else(|broken| broken.into_inner());
    if let Some(all) = known.as_ref().filter(|all| all.len() >= n) {
        return Arc::clone(all);
    }
    let numbers = tangent_numbers((n + n / 2).max(32));
    let all = numbers.into_iter().enumerate().map(|(i, t)| {
        let k = i as u32 + 1;
        let four = Integer::from(1) << (2 * k);
        let below = Integer::from(&four - 1u32) * &four * (2 * k - 1);
        let c = Rational::from((t, below));
        if k.is_multiple_of(2) { -c } else { c }
    });
    let all = Arc::new(all.collect());
    *known = Some(Arc::clone(&all));
    all
}

/// `ln(2π)/2` and at least n coefficients of Stirling's series in balls of at least `p` bits.
fn stirling_constants(n: usize, p: u32) -> Result<Arc<(Ball, Vec<Ball>)>, NoValue> {
    static KNOWN: Kept<(Ball, Vec<Ball>)> = Kept::new();
    KNOWN.get(
        p,
        |known| known.1.len() >= n,
        |p| {
            let half_log = real::log(&Ball::pi(p).shift(1), p)?.shift(-1);
            let all = coefficients(n);
            let all = all.iter().map(|c| Ball::rational(p, c)).collect();
            Ok((half_log, all))
        },
    )
}

/// About as many terms of Stirling's series as make its remainder less than 2^-p, or the least; the
/// ratio of the bounds on R_{n+1} and R_n is nearly `2n (2n − 1) c/(4π² |z|²)`, c the factor of the
/// sector.
fn terms(log_size: f64, sector: f64, p: u32) -> usize {
    let mut log = -log_size;
    let mut n = 1;
    loop {
        let k = 2.0 * n as f64;
        let ratio = (k * (k - 1.0) * sector / 39.478).log2() - 2.0 * log_size;
        if ratio >= 0.0 || log < -f64::from(p) {
            return n + 1;
        }
        log += ratio;
        n += 1;
    }
}

/// Stirling's series at an exact z with Re z ≥ 1/2, in balls of `p` bits.
fn stirling(z: &ComplexBall, p: u32) -> ComplexEvaluated {
    // 2π |z| is enough for e^{−2π|z|} ≤ 2^−9|z|; twice as much halves the number of terms.
    let wanted = 0.22 * f64::from(p) + 4.0;
    let far = f64_down(z.re.mid()).max(f64_down(z.im.mid()).abs());
    let n = (wanted - far).max(0.0).ceil() as u32;
    let big = shifted(z, n)?;
    let size = big.magnitude();
    let least = super::below(&big);
    let x = big.re.mignitude();
    // (2|z|/(|z| + x)) with upper and lower bounds.
    let sector = size.shift(1).div(least.add_below(x));
    let inverse = Mag::power_of_two(0).div(least);
    let square = inverse.mul(inverse);
    let due = Mag::power_of_two(-i64::from(p));
    let log_size = least.exponent().unwrap_or(0) as f64;
    let most = terms(log_size, sector.to_f64().max(1.0), p);
    let known = stirling_constants(most + 1, p)?;
    let (half_log, all) = &*known;
    let (mut power, mut turn, mut terms, mut rest) = (inverse, sector, 0, Mag::INFINITY);
    for c in all.iter() {
        let size = c.magnitude();
        // R_n with n = terms + 1.
        let bound = size.mul(power).mul(turn);
        let falls = bound < rest;
        rest = bound;
        if rest <= due || !falls || terms == most {
            break;
        }
        terms += 1;
        power = power.mul(square);
        turn = turn.mul(sector);
    }
    // Horner's scheme in 1/z².
    let u = real::complex::recip(&big, p)?;
    let v = u.square();
    let mut sum = ComplexBall::zero(p);
    for c in all[..terms].iter().rev() {
        sum = &sum * &v;
        sum.re = &sum.re + c;
    }
    let sum = &sum * &u;
    let log_big = log(&big, p)?;
    let half = Ball::exact(53, 0.5);
    let less = ComplexBall::new(real::sub(&big.re, &half, p)?, big.im.clone());
    let lead = &(&less * &log_big) - &big;
    let lead = ComplexBall::new(&lead.re + half_log, lead.im);
    let value = (&lead + &sum).widened(rest);
    if n == 0 {
        return Ok(value);
    }
    Ok(&value - &log_of_product(z, n, p)?)
}

/// `z + n` with as many bits as it has, up to what is far beyond the precision.
fn shifted(z: &ComplexBall, n: u32) -> ComplexEvaluated {
    let bits = z.re.prec() + 64;
    let re = real::add(&z.re, &Ball::integer(64, i64::from(n)), bits)?;
    Ok(ComplexBall::new(re, z.im.clone()))
}

/// The most factors whose angles are added; their sum has an error below 2^−20.
const MOST_FACTORS: u32 = 1 << 22;

/// `Σ_{k<n} ln(z + k)`: the logarithm of the product, and the multiple of 2π by which the sum of
/// the angles differs from its argument.
fn log_of_product(z: &ComplexBall, n: u32, p: u32) -> ComplexEvaluated {
    let mut product = ComplexBall::new(exact(p, 1), exact(p, 0));
    // In doubles: the multiple of 2π is an integer.
    let mut angles = 0.0;
    for k in 0..n {
        let factor = shifted(z, k)?;
        let [re, im] = [&factor.re, &factor.im].map(|x| x.mid().to_f64());
        let axis = if im.abs() > re {
            FRAC_PI_2.copysign(im)
        } else {
            0.0
        };
        angles += coarse::atan2(im, re).unwrap_or(axis);
        let factor = ComplexBall::new(factor.re.with_prec(p), factor.im.with_prec(p));
        product = &product * &factor;
    }
    // The argument with the sign of the axis decided by the side of z.
    let found = if product.im.contains_zero() && product.re.is_negative() {
        let back = log(&-&product, p)?;
        ComplexBall::new(back.re, real::add(&back.im, &Ball::pi(p), p)?)
    } else {
        log(&product, p)?
    };
    let turns = (angles - found.im.mid().to_f64()) / (2.0 * PI);
    let whole = turns.round_ties_even();
    let is_sure = (turns - whole).abs() < 0.01 && found.im.rad() < Mag::from_f64(0.01);
    if n > MOST_FACTORS || !is_sure {
        return Err(NoValue::Undecided("the branch of a logarithm"));
    }
    let turned = real::mul(&Ball::exact(64, whole), &Ball::pi(p).shift(1), p)?;
    Ok(ComplexBall::new(
        found.re,
        real::add(&found.im, &turned, p)?,
    ))
}

/// ln Γ at an exact midpoint on the axis or above, in balls of `p` bits.
fn log_gamma_above(m: &ComplexBall, p: u32) -> ComplexEvaluated {
    if *m.re.mid() >= 0.5 {
        return stirling(m, p);
    }
    let bits = m.re.prec() + 64;
    let re = real::sub(&exact(BITS, 1), &m.re, bits)?;
    let other = ComplexBall::new(re, -&m.im);
    let other = if other.im.mid().is_sign_negative() && !other.im.is_zero() {
        stirling(&other.conj(), p)?.conj()
    } else {
        stirling(&ComplexBall::new(other.re, exact(BITS, 0)), p)?
    };
    // 1 − e^{2πiz} = −expm1(−2πy + 2πix), with the angle reduced: e^{2πix} = cospi 2x + i sinpi 2x.
    let pi = Ball::pi(p);
    let fall = real::mul(&m.im.shift(1), &-&pi, p)?;
    let twice = m.re.shift(1);
    let grown = real::expm1(&fall, p)?;
    let half_angle = real::sinpi(&m.re, p)?;
    // e^{t}(cos a) − 1 = expm1(t) cos a − 2 sin²(a/2)
    let cosine = real::cospi(&twice, p)?;
    let re = real::sub(
        &real::mul(&grown, &cosine, p)?,
        &real::sqr(&half_angle, p)?.shift(1),
        p,
    )?;
    let im = real::mul(&real::exp(&fall, p)?, &real::sinpi(&twice, p)?, p)?;
    let inside = log(&-&ComplexBall::new(re, im), p)?;
    // L = inside − ln 2 + iπ(1/2 − z)
    let log_two = Ball::new(
        Float::with_val(p, Constant::Log2),
        Mag::power_of_two(-i64::from(p)),
    );
    let gap = real::sub(&Ball::exact(53, 0.5), &m.re, bits)?;
    let of_sine = ComplexBall::new(
        real::add(
            &real::sub(&inside.re, &log_two, p)?,
            &real::mul(&pi, &m.im, p)?,
            p,
        )?,
        real::add(&inside.im, &real::mul(&pi, &gap, p)?, p)?,
    );
    let log_pi = real::log(&pi, p)?;
    let rest = &of_sine + &other;
    Ok(ComplexBall::new(&log_pi - &rest.re, -rest.im))
}

/// Refuses poles, what is too large, and boxes across the cut.
fn no_pole(z: &ComplexBall, name: &'static str) -> Result<(), NoValue> {
    super::bounded(z)?;
    let m = z.re.mid();
    let on_pole = z.im.is_zero() && z.re.rad().is_zero() && m.is_integer();
    if on_pole && (m.is_sign_negative() || m.is_zero()) {
        return Err(NoValue::Undefined(name));
    }
    Ok(())
}

/// ln Γ at the midpoint, and a bound on the change over the box.
fn log_gamma(z: &ComplexBall, prec: u32) -> Result<(ComplexBall, [Mag; 2]), NoValue> {
    let (m, rho) = clipped(z);
    if z.im.contains_zero() {
        let [low, high] = real::support::ends(&z.re, BITS);
        let last = Float::with_val(BITS, high.min(&Float::new(BITS)).floor_ref());
        if last >= low {
            return Err(NoValue::Undecided("a pole may be in the operand"));
        }
    }
    if m.im.is_zero() && m.re.mid().is_integer() && *m.re.mid() <= 0 {
        return Err(NoValue::Undecided("a pole may be in the operand"));
    }
    let long = |x: &Ball| x.mid().get_exp().unwrap_or(0).clamp(0, REACH) as u32;
    let p = prec + 2 * GUARD + 2 * long(&m.re).max(long(&m.im));
    let value = if m.im.mid().is_sign_negative() {
        log_gamma_above(&m.conj(), p)?.conj()
    } else {
        log_gamma_above(&m, p)?
    };
    if rho.is_zero() {
        return Ok((value, [rho; 2]));
    }
    // The box reaches from the operand to what it was clipped to.
    let reach = |z: &Ball, m: &Ball| match z.mid() == m.mid() {
        true => z.clone(),
        false => m.widened(z.magnitude()),
    };
    let around = ComplexBall::new(reach(&z.re, &m.re), reach(&z.im, &m.im));
    let [re, im] = psi_above(&around)?;
    let (r, s) = (around.re.rad(), around.im.rad());
    let change = [r.mul(re).add(s.mul(im)), r.mul(im).add(s.mul(re))];
    Ok((value, change))
}

/// Bounds on |Re ψ| and |Im ψ| over a box.
fn psi_above(z: &ComplexBall) -> Result<[Mag; 2], NoValue> {
    let right = |z: &ComplexBall| -> Result<[Mag; 2], NoValue> {
        let log = log(z, BITS)?;
        let rest = Mag::power_of_two(0).div(super::below(z));
        Ok([log.re, log.im].map(|x| x.magnitude().add(rest)))
    };
    let [low, high] = real::support::ends(&z.re, BITS);
    let part = |low: &Float, high: &Float| -> ComplexEvaluated {
        Ok(ComplexBall::new(
            real::support::hull(BITS, low, high)?,
            z.im.clone(),
        ))
    };
    // Each side of the imaginary axis by itself, the right one up to 1/2 where it may be.
    let middle = Float::with_val(BITS, 0.5);
    if low >= middle {
        return right(z);
    }
    let edge = if high <= middle {
        high.clone()
    } else {
        Float::new(BITS).max(&low)
    };
    let left = part(&low, &edge)?;
    let other = real::sub(&exact(BITS, 1), &left.re, z.re.prec().max(BITS))?;
    let other = right(&ComplexBall::new(other, z.im.clone()))?;
    let s = real::sinpi(&left.re, BITS)?.mignitude();
    // The double is below π.
    let y = z.im.mignitude().mul_below(Mag::from_f64(PI));
    let sine = real::trigonometric::root_below(s.mul_below(s).add_below(y.mul_below(y)));
    if sine.is_zero() {
        return Err(NoValue::Undecided("a pole may be in the operand"));
    }
    let one = Mag::power_of_two(0);
    let cot = one.add(one.div(sine)).mul(Mag::from_f64(PI.next_up()));
    let left = other.map(|x| x.add(cot));
    if high == edge {
        return Ok(left);
    }
    let right = right(&part(&edge, &high)?)?;
    Ok([left[0].max(right[0]), left[1].max(right[1])])
}

/// ln Γ, analytic but for the cut x ≤ 0 on the real axis and real for x > 0.
pub fn lgamma(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    no_pole(z, "the logarithm of the gamma function at a pole")?;
    if z.im.is_zero() && z.re.is_positive() {
        let re = real::lgamma(&z.re, prec)?;
        return Ok(ComplexBall::new(re, exact(prec, 0)));
    }
    if is_across(z) && real::support::ends(&z.re, BITS)[0] <= 0 {
        return Err(NoValue::Undecided("the operand meets the cut of lgamma"));
    }
    // A part that is clipped to the axis belongs to the side above it.
    if z.im.is_negative() {
        return Ok(lgamma(&z.conj(), prec)?.conj());
    }
    let (value, change) = log_gamma(z, prec)?;
    apart(&value, change, prec)
}

/// Both parts widened by what is theirs.
fn apart(z: &ComplexBall, [re, im]: [Mag; 2], prec: u32) -> ComplexEvaluated {
    rounded(&ComplexBall::new(z.re.widened(re), z.im.widened(im)), prec)
}

/// The gamma function, `e^{ln Γ(z)}`.
pub fn tgamma(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    no_pole(z, "the gamma function at a pole")?;
    if z.im.is_zero() {
        let re = real::tgamma(&z.re, prec)?;
        return Ok(ComplexBall::new(re, exact(prec, 0)));
    }
    let (value, change) = log_gamma(z, prec + GUARD)?;
    exp(&apart(&value, change, prec + GUARD)?, prec)
}

/// `1/Γ(z)`, which has no poles, where no pole of Γ is in the operand.
pub fn inverse_gamma(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    no_pole(z, "the gamma function at a pole")?;
    let (value, change) = log_gamma(z, prec + GUARD)?;
    exp(&-&apart(&value, change, prec + GUARD)?, prec)
}
