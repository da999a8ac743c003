use super::super::tests::Random;
use super::super::tests::exact::{are_parts, error, float, w};
use super::*;
use mechaudit_reference::{Ball, faddeeva};
use rug::{Float, Rational};

#[test]
fn coefficients() {
    let root = Ball::pi(300).sqrt();
    assert!(are_parts(&(Ball::integer(300, 1) / &root), &[INV_SQRT_PI]));
    // w(iy) = 1 + Σ k_n yⁿ is real: two roundings each.
    let zero = Rational::new();
    let c = faddeeva::taylor(&zero, &zero, 21, 200).expect("decided");
    let check = |n: usize, value: f64| {
        // k yⁿ = c_n (iy)ⁿ.
        let c = &c[n];
        let exact = match n % 4 {
            0 => c.re.mid().clone(),
            1 => Float::with_val(200, -c.im.mid()),
            2 => Float::with_val(200, -c.re.mid()),
            _ => c.im.mid().clone(),
        };
        assert!(
            error(&float(value), &exact, &exact) <= 1.5 * f64::EPSILON,
            "{n}"
        );
    };
    for (n, value) in K.iter().enumerate() {
        check(n + 1, *value);
    }
    for (m, value) in EVEN.iter().enumerate() {
        check(2 * m + 2, *value);
    }
    for (m, value) in ODD.iter().enumerate() {
        check(2 * m + 3, *value);
    }
}

/// The worst error of a component, in units of 2⁻⁵², for |z| below 2^k.
fn worst(terms: fn(f64, f64) -> (f64, f64), k: i32, seed: u64) -> (f64, f64, f64) {
    let mut random = Random(seed);
    let mut worst = (0.0f64, 0.0, 0.0);
    let reach = f64::from(k);
    for i in 0..20_000 {
        let (a, y) = match i % 2 {
            0 => (random.power(-60.0, reach), random.power(-60.0, reach)),
            _ => (
                random.power(reach - 2.0, reach),
                random.power(reach - 2.0, reach),
            ),
        };
        if a * a + y * y >= 4f64.powi(k) {
            continue;
        }
        for y in [y, -y] {
            let (re, im) = terms(a, y);
            let exact = w(a, y);
            let off =
                error(&float(re), &exact.0, &exact.0).max(error(&float(im), &exact.1, &exact.1));
            if off > worst.0 {
                worst = (off, a, y);
            }
        }
    }
    println!(
        "{} ε at {:e} + {:e} i",
        worst.0 / f64::EPSILON,
        worst.1,
        worst.2
    );
    (worst.0 / f64::EPSILON, worst.1, worst.2)
}

#[test]
fn nine_terms_next_to_zero() {
    let off = worst(nine_terms, -7, 111);
    assert!(off.0 < 1.0, "{off:?}");
}

#[test]
fn twenty_one_terms_up_to_a_quarter() {
    let off = worst(twenty_one_terms, -2, 112);
    assert!(off.0 < 1.5, "{off:?}");
}
