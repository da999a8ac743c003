//! Findings about code that is widely used, each in one sentence with a command.

use super::code;
use super::decide::Subject;
use super::{at, rounded};
use crate::audit::{Judge, Limit, Settings, SolverAnswer, Variant};
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
    pub at: Vec<f64>,
    /// The part of w.
    pub part: &'static str,
    /// Holds what it gives there.
    pub got: f64,
    /// Holds what is due, to 20 digits.
    pub due: String,
    /// The relative error of the part; nothing where none is a number.
    pub error: Option<f64>,
    /// A command that shows it.
    pub reproduce: String,
}

/// Algorithm, who uses it, point, part.
type Where = (&'static str, &'static str, &'static [f64], usize);

/// Found by the survey and then written down: the test computes every one anew.
const POINTS: [Where; 18] = [
    ("weideman-1994-32", "jax.scipy.special.wofz", &[6.0, 0.0], 0),
    (
        "weideman-1994-32",
        "jax.scipy.special.wofz",
        &[6.0, 1e-8],
        0,
    ),
    (
        "schreier-2011-hum1wei24",
        "the default of HAPI, HITRAN's own program",
        &[4.5, 1e-6],
        0,
    ),
    (
        "schreier-2011-hum1wei24",
        "the default of HAPI, HITRAN's own program",
        &[5.5, 1e-8],
        0,
    ),
    (
        "schreier-2018-hum2zpf16",
        "astropy's Voigt1D, method Humlicek2, said to be within 3e-5",
        &[5.5, 1e-8],
        0,
    ),
    (
        "mclean-1994",
        "spectrum fitting; astropy's Voigt1D of former releases",
        &[4.5, 1e-6],
        0,
    ),
    (
        "karbach-raven-schiller-2014-fast",
        "RooFit's faddeeva_fast",
        &[4.5, 1e-6],
        0,
    ),
    (
        "karbach-raven-schiller-2014",
        "RooFit's faddeeva",
        &[5.0, 0.0],
        0,
    ),
    (
        "humlicek-1982",
        "w4, the usual choice of line-by-line codes",
        &[5.5, 1e-12],
        0,
    ),
    (
        "hui-armstrong-wray-1978",
        "SIR and other codes of solar physics",
        &[4.5, 1e-6],
        0,
    ),
    (
        "cernlib-wwerf",
        "MAD-X, SixTrack, PyHEADTAIL",
        &[5.0, 0.0],
        0,
    ),
    (
        "poppe-wijers-1990",
        "algorithm 680, WOFZ of plasma codes",
        &[6.2, 1e-12],
        0,
    ),
    (
        "zaghloul-ali-2011",
        "algorithm 916 by itself, without the continued fraction that the MIT package and libcerf put around it",
        &[10000000000.0, 1.0],
        0,
    ),
    (
        "wells-1999-r4",
        "HUMLIK of line-by-line codes",
        &[150.0, 0.0],
        1,
    ),
    (
        "thompson-cox-hastings-1987",
        "the peak shape of Rietveld refinement",
        &[10.0, 1e-6],
        0,
    ),
    (
        "matta-reichel-1971",
        "programs for stellar spectra, as Eriksson's HH",
        &[2.0, 1e-9],
        0,
    ),
    (
        "hapi-pcqsdhc",
        "the Hartmann-Tran profile of HAPI, Gamma_D = 0.01, Gamma_0 = 0.3, Gamma_2 = 0.06",
        &[0.01, 0.3, 0.06, 0.0, 0.0, 0.0, 0.0, 6.8],
        0,
    ),
    (
        "hapi-pcqsdhc",
        "the same line",
        &[0.01, 0.3, 0.06, 0.0, 0.0, 0.0, 0.0, 7.0],
        0,
    ),
];

/// An exponent only where it is needed.
fn plain(x: f64) -> String {
    match (1e-3..1e6).contains(&x.abs()) {
        true => format!("{x}"),
        false => format!("{x:e}"),
    }
}

/// Those about algorithms that are asked for.
pub fn findings(asked: &dyn Fn(&str) -> bool) -> Vec<Finding> {
    let chosen = POINTS.iter().filter(|p| asked(p.0));
    chosen.filter_map(found).collect()
}

fn found((name, used_by, z, part): &Where) -> Option<Finding> {
    let subject = Subject::of(name)?;
    let method = subject.method();
    let variant = Variant::new(&*method).limit(Limit::Relative(1e-300));
    let settings = Settings::default();
    let answer = subject.answer(z);
    let got = match &answer {
        SolverAnswer::Values(values) => *values.get(*part)?,
        _ => return None,
    };
    let answer = match answer {
        // A real part alone is judged with nothing beside it.
        SolverAnswer::Values(values) if values.len() == 1 => {
            SolverAnswer::Values(vec![values[0], f64::NAN])
        }
        other => other,
    };
    let judge = Judge::new(&variant, &settings);
    let report = judge.judge(at(method.name(), z), answer, true);
    let due = report.reference.get(*part)?.clone()?;
    let error = report.judgement.components.get(*part)?.of_budget * 1e-300;
    let error = error.is_finite().then(|| rounded(error));
    let word = method.outputs().get(*part)?.name;
    let short: f64 = due.parse().ok()?;
    let place = match z[..] {
        [x, 0.0] => plain(x),
        [x, y] => format!("{} + {}i", plain(x), plain(y)),
        _ => format!("detuning {}", plain(*z.last()?)),
    };
    let size = match error {
        Some(e) if got.is_sign_negative() != short.is_sign_negative() => {
            format!("of the wrong sign, {e:.1e} times the value off")
        }
        Some(e) => format!("a relative error of {e:.1e}"),
        None => "no number".into(),
    };
    Some(Finding {
        algorithm: name,
        used_by,
        sentence: format!(
            "{name} ({used_by}) gives {word}({place}) = {got:.3e}, where {short:.3e} is due: {size}."
        ),
        at: z.to_vec(),
        part: word,
        got,
        due,
        error,
        reproduce: format!("mechaudit {}", code::at(name, z)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_finding_is_one() {
        let found = findings(&|_| true);
        assert_eq!(found.len(), POINTS.len());
        for f in &found {
            // No number, or far beyond what the algorithm is taken for.
            assert!(f.error.is_none_or(|e| e > 2e-7), "{}", f.sentence);
        }
        let six = &found[0];
        assert!(
            six.got < -2.5e-14 && six.due.starts_with("2.3195228302435"),
            "{six:?}"
        );
        assert!(six.sentence.contains("of the wrong sign"));
        let book = include_str!("../book/atlas.md");
        assert!(found.iter().all(|f| book.contains(&f.sentence)));
        let none = findings(&|name| name == "hunter-regan-1972");
        assert!(none.is_empty());
    }

    #[test]
    fn numbers_of_common_size_have_no_exponent() {
        for (x, text) in [
            (0.001, "0.001"),
            (0.0015, "0.0015"),
            (9.99e-4, "9.99e-4"),
            (999_999.0, "999999"),
            (1e6, "1e6"),
            (1.5e6, "1.5e6"),
            (-4.5, "-4.5"),
            (1e-12, "1e-12"),
        ] {
            assert_eq!(plain(x), text);
        }
    }
}
