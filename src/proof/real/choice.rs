//! Which formula the code uses where.

use super::Function;
use mechaudit_solvers::faddeeva::proof::real_line::{self as code, OfRows};

/// A formula for erf x, erfc x, erfcx x, or `(2/√π) F(x)`, F Dawson's function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inner {
    /// Taylor series.
    Row {
        /// About this centre, which of erfcx has the sign of x.
        centre: f64,
    },
    /// Asymptotic series.
    Series {
        /// Terms.
        terms: u32,
    },
}

/// A formula of a function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Formula {
    /// Maclaurin series of Dawson's function.
    Near,
    /// The function.
    Value(Inner),
    /// `e^{−x²}` erfcx x.
    Product(Inner),
    /// 2 less erfc.
    Difference(Inner),
    /// `2e^{x²}`.
    Exponential,
    /// The first term of the asymptotic series.
    Far,
    /// 0, 1 or 2.
    Constant,
    /// Infinity, where the value is above the range.
    Overflow,
}

impl Formula {
    /// Its name in tables, without the centre.
    pub fn name(self, function: Function, negative: bool) -> &'static str {
        use Function::{Dawson, Erf};
        use Inner::{Row, Series};
        match self {
            Formula::Near => "Maclaurin series",
            Formula::Value(Row { .. }) => "Taylor series",
            Formula::Value(Series { terms: 26 }) => "asymptotic, 26 terms",
            Formula::Value(Series { terms: 14 }) => "asymptotic, 14 terms",
            Formula::Value(Series { terms: 6 }) => "asymptotic, 6 terms",
            Formula::Value(Series { .. }) => "asymptotic, 2 terms",
            Formula::Product(_) => "exp(-x^2) erfcx x, asymptotic",
            Formula::Difference(_) => "2 - erfc |x|",
            Formula::Exponential => "2 exp(x^2)",
            Formula::Far if function == Dawson => "1/(2x)",
            Formula::Far => "1/(sqrt(pi) x), scaled",
            Formula::Constant => match (function, negative) {
                (Erf, _) => "1",
                (_, false) => "0",
                (_, true) => "2",
            },
            Formula::Overflow => "infinity",
        }
    }

    /// The centre of its row.
    pub fn centre(self) -> Option<f64> {
        match self {
            Formula::Value(Inner::Row { centre })
            | Formula::Product(Inner::Row { centre })
            | Formula::Difference(Inner::Row { centre }) => Some(centre),
            _ => None,
        }
    }
}

/// The series where it has terms, else the row.
fn inner(of: OfRows, x: f64, terms: Option<u32>) -> Inner {
    match terms {
        Some(terms) => Inner::Series { terms },
        None => Inner::Row {
            centre: x - code::row(of, x).1,
        },
    }
}

fn of_erfcx(x: f64) -> Inner {
    Inner::Series {
        terms: code::erfcx_terms(x),
    }
}

/// The formula of the solver at x or −x, `x ≥ 0`. Its choices are comparisons of x with constants,
/// and of numbers that never fall when x grows.
pub fn choice(function: Function, negative: bool, x: f64) -> Formula {
    let [series, one, beyond, far] = code::LIMITS;
    match function {
        Function::Erf if x < one => Formula::Value(inner(OfRows::Erf, x, None)),
        Function::Erf => Formula::Constant,
        Function::Erfc if x < beyond => {
            let centre = code::erfc_row(x).1;
            match negative {
                true => Formula::Difference(Inner::Row { centre }),
                false => Formula::Value(Inner::Row { centre }),
            }
        }
        Function::Erfc if negative || x >= far => Formula::Constant,
        Function::Erfc => Formula::Product(of_erfcx(x)),
        Function::Erfcx if x < beyond => {
            let (_, centre) = code::erfc_row(x);
            let centre = if negative { -centre } else { centre };
            Formula::Value(Inner::Row { centre })
        }
        Function::Erfcx if code::is_huge(x) && !negative => Formula::Far,
        Function::Erfcx if !negative => Formula::Value(of_erfcx(x)),
        Function::Erfcx if x > far => Formula::Overflow,
        Function::Erfcx => Formula::Exponential,
        Function::Dawson if x < series => Formula::Near,
        Function::Dawson if code::is_huge(x) => Formula::Far,
        Function::Dawson => Formula::Value(inner(OfRows::Dawson, x, code::dawson_terms(x))),
    }
}
