//! Masses, springs, dampers, forces and torques, and their reduction to the drive.
//!
//! With primes for derivatives with respect to the drive φ, the kinetic energy `½ I_n φ̇²` and the
//! power `(M_o − D φ̇) φ̇` of everything applied give
//!
//! ```text
//! I_n = Σ m |r'|² + J θ'²            dI_n/dφ = 2 Σ m r'·r'' + J θ' θ''
//! M_o = Σ F·r' + Σ T θ' − Σ c (L − l) L'            D = Σ b L'²
//! ```
//!
//! and the equation of motion `I_n φ̈ + ½ I_n' φ̇² = Q + M_o − D φ̇` under a drive torque (or
//! force) Q.

use super::mechanism::Mechanism;
use super::model::{GROUND, Point};
use super::state::State;
use crate::units::{Inertia, Length, Mass};

/// The mass of a body, and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyMass {
    /// The body's number.
    pub body: usize,
    /// Mass.
    pub mass: Mass,
    /// Moment of inertia about the centre of mass.
    pub inertia: Inertia,
    /// The centre of mass in the body's frame.
    pub centre: [Length; 2],
}

/// A value that is constant or a table over the drive.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// The same everywhere.
    Constant(f64),
    /// Pairs of drive (radians or metres) and value, ascending, joined by straight lines: over an
    /// angle periodic with a whole turn, over a displacement constant beyond the ends.
    Table(Vec<[f64; 2]>),
}

/// Describes what acts on a mechanism in addition to weight and drive. In SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Load {
    /// A force in newtons at a point.
    Force {
        /// Where it acts.
        at: Point,
        /// Components in the ground's axes, or in those of `along`.
        components: [Course; 2],
        /// The body whose axes they are given in.
        along: usize,
    },
    /// A torque in newton metres on a body, and its reaction on another (or the ground).
    Torque {
        /// The body that it turns forward.
        body: usize,
        /// The body that takes the reaction.
        from: usize,
        /// The torque.
        torque: Course,
    },
    /// A spring between two points: tension `stiffness (L − length)`.
    Spring {
        /// Its ends.
        ends: [Point; 2],
        /// In N/m.
        stiffness: f64,
        /// Its length without tension, in metres.
        length: f64,
    },
    /// A torsion spring: torque `−stiffness (θ − θ_from − angle)` on the body.
    TorsionSpring {
        /// The body.
        body: usize,
        /// The body that takes the reaction.
        from: usize,
        /// In N·m/rad.
        stiffness: f64,
        /// The difference of angles without torque, in radians.
        angle: f64,
    },
    /// A damper between two points: tension `damping L̇`.
    Damper {
        /// Its ends.
        ends: [Point; 2],
        /// In N·s/m.
        damping: f64,
    },
    /// A torsion damper: torque `−damping (θ̇ − θ̇_from)` on the body.
    TorsionDamper {
        /// The body.
        body: usize,
        /// The body that takes the reaction.
        from: usize,
        /// In N·m·s/rad.
        damping: f64,
    },
}

/// Why masses or loads are refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// A value is NaN or infinite.
    #[error("{what} = {value} is not a finite number")]
    NotFinite {
        /// Which.
        what: &'static str,
        /// Its value in SI units.
        value: f64,
    },
    /// A mass, inertia, stiffness, damping or length is negative.
    #[error("{what} = {value} must not be negative")]
    Negative {
        /// Which.
        what: &'static str,
        /// Its value in SI units.
        value: f64,
    },
    /// There is no such moving body.
    #[error("body {body} of {what} is none of the mechanism")]
    NoSuchBody {
        /// Of what.
        what: &'static str,
        /// The number.
        body: usize,
    },
    /// The mass of a body is given twice, or to the ground.
    #[error("the mass of body {body} is given twice, or to the ground")]
    Twice {
        /// The number.
        body: usize,
    },
    /// A table is empty, or its first column does not ascend within a turn.
    #[error(
        "a table has to hold at least one row, the drive ascending and, for an angle, within one turn"
    )]
    Table,
}

/// Masses and loads of a mechanism, checked.
#[derive(Clone, Debug)]
pub struct Loads {
    pub(super) masses: Vec<BodyMass>,
    pub(super) loads: Vec<Load>,
    pub(super) gravity: [f64; 2],
}

/// Describes what the drive feels: the reduced quantities at one position, in SI units for each
/// radian (or metre) of the drive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReducedLoads {
    /// I_n in kg·m² (kg for a displacement).
    pub inertia: f64,
    /// dI_n/dφ.
    pub inertia_derivative: f64,
    /// M_o in N·m (N), positive where it drives forward.
    pub moment: f64,
    /// dM_o/dφ.
    pub moment_derivative: f64,
    /// D in N·m·s (N·s/m).
    pub damping: f64,
}

impl ReducedLoads {
    /// The drive torque (or force) for the drive's speed and acceleration:
    /// `I_n φ̈ + ½ I_n' φ̇² − M_o + D φ̇`.
    pub fn drive(&self, speed: f64, acceleration: f64) -> f64 {
        self.inertia * acceleration + 0.5 * self.inertia_derivative * speed * speed - self.moment
            + self.damping * speed
    }
}

impl Course {
    fn check(&self, linear: bool) -> Result<(), LoadError> {
        match self {
            Course::Constant(value) => finite("a force or torque", *value),
            Course::Table(rows) => {
                for [x, y] in rows {
                    finite("a table's drive", *x)?;
                    finite("a table's value", *y)?;
                }
                let ascends = rows.windows(2).all(|w| w[0][0] < w[1][0]);
                let span = rows.last().zip(rows.first()).map(|(b, a)| b[0] - a[0]);
                let within = span.is_some_and(|s| linear || s < std::f64::consts::TAU);
                if ascends && within {
                    Ok(())
                } else {
                    Err(LoadError::Table)
                }
            }
        }
    }

    /// Value and slope at the drive; at a corner the slope to its right.
    pub(super) fn at(&self, drive: f64, linear: bool) -> [f64; 2] {
        let rows = match self {
            Course::Constant(value) => return [*value, 0.0],
            Course::Table(rows) => rows,
        };
        let turn = std::f64::consts::TAU;
        let first = rows[0];
        let x = if linear {
            drive
        } else {
            first[0] + (drive - first[0]).rem_euclid(turn)
        };
        let after = rows.partition_point(|r| r[0] <= x);
        let line = |a: [f64; 2], b: [f64; 2]| {
            let slope = (b[1] - a[1]) / (b[0] - a[0]);
            [a[1] + slope * (x - a[0]), slope]
        };
        match (after.checked_sub(1).map(|k| rows[k]), rows.get(after)) {
            (Some(a), Some(b)) => line(a, *b),
            (Some(a), None) if !linear => line(a, [first[0] + turn, first[1]]),
            (Some(a), None) => [a[1], 0.0],
            (None, _) => [first[1], 0.0],
        }
    }
}

fn finite(what: &'static str, value: f64) -> Result<(), LoadError> {
    match value.is_finite() {
        true => Ok(()),
        false => Err(LoadError::NotFinite { what, value }),
    }
}

fn not_negative(what: &'static str, value: f64) -> Result<(), LoadError> {
    finite(what, value)?;
    match value < 0.0 {
        true => Err(LoadError::Negative { what, value }),
        false => Ok(()),
    }
}

impl Loads {
    /// Masses and loads in a gravity field given by its acceleration in m/s², such as [0, −9.81].
    ///
    /// # Errors
    /// [`LoadError`] names the first value that breaks a rule.
    pub fn new(
        mechanism: &Mechanism,
        masses: Vec<BodyMass>,
        loads: Vec<Load>,
        gravity: [f64; 2],
    ) -> Result<Loads, LoadError> {
        let bodies = mechanism.description().bodies.len();
        let linear = mechanism.drive_is_displacement();
        Loads::checked(bodies, linear, masses, loads, gravity)
    }

    /// [`Loads::new`] for `bodies` bodies, the ground included, and tables over a displacement
    /// where `linear`.
    pub(super) fn checked(
        bodies: usize,
        linear: bool,
        masses: Vec<BodyMass>,
        loads: Vec<Load>,
        gravity: [f64; 2],
    ) -> Result<Loads, LoadError> {
        let last = bodies - 1;
        let body = |what, body: usize| match body <= last {
            true => Ok(()),
            false => Err(LoadError::NoSuchBody { what, body }),
        };
        let point = |p: &Point| {
            body("a point", p.body)?;
            p.at.iter().try_for_each(|x| finite("a coordinate", x.m()))
        };
        gravity.iter().try_for_each(|g| finite("gravity", *g))?;
        for (k, m) in masses.iter().enumerate() {
            body("a mass", m.body)?;
            if m.body == GROUND || masses[..k].iter().any(|o| o.body == m.body) {
                return Err(LoadError::Twice { body: m.body });
            }
            not_negative("mass", m.mass.kg())?;
            not_negative("inertia", m.inertia.kg_m2())?;
            m.centre
                .iter()
                .try_for_each(|x| finite("the centre of mass", x.m()))?;
        }
        for load in &loads {
            match load {
                Load::Force {
                    at,
                    components,
                    along,
                } => {
                    point(at)?;
                    body("a force", *along)?;
                    components.iter().try_for_each(|c| c.check(linear))?;
                }
                Load::Torque {
                    body: b,
                    from,
                    torque,
                } => {
                    body("a torque", *b)?;
                    body("a torque", *from)?;
                    torque.check(linear)?;
                }
                Load::Spring {
                    ends,
                    stiffness,
                    length,
                } => {
                    ends.iter().try_for_each(point)?;
                    not_negative("stiffness", *stiffness)?;
                    not_negative("length", *length)?;
                }
                Load::TorsionSpring {
                    body: b,
                    from,
                    stiffness,
                    angle,
                } => {
                    body("a spring", *b)?;
                    body("a spring", *from)?;
                    not_negative("stiffness", *stiffness)?;
                    finite("angle", *angle)?;
                }
                Load::Damper { ends, damping } => {
                    ends.iter().try_for_each(point)?;
                    not_negative("damping", *damping)?;
                }
                Load::TorsionDamper {
                    body: b,
                    from,
                    damping,
                } => {
                    body("a damper", *b)?;
                    body("a damper", *from)?;
                    not_negative("damping", *damping)?;
                }
            }
        }
        Ok(Loads {
            masses,
            loads,
            gravity,
        })
    }

    /// Returns whether anything acts with the speed.
    pub fn has_dampers(&self) -> bool {
        let damper = |l: &Load| matches!(l, Load::Damper { .. } | Load::TorsionDamper { .. });
        self.loads.iter().any(damper)
    }

    /// Returns whether there are torsion springs.
    pub fn has_torsion_springs(&self) -> bool {
        let spring = |l: &Load| matches!(l, Load::TorsionSpring { .. });
        self.loads.iter().any(spring)
    }

    /// Adds to the free angle of each torsion spring, in radians, by its body and the one that
    /// takes the reaction: a branch's own count of whole turns.
    pub fn shift_torsion_springs(&mut self, by: impl Fn(usize, usize) -> f64) {
        for load in &mut self.loads {
            if let Load::TorsionSpring {
                body, from, angle, ..
            } = load
            {
                *angle += by(*body, *from);
            }
        }
    }

    /// The reduced quantities at a position.
    pub fn reduce(&self, mechanism: &Mechanism, state: &State) -> ReducedLoads {
        let mut sum = ReducedLoads::default();
        for m in &self.masses {
            let [x, y] = m.centre;
            let c = mechanism.point(state, &Point::new(m.body, x, y));
            let (v, a, kg) = (c.first, c.second, m.mass.kg());
            let turn = mechanism.body_angle(state, m.body);
            let j = m.inertia.kg_m2();
            sum.inertia += kg * (v[0] * v[0] + v[1] * v[1]) + j * turn.first * turn.first;
            let change = kg * (v[0] * a[0] + v[1] * a[1]) + j * turn.first * turn.second;
            sum.inertia_derivative += 2.0 * change;
            let g = self.gravity;
            sum.moment += kg * (g[0] * v[0] + g[1] * v[1]);
            sum.moment_derivative += kg * (g[0] * a[0] + g[1] * a[1]);
        }
        for load in &self.loads {
            apply(mechanism, state, load, &mut sum);
        }
        sum
    }
}

/// Length and its derivatives of the line between two points.
pub(super) fn stretch(mechanism: &Mechanism, state: &State, ends: &[Point; 2]) -> [f64; 3] {
    let [p, q] = ends.map(|e| mechanism.point(state, &e));
    let d = |a: [f64; 2], b: [f64; 2]| [b[0] - a[0], b[1] - a[1]];
    let (r, v, a) = (d(p.r, q.r), d(p.first, q.first), d(p.second, q.second));
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let length = r[0].hypot(r[1]);
    let first = dot(r, v) / length;
    [
        length,
        first,
        (dot(v, v) + dot(r, a) - first * first) / length,
    ]
}

fn apply(mechanism: &Mechanism, state: &State, load: &Load, sum: &mut ReducedLoads) {
    let linear = mechanism.drive_is_displacement();
    let drive = mechanism.drive_of(state);
    let between = |body: usize, from: usize| {
        let (a, b) = (
            mechanism.body_angle(state, body),
            mechanism.body_angle(state, from),
        );
        [
            a.angle.rad() - b.angle.rad(),
            a.first - b.first,
            a.second - b.second,
        ]
    };
    match load {
        Load::Force {
            at,
            components,
            along,
        } => {
            let m = mechanism.point(state, at);
            let frame = mechanism.body_angle(state, *along);
            let (s, c) = frame.angle.rad().sin_cos();
            let [[x, dx], [y, dy]] = components.each_ref().map(|f| f.at(drive, linear));
            let f = [c * x - s * y, s * x + c * y];
            let w = frame.first;
            let df = [c * dx - s * dy - w * f[1], s * dx + c * dy + w * f[0]];
            sum.moment += f[0] * m.first[0] + f[1] * m.first[1];
            sum.moment_derivative += f[0] * m.second[0] + f[1] * m.second[1];
            sum.moment_derivative += df[0] * m.first[0] + df[1] * m.first[1];
        }
        Load::Torque { body, from, torque } => {
            let [t, dt] = torque.at(drive, linear);
            let [_, first, second] = between(*body, *from);
            sum.moment += t * first;
            sum.moment_derivative += t * second + dt * first;
        }
        Load::Spring {
            ends,
            stiffness,
            length,
        } => {
            let [l, first, second] = stretch(mechanism, state, ends);
            sum.moment -= stiffness * (l - length) * first;
            sum.moment_derivative -= stiffness * (first * first + (l - length) * second);
        }
        Load::TorsionSpring {
            body,
            from,
            stiffness,
            angle,
        } => {
            let [a, first, second] = between(*body, *from);
            sum.moment -= stiffness * (a - angle) * first;
            sum.moment_derivative -= stiffness * (first * first + (a - angle) * second);
        }
        Load::Damper { ends, damping } => {
            let first = stretch(mechanism, state, ends)[1];
            sum.damping += damping * first * first;
        }
        Load::TorsionDamper {
            body,
            from,
            damping,
        } => {
            let first = between(*body, *from)[1];
            sum.damping += damping * first * first;
        }
    }
}
