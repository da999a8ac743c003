//! Constants as sums of two `f64`, each the nearest one to what is left.
//!
//! Made by `mechaudit regenerate faddeeva-constants` (mechaudit 0.1.0); not to be edited.
//! precision: every rounding decided at 256 to 8192 bits
//! SHA-256 of the recipe: 5cef7974502fa25ef24d1bfecb1410b80c050f2a22c52cd97e3ce0c1c38f6e47
//! SHA-256 of all lines below: 7cec8cf706f528386620f3451a64dd3345b0968b8e24b2b184346892e0465000

#![allow(clippy::approx_constant)]

use crate::double_double::Dd;

/// 2/√π.
pub(super) const TWO_OVER_SQRT_PI: Dd = Dd::new(1.1283791670955126, 1.533545961316588e-17);
/// √π/2.
pub(super) const HALF_SQRT_PI: Dd = Dd::new(0.886226925452758, -3.8332932499128993e-17);
/// 1/√π.
pub(super) const INV_SQRT_PI: Dd = Dd::new(0.5641895835477563, 7.66772980658294e-18);
/// 1/√2.
pub(super) const INV_SQRT_2: Dd = Dd::new(0.7071067811865476, -4.833646656726457e-17);
/// 1/√(2π).
pub(super) const INV_SQRT_2_PI: Dd = Dd::new(0.3989422804014327, -2.49232720227773e-17);
/// √(ln 2).
pub(super) const SQRT_LN_2: Dd = Dd::new(0.8325546111576978, -4.2875407321628104e-17);
/// 1/π.
pub(super) const INV_PI: Dd = Dd::new(0.3183098861837907, -1.9678676675182486e-17);
