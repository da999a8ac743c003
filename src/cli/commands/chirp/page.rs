//! A cam-driven oscillator as a page.

use super::{drawing, rows};
use crate::cli::args::{ChirpArgs, ChirpRows};
use crate::cli::failure::Failure;
use mechaudit::machine::cam_oscillator::{CamOscillator, LawChart};
use mechaudit::report::columns::Columns;
use mechaudit::report::html::run::{self, Figure, Section};
use mechaudit::report::rows::Form;
use mechaudit::report::svg::chirp::{chart_panels, history_panels};
use mechaudit::solvers::chirp_chart::CamResponse;

/// The parts of the page: what the arguments name, or all that the file has.
pub fn parts(args: &ChirpArgs, machine: &CamOscillator) -> Vec<ChirpRows> {
    let there = |rows: &ChirpRows| match rows {
        ChirpRows::History => machine.run.is_some(),
        ChirpRows::Chart => machine.chart.is_some(),
        ChirpRows::Spectrum => true,
    };
    let all = [ChirpRows::History, ChirpRows::Chart, ChirpRows::Spectrum];
    match args.rows {
        Some(rows) => vec![rows],
        None => all.into_iter().filter(there).collect(),
    }
}

/// The page.
pub fn page(
    args: &ChirpArgs,
    machine: &CamOscillator,
    response: &CamResponse,
    charts: &[LawChart],
) -> Result<String, Failure> {
    let parts = parts(args, machine);
    let names = |part: &ChirpRows| rows::names(*part, machine);
    // Refuses a unit that none of the tables can use; each takes those that it can.
    let all = parts.iter().flat_map(names).collect();
    Columns::of(all, &args.units.units, false)?;
    let section = |part: &ChirpRows| {
        let fits = |u: &&String| Columns::of(names(part), std::slice::from_ref(*u), false).is_ok();
        let units: Vec<String> = args.units.units.iter().filter(fits).cloned().collect();
        let form = (Form::Table, Columns::of(names(part), &units, false)?);
        let mut table = Vec::new();
        let (key, title, figures) = match part {
            ChirpRows::History => {
                rows::history(&mut table, form, machine, response)?;
                let run = machine.run.iter();
                let motions = run.map(|r| drawing::motion(machine, r, response, String::new()));
                let panels = motions.flat_map(|m| history_panels(&m));
                (
                    "history",
                    "Motion over time",
                    panels.map(Figure::Panel).collect(),
                )
            }
            ChirpRows::Chart => {
                rows::chart(&mut table, form, machine, charts)?;
                let panels = charts
                    .iter()
                    .flat_map(|c| chart_panels(&(&c.law, &c.chart)));
                (
                    "chart",
                    "Peaks over the frequency criterion",
                    panels.map(Figure::Panel).collect(),
                )
            }
            ChirpRows::Spectrum => {
                rows::spectrum(&mut table, form, machine)?;
                let found = drawing::harmonics(machine)?;
                let largest = found.harmonics.iter().map(|h| h.1).fold(0.0, f64::max);
                let seen = |line: Vec<(f64, f64)>| {
                    let floor = 1e-9 * largest;
                    line.into_iter()
                        .filter(|p| p.1 > floor && p.1.is_finite())
                        .collect()
                };
                let lines = vec![
                    ("D_n".to_string(), seen(found.harmonics)),
                    (
                        "bound on all harmonics beyond n together".to_string(),
                        seen(found.beyond),
                    ),
                ];
                let caption = "amplitudes D_n of the displacement in lifts over the order n";
                (
                    "spectrum",
                    "Harmonics of the cam",
                    vec![Figure::Logarithmic(caption.into(), lines)],
                )
            }
        };
        let title = title.to_string();
        Ok(Section {
            key,
            title,
            figures,
            table,
        })
    };
    let sections: Vec<Section> = parts.iter().map(section).collect::<Result<_, Failure>>()?;
    let mut facts = vec![rows::harmonics_line(machine)];
    facts.extend(charts.iter().map(rows::chart_line));
    Ok(run::page(&machine.name, "oscillator", &facts, &sections))
}
