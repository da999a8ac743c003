//! Decides if two polynomials have no common divisor with a variable in it, by their images in one
//! variable modulo a prime.
//!
//! Where `p = g h` and no denominator is divisible by the prime, `g` can be scaled so that the
//! images exist and `p`'s is the product of theirs (Gauss's lemma in the integers of Q(i) localised
//! at a prime above it). Where the image of `p`'s leading coefficient in x is not zero, neither is
//! that of `g`'s: the degree of `g` in x is that of its image, which divides both.

use super::{Gauss, Poly, Symbol};
use rug::Rational;

/// `119·2²³ + 1`: of one, modulo four, so that −1 is a square.
const PRIME: u64 = 998_244_353;
/// Its square is −1.
const ROOT: u64 = 86_583_718;
/// Values of the other variables: multiples of a number that has nothing to do with those in
/// formulas.
const VALUE: u64 = 618_033_989;

fn product(a: u64, b: u64) -> u64 {
    a * b % PRIME
}

fn difference(a: u64, b: u64) -> u64 {
    (a + PRIME - b) % PRIME
}

fn power(mut base: u64, mut exponent: u64) -> u64 {
    let mut out = 1;
    while exponent > 0 {
        if exponent % 2 == 1 {
            out = product(out, base);
        }
        base = product(base, base);
        exponent /= 2;
    }
    out
}

/// By Fermat's little theorem.
fn inverse(a: u64) -> u64 {
    power(a, PRIME - 2)
}

/// Nothing if the denominator is divisible by the prime.
fn residue(q: &Rational) -> Option<u64> {
    let of = |n: &rug::Integer| u64::from(n.mod_u(PRIME as u32));
    let denominator = of(q.denom());
    (denominator != 0).then(|| product(of(q.numer()), inverse(denominator)))
}

fn image_of(c: &Gauss) -> Option<u64> {
    Some((residue(&c.re)? + product(ROOT, residue(&c.im)?)) % PRIME)
}

/// Coefficients of the powers of x, the others replaced by numbers; nothing if there is no image.
fn image(p: &Poly, x: Symbol, others: &[Symbol]) -> Option<Vec<u64>> {
    let mut out = Vec::new();
    for (monomial, c) in p.terms() {
        let (mut value, mut degree) = (image_of(c)?, 0);
        for (symbol, exponent) in monomial {
            if *symbol == x {
                degree = *exponent as usize;
            } else {
                let at = others.iter().position(|s| s == symbol)? as u64 + 1;
                value = product(value, power(product(at, VALUE), u64::from(*exponent)));
            }
        }
        if out.len() <= degree {
            out.resize(degree + 1, 0);
        }
        out[degree] = (out[degree] + value) % PRIME;
    }
    Some(out)
}

fn trimmed(mut p: Vec<u64>) -> Vec<u64> {
    while p.last() == Some(&0) {
        p.pop();
    }
    p
}

/// The degree of the greatest common divisor of two images, one of them not zero.
fn common_degree(mut p: Vec<u64>, mut q: Vec<u64>) -> usize {
    while let Some(top) = q.last() {
        let over = inverse(*top);
        while p.len() >= q.len() {
            let shift = p.len() - q.len();
            let factor = product(p[p.len() - 1], over);
            for (k, c) in q.iter().enumerate() {
                p[shift + k] = difference(p[shift + k], product(factor, *c));
            }
            p = trimmed(p);
        }
        std::mem::swap(&mut p, &mut q);
    }
    p.len() - 1
}

/// Returns true if it is certain that no common divisor of p and q has x in it; false where the
/// images cannot tell.
pub(super) fn certainly_without(x: Symbol, p: &Poly, q: &Poly) -> bool {
    let mut others = p.symbols();
    others.extend(q.symbols());
    let others: Vec<Symbol> = others.into_iter().filter(|s| *s != x).collect();
    let (Some(a), Some(b)) = (image(p, x, &others), image(q, x, &others)) else {
        return false;
    };
    let leads = |image: &[u64]| image.last().is_some_and(|c| *c != 0);
    (leads(&a) || leads(&b)) && common_degree(trimmed(a), trimmed(b)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn s(name: &str) -> Symbol {
        Symbol::new(name).unwrap()
    }

    fn p(name: &str) -> Poly {
        Poly::symbol(s(name))
    }

    fn c(re: (i64, u64), im: i64) -> Poly {
        Poly::constant(Gauss::new(Rational::from(re), im))
    }

    #[test]
    fn numbers_modulo_the_prime() {
        assert_eq!(product(ROOT, ROOT), PRIME - 1);
        assert_eq!(product(inverse(12345), 12345), 1);
        assert_eq!(
            residue(&Rational::from((-3, 2))).map(|r| product(r, 2)),
            Some(PRIME - 3)
        );
        assert_eq!(residue(&Rational::from((1, PRIME))), None);
        assert_eq!(power(3, 0), 1);
        assert_eq!(power(3, 13), 1_594_323);
        assert_eq!(difference(1, 2), PRIME - 1);
    }

    #[test]
    fn divisors_with_the_variable_are_never_denied() {
        let (x, y) = (p("x"), p("y"));
        let g = &(&x * &y) + &c((1, 3), 2);
        let (a, b) = (&g * &(&x + &y), &g * &(&x - &c((7, 1), 0)));
        assert!(!certainly_without(s("x"), &a, &b));
        assert!(!certainly_without(s("y"), &a, &b));
        // Without the divisor, and in either order.
        let (a, b) = (&x + &y, &x - &c((7, 1), 0));
        assert!(certainly_without(s("x"), &a, &b) && certainly_without(s("x"), &b, &a));
        // x + i y and x − i y, and a divisor that only complex numbers show.
        let iy = &c((0, 1), 1) * &y;
        let norm = &(&x * &x) + &(&y * &y);
        assert!(certainly_without(s("x"), &(&x + &iy), &(&x - &iy)));
        assert!(!certainly_without(s("x"), &norm, &(&x + &iy)));
    }

    #[test]
    fn what_images_cannot_tell_is_not_certain() {
        let (x, y) = (p("x"), p("y"));
        // At the value of y both leading coefficients vanish.
        let lead = &y - &c((VALUE as i64, 1), 0);
        let (a, b) = (&(&lead * &x) + &c((1, 1), 0), &(&lead * &x) + &c((2, 1), 0));
        assert!(!certainly_without(s("x"), &a, &b));
        // One that does not is enough.
        assert!(certainly_without(s("x"), &a, &(&x + &y)));
        let fine = &x + &c((1, PRIME), 0);
        assert!(!certainly_without(s("x"), &fine, &(&x + &y)));
        // Two numbers that differ by the prime have the same image.
        let beyond = &x + &c((PRIME as i64, 1), 0);
        assert!(!certainly_without(s("x"), &beyond, &x));
    }
}
