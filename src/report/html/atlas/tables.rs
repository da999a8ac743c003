//! The tables of the atlas.

use crate::claims::{Atlas, Figures, Row};
use crate::report::atlas::{height, worst_jump};
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
    let rising: u64 = row.jumps.iter().map(|j| j.rising).sum();
    html! {
        tr {
            td.left.region data-v=(row.name) { (row.name) small.meaning { (row.source) } }
            (of(norm("ordinary"), |f| f.worst)) (of(norm("ordinary"), |f| f.p99)) (of(norm("ordinary"), |f| f.median))
            (re("ordinary")) (error(ordinary.and_then(|p| p.im)))
            (of(norm("beside-axis"), |f| f.worst)) (re("beside-axis")) (re("grid")) (re("wings"))
            (of(norm("lower"), |f| f.worst))
            (count(all.map_or(0, |p| p.wrong) - huge)) (count(huge)) (count(all.map_or(0, |p| p.negative)))
            (error(worst_jump(row))) (count(rising)) (of(row.derivative.as_ref(), |f| f.worst))
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
                            td.left.region { (row.name) small.meaning { (row.source) } }
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

    /// The cells of each line of a table's body, with what they sort by where they say it.
    fn cells(html: &str) -> Vec<Vec<(String, String)>> {
        let body = html.split("<tbody>").nth(1).unwrap();
        let rows = body.split("<tr>").skip(1);
        let cell = |td: &str| {
            let (tag, text) = td.split_once('>').unwrap();
            let key = tag
                .split("data-v=\"")
                .nth(1)
                .map(|v| v.split('"').next().unwrap());
            let text = text.split('<').next().unwrap();
            (text.to_string(), key.unwrap_or("").to_string())
        };
        rows.map(|r| r.split("<td").skip(1).map(cell).collect())
            .collect()
    }

    fn texts(html: &str) -> Vec<String> {
        let rows = cells(html).into_iter();
        let line = |r: Vec<(String, String)>| r.into_iter().map(|c| c.0).collect::<Vec<_>>();
        rows.map(|r| line(r).join(" ")).collect()
    }

    #[test]
    fn every_table_has_a_line_for_each_code() {
        let found = crate::report::atlas::tests::fabricated();
        assert_eq!(
            texts(&rows(&found).into_string()),
            [
                "first 1.0e-3 1.0e-4 1.0e-5 2.0e-3 3.0e-3 1.5e-2 4.0e-2 5.0e-2 6.0e-2 7.0e-2 3 2 7 3.0e-9 3 8.0e-3 12",
                "bare – – – – – – – – – – – – – – – – –",
            ]
        );
        assert_eq!(
            texts(&heights(&found).into_string()),
            ["first all all all 1e-3 1e-20 – – –", "bare – – – – – – – –"]
        );
        assert_eq!(
            texts(&lines(&found).into_string()),
            [
                "profile 2.0e-3 1.0e-3 – – – – – 2.0e-3 – – – – 1 3 100",
                "second – – – – – – – 5.0e-1 – – – – – – –",
            ]
        );
    }

    #[test]
    fn cells_sort_by_their_numbers_and_what_is_unknown_comes_first() {
        let found = crate::report::atlas::tests::fabricated();
        let all = cells(&rows(&found).into_string());
        let keys = |k: usize| all[k].iter().map(|c| &*c.1).collect::<Vec<_>>();
        assert_eq!(keys(0)[1], "1e-3");
        assert_eq!(keys(0)[11..14], ["3", "2", "7"]);
        assert_eq!(keys(0)[17], "12.35");
        assert_eq!(keys(1)[1..11], ["-1"; 10]);
        assert_eq!(keys(1)[11..14], ["0"; 3]);
        assert_eq!(keys(1)[17], "-1");
    }
}
