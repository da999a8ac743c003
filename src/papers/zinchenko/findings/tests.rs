//! Findings of planted figures: each condition that one is recorded with, by itself.

use super::*;
use crate::papers::zinchenko::derivative_claim::NodeErrors;
use crate::papers::zinchenko::fitted_nodes::FittedMoment;
use crate::papers::zinchenko::hidden_recipe::{self, Alias};
use crate::papers::zinchenko::moment_residual::MomentResidual;
use crate::papers::zinchenko::recovery::{Estimate, Identifiability, Parameter, Recovery};
use crate::papers::zinchenko::run_up::{Against, Figures};
use crate::papers::zinchenko::tables::{Column, printed};
use crate::papers::{Entry, EntryVerdict, Finding, Tally, VariantJudgement};
use crate::reference::Ball;
use crate::solvers::cubic_spline::Boundary;
use crate::solvers::run_up::Cycle;
use nalgebra::DMatrix;

/// Names of the findings that are not as recorded.
fn lost(all: &[Finding]) -> Vec<&str> {
    let lost = all.iter().filter(|f| !f.as_recorded);
    lost.map(|f| f.id).collect()
}

fn against(nodes: usize) -> Against {
    Against {
        nodes,
        run_up: 0.0,
        steady: 0.0,
        period: 0.0,
        fluctuation: 0.0,
        work: 0.0,
        evaluations: 0,
        free: 1.0,
        within: 0.0,
    }
}

/// Figures within every limit.
fn motions() -> Figures {
    let exact = Cycle {
        psi: 10.0,
        period: 0.6,
        mean: 10.0,
        least: (9.0, 0.0),
        most: (11.0, 1.0),
        fluctuation: 0.14103,
        multiplier: 0.0,
        work: [-9e-9, 1.0, 1.0],
        kinetic_energy: 0.0,
        mismatch: 0.0,
        iterations: 1,
        counts: Default::default(),
    };
    let few = Against {
        run_up: 1.2e-2,
        steady: 1.2e-2,
        work: 0.19983,
        evaluations: 1060,
        free: 0.880_234_867,
        ..against(12)
    };
    let many = Against {
        run_up: 1e-4,
        steady: 1.9e-4,
        evaluations: 1210,
        free: 0.999_868_956,
        ..against(48)
    };
    Figures {
        exact,
        exact_evaluations: 1000,
        exact_free: 1.0,
        start_times: [1.2e-3, 0.054],
        splines: [against(12), against(48)],
        hybrids: [few, many],
    }
}

#[test]
fn a_run_up_is_recorded_within_its_limits() {
    let found = |plant: fn(&mut Figures)| {
        let mut f = motions();
        plant(&mut f);
        let all = run_up(Some(&f));
        assert_eq!(all.len(), 3);
        lost(&all).join(" ")
    };
    assert_eq!(found(|_| ()), "");
    let motor: [fn(&mut Figures); 17] = [
        |f| f.hybrids[0].run_up = 1.09e-2,
        |f| f.hybrids[0].run_up = 1.3e-2,
        |f| f.hybrids[0].steady = 1.09e-2,
        |f| f.hybrids[0].steady = 1.3e-2,
        |f| f.hybrids[1].run_up = 2e-4,
        |f| f.hybrids[1].run_up = 1.0,
        |f| f.hybrids[1].steady = 2e-4,
        |f| f.hybrids[1].steady = 1.0,
        |f| f.exact.work[0] = 1e-8,
        |f| f.exact.work[0] = -1e-8,
        |f| f.exact.work[0] = 1.0,
        |f| f.hybrids[0].work = 0.19982,
        |f| f.exact.fluctuation = 0.14104,
        |f| f.start_times[0] = 1.3e-3,
        |f| f.start_times[0] = 1.1e-3,
        |f| f.start_times[1] = 0.055,
        |f| f.start_times[1] = 0.053,
    ];
    for (k, plant) in motor.into_iter().enumerate() {
        assert_eq!(found(plant), "run-up-motor", "{k}");
    }
    let still: [fn(&mut Figures); 3] = [
        |f| f.hybrids[0].run_up = 1.1e-2,
        |f| f.hybrids[0].steady = 1.1e-2,
        |f| f.hybrids[1].run_up = 1.99e-4,
    ];
    assert!(still.into_iter().all(|plant| found(plant).is_empty()));
    let free: [fn(&mut Figures); 5] = [
        |f| f.exact_free = 1.0 + 1e-9,
        |f| f.splines[0].free = 1.0 - 1e-9,
        |f| f.splines[1].free = 1.0 + 1e-9,
        |f| f.hybrids[0].free += 1e-9,
        |f| f.hybrids[1].free += 1e-9,
    ];
    for (k, plant) in free.into_iter().enumerate() {
        assert_eq!(found(plant), "run-up-free", "{k}");
    }
    let cost: [fn(&mut Figures); 2] = [
        |f| f.hybrids[0].evaluations = 1049,
        |f| f.hybrids[1].evaluations = 1199,
    ];
    for plant in cost {
        assert_eq!(found(plant), "run-up-cost");
    }
    assert_eq!(lost(&run_up(None)), ["run-up"]);
}

/// Half a per cent of 10 rad/s is 0.05 rad/s; 0.9² leaves 19 % lost.
#[test]
fn texts_of_the_run_up_are_in_per_cent() {
    let mut f = motions();
    f.hybrids[0] = Against {
        run_up: 0.01,
        steady: 0.05,
        free: 0.9,
        evaluations: 1250,
        ..f.hybrids[0]
    };
    f.splines[0].within = 0.0123;
    let [motor, free, cost] = &run_up(Some(&f))[..] else {
        panic!("three findings");
    };
    assert!(
        motor.text.contains("by at most 0.50 % of ω_c"),
        "{}",
        motor.text
    );
    assert!(motor.text.contains("reached in 1.20 ms"), "{}", motor.text);
    assert!(
        free.text.contains("loses 19.00 % of the energy"),
        "{}",
        free.text
    );
    assert!(free.text.contains("up to 1.23 % with 12"), "{}", free.text);
    assert!(cost.text.contains("takes 25 % more"), "{}", cost.text);
    let names = |f: &Finding| {
        f.figures
            .iter()
            .filter(|g| g.name.contains(" nodes"))
            .count()
    };
    assert_eq!([motor, free, cost].map(names), [12, 6, 4]);
}

fn recovery(of: &[(usize, usize, f64, f64)], rank: usize, covariance: [[f64; 2]; 2]) -> Recovery {
    let estimate = |&(i, k, value, deviation): &(usize, usize, f64, f64)| Estimate {
        parameter: Parameter::Centre(i, k),
        value,
        deviation,
    };
    let n = of.len();
    // Of the two of link 4, which are the last but one and the last, or the last but two and the
    // last but one.
    let first = of.iter().position(|e| (e.0, e.1) == (2, 0)).unwrap();
    let second = of.iter().position(|e| (e.0, e.1) == (2, 1)).unwrap();
    let place = |i: usize| [first, second].iter().position(|k| *k == i);
    Recovery {
        estimates: of.iter().map(estimate).collect(),
        misfit: 1.0,
        column_misfits: Vec::new(),
        used: 190,
        left_out: 2,
        rank,
        scales: Vec::new(),
        covariance: DMatrix::from_fn(n, n, |i, j| match (place(i), place(j)) {
            (Some(i), Some(j)) => covariance[i][j],
            _ => 7.0,
        }),
    }
}

#[test]
fn centres_are_recorded_within_four_deviations() {
    let small = [[1e-10, 0.0], [0.0, 1e-10]];
    let recorded = |s2: f64, radius: f64, degrees: f64, s3: f64, s5: f64, ranks: [usize; 4]| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let own = [(2, 0, radius * cos, 0.0), (2, 1, radius * sin, 0.0)];
        let inertia = [(0, 0, s2, 1e-3), own[0], own[1]];
        let all = [
            (0, 0, 0.4, 0.0),
            (1, 0, s3, 1e-2),
            own[0],
            own[1],
            (3, 0, s5, 1e-2),
        ];
        let inertia = recovery(&inertia, ranks[2], small);
        let all = recovery(&all, ranks[3], small);
        recovered_centres(&inertia, &all, [ranks[0], ranks[1]]).as_recorded
    };
    let ranks = [3, 12, 3, 5];
    assert!(recorded(0.5, 0.25, -12.0, 0.30, 0.20, ranks));
    assert!(recorded(0.503, 0.25003, -12.005, 0.33, 0.17, ranks));
    assert!(!recorded(0.505, 0.25, -12.0, 0.30, 0.20, ranks));
    assert!(!recorded(0.5, 0.25005, -12.0, 0.30, 0.20, ranks));
    assert!(!recorded(0.5, 0.25, -12.015, 0.30, 0.20, ranks));
    assert!(!recorded(0.5, 0.25, 12.0, 0.30, 0.20, ranks));
    assert!(!recorded(0.5, 0.25, -12.0, 0.345, 0.20, ranks));
    assert!(!recorded(0.5, 0.25, -12.0, 0.30, 0.155, ranks));
    for k in 0..4 {
        let mut other = ranks;
        other[k] += 1;
        assert!(!recorded(0.5, 0.25, -12.0, 0.30, 0.20, other), "{k}");
    }
}

/// x = 15, y = 20 cm with variances 4 and 9 and covariance 1 in 10⁻⁸ m²: along the radius
/// 0.36·4 + 0.96 + 0.64·9 = 8.16, across it 0.64·4 − 0.96 + 0.36·9 = 4.84.
#[test]
fn deviations_go_along_the_radius_and_across() {
    let covariance = [[4e-8, 1e-8], [1e-8, 9e-8]];
    let own = [(2, 0, 0.15, 0.0), (2, 1, 0.20, 0.0)];
    let inertia = recovery(&[(0, 0, 0.5, 2e-3), own[0], own[1]], 3, covariance);
    let all = [
        (0, 0, 0.51, 0.0),
        (1, 0, 0.3, 0.01),
        own[0],
        own[1],
        (3, 0, 0.2, 0.02),
    ];
    let found = recovered_centres(&inertia, &recovery(&all, 5, covariance), [3, 12]);
    let values: Vec<&str> = found.figures.iter().map(|f| f.value.as_str()).collect();
    let due = [
        "50.000 ± 0.200",
        "25.0000 ± 0.0286",
        "53.1301 ± 0.0504",
        "51.000 ± 0.000",
        "30.000 ± 1.000",
        "20.000 ± 2.000",
        "1.00",
        "190 / 2",
        "3 of 5",
        "12 of 17",
    ];
    assert_eq!(values, due);
}

#[test]
fn what_is_determined_to_less_than_a_unit_is_named() {
    let one = |parameter, alone, together| Identifiability {
        parameter,
        value: 2.0,
        alone,
        together,
    };
    let all = |across: f64, gravity: f64, mass: f64| {
        identifiability(&[
            one(Parameter::Centre(0, 1), 1e-3, across),
            one(Parameter::Centre(1, 0), 1e-3, 0.02),
            one(Parameter::Mass(3), mass, f64::INFINITY),
            one(Parameter::Gravity, 1e-3, gravity),
        ])
    };
    let found = all(0.009, 0.9, 0.5);
    assert!(found.as_recorded);
    let shown: Vec<[&str; 2]> = found
        .figures
        .iter()
        .map(|f| [&*f.name, &*f.value])
        .collect();
    let with = |text: &str| format!("{text}: alone / with all others free");
    let due = [
        (with("s2 across the link = 200.0000"), "1.00e-1 / 9.00e-1"),
        (with("s3 along the link = 200.0000"), "1.00e-1 / 2.00e0"),
        (with("m5 = 2.0000"), "5.00e-1 / not at all"),
        (with("g = 2.0000"), "1.00e-3 / 9.00e-1"),
    ];
    assert_eq!(
        shown,
        due.each_ref().map(|(name, value)| [name.as_str(), *value])
    );
    assert!(!all(0.011, 0.9, 0.5).as_recorded && !all(0.009, 1.0, 0.5).as_recorded);
    assert!(!all(0.009, 0.9, f64::INFINITY).as_recorded);
}

fn tally(variant: &'static str, column: &'static str, within: (usize, usize), worst: f64) -> Tally {
    Tally {
        variant,
        table: 2,
        column,
        entries: 49,
        within_half: within.0,
        within_one: within.1,
        worst_units: 0.0,
        worst,
    }
}

#[test]
fn units_are_told_by_the_worst_deviation() {
    let recorded = |metres: f64, printed: f64, recovered: f64| {
        let tallies = [
            tally("as_printed", "M_o", (0, 0), 5.0),
            tally("recovered", "M_o", (0, 0), 5.0),
            tally("as_printed", "I_n", (0, 0), printed),
            tally("recovered", "I_n", (0, 0), recovered),
        ];
        units_of_length(&tallies, metres).as_recorded
    };
    assert!(recorded(1.1e4, 0.19, 0.9e-3));
    assert!(!recorded(1e4, 0.19, 0.9e-3) && !recorded(0.0, 0.19, 0.9e-3));
    assert!(!recorded(1.1e4, 0.2, 0.9e-3) && !recorded(1.1e4, 0.3, 0.9e-3));
    assert!(!recorded(1.1e4, 0.19, 1e-3) && !recorded(1.1e4, 0.19, 1.5e-3));
    assert!(!units_of_length(&[], 1.1e4).as_recorded);
}

#[test]
fn no_entry_less_may_be_reproduced() {
    let recorded = |exact: (usize, usize), fitted: (usize, usize)| {
        let tallies = [
            tally("as_printed", "I_n", (1, 2), 0.0),
            tally("recovered", "I_n", (300, 300), 0.0),
            tally("recovered_fitted_nodes", "I_n", fitted, 0.0),
            tally("recovered", "M_o", (exact.0 - 300, exact.1 - 300), 0.0),
        ];
        reproduction(&tallies, &[]).as_recorded
    };
    assert!(recorded((348, 386), (418, 438)) && recorded((349, 387), (419, 439)));
    assert!(!recorded((347, 400), (430, 440)) && !recorded((360, 385), (430, 440)));
    assert!(!recorded((360, 400), (417, 440)) && !recorded((360, 400), (430, 437)));
}

#[test]
fn three_misprints_are_recorded_each_with_its_explanation() {
    use EntryVerdict::{Agrees, Misprint, Rounding, Unexplained};
    let entry = |&(table, row, column, verdict): &(u32, u32, &'static str, EntryVerdict)| Entry {
        table,
        row,
        column,
        printed: "1".into(),
        variants: [(
            "recovered_fitted_nodes",
            VariantJudgement {
                recomputed: "1.23456789012345".into(),
                units_in_last_digit: 0.0,
                verdict,
                note: None,
            },
        )]
        .into(),
    };
    let found = |of: &[(u32, u32, &'static str, EntryVerdict)]| {
        misprints(&of.iter().map(entry).collect::<Vec<_>>())
    };
    let right = [
        (2, 1, "I_n", Agrees),
        (2, 11, "S1_dI_n", Misprint),
        (3, 14, "dI_n_dphi", Misprint),
        (3, 15, "M_o", Rounding),
        (3, 41, "M_o", Misprint),
    ];
    assert!(found(&right).as_recorded);
    let figures = found(&right).figures;
    let due = "1 printed, 1.23456789… recomputed; no explanation";
    assert_eq!((figures.len(), figures[0].value.as_str()), (3, due));
    for k in [1, 2, 4] {
        let mut other = right;
        other[k].3 = Unexplained;
        assert!(!found(&other).as_recorded, "{k}");
        other[k].3 = Agrees;
        assert!(!found(&other).as_recorded, "{k}");
        other[k] = (2, 12, "I_n", Misprint);
        assert!(!found(&other).as_recorded, "{k}");
    }
    let more = [&right[..], &[(2, 12, "I_n", Misprint)]].concat();
    assert!(!found(&more).as_recorded);
}

#[test]
fn the_moment_s_nodes_are_recorded_one_by_one() {
    let errors = [
        1.4, -0.6, 4.5, 9.3, 47.6, 40.1, 0.9, 1.2, 10.0, 39.6, 14.5, 1.3,
    ];
    let found = |plant: &dyn Fn(&mut MomentResidual, &mut FittedMoment)| {
        let mut residual = MomentResidual {
            exact_mean: Ball::exact(64, 3.66e-9),
            printed_mean: 1.417e-3,
            mean_deviation: 8.3e-5,
            errors: errors.map(|e| e * 1e-4),
        };
        let mut fitted = FittedMoment {
            nodes: [0.0; 12],
            deviations: [7e-5; 12],
            worst_units: 0.49,
            left_out: vec![(Column::Moment, 41)],
        };
        plant(&mut residual, &mut fitted);
        moment(&residual, &fitted)
    };
    let right = found(&|_, _| ());
    assert!(right.as_recorded);
    for text in [
        "average 1.42e-3, 17 standard deviations",
        "all 98 entries of M_o and S'_Mo but 1",
        "within 0.49 units",
        "up to 4.8e-3 N·m",
        "12 and 36 are off by 9.3 and 39.6, rows 16 and 32 by 47.6 and 10.0",
    ] {
        assert!(right.text.contains(text), "{text}: {}", right.text);
    }
    let recorded =
        |plant: &dyn Fn(&mut MomentResidual, &mut FittedMoment)| found(plant).as_recorded;
    assert!(!recorded(&|_, f| f.worst_units = 0.5));
    assert!(!recorded(&|_, f| f.worst_units = 0.9));
    assert!(!recorded(&|_, f| f.left_out.clear()));
    assert!(!recorded(&|_, f| f.deviations[11] = 8e-5));
    assert!(!recorded(&|r, _| r.errors[11] = -1.3e-4));
    assert!(!recorded(&|r, _| r.mean_deviation = 8.4e-5));
    // The largest error of either sign.
    let text = found(&|r, _| r.errors[1] = -6e-3).text;
    assert!(text.contains("up to 6.0e-3 N·m"), "{text}");
}

/// Beside what the tables tell: an alias that is no clear one, and one that is; then a projection
/// of each kind.
#[test]
fn the_recipe_is_told_by_clear_aliases_and_all_projections() {
    let printed = printed();
    let (projections, aliases) = (
        hidden_recipe::projections(&printed),
        hidden_recipe::aliases(&printed),
    );
    let ends = [Boundary::Periodic, Boundary::NATURAL]
        .map(|ends| hidden_recipe::ends_misfit(&printed, ends));
    let recorded = |more: Option<Alias>, change: &dyn Fn(&mut Vec<hidden_recipe::Projection>)| {
        let mut projections = projections.clone();
        change(&mut projections);
        let aliases = [&aliases[..], more.as_slice()].concat();
        super::hidden_recipe(&projections, &aliases, ends).as_recorded
    };
    let alias = |column, signal, deviations| {
        Some(Alias {
            column,
            harmonic: 1,
            alias: 13,
            observed: 1.0,
            predicted: 9.0,
            deviations,
            signal,
        })
    };
    assert!(recorded(None, &|_| ()));
    assert!(recorded(alias(Column::Inertia, 20.0, 1e9), &|_| ()));
    assert!(!recorded(alias(Column::Moment, 20.1, 0.0), &|_| ()));
    let set = |nodes: usize, offset: usize, ratio: f64| {
        recorded(None, &|all| {
            let p = all
                .iter_mut()
                .find(|p| (p.nodes, p.offset) == (nodes, offset));
            p.unwrap().ratio = ratio;
        })
    };
    for (nodes, offset) in [(6, 0), (8, 0), (16, 0), (12, 1), (12, 2), (12, 3)] {
        assert!(!set(nodes, offset, 12.0), "{nodes} {offset}");
        // The least of them is one of 16 nodes.
        let least = (nodes, offset) == (16, 0);
        assert_eq!(set(nodes, offset, 1e9), !least, "{nodes} {offset}");
    }
    assert!(!set(12, 0, 2.0) && set(24, 0, 1.0) && set(24, 0, 1e3));
}

fn errors(nodes: usize, slope_at_nodes: f64, slope: f64) -> NodeErrors {
    NodeErrors {
        nodes,
        slope_at_nodes,
        slope,
        inertia: 0.0181,
        derivative: 0.0451,
        moment: 0.3043,
        moment_slope: 1.685,
    }
}

#[test]
fn the_claim_is_refuted_by_the_largest_error_of_the_rows() {
    let found = |rows: &[f64], e: NodeErrors, printed: &str| {
        let rows: Vec<Ball> = rows.iter().map(|x| Ball::exact(128, *x)).collect();
        claim_0119(&rows, &[e, errors(24, 9.0, 9.0)], (17, printed.into()))
    };
    let twelve = errors(12, 0.09, 0.10555);
    let rows = [0.01, 0.094_232_677, 0.05];
    let right = found(&rows, twelve, "-0.119");
    assert!(right.as_recorded);
    assert!(
        right.text.contains("is 0.094232677 (row 1, 21.926°)"),
        "{}",
        right.text
    );
    assert!(
        right
            .text
            .contains("0.1056 is the largest found between them"),
        "{}",
        right.text
    );
    assert!(
        right.figures[0].name.contains("(row 17)") && right.figures[1].name.contains("(row 1)")
    );
    assert!(!found(&rows, twelve, "-0.118").as_recorded);
    assert!(!found(&rows[..1], twelve, "-0.119").as_recorded);
    let plants: [fn(&mut NodeErrors); 5] = [
        |e| e.slope = 0.10556,
        |e| e.inertia = 0.0182,
        |e| e.derivative = 0.0452,
        |e| e.moment = 0.3044,
        |e| e.moment_slope = 1.686,
    ];
    for plant in plants {
        let mut other = twelve;
        plant(&mut other);
        assert!(!found(&rows, other, "-0.119").as_recorded);
    }
}

/// Quotients of the errors are powers of two: 19.8 is 2 to the 4.31.
#[test]
fn orders_are_those_of_the_errors() {
    let all = [
        errors(12, 9.372e-2, 1.056e-1),
        errors(24, 4.733e-3, 1.023e-2),
        errors(48, 2.787e-4, 1.212e-3),
        errors(96, 1.744e-5, 1.485e-4),
    ];
    let right = convergence(&all);
    assert!(right.as_recorded);
    for text in [
        "12 nodes it is 0.106",
        "1.2e-3",
        "settles at 3.0 between the nodes and 4.0 at them",
    ] {
        assert!(right.text.contains(text), "{text}: {}", right.text);
    }
    let names = right
        .figures
        .iter()
        .map(|f| f.name.split(" nodes").next().unwrap());
    let due = [
        "12",
        "24",
        "48",
        "96",
        "observed order, 12 to 24",
        "observed order, 24 to 48",
        "observed order, 48 to 96",
    ];
    assert_eq!(names.collect::<Vec<_>>(), due);
    for k in 0..4 {
        let mut other = all;
        other[k].slope *= 1.01;
        assert!(!convergence(&other).as_recorded, "{k}");
        other = all;
        other[k].slope_at_nodes *= 1.01;
        assert!(!convergence(&other).as_recorded, "{k}");
    }
}

/// e^(−0.1275665) = 0.8802: an eighth of the speed in a turn.
#[test]
fn the_conclusion_costs_speed() {
    let right = conclusion([(12, 0.255_133_026_431), (48, 0.000_262_105)]);
    assert!(right.as_recorded);
    assert!(
        right
            .text
            .contains("multiplied by 0.8802348666 every turn, a loss of 12 %"),
        "{}",
        right.text
    );
    assert!(
        right
            .text
            .contains("with 48 nodes the factor is 0.99986896"),
        "{}",
        right.text
    );
    assert!(!conclusion([(12, 0.255_133_026_441), (48, 0.000_262_105)]).as_recorded);
    assert!(!conclusion([(12, 0.255_133_026_431), (48, 0.000_262_107)]).as_recorded);
}
