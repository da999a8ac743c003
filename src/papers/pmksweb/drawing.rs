//! A four-bar as drawn: crank AB, coupler BC, rocker DC, by the two circles around B and D, in
//! balls.

use crate::reference::{Ball, ComplexBall, Decimal, Undecided};
use rug::Rational;

/// Working precision in bits.
pub const BITS: u32 = 160;

/// A point of a drawing in cm.
pub type Drawn = [&'static str; 2];

/// A point or vector.
pub fn point([x, y]: Drawn) -> ComplexBall {
    let part = |text| Ball::rational(BITS, &decimal(text));
    ComplexBall::new(part(x), part(y))
}

fn decimal(text: &str) -> Rational {
    Decimal::parse(text).expect("a drawn coordinate").value
}

/// The square of the distance of two drawn points.
fn square(p: Drawn, q: Drawn) -> Rational {
    let parts = [0, 1].map(|i| (decimal(p[i]) - decimal(q[i])).square());
    let [x, y] = parts;
    x + y
}

/// Degrees as an angle.
pub fn degrees(x: &Rational) -> Ball {
    Ball::pi(BITS) * Ball::rational(BITS, &Rational::from(x / 180u32))
}

/// A four-bar in the position in which it was drawn.
pub struct FourBar {
    a: ComplexBall,
    d: ComplexBall,
    crank: ComplexBall,
    /// Lengths of crank, coupler, rocker, frame.
    pub lengths: [Ball; 4],
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
    pub fn new([a, b, c, d]: [Drawn; 4]) -> Result<FourBar, Undecided> {
        let squares = [square(a, b), square(b, c), square(c, d), square(a, d)];
        let balls = squares.each_ref().map(|s| Ball::rational(BITS, s));
        let way = &point(d) - &point(b);
        let side = way.cross(&(&point(c) - &point(b)));
        if side.contains_zero() {
            return Err(undecided("the drawn side"));
        }
        Ok(FourBar {
            crank: &point(b) - &point(a),
            a: point(a),
            d: point(d),
            lengths: balls.each_ref().map(Ball::sqrt),
            squares: [balls[1].clone(), balls[2].clone()],
            left: side.is_positive(),
        })
    }

    /// The square of the largest |BD| that coupler and rocker reach.
    fn stretched(&self) -> Ball {
        (&self.lengths[1] + &self.lengths[2]).square()
    }

    /// Returns the angle that the crank turns from the frame's direction, from A to D, to the dead
    /// position with B, C, D stretched on one line; none if it goes past there, because |BD| never
    /// gets so long.
    ///
    /// # Errors
    /// [`Undecided`] if the sum of two lengths may equal that of the others.
    pub fn dead(&self) -> Result<Option<Ball>, Undecided> {
        let [r, _, _, g] = &self.lengths;
        let cosine = (r.square() + g.square() - self.stretched()) / (r * g).shift(1);
        let sine = Ball::integer(BITS, 1) - cosine.square();
        match () {
            () if sine.is_positive() => Ok(Some(sine.sqrt().atan2(&cosine))),
            () if sine.is_negative() => Ok(None),
            () => Err(undecided("whether the crank turns fully")),
        }
    }

    /// Returns true if |BD| keeps above the difference of coupler and rocker, so that they never
    /// fold on each other.
    pub fn never_folds(&self) -> bool {
        let [r, l, s, g] = &self.lengths;
        ((r - g).abs() - (l - s).abs()).is_positive()
    }

    /// The angle of the crank as drawn less that of the frame.
    pub fn drawn(&self) -> Ball {
        let frame = &self.d - &self.a;
        frame.cross(&self.crank).atan2(&frame.dot(&self.crank))
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

pub(super) fn undecided(what: &str) -> Undecided {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Crank 1, coupler 2, rocker 2, frame 3, drawn with the crank square to the frame.
    const SWINGING: [Drawn; 4] = [["0", "0"], ["0", "1"], ["2", "1"], ["3.2", "-0.6"]];

    #[test]
    fn positions_keep_the_lengths_and_begin_with_the_drawing() {
        let linkage = FourBar::new(SWINGING).unwrap();
        let d = point(SWINGING[3]);
        let here = linkage.modes(&Ball::integer(BITS, 0)).unwrap().unwrap();
        assert!(
            (&here.c[0] - &point(SWINGING[2]))
                .norm_sqr()
                .contains_zero()
        );
        for turned in [-20, 7, 31] {
            let modes = linkage
                .modes(&degrees(&Rational::from(turned)))
                .unwrap()
                .unwrap();
            for c in &modes.c {
                let way = [&(c - &modes.b), &(c - &d)].map(ComplexBall::norm_sqr);
                assert!(
                    way.iter().all(|n| n.contains(&Rational::from(4))),
                    "{turned}"
                );
            }
            let off = (&modes.c[0] - &modes.c[1]).norm_sqr();
            assert!(off.is_positive());
        }
    }

    /// |AD| − |AB| = 2.26, and coupler and rocker differ by nothing, or by 2.59.
    #[test]
    fn coupler_and_rocker_fold_where_their_difference_is_reached() {
        assert!(FourBar::new(SWINGING).unwrap().never_folds());
        let [a, b, _, d] = SWINGING;
        assert!(!FourBar::new([a, b, ["5", "1"], d]).unwrap().never_folds());
    }

    /// Stretched to 4 beyond |AB| + |AD|, or short of it.
    #[test]
    fn a_crank_ends_where_coupler_and_rocker_are_too_short() {
        let free = FourBar::new(SWINGING).unwrap();
        let [r, _, _, g] = &free.lengths;
        assert!((r + g - Ball::integer(BITS, 4)).is_positive());
        let dead = free.dead().unwrap().expect("a dead position");
        let end = &dead - &free.drawn();
        let before = &end - &degrees(&Rational::from((1, 1000)));
        assert!(free.modes(&before).unwrap().is_some());
        let after = &end + &degrees(&Rational::from((1, 1000)));
        assert!(free.modes(&after).unwrap().is_none());
        let turns = [["0", "0"], ["0", "1"], ["2", "1"], ["2", "-1"]];
        assert!(FourBar::new(turns).unwrap().dead().unwrap().is_none());
    }

    #[test]
    fn what_balls_cannot_tell_is_undecided() {
        let flat = [["0", "0"], ["0", "1"], ["1", "1"], ["2", "1"]];
        assert!(FourBar::new(flat).is_err());
        let linkage = FourBar::new(SWINGING).unwrap();
        let end = linkage.dead().unwrap().expect("a dead position") - linkage.drawn();
        assert!(linkage.modes(&end).is_err());
        // A parallelogram: crank and frame are as long as coupler and rocker.
        let change = [["0", "0"], ["0", "1"], ["2", "1"], ["2", "0"]];
        assert!(FourBar::new(change).unwrap().dead().is_err());
    }
}
