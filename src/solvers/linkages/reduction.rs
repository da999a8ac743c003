//! Reduction of masses and weights to the crank.
//!
//! With primes for derivatives with respect to the crank angle φ1, the kinetic energy
//! `T = ½ I_n ω1²` and the power of the weights `M_o ω1` give
//!
//! ```text
//! I_n      = Σ m |r'|² + J φ'²                     (Zinchenko 2008, (3), (4))
//! dI_n/dφ1 = 2 Σ m r'·r'' + J φ' φ''               (5)
//! M_o      = −g Σ m y'                             (7), y up
//! dM_o/dφ1 = −g Σ m y''
//! ```
//!
//! where r is a body's centre of mass. They do not depend on the crank's speed. A rocker's inertia
//! may be given about its fixed pivot, as the paper does for links 3 and 5; its mass then enters
//! the weight only.

use super::class_iii::{ClassIii, Link, PointMotion, State, Velocities};
use crate::units::{Acceleration, Angle, Inertia, Length, Mass};
use num_complex::Complex64;

/// The axis a moment of inertia is taken about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MomentOfInertia {
    /// About the centre of mass: the kinetic energy is `½ m v² + ½ J ω²`.
    AboutCentreOfMass(Inertia),
    /// About the fixed pivot of a crank or rocker: the kinetic energy is `½ J ω²`.
    AboutPivot(Inertia),
}

impl MomentOfInertia {
    /// The moment of inertia, whatever the axis.
    pub fn inertia(self) -> Inertia {
        match self {
            MomentOfInertia::AboutCentreOfMass(j) | MomentOfInertia::AboutPivot(j) => j,
        }
    }
}

/// The mass of one link and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Mass.
    pub mass: Mass,
    /// Moment of inertia about an axis normal to the plane.
    pub inertia: MomentOfInertia,
    /// Distance of the centre of mass from the origin of the link's frame ([`Link`]).
    pub radius: Length,
    /// Its direction in the link's frame, counter-clockwise from the link's axis.
    pub angle: Angle,
}

/// Why a body is refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum BodyError {
    /// A property is NaN or infinite.
    #[error("{name} of link {link} = {value} is not a finite number")]
    NotFinite {
        /// The property.
        name: &'static str,
        /// The link's number.
        link: usize,
        /// Its value in SI units.
        value: f64,
    },
    /// A mass, inertia or radius is negative.
    #[error("{name} of link {link} = {value} {unit} must not be negative")]
    Negative {
        /// The property.
        name: &'static str,
        /// The link's number.
        link: usize,
        /// Its value in SI units.
        value: f64,
        /// The SI unit.
        unit: &'static str,
    },
    /// The inertia of a floating link is given about a pivot it does not have.
    #[error("link {link} has no fixed pivot: give its inertia about the centre of mass")]
    NoPivot {
        /// The link's number.
        link: usize,
    },
}

/// Describes what the crank feels: the reduced quantities at one position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduced {
    /// I_n in kg·m².
    pub inertia_kg_m2: f64,
    /// dI_n/dφ1 in kg·m²/rad.
    pub inertia_derivative_kg_m2: f64,
    /// M_o in N·m, positive when the weights drive the crank forward.
    pub moment_n_m: f64,
    /// dM_o/dφ1 in N·m/rad.
    pub moment_derivative_n_m: f64,
}

/// The motion of a body's centre of mass and its rotation.
#[derive(Clone, Copy, Debug)]
pub struct BodyMotion {
    /// Centre of mass.
    pub centre: PointMotion,
    /// `φ'`.
    pub first: f64,
    /// `φ''`.
    pub second: f64,
}

/// The masses of a linkage with a crank and a class-III group, checked.
#[derive(Clone, Copy, Debug)]
pub struct Masses {
    bodies: [Body; 5],
    /// Polar vectors to the centres of mass.
    arms: [Complex64; 5],
    gravity: f64,
}

const LINKS: [Link; 5] = [
    Link::Crank,
    Link::Link2,
    Link::Link3,
    Link::Link4,
    Link::Link5,
];

impl Masses {
    /// The masses of links 1 to 5 in a gravity field along −y.
    ///
    /// # Errors
    /// [`BodyError`] names the first property that breaks a rule: finite; mass, inertia, radius
    /// and gravity not negative; no pivot on floating links.
    pub fn new(bodies: [Body; 5], gravity: Acceleration) -> Result<Masses, BodyError> {
        for (i, b) in bodies.iter().enumerate() {
            let floating = matches!(LINKS[i], Link::Link2 | Link::Link4);
            check_body(i + 1, b, floating, gravity)?;
        }
        Ok(Masses {
            bodies,
            arms: bodies.map(|b| {
                let (s, c) = b.angle.rad().sin_cos();
                Complex64::new(c, s) * b.radius.m()
            }),
            gravity: gravity.m_per_s2(),
        })
    }

    /// The bodies.
    pub fn bodies(&self) -> &[Body; 5] {
        &self.bodies
    }

    /// The motion of the five bodies at a position.
    pub fn motions(&self, state: &State) -> [BodyMotion; 5] {
        let r = &state.rates;
        std::array::from_fn(|i| {
            let (first, second) = match i {
                0 => (1.0, 0.0),
                _ => (r.first[i - 1], r.second[i - 1]),
            };
            BodyMotion {
                centre: state.point_along(LINKS[i], self.arms[i]),
                first,
                second,
            }
        })
    }

    /// The reduced quantities at a position.
    pub fn reduce(&self, state: &State) -> Reduced {
        let motions = self.motions(state);
        reduce(
            self.bodies.iter().zip(&motions).map(|(b, m)| (*b, *m)),
            self.gravity,
        )
    }

    /// I_n (kg·m²) and M_o (N·m), which need no accelerations.
    pub fn inertia_and_moment(&self, v: &Velocities) -> (f64, f64) {
        let (mut inertia, mut moment) = (0.0, 0.0);
        for (i, body) in self.bodies.iter().enumerate() {
            let w = if i == 0 { 1.0 } else { v.first[i - 1] };
            let [x, y] = v.point_along(LINKS[i], self.arms[i]);
            let m = body.mass.kg();
            if let MomentOfInertia::AboutCentreOfMass(_) = body.inertia {
                inertia += m * (x * x + y * y);
            }
            inertia += body.inertia.inertia().kg_m2() * w * w;
            moment -= m * self.gravity * y;
        }
        (inertia, moment)
    }

    /// The reduced quantities at each of many positions, on all cores.
    #[cfg(feature = "parallel")]
    pub fn reduce_parallel(&self, states: &[State]) -> Vec<Reduced> {
        use rayon::prelude::*;
        states.par_iter().map(|s| self.reduce(s)).collect()
    }
}

/// The rules for one body: finite; mass, inertia, radius and gravity not negative; no pivot on
/// a floating link.
pub(crate) fn check_body(
    link: usize,
    b: &Body,
    floating: bool,
    gravity: Acceleration,
) -> Result<(), BodyError> {
    let values = [
        ("mass", b.mass.kg(), "kg"),
        ("inertia", b.inertia.inertia().kg_m2(), "kg·m²"),
        ("centre-of-mass radius", b.radius.m(), "m"),
        ("gravity", gravity.m_per_s2(), "m/s²"),
    ];
    for (name, value, unit) in values {
        if !value.is_finite() {
            return Err(BodyError::NotFinite { name, link, value });
        }
        if value < 0.0 {
            return Err(BodyError::Negative {
                name,
                link,
                value,
                unit,
            });
        }
    }
    let value = b.angle.rad();
    if !value.is_finite() {
        let name = "centre-of-mass angle";
        return Err(BodyError::NotFinite { name, link, value });
    }
    match floating && matches!(b.inertia, MomentOfInertia::AboutPivot(_)) {
        true => Err(BodyError::NoPivot { link }),
        false => Ok(()),
    }
}

/// Reduces any set of bodies to the crank; `gravity` in m/s² along −y.
pub fn reduce(bodies: impl IntoIterator<Item = (Body, BodyMotion)>, gravity: f64) -> Reduced {
    let mut sum = Reduced {
        inertia_kg_m2: 0.0,
        inertia_derivative_kg_m2: 0.0,
        moment_n_m: 0.0,
        moment_derivative_n_m: 0.0,
    };
    for (body, motion) in bodies {
        let m = body.mass.kg();
        let j = body.inertia.inertia().kg_m2();
        let (v, a) = (motion.centre.first, motion.centre.second);
        if let MomentOfInertia::AboutCentreOfMass(_) = body.inertia {
            sum.inertia_kg_m2 += m * (v[0] * v[0] + v[1] * v[1]);
            sum.inertia_derivative_kg_m2 += 2.0 * m * (v[0] * a[0] + v[1] * a[1]);
        }
        sum.inertia_kg_m2 += j * motion.first * motion.first;
        sum.inertia_derivative_kg_m2 += 2.0 * j * motion.first * motion.second;
        sum.moment_n_m -= m * gravity * v[1];
        sum.moment_derivative_n_m -= m * gravity * a[1];
    }
    sum
}

/// Positions, rates and reduced quantities of one crank angle.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The linkage.
    pub state: State,
    /// The reduced quantities.
    pub reduced: Reduced,
}

impl ClassIii {
    /// Follows the branch of `start` over the crank angles and reduces at each.
    ///
    /// # Errors
    /// With the rows up to there, when the branch ends.
    pub fn rows(
        &self,
        masses: &Masses,
        start: &State,
        angles: impl IntoIterator<Item = Angle>,
    ) -> Result<Vec<Row>, (Vec<Row>, super::class_iii::ContinuationError)> {
        let row = |state: State| Row {
            state,
            reduced: masses.reduce(&state),
        };
        let rows = |states: Vec<State>| states.into_iter().map(row).collect();
        self.sweep(start, angles)
            .map(rows)
            .map_err(|(states, e)| (rows(states), e))
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::class_iii::tests::{paper, zinchenko};

    fn body(mass: f64, inertia: MomentOfInertia, radius_cm: f64, angle_deg: f64) -> Body {
        Body {
            mass: Mass::from_kg(mass),
            inertia,
            radius: Length::from_cm(radius_cm),
            angle: Angle::from_deg(angle_deg),
        }
    }

    /// Masses with which the paper's tables are reproduced.
    pub(crate) fn recovered() -> Masses {
        let centre = |j| MomentOfInertia::AboutCentreOfMass(Inertia::from_kg_m2(j));
        let pivot = |j| MomentOfInertia::AboutPivot(Inertia::from_kg_m2(j));
        Masses::new(
            [
                body(0.0, pivot(0.0), 0.0, 0.0),
                body(10.0, centre(0.8), 50.0, 0.0),
                body(5.0, pivot(0.5), 30.0, 0.0),
                body(550.0, centre(18.0), 25.0, -12.0),
                body(3.5, pivot(0.2), 20.0, 0.0),
            ],
            Acceleration::from_m_per_s2(9.81),
        )
        .unwrap()
    }

    #[test]
    fn node_values_of_the_tables() {
        let linkage = zinchenko();
        let phi1 = 14.426f64.to_radians();
        let start = paper(phi1);
        let angles = (0..48).map(|k| Angle::from_rad(phi1 + (7.5 * f64::from(k)).to_radians()));
        let rows = linkage.rows(&recovered(), &start, angles).unwrap();
        // Rows 0, 4, 8, … of Table 2 are exact nodes.
        for (row, i_n, d_i_n) in [(4, 1.600, 5.278), (8, 4.402, 4.283), (36, 5.630, 0.615)] {
            let r = rows[row].reduced;
            assert!((r.inertia_kg_m2 - i_n).abs() < 6e-4, "{r:?}");
            assert!((r.inertia_derivative_kg_m2 - d_i_n).abs() < 6e-4, "{r:?}");
        }
        assert!((rows[4].reduced.moment_n_m - 78.151).abs() < 1e-3);
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let linkage = zinchenko();
        let masses = recovered();
        let start = paper(1.0);
        let h = 1e-5;
        let r = linkage
            .rows(
                &masses,
                &start,
                [2.0 - h, 2.0, 2.0 + h].map(Angle::from_rad),
            )
            .unwrap();
        let d = |f: fn(&Reduced) -> f64| (f(&r[2].reduced) - f(&r[0].reduced)) / (2.0 * h);
        let mid = &r[1].reduced;
        approx::assert_relative_eq!(
            d(|r| r.inertia_kg_m2),
            mid.inertia_derivative_kg_m2,
            max_relative = 1e-8
        );
        approx::assert_relative_eq!(
            d(|r| r.moment_n_m),
            mid.moment_derivative_n_m,
            max_relative = 1e-8
        );
    }

    #[test]
    fn bodies_are_checked() {
        let good = *recovered().bodies();
        let g = Acceleration::from_m_per_s2(9.81);
        let with = |f: &dyn Fn(&mut [Body; 5])| {
            let mut b = good;
            f(&mut b);
            Masses::new(b, g).unwrap_err().to_string()
        };
        assert_eq!(
            with(&|b| b[1].mass = Mass::from_kg(-1.0)),
            "mass of link 2 = -1 kg must not be negative"
        );
        assert!(with(&|b| b[3].radius = Length::from_m(f64::NAN)).contains("not a finite number"));
        assert!(with(&|b| b[3].angle = Angle::from_rad(f64::INFINITY)).contains("link 4"));
        let pivot = MomentOfInertia::AboutPivot(Inertia::from_kg_m2(1.0));
        assert!(with(&|b| b[1].inertia = pivot).contains("no fixed pivot"));
    }
}
