//! What is better and worse since an earlier report, which comes as JSON.

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
    /// Whether that is less.
    pub better: bool,
}

/// What has changed since.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Changes {
    /// The figures, worse ones first.
    pub changes: Vec<Change>,
    /// What cannot be compared, and why.
    pub not_compared: Vec<String>,
}

/// A relative change of a statistic that is none.
const SAME: f64 = 1e-3;

impl Baseline {
    /// Reads one.
    ///
    /// # Errors
    /// What is no report of this form.
    pub fn read(text: &str) -> Result<Baseline, BaselineError> {
        let read: Document = serde_json::from_str(text)?;
        let due = super::json::SCHEMA_VERSION;
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

    /// What has changed in an audit.
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

    /// What has changed in a comparison, candidate by candidate.
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
            of_output("of budget", b.max_of_budget, o.max_of_budget);
            // Of other values, with more or fewer of the wrong kind, they mean nothing.
            if b.ulps.count == o.ulps.count {
                of_output("p99 ulps", b.ulps.p99, o.ulps.p99);
                of_output("RMS ulps", b.ulps.rms, o.ulps.rms);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::json;
    use crate::report::text::method::tests::{fabricated, passing};

    fn of(report: &MethodReport) -> Baseline {
        let text = json::document(std::slice::from_ref(report), false).to_string();
        Baseline::read(&text).unwrap()
    }

    #[test]
    fn what_has_changed() {
        let (mut before, after) = (fabricated(), fabricated());
        assert_eq!(
            of(&before).changes(std::slice::from_ref(&after)),
            Changes::default()
        );
        // One region was better in one statistic.
        before.regions[0].outputs[0].ulps.max = 5.0;
        let found = of(&before).changes(&[after]);
        let [change] = found.changes.as_slice() else {
            panic!("{found:?}");
        };
        assert_eq!((change.figure, change.better), ("worst ulps", false));
        assert_eq!(
            (change.region.as_str(), change.before, change.now),
            ("wide", 5.0, 7.25)
        );
        // All failures gone: better in each region and in all.
        let found = of(&fabricated()).changes(&[passing()]);
        assert_eq!(found.changes.len(), 3);
        assert!(
            found
                .changes
                .iter()
                .all(|c| c.better && c.figure == "failed")
        );
    }

    #[test]
    fn other_cases_are_not_compared() {
        let mut before = fabricated();
        before.settings.seed = 2;
        let found = of(&before).changes(&[fabricated()]);
        assert!(found.changes.is_empty() && found.not_compared[0].contains("--seed 2"));
        before = fabricated();
        before.method = "another";
        assert!(of(&before).changes(&[fabricated()]).not_compared[0].contains("not in"));
        for (text, part) in [
            ("{", "no report"),
            ("{\"schema_version\": 1}", "is 1, not 2"),
        ] {
            let e = Baseline::read(text).err().unwrap().to_string();
            assert!(e.contains(part), "{e}");
        }
    }

    /// Every figure of an output is compared.
    #[test]
    fn figures_that_change_are_named() {
        let changed = |change: fn(&mut crate::audit::OutputStatistics)| {
            let mut before = fabricated();
            change(&mut before.regions[0].outputs[0]);
            let found = of(&before).changes(&[fabricated()]).changes;
            let each = found.iter().map(|c| (c.figure, c.better));
            each.collect::<Vec<_>>()
        };
        assert_eq!(changed(|o| o.ulps.max *= 2.0), [("worst ulps", true)]);
        assert_eq!(changed(|o| o.max_of_budget *= 0.5), [("of budget", false)]);
        assert_eq!(changed(|o| o.ulps.p99 *= 2.0), [("p99 ulps", true)]);
        assert_eq!(changed(|o| o.ulps.rms *= 0.5), [("RMS ulps", false)]);
        // Of other values they mean nothing.
        let other = changed(|o| {
            o.ulps.count += 1;
            o.ulps.p99 *= 2.0;
        });
        assert_eq!(other, []);
    }

    fn named(report: &MethodReport, name: &str) -> MethodReport {
        let mut report = report.clone();
        report.candidate = Some(crate::audit::CandidateReport {
            name: name.into(),
            ..Default::default()
        });
        report
    }

    /// Of several of one method that of the same name, or without one; one alone whatever its name is.
    #[test]
    fn a_report_is_found_by_its_method_and_its_name() {
        let better = passing();
        let read = |reports: &[MethodReport]| {
            Baseline::read(&json::document(reports, false).to_string()).unwrap()
        };
        let changed = |before: &[MethodReport], now: &MethodReport| {
            let found = read(before).changes(std::slice::from_ref(now));
            (found.changes.len(), found.not_compared.len())
        };
        let mut another = fabricated();
        another.method = "another";
        let (own, a, b) = (fabricated(), named(&better, "a"), named(&better, "b"));
        let same = (0, 0);
        assert_eq!(
            changed(&[another.clone(), own.clone()], &fabricated()),
            same
        );
        assert_eq!(
            changed(std::slice::from_ref(&own), &named(&fabricated(), "a")),
            same
        );
        // Three regions have one failure more or less.
        assert_eq!(
            changed(&[own.clone(), a.clone(), b.clone()], &fabricated()),
            same
        );
        assert_eq!(
            changed(&[a.clone(), own.clone(), b.clone()], &named(&better, "b")),
            same
        );
        assert_eq!(
            changed(&[own.clone(), a.clone()], &named(&fabricated(), "a")),
            (3, 0)
        );
        assert_eq!(changed(&[own, a], &named(&better, "c")), (0, 1));
        assert_eq!(changed(&[another], &fabricated()), (0, 1));
    }

    #[test]
    fn a_comparison_goes_by_names() {
        let found = Comparison::new(
            "a-method",
            vec![(fabricated(), None), (named(&passing(), "other"), None)],
        );
        let text = json::comparison(&found, None).to_string();
        let same = Baseline::read(&text).unwrap().changes_of(&found);
        assert_eq!(same, Changes::default());
        let now = Comparison::new(
            "a-method",
            vec![(passing(), None), (named(&fabricated(), "other"), None)],
        );
        let changes = Baseline::read(&text).unwrap().changes_of(&now);
        assert!(changes.not_compared.is_empty());
        let [own, other] = [0, 1].map(|k| now.candidates[k].name.as_str());
        let seen: Vec<(&str, &str, f64, f64, bool)> = changes
            .changes
            .iter()
            .map(|c| (&*c.of, &*c.region, c.before, c.now, c.better))
            .collect();
        assert_eq!(
            seen,
            [
                (other, "wide", 0.0, 1.0, false),
                (other, "near", 0.0, 1.0, false),
                (other, "all", 0.0, 1.0, false),
                (own, "wide", 1.0, 0.0, true),
                (own, "near", 1.0, 0.0, true),
                (own, "all", 1.0, 0.0, true),
            ]
        );
        // An audit of the own code has no name to go by.
        let audits = [named(&passing(), "other"), fabricated()];
        let audit = json::document(&audits, false).to_string();
        let same = Baseline::read(&audit).unwrap().changes_of(&found);
        assert_eq!(same, Changes::default());
        let mut elsewhere = audits;
        elsewhere.iter_mut().for_each(|r| r.method = "another");
        let audit = json::document(&elsewhere, false).to_string();
        let none = Baseline::read(&audit).unwrap().changes_of(&found);
        let due = [own, other].map(|name| format!("{name}: not in the baseline"));
        assert_eq!(none.not_compared, due);
    }

    #[test]
    fn regions_are_compared_where_they_have_the_same_cases() {
        let mut before = fabricated();
        before.regions[0].cases = 399;
        before.regions[1].name = "nearer";
        let found = of(&before).changes(&[fabricated()]);
        assert_eq!(
            found.not_compared,
            [
                "a-method, wide: another number of cases",
                "a-method, near: not in the baseline"
            ]
        );
        assert!(found.changes.is_empty());
        before = fabricated();
        before.settings.cases_per_region += 1;
        let found = of(&before).changes(&[fabricated()]);
        let cases = before.settings.cases_per_region;
        let due = format!("a-method: the baseline has other cases, --seed 1 --cases {cases}");
        assert_eq!(found.not_compared, [due]);
    }

    /// A thousandth more or less is the same, either way round.
    #[test]
    fn small_changes_of_statistics_are_none() {
        let changed = |before: f64, now: f64| {
            let with = |max: f64| {
                let mut report = fabricated();
                report.regions[0].outputs[0].ulps.max = max;
                report
            };
            let found = of(&with(before)).changes(&[with(now)]).changes;
            found.iter().map(|c| c.better).collect::<Vec<_>>()
        };
        assert!(changed(1000.0, 1000.9).is_empty());
        assert!(changed(1000.9, 1000.0).is_empty());
        assert_eq!(changed(1000.0, 1001.1), [false]);
        assert_eq!(changed(1001.1, 1000.0), [true]);
        assert!(changed(0.0, 0.0).is_empty());
        assert_eq!(changed(0.0, 1e-9), [false]);
        assert!(changed(0.5, 0.5004).is_empty());
        assert!(changed(f64::INFINITY, f64::INFINITY).is_empty());
        assert_eq!(changed(f64::INFINITY, 1.0), [true]);
        assert_eq!(changed(1.0, f64::INFINITY), [false]);
    }

    #[test]
    fn failures_and_wrong_kinds_are_counted() {
        let seen = |change: fn(&mut MethodReport)| {
            let mut before = fabricated();
            change(&mut before);
            let found = of(&before).changes(&[fabricated()]).changes;
            let each = found
                .into_iter()
                .map(|c| (c.region, c.figure, c.before, c.now));
            each.collect::<Vec<_>>()
        };
        // Of 400 cases 390 pass and seven are recorded.
        let failed = seen(|r| (r.regions[0].passed, r.regions[0].recorded) = (390, 7));
        assert_eq!(failed, [("wide".into(), "failed", 3.0, 1.0)]);
        let wrong = seen(|r| {
            r.total.kinds[crate::audit::Kind::Nan] = 2;
            r.total.kinds[crate::audit::Kind::Infinity] = 1;
        });
        assert_eq!(wrong, [("all".into(), "wrong in kind", 3.0, 0.0)]);
        // An output that was not there before has nothing to be compared with.
        assert_eq!(seen(|r| r.regions[0].outputs[0].name = "p"), []);
    }
}
