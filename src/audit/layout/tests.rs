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
        let expected = "numbers are right for no n: lower[n-1], diagonal[n], d[n]";
        assert_eq!(e.to_string(), format!("{count} {expected}"));
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
        assert_eq!(
            e.to_string(),
            format!("p = {} is no number of c", crate::reason::plain(bad))
        );
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

/// A count in the input and a letter that follows from the count of all numbers, in one layout.
fn both() -> Layout {
    let inputs = [
        ("side (1 or -1)", "1"),
        ("p", "1"),
        ("c[p+1] (coefficients)", "m"),
        ("a[n]", "s"),
        ("b[n-2]", "kg"),
    ];
    let outputs = vec![("u", "m"), ("v", "s")];
    let rows = Rows {
        index: "i",
        count: "3",
        meaning: "the points",
    };
    Layout {
        outputs,
        ..layout(&inputs, &[], Some(rows))
    }
}

/// The numbers taken up by the count are no part of those that the letter divides.
#[test]
fn a_length_of_either_kind() {
    let l = both();
    // 1 + 1 + (2 + 1) + n + (n - 2) numbers, n at least 2.
    let input = |count| [&[1.0, 2.0][..], &vec![7.0; count - 2]].concat();
    assert_eq!(l.lengths(&input(7)).unwrap(), [1, 1, 3, 2, 0]);
    assert_eq!(l.lengths(&input(9)).unwrap(), [1, 1, 3, 3, 1]);
    for count in [2, 4, 5, 6, 8, 10] {
        let e = l.lengths(&input(count)).unwrap_err();
        assert!(matches!(e, LayoutError::NoLength { found, letter: "n", .. } if found == count));
    }
    // The letter may have the length zero, a count may be zero.
    let l = layout(&[("p", "1"), ("c[p]", "1"), ("a[n]", "1")], &[], None);
    assert_eq!(l.lengths(&[0.0]).unwrap(), [1, 0, 0]);
    assert_eq!(l.lengths(&[0.0, 5.0]).unwrap(), [1, 0, 1]);
    assert_eq!(l.lengths(&[-0.0, 5.0]).unwrap(), [1, 0, 1]);
}

/// Counts go up to 2^32, which itself is none.
#[test]
fn counts_have_a_bound() {
    let l = layout(&[("p", "1"), ("c[p]", "1")], &[], None);
    for count in [1.0, 3.0, 4_294_967_295.0] {
        let expected = count as usize + 1;
        let e = l.lengths(&[count, 1.0, 1.0]).unwrap_err();
        assert!(
            matches!(e, LayoutError::Count { found: 3, expected: d, .. } if d == expected),
            "{e}"
        );
    }
    for bad in [4_294_967_296.0, 8_589_934_591.0, f64::INFINITY, -1.0, 0.5] {
        let e = l.lengths(&[bad, 1.0]).unwrap_err();
        assert!(
            matches!(e, LayoutError::BadLength { symbol: "p", value, of: "c" } if value == bad),
            "{e}"
        );
    }
}

#[test]
fn numbers_have_names_and_units() {
    let l = both();
    assert_eq!(l.parts(), 5);
    let names = l.names(&[-1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let expected = [
        ("side", "1"),
        ("p", "1"),
        ("c[0]", "m"),
        ("c[1]", "m"),
        ("a[0]", "s"),
        ("a[1]", "s"),
        ("a[2]", "s"),
        ("b[0]", "kg"),
    ]
    .map(|(name, unit)| (name.to_string(), unit));
    assert_eq!(names, expected);
    assert_eq!(l.input_column(0, 0), "side");
    assert_eq!(l.input_column(2, 4), "c[4]");
    assert_eq!(
        [0, 1, 2, 3, 4].map(|k| l.is_single(k)),
        [true, true, false, false, false]
    );
    assert_eq!(l.singles(), [("side", 0), ("p", 1)]);
    // Numbers in another layout are only counted.
    let numbered = ["[0]", "[1]"].map(|n| (n.to_string(), ""));
    assert_eq!(l.names(&[1.0, 0.5]), numbered);
    assert_eq!(l.names(&[]), []);
}

#[test]
fn columns_have_names_and_units() {
    let l = both();
    assert_eq!(
        l.columns(),
        ["side", "p", "c[0]", "a[0]", "b[0]", "u[0]", "v[0]"]
    );
    // A name that is a column's finds it, and its unit.
    for (name, column, unit) in [
        ("side", Column::Input { part: 0, index: 0 }, "1"),
        ("c[3]", Column::Input { part: 2, index: 3 }, "m"),
        ("u[0]", Column::Value(0), "m"),
        ("v[0]", Column::Value(1), "s"),
        ("u[2]", Column::Value(4), "m"),
        ("v[2]", Column::Value(5), "s"),
    ] {
        assert_eq!(l.column(name), Some(column), "{name}");
        assert_eq!(l.unit(column), unit, "{name}");
    }
    for none in ["side[0]", "c", "u", "u[3]"] {
        assert_eq!(l.column(none), None, "{none}");
    }
    let plain = layout(&[("x", "1")], &["s", "t"], None);
    assert_eq!(plain.columns(), ["x", "s", "t"]);
    assert_eq!(plain.column("x"), Some(Column::Input { part: 0, index: 0 }));
    assert_eq!(plain.column("s"), Some(Column::Value(0)));
    assert_eq!(plain.column("t"), Some(Column::Value(1)));
    assert_eq!(plain.column("t[0]"), None);
    assert_eq!(l.output("u"), "u[i]");
    assert_eq!(plain.output("s"), "s");
}

#[test]
fn parts_have_shapes() {
    let shape = |symbol, length: Option<&str>, unit, note| Shape {
        symbol,
        length: length.map(Into::into),
        unit,
        note,
    };
    let expected = [
        shape("side", None, "1", Some("1 or -1")),
        shape("p", None, "1", None),
        shape("c", Some("p+1"), "m", Some("coefficients")),
        shape("a", Some("n"), "s", None),
        shape("b", Some("n-2"), "kg", None),
    ];
    assert_eq!(both().shapes(), expected);
}

/// Rows of a number that is known are counted with all their outputs.
#[test]
fn rows_in_words() {
    let expected = "for i = 0 to 2, the points: 6 values, row by row";
    assert_eq!(both().rows().as_deref(), Some(expected));
    assert_eq!(both().answer(), format!("u[i] [m], v[i] [s]; {expected}"));
    assert_eq!(layout(&[("x", "1")], &["s"], None).rows(), None);
    // Of one that follows from the input they are not.
    let expected = "x[i]; for i = 0 to n - 1, the unknowns, row by row";
    assert_eq!(system().answer(), expected);
}
