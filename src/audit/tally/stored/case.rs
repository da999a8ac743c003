//! Cases and answers, stored.

use super::error::StoredError;
use crate::answer::SolverAnswer;
use crate::case::{Case, Origin};
use crate::kept::Kept;
use crate::method::Method;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A float by its bits, in hexadecimal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bits(pub f64);

impl PartialEq for Bits {
    fn eq(&self, other: &Bits) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

impl Serialize for Bits {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(&format_args!("{:016x}", self.0.to_bits()))
    }
}

impl<'de> Deserialize<'de> for Bits {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Bits, D::Error> {
        let text = <std::borrow::Cow<str>>::deserialize(from)?;
        let bits = u64::from_str_radix(&text, 16).map_err(serde::de::Error::custom)?;
        Ok(Bits(f64::from_bits(bits)))
    }
}

/// The names that a method has.
pub(super) struct Known {
    method: &'static str,
    regions: Vec<&'static str>,
    check_points: Vec<&'static str>,
}

impl Known {
    pub(super) fn of(method: &dyn Method, regions: &[(&'static str, &'static str)]) -> Known {
        let points = method.domain().check_points.into_iter();
        Known {
            method: method.name(),
            regions: regions.iter().map(|r| r.0).collect(),
            check_points: points.map(|p| p.name).collect(),
        }
    }

    pub(super) fn region(&self, name: &str) -> Result<&'static str, StoredError> {
        found(&self.regions, "region", name)
    }
}

fn found(
    all: &[&'static str],
    what: &'static str,
    name: &str,
) -> Result<&'static str, StoredError> {
    let found = all.iter().find(|n| **n == name).copied();
    found.ok_or_else(|| StoredError::Name {
        what,
        name: name.into(),
    })
}

/// A case of a region that is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct StoredCase(StoredOrigin, Vec<Bits>);

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum StoredOrigin {
    CheckPoint(String),
    Random(u64, u64),
    Hard(usize, Option<String>),
    Given,
    Line(u64),
    Box(String, u64, u64),
    Near(String, Bits, u64, u64),
}

impl StoredCase {
    pub(super) fn of(case: &Case) -> StoredCase {
        let origin = match &case.origin {
            Origin::CheckPoint { name } => StoredOrigin::CheckPoint((*name).into()),
            Origin::Random { seed, index } => StoredOrigin::Random(*seed, *index),
            Origin::Hard { number, folder } => StoredOrigin::Hard(*number, folder.clone()),
            Origin::Given => StoredOrigin::Given,
            Origin::Line { number } => StoredOrigin::Line(*number),
            Origin::Box { text, seed, index } => StoredOrigin::Box(text.clone(), *seed, *index),
            Origin::Near {
                text,
                radius,
                seed,
                index,
            } => StoredOrigin::Near(text.clone(), Bits(*radius), *seed, *index),
        };
        StoredCase(origin, case.input.iter().copied().map(Bits).collect())
    }

    pub(super) fn restored(self, region: &'static str, known: &Known) -> Result<Case, StoredError> {
        let origin = match self.0 {
            StoredOrigin::CheckPoint(name) => Origin::CheckPoint {
                name: found(&known.check_points, "check point", &name)?,
            },
            StoredOrigin::Random(seed, index) => Origin::Random { seed, index },
            StoredOrigin::Hard(number, folder) => Origin::Hard { number, folder },
            StoredOrigin::Given => Origin::Given,
            StoredOrigin::Line(number) => Origin::Line { number },
            StoredOrigin::Box(text, seed, index) => Origin::Box { text, seed, index },
            StoredOrigin::Near(text, radius, seed, index) => Origin::Near {
                text,
                radius: radius.0,
                seed,
                index,
            },
        };
        Ok(Case {
            method: known.method,
            region,
            input: self.1.into_iter().map(|x| x.0).collect(),
            origin,
        })
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum StoredAnswer {
    Values(Vec<Bits>),
    /// With its word, if it has one.
    Refuses(Option<String>),
    Fails(String),
    Unanswered(String),
}

/// A case with its answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct StoredKept(StoredCase, StoredAnswer);

impl StoredKept {
    pub(super) fn of(kept: &Kept) -> StoredKept {
        let answer = match kept.answer() {
            Some(SolverAnswer::Values(v)) => {
                StoredAnswer::Values(v.iter().copied().map(Bits).collect())
            }
            Some(SolverAnswer::Refuses(word)) => StoredAnswer::Refuses(Some((*word).into())),
            Some(SolverAnswer::Declines(word)) => StoredAnswer::Refuses(word.clone()),
            Some(SolverAnswer::Fails(why)) => StoredAnswer::Fails(why.clone()),
            Some(SolverAnswer::Unanswered(why)) => StoredAnswer::Unanswered(why.clone()),
            None => StoredAnswer::Unanswered("not kept".into()),
        };
        StoredKept(StoredCase::of(kept.case()), answer)
    }

    pub(super) fn restored(self, region: &'static str, known: &Known) -> Result<Kept, StoredError> {
        let case = self.0.restored(region, known)?;
        let answer = match self.1 {
            StoredAnswer::Values(v) => SolverAnswer::Values(v.into_iter().map(|x| x.0).collect()),
            // Judged as the word of code under test is.
            StoredAnswer::Refuses(word) => SolverAnswer::Declines(word),
            StoredAnswer::Fails(why) => SolverAnswer::Fails(why),
            StoredAnswer::Unanswered(why) => SolverAnswer::Unanswered(why),
        };
        Ok(Kept::Read(Box::new((case, answer))))
    }
}
