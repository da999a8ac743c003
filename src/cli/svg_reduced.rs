//! The reduced quantities over the crank angle, in three panels.

use super::failure::Failure;
use mechaudit::solvers::reduction::Reduced;
use plotters::prelude::*;

type Curve = fn(&Reduced) -> f64;

const PANELS: [(&str, RGBColor, Curve); 3] = [
    ("I_n, kg·m²", RGBColor(31, 111, 178), |r| r.inertia_kg_m2),
    ("dI_n/dφ1, kg·m²/rad", RGBColor(194, 87, 26), |r| {
        r.inertia_derivative_kg_m2
    }),
    ("M_o, N·m", RGBColor(47, 143, 78), |r| r.moment_n_m),
];

/// The drawing of (crank angle in degrees, reduced quantities).
///
/// Beside the ends of a branch the quantities grow without bound; where the rows are not a `whole`
/// turn, the vertical range is that of their middle nine tenths.
pub fn draw(name: &str, rows: &[(f64, Reduced)], whole: bool) -> Result<String, Failure> {
    let mut out = String::new();
    panels(&mut out, name, rows, whole).map_err(|e| Failure::new(format!("cannot draw: {e}")))?;
    Ok(out)
}

fn panels(
    out: &mut String,
    name: &str,
    rows: &[(f64, Reduced)],
    whole: bool,
) -> Result<(), Box<dyn std::error::Error>> {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
        return Ok(());
    };
    let root = SVGBackend::with_string(out, (1000, 1080)).into_drawing_area();
    root.fill(&WHITE)?;
    let ink = RGBColor(29, 33, 37);
    let title = ("sans-serif", 24).into_font().color(&ink);
    root.draw(&Text::new(name.to_string(), (24, 20), title))?;
    if !whole {
        let note = "the crank does not turn fully; beyond the drawing the curves grow without bound at both ends";
        let font = ("sans-serif", 15)
            .into_font()
            .color(&RGBColor(91, 100, 109));
        root.draw(&Text::new(note, (24, 46), font))?;
    }
    let body = root.margin(68, 10, 10, 24);
    for (k, (area, (label, colour, curve))) in
        body.split_evenly((3, 1)).iter().zip(PANELS).enumerate()
    {
        let skip = if whole { 0 } else { rows.len() / 20 };
        let middle = &rows[skip..rows.len() - skip];
        let (low, high) = padded(middle.iter().map(|(_, r)| curve(r)));
        let mut chart = ChartBuilder::on(area)
            .margin(8)
            .x_label_area_size(if k == 2 { 48 } else { 28 })
            .y_label_area_size(84)
            .build_cartesian_2d(first.0..last.0, low..high)?;
        chart
            .configure_mesh()
            .x_labels(13)
            .y_labels(7)
            .x_label_formatter(&|x| format!("{x:.0}"))
            .y_label_formatter(&|y| tick(*y))
            .x_desc(if k == 2 {
                "crank angle φ1, degrees"
            } else {
                ""
            })
            .y_desc(label)
            .label_style(("sans-serif", 15).into_font().color(&ink))
            .axis_desc_style(("sans-serif", 17).into_font().color(&ink))
            .axis_style(RGBColor(120, 128, 136))
            .bold_line_style(RGBColor(220, 224, 227))
            .light_line_style(TRANSPARENT)
            .draw()?;
        if low < 0.0 && high > 0.0 {
            let zero = [(first.0, 0.0), (last.0, 0.0)];
            chart.draw_series(LineSeries::new(
                zero,
                RGBColor(120, 128, 136).stroke_width(1),
            ))?;
        }
        let line: Vec<(f64, f64)> = rows.iter().map(|(x, r)| (*x, curve(r))).collect();
        for part in line.split(|p| !(low..=high).contains(&p.1)) {
            let part = part.iter().copied();
            chart.draw_series(LineSeries::new(part, colour.stroke_width(2)))?;
        }
    }
    root.present()?;
    drop(body);
    Ok(())
}

/// A tick's label without needless zeros.
pub(super) fn tick(y: f64) -> String {
    match y.abs() {
        0.0 => "0".into(),
        size if (1e-3..1e6).contains(&size) => ((y * 1e6).round() / 1e6).to_string(),
        _ => format!("{y:.2e}"),
    }
}

/// The range of the values with some air; zero belongs to it where it is near.
pub(super) fn padded(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for v in values.filter(|v| v.is_finite()) {
        low = low.min(v);
        high = high.max(v);
    }
    if !(low <= high) {
        return (-1.0, 1.0);
    }
    let size = high - low;
    if low > 0.0 && low < 0.3 * high {
        low = 0.0;
    }
    let air = if size > 0.0 {
        0.05 * size
    } else {
        0.5 * high.abs().max(1.0)
    };
    (low - if low == 0.0 { 0.0 } else { air }, high + air)
}

#[cfg(test)]
mod tests {
    use super::padded;

    #[test]
    fn ranges_have_air_and_size() {
        assert_eq!(padded([1.0, 11.0].into_iter()), (0.0, 11.5));
        let (a, b) = padded([3.0, 3.0].into_iter());
        assert!(a < 3.0 && b > 3.0);
        assert_eq!(padded([f64::NAN].into_iter()), (-1.0, 1.0));
    }
}
