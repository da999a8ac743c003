//! Findings about the claim and the conclusion.

use crate::papers::zinchenko::derivative_claim::{FINE, NodeErrors, degrees};
use crate::papers::{Draft, Finding, FindingVerdict, Subject, figures, shown};
use crate::reference::Ball;

/// The claim of 0.119.
pub(in crate::papers::zinchenko) fn claim_0119(
    true_errors: &[Ball],
    errors: &[NodeErrors],
    (row, difference): (usize, String),
) -> Finding {
    let worst = (0..true_errors.len())
        .max_by(|&a, &b| {
            true_errors[a]
                .mid()
                .partial_cmp(true_errors[b].mid())
                .expect("finite")
        })
        .expect("rows");
    let value = shown(&true_errors[worst], 8);
    let e12 = errors[0];
    let figures = figures! {
        "largest printed difference (row {row})": "{difference}" => "kg m^2";
        "largest true error on the rows (row {worst}), certified": "{value}" => "kg m^2";
        "worst found between rows, S'_In": "{:.5}", e12.slope => "kg m^2";
        "worst found, I_n column": "{:.4}", e12.inertia => "kg m^2";
        "worst found, dI_n/dphi column": "{:.4}", e12.derivative => "kg m^2";
        "worst found, M_o column": "{:.4}", e12.moment => "N m";
        "worst found, S'_Mo column": "{:.3}", e12.moment_slope => "N m";
    };
    Draft::new("claim-0.119", Subject::Claim, "results, last paragraph")
        .verdict(FindingVerdict::Refuted)
        .titled("0.119 is not the error of S'_In: it compares one spline with another")
        .text(format!(
            "The column headed dI_n/dφ is itself a spline through 12 exact values, so Table 3 \
             subtracts a spline's derivative from a spline of the derivative. Against the exact \
             derivative the largest error on the 49 rows is {value} (row {worst}, {:.3}°), and \
             {:.4} is the largest found between them. The \"exact\" columns are off themselves, by \
             up to {:.3} in I_n, {:.3} in dI_n/dφ, {:.3} in M_o and {:.2} in S'_Mo.",
            degrees(worst),
            e12.slope,
            e12.inertia,
            e12.derivative,
            e12.moment,
            e12.moment_slope,
        ))
        .figures(figures)
        .recorded(&[
            "-0.119",
            "0.094232677",
            "0.10555",
            "0.0181",
            "0.0451",
            "0.3043",
            "1.685",
        ])
}

/// Convergence with the number of nodes.
pub(in crate::papers::zinchenko) fn convergence(errors: &[NodeErrors]) -> Finding {
    let order = |a: f64, b: f64| (a / b).log2();
    let mut figures = Vec::new();
    for e in errors {
        let nodes = e.nodes;
        figures.extend(figures! {
            "{nodes} nodes: worst |S'_In - dI_n/dphi| at the nodes / anywhere":
                "{:.3e} / {:.3e}", e.slope_at_nodes, e.slope => "kg m^2";
        });
    }
    let (mut at_nodes, mut between) = (f64::NAN, f64::NAN);
    for w in errors.windows(2) {
        let [from, to] = [w[0].nodes, w[1].nodes];
        at_nodes = order(w[0].slope_at_nodes, w[1].slope_at_nodes);
        between = order(w[0].slope, w[1].slope);
        figures.extend(figures! {
            "observed order, {from} to {to} nodes: at the nodes / anywhere":
                "{at_nodes:.2} / {between:.2}" => "1";
        });
    }
    Draft::new("convergence", Subject::Claim, "conclusions")
        .verdict(FindingVerdict::Refuted)
        .titled("Twelve nodes are too few: the derivative's error falls with the third power of the step")
        .text(format!(
            "Errors of the derivative of the spline of I_n, worst of {FINE} crank angles a turn. \
             With 12 nodes it is {:.3}, with 48 nodes (one for each printed row) {:.1e}. The \
             observed order settles at {between:.1} between the nodes and {at_nodes:.1} at them \
             (the theory of cubic splines: 3 and 4).",
            errors[0].slope, errors[2].slope,
        ))
        .figures(figures)
        .recorded(&[
                "9.372e-2 / 1.056e-1",
                "4.733e-3 / 1.023e-2",
                "2.787e-4 / 1.212e-3",
                "1.744e-5 / 1.485e-4",
                "4.31 / 3.37",
                "4.09 / 3.08",
                "4.00 / 3.03",
            ])
}

/// The conclusion of the paper.
pub(in crate::papers::zinchenko) fn conclusion(hybrid: [(usize, f64); 2]) -> Finding {
    let factor = |i: f64| (-0.5 * i).exp();
    let [(_, i12), (_, i48)] = hybrid;
    let figures = figures! {
        "closed integral of S'_In/I_n, 12 nodes": "{i12:.12}" => "1";
        "omega after a free turn, 12 nodes": "{:.10}", factor(i12) => "of omega";
        "closed integral of S'_In/I_n, 48 nodes": "{i48:.9}" => "1";
        "omega after a free turn, 48 nodes": "{:.8}", factor(i48) => "of omega";
    };
    Draft::new("conclusion", Subject::Claim, "conclusions")
        .verdict(FindingVerdict::Refuted)
        .titled("Leaving out the exact derivative is not safe with 12 nodes")
        .text(format!(
            "The paper concludes that dI_n/dφ need not be computed: the spline's derivative will \
             do beside the exact I_n. In free motion ½ I_n ω² is constant. With S'_In from 12 nodes \
             and the exact I_n it is not: ω is multiplied by {:.10} every turn, a loss of {:.0} % \
             that no friction caused; with 48 nodes the factor is {:.8}. Using the spline for both \
             keeps the energy. Little is saved anyway: the accelerations share the matrix of the \
             velocities, so with the factors at hand they cost one back-substitution.",
            factor(i12),
            100.0 * (1.0 - factor(i12)),
            factor(i48),
        ))
        .figures(figures)
        .recorded(&[
                "0.255133026431",
                "0.8802348666",
                "0.000262105",
                "0.99986896",
            ])
}
