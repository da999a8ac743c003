//! Tests of `data`.

use super::*;
use crate::report::gallery::Gallery;
use crate::report::text::method::tests::fabricated;

fn of_reports(report: &MethodReport, n: usize) -> Value {
    serde_json::to_value(Data::of(&vec![("a-method", report); n])).unwrap()
}

#[test]
fn a_case_is_held_once_whoever_refers_to_it() {
    let mut report = fabricated();
    report.wrong = report.failures.clone();
    let data = of_reports(&report, 1);
    let method = &data["methods"][0];
    for part in ["cases", "whole"] {
        assert_eq!(method[part].as_array().unwrap().len(), 1, "{part}");
    }
}

#[test]
fn inputs_of_eight_numbers_are_kept_where_methods_are_few() {
    let mut report = fabricated();
    report.failures[0].case.input = vec![0.5; 8];
    report.worst.clear();
    for (n, kept) in [(1, 8), (3, 8), (4, 0)] {
        let data = of_reports(&report, n);
        let case = &data["methods"][n - 1]["cases"][0];
        assert_eq!(case[3].as_array().unwrap().len(), kept, "{n}");
    }
}

fn case(region: &'static str, index: u64, input: Vec<f64>) -> Case {
    Case {
        method: "a-method",
        region,
        input,
        origin: crate::audit::Origin::Random { seed: 1, index },
    }
}

#[test]
fn cases_are_numbered_and_share_the_beginnings_of_their_places() {
    let mut report = fabricated();
    let near = case("near", 3, vec![f64::INFINITY, 0.5]);
    report.regions[1].worst = Some(near.clone());
    report.regions[1].outputs[0].worst = None;
    report.regions[1].outputs[0].kinds[crate::audit::Kind::Nan] = 2;
    let mut kinds = report.total.outputs[0].kinds;
    kinds[crate::audit::Kind::Nan] = 2;
    report.total.outputs[0].kinds = kinds;
    report.points = vec![
        Point {
            case: case("near", 9, (0..9).map(f64::from).collect()),
            verdict: crate::audit::Verdict::Pass,
            ulps: vec![1.234_56, f64::INFINITY],
            of_budget: 0.5,
        },
        Point {
            case: case("elsewhere", 3, vec![1.0]),
            verdict: crate::audit::Verdict::Over,
            ulps: vec![f64::NAN],
            of_budget: 2.0,
        },
    ];
    let reports = [("a-method", &report)];
    let data = Data::of(&reports);
    assert_eq!(
        (data.worst_of(0, 0), data.worst_of(0, 1)),
        (Some(0), Some(1))
    );
    assert_eq!(data.worst_of(0, 2), None);
    let of_output = |region, output| data.worst_of_output(0, region, output);
    assert_eq!((of_output(0, 0), of_output(0, 1)), (Some(0), None));
    assert_eq!((of_output(1, 0), of_output(2, 0)), (None, None));
    assert_eq!(data.place_of(0, &near), Some(1));
    assert_eq!(data.place_of(0, &case("near", 4, vec![])), None);
    let mut all = Gallery::default();
    let shown = |data: &Value| serde_json::to_string_pretty(&data["methods"][0]).unwrap();
    all.add("of a method", shown(&serde_json::to_value(&data).unwrap()));
    report.budgets[0].budget.limit = Limit::Relative(1e-3);
    (report.regions[0].name, report.regions[1].name) = ("zeros", "beside a seam");
    let method = &of_reports(&report, 1)["methods"][0];
    all.add(
        "marks",
        format!("{} {}", method["outputs"][0]["limit"], method["marks"]),
    );
    all.pin("data");
}

/// 1200 points over all regions, but three of each; 300 cases in full over all methods, and the
/// worst.
#[test]
fn a_page_of_much_holds_less_of_each() {
    let mut report = fabricated();
    let point = |index| Point {
        case: case("wide", index, vec![1.0]),
        verdict: crate::audit::Verdict::Pass,
        ulps: Vec::new(),
        of_budget: 0.0,
    };
    report.points = (0..1300).map(point).collect();
    report.points.push(Point {
        case: case("near", 5, vec![1.0]),
        ..point(0)
    });
    let failure = report.failures[0].clone();
    let failures = (0..310).map(|k| crate::audit::CaseReport {
        case: case("wide", 1000 + k, vec![1.0]),
        ..failure.clone()
    });
    report.failures = failures.collect();
    let counted = |report: &MethodReport, n: usize| {
        let data = of_reports(report, n);
        let method = &data["methods"][n - 1];
        ["points", "whole"].map(|part| method[part].as_array().unwrap().len())
    };
    // Of 600 in the one region, and the one in the other.
    assert_eq!(counted(&report, 1), [601, 301]);
    assert_eq!(counted(&report, 2), [301, 151]);
    report.failures.clear();
    let mut alone = report.clone();
    alone.regions.truncate(1);
    assert_eq!(counted(&alone, 1), [1201, 1]);
    let region = report.regions[1].clone();
    report.regions.extend(vec![region; 598]);
    assert_eq!(counted(&report, 1), [4, 1]);
}

/// An input that is kept needs none of its numbers beside it.
#[test]
fn points_bring_the_inputs_that_their_case_has_not() {
    for (n, beside) in [(8, 0), (9, 2)] {
        let mut report = fabricated();
        report.points = vec![Point {
            case: case("wide", 3, vec![0.5; n]),
            verdict: crate::audit::Verdict::Pass,
            ulps: Vec::new(),
            of_budget: 0.0,
        }];
        let data = of_reports(&report, 1);
        let point = &data["methods"][0]["points"][0];
        assert_eq!(point[2].as_array().unwrap().len(), beside, "{n}");
    }
}

#[test]
fn much_of_a_long_case_is_left_out() {
    let mut report = fabricated();
    let values = (0..30).map(f64::from).collect::<Vec<f64>>();
    report.worst[0].case.input = values.clone();
    report.worst[0].answer = Some(crate::audit::SolverAnswer::Values(values));
    report.failures.clear();
    for (n, kept) in [(1, 24), (3, 24), (4, 12)] {
        let data = of_reports(&report, n);
        let whole = &data["methods"][0]["whole"][0];
        assert_eq!(whole["input"].as_array().unwrap().len(), kept);
        assert_eq!(whole["left_out"], 2 * (30 - kept));
    }
    report.worst[0].case.input = vec![0.5; 5];
    for (n, kept) in [(3, 5), (4, 0)] {
        let data = of_reports(&report, n);
        let input = &data["methods"][0]["cases"][0][3];
        assert_eq!(input.as_array().unwrap().len(), kept);
    }
}

#[test]
fn a_page_of_nothing_has_no_data() {
    let data = serde_json::to_value(Data::of(&[])).unwrap();
    assert_eq!(data["methods"], serde_json::json!([]));
}
