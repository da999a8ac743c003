//! Range, dead positions and folds of a class-III linkage, in words and as JSON.

use mechaudit::machine::class_iii::{Branch, End, Linkage, Reach, TURNS};
use mechaudit::machine::{self, CrankMotion};
use mechaudit::solvers::class_iii::Fold;
use serde_json::{Map, Value, json};

/// One line about how far the crank turns.
pub fn range_line(branch: &Branch) -> String {
    match branch.reach {
        Reach::Whole { turns: Some(1) } => "the crank turns fully on this branch".into(),
        Reach::Whole { turns: Some(n) } => format!(
            "the crank turns fully on this branch; the linkage is back in its position after {n} turns"
        ),
        Reach::Whole { turns: None } => {
            format!("the crank turns fully on this branch, at least {TURNS} times")
        }
        Reach::Part { low, high } => format!(
            "the crank cannot turn fully on this branch: it reaches from {:.6} deg to {:.6} deg, where assembly modes merge",
            low.phi1.to_degrees(),
            high.phi1.to_degrees()
        ),
    }
}

/// One line about the dead positions.
pub fn dead_line(branch: &Branch) -> Option<String> {
    let all: Vec<String> = branch
        .dead
        .iter()
        .map(|d| {
            let how = if d.stretched { "stretched" } else { "folded" };
            format!("{:.6} deg ({how})", d.state.phi1.to_degrees())
        })
        .collect();
    let line = "dead positions, crank and link 2 in line, at";
    (!all.is_empty()).then(|| format!("{line} {}", all.join(", ")))
}

/// One line about crank angles in degrees that have no row because they lie at an end of the
/// branch.
pub fn left_out_line(left_out: &[f64]) -> Option<String> {
    let all: Vec<String> = left_out.iter().map(|d| format!("{d} deg")).collect();
    let line = "no row where the position is singular and assembly modes merge: at";
    (!all.is_empty()).then(|| format!("{line} {}", all.join(", ")))
}

pub fn fold_json(fold: &Fold) -> Value {
    json!({
        "phi1_deg": fold.phi1.to_degrees(),
        "phi4_deg": fold.phi4.to_degrees(),
        "branches": fold.branches,
        "begins": fold.begins,
    })
}

/// The head of a JSON file about a mechanism of that type.
pub fn head(kind: &str, name: Option<&str>, crank: Option<&CrankMotion>) -> Map<String, Value> {
    let mut map = Map::new();
    let mut put = |key: &str, value: Value| map.insert(key.into(), value);
    put("schema_version", json!(1));
    put("mechaudit_version", json!(env!("CARGO_PKG_VERSION")));
    put("type", json!(kind));
    put("name", json!(name));
    if let Some(c) = crank {
        put("crank_speed_rad_per_s", json!(c.omega.to_f64()));
        put("crank_acceleration_rad_per_s2", json!(c.epsilon.to_f64()));
    }
    map
}

/// The head of a JSON file about a linkage of class III.
pub fn of_linkage(linkage: &Linkage) -> Map<String, Value> {
    head("class-iii", linkage.name.as_deref(), linkage.crank.as_ref())
}

/// Adds how far the drive goes, the ends under the key.
pub fn put_range<E>(
    map: &mut Map<String, Value>,
    key: &str,
    reach: &machine::Reach<E>,
    end: impl Fn(&E) -> Value,
) {
    map.insert("full_rotation".into(), json!(reach.is_whole()));
    map.insert("turns_to_close".into(), json!(reach.turns()));
    let ends = match reach {
        machine::Reach::Whole { .. } => Value::Null,
        machine::Reach::Part { low, high } => json!({ "from": end(low), "to": end(high) }),
    };
    map.insert(key.into(), ends);
}

/// The facts about the branch.
pub fn of_branch(linkage: &Linkage, branch: &Branch) -> Map<String, Value> {
    let mut map = of_linkage(linkage);
    map.insert("branch".into(), json!(branch.mode));
    let end = |e: &End| json!({ "phi1_deg": e.phi1.to_degrees(), "phi4_deg": e.phi4.to_degrees() });
    put_range(&mut map, "crank_range", &branch.reach, end);
    let dead: Vec<Value> = branch
        .dead
        .iter()
        .map(|d| json!({ "phi1_deg": d.state.phi1.to_degrees(), "stretched": d.stretched }))
        .collect();
    map.insert("dead_positions".into(), json!(dead));
    map
}
