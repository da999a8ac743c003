//! Tallies as values that can be written and read: exact, every float by its bits.
//!
//! A kept case is stored with its answer; its judgement follows from both and is made anew when it
//! is shown.

mod case;
mod error;
mod spread;

pub use self::error::StoredError;

use self::case::{Bits, Known, StoredCase, StoredKept};
use self::spread::StoredSpread;
use super::Tally;
use crate::judge::Verdict;
use crate::kept::Kept;
use crate::kind::{Kind, Kinds};
use crate::method::Method;
use crate::ranking::First;
use crate::region_tally::{
    EXAMPLES, Largest, OutputTally, RegionTally, WORST, number_of, octave_of,
};
use crate::report::Point;
use crate::settings::Settings;
use serde::{Deserialize, Serialize};

/// A [lean](Tally::lean) tally to be written and read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredTally {
    regions: Vec<StoredRegion>,
    laws: Vec<StoredLaw>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoredLaw {
    name: String,
    cases: u64,
    worst: Bits,
    /// With its region.
    worst_case: Option<(String, StoredCase)>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoredRegion {
    name: String,
    cases: u64,
    passed: u64,
    recorded: u64,
    over: u64,
    undecided: u64,
    reference_failed: u64,
    kinds: Vec<u64>,
    outputs: Vec<StoredOutput>,
    normwise: StoredSpread,
    share: Option<(Bits, StoredCase)>,
    worst: Vec<(Bits, StoredKept)>,
    wrong: Vec<(Verdict, Option<Kind>, Vec<StoredKept>)>,
    failures: Vec<StoredKept>,
    points: Vec<StoredPoint>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoredOutput {
    name: String,
    values: u64,
    kinds: Vec<u64>,
    ulps: StoredSpread,
    conditioned: StoredSpread,
    max_condition: Bits,
    worst: Option<(Bits, StoredCase)>,
    octaves: Vec<(Option<i32>, Bits, StoredCase)>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoredPoint {
    case: StoredCase,
    verdict: Verdict,
    ulps: Vec<Bits>,
    of_budget: Bits,
}

fn kinds(stored: &[u64]) -> Result<Kinds, StoredError> {
    let all = stored.try_into();
    all.map(Kinds)
        .map_err(|_| StoredError::Value("numbers of kinds"))
}

fn largest(of: &Largest) -> Option<(Bits, StoredCase)> {
    let first = of.kept().first();
    first.map(|(x, case)| (Bits(*x), StoredCase::of(case)))
}

fn first<T>(room: usize, kept: Vec<T>) -> Result<First<T>, StoredError> {
    First::restore(room, kept).ok_or(StoredError::Value("more cases"))
}

impl Tally {
    /// Everything gathered, to be written.
    pub fn stored(&self) -> StoredTally {
        let laws = self.laws.iter().map(|l| StoredLaw {
            name: l.name.into(),
            cases: l.cases as u64,
            worst: Bits(l.worst),
            worst_case: (l.worst_case.as_ref()).map(|c| (c.region.into(), StoredCase::of(c))),
        });
        let regions = self.regions.iter();
        StoredTally {
            regions: regions.map(|(name, t)| StoredRegion::of(name, t)).collect(),
            laws: laws.collect(),
        }
    }

    /// The result of [`Tally::stored`] for a [lean](Tally::lean) tally of the same method and
    /// settings.
    ///
    /// # Errors
    /// A text that belongs to another method, or to no tally.
    pub fn restored(
        method: &dyn Method,
        settings: &Settings,
        stored: StoredTally,
    ) -> Result<Tally, StoredError> {
        let mut tally = Tally::lean(method, settings);
        let known = Known::of(method, &tally.known);
        for region in stored.regions {
            let name = known.region(&region.name)?;
            region.fill(tally.region(name), name, &known, settings)?;
        }
        for law in stored.laws {
            let own = tally.laws.iter_mut().find(|l| l.name == law.name);
            let Some(own) = own else {
                let (what, name) = ("law", law.name);
                return Err(StoredError::Name { what, name });
            };
            own.cases = law.cases as usize;
            own.worst = law.worst.0;
            own.worst_case = match law.worst_case {
                Some((region, case)) => Some(case.restored(known.region(&region)?, &known)?),
                None => None,
            };
        }
        Ok(tally)
    }
}

impl StoredRegion {
    fn of(name: &str, t: &RegionTally) -> StoredRegion {
        let all = |kept: &[Kept]| kept.iter().map(StoredKept::of).collect::<Vec<_>>();
        let wrong = t.wrong.iter();
        let points = t.points.kept().iter().map(|(_, p)| StoredPoint {
            case: StoredCase::of(&p.case),
            verdict: p.verdict,
            ulps: p.ulps.iter().copied().map(Bits).collect(),
            of_budget: Bits(p.of_budget),
        });
        StoredRegion {
            name: name.into(),
            cases: t.cases,
            passed: t.passed,
            recorded: t.recorded,
            over: t.over,
            undecided: t.undecided,
            reference_failed: t.reference_failed,
            kinds: t.kinds.0.to_vec(),
            outputs: (t.names.iter().zip(&t.outputs))
                .map(|(name, o)| StoredOutput::of(name, o))
                .collect(),
            normwise: StoredSpread::of(&t.normwise),
            share: largest(&t.share),
            worst: (t.worst.kept().iter())
                .map(|(share, kept)| (Bits(*share), StoredKept::of(kept)))
                .collect(),
            wrong: wrong
                .map(|((verdict, kind), kept)| (*verdict, *kind, all(kept.kept())))
                .collect(),
            failures: all(t.failures.kept()),
            points: points.collect(),
        }
    }

    fn fill(
        self,
        t: &mut RegionTally,
        region: &'static str,
        known: &Known,
        settings: &Settings,
    ) -> Result<(), StoredError> {
        let all = |kept: Vec<StoredKept>| -> Result<Vec<Kept>, StoredError> {
            let all = kept.into_iter();
            all.map(|k| k.restored(region, known)).collect()
        };
        let one = |stored: Option<(Bits, StoredCase)>| -> Result<Largest, StoredError> {
            let one = stored.map(|(x, case)| Ok((x.0, case.restored(region, known)?)));
            first(1, one.into_iter().collect::<Result<_, _>>()?)
        };
        if self.outputs.len() != t.outputs.len() {
            return Err(StoredError::Value("a number of outputs"));
        }
        for (k, stored) in self.outputs.into_iter().enumerate() {
            if stored.name != t.names[k] {
                let (what, name) = ("output", stored.name);
                return Err(StoredError::Name { what, name });
            }
            let own = &mut t.outputs[k];
            own.values = stored.values;
            own.kinds = kinds(&stored.kinds)?;
            own.ulps = stored.ulps.restored(&own.ulps)?;
            own.conditioned = stored.conditioned.restored(&own.conditioned)?;
            own.max_condition = stored.max_condition.0;
            own.worst = one(stored.worst)?;
            for (octave, x, case) in stored.octaves {
                if octave.is_some_and(|k| !(-1022..1024).contains(&k)) {
                    return Err(StoredError::Value("an octave"));
                }
                let largest = one(Some((x, case)))?;
                own.octaves.or_insert_with(number_of(octave), || largest);
            }
        }
        t.cases = self.cases;
        t.passed = self.passed;
        t.recorded = self.recorded;
        t.over = self.over;
        t.undecided = self.undecided;
        t.reference_failed = self.reference_failed;
        t.kinds = kinds(&self.kinds)?;
        t.normwise = self.normwise.restored(&t.normwise)?;
        t.share = one(self.share)?;
        let worst = self.worst.into_iter();
        let worst = worst.map(|(share, kept)| Ok((share.0, kept.restored(region, known)?)));
        t.worst = first(WORST, worst.collect::<Result<_, _>>()?)?;
        for (verdict, kind, kept) in self.wrong {
            let kept = first(EXAMPLES, all(kept)?)?;
            t.wrong.insert((verdict, kind), kept);
        }
        t.failures = first(t.failures.room(), all(self.failures)?)?;
        let points = self.points.into_iter().map(|p| {
            let case = p.case.restored(region, known)?;
            let ulps = p.ulps.into_iter().map(|x| x.0).collect();
            let point = Point {
                verdict: p.verdict,
                ulps,
                of_budget: p.of_budget.0,
                case,
            };
            Ok((point.case.hash(), point))
        });
        t.points = first(settings.points, points.collect::<Result<_, _>>()?)?;
        Ok(())
    }
}

impl StoredOutput {
    fn of(name: &str, o: &OutputTally) -> StoredOutput {
        let octaves = o.octaves.iter().filter_map(|(k, of)| {
            let (x, case) = largest(of)?;
            Some((octave_of(k), x, case))
        });
        StoredOutput {
            name: name.into(),
            values: o.values,
            kinds: o.kinds.0.to_vec(),
            ulps: StoredSpread::of(&o.ulps),
            conditioned: StoredSpread::of(&o.conditioned),
            max_condition: Bits(o.max_condition),
            worst: largest(&o.worst),
            octaves: octaves.collect(),
        }
    }
}
