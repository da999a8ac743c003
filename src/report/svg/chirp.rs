//! Drawings of a cam-driven oscillator: its motion over time, charts, the cam's spectrum.

pub use super::panel::tick;
use super::panel::{Curve, Panel, curve, dashed, drawn, legend, titled};
use super::style::{BLUE, GREEN, ORANGE};
use crate::report::axis::Axis;
use crate::solvers::chirp_chart::{Chart, ChartPoint, Period};

/// A wave that fills its columns is drawn finer.
fn finely(curve: Curve) -> Curve {
    Curve { width: 1, ..curve }
}

/// One column of a history.
pub struct Column {
    /// Its start and its middle, in seconds.
    pub times: [f64; 2],
    /// Least and largest `y`, `f` and `y″`.
    pub ranges: [[f64; 2]; 3],
    /// Bound on the distance of `y` from its mean.
    pub envelope: f64,
    /// The shaft's speed in rad/s.
    pub speed: f64,
}

/// A history; with the least and the largest value in each column it looks like all of them.
pub struct History<'a> {
    /// The moving mechanism.
    pub name: &'a str,
    /// A line about it.
    pub note: String,
    /// Unit of displacements.
    pub unit: &'a str,
    /// Mean of `y`.
    pub mean: f64,
    /// From the start to the end.
    pub columns: Vec<Column>,
}

/// The motion over time.
pub fn history(history: &History) -> String {
    let panels = history_panels(history);
    drawn((1000, 1080), |root, page| {
        let areas = titled(root, page, history.name, &history.note).split(panels.len(), 1);
        for (area, panel) in areas.iter().zip(&panels) {
            panel.draw(area, page);
        }
    })
}

/// Displacements, acceleration and speed over time.
pub fn history_panels(history: &History) -> [Panel; 3] {
    let all = &history.columns;
    let thinned = |i: usize| -> Vec<(f64, f64)> {
        let ends = all.iter().flat_map(|b| {
            let [low, high] = b.ranges[i];
            [(b.times[0], low), (b.times[1], high)]
        });
        ends.collect()
    };
    let along = |f: &dyn Fn(&Column) -> f64| -> Vec<(f64, f64)> {
        all.iter().map(|b| (b.times[0], f(b))).collect()
    };
    let (mean, unit) = (history.mean, history.unit);
    let motion = [
        finely(curve("cam f", thinned(1), GREEN)),
        finely(curve("y", thinned(0), BLUE)),
        dashed("envelope", along(&|b| mean + b.envelope), ORANGE),
        dashed("", along(&|b| mean - b.envelope), ORANGE),
    ];
    let acceleration = [finely(curve("y″", thinned(2), BLUE))];
    let speed = [curve("shaft", along(&|b| b.speed), ORANGE)];
    [
        Panel::new("time, s", format!("displacement, {unit}"), motion),
        Panel::new("time, s", format!("acceleration, {unit}/s²"), acceleration),
        Panel::new("time, s", "speed, rad/s", speed),
    ]
}

/// C_φ(ξ) of each law, formula against true peak, under a name and a line about it.
pub fn chart(name: &str, note: &str, charts: &[(&str, &Chart)]) -> String {
    let rows = charts.len();
    drawn((1240, 100 + 360 * rows as u32), |root, page| {
        let areas = titled(root, page, name, note).split(rows, 2);
        for (charted, pair) in charts.iter().zip(areas.chunks(2)) {
            let panels = chart_panels(charted);
            for (area, panel) in pair.iter().zip(&panels) {
                panel.draw(area, page);
            }
        }
    })
}

/// Displacement and acceleration of a law over the frequency criterion.
pub fn chart_panels((law, chart): &(&str, &Chart)) -> [Panel; 2] {
    let xi = match chart.period {
        Period::Turn => "ξ, the turn as period",
        Period::Rise => "ξ, the rise as period",
    };
    let along = |f: fn(&ChartPoint) -> f64| -> Vec<(f64, f64)> {
        chart.points.iter().map(|p| (chart.xi(p), f(p))).collect()
    };
    let displacement = [
        curve("true peak of |y − a_0|", along(|p| p.displacement), BLUE),
        dashed("formula (19), Σ|A_k|", along(|p| p.bound), ORANGE),
    ];
    let points = chart.points.iter();
    let rigid = points.map(|p| (chart.xi(p), chart.rigid[0]));
    let acceleration = [
        curve("true peak C_φ", along(|p| p.acceleration), BLUE),
        dashed("w² Σ|D_k − A_k|", along(|p| p.acceleration_bound), ORANGE),
        curve("C", rigid.collect(), GREEN),
    ];
    [
        Panel::new(xi, format!("{law}: displacement, lifts"), displacement),
        Panel::new(xi, format!("{law}: C_φ, h(Ω/β)²"), acceleration),
    ]
}

/// The spectrum of a cam's displacement, in lifts.
pub struct Spectrum<'a> {
    /// The moving mechanism.
    pub name: &'a str,
    /// The cam's law.
    pub law: &'a str,
    /// Order and amplitude of each harmonic.
    pub harmonics: Vec<(f64, f64)>,
    /// Order, and a bound on all harmonics beyond it together.
    pub beyond: Vec<(f64, f64)>,
}

/// The harmonics of the cam's displacement.
pub fn spectrum(spectrum: &Spectrum) -> String {
    let lines = &spectrum.harmonics;
    let largest = lines.iter().map(|l| l.1).fold(f64::MIN_POSITIVE, f64::max);
    // Harmonics that vanish have no place on the axis.
    let floor = lines.iter().map(|l| l.1).filter(|d| *d > 1e-9 * largest);
    let low = 10f64.powf(floor.fold(largest, f64::min).log10().floor());
    let beyond = spectrum.beyond.iter();
    let rest: Vec<(f64, f64)> = beyond
        .filter(|p| p.1 >= low && p.1.is_finite())
        .copied()
        .collect();
    let high = rest.iter().map(|p| p.1).fold(largest, f64::max);
    let high = 10f64.powf(high.log10().ceil());
    let last = lines.iter().map(|l| l.0).fold(10.0, f64::max);
    drawn((1000, 640), |root, page| {
        let note = format!(
            "law {}, amplitudes D_n of the displacement in lifts",
            spectrum.law
        );
        let area = titled(root, page, spectrum.name, &note);
        let log = |(n, d): &(f64, f64)| (n.log10(), d.log10());
        let (orders, sizes) = ((0.9, last * 1.1), (low, high));
        let axes = [
            Axis::decades("harmonic n", log(&orders), 10, |n| {
                tick(10f64.powf(n).round())
            }),
            Axis::decades("D_n, lifts", log(&sizes), 10, |d| format!("1e{d:.0}")),
        ];
        let place = page.axes(&area, axes, true);
        for line in lines.iter().filter(|l| l.1 > low) {
            let stem = [(line.0, low), *line].iter().map(log).collect();
            page.line(&place, &finely(curve("", stem, BLUE)));
            page.dot(&place, log(line), BLUE);
        }
        let rest = rest.iter().map(log).collect();
        page.line(&place, &dashed("", rest, ORANGE));
        let names = [
            curve("D_n", Vec::new(), BLUE),
            dashed(
                "bound on all harmonics beyond n together",
                Vec::new(),
                ORANGE,
            ),
        ];
        legend(&area, page, &names);
    })
}

#[cfg(test)]
mod tests;
