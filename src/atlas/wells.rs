//! R. J. Wells, JQSRT 62 (1999) 29–48, `HUMLIK`: Humlíček's w4 and twelve poles with borders that a
//! wanted number R of digits moves, 2 ≤ R ≤ 5, and one pole beyond `|x| + y = R₀`:
//! `R₀ = 1.51 e^{1.144 R}`, `R₁ = 1.60 e^{0.554 R}`.

use crate::algorithm::{Algorithm, UPPER};
use crate::elementary::quotient;
use crate::humlicek_1979::twelve_poles;
use crate::humlicek_1982::five_poles;
use num_complex::{Complex, Complex64};
use std::sync::LazyLock;

const SOURCE: &str = "R. J. Wells, JQSRT 62 (1999) 29-48";
const READ: &str = "the subroutine in double precision as F. Niro's CompAbs carries it, R = 4, and ROOT's TMath::Voigt, 2 <= R <= 5; \
                    borders for both parts; region 3 is w4's, whose expanded polynomials they print";

const fn digits<const R: usize>(name: &'static str, title: &'static str) -> Algorithm {
    Algorithm {
        name,
        title,
        source: SOURCE,
        read_from: READ,
        w: humlik::<R>,
        formula: Some(region::<R>),
        ..UPPER
    }
}

/// For 2 to 5 digits.
pub const ALGORITHMS: [Algorithm; 4] = [
    digits::<2>("wells-1999-r2", "Wells' HUMLIK, R = 2"),
    digits::<3>("wells-1999-r3", "Wells' HUMLIK, R = 3"),
    digits::<4>(
        "wells-1999-r4",
        "Wells' HUMLIK, R = 4: borders by the digits wanted (ROOT's default)",
    ),
    digits::<5>("wells-1999-r5", "Wells' HUMLIK, R = 5"),
];

/// R₀ and R₁ of 2 to 5 digits.
static BORDERS: LazyLock<[[f64; 2]; 4]> = LazyLock::new(|| {
    [2.0, 3.0, 4.0, 5.0].map(|r| [1.51 * libm::exp(1.144 * r), 1.60 * libm::exp(0.554 * r)])
});

const FRAC_1_SQRT_PI: f64 = 0.56418958;

fn region<const R: usize>(z: Complex64) -> u8 {
    let [r0, r1] = BORDERS[R - 2];
    let (x, y) = (z.re.abs(), z.im);
    // Below 1e-6 the paper avoids w4's outer regions.
    let (one, two) = match y <= 1e-6 {
        true => (r0 - y, r0 - y),
        false => (r1 - y, 6.8 - y),
    };
    match x {
        x if x > r0 - y => 0,
        x if x > one => 1,
        x if x > two => 2,
        x if x < 3.097 * y - 0.45 => 3,
        x if x <= 18.1 * y + 1.65 => 4,
        _ => 5,
    }
}

fn humlik<const R: usize>(z: Complex64) -> Complex64 {
    let (x, y) = (z.re, z.im);
    let t = Complex::new(y, -x);
    let u = t * t;
    match region::<R>(z) {
        0 => {
            let k = y * FRAC_1_SQRT_PI / (x * x + y * y);
            Complex::new(k, k * x / y)
        }
        1 => quotient(t * FRAC_1_SQRT_PI, u + 0.5),
        2 => quotient(t * (u + 2.5) * FRAC_1_SQRT_PI, u * (u + 3.0) + 0.75),
        3 => five_poles(t),
        4 => twelve_poles(z, false),
        // Where |x| ≥ 12 the exponential is below 1e-62 of the sum.
        _ => twelve_poles(z, true),
    }
}
