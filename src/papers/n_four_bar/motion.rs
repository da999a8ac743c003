//! Everything that findings and entries compare with, enclosed once.

use super::data::{SIZES, State, pendulum, state};
use super::printed::{Copied, Row, exudyn, library};
use crate::reference::pendulum::Turning;
use crate::reference::{Ball, Undecided};
use rug::Rational;

/// Working precision in bits.
pub const BITS: u32 = 160;
/// Certified digits that are given.
pub const DIGITS: usize = 30;
/// Times at which all sizes are given, in s.
pub const TIMES: [u32; 2] = [10, 20];
/// Names of a state's values, with units.
pub const QUANTITIES: [(&str, &str); 4] = [("x", "m"), ("y", "m"), ("vx", "m/s"), ("vy", "m/s")];

/// One size.
pub struct Course {
    /// N.
    pub n: u32,
    /// The motion.
    pub turning: Turning,
    /// Period in s.
    pub period: Ball,
    /// States at [`TIMES`].
    pub states: Vec<State>,
}

/// Printed numbers with what is due there.
pub struct Motion {
    /// By [`SIZES`].
    pub courses: Vec<Course>,
    /// The library's rows and the states for N = 40.
    pub library: Vec<(Row, State)>,
    /// States for N = 2 at the library's times.
    pub two: Vec<State>,
    /// EXUDYN's numbers, with the value where one is due: a run's drift has none.
    pub exudyn: Vec<(Copied, Option<Ball>)>,
}

impl Motion {
    /// The course of a size.
    ///
    /// # Panics
    /// If it is none of [`SIZES`].
    pub fn of(&self, n: u32) -> &Course {
        let found = self.courses.iter().find(|c| c.n == n);
        found.expect("one of the sizes")
    }
}

/// A quantity of [`Copied`] in a state: of the end B0, or of the bar's centre C0 halfway to it.
fn quantity(name: &str, state: &State) -> Option<Ball> {
    let (point, part) = name.split_once('_')?;
    let k = QUANTITIES.iter().position(|(q, _)| *q == part)?;
    let value = &state.values[k];
    Some(match point {
        "C0" => value.shift(-1),
        _ => value.clone(),
    })
}

/// Encloses the motion for all sizes, and at every printed time.
///
/// # Errors
/// [`Undecided`] if the precision is too low.
pub fn motion(bits: u32) -> Result<Motion, Undecided> {
    let course = |n: u32| {
        let turning = pendulum(n, bits)?;
        let at = |t: &u32| state(&turning, &Rational::from(*t));
        Ok(Course {
            n,
            period: turning.period()?,
            states: TIMES.iter().map(at).collect::<Result<_, _>>()?,
            turning,
        })
    };
    let courses = SIZES
        .into_iter()
        .map(course)
        .collect::<Result<Vec<_>, Undecided>>()?;
    let (two, forty) = (pendulum(2, bits)?, pendulum(40, bits)?);
    let mut rows = Vec::new();
    let mut small = Vec::new();
    for row in library() {
        small.push(state(&two, &row.time)?);
        let due = state(&forty, &row.time)?;
        rows.push((row, due));
    }
    let mut copies = Vec::new();
    for copied in exudyn() {
        let due = quantity(&copied.quantity, &state(&two, &copied.time)?);
        copies.push((copied, due));
    }
    Ok(Motion {
        courses,
        library: rows,
        two: small,
        exudyn: copies,
    })
}
