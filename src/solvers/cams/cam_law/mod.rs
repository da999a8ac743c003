//! Laws of motion of cam followers, and cycles made of them.
//!
//! A law leads from `s(0) = 0` to `s(1) = 1` as the stroke `x` runs from 0 to 1; velocity,
//! acceleration and jerk are its derivatives in `x`. With a lift `h`, a stroke of `β` radians and a
//! shaft at `Ω` they are to be multiplied by `h (Ω/β)^k`. See [`MotionLaw`] for the laws and
//! [`CamCycle`] for rise, dwell, return, dwell.
//!
//! | law | `b, c, d` | `C_v` | `C_a` | `C_j` |
//! |---|---|---|---|---|
//! | constant acceleration ("0050") | 0, 1, 0 | 2 | 4 | ∞ |
//! | simple harmonic ("К") | 0, 0, 1 | π/2 | π²/2 | ∞ |
//! | modified trapezoid | ¼, ½, ¼ | 2 | 4.8881 | 61.43 |
//! | modified sine | ¼, 0, ¾ | 1.7596 | 5.5280 | 69.47 |
//! | cycloidal | ½, 0, ½ | 2 | 2π | 4π² |
//! | polynomial 3-4-5 | | 15/8 | 10/√3 | 60 |
//! | polynomial 4-5-6-7 | | 35/16 | 7.5132 | 52.5 |
//!
//! Gembara & Senyk use two more laws, "C0" and "0000". Nothing in their paper defines them, nor the
//! digits in the names; they are not here.
//!
//! # Accuracy
//! Near both ends the distance from the end keeps its relative accuracy, `s` by
//! [`MotionLaw::motion`], `1 − s` by [`MotionLaw::remaining`]. Worst found over 3000 random cases
//! in each of six regions, the reference's radius included: `16 · 2⁻⁵³ (|f| + |x f'|)` for the
//! displacement, where an asymmetric law has just begun to decelerate, 3.8 for the others;
//! `mechaudit audit cam-law` repeats the search.
//!
//! # Sources
//! SCCA family: R. L. Norton, *Cam Design and Manufacturing Handbook*, ch. 3; the names "К" and
//! "0050": В. М. Гембара, Д. М. Сеник, *Динаміка коромислових кулачкових механізмів при
//! нестаціонарному режимі*.

mod cycle;
mod error;
mod law;
mod motion;
mod polynomial;
mod scca;
mod symmetric_polynomial;
mod tabulated;

pub use cycle::{CamCycle, Phase, Stroke};
pub use error::CamLawError;
pub use law::MotionLaw;
pub(crate) use law::Shape;
pub use motion::{Motion, NAMES, Peaks};
pub(crate) use scca::Scca;

#[cfg(test)]
pub(crate) mod tests;
