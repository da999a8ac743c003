//! The stored constants of the series, and what they stand for.
//!
//! A formula whose constants are replaced by the numbers they stand for is, in exact arithmetic,
//! the truncated series itself; the differences are errors of the operands.

use crate::interval::Interval;
use crate::tracked::Constant;
use mechaudit_reference::Ball;
use rug::Rational;
use rug::float::Round;
use std::sync::LazyLock;

const BITS: u32 = 300;

/// An interval that holds the ball.
fn around(ball: &Ball) -> Interval {
    Interval::new(
        ball.lower().to_f64_round(Round::Down),
        ball.upper().to_f64_round(Round::Up),
    )
}

/// `stored`, which stands for `exact`; left out where it is the same.
fn constant(stored: f64, exact: &Ball) -> Option<Constant> {
    let error = around(&(&Ball::exact(BITS, stored) - exact));
    let exact = around(exact);
    (!error.is_zero()).then_some(Constant {
        stored,
        exact,
        error,
    })
}

/// The low part of a number stored in two: it stands for zero, so that all of it is an error; that
/// of the high part takes it back.
fn low_part(stored: f64) -> Option<Constant> {
    constant(stored, &Ball::integer(BITS, 0))
}

fn inverse_sqrt_pi() -> Ball {
    Ball::pi(BITS).sqrt().recip()
}

/// Those of the asymptotic series.
pub(crate) static ASYMPTOTIC: LazyLock<Vec<Constant>> = LazyLock::new(|| {
    let mut all = vec![
        constant(0.564_189_583_547_756_3, &inverse_sqrt_pi()),
        low_part(7.667_729_806_582_94e-18),
        constant(1.772_453_850_905_516, &Ball::pi(BITS).sqrt()),
        constant(std::f64::consts::PI, &Ball::pi(BITS)),
    ];
    // a_n = (2n − 1)!!/2ⁿ, as the code rounds them one after the other.
    let (mut stored, mut exact) = (1.0f64, Rational::from(1));
    for n in 1..27 {
        stored *= f64::from(n) - 0.5;
        exact *= Rational::from((2 * n - 1, 2));
        all.push(constant(stored, &Ball::rational(BITS, &exact)));
    }
    all.into_iter().flatten().collect()
});

/// That of the values around zeros, 2/√π.
pub(crate) static TWO_OVER_SQRT_PI: LazyLock<Vec<Constant>> = LazyLock::new(|| {
    let exact = &inverse_sqrt_pi() * &Ball::integer(BITS, 2);
    let all = [
        constant(std::f64::consts::FRAC_2_SQRT_PI, &exact),
        low_part(1.533_545_961_316_588e-17),
    ];
    all.into_iter().flatten().collect()
});

/// Those of the Maclaurin series.
pub(crate) static MACLAURIN: LazyLock<Vec<Constant>> = LazyLock::new(|| {
    const STORED: f64 = 0.564_189_583_547_756_3;
    let root = inverse_sqrt_pi();
    let times = |p: i64, q: i64| &root * &Ball::rational(BITS, &Rational::from((p, q)));
    let mut all = vec![
        constant(-2.0 * STORED, &times(-2, 1)),
        constant(-4.0 / 3.0 * STORED, &times(-4, 3)),
        constant(-8.0 / 15.0 * STORED, &times(-8, 15)),
        constant(-16.0 / 105.0 * STORED, &times(-16, 105)),
        low_part(-2.0 * 7.667_729_806_582_94e-18),
    ];
    let (mut stored, mut exact) = (1.0f64, Rational::from(1));
    for m in 2..=10 {
        stored *= f64::from(m);
        exact *= Rational::from(m);
        let inverse = Ball::rational(BITS, &exact.clone().recip());
        all.push(constant(1.0 / stored, &inverse));
    }
    // −1/Γ(m + 3/2) = −2^{m+1}/(1·3·5⋯(2m + 1) √π).
    let (mut power, mut product) = (2.0f64, 1.0f64);
    for m in 1..=9i64 {
        power *= 2.0;
        product *= (2 * m + 1) as f64;
        let exact = times(-(power as i64), product as i64);
        all.push(constant(-(power / product * STORED), &exact));
    }
    let mut all: Vec<Constant> = all.into_iter().flatten().collect();
    // One entry for each number.
    all.sort_by(|a, b| a.stored.abs().total_cmp(&b.stored.abs()));
    all.dedup_by(|a, b| a.stored.abs() == b.stored.abs());
    all
});

#[cfg(test)]
mod tests;
