//! A formula over a rectangle, and the bound that is proved for it there.

use crate::bound::Bound;
use crate::constants::{ASYMPTOTIC, MACLAURIN};
use crate::cover::Rectangle;
use crate::exact::Exact;
use crate::grid::{TINIEST, exponent, grain_of, power_of_two};
use crate::interval::{Interval, hypot_down, hypot_up, larger, product_up, quotient_up, sum_up};
use crate::tables::Tables;
use crate::tracked::{Result as Tracks, Rounding, Setting, Tracked, Tracking, evaluate};
use crate::truncation::{self, OfSum, Truncation};
use mechaudit_solvers::faddeeva::{Branch, proof as code};
use std::sync::PoisonError;

/// A formula, with the row of a table where it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Formula {
    /// Maclaurin series.
    Maclaurin {
        /// Terms.
        terms: u32,
    },
    /// The same on the imaginary axis.
    MaclaurinOnAxis,
    /// Taylor series about the centre of a cell.
    Cell {
        /// The centre.
        centre: (f64, f64),
    },
    /// Taylor series about a centre on the real axis.
    RealAxis {
        /// The centre.
        centre: f64,
    },
    /// Taylor series of erfcx on the imaginary axis.
    ImaginaryAxis {
        /// The centre.
        centre: f64,
    },
    /// Asymptotic series and `e^{−z²}` beside the real axis.
    Strip,
    /// The same next to the real axis.
    RealLine,
    /// Asymptotic series.
    Asymptotic {
        /// Terms.
        terms: u32,
    },
    /// The same on the imaginary axis.
    AsymptoticOnAxis {
        /// Terms.
        terms: u32,
    },
    /// The first term of it, scaled.
    Huge,
}

impl Formula {
    /// Its name in tables, without the centre.
    pub fn name(self) -> &'static str {
        match self {
            Formula::Maclaurin { terms: 9 } => "Maclaurin, 9 terms",
            Formula::Maclaurin { .. } => "Maclaurin, 21 terms",
            Formula::MaclaurinOnAxis => "Maclaurin, imaginary axis",
            Formula::Cell { .. } => "Taylor, cell",
            Formula::RealAxis { .. } => "Taylor, real axis",
            Formula::ImaginaryAxis { .. } => "Taylor, imaginary axis",
            Formula::Strip => "strip",
            Formula::RealLine => "real line",
            Formula::Asymptotic { terms: 26 } => "asymptotic, 26 terms",
            Formula::Asymptotic { terms: 14 } => "asymptotic, 14 terms",
            Formula::Asymptotic { terms: 6 } => "asymptotic, 6 terms",
            Formula::Asymptotic { terms: 4 } => "asymptotic, 4 terms",
            Formula::Asymptotic { .. } => "asymptotic, 2 terms",
            Formula::AsymptoticOnAxis { .. } => "asymptotic, imaginary axis",
            Formula::Huge => "scaled",
        }
    }

    /// The centre of its row.
    pub fn centre(self) -> Option<(f64, f64)> {
        match self {
            Formula::Cell { centre } => Some(centre),
            Formula::RealAxis { centre } => Some((centre, 0.0)),
            Formula::ImaginaryAxis { centre } => Some((0.0, centre)),
            _ => None,
        }
    }

    /// That of a branch of the solver, for those that have no rows.
    pub(crate) fn of(branch: Branch, on_axis: bool) -> Option<Formula> {
        Some(match (branch, on_axis) {
            (Branch::Maclaurin { .. }, true) => Formula::MaclaurinOnAxis,
            (Branch::Maclaurin { terms }, false) => Formula::Maclaurin { terms },
            (Branch::Strip { .. }, false) => Formula::Strip,
            (Branch::RealLine { .. }, false) => Formula::RealLine,
            // On the axis six terms serve for 4 and 2.
            (Branch::Asymptotic { terms }, true) => Formula::AsymptoticOnAxis {
                terms: terms.max(6),
            },
            (Branch::Asymptotic { terms }, false) => Formula::Asymptotic { terms },
            (Branch::Huge, _) => Formula::Huge,
            _ => return None,
        })
    }
}

/// Describes what a formula gives, with its truncation.
struct Evaluated {
    parts: [Tracks; 2],
    truncation: Truncation,
}

/// The bound of a formula over a rectangle.
///
/// # Errors
/// Why there is none.
pub(crate) fn bound(
    tables: &Tables,
    formula: Formula,
    at: &Rectangle,
    rounding: Rounding,
) -> Result<Bound, &'static str> {
    if formula == Formula::Huge {
        return scaled_bound(tables, at, rounding);
    }
    let (ways, truncation) = run(tables, formula, at, rounding)?;
    gathered(formula, at, ways, truncation)
}

/// That of one term, which the code computes at z divided by `2^k`, its largest coordinate then in
/// [1, 2), and divides by `2^k` again.
///
/// Both divisions take two steps. The first is exact but for a coordinate that becomes subnormal,
/// and then off by less than `2⁻¹⁰⁷³`, which the second makes nothing of. The second is exact but
/// where its result is subnormal, and off by at most two units of `2⁻¹⁰⁷⁵`. `e^{−z²}`, where it is
/// not one of the remainders of the norm, is less than a unit. Six units leave room.
fn scaled_bound(
    tables: &Tables,
    at: &Rectangle,
    rounding: Rounding,
) -> Result<Bound, &'static str> {
    let scaled = at.scaled().ok_or("several powers of two")?;
    let [p, q, r, s] = [scaled.a[0], scaled.a[1], scaled.b[0], scaled.b[1]].map(f64::to_bits);
    let key = ([p, q, r, s], rounding.fma_rounds_twice, rounding.truncates);
    let known = || tables.scaled.lock().unwrap_or_else(PoisonError::into_inner);
    let found = known().get(&key).copied();
    let mut bound = match found {
        Some(bound) => bound,
        None => {
            let (ways, truncation) = run(tables, Formula::Huge, &scaled, rounding)?;
            let bound = gathered(Formula::Huge, &scaled, ways, truncation)?;
            known().insert(key, bound);
            bound
        }
    };
    bound.tiny = 6.0;
    Ok(bound)
}

fn gathered(
    formula: Formula,
    at: &Rectangle,
    ways: Ways,
    truncation: Truncation,
) -> Result<Bound, &'static str> {
    let sigma = sigma(formula, at);
    let bound = |parts| Evaluated { parts, truncation }.bound(sigma);
    let worst = ways.into_iter().map(bound).reduce(Bound::max);
    worst.filter(|b| b.norm.is_finite()).ok_or("w may be zero")
}

/// The range of the small coordinate.
fn sigma(formula: Formula, at: &Rectangle) -> Interval {
    let [re, im] = small(formula, at);
    match (re, im) {
        (true, _) => Interval::new(at.a[0], at.a[1]),
        (_, true) => Interval::new(at.b[0], at.b[1]),
        _ => Interval::ZERO,
    }
}

/// Returns whether Re z, or Im z, is handled as a factor.
fn small(formula: Formula, at: &Rectangle) -> [bool; 2] {
    match formula {
        Formula::Cell { centre } => [centre.0 == 0.0, false],
        Formula::Maclaurin { .. } => [true, false],
        Formula::Asymptotic { .. } | Formula::Huge => [at.small_re(), at.small_im()],
        // Re w is a multiple of Im z there, or e^{−z²} added to one.
        Formula::Strip | Formula::RealLine => [false, true],
        _ => [false, false],
    }
}

type Ways = Vec<[Tracks; 2]>;

fn run(
    tables: &Tables,
    formula: Formula,
    at: &Rectangle,
    rounding: Rounding,
) -> Result<(Ways, Truncation), &'static str> {
    let [small_re, small_im] = small(formula, at);
    let setting = |constants| Setting {
        sigma: Exact::coordinate(sigma(formula, at), usize::from(!small_re)),
        ..Setting::new(constants, rounding)
    };
    let coordinate = |small: bool, i: usize, ends: [f64; 2]| match small {
        true => Tracked::sigma(),
        false => Tracked::input(i, ends),
    };
    let both = |(re, im): (Tracked, Tracked)| [re.result(), im.result()];
    let real = |re: Tracked| [re.result(), Tracked::entry(0.0).result()];
    let far = hypot_up(at.a[1], at.b[1]);
    let series = |setting, f: fn(Tracked, Tracked) -> (Tracked, Tracked)| {
        evaluate(setting, || {
            let a = coordinate(small_re, 0, at.a);
            both(f(a, coordinate(small_im, 1, at.b)))
        })
    };
    Ok(match formula {
        Formula::Maclaurin { terms } => {
            let f = match terms {
                9 => code::nine_terms::<Tracked>,
                _ => code::twenty_one_terms::<Tracked>,
            };
            (
                series(setting(&MACLAURIN), f)?,
                truncation::maclaurin(terms - 1, far),
            )
        }
        Formula::MaclaurinOnAxis => {
            let ways = evaluate(setting(&MACLAURIN), || {
                real(code::nine_terms_on_imaginary_axis(Tracked::input(1, at.b)))
            })?;
            (ways, truncation::maclaurin(8, at.b[1]))
        }
        Formula::Cell { centre } => {
            let (row, errors) = tables.cell(centre)?;
            let (x, y) = (offsets(at.a, centre.0)?, offsets(at.b, centre.1)?);
            if small_re && !errors.is_symmetric() {
                return Err("a component that is zero is not stored as zero");
            }
            let ways = evaluate(setting(&[]), || {
                let dx = if small_re {
                    Tracked::sigma()
                } else {
                    x.tracked(0)
                };
                both(code::complex_row(Tracking, row, dx, y.tracked(1)))
            })?;
            (ways, errors.within(x.most(), y.most()))
        }
        Formula::RealAxis { centre } => {
            let (row, errors) = tables.real_axis(centre)?;
            let x = offsets(at.a, centre)?;
            let ways = evaluate(setting(&[]), || {
                let b = Tracked::input(1, at.b);
                both(code::real_axis_value(Tracking, row, x.tracked(0), b))
            })?;
            (ways, errors.within(x.most(), at.b[1]))
        }
        Formula::ImaginaryAxis { centre } => {
            let (row, errors) = tables.imaginary_axis(centre)?;
            let y = offsets(at.b, centre)?;
            let ways = evaluate(setting(&[]), || {
                real(code::imaginary_axis_value(Tracking, row, y.tracked(1)))
            })?;
            (ways, errors.within(0.0, y.most()))
        }
        Formula::Strip => (
            series(setting(&ASYMPTOTIC), code::in_strip::<Tracked>)?,
            truncation::strip(at),
        ),
        Formula::RealLine => {
            let ways = series(setting(&ASYMPTOTIC), code::on_real_line::<Tracked>)?;
            (
                ways,
                truncation::on_real_line(at, tables.real_line, tables.exponential),
            )
        }
        Formula::Asymptotic { terms } => {
            let f = match terms {
                26 => code::asymptotic::<Tracked, 26>,
                14 => code::asymptotic::<Tracked, 14>,
                6 => code::asymptotic::<Tracked, 6>,
                4 => code::asymptotic::<Tracked, 4>,
                2 => code::two_terms::<Tracked>,
                _ => return Err("no such number of terms"),
            };
            (
                series(setting(&ASYMPTOTIC), f)?,
                truncation::asymptotic(terms, at),
            )
        }
        Formula::AsymptoticOnAxis { terms } => {
            let f = match terms {
                26 => code::asymptotic_on_imaginary_axis::<Tracked, 26>,
                14 => code::asymptotic_on_imaginary_axis::<Tracked, 14>,
                6 => code::asymptotic_on_imaginary_axis::<Tracked, 6>,
                _ => return Err("no such number of terms"),
            };
            let ways = evaluate(setting(&ASYMPTOTIC), || real(f(Tracked::input(1, at.b))))?;
            (ways, truncation::asymptotic(terms, at))
        }
        Formula::Huge => (
            series(setting(&ASYMPTOTIC), code::one_term::<Tracked>)?,
            truncation::huge(),
        ),
    })
}

/// The distances of numbers from a centre, which the code computes without rounding.
pub(crate) struct Offsets {
    pub ends: [f64; 2],
    pub grain: i32,
}

impl Offsets {
    pub fn tracked(&self, i: usize) -> Tracked {
        Tracked::input_on_grid(i, self.ends, self.grain)
    }

    pub fn most(&self) -> f64 {
        self.ends[0].abs().max(self.ends[1].abs())
    }
}

/// # Errors
/// If a difference may be rounded: the numbers and the centre are multiples of `2^g`, so that a
/// difference below `2^{g+53}` is exact.
pub(crate) fn offsets([lo, hi]: [f64; 2], centre: f64) -> Result<Offsets, &'static str> {
    if centre == 0.0 {
        return Ok(Offsets {
            ends: [lo, hi],
            grain: grain_of(lo),
        });
    }
    let grain = grain_of(lo).min(grain_of(centre));
    let ends = [lo - centre, hi - centre];
    let most = ends[0].abs().max(ends[1].abs());
    match most == 0.0 || exponent(most) < grain + 53 {
        true => Ok(Offsets { ends, grain }),
        false => Err("the distance from a centre is rounded"),
    }
}

impl Evaluated {
    fn bound(&self, sigma: Interval) -> Bound {
        let t = &self.truncation;
        let absolute = |r: &Tracks, error: f64| match r.small {
            true => product_up(error, sigma.hi),
            false => error,
        };
        let [re, im] = &self.parts;
        let rounding = hypot_up(absolute(re, re.error), absolute(im, im.error));
        let error = sum_up(rounding, t.norm);
        let least = |r: &Tracks| match r.small {
            true => (r.exact.mignitude() * sigma.lo).next_down().max(0.0),
            false => r.exact.mignitude(),
        };
        let size = (hypot_down(least(re), least(im)) - t.norm).next_down();
        let mut norm = quotient_up(error, size) * TWO_52;
        let (re_tiny, im_tiny) = (sum_up(re.tiny, t.tiny), sum_up(im.tiny, t.tiny));
        let lost = product_up(sum_up(re_tiny, im_tiny), TINIEST);
        if size > FAR_ABOVE {
            norm = sum_up(norm, quotient_up(lost, size) * TWO_52).next_up();
        }
        let part = |(units, least): (f64, f64), tiny: f64| match least > FAR_ABOVE {
            true => (sum_up(units, lost_units(tiny, least)), 0.0),
            false => (units, tiny),
        };
        let re = match t.sum {
            None => component(re, t.re, t.norm, sigma),
            Some(sum) => of_sum(re, &sum, sigma),
        };
        let (re, p) = part(re, re_tiny);
        let (im, q) = part(component(im, t.im, t.norm, sigma), im_tiny);
        Bound {
            norm,
            re,
            im,
            tiny: larger(p, q),
        }
    }
}

/// 2⁻⁹⁶⁰: a unit in the last place of what is above it is at least 2⁻¹⁰¹², 2⁶³ times the unit of
/// what underflows.
pub(crate) const FAR_ABOVE: f64 = f64::from_bits((1023 - 960) << 52);

/// Returns what underflows, in units in the last place of the least value.
pub(crate) fn lost_units(tiny: f64, least: f64) -> f64 {
    let ulp = power_of_two(exponent(least) - 52);
    quotient_up(product_up(tiny, TINIEST), ulp)
}

pub(crate) const TWO_52: f64 = 4_503_599_627_370_496.0;

/// That of the real part beside the real axis, `y u` where the formula leaves `e^{−z²}` out,
/// `y u + E` where it adds it: a sum of positive terms is wrong by no larger a part of it than one
/// of them.
fn of_sum(r: &Tracks, t: &OfSum, sigma: Interval) -> (f64, f64) {
    const NOT_PROVED: (f64, f64) = (f64::INFINITY, 0.0);
    let (off, size, least) = if r.small {
        if !(r.exact.lo > 0.0) {
            return NOT_PROVED;
        }
        // All divided by y: ρ u + |u − U| + E/y, and U − E/y.
        let u = r.exact.hi;
        let left = quotient_up(t.most, sigma.lo);
        let off = sum_up(product_up(r.relative, u), sum_up(t.slope, left));
        let off = off.min(sum_up(r.error, sum_up(t.slope, left)));
        let size = (r.exact.lo - sum_up(t.slope, left)).next_down();
        (off, size, (size * sigma.lo).next_down())
    } else {
        let slope = quotient_up(t.slope, (t.least - t.slope).next_down());
        let formula = larger(slope, t.exponential);
        let off = sum_up(product_up(r.relative, sum_up(1.0, formula)), formula);
        (off, 1.0, (r.exact.lo * 0.99).max(0.0))
    };
    if !(size > 0.0 && off.is_finite()) {
        return NOT_PROVED;
    }
    // A unit in the last place is more than 2⁻⁵³ of the value.
    (quotient_up(off, size) * (2.0 * TWO_52), least)
}

/// The error of a component in units in the last place of its value, without what underflows, and
/// the least value.
fn component(r: &Tracks, truncated: f64, norm: f64, sigma: Interval) -> (f64, f64) {
    if r.exact.is_zero() && r.error == 0.0 {
        return (0.0, f64::INFINITY);
    }
    // Without the factor σ the bound of the absolute value serves too.
    let truncated = if r.small {
        truncated
    } else {
        truncated.min(norm)
    };
    let error = sum_up(r.error, truncated);
    let least = (r.exact.mignitude() - truncated).next_down();
    if !(least > 0.0 && error.is_finite()) {
        return (f64::INFINITY, 0.0);
    }
    let ulp = |x: f64| power_of_two((exponent(x) - 52).max(-1074));
    if !r.small {
        return (quotient_up(error, ulp(least)), least);
    }
    // A unit in the last place is more than 2⁻⁵³ of the value.
    let relative = quotient_up(error, least) * (2.0 * TWO_52);
    let smallest = (least * sigma.lo).next_down().max(0.0);
    let by_size = match smallest > 0.0 {
        true => quotient_up(product_up(error, sigma.hi), ulp(smallest)),
        false => f64::INFINITY,
    };
    (relative.min(by_size), smallest)
}

#[cfg(test)]
mod tests;
