//! Findings about the input data.

use crate::papers::zinchenko::recovery::{Estimate, Identifiability, Parameter, Recovery};
use crate::papers::{Draft, Finding, FindingVerdict, Subject, Tally, figure, figures};

fn cm(e: &Estimate) -> String {
    format!("{:.3} ± {:.3}", e.value * 100.0, e.deviation * 100.0)
}

/// Returns true if a value is less than four standard deviations off.
fn inside(value: f64, due: f64, sd: f64) -> bool {
    (value - due).abs() < 4.0 * sd
}

/// The centres of mass.
pub(in crate::papers::zinchenko) fn recovered_centres(
    inertia: &Recovery,
    all: &Recovery,
    ranks: [usize; 2],
) -> Finding {
    let centre = |r: &Recovery, i, k| r.get(Parameter::Centre(i, k)).clone();
    let (x, y) = (centre(inertia, 2, 0), centre(inertia, 2, 1));
    let (radius, angle) = (x.value.hypot(y.value), y.value.atan2(x.value));
    // First-order propagation; x and y enter as the unit vector along the radius and across it.
    let at = |p: Parameter| {
        inertia
            .estimates
            .iter()
            .position(|e| e.parameter == p)
            .expect("fitted")
    };
    let (ix, iy) = (at(Parameter::Centre(2, 0)), at(Parameter::Centre(2, 1)));
    let variance = |u: f64, v: f64| {
        let c = &inertia.covariance;
        u * u * c[(ix, ix)] + 2.0 * u * v * c[(ix, iy)] + v * v * c[(iy, iy)]
    };
    let (c, s) = (angle.cos(), angle.sin());
    let radius_sd = variance(c, s).sqrt();
    let angle_sd = variance(-s, c).sqrt() / radius;
    let s2 = centre(inertia, 0, 0);
    let (s3, s5) = (centre(all, 1, 0), centre(all, 3, 0));
    Draft::new("centres-of-mass", Subject::Data, "results, l_S2 … l_S5")
        .verdict(FindingVerdict::Recovered)
        .titled("The printed centres of mass do not belong to the printed tables")
        .text(format!(
            "Least squares from the printed data, each entry weighted by its rounding. The columns \
             of I_n alone determine s2 = {} cm (printed 55.12) and the centre of the sieve at {:.3} \
             ± {:.3} cm, {:.3} ± {:.3}° from C–D (printed 5.5 cm at −39.3°); s3 and s5 leave no \
             trace in them. The columns of M_o add s3 = {} cm (printed 18) and s5 = {} cm (printed \
             9.7), two digits at best, because M_o carries an error of its own and weights are \
             raised to its size. Round values within these: 50, 25 at −12°, 30 and 20 cm. The last \
             two are the round choice, not a proof.",
            cm(&s2),
            radius * 100.0,
            radius_sd * 100.0,
            angle.to_degrees(),
            angle_sd.to_degrees(),
            cm(&s3),
            cm(&s5),
        ))
        .figures(figures! {
            "s2 (I_n columns)": "{}", cm(&s2) => "cm";
            "r4 (I_n columns)": "{:.4} ± {:.4}", radius * 100.0, radius_sd * 100.0 => "cm";
            "angle of r4 (I_n columns)":
                "{:.4} ± {:.4}", angle.to_degrees(), angle_sd.to_degrees() => "deg";
            "s2 (with M_o)": "{}", cm(&centre(all, 0, 0)) => "cm";
            "s3 (with M_o)": "{}", cm(&s3) => "cm";
            "s5 (with M_o)": "{}", cm(&s5) => "cm";
            "misfit of the I_n columns over rounding": "{:.2}", inertia.misfit => "1";
            "entries used / left out as misprints (I_n columns)":
                "{} / {}", inertia.used, inertia.left_out => "entries";
            "rank of s2, s3, s4x, s4y, s5 in the I_n columns": "{} of 5", ranks[0] => "1";
            "rank of all 17 mass parameters in all columns": "{} of 17", ranks[1] => "1";
        })
        .recorded_if(inside(s2.value, 0.5, s2.deviation)
            && inside(radius, 0.25, radius_sd)
            && inside(angle.to_degrees(), -12.0, angle_sd.to_degrees())
            && inside(s3.value, 0.30, s3.deviation)
            && inside(s5.value, 0.20, s5.deviation)
            && ranks == [3, 12]
            && (inertia.rank, all.rank) == (3, 5))
}

/// Which parameters the tables determine.
pub(in crate::papers::zinchenko) fn identifiability(found: &[Identifiability]) -> Finding {
    let figures = found.iter().map(|i| {
        let (unit, per_si) = i.parameter.shown_unit();
        let deviation = |x: f64| match x.is_finite() {
            true => format!("{:.2e}", x * per_si),
            false => "not at all".into(),
        };
        let (name, value) = (i.parameter.name(), i.value * per_si);
        let name = format!("{name} = {value:.4}: alone / with all others free");
        let both = format!("{} / {}", deviation(i.alone), deviation(i.together));
        figure(name, both, unit)
    });
    let alone = found.iter().filter(|i| i.alone.is_finite()).count();
    // Within one of the units shown; a standard deviation of metres determines nothing.
    let together: Vec<String> = found
        .iter()
        .filter(|i| i.together * i.parameter.shown_unit().1 < 1.0)
        .map(|i| i.parameter.name())
        .collect();
    Draft::new("identifiability", Subject::Data, "results, masses and inertias")
        .verdict(FindingVerdict::Recovered)
        .titled(format!(
            "{alone} of {} mass parameters leave a trace in the tables, but with all of them free only {} stay determined",
            found.len(),
            together.join(" and "),
        ))
        .text(
            "Standard deviations of each mass, inertia, centre of mass and of g, at the recovered \
             values: first with all the others taken as known, then with all of them free. Entries \
             are weighted by rounding, those of M_o by their own larger error. What is \"not at all\" \
             determined can be traded against others without a trace in the tables: only the \
             printed masses and inertias, taken as given, make the centres of mass identifiable.",
        )
        .figures(figures)
        .recorded_if(alone == found.len() && together == ["s2 across the link", "g"])
}

/// Units.
pub(in crate::papers::zinchenko) fn units_of_length(
    tallies: &[Tally],
    in_metres_worst: f64,
) -> Finding {
    let worst = |v: &str| {
        let t = tallies.iter().find(|t| t.variant == v && t.column == "I_n");
        t.map_or(f64::NAN, |t| t.worst)
    };
    let printed = worst("as_printed");
    Draft::new("unit-of-length", Subject::Data, "results, dimensions")
        .verdict(FindingVerdict::ErrorOfPaper)
        .titled("Lengths are in centimetres, masses in kg, inertias in kg·m²: (4) needs a factor 10⁻⁴")
        .text(format!(
            "No unit is printed. Put into (4) as they stand, the numbers give an I_n that is off by \
             {in_metres_worst:.1e} kg·m² against a printed range of 0.03 to 5.63; with lengths in \
             centimetres the largest deviation is {printed:.3} with the printed centres of mass and \
             {:.1e} with the recovered ones.",
            worst("recovered"),
        ))
        .figures(figures! {
            "worst |I_n| deviation, lengths in m": "{in_metres_worst:.2e}" => "kg m^2";
            "worst |I_n| deviation, cm, printed centres": "{printed:.4}" => "kg m^2";
            "worst |I_n| deviation, cm, recovered centres":
                "{:.2e}", worst("recovered") => "kg m^2";
        })
        .recorded_if(in_metres_worst > 1e4 && printed < 0.2 && worst("recovered") < 1e-3)
}

#[cfg(test)]
mod tests {
    use super::inside;

    #[test]
    fn four_deviations_are_too_far() {
        assert!(inside(3.5, 2.0, 0.5) && inside(0.5, 2.0, 0.5));
        assert!(!inside(4.0, 2.0, 0.5) && !inside(0.0, 2.0, 0.5));
    }
}
