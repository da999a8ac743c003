//! The asymptotic series far from the resonances, `|z|² ≥ 49` for both roots (see [`super::sweep`]),
//! for one time or several side by side.

use super::inlined::two;
use crate::solvers::faddeeva::real::Real;
use num_complex::Complex;

type C = Complex<f64>;

/// `|z|²` from which the asymptotic series is used, and with how many terms.
///
/// With m terms the next one, `(2m + 1)!! (2m + 2)/(2|z|²)^m` of the first of R, is below 2⁻⁵⁴.
const TERMS: [(f64, usize); 9] = [
    (1e9, 2),
    (1e7, 3),
    (1e5, 4),
    (1e4, 6),
    (1e3, 8),
    (300.0, 11),
    (100.0, 18),
    (64.0, 22),
    (FAR, MOST),
];
pub(super) const FAR: f64 = 49.0;
const MOST: usize = 27;

/// `(2m − 1)!!`
const ODD_FACTORIALS: [f64; MOST + 1] = {
    let mut c = [1.0; MOST + 1];
    let mut m = 1;
    while m <= MOST {
        c[m] = c[m - 1] * (2 * m - 1) as f64;
        m += 1;
    }
    c
};

#[inline(always)]
pub(super) fn terms(distance: f64) -> usize {
    for (from, terms) in TERMS {
        if distance >= from {
            return terms;
        }
    }
    MOST
}

/// Real and imaginary part.
#[derive(Clone, Copy)]
pub(super) struct Z<R>(pub R, pub R);

impl From<C> for Z<f64> {
    #[inline(always)]
    fn from(z: C) -> Z<f64> {
        Z(z.re, z.im)
    }
}

impl From<Z<f64>> for C {
    #[inline(always)]
    fn from(z: Z<f64>) -> C {
        C::new(z.0, z.1)
    }
}

impl<R: Real> Z<R> {
    #[inline(always)]
    pub fn times(self, o: Z<R>) -> Z<R> {
        Z(
            self.0.fma(o.0, -(self.1 * o.1)),
            self.0.fma(o.1, self.1 * o.0),
        )
    }

    #[inline(always)]
    fn plus(self, o: Z<R>) -> Z<R> {
        Z(self.0 + o.0, self.1 + o.1)
    }

    #[inline(always)]
    pub fn minus(self, o: Z<R>) -> Z<R> {
        Z(self.0 - o.0, self.1 - o.1)
    }

    #[inline(always)]
    fn inverse(self) -> Z<R> {
        let norm = self.0.fma(self.0, self.1 * self.1);
        let inverse = norm.like(1.0) / norm;
        Z(self.0 * inverse, -self.1 * inverse)
    }
}

/// `F` and `R` for one root.
///
/// The coefficients of the powers of `x = −iκ/p²` are real, so that with `x² = sx − t` each term
/// takes two multiplications (Knuth, *TAOCP* 2, 4.6.4).
#[inline(always)]
pub(super) fn of_one<R: Real>(p: Z<R>, kappa: f64, terms: usize) -> (Z<R>, Z<R>) {
    let a = p.inverse();
    let square = a.times(a);
    let kappa = a.0.like(kappa);
    let x = Z(kappa * square.1, -(kappa * square.0));
    let (s, minus_t) = (x.0 + x.0, -x.0.fma(x.0, x.1 * x.1));
    let coefficient = |m: usize| s.like(ODD_FACTORIALS[m]);
    let (mut b, mut before) = (coefficient(terms.min(MOST)), s.like(0.0));
    let mut m = terms.min(MOST);
    while m > 1 {
        m -= 1;
        let next = s.fma(b, minus_t.fma(before, coefficient(m)));
        (before, b) = (b, next);
    }
    let sum = Z(x.0.fma(b, minus_t * before), x.1 * b);
    let f = a.plus(a.times(sum));
    (Z(-f.0, -f.1), Z(-sum.0, -sum.1))
}

/// `F[·]` for both roots.
#[inline(always)]
pub(super) fn of_both<R: Real>([p, r]: [Z<R>; 2], kappa: f64, terms: usize) -> Z<R> {
    let q = p.times(r).inverse();
    let s = p.plus(r).times(q);
    let minus_q = Z(-q.0, -q.1);
    let one = Z(q.0.like(1.0), q.0.like(0.0));
    let (mut even, mut odd, mut f) = (one, s, one);
    // g_m = (2m − 1)!! κ^m (−i)^m
    let mut size = 1.0;
    for m in 1..=terms {
        size *= kappa * (2 * m - 1) as f64;
        even = s.times(odd).plus(minus_q.times(even));
        let c = even.0.like(size);
        let g = match m % 4 {
            0 => Z(even.0, even.1),
            1 => Z(even.1, -even.0),
            2 => Z(-even.0, -even.1),
            _ => Z(-even.1, even.0),
        };
        f = Z(c.fma(g.0, f.0), c.fma(g.1, f.1));
        odd = s.times(even).plus(minus_q.times(odd));
    }
    q.times(f)
}

/// `F[·]`, `R[·]`, `(λR)[·]` for both roots.
#[inline(always)]
pub(super) fn motion_of_both(p: [C; 2], kappa: f64, omega: f64, terms: usize) -> [C; 3] {
    let q = (p[0] * p[1]).inv();
    let s = (p[0] + p[1]) * q;
    let (mut even, mut odd) = (C::ONE, s);
    let (mut f, mut r, mut lr) = (C::ONE, C::ZERO, C::ZERO);
    let mut g = C::ONE;
    for m in 1..=terms {
        g *= C::new(0.0, -kappa * (2 * m - 1) as f64);
        // even = h_{2m−2}, odd = h_{2m−1}
        r += g * odd;
        lr += g * (even - C::new(-omega * odd.im, omega * odd.re));
        even = s * odd - q * even;
        f += g * even;
        odd = s * even - q * odd;
    }
    [q * f, q * r, q * lr]
}

/// `F[·]` where the roots are far apart beside their distance from ω: from both values of `F`.
#[inline(always)]
pub(super) fn difference<R: Real>(p: [Z<R>; 2], gap: C, kappa: f64, terms: usize) -> Z<R> {
    let [f, g] = two(
        #[inline(always)]
        |i| of_one(p[i], kappa, terms).0,
    );
    let by = gap.inv();
    let like = |x: f64| f.0.like(x);
    f.minus(g).times(Z(like(by.re), like(by.im)))
}
