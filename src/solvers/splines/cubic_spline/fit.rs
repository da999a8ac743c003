//! Second derivatives on arbitrary knots.

use super::boundary::{Boundary, End, Known};
use super::error::CubicSplineError as Error;
use super::evaluate::plain;
use super::grid::{Knots, LARGEST};
use super::spline::{CubicSpline, Extrapolation, Spline};
use crate::cyclic_tridiagonal::CyclicSweep;
use crate::tridiagonal::{Sweep, TridiagonalError};

pub(in crate::splines) fn check_values(y: &[f64]) -> Result<(), Error> {
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
        let x = grid.as_slice();
        let h: Vec<f64> = x.windows(2).map(|p| p[1] - p[0]).collect();
        let slope: Vec<f64> = (0..h.len()).map(|i| (y[i + 1] - y[i]) / h[i]).collect();
        let m = match boundary {
            Boundary::Periodic => periodic(&h, &slope),
            Boundary::Ends(first, last) => open(&h, &slope, first, last),
        }
        .map_err(|e| match e {
            TridiagonalError::Pivot { row, .. } | TridiagonalError::Overflow { row } => {
                Error::Overflow { knot: row }
            }
            TridiagonalError::NotFinite { index, .. } => Error::Overflow { knot: index },
            _ => Error::Overflow { knot: 0 },
        })?;
        for i in 0..m.len() {
            let widest = h[i.min(h.len() - 1)].max(h[i.saturating_sub(1)]);
            // A step beyond 2^512 makes the square infinite, and the product not a number.
            let scaled = m[i] * (widest * widest);
            let in_range = |v: f64| v.abs() <= LARGEST;
            if !(in_range(m[i]) && in_range(scaled)) {
                return Err(Error::Overflow { knot: i });
            }
        }
        let mut known = boundary.known();
        for (known, third) in known.iter_mut().zip(shared_third(boundary, &h, &slope, &m)) {
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
fn shared_third(boundary: Boundary, h: &[f64], slope: &[f64], m: &[f64]) -> [Option<f64>; 2] {
    let Boundary::Ends(first, last) = boundary else {
        return [None; 2];
    };
    let n = h.len();
    let of = |i: usize| (m[i + 1] - m[i]) / h[i];
    let longest =
        |range: std::ops::Range<usize>| range.max_by(|&i, &j| h[i].total_cmp(&h[j])).map(of);
    match (
        first == End::NotAKnot && n > 1,
        last == End::NotAKnot && n > 1,
    ) {
        (true, true) if n < 3 => [longest(0..n); 2],
        (true, true) if n == 3 => [Some(OneCubic::through(h, slope).third); 2],
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
    fn through(h: &[f64], slope: &[f64]) -> OneCubic {
        let [h0, h1, h2] = [h[0], h[1], h[2]];
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

fn open(h: &[f64], slope: &[f64], first: End, last: End) -> Result<Vec<f64>, TridiagonalError> {
    use End::{FirstDerivative, NotAKnot, SecondDerivative};
    let n = h.len();
    let jump = |i: usize| 6.0 * (slope[i] - slope[i - 1]);
    if first == NotAKnot && last == NotAKnot && n < 3 {
        let m = if n == 1 {
            0.0
        } else {
            jump(1) / (3.0 * (h[0] + h[1]))
        };
        return Ok(vec![m; n + 1]);
    }
    if first == NotAKnot && last == NotAKnot && n == 3 {
        return Ok(OneCubic::through(h, slope).second.to_vec());
    }
    // A not-a-knot end is eliminated from the row of its neighbour.
    let s = usize::from(first == NotAKnot);
    let e = n - usize::from(last == NotAKnot);
    // Rows s … e: `h_{i−1} m_{i−1} + 2 (h_{i−1} + h_i) m_i + h_i m_{i+1} = d_i` but for the ends.
    let (mut lower, mut upper) = (h[s..e].to_vec(), h[s..e].to_vec());
    let (mut diagonal, mut d) = (Vec::with_capacity(n + 1), Vec::with_capacity(n + 1));
    if s == 0 {
        let (b, c, right) = match first {
            FirstDerivative(v) => (2.0 * h[0], h[0], 6.0 * (slope[0] - v)),
            SecondDerivative(v) => (1.0, 0.0, v),
            NotAKnot => unreachable!("row 0 is eliminated"),
        };
        diagonal.push(b);
        upper[0] = c;
        d.push(right);
    }
    let neighbours = s.max(1) - 1..e.min(n - 1) + 1;
    let steps = h[neighbours.clone()].windows(2);
    diagonal.extend(steps.map(|h| 2.0 * (h[0] + h[1])));
    let slopes = slope[neighbours].windows(2);
    d.extend(slopes.map(|slope| 6.0 * (slope[1] - slope[0])));
    if e == n {
        let (a, b, right) = match last {
            FirstDerivative(v) => (h[n - 1], 2.0 * h[n - 1], 6.0 * (v - slope[n - 1])),
            SecondDerivative(v) => (0.0, 1.0, v),
            NotAKnot => unreachable!("row n is eliminated"),
        };
        lower[n - 1 - s] = a;
        diagonal.push(b);
        d.push(right);
    }
    if s == 1 {
        // m_0 = m_1 + (p/q)(m_1 − m_2); the row divided by (p + q)/q.
        let (p, q) = (h[0], h[1]);
        (diagonal[0], upper[0], d[0]) = (p + 2.0 * q, q - p, jump(1) * (q / (p + q)));
    }
    if e == n - 1 {
        let (p, q, row) = (h[n - 2], h[n - 1], e - s);
        (lower[row - 1], diagonal[row]) = (p - q, q + 2.0 * p);
        d[row] = jump(e) * (p / (p + q));
    }
    let mut m = vec![0.0; n + 1];
    Sweep::factor(&lower, &diagonal, &upper)?.solve_in_place(&mut d)?;
    m[s..=e].copy_from_slice(&d);
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
        m[0] = end(h[0], h[1], m[1], m[2], jump(1));
    }
    if e == n - 1 {
        m[n] = end(h[n - 1], h[n - 2], m[n - 1], m[n - 2], jump(n - 1));
    }
    Ok(m)
}

fn periodic(h: &[f64], slope: &[f64]) -> Result<Vec<f64>, TridiagonalError> {
    let n = h.len();
    let before = |i: usize| (i + n - 1) % n;
    let jump = |i: usize| 6.0 * (slope[i] - slope[before(i)]);
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
            let d: Vec<f64> = (0..n).map(jump).collect();
            CyclicSweep::factor(&lower, &diagonal, h)?.solve(&d)?
        }
    };
    m.push(m[0]);
    Ok(m)
}
