//! Rates and reduced quantities by differentiating the distance equations.
//!
//! With primes for derivatives with respect to φ1 and P for the vector of a link, `P·P = l²`
//! gives `P·P' = 0` and `P·P'' = −P'·P'`: linear systems with one matrix for (C', D') and
//! (C'', D''). A link turns at `φ' = P × P'/l²`, `φ'' = P × P''/l²`. The reduced moment is
//! `M_o = −dU/dφ1` with the potential energy `U = g Σ m y`.

use super::{Configuration, ExactAngle, Linkage};
use crate::{Ball, BallLu, ComplexBall, Undecided};
use rug::Rational;

/// Positions and derivatives with respect to the crank angle at one configuration.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// φ2, φ3, φ4, φ5 in radians, in `(−π, π]` (continued beyond where the ball crosses ±π).
    pub angles: [Ball; 4],
    /// `dφ/dφ1`.
    pub first: [Ball; 4],
    /// `d²φ/dφ1²`.
    pub second: [Ball; 4],
    /// Joints A, B, C, D.
    pub joints: [Jet; 4],
}

/// A point with its first two derivatives with respect to φ1.
#[derive(Clone, Debug)]
pub struct Jet {
    /// Position.
    pub r: ComplexBall,
    /// First derivative.
    pub first: ComplexBall,
    /// Second derivative.
    pub second: ComplexBall,
}

impl Jet {
    fn fixed(r: &ComplexBall) -> Jet {
        let zero = ComplexBall::zero(r.re.prec());
        Jet {
            r: r.clone(),
            first: zero.clone(),
            second: zero,
        }
    }

    /// An operation that is applied to each derivative.
    fn with(&self, o: &Jet, f: impl Fn(&ComplexBall, &ComplexBall) -> ComplexBall) -> Jet {
        Jet {
            r: f(&self.r, &o.r),
            first: f(&self.first, &o.first),
            second: f(&self.second, &o.second),
        }
    }

    fn minus(&self, o: &Jet) -> Jet {
        self.with(o, |a, b| a - b)
    }
}

/// A link's mass properties, exact.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Mass.
    pub mass: Rational,
    /// Moment of inertia.
    pub inertia: Rational,
    /// Tells whether the inertia is about the fixed pivot (else about the centre of mass).
    pub about_pivot: bool,
    /// Distance of the centre of mass from the link's origin.
    pub radius: Rational,
    /// Its direction from the link's axis.
    pub angle: ExactAngle,
}

/// The masses of links 1 to 5 and the gravity along −y.
#[derive(Clone, Debug, PartialEq)]
pub struct Masses {
    /// Links 1 to 5.
    pub bodies: [Body; 5],
    /// Acceleration of gravity.
    pub gravity: Rational,
}

/// The reduced quantities.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// I_n.
    pub inertia: Ball,
    /// dI_n/dφ1.
    pub inertia_derivative: Ball,
    /// M_o.
    pub moment: Ball,
    /// dM_o/dφ1.
    pub moment_derivative: Ball,
}

impl Linkage {
    /// Rates at an enclosed configuration.
    ///
    /// # Errors
    /// [`Undecided`] when the matrix cannot be told from a singular one.
    pub fn kinematics(&self, q: &Configuration) -> Result<Kinematics, Undecided> {
        let singular = || {
            Undecided::new(
                self.bits,
                "the velocity matrix cannot be told from a singular one",
            )
        };
        let matrix = self.velocity_matrix(q).ok_or_else(singular)?;
        let joints = self.joints(q, &matrix);
        let links = self.links(&joints);
        let squares = [&self.l2, &self.l3, &self.l4, &self.l5].map(Ball::square);
        Ok(Kinematics {
            angles: std::array::from_fn(|i| links[i].r.arg()),
            first: std::array::from_fn(|i| &links[i].r.cross(&links[i].first) / &squares[i]),
            second: std::array::from_fn(|i| &links[i].r.cross(&links[i].second) / &squares[i]),
            joints,
        })
    }

    /// Joints A, B, C, D with their derivatives.
    pub(super) fn joints(&self, q: &Configuration, matrix: &BallLu) -> [Jet; 4] {
        let zero = || Ball::integer(self.bits, 0);
        let a1 = q.e1.turned().scaled(&self.l1);
        let a2 = -&q.a;
        let arm = &q.b - &q.a;
        let point = |x: &[Ball]| {
            let part = |i: usize| ComplexBall::new(x[i].clone(), x[i + 1].clone());
            (part(0), part(2))
        };
        let (c1, d1) = point(&matrix.solve(&[zero(), zero(), zero(), arm.dot(&a1)]));
        let b1 = self.joint_b(&c1, &d1);
        let (c2, d2) = point(&matrix.solve(&[
            -c1.norm_sqr(),
            -d1.norm_sqr(),
            -(&d1 - &c1).norm_sqr(),
            arm.dot(&a2) - (&b1 - &a1).norm_sqr(),
        ]));
        let b2 = self.joint_b(&c2, &d2);
        let jet = |r: &ComplexBall, first: ComplexBall, second: ComplexBall| Jet {
            r: r.clone(),
            first,
            second,
        };
        [
            jet(&q.a, a1, a2),
            jet(&q.b, b1, b2),
            jet(&q.c, c1, c2),
            jet(&q.d, d1, d2),
        ]
    }

    /// The matrix of the velocity equations, factored.
    pub(super) fn velocity_matrix(&self, q: &Configuration) -> Option<BallLu> {
        BallLu::new(self.jacobian(&q.a, &q.c, &q.d).map(|r| r.to_vec()).to_vec())
    }

    /// Links 2 to 5 as vectors, from joints A, B, C, D.
    pub(super) fn links(&self, [a, b, c, d]: &[Jet; 4]) -> [Jet; 4] {
        [
            b.minus(a),
            c.minus(&Jet::fixed(&self.o3)),
            d.minus(c),
            d.minus(&Jet::fixed(&self.o5)),
        ]
    }

    /// By what a link's vector is to be multiplied to give its centre of mass.
    pub(super) fn centre_turns(&self, masses: &Masses) -> [ComplexBall; 5] {
        let lengths = [&self.l1, &self.l2, &self.l3, &self.l4, &self.l5];
        std::array::from_fn(|i| {
            let body = &masses.bodies[i];
            let share = &Ball::rational(self.bits, &body.radius) / lengths[i];
            ComplexBall::unit(&body.angle.to_ball(self.bits)).scaled(&share)
        })
    }

    /// The centres of mass of links 1 to 5.
    pub fn centres(&self, joints: &[Jet; 4], masses: &Masses) -> [Jet; 5] {
        let [a, b, c, d] = joints;
        let o1 = Jet::fixed(&ComplexBall::zero(self.bits));
        let o3 = Jet::fixed(&self.o3);
        let o5 = Jet::fixed(&self.o5);
        let ends = [(&o1, a), (a, b), (&o3, c), (c, d), (&o5, d)];
        let turns = self.centre_turns(masses);
        std::array::from_fn(|i| {
            let (from, to) = ends[i];
            from.with(&to.minus(from), |from, link| from + &(link * &turns[i]))
        })
    }

    /// The reduced quantities.
    pub fn reduce(&self, k: &Kinematics, masses: &Masses) -> Reduced {
        let b = |q: &Rational| Ball::rational(self.bits, q);
        let zero = || Ball::integer(self.bits, 0);
        let one = Ball::integer(self.bits, 1);
        let (mut inertia, mut derivative, mut moment, mut slope) = (zero(), zero(), zero(), zero());
        for (i, s) in self.centres(&k.joints, masses).iter().enumerate() {
            let body = &masses.bodies[i];
            let (m, j) = (b(&body.mass), b(&body.inertia));
            let nothing = zero();
            let (w, e) = match i {
                0 => (&one, &nothing),
                _ => (&k.first[i - 1], &k.second[i - 1]),
            };
            if !body.about_pivot {
                inertia = inertia + &m * &s.first.norm_sqr();
                derivative = derivative + (&m * &s.first.dot(&s.second)).shift(1);
            }
            inertia = inertia + &j * &w.square();
            derivative = derivative + (&j * &(w * e)).shift(1);
            moment = moment - &m * &s.first.im;
            slope = slope - &m * &s.second.im;
        }
        let g = b(&masses.gravity);
        Reduced {
            inertia,
            inertia_derivative: derivative,
            moment: moment * &g,
            moment_derivative: slope * &g,
        }
    }
}
