//! Second derivatives on equally spaced knots, without divisions in the inner loop.
//!
//! In the scale `M_i = m_i h²/6` the system is
//! `M_{i−1} + 4 M_i + M_{i+1} = y_{i−1} − 2 y_i + y_{i+1}` and the sweep `λ_i = −1/(4 + λ_{i−1})`,
//! `η_i = λ_i (η_{i−1} − d_i)`, `M_i = λ_i M_{i+1} + η_i`. The `λ_i` converge to `√3 − 2`; the
//! iteration shrinks errors fourteenfold each step, so after at most 20 steps they repeat bit for
//! bit and the tail uses one constant.
//!
//! The sweep runs from both ends at once and meets in the middle: two independent chains of
//! operations, where one would leave the processor waiting for its own results.

use super::boundary::{Boundary, End};
use super::error::CubicSplineError as Error;
use super::evaluate::plain;
use super::fit::{check_boundary, check_values};
use super::grid::{LARGEST, UniformKnots};
use super::spline::{Extrapolation, Spline, UniformCubicSpline};
use crate::cyclic_tridiagonal;

/// Room for the `λ_i` before they repeat.
const TABLE: usize = 24;

/// The `λ_i` from a first one on.
fn lambdas(first: f64) -> [f64; TABLE] {
    let mut t = [first; TABLE];
    for i in 1..TABLE {
        t[i] = -1.0 / (4.0 + t[i - 1]);
    }
    t
}

impl UniformCubicSpline {
    /// The spline through `(x_0 + i h, y_i)`. Outside the knots it gives an error until
    /// [`with_extrapolation`](Spline::with_extrapolation) says otherwise.
    ///
    /// # Errors
    /// [`CubicSplineError`](Error): as [`UniformKnots::new`] and
    /// [`CubicSpline::fit`](super::CubicSpline::fit).
    pub fn fit(
        origin: f64,
        step: f64,
        y: Vec<f64>,
        boundary: Boundary,
    ) -> Result<UniformCubicSpline, Error> {
        if y.len() < 2 {
            return Err(Error::TooFewKnots {
                needed: 2,
                got: y.len(),
            });
        }
        let grid = UniformKnots::new(origin, step, y.len() - 1)?;
        check_boundary(boundary, &y)?;
        let bend = match boundary {
            Boundary::Periodic => periodic(&y),
            Boundary::Ends(first, last) => open(&y, step, first, last),
        };
        // A value of `y` that is not finite, or too large, has reached the ends of the sweep.
        let Some(bend) = bend else {
            check_values(&y)?;
            return Err(Error::Overflow { knot: 0 });
        };
        let known = boundary.known();
        Ok(Spline {
            plain: plain(&grid, known),
            grid,
            y,
            bend,
            known,
            extrapolation: Extrapolation::Error,
        })
    }
}

/// `λ`, `η` at an end. `rise` is the first difference of `y` away from the end, `direction` +1 at
/// the left end and −1 at the right.
fn seed(end: End, h: f64, rise: f64, direction: f64, second_difference: f64) -> (f64, f64) {
    match end {
        End::SecondDerivative(v) => (0.0, h * h / 6.0 * v),
        End::FirstDerivative(v) => (-0.5, 0.5 * (rise - direction * h * v)),
        // M_0 = 2 M_1 − M_2 leaves 6 M_1 = d_1.
        End::NotAKnot => (0.0, second_difference / 6.0),
    }
}

fn open(y: &[f64], h: f64, first: End, last: End) -> Option<Vec<f64>> {
    let n = y.len() - 1;
    let d = |i: usize| (y[i + 1] - y[i]) - (y[i] - y[i - 1]);
    let mut m = vec![0.0; n + 1];
    if n == 1 {
        check_values(y).ok()?;
    }
    if first == End::NotAKnot && last == End::NotAKnot && n < 3 {
        check_values(y).ok()?;
        if n == 2 {
            m.fill(d(1) / 6.0);
        }
        return Some(m);
    }
    let s = usize::from(first == End::NotAKnot);
    let e = n - usize::from(last == End::NotAKnot);
    let at = |i: usize| if n > 1 { d(i) } else { 0.0 };
    let left = seed(first, h, y[1] - y[0], 1.0, at(1));
    let right = seed(last, h, y[n - 1] - y[n], -1.0, at(n - 1));
    let middle = (s + e) / 2;
    let big = both_ways(y, &mut m, (s, middle, e), left, right);
    if s == 1 {
        m[0] = 2.0 * m[1] - m[2];
    }
    if e == n - 1 {
        m[n] = 2.0 * m[n - 1] - m[n - 2];
    }
    let seen = [m[0], m[s], m[middle], m[middle + 1], m[e], m[n], big];
    // NaN, infinities and what is too large fail this comparison.
    seen.iter().all(|v| v.abs() <= LARGEST).then_some(m)
}

/// The sweep over the unknowns `s ..= e` from both ends; `m` receives the solution. Returns the
/// largest `|y|`, NaN aside.
fn both_ways(
    y: &[f64],
    m: &mut [f64],
    (s, middle, e): (usize, usize, usize),
    left: (f64, f64),
    right: (f64, f64),
) -> f64 {
    let (lt, rt) = (lambdas(left.0), lambdas(right.0));
    let constant = lt[TABLE - 1];
    let (mut u, mut v) = (left.1, right.1);
    m[s] = u;
    m[e] = v;
    // Unknowns s ..= middle belong to the left chain, middle+1 ..= e to the right one; the left
    // chain has as many or one more.
    let (nl, nr) = (middle - s + 1, e - middle);
    let both = nr.min(nl);
    let early = both.min(TABLE);
    let ends = [y[0], y[s], y[e], y[y.len() - 1]];
    let mut big = ends.iter().fold(0f64, |b, v| b.max(v.abs()));
    let up = |i: usize, u: f64, lambda: f64| lambda * (u - ((y[i + 1] - y[i]) - (y[i] - y[i - 1])));
    for t in 1..early {
        u = up(s + t, u, lt[t]);
        v = up(e - t, v, rt[t]);
        m[s + t] = u;
        m[e - t] = v;
        big = big.max(y[s + t].abs()).max(y[e - t].abs());
    }
    if both > early {
        // The constant part, on slices of one length so that no index needs a check.
        let k = both - early;
        let (a, b) = (s + early, e + 1 - both);
        let (yl, yr) = (&y[a - 1..a + k + 1], &y[b - 1..b + k + 1]);
        let (front, back) = m.split_at_mut(b);
        let (ml, mr) = (&mut front[a..a + k], &mut back[..k]);
        (u, v, big) = constant_part(yl, yr, ml, mr, (u, v, big), constant);
    }
    if nl > nr {
        u = up(middle, u, lt[(nl - 1).min(TABLE - 1)]);
        m[middle] = u;
        big = big.max(y[middle].abs());
    }
    // The two chains meet: M = λ M' + η and M' = λ' M + η'.
    let (l, r) = (lt[(nl - 1).min(TABLE - 1)], rt[(nr - 1).min(TABLE - 1)]);
    let det = 1.0 - l * r;
    let mut p = (u + l * v) / det;
    let mut q = (v + r * u) / det;
    m[middle] = p;
    m[middle + 1] = q;
    if nl > nr {
        p = lt[(nl - 2).min(TABLE - 1)] * p + m[middle - 1];
        m[middle - 1] = p;
    }
    let mut t = both - 1;
    if both > early {
        let k = both - early;
        let (a, b) = (s + early - 1, e + 2 - both);
        let (front, back) = m.split_at_mut(b);
        // The first of these was just set where both chains have the same length.
        (p, q) = constant_back(&mut front[a + 1..a + k], &mut back[..k - 1], p, q, constant);
        t = early;
    }
    while t > 0 {
        t -= 1;
        p = lt[t] * p + m[s + t];
        q = rt[t] * q + m[e - t];
        m[s + t] = p;
        m[e - t] = q;
    }
    big
}

/// Forward elimination with constant `λ`: upwards in `ml`, downwards in `mr`. `yl` and `yr` begin
/// one before the knots of `ml` and `mr` and end one after.
#[inline]
fn constant_part(
    yl: &[f64],
    yr: &[f64],
    ml: &mut [f64],
    mr: &mut [f64],
    (mut u, mut v, mut big): (f64, f64, f64),
    lambda: f64,
) -> (f64, f64, f64) {
    let k = ml.len();
    let mut rise = yl[1] - yl[0];
    let mut fall = yr[k + 1] - yr[k];
    let mut big_right = 0f64;
    let left = ml.iter_mut().zip(yl[1..].windows(2));
    let right = mr.iter_mut().zip(yr[..k + 1].windows(2)).rev();
    for ((ml, a), (mr, b)) in left.zip(right) {
        let next = a[1] - a[0];
        u = lambda * (u - (next - rise));
        rise = next;
        *ml = u;
        big = big.max(a[0].abs());
        let next = b[1] - b[0];
        v = lambda * (v - (fall - next));
        fall = next;
        *mr = v;
        big_right = big_right.max(b[1].abs());
    }
    (u, v, big.max(big_right))
}

/// Back substitution with constant `λ`: downwards in `ml`, upwards in `mr`.
#[inline]
fn constant_back(
    ml: &mut [f64],
    mr: &mut [f64],
    mut p: f64,
    mut q: f64,
    lambda: f64,
) -> (f64, f64) {
    for (a, b) in ml.iter_mut().rev().zip(mr.iter_mut()) {
        p = lambda * p + *a;
        *a = p;
        q = lambda * q + *b;
        *b = q;
    }
    (p, q)
}

fn periodic(y: &[f64]) -> Option<Vec<f64>> {
    check_values(y).ok()?;
    let n = y.len() - 1;
    let y = &y[..n];
    let d: Vec<f64> = (0..n)
        .map(|i| (y[(i + 1) % n] - y[i]) - (y[i] - y[(i + n - 1) % n]))
        .collect();
    let mut m = match n {
        1 => vec![0.0],
        2 => vec![d[0] / 2.0, d[1] / 2.0],
        _ => {
            let (ones, mut m) = (vec![1.0; n], d);
            cyclic_tridiagonal::solve_in_place(&ones, &vec![4.0; n], &ones, &mut m, false).ok()?;
            m
        }
    };
    m.push(m[0]);
    Some(m)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lambdas_repeat_before_the_table_ends() {
        for first in [0.0, -0.5] {
            let t = lambdas(first);
            let settled = (0..TABLE).find(|&i| t[i] == t[TABLE - 1]).unwrap();
            assert!(settled <= 20, "{settled}");
            assert_eq!(-1.0 / (4.0 + t[TABLE - 1]), t[TABLE - 1]);
            assert_eq!(t[TABLE - 1], lambdas(0.0)[TABLE - 1]);
            // √3 − 2, rounded to nearest.
            assert_eq!(t[TABLE - 1], -0.267_949_192_431_122_7);
        }
    }
}
