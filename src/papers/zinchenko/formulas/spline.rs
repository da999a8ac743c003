//! The cubic spline: formulas (8) to (17) and the inline right-hand sides.

use super::exact::{Grid, Identity, Q};
use super::{Outcome, agree, draft};
use crate::papers::{Finding, FindingVerdict, figures};

/// One section of the spline, between nodes i and i + 1.
#[derive(Clone)]
pub(super) struct Section {
    /// Dimensionless argument.
    k: Q,
    /// Second derivatives at the ends.
    m: [Q; 2],
    /// Ordinates at the ends.
    y: [Q; 2],
    /// Step.
    h: Q,
}

/// Three neighbouring nodes.
pub(super) struct Nodes {
    m: [Q; 3],
    y: [Q; 3],
    h: Q,
}

type OnSection = fn(&Section) -> Q;
type OnNodes = fn(&Nodes) -> Q;

/// The formulas, as functions.
#[derive(Clone, Copy)]
pub(super) struct Forms {
    /// (8).
    second: OnSection,
    /// (9), with C1 apart.
    slope: fn(&Section, &Q) -> Q,
    /// (10), with C1 and C2 apart.
    value: fn(&Section, &Q, &Q) -> Q,
    c1: OnSection,
    c2: OnSection,
    /// (11).
    slope_collected: OnSection,
    /// The line between (11) and (12).
    value_substituted: OnSection,
    /// (12).
    value_collected: OnSection,
    /// (13).
    slope_left: OnNodes,
    /// (14).
    slope_right: OnNodes,
    /// (15), left and right side.
    continuity: (OnNodes, OnNodes),
    /// (16), left and right side.
    moments: (OnNodes, OnNodes),
    /// d_i as given in the text.
    inline: OnNodes,
    /// `d_i h²/6` as given in table 1.
    table: OnNodes,
}

/// As printed.
pub(super) const PRINTED: Forms = Forms {
    second: |s| &s.m[0] + &s.k * (&s.m[1] - &s.m[0]),
    slope: |s, c1| (&s.m[1] - &s.m[0]) * (&s.k * &s.k * &s.h / 2) + &s.m[0] * &s.k * &s.h + c1,
    value: |s, c1, c2| {
        let kh = &s.k * &s.h;
        (&s.m[1] - &s.m[0]) * (&s.k * &kh * &kh / 6) + &s.m[0] * (&kh * &kh / 2) + c1 * &kh + c2
    },
    c1: |s| (&s.y[1] - &s.y[0]) / &s.h - (&s.m[1] - &s.m[0]) * (&s.h / 6) - &s.m[0] * (&s.h / 2),
    c2: |s| s.y[0].clone(),
    slope_collected: |s| {
        let kk = &s.k * &s.k;
        let left = Q::from(2) - &s.k * 6 + &kk * 3;
        let right = Q::from(1) - &kk * 3;
        (&s.y[1] - &s.y[0]) / &s.h - (&s.h / 6) * (left * &s.m[0] + right * &s.m[1])
    },
    value_substituted: |s| {
        let (k, h) = (&s.k, &s.h);
        let rise = (&s.y[1] - &s.y[0]) / h - (&s.m[1] - &s.m[0]) * (h / 6) - &s.m[0] * (h / 2);
        (&s.m[1] - &s.m[0]) * (k * k * k * h * h / 6)
            + &s.m[0] * k * k * (h * h * 3 / 6)
            + k * h * rise
            + &s.y[0]
    },
    value_collected: |s| {
        let (k, h) = (&s.k, &s.h);
        let inner = k * ((&s.m[1] - &s.m[0]) * k + &s.m[0] * 3) - (&s.m[1] + &s.m[0] * 2);
        &s.y[1] * k + &s.y[0] * (Q::from(1) - k) + k * h * h / 6 * inner
    },
    slope_left: |n| (&n.y[1] - &n.y[0]) / &n.h - &n.h / 6 * (-&n.m[0] - &n.m[1] * 2),
    slope_right: |n| (&n.y[2] - &n.y[1]) / &n.h - &n.h / 6 * (&n.m[2] + &n.m[1] * 2),
    continuity: (
        |n| (&n.y[1] - &n.y[0]) / &n.h - &n.h / 6 * (-&n.m[0] - &n.m[1] * 2),
        |n| (&n.y[2] - &n.y[1]) / &n.h - &n.h / 6 * (&n.m[1] * 2 + &n.m[2]),
    ),
    moments: (
        |n| &n.m[0] + &n.m[1] * 4 + &n.m[2],
        |n| Q::from(6) / (&n.h * &n.h) * (&n.y[0] - &n.y[1] * 2 + &n.y[2]),
    ),
    inline: |n| Q::from(6) / (&n.h * &n.h) * (&n.y[0] - &n.y[1] * 2 + &n.y[2]),
    table: |n| &n.y[2] - &n.y[1] * 2 + &n.y[0],
};

/// `∫ f dk` from 0 to k by Simpson's rule, which is exact for cubics.
fn simpson(s: &Section, f: impl Fn(&Section) -> Q) -> Q {
    let value = |k: Q| f(&at(s, k));
    &s.k / 6 * (value(Q::from(0)) + value(&s.k / 2) * 4 + value(s.k.clone()))
}

/// Degrees at most 4 in k, 1 in every m and y, and 4 in h after multiplication by h.
fn on_sections(f: impl Fn(&Section) -> Q) -> Identity {
    Grid::new(&[4, 1, 1, 1, 1, 4]).vanishes(|v| {
        f(&Section {
            k: v[0].clone(),
            m: [v[1].clone(), v[2].clone()],
            y: [v[3].clone(), v[4].clone()],
            h: v[5].clone(),
        })
    })
}

/// Degrees at most 1 in every m and y, and 4 in h after multiplication by h².
fn on_nodes(f: impl Fn(&Nodes) -> Q) -> Identity {
    Grid::new(&[1, 1, 1, 1, 1, 1, 4]).vanishes(|v| {
        f(&Nodes {
            m: [v[0].clone(), v[1].clone(), v[2].clone()],
            y: [v[3].clone(), v[4].clone(), v[5].clone()],
            h: v[6].clone(),
        })
    })
}

/// The same section at another k.
fn at(s: &Section, k: impl Into<Q>) -> Section {
    Section {
        k: k.into(),
        ..s.clone()
    }
}

fn construction(f: &Forms) -> Finding {
    let slope = |s: &Section| (f.slope)(s, &(f.c1)(s));
    let value = |s: &Section| (f.value)(s, &(f.c1)(s), &(f.c2)(s));
    let identities = [
        // (8) takes the nodal values.
        on_sections(|s| (f.second)(&at(s, 0)) - &s.m[0]),
        on_sections(|s| (f.second)(&at(s, 1)) - &s.m[1]),
        // (9) and (10) are its integrals over x = k h.
        on_sections(|s| slope(s) - slope(&at(s, 0)) - simpson(s, f.second) * &s.h),
        on_sections(|s| value(s) - value(&at(s, 0)) - simpson(s, slope) * &s.h),
        // C1 and C2 make the section pass through both nodes.
        on_sections(|s| value(&at(s, 0)) - &s.y[0]),
        on_sections(|s| value(&at(s, 1)) - &s.y[1]),
        // (11), the line before (12), and (12) are the same polynomials.
        on_sections(|s| (f.slope_collected)(s) - slope(s)),
        on_sections(|s| (f.value_substituted)(s) - value(s)),
        on_sections(|s| (f.value_collected)(s) - value(s)),
    ];
    let (outcome, points) = Identity::all(&identities);
    draft("formula-8-12", "(8)-(12), C1, C2")
        .verdict(FindingVerdict::Confirmed)
        .titled("The spline on one section is right, including (12)")
        .text(
            "Integrating (8) twice gives (9) and (10); the printed C1 and C2 make the section pass \
             through its two nodes; (11), the unnumbered line after it, and (12) are the same \
             polynomials collected differently. Each step was proved as an identity of \
             polynomials in k, h and the nodal values, in exact rationals.",
        )
        .figures(figures! {
            "identities proved": "{}", identities.len() => "1";
            "exact evaluations": "{}", points => "1";
        })
        .recorded_if(agree(&[(outcome, Outcome::Holds)]))
}

/// The sections left and right of the middle node.
fn sections(n: &Nodes) -> [Section; 2] {
    let section = |i: usize, k: i32| Section {
        k: Q::from(k),
        m: [n.m[i].clone(), n.m[i + 1].clone()],
        y: [n.y[i].clone(), n.y[i + 1].clone()],
        h: n.h.clone(),
    };
    [section(0, 1), section(1, 0)]
}

fn continuity(f: &Forms) -> Finding {
    let gap = |n: &Nodes| (f.continuity.1)(n) - (f.continuity.0)(n);
    let identities = [
        on_nodes(|n| (f.slope_left)(n) - (f.slope_collected)(&sections(n)[0])),
        on_nodes(|n| (f.slope_right)(n) - (f.slope_collected)(&sections(n)[1])),
        on_nodes(|n| (f.continuity.0)(n) - (f.slope_left)(n)),
        on_nodes(|n| (f.continuity.1)(n) - (f.slope_right)(n)),
        // (15), right minus left, is h/6 times (16), right minus left.
        on_nodes(|n| gap(n) - &n.h / 6 * ((f.moments.1)(n) - (f.moments.0)(n))),
    ];
    let (outcome, points) = Identity::all(&identities);
    draft("formula-13-16", "(13)-(16)")
        .verdict(FindingVerdict::Confirmed)
        .titled("The continuity of the slope leads to (16) as printed")
        .text(
            "(13) and (14) are formula (11) at the end of one section and at the start of the next, \
             (15) equates them, and (16) is (15) multiplied by 6/h. All signs are right, also the \
             two minus signs in the bracket of (13). Proved as identities in exact rationals.",
        )
        .figures(figures! {
            "identities proved": "{}", identities.len() => "1";
            "exact evaluations": "{}", points => "1";
        })
        .recorded_if(agree(&[(outcome, Outcome::Holds)]))
}

fn inline(f: &Forms) -> Finding {
    let identities = [
        on_nodes(|n| (f.inline)(n) - (f.moments.1)(n)),
        on_nodes(|n| (f.inline)(n) * &n.h * &n.h / 6 - (f.table)(n)),
    ];
    let (outcome, points) = Identity::all(&identities);
    // The fragment's factor 6/2 in place of 6/h² on y = 0, 0, 1 with h = 1.
    let simple = Nodes {
        m: [0, 0, 0].map(Q::from),
        y: [0, 0, 1].map(Q::from),
        h: Q::from(1),
    };
    let (due, fragment) = ((f.inline)(&simple), (f.table)(&simple) * 3);
    draft("inline-d", "text after (17), table 1")
        .verdict(FindingVerdict::Confirmed)
        .titled("The right-hand sides d_i are right; a garbled copy stands before them in the scan")
        .text(
            "The d_i of the text and the column d_i h²/6 of Table 1 are both the right-hand side of \
             (16), proved exactly. The text layer of the scan has a broken copy of the same line \
             in front of it that reads m_1 = 6/2 (m_2 = 2m + m_2). It is no formula, and a factor \
             6/2 in place of 6/h² would be wrong for every step but √2.",
        )
        .figures(figures! {
            "exact evaluations": "{}", points => "1";
            "d_i for y = 0, 0, 1 and h = 1": "{}", due => "1";
            "the same with the factor 6/2": "{}", fragment => "1";
        })
        .recorded_if(agree(&[
            (outcome, Outcome::Holds),
            (Outcome::of(fragment == due), Outcome::Fails),
        ]))
}

/// Longest chain of sections that (17) is tried on.
const LONGEST: usize = 200;

/// m_{i+1} from m_{i-1} and m_i by (16), for a given right-hand side.
fn next(d: &Q, before: &Q, m: &Q) -> Q {
    d - m * 4 - before
}

/// Any m_0 and m_1 can be continued by (16), node by node, whatever the right-hand sides: two conditions are missing, not
/// more, not fewer.
fn continued(f: &Forms) -> Identity {
    Grid::new(&[1, 1, 1]).vanishes(|v| {
        let [before, m, d] = <&[Q; 3]>::try_from(v).expect("three variables");
        let m = [before.clone(), m.clone(), next(d, before, m)];
        let y = [0, 0, 0].map(Q::from);
        let h = Q::from(1);
        (f.moments.0)(&Nodes { m, y, h }) - d
    })
}

/// Whether m_1 enters every m_n from n = 2 on.
fn closed(gain: &[Q]) -> bool {
    gain[2..].iter().all(|g| !g.is_zero())
}

fn ends(f: &Forms) -> Finding {
    let free = continued(f);
    // With m_0 given, m_n = (known) + g_n m_1: (17) has one solution exactly when g_n is not zero.
    let none = Q::from(0);
    let mut gain = vec![none.clone(), Q::from(1)];
    while let [.., a, b] = &gain[..]
        && gain.len() <= LONGEST
    {
        gain.push(next(&none, a, b));
    }
    draft("formula-17", "(17)")
        .verdict(FindingVerdict::Confirmed)
        .titled("Prescribed end values close the system, for functions that are not periodic")
        .text(
            "The n − 1 equations (16) leave exactly two values free, and prescribing m_0 and m_n \
             fixes them: with m_0 given, m_n depends on m_1 through a factor that is not zero, \
             computed exactly for every n up to 200. \
             The paper itself reserves (17) for functions that are not periodic. I_n, dI_n/dφ and \
             M_o are periodic in the crank angle, so its own tables call for the other kind of \
             end conditions; see the finding on the tables.",
        )
        .figures(figures! {
            "numbers of sections tried, from 2 to": "{}", LONGEST => "1";
            "factor of m_1 in m_n for n = 12": "{}", gain[12] => "1";
        })
        .recorded_if(agree(&[
            (free.outcome(), Outcome::Holds),
            (Outcome::of(closed(&gain)), Outcome::Holds),
        ]))
}

/// The findings on the spline.
pub(super) fn findings(f: &Forms) -> Vec<Finding> {
    vec![construction(f), continuity(f), ends(f), inline(f)]
}

#[cfg(test)]
mod tests {
    use super::super::found;
    use super::*;

    fn lost(due: &[&str], plant: fn(&mut Forms)) {
        found(PRINTED, findings, due, plant);
    }

    #[test]
    fn planted_faults_are_found() {
        lost(&[], |_| ());
        let first = &["formula-8-12"];
        let second = &["formula-13-16"];
        lost(first, |f| {
            f.second = |s| &s.m[1] + &s.k * (&s.m[1] - &s.m[0])
        });
        lost(first, |f| f.slope = |s, c| (PRINTED.slope)(s, c) + &s.k);
        lost(first, |f| {
            f.value = |s, a, _| (PRINTED.value)(s, a, &s.y[1])
        });
        lost(first, |f| f.c1 = |s| (PRINTED.c1)(s) + &s.m[1] * &s.h);
        lost(first, |f| f.c2 = |s| s.y[1].clone());
        lost(first, |f| {
            f.value_collected = |s| (PRINTED.value_collected)(s) + &s.k - 1
        });
        lost(first, |f| {
            f.value_substituted = |s| (PRINTED.value_substituted)(s) - &s.h
        });
        lost(&["formula-8-12", "formula-13-16"], |f| {
            f.slope_collected = |s| (PRINTED.slope_collected)(s) + &s.m[1]
        });
        // The bracket of (13) without its signs.
        lost(second, |f| {
            f.slope_left = |n| (&n.y[1] - &n.y[0]) / &n.h - &n.h / 6 * (&n.m[0] + &n.m[1] * 2)
        });
        lost(second, |f| f.slope_right = |n| (PRINTED.slope_right)(n) + 1);
        lost(second, |f| {
            f.continuity = (|n| n.h.clone(), PRINTED.continuity.1)
        });
        lost(&["formula-13-16", "formula-17"], |f| {
            f.moments = (|n| &n.m[0] + &n.m[1] * 3 + &n.m[2], PRINTED.moments.1)
        });
        lost(&["inline-d"], |f| f.inline = |n| (PRINTED.table)(n) * 3);
        lost(&["inline-d"], |f| f.table = |n| (PRINTED.table)(n) * 2);
    }

    /// One value more than its degree for each variable.
    #[test]
    fn grids_have_as_many_points_as_proofs_ask_for() {
        assert_eq!(on_sections(|_| Q::from(0)).points, 5 * 2 * 2 * 2 * 2 * 5);
        assert_eq!(on_nodes(|_| Q::from(0)).points, 64 * 5);
        assert_eq!(continued(&PRINTED).points, 8);
    }

    /// No two variables are one.
    #[test]
    fn variables_are_tried_apart() {
        for i in 0..6 {
            for j in 0..i {
                let differ = on_sections(|s| {
                    let all = [&s.k, &s.m[0], &s.m[1], &s.y[0], &s.y[1], &s.h];
                    all[i] - all[j]
                });
                assert_eq!(differ.outcome(), Outcome::Fails, "{i} {j}");
            }
        }
        for i in 0..7 {
            for j in 0..i {
                let differ = on_nodes(|n| {
                    let all = [&n.m[0], &n.m[1], &n.m[2], &n.y[0], &n.y[1], &n.y[2], &n.h];
                    all[i] - all[j]
                });
                assert_eq!(differ.outcome(), Outcome::Fails, "{i} {j}");
            }
        }
    }

    #[test]
    fn the_fragment_is_half_of_what_is_due() {
        let values = inline(&PRINTED).figures.into_iter().map(|f| f.value);
        assert_eq!(values.skip(1).collect::<Vec<_>>(), ["6", "3"]);
    }

    #[test]
    fn a_factor_that_vanishes_leaves_the_system_open() {
        let closed =
            |gain: &[i32]| super::closed(&gain.iter().map(|g| Q::from(*g)).collect::<Vec<_>>());
        assert_eq!(ends(&PRINTED).figures[1].value, "-2107560");
        assert!(closed(&[0, 0, -4, 15]));
        assert!(!closed(&[0, 1, -4, 0]) && !closed(&[0, 1, 0, 15]));
    }
}
