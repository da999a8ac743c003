//! Sums of two `f64` in constants, which have no fused operations.

use crate::double_double::Dd;

/// `ab` by parts of 26 bits (Dekker).
pub(super) const fn product(a: Dd, b: Dd) -> Dd {
    const fn halves(x: f64) -> [f64; 2] {
        let c = 134_217_729.0 * x;
        let high = c - (c - x);
        [high, x - high]
    }
    let p = a.hi * b.hi;
    let ([a1, a2], [b1, b2]) = (halves(a.hi), halves(b.hi));
    let lost = ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
    normal(p, lost + (a.hi * b.lo + a.lo * b.hi))
}

/// `a + b` (Knuth).
pub(super) const fn sum(a: Dd, b: Dd) -> Dd {
    let s = a.hi + b.hi;
    let t = s - a.hi;
    let lost = (a.hi - (s - t)) + (b.hi - t);
    normal(s, lost + (a.lo + b.lo))
}

pub(super) const fn minus(a: Dd) -> Dd {
    Dd::new(-a.hi, -a.lo)
}

const fn normal(hi: f64, lo: f64) -> Dd {
    let s = hi + lo;
    Dd::new(s, lo - (s - hi))
}

/// `a/n` of a small integer.
pub(super) const fn over(a: Dd, n: f64) -> Dd {
    quotient(a, Dd::from(n))
}

/// `a/b`
pub(super) const fn quotient(a: Dd, b: Dd) -> Dd {
    let q = a.hi / b.hi;
    let rest = sum(a, minus(product(b, Dd::from(q))));
    normal(q, rest.hi / b.hi)
}
