//! Enclosures bit by bit, and which values and texts are chosen where several would serve.
//!
//! A radius that shrinks may no longer be a bound, and one that grows costs digits: tests of
//! inclusion notice neither.

use crate::complex::{antiderivative, size};
use crate::{Definitions, Exact, Point, parse};
use mechaudit_reference::faddeeva::w_ball;
use mechaudit_reference::{Ball, ComplexBall, Mag};
use rug::{Float, Rational};
use std::fmt::Write;

/// A hash of balls (FNV-1a over their texts), with the least and the largest of their radii to be
/// read.
struct Digest {
    hash: u64,
    radii: [Mag; 2],
}

impl Digest {
    fn new() -> Digest {
        Digest {
            hash: 0xcbf2_9ce4_8422_2325,
            radii: [Mag::INFINITY, Mag::ZERO],
        }
    }

    fn text(&mut self, text: &str) {
        for byte in text.bytes() {
            self.hash = (self.hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn ball(&mut self, b: &Ball) {
        let mid = b.mid().to_string_radix(32, None);
        self.text(&format!("{mid} {} {:?};", b.prec(), b.rad()));
        if !b.rad().is_zero() {
            self.radii = [self.radii[0].min(b.rad()), self.radii[1].max(b.rad())];
        }
    }

    fn complex(&mut self, z: &ComplexBall) {
        self.ball(&z.re);
        self.ball(&z.im);
    }

    fn line(&self, name: &str) -> String {
        let [least, largest] = self.radii.map(Mag::to_f64);
        format!("{name}: {:016x} {least:.1e} {largest:.1e}\n", self.hash)
    }
}

/// Draws without the system's functions (splitmix64).
fn draw(n: u64) -> u64 {
    let mut x = n.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ x >> 31
}

/// Between −size and size.
fn number(n: u64, size: i64) -> Rational {
    let k = (draw(n) >> 20) as i64 - (1 << 43);
    Rational::from((k, 1_i64 << 43)) * size
}

/// Radii of 2⁻⁷ and less, every eighth none.
fn ball(bits: u32, n: u64, size: i64) -> Ball {
    let radius = Mag::from_f64((draw(n + 1) >> 11) as f64);
    let exact = Ball::rational(bits, &number(n, size));
    match n % 8 {
        0 => Ball::new(exact.mid().clone(), Mag::ZERO),
        k => exact.widened(radius.shift(-53 - 7 * k as i64)),
    }
}

fn pinned(found: &str, due: &str) {
    assert!(found == due, "found\n{found}");
}

#[test]
fn antiderivatives() {
    let mut found = String::new();
    for bits in [64, 128, 200] {
        let mut digest = Digest::new();
        for k in 0..12 {
            let z = ComplexBall::new(ball(bits, 5 * k, 3), ball(bits, 5 * k + 2, 3));
            digest.complex(&antiderivative(&z).unwrap());
            digest.complex(&w_ball(&z, bits));
        }
        found += &digest.line(&format!("{bits} bits"));
        // Few terms, down to one.
        let mut digest = Digest::new();
        for k in 1_u32..40 {
            let small = |n| Ball::new(Float::with_val(bits, number(n, 1)) >> (2 * k), Mag::ZERO);
            let z = ComplexBall::new(small(u64::from(k)), small(u64::from(k) + 50));
            digest.complex(&antiderivative(&z).unwrap());
        }
        found += &digest.line("  near zero");
    }
    pinned(
        &found,
        "\
64 bits: 5b0e7eb05c8ff1cc 5.4e-13 4.8e0
  near zero: 4938bb83b99d4745 3.7e-71 7.5e-20
128 bits: 04245507b0d05af0 5.4e-13 4.8e0
  near zero: 969187cc9d50762e 3.7e-71 8.4e-39
200 bits: 7d586ab84424440e 5.4e-13 4.8e0
  near zero: 8c2db82a30229029 4.2e-81 2.2e-60
",
    );
}

/// Below a modulus of twelve, the bound on it rounded up.
#[test]
fn antiderivatives_end_at_twelve() {
    let mut found = [0, 0, 0];
    for k in -4_i64..4 {
        let x = f64::from_bits(12f64.to_bits().wrapping_add_signed(k));
        let z = ComplexBall::new(Ball::exact(64, x), Ball::integer(64, 0));
        let side = size(&z).total_cmp(&12.0);
        assert_eq!(antiderivative(&z).is_ok(), side.is_lt(), "{k}");
        found[(side as i8 + 1) as usize] += 1;
    }
    assert!(found.iter().all(|n| *n > 0), "{found:?}");
}

/// A refutation names its point: the same wherever it is found.
#[test]
fn points() {
    let value = |turn, name| {
        let point = Point::sample(turn);
        point.value(name).unwrap().to_string()
    };
    let mut found = String::new();
    for name in ["x", "y", "a_1", "alpha", "phi1_2"] {
        let line: Vec<String> = (0..4).map(|turn| value(turn, name)).collect();
        writeln!(found, "{name}: {}", line.join(" ")).unwrap();
    }
    pinned(
        &found,
        "\
x: 38/49 103/97 16/25 94/99
y: 103/97 38/49 94/99 16/25
a_1: 82/117 101/100 70/111 107/118
alpha: 95/102 85/111 71/111 41/57
phi1_2: 7/6 4/3 29/24 21/16
",
    );
}

fn text(e: &str) -> String {
    let mut exact = Exact::default();
    let form = exact.value(&Definitions::default(), &parse(e).unwrap());
    exact.algebra.text(&form.unwrap())
}

/// One root's name may begin with another's, and one radicand hold another root.
#[test]
fn texts_of_roots_and_integrals() {
    for (e, due) in [
        ("sqrt(2) + sqrt(23)", "sqrt(2)+sqrt(23)"),
        ("sqrt(23) + sqrt(2)", "sqrt(2)+sqrt(23)"),
        ("sqrt(x) + sqrt(x_1)", "sqrt(x)+sqrt(x_1)"),
        ("sqrt(1 + sqrt(x))", "sqrt(1+sqrt(x))"),
        ("sqrt(1 + sqrt(1 + x))", "sqrt(1+sqrt(1+x))"),
        ("sqrt(1 + sqrt(1 + sqrt(2)))", "sqrt(1+sqrt(1+sqrt(2)))"),
        ("int(s, 0, x, exp(s^2))", "G(x)"),
        ("int(s, 0, x, exp(-s^2))", "-i*G(i*x)"),
        ("int(s, 0, x, exp(y*s^2))", "G(sqrt(y)*x)*sqrt(y)/y"),
    ] {
        let found = text(e);
        assert_eq!(found, due, "{e}");
    }
}
