use super::super::tests::Random;
use super::super::tests::exact::{BITS, error, float};
use super::*;
use rug::Float;

impl Long {
    /// The same number.
    pub fn exact(self) -> Float {
        let words = self
            .m
            .iter()
            .fold(Float::new(BITS), |sum, w| (sum << 64u32) + *w);
        let k = self.exponent - super::BITS;
        let k = i32::try_from(k).expect("in the range of MPFR");
        if self.negative {
            -(words << k)
        } else {
            words << k
        }
    }
}

/// Numbers with all their words filled, or a few bits.
fn number(random: &mut Random) -> Long {
    let mut word = || match random.below(4) {
        0 => 0,
        1 => u64::MAX,
        _ => random.bits(),
    };
    let m = [word() | 1 << 63, word(), word(), word()];
    let e = random.below(300) as i64 - 150;
    Long::normal(random.below(2) == 0, e, &m)
}

#[test]
fn operations() {
    let mut random = Random(151);
    for _ in 0..20_000 {
        let (p, mut q) = (number(&mut random), number(&mut random));
        if random.below(4) == 0 {
            // Neighbours: everything cancels but a few bits.
            q = p.scale(random.below(2) as i64) + Long::parts(p.exponent - 200, q.m);
        }
        let (x, y) = (p.exact(), q.exact());
        let larger = if x.clone().abs() > y.clone().abs() {
            &x
        } else {
            &y
        };
        for (got, exact, size, bits) in [
            (p + q, Float::with_val(BITS, &x + &y), larger, 254),
            (p - q, Float::with_val(BITS, &x - &y), larger, 254),
            (
                p * q,
                Float::with_val(BITS, &x * &y),
                &Float::with_val(BITS, &x * &y),
                254,
            ),
            (
                p.recip(),
                Float::with_val(BITS, x.recip_ref()),
                &Float::with_val(BITS, x.recip_ref()),
                252,
            ),
            (
                p.over(24),
                Float::with_val(BITS, &x / 24u32),
                &Float::with_val(BITS, &x / 24u32),
                254,
            ),
        ] {
            let off = error(&got.exact(), &exact, size);
            assert!(off < 2f64.powi(-bits), "{x} {y}: {off:e}");
        }
    }
}

#[test]
fn numbers() {
    let mut random = Random(152);
    for _ in 0..20_000 {
        let x = f64::from_bits(random.bits());
        if x.is_finite() {
            assert_eq!(Long::from(x).value(), x);
        }
        // Rounded once, subnormal or not, ties to even.
        let e = random.below(2200) as i64 - 1100;
        let digits = random.bits() >> random.below(20) << random.below(20) | 1 << 63;
        let rest = if random.below(2) == 0 {
            0
        } else {
            random.bits()
        };
        let x = Long::parts(e, [digits, rest, 0, 0]);
        let exact: Float = (Float::with_val(256, digits) << 64u32) + rest;
        assert_eq!(
            x.value(),
            Float::with_val(256, exact << (e - 128) as i32).to_f64(),
            "{x:?}"
        );
    }
    assert_eq!(Long::from(-0.0).value(), 0.0);
    assert_eq!(Long::parts(-1074, [1 << 63, 0, 0, 0]).value(), 0.0);
    assert_eq!(Long::parts(-1074, [1 << 63, 0, 0, 1]).value(), 5e-324);
    assert_eq!((Long::ONE - Long::ONE).value(), 0.0);
    assert_eq!(float(1.0), Long::ONE.exact());
}
