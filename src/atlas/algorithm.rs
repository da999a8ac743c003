//! The description of an algorithm.

use num_complex::{Complex32, Complex64};

/// Where an algorithm is defined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// `Im z ≥ 0`.
    Upper,
    /// Everywhere.
    Whole,
}

/// Describes what an algorithm gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parts {
    /// w.
    Both,
    /// Re w alone, the Voigt function; the imaginary part of [`Algorithm::w`] is NaN.
    Real,
}

/// A published algorithm.
#[derive(Clone, Copy, Debug)]
pub struct Algorithm {
    /// Authors, year, variant: lower case, joined by hyphens.
    pub name: &'static str,
    /// In a few words.
    pub title: &'static str,
    /// The paper.
    pub source: &'static str,
    /// Where its formulas and constants were read.
    pub read_from: &'static str,
    /// Where it is defined.
    pub plane: Plane,
    /// Holds what it gives.
    pub parts: Parts,
    /// The algorithm.
    pub w: fn(Complex64) -> Complex64,
    /// The same operations in single precision, where it is made of arithmetic and exponentials
    /// alone.
    pub single: Option<fn(Complex32) -> Complex32>,
    /// The number of the formula that is used at an argument, where there are several.
    pub formula: Option<fn(Complex64) -> u8>,
}

/// States what most have in common, to be completed: both parts in the upper half-plane, by one
/// formula and in double precision alone.
pub(crate) const UPPER: Algorithm = Algorithm {
    name: "",
    title: "",
    source: "",
    read_from: "",
    plane: Plane::Upper,
    parts: Parts::Both,
    w: |z| z,
    single: None,
    formula: None,
};
/// The same in the whole plane.
pub(crate) const WHOLE: Algorithm = Algorithm {
    plane: Plane::Whole,
    ..UPPER
};

/// A published algorithm that could not be written here.
#[derive(Clone, Copy, Debug)]
pub struct NotAtHand {
    /// Authors and year.
    pub name: &'static str,
    /// The paper.
    pub source: &'static str,
    /// Why it is missing.
    pub why: &'static str,
}
