//! One input of an audit and where it came from.

use super::domain::{CheckPoint, Domain, Draw, Key};
use super::hard::HardCase;
use super::hex_float::hex_float;
use super::method::Method;
use super::no_such::NoSuch;
use super::sampling::Sampling;
use super::settings::Settings;
use super::ulp::Format;
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};
use std::cmp::Ordering;

/// Where a case came from.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Origin {
    /// A point the domain names.
    CheckPoint {
        /// Its name.
        name: &'static str,
    },
    /// Drawn at random: the stream is fixed by seed, method, region and index.
    Random {
        /// The seed.
        seed: u64,
        /// The index within the region.
        index: u64,
    },
    /// A hard case found by a hunt.
    Hard {
        /// Its number among the method's, counted from one.
        number: usize,
        /// The folder whose file holds it, if it is not one that is part of this crate.
        #[serde(skip_serializing_if = "Option::is_none")]
        folder: Option<String>,
    },
    /// An input given by itself.
    Given,
    /// A line of a file of inputs, counted from one.
    Line {
        /// Its number.
        number: u64,
    },
    /// Drawn in a box, see [`SampleBox`](super::SampleBox).
    Box {
        /// The box.
        text: String,
        /// The seed.
        seed: u64,
        /// The index within the box.
        index: u64,
    },
    /// Drawn about an input, see [`Near`](super::Near).
    Near {
        /// The input.
        text: String,
        /// The radius.
        radius: f64,
        /// The seed.
        seed: u64,
        /// The index within the neighbourhood.
        index: u64,
    },
}

/// Numbers of an input that are written out beside the place where they come from.
const SHORT: usize = 16;

/// A case by its place, with its input if that is short: for statistics, of which there are many.
pub(super) fn briefly<S: Serializer>(case: &Case, to: S) -> Result<S::Ok, S::Error> {
    let mut brief = to.serialize_struct("Case", 4)?;
    brief.serialize_field("region", case.region)?;
    let short = (case.input.len() <= SHORT).then_some(&case.input);
    brief.serialize_field("input", &short)?;
    brief.serialize_field("origin", &case.origin)?;
    brief.serialize_field("place", &case.place())?;
    brief.end()
}

/// [`briefly`], if there is a case.
pub(super) fn briefly_if<S: Serializer>(case: &Option<Case>, to: S) -> Result<S::Ok, S::Error> {
    struct Brief<'a>(&'a Case);
    impl Serialize for Brief<'_> {
        fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
            briefly(self.0, to)
        }
    }
    case.as_ref().map(Brief).serialize(to)
}

/// One input.
#[derive(Clone, Debug, Serialize)]
pub struct Case {
    /// The method's name.
    pub method: &'static str,
    /// The region of the domain.
    pub region: &'static str,
    /// The input, laid out as the method documents.
    pub input: Vec<f64>,
    /// Where it came from.
    pub origin: Origin,
}

impl Case {
    /// A total order of the cases of a region: named ones first, then by number, then by input. It
    /// does not depend on how a run was divided.
    pub fn order(&self, other: &Case) -> Ordering {
        fn key(origin: &Origin) -> (u8, u64, u64, &str) {
            match origin {
                Origin::CheckPoint { name } => (0, 0, 0, *name),
                Origin::Hard { number, folder } => {
                    (1, *number as u64, 0, folder.as_deref().unwrap_or(""))
                }
                Origin::Random { seed, index } => (2, *index, *seed, ""),
                Origin::Given => (3, 0, 0, ""),
                Origin::Line { number } => (4, *number, 0, ""),
                Origin::Box { text, seed, index } => (5, *index, *seed, text),
                Origin::Near {
                    text, seed, index, ..
                } => (6, *index, *seed, text),
            }
        }
        let bits = |x: &f64| x.to_bits();
        let origins = key(&self.origin).cmp(&key(&other.origin));
        let inputs = || {
            let own = self.input.iter().map(bits);
            own.cmp(other.input.iter().map(bits))
        };
        let regions = || self.region.cmp(other.region);
        origins.then_with(inputs).then_with(regions)
    }

    /// A hash of the input, the same on every machine: FNV-1a, mixed once more.
    pub(super) fn hash(&self) -> u64 {
        let mut h: u64 = 0xcbf2_9ce4_8422_2325;
        for x in &self.input {
            h = (h ^ x.to_bits()).wrapping_mul(0x0000_0100_0000_01b3);
            h ^= h >> 32;
        }
        h = (h ^ (h >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        h = (h ^ (h >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        h ^ (h >> 31)
    }

    /// A command that runs this case alone.
    pub fn reproduce(&self) -> String {
        match &self.origin {
            Origin::Line { number } => format!("line {number} of the inputs"),
            _ => format!("mechaudit audit {} {}", quoted(self.method), self.place()),
        }
    }

    /// The arguments of `mechaudit audit` and `mechaudit points` that choose this case.
    pub fn place(&self) -> String {
        match &self.origin {
            Origin::CheckPoint { name } => format!("--check-point {name}"),
            Origin::Hard {
                number,
                folder: None,
            } => format!("--hard-case {number}"),
            Origin::Hard {
                number,
                folder: Some(folder),
            } => format!("--hard {} --hard-case {number}", quoted(folder)),
            Origin::Given => {
                let input: Vec<String> = self.input.iter().map(|x| hex_float(*x)).collect();
                format!("--at {}", input.join(","))
            }
            Origin::Random { seed, index } => {
                format!("--region {} --seed {seed} --case {index}", self.region)
            }
            Origin::Line { number } => format!("--line {number}"),
            Origin::Box { text, seed, index } => {
                format!("--box {} --seed {seed} --case {index}", quoted(text))
            }
            Origin::Near {
                text,
                radius,
                seed,
                index,
            } => {
                let text = quoted(text);
                format!("--near {text} --radius {radius} --seed {seed} --case {index}")
            }
        }
    }
}

/// A text as a word of a shell.
pub(super) fn quoted(path: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "/._-+,:@%".contains(c);
    match !path.is_empty() && path.chars().all(plain) {
        true => path.into(),
        false => format!("'{}'", path.replace('\'', "'\\''")),
    }
}

/// The cases of a run, check points and hard cases first; each is drawn when needed.
pub struct Cases {
    method: &'static str,
    /// See [`Method::stream`].
    stream: &'static str,
    domain: Domain,
    /// See [`Draw::keyed`].
    keyed: Key,
    /// Of each region, see [`Draw::named`].
    streams: Vec<u64>,
    hard: Vec<HardCase>,
    seed: u64,
    per_region: u64,
    sampling: Sampling,
    format: Format,
}

impl Cases {
    /// Those of a method's whole domain.
    pub fn new(method: &dyn Method, settings: &Settings) -> Cases {
        let (stream, domain) = (method.stream(), method.domain());
        let streams = domain.regions.iter().map(|r| Draw::named(stream, r.name));
        Cases {
            method: method.name(),
            stream,
            keyed: Draw::keyed(settings.seed),
            streams: streams.collect(),
            domain,
            hard: method.hard(),
            seed: settings.seed,
            per_region: settings.cases_per_region,
            sampling: method.sampling(),
            format: method.format(),
        }
    }

    /// Their number.
    pub fn len(&self) -> usize {
        let random = self.per_region.saturating_mul(self.parts());
        usize::try_from(random)
            .unwrap_or(usize::MAX)
            .saturating_add(self.named())
    }

    /// Check points and hard cases.
    fn named(&self) -> usize {
        match self.sampling {
            Sampling::Domain => self.domain.check_points.len() + self.hard.len(),
            _ => 0,
        }
    }

    /// Into how many regions random cases go.
    fn parts(&self) -> u64 {
        match &self.sampling {
            Sampling::Near(_) => 1,
            Sampling::Box(b) if b.is_whole() => 1,
            _ => self.domain.regions.len() as u64,
        }
    }

    /// Returns true if there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The case of that number.
    ///
    /// # Panics
    /// From [`Cases::len`] on.
    pub fn get(&self, i: usize) -> Case {
        if self.sampling != Sampling::Domain {
            assert!(i < self.len(), "no case {i} of {}", self.len());
            return self.sampled(i as u64);
        }
        if let Some(point) = self.domain.check_points.get(i) {
            return self.check_point(point);
        }
        if i < self.named() {
            return self.hard(i - self.domain.check_points.len());
        }
        let random = (i - self.named()) as u64;
        let region = (random / self.per_region) as usize;
        self.random(region, random % self.per_region)
    }

    /// The case of that number in the box or about the input that cases are drawn from; `None`
    /// where they are drawn from the regions.
    pub fn at_index(&self, index: u64) -> Option<Case> {
        (self.sampling != Sampling::Domain).then(|| self.sampled(index))
    }

    fn sampled(&self, index: u64) -> Case {
        let stream = (self.seed, index);
        let seed = self.seed;
        let (region, input, origin) = match &self.sampling {
            Sampling::Near(near) => {
                let origin = Origin::Near {
                    text: near.text().into(),
                    radius: near.radius(),
                    seed,
                    index,
                };
                ("near", near.sample(self.stream, stream), origin)
            }
            Sampling::Box(sides) => {
                let (region, input) = sides.sample(self.stream, &self.domain, stream);
                let text = sides.text().into();
                (region, input, Origin::Box { text, seed, index })
            }
            Sampling::Domain => unreachable!("there is a box or a centre"),
        };
        self.case(region, input, origin)
    }

    /// A case, its numbers those of the format.
    fn case(&self, region: &'static str, mut input: Vec<f64>, origin: Origin) -> Case {
        self.format.represent(&mut input);
        Case {
            method: self.method,
            region,
            input,
            origin,
        }
    }

    /// The region of the case of that number, and the number of the first case beyond it that may
    /// be of another.
    ///
    /// # Panics
    /// From [`Cases::len`] on.
    pub fn region_of(&self, i: usize) -> (&'static str, usize) {
        match &self.sampling {
            Sampling::Domain => {}
            Sampling::Near(_) => return ("near", self.len()),
            Sampling::Box(b) if b.is_whole() => return ("box", self.len()),
            Sampling::Box(_) => return (self.get(i).region, i + 1),
        }
        let points = self.domain.check_points.len();
        if i < points {
            return ("check-points", points);
        }
        if i < self.named() {
            return ("hard", self.named());
        }
        let region = (i - self.named()) as u64 / self.per_region;
        let end = (region + 1).saturating_mul(self.per_region);
        let end = usize::try_from(end).unwrap_or(usize::MAX);
        let name = self.domain.regions[region as usize].name;
        (name, end.saturating_add(self.named()))
    }

    /// The hard case of that number, counted from one.
    ///
    /// # Errors
    /// A number that there is not.
    pub fn hard_case(&self, number: usize) -> Result<Case, NoSuch> {
        match number.checked_sub(1).filter(|i| *i < self.hard.len()) {
            Some(i) => Ok(self.hard(i)),
            None => {
                let known = match self.hard.len() {
                    0 => "none",
                    _ => "those of its file, counted from 1",
                };
                let number = number.to_string();
                Err(NoSuch::new(self.method, "hard case", &number, vec![known]))
            }
        }
    }

    fn hard(&self, i: usize) -> Case {
        let origin = Origin::Hard {
            number: i + 1,
            folder: self.hard[i].folder.clone(),
        };
        self.case("hard", self.hard[i].input.clone(), origin)
    }

    /// The check point of that name.
    ///
    /// # Errors
    /// A check point that there is not.
    pub fn at_check_point(&self, name: &str) -> Result<Case, NoSuch> {
        let points = &self.domain.check_points;
        let found = points.iter().find(|p| p.name == name);
        let known = || points.iter().map(|p| p.name).collect();
        found
            .map(|p| self.check_point(p))
            .ok_or_else(|| NoSuch::new(self.method, "check point", name, known()))
    }

    /// The random case of that number in a region.
    ///
    /// # Errors
    /// A region that there is not.
    pub fn in_region(&self, name: &str, index: u64) -> Result<Case, NoSuch> {
        let regions = &self.domain.regions;
        let found = regions.iter().position(|r| r.name == name);
        let known = || regions.iter().map(|r| r.name).collect();
        found
            .map(|r| self.random(r, index))
            .ok_or_else(|| NoSuch::new(self.method, "region", name, known()))
    }

    fn random(&self, region: usize, index: u64) -> Case {
        let (seed, named) = (self.seed, self.streams[region]);
        let region = &self.domain.regions[region];
        let input = Draw::with(&self.keyed, named, index, |draw| (region.sample)(draw));
        self.case(region.name, input, Origin::Random { seed, index })
    }

    fn check_point(&self, point: &CheckPoint) -> Case {
        let origin = Origin::CheckPoint { name: point.name };
        self.case("check-points", point.input.clone(), origin)
    }
}

#[cfg(test)]
mod tests;
