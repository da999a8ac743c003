//! A cam-driven oscillator given in a file, while its shaft speeds up or slows down.

use super::args::{ChirpArgs, ChirpRows};
use super::chirp_file::{self, Machine};
use super::chirp_rows::{self as rows, Charted};
use super::columns::Columns;
use super::complain;
use super::failure::{Failure, Outcome};
use super::output::write_to;
use super::svg_chirp;
use super::svg_panel::save;
use mechaudit::solvers::chirp_chart::{CamResponse, Chart};

/// Prints and draws what the arguments ask for.
pub fn chirp(args: &ChirpArgs) -> Result<Outcome, Failure> {
    let machine = chirp_file::read(args)?;
    let about = |e: String| Failure::new(format!("{}: {e}", args.file.display()));
    let wanted = args.rows.unwrap_or(match (&machine.run, &machine.chart) {
        (Some(_), _) => ChirpRows::History,
        (None, Some(_)) => ChirpRows::Chart,
        (None, None) => ChirpRows::Spectrum,
    });
    let missing = |table: &str| about(format!("the table [{table}] is missing"));
    match wanted {
        ChirpRows::History if machine.run.is_none() => return Err(missing("run")),
        ChirpRows::Chart if machine.chart.is_none() => return Err(missing("chart")),
        _ => {}
    }
    let columns = Columns::of(rows::names(wanted, &machine), &args.units.units, false)?;
    let response = |drive| CamResponse::new(drive, machine.harmonics, machine.initial);
    let own = response(machine.drive.clone()).map_err(|e| about(e.to_string()))?;
    let drawn = args.svg.is_some();
    let charts = match &machine.chart {
        Some(plan) if drawn || wanted == ChirpRows::Chart => {
            let one = |(law, drive): &(String, _)| {
                let response = response(Clone::clone(drive))?;
                let chart = Chart::new(&response, plan.period, &plan.grid)?;
                Ok(Charted {
                    law: law.clone(),
                    chart,
                })
            };
            let all: Result<Vec<Charted>, mechaudit::solvers::chirp_chart::ChirpChartError> =
                plan.drives.iter().map(one).collect();
            all.map_err(|e| about(e.to_string()))?
        }
        _ => Vec::new(),
    };
    if let Some(folder) = &args.svg {
        save(folder, "spectrum.svg", &svg_chirp::spectrum(&machine)?)?;
        if let Some(run) = &machine.run {
            save(
                folder,
                "history.svg",
                &svg_chirp::history(&machine, run, &own)?,
            )?;
        }
        if !charts.is_empty() {
            save(folder, "chart.svg", &svg_chirp::chart(&machine, &charts)?)?;
        }
    }
    write_to(args.output.as_deref(), |out| match wanted {
        ChirpRows::History => rows::history(out, (args.format, columns), &machine, &own),
        ChirpRows::Chart => rows::chart(out, (args.format, columns), &machine, &charts),
        ChirpRows::Spectrum => rows::spectrum(out, (args.format, columns), &machine),
    })?;
    for line in lines(&machine, &charts) {
        complain(&line);
    }
    Ok(Outcome::AsExpected)
}

/// What there is to say besides the rows.
fn lines(machine: &Machine, charts: &[Charted]) -> Vec<String> {
    let mut all = vec![rows::harmonics_line(machine)];
    all.extend(charts.iter().map(Charted::line));
    all
}
