//! Motor torque against crank speed, as a quotient of polynomials.

use crate::{Ball, Mag};
use rug::{Float, Rational};

/// A motor at the crank, exactly given. Speeds in rad/s, torques in N·m.
#[derive(Clone, Debug, PartialEq)]
pub enum Motor {
    /// The same torque at every speed; zero for free motion.
    Constant {
        /// Torque.
        torque: Rational,
    },
    /// `M_d = M_0 − c ψ`.
    Linear {
        /// Torque at standstill M_0.
        standstill: Rational,
        /// Loss of torque per rad/s, c, in N·m·s.
        slope: Rational,
    },
    /// Kloss (1909): `M_d = 2 M_k S S_k/(S² + S_k²)` with the slip `S = 1 − ψ/ω_c`, of any sign.
    Kloss {
        /// Breakdown torque M_k.
        breakdown_torque: Rational,
        /// Breakdown slip S_k > 0.
        breakdown_slip: Rational,
        /// Synchronous speed ω_c > 0 at the crank.
        synchronous: Rational,
    },
    /// Kloss with the rated point given: `M_k = k M_n`, `S_k = s_n (k + √(k² − 1))`, so that
    /// `M_d(s_n) = M_n`.
    Rated {
        /// Rated torque M_n.
        torque: Rational,
        /// Overload factor k ≥ 1.
        overload: Rational,
        /// Rated slip s_n > 0.
        slip: Rational,
        /// Synchronous speed ω_c > 0 at the crank.
        synchronous: Rational,
    },
}

/// `M_d(ψ) = (n_0 + n_1 ψ)/(d_0 + d_1 ψ + d_2 ψ²)` at a working precision.
#[derive(Clone, Debug)]
pub(super) struct Characteristic {
    pub numerator: [Ball; 2],
    /// `None` stands for 1.
    pub denominator: Option<[Ball; 3]>,
    /// `(2 M_k S_k / ω_c, S_k, ω_c)` for Kloss.
    kloss: Option<[Ball; 3]>,
}

impl Motor {
    /// Why the numbers describe no motor, if they do not.
    pub(super) fn fault(&self) -> Option<&'static str> {
        match self {
            Motor::Constant { .. } | Motor::Linear { .. } => None,
            Motor::Kloss {
                breakdown_slip,
                synchronous,
                ..
            } => (*breakdown_slip <= 0 || *synchronous <= 0)
                .then_some("breakdown slip and synchronous speed must be positive"),
            Motor::Rated {
                overload,
                slip,
                synchronous,
                ..
            } => (*overload < 1 || *slip <= 0 || *synchronous <= 0)
                .then_some("slip and synchronous speed must be positive, overload at least 1"),
        }
    }

    pub(super) fn at(&self, bits: u32) -> Characteristic {
        let b = |q: &Rational| Ball::rational(bits, q);
        let zero = Ball::integer(bits, 0);
        let polynomial = |numerator| Characteristic {
            numerator,
            denominator: None,
            kloss: None,
        };
        match self {
            Motor::Constant { torque } => polynomial([b(torque), zero]),
            Motor::Linear { standstill, slope } => polynomial([b(standstill), -b(slope)]),
            Motor::Kloss {
                breakdown_torque,
                breakdown_slip,
                synchronous,
            } => Characteristic::kloss(&b(breakdown_torque), &b(breakdown_slip), &b(synchronous)),
            Motor::Rated {
                torque,
                overload,
                slip,
                synchronous,
            } => {
                let root = b(&(overload.clone().square() - 1u32)).sqrt();
                let breakdown = b(slip) * (b(overload) + root);
                let largest = b(&Rational::from(overload * torque));
                Characteristic::kloss(&largest, &breakdown, &b(synchronous))
            }
        }
    }
}

impl Characteristic {
    fn kloss(torque: &Ball, slip: &Ball, synchronous: &Ball) -> Characteristic {
        let bits = torque.prec();
        let one = Ball::integer(bits, 1);
        let inverse = synchronous.recip();
        let n0 = (torque * slip).shift(1);
        let n1 = &n0 * &inverse;
        Characteristic {
            denominator: Some([&one + &slip.square(), -inverse.shift(1), inverse.square()]),
            numerator: [n0, -&n1],
            kloss: Some([n1, slip.clone(), synchronous.clone()]),
        }
    }

    /// The characteristic for the motion in the direction `−φ`: speeds and torques change sign.
    pub(super) fn reversed(&self) -> Characteristic {
        let [n0, n1] = self.numerator.clone();
        Characteristic {
            numerator: [-n0, n1],
            denominator: self.denominator.clone().map(|[a, b, c]| [a, -b, c]),
            kloss: self.kloss.clone().map(|[n, s, w]| [n, s, -w]),
        }
    }

    /// A lower bound on the denominator: `S² + S_k² ≥ S_k²`.
    pub(super) fn denominator_below(&self) -> Mag {
        match &self.kloss {
            Some([_, s, _]) => s.square().mignitude(),
            None => Mag::from_f64(1.0),
        }
    }

    /// `dM_d/dψ` over a range of speeds; for Kloss `(2 M_k S_k/ω_c) (S² − S_k²)/(S² + S_k²)²`.
    pub(super) fn slope(&self, speed: &Ball) -> Ball {
        match &self.kloss {
            None => self.numerator[1].clone(),
            Some([n, s, w]) => {
                let slip = Ball::integer(64, 1) - speed / w;
                let (a, b) = (square_range(&slip), s.square());
                n * &((&a - &b) / (&a + &b).square())
            }
        }
    }

    /// `M_d` at a speed.
    pub(super) fn torque(&self, speed: &Ball) -> Ball {
        let n = &self.numerator[0] + &(&self.numerator[1] * speed);
        match &self.denominator {
            None => n,
            Some([a, b, c]) => n / (a + &(speed * &(b + &(c * speed)))),
        }
    }

    /// Midpoints of numerator and denominator.
    pub(super) fn midpoints(&self) -> ([Float; 2], Option<[Float; 3]>) {
        let mid = |b: &Ball| b.mid().clone();
        let d = self.denominator.as_ref();
        let n = self.numerator.each_ref().map(mid);
        (n, d.map(|d| d.each_ref().map(mid)))
    }
}

/// `x²` over a range, never negative.
fn square_range(x: &Ball) -> Ball {
    if !x.is_finite() {
        return x.clone();
    }
    let (low, high) = (x.mignitude(), x.magnitude());
    // A lower bound of low²: [`Mag`] rounds up, so halve the last bit away.
    let below = low.to_float();
    let below = Float::with_val_round(53, below.square_ref(), rug::float::Round::Down).0;
    Ball::between(64, &below, &high.mul(high).to_float())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::class_iii::tests::q;

    #[test]
    fn the_rated_point_and_the_breakdown() {
        let m = Motor::Rated {
            torque: q("200"),
            overload: q("2.2"),
            slip: q("0.05"),
            synchronous: q("10"),
        };
        assert!(m.fault().is_none());
        let c = m.at(200);
        // S = s_n, S = −s_n, S = 0.
        for (speed, due) in [("9.5", 200), ("10.5", -200), ("10", 0)] {
            let t = c.torque(&Ball::rational(200, &q(speed)));
            assert!(t.contains(&Rational::from(due)) && t.rad() < Mag::power_of_two(-170));
            let r = c.reversed().torque(&-Ball::rational(200, &q(speed)));
            assert!(r.contains(&Rational::from(-due)));
        }
        // The difference quotient lies in the slope's range.
        let range = Ball::new(Float::with_val(64, 7.5), Mag::from_f64(1.5));
        let slope = c.slope(&range);
        let at = |s: &str| c.torque(&Ball::rational(200, &q(s)));
        for pair in ["6", "7.1", "8.3", "9"].windows(2) {
            let step = Ball::rational(200, &(q(pair[1]) - q(pair[0])));
            let quotient = (at(pair[1]) - at(pair[0])) / step;
            assert!(slope.contains_ball(&quotient), "{pair:?}");
        }
        assert!(c.slope(&Ball::exact(64, 9.7)).is_negative());
        assert!(c.reversed().slope(&Ball::exact(64, -9.7)).is_negative());
    }
}
