//! H. Tran, N. H. Ngo, J.-M. Hartmann, JQSRT 129 (2013) 199–203, erratum JQSRT 134 (2014) 104: the
//! profile of partially correlated hard collisions with widths and shifts quadratic in the speed,
//! as combinations of two w, `pCqSDHC`; and their `CPF`, Humlíček's twelve poles within |z| = 8, 15
//! terms of the asymptotic series beyond.
//!
//! With `C_n = Γ_n + iΔ_n`, `c = √(ln 2)/Γ_D`, `C̃₀ = (1−η)(C₀ − 3C₂/2) + ν`, `C̃₂ = (1−η)C₂`,
//! `X = (C̃₀ − iδ)/C̃₂`, `Y = 1/(2cC̃₂)²`, `Z_± = √(X+Y) ± √Y`: `A = √π c (w(iZ₋) − w(iZ₊))` and so
//! on; four cases by the sizes of X and Y.
//!
//! HAPI, HITRAN's own program, has the same with `schreier-2011-hum1wei24` for CPF and √Y =
//! `1/(2cC̃₂)`. F. Schreier, P. Hochstaffl, JQSRT 258 (2021) 107385: `Z₋ = X/Z₊` and a single
//! rational w, for Γ's alone.

use crate::algorithm::{Algorithm, UPPER};
use crate::elementary::{FRAC_1_SQRT_PI, SQRT_PI, quotient, times_i};
use crate::humlicek_1979::twelve_poles;
use crate::schreier;
use num_complex::{Complex, Complex64};
use std::f64::consts::{FRAC_1_PI, LN_2};

/// The subroutine CPF by itself.
pub const ALGORITHMS: [Algorithm; 1] = [Algorithm {
    name: "tran-ngo-hartmann-2013-cpf",
    title: "Humlíček's twelve poles, 15 asymptotic terms beyond |z| = 8 (CPF of the Hartmann-Tran profile)",
    source: "H. Tran, N. H. Ngo, J.-M. Hartmann, JQSRT 129 (2013) 199-203",
    read_from: "the authors' subroutine as NCAR's sfit-core-code carries it",
    w: cpf,
    formula: Some(region),
    ..UPPER
}];

/// A line: all in one unit, but η.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Γ_D, half the width of the Doppler profile at half its height.
    pub doppler: f64,
    /// Γ₀ and Γ₂.
    pub widths: [f64; 2],
    /// Δ₀ and Δ₂.
    pub shifts: [f64; 2],
    /// ν, the frequency of velocity-changing collisions.
    pub narrowing: f64,
    /// η, of 0..1.
    pub correlation: f64,
    /// δ, the distance from the unperturbed line's place.
    pub detuning: f64,
}

/// A published algorithm for the profile.
#[derive(Clone, Copy, Debug)]
pub struct Profile {
    /// Authors, year, variant.
    pub name: &'static str,
    /// In a few words.
    pub title: &'static str,
    /// The paper.
    pub source: &'static str,
    /// Where it was read.
    pub read_from: &'static str,
    /// Tells whether it has shifts and a correlation.
    pub whole: bool,
    /// The profile; its real part is the absorption.
    pub value: fn(&Line) -> Complex64,
}

/// All of them.
pub const PROFILES: [Profile; 3] = [
    Profile {
        name: "tran-ngo-hartmann-2013",
        title: "Hartmann-Tran profile, the authors' pCqSDHC with their CPF",
        source: "H. Tran, N. H. Ngo, J.-M. Hartmann, JQSRT 129 (2013) 199-203; erratum 134 (2014) 104",
        read_from: "the authors' subroutine as NCAR's sfit-core-code carries it, the erratum's sign included",
        whole: true,
        value: pcqsdhc,
    },
    Profile {
        name: "hapi-pcqsdhc",
        title: "Hartmann-Tran profile of HAPI, HITRAN's own program",
        source: "HAPI 1, PROFILE_HT; H. Tran, N. H. Ngo, J.-M. Hartmann 2013",
        read_from: "HAPI's pcqsdhc with its default CPF, hum1_wei",
        whole: true,
        value: hapi,
    },
    Profile {
        name: "schreier-hochstaffl-2021",
        title: "Speed-dependent Voigt and Rautian profile of Py4CAtS",
        source: "F. Schreier, P. Hochstaffl, JQSRT 258 (2021) 107385",
        read_from: "Py4CAtS's sdr with zpf16p",
        whole: false,
        value: sdr,
    },
];

fn region(z: Complex64) -> u8 {
    match z {
        z if (z.re * z.re + z.im * z.im).sqrt() > 8.0 => 3,
        z if z.im > 0.85 || z.re.abs() < 18.1 * z.im + 1.65 => 1,
        _ => 2,
    }
}

fn cpf(z: Complex64) -> Complex64 {
    match region(z) {
        3 => cpf3(z),
        formula => twelve_poles(z, formula == 2),
    }
}

/// `(i/√π) z^{−1} Σ (1/2)_k z^{−2k}`, k = 0..15.
fn cpf3(z: Complex64) -> Complex64 {
    let one = Complex::new(1.0, 0.0);
    let inverse = quotient(one, z);
    let square = inverse * inverse;
    let (mut sum, mut term) = (one, one);
    for k in 0..15 {
        term = term * square * (f64::from(k) + 0.5);
        sum += term;
    }
    times_i(sum * inverse) * FRAC_1_SQRT_PI
}

/// The principal root.
fn root(z: Complex64) -> Complex64 {
    let size = libm::hypot(z.re, z.im);
    if size == 0.0 {
        return z;
    }
    let larger = ((size + z.re.abs()) * 0.5).sqrt();
    let other = z.im.abs() / (2.0 * larger);
    let (re, im) = match z.re >= 0.0 {
        true => (larger, other),
        false => (other, larger),
    };
    Complex::new(re, im.copysign(z.im))
}

/// How the two programs differ.
struct Manner {
    w: fn(Complex64) -> Complex64,
    /// `√Y` from Y by the principal root; else from `C̃₂`.
    principal: bool,
    /// The sign of the imaginary unit in `C_n` and of δ.
    sign: f64,
}

fn pcqsdhc(line: &Line) -> Complex64 {
    let manner = Manner {
        w: cpf,
        principal: true,
        sign: -1.0,
    };
    profile(line, &manner).conj()
}

fn hapi(line: &Line) -> Complex64 {
    let manner = Manner {
        w: schreier::hum1wei24::<f64>,
        principal: false,
        sign: 1.0,
    };
    profile(line, &manner)
}

fn profile(line: &Line, how: &Manner) -> Complex64 {
    let real = |x: f64| Complex::new(x, 0.0);
    let inverse = |z: Complex64| quotient(real(1.0), z);
    let c = LN_2.sqrt() / line.doppler;
    let c0 = Complex::new(line.widths[0], how.sign * line.shifts[0]);
    let c2 = Complex::new(line.widths[1], how.sign * line.shifts[1]);
    let rest = 1.0 - line.correlation;
    let t0 = (c0 - c2 * 1.5) * rest + line.narrowing;
    let t2 = c2 * rest;
    let offset = t0 - Complex::new(0.0, how.sign * line.detuning);
    let w = |z: Complex64| (how.w)(times_i(z));
    let (a, b);
    if t2.norm() == 0.0 {
        let z = offset * c;
        let w = w(z);
        a = w * (SQRT_PI * c);
        b = match z.norm() <= 4e3 {
            true => ((real(1.0) - z * z) * w + z * FRAC_1_SQRT_PI) * (SQRT_PI * c),
            false => (w * SQRT_PI + inverse(z) * 0.5 - inverse(z * z * z) * 0.75) * c,
        };
    } else {
        let y = inverse((t2 * (2.0 * c)) * (t2 * (2.0 * c)));
        let x = quotient(offset, t2);
        let root_y = match how.principal {
            true => root(y),
            false => {
                let size = c2.norm_sqr();
                c2.conj() * (1.0 / (2.0 * c * rest * size))
            }
        };
        let second = |z: Complex64, w: Complex64| {
            quotient(real(SQRT_PI), root_y * 2.0) * (real(1.0) - z * z) * w
        };
        if x.norm() <= 3e-8 * y.norm() {
            let (z1, z2) = (offset * c, root(x + y) + root_y);
            let (w1, w2) = (w(z1), w(z2));
            a = (w1 - w2) * (SQRT_PI * c);
            b = quotient(second(z1, w1) - second(z2, w2) - 1.0, t2);
        } else if y.norm() <= 1e-15 * x.norm() {
            let z1 = root(x + y);
            let w1 = w(z1);
            let root_x = root(x);
            let far = root_x.norm() > 4e3;
            let short = match far {
                true => inverse(x) - inverse(x * x) * 1.5,
                false => (real(FRAC_1_SQRT_PI) - root_x * w(root_x)) * (2.0 * SQRT_PI),
            };
            a = quotient(short, t2);
            let factor = real(1.0) - x - y * 2.0;
            b = quotient(factor * short + z1 * w1 * (2.0 * SQRT_PI) - 1.0, t2);
        } else {
            let z1 = root(x + y) - root_y;
            let z2 = z1 + root_y * 2.0;
            let (s1, s2) = (z1.norm(), z2.norm());
            let near = (s1 - s2).abs() <= 1.0 && s1.max(s2) > 8.0 && s1.min(s2) <= 8.0;
            let (w1, w2) = match near {
                true => (cpf3(times_i(z1)), cpf3(times_i(z2))),
                false => (w(z1), w(z2)),
            };
            a = (w1 - w2) * (SQRT_PI * c);
            b = quotient(second(z1, w1) - second(z2, w2) - 1.0, t2);
        }
    }
    let first = real(line.narrowing) - (c0 - c2 * 1.5) * line.correlation;
    let below = real(1.0) - first * a + c2 * line.correlation * b;
    quotient(a, below) * FRAC_1_PI
}

/// Without shifts and correlation: those parameters are not used.
fn sdr(line: &Line) -> Complex64 {
    let c = LN_2.sqrt() / line.doppler;
    let (x, y) = (c * line.detuning, c * line.widths[0]);
    let (q, r) = (c * line.widths[1], c * line.narrowing);
    let w = |z: Complex64| schreier::shifted_16(z);
    let value = if q <= 0.0 {
        w(Complex::new(x, y + r))
    } else {
        let big_x = Complex::new(y + r, -x) / q - 1.5;
        let root_y = 0.5 / q;
        let plus = root(big_x + root_y * root_y) + root_y;
        let minus = quotient(big_x, plus);
        w(times_i(minus)) - w(times_i(plus))
    };
    let profile = quotient(value, Complex::new(1.0, 0.0) - value * (SQRT_PI * r));
    profile * (c * FRAC_1_SQRT_PI)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quadrature by mpmath of the integral over speeds; the lines of
    /// `mechaudit_reference::hartmann_tran`'s tests.
    const LINES: [([f64; 8], f64, f64); 4] = [
        (
            [1.0, 1.0, 0.125, 0.0, 0.0, 0.0, 0.0, 0.0],
            0.2338697004496733,
            0.0,
        ),
        (
            [1.0, 0.5, 0.0625, 0.25, -0.03125, 0.125, 0.25, 1.5],
            0.16095040964210702,
            0.18606013232009397,
        ),
        (
            [0.25, 2.0, 0.25, -0.5, 0.125, 1.0, 0.75, -3.0],
            0.06238463110661376,
            -0.0777630233056123,
        ),
        (
            [2.0, 0.125, 0.0078125, 0.0, 0.0, 0.0, 0.0, 4.0],
            0.0181211356824226,
            0.09846290046351168,
        ),
    ];

    #[test]
    fn all_are_near_the_integral() {
        for (p, re, im) in LINES {
            let line = Line {
                doppler: p[0],
                widths: [p[1], p[2]],
                shifts: [p[3], p[4]],
                narrowing: p[5],
                correlation: p[6],
                detuning: p[7],
            };
            let due = Complex::new(re, im);
            let simple = p[3] == 0.0 && p[6] == 0.0;
            for a in PROFILES.iter().filter(|a| a.whole || simple) {
                let error = ((a.value)(&line) - due).norm() / due.norm();
                assert!(error < 2e-5, "{} {p:?}: {error:e}", a.name);
            }
        }
    }
}
