//! Which formula is used on a border itself and beside it, as the papers' programs compare: a
//! checksum over a lattice has no point there.

use crate::elementary::quotient;
use crate::{find, gauss_hermite};
use num_complex::{Complex, Complex64};
use std::f64::consts::PI;

fn formula(name: &str, z: Complex64) -> u8 {
    find(name).and_then(|a| a.formula).expect(name)(z)
}

fn w(name: &str, z: Complex64) -> Complex64 {
    (find(name).expect(name).w)(z)
}

/// An argument with `x² + y² = s` in `f64`, y at least the given one.
fn on_circle(s: f64, least: f64) -> Complex64 {
    let all = (0..64).map(|k| least * (1.0 + f64::from(k) / 1024.0));
    let mut found = all.map(|y| Complex::new((s - y * y).sqrt(), y));
    let z = found.find(|z| z.re * z.re + z.im * z.im == s);
    z.expect("a point of the circle")
}

#[test]
fn formulas_at_borders() {
    // R₀ of four digits.
    let far = 1.51 * libm::exp(1.144 * 4.0);
    let line: f64 = 0.195 * 2.0 - 0.176;
    for (name, x, y, due) in [
        ("abrarov-quine-2016", 8.0, 0.0, 4),
        ("abrarov-quine-2016", 1.0, 5e-3, 1),
        ("abrarov-quine-2016", 5e-3, 0.0, 4),
        ("gautschi-1970", 1.0, 4.29, 0),
        ("gautschi-1970", 5.33, 1.0, 0),
        ("tran-ngo-hartmann-2013-cpf", 1.65, 0.0, 2),
        ("tran-ngo-hartmann-2013-cpf", 8.0, 0.0, 2),
        ("humlicek-1979", 1.65, 0.0, 1),
        ("humlicek-1979", 20.0, 0.85, 1),
        ("humlicek-1982", 15.0, 0.0, 1),
        ("humlicek-1982", 5.5, 0.0, 2),
        ("humlicek-1982", 2.0, line, 3),
        ("humlicek-1982", 2.0, line.next_down(), 4),
        ("karbach-raven-schiller-2014", 12.0, 0.0, 2),
        ("karbach-raven-schiller-2014-fast", 0.0, 8.0, 2),
        ("schreier-2018-hum2zpf16", 10.0, 0.0, 0),
        ("hunter-regan-1972", 0.125, 1.0, 1),
        ("hunter-regan-1972", 0.375, 1.0, 1),
        ("hunter-regan-1972", 0.1249, 1.0, 0),
        ("wells-1999-r4", 50.0, 1e-6, 5),
        ("wells-1999-r4", 50.0, 7e-7, 5),
        ("wells-1999-r4", 50.0, 1.1e-6, 1),
        ("wells-1999-r4", far - 1.0, 1.0, 1),
        ("wells-1999-r4", 1.65, 0.0, 4),
        ("zaghloul-2017", 6.0, 3.2e-7, 4),
        ("zaghloul-2017", 6.0, 3.1e-7, 5),
        ("zaghloul-ali-2011", 1.0, 5.0, 0),
        // (x/6.3)² + (y/4.4)² = 0.085264 in f64.
        ("poppe-wijers-1990", 1.8395914975630054, 0.00390625, 1),
        ("poppe-wijers-1990", 1.839, 0.00390625, 0),
        ("zaghloul-ali-2011", 1e15, 1.0, 3),
    ] {
        let found = formula(name, Complex::new(x, y));
        assert_eq!(found, due, "{name} at {x} {y}");
    }
    for (s, y, due) in [
        (38000.0, 1.0, 1),
        (256.0, 1.0, 2),
        (62.0, 1.0, 3),
        (30.0, 1.0, 4),
    ] {
        assert_eq!(formula("zaghloul-2017", on_circle(s, y)), due, "{s}");
    }
    for y in [1e-6, 0.1] {
        assert_eq!(formula("zaghloul-2017", on_circle(2.5, y)), 7, "{y}");
    }
}

/// Those of the twelfths of π within the series, from either side, and no more.
#[test]
fn poles_of_the_narrow_band() {
    for k in 1..26 {
        let pole = f64::from(k) * PI / 12.0;
        for (off, inside) in [
            (-1.1e-4, 4),
            (-0.9e-4, 3),
            (0.0, 3),
            (0.9e-4, 3),
            (1.1e-4, 4),
        ] {
            let due = if k < 24 { inside } else { 4 };
            let found = formula("abrarov-quine-2016", Complex::new(pole + off, 1e-3));
            assert_eq!(found, due, "{k} {off}");
        }
    }
}

/// FNV-1a over the bits.
fn digest(numbers: impl IntoIterator<Item = f64>) -> u64 {
    let start = 0xcbf2_9ce4_8422_2325;
    let add = |sum: u64, x: f64| (sum ^ x.to_bits()).wrapping_mul(0x0100_0000_01b3);
    numbers.into_iter().fold(start, add)
}

/// Where a program says nothing of its formulas.
#[test]
fn values_at_borders() {
    for (name, x, y, due) in [
        (
            "karbach-raven-schiller-2014",
            12.0,
            0.0,
            "43c715a01ce46ab5 -8.168e-18 4.718e-2",
        ),
        (
            "karbach-raven-schiller-2014-fast",
            0.0,
            8.0,
            "3d012ac66b4a8150 6.999e-2 -0.000e0",
        ),
        (
            "schreier-2011-hum1wei24",
            15.0,
            0.0,
            "8ee48947702599bf -0.000e0 3.770e-2",
        ),
        (
            "schreier-2011-hum1wei24",
            9.0,
            6.0,
            "9a4504ee3437244b 2.915e-2 4.336e-2",
        ),
        (
            "schreier-2018-hum2zpf16",
            10.0,
            0.0,
            "92848b91c4910f78 -0.000e0 5.671e-2",
        ),
        (
            "zaghloul-ali-2011",
            1e15,
            1.0,
            "a3d8f76efa534fe1 5.642e-31 5.642e-16",
        ),
        (
            "zaghloul-ali-2011",
            1e15,
            1e15,
            "3ecb37fce799eb6d 2.821e-16 2.821e-16",
        ),
    ] {
        let w = w(name, Complex::new(x, y));
        let found = format!("{:016x} {:.3e} {:.3e}", digest([w.re, w.im]), w.re, w.im);
        assert_eq!(found, due, "{name} at {x} {y}");
    }
}

/// A divisor with parts of one size: zero has the sign of the numerator's difference.
#[test]
fn quotients_on_the_diagonal() {
    let (one, below) = (Complex64::new(1.0, 1.0), Complex64::new(1.0, -1.0));
    let found = quotient(one, below);
    assert_eq!(
        [found.re.to_bits(), found.im.to_bits()],
        [0, 1f64.to_bits()]
    );
    let found = quotient(below, below);
    assert_eq!(
        [found.re.to_bits(), found.im.to_bits()],
        [1f64.to_bits(), 0]
    );
}

/// Nodes and weights of 2 to 60 nodes.
#[test]
fn nodes_have_their_bits() {
    let all = (1..=30).flat_map(|n| gauss_hermite::positive(2 * n));
    let numbers = all.flat_map(|(t, w)| [t, w]);
    let found = digest(numbers);
    assert_eq!(found, 0x4e931683f27c06fb, "{found:#018x}");
}
