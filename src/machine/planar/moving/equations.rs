//! The equations of motion as formulas: an initial value problem.
//!
//! Coordinates q are the angles of the bodies and the displacements of slides that are left after
//! linear relations. Every point is a sum of terms `z s u` with `u = e^{iψ}`, so its derivatives by
//! q are too. With the closures g(q) = 0 and `G = ∂g/∂q`,
//!
//! ```text
//! M q̈ + Gᵀ λ = f,   G q̈ = γ
//! ```
//!
//! Where a coordinate may have no inertia of its own, `w Gᵀ G` is added to M and `w Gᵀ γ` to f,
//! with the same q̈ and λ: what is eliminated then is positive definite at every position where the
//! motion is determined, so that no pivot vanishes and none has to be exchanged on the way. `M = L
//! D Lᵀ`; then `Gᵀ` is eliminated from the second block, whose Schur complement `G M⁻¹ Gᵀ` is
//! positive definite too.
//!
//! A solution that begins with g = 0 and ġ = 0 keeps both, so that loops are closed by what is
//! solved and not by a correction. The start is the enclosed solution of g = 0 with the coordinates
//! given.

use super::super::exact::{attached, frame, reference_joints};
use super::laws::{INNER, Names};
use super::linear::{Linear, reduced};
use super::loads::MovingLoad;
use super::pushes::Generalised;
use super::text::{Vector, add, dot, mul, rational, sub, sum, zero};
use super::{Moving, MovingError, Row};
use crate::reference::planar::{Attachment, Body, Form, Loops};
use crate::solvers::planar::dynamics::{Coordinate, Settings};
use crate::solvers::planar::{Drive, Point};
use mechaudit_symbolic::Expr;
use rug::Rational;
use std::collections::HashMap;

/// A state with its start and its rate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct State {
    /// Its name.
    pub name: String,
    /// Its value at t = 0.
    pub start: String,
    /// Its derivative by the time.
    pub rate: String,
}

/// An initial value problem in formulas of the time t.
#[derive(Clone, Debug, Default)]
pub struct Equations {
    /// Intermediate results in the order in which they are defined.
    pub definitions: Vec<(String, String)>,
    /// Parameters and formulas of the file.
    pub given: Vec<(String, Expr)>,
    /// Unknowns of the start with places near them.
    pub unknowns: Vec<(String, f64)>,
    /// Expressions that are zero at the start.
    pub equations: Vec<String>,
    /// The states.
    pub states: Vec<State>,
    /// Quantities of a row as formulas of the states.
    pub outputs: Vec<String>,
}

/// The state whose rate is the sign of the value that ends the motion.
pub(super) const UNTIL: &str = "aux_until";
/// The state that grows where the motor's table says nothing.
pub(super) const OUTSIDE: &str = "aux_outside";

pub(super) struct Writer<'a> {
    pub moving: &'a Moving,
    pub names: &'a Names,
    pub loops: Loops,
    pub bodies: usize,
    /// All coordinates by those that are left.
    pub linear: Vec<Linear>,
    /// The coordinates that are left.
    pub free: Vec<usize>,
    /// Names of these coordinates and of their rates.
    pub q: Vec<[String; 2]>,
    pub out: Equations,
    /// Definitions by their texts.
    pub known: HashMap<String, String>,
}

pub(super) fn not_exact(e: impl std::fmt::Display) -> MovingError {
    MovingError::NotExact(e.to_string())
}

impl Moving {
    /// The equations of motion as formulas, with the quantities of a row.
    ///
    /// # Errors
    /// [`MovingError`]: no start, numbers that are not exact, relations that repeat one another,
    /// forces in joints that are not determined.
    pub fn equations(&self, row: &Row) -> Result<Equations, MovingError> {
        let mut first = None;
        let start = self.assembly()?;
        self.dynamics
            .motion(&start, &[0.0], Settings::default(), |m| {
                first = Some(m.clone());
                true
            })?;
        let first = first.ok_or_else(|| not_exact("there is no start"))?;
        let joints = reference_joints(&self.exactly()).map_err(not_exact)?;
        let bodies: Vec<Body> = self.bodies[1..].iter().map(|n| Body::massless(n)).collect();
        let loops = Loops::close(&bodies, &joints).map_err(not_exact)?;
        let keep: Vec<usize> = self
            .start
            .given
            .iter()
            .map(|g| self.index(g.coordinate))
            .collect();
        let linear = reduced(loops.coordinates, &loops.relations, &keep);
        let linear = linear
            .ok_or_else(|| not_exact("slides, gears or racks repeat or contradict one another"))?;
        let is_left = |i: &usize| linear[*i].terms == [(*i, Rational::from(1))];
        let free: Vec<usize> = (0..loops.coordinates).filter(is_left).collect();
        let mut writer = Writer {
            moving: self,
            names: &self.names,
            bodies: bodies.len(),
            q: Vec::new(),
            loops,
            linear,
            free,
            out: Equations::default(),
            known: HashMap::new(),
        };
        writer.name();
        writer.start(&first);
        let accelerations = writer.motion()?;
        let until = match row {
            Row::Motion { reactions } => {
                if *reactions {
                    writer.reactions(&accelerations)?;
                }
                self.until.as_ref().map(|(formula, _)| writer.law(formula))
            }
            Row::RunUp { target } => {
                let [angle, speed, acceleration] = writer.drive(&accelerations)?;
                let until = target.as_ref().map(|t| sub(&speed, t));
                let degrees = format!("({angle})*180/pi");
                let drive = [degrees, speed, acceleration].map(|x| writer.define(x));
                writer.out.outputs = drive.into();
                until.map(|u| writer.define(u))
            }
        };
        writer.ends(until);
        Ok(writer.out)
    }

    /// The number of a coordinate in the exact description.
    pub(super) fn index(&self, coordinate: Coordinate) -> usize {
        match coordinate {
            Coordinate::Angle { body, .. } => body - 1,
            Coordinate::Displacement { joint } => {
                let before = self.travels().iter().position(|t| t.0 == joint);
                self.bodies.len() - 1 + before.unwrap_or_default()
            }
        }
    }
}

impl Writer<'_> {
    /// A name for a text; numbers and names stand for themselves.
    pub(super) fn define(&mut self, text: String) -> String {
        let atom = |c: char| c.is_ascii_alphanumeric() || c == '_';
        if text.chars().all(atom) {
            return text;
        }
        if let Some(name) = self.known.get(&text) {
            return name.clone();
        }
        let name = format!("{INNER}{}", self.out.definitions.len());
        self.out.definitions.push((name.clone(), text.clone()));
        self.known.insert(text, name.clone());
        name
    }

    pub(super) fn define_pair(&mut self, [x, y]: Vector) -> Vector {
        [self.define(x), self.define(y)]
    }

    /// The angle of a body's line in its frame.
    pub(super) fn line(&self, body: usize) -> String {
        let moving = self.moving;
        if body == 0 || moving.lines[body] == 0.0 {
            return "0".into();
        }
        let [(_, Some(a)), (_, Some(b)), ..] = &moving.points[body][..] else {
            return "0".into();
        };
        let way = [0, 1].map(|i| {
            let mut way = b[i].clone();
            way += &-a[i].clone();
            way.formula()
        });
        format!("atan2({}, {})", way[1], way[0])
    }

    /// The names of coordinates, and definitions of those that follow from others.
    pub(super) fn name(&mut self) {
        let travels = self.moving.travels();
        let names = self.names;
        let names_of = |i: usize| match i < self.bodies {
            true => names.of_body(i + 1).clone(),
            false => names.of_joint(travels[i - self.bodies].0).clone(),
        };
        let lined = |i: usize| i < self.bodies && self.moving.lines[i + 1] != 0.0;
        let state = |i: usize| {
            let [place, rate] = names_of(i);
            let place = if lined(i) {
                format!("{INNER}of_{i}")
            } else {
                place
            };
            [place, rate]
        };
        self.q = self.free.iter().map(|i| state(*i)).collect();
        for i in 0..self.loops.coordinates {
            let [place, rate] = names_of(i);
            let value = self.value(i, 0);
            let line = if i < self.bodies {
                self.line(i + 1)
            } else {
                "0".into()
            };
            let shown = add(&value, &line);
            if shown != place {
                self.out.definitions.push((place.clone(), shown));
            }
            let speed = self.speed(i);
            if speed != rate {
                self.out.definitions.push((rate.clone(), speed));
            }
            self.out.outputs.extend([place, rate]);
        }
    }

    /// Position of a coordinate among those that are left.
    pub(super) fn place(&self, index: usize) -> usize {
        let place = self.free.iter().position(|f| *f == index);
        place.unwrap_or_default()
    }

    /// The coordinate i by those that are left, whose names are the k-th of each pair.
    pub(super) fn value(&self, i: usize, k: usize) -> String {
        self.by(
            i,
            &self.q.iter().map(|q| q[k].clone()).collect::<Vec<_>>(),
            true,
        )
    }

    /// `Σ k x + constant` for texts of the coordinates that are left.
    pub(super) fn by(&self, i: usize, texts: &[String], constant: bool) -> String {
        let linear = &self.linear[i];
        let terms = linear.terms.iter();
        let mut all: Vec<String> = terms
            .map(|(j, k)| mul(&rational(k), &texts[self.place(*j)]))
            .collect();
        if constant {
            all.push(rational(&linear.plain));
            all.push(mul(&rational(&linear.by_pi), "pi"));
        }
        sum(all)
    }

    /// The rate of the coordinate i.
    pub(super) fn speed(&self, i: usize) -> String {
        self.by(
            i,
            &self.q.iter().map(|q| q[1].clone()).collect::<Vec<_>>(),
            false,
        )
    }

    pub(super) fn form(&self, at: &Attachment) -> Form {
        self.loops.point(at)
    }

    pub(super) fn attached(&self, point: &Point) -> Result<Form, MovingError> {
        let at = attached(&self.moving.exactly(), point).map_err(not_exact)?;
        Ok(self.form(&at))
    }

    /// The factors of an angle's rate by the coordinates that are left.
    pub(super) fn turn(&self, body: usize, from: usize) -> Vec<String> {
        let mut all = vec![Rational::new(); self.free.len()];
        for (b, sign) in [(body, 1), (from, -1)] {
            if b > 0 {
                for (j, k) in &self.linear[b - 1].terms {
                    all[self.place(*j)] += Rational::from(k * sign);
                }
            }
        }
        all.iter().map(rational).collect()
    }

    /// The angle between the frames of bodies.
    pub(super) fn between(&self, body: usize, from: usize) -> String {
        let of = |b: usize| {
            if b == 0 {
                "0".into()
            } else {
                self.value(b - 1, 0)
            }
        };
        sub(&of(body), &of(from))
    }

    /// Masses, loads and closures, and the accelerations from them.
    fn motion(&mut self) -> Result<Vec<String>, MovingError> {
        let moving = self.moving;
        let n = self.free.len();
        for (name, value) in moving.names.parameters.clone() {
            self.out.given.push((name, value));
        }
        let places: Vec<String> = self.q.iter().map(|q| q[0].clone()).collect();
        let position = self.position(&places);
        let gravity = self.gravity();
        let mut acts = Generalised {
            mass: vec![vec![Vec::new(); n]; n],
            force: vec![Vec::new(); n],
        };
        let mut has_inertia = vec![false; n];
        for body in &moving.loads.masses {
            let form = self.form(&Attachment {
                frame: frame(body.body),
                point: body.centre.clone(),
            });
            let gradient = self.gradient(&position, &form);
            let bias = self.bias(&position, &form);
            let (m, inertia) = (rational(&body.mass), rational(&body.inertia));
            let turn = self.turn(body.body, 0);
            let active = [0, 1].map(|c| mul(&m, &sub(&gravity[c], &bias[c])));
            let active = self.define_pair(active);
            for j in 0..n {
                has_inertia[j] |= body.inertia > 0 && !zero(&turn[j]);
                if let Some(g) = &gradient[j] {
                    acts.force[j].push(dot(&active, g));
                }
                for k in 0..=j {
                    if let (Some(a), Some(b)) = (&gradient[j], &gradient[k]) {
                        acts.mass[j][k].push(mul(&m, &dot(a, b)));
                    }
                    acts.mass[j][k].push(mul(&inertia, &mul(&turn[j], &turn[k])));
                }
            }
        }
        for load in moving.loads.loads.clone() {
            self.load(&load, &position, &mut acts)?;
        }
        let mut rows = Vec::new();
        let mut right = Vec::new();
        for form in self.loops.closures.clone() {
            let gradient = self.gradient(&position, &form);
            let bias = self.bias(&position, &form);
            for c in 0..2 {
                let part = |g: &Option<Vector>| g.as_ref().map_or("0".into(), |g| g[c].clone());
                rows.push(gradient.iter().map(part).collect::<Vec<String>>());
                right.push(sub("0", &bias[c]));
            }
        }
        let mut m: Vec<Vec<String>> = acts
            .mass
            .into_iter()
            .map(|row| row.into_iter().map(sum).collect())
            .collect();
        let mut f: Vec<String> = acts.force.into_iter().map(sum).collect();
        // Every coordinate an angle with inertia: M is positive definite.
        let definite = self.free.iter().all(|i| *i < self.bodies) && has_inertia.iter().all(|x| *x);
        if !definite && !rows.is_empty() {
            let total = moving
                .loads
                .masses
                .iter()
                .map(|m| m.mass.to_f64())
                .sum::<f64>();
            let w = rational(
                &Rational::from_f64(2f64.powi(total.log2().round() as i32)).unwrap_or_default(),
            );
            for (row, right) in rows.iter().zip(&right) {
                for j in 0..n {
                    f[j] = add(&f[j], &mul(&w, &mul(&row[j], right)));
                    for k in 0..=j {
                        m[j][k] = add(&m[j][k], &mul(&w, &mul(&row[j], &row[k])));
                    }
                }
            }
        }
        let accelerations = self.eliminated(m, f, &rows, &right);
        for (k, a) in accelerations.iter().enumerate() {
            self.out.states[2 * k].rate = self.q[k][1].clone();
            self.out.states[2 * k + 1].rate.clone_from(a);
        }
        Ok(accelerations)
    }

    /// The acceleration of gravity.
    pub(super) fn gravity(&self) -> Vector {
        self.moving.loads.gravity.exact().map(|g| g.formula())
    }

    /// A state that grows by a rate from zero.
    fn integral(&mut self, name: &str, rate: String) {
        self.out.states.push(State {
            name: name.into(),
            start: "0".into(),
            rate,
        });
    }

    /// States that tell whether the motion has passed its end or a table's.
    fn ends(&mut self, until: Option<String>) {
        if let Some(value) = until {
            self.integral(UNTIL, format!("copysign(1, {value})"));
        }
        let loads = self.moving.loads.loads.clone();
        for load in &loads {
            if let MovingLoad::Motor {
                body,
                from,
                formulas,
            } = load
                && let Some(outside) = &formulas.outside
            {
                let speed = self.turning(*body, *from);
                self.integral(OUTSIDE, outside.replace("speed", &speed));
            }
        }
    }

    /// The angle of the driven body's line, less that of the body that it is measured from, with
    /// its derivatives.
    fn drive(&self, accelerations: &[String]) -> Result<[String; 3], MovingError> {
        let Drive::Angle { body, from } = self.moving.description.drive else {
            return Err(not_exact("a run-up needs a drive by angle"));
        };
        let of = |b: usize| -> [String; 3] {
            match b.checked_sub(1) {
                None => ["0", "0", "0"].map(String::from),
                Some(i) => [
                    add(&self.value(i, 0), &self.line(b)),
                    self.speed(i),
                    self.by(i, accelerations, false),
                ],
            }
        };
        let (own, other) = (of(body), of(from));
        Ok([0, 1, 2].map(|k| sub(&own[k], &other[k])))
    }
}
