//! The equation of motion (1) and Kloss's formula (2).

use super::exact::{Grid, Identity, Q, q};
use super::{Outcome, agree, decimals, draft};
use crate::papers::{Finding, FindingVerdict, figures};
use crate::reference::{Ball, Decimal};

/// `dψ/dt` from I_n, dI_n/dφ, ψ, M_d, M_o.
pub(super) type Acceleration = fn(&Q, &Q, &Q, &Q, &Q) -> Q;

/// (1) as printed.
pub(super) const PRINTED_1: Acceleration = |i, di, psi, md, mo| (md + mo - psi * psi * di / 2) / i;

/// The power balance `d/dt(½ I ψ²) = (M_d + M_o) ψ`, right minus left. With `dI/dt = I' ψ` the left
/// side is `½ I' ψ³ + I ψ dψ/dt`. Degrees: 1 in I, I', M_d, M_o and 3 in ψ.
/// M_o enters the right side with its sign or as a resistance, and `owed M_o ψ` are added to it.
fn balance(form: Acceleration, resistance: bool, owed: i32) -> Identity {
    Grid::new(&[1, 1, 3, 1, 1]).vanishes(|v| {
        let [i, di, psi, md, mo] = <&[Q; 5]>::try_from(v).expect("five variables");
        let a = form(i, di, psi, md, mo);
        let added = mo * owed * psi;
        let mo = if resistance { -mo } else { mo.clone() };
        added + (md + mo) * psi - psi * psi * psi * di / 2 - i * psi * a
    })
}

/// Formula (1).
pub(super) fn equation_of_motion(form: Acceleration) -> Finding {
    let signed = balance(form, false, 0);
    let unsigned = balance(form, true, 0);
    let exactly = balance(form, true, 2);
    draft("formula-1", "(1)")
        .verdict(FindingVerdict::Confirmed)
        .titled("The equation of motion is right when M_o carries its sign")
        .text(
            "Formula (1) is the power balance d(½ I_n ψ²)/dt = (M_d + M_o) ψ solved for dψ/dt; \
             the identity was proved exactly. It asks for M_o as a moment with a sign, which is \
             what formula (7) delivers: negative while the sieve is being lifted. Entering a \
             resisting moment as a positive number breaks the balance by 2 M_o ψ.",
        )
        .figures(figures! {
            "grid points of the exact identity": "{}", signed.points => "1";
            "imbalance at the first point with M_o taken as a positive resistance":
                "{}", unsigned .failure .as_ref() .map_or("none".into(), |f| f.1.to_string()) => "W";
        })
        .recorded_if(agree(&[
            (signed.outcome(), Outcome::Holds),
            (unsigned.outcome(), Outcome::Fails),
            (exactly.outcome(), Outcome::Holds),
        ]))
}

/// `a + b r` with `r² = k² − 1`, exactly.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Surd {
    k: Q,
    a: Q,
    b: Q,
}

impl Surd {
    fn new(k: &Q, a: Q, b: Q) -> Surd {
        Surd { k: k.clone(), a, b }
    }

    fn radicand(&self) -> Q {
        &self.k * &self.k - 1
    }

    fn plus(&self, o: &Surd) -> Surd {
        Surd::new(&self.k, &self.a + &o.a, &self.b + &o.b)
    }

    fn scaled(&self, x: &Q) -> Surd {
        Surd::new(&self.k, &self.a * x, &self.b * x)
    }

    /// `(a − b r)/(a² − b² (k² − 1))`; `None` without an inverse.
    fn inverse(&self) -> Option<Surd> {
        let norm = &self.a * &self.a - &self.b * &self.b * self.radicand();
        (!norm.is_zero()).then(|| Surd::new(&self.k, &self.a / &norm, -(&self.b / &norm)))
    }

    fn is_zero(&self) -> bool {
        self.a.is_zero() && self.b.is_zero()
    }
}

/// (2) and what belongs to it.
pub(super) struct Motor {
    /// M_d from M_k, S_k/S and S/S_k.
    torque: fn(&Q, &Surd, &Surd) -> Option<Surd>,
    /// S_k/S_n from k.
    critical_slip: fn(&Q) -> Surd,
    /// S from ω_c, ω.
    slip: fn(&Q, &Q) -> Q,
}

/// As printed.
pub(super) const PRINTED_2: Motor = Motor {
    torque: |mk, a, b| Some(a.plus(b).inverse()?.scaled(&(mk * 2))),
    critical_slip: |k| Surd::new(k, k.clone(), Q::from(1)),
    slip: |synchronous, speed| (synchronous - speed) / synchronous,
};

/// The torque at `S = S_n` is `M_n = M_k/k`. The residual times (ρ + 1/ρ) ρ, with ρ = S_k/S_n, is
/// `2 k ρ − ρ² − 1`: of degree 2 in k and r, so with r² reduced both parts have degree at most 2
/// in k; four values of k are one more than needed.
fn rated(motor: &Motor) -> Outcome {
    let residual = |k: &Q| {
        let rho = (motor.critical_slip)(k);
        let torque = (motor.torque)(&Q::from(1), &rho, &rho.inverse()?)?;
        Some(torque.plus(&Surd::new(k, -(Q::from(1) / k), Q::from(0))))
    };
    Outcome::all((0..4).map(|j| {
        let zero = residual(&q(5 + 3 * j, 4)).is_some_and(|r| r.is_zero());
        Outcome::of(zero)
    }))
}

/// `M_k − M = M_k (S − S_k)²/(S² + S_k²)`: M_k is the largest torque, reached at S_k.
fn breakdown(motor: &Motor) -> Identity {
    Grid::new(&[1, 4, 4]).vanishes(|v| {
        let [mk, s, sk] = <&[Q; 3]>::try_from(v).expect("three variables");
        let plain = |x: Q| Surd::new(mk, x, Q::from(0));
        let Some(torque) = (motor.torque)(mk, &plain(sk / s), &plain(s / sk)) else {
            return Q::from(1);
        };
        let gap = s - sk;
        mk - torque.a - mk * &gap * &gap / (s * s + sk * sk)
    })
}

/// Formula (2), the critical slip and the slip.
pub(super) fn kloss(motor: &Motor) -> Finding {
    let breakdown = breakdown(motor);
    let slip = |speed: i32| (motor.slip)(&q(157, 1), &Q::from(speed));
    let ends = slip(0) == Q::from(1) && slip(157).is_zero();
    // The other root of S_k² − 2 k S_n S_k + S_n² = 0 is S_n (k − r): their product is S_n².
    let k = q(11, 5);
    let rho = (motor.critical_slip)(&k);
    let other = Surd::new(&k, rho.a.clone(), -&rho.b);
    let reciprocal = rho.inverse() == Some(other);
    let ratio = {
        let bits = 128;
        let ball = |x: &Q| Ball::rational(bits, &x.0);
        ball(&rho.a) + ball(&rho.b) * ball(&rho.radicand()).sqrt()
    };
    let above = (&ratio - &Ball::integer(128, 1)).is_positive();
    let rated_slip = Decimal::parse("0.05").map_or_else(|_| Q::from(0), |d| Q(d.value));
    let example = &ratio * &Ball::rational(128, &rated_slip.0);
    draft("formula-2", "(2), slip and critical slip")
        .verdict(FindingVerdict::Confirmed)
        .titled("Kloss's formula and the critical slip are right")
        .text(
            "With S_k = S_n (k + √(k² − 1)) the formula returns exactly the rated torque M_k/k at \
             the rated slip; this was proved in exact algebra with r² = k² − 1. Of the two roots \
             the paper takes the right one: the other is its reciprocal and would put the rated \
             point on the unstable side of the maximum. M_k is the largest torque, reached at \
             S_k, and the slip runs from 1 at standstill to 0 at synchronous speed. The legend of \
             the scan has a Greek index for the rated values and M_φ twice; that looks like noise \
             of its text layer.",
        )
        .figures(figures! {
            "S_k/S_n for k = 2.2": "{}", decimals(&ratio, 12) => "1";
            "S_k for k = 2.2 and S_n = 0.05": "{}", decimals(&example, 12) => "1";
            "grid points of the exact identity": "{}", breakdown.points => "1";
        })
        .recorded_if(agree(&[
            (rated(motor), Outcome::Holds),
            (breakdown.outcome(), Outcome::Holds),
            (Outcome::of(ends), Outcome::Holds),
            (Outcome::of(reciprocal && above), Outcome::Holds),
        ]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_faults_are_found() {
        let no_half: Acceleration = |i, di, psi, md, mo| (md + mo - psi * psi * di) / i;
        assert!(!equation_of_motion(no_half).as_recorded);
        let minus: Acceleration = |i, di, psi, md, mo| (md - mo - psi * psi * di / 2) / i;
        assert!(!equation_of_motion(minus).as_recorded);
        let mut motor = PRINTED_2;
        motor.critical_slip = |k| Surd::new(k, k.clone(), Q::from(2));
        assert!(!kloss(&motor).as_recorded);
        // The other root satisfies the rated point but not the side.
        motor.critical_slip = |k| Surd::new(k, k.clone(), Q::from(-1));
        assert_eq!(rated(&motor), Outcome::Holds);
        assert!(!kloss(&motor).as_recorded);
        let mut motor = PRINTED_2;
        motor.torque = |mk, a, b| Some(a.plus(b).inverse()?.scaled(mk));
        assert!(!kloss(&motor).as_recorded);
        let mut motor = PRINTED_2;
        motor.slip = |synchronous, speed| (synchronous - speed) / speed.abs().max(Q::from(1));
        assert!(!kloss(&motor).as_recorded);
    }

    /// (1 + 2r)(3 − r) with r² = k² − 1 = 3 for k = 2, and so on.
    #[test]
    fn surds_are_added_scaled_and_inverted() {
        let surd = |a: i32, b: i32| Surd::new(&Q::from(2), Q::from(a), Q::from(b));
        assert_eq!(surd(1, 2).radicand(), Q::from(3));
        assert_eq!(surd(1, 2).plus(&surd(3, -5)), surd(4, -3));
        assert_eq!(surd(1, 2).scaled(&Q::from(3)), surd(3, 6));
        // 1/(2 + r) = 2 − r, 1/(1 + r) = (r − 1)/2.
        assert_eq!(surd(2, 1).inverse(), Some(surd(2, -1)));
        let half = Surd::new(&Q::from(2), q(-1, 2), q(1, 2));
        assert_eq!(surd(1, 1).inverse(), Some(half));
        assert_eq!(surd(0, 0).inverse(), None);
        assert!(surd(0, 0).is_zero() && !surd(1, 0).is_zero() && !surd(0, 1).is_zero());
    }

    /// One value more than its degree for each variable.
    #[test]
    fn identities_are_tried_on_the_whole_grid() {
        assert_eq!(balance(PRINTED_1, false, 0).points, 2 * 2 * 4 * 2 * 2);
        assert_eq!(balance(PRINTED_1, true, 2).points, 64);
        assert_eq!(breakdown(&PRINTED_2).points, 2 * 5 * 5);
    }

    /// Right but at one of the values that are tried.
    #[test]
    fn a_fault_at_a_single_value_is_found() {
        fn off_at(k: &Q, at: Q) -> Surd {
            let b = if *k == at { 2 } else { 1 };
            Surd::new(k, k.clone(), Q::from(b))
        }
        let forms: [fn(&Q) -> Surd; 4] = [
            |k| off_at(k, q(5, 4)),
            |k| off_at(k, q(8, 4)),
            |k| off_at(k, q(11, 4)),
            |k| off_at(k, q(14, 4)),
        ];
        for critical_slip in forms {
            let motor = Motor {
                critical_slip,
                ..PRINTED_2
            };
            assert_eq!(rated(&motor), Outcome::Fails);
        }
        let slips: [fn(&Q, &Q) -> Q; 3] = [
            |_, _| Q::from(1),
            |_, _| Q::from(0),
            |synchronous, speed| (speed - synchronous) / synchronous,
        ];
        for slip in slips {
            assert!(!kloss(&Motor { slip, ..PRINTED_2 }).as_recorded);
        }
        // Without an inverse there is no torque to be right.
        let motor = Motor {
            torque: |_, _, _| None,
            ..PRINTED_2
        };
        assert_eq!(breakdown(&motor).outcome(), Outcome::Fails);
        assert_eq!(rated(&motor), Outcome::Fails);
    }

    /// S_k/S_n = 2.2 + √3.84 = 4.1596, twentieth of it at S_n = 0.05.
    #[test]
    fn the_example_has_the_text_s_numbers() {
        let shown = kloss(&PRINTED_2).figures;
        let value = |k: usize| shown[k].value.parse::<f64>().unwrap();
        let ratio = 2.2 + 3.84f64.sqrt();
        assert!((value(0) - ratio).abs() < 1e-11 && (value(1) - 0.05 * ratio).abs() < 1e-11);
    }
}
