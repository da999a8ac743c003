//! Exact PCHIP, Akima and modified Akima interpolants: slopes from neighbouring chords.
//!
//! The definitions are worked out in rational arithmetic as they are printed, so that every sign
//! and every comparison is decided exactly at the given numbers. With steps `h_i` and chord slopes
//! `δ_i`:
//!
//! * PCHIP (Fritsch & Butland 1984; ends as in `PCHIM` and in Moler's `pchiptx`): 0 where
//!   `δ_{i−1} δ_i ≤ 0`, else `δ_{i−1} δ_i / (α δ_i + (1 − α) δ_{i−1})` with
//!   `α = (h_{i−1} + 2h_i)/(3(h_{i−1} + h_i))`.
//! * Akima (1970), eq. (1): the mean of `δ_{i−1}` and `δ_i` with the weights `|δ_{i+1} − δ_i|` and
//!   `|δ_{i−1} − δ_{i−2}|`, and with equal ones where both of these are 0; chords go on linearly at
//!   the ends.
//! * Modified Akima (MATLAB's `makima`): `|δ_{i+1} + δ_i|/2` and `|δ_{i−1} + δ_{i−2}|/2` are added
//!   to the weights.

use super::cubic_spline::{Data, Spline, SplineError};
use rug::Rational;
use std::cmp::Ordering;

/// The weight of a chord, from the two chords beyond its neighbour.
type Weight = fn(&Rational, &Rational) -> Rational;

impl Spline {
    /// The monotone interpolant of Fritsch and Butland, known as PCHIP.
    ///
    /// # Errors
    /// [`SplineError`].
    ///
    /// ```
    /// use mechaudit_reference::cubic_spline::Spline;
    /// use rug::Rational;
    /// let q = |v: &[i32]| -> Vec<Rational> { v.iter().map(|&v| v.into()).collect() };
    /// let s = Spline::pchip(&q(&[0, 1, 3, 4]), &q(&[0, 1, 5, 4]))?;
    /// assert_eq!(s.slopes()[1], Rational::from((9, 7)));
    /// # Ok::<(), mechaudit_reference::cubic_spline::SplineError>(())
    /// ```
    pub fn pchip(x: &[Rational], y: &[Rational]) -> Result<Spline, SplineError> {
        let d = Data::new(x, y)?;
        let n = d.h.len();
        if n == 1 {
            return Ok(Spline::line(x, y, d));
        }
        let mut s = vec![parabolic_end(
            [&d.h[0], &d.h[1]],
            [&d.delta[0], &d.delta[1]],
        )];
        for i in 1..n {
            let (p, q) = (&d.delta[i - 1], &d.delta[i]);
            let product = Rational::from(p * q);
            if product <= 0 {
                s.push(Rational::new());
                continue;
            }
            let third = Rational::from(&d.h[i - 1] + &d.h[i]) * 3;
            let alpha = (Rational::from(&d.h[i] * 2) + &d.h[i - 1]) / third;
            let rest = Rational::from(1 - &alpha);
            s.push(product / (alpha * q + rest * p));
        }
        s.push(parabolic_end(
            [&d.h[n - 1], &d.h[n - 2]],
            [&d.delta[n - 1], &d.delta[n - 2]],
        ));
        Ok(Spline::new(x, y, s))
    }

    /// Akima's interpolant of 1970.
    ///
    /// # Errors
    /// [`SplineError`].
    pub fn akima(x: &[Rational], y: &[Rational]) -> Result<Spline, SplineError> {
        Spline::of_weighted_chords(x, y, |a, b| Rational::from(a - b).abs())
    }

    /// The modified Akima interpolant, MATLAB's `makima`.
    ///
    /// # Errors
    /// [`SplineError`].
    pub fn modified_akima(x: &[Rational], y: &[Rational]) -> Result<Spline, SplineError> {
        Spline::of_weighted_chords(x, y, |a, b| {
            Rational::from(a - b).abs() + Rational::from(a + b).abs() / 2
        })
    }

    fn of_weighted_chords(
        x: &[Rational],
        y: &[Rational],
        weight: Weight,
    ) -> Result<Spline, SplineError> {
        let mut d = Data::new(x, y)?;
        if d.h.len() == 1 {
            return Ok(Spline::line(x, y, d));
        }
        let beyond = |near: &Rational, far: &Rational| Rational::from(near * 2) - far;
        // m_{i+2} is the chord δ_i.
        let m = &mut d.delta;
        for _ in 0..2 {
            m.insert(0, beyond(&m[0], &m[1]));
            m.push(beyond(&m[m.len() - 1], &m[m.len() - 2]));
        }
        let slope = |m: &[Rational]| {
            let (of_left, of_right) = (weight(&m[3], &m[2]), weight(&m[1], &m[0]));
            let both = Rational::from(&of_left + &of_right);
            match both.cmp0() {
                Ordering::Equal => Rational::from(&m[1] + &m[2]) / 2,
                _ => (of_left * &m[1] + of_right * &m[2]) / both,
            }
        };
        let s = m.windows(4).map(slope).collect();
        Ok(Spline::new(x, y, s))
    }

    fn line(x: &[Rational], y: &[Rational], d: Data) -> Spline {
        Spline::new(x, y, vec![d.delta[0].clone(), d.delta[0].clone()])
    }
}

/// The slope at an end of the parabola through three points, made compatible with monotone data.
/// The end's own step and chord come first.
fn parabolic_end(h: [&Rational; 2], chords: [&Rational; 2]) -> Rational {
    let ([near, far], [p, q]) = (h, chords);
    let steps = Rational::from(near + far);
    let slope = (Rational::from(near + &steps) * p - Rational::from(near * q)) / steps;
    let limit = Rational::from(p * 3);
    if slope.cmp0() != p.cmp0() {
        Rational::new()
    } else if q.cmp0() != p.cmp0() && slope.cmp_abs(&limit) == Ordering::Greater {
        limit
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn q(v: &[i32]) -> Vec<Rational> {
        v.iter().map(|&v| v.into()).collect()
    }

    fn fractions(v: &[(i32, i32)]) -> Vec<Rational> {
        v.iter().map(|&v| v.into()).collect()
    }

    /// Chords 1, 2, −1 over steps 1, 2, 1, by hand.
    #[test]
    fn slopes_are_those_of_the_definitions() {
        let (x, y) = (q(&[0, 1, 3, 4]), q(&[0, 1, 5, 4]));
        let s = Spline::pchip(&x, &y).unwrap();
        assert_eq!(s.slopes(), fractions(&[(2, 3), (9, 7), (0, 1), (-2, 1)]));
        let s = Spline::akima(&x, &y).unwrap();
        assert_eq!(s.slopes(), fractions(&[(1, 2), (5, 4), (5, 4), (-5, 2)]));
        let s = Spline::modified_akima(&x, &y).unwrap();
        let due = fractions(&[(3, 8), (13, 10), (17, 16), (-15, 8)]);
        assert_eq!(s.slopes(), due);
    }

    #[test]
    fn ends_are_clipped() {
        let slopes = |y: &[i32]| Spline::pchip(&q(&[0, 1, 2, 3]), &q(y)).unwrap().s;
        assert_eq!(slopes(&[0, 1, 5, 5])[0], 0);
        assert_eq!(slopes(&[0, 1, -9, 0])[0], 3);
        assert_eq!(slopes(&[0, -9, 1, 0])[3], -3);
        assert_eq!(slopes(&[0, 0, 5, 5]), q(&[0, 0, 0, 0]));
    }

    #[test]
    fn weights_that_vanish_give_the_mean() {
        let (x, y) = (q(&[0, 1, 2, 3, 4]), q(&[0, 0, 0, 1, 2]));
        let due = fractions(&[(0, 1), (0, 1), (1, 2), (1, 1), (1, 1)]);
        assert_eq!(Spline::akima(&x, &y).unwrap().slopes(), due);
        let modified = Spline::modified_akima(&x, &y).unwrap();
        assert_eq!(modified.slopes()[2], 0);
        let level = Spline::modified_akima(&x, &q(&[3; 5])).unwrap();
        assert_eq!(level.slopes(), q(&[0; 5]));
    }

    #[test]
    fn lines_and_refusals() {
        for f in [Spline::pchip, Spline::akima, Spline::modified_akima] {
            for n in 2..7 {
                let x: Vec<i32> = (0..n).map(|i| i * i).collect();
                let y: Vec<i32> = x.iter().map(|x| 3 * x - 2).collect();
                let s = f(&q(&x), &q(&y)).unwrap();
                assert!(s.slopes().iter().all(|s| *s == 3));
                let at = Rational::from((5, 7));
                assert_eq!(s.eval(&at)[0], Rational::from((1, 7)));
                assert_eq!(s.eval(&at)[2..], q(&[0, 0]));
            }
            assert!(matches!(f(&q(&[1]), &q(&[1])), Err(SplineError::TooFew(1))));
            let equal = f(&q(&[1, 1]), &q(&[1, 2]));
            assert!(matches!(equal, Err(SplineError::NotIncreasing(1))));
        }
    }
}
