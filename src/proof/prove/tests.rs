//! The bounds against certified values at points, and with planted faults.

use super::*;
use crate::at_points::{between, error};
use crate::bound::Bound;
use crate::cover::{Rectangle, hole, roots};
use crate::formula::{Formula, bound};
use crate::tracked::Rounding;
use crate::truncation::exponential_error;
use mechaudit_reference::faddeeva::w_f64;
use mechaudit_solvers::faddeeva::proof as code;
use mechaudit_solvers::faddeeva::{Branch, branch, faddeeva};
use num_complex::Complex;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rug::Float;
use std::sync::LazyLock;

pub(super) static CODE: LazyLock<Code> = LazyLock::new(|| Code::of_the_solver().expect("decided"));

const NORM_ALONE: Target = Target {
    norm: 1.5,
    component: f64::INFINITY,
    depth: 40,
};

/// The proof on shells up to a radius, by the norm alone.
fn within(code: &Code, lo: f64, hi: f64) -> Certificate {
    let watch = Watch::default();
    let wanted = |_: usize, r: &Rectangle| {
        let most = r.a[1].max(r.b[1]);
        lo <= most && most < hi
    };
    upper_half_plane(code, NORM_ALONE, &watch, wanted).expect("not stopped")
}

fn worst(code: &Code, formula: Formula, at: &Rectangle) -> f64 {
    bound(&code.tables, formula, at, code.rounding).map_or(f64::INFINITY, |b| b.norm)
}

#[test]
fn errors_at_points_are_below_their_bounds() {
    let found = within(&CODE, 0.0, 4096.0);
    assert!(found.open.is_empty(), "{:?}", found.open.first());
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut close = 0.0f64;
    for leaf in found.leaves.iter().step_by(7) {
        for _ in 0..3 {
            let mut within = |ends| between(&mut random, ends);
            let z = Complex::new(within(leaf.at.a), within(leaf.at.b));
            // Where the leaf's is not the formula of the point, another leaf has it.
            if Formula::of(branch(z), z.re == 0.0).is_some_and(|f| f != leaf.formula) {
                continue;
            }
            let off = error(z.re, z.im);
            assert!(off <= leaf.bound.norm, "{z} {off} {:?}", leaf);
            close = close.max(off / leaf.bound.norm);
        }
    }
    // Not idle bounds either.
    assert!(close > 0.4, "{close}");
}

#[test]
fn the_near_part_is_covered() {
    let found = within(&CODE, 0.0, 4.1e3);
    let mut all: Vec<Rectangle> = found.leaves.iter().map(|l| l.at).collect();
    // Beyond, the first partition stands for the rest.
    all.extend(roots().into_iter().filter(|r| r.a[1].max(r.b[1]) >= 4.1e3));
    assert_eq!(hole(&all), None);
    // Near a circle two formulas have the same rectangle: all that hold a point.
    all.retain(|r| !(r.a[0] <= 1.1 && 1.1 <= r.a[1] && r.b[0] <= 2.1 && 2.1 <= r.b[1]));
    assert!(hole(&all).is_some());
}

const CENTRE: (f64, f64) = (1.5, 1.5);
const CELL: Formula = Formula::Cell { centre: CENTRE };

fn cell() -> Rectangle {
    Rectangle {
        a: [1.53125, 1.546875],
        b: [1.53125, 1.546875],
    }
}

/// The code with entry `at` of a cell's row changed.
fn with_entry(at: usize, change: impl Fn(f64) -> f64) -> Code {
    let mut code = CODE.clone();
    code.tables.change(CENTRE, |row| row[at] = change(row[at]));
    code
}

#[test]
fn a_coefficient_off_by_eight_units_shows() {
    let sound = worst(&CODE, CELL, &cell());
    let off = |x: f64| f64::from_bits(x.to_bits() + 8);
    let faulty = worst(&with_entry(0, off), CELL, &cell());
    assert!(sound < 1.0 && faulty > sound + 2.0, "{sound} {faulty}");
}

#[test]
fn a_dropped_term_shows() {
    // The tenth: 0 in place of c₉.
    let drop = |at: usize| with_entry(at, |_| 0.0);
    let at = Rectangle {
        a: [1.6, 1.62],
        b: [1.6, 1.62],
    };
    let (sound, faulty) = (worst(&CODE, CELL, &at), worst(&drop(8 + 8 + 3), CELL, &at));
    assert!(sound < 1.0 && faulty > 5.0 * sound, "{sound} {faulty}");
}

#[test]
fn a_moved_limit_shows() {
    fn moved(a: f64, b: f64) -> Branch {
        let z = branch(Complex::new(a, b));
        match z {
            Branch::Cell { .. } if a.mul_add(a, b * b) >= 20.0 => Branch::Asymptotic { terms: 26 },
            _ => z,
        }
    }
    let code = Code {
        branch: moved,
        ..CODE.clone()
    };
    let at = Rectangle {
        a: [3.25, 3.3125],
        b: [3.25, 3.3125],
    };
    let parts = crate::choice::parts(&code, &at).expect("one formula");
    let (at, formula) = parts[0];
    let faulty = worst(&code, formula, &at);
    assert!(faulty > 10.0, "{formula:?} {faulty}");
}

#[test]
fn products_rounded_before_the_sum_show() {
    let twice = Rounding {
        fma_rounds_twice: true,
        truncates: None,
    };
    let code = Code {
        rounding: twice,
        ..CODE.clone()
    };
    let at = Rectangle {
        a: [40.0, 40.25],
        b: [20.0, 20.25],
    };
    let formula = Formula::Asymptotic { terms: 6 };
    let (sound, faulty) = (worst(&CODE, formula, &at), worst(&code, formula, &at));
    assert!(sound < 1.5 && faulty > 1.3 * sound, "{sound} {faulty}");
    let (sound, faulty) = (worst(&CODE, CELL, &cell()), worst(&code, CELL, &cell()));
    // Only the last but one product of the sum counts there.
    assert!(faulty > 1.02 * sound, "{sound} {faulty}");
}

#[test]
fn a_wrong_centre_shows() {
    let mut code = CODE.clone();
    let other = CODE.tables.cell((1.5, 1.75)).expect("a cell").0;
    code.tables.change(CENTRE, |row| *row = other);
    assert!(worst(&code, CELL, &cell()) > 1e12);
}

/// The worst bound with one of the first operations truncating.
fn truncated(operations: u32, of: impl Fn(&Code) -> f64) -> f64 {
    let with = |k| {
        let rounding = Rounding {
            fma_rounds_twice: false,
            truncates: Some(k),
        };
        of(&Code {
            rounding,
            ..CODE.clone()
        })
    };
    (1..operations).map(with).fold(0.0, f64::max)
}

#[test]
fn one_operation_that_truncates_shows() {
    let of = |code: &Code| worst(code, CELL, &cell());
    let (sound, most) = (of(&CODE), truncated(400, of));
    assert!(most > sound + 0.2, "{sound} {most}");
    for at in next_to_real_axis() {
        let of = |code: &Code| worst_re(code, &at);
        let (sound, most) = (of(&CODE), truncated(120, of));
        assert!(most > sound + 0.3, "{at:?} {sound} {most}");
    }
}

#[test]
fn subnormal_and_scaled_values() {
    for (z, formula) in [
        (
            Complex::new(1e-310, 3.0),
            Formula::Cell { centre: (0.0, 3.0) },
        ),
        (Complex::new(1e305, 1e-320), Formula::Huge),
    ] {
        let at = Rectangle {
            a: [z.re; 2],
            b: [z.im; 2],
        };
        let Bound { norm, tiny, .. } =
            bound(&CODE.tables, formula, &at, CODE.rounding).expect("a bound");
        let (w, got) = (w_f64(z.re, z.im, 100).expect("decided"), faddeeva(z));
        for (g, w) in [(got.re, &w.re), (got.im, &w.im)] {
            let off = (Float::with_val(2000, g) - w.mid()).abs();
            let size = Float::with_val(200, w.mid().abs_ref()) * 2f64.powi(-52);
            let unit = Float::with_val(60, 1) >> 1075u32;
            let all = size * (2.0 * norm) + unit * (tiny + 1.0);
            assert!(off <= all, "{z} {formula:?}");
        }
    }
}

/// Next to the real axis, where `e^{−z²}` is added to a multiple of Im z.
fn next_to_real_axis() -> [Rectangle; 3] {
    let a = [12.0, 12.003];
    // Alone, both, not added.
    [[0.0, 1e-80], [1e-66, 2e-17], [1e-15, 1e-9]].map(|b| Rectangle { a, b })
}

fn worst_re(code: &Code, at: &Rectangle) -> f64 {
    bound(&code.tables, Formula::RealLine, at, code.rounding).map_or(f64::INFINITY, |b| b.re)
}

#[test]
fn the_real_part_beside_the_real_axis_is_within_its_bound() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for at in next_to_real_axis() {
        let most = worst_re(&CODE, &at);
        assert!(most < 4.25, "{at:?} {most}");
        for _ in 0..200 {
            let mut within = |ends| between(&mut random, ends);
            let z = Complex::new(within(at.a), within(at.b));
            let w = w_f64(z.re, z.im, 100).expect("decided").re;
            let off = (Float::with_val(200, faddeeva(z).re) - w.mid()).abs();
            let value = w.mid().to_f64();
            let ulp = (value.next_up() - value).min(value - value.next_down());
            assert!((off / ulp).to_f64() <= most, "{z} {most}");
        }
    }
}

#[test]
fn a_wrong_exponential_shows() {
    let (c, ln_2) = code::exponential();
    let sound = exponential_error(c, ln_2, 1200.0);
    let mut off = *c;
    off[0] = f64::from_bits(off[0].to_bits() + 8);
    // One term less, an entry off by eight units, the second part of ln 2 left out.
    let faults = [
        exponential_error(&c[..11], ln_2, 1200.0),
        exponential_error(&off, ln_2, 1200.0),
        exponential_error(c, [ln_2[0], 0.0], 1200.0),
    ];
    for faulty in faults {
        assert!(faulty > 5.0 * sound, "{sound} {faulty}");
    }
    let mut faulty = CODE.clone();
    faulty.tables.exponential = faults[0];
    let at = next_to_real_axis()[1];
    assert!(worst_re(&faulty, &at) > worst_re(&CODE, &at) + 0.3);
}

#[test]
fn components_are_proved_where_all_formulas_beside_the_real_axis_meet() {
    let watch = Watch::default();
    let wanted = |_: usize, r: &Rectangle| (8.0..16.0).contains(&r.a[1].max(r.b[1]));
    let found = upper_half_plane(&CODE, UPPER_HALF_PLANE, &watch, wanted).expect("not stopped");
    assert!(found.open.is_empty(), "{:?}", found.open.first());
    let summary = found.summary().expect("rectangles");
    let most = summary.component.expect("each formula").bound;
    assert!(most <= UPPER_HALF_PLANE.component && summary.norm.bound <= UPPER_HALF_PLANE.norm);
}

/// Where the low part of c₁, which the formula leaves out, is worth a unit in the last place.
#[test]
fn the_imaginary_part_in_a_cell_is_within_its_bound() {
    let at = Rectangle {
        a: [0.125, 0.125],
        b: [1.8125, 1.875f64.next_down()],
    };
    let cell = Formula::Cell {
        centre: (0.0, 1.75),
    };
    let most = bound(&CODE.tables, cell, &at, CODE.rounding)
        .expect("a cell")
        .im;
    // The worst found of 400 000.
    let z = Complex::new(0.125, 1.8716325734632453);
    let w = w_f64(z.re, z.im, 100).expect("decided").im;
    let off = (Float::with_val(200, faddeeva(z).im) - w.mid()).abs();
    let ulp = 2f64.powi(w.mid().get_exp().expect("not zero") - 53);
    let off = (off / ulp).to_f64();
    assert!((0.8..=most).contains(&off), "{off} {most}");
}
