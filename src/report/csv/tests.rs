//! Tests of `csv`.

use crate::audit::{CandidateReport, Comparison, Kind, Speed, Spread};
use crate::report::gallery::Gallery;
use crate::report::text::method::tests::{fabricated, passing};
use crate::report::text::paper::tests::fabricated as paper;

/// A line for each region and output, for each region and code, and for each entry and variant.
#[test]
fn tables() {
    let mut all = Gallery::default();
    let mut write = |name: &str, write: &dyn Fn(&mut Vec<u8>)| {
        let mut out = Vec::new();
        write(&mut out);
        let lines = ::csv::Reader::from_reader(out.as_slice()).into_records();
        assert!(lines.map(Result::unwrap).count() > 0);
        all.add(name, String::from_utf8(out).unwrap());
    };
    write("audit", &|out| super::audit(&[fabricated()], out).unwrap());
    let mut report = fabricated();
    report.interrupted = true;
    (report.settings.seed, report.settings.cases_per_region) = (7, 9);
    report.candidate = Some(CandidateReport {
        name: "other".into(),
        ..Default::default()
    });
    let region = &mut report.regions[0];
    (region.cases, region.recorded, region.over) = (410, 2, 3);
    (region.undecided, region.reference_failed) = (4, 5);
    region.kinds[Kind::Nan] = 6;
    let first = &mut region.outputs[0];
    first.kinds[Kind::Infinity] = 8;
    first.ulps.beyond = 3;
    let spread = first.ulps;
    first.conditioned = Spread { max: 0.5, ..spread };
    let mut second = first.clone();
    (second.name, second.max_of_budget, second.values) = ("p", 2.5, 11);
    second.worst = None;
    region.outputs.push(second);
    write("every field", &|out| {
        super::audit(std::slice::from_ref(&report), out).unwrap()
    });
    write("paper", &|out| super::paper(&paper(), out).unwrap());
    let speed = Speed {
        ns_per_answer: 12.5,
        start_up_ms: Some(3.0),
        answers: 9,
    };
    let found = Comparison::new(
        "a-method",
        vec![(fabricated(), Some(speed)), (passing(), None)],
    );
    write("comparison", &|out| super::comparison(&found, out).unwrap());
    all.pin("csv");
}
