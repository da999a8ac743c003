//! Structure, range and branches of a mechanism, in words and as JSON.

use super::facts;
use mechaudit::machine::planar::{Branch, End, Machine, Reach};
use mechaudit::reference::planar::Mobility;
use mechaudit::solvers::planar::{BranchEnd, BranchMap, Group, GroupKind, SingularKind};
use serde_json::{Map, Value, json};

fn kind_word(group: &Group) -> String {
    match group.kind {
        GroupKind::Driver => "driver".into(),
        GroupKind::Single => "one body".into(),
        GroupKind::Assur { class: 2 } if group.bodies.len() == 2 => "dyad".into(),
        GroupKind::Assur { class } => format!("Assur group of class {class}"),
    }
}

fn singular_word(kind: Option<SingularKind>) -> &'static str {
    match kind {
        Some(SingularKind::Fold) => "fold",
        Some(SingularKind::ChangePoint) => "change point",
        None => "singular position",
    }
}

fn members(machine: &Machine, bodies: &[usize]) -> Vec<String> {
    bodies.iter().map(|&b| machine.bodies[b].clone()).collect()
}

/// One line about the structure.
pub fn lines(machine: &Machine) -> Vec<String> {
    let groups = machine.solver.structure().groups.iter().map(|g| {
        let names = members(machine, &g.bodies).join(", ");
        match g.kind {
            GroupKind::Driver => format!("{names} (driver)"),
            _ => format!("{names} ({}, order {})", kind_word(g), g.order),
        }
    });
    let mut lines = vec![format!(
        "one degree of freedom; groups in the order of solving: {}",
        groups.collect::<Vec<_>>().join("; ")
    )];
    lines.extend(machine.drawing_text());
    lines
}

/// The facts proved of the drawing.
fn drawing(machine: &Machine) -> Value {
    let Some(d) = &machine.drawing else {
        return Value::Null;
    };
    let (mobility, freedoms) = match d.mobility {
        Mobility::Locked => ("locked", 0),
        Mobility::Regular { freedoms } => ("regular", freedoms),
        Mobility::Turning { most } => ("moves", most),
        Mobility::Undecided { most } => ("undecided", most),
    };
    // The ground comes first among the names.
    let names = |of: &[usize]| members(machine, &of.iter().map(|k| k + 1).collect::<Vec<_>>());
    json!({
        "velocities": d.velocities,
        "equations": d.equations,
        "rank": d.rank,
        "mobility": mobility,
        "freedoms_at_most": freedoms,
        "redundant": d.redundant(),
        "redundant_among": names(&d.strained),
        "movable": names(&d.movable),
    })
}

/// One line about the modes at the start.
pub fn modes_line(machine: &Machine, branch: &Branch) -> String {
    let at = machine.drive_text(machine.outer(machine.solver.drive_of(&branch.start)));
    let plural = if branch.modes == 1 { "" } else { "s" };
    let (found, all) = match branch.complete {
        true => ("", ", all that there are"),
        false => (" found", "; there may be more"),
    };
    format!(
        "{} assembly mode{plural}{found} at {at}{all}; this is number {}",
        branch.modes, branch.mode
    )
}

/// One line about how far the drive goes.
pub fn range_line(machine: &Machine, branch: &Branch) -> String {
    let end = |e: Option<End>, whole: f64| match e {
        Some(e) => format!(
            "{} ({})",
            machine.end_text(e.drive, e.kind),
            singular_word(e.kind)
        ),
        None => machine.drive_text(whole),
    };
    match branch.reach {
        Reach::Whole { turns: Some(1) } => "the drive turns fully on this branch".into(),
        Reach::Whole { turns: Some(n) } => format!(
            "the drive turns fully on this branch; the mechanism is back in its position after {n} turns"
        ),
        Reach::Whole { turns: None } => {
            "the drive turns fully on this branch, and the mechanism does not come back".into()
        }
        Reach::Part { low, high } => {
            let [from, to] = machine.window.map_or([f64::NAN; 2], |w| [w[0], w[1]]);
            format!(
                "the branch reaches from {} to {}",
                end(low, from),
                end(high, to)
            )
        }
    }
}

/// One line about values of the drive without a row, as shown and with the end that each lies at.
pub fn left_out_line(machine: &Machine, left_out: &[(f64, End)]) -> Option<String> {
    const MOST: usize = 8;
    let unit = if machine.rotary() { "deg" } else { "m" };
    let of = |(drive, end): &(f64, End)| format!("{drive} {unit} ({})", singular_word(end.kind));
    let mut all: Vec<String> = left_out.iter().take(MOST).map(of).collect();
    if left_out.len() > MOST {
        all.push(format!("{} more", left_out.len() - MOST));
    }
    let line = "no row where the position is singular and branches meet: at";
    (!all.is_empty()).then(|| format!("{line} {}", all.join(", ")))
}

/// The head of a JSON file.
fn head(machine: &Machine) -> Map<String, Value> {
    let mut map = facts::head("planar", machine.name.as_deref(), None);
    let mut put = |key: &str, value: Value| map.insert(key.into(), value);
    put("bodies", json!(machine.bodies));
    put("joints", json!(machine.joints));
    let groups = machine.solver.structure().groups.iter().map(|g| {
        let (kind, class) = match g.kind {
            GroupKind::Driver => ("driver", None),
            GroupKind::Single => ("single", None),
            GroupKind::Assur { class } => ("assur", Some(class)),
        };
        json!({
            "kind": kind,
            "class": class,
            "order": g.order,
            "bodies": members(machine, &g.bodies),
        })
    });
    put("groups", Value::Array(groups.collect()));
    put("drawing", drawing(machine));
    if let Some([speed, acceleration]) = machine.speed {
        let unit = if machine.rotary() { "rad" } else { "m" };
        put(&format!("drive_speed_{unit}_per_s"), json!(speed));
        put(
            &format!("drive_acceleration_{unit}_per_s2"),
            json!(acceleration),
        );
    }
    map
}

fn shown(machine: &Machine, drive: f64) -> f64 {
    if machine.rotary() {
        drive.to_degrees()
    } else {
        drive
    }
}

/// The facts about a branch.
pub fn of_branch(
    machine: &Machine,
    branch: &Branch,
    left_out: &[(f64, End)],
) -> Map<String, Value> {
    let mut map = head(machine);
    let unit = if machine.rotary() { "deg" } else { "m" };
    map.insert("branch".into(), json!(branch.mode));
    map.insert("modes_at_start".into(), json!(branch.modes));
    map.insert("modes_complete".into(), json!(branch.complete));
    let end = |e: End| json!({ format!("drive_{unit}"): shown(machine, e.drive), "kind": singular_word(e.kind) });
    facts::put_range(&mut map, "drive_range", &branch.reach, |e| {
        json!(e.map(end))
    });
    map.insert("rows_left_out".into(), rows_left_out(unit, left_out));
    map
}

fn rows_left_out(unit: &str, left_out: &[(f64, End)]) -> Value {
    let of = |(drive, e): &(f64, End)| json!({ format!("drive_{unit}"): drive, "kind": singular_word(e.kind) });
    Value::Array(left_out.iter().map(of).collect())
}

/// The user's drive at an end of branches.
pub fn end_drive(machine: &Machine, e: &BranchEnd) -> f64 {
    machine.outer(e.at.as_ref().map_or(e.drive, |s| s.drive))
}

/// The facts about all branches.
pub fn of_map(
    machine: &Machine,
    branches: &BranchMap,
    left_out: &[(f64, End)],
) -> Map<String, Value> {
    let mut map = head(machine);
    let unit = if machine.rotary() { "deg" } else { "m" };
    map.insert("branches".into(), json!(branches.branches));
    map.insert("modes_complete".into(), json!(branches.complete));
    map.insert("unmatched".into(), json!(branches.unmatched));
    let ends = branches.ends.iter().map(|e| {
        json!({
            format!("drive_{unit}"): shown(machine, end_drive(machine, e)),
            "kind": singular_word(e.at.as_ref().map(|s| s.kind)),
            "branches": e.branches,
            "begins": e.begins,
        })
    });
    map.insert("ends".into(), Value::Array(ends.collect()));
    map.insert("rows_left_out".into(), rows_left_out(unit, left_out));
    map
}

/// Lines about all branches.
pub fn map_lines(machine: &Machine, map: &BranchMap) -> Vec<String> {
    let counts = || map.rows.iter().map(Vec::len);
    let (found, all) = match map.complete {
        true => ("", ", all that there are"),
        false => (" found", "; there may be more"),
    };
    let mut lines = vec![format!(
        "{} branches{found}, from {} to {} assembly modes at a value of the drive{all}",
        map.branches,
        counts().min().unwrap_or(0),
        counts().max().unwrap_or(0)
    )];
    if map.unmatched > 0 {
        lines.push(format!(
            "{} positions were found by continuation or by the search for all modes, but not by both",
            map.unmatched
        ));
    }
    for e in &map.ends {
        let mut branches = e.branches.clone();
        branches.sort_unstable();
        let branches: Vec<String> = branches.iter().map(usize::to_string).collect();
        let (noun, verb) = match (branches.len(), e.begins) {
            (1, true) => ("branch", "begins"),
            (1, false) => ("branch", "ends"),
            (_, true) => ("branches", "begin"),
            (_, false) => ("branches", "end"),
        };
        let kind = e.at.as_ref().map(|s| s.kind);
        lines.push(format!(
            "{} at {}: {noun} {} {verb} there",
            singular_word(kind),
            machine.end_text(end_drive(machine, e), kind),
            branches.join(" and ")
        ));
    }
    lines
}

#[cfg(test)]
mod tests;
