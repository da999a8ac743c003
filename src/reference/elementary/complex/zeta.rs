//! Riemann's zeta function and its derivatives.
//!
//! # Euler and Maclaurin
//! ```text
//! ζ(s) = Σ_{k<N} k^{−s} + N^{1−s}/(s − 1) + N^{−s}/2 + Σ_{k≤M} T_k(s) + R(s)
//! T_k = B_2k/(2k)! (s)_{2k−1} N^{1−2k−s}
//! |R(s)| ≤ 4 |(s)_{2M}|/(2π)^{2M} N^{1−2M−σ}/(σ + 2M − 1)      for σ + 2M > 1
//! ```
//!
//! (F. Johansson, *Numer. Algorithms* 69 (2015) 253–270, Theorem 1 and its proof with a = 1). Power
//! series in x about s give the derivatives; R is analytic, so that on the disc |x| ≤ 1 its
//! coefficients are at most the greatest |R(s + x)|, by Cauchy's inequality.
//!
//! # Left of zero
//! ```text
//! ζ(s) = F sin(πs/2) ζ(1 − s),  F = 2 (2π)^{s−1} Γ(1 − s)
//! ζ'(s) = F ((π/2) cos(πs/2) ζ(1 − s) + sin(πs/2) ((ln 2π − ψ(1 − s)) ζ(1 − s) − ζ'(1 − s)))
//! ```
//!
//! (DLMF 25.4.2 and its derivative), the latter for real s.
//!
//! # Radii
//! All of it is evaluated in balls. Where that is wider, the midpoint is, and the next derivative
//! in balls of 64 bits bounds the change. For σ ≥ p + 2 `|ζ(s) − 1| ≤ 2^{−σ} (1 + 2/(σ − 1))`, and
//! the n-th derivative of the rest, n > 0, is as much on the disc of radius 1, times n!.

use super::super::support::{BITS, WIDE, exact};
use super::super::{self as real, ComplexEvaluated, NoValue};
use super::{GUARD, Kept, bounded, middle, rounded, widened};
use crate::{Ball, ComplexBall, Mag};
use rug::{Float, Rational};
use std::f64::consts::{LN_2, PI};
use std::sync::Arc;

/// Derivatives up to this order.
const HIGHEST: usize = 64;

/// A power series, truncated.
type Series = Vec<ComplexBall>;

fn product(a: &Series, b: &Series) -> Series {
    let of = |k: usize| {
        let mut sum = &a[0] * &b[k];
        for j in 1..=k {
            sum = &sum + &(&a[j] * &b[k - j]);
        }
        sum
    };
    (0..a.len()).map(of).collect()
}

/// `a (c + x)`.
fn times_linear(a: &Series, c: &ComplexBall) -> Series {
    let of = |k: usize| match k {
        0 => &a[0] * c,
        k => &(&a[k] * c) + &a[k - 1],
    };
    (0..a.len()).map(of).collect()
}

/// `ln k` for k < n, at a precision.
fn logarithms(n: usize, p: u32) -> Result<Arc<Vec<Ball>>, NoValue> {
    static KNOWN: Kept<Vec<Ball>> = Kept::new();
    KNOWN.get(
        p,
        |all| all.len() >= n,
        |p| {
            let log = |k: usize| Ball::integer(p, (k as i64).max(1)).ln();
            Ok((0..n.next_power_of_two()).map(log).collect())
        },
    )
}

/// `N^{−s}` from its logarithm.
fn fall(log: &Ball, s: &ComplexBall, p: u32) -> ComplexEvaluated {
    super::exp(&-&s.scaled(log), p)
}

/// The derivatives of `Σ_{k<n} k^{−s}` over factorials: powers of composite numbers are products.
fn head(s: &ComplexBall, n: usize, terms: usize, p: u32) -> Result<Series, NoValue> {
    let logs = logarithms(n, p)?;
    let mut factor = vec![0_usize; n];
    let mut powers: Vec<Option<ComplexBall>> = vec![None; n];
    let mut sum = vec![ComplexBall::zero(p); terms];
    for k in 1..n {
        let power = match factor[k] {
            _ if k == 1 => ComplexBall::new(exact(p, 1), exact(p, 0)),
            0 => {
                for multiple in (k * k..n).step_by(k) {
                    factor[multiple] = k;
                }
                fall(&logs[k], s, p)?
            }
            f => match (&powers[f], &powers[k / f]) {
                (Some(a), Some(b)) => a * b,
                _ => return Err(WIDE),
            },
        };
        let mut term = power.clone();
        for (j, sum) in sum.iter_mut().enumerate() {
            if j > 0 {
                term = term.scaled(&-&logs[k]);
                term = term.scaled(&Ball::integer(p, j as i64).recip());
            }
            *sum = &*sum + &term;
        }
        if 2 * k < n {
            powers[k] = Some(power);
        }
    }
    Ok(sum)
}

/// Numbers N and M for an error of about `2^−p`, none beyond what is sensible.
fn parameters(s: &ComplexBall, p: u32) -> Option<[usize; 2]> {
    let (sigma, t) = (s.re.mid().to_f64(), s.im.magnitude().to_f64());
    let wanted = f64::from(p) * LN_2 + 4.0;
    // The rest falls like (|s + 2M|/(2πN))^{2M}, and a term of T costs about three of the sum.
    let of = |m: f64| {
        let size = (sigma + 2.0 * m).hypot(t);
        size / (2.0 * PI) * ((wanted + (size + 1.0).ln()) / (2.0 * m)).exp() + 2.0
    };
    let least = ((1.0 - sigma) / 2.0 + 2.0).max(2.0).ceil();
    let all = (0..48).map(|k| (least * 1.2_f64.powi(k)).ceil());
    let cost = |m: &f64| of(*m) + 3.0 * m;
    let m = all.min_by(|a, b| cost(a).total_cmp(&cost(b)))?;
    let n = of(m);
    (n < 50_000.0 && m < 10_000.0).then_some([n as usize, m as usize])
}

/// `B_2k/(2k)!` for k = 1 … n.
fn bernoulli(n: usize, p: u32) -> Result<Arc<Vec<Ball>>, NoValue> {
    static KNOWN: Kept<Vec<Ball>> = Kept::new();
    KNOWN.get(
        p,
        |all| all.len() >= n,
        |p| {
            // The coefficients of Stirling's series are B_2k/(2k (2k − 1)).
            let mut factorial = Ball::integer(p, 1);
            let of = |(i, c): (usize, &Rational)| {
                let k = i as i64 + 1;
                // (2k − 2)!
                if k > 1 {
                    factorial = &factorial * &Ball::integer(64, (2 * k - 3) * (2 * k - 2));
                }
                &Ball::rational(p, c) / &factorial
            };
            let all = super::gamma::coefficients(n);
            Ok(all.iter().enumerate().map(of).collect())
        },
    )
}

/// The first derivatives of ζ over factorials, in balls, from N and M.
fn jet(s: &ComplexBall, terms: usize, [n, m]: [usize; 2], p: u32) -> Result<Series, NoValue> {
    let mut sum = head(s, n, terms, p)?;
    let one = ComplexBall::new(exact(p, 1), exact(p, 0));
    let log = Ball::integer(p, n as i64).ln();
    // N^{−s−x}
    let mut power = vec![fall(&log, s, p)?];
    for j in 1..terms {
        let next = power[j - 1].scaled(&-&log);
        power.push(next.scaled(&Ball::integer(p, j as i64).recip()));
    }
    // 1/(s − 1 + x)
    let below = super::plus(s, -1, p)?;
    let mut inverse = vec![super::recip(&below, p)?];
    for j in 1..terms {
        inverse.push(-&(&inverse[j - 1] * &inverse[0]));
    }
    let whole = Ball::integer(p, n as i64);
    let pole = product(&power, &inverse);
    // B_2k/(2k)! (s + x)_{2k−1} N^{1−2k}
    let mut rising = vec![ComplexBall::zero(p); terms];
    rising[0] = one;
    let start = rising.clone();
    rising = times_linear(&start, s);
    let per = whole.square().recip();
    let first = whole.recip();
    rising = rising.iter().map(|c| c.scaled(&first)).collect();
    let mut tail = vec![ComplexBall::zero(p); terms];
    for (k, b) in bernoulli(m, p)?[..m].iter().enumerate() {
        for (sum, c) in tail.iter_mut().zip(&rising) {
            *sum = &*sum + &c.scaled(b);
        }
        for j in [2 * k + 1, 2 * k + 2] {
            rising = times_linear(&rising, &super::plus(s, j as i32, p)?);
        }
        rising = rising.iter().map(|c| c.scaled(&per)).collect();
    }
    tail[0].re = &tail[0].re + &Ball::exact(p, 0.5);
    let tail = product(&power, &tail);
    let rest = remainder(s, n, m, if terms > 1 { 1 } else { 0 })?;
    for (j, sum) in sum.iter_mut().enumerate() {
        let all = &(&*sum + &pole[j].scaled(&whole)) + &tail[j];
        *sum = all.widened(rest);
    }
    Ok(sum)
}

/// A bound on |R| over all numbers that are at most r away from the box.
fn remainder(s: &ComplexBall, n: usize, m: usize, r: i32) -> Result<Mag, NoValue> {
    let wide = s.widened(Mag::from_f64(f64::from(r)));
    let low = real::support::ends(&wide.re, BITS)[0].clone();
    let sigma = Ball::new(low, Mag::ZERO);
    let above = real::add(&sigma, &exact(BITS, 2 * m as i32 - 1), BITS)?;
    if !above.is_positive() {
        return Err(WIDE);
    }
    let mut size = Mag::from_f64(4.0);
    let turn = Mag::from_f64(2.0 * PI);
    for j in 0..2 * m {
        // The double is below 2π.
        let factor = super::plus(&wide, j as i32, BITS)?.magnitude();
        size = size.mul(factor.div(turn));
    }
    let log = Ball::integer(BITS, n as i64).ln();
    let power = real::exp(&-&real::mul(&above, &log, BITS)?, BITS)?;
    Ok(size.mul(power.magnitude()).div(above.mignitude()))
}

/// The n-th derivative in balls.
fn direct(order: usize, s: &ComplexBall, p: u32) -> ComplexEvaluated {
    if is_reflected(order, s) {
        return reflected(order, s, p);
    }
    let mut factorial = Ball::integer(p, 1);
    for j in 1..=order as i64 {
        factorial = factorial * Ball::integer(p, j);
    }
    // Far to the right.
    let low = real::support::ends(&s.re, BITS)[0].clone();
    if low >= p + 4 {
        // On the disc of radius 1 it is twice as much.
        let rest = real::exp2(&Ball::new(-low, Mag::ZERO), BITS)?.magnitude();
        let rest = rest.shift(2).mul(factorial.magnitude());
        let one = exact(p, if order > 0 { 0 } else { 1 });
        return Ok(ComplexBall::new(one, exact(p, 0)).widened(rest));
    }
    let Some(numbers) = parameters(s, p) else {
        return Err(NoValue::Undecided(
            "zeta far from the real axis or left of zero",
        ));
    };
    let all = jet(s, order + 1, numbers, p)?;
    Ok(all[order].scaled(&factorial))
}

/// Left of this number the sums have large terms, and the function is reflected.
const REFLECTED: i32 = -8;

/// Returns true for the derivatives that are known by values right of one.
fn is_reflected(order: usize, s: &ComplexBall) -> bool {
    let is_left = real::support::ends(&s.re, BITS)[1] < REFLECTED;
    is_left && (order == 0 || order == 1 && s.im.is_zero())
}

/// The function or its derivative by its values right of one.
fn reflected(order: usize, s: &ComplexBall, p: u32) -> ComplexEvaluated {
    let other = super::plus(&-s, 1, s.re.prec().max(p))?;
    let turn = Ball::pi(p).shift(1);
    let log = real::log(&turn, p)?;
    let power = super::exp(&-&other.scaled(&log), p)?;
    let factor = &power.scaled(&exact(p, 2)) * &super::tgamma(&other, p)?;
    let angle = s.scaled(&turn.shift(-2));
    let sine = super::sin(&angle, p)?;
    let value = direct(0, &other, p)?;
    if order == 0 {
        return Ok(&(&factor * &sine) * &value);
    }
    let psi = real::digamma(&other.re, p)?;
    let rate = value.scaled(&real::sub(&log, &psi, p)?);
    let along = &sine * &(&rate - &direct(1, &other, p)?);
    let across = &super::cos(&angle, p)?.scaled(&turn.shift(-2)) * &value;
    Ok(&factor * &(&along + &across))
}

/// Numbers left of zero up to this size have values.
const FARTHEST: f64 = 1e6;

/// Numbers left of zero up to this size have values by sums.
const FARTHEST_SUM: f64 = 100.0;

fn value(order: usize, s: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(s)?;
    let is_real = s.im.is_zero();
    if is_real && s.re.rad().is_zero() && *s.re.mid() == 1 {
        return Err(NoValue::Undefined("zeta at its pole"));
    }
    // The zeros at −2, −4, … are rational points, where no precision tells them from small values.
    let half = Float::with_val(s.re.mid().prec(), s.re.mid() / 2u32);
    if order == 0 && is_real && s.re.rad().is_zero() && half < 0 && half.is_integer() {
        return Ok(ComplexBall::new(exact(prec, 0), exact(prec, 0)));
    }
    let off = super::plus(s, -1, BITS)?;
    if super::below(&off).is_zero() {
        return Err(NoValue::Undecided("the pole of zeta may be in the operand"));
    }
    // A phase t ln N is reduced.
    let left = (-s.re.mid().to_f64()).max(0.0);
    let t = s.im.magnitude().to_f64();
    let is_near = left <= FARTHEST_SUM;
    let farthest = if is_reflected(order, s) {
        FARTHEST
    } else {
        FARTHEST_SUM
    };
    if left > farthest || t > 2e5 {
        return Err(NoValue::Undecided(
            "zeta far from the real axis or left of zero",
        ));
    }
    // The terms of the sum are large left of zero.
    let size = left + t + 10.0;
    let large = if is_reflected(order + 1, s) {
        2.0
    } else {
        left.min(FARTHEST_SUM) * 1.5
    };
    let more = 2 * GUARD + (large * size.log2() + size.log2()) as u32;
    let p = prec + more;
    let whole = |z: ComplexBall| match is_real {
        true => ComplexBall::new(z.re, exact(prec, 0)),
        false => z,
    };
    let rho = s.radius();
    if rho.is_zero() {
        return rounded(&whole(direct(order, s, p)?), prec);
    }
    // Few bits are needed of what is not known to more.
    let known = u32::try_from(-rho.exponent().unwrap_or(0))
        .unwrap_or(4)
        .max(4);
    let p = p.min(known.saturating_add(more + 16));
    if rho > Mag::power_of_two(-12) || !(is_near || is_reflected(order + 1, s)) {
        return rounded(&whole(direct(order, s, p)?), prec);
    }
    let slope = direct(order + 1, s, BITS + more)?.magnitude();
    let value = direct(order, &middle(s), p)?;
    widened(&whole(value), slope.mul(rho), prec).map(whole)
}

/// Riemann's zeta function.
pub fn zeta(s: &ComplexBall, prec: u32) -> ComplexEvaluated {
    value(0, s, prec)
}

/// The n-th derivative of the zeta function; n is an exact integer from 0 to 64.
pub fn zetaderivative(n: &Ball, s: &ComplexBall, prec: u32) -> ComplexEvaluated {
    let whole = n.mid().to_integer().and_then(|k| k.to_usize());
    let order = whole.filter(|k| n.rad().is_zero() && *n.mid() == *k && *k < HIGHEST);
    match order {
        Some(order) => value(order, s, prec),
        None => Err(NoValue::Undecided(
            "an order that is no integer from 0 to 63",
        )),
    }
}

#[cfg(test)]
mod tests;
