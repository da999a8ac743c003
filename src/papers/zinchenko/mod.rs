//! Zinchenko, *Dynamic study of a sieving mechanism for moulding sand* (2008): a class-III linkage,
//! its reduced inertia and moment, and cubic splines of them.
//!
//! Everything is derived from the printed tables and data: the recipe behind the columns, the
//! centres of mass that belong to them, every entry's deviation, and what the paper's claim about
//! the spline's derivative is worth.

pub mod data;
mod derivative_claim;
mod design;
mod entries;
mod extreme;
mod findings;
mod fitted_nodes;
mod hidden_recipe;
mod moment_residual;
mod motion;
mod recipe;
mod recovery;
mod run_up;
mod tables;

pub use motion::motion;

use super::{Finding, PaperReport, Progress, file_of_known};
use crate::reference::{Ball, Undecided};
use crate::solvers::cubic_spline::Boundary;
use entries::Variant;
use recipe::{NODES, Nodes, Splines};
use recovery::{ALL_COLUMNS, INERTIA_COLUMNS, Model, Parameter};
use rug::Rational;
use tables::{Column, Printed};

/// Working precision of the recomputed tables: 25 digits and room for cancellation.
const BITS: u32 = 192;

/// The name used on the command line.
pub const KEY: &str = "zinchenko";

/// Audits the paper.
///
/// # Errors
/// [`Undecided`] when a certified value cannot be had at the working precision.
pub fn report(progress: Progress) -> Result<PaperReport, Undecided> {
    const STEPS: u64 = 7;
    let printed = tables::printed();
    progress("exact nodes", 0, STEPS);
    let exact = recipe::exact_nodes(&data::masses(data::RECOVERED), NODES, BITS)?;
    let as_printed = recipe::exact_nodes(&data::masses(data::PRINTED), NODES, BITS)?;
    progress("fitted nodes", 1, STEPS);
    let fitted = fitted_nodes::fit(&printed);
    let with_fitted = Nodes {
        moment: fitted.nodes.iter().map(|&m| exact_micro(m)).collect(),
        ..exact.clone()
    };
    let variants = [
        ("as_printed", &as_printed),
        ("recovered", &exact),
        ("recovered_fitted_nodes", &with_fitted),
    ]
    .map(|(name, nodes)| Variant {
        name,
        columns: Splines::new(nodes).columns(),
    });
    progress("entries", 2, STEPS);
    let (entries, tallies) = entries::entries(&printed, &variants);
    progress("recovery", 3, STEPS);
    let mut all = vec![
        twelve_nodes(&printed),
        findings::reproduction(&tallies, &entries),
        findings::misprints(&entries),
        findings::units_of_length(&tallies, in_metres_worst(&printed)),
    ];
    all.extend(recovered_centres(&printed));
    let residual = moment_residual::moment_residual(&printed, &exact, &fitted);
    all.push(findings::moment(&residual, &fitted));
    progress("the claim", 4, STEPS);
    all.extend(claims(&printed, &variants[1])?);
    progress("run-up", 5, STEPS);
    all.extend(findings::run_up(run_up::figures().as_ref()));
    progress("formulas", 6, STEPS);
    let file = file_of_known(KEY);
    for finding in file.summaries(&file.ledger()) {
        // It stands before the velocities that follow from it.
        if finding.id == "velocity-system" {
            all.push(extreme::finding(&extreme::PRINTED));
        }
        all.push(finding);
    }
    progress("done", STEPS, STEPS);
    Ok(PaperReport::new(file.citation.clone(), all).with_entries(entries, tallies))
}

/// A fitted node: a multiple of 1e-6, exactly.
fn exact_micro(x: f64) -> Ball {
    Ball::rational(BITS, &Rational::from(((x * 1e6).round() as i64, 1_000_000)))
}

fn twelve_nodes(printed: &[Printed]) -> Finding {
    findings::hidden_recipe(
        &hidden_recipe::projections(printed),
        &hidden_recipe::aliases(printed),
        [Boundary::Periodic, Boundary::NATURAL]
            .map(|ends| hidden_recipe::ends_misfit(printed, ends)),
    )
}

fn recovered_centres(printed: &[Printed]) -> [Finding; 2] {
    let model = Model::new();
    let centre = |i, k| Parameter::Centre(i, k);
    let seen = [centre(0, 0), centre(2, 0), centre(2, 1)];
    let five = [
        centre(0, 0),
        centre(1, 0),
        centre(2, 0),
        centre(2, 1),
        centre(3, 0),
    ];
    let mut everything: Vec<Parameter> = (0..4)
        .flat_map(|i| {
            [
                Parameter::Mass(i),
                Parameter::Inertia(i),
                centre(i, 0),
                centre(i, 1),
            ]
        })
        .collect();
    everything.push(Parameter::Gravity);
    let with_moment = model.recover_with_moment(printed, &five);
    let scales = &with_moment.scales;
    let found = model.identifiability(printed, &ALL_COLUMNS, &everything, scales);
    [
        findings::recovered_centres(
            &model.recover(printed, &INERTIA_COLUMNS, &seen),
            &with_moment,
            [
                model.rank_at_recovered(&INERTIA_COLUMNS, &five),
                model.rank_at_recovered(&ALL_COLUMNS, &everything),
            ],
        ),
        findings::identifiability(&found),
    ]
}

/// Worst deviation of the I_n column if the printed numbers are taken as metres: what the centres
/// of mass contribute grows by 10⁴.
fn in_metres_worst(printed: &[Printed]) -> f64 {
    let entries = tables::column(printed, Column::Inertia);
    // The rotational terms do not depend on the unit; the exact split is
    // I_n = Σ J φ'² + 10⁻⁴ Σ m |r'|² with r in centimetres.
    let states = recovery::node_states(NODES);
    let mut rotation = data::MassParameters::new(data::PRINTED);
    let mut printed_masses = data::MassParameters::new(data::PRINTED);
    printed_masses.mass[1] = 0.0;
    let full = printed_masses.masses();
    rotation.mass = [0.0; 4];
    let rotation = rotation.masses();
    (0..NODES)
        .map(|j| {
            let turning = rotation.reduce(&states[j]).inertia_kg_m2;
            let moving = full.reduce(&states[j]).inertia_kg_m2 - turning;
            (turning + 1e4 * moving - entries[4 * j].to_f64()).abs()
        })
        .reduce(f64::max)
        .expect("nodes")
}

fn claims(printed: &[Printed], recovered: &Variant) -> Result<Vec<Finding>, Undecided> {
    let slope = Column::ALL.iter().position(|c| *c == Column::InertiaSlope);
    let slopes = &recovered.columns[slope.expect("a column")][..48];
    let true_errors = derivative_claim::true_errors(slopes, BITS)?;
    let fine = derivative_claim::Fine::new();
    let errors = [12, 24, 48, 96].map(|n| fine.errors(n));
    let difference = tables::column(printed, Column::Difference);
    let largest = difference
        .iter()
        .max_by(|a, b| a.to_f64().abs().total_cmp(&b.to_f64().abs()))
        .expect("rows");
    Ok(vec![
        findings::claim_0119(
            &true_errors,
            &errors,
            (largest.row, largest.number.text.clone()),
        ),
        findings::convergence(&errors),
        findings::conclusion([12, 48].map(|n| (n, fine.hybrid_integral(n)))),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_tell_their_nodes() {
        assert!(twelve_nodes(&tables::printed()).as_recorded);
    }

    /// Against each of the rows 0, 4, … 44, and no others.
    #[test]
    fn metres_are_tried_at_the_nodes() {
        let with = |row: usize| {
            let mut printed = tables::printed();
            let place = |p: &Printed| p.column == Column::Inertia && p.row == row;
            printed
                .iter_mut()
                .find(|p| place(p))
                .unwrap()
                .number
                .value
                .value += 1_000_000_000;
            in_metres_worst(&printed) > 1e8
        };
        assert!((0..49).all(|row| with(row) == (row < 48 && row % 4 == 0)));
    }

    #[test]
    fn a_fitted_node_is_a_millionth_s_multiple() {
        for (x, due) in [
            (1.234_567_8, 1_234_568),
            (-0.000_002_4, -2),
            (12.0, 12_000_000),
        ] {
            let due = Rational::from((due, 1_000_000));
            assert!(
                (exact_micro(x) - Ball::rational(BITS, &due)).contains_zero(),
                "{x}"
            );
            assert!(exact_micro(x).rad().to_f64() < 1e-50);
        }
    }

    #[test]
    fn the_tables_tell_their_centres_of_mass() {
        let found = recovered_centres(&tables::printed());
        assert_eq!(
            found.each_ref().map(|f| (f.id, f.as_recorded)),
            [("centres-of-mass", true), ("identifiability", true),]
        );
        // Of four links mass, inertia and two parts of the centre, and gravity.
        let names: Vec<&str> = found[1]
            .figures
            .iter()
            .map(|f| f.name.split(" = ").next().unwrap())
            .collect();
        let of = |link: u32| {
            let along = ["along", "across"].map(|way| format!("s{link} {way} the link"));
            [vec![format!("m{link}"), format!("I{link}")], along.to_vec()].concat()
        };
        let due = [(2..=5).flat_map(of).collect(), vec!["g".to_string()]].concat();
        assert_eq!(names, due);
    }

    /// I_n is up to 5.63 in centimetres, nearly all of it of masses that move.
    #[test]
    fn metres_are_off_by_ten_thousand_times_what_moves() {
        let worst = in_metres_worst(&tables::printed());
        assert!((2e4..5.7e4).contains(&worst), "{worst}");
    }
}
