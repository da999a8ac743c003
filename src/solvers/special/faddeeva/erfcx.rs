//! The scaled complementary error function, `erfcx z = e^{z²} erfc z = W(iz)` (DLMF 7.2.3).

use super::lengths::{LengthMismatch, same_length};
use super::many::all;
use super::places::One;
use super::plane;
use super::points::{Interleaved, Points};
use super::quadrant::{exp_wide, gaussian, pair_times_power, times_power};
use super::slope::derivative;
use crate::exponential::exponent;
use crate::hex::hex;
use crate::lanes::{Lanes, Task, with_best};
use crate::real;
use num_complex::Complex;

/// Below this |Im z| the products in W keep no digits, and Im erfcx is linear in it.
const TINY: f64 = hex("0x1p-900");
/// Below this −Re z second powers of it are below the last place of double-double.
const FLAT: f64 = hex("0x1p-60");
/// Above this -Re z everything has overflowed, and the sign of Im erfcx is that of the true phase.
const LARGE: f64 = hex("0x1p40");
/// Where a sum is smaller than this part of its terms, it is W's.
const CANCELLED: f64 = 1.0 / 64.0;
const LIFT: f64 = hex("0x1p300");

#[inline(always)]
fn is_tiny(x: f64, y: f64) -> bool {
    y.abs() < TINY && y != 0.0 && x < 0.0 && x > -LARGE
}

struct Erfcx(f64, f64);

impl Task for Erfcx {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let (x, y) = (self.0, self.1);
        if is_tiny(x, y) {
            return lanes.call(Tiny(x, y));
        }
        if is_flat(x, y) {
            return lanes.call(Flat(x, y));
        }
        plane::w(lanes, -y, x)
    }
}

/// Where Re erfcx is linear in Re z and its two terms may cancel: just left of the imaginary axis.
#[inline(always)]
fn is_flat(x: f64, y: f64) -> bool {
    x < 0.0 && x > -FLAT && y.abs() > 6.5 && y.abs() < 27.5
}

/// `Re W(a − ib) = e^{−a²} + b Im W′(a)` with `b²a²` below the last place, in double-double.
struct Flat(f64, f64);

impl Task for Flat {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        const UP: f64 = 500.0;
        let (re, im) = plane::w(lanes, -self.1, self.0);
        let (a, b) = (self.1.abs(), real::scaled(-self.0, real::ROUND + UP));
        let (e, n) = exp_wide(exponent(a, 0.0));
        let ((_, slope), _) = derivative(One(lanes), a, 0.0, true);
        let gaussian = pair_times_power(e, n + UP);
        let sum = gaussian + slope.mul_f(b);
        if sum.hi.abs() < CANCELLED * gaussian.hi {
            // The slope has too few digits; W begins again with all of them.
            return (re, im);
        }
        (real::scaled(sum.value(), real::ROUND - UP), im)
    }
}

struct Tiny(f64, f64);

impl Task for Tiny {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let (x, y) = (self.0, self.1 * LIFT);
        let down = 300.0;
        if x < -27.0 {
            // 2 e^{z²} is all of it; Re erfcx has overflowed.
            let (_, s, n) = gaussian(One(lanes), y.abs(), x);
            let im = times_power(s.value(), n + (1.0 - down));
            return (f64::INFINITY, if y.is_sign_negative() { im } else { -im });
        }
        let (re, im) = plane::w(lanes, -y, x);
        (re, real::scaled(im, real::ROUND - down))
    }
}

/// The scaled complementary error function `erfcx z = e^{z²} erfc z = w(iz)` (DLMF 7.2.3), on the
/// whole plane.
///
/// # Accuracy
/// That of [`faddeeva`](super::faddeeva()). Worst found against the certified reference in
/// 1.35·10⁷ cases of `mechaudit audit erfcx` (`reference/campaigns`): norm 3.07 u (u = 2⁻⁵³), Re
/// 2.96 and Im 2.73 units in the last place.
///
/// # Special values
/// Those of w at `iz`; `+∞` at `−∞ + 0i`, NaN at `−∞ + iy`, y ≠ 0. Above the range of `f64` each
/// component is the infinity of its sign.
///
/// ```
/// use mechaudit_solvers::faddeeva::erfcx;
/// use num_complex::Complex;
///
/// let f = erfcx(Complex::new(1.0, 0.0));
/// assert!((f.re - 0.427583576155807).abs() < 1e-15 && f.im == 0.0);
/// ```
pub fn erfcx(z: Complex<f64>) -> Complex<f64> {
    let (re, im) = with_best(Erfcx(z.re, z.im));
    Complex::new(re, im)
}

/// `W(iz)` at points stored as complex numbers.
struct Turned<'a>(Interleaved<'a>);

impl Points for Turned<'_> {
    fn len(&self) -> usize {
        self.0.len()
    }
    fn load(&self, start: usize, z: &mut [Complex<f64>]) {
        self.0.load(start, z);
        for z in z {
            *z = Complex::new(-z.im, z.re);
        }
    }
    fn store(&mut self, start: usize, f: &[Complex<f64>]) {
        self.0.store(start, f);
    }
}

/// [`erfcx`] at many points, several times as fast; the values have the same bits.
///
/// # Errors
/// [`LengthMismatch`] if the slices differ in length; nothing is written then.
///
/// ```
/// use mechaudit_solvers::faddeeva::{erfcx, erfcx_batch};
/// use num_complex::Complex;
///
/// let z: Vec<_> = (0..100).map(|k| Complex::new(0.1 * f64::from(k), 0.5)).collect();
/// let mut f = vec![Complex::default(); z.len()];
/// erfcx_batch(&z, &mut f)?;
/// assert_eq!(f[70], erfcx(z[70]));
/// assert!(erfcx_batch(&z, &mut f[1..]).is_err());
/// # Ok::<(), mechaudit_solvers::faddeeva::LengthMismatch>(())
/// ```
pub fn erfcx_batch(z: &[Complex<f64>], f: &mut [Complex<f64>]) -> Result<(), LengthMismatch> {
    same_length(z.len(), [f.len()])?;
    all(&mut Turned(Interleaved { z, w: f }));
    for (f, z) in f.iter_mut().zip(z) {
        if is_tiny(z.re, z.im) || is_flat(z.re, z.im) {
            *f = erfcx(*z);
        }
    }
    Ok(())
}
