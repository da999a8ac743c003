//! Positions with directions that are decided by exact algebra.
//!
//! Where branches meet the Jacobian is singular and Krawczyk's test fails. Change points and double
//! positions of mechanisms with simple numbers have directions in `Q(√d)`, the numbers `a + b √d`
//! with fractions a and b. A direction is guessed from approximate coordinates; then the equations
//! in which all directions are guessed are decided in the field, without rounding. The coordinates
//! of those that hold are known exactly, provided they are as many as those equations; the rest is
//! enclosed by Krawczyk's operator with these coordinates held. So the position is proved to be
//! one, and nothing is said of others nearby.
//!
//! In a parallelogram bodies keep their directions or turn with the crank, whatever its angle.
//! There the drive's direction w stays a letter, directions are numbers of the field times 1 or w,
//! and a loop closes if the coefficients of both are zero. Then the rates are 0 or 1 all along.

use super::enclosure::{Linkage, Position};
use super::loops::{Form, Relation, Term};
use super::parts::Attachment;
use super::real::Real;
use super::surd::{Field, Surd, Vector, roots_near};
use super::system::{BallForm, BallRelation, System};
use crate::class_iii::ExactAngle;
use crate::{Ball, Mag, Undecided};
use rug::{Float, Integer, Rational};

/// The drive by exact numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum ExactDrive {
    /// The direction at its angle.
    Direction([Real; 2]),
    /// A displacement.
    Displacement(Real),
}

/// A position of which some coordinates are exact.
#[derive(Clone, Debug)]
pub struct Special {
    /// All coordinates.
    pub position: Position,
    field: Field,
    directions: Vec<Option<Vector>>,
    /// Which bodies turn with the drive, their directions being factors of its own.
    turns: Vec<bool>,
    displacements: Vec<Option<Surd>>,
    /// The drive's direction, if it is in the field.
    w: Option<Vector>,
}

/// Fields tried, powers of directions in the equations of gears: enough for simple numbers.
const MOST_FIELDS: usize = 12;
const MOST_POWER: i32 = 64;

/// Guessed directions, and what the equations say of them.
struct Trial<'a> {
    linkage: &'a Linkage,
    field: Field,
    guess: &'a [f64],
    drive_ball: &'a Ball,
    directions: Vec<Option<Vector>>,
    turns: Vec<bool>,
    displacements: Vec<Option<Surd>>,
    /// Which closures, relations and whether the drive's equation hold exactly.
    closures: Vec<bool>,
    relations: Vec<bool>,
    drive: bool,
}

impl Linkage {
    /// The position next to approximate coordinates, by exact algebra where its directions are
    /// simple.
    ///
    /// # Errors
    /// [`Undecided`] where no directions of bodies are found that fulfil equations exactly, or the
    /// rest of the position is singular too.
    pub fn special(
        &self,
        drive: &Ball,
        exact: &ExactDrive,
        guess: &[f64],
    ) -> Result<Special, Undecided> {
        let fields = self.fields(exact, guess).into_iter();
        let fixed = vec![Some(false); self.mechanism.bodies.len()];
        let trials = fields.map(|field| Trial::new(self, field, Some(exact), drive, &fixed, guess));
        self.best(trials, drive)
    }

    /// The position next to approximate coordinates as one of a motion in which bodies keep their
    /// directions or turn with the drive, for any value of it: which of them turn is told for each
    /// body, nothing where neither holds.
    ///
    /// # Errors
    /// [`Undecided`] where no such motion is proved.
    pub fn family(
        &self,
        drive: &Ball,
        exact: &ExactDrive,
        turns: &[Option<bool>],
        guess: &[f64],
    ) -> Result<Special, Undecided> {
        let fields = self.fields(exact, guess).into_iter();
        let trials = fields.map(|field| Trial::new(self, field, None, drive, turns, guess));
        let mut found = self.best(trials.filter(|t| t.drive), drive)?;
        if let ExactDrive::Direction([c, s]) = exact {
            found.w = found
                .field
                .take(c)
                .zip(found.field.take(s))
                .map(|(c, s)| [c, s]);
        }
        Ok(found)
    }

    fn best<'a>(
        &'a self,
        trials: impl Iterator<Item = Trial<'a>>,
        drive: &Ball,
    ) -> Result<Special, Undecided> {
        let trials = trials.filter(|t| t.known().len() == t.equations());
        let best = trials.max_by_key(|t| t.known().len());
        let best = best.filter(|t| !t.known().is_empty()).ok_or_else(|| {
            self.undecided(
                "the position is singular or nearly so, and its directions are no simple numbers",
            )
        })?;
        best.rest(drive).ok_or_else(|| {
            self.undecided(
                "a part of the position is singular or nearly so, and its directions are no simple numbers",
            )
        })
    }

    /// The fields that directions near the coordinates may be in.
    fn fields(&self, drive: &ExactDrive, guess: &[f64]) -> Vec<Field> {
        let mut all = vec![Integer::from(1)];
        let forms = self.mechanism.loops.closures.iter().flatten();
        let mut numbers: Vec<&Real> = forms.flat_map(|t| &t.z).collect();
        match drive {
            ExactDrive::Direction(u) => numbers.extend(u),
            ExactDrive::Displacement(s) => numbers.push(s),
        }
        let known = numbers.iter().filter_map(|x| Some(x.surd()?.1?.1.clone()));
        all.extend(known);
        all.extend(
            guess[..self.mechanism.bodies.len()]
                .iter()
                .flat_map(|a| roots_near(*a)),
        );
        let mut fields: Vec<Field> = Vec::new();
        for d in all {
            let field = Field(d);
            if fields.len() < MOST_FIELDS && !fields.contains(&field) {
                fields.push(field);
            }
        }
        fields
    }
}

impl<'a> Trial<'a> {
    fn new(
        linkage: &'a Linkage,
        field: Field,
        exact: Option<&ExactDrive>,
        drive: &'a Ball,
        turns: &[Option<bool>],
        guess: &'a [f64],
    ) -> Trial<'a> {
        let mechanism = &linkage.mechanism;
        let bodies = mechanism.bodies.len();
        let direction = |(angle, turns): (&f64, &Option<bool>)| match turns {
            Some(true) => field.direction(angle - drive.to_f64()),
            Some(false) => field.direction(*angle),
            None => None,
        };
        let mut trial = Trial {
            directions: guess[..bodies].iter().zip(turns).map(direction).collect(),
            turns: turns.iter().map(|t| *t == Some(true)).collect(),
            drive_ball: drive,
            displacements: vec![None; mechanism.coordinates() - bodies],
            closures: vec![false; mechanism.loops.closures.len()],
            relations: vec![false; mechanism.loops.relations.len()],
            drive: false,
            linkage,
            field,
            guess,
        };
        trial.drive = trial.driven(exact);
        for (k, relation) in mechanism.loops.relations.iter().enumerate() {
            trial.relations[k] = trial.relates(relation);
        }
        // A closure may give displacements that others need.
        for _ in 0..=mechanism.loops.closures.len() {
            for (k, form) in mechanism.loops.closures.iter().enumerate() {
                if !trial.closures[k] {
                    trial.closures[k] = trial.closes(form).unwrap_or(false);
                }
            }
        }
        trial
    }

    /// Returns whether the drive's equation holds.
    fn driven(&mut self, exact: Option<&ExactDrive>) -> bool {
        let bodies = self.directions.len();
        let terms = &self.linkage.drive.0;
        match exact {
            None => {
                let one = [Surd::from(Rational::from(1)), Surd::default()];
                self.agrees(terms, &one, 1, self.drive_ball, 1)
            }
            Some(ExactDrive::Displacement(s)) => {
                let [(k, one)] = &terms[..] else {
                    return false;
                };
                let Some(s) = self.field.take(s).filter(|_| *one == 1 && *k >= bodies) else {
                    return false;
                };
                self.displacements[*k - bodies] = Some(s);
                true
            }
            Some(ExactDrive::Direction([c, s])) => {
                let (Some(c), Some(s)) = (self.field.take(c), self.field.take(s)) else {
                    return false;
                };
                self.agrees(terms, &[c, s], 1, self.drive_ball, 0)
            }
        }
    }

    /// Returns whether an equation between angles holds.
    fn relates(&self, relation: &Relation) -> bool {
        let denominators = relation.terms.iter().map(|(_, k)| k.denom());
        let lcm = denominators.fold(Integer::from(1), |l, d| l.lcm(d));
        let Some(lcm) = lcm.to_i32().filter(|l| *l <= MOST_POWER) else {
            return false;
        };
        let times = match &relation.constant {
            ExactAngle::Degrees(q) => ExactAngle::Degrees(Rational::from(q * lcm)),
            ExactAngle::Radians(q) => ExactAngle::Radians(Rational::from(q * lcm)),
        };
        let [c, s] = Real::unit(&times);
        let (Some(c), Some(s)) = (self.field.take(&c), self.field.take(&s)) else {
            return false;
        };
        let constant = relation.constant.to_ball(64);
        self.agrees(&relation.terms, &[c, s], lcm, &constant, 0)
    }

    /// Returns whether `Σ k x = constant`, whose multiple has that direction times a power of the
    /// drive's: `Π u^(multiple k)` is the same, so that the multiples agree up to whole turns, and
    /// the sides differ by less than a turn of the multiple.
    fn agrees(
        &self,
        terms: &[(usize, Rational)],
        direction: &Vector,
        multiple: i32,
        constant: &Ball,
        power_of_drive: i32,
    ) -> bool {
        let mut with_drive = 0;
        let mut product = [Surd::from(Rational::from(1)), Surd::default()];
        let mut off = -constant.with_prec(64);
        for (k, factor) in terms {
            let Some(Some(u)) = self.directions.get(*k) else {
                return false;
            };
            let power = Rational::from(factor * multiple);
            let Some(n) = power.numer().to_i32().filter(|n| n.abs() <= MOST_POWER) else {
                return false;
            };
            product = self.field.turned(&product, &self.field.power(u, n));
            with_drive += n * i32::from(self.turns[*k]);
            off = off + self.angle(*k, 64) * Ball::rational(64, factor);
        }
        let same = product == *direction && with_drive == power_of_drive;
        same && off.magnitude() < Mag::from_f64(1.0 / f64::from(multiple))
    }

    /// Returns whether a loop closes, with the displacements that it needs for that; `None` if it
    /// has unknown directions.
    fn closes(&mut self, form: &Form) -> Option<bool> {
        let field = &self.field;
        let mut rest = [Surd::default(), Surd::default()];
        // The coefficient of the drive's direction.
        let mut turning = rest.clone();
        let mut open: Vec<(usize, Vector)> = Vec::new();
        for t in form {
            let z = [field.take(&t.z[0])?, field.take(&t.z[1])?];
            let z = match t.body {
                None => z,
                Some(k) => field.turned(&z, self.directions[k].as_ref()?),
            };
            let slide = t.slide.map(|j| j - self.directions.len());
            let sum = match t.body.is_some_and(|k| self.turns[k]) {
                true => &mut turning,
                false => &mut rest,
            };
            match slide.map(|j| (j, &self.displacements[j])) {
                None => *sum = [sum[0].plus(&z[0]), sum[1].plus(&z[1])],
                Some((_, Some(s))) => {
                    let z = z.map(|x| field.times(&x, s));
                    *sum = [sum[0].plus(&z[0]), sum[1].plus(&z[1])];
                }
                Some(_) if t.body.is_some_and(|k| self.turns[k]) => return None,
                Some((j, None)) => match open.iter_mut().find(|o| o.0 == j) {
                    Some((_, v)) => *v = [v[0].plus(&z[0]), v[1].plus(&z[1])],
                    None => open.push((j, z)),
                },
            }
        }
        if !turning.iter().all(Surd::is_zero) {
            return Some(false);
        }
        let minus = rest.each_ref().map(Surd::negated);
        match &open[..] {
            [] => Some(rest.iter().all(Surd::is_zero)),
            [(j, v)] => {
                if !field.cross(v, &rest).is_zero() || v.iter().all(Surd::is_zero) {
                    return Some(false);
                }
                let i = usize::from(v[0].is_zero());
                self.displacements[*j] = Some(field.over(&minus[i], &v[i]));
                Some(true)
            }
            [(j, v), (k, w)] => {
                let determinant = field.cross(v, w);
                if determinant.is_zero() {
                    return Some(false);
                }
                let first = field.over(&field.cross(&minus, w), &determinant);
                let second = field.over(&field.cross(v, &minus), &determinant);
                let (j, k) = (*j, *k);
                self.displacements[j] = Some(first);
                self.displacements[k] = Some(second);
                Some(true)
            }
            _ => None,
        }
    }

    /// The coordinates of the equations that hold.
    fn known(&self) -> Vec<usize> {
        let loops = &self.linkage.mechanism.loops;
        let bodies = self.directions.len();
        let mut all = vec![false; loops.coordinates];
        let held = |flags: &[bool], k: usize| flags[k];
        for (k, form) in loops.closures.iter().enumerate() {
            for t in form.iter().filter(|_| held(&self.closures, k)) {
                let both = t.body.into_iter().chain(t.slide);
                both.for_each(|i| all[i] = true);
            }
        }
        for (k, relation) in loops.relations.iter().enumerate() {
            let terms = relation.terms.iter().filter(|_| held(&self.relations, k));
            terms.for_each(|(i, _)| all[*i] = true);
        }
        let driven = self.linkage.drive.0.iter().filter(|_| self.drive);
        driven.for_each(|(i, _)| all[*i] = true);
        let exact = |i: &usize| match i.checked_sub(bodies) {
            None => self.directions[*i].is_some(),
            Some(j) => self.displacements[j].is_some(),
        };
        (0..all.len()).filter(|i| all[*i] && exact(i)).collect()
    }

    /// The number of equations that hold.
    fn equations(&self) -> usize {
        let count = |flags: &[bool]| flags.iter().filter(|f| **f).count();
        2 * count(&self.closures) + count(&self.relations) + usize::from(self.drive)
    }

    /// The angle of an exact direction, next to the guess.
    fn angle(&self, body: usize, bits: u32) -> Ball {
        let Some([c, s]) = &self.directions[body] else {
            return Ball::new(Float::new(bits), Mag::INFINITY);
        };
        let [c, s] = [c, s].map(|x| self.field.to_ball(x, bits));
        let mut angle = s.atan2(&c);
        if self.turns[body] {
            angle = angle + self.drive_ball.with_prec(bits);
        }
        let turns = (self.guess[body] - angle.to_f64()) / std::f64::consts::TAU;
        match turns.round() as i64 {
            0 => angle,
            turns => angle + Ball::pi(bits).shift(1) * Ball::integer(bits, turns),
        }
    }

    /// An exact coordinate.
    fn coordinate(&self, i: usize, bits: u32) -> Ball {
        let displacement = i.checked_sub(self.directions.len());
        match displacement.and_then(|j| self.displacements[j].as_ref()) {
            Some(s) => self.field.to_ball(s, bits),
            None => self.angle(i, bits),
        }
    }

    /// The system with exact coordinates held in place of the equations that hold.
    fn held(&self, system: &System) -> System {
        let open = |flags: &[bool], k: usize| !flags[k];
        let closures = system.closures.iter().enumerate();
        let relations = system.relations.iter().enumerate();
        let closures = closures.filter(|(k, _)| open(&self.closures, *k));
        let relations = relations.filter(|(k, _)| open(&self.relations, *k));
        // The drive's equation stays and holds one of its coordinates.
        let driven = self.drive.then(|| self.linkage.drive.0[0].0);
        let known = self.known().into_iter().filter(|i| Some(*i) != driven);
        let hold = known.map(|i| BallRelation {
            terms: vec![(i, Ball::integer(system.bits, 1))],
            constant: self.coordinate(i, system.bits),
        });
        System {
            closures: closures.map(|(_, f)| f.clone()).collect(),
            relations: relations.map(|(_, r)| r.clone()).chain(hold).collect(),
            ..system.clone()
        }
    }

    /// The whole position.
    fn rest(self, drive: &Ball) -> Option<Special> {
        let linkage = self.linkage;
        let bits = linkage.bits();
        let known = self.known();
        let mut position = match known.len() == linkage.mechanism.coordinates() {
            true => Position { x: Vec::new() },
            false => {
                let held = Linkage {
                    fine: self.held(&linkage.fine),
                    coarse: self.held(&linkage.coarse),
                    mechanism: linkage.mechanism.clone(),
                    drive: linkage.drive.clone(),
                };
                let guess = self.guess.iter().map(|x| Float::with_val(64, *x));
                held.enclose(drive, &guess.collect::<Vec<_>>())?
            }
        };
        let zero = || Ball::integer(bits, 0);
        position
            .x
            .resize_with(linkage.mechanism.coordinates(), zero);
        for i in &known {
            position.x[*i] = self.coordinate(*i, bits);
        }
        let bodies = self.directions.len();
        let kept = |i: usize| known.contains(&i);
        let directions = self.directions.into_iter().enumerate();
        let displacements = self.displacements.into_iter().enumerate();
        Some(Special {
            w: None,
            turns: self.turns,
            position,
            field: self.field,
            directions: directions.map(|(i, u)| u.filter(|_| kept(i))).collect(),
            displacements: displacements
                .map(|(j, s)| s.filter(|_| kept(bodies + j)))
                .collect(),
        })
    }
}

impl Special {
    /// The quarter turns, from 0 to 3, of a vector of a body, if its direction is exactly that of
    /// an axis.
    pub fn quarters(&self, body: usize, vector: &[Rational; 2]) -> Option<u32> {
        let u = self.directions[body]
            .as_ref()
            .filter(|_| !self.turns[body])?;
        let z = vector.clone().map(Surd::from);
        let [x, y] = self.field.turned(&z, u);
        let positive = |x: &Surd| self.field.to_ball(x, 64).is_positive();
        match (x.is_zero(), y.is_zero()) {
            (false, true) => Some(if positive(&x) { 0 } else { 2 }),
            (true, false) => Some(if positive(&y) { 1 } else { 3 }),
            _ => None,
        }
    }

    /// The derivative of a coordinate by the drive all along the motion of a [`Linkage::family`].
    pub fn rate(&self, coordinate: usize) -> Option<u32> {
        match coordinate.checked_sub(self.directions.len()) {
            None => self.directions[coordinate]
                .as_ref()
                .map(|_| u32::from(self.turns[coordinate])),
            Some(j) => self.displacements[j].as_ref().map(|_| 0),
        }
    }

    /// A point with its first and second derivative by the drive, exact, in that motion: `p + q w`,
    /// `i q w`, `−q w`. Nothing where q is not zero and w not in the field.
    pub fn motion(&self, linkage: &Linkage, at: &Attachment) -> Option<[[Ball; 2]; 3]> {
        let [rest, turning] = self.sums(&linkage.mechanism.loops.point(at))?;
        let turning = match &self.w {
            _ if turning.iter().all(Surd::is_zero) => turning,
            Some(w) => self.field.turned(&turning, w),
            None => return None,
        };
        let [x, y] = &turning;
        let all = [
            [rest[0].plus(x), rest[1].plus(y)],
            [y.negated(), x.clone()],
            [x.negated(), y.negated()],
        ];
        Some(all.map(|v| v.map(|x| self.field.to_ball(&x, linkage.bits()))))
    }

    /// A point's coordinates, exact where they are zero and all directions on the way are exact.
    pub fn point(&self, linkage: &Linkage, at: &Attachment) -> [Ball; 2] {
        let form = linkage.mechanism.loops.point(at);
        let bits = linkage.bits();
        if let Some([p, _]) = self
            .sums(&form)
            .filter(|[_, q]| q.iter().all(Surd::is_zero))
        {
            return p.map(|x| self.field.to_ball(&x, bits));
        }
        let pose = linkage.fine.pose(self.position.x.clone());
        BallForm::new(&form, bits).value(&pose, &Ball::integer(bits, 0))
    }

    /// Returns whether directions are factors of the drive's.
    pub(super) fn turns(&self) -> bool {
        self.turns.contains(&true)
    }

    pub(super) fn field(&self) -> &Field {
        &self.field
    }

    /// `z u` of a term, and its displacement if it has one.
    pub(super) fn term(&self, t: &Term) -> Option<(Vector, Option<Surd>)> {
        let mut z = [self.field.take(&t.z[0])?, self.field.take(&t.z[1])?];
        if let Some(k) = t.body {
            z = self.field.turned(&z, self.directions[k].as_ref()?);
        }
        let s = match t.slide {
            Some(j) => Some(self.displacements[j - self.directions.len()].clone()?),
            None => None,
        };
        Some((z, s))
    }

    /// The parts of a form that rest and that turn with the drive, if all its directions are exact.
    fn sums(&self, form: &Form) -> Option<[Vector; 2]> {
        let mut both = <[Vector; 2]>::default();
        for t in form {
            let (mut z, s) = self.term(t)?;
            if let Some(s) = s {
                z = z.map(|x| self.field.times(&x, &s));
            }
            let sum = &mut both[usize::from(t.body.is_some_and(|k| self.turns[k]))];
            *sum = [sum[0].plus(&z[0]), sum[1].plus(&z[1])];
        }
        Some(both)
    }
}

#[cfg(test)]
mod tests;
