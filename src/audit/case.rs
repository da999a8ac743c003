//! One input of an audit and where it came from.

use super::domain::{CheckPoint, Domain, Draw, Region};
use super::hard::HardCase;
use super::hex_float::hex_float;
use super::method::Method;
use super::no_such::NoSuch;
use super::settings::Settings;
use serde::Serialize;

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
    /// A command that runs this case alone.
    pub fn reproduce(&self) -> String {
        match &self.origin {
            Origin::Line { number } => format!("line {number} of the inputs"),
            _ => format!("mechaudit audit {} {}", self.method, self.place()),
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
        }
    }
}

/// A path as a word of a shell.
fn quoted(path: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "/._-+,:@%".contains(c);
    match !path.is_empty() && path.chars().all(plain) {
        true => path.into(),
        false => format!("'{}'", path.replace('\'', "'\\''")),
    }
}

/// The cases of a run, check points and hard cases first; each is drawn when it is asked for.
pub struct Cases {
    method: &'static str,
    domain: Domain,
    hard: Vec<HardCase>,
    seed: u64,
    per_region: u64,
}

impl Cases {
    /// Those of a method's whole domain.
    pub fn new(method: &dyn Method, settings: &Settings) -> Cases {
        Cases {
            method: method.name(),
            domain: method.domain(),
            hard: method.hard(),
            seed: settings.seed,
            per_region: settings.cases_per_region,
        }
    }

    /// Their number.
    pub fn len(&self) -> usize {
        let random = self
            .per_region
            .saturating_mul(self.domain.regions.len() as u64);
        usize::try_from(random)
            .unwrap_or(usize::MAX)
            .saturating_add(self.named())
    }

    /// Check points and hard cases.
    fn named(&self) -> usize {
        self.domain.check_points.len() + self.hard.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The case of that number.
    ///
    /// # Panics
    /// From [`Cases::len`] on.
    pub fn get(&self, i: usize) -> Case {
        if let Some(point) = self.domain.check_points.get(i) {
            return self.check_point(point);
        }
        if i < self.named() {
            return self.hard(i - self.domain.check_points.len());
        }
        let random = (i - self.named()) as u64;
        let region = &self.domain.regions[(random / self.per_region) as usize];
        self.random(region, random % self.per_region)
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
        Case {
            method: self.method,
            region: "hard",
            input: self.hard[i].input.clone(),
            origin: Origin::Hard {
                number: i + 1,
                folder: self.hard[i].folder.clone(),
            },
        }
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
        let found = regions.iter().find(|r| r.name == name);
        let known = || regions.iter().map(|r| r.name).collect();
        found
            .map(|r| self.random(r, index))
            .ok_or_else(|| NoSuch::new(self.method, "region", name, known()))
    }

    fn random(&self, region: &Region, index: u64) -> Case {
        let mut draw = Draw::new(self.seed, self.method, region.name, index);
        Case {
            method: self.method,
            region: region.name,
            input: (region.sample)(&mut draw),
            origin: Origin::Random {
                seed: self.seed,
                index,
            },
        }
    }

    fn check_point(&self, point: &CheckPoint) -> Case {
        Case {
            method: self.method,
            region: "check-points",
            input: point.input.clone(),
            origin: Origin::CheckPoint { name: point.name },
        }
    }
}
