//! Weierstrass's elliptic function.
//!
//! With the periods 1 and τ, `u = e^{2πiz}` and `q = e^{2πiτ}` (DLMF 23.8.1 and 23.8.5)
//!
//! ```text
//! ℘(z) = −4π² (u/(1 − u)² + 1/12 + Σ_{m≥1} c_m (u^m + u^{−m} − 2))      c_m = m q^m/(1 − q^m)
//! ℘'(z) = −8π³ i (u (1 + u)/(1 − u)³ + Σ_{m≥1} m c_m (u^m − u^{−m}))
//! ```
//!
//! after a reduction to |Im z| ≤ Im τ/2. With s the greatest of |q u| and |q/u| what follows M
//! terms of `m^j c_m (…)`, j = 1 or 2, is at most `4 (M + 1)^j s^{M+1}/((1 − |q|)(1 − t))`, where
//! `t = s ((M + 2)/(M + 1))^j < 1`.

use super::super::support::{BITS, exact};
use super::super::{self as real, ComplexEvaluated, NoValue};
use super::{GUARD, bounded, inner, rounded};
use crate::{Ball, ComplexBall, Mag};
use std::sync::{Arc, Mutex};

/// Terms at most.
const MOST: usize = 1 << 14;

/// `e^{2πiw}`.
fn exponential(w: &ComplexBall, p: u32) -> ComplexEvaluated {
    let fall = real::exp(&real::mul(&w.im.shift(1), &-Ball::pi(p), p)?, p)?;
    let twice = w.re.shift(1);
    let of = |x: &Ball| real::mul(&fall, x, p);
    Ok(ComplexBall::new(
        of(&real::cospi(&twice, p)?)?,
        of(&real::sinpi(&twice, p)?)?,
    ))
}

fn product(a: &ComplexBall, b: &ComplexBall) -> ComplexBall {
    match a.im.is_zero() {
        true => b.scaled(&a.re),
        false => a * b,
    }
}

/// A lattice with its coefficients `c_m`.
struct Lattice {
    tau: ComplexBall,
    bits: u32,
    coefficients: Vec<ComplexBall>,
}

/// The lattice of τ, with that number of coefficients; the last one is kept.
fn lattice(tau: &ComplexBall, terms: usize, p: u32) -> Result<Arc<Lattice>, NoValue> {
    static LAST: Mutex<Option<Arc<Lattice>>> = Mutex::new(None);
    let mut last = LAST.lock().unwrap_or_else(|broken| broken.into_inner());
    let same = |a: &Ball, b: &Ball| a.mid() == b.mid() && a.rad() == b.rad();
    if let Some(known) = last.as_ref().filter(|known| {
        same(&known.tau.re, &tau.re) && same(&known.tau.im, &tau.im) && known.bits == p
    }) && known.coefficients.len() >= terms
    {
        return Ok(Arc::clone(known));
    }
    let q = exponential(tau, p)?;
    let mut power = q.clone();
    let mut coefficients = Vec::new();
    for m in 1..=terms.next_power_of_two().max(16) {
        let less = -&super::plus(&power, -1, p)?;
        let c = super::div(&power, &less, p)?;
        coefficients.push(c.scaled(&Ball::integer(64, m as i64)));
        power = product(&q, &power);
    }
    let found = Arc::new(Lattice {
        tau: tau.clone(),
        bits: p,
        coefficients,
    });
    *last = Some(Arc::clone(&found));
    Ok(found)
}

/// `1 − x` from below.
fn gap(x: Mag) -> Mag {
    Mag::power_of_two(0).sub_below(x)
}

/// The terms after the first M.
fn rest(s: Mag, size: Mag, terms: usize, power: usize) -> Mag {
    let next = Mag::from_f64(terms as f64 + 1.0);
    let quotient = Mag::from_f64(terms as f64 + 2.0).div(next);
    let (mut first, mut t) = (Mag::from_f64(4.0), s);
    for _ in 0..power {
        first = first.mul(next);
        t = t.mul(quotient);
    }
    let fall = (0..=terms).fold(Mag::power_of_two(0), |all, _| all.mul(s));
    first.mul(fall).div(gap(size)).div(gap(t))
}

/// The bracket of ℘ or of ℘'.
fn sum(is_slope: bool, z: &ComplexBall, tau: &ComplexBall, p: u32) -> ComplexEvaluated {
    let size = exponential(tau, BITS)?.magnitude();
    let u = exponential(z, p)?;
    let inverse = super::recip(&u, p)?;
    let s = size.mul(u.magnitude().max(inverse.magnitude()));
    if !(s < Mag::power_of_two(0)) || gap(s).is_zero() {
        return Err(NoValue::Undecided("tau is next to the real axis"));
    }
    // s^M < 2^−p
    let fall = -s.to_f64().log2();
    let wanted = f64::from(p) / fall + 2.0 + (f64::from(p) / fall + 2.0).log2() / fall;
    if !(wanted < MOST as f64) {
        return Err(NoValue::Undecided("tau is next to the real axis"));
    }
    let terms = wanted as usize;
    let power = if is_slope { 2 } else { 1 };
    let lattice = lattice(tau, terms, p)?;
    let less = super::plus(&u, -1, p)?;
    let turned = super::recip(&less, p)?;
    let square = turned.square();
    let mut total = &u * &square;
    if is_slope {
        // (1 + u)/(1 − u) = −(u + 1)/(u − 1)
        total = -&(&(&total * &super::plus(&u, 1, p)?) * &turned);
    } else {
        let twelfth = Ball::integer(p, 12).recip();
        total.re = &total.re + &twelfth;
    }
    let (mut up, mut down) = (u.clone(), inverse.clone());
    for (k, c) in lattice.coefficients[..terms].iter().enumerate() {
        let both = match is_slope {
            true => (&up - &down).scaled(&Ball::integer(64, k as i64 + 1)),
            false => super::plus(&(&up + &down), -2, p)?,
        };
        total = &total + &product(c, &both);
        if k + 1 < terms {
            up = &up * &u;
            down = &down * &inverse;
        }
    }
    Ok(total.widened(rest(s, size, terms, power)))
}

fn value(is_slope: bool, z: &ComplexBall, tau: &ComplexBall, prec: u32) -> ComplexEvaluated {
    bounded(z)?;
    bounded(tau)?;
    if tau.im.is_zero() || tau.im.is_negative() {
        return Err(NoValue::Undefined(
            "a lattice of which tau is not above the real axis",
        ));
    }
    // Reduced to the strip |Im z| ≤ Im τ/2, and |Re z| ≤ 1/2.
    let p = prec + 2 * GUARD;
    let size = |x: &Ball| i64::from(x.mid().get_exp().unwrap_or(0));
    let long = (size(&z.im) - size(&tau.im)).clamp(0, 1 << 13) as u32;
    let n = real::div(&z.im, &tau.im, BITS + long)?
        .mid()
        .clone()
        .round();
    let z = match n.is_zero() {
        true => z.clone(),
        false => z - &tau.scaled(&Ball::new(n, Mag::ZERO)),
    };
    let whole = Ball::new(z.re.mid().clone().round(), Mag::ZERO);
    let bits = z.re.prec() + z.re.mid().get_exp().unwrap_or(0).max(0) as u32 + 64;
    let z = ComplexBall::new(real::sub(&z.re, &whole, bits)?, z.im);
    if z.re.is_zero() && z.im.is_zero() {
        return Err(NoValue::Undefined("an elliptic function at its pole"));
    }
    let found = inner(sum(is_slope, &z, tau, p))?;
    let square = Ball::pi(p).square().shift(2);
    let scaled = match is_slope {
        true => super::turned_back(&found).scaled(&(&square * &Ball::pi(p)).shift(1)),
        false => -&found.scaled(&square),
    };
    // On the axes of a rectangular lattice the values are real.
    let is_rectangular = tau.re.is_zero() && (z.im.is_zero() || z.re.is_zero());
    let scaled = match is_rectangular && !is_slope {
        true => ComplexBall::new(scaled.re, exact(p, 0)),
        false => scaled,
    };
    rounded(&scaled, prec)
}

/// `℘(z)` with the periods 1 and τ, Im τ > 0.
pub fn weierstrassp(z: &ComplexBall, tau: &ComplexBall, prec: u32) -> ComplexEvaluated {
    value(false, z, tau, prec)
}

/// `℘'(z)`, as [`weierstrassp`].
pub fn weierstrasspprime(z: &ComplexBall, tau: &ComplexBall, prec: u32) -> ComplexEvaluated {
    value(true, z, tau, prec)
}

#[cfg(test)]
mod tests;
