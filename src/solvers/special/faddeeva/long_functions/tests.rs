use super::super::tests::Random;
use super::super::tests::exact::{error, gaussian as exact, pi};
use super::*;
use rug::float::Constant;
use rug::{Float, Rational};

#[test]
fn constants() {
    let ln_2 = Float::with_val(256, Constant::Log2);
    assert_eq!(LN_2.exact(), ln_2);
    assert_eq!(HALF_PI.exact(), pi(256) / 2u32);
}

/// Phases of any size, also next to multiples of π/2, and exponents of any size.
#[test]
fn gaussians() {
    let mut random = Random(161);
    let mut worst = 0.0f64;
    for k in 0..2000 {
        let a = random.power(if k % 2 == 0 { -60.0 } else { 0.0 }, 40.0);
        let y = match k % 4 {
            // The f64 next to such a multiple.
            0 | 1 => {
                let quarter = std::f64::consts::FRAC_PI_4;
                let n = (a * a / quarter).round().max(1.0);
                n * quarter / a
            }
            _ => a + random.between(-1.0, 1.0) * 600.0 / (2.0 * a.max(20.0)),
        };
        if !((y - a) * (y + a) < 690.0 && (y - a) * (y + a) > -690.0) {
            continue;
        }
        for y in [y, -y] {
            let ((re, im), (c, s)) = (gaussian(a, y), exact(a, y));
            let size = Float::with_val(640, c.hypot_ref(&s));
            let off = error(&re.exact(), &c, &size).max(error(&im.exact(), &s, &size));
            worst = worst.max(off);
            // A small phase keeps all digits.
            if a * y.abs() < 0.1 {
                worst = worst.max(error(&im.exact(), &s, &s));
            }
        }
    }
    println!("2^{:.1}", worst.log2());
    assert!(worst < 2f64.powi(-208), "{worst:e}");
}

#[test]
fn quarter_turns() {
    for x in [0.0, 0.5, 0.75, -1.25, 3.0, -2.5, 7.875] {
        let (re, im) = exp(Long::ZERO, Angle::quarters(x));
        let angle = pi(640) / 2u32 * Rational::from_f64(x).expect("finite");
        let one = Float::with_val(640, 1);
        let (sin, cos) = angle.sin_cos(Float::new(640));
        assert!(
            error(&re.exact(), &cos, &one).max(error(&im.exact(), &sin, &one)) < 2f64.powi(-240)
        );
    }
}
