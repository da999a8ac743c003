//! The values that symbols may have.
//!
//! The algebra proves for positive symbols. A symbol that may be negative or zero is therefore
//! treated case by case: a requirement is proved if it is proved with `x`, with `-x` and with `0`
//! in the place of `x`, and refuted if it is refuted at a point of the domain.

use super::Requirement;
use super::boxes::{Function, Region};
use crate::{Definitions, Expr, Identity, Outcome, Point, SymbolicError, Witness};
use rug::Rational;
use std::collections::BTreeMap;

/// The values of a symbol, where it is not any positive number.
#[derive(Clone, Debug, PartialEq)]
pub enum Domain {
    /// Every real number.
    Real,
    /// Every positive integer.
    Integer,
    /// The numbers between two ends, which belong to them.
    Between(Rational, Rational),
}

/// The domains of symbols, and the values that are put in for others.
#[derive(Clone, Debug, Default)]
pub struct Conditions {
    /// Symbols that are not simply positive.
    pub domains: BTreeMap<String, Domain>,
    /// Symbols with a value.
    pub values: BTreeMap<String, Expr>,
}

/// A part of a domain on which a symbol keeps its sign.
#[derive(Clone, Debug)]
enum Part {
    Zero,
    /// Positive, or negative, with a magnitude between two numbers; without an upper end if none.
    Signed(bool, Rational, Option<Rational>),
    Integer,
}

impl Domain {
    fn parts(&self) -> Vec<Part> {
        let zero = Rational::new();
        match self {
            Domain::Real => vec![
                Part::Signed(false, zero.clone(), None),
                Part::Signed(true, zero, None),
                Part::Zero,
            ],
            Domain::Integer => vec![Part::Integer],
            Domain::Between(a, b) => {
                let mut parts = Vec::new();
                if *b > 0 {
                    let low = a.clone().max(zero.clone());
                    parts.push(Part::Signed(false, low, Some(b.clone())));
                }
                if *a < 0 {
                    let low = (-b.clone()).max(zero.clone());
                    parts.push(Part::Signed(true, low, Some(-a.clone())));
                }
                if *a <= 0 && *b >= 0 {
                    parts.push(Part::Zero);
                }
                parts
            }
        }
    }
}

impl Part {
    /// The magnitude at which a requirement is tried, by the number of the sample; none of zero.
    fn sample(&self, name: &str, turn: u32) -> Option<Rational> {
        let sample = || Point::sample(turn).value(name).ok();
        match self {
            Part::Zero => None,
            Part::Integer => Some((sample()? * 4u32).ceil()),
            Part::Signed(_, _, None) => sample(),
            Part::Signed(_, low, Some(high)) => {
                let x = sample()?;
                let share = &x / Rational::from(&x + 1);
                Some(Rational::from(high - low) * share + low)
            }
        }
    }

    /// The expression in the place of the symbol.
    fn in_place(&self, name: &str) -> Option<Expr> {
        match self {
            Part::Zero => Some(Expr::Num("0".into())),
            Part::Signed(true, ..) => Some(Expr::Neg(Box::new(Expr::Sym(name.into())))),
            Part::Signed(false, ..) | Part::Integer => None,
        }
    }
}

/// The largest number of cases that a requirement is divided into.
const MOST_CASES: usize = 243;
/// Samples at which each case is tried; the last ones are larger and smaller.
const TURNS: [u32; 4] = [0, 1, 4, 5];

impl Conditions {
    /// Returns true if every symbol is any positive number.
    pub fn is_empty(&self) -> bool {
        self.domains.is_empty() && self.values.is_empty()
    }

    /// The point at which candidates of a repair are tried first; none where symbols have values or
    /// are not positive.
    pub fn first_point(&self) -> Option<Point> {
        let mut point = Point::sample(0);
        for (name, domain) in &self.domains {
            let parts = domain.parts();
            let part = parts.first().filter(|p| p.in_place(name).is_none())?;
            if let Some(value) = part.sample(name, 0) {
                point.named.insert(name.clone(), value);
            }
        }
        self.values.is_empty().then_some(point)
    }

    /// Decides a requirement under these conditions.
    pub fn decide(&self, r: &Requirement, definitions: &Definitions) -> Identity {
        if self.is_empty() {
            return r.decide(definitions, &BTreeMap::new());
        }
        // A definition takes the place of a symbol of the same name.
        let is_free = |name: &str| !definitions.names.contains_key(name);
        let used =
            |name: &str| is_free(name) && r.sides().iter().any(|e| definitions.reaches(e, &[name]));
        let values = self.values.iter().filter(|(name, _)| used(name));
        let r = values.fold(r.clone(), |r, (name, value)| r.at(name, value));
        let free: Vec<(&String, &Domain)> = self
            .domains
            .iter()
            .filter(|(name, _)| !self.values.contains_key(*name) && used(name))
            .collect();
        let mut cases: Vec<Vec<(&String, Part)>> = vec![Vec::new()];
        for (name, domain) in &free {
            let parts = domain.parts();
            if cases.len() * parts.len() > MOST_CASES {
                return open(format!("more than {MOST_CASES} cases of signs"));
            }
            let mut more = Vec::new();
            for case in &cases {
                for part in &parts {
                    let mut case = case.clone();
                    case.push((*name, part.clone()));
                    more.push(case);
                }
            }
            cases = more;
        }
        let mut whole: Option<Identity> = None;
        for case in &cases {
            let found = decide_case(&r, definitions, case);
            // Where a symbol is zero a side may be undefined.
            let at_zero = case.iter().any(|(_, part)| matches!(part, Part::Zero));
            let undefined = matches!(found.error, Some(SymbolicError::NotInvertible(_)));
            match found.outcome {
                Outcome::Refuted => return found,
                Outcome::Undecided if at_zero && undefined => {}
                Outcome::Undecided => whole = Some(found),
                Outcome::Proved if whole.is_none() => whole = Some(found),
                Outcome::Proved => {}
            }
        }
        match whole {
            Some(found) if found.outcome == Outcome::Undecided => {
                self.over_boxes(&r, definitions, &free).unwrap_or(found)
            }
            Some(found) => found,
            None => open("there is no point at which both sides are defined".into()),
        }
    }

    /// An inequality all of whose symbols are bounded, proved box by box.
    fn over_boxes(
        &self,
        r: &Requirement,
        definitions: &Definitions,
        free: &[(&String, &Domain)],
    ) -> Option<Identity> {
        // Derivatives of functions that are known by their derivatives alone have no values.
        if !definitions.derivations.is_empty() {
            return None;
        }
        let slack = r.slack()?;
        let region: Region = free
            .iter()
            .map(|(name, domain)| match domain {
                Domain::Between(a, b) => Some((name.to_string(), [a.clone(), b.clone()])),
                _ => None,
            })
            .collect::<Option<_>>()?;
        let f = Function::new(definitions, &slack, &region).ok()?;
        f.is_positive().then_some(Identity {
            outcome: Outcome::Proved,
            residual: None,
            witness: None,
            error: None,
        })
    }
}

fn open(reason: String) -> Identity {
    Identity {
        outcome: Outcome::Undecided,
        residual: None,
        witness: None,
        error: Some(SymbolicError::Unsupported(reason)),
    }
}

fn decide_case(r: &Requirement, definitions: &Definitions, case: &[(&String, Part)]) -> Identity {
    let r = case
        .iter()
        .fold(r.clone(), |r, (name, part)| match part.in_place(name) {
            Some(value) => r.at(name, &value),
            None => r,
        });
    let sample = |turn: u32| -> BTreeMap<String, Rational> {
        let value =
            |(name, part): &(&String, Part)| Some((name.to_string(), part.sample(name, turn)?));
        case.iter().filter_map(value).collect()
    };
    let mut found = open("no point was tried".into());
    for turn in TURNS {
        let named = sample(turn);
        found = r.decide(definitions, &named);
        if found.outcome != Outcome::Undecided || case.is_empty() {
            found.witness = found.witness.map(|w| signed(w, case, &named));
            break;
        }
    }
    found
}

/// The point in the symbols as they are, not in their magnitudes.
fn signed(
    mut witness: Witness,
    case: &[(&String, Part)],
    named: &BTreeMap<String, Rational>,
) -> Witness {
    for (name, part) in case {
        let value = match (part, named.get(*name)) {
            (Part::Signed(true, ..), Some(size)) => format!("-{size}"),
            (_, Some(value)) => value.to_string(),
            (_, None) => "0".into(),
        };
        witness.point.retain(|p| p.0 != **name);
        witness.point.push((name.to_string(), value));
    }
    witness.point.sort();
    witness
}
