//! Inputs that programs are shown. They are drawn when they are needed; the last ones are kept, so
//! that nothing grows with their number and few are drawn twice.

use crate::cli::failure::Failure;
use mechaudit::audit::{Case, Cases, Method, Settings};
use mechaudit::campaign::Stride;
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Where the inputs of a run come from.
enum Source {
    All(Cases),
    /// Those of a shard.
    Dealt(Cases, Stride),
    Listed(Vec<Case>),
}

/// The inputs of a run, drawn when a program is shown them, kept, and taken when its answers are
/// judged.
pub struct Inputs {
    source: Source,
    /// Those shown last, number `i` in place `i` modulo their number, until they are taken.
    drawn: Mutex<Vec<Option<Kept>>>,
}

/// An input that is kept. Few numbers are kept in it: memory that is made by the thread that feeds
/// a program and given back by one that judges is slow.
#[derive(Clone)]
struct Kept {
    number: usize,
    /// Without those numbers.
    case: Case,
    few: [f64; FEW],
    /// Their number.
    length: u8,
}

impl Kept {
    fn new(number: usize, mut case: Case) -> Kept {
        let (mut few, mut length) = (<[f64; FEW]>::default(), 0);
        if case.input.len() <= FEW {
            length = case.input.len();
            few[..length].copy_from_slice(&case.input);
            case.input = Vec::new();
        }
        Kept {
            number,
            case,
            few,
            length: length as u8,
        }
    }

    fn into_case(self) -> Case {
        let mut case = self.case;
        case.input
            .extend_from_slice(&self.few[..self.length.into()]);
        case
    }
}

/// Inputs kept: more than a program has read and not answered, as a rule.
const KEPT: usize = 1 << 15;
/// Numbers of an input that is kept. To draw longer ones is little beside judging them.
const SHORT: usize = 32;
/// Numbers of an input that is kept without memory of its own.
const FEW: usize = 4;

impl Inputs {
    fn new(source: Source) -> Inputs {
        Inputs {
            source,
            drawn: Mutex::default(),
        }
    }

    /// One case, or all of the method.
    pub fn of(
        method: &dyn Method,
        one: Option<Case>,
        settings: &Settings,
    ) -> Result<Arc<Inputs>, Failure> {
        let inputs = Inputs::new(match one {
            Some(case) => Source::Listed(vec![case]),
            None => Source::All(Cases::new(method, settings)),
        });
        match inputs.len() {
            0 => Err(Failure::new("there are no cases to audit")),
            _ => Ok(Arc::new(inputs)),
        }
    }

    /// Those of a shard.
    pub fn dealt(cases: Cases, stride: Stride) -> Inputs {
        Inputs::new(Source::Dealt(cases, stride))
    }

    /// These.
    pub fn listed(cases: Vec<Case>) -> Inputs {
        Inputs::new(Source::Listed(cases))
    }

    pub fn len(&self) -> usize {
        match &self.source {
            Source::All(cases) => cases.len(),
            Source::Dealt(_, stride) => stride.len() as usize,
            Source::Listed(cases) => cases.len(),
        }
    }

    fn draw(&self, i: usize) -> Case {
        match &self.source {
            Source::All(cases) => cases.get(i),
            Source::Dealt(cases, stride) => cases.get(stride.at(i as u64) as usize),
            Source::Listed(cases) => cases[i].clone(),
        }
    }

    /// Nobody panics with the lock held.
    fn lock(&self) -> MutexGuard<'_, Vec<Option<Kept>>> {
        self.drawn.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Those from number `from` on, shown to a program: others, and whoever judges their answers,
    /// find them kept.
    pub fn keep(&self, from: usize, cases: Vec<Case>) {
        let mut drawn = self.lock();
        drawn.resize(KEPT, None);
        for (i, case) in (from..).zip(cases) {
            if case.input.len() <= SHORT {
                drawn[i % KEPT] = Some(Kept::new(i, case));
            }
        }
    }

    /// Those of these numbers, which are kept no longer.
    pub fn take(&self, numbers: Range<usize>) -> Vec<Case> {
        let kept: Vec<Option<Case>> = {
            let mut drawn = self.lock();
            let mut kept = |i: usize| {
                let kept = drawn.get_mut(i % KEPT)?.take_if(|k| k.number == i);
                kept.map(Kept::into_case)
            };
            numbers.clone().map(&mut kept).collect()
        };
        let all = numbers.zip(kept);
        all.map(|(i, case)| case.unwrap_or_else(|| self.draw(i)))
            .collect()
    }

    /// One of them.
    pub fn take_one(&self, i: usize) -> Case {
        let mut case = self.take(i..i + 1);
        case.pop().expect("one for each number")
    }

    /// The region of the input of that number, and where the next begins.
    pub fn region_of(&self, i: usize) -> (&'static str, usize) {
        match &self.source {
            Source::All(cases) => cases.region_of(i),
            Source::Dealt(..) => (self.draw(i).region, i + 1),
            Source::Listed(cases) => (cases[i].region, i + 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::methods;

    #[test]
    fn regions_end_where_the_next_begins() {
        let method = methods::find("erf").unwrap();
        let settings = Settings {
            cases_per_region: 3,
            ..Settings::default()
        };
        let cases = || Cases::new(&*method, &settings);
        let all: Vec<Case> = (0..cases().len()).map(|i| cases().get(i)).collect();
        let last = all.len() - 1;
        let one = Inputs::of(&*method, Some(all[last].clone()), &settings).unwrap();
        assert_eq!(one.region_of(0), (all[last].region, 1));
        let listed = Inputs::listed(vec![all[0].clone(), all[last].clone()]);
        assert_eq!(listed.region_of(0), (all[0].region, 1));
        assert_eq!(listed.region_of(1), (all[last].region, 2));
        let stride = Stride {
            first: 1,
            step: 3,
            end: all.len() as u64,
        };
        let dealt = Inputs::dealt(cases(), stride);
        assert_eq!(dealt.region_of(2), (all[7].region, 3));
        let whole = Inputs::of(&*method, None, &settings).unwrap();
        let (mut i, mut regions) = (0, Vec::new());
        while i < whole.len() {
            let (region, next) = whole.region_of(i);
            assert!(all[i..next].iter().all(|c| c.region == region));
            regions.push(region);
            i = next;
        }
        let mut due: Vec<&str> = all.iter().map(|c| c.region).collect();
        due.dedup();
        assert_eq!(regions, due);
    }

    #[test]
    fn inputs_that_are_kept_are_those_of_their_numbers() {
        let settings = Settings {
            cases_per_region: 2000,
            ..Settings::default()
        };
        let method = methods::find("erf").unwrap();
        let inputs = Inputs::of(&*method, None, &settings).unwrap();
        let cases = Cases::new(&*method, &settings);
        assert!(inputs.len() > KEPT + 6);
        let same = |given: Case, i: usize| {
            let drawn = cases.get(i);
            assert_eq!(given.region, drawn.region, "{i}");
            let bits = |case: &Case| case.input.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&given), bits(&drawn), "{i}");
        };
        for i in [5, 6, 5, KEPT + 5, 5, KEPT + 5, KEPT + 6, 6] {
            let case = inputs.take_one(i);
            same(case.clone(), i);
            inputs.keep(i, vec![case]);
        }
        for i in [KEPT + 5, 5, 5, 6, KEPT + 6, 7] {
            same(inputs.take_one(i), i);
        }
    }

    /// An input that was shown is kept for the judge and not drawn again, unless it is long or
    /// another one has replaced it.
    #[test]
    fn inputs_that_were_shown_are_at_hand() {
        let case = |x: f64, length: usize| Case {
            method: "erf",
            region: "given",
            input: vec![x; length],
            origin: mechaudit::audit::Origin::Given,
        };
        let drawn: Vec<Case> = (0..KEPT + 9).map(|_| case(0.0, 2)).collect();
        let inputs = Inputs::listed(drawn);
        let taken = |i: usize| inputs.take_one(i).input;
        for length in [1, FEW, FEW + 1, SHORT] {
            inputs.keep(6, vec![case(1.0, length), case(2.0, length)]);
            assert_eq!(taken(7), vec![2.0; length]);
            assert_eq!(taken(6), vec![1.0; length]);
            assert_eq!(taken(6), [0.0; 2]);
        }
        inputs.keep(6, vec![case(1.0, SHORT + 1)]);
        assert_eq!(taken(6), [0.0; 2]);
        inputs.keep(6, vec![case(1.0, 2), case(2.0, 2)]);
        inputs.keep(KEPT + 6, vec![case(3.0, 2)]);
        assert_eq!(taken(6), [0.0; 2]);
        assert_eq!([taken(KEPT + 6), taken(7)], [[3.0; 2], [2.0; 2]]);
    }

    #[test]
    fn inputs_are_one_or_all_or_those_dealt() {
        let method = methods::find("erf").unwrap();
        let settings = Settings {
            cases_per_region: 2,
            ..Settings::default()
        };
        let cases = Cases::new(&*method, &settings);
        let one = Inputs::of(&*method, Some(cases.get(3)), &settings).unwrap();
        assert_eq!(one.len(), 1);
        assert_eq!(one.take_one(0).input, cases.get(3).input);
        let stride = Stride {
            first: 2,
            step: 5,
            end: 14,
        };
        let dealt = Inputs::dealt(Cases::new(&*method, &settings), stride);
        assert_eq!(dealt.len(), 3);
        for (j, i) in [2, 7, 12].into_iter().enumerate() {
            let bits = |case: Case| case.input.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(dealt.take_one(j)), bits(cases.get(i)), "{i}");
        }
        let nowhere = Settings {
            cases_per_region: 0,
            ..Settings::default()
        };
        let region = method.domain().regions[0].name;
        let variant = mechaudit::audit::Variant::new(&*method).region(region);
        let none = Inputs::of(&variant.unwrap(), None, &nowhere);
        let why = none.map(|_| ()).unwrap_err().to_string();
        assert_eq!(why, "there are no cases to audit");
    }
}
