//! What is wrong where in what is widely used, each in one sentence with a command.

use super::code::Code;
use super::{at, rounded};
use crate::audit::{Limit, Referee, Settings, SolverAnswer, Variant};
use crate::methods::find;
use mechaudit_atlas::find as find_algorithm;
use serde::Serialize;

/// A finding.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The algorithm.
    pub algorithm: &'static str,
    /// Who uses it.
    pub used_by: &'static str,
    /// In one sentence.
    pub sentence: String,
    /// The point.
    pub at: [f64; 2],
    /// The part of w.
    pub part: &'static str,
    /// What it gives there.
    pub got: f64,
    /// What is due, to 20 digits.
    pub due: String,
    /// The relative error of the part; nothing where none is a number.
    pub error: Option<f64>,
    /// A command that shows it.
    pub reproduce: String,
}

/// Algorithm, who uses it, point, part.
type Where = (&'static str, &'static str, [f64; 2], usize);

/// Found by the survey and then written down: the test computes every one anew.
const POINTS: [Where; 12] = [
    ("weideman-1994-32", "jax.scipy.special.wofz", [6.0, 0.0], 0),
    ("weideman-1994-32", "jax.scipy.special.wofz", [6.0, 1e-8], 0),
    (
        "schreier-2011-hum1wei24",
        "HAPI, the program of HITRAN's users",
        [5.0, 1e-6],
        0,
    ),
    (
        "schreier-2018-hum2zpf16",
        "astropy's Voigt1D by default",
        [6.0, 1e-6],
        0,
    ),
    (
        "humlicek-1982",
        "w4, in line-by-line codes",
        [5.4, 1e-6],
        0,
    ),
    (
        "hui-armstrong-wray-1978",
        "SIR and solar inversion codes",
        [5.0, 1e-3],
        0,
    ),
    (
        "cernlib-wwerf",
        "MAD-X, SixTrack, PyHEADTAIL",
        [5.0, 0.0],
        0,
    ),
    (
        "poppe-wijers-1990",
        "Algorithm 680, in many plasma codes",
        [6.0, 1e-10],
        0,
    ),
    (
        "karbach-raven-schiller-2014-fast",
        "RooFit's faddeeva_fast",
        [6.0, 1e-6],
        0,
    ),
    (
        "karbach-raven-schiller-2014",
        "RooFit's faddeeva",
        [6.0, 1e-8],
        0,
    ),
    (
        "zaghloul-ali-2011",
        "Algorithm 916, the base of the MIT package",
        [28.0, 1e-3],
        0,
    ),
    (
        "thompson-cox-hastings-1987",
        "the peak shape of Rietveld refinement",
        [5.0, 0.01],
        0,
    ),
];

/// Those about algorithms that are asked for.
pub fn findings(asked: &dyn Fn(&str) -> bool) -> Vec<Finding> {
    let chosen = POINTS.iter().filter(|p| asked(p.0));
    chosen.filter_map(found).collect()
}

fn found((name, used_by, z, part): &Where) -> Option<Finding> {
    let algorithm = find_algorithm(name)?;
    let method = find("faddeeva")?;
    let variant = Variant::new(&*method).limit(Limit::Relative(1e-300));
    let settings = Settings::default();
    let w = (algorithm.w)(num_complex::Complex::new(z[0], z[1]));
    let mut referee = Referee::new(&variant, at("faddeeva", z), &settings);
    let report = referee.judge(SolverAnswer::Values(vec![w.re, w.im]), true);
    let got = [w.re, w.im][*part];
    let due = report.reference.get(*part)?.clone()?;
    let error = report.judgement.components.get(*part)?.of_budget * 1e-300;
    let error = error.is_finite().then(|| rounded(error));
    let word = ["Re W", "Im W"][*part];
    let short: f64 = due.parse().ok()?;
    let place = match z[1] {
        0.0 => format!("{}", z[0]),
        y => format!("{} + {y:e}i", z[0]),
    };
    let size = match error {
        Some(e) if got.is_sign_negative() != short.is_sign_negative() => {
            format!("of the wrong sign, {e:.1e} times the value off")
        }
        Some(e) => format!("a relative error of {e:.1e}"),
        None => "no number".into(),
    };
    Some(Finding {
        algorithm: algorithm.name,
        used_by,
        sentence: format!(
            "{name} ({used_by}) gives {word}({place}) = {got:.3e}, where {short:.3e} is due: {size}."
        ),
        at: *z,
        part: word,
        got,
        due,
        error,
        reproduce: format!("mechaudit {}", Code::double(algorithm).at(*z)),
    })
}
