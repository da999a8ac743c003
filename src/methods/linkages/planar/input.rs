//! Describes what the methods of planar linkages take, as solver and reference take it.

use crate::audit::Uncertified;
use crate::methods::definition::exact;
use crate::methods::inputs::{Fields, Number, inputs};
use crate::reference::Ball;
use crate::reference::planar::{
    Attachment, Body, Drive, Forces, Joint, Linkage, Mechanism, Position,
};
use crate::solvers::planar::{self as solver, BodyMass, GROUND, Loads, NearestError, State};
use crate::solvers::units::{Angle, Inertia, Length, Mass};
use rug::Rational;
use std::cell::RefCell;

inputs! {
    /// Bodies joined by pins, the first of them turned from the ground; where they are, about.
    pub struct PlanarLinkageInput {
        bodies: choice "bodies (moving ones; the drive turns the first)", "1";
        pins: choice "pins (2 pins + 1 = 3 bodies)", "1";
        phi: number "phi", "rad";
        a: choices "a[pins] (one body of each pin; 0 is the ground)", "1";
        b: choices "b[pins] (its other body)", "1";
        xa: list "xa[pins] (the pin in the frame of a)", "m";
        ya: list "ya[pins]", "m";
        xb: list "xb[pins] (the pin in the frame of b)", "m";
        yb: list "yb[pins]", "m";
        xs: list "xs[bodies] (centre of mass in the body's frame)", "m";
        ys: list "ys[bodies]", "m";
        near: choices "near[bodies] (angles within 0.1 rad of which the position lies)", "rad";
    }
}

inputs! {
    /// A planar linkage in motion with masses.
    pub struct PlanarForcesInput {
        speed: number "speed", "rad/s";
        acceleration: number "acceleration", "rad/s^2";
        gx: number "gx", "m/s^2";
        gy: number "gy", "m/s^2";
        linkage: (PlanarLinkageInput);
        m: list "m[bodies]", "kg";
        j: list "J[bodies] (about the centre of mass)", "kg m^2";
    }
}

/// The largest distance of the angles from `near`.
pub(super) const REACH: f64 = 0.1;
/// Bits that prove most positions.
pub(super) const BITS: u32 = 64;
/// More bodies than this are not taken: what the solver's homotopy is for.
const MOST_BODIES: usize = 9;

thread_local! {
    /// The linkage whose angles were asked for last, and these: conditions and laws of a case ask one after another.
    static LAST: RefCell<(Vec<f64>, Option<Vec<f64>>)> = const { RefCell::new((Vec::new(), None)) };
}

/// The word where no position is within reach.
pub(super) const NONE: &str = "no position near";

/// The proof of the reference.
pub(super) const PROOF: &str = "Krawczyk (1969); no nearer position by a one-to-one map on the cube around the \
    angles given; Taylor arithmetic in balls";
/// The source of the equations.
pub(super) const SOURCE: &str = "closed loops of rigid bodies, differentiated; Assur groups: Artobolevskii, Theory of Mechanisms and Machines";

impl<T: Number> PlanarLinkageInput<'_, T> {
    /// The bodies of each pin; nothing if the counts or the bodies are none.
    pub(super) fn joined(&self) -> Option<Vec<[usize; 2]>> {
        let few = 0.0..=f64::from(u8::MAX);
        let count = |x: f64| (x.fract() == 0.0 && few.contains(&x)).then_some(x as usize);
        let bodies = count(T::near(self.bodies)).filter(|n| (1..=MOST_BODIES).contains(n))?;
        let pins = count(T::near(self.pins)).filter(|p| 2 * p + 1 == 3 * bodies)?;
        let body = |x: &T| count(x.nearest()).filter(|b| *b <= bodies);
        let joined = |k: usize| {
            let pair = [body(&self.a[k])?, body(&self.b[k])?];
            (pair[0] != pair[1]).then_some(pair)
        };
        (0..pins).map(joined).collect()
    }
}

impl PlanarLinkageInput<'_> {
    /// The mechanism, as the solver takes it.
    pub(super) fn solver(&self) -> Result<solver::Mechanism, &'static str> {
        let mut all = solver::Description::new();
        let joined = self.joined().ok_or("bad layout")?;
        for k in 1..=self.near.len() {
            all.body(k.to_string());
        }
        for (k, [a, b]) in joined.into_iter().enumerate() {
            let ends = [(a, [self.xa[k], self.ya[k]]), (b, [self.xb[k], self.yb[k]])];
            all.pin(k.to_string(), &ends);
        }
        all.drive = solver::Drive::Angle {
            body: 1,
            from: GROUND,
        };
        solver::Mechanism::new(all).map_err(|_| "structure")
    }

    /// The position that the solver finds nearest to `near`.
    pub(super) fn state(&self, mechanism: &solver::Mechanism) -> Result<State, &'static str> {
        let near: Vec<Angle> = self.near.iter().map(|&x| Angle::from_rad(x)).collect();
        let found = mechanism.nearest(self.phi, &near, Angle::from_rad(REACH));
        found.map_err(|e| match e {
            NearestError::NoneWithin { .. } => NONE,
            _ => "unsolved",
        })
    }

    /// Returns nine values for each moving body, as the solver finds them.
    pub(super) fn motion(&self) -> Result<Vec<f64>, &'static str> {
        let mechanism = self.solver()?;
        let state = self.state(&mechanism)?;
        let mut all = Vec::new();
        for k in 0..self.near.len() {
            let turn = mechanism.body_angle(&state, k + 1);
            all.extend([turn.angle.rad(), turn.first, turn.second]);
            let c = mechanism.point(&state, &self.centre(k));
            all.extend([c.r, c.first, c.second].concat());
        }
        Ok(all)
    }

    /// Returns the same numbers as exact fractions, for `of`; nothing if one is not finite.
    pub(super) fn exactly<R>(
        &self,
        of: impl FnOnce(PlanarLinkageInput<Rational>) -> R,
    ) -> Option<R> {
        let numbers = exact(&self.to_vec())?;
        Some(of(PlanarLinkageInput::unpack(&numbers)?))
    }

    /// Checks that the reference finds a position.
    pub(super) fn is_placed(&self) -> bool {
        self.angles_by_few_bits().is_some()
    }

    /// The angles that conditions are taken at: with few bits if they are enough to prove the
    /// position.
    pub(super) fn angles(&self) -> Option<Vec<f64>> {
        let more = || self.exactly(|i| i.angles(2 * BITS)).flatten();
        self.angles_by_few_bits().or_else(more)
    }

    fn angles_by_few_bits(&self) -> Option<Vec<f64>> {
        let numbers = self.to_vec();
        let last = LAST.with_borrow(|(of, angles)| (*of == numbers).then(|| angles.clone()));
        last.unwrap_or_else(|| {
            let angles = self.exactly(|i| i.angles(BITS)).flatten();
            LAST.set((numbers, angles.clone()));
            angles
        })
    }

    /// The centre of mass of moving body k.
    pub(super) fn centre(&self, k: usize) -> solver::Point {
        solver::Point::from_m(k + 1, [self.xs[k], self.ys[k]])
    }
}

impl PlanarLinkageInput<'_, Rational> {
    /// The linkage, as the reference takes it, its bodies with these masses and inertias.
    fn exact(&self, masses: &[[Rational; 2]], bits: u32) -> Result<Linkage, Uncertified> {
        let joined = self.joined().ok_or(Uncertified::Refused("bad layout"))?;
        let at = |body: usize, x: &Rational, y: &Rational| {
            let point = [x.clone(), y.clone()];
            match body.checked_sub(1) {
                None => Attachment::ground(point),
                Some(k) => Attachment::body(k, point),
            }
        };
        let pin = |(k, &[a, b]): (usize, &[usize; 2])| Joint::Pin {
            a: at(a, &self.xa[k], &self.ya[k]),
            b: at(b, &self.xb[k], &self.yb[k]),
        };
        let body = |(k, [mass, inertia]): (usize, &[Rational; 2])| Body {
            mass: mass.clone(),
            inertia: inertia.clone(),
            centre: [self.xs[k].clone(), self.ys[k].clone()],
            ..Body::massless("")
        };
        let bodies = masses.iter().enumerate().map(body).collect();
        let joints = joined.iter().enumerate().map(pin).collect();
        Mechanism::new(bodies, joints)
            .and_then(|m| Linkage::new(&m, &Drive::coordinate(0), bits))
            .map_err(|_| Uncertified::Refused("structure"))
    }

    /// The linkage without masses and the position nearest to `near`.
    pub(super) fn placed(&self, bits: u32) -> Result<(Linkage, Position), Uncertified> {
        self.at_nearest(self.massless(bits)?)
    }

    fn at_nearest(&self, linkage: Linkage) -> Result<(Linkage, Position), Uncertified> {
        let near: Vec<f64> = self.near.iter().map(Rational::to_f64).collect();
        let phi = Ball::rational(linkage.bits(), self.phi);
        let position = linkage.nearest(&phi, &near, REACH)?;
        Ok((linkage, position.ok_or(Uncertified::Refused(NONE))?))
    }

    /// The linkage without masses.
    pub(super) fn massless(&self, bits: u32) -> Result<Linkage, Uncertified> {
        let nothing = vec![[Rational::new(), Rational::new()]; self.near.len()];
        self.exact(&nothing, bits)
    }

    /// The angles of the position.
    fn angles(&self, bits: u32) -> Option<Vec<f64>> {
        let (_, position) = self.placed(bits).ok()?;
        Some(position.x.iter().map(Ball::to_f64).collect())
    }

    fn placed_with(
        &self,
        masses: &[[Rational; 2]],
        bits: u32,
    ) -> Result<(Linkage, Position), Uncertified> {
        self.at_nearest(self.exact(masses, bits)?)
    }
}

impl PlanarForcesInput<'_> {
    /// Masses and gravity, as the solver takes them.
    pub(super) fn loads(&self, mechanism: &solver::Mechanism) -> Result<Loads, &'static str> {
        let mass = |k: usize| BodyMass {
            body: k + 1,
            mass: Mass::from_kg(self.m[k]),
            inertia: Inertia::from_kg_m2(self.j[k]),
            centre: [self.linkage.xs[k], self.linkage.ys[k]].map(Length::from_m),
        };
        let masses = (0..self.m.len()).map(mass).collect();
        Loads::new(mechanism, masses, Vec::new(), [self.gx, self.gy]).map_err(|_| "masses")
    }

    /// Returns the two components of each pin's force, as the solver finds them.
    pub(super) fn forces(&self) -> Result<Vec<f64>, &'static str> {
        let mechanism = self.linkage.solver()?;
        let loads = self.loads(&mechanism)?;
        let state = self.linkage.state(&mechanism)?;
        let found = loads
            .reactions(&mechanism, &state, self.speed, self.acceleration)
            .map_err(|_| "singular")?;
        Ok(found.joints.iter().flat_map(|j| j.force_n).collect())
    }

    /// Checks that the reference finds a position of the linkage, and that masses are not negative.
    pub(super) fn is_placed(&self) -> bool {
        let heavy = self.m.iter().chain(self.j).all(|x| *x >= 0.0);
        heavy && self.linkage.is_placed()
    }
}

impl PlanarForcesInput<'_, Rational> {
    /// The linkage with its masses and the position nearest to `near`.
    pub(super) fn placed(&self, bits: u32) -> Result<(Linkage, Position), Uncertified> {
        if self.m.iter().chain(self.j).any(|x| *x < 0) {
            return Err(Uncertified::Refused("masses"));
        }
        let pairs = self.m.iter().zip(self.j);
        let masses: Vec<_> = pairs.map(|(m, j)| [m.clone(), j.clone()]).collect();
        self.linkage.placed_with(&masses, bits)
    }

    /// Its weight.
    pub(super) fn weight(&self) -> Forces {
        Forces {
            drive: Rational::new(),
            springs: Vec::new(),
            gravity: [self.gx.clone(), self.gy.clone()],
        }
    }
}
