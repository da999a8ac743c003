//! Text tables, at most 100 columns wide.

use crate::report::{Report, differences, error, ratios, repeats};
use crate::special::SpecialValue;
use crate::speed::{RegionTimings, Statistic};
use std::fmt::Write;

const WIDTH: usize = 100;

/// The whole report.
pub fn report(report: &Report) -> String {
    let mut s = String::new();
    let _ = writeln!(s, "W(z): compiled for {}", report.compiled_for);
    for c in &report.codes {
        let _ = writeln!(s, "  {:<18} {}", c.code, c.version);
    }
    for m in &report.missing {
        let words: Vec<String> = m.reason.split(' ').map(str::to_owned).collect();
        wrapped(&mut s, &format!("  {:<18} MISSING: ", m.name), &words, " ");
    }
    if let Some(a) = &report.accuracy {
        let _ = writeln!(
            s,
            "\nAccuracy: {} points a region, seed {}, reference certified to {} bits.\n\
             eps: relative error / 2^-52, of W (normwise) and of each part by itself; ulp: of the \
             part.\nworst = worst found; kind = NaN or an infinity where a finite value is due.",
            a.settings.points, a.settings.seed, a.reference_bits
        );
        for region in &a.regions {
            let _ = writeln!(s, "\n{}: {}", region.region, region.description);
            let _ = writeln!(
                s,
                "{:18}{:>21}{:>21}{:>21}{:>13}",
                "", "normwise, eps", "Re, eps", "Im, eps", "worst, ulp"
            );
            let _ = write!(s, "{:18}", "");
            for _ in 0..3 {
                let _ = write!(s, "{:>7}{:>7}{:>7}", "worst", "p99", "rms");
            }
            let _ = writeln!(s, "{:>7}{:>6}{:>6}", "Re", "Im", "kind");
            for (i, code) in region.codes.iter().enumerate() {
                if repeats(&a.regions, i) {
                    continue;
                }
                let _ = write!(s, "{:18}", code.code);
                for (_, spread) in &code.spreads()[..3] {
                    for x in [spread.worst(), spread.p99(), spread.rms()] {
                        let _ = write!(s, "{:>7}", error(x));
                    }
                }
                let ulps = [&code.re_ulps, &code.im_ulps].map(|s| error(s.worst()));
                let _ = write!(s, "{:>7}{:>6}{:>6}", ulps[0], ulps[1], code.wrong_kind);
                if code.panics > 0 {
                    let _ = write!(s, "  {} panics", code.panics);
                }
                if code.undecided > 0 {
                    let _ = write!(s, "  {} UNDECIDED", code.undecided);
                }
                s.push('\n');
            }
        }
        for line in differences(&a.regions) {
            let _ = writeln!(s, "{line}");
        }
    }
    if let Some(values) = &report.special_values {
        s.push_str("\nSpecial values (errors in ulps of the worse part)\n");
        for v in values {
            special(&mut s, v);
        }
    }
    if let Some(sp) = &report.speed {
        let core = sp
            .core
            .map_or("not bound to a core".into(), |c| format!("core {c}"));
        let _ = writeln!(
            s,
            "\nSpeed: ns per value, one thread, {core}; {} points a region, seed {}, {} passes in \
             random order,\ncodes interleaved in blocks of {}.",
            sp.settings.points, sp.settings.seed, sp.settings.passes, sp.block
        );
        for (statistic, name) in Statistic::ALL {
            let _ = writeln!(s, "\nThe {name}:");
            speeds(&mut s, &sp.regions, statistic);
        }
    }
    s
}

fn speeds(s: &mut String, regions: &[RegionTimings], statistic: Statistic) {
    let _ = write!(s, "{:<32}", "");
    for t in regions {
        let _ = write!(s, "{:>9}", t.region);
    }
    s.push('\n');
    let rows = regions.first().map_or(0, |t| t.codes.len());
    for i in 0..rows {
        let _ = write!(s, "{:<32}", regions[0].codes[i].code);
        for t in regions {
            let _ = write!(s, "{:>9.1}", t.codes[i].ns(statistic));
        }
        s.push('\n');
    }
    for (name, row) in ratios(regions, statistic) {
        let _ = write!(s, "{:<32}", format!("best peer / {name}"));
        for x in row {
            let _ = write!(s, "{:>9}", format!("{x:.2}x"));
        }
        s.push('\n');
    }
}

fn special(s: &mut String, v: &SpecialValue) {
    let _ = writeln!(s, "  W({}) = {}", v.z, v.right);
    let (mut right, mut wrong) = (Vec::new(), Vec::new());
    for a in &v.answers {
        match (a.right_kind, a.ulps) {
            (true, Some(u)) => right.push(format!("{} {}", a.code, error(u))),
            (true, None) => right.push(a.code.clone()),
            (false, _) => wrong.push(format!("{}: {}", a.code, a.value)),
        }
    }
    if !right.is_empty() {
        wrapped(s, "      right  ", &right, ", ");
    }
    if !wrong.is_empty() {
        wrapped(s, "      WRONG  ", &wrong, "; ");
    }
}

/// Items with separators, broken into lines under the heading.
fn wrapped(s: &mut String, heading: &str, items: &[String], separator: &str) {
    let mut line = heading.to_owned();
    let indent = " ".repeat(heading.chars().count());
    let mut empty = true;
    for item in items {
        let needed = line.chars().count() + separator.len() + item.chars().count();
        if !empty && needed > WIDTH {
            line.push_str(separator.trim_end());
            let _ = writeln!(s, "{line}");
            line.clone_from(&indent);
        } else if !empty {
            line.push_str(separator);
        }
        line.push_str(item);
        empty = false;
    }
    let _ = writeln!(s, "{line}");
}
