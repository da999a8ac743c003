//! Rectangles of `f64`s, and whether they cover the quadrant.

use crate::grid::{exponent, power_of_two};
use mechaudit_solvers::faddeeva::SEAMS;
use std::ops::RangeInclusive;

/// The points `a + i b` of `f64`s with `a[0] ≤ a ≤ a[1]`, `b[0] ≤ b ≤ b[1]`, none negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// The ends of `Re z`.
    pub a: [f64; 2],
    /// The ends of `Im z`.
    pub b: [f64; 2],
}

/// Lines on Re z, and on Im z, at which the code chooses between formulas, in rising order.
const LINES: [&[f64]; 2] = {
    // The first line of Re z is for batches and the lower half-plane.
    let (_, re) = SEAMS.re.split_at(1);
    [re, SEAMS.im]
};

/// Lines on Im z next to the real axis: below the first `e^{−z²}` counts in Re w for every Re z
/// there, above the second for none; then those of the code.
const BESIDE_REAL_AXIS: &[f64] = &[
    f64::from_bits((1023 - 55) << 52),
    f64::from_bits((1023 - 51) << 52),
    SEAMS.im[0],
    SEAMS.im[1],
];

/// Beyond this ratio of its ends a coordinate is worth a factor of its own.
const NARROW: f64 = 4.0;

impl Rectangle {
    /// Returns whether both coordinates are below the limit, if there is one.
    pub fn is_below(&self, limit: Option<f64>) -> bool {
        limit.is_none_or(|limit| self.a[1].max(self.b[1]) < limit)
    }

    /// Returns whether Re z is the small coordinate.
    pub(crate) fn small_re(&self) -> bool {
        self.a[1] <= self.b[0] && self.a[0] * NARROW < self.a[1]
    }

    /// Returns whether Im z is.
    pub(crate) fn small_im(&self) -> bool {
        self.b[1] <= self.a[0] && self.b[0] * NARROW < self.b[1]
    }

    /// Divided by the power of two of its largest coordinate, for rectangles within one shell: as
    /// the code scales z.
    pub(crate) fn scaled(&self) -> Option<Rectangle> {
        let most = |r: f64, s: f64| exponent(r.max(s).max(f64::MIN_POSITIVE));
        let k = most(self.a[0], self.b[0]);
        if k != most(self.a[1], self.b[1]) {
            return None;
        }
        // Two steps, as 2^{−1023} is subnormal.
        let (p, q) = (power_of_two(-(k / 2)), power_of_two(k / 2 - k));
        let down = |x: f64| x * p * q;
        let ends = |[lo, hi]: [f64; 2]| {
            let (s, t) = (down(lo), down(hi));
            let exact = |x: f64, y: f64| y / q / p == x;
            let lo = if exact(lo, s) {
                s
            } else {
                s.next_down().max(0.0)
            };
            let hi = if exact(hi, t) { t } else { t.next_up() };
            [lo, hi]
        };
        Some(Rectangle {
            a: ends(self.a),
            b: ends(self.b),
        })
    }

    /// The number of numbers, less one, on each side.
    fn sides(&self) -> [u64; 2] {
        [self.a, self.b].map(|[lo, hi]| hi.to_bits() - lo.to_bits())
    }

    /// Returns whether it is one point.
    pub fn is_point(&self) -> bool {
        self.sides() == [0, 0]
    }

    /// The lines at which the code chooses there: all of them where there may be cells,
    /// `|z|² < 48`; the two next to the real axis where it has a strip, `|z|² < 768`; beyond, it
    /// chooses by `|z|²` alone.
    pub(crate) fn lines(&self) -> [&'static [f64]; 2] {
        let nearest = self.a[0].max(self.b[0]);
        if nearest < 7.0 {
            LINES
        } else if nearest < 28.0 {
            [&[], BESIDE_REAL_AXIS]
        } else {
            [&[], &[]]
        }
    }

    /// Two parts of it, cut across Re z or Im z: at the last of [`Self::lines`] inside, or in the
    /// middle by the number of `f64`s.
    pub(crate) fn halves(&self, across_re: bool) -> [Rectangle; 2] {
        let cut = |[lo, hi]: [f64; 2], lines: &[f64]| {
            let (p, q) = (lo.to_bits(), hi.to_bits());
            let inside = lines.iter().rfind(|&&line| lo < line && line <= hi);
            let middle = match inside {
                Some(line) => line.to_bits() - 1,
                None => p + (q - p) / 2,
            };
            let at = f64::from_bits;
            [[lo, at(middle)], [at((middle + 1).min(q)), hi]]
        };
        match across_re {
            true => cut(self.a, self.lines()[0]).map(|a| Rectangle { a, b: self.b }),
            false => cut(self.b, self.lines()[1]).map(|b| Rectangle { a: self.a, b }),
        }
    }

    /// Across which coordinate a cut tells more: by length (`wide`), or by the number of `f64`s.
    pub(crate) fn across_re(&self, wide: bool) -> bool {
        let [p, q] = self.sides();
        if p == 0 || q == 0 {
            return p > 0;
        }
        match wide {
            true => self.a[1] - self.a[0] >= self.b[1] - self.b[0],
            false => p >= q,
        }
    }
}

/// The pieces of `[lo, hi]` on which a function that never falls, or never rises, is constant.
pub(crate) fn pieces<T: PartialEq + Copy>(
    [lo, hi]: [f64; 2],
    f: impl Fn(f64) -> T,
) -> Vec<([f64; 2], T)> {
    let mut out = Vec::new();
    let (mut from, last) = (lo.to_bits(), hi.to_bits());
    loop {
        let value = f(f64::from_bits(from));
        // The last number with the same value.
        let (mut same, mut past) = (from, last);
        if f(hi) == value {
            same = last;
        }
        while past - same > 1 {
            let middle = same + (past - same) / 2;
            match f(f64::from_bits(middle)) == value {
                true => same = middle,
                false => past = middle,
            }
        }
        out.push(([f64::from_bits(from), f64::from_bits(same)], value));
        if same == last {
            return out;
        }
        from = same + 1;
    }
}

/// The numbers from `2^k` up to `2^{k+1}`.
fn binade(k: i32) -> [f64; 2] {
    let end = match k {
        1023 => f64::MAX,
        _ => power_of_two(k + 1).next_down(),
    };
    [power_of_two(k), end]
}

/// A square about zero, and shells `2^k ≤ max(Re z, |Im z|) < 2^{k+1}` around it, each cut into
/// rectangles, with that number of binades of the smaller coordinate cut apart at once; from the
/// least coordinates on.
pub(crate) fn shells(
    binades: RangeInclusive<i32>,
    beside: i32,
    [least_a, least_b]: [f64; 2],
) -> Vec<Rectangle> {
    let [_, square] = binade(binades.start() - 1);
    let mut all = vec![Rectangle {
        a: [least_a, square],
        b: [least_b, square],
    }];
    for k in binades {
        let mut add = |a, b| all.push(Rectangle { a, b });
        let long = binade(k);
        let [_, rest] = binade(k - beside - 1);
        add(long, [least_b, rest]);
        add([least_a, rest], long);
        for short in (k - beside..k).map(binade) {
            add(long, short);
            add(short, long);
        }
        add(long, long);
    }
    all
}

/// The quadrant of finite positive `Re z` and finite `Im z ≥ 0` as shells; then the half-axis
/// `Re z = 0`.
pub(crate) fn roots() -> Vec<Rectangle> {
    const FIRST: i32 = -9;
    let mut all = shells(FIRST..=1023, 5, [f64::from_bits(1), 0.0]);
    let [_, square] = binade(FIRST - 1);
    let axis = std::iter::once([0.0, square]).chain((FIRST..=1023).map(binade));
    all.extend(axis.map(|b| Rectangle { a: [0.0; 2], b }));
    all
}

/// A point of the closed quadrant that no rectangle covers, if there is one.
///
/// The numbers by their bits: the square of all pairs is cut at ends of rectangles until one of
/// them holds what is left of it, or none meets it.
pub fn hole(rectangles: &[Rectangle]) -> Option<[f64; 2]> {
    let bits = |[lo, hi]: [f64; 2]| [lo.to_bits(), hi.to_bits()];
    let all: Vec<[[u64; 2]; 2]> = rectangles.iter().map(|r| [bits(r.a), bits(r.b)]).collect();
    let whole = [[0, (1 << 63) - 1]; 2];
    hole_in(whole, &all).map(|p| p.map(f64::from_bits))
}

fn hole_in(square: [[u64; 2]; 2], rectangles: &[[[u64; 2]; 2]]) -> Option<[u64; 2]> {
    const LAST: u64 = f64::MAX.to_bits();
    let [a, b] = square;
    if a[0] > LAST || b[0] > LAST {
        return None;
    }
    let finite = square.map(|[lo, hi]| [lo, hi.min(LAST)]);
    let meets =
        |r: &[[u64; 2]; 2]| (0..2).all(|i| r[i][0] <= finite[i][1] && finite[i][0] <= r[i][1]);
    let holds =
        |r: &[[u64; 2]; 2]| (0..2).all(|i| r[i][0] <= finite[i][0] && finite[i][1] <= r[i][1]);
    let here: Vec<_> = rectangles.iter().copied().filter(meets).collect();
    if here.iter().any(holds) {
        return None;
    }
    if here.is_empty() {
        return Some([a[0], b[0]]);
    }
    // Where rectangles begin, inside the square: without any each of them holds it.
    let cuts = [0, 1].map(|i| {
        let ends = here
            .iter()
            .flat_map(|r| [r[i][0], r[i][1].saturating_add(1)]);
        let mut cuts: Vec<u64> = ends
            .filter(|e| finite[i][0] < *e && *e <= finite[i][1])
            .collect();
        cuts.sort_unstable();
        cuts.dedup();
        cuts
    });
    let i = usize::from(cuts[1].len() > cuts[0].len());
    let at = cuts[i][cuts[i].len() / 2];
    let (mut low, mut high) = (square, square);
    (low[i][1], high[i][0]) = (at - 1, at);
    hole_in(low, &here).or_else(|| hole_in(high, &here))
}

#[cfg(test)]
mod tests;
