//! Describes what a certificate proves, in a few numbers.

use super::prove::{Certificate, Leaf};
use super::{Function, Interval};
use crate::summary::{attained, grouped};

/// The worst of one formula.
#[derive(Clone, Copy, Debug)]
pub struct OfFormula {
    /// Its name.
    pub name: &'static str,
    /// Intervals.
    pub intervals: usize,
    /// The ends of x over all of them.
    pub ends: [f64; 2],
    /// In units in the last place of the value.
    pub ulps: f64,
    /// Where.
    pub at: Interval,
}

/// The theorem.
#[derive(Clone, Debug)]
pub struct Summary {
    /// C, over all formulas, and where it is attained.
    pub ulps: f64,
    /// Where.
    pub at: Interval,
    /// Intervals.
    pub intervals: usize,
    /// Each formula, in the order of x.
    pub formulas: Vec<OfFormula>,
}

impl Certificate {
    /// Returns what is proved; `None` for no interval at all.
    pub fn summary(&self, function: Function) -> Option<Summary> {
        // erfc −x begins with the same formula as erfc x.
        let kind = |l: &Leaf| {
            let negative = l.at.negative;
            (l.formula.name(function, negative), negative)
        };
        let of_formula = |((name, _), leaves): ((_, _), Vec<&Leaf>)| {
            let worst = attained(&leaves, |l| (l.ulps, l.at))?;
            let ends = leaves.iter().map(|l| l.at.signed());
            Some(OfFormula {
                name,
                intervals: leaves.len(),
                ends: ends.reduce(|p, q| [p[0].min(q[0]), p[1].max(q[1])])?,
                ulps: worst.bound,
                at: worst.at,
            })
        };
        let each = grouped(&self.leaves, kind).into_iter();
        let mut formulas: Vec<OfFormula> = each.filter_map(of_formula).collect();
        formulas.sort_by(|a, b| a.ends[0].total_cmp(&b.ends[0]));
        let all: Vec<&OfFormula> = formulas.iter().collect();
        let worst = attained(&all, |f| (f.ulps, f.at))?;
        Some(Summary {
            ulps: worst.bound,
            at: worst.at,
            intervals: self.leaves.len(),
            formulas,
        })
    }
}
