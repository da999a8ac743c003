//! The mechanism as the library specifies it, reduced to one crank angle in exact numbers.
//!
//! φ is the angle of the cranks from upright, clockwise; B0 is at `(sin φ, cos φ)`. On the
//! parallelogram branch cranks turn alike and rods do not turn, so `I = (N + 1) m l²/3 + N m l²`
//! and `V = ((N + 1)/2 + N) m g l cos φ` (ledger, nb-inertia, nb-potential).

use crate::reference::pendulum::Turning;
use crate::reference::{Ball, Undecided};
use rug::Rational;

/// Numbers of windows that are looked at; the specification is for the last.
pub const SIZES: [u32; 4] = [1, 2, 10, 40];

/// 9.81 N/kg. Bars have 1 m and 1 kg, B0 starts with 1 m/s.
pub fn gravity() -> Rational {
    Rational::from((981, 100))
}

/// The moment of inertia of all cranks and rods for the crank angle, in kg m².
pub fn inertia(n: u32) -> Rational {
    Rational::from((4 * n + 1, 3))
}

/// V at φ = 0 less V at φ = 90°, in units of m g l.
pub fn weight(n: u32) -> Rational {
    Rational::from((3 * n + 1, 2))
}

/// φ'² at the top and at the bottom: `φ'² = 1 + 2 (V(0) − V(φ))/I`.
pub fn squares(n: u32) -> [Rational; 2] {
    let fall = weight(n) * gravity() * 4 / inertia(n);
    [Rational::from(1), fall + 1]
}

/// φ'' over −g/l at the first horizontal position, `weight/inertia`, with the sign of the crank's
/// angle from x.
pub fn fall(n: u32) -> Rational {
    weight(n) / inertia(n)
}

/// The motion, which turns over for every N.
///
/// # Errors
/// [`Undecided`] if the precision is too low.
pub fn pendulum(n: u32, bits: u32) -> Result<Turning, Undecided> {
    let [top, bottom] = squares(n);
    Turning::new(&top, &bottom, bits)?.ok_or_else(|| Undecided {
        bits,
        reason: "the cranks do not turn over".into(),
    })
}

/// Position and velocity of B0.
pub struct State {
    /// φ, over all turns.
    pub angle: Ball,
    /// x, y in m, then their rates in m/s.
    pub values: [Ball; 4],
}

/// The state at a time.
///
/// # Errors
/// [`Undecided`] if the precision is too low.
pub fn state(motion: &Turning, time: &Rational) -> Result<State, Undecided> {
    let angle = motion.angle(time)?;
    let speed = motion.speed(&angle);
    let (s, c) = angle.sin_cos();
    let values = [s.clone(), c.clone(), &speed * &c, -(&speed * &s)];
    Ok(State { angle, values })
}
