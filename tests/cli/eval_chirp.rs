//! `mechaudit eval chirp-response` as its user meets it.

use crate::common::{Done, run_on};

fn eval(args: &[&str], input: &str) -> Done {
    run_on(input, &[&["eval", "chirp-response"], args].concat())
}

/// w, n, eps, omega0, k, delta, y0, v0, t
const RUN_UP: &str = "10,0.5,4,0,2,0,0,0,1.5\n";

#[test]
fn values_and_certified_digits() {
    let o = eval(&[], RUN_UP);
    assert_eq!(o.code, 0);
    let solved: Vec<f64> = o
        .out
        .trim()
        .split(',')
        .map(|t| mechaudit::reference::HexFloat::parse(t).unwrap().to_f64())
        .collect();
    let o = eval(&["--digits", "40"], RUN_UP);
    assert_eq!(o.code, 0);
    let text = o.out;
    let digits: Vec<&str> = text.trim().split(',').collect();
    assert_eq!((solved.len(), digits.len()), (5, 5));
    for (a, b) in solved.iter().zip(&digits) {
        let b: f64 = b.parse().unwrap();
        assert!((a - b).abs() <= 4.0 * f64::EPSILON * b.abs(), "{a} {b}");
    }
    // By mpmath (reference/independent/chirp_response.csv).
    assert!(
        digits[0].starts_with("0.758713241617770969796437721379"),
        "{text}"
    );
}

#[test]
fn a_zero_is_written_as_one() {
    let o = eval(
        &["--digits", "20"],
        "# at time zero\n\n3,0.5,4,1,2,0,0.25,0.5,0\n",
    );
    assert_eq!(
        o.out,
        "0.25000000000000000000,0.50000000000000000000,6.2500000000000000000,0,0\n"
    );
}

#[test]
fn bad_input_is_refused_by_number_and_text() {
    for (line, why) in [
        ("0,0.5,4,0,2,0,0,0,1.5", "w = 0 must be greater than zero"),
        ("-3,0.5,4,0,2,0,0,0,1.5", "w = -3 must be greater than zero"),
        ("10,-0.5,4,0,2,0,0,0,1.5", "n = -0.5 must not be negative"),
        ("10,nan,4,0,2,0,0,0,1.5", "n = NaN is not a finite number"),
        ("10,0.5,4,0,2,0,0,0,-1", "t = -1 must not be negative"),
        ("10,0.5,4,0,2,0,0,0", "8 numbers where 9 are due"),
        ("10,x,4,0,2,0,0,0,1", "neither a decimal nor"),
    ] {
        for args in [&[][..], &["--digits", "10"]] {
            let o = eval(args, &format!("{RUN_UP}{line}\n"));
            let err = o.err;
            assert_eq!(o.code, 2, "{line}");
            assert_eq!(err.lines().count(), 1, "{err}");
            assert!(err.contains("line 2") && err.contains(line), "{err}");
            assert!(err.contains(why), "{err}");
        }
    }
}
