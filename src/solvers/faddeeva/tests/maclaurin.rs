use super::super::tests::Random;
use super::super::tests::exact::{are_parts, error, float, w};
use super::*;
use crate::reference::{Ball, faddeeva};
use rug::{Float, Rational};

#[test]
fn coefficients() {
    let root = Ball::pi(300).sqrt();
    assert!(are_parts(&(Ball::integer(300, 1) / &root), &[INV_SQRT_PI]));
    // w(iy) = 1 + Σ k_n yⁿ is real: two roundings each.
    let zero = Rational::new();
    let c = faddeeva::taylor(&zero, &zero, K.len() + 1, 200).expect("decided");
    for (n, value) in K.iter().enumerate() {
        // k yⁿ = c_m (iy)ᵐ.
        let m = n + 1;
        let c = &c[m];
        let exact = match m % 4 {
            0 => c.re.mid().clone(),
            1 => Float::with_val(200, -c.im.mid()),
            2 => Float::with_val(200, -c.re.mid()),
            _ => c.im.mid().clone(),
        };
        assert!(
            error(&float(*value), &exact, &exact) <= 1.5 * f64::EPSILON,
            "{m}"
        );
    }
}

#[test]
fn next_to_zero() {
    let mut random = Random(111);
    let mut worst = 0.0f64;
    for _ in 0..20_000 {
        let (a, y) = (random.power(-60.0, -7.0), random.power(-60.0, -7.0));
        if a * a + y * y >= 1.0 / 16384.0 {
            continue;
        }
        for y in [y, -y] {
            let (re, im) = maclaurin(a, y);
            let exact = w(a, y);
            let off =
                error(&float(re), &exact.0, &exact.0).max(error(&float(im), &exact.1, &exact.1));
            worst = worst.max(off);
            assert!(off < f64::EPSILON, "{a:e} {y:e}: {off:e}");
        }
    }
    println!("{} ε", worst / f64::EPSILON);
}
