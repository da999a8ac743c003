//! The Faddeeva function and its relatives.

pub mod faddeeva;
