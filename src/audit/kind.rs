//! Answers of the wrong kind, told apart and counted.

use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize};
use std::ops::{Index, IndexMut};

/// In which way an answer is of the wrong kind: it has no error that could be measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// NaN where something else is due.
    Nan,
    /// An infinity where a number, NaN or the other infinity is due.
    Infinity,
    /// A number where an infinity or NaN is due.
    Finite,
    /// The zero of the wrong sign.
    WrongZero,
    /// A refusal where values are due, or with another word than the reference's.
    Refusal,
    /// Values where a refusal is due.
    Value,
    /// Too few or too many values.
    Missing,
    /// An answer that cannot be read; a panic.
    Unreadable,
    /// No answer, or none in time.
    Unanswered,
}

impl Kind {
    /// All of them, in the order of reports.
    pub const ALL: [Kind; 9] = [
        Kind::Nan,
        Kind::Infinity,
        Kind::Finite,
        Kind::WrongZero,
        Kind::Refusal,
        Kind::Value,
        Kind::Missing,
        Kind::Unreadable,
        Kind::Unanswered,
    ];

    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Kind::Nan => "NaN",
            Kind::Infinity => "infinity",
            Kind::Finite => "number for infinity or NaN",
            Kind::WrongZero => "wrong zero",
            Kind::Refusal => "refusal",
            Kind::Value => "value for refusal",
            Kind::Missing => "number of values",
            Kind::Unreadable => "unreadable",
            Kind::Unanswered => "unanswered",
        }
    }

    /// As a member of JSON and a column of CSV.
    pub const fn key(self) -> &'static str {
        match self {
            Kind::Nan => "nan",
            Kind::Infinity => "infinity",
            Kind::Finite => "finite",
            Kind::WrongZero => "wrong_zero",
            Kind::Refusal => "refusal",
            Kind::Value => "value",
            Kind::Missing => "missing",
            Kind::Unreadable => "unreadable",
            Kind::Unanswered => "unanswered",
        }
    }
}

/// The number of faults of each [`Kind`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kinds(pub(super) [u64; Kind::ALL.len()]);

impl Kinds {
    /// All together.
    pub fn total(&self) -> u64 {
        self.0.iter().sum()
    }

    /// Those that there are, in the order of reports.
    pub fn nonzero(&self) -> impl Iterator<Item = (Kind, u64)> + '_ {
        let all = Kind::ALL.into_iter().zip(self.0);
        all.filter(|(_, n)| *n > 0)
    }

    /// Adds another count.
    pub fn merge(&mut self, other: &Kinds) {
        for (n, more) in self.0.iter_mut().zip(other.0) {
            *n += more;
        }
    }
}

impl Index<Kind> for Kinds {
    type Output = u64;
    fn index(&self, kind: Kind) -> &u64 {
        &self.0[kind as usize]
    }
}

impl IndexMut<Kind> for Kinds {
    fn index_mut(&mut self, kind: Kind) -> &mut u64 {
        &mut self.0[kind as usize]
    }
}

impl Serialize for Kinds {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(Some(Kind::ALL.len()))?;
        for kind in Kind::ALL {
            map.serialize_entry(kind.key(), &self[kind])?;
        }
        map.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_counted_apart() {
        let mut kinds = Kinds::default();
        for (i, kind) in Kind::ALL.into_iter().enumerate() {
            kinds[kind] += i as u64;
            assert_eq!(kind as usize, i);
        }
        let mut twice = kinds;
        twice.merge(&kinds);
        assert_eq!((twice.total(), twice[Kind::Unanswered]), (72, 16));
        assert_eq!(kinds.nonzero().count(), 8);
    }
}
