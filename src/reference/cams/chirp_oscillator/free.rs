//! Free vibration in balls.
//!
//! With `K` the impulse response and `x = (n² − w²) t²`:
//!
//! ```text
//! K = t e^{−nt} S(x),  K′ = e^{−nt} (C(x) − n t S(x)),   S(x) = sinh(√x)/√x,  C(x) = cosh √x
//! ```
//!
//! both entire in `x`: near critical damping they are summed as series.

use super::problem::Problem;
use crate::{Ball, Mag};
use rug::Rational;
use std::cmp::Ordering;

/// `[y, y′, y″]` of the free vibration from `y₀, v₀`: `y₀ (K′ + 2nK) + v₀ K`, its derivative
/// `−w² y₀ K + v₀ K′`, and `−2n y′ − w² y`.
pub(super) fn vibration(p: &Problem, prec: u32) -> [Ball; 3] {
    if p.y0 == 0 && p.v0 == 0 {
        return [(); 3].map(|()| Ball::integer(prec, 0));
    }
    let real = |q: &Rational| Ball::rational(prec, q);
    let (k, rate) = impulse(p, &p.t, prec);
    let (y0, v0) = (real(&p.y0), real(&p.v0));
    let twice = real(&Rational::from(&p.n * 2));
    let stiffness = real(&Rational::from(p.w.square_ref()));
    let y = &y0 * (&rate + &twice * &k) + &v0 * &k;
    let v = &v0 * &rate - &stiffness * &y0 * &k;
    let a = -(&stiffness * &y + &twice * &v);
    [y, v, a]
}

/// `(K, K′)` at time `t`.
pub(super) fn impulse(p: &Problem, t: &Rational, prec: u32) -> (Ball, Ball) {
    let real = |q: &Rational| Ball::rational(prec, q);
    let x = p.square() * Rational::from(t.square_ref());
    let decay = Rational::from(&p.n * t);
    if Rational::from(x.abs_ref()) < 1 {
        let e = real(&Rational::from(-&decay)).exp();
        let (c, s) = series(&x, prec);
        let rate = c - real(&decay) * &s;
        return (&e * &s * real(t), e * rate);
    }
    let root = real(&Rational::from(p.square().abs_ref())).sqrt();
    let angle = &root * real(t);
    if x.cmp0() == Ordering::Less {
        let e = real(&Rational::from(-&decay)).exp();
        let (sin, cos) = angle.sin_cos();
        let k = sin / &root;
        let rate = cos - real(&p.n) * &k;
        return (&e * k, e * rate);
    }
    // Overdamped: e^{λ₊t}, e^{λ₋t} with λ₊ = −w²/(n + μ), so that neither overflows.
    let fast = real(&p.n) + &root;
    let slow = real(&Rational::from(p.w.square_ref())) / &fast;
    let t = real(t);
    let (a, b) = ((-(&slow * &t)).exp(), (-(&fast * &t)).exp());
    let gap = root.shift(1);
    let k = (&a - &b) / &gap;
    let rate = (&fast * &b - &slow * &a) / &gap;
    (k, rate)
}

/// `(C, S)` at `|x| < 1`: terms `x^j/(2j)!` and `x^j/(2j + 1)!`, at most a half of the one before,
/// so that the rest is below the last term kept.
fn series(x: &Rational, prec: u32) -> (Ball, Ball) {
    let x = Ball::rational(prec, x);
    let mut term = Ball::integer(prec, 1);
    let (mut c, mut s) = (Ball::integer(prec, 0), Ball::integer(prec, 0));
    let small = Mag::power_of_two(-i64::from(prec) - 4);
    let mut j = 0;
    loop {
        // term = x^j/(2j)!
        c = c + &term;
        let odd = &term / Ball::integer(prec, 2 * j + 1);
        s = s + &odd;
        let size = term.magnitude();
        if j > 0 && (size <= small || size.is_zero()) {
            return (c.widened(size), s.widened(size));
        }
        j += 1;
        term = &term * &x / Ball::integer(prec, 2 * j * (2 * j - 1));
    }
}
