//! The printed values.

use crate::papers::number::Number;

const VALUES: &str = include_str!("../../../reference/published/andrews.csv");

/// What is printed: seven angles, their rates and accelerations, six multipliers.
pub const QUANTITIES: [&str; 27] = [
    "beta",
    "Theta",
    "gamma",
    "Phi",
    "delta",
    "Omega",
    "epsilon",
    "beta_dot",
    "Theta_dot",
    "gamma_dot",
    "Phi_dot",
    "delta_dot",
    "Omega_dot",
    "epsilon_dot",
    "beta_ddot",
    "Theta_ddot",
    "gamma_ddot",
    "Phi_ddot",
    "delta_ddot",
    "Omega_ddot",
    "epsilon_ddot",
    "lambda_1",
    "lambda_2",
    "lambda_3",
    "lambda_4",
    "lambda_5",
    "lambda_6",
];

/// The unit of a quantity by its index.
pub fn unit(quantity: usize) -> &'static str {
    ["rad", "rad/s", "rad/s^2", "N"][kind(quantity)]
}

/// Angle, rate, acceleration, multiplier: 0 to 3.
pub(super) fn kind(quantity: usize) -> usize {
    quantity / 7
}

/// A printed value.
#[derive(Clone, Debug)]
pub struct Printed {
    /// The time in seconds, as printed.
    pub time: String,
    /// Index in [`QUANTITIES`].
    pub quantity: usize,
    /// What stands there.
    pub number: Number,
}

/// All printed values in the order of the file.
pub fn printed() -> Vec<Printed> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(VALUES.as_bytes());
    let row = |r: csv::StringRecord| {
        let name = QUANTITIES.iter().position(|q| *q == &r[1]);
        Printed {
            time: r[0].into(),
            quantity: name.expect("a quantity of the mechanism"),
            number: Number::read(&r[2]),
        }
    };
    let rows = reader.records().map(|r| row(r.expect("a row of values")));
    rows.collect()
}
