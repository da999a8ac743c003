//! The tables of the atlas.

use crate::claims::{Atlas, Figures, Row};
use crate::report::atlas::height;
use maud::{Markup, html};

/// Worst errors region by region.
pub fn rows(found: &Atlas) -> Markup {
    html! {
        section { "\n"
            h2 #rows { "Worst errors" } "\n"
            p.soft.small {
                "Ordinary: |Re z| < 8, Im z = 0.1..8; beside the axis: Im z = 1e-8..0.1; grid: Re z a multiple of "
                "1/4, Im z = 1e-12..0.1; wings: |Re z| = 8..1e4 beside the axis. "
                "wrong: NaN or infinity where a number is due; huge: those for |z| = 1e8..1e300. Re < 0: answers of a "
                "negative Re W where it is positive. seam: the largest relative jump of Re W between neighbouring "
                "floats where formulas meet; rising: crossings at which Re W rises away from the imaginary axis. W': by "
                "the identity, ordinary."
            } "\n"
            div.scroll tabindex="0" { table.sortable #rows-table { "\n"
                thead { tr {
                    th.left { "code" }
                    th { "norm" } th { "99 %" } th { "median" } th { "Re" } th { "Im" }
                    th { "beside: norm" } th { "Re" } th { "grid: Re" } th { "wings: Re" } th { "lower: norm" }
                    th { "wrong" } th { "huge" } th { "Re < 0" } th { "seam" } th { "rising" } th { "W'" } th { "ns" }
                } } "\n"
                tbody { "\n" @for row in &found.rows { (line(row)) } } "\n"
            } } "\n"
        } "\n"
    }
}

/// How bad an error is, by decades, for its shade.
fn shade(x: f64) -> &'static str {
    match x {
        x if x <= 1e-14 => "h0",
        x if x <= 1e-9 => "h1",
        x if x <= 1e-6 => "h2",
        x if x <= 1e-4 => "h3",
        x if x <= 1e-2 => "h4",
        _ => "h5",
    }
}

fn error(x: Option<f64>) -> Markup {
    html! {
        @match x {
            Some(x) => td.(shade(x)) data-v=(format!("{x:e}")) { (format!("{x:.1e}")) },
            None => td data-v="-1" { "–" },
        }
    }
}

fn count(n: u64) -> Markup {
    html! { td data-v=(n) { @if n > 0 { (n) } @else { "–" } } }
}

fn line(row: &Row) -> Markup {
    let ordinary = row.part("ordinary");
    let norm = |region: &str| row.part(region).and_then(|p| p.norm.as_ref());
    let of = |f: Option<&Figures>, part: fn(&Figures) -> f64| error(f.map(part));
    let re = |region: &str| error(row.part(region).and_then(|p| p.re));
    let all = row.part("all");
    let huge = row.part("huge").map_or(0, |p| p.wrong);
    let jump = row.jumps.iter().map(|j| j.re).reduce(f64::max);
    let rising: u64 = row.jumps.iter().map(|j| j.rising).sum();
    html! {
        tr {
            td.left title=(row.source) { (row.name) }
            (of(norm("ordinary"), |f| f.worst)) (of(norm("ordinary"), |f| f.p99)) (of(norm("ordinary"), |f| f.median))
            (re("ordinary")) (error(ordinary.and_then(|p| p.im)))
            (of(norm("beside-axis"), |f| f.worst)) (re("beside-axis")) (re("grid")) (re("wings"))
            (of(norm("lower"), |f| f.worst))
            (count(all.map_or(0, |p| p.wrong) - huge)) (count(huge)) (count(all.map_or(0, |p| p.negative)))
            (error(jump)) (count(rising)) (of(row.derivative.as_ref(), |f| f.worst))
            (time(row))
        } "\n"
    }
}

/// From which Im z on an accuracy is reached.
pub fn heights(found: &Atlas) -> Markup {
    html! {
        section { "\n"
            h2 #heights { "Accuracy by the distance to the axis" } "\n"
            p.soft.small {
                "From which Im z on no larger error was found, |Re z| < 1e5, Im z < 1e3; “all” is every Im z ≥ 0."
            } "\n"
            div.scroll tabindex="0" { table #heights-table { "\n"
                thead { tr {
                    th.left { "code" }
                    @for target in ["1e-4", "1e-6", "1e-10", "2 ε"] {
                        th { (target) " of the norm" } th { "of each part" }
                    }
                } } "\n"
                tbody { "\n"
                    @for row in &found.rows {
                        tr {
                            td.left { (row.name) }
                            @for h in &row.heights { (reached(h.norm)) (reached(h.parts)) }
                        } "\n"
                    }
                } "\n"
            } } "\n"
        } "\n"
    }
}

/// The Hartmann–Tran profile.
pub fn lines(found: &Atlas) -> Markup {
    let regions = [
        "doppler",
        "mixed",
        "collisions",
        "wings",
        "no-quadratic",
        "rautian",
    ];
    html! {
        section { "\n"
            h2 #lines { "Hartmann-Tran profile" } "\n"
            p.soft.small {
                "Worst relative errors of the norm and of Re found, against a certified reference of its own: Gamma_0 of "
                "1e-5..0.1 (doppler), 0.1..10 (mixed), 10..1000 Doppler widths (collisions) within 8 widths of the centre, "
                "any ratio farther out (wings), without quadratic terms, and without shifts and correlation (rautian)."
            } "\n"
            div.scroll tabindex="0" { table #lines-table { "\n"
                thead { tr {
                    th.left { "code" }
                    @for region in regions { th { (region) ": norm" } th { "Re" } }
                    th { "wrong" } th { "Re < 0" } th { "ns" }
                } } "\n"
                tbody { "\n"
                    @for row in &found.profiles {
                        tr {
                            td.left title=(row.source) { (row.name) }
                            @for region in regions {
                                @let part = row.part(region).filter(|p| p.cases > 0);
                                (error(part.and_then(|p| p.norm.as_ref()).map(|f| f.worst)))
                                (error(part.and_then(|p| p.re)))
                            }
                            (count(row.part("all").map_or(0, |p| p.wrong)))
                            (count(row.part("all").map_or(0, |p| p.negative)))
                            (time(row))
                        } "\n"
                    }
                } "\n"
            } } "\n"
        } "\n"
    }
}

fn time(row: &Row) -> Markup {
    html! {
        @match row.nanoseconds {
            Some(ns) => td data-v=(format!("{ns:.2}")) { (format!("{ns:.0}")) },
            None => td data-v="-1" { "–" },
        }
    }
}

fn reached(h: Option<f64>) -> Markup {
    html! {
        @match h {
            Some(f64::NEG_INFINITY) => td.h0 { "all" },
            Some(y) => td { (height(y)) },
            None => td { "–" },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shades_change_above_their_limits() {
        let limits = [1e-14, 1e-9, 1e-6, 1e-4, 1e-2];
        let shades = ["h0", "h1", "h2", "h3", "h4", "h5"];
        for (k, limit) in limits.into_iter().enumerate() {
            assert_eq!(shade(limit), shades[k], "{limit}");
            assert_eq!(shade(limit * 1.001), shades[k + 1], "{limit}");
        }
        assert_eq!(shade(f64::NAN), "h5");
    }
}
