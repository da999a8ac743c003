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
///
/// All choices of the code are made by `|z|²`, which in floating-point arithmetic too never falls when a coordinate
/// grows, and by comparisons of a coordinate with a constant ([`Rectangle::lines`]): on a piece between those lines the
/// choices at two opposite corners are the first and the last.
pub(crate) fn parts(code: &Code, at: &Rectangle) -> Result<Vec<Part>, &'static str> {
    let mut out = Vec::new();
    if at.a == [0.0, 0.0] {
        for (b, branch) in pieces(at.b, |b| (code.branch)(0.0, b)) {
            on_axis(Rectangle { a: at.a, b }, branch, &mut out)?;
        }
    } else {
        let [re, im] = at.lines();
        for (a, _) in pieces(at.a, side(re)) {
            for (b, _) in pieces(at.b, side(im)) {
                let ends = [(code.branch)(a[0], b[0]), (code.branch)(a[1], b[1])];
                for branch in between(&ends).ok_or(SEVERAL)? {
                    with_rows(Rectangle { a, b }, *branch, &mut out)?;
                }
            }
        }
    }
    match out.len() > MANY {
        true => Err(SEVERAL),
        false => Ok(out),
    }
}

const SEVERAL: &str = "several formulas";
const UNKNOWN: &str = "an unknown branch";

/// On which side of each of the lines a number is.
fn side(lines: &[f64]) -> impl Fn(f64) -> usize + '_ {
    |x| lines.iter().filter(|line| x >= **line).count()
}

/// All choices between the first and the last of them; `None` where a third may come between.
fn between(ends: &[Branch; 2]) -> Option<&[Branch]> {
    if ends[0] == ends[1] {
        return Some(&ends[..1]);
    }
    follows(*ends).then_some(ends)
}

/// Whether no third formula comes between two along the rings.
fn follows([first, second]: [Branch; 2]) -> bool {
    let rank = |b: Branch| {
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
    };
    let strip = |b: Branch| matches!(b, Branch::Strip { .. } | Branch::RealLine { .. });
    let far = matches!(first, Branch::Asymptotic { terms: 26 });
    // Away from the strip 14 terms follow 26.
    let gap = if far && !strip(second) { 2 } else { 1 };
    match (rank(first), rank(second)) {
        (Some(p), Some(q)) => q == p + gap,
        _ => false,
    }
}

/// A piece of the imaginary axis with a formula, cut where the row of its table changes.
fn on_axis(piece: Rectangle, branch: Branch, out: &mut Vec<Part>) -> Result<(), &'static str> {
    let Branch::ImaginaryAxis { .. } = branch else {
        out.push((piece, Formula::of(branch, true).ok_or(UNKNOWN)?));
        return Ok(());
    };
    let centres = pieces(piece.b, |b| imaginary_axis_at(b).0);
    let part = |(b, centre)| (Rectangle { b, ..piece }, Formula::ImaginaryAxis { centre });
    out.extend(centres.into_iter().map(part));
    Ok(())
}

/// A piece of a rectangle with a formula, cut where the row of its table changes.
fn with_rows(piece: Rectangle, branch: Branch, out: &mut Vec<Part>) -> Result<(), &'static str> {
    match branch {
        Branch::Cell { .. } => {
            let rows = pieces(piece.b, |b| cell_at(piece.a[0], b).0.1);
            for (a, x) in pieces(piece.a, |a| cell_at(a, piece.b[0]).0.0) {
                let part = |&(b, y)| (Rectangle { a, b }, Formula::Cell { centre: (x, y) });
                out.extend(rows.iter().map(part));
            }
        }
        Branch::RealAxis { .. } => {
            let centres = pieces(piece.a, |a| real_axis_at(a).0);
            let part = |(a, centre)| (Rectangle { a, ..piece }, Formula::RealAxis { centre });
            out.extend(centres.into_iter().map(part));
        }
        _ => out.push((piece, Formula::of(branch, false).ok_or(UNKNOWN)?)),
    }
    Ok(())
}

#[cfg(test)]
#[path = "tests/choice.rs"]
mod tests;
