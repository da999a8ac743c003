//! The printed values.

use crate::papers::number::{Number, records};

const VALUES: &str = include_str!("../../../reference/published/andrews.csv");

/// The printed quantities: seven angles, their rates and accelerations, six multipliers.
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
    /// The printed number.
    pub number: Number,
}

/// All printed values in the order of the file.
pub fn printed() -> Vec<Printed> {
    let row = |r: &csv::StringRecord| {
        let name = QUANTITIES.iter().position(|q| *q == &r[1]);
        Printed {
            time: r[0].into(),
            quantity: name.expect("a quantity of the mechanism"),
            number: Number::read(&r[2]),
        }
    };
    records(VALUES).iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_come_in_four_kinds() {
        assert_eq!(
            [0, 6, 7, 13, 14, 20, 21, 26].map(kind),
            [0, 0, 1, 1, 2, 2, 3, 3]
        );
        assert_eq!([0, 7, 14, 21].map(unit), ["rad", "rad/s", "rad/s^2", "N"]);
        let all = printed();
        let first = &all[0];
        assert_eq!((first.time.as_str(), first.quantity), ("0", 0));
        assert_eq!(first.number.text, "-0.0617138900142764496358948458001");
        assert!(all.iter().any(|p| p.time == "0.03" && p.quantity == 26));
    }
}
