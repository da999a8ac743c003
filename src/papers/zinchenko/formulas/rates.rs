//! The velocity system and the acceleration system, four scalar equations each.

use super::sample::{BITS, Dimensions, Position, Sample};
use super::{Outcome, agree, draft, largest};
use crate::papers::{Finding, FindingVerdict, figures};
use crate::reference::Ball;

/// Everything that stands in the two systems. Arrays are indexed by the link's number; entry 0 is
/// unused and zero.
#[derive(Clone)]
pub(super) struct Motion {
    pub l: [Ball; 6],
    pub lb: Ball,
    /// Sines and cosines of φ1 … φ5.
    pub sin: [Ball; 6],
    pub cos: [Ball; 6],
    /// Sine and cosine of φ4 + φ_B.
    pub sin_b: Ball,
    pub cos_b: Ball,
    /// Angular velocities.
    pub psi: [Ball; 6],
    /// Angular accelerations.
    pub eps: [Ball; 6],
}

/// Left minus right side of four equations.
pub(super) type System = fn(&Motion) -> [Ball; 4];

/// The velocity system as printed.
pub(super) const VELOCITIES: System = |x| {
    let Motion {
        l,
        lb,
        sin: s,
        cos: c,
        sin_b,
        cos_b,
        psi: p,
        ..
    } = x;
    [
        -(&l[2] * &p[2] * &s[2]) + &l[3] * &p[3] * &s[3] + lb * &p[4] * sin_b
            - &l[1] * &p[1] * &s[1],
        &l[2] * &p[2] * &c[2] - &l[3] * &p[3] * &c[3] - lb * &p[4] * cos_b + &l[1] * &p[1] * &c[1],
        -(&l[3] * &p[3] * &s[3]) - &l[4] * &p[4] * &s[4] + &l[5] * &p[5] * &s[5],
        &l[3] * &p[3] * &c[3] + &l[4] * &p[4] * &c[4] - &l[5] * &p[5] * &c[5],
    ]
};

/// The acceleration system as printed.
pub(super) const ACCELERATIONS: System = |x| {
    let Motion {
        l,
        lb,
        sin: s,
        cos: c,
        sin_b,
        cos_b,
        psi,
        eps: e,
        ..
    } = x;
    let p: [Ball; 6] = std::array::from_fn(|i| psi[i].square());
    let first = {
        let left = -(&l[1] * &p[1] * &c[1]) - &l[2] * &p[2] * &c[2] - &l[2] * &e[2] * &s[2];
        let right = -(&l[3] * &p[3] * &c[3])
            - &l[3] * &e[3] * &s[3]
            - lb * &p[4] * cos_b
            - lb * &e[4] * sin_b;
        left - right
    };
    let second = {
        let left = -(&l[1] * &p[1] * &s[1]) - &l[2] * &p[2] * &s[2] + &l[2] * &e[2] * &c[2];
        let right = -(&l[3] * &p[3] * &s[3]) + &l[3] * &e[3] * &c[3] - lb * &p[4] * sin_b
            + lb * &e[4] * cos_b;
        left - right
    };
    let third = {
        let left = -(&l[5] * &p[5] * &c[5]) - &l[5] * &e[5] * &s[5];
        let right = -(&l[3] * &p[3] * &c[3])
            - &l[3] * &e[3] * &s[3]
            - &l[4] * &p[4] * &c[4]
            - &l[4] * &e[4] * &s[4];
        left - right
    };
    let fourth = {
        let left = -(&l[5] * &p[5] * &s[5]) + &l[5] * &e[5] * &c[5];
        let right = -(&l[3] * &p[3] * &s[3]) + &l[3] * &e[3] * &c[3] - &l[4] * &p[4] * &s[4]
            + &l[4] * &e[4] * &c[4];
        left - right
    };
    [first, second, third, fourth]
};

/// The certified motion at a position with crank speed `omega` and crank acceleration `alpha`:
/// `ψ = φ' ω`, `ε = φ'' ω² + φ' α`.
fn motion(d: &Dimensions, at: &Position, omega: i64, alpha: i64) -> Motion {
    let (omega, alpha) = (Ball::integer(BITS, omega), Ball::integer(BITS, alpha));
    let zero = || Ball::integer(BITS, 0);
    let indexed =
        |f: &dyn Fn(usize) -> Ball| std::array::from_fn(|i| if i == 0 { zero() } else { f(i - 1) });
    let turns: Vec<(Ball, Ball)> = at.phi.iter().map(Ball::sin_cos).collect();
    let (sin_b, cos_b) = (&at.phi[3] + &d.phi_b).sin_cos();
    Motion {
        l: [
            zero(),
            d.l1.clone(),
            d.l2.clone(),
            d.l3.clone(),
            d.l4.clone(),
            d.l5.clone(),
        ],
        lb: d.lb.clone(),
        sin: indexed(&|i| turns[i].0.clone()),
        cos: indexed(&|i| turns[i].1.clone()),
        sin_b,
        cos_b,
        psi: indexed(&|i| &at.first[i] * &omega),
        eps: indexed(&|i| &at.second[i] * &omega.square() + &at.first[i] * &alpha),
    }
}

/// Residuals at all positions, for each crank speed.
fn residuals(system: System, sample: &Sample, omegas: &[i64], alpha: i64) -> Vec<Ball> {
    let mut all = Vec::new();
    for at in &sample.positions {
        for &omega in omegas {
            all.extend(system(&motion(&sample.dimensions, at, omega, alpha)));
        }
    }
    all
}

/// Crank speeds that the systems are tried at: the paper's, and one that powers of ω1 show in.
const SPEEDS: [i64; 2] = [1, -3];

/// The velocity system.
pub(super) fn velocities(system: System, sample: &Sample) -> Finding {
    let r = residuals(system, sample, &SPEEDS, 0);
    draft("velocity-system", "velocity system")
        .verdict(FindingVerdict::Confirmed)
        .titled("All four velocity equations are right")
        .text(
            "The printed system is the time derivative of the two loop equations. Link rates that \
             were certified without it, from the rigid distances between the joints, satisfy all \
             four equations at every row tried, with crank speeds 1 and −3 rad/s: each residual is \
             enclosed in an interval around zero.",
        )
        .figures(figures! {
            "equations evaluated": "{}", r.len() => "1";
            "largest possible residual": "{}", largest(&r) => "cm/s";
        })
        .recorded_if(agree(&[(Outcome::enclosed(&r), Outcome::Holds)]))
}

/// The coefficients of link j's unknown in both systems: the residual for that unknown equal to
/// one with all else at rest. The third and fourth acceleration equations are printed with the
/// opposite sign.
fn coefficients(system: System, at: &Motion, link: usize) -> [Ball; 4] {
    let unit: [Ball; 6] = std::array::from_fn(|i| Ball::integer(BITS, i64::from(i == link)));
    let rest: [Ball; 6] = std::array::from_fn(|_| Ball::integer(BITS, 0));
    let with = |psi: &[Ball; 6], eps: &[Ball; 6]| Motion {
        psi: psi.clone(),
        eps: eps.clone(),
        ..at.clone()
    };
    let v = VELOCITIES(&with(&unit, &rest));
    let a = system(&with(&rest, &unit));
    std::array::from_fn(|i| if i < 2 { &v[i] - &a[i] } else { &v[i] + &a[i] })
}

/// The acceleration system.
pub(super) fn accelerations(system: System, sample: &Sample) -> Finding {
    let r = residuals(system, sample, &SPEEDS, 0);
    let uneven = residuals(system, sample, &[1], 1);
    let mut differences = Vec::new();
    // What the crank's own acceleration leaves is its coefficient in the velocity system, nothing else.
    let mut exactly = Vec::new();
    for (at, left) in sample.positions.iter().zip(uneven.chunks(4)) {
        let at = motion(&sample.dimensions, at, 1, 0);
        differences.extend((2..=5).flat_map(|link| coefficients(system, &at, link)));
        let owed = coefficients(system, &at, 1);
        let rest = |i: usize| {
            if i < 2 {
                &left[i] + &owed[i]
            } else {
                &left[i] - &owed[i]
            }
        };
        exactly.extend((0..4).map(rest));
    }
    draft("acceleration-system", "acceleration system")
        .verdict(FindingVerdict::Confirmed)
        .titled("All four acceleration equations are right, for a crank at constant speed")
        .text(
            "Certified angular accelerations satisfy all four printed equations, the third and \
             fourth included, at every row tried. There is no term with the crank's own \
             acceleration: with ε_1 = 1 rad/s² the equations no longer hold. That is enough for \
             dI_n/dφ, which depends on the position only. The unknowns have the same coefficients \
             as in the velocity system, checked one by one, so the accelerations cost one more \
             right-hand side on a matrix that is already factored.",
        )
        .figures(figures! {
            "equations evaluated": "{}", r.len() => "1";
            "largest possible residual": "{}", largest(&r) => "cm/s^2";
            "largest residual with eps_1 = 1 rad/s^2": "{}", largest(&uneven) => "cm/s^2";
            "coefficients compared with the velocity system": "{}", differences.len() => "1";
        })
        .recorded_if(agree(&[
            (Outcome::enclosed(&r), Outcome::Holds),
            (Outcome::enclosed(&uneven), Outcome::Fails),
            (Outcome::enclosed(&exactly), Outcome::Holds),
            (Outcome::enclosed(&differences), Outcome::Holds),
        ]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Changes the sign of one term per equation.
    macro_rules! faulty {
        ($system:ident, $n:literal, $term:expr) => {
            |x| {
                let mut r = $system(x);
                let term: fn(&Motion) -> Ball = $term;
                r[$n] = &r[$n] + &term(x).shift(1);
                r
            }
        };
    }

    #[test]
    fn planted_sign_errors_are_found() {
        let sample = Sample::new().unwrap();
        assert!(velocities(VELOCITIES, &sample).as_recorded);
        assert!(accelerations(ACCELERATIONS, &sample).as_recorded);
        let bad: [System; 4] = [
            faulty!(VELOCITIES, 0, |x| &x.l[1] * &x.psi[1] * &x.sin[1]),
            faulty!(VELOCITIES, 1, |x| &x.l[3] * &x.psi[3] * &x.cos[3]),
            faulty!(VELOCITIES, 2, |x| &x.l[4] * &x.psi[4] * &x.sin[4]),
            faulty!(VELOCITIES, 3, |x| &x.l[5] * &x.psi[5] * &x.cos[5]),
        ];
        assert!(bad.iter().all(|f| !velocities(*f, &sample).as_recorded));
        let bad: [System; 4] = [
            faulty!(ACCELERATIONS, 0, |x| &x.l[2]
                * &x.psi[2].square()
                * &x.cos[2]),
            faulty!(ACCELERATIONS, 1, |x| &x.lb * &x.eps[4] * &x.cos_b),
            faulty!(ACCELERATIONS, 2, |x| &x.l[3]
                * &x.psi[3].square()
                * &x.cos[3]),
            faulty!(ACCELERATIONS, 3, |x| &x.l[5] * &x.eps[5] * &x.cos[5]),
        ];
        assert!(bad.iter().all(|f| !accelerations(*f, &sample).as_recorded));
        // Whole equations with the wrong sign still hold, but no longer match the velocity matrix.
        let turned: System = |x| ACCELERATIONS(x).map(|r| -r);
        assert_eq!(
            Outcome::enclosed(&residuals(turned, &sample, &SPEEDS, 0)),
            Outcome::Holds
        );
        assert!(!accelerations(turned, &sample).as_recorded);
    }
}
