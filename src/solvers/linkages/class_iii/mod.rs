//! Linkages with a crank and an Assur group of class III (a ternary link on three binary ones).
//!
//! ```text
//!        B           link 1   crank        O1–A          l1
//!   2  ／ ＼ 4       link 2   floating     A–B           l2
//!    A      C——D     link 3   rocker       O3–C          l3
//!   1|     3|   |5   link 4   ternary      C–D l4, C–B lB at the angle φB from C–D
//!    O1    O3   O5   link 5   rocker       O5–D          l5
//! ```
//!
//! With `e(φ) = (cos φ, sin φ)` and the crank pivot O1 at the origin the loops close when
//!
//! ```text
//! l1 e(φ1) + l2 e(φ2) = O3 + l3 e(φ3) + lB e(φ4 + φB)
//! O3 + l3 e(φ3) + l4 e(φ4) = O5 + l5 e(φ5)
//! ```
//!
//! which are the equations that Zinchenko (2008) differentiates for his velocity system. All rates
//! here are derivatives with respect to the crank angle φ1, so they do not depend on the crank's
//! speed; [`Rates::at_crank_speed`] gives rad/s and rad/s² for any ω1 and ε1.
//!
//! Angles are radians, lengths metres in computed values; inputs carry their unit in the type.

mod assembly;
mod branches;
mod closure;
mod continuation;
mod dead;
mod geometry;
mod kinematics;
mod loops;
mod positions;

pub use assembly::AssemblyModes;
pub use branches::{BranchMap, BranchSample, Fold};
pub use continuation::ContinuationError;
pub use dead::DeadPosition;
pub use geometry::{ClassIii, Geometry, GeometryError};
pub use kinematics::{Link, PointMotion, Rates, SingularPosition, State, Velocities};
pub use positions::Positions;

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::units::{Angle, Length};

    /// The linkage of Zinchenko (2008).
    pub(crate) fn zinchenko() -> ClassIii {
        let cm = Length::from_cm;
        ClassIii::new(Geometry {
            l1: cm(10.0),
            l2: cm(104.0),
            l3: cm(60.0),
            l4: cm(64.0),
            l5: cm(48.5),
            lb: cm(22.0),
            phi_b: Angle::from_deg(-39.3),
            x3: cm(75.0),
            y3: cm(93.0),
            x5: cm(128.5),
            y5: cm(103.5),
        })
        .unwrap()
    }

    /// The paper's position of it.
    pub(crate) fn paper(phi1: f64) -> State {
        let (linkage, phi1) = (zinchenko(), Angle::from_rad(phi1));
        let mode = linkage.assembly_modes(phi1).modes[2];
        linkage.state_near(phi1, mode).unwrap()
    }

    #[test]
    fn geometry_rules() {
        let good = *zinchenko().geometry();
        let v = good.named_values().map(|n| n.1);
        assert_eq!(Geometry::from_values(&v), good);
        for i in 0..11 {
            for bad in [f64::NAN, f64::INFINITY] {
                let mut w = v;
                w[i] = bad;
                let e = ClassIii::new(Geometry::from_values(&w)).unwrap_err();
                assert!(matches!(e, GeometryError::NotFinite { .. }), "{e}");
            }
        }
        for i in 0..6 {
            for (bad, text) in [(0.0, "positive"), (-0.1, "positive"), (1e-80, "outside")] {
                let mut w = v;
                w[i] = bad;
                let e = ClassIii::new(Geometry::from_values(&w)).unwrap_err();
                assert!(e.to_string().contains(text), "{e}");
            }
        }
    }

    /// B on D, O3 on O5, and both at once: modes that close the loops, as many as the reference
    /// proves.
    #[test]
    fn joints_and_pivots_may_coincide() {
        let screen = [
            0.1, 1.04, 0.6, 0.64, 0.485, 0.22, -0.6859, 0.75, 0.93, 1.285, 1.035,
        ];
        let on_d = [
            0.25, 1.34, 0.61, 0.51, 0.8, 0.51, 0.0, -0.06, 0.73, 0.47, 0.73,
        ];
        let on_pivot = {
            let mut v = screen;
            (v[9], v[10]) = (v[7], v[8]);
            v
        };
        let on_both = {
            let mut v = on_pivot;
            (v[5], v[6]) = (v[3], 0.0);
            v
        };
        for (v, phi1, count) in [
            (on_d, -2.49, 2),
            (on_d, 0.525, 2),
            (on_pivot, -2.19, 4),
            (on_both, -0.03, 4),
        ] {
            let linkage = ClassIii::new(Geometry::from_values(&v)).unwrap();
            let modes = linkage.assembly_modes(Angle::from_rad(phi1)).modes;
            assert_eq!(modes.len(), count, "{v:?} {phi1}");
            for m in &modes {
                let (a, b) = linkage.residual(loops::unit(phi1), &loops::Frame::new(&linkage.l, m));
                assert!(a.norm().max(b.norm()) < 1e-15, "{v:?} {m:?}");
                let state = linkage.state(Angle::from_rad(phi1), *m).unwrap();
                assert!(state.rates.first.iter().all(|r| r.is_finite()));
            }
        }
    }
}

#[cfg(test)]
mod statics_tests;
