//! Which cases are drawn and what references answer, pinned bit by bit.

use mechaudit::audit::{Case, Cases, Expected, Method, ReferenceAnswer, Settings};
use mechaudit::methods;
use rug::Rational;
use std::fmt::{Debug, Write};

/// Working precisions: below, at and far above what the judge begins with.
const BITS: [u32; 3] = [80, 128, 400];

/// Bits of a coordinate that count: the last ones of a draw come from the system's logarithm.
const KEPT: u32 = 24;

/// A hash of texts, the same on every machine (FNV-1a).
pub struct Digest(u64);

impl Digest {
    pub fn new() -> Digest {
        Digest(0xcbf2_9ce4_8422_2325)
    }

    pub fn add(&mut self, value: impl Debug) {
        for byte in format!("{value:?};").bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    pub fn text(&self) -> String {
        format!("{:08x}", self.0 >> 32)
    }
}

/// `x` cut to [`KEPT`] bits.
pub fn cut(x: f64) -> f64 {
    const DROPPED: u32 = f64::MANTISSA_DIGITS - KEPT;
    f64::from_bits(x.to_bits() >> DROPPED << DROPPED)
}

/// A method's cases, the hard ones among them.
pub fn drawn(method: &dyn Method, per_region: u64) -> Vec<Case> {
    let settings = Settings {
        cases_per_region: per_region,
        ..Settings::default()
    };
    let cases = Cases::new(method, &settings);
    (0..cases.len()).map(|i| cases.get(i)).collect()
}

/// Of the methods from one to before another, or to the last, region by region, what `text` says of
/// their cases. Hard cases are left out: their values are written down.
fn by_region(
    from: &str,
    to: Option<&str>,
    per_region: u64,
    text: impl Fn(&dyn Method, &[Case]) -> String,
) -> String {
    let methods = methods::registry();
    let at = |name| methods.iter().position(|m| m.name() == name).expect(name);
    let mut all = String::new();
    for method in &methods[at(from)..to.map_or(methods.len(), at)] {
        writeln!(all, "{}", method.name()).unwrap();
        let cases = drawn(&**method, per_region);
        for region in cases.chunk_by(|a, b| a.region == b.region) {
            let name = region[0].region;
            if name != "hard" {
                writeln!(all, "  {name}: {}", text(&**method, region)).unwrap();
            }
        }
    }
    all
}

/// A region of which only a part is drawn makes its check weaker, and no case fails.
#[test]
fn cases() {
    let text = by_region("tridiagonal", None, 24, |_, cases| {
        let mut digest = Digest::new();
        for case in cases {
            let input: Vec<f64> = case.input.iter().map(|x| cut(*x)).collect();
            digest.add(input);
        }
        format!("{} {}", cases.len(), digest.text())
    });
    crate::pin("cases", &text);
}

/// A law that grows lax holds for every solver. Beside the number of cases that it applies to, and
/// of those where it holds exactly, stands the sum of the logarithms of its residuals, which
/// changes with each.
#[test]
fn laws() {
    let mut text = String::new();
    for method in methods::registry() {
        writeln!(text, "{}", method.name()).unwrap();
        let cases = drawn(&*method, 8);
        for law in method.laws() {
            let residuals = cases.iter().filter_map(|c| (law.residual)(&c.input));
            let residuals: Vec<f64> = residuals.collect();
            let positive = residuals.iter().filter(|r| **r > 0.0);
            let (n, exact) = (residuals.len(), residuals.len() - positive.clone().count());
            let sum: f64 = positive.fold(0.0, |sum, r| sum + r.ln());
            writeln!(text, "  {}: {n} cases, {exact} exactly, {sum:.4}", law.name).unwrap();
        }
    }
    crate::pin("laws", &text);
}

/// Pins the units of budgets: a condition that grows makes its check weaker, and no case fails. The
/// sum of logarithms over a case's values changes with each of them.
#[test]
fn conditions() {
    let needs = |m: &dyn Method| {
        m.outputs()
            .iter()
            .any(|o| o.budget.limit.needs_conditions())
    };
    let mut text = String::new();
    for method in methods::registry().iter().filter(|m| needs(&***m)) {
        writeln!(text, "{}", method.name()).unwrap();
        for case in drawn(&**method, 1) {
            let kept = match case.region {
                "hard" => continue,
                "check-points" => case.input.clone(),
                _ => case.input.iter().map(|x| cut(*x)).collect(),
            };
            let found = match method.conditions(&kept) {
                Some(found) => {
                    let drawn = case.region != "check-points";
                    assert!(
                        !drawn || found.iter().all(|c| *c >= 0.0),
                        "{}",
                        case.reproduce()
                    );
                    let positive = found.iter().filter(|c| **c > 0.0);
                    let (n, zero) = (found.len(), found.len() - positive.clone().count());
                    let sum: f64 = positive.map(|c| c.ln()).sum();
                    let mut digest = Digest::new();
                    digest.add(found);
                    format!("{n} values, {zero} zero, {sum:.5}, {}", digest.text())
                }
                None => "none".into(),
            };
            writeln!(text, "  {}: {found}", case.region).unwrap();
        }
    }
    crate::pin("conditions", &text);
}

/// Adds an answer to the digest; the accuracy of its worst value in bits, if that is neither exact
/// nor without digits.
fn add(digest: &mut Digest, answer: ReferenceAnswer) -> Option<i64> {
    let expected = match answer {
        ReferenceAnswer::Values(r) => r.values.into_iter().map(Expected::Number).collect(),
        ReferenceAnswer::Expected(expected, _) => expected,
        other => {
            digest.add(other);
            return None;
        }
    };
    let mut worst = None;
    for due in expected {
        let Some(ball) = due.number() else {
            digest.add(due);
            continue;
        };
        let mid = ball.mid().to_string_radix(32, None);
        digest.add((mid, ball.prec(), ball.rad()));
        let bits = Some(ball.accuracy_bits()).filter(|b| ![i64::MIN, i64::MAX].contains(b));
        worst = worst.into_iter().chain(bits).min();
    }
    worst
}

/// A radius that shrinks may no longer be a bound, and one that grows costs digits; tests of
/// inclusion see neither. Every change of a formula, a number of terms or a working precision shows
/// here, and the bits of the worst value how much it matters.
fn balls(name: &str, from: &str, to: Option<&str>, per_region: u64) {
    let text = by_region(from, to, per_region, |method, cases| {
        let at = BITS.map(|bits| {
            let mut digest = Digest::new();
            let mut worst = None;
            for case in cases {
                // Check points are numbers that are written down, some of them to the last bit.
                let kept = |x: &f64| {
                    if case.region == "check-points" {
                        *x
                    } else {
                        cut(*x)
                    }
                };
                let input: Option<Vec<Rational>> = case
                    .input
                    .iter()
                    .map(|x| Rational::from_f64(kept(x)))
                    .collect();
                if let Some(input) = input {
                    let bits = add(&mut digest, method.reference(&input, bits));
                    worst = worst.into_iter().chain(bits).min();
                }
            }
            let worst = worst.map_or("no".into(), |b| b.to_string());
            format!("{} {worst} bits", digest.text())
        });
        at.join(", ")
    });
    crate::pin(name, &text);
}

#[test]
fn balls_of_systems_and_splines() {
    balls("balls-linear", "tridiagonal", Some("four-bar"), 8);
}

#[test]
fn balls_of_linkages() {
    balls("balls-linkages", "four-bar", Some("faddeeva"), 8);
}

#[test]
fn balls_of_w() {
    balls("balls-w", "faddeeva", Some("erf"), 8);
}

#[test]
fn balls_of_its_relatives() {
    balls("balls-relatives", "erf", Some("cam-law"), 8);
}

#[test]
fn balls_of_cams() {
    balls("balls-cams", "cam-law", Some("run-up"), 8);
}

#[test]
fn balls_of_run_ups() {
    balls("balls-run-up", "run-up", None, 2);
}
