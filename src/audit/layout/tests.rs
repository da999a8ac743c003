use super::*;

fn layout(
    inputs: &[(&'static str, &'static str)],
    outputs: &[&'static str],
    rows: Option<Rows>,
) -> Layout {
    let inputs: Vec<Input> = inputs
        .iter()
        .map(|&(name, unit)| Input { name, unit })
        .collect();
    Layout {
        parts: inputs.iter().map(Part::new).collect(),
        inputs,
        outputs: outputs.iter().map(|name| (*name, "1")).collect(),
        rows,
    }
}

fn system() -> Layout {
    let inputs = [("lower[n-1]", "1"), ("diagonal[n]", "1"), ("d[n]", "1")];
    let rows = Rows {
        index: "i",
        count: "n",
        meaning: "the unknowns",
    };
    layout(&inputs, &["x"], Some(rows))
}

#[test]
fn a_length_follows_from_the_count() {
    assert_eq!(system().lengths(&[1.0; 8]).unwrap(), [2, 3, 3]);
    assert_eq!(system().lengths(&[1.0; 2]).unwrap(), [0, 1, 1]);
    for count in [0, 1, 3, 4, 9] {
        let e = system().lengths(&vec![1.0; count]).unwrap_err();
        let due = "numbers are right for no n: lower[n-1], diagonal[n], d[n]";
        assert_eq!(e.to_string(), format!("{count} {due}"));
    }
}

#[test]
fn a_length_may_stand_in_the_input() {
    let law = layout(
        &[("x", "1"), ("p", "1"), ("c[p]", "1"), ("t", "s")],
        &["s"],
        None,
    );
    assert_eq!(
        law.lengths(&[0.5, 2.0, 7.0, 7.0, 1.0]).unwrap(),
        [1, 1, 2, 1]
    );
    let e = law.lengths(&[0.5, 2.0, 7.0]).unwrap_err();
    assert_eq!(
        e.to_string(),
        "3 numbers where 5 are due: x, p, c[p], t [s]"
    );
    for bad in [-1.0, 1.5, f64::NAN, 1e300] {
        let e = law.lengths(&[0.5, bad, 7.0]).unwrap_err();
        assert_eq!(e.to_string(), format!("p = {bad} is no number of c"));
    }
    assert!(law.lengths(&[]).is_err());
}

#[test]
fn columns_are_found_by_name() {
    let l = system();
    let input = |part, index| Some(Column::Input { part, index });
    assert_eq!(l.column("lower[0]"), input(0, 0));
    assert_eq!(l.column("d[12]"), input(2, 12));
    assert_eq!(l.column("x[3]"), Some(Column::Value(3)));
    for none in ["x", "lower", "d[01]", "d[+1]", "d[]", "y[0]", "x[-1]", ""] {
        assert_eq!(l.column(none), None, "{none}");
    }
    let rows = Rows {
        index: "q",
        count: "2",
        meaning: "at q0 and q1",
    };
    let l = layout(&[("q0", "1"), ("q1", "1")], &["S", "S'"], Some(rows));
    assert_eq!(l.column("S'[1]"), Some(Column::Value(3)));
    assert_eq!((l.column("S[2]"), l.column("q[0]")), (None, None));
}

#[test]
fn answers_in_words() {
    assert_eq!(
        system().answer(),
        "x[i]; for i = 0 to n - 1, the unknowns, row by row"
    );
    let rows = Rows {
        index: "q",
        count: "2",
        meaning: "at q0 and q1",
    };
    let l = layout(&[("q0", "1"), ("q1", "1")], &["S", "S'"], Some(rows));
    assert_eq!(
        l.answer(),
        "S[q], S'[q]; for q = 0 to 1, at q0 and q1: 4 values, row by row"
    );
}
