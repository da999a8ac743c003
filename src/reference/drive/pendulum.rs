//! Pendulums that turn over: angle, time and period, enclosed.
//!
//! With φ = 2ψ from the upper position, and the speeds p there and q at the bottom,
//!
//! ```text
//! φ'² = p² cos² ψ + q² sin² ψ,    t/2 = I(p, q; ψ) = ∫_0^ψ dψ/√(p² cos² ψ + q² sin² ψ).
//! ```
//!
//! Gauss's transformation `a' = (a + b)/2`, `b' = √(ab)`, `ψ' = ψ + δ` with `tan δ = (b/a) tan ψ`,
//! δ and ψ in the same quarter of a turn, doubles the integral: `I(a', b'; ψ') = 2 I(a, b; ψ)`
//! (Abramowitz and Stegun, 17.5.1 and 16.4.3).
//!
//! 1. Both ways are free of branches. Forward, `ψ' = 2ψ + arctan((b − a) sin ψ cos ψ/(a cos² ψ + b
//!    sin² ψ))`, whose denominator is positive; backward, `2ψ = ψ' + arcsin(((a − b)/(a + b)) sin
//!    ψ')`, since ψ − δ is less than a quarter of a turn.
//! 2. From the first mean on b ≤ a, and the integrand lies between 1/a and 1/b, so `I(a, b; ψ)`
//!    lies between ψ/a and ψ/b and both means between b and a. That encloses; how many steps are
//!    taken only decides how narrowly.
//! 3. A whole turn is ψ = π, `T = 2π/agm(p, q)`.

use crate::{Ball, Mag, Undecided};
use rug::Rational;

/// Steps of the arithmetic-geometric mean, each of which doubles the digits.
const STEPS: usize = 64;

/// A pendulum that turns over, upright at t = 0.
///
/// ```
/// use mechaudit_reference::pendulum::Turning;
/// use rug::Rational;
/// // Without gravity it turns evenly: 3 rad/s all the way.
/// let even = Turning::new(&Rational::from(9), &Rational::from(9), 128)?.expect("it turns");
/// assert!(even.angle(&Rational::from((1, 3)))?.contains(&Rational::from(1)));
/// # Ok::<(), mechaudit_reference::Undecided>(())
/// ```
#[derive(Clone, Debug)]
pub struct Turning {
    /// p² and q².
    squares: [Ball; 2],
    /// a and b of every step, first p and q.
    means: Vec<[Ball; 2]>,
    bits: u32,
}

impl Turning {
    /// The pendulum with these squares of the speeds at the top and at the bottom, in rad²/s²; none
    /// if it does not turn over, because a square is not positive.
    ///
    /// # Errors
    /// [`Undecided`] if the two means cannot be brought together at this precision.
    pub fn new(
        top_square: &Rational,
        bottom_square: &Rational,
        bits: u32,
    ) -> Result<Option<Turning>, Undecided> {
        let narrow = Mag::power_of_two(-i64::from(bits));
        let Some(mut turning) = Turning::begun(top_square, bottom_square, bits) else {
            return Ok(None);
        };
        for _ in 0..STEPS {
            turning.step();
            let [a, b] = turning.last();
            if (a - b).magnitude() <= a.magnitude().mul(narrow) {
                return Ok(Some(turning));
            }
        }
        Err(turning.undecided("the means of the speeds stay apart"))
    }

    fn begun(top_square: &Rational, bottom_square: &Rational, bits: u32) -> Option<Turning> {
        let turns = *top_square > 0 && *bottom_square > 0;
        let squares = [top_square, bottom_square].map(|s| Ball::rational(bits + 32, s));
        turns.then(|| Turning {
            means: vec![squares.each_ref().map(Ball::sqrt)],
            squares,
            bits,
        })
    }

    fn undecided(&self, reason: &str) -> Undecided {
        Undecided::new(self.bits, reason)
    }

    fn step(&mut self) {
        let [a, b] = self.last();
        let next = [(a + b).shift(-1), (a * b).sqrt()];
        self.means.push(next);
    }

    fn last(&self) -> &[Ball; 2] {
        &self.means[self.means.len() - 1]
    }

    /// A ball that holds everything between the last two means.
    fn between(&self) -> Ball {
        let [a, b] = self.last();
        a.union(b)
    }

    /// How often the integral has been doubled, as a shift.
    fn doublings(&self) -> i32 {
        self.means.len() as i32 - 1
    }

    fn finite(&self, x: Ball) -> Result<Ball, Undecided> {
        match x.is_finite() {
            true => Ok(x),
            false => Err(self.undecided("the pendulum's means are too wide")),
        }
    }

    /// The time of a turn in seconds.
    ///
    /// # Errors
    /// [`Undecided`] if the precision is too low.
    pub fn period(&self) -> Result<Ball, Undecided> {
        let pi = Ball::pi(self.bits + 32);
        self.finite(pi.shift(1) / self.between())
    }

    /// The angle φ from the upper position at a time in seconds, counted on over the turns.
    ///
    /// # Errors
    /// [`Undecided`] if the precision is too low.
    pub fn angle(&self, time: &Rational) -> Result<Ball, Undecided> {
        let half = Ball::rational(self.bits + 32, time).shift(-1);
        let mut psi = half.shift(self.doublings()) * self.between();
        for [a, b] in self.means.iter().rev().skip(1) {
            let (sine, _) = psi.sin_cos();
            let sine = (a - b) / (a + b) * sine;
            let cosine = (Ball::integer(self.bits, 1) - sine.square()).sqrt();
            psi = (psi + sine.atan2(&cosine)).shift(-1);
        }
        self.finite(psi.shift(1))
    }

    /// The time in seconds at which it comes to the angle φ, the inverse of [`Turning::angle`].
    ///
    /// # Errors
    /// [`Undecided`] if the precision is too low.
    pub fn time(&self, angle: &Ball) -> Result<Ball, Undecided> {
        let mut psi = angle.shift(-1);
        for [a, b] in &self.means[..self.means.len() - 1] {
            let (s, c) = psi.sin_cos();
            let across = (b - a) * (&s * &c);
            let along = a * &c.square() + b * &s.square();
            psi = psi.shift(1) + across.atan2(&along);
        }
        self.finite((psi / self.between()).shift(1 - self.doublings()))
    }

    /// The speed φ' in rad/s at an angle.
    pub fn speed(&self, angle: &Ball) -> Ball {
        let (s, c) = angle.shift(-1).sin_cos();
        let [p, q] = &self.squares;
        (p * &c.square() + q * &s.square()).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gauss_legendre::GaussLegendre;

    const BITS: u32 = 160;

    fn q(n: i64, d: i64) -> Rational {
        Rational::from((n, d))
    }

    fn turning(top: i64, bottom: i64) -> Turning {
        let found = Turning::new(&q(top, 1), &q(bottom, 1), BITS).unwrap();
        found.expect("it turns over")
    }

    /// Quadrature of 1/φ' over an angle, 64 panels of 30 nodes: some 30 digits for the speeds used
    /// here.
    fn by_quadrature(p: &Turning, angle: &Rational) -> Ball {
        let rule = GaussLegendre::new(30, BITS).unwrap();
        let half = Ball::rational(BITS, angle).shift(-7);
        let mut sum = Ball::integer(BITS, 0);
        for k in 0..64 {
            let middle = &half * &Ball::integer(BITS, 2 * k + 1);
            for (node, weight) in &rule.nodes {
                sum = sum + weight / &p.speed(&(&middle + &(&half * node)));
            }
        }
        sum * half
    }

    /// Quadrature knows nothing of means.
    #[test]
    fn time_and_angle_are_those_of_quadrature() {
        for (top, bottom) in [(1, 46), (46, 1), (9, 16)] {
            let p = turning(top, bottom);
            for angle in [q(1, 2), q(3, 1), q(-2, 1), q(25, 2)] {
                let due = by_quadrature(&p, &angle);
                let found = p.time(&Ball::rational(BITS, &angle)).unwrap();
                let off = (&found - &due).magnitude().to_f64();
                assert!(off < 1e-28, "{top} {bottom} {angle}: {off}");
                assert!(found.accuracy_bits() > i64::from(BITS) - 16);
                // And back, from a time that is a fraction.
                let time = found.mid().to_rational().unwrap();
                let back = p.angle(&time).unwrap();
                assert!((back - Ball::rational(BITS, &angle)).magnitude().to_f64() < 1e-40);
            }
        }
    }

    #[test]
    fn a_turn_takes_the_period() {
        for (top, bottom) in [(1, 46), (46, 1), (1, 1), (1, 1_000_000)] {
            let p = turning(top, bottom);
            let period = p.period().unwrap();
            let turn = p.time(&Ball::pi(BITS).shift(1)).unwrap();
            assert!(turn.overlaps(&period) && period.accuracy_bits() > i64::from(BITS) - 16);
            let after = p.angle(&period.mid().to_rational().unwrap()).unwrap();
            let off = after - Ball::pi(BITS).shift(1);
            assert!(off.magnitude().to_f64() < 1e-40);
        }
    }

    #[test]
    fn what_does_not_turn_over_is_refused() {
        for (top, bottom) in [(0, 4), (-1, 4), (4, 0), (4, -1)] {
            let found = Turning::new(&q(top, 1), &q(bottom, 1), BITS).unwrap();
            assert!(found.is_none(), "{top} {bottom}");
        }
    }

    /// However few steps are taken, the true value is held: the last means are no limit yet.
    #[test]
    fn both_means_bound_after_any_number_of_steps() {
        let sharp = turning(1, 46);
        let time = q(7, 3);
        let due = [
            sharp.angle(&time).unwrap(),
            sharp.time(&Ball::integer(BITS, 5)).unwrap(),
            sharp.period().unwrap(),
        ];
        for steps in 3..6 {
            let mut rough = Turning::begun(&q(1, 1), &q(46, 1), BITS).unwrap();
            (0..steps).for_each(|_| rough.step());
            let found = [
                rough.angle(&time).unwrap(),
                rough.time(&Ball::integer(BITS, 5)).unwrap(),
                rough.period().unwrap(),
            ];
            for (k, (found, due)) in found.iter().zip(&due).enumerate() {
                assert!(found.contains_ball(due), "{k} after {steps}");
            }
        }
    }

    #[test]
    fn means_that_are_too_wide_are_undecided() {
        let mut wide = Turning::begun(&q(1, 1), &q(46, 1), BITS).unwrap();
        wide.means[0][1] = wide.means[0][1].widened(Mag::from_f64(7.0));
        assert!(wide.period().is_err());
        wide.step();
        assert!(wide.angle(&q(1, 1)).is_err());
    }
}
