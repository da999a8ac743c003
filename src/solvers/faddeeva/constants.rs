//! Constants as sums of two `f64`.

use super::double_double::Dd;

/// 2/√π.
pub(super) const TWO_OVER_SQRT_PI: Dd =
    Dd::new(std::f64::consts::FRAC_2_SQRT_PI, 1.533_545_961_316_588e-17);
/// √π/2.
pub(super) const HALF_SQRT_PI: Dd = Dd::new(0.886_226_925_452_758, -3.833_293_249_912_899_3e-17);
/// 1/√π.
pub(super) const INV_SQRT_PI: Dd = Dd::new(0.564_189_583_547_756_3, 7.667_729_806_582_94e-18);
/// 1/√2.
pub(super) const INV_SQRT_2: Dd =
    Dd::new(std::f64::consts::FRAC_1_SQRT_2, -4.833_646_656_726_457e-17);
/// 1/√(2π).
pub(super) const INV_SQRT_2_PI: Dd = Dd::new(0.398_942_280_401_432_7, -2.492_327_202_277_73e-17);
/// ln 2.
pub(super) const LN_2: Dd = Dd::new(std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17);
/// 1/π.
pub(super) const INV_PI: Dd = Dd::new(std::f64::consts::FRAC_1_PI, -1.967_867_667_518_248_6e-17);
