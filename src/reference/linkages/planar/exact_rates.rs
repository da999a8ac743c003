//! Derivatives at positions all of whose coordinates are exact, without rounding.
//!
//! The loops are `Σ z s u = 0` with numbers z, displacements s and directions u of a field. With
//! `u' = i ψ' u` their first derivatives are linear in the rates, and so are the second ones but
//! for `Σ z (2 i s' ψ' − s ψ'²) u`. Gauss's elimination in the field solves both, or finds the
//! position singular.

use super::enclosure::Linkage;
use super::loops::Form;
use super::parts::Attachment;
use super::special::Special;
use super::surd::{Field, Surd, Vector};
use crate::Ball;
use rug::Rational;

/// First and second derivatives of all coordinates by the drive.
#[derive(Clone, Debug)]
pub struct ExactRates {
    field: Field,
    first: Vec<Surd>,
    second: Vec<Surd>,
}

/// `i v`.
fn upright([x, y]: &Vector) -> Vector {
    [y.negated(), x.clone()]
}

fn scaled(field: &Field, v: &Vector, by: &Surd) -> Vector {
    v.each_ref().map(|x| field.times(x, by))
}

fn sum(a: &Vector, b: &Vector) -> Vector {
    [a[0].plus(&b[0]), a[1].plus(&b[1])]
}

impl ExactRates {
    /// Derivatives at a position whose coordinates are all exact; none where one is not, or the
    /// position is singular.
    pub fn new(linkage: &Linkage, at: &Special) -> Option<ExactRates> {
        if at.turns() {
            return None;
        }
        let loops = &linkage.mechanism.loops;
        let n = loops.coordinates;
        let field = at.field().clone();
        let zero = || vec![Surd::default(); n];
        let mut rows: Vec<Vec<Surd>> = Vec::new();
        for form in &loops.closures {
            let mut both = [zero(), zero()];
            for (k, v) in gradient(form, at)? {
                for (row, v) in both.iter_mut().zip(v) {
                    row[k] = row[k].plus(&v);
                }
            }
            rows.extend(both);
        }
        let relations = loops.relations.iter().map(|r| &r.terms);
        for terms in relations.chain([&linkage.drive.0]) {
            let mut row = zero();
            terms.iter().for_each(|(k, a)| row[*k].a += a);
            rows.push(row);
        }
        let mut right = zero();
        right[n - 1] = Surd::from(Rational::from(1));
        let first = solved(&field, rows.clone(), right)?;
        let mut right = Vec::new();
        for form in &loops.closures {
            let bend = bend(form, at, &first)?;
            right.extend(bend.map(|x| x.negated()));
        }
        right.resize(n, Surd::default());
        let second = solved(&field, rows, right)?;
        Some(ExactRates {
            field,
            first,
            second,
        })
    }

    /// First and second derivative of a coordinate.
    pub fn of(&self, coordinate: usize, bits: u32) -> [Ball; 2] {
        [&self.first, &self.second].map(|x| self.field.to_ball(&x[coordinate], bits))
    }

    /// First and second derivative of a point.
    pub fn point(
        &self,
        linkage: &Linkage,
        at: &Special,
        point: &Attachment,
    ) -> Option<[[Ball; 2]; 2]> {
        let form = linkage.mechanism.loops.point(point);
        let gradient = gradient(&form, at)?;
        let along = |rates: &[Surd]| {
            let terms = gradient
                .iter()
                .map(|(k, v)| scaled(&self.field, v, &rates[*k]));
            terms.fold(Vector::default(), |s, t| sum(&s, &t))
        };
        let second = sum(&along(&self.second), &bend(&form, at, &self.first)?);
        let bits = linkage.bits();
        Some([along(&self.first), second].map(|v| v.map(|x| self.field.to_ball(&x, bits))))
    }
}

/// `(∂/∂x_k, k)` of a form, several times for one k if several terms have it.
fn gradient(form: &Form, at: &Special) -> Option<Vec<(usize, Vector)>> {
    let mut all = Vec::new();
    for t in form {
        let (v, s) = at.term(t)?;
        if let (Some(j), Some(_)) = (t.slide, &s) {
            all.push((j, v.clone()));
        }
        if let Some(k) = t.body {
            let whole = s.map_or_else(|| v.clone(), |s| scaled(at.field(), &v, &s));
            all.push((k, upright(&whole)));
        }
    }
    Some(all)
}

/// `Σ z (2 i s' ψ' − s ψ'²) u`.
fn bend(form: &Form, at: &Special, rates: &[Surd]) -> Option<Vector> {
    let field = at.field();
    let mut all = Vector::default();
    for t in form {
        let (v, s) = at.term(t)?;
        let Some(k) = t.body else { continue };
        let square = field.times(&rates[k], &rates[k]).negated();
        let whole = s.map_or_else(|| v.clone(), |s| scaled(field, &v, &s));
        all = sum(&all, &scaled(field, &whole, &square));
        if let Some(j) = t.slide {
            let both = field.times(&rates[j], &rates[k]);
            let twice = both.plus(&both);
            all = sum(&all, &scaled(field, &upright(&v), &twice));
        }
    }
    Some(all)
}

/// The solution of a square system; none if it is singular.
fn solved(field: &Field, mut rows: Vec<Vec<Surd>>, mut right: Vec<Surd>) -> Option<Vec<Surd>> {
    let n = right.len();
    for k in 0..n {
        let pivot = (k..n).find(|&i| !rows[i][k].is_zero())?;
        rows.swap(k, pivot);
        right.swap(k, pivot);
        for i in (0..n).filter(|&i| i != k) {
            if rows[i][k].is_zero() {
                continue;
            }
            let factor = field.over(&rows[i][k], &rows[k][k]);
            for j in k..n {
                let part = field.times(&factor, &rows[k][j]);
                rows[i][j] = rows[i][j].minus(&part);
            }
            let part = field.times(&factor, &right[k]);
            right[i] = right[i].minus(&part);
        }
    }
    Some((0..n).map(|k| field.over(&right[k], &rows[k][k])).collect())
}
