//! Which mass parameters the printed tables determine, and to how many digits.
//!
//! The model is the recipe: exact quantities at twelve nodes, periodic spline, 48 rows. Printed
//! entries are weighted by their rounding (a unit of the last digit over √12). Gauss–Newton starts
//! from the printed data; standard deviations come from the covariance at the solution.

use super::data;
use super::design::{TURN, least_squares, observed, read, spline_rows};
use super::recipe::NODES;
use super::tables::{INERTIA, MOMENT, is_slope};
use crate::papers::file::{Measured, Quantity};
use crate::papers::number::Number;
use crate::papers::{Figure, figure};
use crate::reference::{class_iii::Masses, nearest_f64};
use crate::solvers::class_iii::State;
use crate::solvers::reduction::{self, Body, MomentOfInertia};
use crate::solvers::units::{Acceleration, Angle, Inertia, Length, Mass};
use nalgebra::{DMatrix, DVector};

/// Parameters of the masses: of each of the links 2 to 5 the mass, the inertia and the centre of
/// mass along and across the link, then gravity; in SI units.
const PARAMETERS: usize = 17;
const GRAVITY: usize = 16;
/// Of links 2 and 4 those that the columns of I_n determine, then those of links 3 and 5.
const SEEN: [usize; 3] = [2, 10, 11];
const FIVE: [usize; 5] = [2, 6, 10, 11, 14];

/// All of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Parameters(pub [f64; PARAMETERS]);

/// The name of a parameter in the paper, the unit it is shown in, and how many of them make the SI
/// unit.
fn shown(parameter: usize) -> (String, &'static str, f64) {
    let link = parameter / 4 + 2;
    match parameter % 4 {
        _ if parameter == GRAVITY => ("g".into(), "m/s^2", 1.0),
        0 => (format!("m{link}"), "kg", 1.0),
        1 => (format!("I{link}"), "kg m^2", 1.0),
        2 => (format!("s{link} along the link"), "cm", 100.0),
        _ => (format!("s{link} across the link"), "cm", 100.0),
    }
}

impl Parameters {
    pub(super) fn new(masses: &Masses) -> Parameters {
        let mut all = [nearest_f64(&masses.gravity); PARAMETERS];
        for (body, four) in masses.bodies[1..].iter().zip(all.chunks_mut(4)) {
            let (r, a) = (nearest_f64(&body.radius), body.angle.to_ball(64).to_f64());
            let inertia = nearest_f64(&body.inertia);
            four.copy_from_slice(&[nearest_f64(&body.mass), inertia, r * a.cos(), r * a.sin()]);
        }
        Parameters(all)
    }

    /// The same for the solvers.
    pub(super) fn masses(&self) -> reduction::Masses {
        let of = |i: usize, [mass, j, x, y]: [f64; 4]| Body {
            mass: Mass::from_kg(mass),
            inertia: match i {
                2 | 4 => MomentOfInertia::AboutCentreOfMass(Inertia::from_kg_m2(j)),
                _ => MomentOfInertia::AboutPivot(Inertia::from_kg_m2(j)),
            },
            radius: Length::from_m(x.hypot(y)),
            angle: Angle::from_rad(y.atan2(x)),
        };
        let four = |i: usize| std::array::from_fn(|k| self.0[4 * (i - 2) + k]);
        let bodies = [1, 2, 3, 4, 5].map(|i| of(i, if i == 1 { [0.0; 4] } else { four(i) }));
        let gravity = Acceleration::from_m_per_s2(self.0[GRAVITY]);
        reduction::Masses::new(bodies, gravity).expect("masses of the paper are valid")
    }

    fn moved(mut self, parameter: usize, by: f64) -> Parameters {
        self.0[parameter] += by;
        self
    }
}

/// The outcome of a fit, in SI units.
struct Recovery {
    values: Vec<f64>,
    covariance: DMatrix<f64>,
    /// `√(χ²/degrees of freedom)`: 1 if rounding explains everything.
    misfit: f64,
    /// Root mean square residual of each column over the standard deviation used for it.
    column_misfits: Vec<f64>,
    /// Entries used and left out.
    used: usize,
    left_out: usize,
}

/// The model with everything that does not depend on the masses precomputed, and the columns that
/// it is compared with.
struct Model<'a> {
    states: Vec<State>,
    /// Of the spline and of its derivative.
    designs: [DMatrix<f64>; 2],
    printed: &'a [Vec<Number>],
}

impl Model<'_> {
    fn new(printed: &[Vec<Number>]) -> Model<'_> {
        Model {
            states: data::states(NODES),
            designs: [false, true].map(|slope| spline_rows(NODES, 0, slope)),
            printed,
        }
    }

    /// The 48 values of each of the first columns.
    fn columns(&self, p: &Parameters, columns: usize) -> DVector<f64> {
        let masses = p.masses();
        let rows = self.states.iter().map(|s| {
            let r = masses.reduce(s);
            [r.inertia_kg_m2, r.inertia_derivative_kg_m2, r.moment_n_m]
        });
        let rows: Vec<[f64; 3]> = rows.collect();
        let mut all = Vec::with_capacity(columns * TURN);
        for c in 0..columns {
            let nodes = DVector::from_fn(NODES, |j, _| rows[j][c / 2]);
            all.extend((&self.designs[usize::from(is_slope(c))] * nodes).iter());
        }
        DVector::from_vec(all)
    }

    /// The model is at most quadratic in each parameter, so central differences are exact up to
    /// rounding whatever the step.
    fn jacobian(&self, p: &Parameters, columns: usize, which: &[usize]) -> DMatrix<f64> {
        const STEP: f64 = 0.01;
        let slopes = which.iter().map(|&k| {
            let at = |step: f64| self.columns(&p.moved(k, step), columns);
            (at(STEP) - at(-STEP)) / (2.0 * STEP)
        });
        DMatrix::from_columns(&slopes.collect::<Vec<_>>())
    }

    /// The printed entries of the first columns and their deviations of rounding, raised by the
    /// scales.
    fn observed(&self, scales: &[f64]) -> [DVector<f64>; 2] {
        let [b, sigma] = observed(&self.printed[..scales.len()]);
        let raised = sigma.map_with_location(|i, _, sd| sd * scales[i / TURN]);
        [b, raised]
    }

    /// Fits parameters to as many columns as there are scales, from the printed data, weighted by
    /// rounding.
    fn recover(&self, scales: &[f64], which: &[usize]) -> Recovery {
        let columns = scales.len();
        let [b, rounding] = self.observed(scales);
        let mut sigma = rounding.clone();
        let mut p = Parameters::new(&data::printed());
        let (mut left_out, mut second) = (0, false);
        let mut round = 0;
        let fit = loop {
            let residual = &b - self.columns(&p, columns);
            let fit = least_squares(&self.jacobian(&p, columns, which), &residual, &sigma);
            for (&k, step) in which.iter().zip(&fit.x) {
                p = p.moved(k, *step);
            }
            round += 1;
            if fit.x.amax() >= 1e-11 && round < 40 {
                continue;
            }
            // Entries that no rounding explains (20 units in one misprint) would pull the rest.
            let most = 8.0 * typical_size(&fit.residuals).max(1.0);
            let misprints = (0..b.len()).filter(|&i| fit.residuals[i].abs() > most);
            let misprints: Vec<usize> = misprints.collect();
            if second || misprints.is_empty() || round >= 40 {
                break fit;
            }
            second = true;
            left_out = misprints.len();
            for i in misprints {
                sigma[i] = rounding[i] * 1e9;
            }
        };
        let used = b.len() - left_out;
        let freedom = (used - which.len()) as f64;
        let of = |c: usize| fit.residuals.rows(c * TURN, TURN).norm_squared() / TURN as f64;
        Recovery {
            values: which.iter().map(|&k| p.0[k]).collect(),
            misfit: (fit.residuals.norm_squared() / freedom).sqrt(),
            column_misfits: (0..columns).map(|c| of(c).sqrt()).collect(),
            used,
            left_out,
            covariance: fit.covariance,
        }
    }

    /// Fits to all columns with the standard deviations of the M_o columns raised until their
    /// residuals are of that size: they carry more than rounding (see the moment's residual), and
    /// weights of rounding would let it bend what the I_n columns say. Also returns the factors.
    fn recover_with_moment(&self, which: &[usize]) -> (Recovery, [f64; 6]) {
        // Start from far too large and come down, so that the I_n columns lead.
        let mut scales = [1.0, 1.0, 1.0, 1.0, 100.0, 100.0];
        let mut found = self.recover(&scales, which);
        for _ in 0..30 {
            for (k, scale) in scales.iter_mut().enumerate().skip(MOMENT) {
                *scale = (*scale * found.column_misfits[k]).max(1.0);
            }
            found = self.recover(&scales, which);
        }
        (found, scales)
    }

    /// The standard deviations of each parameter at the recovered masses: with every other one
    /// known, and with all of them unknown; infinite where it is not determined.
    fn identifiability(&self, scales: &[f64], which: &[usize]) -> Vec<[f64; 2]> {
        let p = Parameters::new(&data::recovered());
        let [_, sigma] = self.observed(scales);
        let design = self.jacobian(&p, scales.len(), which);
        let joint = least_squares(&design, &DVector::zeros(sigma.len()), &sigma).covariance;
        let weight = |k: usize| design.column(k).component_div(&sigma).norm();
        (0..which.len())
            .map(|k| [1.0 / weight(k), joint[(k, k)].sqrt()])
            .collect()
    }

    /// Rank of the design at the recovered masses, each parameter scaled to its size.
    fn rank(&self, columns: usize, which: &[usize]) -> usize {
        let p = Parameters::new(&data::recovered());
        let mut design = self.jacobian(&p, columns, which);
        for (mut column, &k) in design.column_iter_mut().zip(which) {
            column *= p.0[k].abs().max(0.1);
        }
        // Singular values that are not rounding beside the largest.
        let values = design.singular_values();
        values.iter().filter(|x| **x > values.max() * 1e-10).count()
    }
}

/// Median absolute residual, scaled to a standard deviation.
fn typical_size(residuals: &DVector<f64>) -> f64 {
    let mut sizes: Vec<f64> = residuals.iter().map(|r| r.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    sizes[sizes.len() / 2] / 0.6745
}

/// Recovers the centres of mass, and says which parameters the tables determine.
pub(super) fn measure(printed: &[Vec<Number>], measured: &mut Measured) {
    let model = Model::new(printed);
    let everything: Vec<usize> = (0..PARAMETERS).collect();
    let inertia = model.recover(&[1.0; 4], &SEEN);
    let (all, scales) = model.recover_with_moment(&FIVE);
    for (prefix, fit, names) in [
        ("", &inertia, &["s2", "x4", "y4"][..]),
        ("all_", &all, &["s2", "s3", "", "", "s5"]),
    ] {
        for (k, name) in names.iter().enumerate().filter(|n| !n.1.is_empty()) {
            measured.set(format!("{prefix}{name}"), fit.values[k]);
            measured.set(format!("{prefix}{name}_sd"), fit.covariance[(k, k)].sqrt());
        }
    }
    measured.set("xy4", inertia.covariance[(1, 2)]);
    measured.set("misfit", inertia.misfit);
    for (name, count) in [
        ("used", inertia.used),
        ("unused", inertia.left_out),
        ("rank_inertia", model.rank(4, &FIVE)),
        ("rank_five", model.rank(6, &FIVE)),
        ("rank_all", model.rank(6, &everything)),
    ] {
        measured.set(name, count as f64);
    }
    let found = model.identifiability(&scales, &everything);
    let alone = found.iter().filter(|f| f[0].is_finite()).count();
    measured.set("traced", alone as f64);
    measured.add("parameters", Quantity::Figures(figures(&found)));
    // Within one of the units shown; a standard deviation of metres determines nothing.
    let determined = everything
        .iter()
        .filter(|&&k| found[k][1] * shown(k).2 < 1.0);
    let determined: Vec<String> = determined.map(|&k| shown(k).0).collect();
    measured.text("determined", determined.join(" and "));
    measured.set("metres", off_in_metres(&model.states, printed));
}

/// The standard deviations by parameter.
fn figures(found: &[[f64; 2]]) -> Vec<Figure> {
    let at = Parameters::new(&data::recovered());
    let one = |(k, both): (usize, &[f64; 2])| {
        let (name, unit, per_si) = shown(k);
        let [alone, together] = both.map(|x| match x.is_finite() {
            true => format!("{:.2e}", x * per_si),
            false => "not at all".into(),
        });
        let name = format!(
            "{name} = {:.4}: alone / with all others free",
            at.0[k] * per_si
        );
        figure(name, format!("{alone} / {together}"), unit)
    };
    found.iter().enumerate().map(one).collect()
}

/// Worst deviation of the I_n column at the nodes if the printed numbers are taken as metres: what
/// the centres of mass contribute grows by 10⁴, what turns does not depend on the unit.
fn off_in_metres(states: &[State], printed: &[Vec<Number>]) -> f64 {
    let all = Parameters::new(&data::printed());
    let turning = (0..4).fold(all, |p, link| p.moved(4 * link, -p.0[4 * link]));
    let [all, turning] = [all, turning].map(|p| p.masses());
    let off = states.iter().enumerate().map(|(j, state)| {
        let turning = turning.reduce(state).inertia_kg_m2;
        let moving = all.reduce(state).inertia_kg_m2 - turning;
        (turning + 1e4 * moving - read(&printed[INERTIA][TURN / NODES * j])[0]).abs()
    });
    off.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests;
