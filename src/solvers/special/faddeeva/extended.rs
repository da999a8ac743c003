//! W in double-double at arguments in double-double, for solvers that take differences of its
//! values.

use super::constants::TWO_OVER_SQRT_PI;
use super::quadrant::{gaussian_exact, pair_times_power, w_exact};
use crate::double_double::Dd;
use crate::lanes::{Lanes, Task, with_best};

struct Extended(Dd, Dd);

impl Task for Extended {
    type Output = (Dd, Dd);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (Dd, Dd) {
        let (x, y) = (self.0, self.1);
        let (a, b) = (x.hi.abs(), y.hi.abs());
        let (mut re, mut im) = w_exact(lanes, a, b);
        if y.hi < 0.0 {
            // 2e^{−z²} − w(−z)
            let (c, s, n) = gaussian_exact(lanes, a, -b);
            re = pair_times_power(c, n + 1.0) - re;
            im = pair_times_power(s, n + 1.0) + im;
        }
        if x.hi < 0.0 {
            im = -im;
        }
        // w(z) + w′(z) dz for the low parts of z.
        let (u, v) = (re.hi, im.hi);
        let p = -2.0 * (x.hi * u - y.hi * v);
        let q = TWO_OVER_SQRT_PI.hi - 2.0 * (x.hi * v + y.hi * u);
        (re.add_f(p * x.lo - q * y.lo), im.add_f(p * y.lo + q * x.lo))
    }
}

/// W(x + iy) to about 2⁻¹⁰⁰ of the larger component, for |x|, |y| below 4096 and `y² − x² < 600`.
pub(crate) fn w_extended(x: Dd, y: Dd) -> (Dd, Dd) {
    with_best(Extended(x, y))
}
