//! Laws judge planted solvers; which rows are dominant.

use super::*;
use crate::audit::SolverAnswer;

const HOLDS: Option<f64> = Some(0.0);
const BROKEN: Option<f64> = Some(f64::INFINITY);

/// Each unknown by a formula of its own row.
fn by_rows(i: TridiagonalInput, d: &[f64], row: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let pairs = i.diagonal.iter().zip(d);
    pairs.map(|(b, d)| row(*b, *d)).collect()
}

fn of_two(law: fn(Solve, TridiagonalInput) -> Option<f64>, solve: Solve) -> Option<f64> {
    law(solve, Tridiagonal::unpack(&[0.5, 2.0, 4.0, 0.5, 1.0, 3.0])?)
}

#[test]
fn a_solver_that_does_not_scale_breaks_the_law() {
    for (solve, due) in [
        ((|i, d| Ok(by_rows(i, d, |b, d| d / b))) as Solve, HOLDS),
        // In the right-hand side alone, in neither, in both together alone.
        (|i, d| Ok(by_rows(i, d, |_, d| d)), BROKEN),
        (|i, d| Ok(by_rows(i, d, |_, _| 1.0)), BROKEN),
        (|i, d| Ok(by_rows(i, d, |b, d| (d / b) * (d / b))), BROKEN),
        // In one unknown, not in the other.
        (
            |i, d| Ok(by_rows(i, d, |b, d| if b >= 4.0 { 1.0 } else { d / b })),
            BROKEN,
        ),
        (|_, _| Err("singular"), None),
    ] {
        assert_eq!(of_two(scaling, solve), due);
    }
}

#[test]
fn a_solver_that_is_not_odd_breaks_the_law() {
    for (solve, due) in [
        ((|i, d| Ok(by_rows(i, d, |b, d| d / b))) as Solve, HOLDS),
        (|i, d| Ok(by_rows(i, d, |b, d| (d / b).abs())), BROKEN),
        (
            |i, d| Ok(by_rows(i, d, |b, d| if b == 4.0 { 1.0 } else { d })),
            BROKEN,
        ),
        // The sign of zero is left alone.
        (|i, d| Ok(by_rows(i, d, |_, _| 0.0)), HOLDS),
        (|_, _| Err("singular"), None),
    ] {
        assert_eq!(of_two(signs, solve), due);
    }
}

#[test]
fn answers_are_identical_bit_by_bit() {
    let broken = f64::INFINITY;
    for (a, b, due) in [
        (&[1.0, 2.0][..], &[1.0, 2.0][..], 0.0),
        (&[], &[], 0.0),
        (&[1.0, 2.0], &[1.0, 3.0], broken),
        (&[1.0, 2.0], &[3.0, 2.0], broken),
        (&[1.0], &[1.0, 2.0], broken),
        (&[0.0], &[-0.0], broken),
    ] {
        assert_eq!(identical(a, b), due, "{a:?} {b:?}");
    }
}

#[test]
fn a_row_is_dominant_by_more_than_the_sum_of_the_others() {
    let (e, inf) = (f64::EPSILON, f64::INFINITY);
    for (b, a, c, due) in [
        (3.0, 1.0, 1.0, true),
        (-3.0, -1.0, 1.0, true),
        (2.0, 1.0, 1.0, false),
        (2.0 + 2.0 * e, -1.0, -1.0, true),
        // Below 1 by e/4, which f64 rounds to 1.
        (1.0, 1.0 - e / 2.0, e / 4.0, true),
        (0.0, 0.0, 0.0, false),
        (inf, 1.0, 1.0, false),
        (3.0, inf, 1.0, false),
        (3.0, 1.0, f64::NAN, false),
    ] {
        assert_eq!(dominant(b, a, c), due, "{b} {a} {c}");
    }
}

/// Solver and reference in one word.
#[test]
fn what_is_no_system_is_refused_by_its_name() {
    let (inf, max) = (f64::INFINITY, f64::MAX);
    for (name, input, due) in [
        ("tridiagonal", &[0.0, 1.0][..], "singular"),
        ("tridiagonal", &[inf, 1.0], "not finite"),
        ("tridiagonal", &[1.0, inf], "not finite"),
        ("tridiagonal", &[0.5, max], "overflow"),
        ("tridiagonal", &[1.0, 1.0, 1.0], "bad layout"),
        ("cyclic-tridiagonal", &[1.0; 8], "bad layout"),
        (
            "cyclic-tridiagonal",
            &[1.0, 1.0, 1.0, 4.0, 4.0, 4.0, 1.0, 1.0, 1.0, 0.0, 0.0, inf],
            "not finite",
        ),
        (
            "cyclic-tridiagonal",
            &[
                -1.0, -1.0, -1.0, 2.0, 2.0, 2.0, -1.0, -1.0, -1.0, 1.0, 0.0, -1.0,
            ],
            "singular",
        ),
    ] {
        let method = crate::methods::find(name).unwrap();
        let answer = method.solve(input);
        assert_eq!(answer, SolverAnswer::Refuses(due), "{name} {input:?}");
        let Some(exact) = exact(input).filter(|_| due != "overflow") else {
            continue;
        };
        match method.reference(&exact, 128) {
            ReferenceAnswer::Refuses(word) => assert_eq!(word, due, "{name} {input:?}"),
            other => panic!("{name} {input:?}: {other:?}"),
        }
    }
}

/// `|A⁻¹| (|A| |x| + |d|)` of 2x + y = 3, x + 2y = 3 with x = y = 1: A⁻¹ = (2, −1; −1, 2)/3, sums
/// of 6.
#[test]
fn conditions_of_two_equations() {
    let found = Tridiagonal::conditions(&[1.0, 2.0, 2.0, 1.0, 3.0, 3.0]).unwrap();
    assert_eq!(found, [6.0, 6.0]);
    assert_eq!(
        Tridiagonal::conditions(&[1.0, 1.0, 1.0, 1.0, 3.0, 3.0]),
        None
    );
    assert_eq!(Tridiagonal::conditions(&[f64::NAN, 3.0]), None);
}

/// The sweep ends at a pivot that is zero; the matrix is regular, and the solver with row
/// exchanges solves it.
#[test]
fn a_zero_pivot_is_named_and_is_no_failure_of_the_sweep() {
    use crate::audit::{Case, Origin, Settings, SolverAnswer, Verdict, audit_case, judge_case};
    let case = |method: &'static str, input: &[f64]| Case {
        method,
        region: "given",
        input: input.to_vec(),
        origin: Origin::Line { number: 1 },
    };
    let swap = [1.0, 0.0, 0.0, 1.0, 3.0, 4.0];
    let ring = [1.0, 2.0, 1.0, 0.0, 3.0, 1.0, 1.0, 1.0, 1.0, 1.0, 2.0, 3.0];
    let settings = Settings::default();
    for (name, input) in [("tridiagonal", &swap[..]), ("cyclic-tridiagonal", &ring)] {
        let method = crate::methods::find(name).unwrap();
        assert_eq!(
            method.solve(input),
            SolverAnswer::Refuses("zero pivot"),
            "{name}"
        );
        let own = audit_case(&*method, case(name, input), &settings);
        assert_eq!(
            own.judgement.verdict,
            Verdict::Pass,
            "{name}: {:?}",
            own.judgement
        );
        // Values are due nevertheless, and no other refusal.
        for (answer, due) in [
            (SolverAnswer::Refuses("singular"), Verdict::WrongKind),
            (SolverAnswer::Declines(None), Verdict::WrongKind),
            (
                SolverAnswer::Declines(Some("zero pivot".into())),
                Verdict::Pass,
            ),
        ] {
            let judged = judge_case(&*method, case(name, input), answer, &settings);
            assert_eq!(
                judged.judgement.verdict, due,
                "{name}: {:?}",
                judged.judgement
            );
        }
    }
    let method = crate::methods::find("tridiagonal").unwrap();
    let values = SolverAnswer::Values(vec![4.0, 3.0]);
    let judged = judge_case(&*method, case("tridiagonal", &swap), values, &settings);
    assert_eq!(judged.judgement.verdict, Verdict::Pass);
    // Where no pivot is zero the word is wrong.
    let regular = [1.0, 2.0, 2.0, 1.0, 3.0, 3.0];
    let answer = SolverAnswer::Refuses("zero pivot");
    let judged = judge_case(&*method, case("tridiagonal", &regular), answer, &settings);
    assert_eq!(judged.judgement.verdict, Verdict::WrongKind);
    let pivoting = crate::methods::find("tridiagonal-pivoting").unwrap();
    assert_eq!(pivoting.solve(&swap), SolverAnswer::Values(vec![4.0, 3.0]));
}

/// A system of 2000 rows is judged with its condition numbers, by O(n) operations: they are those
/// that the exact formula gives where the right-hand side is that of the unknowns 1.
#[test]
fn long_systems_are_judged() {
    use crate::audit::{Case, Origin, Settings, Verdict, audit_case};
    let n = 2000;
    let third = 1.0 / 3.0;
    let beside = vec![third; n - 1];
    let mut d = vec![4.0 + 2.0 * third; n];
    (d[0], d[n - 1]) = (4.0 + third, 4.0 + third);
    let input = [&beside[..], &vec![4.0; n], &beside, &d].concat();
    let method = crate::methods::find("tridiagonal").unwrap();
    let case = Case {
        method: "tridiagonal",
        region: "given",
        input,
        origin: Origin::Line { number: 1 },
    };
    let report = audit_case(&*method, case, &Settings::default());
    assert_eq!(
        report.judgement.verdict,
        Verdict::Pass,
        "{:?}",
        report.judgement.reason
    );
    // In the middle |A⁻¹| 1 is 1/(4 − 2/3), and |A| |x| + |d| is 2 (4 + 2/3).
    let due = 2.0 * (4.0 + 2.0 * third) / (4.0 - 2.0 * third);
    let condition = report.judgement.components[n / 2].condition;
    assert!((condition / due - 1.0).abs() < 1e-12, "{condition}, {due}");
}
