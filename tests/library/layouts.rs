//! Layouts of inputs and answers hold for every method.

use mechaudit::audit::{Cases, Column, Layout, Settings, SolverAnswer};
use mechaudit::methods;
use std::collections::HashSet;

#[test]
fn inputs_and_answers_are_laid_out_as_said() {
    let settings = Settings {
        cases_per_region: 3,
        ..Settings::default()
    };
    for method in methods::registry() {
        let (name, layout) = (method.name(), Layout::new(&*method));
        let cases = Cases::new(&*method, &settings);
        for i in 0..cases.len() {
            let case = cases.get(i);
            let place = case.reproduce();
            let lengths = layout.lengths(&case.input);
            let lengths = lengths.unwrap_or_else(|e| panic!("{place}: {e}"));
            assert_eq!(lengths.iter().sum::<usize>(), case.input.len(), "{place}");
            // One number more or less fits no layout of a fixed length.
            let single = (0..layout.parts()).all(|k| layout.is_single(k));
            let longer = [&case.input[..], &[1.0]].concat();
            assert!(!single || layout.lengths(&longer).is_err(), "{place}");
            let refused = SolverAnswer::Refuses("bad layout");
            assert!(!single || method.solve(&longer) == refused, "{place}");
            let SolverAnswer::Values(values) = method.solve(&case.input) else {
                continue;
            };
            let outputs = method.outputs().len();
            let rows = match method.rows() {
                None => 1,
                Some(rows) => match (rows.count, rows.count.parse()) {
                    (_, Ok(count)) => count,
                    ("n", _) => *lengths.iter().max().unwrap(),
                    _ => values.len() / outputs,
                },
            };
            assert_eq!(values.len(), rows * outputs, "{place}");
        }
        let columns = layout.columns();
        let distinct: HashSet<&String> = columns.iter().collect();
        assert_eq!(distinct.len(), columns.len(), "{name}: {columns:?}");
        for (i, column) in columns.iter().enumerate() {
            let due = match i.checked_sub(layout.parts()) {
                None => Column::Input { part: i, index: 0 },
                Some(k) => Column::Value(k),
            };
            assert_eq!(layout.column(column), Some(due), "{name}: {column}");
        }
    }
}
