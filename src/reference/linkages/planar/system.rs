//! Loop equations at a working precision: residuals, the Jacobian, points.

use super::loops::{Form, Relation};
use super::mechanism::Mechanism;
use super::parts::Drive;
use super::scalar::Scalar;
use crate::Ball;

/// `z s u` with z in balls.
#[derive(Clone, Debug)]
pub(super) struct BallTerm {
    pub re: Ball,
    pub im: Ball,
    pub slide: Option<usize>,
    pub body: Option<usize>,
}

/// A point in balls.
#[derive(Clone, Debug)]
pub(super) struct BallForm(pub Vec<BallTerm>);

/// A linear form in the coordinates and its value.
#[derive(Clone, Debug)]
pub(super) struct BallRelation {
    pub terms: Vec<(usize, Ball)>,
    pub constant: Ball,
}

/// The equations of a mechanism with a drive: loops, relations, the drive in the last row.
#[derive(Clone, Debug)]
pub(super) struct System {
    pub bits: u32,
    pub closures: Vec<BallForm>,
    pub relations: Vec<BallRelation>,
    pub drive: Vec<(usize, Ball)>,
    pub bodies: usize,
    pub coordinates: usize,
}

/// Coordinates with the cosines and sines of the angles.
#[derive(Clone, Debug)]
pub(super) struct Pose<T> {
    pub x: Vec<T>,
    pub cos_sin: Vec<(T, T)>,
}

impl<T: Scalar> Pose<T> {
    /// Of which the first `bodies` coordinates are angles.
    pub(super) fn new(x: Vec<T>, bodies: usize) -> Pose<T> {
        Pose {
            cos_sin: x[..bodies].iter().map(T::cos_sin).collect(),
            x,
        }
    }
}

impl BallTerm {
    /// `z u` without the displacement.
    fn turned<T: Scalar>(&self, pose: &Pose<T>) -> [T; 2] {
        match self.body {
            None => [T::real(&self.re), T::real(&self.im)],
            Some(k) => {
                let (c, s) = &pose.cos_sin[k];
                [
                    c.by(&self.re).minus(&s.by(&self.im)),
                    s.by(&self.re).plus(&c.by(&self.im)),
                ]
            }
        }
    }
}

fn sum<T: Scalar>(a: &mut [T; 2], b: &[T; 2]) {
    for i in 0..2 {
        a[i] = a[i].plus(&b[i]);
    }
}

impl BallForm {
    pub(super) fn new(form: &Form, bits: u32) -> BallForm {
        let term = |t: &super::loops::Term| BallTerm {
            re: t.z[0].to_ball(bits),
            im: t.z[1].to_ball(bits),
            slide: t.slide,
            body: t.body,
        };
        BallForm(form.iter().map(term).collect())
    }

    /// Its value.
    pub(super) fn value<T: Scalar>(&self, pose: &Pose<T>, zero: &T) -> [T; 2] {
        let mut out = [zero.clone(), zero.clone()];
        for t in &self.0 {
            let mut v = t.turned(pose);
            if let Some(k) = t.slide {
                v = v.map(|x| x.times(&pose.x[k]));
            }
            sum(&mut out, &v);
        }
        out
    }

    /// Its derivative by every coordinate it depends on: an angle turns its term by a right angle.
    pub(super) fn gradient<T: Scalar>(&self, pose: &Pose<T>, zero: &T) -> Vec<[T; 2]> {
        let mut out = vec![[zero.clone(), zero.clone()]; pose.x.len()];
        for t in &self.0 {
            let v = t.turned(pose);
            if let Some(k) = t.slide {
                sum(&mut out[k], &v);
            }
            if let Some(body) = t.body {
                let [x, y] = match t.slide {
                    Some(k) => v.map(|w| w.times(&pose.x[k])),
                    None => v,
                };
                sum(&mut out[body], &[zero.minus(&y), x]);
            }
        }
        out
    }

    /// `Σ gradient · rates`.
    pub(super) fn rate<T: Scalar>(&self, pose: &Pose<T>, rates: &[T], zero: &T) -> [T; 2] {
        let mut out = [zero.clone(), zero.clone()];
        for (g, r) in self.gradient(pose, zero).iter().zip(rates) {
            sum(&mut out, &[g[0].times(r), g[1].times(r)]);
        }
        out
    }
}

fn linear(terms: &[(usize, rug::Rational)], bits: u32) -> Vec<(usize, Ball)> {
    let term = |(i, k): &(usize, rug::Rational)| (*i, Ball::rational(bits, k));
    terms.iter().map(term).collect()
}

/// `Σ k x`.
fn combination<T: Scalar>(terms: &[(usize, Ball)], x: &[T], zero: &T) -> T {
    terms
        .iter()
        .fold(zero.clone(), |s, (i, k)| s.plus(&x[*i].by(k)))
}

impl System {
    pub(super) fn new(mechanism: &Mechanism, drive: &Drive, bits: u32) -> System {
        let loops = &mechanism.loops;
        let closure = |f: &Form| BallForm::new(f, bits);
        let relation = |r: &Relation| BallRelation {
            terms: linear(&r.terms, bits),
            constant: r.constant.to_ball(bits),
        };
        System {
            bits,
            closures: loops.closures.iter().map(closure).collect(),
            relations: loops.relations.iter().map(relation).collect(),
            drive: linear(&drive.0, bits),
            bodies: mechanism.bodies.len(),
            coordinates: mechanism.coordinates(),
        }
    }

    /// The pose of coordinates.
    pub(super) fn pose<T: Scalar>(&self, x: Vec<T>) -> Pose<T> {
        Pose::new(x, self.bodies)
    }

    /// Zero as a number of this precision.
    pub(super) fn zero<T: Scalar>(&self) -> T {
        T::real(&Ball::integer(self.bits, 0))
    }

    /// Returns what the drive's form gives.
    pub(super) fn driven<T: Scalar>(&self, x: &[T]) -> T {
        combination(&self.drive, x, &self.zero())
    }

    /// All that has to be zero when the drive is at `drive`.
    pub(super) fn residual<T: Scalar>(&self, pose: &Pose<T>, drive: &T) -> Vec<T> {
        let zero = self.zero();
        let mut out = Vec::with_capacity(self.coordinates);
        for f in &self.closures {
            out.extend(f.value(pose, &zero));
        }
        for r in &self.relations {
            let constant = T::real(&r.constant);
            out.push(combination(&r.terms, &pose.x, &zero).minus(&constant));
        }
        out.push(self.driven(&pose.x).minus(drive));
        out
    }

    /// The Jacobian, square.
    pub(super) fn jacobian<T: Scalar>(&self, pose: &Pose<T>) -> Vec<Vec<T>> {
        let zero = self.zero::<T>();
        let mut out = Vec::with_capacity(self.coordinates);
        for f in &self.closures {
            let g = f.gradient(pose, &zero);
            for i in 0..2 {
                out.push(g.iter().map(|v| v[i].clone()).collect());
            }
        }
        let row = |terms: &[(usize, Ball)]| {
            let mut row = vec![zero.clone(); self.coordinates];
            for (i, k) in terms {
                row[*i] = row[*i].plus(&T::real(k));
            }
            row
        };
        out.extend(self.relations.iter().map(|r| row(&r.terms)));
        out.push(row(&self.drive));
        out
    }
}
