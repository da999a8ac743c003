//! Zinchenko (2008): dynamics of the screening mechanism for moulding sand.

pub mod formulas;
