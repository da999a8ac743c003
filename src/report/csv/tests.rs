//! Tests of `csv`.

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

fn read(reports: &[crate::audit::MethodReport]) -> Vec<std::collections::HashMap<String, String>> {
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
