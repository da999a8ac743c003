//! `Σ_j |x_j ∂f/∂x_j|` of splines, by differences at 256 bits.
//!
//! An estimate, as every condition is here; no reference value depends on it. The spline is solved
//! for its slopes by ordinary elimination in floats, and again with each datum times `1 + 2⁻⁹⁰`;
//! local slopes, which have kinks, also with `1 − 2⁻⁹⁰`, and the larger change counts. Queries stay
//! on their segments, so that one-sided derivatives are well defined; where both of Akima's weights
//! vanish the slope stays the mean of two chords, which it is by definition at the input alone.

use super::common::{EndKind, Kind, SplineProblem};
use crate::audit::largest;
use crate::solvers::hermite_spline::Slopes as LocalSlopes;
use rug::{Assign, Float};

const BITS: u32 = 256;
const STEP: u32 = 90;

fn float(v: f64) -> Float {
    Float::with_val(BITS, v)
}

/// The value of an operation.
fn with<T>(v: T) -> Float
where
    Float: Assign<T>,
{
    Float::with_val(BITS, v)
}

/// `Σ a_i b_i`.
fn sum(terms: &[(&Float, &Float)]) -> Float {
    let mut s = Float::new(BITS);
    for (a, b) in terms {
        s += *a * *b;
    }
    s
}

struct Slopes<'a> {
    h: Vec<Float>,
    delta: Vec<Float>,
    y: &'a [Float],
    x: &'a [Float],
    s: Vec<Float>,
}

/// Gaussian elimination with partial pivoting on a dense matrix whose rows end in the right-hand
/// side; zeros are skipped. `None` without a pivot.
fn eliminate(mut a: Vec<Vec<Float>>) -> Option<Vec<Float>> {
    let n = a.len();
    for c in 0..n {
        let best = (c..n).max_by(|&i, &j| {
            a[i][c]
                .cmp_abs(&a[j][c])
                .unwrap_or(std::cmp::Ordering::Equal)
        })?;
        a.swap(c, best);
        if a[c][c].is_zero() {
            return None;
        }
        let (done, rest) = a.split_at_mut(c + 1);
        let pivot = &done[c];
        for row in rest {
            if row[c].is_zero() {
                continue;
            }
            let f = Float::with_val(BITS, &row[c] / &pivot[c]);
            for j in c..=n {
                if !pivot[j].is_zero() {
                    row[j] -= &f * &pivot[j];
                }
            }
        }
    }
    // The last unknown first.
    let mut x: Vec<Float> = Vec::new();
    for (i, row) in a.iter().enumerate().rev() {
        let mut v = row[n].clone();
        for (c, known) in row[n - x.len()..n].iter().zip(x.iter().rev()) {
            if !c.is_zero() {
                v -= c * known;
            }
        }
        x.push(v / &row[i]);
    }
    x.reverse();
    Some(x)
}

/// Steps, and the slopes of the chords over them.
fn chords(x: &[Float], y: &[Float]) -> (Vec<Float>, Vec<Float>) {
    let difference = |p: &[Float]| Float::with_val(BITS, &p[1] - &p[0]);
    let h: Vec<Float> = x.windows(2).map(difference).collect();
    let delta = y
        .windows(2)
        .zip(&h)
        .map(|(p, h)| difference(p) / h)
        .collect();
    (h, delta)
}

/// Adds to a row, whose last number is the right-hand side, that `S''` is continuous between the
/// segments `p` and `q` with the knots `i`, `j`, `k`.
fn smooth(
    row: &mut [Float],
    (h, delta): (&[Float], &[Float]),
    (p, q): (usize, usize),
    (i, j, k): (usize, usize, usize),
) {
    let last = row.len() - 1;
    let one = float(1.0);
    let (a, b) = (
        Float::with_val(BITS, &one / &h[p]),
        Float::with_val(BITS, &one / &h[q]),
    );
    row[j] += Float::with_val(BITS, &a + &b) * 2;
    row[last] += sum(&[(&a, &delta[p]), (&b, &delta[q])]) * 3;
    row[i] += a;
    row[k] += b;
}

/// The condition at the end that is knot `i`.
fn end_row(
    end: EndKind,
    (h, delta): (&[Float], &[Float]),
    i: usize,
    value: Option<&Float>,
) -> Option<Vec<Float>> {
    let n = h.len();
    let mut row = vec![Float::new(BITS); n + 2];
    let (segment, other) = if i == 0 { (0, 1) } else { (n - 1, n - 1) };
    match end {
        EndKind::FirstDerivative => {
            row[i] = float(1.0);
            row[n + 1] = value?.clone();
        }
        EndKind::SecondDerivative => {
            row[i] = float(2.0);
            row[other] = float(1.0);
            let bend = with(value? * &h[segment]) / 2u32;
            let chord = with(&delta[segment] * 3u32);
            row[n + 1] = if i == 0 { chord - bend } else { chord + bend };
        }
        EndKind::NotAKnot => {
            let a = if i == 0 { 0 } else { n.checked_sub(2)? };
            if n < 2 {
                return None;
            }
            let square = |h: &Float| Float::with_val(BITS, h.square_ref()).recip();
            let (p, q) = (square(&h[a]), square(&h[a + 1]));
            row[a + 1] = Float::with_val(BITS, &p - &q);
            let turned = -q;
            row[n + 1] = sum(&[(&p, &delta[a]), (&turned, &delta[a + 1])]) * 2;
            row[a] = p;
            row[a + 2] = turned;
        }
    }
    Some(row)
}

/// The slopes of Fritsch and Butland, with the ends of Moler's `pchiptx`.
fn pchip(h: &[Float], delta: &[Float]) -> Vec<Float> {
    let n = h.len();
    let end = |i: usize, j: usize| {
        let (near, far, p, q) = (&h[i], &h[j], &delta[i], &delta[j]);
        let steps = with(near + far);
        let slope = (with(near + &steps) * p - with(near * q)) / steps;
        let limit = with(p * 3u32);
        let sign = |x: &Float| x.cmp0();
        if sign(&slope) != sign(p) {
            Float::new(BITS)
        } else if sign(q) != sign(p) && slope.cmp_abs(&limit).is_some_and(|o| o.is_gt()) {
            limit
        } else {
            slope
        }
    };
    let inner = |i: usize| {
        let product = with(&delta[i - 1] * &delta[i]);
        if product <= 0 {
            return Float::new(BITS);
        }
        let (a, b) = (
            with(&h[i] * 2u32) + &h[i - 1],
            with(&h[i - 1] * 2u32) + &h[i],
        );
        product * with(&a + &b) / sum(&[(&a, &delta[i]), (&b, &delta[i - 1])])
    };
    let mut s = vec![end(0, 1)];
    s.extend((1..n).map(inner));
    s.push(end(n - 1, n - 2));
    s
}

/// Two chords more at each end.
fn continued(delta: &[Float]) -> Vec<Float> {
    let beyond = |near: &Float, far: &Float| with(near * 2u32) - far;
    let mut m = delta.to_vec();
    for _ in 0..2 {
        m.insert(0, beyond(&m[0], &m[1]));
        m.push(beyond(&m[m.len() - 1], &m[m.len() - 2]));
    }
    m
}

/// The weights of the chords before and after a knot, from the two chords on either side of it.
fn weights(rule: LocalSlopes, m: &[Float]) -> [Float; 2] {
    let weight = |a: &Float, b: &Float| {
        let difference = with(a - b).abs();
        match rule {
            LocalSlopes::ModifiedAkima => difference + with(a + b).abs() / 2u32,
            _ => difference,
        }
    };
    [weight(&m[3], &m[2]), weight(&m[1], &m[0])]
}

fn weighted(rule: LocalSlopes, delta: &[Float], level: &[bool]) -> Vec<Float> {
    let slope = |(m, level): (&[Float], &bool)| {
        if *level {
            return with(&m[1] + &m[2]) / 2u32;
        }
        let [a, b] = weights(rule, m);
        sum(&[(&a, &m[1]), (&b, &m[2])]) / with(&a + &b)
    };
    continued(delta).windows(4).zip(level).map(slope).collect()
}

/// At which knots both of Akima's weights vanish.
fn level_knots(kind: Kind, x: &[Float], y: &[Float]) -> Vec<bool> {
    match kind {
        Kind::Local(rule) if rule != LocalSlopes::Pchip && x.len() > 2 => {
            let both_vanish = |m: &[Float]| weights(rule, m).iter().all(Float::is_zero);
            let m = continued(&chords(x, y).1);
            m.windows(4).map(both_vanish).collect()
        }
        _ => vec![false; x.len()],
    }
}

/// A query: whole periods, and the segment that holds the rest.
struct Place {
    turns: Float,
    segment: usize,
}

impl Place {
    fn new(kind: Kind, x: &[Float], q: &Float) -> Place {
        let (first, last) = (&x[0], &x[x.len() - 1]);
        let is_inside = first <= q && q <= last;
        let turns = match kind {
            Kind::Periodic if !is_inside => (with(q - first) / with(last - first)).floor(),
            _ => Float::new(BITS),
        };
        let mut place = Place { turns, segment: 0 };
        let rest = place.rest(x, q);
        place.segment = x[1..x.len() - 1].partition_point(|k| *k <= rest);
        place
    }

    /// The query without whole periods.
    fn rest(&self, x: &[Float], q: &Float) -> Float {
        let period = with(&x[x.len() - 1] - &x[0]);
        with(q - with(&self.turns * &period))
    }
}

impl<'a> Slopes<'a> {
    /// `level` says at which knots both of Akima's weights vanish.
    fn new(kind: Kind, problem: SplineProblem<'a, Float>, level: &[bool]) -> Option<Slopes<'a>> {
        let SplineProblem { x, y, ends, .. } = problem;
        let (h, delta) = chords(x, y);
        let n = h.len();
        let s = match kind {
            Kind::Local(_) if n == 1 => vec![delta[0].clone(); 2],
            Kind::Local(LocalSlopes::Pchip) => pchip(&h, &delta),
            Kind::Local(rule) => weighted(rule, &delta, level),
            Kind::Periodic => {
                let mut rows = vec![vec![Float::new(BITS); n + 1]; n];
                for (i, row) in rows.iter_mut().enumerate() {
                    let before = (i + n - 1) % n;
                    smooth(row, (&h, &delta), (before, i), (before, i, (i + 1) % n));
                }
                let mut s = eliminate(rows)?;
                s.push(s[0].clone());
                s
            }
            Kind::Ends([EndKind::NotAKnot, EndKind::NotAKnot]) if n < 3 => {
                // One parabola, or a line: S'' is the same at both ends of each end segment.
                let mut rows = vec![vec![Float::new(BITS); n + 2]; n + 1];
                for i in 1..n {
                    smooth(&mut rows[i], (&h, &delta), (i - 1, i), (i - 1, i, i + 1));
                }
                for (i, a) in [(0, 0), (n, n - 1)] {
                    rows[i][a] = float(1.0);
                    rows[i][a + 1] = float(1.0);
                    rows[i][n + 1] = Float::with_val(BITS, &delta[a] * 2u32);
                }
                if n == 1 {
                    rows[1] = vec![float(1.0), float(-1.0), float(0.0)];
                }
                eliminate(rows)?
            }
            Kind::Ends([first, last]) => {
                let mut rows = vec![vec![Float::new(BITS); n + 2]; n + 1];
                for i in 1..n {
                    smooth(&mut rows[i], (&h, &delta), (i - 1, i), (i - 1, i, i + 1));
                }
                for (k, end) in [(0, first), (1, last)] {
                    let i = k * n;
                    let value = ends.map(|ends| ends[k]);
                    let row = end_row(end, (&h, &delta), i, value)?;
                    rows[i] = row;
                }
                eliminate(rows)?
            }
        };
        Some(Slopes { h, delta, y, x, s })
    }

    /// `S`, `S'`, `S''`, `S'''` and the integral from the left knot, on a segment.
    fn at(&self, i: usize, x: &Float) -> [Float; 5] {
        let (h, delta, a, b) = (&self.h[i], &self.delta[i], &self.s[i], &self.s[i + 1]);
        let both = with(a + b);
        let c = (with(delta * 3u32) - &both - a) / h;
        let d = (both - with(delta * 2u32)) / h / h;
        let u = with(x - &self.x[i]);
        let value = ((with(&d * &u) + &c) * &u + a) * &u + &self.y[i];
        let first = (with(&d * &u) * 3u32 + with(&c * 2u32)) * &u + a;
        let second = with(&d * &u) * 6u32 + with(&c * 2u32);
        let part = (((with(&d * &u) / 4u32 + with(&c / 3u32)) * &u + with(a / 2u32)) * &u
            + &self.y[i])
            * &u;
        [value, first, second, d * 6u32, part]
    }

    /// `∫ S` from the first knot.
    fn area(&self, place: &Place, part: &Float) -> Float {
        let whole = |i: usize| {
            let [.., whole] = self.at(i, &self.x[i + 1]);
            whole
        };
        let mut area = part.clone();
        for i in 0..place.segment {
            area += whole(i);
        }
        if !place.turns.is_zero() {
            for i in 0..self.h.len() {
                area += whole(i) * &place.turns;
            }
        }
        area
    }

    fn outputs(&self, queries: [&Float; 2], places: &[Place]) -> Vec<Float> {
        let at = [0, 1].map(|k| {
            let rest = places[k].rest(self.x, queries[k]);
            self.at(places[k].segment, &rest)
        });
        let area = |k: usize| self.area(&places[k], &at[k][4]);
        let integral = area(1) - area(0);
        let mut out = Vec::new();
        for (k, [v, d, dd, ddd, _]) in at.into_iter().enumerate() {
            let i = if k == 0 {
                integral.clone()
            } else {
                -integral.clone()
            };
            out.extend([v, d, dd, ddd, i]);
        }
        out
    }
}

/// The conditions of the ten outputs: of a kind, at an input that begins with `x[n]`, `y[n]`.
/// Numbers that choose are no data.
pub(super) fn conditions(
    kind: Kind,
    input: &[f64],
    is_data: &[bool],
    unpack: fn(&[Float]) -> Option<SplineProblem<'_, Float>>,
) -> Option<Vec<f64>> {
    let mut data: Vec<Float> = input.iter().map(|&v| float(v)).collect();
    let p = unpack(&data)?;
    let increasing = p.x.windows(2).all(|w| w[0] < w[1]);
    if p.x.len() < 2 || !increasing || (kind == Kind::Periodic && p.y[0] != p.y[p.y.len() - 1]) {
        return None;
    }
    let places = p.queries.map(|q| Place::new(kind, p.x, q));
    let level = level_knots(kind, p.x, p.y);
    let run = |data: &[Float]| -> Option<Vec<Float>> {
        let p = unpack(data)?;
        Some(Slopes::new(kind, p, &level)?.outputs(p.queries, &places))
    };
    let n = p.x.len();
    let base = run(&data)?;
    let mut total = vec![0.0; base.len()];
    let sides: &[f64] = match kind {
        Kind::Local(_) => &[1.0, -1.0],
        _ => &[1.0],
    };
    for j in 0..data.len() {
        // The last ordinate of a periodic spline is the first one.
        if input[j] == 0.0 || !is_data[j] || (kind == Kind::Periodic && j == 2 * n - 1) {
            continue;
        }
        let mut change = vec![0f64; base.len()];
        for side in sides {
            let old = data.clone();
            data[j] *= float(1.0) + (float(*side) >> STEP);
            if kind == Kind::Periodic && j == n {
                data[2 * n - 1] = data[j].clone();
            }
            let shifted = run(&data)?;
            data = old;
            for ((c, a), b) in change.iter_mut().zip(&shifted).zip(&base) {
                let d = Float::with_val(64, a - b) << STEP;
                *c = largest([*c, d.to_f64().abs()]);
            }
        }
        for (t, c) in total.iter_mut().zip(change) {
            *t += c;
        }
    }
    Some(total)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solved(rows: &[&[f64]]) -> Option<Vec<f64>> {
        let rows = rows.iter().map(|r| r.iter().map(|&v| float(v)).collect());
        let x = eliminate(rows.collect())?;
        Some(x.iter().map(Float::to_f64).collect())
    }

    #[test]
    fn elimination_takes_a_pivot_from_below() {
        let rows: [&[f64]; 3] = [
            &[0.0, 1.0, 1.0, 5.0],
            &[1.0, 0.0, 2.0, 7.0],
            &[2.0, 1.0, 0.0, 4.0],
        ];
        assert_eq!(solved(&rows), Some(vec![1.0, 2.0, 3.0]));
        assert_eq!(solved(&[&[0.0, 1.0, 5.0], &[0.0, 2.0, 7.0]]), None);
    }
}
