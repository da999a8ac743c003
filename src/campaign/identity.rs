//! The identity of the code that computes, taken from its answers, so that no build with other
//! references, solvers or functions of the system's library takes part in a campaign unnoticed.

use super::plan::{Kind, Plan, hex};
use crate::audit::{Case, Cases, Method, ReferenceAnswer, Settings, SolverAnswer, answer_of};
use rug::Rational;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;

/// Cases of each region that are tried, and check points and hard cases of each method.
const DRAWN: u64 = 2;
const NAMED: usize = 16;

/// Digests of answers at cases of every method of a plan: check points, hard cases, and two draws
/// of each region.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Identity {
    /// The program's version.
    pub program: String,
    /// Budgets, and what the references answer: midpoints and radii in full.
    pub references: String,
    /// All inputs, and what the solvers answer, bit for bit.
    pub solvers: String,
}

impl Identity {
    /// Of this program, for that plan.
    pub fn of(plan: &Plan) -> Identity {
        let (mut references, mut solvers) = (Sha256::new(), Sha256::new());
        let methods: BTreeSet<(&str, u64, bool)> = plan
            .parts
            .iter()
            .map(|p| (p.method.as_str(), p.seed, p.kind == Kind::Candidate))
            .collect();
        for (name, seed, candidate) in methods {
            let Ok(method) = crate::resolve(name) else {
                continue;
            };
            if crate::study::is_path(name)
                && let Ok(text) = std::fs::read(crate::study::file_of(name))
            {
                references.update(Sha256::digest(&text));
            }
            let settings = Settings {
                seed,
                cases_per_region: DRAWN,
                ..Settings::default()
            };
            references.update(format!("{name} {:?}\n", method.outputs()));
            references.update(format!("{:?}\n", method.norm_budget()));
            for case in probes(&*method, &settings) {
                solvers.update(format!("{:?} ", bits(&case.input)));
                if !candidate {
                    solvers.update(answered(&answer_of(&*method, &case.input)));
                }
                references.update(reference(&*method, &case.input, settings.first_bits));
            }
            // The work is dealt by the number of cases: hard cases that are added change it.
            solvers.update(format!("{}\n", Cases::new(&*method, &settings).len()));
        }
        for part in plan.parts.iter().filter(|p| p.kind == Kind::Proof) {
            solvers.update(super::proofs::probe(part));
        }
        Identity {
            program: env!("CARGO_PKG_VERSION").into(),
            references: hex(&references.finalize()),
            solvers: hex(&solvers.finalize()),
        }
    }

    /// In what another one differs, if it does.
    pub fn differs(&self, from: &Identity) -> Option<String> {
        let short = |digest: &str| digest.get(..12).unwrap_or(digest).to_string();
        let (own, other) = (self, from);
        if own.program != other.program {
            let (own, other) = (&own.program, &other.program);
            return Some(format!(
                "it is of version {other:?}, this program of {own:?}"
            ));
        }
        let digests = [
            ("references", &own.references, &other.references),
            ("solvers or draws", &own.solvers, &other.solvers),
        ];
        let (what, own, other) = digests.into_iter().find(|(_, a, b)| a != b)?;
        let (own, other) = (short(own), short(other));
        Some(format!(
            "its {what} answered otherwise ({other}) than this program's ({own})"
        ))
    }
}

fn probes(method: &dyn Method, settings: &Settings) -> Vec<Case> {
    let cases = Cases::new(method, settings);
    let random = method.domain().regions.len() as u64 * DRAWN;
    let named = cases.len() - random as usize;
    let step = named.div_ceil(NAMED).max(1);
    let named_ones = (0..named).step_by(step);
    named_ones
        .chain(named..cases.len())
        .map(|i| cases.get(i))
        .collect()
}

fn bits(x: &[f64]) -> Vec<u64> {
    x.iter().map(|x| x.to_bits()).collect()
}

fn answered(answer: &SolverAnswer) -> String {
    match answer {
        SolverAnswer::Values(v) => format!("{:?}\n", bits(v)),
        other => format!("{:?}\n", other.refusal()),
    }
}

/// A ball by exact midpoint and radius.
fn reference(method: &dyn Method, input: &[f64], precision: u32) -> String {
    let exact: Option<Vec<Rational>> = input.iter().map(|&x| Rational::from_f64(x)).collect();
    let answer = match exact {
        Some(x) => method.reference(&x, precision),
        None => method.reference_not_finite(input),
    };
    match answer {
        ReferenceAnswer::Values(r) => format!("{:?}\n", r.values),
        ReferenceAnswer::Expected(expected, _) => format!("{expected:?}\n"),
        ReferenceAnswer::Refuses(word) => format!("refuses {word}\n"),
        ReferenceAnswer::Undecided(_) => "undecided\n".into(),
        ReferenceAnswer::Failed(_) => "failed\n".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Source;

    /// A program's own answers are not known before it runs: its inputs tell two campaigns apart.
    #[test]
    fn a_program_is_shown_the_same_inputs() {
        let of = |seed: u32| {
            let text = format!(
                "name = \"x\"\nseed = {seed}\n[[part]]\nkind = \"candidate\"\nmethods = [\"erf\"]\ncases = 1\nexec = \"true\""
            );
            Identity::of(&Plan::read(&Source::toml(&text)).unwrap())
        };
        let one = of(1);
        assert_eq!(one.differs(&of(1)), None);
        assert_ne!(one.solvers, of(2).solvers);
    }

    /// Proofs have no cases: two rectangles are proved.
    #[test]
    fn a_proof_is_known_by_its_rectangles() {
        let of = |within: f64| {
            let text = format!(
                "name = \"x\"\n[[part]]\nkind = \"proof\"\nmethods = [\"faddeeva\"]\nwithin = {within}"
            );
            Identity::of(&Plan::read(&Source::toml(&text)).unwrap())
        };
        let one = of(0.01);
        assert_eq!(one.differs(&of(0.01)), None);
        let other = of(0.02);
        assert_ne!(one.solvers, other.solvers);
        assert_eq!(one.references, other.references);
    }

    /// From the first on, evenly among what is named, and every draw.
    #[test]
    fn probes_are_a_few_of_the_named_and_all_draws() {
        for name in ["faddeeva", "four-bar", "class-iii"] {
            let method = crate::methods::find(name).unwrap();
            let settings = Settings {
                cases_per_region: DRAWN,
                ..Settings::default()
            };
            let cases = Cases::new(&*method, &settings);
            let drawn = method.domain().regions.len() * DRAWN as usize;
            let named = cases.len() - drawn;
            let found = probes(&*method, &settings);
            let some = found.len() - drawn;
            assert!(
                some <= NAMED && (2 * some > NAMED || some == named),
                "{some} of {named}"
            );
            let input = |case: &Case| bits(&case.input);
            let step = (1..).find(|step| named.div_ceil(*step) == some).unwrap();
            for (k, case) in found.iter().enumerate() {
                let expected = if k < some { k * step } else { named + k - some };
                assert_eq!(input(case), input(&cases.get(expected)), "{name} {k}");
            }
        }
    }

    /// A part of the domain without check points and hard cases has its draws alone.
    #[test]
    fn probes_of_a_region_are_its_draws() {
        let method = crate::methods::find("erf").unwrap();
        let region = crate::audit::Variant::new(&*method).region("mid").unwrap();
        let settings = Settings {
            cases_per_region: DRAWN,
            ..Settings::default()
        };
        let found = probes(&region, &settings);
        let inputs: Vec<Vec<u64>> = found.iter().map(|c| bits(&c.input)).collect();
        let cases = Cases::new(&region, &settings);
        assert_eq!(inputs, [0, 1].map(|i| bits(&cases.get(i).input)));
    }

    #[test]
    fn the_first_difference_is_told_by_its_digests() {
        let identity = |program: &str, references: &str, solvers: &str| Identity {
            program: program.into(),
            references: references.into(),
            solvers: solvers.into(),
        };
        let own = identity("1.0", "0123456789abcdef", "short");
        let said = |other: Identity| own.differs(&other);
        assert_eq!(said(own.clone()), None);
        let why = "it is of version \"2.0\", this program of \"1.0\"";
        assert_eq!(said(identity("2.0", "x", "y")).unwrap(), why);
        let why =
            "its references answered otherwise (fedcba987654) than this program's (0123456789ab)";
        assert_eq!(said(identity("1.0", "fedcba9876543210", "y")).unwrap(), why);
        let why = "its solvers or draws answered otherwise (long) than this program's (short)";
        assert_eq!(
            said(identity("1.0", "0123456789abcdef", "long")).unwrap(),
            why
        );
    }

    /// Another method, draw or number of parts is another campaign; the order of its parts is none.
    #[test]
    fn an_identity_is_of_methods_and_seeds() {
        let of = |parts: &str| {
            let text = format!("name = \"x\"\n{parts}");
            Identity::of(&Plan::read(&Source::toml(text)).unwrap())
        };
        let part = |method: &str, seed: u32| {
            format!("[[part]]\nmethods = [\"{method}\"]\nseeds = [{seed}]\ncases = 1\n")
        };
        let (a, b) = (part("erf", 1), part("slider-crank", 1));
        let one = of(&a);
        assert_eq!(one.program, env!("CARGO_PKG_VERSION"));
        assert_eq!((one.references.len(), one.solvers.len()), (64, 64));
        assert_eq!(of(&format!("{a}{b}")), of(&format!("{b}{a}")));
        assert_eq!(of(&format!("{a}{a}")), one);
        for other in [b, part("erf", 2), part("erfc", 1)] {
            let other = of(&other);
            assert!(other.references != one.references && other.solvers != one.solvers);
        }
        // A program's answers are not known: those of the method's own solver are no part of it.
        let program =
            of("[[part]]\nkind = \"candidate\"\nmethods = [\"erf\"]\ncases = 1\nexec = \"w\"");
        assert_eq!(program.references, one.references);
        assert_ne!(program.solvers, one.solvers);
    }
}
