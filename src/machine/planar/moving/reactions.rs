//! Forces in the joints as formulas, by the laws of Newton and Euler for every body.
//!
//! With the components r of all joints' forces, every body's forces add up to `m (S'' − g)` and
//! their moments about the ground's origin to `S × m (S'' − g) + J ψ''`, loads among them: `A r =
//! b`. As many equations are left over as there are degrees of freedom, and the accelerations of a
//! motion satisfy them: the solution is that of `Aᵀ A r = Aᵀ b`, whose matrix is positive definite
//! where the forces are determined.

use super::super::exact::{ExactJoint, frame};
use super::equations::{Writer, not_exact};
use super::places::Position;
use super::pushes::Acts;
use super::text::{Vector, add, mul, rational, sub, sum};
use super::{MovingError, forces};
use crate::reference::planar::Attachment;
use crate::solvers::planar::{Joint, Point};

/// Components of forces, and the moment about the ground's origin.
type Wrench = [String; 3];

/// The forces and moments that joints have to exert on every body, the ground first.
struct Due<'a> {
    on: Vec<[Vec<String>; 3]>,
    accelerations: &'a [String],
}

/// A unit force along a vector at a place.
fn wrench(place: &Vector, force: &Vector) -> Wrench {
    let moment = sub(&mul(&place[0], &force[1]), &mul(&place[1], &force[0]));
    [force[0].clone(), force[1].clone(), moment]
}

impl Due<'_> {
    fn add(&mut self, body: usize, wrench: Wrench) {
        let sums = self.on[body].iter_mut();
        sums.zip(wrench).for_each(|(sum, part)| sum.push(part));
    }

    /// Adds a couple that joints have to bear.
    fn couple(&mut self, body: usize, from: usize, moment: &str) {
        self.on[body][2].push(moment.into());
        self.on[from][2].push(sub("0", moment));
    }
}

impl Acts for Due<'_> {
    fn push(
        &mut self,
        writer: &mut Writer,
        at: &Point,
        position: &Position,
        force: &Vector,
    ) -> Result<(), MovingError> {
        let form = writer.attached(at)?;
        let place = writer.point(position, &form);
        let back = writer.define_pair(force.each_ref().map(|x| sub("0", x)));
        self.add(at.body, wrench(&place, &back));
        Ok(())
    }

    fn turn(&mut self, _: &mut Writer, body: usize, from: usize, torque: String) {
        self.couple(body, from, &sub("0", &torque));
    }

    fn rotor(&mut self, writer: &mut Writer, body: usize, from: usize, inertia: &str) {
        let of = |b: usize| match b.checked_sub(1) {
            Some(i) => writer.by(i, self.accelerations, false),
            None => "0".into(),
        };
        let turn = sub(&of(body), &of(from));
        let moment = writer.define(mul(inertia, &turn));
        self.couple(body, from, &moment);
    }
}

/// A component of a joint's force on one body, and its reaction on another.
struct Unknown {
    bodies: [usize; 2],
    wrench: Wrench,
}

impl Writer<'_> {
    /// Adds the forces in the joints to the quantities of a row, in the order of [`forces`].
    pub(super) fn reactions(&mut self, accelerations: &[String]) -> Result<(), MovingError> {
        let places: Vec<String> = self.q.iter().map(|q| q[0].clone()).collect();
        let position = self.position(&places);
        let due = self.due(&position, accelerations)?;
        let (unknowns, shown) = self.unknowns(&position)?;
        // The rows of A, body by body.
        let mut rows = Vec::new();
        let mut right = Vec::new();
        for (body, due) in due.into_iter().enumerate().skip(1) {
            for (c, due) in due.into_iter().enumerate() {
                let entry = |u: &Unknown| match u.bodies.iter().position(|b| *b == body) {
                    Some(0) => u.wrench[c].clone(),
                    Some(_) => sub("0", &u.wrench[c]),
                    None => "0".into(),
                };
                let row: Vec<String> = unknowns.iter().map(entry).collect();
                rows.push(row.into_iter().map(|x| self.define(x)).collect::<Vec<_>>());
                right.push(self.define(sum(due)));
            }
        }
        let column = |k: usize| rows.iter().map(move |row| row[k].clone());
        let product = |a: usize, b: Vec<String>| sum(column(a).zip(b).map(|(x, y)| mul(&x, &y)));
        let n = unknowns.len();
        let matrix = (0..n)
            .map(|i| (0..=i).map(|j| product(i, column(j).collect())).collect())
            .collect();
        let right = (0..n).map(|i| product(i, right.clone())).collect();
        let solution = self.solved(matrix, right);
        for (k, along) in shown {
            let force = match along {
                Some(along) => mul(&solution[k], &along),
                None => solution[k].clone(),
            };
            let force = self.define(force);
            self.out.outputs.push(force);
        }
        Ok(())
    }

    /// Inertia less loads.
    fn due(
        &mut self,
        position: &Position,
        accelerations: &[String],
    ) -> Result<Vec<[Vec<String>; 3]>, MovingError> {
        let moving = self.moving;
        let mut due = Due {
            on: vec![Default::default(); self.bodies + 1],
            accelerations,
        };
        let gravity = self.gravity();
        for body in &moving.loads.masses {
            let form = self.form(&Attachment {
                frame: frame(body.body),
                point: body.centre.clone(),
            });
            let place = self.point(position, &form);
            let gradient = self.gradient(position, &form);
            let bias = self.bias(position, &form);
            let by_rates = self.velocity(&gradient, accelerations);
            let m = rational(&body.mass);
            let force = [0, 1].map(|c| mul(&m, &sub(&add(&by_rates[c], &bias[c]), &gravity[c])));
            let force = self.define_pair(force);
            due.add(body.body, wrench(&place, &force));
            let turn = self.by(body.body - 1, accelerations, false);
            due.on[body.body][2].push(mul(&rational(&body.inertia), &turn));
        }
        for load in moving.loads.loads.clone() {
            self.load(&load, position, &mut due)?;
        }
        Ok(due.on)
    }

    /// The components of all joints' forces, and what is shown of them: a component itself, or
    /// along an axis.
    #[allow(clippy::type_complexity)]
    fn unknowns(
        &mut self,
        position: &Position,
    ) -> Result<(Vec<Unknown>, Vec<(usize, Option<String>)>), MovingError> {
        let moving = self.moving;
        let (mut all, mut shown): (Vec<Unknown>, Vec<_>) = (Vec::new(), Vec::new());
        for (joint, body, moment) in forces(&moving.description)? {
            let (point, on) = match &moving.description.joints[joint].part {
                Joint::Pin { points } => (points[0], points[0].body),
                Joint::Slide { slider, guide, .. } => (*slider, guide.origin.body),
                Joint::Slot { pin, slot } => (*pin, slot.origin.body),
                Joint::Gears { .. } | Joint::Rack { .. } => continue,
            };
            let form = self.attached(&point)?;
            let place = self.point(position, &form);
            let bodies = [body, on];
            let axes = [["1", "0"], ["0", "1"]].map(|axis| axis.map(String::from));
            let Some(ExactJoint::Guided { direction, .. }) = &moving.joints[joint] else {
                for axis in axes {
                    shown.push((all.len(), None));
                    let wrench = wrench(&place, &axis);
                    all.push(Unknown { bodies, wrench });
                }
                continue;
            };
            let [x, y] = self.turned(position, direction, on.checked_sub(1));
            let normal = self.define_pair([sub("0", &y), x]);
            shown.extend(normal.iter().map(|n| (all.len(), Some(n.clone()))));
            let wrench = wrench(&place, &normal);
            all.push(Unknown { bodies, wrench });
            if moment {
                shown.push((all.len(), None));
                let wrench = ["0", "0", "1"].map(String::from);
                all.push(Unknown { bodies, wrench });
            }
        }
        match all.len() <= 3 * self.bodies {
            true => Ok((all, shown)),
            false => Err(not_exact("the forces in the joints are not determined")),
        }
    }
}
