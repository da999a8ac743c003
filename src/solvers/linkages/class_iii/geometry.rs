//! The dimensions and their checks.

use crate::units::{Angle, Length};
use num_complex::Complex64;

/// The dimensions of the linkage. The crank pivot O1 is the origin; x is the axis that angles are
/// measured from, y points up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// Crank O1–A.
    pub l1: Length,
    /// Floating link A–B.
    pub l2: Length,
    /// Rocker O3–C.
    pub l3: Length,
    /// Ternary link, side C–D.
    pub l4: Length,
    /// Rocker O5–D.
    pub l5: Length,
    /// Ternary link, side C–B.
    pub lb: Length,
    /// Angle from C–D to C–B, counter-clockwise.
    pub phi_b: Angle,
    /// Fixed pivot O3, x.
    pub x3: Length,
    /// Fixed pivot O3, y.
    pub y3: Length,
    /// Fixed pivot O5, x.
    pub x5: Length,
    /// Fixed pivot O5, y.
    pub y5: Length,
}

impl Geometry {
    /// The dimensions in metres and radians, in the order of the fields, with their names.
    pub fn named_values(&self) -> [(&'static str, f64); 11] {
        [
            ("l1", self.l1.m()),
            ("l2", self.l2.m()),
            ("l3", self.l3.m()),
            ("l4", self.l4.m()),
            ("l5", self.l5.m()),
            ("lB", self.lb.m()),
            ("phiB", self.phi_b.rad()),
            ("x3", self.x3.m()),
            ("y3", self.y3.m()),
            ("x5", self.x5.m()),
            ("y5", self.y5.m()),
        ]
    }

    /// The inverse of [`Geometry::named_values`].
    pub fn from_values(v: &[f64; 11]) -> Geometry {
        let m = Length::from_m;
        Geometry {
            l1: m(v[0]),
            l2: m(v[1]),
            l3: m(v[2]),
            l4: m(v[3]),
            l5: m(v[4]),
            lb: m(v[5]),
            phi_b: Angle::from_rad(v[6]),
            x3: m(v[7]),
            y3: m(v[8]),
            x5: m(v[9]),
            y5: m(v[10]),
        }
    }
}

/// Why a geometry is refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum GeometryError {
    /// A dimension is NaN or infinite.
    #[error("{name} = {value} is not a finite number")]
    NotFinite {
        /// Its name.
        name: &'static str,
        /// Its value in SI units.
        value: f64,
    },
    /// A length is zero or negative.
    #[error("{name} = {value} m must be a positive length")]
    NotPositive {
        /// Its name.
        name: &'static str,
        /// Its value in metres.
        value: f64,
    },
    /// Lengths so different that squares of them overflow or vanish.
    #[error("{name} = {value} m is outside 1e-60 … 1e60 m")]
    OutOfRange {
        /// Its name.
        name: &'static str,
        /// Its value in metres.
        value: f64,
    },
}

/// A linkage whose geometry has been checked.
#[derive(Clone, Copy, Debug)]
pub struct ClassIii {
    geometry: Geometry,
    pub(super) l: Lengths,
}

/// The dimensions as the equations use them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lengths {
    pub l1: f64,
    pub l2: f64,
    pub l3: f64,
    pub l4: f64,
    pub l5: f64,
    pub lb: f64,
    /// `e(φB)`.
    pub eb: Complex64,
    pub o3: Complex64,
    pub o5: Complex64,
}

impl GeometryError {
    /// The rule that is broken, in two words.
    pub fn name(&self) -> &'static str {
        match self {
            GeometryError::NotFinite { .. } => "not finite",
            GeometryError::NotPositive { .. } => "not positive",
            GeometryError::OutOfRange { .. } => "out of range",
        }
    }
}

impl ClassIii {
    /// Checks the geometry: finite numbers and positive lengths, since a link without length has
    /// no direction.
    ///
    /// Joints B and D or pivots O3 and O5 may coincide. The group then falls into dyads or holds a
    /// rigid triangle, and the loop equations are the same.
    ///
    /// # Errors
    /// [`GeometryError`] names the first dimension that breaks a rule.
    pub fn new(geometry: Geometry) -> Result<ClassIii, GeometryError> {
        let named = geometry.named_values();
        for (i, (name, value)) in named.into_iter().enumerate() {
            if !value.is_finite() {
                return Err(GeometryError::NotFinite { name, value });
            }
            if i < 6 && value <= 0.0 {
                return Err(GeometryError::NotPositive { name, value });
            }
            let size = value.abs();
            if i != 6 && size != 0.0 && !(1e-60..=1e60).contains(&size) {
                return Err(GeometryError::OutOfRange { name, value });
            }
        }
        let v = named.map(|n| n.1);
        let eb = Complex64::new(v[6].cos(), v[6].sin());
        let l = Lengths {
            l1: v[0],
            l2: v[1],
            l3: v[2],
            l4: v[3],
            l5: v[4],
            lb: v[5],
            eb,
            o3: Complex64::new(v[7], v[8]),
            o5: Complex64::new(v[9], v[10]),
        };
        Ok(ClassIii { geometry, l })
    }

    /// The geometry.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }
}
