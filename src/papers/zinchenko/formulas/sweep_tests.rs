//! Tests of `sweep`.

use super::super::found;
use super::*;

fn lost(due: &[&str], plant: fn(&mut Forms)) {
    found(PRINTED, findings, due, plant);
}

#[test]
fn planted_faults_are_found() {
    lost(&[], |_| ());
    // A recorded error that is no longer there counts as a change, too.
    lost(&["formula-18"], |f| f.canonical = CORRECTED.canonical);
    lost(&["table-1-last-row"], |f| f.table[2] = CORRECTED.table[2]);
    lost(&["lambda-1-eta-1"], |f| f.start = CORRECTED.start);
    lost(&["formula-20"], |f| f.first = 1);
    // Other faults.
    lost(&["lambda-1-eta-1"], |f| f.start = |_| (q(1, 3), Q::from(0)));
    lost(&["formula-20"], |f| f.backward = |m, l, e| m * l - e);
    lost(&["formula-19"], |f| {
        f.forward = |v| {
            let (l, e) = (PRINTED.forward)(v);
            (l, -e)
        }
    });
    lost(&["table-1-last-row"], |f| f.table[2] = [0, 2, 0]);
    lost(&["lambda-1-eta-1"], |f| f.table[0] = [0, 1, 0]);
    // (19) has no λ_2.
    lost(&["lambda-1-eta-1"], |f| {
        f.start = |_| (Q::from(-4), Q::from(0))
    });
}

#[test]
fn the_test_problem_is_solved_by_elimination_too() {
    // Cramer's rule on the first unknown after the ends, by a different elimination: shoot from
    // m_0 and fix m_1 by the end value.
    let p = given();
    let n = p.nodes();
    let shoot = |m1: Q| {
        let mut m = vec![p.u0.clone(), m1];
        for i in 1..n {
            let d = (&p.y[i - 1] - &p.y[i] * 2 + &p.y[i + 1]) * 24;
            m.push(d - &m[i] * 4 - &m[i - 1]);
        }
        m
    };
    let (at0, at1) = (shoot(Q::from(0)), shoot(Q::from(1)));
    let m1 = (&p.un - &at0[n]) / (&at1[n] - &at0[n]);
    assert_eq!(p.sweep(&CORRECTED).unwrap(), shoot(m1));
}

#[test]
fn the_end_values_are_those_of_the_text() {
    let of = |f: Finding| f.figures[1].value.clone();
    assert_eq!([start, last_row].map(|f| of(f(&PRINTED))), ["3", "-5"]);
}

#[test]
fn the_end_alone_is_off() {
    let p = given();
    let off = |r: [i32; 3]| only_the_end(&p, &r.map(Q::from));
    assert!(off([-3, 0, 0]));
    assert!(!off([3, 0, 0]) && !off([0, 0, 0]));
    assert!(!off([-3, 1, 0]) && !off([-3, 0, 1]));
}

/// Three values for each variable of degree 2, two of degree 1.
#[test]
fn identities_are_tried_on_the_whole_grid() {
    assert_eq!(canonical_identity(&CORRECTED).points, 8);
    assert_eq!(forward_identity(&PRINTED).points, 2187);
}

/// y = 2, −1, 4, 0, 5, −3, 1 with steps of 1/2 and the end values 3 and U_n, row by row: second differences over h²/6,
/// and m by shooting.
fn by_hand(un: i32) -> Vec<Q> {
    let d = [8, -9, 9, -13, 12].map(|x| Q::from(24 * x));
    let shoot = |m1: i32| {
        let mut m = vec![Q::from(3), Q::from(m1)];
        for (i, d) in d.iter().enumerate() {
            m.push(d - &m[i + 1] * 4 - &m[i]);
        }
        m
    };
    let (at0, at1) = (shoot(0), shoot(1));
    let m1 = (Q::from(un) - &at0[6]) / (&at1[6] - &at0[6]);
    let along = |(a, b): (&Q, &Q)| a + &m1 * (b - a);
    at0.iter().zip(&at1).map(along).collect()
}

#[test]
fn the_test_problem_is_the_one_of_the_texts() {
    let p = given();
    assert_eq!(p.nodes(), 6);
    let due = by_hand(-5);
    assert_eq!(p.sweep(&CORRECTED).unwrap(), due);
    assert!(all_zero(&p.residuals(&due)));
    let d: Vec<Q> = p.rows(&CORRECTED).into_iter().map(|r| r.d).collect();
    assert_eq!(d, [3, 192, -216, 216, -312, 288, -5].map(Q::from));
    // The last row gives the same, as printed the mirrored end.
    assert_eq!(p.sweep_to(&CORRECTED, 6).unwrap(), due);
    let shown = |f: Finding| -> Vec<String> { f.figures.into_iter().map(|f| f.value).collect() };
    let wrong = by_hand(5);
    assert_eq!(
        shown(last_row(&PRINTED)),
        [
            "5".into(),
            "-5".into(),
            wrong[5].to_string(),
            due[5].to_string()
        ]
    );
    assert_eq!(shown(canonical(&PRINTED)), ["48", "72", "-24"]);
    assert_eq!(shown(forward(&PRINTED)), ["2187", "7"]);
    assert_eq!(shown(backward(&PRINTED)), ["6", "6", "5"]);
    let started = shown(start(&PRINTED));
    assert_eq!([&started[0], &started[1], &started[4]], ["0", "3", "0"]);
    assert_eq!(started[3], due[1].to_string());
}

/// Each equation by itself: one value of m changed breaks its own and its neighbours'.
#[test]
fn residuals_are_those_of_the_equations() {
    let p = given();
    let right = by_hand(-5);
    for k in 0..7 {
        let mut m = right.clone();
        m[k] = &m[k] + 1;
        let found = p.residuals(&m);
        for (i, r) in found.iter().enumerate() {
            let due = match i.abs_diff(k) {
                0 if i == 0 || i == 6 => 1,
                0 => 4,
                1 if i != 0 && i != 6 => 1,
                _ => 0,
            };
            assert_eq!(*r, Q::from(due), "{k} {i}");
        }
    }
}

/// A row that has no solution for its unknown ends the sweep: b = a λ with λ₁ = −4 in row 1.
#[test]
fn a_division_by_zero_ends_the_sweep() {
    let forms = Forms {
        start: |_| (Q::from(-4), Q::from(0)),
        ..CORRECTED
    };
    assert!(given().sweep(&forms).is_none());
    assert!(given().sweep(&PRINTED).is_none());
}
