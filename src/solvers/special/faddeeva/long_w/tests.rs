use super::super::plane;
use super::super::tests::Random;
use super::super::tests::exact::{
    crossing, error, float, gaussian as exact_gaussian, pi, w as exact,
};
use super::*;
use crate::lanes::Plain;
use mechaudit_reference::faddeeva::zero;
use rug::Float;

#[test]
fn constants() {
    assert_eq!(
        INV_SQRT_PI.exact(),
        Float::with_val(256, pi(640).recip_sqrt())
    );
}

/// Both components by the larger of the terms they are the sum of.
#[test]
fn values() {
    let mut random = Random(171);
    let mut worst = (0.0f64, 0.0, 0.0);
    for k in 0..1200 {
        let (a, y) = match k % 6 {
            0 => {
                let a = random.power(1.0, 40.0);
                (a, -a + random.between(-30.0, 300.0) / (2.0 * a))
            }
            1 => (random.between(1.0, 27.5), -random.power(-1000.0, -3.0)),
            2 => (random.between(0.0, 20.0), random.between(0.0, 20.0)),
            3 => (random.power(-20.0, 12.0), random.power(-300.0, 12.0)),
            _ => (random.between(0.0, 8.0), random.between(-8.0, 0.0)),
        };
        if y < 0.0 && y * y - a * a > 600.0 {
            continue;
        }
        let (re, im) = w(a, y);
        let ((u, v), (c, s)) = (exact(a, y.abs()), exact_gaussian(a, y));
        let larger = |x: Float, y: Float| x.abs().max(&y.abs());
        let both = y < 0.0;
        let of = |x: Float, e: Float| if both { larger(x, e * 2) } else { x };
        let (p, q) = exact(a, y);
        let off = error(&re.exact(), &p, &of(u, c)).max(error(&im.exact(), &q, &of(v, s)));
        if off > worst.0 {
            worst = (off, a, y);
        }
    }
    println!("2^{:.1} at {:e} + {:e} i", worst.0.log2(), worst.1, worst.2);
    // The exact ones have 200 bits.
    assert!(worst.0 < 2f64.powi(-195), "{worst:?}");
}

/// The worst component of the solver in units of ε, below the normal numbers in those of the
/// smallest.
fn off(a: f64, y: f64) -> f64 {
    let (re, im) = plane::w(Plain, a, y);
    let exact = exact(a, y);
    let one = |got: f64, exact: &Float| {
        let size = exact.clone().abs().max(&float(f64::MIN_POSITIVE));
        error(&float(got), exact, &size) / f64::EPSILON
    };
    one(re, &exact.0).max(one(im, &exact.1))
}

/// Describes what is worst at the points of a curve.
struct Worst(f64, f64, f64, usize);

impl Worst {
    fn see(&mut self, a: f64, y: f64) {
        let off = off(a, y);
        self.3 += 1;
        if !(off <= self.0) {
            (self.0, self.1, self.2) = (off, a, y);
        }
    }
}

/// The `f64` next to the curves on which a component is zero, from either side: each component
/// within two units.
#[test]
fn next_to_zero_curves() {
    let mut random = Random(172);
    let mut worst = Worst(0.0, 0.0, 0.0, 0);
    for k in 0..6000 {
        let b = match k % 3 {
            0 => random.power(5.0, 20.0),
            _ => random.between(0.3, 20.0),
        };
        let a = match b > 20.0 {
            true => b + random.between(-300.0, 20.0) / (2.0 * b),
            false => random.between(0.0, b + 0.5),
        };
        let re = k % 2 == 0;
        let f = |a: f64, y: f64| {
            let w = plane::w(Plain, a, y);
            if re { w.0 } else { w.1 }
        };
        // A quarter of a turn of 2ab.
        let step = std::f64::consts::FRAC_PI_4 / b;
        let found = match k % 4 < 2 {
            true => crossing(|x| f(x, -b), a, a + step).map(|x| x.map(|x| (x, -b))),
            false => crossing(|y| f(a, y), -b, step - b).map(|y| y.map(|y| (a, y))),
        };
        for (a, y) in found.into_iter().flatten() {
            worst.see(a, y);
        }
    }
    let Worst(most, a, y, n) = worst;
    println!("{most} ε at {a:e} {y:e}, {n} points");
    assert!(
        most < 2.0 && n > 3000,
        "{most} ε at {a:e} {y:e}, {n} points"
    );
}

/// The same beside the real axis, where Re w = 0 for `e^{−x²} ≈ |y|/(√π x²)`.
#[test]
fn next_to_the_flat_curve() {
    let mut random = Random(173);
    let mut worst = Worst(0.0, 0.0, 0.0, 0);
    for _ in 0..400 {
        let x = random.between(2.3, 26.5);
        let y = -std::f64::consts::PI.sqrt() * x * x * (-x * x).exp();
        let found = crossing(|y| plane::w(Plain, x, y).0, 5.0 * y, 0.2 * y);
        for y in found.into_iter().flatten() {
            worst.see(x, y);
        }
    }
    let Worst(most, a, y, n) = worst;
    println!("{most} ε at {a:e} {y:e}, {n} points");
    assert!(most < 2.0 && n > 650, "{most} ε at {a:e} {y:e}, {n} points");
}

/// The `f64` around zeros, of which both components are small.
#[test]
fn next_to_zeros() {
    let mut worst = Worst(0.0, 0.0, 0.0, 0);
    for k in (1..40).chain([100, 200, 400, 1000]) {
        let z = zero(k, 60).expect("decided");
        let (x, y) = (z.re.to_f64(), z.im.to_f64());
        for x in [x.next_down(), x, x.next_up()] {
            for y in [y.next_down(), y, y.next_up()] {
                worst.see(x, y);
            }
        }
    }
    let Worst(most, a, y, _) = worst;
    println!("{most} ε at {a:e} {y:e}");
    assert!(most < 2.0, "{most} ε at {a:e} {y:e}");
}

/// Products 2ab that are next to a multiple of π/2 among all with 106 digits, within 2⁻¹⁰¹: where
/// `2e^{−z²}` stands alone, where it is far larger than w(−z), and a few powers of two farther
/// away.
#[test]
fn phases_next_to_multiples_of_a_quarter_turn() {
    for (a, b) in [
        (0x001a_c9c2_a910_5bfc_u64, 0x001e_765b_1d7d_6ef4_u64, -48),
        (0x0014_1751_fecc_44fd, 0x0014_4ee7_68fe_49f8, -47),
        (0x001a_965e_fe79_e5a0, 0x001b_c675_1095_2603, -47),
        (0x0011_7b3b_a307_f7c3, 0x0011_aa3e_2230_23a1, -46),
    ]
    .map(|(a, b, e)| {
        (
            a as f64 * f64::exp2(e.into()),
            b as f64 * f64::exp2(e.into()),
        )
    }) {
        let (c, s) = exact_gaussian(a, -b);
        let (c, s) = (c.to_f64().abs(), s.to_f64().abs());
        assert!(c.min(s) < 2f64.powi(-95) * c.max(s), "{a} {b}");
        assert!(off(a, -b) < 2.0, "{a} {b}: {}", off(a, -b));
    }
}

/// The worst that was found while double-double was all.
#[test]
fn a_point_next_to_the_flat_curve() {
    let (x, y) = (
        f64::from_bits(0x4002_ffa2_b69d_47da),
        -f64::from_bits(0x3f98_0bf8_7e53_68c8),
    );
    assert!((x - 2.374).abs() < 1e-3 && (y + 0.02348).abs() < 1e-4);
    assert!(off(x, y) < 1.0, "{}", off(x, y));
}
