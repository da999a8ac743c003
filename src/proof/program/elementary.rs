//! Elementary functions of intervals: values with MPFR's directed rounding, and derivatives.

use crate::interval::Interval;
use mechaudit_symbolic::Func;
use rug::Float;
use rug::float::{Constant, Round};

/// The value at a number, rounded down or up.
fn rounded(f: Func, x: f64, way: Round) -> f64 {
    let x = Float::with_val(53, x);
    macro_rules! of {
        ($method:ident) => {
            Float::with_val_round(53, x.$method(), way)
                .0
                .to_f64_round(way)
        };
    }
    match f {
        Func::Exp => of!(exp_ref),
        Func::Exp2 => of!(exp2_ref),
        Func::Exp10 => of!(exp10_ref),
        Func::Expm1 => of!(exp_m1_ref),
        Func::Log => of!(ln_ref),
        Func::Log2 => of!(log2_ref),
        Func::Log10 => of!(log10_ref),
        Func::Log1p => of!(ln_1p_ref),
        Func::Cbrt => of!(cbrt_ref),
        Func::Sin => of!(sin_ref),
        Func::Cos => of!(cos_ref),
        Func::Tan => of!(tan_ref),
        Func::Asin => of!(asin_ref),
        Func::Acos => of!(acos_ref),
        Func::Arctan => of!(atan_ref),
        Func::Sinh => of!(sinh_ref),
        Func::Cosh => of!(cosh_ref),
        Func::Tanh => of!(tanh_ref),
        Func::Asinh => of!(asinh_ref),
        Func::Acosh => of!(acosh_ref),
        Func::Atanh => of!(atanh_ref),
        Func::Erf => of!(erf_ref),
        Func::Erfc => of!(erfc_ref),
        _ => f64::NAN,
    }
}

fn ends(f: Func, from: f64, to: f64) -> Interval {
    Interval::new(rounded(f, from, Round::Down), rounded(f, to, Round::Up))
}

/// π.
pub(super) fn pi() -> Interval {
    let end = |way| Float::with_val_round(53, Constant::Pi, way).0.to_f64();
    Interval::new(end(Round::Down), end(Round::Up))
}

/// The whole numbers between which `x/π − shift` lies, for every x of an interval.
fn turns(x: Interval, shift: f64) -> Option<[f64; 2]> {
    if x.magnitude() > 1e6 {
        return None;
    }
    let t = x / pi() - Interval::point(shift);
    Some([t.lo.ceil(), t.hi.floor()])
}

/// Cosine and sine have their peaks where `x/π − shift` is a whole number: 1 of even ones, −1 of
/// odd.
fn wave(f: Func, x: Interval, shift: f64) -> Interval {
    let all = Interval { lo: -1.0, hi: 1.0 };
    let Some([from, to]) = turns(x, shift) else {
        return all;
    };
    let ends = ends(f, x.lo, x.lo).hull(ends(f, x.hi, x.hi));
    let ends = ends.meet(all);
    if to < from {
        return ends;
    }
    if to > from {
        return all;
    }
    match from.rem_euclid(2.0) == 0.0 {
        true => Interval::new(ends.lo, 1.0),
        false => Interval::new(-1.0, ends.hi),
    }
}

/// The values of a function over an interval; everything where it has a pole or is not defined.
pub(super) fn range(f: Func, x: Interval) -> Interval {
    if !(x.lo.is_finite() && x.hi.is_finite()) {
        return Interval::ALL;
    }
    match f {
        Func::Sin => wave(f, x, 0.5),
        Func::Cos => wave(f, x, 0.0),
        Func::Cosh => {
            let (least, most) = (x.mignitude(), x.magnitude());
            ends(f, least, most)
        }
        Func::Acos | Func::Erfc => ends(f, x.hi, x.lo),
        Func::Tan => match turns(x, 0.5) {
            Some([from, to]) if to < from => ends(f, x.lo, x.hi),
            _ => Interval::ALL,
        },
        Func::Log | Func::Log2 | Func::Log10 if x.lo <= 0.0 => Interval::ALL,
        Func::Log1p if x.lo <= -1.0 => Interval::ALL,
        Func::Atanh if x.magnitude() >= 1.0 => Interval::ALL,
        // Not numbers outside of their domains: everything.
        f => ends(f, x.lo, x.hi),
    }
}

fn one() -> Interval {
    Interval::point(1.0)
}

fn times(k: f64, x: Interval) -> Interval {
    Interval::point(k) * x
}

/// The first and the second derivative over an interval, from the values y there.
pub(super) fn slopes(f: Func, x: Interval, y: Interval) -> [Interval; 2] {
    let ln = |k: f64| range(Func::Log, Interval::point(k));
    match f {
        Func::Exp => [y, y],
        Func::Exp2 => [y * ln(2.0), y * ln(2.0).square()],
        Func::Exp10 => [y * ln(10.0), y * ln(10.0).square()],
        Func::Expm1 => [y + one(), y + one()],
        Func::Log => [one() / x, -(one() / x.square())],
        Func::Log2 | Func::Log10 => {
            let base = ln(if f == Func::Log2 { 2.0 } else { 10.0 });
            [one() / (x * base), -(one() / (x.square() * base))]
        }
        Func::Log1p => {
            let x = x + one();
            [one() / x, -(one() / x.square())]
        }
        Func::Cbrt => {
            let square = y.square();
            let slope = one() / times(3.0, square);
            [slope, times(-2.0, slope) / times(3.0, x)]
        }
        Func::Sin => [range(Func::Cos, x), -y],
        Func::Cos => [-range(Func::Sin, x), -y],
        Func::Tan => {
            let slope = y.square() + one();
            [slope, times(2.0, y) * slope]
        }
        Func::Asin | Func::Acos => {
            let square = one() - x.square();
            let root = square.sqrt();
            let (slope, curve) = (one() / root, x / (square * root));
            match f {
                Func::Asin => [slope, curve],
                _ => [-slope, -curve],
            }
        }
        Func::Arctan => {
            let square = x.square() + one();
            [one() / square, times(-2.0, x) / square.square()]
        }
        Func::Sinh => [range(Func::Cosh, x), y],
        Func::Cosh => [range(Func::Sinh, x), y],
        Func::Tanh => {
            let slope = (one() - y.square()).meet(Interval { lo: 0.0, hi: 1.0 });
            [slope, times(-2.0, y) * slope]
        }
        Func::Asinh => {
            let square = x.square() + one();
            let root = square.sqrt();
            [one() / root, -(x / (square * root))]
        }
        Func::Acosh => {
            let square = x.square() - one();
            let root = square.sqrt();
            [one() / root, -(x / (square * root))]
        }
        Func::Atanh => {
            let square = one() - x.square();
            [one() / square, times(2.0, x) / square.square()]
        }
        Func::Erf | Func::Erfc => {
            let scale = Interval::point(2.0) / pi().sqrt();
            let slope = scale * range(Func::Exp, -x.square());
            let slope = if f == Func::Erf { slope } else { -slope };
            [slope, times(-2.0, x) * slope]
        }
        _ => [Interval::ALL; 2],
    }
}

/// `x^k` over an interval.
pub(super) fn power(x: Interval, k: i32) -> Interval {
    if k < 0 {
        return one() / power(x, k.saturating_neg());
    }
    let of = |x: f64, way| {
        use rug::ops::Pow;
        let x = Float::with_val(53, x);
        Float::with_val_round(53, (&x).pow(k), way)
            .0
            .to_f64_round(way)
    };
    if !(x.lo.is_finite() && x.hi.is_finite()) {
        return Interval::ALL;
    }
    match k {
        0 => one(),
        k if k % 2 == 1 || x.lo >= 0.0 => Interval::new(of(x.lo, Round::Down), of(x.hi, Round::Up)),
        _ => {
            let (least, most) = (x.mignitude(), x.magnitude());
            Interval::new(of(least, Round::Down), of(most, Round::Up))
        }
    }
}
