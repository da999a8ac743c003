//! What references answer, bit by bit, and which cases are drawn.

use mechaudit::audit::{Cases, Due, ReferenceAnswer, Settings};
use mechaudit::methods;
use rug::Rational;
use std::fmt::{Debug, Write};

/// Working precisions: what the judge begins with, and one at which every part of a reference works harder.
const BITS: [u32; 2] = [128, 300];

/// Bits of a coordinate that count: the last ones are of the system's logarithm.
const KEPT: u32 = 24;

/// A hash of a text, the same on every machine (FNV-1a).
#[derive(Clone, Copy)]
struct Digest(u64);

impl Digest {
    fn new() -> Digest {
        Digest(0xcbf2_9ce4_8422_2325)
    }

    fn add(&mut self, value: impl Debug) {
        for byte in format!("{value:?};").bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

/// `x` cut to [`KEPT`] bits.
fn rounded(x: f64) -> f64 {
    const DROPPED: u32 = f64::MANTISSA_DIGITS - KEPT;
    f64::from_bits(x.to_bits() >> DROPPED << DROPPED)
}

/// Adds an answer; the accuracy of its worst value in bits, or what it says in place of values.
fn add(digest: &mut Digest, answer: ReferenceAnswer) -> Result<i64, String> {
    let dues = match answer {
        ReferenceAnswer::Values(r) => r.values.into_iter().map(Due::Number).collect(),
        ReferenceAnswer::Dues(dues, _) => dues,
        other => return Err(format!("{other:?}")),
    };
    let mut worst = i64::MAX;
    for due in dues {
        if let Some(ball) = due.number() {
            let mid = ball.mid().to_string_radix(32, None);
            digest.add((mid, ball.prec(), ball.rad()));
            worst = worst.min(ball.accuracy_bits());
        } else {
            digest.add(due);
        }
    }
    Ok(worst)
}

/// A radius that shrinks may no longer be a bound, one that grows costs digits: neither fails a test of inclusion. Every
/// change of a formula, a number of terms or a working precision shows here; the bits beside it tell how much it matters.
#[test]
fn they_are_what_they_were() {
    let settings = Settings {
        cases_per_region: 4,
        ..Settings::default()
    };
    let mut text = String::new();
    for method in methods::registry() {
        let start = std::time::Instant::now();
        writeln!(text, "{}", method.name()).unwrap();
        let cases = Cases::new(&*method, &settings);
        let all: Vec<_> = (0..cases.len()).map(|i| cases.get(i)).collect();
        for group in all.chunk_by(|a, b| a.region == b.region) {
            if group[0].region == "hard" {
                continue;
            }
            write!(text, "  {}:", group[0].region).unwrap();
            for bits in BITS {
                let mut digest = Digest::new();
                let (mut worst, mut without) = (i64::MAX, 0);
                for case in group {
                    if case.input.iter().any(|x| !x.is_finite()) {
                        continue;
                    }
                    let exact = |x: &f64| Rational::from_f64(rounded(*x)).unwrap();
                    let input: Vec<Rational> = case.input.iter().map(exact).collect();
                    match add(&mut digest, method.reference(&input, bits)) {
                        Ok(bits) => worst = worst.min(bits),
                        Err(other) => {
                            digest.add(other);
                            without += 1;
                        }
                    }
                }
                write!(text, " {:08x} {worst} {without},", digest.0 >> 32).unwrap();
            }
            writeln!(text).unwrap();
        }
        eprintln!("{} {:?}", method.name(), start.elapsed());
    }
    crate::pin("balls", &text);
}
