//! The particular solution for both roots, near and far.

use super::extended::differences;
use super::inlined::two;
use super::roots::Roots;
use super::series::{self, FAR, Z, terms};
use super::sweep::{Amplitudes, Sweep};
use crate::double_double::Dd;
use crate::faddeeva::faddeeva;
use num_complex::Complex;

type C = Complex<f64>;

impl Sweep {
    /// `F[·]` beside a resonance, by w alone.
    #[inline(always)]
    pub fn displacement_near(&self, roots: &Roots, omega: Dd) -> C {
        let p = two(
            #[inline(always)]
            |i| roots.p(i, omega),
        );
        if !self.apart(roots, p) {
            return differences(self, roots, omega)[0];
        }
        let [f, g] = two(
            #[inline(always)]
            |i| match self.far_single(p[i]) {
                Some(f) => f,
                None if self.beyond(roots, i, omega) => -self.factor() * faddeeva(-self.z(p[i])),
                None => self.factor() * faddeeva(self.z(p[i])),
            },
        );
        (f - g) / roots.gap
    }

    /// The amplitudes of the particular solution for both roots, per `w²`.
    #[inline(always)]
    pub fn particular(&self, roots: &Roots, omega: Dd) -> Amplitudes {
        let p = two(
            #[inline(always)]
            |i| roots.p(i, omega),
        );
        let distance = two(
            #[inline(always)]
            |i| self.distance(p[i]),
        );
        let value = omega.value();
        let near = distance[0].min(distance[1]);
        if near >= FAR {
            let nearer = p[0].norm_sqr().min(p[1].norm_sqr());
            let (p, kappa, terms) = (p.map(Z::from), self.kappa.hi, terms(near));
            let [y, v, a] = match self.apart_far(roots, nearer) {
                true => series::motion_apart(p, roots, kappa, value, terms),
                false => series::motion_of_both(p, roots.n, kappa, value, terms),
            };
            return Amplitudes {
                y: y.into(),
                v: v.into(),
                a: a.into(),
            };
        }
        if !self.apart(roots, p) {
            let [f, r, lr] = differences(self, roots, omega);
            return Amplitudes::new(value, f, r, lr);
        }
        let [(f, r), (g, s)] = two(
            #[inline(always)]
            |i| self.single(roots, i, omega),
        );
        let [plus, minus] = roots.lambda;
        Amplitudes::new(
            value,
            (f - g) / roots.gap,
            (r - s) / roots.gap,
            (plus * r - minus * s) / roots.gap,
        )
    }
}
