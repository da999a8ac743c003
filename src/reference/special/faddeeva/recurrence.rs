//! Taylor coefficients of w by the recurrence of its derivatives.
//!
//! `w' = −2z w + 2i/√π`, `w^{(n+2)} = −2z w^{(n+1)} − 2(n+1) w^{(n)}` (DLMF 7.10.3), so that the
//! coefficients `c_n = w^{(n)}(z)/n!` obey
//!
//! ```text
//! c_1 = −2z c_0 + 2i/√π      c_{n+2} = −(2/(n+2)) (z c_{n+1} + c_n)
//! ```
//!
//! In the upper half-plane c_n is the minimal solution (repeated integrals of erfc) and the
//! recurrence loses digits; it is run in balls, which know how many, at a rising precision.

use super::argument::{Real, length};
use super::scaled::Scaled;
use super::ziv::{cap, first};
use crate::{Ball, ComplexBall, Undecided};
use rug::Rational;

/// One evaluation of w at a precision.
pub(super) type Evaluation = fn(Real, Real, u32) -> Option<[Scaled; 2]>;

/// Bits that the recurrence may lose at each order until a coefficient is undecided.
const LOST: u32 = 64;

/// Orders that count for the precision; the coefficients of more do not fit into memory.
const MOST: usize = 1 << 20;

/// Returns `c_0 … c_n`, with `c_0` of `w`, in ball arithmetic of `prec` bits.
pub(super) fn coefficients(
    w: Evaluation,
    x: &Real,
    y: &Real,
    n: usize,
    prec: u32,
) -> Option<Vec<ComplexBall>> {
    let [re, im] = w(x.clone(), y.clone(), prec)?.map(|part| part.to_ball_or_tiny());
    let z = ComplexBall::new(x.ball(prec), y.ball(prec));
    let mut c = vec![ComplexBall::new(re, im)];
    let two = Ball::integer(prec, 2);
    let slope = &two / &Ball::pi(prec).sqrt();
    let product = (&z * &c[0]).scaled(&-two);
    c.push(ComplexBall::new(product.re, product.im + &slope));
    for k in 2..=n {
        let factor = Ball::rational(prec, &Rational::from((-2, k as i64)));
        let next = (&(&z * &c[k - 1]) + &c[k - 2]).scaled(&factor);
        c.push(next);
    }
    c.truncate(n + 1);
    Some(c)
}

/// Returns the coefficients that [`super::taylor`] describes, with w from this evaluation.
///
/// # Errors
/// See the [module](super).
pub(super) fn taylor(
    w: Evaluation,
    re: &Rational,
    im: &Rational,
    n: usize,
    bits: u32,
) -> Result<Vec<ComplexBall>, Undecided> {
    let (x, y) = (Real::of(re), Real::of(im));
    let order = n.min(MOST) as u32;
    let cap = cap(bits, length(&x, &y).saturating_add(LOST * order));
    let good = |c: &ComplexBall| {
        let r = c.radius();
        r.is_zero() || r <= c.mignitude().shift(-i64::from(bits))
    };
    let open = "a Taylor coefficient of w cannot be told from zero";
    first(bits + 32 + 2 * order, 2, cap, open, |prec| {
        coefficients(w, &x, &y, n, prec).filter(|c| c.iter().all(good))
    })
}
