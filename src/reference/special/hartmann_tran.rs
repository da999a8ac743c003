//! The Hartmann–Tran profile: partially correlated, quadratic in the speed, hard collisions.
//!
//! N. H. Ngo, D. Lisak, H. Tran, J.-M. Hartmann, JQSRT 129 (2013) 89–100; in the form of J.
//! Tennyson et al., Pure Appl. Chem. 86 (2014) 1931–1943, with `C_n = Γ_n + iΔ_n`,
//! `c = √(ln 2)/Γ_D` and the detuning δ:
//!
//! `HT = (1/π) A/(1 − (ν − η(C₀ − 3C₂/2)) A + η C₂ B)`, `C̃₀ = (1 − η)(C₀ − 3C₂/2) + ν`,
//! `C̃₂ = (1 − η) C₂`.
//!
//! A and B are the means of 1/D and u²/D over a Maxwellian of speeds u in units of the most
//! probable one, `D = C̃₀ + C̃₂u² − iδ + iu_z/c`. What is evaluated follows from that:
//!
//! With `1/D = ∫_0^∞ e^{−sD} ds` and `λ = 1 + sC̃₂` the Gaussian integrals give
//! `A = ∫_0^∞ λ^{−3/2} e^{−s(C̃₀−iδ) − s²/(4c²λ)} ds` and B with `3/2 λ^{−5/2} − s²/(4c²) λ^{−7/2}`
//! for `λ^{−3/2}`. Put `X = (C̃₀ − iδ)/C̃₂`, `b = √Y = 1/(2cC̃₂)`, `t = √λ`,
//! `Φ = e^{−X(t²−1) − Y(t−1/t)²}`. Then `A = (2/C̃₂) ∫_1 Φ t^{−2} dt`, and with a root a of `X + Y`
//! the exponent is `−(at ∓ b/t)² + (a ∓ b)²`. Because `2b/t² = (a + b/t²) − (a − b/t²)`, the
//! derivatives of `at ∓ b/t`,
//!
//! `A = √π c (w(iZ₋) − w(iZ₊))`, `Z_± = a ± b`,
//!
//! and integrating the derivatives of `Φ/t³` and `Φ/t`
//!
//! `C̃₂ B = −1 + (√π/(2b)) ((1 − Z₋²) w(iZ₋) − (1 − Z₊²) w(iZ₊))`.
//!
//! The path ends where `Re at → +∞`: `t ~ √(sC̃₂)`, and `C̃₂(X + Y) = C̃₀ − iδ + 1/(4c²C̃₂)` has a
//! positive real part where `Re C̃₀ ≥ 0`, `Re C̃₂ ≥ 0` and not both are zero. So a is the quotient
//! of the principal roots of `C̃₂(X + Y)` and `C̃₂`, that is the root of `X + Y` in the right
//! half-plane. `Z₋ = X/Z₊` loses nothing. For `C̃₂ = 0`: `A = √π c w(iZ)`,
//! `B = √π c ((1 − Z²) w(iZ) + Z/√π)`, `Z = c(C̃₀ − iδ)`.

use super::faddeeva::{first, w_ball};
use crate::{Ball, ComplexBall, Undecided};
use rug::Rational;

/// The parameters, all in one unit but η.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// Half the width at half the height of the Doppler profile, Γ_D > 0.
    pub doppler: Rational,
    /// Γ₀ at the mean speed, and Γ₂.
    pub widths: [Rational; 2],
    /// Δ₀ and Δ₂.
    pub shifts: [Rational; 2],
    /// The frequency of velocity-changing collisions, ν ≥ 0.
    pub narrowing: Rational,
    /// The correlation, 0 ≤ η ≤ 1.
    pub correlation: Rational,
    /// The distance from the unperturbed line's place, δ.
    pub detuning: Rational,
}

/// Returns what is outside the domain, in words.
fn refused(p: &Parameters) -> Option<&'static str> {
    let [g0, g2] = &p.widths;
    if p.doppler <= 0 {
        return Some("the Doppler width must be positive");
    }
    if *g0 < 0 || *g2 < 0 || p.narrowing < 0 {
        return Some("widths and the frequency of collisions must not be negative");
    }
    if p.correlation < 0 || p.correlation > 1 {
        return Some("the correlation is of 0..1");
    }
    let [t0, t2] = tilded(p);
    if t0 < 0 || (t0 == 0 && t2 == 0) {
        return Some(
            "the width must not be negative at speed zero, (1 - eta)(Gamma0 - 3/2 Gamma2) + nu >= 0, nor zero everywhere",
        );
    }
    None
}

/// `Re C̃₀` and `Re C̃₂`.
fn tilded(p: &Parameters) -> [Rational; 2] {
    let rest = Rational::from(1 - &p.correlation);
    let [g0, g2] = &p.widths;
    let slow = g0 - Rational::from(g2 * 3u32) / 2u32;
    [slow * &rest + &p.narrowing, Rational::from(g2 * &rest)]
}

/// The complex profile, each component with a relative radius of at most 2^-bits; its real part is
/// the absorption. Im is exactly zero where δ, Δ₀ and Δ₂ are, and for δ = Δ₀ where Δ₂ and η are
/// zero.
///
/// ```
/// use mechaudit_reference::hartmann_tran::{Parameters, hartmann_tran};
/// use rug::Rational;
/// let q = |x: f64| Rational::from_f64(x).unwrap();
/// let line = Parameters {
///     doppler: q(1.0),
///     widths: [q(1.0), q(0.125)],
///     shifts: [q(0.0), q(0.0)],
///     narrowing: q(0.0),
///     correlation: q(0.0),
///     detuning: q(0.0),
/// };
/// let peak = hartmann_tran(&line, 90)?;
/// assert!(peak.re.to_decimal(20).unwrap().starts_with("0.2338697004496733"));
/// assert!(peak.im.is_zero());
/// # Ok::<(), mechaudit_reference::Undecided>(())
/// ```
///
/// # Errors
/// [`Undecided`]: parameters outside the domain, with the rule; or a component that cannot be told
/// from zero at `16 bits + 4096` bits.
pub fn hartmann_tran(p: &Parameters, bits: u32) -> Result<ComplexBall, Undecided> {
    if let Some(rule) = refused(p) {
        return Err(Undecided::new(bits, rule));
    }
    // Conjugate parameters give the conjugate profile; at the middle of a line that is but shifted
    // they are real: C̃₀ − iδ has no imaginary part where η = 0 and δ = Δ₀.
    let [at_rest, by_speed] = &p.shifts;
    let shifted = *at_rest != 0 && p.correlation != 0;
    let real = *by_speed == 0 && p.detuning == *at_rest && !shifted;
    let cap = bits.saturating_mul(16).saturating_add(4096);
    let open = "a component of the profile cannot be told from zero";
    first(bits + 64, 1, cap, open, |prec| {
        let mut found = once(p, prec)?;
        if real {
            found.im = Ball::integer(prec, 0);
        }
        let enough = |part: &Ball| part.is_zero() || part.accuracy_bits() >= i64::from(bits);
        (enough(&found.re) && enough(&found.im)).then_some(found)
    })
}

fn once(p: &Parameters, prec: u32) -> Option<ComplexBall> {
    let ball = |q: &Rational| Ball::rational(prec, q);
    let real = |x: Ball| ComplexBall::new(x, Ball::integer(prec, 0));
    let one = || real(Ball::integer(prec, 1));
    let rest = Rational::from(1 - &p.correlation);
    let [g0, g2] = &p.widths;
    let [d0, d2] = &p.shifts;
    let slow = |c0: &Rational, c2: &Rational| c0 - Rational::from(c2 * 3u32) / 2u32;
    let c = Ball::integer(prec, 2).ln().sqrt() / &ball(&p.doppler);
    let root_pi = Ball::pi(prec).sqrt();
    // C̃₀ − iδ, C̃₂, C₂, C₀ − 3C₂/2.
    let offset = ComplexBall::new(
        ball(&(slow(g0, g2) * &rest + &p.narrowing)),
        ball(&(slow(d0, d2) * &rest - &p.detuning)),
    );
    let quadratic = [Rational::from(g2 * &rest), Rational::from(d2 * &rest)];
    let c2 = ComplexBall::new(ball(g2), ball(d2));
    let at_rest = ComplexBall::new(ball(&slow(g0, g2)), ball(&slow(d0, d2)));
    let w = |z: &ComplexBall| w_ball(&z.turned(), prec);
    let (a, b) = if quadratic.iter().all(|q| *q == 0) {
        let z = offset.scaled(&c);
        let w = w(&z);
        let scale = &root_pi * &c;
        let second = &(&(&one() - &(&z * &z)) * &w) + &z.scaled(&root_pi.recip());
        (w.scaled(&scale), second.scaled(&scale))
    } else {
        let t2 = ComplexBall::new(ball(&quadratic[0]), ball(&quadratic[1]));
        let root_y = inverse(&t2)?.scaled(&c.recip().shift(-1));
        let x = quotient(&offset, &t2)?;
        let root = root(&(&x + &(&root_y * &root_y)))?;
        let plus = &root + &root_y;
        let minus = quotient(&x, &plus)?;
        let (wp, wm) = (w(&plus), w(&minus));
        let scale = &root_pi * &c;
        let first = (&wm - &wp).scaled(&scale);
        let part = |z: &ComplexBall, w: &ComplexBall| &(&one() - &(z * z)) * w;
        // √π/(2b C̃₂) = √π c.
        let second = (&part(&minus, &wm) - &part(&plus, &wp)).scaled(&scale);
        (first, &second - &inverse(&t2)?)
    };
    let eta = ball(&p.correlation);
    let first = &real(ball(&p.narrowing)) - &at_rest.scaled(&eta);
    let below = &(&one() - &(&first * &a)) + &(&c2.scaled(&eta) * &b);
    let profile = quotient(&a, &below)?;
    Some(profile.scaled(&Ball::pi(prec).recip()))
}

fn inverse(z: &ComplexBall) -> Option<ComplexBall> {
    let norm = z.norm_sqr();
    (norm.is_positive() && norm.is_finite()).then(|| z.conj().scaled(&norm.recip()))
}

fn quotient(z: &ComplexBall, w: &ComplexBall) -> Option<ComplexBall> {
    Some(z * &inverse(w)?)
}

/// The principal root, where the argument is certainly not on the cut.
fn root(z: &ComplexBall) -> Option<ComplexBall> {
    let size = z.norm_sqr().sqrt();
    if !z.re.is_negative() {
        let re = (&size + &z.re).shift(-1);
        if !re.is_positive() {
            return None;
        }
        let re = re.sqrt();
        let im = &z.im / &re.shift(1);
        return Some(ComplexBall::new(re, im));
    }
    if z.im.contains_zero() {
        return None;
    }
    let im = (&size - &z.re).shift(-1).sqrt();
    let im = if z.im.is_negative() { -im } else { im };
    let re = &z.im / &im.shift(1);
    Some(ComplexBall::new(re, im))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::faddeeva;
    use crate::pinned::{Answers, Draw, pin};

    fn line(p: [f64; 8]) -> Parameters {
        let q = |x: f64| Rational::from_f64(x).expect("finite");
        Parameters {
            doppler: q(p[0]),
            widths: [q(p[1]), q(p[2])],
            shifts: [q(p[3]), q(p[4])],
            narrowing: q(p[5]),
            correlation: q(p[6]),
            detuning: q(p[7]),
        }
    }

    /// mpmath 1.4.1, 40 digits: quadrature of the integrals over s, not the closed form.
    const BY_MPMATH: [([f64; 8], &str, &str); 7] = [
        (
            [1.0, 1.0, 0.125, 0.0, 0.0, 0.0, 0.0, 0.0],
            "0.23386970044967332469",
            "0",
        ),
        (
            [1.0, 0.5, 0.0625, 0.25, -0.03125, 0.125, 0.25, 1.5],
            "0.16095040964210702468",
            "0.18606013232009396841",
        ),
        (
            [0.25, 2.0, 0.25, -0.5, 0.125, 1.0, 0.75, -3.0],
            "0.062384631106613759240",
            "-0.077763023305612296412",
        ),
        (
            [1.0, 0.25, 0.0, 0.0, 0.0625, 0.25, 0.0, 0.5],
            "0.32491360077394536706",
            "0.17387421034251290937",
        ),
        (
            [1.0, 0.5, 0.125, 0.0625, 0.015625, 0.5, 1.0, 2.0],
            "0.073215253047740147188",
            "0.16146097923007531448",
        ),
        (
            [2.0, 0.125, 0.0078125, 0.0, 0.0, 0.0, 0.0, 4.0],
            "0.018121135682422600176",
            "0.098462900463511675953",
        ),
        (
            [0.125, 4.0, 0.5, 0.0, 0.0, 2.0, 0.5, 1.0],
            "0.075449149668676839723",
            "0.019208418046011971499",
        ),
    ];

    #[test]
    fn quadrature_gives_the_same() {
        for (p, re, im) in BY_MPMATH {
            let found = hartmann_tran(&line(p), 100).unwrap();
            assert_eq!(found.re.to_decimal(20).unwrap(), re, "{p:?}");
            assert_eq!(found.im.to_decimal(20).unwrap(), im, "{p:?}");
        }
    }

    #[test]
    fn without_dependence_on_speed_it_is_the_voigt_profile() {
        let p = line([0.75, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 1.25]);
        let found = hartmann_tran(&p, 90).unwrap();
        // σ√2 = Γ_D/√ln 2 = 1/c: Re w(c(δ + iΓ₀)) c/√π.
        let prec = 300;
        let c = Ball::integer(prec, 2).ln().sqrt() / &Ball::exact(prec, 0.75);
        let z = ComplexBall::new(&c * &Ball::exact(prec, 1.25), &c * &Ball::exact(prec, 0.5));
        let due = faddeeva::w_ball(&z, prec).scaled(&(&c / &Ball::pi(prec).sqrt()));
        assert!(found.re.overlaps(&due.re) && found.im.overlaps(&due.im));
        assert!(found.re.accuracy_bits() >= 90);
    }

    /// The closed form for C̃₂ → 0 goes over into that of C̃₂ = 0, a loss of 200 bits and more.
    #[test]
    fn small_dependence_is_near_none() {
        let none = line([1.0, 0.5, 0.0, 0.0, 0.0, 0.25, 0.5, 1.0]);
        let mut some = none.clone();
        some.widths[1] = Rational::from((1, 1)) >> 120;
        let (a, b) = (
            hartmann_tran(&none, 90).unwrap(),
            hartmann_tran(&some, 90).unwrap(),
        );
        let difference = (&a.re - &b.re).magnitude();
        assert!(difference < crate::Mag::power_of_two(-85));
    }

    #[test]
    fn broad_lines_far_from_their_centres_are_decided() {
        for k in [-40.0, -3.0, 0.0, 3.0, 40.0] {
            let s = f64::exp2(k);
            for delta in [0.0, 1e-8, 1.0, 1e6] {
                let p = line([s, 1.0, 0.25, 0.1, -0.05, 0.5, 0.5, delta]);
                let found = hartmann_tran(&p, 80).unwrap();
                assert!(found.re.is_positive(), "{k} {delta}");
            }
        }
    }

    #[test]
    fn what_is_refused() {
        let good = [1.0, 0.5, 0.125, 0.0, 0.0, 0.0, 0.0, 1.0];
        assert!(hartmann_tran(&line(good), 80).is_ok());
        for (k, x) in [
            (0, 0.0),
            (1, -0.5),
            (1, 0.0),
            (2, 0.5),
            (5, -1.0),
            (6, 1.5),
            (6, 1.0),
        ] {
            let mut p = good;
            p[k] = x;
            assert!(hartmann_tran(&line(p), 80).is_err(), "{p:?}");
        }
    }

    /// One rule at a time is broken, just so; what is within them just so is not refused.
    #[test]
    fn the_edges_of_the_domain() {
        let good = [1.0, 0.5, 0.125, 0.0, 0.0, 0.25, 0.5, 1.0];
        let with = |k: usize, x: f64| {
            let mut p = good;
            p[k] = x;
            refused(&line(p))
        };
        let rules = [
            (0, 0.0, "Doppler"),
            (0, -1.0, "Doppler"),
            (1, -0.125, "must not be negative"),
            (2, -0.125, "must not be negative"),
            (5, -0.125, "must not be negative"),
            (6, -0.125, "0..1"),
            (6, 1.125, "0..1"),
            (2, 1.0, "speed zero"),
        ];
        for (k, x, words) in rules {
            assert!(with(k, x).is_some_and(|w| w.contains(words)), "{k} {x}");
        }
        // (1 - eta)(Gamma0 - 3/2 Gamma2) + nu is zero with Gamma2 at 2/3.
        for (k, x) in [(1, 0.0), (2, 0.0), (5, 0.0), (6, 0.0), (6, 1.0), (2, 0.625)] {
            assert_eq!(with(k, x), None, "{k} {x}");
        }
        let edge = [1.0, 0.75, 0.5, 0.0, 0.0, 0.0, 0.0, 1.0];
        assert_eq!(refused(&line(edge)), None);
        let nothing = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        assert!(refused(&line(nothing)).is_some());
    }

    /// A shift alone turns the profile complex; both components have the bits asked for.
    #[test]
    fn shifts_are_seen_and_both_components_are_certified() {
        for (k, x) in [(3, 0.25), (4, 0.25), (7, 0.25), (3, -1e-9), (4, 1e-9)] {
            let mut p = [1.0, 0.5, 0.125, 0.0, 0.0, 0.25, 0.5, 0.0];
            p[k] = x;
            let found = hartmann_tran(&line(p), 120).unwrap();
            assert!(!found.im.contains_zero(), "{k} {x}");
            assert!(found.re.accuracy_bits() >= 120 && found.im.accuracy_bits() >= 120);
        }
    }

    /// Square roots in every quadrant, and none on or across the cut.
    #[test]
    fn principal_roots() {
        let z = |x: f64, y: f64| ComplexBall::new(Ball::exact(80, x), Ball::exact(80, y));
        for (x, y) in [
            (3.0, 4.0),
            (3.0, -4.0),
            (-3.0, 4.0),
            (-3.0, -4.0),
            (0.0, 2.0),
            (0.0, -2.0),
            (2.0, 0.0),
        ] {
            let r = root(&z(x, y)).unwrap();
            let square = &r * &r;
            assert!(square.re.contains(&Rational::from_f64(x).unwrap()));
            assert!(square.im.contains(&Rational::from_f64(y).unwrap()));
            assert!(r.re.is_positive() && (y == 0.0 || r.im.is_negative() == (y < 0.0)));
        }
        // Next to the cut nothing is lost.
        let r = root(&z(-2.0, 1e-18)).unwrap();
        assert!(r.re.accuracy_bits() >= 70 && r.im.accuracy_bits() >= 70);
        assert!(root(&z(-2.0, 0.0)).is_none() && root(&z(0.0, 0.0)).is_none());
        let wide = ComplexBall::new(
            Ball::exact(80, -2.0),
            Ball::exact(80, 0.25).widened(crate::Mag::from_f64(0.5)),
        );
        assert!(root(&wide).is_none());
        let at_zero = z(0.0, 0.0).widened(crate::Mag::from_f64(0.5));
        assert!(root(&at_zero).is_none() && inverse(&at_zero).is_none());
        assert!(inverse(&z(1.0, 1.0).widened(crate::Mag::INFINITY)).is_none());
    }

    /// Im is about 2^-9000 and its error absolute: more bits than are tried.
    #[test]
    fn what_cannot_be_told_from_zero_is_undecided() {
        for bits in [20, 60] {
            let mut p = line([1.0, 0.5, 0.125, 0.0, 0.0, 0.25, 0.5, 0.0]);
            p.detuning = Rational::from(1) >> 9000;
            let open = hartmann_tran(&p, bits).unwrap_err();
            assert_eq!(open.bits, 16 * bits + 4096);
            assert!(open.reason.contains("cannot be told from zero"));
        }
    }

    /// A small component is certified like a large one.
    #[test]
    fn small_components_have_their_bits() {
        for k in [30u32, 70, 100, 200] {
            for part in 0..2 {
                let mut p = line([1.0, 0.5, 0.125, 0.0, 0.0, 0.25, 0.5, 0.0]);
                let tiny = Rational::from(1) >> k;
                match part {
                    0 => p.detuning = tiny,
                    _ => p.shifts[0] = tiny,
                }
                let found = hartmann_tran(&p, 90).unwrap();
                assert!(found.re.accuracy_bits() >= 90 && found.im.accuracy_bits() >= 90);
                assert!(found.im.magnitude() < crate::Mag::power_of_two(1 - i64::from(k)));
            }
        }
    }

    /// Without correlation Δ₀ moves the line as a whole.
    #[test]
    fn a_shift_without_correlation_moves_the_line() {
        for delta in [0.5, -0.125, 3.0] {
            let at = |shift: f64| {
                let p = [1.0, 0.5, 0.125, shift, 0.0, 0.25, 0.0, delta + shift];
                hartmann_tran(&line(p), 90).unwrap()
            };
            assert!(at(0.75).overlaps(&at(0.0)) && !at(0.0).im.contains_zero());
        }
    }

    /// The middle of a line that is shifted as a whole is that of the line: real, and the same.
    #[test]
    fn the_middle_of_a_shifted_line() {
        let at = |p: [f64; 8]| hartmann_tran(&line(p), 100).unwrap();
        let due = at([1.0, 0.5, 0.125, 0.0, 0.0, 0.25, 0.0, 0.0]);
        let found = at([1.0, 0.5, 0.125, 0.375, 0.0, 0.25, 0.0, 0.375]);
        assert!(found.im.is_zero() && found.re.overlaps(&due.re));
        // Correlated collisions, or a shift that depends on the speed, leave it complex.
        for p in [
            [1.0, 0.5, 0.125, 0.375, 0.0, 0.25, 0.5, 0.375],
            [1.0, 0.5, 0.125, 0.375, 0.25, 0.25, 0.0, 0.375],
            [1.0, 0.5, 0.125, 0.375, 0.0, 0.25, 0.0, 0.25],
        ] {
            assert!(!at(p).im.contains_zero(), "{p:?}");
        }
    }

    #[test]
    fn profiles_bit_by_bit() {
        let lines = [20, 64, 130].map(|bits| {
            Answers::line(bits, |all| {
                let mut draw = Draw(u64::from(bits));
                for k in 0..14 {
                    let p = Parameters {
                        doppler: draw.between(1, 3) << [-12, 0, 9][k % 3],
                        widths: [draw.between(3, 5), draw.between(0, 2) * [0u32, 1][k % 2]],
                        shifts: [draw.fraction(), draw.fraction() * [0u32, 1, 1][k % 3]],
                        narrowing: draw.between(0, 1),
                        correlation: draw.between(0, 1) * [1u32, 0][k / 2 % 2],
                        detuning: draw.between(-3, 3),
                    };
                    all.add(&hartmann_tran(&p, bits));
                    let mut middle = p.clone();
                    middle.detuning = p.shifts[0].clone();
                    all.add(&hartmann_tran(&middle, bits));
                    // Next to the middle, where little is left of the imaginary part.
                    middle.detuning += Rational::from(1) >> (40 * k as u32);
                    middle.correlation = Rational::new();
                    middle.shifts[1] = Rational::new();
                    all.add(&hartmann_tran(&middle, bits));
                }
            })
        });
        pin(
            &[
                "20: 2d78225d, 26 to 75 bits",
                "64: 3581a9b6, 78 to 119 bits",
                "130: d04ce5da, 143 to 185 bits",
            ],
            lines,
        );
    }
}
