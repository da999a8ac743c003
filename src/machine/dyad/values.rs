//! The columns of a dyad's rows, a row in floating point, and the numbers of the branches.

use super::{Dyad, Reached, Shape};
use crate::reference::nearest_f64;
use crate::solvers::dyad::{Assembly, DyadError};
use crate::solvers::units::Angle;
use rug::Rational;

/// Two coordinates, their first and second derivatives by the crank angle, the transmission angle
/// and the determinant. The coordinates are φ2 and φ3 of the four-bar, or the slider's coordinate
/// and φ2.
pub type Values<T> = [T; 8];

/// Both assemblies, in the order of their branch numbers.
pub const ASSEMBLIES: [Assembly; 2] = [Assembly::Positive, Assembly::Negative];

/// The number of an assembly in the column `branch`.
pub fn number(assembly: Assembly) -> usize {
    usize::from(assembly == Assembly::Negative)
}

/// The values with velocities and accelerations in the place of the derivatives.
pub(super) fn at_crank_speed<T>(v: Values<T>, rates: impl Fn(&T, &T) -> (T, T)) -> Values<T> {
    let (w1, e1) = rates(&v[2], &v[4]);
    let (w2, e2) = rates(&v[3], &v[5]);
    let [p, q, _, _, _, _, transmission, determinant] = v;
    [p, q, w1, w2, e1, e2, transmission, determinant]
}

/// Why a row has no values in floating point.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RowError {
    /// The solver refuses the position.
    #[error("at phi1 = {degrees} deg: {source}")]
    Position {
        /// The crank angle in degrees.
        degrees: f64,
        /// Its refusal.
        source: DyadError,
    },
    /// A value is too large.
    #[error("{column} exceeds the range of floating-point numbers at phi1 = {degrees} deg")]
    Range {
        /// The column's name.
        column: String,
        /// The crank angle in degrees.
        degrees: f64,
    },
}

/// A row in floating point, angles in degrees; `None` where the crank does not reach the angle.
/// Where the assemblies are one, the derivatives are NaN: they have no value.
///
/// # Errors
/// [`RowError`].
pub fn floating(
    dyad: &Dyad,
    degrees: &Rational,
    assembly: Assembly,
) -> Result<Option<Values<f64>>, RowError> {
    let at = nearest_f64(degrees);
    let found = match dyad.shape.reached(degrees) {
        Some(Reached::Beyond) => return Ok(None),
        Some(Reached::Singular) => return Ok(singular(dyad, degrees)),
        None => position(&dyad.shape, Angle::from_rad(at.to_radians()), assembly),
    };
    let mut values = match found {
        Ok(values) => values,
        Err(DyadError::Unreachable { .. }) => return Ok(None),
        Err(DyadError::Singular { .. }) => return Ok(singular(dyad, degrees)),
        Err(source) => {
            return Err(RowError::Position {
                degrees: at,
                source,
            });
        }
    };
    values = at_given_speed(dyad, values);
    in_degrees(dyad, &mut values);
    match values.iter().position(|x| !x.is_finite()) {
        None => Ok(Some(values)),
        Some(i) => Err(RowError::Range {
            column: names(dyad).swap_remove(i + 2),
            degrees: at,
        }),
    }
}

/// A row with the crank angle in degrees and the number of the branch before its values.
pub type Row = [f64; 10];

/// Rows at many finite crank angles in degrees, those of [`floating`] bit for bit; NaN where the
/// crank does not reach.
///
/// # Errors
/// [`RowError`].
pub fn table(
    dyad: &Dyad,
    degrees: &[f64],
    assembly: Assembly,
    rows: &mut [Row],
) -> Result<(), RowError> {
    const CHUNK: usize = 256;
    let branch = number(assembly) as f64;
    let from = dyad.shape.rational_from();
    let (mut phi, mut columns) = ([0.0; CHUNK], [[0.0; CHUNK]; 8]);
    for (degrees, rows) in degrees.chunks(CHUNK).zip(rows.chunks_mut(CHUNK)) {
        let n = degrees.len();
        for (phi, at) in phi.iter_mut().zip(degrees) {
            *phi = at.to_radians();
        }
        let room = columns.each_mut().map(|column| &mut column[..n]);
        let found = match &dyad.shape {
            Shape::FourBar { solver, .. } => solver.rows(&phi[..n], assembly, room),
            Shape::SliderCrank { solver, .. } => solver.rows(&phi[..n], assembly, room),
        };
        found.expect("a place for each angle");
        // Column by column, so that it is done in vectors: zero times what is finite is zero.
        for &column in dyad.shape.angles() {
            for value in &mut columns[column][..n] {
                *value = value.to_degrees();
            }
        }
        let mut zeros = [0.0; CHUNK];
        for column in &columns {
            for (zero, value) in zeros.iter_mut().zip(column) {
                *zero += 0.0 * value;
            }
        }
        for (i, (at, row)) in degrees.iter().zip(rows).enumerate() {
            let mut values = columns.each_ref().map(|column| column[i]);
            let mut careful =
                zeros[i] != 0.0 || from.is_some_and(|from| is_multiple_of_30(*at - from));
            if dyad.crank.is_some() {
                values = at_given_speed(dyad, values);
                careful |= values.iter().any(|x| !x.is_finite());
            }
            if careful {
                let exact = Rational::from_f64(*at);
                let found = exact.map(|at| floating(dyad, &at, assembly)).transpose()?;
                values = found.flatten().unwrap_or([f64::NAN; 8]);
            }
            (row[0], row[1]) = (*at, branch);
            row[2..].copy_from_slice(&values);
        }
    }
    Ok(())
}

/// A number below 2⁵¹ that is added to this is rounded to a whole one.
const ROUND: f64 = 1.5 / f64::EPSILON;

/// Returns false for an angle in degrees that is no multiple of 30, nor rounded from one.
fn is_multiple_of_30(degrees: f64) -> bool {
    let twelfths = degrees / 30.0;
    let off = twelfths - ((twelfths + ROUND) - ROUND);
    // A large angle is rounded before its direction is seen.
    off.abs() <= 1e-9 + 1e-15 * twelfths.abs()
}

/// The values at the crank's speed, where the file gives it.
fn at_given_speed(dyad: &Dyad, values: Values<f64>) -> Values<f64> {
    let Some(crank) = &dyad.crank else {
        return values;
    };
    let (w, e) = (crank.omega.to_f64(), crank.epsilon.to_f64());
    at_crank_speed(values, |f, s| (f * w, s * w * w + f * e))
}

fn in_degrees(dyad: &Dyad, values: &mut Values<f64>) {
    for &i in dyad.shape.angles() {
        values[i] = values[i].to_degrees();
    }
}

fn singular(dyad: &Dyad, degrees: &Rational) -> Option<Values<f64>> {
    let mut values = super::singular::floating(&dyad.shape, degrees)?;
    in_degrees(dyad, &mut values);
    Some(values)
}

fn position(shape: &Shape, phi: Angle, assembly: Assembly) -> Result<Values<f64>, DyadError> {
    Ok(match shape {
        Shape::FourBar { solver, .. } => {
            let m = solver.position(phi, assembly)?;
            let (p, q) = (m.coupler, m.rocker);
            let transmission = m.transmission.rad();
            [
                p.angle.rad(),
                q.angle.rad(),
                p.first,
                q.first,
                p.second,
                q.second,
                transmission,
                m.determinant_m2,
            ]
        }
        Shape::SliderCrank { solver, .. } => {
            let m = solver.position(phi, assembly)?;
            [
                m.slider_m,
                m.rod.angle.rad(),
                m.slider_first_m,
                m.rod.first,
                m.slider_second_m,
                m.rod.second,
                m.transmission.rad(),
                m.determinant_m,
            ]
        }
    })
}

/// The columns' names with their units, `phi1_deg` and `branch` first.
pub fn names(dyad: &Dyad) -> Vec<String> {
    let values = match (&dyad.shape, dyad.crank.is_some()) {
        (Shape::FourBar { .. }, false) => [
            "phi2_deg",
            "phi3_deg",
            "dphi2_dphi1",
            "dphi3_dphi1",
            "d2phi2_dphi1_2_per_rad",
            "d2phi3_dphi1_2_per_rad",
            "transmission_angle_deg",
            "determinant_m2",
        ],
        (Shape::FourBar { .. }, true) => [
            "phi2_deg",
            "phi3_deg",
            "omega2_rad_per_s",
            "omega3_rad_per_s",
            "epsilon2_rad_per_s2",
            "epsilon3_rad_per_s2",
            "transmission_angle_deg",
            "determinant_m2",
        ],
        (Shape::SliderCrank { .. }, false) => [
            "slider_m",
            "phi2_deg",
            "dslider_dphi1_m_per_rad",
            "dphi2_dphi1",
            "d2slider_dphi1_2_m_per_rad2",
            "d2phi2_dphi1_2_per_rad",
            "transmission_angle_deg",
            "determinant_m",
        ],
        (Shape::SliderCrank { .. }, true) => [
            "slider_m",
            "phi2_deg",
            "slider_velocity_m_per_s",
            "omega2_rad_per_s",
            "slider_acceleration_m_per_s2",
            "epsilon2_rad_per_s2",
            "transmission_angle_deg",
            "determinant_m",
        ],
    };
    let head = ["phi1_deg", "branch"];
    head.iter().chain(&values).map(|s| s.to_string()).collect()
}
