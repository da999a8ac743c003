//! Describes what a certificate proves, in a few numbers.

use super::prove::{Certificate, Leaf};
use super::{Function, Interval};

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

impl OfFormula {
    fn of(name: &'static str, leaf: &Leaf) -> OfFormula {
        OfFormula {
            name,
            intervals: 0,
            ends: leaf.at.signed(),
            ulps: leaf.ulps,
            at: leaf.at,
        }
    }

    fn with(&mut self, leaf: &Leaf) {
        let [lo, hi] = leaf.at.signed();
        self.intervals += 1;
        self.ends = [self.ends[0].min(lo), self.ends[1].max(hi)];
        if leaf.ulps > self.ulps {
            (self.ulps, self.at) = (leaf.ulps, leaf.at);
        }
    }
}

impl Certificate {
    /// Returns what is proved; `None` for no interval at all.
    pub fn summary(&self, function: Function) -> Option<Summary> {
        let mut formulas: Vec<OfFormula> = Vec::new();
        for leaf in &self.leaves {
            let name = leaf.formula.name(function, leaf.at.negative);
            // erfc −x begins with the same formula as erfc x.
            let same = |f: &OfFormula| f.name == name && f.at.negative == leaf.at.negative;
            match formulas.iter_mut().find(|f| same(f)) {
                Some(f) => f.with(leaf),
                None => {
                    let mut f = OfFormula::of(name, leaf);
                    f.with(leaf);
                    formulas.push(f);
                }
            }
        }
        formulas.sort_by(|a, b| a.ends[0].total_cmp(&b.ends[0]));
        let worst = formulas.iter().max_by(|a, b| a.ulps.total_cmp(&b.ulps))?;
        Some(Summary {
            ulps: worst.ulps,
            at: worst.at,
            intervals: self.leaves.len(),
            formulas,
        })
    }
}
