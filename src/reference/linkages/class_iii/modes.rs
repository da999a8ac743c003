//! Every assembly mode, with proof that there are no others.
//!
//! Eliminating C leaves the real trigonometric polynomial
//! `T(θ) = |N|² − l3² |Δ|²` in θ = φ4, with `N = P q − Q p` and `Δ = p̄ q − p q̄` as Laurent
//! polynomials in `τ = e^{iθ}` (`p = O3 − O5 + l4 τ`, `q = O3 − A + l4 κ τ`,
//! `P = l5² − l3² − |p|²`, `Q = l2² − l3² − |q|²`), of degree 3. On an interval of half-width r
//! about m, Taylor's theorem with `|T''| ≤ L = 2 Σ k² |c_k|` gives
//!
//! * no zero if `|T(m)| > |T'(m)| r + L r²/2`,
//! * at most one zero if `|T'(m)| > L r`, and then one exactly if T changes sign.
//!
//! Intervals that show neither are halved. Where Δ ≠ 0, each zero gives exactly one position,
//! `u = C − O3 = N/Δ`.

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

/// A Laurent polynomial in τ: coefficient of τ^k at index `k + offset`.
struct Laurent {
    offset: i32,
    c: Vec<ComplexBall>,
}

impl Laurent {
    fn new(offset: i32, c: Vec<ComplexBall>) -> Laurent {
        Laurent { offset, c }
    }

    fn mul(&self, other: &Laurent) -> Laurent {
        let bits = self.c[0].re.prec();
        let n = self.c.len() + other.c.len() - 1;
        let mut c = vec![ComplexBall::zero(bits); n];
        for (i, a) in self.c.iter().enumerate() {
            for (j, b) in other.c.iter().enumerate() {
                c[i + j] = &c[i + j] + &(a * b);
            }
        }
        Laurent::new(self.offset + other.offset, c)
    }

    fn at(&self, k: i32) -> Option<&ComplexBall> {
        usize::try_from(k + self.offset)
            .ok()
            .and_then(|i| self.c.get(i))
    }

    fn sub(&self, other: &Laurent) -> Laurent {
        let bits = self.c[0].re.prec();
        let offset = self.offset.max(other.offset);
        let top = |l: &Laurent| l.c.len() as i32 - l.offset;
        let n = offset + top(self).max(top(other));
        let c = (0..n)
            .map(|i| {
                let k = i - offset;
                let zero = ComplexBall::zero(bits);
                self.at(k).unwrap_or(&zero) - other.at(k).unwrap_or(&zero)
            })
            .collect();
        Laurent::new(offset, c)
    }

    /// The conjugate on the unit circle: τ → 1/τ and coefficients conjugated.
    fn conj(&self) -> Laurent {
        let c: Vec<ComplexBall> = self.c.iter().rev().map(ComplexBall::conj).collect();
        Laurent::new(self.c.len() as i32 - 1 - self.offset, c)
    }

    fn value(&self, tau: &ComplexBall) -> ComplexBall {
        let bits = tau.re.prec();
        let mut sum = ComplexBall::zero(bits);
        for c in self.c.iter().rev() {
            sum = &(&sum * tau) + c;
        }
        // Divide by τ^offset = multiply by conj(τ)^offset.
        for _ in 0..self.offset {
            sum = &sum * &tau.conj();
        }
        sum
    }
}

/// T and the data that lead from its zeros back to positions.
struct Resultant {
    n: Laurent,
    delta: Laurent,
    t: Trigonometric,
}

/// The working precision that the zeros are isolated with first.
const COARSE: u32 = 64;

/// T.
struct Trigonometric {
    bits: u32,
    /// `c_0 … c_3` with `T = c_0 + 2 Re Σ c_k e^{ikθ}`.
    c: Vec<ComplexBall>,
    /// Bound on |T''|.
    curvature: Mag,
}

struct Interval {
    lo: Float,
    hi: Float,
    depth: u32,
}

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
        let c: Vec<ComplexBall> = (0..=3)
            .map(|k| t.at(k).cloned().unwrap_or_else(|| zero.clone()))
            .collect();
        let mut curvature = Mag::ZERO;
        for (k, x) in c.iter().enumerate() {
            let size = x.re.magnitude().add(x.im.magnitude());
            curvature = curvature.add(size.mul(Mag::from_f64(2.0 * (k * k) as f64)));
        }
        Resultant {
            n,
            delta,
            t: Trigonometric { bits, c, curvature },
        }
    }

    /// A zero of T in each of the intervals that hold them all, and the interval.
    fn zeros(&self) -> Result<Vec<(Float, Float, Float)>, Undecided> {
        let of = |t: &Trigonometric| {
            let zeros = t.isolate()?.into_iter();
            Ok(zeros
                .map(|(lo, hi)| (t.approximate(&lo, &hi), lo, hi))
                .collect())
        };
        let coarse = (self.t.bits > COARSE).then(|| of(&self.t.with_prec(COARSE)));
        match coarse {
            Some(Ok(zeros)) => Ok(zeros),
            _ => of(&self.t),
        }
    }
}

impl Trigonometric {
    fn with_prec(&self, bits: u32) -> Trigonometric {
        let c = |x: &ComplexBall| ComplexBall::new(x.re.with_prec(bits), x.im.with_prec(bits));
        Trigonometric {
            bits,
            c: self.c.iter().map(c).collect(),
            // A bound on |T''| whatever the precision.
            curvature: self.curvature,
        }
    }

    /// `(T, T')` at an exact angle.
    fn value(&self, theta: &Float) -> (Ball, Ball) {
        let tau = ComplexBall::unit(&Ball::new(theta.clone(), Mag::ZERO).with_prec(self.bits));
        let mut power = tau.clone();
        let mut t = self.c[0].re.clone();
        let mut d = Ball::integer(self.bits, 0);
        for k in 1..=3 {
            let term = &self.c[k] * &power;
            t = t + term.re.shift(1);
            d = d - (&term.im * &Ball::integer(self.bits, 2 * k as i64));
            if k < 3 {
                power = &power * &tau;
            }
        }
        (t, d)
    }

    /// Disjoint intervals with exactly one zero of T each; together they hold all zeros.
    fn isolate(&self) -> Result<Vec<(Float, Float)>, Undecided> {
        let undecided = |reason: &str| Undecided {
            bits: self.bits,
            reason: reason.into(),
        };
        // A whole turn cut at odd places, so that a zero on a cut is unlikely.
        let parts = 12;
        let cut = |k: u32| {
            let turn = Float::with_val(self.bits, rug::float::Constant::Pi) << 1u32;
            turn * k / parts - 2.71875
        };
        let mut open: Vec<Interval> = (0..parts)
            .map(|k| Interval {
                lo: cut(k),
                hi: cut(k + 1),
                depth: 0,
            })
            .collect();
        // The turn is closed by an overlap so small that the first interval's lower end, moved
        // down by it, decides nothing new: T keeps its sign there or the case is undecided.
        let end = open[parts as usize - 1].hi.clone();
        let gap = Ball::pi(self.bits).shift(1)
            - &(Ball::new(end, Mag::ZERO) - &Ball::new(open[0].lo.clone(), Mag::ZERO));
        let (t, _) = self.value(&open[0].lo);
        if t.mignitude() <= self.slope_bound().mul(gap.magnitude()) {
            return Err(undecided("a zero of the resultant lies on a cut"));
        }
        let deepest = self.bits / 2;
        let mut found = Vec::new();
        while let Some(i) = open.pop() {
            let mid = Float::with_val(self.bits, &i.lo + &i.hi) >> 1u32;
            let r = Mag::above(&Float::with_val(64, &i.hi - &mid))
                .max(Mag::above(&Float::with_val(64, &mid - &i.lo)))
                .mul(Mag::from_f64(1.0 + 1e-15));
            let (t, d) = self.value(&mid);
            let reach = d
                .magnitude()
                .mul(r)
                .add(self.curvature.mul(r).mul(r).shift(-1));
            if t.mignitude() > reach {
                continue;
            }
            if d.mignitude() > self.curvature.mul(r) {
                let (a, b) = (self.value(&i.lo).0, self.value(&i.hi).0);
                if a.contains_zero() || b.contains_zero() {
                    return Err(undecided("a zero of the resultant lies on a cut"));
                }
                if a.is_positive() != b.is_positive() {
                    found.push((i.lo, i.hi));
                }
                continue;
            }
            if i.depth >= deepest {
                return Err(undecided("two assembly modes are too close to tell apart"));
            }
            let depth = i.depth + 1;
            open.push(Interval {
                lo: i.lo,
                hi: mid.clone(),
                depth,
            });
            open.push(Interval {
                lo: mid,
                hi: i.hi,
                depth,
            });
        }
        Ok(found)
    }

    /// Bound on |T'|.
    fn slope_bound(&self) -> Mag {
        self.curvature
    }

    /// An approximate zero in an isolating interval.
    fn approximate(&self, lo: &Float, hi: &Float) -> Float {
        let (mut lo, mut hi) = (lo.clone(), hi.clone());
        let rising = self.value(&lo).0.is_negative();
        let mut x = Float::with_val(self.bits, &lo + &hi) >> 1u32;
        for _ in 0..200 {
            let (t, d) = self.value(&x);
            if t.mid().is_zero() {
                return x;
            }
            if t.mid().is_sign_negative() == rising {
                lo.clone_from(&x);
            } else {
                hi.clone_from(&x);
            }
            let step = Float::with_val(self.bits, t.mid() / d.mid());
            let mut next = Float::with_val(self.bits, &x - &step);
            if !(next > lo && next < hi) {
                next = Float::with_val(self.bits, &lo + &hi) >> 1u32;
            }
            let moved = Mag::above(&Float::with_val(64, &next - &x));
            x = next;
            if moved <= Mag::power_of_two(-50) {
                break;
            }
        }
        x
    }
}

impl Linkage {
    /// All assembly modes at the crank angle `phi1`, sorted by φ4.
    ///
    /// # Errors
    /// [`Undecided`] when two modes are too close to tell apart at this precision (beside a fold),
    /// when the elimination degenerates (Δ = 0), or when an enclosure fails.
    pub fn modes(&self, phi1: &Ball) -> Result<Vec<Mode>, Undecided> {
        let undecided = |reason: &str| Undecided {
            bits: self.bits,
            reason: reason.into(),
        };
        let e1 = ComplexBall::unit(phi1);
        let a = e1.scaled(&self.l1);
        let resultant = Resultant::new(self, &a);
        let mut modes = Vec::new();
        for (theta, lo, hi) in resultant.zeros()? {
            let tau = ComplexBall::unit(&Ball::new(theta, Mag::ZERO).with_prec(self.bits));
            let delta = resultant.delta.value(&tau);
            // Δ is imaginary: u = N/(i Im Δ).
            let n = resultant.n.value(&tau);
            let u = ComplexBall::new(&n.im / &delta.im, -(&n.re / &delta.im));
            if !u.re.is_finite() || !u.im.is_finite() {
                return Err(undecided(
                    "the elimination degenerates: Δ cannot be told from 0",
                ));
            }
            let c = &self.o3 + &u;
            let d = &c + &tau.scaled(&self.l4);
            let guess = [&c.re, &c.im, &d.re, &d.im].map(|b| b.mid().clone());
            let configuration = self.enclose(&e1, &guess).ok_or_else(|| {
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
        for pair in modes.windows(2) {
            if pair[0].phi4.overlaps(&pair[1].phi4) {
                return Err(undecided("two modes share φ4 to this precision"));
            }
        }
        Ok(modes)
    }
}

/// Whether an angle lies in `[lo, hi]` modulo a turn.
fn within(phi: &Ball, lo: &Float, hi: &Float) -> bool {
    let bits = phi.prec();
    let turn = Ball::pi(bits).shift(1);
    let (lo, hi) = (
        Ball::new(lo.clone(), Mag::ZERO),
        Ball::new(hi.clone(), Mag::ZERO),
    );
    [-1, 0, 1].iter().any(|&k| {
        let x = phi + &(&turn * &Ball::integer(bits, k));
        !(&x - &lo).is_negative()
            && !(&hi - &x).is_negative()
            && (&x - &lo).is_finite()
            && x.rad() < Mag::from_f64(0.01)
            && !(&x - &lo).contains_zero()
            && !(&hi - &x).contains_zero()
    })
}

#[cfg(test)]
#[path = "zeros_tests.rs"]
mod tests;
