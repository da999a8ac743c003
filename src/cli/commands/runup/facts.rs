//! Outcome, events, steady cycle and flywheel of a run, in words and as JSON.

use crate::cli::failure::said;
use mechaudit::machine::run_up::{Coefficients, Machine, MotorKind, Steady};
use mechaudit::solvers::run_up::{Counts, Cycle, Event, EventKind, InertiaRange, Motion, Outcome};
use serde_json::{Map, Value, json};

/// A line each for the steady cycle and the flywheel.
pub fn steady_lines(steady: &Steady) -> Vec<String> {
    let mut lines = Vec::new();
    match &steady.cycle {
        None => {}
        Some(Err(e)) => lines.push(said("no steady cycle", e)),
        Some(Ok(c)) => lines.push(format!(
            "steady cycle: {:.6} rad/s in the mean, from {:.6} (at {:.2} deg) to {:.6} rad/s (at {:.2} deg), coefficient of fluctuation {:.6}, {:.3e} of a disturbance left after a turn",
            c.mean,
            c.least.0,
            c.least.1.to_degrees().rem_euclid(360.0),
            c.most.0,
            c.most.1.to_degrees().rem_euclid(360.0),
            c.fluctuation,
            c.multiplier,
        )),
    }
    match &steady.flywheel {
        None => {}
        Some(Err(e)) => lines.push(said("no flywheel", e)),
        Some(Ok(f)) if f.inertia == 0.0 => lines.push(format!(
            "flywheel: none is needed for a coefficient of fluctuation of {}",
            steady.wanted
        )),
        Some(Ok(f)) => lines.push(format!(
            "flywheel: {:.4} kg·m² more at the crank give a coefficient of fluctuation of {}",
            f.inertia, steady.wanted
        )),
    }
    lines
}

fn steady_json(steady: &Steady) -> (Value, Value) {
    let cycle = match &steady.cycle {
        None => Value::Null,
        Some(Err(e)) => json!({ "error": e.to_string() }),
        Some(Ok(c)) => cycle_json(c),
    };
    let flywheel = match &steady.flywheel {
        None => Value::Null,
        Some(Err(e)) => json!({ "error": e.to_string() }),
        Some(Ok(f)) => json!({
            "fluctuation": steady.wanted,
            "inertia_kg_m2": f.inertia,
            "cycle": cycle_json(&f.cycle),
        }),
    };
    (cycle, flywheel)
}

fn cycle_json(c: &Cycle) -> Value {
    json!({
        "omega_at_start_angle_rad_per_s": c.psi,
        "period_s": c.period,
        "mean_rad_per_s": c.mean,
        "least_rad_per_s": c.least.0,
        "least_at_phi1_deg": c.least.1.to_degrees(),
        "most_rad_per_s": c.most.0,
        "most_at_phi1_deg": c.most.1.to_degrees(),
        "coefficient_of_fluctuation": c.fluctuation,
        "multiplier": c.multiplier,
        "work_motor_J": c.work[0],
        "work_weights_J": c.work[1],
        "work_load_J": c.work[2],
        "mismatch_rad_per_s": c.mismatch,
        "iterations": c.iterations,
    })
}

/// Below this fraction of the largest the smallest inertia is worth a warning.
const LIGHT: f64 = 0.05;

/// The warning about a machine that is nearly without inertia somewhere in its turn.
pub fn light(machine: &Machine, range: &InertiaRange) -> Option<String> {
    let added = machine.drive.inertia();
    let (least, most) = (range.least + added, range.most + added);
    if !(least < LIGHT * most) {
        return None;
    }
    let cause = match added == 0.0 {
        true => {
            "I_1 = 0: the file gives neither motor.rotor_inertia nor motor.flywheel, and near a dead position the driven links stand still"
        }
        false => {
            "near a dead position the driven links stand still and the crank, rotor and flywheel have little inertia"
        }
    };
    Some(format!(
        "warning: the reduced inertia falls to {:.5} kg·m² at phi1 = {:.3} deg, {:.2} % of its largest value {:.4} kg·m² ({cause}); the speed there follows the torque within milliseconds",
        least,
        range.least_at.to_degrees().rem_euclid(360.0),
        100.0 * least / most,
        most,
    ))
}

/// One line about the end.
pub fn ending(machine: &Machine, motion: &Motion) -> String {
    let held = match machine.drive.resistance().constant.n_m() {
        0.0 => String::new(),
        load => format!(" against a constant load of {load:.6} N m"),
    };
    let end = &motion.end;
    let turns = (end.phi - motion.start.phi) / std::f64::consts::TAU;
    let at = format!("after {:.6} s and {turns:.3} turns", end.t);
    match motion.outcome {
        Outcome::TimeUp => format!("the time is over {at} at {:.6} rad/s", end.psi),
        Outcome::Target => format!("the target speed {:.6} rad/s is reached {at}", end.psi),
        Outcome::Settled { mean } => {
            format!("the motion repeats {at}: {mean:.6} rad/s in the mean")
        }
        Outcome::Captured { mean } => format!(
            "captured {at}: the motion repeats at {mean:.6} rad/s in the mean, below the motor's pull-out torque or the target speed, and does not get past"
        ),
        Outcome::Stalled { torque } if end.t == 0.0 => format!(
            "stalled: the crank does not start at phi1 = {:.3} deg, motor and weights give {torque:.6} N m together{held}",
            end.phi.to_degrees()
        ),
        Outcome::Stalled { torque } => format!(
            "stalled: the crank comes to rest {at} at phi1 = {:.3} deg, where motor and weights give {torque:.6} N m together{held}",
            end.phi.to_degrees().rem_euclid(360.0)
        ),
    }
}

/// One line about where the crank came to rest and turned back.
pub fn swings(machine: &Machine, motion: &Motion) -> Option<String> {
    let rests = || motion.events.iter().filter(|e| e.kind == EventKind::Rest);
    // The last one is where a stalled crank stays.
    let stays = usize::from(matches!(motion.outcome, Outcome::Stalled { .. }));
    let count = rests().count().saturating_sub(stays);
    let first = rests().next().filter(|_| count > 0)?;
    let stalled = match machine.motor {
        MotorKind::Off => "",
        _ => "stalled: ",
    };
    let times = match count {
        1 => "once".into(),
        n => format!("{n} times"),
    };
    Some(format!(
        "{stalled}the crank comes to rest and goes on from there {times}, first after {:.6} s at phi1 = {:.3} deg",
        first.t,
        first.phi.to_degrees().rem_euclid(360.0)
    ))
}

/// Remarks on stiffness.
pub fn stiff(machine: &Machine, motion: &Motion) -> Option<String> {
    let from = motion.stiff_from?;
    let settings = machine.plan.settings;
    let method = settings.method.name();
    Some(match settings.switch_when_stiff {
        true => format!("stiff from {from:.3e} s on: radau5 took over from {method}"),
        false => format!(
            "stiff from {from:.3e} s on: stability alone keeps the steps of {method} short; --method radau5 needs far fewer"
        ),
    })
}

/// One line about the cost and the balance of energy.
pub fn cost(machine: &Machine, motion: &Motion) -> String {
    let Counts {
        steps,
        rejected,
        retaken,
        evaluations,
    } = motion.counts;
    let kept = match machine.coefficients {
        Coefficients::Hybrid => {
            "; the hybrid's dI_n/dphi is not the derivative of its I_n, so energy is not kept"
        }
        _ => "",
    };
    let settings = machine.plan.settings;
    let then = match motion.stiff_from.is_some() && settings.switch_when_stiff {
        true => ", then radau5,",
        false => "",
    };
    format!(
        "{}{then} at tolerance {:e}: {steps} steps, {rejected} rejected, {retaken} taken again at events, {evaluations} evaluations; energy balance {:.3e} J{kept}",
        settings.method.name(),
        settings.tolerance,
        motion.end.balance,
    )
}

fn event_json(e: &Event) -> Value {
    let (kind, turn) = match e.kind {
        EventKind::DeadPosition => ("dead_position", None),
        EventKind::Turn(n) => ("turn", Some(n)),
        EventKind::Target => ("target_speed", None),
        EventKind::Rest => ("rest", None),
    };
    json!({
        "kind": kind,
        "turn": turn,
        "t_s": e.t,
        "phi1_deg": e.phi.to_degrees(),
        "omega_rad_per_s": e.psi,
    })
}

/// The head of a JSON file.
pub fn json(
    machine: &Machine,
    motion: &Motion,
    steady: &Steady,
    warning: Option<&str>,
) -> Map<String, Value> {
    let mut map = Map::new();
    let mut put = |key: &str, value: Value| {
        map.insert(key.into(), value);
    };
    put("schema_version", json!(1));
    put("mechaudit_version", json!(env!("CARGO_PKG_VERSION")));
    put("type", json!(machine.linkage));
    put("name", json!(machine.name));
    put("motor", json!(machine.motor.name()));
    put("inertia_at_crank_kg_m2", json!(machine.drive.inertia()));
    put("coefficients", json!(machine.coefficients.name()));
    let splines = machine.coefficients != Coefficients::Exact;
    put("nodes", json!(splines.then_some(machine.nodes)));
    put("method", json!(machine.plan.settings.method.name()));
    put("tolerance", json!(machine.plan.settings.tolerance));
    put("stiff_from_s", json!(motion.stiff_from));
    let (outcome, mean, torque) = match motion.outcome {
        Outcome::TimeUp => ("time_up", None, None),
        Outcome::Target => ("target", None, None),
        Outcome::Settled { mean } => ("settled", Some(mean), None),
        Outcome::Captured { mean } => ("captured", Some(mean), None),
        Outcome::Stalled { torque } => ("stalled", None, Some(torque)),
    };
    put(
        "outcome",
        json!({ "kind": outcome, "mean_rad_per_s": mean, "torque_N_m": torque }),
    );
    put("warning", json!(warning));
    let c = motion.counts;
    put(
        "counts",
        json!({ "steps": c.steps, "rejected": c.rejected, "retaken": c.retaken, "evaluations": c.evaluations }),
    );
    let events: Vec<Value> = motion.events.iter().map(event_json).collect();
    put("events", json!(events));
    let turns = motion.turns.iter().map(|t| {
        json!({ "t_s": t.t, "omega_rad_per_s": t.psi, "mean_rad_per_s": t.mean, "energy_imbalance_J": t.imbalance })
    });
    put("turns", Value::Array(turns.collect()));
    let (cycle, flywheel) = steady_json(steady);
    put("steady_cycle", cycle);
    put("flywheel", flywheel);
    map
}

#[cfg(test)]
mod tests;
