//! The file that says what a campaign judges.

use super::proofs::Units;
use crate::audit::{
    Format, Limit, Method, NoSuch, SampleBox, Sampling, SamplingError, Settings, Variant,
};
use crate::machine::{Refusal, Source};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Cases of each region whose errors a report shows, whatever they are.
const POINTS: usize = 16;

/// The reason why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The file cannot be read as one.
    #[error(transparent)]
    File(#[from] Refusal),
    /// A part cannot be judged.
    #[error("part {part}: {why}")]
    Part {
        /// Its number, counted from one.
        part: usize,
        /// The reason.
        why: String,
    },
}

/// The kind of work in a part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Random cases, with check points and hard cases, of the method's own solver.
    #[default]
    Audit,
    /// Climbs to the worst inputs.
    Hunt,
    /// Random cases of a program.
    Candidate,
    /// The proof of the method's error bound, or of a study's solver, one part of the inputs after
    /// the other.
    Proof,
}

/// A program in place of a method's solver.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Program {
    /// Its command line.
    pub exec: String,
    /// Decimals instead of hexadecimal floats.
    pub decimal: bool,
    /// Binary frames instead of lines.
    pub binary: bool,
    /// Seconds without an answer after which it is given up.
    pub timeout: f64,
}

/// One method, in one place, from one seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// The kind of work.
    pub kind: Kind,
    /// The method.
    pub method: String,
    /// Key of the random stream; of hunts that of the first.
    pub seed: u64,
    /// Only these regions, without check points and hard cases; all if there are none.
    pub regions: Vec<String>,
    /// Cases from a box.
    #[serde(rename = "box")]
    pub sides: Option<String>,
    /// Without the ends of the range.
    pub ordinary: bool,
    /// Cases of each region, of an audit or a candidate.
    pub cases: u64,
    /// These outputs only.
    pub outputs: Option<Vec<String>>,
    /// A user-supplied limit, as `ulps`, `relative` or `absolute`.
    pub limit: Option<(String, f64)>,
    /// A user-supplied limit for the norm.
    pub normwise: Option<f64>,
    /// In single precision.
    pub single: bool,
    /// The program, of a candidate.
    pub program: Option<Program>,
    /// The number of hunts.
    pub hunts: u64,
    /// Evaluations of each.
    pub evaluations: u64,
    /// Only rectangles in the binades below this, or inputs up to it in magnitude, of a proof.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub within: Option<f64>,
}

/// The work of a campaign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Its name.
    pub name: String,
    /// The parts, in the order of reports.
    pub parts: Vec<Part>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    seed: Option<u64>,
    part: Vec<FilePart>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FilePart {
    #[serde(default)]
    kind: Kind,
    methods: Vec<String>,
    seeds: Option<Vec<u64>>,
    #[serde(default)]
    regions: Vec<String>,
    #[serde(rename = "box")]
    sides: Option<String>,
    #[serde(default)]
    ordinary: bool,
    cases: Option<u64>,
    outputs: Option<Vec<String>>,
    ulps: Option<f64>,
    relative: Option<f64>,
    absolute: Option<f64>,
    normwise: Option<f64>,
    #[serde(default)]
    single: bool,
    exec: Option<String>,
    #[serde(default)]
    decimal: bool,
    #[serde(default)]
    binary: bool,
    timeout: Option<f64>,
    hunts: Option<u64>,
    evaluations: Option<u64>,
    within: Option<f64>,
}

impl Plan {
    /// Reads a plan and checks every part of it.
    ///
    /// # Errors
    /// [`PlanError`].
    ///
    /// ```
    /// use mechaudit_cli::campaign::Plan;
    /// use mechaudit_cli::machine::Source;
    /// let plan = Plan::read(&Source::toml(r#"
    ///     name = "small"
    ///     [[part]]
    ///     methods = ["erf", "erfc"]
    ///     regions = ["small"]
    ///     cases = 100
    /// "#))?;
    /// assert_eq!(plan.parts.len(), 2);
    /// # Ok::<(), mechaudit_cli::campaign::PlanError>(())
    /// ```
    pub fn read(source: &Source) -> Result<Plan, PlanError> {
        let file: File = source.parse()?;
        let mut parts = Vec::new();
        for (k, part) in file.part.iter().enumerate() {
            let bad = |why: String| PlanError::Part { part: k + 1, why };
            part.check().map_err(|why| bad(why.into()))?;
            let seeds = part.seeds.clone().unwrap_or(vec![file.seed.unwrap_or(1)]);
            for method in &part.methods {
                for seed in &seeds {
                    parts.push(part.part(method, *seed));
                    let last = parts.last().expect("one was pushed");
                    last.check().map_err(bad)?;
                }
            }
        }
        if parts.is_empty() {
            return Err(source.breach("part", "the plan has no parts").into());
        }
        Ok(Plan {
            name: file.name,
            parts,
        })
    }

    /// The parts of a plan that was read before, checked again.
    ///
    /// # Errors
    /// [`PlanError::Part`].
    pub fn check(&self) -> Result<(), PlanError> {
        for (k, part) in self.parts.iter().enumerate() {
            let bad = |why| PlanError::Part { part: k + 1, why };
            part.check().map_err(bad)?;
        }
        Ok(())
    }

    /// The methods of its parts.
    ///
    /// # Panics
    /// Of a plan that was not checked.
    pub fn methods(&self) -> Vec<Box<dyn Method>> {
        self.parts.iter().map(Part::method).collect()
    }

    /// SHA-256 of the plan in its one form, in hexadecimal.
    pub fn digest(&self) -> String {
        let text = serde_json::to_vec(self).expect("a plan is JSON");
        hex(&Sha256::digest(&text))
    }
}

/// Bytes in hexadecimal.
pub(super) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|b| format!("{b:02x}")).collect()
}

/// The method that a plan names; the file of a study by its whole path, so that shards find it
/// wherever they are run.
fn placed(method: &str) -> String {
    match crate::study::is_path(method) {
        true => std::path::absolute(method)
            .map_or_else(|_| method.into(), |p| p.to_string_lossy().into_owned()),
        false => method.into(),
    }
}

impl FilePart {
    fn check(&self) -> Result<(), &'static str> {
        let limits = [self.ulps, self.relative, self.absolute];
        let hunt = self.hunts.is_some() || self.evaluations.is_some();
        let spoken = self.decimal || self.binary || self.timeout.is_some();
        let good = |x: f64| x.is_finite() && x > 0.0;
        let rules = [
            (!self.methods.is_empty(), "methods = [] names none"),
            (self.seeds != Some(vec![]), "seeds = [] names none"),
            (
                limits.iter().flatten().count() <= 1,
                "ulps, relative and absolute exclude each other",
            ),
            (
                limits
                    .iter()
                    .chain([&self.normwise])
                    .flatten()
                    .all(|x| good(*x)),
                "a limit is finite and positive",
            ),
            (
                self.timeout.is_none_or(good),
                "timeout is a positive number of seconds",
            ),
            (
                !(self.decimal && self.binary),
                "decimal and binary exclude each other",
            ),
            (
                hunt == (self.kind == Kind::Hunt),
                "hunts and evaluations belong to kind = \"hunt\", which needs one of them",
            ),
            (
                self.exec.is_some() == (self.kind == Kind::Candidate),
                "exec belongs to kind = \"candidate\", which needs it",
            ),
            (
                self.exec.is_some() || !spoken,
                "decimal, binary and timeout belong to kind = \"candidate\"",
            ),
            (
                self.cases.is_some() == matches!(self.kind, Kind::Audit | Kind::Candidate),
                "cases belong to kind = \"audit\" and \"candidate\", which need them",
            ),
            (
                self.within.is_none() || self.kind == Kind::Proof,
                "within belongs to kind = \"proof\"",
            ),
            (self.within.is_none_or(good), "within is a positive number"),
            (
                self.kind != Kind::Proof || !self.chooses(),
                "a proof is of all inputs and outputs: of its keys it has methods and within alone",
            ),
            (
                self.kind != Kind::Hunt || self.sides.is_none(),
                "a hunt has no box",
            ),
            (
                [self.cases, self.hunts, self.evaluations]
                    .iter()
                    .flatten()
                    .all(|n| *n > 0),
                "cases, hunts and evaluations are 1 or more",
            ),
        ];
        let broken = rules.iter().find(|(holds, _)| !holds);
        broken.map_or(Ok(()), |(_, why)| Err(why))
    }

    /// Returns true if something is said that other kinds choose by.
    fn chooses(&self) -> bool {
        let limits = [self.ulps, self.relative, self.absolute, self.normwise];
        self.seeds.is_some()
            || !self.regions.is_empty()
            || self.sides.is_some()
            || self.ordinary
            || self.single
            || self.outputs.is_some()
            || limits.iter().any(Option::is_some)
    }

    fn part(&self, method: &str, seed: u64) -> Part {
        let limits = [
            ("ulps", self.ulps),
            ("relative", self.relative),
            ("absolute", self.absolute),
        ];
        let limit = limits
            .iter()
            .find_map(|(name, x)| Some((name.to_string(), (*x)?)));
        Part {
            kind: self.kind,
            method: placed(method),
            seed,
            regions: self.regions.clone(),
            sides: self.sides.clone(),
            ordinary: self.ordinary,
            cases: self.cases.unwrap_or(0),
            outputs: self.outputs.clone(),
            limit,
            normwise: self.normwise,
            single: self.single,
            program: self.exec.as_ref().map(|exec| Program {
                exec: exec.clone(),
                decimal: self.decimal,
                binary: self.binary,
                timeout: self.timeout.unwrap_or(60.0),
            }),
            hunts: match self.kind {
                Kind::Hunt => self.hunts.unwrap_or(1),
                _ => 0,
            },
            evaluations: match self.kind {
                Kind::Hunt => self.evaluations.unwrap_or(10_000),
                _ => 0,
            },
            within: self.within,
        }
    }
}

impl Part {
    /// Returns the method.
    ///
    /// # Panics
    /// If the plan was not checked and names no method.
    pub fn method(&self) -> Box<dyn Method> {
        crate::resolve(&self.method).expect("the plan was checked")
    }

    /// The settings of its audit.
    pub fn settings(&self) -> Settings {
        Settings {
            seed: self.seed,
            cases_per_region: self.cases,
            points: POINTS,
            ..Settings::default()
        }
    }

    /// The method as the part asks for it.
    ///
    /// # Errors
    /// A region, output or box that it does not have.
    pub fn variant<'a>(&self, method: &'a dyn Method) -> Result<Variant<'a>, VariantError> {
        let mut variant = Variant::new(method);
        if let Some(names) = &self.outputs {
            variant = variant.outputs(names)?;
        }
        if self.single {
            variant = variant.format(Format::Single);
        }
        if let Some((name, x)) = &self.limit {
            variant = variant.limit(match name.as_str() {
                "relative" => Limit::Relative(*x),
                "absolute" => Limit::Absolute(*x),
                _ => Limit::Ulps(*x),
            });
        }
        if let Some(r) = self.normwise {
            variant = variant.norm_limit(r);
        }
        if self.program.is_some() {
            variant = variant.without_laws();
        }
        if self.ordinary {
            variant = variant.ordinary();
        }
        for name in &self.regions {
            variant = variant.region(name)?;
        }
        if let Some(text) = &self.sides {
            let sides = SampleBox::read(&variant, text)?;
            variant = variant.sampling(Sampling::Box(sides));
        }
        Ok(variant)
    }

    fn check(&self) -> Result<(), String> {
        let method = crate::resolve(&self.method).map_err(|e| e.to_string())?;
        if matches!(self.kind, Kind::Audit | Kind::Hunt) && !method.has_solver() {
            let name = &self.method;
            return Err(format!(
                "{name} states no solver: give a program by kind = \"candidate\" and exec, or add \
                 [solver.NAME] to the file"
            ));
        }
        if self.kind == Kind::Proof {
            Units::of(self)?;
        }
        self.variant(&*method).map(drop).map_err(|e| e.to_string())
    }

    /// Returns the words that tell it from other parts of the same method.
    pub fn label(&self) -> String {
        let mut label = self.method.clone();
        if !self.regions.is_empty() {
            label += &format!(", {}", self.regions.join(", "));
        }
        if let Some(sides) = &self.sides {
            label += &format!(", {sides}");
        }
        if self.kind == Kind::Proof {
            return match self.within {
                Some(most) => label + &format!(", proof within {most}"),
                None => label + ", proof",
            };
        }
        label + &format!(", seed {}", self.seed)
    }

    /// Returns the options that a command needs, after the place of a case, to judge it again.
    pub fn tail(&self) -> String {
        let quoted = |text: &str| format!("'{}'", text.replace('\'', "'\\''"));
        let mut words = Vec::new();
        if let Some(program) = &self.program {
            words.push(format!("--exec {}", quoted(&program.exec)));
            words.extend(program.decimal.then(|| "--decimal".into()));
            words.extend(program.binary.then(|| "--binary".into()));
        }
        if let Some(names) = &self.outputs {
            words.push(format!("--outputs {}", quoted(&names.join(","))));
        }
        if let Some((name, x)) = &self.limit {
            words.push(format!("--{name} {x:?}"));
        }
        words.extend(self.normwise.map(|x| format!("--normwise {x:?}")));
        if self.sides.is_some() {
            words.extend(self.regions.iter().map(|r| format!("--region {r}")));
            words.extend(self.ordinary.then(|| "--ordinary".into()));
        }
        words.extend(self.single.then(|| "--single".into()));
        words.iter().map(|w| format!(" {w}")).collect()
    }
}

/// A name that a method does not have.
#[derive(Debug, thiserror::Error)]
pub enum VariantError {
    /// A region or output.
    #[error(transparent)]
    NoSuch(#[from] NoSuch),
    /// A box.
    #[error(transparent)]
    Sampling(#[from] SamplingError),
}

#[cfg(test)]
mod tests;
