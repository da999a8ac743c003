//! A line without axes, for a cell of a table.

use maud::{Markup, html};

/// Largest deviation that a line shows as such.
const MOST: f64 = 2.0;

/// Deviations in units of the last digit along the rows of a column. Those beyond two units are
/// marked at the edge.
pub fn deviations(name: &str, units: &[f64]) -> Markup {
    let (w, h) = (2.5 * units.len().max(2) as f64, 24.0);
    let x = |k: usize| 2.5 * (k as f64 + 0.5);
    let y = |u: f64| h / 2.0 - u.clamp(-MOST, MOST) / MOST * (h / 2.0 - 2.0);
    let shown = units.iter().enumerate().filter(|u| !u.1.is_nan());
    let line: Vec<String> = shown
        .map(|(k, u)| format!("{:.1},{:.1}", x(k), y(*u)))
        .collect();
    let beyond = units.iter().enumerate().filter(|u| !(u.1.abs() <= MOST));
    html! {
        svg.spark viewBox={ "0 0 " (w) " " (h) } width=(w) height=(h) role="img" aria-label={
            "deviations of " (name) " by row"
        } {
            path.zero d={ "M0 " (h / 2.0) "H" (w) } {}
            polyline points=(line.join(" ")) {}
            @for (k, u) in beyond {
                circle cx=(format!("{:.1}", x(k))) cy=(format!("{:.1}", y(*u))) r="2" {
                    title { "row " (k) ": " (crate::report::words::numbers::short(*u)) " units" }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_beyond_the_edge_is_marked() {
        let svg = deviations("I_n", &[0.0, 1.0, -12.0, f64::NAN]).into_string();
        assert_eq!(svg.matches("<circle").count(), 2, "{svg}");
        assert!(
            svg.contains("row 2: -12.00 units") && svg.contains("points=\"1.2,12.0 "),
            "{svg}"
        );
    }

    /// Two and a half pixels a row; the axis in the middle, two units at two pixels from the edge.
    #[test]
    fn a_line_runs_through_its_rows() {
        let svg = deviations("I_n", &[0.0, 1.0, -2.0, -12.0, 2.5]).into_string();
        for part in [
            "viewBox=\"0 0 12.5 24\" width=\"12.5\" height=\"24\"",
            "aria-label=\"deviations of I_n by row\"",
            "d=\"M0 12H12.5\"",
            "points=\"1.2,12.0 3.8,7.0 6.2,22.0 8.8,22.0 11.2,2.0\"",
            "<circle cx=\"8.8\" cy=\"22.0\" r=\"2\"><title>row 3: -12.00 units</title>",
            "<circle cx=\"11.2\" cy=\"2.0\" r=\"2\"><title>row 4: 2.50 units</title>",
        ] {
            assert!(svg.contains(part), "{part} is missing in {svg}");
        }
        assert_eq!(svg.matches("<circle").count(), 2, "{svg}");
        for units in [&[][..], &[0.0], &[0.0, 0.0]] {
            let svg = deviations("a", units).into_string();
            assert!(svg.contains("viewBox=\"0 0 5 24\""), "{svg}");
        }
    }
}
