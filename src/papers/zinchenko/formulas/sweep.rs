//! The tridiagonal system and its sweep: (18), table 1, (19), λ1 = η1 = 0, (20).

use super::exact::{Grid, Identity, Q, q};
use super::{Outcome, agree, draft};
use crate::papers::{Finding, FindingVerdict, figures};

/// One equation of the tridiagonal system.
#[derive(Clone, Debug)]
struct Row {
    a: Q,
    b: Q,
    c: Q,
    d: Q,
}

/// The formulas, as functions.
#[derive(Clone, Copy)]
pub(super) struct Forms {
    /// Left side of (18) from a, b, c and m_{i−1}, m_i, m_{i+1}.
    canonical: fn(&Q, &Q, &Q, &[Q; 3]) -> Q,
    /// a, b, c of table 1: row 0, inner rows, row n.
    table: [[i32; 3]; 3],
    /// (19): λ_{i+1} and η_{i+1} from a, b, c, d, λ_i, η_i.
    forward: fn(&[Q; 6]) -> (Q, Q),
    /// λ1 and η1 from U_0.
    start: fn(&Q) -> (Q, Q),
    /// (20): m_i from m_{i+1}, λ_{i+1}, η_{i+1}.
    backward: fn(&Q, &Q, &Q) -> Q,
    /// The first i of (20), as a distance from n.
    first: usize,
}

/// As printed.
pub(super) const PRINTED: Forms = Forms {
    canonical: |a, b, c, m| a * &m[0] - b * &m[0] + c * &m[2],
    table: [[0, -1, 0], [1, -4, 1], [0, 1, 0]],
    forward: |v| {
        let [a, b, c, d, lambda, eta] = v;
        let denominator = b - a * lambda;
        (c / &denominator, (a * eta - d) / &denominator)
    },
    start: |_| (Q::from(0), Q::from(0)),
    backward: |m, lambda, eta| m * lambda + eta,
    first: 0,
};

/// With the corrections.
const CORRECTED: Forms = Forms {
    canonical: |a, b, c, m| a * &m[0] - b * &m[1] + c * &m[2],
    table: [[0, -1, 0], [1, -4, 1], [0, -1, 0]],
    start: |u0| (Q::from(0), u0.clone()),
    first: 1,
    ..PRINTED
};

/// A problem with end values that are not zero.
struct Problem {
    y: Vec<Q>,
    h: Q,
    u0: Q,
    un: Q,
}

fn problem(u0: i32, un: i32) -> Problem {
    Problem {
        y: [2, -1, 4, 0, 5, -3, 1].map(Q::from).to_vec(),
        h: q(1, 2),
        u0: Q::from(u0),
        un: Q::from(un),
    }
}

/// The one that the texts speak of.
fn given() -> Problem {
    problem(3, -5)
}

impl Problem {
    /// Table 1 with its column `d h²/6` divided by `h²/6`.
    fn rows(&self, f: &Forms) -> Vec<Row> {
        let n = self.y.len() - 1;
        let factor = &self.h * &self.h / 6;
        (0..=n)
            .map(|i| {
                let (which, d) = match i {
                    0 => (0, &self.u0 * &factor),
                    i if i == n => (2, &self.un * &factor),
                    _ => (1, &self.y[i + 1] - &self.y[i] * 2 + &self.y[i - 1]),
                };
                let [a, b, c] = f.table[which].map(Q::from);
                let d = d / &factor;
                Row { a, b, c, d }
            })
            .collect()
    }

    /// What is left of equations (16) at the inner nodes and of (17) at the ends.
    fn residuals(&self, m: &[Q]) -> Vec<Q> {
        let n = self.y.len() - 1;
        let mut r = vec![&m[0] - &self.u0];
        for i in 1..n {
            let d = (&self.y[i - 1] - &self.y[i] * 2 + &self.y[i + 1]) * 6 / &self.h / &self.h;
            r.push(&m[i - 1] + &m[i] * 4 + &m[i + 1] - d);
        }
        r.push(&m[n] - &self.un);
        r
    }

    /// (19) for i = 1 … n − 1, then (20) from the paper's `m_n = U_n`.
    fn sweep(&self, f: &Forms) -> Option<Vec<Q>> {
        self.sweep_to(f, self.nodes() - 1)
    }

    /// (19) for i = 1 … `last`, then (20). With `last = n` the last row of table 1 gives
    /// `m_n = η_{n+1}`; with n − 1 the paper's `m_n = U_n` starts the way back. `None` if an entry
    /// is asked for that (19) has not made.
    fn sweep_to(&self, f: &Forms, last: usize) -> Option<Vec<Q>> {
        let n = self.y.len() - 1;
        let rows = self.rows(f);
        let mut factors = vec![None, Some((f.start)(&self.u0))];
        for (i, row) in rows.iter().enumerate().take(last + 1).skip(1) {
            let (lambda, eta) = factors[i].clone()?;
            let [a, b, c, d] = [&row.a, &row.b, &row.c, &row.d].map(Clone::clone);
            if (&b - &a * &lambda).is_zero() {
                return None;
            }
            factors.push(Some((f.forward)(&[a, b, c, d, lambda, eta])));
        }
        let mut m = vec![None; n + 1];
        m[n] = Some(if last == n {
            factors[n + 1].clone()?.1
        } else {
            self.un.clone()
        });
        for i in (0..=n - f.first).rev() {
            let (lambda, eta) = factors.get(i + 1)?.as_ref()?;
            m[i] = Some((f.backward)(m.get(i + 1)?.as_ref()?, lambda, eta));
        }
        m.into_iter().collect()
    }

    fn nodes(&self) -> usize {
        self.y.len() - 1
    }
}

fn all_zero(r: &[Q]) -> bool {
    r.iter().all(Q::is_zero)
}

/// Left side of (18) with table 1's inner row against (16), for any d.
fn canonical_identity(f: &Forms) -> Identity {
    let [a, b, c] = f.table[1].map(Q::from);
    Grid::new(&[1, 1, 1]).vanishes(|m| {
        let m = <&[Q; 3]>::try_from(m).expect("three variables");
        let [before, here, after] = m;
        (f.canonical)(&a, &b, &c, m) - (before + here * 4 + after)
    })
}

fn canonical(f: &Forms) -> Finding {
    let printed = canonical_identity(f);
    let corrected = canonical_identity(&CORRECTED);
    // y = x³ at x = 1, 2, 3 has m = 6, 12, 18 and d = 6 (1 − 2·8 + 27) = 72.
    let m = [6, 12, 18].map(Q::from);
    let [a, b, c] = f.table[1].map(Q::from);
    let [left, right] = [f, &CORRECTED].map(|f| (f.canonical)(&a, &b, &c, &m));
    draft("formula-18", "(18)")
        .verdict(FindingVerdict::PrintOrScan)
        .titled("The index of the middle term of (18) is wrong")
        .text(
            "Printed is a_i m_{i-1} − b_i m_{i-1} + c_i m_{i+1} = d_i, with m_{i-1} twice; the \
             middle term has to be b_i m_i, and then the coefficients of Table 1 give (16) exactly. \
             For y = x³ at x = 1, 2, 3 the printed left side is 48 where (16) asks for 72. The \
             sweep (19) belongs to the correct form, so nothing computed with it is affected. The \
             scan alone does not tell whether the paper or its text layer has the wrong index.",
        )
        .figures(figures! {
            "left side as printed, y = x^3": "{}", left => "1";
            "right side d_i, y = x^3": "{}", right => "1";
            "residual": "{}", &left - &right => "1";
        })
        .recorded_if(agree(&[
            (printed.outcome(), Outcome::Fails),
            (corrected.outcome(), Outcome::Holds),
            (Outcome::of(left == Q::from(48)), Outcome::Holds),
            (Outcome::of(right == Q::from(72)), Outcome::Holds),
        ]))
}

fn last_row(f: &Forms) -> Finding {
    let problem = given();
    let n = problem.nodes();
    // Everything else right, so that the row alone is tested.
    let with = |row: [i32; 3]| {
        let mut forms = CORRECTED;
        forms.table[2] = row;
        problem.sweep_to(&forms, n).unwrap_or_default()
    };
    let printed = with(f.table[2]);
    let corrected = with(CORRECTED.table[2]);
    let solves = |m: &[Q]| m.len() == n + 1 && all_zero(&problem.residuals(m));
    let mirrored = printed.last() == Some(&-&problem.un);
    // Started with m_n = U_n the row is never read.
    let mut forms = CORRECTED;
    forms.table[2] = f.table[2];
    let bypassed = problem.sweep(&forms).is_some_and(|m| solves(&m));
    // How fast the wrong end value fades: 10 at the end, less at each node before it.
    let changes = printed.iter().zip(&corrected).map(|(a, b)| (a - b).abs());
    let changes: Vec<Q> = changes.rev().take(3).collect();
    let fading = |pair: &[Q]| {
        let [outer, inner] = [&pair[0], &pair[1]];
        outer.0 > (inner * q(37, 10)).0 && outer.0 < (inner * q(38, 10)).0
    };
    let fades = changes.len() == 3 && changes.windows(2).all(fading);
    let level = self::problem(3, 0);
    let harmless = level
        .sweep_to(&forms, n)
        .is_some_and(|m| all_zero(&level.residuals(&m)));
    let shown = |m: &[Q], i: usize| m.get(i).map_or("undecided".into(), Q::to_string);
    draft("table-1-last-row", "Table 1, last row")
        .verdict(FindingVerdict::PrintOrScan)
        .titled("b_n has to be −1, as b_0 is")
        .text(
            "Table 1 prints b_0 = −1 and b_n = 1. With the signs of (18) the last row then says \
             m_n = −U_n: in the test with U_n = −5 the sweep returns 5, and the wrong end value \
             reaches inwards, shrinking by about 3.7 per node. With b_n = −1 every equation is \
             satisfied exactly. It does no harm if the way back is started with m_n = U_n, as the \
             text says, because the row is then never read; nor if U_n = 0.",
        )
        .figures(figures! {
            "m_n with the printed row, U_n = -5": "{}", shown(&printed, n) => "1";
            "m_n with b_n = -1": "{}", shown(&corrected, n) => "1";
            "m_(n-1) with the printed row": "{}", shown(&printed, n - 1) => "1";
            "m_(n-1) with b_n = -1": "{}", shown(&corrected, n - 1) => "1";
        })
        .recorded_if(agree(&[
            (Outcome::of(solves(&printed)), Outcome::Fails),
            (Outcome::of(mirrored), Outcome::Holds),
            (Outcome::of(solves(&corrected)), Outcome::Holds),
            (Outcome::of(bypassed), Outcome::Holds),
            (Outcome::of(fades), Outcome::Holds),
            (Outcome::of(harmless), Outcome::Holds),
        ]))
}

/// `m_{i−1} = λ m_i + η` and `m_i = λ' m_{i+1} + η'` put into the corrected (18). Times `b − a λ`
/// the residual has degree at most 2 in every variable; on the grid a λ is an odd and b an even
/// number of twelfths, so they differ.
fn forward_identity(f: &Forms) -> Identity {
    Grid::new(&[2, 2, 2, 2, 2, 2, 2]).vanishes(|v| {
        let [a, b, c, d, lambda, eta, after] = <&[Q; 7]>::try_from(v).expect("seven variables");
        let input = [a, b, c, d, lambda, eta].map(Clone::clone);
        let (next_lambda, next_eta) = (f.forward)(&input);
        let m = next_lambda * after + next_eta;
        let before = lambda * &m + eta;
        a * before - b * m + c * after - d
    })
}

fn forward(f: &Forms) -> Finding {
    let identity = forward_identity(f);
    let problem = given();
    let forms = Forms {
        forward: f.forward,
        ..CORRECTED
    };
    let solved = problem
        .sweep(&forms)
        .is_some_and(|m| all_zero(&problem.residuals(&m)));
    draft("formula-19", "(19)")
        .verdict(FindingVerdict::Confirmed)
        .titled("The forward sweep is right for the corrected (18)")
        .text(
            "Put into (18) with the middle index corrected, m_i = λ_{i+1} m_{i+1} + η_{i+1} with the \
             printed λ and η satisfies the equation identically; this was proved exactly. A test \
             with six sections and end values 3 and −5 then leaves no residual at all in any \
             equation, inner or at the ends.",
        )
        .figures(figures! {
            "grid points of the exact identity": "{}", identity.points => "1";
            "equations solved without residual": "{}", problem.nodes() + 1 => "1";
        })
        .recorded_if(agree(&[
            (identity.outcome(), Outcome::Holds),
            (Outcome::of(solved), Outcome::Holds),
        ]))
}

/// Whether m_0 = 0 in place of U_0, and all other equations hold.
fn only_the_end(given: &Problem, residuals: &[Q]) -> bool {
    residuals[0] == -&given.u0 && all_zero(&residuals[1..])
}

fn start(f: &Forms) -> Finding {
    let solve = |start, problem: &Problem| {
        let forms = Forms { start, ..CORRECTED };
        problem.sweep(&forms).unwrap_or_default()
    };
    let given = given();
    let printed = solve(f.start, &given);
    let corrected = solve(CORRECTED.start, &given);
    let natural = problem(0, -5);
    let harmless = solve(f.start, &natural);
    let rest = |p: &Problem, m: &[Q]| match m.len() == p.nodes() + 1 {
        true => p.residuals(m),
        false => vec![Q::from(1)],
    };
    let r = rest(&given, &printed);
    let only_the_end = only_the_end(&given, &r);
    // Row 0 of Table 1 in (19), before which there is nothing.
    let Row { a, b, c, d } = given.rows(f).swap_remove(0);
    let by_19 = (CORRECTED.forward)(&[a, b, c, d, Q::from(0), Q::from(0)]);
    let shown = |m: &[Q], i: usize| m.get(i).map_or("undecided".into(), Q::to_string);
    draft("lambda-1-eta-1", "text after (19)")
        .verdict(FindingVerdict::ErrorOfPaper)
        .titled("λ_1 = 0 is right, η_1 has to be U_0")
        .text(
            "The paper takes λ_1 = η_1 = 0 because a_0 and c_0 are zero. Formula (19) at i = 0 gives \
             λ_1 = 0 but η_1 = −d_0/b_0 = U_0. With η_1 = 0 the given end value is ignored: in the \
             test with U_0 = 3 the sweep returns m_0 = 0, and since all other equations are \
             satisfied exactly nothing looks wrong. Right only for U_0 = 0, the case the paper \
             calls the most frequent.",
        )
        .figures(figures! {
            "m_0 with eta_1 = 0, U_0 = 3": "{}", shown(&printed, 0) => "1";
            "m_0 with eta_1 = U_0": "{}", shown(&corrected, 0) => "1";
            "m_1 with eta_1 = 0": "{}", shown(&printed, 1) => "1";
            "m_1 with eta_1 = U_0": "{}", shown(&corrected, 1) => "1";
            "largest residual of the other equations with eta_1 = 0":
                "{}", r[1..].iter().map(Q::abs).fold(Q::from(0), Q::max) => "1";
        })
        .recorded_if(agree(&[
            (Outcome::of(all_zero(&r)), Outcome::Fails),
            (Outcome::of(only_the_end), Outcome::Holds),
            (Outcome::of(by_19 == (CORRECTED.start)(&given.u0)), Outcome::Holds),
            (Outcome::of(all_zero(&rest(&given, &corrected))), Outcome::Holds),
            (Outcome::of(all_zero(&rest(&natural, &harmless))), Outcome::Holds),
        ]))
}

fn backward(f: &Forms) -> Finding {
    let problem = given();
    let n = problem.nodes();
    // The last row of Table 1 is never read.
    let mut table = CORRECTED.table;
    table[2] = [0; 3];
    let from = |first| {
        let forms = Forms {
            backward: f.backward,
            first,
            table,
            ..CORRECTED
        };
        let m = problem.sweep(&forms)?;
        Some(all_zero(&problem.residuals(&m)))
    };
    // As printed, i = n asks for m_{n+1}, and for λ_{n+1} and η_{n+1}, which (19) does not make.
    let printed = from(f.first);
    let corrected = from(CORRECTED.first);
    draft("formula-20", "(20)")
        .verdict(FindingVerdict::ErrorOfPaper)
        .titled("The way back starts at i = n − 1, not at n")
        .text(
            "The formula is right, but the text lets i run from n to 0. At i = n it would need \
             m_{n+1}, λ_{n+1} and η_{n+1}: there is no such node, and (19) stops at i = n − 1. The \
             way back has to start at i = n − 1 from m_n = U_n, and then it solves the test system \
             exactly. A slip of one in the range, without consequence for anybody who notices that \
             m_n is already known.",
        )
        .figures(figures! {
            "sections of the test": "{}", n => "1";
            "first index as printed": "{}", n - f.first => "1";
            "first index for which all terms exist": "{}", n - 1 => "1";
        })
        .recorded_if(agree(&[
            (Outcome::of(printed.is_some()), Outcome::Fails),
            (Outcome::of(corrected == Some(true)), Outcome::Holds),
        ]))
}

/// The findings on the sweep.
pub(super) fn findings(f: &Forms) -> Vec<Finding> {
    vec![canonical(f), last_row(f), forward(f), start(f), backward(f)]
}

#[cfg(test)]
#[path = "sweep_tests.rs"]
mod tests;
