//! The changes since an earlier report, which comes as JSON.

use crate::audit::{Comparison, MethodReport, RegionReport};
use serde::{Deserialize, Serialize};

/// No report to compare with.
#[derive(Debug, thiserror::Error)]
pub enum BaselineError {
    /// Not JSON, or not that of a report.
    #[error("it is no report of audit or compare in JSON: {0}")]
    Syntax(#[from] serde_json::Error),
    /// Of an earlier or later form.
    #[error("its schema_version is {found}, not {due}")]
    Version {
        /// That of the file.
        found: u64,
        /// The one that is read.
        due: u32,
    },
}

#[derive(Deserialize)]
struct Document {
    schema_version: u64,
    #[serde(default)]
    methods: Vec<Method>,
    #[serde(default)]
    candidates: Vec<Listed>,
}

/// A candidate of a comparison.
#[derive(Deserialize)]
struct Listed {
    name: String,
    report: Method,
}

#[derive(Deserialize)]
struct Method {
    method: String,
    candidate: Option<Name>,
    settings: Run,
    total: Region,
    regions: Vec<Region>,
}

#[derive(Deserialize)]
struct Name {
    name: String,
}

#[derive(Deserialize, PartialEq)]
struct Run {
    seed: u64,
    cases_per_region: u64,
}

#[derive(Deserialize)]
struct Region {
    name: String,
    cases: u64,
    passed: u64,
    recorded: u64,
    kinds: std::collections::BTreeMap<String, u64>,
    outputs: Vec<Output>,
}

#[derive(Deserialize)]
struct Output {
    name: String,
    ulps: Spread,
    max_of_budget: Option<f64>,
}

#[derive(Deserialize)]
struct Spread {
    count: u64,
    max: Option<f64>,
    p99: Option<f64>,
    rms: Option<f64>,
}

/// A report of an earlier run.
pub struct Baseline {
    /// With the names of a comparison.
    methods: Vec<(Option<String>, Method)>,
}

/// A figure that has changed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    /// The code: the name in a comparison, else the method.
    pub of: String,
    /// The region; `all` for all of them.
    pub region: String,
    /// The output, if it is about one.
    pub output: Option<String>,
    /// Which figure: `failed`, `wrong in kind`, `worst ulps`, `p99 ulps`, `RMS ulps`, `of budget`.
    pub figure: &'static str,
    /// Before.
    pub before: f64,
    /// Now.
    pub now: f64,
    /// True if that is less.
    pub better: bool,
}

/// The changes since then.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Changes {
    /// The figures, worse ones first.
    pub changes: Vec<Change>,
    /// Parts that cannot be compared, with the reasons.
    pub not_compared: Vec<String>,
}

/// A relative change of a statistic that is none.
const SAME: f64 = 1e-3;

impl Baseline {
    /// Reads one.
    ///
    /// # Errors
    /// The fault of a file that is no report of this form.
    pub fn read(text: &str) -> Result<Baseline, BaselineError> {
        let read: Document = serde_json::from_str(text)?;
        let due = super::SCHEMA_VERSION;
        if read.schema_version != u64::from(due) {
            let found = read.schema_version;
            return Err(BaselineError::Version { found, due });
        }
        let of_audit = read.methods.into_iter();
        let of_audit = of_audit.map(|m| (m.candidate.as_ref().map(|c| c.name.clone()), m));
        let compared = read.candidates.into_iter();
        let compared = compared.map(|c| (Some(c.name), c.report));
        Ok(Baseline {
            methods: of_audit.chain(compared).collect(),
        })
    }

    /// The changes in an audit.
    pub fn changes(&self, reports: &[MethodReport]) -> Changes {
        let mut all = Changes::default();
        for report in reports {
            let name = report.candidate.as_ref().map(|c| c.name.as_str());
            let same = |m: &&(Option<String>, Method)| m.1.method == report.method;
            // The candidate may have been renamed; of one method there is one in an audit.
            let named = self.methods.iter().filter(same);
            let named: Vec<&(Option<String>, Method)> = named.collect();
            let before = match named.as_slice() {
                [only] => Some(*only),
                several => several.iter().copied().find(|m| m.0.as_deref() == name),
            };
            all.add(report.method, before.map(|m| &m.1), report);
        }
        all.sorted()
    }

    /// The changes in a comparison, candidate by candidate.
    pub fn changes_of(&self, found: &Comparison) -> Changes {
        let mut all = Changes::default();
        for c in &found.candidates {
            let named = |name: &Option<String>| match name {
                Some(name) => *name == c.name,
                None => c.report.candidate.is_none(),
            };
            let mut of = self.methods.iter().filter(|m| m.1.method == found.method);
            all.add(&c.name, of.find(|m| named(&m.0)).map(|m| &m.1), &c.report);
        }
        all.sorted()
    }
}

impl Changes {
    fn sorted(mut self) -> Changes {
        self.changes.sort_by_key(|c| c.better);
        self
    }

    fn add(&mut self, of: &str, before: Option<&Method>, now: &MethodReport) {
        let Some(before) = before else {
            self.not_compared.push(format!("{of}: not in the baseline"));
            return;
        };
        let run = Run {
            seed: now.settings.seed,
            cases_per_region: now.settings.cases_per_region,
        };
        if before.settings != run {
            let Run {
                seed,
                cases_per_region,
            } = before.settings;
            self.not_compared.push(format!(
                "{of}: the baseline has other cases, --seed {seed} --cases {cases_per_region}"
            ));
            return;
        }
        for region in now.regions.iter().chain([&now.total]) {
            let mut all = before.regions.iter().chain([&before.total]);
            match all.rfind(|r| r.name == region.name) {
                Some(earlier) if earlier.cases == region.cases => self.region(of, earlier, region),
                Some(_) => self
                    .not_compared
                    .push(format!("{of}, {}: another number of cases", region.name)),
                None => self
                    .not_compared
                    .push(format!("{of}, {}: not in the baseline", region.name)),
            }
        }
    }

    fn region(&mut self, of: &str, before: &Region, now: &RegionReport) {
        let mut figure = |output: Option<&str>, figure, a: Option<f64>, b: f64, same: f64| {
            // Nothing stands for what is beyond all numbers.
            let a = a.unwrap_or(f64::INFINITY);
            // Strictly: of an infinity every part is one.
            if a == b || (a - b).abs() < same * a.abs().max(b.abs()) {
                return;
            }
            self.changes.push(Change {
                of: of.into(),
                region: now.name.into(),
                output: output.map(Into::into),
                figure,
                before: a,
                now: b,
                better: b < a,
            });
        };
        let failed = before.cases - before.passed - before.recorded;
        figure(
            None,
            "failed",
            Some(failed as f64),
            now.failed() as f64,
            0.0,
        );
        let wrong: u64 = before.kinds.values().sum();
        let total = now.kinds.total() as f64;
        figure(None, "wrong in kind", Some(wrong as f64), total, 0.0);
        for o in &now.outputs {
            let Some(b) = before.outputs.iter().find(|b| b.name == o.name) else {
                continue;
            };
            let mut of_output = |what, a, b| figure(Some(o.name), what, a, b, SAME);
            of_output("worst ulps", b.ulps.max, o.ulps.max);
            // Without a measured error on either side there is no share.
            let measured = b.max_of_budget.is_some() || b.ulps.count > 0;
            if measured && !o.max_of_budget.is_nan() {
                of_output("of budget", b.max_of_budget, o.max_of_budget);
            }
            // Of other values, with more or fewer of the wrong kind, they mean nothing.
            if b.ulps.count == o.ulps.count {
                of_output("p99 ulps", b.ulps.p99, o.ulps.p99);
                of_output("RMS ulps", b.ulps.rms, o.ulps.rms);
            }
        }
    }
}

#[cfg(test)]
mod tests;
