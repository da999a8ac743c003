//! Constants as sums of two `f64`, each the nearest one to what is left.
//!
//! Made by `mechaudit regenerate faddeeva-constants` (mechaudit 0.1.0); not to be edited.
//! precision: every rounding decided at 256 to 8192 bits
//! SHA-256 of the recipe: 2f9c0b3fe854de29758a53da58119475b156a5699879415a7acac60f7375fb3d
//! SHA-256 of all lines below: daf320da02da5693800f0f97b70174f9067436047789e46d4870b28e91b87d55

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
