use super::*;
use crate::pinned::{bit_by_bit, counted, units};
use mechaudit_reference::faddeeva;

/// `√(e(N + 3/2)) T_N/T_0`, `T_N/T_0 = Π (k − ½)/|ζ|`.
fn missing(n: u32, size: f64) -> f64 {
    let ratio: f64 = (1..=n).map(|k| (f64::from(k) - 0.5) / size).product();
    (std::f64::consts::E * (f64::from(n) + 1.5)).sqrt() * ratio
}

/// Checks that what the series leaves out is in the radius, where it ends early and where it does
/// not.
#[test]
fn what_is_left_out_counts() {
    for (x, y) in [(3.0, -20.0), (5.0, -60.0), (11.0, -1500.0)] {
        let ball = |x: f64| Ball::exact(192, x);
        let (found, norm) = g(&ComplexBall::new(ball(x), ball(y)), 192);
        let due = missing(terms(f64::hypot(x, y), 192).0, f64::hypot(x, y));
        for part in [&found.re, &found.im] {
            let radius = part.rad().to_f64();
            assert!(
                radius > 0.6 * due && radius < 4.0 * due,
                "{x} {y} {radius:e} {due:e}"
            );
        }
        assert_eq!(norm.mid().to_f64(), x * x + y * y);
        // With more terms the value is another within both radii.
        let fine = |x: f64| Ball::exact(400, x);
        let (fine, _) = g(&ComplexBall::new(fine(x), fine(y)), 400);
        assert!(found.re.overlaps(&fine.re) && found.im.overlaps(&fine.im));
        // A point is less than 10⁻⁹ larger than it is taken to be.
        let n = terms(f64::hypot(x, y) * (1.0 - 1e-9), 192).0;
        assert_eq!(n, terms(f64::hypot(x, y), 192).0);
    }
}

/// Checks that what a map moves by half the limit at most has its solution within the factor of
/// that, and 2⁻¹²⁸ more.
#[test]
fn solutions_are_within_the_move() {
    let complex = |re: Ball, im: Ball| ComplexBall::new(re, im);
    let zero = || Ball::integer(192, 0);
    let moved = |k: i32| Ball::exact(192, f64::from(k).exp2());
    let enough = Mag::power_of_two(-100);
    for (k, factor) in [
        (-101, 1.05),
        (-102, 1.05),
        (-110, 2.0),
        (-127, 2.0),
        (-128, 1.05),
        (-140, 2.0),
    ] {
        let due = factor * f64::from(k).exp2() + f64::exp2(-128.0);
        for off in [complex(moved(k), zero()), complex(zero(), -moved(k))] {
            let radius = within(&off, enough, factor).expect("small").to_f64();
            assert!(
                radius >= due && radius < 1.000_001 * due,
                "{k} {factor} {radius:e}"
            );
        }
    }
    // The whole of a ball counts.
    let ball = moved(-102).widened(Mag::power_of_two(-103));
    let radius = within(&complex(ball, zero()), enough, 2.0).expect("small");
    assert!((radius.to_f64() / (3.0 * f64::exp2(-102.0)) - 1.0).abs() < 1e-6);
    let ball = moved(-101).widened(Mag::power_of_two(-100));
    assert!(within(&complex(ball, zero()), enough, 2.0).is_none());
    assert!(within(&complex(moved(-99), zero()), enough, 1.05).is_none());
    assert!(within(&complex(zero(), moved(-99)), enough, 1.05).is_none());
}

/// On the lines both terms are equal: `|2e^{−z²}| = |w(−z)|`.
#[test]
fn both_terms_are_equal() {
    let w = |x: &Float, y: &Float| {
        let part = |x: &Float| x.to_rational().expect("finite");
        faddeeva::w(&part(x), &part(y), 160).expect("decided")
    };
    for (k, j) in [(13, 200_000_000u64), (16, 3_000_000), (20, 20_000), (26, 6)] {
        for bits in [192, 400] {
            let s = line(k, j, bits).expect("found");
            let half = |sign: i64| {
                let sum = Float::with_val(400, s.mid()) + sign * j as i64;
                sum << (k - 53)
            };
            let (a, b) = (half(1), half(-1));
            let w = w(&a, &b);
            // 2 ln 2 − 2(a² − b²) = ln |w|².
            let d = Float::with_val(400, &a * &a) - Float::with_val(400, &b * &b);
            let left = Float::with_val(400, 4).ln() - 2u32 * d;
            let off = Float::with_val(400, &left - w.norm_sqr().mid().clone().ln()).abs();
            assert!(off < 1e-35, "{k} {j} {bits} {off}");
            // 2⁻¹²⁸ of D at least, which is jδ²s.
            let unit = f64::from(k - 52).exp2();
            let radius = s.rad().to_f64() * j as f64 * unit * unit;
            assert!(
                radius > 2.9e-39 && radius < 1e-35,
                "{k} {j} {bits} {radius:e}"
            );
        }
    }
    for m in [20u64, 1000, 20_000_000] {
        for bits in [192, 400] {
            let b = zero(m, bits).expect("found");
            let radius = b.rad().to_f64();
            // a is a little more than b, and 2⁻¹²⁸ of ζ moves b by 1/(2a) of it.
            let a = middle(&b);
            assert!(
                radius > 2.9e-39 / (2.2 * a) && radius < 1e-30,
                "{m} {bits} {radius:e}"
            );
        }
        let [few, more] = [192, 400].map(|bits| zero(m, bits).expect("found"));
        assert!(few.overlaps(&more));
    }
}

/// The factors are above those of the contraction, the one of zeros by less than a tenth.
#[test]
fn steps_contract_as_they_are_taken_to() {
    let at = |x: f64, p: f64| {
        let zeta = ComplexBall::new(Ball::exact(192, x), Ball::exact(192, -p));
        g(&zeta, 192).0
    };
    let small = f64::exp2(-20.0);
    for m in [super::super::FIRST, 100, 10_000] {
        let p = std::f64::consts::TAU * m as f64 - 1.5;
        let x = 1.27 + 0.5 * p.ln();
        for [u, v] in [[small, 0.0], [0.0, small]] {
            let slope = (&at(x + u, p + v) - &at(x, p)).magnitude().to_f64() / small;
            assert!(
                1.0 / (1.0 - slope) < OF_ZERO && OF_ZERO < 1.1 / (1.0 - slope),
                "{m} {slope}"
            );
        }
    }
    for k in [13, 20, 26] {
        let b = f64::from(k).exp2();
        let d = 1.27 + 0.5 * (2.0 * b * b).ln();
        // With a − b = c: a + b = D/c and P = ((D/c)² − c²)/2.
        let c = d / (2.0 * b);
        let image = |d: f64| middle(&at(d, 0.5 * ((d / c).powi(2) - c * c)).re);
        let slope = (image(d + small) - image(d)).abs() / small;
        assert!(slope > 0.01 && 1.0 / (1.0 - slope) < OF_LINE, "{k} {slope}");
    }
}

/// Against differences of the function; the first power that is left out has a factor of 20.
#[test]
fn slopes_are_those_of_the_function() {
    let h = f64::exp2(-10.0);
    for (x, y) in [(3.0, -20.0), (5.0, -60.0), (11.0, -1500.0)] {
        let zeta = |x: f64| ComplexBall::new(Ball::exact(192, x), Ball::exact(192, y));
        let gap = &g(&zeta(x + h), 192).0 - &g(&zeta(x - h), 192).0;
        let due = Complex64::new(middle(&gap.re), middle(&gap.im)) / (2.0 * h);
        let off = (slope(&zeta(x)) - due).norm();
        let enough = 40.0 * x.hypot(y).powi(-5) + 1e-11;
        assert!(off < enough, "{x} {y} {off:e}");
    }
}

/// The last step of the iteration is of any size below the limit: the zero is within what is made
/// of it.
#[test]
fn zeros_are_within_their_last_step() {
    for k in 0..60 {
        let m = (1000.0 * 1.2f64.powi(k)) as u64;
        let [few, more] = [192, 400].map(|bits| zero(m, bits).expect("found"));
        assert!(few.overlaps(&more), "{m}");
    }
}

#[test]
fn zeros_of_the_equation_are_those_of_w() {
    for m in [20, 57, 300] {
        let [exact, found] = [
            -faddeeva::zero(m, 100).expect("decided").im,
            zero(u64::from(m), 192).expect("found"),
        ];
        assert!(
            exact.overlaps(&found) && found.accuracy_bits() > 100,
            "{m} {exact:?} {found:?}"
        );
    }
}

/// Terms, values with their radii, and solutions from starts of few bits: how often an iteration
/// has to be repeated shows in the last bits.
#[test]
fn solutions_bit_by_bit() {
    let of = |size: f64| [192, 200, 201, 400].map(|bits| (residual(bits), terms(size, bits)));
    let sizes = [0.5, 3.0, 20.0, 60.0, 160.0, 400.0, 1e4, 1e8, 1e15];
    let mut unit = units(1);
    let mut points = Vec::new();
    for size in [8.0, 20.0, 60.0, 300.0, 5e4] {
        for wide in [-300, -40, -8] {
            let part = |x: f64| Ball::exact(192, x).widened(Mag::power_of_two(wide));
            let [x, y] = [size * (0.25 + unit()), -size * (1.0 + unit())];
            points.push(ComplexBall::new(part(x), part(y)));
        }
    }
    let values = points
        .iter()
        .flat_map(|z| [192, 400].map(|bits| g(z, bits)));
    let off = |k: i64| Ball::new(Float::new(64), Mag::power_of_two(k));
    let moved = [-101, -100, -99].map(|k| {
        let off = ComplexBall::new(off(k), off(-300));
        let equal = off.magnitude();
        [Mag::power_of_two(-100), equal].map(|enough| within(&off, enough, OF_ZERO))
    });
    // As many bits of a start as any library agrees about.
    let few = |x: f64| (x * 1_048_576.0).floor() / 1_048_576.0;
    let zeros = [20, 57, 3000, 1_000_000].map(|m| {
        [192, 400].map(|bits| {
            let turns = Ball::pi(bits).shift(1) * Ball::rational(bits, &Rational::from(m));
            let start = beside_zero(middle(&turns)).map(few);
            zero_from(start, &turns, bits).expect("found")
        })
    });
    let lines = [(13, 200_000_000), (16, 3_000_000), (20, 20_000), (26, 6)];
    let lines = lines.map(|(k, j)| {
        [192, 400].map(|bits| line_from(few(beside_line(k, j)), k, j, bits).expect("found"))
    });
    let found = [
        counted("terms", sizes.map(of)),
        counted("values", values),
        counted("within", moved),
        counted("zeros", zeros),
        counted("lines", lines),
    ];
    let due = [
        ("terms", 0xd02afca0f5cd78ec, 9.0),
        ("values", 0x99282c16577ada09, 30.0),
        ("within", 0x4f3a6a9762124f45, 3.0),
        ("zeros", 0xfd245d89c719bc5a, 4.0),
        ("lines", 0x650f5d5e12f85a30, 4.0),
    ];
    bit_by_bit(&found, &due);
}
