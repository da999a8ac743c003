//! The findings of several hunts together.

use crate::audit::{Case, Hunt, Method, Origin, hex_float};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Inputs kept for each output, and failures kept.
const WORST: usize = 10;
const FAILURES: usize = 20;

/// Sums and worst inputs of hunts; adding is exact, in any order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HuntTally {
    /// Hunts.
    pub hunts: u64,
    /// Evaluations of all.
    pub evaluations: u64,
    /// Drawn inputs that fail without a share of a budget.
    pub failures: u64,
    /// The commands that judge the first of them again.
    first_failures: Vec<(u64, u64, String)>,
    /// For each output by its number, the largest shares first.
    worst: Vec<(usize, Vec<Worst>)>,
}

/// An input with a large share of an output's budget.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Worst {
    /// The complement of the share's bits, so that the largest comes first.
    order: u64,
    /// By their bits.
    input: Vec<u64>,
    /// The first of several that found it.
    seed: u64,
    reason: String,
}

impl Worst {
    fn share(&self) -> f64 {
        f64::from_bits(!self.order)
    }

    fn input(&self) -> Vec<f64> {
        self.input.iter().map(|b| f64::from_bits(*b)).collect()
    }
}

impl HuntTally {
    /// Adds the hunt of a seed.
    pub fn add(&mut self, method: &dyn Method, seed: u64, hunt: &Hunt) {
        let outputs = method.outputs();
        let worst = hunt.worst.iter().filter_map(|w| {
            let output = outputs.iter().position(|o| o.name == w.output)?;
            let found = Worst {
                // Shares are not negative, so their bits are in their order.
                order: !w.share.to_bits(),
                input: w.input.iter().map(|x| x.to_bits()).collect(),
                seed,
                reason: w.reason.clone(),
            };
            Some((output, vec![found]))
        });
        let failures = hunt.failures.iter().take(FAILURES).enumerate();
        self.merge(HuntTally {
            hunts: 1,
            evaluations: hunt.evaluations,
            failures: hunt.failures.len() as u64,
            first_failures: failures
                .map(|(k, case)| (seed, k as u64, case.reproduce()))
                .collect(),
            worst: worst.collect(),
        });
    }

    /// Adds what other hunts found.
    pub fn merge(&mut self, other: HuntTally) {
        self.hunts += other.hunts;
        self.evaluations += other.evaluations;
        self.failures += other.failures;
        self.first_failures.extend(other.first_failures);
        self.first_failures.sort();
        self.first_failures.truncate(FAILURES);
        for (output, found) in other.worst {
            let at = self.worst.binary_search_by_key(&output, |w| w.0);
            let at = at.unwrap_or_else(|at| {
                self.worst.insert(at, (output, Vec::new()));
                at
            });
            let own = &mut self.worst[at].1;
            own.extend(found);
            own.sort();
            own.dedup_by(|b, a| (a.order, &a.input) == (b.order, &b.input));
            own.truncate(WORST);
        }
    }

    /// Returns true if nothing is over budget but what is recorded of the method, and no drawn
    /// input fails.
    pub fn passed(&self, method: &dyn Method) -> bool {
        let all = self.worst(method);
        self.failures == 0 && !all.iter().any(|w| w.share > 1.0 && w.new)
    }

    /// The worst of each output.
    pub fn worst(&self, method: &dyn Method) -> Vec<WorstOf> {
        let outputs = method.outputs();
        let hard = method.hard();
        let all = self.worst.iter().filter_map(|(o, found)| {
            let output = outputs.get(*o)?.name;
            let before = hard.iter().filter(|h| h.output == output);
            let before = before.map(|h| h.share).fold(0.0, f64::max);
            Some(found.iter().map(move |w| WorstOf {
                output,
                share: w.share(),
                // As a hunt alone has it: a gain of less than a hundredth is none.
                new: w.share() > 1.01 * before,
                seed: w.seed,
                input: w.input(),
                reason: w.reason.clone(),
            }))
        });
        all.flatten().collect()
    }

    /// All of it.
    pub fn json(&self, method: &dyn Method) -> Value {
        let worst = self.worst(method).into_iter().map(|w| {
            let hex: Vec<String> = w.input.iter().map(|x| hex_float(*x)).collect();
            json!({
                "output": w.output,
                "share": w.share,
                "new": w.new,
                "seed": w.seed,
                "reason": w.reason,
                "input": w.input,
                "input_hexadecimal": hex,
                "reproduce": w.reproduce(method),
            })
        });
        json!({
            "method": method.name(),
            "passed": self.passed(method),
            "hunts": self.hunts,
            "evaluations": self.evaluations,
            "failures": self.failures,
            "first_failures": self.first_failures.iter().map(|f| &f.2).collect::<Vec<_>>(),
            "worst": worst.collect::<Vec<Value>>(),
        })
    }
}

/// An input with a large share of an output's budget.
#[derive(Clone, Debug, PartialEq)]
pub struct WorstOf {
    /// The output.
    pub output: &'static str,
    /// The share.
    pub share: f64,
    /// True if it is worse than what is recorded of the method.
    pub new: bool,
    /// The seed of the hunt.
    pub seed: u64,
    /// The input.
    pub input: Vec<f64>,
    /// The way it was found.
    pub reason: String,
}

impl WorstOf {
    /// A command that judges it again.
    pub fn reproduce(&self, method: &dyn Method) -> String {
        let case = Case {
            method: method.name(),
            region: "hunt",
            input: self.input.clone(),
            origin: Origin::Given,
        };
        case.reproduce()
    }
}

#[cfg(test)]
mod tests;
