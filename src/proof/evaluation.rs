//! An evaluation of the solver's code over a box: the numbers met so far, and the operations on
//! them.
//!
//! The forms of one evaluation live beside the thread that does it. A decision that is not the same
//! all over the box is taken both ways, one evaluation after the other: every point of the box
//! follows one of them.

use crate::exact::Exact;
use crate::form::{Form, exponent, mapped, product, quotient, regrained, rounded, rounding, sum};
use crate::interval::{Interval, product_up, sum_up};
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
    pub sigma: Exact,
    pub constants: Vec<Constant>,
    pub rounding: Rounding,
    forms: Vec<Form>,
    /// Operations that rounded; number 0 is the difference of the constants.
    operations: u32,
    /// The decisions to take, and between how many ways.
    script: Vec<(usize, usize)>,
    taken: usize,
    /// Why no bound is had.
    failure: Option<&'static str>,
    /// Numbers that are others times a power of two: which, and the power.
    multiples: Vec<(u32, (u32, f64))>,
    /// Products of two numbers that were rounded: of which, the product and what it lost.
    products: Vec<([u32; 2], [Tracked; 2])>,
}

thread_local! {
    static HERE: RefCell<Evaluation> = RefCell::default();
}

/// Decisions of one evaluation more than which are not followed.
const WAYS: usize = 4096;

impl Evaluation {
    pub fn push(&mut self, form: Form) -> Tracked {
        self.forms.push(form);
        Tracked(self.forms.len() as u32 - 1)
    }

    pub fn fail(&mut self, why: &'static str) -> Tracked {
        self.failure.get_or_insert(why);
        self.push(Form::point(0.0))
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

    pub fn form(&self, x: Tracked) -> &Form {
        &self.forms[x.0 as usize]
    }

    /// The number rounded, and its error with the sign reversed.
    pub fn round(&mut self, form: Form) -> (Tracked, Tracked) {
        let factor = match self.rounding.truncates {
            Some(k) if k == self.operations + 1 => 2.0,
            _ => 1.0,
        };
        match rounding(&form, self.sigma, factor) {
            None => {
                let form = regrained(form, self.sigma);
                (self.push(form), self.push(Form::point(0.0)))
            }
            Some((error, absolute)) => {
                self.operations += 1;
                let k = self.operations;
                let mut lost = Form::exact(Exact::ZERO, form.grain);
                (lost.small, lost.tiny) = (form.small, absolute);
                if error != 0.0 {
                    lost.terms.push((k, Interval::point(-error)));
                }
                let form = rounded(form, self.sigma, (error, absolute), factor, k);
                (self.push(form), self.push(lost.summed()))
            }
        }
    }

    /// Both with the same s.
    fn alike(&self, x: Tracked, y: Tracked) -> (Form, Form) {
        let (x, y) = (self.form(x), self.form(y));
        match x.small == y.small {
            true => (x.clone(), y.clone()),
            // Zero has no size.
            false if x.is_zero() || y.is_zero() => (x.clone(), y.clone()),
            false => (x.plain(self.sigma), y.plain(self.sigma)),
        }
    }

    /// `x + y` before rounding.
    pub fn sum(&self, x: Tracked, y: Tracked) -> Form {
        if x == y {
            return self.form(x).doubled();
        }
        let (x, y) = self.alike(x, y);
        match (x.is_zero(), y.is_zero()) {
            (true, _) => y,
            (_, true) => x,
            _ => sum(&x, &y),
        }
    }

    /// `x y` before rounding.
    fn product(&self, x: Tracked, y: Tracked) -> Form {
        let (p, q) = (self.form(x), self.form(y));
        if p.is_zero() || q.is_zero() {
            return Form::point(0.0);
        }
        match p.small && q.small {
            true => product(p, &q.plain(self.sigma), self.sigma, false),
            false => product(p, q, self.sigma, x == y),
        }
    }

    /// `x y` where one of them is a power of two and nothing is rounded, or below the normal
    /// numbers only; of which number, and by what.
    fn scaled(&self, x: Tracked, y: Tracked) -> Option<(Form, (Tracked, f64))> {
        let power = |t: Tracked| self.form(t).constant().filter(|c| is_power_of_two(*c));
        let (of, by) = match (power(x), power(y)) {
            (_, Some(c)) => (x, c),
            (Some(c), _) => (y, c),
            _ => return None,
        };
        let mut form = self.form(of).clone();
        let k = exponent(by.abs());
        let times = |c: Interval| {
            let c = if by < 0.0 { -c } else { c };
            let by = by.abs();
            let (lo, hi) = (c.lo * by, c.hi * by);
            // Exact unless it underflows or overflows.
            let exact = |x: f64, y: f64| y / by == x;
            let lo = if exact(c.lo, lo) { lo } else { lo.next_down() };
            let hi = if exact(c.hi, hi) { hi } else { hi.next_up() };
            Interval::new(lo, hi)
        };
        form.main = form.main.scaled(by, times(form.main.range));
        form.terms = mapped(&form.terms, times);
        form.rest = product_up(form.rest, by.abs());
        form.tiny = product_up(form.tiny, by.abs());
        form.grain = form.grain.saturating_add(k);
        let mut form = form.summed();
        let range = form.range(self.sigma);
        if exponent(range.magnitude().max(f64::MIN_POSITIVE)) >= 1023 {
            return None;
        }
        if form.grain < -1074 && range.mignitude() < f64::MIN_POSITIVE {
            form.tiny = sum_up(form.tiny, 1.0);
        }
        form.grain = form.grain.max(-1074);
        Some((form, (of, by)))
    }

    pub fn multiply(&mut self, x: Tracked, y: Tracked) -> (Tracked, Tracked) {
        if let (Some(a), Some(b)) = (self.form(x).constant(), self.form(y).constant())
            && exact_product(a, b)
        {
            let zero = self.push(Form::point(0.0));
            return (self.push(Form::point(a * b)), zero);
        }
        if let Some((form, (of, by))) = self.scaled(x, y) {
            let mut lost = Form::point(0.0);
            let exact = form.tiny == 0.0;
            lost.tiny = form.tiny;
            let lost = self.push(lost);
            let p = self.push(regrained(form, self.sigma));
            if exact {
                self.multiples.push((p.0, (of.0, by)));
            }
            return (p, lost);
        }
        self.rounded_product(x, y)
    }

    /// `x y` rounded. Of `x` and `2^k x` as factors the rounded products have the ratio `2^k`, if
    /// neither may be below the normal numbers: they share their ε.
    fn rounded_product(&mut self, x: Tracked, y: Tracked) -> (Tracked, Tracked) {
        let multiple = |t: Tracked| {
            let found = self.multiples.iter().find(|m| m.0 == t.0);
            found.map_or((t.0, 1.0), |m| m.1)
        };
        let ((p, s), (q, t)) = (multiple(x), multiple(y));
        let (of, by) = ([p.min(q), p.max(q)], s * t);
        let form = self.product(x, y);
        let normal = form.range(self.sigma).mignitude() > 1e-250 && (1e-9..1e9).contains(&by.abs());
        if normal && let Some(&(_, [r, lost])) = self.products.iter().find(|k| k.0 == of) {
            let factor = self.push(Form::point(by));
            let both = [r, lost].map(|t| self.scaled(t, factor));
            if let [Some((r, _)), Some((lost, _))] = both
                && r.tiny == 0.0
                && lost.tiny == 0.0
            {
                let r = self.push(regrained(r, self.sigma));
                return (r, self.push(lost));
            }
        }
        let (r, lost) = self.round(form);
        if normal && by == 1.0 {
            self.products.push((of, [r, lost]));
        }
        (r, lost)
    }

    pub fn add(&mut self, x: Tracked, y: Tracked) -> (Tracked, Tracked) {
        if self.form(x).is_zero() || self.form(y).is_zero() {
            let sum = if self.form(x).is_zero() { y } else { x };
            return (sum, self.push(Form::point(0.0)));
        }
        if let (Some(a), Some(b)) = (self.form(x).constant(), self.form(y).constant())
            && exact_sum(a, b)
        {
            let zero = self.push(Form::point(0.0));
            return (self.push(Form::point(a + b)), zero);
        }
        let form = self.sum(x, y);
        self.round(form)
    }

    pub fn divide(&mut self, x: Tracked, y: Tracked) -> Tracked {
        let y = self.form(y).plain(self.sigma);
        match quotient(self.form(x), &y) {
            Some(form) => self.round(form).0,
            None => self.fail("a divisor may be zero"),
        }
    }

    pub fn fma(&mut self, x: Tracked, y: Tracked, z: Tracked) -> Tracked {
        if self.form(z).constant() == Some(ROUND) {
            return self.integer(x, y);
        }
        if self.form(z).is_zero() {
            return self.multiply(x, y).0;
        }
        if self.form(x).is_zero() || self.form(y).is_zero() {
            return z;
        }
        if self.rounding.fma_rounds_twice {
            let p = self.multiply(x, y).0;
            return self.add(p, z).0;
        }
        let form = match self.scaled(x, y) {
            // Not rounded before the sum.
            Some((form, _)) if form.tiny == 0.0 => form,
            _ => self.product(x, y),
        };
        let p = self.push(form);
        let form = self.sum(p, z);
        self.round(form).0
    }

    /// `x y + ROUND`: one number for each integer that `x y` may be rounded to.
    fn integer(&mut self, x: Tracked, y: Tracked) -> Tracked {
        let range = self.product(x, y).range(self.sigma);
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
        self.push(Form::point(ROUND + (least + k as f64)))
    }

    /// Returns whether `x < y`.
    pub fn below(&mut self, x: Tracked, y: Tracked) -> bool {
        let [p, q] = [x, y].map(|t| self.form(t).range(self.sigma));
        if p.hi < q.lo {
            return true;
        }
        if p.lo >= q.hi {
            return false;
        }
        self.choose(2) == 0
    }
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

pub(crate) fn here<T>(f: impl FnOnce(&mut Evaluation) -> T) -> T {
    HERE.with_borrow_mut(f)
}

/// The results of `f` on every way through its decisions.
///
/// # Errors
/// Why no bound is had.
pub(crate) fn evaluate<T>(
    setting: Setting<'_>,
    mut f: impl FnMut() -> T,
) -> std::result::Result<Vec<T>, &'static str> {
    here(|e| {
        e.sigma = setting.sigma;
        e.constants.clear();
        e.constants.extend_from_slice(setting.constants);
        e.rounding = setting.rounding;
        e.script.clear();
    });
    let mut all = Vec::new();
    loop {
        here(|e| {
            e.forms.clear();
            e.multiples.clear();
            e.products.clear();
            (e.operations, e.taken, e.failure) = (0, 0, None);
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
