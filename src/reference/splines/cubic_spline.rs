//! Exact cubic splines, from the slopes at the knots.
//!
//! The unknowns are the first derivatives `s_i`, not the second ones. With steps `h_i` and
//! divided differences `δ_i` the second derivative is continuous where
//!
//! ```text
//! s_{i−1}/h_{i−1} + 2 (1/h_{i−1} + 1/h_i) s_i + s_{i+1}/h_i = 3 (δ_{i−1}/h_{i−1} + δ_i/h_i)
//! ```
//!
//! and a segment is `y_i + u (s_i + u (c + u d))` with `u = x − x_i`, `c = (3δ − 2s_i −
//! s_{i+1})/h`, `d = (s_i + s_{i+1} − 2δ)/h²` (de Boor, *A Practical Guide to Splines*, ch. IV).
//!
//! [`Spline`] is exact. [`periodic_uniform`] takes balls as ordinates.

use crate::ball::Ball;
use crate::tridiagonal::{Equation, equation, solve_sparse};
use rug::Rational;

/// Why there is no spline.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SplineError {
    /// Fewer than two knots, or no ordinate.
    #[error("{0} knots are too few")]
    TooFew(usize),
    /// Not as many ordinates as knots.
    #[error("{values} values for {knots} knots")]
    Length {
        /// Number of knots.
        knots: usize,
        /// Number of ordinates.
        values: usize,
    },
    /// A knot that is not greater than its predecessor.
    #[error("knot {0} is not greater than its predecessor")]
    NotIncreasing(usize),
    /// The first and the last ordinate of a periodic spline differ.
    #[error("the end ordinates of a periodic spline differ")]
    NotPeriodic,
}

/// An exact cubic spline.
#[derive(Clone, Debug)]
pub struct Spline {
    x: Vec<Rational>,
    y: Vec<Rational>,
    /// Slopes at the knots.
    pub(super) s: Vec<Rational>,
}

/// Steps, and the slopes of the chords over them.
pub(super) struct Data {
    pub(super) h: Vec<Rational>,
    pub(super) delta: Vec<Rational>,
}

impl Data {
    pub(super) fn new(x: &[Rational], y: &[Rational]) -> Result<Data, SplineError> {
        if x.len() != y.len() {
            return Err(SplineError::Length {
                knots: x.len(),
                values: y.len(),
            });
        }
        if x.len() < 2 {
            return Err(SplineError::TooFew(x.len()));
        }
        if let Some(i) = (1..x.len()).find(|&i| x[i] <= x[i - 1]) {
            return Err(SplineError::NotIncreasing(i));
        }
        let h: Vec<Rational> = x
            .windows(2)
            .map(|p| Rational::from(&p[1] - &p[0]))
            .collect();
        let delta = y
            .windows(2)
            .zip(&h)
            .map(|(p, h)| Rational::from(&p[1] - &p[0]) / h);
        Ok(Data {
            delta: delta.collect(),
            h,
        })
    }

    /// Continuity of `S''` between the segments `a` and `b`, whose knots are `i`, `j`, `k`,
    /// multiplied by `h_a h_b`: of knots that are floats the rows then have short denominators.
    fn smooth(&self, (a, b): (usize, usize), (i, j, k): (usize, usize, usize)) -> Equation {
        let (p, q) = match self.h[a] == self.h[b] {
            true => (Rational::from(1), Rational::from(1)),
            false => (self.h[b].clone(), self.h[a].clone()),
        };
        let middle = Rational::from(&p + &q) * 2;
        let rhs = (Rational::from(&p * &self.delta[a]) + Rational::from(&q * &self.delta[b])) * 3;
        equation([(i, p), (j, middle), (k, q)], vec![rhs])
    }

    /// Equal third derivatives of segments `a` and `a + 1`.
    fn not_a_knot(&self, a: usize) -> Equation {
        let inverse_square = |h: &Rational| h.clone().square().recip();
        let (p, q) = (inverse_square(&self.h[a]), inverse_square(&self.h[a + 1]));
        let rhs =
            (Rational::from(&p * &self.delta[a]) - Rational::from(&q * &self.delta[a + 1])) * 2;
        let middle = Rational::from(&p - &q);
        equation([(a, p), (a + 1, middle), (a + 2, -q)], vec![rhs])
    }

    /// The slopes of the parabola through three points.
    fn parabola(&self) -> Vec<Rational> {
        let c = Rational::from(&self.delta[1] - &self.delta[0])
            / Rational::from(&self.h[0] + &self.h[1]);
        let (p, q) = (
            Rational::from(&self.h[0] * &c),
            Rational::from(&self.h[1] * &c),
        );
        vec![
            Rational::from(&self.delta[0] - &p),
            Rational::from(&self.delta[0] + &p),
            Rational::from(&self.delta[1] + &q),
        ]
    }

    /// The condition at the end that is knot `i`, the first or the last one.
    fn end(&self, i: usize, end: End) -> Equation {
        let n = self.h.len();
        let (segment, other) = match i {
            0 => (0, 1),
            _ => (n - 1, n - 1),
        };
        match end {
            End::FirstDerivative(v) => equation([(i, Rational::from(1))], vec![v.clone()]),
            End::SecondDerivative(v) => {
                let entries = [(i, Rational::from(2)), (other, Rational::from(1))];
                let chords = Rational::from(&self.delta[segment] * 3);
                let bent = Rational::from(&self.h[segment] * v) / 2;
                let rhs = if i == 0 { chords - bent } else { chords + bent };
                equation(entries, vec![rhs])
            }
            End::NotAKnot => self.not_a_knot(if i == 0 { 0 } else { n - 2 }),
        }
    }

    fn open(&self, first: Equation, last: Equation) -> Vec<Rational> {
        let n = self.h.len();
        let mut rows = vec![first];
        rows.extend((1..n).map(|i| self.smooth((i - 1, i), (i - 1, i, i + 1))));
        rows.push(last);
        solve(n + 1, rows)
    }
}

/// The interpolation conditions used here have exactly one solution, so the system is regular.
fn solve(n: usize, rows: Vec<Equation>) -> Vec<Rational> {
    let x = solve_sparse(n, rows).expect("spline systems are regular");
    x.into_iter().flatten().collect()
}

/// The condition of a spline at one end.
#[derive(Clone, Copy, Debug)]
pub enum End<'a> {
    /// The second derivative there.
    SecondDerivative(&'a Rational),
    /// The first derivative there.
    FirstDerivative(&'a Rational),
    /// The third derivative is continuous at the neighbouring knot.
    NotAKnot,
}

impl Spline {
    pub(super) fn new(x: &[Rational], y: &[Rational], s: Vec<Rational>) -> Spline {
        Spline {
            x: x.to_vec(),
            y: y.to_vec(),
            s,
        }
    }

    /// With a condition for each end. Not-a-knot at both ends gives the line of two knots and the
    /// parabola of three; at one end alone it needs three knots.
    ///
    /// # Errors
    /// [`SplineError`].
    pub fn with_ends(
        x: &[Rational],
        y: &[Rational],
        first: End,
        last: End,
    ) -> Result<Spline, SplineError> {
        let d = Data::new(x, y)?;
        let n = d.h.len();
        let free = [first, last].map(|end| matches!(end, End::NotAKnot));
        let s = match (n, free) {
            (1, [true, true]) => vec![d.delta[0].clone(); 2],
            (2, [true, true]) => d.parabola(),
            (1, [true, false] | [false, true]) => return Err(SplineError::TooFew(x.len())),
            _ => d.open(d.end(0, first), d.end(n, last)),
        };
        Ok(Spline::new(x, y, s))
    }

    /// With given second derivatives at the ends.
    ///
    /// # Errors
    /// [`SplineError`].
    pub fn second_derivatives(
        x: &[Rational],
        y: &[Rational],
        first: &Rational,
        last: &Rational,
    ) -> Result<Spline, SplineError> {
        let end = End::SecondDerivative;
        Spline::with_ends(x, y, end(first), end(last))
    }

    /// With zero second derivatives at the ends.
    ///
    /// # Errors
    /// [`SplineError`].
    pub fn natural(x: &[Rational], y: &[Rational]) -> Result<Spline, SplineError> {
        Spline::second_derivatives(x, y, &Rational::new(), &Rational::new())
    }

    /// With given first derivatives at the ends.
    ///
    /// # Errors
    /// [`SplineError`].
    pub fn clamped(
        x: &[Rational],
        y: &[Rational],
        first: &Rational,
        last: &Rational,
    ) -> Result<Spline, SplineError> {
        let end = End::FirstDerivative;
        Spline::with_ends(x, y, end(first), end(last))
    }

    /// With continuous third derivatives at the second and the last knot but one. Two knots give
    /// the line, three the parabola.
    ///
    /// # Errors
    /// [`SplineError`].
    pub fn not_a_knot(x: &[Rational], y: &[Rational]) -> Result<Spline, SplineError> {
        Spline::with_ends(x, y, End::NotAKnot, End::NotAKnot)
    }

    /// With first and second derivatives that agree at the two ends.
    ///
    /// # Errors
    /// [`SplineError`].
    pub fn periodic(x: &[Rational], y: &[Rational]) -> Result<Spline, SplineError> {
        let d = Data::new(x, y)?;
        let n = d.h.len();
        if y[0] != y[n] {
            return Err(SplineError::NotPeriodic);
        }
        let before = |i: usize| (i + n - 1) % n;
        let row = |i: usize| d.smooth((before(i), i), (before(i), i, (i + 1) % n));
        let mut s = solve(n, (0..n).map(row).collect());
        s.push(s[0].clone());
        Ok(Spline::new(x, y, s))
    }

    /// The slopes at the knots.
    pub fn slopes(&self) -> &[Rational] {
        &self.s
    }

    /// The segment that holds `x`: the one that begins at `x` if that is an inner knot; the first
    /// or last one outside the knots.
    pub fn segment(&self, x: &Rational) -> usize {
        self.x[1..self.x.len() - 1].partition_point(|k| k <= x)
    }

    /// `u = x − x_i` and the coefficients of `1, u, u², u³` on segment `i`.
    fn cubic(&self, i: usize, x: &Rational) -> (Rational, [Rational; 4]) {
        let h = Rational::from(&self.x[i + 1] - &self.x[i]);
        let delta = Rational::from(&self.y[i + 1] - &self.y[i]) / &h;
        let (a, b) = (&self.s[i], &self.s[i + 1]);
        let c = (Rational::from(&delta * 3) - Rational::from(a * 2) - b) / &h;
        let d = (Rational::from(a + b) - delta * 2) / h.square();
        let u = Rational::from(x - &self.x[i]);
        (u, [self.y[i].clone(), a.clone(), c, d])
    }

    /// `S`, `S'`, `S''`, `S'''` at `x`; at an inner knot the third derivative is that of the
    /// segment to the right. Outside the knots the end cubics go on.
    ///
    /// ```
    /// use mechaudit_reference::cubic_spline::Spline;
    /// use rug::Rational;
    /// let q = |v: &[i32]| -> Vec<Rational> { v.iter().map(|&v| v.into()).collect() };
    /// let s = Spline::natural(&q(&[0, 1, 2]), &q(&[0, 1, 0]))?;
    /// assert_eq!(s.eval(&Rational::from((1, 2)))[0], Rational::from((11, 16)));
    /// # Ok::<(), mechaudit_reference::cubic_spline::SplineError>(())
    /// ```
    pub fn eval(&self, x: &Rational) -> [Rational; 4] {
        self.eval_on(self.segment(x), x)
    }

    /// As [`Spline::eval`], with the cubic of segment `i`.
    pub fn eval_on(&self, i: usize, x: &Rational) -> [Rational; 4] {
        let (u, [y, s, c, d]) = self.cubic(i, x);
        let du = Rational::from(&d * &u);
        let cu = Rational::from(&c + &du);
        let value = (Rational::from(&cu * &u) + &s) * &u + y;
        let first = (Rational::from(&c * 2) + Rational::from(&du * 3)) * &u + s;
        let second = c * 2 + du * 6;
        [value, first, second, d * 6]
    }

    /// A point as a whole number of periods, the distance of the end knots, and the rest within the
    /// first of them.
    fn wrap(&self, x: &Rational) -> (Rational, Rational) {
        let (first, last) = (&self.x[0], &self.x[self.x.len() - 1]);
        if first <= x && x <= last {
            return (Rational::new(), x.clone());
        }
        let period = Rational::from(last - first);
        let turns = (Rational::from(x - first) / &period).floor();
        let rest = x - Rational::from(&turns * &period);
        (turns, rest)
    }

    /// As [`Spline::eval`], continued with the period of the end knots' distance.
    pub fn eval_periodic(&self, x: &Rational) -> [Rational; 4] {
        self.eval(&self.wrap(x).1)
    }

    /// As [`Spline::integral`], continued with the period of the end knots' distance.
    pub fn integral_periodic(&self, a: &Rational, b: &Rational) -> Rational {
        let ((before, a), (after, b)) = (self.wrap(a), self.wrap(b));
        let turns = after - before;
        let part = self.integral(&a, &b);
        if turns == 0 {
            return part;
        }
        part + turns * self.integral(&self.x[0], &self.x[self.x.len() - 1])
    }

    /// `∫ S` from the first knot of segment `i` to `x`, with the cubic of that segment.
    fn primitive(&self, i: usize, x: &Rational) -> Rational {
        let (u, [y, s, c, d]) = self.cubic(i, x);
        (((d / 4 * &u + c / 3) * &u + s / 2) * &u + y) * u
    }

    /// `∫ S dx` from `a` to `b`, of either sign.
    pub fn integral(&self, a: &Rational, b: &Rational) -> Rational {
        if b < a {
            return -self.integral(b, a);
        }
        let (i, j) = (self.segment(a), self.segment(b));
        let mut sum = self.primitive(j, b) - self.primitive(i, a);
        for c in i..j {
            sum += self.whole(c);
        }
        sum
    }

    /// `∫ S` over segment `i`: `h (y_i + y_{i+1})/2 + h² (s_i − s_{i+1})/12`.
    fn whole(&self, i: usize) -> Rational {
        let h = Rational::from(&self.x[i + 1] - &self.x[i]);
        let bent = Rational::from(&self.s[i] - &self.s[i + 1]) * &h / 6u32;
        (Rational::from(&self.y[i] + &self.y[i + 1]) + bent) * h / 2u32
    }
}

/// A periodic spline on `N` equal steps through `N` balls (the ordinate after the last is the
/// first again).
#[derive(Clone, Debug)]
pub struct PeriodicUniform {
    y: Vec<Ball>,
    h: Ball,
    /// `h² m_i / 6 = Σ_j weight[(i − j) mod N] y_j`.
    weight: Vec<Rational>,
}

/// The periodic cubic spline through balls on equal steps `h`.
///
/// The second derivatives are `6/h² Σ_j c_{(i−j) mod N} y_j`, with `c` the product of the exact
/// inverse of the cyclic (1, 4, 1) matrix and the second-difference matrix. A value is one sum of
/// exact rational weights times ordinates, so the radius of an ordinate enters once.
///
/// # Errors
/// No ordinate.
pub fn periodic_uniform(values: &[Ball], h: &Ball) -> Result<PeriodicUniform, SplineError> {
    let n = values.len();
    if n == 0 {
        return Err(SplineError::TooFew(0));
    }
    // Both matrices are symmetric circulants: one column of their quotient is enough.
    let spread = |i: usize, middle: i32| {
        [((i + n - 1) % n, 1), (i, middle), ((i + 1) % n, 1)].map(|(j, v)| (j, Rational::from(v)))
    };
    let (difference, _) = equation(spread(0, -2), Vec::new());
    let row = |i: usize| {
        let rhs = difference.get(&i).cloned().unwrap_or_default();
        equation(spread(i, 4), vec![rhs])
    };
    Ok(PeriodicUniform {
        y: values.to_vec(),
        h: h.clone(),
        weight: solve(n, (0..n).map(row).collect()),
    })
}

impl PeriodicUniform {
    fn prec(&self) -> u32 {
        let ordinates = self.y.iter().map(Ball::prec);
        ordinates.fold(self.h.prec(), u32::max) + 32
    }

    /// `Σ_j f(j) y_j` with exact weights.
    fn sum(&self, f: impl Fn(usize) -> Rational) -> Ball {
        let p = self.prec();
        let mut sum = Ball::integer(p, 0);
        for (j, y) in self.y.iter().enumerate() {
            sum = &sum + &(&Ball::rational(p, &f(j)) * y);
        }
        sum
    }

    fn weight(&self, i: usize, j: usize) -> &Rational {
        let n = self.y.len();
        &self.weight[(i + n - j) % n]
    }

    /// The second derivatives at the knots.
    pub fn second_derivatives(&self) -> Vec<Ball> {
        let six = Ball::integer(self.prec(), 6);
        let factor = &six / &self.h.square();
        (0..self.y.len())
            .map(|i| &self.sum(|j| self.weight(i, j).clone()) * &factor)
            .collect()
    }

    /// The two knots of a segment, and 1 for knot `i` in column `i`.
    fn knots(&self, segment: usize) -> (usize, usize) {
        let n = self.y.len();
        (segment % n, (segment + 1) % n)
    }

    /// `S` at the fraction `k` of the segment that begins at knot `segment` (modulo `N`).
    pub fn value(&self, segment: usize, k: &Rational) -> Ball {
        let (a, b) = self.knots(segment);
        let w = Rational::from(1 - k);
        let t = Rational::from(k * &w);
        let (p, q) = (Rational::from(&w + 1) * &t, Rational::from(k + 1) * &t);
        self.sum(|j| {
            let mut f =
                -Rational::from(&p * self.weight(a, j)) - Rational::from(&q * self.weight(b, j));
            if j == a {
                f += &w;
            }
            if j == b {
                f += k;
            }
            f
        })
    }

    /// `S'` at the fraction `k` of the segment that begins at knot `segment` (modulo `N`).
    pub fn derivative(&self, segment: usize, k: &Rational) -> Ball {
        let (a, b) = self.knots(segment);
        let w = Rational::from(1 - k);
        let (p, q) = (w.square() * 3 - 1u32, k.clone().square() * 3 - 1u32);
        let sum = self.sum(|j| {
            let mut f =
                Rational::from(&q * self.weight(b, j)) - Rational::from(&p * self.weight(a, j));
            if j == a {
                f -= 1;
            }
            if j == b {
                f += 1;
            }
            f
        });
        &sum / &self.h
    }
}

#[cfg(test)]
mod tests;
