//! Rectangles against what the code does at points of them.

use crate::cover::Rectangle;
use crate::pinned::units;
use mechaudit_reference::Ball;
use mechaudit_reference::faddeeva::w_f64;
use mechaudit_solvers::faddeeva::faddeeva;
use num_complex::Complex;
use rand::Rng;
use rand::rngs::ChaCha8Rng;
use rug::Float;
use std::fmt::Debug;

/// A square by its least corner.
pub(crate) fn square(a: f64, b: f64, side: f64) -> Rectangle {
    Rectangle {
        a: [a, a + side],
        b: [b, b + side],
    }
}

/// Any `f64` between two positive ones, evenly by their bits.
pub(crate) fn between(random: &mut ChaCha8Rng, [lo, hi]: [f64; 2]) -> f64 {
    let (p, q) = (lo.to_bits(), hi.to_bits());
    f64::from_bits(p + random.next_u64() % (q - p + 1))
}

/// `|computed − w|/|w|` in units of 2⁻⁵².
pub(crate) fn error(re: f64, im: f64) -> f64 {
    let got = faddeeva(Complex::new(re, im));
    let w = w_f64(re, im, 120).expect("decided");
    let part = |g: f64, w: &Ball| (Float::with_val(300, g) - w.mid()).square();
    let size = |w: &Ball| Float::with_val(300, w.mid().square_ref());
    let off = part(got.re, &w.re) + part(got.im, &w.im);
    (off / (size(&w.re) + size(&w.im))).sqrt().to_f64() * 2f64.powi(52)
}

/// Returns whether the point is in the rectangle.
pub(crate) fn holds(at: &Rectangle, a: f64, b: f64) -> bool {
    (at.a[0]..=at.a[1]).contains(&a) && (at.b[0]..=at.b[1]).contains(&b)
}

/// On rectangles of all sizes, every eighth changed by `beside`: all that is due at a point is
/// among the pieces that hold it. Some rectangles have no pieces, many have some, few have more
/// than two and none more than `many`.
pub(crate) fn pieces_hold_what_is_due<T: PartialEq + Debug>(
    pieces: impl Fn(&Rectangle) -> Result<Vec<(Rectangle, T)>, &'static str>,
    due: impl Fn(f64, f64) -> Vec<T>,
    many: usize,
    beside: impl Fn(Rectangle) -> Rectangle,
) {
    let mut uniform = units(11);
    let (mut known, mut refused, mut several) = (0, 0, 0);
    for k in 0..6000 {
        // Coordinates evenly and by their exponents, sides from a hundredth of the coordinate to
        // more than it.
        let mut coordinate = || match uniform() < 0.5 {
            true => 14.0 * uniform(),
            false => 2f64.powf(-60.0 + 72.0 * uniform()),
        };
        let [x, y] = [coordinate(), coordinate()];
        let side = 2f64.powf(-7.0 + 8.0 * uniform());
        let [a, b] = [x, y].map(|c: f64| [c, c + side * c.max(1e-3)]);
        let at = match k % 8 {
            0 => beside(Rectangle { a, b }),
            _ => Rectangle { a, b },
        };
        let Ok(all) = pieces(&at) else {
            refused += 1;
            continue;
        };
        known += 1;
        several += usize::from(all.len() > 2);
        assert!(all.len() <= many);
        let mut within = |[lo, hi]: [f64; 2], end: usize| match end {
            0 => lo,
            1 => hi,
            _ => (lo + (hi - lo) * uniform()).clamp(lo, hi),
        };
        for n in 0..24 {
            let (a, b) = (within(at.a, n % 3), within(at.b, n / 3 % 3));
            for due in due(a, b) {
                let found = all.iter().any(|(p, t)| *t == due && holds(p, a, b));
                assert!(found, "{at:?} {a} {b} {due:?} {all:?}");
            }
        }
    }
    assert!(
        known > 2000 && refused > 500 && several > 200,
        "{known} {refused} {several}"
    );
}
