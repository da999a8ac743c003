//! The Faddeeva family gives the same bits everywhere: no function of the C library is called, and
//! every path, fused or by vectors, rounds alike.
//!
//! `tests/solver_values/bits.csv` holds a digest of the results for each function and kind of
//! point. A digest that changes says that a result changed, not that it became worse: that is for
//! the certified values beside it and for the audit. Where a change is meant,
//! `cargo test --no-default-features --lib bits_written -- --ignored` writes the file anew.

use super::Random;
use crate::faddeeva::*;
use num_complex::Complex;
use std::fmt::Write;

type C = Complex<f64>;

impl Random {
    /// A number of either sign with a binary exponent from `low` to `high`, without `exp2`.
    fn scaled(&mut self, low: i64, high: i64) -> f64 {
        let exponent = low + self.below((high - low + 1) as u64) as i64;
        let unit = if exponent < -1022 {
            f64::from_bits(1 << (exponent + 1074))
        } else {
            f64::from_bits(((exponent + 1023) as u64) << 52)
        };
        let size = unit * self.between(1.0, 2.0);
        self.either(size)
    }
    fn either(&mut self, x: f64) -> f64 {
        if self.below(2) == 0 { x } else { -x }
    }
    fn pick(&mut self, from: &[f64]) -> f64 {
        from[self.below(from.len() as u64) as usize]
    }
    /// The number or one of its neighbours, either sign.
    fn beside(&mut self, x: f64) -> f64 {
        let x = [x.next_down(), x, x, x.next_up()][self.below(4) as usize];
        self.either(x)
    }
}

const fn power(k: i64) -> f64 {
    f64::from_bits(((k + 1023) as u64) << 52)
}

/// Limits of real and imaginary parts at which formulas change.
const EDGES: &[f64] = &[
    power(-1022),
    power(-900),
    power(-400),
    power(-60),
    power(-32),
    power(-27),
    power(-17),
    power(-11),
    power(40),
    power(53),
    0.1875,
    4.8125,
    0.0,
    1e-290,
    1e-200,
    1e-80,
    power(-28),
    0.125,
    0.25,
    0.5,
    0.375,
    1.0,
    1.125,
    2.0,
    3.75,
    6.0,
    6.5,
    8.0,
    9.0,
    26.0,
    26.5,
    27.0,
    27.5,
    28.0,
    30.0,
    31.0,
    40.0,
    64.0,
    4096.0,
    134_217_728.0,
    1e100,
    1e200,
];
/// Limits of |z|² at which formulas change.
const NORMS: &[f64] = &[
    1.0 / 16384.0,
    0.25,
    0.5,
    1.0,
    1.25,
    14.0,
    48.0,
    49.0,
    80.0,
    100.0,
    112.0,
    256.0,
    768.0,
    1000.0,
    1024.0,
    5120.0,
    1e6,
    1_048_576.0,
    1e200,
];
/// Values of `Im² z − Re² z` at which `e^{−z²}` overflows, underflows or is cut off.
const EXPONENTS: &[f64] = &[
    -1400.0, -1000.0, -745.2, -708.4, -690.0, -60.0, -37.0, 0.0, 60.0, 690.0, 708.4, 709.8, 1000.0,
    1400.0,
];

/// Kinds of points, with a generator for each.
type Kind = (&'static str, usize, fn(&mut Random) -> C);

const KINDS: &[Kind] = &[
    ("square", 4000, |p| {
        C::new(p.between(-8.0, 8.0), p.between(-8.0, 8.0))
    }),
    ("wide", 2000, |p| {
        C::new(p.between(-45.0, 45.0), p.between(-45.0, 45.0))
    }),
    ("sizes", 2000, |p| {
        C::new(p.scaled(-60, 60), p.scaled(-60, 60))
    }),
    ("any size", 2000, |p| {
        C::new(p.scaled(-1074, 1023), p.scaled(-1074, 1023))
    }),
    ("small", 1000, |p| {
        C::new(p.scaled(-40, 0), p.scaled(-40, 0))
    }),
    ("real axis", 3000, |p| {
        C::new(p.between(-32.0, 32.0), p.scaled(-1074, -2))
    }),
    ("close to the real axis", 2000, |p| {
        C::new(p.between(-32.0, 32.0), p.scaled(-60, -2))
    }),
    ("imaginary axis", 3000, |p| {
        C::new(p.scaled(-1074, -2), p.between(-45.0, 45.0))
    }),
    ("close to the imaginary axis", 2000, |p| {
        C::new(p.scaled(-60, -2), p.between(-45.0, 45.0))
    }),
    ("on the axes", 2000, |p| {
        let x = if p.below(2) == 0 {
            p.scaled(-1074, 1023)
        } else {
            p.between(-40.0, 40.0)
        };
        let none = p.beside(0.0) * 0.0;
        if p.below(2) == 0 {
            C::new(x, none)
        } else {
            C::new(none, x)
        }
    }),
    ("diagonals", 2000, |p| {
        let (x, off) = (p.scaled(-10, 40), p.scaled(-60, -5));
        let y = x.mul_add(off, x);
        C::new(x, if p.below(2) == 0 { y } else { -y })
    }),
    ("edges", 4000, |p| {
        let x = p.pick(EDGES);
        let x = p.beside(x);
        let y = match p.below(4) {
            0 => p.between(-10.0, 10.0),
            1 => p.between(-30.0, 30.0),
            2 => p.scaled(-1074, 100),
            _ => p.pick(EDGES),
        };
        if p.below(2) == 0 {
            C::new(x, y)
        } else {
            C::new(y, x)
        }
    }),
    ("cells", 4000, |p| {
        // Halves between the centres of cells.
        let tick = |p: &mut Random| {
            let k = p.below(128) as f64 / 16.0;
            p.beside(k)
        };
        C::new(tick(p), tick(p))
    }),
    ("circles", 4000, |p| {
        let r2 = p.pick(NORMS);
        let x = match p.below(3) {
            0 => r2.sqrt() * p.between(0.0, 1.0),
            1 => r2.sqrt() * p.scaled(-50, -1).abs(),
            _ => (r2.sqrt() * p.between(0.0, 16.0)).floor() / 16.0,
        };
        // Of the neighbours, one for which |z|² is the limit itself, if there is one.
        let mut y = (-x).mul_add(x, r2).max(0.0).sqrt();
        for step in 0..4 {
            if x.mul_add(x, y * y) == r2 {
                break;
            }
            y = if step == 0 {
                y.next_down()
            } else {
                y.next_up()
            };
        }
        let (x, y) = if p.below(2) == 0 {
            (x, p.beside(y))
        } else {
            (p.beside(y), x)
        };
        C::new(if p.below(2) == 0 { x } else { -x }, y)
    }),
    ("cut off", 4000, |p| {
        let e = p.pick(EXPONENTS) + p.between(-3.0, 3.0);
        let x = match p.below(3) {
            0 => p.between(0.0, 40.0),
            1 => p.scaled(-1000, -1).abs(),
            _ => p.between(0.0, 300.0),
        };
        let y = x.mul_add(x, e).max(0.0).sqrt();
        C::new(p.beside(x), p.beside(y))
    }),
    ("zeros", 3000, |p| {
        const ZEROS: [(f64, f64); 14] = [
            (1.991_466_842_833_858, -1.354_810_123_112_006),
            (2.691_149_024_251_438, -2.177_044_906_089_615),
            (3.235_330_868_352_816, -2.784_387_613_230_428),
            (3.697_309_702_512_468, -3.287_410_789_389_848),
            (4.106_107_271_682_631, -3.725_948_719_445_795),
            (4.476_815_692_967_473, -4.119_635_226_670_482),
            (4.818_488_291_891_866, -4.479_782_768_744_83),
            (1.450_616_163_243_677, 1.880_943_000_205_573),
            (2.244_659_273_803_248, 2.616_575_140_689_96),
            (2.839_741_046_908_408, 3.175_628_099_643_188),
            (1.354_810_123_112_006, 1.991_466_842_833_858),
            (0.924_138_873_004_591, 0.0),
            (1.501_975_268_268_612, 0.0),
            (0.0, 0.924_138_873_004_591),
        ];
        let (x, y) = ZEROS[p.below(14) as usize];
        let down = -(p.below(50) as i64);
        let d = C::new(p.scaled(down - 6, down - 3), p.scaled(down - 6, down - 3));
        let z = C::new(x, y) + d;
        C::new(
            if p.below(2) == 0 { z.re } else { -z.re },
            if p.below(2) == 0 { z.im } else { -z.im },
        )
    }),
    ("balanced", 6000, |p| {
        // |e^{−z²}| of the size of 1/|z|: where the terms of one function or another cancel.
        let x = p.scaled(0, 20).abs();
        let e = p.between(0.0, 32.0);
        let y = x.mul_add(x, p.either(e)).max(0.0).sqrt();
        C::new(p.either(x), p.either(y))
    }),
    ("balanced beside an axis", 3000, |p| {
        // (2/√π) x e^{y²} next to 1, with e^{y²} from erfcx.
        let y = p.between(2.0, 26.0);
        let x =
            p.between(0.9, 1.1) * std::f64::consts::FRAC_2_SQRT_PI.recip() * 2.0 / erfcx_real(-y);
        let x = if p.below(2) == 0 {
            x
        } else {
            x * p.scaled(-3, 20).abs()
        };
        let (x, y) = if p.below(2) == 0 { (x, y) } else { (y, x) };
        C::new(p.either(x), p.either(y))
    }),
    ("maximum of Dawson's function", 2000, |p| {
        // Where the slope of Im F/b vanishes, about 0.308 b² from the maximum.
        let b = p.scaled(-14, -3).abs();
        let x = (-0.308 * b * b).mul_add(p.between(0.8, 1.2), 0.924_138_873_004_591_8);
        C::new(p.either(x), p.either(b))
    }),
    ("no numbers", 200, |p| {
        const ODD: &[f64] = &[
            0.0,
            -0.0,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::MAX,
            f64::MIN_POSITIVE,
            5e-324,
            1.0,
            -3.0,
        ];
        C::new(p.pick(ODD), p.pick(ODD))
    }),
];

/// FNV-1a over the bits; all NaN alike.
fn digest(values: impl Iterator<Item = f64>) -> u64 {
    values.fold(0xcbf2_9ce4_8422_2325, |hash, x| {
        let bits = if x.is_nan() {
            f64::NAN.to_bits()
        } else {
            x.to_bits()
        };
        bits.to_le_bytes().iter().fold(hash, |hash, b| {
            (hash ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3)
        })
    })
}

/// Describes what makes many values of many points.
type Many = fn(&[C]) -> Vec<C>;

fn real(f: fn(f64) -> f64, z: &[C]) -> Vec<C> {
    z.iter().map(|z| C::new(f(z.re), f(z.im))).collect()
}

const FUNCTIONS: &[(&str, Many)] = &[
    ("faddeeva", |z| z.iter().map(|z| faddeeva(*z)).collect()),
    ("w_derivative", |z| {
        z.iter().map(|z| w_derivative(*z)).collect()
    }),
    ("erf", |z| z.iter().map(|z| erf(*z)).collect()),
    ("erfc", |z| z.iter().map(|z| erfc(*z)).collect()),
    ("erfcx", |z| z.iter().map(|z| erfcx(*z)).collect()),
    ("erfi", |z| z.iter().map(|z| erfi(*z)).collect()),
    ("dawson", |z| z.iter().map(|z| dawson(*z)).collect()),
    ("erf_real", |z| real(erf_real, z)),
    ("erfc_real", |z| real(erfc_real, z)),
    ("erfcx_real", |z| real(erfcx_real, z)),
    ("erfi_real", |z| real(erfi_real, z)),
    ("dawson_real", |z| real(dawson_real, z)),
    ("voigt", |z| {
        z.iter()
            .map(|z| {
                C::new(
                    voigt(z.re, 1.0, z.im.abs()),
                    voigt(1.5, z.re.abs(), z.im.abs()),
                )
            })
            .collect()
    }),
    ("voigt_hwhm", |z| {
        let width = |z: &C| voigt_hwhm(z.re.abs(), z.im.abs());
        z.iter().map(|z| C::new(width(z), 0.0)).collect()
    }),
    ("faddeeva_batch", |z| {
        let mut w = vec![C::default(); z.len()];
        faddeeva_batch(z, &mut w).expect("the same length");
        w
    }),
];

fn points(kind: &Kind) -> Vec<C> {
    // Each kind has a stream of its own.
    let seed = digest(kind.0.bytes().map(f64::from));
    let mut p = Random(seed);
    (0..kind.1).map(|_| kind.2(&mut p)).collect()
}

fn lines(name: &str, f: Many) -> Vec<String> {
    let line = |kind: &Kind| {
        let values = f(&points(kind));
        let digest = digest(values.iter().flat_map(|w| [w.re, w.im]));
        // Batches are to have the bits of single points.
        format!(
            "{},{},{digest:016x}",
            name.trim_end_matches("_batch"),
            kind.0
        )
    };
    KINDS.iter().map(line).collect()
}

const FILE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../tests/solver_values/bits.csv"
);

fn hold(name: &str) {
    let text = std::fs::read_to_string(FILE).expect("the digests");
    let f = FUNCTIONS
        .iter()
        .find(|f| f.0 == name)
        .expect("a function")
        .1;
    let changed: Vec<String> = lines(name, f)
        .into_iter()
        .filter(|line| !text.lines().any(|l| l == line))
        .collect();
    assert!(
        changed.is_empty(),
        "other bits than those of tests/solver_values/bits.csv:\n{}",
        changed.join("\n")
    );
}

/// One test for each function, so that they run side by side.
mod bits_of {
    macro_rules! held {
        ($($name:ident),*) => {$(
            #[test]
            fn $name() {
                super::hold(stringify!($name));
            }
        )*};
    }

    held!(
        faddeeva,
        faddeeva_batch,
        w_derivative,
        dawson,
        dawson_real,
        voigt
    );
    held!(
        erf, erfc, erfcx, erfi, erf_real, erfc_real, erfcx_real, erfi_real
    );
}

#[test]
#[ignore = "writes tests/solver_values/bits.csv"]
fn bits_written() {
    let mut text = String::from("function,points,digest\n");
    for (name, f) in FUNCTIONS.iter().filter(|f| !f.0.ends_with("_batch")) {
        for line in lines(name, *f) {
            writeln!(text, "{line}").expect("text");
        }
    }
    let next = format!("{FILE}.next");
    std::fs::write(&next, text).expect("written");
    std::fs::rename(next, FILE).expect("renamed");
}
