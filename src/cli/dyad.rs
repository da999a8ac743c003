//! A four-bar linkage or slider-crank given in a file, computed over the turn of its crank.

use super::args::LinkageArgs;
use super::columns::Columns;
use super::crank_angles::Grid;
use super::dyad_certified::{self, Proved};
use super::dyad_facts as facts;
use super::dyad_file::{Dyad, Shape};
use super::dyad_values::{ASSEMBLIES, Values, at_crank_speed, number};
use super::failure::{Failure, Outcome};
use super::output::Output;
use super::progress::Progress;
use super::quantity::nearest;
use super::result::{decided, write_to_result};
use super::rows::{Cell, Rows};
use super::{complain, dyad_drawing};
use mechaudit::solvers::dyad::{Assembly, DyadError};
use mechaudit::solvers::units::Angle;
use rug::Rational;

/// Computes the linkage as the arguments ask for.
pub fn linkage(args: &LinkageArgs, dyad: &Dyad) -> Result<Outcome, Failure> {
    let kind = dyad.shape.kind();
    if args.svg.is_some() && args.all_branches {
        return Err(Failure::new(
            "--svg draws one branch: leave out --all-branches",
        ));
    }
    let assemblies = match (args.all_branches, args.branch) {
        (true, _) => ASSEMBLIES.to_vec(),
        (false, None) => vec![dyad.assembly],
        (false, Some(n)) => match ASSEMBLIES.get(n) {
            Some(assembly) => vec![*assembly],
            None => {
                return Err(Failure::new(format!(
                    "--branch {n}: a {kind} has the branches 0 (positive assembly) and 1 (negative)"
                )));
            }
        },
    };
    let grid = Grid::new(args, dyad.start.clone())?;
    let columns = Columns::of(names(dyad), &args.units.units, args.digits.is_some())?;
    let output = Output::open(args.output.as_deref())?;
    if let (Some(folder), [assembly]) = (&args.svg, &assemblies[..]) {
        let drawing = Output::within(folder, "mechanism.svg")?;
        drawing.text(&dyad_drawing::draw(dyad, *assembly))?;
    }
    let mut count = 0;
    let outcome = write_to_result(output, |out| {
        let about = facts::json(dyad, &assemblies);
        let mut rows = Rows::begin(out, args.format, columns, &about)?;
        let outcome = all_rows(args, dyad, &assemblies, &grid, &mut rows, &mut count);
        let outcome = outcome.map_err(|f| match f {
            Failure::Message(text) => Failure::new(format!("{}: {text}", args.file.display())),
            other => other,
        })?;
        rows.end()?;
        Ok(outcome)
    })?;
    for line in facts::lines(dyad, &assemblies) {
        complain(&line);
    }
    if count == 0 {
        complain("no crank angle of the window asked for lies in that range");
    }
    Ok(outcome)
}

fn all_rows(
    args: &LinkageArgs,
    dyad: &Dyad,
    assemblies: &[Assembly],
    grid: &Grid,
    rows: &mut Rows,
    count: &mut u64,
) -> Result<Outcome, Failure> {
    let progress = Progress::new();
    let mut undecided = 0;
    for k in 0..grid.count {
        let degrees = grid.angle(k as i64);
        for &assembly in assemblies {
            let (shown, values) = match args.digits {
                None => {
                    let shown = Cell::Float(nearest(&degrees));
                    (shown, floating(dyad, &degrees, assembly)?)
                }
                Some(digits) => {
                    let shown = Cell::Decimal(super::certified::decimal(&degrees));
                    match dyad_certified::row(dyad, &degrees, assembly, digits) {
                        Proved::Row(cells) => (shown, Some(cells)),
                        Proved::Unreachable => (shown, None),
                    }
                }
            };
            let Some(values) = values else { continue };
            let mut cells = vec![shown, Cell::Count(number(assembly))];
            cells.extend(values);
            undecided += cells.iter().filter(|c| **c == Cell::Undecided).count();
            rows.row(&cells)?;
            *count += 1;
        }
        if args.digits.is_some() || k % 1024 == 0 {
            progress.show("rows", k, grid.count);
        }
    }
    Ok(decided(undecided, args.digits.unwrap_or(0)))
}

/// A row in floating point; `None` where the crank does not reach the angle.
fn floating(
    dyad: &Dyad,
    degrees: &Rational,
    assembly: Assembly,
) -> Result<Option<Vec<Cell>>, Failure> {
    if dyad.shape.exactly_beyond(degrees) {
        return Ok(None);
    }
    let phi = Angle::from_rad(nearest(degrees).to_radians());
    let mut values = match position(&dyad.shape, phi, assembly) {
        Ok(values) => values,
        Err(DyadError::Unreachable { .. } | DyadError::Singular { .. }) => return Ok(None),
        Err(e) => {
            let at = nearest(degrees);
            return Err(Failure::new(format!("at phi1 = {at} deg: {e}")));
        }
    };
    if let Some(crank) = &dyad.crank {
        let (w, e) = (crank.omega.to_f64(), crank.epsilon.to_f64());
        values = at_crank_speed(values, |f, s| (f * w, s * w * w + f * e));
    }
    for i in dyad.angles() {
        values[i] = values[i].to_degrees();
    }
    if let Some(i) = values.iter().position(|x| !x.is_finite()) {
        return Err(Failure::new(format!(
            "{} exceeds the range of floating-point numbers at phi1 = {} deg",
            names(dyad)[i + 2],
            nearest(degrees)
        )));
    }
    Ok(Some(values.map(Cell::Float).to_vec()))
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

impl Dyad {
    /// Which of the values are angles.
    pub fn angles(&self) -> Vec<usize> {
        match self.shape {
            Shape::FourBar { .. } => vec![0, 1, 6],
            Shape::SliderCrank { .. } => vec![1, 6],
        }
    }
}

/// The columns' names with their units.
fn names(dyad: &Dyad) -> Vec<String> {
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
