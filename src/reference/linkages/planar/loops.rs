//! Loop equations: every point as a form in the bodies' directions.
//!
//! With `u_k = (cos ψ_k, sin ψ_k)` as a complex number and exact complex z, a point is
//! `P = Σ z u_k` over the joints on the way from the ground to its body, a term of a slide having
//! its displacement as a further factor. A joint that closes a loop says that two such forms are
//! equal.

use super::parts::{Attachment, Body, Frame, Joint, MechanismError, Place};
use crate::class_iii::ExactAngle;
use rug::Rational;

/// `z s u` with a complex z, a displacement s and a direction u.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// The real and the imaginary part of z.
    pub z: Place,
    /// The coordinate s; none is one.
    pub slide: Option<usize>,
    /// The body whose direction is u; none is the ground, u = 1.
    pub body: Option<usize>,
}

/// A point or a difference of points.
pub type Form = Vec<Term>;

/// `Σ k x = constant` in the coordinates x.
#[derive(Clone, Debug)]
pub struct Relation {
    /// Coordinates with their factors k.
    pub terms: Vec<(usize, Rational)>,
    /// The constant: an angle, or metres as radians.
    pub constant: ExactAngle,
}

/// Bodies' origins, loops and relations of a mechanism with any number of degrees of freedom.
#[derive(Clone, Debug)]
pub struct Loops {
    /// Angles and displacements.
    pub coordinates: usize,
    /// Where each body's origin is.
    pub origins: Vec<Form>,
    /// Holds what has to be zero, two equations each.
    pub closures: Vec<Form>,
    /// One equation each.
    pub relations: Vec<Relation>,
}

fn add(form: &mut Form, term: Term) {
    match form
        .iter_mut()
        .find(|t| t.slide == term.slide && t.body == term.body)
    {
        Some(same) => {
            for i in 0..2 {
                same.z[i] += &term.z[i];
            }
        }
        None => form.push(term),
    }
    form.retain(|t| t.z.iter().any(|x| !x.is_zero()));
}

/// `a − b`.
pub(super) fn difference(a: &Form, b: &Form) -> Form {
    let mut out = a.clone();
    for t in b {
        let z = t.z.clone().map(|x| -x);
        add(&mut out, Term { z, ..t.clone() });
    }
    out
}

/// The point, from the origins known so far; none if its body's is not.
fn located(origins: &[Option<Form>], at: &Attachment) -> Option<Form> {
    let origin = match at.frame.body() {
        None => Form::new(),
        Some(i) => origins[i].clone()?,
    };
    Some(attached(origin, at))
}

/// The point, from the origin of its frame.
fn attached(mut origin: Form, at: &Attachment) -> Form {
    let arm = Term {
        z: at.point.clone(),
        slide: None,
        body: at.frame.body(),
    };
    add(&mut origin, arm);
    origin
}

/// Describes what a joint says of two points: `a + travel = b`.
struct Link<'a> {
    a: &'a Attachment,
    b: &'a Attachment,
    travel: Option<Term>,
}

impl Link<'_> {
    /// Gives one body its origin if the other end is located.
    fn locate(&self, origins: &mut [Option<Form>]) -> bool {
        for (from, to, sign) in [(self.a, self.b, 1), (self.b, self.a, -1)] {
            let Frame::Body(new) = to.frame else { continue };
            if origins[new].is_some() {
                continue;
            }
            let Some(mut form) = located(origins, from) else {
                continue;
            };
            if let Some(t) = &self.travel {
                let z = t.z.clone().map(|x| x * &Rational::from(sign));
                add(&mut form, Term { z, ..t.clone() });
            }
            let back = Attachment::body(new, to.point.clone().map(|x| -x));
            origins[new] = Some(attached(form, &back));
            return true;
        }
        false
    }
}

impl Loops {
    /// Walks from the ground; joints that locate no body close loops. Coordinates are the bodies'
    /// angles, then the displacements of slides and slots in the order of the joints.
    ///
    /// # Errors
    /// [`MechanismError::Loose`] for a body that hangs on nothing.
    pub fn close(bodies: &[Body], joints: &[Joint]) -> Result<Loops, MechanismError> {
        let mut coordinates = bodies.len();
        let mut slides = vec![None; joints.len()];
        for (i, j) in joints.iter().enumerate() {
            if j.slides() {
                slides[i] = Some(coordinates);
                coordinates += 1;
            }
        }
        let links = joints.iter().zip(&slides);
        let mut open: Vec<Link> = links.filter_map(|(j, slide)| link(j, *slide)).collect();
        // On a guide of the ground a body's place has no angle in it.
        open.sort_by_key(|l| l.travel.is_none() || l.a.frame != Frame::Ground);
        let mut origins: Vec<Option<Form>> = vec![None; bodies.len()];
        loop {
            let before = open.len();
            open.retain(|l| !l.locate(&mut origins));
            if open.len() == before {
                break;
            }
        }
        if let Some(loose) = origins.iter().position(Option::is_none) {
            return Err(MechanismError::Loose(bodies[loose].name.clone()));
        }
        let closures = open
            .iter()
            .map(|l| {
                let end = |at| located(&origins, at).unwrap_or_default();
                let mut from = end(l.a);
                if let Some(t) = &l.travel {
                    add(&mut from, t.clone());
                }
                difference(&from, &end(l.b))
            })
            .collect();
        Ok(Loops {
            coordinates,
            closures,
            relations: joints
                .iter()
                .filter_map(|j| relation(j, joints, &slides))
                .collect(),
            origins: origins.into_iter().flatten().collect(),
        })
    }

    /// The number of real equations.
    pub fn equations(&self) -> usize {
        2 * self.closures.len() + self.relations.len()
    }

    /// The point of an attachment.
    pub fn point(&self, at: &Attachment) -> Form {
        let body = at.frame.body();
        attached(body.map_or_else(Form::new, |i| self.origins[i].clone()), at)
    }
}

fn link(joint: &Joint, slide: Option<usize>) -> Option<Link<'_>> {
    match joint {
        Joint::Pin { a, b } => Some(Link { a, b, travel: None }),
        Joint::Slide {
            a, b, direction: d, ..
        }
        | Joint::Slot { a, b, direction: d } => Some(Link {
            a,
            b,
            travel: Some(Term {
                z: d.clone(),
                slide,
                body: a.frame.body(),
            }),
        }),
        Joint::Gear { .. } | Joint::Rack { .. } => None,
    }
}

/// Multiples of the angles of frames; the ground's is zero.
fn turns<const N: usize>(of: [(Frame, Rational); N]) -> Vec<(usize, Rational)> {
    let turns = of.into_iter();
    turns.filter_map(|(f, k)| Some((f.body()?, k))).collect()
}

fn relation(joint: &Joint, joints: &[Joint], slides: &[Option<usize>]) -> Option<Relation> {
    let one = || Rational::from(1);
    match joint {
        Joint::Pin { .. } | Joint::Slot { .. } => None,
        Joint::Slide { a, b, turn, .. } => Some(Relation {
            terms: turns([(b.frame, one()), (a.frame, -one())]),
            constant: turn.clone(),
        }),
        Joint::Gear {
            a,
            b,
            carrier,
            ratio,
            offset,
        } => Some(Relation {
            terms: turns([
                (*b, one()),
                (*a, Rational::from(-ratio)),
                (*carrier, Rational::from(ratio - 1u32)),
            ]),
            constant: offset.clone(),
        }),
        Joint::Rack {
            pinion,
            slide,
            ratio,
            offset,
        } => {
            let mut terms = vec![(slides[*slide]?, one())];
            terms.extend(turns([(*pinion, Rational::from(-ratio))]));
            if let Joint::Slide { a, .. } | Joint::Slot { a, .. } = &joints[*slide] {
                terms.extend(turns([(a.frame, ratio.clone())]));
            }
            Some(Relation {
                terms,
                constant: ExactAngle::Radians(offset.clone()),
            })
        }
    }
}

#[cfg(test)]
mod tests;
