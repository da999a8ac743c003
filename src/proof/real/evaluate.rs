//! A formula over an interval, and the bound that is proved for it there.

use super::choice::{Formula, Inner};
use super::tables::Tables;
use super::{Function, Interval};
use crate::bounds::{exp_up, remainder};
use crate::constants::ASYMPTOTIC;
use crate::exact::Exact;
use crate::formula::{FAR_ABOVE, TWO_52, lost_units, offsets};
use crate::grid::{TINIEST, exponent, power_of_two};
use crate::interval::{Interval as Enclosure, larger, product_up, quotient_up, sum_up};
use crate::program::pass::joined;
use crate::tracked::{Constant, Result as Tracks, Rounding, Setting, Tracked, Tracking, evaluate};
use crate::truncation::ErfcRow;
use mechaudit_reference::faddeeva;
use mechaudit_solvers::faddeeva::proof::ROUND;
use mechaudit_solvers::faddeeva::proof::real_line as code;
use rug::Rational;
use rug::float::Round;

/// Describes what a formula gives before its last rounding.
struct Way {
    /// The sum of the two numbers.
    sum: Tracks,
    /// That of erfcx among its operands.
    inner: Option<Tracks>,
    /// The binary exponent of a power of two to be multiplied with.
    exponent: Option<f64>,
}

impl Way {
    /// Returns whether the product with its power of two is no subnormal number anywhere.
    fn is_normal(&self) -> bool {
        let least = || f64::from(exponent(self.sum.exact.mignitude()));
        self.exponent.is_none_or(|n| n + least() > -1022.0)
    }
}

/// erf, erfc, erfcx, or `(2/√π) F`, over an interval.
struct Operand<'a> {
    function: Function,
    way: By<'a>,
    /// Holds what the formula without rounding is wrong by at most.
    off: f64,
}

/// How it is computed: from a row about a centre, the distance a multiple of `2^grain`, or by an
/// asymptotic series.
enum By<'a> {
    Row(&'a [f64], f64, i32),
    ErfcRow(&'a ErfcRow, i32),
    Series(u32),
}

impl<'a> Operand<'a> {
    fn new(
        tables: &'a Tables,
        function: Function,
        inner: Inner,
        ends: [f64; 2],
    ) -> Result<Operand<'a>, &'static str> {
        Ok(match inner {
            Inner::Row { centre } => {
                let t = offsets(ends, centre.abs())?;
                if matches!(function, Function::Erfc | Function::Erfcx) {
                    let row = tables.complement(centre)?;
                    return Ok(Operand {
                        function,
                        way: By::ErfcRow(row, t.grain),
                        off: row.within(t.most(), code::erfc_terms()),
                    });
                }
                let (row, errors) = tables.row(centre)?;
                Operand {
                    function,
                    way: By::Row(row, centre, t.grain),
                    off: errors.within(t.most(), 0.0).norm,
                }
            }
            Inner::Series { terms } if matches!(terms, 2 | 6 | 14 | 26) => Operand {
                function,
                way: By::Series(terms),
                off: remainder(terms + 1, ends[0]),
            },
            Inner::Series { .. } => return Err("no such number of terms"),
        })
    }

    /// Those of the series: the others stand for themselves.
    fn constants(&self) -> &'static [Constant] {
        match self.way {
            By::Series(_) => &ASYMPTOTIC,
            _ => &[],
        }
    }

    fn at(&self, x: Tracked) -> [Tracked; 2] {
        let dawson = self.function == Function::Dawson;
        let distance = |centre: f64, grain| match centre == 0.0 {
            true => x,
            false => x.offset(centre, grain),
        };
        let terms = match self.way {
            By::Row(row, centre, grain) => {
                let value = code::row_value(Tracking, row, distance(centre, grain));
                return match dawson {
                    true => code::dawson_beyond(value),
                    false => value,
                };
            }
            By::ErfcRow(at, grain) => {
                let [row, [c, ..]] = [at.row, [at.centre; 4]].map(|r| r.map(Tracked::entry));
                let t = distance(at.centre.abs(), grain);
                let [hi, lo, ..] = row;
                return match (at.scaled, at.centre.is_sign_negative()) {
                    (false, _) => code::erfc_value(row, c, t),
                    (true, false) => code::erfcx_value([hi, lo], c, t),
                    (true, true) => code::erfcx_value([hi, lo], c, -t),
                };
            }
            By::Series(terms) => terms,
        };
        let series = match (terms, dawson) {
            (2, true) => code::dawson_series::<Tracked, 2>,
            (6, true) => code::dawson_series::<Tracked, 6>,
            (14, true) => code::dawson_series::<Tracked, 14>,
            (_, true) => code::dawson_series::<Tracked, 26>,
            (2, false) => code::erfcx_series::<Tracked, 2>,
            (6, false) => code::erfcx_series::<Tracked, 6>,
            (14, false) => code::erfcx_series::<Tracked, 14>,
            (_, false) => code::erfcx_series::<Tracked, 26>,
        };
        series(x)
    }

    /// Returns what it is wrong by without rounding, as a part of it, from its enclosure.
    fn part(&self, value: &Tracks) -> f64 {
        // (2/√π) F, from F.
        let factor = if self.function == Function::Dawson {
            1.128
        } else {
            1.0
        };
        left_out(self.off, (value.exact.mignitude() * factor).next_down())
    }
}

/// Returns what a value of at least `least` is wrong by, as a part of the true one, if it is by
/// `off`.
fn left_out(off: f64, least: f64) -> f64 {
    quotient_up(off, (least - off).next_down())
}

fn sum_of([hi, lo]: [Tracked; 2]) -> Tracks {
    hi.exact_sum(lo)
}

/// The formula that is used, infinity included, and its bound over an interval:
/// `|computed − f| ≤ C ulp(f)`, where `ulp(f)` is at least the smallest number.
///
/// # Errors
/// Why there is none.
pub(super) fn bound(
    tables: &Tables,
    function: Function,
    formula: Formula,
    at: &Interval,
    rounding: Rounding,
) -> Result<(Formula, f64), &'static str> {
    let ends = at.ends;
    let setting = |constants| Setting::new(constants, rounding);
    let x = || Tracked::input(0, ends);
    let [two_over_root, half_root, inverse_root] = tables.constants;
    let exponential = tables.exponential;
    let next_to_zero = || Setting {
        sigma: Exact::coordinate(Enclosure::new(ends[0], ends[1]), 0),
        ..setting(&[])
    };
    let one = |ways: Result<Vec<Way>, &'static str>, part: &dyn Fn(&Way) -> f64| {
        let mut worst = 0.0;
        for way in ways? {
            let normal = way.is_normal();
            worst = larger(worst, rounded(&way.sum, at, part(&way), normal, rounding)?);
        }
        Ok((formula, worst))
    };
    let alone = |sum| Way {
        sum,
        inner: None,
        exponent: None,
    };
    match formula {
        Formula::Near if ends[1] < SMALL => Ok((formula, ROUNDINGS)),
        Formula::Near => {
            let ways = evaluate(next_to_zero(), || {
                alone(sum_of(code::dawson_near(Tracked::sigma())))
            });
            one(ways, &|_| tables.near)
        }
        // Next to zero erf is x times a number that is known as well as a part of itself.
        Formula::Value(Inner::Row { centre: 0.0 }) if function == Function::Erf => {
            if ends[1] < SMALL {
                return Ok((formula, underflowing(ends, two_over_root)));
            }
            let operand = Operand::new(tables, function, Inner::Row { centre: 0.0 }, ends)?;
            let ways = evaluate(next_to_zero(), || {
                alone(sum_of(operand.at(Tracked::sigma())))
            });
            // Divided by x, what the row is wrong by grows with x, and erf x falls.
            one(ways, &|way| {
                let least = (way.sum.exact.mignitude() * ends[1]).next_down();
                left_out(operand.off, least)
            })
        }
        Formula::Value(inner) => {
            let operand = Operand::new(tables, function, inner, ends)?;
            let ways = evaluate(setting(operand.constants()), || {
                alone(sum_of(operand.at(x())))
            });
            let factor = match function {
                Function::Dawson => half_root,
                _ => 0.0,
            };
            one(ways, &|way| joined(operand.part(&way.sum), factor))
        }
        Formula::Product(inner) | Formula::Difference(inner) => {
            let operand = Operand::new(tables, function, inner, ends)?;
            let ways = evaluate(setting(operand.constants()), || {
                let x = x();
                let w = operand.at(x);
                let inner = Some(sum_of(w));
                let (sum, n) = match formula {
                    Formula::Product(_) => {
                        let (t, n) = code::erfc_right(x, w);
                        (t, n.constant().map(|n| n - ROUND))
                    }
                    _ => (code::erfc_left(w), None),
                };
                let sum = sum_of(sum);
                Way {
                    sum,
                    inner,
                    exponent: n,
                }
            });
            // erfc x is less than what it is taken from leaves.
            let exponential = match formula {
                Formula::Product(_) => exponential,
                _ => 0.0,
            };
            one(ways, &|way| {
                let inner = way
                    .inner
                    .as_ref()
                    .map_or(f64::INFINITY, |w| operand.part(w));
                joined(exponential, inner)
            })
        }
        Formula::Exponential => {
            let ways = evaluate(setting(&[]), || {
                let (e, n) = code::exponential(x());
                Way {
                    sum: sum_of(e),
                    inner: None,
                    exponent: n.constant().map(|n| n - ROUND + 1.0),
                }
            });
            if overflows(ways.as_deref().map_err(|why| *why)?, at)? {
                return Ok((Formula::Overflow, 0.0));
            }
            one(ways, &|way| joined(exponential, erfcx_beside(way.exponent)))
        }
        Formula::Far => {
            // R₁ is less than 1/x² of the first term, and x at least 10⁹⁹.
            if !(ends[0] >= 1e99) {
                return Err("one term is not enough");
            }
            let rest = 1e-190;
            if function == Function::Dawson {
                // The quotient is rounded once.
                return Ok((formula, sum_up(0.5, rest * TWO_52 * 2.0)));
            }
            let (scaled, k) = scaled(ends).ok_or("several powers of two")?;
            let ways = evaluate(setting(&[]), || Way {
                sum: sum_of(code::erfcx_far(Tracked::input(0, scaled))),
                inner: None,
                exponent: Some(f64::from(-k)),
            });
            one(ways, &|_| joined(inverse_root, rest))
        }
        Formula::Constant => {
            // erfc x ≤ e^{−x²}/(√π x)
            let x = ends[0];
            let erfc = quotient_up(exp_up(-(x * x).next_down()), (x * 1.77).next_down());
            Ok((
                formula,
                match (function, at.negative) {
                    (Function::Erf, _) if x > 1.0 => product_up(erfc, 2.0 * TWO_52),
                    (Function::Erfc, true) if x > 1.0 => product_up(erfc, TWO_52),
                    // Below half the smallest number, 2⁻¹⁰⁷⁵ > e^{−745.2}.
                    (Function::Erfc, false) if x * x > 745.2 => 0.5,
                    _ => return Err("not a constant there"),
                },
            ))
        }
        // 2e^{x²} − 1 is above 2¹⁰²⁴ = e^{709.8}.
        Formula::Overflow if ends[0] * ends[0] > 710.0 => Ok((formula, 0.0)),
        Formula::Overflow => Err("no overflow there"),
    }
}

/// `erfcx x < 1` as a part of `2ᵏ` and more.
fn erfcx_beside(k: Option<f64>) -> f64 {
    match k {
        Some(k) if (0.0..2000.0).contains(&k) => power_of_two(1 - k.min(900.0) as i32),
        _ => f64::INFINITY,
    }
}

/// Numbers of one binade divided by its power of two, and the exponent.
fn scaled(ends: [f64; 2]) -> Option<([f64; 2], i32)> {
    let [k, last] = ends.map(exponent);
    let down = power_of_two(-k);
    (k == last).then(|| (ends.map(|x| x * down), k))
}

/// Returns whether the value is above the range all over the interval; it may not be within `2⁻⁵⁰`
/// of its end.
fn overflows(ways: &[Way], at: &Interval) -> Result<bool, &'static str> {
    const BOTH: &str = "on both sides of overflow";
    if at.is_point() {
        // x² itself is known to too few digits.
        let x = Rational::from_f64(-at.ends[0]).ok_or("not finite")?;
        let value = faddeeva::erfcx(&x, &Rational::new(), 120)
            .map_err(|_| "undecided")?
            .re;
        let part = value.shift(-1024);
        let lower = part.lower().to_f64_round(Round::Down);
        let upper = part.upper().to_f64_round(Round::Up);
        return above_one([lower, upper]).ok_or(BOTH);
    }
    let mut all = None;
    for way in ways {
        let k = way.exponent.ok_or("the exponent is open")? - 1024.0;
        if !(k.abs() < 1000.0) {
            return Err("an exponent beyond 2000");
        }
        let by = power_of_two(k as i32);
        let Enclosure { lo, hi } = way.sum.exact;
        let over = above_one([lo * by, hi * by]).ok_or(BOTH)?;
        if *all.get_or_insert(over) != over {
            return Err(BOTH);
        }
    }
    all.ok_or("no way")
}

/// Decides whether all numbers between the two are above 1, or none, by `2⁻⁵⁰` at least.
fn above_one([lo, hi]: [f64; 2]) -> Option<bool> {
    let margin = power_of_two(-50);
    match (lo > 1.0 + margin, hi < 1.0 - margin) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

/// The bound, in units in the last place of f, of a sum y of two numbers that is rounded to
/// nearest, where y without rounding is wrong by `part` of f.
///
/// With `|y − f| ≤ e ulp(f)`, `e ≤ 1`, the rounded y is within `½ + e` units of f: where y and f
/// are in the same binade it is within half a unit of y; where y is below and f is not, y has the
/// smaller unit; where f is below 2^k and y is not, y is rounded to 2^k, which lies between them.
///
/// If it is then multiplied by a power of two and the product may be subnormal, it is rounded once
/// more there, by half a unit. The first rounding and e are half as many units then: `¾ + e/2`.
/// Where f is the least normal number or above and y is below, or the other way round, the result
/// is that number if `e < ¼`.
fn rounded(
    y: &Tracks,
    at: &Interval,
    part: f64,
    normal: bool,
    rounding: Rounding,
) -> Result<f64, &'static str> {
    let of_m = y.relative.min(quotient_up(y.error, y.exact.mignitude()));
    // A unit in the last place is more than 2⁻⁵³ of the value.
    let mut e = product_up(joined(of_m, part), 2.0 * TWO_52);
    if y.tiny > 0.0 {
        let factor = if y.small { at.ends[0] } else { 1.0 };
        let least = (y.exact.mignitude() * factor * 0.999).next_down();
        if !(least > FAR_ABOVE) {
            return Err("digits are lost to underflow");
        }
        e = sum_up(e, lost_units(y.tiny, least));
    }
    if !(e <= if normal { 1.0 } else { 0.25 }) {
        return Err("the sum is off by a unit in its last place");
    }
    let last = match rounding.truncates {
        Some(Rounding::LAST) => 1.0,
        _ => 0.5,
    };
    let once = sum_up(last, e);
    Ok(match normal {
        true => once,
        false => larger(once, sum_up(sum_up(0.25, last), 0.5 * e)),
    })
}

/// Below this x² is no `f64` but zero.
pub(super) const SMALL: f64 = f64::from_bits((1023 - 950) << 52);

/// Returns whether the product of x with 2/√π as stored is at least 2⁻¹⁰²¹; exactly, as the
/// difference of 2¹⁰⁰⁰ times as much is not rounded to zero.
pub(super) fn beyond_subnormal(x: f64) -> bool {
    let [c, _] = code::constants()[0];
    (x * power_of_two(1000)).mul_add(c, -power_of_two(-21)) >= 0.0
}

/// A bound of what roundings and omitted terms below `2⁻⁹⁵⁰` add, in units.
const ROUNDINGS: f64 = 1e-15;

/// The bound of erf where `x < 2⁻⁹⁵⁰`. There `x²` and with it all that follows the first term is
/// zero in the code, so that erf x is `x (C + c)`, (C, c) the two parts of 2/√π:
///
/// ```text
/// p = RN(x C),  q = RN(x C − p),  t = RN(x c),  erf = RN(p + RN(q + t))
/// ```
///
/// In units of 2⁻¹⁰⁷⁵, of which subnormal numbers have an even number: where `x C < 2⁻¹⁰²¹` p is
/// off by 1, so that q = 0, and t = 0. From there on a unit in the last place of erf x is at least
/// 4; q is off by 1, t by 1 or by all of it, if that is less, and what is rounded of `q + t`, below
/// 2⁻⁵¹ of p, does not count.
fn underflowing(ends: [f64; 2], constant: f64) -> f64 {
    const C_LOW: f64 = 1.54e-17;
    let part = product_up(constant, 2.0 * TWO_52);
    if !beyond_subnormal(ends[1]) {
        // c x is at most 1.4 · 10⁻¹⁷ of the value.
        return sum_up(sum_up(0.5, product_up(1.4e-17, 2.0 * TWO_52)), part);
    }
    let ulp = exponent(ends[0] * 1.128).max(-1021) - 52;
    let units = (ends[1] / TINIEST * (2.0 * C_LOW)).next_up();
    let off = sum_up(1.0, units.min(1.0));
    let off = product_up(off, 0.5 * (TINIEST / power_of_two(ulp)));
    sum_up(sum_up(0.5, off), sum_up(part, ROUNDINGS))
}

#[cfg(test)]
mod tests;
