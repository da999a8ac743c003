//! erfc, Dawson's function and W′ in 256 bits, next to the curves on which a component is zero.

use super::long::Long;
use super::long_functions::{Angle, Complex, exp, gaussian, plus, times};
use super::long_w::{INV_SQRT_PI, series, w};

/// `erfc(x + i y) = e^{−z²} w(iz)` in the first quadrant, `|Re z²| < 2¹⁰`.
pub(super) fn erfc(x: f64, y: f64) -> Complex {
    let (u, v) = w(y, x);
    times(gaussian(x, y), (u, -v))
}

/// `Re erf(x + i y)` beside the imaginary axis, `xy < 2⁻³²`: the three first terms of the series in
/// x, `(2/√π) x e^{y²} (1 − x² (2y² + 1)/3 + x⁴ (4y⁴ + 12y² + 3)/30)`; the next one is below
/// `(xy)⁶/100`.
pub(super) fn re_erf(x: f64, y: f64) -> Long {
    let (x, y) = (Long::from(x), Long::from(y));
    let (xx, yy) = (x.square(), y.square());
    let second = (xx * (yy.scale(1) + Long::ONE)).over(3);
    let third = yy.square().scale(2) + yy * Long::from(12.0) + Long::from(3.0);
    let third = (xx.square() * third).over(30);
    let e = exp(yy, Angle::quarters(0.0)).0;
    x * e * INV_SQRT_PI.scale(1) * (Long::ONE - second + third)
}

/// `F(x + i y) = (√π/2) i (e^{−z²} − w(z))` in the first quadrant, `|Re z²| < 2¹⁰`.
pub(super) fn dawson(x: f64, y: f64) -> Complex {
    let ((c, s), (u, v)) = (gaussian(x, y), w(x, y));
    let factor = INV_SQRT_PI.scale(1).recip();
    ((v - s) * factor, (c - u) * factor)
}

/// `w′(a + i y)`, `a ≥ 0`, `|Re z²| < 2¹⁰` for `y < 0`.
pub(super) fn derivative(a: f64, y: f64) -> Complex {
    let z = (Long::from(a), Long::from(y));
    let by = |k, (re, im): Complex| (-re.scale(k), -im.scale(k));
    if a.max(y.abs()) < 4096.0 {
        let on_axis = (Long::ZERO, INV_SQRT_PI.scale(1));
        return plus(by(1, times(z, w(a, y))), on_axis);
    }
    // −(i/√π) (q + 3a₁q² + …), q = 1/z².
    let (inverse, sum) = series(a, y.abs(), 0.5);
    let (re, im) = times(times(inverse, inverse), sum);
    let (u, v) = (im * INV_SQRT_PI, -(re * INV_SQRT_PI));
    if y >= 0.0 {
        return (u, v);
    }
    plus(by(2, times(z, gaussian(a, y))), (-u, v))
}

#[cfg(test)]
mod tests;
