//! The errors of codes at the same points, region by region.

use super::breaks::breaks;
use super::code::Code;
use super::effort::Effort;
use super::heights::{Height, heights};
use super::lines::{self, HartmannTran};
use super::seams::{Jump, jumps};
use super::{WHOLE, measured, regions, rounded};
use crate::audit::{
    Case, Cases, Method, MethodReport, Region, RegionReport, Settings, SolverAnswer, Tally,
    judge_together,
};
use crate::methods::find;
use mechaudit_atlas::{Parts, Plane};
use num_complex::{Complex, Complex32};
use serde::Serialize;
use std::f64::consts::FRAC_2_SQRT_PI;

/// Half an ulp of 1.
const U: f64 = 1.0 / (1u64 << 53) as f64;
/// That of single precision.
const U_SINGLE: f64 = 1.0 / (1u64 << 24) as f64;

/// Relative errors of the norm in a region.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Figures {
    /// The largest found.
    pub worst: f64,
    /// 99 % are below.
    pub p99: f64,
    /// Half are below.
    pub median: f64,
}

/// Describes what was found in a region.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Part {
    /// The region; `all` for all of them.
    pub region: &'static str,
    /// Points judged.
    pub cases: u64,
    /// Of the norm; nothing where no answer was a number.
    pub norm: Option<Figures>,
    /// The largest relative error of Re w found.
    pub re: Option<f64>,
    /// That of Im w.
    pub im: Option<f64>,
    /// NaN, infinities where numbers are due.
    pub wrong: u64,
    /// Answers with Re w < 0 above or on the real axis, where Re w > 0.
    pub negative: u64,
    /// The point with the largest error of a part.
    pub worst_at: Option<Vec<f64>>,
}

/// Describes what was found about a code.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Its name.
    pub name: String,
    /// Holds what it is.
    pub title: String,
    /// The paper, or the version.
    pub source: String,
    /// Tells whether it is defined below the real axis.
    pub whole_plane: bool,
    /// Tells whether it gives Re w alone.
    pub real_part_only: bool,
    /// Single precision.
    pub single: bool,
    /// Region by region, all of them last.
    pub parts: Vec<Part>,
    /// Of `w' = −2zw + 2i/√π` with its w, relative to |w'|, in the ordinary region.
    pub derivative: Option<Figures>,
    /// Where it reaches which accuracy.
    pub heights: Vec<Height>,
    /// Where its formulas meet.
    pub jumps: Vec<Jump>,
    /// Nanoseconds a value, all codes in one run; not measured of programs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nanoseconds: Option<f64>,
}

impl Row {
    /// Of a code, with nothing but what was found in regions.
    fn new(code: &Code, parts: Vec<Part>) -> Row {
        Row {
            name: code.name.clone(),
            title: code.title.clone(),
            source: code.source.clone(),
            whole_plane: code.plane == Plane::Whole,
            real_part_only: code.parts == Parts::Real,
            single: code.single,
            parts,
            derivative: None,
            heights: Vec::new(),
            jumps: Vec::new(),
            nanoseconds: code.nanoseconds,
        }
    }

    /// Returns what was found in a region.
    pub fn part(&self, region: &str) -> Option<&Part> {
        self.parts.iter().find(|p| p.region == region)
    }
}

/// Surveys them. `step` is called when something is done, with a word for it.
pub fn survey(codes: &[Code], effort: &Effort, step: &dyn Fn(&str)) -> Vec<Row> {
    let settings = effort.settings(1);
    let mut rows: Vec<Option<Row>> = codes.iter().map(|_| None).collect();
    for (parts, single) in [
        (Parts::Both, false),
        (Parts::Real, false),
        (Parts::Both, true),
    ] {
        let own: Vec<usize> = (0..codes.len())
            .filter(|&k| codes[k].parts == parts && codes[k].single == single)
            .collect();
        if own.is_empty() {
            continue;
        }
        let group: Vec<&Code> = own.iter().map(|&k| &codes[k]).collect();
        let regions = match single {
            true => regions::of_single(),
            false => [regions::upper(), regions::lower()].concat(),
        };
        let method = find("faddeeva").expect("a method of the registry");
        let judged = judged(&*method, &group, &regions, &settings, &above, &|_, w| w);
        step("values");
        let slopes = match parts {
            Parts::Both => {
                let ordinary = vec![regions::upper().swap_remove(0)];
                let slopes = judged_slopes(&group, ordinary, &settings);
                slopes.into_iter().map(Some).collect()
            }
            Parts::Real => vec![None; group.len()],
        };
        step("derivatives");
        let heights = heights(&group, effort);
        step("heights");
        let all = own.iter().zip(group).zip(judged).zip(slopes).zip(heights);
        for ((((&k, code), (report, negative)), slope), heights) in all {
            let unit = if single { U_SINGLE } else { U };
            let known = code.algorithm.filter(|a| a.formula.is_some());
            let jumps = match known {
                _ if single => Vec::new(),
                Some(a) => jumps(&a, effort.seed),
                None => breaks(code, effort.seed),
            };
            rows[k] = Some(Row {
                derivative: slope.and_then(|r| norm(&r.total, unit)),
                heights,
                jumps,
                ..Row::new(code, figures(&report, &negative, unit))
            });
        }
        step("seams");
    }
    rows.into_iter().flatten().collect()
}

/// Returns whether a code is asked there.
fn above(code: &Code, z: &[f64]) -> bool {
    code.plane == Plane::Whole || z[1] >= 0.0
}

/// The same of profiles, over lines.
pub fn survey_lines(codes: &[Code], effort: &Effort) -> Vec<Row> {
    let settings = effort.settings(1);
    let group: Vec<&Code> = codes.iter().collect();
    let own = |code: &Code, p: &[f64]| code.plane == Plane::Whole || lines::simple(p);
    let judged = judged(
        &HartmannTran,
        &group,
        &lines::regions(),
        &settings,
        &own,
        &|_, w| w,
    );
    let rows = codes.iter().zip(judged);
    rows.map(|(code, (report, negative))| Row::new(code, figures(&report, &negative, U)))
        .collect()
}

/// Describes what a point and the code's w make its answer.
type Turned<'a> = dyn Fn(&[f64], SolverAnswer) -> SolverAnswer + 'a;

/// For each code its report and how often Re w was negative, by region.
fn judged(
    method: &dyn Method,
    codes: &[&Code],
    regions: &[Region],
    settings: &Settings,
    own: &dyn Fn(&Code, &[f64]) -> bool,
    turned: &Turned,
) -> Vec<(MethodReport, Vec<(&'static str, u64)>)> {
    const CHUNK: usize = 4096;
    let variant = measured(method, codes.first().copied()).placed(regions.to_vec(), |_| true);
    let cases = Cases::new(&variant, settings);
    let mut tallies = vec![Tally::new(&variant, settings); codes.len()];
    let mut negative: Vec<Vec<(&'static str, u64)>> = vec![Vec::new(); codes.len()];
    for from in (0..cases.len()).step_by(CHUNK) {
        let to = cases.len().min(from + CHUNK);
        let mut batch: Vec<(Case, Vec<Option<SolverAnswer>>)> =
            (from..to).map(|i| (cases.get(i), Vec::new())).collect();
        for (k, code) in codes.iter().enumerate() {
            let own = |z: &[f64]| own(code, z);
            let inputs: Vec<Vec<f64>> = batch
                .iter()
                .map(|(case, _)| case.input.clone())
                .filter(|z| own(z))
                .collect();
            let mut answers = code.answers(&inputs).into_iter();
            for (case, all) in &mut batch {
                let missing = || SolverAnswer::Unanswered("the program ended before".into());
                let answer = own(&case.input).then(|| answers.next().unwrap_or_else(missing));
                if let Some(SolverAnswer::Values(w)) = &answer
                    && case.input[1] >= 0.0
                    && w.first().is_some_and(|re| *re < 0.0)
                {
                    match negative[k].iter_mut().find(|n| n.0 == case.region) {
                        Some(n) => n.1 += 1,
                        None => negative[k].push((case.region, 1)),
                    }
                }
                all.push(answer.map(|w| turned(&case.input, w)));
            }
        }
        judge_together(&variant, settings, batch, &mut tallies);
    }
    let reports = tallies.into_iter().map(|t| t.finish(&variant));
    reports.zip(negative).collect()
}

/// Of the derivative by the identity.
fn judged_slopes(codes: &[&Code], regions: Vec<Region>, settings: &Settings) -> Vec<MethodReport> {
    let single = codes.first().is_some_and(|c| c.single);
    let slope = move |z: &[f64], answer: SolverAnswer| match answer {
        SolverAnswer::Values(w) if w.len() == 2 => SolverAnswer::Values(if single {
            let z = Complex32::new(z[0] as f32, z[1] as f32);
            let w = Complex32::new(w[0] as f32, w[1] as f32);
            let slope = -2.0 * z * w + Complex32::new(0.0, FRAC_2_SQRT_PI as f32);
            vec![f64::from(slope.re), f64::from(slope.im)]
        } else {
            let (z, w) = (Complex::new(z[0], z[1]), Complex::new(w[0], w[1]));
            let slope = -2.0 * z * w + Complex::new(0.0, FRAC_2_SQRT_PI);
            vec![slope.re, slope.im]
        }),
        other => other,
    };
    let method = find("faddeeva-derivative").expect("a method of the registry");
    let judged = judged(&*method, codes, &regions, settings, &above, &slope);
    judged.into_iter().map(|(report, _)| report).collect()
}

fn norm(region: &RegionReport, unit: f64) -> Option<Figures> {
    let s = region.normwise.filter(|s| s.count > 0)?;
    Some(Figures {
        worst: rounded(s.max * unit),
        p99: rounded(s.p99 * unit),
        median: rounded(s.median * unit),
    })
}

fn figures(report: &MethodReport, negative: &[(&'static str, u64)], unit: f64) -> Vec<Part> {
    let part = |region: &RegionReport, name: &'static str| {
        let worst = |k: usize| {
            let o = region.outputs.get(k)?;
            o.worst.as_ref()?;
            Some(rounded(o.max_of_budget * WHOLE))
        };
        let counted = negative.iter().filter(|n| name == "all" || n.0 == name);
        let outputs = region.outputs.iter();
        let largest = outputs.max_by(|a, b| a.max_of_budget.total_cmp(&b.max_of_budget));
        let at = largest.and_then(|o| o.worst.as_ref());
        Part {
            region: name,
            cases: region.cases,
            norm: norm(region, unit),
            re: worst(0),
            im: worst(1),
            wrong: region.kinds.total() + region.undecided + region.reference_failed,
            negative: counted.map(|n| n.1).sum(),
            worst_at: at.map(|case| case.input.clone()),
        }
    };
    let mut parts: Vec<Part> = report.regions.iter().map(|r| part(r, r.name)).collect();
    parts.push(part(&report.total, "all"));
    parts
}

#[cfg(test)]
mod tests;
