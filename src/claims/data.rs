//! The claims.
//!
//! Statements are as printed in what was read; where that is not the paper itself the source says
//! so.

use super::claim::{Claim, Measure, Place, Statistic};
use super::lines;
use super::regions::either_side;
use crate::audit::Draw;
use crate::reference::faddeeva::zero;
use Measure::{Absolute, AbsoluteRe, Norm, RelativeIm, RelativeParts, RelativeRe};
use Statistic::{Maximum, Mean};
use std::sync::LazyLock;

/// Near the axis as often as far from it.
fn any_height(d: &mut Draw) -> f64 {
    match d.chance(0.5) {
        true => d.uniform(0.0, 8.0),
        false => d.log_uniform(1e-12, 10.0),
    }
}

fn any_real(d: &mut Draw) -> f64 {
    match d.chance(0.7) {
        true => d.uniform(0.0, 12.0),
        false => d.log_uniform(1e-3, 1e4),
    }
}

const HALF_PLANE: Place = Place {
    words: "Im z >= 0; tried up to |Re z| = 4e4, Im z = 40, down to 1e-12",
    draw: |d| either_side(any_real(d), any_height(d), d),
    holds: |z| z[1] >= 0.0 && z[0].abs() < 4e4 && z[1] < 40.0,
};

const SQUARE_8: Place = Place {
    words: "-8 <= Re z <= 8, -8 <= Im z <= 8",
    draw: |d| {
        let y = d.uniform(0.0, 8.0);
        vec![d.uniform(-8.0, 8.0), d.signed(y)]
    },
    holds: |z| z[0].abs() <= 8.0 && z[1].abs() <= 8.0,
};

const FIRST_QUADRANTS: Place = Place {
    words: "Im z >= 0, the first and second quadrant; tried likewise",
    ..HALF_PLANE
};

const LOWER_QUADRANTS: Place = Place {
    words: "Im z < 0, the third and fourth quadrant, off discs of radius 0.126 about the zeros; tried to |Re z| = 8, Im z = -6",
    draw: |d| {
        let y = -d.uniform(0.0, 6.0);
        vec![d.uniform(-8.0, 8.0), y]
    },
    holds: |z| (-6.0..0.0).contains(&z[1]) && z[0].abs() <= 8.0 && off_zeros(z[0].abs(), z[1]),
};

/// The zeros of w with Re z > 0, Im z > −6.7.
static ZEROS: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
    (1..=14)
        .map(|k| {
            let z = zero(k, 60).expect("the first zeros are isolated");
            [z.re.to_f64(), z.im.to_f64()]
        })
        .collect()
});

fn off_zeros(x: f64, y: f64) -> bool {
    ZEROS.iter().all(|z| (x - z[0]).hypot(y - z[1]) > 0.126)
}

const ABRAROV: Place = Place {
    words: "0 < Re z < 40000, 1e-4 < Im z < 100, both uniform",
    draw: |d| vec![d.uniform(0.0, 4e4), d.uniform(1e-4, 100.0)],
    holds: |z| z[0] > 0.0 && z[0] < 4e4 && z[1] > 1e-4 && z[1] < 100.0,
};

const PLANE: Place = Place {
    words: "all z; tried within |Re z| <= 8, |Im z| <= 4",
    draw: |d| {
        let y = any_height(d) * 0.5;
        vec![d.uniform(-8.0, 8.0), d.signed(y)]
    },
    holds: |z| z[0].abs() <= 8.0 && z[1].abs() <= 4.0,
};

const ORDINARY: Place = Place {
    words: "-60 <= Re z <= 60, 0 <= Im z <= 100",
    draw: |d| either_side(d.uniform(0.0, 60.0), any_height(d) * 12.0, d),
    holds: |z| z[0].abs() <= 60.0 && (0.0..=100.0).contains(&z[1]),
};

const MEASURED: Place = Place {
    words: "Re z = -8..8, Im z = 0.1..8",
    draw: |d| vec![d.uniform(-8.0, 8.0), d.uniform(0.1, 8.0)],
    holds: |z| z[0].abs() <= 8.0 && (0.1..=8.0).contains(&z[1]),
};

/// Of widths: sigma = 1/√2, gamma = y.
const PROFILES: Place = Place {
    words: "|Re z| < 12, Im z = 1e-3..1e3",
    draw: |d| {
        let y = d.log_uniform(1e-3, 1e3);
        either_side(d.uniform(0.0, 12.0) * (1.0 + y), y, d)
    },
    holds: |z| z[0].abs() < 12.0 * (1.0 + z[1]) && (1e-3..=1e3).contains(&z[1]),
};

const SCHREIER: Place = Place {
    words: "0 < Re z < 25, 1e-8 < Im z < 100",
    draw: |d| vec![d.uniform(0.0, 25.0), d.log_uniform(1e-8, 100.0)],
    holds: |z| z[0] > 0.0 && z[0] < 25.0 && z[1] > 1e-8 && z[1] < 100.0,
};

const LINES: Place = Place {
    words: "lines with positive widths at every speed: Gamma_0 = 1e-5..1e3 Doppler widths, Gamma_2 and shifts up to 0.3 of it, \
            nu_VC up to it, eta up to 0.9, up to 1e4 widths from the centre",
    draw: lines::any,
    holds: lines::physical,
};

const SIMPLE_LINES: Place = Place {
    words: "such lines without shifts and correlation",
    draw: lines::any_simple,
    holds: |p| lines::physical(p) && lines::simple(p),
};

const fn claim(
    algorithm: &'static str,
    statement: &'static str,
    source: &'static str,
    reading: &'static str,
    test: (Place, Measure, Statistic, f64),
) -> Claim {
    Claim {
        algorithm,
        statement,
        source,
        reading,
        test: Some(test),
    }
}

const fn untestable(
    algorithm: &'static str,
    statement: &'static str,
    source: &'static str,
    why: &'static str,
) -> Claim {
    Claim {
        algorithm,
        statement,
        source,
        reading: why,
        test: None,
    }
}

const HUMLICEK_1979: &str = "Humlíček 1979, abstract, p. 309";
const SCHREIER_2018: &str = "Schreier 2018, abstract (arXiv:1806.11560)";
const CPFX: &str = "cpfX.py of the supplement of Schreier 2018, comment";
const TRAN: &str = "Tran, Ngo, Hartmann 2013, abstract";
const WTRAP: &str =
    "README of the authors' program, of Al Azah and Chandler-Wilde 2021, theorem 1.1";
const ROOFIT: &str = "Karbach, Raven, Schiller 2014, comment of the program printed in arXiv:1407.0748 and in RooFit's RooMath";

/// All of them, in the order of the algorithms.
pub fn claims() -> Vec<Claim> {
    vec![
        claim(
            "cernlib-wwerf",
            "0.5e-10 absolute",
            "target of the beam-beam code xfields, whose faddeeva.h is this algorithm; read second-hand",
            "each part, in the first quadrant and its mirror image",
            (HALF_PLANE, Absolute, Maximum, 0.5e-10),
        ),
        untestable(
            "matta-reichel-1971",
            "Reliable, but not quick. (strange for a<=0.001)",
            "comment of a program for stellar spectra that calls K. Eriksson's copy; the paper was not read",
            "no number is stated; the row and the findings show where it is strange",
        ),
        claim(
            "hui-armstrong-wray-1978",
            "Accuracy ≈ 1e-6 over the spectroscopy domain (|z| not too large)",
            "comment of a public Rust code that takes the coefficients; the paper was not read",
            "absolute, and one figure is allowed more",
            (MEASURED, Absolute, Maximum, 1e-5),
        ),
        claim(
            "hui-armstrong-wray-1978",
            "same speed in whole parameter space […] only 1% accurate for larger v",
            "RH (H. Uitenbroek), voigt.c, head",
            "relative, Re",
            (HALF_PLANE, RelativeRe, Maximum, 1e-2),
        ),
        claim(
            "humlicek-1979",
            "w(z) in the entire y ≥ 0 half-plane can be calculated, the maximum relative error being less than 2 × 10⁻⁶ […] \
             for the real […] part",
            HUMLICEK_1979,
            "",
            (HALF_PLANE, RelativeRe, Maximum, 2e-6),
        ),
        claim(
            "humlicek-1979",
            "[…] and 5 × 10⁻⁶ for the […] imaginary part",
            HUMLICEK_1979,
            "",
            (HALF_PLANE, RelativeIm, Maximum, 5e-6),
        ),
        claim(
            "humlicek-1979",
            "achieves an accuracy of five to six significant digits throughout the entire complex plane",
            SCHREIER_2018,
            "five digits of the norm, in the upper half-plane",
            (HALF_PLANE, Norm, Maximum, 1e-5),
        ),
        claim(
            "humlicek-1982",
            "Relative accuracy ~1e-4 everywhere",
            "comment of a public code (voigt_H by w4); the paper's abstract was not read",
            "each part",
            (HALF_PLANE, RelativeParts, Maximum, 1e-4),
        ),
        claim(
            "humlicek-1982",
            "Relative accuracy ~1e-4 everywhere",
            "the same",
            "of the norm",
            (HALF_PLANE, Norm, Maximum, 1e-4),
        ),
        claim(
            "thompson-cox-hastings-1987",
            "relative errors as large as some percent",
            "Schreier 2019 on pseudo-Voigt functions, abstract (arXiv:1901.08366)",
            "some percent is at most 10 %, of Re at every point",
            (PROFILES, RelativeRe, Maximum, 0.1),
        ),
        claim(
            "thompson-cox-hastings-1987",
            "good to 1%",
            "XSPEC's manual, model voigt, of Ida, Ando and Toraya's pseudo-Voigt, which refines this one",
            "absolute, in units of K(0, 0) = 1",
            (PROFILES, AbsoluteRe, Maximum, 1e-2),
        ),
        claim(
            "poppe-wijers-1990",
            "The accuracy of the algorithm for z in the 1st and 2nd quadrant is 14 significant digits",
            "head of WOFZ, Poppe and Wijers 1990; read in Shterenlikht's translation",
            "half a unit of the 14th digit at worst: 5e-14, of the norm",
            (FIRST_QUADRANTS, Norm, Maximum, 5e-14),
        ),
        claim(
            "poppe-wijers-1990",
            "The accuracy of the algorithm for z in the 1st and 2nd quadrant is 14 significant digits",
            "the same",
            "of each part",
            (FIRST_QUADRANTS, RelativeParts, Maximum, 5e-14),
        ),
        claim(
            "poppe-wijers-1990",
            "in the 3rd and 4th it is 13 significant digits outside a circular region with radius 0.126 around a zero of the function",
            "the same",
            "5e-13, of the norm",
            (LOWER_QUADRANTS, Norm, Maximum, 5e-13),
        ),
        claim(
            "weideman-1994-16",
            "N=16 max abs err ~3e-7 vs wofz",
            "notes of xicsrt (Weideman N = 16 as its default)",
            "below 3.5e-7",
            (HALF_PLANE, Absolute, Maximum, 3.5e-7),
        ),
        claim(
            "weideman-1994-32",
            "N=32 measured at 3.2e-13 max relative error vs scipy.special.wofz over x in [-60, 60], y in [0, 100]",
            "comment of a public code for roughness spectra; the paper's table was not read",
            "of the norm",
            (ORDINARY, Norm, Maximum, 3.25e-13),
        ),
        claim(
            "weideman-1994-32",
            "N=32 measured at 3.2e-13 max relative error vs scipy.special.wofz over x in [-60, 60], y in [0, 100]",
            "the same",
            "of each part",
            (ORDINARY, RelativeParts, Maximum, 3.25e-13),
        ),
        claim(
            "weideman-1994-32",
            "tested at rtol 1e-5",
            "jax.scipy.special.wofz, which is this series: its own tests' tolerance (jax#37676); read second-hand",
            "of each part",
            (HALF_PLANE, RelativeParts, Maximum, 1e-5),
        ),
        claim(
            "wells-1999-r2",
            "relative error less than 10^(-R)",
            "Wells 1999, comment of HUMLIK",
            "R = 2, each part",
            (HALF_PLANE, RelativeParts, Maximum, 1e-2),
        ),
        claim(
            "wells-1999-r3",
            "relative error less than 10^(-R)",
            "Wells 1999, comment of HUMLIK",
            "R = 3, each part",
            (HALF_PLANE, RelativeParts, Maximum, 1e-3),
        ),
        claim(
            "wells-1999-r4",
            "relative error less than 10^(-R)",
            "Wells 1999, comment of HUMLIK",
            "R = 4, Re",
            (HALF_PLANE, RelativeRe, Maximum, 1e-4),
        ),
        claim(
            "wells-1999-r4",
            "relative error less than 10^(-R)",
            "the same",
            "R = 4, Im",
            (HALF_PLANE, RelativeIm, Maximum, 1e-4),
        ),
        claim(
            "wells-1999-r5",
            "relative error less than 10^(-R)",
            "Wells 1999, comment of HUMLIK",
            "R = 5, each part",
            (HALF_PLANE, RelativeParts, Maximum, 1e-5),
        ),
        claim(
            "zaghloul-ali-2011-1e-4",
            "err - The desired accuracy (positive)",
            "Shterenlikht's translation of algorithm 916, head; the paper: \"flexible accuracy vs efficiency trade-off\"",
            "of the norm, err = 1e-4",
            (HALF_PLANE, Norm, Maximum, 1e-4),
        ),
        claim(
            "zaghloul-ali-2011-1e-8",
            "err - The desired accuracy (positive)",
            "the same",
            "of the norm, err = 1e-8",
            (HALF_PLANE, Norm, Maximum, 1e-8),
        ),
        untestable(
            "zaghloul-ali-2011",
            "ACM Algorithm 916 (20 significant digits)",
            "Y. Wang, B. Zhou et al., Mathematics 10 (2022) 210, introduction",
            "no double has 20 digits",
        ),
        claim(
            "zaghloul-ali-2011",
            "err .ge. 0.06447*epsilon",
            "Shterenlikht's translation, head: the smallest err",
            "read as: of the norm within 10 ε",
            (HALF_PLANE, Norm, Maximum, 10.0 * f64::EPSILON),
        ),
        claim(
            "abrarov-quine-2011",
            "average accuracy 10⁻¹⁴ for 0 < x < 40000, 10⁻⁴ < y < 10²",
            "Abrarov and Quine 2011; read second-hand",
            "the mean relative error of Re is below 1e-14",
            (ABRAROV, RelativeRe, Mean, 1e-14),
        ),
        claim(
            "abrarov-quine-2011",
            "average accuracy 10⁻¹⁴ for 0 < x < 40000, 10⁻⁴ < y < 10²",
            "the same",
            "the mean relative error of Im is below 1e-14",
            (ABRAROV, RelativeIm, Mean, 1e-14),
        ),
        claim(
            "abrarov-quine-2016",
            "The code remains highly accurate even at vanishing imaginary argument y -> 0 […] The worst detected accuracy is ~10^-13",
            "fadf.m, head",
            "each part, and any number of that order: 1e-12",
            (HALF_PLANE, RelativeParts, Maximum, 1e-12),
        ),
        claim(
            "tran-ngo-hartmann-2013",
            "the pCqSDHC, qSDHC and qSDV profiles can be quickly calculated with an accuracy better than 10⁻⁴",
            TRAN,
            "relative, of the complex profile",
            (LINES, Norm, Maximum, 1e-4),
        ),
        claim(
            "tran-ngo-hartmann-2013",
            "the pCqSDHC, qSDHC and qSDV profiles can be quickly calculated with an accuracy better than 10⁻⁴",
            TRAN,
            "relative, of the absorption",
            (LINES, RelativeRe, Maximum, 1e-4),
        ),
        claim(
            "hapi-pcqsdhc",
            "the pCqSDHC, qSDHC and qSDV profiles can be quickly calculated with an accuracy better than 10⁻⁴",
            "the same, which HAPI's routine refers to; HAPI has another w",
            "relative, of the absorption",
            (LINES, RelativeRe, Maximum, 1e-4),
        ),
        claim(
            "tran-ngo-hartmann-2013-cpf",
            "a slightly improved version of the CPF subroutine [Humlicek 1979]",
            TRAN,
            "no worse than what Humlíček states of his: 2e-6 in Re",
            (HALF_PLANE, RelativeRe, Maximum, 2e-6),
        ),
        claim(
            "tran-ngo-hartmann-2013-cpf",
            "a slightly improved version of the CPF subroutine [Humlicek 1979]",
            TRAN,
            "likewise, 5e-6 in Im",
            (HALF_PLANE, RelativeIm, Maximum, 5e-6),
        ),
        claim(
            "schreier-hochstaffl-2021",
            "a single rational approximation of the complex error function valid in the whole complex plane […] enables computation of the \
             SDV and SDR with four significant digits or better",
            "Schreier and Hochstaffl 2021, abstract (arXiv:2010.09804)",
            "half a unit of the fourth digit at worst: 5e-4, relative, of the absorption",
            (SIMPLE_LINES, RelativeRe, Maximum, 5e-4),
        ),
        claim(
            "karbach-raven-schiller-2014",
            "In the square -8 <= Re(z) <= 8, -8 <= Im(z) <= 8, the routine is accurate to better than 4e-13 relative",
            ROOFIT,
            "of the norm",
            (SQUARE_8, Norm, Maximum, 4e-13),
        ),
        claim(
            "karbach-raven-schiller-2014",
            "the average relative error is better than 7e-16",
            ROOFIT,
            "of the norm, uniform in the square",
            (SQUARE_8, Norm, Mean, 7e-16),
        ),
        claim(
            "karbach-raven-schiller-2014-fast",
            "In the square -8 <= Re(z) <= 8, -8 <= Im(z) <= 8, the routine is accurate to better than 4e-7 relative",
            ROOFIT,
            "of the norm",
            (SQUARE_8, Norm, Maximum, 4e-7),
        ),
        claim(
            "karbach-raven-schiller-2014-fast",
            "the average relative error is better than 5e-9",
            ROOFIT,
            "of the norm, uniform in the square",
            (SQUARE_8, Norm, Mean, 5e-9),
        ),
        claim(
            "zaghloul-2017",
            "a relative accuracy better than 4e-5 over wide ranges of inputs",
            "Zaghloul 2017, as README of Faddeyeva985.jl has it",
            "each part",
            (HALF_PLANE, RelativeParts, Maximum, 4e-5),
        ),
        claim(
            "zaghloul-2017",
            "relative error is slightly greater than 4e-5 at some points in the same ranges, but never greater than 5e-5",
            "README of Faddeyeva985.jl, M. Baum's own test",
            "each part",
            (HALF_PLANE, RelativeParts, Maximum, 5e-5),
        ),
        claim(
            "schreier-2018-16",
            "The n=16 approximation has a relative accuracy better than 10⁻⁵ for almost the entire complex plane except for very small \
             imaginary values of the argument even without the correction term required for the cpf12 algorithm",
            SCHREIER_2018,
            "each part in the upper half-plane; the exception is what holds in part tells",
            (HALF_PLANE, RelativeParts, Maximum, 1e-5),
        ),
        claim(
            "schreier-2018-16",
            "Maximum relative error to wofz in 0<x<25 and 1e-8<y<1e2: 1.992e-4 and 2.60e-6 for K and L",
            CPFX,
            "K, that is Re",
            (SCHREIER, RelativeRe, Maximum, 1.9925e-4),
        ),
        claim(
            "schreier-2018-16",
            "Maximum relative error to wofz in 0<x<25 and 1e-8<y<1e2: 1.992e-4 and 2.60e-6 for K and L",
            CPFX,
            "L, that is Im",
            (SCHREIER, RelativeIm, Maximum, 2.605e-6),
        ),
        claim(
            "schreier-2018-16-1.31183",
            "Maximum relative error to wofz in 0<x<25 and 1e-8<y<1e2: 7.747e-5 and 4.08e-6 for K and L",
            CPFX,
            "K, that is Re",
            (SCHREIER, RelativeRe, Maximum, 7.7475e-5),
        ),
        claim(
            "schreier-2018-16-1.31183",
            "Maximum relative error to wofz in 0<x<25 and 1e-8<y<1e2: 7.747e-5 and 4.08e-6 for K and L",
            CPFX,
            "L, that is Im",
            (SCHREIER, RelativeIm, Maximum, 4.085e-6),
        ),
        claim(
            "schreier-2018-20",
            "With 20 terms the accuracy is better than 10⁻⁶",
            SCHREIER_2018,
            "each part, likewise",
            (HALF_PLANE, RelativeParts, Maximum, 1e-6),
        ),
        claim(
            "schreier-2018-hum2zpf16",
            "fast and generally more accurate than rtol=3.e-5",
            "astropy's documentation of Voigt1D, method 'Humlicek2', the default of the releases that say so",
            "Re, at every point",
            (HALF_PLANE, RelativeRe, Maximum, 3e-5),
        ),
        claim(
            "al-azah-chandler-wilde-2021",
            "|w(z)-w_N(z)| <= 0.7 exp(-pi N) for all non-negative integers N and all complex z (in exact arithmetic)",
            WTRAP,
            "N = 11 and f64: 0.7 e^(-11 pi) = 6.9e-16 and 16 roundings of a value of modulus at most 1, 2.5e-15, Im z >= 0",
            (HALF_PLANE, Absolute, Maximum, 2.5e-15),
        ),
        claim(
            "al-azah-chandler-wilde-2021",
            "N = 11 is recommended to achieve absolute and relative errors no larger than 1.4e-15",
            WTRAP,
            "of the norm, Im z >= 0",
            (HALF_PLANE, Norm, Maximum, 1.4e-15),
        ),
        claim(
            "al-azah-chandler-wilde-2021",
            "accuracies of 2e-15 in the computation of w(z) throughout the complex plane are achieved with N = 11, this confirmed by \
             computations",
            "Al Azah and Chandler-Wilde 2021, abstract",
            "absolute, each part, in the whole plane",
            (PLANE, Absolute, Maximum, 2e-15),
        ),
        untestable(
            "letchworth-benner-2007",
            "The accuracy is one part in 10⁶ of the value of the function itself for Doppler widths less than about 50 000 times the \
             Lorentz width and always accurate to an absolute value of 10⁻¹²",
            "K. L. Letchworth, D. C. Benner, 61st Int. Symp. Mol. Spectrosc. (2006), abstract",
            "the algorithm is not at hand",
        ),
        untestable(
            "letchworth-benner-2007",
            "The accuracy is one part in 10⁶ of the function itself. In addition, the derivatives of the function with respect to x and y \
             are returned with an accuracy of 0.5%",
            "K. L. Letchworth, D. C. Benner 2007, abstract",
            "the algorithm is not at hand",
        ),
    ]
}

#[cfg(test)]
mod tests;
