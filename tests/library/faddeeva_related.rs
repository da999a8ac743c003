//! The companions of the Faddeeva function beside their certified references.
//!
//! `MECHAUDIT_EFFORT` (a positive number, default 1) multiplies the number of points. The table of
//! the worst errors found is printed by
//!
//! ```text
//! cargo test --release --test library faddeeva_related -- --ignored --nocapture
//! ```
#![allow(clippy::excessive_precision)]

use mechaudit::audit::ulp_exponent;
use mechaudit::reference::{Ball, ComplexBall, Mag, Undecided, faddeeva as reference};
use mechaudit::solvers::faddeeva as solver;
use num_complex::Complex;
use rug::Rational;

const BITS: u32 = 80;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }
    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }
    fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }
    /// Ten to a power between the two.
    fn power(&mut self, a: f64, b: f64) -> f64 {
        10f64.powf(self.between(a, b))
    }
    fn sign(&mut self) -> f64 {
        if self.bits() & 1 == 0 { 1.0 } else { -1.0 }
    }
    fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[(self.bits() % from.len() as u64) as usize]
    }
    fn signed(&mut self, re: f64, im: f64) -> Complex<f64> {
        let (a, b) = (self.sign(), self.sign());
        Complex::new(a * re, b * im)
    }
}

type Region = (&'static str, fn(&mut Random) -> Complex<f64>);

/// Zeros of erf in the first quadrant, of w in the fourth (DLMF 7.13).
const ERF_ZEROS: [(f64, f64); 5] = [
    (1.4506161632436756, 1.8809430001533154),
    (2.2446592738032467, 2.6165751406894397),
    (2.839741046908047, 3.175628099643187),
    (4.158998399781451, 4.435571444236523),
    (6.496443553395878, 6.708965932314254),
];
const W_ZEROS: [(f64, f64); 4] = [
    (1.9914668428584966, -1.3548101281509396),
    (2.691149024251438, -2.177044906089615),
    (3.2353308684353936, -2.784387613230162),
    (4.469, -4.15),
];

const SQUARE: Region = ("square", |r| {
    Complex::new(r.between(-8.0, 8.0), r.between(-8.0, 8.0))
});
const SMALL: Region = ("small", |r| {
    let (x, y) = (r.power(-320.0, 0.0), r.power(-320.0, 0.0));
    r.signed(x, y)
});
const DISC: Region = ("disc", |r| {
    Complex::from_polar(r.between(0.0, 1.5), r.between(-4.0, 4.0))
});
const LARGE: Region = ("large", |r| {
    Complex::from_polar(r.power(0.5, 8.0), r.between(-4.0, 4.0))
});
const REAL_AXIS: Region = ("beside the real axis", |r| {
    let (x, y) = (r.between(0.0, 30.0), r.power(-320.0, -0.5));
    r.signed(x, y)
});
const IMAGINARY_AXIS: Region = ("beside the imaginary axis", |r| {
    let (x, y) = (r.power(-320.0, -0.5), r.between(0.0, 28.0));
    r.signed(x, y)
});
const DIAGONAL: Region = ("diagonal", |r| {
    let x = r.power(-1.0, 4.0);
    let y = x * (1.0 + r.sign() * r.power(-17.0, -1.0));
    r.signed(x, y)
});
const EDGE: Region = ("overflow and underflow", |r| {
    let x = r.power(-3.0, 4.0);
    let e = r.between(680.0, 760.0);
    let y = (x * x + e).sqrt();
    if r.bits() & 1 == 0 {
        r.signed(x, y)
    } else {
        r.signed(y, x)
    }
});
const SEAMS: Region = ("seams", |r| {
    let nudge = |r: &mut Random, t: f64| {
        let n = (r.bits() % 9) as i64 - 4;
        f64::from_bits((t.to_bits() as i64 + n) as u64)
    };
    let other = r.between(0.0, 8.0);
    let line = *r.pick(solver::SEAMS_OF_RELATIVES.re);
    let (x, y) = match r.bits() % 3 {
        0 => (nudge(r, line), other),
        1 => (other, nudge(r, line)),
        _ => {
            let radius = r.pick(solver::SEAMS_OF_RELATIVES.circles).sqrt();
            let t = r.between(0.0, 1.6);
            let z = Complex::from_polar(radius, t);
            (nudge(r, z.re), nudge(r, z.im))
        }
    };
    r.signed(x, y)
});
const ZEROS: Region = ("beside zeros", |r| {
    let (x, y) = if r.bits() & 1 == 0 {
        *r.pick(&ERF_ZEROS)
    } else {
        *r.pick(&W_ZEROS)
    };
    let (x, y) = if r.bits() & 1 == 0 { (x, y) } else { (y, x) };
    let (a, b) = (
        r.sign() * r.power(-18.0, -1.0),
        r.sign() * r.power(-18.0, -1.0),
    );
    r.signed(x.abs() + a, y.abs() + b)
});
const MAXIMUM: Region = ("beside the maximum of F", |r| {
    let x = 0.924_138_873_004_591_7 + r.sign() * r.power(-18.0, -1.0);
    let y = r.power(-320.0, -0.5);
    r.signed(x, y)
});

const REGIONS: [Region; 11] = [
    SQUARE,
    SMALL,
    DISC,
    LARGE,
    REAL_AXIS,
    IMAGINARY_AXIS,
    DIAGONAL,
    EDGE,
    SEAMS,
    ZEROS,
    MAXIMUM,
];

/// A function of a complex argument, its reference and its derivative from a value of it.
struct Function {
    name: &'static str,
    f: fn(Complex<f64>) -> Complex<f64>,
    reference: fn(&Rational, &Rational, u32) -> Result<ComplexBall, Undecided>,
    slope: fn(Complex<f64>, Complex<f64>) -> Complex<f64>,
}

/// `(2/√π) e^{−z²}`, roughly.
fn gaussian(z: Complex<f64>) -> Complex<f64> {
    let size = 1.13 * ((z.im - z.re) * (z.im + z.re)).exp();
    Complex::from_polar(size, -2.0 * z.re * z.im)
}

const FUNCTIONS: [Function; 6] = [
    Function {
        name: "erfcx",
        f: solver::erfcx,
        reference: reference::erfcx,
        slope: |z, f| 2.0 * z * f - std::f64::consts::FRAC_2_SQRT_PI,
    },
    Function {
        name: "erfc",
        f: solver::erfc,
        reference: reference::erfc,
        slope: |z, _| gaussian(z),
    },
    Function {
        name: "erf",
        f: solver::erf,
        reference: reference::erf,
        slope: |z, _| gaussian(z),
    },
    Function {
        name: "erfi",
        f: solver::erfi,
        reference: reference::erfi,
        slope: |z, _| gaussian(Complex::new(-z.im, z.re)),
    },
    Function {
        name: "dawson",
        f: solver::dawson,
        reference: reference::dawson,
        slope: |z, f| 1.0 - 2.0 * z * f,
    },
    Function {
        name: "w'",
        f: solver::w_derivative,
        reference: |x, y, bits| reference::w_derivative(1, x, y, bits),
        slope: |z, f| -2.0 * z * f - 2.0 * solver::faddeeva(z),
    },
];

fn rational(x: f64) -> Rational {
    Rational::from_f64(x).expect("finite")
}

/// `|got − reference|` in units of 2^`unit`, and in ulps of the reference; overflow has to be
/// signed infinity.
fn distance(got: f64, reference: &Ball) -> (Mag, f64) {
    if reference.magnitude() >= Mag::from_f64(f64::MAX) && !(reference.mid().to_f64().is_finite()) {
        let right = got == reference.mid().to_f64() || got.abs() == f64::MAX;
        return if right {
            (Mag::ZERO, 0.0)
        } else {
            (Mag::INFINITY, f64::INFINITY)
        };
    }
    if !got.is_finite() {
        return (Mag::INFINITY, f64::INFINITY);
    }
    let d = (&Ball::exact(128, got) - reference).magnitude();
    let ulps = d.shift(-ulp_exponent(reference.mid())).to_f64();
    (d, ulps)
}

#[derive(Clone, Debug, Default)]
struct Worst {
    norm: (f64, Complex<f64>),
    re: (f64, Complex<f64>),
    im: (f64, Complex<f64>),
    points: usize,
    /// Components next to a zero of themselves, judged normwise only.
    at_zero: usize,
    /// Beyond 4 ulps.
    beyond: usize,
    undecided: usize,
}

impl Worst {
    fn add(&mut self, f: &Function, z: Complex<f64>) {
        let Ok(exact) = (f.reference)(&rational(z.re), &rational(z.im), BITS) else {
            self.undecided += 1;
            return;
        };
        let got = (f.f)(z);
        self.points += 1;
        let ((dr, ur), (di, ui)) = (distance(got.re, &exact.re), distance(got.im, &exact.im));
        // Normwise in ε = 2⁻⁵²; below the smallest normal number in its units.
        let size = exact
            .re
            .mignitude()
            .max(exact.im.mignitude())
            .max(Mag::power_of_two(-1022));
        let norm = dr
            .mul(dr)
            .add(di.mul(di))
            .sqrt()
            .div(size)
            .shift(52)
            .to_f64();
        keep(&mut self.norm, norm, z);
        // The effect of half an ulp of each coordinate on the components.
        let slope = (f.slope)(z, got);
        let ulp = |x: f64| (x.abs() * f64::EPSILON).max(f64::from_bits(1));
        let moved = |p: f64, q: f64| 0.5 * (p.abs() * ulp(z.re) + q.abs() * ulp(z.im));
        for (at, u, exact, moved) in [
            (&mut self.re, ur, &exact.re, moved(slope.re, slope.im)),
            (&mut self.im, ui, &exact.im, moved(slope.im, slope.re)),
        ] {
            let part = exact.mid().to_f64().abs();
            if part < moved && part > 0.0 && u > 4.0 {
                self.at_zero += 1;
            } else {
                keep(at, u, z);
                self.beyond += usize::from(u > 4.0);
            }
        }
    }
}

fn keep(worst: &mut (f64, Complex<f64>), x: f64, z: Complex<f64>) {
    if x.is_nan() || x > worst.0 {
        *worst = (x, z);
    }
}

fn measure(f: &Function, region: &Region, points: usize) -> Worst {
    let mut r = Random(
        region
            .0
            .bytes()
            .chain(f.name.bytes())
            .fold(7, |h, b| h.wrapping_mul(31).wrapping_add(u64::from(b))),
    );
    let mut worst = Worst::default();
    for _ in 0..points {
        worst.add(f, (region.1)(&mut r));
    }
    worst
}

/// A function of a real argument and its reference.
type RealFunction = (
    &'static str,
    fn(f64) -> f64,
    fn(&Rational, u32) -> Result<Ball, Undecided>,
);

const REAL_FUNCTIONS: [RealFunction; 5] = [
    ("erfcx_real", solver::erfcx_real, |x, b| {
        Ok(reference::erfcx(x, &Rational::new(), b)?.re)
    }),
    ("erfc_real", solver::erfc_real, |x, b| {
        Ok(reference::erfc(x, &Rational::new(), b)?.re)
    }),
    ("erf_real", solver::erf_real, |x, b| {
        Ok(reference::erf(x, &Rational::new(), b)?.re)
    }),
    ("erfi_real", solver::erfi_real, |x, b| {
        Ok(reference::erfi(x, &Rational::new(), b)?.re)
    }),
    ("dawson_real", solver::dawson_real, |x, b| {
        Ok(reference::dawson(x, &Rational::new(), b)?.re)
    }),
];

fn measure_real(f: &RealFunction, points: usize) -> (f64, f64) {
    let mut r = Random(f.0.len() as u64);
    let mut worst = (0.0, 0.0);
    for _ in 0..points {
        let x = match r.bits() % 4 {
            0 => r.between(-10.0, 10.0),
            1 => r.between(-30.0, 30.0),
            2 => r.sign() * r.power(-320.0, 0.0),
            _ => r.sign() * r.power(0.0, 300.0),
        };
        if let Ok(exact) = (f.2)(&rational(x), BITS) {
            let u = distance((f.1)(x), &exact).1;
            if !(u <= worst.0) {
                worst = (u, x);
            }
        }
    }
    worst
}

/// Regions of (x, σ, γ).
type VoigtRegion = (&'static str, fn(&mut Random) -> [f64; 3]);

const VOIGT_REGIONS: [VoigtRegion; 5] = [
    ("comparable", |r| {
        [
            r.between(-12.0, 12.0),
            r.between(0.05, 2.0),
            r.between(0.0, 3.0),
        ]
    }),
    ("narrow Lorentz", |r| {
        [
            r.between(-40.0, 40.0),
            r.between(0.5, 2.0),
            r.power(-320.0, 0.0),
        ]
    }),
    ("narrow Gauss", |r| {
        [
            r.between(-5.0, 5.0),
            r.power(-320.0, 0.0),
            r.between(0.1, 2.0),
        ]
    }),
    ("all sizes", |r| {
        [
            r.sign() * r.power(-100.0, 100.0),
            r.power(-100.0, 100.0),
            r.power(-100.0, 100.0),
        ]
    }),
    ("pure", |r| {
        let (x, w) = (r.between(-40.0, 40.0), r.power(-2.0, 2.0));
        if r.bits() & 1 == 0 {
            [x, w, 0.0]
        } else {
            [x, 0.0, w]
        }
    }),
];

fn measure_voigt(region: &VoigtRegion, points: usize) -> (f64, [f64; 3]) {
    let mut r = Random(region.0.len() as u64);
    let mut worst = (0.0, [0.0; 3]);
    for _ in 0..points {
        let p = (region.1)(&mut r);
        let [x, s, g] = p.map(rational);
        if let Ok(exact) = reference::voigt(&x, &s, &g, BITS) {
            let u = distance(solver::voigt(p[0], p[1], p[2]), &exact).1;
            if !(u <= worst.0) {
                worst = (u, p);
            }
        }
    }
    worst
}

fn effort() -> f64 {
    match std::env::var("MECHAUDIT_EFFORT") {
        Ok(text) => text.parse().expect("a positive number"),
        Err(_) => 1.0,
    }
}

/// Every component within 4 ulps except within rounding of a zero of itself,
/// and the norm within 2 ε.
#[test]
fn components_and_norms() {
    let points = (300.0 * effort()).ceil() as usize;
    for f in &FUNCTIONS {
        for region in &REGIONS {
            let w = measure(f, region, points);
            let context = format!("{} {}: {w:?}", f.name, region.0);
            assert!(w.norm.0 <= 2.0, "{context}");
            assert!(w.re.0 <= 4.5 && w.im.0 <= 4.5, "{context}");
            // Undecided: exponents beyond those of a ball.
            assert!(w.points >= points / 3, "{context}");
        }
    }
}

#[test]
fn real_arguments() {
    let points = (2000.0 * effort()).ceil() as usize;
    for f in &REAL_FUNCTIONS {
        let worst = measure_real(f, points);
        assert!(worst.0 <= 2.0, "{}: {worst:?}", f.0);
    }
}

#[test]
fn voigt_profiles() {
    let points = (1000.0 * effort()).ceil() as usize;
    for region in &VOIGT_REGIONS {
        let worst = measure_voigt(region, points);
        assert!(worst.0 <= 3.0, "{}: {worst:?}", region.0);
    }
}

/// At the `f64` next to a zero of erf the value is the distance from the zero, which only the low
/// parts of the stored zeros tell.
#[test]
fn next_to_zeros_of_erf_the_value_is_relative() {
    for (x, y) in ERF_ZEROS {
        let z = Complex::new(x, y);
        let exact = reference::erf(&rational(x), &rational(y), BITS).expect("decided");
        let got = solver::erf(z);
        for (got, exact) in [(got.re, &exact.re), (got.im, &exact.im)] {
            assert!(distance(got, exact).1 <= 4.0, "{z} {got}");
        }
        assert!(got.norm() < 1e-13);
    }
}

/// Equal or both NaN, the sign of zero included.
fn same(a: f64, b: f64) -> bool {
    a.is_nan() && b.is_nan() || a.to_bits() == b.to_bits()
}

#[test]
fn special_values() {
    const INF: f64 = f64::INFINITY;
    const NAN: f64 = f64::NAN;
    type F = fn(Complex<f64>) -> Complex<f64>;
    let rows: &[(&str, F, [f64; 2], [f64; 2])] = &[
        ("erf", solver::erf, [0.0, 0.0], [0.0, 0.0]),
        ("erf", solver::erf, [-0.0, 0.0], [-0.0, 0.0]),
        ("erf", solver::erf, [INF, -2.0], [1.0, -0.0]),
        ("erf", solver::erf, [-INF, 2.0], [-1.0, 0.0]),
        ("erf", solver::erf, [0.0, -INF], [0.0, -INF]),
        ("erf", solver::erf, [1.0, INF], [NAN, NAN]),
        ("erf", solver::erf, [INF, INF], [NAN, NAN]),
        ("erf", solver::erf, [NAN, 0.0], [NAN, 0.0]),
        ("erf", solver::erf, [-0.0, NAN], [-0.0, NAN]),
        ("erf", solver::erf, [NAN, 1.0], [NAN, NAN]),
        ("erf", solver::erf, [1e-320, 1e200], [INF, INF]),
        ("erf", solver::erf, [1e200, 1e199], [1.0, 0.0]),
        ("erfc", solver::erfc, [INF, 2.0], [0.0, -0.0]),
        ("erfc", solver::erfc, [-INF, 2.0], [2.0, -0.0]),
        ("erfc", solver::erfc, [0.0, INF], [1.0, -INF]),
        (
            "erfc",
            solver::erfc,
            [0.0, 3.0e-310],
            [1.0, -3.385137501286538e-310],
        ),
        ("erfi", solver::erfi, [2.0, INF], [0.0, 1.0]),
        ("erfi", solver::erfi, [-INF, 0.0], [-INF, 0.0]),
        ("dawson", solver::dawson, [INF, 1.0], [0.0, -0.0]),
        ("dawson", solver::dawson, [-INF, 0.0], [-0.0, -0.0]),
        ("dawson", solver::dawson, [0.0, -INF], [0.0, -INF]),
        ("dawson", solver::dawson, [1.0, INF], [NAN, NAN]),
        ("dawson", solver::dawson, [NAN, -0.0], [NAN, -0.0]),
        ("w'", solver::w_derivative, [0.0, -INF], [-0.0, INF]),
        ("w'", solver::w_derivative, [1.0, -INF], [NAN, NAN]),
        ("w'", solver::w_derivative, [0.0, NAN], [-0.0, NAN]),
        ("erfcx", solver::erfcx, [NAN, 1.0], [NAN, NAN]),
        ("erfcx", solver::erfcx, [-40.0, 0.0], [INF, 0.0]),
    ];
    for (name, f, [x, y], [u, v]) in rows {
        let got = f(Complex::new(*x, *y));
        assert!(
            same(got.re, *u) && (same(got.im, *v) || *name == "erfcx"),
            "{name}({x}, {y}) = {got}"
        );
    }
    for x in [NAN, INF, -INF, 1e308, -1e308] {
        let gone = |v: f64| same(v, if x.is_nan() { NAN } else { v });
        assert!(gone(solver::erf_real(x)) && gone(solver::erfc_real(x)));
        assert!(
            gone(solver::dawson_real(x))
                && gone(solver::erfi_real(x))
                && gone(solver::erfcx_real(x))
        );
    }
    assert_eq!(solver::voigt(0.0, 0.0, 0.0), INF);
    assert_eq!(solver::voigt(1.0, 0.0, 0.0), 0.0);
    assert_eq!(solver::voigt(INF, 1.0, 1.0), 0.0);
    for bad in [
        [0.0, -1.0, 1.0],
        [0.0, 1.0, -1.0],
        [NAN, 1.0, 1.0],
        [0.0, NAN, 1.0],
        [0.0, 1.0, NAN],
    ] {
        assert!(solver::voigt(bad[0], bad[1], bad[2]).is_nan(), "{bad:?}");
    }
}

/// Any bit pattern gives a value; symmetries hold to the last bit.
#[test]
fn any_bits_and_symmetries() {
    let mut r = Random(5);
    for _ in 0..(20_000.0 * effort()) as usize {
        let z = Complex::new(f64::from_bits(r.bits()), f64::from_bits(r.bits()));
        let odd: [fn(Complex<f64>) -> Complex<f64>; 3] =
            [solver::erf, solver::erfi, solver::dawson];
        for f in odd {
            let (a, b, c) = (f(z), f(-z), f(z.conj()));
            assert!(same(a.re, -b.re) && same(a.im, -b.im), "{z} {a} {b}");
            assert!(same(a.re, c.re) && same(a.im, -c.im), "{z} {a} {c}");
        }
        for f in [solver::erfc, solver::erfcx] {
            let (a, c) = (f(z), f(z.conj()));
            assert!(same(a.re, c.re) && (same(a.im, -c.im)), "{z} {a} {c}");
        }
        let (a, b) = (solver::w_derivative(z), solver::w_derivative(-z.conj()));
        assert!(same(a.re, -b.re) && same(a.im, b.im), "{z} {a} {b}");
        let v = solver::voigt(z.re, z.im.abs(), 1.0);
        assert!(v >= 0.0 || z.re.is_nan() || z.im.is_nan());
    }
}

#[test]
fn batches() {
    let mut r = Random(6);
    let z: Vec<Complex<f64>> = (0..1000)
        .map(|_| {
            let region = *r.pick(&REGIONS);
            (region.1)(&mut r)
        })
        .collect();
    let mut f = vec![Complex::default(); z.len()];
    solver::erfcx_batch(&z, &mut f).expect("equal lengths");
    for (z, f) in z.iter().zip(&f) {
        let one = solver::erfcx(*z);
        assert!(same(one.re, f.re) && same(one.im, f.im), "{z}: {one} {f}");
    }
    solver::dawson_batch(&z, &mut f).expect("equal lengths");
    assert!(z.iter().zip(&f).all(|(z, f)| solver::dawson(*z) == *f));
    let x: Vec<f64> = z.iter().map(|z| z.re).collect();
    let mut v = vec![0.0; x.len()];
    solver::voigt_batch(&x, 0.3, 0.1, &mut v).expect("equal lengths");
    assert!(
        x.iter()
            .zip(&v)
            .all(|(x, v)| solver::voigt(*x, 0.3, 0.1) == *v)
    );
    let e = solver::voigt_batch(&x, 0.3, 0.1, &mut v[1..]).expect_err("too short");
    assert_eq!((e.points, e.values), (1000, 999));
    assert!(e.to_string().contains("999"));
    solver::erfcx_batch(&[], &mut []).expect("nothing to do");
}

#[test]
#[ignore = "takes minutes; prints the table in the documentation"]
fn table() {
    let points = (1e5 * effort()) as usize;
    let only = std::env::var("ONLY").unwrap_or_default();
    println!(
        "| function | region | points | normwise/ε | Re/ulp | Im/ulp | beyond 4 | at a zero |"
    );
    for f in &FUNCTIONS {
        for region in &REGIONS {
            if !format!("{} {}", f.name, region.0).contains(&only) {
                continue;
            }
            let w = measure(f, region, points);
            println!(
                "| {} | {} | {} | {:.2} | {:.2} | {:.2} | {} | {} | {}  {:?} {:?} {:?}",
                f.name,
                region.0,
                w.points,
                w.norm.0,
                w.re.0,
                w.im.0,
                w.beyond,
                w.at_zero,
                w.undecided,
                w.norm.1,
                w.re.1,
                w.im.1
            );
        }
    }
    for f in &REAL_FUNCTIONS {
        if f.0.contains(&only) {
            println!("| {} | {points} | {:?} |", f.0, measure_real(f, points));
        }
    }
    for region in &VOIGT_REGIONS {
        if format!("voigt {}", region.0).contains(&only) {
            println!(
                "| voigt | {} | {points} | {:?} |",
                region.0,
                measure_voigt(region, points)
            );
        }
    }
}
