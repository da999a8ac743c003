//! Describes what a certificate proves, in a few numbers.

use crate::bound::Bound;
use crate::cover::Rectangle;
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
    /// Holds what underflows, in units of 2⁻¹⁰⁷⁵.
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
    /// Returns what is proved; `None` for no rectangle at all.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Formula;

    /// The worst of each formula with its rectangle, and of all; no component where one has no
    /// bound.
    #[test]
    fn every_formula_has_a_line() {
        let leaf = |x: f64, formula: Formula, [norm, re, im, tiny]: [f64; 4]| Leaf {
            at: Rectangle {
                a: [x; 2],
                b: [1.0; 2],
            },
            formula,
            bound: Bound { norm, re, im, tiny },
        };
        let nine = Formula::Maclaurin { terms: 9 };
        let leaves = vec![
            leaf(1.0, nine, [1.0, 1.5, 1.25, 0.0]),
            leaf(2.0, Formula::Huge, [2.0, 0.5, 1.75, 3.0]),
            leaf(3.0, nine, [3.0, 1.25, 1.125, 1.0]),
        ];
        let of = |leaves: Vec<Leaf>| {
            let open = Vec::new();
            Certificate { leaves, open }.summary().expect("a leaf")
        };
        let found = of(leaves.clone());
        let rows: Vec<_> = found
            .formulas
            .iter()
            .map(|f| (f.name, f.boxes, f.norm.bound, f.tiny))
            .collect();
        let due = [
            (nine.name(), 2, 3.0, 1.0),
            (Formula::Huge.name(), 1, 2.0, 3.0),
        ];
        assert_eq!(rows, due);
        assert_eq!(
            (found.norm.bound, found.norm.at.a, found.tiny, found.boxes),
            (3.0, [3.0; 2], 3.0, 3)
        );
        let component = found.component.expect("both parts of each");
        assert_eq!((component.bound, component.at.a), (1.75, [2.0; 2]));
        let re = found.formulas[0].re.expect("a bound");
        assert_eq!((re.bound, re.at.a), (1.5, [1.0; 2]));
        let mut without = leaves;
        without[2].bound.im = f64::INFINITY;
        let found = of(without);
        assert!(found.component.is_none() && found.formulas[0].im.is_none());
        assert!(found.formulas[1].im.is_some());
        assert!(Certificate::default().summary().is_none());
    }
}
