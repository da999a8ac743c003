//! The Faddeeva function and its relatives, line shapes made of it.

pub mod faddeeva;
pub mod hartmann_tran;
