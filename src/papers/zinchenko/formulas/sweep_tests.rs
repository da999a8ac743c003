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
