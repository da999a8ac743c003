//! Special values, domains, radii, and balls of every kind.

use super::*;
use crate::{Ball, Mag};
use rug::float::{exp_max, exp_min};
use rug::{Float, Rational};
use std::time::Instant;

type One = fn(&Ball, u32) -> Evaluated;
type Two = fn(&Ball, &Ball, u32) -> Evaluated;

const ONE: [(&str, One); 42] = [
    ("sqrt", sqrt),
    ("cbrt", cbrt),
    ("exp", exp),
    ("exp2", exp2),
    ("exp10", exp10),
    ("expm1", expm1),
    ("log", log),
    ("log2", log2),
    ("log10", log10),
    ("log1p", log1p),
    ("sin", sin),
    ("cos", cos),
    ("tan", tan),
    ("sinpi", sinpi),
    ("cospi", cospi),
    ("tanpi", tanpi),
    ("asin", asin),
    ("acos", acos),
    ("atan", atan),
    ("sinh", sinh),
    ("cosh", cosh),
    ("tanh", tanh),
    ("asinh", asinh),
    ("acosh", acosh),
    ("atanh", atanh),
    ("erf", erf),
    ("erfc", erfc),
    ("erfcx", erfcx),
    ("erfi", erfi),
    ("dawson", dawson),
    ("tgamma", tgamma),
    ("lgamma", lgamma),
    ("digamma", digamma),
    ("fabs", fabs),
    ("floor", floor),
    ("ceil", ceil),
    ("round", round),
    ("trunc", trunc),
    ("nearbyint", nearbyint),
    ("recip", recip),
    ("sqr", sqr),
    ("cube", |x, prec| powi(x, 3, prec)),
];

const TWO: [(&str, Two); 13] = [
    ("add", add),
    ("sub", sub),
    ("mul", mul),
    ("div", div),
    ("hypot", hypot),
    ("pow", pow),
    ("atan2", atan2),
    ("fmin", fmin),
    ("fmax", fmax),
    ("fdim", fdim),
    ("fmod", fmod),
    ("remainder", remainder),
    ("copysign", copysign),
];

/// Balls of every kind.
fn hostile() -> Vec<Ball> {
    let power = |bits: u32, e: i32| (Float::with_val(bits, 1) << (e - 1)) * 1.5f64;
    let mut mids = vec![Float::new(2), -Float::new(2)];
    let far = [
        exp_min(), exp_min() + 1, -(1 << 29), -(1 << 20), -5000, -300, -60, -1, 0, 1, 2, 3, 10, 20,
        26, 27, 28, 40, 64, 65, 300, 5000, 140_000, 1 << 20, 1 << 29, exp_max() - 1, exp_max(),
    ];
    for e in far {
        for bits in [2, 64] {
            mids.push(power(bits, e.max(exp_min() + 1)));
            mids.push(-power(bits, e.max(exp_min() + 1)));
        }
    }
    for x in [-1.0, 1.0, 0.5, -0.5, -2.5, -7.0, 1e300, -1e300, 2.0f64.powi(-1000) - 3.0] {
        mids.push(Float::with_val(53, x));
    }
    mids.push(Float::with_val(2000, -5) + (Float::with_val(53, 1) >> 1500u32));
    let rads = [
        Mag::ZERO,
        Mag::power_of_two(-(1 << 40)),
        Mag::power_of_two(i64::from(exp_min()) - 1),
        Mag::power_of_two(-3000),
        Mag::power_of_two(-70),
        Mag::from_f64(0.3),
        Mag::from_f64(5.0),
        Mag::power_of_two(1 << 29),
        Mag::power_of_two(1 << 40),
        Mag::INFINITY,
    ];
    let mut all = Vec::new();
    for mid in &mids {
        for rad in rads {
            all.push(Ball::new(mid.clone(), rad));
        }
        all.push(Ball::new(mid.clone(), Mag::above(mid).shift(-20)));
        all.push(Ball::new(mid.clone(), Mag::above(mid)));
    }
    all
}

#[test]
fn no_ball_panics_or_runs_long() {
    let balls = hostile();
    let mut longest = (0.0, String::new());
    let mut timed = |name: String, run: &dyn Fn()| {
        let start = Instant::now();
        run();
        let seconds = start.elapsed().as_secs_f64();
        if seconds > 0.05 { eprintln!("{seconds:.3} {name}"); }
        if seconds > longest.0 {
            longest = (seconds, name);
        }
    };
    for (name, f) in ONE {
        for (k, x) in balls.iter().enumerate() {
            for prec in [2, 64, 300] {
                let text = format!("{name} {} ± {:?} {prec}", x.mid(), x.rad());
                let _ = k;
                timed(text, &|| drop(f(x, prec)));
            }
        }
    }
    let some: Vec<&Ball> = balls.iter().step_by(7).collect();
    for (name, f) in TWO {
        for x in &some {
            for y in &some {
                let text = format!("{name} {} ± {:?}, {} ± {:?}", x.mid(), x.rad(), y.mid(), y.rad());
                timed(text, &|| drop(f(x, y, 64)));
            }
        }
    }
    eprintln!("{longest:?}");
}
