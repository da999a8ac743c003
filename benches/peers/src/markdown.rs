//! Markdown tables.

use crate::report::{Report, differences, error, ratios, repeats};
use crate::special::SpecialValue;
use crate::speed::{RegionTimings, Statistic};
use std::fmt::Write;

/// The whole report.
pub fn report(report: &Report) -> String {
    let mut s = format!("Compiled for {}.\n\n", report.compiled_for);
    for c in &report.codes {
        let _ = writeln!(s, "- {}: {}", c.code, c.version);
    }
    for m in &report.missing {
        let _ = writeln!(s, "- {}: **missing**: {}", m.name, m.reason);
    }
    if let Some(a) = &report.accuracy {
        let _ = writeln!(
            s,
            "\nAccuracy, {} points a region, seed {}, reference certified to {} bits: worst found / \
             99th percentile / root mean square.\n",
            a.settings.points, a.settings.seed, a.reference_bits
        );
        let names: Vec<&str> = a.regions.iter().map(|r| r.region).collect();
        for r in &a.regions {
            let _ = writeln!(s, "- {}: {}", r.region, r.description.replace('|', "\\|"));
        }
        let measures = [
            "Normwise, relative error / 2^-52",
            "Real part, relative error / 2^-52",
            "Imaginary part, relative error / 2^-52",
            "Real part, ulps",
            "Imaginary part, ulps",
        ];
        let codes = a.regions.first().map_or(0, |r| r.codes.len());
        for (m, measure) in measures.iter().enumerate() {
            heading(&mut s, measure, &names);
            for i in (0..codes).filter(|&i| !repeats(&a.regions, i)) {
                let _ = write!(s, "| {} |", a.regions[0].codes[i].code);
                for r in &a.regions {
                    let spread = r.codes[i].spreads()[m];
                    let cell = [spread.worst(), spread.p99(), spread.rms()].map(error);
                    let _ = write!(s, " {} |", cell.join(" / "));
                }
                s.push('\n');
            }
        }
        heading(&mut s, "Values of the wrong kind", &names);
        for i in (0..codes).filter(|&i| !repeats(&a.regions, i)) {
            let _ = write!(s, "| {} |", a.regions[0].codes[i].code);
            for r in &a.regions {
                let c = &r.codes[i];
                let _ = write!(s, " {}", c.wrong_kind);
                if c.panics > 0 {
                    let _ = write!(s, ", {} of them panics", c.panics);
                }
                if c.undecided > 0 {
                    let _ = write!(s, ", {} undecided", c.undecided);
                }
                s.push_str(" |");
            }
            s.push('\n');
        }
        s.push('\n');
        for line in differences(&a.regions) {
            let _ = writeln!(s, "{line}.");
        }
    }
    if let Some(values) = &report.special_values {
        special(&mut s, values);
    }
    if let Some(sp) = &report.speed {
        let names: Vec<&str> = sp.regions.iter().map(|r| r.region).collect();
        let _ = writeln!(
            s,
            "\nSpeed, one thread, {} points a region, seed {}, {} passes in random order, codes \
             interleaved in blocks of {}.",
            sp.settings.points, sp.settings.seed, sp.settings.passes, sp.block
        );
        for (statistic, name) in Statistic::ALL {
            heading(&mut s, &format!("ns per value, {name}"), &names);
            speeds(&mut s, &sp.regions, statistic);
        }
    }
    s
}

fn speeds(s: &mut String, regions: &[RegionTimings], statistic: Statistic) {
    let rows = regions.first().map_or(0, |t| t.codes.len());
    for i in 0..rows {
        let _ = write!(s, "| {} |", regions[0].codes[i].code);
        for t in regions {
            let _ = write!(s, " {:.1} |", t.codes[i].ns(statistic));
        }
        s.push('\n');
    }
    for (name, row) in ratios(regions, statistic) {
        let _ = write!(s, "| best peer / {name} |");
        for x in row {
            let _ = write!(s, " {x:.2} |");
        }
        s.push('\n');
    }
}

fn heading(s: &mut String, title: &str, columns: &[&str]) {
    let _ = writeln!(s, "\n| {title} | {} |", columns.join(" | "));
    let _ = writeln!(s, "|---|{}", "---|".repeat(columns.len()));
}

fn special(s: &mut String, values: &[SpecialValue]) {
    let Some(first) = values.first() else { return };
    let codes: Vec<&str> = first.answers.iter().map(|a| a.code.as_str()).collect();
    s.push_str("\nSpecial values: error of the worse part in ulps, or the wrong answer.\n");
    let mut columns = vec!["right"];
    columns.extend(codes);
    heading(s, "z", &columns);
    for v in values {
        let _ = write!(s, "| {} | {} |", v.z, v.right);
        for a in &v.answers {
            let cell = match (a.right_kind, a.ulps) {
                (true, Some(u)) => error(u),
                (true, None) => "right".into(),
                (false, _) => format!("**{}**", a.value),
            };
            let _ = write!(s, " {cell} |");
        }
        s.push('\n');
    }
}
