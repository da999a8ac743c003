//! The Hartmann–Tran profile as a method: input the eight parameters of a line, output the complex
//! profile.

use super::regions::region;
use crate::audit::{
    Budget, Domain, Draw, Expected, Input, Limit, Method, Output, Proof, ReferenceAnswer, Region,
    SolverAnswer,
};
use crate::reference::hartmann_tran::{Parameters, hartmann_tran};
use mechaudit_atlas::{Line, Profile};
use rug::Rational;

/// The profile with its certified reference; it has no solver of its own.
pub struct HartmannTran;

const NAMES: [&str; 8] = [
    "Gamma_D", "Gamma_0", "Gamma_2", "Delta_0", "Delta_2", "nu_VC", "eta", "detuning",
];

/// The line that an input is.
pub fn line(p: &[f64]) -> Line {
    Line {
        doppler: p[0],
        widths: [p[1], p[2]],
        shifts: [p[3], p[4]],
        narrowing: p[5],
        correlation: p[6],
        detuning: p[7],
    }
}

/// The answer of a profile.
pub fn answer(profile: &Profile, input: &[f64]) -> SolverAnswer {
    let value = (profile.value)(&line(input));
    SolverAnswer::Values(vec![value.re, value.im])
}

/// Returns whether a line has neither shifts nor correlation.
pub fn simple(p: &[f64]) -> bool {
    p[3] == 0.0 && p[4] == 0.0 && p[6] == 0.0
}

/// Returns what spectroscopy calls a line: widths that are positive at every speed, of any ratio to
/// Doppler's.
pub fn physical(p: &[f64]) -> bool {
    let [gd, g0, g2, d0, d2, nu, eta, delta] = [0, 1, 2, 3, 4, 5, 6, 7].map(|k| p[k]);
    let ratio = g0 / gd;
    (1e-4..=1.0).contains(&gd)
        && (1e-5..=1e3).contains(&ratio)
        && (0.0..=0.3 * g0).contains(&g2)
        && d0.abs() <= 0.3 * g0
        && d2.abs() <= 0.1 * g0
        && (0.0..=g0).contains(&nu)
        && (0.0..=0.9).contains(&eta)
        && delta.abs() <= 1e4 * (gd + g0)
}

/// A line whose Lorentzian width is so many Doppler widths, `far` widths from its centre.
fn drawn(ratio: f64, far: f64, d: &mut Draw) -> Vec<f64> {
    let gd = d.log_uniform(1e-3, 0.1);
    let g0 = gd * ratio;
    let delta = far * (gd + g0);
    vec![
        gd,
        g0,
        g0 * d.uniform(1e-3, 0.3),
        g0 * d.uniform(-0.3, 0.3),
        g0 * d.uniform(-0.1, 0.1),
        g0 * d.uniform(0.0, 1.0),
        if d.chance(0.5) {
            0.0
        } else {
            d.uniform(0.0, 0.9)
        },
        d.signed(delta),
    ]
}

/// Any of them.
pub fn any(d: &mut Draw) -> Vec<f64> {
    let ratio = d.log_uniform(1e-5, 1e3);
    let far = match d.chance(0.7) {
        true => d.uniform(0.0, 8.0),
        false => d.log_uniform(8.0, 1e4),
    };
    drawn(ratio, far, d)
}

/// One without shifts and correlation.
pub fn any_simple(d: &mut Draw) -> Vec<f64> {
    let mut p = any(d);
    for k in [3, 4, 6] {
        p[k] = 0.0;
    }
    p
}

/// Where the profiles are surveyed.
pub fn regions() -> Vec<Region> {
    vec![
        region(
            "doppler",
            "Gamma_0 = 1e-5..0.1 Doppler widths, within 8 widths",
            |d| drawn(d.log_uniform(1e-5, 0.1), d.uniform(0.0, 8.0), d),
        ),
        region(
            "mixed",
            "Gamma_0 = 0.1..10 Doppler widths, within 8 widths",
            |d| drawn(d.log_uniform(0.1, 10.0), d.uniform(0.0, 8.0), d),
        ),
        region(
            "collisions",
            "Gamma_0 = 10..1000 Doppler widths, within 8 widths",
            |d| drawn(d.log_uniform(10.0, 1e3), d.uniform(0.0, 8.0), d),
        ),
        region("wings", "any ratio, 8..1e4 widths from the centre", |d| {
            drawn(d.log_uniform(1e-5, 1e3), d.log_uniform(8.0, 1e4), d)
        }),
        region(
            "no-quadratic",
            "Gamma_2 = Delta_2 = 0, any ratio, within 8 widths",
            |d| {
                let mut p = drawn(d.log_uniform(1e-5, 1e3), d.uniform(0.0, 8.0), d);
                (p[2], p[4]) = (0.0, 0.0);
                p
            },
        ),
        region("rautian", "no shifts, no correlation", any_simple),
    ]
}

impl Method for HartmannTran {
    fn name(&self) -> &'static str {
        "hartmann-tran"
    }
    fn summary(&self) -> &'static str {
        "Hartmann-Tran profile: partially correlated, quadratic in the speed, hard collisions"
    }
    fn source(&self) -> &'static str {
        "Tennyson et al. 2014, Pure Appl. Chem. 86, 1931"
    }
    fn inputs(&self) -> Vec<Input> {
        NAMES.map(|name| Input { name, unit: "1" }).to_vec()
    }
    fn outputs(&self) -> Vec<Output> {
        let budget = Budget::new(Limit::Relative(1e-4), "what the profile's authors state");
        ["Re HT", "Im HT"]
            .map(|name| Output {
                name,
                unit: "1",
                budget,
            })
            .to_vec()
    }
    fn domain(&self) -> Domain {
        Domain {
            regions: regions(),
            check_points: Vec::new(),
        }
    }
    fn solve(&self, _input: &[f64]) -> SolverAnswer {
        SolverAnswer::Unanswered("no solver of this profile".into())
    }
    fn reference(&self, p: &[Rational], bits: u32) -> ReferenceAnswer {
        let line = Parameters {
            doppler: p[0].clone(),
            widths: [p[1].clone(), p[2].clone()],
            shifts: [p[3].clone(), p[4].clone()],
            narrowing: p[5].clone(),
            correlation: p[6].clone(),
            detuning: p[7].clone(),
        };
        match hartmann_tran(&line, bits.saturating_sub(48).max(64)) {
            Ok(value) => ReferenceAnswer::Expected(
                vec![Expected::Number(value.re), Expected::Number(value.im)],
                Proof::Bounded("the closed form of two W with certified values of W"),
            ),
            Err(why) => ReferenceAnswer::Undecided(why.to_string()),
        }
    }
    fn conditions(&self, _input: &[f64]) -> Option<Vec<f64>> {
        None
    }
}

#[cfg(test)]
mod tests;
