//! The commands: a file or folder each.

pub mod audit;
pub mod campaign;
pub mod chirp;
pub mod compare;
pub mod converge;
pub mod describe;
pub mod eval;
pub mod hunt;
pub mod identity;
pub mod judge;
pub mod linkage;
pub mod motion;
pub mod paper;
pub mod points;
pub mod prove;
pub mod regenerate;
pub mod runup;
pub mod shell;
