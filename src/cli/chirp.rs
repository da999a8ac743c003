//! A cam-driven oscillator given in a file, while its shaft speeds up or slows down.

use super::args::{ChirpArgs, ChirpRows};
use super::chirp_drawing;
use super::chirp_file::{self, Machine};
use super::chirp_rows::{self as rows, Charted};
use super::columns::Columns;
use super::complain;
use super::failure::{Failure, Outcome};
use super::output::Output;
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
    let output = Output::open(args.output.as_deref())?;
    let drawing = |file, due: bool| {
        let folder = args.svg.as_ref().filter(|_| due);
        folder.map(|f| Output::within(f, file)).transpose()
    };
    let spectrum = drawing("spectrum.svg", true)?;
    let history = drawing("history.svg", machine.run.is_some())?;
    let chart = drawing("chart.svg", machine.chart.is_some())?;
    let response = |drive| CamResponse::new(drive, machine.harmonics, machine.initial);
    let own = response(machine.drive.clone()).map_err(|e| about(e.to_string()))?;
    let charts = match &machine.chart {
        Some(plan) if chart.is_some() || wanted == ChirpRows::Chart => {
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
    if let Some(drawing) = spectrum {
        drawing.text(&chirp_drawing::spectrum(&machine)?)?;
    }
    if let (Some(drawing), Some(run)) = (history, &machine.run) {
        drawing.text(&chirp_drawing::history(&machine, run, &own)?)?;
    }
    if let Some(drawing) = chart {
        drawing.text(&chirp_drawing::chart(&machine, &charts)?)?;
    }
    output.write(|out| match wanted {
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
