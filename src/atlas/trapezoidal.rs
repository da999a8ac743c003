//! The trapezoidal rule for `w(z) = (i/π) ∫ e^{−t²}/(z − t) dt` with what the pole at z leaves:
//! `w ≈ (2ihz/π) Σ e^{−t²}/(z² − t²)` over `t = h/2, 3h/2, …` (midpoints), or `t = h, 2h, …` and
//! `(ih/π)/z`; where z is below `π/h`, besides `2e^{−z²}/(1 ± e^{−2πiz/h})`.
//!
//! F. Matta, A. Reichel, Math. Comp. 25 (1971) 339–344 take the multiples of h everywhere, whose
//! pole's term and whose sum cancel beside each node. D. B. Hunter, T. Regan, Math. Comp. 26 (1972)
//! 539–541 change between the two rules by the distance of the pole from the nodes. M. Al Azah, S.
//! N. Chandler-Wilde, SIAM J. Numer. Anal. 59 (2021) 2346–2367 prove `|w − w_N| ≤ 0.7 e^{−πN}` for
//! `h = √(π/(N+1))` and their choice of the rule.

use crate::algorithm::{Algorithm, UPPER, WHOLE};
use crate::elementary::{continued_below, exp, gaussian, mirrored, quotient, times_i};
use num_complex::{Complex, Complex64};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// h = 1/2 and twelve terms.
pub const MATTA_REICHEL: [Algorithm; 1] = [Algorithm {
    name: "matta-reichel-1971",
    title: "Trapezoidal rule with the pole's term, h = 1/2, 12 terms",
    source: "F. Matta, A. Reichel, Math. Comp. 25 (1971) 339-344",
    read_from: "K. Eriksson's function of 1981 in public codes of stellar atmospheres, which has the real part: its step, its twelve \
                terms, the pole's term for Im z <= 2 pi; the imaginary part by the same formula",
    w: matta_reichel,
    formula: Some(|z| u8::from(z.im > PI / HALF.h)),
    ..UPPER
}];

/// The step and the number of terms of Matta and Reichel's.
pub const HUNTER_REGAN: [Algorithm; 1] = [Algorithm {
    name: "hunter-regan-1972",
    title: "Trapezoidal rule with pole correction, h = 1/2, 12 terms",
    source: "D. B. Hunter, T. Regan, Math. Comp. 26 (1972) 539-541, after F. Matta and A. Reichel 1971",
    read_from: "the formulas, derived at the head of the file; h and the number of terms as matta-reichel-1971: e^(-(pi/h)²) = 7e-18",
    w: hunter_regan,
    formula: Some(formula_of_hunter_regan),
    ..WHOLE
}];

/// N = 11.
pub const AL_AZAH_CHANDLER_WILDE: [Algorithm; 1] = [Algorithm {
    name: "al-azah-chandler-wilde-2021",
    title: "Modified trapezoidal rules, N = 11",
    source: "M. Al Azah, S. N. Chandler-Wilde, SIAM J. Numer. Anal. 59 (2021) 2346-2367",
    read_from: "the authors' wTrap.m and wTrapWCP.m; the pole's term as 2e^(-z²)/(…), because e^(z²), by which the program \
                divides, overflows from Re z = 26.7 on",
    w: w_11,
    formula: Some(|z| N11.choice(quadrant(z))),
    ..WHOLE
}];

/// A rule with its nodes.
struct Rule {
    h: f64,
    /// `t²` and `e^{−t²}` of midpoints and of multiples of h, the largest first.
    midpoints: Vec<[f64; 2]>,
    multiples: Vec<[f64; 2]>,
}

static N11: LazyLock<Rule> = LazyLock::new(|| Rule::new((PI / 12.0).sqrt(), 11));
static HALF: LazyLock<Rule> = LazyLock::new(|| Rule::new(0.5, 12));

fn quadrant(z: Complex64) -> Complex64 {
    Complex::new(z.re.abs(), z.im.abs())
}

fn formula_of_hunter_regan(z: Complex64) -> u8 {
    let z = quadrant(z);
    HALF.rule(z) + 2 * u8::from(z.im >= PI / HALF.h)
}

fn matta_reichel(z: Complex64) -> Complex64 {
    mirrored(z, |z| {
        let sum = HALF.by_multiples(z);
        match z.im > PI / HALF.h {
            true => sum,
            false => sum + HALF.pole(z, -1.0),
        }
    })
}

fn hunter_regan(z: Complex64) -> Complex64 {
    let first = |z: Complex64| match formula_of_hunter_regan(z) {
        2 | 3 => HALF.by_midpoints(z),
        1 => HALF.by_multiples(z) + HALF.pole(z, -1.0),
        _ => HALF.by_midpoints(z) + HALF.pole(z, 1.0),
    };
    continued_below(z, |z| mirrored(z, first))
}

fn w_11(z: Complex64) -> Complex64 {
    let first = |z: Complex64| match N11.choice(z) {
        0 => N11.by_midpoints(z),
        1 => N11.by_multiples(z) + N11.pole(z, -1.0),
        _ => N11.by_midpoints(z) + N11.pole(z, 1.0),
    };
    continued_below(z, |z| mirrored(z, first))
}

impl Rule {
    fn new(h: f64, terms: usize) -> Rule {
        let node = |t: f64| [t * t, libm::exp(-t * t)];
        Rule {
            h,
            midpoints: (0..=terms)
                .rev()
                .map(|k| node(h * (k as f64 + 0.5)))
                .collect(),
            multiples: (1..=terms).rev().map(|k| node(h * k as f64)).collect(),
        }
    }

    /// 1 for multiples of h, which lie farther from Re z than a quarter of h; 0 for midpoints.
    fn rule(&self, z: Complex64) -> u8 {
        let place = z.re / self.h;
        u8::from((place - place.floor() - 0.5).abs() <= 0.25)
    }

    /// That of Al Azah and Chandler-Wilde: 0 midpoints alone, 1 multiples, 2 midpoints, both
    /// corrected.
    fn choice(&self, z: Complex64) -> u8 {
        if z.im >= z.re.max(PI / self.h) {
            0
        } else if z.im < z.re && self.rule(z) == 1 {
            1
        } else {
            2
        }
    }

    fn sum(&self, z: Complex64, nodes: &[[f64; 2]]) -> Complex64 {
        let z2 = z * z;
        let terms = nodes
            .iter()
            .map(|[t2, e]| quotient(Complex::new(*e, 0.0), z2 - t2));
        times_i(z * (2.0 * self.h / PI)) * terms.sum::<Complex64>()
    }

    fn by_midpoints(&self, z: Complex64) -> Complex64 {
        self.sum(z, &self.midpoints)
    }

    fn by_multiples(&self, z: Complex64) -> Complex64 {
        quotient(Complex::new(0.0, self.h / PI), z) + self.sum(z, &self.multiples)
    }

    /// `2e^{−z²}/(1 ± e^{−2πiz/h})`.
    fn pole(&self, z: Complex64, sign: f64) -> Complex64 {
        let turns = Complex::new(z.im, -z.re) * (2.0 * PI / self.h);
        // Nothing is left of it, and the exponential may overflow.
        if turns.re > 700.0 {
            return Complex::new(0.0, 0.0);
        }
        quotient(2.0 * gaussian(z), 1.0 + sign * exp(turns))
    }
}
