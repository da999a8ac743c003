//! Hunting for the worst inputs: seeds from the domain, then a climb by small moves.

use super::answer::SolverAnswer;
use super::case::{Case, Cases, Origin};
use super::domain::Draw;
use super::judge::Verdict;
use super::judged::{answer_of, judge_case_briefly};
use super::method::Method;
use super::settings::Settings;
use super::ulp::Format;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};

/// The resources of a hunt.
#[derive(Clone, Copy, Debug)]
pub struct HuntSettings {
    /// Evaluations of solver and reference together.
    pub evaluations: u64,
    /// Key of the random stream.
    pub seed: u64,
}

/// The worst input found for one output.
#[derive(Clone, Debug)]
pub struct Worst {
    /// The output.
    pub output: &'static str,
    /// Its largest share of the budget there.
    pub share: f64,
    /// The input.
    pub input: Vec<f64>,
    /// Where the climb began and how it got there.
    pub reason: String,
}

/// The findings of a hunt.
#[derive(Clone, Debug)]
pub struct Hunt {
    /// For each output that was judged anywhere, the worst first.
    pub worst: Vec<Worst>,
    /// Inputs with no pass and no share: NaN, a refusal where values exist; of those that were drawn
    /// and not climbed to also what is undecided.
    pub failures: Vec<Case>,
    /// Evaluations made.
    pub evaluations: u64,
    /// True if the hunt was ended before all its evaluations.
    pub interrupted: bool,
}

/// Inputs judged between two looks at the progress.
const TOGETHER: usize = 256;
/// Moves tried at once from one place.
const MOVES: usize = 16;
/// The same where answers come from elsewhere, for instance from a program that is started for each
/// batch.
const TOGETHER_ELSEWHERE: usize = 4096;
const MOVES_ELSEWHERE: usize = 64;
/// Climbs that the evaluations are divided among, or one for each output if there are more.
const STARTS: usize = 12;
/// The factor by which there are more places to climb from: a climb that ends early leaves its evaluations.
const ROUNDS: usize = 20;
/// Rounds without gain after which a climb ends.
const PATIENCE: usize = 10;
/// The factor by which a coordinate may leave its seed: regions bound the inputs of a budget.
const REACH: f64 = 4.0;

/// A judged input.
#[derive(Clone)]
struct Found {
    input: Vec<f64>,
    /// Largest share for each output; nothing where no values were judged.
    shares: Option<Vec<f64>>,
    verdict: Verdict,
    /// True if the solver refused the input.
    refused: bool,
}

impl Found {
    /// Returns true if it counts as a failure wherever it is found. A refusal counts among the cases
    /// of a region only: beyond them a solver may have limits of its own.
    fn fails_anywhere(&self) -> bool {
        self.verdict == Verdict::WrongKind && !self.refused
    }

    /// The share of one output; below every other where no values were judged.
    fn share(&self, output: usize) -> f64 {
        self.shares.as_ref().map_or(-1.0, |s| s[output])
    }
}

/// A place to climb from.
#[derive(Clone)]
struct Seed {
    found: Found,
    kind: &'static str,
    region: &'static str,
}

/// Answers to inputs, one for each and in their order; fewer end the hunt.
pub type Answers<'a> = dyn Fn(&[Vec<f64>]) -> Vec<SolverAnswer> + 'a;

struct Hunter<'a> {
    method: &'a dyn Method,
    /// In place of those of the method's own solver.
    answers: Option<&'a Answers<'a>>,
    outputs: Vec<&'static str>,
    settings: Settings,
    left: u64,
    made: u64,
    worst: Vec<Option<Worst>>,
    failures: Vec<Case>,
    progress: &'a (dyn Fn(u64) + Sync),
    stop: &'a AtomicBool,
}

/// Hunts for the inputs where the method's solver takes up most of its budget. Deterministic for a
/// seed. `progress` is told how many evaluations were made.
pub fn hunt(method: &dyn Method, settings: &HuntSettings, progress: &(dyn Fn(u64) + Sync)) -> Hunt {
    hunt_until(method, settings, progress, &AtomicBool::new(false))
}

/// [`hunt`], ended early once `stop` is set: what was found until then.
pub fn hunt_until(
    method: &dyn Method,
    settings: &HuntSettings,
    progress: &(dyn Fn(u64) + Sync),
    stop: &AtomicBool,
) -> Hunt {
    search(method, settings, &[], None, progress, stop)
}

/// [`hunt_until`], which begins at given inputs too: the first of them, up to a third of the
/// evaluations.
pub fn hunt_from(
    method: &dyn Method,
    settings: &HuntSettings,
    given: &[Vec<f64>],
    progress: &(dyn Fn(u64) + Sync),
    stop: &AtomicBool,
) -> Hunt {
    search(method, settings, given, None, progress, stop)
}

/// [`hunt_until`], judging answers from elsewhere in place of those of the method's own solver.
pub fn hunt_answers(
    method: &dyn Method,
    settings: &HuntSettings,
    answers: &Answers,
    progress: &(dyn Fn(u64) + Sync),
    stop: &AtomicBool,
) -> Hunt {
    search(method, settings, &[], Some(answers), progress, stop)
}

fn search(
    method: &dyn Method,
    settings: &HuntSettings,
    given: &[Vec<f64>],
    answers: Option<&Answers>,
    progress: &(dyn Fn(u64) + Sync),
    stop: &AtomicBool,
) -> Hunt {
    let outputs: Vec<&'static str> = method.outputs().iter().map(|o| o.name).collect();
    let mut hunter = Hunter {
        method,
        answers,
        worst: vec![None; outputs.len()],
        failures: Vec::new(),
        outputs,
        settings: Settings {
            seed: settings.seed,
            ..Settings::default()
        },
        left: settings.evaluations,
        made: 0,
        progress,
        stop,
    };
    let seeds = hunter.seeds(settings.evaluations / 3, given);
    let starts = choose(&seeds, hunter.outputs.len());
    let share = hunter.left / STARTS.max(hunter.outputs.len()) as u64;
    for (k, (start, output)) in starts.iter().enumerate() {
        let mut draw = Draw::new(settings.seed, method.stream(), "climb", k as u64);
        hunter.climb(start, *output, share.max(1), &mut draw);
    }
    let mut worst: Vec<Worst> = hunter.worst.into_iter().flatten().collect();
    worst.sort_by(|a, b| b.share.total_cmp(&a.share));
    Hunt {
        worst,
        failures: hunter.failures,
        evaluations: hunter.made,
        interrupted: stop.load(Ordering::Relaxed),
    }
}

/// Where to climb from and for which output: in turn the worst seed for each output, from the
/// region that was chosen least for it before.
fn choose(seeds: &[Seed], outputs: usize) -> Vec<(Seed, usize)> {
    let mut taken = vec![vec![false; seeds.len()]; outputs];
    let mut met: Vec<HashMap<&str, usize>> = vec![HashMap::new(); outputs];
    let mut chosen = Vec::new();
    for o in (0..outputs).cycle().take(ROUNDS * STARTS.max(outputs)) {
        let rank = |i: usize| {
            let times = met[o].get(seeds[i].region).copied().unwrap_or(0);
            (std::cmp::Reverse(times), seeds[i].found.share(o))
        };
        let best = (0..seeds.len()).filter(|i| !taken[o][*i]).max_by(|a, b| {
            let ((a, x), (b, y)) = (rank(*a), rank(*b));
            a.cmp(&b).then(x.total_cmp(&y))
        });
        let Some(best) = best else { break };
        taken[o][best] = true;
        *met[o].entry(seeds[best].region).or_default() += 1;
        chosen.push((seeds[best].clone(), o));
    }
    chosen
}

impl Hunter<'_> {
    /// Judges inputs on all cores, as many as may still be judged: the first ones.
    fn judge(&mut self, mut inputs: Vec<Vec<f64>>) -> Vec<Found> {
        inputs.truncate(self.left.min(usize::MAX as u64) as usize);
        let (method, settings, outputs) = (self.method, &self.settings, self.outputs.len());
        let mut all = Vec::with_capacity(inputs.len());
        let together = match self.answers {
            Some(_) => TOGETHER_ELSEWHERE,
            None => TOGETHER,
        };
        for part in inputs.chunks(together) {
            if self.stop.load(Ordering::Relaxed) {
                self.left = 0;
                break;
            }
            let judge =
                |input: &Vec<f64>, answer| judged(method, settings, outputs, input.clone(), answer);
            let answered = match self.answers {
                Some(answers) => {
                    let answers = answers(part);
                    let answered = answers.len().min(part.len());
                    let pairs = part.par_iter().zip(answers);
                    all.par_extend(pairs.map(|(input, answer)| judge(input, answer)));
                    answered
                }
                None => {
                    let own = |input: &Vec<f64>| judge(input, answer_of(method, input));
                    all.par_extend(part.par_iter().map(own));
                    part.len()
                }
            };
            self.left -= part.len() as u64;
            self.made += answered as u64;
            (self.progress)(self.made);
            if answered < part.len() {
                self.left = 0;
                break;
            }
        }
        all
    }

    /// A case that was not drawn.
    fn given(&self, region: &'static str, input: Vec<f64>) -> Case {
        Case {
            method: self.method.name(),
            region,
            input,
            origin: Origin::Given,
        }
    }

    /// Remembers what is worse than anything before.
    fn record(&mut self, found: &Found, reason: &dyn Fn() -> String) {
        for (o, share) in found.shares.iter().flatten().enumerate() {
            if self.worst[o].as_ref().is_none_or(|w| *share > w.share) {
                self.worst[o] = Some(Worst {
                    output: self.outputs[o],
                    share: *share,
                    input: found.input.clone(),
                    reason: reason(),
                });
            }
        }
    }

    /// Seeds of every kind.
    fn seeds(&mut self, budget: u64, given: &[Vec<f64>]) -> Vec<Seed> {
        let regions = self.method.domain().regions.len().max(1) as u64;
        self.settings.cases_per_region = (budget / (3 * regions)).max(2);
        let cases = Cases::new(self.method, &self.settings);
        let going_on = |_: &usize| !self.stop.load(Ordering::Relaxed);
        let numbers = (0..cases.len()).take_while(going_on);
        let drawn: Vec<Case> = numbers.map(|i| cases.get(i)).collect();
        // Chosen among those of the first region, by their shares.
        let regions = &self.method.domain().regions;
        let region = regions.first().map_or("the domain", |r| r.name);
        let given = given.iter().take(budget.min(usize::MAX as u64) as usize);
        let given = given.map(|input| self.given(region, input.clone()));
        let mut all: Vec<(Case, &'static str)> = given.map(|case| (case, "given")).collect();
        for (k, case) in drawn.iter().enumerate() {
            let kind = match case.origin {
                Origin::CheckPoint { .. } => "check point",
                Origin::Hard { .. } => "hard case",
                _ if case.region.starts_with("seam") => "seam",
                _ => "random",
            };
            all.push((case.clone(), kind));
            let mut draw = Draw::new(self.settings.seed, case.method, "edge", k as u64);
            all.push((
                self.given(case.region, edge(&case.input, &mut draw)),
                "edge",
            ));
            // Between this input and the next of the same region and layout.
            if let Some(next) = drawn.get(k + 1)
                && next.region == case.region
                && next.input.len() == case.input.len()
            {
                let share = (k % 7 + 1) as f64 / 8.0;
                let pairs = case.input.iter().zip(&next.input);
                let between = pairs.map(|(a, b)| a + share * (b - a)).collect();
                all.push((self.given(case.region, between), "spaced"));
            }
        }
        let format = self.method.format();
        all.iter_mut()
            .for_each(|(case, _)| format.represent(&mut case.input));
        all.retain(|(case, _)| self.method.admits(&case.input));
        let found = self.judge(all.iter().map(|(case, _)| case.input.clone()).collect());
        let mut seeds = Vec::new();
        for ((case, kind), found) in all.into_iter().zip(found) {
            let drawn = !matches!(kind, "edge" | "spaced" | "given");
            if found.shares.is_some() {
                self.record(&found, &|| format!("{kind} in {}", case.region));
                let region = case.region;
                seeds.push(Seed {
                    found,
                    kind,
                    region,
                });
            } else if found.fails_anywhere() || drawn && found.verdict != Verdict::Pass {
                self.failures.push(case);
            }
        }
        seeds
    }

    /// Climbs from a seed for one output with that many evaluations.
    fn climb(&mut self, seed: &Seed, output: usize, evaluations: u64, draw: &mut Draw) {
        let end = self.left.saturating_sub(evaluations);
        let mut top = seed.found.clone();
        let mut without = 0;
        let moves = match self.answers {
            Some(_) => MOVES_ELSEWHERE,
            None => MOVES,
        };
        while self.left > end && without < PATIENCE {
            // In a format of fewer bits most moves by bits lead nowhere.
            let format = self.method.format();
            let next = |_| {
                let mut x = moved(&top.input, draw);
                format.represent(&mut x);
                (format == Format::Double || x != top.input).then_some(x)
            };
            let inputs: Vec<Vec<f64>> = (0..8 * moves)
                .filter_map(next)
                .filter(|x| within_reach(&seed.found.input, x) && self.method.admits(x))
                .take(moves.min((self.left - end) as usize))
                .collect();
            if inputs.is_empty() {
                return;
            }
            let found = self.judge(inputs);
            let before = top.share(output);
            for f in found {
                let reason = || format!("climbed from {} in {}", seed.kind, seed.region);
                self.record(&f, &reason);
                if f.fails_anywhere() {
                    self.failures.push(self.given(seed.region, f.input.clone()));
                }
                if f.share(output) >= top.share(output) {
                    top = f;
                }
            }
            without = if top.share(output) > before {
                0
            } else {
                without + 1
            };
        }
    }
}

fn judged(
    method: &dyn Method,
    settings: &Settings,
    outputs: usize,
    input: Vec<f64>,
    answer: SolverAnswer,
) -> Found {
    let case = Case {
        method: method.name(),
        region: "hunt",
        input,
        origin: Origin::Given,
    };
    let refused = matches!(answer, SolverAnswer::Refuses(_) | SolverAnswer::Declines(_));
    let report = judge_case_briefly(method, case, answer, settings);
    let components = &report.judgement.components;
    let kinds = [Verdict::Pass, Verdict::Over];
    let shares = (!components.is_empty() && kinds.contains(&report.judgement.verdict)).then(|| {
        let mut shares = vec![0.0f64; outputs];
        for (i, c) in components.iter().enumerate() {
            shares[i % outputs] = shares[i % outputs].max(c.of_budget);
        }
        shares
    });
    Found {
        input: report.case.input,
        shares,
        verdict: report.judgement.verdict,
        refused,
    }
}

/// One coordinate with few significant bits, or next to such a number.
fn edge(x: &[f64], draw: &mut Draw) -> Vec<f64> {
    let mut x = x.to_vec();
    let k = draw.integer(0, x.len().max(1) - 1);
    if let Some(v) = x.get_mut(k).filter(|v| v.is_finite()) {
        let kept = draw.integer(0, 8) as u32;
        let bits = v.to_bits() & !((1 << (52 - kept)) - 1);
        *v = f64::from_bits(bits);
        match draw.integer(0, 2) {
            0 => *v = v.next_up(),
            1 => *v = v.next_down(),
            _ => {}
        }
    }
    x
}

/// Moves a number by that many neighbours.
fn by_bits(v: &mut f64, by: i64) {
    if v.is_finite() {
        *v = f64::from_bits(v.to_bits().wrapping_add_signed(by));
    }
}

/// A neighbour: some bits of one coordinate or of all, a factor near one, or fewer bits.
fn moved(x: &[f64], draw: &mut Draw) -> Vec<f64> {
    let mut y = x.to_vec();
    let Some(last) = y.len().checked_sub(1) else {
        return y;
    };
    let k = draw.integer(0, last);
    match draw.integer(0, 9) {
        0..=4 => {
            let size = draw.integer(0, 44) as i32;
            let size = draw.signed(2f64.powi(size));
            by_bits(&mut y[k], size as i64);
        }
        5 | 6 => y
            .iter_mut()
            .for_each(|v| by_bits(v, draw.integer(0, 8) as i64 - 4)),
        7 | 8 => {
            let reach = draw.log_uniform(1e-12, 0.5);
            y[k] *= 1.0 + draw.signed(reach);
        }
        _ => y = edge(&y, draw),
    }
    y
}

/// Returns true if every coordinate keeps its sign and is within a factor of its seed's; zeros
/// stay.
fn within_reach(seed: &[f64], x: &[f64]) -> bool {
    let near = |(s, x): (&f64, &f64)| match *s {
        0.0 => *x == 0.0,
        s => x.is_finite() && (1.0 / REACH..=REACH).contains(&(x / s)),
    };
    seed.len() == x.len() && seed.iter().zip(x).all(near)
}

#[cfg(test)]
mod tests;
