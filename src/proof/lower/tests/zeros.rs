use super::*;
use mechaudit_reference::faddeeva::w_f64;
use mechaudit_solvers::faddeeva::{Branch, branch, faddeeva};
use num_complex::Complex;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rug::Float;
use std::sync::LazyLock;

static ZEROS: LazyLock<Vec<Zero>> = LazyLock::new(|| AroundZeros::rows().expect("decided"));

fn proved(zeros: &[Zero]) -> f64 {
    let found = AroundZeros::of(zeros, Rounding::default(), 2.5);
    found.map_or(f64::INFINITY, |f| f.norm)
}

#[test]
fn all_zeros_have_a_bound() {
    let found = AroundZeros::of(&ZEROS, Rounding::default(), 2.5).expect("proved");
    eprintln!("{found:?}");
    assert!(found.norm > 1.0 && found.boxes > 1000);
}

/// Faults of the first zero: a coefficient off by 2⁻⁴⁶ of it, the middle part left out, the row of another zero.
#[test]
fn faults_show() {
    let sound = proved(&ZEROS[..1]);
    assert!(sound < 2.5);
    let faulty = |change: fn(&mut [f64; 46])| {
        let mut row = ZEROS[0].row;
        change(&mut row);
        proved(&[Zero::of(&row, 1).expect("decided")])
    };
    for norm in [
        faulty(|row| row[6] *= 1.0 + 2f64.powi(-46)),
        faulty(|row| row[1] = 0.0),
        faulty(|row| row[25] = 0.0),
        proved(&[Zero::of(&ZEROS[1].row, 1).expect("decided")]),
    ] {
        assert!(norm > 1.2 * sound, "{sound} {norm}");
    }
}

/// Next to the zeros, at distances of every size, the error is below the bound.
#[test]
fn errors_at_points_are_below_the_bound() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let (mut points, mut most) = (0, 0.0f64);
    for zero in ZEROS.iter() {
        let bound = proved(std::slice::from_ref(zero));
        for _ in 0..200 {
            let mut near = |x: f64| {
                let bits = random.next_u64();
                let size = 2f64.powi(-4 - (bits % 50) as i32);
                x + size * ((bits >> 11) as f64 / 2f64.powi(52) - 1.0)
            };
            let z = Complex::new(near(zero.row[0]), near(zero.row[3]));
            if !matches!(branch(z), Branch::Zero { .. }) {
                continue;
            }
            let got = faddeeva(z);
            let w = w_f64(z.re, z.im, 120).expect("decided");
            let part = |g: f64, w: &Ball| (Float::with_val(300, g) - w.mid()).square();
            let size = |w: &Ball| Float::with_val(300, w.mid().square_ref());
            let off = part(got.re, &w.re) + part(got.im, &w.im);
            let off = (off / (size(&w.re) + size(&w.im))).sqrt().to_f64() * TWO_52;
            assert!(off <= bound, "{z} {off} {bound}");
            points += 1;
            most = most.max(off);
        }
    }
    assert!(points > 2000 && most > 0.4, "{points} {most}");
}
