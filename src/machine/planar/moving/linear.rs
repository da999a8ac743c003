//! Coordinates that follow from others: slides hold angles, gears and racks tie coordinates.

use crate::reference::class_iii::ExactAngle;
use crate::reference::planar::Relation;
use rug::Rational;

/// `Σ k x + plain + by_pi π` in the coordinates that are left.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Linear {
    pub terms: Vec<(usize, Rational)>,
    pub plain: Rational,
    pub by_pi: Rational,
}

impl Linear {
    fn coordinate(index: usize) -> Linear {
        Linear {
            terms: vec![(index, Rational::from(1))],
            ..Linear::default()
        }
    }

    /// The factor of a coordinate, if it is not zero.
    pub fn factor(&self, index: usize) -> Option<&Rational> {
        self.terms.iter().find(|t| t.0 == index).map(|t| &t.1)
    }

    fn add(&mut self, factor: &Rational, other: &Linear) {
        for (i, k) in &other.terms {
            let by = Rational::from(factor * k);
            match self.terms.iter_mut().find(|t| t.0 == *i) {
                Some(same) => same.1 += by,
                None => self.terms.push((*i, by)),
            }
        }
        self.terms.retain(|t| !t.1.is_zero());
        self.plain += Rational::from(factor * &other.plain);
        self.by_pi += Rational::from(factor * &other.by_pi);
    }

    fn constant(angle: &ExactAngle) -> Linear {
        let mut of = Linear::default();
        match angle {
            ExactAngle::Radians(q) => of.plain = q.clone(),
            ExactAngle::Degrees(q) => of.by_pi = Rational::from(q / 180u32),
        }
        of
    }
}

/// All coordinates by those that are left after the relations, which are chosen among those that
/// `keep` does not name as far as that is possible. `None` for relations that contradict or repeat
/// one another.
pub(super) fn reduced(
    coordinates: usize,
    relations: &[Relation],
    keep: &[usize],
) -> Option<Vec<Linear>> {
    let mut all: Vec<Linear> = (0..coordinates).map(Linear::coordinate).collect();
    for relation in relations {
        // Σ k x − constant = 0 by those that are left.
        let mut zero = Linear::default();
        for (i, k) in &relation.terms {
            zero.add(k, &all[*i].clone());
        }
        zero.add(&Rational::from(-1), &Linear::constant(&relation.constant));
        let free = zero.terms.iter().map(|t| t.0);
        let gone = free.max_by_key(|i| (!keep.contains(i), *i))?;
        let factor = -zero.factor(gone)?.clone().recip();
        let mut by_others = Linear::default();
        by_others.add(&factor, &zero);
        by_others.terms.retain(|t| t.0 != gone);
        for linear in &mut all {
            if let Some(k) = linear.factor(gone).cloned() {
                linear.terms.retain(|t| t.0 != gone);
                linear.add(&k, &by_others);
            }
        }
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn relation(terms: &[(usize, i32)], degrees: i32) -> Relation {
        Relation {
            terms: terms
                .iter()
                .map(|(i, k)| (*i, Rational::from(*k)))
                .collect(),
            constant: ExactAngle::Degrees(Rational::from(degrees)),
        }
    }

    /// x2 = x1 + 90°, x3 = −2 x2 + 10°: x3 = −2 x1 − 170°.
    #[test]
    fn coordinates_follow_one_another() {
        let relations = [
            relation(&[(2, 1), (1, -1)], 90),
            relation(&[(3, 1), (2, 2)], 10),
        ];
        let all = reduced(4, &relations, &[1]).unwrap();
        assert_eq!(all[0], Linear::coordinate(0));
        assert_eq!(all[1], Linear::coordinate(1));
        assert_eq!(all[3].terms, vec![(1, Rational::from(-2))]);
        assert_eq!(all[3].by_pi, Rational::from((-17, 18)));
        // The other way round, x1 and x2 by x3.
        let all = reduced(4, &relations, &[3]).unwrap();
        assert_eq!(all[1].terms, vec![(3, Rational::from((-1, 2)))]);
        assert_eq!(all[1].by_pi, Rational::from((-17, 36)));
        assert_eq!(all[2].by_pi, Rational::from((1, 36)));
    }

    #[test]
    fn relations_that_repeat_one_another_are_none() {
        let one = relation(&[(0, 1), (1, -1)], 0);
        assert_eq!(reduced(2, &[one.clone(), one], &[]), None);
    }
}
