//! A type of number for the solver's generic code: each operation is applied to [`Form`]s.

use crate::evaluation::here;
pub(crate) use crate::evaluation::{Constant, Rounding, Setting, Tracked, evaluate};
use crate::exact::Exact;
use crate::form::{Form, grain_of, power_of_two};
use crate::interval::{Interval, sum_up};
use mechaudit_solvers::faddeeva::proof::{ROUND, Real, Vectors};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Describes what is known of a result.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Result {
    /// Its value in exact arithmetic, divided by σ if it is small.
    pub exact: Interval,
    /// The largest distance of the number computed from it, divided by σ if it is small.
    pub error: f64,
    /// Added to it, in units of 2⁻¹⁰⁷⁵.
    pub tiny: f64,
    /// Tells whether σ is a factor.
    pub small: bool,
    /// The further error as a part of the value.
    pub relative: f64,
}

impl Result {
    fn of(form: &Form) -> Result {
        Result {
            exact: form.main.range,
            error: form.deviation,
            tiny: form.tiny,
            small: form.small,
            relative: form.relative(),
        }
    }
}

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
        here(|e| e.push(Form::exact(exact, grain)))
    }

    /// The small coordinate.
    pub fn sigma() -> Tracked {
        here(|e| {
            let mut form = Form::exact(Exact::point(1.0), grain_of(e.sigma.range.lo));
            form.small = true;
            e.push(form)
        })
    }

    /// A coordinate's distance from a centre, which the code computes without rounding: a multiple
    /// of `2^grain`.
    pub fn offset(self, centre: f64, grain: i32) -> Tracked {
        here(|e| {
            let main = e.form(self).main + Exact::point(-centre);
            e.push(Form::exact(main, grain))
        })
    }

    /// A table's entry, which stands for itself.
    pub fn entry(x: f64) -> Tracked {
        here(|e| e.push(Form::point(x)))
    }

    /// Any number that a form describes.
    pub fn of(form: Form) -> Tracked {
        here(|e| e.push(form))
    }

    pub fn result(self) -> Result {
        here(|e| Result::of(e.form(self)))
    }

    /// The sum of two numbers, not rounded.
    pub fn exact_sum(self, other: Tracked) -> Result {
        here(|e| Result::of(&e.sum(self, other)))
    }

    /// The number, if it is the same all over the box.
    pub fn constant(self) -> Option<f64> {
        here(|e| e.form(self).constant())
    }
}

impl Add for Tracked {
    type Output = Tracked;
    fn add(self, other: Tracked) -> Tracked {
        here(|e| e.add(self, other).0)
    }
}

impl Neg for Tracked {
    type Output = Tracked;
    fn neg(self) -> Tracked {
        here(|e| {
            let form = e.form(self).negative();
            e.push(form)
        })
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
        here(|e| e.multiply(self, other).0)
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
        here(|e| {
            let known = e.constants.iter().find(|c| c.stored.abs() == x.abs());
            let form = match known {
                None => Form::point(x),
                Some(c) => {
                    let sign = |v: Interval| if c.stored == x { v } else { -v };
                    let exact = Exact::within(sign(c.exact));
                    let mut form = Form::exact(exact, grain_of(x.abs()));
                    form.terms.push((0, sign(c.error)));
                    form.summed()
                }
            };
            e.push(form)
        })
    }

    fn fma(self, b: Tracked, c: Tracked) -> Tracked {
        here(|e| e.fma(self, b, c))
    }

    fn two_sum(self, b: Tracked) -> (Tracked, Tracked) {
        here(|e| e.add(self, b))
    }

    fn fast_two_sum(self, b: Tracked) -> (Tracked, Tracked) {
        let exact = here(|e| {
            let (p, q) = (e.form(self).range(e.sigma), e.form(b).range(e.sigma));
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
        here(|e| {
            let grain = e.form(self).grain.saturating_add(e.form(b).grain);
            let (p, lost) = e.multiply(self, b);
            let mut form = e.form(lost).clone();
            if grain < -1074 && !form.is_zero() {
                // The error itself is rounded to a multiple of 2⁻¹⁰⁷⁴.
                form.tiny = sum_up(form.tiny, 1.0);
            }
            (p, e.push(form))
        })
    }

    fn magnitude(self) -> Tracked {
        let sign = here(|e| {
            let range = e.form(self).range(e.sigma);
            (range.lo >= 0.0, range.hi <= 0.0)
        });
        match sign {
            (true, _) => self,
            (_, true) => -self,
            _ => here(|e| {
                let mut form = e.form(self).clone();
                form.main = Exact::within(Interval::new(0.0, form.main.range.magnitude()));
                form.rest = form.deviation;
                form.share = f64::INFINITY;
                form.terms.clear();
                e.push(form)
            }),
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
            let mut form = e.form(self).plain(e.sigma);
            let lo = form.range(e.sigma).lo;
            if lo < least {
                // Between 0 and `least − lo` is added; nothing is rounded.
                form.rest = sum_up(form.rest, sum_up(least, (-lo).max(0.0)));
                form.share = f64::INFINITY;
                form.grain = form.grain.min(grain_of(least));
                form = form.summed();
            }
            e.push(form)
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
