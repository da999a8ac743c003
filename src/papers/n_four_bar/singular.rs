//! All positions with every bar on one line, and what meets there, in exact numbers.
//!
//! A window closes when `a + c = 1 + b` for the directions a, b of its cranks and c of its rod as
//! complex numbers of size 1. With the conjugate equation `(a + c)(b − a c) = 0`, and `(1 − a)(1 −
//! c) = 0` where `b = a c` (ledger, nb-window): so one of three, and nothing else:
//!
//! ```text
//! parallelogram  c = 1,  b = a
//! left folded    a = 1,  c = b      the left crank lies on the ground, rod and right crank turn
//! together right folded   b = −1, c = −a     the right crank lies on the ground, rod and left
//! crank turn together
//! ```
//!
//! For N windows in a row this leaves circles: cranks l to r turn as one, all before them point
//! right, all after them left. There are `(N + 1)(N + 2)/2` of them. Two circles meet only where
//! all bars lie on one line: in the position with the first s cranks to the right and the others to
//! the left, s = 0 to N + 1, where N + 1 circles meet; circle (l, r) goes through s = l and
//! s = r + 1. So every position but these N + 2 has one degree of freedom, and these have N + 1
//! curves through them.
//!
//! Where two neighbouring cranks lie on the ground, the window between them is on one line and
//! loses a rank: a circle with more than one crank before its block, or after it, is singular all
//! along without another curve. The parallelograms', (0, N), is regular.

use crate::reference::dense::solve_exactly;
use rug::Rational;

/// Rows of equal length.
type Matrix = Vec<Vec<Rational>>;

/// The rank, by elimination.
fn rank(mut m: Matrix) -> usize {
    let mut found = 0;
    for c in 0..m.first().map_or(0, Vec::len) {
        let Some(p) = (found..m.len()).find(|&i| m[i][c] != 0) else {
            continue;
        };
        m.swap(found, p);
        let (above, below) = m.split_at_mut(found + 1);
        let pivot = &above[found];
        for row in below.iter_mut().filter(|row| row[c] != 0) {
            let factor = Rational::from(&row[c] / &pivot[c]);
            for (x, y) in row.iter_mut().zip(pivot).skip(c).filter(|(_, y)| **y != 0) {
                *x -= Rational::from(&factor * y);
            }
        }
        found += 1;
    }
    found
}

/// Cosine and sine of a bar's angle from x.
pub type Direction = [Rational; 2];

/// Directions of cranks, then rods.
#[derive(Clone, Debug)]
pub struct Directions {
    /// N + 1 cranks.
    pub cranks: Vec<Direction>,
    /// N rods.
    pub rods: Vec<Direction>,
}

fn along(sign: i32) -> Direction {
    [Rational::from(sign), Rational::new()]
}

/// The position on one line with the first `right` cranks to the right, the others to the left.
pub fn on_one_line(n: usize, right: usize) -> Directions {
    let sign = |k: usize| if k < right { 1 } else { -1 };
    let rod = |k: usize| if sign(k) == sign(k + 1) { 1 } else { -1 };
    Directions {
        cranks: (0..=n).map(|k| along(sign(k))).collect(),
        rods: (0..n).map(|k| along(rod(k))).collect(),
    }
}

/// A position of the parallelogram branch with sin θ = 4/5.
pub fn parallelogram(n: usize) -> Directions {
    on_circle(n, 0, n)
}

/// The position of circle (l, r) with sin θ = 4/5.
pub fn on_circle(n: usize, l: usize, r: usize) -> Directions {
    let crank = |k: usize| match k {
        _ if k < l => along(1),
        _ if k > r => along(-1),
        _ => [Rational::from((3, 5)), Rational::from((4, 5))],
    };
    let minus = |d: Direction| d.map(|x| -x);
    let rod = |k: usize| match k {
        _ if k + 1 == l => crank(l),
        _ if k == r => minus(crank(r)),
        _ => along(1),
    };
    Directions {
        cranks: (0..=n).map(crank).collect(),
        rods: (0..n).map(rod).collect(),
    }
}

/// The Jacobian of the loops: two rows for each window, columns for cranks and rods.
pub(super) fn jacobian(at: &Directions) -> Matrix {
    let n = at.rods.len();
    let mut rows = Vec::new();
    for k in 0..n {
        // d e^{iθ} = (−sin θ, cos θ) dθ.
        for part in [1usize, 0] {
            let of = |d: &Direction| match part {
                1 => Rational::from(-&d[1]),
                _ => d[0].clone(),
            };
            let mut row = vec![Rational::new(); 2 * n + 1];
            row[k] = of(&at.cranks[k]);
            row[k + 1] = -of(&at.cranks[k + 1]);
            row[n + 1 + k] = of(&at.rods[k]);
            rows.push(row);
        }
    }
    rows
}

/// Rank of the Jacobian at a position.
pub fn jacobian_rank(at: &Directions) -> usize {
    rank(jacobian(at))
}

/// Rates of all bars along the circles that meet in that position on one line, each with its
/// turning cranks at rate 1.
pub(super) fn tangents(n: usize, right: usize) -> Matrix {
    let at = on_one_line(n, right);
    let before = (0..right).map(|l| l..right);
    let after = (right..=n).map(|r| right..r + 1);
    let blocks = before.chain(after);
    let rates = |block: std::ops::Range<usize>| {
        let rate = |k: usize| Rational::from(u32::from(block.contains(&k)));
        let cranks: Vec<Rational> = (0..=n).map(rate).collect();
        // The y of a rod's ends: a u + c w = b v.
        let rod = |k: usize| {
            let [a, b, c] = [&at.cranks[k][0], &at.cranks[k + 1][0], &at.rods[k][0]];
            (Rational::from(b * &cranks[k + 1]) - Rational::from(a * &cranks[k])) / c
        };
        let rods: Vec<Rational> = (0..n).map(rod).collect();
        [cranks, rods].concat()
    };
    blocks.map(rates).collect()
}

/// Returns true if rates satisfy the loops to the first and second order in that position on one
/// line.
pub(super) fn admissible(at: &Directions, rates: &[Rational]) -> bool {
    let n = at.rods.len();
    let first = jacobian(at).iter().all(|row| {
        let products = row.iter().zip(rates).map(|(a, b)| Rational::from(a * b));
        products.sum::<Rational>() == 0
    });
    // x'' of the rod's ends: a u² + c w² = b v².
    let square = |k: usize| Rational::from(rates[k].square_ref());
    let second = (0..n).all(|k| {
        let [a, b, c] = [&at.cranks[k][0], &at.cranks[k + 1][0], &at.rods[k][0]];
        square(k) * a + square(n + 1 + k) * c == square(k + 1) * b
    });
    first && second
}

/// Facts about the positions on one line.
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// Rank of the Jacobian.
    pub rank: usize,
    /// Circles that meet.
    pub curves: usize,
    /// Rank of their tangents.
    pub tangents: usize,
    /// True if all tangents satisfy the loops to the second order.
    pub admissible: bool,
}

/// The position on one line with `right` cranks to the right.
pub fn meeting(n: usize, right: usize) -> Meeting {
    let at = on_one_line(n, right);
    let tangents = tangents(n, right);
    Meeting {
        rank: jacobian_rank(&at),
        curves: tangents.len(),
        admissible: tangents.iter().all(|t| admissible(&at, t)),
        tangents: rank(tangents),
    }
}

/// Accelerations of the cranks over −g/l, all to the right, from what the equations of motion say
/// at that position itself: no virtual displacement that the Jacobian allows is worked on by finite
/// forces in the joints, and the x rows of the Jacobian vanish, so the N + 1 cranks move as if
/// nothing else held them.
///
/// A rod with the rates u, v of its ends has the energy `m l² (u² + u v + v²)/6`, a crank `m l²
/// u²/6`.
pub fn accelerations_without_branch(n: usize) -> Option<Vec<Rational>> {
    let rods = |k: usize| u32::from(k > 0) + u32::from(k < n);
    let inertia = |k: usize, other: usize| match k.abs_diff(other) {
        0 => Rational::from((1 + rods(k), 3)),
        1 => Rational::from((1, 6)),
        _ => Rational::new(),
    };
    let matrix = crate::reference::Matrix::from_fn(n + 1, n + 1, inertia);
    let force =
        crate::reference::Matrix::from_fn(n + 1, 1, |k, _| Rational::from((1 + rods(k), 2)));
    let found = solve_exactly(&matrix, &force).ok()?;
    Some(found.entries().to_vec())
}

#[cfg(test)]
mod tests;
