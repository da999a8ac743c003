//! Accuracy: every code against the certified reference on the same points.

use crate::code::Code;
use crate::errors::{Outcome, compare};
use crate::points::Region;
use crate::spread::Spread;
use mechaudit::reference::{ComplexBall, faddeeva};
use num_complex::Complex64;
use rayon::prelude::*;
use serde::Serialize;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Certified bits of each component of the reference.
pub const BITS: u32 = 90;
/// Points evaluated at once.
const BLOCK: u64 = 512;
/// Blocks shared out to the threads at once; their results are added up in order.
const BLOCKS: u64 = 128;

/// The number of points.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Settings {
    /// Key of the random points.
    pub seed: u64,
    /// Points of each region.
    pub points: u64,
}

/// One code in one region.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Accuracy {
    /// The code.
    pub code: String,
    /// `|got − ref| / |ref|` in eps.
    pub normwise: Spread,
    /// The same of the real part.
    pub re: Spread,
    /// The same of the imaginary part.
    pub im: Spread,
    /// Error of the real part in ulps.
    pub re_ulps: Spread,
    /// Error of the imaginary part in ulps.
    pub im_ulps: Spread,
    /// Values with NaN or an infinity where a finite value is due, or the other way round; not in
    /// the errors above.
    pub wrong_kind: u64,
    /// Values at which the code panicked; among the wrong kinds.
    pub panics: u64,
    /// Values that the reference does not decide; not in the errors above.
    pub undecided: u64,
    /// Values whose bits differ from those of this project's scalar function; for its other shapes.
    pub differs: Option<u64>,
}

/// One region.
#[derive(Clone, Debug, Serialize)]
pub struct RegionAccuracy {
    /// Its letter.
    pub region: &'static str,
    /// Describes the set of points.
    pub description: &'static str,
    /// One entry for each code.
    pub codes: Vec<Accuracy>,
}

impl Accuracy {
    fn merge(&mut self, other: &Accuracy) {
        self.normwise.merge(&other.normwise);
        self.re.merge(&other.re);
        self.im.merge(&other.im);
        self.re_ulps.merge(&other.re_ulps);
        self.im_ulps.merge(&other.im_ulps);
        self.wrong_kind += other.wrong_kind;
        self.panics += other.panics;
        self.undecided += other.undecided;
        if let Some(n) = other.differs {
            *self.differs.get_or_insert(0) += n;
        }
    }

    fn add(&mut self, z: Complex64, got: Complex64, reference: Option<&ComplexBall>) {
        match reference.map_or(Outcome::Undecided, |r| compare(got, r)) {
            Outcome::Finite(e) => {
                self.normwise.add(e.normwise, z);
                self.re.add(e.relative[0], z);
                self.im.add(e.relative[1], z);
                self.re_ulps.add(e.ulps[0], z);
                self.im_ulps.add(e.ulps[1], z);
            }
            Outcome::Infinite => {}
            Outcome::WrongKind => self.wrong_kind += 1,
            Outcome::Undecided => self.undecided += 1,
        }
    }

    /// The five measures: normwise, of each part, in ulps of each part.
    pub fn spreads(&self) -> [&Spread; 5] {
        [
            &self.normwise,
            &self.re,
            &self.im,
            &self.re_ulps,
            &self.im_ulps,
        ]
    }
}

/// Evaluates; a value at which the code panics becomes NaN. Returns their numbers.
pub fn evaluate(code: &dyn Code, z: &[Complex64], out: &mut [Complex64]) -> Vec<usize> {
    let whole = catch_unwind(AssertUnwindSafe(|| code.evaluate(z, out)));
    if whole.is_ok() {
        return Vec::new();
    }
    let mut panics = Vec::new();
    for i in 0..z.len() {
        let one = catch_unwind(AssertUnwindSafe(|| {
            code.evaluate(&z[i..=i], &mut out[i..=i]);
        }));
        if one.is_err() {
            out[i] = Complex64::new(f64::NAN, f64::NAN);
            panics.push(i);
        }
    }
    panics
}

/// The reference at a finite point; nothing where it is undecided.
pub fn reference(z: Complex64) -> Option<ComplexBall> {
    faddeeva::w_f64(z.re, z.im, BITS).ok()
}

fn block(codes: &[&dyn Code], z: &[Complex64]) -> Vec<Accuracy> {
    let references: Vec<_> = z.iter().map(|&z| reference(z)).collect();
    let mut out = vec![Complex64::ZERO; z.len()];
    let mut first_own: Option<Vec<Complex64>> = None;
    let mut result = Vec::with_capacity(codes.len());
    for code in codes {
        let mut accuracy = Accuracy {
            code: code.name().to_owned(),
            panics: evaluate(*code, z, &mut out).len() as u64,
            ..Accuracy::default()
        };
        for ((&z, &got), r) in z.iter().zip(&out).zip(&references) {
            accuracy.add(z, got, r.as_ref());
        }
        if code.own() {
            let bits = |w: &Complex64| (w.re.to_bits(), w.im.to_bits());
            match &first_own {
                None => first_own = Some(out.clone()),
                Some(first) => {
                    let differing = out.iter().zip(first).filter(|(a, b)| bits(a) != bits(b));
                    accuracy.differs = Some(differing.count() as u64);
                }
            }
        }
        result.push(accuracy);
    }
    result
}

/// Compares all codes in all regions. `tick` is told how many points are done.
pub fn measure(
    codes: &[&dyn Code],
    regions: &[&'static Region],
    settings: &Settings,
    tick: &(dyn Fn(u64) + Sync),
) -> Vec<RegionAccuracy> {
    let of_region = |region: &&'static Region| {
        let mut total: Vec<Accuracy> = codes
            .iter()
            .map(|c| Accuracy {
                code: c.name().to_owned(),
                ..Accuracy::default()
            })
            .collect();
        let mut first = 0;
        while first < settings.points {
            let count = (settings.points - first).min(BLOCK * BLOCKS);
            let blocks: Vec<Vec<Accuracy>> = (0..count.div_ceil(BLOCK))
                .into_par_iter()
                .map(|b| {
                    let n = BLOCK.min(count - b * BLOCK);
                    let z = region.points(settings.seed, first + b * BLOCK, n as usize);
                    let result = block(codes, &z);
                    tick(n);
                    result
                })
                .collect();
            for block in &blocks {
                for (t, b) in total.iter_mut().zip(block) {
                    t.merge(b);
                }
            }
            first += count;
        }
        RegionAccuracy {
            region: region.name,
            description: region.description,
            codes: total,
        }
    };
    regions.iter().map(of_region).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code::Scalar;
    use crate::points::{REGIONS, ZEROS};

    fn code(name: &str, own: bool, w: fn(Complex64) -> Complex64) -> Box<dyn Code> {
        Box::new(Scalar {
            name: name.into(),
            version: String::new(),
            own,
            w,
        })
    }

    /// The reference, rounded.
    fn rounded(z: Complex64) -> Complex64 {
        let r = reference(z).unwrap();
        Complex64::new(r.re.mid().to_f64(), r.im.mid().to_f64())
    }

    #[test]
    fn planted_faults_are_found() {
        let codes = [
            code("right", true, rounded),
            code("off", true, |z| rounded(z) * (1.0 + 8.0 * f64::EPSILON)),
            code("nan", false, |z| {
                if z.re > 0.0 { rounded(z) } else { z * f64::NAN }
            }),
            code("panics", false, |z| {
                assert!(z.re > 0.0, "planted");
                rounded(z)
            }),
        ];
        let codes: Vec<_> = codes.iter().map(|c| &**c).collect();
        let settings = Settings {
            seed: 1,
            points: 600,
        };
        let regions: Vec<_> = REGIONS.iter().collect();
        for region in measure(&codes, &regions, &settings, &|_| ()) {
            let [right, off, nan, panics] = &region.codes[..] else {
                panic!()
            };
            assert_eq!((right.undecided, right.wrong_kind), (0, 0));
            assert!(right.re_ulps.worst() <= 0.5 && right.im_ulps.worst() <= 0.5);
            assert!(right.normwise.worst() <= 0.51, "{region:?}");
            assert!((6.5..9.5).contains(&off.normwise.worst()));
            assert_eq!(off.differs, Some(600));
            let left = regions.iter().find(|r| r.name == region.region).unwrap();
            let left = left
                .points(1, 0, 600)
                .iter()
                .filter(|z| z.re <= 0.0)
                .count() as u64;
            assert_eq!((nan.wrong_kind, nan.panics), (left, 0));
            assert_eq!((panics.wrong_kind, panics.panics), (left, left));
        }
    }

    #[test]
    fn the_zeros_are_zeros() {
        for (x, y) in ZEROS {
            let w = rounded(Complex64::new(x, y));
            // |W'| = 2/√π there, and the point is within half an ulp (2^-52) of the zero.
            assert!(w.norm() < 6e-16 && w.norm() > 0.0, "{w}");
        }
    }
}
