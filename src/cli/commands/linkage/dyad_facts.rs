//! Type, range and dead positions of a four-bar linkage or slider-crank, in words and as JSON.

use super::facts::head;
use mechaudit::machine::dyad::{Dyad, Meeting, Shape, Turn, dead, number, swing, turn};
use mechaudit::reference::nearest_f64;
use mechaudit::solvers::dyad::{Assembly, FourBar, GrashofType};
use serde_json::{Map, Value, json};

fn grashof(solver: &FourBar) -> &'static str {
    match solver.grashof_type() {
        GrashofType::CrankRocker => "crank-rocker",
        GrashofType::RockerCrank => "rocker-crank",
        GrashofType::DoubleCrank => "double-crank",
        GrashofType::DoubleRocker => "double-rocker",
        GrashofType::TripleRocker => "triple-rocker",
        GrashofType::ChangePoint => "change-point",
    }
}

fn word(assembly: Assembly) -> &'static str {
    match assembly {
        Assembly::Positive => "positive",
        Assembly::Negative => "negative",
    }
}

/// The head of a JSON file.
pub fn json(dyad: &Dyad, assemblies: &[Assembly], meetings: &[Meeting]) -> Map<String, Value> {
    let mut map = head(
        dyad.shape.type_name(),
        dyad.name.as_deref(),
        dyad.crank.as_ref(),
    );
    let mut put = |key: &str, value: Value| map.insert(key.into(), value);
    match &dyad.shape {
        Shape::FourBar { solver, .. } => put("grashof_type", json!(grashof(solver))),
        Shape::SliderCrank { solver, .. } => put("stroke_m", json!(solver.stroke().map(|s| s.m()))),
    };
    let turn = turn(&dyad.shape);
    put("full_rotation", json!(matches!(turn, Turn::Full { .. })));
    let (change_points, parts) = match turn {
        Turn::Full { change_points } => (change_points, None),
        Turn::Parts(parts) => (false, Some(parts)),
    };
    put("change_points", json!(change_points));
    let part = |[from, to]: &[f64; 2]| json!({ "from_deg": from, "to_deg": to });
    let ranges: Option<Vec<Value>> = parts.map(|p| p.iter().map(part).collect());
    put("crank_ranges", json!(ranges));
    let singular = meetings
        .iter()
        .map(|m| json!({ "phi1_deg": nearest_f64(&m.degrees), "kind": meeting_word(m) }));
    put("singular_rows", Value::Array(singular.collect()));
    let branches: Vec<Value> = assemblies.iter().map(|a| branch_json(dyad, *a)).collect();
    put("branches", json!(branches));
    map
}

fn branch_json(dyad: &Dyad, assembly: Assembly) -> Value {
    let (output, solver) = match &dyad.shape {
        Shape::FourBar { solver, .. } => ("phi3_deg", Some(solver)),
        Shape::SliderCrank { .. } => ("slider_m", None),
    };
    let dead: Vec<Value> = dead(&dyad.shape, assembly)
        .iter()
        .map(|d| json!({ "kind": d.how, "phi1_deg": d.crank_deg, output: d.output }))
        .collect();
    let mut value = json!({
        "branch": number(assembly),
        "assembly": word(assembly),
        "dead_positions": dead,
    });
    if let Some(solver) = solver {
        value["swing_deg"] = json!(swing(solver, assembly));
    }
    value
}

fn meeting_word(meeting: &Meeting) -> &'static str {
    match meeting.passes {
        true => "change point",
        false => "end of the range",
    }
}

/// A line about each crank angle, within one turn, at which both branches have one position.
pub fn meeting_lines(meetings: &[Meeting]) -> Vec<String> {
    let of = |m: &Meeting| {
        format!(
            "at phi1 = {} deg both branches meet ({}): the row gives the position, and derivatives do not exist there",
            nearest_f64(&m.degrees),
            meeting_word(m)
        )
    };
    meetings.iter().map(of).collect()
}

/// Lines for stderr.
pub fn lines(dyad: &Dyad, assemblies: &[Assembly]) -> Vec<String> {
    let what = match &dyad.shape {
        Shape::FourBar { solver, .. } => format!("four-bar, {} by Grashof's rule", grashof(solver)),
        Shape::SliderCrank { solver, .. } => match solver.stroke() {
            Some(stroke) => format!("slider-crank with a stroke of {:.9} m", stroke.m()),
            None => "slider-crank".into(),
        },
    };
    let range = match turn(&dyad.shape) {
        Turn::Full {
            change_points: false,
        } => "the crank turns fully".into(),
        Turn::Full {
            change_points: true,
        } => {
            "the crank turns fully, through singular positions where the assembly may change".into()
        }
        Turn::Parts(parts) => {
            let part = |[from, to]: &[f64; 2]| format!("from {from:.6} deg to {to:.6} deg");
            let parts: Vec<String> = parts.iter().map(part).collect();
            format!(
                "the crank cannot turn fully: it reaches {}",
                parts.join(" and ")
            )
        }
    };
    let mut lines = vec![format!("{what}; {range}")];
    lines.extend(assemblies.iter().filter_map(|a| dead_line(dyad, *a)));
    lines
}

fn dead_line(dyad: &Dyad, assembly: Assembly) -> Option<String> {
    let (name, tail) = match &dyad.shape {
        Shape::FourBar { solver, .. } => (
            "dead positions",
            swing(solver, assembly).map(|s| format!("; the rocker swings {s:.6} deg")),
        ),
        Shape::SliderCrank { .. } => ("dead centres", None),
    };
    let all: Vec<String> = dead(&dyad.shape, assembly)
        .iter()
        .map(|d| {
            let output = match dyad.shape {
                Shape::FourBar { .. } => format!("phi3 = {:.6} deg", d.output),
                Shape::SliderCrank { .. } => format!("slider at {:.9} m", d.output),
            };
            format!("phi1 = {:.6} deg ({}, {output})", d.crank_deg, d.how)
        })
        .collect();
    let branch = format!("branch {} ({} assembly)", number(assembly), word(assembly));
    let tail = tail.unwrap_or_default();
    (!all.is_empty()).then(|| format!("{branch}: {name} at {}{tail}", all.join(", ")))
}
