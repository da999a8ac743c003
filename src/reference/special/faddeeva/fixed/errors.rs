//! The recurrences of the error bounds, in units of the last place.

use super::pow2;
use crate::Ball;

/// Error bounds beyond this are kept as multiples of it.
const STEP: i64 = 512;
/// `2^STEP`.
const LARGE: f64 = f64::from_bits(((1023 + STEP) as u64) << 52);
/// `2^-(STEP/2)`
const SMALL: f64 = f64::from_bits(((1023 - STEP / 2) as u64) << 52);

/// Error bounds of one number: of its real part, of its imaginary part divided by q, of its
/// modulus.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Errors {
    pub re: f64,
    pub im: f64,
    pub both: f64,
}

/// Sizes of `v = p + iq`, and what is wrong with p and q² as they are stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// |p| from above.
    pub p: f64,
    /// q² from above.
    pub q2: f64,
    /// |q| from above.
    pub q: f64,
    /// |q| from below.
    pub low: f64,
    /// |v| from above.
    pub modulus: f64,
    /// Of p, in units.
    pub error_p: f64,
    /// Of q², in units.
    pub error_q2: f64,
}

impl Point {
    /// Of p and q² with the errors of what is stored of them; `None` where `|v| ≤ 1` is not
    /// possible, or a size is none.
    pub fn new(p: &Ball, q2: &Ball, [error_p, error_q2]: [f64; 2]) -> Option<Point> {
        let pm = p.magnitude().to_f64();
        let qq = q2.magnitude().to_f64();
        let q = qq.sqrt();
        let low = q2.mignitude().to_f64();
        let low = if low > 1e-300 {
            low.sqrt() * 0.9999
        } else {
            0.0
        };
        let modulus = pm.hypot(q).min(1.0) * 1.0001;
        if !(pm.is_finite() && qq.is_finite()) {
            return None;
        }
        // The error bounds hold for |v| ≤ 1 only.
        if (p.with_prec(64).square() + q2.with_prec(64)).lower() > 1 {
            return None;
        }
        Some(Point {
            p: pm,
            q2: qq,
            q,
            low,
            modulus,
            error_p,
            error_q2,
        })
    }

    /// `|s_j| ≤ min(j, 1/|q|)`.
    pub fn s(&self, j: u64) -> f64 {
        let j = j as f64;
        if j * self.low > 1.0 {
            1.0 / self.low
        } else {
            j
        }
    }
}

impl Errors {
    /// The better of the two forms.
    #[inline]
    pub fn least(mut self, v: &Point) -> Errors {
        self.re = self.re.min(self.both);
        if self.im * v.low > self.both {
            self.im = self.both / v.low;
        }
        self
    }

    #[inline]
    pub fn times(self, rho: f64) -> Errors {
        Errors {
            re: self.re * rho,
            im: self.im * rho,
            both: self.both * rho,
        }
    }

    #[inline]
    pub fn largest(self) -> f64 {
        self.re.max(self.im).max(self.both)
    }

    /// Of `v^{j+1}` from those of `v^j`.
    #[inline]
    pub fn next_power(self, v: &Point, j: u64) -> Errors {
        let s = v.s(j);
        let a = v.error_p + v.error_q2 * s + 1.0;
        let b = v.error_p * s + 1.0;
        Errors {
            re: v.p * self.re + v.q2 * self.im + a,
            im: self.re + v.p * self.im + b,
            both: v.modulus * self.both + a + v.q * b,
        }
    }

    /// With a power added and both parts rounded; one unit is `unit` of those the bounds are in. The
    /// power was stored in units of which `less` is one of these, and `roundings` are made.
    #[inline]
    pub fn plus(self, power: Errors, v: &Point, unit: f64, [less, roundings]: [f64; 2]) -> Errors {
        Errors {
            re: self.re + (power.re * less + roundings) * unit,
            im: self.im + (power.im * less + roundings) * unit,
            both: self.both + (power.both * less + roundings + v.q * roundings) * unit,
        }
    }

    /// Of a number of which the last `depth` bits are cut off, in the units that are left.
    #[inline]
    pub fn cut(self, depth: u32, v: &Point) -> Errors {
        match depth {
            0 => self,
            _ => Errors::default().plus(self, v, 1.0, [pow2(-i64::from(depth)), 1.0]),
        }
    }

    /// Of a partial sum with parts of these sizes times `v^m`, whose errors are `top`; its product
    /// with q² was rounded `roundings` times.
    #[inline]
    pub fn times_power(
        self,
        top: Errors,
        roundings: f64,
        m: u64,
        [r, s]: [f64; 2],
        v: &Point,
        unit: f64,
    ) -> Errors {
        let s_m = v.s(m);
        // Of q² s_m, and its size: |q| |Im v^m|.
        let g_m = v.q2 * top.im + v.error_q2 * s_m + roundings;
        let size = (v.q2 * s_m).min(v.q);
        let a = top.re * r + g_m * s + unit;
        let b = top.im * r + top.re * s + unit;
        Errors {
            re: self.re + size * self.im + a,
            im: self.im + s_m * self.re + b,
            both: self.both + a + v.q * b,
        }
    }
}

/// A bound of an error: a multiple of `2^shift` units, so that it stays a number.
pub(super) struct Bound {
    pub e: Errors,
    pub shift: i64,
    /// One unit in these multiples.
    pub unit: f64,
}

impl Bound {
    /// The bound of an exact number.
    pub fn zero() -> Bound {
        Bound {
            e: Errors::default(),
            shift: 0,
            unit: 1.0,
        }
    }

    /// Sets the bound, in the multiples that stay in the range of numbers.
    pub fn set(&mut self, e: Errors) {
        self.e = e;
        let largest = e.largest();
        if largest > LARGE {
            self.scale(STEP);
        } else if self.shift > 0 && largest < SMALL {
            self.scale(-STEP);
        }
    }

    fn scale(&mut self, by: i64) {
        self.e = self.e.times(pow2(-by));
        self.shift += by;
        self.unit = pow2(-self.shift);
    }

    /// Units become smaller by `2^bits`.
    pub fn refine(&mut self, bits: u32) {
        for done in (0..bits).step_by(STEP as usize / 2) {
            let step = (bits - done).min(STEP as u32 / 2);
            self.set(self.e.times(pow2(i64::from(step))));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mag;

    const V: Point = Point {
        p: 0.5,
        q2: 0.0625,
        q: 0.25,
        low: 0.125,
        modulus: 0.75,
        error_p: 3.0,
        error_q2: 5.0,
    };
    const E: Errors = Errors {
        re: 8.0,
        im: 16.0,
        both: 32.0,
    };

    fn is(found: Errors, re: f64, im: f64, both: f64) {
        assert_eq!(found, Errors { re, im, both });
    }

    /// `E' = |p|E + q²F + e_p + e_q|s_j| + 1` and so on, s_2 = 2.
    #[test]
    fn of_the_next_power() {
        is(
            E.next_power(&V, 2),
            4.0 + 1.0 + 3.0 + 10.0 + 1.0,
            8.0 + 8.0 + 6.0 + 1.0,
            24.0 + 14.0 + 0.25 * 7.0,
        );
        // s_j is at most 1/|q|.
        is(
            E.next_power(&V, 100),
            5.0 + 44.0,
            16.0 + 25.0,
            24.0 + 44.0 + 6.25,
        );
        assert_eq!([0, 7, 8, 9].map(|j| V.s(j)), [0.0, 7.0, 8.0, 8.0]);
    }

    #[test]
    fn with_a_power_added() {
        let power = Errors {
            re: 1.0,
            im: 2.0,
            both: 4.0,
        };
        is(E.plus(power, &V, 1.0, [1.0; 2]), 10.0, 19.0, 37.25);
        is(E.plus(power, &V, 0.5, [1.0; 2]), 9.0, 17.5, 34.625);
        is(E.plus(power, &V, 1.0, [0.5, 2.0]), 10.5, 19.0, 36.5);
    }

    /// s_4 = 4; G_4 = q² F_4 + e_q s_4 + 2 = 22.125; |q² s_4| = 0.25, which is |q|.
    #[test]
    fn times_the_highest_power() {
        let top = Errors {
            re: 1.0,
            im: 2.0,
            both: 4.0,
        };
        let (a, b) = (10.0 + 22.125 * 100.0 + 1.0, 20.0 + 100.0 + 1.0);
        is(
            E.times_power(top, 2.0, 4, [10.0, 100.0], &V, 1.0),
            8.0 + 4.0 + a,
            16.0 + 32.0 + b,
            32.0 + a + 0.25 * b,
        );
        // s_2 = 2, |q² s_2| = 0.125; s_8 = 8, |q² s_8| is no more than |q|.
        let none = Errors::default();
        is(
            E.times_power(none, 1.0, 2, [0.0, 1.0], &V, 0.5),
            10.0 + 11.5,
            32.5,
            32.0 + 11.5 + 0.125,
        );
        is(
            E.times_power(none, 1.0, 8, [0.0; 2], &V, 0.5),
            12.5,
            80.5,
            32.625,
        );
    }

    #[test]
    fn of_fewer_digits() {
        is(E.cut(3, &V), 2.0, 3.0, 5.25);
        is(E.cut(0, &V), 8.0, 16.0, 32.0);
    }

    /// Bounds stay within the range of numbers when units become smaller, and so do the multiples
    /// when the bounds fall again.
    #[test]
    fn in_smaller_units() {
        let mut bound = Bound::zero();
        bound.set(E);
        bound.refine(1700);
        assert_eq!((bound.shift, bound.unit), (1536, pow2(-1536)));
        is(bound.e.times(pow2(-164)), 8.0, 16.0, 32.0);
        for (shift, unit) in [(1024, pow2(-1024)), (512, pow2(-512)), (0, 1.0), (0, 1.0)] {
            bound.set(bound.e.times(pow2(-500)));
            assert_eq!((bound.shift, bound.unit), (shift, unit));
        }
        is(bound.e.times(pow2(300)), 8.0, 16.0, 32.0);
    }

    #[test]
    fn the_better_of_two_forms() {
        // D bounds E, and D/|q| bounds F.
        let e = |re, im, both| Errors { re, im, both }.least(&V);
        is(e(8.0, 16.0, 4.0), 4.0, 16.0, 4.0);
        is(e(8.0, 100.0, 4.0), 4.0, 32.0, 4.0);
        is(e(3.0, 100.0, 32.0), 3.0, 100.0, 32.0);
        is(E.times(0.25), 2.0, 4.0, 8.0);
        let largest = |re, im, both| Errors { re, im, both }.largest();
        assert_eq!(
            [
                largest(3.0, 2.0, 1.0),
                largest(2.0, 3.0, 1.0),
                largest(1.0, 2.0, 3.0)
            ],
            [3.0; 3]
        );
    }

    #[test]
    fn sizes_of_a_point() {
        let ball = |x: f64, r: f64| Ball::exact(64, x).widened(Mag::from_f64(r));
        let v = Point::new(&ball(-0.5, 0.25), &ball(0.25, 0.125), [1.0, 2.0]).expect("a point");
        let above = |x: f64, due: f64| assert!(x >= due && x <= due * 1.0002, "{x} {due}");
        above(v.p, 0.75);
        above(v.q2, 0.375);
        above(v.q, 0.375f64.sqrt());
        above(v.modulus, 0.9375f64.sqrt());
        assert!(v.modulus > 1.00005 * 0.9375f64.sqrt());
        above(0.125f64.sqrt(), v.low);
        assert!(v.low < 0.99995 * 0.125f64.sqrt());
        assert_eq!((v.error_p, v.error_q2), (1.0, 2.0));
        // The modulus is at most one, q may be zero.
        let v = Point::new(&ball(0.9, 0.05), &ball(0.1, 0.2), [0.0; 2]).expect("a point");
        above(v.modulus, 1.0);
        assert_eq!(v.low, 0.0);
        let wide = Ball::exact(64, 0.0).widened(Mag::INFINITY);
        assert!(Point::new(&wide, &ball(0.1, 0.0), [0.0; 2]).is_none());
        assert!(Point::new(&ball(0.1, 0.0), &wide, [0.0; 2]).is_none());
    }
}
