//! The gamma function, its logarithm and its logarithmic derivative.
//!
//! # Bounds
//! * Γ(x) ≥ √(2π) x^{x−1/2} e^{−x} for x > 0 (DLMF 5.6.1), so Γ(2^26) is beyond 2^(1.6e9).
//! * `ψ' > 0`; `ψ'(x) ≤ 1/x + 1/x²` for x > 0 (`Σ 1/(x + k)²` with the integral). Elsewhere
//!   `ψ'(x) = π²/sin² πx − ψ'(1 − x)` (DLMF 5.15.6), so it is at most `π²/(4d²)` at a distance
//!   d ≤ 1/2 from the nearest integer, since `|sin πx| ≥ 2d`.
//! * `ln x − 1/x < ψ(x) < ln x` for x > 0 (DLMF 5.11.2 and its remainder). For x < 0
//!   `ψ(x) = ψ(1 − x) − π cot πx` (DLMF 5.5.4) and `|π cot πx| ≤ 1/d`.

use super::arithmetic::above_rounded;
use super::exponential::expm1_above;
use super::support::{
    BITS, NARROW, WIDE, directed, ends, exact, finish, hull, increasing, is_narrow, nearest,
    one_more,
};
use super::{Evaluated, NoValue};
use crate::{Ball, Mag};
use rug::Float;
use rug::float::Round;
use rug::ops::AssignRound;
use std::cmp::Ordering;

/// Γ of this and beyond is more than MPFR holds.
const OVERFLOW: u32 = 1 << 26;

/// Where Γ has its minimum on x > 0: 1.46163214496…
const TURN: [f64; 2] = [1.46163214, 1.46163215];
/// Just below Γ there, 0.88560319441…
const LEAST: f64 = 0.885603194;
/// Just below ln Γ there, −0.12148629053…
const LEAST_LOG: f64 = -0.121486291;

/// Bits beyond those of the result.
const GUARD: u32 = 16;

/// Beyond this exponent a negative number is reflected.
const FAR: i32 = 64;

/// A lower bound on the distance of all points of the ball from the poles 0, −1, −2, …; an upper
/// bound on |ψ'| over the ball is its second part.
fn away(x: &Ball, name: &'static str) -> Result<(Mag, Mag), NoValue> {
    let m = x.mid();
    if x.is_positive() {
        let l = x.mignitude();
        let inverse = Mag::power_of_two(0).div(l);
        return Ok((l, inverse.add(inverse.mul(inverse))));
    }
    if x.rad().is_zero() && m.is_integer() {
        return Err(NoValue::Undefined(name));
    }
    if m.is_sign_positive() || !x.is_finite() {
        return Err(NoValue::Undecided("a pole may be in the operand"));
    }
    let whole = Float::with_val(m.prec(), m.round_ref());
    let gap = Float::with_val_round(BITS, m - &whole, Round::Zero).0;
    let d = Mag::below(&gap).sub_below(x.rad());
    if d.is_zero() {
        return Err(NoValue::Undecided("a pole may be in the operand"));
    }
    // π²/4 < 2.468
    let curve = Mag::from_f64(2.468).div(d.mul_below(d));
    Ok((d, curve))
}

/// An upper bound on `|ψ|` over a ball at the distance `d` from the poles.
fn psi_above(x: &Ball, d: Mag, curve: Mag) -> Mag {
    let m = x.mid();
    let e = m.get_exp().unwrap_or(0);
    if e <= FAR {
        let at = nearest(BITS, m.digamma_ref());
        return above_rounded(&at).add(x.rad().mul(curve));
    }
    // ln(1 + |x|) ≤ (e + 1) ln 2 for |m| < 2^e, which the ball exceeds by less than half.
    let log = Mag::from_f64(f64::from(e) + 2.0).mul(Mag::from_f64(0.6932));
    if m.is_sign_positive() {
        log
    } else {
        log.add(Mag::power_of_two(0).div(d))
            .add(Mag::power_of_two(0))
    }
}

/// The ends of a ball right of zero, where Γ has its minimum between them; they are in order of the
/// values otherwise.
enum Piece {
    Falls,
    Turns,
    Rises,
}

fn piece([low, high]: &[Float; 2]) -> Piece {
    if *high < TURN[0] {
        Piece::Falls
    } else if *low > TURN[1] {
        Piece::Rises
    } else {
        Piece::Turns
    }
}

/// The hull over a ball right of zero of a function that falls to its minimum at [`TURN`] and
/// rises.
fn over(
    both: &[Float; 2],
    least: f64,
    prec: u32,
    f: impl Fn(&Float, u32, Round) -> Float,
) -> Evaluated {
    match piece(both) {
        Piece::Falls => super::support::decreasing(f, both, prec),
        Piece::Rises => increasing(f, both, prec),
        Piece::Turns => {
            let ends = [0, 1].map(|i| f(&both[i], prec + 8, Round::Up));
            let [a, b] = ends;
            let high = if a > b { a } else { b };
            hull(prec, &Float::with_val(BITS, least), &high)
        }
    }
}

/// The gamma function.
///
/// `|ln |Γ(x)/Γ(m)|| ≤ δ = r sup |ψ|`, so the radius is `|Γ(m)| (δ + δ²)` for δ ≤ 1.
pub fn tgamma(x: &Ball, prec: u32) -> Evaluated {
    let (d, curve) = away(x, "the gamma function at a pole")?;
    let m = x.mid();
    if m.is_sign_negative() && *m < -f64::from(OVERFLOW) {
        // |Γ(x)| = π/(|sin πx| Γ(1 − x)), Γ(1 − x) ≥ 2^(2^30); the ball lies between two integers.
        let size = Mag::power_of_two(-(1 << 30))
            .mul(Mag::from_f64(std::f64::consts::FRAC_PI_2.next_up()))
            .div(d);
        return Ok(Ball::new(Float::new(prec), size));
    }
    if x.rad().is_zero() {
        if *m >= OVERFLOW {
            return Err(NoValue::Overflow { negative: false });
        }
        return finish(nearest(prec, m.gamma_ref()), Mag::ZERO);
    }
    let small = if m.is_sign_negative() {
        Mag::power_of_two(0)
    } else {
        Mag::power_of_two(NARROW)
    };
    if (m.is_sign_negative() || is_narrow(x.rad(), d)) && *m < OVERFLOW {
        let delta = psi_above(x, d, curve).mul(x.rad());
        if delta <= small {
            let value = nearest(prec, m.gamma_ref());
            if value.0.is_finite() {
                let size = above_rounded(&value);
                return finish(value, size.mul(expm1_above(delta)));
            }
        }
    }
    if m.is_sign_negative() {
        return Err(WIDE);
    }
    let both = ends(x, prec);
    if both[0] >= OVERFLOW {
        return Err(NoValue::Overflow { negative: false });
    }
    if both[1] >= OVERFLOW || both[0] <= 0 {
        return Err(WIDE);
    }
    over(&both, LEAST, prec, directed!(gamma_ref))
}

/// `ln Γ` at a float right of zero.
fn log_gamma_at(x: &Float, prec: u32) -> Evaluated {
    let e = x.get_exp().unwrap_or(0);
    if i64::from(e) <= i64::from(prec) + i64::from(FAR) {
        return finish(nearest(prec, x.ln_gamma_ref()), Mag::ZERO);
    }
    // (x − 1/2) ln x − x + ln(2π)/2 + θ/(12x), 0 < θ < 1 (DLMF 5.11.1 and 5.11(ii)); the two terms
    // in the middle are between 0 and 1, those with ln x between 0 and ln x.
    let p = prec + GUARD;
    let x = Ball::new(x.clone(), Mag::ZERO);
    let log = super::log(&x, p)?;
    let lead = super::mul(&x, &super::sub(&log, &exact(p, 1), p)?, prec)?;
    super::error::widened(lead, one_more(log.magnitude()))
}

/// `ln |Γ|` at a float left of zero that is no integer.
fn log_abs_gamma_at(x: &Float, d: Mag, prec: u32) -> Evaluated {
    if x.get_exp().unwrap_or(0) <= FAR {
        let mut value = Float::new(prec);
        let mut sign = Ordering::Equal;
        let rounding = Round::Nearest;
        let found = (&mut value, &mut sign).assign_round(x.ln_abs_gamma_ref(), rounding);
        return finish((value, found), Mag::ZERO);
    }
    // ln |Γ(x)| = ln π − ln |sin πx| − ln Γ(1 − x), with 0 ≤ −ln |sin πx| ≤ ln(1/d).
    let bits = x.prec() + 2;
    let other = Float::with_val(bits, 1 - x);
    let lead = log_gamma_at(&other, prec)?;
    let rest = Ball::new(Float::with_val(53, d.to_float()), Mag::ZERO);
    let rest = super::log(&rest, BITS)?
        .magnitude()
        .add(Mag::power_of_two(1));
    super::error::widened(-lead, rest)
}

/// `ln |Γ(x)|`; radius `r sup |ψ|`.
pub fn lgamma(x: &Ball, prec: u32) -> Evaluated {
    let (d, curve) = away(x, "the logarithm of the gamma function at a pole")?;
    let m = x.mid();
    if m.is_sign_negative() {
        let value = log_abs_gamma_at(m, d, prec)?;
        if x.rad().is_zero() {
            return Ok(value);
        }
        return super::error::widened(value, psi_above(x, d, curve).mul(x.rad()));
    }
    if x.rad().is_zero() {
        return log_gamma_at(m, prec);
    }
    if is_narrow(x.rad(), d) {
        let propagated = psi_above(x, d, curve).mul(x.rad());
        return super::error::widened(log_gamma_at(m, prec)?, propagated);
    }
    let both = ends(x, prec);
    if both[0] <= 0 || !both[1].is_finite() {
        return Err(WIDE);
    }
    over(&both, LEAST_LOG, prec, |x, prec, round| {
        match (log_gamma_at(x, prec), round) {
            (Ok(ball), Round::Down) => ends(&ball, prec)[0].clone(),
            (Ok(ball), _) => ends(&ball, prec)[1].clone(),
            (Err(_), _) => Float::with_val(prec, f64::INFINITY),
        }
    })
}

/// ψ at a float that is no pole.
fn psi_at(x: &Float, prec: u32) -> Evaluated {
    let e = x.get_exp().unwrap_or(0);
    let far = i64::from(e) > i64::from(prec) + i64::from(FAR);
    if x.is_sign_positive() && far {
        // ψ(x) = ln x − θ/x
        return finish(
            nearest(prec, x.ln_ref()),
            Mag::power_of_two(1 - i64::from(e)),
        );
    }
    if x.is_sign_negative() && e > FAR {
        // ψ(x) = ψ(1 − x) − π cot πx
        let other = Float::with_val(x.prec() + 2, 1 - x);
        let p = prec + GUARD;
        let lead = psi_at(&other, p)?;
        let x = Ball::new(x.clone(), Mag::ZERO);
        let turn = super::div(&super::cospi(&x, p)?, &super::sinpi(&x, p)?, p)?;
        return super::sub(&lead, &super::mul(&turn, &Ball::pi(p), p)?, prec);
    }
    finish(nearest(prec, x.digamma_ref()), Mag::ZERO)
}

/// `ψ = Γ'/Γ`. It increases between two poles; radius `r sup ψ'`.
pub fn digamma(x: &Ball, prec: u32) -> Evaluated {
    let (d, curve) = away(x, "the digamma function at a pole")?;
    let m = x.mid();
    if x.rad().is_zero() {
        return psi_at(m, prec);
    }
    if is_narrow(x.rad(), d) {
        return super::error::widened(psi_at(m, prec)?, curve.mul(x.rad()));
    }
    let [low, high] = ends(x, prec);
    let floor = |x: &Float| Float::with_val(x.prec(), x.floor_ref());
    let apart = low > 0 || (floor(&low) == floor(&high) && !low.is_integer() && !high.is_integer());
    if !apart || !high.is_finite() {
        return Err(WIDE);
    }
    let low = psi_at(&low, prec + GUARD);
    let high = psi_at(&high, prec + GUARD);
    super::arithmetic::between_values(low, high, prec)
}
