//! The equations of motion as formulas: an initial value problem.
//!
//! Coordinates q are the angles of the bodies and the displacements of slides that are left after
//! linear relations. Every point is a sum of terms `z s u` with `u = e^{iψ}`, so its derivatives by q
//! are too. With the closures g(q) = 0 and `G = ∂g/∂q`,
//!
//! ```text
//! M q̈ + Gᵀ λ = f,   G q̈ = γ
//! ```
//!
//! Where a coordinate may have no inertia of its own, `w Gᵀ G` is added to M and `w Gᵀ γ` to f, with
//! the same q̈ and λ: what is eliminated then is positive definite at every position where the
//! motion is determined, so that no pivot vanishes and none has to be exchanged on the way. `M = L D
//! Lᵀ`; then `Gᵀ` is eliminated from the second block, whose Schur complement `G M⁻¹ Gᵀ` is positive
//! definite too.
//!
//! A solution that begins with g = 0 and ġ = 0 keeps both, so that loops are closed by what is
//! solved and not by a correction. The start is the enclosed solution of g = 0 with the coordinates
//! given.

use super::super::exact::{attached, frame, reference_joints};
use super::laws::{INNER, Names};
use super::linear::{Linear, reduced};
use super::loads::ExactLoad;
use super::{Moving, MovingError};
use crate::reference::class_iii::ExactAngle;
use crate::reference::planar::{Attachment, Body, Form, Loops, Real};
use crate::solvers::planar::Point;
use crate::solvers::planar::dynamics::{Coordinate, Moment, Settings};
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

fn zero(a: &str) -> bool {
    a == "0"
}

fn rational(q: &Rational) -> String {
    Real::from(q.clone()).formula()
}

fn add(a: &str, b: &str) -> String {
    match (zero(a), zero(b)) {
        (true, _) => b.into(),
        (_, true) => a.into(),
        _ => format!("({a} + {b})"),
    }
}

fn sub(a: &str, b: &str) -> String {
    match (zero(a), zero(b)) {
        (_, true) => a.into(),
        (true, _) => format!("(-{b})"),
        _ => format!("({a} - {b})"),
    }
}

fn mul(a: &str, b: &str) -> String {
    match (a, b) {
        ("0", _) | (_, "0") => "0".into(),
        ("1", x) | (x, "1") => x.into(),
        _ => format!("{a}*{b}"),
    }
}

fn sum(parts: impl IntoIterator<Item = String>) -> String {
    let parts: Vec<String> = parts.into_iter().filter(|p| !zero(p)).collect();
    match &parts[..] {
        [] => "0".into(),
        [one] => one.clone(),
        _ => format!("({})", parts.join(" + ")),
    }
}

fn dot(a: &[String; 2], b: &[String; 2]) -> String {
    sum([mul(&a[0], &b[0]), mul(&a[1], &b[1])])
}

fn angle(a: &ExactAngle) -> String {
    match a {
        ExactAngle::Radians(q) => rational(q),
        ExactAngle::Degrees(q) => mul(&rational(&Rational::from(q / 180u32)), "pi"),
    }
}

/// A vector of formulas.
type Vector = [String; 2];

/// Directions and displacements at a position.
struct Position {
    /// Cosine and sine of each body's angle.
    units: Vec<Vector>,
    /// Each displacement.
    slides: Vec<String>,
}

struct Writer<'a> {
    moving: &'a Moving,
    names: &'a Names,
    loops: Loops,
    bodies: usize,
    /// All coordinates by those that are left.
    linear: Vec<Linear>,
    /// The coordinates that are left.
    free: Vec<usize>,
    /// Names of these coordinates and of their rates.
    q: Vec<[String; 2]>,
    out: Equations,
    /// Definitions by their texts.
    known: HashMap<String, String>,
}

fn not_exact(e: impl std::fmt::Display) -> MovingError {
    MovingError::NotExact(e.to_string())
}

impl Moving {
    /// The equations of motion as formulas.
    ///
    /// # Errors
    /// [`MovingError`]: no start, numbers that are not exact, relations that repeat one another.
    pub fn equations(&self) -> Result<Equations, MovingError> {
        let mut first = None;
        let start = self.assembly()?;
        self.dynamics.motion(&start, &[0.0], Settings::default(), |m| {
            first = Some(m.clone());
            true
        })?;
        let first = first.ok_or_else(|| not_exact("there is no start"))?;
        let joints = reference_joints(&self.exactly()).map_err(not_exact)?;
        let bodies: Vec<Body> = self.bodies[1..].iter().map(|n| Body::massless(n)).collect();
        let loops = Loops::close(&bodies, &joints).map_err(not_exact)?;
        let keep: Vec<usize> = self.start.given.iter().map(|g| self.index(g.coordinate)).collect();
        let linear = reduced(loops.coordinates, &loops.relations, &keep);
        let linear = linear.ok_or_else(|| {
            not_exact("slides, gears or racks repeat or contradict one another")
        })?;
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
        writer.motion()?;
        Ok(writer.out)
    }

    /// The number of a coordinate in the exact description.
    fn index(&self, coordinate: Coordinate) -> usize {
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
    fn define(&mut self, text: String) -> String {
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

    fn define_pair(&mut self, [x, y]: Vector) -> Vector {
        [self.define(x), self.define(y)]
    }

    /// The angle of a body's line in its frame.
    fn line(&self, body: usize) -> String {
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
    fn name(&mut self) {
        let travels = self.moving.travels();
        let names = self.names;
        let names_of = |i: usize| match i < self.bodies {
            true => names.of_body(i + 1).clone(),
            false => names.of_joint(travels[i - self.bodies].0).clone(),
        };
        let lined = |i: usize| i < self.bodies && self.moving.lines[i + 1] != 0.0;
        let state = |i: usize| {
            let [place, rate] = names_of(i);
            let place = if lined(i) { format!("{INNER}of_{place}") } else { place };
            [place, rate]
        };
        self.q = self.free.iter().map(|i| state(*i)).collect();
        for i in 0..self.loops.coordinates {
            let [place, rate] = names_of(i);
            let value = self.value(i, 0);
            let line = if i < self.bodies { self.line(i + 1) } else { "0".into() };
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
    fn place(&self, index: usize) -> usize {
        let place = self.free.iter().position(|f| *f == index);
        place.unwrap_or_default()
    }

    /// The coordinate i by those that are left, whose names are the k-th of each pair.
    fn value(&self, i: usize, k: usize) -> String {
        self.by(i, &self.q.iter().map(|q| q[k].clone()).collect::<Vec<_>>(), true)
    }

    /// `Σ k x + constant` for texts of the coordinates that are left.
    fn by(&self, i: usize, texts: &[String], constant: bool) -> String {
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
    fn speed(&self, i: usize) -> String {
        self.by(i, &self.q.iter().map(|q| q[1].clone()).collect::<Vec<_>>(), false)
    }

    /// Directions and displacements where the coordinates that are left have these texts.
    fn position(&mut self, texts: &[String]) -> Position {
        let mut units = Vec::new();
        for i in 0..self.bodies {
            let linear = &self.linear[i];
            let fixed = linear.terms.is_empty() && linear.plain.is_zero();
            units.push(match fixed {
                true => {
                    let degrees = Rational::from(&linear.by_pi * Rational::from(180));
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
    fn turned(&mut self, position: &Position, z: &[Real; 2], body: Option<usize>) -> Vector {
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

    fn slide(&self, position: &Position, slide: Option<usize>) -> String {
        slide.map_or("1".into(), |i| position.slides[i - self.bodies].clone())
    }

    /// A point.
    fn point(&mut self, position: &Position, form: &Form) -> Vector {
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
    fn gradient(&mut self, position: &Position, form: &Form) -> Vec<Option<Vector>> {
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
    fn velocity(&mut self, gradient: &[Option<Vector>], rates: &[String]) -> Vector {
        let part = |c: usize| {
            let pairs = gradient.iter().zip(rates);
            sum(pairs.filter_map(|(g, r)| Some(mul(&g.as_ref()?[c], r))))
        };
        let v = [part(0), part(1)];
        self.define_pair(v)
    }

    /// The part of its acceleration without second derivatives of coordinates.
    fn bias(&mut self, position: &Position, form: &Form) -> Vector {
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

    /// The start: coordinates and rates that are given, and equations for the others.
    fn start(&mut self, first: &Moment) {
        let moving = self.moving;
        let (n, bodies, travels) = (self.free.len(), self.bodies, moving.travels());
        let near = |i: usize| match i < bodies {
            true => {
                let [angle, rate, _] = moving.dynamics.angle(first, i + 1);
                [angle, rate]
            }
            false => moving.dynamics.displacement(first, travels[i - bodies].0),
        };
        let mut given: Vec<Option<[String; 2]>> = vec![None; n];
        let mut others = Vec::new();
        for g in &moving.start.given {
            let i = moving.index(g.coordinate);
            let (from, lines) = match g.coordinate {
                Coordinate::Angle { body, from } => {
                    (from, sub(&self.line(from), &self.line(body)))
                }
                Coordinate::Displacement { .. } => (0, "0".into()),
            };
            let value = add(&angle(&g.value), &lines);
            let speed = angle(&g.speed);
            match self.free.iter().position(|f| *f == i) {
                Some(k) if from == 0 && given[k].is_none() => given[k] = Some([value, speed]),
                _ => others.push((i, from, value, speed)),
            }
        }
        let mut texts: Vec<[String; 2]> = Vec::new();
        for (k, given) in given.into_iter().enumerate() {
            texts.push(given.unwrap_or_else(|| {
                let near = near(self.free[k]);
                [0, 1].map(|c| {
                    let name = format!("{INNER}start_{}", self.q[k][c]);
                    self.out.unknowns.push((name.clone(), near[c]));
                    name
                })
            }));
        }
        let places: Vec<String> = texts.iter().map(|t| t[0].clone()).collect();
        let rates: Vec<String> = texts.iter().map(|t| t[1].clone()).collect();
        let position = self.position(&places);
        for form in self.loops.closures.clone() {
            let point = self.point(&position, &form);
            let gradient = self.gradient(&position, &form);
            let velocity = self.velocity(&gradient, &rates);
            self.out.equations.extend(point);
            self.out.equations.extend(velocity);
        }
        for (i, from, value, speed) in others {
            let near_from = if from == 0 { 0.0 } else { near(from - 1)[0] };
            // The angle that is given counts no turns.
            let given = moving.start.given.iter().find(|g| moving.index(g.coordinate) == i);
            let wanted = given.map_or(0.0, |g| super::start::radians(&g.value));
            let lines = if i < self.bodies { moving.lines[i + 1] - moving.lines[from] } else { 0.0 };
            let turns = match i < self.bodies {
                true => {
                    let off = near(i)[0] - near_from - (wanted - lines);
                    (off / std::f64::consts::TAU).round() as i64
                }
                false => 0,
            };
            let turned = mul(&rational(&Rational::from(2 * turns)), "pi");
            let of = |w: &Self, texts: &[String], constant: bool| {
                let own = w.by(i, texts, constant);
                match from {
                    0 => own,
                    from => sub(&own, &w.by(from - 1, texts, constant)),
                }
            };
            let place = sub(&of(self, &places, true), &add(&value, &turned));
            let rate = sub(&of(self, &rates, false), &speed);
            self.out.equations.extend([place, rate]);
        }
        for (q, [place, rate]) in self.q.iter().zip(texts) {
            for (name, start) in q.iter().zip([place, rate]) {
                self.out.states.push(State {
                    name: name.clone(),
                    start,
                    rate: String::new(),
                });
            }
        }
    }

    fn form(&self, at: &Attachment) -> Form {
        self.loops.point(at)
    }

    fn attached(&self, point: &Point) -> Result<Form, MovingError> {
        let at = attached(&self.moving.exactly(), point).map_err(not_exact)?;
        Ok(self.form(&at))
    }

    /// The factors of an angle's rate by the coordinates that are left.
    fn turn(&self, body: usize, from: usize) -> Vec<String> {
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
    fn between(&self, body: usize, from: usize) -> String {
        let of = |b: usize| if b == 0 { "0".into() } else { self.value(b - 1, 0) };
        sub(&of(body), &of(from))
    }

    /// Masses, loads and closures, and the accelerations from them.
    fn motion(&mut self) -> Result<(), MovingError> {
        let moving = self.moving;
        let n = self.free.len();
        for (name, value) in moving.names.parameters.clone() {
            self.out.given.push((name, value));
        }
        let places: Vec<String> = self.q.iter().map(|q| q[0].clone()).collect();
        let rates: Vec<String> = self.q.iter().map(|q| q[1].clone()).collect();
        let position = self.position(&places);
        let gravity = moving.loads.gravity.each_ref().map(|g| g.formula());
        let mut mass = vec![vec![Vec::new(); n]; n];
        let mut force = vec![Vec::new(); n];
        let mut has_inertia = vec![false; n];
        for body in &moving.loads.masses {
            let at = Attachment {
                frame: frame(body.body),
                point: body.centre.clone().map(Real::from),
            };
            let form = self.form(&at);
            let gradient = self.gradient(&position, &form);
            let bias = self.bias(&position, &form);
            let (m, inertia) = (rational(&body.mass), rational(&body.inertia));
            let turn = self.turn(body.body, 0);
            let active = [0, 1].map(|c| mul(&m, &sub(&gravity[c], &bias[c])));
            let active = self.define_pair(active);
            for j in 0..n {
                has_inertia[j] |= body.inertia > 0 && !zero(&turn[j]);
                if let Some(g) = &gradient[j] {
                    force[j].push(dot(&active, g));
                }
                for k in 0..=j {
                    if let (Some(a), Some(b)) = (&gradient[j], &gradient[k]) {
                        mass[j][k].push(mul(&m, &dot(a, b)));
                    }
                    mass[j][k].push(mul(&inertia, &mul(&turn[j], &turn[k])));
                }
            }
        }
        for load in moving.loads.loads.clone() {
            self.load(&load, &position, &rates, (&mut mass, &mut force))?;
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
        let mut m: Vec<Vec<String>> = mass
            .into_iter()
            .map(|row| row.into_iter().map(sum).collect())
            .collect();
        let mut f: Vec<String> = force.into_iter().map(sum).collect();
        // Every coordinate an angle with inertia: M is positive definite.
        let definite = self.free.iter().all(|i| *i < self.bodies) && has_inertia.iter().all(|x| *x);
        if !definite && !rows.is_empty() {
            let total = moving.loads.masses.iter().map(|m| m.mass.to_f64()).sum::<f64>();
            let w = rational(&Rational::from_f64(2f64.powi(total.log2().round() as i32)).unwrap_or_default());
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
        for (k, a) in accelerations.into_iter().enumerate() {
            self.out.states[2 * k].rate = self.q[k][1].clone();
            self.out.states[2 * k + 1].rate = a;
        }
        Ok(())
    }

    /// Adds a load's generalised forces.
    fn load(
        &mut self,
        load: &ExactLoad,
        position: &Position,
        rates: &[String],
        (mass, force): (&mut [Vec<Vec<String>>], &mut [Vec<String>]),
    ) -> Result<(), MovingError> {
        let torque = |w: &mut Self, force: &mut [Vec<String>], body, from, torque: String| {
            let torque = w.define(torque);
            for (f, k) in force.iter_mut().zip(w.turn(body, from)) {
                f.push(mul(&k, &torque));
            }
        };
        let speed = |w: &Self, body, from| {
            sum(w.turn(body, from).iter().zip(rates).map(|(k, r)| mul(k, r)))
        };
        match load {
            ExactLoad::Torque { body, from, torque: t } => {
                torque(self, force, *body, *from, rational(t));
            }
            ExactLoad::TorqueLaw { body, from, torque: t } => {
                let name = self.law(t);
                torque(self, force, *body, *from, name);
            }
            ExactLoad::Motor { body, from, torque: t } => {
                let speed = speed(self, *body, *from);
                let speed = self.define(speed);
                torque(self, force, *body, *from, format!("({})", t.replace("speed", &speed)));
            }
            ExactLoad::TorsionDamper { body, from, damping } => {
                let speed = speed(self, *body, *from);
                torque(self, force, *body, *from, sub("0", &mul(&rational(damping), &speed)));
            }
            ExactLoad::TorsionSpring { body, from, stiffness, angle: rest } => {
                let lines = sub(&self.line(*body), &self.line(*from));
                let turn = sub(&add(&self.between(*body, *from), &lines), &angle(rest));
                torque(self, force, *body, *from, sub("0", &mul(&rational(stiffness), &turn)));
            }
            ExactLoad::Inertia { body, from, inertia } => {
                let turn = self.turn(*body, *from);
                for j in 0..turn.len() {
                    for k in 0..=j {
                        mass[j][k].push(mul(inertia, &mul(&turn[j], &turn[k])));
                    }
                }
            }
            ExactLoad::Force { at, components, along } => {
                let v = self.turned(position, components, along.checked_sub(1));
                self.push(at, position, &v, force)?;
            }
            ExactLoad::ForceLaw { at, components } => {
                let v = components.each_ref().map(|c| self.law(c));
                self.push(at, position, &v, force)?;
            }
            ExactLoad::Spring { ends, .. } | ExactLoad::Damper { ends, .. } => {
                let [a, b] = [self.attached(&ends[0])?, self.attached(&ends[1])?];
                let (p, q) = (self.point(position, &a), self.point(position, &b));
                let (ga, gb) = (self.gradient(position, &a), self.gradient(position, &b));
                let along = self.define_pair([0, 1].map(|c| sub(&q[c], &p[c])));
                let none = || ["0".to_string(), "0".to_string()];
                let mut apart = Vec::new();
                for (a, b) in ga.into_iter().zip(gb) {
                    let (a, b) = (a.unwrap_or_else(none), b.unwrap_or_else(none));
                    let d = [0, 1].map(|c| sub(&b[c], &a[c]));
                    apart.push(self.define(dot(&along, &d)));
                }
                let square = self.define(dot(&along, &along));
                // Tension over length.
                let tension = match load {
                    ExactLoad::Spring { stiffness, length, .. } if length.is_zero() => rational(stiffness),
                    ExactLoad::Spring { stiffness, length, .. } => {
                        format!("{}*(1 - {}/sqrt({square}))", rational(stiffness), rational(length))
                    }
                    ExactLoad::Damper { damping, .. } => {
                        let rate = sum(apart.iter().zip(rates).map(|(d, r)| mul(d, r)));
                        format!("{}*({rate})/{square}", rational(damping))
                    }
                    _ => "0".into(),
                };
                let tension = self.define(format!("({tension})"));
                for (f, d) in force.iter_mut().zip(apart) {
                    f.push(sub("0", &mul(&tension, &d)));
                }
            }
        }
        Ok(())
    }

    /// The name of a formula of the file.
    fn law(&mut self, formula: &Expr) -> String {
        let name = format!("{INNER}law_{}", self.out.given.len());
        self.out.given.push((name.clone(), formula.clone()));
        name
    }

    fn push(
        &mut self,
        at: &Point,
        position: &Position,
        v: &Vector,
        force: &mut [Vec<String>],
    ) -> Result<(), MovingError> {
        let form = self.attached(at)?;
        let gradient = self.gradient(position, &form);
        for (f, g) in force.iter_mut().zip(gradient) {
            if let Some(g) = g {
                f.push(dot(v, &g));
            }
        }
        Ok(())
    }

    /// `q̈` from the lower half of M, f, G and γ.
    fn eliminated(
        &mut self,
        m: Vec<Vec<String>>,
        f: Vec<String>,
        rows: &[Vec<String>],
        right: &[String],
    ) -> Vec<String> {
        let (l, d) = self.factored(m);
        let y = self.forward(&l, &f);
        let z: Vec<Vec<String>> = rows.iter().map(|row| self.forward(&l, row)).collect();
        let over = |w: &mut Self, v: &[String]| -> Vec<String> {
            let pairs = v.iter().zip(&d);
            let quotients: Vec<String> = pairs
                .map(|(x, d)| if zero(x) { "0".into() } else { format!("{x}/{d}") })
                .collect();
            quotients.into_iter().map(|q| w.define(q)).collect()
        };
        let scaled: Vec<Vec<String>> = z.iter().map(|z| over(self, z)).collect();
        let product = |a: &[String], b: &[String]| sum(a.iter().zip(b).map(|(a, b)| mul(a, b)));
        let mut multipliers = Vec::new();
        if !rows.is_empty() {
            let schur = (0..rows.len())
                .map(|i| (0..=i).map(|j| product(&scaled[i], &z[j])).collect())
                .collect();
            let due = (0..rows.len()).map(|i| sub(&product(&scaled[i], &y), &right[i]));
            let due: Vec<String> = due.collect();
            let (l, d) = self.factored(schur);
            let v = self.forward(&l, &due);
            let v: Vec<String> = v
                .iter()
                .zip(&d)
                .map(|(x, d)| if zero(x) { "0".into() } else { format!("{x}/{d}") })
                .collect();
            multipliers = self.backward(&l, &v);
        }
        let mut rest = Vec::new();
        for (j, y) in y.iter().enumerate() {
            let held = sum(z.iter().zip(&multipliers).map(|(z, k)| mul(&z[j], k)));
            let due = sub(y, &held);
            rest.push(match zero(&due) {
                true => "0".into(),
                false => format!("{due}/{}", d[j]),
            });
        }
        self.backward(&l, &rest)
    }

    /// `A = L D Lᵀ` from the lower half of a positive definite matrix.
    fn factored(&mut self, a: Vec<Vec<String>>) -> (Vec<Vec<String>>, Vec<String>) {
        let n = a.len();
        let mut l = vec![vec!["0".to_string(); n]; n];
        let mut d: Vec<String> = Vec::new();
        // The products L D.
        let mut ld = vec![vec!["0".to_string(); n]; n];
        for i in 0..n {
            for j in 0..=i {
                let taken = sum((0..j).map(|k| mul(&ld[i][k], &l[j][k])));
                let value = self.define(sub(&a[i][j], &taken));
                if i == j {
                    d.push(value);
                } else if !zero(&value) {
                    l[i][j] = self.define(format!("{value}/{}", d[j]));
                    ld[i][j] = value;
                }
            }
        }
        (l, d)
    }

    /// `L x = b`.
    fn forward(&mut self, l: &[Vec<String>], b: &[String]) -> Vec<String> {
        let mut x: Vec<String> = Vec::new();
        for (i, b) in b.iter().enumerate() {
            let taken = sum((0..i).map(|k| mul(&l[i][k], &x[k])));
            x.push(self.define(sub(b, &taken)));
        }
        x
    }

    /// `Lᵀ x = b`.
    fn backward(&mut self, l: &[Vec<String>], b: &[String]) -> Vec<String> {
        let n = b.len();
        let mut x = vec!["0".to_string(); n];
        for i in (0..n).rev() {
            let taken = sum((i + 1..n).map(|k| mul(&l[k][i], &x[k])));
            x[i] = self.define(sub(&b[i], &taken));
        }
        x
    }
}

