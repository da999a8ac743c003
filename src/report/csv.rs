//! A paper's entries as CSV, one line for each printed entry and variant of the data; the statistics of
//! an audit as CSV, one line for each region and output.

use super::words::paper::entry;
use crate::audit::{Comparison, Kind, MethodReport, OutputStatistics, RegionReport, Spread};
use crate::papers::PaperReport;
use std::io::Write;

/// The columns of [`audit`] before the wrong kinds.
const AUDIT: [&str; 33] = [
    "method",
    "candidate",
    "region",
    "output",
    "budget",
    "cases",
    "passed",
    "recorded",
    "over",
    "undecided",
    "reference_failed",
    "values",
    "worst_ulps",
    "p99_ulps",
    "median_ulps",
    "rms_ulps",
    "beyond_ulps",
    "worst_u_1_plus_cond",
    "p99_u_1_plus_cond",
    "median_u_1_plus_cond",
    "rms_u_1_plus_cond",
    "worst_normwise_u",
    "p99_normwise_u",
    "median_normwise_u",
    "rms_normwise_u",
    "max_of_budget",
    "max_condition",
    "wrong",
    "worst_output_of_budget",
    "interrupted",
    "seed",
    "cases_per_region",
    "reproduce_worst",
];

/// Writes the statistics of audits: for each method and region (`all` last) a line for all outputs
/// (`all`), which has the normwise errors and the wrong kinds of whole answers, and a line for each
/// output. A field without a number is empty.
pub fn audit(reports: &[MethodReport], out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let mut csv = ::csv::Writer::from_writer(out);
    let kinds = Kind::ALL.iter().map(|k| k.key());
    csv.write_record(AUDIT.into_iter().chain(kinds))?;
    for report in reports {
        for region in report.regions.iter().chain([&report.total]) {
            csv.write_record(line(report, region, None))?;
            for output in &region.outputs {
                csv.write_record(line(report, region, Some(output)))?;
            }
        }
    }
    Ok(csv.flush()?)
}

/// Worst, 99th percentile, median and root mean square.
fn figures(spread: Option<&Spread>) -> [String; 4] {
    match spread.filter(|s| s.count > 0) {
        Some(s) => [s.max, s.p99, s.median, s.rms].map(|x| format!("{x:e}")),
        None => Default::default(),
    }
}

fn line(
    report: &MethodReport,
    region: &RegionReport,
    output: Option<&OutputStatistics>,
) -> Vec<String> {
    let limit = |o: &OutputStatistics| {
        let own = report.budgets.iter().find(|b| b.name == o.name);
        own.map_or(String::new(), |b| b.budget.limit.to_string())
    };
    let norm = report.norm_budget;
    let norm = norm.map_or(String::new(), |n| n.shown(report.format));
    let candidate = report.candidate.as_ref();
    let mut fields = vec![
        report.method.to_string(),
        candidate.map_or(String::new(), |c| c.name.clone()),
        region.name.into(),
        output.map_or("all", |o| o.name).into(),
        output.map_or(norm, limit),
    ];
    let counts = [
        region.cases,
        region.passed,
        region.recorded,
        region.over,
        region.undecided,
        region.reference_failed,
    ];
    fields.extend(counts.map(|n| n.to_string()));
    fields.push(output.map_or(String::new(), |o| o.values.to_string()));
    fields.extend(figures(output.map(|o| &o.ulps)));
    fields.push(output.map_or(String::new(), |o| o.ulps.beyond.to_string()));
    fields.extend(figures(output.map(|o| &o.conditioned)));
    let norm = output.is_none().then_some(region.normwise.as_ref());
    fields.extend(figures(norm.flatten()));
    let worst = match output {
        Some(o) => (o.max_of_budget, o.worst.as_ref()),
        None => (region.max_of_budget, region.worst.as_ref()),
    };
    fields.push(format!("{:e}", worst.0));
    let kinds = output.map_or(&region.kinds, |o| &o.kinds);
    fields.push(output.map_or(String::new(), |o| format!("{:e}", o.max_condition)));
    fields.push(kinds.total().to_string());
    let largest = region.outputs.iter().max_by(|a, b| {
        let share = |o: &OutputStatistics| o.max_of_budget;
        share(a).total_cmp(&share(b))
    });
    let largest = largest.filter(|_| output.is_none());
    fields.push(largest.map_or(String::new(), |o| o.name.into()));
    fields.push(report.interrupted.to_string());
    fields.push(report.settings.seed.to_string());
    fields.push(report.settings.cases_per_region.to_string());
    fields.push(worst.1.map_or(String::new(), |case| report.again(case)));
    fields.extend(Kind::ALL.map(|k| kinds[k].to_string()));
    fields
}

/// Writes a comparison: a line for each region (`all` last) and candidate.
pub fn comparison(found: &Comparison, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let mut csv = ::csv::Writer::from_writer(out);
    csv.write_record([
        "method",
        "region",
        "candidate",
        "best",
        "cases",
        "failed",
        "wrong",
        "of_budget",
        "times_the_best",
        "worst_ulps",
        "rms_ulps",
        "ns_per_answer",
        "start_up_ms",
    ])?;
    let number = |x: f64| format!("{x:e}");
    let some = |x: Option<f64>| x.map_or(String::new(), number);
    for contest in &found.regions {
        for (c, s) in found.candidates.iter().zip(&contest.standings) {
            csv.write_record([
                found.method.to_string(),
                contest.region.into(),
                c.name.clone(),
                s.best.to_string(),
                s.cases.to_string(),
                s.failed.to_string(),
                s.wrong.to_string(),
                number(s.of_budget),
                some(s.ratio),
                number(s.worst_ulps),
                number(s.rms_ulps),
                some(c.speed.map(|s| s.ns_per_answer)),
                some(c.speed.and_then(|s| s.start_up_ms)),
            ])?;
        }
    }
    Ok(csv.flush()?)
}

/// Writes the entries.
pub fn paper(report: &PaperReport, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let mut csv = ::csv::Writer::from_writer(out);
    csv.write_record([
        "table",
        "row",
        "column",
        "printed",
        "variant",
        "recomputed",
        "units_in_last_digit",
        "verdict",
    ])?;
    for e in &report.entries {
        for (variant, r) in &e.variants {
            csv.write_record([
                &e.table.to_string(),
                &e.row.to_string(),
                e.column,
                &e.printed,
                variant,
                &r.recomputed,
                &r.units_in_last_digit.to_string(),
                entry(r.verdict),
            ])?;
        }
    }
    Ok(csv.flush()?)
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_line_for_each_region_and_output() {
        let report = crate::report::text::method::tests::fabricated();
        let mut out = Vec::new();
        super::audit(&[report], &mut out).unwrap();
        let mut read = ::csv::Reader::from_reader(out.as_slice());
        let names = read.headers().unwrap().clone();
        let at = |name: &str| names.iter().position(|n| n == name).unwrap();
        let rows: Vec<::csv::StringRecord> = read.records().map(Result::unwrap).collect();
        assert_eq!(rows.len(), 3 * 2);
        assert_eq!(
            (&rows[0][at("output")], &rows[0][at("worst_ulps")]),
            ("all", "")
        );
        assert_eq!(&rows[0][at("worst_normwise_u")], "7.25e0");
        let phi2 = &rows[1];
        assert_eq!(&phi2[at("worst_ulps")], "7.25e0");
        assert_eq!(&phi2[at("budget")], "4 ulp");
        assert_eq!(&phi2[at("nan")], "0");
        let again = "mechaudit audit a-method --region wide --seed 1 --case 17";
        assert_eq!(&phi2[at("reproduce_worst")], again);
    }

    #[test]
    fn one_line_for_each_entry_and_variant() {
        let mut out = Vec::new();
        super::paper(&crate::report::text::paper::tests::fabricated(), &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 1 + 3 * 2);
        assert_eq!(
            lines[3],
            "1,1,phi2,1.243,as_printed,1.2345678901234567890,12,misprint"
        );
    }

    fn read(
        reports: &[crate::audit::MethodReport],
    ) -> Vec<std::collections::HashMap<String, String>> {
        let mut out = Vec::new();
        super::audit(reports, &mut out).unwrap();
        let mut read = ::csv::Reader::from_reader(out.as_slice());
        read.deserialize().map(Result::unwrap).collect()
    }

    /// Every field of a line for an output and of one for all of them.
    #[test]
    fn fields_are_those_of_their_column() {
        let mut report = crate::report::text::method::tests::fabricated();
        report.interrupted = true;
        (report.settings.seed, report.settings.cases_per_region) = (7, 9);
        report.candidate = Some(crate::audit::CandidateReport {
            name: "other".into(),
            ..Default::default()
        });
        let region = &mut report.regions[0];
        region.cases = 410;
        (
            region.recorded,
            region.over,
            region.undecided,
            region.reference_failed,
        ) = (2, 3, 4, 5);
        region.kinds[crate::audit::Kind::Nan] = 6;
        let first = &mut region.outputs[0];
        first.kinds[crate::audit::Kind::Infinity] = 8;
        first.ulps.beyond = 3;
        let spread = first.ulps;
        first.conditioned = crate::audit::Spread { max: 0.5, ..spread };
        let mut second = first.clone();
        (second.name, second.max_of_budget, second.values) = ("p", 2.5, 11);
        second.worst = None;
        region.outputs.push(second);
        let rows = read(&[report]);
        let common = [
            ("method", "a-method"),
            ("candidate", "other"),
            ("region", "wide"),
            ("cases", "410"),
            ("passed", "399"),
            ("recorded", "2"),
            ("over", "3"),
            ("undecided", "4"),
            ("reference_failed", "5"),
            ("interrupted", "true"),
            ("seed", "7"),
            ("cases_per_region", "9"),
        ];
        let all = [
            ("output", "all"),
            ("budget", ""),
            ("values", ""),
            ("worst_ulps", ""),
            ("rms_ulps", ""),
            ("beyond_ulps", ""),
            ("worst_u_1_plus_cond", ""),
            ("worst_normwise_u", "7.25e0"),
            ("p99_normwise_u", "1.5e0"),
            ("median_normwise_u", "3e-1"),
            ("rms_normwise_u", "4e-1"),
            ("max_of_budget", "1.75e0"),
            ("max_condition", ""),
            ("wrong", "6"),
            ("nan", "6"),
            ("worst_output_of_budget", "p"),
        ];
        let phi2 = [
            ("output", "phi2"),
            ("budget", "4 ulp"),
            ("values", "400"),
            ("worst_ulps", "7.25e0"),
            ("p99_ulps", "1.5e0"),
            ("median_ulps", "3e-1"),
            ("rms_ulps", "4e-1"),
            ("beyond_ulps", "3"),
            ("worst_u_1_plus_cond", "5e-1"),
            ("worst_normwise_u", ""),
            ("max_of_budget", "1.75e0"),
            ("max_condition", "3.1e1"),
            ("wrong", "8"),
            ("nan", "0"),
            ("worst_output_of_budget", ""),
        ];
        let p = [
            ("output", "p"),
            ("budget", ""),
            ("values", "11"),
            ("max_of_budget", "2.5e0"),
            ("reproduce_worst", ""),
        ];
        for (k, own) in [&all[..], &phi2, &p].into_iter().enumerate() {
            for (name, due) in common.iter().chain(own) {
                assert_eq!(rows[k][*name], **due, "{k}: {name}");
            }
        }
        assert_eq!(
            (&*rows[3]["region"], &*rows[3]["worst_u_1_plus_cond"]),
            ("near", "")
        );
        let names: std::collections::HashSet<&String> = rows[0].keys().collect();
        assert_eq!(
            names.len(),
            super::AUDIT.len() + crate::audit::Kind::ALL.len()
        );
    }

    #[test]
    fn a_comparison_has_a_line_for_each_region_and_code() {
        use crate::report::text::method::tests::{fabricated, passing};
        let speed = crate::audit::Speed {
            ns_per_answer: 12.5,
            start_up_ms: Some(3.0),
            answers: 9,
        };
        let reports = vec![(fabricated(), Some(speed)), (passing(), None)];
        let found = crate::audit::Comparison::new("a-method", reports);
        let mut out = Vec::new();
        super::comparison(&found, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 1 + 3 * 2, "{text}");
        let [a, b] = [0, 1].map(|k| &found.candidates[k].name);
        let first = format!("a-method,wide,{a},true,400,1,0,1.75e0,1e0,7.25e0,4e-1,1.25e1,3e0");
        let second = format!("a-method,wide,{b},true,400,0,0,1.75e0,1e0,7.25e0,4e-1,,");
        assert_eq!(lines[1..3], [first, second]);
    }
}
