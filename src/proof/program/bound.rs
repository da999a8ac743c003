//! The bound over one box.

use super::pass::{Narrowing, Pass, Stop};
use super::tape::{Op, Place};
use super::{Measure, Program};
use crate::interval::{Interval, hypot_down, hypot_up, larger, product_up, quotient_up, sum_up};

/// The bounds over one box.
#[derive(Clone, Debug)]
pub(super) struct Found {
    /// The bound in the measure.
    pub bound: f64,
    /// The bound of the absolute error.
    error: f64,
    /// The same at the centre alone: how far cutting may bring the bound down.
    pub lower: f64,
    /// The input across which a cut tells most.
    pub cut: usize,
    /// The sign of the value at the centre.
    pub sign: f64,
    /// The value over the box.
    value: Interval,
    /// Why there is no bound.
    pub why: Option<&'static str>,
}

/// Works out bounds, with room for intermediate results.
pub(super) struct Bounds<'a> {
    program: &'a Program,
    measure: Measure,
    /// The result that is looked at, one of the program's.
    root: Place,
    wide: Pass,
    centre: Pass,
    condition: Pass,
}

/// Conditions that a box may leave open.
const MOST_OPEN: usize = 6;

fn centre_of(x: Interval) -> f64 {
    if x.is_point() {
        return x.lo;
    }
    (x.lo / 2.0 + x.hi / 2.0).clamp(x.lo, x.hi)
}

/// The part of an interval on either side of its centre.
fn around(x: Interval) -> Interval {
    x - Interval::point(centre_of(x))
}

/// The input that is widest beside its domain.
pub(super) fn widest(program: &Program, at: &[Interval]) -> usize {
    let share = |k: usize| {
        let of = |x: Interval| x.hi / 2.0 - x.lo / 2.0;
        let (here, all) = (of(at[k]), of(program.domain[k]));
        if here == 0.0 { 0.0 } else { here / all }
    };
    let all = 0..at.len();
    all.max_by(|a, b| share(*a).total_cmp(&share(*b)))
        .unwrap_or(0)
}

/// The bound of a complex result from those of the absolute errors of its parts: `|f̂ − f|`, as a
/// part of `|f|` if asked.
fn of_complex(measure: Measure, [re, im]: [Found; 2]) -> Found {
    let error = hypot_up(re.bound, im.bound);
    let lower = hypot_down(re.lower, im.lower);
    let size = |of: fn(Interval) -> f64| [of(re.value), of(im.value)];
    let ([a, b], [c, d]) = (size(Interval::mignitude), size(Interval::magnitude));
    let (bound, lower) = match measure {
        Measure::Absolute => (error, lower),
        _ => (quotient_up(error, hypot_down(a, b)), lower / hypot_up(c, d)),
    };
    let worse = if re.bound >= im.bound { &re } else { &im };
    Found {
        bound: if bound.is_nan() { f64::INFINITY } else { bound },
        error,
        lower: if lower.is_nan() { 0.0 } else { lower },
        cut: worse.cut,
        sign: 0.0,
        value: Interval::ALL,
        why: (!bound.is_finite()).then(|| worse.why.unwrap_or("a value that may be zero")),
    }
}

impl<'a> Bounds<'a> {
    pub fn new(program: &'a Program, measure: Measure) -> Bounds<'a> {
        let pass = || Pass::new(program.setting, program.domain.len());
        Bounds {
            program,
            measure,
            root: 0,
            wide: pass(),
            centre: pass(),
            condition: pass(),
        }
    }

    /// Returns whether the condition on the inputs may hold in a box.
    pub fn is_admitted(&mut self, at: &[Interval]) -> bool {
        let Some((tape, place)) = &self.program.condition else {
            return true;
        };
        match self.condition.forward(tape, at, false, &[]) {
            Ok(()) => self.condition.holds(tape, *place) != Some(false),
            Err(_) => true,
        }
    }

    /// The bound over a box.
    pub fn on(&mut self, at: &[Interval]) -> Found {
        let (program, measure) = (self.program, self.measure);
        let narrowing = self.narrowing(at);
        let mut of = |root: Place, measure: Measure| {
            (self.root, self.measure) = (root, measure);
            self.wide.given.clear();
            self.wide.narrowing.clone_from(&narrowing);
            self.within(at)
        };
        if let [re, im] = program.roots[..] {
            let parts = [re, im].map(|root| of(root, Measure::Absolute));
            self.measure = measure;
            return of_complex(measure, parts);
        }
        of(program.roots[0], measure)
    }

    /// The condition on the inputs over a box.
    fn narrowing(&mut self, at: &[Interval]) -> Option<Narrowing> {
        let program = self.program;
        let (tape, place) = program.condition.as_ref()?;
        let points: Vec<Interval> = at.iter().map(|x| Interval::point(centre_of(*x))).collect();
        self.condition.forward(tape, at, true, &[]).ok()?;
        let over = self.condition.clone();
        self.condition.forward(tape, &points, false, &[]).ok()?;
        // The centre may be where the formula has no value.
        self.centre.given.clear();
        self.centre.forward_beyond(&program.tape, &points);
        if !self.centre.open.is_empty() {
            return None;
        }
        let steps = at.iter().map(|x| around(*x)).collect();
        let centre = self.centre.value.clone();
        Narrowing::new((tape, *place), [&over, &self.condition], steps, centre)
    }

    fn nothing(&self, at: &[Interval], stop: Stop) -> Found {
        Found {
            bound: f64::INFINITY,
            error: f64::INFINITY,
            lower: 0.0,
            cut: widest(self.program, at),
            sign: 0.0,
            value: Interval::ALL,
            why: Some(stop.reason),
        }
    }

    /// `|f̂ − f|` in the measure, from bounds of it and of f.
    fn measured(&self, error: f64, value: Interval) -> f64 {
        if error == 0.0 {
            return 0.0;
        }
        if self.measure != Measure::Absolute && value.mignitude() == 0.0 {
            return f64::INFINITY;
        }
        match self.measure {
            Measure::Absolute => error,
            Measure::Relative => quotient_up(error, value.mignitude()),
            Measure::Ulps => self.in_ulps(error, value),
        }
    }

    /// The error in units in the last place of the value.
    ///
    /// Over a box where the value crosses one power of two `p`, with the unit t below it and 2t
    /// above, half a unit of the last rounding is t above p alone. Let `e < t` bound the error
    /// before it. Of a value below p what is rounded, w, is at most p, and rounding costs t/2; or
    /// it is above p by less than t, and p is what it becomes, which is nearer to the value than w.
    /// Either way the error is at most `e + t/2`.
    fn in_ulps(&self, error: f64, value: Interval) -> f64 {
        let (below, above) = (
            self.wide.ulp(value.mignitude()),
            self.wide.ulp(value.magnitude()),
        );
        let plain = quotient_up(error, below);
        let root = self.root;
        let rounds = matches!(
            self.program.tape.ops[root],
            Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Div(..) | Op::Sqrt(_) | Op::Fma(..)
        );
        let before = (error - self.wide.noise[root]).next_up().max(0.0);
        if !rounds || above != 2.0 * below || !(before < below) {
            return plain;
        }
        let least = quotient_up(sum_up(before, 0.5 * below), below);
        plain.min(least.max(quotient_up(error, above)))
    }

    /// Conditions that are open: the worst of all branches that the exact value may take.
    fn branches(&mut self, at: &[Interval], picks: &[bool]) -> Result<(f64, Interval), Stop> {
        let program = self.program;
        let (tape, root) = (&program.tape, self.root);
        self.wide.forward(tape, at, true, picks)?;
        if self.wide.open.len() > picks.len() {
            if picks.len() >= MOST_OPEN {
                return Err(Stop {
                    reason: "too many conditions that are open at once",
                });
            }
            let mut of = |pick: bool| {
                let more: Vec<bool> = picks.iter().copied().chain([pick]).collect();
                self.branches(at, &more)
            };
            let ((p, v), (q, w)) = (of(true)?, of(false)?);
            return Ok((larger(p, q), v.hull(w)));
        }
        self.wide.backward(tape, root, false);
        let value = self.wide.value[root];
        Ok((self.measured(self.wide.total(tape, root), value), value))
    }

    fn within(&mut self, at: &[Interval]) -> Found {
        let program = self.program;
        let (tape, root, n) = (&program.tape, self.root, at.len());
        if let Err(stop) = self.wide.forward(tape, at, true, &[]) {
            return self.nothing(at, stop);
        }
        if !self.wide.open.is_empty() {
            let (found, value) = match self.branches(at, &[]) {
                Ok(found) => found,
                Err(stop) => return self.nothing(at, stop),
            };
            let cut = self.cut(at, &[]);
            return Found {
                bound: found,
                error: f64::INFINITY,
                lower: 0.0,
                cut,
                sign: 0.0,
                value,
                why: (!found.is_finite()).then_some("no bound of a derivative"),
            };
        }
        self.wide.backward(tape, root, true);
        let mut error = self.wide.total(tape, root);
        let mut value = self.wide.value[root];
        let mut bound = self.measured(error, value);
        if self.wide.is_narrowed() {
            return Found {
                bound,
                error,
                lower: 0.0,
                cut: self.cut(at, &[]),
                sign: 0.0,
                value,
                why: (!bound.is_finite()).then_some("no bound of a derivative"),
            };
        }
        let mut lower = 0.0;
        let mut sign = 0.0;
        // The centre on the path of any point of the box: with the errors that it may make.
        self.centre.given.clear();
        let points: Vec<Interval> = at.iter().map(|x| Interval::point(centre_of(*x))).collect();
        if self.centre.forward(tape, &points, false, &[]).is_ok() && self.centre.open.is_empty() {
            self.centre.backward(tape, root, false);
            let own = self.centre.total(tape, root);
            let there = self.centre.value[root];
            lower = self.measured(own, there);
            sign = if there.lo > 0.0 {
                1.0
            } else if there.hi < 0.0 {
                -1.0
            } else {
                0.0
            };
        }
        self.centre.given.extend_from_slice(&self.wide.noise);
        let centred = self.centre.forward(tape, &points, false, &[]).is_ok();
        let mut gradient = vec![Interval::ZERO; n];
        if centred && self.centre.open.is_empty() {
            self.centre.backward(tape, root, false);
            let steps: Vec<Interval> = at.iter().map(|x| around(*x)).collect();
            let slopes = &self.wide.slope[root * n..(root + 1) * n];
            let carried = |slopes: &[Interval]| {
                let terms = slopes.iter().zip(&steps);
                terms.fold(Interval::ZERO, |sum, (s, step)| sum + *s * *step)
            };
            value = value.meet(self.centre.value[root] + carried(slopes));
            let (mut direct, mut centre) = (0.0, 0.0);
            for i in 0..=root {
                let noise = self.wide.noise[i];
                if noise == 0.0 {
                    continue;
                }
                let slopes = &self.wide.adjoint_slope[i * n..(i + 1) * n];
                let there = self.centre.adjoint[i];
                let here = self.wide.adjoint[i].meet(there + carried(slopes));
                direct = sum_up(direct, product_up(noise, here.magnitude()));
                centre = sum_up(centre, product_up(noise, there.magnitude()));
                let side = if here.lo >= 0.0 {
                    Interval::point(noise)
                } else if here.hi <= 0.0 {
                    Interval::point(-noise)
                } else {
                    Interval {
                        lo: -noise,
                        hi: noise,
                    }
                };
                for j in 0..n {
                    gradient[j] = gradient[j] + side * slopes[j];
                }
            }
            let reach = |gradient: &[Interval]| carried(gradient).magnitude();
            let by_mean = sum_up(centre, reach(&gradient));
            error = error.min(direct).min(by_mean);
            bound = bound.min(self.measured(error, value));
            if self.measure == Measure::Relative && value.mignitude() == 0.0 {
                // The quotient has no slopes.
                gradient.fill(Interval::ZERO);
            } else if self.measure == Measure::Relative {
                // The derivative of Σ/|f|.
                let size = if value.lo > 0.0 { value } else { -value };
                let total = Interval::new(0.0, error);
                let square = size.square();
                for j in 0..n {
                    let slope = if value.lo > 0.0 {
                        slopes[j]
                    } else {
                        -slopes[j]
                    };
                    gradient[j] = gradient[j] / size - total * slope / square;
                }
                let there = quotient_up(centre, self.centre.value[root].mignitude());
                bound = bound.min(sum_up(there, reach(&gradient)));
            }
        }
        let cut = self.cut(at, &gradient);
        // Where the bound only rises, or only falls, with an input, its worst is at an end.
        let mut face = at.to_vec();
        let mut is_face = false;
        for j in 0..n {
            let g = gradient[j];
            if at[j].is_point() || !(g.lo >= 0.0 || g.hi <= 0.0) || g.is_zero() {
                continue;
            }
            let end = if g.lo >= 0.0 { at[j].hi } else { at[j].lo };
            (face[j], is_face) = (Interval::point(end), true);
        }
        if is_face && bound > lower * 1.0001 {
            let noise = self.wide.noise.clone();
            self.wide.given.clone_from(&noise);
            // The face may lie where the condition fails.
            self.wide.narrowing = None;
            let found = self.within(&face);
            // The pass over the face may have ended before the result.
            self.wide.noise = noise;
            error = error.min(found.error);
            lower = lower.max(found.lower);
            bound = match self.measure {
                Measure::Relative => bound.min(found.bound),
                _ => bound.min(self.measured(error, value)),
            };
        }
        Found {
            bound: if bound.is_nan() { f64::INFINITY } else { bound },
            error,
            lower,
            cut,
            sign,
            value,
            why: (!bound.is_finite())
                .then_some("no bound of a derivative, or a value that may be zero"),
        }
    }

    /// The input across which the sum changes most, by its derivative and by those of the
    /// roundings.
    fn cut(&self, at: &[Interval], gradient: &[Interval]) -> usize {
        let n = at.len();
        let root = self.root;
        let mut best = (0.0, None);
        for j in 0..n {
            let width = at[j].hi - at[j].lo;
            if !(width > 0.0) {
                continue;
            }
            let mut change = gradient.get(j).map_or(0.0, |g| g.magnitude());
            for i in 0..=root {
                let noise = self.wide.noise[i];
                if noise > 0.0 {
                    let unit = self.program.setting.bits();
                    let slope = self.wide.slope[i * n + j].magnitude();
                    let rounding = slope * self.wide.adjoint[i].magnitude();
                    change += rounding * (0.5f64).powi(unit);
                }
            }
            let change = change * width;
            if change.is_finite() && change > best.0 {
                best = (change, Some(j));
            } else if !change.is_finite() {
                return widest(self.program, at);
            }
        }
        best.1.unwrap_or_else(|| widest(self.program, at))
    }
}
