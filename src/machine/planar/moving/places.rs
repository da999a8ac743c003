//! Points with their derivatives as formulas.

use super::equations::Writer;
use super::text::{Vector, add, mul, rational, sub, sum, zero};
use crate::reference::class_iii::ExactAngle;
use crate::reference::planar::{Form, Real};
use rug::Rational;

/// Directions and displacements at a position.
pub(super) struct Position {
    /// Cosine and sine of each body's angle.
    pub units: Vec<Vector>,
    /// Each displacement.
    pub slides: Vec<String>,
}

impl Writer<'_> {
    /// Directions and displacements where the coordinates that are left have these texts.
    pub(super) fn position(&mut self, texts: &[String]) -> Position {
        let mut units = Vec::new();
        for i in 0..self.bodies {
            let linear = &self.linear[i];
            let fixed = linear.terms.is_empty() && linear.plain.is_zero();
            units.push(match fixed {
                true => {
                    let degrees = &linear.by_pi * Rational::from(180);
                    Real::unit(&ExactAngle::Degrees(degrees)).map(|x| x.formula())
                }
                false => {
                    let at = self.by(i, texts, true);
                    let at = self.define(at);
                    self.define_pair([format!("cos({at})"), format!("sin({at})")])
                }
            });
        }
        let slides = self.bodies..self.loops.coordinates;
        let slides = slides.map(|i| self.by(i, texts, true)).collect();
        Position { units, slides }
    }

    /// `z u` of each term.
    pub(super) fn turned(
        &mut self,
        position: &Position,
        z: &[Real; 2],
        body: Option<usize>,
    ) -> Vector {
        let [a, b] = z.each_ref().map(|x| x.formula());
        match body {
            None => [a, b],
            Some(k) => {
                let [c, s] = &position.units[k];
                let x = sub(&mul(&a, c), &mul(&b, s));
                let y = add(&mul(&a, s), &mul(&b, c));
                self.define_pair([x, y])
            }
        }
    }

    pub(super) fn slide(&self, position: &Position, slide: Option<usize>) -> String {
        slide.map_or("1".into(), |i| position.slides[i - self.bodies].clone())
    }

    /// A point.
    pub(super) fn point(&mut self, position: &Position, form: &Form) -> Vector {
        let mut all = [Vec::new(), Vec::new()];
        for term in form {
            let v = self.turned(position, &term.z, term.body);
            let s = self.slide(position, term.slide);
            (0..2).for_each(|i| all[i].push(mul(&s, &v[i])));
        }
        let [x, y] = all;
        self.define_pair([sum(x), sum(y)])
    }

    /// Its derivatives by the coordinates that are left; none where it does not depend on one.
    pub(super) fn gradient(&mut self, position: &Position, form: &Form) -> Vec<Option<Vector>> {
        let mut all = vec![[Vec::new(), Vec::new()]; self.free.len()];
        for term in form {
            let v = self.turned(position, &term.z, term.body);
            let s = self.slide(position, term.slide);
            let across = [mul(&s, &sub("0", &v[1])), mul(&s, &v[0])];
            let parts = [(term.body, across), (term.slide, v)];
            for (coordinate, d) in parts {
                let Some(i) = coordinate else { continue };
                for (j, k) in self.linear[i].terms.clone() {
                    let place = self.place(j);
                    (0..2).for_each(|c| all[place][c].push(mul(&rational(&k), &d[c])));
                }
            }
        }
        let vector = |[x, y]: [Vec<String>; 2]| [sum(x), sum(y)];
        let all: Vec<Vector> = all.into_iter().map(vector).collect();
        let mut found = Vec::new();
        for v in all {
            found.push(match v.iter().all(|x| zero(x)) {
                true => None,
                false => Some(self.define_pair(v)),
            });
        }
        found
    }

    /// Its velocity.
    pub(super) fn velocity(&mut self, gradient: &[Option<Vector>], rates: &[String]) -> Vector {
        let part = |c: usize| {
            let pairs = gradient.iter().zip(rates);
            sum(pairs.filter_map(|(g, r)| Some(mul(&g.as_ref()?[c], r))))
        };
        let v = [part(0), part(1)];
        self.define_pair(v)
    }

    /// The part of its acceleration without second derivatives of coordinates.
    pub(super) fn bias(&mut self, position: &Position, form: &Form) -> Vector {
        let mut all = [Vec::new(), Vec::new()];
        for term in form {
            let Some(body) = term.body else { continue };
            let w = self.speed(body);
            if zero(&w) {
                continue;
            }
            let w = self.define(w);
            let v = self.turned(position, &term.z, Some(body));
            let s = self.slide(position, term.slide);
            let square = self.define(format!("{w}^2"));
            let across = [sub("0", &v[1]), v[0].clone()];
            let twice = match term.slide {
                Some(i) => {
                    let rate = self.speed(i);
                    mul("2", &mul(&rate, &w))
                }
                None => "0".into(),
            };
            for i in 0..2 {
                all[i].push(mul(&twice, &across[i]));
                all[i].push(sub("0", &mul(&s, &mul(&square, &v[i]))));
            }
        }
        let [x, y] = all;
        self.define_pair([sum(x), sum(y)])
    }
}
