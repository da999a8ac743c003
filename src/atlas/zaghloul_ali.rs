//! M. R. Zaghloul, A. N. Ali, ACM TOMS 38 (2011) article 15, algorithm 916: equations (13) to (19).
//! With `a = π/√(ln(2/tiny))` the five sums `Σ₁ = Σ e^{−a²n²}/d_n`, `Σ₂,₃ = Σ e^{−(an ± x)²}/d_n`,
//! `Σ₄,₅ = Σ n e^{−(an ± x)²}/d_n`, `d_n = a²n² + y²`, and erfcx(y). Accuracy is chosen by `tiny`.

use crate::algorithm::{Algorithm, WHOLE};
use crate::elementary::{FRAC_1_SQRT_PI, continued_below, mirrored};
use mechaudit_solvers::faddeeva::erfcx_real;
use num_complex::{Complex, Complex64};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// The smallest `tiny` that the paper allows, the largest, and one between.
pub const ALGORITHMS: [Algorithm; 3] = [
    with(
        "zaghloul-ali-2011",
        "Algorithm 916, tiny = 0.06447 ε: all digits",
        |z| FULL.at(z),
    ),
    with(
        "zaghloul-ali-2011-1e-8",
        "Algorithm 916, tiny = 1e-8",
        |z| MIDDLE.at(z),
    ),
    with(
        "zaghloul-ali-2011-1e-4",
        "Algorithm 916, tiny = 1e-4",
        |z| ROUGH.at(z),
    ),
];

const fn with(name: &'static str, title: &'static str, w: fn(Complex64) -> Complex64) -> Algorithm {
    Algorithm {
        name,
        title,
        source: "M. R. Zaghloul, A. N. Ali, ACM TOMS 38 (2011) article 15",
        read_from: "equations (13)-(19) and borders as in A. Shterenlikht's translation (errfun.f90); terms are summed \
                    while e^(-(an - x)²) exceeds tiny, each exponential for itself",
        w,
        formula: Some(formula),
        ..WHOLE
    }
}

static FULL: LazyLock<Sums> = LazyLock::new(|| Sums::new(0.06447 * f64::EPSILON));
static MIDDLE: LazyLock<Sums> = LazyLock::new(|| Sums::new(1e-8));
static ROUGH: LazyLock<Sums> = LazyLock::new(|| Sums::new(1e-4));

/// `√(−ln r)`, r the smallest normal number.
const EDGE: f64 = 26.615_717_509_251_26;

fn formula(z: Complex64) -> u8 {
    match (z.re.abs(), z.im.abs()) {
        (x, _) if x >= 1e15 => 3,
        (x, _) if x >= EDGE => 2,
        (_, y) if y > 5.0 => 1,
        _ => 0,
    }
}

struct Sums {
    a: f64,
    /// Terms on either side.
    terms: i32,
}

impl Sums {
    fn new(tiny: f64) -> Sums {
        let decay = libm::log(2.0 / tiny);
        Sums {
            a: PI / decay.sqrt(),
            terms: (decay / PI).ceil() as i32 + 2,
        }
    }

    fn at(&self, z: Complex64) -> Complex64 {
        continued_below(z, |z| mirrored(z, |z| self.quadrant(z)))
    }

    fn quadrant(&self, z: Complex64) -> Complex64 {
        let (x, y) = (z.re, z.im.max(f64::MIN_POSITIVE));
        if x == 0.0 {
            return Complex::new(erfcx_real(y), 0.0);
        }
        let size = x * x + y * y;
        if x >= 1e15 {
            return Complex::new(FRAC_1_SQRT_PI * y / size, FRAC_1_SQRT_PI * x / size);
        }
        let (a, over_pi) = (self.a, self.a / PI);
        let [third, fifth] = self.about_the_peak(x, y);
        let [first, second, fourth] = self.about_the_origin(x, y);
        let gauss = libm::exp(-x * x);
        let scaled = erfcx_real(y);
        let (half_sine, _) = libm::sincos(x * y);
        let (sine, cosine) = libm::sincos(2.0 * x * y);
        let direct = gauss * (scaled * cosine + 2.0 * over_pi * half_sine * half_sine / y);
        let re = direct + 2.0 * over_pi * y * (0.5 * (second + third) - gauss * cosine * first);
        // Above y = 5 the paper leaves this part out.
        let turned = match y > 5.0 {
            true => 0.0,
            false => gauss * sine * (over_pi / y + 2.0 * over_pi * y * first - scaled),
        };
        let odd = match x < 5e-4 {
            true => self.odd(x, y) * gauss,
            false => fifth - fourth,
        };
        Complex::new(re, turned + over_pi * a * odd)
    }

    /// Σ₁, Σ₂ and Σ₄.
    fn about_the_origin(&self, x: f64, y: f64) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for n in (1..=self.terms).rev() {
            let n = f64::from(n);
            let an = self.a * n;
            let below = an * an + y * y;
            let moved = libm::exp(-(an + x) * (an + x)) / below;
            sums[0] += libm::exp(-an * an) / below;
            sums[1] += moved;
            sums[2] += n * moved;
        }
        sums
    }

    /// Σ₃ and Σ₅, about the largest term.
    fn about_the_peak(&self, x: f64, y: f64) -> [f64; 2] {
        let centre = (x / self.a).ceil().max(1.0);
        let mut sums = [0.0; 2];
        for k in (0..=self.terms).rev() {
            for n in [centre + f64::from(k), centre - f64::from(k + 1)] {
                if n < 1.0 {
                    continue;
                }
                let an = self.a * n;
                let term = libm::exp(-(an - x) * (an - x)) / (an * an + y * y);
                sums[0] += term;
                sums[1] += n * term;
            }
        }
        sums
    }

    /// `Σ n e^{−a²n²} 2 sinh(2anx)/d_n` by three terms of sinh.
    fn odd(&self, x: f64, y: f64) -> f64 {
        let term = |n: i32| {
            let n = f64::from(n);
            let an = self.a * n;
            let t = 2.0 * an * x;
            let sinh = 2.0 * t * (1.0 + t * t * (1.0 / 6.0 + t * t / 120.0));
            n * libm::exp(-an * an) / (an * an + y * y) * sinh
        };
        (1..=self.terms).rev().map(term).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two more than reach `tiny`.
    #[test]
    fn numbers_of_terms() {
        assert_eq!([&FULL, &MIDDLE, &ROUGH].map(|s| s.terms), [15, 9, 6]);
    }
}
