//! A type of number for the solver's generic code: each operation is written on a tape.

use crate::evaluation::here;
pub(crate) use crate::evaluation::{Constant, Result, Rounding, Setting, Tracked, evaluate};
use crate::exact::Exact;
use crate::grid::{grain_of, power_of_two};
use crate::interval::{Interval, sum_up};
use crate::program::tape::Op;
use mechaudit_solvers::faddeeva::proof::{ROUND, Real, Vectors};
use std::ops::{Add, Div, Mul, Neg, Sub};

impl Tracked {
    /// Coordinate `i` of the rectangle, any `f64` between the ends.
    pub fn input(i: usize, [lo, hi]: [f64; 2]) -> Tracked {
        let least = Interval::new(lo, hi).mignitude();
        Tracked::input_on_grid(i, [lo, hi], grain_of(least))
    }

    /// Coordinate `i`, any multiple of `2^grain` between the ends.
    pub fn input_on_grid(i: usize, [lo, hi]: [f64; 2], grain: i32) -> Tracked {
        let exact = match lo == hi {
            true => Exact::point(lo),
            false => Exact::coordinate(Interval::new(lo, hi), i),
        };
        Tracked::any(exact, grain)
    }

    /// The small coordinate.
    pub fn sigma() -> Tracked {
        here(|e| {
            let grain = grain_of(e.solver().sigma.range.lo);
            e.enter(Exact::point(1.0), grain, true)
        })
    }

    /// A coordinate's distance from a centre, which the code computes without rounding: a multiple
    /// of `2^grain`.
    pub fn offset(self, centre: f64, grain: i32) -> Tracked {
        here(|e| {
            let exact = e.solver().exact[self.place()] + Exact::point(-centre);
            e.enter(exact, grain, false)
        })
    }

    /// A table's entry, which stands for itself.
    pub fn entry(x: f64) -> Tracked {
        here(|e| e.point(x))
    }

    /// Any multiple of `2^grain` that is enclosed.
    pub fn any(exact: Exact, grain: i32) -> Tracked {
        here(|e| e.enter(exact, grain, false))
    }

    pub fn result(self) -> Result {
        here(|e| e.result(self))
    }

    /// The sum of two numbers, not rounded.
    pub fn exact_sum(self, other: Tracked) -> Result {
        here(|e| {
            let sum = e.exact_sum(self, other);
            e.result(sum)
        })
    }

    /// The number, if it is the same all over the box.
    pub fn constant(self) -> Option<f64> {
        here(|e| e.constant(self))
    }
}

impl Add for Tracked {
    type Output = Tracked;
    fn add(self, other: Tracked) -> Tracked {
        here(|e| e.add(self, other))
    }
}

impl Neg for Tracked {
    type Output = Tracked;
    fn neg(self) -> Tracked {
        here(|e| e.push(Op::Neg(self.place())))
    }
}

impl Sub for Tracked {
    type Output = Tracked;
    fn sub(self, other: Tracked) -> Tracked {
        self + -other
    }
}

impl Mul for Tracked {
    type Output = Tracked;
    fn mul(self, other: Tracked) -> Tracked {
        here(|e| e.multiply(self, other))
    }
}

impl Div for Tracked {
    type Output = Tracked;
    fn div(self, other: Tracked) -> Tracked {
        here(|e| e.divide(self, other))
    }
}

impl Real for Tracked {
    type Mask = bool;

    fn like(self, x: f64) -> Tracked {
        here(|e| e.stored(x))
    }

    fn fma(self, b: Tracked, c: Tracked) -> Tracked {
        here(|e| e.fma(self, b, c))
    }

    fn two_sum(self, b: Tracked) -> (Tracked, Tracked) {
        here(|e| e.two_sum(self, b))
    }

    fn fast_two_sum(self, b: Tracked) -> (Tracked, Tracked) {
        let exact = here(|e| {
            let (p, q) = (e.range(self), e.range(b));
            p.is_zero() || p.mignitude() >= q.magnitude()
        });
        if exact {
            return self.two_sum(b);
        }
        let s = self + b;
        (s, b - (s - self))
    }

    fn two_prod(self, b: Tracked) -> (Tracked, Tracked) {
        if here(|e| e.rounding.fma_rounds_twice) {
            let p = self * b;
            return (p, self.fma(b, -p));
        }
        here(|e| e.two_prod(self, b))
    }

    fn magnitude(self) -> Tracked {
        // The number computed and the one it stands for may have different signs.
        let sign = here(|e| {
            let (range, exact) = (e.range(self), e.solver().exact[self.place()].range);
            let (lo, hi) = (range.lo.min(exact.lo), range.hi.max(exact.hi));
            (lo >= 0.0, hi <= 0.0)
        });
        match sign {
            (true, _) => self,
            (_, true) => -self,
            _ => here(|e| e.push(Op::Abs(self.place()))),
        }
    }

    fn at_least(self, low: Tracked) -> Tracked {
        if self.below(low) { low } else { self }
    }

    fn at_most(self, high: Tracked) -> Tracked {
        if high.below(self) { high } else { self }
    }

    fn raised(self, least: f64) -> Tracked {
        here(|e| {
            let lo = e.range(self).lo;
            if lo >= least {
                return self;
            }
            // Between 0 and `least − lo` is added; nothing is rounded.
            let plain = e.plain(self);
            e.push(Op::Near(plain.place(), sum_up(least, (-lo).max(0.0))))
        })
    }

    fn below(self, other: Tracked) -> bool {
        here(|e| e.below(self, other))
    }

    fn or(self, a: bool, b: bool) -> bool {
        a | b
    }

    fn pick(self, mask: bool, yes: Tracked, no: Tracked) -> Tracked {
        if mask { yes } else { no }
    }

    fn all(self, mask: bool) -> bool {
        mask
    }

    fn power_of_two(self) -> Tracked {
        match self.constant().map(|x| x - ROUND) {
            Some(k) if k.abs() < 1000.0 => Tracked::entry(power_of_two(k as i32)),
            _ => here(|e| e.fail("the exponent of a power of two is open")),
        }
    }

    fn is_odd(self) -> bool {
        match self.constant() {
            Some(x) => x.to_bits() & 1 != 0,
            None => {
                here(|e| e.fail("whether an integer is odd is open"));
                false
            }
        }
    }

    fn flip(self, x: Tracked) -> Tracked {
        match self.constant() {
            Some(n) if n.to_bits() & 2 != 0 => -x,
            Some(_) => x,
            None => here(|e| e.fail("an integer modulo four is open")),
        }
    }
}

/// Four of them side by side.
#[derive(Clone, Copy)]
pub(crate) struct Tracking;

impl Vectors for Tracking {
    type Scalar = Tracked;
    type V = [Tracked; 4];

    fn load(self, x: [Tracked; 4]) -> [Tracked; 4] {
        x
    }

    fn entries(self, x: [f64; 4]) -> [Tracked; 4] {
        x.map(Tracked::entry)
    }

    fn splat(self, x: Tracked) -> [Tracked; 4] {
        [x; 4]
    }

    fn mul(self, a: [Tracked; 4], b: [Tracked; 4]) -> [Tracked; 4] {
        std::array::from_fn(|i| a[i] * b[i])
    }

    fn mul_add(self, a: [Tracked; 4], b: [Tracked; 4], c: [Tracked; 4]) -> [Tracked; 4] {
        std::array::from_fn(|i| a[i].fma(b[i], c[i]))
    }

    fn neg_mul_add(self, a: [Tracked; 4], b: [Tracked; 4], c: [Tracked; 4]) -> [Tracked; 4] {
        std::array::from_fn(|i| (-a[i]).fma(b[i], c[i]))
    }

    fn parts(self, x: [Tracked; 4]) -> [Tracked; 4] {
        x
    }

    fn sum(self, x: [Tracked; 4]) -> Tracked {
        (x[0] + x[2]) + (x[1] + x[3])
    }
}
