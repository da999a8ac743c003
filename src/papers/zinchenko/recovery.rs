//! Which mass parameters the printed tables determine, and to how many digits.
//!
//! The model is the recipe: exact quantities at twelve nodes, periodic spline, 48 rows. Printed
//! entries are weighted by their rounding (a unit of the last digit over √12). Gauss–Newton starts
//! from the printed data; standard deviations come from the covariance at the solution.

use super::data::{self, MassParameters};
use super::design::{TURN, least_squares, rounding_deviation, spline_rows};
use super::recipe::NODES;
use super::tables::{Column, Printed, Source, column};
use crate::solvers::class_iii::State;
use crate::solvers::units::Angle;
use nalgebra::{DMatrix, DVector};

/// A parameter of the masses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parameter {
    /// Mass of link 2 + i.
    Mass(usize),
    /// Inertia of link 2 + i.
    Inertia(usize),
    /// Centre of mass of link 2 + i along (0) or across (1) the link.
    Centre(usize, usize),
    /// Gravity.
    Gravity,
}

impl Parameter {
    /// Its name in the paper.
    pub(super) fn name(self) -> String {
        match self {
            Parameter::Mass(i) => format!("m{}", i + 2),
            Parameter::Inertia(i) => format!("I{}", i + 2),
            Parameter::Centre(i, 0) => format!("s{} along the link", i + 2),
            Parameter::Centre(i, _) => format!("s{} across the link", i + 2),
            Parameter::Gravity => "g".into(),
        }
    }

    /// The unit it is shown in and how many of them make the SI unit.
    pub(super) fn shown_unit(self) -> (&'static str, f64) {
        match self {
            Parameter::Mass(_) => ("kg", 1.0),
            Parameter::Inertia(_) => ("kg m^2", 1.0),
            Parameter::Centre(..) => ("cm", 100.0),
            Parameter::Gravity => ("m/s^2", 1.0),
        }
    }

    fn of(self, p: &mut MassParameters) -> &mut f64 {
        match self {
            Parameter::Mass(i) => &mut p.mass[i],
            Parameter::Inertia(i) => &mut p.inertia[i],
            Parameter::Centre(i, k) => &mut p.centre[i][k],
            Parameter::Gravity => &mut p.gravity,
        }
    }
}

/// An estimate with its standard deviation, in SI units.
#[derive(Clone, Debug)]
pub(super) struct Estimate {
    pub parameter: Parameter,
    pub value: f64,
    pub deviation: f64,
}

/// The outcome of a fit.
#[derive(Clone, Debug)]
pub(super) struct Recovery {
    pub estimates: Vec<Estimate>,
    /// `√(χ²/degrees of freedom)`: 1 if rounding explains everything.
    pub misfit: f64,
    /// Root mean square residual of each column over the standard deviation used for it.
    pub column_misfits: Vec<f64>,
    /// Entries used and left out.
    pub used: usize,
    pub left_out: usize,
    /// Number of singular values of the scaled design above 1e-10 of the largest.
    pub rank: usize,
    /// The factors that raise the columns' deviations.
    pub scales: Vec<f64>,
    /// Covariance in SI units.
    pub covariance: DMatrix<f64>,
}

impl Recovery {
    pub(super) fn get(&self, p: Parameter) -> &Estimate {
        self.estimates
            .iter()
            .find(|e| e.parameter == p)
            .expect("a fitted parameter")
    }
}

/// How closely a parameter is determined, in SI units; infinite where it is not.
#[derive(Clone, Copy, Debug)]
pub(super) struct Identifiability {
    pub parameter: Parameter,
    pub value: f64,
    /// Standard deviation with every other parameter known.
    pub alone: f64,
    /// Standard deviation with every other parameter unknown too.
    pub together: f64,
}

/// The columns that depend on I_n alone.
pub(super) const INERTIA_COLUMNS: [Column; 4] = [
    Column::Inertia,
    Column::InertiaSlope,
    Column::Derivative,
    Column::DerivativeSlope,
];
/// All columns that are splines.
pub(super) const ALL_COLUMNS: [Column; 6] = [
    Column::Inertia,
    Column::InertiaSlope,
    Column::Derivative,
    Column::DerivativeSlope,
    Column::Moment,
    Column::MomentSlope,
];

/// The model with everything that does not depend on the masses precomputed.
pub(super) struct Model {
    states: Vec<State>,
    value: DMatrix<f64>,
    slope: DMatrix<f64>,
}

impl Model {
    pub(super) fn new() -> Model {
        Model {
            states: node_states(NODES),
            value: spline_rows(NODES, 0, false),
            slope: spline_rows(NODES, 0, true),
        }
    }

    /// The 48 values of each column.
    fn columns(&self, p: &MassParameters, columns: &[Column]) -> DVector<f64> {
        let masses = p.masses();
        let rows: Vec<_> = self.states.iter().map(|s| masses.reduce(s)).collect();
        let nodes = |f: &dyn Fn(usize) -> f64| DVector::from_fn(NODES, |j, _| f(j));
        let mut all = Vec::with_capacity(columns.len() * TURN);
        for c in columns {
            let (node, slope) = match c.source() {
                Source::Inertia(s) => (nodes(&|j| rows[j].inertia_kg_m2), s),
                Source::Derivative(s) => (nodes(&|j| rows[j].inertia_derivative_kg_m2), s),
                Source::Moment(s) => (nodes(&|j| rows[j].moment_n_m), s),
                Source::Difference => unreachable!("not a spline column"),
            };
            let design = if slope { &self.slope } else { &self.value };
            all.extend((design * node).iter().copied());
        }
        DVector::from_vec(all)
    }

    fn jacobian(
        &self,
        p: &MassParameters,
        columns: &[Column],
        which: &[Parameter],
    ) -> DMatrix<f64> {
        let mut j = DMatrix::zeros(columns.len() * TURN, which.len());
        for (k, parameter) in which.iter().enumerate() {
            // The model is at most quadratic in each parameter, so central differences are exact
            // up to rounding whatever the step.
            let step = 0.01;
            let at = |sign: f64| {
                let mut q = *p;
                *parameter.of(&mut q) += sign * step;
                self.columns(&q, columns)
            };
            j.set_column(k, &((at(1.0) - at(-1.0)) / (2.0 * step)));
        }
        j
    }

    /// Fits the parameters to the columns from the printed data, weighted by rounding.
    pub(super) fn recover(
        &self,
        printed: &[Printed],
        columns: &[Column],
        which: &[Parameter],
    ) -> Recovery {
        self.recover_scaled(printed, columns, which, &vec![1.0; columns.len()])
    }

    /// As [`Model::recover`], with the standard deviations of the M_o columns raised until their
    /// residuals are of that size: they carry more than rounding (see the moment's residual), and
    /// weights of rounding would let it bend what the I_n columns say.
    pub(super) fn recover_with_moment(&self, printed: &[Printed], which: &[Parameter]) -> Recovery {
        let columns = &ALL_COLUMNS;
        // Start from far too large and come down, so that the I_n columns lead.
        let mut scales = [1.0, 1.0, 1.0, 1.0, 100.0, 100.0];
        let mut found = self.recover_scaled(printed, columns, which, &scales);
        for _ in 0..30 {
            for (k, scale) in scales.iter_mut().enumerate().skip(4) {
                *scale = (*scale * found.column_misfits[k]).max(1.0);
            }
            found = self.recover_scaled(printed, columns, which, &scales);
        }
        found
    }

    fn recover_scaled(
        &self,
        printed: &[Printed],
        columns: &[Column],
        which: &[Parameter],
        scales: &[f64],
    ) -> Recovery {
        let entries: Vec<&Printed> = columns
            .iter()
            .flat_map(|&c| column(printed, c).into_iter().take(TURN))
            .collect();
        let b = DVector::from_fn(entries.len(), |i, _| entries[i].to_f64());
        let rounding = DVector::from_fn(entries.len(), |i, _| {
            rounding_deviation(entries[i].unit()) * scales[i / TURN]
        });
        let mut sigma = rounding.clone();
        let mut p = MassParameters::new(data::PRINTED);
        let mut left_out = 0;
        let mut last = None;
        for round in 0..40 {
            let residual = &b - self.columns(&p, columns);
            let design = self.jacobian(&p, columns, which);
            let fit = least_squares(&design, &residual, &sigma);
            for (k, parameter) in which.iter().enumerate() {
                *parameter.of(&mut p) += fit.x[k];
            }
            let settled = fit.x.amax() < 1e-11;
            // Entries that no rounding explains (20 units in one misprint) would pull the rest.
            let typical = typical_size(&fit.residuals);
            if settled || round == 39 {
                let misprints: Vec<usize> = (0..b.len())
                    .filter(|&i| fit.residuals[i].abs() > 8.0 * typical.max(1.0))
                    .collect();
                if last.is_some() || misprints.is_empty() {
                    last = Some(fit);
                    break;
                }
                left_out = misprints.len();
                for i in misprints {
                    sigma[i] = rounding[i] * 1e9;
                }
                last = Some(fit);
            }
        }
        let fit = last.expect("forty rounds");
        let used = b.len() - left_out;
        let freedom = (used - which.len()) as f64;
        let column_misfits = (0..columns.len())
            .map(|c| (fit.residuals.rows(c * TURN, TURN).norm_squared() / TURN as f64).sqrt())
            .collect();
        Recovery {
            misfit: (fit.residuals.norm_squared() / freedom).sqrt(),
            column_misfits,
            scales: scales.to_vec(),
            used,
            left_out,
            rank: self.rank(&p, columns, which, &sigma),
            estimates: which
                .iter()
                .enumerate()
                .map(|(k, &parameter)| Estimate {
                    parameter,
                    value: *parameter.of(&mut p.clone()),
                    deviation: fit.covariance[(k, k)].sqrt(),
                })
                .collect(),
            covariance: fit.covariance,
        }
    }

    /// How closely the tables determine each parameter at the recovered masses: alone, with all
    /// others known, and together with all others. `scales` raise the deviations of the columns
    /// above rounding.
    pub(super) fn identifiability(
        &self,
        printed: &[Printed],
        columns: &[Column],
        which: &[Parameter],
        scales: &[f64],
    ) -> Vec<Identifiability> {
        let mut p = MassParameters::new(data::RECOVERED);
        let entries: Vec<&Printed> = columns
            .iter()
            .flat_map(|&c| column(printed, c).into_iter().take(TURN))
            .collect();
        let sigma = DVector::from_fn(entries.len(), |i, _| {
            rounding_deviation(entries[i].unit()) * scales[i / TURN]
        });
        let design = self.jacobian(&p, columns, which);
        let nothing = DVector::zeros(entries.len());
        let joint = least_squares(&design, &nothing, &sigma).covariance;
        which
            .iter()
            .enumerate()
            .map(|(k, &parameter)| {
                let weight = design.column(k).component_div(&sigma).norm();
                Identifiability {
                    parameter,
                    value: *parameter.of(&mut p),
                    alone: 1.0 / weight,
                    together: joint[(k, k)].sqrt(),
                }
            })
            .collect()
    }

    /// Rank of the design at the recovered masses, each parameter scaled to its size.
    pub(super) fn rank_at_recovered(&self, columns: &[Column], which: &[Parameter]) -> usize {
        let p = MassParameters::new(data::RECOVERED);
        let sigma = DVector::from_element(columns.len() * TURN, 1.0);
        self.rank(&p, columns, which, &sigma)
    }

    fn rank(
        &self,
        p: &MassParameters,
        columns: &[Column],
        which: &[Parameter],
        sigma: &DVector<f64>,
    ) -> usize {
        let mut design = self.jacobian(p, columns, which);
        for i in 0..design.nrows() {
            design.row_mut(i).scale_mut(1.0 / sigma[i]);
        }
        for (k, parameter) in which.iter().enumerate() {
            let size = parameter.of(&mut p.clone()).abs().max(0.1);
            design.column_mut(k).scale_mut(size);
        }
        numerical_rank(&design.singular_values())
    }
}

/// How many singular values are not rounding beside the largest.
fn numerical_rank(values: &DVector<f64>) -> usize {
    let least = values.max() * 1e-10;
    values.iter().filter(|x| **x > least).count()
}

/// Median absolute residual, scaled to a standard deviation.
fn typical_size(residuals: &DVector<f64>) -> f64 {
    let mut sizes: Vec<f64> = residuals.iter().map(|r| r.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    sizes[sizes.len() / 2] / 0.6745
}

fn start_deg() -> f64 {
    data::START_DEG.parse().expect("a decimal in the source")
}

/// The f64 state of row 0, on the paper's branch.
pub(super) fn first_state() -> State {
    let linkage = data::solver_linkage();
    let start = start_deg();
    let phi4: f64 = data::START_PHI4_DEG
        .parse()
        .expect("a decimal in the source");
    let modes = linkage.assembly_modes(Angle::from_deg(start)).modes;
    let mode = modes.iter().min_by(|a, b| {
        let d = |m: &crate::solvers::class_iii::Positions| (m.phi4.to_degrees() - phi4).abs();
        d(a).total_cmp(&d(b))
    });
    let mode = *mode.expect("the paper's linkage can be assembled");
    linkage
        .state_near(Angle::from_deg(start), mode)
        .expect("a closed start")
}

/// The f64 states at `n` equally spaced crank angles from row 0.
pub(super) fn node_states(n: usize) -> Vec<State> {
    let start = start_deg();
    let angles = (0..n).map(|j| Angle::from_deg(start + 360.0 * j as f64 / n as f64));
    data::solver_linkage()
        .sweep(&first_state(), angles)
        .expect("the paper's crank turns fully")
}

#[cfg(test)]
mod tests;
