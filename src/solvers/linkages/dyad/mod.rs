//! Class-II Assur groups (dyads) and the two linkages built from a crank and one dyad.
//!
//! An Assur group of class II, or dyad, is two links and three joints that add no freedom to the
//! mechanism they are joined to. Two of the kinds are here: [`RrrDyad`] (three revolute joints)
//! and [`RrpDyad`] (the outer joint of the second link slides on a fixed guide). With a crank they
//! give the [`FourBar`] and the [`SliderCrank`].
//!
//! # Derivatives
//! Every motion is differentiated with respect to one parameter; for the linkages it is the crank
//! angle φ1, so that `φ' = dφ/dφ1` and `φ'' = d²φ/dφ1²` depend on the geometry alone. For a crank
//! with angular velocity ω1 and angular acceleration ε1
//!
//! ```text
//! ω = φ' ω1          ε = φ'' ω1² + φ' ε1
//! ```
//!
//! which is [`LinkMotion::angular_velocity`] and [`LinkMotion::angular_acceleration_rad_per_s2`].
//!
//! # Accuracy
//! Differences of squares are computed as products, triangle angles by half-angle formulas with
//! `atan2`, and lengths are first multiplied by a power of two, so that neither overflow nor
//! underflow disturbs a result and a scaling by powers of two leaves every angle bit for bit
//! unchanged.
//!
//! # Source
//! I. I. Artobolevskii, *Theory of Mechanisms and Machines*, the chapters on the classification
//! and on the analytical kinematics of class-II groups; for four-bar types F. Grashof,
//! *Theoretische Maschinenlehre*, vol. 2 (1883). The formulas are derived at each function from
//! the loop equation, numbered (1) to (8).

mod error;
mod four_bar;
#[cfg(test)]
mod limit_tests;
mod linkage_type;
mod motion;
mod numeric;
mod rows;
mod rrp;
mod rrr;
mod slider_crank;
#[cfg(test)]
mod tests;

pub use error::{DyadError, MAX_LENGTH_RATIO};
pub use four_bar::{FourBar, FourBarMotion};
pub use linkage_type::{CrankRange, DeadPosition, DeadPositions, GrashofType};
pub use motion::{Assembly, LinkMotion, PointMotion};
pub use rrp::{Guide, RrpDyad, RrpMotion};
pub use rrr::{RrrDyad, RrrMotion};
pub use slider_crank::{DeadCentre, DeadCentres, SliderCrank, SliderCrankMotion};
