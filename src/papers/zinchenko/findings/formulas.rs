//! Findings on the formulas: groups of ledger entries in words. Every verdict is the ledger's.

use crate::papers::ledger::{Ledger, LedgerEntry, Verdict};
use crate::papers::{Draft, Figure, Finding, FindingVerdict, Subject};
use FindingVerdict::{Confirmed, ErrorOfPaper, PrintOrScan};
use Verdict::{Definition, Misprint, Model, Proved, Refuted, Undefined};

/// A finding and the ledger entries that it rests on, each with the verdict on record.
struct Group {
    id: &'static str,
    place: &'static str,
    verdict: FindingVerdict,
    title: &'static str,
    text: &'static str,
    entries: &'static [(&'static str, Verdict)],
}

const MOTION: &[Group] = &[
    Group {
        id: "formula-1",
        place: "(1)",
        verdict: Confirmed,
        title: "The equation of motion is right when M_o carries its sign",
        text: "Formula (1) is the power balance d(½ I_n ψ²)/dt = (M_d + M_o) ψ solved for dψ/dt. \
               It asks for M_o as a moment with a sign, which is what formula (7) delivers: \
               negative while the sieve is being lifted. Entering a resisting moment as a positive \
               number breaks the balance by 2 M_o ψ.",
        entries: &[
            ("z-1", Proved),
            ("z-1-angle", Definition),
            ("z-1-legend", Undefined),
        ],
    },
    Group {
        id: "formula-2",
        place: "(2), slip and critical slip",
        verdict: Confirmed,
        title: "Kloss's formula and the critical slip are right",
        text: "With S_k = S_n (k + √(k² − 1)) the formula returns exactly the rated torque M_k/k at \
               the rated slip. Of the two roots the paper takes the right one: the other is its \
               reciprocal and would put the rated point on the unstable side of the maximum. M_k is \
               the largest torque, reached at S_k, and the slip runs from 1 at standstill to 0 at \
               synchronous speed. For k = 2.2 the ratio S_k/S_n is 4.159591794227. The legend of \
               the scan has a Greek index for the rated values and M_φ twice; that looks like noise \
               of its text layer.",
        entries: &[
            ("z-2", Proved),
            ("z-2-slip", Proved),
            ("z-2-critical-slip", Proved),
            ("z-2-overload", Definition),
        ],
    },
    Group {
        id: "formula-3",
        place: "(3)",
        verdict: Confirmed,
        title: "The kinetic energy is right if I_3 and I_5 are about the fixed pivots",
        text: "Links 3 and 5 appear in (3) with I ω² alone, so their moments of inertia have to be \
               taken about O_3 and O_5; I_2 and I_4 are about the centres of mass. Read so, (3) is \
               König's sum over centres of mass after Steiner's theorem. Read as moments about the \
               centres of mass they would leave out m s² ω² of both rockers. The paper does not say \
               which is meant. The reduced mass m_n = I_n/l_1² that follows is right, too.",
        entries: &[("z-3", Proved), ("z-reduced-mass", Proved)],
    },
    Group {
        id: "formula-4",
        place: "(4)",
        verdict: ErrorOfPaper,
        title: "(4) drops I_1, and its speeds have to be in metres per second",
        text: "Formula (4) is the braces of (3) without I_1. The data have I_1 = 0, so the tables do \
               not suffer, but a real crank with its motor would be forgotten. The lengths are given \
               without a unit and are centimetres, while the inertias are in kg·m²: put in as they \
               stand the speeds have to be multiplied by 0.01. The paper does not say so; its tables \
               have it.",
        entries: &[("z-4", Proved), ("z-4-units", Undefined)],
    },
    Group {
        id: "formula-5",
        place: "(5)",
        verdict: ErrorOfPaper,
        title: "The derivative of I_n lacks the factor 1/ω_1²",
        text: "All terms of the derivative of (4) are there, but the factor 1/ω_1² in front of (4) is \
               lost. At ω_1 = 1, the paper's value, (5) is the derivative; at ω_1 = 2 it gives four \
               times too much. The scan prints part of the formula twice, the first time as noise.",
        entries: &[("z-5", Misprint), ("z-5-motion", Proved)],
    },
    Group {
        id: "formula-6",
        place: "(6)",
        verdict: Confirmed,
        title: "The reduction of forces by equal power is right",
        text: "The power of the reduced moment is that of all forces and moments, whatever their \
               number and for both senses of rotation.",
        entries: &[("z-6", Proved)],
    },
    Group {
        id: "formula-7",
        place: "(7)",
        verdict: ErrorOfPaper,
        title: "M_o lacks the factor 1/ω_1 that (6) has, and the factor 0.01 for centimetres",
        text: "Signs and angles of (7) are right with y upwards: a rising centre of mass gives a \
               negative share, −m g V sin θ. Compared with (6) the division by ω_1 is missing, which \
               does not matter at the paper's ω_1 = 1, and speeds in cm/s make the moment a hundred \
               times too large.",
        entries: &[("z-7", Misprint), ("z-4-units", Undefined)],
    },
];

const SPLINE: &[Group] = &[
    Group {
        id: "formula-8-12",
        place: "(8)-(12), C1, C2",
        verdict: Confirmed,
        title: "The spline on one section is right, including (12)",
        text: "Integrating (8) twice gives (9) and (10); the printed C1 and C2 make the section pass \
               through its two nodes; (11), the unnumbered line after it, and (12) are the same \
               polynomials collected differently.",
        entries: &[
            ("z-8", Proved),
            ("z-8-argument", Proved),
            ("z-9", Proved),
            ("z-10", Proved),
            ("z-c1", Proved),
            ("z-c2", Proved),
            ("z-11", Proved),
            ("z-12-before", Proved),
            ("z-12", Proved),
        ],
    },
    Group {
        id: "formula-13-16",
        place: "(13)-(16)",
        verdict: Confirmed,
        title: "The continuity of the slope leads to (16) as printed",
        text: "(13) and (14) are formula (11) at the end of one section and at the start of the next, \
               (15) equates them, and (16) is (15) multiplied by 6/h. All signs are right, also the \
               two minus signs in the bracket of (13).",
        entries: &[
            ("z-13", Proved),
            ("z-14", Proved),
            ("z-15", Proved),
            ("z-16", Proved),
            ("z-16-count", Proved),
        ],
    },
    Group {
        id: "formula-17",
        place: "(17)",
        verdict: Confirmed,
        title: "Prescribed end values close the system, for functions that are not periodic",
        text: "The n − 1 equations (16) leave exactly two values free, and prescribing m_0 and m_n \
               fixes them: with m_0 given, m_n depends on m_1 through a factor that is not zero for \
               any n, by induction. The paper itself reserves (17) for functions that are not \
               periodic. I_n, dI_n/dφ and M_o are periodic in the crank angle, so its own tables \
               call for the other kind of end conditions; see the finding on the tables.",
        entries: &[("z-17", Definition), ("z-17-closes", Proved)],
    },
    Group {
        id: "inline-d",
        place: "text after (17), table 1",
        verdict: Confirmed,
        title: "The right-hand sides d_i are right; a garbled copy stands before them in the scan",
        text: "The d_i of the text and the column d_i h²/6 of Table 1 are both the right-hand side of \
               (16). The text layer of the scan has a broken copy of the same line in front of it \
               that reads m_1 = 6/2 (m_2 = 2m + m_2). It is no formula, and a factor 6/2 in place of \
               6/h² would be wrong for every step but √2.",
        entries: &[
            ("z-d", Proved),
            ("z-table-0-d", Proved),
            ("z-table-1-d", Proved),
            ("z-table-2-d", Proved),
            ("z-table-3-d", Proved),
            ("z-table-before-last-d", Proved),
            ("z-table-n-d", Proved),
        ],
    },
];

const SWEEP: &[Group] = &[
    Group {
        id: "formula-18",
        place: "(18)",
        verdict: PrintOrScan,
        title: "The index of the middle term of (18) is wrong",
        text: "Printed is a_i m_{i-1} − b_i m_{i-1} + c_i m_{i+1} = d_i, with m_{i-1} twice; the \
               middle term has to be b_i m_i, and then the coefficients of Table 1 give (16) exactly. \
               For y = x³ at x = 1, 2, 3 the printed left side is 48 where (16) asks for 72. The \
               sweep (19) belongs to the correct form, so nothing computed with it is affected. The \
               scan alone does not tell whether the paper or its text layer has the wrong index.",
        entries: &[("z-18", Misprint), ("z-table-inner", Proved)],
    },
    Group {
        id: "table-1-last-row",
        place: "Table 1, last row",
        verdict: PrintOrScan,
        title: "b_n has to be −1, as b_0 is",
        text: "Table 1 prints b_0 = −1 and b_n = 1. With the signs of (18) the last row then says \
               m_n = −U_n: for U_n = −5 it gives 5. It does no harm if the way back is started with \
               m_n = U_n, as the text says, because the row is then never read; nor if U_n = 0.",
        entries: &[("z-table-n", Misprint), ("z-table-0", Proved)],
    },
    Group {
        id: "formula-19",
        place: "(19)",
        verdict: Confirmed,
        title: "The forward sweep is right for the corrected (18)",
        text: "Put into (18) with the middle index corrected, m_i = λ_{i+1} m_{i+1} + η_{i+1} with the \
               printed λ and η satisfies the equation identically. With four nodes, and every \
               ordinate and end value free, the whole sweep solves each equation, inner or at the \
               ends.",
        entries: &[
            ("z-19-lambda", Proved),
            ("z-19-eta", Proved),
            ("z-sweep", Proved),
        ],
    },
    Group {
        id: "lambda-1-eta-1",
        place: "text after (19)",
        verdict: ErrorOfPaper,
        title: "λ_1 = 0 is right, η_1 has to be U_0",
        text: "The paper takes λ_1 = η_1 = 0 because a_0 and c_0 are zero. Formula (19) at i = 0 gives \
               λ_1 = 0 but η_1 = −d_0/b_0 = U_0. With η_1 = 0 the given end value is ignored: the \
               sweep returns m_0 = 0 whatever U_0 is, and since all other equations are satisfied \
               nothing looks wrong. Right only for U_0 = 0, the case the paper calls the most \
               frequent.",
        entries: &[("z-start-lambda", Proved), ("z-start-eta", Misprint)],
    },
    Group {
        id: "formula-20",
        place: "(20)",
        verdict: ErrorOfPaper,
        title: "The way back starts at i = n − 1, not at n",
        text: "The formula is right, but the text lets i run from n to 0. At i = n it would need \
               m_{n+1}, λ_{n+1} and η_{n+1}: there is no such node, and (19) stops at i = n − 1. The \
               way back has to start at i = n − 1 from m_n = U_n. A slip of one in the range, \
               without consequence for anybody who notices that m_n is already known.",
        entries: &[("z-20", Proved), ("z-20-range", Refuted)],
    },
];

const RATES: &[Group] = &[
    Group {
        id: "velocity-system",
        place: "velocity system",
        verdict: Confirmed,
        title: "All four velocity equations are right",
        text: "The printed system is the time derivative of the two loop equations.",
        entries: &[
            ("z-velocity-1", Proved),
            ("z-velocity-2", Proved),
            ("z-velocity-3", Proved),
            ("z-velocity-4", Proved),
        ],
    },
    Group {
        id: "acceleration-system",
        place: "acceleration system",
        verdict: Confirmed,
        title: "All four acceleration equations are right, for a crank at constant speed",
        text: "The printed system is the second time derivative of the two loop equations, the third \
               and fourth with the opposite sign. There is no term with the crank's own \
               acceleration: ε_1 would add its coefficient in the velocity system to the first two \
               equations. The system is enough for dI_n/dφ, which depends on the position only. The \
               unknowns have the same coefficients as in the velocity system, so the accelerations \
               cost one more right-hand side on a matrix that is already factored.",
        entries: &[
            ("z-acceleration-1", Proved),
            ("z-acceleration-2", Proved),
            ("z-acceleration-3", Proved),
            ("z-acceleration-4", Proved),
            ("z-acceleration-crank", Model),
        ],
    },
];

fn figure(entry: &LedgerEntry) -> Figure {
    let statements = entry.obligations.len();
    Figure {
        name: format!("{} of the ledger", entry.id),
        value: match (&entry.corrected, statements) {
            (Some(corrected), _) => format!("misprint, has to be {}", corrected.text),
            (None, 0) => entry.verdict.words().into(),
            (None, 1) => format!("{}, one statement decided", entry.verdict.words()),
            (None, n) => format!("{}, {n} statements decided", entry.verdict.words()),
        },
        unit: "1",
        latex: None,
    }
}

/// A finding is as recorded if all of its entries are, and have the verdicts that it rests on.
fn finding(group: &Group, ledger: &Ledger) -> Finding {
    let found = |id: &str| ledger.entries.iter().find(|e| e.id == id);
    let holds = |(id, verdict): &(&str, Verdict)| {
        found(id).is_some_and(|e| e.as_recorded && e.verdict == *verdict)
    };
    Draft::new(group.id, Subject::Formula, group.place)
        .verdict(group.verdict)
        .titled(group.title)
        .text(group.text)
        .figures(
            group
                .entries
                .iter()
                .filter_map(|(id, _)| found(id))
                .map(figure),
        )
        .recorded_if(group.entries.iter().all(holds))
}

/// Everything found about the formulas, in the order of the paper.
pub(in crate::papers::zinchenko) fn formulas(ledger: &Ledger, extreme: Finding) -> Vec<Finding> {
    let of =
        |groups: &[Group]| -> Vec<Finding> { groups.iter().map(|g| finding(g, ledger)).collect() };
    let before = [MOTION, SPLINE, SWEEP].map(of).concat();
    [before, vec![extreme], of(RATES)].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::zinchenko::{citation, items};

    /// Each of the entries is needed, with its verdict and its record.
    #[test]
    fn a_finding_rests_on_each_of_its_entries() {
        let ledger = Ledger::of(citation(), &items());
        for group in [MOTION, SPLINE, SWEEP, RATES].into_iter().flatten() {
            let whole = finding(group, &ledger);
            assert!(whole.as_recorded, "{}: {:?}", group.id, whole.figures);
            assert_eq!(whole.figures.len(), group.entries.len());
            for (id, verdict) in group.entries {
                let at = ledger.entries.iter().position(|e| e.id == *id).unwrap();
                let recorded = |plant: fn(&mut LedgerEntry)| {
                    let mut faulty = ledger.clone();
                    plant(&mut faulty.entries[at]);
                    finding(group, &faulty).as_recorded
                };
                assert!(recorded(|_| ()));
                assert!(!recorded(|e| e.as_recorded = false), "{id}");
                assert!(!recorded(|e| e.verdict = Verdict::Undecided), "{id}");
                assert!(!recorded(|e| e.id = "another"), "{id} {verdict:?}");
            }
        }
    }
}
