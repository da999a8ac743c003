use super::*;
use crate::pinned::{bit_by_bit, largest, units};
use mechaudit_reference::faddeeva::w_f64;
use rug::Float;

fn proved(change: impl FnOnce(&mut code::Again)) -> [f64; 3] {
    let mut c = code::again();
    change(&mut c);
    match Again::of(&c, code::constants().half_pi) {
        Ok(found) => [found.near, found.far, found.long],
        Err(_) => [f64::INFINITY; 3],
    }
}

#[test]
fn bounds_are_little_above_one_rounding() {
    let found = proved(|_| ());
    assert!(found.iter().all(|k| (0.5..2.5).contains(k)), "{found:?}");
    let c = code::again();
    let parts = [exponential(&c), circle(&c, 10.0), truncation()];
    let found = [largest("bounds", found), largest("parts", parts)];
    let due = [
        ("bounds", 0x6db8fd9595c4e724, 2.195758289210036),
        ("parts", 0xfadbfd75e374ca16, 45.439848378963276),
    ];
    bit_by_bit(&found, &due);
}

/// A weight off, a node moved, a factorial without its low part, 2π/23 or a word of ln 2 wrong, a
/// limit moved.
#[test]
fn faults_show() {
    let [near, far, long] = proved(|_| ());
    let off = |x: f64| f64::from_bits(x.to_bits() + 1);
    assert!(proved(|c| c.weights[1][1][3] = 0.0)[0] > 1.2 * near);
    assert!(proved(|c| c.nodes[0][5] = off(c.nodes[0][5]))[0].is_infinite());
    assert!(proved(|c| c.two_pi[1].1 = 0.0)[0].is_infinite());
    assert!(proved(|c| c.long[0].1[3] ^= 1 << 20)[2].is_infinite());
    assert!(proved(|c| c.vanishing[0] = 2f64.powi(-41))[0] > 1.2 * near);
    assert!(proved(|c| c.vanishing[1] = 2f64.powi(-24))[1] > 1.2 * far);
    assert!(long < 0.51);
    static NONE: [[f64; 2]; 32] = [[0.0; 2]; 32];
    assert!(proved(|c| c.inverse_factorial = &NONE)[0] > 1.2 * near);
    let [p, q, _] = code::constants().half_pi;
    let c = code::again();
    assert!(Again::of(&c, [p, q, 0.0]).is_ok_and(|found| found.near > 1.2 * near));
}

/// Along the curve on which both terms have one size, and beside it, pairs are within E M of w.
#[test]
fn errors_of_pairs_are_below_their_bounds() {
    let mut unit = units(17);
    let c = code::again();
    let [near, far, _] = proved(|_| ());
    let mut most = [0.0f64; 2];
    for i in 0..6000 {
        let b = 1.3 * 2f64.powf(24.0 * unit());
        let d = (2.0 * 1.7725 * 1.4143 * b).ln() + 3.0 * (unit() - 0.5);
        let a = b.hypot(d.max(0.1).sqrt());
        let k = usize::from(a >= 4096.0);
        let [re, im] = code::in_pairs(a, b);
        let w = w_f64(a, -b, 140).expect("decided");
        let part = |(hi, lo): (f64, f64), w: &Ball| {
            (Float::with_val(400, hi) + Float::with_val(400, lo) - w.mid()).square()
        };
        let off = (part(re, &w.re) + part(im, &w.im)).sqrt();
        let size = ((b - a) * (b + a)).exp().max(a / (a * a + b * b));
        let off = (off / size).to_f64() / c.vanishing[k] * TWO_52;
        let bound = [near, far][k] - 0.5;
        assert!(off <= bound, "{i} {a} {b} {off} {bound}");
        most[k] = most[k].max(off / bound);
    }
    assert!(most.into_iter().all(|m| m > 1e-4), "{most:?}");
}

/// Constants of another number are refused, each by itself.
#[test]
fn wrong_constants_are_refused() {
    let refused = |change: fn(&mut code::Again)| proved(change)[2].is_infinite();
    assert!(!refused(|_| ()));
    for change in [
        (|c| c.two_pi[0].1 += 1e-30) as fn(&mut code::Again),
        |c| c.two_pi[1].1 += 1e-31,
        |c| c.inverse_sqrt_pi.1 += 1e-32,
        |c| c.long[1].1[2] ^= 1,
        |c| c.long[2].1[0] ^= 1,
        |c| c.long[0].0 += 1,
        |c| c.long_rule.0 = 51,
        |c| c.long_rule.1 = 12.0,
        |c| c.nodes[1][3] = c.nodes[1][3].next_up(),
    ] {
        assert!(refused(change));
    }
    // The last bit of 256 does not decide, the last but one does.
    assert!(!refused(|c| c.long[0].1[3] ^= 1) && refused(|c| c.long[0].1[3] ^= 2));
    assert!(are_pairs(&[0.0, 0.89]) && !are_pairs(&[0.0, 0.91]) && !are_pairs(&[f64::NAN]));
}

/// As many coefficients count as the code has terms, and ln 2 by the largest number of times that
/// it is taken.
#[test]
fn constants_count_as_often_as_they_are_used() {
    type Of = fn(&code::Again) -> f64;
    let sound = code::again();
    let with = |n: usize| {
        let mut table = sound.inverse_factorial.to_vec();
        table[n] = table[n].map(|x| 1e8 * x);
        let mut c = code::again();
        c.inverse_factorial = table.leak();
        c
    };
    let turned: Of = |c| circle(c, 0.0);
    for (of, used, others) in [
        (exponential as Of, [1, 15, 16], [17, 18]),
        (turned, [1, 26, 27], [28, 29]),
    ] {
        let base = of(&sound);
        for n in used {
            assert!(of(&with(n)) > base, "{n}");
        }
        for n in others {
            assert_eq!(of(&with(n)), base, "{n}");
        }
    }
    // e^x is squared three times: 2200 (1 + m)⁷/e^{−½ ln 2} parts of what ln 2 lacks.
    let mut c = code::again();
    let lost = c.ln_2[2].abs();
    c.ln_2[2] = 0.0;
    let more = (exponential(&c) - exponential(&sound)) / (2200.0 * lost / (U * U));
    assert!((1.8..2.2).contains(&more), "{more}");
}
