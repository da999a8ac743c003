//! R. J. Wells, JQSRT 62 (1999) 29–48, `HUMLIK`: Humlíček's w4 and twelve poles with borders that a wanted number
//! R of digits moves, and one pole beyond `|x| + y = R₀`; here R = 4, R₀ = 146.7, R₁ = 14.67.

use crate::algorithm::{Algorithm, Parts, Plane};
use crate::elementary::{horner, quotient};
use crate::humlicek_1979::twelve_poles;
use num_complex::{Complex, Complex64};

/// The algorithm.
pub const ALGORITHMS: [Algorithm; 1] = [Algorithm {
    name: "wells-1999-r4",
    title: "Wells' HUMLIK, R = 4: borders by the digits wanted",
    source: "R. J. Wells, JQSRT 62 (1999) 29-48",
    read_from: "the subroutine in double precision as F. Niro's CompAbs carries it, borders for both parts; region 3 is \
                w4's, whose expanded polynomials it prints",
    plane: Plane::Upper,
    parts: Parts::Both,
    w: humlik,
    single: None,
    formula: Some(region),
}];

const R0: f64 = 146.7;
const R1: f64 = 14.67;
const FRAC_1_SQRT_PI: f64 = 0.56418958;

fn region(z: Complex64) -> u8 {
    let (x, y) = (z.re.abs(), z.im);
    // Below 1e-6 the paper avoids w4's outer regions.
    let (one, two) = match y <= 1e-6 {
        true => (R0 - y, R0 - y),
        false => (R1 - y, 6.8 - y),
    };
    match x {
        x if x > R0 - y => 0,
        x if x > one => 1,
        x if x > two => 2,
        x if x < 3.097 * y - 0.45 => 3,
        x if x <= 18.1 * y + 1.65 => 4,
        _ => 5,
    }
}

fn humlik(z: Complex64) -> Complex64 {
    let (x, y) = (z.re, z.im);
    let t = Complex::new(y, -x);
    let u = t * t;
    match region(z) {
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
