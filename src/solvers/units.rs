//! Physical quantities that remember their unit, so that centimetres never meet metres unseen.
//!
//! Each is one `f64` in the SI unit. Construction names the unit, reading names the unit:
//!
//! ```
//! use mechaudit_solvers::units::Length;
//! let l = Length::from_cm(48.5);
//! assert_eq!(l.m(), 0.485);
//! assert_eq!(l.cm(), 48.5);
//! ```
//! Conversions between decimal units divide or multiply by an exact power of ten once, so a
//! decimal that is exact in the given unit arrives as the nearest `f64` in SI.

macro_rules! quantity {
    ($(#[$doc:meta])* $name:ident, $si:ident, $from_si:ident $(, $(#[$udoc:meta])* $unit:ident, $from:ident, $per_si:expr)*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
        pub struct $name(f64);

        impl $name {
            /// From the SI unit.
            pub const fn $from_si(value: f64) -> Self {
                Self(value)
            }
            /// In the SI unit.
            pub const fn $si(self) -> f64 {
                self.0
            }
            $(
                $(#[$udoc])*
                pub const fn $from(value: f64) -> Self {
                    Self(value / $per_si)
                }
                $(#[$udoc])*
                pub const fn $unit(self) -> f64 {
                    self.0 * $per_si
                }
            )*
        }
    };
}

quantity!(
    /// A length; SI unit metre.
    Length, m, from_m,
    /// In centimetres.
    cm, from_cm, 100.0,
    /// In millimetres.
    mm, from_mm, 1000.0
);
quantity!(
    /// A mass; SI unit kilogram.
    Mass, kg, from_kg,
    /// In grams.
    g, from_g, 1000.0
);
quantity!(
    /// A moment of inertia about an axis normal to the plane; SI unit kg·m².
    Inertia, kg_m2, from_kg_m2,
    /// In kg·cm².
    kg_cm2, from_kg_cm2, 10_000.0
);
quantity!(
    /// An angle; SI unit radian.
    Angle, rad, from_rad
);

impl Angle {
    /// From degrees: `deg · π/180`, within one unit in the last place.
    pub const fn from_deg(deg: f64) -> Self {
        Self(deg.to_radians())
    }

    /// In degrees.
    pub const fn deg(self) -> f64 {
        self.0.to_degrees()
    }
}
quantity!(
    /// An angular velocity; SI unit rad/s.
    AngularVelocity, rad_per_s, from_rad_per_s
);
quantity!(
    /// A torque; SI unit N·m.
    Torque, n_m, from_n_m
);
quantity!(
    /// An acceleration of a point; SI unit m/s².
    Acceleration, m_per_s2, from_m_per_s2
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_units_arrive_correctly_rounded() {
        assert_eq!(Length::from_cm(48.5).m(), 0.485);
        assert_eq!(Length::from_mm(128.5).m(), 0.1285);
        assert_eq!(Inertia::from_kg_cm2(20.0).kg_m2(), 0.002);
        assert_eq!(Mass::from_g(3.0).kg(), 0.003);
        assert_eq!(Angle::from_deg(180.0).rad(), std::f64::consts::PI);
        assert_eq!(Angle::from_deg(180.0).deg(), 180.0);
    }
}
