//! What a certificate proves, in a few numbers.

use crate::cover::Rectangle;
use crate::formula::Bound;
use crate::prove::{Certificate, Leaf};

/// A bound and the rectangle where it is attained.
#[derive(Clone, Copy, Debug)]
pub struct Attained {
    /// The bound.
    pub bound: f64,
    /// Where.
    pub at: Rectangle,
}

/// The worst of one formula, or of all.
#[derive(Clone, Copy, Debug)]
pub struct OfFormula {
    /// Its name.
    pub name: &'static str,
    /// Rectangles.
    pub boxes: usize,
    /// Of the norm, in units of 2⁻⁵².
    pub norm: Attained,
    /// Of the real part, in units in its last place; `None` where a rectangle has no bound.
    pub re: Option<Attained>,
    /// Of the imaginary part.
    pub im: Option<Attained>,
    /// Of either part, besides, in units of 2⁻¹⁰⁷⁵, where it may be below 2⁻⁹⁶⁰.
    pub tiny: f64,
}

/// The theorem.
#[derive(Clone, Debug)]
pub struct Summary {
    /// K, over all formulas.
    pub norm: Attained,
    /// C, over all formulas; `None` unless each has a bound of both parts.
    pub component: Option<Attained>,
    /// What underflows, in units of 2⁻¹⁰⁷⁵.
    pub tiny: f64,
    /// Rectangles.
    pub boxes: usize,
    /// Each formula.
    pub formulas: Vec<OfFormula>,
}

fn worst(leaves: &[&Leaf], of: impl Fn(&Bound) -> f64) -> Option<Attained> {
    let attained = |l: &&Leaf| Attained {
        bound: of(&l.bound),
        at: l.at,
    };
    let all = leaves.iter().map(attained);
    all.max_by(|a, b| a.bound.total_cmp(&b.bound))
}

fn of_formula(name: &'static str, leaves: &[&Leaf]) -> Option<OfFormula> {
    let finite = |a: Attained| a.bound.is_finite().then_some(a);
    Some(OfFormula {
        name,
        boxes: leaves.len(),
        norm: worst(leaves, |b| b.norm)?,
        re: worst(leaves, |b| b.re).and_then(finite),
        im: worst(leaves, |b| b.im).and_then(finite),
        tiny: worst(leaves, |b| b.tiny)?.bound,
    })
}

impl Certificate {
    /// What is proved; `None` for no rectangle at all.
    pub fn summary(&self) -> Option<Summary> {
        let all: Vec<&Leaf> = self.leaves.iter().collect();
        let mut names: Vec<&'static str> = Vec::new();
        for leaf in &all {
            let name = leaf.formula.name();
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let formulas = names.into_iter().filter_map(|name| {
            let some: Vec<&Leaf> = all
                .iter()
                .copied()
                .filter(|l| l.formula.name() == name)
                .collect();
            of_formula(name, &some)
        });
        let formulas: Vec<OfFormula> = formulas.collect();
        let parts: Option<Vec<[Attained; 2]>> =
            formulas.iter().map(|f| Some([f.re?, f.im?])).collect();
        let parts = parts.into_iter().flatten().flatten();
        let component = parts.max_by(|a, b| a.bound.total_cmp(&b.bound));
        Some(Summary {
            norm: worst(&all, |b| b.norm)?,
            component,
            tiny: worst(&all, |b| b.tiny)?.bound,
            boxes: all.len(),
            formulas,
        })
    }
}
