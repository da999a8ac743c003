//! Studies of linear algebra.

use crate::audit::{Draw, Layout, Method, ReferenceAnswer, Uncertified};
use crate::methods::certified_digits;
use crate::study::Study;
use rug::Rational;

fn study(inputs: &str, outputs: &str) -> Study {
    let text = format!("[inputs]\n{inputs}\n[outputs]\n{outputs}\n");
    Study::parse(&text, "linear").unwrap()
}

fn digits(study: &Study, numbers: &[Rational]) -> Result<Vec<String>, Uncertified> {
    let found = certified_digits(study, numbers, 12, |_| true)?;
    Ok(found
        .into_iter()
        .map(|v| v.decimal.unwrap_or_default())
        .collect())
}

fn whole(numbers: &[i32]) -> Vec<Rational> {
    numbers.iter().map(|n| Rational::from(*n)).collect()
}

const A: &str = "A = { shape = [\"n\", \"n\"] }";
const B: &str = "b = { shape = [\"n\"] }";

#[test]
fn every_task_has_its_values() {
    // 2 1, 1 3 and 1, 2.
    let numbers = whole(&[2, 1, 1, 3, 1, 2]);
    let solved = study(&format!("{A}\n{B}"), "x = { solve = [\"A\", \"b\"] }");
    assert_eq!(
        digits(&solved, &numbers).unwrap(),
        ["0.200000000000", "0.600000000000"]
    );
    let det = study(A, "d = { det = \"A\" }");
    assert_eq!(digits(&det, &numbers[..4]).unwrap(), ["5.00000000000"]);
    assert_eq!(det.rows(), None);
    let inverse = study(A, "X = { inverse = \"A\" }");
    let due = [
        "0.600000000000",
        "-0.200000000000",
        "-0.200000000000",
        "0.400000000000",
    ];
    assert_eq!(digits(&inverse, &numbers[..4]).unwrap(), due);
    let values = study(A, "l = { eigenvalues = \"A\" }");
    // (5 ∓ √5)/2.
    assert_eq!(
        digits(&values, &numbers[..4]).unwrap(),
        ["1.38196601125", "3.61803398875"]
    );
    let pencil = study(
        &format!("{A}\nB = {{ shape = [\"n\", \"n\"] }}"),
        "l = { eigenvalues = [\"A\", \"B\"] }",
    );
    let found = digits(&pencil, &whole(&[2, 0, 0, 3, 4, 0, 0, 2])).unwrap();
    assert_eq!(found, ["0.500000000000", "1.50000000000"]);
    // The line through (0, 1), (1, 3), (2, 4): 7/6 + 3/2 x.
    let fit = study(
        "A = { shape = [\"m\", 2] }\nb = { shape = [\"m\"] }",
        "c = { least_squares = [\"A\", \"b\"] }",
    );
    let found = digits(&fit, &whole(&[1, 0, 1, 1, 1, 2, 1, 3, 4])).unwrap();
    assert_eq!(found, ["1.16666666667", "1.50000000000"]);
}

/// The places of a band in their order are those of the dense matrix.
#[test]
fn bands_are_dense_matrices() {
    let banded = "A = { shape = [\"n\", \"n\"], banded = [1, 2] }";
    for n in [1usize, 2, 3, 6] {
        let mut d = Draw::new(1, "linear", "bands", n as u64);
        let mut number = || Rational::from((d.integer(1, 99) as i32 - 50, 7));
        let (mut band, mut dense) = (Vec::new(), Vec::new());
        for i in 0..n {
            for j in 0..n {
                let x = match i {
                    i if i == j => Rational::from(60),
                    _ => number(),
                };
                let is_within = j + 1 >= i && j <= i + 2;
                dense.push(if is_within {
                    x.clone()
                } else {
                    Rational::new()
                });
                if is_within {
                    band.push(x);
                }
            }
        }
        let side: Vec<Rational> = (0..n).map(|_| number()).collect();
        for (output, has_side) in [
            ("x = { solve = [\"A\", \"b\"] }", true),
            ("d = { det = \"A\" }", false),
            ("X = { inverse = \"A\" }", false),
        ] {
            let side: &[Rational] = if has_side { &side } else { &[] };
            let inputs = |a: &str| match has_side {
                true => format!("{a}\n{B}"),
                false => a.into(),
            };
            let a = digits(&study(&inputs(banded), output), &[&band, side].concat());
            let b = digits(&study(&inputs(A), output), &[&dense, side].concat());
            assert_eq!(a.unwrap(), b.unwrap(), "{output} {n}");
        }
    }
}

/// Audits see a word, readers the reason.
#[test]
fn refusals_say_why() {
    let refused = |study: &Study, numbers: &[i32], due: &str| {
        let numbers = whole(numbers);
        let word = due.split(':').next().unwrap();
        assert!(matches!(study.reference(&numbers, 100), ReferenceAnswer::Refuses(w) if w == word));
        let Err(Uncertified::Refused(found)) = digits(study, &numbers) else {
            panic!("{due}");
        };
        assert!(found.starts_with(due), "{found}");
    };
    let solved = study(&format!("{A}\n{B}"), "x = { solve = [\"A\", \"b\"] }");
    refused(
        &solved,
        &[1, 2, 2, 4, 1, 1],
        "singular: the columns are dependent, by (",
    );
    let inverse = study(A, "X = { inverse = \"A\" }");
    refused(&inverse, &[0], "singular");
    let values = study(A, "l = { eigenvalues = \"A\" }");
    refused(
        &values,
        &[1, 2, 3, 4],
        "not symmetric: row 2, column 1 differs",
    );
    let pencil = study(
        &format!("{A}\nB = {{ shape = [\"n\", \"n\"] }}"),
        "l = { eigenvalues = [\"A\", \"B\"] }",
    );
    refused(
        &pencil,
        &[1, -1],
        "not positive definite: the form is not positive at (",
    );
    // The determinant of a singular matrix is a number.
    let det = study(A, "d = { det = \"A\" }");
    assert_eq!(digits(&det, &whole(&[1, 2, 2, 4])).unwrap(), ["0"]);
    use crate::methods::Evaluable;
    let why = solved.refusal(&[0.0; 7]).unwrap();
    assert_eq!(why, "7 numbers are right for no n: A[n*n], b[n]");
}

/// Lengths that a study states are those of the layout.
#[test]
fn lengths_may_be_stated() {
    let text = "[parameters]\nn = 3\n[inputs]\nA = { shape = [\"n\", \"n\"], banded = [1, 1] }\n\
                b = { shape = [\"n\"], unit = \"m\" }\n[outputs]\nx = { solve = [\"A\", \"b\"] }";
    let found = Study::parse(text, "linear").unwrap();
    let layout = Layout::new(&found);
    assert_eq!(layout.lengths(&[0.0; 10]).unwrap(), [7, 3]);
    assert!(layout.lengths(&[0.0; 11]).is_err());
    assert_eq!(layout.input(), "A[7], b[3] [m]");
    assert_eq!(found.rows().unwrap().count, "3");
}

/// Cases of every region are within the domain and have values; conditions are those by
/// differences.
#[test]
fn cases_have_values_and_conditions() {
    let b2 = "B = { shape = [\"n\", \"n\"] }";
    for (inputs, output) in [
        (format!("{A}\n{B}"), "x = { solve = [\"A\", \"b\"] }"),
        (A.into(), "d = { det = \"A\" }"),
        (A.into(), "X = { inverse = \"A\" }"),
        (A.into(), "l = { eigenvalues = \"A\" }"),
        (format!("{A}\n{b2}"), "l = { eigenvalues = [\"A\", \"B\"] }"),
        (
            "A = { shape = [\"m\", 2] }\nb = { shape = [\"m\"] }".into(),
            "c = { least_squares = [\"A\", \"b\"] }",
        ),
        (
            format!("A = {{ shape = [\"n\", \"n\"], banded = [1, 1], from = 1, to = 2 }}\n{B}"),
            "x = { solve = [\"A\", \"b\"] }",
        ),
    ] {
        let study = study(&inputs, output);
        let domain = study.domain();
        assert!(study.admits(&domain.check_points[0].input));
        for region in &domain.regions {
            for k in 0..3 {
                let input = (region.sample)(&mut Draw::new(1, "linear", region.name, k));
                assert!(study.admits(&input), "{output} {}", region.name);
                let exact: Vec<Rational> = input
                    .iter()
                    .map(|x| Rational::from_f64(*x).unwrap())
                    .collect();
                let reference = study.reference(&exact, 120);
                let count = reference.certified().unwrap().len();
                let found = study.conditions(&input).unwrap();
                assert_eq!(found.len(), count);
                if !output.contains("eigen") {
                    let due =
                        crate::audit::conditions_by_differences(&study, &input, |_| true).unwrap();
                    for (a, b) in found.iter().zip(&due) {
                        assert!(
                            (a - b).abs() <= 1e-6 * b.abs(),
                            "{output} {}: {a} {b}",
                            region.name
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn faults_name_their_place() {
    let x = "x = { solve = [\"A\", \"b\"] }";
    for (inputs, output, due) in [
        (
            "A = { shape = [\"n\", \"n\"] }",
            x,
            "line 4, column 21: there is no input b",
        ),
        (
            "A = { shape = [\"n\"] }\nb = { shape = [\"n\"] }",
            x,
            "line 5, column 16: A is a vector where a matrix is meant",
        ),
        (
            "A = { shape = [\"n\", \"m\"] }\nb = { shape = [\"n\"] }",
            x,
            "line 2, column 21: the lengths n of A and m of A are both open",
        ),
        (
            "A = { shape = [2, 3] }\nb = { shape = [2] }",
            x,
            "A has 2 rows and 3 columns: it is not square",
        ),
        (
            "A = { shape = [2, 2] }\nb = { shape = [3] }",
            x,
            "b has 3 rows where 2 are needed",
        ),
        (
            "A = { from = 1 }\nb = { shape = [3] }",
            x,
            "the input A needs shape",
        ),
        (
            "A = { shape = [] }\nb = { shape = [3] }",
            x,
            "line 2, column 15: a shape of 0 lengths",
        ),
        (
            "A = { shape = [2, 2] }\nb = { shape = [2] }",
            "x = { solve = \"A\" }",
            "solve of 1 inputs, where a matrix and a right-hand side are meant",
        ),
        (
            "A = { shape = [0, 0] }\nb = { shape = [2] }",
            x,
            "line 2, column 16: 0 is no length",
        ),
        (
            "A = { shape = [2, 2] }\nb = { shape = [2] }",
            "x = { solve = [\"A\", \"b\"] }\nd = { det = \"A\" }",
            "d and x have different numbers of values",
        ),
    ] {
        let text = format!("[inputs]\n{inputs}\n[outputs]\n{output}\n");
        let found = Study::parse(&text, "linear").err().unwrap().to_string();
        assert!(found.contains(due), "{found}");
    }
    let text = format!("[parameters]\nk = 2.5\n[inputs]\n{A}\n[outputs]\nd = {{ det = \"A\" }}");
    let found = Study::parse(&text, "linear").err().unwrap().to_string();
    assert!(
        found.starts_with("line 2, column 5: 5/2 is no length"),
        "{found}"
    );
}

/// The entries of the inverse of a Hilbert matrix are known integers.
#[test]
fn a_hilbert_matrix_of_order_100_is_inverted() {
    let n = 100u32;
    let numbers = (0..n * n).map(|k| Rational::from((1, k / n + k % n + 1)));
    let numbers: Vec<Rational> = numbers.collect();
    let inverse = study(A, "X = { inverse = \"A\" }");
    let found = inverse.reference(&numbers, 100).certified().unwrap();
    let choose = |a: u32, b: u32| rug::Integer::from(a).binomial(b);
    for (k, ball) in (0..).zip(&found) {
        let (i, j) = (k / n + 1, k % n + 1);
        let due = (i + j - 1)
            * choose(n + i - 1, n - j)
            * choose(n + j - 1, n - i)
            * choose(i + j - 2, i - 1).square();
        let due = if (i + j) % 2 == 0 { due } else { -due };
        assert!(ball.contains(&due.into()) && ball.accuracy_bits() >= 100);
    }
}
