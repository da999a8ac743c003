//! The asymptotic series far from the resonances, `|z|² ≥ 49` for both roots (see
//! [`super::sweep`]), for one time or several side by side.

use super::inlined::two;
use super::roots::Roots;
use crate::real::Real;
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
    fn times(self, o: Z<R>) -> Z<R> {
        Z(
            self.0.fma(o.0, -(self.1 * o.1)),
            self.0.fma(o.1, self.1 * o.0),
        )
    }

    /// `p₊ p₋ = w² − ω² − 2inω`, the imaginary part as accurate where it is small: its two products
    /// may cancel. The same bits whichever factor comes first.
    #[inline(always)]
    fn times_conjugate(self, o: Z<R>, n: f64, omega: R) -> Z<R> {
        let re = self.0 * o.0 - self.1 * o.1;
        Z(re, omega * omega.like(-2.0 * n))
    }

    /// The product with the same bits whichever factor comes first.
    #[inline(always)]
    fn times_evenly(self, o: Z<R>) -> Z<R> {
        Z(self.0 * o.0 - self.1 * o.1, self.0 * o.1 + self.1 * o.0)
    }

    #[inline(always)]
    fn plus(self, o: Z<R>) -> Z<R> {
        Z(self.0 + o.0, self.1 + o.1)
    }

    #[inline(always)]
    fn negative(self) -> Z<R> {
        Z(-self.0, -self.1)
    }

    #[inline(always)]
    fn minus(self, o: Z<R>) -> Z<R> {
        Z(self.0 - o.0, self.1 - o.1)
    }

    /// `(−i)^m size` times it.
    #[inline(always)]
    fn by_power(self, size: f64, m: usize) -> Z<R> {
        let (re, im) = (self.0 * self.0.like(size), self.1 * self.0.like(size));
        match m % 4 {
            0 => Z(re, im),
            1 => Z(im, -re),
            2 => Z(-re, -im),
            _ => Z(-im, re),
        }
    }

    #[inline(always)]
    fn inverse(self) -> Z<R> {
        let norm = self.0.fma(self.0, self.1 * self.1);
        let inverse = norm.like(1.0) / norm;
        Z(self.0 * inverse, -self.1 * inverse)
    }
}

/// The series for one root: `F = −a (1 + x + T)`, `R = −(x + T)` with `a = 1/p`, `x = −iκ/p²`.
#[derive(Clone, Copy)]
struct One<R> {
    a: Z<R>,
    x: Z<R>,
    rest: Z<R>,
}

impl<R: Real> One<R> {
    /// The coefficients of the powers of x are real, so that with `x² = sx − t` each term takes two
    /// multiplications (Knuth, *TAOCP* 2, 4.6.4).
    #[inline(always)]
    fn new(a: Z<R>, kappa: f64, terms: usize) -> One<R> {
        let square = a.times(a);
        let kappa = a.0.like(kappa);
        let x = Z(kappa * square.1, -(kappa * square.0));
        let (s, minus_t) = (x.0 + x.0, -x.0.fma(x.0, x.1 * x.1));
        let coefficient = |m: usize| s.like(ODD_FACTORIALS[m]);
        let mut m = terms.clamp(2, MOST);
        let (mut b, mut before) = (coefficient(m), s.like(0.0));
        while m > 2 {
            m -= 1;
            let next = s.fma(b, minus_t.fma(before, coefficient(m)));
            (before, b) = (b, next);
        }
        let last = s.fma(b, minus_t * before);
        let rest = Z(x.0.fma(last, minus_t * b), x.1 * last);
        One { a, x, rest }
    }

    #[inline(always)]
    fn sum(self) -> Z<R> {
        self.x.plus(self.rest)
    }
}

/// `F` and `R` for one root.
#[inline(always)]
pub(super) fn of_one<R: Real>(p: Z<R>, kappa: f64, terms: usize) -> (Z<R>, Z<R>) {
    let one = One::new(p.inverse(), kappa, terms);
    let sum = one.sum();
    let f = one.a.plus(one.a.times(sum));
    (f.negative(), sum.negative())
}

/// Both roots far apart beside their distance from ω. The first terms of the differences are
/// formed without subtracting: `a₊ − a₋ = −gap q`, `x₊ − x₋ = iκ gap q (a₊ + a₋)`, `q = a₊a₋`.
#[derive(Clone, Copy)]
struct Apart<R> {
    both: [One<R>; 2],
    /// `1/gap`
    by: Z<R>,
    q: Z<R>,
}

impl<R: Real> Apart<R> {
    #[inline(always)]
    fn new(p: [Z<R>; 2], product: Z<R>, roots: &Roots, kappa: f64, terms: usize) -> Apart<R> {
        // The one inverse that the accuracy of the result depends on.
        let q = product.inverse();
        let both = two(
            #[inline(always)]
            |i| One::new(p[1 - i].times(q), kappa, terms),
        );
        let by = roots.gap.inv();
        Apart {
            both,
            by: Z(q.0.like(by.re), q.0.like(by.im)),
            q,
        }
    }

    /// `F[·]`
    #[inline(always)]
    fn displacement(&self) -> Z<R> {
        let [f, g] = two(
            #[inline(always)]
            |i| self.both[i].a.times(self.both[i].sum()),
        );
        self.q.minus(f.minus(g).times(self.by))
    }
}

/// `F[·]` for both roots.
#[inline(always)]
pub(super) fn of_both<R: Real>([p, r]: [Z<R>; 2], kappa: f64, terms: usize) -> Z<R> {
    let q = p.times_evenly(r).inverse();
    let s = p.plus(r).times(q);
    let minus_q = q.negative();
    let one = Z(q.0.like(1.0), q.0.like(0.0));
    let (mut even, mut odd, mut f) = (one, s, one);
    // g_m = (2m − 1)!! κ^m (−i)^m
    let mut size = 1.0;
    for m in 1..=terms {
        size *= kappa * (2 * m - 1) as f64;
        even = s.times(odd).plus(minus_q.times(even));
        f = f.plus(even.by_power(size, m));
        odd = s.times(even).plus(minus_q.times(odd));
    }
    q.times(f)
}

/// `φ[·]`, `φ′[·]`, `φ″[·]` without `e^{−iθ}` from `F[·]`, `R[·]`, `(λR)[·]`.
#[inline(always)]
fn motion<R: Real>(omega: R, [f, r, lr]: [Z<R>; 3]) -> [Z<R>; 3] {
    let turned = |x: Z<R>, y: Z<R>| Z(omega.fma(x.1, y.0), (-omega).fma(x.0, y.1));
    let v = turned(f, r);
    [f, v, turned(v, lr)]
}

/// `φ[·]`, `φ′[·]`, `φ″[·]` without `e^{−iθ}`.
#[inline(always)]
pub(super) fn motion_of_both<R: Real>(
    [p, r]: [Z<R>; 2],
    n: f64,
    kappa: f64,
    omega: R,
    terms: usize,
) -> [Z<R>; 3] {
    let q = p.times_conjugate(r, n, omega).inverse();
    let s = Z(omega.like(-2.0 * n), omega + omega).times(q);
    let minus_q = q.negative();
    let zero = Z(q.0.like(0.0), q.0.like(0.0));
    let one = Z(q.0.like(1.0), q.0.like(0.0));
    let (mut even, mut odd) = (one, s);
    let (mut f, mut rate, mut weighted) = (one, zero, zero);
    let mut size = 1.0;
    for m in 1..=terms {
        size *= kappa * (2 * m - 1) as f64;
        // even = h_{2m−2}, odd = h_{2m−1}
        rate = rate.plus(odd.by_power(size, m));
        let lr = Z(omega.fma(odd.1, even.0), (-omega).fma(odd.0, even.1));
        weighted = weighted.plus(lr.by_power(size, m));
        even = s.times(odd).plus(minus_q.times(even));
        f = f.plus(even.by_power(size, m));
        odd = s.times(even).plus(minus_q.times(odd));
    }
    motion(omega, [q.times(f), q.times(rate), q.times(weighted)])
}

/// The same where the roots are far apart beside their distance from ω.
#[inline(always)]
pub(super) fn motion_apart<R: Real>(
    p: [Z<R>; 2],
    roots: &Roots,
    kappa: f64,
    omega: R,
    terms: usize,
) -> [Z<R>; 3] {
    let product = p[0].times_conjugate(p[1], roots.n, omega);
    let apart = Apart::new(p, product, roots, kappa, terms);
    let Apart { both, by, q } = apart;
    let k = omega.like(kappa);
    let turned = |z: Z<R>| Z(-(k * z.1), k * z.0);
    let first = turned(q.times(both[0].a.plus(both[1].a)));
    let rest = two(
        #[inline(always)]
        |i| {
            let lambda = roots.lambda[i];
            Z(k.like(lambda.re), k.like(lambda.im)).times(both[i].rest)
        },
    );
    let r = first.plus(both[0].rest.minus(both[1].rest).times(by));
    // iκq − iω (iκ q (a₊ + a₋)) and the rest.
    let lr = turned(q).plus(Z(omega * first.1, -(omega * first.0)));
    let lr = lr.plus(rest[0].minus(rest[1]).times(by));
    motion(omega, [apart.displacement(), r.negative(), lr.negative()])
}

/// `F[·]` where the roots are far apart beside their distance from ω.
#[inline(always)]
pub(super) fn of_both_apart<R: Real>(
    p: [Z<R>; 2],
    roots: &Roots,
    kappa: f64,
    terms: usize,
) -> Z<R> {
    Apart::new(p, p[0].times_evenly(p[1]), roots, kappa, terms).displacement()
}
