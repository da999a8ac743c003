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
    use crate::report::gallery::Gallery;

    /// Through the rows; what is beyond the edge or no number is marked.
    #[test]
    fn lines() {
        let mut all = Gallery::default();
        for units in [&[][..], &[0.0], &[0.0, 1.0, -2.0, -12.0, 2.5, f64::NAN]] {
            all.add(format!("{units:?}"), deviations("I_n", units).into_string());
        }
        all.pin("sparks");
    }
}
