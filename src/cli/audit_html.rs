//! The report of an audit as one page without outside parts.

use super::audit_plots as plots;
use super::case;
use super::html::escape;
use super::html_style::CSS;
use super::text::{percent, short};
use mechaudit::audit::{
    Case, ConvergenceReport, Method, MethodReport, OutputStatistics, Settings, convergence,
    hex_float, judge_case_briefly,
};
use mechaudit::audit::{Origin, Verdict, answer_of};
use mechaudit::methods;
use rayon::prelude::*;

/// Failing cases written out for each method.
const FAILURES_SHOWN: usize = 20;

/// What this page has besides the style that all pages share.
const MORE_CSS: &str = "
svg { max-width: 100%; height: auto; font: 11px system-ui, sans-serif; fill: var(--fg); }
svg .axis { stroke: var(--soft); fill: none; } svg .grid { stroke: var(--line); fill: none; }
svg .bar { fill: var(--new); } svg .limit { stroke: var(--bad); stroke-dasharray: 4 3; }
svg polyline { fill: none; stroke-width: 1.6; } svg polyline.s0 { stroke-width: 3; } svg text { fill: var(--soft); }
.s0 { stroke: var(--new); stroke-dasharray: 7 4; } .s1 { stroke: var(--doubt); } .s2 { stroke: var(--good); }
.k0 { color: var(--new); } .k1 { color: var(--doubt); } .k2 { color: var(--good); }
.m0 { fill: #26456e; } .m1 { fill: #3a7ab8; } .m2 { fill: #6ab0c9; } .m3 { fill: #b5d99c; }
.m4 { fill: #f5d76e; } .m5 { fill: #ef8a3c; } .m6 { fill: #b3261e; } .m7 { fill: #ff4fd8; }
.key { display: inline-block; width: .8rem; height: .8rem; border-radius: .15rem; }
svg.key path { stroke: none; } figure { margin: 0; } figcaption { font-size: .85rem; }
pre { background: var(--card); border: 1px solid var(--line); padding: .6rem .8rem; overflow-x: auto;
  font-size: .8rem; line-height: 1.4; }
code.copy { user-select: all; cursor: copy; }
";

/// The page.
pub fn page(reports: &[MethodReport], settings: &Settings, approximations: bool) -> String {
    let good = !reports.is_empty() && reports.iter().all(MethodReport::passed);
    let interrupted = reports.iter().any(|r| r.interrupted);
    let (word, tone) = match good {
        true => ("as expected", "good"),
        false if interrupted => ("interrupted", "bad"),
        false => ("not as expected", "bad"),
    };
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Audit of {} methods</title>\n<style>{CSS}{MORE_CSS}</style>\n</head>\n<body>\n\
         <h1>Audit: <span class=\"t-{tone}\" style=\"color: var(--tone)\">{word}</span></h1>\n\
         <p class=\"soft\">seed {}, {} random cases per region, references from {} to {} bits</p>\n",
        reports.len(),
        settings.seed,
        settings.cases_per_region,
        settings.first_bits,
        settings.last_bits
    );
    out.push_str(&overview(reports));
    for report in reports {
        out.push_str(&method(report, settings));
    }
    if approximations && !interrupted {
        out.push_str(&convergences());
    }
    let version = env!("CARGO_PKG_VERSION");
    out.push_str(&format!(
        "<p class=\"soft\">Written by mechaudit {version}. An ulp is the unit in the last place of \
         the unrounded reference; u is 2<sup>-53</sup>; worst found is the largest of a sample.</p>\n\
         </body>\n</html>\n"
    ));
    out
}

fn overview(reports: &[MethodReport]) -> String {
    let mut out = String::from(
        "<div class=\"scroll\"><table>\n<tr><th class=\"left\">method</th><th>cases</th>\
         <th>passed</th><th>recorded findings</th><th>worst of budget</th><th class=\"left\">\
         verdict</th></tr>\n",
    );
    for r in reports {
        let worst = r
            .outputs
            .iter()
            .map(|o| o.max_of_budget)
            .fold(0.0, f64::max);
        let word = match r.passed() {
            true => "pass",
            false if r.interrupted => "interrupted",
            false => "FAIL",
        };
        let class = if r.passed() { "agrees" } else { "unexplained" };
        out.push_str(&format!(
            "<tr><td class=\"left\"><a href=\"#{0}\">{0}</a></td><td>{1}</td><td>{2}</td><td>{3}</td>\
             <td>{4}</td><td class=\"left {class}\">{word}</td></tr>\n",
            r.method,
            r.cases,
            r.passed,
            r.recorded,
            percent(worst)
        ));
    }
    out.push_str("</table></div>\n");
    out
}

fn method(report: &MethodReport, settings: &Settings) -> String {
    let mut out = format!(
        "<h2 id=\"{0}\">{0}</h2>\n<p>{1}</p>\n<p class=\"soft\">{2}</p>\n",
        report.method,
        escape(report.summary),
        escape(report.source)
    );
    out.push_str(
        "<div class=\"scroll\"><table>\n<tr><th class=\"left\">output</th><th>values</th>\
         <th>worst ulps</th><th>p99</th><th>RMS</th><th>worst u(1+cond)</th><th>of budget</th>\
         <th>worst condition</th><th class=\"left\">errors in ulps</th></tr>\n",
    );
    for o in &report.outputs {
        out.push_str(&output(o));
    }
    out.push_str("</table></div>\n");
    if let Some(method) = methods::find(report.method)
        && is_complex(&*method)
    {
        out.push_str(&maps(&*method, settings));
    }
    out.push_str(&worst(report));
    for law in &report.laws {
        let (mark, class) = if law.worst <= 1.0 {
            ("✓", "k2")
        } else {
            ("✗", "alarm")
        };
        out.push_str(&format!(
            "<p><span class=\"{class}\">{mark}</span> {}: {} <span class=\"soft\">(worst residual {} \
             of what is allowed, {} cases)</span></p>\n",
            law.name,
            escape(law.statement),
            percent(law.worst),
            law.cases
        ));
    }
    for f in report.failures.iter().take(FAILURES_SHOWN) {
        let text = case::text(f, &f.case.reproduce(), 110);
        let text = anstream::adapter::strip_str(&text).to_string();
        out.push_str(&format!("<pre>{}</pre>\n", escape(text.trim_end())));
    }
    let left = report.failures.len().saturating_sub(FAILURES_SHOWN) + report.failures_left_out;
    if left > 0 {
        out.push_str(&format!(
            "<p class=\"alarm\">{left} more failing cases.</p>\n"
        ));
    }
    out
}

fn output(o: &OutputStatistics) -> String {
    let number = |x: f64, there: bool| if there { short(x) } else { "–".into() };
    let some = o.ulps.count > 0;
    let class = if o.max_of_budget > 1.0 {
        "unexplained"
    } else {
        ""
    };
    format!(
        "<tr><td class=\"left\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>\
         <td class=\"{class}\">{}</td><td>{}</td><td class=\"left\">{}</td></tr>\n",
        escape(o.name),
        o.values,
        number(o.ulps.max, some),
        number(o.ulps.p99, some),
        number(o.ulps.rms, some),
        number(o.conditioned.max, o.conditioned.count > 0),
        percent(o.max_of_budget),
        number(o.max_condition, o.conditioned.count > 0),
        plots::histogram(&o.histogram)
    )
}

/// The worst input of each output, to be copied.
fn worst(report: &MethodReport) -> String {
    let mut out = String::from("<details><summary>Worst cases</summary>\n");
    for o in &report.outputs {
        let Some(case) = &o.worst else { continue };
        let hex: Vec<String> = case.input.iter().map(|x| hex_float(*x)).collect();
        let parts = o.parts.map_or(String::new(), |p| {
            format!(
                "; {} ulps from the method, {} from rounding",
                short(p.method),
                short(p.rounding)
            )
        });
        out.push_str(&format!(
            "<p>{} at {} of its budget, {}{parts}:</p>\n<pre><code class=\"copy\">{}</code>\n\
             <code class=\"copy\">{}</code></pre>\n",
            escape(o.name),
            percent(o.max_of_budget),
            escape(case.region),
            escape(&hex.join(",")),
            escape(&case.reproduce())
        ));
    }
    out.push_str("</details>\n");
    out
}

/// Whether the method is a function of one complex variable.
fn is_complex(method: &dyn Method) -> bool {
    let names: Vec<&str> = method.inputs().iter().map(|i| i.name).collect();
    matches!(names[..], [re, im] if re.starts_with("Re ") && im.starts_with("Im "))
}

/// Columns and rows of an error map, and the part of the plane it shows.
const MAP: (usize, usize) = (144, 104);
const LEFT: f64 = -9.0;
const BELOW: f64 = -6.5;
const SIDE: f64 = 0.125;

fn maps(method: &dyn Method, settings: &Settings) -> String {
    let (columns, rows) = MAP;
    let errors: Vec<Vec<f64>> = (0..columns * rows)
        .into_par_iter()
        .map(|i| {
            // Off the middle of its cell by something that is no simple fraction.
            let place = |k: usize, from: f64| from + SIDE * (k as f64 + 0.527_864);
            let input = vec![place(i % columns, LEFT), place(i / columns, BELOW)];
            let answer = answer_of(method, &input);
            let case = Case {
                method: method.name(),
                region: "map",
                input,
                origin: Origin::Line { number: 0 },
            };
            let judgement = judge_case_briefly(method, case, answer, settings).judgement;
            match judgement.verdict {
                Verdict::Pass | Verdict::Over => {
                    judgement.components.iter().map(|c| c.ulps).collect()
                }
                _ => Vec::new(),
            }
        })
        .collect();
    let mut out = String::from("<h3>Errors over the complex plane</h3>\n<div class=\"side\">\n");
    for (o, output) in method.outputs().iter().enumerate() {
        let of = |e: &Vec<f64>| e.get(o).copied().unwrap_or(f64::NAN);
        let ulps: Vec<f64> = errors.iter().map(of).collect();
        let corner = (LEFT, BELOW);
        out.push_str(&format!(
            "<figure>{}<figcaption>{}, ulps at {} points</figcaption></figure>\n",
            plots::map(&ulps, MAP, corner, SIDE),
            escape(output.name),
            ulps.len()
        ));
    }
    out.push_str(&format!("</div>\n{}\n", plots::map_legend()));
    out
}

fn convergences() -> String {
    let mut out = String::from("<h2 id=\"convergence\">Convergence, work and precision</h2>\n");
    let reports: Vec<Result<ConvergenceReport, String>> = methods::approximations()
        .par_iter()
        .map(|a| convergence(&**a))
        .collect();
    let mut good: Vec<ConvergenceReport> = Vec::new();
    for report in reports {
        match report {
            Ok(report) => good.push(report),
            Err(why) => out.push_str(&format!("<p class=\"alarm\">{}</p>\n", escape(&why))),
        }
    }
    // Approximations of the same problem stand in one diagram.
    let mut rest: Vec<&ConvergenceReport> = good.iter().collect();
    while let Some(first) = rest.first().copied() {
        let (same, others) = rest.into_iter().partition(|r| r.summary == first.summary);
        rest = others;
        out.push_str(&problem(&same));
    }
    out
}

fn problem(reports: &[&ConvergenceReport]) -> String {
    let Some(first) = reports.first() else {
        return String::new();
    };
    let names: Vec<&str> = reports.iter().map(|r| r.name).collect();
    let mut out = format!(
        "<h3>{}</h3>\n<p>{}</p>\n<div class=\"side\">\n",
        names.join(", "),
        first.summary
    );
    for (o, name) in first.outputs.iter().enumerate() {
        let mut lines: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
        for r in reports {
            let line = |f: &dyn Fn(&mechaudit::audit::LevelError) -> Option<f64>| {
                let levels = r.levels.iter();
                levels
                    .filter_map(|l| Some((l.work as f64, f(l.errors.get(o)?)?)))
                    .collect()
            };
            let of = if reports.len() > 1 {
                format!("{} ", r.name)
            } else {
                String::new()
            };
            lines.push((format!("{of}total"), line(&|e| Some(e.total))));
            if r.levels
                .iter()
                .flat_map(|l| &l.errors)
                .any(|e| e.method.is_some())
            {
                lines.push((format!("{of}method"), line(&|e| e.method)));
                lines.push((format!("{of}rounding"), line(&|e| e.rounding)));
            }
        }
        let failed = reports
            .iter()
            .flat_map(|r| &r.levels)
            .filter(|l| l.failed.is_some())
            .count();
        let failed = match failed {
            0 => String::new(),
            n => format!("; {n} runs failed"),
        };
        let orders: Vec<String> = reports
            .iter()
            .filter_map(|r| r.fitted[o])
            .map(|x| format!("{x:.2}"))
            .collect();
        out.push_str(&format!(
            "<figure>{}<figcaption>error of {} against {}; order over all levels {}{failed}\
             </figcaption></figure>\n",
            plots::lines(&lines),
            escape(name),
            first.work_unit,
            orders.join(", ")
        ));
    }
    out.push_str("</div>\n");
    out
}
