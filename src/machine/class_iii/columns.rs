//! The columns of a linkage's rows, and a row in floating point.

use super::Linkage;
use crate::solvers::class_iii::State;
use crate::solvers::units::AngularVelocity;

/// The columns' names with their units, `phi1_deg` and `branch` first. The condition number is an
/// estimate in floating point and has no certified digits.
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
/// use mechaudit_cli::machine::{class_iii, Linkage, Source};
/// let source = Source::toml(include_str!(concat!(
///     env!("CARGO_MANIFEST_DIR"), "/../../examples/sand-screen.toml"
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::class_iii::{Certifier, choose};
    use crate::machine::{self, Source};

    /// The sand screen without its bodies and with another motion of the crank.
    fn read(bodies: bool, crank: &str) -> Linkage {
        let text = include_str!("../../../examples/sand-screen.toml");
        let lines = text.lines().filter(|l| !l.starts_with("crank_"));
        let text: String = lines.map(|l| format!("{l}\n")).collect();
        let text = match bodies {
            true => text,
            false => text.split_once("[bodies.").unwrap().0.to_string(),
        };
        let source = Source::toml(format!("{crank}\n{text}"));
        match machine::Linkage::read(&source).unwrap() {
            machine::Linkage::ClassIii(linkage) => *linkage,
            _ => unreachable!("of class III"),
        }
    }

    const CRANK: &str = "crank_speed = \"3 rad/s\"\ncrank_acceleration = \"-5 rad/s^2\"";

    #[test]
    fn columns_have_names_with_units() {
        let links = |pattern: &str| [2, 3, 4, 5].map(|k| pattern.replace('*', &k.to_string()));
        let reduced = [
            "I_n_kg_m2",
            "dI_n_dphi_kg_m2_per_rad",
            "M_o_N_m",
            "dM_o_dphi_N_m_per_rad",
        ];
        for (bodies, crank) in [(false, ""), (false, CRANK), (true, ""), (true, CRANK)] {
            let linkage = read(bodies, crank);
            let mut due = vec!["phi1_deg".to_string(), "branch".to_string()];
            due.extend(links("phi*_deg"));
            due.extend(links(if crank.is_empty() {
                "dphi*_dphi1"
            } else {
                "omega*_rad_per_s"
            }));
            due.extend(links(match crank.is_empty() {
                true => "d2phi*_dphi1_2_per_rad",
                false => "epsilon*_rad_per_s2",
            }));
            due.extend(reduced.iter().filter(|_| bodies).map(|n| n.to_string()));
            due.extend(["det_J_m4", "condition", "pressure_angle_deg"].map(String::from));
            assert_eq!(names(&linkage, false), due);
            due.retain(|n| n != "condition");
            assert_eq!(names(&linkage, true), due);
        }
    }

    /// Certified digits and floating point say the same in every column, with rates at the crank's
    /// speed.
    #[test]
    fn rows_are_certified_column_by_column() {
        let at = rug::Rational::from(50);
        let mut still: Option<Vec<f64>> = None;
        for (bodies, crank) in [(true, ""), (true, CRANK), (false, CRANK)] {
            let linkage = read(bodies, crank);
            let start = choose(&linkage.solver, &at, Some(2), &linkage.start)
                .unwrap()
                .start;
            let row = values(&linkage, &start);
            let all = names(&linkage, false);
            assert_eq!(all.len(), row.len() + 2);
            let mut certifier = Certifier::new(&linkage, 15);
            let position = certifier.advance(&at, &start).unwrap();
            let digits = certifier.values(&at, &position);
            let due = names(&linkage, true);
            assert_eq!(due.len(), digits.len() + 2);
            for (name, text) in due[2..].iter().zip(&digits) {
                let k = all.iter().position(|n| n == name).unwrap() - 2;
                let x: f64 = text.as_deref().expect(name).parse().unwrap();
                let apart = (x - row[k]).abs();
                assert!(apart < 1e-9 * (1.0 + x.abs()), "{name}: {x} {}", row[k]);
            }
            match &still {
                None => still = Some(row),
                Some(still) => {
                    for k in 4..8 {
                        let (first, second) = (still[k], still[k + 4]);
                        assert!((row[k] - 3.0 * first).abs() < 1e-12);
                        assert!((row[k + 4] - 9.0 * second + 5.0 * first).abs() < 1e-12);
                    }
                }
            }
        }
    }
}
