//! The columns of a linkage's rows, and a row in floating point.

use super::Linkage;
use crate::solvers::class_iii::State;
use crate::solvers::units::AngularVelocity;

/// The columns' names with their units, `phi1_deg` and `branch` first. The condition number is an estimate in floating point and
/// has no certified digits.
pub fn names(linkage: &Linkage, certified: bool) -> Vec<String> {
    let mut all: Vec<String> = vec!["phi1_deg".into(), "branch".into()];
    let mut links = |prefix: &str, suffix: &str| {
        all.extend((2..=5).map(|k| format!("{prefix}{k}{suffix}")));
    };
    links("phi", "_deg");
    if linkage.crank.is_some() {
        links("omega", "_rad_per_s");
        links("epsilon", "_rad_per_s2");
    } else {
        links("dphi", "_dphi1");
        links("d2phi", "_dphi1_2_per_rad");
    }
    if linkage.masses.is_some() {
        let reduced = [
            "I_n_kg_m2",
            "dI_n_dphi_kg_m2_per_rad",
            "M_o_N_m",
            "dM_o_dphi_N_m_per_rad",
        ];
        all.extend(reduced.map(String::from));
    }
    all.push("det_J_m4".into());
    if !certified {
        all.push("condition".into());
    }
    all.push("pressure_angle_deg".into());
    all
}

/// The values of a row in floating point, from the column `phi2_deg` on.
///
/// ```
/// use mechaudit::machine::{class_iii, Linkage, Source};
/// let source = Source::toml(include_str!(concat!(
///     env!("CARGO_MANIFEST_DIR"), "/examples/sand-screen.toml"
/// )));
/// let Linkage::ClassIii(linkage) = Linkage::read(&source)? else { unreachable!() };
/// let start = linkage.start_degrees().unwrap();
/// let branch = class_iii::choose(&linkage.solver, &start, None, &linkage.start)?;
/// let names = class_iii::names(&linkage, false);
/// let row = class_iii::values(&linkage, &branch.start);
/// assert_eq!(names[2], "phi2_deg");
/// assert_eq!(names.len(), 2 + row.len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn values(linkage: &Linkage, state: &State) -> Vec<f64> {
    let mut all: Vec<f64> = state
        .positions
        .wrapped()
        .to_array()
        .map(f64::to_degrees)
        .into();
    let (first, second) = match &linkage.crank {
        Some(c) => {
            let omega = AngularVelocity::from_rad_per_s(c.omega.to_f64());
            state.rates.at_crank_speed(omega, c.epsilon.to_f64())
        }
        None => (state.rates.first, state.rates.second),
    };
    all.extend(first);
    all.extend(second);
    if let Some(masses) = &linkage.masses {
        let r = masses.solver.reduce(state);
        all.extend([
            r.inertia_kg_m2,
            r.inertia_derivative_kg_m2,
            r.moment_n_m,
            r.moment_derivative_n_m,
        ]);
    }
    all.extend([
        state.determinant,
        state.condition,
        state.pressure_angle.to_degrees(),
    ]);
    all
}
