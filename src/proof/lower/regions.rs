//! Which formulas the code may use on a rectangle of the lower half-plane, and the bound of each.

use super::exponential::{Exponential, Factors};
use super::reflection::{Value, decay, overflows, reflected, reflected_off_zeros};
use crate::ProofError;
use crate::choice::{SEVERAL, by_centre, choices};
use crate::constants::{ASYMPTOTIC, MACLAURIN};
use crate::cover::Rectangle;
use crate::formula::offsets;
use crate::interval::{down, hypot_up, worst};
use crate::tables::{Tables, cell_at, disc_at, real_axis_at};
use crate::tracked::{Result as Tracks, Rounding, Setting, Tracked, Tracking, evaluate};
use crate::truncation;
use mechaudit_solvers::faddeeva::Branch;
use mechaudit_solvers::faddeeva::proof::{self as upper, lower as code};

/// The code whose error is bounded.
#[derive(Clone)]
pub struct Code {
    /// Its rows, and what its series are wrong by.
    pub tables: Tables,
    /// Which formula is used at `a − i b`.
    pub formula: fn(f64, f64) -> Branch,
    /// The exponential.
    pub exponential: Exponential,
    /// The limits of the reflection.
    pub limits: code::Limits,
    /// How operations round.
    pub rounding: Rounding,
}

impl Code {
    /// The solver's.
    ///
    /// # Errors
    /// If the reference is undecided about a coefficient, or there is no bound of the exponential.
    pub fn of_the_solver() -> std::result::Result<Code, ProofError> {
        Ok(Code {
            tables: Tables::of_the_solver()?,
            formula: code::formula,
            exponential: Exponential::of(&Factors::default())?,
            limits: code::LIMITS,
            rounding: Rounding::default(),
        })
    }
}

/// A formula of the lower half-plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Region {
    /// Maclaurin series.
    Maclaurin {
        /// Terms.
        terms: u32,
    },
    /// Taylor series about the centre of a cell of the lower half-disc.
    Disc {
        /// The centre.
        centre: (f64, f64),
    },
    /// Taylor series about a centre on the real axis.
    RealAxis {
        /// The centre.
        centre: f64,
    },
    /// Asymptotic series and `e^{−z²}` beside the real axis.
    Strip,
    /// The same next to the real axis.
    RealLine,
    /// A cell of the upper half-plane, reflected in pairs.
    Cell {
        /// The centre.
        centre: (f64, f64),
    },
    /// An asymptotic series, reflected in pairs.
    Asymptotic {
        /// Terms.
        terms: u32,
    },
    /// `w(−z)` much larger than `2e^{−z²}`, or much smaller: an inequality.
    Dominated,
}

impl Region {
    /// Returns whether `2e^{−z²}` is added to a formula for w(−z), both as pairs.
    pub(super) fn is_reflected(self) -> bool {
        matches!(self, Region::Cell { .. } | Region::Asymptotic { .. })
    }

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Region::Maclaurin { terms: 9 } => "Maclaurin, 9 terms",
            Region::Maclaurin { .. } => "Maclaurin, 21 terms",
            Region::Disc { .. } => "Taylor, lower half-disc",
            Region::RealAxis { .. } => "Taylor, real axis",
            Region::Strip => "strip",
            Region::RealLine => "real line",
            Region::Cell { .. } => "cell, both terms",
            Region::Asymptotic { terms: 26 } => "26 terms, both terms",
            Region::Asymptotic { terms: 14 } => "14 terms, both terms",
            Region::Asymptotic { .. } => "6 terms, both terms",
            Region::Dominated => "one term dominates",
        }
    }
}

/// More than these, and a rectangle is halved.
const MANY: usize = 8;

/// The rank of a formula along the rings below the axis.
fn rank(b: Branch) -> Option<usize> {
    Some(match b {
        Branch::Maclaurin { terms: 9 } => 0,
        Branch::Maclaurin { .. } => 1,
        Branch::LowerCell { .. } => 2,
        Branch::Cell { .. } => 3,
        Branch::RealAxis { .. } | Branch::Asymptotic { terms: 26 } => 4,
        Branch::Strip { .. } | Branch::RealLine { .. } => 5,
        Branch::Asymptotic { terms: 14 } => 6,
        Branch::Asymptotic { terms: 6 } => 7,
        Branch::Huge => 8,
        _ => return None,
    })
}

/// The formulas that the code may use on a rectangle of `a − i b`, each with its piece; none where
/// w overflows.
///
/// As above the axis: the choice is made by |z|² and by lines.
pub(super) fn regions(
    code: &Code,
    at: &Rectangle,
) -> Result<Vec<(Rectangle, Region)>, &'static str> {
    let mut out = Vec::new();
    for (piece, branch) in choices(at, code.formula, rank)? {
        with_rows(code, &piece, branch, &mut out)?;
    }
    match out.len() > MANY {
        true => Err(SEVERAL),
        false => Ok(out),
    }
}

fn with_rows(
    code: &Code,
    at: &Rectangle,
    branch: Branch,
    out: &mut Vec<(Rectangle, Region)>,
) -> Result<(), &'static str> {
    // |decay| as computed is off by less than 2⁻⁵⁰ of |z|² < 112.
    let limit = code.limits.dominant;
    let of = decay(at);
    let above = of.lo > limit + 1e-12;
    let dominated = above || of.hi < -limit - 1e-12;
    let may_dominate = of.hi > limit - 1e-12 || of.lo < -limit + 1e-12;
    match branch {
        Branch::Maclaurin { terms } => out.push((*at, Region::Maclaurin { terms })),
        Branch::LowerCell { .. } => {
            for (at, centre) in by_centre(at, |a, b| disc_at(a, b).0) {
                out.push((at, Region::Disc { centre }));
            }
        }
        Branch::RealAxis { .. } => {
            for (at, (centre, _)) in by_centre(at, |a, _| (real_axis_at(a).0, 0.0)) {
                out.push((at, Region::RealAxis { centre }));
            }
        }
        Branch::Strip { .. } => out.push((*at, Region::Strip)),
        Branch::RealLine { .. } => out.push((*at, Region::RealLine)),
        Branch::Cell { .. } => {
            if may_dominate {
                out.push((*at, Region::Dominated));
            }
            if !dominated {
                for (at, centre) in by_centre(at, |a, b| cell_at(a, b).0) {
                    out.push((at, Region::Cell { centre }));
                }
            }
        }
        Branch::Asymptotic { terms: 26 } if above => out.push((*at, Region::Dominated)),
        Branch::Asymptotic { terms } => {
            if terms == 26 && of.hi > limit - 1e-12 {
                out.push((*at, Region::Dominated));
            }
            if !overflows(at) {
                out.push((*at, Region::Asymptotic { terms }));
            }
        }
        // |z|² ≥ 10²⁰⁰: `huge`.
        Branch::Huge => (),
        _ => return Err("an unknown branch"),
    }
    Ok(())
}

/// The bound of the norm on a rectangle, in units of 2⁻⁵².
///
/// # Errors
/// Why there is none.
pub(super) fn bound(code: &Code, region: Region, at: &Rectangle) -> Result<f64, &'static str> {
    // Not by rectangles.
    if region == Region::Dominated {
        return Ok(0.0);
    }
    let rho = code.exponential.pair;
    let norm = |w: &Value| match region {
        _ if !region.is_reflected() => w.norm(),
        // Beside the first zeros there is room for a better one.
        Region::Cell { .. } => match reflected(*w, at, rho, used(&code.limits)) {
            k if k > 2.0 => k.min(reflected_off_zeros(*w, at, rho)),
            k => k,
        },
        _ => reflected(*w, at, rho, used(&code.limits)),
    };
    let ways = values(code, region, at)?;
    Ok(worst(ways.iter().map(norm)))
}

/// The part λ of `|w(−z)|` that |w| has at least where its value is used: neither component is
/// below [`Limits::cancelled`] of that of w(−z), and one is above [`Limits::both_cancelled`] of the
/// larger one, which is at least `|w(−z)|/√2`.
///
/// [`Limits::cancelled`]: code::Limits::cancelled
/// [`Limits::both_cancelled`]: code::Limits::both_cancelled
fn used(limits: &code::Limits) -> f64 {
    /// 1/√2, rounded down.
    const HALF_ROOT: f64 = 0.707_106_781_186_547_4;
    limits
        .cancelled
        .max(down(limits.both_cancelled * HALF_ROOT))
}

/// Returns what the formula gives, on each way through its decisions; of the reflected ones w(−z).
fn values(code: &Code, region: Region, at: &Rectangle) -> Result<Vec<Value>, &'static str> {
    let y = [-at.b[1], -at.b[0]];
    let setting = |constants| Setting::new(constants, code.rounding);
    let of = |truncated: f64| move |parts: [Tracks; 2]| Value::of(parts, truncated);
    let both = |(re, im): (Tracked, Tracked)| [re.result(), im.result()];
    let pairs = |[(p, q), (r, s)]: [(Tracked, Tracked); 2]| [p.exact_sum(q), r.exact_sum(s)];
    let all =
        |ways: Vec<[Tracks; 2]>, truncated: f64| Ok(ways.into_iter().map(of(truncated)).collect());
    match region {
        Region::Maclaurin { terms } => {
            let f = match terms {
                9 => upper::nine_terms::<Tracked>,
                _ => upper::twenty_one_terms::<Tracked>,
            };
            let mut ways = evaluate(setting(&MACLAURIN), || {
                both(f(Tracked::input(0, at.a), Tracked::input(1, y)))
            })?;
            if terms == 9 && at.a[0] == 0.0 {
                ways.extend(evaluate(setting(&MACLAURIN), || {
                    let re = upper::nine_terms_on_imaginary_axis(Tracked::input(1, y));
                    [re.result(), Tracked::entry(0.0).result()]
                })?);
            }
            all(
                ways,
                truncation::maclaurin(terms - 1, hypot_up(at.a[1], at.b[1])).norm,
            )
        }
        Region::Disc { centre } => {
            let (row, errors) = code.tables.disc(centre)?;
            let (dx, dy) = (offsets(at.a, centre.0)?, offsets(at.b, -centre.1)?);
            let ways = evaluate(setting(&[]), || {
                let (dx, dy) = (dx.tracked(0), -dy.tracked(1));
                both(upper::complex_row(Tracking, row, dx, dy))
            })?;
            all(ways, errors.within(dx.most(), dy.most()).norm)
        }
        Region::RealAxis { centre } => {
            let (row, errors) = code.tables.real_axis(centre)?;
            let t = offsets(at.a, centre)?;
            let ways = evaluate(setting(&[]), || {
                let y = Tracked::input(1, y);
                both(code::real_axis_value(Tracking, row, t.tracked(0), y))
            })?;
            all(ways, errors.within(t.most(), at.b[1]).norm)
        }
        Region::Strip | Region::RealLine => {
            let (f, t) = match region {
                Region::Strip => (
                    code::in_strip::<Tracked> as fn(_, _) -> _,
                    truncation::strip(at),
                ),
                _ => (
                    code::on_real_line::<Tracked> as fn(_, _) -> _,
                    truncation::on_real_line(at, code.tables.real_line, code.tables.exponential),
                ),
            };
            let ways = evaluate(setting(&ASYMPTOTIC), || {
                let (re, im, _): (Tracked, Tracked, bool) =
                    f(Tracked::input(0, at.a), Tracked::input(1, y));
                both((re, im))
            })?;
            all(ways, t.norm)
        }
        Region::Cell { centre } => {
            let (row, errors) = code.tables.cell(centre)?;
            let (dx, dy) = (offsets(at.a, centre.0)?, offsets(at.b, centre.1)?);
            let ways = evaluate(setting(&[]), || {
                pairs(code::complex_row(
                    Tracking,
                    row,
                    dx.tracked(0),
                    dy.tracked(1),
                ))
            })?;
            all(ways, errors.within(dx.most(), dy.most()).norm)
        }
        Region::Asymptotic { terms } => {
            let f = match terms {
                26 => code::asymptotic::<Tracked, 26>,
                14 => code::asymptotic::<Tracked, 14>,
                6 => code::asymptotic::<Tracked, 6>,
                _ => return Err("no such number of terms"),
            };
            let ways = evaluate(setting(&ASYMPTOTIC), || {
                pairs(f(Tracked::input(0, at.a), Tracked::input(1, at.b)))
            })?;
            all(ways, truncation::asymptotic(terms, at).norm)
        }
        Region::Dominated => Err("not a formula of its own"),
    }
}

#[cfg(test)]
mod tests;
