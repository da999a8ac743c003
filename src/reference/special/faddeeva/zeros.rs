//! Zeros of w, all in the lower half-plane, in pairs z and −conj z, and of erf, in fours ±z, ±conj
//! z.
//!
//! # Start
//! With `λ = √((k − 1/8)π)` and `μ = ln(2λ√(2π))` the k-th zero of erfc in the second quadrant is
//! `−λ + μ/(4λ) + i(λ + μ/(4λ))` and terms of order λ^-3 (DLMF §7.13(ii)); erfc(ζ) = 0 means
//! `w(iζ) = 0`, and the mirror image of iζ is `λ + μ/(4λ) − i(λ − μ/(4λ))`. Of erf there is
//! `λ − μ/(4λ) + i(λ + μ/(4λ))` with `μ = ln(λ√(2π))`.
//!
//! # Certificate
//! Newton's method at rising precision, then the Newton–Kantorovich theorem (Ortega & Rheinboldt
//! 12.6.2) at the last iterate z_0: with `β ≥ 1/|w'(z_0)|`, `η ≥ β|w(z_0)|` and M a Lipschitz
//! constant of w' on the disc of radius 2η, `βηM ≤ 1/2` implies a zero within 2η, the only one
//! there. From `w'' = (4z² − 2) w − 4iz/√π` and, on the disc, `|w| ≤ e^{2Zr} (|w(z_0)| + 2r/√π)`, r
//! = 2η, Z = |z_0| + r (Grönwall for w' = −2zw + 2i/√π):
//!
//! ```text
//! M = (4Z² + 2) e^{2Zr} (|w(z_0)| + 2r/√π) + 4Z/√π
//! ```
//!
//! For erf, `erf'' = −2z erf'` and `|e^{−z²}| ≤ e^{2Zr} |e^{−z_0²}|` on the disc give
//! `M = 2Z e^{2Zr} |erf'(z_0)|`.

use super::argument::Real;
use super::gaussian::Gaussian;
use super::related::erf_once;
use super::scaled::Scaled;
use super::w_ball;
use crate::{Ball, ComplexBall, Mag, Undecided};
use rug::Float;
use std::f64::consts::{FRAC_2_SQRT_PI, PI};

/// Describes what is proved about a function at an exact point: its value, its derivative, and Z
/// and r from which a Lipschitz constant of the derivative follows.
struct Function {
    /// Value and derivative at a point, at a working precision.
    at: fn(&ComplexBall, u32) -> Option<[ComplexBall; 2]>,
    /// M from bounds on the value and on the derivative at the centre, Z, r and on e^{2Zr}.
    lipschitz: fn([Mag; 2], Mag, Mag, Mag) -> Mag,
}

const W: Function = Function {
    at: |z, prec| {
        let w = w_ball(z, prec);
        let two = Ball::integer(prec, 2);
        let t = (z * &w).scaled(&-two.clone());
        let slope = ComplexBall::new(t.re, t.im + &(two / &Ball::pi(prec).sqrt()));
        Some([w, slope])
    },
    lipschitz: |[size, _], z, r, grown| {
        let slope = Mag::from_f64(FRAC_2_SQRT_PI.next_up());
        let w = grown.mul(size.add(slope.mul(r)));
        let four = z.mul(z).shift(2).add(Mag::from_f64(2.0));
        four.mul(w).add(slope.shift(1).mul(z))
    },
};

const ERF: Function = Function {
    at: |z, prec| {
        let (x, y) = (z.re.mid().clone(), z.im.mid().clone());
        let e = erf_once(&Real::Float(x), &Real::Float(y), prec)?;
        let [re, im] = e.map(|part| part.to_ball_or_tiny());
        let g = Gaussian::new(&z.re, &z.im, prec);
        let slope = Ball::integer(prec, 2) / &Ball::pi(prec).sqrt();
        let power = |b: Ball| Scaled::shifted(&(b * &slope), &g.k);
        let slope = ComplexBall::new(power(g.c.clone()), power(-&g.s));
        Some([ComplexBall::new(re, im), slope])
    },
    lipschitz: |[_, slope], z, _, grown| z.shift(1).mul(grown).mul(slope),
};

fn exact(z: &ComplexBall, prec: u32) -> ComplexBall {
    let part = |b: &Ball| Ball::new(Float::with_val(prec, b.mid()), Mag::ZERO);
    ComplexBall::new(part(&z.re), part(&z.im))
}

/// A bound on the distance of a zero from the exact point z with that value and derivative, if
/// there certainly is one.
fn certificate(f: &Function, z: &ComplexBall, [value, slope]: &[ComplexBall; 2]) -> Option<Mag> {
    let below = slope.mignitude();
    let size = value.magnitude();
    let eta = size.div(below);
    if !eta.is_finite() {
        return None;
    }
    let r = eta.shift(1);
    let z = z.magnitude().add(r);
    let t = z.mul(r).shift(1);
    if !(t <= Mag::from_f64(1.0)) {
        return None;
    }
    // e^t ≤ 1 + 2t for t ≤ 1.
    let grown = Mag::from_f64(1.0).add(t.shift(1));
    let m = (f.lipschitz)([size, slope.magnitude()], z, r, grown);
    (eta.mul(m).div(below) <= Mag::from_f64(0.5)).then_some(r)
}

/// `λ` and `μ/(4λ)`, `μ = ln(factor λ√(2π))`.
fn start(k: u32, factor: f64) -> (f64, f64) {
    let lambda = ((f64::from(k) - 0.125) * PI).sqrt();
    let part = (factor * lambda * (2.0 * PI).sqrt()).ln() / (4.0 * lambda);
    (lambda, part)
}

/// The k-th zero of w (k = 1, 2, …) with positive real part, counted by the asymptotic expansion
/// (DLMF §7.13(ii)), i.e. by increasing modulus. Existence and uniqueness in a neighbourhood are
/// proved; each component has a relative radius of at most 2^-bits. Its mirror image `−conj z` is a
/// zero as well, and there are no others in the plane.
///
/// # Errors
/// k = 0, or no certificate at `4 bits + 4096` bits.
pub fn zero(k: u32, bits: u32) -> Result<ComplexBall, Undecided> {
    let (lambda, part) = start(k, 2.0);
    numbered(k, ("w", &W), (lambda + part, part - lambda), bits)
}

/// The k-th zero of erf (k = 1, 2, …) in the first quadrant, counted and proved as for [`zero`].
/// Its mirror images `−z` and `±conj z` are zeros as well; the only other one is 0.
///
/// # Errors
/// As [`zero`].
pub fn zero_of_erf(k: u32, bits: u32) -> Result<ComplexBall, Undecided> {
    let (lambda, part) = start(k, 1.0);
    numbered(k, ("erf", &ERF), (lambda - part, lambda + part), bits)
}

/// The zero of that number, from where it nearly is.
fn numbered(
    k: u32,
    (name, f): (&str, &Function),
    start: (f64, f64),
    bits: u32,
) -> Result<ComplexBall, Undecided> {
    if k == 0 {
        let reason = format!("the zeros of {name} are counted from one");
        return Err(Undecided::new(bits, reason));
    }
    refined(f, start, bits)
        .map_err(|(at, why)| Undecided::new(at, format!("zero {k} of {name}: {why}")))
}

/// Returns whether either component of what is within r of z has `bits` bits.
fn accurate(z: &ComplexBall, r: Mag, bits: u32) -> bool {
    let least = z.re.mignitude().min(z.im.mignitude());
    r <= least.shift(-i64::from(bits))
}

/// The zero that Newton's method finds from a start; or the precision reached and what is missing.
fn refined(f: &Function, start: (f64, f64), bits: u32) -> Result<ComplexBall, (u32, &'static str)> {
    /// A relative step after which a certificate is tried: the next step has twice as many bits.
    const LAST: i64 = -32;
    let mut prec = 96;
    let mut z = ComplexBall::new(Ball::exact(prec, start.0), Ball::exact(prec, start.1));
    let cap = 4 * bits.max(64) + 4096;
    let mut steps = 0;
    let mut here = (f.at)(&z, prec).ok_or((prec, "no value"))?;
    loop {
        let step = here[0].div(&here[1]);
        if !step.is_finite() {
            return Err((prec, "no Newton step"));
        }
        z = exact(&(&z - &step), prec);
        here = (f.at)(&z, prec).ok_or((prec, "no value"))?;
        steps += 1;
        if steps < 7 && step.magnitude() > z.magnitude().shift(LAST) {
            continue;
        }
        if let Some(r) = certificate(f, &z, &here)
            && accurate(&z, r, bits)
        {
            return Ok(z.widened(r));
        }
        if prec >= cap {
            return Err((prec, "no certificate"));
        }
        // Each step doubles the correct digits.
        prec = (2 * prec).min((bits + 64).max(prec + 32)).min(cap);
        z = exact(&z, prec);
        here = (f.at)(&z, prec).ok_or((prec, "no value"))?;
    }
}

#[cfg(test)]
mod tests {
    use super::super::erf;
    use super::*;
    use crate::Decimal;

    /// Terms of order λ^-3 are left out.
    #[test]
    fn starts_are_near_the_zeros() {
        for k in [3, 10, 40, 100, 1000] {
            let near = |z: &ComplexBall, (x, y): (f64, f64), lambda: f64| {
                let off = (z.re.to_f64() - x).hypot(z.im.to_f64() - y);
                assert!(off < 2.0 / lambda.powi(3), "{k}: {off}");
            };
            let (lambda, part) = start(k, 2.0);
            near(
                &zero(k, 60).unwrap(),
                (lambda + part, part - lambda),
                lambda,
            );
            let (lambda, part) = start(k, 1.0);
            let z = zero_of_erf(k, 60).unwrap();
            near(&z, (lambda - part, lambda + part), lambda);
        }
    }

    /// 2^-bits of the least that either component may be.
    #[test]
    fn both_components_have_the_bits() {
        let ball = |mid: f64, rad: f64| Ball::exact(64, mid).widened(Mag::from_f64(rad));
        for (re, im, due) in [
            (ball(1.0, 0.0), ball(-4.0, 0.0), [true, false]),
            (ball(-4.0, 0.0), ball(1.0, 0.0), [true, false]),
            (ball(4.0, 0.0), ball(4.0, 0.0), [true, true]),
            (ball(4.0, 0.0), ball(2.25, 1.0), [true, false]),
            (ball(-2.25, 1.0), ball(4.0, 0.0), [true, false]),
            (ball(4.0, 0.0), ball(0.5, 0.0), [false, false]),
        ] {
            let z = ComplexBall::new(re, im);
            let found = [-10, -9].map(|k| accurate(&z, Mag::power_of_two(k), 10));
            assert_eq!(found, due, "{z:?}");
        }
    }

    /// Seven steps that do not end, and then one at each precision: twice as many bits, up to 64
    /// more than are asked for, 32 more each time, and at last four times as many and 4096.
    #[test]
    fn what_has_no_certificate_ends() {
        use std::cell::RefCell;
        thread_local! {
            static ASKED: RefCell<Vec<u32>> = const { RefCell::new(Vec::new()) };
        }
        let f = Function {
            // A step of one, always.
            at: |_, prec| {
                ASKED.with_borrow_mut(|asked| asked.push(prec));
                let one = ComplexBall::new(Ball::integer(prec, 1), Ball::integer(prec, 0));
                Some([one.clone(), one])
            },
            lipschitz: |_, _, _, _| Mag::INFINITY,
        };
        for (bits, after, cap) in [
            (20, vec![128, 160, 192], 4352),
            (100, vec![164, 196, 228], 4496),
            (300, vec![192, 364, 396], 5296),
        ] {
            ASKED.take();
            let (at, why) = refined(&f, (0.5, 0.5), bits).unwrap_err();
            assert_eq!((at, why), (cap, "no certificate"));
            let mut asked = ASKED.take();
            assert_eq!(asked[..8], [96; 8]);
            // Twice each: the value before a step, and after it.
            assert!(asked[8..].chunks(2).all(|pair| pair[0] == pair[1]));
            asked.dedup();
            assert_eq!(asked[1..4], after);
            assert_eq!(asked.last(), Some(&cap));
        }
        let endless = Function {
            at: |_, prec| {
                let zero = ComplexBall::zero(prec);
                Some([zero.clone(), zero])
            },
            lipschitz: |_, _, _, _| Mag::ZERO,
        };
        let (at, why) = refined(&endless, (0.5, 0.5), 60).unwrap_err();
        assert_eq!((at, why), (96, "no Newton step"));
    }

    /// Upper bounds on |z| and |f'| enter, and a lower one on |f'|, be the numbers exact or not.
    #[test]
    fn a_certificate_counts_what_is_not_known() {
        let real = |mid: f64, rad: f64| {
            let re = Ball::exact(64, mid).widened(Mag::from_f64(rad));
            ComplexBall::new(re, Ball::integer(64, 0))
        };
        let at: fn(&ComplexBall, u32) -> Option<[ComplexBall; 2]> = |_, _| None;
        let by = |lipschitz| Function { at, lipschitz };
        let point = by(|_, z, _, _| z);
        // η = 1/16 and r = 1/8: M = |z| + r has to be at most 2.
        let beside = |z: ComplexBall| {
            let found = certificate(&point, &z, &[real(1.0 / 64.0, 0.0), real(0.25, 0.0)]);
            found.map(Mag::to_f64)
        };
        let near = |r: f64| (0.125..0.125 + 1e-9).contains(&r);
        assert!(beside(real(1.87, 0.0)).is_some_and(near));
        assert!(beside(real(-1.5, 0.37)).is_some_and(near));
        assert!(beside(real(1.88, 0.0)).is_none() && beside(real(1.5, 0.38)).is_none());
        // M = |f'|: value/below · above/below has to be at most 1/2.
        let slope = by(|[_, slope], _, _, _| slope);
        let of = |value: f64| {
            certificate(
                &slope,
                &real(0.0, 0.0),
                &[real(value, 0.0), real(0.25, 0.125)],
            )
        };
        assert!(of(0.0208).is_some() && of(0.0209).is_none());
    }

    #[test]
    fn zeros_are_counted_from_one() {
        for found in [zero(0, 60), zero_of_erf(0, 60)] {
            assert!(found.unwrap_err().reason.contains("counted from one"));
        }
    }
    use rug::Rational;

    #[test]
    fn zeros_of_erf_are_zeros() {
        // DLMF table 7.13.1.
        for (k, x, y) in [
            (1, "1.4506161632", "1.8809430002"),
            (2, "2.2446592738", "2.6165751407"),
            (3, "2.8397410469", "3.1756280996"),
        ] {
            let z = zero_of_erf(k, 120).unwrap();
            let near = |b: &Ball, text| {
                let table = Decimal::parse(text).unwrap().value;
                let close = (b - &Ball::rational(200, &table)).magnitude();
                b.accuracy_bits() >= 119 && close < Mag::from_f64(6e-11)
            };
            assert!(near(&z.re, x) && near(&z.im, y), "{z:?}");
            // Beside it erf is erf' times the distance.
            let exact = |b: &Ball| Rational::try_from(b.mid()).unwrap();
            let e = erf(&exact(&z.re), &exact(&z.im), 60).unwrap();
            assert!(e.magnitude() < Mag::power_of_two(-100));
            let moved = exact(&z.re) + Rational::from((1, 1 << 20));
            let e = erf(&moved, &exact(&z.im), 60).unwrap();
            assert!(e.magnitude() > Mag::power_of_two(-20));
        }
        assert!(zero_of_erf(40, 1000).is_ok() && zero_of_erf(100_000, 60).is_ok());
    }

    /// Checks what each argument of a Lipschitz constant is, and where the theorem's conditions
    /// end: β η M ≤ ½, 2 Z r ≤ 1.
    #[test]
    fn certificates_end_where_the_theorem_does() {
        type Bound = fn([Mag; 2], Mag, Mag, Mag) -> Mag;
        type Expected = fn([f64; 2], f64, f64, f64) -> f64;
        let bounds: [(Bound, Expected); 6] = [
            (|_, _, _, _| Mag::from_f64(3.0), |_, _, _, _| 3.0),
            (|[v, _], _, _, _| v.shift(3), |[v, _], _, _, _| 8.0 * v),
            (|[_, s], _, _, _| s, |[_, s], _, _, _| s),
            (|_, z, _, _| z.shift(2), |_, z, _, _| 4.0 * z),
            (|_, _, r, _| r.shift(3), |_, _, r, _| 8.0 * r),
            (|_, _, _, g| g, |_, _, _, g| g),
        ];
        let ball = |x: f64, r: f64| {
            let re = Ball::new(Float::with_val(128, x), Mag::from_f64(r));
            ComplexBall::new(re, Ball::integer(128, 0))
        };
        let mut proved = [0; 2];
        for (bound, expected) in bounds {
            let f = Function {
                at: |_, _| None,
                lipschitz: bound,
            };
            for (place, slope, spread) in [
                (0.5, 1.0, 0.0),
                (1.0, 1.0, 0.25),
                (0.25, 2.0, 0.5),
                (2.0, 0.5, 0.125),
            ] {
                for k in 1..400 {
                    let value = 0.003 * f64::from(k);
                    let (v, low, high) = (
                        value * (1.0 + spread),
                        slope - 0.5 * spread,
                        slope + 0.5 * spread,
                    );
                    let eta = v / low;
                    let r = 2.0 * eta;
                    let z = place + r;
                    let t = 2.0 * z * r;
                    let share = 2.0 * eta * expected([v, high], z, r, 1.0 + 2.0 * t) / low;
                    if (t - 1.0).abs() < 1e-9 || (share - 1.0).abs() < 1e-9 {
                        continue;
                    }
                    let due = t < 1.0 && share < 1.0;
                    let here = [ball(value, value * spread), ball(slope, 0.5 * spread)];
                    let found = certificate(&f, &ball(place, 0.0), &here);
                    assert_eq!(found.is_some(), due, "{place} {slope} {spread} {value}");
                    if let Some(found) = found {
                        assert!(found.to_f64() >= r && found.to_f64() < r * (1.0 + 1e-12));
                    }
                    proved[usize::from(due)] += 1;
                }
            }
        }
        assert!(proved.iter().all(|n| *n > 500), "{proved:?}");
        // Without a slope nothing is proved.
        let f = Function {
            at: |_, _| None,
            lipschitz: |_, _, _, _| Mag::ZERO,
        };
        assert!(certificate(&f, &ball(1.0, 0.0), &[ball(0.1, 0.0), ball(0.5, 0.5)]).is_none());
    }

    #[test]
    fn lipschitz_constants_are_those_of_the_head() {
        let root = std::f64::consts::PI.sqrt();
        for (v, s, z, r, g) in [
            (0.1, 2.0, 3.0, 0.05, 1.25),
            (2.0, 0.5, 0.75, 0.25, 2.5),
            (0.0, 1.0, 0.5, 0.5, 1.0),
        ] {
            let m = Mag::from_f64;
            let of = |f: &Function| (f.lipschitz)([m(v), m(s)], m(z), m(r), m(g)).to_f64();
            let w = (4.0 * z * z + 2.0) * g * (v + 2.0 * r / root) + 4.0 * z / root;
            for (found, due) in [(of(&W), w), (of(&ERF), 2.0 * z * g * s)] {
                assert!(
                    found >= due * (1.0 - 1e-15) && found < due * (1.0 + 1e-13),
                    "{found} {due}"
                );
            }
        }
    }

    #[test]
    fn a_point_that_is_no_zero_has_no_certificate() {
        for f in [&W, &ERF] {
            let z = ComplexBall::new(Ball::exact(128, 2.0), Ball::exact(128, 2.0));
            let here = (f.at)(&z, 128).unwrap();
            assert!(certificate(f, &z, &here).is_none());
        }
    }
}
