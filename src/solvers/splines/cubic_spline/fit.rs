//! Second derivatives on arbitrary knots.

use super::boundary::{Boundary, End, Known};
use super::error::CubicSplineError as Error;
use super::evaluate::plain;
use super::grid::{Knots, LARGEST};
use super::spline::{CubicSpline, Extrapolation, Spline};
use crate::cyclic_tridiagonal;
use crate::tridiagonal::{Rows, TridiagonalError, solve_rows};

pub(in crate::splines) fn check_values(y: &[f64]) -> Result<(), Error> {
    // Without an early end, so that it becomes vector instructions.
    if y.iter().fold(true, |all, v| all & (v.abs() <= LARGEST)) {
        return Ok(());
    }
    match y.iter().position(|v| v.is_nan() || v.abs() > LARGEST) {
        None => Ok(()),
        Some(index) if y[index].is_finite() => Err(Error::Overflow { knot: index }),
        Some(index) => Err(Error::NotFinite {
            name: "values",
            index,
            value: y[index],
        }),
    }
}

/// Checks the end conditions against the number of knots.
pub(super) fn check_boundary(boundary: Boundary, y: &[f64]) -> Result<(), Error> {
    let got = y.len();
    let (first, last) = match boundary {
        Boundary::Periodic if y[0] != y[got - 1] => {
            return Err(Error::NotPeriodic {
                first: y[0],
                last: y[got - 1],
            });
        }
        Boundary::Periodic => return Ok(()),
        Boundary::Ends(first, last) => (first, last),
    };
    for (index, end) in [first, last].into_iter().enumerate() {
        match end {
            End::SecondDerivative(value) | End::FirstDerivative(value) => {
                if !value.is_finite() {
                    return Err(Error::NotFinite {
                        name: "ends",
                        index,
                        value,
                    });
                }
            }
            End::NotAKnot if first != last && got < 3 => {
                return Err(Error::TooFewKnots { needed: 3, got });
            }
            End::NotAKnot => {}
        }
    }
    Ok(())
}

impl CubicSpline {
    /// The spline through `(x_i, y_i)`. Outside the knots it gives an error until
    /// [`with_extrapolation`](Spline::with_extrapolation) says otherwise.
    ///
    /// # Errors
    /// [`CubicSplineError`](Error): fewer than two knots (three with not-a-knot at one end only),
    /// lengths that differ, numbers that are not finite, knots that do not increase, a periodic
    /// spline whose end ordinates differ, overflow.
    pub fn fit(x: Vec<f64>, y: Vec<f64>, boundary: Boundary) -> Result<CubicSpline, Error> {
        if x.len() != y.len() {
            return Err(Error::Length {
                knots: x.len(),
                values: y.len(),
            });
        }
        let grid = Knots::new(x)?;
        check_values(&y)?;
        check_boundary(boundary, &y)?;
        let steps = Steps {
            x: grid.as_slice(),
            y: &y,
        };
        let m = match boundary {
            Boundary::Periodic => periodic(steps),
            Boundary::Ends(first, last) => open(steps, first, last),
        }
        .map_err(|e| match e {
            TridiagonalError::Pivot { row, .. } | TridiagonalError::Overflow { row } => {
                Error::Overflow { knot: row }
            }
            TridiagonalError::NotFinite { index, .. } => Error::Overflow { knot: index },
            _ => Error::Overflow { knot: 0 },
        })?;
        let in_range = |i: usize| {
            let widest = steps
                .h(i.min(y.len() - 2))
                .max(steps.h(i.saturating_sub(1)));
            // A step beyond 2^512 makes the square infinite, and the product not a number.
            let scaled = m[i] * (widest * widest);
            (m[i].abs() <= LARGEST) & (scaled.abs() <= LARGEST)
        };
        // Without an early end first, so that it becomes vector instructions.
        if !(0..m.len()).fold(true, |all, i| all & in_range(i)) {
            let knot = (0..m.len()).find(|i| !in_range(*i)).unwrap_or_default();
            return Err(Error::Overflow { knot });
        }
        let mut known = boundary.known();
        for (known, third) in known.iter_mut().zip(shared_third(boundary, steps, &m)) {
            *known = third.map_or(*known, Known::Third);
        }
        Ok(Spline {
            plain: plain(&grid, known),
            grid,
            y,
            bend: m,
            known,
            extrapolation: Extrapolation::Error,
        })
    }
}

/// The third derivatives that not-a-knot makes common to two segments, from the longest of them:
/// over a short one the difference of two nearly equal second derivatives has few digits.
fn shared_third(boundary: Boundary, steps: Steps<'_>, m: &[f64]) -> [Option<f64>; 2] {
    let Boundary::Ends(first, last) = boundary else {
        return [None; 2];
    };
    let n = steps.len();
    let h = |i: usize| steps.h(i);
    let of = |i: usize| (m[i + 1] - m[i]) / h(i);
    let longest =
        |range: std::ops::Range<usize>| range.max_by(|&i, &j| h(i).total_cmp(&h(j))).map(of);
    match (
        first == End::NotAKnot && n > 1,
        last == End::NotAKnot && n > 1,
    ) {
        (true, true) if n < 3 => [longest(0..n); 2],
        (true, true) if n == 3 => [Some(OneCubic::through(steps).third); 2],
        (l, r) => [
            if l { longest(0..2) } else { None },
            if r { longest(n - 2..n) } else { None },
        ],
    }
}

/// The cubic through four knots, which is what not-a-knot at both ends makes of three segments. The
/// two rows of the system are opposite to each other but for the middle step: over a short one they
/// are left with few digits.
struct OneCubic {
    second: [f64; 4],
    third: f64,
}

impl OneCubic {
    /// `S''` is a straight line, `2 y[x_0, x_1, x_2]` at the mean of these knots and
    /// `2 y[x_1, x_2, x_3]` at the mean of those, a third of the whole apart.
    fn through(steps: Steps<'_>) -> OneCubic {
        let [h0, h1, h2] = [0, 1, 2].map(|i| steps.h(i));
        let slope = [0, 1, 2].map(|i| steps.slope(i));
        let whole = h0 + h1 + h2;
        let left = (slope[1] - slope[0]) / (h0 + h1);
        let right = (slope[2] - slope[1]) / (h1 + h2);
        let at = |of_left: f64, of_right: f64| {
            2.0 * (left * (of_left / whole) + right * (of_right / whole))
        };
        let (outer_left, outer_right) = (2.0 * h0 + h1, h1 + 2.0 * h2);
        OneCubic {
            second: [
                at(whole + outer_left, -outer_left),
                at(h1 + (h1 + h2), h0 - h1),
                at(h2 - h1, h1 + (h0 + h1)),
                at(-outer_right, whole + outer_right),
            ],
            third: 6.0 * ((right - left) / whole),
        }
    }
}

/// Knots and ordinates.
#[derive(Clone, Copy)]
struct Steps<'a> {
    x: &'a [f64],
    y: &'a [f64],
}

impl Steps<'_> {
    /// The number of segments.
    fn len(&self) -> usize {
        self.x.len() - 1
    }

    #[inline(always)]
    fn h(&self, i: usize) -> f64 {
        self.x[i + 1] - self.x[i]
    }

    #[inline(always)]
    fn slope(&self, i: usize) -> f64 {
        (self.y[i + 1] - self.y[i]) / self.h(i)
    }

    /// Six times the difference of the slopes at knot `i`.
    #[inline(always)]
    fn jump(&self, i: usize) -> f64 {
        6.0 * (self.slope(i) - self.slope(i - 1))
    }
}

/// The system for the second derivatives: the first row belongs to knot `s`, and all rows but the
/// first and the last say `h_{i−1} m_{i−1} + 2 (h_{i−1} + h_i) m_i + h_i m_{i+1} = d_i`.
struct System<'a> {
    steps: Steps<'a>,
    s: usize,
    first: [f64; 4],
    last: [f64; 4],
    rows: usize,
}

impl Rows<1> for System<'_> {
    fn len(&self) -> usize {
        self.rows
    }
    fn row(&self, i: usize) -> ([f64; 3], [f64; 1]) {
        let inner = || {
            let k = self.s + i;
            let [before, after] = [self.steps.h(k - 1), self.steps.h(k)];
            [before, 2.0 * (before + after), after, self.steps.jump(k)]
        };
        let [a, b, c, d] = match i {
            0 => self.first,
            _ if i + 1 == self.rows => self.last,
            _ => inner(),
        };
        ([a, b, c], [d])
    }
    #[inline(always)]
    fn four(&self, i: usize) -> ([[f64; 4]; 3], [[f64; 4]; 1]) {
        let at = self.s + i - 1;
        let six = |v: &[f64]| *v[at..].first_chunk::<6>().expect("six knots");
        let (x, y) = (six(self.steps.x), six(self.steps.y));
        let h: [f64; 5] = std::array::from_fn(|k| x[k + 1] - x[k]);
        let slope: [f64; 5] = std::array::from_fn(|k| (y[k + 1] - y[k]) / h[k]);
        let bands = [
            std::array::from_fn(|k| h[k]),
            std::array::from_fn(|k| 2.0 * (h[k] + h[k + 1])),
            std::array::from_fn(|k| h[k + 1]),
        ];
        (
            bands,
            [std::array::from_fn(|k| 6.0 * (slope[k + 1] - slope[k]))],
        )
    }
}

fn open(steps: Steps<'_>, first: End, last: End) -> Result<Vec<f64>, TridiagonalError> {
    use End::{FirstDerivative, NotAKnot, SecondDerivative};
    let n = steps.len();
    let (h, slope, jump) = (|i| steps.h(i), |i| steps.slope(i), |i| steps.jump(i));
    if first == NotAKnot && last == NotAKnot && n < 3 {
        let m = if n == 1 {
            0.0
        } else {
            jump(1) / (3.0 * (h(0) + h(1)))
        };
        return Ok(vec![m; n + 1]);
    }
    if first == NotAKnot && last == NotAKnot && n == 3 {
        return Ok(OneCubic::through(steps).second.to_vec());
    }
    // A not-a-knot end is eliminated from the row of its neighbour:
    // m_0 = m_1 + (p/q)(m_1 − m_2); the row divided by (p + q)/q.
    let of_first = match first {
        FirstDerivative(v) => [0.0, 2.0 * h(0), h(0), 6.0 * (slope(0) - v)],
        SecondDerivative(v) => [0.0, 1.0, 0.0, v],
        NotAKnot => {
            let (p, q) = (h(0), h(1));
            [0.0, p + 2.0 * q, q - p, jump(1) * (q / (p + q))]
        }
    };
    let of_last = match last {
        FirstDerivative(v) => [h(n - 1), 2.0 * h(n - 1), 0.0, 6.0 * (v - slope(n - 1))],
        SecondDerivative(v) => [0.0, 1.0, 0.0, v],
        NotAKnot => {
            let (p, q) = (h(n - 2), h(n - 1));
            [p - q, q + 2.0 * p, 0.0, jump(n - 1) * (p / (p + q))]
        }
    };
    let s = usize::from(first == NotAKnot);
    let e = n - usize::from(last == NotAKnot);
    let system = System {
        steps,
        s,
        first: of_first,
        last: of_last,
        rows: e - s + 1,
    };
    let mut m = vec![0.0; n + 1];
    solve_rows(&system, &mut m[s..=e])?;
    // The end from whichever equation does not magnify: the straight line of S'' while the end
    // step is the smaller one, the smoothness equation otherwise.
    let end = |p: f64, q: f64, near: f64, far: f64, jump: f64| {
        if p <= q {
            near + (p / q) * (near - far)
        } else {
            (jump - 2.0 * (p + q) * near - q * far) / p
        }
    };
    if s == 1 {
        m[0] = end(h(0), h(1), m[1], m[2], jump(1));
    }
    if e == n - 1 {
        m[n] = end(h(n - 1), h(n - 2), m[n - 1], m[n - 2], jump(n - 1));
    }
    Ok(m)
}

fn periodic(steps: Steps<'_>) -> Result<Vec<f64>, TridiagonalError> {
    let n = steps.len();
    let h: Vec<f64> = (0..n).map(|i| steps.h(i)).collect();
    let before = |i: usize| (i + n - 1) % n;
    let jump = |i: usize| 6.0 * (steps.slope(i) - steps.slope(before(i)));
    let mut m = match n {
        1 => vec![0.0],
        // Both neighbours of a knot are the same knot, and the two rows are opposite.
        2 => {
            let m = jump(0) / (h[0] + h[1]);
            vec![m, -m]
        }
        _ => {
            let lower: Vec<f64> = (0..n).map(|i| h[before(i)]).collect();
            let diagonal: Vec<f64> = (0..n).map(|i| 2.0 * (h[before(i)] + h[i])).collect();
            let mut m: Vec<f64> = (0..n).map(jump).collect();
            cyclic_tridiagonal::solve_in_place(&lower, &diagonal, &h, &mut m, false)?;
            m
        }
    };
    m.push(m[0]);
    Ok(m)
}
