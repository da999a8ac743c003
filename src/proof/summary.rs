//! Describes what a certificate proves, in a few numbers.

use crate::bound::Bound;
use crate::cover::Rectangle;
use crate::interval::larger;
use crate::prove::{Certificate, Leaf};

/// A bound and the part where it is attained.
#[derive(Clone, Copy, Debug)]
pub struct Attained<P = Rectangle> {
    /// The bound.
    pub bound: f64,
    /// Where.
    pub at: P,
}

/// The largest bound of some leaves, each with its part; what is not a number is infinite.
pub(crate) fn attained<L, P>(leaves: &[&L], of: impl Fn(&L) -> (f64, P)) -> Option<Attained<P>> {
    let all = leaves.iter().map(|l| of(l));
    let all = all.map(|(bound, at)| Attained {
        bound: larger(bound, 0.0),
        at,
    });
    all.max_by(|a, b| a.bound.total_cmp(&b.bound))
}

/// Leaves of one kind each, in the order in which the kinds come first.
pub(crate) fn grouped<'a, L, K: PartialEq>(
    leaves: impl IntoIterator<Item = &'a L>,
    kind: impl Fn(&L) -> K,
) -> Vec<(K, Vec<&'a L>)> {
    let mut all: Vec<(K, Vec<&L>)> = Vec::new();
    for leaf in leaves {
        let kind = kind(leaf);
        match all.iter_mut().find(|(k, _)| *k == kind) {
            Some((_, some)) => some.push(leaf),
            None => all.push((kind, vec![leaf])),
        }
    }
    all
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
    /// Added for either part, in units of 2⁻¹⁰⁷⁵, where it may be below 2⁻⁹⁶⁰.
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
    attained(leaves, |l| (of(&l.bound), l.at))
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
        let each = grouped(&self.leaves, |l| l.formula.name()).into_iter();
        let formulas = each.filter_map(|(name, leaves)| of_formula(name, &leaves));
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
        // NaN is no bound, whatever its sign.
        for norm in [f64::NAN, -f64::NAN] {
            let mut without = leaves.clone();
            without[0].bound.norm = norm;
            assert_eq!(of(without).norm.bound, f64::INFINITY);
        }
        let mut without = leaves;
        without[2].bound.im = f64::INFINITY;
        let found = of(without);
        assert!(found.component.is_none() && found.formulas[0].im.is_none());
        assert!(found.formulas[1].im.is_some());
        assert!(Certificate::default().summary().is_none());
    }
}
