//! R. J. Wells, JQSRT 62 (1999) 29–48, `HUMLIK`: Humlíček's w4 and twelve poles with borders that a wanted number
//! R of digits moves, 2 ≤ R ≤ 5, and one pole beyond `|x| + y = R₀`: `R₀ = 1.51 e^{1.144 R}`, `R₁ = 1.60 e^{0.554 R}`.

use crate::algorithm::{Algorithm, Parts, Plane};
use crate::elementary::{horner, quotient};
use crate::humlicek_1979::twelve_poles;
use num_complex::{Complex, Complex64};
use std::sync::LazyLock;

const SOURCE: &str = "R. J. Wells, JQSRT 62 (1999) 29-48";
const READ: &str = "the subroutine in double precision as F. Niro's CompAbs carries it, R = 4, and ROOT's TMath::Voigt, 2 <= R <= 5; \
                    borders for both parts; region 3 is w4's, whose expanded polynomials they print";

const fn digits(
    name: &'static str,
    title: &'static str,
    w: fn(Complex64) -> Complex64,
    formula: fn(Complex64) -> u8,
) -> Algorithm {
    Algorithm {
        name,
        title,
        source: SOURCE,
        read_from: READ,
        plane: Plane::Upper,
        parts: Parts::Both,
        w,
        single: None,
        formula: Some(formula),
    }
}

/// For 2 to 5 digits.
pub const ALGORITHMS: [Algorithm; 4] = [
    digits(
        "wells-1999-r2",
        "Wells' HUMLIK, R = 2",
        |z| humlik(z, &TWO),
        |z| region(z, &TWO),
    ),
    digits(
        "wells-1999-r3",
        "Wells' HUMLIK, R = 3",
        |z| humlik(z, &THREE),
        |z| region(z, &THREE),
    ),
    digits(
        "wells-1999-r4",
        "Wells' HUMLIK, R = 4: borders by the digits wanted (ROOT's default)",
        |z| humlik(z, &FOUR),
        |z| region(z, &FOUR),
    ),
    digits(
        "wells-1999-r5",
        "Wells' HUMLIK, R = 5",
        |z| humlik(z, &FIVE),
        |z| region(z, &FIVE),
    ),
];

/// R₀ and R₁.
struct Borders([f64; 2]);

static TWO: LazyLock<Borders> = LazyLock::new(|| Borders::of(2.0));
static THREE: LazyLock<Borders> = LazyLock::new(|| Borders::of(3.0));
static FOUR: LazyLock<Borders> = LazyLock::new(|| Borders::of(4.0));
static FIVE: LazyLock<Borders> = LazyLock::new(|| Borders::of(5.0));

impl Borders {
    fn of(r: f64) -> Borders {
        Borders([1.51 * libm::exp(1.144 * r), 1.60 * libm::exp(0.554 * r)])
    }
}

const FRAC_1_SQRT_PI: f64 = 0.56418958;

fn region(z: Complex64, Borders([r0, r1]): &Borders) -> u8 {
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

fn humlik(z: Complex64, borders: &Borders) -> Complex64 {
    let (x, y) = (z.re, z.im);
    let t = Complex::new(y, -x);
    let u = t * t;
    match region(z, borders) {
        0 => {
            let k = y * FRAC_1_SQRT_PI / (x * x + y * y);
            Complex::new(k, k * x / y)
        }
        1 => quotient(t * FRAC_1_SQRT_PI, u + 0.5),
        2 => quotient(t * (u + 2.5) * FRAC_1_SQRT_PI, u * (u + 3.0) + 0.75),
        3 => quotient(
            horner(t, &[0.5642236, 3.778987, 11.96482, 20.20933, 16.4955]),
            horner(t, &[1.0, 6.699398, 21.69274, 39.27121, 38.82363, 16.4955]),
        ),
        4 => twelve_poles(z, false),
        // Where |x| ≥ 12 the exponential is below 1e-62 of the sum.
        _ => twelve_poles(z, true),
    }
}
