//! Gembara and Senyk, *Dynamics of oscillating-follower cam mechanisms in a non-stationary regime*:
//! the driven link of a cam mechanism as one mass on a spring while the shaft speeds up or runs
//! down, solved with the probability integral of complex argument.
//!
//! The ledger decides every formula and the findings tell what follows from the wrong ones;
//! [`charts`] has what follows from the model. The paper's graphs cannot be recomputed: it gives
//! neither cams nor oscillator.

pub mod charts;
mod findings;

pub(super) use findings::analysis;
