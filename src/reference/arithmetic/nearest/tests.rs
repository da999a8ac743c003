use super::*;
use proptest::prelude::*;
use rug::Assign;

type Function = fn(&Float, u32) -> Rounded;

/// Functions with MPFR's.
fn pairs() -> [(Function, Function); 4] {
    [
        (exp, |x, p| {
            Float::with_val_round(p, x.exp_ref(), Round::Nearest)
        }),
        (log, |x, p| {
            Float::with_val_round(p, x.ln_ref(), Round::Nearest)
        }),
        (sin, |x, p| {
            Float::with_val_round(p, x.sin_ref(), Round::Nearest)
        }),
        (cos, |x, p| {
            Float::with_val_round(p, x.cos_ref(), Round::Nearest)
        }),
    ]
}

/// A number of some bits, next to a multiple of `π/4` or `ln 2`, a power of two, a double or anything.
fn number(bits: u32, kind: u8, words: [u64; 4], e: i32, n: i32, off: i32) -> Float {
    let mut x = Float::with_val(256, Integer::from_digits(&words, rug::integer::Order::Lsf));
    x >>= 256;
    x <<= e;
    let near = match kind {
        0 => (Float::with_val(400, Constant::Pi) * n) >> 2u32,
        1 => Float::with_val(400, Constant::Log2) * n,
        2 => Float::with_val(400, 1) << (n % 22),
        3 => Float::with_val(53, &x),
        4 => Float::with_val(400, n),
        _ => x,
    };
    let near = match off {
        0 => near,
        _ => near + (Float::with_val(400, off) >> off.unsigned_abs().min(120)),
    };
    let mut y = Float::new(bits);
    y.assign(&near);
    y
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// Value and ternary value are those of MPFR, to the last bit.
    #[test]
    fn rounds_as_mpfr(
        bits in 24u32..300,
        prec in 30u32..210,
        kind in 0u8..7,
        words in any::<[u64; 4]>(),
        e in -40i32..22,
        n in 1i32..2_000_000,
        off in -130i32..130,
        negative in any::<bool>(),
        small in any::<bool>(),
    ) {
        let n = if small { n % 12 + 1 } else { n };
        let x = number(bits, kind, words, e, n, off);
        let signed = if negative { -x.clone() } else { x.clone() };
        for (k, (ours, theirs)) in pairs().into_iter().enumerate() {
            let x = if k == 1 { &x } else { &signed };
            if x.is_zero() || (k == 1 && x.is_sign_negative()) {
                continue;
            }
            prop_assert_eq!(ours(x, prec), theirs(x, prec), "{} at {} to {}", k, x, prec);
        }
        let both = sin_cos(&signed, prec);
        prop_assert_eq!(both, [sin(&signed, prec), cos(&signed, prec)]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// Powers and angles are those of MPFR, to the last bit.
    #[test]
    fn rounds_two_arguments_as_mpfr(
        bits in 24u32..300,
        prec in 30u32..210,
        kind in 0u8..7,
        words in any::<[u64; 4]>(),
        e in -40i32..22,
        n in 1i32..60,
        off in -130i32..130,
        other in 0u8..4,
        f in -45i32..12,
        signs in any::<[bool; 2]>(),
    ) {
        let x = number(bits, kind, words, e, n, off).abs();
        let y = match other {
            0 => Float::with_val(64, n) >> (f.unsigned_abs() % 8),
            1 => Float::with_val(bits, words[1]) >> (64 - f),
            2 => Float::with_val(53, words[2] as f64) >> (64 - f),
            _ => Float::with_val(bits, &x * f),
        };
        if x.is_zero() || y.is_zero() {
            return Ok(());
        }
        let [a, b] = [(&x, signs[0]), (&y, signs[1])].map(|(z, s)| if s { -z.clone() } else { z.clone() });
        if y.get_exp() <= Some(10) {
            let theirs = Float::with_val_round(prec, (&x).pow(&b), Round::Nearest);
            prop_assert_eq!(pow(&x, &b, prec), theirs, "{}^{} to {}", x, b, prec);
        }
        let theirs = Float::with_val_round(prec, b.atan2_ref(&a), Round::Nearest);
        prop_assert_eq!(atan2(&b, &a, prec), theirs, "({}, {}) to {}", a, b, prec);
        let theirs = Float::with_val_round(prec, b.atan_ref(), Round::Nearest);
        prop_assert_eq!(atan(&b, prec), theirs, "{} to {}", b, prec);
    }
}

/// Most numbers of moderate size are not left to MPFR.
#[test]
fn words_decide() {
    for k in 1..400 {
        let x = Float::with_val(150, k) / 7;
        assert!(exp_in_words(&x, 180).is_some(), "{x}");
        assert!(log_in_words(&x, 180).is_some() || k == 7, "{x}");
        let y = Float::with_val(53, 1.5) / k;
        assert!(pow_in_words(&x, &y, 180).is_some() || k == 7, "{x}^{y}");
        assert!(
            atan2_in_words(&x, &Float::with_val(60, -2), 180).is_some(),
            "{x}"
        );
        let [sine, cosine] = waves_in_words(&x, 180).unwrap();
        assert!(
            rounded(&sine, 180).is_some() && rounded(&cosine, 180).is_some(),
            "{x}"
        );
    }
}

/// The values in words are within the errors that are proved, in units.
#[test]
fn errors_are_below_their_bounds() {
    let mut worst = [0.0_f64; 3];
    for k in 1..3000_u32 {
        let x = Float::with_val(230, k * k) / 700_000 + Float::with_val(230, 3).sqrt() / k;
        let units = |v: &[u64], y: Float| {
            let v = Float::with_val(600, Integer::from_digits(v, rug::integer::Order::Lsf));
            (v - (y << fixed::PLACES)).abs().to_f64()
        };
        let fixed_x = fixed::of_float(&x).unwrap();
        let (m, n) = power(&fixed_x, k % 2 == 0).unwrap();
        let y =
            Float::with_val(600, if k % 2 == 0 { -x.clone() } else { x.clone() }).exp() >> n as i32;
        worst[0] = worst[0].max(units(&m, y));
        let [(sine, _), (cosine, _)] = circle(&x).unwrap();
        let (s, c) = Float::with_val(600, &x).sin_cos(Float::new(600));
        worst[1] = worst[1].max(units(&sine, s.abs()));
        worst[2] = worst[2].max(units(&cosine, c.abs()));
    }
    let bounds = [EXP_ERROR, WAVE_ERROR, WAVE_ERROR].map(|x| x as f64);
    assert!(worst.iter().zip(bounds).all(|(a, b)| *a < b), "{worst:?}");
}
