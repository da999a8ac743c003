//! Forces and torques as formulas of time, positions and speeds.

use super::super::bodies::{Bodies, check_name};
use super::super::file::File;
use super::travels;
use crate::machine::source::{Refusal, Source};
use crate::solvers::planar::Description;
use crate::solvers::planar::dynamics::{Instant, Law};
use mechaudit_symbolic::evaluation::{Evaluator, Floating};
use mechaudit_symbolic::graph::{Graph, Id};
use mechaudit_symbolic::{Definitions, Expr, SymbolicError, parse_declared};
use std::cell::RefCell;
use std::sync::Arc;

/// The time in formulas.
pub(super) const TIME: &str = "t";
/// Names of intermediate results begin with this.
pub(super) const INNER: &str = "aux_";

/// The names of positions and speeds in formulas.
#[derive(Clone, Debug)]
pub(super) struct Names {
    /// For each body its angle and rate; the ground's are not used.
    bodies: Vec<[String; 2]>,
    /// For each slide and slot its displacement and rate.
    joints: Vec<(usize, [String; 2])>,
    /// The angle of each body's line in its frame.
    lines: Vec<f64>,
    /// Parameters by name.
    pub parameters: Vec<(String, Expr)>,
}

/// The formulas of `[[motion.torque]]`, and of x and y of `[[motion.force]]`.
#[derive(Clone, Debug, Default)]
pub(super) struct Laws {
    pub torques: Vec<Expr>,
    pub forces: Vec<[Expr; 2]>,
}

/// A name with letters, digits and underscores alone.
fn plain(name: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    name.chars().map(letter).collect()
}

impl Names {
    pub(super) fn new(
        source: &Source,
        file: &File,
        bodies: &Bodies,
        description: &Description,
    ) -> Result<Names, Refusal> {
        let mut taken: Vec<String> = vec![TIME.into()];
        let mut pair = |[a, b]: [&str; 2], name: &str| {
            let mut number = 1;
            loop {
                let end = if number == 1 {
                    String::new()
                } else {
                    format!("_{number}")
                };
                let names = [a, b].map(|x| format!("{x}_{}{end}", plain(name)));
                if !names.iter().any(|n| taken.contains(n)) {
                    taken.extend(names.clone());
                    return names;
                }
                number += 1;
            }
        };
        let all = bodies
            .names
            .iter()
            .map(|b| pair(["theta", "omega"], b))
            .collect();
        let slides = travels(description).into_iter();
        let joints = slides
            .map(|(k, name)| (k, pair(["s", "v"], name)))
            .collect();
        let mut names = Names {
            bodies: all,
            joints,
            lines: bodies.lines.clone(),
            parameters: Vec::new(),
        };
        let given = file.motion.as_ref().map(|m| &m.parameters);
        for (name, text) in given.into_iter().flatten() {
            let place = format!("motion.parameters.{name}");
            check_name(source, "motion.parameters", name)?;
            if taken.contains(name) || name.starts_with(INNER) || plain(name) != *name {
                let rule = format!("{place}: the name {name:?} is taken or no name of a formula");
                return Err(source.breach(&place, rule));
            }
            let expr = names.formula(source, &place, text)?;
            names.parameters.push((name.clone(), expr));
        }
        Ok(names)
    }

    pub(super) fn of_body(&self, body: usize) -> &[String; 2] {
        &self.bodies[body]
    }

    pub(super) fn of_joint(&self, joint: usize) -> &[String; 2] {
        let of = self.joints.iter().find(|j| j.0 == joint);
        &of.expect("a slide or slot").1
    }

    /// All names with the time first, in the order of [`Names::values`].
    fn all(&self) -> Vec<String> {
        let bodies = self.bodies[1..].iter().flatten();
        let joints = self.joints.iter().flat_map(|j| &j.1);
        let time = std::iter::once(TIME.to_string());
        time.chain(bodies.chain(joints).cloned()).collect()
    }

    fn values(&self, instant: &Instant) -> Vec<f64> {
        let mut all = vec![instant.time];
        for body in 1..self.bodies.len() {
            let [angle, rate] = instant.angle(body);
            all.extend([angle + self.lines[body], rate]);
        }
        for (joint, _) in &self.joints {
            all.extend(instant.displacement(*joint));
        }
        all
    }

    /// Reads a formula and checks its names.
    pub(super) fn formula(&self, source: &Source, at: &str, text: &str) -> Result<Expr, Refusal> {
        let wrong = |rule: String| source.breach(at, format!("{at} = {text:?}: {rule}"));
        let mut names: Vec<String> = self.all();
        names.extend(self.parameters.iter().map(|p| p.0.clone()));
        let expr = parse_declared(text, &|name| names.iter().any(|n| n == name));
        let built = expr.and_then(|expr| Ok((self.build(&expr)?, expr)));
        let ((graph, id), expr) = built.map_err(|e| match e {
            SymbolicError::Parse { .. } => wrong(e.to_string()),
            _ => wrong(format!("{e}; the names are {}", names.join(", "))),
        })?;
        if graph.is_complex(id) || graph.is_condition(id) {
            return Err(wrong("it is not a real number".into()));
        }
        Ok(expr)
    }

    fn build(&self, expr: &Expr) -> Result<(Graph, Id), SymbolicError> {
        let mut definitions = Definitions::default();
        for (name, value) in &self.parameters {
            definitions.set(name, value.clone());
        }
        let mut graph = Graph::new(self.all());
        let id = graph.build(&definitions, expr)?;
        Ok((graph, id))
    }

    /// All formulas of forces and torques.
    pub(super) fn laws(&self, source: &Source, file: &File) -> Result<Laws, Refusal> {
        let mut laws = Laws::default();
        let Some(motion) = &file.motion else {
            return Ok(laws);
        };
        for (k, torque) in motion.torque.iter().enumerate() {
            let at = format!("motion.torque[{k}].formula");
            laws.torques
                .push(self.formula(source, &at, &torque.formula)?);
        }
        for (k, force) in motion.force.iter().enumerate() {
            let part = |key: &str, text: &Option<String>| {
                let at = format!("motion.force[{k}].{key}");
                self.formula(source, &at, text.as_deref().unwrap_or("0"))
            };
            if force.x.is_none() && force.y.is_none() {
                let at = format!("motion.force[{k}]");
                return Err(source.breach(&at, format!("{at} needs x or y, formulas in N")));
            }
            laws.forces
                .push([part("x", &force.x)?, part("y", &force.y)?]);
        }
        Ok(laws)
    }

    /// A formula in `f64`; NaN where it has no value.
    pub(super) fn law(&self, expr: &Expr) -> Law {
        let Ok((graph, id)) = self.build(expr) else {
            return Box::new(|_| f64::NAN);
        };
        let names = self.clone();
        let evaluator = RefCell::new(Evaluator::new(Arc::new(graph), Floating::default()));
        Box::new(move |instant| {
            let mut evaluator = evaluator.borrow_mut();
            evaluator.reset(false);
            for (k, value) in names.values(instant).into_iter().enumerate() {
                evaluator.set_input(k, value.into());
            }
            let value = evaluator.value(id).ok().and_then(|x| x.real());
            value.unwrap_or(f64::NAN)
        })
    }
}
