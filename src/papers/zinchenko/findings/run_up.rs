//! Findings about the motion that the tables were made for.

use crate::papers::zinchenko::run_up::{Against, Figures, MOMENTS, ROTOR, SYNCHRONOUS};
use crate::papers::{Draft, Figure, Finding, FindingVerdict, Subject, figure, figures};

/// The verdict on leaving out the exact derivative, as the motion sees it.
pub(in crate::papers::zinchenko) fn run_up(f: Option<&Figures>) -> Vec<Finding> {
    match f {
        Some(f) => vec![under_a_motor(f), in_free_motion(f), the_saving(f)],
        None => vec![
            Draft::new("run-up", Subject::Claim, "conclusions")
                .verdict(FindingVerdict::Unexplained)
                .titled("The motion could not be computed")
                .text(
                    "One of the motions with exact coefficients, splines or both did not come to \
                     its end.",
                )
                .recorded_if(false),
        ],
    }
}

/// Both ways, by number of nodes.
fn each(f: &Figures) -> impl Iterator<Item = (&'static str, &Against)> {
    let pairs = f.splines.iter().map(|a| ("spline pair", a));
    pairs.chain(f.hybrids.iter().map(|a| ("exact I_n with S'", a)))
}

fn named(
    f: &Figures,
    what: &str,
    unit: &'static str,
    value: impl Fn(&Against) -> String,
) -> Vec<Figure> {
    each(f)
        .map(|(way, a)| figure(format!("{what}, {way}, {} nodes", a.nodes), value(a), unit))
        .collect()
}

fn under_a_motor(f: &Figures) -> Finding {
    let [h12, h48] = f.hybrids;
    let [bare, rotor] = f.start_times.map(|t| 1e3 * t);
    let percent = |a: &Against| 100.0 * a.run_up.max(a.steady) / SYNCHRONOUS;
    let mut figures = figures! {
        "mean speed of the steady cycle, exact": "{:.6}", f.exact.mean => "rad/s";
        "least and largest speed, exact":
            "{:.4}, {:.4}", f.exact.least.0, f.exact.most.0 => "rad/s";
        "coefficient of fluctuation, exact": "{:.6}", f.exact.fluctuation => "1";
    };
    figures.extend(named(
        f,
        "worst difference of the speed found, t < 0.7 s / t > 2 s",
        "rad/s",
        |a| format!("{:.3e} / {:.3e}", a.run_up, a.steady),
    ));
    figures.extend(named(f, "period less the exact one", "s", |a| {
        format!("{:+.2e}", a.period)
    }));
    figures.extend(named(
        f,
        "coefficient of fluctuation less the exact one",
        "1",
        |a| format!("{:+.2e}", a.fluctuation),
    ));
    figures.extend(figures! {
        "time to 9.5 rad/s, I_1 = 0": "{bare:.4}" => "ms";
        "time to 9.5 rad/s, I_1 = {ROTOR} kg·m²": "{rotor:.3}" => "ms";
    });
    Draft::new("run-up-motor", Subject::Claim, "(1), (2); conclusions")
        .verdict(FindingVerdict::Confirmed)
        .titled("Under a stiff motor the missing derivative hardly shows: the paper's conclusion holds there")
        .text(format!(
            "Equations (1) and (2) with an induction motor at the crank (the paper names none; \
             here ω_c = {SYNCHRONOUS} rad/s, M_n = 200 N·m, k = 2.2, s_n = 0.05), from rest at row 0 \
             over 3 s, compared at {MOMENTS} moments. With the exact I_n and S'_In from 12 nodes \
             the speed is off by at most {:.2} % of ω_c, with 48 nodes by {:.4} %: the torque \
             of the motor holds the speed, whatever the coefficients. It pays for the wrong \
             derivative: in the steady cycle weights and kinetic energy come round and the motor's \
             work should be zero; with 12 nodes it is {:.4} J in every turn, with 48 \
             {:.6} J. Row 0 is a dead position with I_n = 0.034 kg·m², and I_1 is 0 in the paper, so \
             9.5 rad/s are reached in {bare:.2} ms; the rotor that it leaves out, some {ROTOR} kg·m² \
             at the crank (an estimate for a small four-pole motor), makes that {rotor:.0} ms.",
            percent(&h12),
            percent(&h48),
            h12.work,
            h48.work,
        ))
        .figures(figures)
        .recorded_if((1.1e-2..1.3e-2).contains(&h12.run_up)
            && (1.1e-2..1.3e-2).contains(&h12.steady)
            && h48.run_up.max(h48.steady) < 2e-4
            && f.exact.work[0].abs() < 1e-8
            && format!("{:.5} {:.5}", h12.work, f.exact.fluctuation) == "0.19983 0.14103"
            && format!("{bare:.1} {rotor:.0}") == "1.2 54")
}

fn in_free_motion(f: &Figures) -> Finding {
    let [s12, s48] = f.splines;
    let [h12, h48] = f.hybrids;
    let lost = |a: &Against| 100.0 * (1.0 - a.free * a.free);
    let shown = [f.exact_free, s12.free, s48.free, h12.free, h48.free].map(|x| format!("{x:.9}"));
    let mut figures = figures! {
        "speed after a free turn, exact coefficients":
            "{:.10}", f.exact_free => "of the speed before";
    };
    figures.extend(named(
        f,
        "speed after a free turn",
        "of the speed before",
        |a| format!("{:.10}", a.free),
    ));
    for a in &f.splines {
        let nodes = a.nodes;
        figures.extend(figures! {
            "worst difference during a free turn found, spline pair, {nodes} nodes":
                "{:.5}", a.within => "of the speed";
        });
    }
    Draft::new("run-up-free", Subject::Claim, "conclusions")
        .verdict(FindingVerdict::Refuted)
        .titled("In free motion the paper's mixture destroys energy; one spline for both does not")
        .text(format!(
            "The equation of motion integrated over a turn without motor and weights, where \
             ½ I_n ω² is constant. The exact I_n with S'_In from 12 nodes, the paper's \
             recommendation, loses {:.2} % of the energy in a turn (ω is multiplied by {:.10}), \
             with 48 nodes {:.4} %. I_n and dI_n/dφ from the same spline lose nothing at any number \
             of nodes; the speed on the way is off by up to {:.2} % with 12 nodes and {:.3} % with \
             48, because the spline's I_n is. So: either keep (5), or take both from one spline \
             with 48 nodes or more.",
            lost(&h12),
            h12.free,
            lost(&h48),
            100.0 * s12.within,
            100.0 * s48.within,
        ))
        .figures(figures)
        .recorded_if(shown
            == [
                "1.000000000",
                "1.000000000",
                "1.000000000",
                "0.880234867",
                "0.999868956",
            ])
}

fn the_saving(f: &Figures) -> Finding {
    let [h12, h48] = f.hybrids;
    let more = |a: &Against| 100.0 * (a.evaluations as f64 / f.exact_evaluations as f64 - 1.0);
    let mut figures = figures! {
        "evaluations of (1), exact": "{}", f.exact_evaluations => "1";
    };
    figures.extend(named(f, "evaluations of (1)", "1", |a| {
        a.evaluations.to_string()
    }));
    Draft::new("run-up-cost", Subject::Claim, "conclusions")
        .verdict(FindingVerdict::Refuted)
        .titled("Leaving out the exact derivative saves no time in the run-up")
        .text(format!(
            "The accelerations have the matrix of the velocities: with its factors at hand they \
             cost one back-substitution more (`cargo bench --bench run_up` measures it beside the \
             positions, velocities and sums that stay). And S'_In is not smooth: a step has to end \
             at every node, so for the same 3 s at the same tolerance the mixture takes {:.0} % more \
             evaluations with 12 nodes and {:.0} % more with 48 than the exact coefficients do. What \
             saves time is to take I_n, its derivative and M_o all from splines and to leave the \
             linkage out of the integration, and that keeps the energy too.",
            more(&h12),
            more(&h48),
        ))
        .figures(figures)
        .recorded_if(more(&h12) > 5.0 && more(&h48) > 20.0)
}
