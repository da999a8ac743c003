//! Greatest common divisors of polynomials: primitive remainder sequences, one variable at a time.

use super::coprime::certainly_without;
use super::{Poly, Symbol};

/// The monic greatest common divisor; zero only if both are zero.
pub fn gcd(a: &Poly, b: &Poly) -> Poly {
    if a.is_zero() {
        return monic(b);
    }
    if b.is_zero() {
        return monic(a);
    }
    if a.as_constant().is_some() || b.as_constant().is_some() {
        return Poly::integer(1);
    }
    // A variable of only one of them cannot be in a common divisor.
    let (sa, sb) = (a.symbols(), b.symbols());
    if let Some(x) = sa.difference(&sb).next() {
        return gcd(&content(a, *x), b);
    }
    if let Some(x) = sb.difference(&sa).next() {
        return gcd(a, &content(b, *x));
    }
    if sa.iter().all(|x| certainly_without(*x, a, b)) {
        return Poly::integer(1);
    }
    for (p, q) in [(a, b), (b, a)] {
        if p.divided_by(q).is_some() {
            return monic(q);
        }
    }
    // The variable of least degree makes the shortest sequence.
    let degree = |x: &Symbol| a.coefficients(*x).len().max(b.coefficients(*x).len());
    let Some(x) = sa.into_iter().min_by_key(degree) else {
        return Poly::integer(1);
    };
    let (ca, cb) = (content(a, x), content(b, x));
    let common = gcd(&ca, &cb);
    let (Some(mut p), Some(mut q)) = (a.divided_by(&ca), b.divided_by(&cb)) else {
        return common;
    };
    if certainly_without(x, &p, &q) {
        return common;
    }
    if p.coefficients(x).len() < q.coefficients(x).len() {
        std::mem::swap(&mut p, &mut q);
    }
    loop {
        let r = pseudo_remainder(&p, &q, x);
        if r.is_zero() {
            return monic(&(&q * &common));
        }
        if !r.contains(x) {
            return common;
        }
        let c = content(&r, x);
        p = q;
        // Monic, or the numbers would grow with every step.
        q = monic(&r.divided_by(&c).unwrap_or(r));
    }
}

/// Divided by its leading coefficient.
pub fn monic(p: &Poly) -> Poly {
    match p.leading().inverse() {
        Some(c) => p.scaled(&c),
        None => Poly::zero(),
    }
}

/// The monic greatest common divisor of the coefficients of powers of x.
fn content(p: &Poly, x: Symbol) -> Poly {
    let mut out = Poly::zero();
    for c in p.coefficients(x) {
        out = gcd(&out, &c);
        if out.is_one() {
            break;
        }
    }
    out
}

/// The remainder of `lead(q)^k p` by q as polynomials in x.
fn pseudo_remainder(p: &Poly, q: &Poly, x: Symbol) -> Poly {
    let divisor = q.coefficients(x);
    let mut rest = p.coefficients(x);
    let Some(top) = divisor.last() else {
        return Poly::zero();
    };
    while rest.len() >= divisor.len() {
        let Some(lead) = rest.last().cloned() else {
            break;
        };
        let shift = rest.len() - divisor.len();
        for c in &mut rest {
            *c = &*c * top;
        }
        for (j, d) in divisor.iter().enumerate() {
            rest[shift + j] = &rest[shift + j] - &(&lead * d);
        }
        while rest.last().is_some_and(Poly::is_zero) {
            rest.pop();
        }
    }
    Poly::from_coefficients(x, &rest)
}
