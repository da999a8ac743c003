//! An evaluation of the solver's code over a box: the numbers met so far, and the operations on
//! them.
//!
//! The code is written on a tape as it runs, with one [`Pass`] over it. Both live beside the thread
//! that does it. A decision that is not the same
//! all over the box is taken both ways, one evaluation after the other: every point of the box
//! follows one of them.

use crate::exact::Exact;
use crate::grid::{TINIEST, grain_of_point};
use crate::interval::{Interval, sum_up};
use crate::program::pass::{Pass, Solver, joined};
use crate::program::tape::{Op, Place, Tape};
use mechaudit_solvers::faddeeva::proof::ROUND;
use std::cell::RefCell;

/// How the operations round; all but the first choice are faults, for tests of the proof.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rounding {
    /// Products of `fma` are rounded before the sum.
    pub fma_rounds_twice: bool,
    /// This operation, counted from 1, truncates.
    pub truncates: Option<u32>,
}

impl Rounding {
    /// Number of the last rounding of a sum of two numbers.
    pub(crate) const LAST: u32 = u32::MAX;
}

/// A stored number that stands for another one: what exact arithmetic has in its place, and the
/// difference `stored − exact`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Constant {
    pub stored: f64,
    pub exact: Interval,
    pub error: Interval,
}

/// Describes what an evaluation is told.
#[derive(Clone, Copy)]
pub(crate) struct Setting<'a> {
    /// The range of the small coordinate, not negative.
    pub sigma: Exact,
    pub constants: &'a [Constant],
    pub rounding: Rounding,
}

impl<'a> Setting<'a> {
    /// Without a small coordinate.
    pub fn new(constants: &'a [Constant], rounding: Rounding) -> Setting<'a> {
        Setting {
            sigma: Exact::ZERO,
            constants,
            rounding,
        }
    }
}

/// The evaluation of this thread.
#[derive(Default)]
pub(crate) struct Evaluation {
    constants: Vec<Constant>,
    pub rounding: Rounding,
    tape: Tape,
    pub pass: Pass,
    /// The decisions to take, and between how many ways.
    script: Vec<(usize, usize)>,
    taken: usize,
    /// The reason for which there is no bound.
    failure: Option<&'static str>,
    /// Numbers that are others times a power of two: which, and the power.
    multiples: Vec<(u32, (u32, f64))>,
    /// Products of two numbers that were rounded: of which, and the product.
    products: Vec<([u32; 2], Tracked)>,
    /// Products that are others times a power of two: which, and the power.
    shared: Vec<(Tracked, Tracked, Tracked)>,
    /// Differences that roundings of operations left over.
    losses: Vec<(Place, Tracked)>,
}

thread_local! {
    static HERE: RefCell<Evaluation> = RefCell::default();
}

/// Decisions of one evaluation more than which are not followed.
const WAYS: usize = 4096;

impl Evaluation {
    /// Carries an operation out.
    pub fn push(&mut self, op: Op) -> Tracked {
        self.tape.ops.push(op);
        if let Err(stop) = self.pass.step(&self.tape, op, &[], false, &[]) {
            self.tape.ops.pop();
            return self.fail(stop.reason);
        }
        Tracked(self.tape.ops.len() as u32 - 1)
    }

    /// Any number without an error, a multiple of `2^grain`.
    pub fn enter(&mut self, exact: Exact, grain: i32, small: bool) -> Tracked {
        self.tape.ops.push(Op::Input(0));
        self.pass.enter(exact, grain, small);
        Tracked(self.tape.ops.len() as u32 - 1)
    }

    /// One number, which is known exactly.
    pub fn point(&mut self, x: f64) -> Tracked {
        self.enter(Exact::point(x), grain_of_point(x), false)
    }

    /// A constant of the code, which may stand for another one.
    pub fn stored(&mut self, x: f64) -> Tracked {
        let known = self.constants.iter().find(|c| c.stored.abs() == x.abs());
        match known.copied() {
            None => self.point(x),
            Some(c) => {
                let sign = |v: Interval| if c.stored == x { v } else { -v };
                self.push(Op::Constant(sign(c.exact), x, sign(c.error)))
            }
        }
    }

    pub fn fail(&mut self, why: &'static str) -> Tracked {
        self.failure.get_or_insert(why);
        self.point(0.0)
    }

    fn choose(&mut self, ways: usize) -> usize {
        if self.taken == self.script.len() {
            self.script.push((0, ways));
        }
        let (chosen, of) = self.script[self.taken];
        debug_assert_eq!(of, ways, "the same box, the same decisions");
        self.taken += 1;
        chosen
    }

    /// Returns the pass's knowledge of the numbers.
    pub fn solver(&self) -> &Solver {
        self.pass.solver.as_ref().expect("a solver's pass")
    }

    /// The number all over the box.
    pub fn range(&self, x: Tracked) -> Interval {
        self.pass.float[x.place()]
    }

    pub fn constant(&self, x: Tracked) -> Option<f64> {
        self.pass.constant(x.place())
    }

    fn is_zero(&self, x: Tracked) -> bool {
        self.pass.is_zero(x.place())
    }

    fn is_small(&self, x: Tracked) -> bool {
        self.solver().small[x.place()]
    }

    fn tiny(&self, x: Tracked) -> f64 {
        self.solver().tiny[x.place()]
    }

    /// The same number with `s = 1`.
    pub fn plain(&mut self, x: Tracked) -> Tracked {
        match self.is_small(x) {
            true => self.push(Op::Plain(x.place())),
            false => x,
        }
    }

    /// Both with the same s.
    fn alike(&mut self, x: Tracked, y: Tracked) -> (Tracked, Tracked) {
        match self.is_small(x) == self.is_small(y) {
            true => (x, y),
            false => (self.plain(x), self.plain(y)),
        }
    }

    /// At most one of both with s = σ.
    fn factors(&mut self, x: Tracked, y: Tracked) -> (Tracked, Tracked) {
        match (self.is_small(x) && self.is_small(y), x == y) {
            (true, true) => (x, self.plain(x)),
            (true, false) => (x, self.plain(y)),
            _ => (x, y),
        }
    }

    /// Returns the part that a sum or a product lost, with the sign reversed; zero of one that was there
    /// already.
    fn lost(&mut self, x: Tracked, already: usize) -> Tracked {
        if x.place() < already {
            return self.point(0.0);
        }
        let shared = self.shared.iter().find(|s| s.0 == x).copied();
        if let Some((_, r, factor)) = shared {
            let lost = self.lost(r, 0);
            return self.push(Op::Mul(lost.place(), factor.place()));
        }
        let place = match self.tape.ops[x.place()] {
            Op::Near(a, _) => a,
            _ => x.place(),
        };
        let exact = self.pass.noise[place] == 0.0 && self.solver().absolute[place] == 0.0;
        if exact {
            return self.point(0.0);
        }
        if let Some(&(_, lost)) = self.losses.iter().find(|l| l.0 == place) {
            return lost;
        }
        let lost = self.push(Op::Lost(place));
        self.losses.push((place, lost));
        lost
    }

    /// Far out what underflowed is multiplied by |z|² again and again: its unit would overflow.
    fn settled(&mut self, x: Tracked) -> Tracked {
        match self.tiny(x) > 1e100 && !self.is_small(x) {
            true => self.push(Op::Near(x.place(), 0.0)),
            false => x,
        }
    }

    fn round(&mut self, op: Op) -> Tracked {
        let rounded = self.push(op);
        self.settled(rounded)
    }

    /// `x y` where one of them is a power of two and nothing is rounded, or below the normal
    /// numbers only; of which number, and by what.
    fn power_of(&self, x: Tracked, y: Tracked) -> Option<(Tracked, f64)> {
        let power = |t: Tracked| self.constant(t).filter(|c| is_power_of_two(*c));
        match (power(x), power(y)) {
            (_, Some(c)) => Some((x, c)),
            (Some(c), _) => Some((y, c)),
            _ => None,
        }
    }

    pub fn multiply(&mut self, x: Tracked, y: Tracked) -> Tracked {
        if self.is_zero(x) || self.is_zero(y) {
            return self.point(0.0);
        }
        if let (Some(a), Some(b)) = (self.constant(x), self.constant(y))
            && exact_product(a, b)
        {
            return self.point(a * b);
        }
        if let Some(of) = self.power_of(x, y) {
            let p = self.round(Op::Mul(x.place(), y.place()));
            if self.tiny(p) == 0.0 {
                self.multiples.push((p.0, (of.0.0, of.1)));
            }
            return p;
        }
        self.rounded_product(x, y)
    }

    /// `x y` rounded. Of `x` and `2^k x` as factors the rounded products have the ratio `2^k`, if
    /// neither may be below the normal numbers: they share their ε.
    fn rounded_product(&mut self, x: Tracked, y: Tracked) -> Tracked {
        let multiple = |t: Tracked| {
            let found = self.multiples.iter().find(|m| m.0 == t.0);
            found.map_or((t.0, 1.0), |m| m.1)
        };
        let ((p, s), (q, t)) = (multiple(x), multiple(y));
        let (of, by) = ([p.min(q), p.max(q)], s * t);
        let least = (self.range(x) * self.range(y)).mignitude();
        let normal = least > 1e-250 && (1e-9..1e9).contains(&by.abs());
        if normal
            && let Some(&(_, r)) = self.products.iter().find(|k| k.0 == of)
            && self.tiny(r) == 0.0
        {
            let factor = self.point(by);
            let product = self.push(Op::Mul(r.place(), factor.place()));
            self.shared.push((product, r, factor));
            return product;
        }
        let (x, y) = self.factors(x, y);
        let r = self.round(Op::Mul(x.place(), y.place()));
        if normal && by == 1.0 {
            self.products.push((of, r));
        }
        r
    }

    pub fn add(&mut self, x: Tracked, y: Tracked) -> Tracked {
        if self.is_zero(x) || self.is_zero(y) {
            return if self.is_zero(x) { y } else { x };
        }
        if x == y {
            let two = self.point(2.0);
            return self.multiply(x, two);
        }
        if let (Some(a), Some(b)) = (self.constant(x), self.constant(y))
            && exact_sum(a, b)
        {
            return self.point(a + b);
        }
        let (x, y) = self.alike(x, y);
        self.round(Op::Add(x.place(), y.place()))
    }

    /// `x + y` rounded, and what it lost.
    pub fn two_sum(&mut self, x: Tracked, y: Tracked) -> (Tracked, Tracked) {
        let already = self.tape.ops.len();
        let sum = self.add(x, y);
        (sum, self.lost(sum, already))
    }

    /// An operation whose result is not rounded.
    fn unrounded(&mut self, op: Op) -> Tracked {
        let set = |e: &mut Evaluation, is: bool| {
            if let Some(solver) = &mut e.pass.solver {
                solver.is_unrounded = is;
            }
        };
        set(self, true);
        let result = self.push(op);
        set(self, false);
        result
    }

    /// The sum of two numbers, not rounded.
    pub fn exact_sum(&mut self, x: Tracked, y: Tracked) -> Tracked {
        match (self.is_zero(x), self.is_zero(y)) {
            (true, _) => y,
            (_, true) => x,
            _ => {
                let (x, y) = self.alike(x, y);
                self.unrounded(Op::Add(x.place(), y.place()))
            }
        }
    }

    /// `x y` rounded, and what it lost, which is itself rounded to a multiple of 2⁻¹⁰⁷⁴.
    pub fn two_prod(&mut self, x: Tracked, y: Tracked) -> (Tracked, Tracked) {
        let grain = |t: Tracked| self.pass.grain[t.place()];
        let grain = grain(x).saturating_add(grain(y));
        let already = self.tape.ops.len();
        let p = self.multiply(x, y);
        let lost = self.lost(p, already);
        if grain < -1074
            && !self.is_zero(lost)
            && let Some(solver) = &mut self.pass.solver
        {
            let tiny = &mut solver.tiny[lost.place()];
            *tiny = sum_up(*tiny, 1.0);
            let range = &mut self.pass.float[lost.place()];
            *range = range.widened(TINIEST);
        }
        (p, lost)
    }

    pub fn divide(&mut self, x: Tracked, y: Tracked) -> Tracked {
        let y = self.plain(y);
        self.round(Op::Div(x.place(), y.place()))
    }

    pub fn fma(&mut self, x: Tracked, y: Tracked, z: Tracked) -> Tracked {
        if self.constant(z) == Some(ROUND) {
            return self.integer(x, y);
        }
        if self.is_zero(z) {
            return self.multiply(x, y);
        }
        if self.is_zero(x) || self.is_zero(y) {
            return z;
        }
        if self.rounding.fma_rounds_twice {
            let p = self.multiply(x, y);
            return self.add(p, z);
        }
        let (mut x, mut y) = self.factors(x, y);
        let mut z = z;
        if (self.is_small(x) || self.is_small(y)) != self.is_small(z) {
            [x, y, z] = [x, y, z].map(|t| self.plain(t));
        }
        self.round(Op::Fma(x.place(), y.place(), z.place()))
    }

    /// `x y + ROUND`: one number for each integer that `x y` may be rounded to.
    fn integer(&mut self, x: Tracked, y: Tracked) -> Tracked {
        let (x, y) = self.factors(x, y);
        let product = self.unrounded(Op::Mul(x.place(), y.place()));
        let range = self.range(product);
        if !(range.magnitude() < 1e9) {
            return self.fail("an integer beyond 10⁹");
        }
        let least = (range.lo - 0.5).next_down().ceil();
        let most = (range.hi + 0.5).next_up().floor();
        let ways = (most - least) as usize + 1;
        if ways > WAYS {
            return self.fail("too many integers");
        }
        let k = if ways == 1 { 0 } else { self.choose(ways) };
        self.point(ROUND + (least + k as f64))
    }

    /// Returns whether `x < y`.
    pub fn below(&mut self, x: Tracked, y: Tracked) -> bool {
        let [p, q] = [x, y].map(|t| self.range(t));
        if p.hi < q.lo {
            return true;
        }
        if p.lo >= q.hi {
            return false;
        }
        self.choose(2) == 0
    }

    /// The error of a number in which those of operations may cancel.
    fn deviation(&mut self, x: Tracked) -> f64 {
        self.pass.look_back(&self.tape, x.place());
        self.pass.total(&self.tape, x.place())
    }

    /// The error of a number as a part of it, where a sum of positive numbers is wrong by no larger
    /// a part than one of them.
    fn part(&mut self, x: Tracked) -> f64 {
        let place = x.place();
        let op = self.tape.ops[place];
        let at = |place: Place| Tracked(place as u32);
        let operands: &[Place] = match op {
            Op::Add(a, b) | Op::Mul(a, b) => &[a, b],
            Op::Fma(a, b, c) => &[a, b, c],
            _ => &[],
        };
        let positive = |p: &Place| self.solver().exact[*p].range.lo >= 0.0;
        let of = |parts: &[f64]| match (op, parts) {
            (Op::Add(..), [p, q]) => p.max(*q),
            (Op::Mul(..), [p, q]) => joined(*p, *q),
            (Op::Fma(..), [p, q, r]) => joined(*p, *q).max(*r),
            _ => f64::INFINITY,
        };
        // A share is known of what is no subnormal number.
        if operands.iter().all(positive) && self.solver().share[place].is_finite() {
            let power = matches!(op, Op::Mul(..)) && self.pass.noise[place] == 0.0;
            let parts = operands.iter().map(|p| match power {
                true => self.part(at(*p)),
                false => {
                    let error = self.deviation(at(*p));
                    self.pass.relative(*p, error)
                }
            });
            let parts: Vec<f64> = parts.collect();
            let unit = if power { 0.0 } else { 0.5 * f64::EPSILON };
            return joined(of(&parts), unit);
        }
        let error = self.deviation(x);
        self.pass.relative(place, error)
    }

    /// The number's exact value, and what rounding makes of it.
    pub fn result(&mut self, x: Tracked) -> Result {
        let place = x.place();
        let error = self.deviation(x);
        let mut relative = self.pass.relative(place, error);
        if relative > 2.0 * f64::EPSILON {
            relative = relative.min(self.part(x));
        }
        let solver = self.solver();
        Result {
            exact: solver.exact[place].range,
            error,
            tiny: solver.tiny[place],
            small: solver.small[place],
            relative,
        }
    }
}

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

fn is_power_of_two(x: f64) -> bool {
    x.is_normal() && x.to_bits() << 12 == 0
}

/// Returns whether `a b` is an `f64`; normal numbers only.
fn exact_product(a: f64, b: f64) -> bool {
    let p = a * b;
    p == 0.0 && (a == 0.0 || b == 0.0)
        || p.is_normal() && p.abs() > 1e-290 && a.mul_add(b, -p) == 0.0
}

/// Returns whether `a + b` is an `f64`.
fn exact_sum(a: f64, b: f64) -> bool {
    let s = a + b;
    let (small, large) = if a.abs() < b.abs() { (a, b) } else { (b, a) };
    s.is_finite() && s - large == small
}

/// A number of the evaluation that this thread is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tracked(u32);

impl Tracked {
    pub fn place(self) -> Place {
        self.0 as usize
    }
}

pub(crate) fn here<T>(f: impl FnOnce(&mut Evaluation) -> T) -> T {
    HERE.with_borrow_mut(f)
}

/// Returns the results of `f` on every way through its decisions.
///
/// # Errors
/// The reason for which there is no bound.
pub(crate) fn evaluate<T>(
    setting: Setting<'_>,
    mut f: impl FnMut() -> T,
) -> std::result::Result<Vec<T>, &'static str> {
    here(|e| {
        e.constants.clear();
        e.constants.extend_from_slice(setting.constants);
        e.rounding = setting.rounding;
        e.script.clear();
        let solver = e.pass.solver.get_or_insert_default();
        (solver.sigma, solver.truncates) = (setting.sigma, setting.rounding.truncates);
    });
    let mut all = Vec::new();
    loop {
        here(|e| {
            e.tape.ops.clear();
            e.pass.clear();
            e.multiples.clear();
            e.products.clear();
            e.shared.clear();
            e.losses.clear();
            (e.taken, e.failure) = (0, None);
        });
        all.push(f());
        let more = here(|e| {
            if let Some(why) = e.failure {
                return Err(why);
            }
            while let Some((chosen, ways)) = e.script.pop() {
                if chosen + 1 < ways {
                    e.script.push((chosen + 1, ways));
                    return Ok(true);
                }
            }
            Ok(false)
        })?;
        if !more {
            return Ok(all);
        }
        if all.len() > WAYS {
            return Err("too many ways through the decisions");
        }
    }
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod limit_tests;
