use super::super::tests::Random;
use super::super::tests::exact::{error, float, w};
use super::*;

/// Points beyond 10^100 that are finite and do not overflow: the nearest f64 or a neighbour of it,
/// subnormal values included.
#[test]
fn large_moduli() {
    let mut random = Random(81);
    for k in 0..2000 {
        let a = random.power(333.0, 1023.9);
        let b = match k % 4 {
            0 => a,
            1 => random.power(-1000.0, 1000.0),
            _ => a * random.power(-60.0, 0.0),
        };
        for y in [b, -b] {
            if y < 0.0 && b > a {
                continue;
            }
            let (re, im) = huge(a, y);
            let exact = w(a, y);
            for (got, exact) in [(re, exact.0), (im, exact.1)] {
                let ulp = (exact.to_f64().abs() * f64::EPSILON).max(5e-324);
                let off = error(&float(got), &exact, &float(ulp));
                assert!(off <= 2.0, "{a:e} {y:e}: {got:e}, {off} ulp");
            }
        }
    }
}

/// `w(i b)` from one number to the next, the subnormal values included.
#[test]
fn does_not_grow_along_the_imaginary_axis() {
    let mut random = Random(82);
    let at = |b: f64| on_imaginary_axis(b);
    for _ in 0..200_000 {
        let b = random.power(333.0, 1023.9);
        assert!(at(b.next_up()) <= at(b), "{b:e}");
        // Subnormal values are rounded a second time.
        let normal = at(b) >= f64::MIN_POSITIVE;
        assert!(!normal || at(b) == w(0.0, b).0.to_f64(), "{b:e}");
    }
    let b = crate::hex::hex("0x1.ae9b57f2f06f8p1015");
    assert!(at(b.next_up()) <= at(b));
}
