//! A four-bar as drawn: crank AB, coupler BC, rocker DC, by the two circles around B and D, in
//! balls.

use crate::reference::{Ball, ComplexBall, Undecided};
use rug::Rational;

/// Working precision in bits.
pub const BITS: u32 = 160;

/// Degrees as an angle.
pub fn degrees(x: &Rational) -> Ball {
    Ball::pi(BITS) * Ball::rational(BITS, &Rational::from(x / 180u32))
}

/// A four-bar in the position in which it was drawn.
pub struct FourBar {
    a: ComplexBall,
    d: ComplexBall,
    crank: ComplexBall,
    /// Squares of the lengths of coupler and rocker.
    squares: [Ball; 2],
    /// True if C was drawn to the left of the way from B to D.
    pub left: bool,
}

/// Coupler's end on both sides of BD.
pub struct Modes {
    /// B.
    pub b: ComplexBall,
    /// C on the drawn side, then on the other.
    pub c: [ComplexBall; 2],
}

impl FourBar {
    /// The four-bar through A, B, C, D; undecided if C is not certainly on one side.
    ///
    /// # Errors
    /// [`Undecided`] if B, C and D lie on one line as far as the balls tell.
    pub fn new([a, b, c, d]: [ComplexBall; 4]) -> Result<FourBar, Undecided> {
        let side = (&d - &b).cross(&(&c - &b));
        if side.contains_zero() {
            return Err(undecided("the drawn side"));
        }
        Ok(FourBar {
            crank: &b - &a,
            squares: [&b, &d].map(|end| (&c - end).norm_sqr()),
            left: side.is_positive(),
            a,
            d,
        })
    }

    /// Both positions of C with the crank turned by an angle from the drawing; none past a dead
    /// position.
    ///
    /// # Errors
    /// [`Undecided`] too near a dead position.
    pub fn modes(&self, turned: &Ball) -> Result<Option<Modes>, Undecided> {
        let b = &self.a + &(&self.crank * &ComplexBall::unit(turned));
        let way = &self.d - &b;
        let n = way.norm_sqr();
        let [l, s] = &self.squares;
        let along = (&n + l - s) / n.shift(1);
        let across = l / &n - along.square();
        if across.is_negative() {
            return Ok(None);
        }
        if !across.is_positive() {
            return Err(undecided("a position next to a dead one"));
        }
        let height = across.sqrt();
        let foot = &b + &way.scaled(&along);
        let off = way.turned().scaled(&height);
        let [plus, less] = [&foot + &off, &foot - &off];
        let c = match self.left {
            true => [plus, less],
            false => [less, plus],
        };
        Ok(Some(Modes { b, c }))
    }
}

fn undecided(what: &str) -> Undecided {
    Undecided {
        bits: BITS,
        reason: format!("{what} cannot be told"),
    }
}

/// Where taking the nearest of both positions leaves the drawn side, in steps of so many degrees
/// clockwise from the drawing: degrees turned, if it does before the dead position.
///
/// # Errors
/// [`Undecided`] if both are equally near as far as the balls tell.
pub fn nearest_leaves(linkage: &FourBar, step: &Rational) -> Result<Option<Rational>, Undecided> {
    let mut turned = Rational::new();
    let drawn = linkage.modes(&degrees(&turned))?;
    let mut before = drawn.ok_or_else(|| undecided("the drawn position"))?.c[0].clone();
    loop {
        turned -= step;
        let Some(modes) = linkage.modes(&degrees(&turned))? else {
            return Ok(None);
        };
        let [held, other] = modes.c.each_ref().map(|c| (c - &before).norm_sqr());
        let nearer = other - held;
        match () {
            () if nearer.is_positive() => before = modes.c[0].clone(),
            () if nearer.is_negative() => return Ok(Some(-turned)),
            () => return Err(undecided("which position is nearer")),
        }
    }
}

/// The largest turn of the coupler over a step of the crank clockwise, in degrees, and where it
/// ends.
///
/// # Errors
/// [`Undecided`] too near a dead position.
pub fn swiftest(linkage: &FourBar, step: u32) -> Result<(f64, u32), Undecided> {
    let mut most = (0.0, 0);
    let mut before: Option<ComplexBall> = None;
    let mut turned = 0;
    while let Some(modes) = linkage.modes(&degrees(&-Rational::from(turned)))? {
        let coupler = &modes.c[0] - &modes.b;
        if let Some(before) = &before {
            let turn = before.cross(&coupler).atan2(&before.dot(&coupler));
            let turn = turn.to_f64().abs().to_degrees();
            most = if turn > most.0 { (turn, turned) } else { most };
        }
        before = Some(coupler);
        turned += step;
    }
    Ok(most)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(points: [[f64; 2]; 4]) -> [ComplexBall; 4] {
        let ball = |x: f64| Ball::exact(BITS, x);
        points.map(|[x, y]| ComplexBall::new(ball(x), ball(y)))
    }

    /// Crank 1, coupler 2, rocker 2, frame 3, drawn with the crank square to the frame; halves are
    /// exact.
    fn swinging() -> [ComplexBall; 4] {
        drawn([[0.0, 0.0], [0.0, 1.0], [2.0, 1.0], [3.0, -0.5]])
    }

    #[test]
    fn positions_keep_the_lengths_and_begin_with_the_drawing() {
        let points = swinging();
        let linkage = FourBar::new(points.clone()).unwrap();
        let [_, b, c, d] = &points;
        let here = linkage.modes(&Ball::integer(BITS, 0)).unwrap().unwrap();
        assert!((&here.c[0] - c).norm_sqr().contains_zero());
        let due = [b, d].map(|end| (c - end).norm_sqr());
        for turned in [-20, 7, 31] {
            let modes = linkage
                .modes(&degrees(&Rational::from(turned)))
                .unwrap()
                .unwrap();
            for c in &modes.c {
                let way = [&(c - &modes.b), &(c - d)].map(ComplexBall::norm_sqr);
                assert!(
                    way.iter().zip(&due).all(|(n, due)| n.overlaps(due)),
                    "{turned}"
                );
            }
            let off = (&modes.c[0] - &modes.c[1]).norm_sqr();
            assert!(off.is_positive());
        }
    }

    #[test]
    fn what_balls_cannot_tell_is_undecided() {
        let flat = drawn([[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 1.0]]);
        assert!(FourBar::new(flat).is_err());
        // Coupler and rocker of 2 reach as far as 4, from B at (0, 1) to (4, 1) after no turn.
        let linkage = FourBar {
            squares: [4, 4].map(|n| Ball::integer(BITS, n)),
            ..FourBar::new(drawn([[0.0, 0.0], [0.0, 1.0], [2.0, 2.0], [4.0, 1.0]])).unwrap()
        };
        assert!(linkage.modes(&Ball::integer(BITS, 0)).is_err());
    }
}
