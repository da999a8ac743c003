//! Power series with small rational term ratios, in fixed-point arithmetic with one running error
//! bound.
//!
//! # What is summed
//! `P(v) = Σ_{k<n} t_k v^k` with `t_0 = 1`, `t_{k+1} = t_k a_k/b_k` (integers below 2^64) and
//! `v = p + iq`, `|v| ≤ 1`. The imaginary part is kept divided by q: with `v^j = r_j + i q s_j`
//!
//! ```text
//! r_{j+1} = p r_j − q² s_j      s_{j+1} = r_j + p s_j      r_0 = 1, s_0 = 0
//! ```
//!
//! so that nothing cancels however small q is, and only `p` and `q²` are needed. Both parts of
//! every number are integers that count units of 2^-bits.
//!
//! # Order of the work
//! Rectangular splitting (Smith, *Math. Comp.* 52, 1989, 131): the powers up to `v^m`, m about √n,
//! are tabulated; then from the last term down `S_k = v^{k mod m} + (a_k/b_k) S_{k+1}`, with one
//! multiplication by `v^m` whenever k+1 is a multiple of m. Almost all steps cost only products and
//! quotients by one machine word. As many terms as fit are brought to one denominator `Π b_k` of a
//! word, so that one quotient serves them all.
//!
//! Where p and q² are exact and have few digits, powers cost products by these, and m is larger. A
//! block of m terms from index k on enters the sum times `t_k`: it is summed with as many digits
//! fewer as `t_k` is small, in units of `2^-(bits − depth)`.
//!
//! # Error
//! Every rounding (a shift to the left integer, or a quotient truncated) is an error of at most one
//! unit in r or in s. Let `(E, F)` bound the errors of the two parts and D the modulus of the
//! complex error `δr + i q δs`. Inputs carry errors `e_p`, `e_q` of p and q². Writing the
//! recurrences out, with `|r_j| ≤ 1`, `|s_j| ≤ min(j, 1/|q|)` (a geometric sum, `q s_j = Im v^j`):
//!
//! ```text
//! power:     E' = |p| E + q² F + e_p + e_q |s_j| + 1          F' = E + |p| F + e_p |s_j| + 1
//!            D' = |v| D + (e_p + e_q |s_j| + 1) + |q| (e_p |s_j| + 1)
//! term:      E' = ρ E + E_j + 1     F' = ρ F + F_j + 1        D' = ρ D + D_j + 1 + |q|,  ρ = a/b
//! times v^m: E' = E + |q² s_m| F + E_m |R| + G_m |S| + 1   F' = F + |s_m| E + F_m |R| + E_m |S| + 1
//!            D' = D + (E_m |R| + G_m |S| + 1) + |q| (F_m |R| + E_m |S| + 1)
//! ```
//!
//! (R, S the two parts of the partial sum, G_m the error of q² s_m, which is rounded twice.) A power
//! of which fewer digits are taken has `2^-depth` of its error in the larger units, and one rounding
//! more; the errors of a partial sum are multiplied by the ratio of the units of two blocks. E may
//! be replaced by D and F by D/|q| at any time. The first form is good for small q, the second for large q. The bounds are
//! evaluated in `f64` (rescaled where they would overflow): all operands are non-negative, fewer
//! than 2^40 operations are made, each with a relative error of 2^-53, and the stored numbers
//! differ from the exact ones by a relative 10^-5 at most (checked: all errors stay below 10^-5 ·
//! 2^bits), so the final factor 1.001 covers both.

mod depths;
mod errors;
#[cfg(test)]
mod tests;

use crate::{Ball, Mag};
use depths::depths;
use errors::{Bound, Errors, Point};
use rug::{Assign, Float, Integer};

/// Terms with a common denominator, at most.
const GROUP: usize = 12;

/// A product by a short number costs as much less than a full one as these numbers of bits go into
/// the digits.
const CHEAP: f64 = 2600.0;

/// A number as real part and imaginary part divided by q.
struct Pair {
    re: Integer,
    im: Integer,
    errors: Errors,
}

/// `round(x 2^bits)` and its error in units.
fn fixed(x: &Ball, bits: u32) -> Option<(Integer, f64)> {
    let scaled = x.mid().clone() << bits;
    let error = 0.5 + x.rad().shift(i64::from(bits)).to_f64();
    Some((scaled.to_integer()?, error * 1.0001))
}

/// The numbers p and q² in units of `2^-bits`, with what is wrong with them.
struct Factors {
    p: Integer,
    q2: Integer,
    bits: u32,
    errors: [f64; 2],
}

impl Factors {
    /// Returns the exact numbers where they have at most half of `most` bits, and numbers rounded
    /// to `most` bits otherwise.
    fn new(p: &Ball, q2: &Ball, most: u32) -> Option<Factors> {
        let exact = |x: &Ball| match x.rad().is_zero() {
            true => x.mid().to_integer_exp(),
            false => None,
        };
        if most >= MANY
            && let (Some((p, i)), Some((q2, j))) = (exact(p), exact(q2))
        {
            let (i, j) = (trimmed(p, i), trimmed(q2, j));
            let bits = u32::try_from(-i.1.min(j.1).min(0)).ok()?;
            if bits <= most / 2 {
                let [p, q2] = [i, j].map(|(x, e)| x << (e + bits as i32));
                let errors = [0.0; 2];
                return Some(Factors {
                    p,
                    q2,
                    bits,
                    errors,
                });
            }
        }
        let ((p, a), (q2, b)) = (fixed(p, most)?, fixed(q2, most)?);
        Some(Factors {
            p,
            q2,
            bits: most,
            errors: [a, b],
        })
    }

    fn are_short(&self) -> bool {
        self.errors == [0.0; 2]
    }
}

/// The number `x 2^exponent` with an odd x.
fn trimmed(x: Integer, exponent: i32) -> (Integer, i32) {
    match x.find_one(0) {
        Some(zeros) => (x >> zeros, exponent + zeros as i32),
        None => (x, 0),
    }
}

/// A partial sum in units of `2^-(bits − depth)`.
struct Partial {
    re: Integer,
    im: Integer,
    depth: u32,
    bound: Bound,
    /// Memory for products.
    products: [Integer; 2],
}

impl Partial {
    /// Multiplies by `v^m`, which is `top`; `q2s` is q² times its imaginary part.
    fn times_power(&mut self, top: &Pair, q2s: &Integer, m: u64, bits: u32, v: &Point) {
        let bits = bits - self.depth;
        let parts = [&self.re, &self.im];
        let sizes = parts.map(|x| size(x, i64::from(bits) + self.bound.shift));
        let cut;
        let (top_re, top_im, q2s) = match self.depth {
            0 => (&top.re, &top.im, q2s),
            depth => {
                cut = [&top.re, &top.im, q2s].map(|x| Integer::from(x >> depth));
                (&cut[0], &cut[1], &cut[2])
            }
        };
        let [t, u] = &mut self.products;
        t.assign(top_re * &self.re);
        *t -= q2s * &self.im;
        u.assign(top_re * &self.im);
        *u += top_im * &self.re;
        self.re.assign(&*t >> bits);
        self.im.assign(&*u >> bits);
        let errors = top.errors.cut(self.depth, v);
        let roundings = if self.depth == 0 { 1.0 } else { 2.0 };
        let unit = self.bound.unit;
        let bound = self
            .bound
            .e
            .times_power(errors, roundings, m, sizes, v, unit);
        self.bound.set(bound.least(v));
    }

    /// Makes the units smaller.
    fn refine(&mut self, depth: u32) {
        let bits = self.depth - depth;
        self.re <<= bits;
        self.im <<= bits;
        self.depth = depth;
        self.bound.refine(bits);
    }
}

/// Below as many bits a full product is cheap.
pub(super) const MANY: u32 = 1500;
/// `|x| 2^-bits` from above.
fn size(x: &Integer, bits: i64) -> f64 {
    pow2(i64::from(x.significant_bits()) - bits)
}

/// `2^k`; beyond the numbers infinite, below them the least one or the next one up.
fn pow2(k: i64) -> f64 {
    Mag::power_of_two(k).to_f64()
}

/// The real part of the sum and its imaginary part divided by q. `p` and `q2` enclose p and q²,
/// `|p + iq| ≤ 1`: where it certainly is not, the radii are infinite. The truncation after n terms
/// is not included.
pub(super) fn sum(
    p: &Ball,
    q2: &Ball,
    bits: u32,
    n: u64,
    ratio: impl Fn(u64) -> (u64, u64),
) -> (Ball, Ball) {
    sum_checked(p, q2, bits, n, ratio).unwrap_or_else(|| {
        let none = Ball::new(Float::new(64), Mag::INFINITY);
        (none.clone(), none)
    })
}

fn sum_checked(
    p: &Ball,
    q2: &Ball,
    bits: u32,
    n: u64,
    ratio: impl Fn(u64) -> (u64, u64),
) -> Option<(Ball, Ball)> {
    let factors = Factors::new(p, q2, bits)?;
    let v = Point::new(p, q2, factors.errors)?;

    // Powers: as many of m full products as cost as much as those of n/m blocks, which have fewer
    // digits where there are many. Where powers are cheap, there are more of them.
    let spread = match (factors.are_short(), bits >= MANY) {
        (true, _) => 1.4 + f64::from(bits) / CHEAP,
        (false, true) => 0.6,
        (false, false) => 1.4,
    };
    let m = ((n as f64 * spread).sqrt() as u64).max(1);
    let one = Integer::from(1) << bits;
    let mut powers = vec![Pair {
        re: one.clone(),
        im: Integer::new(),
        errors: Errors::default(),
    }];
    for j in 0..m {
        let last = &powers[j as usize];
        let mut re = Integer::from(&factors.p * &last.re);
        re -= &factors.q2 * &last.im;
        re >>= factors.bits;
        let mut im = Integer::from(&factors.p * &last.im);
        im >>= factors.bits;
        im += &last.re;
        let errors = last.errors.next_power(&v, j);
        // Stored powers are near the exact ones.
        if !(errors.largest() < pow2(i64::from(bits) - 17)) {
            return None;
        }
        powers.push(Pair {
            re,
            im,
            errors: errors.least(&v),
        });
    }
    let top = powers.pop()?;
    let q2s = Integer::from(&factors.q2 * &top.im) >> factors.bits;
    let depths = depths(bits, n, m, &ratio);

    // Terms, from the last one down, in groups that share one quotient.
    let mut sum = Partial {
        re: Integer::new(),
        im: Integer::new(),
        depth: depths.last().copied().unwrap_or(0),
        bound: Bound::zero(),
        products: [Integer::new(), Integer::new()],
    };
    let (mut t, mut u, mut cut) = (Integer::new(), Integer::new(), Integer::new());
    let mut end = n;
    while end > 0 {
        if end < n && end.is_multiple_of(m) {
            sum.times_power(&top, &q2s, m, bits, &v);
            sum.refine(depths[(end / m) as usize - 1]);
        }
        // Terms start..end: their coefficients over the common denominator.
        let floor = (end - 1) / m * m;
        // A power of which fewer digits are taken is rounded.
        let (depth, unit) = (sum.depth, sum.bound.unit);
        let units = match depth {
            0 => [1.0; 2],
            _ => [pow2(-i64::from(depth)), 2.0],
        };
        let mut e = sum.bound.e;
        let mut group: [(u64, u64); GROUP] = Default::default();
        let (mut len, mut denominator, mut largest_factor) = (0, 1u64, 1u64);
        while len < GROUP && end - len as u64 > floor {
            let k = end - 1 - len as u64;
            let (a, b) = ratio(k);
            let (Some(x), Some(y)) = (largest_factor.checked_mul(a), denominator.checked_mul(b))
            else {
                break;
            };
            (denominator, largest_factor) = (y, x.max(y));
            group[len] = (a, y);
            len += 1;
            let power = powers[(k % m) as usize].errors;
            e = e.times(a as f64 / b as f64).plus(power, &v, unit, units);
        }
        // The ratios of a group multiply to less than 2^64.
        sum.bound.set(e);
        // S_start D = Σ_j (Π_{i<j} a_i) (Π_{i≥j} b_i) v^j + (Π a_i) S_end
        let mut product = 1u64;
        t.assign(0);
        u.assign(0);
        for (i, (a, below)) in group[..len].iter().enumerate().rev() {
            let power = &powers[((end - 1 - i as u64) % m) as usize];
            let factor = product * below;
            if depth == 0 {
                t += &power.re * factor;
                u += &power.im * factor;
            } else {
                cut.assign(&power.re >> depth);
                t += &cut * factor;
                cut.assign(&power.im >> depth);
                u += &cut * factor;
            }
            product *= a;
        }
        for (s, t) in [(&mut sum.re, &t), (&mut sum.im, &u)] {
            *s *= product;
            *s += t;
            if denominator.is_power_of_two() {
                *s >>= denominator.trailing_zeros();
            } else {
                *s /= denominator;
            }
        }
        end -= len as u64;
    }
    let e = sum.bound.e.least(&v);
    let ball = |x: &Integer, error: f64| enclosed(x, bits, error, sum.bound.shift);
    Some((ball(&sum.re, e.re), ball(&sum.im, e.im)))
}

/// Returns the ball around `x` units of 2^-bits, computed with an error of `error 2^shift` units.
fn enclosed(x: &Integer, bits: u32, error: f64, shift: i64) -> Ball {
    let prec = x.significant_bits().max(64);
    let mid = Float::with_val(prec, x) >> bits;
    Ball::new(
        mid,
        Mag::from_f64(error * 1.001).shift(shift - i64::from(bits)),
    )
}
