//! FLINT's example integrals (`examples/integrals.c`, 39 of them) as formulas: a row for each with
//! its value to 30 digits, or the reason why there is none, and the time in microseconds.
//!
//! `cargo run --release --bin integrals [NUMBER...]`

use mechaudit::study::Study;
use mechaudit_symbolic::evaluation::{Answer, Goal};
use std::time::Duration;

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Bits of 30 digits and of the hundredth of a unit of the last one that printing asks for.
const BITS: u32 = 110;

/// Time after which an integral is not repeated.
const ENOUGH: Duration = Duration::from_millis(300);

/// Numbers of FLINT's list with their formulas. Where a part of a complex integral is zero the
/// other stands here.
const INTEGRALS: [(u32, &str); 39] = [
    (0, "int(x, 0, 100, sin(x))"),
    (1, "4*int(x, 0, 1, 1/(1 + x^2))"),
    (2, "2*int(x, 0, inf, 1/(1 + x^2))"),
    (3, "4*int(x, 0, 1, sqrt(1 - x^2))"),
    (4, "int(x, 0, 8, sin(x + exp(x)))"),
    (5, "int(x, 1, 101, floor(x))"),
    (
        6,
        "int(x, 0, 1, abs(x^4 + 10*x^3 + 19*x^2 - 6*x - 6)*exp(x))",
    ),
    // The path is its own mirror image in the real axis: twice the part above it.
    (
        7,
        "(re(int(t, 0, 1, riemannzeta(2 + i*t)) - int(t, 0, 1, riemannzeta(-1 + i*t))) - im(int(t, -1, 2, riemannzeta(t + i))))/pi",
    ),
    (8, "int(x, 0, 1, sin(1/x))"),
    (9, "int(x, 0, 1, x*sin(1/x))"),
    (10, "int(x, 0, 10000, x^1000*exp(-x))"),
    (11, "im(int(t, 0, 1000, i*tgamma(1 + i*t)))"),
    (12, "int(x, -10, 10, sin(x) + exp(-200 - x^2))"),
    (13, "int(x, -1020, -1010, exp(x))"),
    (14, "int(x, 0, inf, exp(-x^2))"),
    (
        15,
        "int(x, 0, 1, 1/cosh(10*(x - 0.2))^2 + 1/cosh(100*(x - 0.4))^4 + 1/cosh(1000*(x - 0.6))^6)",
    ),
    (16, "int(x, 0, 8, (exp(x) - floor(exp(x)))*sin(x + exp(x)))"),
    (17, "int(x, 0, inf, 1/cosh(x))"),
    (18, "int(x, 0, inf, 1/cosh(x)^3)"),
    (19, "int(x, 0, 1, -log(x)/(1 + x))"),
    (20, "int(x, 0, inf, x*exp(-x)/(1 + exp(-x)))"),
    (
        21,
        "re((int(t, -1/2, 1/2, i*weierp(1/2 + i*t, i)/(1/2 + i*t)^11) - int(t, -1/2, 1/2, weierp(t + i/2, i)/(t + i/2)^11) - int(t, -1/2, 1/2, i*weierp(-1/2 + i*t, i)/(-1/2 + i*t)^11) + int(t, -1/2, 1/2, weierp(t - i/2, i)/(t - i/2)^11))/(2*pi*i))",
    ),
    (
        22,
        "1 + (im(int(t, 0, 1000, i*zetaderivative(1, 100 + i*t)/riemannzeta(100 + i*t)) - int(t, 1/2, 100, zetaderivative(1, t + 1000*i)/riemannzeta(t + 1000*i))) + im(lgamma(1/4 + 500*i)) - 500*log(pi))/pi",
    ),
    (23, "int(x, 0, 1000, lambertw(x))"),
    (24, "int(x, 0, pi, max(sin(x), cos(x)))"),
    (25, "int(x, -1, 1, erf(x/sqrt(0.0002)*0.5 + 1.5)*exp(-x))"),
    (26, "int(x, -10, 10, airyai(x))"),
    (
        27,
        "int(x, 0, 10, (x - floor(x) - 1/2)*max(sin(x), cos(x)))",
    ),
    (28, "im(int(t, -1, 1, i*sqrt(-1 + i*t)))"),
    (29, "int(x, 0, inf, exp(-x^2)*sin(x))"),
    (30, "int(x, 0, inf, exp(-x)*airyai(-x))"),
    (31, "int(x, 0, pi, x*sin(x)/(1 + cos(x)^2))"),
    (32, "int(x, 0, 3, sin((1/1000 + (1 - x)^2)^(-3/2)))"),
    (33, "int(x, 0, inf, besselie(0, x/3)^3)"),
    (34, "int(x, 0, inf, besselie(0, x/15)^15)"),
    (35, "im(int(t, -1, 1, i*(-1 + i*t)^(-1/2)))"),
    (36, "int(x, 0, inf, x/tgamma(1 + x))"),
    (37, "int(x, 0, 1000, sinint(x))"),
    (
        38,
        "int(x, 0, 1000, besselj(0, x)*besselj(1, x)*besselj(2, x))",
    ),
];

/// The processor time of this process, which Linux tells to the nanosecond.
fn processor_time() -> Duration {
    let all = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let spent = all.split_whitespace().next().and_then(|t| t.parse().ok());
    Duration::from_nanos(spent.expect("Linux keeps /proc/self/schedstat"))
}

fn main() {
    let chosen: Vec<u32> = std::env::args()
        .skip(1)
        .filter_map(|a| a.parse().ok())
        .collect();
    println!("number,microseconds,value,formula");
    for (number, formula) in INTEGRALS {
        if !chosen.is_empty() && !chosen.contains(&number) {
            continue;
        }
        let mut spent = Duration::ZERO;
        let mut runs = 0_u32;
        let value = loop {
            // Values without inputs are kept by a study: each run has its own.
            let study = match Study::formula(formula).study() {
                Ok(study) => study,
                Err(e) => break format!("refused: {e}"),
            };
            let start = processor_time();
            let answer = study.answers(&[], Goal::Bits(BITS)).pop();
            spent += processor_time().saturating_sub(start);
            runs += 1;
            if spent < ENOUGH {
                continue;
            }
            break match answer {
                Some(Answer::Number(ball)) => ball.to_decimal(30).unwrap_or_default(),
                Some(Answer::Undecided(why)) => format!("undecided: {why}"),
                Some(Answer::Zero) => "0".into(),
                Some(Answer::Undefined { reason, place }) => {
                    format!("undefined: {reason}: {place}")
                }
                _ => "none".into(),
            };
        };
        let micro = spent.as_secs_f64() * 1e6 / f64::from(runs.max(1));
        println!("{number},{micro:.1},\"{value}\",\"{formula}\"");
    }
}
