use super::*;
use crate::cli::number::{FIELDS, SHOWN};
use SolverAnswer::{Declines, Fails, Values};

fn answers(text: &[u8]) -> Vec<SolverAnswer> {
    let mut lines = Lines::new(text);
    std::iter::from_fn(|| lines.read().unwrap().map(|l| l.answer())).collect()
}

#[test]
fn answers_of_many_kinds() {
    let given = b"# head\n1,2\n 0x1p-1 -INF\r\n1.5e0\t,\t-0\nrefuse\nrefuse: singular\n";
    let due = vec![
        Values(vec![1.0, 2.0]),
        Values(vec![0.5, f64::NEG_INFINITY]),
        Values(vec![1.5, -0.0]),
        Declines(None),
        Declines(Some("singular".into())),
    ];
    assert_eq!(answers(given), due);
    assert!(matches!(&answers(b"nan")[0], Values(v) if v[0].is_nan()));
}

#[test]
fn what_is_no_answer_costs_one_line() {
    let mut text = b"\n1,,2\n1,x\n\xff\nrefused\n,\n".to_vec();
    text.extend(std::iter::repeat_n(b'1', 2 * LONGEST));
    text.extend(b"\n4\n5");
    let all = answers(&text);
    assert_eq!(all.len(), 9);
    assert!(all[..7].iter().all(|a| matches!(a, Fails(_))), "{all:?}");
    assert_eq!(all[7..], [Values(vec![4.0]), Values(vec![5.0])]);
    assert!(matches!(&all[2], Fails(why) if why.contains("line 3") && why.contains("\"x\"")));
}

#[test]
fn inputs_come_back() {
    let x = vec![0.1, -0.0, 5e-324, f64::INFINITY, 1e300];
    for decimal in [false, true] {
        let text = line(&x, decimal);
        let read = Lines::new(text.as_bytes()).read().unwrap().unwrap();
        let back = read.input().unwrap();
        let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&back), bits(&x), "{text}");
    }
    assert_eq!(line(&[f64::NAN], true), "nan");
}

/// The longest line is read, with its end and without; a byte more costs that line alone.
#[test]
fn the_longest_line() {
    let of = |n: usize| vec![b'1'; n];
    let text = [of(LONGEST), of(LONGEST + 1), of(LONGEST)].join(&b'\n');
    let mut lines = Lines::new(&text[..]);
    let mut next = || lines.read().unwrap();
    for due in [true, false, true] {
        assert_eq!(next().unwrap().text().is_ok(), due);
    }
    assert!(next().is_none());
}

#[test]
fn numbers_are_separated_by_commas_or_blanks() {
    for (text, due) in [
        ("1", vec![1.0]),
        ("1 2\t3", vec![1.0, 2.0, 3.0]),
        (" 1 , 2 3 ", vec![1.0, 2.0, 3.0]),
        ("0x1p-1,1e1", vec![0.5, 10.0]),
    ] {
        assert_eq!(numbers(text).unwrap(), due, "{text}");
    }
    let why = |text: &str| chain(&numbers(text).unwrap_err());
    for text in ["", " ", ",", "1,", ",1", "1,,2", "1, ,2"] {
        let due = format!("an empty field in {:?}", text.trim());
        assert_eq!(why(text), due, "{text:?}");
    }
    assert!(why("1,x").ends_with("in \"1,x\"") && why("1,x").contains("\"x\""));
    let field = "y".repeat(SHOWN);
    assert!(!why(&field).starts_with("a field that is no number"));
    let long = "y".repeat(SHOWN + 1);
    assert_eq!(
        why(&long),
        format!("a field that is no number in \"{field}…\"")
    );
}

#[test]
fn no_line_has_too_many_numbers() {
    let of = |n: usize| numbers(&vec!["1"; n].join(","));
    assert_eq!(of(FIELDS).unwrap().len(), FIELDS);
    let why = of(FIELDS + 1).unwrap_err().to_string();
    assert_eq!(why, "more than 100000 fields");
}

#[test]
fn a_long_line_is_shown_by_its_beginning() {
    assert_eq!(shortened(b" a b "), "a b");
    let due = "ä".repeat(SHOWN);
    assert_eq!(shortened(due.as_bytes()), due);
    let more = "ä".repeat(SHOWN + 1);
    assert_eq!(shortened(more.as_bytes()), format!("{due}…"));
    // Characters of four bytes, the longest there are, are all looked at.
    let wide = "\u{1F600}".repeat(2 * SHOWN);
    assert_eq!(shortened(wide.as_bytes()), "\u{1F600}".repeat(SHOWN));
}

/// A refusal is the word alone, or before a reason.
#[test]
fn refusals_may_have_reasons() {
    for (text, due) in [
        ("refuse", Declines(None)),
        ("refuse:", Declines(None)),
        ("refuse : ", Declines(None)),
        ("refuse singular", Declines(Some("singular".into()))),
        ("refuse\tno root", Declines(Some("no root".into()))),
        (" refuse:: a ", Declines(Some("a".into()))),
    ] {
        assert_eq!(answers(text.as_bytes()), [due], "{text:?}");
    }
    for text in ["refused", "refuse,", "Refuse"] {
        assert!(matches!(&answers(text.as_bytes())[0], Fails(_)), "{text}");
    }
}

/// A fault of an answer names its line, comments and blank lines counted.
#[test]
fn a_bad_line_is_named_by_its_number() {
    let said = |text: &[u8]| match answers(text).pop() {
        Some(Fails(why)) => why,
        other => panic!("{other:?}"),
    };
    let head = "malformed answer on line";
    assert_eq!(said(b"#\n1\n\n"), format!("{head} 3: empty"));
    assert!(said(b"#\n\xff").starts_with(&format!("{head} 2: not UTF-8")));
    let long = [&b"# x\n# y\n"[..], &vec![b'1'; LONGEST + 1]].concat();
    assert_eq!(said(&long), format!("{head} 3: longer than 1 MiB"));
    let mut lines = Lines::new(&b"#\n1,x"[..]);
    let why = lines.read().unwrap().unwrap().input().unwrap_err();
    assert!(why.to_string().starts_with("inputs, line 2: "), "{why}");
}

#[test]
fn comments_begin_with_a_mark() {
    let text = b"#\n#  name: x \n 1 # 2\n#\xff\n   \n";
    let mut lines = Lines::new(&text[..]);
    let mut next = || lines.read_any().unwrap().unwrap();
    let (empty, name, none, bad, blank) = (next(), next(), next(), next(), next());
    assert_eq!(empty.comment(), Some(""));
    assert_eq!(name.comment(), Some("name: x"));
    assert_eq!((none.comment(), none.is_comment()), (None, false));
    assert_eq!((bad.comment(), bad.is_comment()), (None, true));
    assert!(blank.is_blank() && !none.is_blank() && !bad.is_blank());
    let numbers = [empty, name, none, bad, blank].map(|l| l.number);
    assert_eq!(numbers, [1, 2, 3, 4, 5]);
}

#[test]
fn a_line_that_is_not_whole_is_waited_for() {
    let mut lines = Lines::new(BufReader::new(&b"1\n2\n3"[..]));
    assert!(lines.is_drained(), "nothing is read yet");
    for drained in [false, true] {
        lines.read().unwrap();
        assert_eq!(lines.is_drained(), drained);
    }
}

#[test]
fn decimals_read_back_as_the_same_numbers() {
    let x = [0.1, -0.0, 1.0, f64::NEG_INFINITY, -f64::NAN];
    assert_eq!(line(&x, true), "0.1,-0.0,1.0,-inf,nan");
    assert_eq!(line(&x[..3], false), "0x1.999999999999ap-4,-0x0p+0,0x1p+0");
    assert_eq!(line(&[], true), "");
}
