//! The rows of a cam-driven oscillator: motion over time, chart, spectrum.

use crate::cli::args::ChirpRows;
use crate::cli::failure::Failure;
use mechaudit::machine::cam_oscillator::{CamOscillator, LawChart};
use mechaudit::report::cell::Cell;
use mechaudit::report::columns::Columns;
use mechaudit::report::rows::{Form, Rows};
use mechaudit::solvers::chirp_chart::{CamResponse, ChartPoint, Period, State};
use mechaudit::solvers::fourier_series::FourierSeries;
use rayon::prelude::*;
use serde_json::{Map, Value, json};
use std::io::Write;

/// Times computed together: memory does not grow with the number of rows.
const CHUNK: u64 = 4096;

/// Beat zones and how far the bound is above the truth.
pub fn chart_line(chart: &LawChart) -> String {
    let zones = chart.chart.beats(|p| p.acceleration);
    let spacings: Vec<f64> = zones.iter().skip(1).map(|z| z.spacing).collect();
    let spacing = match spacings.len() {
        0 => String::new(),
        n => format!(
            ", {:.3} apart in the mean",
            spacings.iter().sum::<f64>() / n as f64
        ),
    };
    let ratio = |p: &ChartPoint| p.bound / p.displacement;
    let all = || chart.chart.points.iter().map(ratio);
    format!(
        "{}: {} beat zones of C_phi{spacing}; formula (19) is {:.3} to {:.3} times the true peak",
        chart.law,
        zones.len(),
        all().fold(f64::INFINITY, f64::min),
        all().fold(0.0, f64::max),
    )
}

/// The number of harmonics and the bound on those left out.
pub fn harmonics_line(machine: &CamOscillator) -> String {
    let series = FourierSeries::new(&machine.drive.cycle);
    let n = machine.harmonics;
    format!(
        "{n} harmonics; those left out add up to {:.2e} of the lift at most, and are filtered at \
         shaft speeds above {:.4} rad/s",
        series.tail_bound(n, 0) / machine.drive.cycle.lift().abs(),
        1.5 * machine.drive.oscillator.w() / f64::from(n),
    )
}

fn about(machine: &CamOscillator) -> Map<String, Value> {
    let drive = &machine.drive;
    let cycle = &drive.cycle;
    let peaks = cycle.rise().law.peaks();
    let mut all = Map::new();
    let mut put = |key: &str, value: Value| all.insert(key.into(), value);
    put("name", json!(machine.name));
    put("law", json!(machine.law));
    put("w_rad_per_s", json!(drive.oscillator.w()));
    put("n_rad_per_s", json!(drive.oscillator.n()));
    put("omega0_rad_per_s", json!(drive.chirp.omega0));
    put("epsilon_rad_per_s2", json!(drive.chirp.eps));
    put("lift_unit", json!(machine.unit));
    put("lift", json!(cycle.lift()));
    put("C_v", json!(peaks.velocity));
    put("C_a", json!(peaks.acceleration.max(peaks.deceleration)));
    put("C_a_accelerating", json!(peaks.acceleration));
    put("C_a_decelerating", json!(peaks.deceleration));
    put("C_j", json!(peaks.jerk.is_finite().then_some(peaks.jerk)));
    put("harmonics", json!(machine.harmonics));
    let series = FourierSeries::new(cycle);
    put(
        "harmonics_left_out",
        json!(series.tail_bound(machine.harmonics, 0)),
    );
    all
}

/// The columns of these rows with their units.
pub fn names(rows: ChirpRows, machine: &CamOscillator) -> Vec<String> {
    let u = machine.unit;
    match rows {
        ChirpRows::History => {
            let mut names = ["t_s", "shaft_deg", "speed_rad_per_s", "xi_rise", "xi_turn"]
                .map(String::from)
                .to_vec();
            names.extend([
                format!("f_{u}"),
                format!("y_{u}"),
                format!("v_{u}_per_s"),
                format!("a_{u}_per_s2"),
                format!("envelope_low_{u}"),
                format!("envelope_high_{u}"),
            ]);
            names
        }
        ChirpRows::Chart => [
            "law",
            "xi_rise",
            "xi_turn",
            "t_s",
            "speed_rad_per_s",
            "formula_19",
            "peak_displacement",
            "C_phi_bound",
            "C_phi",
            "K_dc",
            "K_dM",
            "K_dN",
            "dwell_amplitude",
            "dwell_phase_deg",
        ]
        .map(String::from)
        .to_vec(),
        ChirpRows::Spectrum => vec![
            "n".into(),
            format!("a_{u}"),
            format!("b_{u}"),
            format!("D_{u}"),
            "delta_deg".into(),
            format!("left_out_{u}"),
        ],
    }
}

/// The motion over time.
pub fn history(
    out: &mut dyn Write,
    (format, columns): (Form, Columns),
    machine: &CamOscillator,
    response: &CamResponse,
) -> Result<(), Failure> {
    let Some(run) = &machine.run else {
        return Ok(());
    };
    let drive = response.drive();
    let mean = response.mean();
    let row = |s: &State, envelope: f64| {
        let values = [
            s.t,
            360.0 * s.turns,
            s.speed,
            drive.criterion(s.speed, Period::Rise),
            drive.criterion(s.speed, Period::Turn),
            s.cam,
            s.displacement,
            s.velocity,
            s.acceleration,
            mean - envelope,
            mean + envelope,
        ];
        values.map(Cell::Float)
    };
    let mut rows = Rows::begin(out, format, columns, &about(machine))?;
    let mut from = 0;
    while from < run.rows {
        let to = (from + CHUNK).min(run.rows);
        let one = |k: u64| {
            let t = run.step * k as f64;
            Ok((response.state(t)?, response.envelope(t)?))
        };
        let states: Result<Vec<_>, mechaudit::solvers::chirp_chart::ChirpChartError> =
            (from..to).into_par_iter().map(one).collect();
        for (state, envelope) in states.map_err(Failure::caused)? {
            rows.row(&row(&state, envelope))?;
        }
        from = to;
    }
    Ok(rows.end()?)
}

/// The charts of all laws.
pub fn chart(
    out: &mut dyn Write,
    (format, columns): (Form, Columns),
    machine: &CamOscillator,
    charts: &[LawChart],
) -> Result<(), Failure> {
    let mut about = about(machine);
    let zones = |c: &LawChart| {
        let all = c.chart.beats(|p| p.acceleration);
        let one = |z: &mechaudit::solvers::chirp_chart::BeatZone| json!({"xi": z.xi, "C_phi": z.value, "spacing": z.spacing.is_finite().then_some(z.spacing)});
        json!({"law": c.law, "C": c.chart.rigid[0], "zones": all.iter().map(one).collect::<Vec<_>>()})
    };
    about.insert("beat_zones".into(), charts.iter().map(zones).collect());
    let mut rows = Rows::begin(out, format, columns, &about)?;
    for c in charts {
        for p in &c.chart.points {
            let [k_dc, k_dm, k_dn] = p.dynamic_coefficients;
            let values = [
                p.xi_rise,
                p.xi_turn,
                p.t,
                p.speed,
                p.bound,
                p.displacement,
                p.acceleration_bound,
                p.acceleration,
                k_dc,
                k_dm,
                k_dn,
            ];
            let mut cells = vec![Cell::Word(c.law.clone())];
            cells.extend(values.map(Cell::Float));
            let dwell = [p.dwell_amplitude, p.dwell_phase.to_degrees()];
            cells.extend(dwell.map(|x| match x.is_nan() {
                true => Cell::Empty,
                false => Cell::Float(x),
            }));
            rows.row(&cells)?;
        }
    }
    Ok(rows.end()?)
}

/// The harmonics of the cam's displacement.
pub fn spectrum(
    out: &mut dyn Write,
    (format, columns): (Form, Columns),
    machine: &CamOscillator,
) -> Result<(), Failure> {
    let series = FourierSeries::new(&machine.drive.cycle);
    let mut about = about(machine);
    about.insert("a_0".into(), json!(series.mean()));
    let mut rows = Rows::begin(out, format, columns, &about)?;
    for n in 1..=machine.harmonics {
        let h = series.harmonic(n).map_err(Failure::caused)?;
        let values = [
            h.a,
            h.b,
            h.amplitude(),
            h.phase().to_degrees(),
            series.tail_bound(n, 0),
        ];
        let mut cells = vec![Cell::Count(n as usize)];
        cells.extend(values.map(Cell::Float));
        rows.row(&cells)?;
    }
    Ok(rows.end()?)
}

#[cfg(test)]
mod tests;
