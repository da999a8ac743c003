//! Drawings and claims under dispute in PMKSWeb, a program for planar linkages: its issue 91, four
//! programs that trace two different paths of one four-bar; issue 92, links that change their
//! lengths; pull request 231, a slider that passes through the position in which its two roots
//! meet.
//!
//! The paper's files have lengths, ranges and what they rest on; [`drawing`] follows the drawn
//! four-bar step by step in balls.

pub mod drawing;

use super::{Analysis, Found, file_of_known};
use crate::reference::{Ball, ComplexBall, Undecided};
use drawing::{BITS, FourBar, nearest_leaves, swiftest};
use rug::Rational;

/// The name used on the command line.
pub const KEY: &str = "pmksweb";

/// Follows the four-bar of issue 91.
///
/// # Errors
/// [`Undecided`] if a sign cannot be told.
pub(super) fn analysis() -> Result<Analysis, Undecided> {
    let file = file_of_known(KEY);
    let part = |axis: &str, p: &str| {
        let given = file.given("issue_91", &format!("{axis}_{p}"));
        Ball::rational(BITS, &given)
    };
    let points = ["a", "b", "c", "d"].map(|p| ComplexBall::new(part("x", p), part("y", p)));
    let linkage = FourBar::new(points)?;
    let (turn, at) = swiftest(&linkage, 1)?;
    let mut leaves = Vec::new();
    for step in [1, 2, 3, 4, 5, 6, 8, 10] {
        let after = nearest_leaves(&linkage, &Rational::from(step))?;
        leaves.push(after.map_or("not at all".into(), |angle| angle.to_string()));
    }
    let mut analysis = Analysis::default();
    let whirl = [format!("{turn:.6}"), at.to_string()];
    analysis.add("91-held-side", Found::values(whirl, true));
    analysis.add("91-nearest", Found::values(leaves, true));
    Ok(analysis)
}
