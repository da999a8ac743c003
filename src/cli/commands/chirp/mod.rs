//! A cam-driven oscillator given in a file, while its shaft speeds up or slows down.

mod drawing;
mod page;
mod rows;

use crate::cli::args::{ChirpArgs, ChirpRows};
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::files::source;
use crate::cli::forecast;
use crate::cli::progress::waiting;
use mechaudit::machine::CamOscillator;
use mechaudit::report::columns::Columns;
use mechaudit::solvers::chirp_chart::{CamResponse, Chart, ChirpChartError};
use std::time::Instant;

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
    let form = args.format.rows();
    let columns = match form {
        Some(_) => Columns::of(rows::names(wanted, &machine), &args.units.units, false)?,
        None => Columns::from(Vec::new()),
    };
    let output = Output::open(args.output.as_deref())?;
    let drawing = |file, due: bool| {
        let folder = args.svg.as_ref().filter(|_| due);
        folder.map(|f| Output::within(f, file)).transpose()
    };
    let spectrum = drawing("spectrum.svg", true)?;
    let history = drawing("history.svg", machine.run.is_some())?;
    let chart = drawing("chart.svg", machine.chart.is_some())?;
    let own = machine.response(&machine.drive).map_err(in_file)?;
    let shown = form.is_none() && page::parts(args, &machine).contains(&ChirpRows::Chart);
    let charts = match chart.is_some() || wanted == ChirpRows::Chart || shown {
        true => {
            look_ahead(&machine)
                .map_err(in_file)?
                .map_err(|f| f.about(args.file.display()))?;
            waiting("chart", || machine.charts()).map_err(in_file)?
        }
        false => Vec::new(),
    };
    if let Some(drawing) = spectrum {
        drawing.text(drawing::spectrum(&machine)?)?;
    }
    if let (Some(drawing), Some(run)) = (history, &machine.run) {
        drawing.text(drawing::history(&machine, run, &own))?;
    }
    if let Some(drawing) = chart {
        drawing.text(drawing::chart(&machine, &charts))?;
    }
    output.write(|out| {
        let Some(form) = form else {
            let page = page::page(args, &machine, &own, &charts)?;
            return Ok(out.write_all(page.as_bytes())?);
        };
        match wanted {
            ChirpRows::History => rows::history(out, (form, columns), &machine, &own),
            ChirpRows::Chart => rows::chart(out, (form, columns), &machine, &charts),
            ChirpRows::Spectrum => rows::spectrum(out, (form, columns), &machine),
        }
    })?;
    complain(&rows::harmonics_line(&machine));
    for chart in &charts {
        complain(&rows::chart_line(chart));
    }
    Ok(Outcome::AsExpected)
}

/// Harmonics with which a point of a chart is tried.
const TRIED: u32 = 64;

/// Estimates the time of the charts from a point with few harmonics: both the samples of a turn and
/// the terms of each grow with them.
fn look_ahead(machine: &CamOscillator) -> Result<Result<(), Failure>, ChirpChartError> {
    let Some(plan) = &machine.chart else {
        return Ok(Ok(()));
    };
    let (Some((_, drive)), Some(&last)) = (plan.drives.first(), plan.grid.last()) else {
        return Ok(Ok(()));
    };
    let few = machine.harmonics.min(TRIED);
    let response = CamResponse::new(drive.clone(), few, machine.initial)?;
    let begin = Instant::now();
    Chart::new(&response, plan.period, &[last])?;
    let ratio = f64::from(machine.harmonics) / f64::from(few);
    let points = plan.grid.len() * plan.drives.len();
    let each = begin.elapsed().as_secs_f64() * ratio.powi(2);
    let seconds = each * points as f64 / rayon::current_num_threads() as f64;
    let what = format!(
        "{points} points of charts with {} harmonics",
        machine.harmonics
    );
    Ok(forecast::check_duration(&what, seconds))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::{Args, Command};
    use clap::Parser;
    use std::path::Path;
    use tempfile::tempdir;

    const RUN_UP: &str = include_str!("../../../../examples/chirp-run-up.toml");
    const CHART: &str = include_str!("../../../../examples/chirp-chart.toml");

    /// Runs it on a file of the folder; what it writes to `rows.csv` there.
    fn run(folder: &Path, text: &str, more: &str) -> Result<String, Failure> {
        let at = folder.display();
        std::fs::write(folder.join("made.toml"), text).unwrap();
        let line =
            format!("mechaudit chirp {at}/made.toml --harmonics 8 --output {at}/rows.csv {more}");
        let Some(Command::Chirp(args)) = Args::parse_from(line.split_whitespace()).command else {
            unreachable!("a chirp")
        };
        assert_eq!(chirp(&args)?, Outcome::AsExpected);
        Ok(std::fs::read_to_string(folder.join("rows.csv")).unwrap())
    }

    fn begun(section: &str, text: &str) -> String {
        text.split(section).next().unwrap().to_owned()
    }

    /// The rows are those of the first section that there is, and each section has its drawing.
    #[test]
    fn rows_and_drawings_are_those_of_the_sections() {
        let short = RUN_UP.replace("\"5 ms\"", "\"1 s\"");
        let coarse = CHART.replace("step = 0.1", "step = 4.0");
        let bare = begun("[run]", RUN_UP);
        let both = format!("{coarse}\n[run]\nduration = \"2 s\"\nstep = \"1 s\"\n");
        for (text, more, head, rows, drawn) in [
            (&short, "", "t_s,", 13, &["history.svg", "spectrum.svg"][..]),
            (
                &short,
                "--rows spectrum",
                "n,a_m,",
                8,
                &["history.svg", "spectrum.svg"],
            ),
            (&coarse, "", "law,", 8, &["chart.svg", "spectrum.svg"]),
            (
                &coarse,
                "--rows spectrum",
                "n,a_rad,",
                8,
                &["chart.svg", "spectrum.svg"],
            ),
            (&bare, "", "n,a_m,", 8, &["spectrum.svg"]),
            (
                &both,
                "",
                "t_s,",
                3,
                &["chart.svg", "history.svg", "spectrum.svg"],
            ),
            (
                &both,
                "--rows chart",
                "law,",
                8,
                &["chart.svg", "history.svg", "spectrum.svg"],
            ),
        ] {
            let folder = tempdir().unwrap();
            let plain = run(folder.path(), text, more).unwrap();
            assert!(plain.starts_with(head), "{plain}");
            assert_eq!(plain.lines().count(), 1 + rows, "{more}: {plain}");
            let pictures = folder.path().join("pictures");
            let more = format!("{more} --svg {}", pictures.display());
            assert_eq!(run(folder.path(), text, &more).unwrap(), plain);
            let files = std::fs::read_dir(&pictures).unwrap();
            let mut names: Vec<String> = files
                .map(|f| f.unwrap().file_name().into_string().unwrap())
                .collect();
            names.sort();
            assert_eq!(names, drawn);
            for name in drawn {
                let svg = std::fs::read_to_string(pictures.join(name)).unwrap();
                assert!(svg.starts_with("<svg"), "{name}");
                assert!(*name != "chart.svg" || svg.contains("0050"), "{svg}");
            }
        }
    }

    /// A page has every section that the file has, or the one that is asked for, and the units
    /// asked for.
    #[test]
    fn a_page_has_the_sections_of_the_file() {
        let coarse = CHART.replace("step = 0.1", "step = 4.0");
        let both = format!("{coarse}\n[run]\nduration = \"2 s\"\nstep = \"1 ms\"\n");
        for (text, more, due) in [
            (RUN_UP.to_string(), "", &["history", "spectrum"][..]),
            (coarse.clone(), "", &["chart", "spectrum"]),
            (both.clone(), "", &["history", "chart", "spectrum"]),
            (both, "--rows chart --units rpm", &["chart"]),
        ] {
            let folder = tempdir().unwrap();
            let page = run(folder.path(), &text, &format!("--format html {more}")).unwrap();
            assert!(page.starts_with("<!doctype html>") && page.len() < 2_000_000);
            for key in ["history", "chart", "spectrum"] {
                let found = page.contains(&format!("<h2 id=\"{key}\">"));
                assert_eq!(found, due.contains(&key), "{key}");
                assert_eq!(page.contains(&format!("data-topic=\"{key}\"")), found);
            }
            assert!(page.matches("<polyline").count() >= due.len());
            assert_eq!(page.contains("<th>speed_rpm</th>"), more.ends_with("rpm"));
        }
        let folder = tempdir().unwrap();
        let why = run(folder.path(), RUN_UP, "--format html --units kg").unwrap_err();
        assert!(why.to_string().contains("no column can be in kg"), "{why}");
    }

    #[test]
    fn rows_of_a_section_that_is_missing() {
        let folder = tempdir().unwrap();
        for (text, rows, section) in [(CHART, "history", "run"), (RUN_UP, "chart", "chart")] {
            let why = run(folder.path(), text, &format!("--rows {rows}"))
                .unwrap_err()
                .to_string();
            assert!(
                why.ends_with(&format!("made.toml: the section [{section}] is missing")),
                "{why}"
            );
        }
        // Nothing here is certified: no unit costs digits.
        let inches = run(folder.path(), &begun("[run]", RUN_UP), "--units in").unwrap();
        assert!(
            inches.starts_with("n,a_in,b_in,D_in,delta_deg,left_out_in\n"),
            "{inches}"
        );
        assert!(!folder.path().join("pictures").exists());
    }
}
