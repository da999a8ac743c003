//! (18) to (20) and table 1: the tridiagonal system and its sweep.

use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::{Formula, Statement, Step, Table};

/// One step of the elimination: row i of the corrected (18), with m_{i−1} from the step before.
const ROW: &str = "row = a_i*(lambda_i*m_i + eta_i) - b_i*m_i + c_i*m_ip1 - d_i";

/// Four nodes, the corrected start, (19) and (20).
const FOUR_NODES: [&str; 12] = [
    "d_1 = 6/h^2*(y_0 - 2*y_1 + y_2)",
    "d_2 = 6/h^2*(y_1 - 2*y_2 + y_3)",
    "lambda_1 = 0",
    "eta_1 = U_0",
    "lambda_2 = 1/(-4 - lambda_1)",
    "eta_2 = (eta_1 - d_1)/(-4 - lambda_1)",
    "lambda_3 = 1/(-4 - lambda_2)",
    "eta_3 = (eta_2 - d_2)/(-4 - lambda_2)",
    "m_3 = U_n",
    "m_2 = m_3*lambda_3 + eta_3",
    "m_1 = m_2*lambda_2 + eta_2",
    "m_0 = m_1*lambda_1 + eta_1",
];

pub(super) fn items() -> Vec<Item> {
    let mut all = table();
    all.extend(elimination());
    all
}

fn table() -> Vec<Item> {
    let second = |id, place, printed, required: [&'static str; 1]| {
        Item::new(id, place, Table)
            .printed(printed)
            .claims("h²/6 times the right side of (16).")
            .requires(&required)
    };
    vec![
        Item::new("z-18", "(18)", Formula)
            .printed("a_i*m_im1 - b_i*m_im1 + c_i*m_ip1 = d_i")
            .claims("With the inner row 1, -4, 1 of table 1 it is (16).")
            .requires(&[
                "at(at(at(left, a_i, 1), b_i, -4), c_i, 1) = m_im1 + 4*m_i + m_ip1",
                "right = d_i",
            ])
            .misprint(1, &["m_im1 m_i m_ip1", "a_i b_i c_i"], "")
            .also("at(at(at(at(at(left, a_i, 1), b_i, -4), c_i, 1), m_im1, 6), m_ip1, 18) = 48")
            .also("6 + 4*12 + 18 = 6*(1 - 2*2^3 + 3^3)")
            .but_not("48 = 6*(1 - 2*2^3 + 3^3)")
            .note(
                "The sweep (19) belongs to the corrected form. For y = x³ at x = 1, 2, 3 the \
                 second derivatives are 6, 12, 18: the printed left side is 48 in place of 72.",
            ),
        Item::new("z-table-0", "table 1, row 0", Table)
            .printed("b_0 = -1")
            .claims("With a_0 = c_0 = 0 and d_0 = U_0 the row says m_0 = U_0.")
            .requires(&["-b_0*U_0 = U_0"]),
        second(
            "z-table-0-d",
            "table 1, row 0, d",
            "d_0 = U_0*h^2/6",
            ["d_0 = h^2/6*U_0"],
        ),
        Item::new("z-table-inner", "table 1, rows 1 to n-1", Table)
            .printed("b_i = -4")
            .claims("With a_i = c_i = 1 the row is (16).")
            .requires(&["m_im1 - b_i*m_i + m_ip1 = m_im1 + 4*m_i + m_ip1"]),
        second(
            "z-table-1-d",
            "table 1, row 1, d",
            "d_1 = y_2 - 2*y_1 + y_0",
            ["d_1 = h^2/6*(6/h^2*(y_0 - 2*y_1 + y_2))"],
        ),
        second(
            "z-table-2-d",
            "table 1, row 2, d",
            "d_2 = y_3 - 2*y_2 + y_1",
            ["d_2 = h^2/6*(6/h^2*(y_1 - 2*y_2 + y_3))"],
        ),
        second(
            "z-table-3-d",
            "table 1, row 3, d",
            "d_3 = y_4 - 2*y_3 + y_2",
            ["d_3 = h^2/6*(6/h^2*(y_2 - 2*y_3 + y_4))"],
        ),
        second(
            "z-table-before-last-d",
            "table 1, row n-1, d",
            "d_nm1 = y_n - 2*y_nm1 + y_nm2",
            ["d_nm1 = h^2/6*(6/h^2*(y_nm2 - 2*y_nm1 + y_n))"],
        ),
        Item::new("z-table-n", "table 1, row n", Table)
            .printed("b_n = 1")
            .claims("With a_n = c_n = 0 and d_n = U_n the row says m_n = U_n.")
            .requires(&["-b_n*U_n = U_n"])
            .misprint(1, &[], "")
            .also("at(-b_n*U_n, U_n, -5) = 5")
            .note("As printed it says m_n = -U_n; harmless where m_n = U_n is set for (20)."),
        second(
            "z-table-n-d",
            "table 1, row n, d",
            "d_n = U_n*h^2/6",
            ["d_n = h^2/6*U_n"],
        ),
    ]
}

fn elimination() -> Vec<Item> {
    vec![
        Item::new("z-19-lambda", "(19), first", Formula)
            .printed("lambda_ip1 = c_i/(b_i - a_i*lambda_i)")
            .claims(
                "From m_{i-1} = λ_i m_i + η_i and row i follows m_i = λ_{i+1} m_{i+1} + η_{i+1}.",
            )
            .with(&[ROW, "eta_ip1 = (a_i*eta_i - d_i)/(b_i - a_i*lambda_i)"])
            .requires(&["at(row, m_i, lambda_ip1*m_ip1 + eta_ip1) = 0"])
            .note("With i = 1, 2, … this is an induction; it holds for the corrected (18)."),
        Item::new("z-19-eta", "(19), second", Formula)
            .printed("eta_ip1 = (a_i*eta_i - d_i)/(b_i - a_i*lambda_i)")
            .claims("As for λ.")
            .with(&[ROW, "lambda_ip1 = c_i/(b_i - a_i*lambda_i)"])
            .requires(&["at(row, m_i, lambda_ip1*m_ip1 + eta_ip1) = 0"]),
        Item::new("z-start-lambda", "after (19)", Step)
            .printed("lambda_1 = 0")
            .claims("m_0 = λ_1 m_1 + η_1 is U_0 whatever m_1 is.")
            .with(&["eta_1 = U_0"])
            .requires(&["lambda_1*m_1 + eta_1 = U_0"]),
        Item::new("z-start-eta", "after (19)", Step)
            .printed("eta_1 = 0")
            .claims("m_0 = λ_1 m_1 + η_1 is U_0 whatever m_1 is.")
            .with(&["lambda_1 = 0"])
            .requires(&["lambda_1*m_1 + eta_1 = U_0"])
            .misprint(1, &[], "U_0 U_n")
            .also("at(lambda_1*m_1 + eta_1 - U_0, U_0, 0) = 0")
            .note(
                "An error of the paper rather than of print: it argues from a_0 = c_0 = 0 only. \
                 Right if U_0 = 0.",
            ),
        Item::new("z-20", "(20)", Formula)
            .printed("m_i = m_ip1*lambda_ip1 + eta_ip1")
            .claims("The way back: row i holds.")
            .with(&[
                "lambda_ip1 = c_i/(b_i - a_i*lambda_i)",
                "eta_ip1 = (a_i*eta_i - d_i)/(b_i - a_i*lambda_i)",
                "before = lambda_i*m_i + eta_i",
            ])
            .requires(&["a_i*before - b_i*m_i + c_i*m_ip1 = d_i"]),
        Item::new("z-20-range", "after (20)", Step)
            .printed("start = n")
            .claims("The first i of (20), m_n being set: the last i for which m_{i+1} exists.")
            .requires(&["start + 1 = n"])
            .refuted(&[], "")
            .note("i has to go from n - 1 to 0; m_{n+1} does not exist."),
        Item::new("z-sweep", "(18) to (20), together", Statement)
            .claims("Corrected, the sweep solves (16) and (17): four nodes, all values free.")
            .with(&FOUR_NODES)
            .requires(&[
                "m_0 = U_0",
                "m_0 + 4*m_1 + m_2 = d_1",
                "m_1 + 4*m_2 + m_3 = d_2",
            ]),
    ]
}
