//! A cam-driven oscillator given in a file, while its shaft speeds up or slows down.

mod drawing;
mod rows;

use crate::cli::args::{ChirpArgs, ChirpRows};
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::files::source;
use mechaudit::machine::CamOscillator;
use mechaudit::report::columns::Columns;

/// The oscillator that the arguments name.
pub fn machine(args: &ChirpArgs) -> Result<CamOscillator, Failure> {
    let machine = CamOscillator::read(&source::open(&args.file)?, args.harmonics);
    machine.map_err(|e| Failure::in_file(&args.file, e))
}

/// Prints and draws what the arguments ask for.
pub fn chirp(args: &ChirpArgs) -> Result<Outcome, Failure> {
    let machine = machine(args)?;
    let in_file = |e| Failure::in_file(&args.file, e);
    let wanted = args.rows.unwrap_or(match (&machine.run, &machine.chart) {
        (Some(_), _) => ChirpRows::History,
        (None, Some(_)) => ChirpRows::Chart,
        (None, None) => ChirpRows::Spectrum,
    });
    let missing = |section: &str| {
        let text = format!("the section [{section}] is missing");
        Failure::new(text).about(args.file.display())
    };
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
    let own = machine.response(&machine.drive).map_err(in_file)?;
    let charts = match chart.is_some() || wanted == ChirpRows::Chart {
        true => machine.charts().map_err(in_file)?,
        false => Vec::new(),
    };
    if let Some(drawing) = spectrum {
        drawing.text(&drawing::spectrum(&machine)?)?;
    }
    if let (Some(drawing), Some(run)) = (history, &machine.run) {
        drawing.text(&drawing::history(&machine, run, &own)?)?;
    }
    if let Some(drawing) = chart {
        drawing.text(&drawing::chart(&machine, &charts)?)?;
    }
    output.write(|out| match wanted {
        ChirpRows::History => rows::history(out, (args.format, columns), &machine, &own),
        ChirpRows::Chart => rows::chart(out, (args.format, columns), &machine, &charts),
        ChirpRows::Spectrum => rows::spectrum(out, (args.format, columns), &machine),
    })?;
    complain(&rows::harmonics_line(&machine));
    for chart in &charts {
        complain(&rows::chart_line(chart));
    }
    Ok(Outcome::AsExpected)
}
