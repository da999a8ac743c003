//! The values of functions, pinned bit by bit.
//!
//! A radius that shrinks may no longer be a bound, and one that grows costs digits; tests of
//! inclusion see neither.

use crate::{Ball, ComplexBall, Mag};
use rug::{Float, Rational};
use std::fmt::Debug;

/// A hash of answers, the same on every machine (FNV-1a), and the bits of those that are neither
/// exact nor without digits.
pub(crate) struct Answers {
    hash: u64,
    bits: Vec<i64>,
}

impl Answers {
    /// The precision, the hash of what is added, and the bits of the worst answer and of the middle
    /// one, which tell how much a change matters.
    pub fn line(bits: u32, add: impl FnOnce(&mut Answers)) -> String {
        let mut answers = Answers {
            hash: 0xcbf2_9ce4_8422_2325,
            bits: Vec::new(),
        };
        add(&mut answers);
        let hash = answers.hash >> 32;
        answers.bits.sort_unstable();
        match &answers.bits[..] {
            [] => format!("{bits}: {hash:08x}"),
            all => format!(
                "{bits}: {hash:08x}, {} to {} bits",
                all[0],
                all[all.len() / 2]
            ),
        }
    }

    pub fn add(&mut self, answer: &impl Answer) {
        answer.add_to(self);
    }

    /// Anything else, by its text.
    pub fn text(&mut self, x: impl Debug) {
        for byte in format!("{x:?};").bytes() {
            self.hash = (self.hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

/// A value that can be written down to the last bit.
pub(crate) trait Answer {
    fn add_to(&self, answers: &mut Answers);
}

impl Answer for Float {
    fn add_to(&self, answers: &mut Answers) {
        answers.text((self.to_string_radix(32, None), self.prec()));
    }
}

impl Answer for Mag {
    fn add_to(&self, answers: &mut Answers) {
        answers.text(self);
    }
}

impl Answer for Ball {
    fn add_to(&self, answers: &mut Answers) {
        answers.add(self.mid());
        answers.add(&self.rad());
        let bits = Some(self.accuracy_bits()).filter(|b| ![i64::MIN, i64::MAX].contains(b));
        answers.bits.extend(bits);
    }
}

impl Answer for ComplexBall {
    fn add_to(&self, answers: &mut Answers) {
        answers.add(&self.re);
        answers.add(&self.im);
    }
}

impl<A: Answer> Answer for [A] {
    fn add_to(&self, answers: &mut Answers) {
        answers.text(self.len());
        self.iter().for_each(|x| x.add_to(answers));
    }
}

impl<A: Answer> Answer for Vec<A> {
    fn add_to(&self, answers: &mut Answers) {
        self[..].add_to(answers);
    }
}

impl<A: Answer, const N: usize> Answer for [A; N] {
    fn add_to(&self, answers: &mut Answers) {
        self[..].add_to(answers);
    }
}

impl<A: Answer, B: Answer> Answer for (A, B) {
    fn add_to(&self, answers: &mut Answers) {
        answers.add(&self.0);
        answers.add(&self.1);
    }
}

impl<A: Answer> Answer for &A {
    fn add_to(&self, answers: &mut Answers) {
        answers.add(*self);
    }
}

impl<A: Answer> Answer for Option<A> {
    fn add_to(&self, answers: &mut Answers) {
        match self {
            Some(x) => answers.add(x),
            None => answers.text("none"),
        }
    }
}

impl<A: Answer, E: Debug> Answer for Result<A, E> {
    fn add_to(&self, answers: &mut Answers) {
        match self {
            Ok(x) => answers.add(x),
            Err(why) => answers.text(why),
        }
    }
}

/// Pseudo-random numbers (SplitMix64).
pub(crate) struct Draw(pub u64);

impl Draw {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// From 0 to n − 1.
    pub fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// A fraction from −1 to 1 with a denominator of 21 bits, seldom a power of two.
    pub fn fraction(&mut self) -> Rational {
        let down = (1 << 20) + self.below(1 << 20);
        let up = self.below(2 * down + 1) as i64 - down as i64;
        Rational::from((up, down))
    }

    /// From `from` to `to`.
    pub fn between(&mut self, from: i64, to: i64) -> Rational {
        (self.fraction() + 1u32) * Rational::from((to - from, 2)) + from
    }

    /// A fraction times a power of two from `2^from` to `2^to`.
    pub fn sized(&mut self, from: i32, to: i32) -> Rational {
        let k = from + self.below((to - from + 1) as u64) as i32;
        self.fraction() << k
    }

    /// A ball about a fraction, of `bits` bits and a radius from nothing to a few units, and now
    /// and then a wide one.
    pub fn ball(&mut self, bits: u32, from: i32, to: i32) -> Ball {
        let x = Ball::rational(bits, &self.sized(from, to));
        let x = Ball::new(x.mid().clone(), Mag::ZERO);
        let down = match self.below(4) {
            0 => return x,
            1 => 1 + self.below(8),
            2 => u64::from(bits) / 2 + self.below(8),
            _ => u64::from(bits) + self.below(8),
        };
        let size = Mag::from_f64((1 + self.below(1 << 40)) as f64);
        x.widened(size.shift(i64::from(from) - 40 - down as i64))
    }
}

/// Lines as they were found to be.
pub(crate) fn pin(due: &[&str], found: impl IntoIterator<Item = String>) {
    let found: Vec<String> = found.into_iter().collect();
    let lines: String = found.iter().map(|line| format!("{line:?},\n")).collect();
    assert!(found == due, "found\n{lines}");
}
