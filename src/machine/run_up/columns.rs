//! A run-up's rows.

use crate::solvers::run_up::Sample;

/// The columns of a row with their units.
pub const COLUMNS: [&str; 13] = [
    "t_s",
    "phi1_deg",
    "omega_rad_per_s",
    "epsilon_rad_per_s2",
    "I_kg_m2",
    "M_motor_N_m",
    "M_o_N_m",
    "M_load_N_m",
    "kinetic_energy_J",
    "work_motor_J",
    "work_weights_J",
    "work_load_J",
    "energy_balance_J",
];

/// Their values.
pub fn row(s: &Sample) -> [f64; 13] {
    [
        s.t,
        s.phi.to_degrees(),
        s.psi,
        s.acceleration,
        s.inertia,
        s.motor,
        s.weights,
        s.resistance,
        s.kinetic_energy,
        s.work[0],
        s.work[1],
        s.work[2],
        s.balance,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_has_the_values_that_its_columns_name() {
        let sample = Sample {
            t: 1.0,
            phi: std::f64::consts::PI,
            psi: 3.0,
            acceleration: 4.0,
            inertia: 5.0,
            motor: 6.0,
            weights: 7.0,
            resistance: 8.0,
            kinetic_energy: 9.0,
            work: [10.0, 11.0, 12.0],
            balance: 13.0,
        };
        let due = [
            ("t_s", 1.0),
            ("phi1_deg", 180.0),
            ("omega_rad_per_s", 3.0),
            ("epsilon_rad_per_s2", 4.0),
            ("I_kg_m2", 5.0),
            ("M_motor_N_m", 6.0),
            ("M_o_N_m", 7.0),
            ("M_load_N_m", 8.0),
            ("kinetic_energy_J", 9.0),
            ("work_motor_J", 10.0),
            ("work_weights_J", 11.0),
            ("work_load_J", 12.0),
            ("energy_balance_J", 13.0),
        ];
        let found: Vec<_> = COLUMNS.into_iter().zip(row(&sample)).collect();
        assert_eq!(found, due);
    }
}
