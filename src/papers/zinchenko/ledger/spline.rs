//! (8) to (17): the cubic spline.

use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::{Formula, Statement, Step};

const CURVATURE: &str = "S'' = m_i + k*(m_ip1 - m_i)";
const SLOPE_9: &str = "S_9 = (m_ip1 - m_i)*(k^2*h/2) + m_i*k*h + C_1";
const SPLINE_10: &str = "S_10 = (m_ip1 - m_i)*(k^3*h^2/6) + m_i*(k^2*h^2/2) + C_1*k*h + C_2";
const CONSTANT_1: &str = "C_1 = (y_ip1 - y_i)/h - (m_ip1 - m_i)*(h/6) - m_i*(h/2)";
const CONSTANT_2: &str = "C_2 = y_i";
const SLOPE_11: &str = "S_11 = (y_ip1 - y_i)/h - h/6*((2 - 6*k + 3*k^2)*m_i + (1 - 3*k^2)*m_ip1)";
/// The argument moves by h while k goes from 0 to 1.
const STEP: &str = "x: k = 1/h";

const CONTINUITY: [&str; 2] = [
    "arriving = (y_i - y_im1)/h - h/6*(-m_im1 - 2*m_i)",
    "leaving = (y_ip1 - y_i)/h - h/6*(m_ip1 + 2*m_i)",
];

/// Factors of m_1 in m_0 to m_12 where the right side of (16) is zero.
const FACTORS: [&str; 13] = [
    "g_0 = 0",
    "g_1 = 1",
    "g_2 = -4*g_1 - g_0",
    "g_3 = -4*g_2 - g_1",
    "g_4 = -4*g_3 - g_2",
    "g_5 = -4*g_4 - g_3",
    "g_6 = -4*g_5 - g_4",
    "g_7 = -4*g_6 - g_5",
    "g_8 = -4*g_7 - g_6",
    "g_9 = -4*g_8 - g_7",
    "g_10 = -4*g_9 - g_8",
    "g_11 = -4*g_10 - g_9",
    "g_12 = -4*g_11 - g_10",
];

pub(super) fn items() -> Vec<Item> {
    let mut all = pieces();
    all.extend(joints());
    all
}

fn pieces() -> Vec<Item> {
    vec![
        Item::new("z-8", "(8)", Formula)
            .printed(CURVATURE)
            .claims("Linear between the second derivatives at the nodes.")
            .requires(&[
                "at(S'', k, 0) = m_i",
                "at(S'', k, 1) = m_ip1",
                "D(D(S'', k), k) = 0",
            ]),
        Item::new("z-8-argument", "after (8)", Step)
            .printed("k = (x - x_i)/h")
            .claims("0 and 1 at the nodes; dk/dx = 1/h.")
            .requires(&[
                "at(k, x, x_i) = 0",
                "at(k, x, x_i + h) = 1",
                "D(k, x) = 1/h",
            ]),
        Item::new("z-9", "(9)", Formula)
            .printed("S' = (m_ip1 - m_i)*(k^2*h/2) + m_i*k*h + C_1")
            .claims("An antiderivative of (8) by x.")
            .with(&[CURVATURE, STEP])
            .requires(&["D(S', x) = S''", "at(S', k, 0) = C_1"]),
        Item::new("z-10", "(10)", Formula)
            .printed("S = (m_ip1 - m_i)*(k^3*h^2/6) + m_i*(k^2*h^2/2) + C_1*k*h + C_2")
            .claims("An antiderivative of (9) by x.")
            .with(&[SLOPE_9, STEP])
            .requires(&["D(S, x) = S_9", "at(S, k, 0) = C_2"]),
        Item::new("z-c1", "after (10)", Step)
            .printed(CONSTANT_1)
            .claims("The spline passes through y_{i+1} at k = 1.")
            .with(&[SPLINE_10, CONSTANT_2])
            .requires(&["at(S_10, k, 1) = y_ip1"]),
        Item::new("z-c2", "after (10)", Step)
            .printed(CONSTANT_2)
            .claims("The spline passes through y_i at k = 0.")
            .with(&[SPLINE_10, CONSTANT_1])
            .requires(&["at(S_10, k, 0) = y_i"]),
        Item::new("z-11", "(11)", Formula)
            .printed("S' = (y_ip1 - y_i)/h - h/6*((2 - 6*k + 3*k^2)*m_i + (1 - 3*k^2)*m_ip1)")
            .claims("(9) with C_1.")
            .with(&[SLOPE_9, CONSTANT_1])
            .requires(&["S' = S_9"]),
        Item::new("z-12-before", "before (12)", Step)
            .printed(
                "S = (m_ip1 - m_i)*(k^3*h^2/6) + m_i*k^2*(3*h^2/6) \
                 + k*h*((y_ip1 - y_i)/h - (m_ip1 - m_i)*(h/6) - m_i*(h/2)) + y_i",
            )
            .claims("(10) with C_1 and C_2.")
            .with(&[SPLINE_10, CONSTANT_1, CONSTANT_2])
            .requires(&["S = S_10"]),
        Item::new("z-12", "(12)", Formula)
            .printed(
                "S = y_ip1*k + y_i*(1 - k) \
                 + k*h^2/6*(k*((m_ip1 - m_i)*k + 3*m_i) - (m_ip1 + 2*m_i))",
            )
            .claims("(10) with C_1 and C_2, collected.")
            .with(&[SPLINE_10, CONSTANT_1, CONSTANT_2])
            .requires(&["S = S_10"]),
    ]
}

fn joints() -> Vec<Item> {
    vec![
        Item::new("z-13", "(13)", Formula)
            .printed("S'_i = (y_i - y_im1)/h - h/6*(-m_im1 - 2*m_i)")
            .claims("(11) of the piece before at k = 1.")
            .with(&[
                SLOPE_11,
                "before = at(at(at(at(S_11, y_i, y_im1), y_ip1, y_i), m_i, m_im1), m_ip1, m_i)",
            ])
            .requires(&["S'_i = at(before, k, 1)"]),
        Item::new("z-14", "(14)", Formula)
            .printed("S'_ip1 = (y_ip1 - y_i)/h - h/6*(m_ip1 + 2*m_i)")
            .claims("(11) at k = 0.")
            .with(&[SLOPE_11])
            .requires(&["S'_ip1 = at(S_11, k, 0)"]),
        Item::new("z-15", "(15)", Formula)
            .printed(
                "(y_i - y_im1)/h - h/6*(-m_im1 - 2*m_i) \
                 = (y_ip1 - y_i)/h - h/6*(2*m_i + m_ip1)",
            )
            .claims("(13) equals (14).")
            .with(&CONTINUITY)
            .requires(&["left = arriving", "right = leaving"]),
        Item::new("z-16", "(16)", Formula)
            .printed("m_im1 + 4*m_i + m_ip1 = 6/h^2*(y_im1 - 2*y_i + y_ip1)")
            .claims("(15) times 6/h, arranged.")
            .with(&CONTINUITY)
            .requires(&["h/6*(left - right) = arriving - leaving"]),
        Item::new("z-16-count", "after (16)", Statement)
            .printed("n + 1 = (n - 1) + 2")
            .claims("n + 1 unknowns, n - 1 equations (16), two end conditions.")
            .requires(&["left = right"]),
        Item::new("z-17", "(17)", Formula)
            .printed("m_0 = U_0")
            .claims("The second derivatives at the ends are given; for functions without period.")
            .definition()
            .note(
                "The tables of the paper cannot come from (17): they agree with the periodic \
                 spline only, see the finding on the recipe behind the columns.",
            ),
        Item::new("z-17-closes", "(17)", Statement)
            .claims("m_0 and m_n fix the others: m_n depends on m_1 by a factor that is not zero.")
            .with(&FACTORS)
            .requires(&["-4*s*G_i - (-s)*G_im1 = -s*(3*G_i + (G_i - G_im1))"])
            .also("g_12 = -2107560")
            .note(
                "By (16) with d = 0 the factors are g_0 = 0, g_1 = 1, g_{i+1} = -4 g_i - g_{i-1}. \
                 If g_i has the sign s and the size G_i, and g_{i-1} the sign -s and a smaller size, \
                 then g_{i+1} has the sign -s and a larger size: by induction none is zero.",
            ),
        Item::new("z-d", "before (18)", Step)
            .printed("d_i = 6/h^2*(y_im1 - 2*y_i + y_ip1)")
            .claims("The right side of (16).")
            .with(&CONTINUITY)
            .requires(&["h/6*(m_im1 + 4*m_i + m_ip1 - d_i) = arriving - leaving"])
            .but_not("d_i = 6/2*(y_im1 - 2*y_i + y_ip1)")
            .also("at(d_i, h, sqrt(2)) = 6/2*(y_im1 - 2*y_i + y_ip1)")
            .note("The text layer has the line twice, once as noise: m_1 = 6/2(m_2 = 2m + m_2)."),
    ]
}
