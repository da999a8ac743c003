//! Every assembly mode, with proof that there are no others.
//!
//! Eliminating C leaves the real trigonometric polynomial
//! `T(θ) = |N|² − l3² |Δ|²` in θ = φ4, with `N = P q − Q p` and `Δ = p̄ q − p q̄` as Laurent
//! polynomials in `τ = e^{iθ}` (`p = O3 − O5 + l4 τ`, `q = O3 − A + l4 κ τ`,
//! `P = l5² − l3² − |p|²`, `Q = l2² − l3² − |q|²`), of degree 3. Where Δ ≠ 0, each zero gives
//! exactly one position, `u = C − O3 = N/Δ`.

use super::laurent::Laurent;
use super::trigonometric::Trigonometric;
use super::{Configuration, Linkage};
use crate::{Ball, ComplexBall, Mag, Undecided};
use rug::Float;

/// One assembly mode.
#[derive(Clone, Debug)]
pub struct Mode {
    /// Its joints.
    pub configuration: Configuration,
    /// φ4 in radians, in `(−π, π]`.
    pub phi4: Ball,
}

/// T and the data that lead from its zeros back to positions.
struct Resultant {
    n: Laurent,
    delta: Laurent,
    t: Trigonometric,
}

/// The working precision that the zeros are isolated with first.
const COARSE: u32 = 64;

impl Resultant {
    fn new(l: &Linkage, a: &ComplexBall) -> Resultant {
        let bits = l.bits;
        let zero = ComplexBall::zero(bits);
        let real = |x: Ball| ComplexBall::new(x, Ball::integer(bits, 0));
        let p0 = &l.o3 - &l.o5;
        let q0 = &l.o3 - a;
        let q1 = l.kappa.scaled(&l.l4);
        let p = Laurent::new(0, vec![p0, real(l.l4.clone())]);
        let q = Laurent::new(0, vec![q0, q1]);
        let constant = |x: Ball| Laurent::new(1, vec![zero.clone(), real(x), zero.clone()]);
        let l3 = l.l3.square();
        let big_p = constant(l.l5.square() - &l3).sub(&p.mul(&p.conj()));
        let big_q = constant(l.l2.square() - &l3).sub(&q.mul(&q.conj()));
        let n = big_p.mul(&q).sub(&big_q.mul(&p));
        let delta = p.conj().mul(&q).sub(&p.mul(&q.conj()));
        let nn = n.mul(&n.conj());
        let dd = delta.mul(&delta.conj());
        let scaled = Laurent::new(dd.offset, dd.c.iter().map(|x| x.scaled(&l3)).collect());
        let t = nn.sub(&scaled);
        let c = (0..=3).map(|k| t.at(k).cloned().unwrap_or_else(|| zero.clone()));
        Resultant {
            n,
            delta,
            t: Trigonometric::new(bits, c.collect()),
        }
    }

    /// `u` at a zero of T; nothing where Δ cannot be told from 0.
    fn position(&self, tau: &ComplexBall) -> Option<ComplexBall> {
        // Δ is imaginary: u = N/(i Im Δ).
        let (n, delta) = (self.n.value(tau), self.delta.value(tau).im);
        let told = delta.is_positive() || delta.is_negative();
        told.then(|| ComplexBall::new(&n.im / &delta, -(&n.re / &delta)))
    }

    /// A zero of T in each of the intervals that hold them all, and the interval.
    fn zeros(&self) -> Result<Vec<(Float, Float, Float)>, Undecided> {
        let of = |t: &Trigonometric| {
            let zeros = t.isolate()?.into_iter();
            Ok(zeros
                .map(|(lo, hi)| (t.approximate(&lo, &hi), lo, hi))
                .collect())
        };
        let coarse = (self.t.bits() > COARSE).then(|| of(&self.t.with_prec(COARSE)));
        match coarse {
            Some(Ok(zeros)) => Ok(zeros),
            _ => of(&self.t),
        }
    }
}

impl Linkage {
    /// All assembly modes at the crank angle `phi1`, sorted by φ4.
    ///
    /// # Errors
    /// [`Undecided`] when two modes are too close to tell apart at this precision (beside a fold),
    /// when the elimination degenerates (Δ = 0), or when an enclosure fails.
    pub fn modes(&self, phi1: &Ball) -> Result<Vec<Mode>, Undecided> {
        let e1 = ComplexBall::unit(phi1);
        let resultant = Resultant::new(self, &e1.scaled(&self.l1));
        let zeros = resultant.zeros()?;
        self.modes_at(&e1, &resultant, zeros)
    }

    /// The modes at zeros of T, each in the interval in which it is alone.
    fn modes_at(
        &self,
        e1: &ComplexBall,
        resultant: &Resultant,
        zeros: Vec<(Float, Float, Float)>,
    ) -> Result<Vec<Mode>, Undecided> {
        let undecided = |reason: &str| Undecided::new(self.bits, reason);
        let mut modes = Vec::new();
        for (theta, lo, hi) in zeros {
            let tau = ComplexBall::unit(&Ball::new(theta, Mag::ZERO).with_prec(self.bits));
            let u = resultant
                .position(&tau)
                .ok_or_else(|| undecided("the elimination degenerates: Δ cannot be told from 0"))?;
            let c = &self.o3 + &u;
            let d = &c + &tau.scaled(&self.l4);
            let guess = [&c.re, &c.im, &d.re, &d.im].map(|b| b.mid().clone());
            let configuration = self.enclose(e1, &guess).ok_or_else(|| {
                undecided("Krawczyk's test fails: the position is nearly singular")
            })?;
            let phi4 = (&configuration.d - &configuration.c).arg();
            if !within(&phi4, &lo, &hi) {
                return Err(undecided(
                    "the enclosed position left its isolating interval",
                ));
            }
            modes.push(Mode {
                configuration,
                phi4,
            });
        }
        modes.sort_by(|a, b| a.phi4.mid().partial_cmp(b.phi4.mid()).expect("finite"));
        Ok(modes)
    }
}

/// Returns whether an angle, which differs from a principal value by at most a turn, lies in
/// `(lo, hi)` modulo a turn.
fn within(phi: &Ball, lo: &Float, hi: &Float) -> bool {
    let bits = phi.prec();
    let turn = Ball::pi(bits).shift(1);
    let [lo, hi] = [lo, hi].map(|x| Ball::new(x.clone(), Mag::ZERO));
    [-1, 0, 1].iter().any(|&k| {
        let x = phi + &(&turn * &Ball::integer(bits, k));
        (&x - &lo).is_positive() && (&hi - &x).is_positive()
    })
}

#[cfg(test)]
mod tests;
