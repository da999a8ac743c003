//! Each condition in `tests/soundness.csv` still stands in its file. CI breaks them one by one,
//! late; this says at once that a row has to move with its code.

use std::fs;
use std::path::Path;

#[test]
fn every_condition_stands_in_its_file_once() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut rows = csv::Reader::from_path(root.join("tests/soundness.csv")).unwrap();
    let rows: Vec<csv::StringRecord> = rows.records().map(Result::unwrap).collect();
    assert!(rows.len() > 200);
    for row in &rows {
        let text = fs::read_to_string(root.join(&row[1])).expect(&row[1]);
        let places = text.matches(&row[3]).count();
        assert_eq!(places, 1, "{}: {:?}", &row[1], &row[3]);
    }
}
