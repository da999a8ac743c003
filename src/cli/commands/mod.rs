//! What the program does: one file, or one folder, for each command.

pub mod audit;
pub mod chirp;
pub mod converge;
pub mod eval;
pub mod hunt;
pub mod judge;
pub mod linkage;
pub mod list;
pub mod paper;
pub mod points;
pub mod prove;
pub mod regenerate;
pub mod runup;
pub mod shell;
