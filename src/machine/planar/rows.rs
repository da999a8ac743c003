//! The columns of a mechanism's rows, and a row in floating point.

use super::Machine;
use super::branch::wrapped;
use crate::solvers::planar::{Description, GroupKind, Joint, Loads, State, curvature};

/// The columns beside the bodies' angles.
#[derive(Clone, Copy, Debug, Default)]
pub struct Columns {
    /// Positions, derivatives and curvature of the paths of all named points.
    pub paths: bool,
    /// Forces in the joints.
    pub reactions: bool,
}

/// Names of derivatives: with the drive's speed velocities, without derivatives by the drive.
struct Derivatives {
    speed: bool,
    rotary: bool,
}

impl Derivatives {
    /// First and second derivative of an angle.
    fn angle(&self, name: &str) -> [String; 2] {
        match (self.speed, self.rotary) {
            (true, _) => [
                format!("omega_{name}_rad_per_s"),
                format!("epsilon_{name}_rad_per_s2"),
            ],
            (false, true) => [format!("d{name}_dphi"), format!("d2{name}_dphi_2_per_rad")],
            (false, false) => [
                format!("d{name}_ds_rad_per_m"),
                format!("d2{name}_ds_2_rad_per_m2"),
            ],
        }
    }

    /// Of a coordinate.
    fn length(&self, name: &str) -> [String; 2] {
        match (self.speed, self.rotary) {
            (true, _) => [format!("v_{name}_m_per_s"), format!("a_{name}_m_per_s2")],
            (false, true) => [
                format!("d{name}_dphi_m_per_rad"),
                format!("d2{name}_dphi_2_m_per_rad2"),
            ],
            (false, false) => [format!("d{name}_ds"), format!("d2{name}_ds_2_per_m")],
        }
    }

    /// The drive, `branch`, and the angles of the moving bodies with theirs.
    fn bodies(&self, machine: &Machine) -> Vec<String> {
        let drive = if self.rotary { "phi_deg" } else { "s_m" };
        let mut all: Vec<String> = vec![drive.into(), "branch".into()];
        for name in &machine.bodies[1..] {
            all.push(format!("{name}_deg"));
            all.extend(self.angle(name));
        }
        all
    }

    /// Adds the displacements of slides and slots with theirs.
    fn travels(&self, machine: &Machine, all: &mut Vec<String>) {
        for (_, name) in travels(machine) {
            all.push(format!("s_{name}_m"));
            all.extend(self.length(&format!("s_{name}")));
        }
    }

    /// The coordinates of a point, and then theirs.
    fn point(&self, name: &str) -> Vec<String> {
        let [x, y] = ["x", "y"].map(|c| format!("{c}_{name}"));
        let [of_x, of_y] = [&x, &y].map(|c| self.length(c));
        let places = [&x, &y].map(|c| format!("{c}_m"));
        places.into_iter().chain(of_x).chain(of_y).collect()
    }
}

/// The columns' names with their units; the drive and `branch` first.
pub fn names(machine: &Machine, columns: Columns) -> Vec<String> {
    let rotary = machine.rotary();
    let by = Derivatives {
        speed: machine.speed.is_some(),
        rotary,
    };
    let mut all = by.bodies(machine);
    by.travels(machine, &mut all);
    all.extend(reduced_names(machine));
    for g in dyads(machine) {
        let bodies = &machine.solver.structure().groups[g].bodies;
        let names: Vec<&str> = bodies.iter().map(|&b| &*machine.bodies[b]).collect();
        all.push(format!("transmission_{}_deg", names.join("_")));
    }
    all.extend(asked_names(machine, columns));
    all
}

/// Names of the columns of reduced masses and of those that are asked for: [`further`].
pub(super) fn further_names(machine: &Machine, columns: Columns) -> Vec<String> {
    let mut all = reduced_names(machine);
    all.extend(asked_names(machine, columns));
    all
}

fn reduced_names(machine: &Machine) -> Vec<String> {
    let rotary = machine.rotary();
    let mut all = Vec::new();
    if machine.loads.is_some() {
        let reduced: [&str; 4] = match rotary {
            true => [
                "I_n_kg_m2",
                "dI_n_dphi_kg_m2_per_rad",
                "M_o_N_m",
                "dM_o_dphi_N_m_per_rad",
            ],
            false => ["m_n_kg", "dm_n_ds_kg_per_m", "F_o_N", "dF_o_ds_N_per_m"],
        };
        all.extend(reduced.map(String::from));
        if machine.speed.is_some() {
            all.push(format!("drive_{}", if rotary { "N_m" } else { "N" }));
        }
    }
    all
}

/// Names of the columns that are there where they are asked for.
fn asked_names(machine: &Machine, columns: Columns) -> Vec<String> {
    let by = Derivatives {
        speed: machine.speed.is_some(),
        rotary: machine.rotary(),
    };
    let mut all = Vec::new();
    if columns.paths {
        for (name, _) in &machine.points {
            all.extend(by.point(name));
            all.push(format!("curvature_{name}_per_m"));
        }
    }
    if columns.reactions {
        for (joint, body, moment) in forces(machine.solver.description()) {
            let at = format!("{}_{}", machine.joints[joint], machine.bodies[body]);
            all.extend(["x", "y"].map(|c| format!("F{c}_{at}_N")));
            if moment {
                all.push(format!("M_{at}_N_m"));
            }
        }
    }
    all
}

/// The columns of certified rows: the drive, `branch`, angles and displacements with derivatives by
/// the drive and, where paths are asked for, the named points with theirs.
pub fn certified_names(machine: &Machine, paths: bool) -> Vec<String> {
    let by = Derivatives {
        speed: false,
        rotary: machine.rotary(),
    };
    let mut all = by.bodies(machine);
    by.travels(machine, &mut all);
    for (name, _) in machine.points.iter().filter(|_| paths) {
        all.extend(by.point(name));
    }
    all
}

/// Slides and slots.
pub(super) fn travels(machine: &Machine) -> Vec<(usize, &str)> {
    let joints = machine.solver.description().joints.iter().enumerate();
    joints
        .filter(|(_, j)| matches!(j.part, Joint::Slide { .. } | Joint::Slot { .. }))
        .map(|(k, _)| (k, &*machine.joints[k]))
        .collect()
}

/// Groups that are dyads with three pins.
fn dyads(machine: &Machine) -> Vec<usize> {
    let joints = machine.solver.description().joints.iter();
    let held = |joint: &Joint| match joint {
        Joint::Pin { .. } => Vec::new(),
        Joint::Slide { slider, guide, .. } => vec![slider.body, guide.origin.body],
        Joint::Slot { pin, slot } => vec![pin.body, slot.origin.body],
        Joint::Gears { wheels, .. } => wheels.to_vec(),
        Joint::Rack { wheel, .. } => vec![*wheel],
    };
    let otherwise: Vec<usize> = joints.flat_map(|j| held(&j.part)).collect();
    let groups = machine.solver.structure().groups.iter().enumerate();
    groups
        .filter(|(_, g)| g.kind == GroupKind::Assur { class: 2 } && g.bodies.len() == 2)
        .filter(|(_, g)| !g.bodies.iter().any(|b| otherwise.contains(b)))
        .map(|(k, _)| k)
        .collect()
}

impl Machine {
    /// Velocity and acceleration from derivatives by the drive, where the file gives its speed.
    fn by_speed(&self, first: f64, second: f64) -> [f64; 2] {
        match self.speed {
            Some([w, e]) => [first * w, second * w * w + first * e],
            None => [first, second],
        }
    }
}

/// Joints with the bodies that their forces act on, and true for those that have a moment.
pub(super) fn forces(description: &Description) -> Vec<(usize, usize, bool)> {
    let mut all = Vec::new();
    for (k, joint) in description.joints.iter().enumerate() {
        match &joint.part {
            Joint::Pin { points } => all.extend(points[1..].iter().map(|p| (k, p.body, false))),
            Joint::Slide { slider, .. } => all.push((k, slider.body, true)),
            Joint::Slot { pin, .. } => all.push((k, pin.body, false)),
            Joint::Gears { .. } | Joint::Rack { .. } => {}
        }
    }
    all
}

/// The values of a row from the column after `branch` on, with the branch's loads. Forces that are
/// not determined are NaN.
pub fn values(
    machine: &Machine,
    loads: Option<&Loads>,
    state: &State,
    columns: Columns,
) -> Vec<f64> {
    let solver = &machine.solver;
    let by = |first: f64, second: f64| machine.by_speed(first, second);
    let mut all = Vec::new();
    for body in 1..machine.bodies.len() {
        let turn = solver.body_angle(state, body);
        all.push(wrapped(machine.line(state, body)).to_degrees());
        all.extend(by(turn.first, turn.second));
    }
    for (joint, _) in travels(machine) {
        if let Some(s) = solver.joint_displacement(state, joint) {
            all.push(s.s_m);
            all.extend(by(s.first_m, s.second_m));
        }
    }
    all.extend(reduced(machine, loads, state));
    for g in dyads(machine) {
        all.push(solver.transmission(state, g).map_or(f64::NAN, |a| a.deg()));
    }
    all.extend(asked(machine, loads, state, columns));
    all
}

/// Reduced masses and loads and what is asked for, without angles and displacements.
pub(super) fn further(
    machine: &Machine,
    loads: Option<&Loads>,
    state: &State,
    columns: Columns,
) -> Vec<f64> {
    let mut all = reduced(machine, loads, state);
    all.extend(asked(machine, loads, state, columns));
    all
}

fn reduced(machine: &Machine, loads: Option<&Loads>, state: &State) -> Vec<f64> {
    let mut all = Vec::new();
    if let Some(loads) = loads {
        let r = loads.reduce(&machine.solver, state);
        all.extend([
            r.inertia,
            r.inertia_derivative,
            r.moment,
            r.moment_derivative,
        ]);
        if let Some([w, e]) = machine.speed {
            all.push(r.drive(w, e));
        }
    }
    all
}

fn asked(machine: &Machine, loads: Option<&Loads>, state: &State, columns: Columns) -> Vec<f64> {
    let solver = &machine.solver;
    let mut all = Vec::new();
    if columns.paths {
        for (_, point) in &machine.points {
            let m = solver.point(state, point);
            all.extend(m.r);
            (0..2).for_each(|i| all.extend(machine.by_speed(m.first[i], m.second[i])));
            all.push(curvature(&m));
        }
    }
    if let (true, Some(loads)) = (columns.reactions, loads) {
        let [w, e] = machine.speed.unwrap_or_default();
        let found = loads.reactions(solver, state, w, e).ok();
        for (joint, body, moment) in forces(machine.solver.description()) {
            let force = found
                .as_ref()
                .and_then(|r| r.joints.iter().find(|j| (j.joint, j.body) == (joint, body)));
            all.extend(force.map_or([f64::NAN; 2], |f| f.force_n));
            if moment {
                all.push(force.map_or(f64::NAN, |f| f.moment_n_m));
            }
        }
    }
    all
}

#[cfg(test)]
mod tests;
