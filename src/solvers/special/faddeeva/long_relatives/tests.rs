use super::super::tests::Random;
use super::super::tests::exact::{crossing, error, float};
use super::super::{dawson as dawson_f64, erf, erfc as erfc_f64, w_derivative};
use mechaudit_reference::{ComplexBall, Undecided, faddeeva as reference};
use num_complex::Complex;
use rug::{Float, Rational};

type Solver = fn(Complex<f64>) -> Complex<f64>;
type Reference = fn(&Rational, &Rational, u32) -> Result<ComplexBall, Undecided>;

/// The worst component in units of ε, below the normal numbers in those of the smallest.
fn off(solver: Solver, exact: Reference, z: Complex<f64>) -> f64 {
    let [x, y] = [z.re, z.im].map(|t| Rational::from_f64(t).expect("finite"));
    let (got, exact) = (solver(z), exact(&x, &y, 80).expect("decided"));
    let one = |got: f64, exact: &Float| {
        let size = exact.clone().abs().max(&float(f64::MIN_POSITIVE));
        error(&float(got), exact, &size) / f64::EPSILON
    };
    one(got.re, exact.re.mid()).max(one(got.im, exact.im.mid()))
}

/// The `f64` next to the curves on which a component is zero: each component within `bound` ε.
/// Audits draw far more of them (`zero-curves-of-re`, `zero-curves-of-im`).
fn check(seed: u64, solver: Solver, exact: Reference, bound: f64) {
    let mut random = Random(seed);
    let mut worst = (0.0f64, Complex::ZERO);
    let mut n = 0;
    for k in 0..2000 {
        let (x, y) = match k % 8 {
            0 => {
                let x = random.power(3.0, 18.0);
                (x, x + random.between(-20.0, 20.0) / x)
            }
            1 => (random.between(0.8, 1.1), random.power(-30.0, -2.0)),
            _ => (random.between(0.0, 9.0), random.between(0.0, 9.0)),
        };
        let (x, y) = if random.below(2) == 0 { (x, y) } else { (y, x) };
        let z = [x, y].map(|t| if random.below(2) == 0 { t } else { -t });
        let (re, across) = (random.below(2) == 0, random.below(2) == 0);
        let at = |t: f64| match across {
            true => Complex::new(z[0], t),
            false => Complex::new(t, z[1]),
        };
        let f = |t: f64| {
            let w = solver(at(t));
            if re { w.re } else { w.im }
        };
        // A quarter of a turn of the phase.
        let (t, other) = if across { (z[1], z[0]) } else { (z[0], z[1]) };
        let step = std::f64::consts::FRAC_PI_4 / other.abs().max(0.5);
        let size = |z: Complex<f64>| (z.re * z.re - z.im * z.im).abs();
        if size(at(t)) > 600.0 || size(at(t + step)) > 600.0 || t * (t + step) < 0.0 {
            continue;
        }
        for t in crossing(f, t, t + step).into_iter().flatten() {
            let off = off(solver, exact, at(t));
            n += 1;
            if !(off <= worst.0) {
                worst = (off, at(t));
            }
        }
    }
    println!("{} ε at {:e}, {n} points", worst.0, worst.1);
    assert!(worst.0 < bound && n > 250, "{worst:?}, {n} points");
}

/// Where Re erf is 1 beside the imaginary axis, down to subnormal distances from it.
#[test]
fn erfc_beside_the_imaginary_axis() {
    let mut random = Random(185);
    let mut worst = (0.0f64, Complex::ZERO);
    for _ in 0..400 {
        let y = random.between(1.0, 26.7);
        let guess = 0.5 * std::f64::consts::PI.sqrt() * (-y * y).exp();
        let f = |x: f64| erfc_f64(Complex::new(x, y)).re;
        for x in crossing(f, 0.5 * guess, 2.0 * guess).into_iter().flatten() {
            let z = Complex::new(x, y);
            let off = off(erfc_f64, reference::erfc, z);
            if !(off <= worst.0) {
                worst = (off, z);
            }
        }
    }
    println!("{} ε at {:e}", worst.0, worst.1);
    assert!(worst.0 > 0.0 && worst.0 < 2.5, "{worst:?}");
}

#[test]
fn erf_next_to_zero_curves() {
    check(181, erf, reference::erf, 2.5);
}

#[test]
fn erfc_next_to_zero_curves() {
    check(182, erfc_f64, reference::erfc, 2.5);
}

#[test]
fn dawson_next_to_zero_curves() {
    check(183, dawson_f64, reference::dawson, 2.5);
}

#[test]
fn derivatives_next_to_zero_curves() {
    check(
        184,
        w_derivative,
        |x, y, bits| reference::w_derivative(1, x, y, bits),
        2.5,
    );
}
