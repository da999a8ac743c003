//! The slopes at the knots.

use crate::double_double::{Dd, fast_two_sum, sign_of_sum, two_prod, two_sum};

/// How the slope at a knot follows from the points around it; see the [module](super).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slopes {
    /// The monotone slopes of Fritsch and Butland.
    Pchip,
    /// The weighted mean of Akima (1970).
    Akima,
    /// Akima's mean with the weights of MATLAB's `makima`.
    ModifiedAkima,
}

/// A slope at a knot, and how much it exceeds the chord's slope on either side.
///
/// The excesses at both ends of a segment may nearly cancel in `S'''`, so they have twice the
/// working precision where that can happen for well-conditioned data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slope {
    pub slope: f64,
    pub over_left: Dd,
    pub over_right: Dd,
}

impl Slope {
    fn new(slope: f64, over_left: f64, over_right: f64) -> Slope {
        Slope {
            slope,
            over_left: Dd::from(over_left),
            over_right: Dd::from(over_right),
        }
    }
}

/// Steps, slopes of chords, and what each chord's slope adds to the one before.
pub(super) struct Chords {
    pub h: Vec<f64>,
    pub delta: Vec<f64>,
    /// The same in twice the working precision.
    exact: Vec<Dd>,
    /// `δ_i − δ_{i−1}` at the inner knot `i`, at place `i − 1`.
    jump: Vec<Dd>,
}

impl Chords {
    pub(super) fn new(x: &[f64], y: &[f64]) -> Chords {
        let steps = |v: &[f64]| -> Vec<Dd> { v.windows(2).map(|p| two_sum(p[1], -p[0])).collect() };
        let (run, rise) = (steps(x), steps(y));
        let slope: Vec<Dd> = rise.iter().zip(&run).map(|(y, x)| y.div(*x)).collect();
        let jump = (1..slope.len()).map(|i| {
            let d = slope[i] - slope[i - 1];
            // Far above the error of the quotients the sign is certain.
            if d.hi.abs() > 1e-25 * (slope[i].hi.abs() + slope[i - 1].hi.abs()) {
                return d;
            }
            match are_collinear([run[i - 1], run[i]], [rise[i - 1], rise[i]]) {
                true => Dd::ZERO,
                false => d,
            }
        });
        Chords {
            jump: jump.collect(),
            h: run.iter().map(|h| h.hi).collect(),
            delta: slope.iter().map(|s| s.value()).collect(),
            exact: slope,
        }
    }
}

/// Decides whether three points lie on a line, from the differences of their coordinates.
fn are_collinear(run: [Dd; 2], rise: [Dd; 2]) -> bool {
    let mut terms = Vec::with_capacity(16);
    // Powers of two keep the products within range; with equal slopes the two ratios are equal.
    let scaled = |v: Dd, by: f64| v.scale(power_of_two_near(by));
    let (dx, dy) = (run[0].hi, rise[0].hi.abs().max(rise[1].hi.abs()));
    let run = run.map(|v| scaled(v, dx));
    let rise = rise.map(|v| scaled(v, dy));
    for (sign, a, b) in [(1.0, rise[1], run[0]), (-1.0, rise[0], run[1])] {
        for a in [a.hi, a.lo] {
            for b in [b.hi, b.lo] {
                let p = two_prod(sign * a, b);
                terms.extend([p.lo, p.hi]);
            }
        }
    }
    sign_of_sum(&terms) == 0.0
}

/// A power of two whose product with `x > 0` is near 1.
fn power_of_two_near(x: f64) -> f64 {
    match x > 0.0 {
        true => f64::from_bits((2046 - (x.to_bits() >> 52).clamp(1, 2045)) << 52),
        false => 1.0,
    }
}

impl Slopes {
    /// The slopes at all knots.
    pub(super) fn at_knots(self, c: &Chords) -> Vec<Slope> {
        let n = c.delta.len();
        if n == 1 {
            let chord = Slope::new(c.delta[0], 0.0, 0.0);
            return vec![chord; 2];
        }
        match self {
            Slopes::Pchip => pchip(c),
            Slopes::Akima => weighted(c, |jump, _| absolute(jump)),
            Slopes::ModifiedAkima => {
                weighted(c, |jump, sum| absolute(jump) + absolute(sum).scale(0.5))
            }
        }
    }
}

fn pchip(c: &Chords) -> Vec<Slope> {
    let n = c.delta.len();
    let mut all = Vec::with_capacity(n + 1);
    let jump = |i: usize| c.jump[i].value();
    let (slope, over_right) = end((c.h[0], c.h[1]), (c.delta[0], c.delta[1]), jump(0));
    all.push(Slope::new(slope, 0.0, over_right));
    for i in 1..n {
        let (left, right) = (c.delta[i - 1], c.delta[i]);
        let (p, q) = (c.h[i - 1], c.h[i]);
        let rises = left > 0.0 && right > 0.0;
        let falls = left < 0.0 && right < 0.0;
        if !(rises || falls) {
            all.push(Slope::new(0.0, -left, -right));
            continue;
        }
        // With the steeper chord as unit nothing overflows.
        let (steep, flat) = match left.abs() >= right.abs() {
            true => (left, right),
            false => (right, left),
        };
        let third = 3.0 * (p + q);
        let (of_left, of_right) = ((p + 2.0 * q) / third, (2.0 * p + q) / third);
        let (a, b) = (of_left * (right / steep), of_right * (left / steep));
        let sum = a + b;
        all.push(Slope::new(
            flat / sum,
            jump(i - 1) * (of_right * (left / steep) / sum),
            -(jump(i - 1) * (of_left * (right / steep) / sum)),
        ));
    }
    let (steps, chords) = ((c.h[n - 1], c.h[n - 2]), (c.delta[n - 1], c.delta[n - 2]));
    let (slope, over_left) = end(steps, chords, -jump(n - 2));
    all.push(Slope::new(slope, over_left, 0.0));
    all
}

/// The slope at an end, and how much it exceeds that of the end's chord. Steps and chords are given
/// from the end inwards, `jump` is the second chord's slope less the first's.
fn end(h: (f64, f64), chords: (f64, f64), jump: f64) -> (f64, f64) {
    let (near, far) = chords;
    let over = -(jump * (h.0 / (h.0 + h.1)));
    let slope = near + over;
    let keeps_sign = slope > 0.0 && near > 0.0 || slope < 0.0 && near < 0.0;
    let turns = near > 0.0 && far < 0.0 || near < 0.0 && far > 0.0;
    if !keeps_sign {
        (0.0, -near)
    } else if turns && slope.abs() > 3.0 * near.abs() {
        (3.0 * near, 2.0 * near)
    } else {
        (slope, over)
    }
}

/// Chords and their jumps with two more at each end, which go on linearly.
fn continued(c: &Chords) -> (Vec<Dd>, Vec<Dd>) {
    let n = c.exact.len();
    let (first, last) = (c.jump[0], c.jump[n - 2]);
    let (start, stop) = (c.exact[0], c.exact[n - 1]);
    let delta = [start - first - first, start - first]
        .into_iter()
        .chain(c.exact.iter().copied())
        .chain([stop + last, stop + last + last]);
    let jump = [first, first]
        .into_iter()
        .chain(c.jump.iter().copied())
        .chain([last, last]);
    (delta.collect(), jump.collect())
}

/// `a b`, the same for `b a` to the last bit.
fn product(a: Dd, b: Dd) -> Dd {
    let p = two_prod(a.hi, b.hi);
    fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi))
}

/// Means of neighbouring chords: the weight of each, a function of a jump and of the sum of its two
/// chords, is that of the jump on the other side of its neighbour.
fn weighted(c: &Chords, weight: impl Fn(Dd, Dd) -> Dd) -> Vec<Slope> {
    let (delta, jump) = continued(c);
    let weights: Vec<Dd> = jump
        .iter()
        .zip(delta.windows(2))
        .map(|(jump, d)| weight(*jump, d[0] + d[1]))
        .collect();
    (0..=c.exact.len())
        .map(|i| {
            let (left, right, jump) = (delta[i + 1], delta[i + 2], jump[i + 1]);
            // A power of two keeps the products within range. They commute, so that excesses that
            // are opposite by definition, as Akima's in the middle of four points, cancel exactly.
            let unit = power_of_two_near(weights[i].hi.max(weights[i + 2].hi));
            let (before, after) = (weights[i].scale(unit), weights[i + 2].scale(unit));
            let both = before + after;
            let (of_left, of_right, over_left, over_right) = match both.hi > 0.0 {
                true => (
                    after.div(both).hi,
                    before.div(both).hi,
                    product(before, jump).div(both),
                    -product(after, jump).div(both),
                ),
                false => (0.5, 0.5, jump.scale(0.5), -jump.scale(0.5)),
            };
            Slope {
                slope: of_left * left.hi + of_right * right.hi,
                over_left,
                over_right,
            }
        })
        .collect()
}

fn absolute(v: Dd) -> Dd {
    if v.hi < 0.0 { -v } else { v }
}
