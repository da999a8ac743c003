//! The numbers in the text: geometry, the extreme position, the table's step, the claimed error.

use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::Number;

/// Lengths in centimetres, angles in degrees as printed.
const GEOMETRY: [&str; 16] = [
    "x_3 = 75",
    "y_3 = 93",
    "x_5 = 128.5",
    "y_5 = 103.5",
    "l_1 = 10",
    "l_2 = 104",
    "l_3 = 60",
    "l_4 = 64",
    "l_5 = 48.5",
    "l_B = 22",
    "deg = pi/180",
    "phi_B = -39.3*deg",
    "X_1 = (l_1 + l_2)*cos(phi_1*deg) - x_3 - l_3*cos(phi_3*deg) - l_B*cos(phi_4*deg + phi_B)",
    "Y_1 = (l_1 + l_2)*sin(phi_1*deg) - y_3 - l_3*sin(phi_3*deg) - l_B*sin(phi_4*deg + phi_B)",
    "X_2 = x_3 + l_3*cos(phi_3*deg) + l_4*cos(phi_4*deg) - x_5 - l_5*cos(phi_5*deg)",
    "Y_2 = y_3 + l_3*sin(phi_3*deg) + l_4*sin(phi_4*deg) - y_5 - l_5*sin(phi_5*deg)",
];

/// The effect of half a unit of the third decimal: each length times 0.0005 degrees.
const SLACK: [&str; 2] = [
    "slack_1 = (l_1 + l_2 + l_3 + l_B)*0.0005*deg",
    "slack_2 = (l_3 + l_4 + l_5)*0.0005*deg",
];

const ANGLES: [&str; 4] = [
    "phi_1 = 14.426",
    "phi_3 = 283.826",
    "phi_4 = 22.558",
    "phi_5 = -65.721",
];

pub(super) fn items() -> Vec<Item> {
    let angle = |id, printed: &'static str, required: &[&'static str]| {
        let others: Vec<&'static str> = ANGLES
            .into_iter()
            .filter(|a| a.split('=').next() != printed.split('=').next())
            .collect();
        Item::new(id, "extreme position", Number)
            .printed(printed)
            .claims(
                "With the other printed angles the loops close, up to the rounding of all of them.",
            )
            .with(&GEOMETRY)
            .with(&SLACK)
            .with(&others)
            .requires(required)
    };
    let first = ["X_1 ~ 0 within slack_1", "Y_1 ~ 0 within slack_1"];
    let second = ["X_2 ~ 0 within slack_2", "Y_2 ~ 0 within slack_2"];
    let both = [first, second].concat();
    let datum = |id, printed| Item::new(id, "data", Number).printed(printed).definition();
    vec![
        datum("z-s2", "s_2 = 0.53*l_2")
            .claims("Centre of mass of link 2: 55.12 cm.")
            .note("The tables belong to 50 cm, see the finding on the recovered centres of mass."),
        datum("z-s3", "s_3 = 0.3*l_3")
            .claims("Centre of mass of link 3: 18 cm.")
            .note("The tables belong to 30 cm, nearly."),
        datum("z-s4", "s_4 = 0.25*l_B")
            .claims("Centre of mass of link 4: 5.5 cm.")
            .note("The tables belong to 25 cm at -12 degrees from CD."),
        datum("z-s5", "s_5 = 0.2*l_5")
            .claims("Centre of mass of link 5: 9.7 cm.")
            .note("The tables belong to 20 cm, nearly."),
        angle("z-extreme-1", ANGLES[0], &first).note("φ_2 = φ_1: crank and link 2 in one line."),
        angle("z-extreme-3", ANGLES[1], &both),
        angle("z-extreme-4", ANGLES[2], &both),
        angle("z-extreme-5", ANGLES[3], &second),
        Item::new("z-step", "tables 2 and 3", Number)
            .printed("step = 7.5")
            .claims("48 steps make a turn: rows 0 and 48 are the same position.")
            .requires(&["48*step = 360"]),
        Item::new("z-largest-error", "after the tables, conclusion", Number)
            .printed("worst = 0.119")
            .claims("The largest entry of the error column: row 1, where the columns are 1.628 and 1.748.")
            .with(&["exact = 1.628", "spline = 1.748"])
            .requires(&["spline - exact ~ worst within 0.0015"])
            .note(
                "Within the rounding of both columns. What the column compares is another matter: \
                 see the finding on the claimed error.",
            ),
    ]
}
