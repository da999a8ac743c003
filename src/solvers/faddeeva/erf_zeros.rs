//! Next to the zeros of erf and erfc, where no sum of rounded terms keeps any digits.

use super::constants::TWO_OVER_SQRT_PI;
use super::double_double::{Dd, two_sum};
use super::quadrant::product;
use super::tables::ZEROS;

/// Beyond this distance double-double sums are as good.
const CLOSE: f64 = 1.0 / 131_072.0;

/// The zeros of erf in the first quadrant (DLMF 7.13(i)): real and imaginary part in three `f64` each.
pub(super) const ZEROS_OF_ERF: [[f64; 6]; 14] = [
    [
        1.4506161632436756,
        -2.2956075946245313e-18,
        -6.61384557158455e-35,
        1.8809430001533154,
        -2.005671886543489e-17,
        -8.425540731092386e-34,
    ],
    [
        2.2446592738032467,
        1.786448352259049e-16,
        -7.33926792977074e-33,
        2.6165751406894397,
        -1.0745500990156672e-16,
        5.928755884510105e-33,
    ],
    [
        2.839741046908047,
        -1.179152449607214e-16,
        1.2842540811854887e-33,
        3.175628099643187,
        5.755428756943965e-18,
        8.505653372494661e-35,
    ],
    [
        3.3354607354411554,
        -1.930430627796127e-16,
        -4.8244311502767914e-33,
        3.646174376387361,
        1.722485940424768e-16,
        6.172904903722418e-33,
    ],
    [
        3.7690055670142,
        -2.0002190718725902e-16,
        6.29680663724617e-33,
        4.060697233933303,
        3.623095221906511e-16,
        2.2501426827893454e-32,
    ],
    [
        4.158998399781451,
        -1.394641950625419e-16,
        9.37385176993305e-33,
        4.435571444236523,
        -5.8552248217601e-17,
        2.4103626203836565e-33,
    ],
    [
        4.516319399583918,
        3.3514917244515803e-16,
        1.8336192847990888e-33,
        4.7804476441484285,
        4.937619971557528e-17,
        -2.7537506832783957e-33,
    ],
    [
        4.847970309201611,
        2.4166471271244863e-16,
        -8.263184587326283e-33,
        5.101588043491399,
        8.841430010072586e-17,
        3.525704406770246e-33,
    ],
    [
        5.158767907537576,
        1.7930111287919155e-16,
        1.9217303670677006e-33,
        5.4033326428081825,
        2.8842279761036856e-17,
        1.2513909982601609e-33,
    ],
    [
        5.452192201109879,
        -1.481323374072321e-16,
        -7.40272635729648e-33,
        5.688837437036479,
        3.661134071636588e-16,
        7.738627767907822e-33,
    ],
    [
        5.730853599098436,
        -1.7360503709791132e-16,
        -1.1350637443178674e-32,
        5.960483349074863,
        -5.1123000702946595e-17,
        -4.789171050190213e-34,
    ],
    [
        5.996769280803912,
        3.115930166644623e-16,
        1.9082546090151217e-32,
        6.220119519286596,
        -2.7973988847159334e-16,
        1.0197670003148235e-32,
    ],
    [
        6.251536072381519,
        -3.8467056897489926e-16,
        -1.2498729633143072e-33,
        6.469216313013004,
        3.640861594580844e-16,
        -6.897543140297804e-33,
    ],
    [
        6.496443553395878,
        -4.2387472823259714e-16,
        -2.3809951436405096e-32,
        6.708965932314254,
        -4.002248382994323e-16,
        -1.1436555891335499e-32,
    ],
];

/// `δ + g₂δ² + g₃δ³ + …` with `δ = x + i y − z` and `(n + 1) g_{n+1} = 2 sign (z g_n + g_{n−1})`,
/// `g₀ = 0`, `g₁ = 1`; for `z` given in three parts and δ below [`CLOSE`].
///
/// `g = e^{z²} erf z` obeys `g′ = 2zg + 2/√π` (DLMF 7.10.2 rearranged), w obeys
/// `w′ = −2zw + 2i/√π`: their expansions about zeros, up to the factors `2/√π` and `2i/√π`.
fn expansion(zero: &[f64], sign: f64, x: f64, y: f64) -> Option<(Dd, Dd)> {
    let (zx, zy) = (zero[0], zero[3]);
    if !((x - zx).abs() < CLOSE && (y - zy).abs() < CLOSE) {
        return None;
    }
    let difference = |x: f64, at: usize| {
        let s = two_sum(x, -zero[at]);
        s.add_f(-zero[at + 1]).add_f(-zero[at + 2])
    };
    let (p, q) = (difference(x, 0), difference(y, 3));
    let (dx, dy) = (p.hi, q.hi);
    // Σ_{n≥3} g_n δⁿ⁻³, the coefficients going up, the powers too.
    let times = |(a, b): (f64, f64), (c, d): (f64, f64)| (a * c - b * d, a * d + b * c);
    let (z, delta) = ((zx, zy), (dx, dy));
    let (mut before, mut here) = ((1.0, 0.0), (sign * zx, sign * zy));
    let (mut power, mut sum) = ((1.0, 0.0), (0.0, 0.0));
    let mut n = 2;
    while n < 8 {
        let (c, d) = times(z, here);
        let f = 2.0 * sign / (n + 1) as f64;
        let next = (f * (c + before.0), f * (d + before.1));
        let (a, b) = times(next, power);
        sum = (sum.0 + a, sum.1 + b);
        (before, here) = (here, next);
        power = times(power, delta);
        n += 1;
    }
    // z δ² with all digits.
    let z = (Dd::new(zx, zero[1]), Dd::new(zy, zero[4]));
    let (a, b, _) = product((p, q), (p, q));
    let square = (a.hi, b.hi);
    let (a, b, _) = product((a, b), z);
    let (c, d) = times(times(square, delta), sum);
    let by = |t: Dd| if sign < 0.0 { -t } else { t };
    Some((p + by(a).add_f(c), q + by(b).add_f(d)))
}

/// `erf(z)/e^{−z²}` next to a zero of erf in the first quadrant.
pub(super) fn near_zero_of_erf(x: f64, y: f64) -> Option<(Dd, Dd)> {
    let (u, v) = ZEROS_OF_ERF.iter().find_map(|z| expansion(z, 1.0, x, y))?;
    Some((u * TWO_OVER_SQRT_PI, v * TWO_OVER_SQRT_PI))
}

/// `erfc(−z)/e^{−z²}`, `z = x + i y` in the first quadrant, next to a zero: `w(−iz) = w(y − ix)`.
pub(super) fn near_zero_of_erfc(x: f64, y: f64) -> Option<(Dd, Dd)> {
    let (u, v) = ZEROS
        .iter()
        .find_map(|z| expansion(&z.0[..6], -1.0, y, -x))?;
    Some((-(v * TWO_OVER_SQRT_PI), u * TWO_OVER_SQRT_PI))
}
