//! Positions, and first and second derivatives with respect to the crank angle.

use super::closure::{Accelerations, Closing, Links};
use super::geometry::ClassIii;
use super::loops::{Frame, Jacobian, dot, unit};
use super::positions::Positions;
use crate::double_double::Dd;
use crate::lanes::with_best;
use crate::units::{Angle, AngularVelocity};
use num_complex::Complex64;

/// First and second derivatives of the links' angles with respect to φ1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// `dφ/dφ1` of links 2, 3, 4, 5: the ratios ω/ω1.
    pub first: [f64; 4],
    /// `d²φ/dφ1²` of links 2, 3, 4, 5, per radian.
    pub second: [f64; 4],
}

impl Rates {
    /// Angular velocities in rad/s and accelerations in rad/s² of links 2, 3, 4, 5 when the crank
    /// turns at ω1 with the acceleration ε1 in rad/s²: `ω = φ' ω1`, `ε = φ'' ω1² + φ' ε1`.
    pub fn at_crank_speed(&self, omega1: AngularVelocity, epsilon1: f64) -> ([f64; 4], [f64; 4]) {
        let w = omega1.rad_per_s();
        let omega = self.first.map(|f| f * w);
        let epsilon = std::array::from_fn(|i| self.second[i] * w * w + self.first[i] * epsilon1);
        (omega, epsilon)
    }
}

/// Position of a point and its first two derivatives with respect to φ1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion {
    /// Position in metres.
    pub r: [f64; 2],
    /// `dr/dφ1` in metres per radian.
    pub first: [f64; 2],
    /// `d²r/dφ1²` in metres per radian².
    pub second: [f64; 2],
}

/// The linkage at one crank angle: positions, rates and how far it is from being singular.
#[derive(Clone, Copy, Debug)]
pub struct State {
    /// Crank angle in radians.
    pub phi1: f64,
    /// Angles of the links.
    pub positions: Positions,
    /// Their derivatives.
    pub rates: Rates,
    /// Determinant of the loop equations' Jacobian, in m⁴; it changes sign from branch to branch
    /// at a singular position.
    pub determinant: f64,
    /// `‖J⁻¹‖ K`, with the norm and the Lipschitz constant K that [`ClassIii::follow`] uses: an
    /// upper bound on the condition number of the loop equations.
    pub condition: f64,
    /// Angle in radians between link 2 and the path of B, in [0, π/2]: 0 is best, π/2 is a
    /// singular position.
    pub pressure_angle: f64,
    frame: Frame,
    e1: Complex64,
    l: super::geometry::Lengths,
}

/// First derivatives at one crank angle, with the factored matrix that they came from.
#[derive(Clone, Copy, Debug)]
pub struct Velocities {
    /// `dφ/dφ1` of links 2, 3, 4, 5.
    pub first: [f64; 4],
    refined: [Dd; 4],
    links: Links,
    jacobian: Jacobian,
    frame: Frame,
    phi1: f64,
    e1: Complex64,
    l: super::geometry::Lengths,
}

/// At this position the determinant of the velocity equations is zero, or beyond the range of
/// `f64`.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the position at the crank angle {phi1} rad is singular: its velocity equations have no solution"
)]
pub struct SingularPosition {
    /// Crank angle in radians.
    pub phi1: f64,
}

impl Velocities {
    /// `d²φ/dφ1²` of links 2, 3, 4, 5: another right-hand side for the same factors.
    ///
    /// # Errors
    /// The position is singular.
    pub fn accelerations(&self) -> Result<[f64; 4], SingularPosition> {
        let task = Accelerations {
            links: &self.links,
            first: &self.refined,
            jacobian: &self.jacobian,
        };
        with_best(task).ok_or(SingularPosition { phi1: self.phi1 })
    }

    /// `dr/dφ1` in metres of the point with the polar vector `s` in the link's frame.
    pub(crate) fn point_along(&self, link: Link, s: Complex64) -> [f64; 2] {
        let (l, f, d) = (&self.l, &self.frame, &self.first);
        let turn = |z: Complex64, w: f64| Complex64::new(-z.im * w, z.re * w);
        let v = match link {
            Link::Crank => turn(self.e1 * s, 1.0),
            Link::Link2 => turn(self.e1 * l.l1, 1.0) + turn(f.e2 * s, d[0]),
            Link::Link3 => turn(f.e3 * s, d[1]),
            Link::Link4 => turn(f.e3 * l.l3, d[1]) + turn(f.e4 * s, d[2]),
            Link::Link5 => turn(f.e5 * s, d[3]),
        };
        [v.re, v.im]
    }
}

impl ClassIii {
    /// First derivatives at a configuration that closes the loops.
    ///
    /// # Errors
    /// The position is singular.
    pub fn velocities(
        &self,
        phi1: Angle,
        positions: Positions,
    ) -> Result<Velocities, SingularPosition> {
        let phi1 = phi1.rad();
        let l = &self.l;
        let e1 = unit(phi1);
        let frame = Frame::new(l, &positions);
        let jacobian = Jacobian::new(l, &frame);
        let task = Closing {
            l,
            e1,
            frame: &frame,
            jacobian: &jacobian,
        };
        let (links, frame, refined) = with_best(task).ok_or(SingularPosition { phi1 })?;
        Ok(Velocities {
            first: refined.map(Dd::value),
            refined,
            links,
            jacobian,
            frame,
            phi1,
            e1,
            l: *l,
        })
    }

    /// Rates at a configuration that closes the loops.
    ///
    /// The accelerations use the same factored matrix as the velocities.
    ///
    /// # Errors
    /// The position is singular.
    pub fn state(&self, phi1: Angle, positions: Positions) -> Result<State, SingularPosition> {
        let l = &self.l;
        let v = self.velocities(phi1, positions)?;
        let second = v.accelerations()?;
        let (f, jacobian, i) = (v.frame, v.jacobian, Complex64::i());
        // Path of B when the second loop moves freely; det M = e2 · path.
        let path =
            i * f.e3 * (l.l3 * -jacobian.m[(1, 1)]) + i * f.e4b * (l.lb * jacobian.m[(1, 0)]);
        let along = dot(f.e2, path).abs();
        let across = super::loops::cross(f.e2, path).abs();
        Ok(State {
            phi1: phi1.rad(),
            positions,
            rates: Rates {
                first: v.first,
                second,
            },
            determinant: jacobian.determinant(),
            condition: jacobian.inverse_norm() * l.lipschitz(),
            pressure_angle: across.atan2(along),
            frame: f,
            e1: v.e1,
            l: *l,
        })
    }
}

/// A link on which a point may be fixed, with the frame its polar coordinates are given in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// Crank: from O1 along O1–A.
    Crank,
    /// Link 2: from A along A–B.
    Link2,
    /// Rocker 3: from O3 along O3–C.
    Link3,
    /// Ternary link 4: from C along C–D.
    Link4,
    /// Rocker 5: from O5 along O5–D.
    Link5,
}

impl State {
    /// The motion of the point at distance `r` metres and angle `a` radians in the link's frame.
    pub fn point(&self, link: Link, r: f64, a: f64) -> PointMotion {
        self.point_along(link, unit(a) * r)
    }

    /// As [`State::point`] with the polar vector `r e(a)` already formed.
    pub(crate) fn point_along(&self, link: Link, s: Complex64) -> PointMotion {
        let l = &self.l;
        let f = &self.frame;
        let (d, dd) = (&self.rates.first, &self.rates.second);
        // A vector z turning by φ: z' = i φ' z, z'' = (i φ'' − φ'²) z.
        let turn = |z: Complex64, w: f64, e: f64| {
            let first = Complex64::new(-z.im * w, z.re * w);
            let second = Complex64::new(-z.im * e - z.re * (w * w), z.re * e - z.im * (w * w));
            (z, first, second)
        };
        let fixed = |o: Complex64| (o, Complex64::new(0.0, 0.0), Complex64::new(0.0, 0.0));
        let (base, arm) = match link {
            Link::Crank => (fixed(Complex64::new(0.0, 0.0)), turn(self.e1 * s, 1.0, 0.0)),
            Link::Link2 => (turn(self.e1 * l.l1, 1.0, 0.0), turn(f.e2 * s, d[0], dd[0])),
            Link::Link3 => (fixed(l.o3), turn(f.e3 * s, d[1], dd[1])),
            Link::Link4 => {
                let (z, a, b) = turn(f.e3 * l.l3, d[1], dd[1]);
                ((l.o3 + z, a, b), turn(f.e4 * s, d[2], dd[2]))
            }
            Link::Link5 => (fixed(l.o5), turn(f.e5 * s, d[3], dd[3])),
        };
        let pair = |z: Complex64| [z.re, z.im];
        PointMotion {
            r: pair(base.0 + arm.0),
            first: pair(base.1 + arm.1),
            second: pair(base.2 + arm.2),
        }
    }

    /// The joints A, B, C, D in metres.
    pub fn joints(&self) -> [[f64; 2]; 4] {
        let l = &self.l;
        let a = self.e1 * l.l1;
        let c = l.o3 + self.frame.e3 * l.l3;
        let b = c + self.frame.e4b * l.lb;
        let d = c + self.frame.e4 * l.l4;
        [a, b, c, d].map(|z| [z.re, z.im])
    }
}
