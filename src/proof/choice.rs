//! Which formulas the code uses in a rectangle.

use crate::code::Code;
use crate::cover::{Rectangle, pieces};
use crate::formula::Formula;
use crate::tables::{cell_at, imaginary_axis_at, real_axis_at};
use mechaudit_solvers::faddeeva::Branch;

/// More than these formulas and pieces of a rectangle, and it is halved.
const MANY: usize = 6;

/// A piece of a rectangle, with a formula that may be used there.
pub(crate) type Part = (Rectangle, Formula);

/// The formulas that are used in a rectangle, each with the piece of it where it may be.
pub(crate) fn parts(code: &Code, at: &Rectangle) -> Result<Vec<Part>, &'static str> {
    let mut out = Vec::new();
    if at.a == [0.0, 0.0] {
        for (b, branch) in pieces(at.b, |b| (code.branch)(0.0, b)) {
            on_axis(Rectangle { a: at.a, b }, branch, &mut out)?;
        }
    } else {
        for (piece, branch) in choices(at, code.branch, rank)? {
            with_rows(piece, branch, &mut out)?;
        }
    }
    match out.len() > MANY {
        true => Err(SEVERAL),
        false => Ok(out),
    }
}

pub(crate) const SEVERAL: &str = "several formulas";
const UNKNOWN: &str = "an unknown branch";

/// All that the code chooses in a rectangle, each with the piece of it where it may.
///
/// All choices of the code are made by `|z|²`, which in floating-point arithmetic too never falls
/// when a coordinate grows, and by comparisons of a coordinate with a constant
/// ([`Rectangle::lines`]): on a piece between those lines the choices at two opposite corners are
/// the first and the last. `rank` is the order of formulas along the rings.
pub(crate) fn choices(
    at: &Rectangle,
    branch: fn(f64, f64) -> Branch,
    rank: fn(Branch) -> Option<usize>,
) -> Result<Vec<(Rectangle, Branch)>, &'static str> {
    let [re, im] = at.lines();
    let mut out = Vec::new();
    for (a, _) in pieces(at.a, side(re)) {
        for (b, _) in pieces(at.b, side(im)) {
            let ends = [branch(a[0], b[0]), branch(a[1], b[1])];
            let all = between(&ends, rank).ok_or(SEVERAL)?;
            out.extend(all.iter().map(|choice| (Rectangle { a, b }, *choice)));
        }
    }
    Ok(out)
}

/// On which side of each of the lines a number is.
fn side(lines: &[f64]) -> impl Fn(f64) -> usize + '_ {
    |x| lines.iter().filter(|line| x >= **line).count()
}

/// All choices between the first and the last of them; `None` where a third may come between.
fn between(ends: &[Branch; 2], rank: fn(Branch) -> Option<usize>) -> Option<&[Branch]> {
    if ends[0] == ends[1] {
        return Some(&ends[..1]);
    }
    follows(*ends, rank).then_some(ends)
}

/// Decides whether no third formula comes between two along the rings.
pub(crate) fn follows([first, second]: [Branch; 2], rank: fn(Branch) -> Option<usize>) -> bool {
    let strip = |b: Branch| matches!(b, Branch::Strip { .. } | Branch::RealLine { .. });
    let far = matches!(first, Branch::Asymptotic { terms: 26 });
    // Away from the strip 14 terms follow 26.
    let gap = if far && !strip(second) { 2 } else { 1 };
    matches!((rank(first), rank(second)), (Some(p), Some(q)) if q == p + gap)
}

/// The order above the axis.
fn rank(b: Branch) -> Option<usize> {
    Some(match b {
        Branch::Maclaurin { terms: 9 } => 0,
        Branch::Maclaurin { .. } => 1,
        Branch::Cell { .. } => 2,
        // Between the same rings as what follows away from the strip.
        Branch::RealAxis { .. } | Branch::Asymptotic { terms: 26 } => 3,
        Branch::Strip { .. } | Branch::RealLine { .. } => 4,
        Branch::Asymptotic { terms: 14 } => 5,
        Branch::Asymptotic { terms: 6 } => 6,
        Branch::Asymptotic { terms: 4 } => 7,
        Branch::Asymptotic { .. } => 8,
        Branch::Huge => 9,
        _ => return None,
    })
}

/// The pieces of a rectangle by the centres of its rows.
pub(crate) fn by_centre(
    at: &Rectangle,
    centre: impl Fn(f64, f64) -> (f64, f64),
) -> Vec<(Rectangle, (f64, f64))> {
    let rows = pieces(at.b, |b| centre(at.a[0], b).1);
    let mut out = Vec::new();
    for (a, x) in pieces(at.a, |a| centre(a, at.b[0]).0) {
        out.extend(rows.iter().map(|&(b, y)| (Rectangle { a, b }, (x, y))));
    }
    out
}

/// A piece of the imaginary axis with a formula, cut where the row of its table changes.
fn on_axis(piece: Rectangle, branch: Branch, out: &mut Vec<Part>) -> Result<(), &'static str> {
    let Branch::ImaginaryAxis { .. } = branch else {
        out.push((piece, Formula::of(branch, true).ok_or(UNKNOWN)?));
        return Ok(());
    };
    for (at, (_, centre)) in by_centre(&piece, |_, b| (0.0, imaginary_axis_at(b).0)) {
        out.push((at, Formula::ImaginaryAxis { centre }));
    }
    Ok(())
}

/// A piece of a rectangle with a formula, cut where the row of its table changes.
fn with_rows(piece: Rectangle, branch: Branch, out: &mut Vec<Part>) -> Result<(), &'static str> {
    match branch {
        Branch::Cell { .. } => {
            for (at, centre) in by_centre(&piece, |a, b| cell_at(a, b).0) {
                out.push((at, Formula::Cell { centre }));
            }
        }
        Branch::RealAxis { .. } => {
            for (at, (centre, _)) in by_centre(&piece, |a, _| (real_axis_at(a).0, 0.0)) {
                out.push((at, Formula::RealAxis { centre }));
            }
        }
        _ => out.push((piece, Formula::of(branch, false).ok_or(UNKNOWN)?)),
    }
    Ok(())
}

#[cfg(test)]
mod tests;
