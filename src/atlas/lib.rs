//! Published algorithms for the Faddeeva function `w(z) = e^{−z²} erfc(−iz)` and its real part, the
//! Voigt function, each written from its paper's formulas in `f64`: to be audited, not to be used.
//!
//! One file an algorithm. Constants are those that the paper or its authors' code prints, or are
//! computed from the paper's formula; each file says which. What is claimed about an algorithm and
//! whether it holds stands in `mechaudit::claims`; nothing here is used by a solver.
//!
//! Exponentials and circular functions are those of the `libm` crate, which come out the same on
//! every machine, with and without fused operations; complex quotients are Smith's, as compilers of
//! Fortran and C make them, so that `|z|²` beyond the range of `f64` is not held against an
//! algorithm.
//!
//! ```
//! use num_complex::Complex;
//! let w4 = mechaudit_atlas::find("humlicek-1982").unwrap();
//! let at_one = (w4.w)(Complex::new(1.0, 1.0));
//! assert!((at_one.re - 0.304744205).abs() < 1e-4 && (at_one.im - 0.208218938).abs() < 1e-4);
//! ```
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod abrarov_quine;
mod algorithm;
#[cfg(test)]
mod border_tests;
mod elementary;
mod gauss_hermite;
mod gautschi;
mod hartmann_tran;
mod hui_armstrong_wray;
mod humlicek_1979;
mod humlicek_1982;
mod karbach_raven_schiller;
mod laplace;
mod mclean;
mod poppe_wijers;
mod pseudo_voigt;
mod real;
mod schreier;
#[cfg(test)]
mod tests;
mod trapezoidal;
mod weideman;
mod wells;
mod zaghloul_2017;
mod zaghloul_ali;

pub use algorithm::{Algorithm, NotAtHand, Parts, Plane};
pub use hartmann_tran::{Line, PROFILES, Profile};

/// All of them, by the years of their papers.
pub fn all() -> Vec<Algorithm> {
    let mut all = Vec::new();
    all.extend(gautschi::ALGORITHMS);
    all.extend(trapezoidal::MATTA_REICHEL);
    all.extend(trapezoidal::HUNTER_REGAN);
    all.extend(hui_armstrong_wray::ALGORITHMS);
    all.extend(humlicek_1979::ALGORITHMS);
    all.extend(humlicek_1982::ALGORITHMS);
    all.extend(pseudo_voigt::ALGORITHMS);
    all.extend(poppe_wijers::ALGORITHMS);
    all.extend(mclean::ALGORITHMS);
    all.extend(weideman::ALGORITHMS);
    all.extend(wells::ALGORITHMS);
    all.extend(zaghloul_ali::ALGORITHMS);
    all.extend(abrarov_quine::ALGORITHMS);
    all.extend(hartmann_tran::ALGORITHMS);
    all.extend(karbach_raven_schiller::ALGORITHMS);
    all.extend(zaghloul_2017::ALGORITHMS);
    all.extend(schreier::ALGORITHMS);
    all.extend(trapezoidal::AL_AZAH_CHANDLER_WILDE);
    all
}

/// The algorithm of that name.
pub fn find(name: &str) -> Option<Algorithm> {
    all().into_iter().find(|a| a.name == name)
}

/// States what is missing from [`all`], and why.
pub const NOT_AT_HAND: &[NotAtHand] = &[NotAtHand {
    name: "letchworth-benner-2007",
    source: "K. L. Letchworth, D. C. Benner, JQSRT 107 (2007) 173-192",
    why: "its tables' grids, the borders of its three methods and the orders of its quadrature and interpolation are in no text and \
              no public code at hand; abstracts have only which methods they are",
}];
