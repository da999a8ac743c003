//! Evaluations at the ends of the range, beside zero, of one operation, and one after another.

use super::tests::{only, setting, ways, x_of};
use super::*;
use crate::grid::power_of_two;
use crate::pinned::{bit_by_bit, counted, digest};
use mechaudit_solvers::faddeeva::proof::Real;

/// Checks that what a product by a power of two lost below the normal numbers is handed on with
/// what it lost.
#[test]
fn digits_below_the_normal_numbers_are_lost_twice() {
    let [p, lost] = only(|| {
        let x = Tracked::input(0, [1.0, 1.1].map(|x| x * 2f64.powi(-60)));
        let (p, lost) = x.two_prod(x_of(2f64.powi(-1000)));
        [p, lost].map(Tracked::result)
    });
    assert!(p.tiny == 1.0 && lost.tiny >= 1.0 && lost.exact.is_zero());
    // Their products do not share the error of a number that has all its digits.
    let [full, short] = only(|| {
        let x = Tracked::input(0, [1e-305, 1.1e-305]);
        let y = x * x_of(2f64.powi(-20));
        let c = Tracked::input(1, [1e200, 1.1e200]);
        [x * c, y * c].map(Tracked::result)
    });

    assert!(
        full.relative < 1.2e-16 && short.relative > 2e-13,
        "{full:?} {short:?}"
    );
}

/// Nothing of an evaluation is left to the next one of the thread.
#[test]
fn evaluations_are_apart() {
    let constants = [Constant {
        stored: 0.75,
        exact: Interval::point(0.7),
        error: Interval::point(0.05),
    }];
    let with = Setting {
        constants: &constants,
        ..setting(Rounding::default())
    };
    let program = || x_of(1.0).like(0.75).result().error;
    assert!(evaluate(with, program).expect("a bound")[0] > 0.0);
    assert_eq!(ways(program), Ok(vec![0.0]));
    // A failure in the middle of the ways.
    let undecided = || Tracked::input(0, [1.0, 2.0]).below(x_of(1.5));
    let fails = ways(|| {
        let below = undecided();
        if !below {
            (x_of(1.0) / Tracked::input(1, [-1.0, 1.0])).result();
        }
        below
    });
    assert!(fails.is_err());
    assert_eq!(ways(undecided), Ok(vec![true, false]));
    // Products of what stands where the last evaluation had a multiple of another number.
    let y = only(|| {
        let x = Tracked::input(0, [1.0, 1.1]);
        x * x_of(4.0)
    });
    let found = only(|| {
        let x = Tracked::input(0, [1.0, 1.1]);
        let mut last = x;
        while last.0 < y.0 {
            last = Tracked::input(1, [1.5, 1.6]);
        }
        let c = Tracked::input(0, [3.0, 3.1]);
        [x * c, last * c][1].result()
    });
    assert!(
        found.exact.lo >= 4.49 && found.exact.hi <= 4.97,
        "{found:?}"
    );
}

/// All that is known of a number without a look back.
fn known(x: Tracked) -> String {
    here(|e| {
        let (pass, solver, i) = (&e.pass, e.solver(), x.place());
        let ranges = (solver.exact[i], pass.float[i], pass.value[i]);
        let errors = (pass.noise[i], pass.error[i], solver.share[i]);
        let tiny = (solver.tiny[i], solver.absolute[i]);
        format!(
            "{ranges:?} {errors:?} {tiny:?} {} {}",
            solver.small[i], pass.grain[i]
        )
    })
}

/// Numbers of every kind: zero and other constants, of few and many binades, small, with errors,
/// next to both ends of the range.
fn pool() -> Vec<Tracked> {
    let mut all = [0.0, -0.0, 1.0, 3.0, 0.1, -0.5, 1e-290, 1e300]
        .map(x_of)
        .to_vec();
    all.extend([f64::from_bits(1), f64::MIN_POSITIVE, 2f64.powi(1000)].map(x_of));
    let boxes = [
        [1.0, 1.1],
        [0.5, 1.0],
        [-1.0, 2.0],
        [0.0, 1.0],
        [-2.0, 0.0],
        [1e-320, 1e-310],
        [0.5e-300, 2e-300],
        [1e300, 1e307],
        [1.25, 1.25],
    ];
    all.extend(
        boxes
            .iter()
            .enumerate()
            .map(|(i, ends)| Tracked::input(i % 2, *ends)),
    );
    let (s, x) = (Tracked::sigma(), all[11]);
    let (y, low) = (x * all[12], all[17] * all[17]);
    all.extend([
        s,
        s * x,
        y,
        y * all[5],
        low,
        low * x_of(0.25),
        x * x_of(8.0),
    ]);
    all
}

/// Every operation with every two numbers of the pool: all that is known of the results.
#[test]
fn operations_bit_by_bit() {
    let constants = [Constant {
        stored: 0.1,
        exact: Interval::new(0.099, 0.1),
        error: Interval::new(0.0, 0.001),
    }];
    let mut found = Vec::new();
    for sigma in [[1e-9, 1e-3], [0.0, 1e-3], [1e-300, 1e-290]] {
        let setting = Setting {
            sigma: Exact::coordinate(Interval::new(sigma[0], sigma[1]), 0),
            constants: &constants,
            rounding: Rounding::default(),
        };
        let mut numbers = Vec::new();
        let ended = evaluate(setting, || {
            let all = pool();
            let zero = all[0];
            for (i, x) in all.iter().enumerate() {
                let one = [
                    x.like(0.1),
                    x.like(-0.1),
                    -*x,
                    x.magnitude(),
                    x.raised(1e-300),
                    x.raised(0.5),
                ];
                numbers.extend(one.map(known));
                for (j, y) in all.iter().enumerate() {
                    let ((p, q), (s, t)) = (x.two_prod(*y), x.two_sum(*y));
                    numbers.extend([p, q, s, t, x.fma(*y, zero)].map(known));
                    if (i + j) % 3 == 0 {
                        let (s, t) = x.fast_two_sum(*y);
                        numbers.extend([s, t, x.fma(*y, all[(i * j) % all.len()])].map(known));
                    }
                }
            }
            numbers.len()
        });
        let count = numbers.len() as f64;
        found.push(("numbers", digest(numbers), count));
        let mut quotients = Vec::new();
        let number = evaluate(setting, || pool().len()).expect("no division")[0];
        for (i, j) in (0..number).flat_map(|i| (0..number).map(move |j| (i, j))) {
            if (i + j) % 4 == 1 {
                quotients.push(evaluate(setting, || {
                    let all = pool();
                    known(all[i] / all[j])
                }));
            }
        }
        found.push((
            "quotients",
            digest(&quotients),
            quotients.iter().flatten().count() as f64,
        ));
        found.push(counted("end", [ended]));
    }
    let due = [
        ("numbers", 0x5fcea67f88c613f8, 4536.0),
        ("quotients", 0xc8bc0ce2891b13c9, 127.0),
        ("end", 0xc7e7b0ba58a446df, 1.0),
        ("numbers", 0x609f068b9c7e6d58, 4536.0),
        ("quotients", 0xe2436ca4b2a2ecdc, 113.0),
        ("end", 0xc7e7b0ba58a446df, 1.0),
        ("numbers", 0x4081ad043366bb6e, 4536.0),
        ("quotients", 0xc041c168ca962dc6, 129.0),
        ("end", 0xc7e7b0ba58a446df, 1.0),
    ];
    bit_by_bit(&found, &due);
}

/// Products by powers of two and those that share their error, at the ends of what they serve for.
#[test]
fn powers_of_two_bit_by_bit() {
    let setting = Setting {
        sigma: Exact::coordinate(Interval::new(1e-9, 1e-3), 0),
        ..setting(Rounding::default())
    };
    let powers = [
        -1074, -1022, -1021, -1000, -500, -30, -1, 0, 1, 30, 500, 1000, 1022, 1023,
    ];
    let mut scaled = Vec::new();
    let ended = evaluate(setting, || {
        let fine = Tracked::input_on_grid(0, [1.0, 1.9], -60);
        for x in pool().into_iter().chain([fine]) {
            for k in powers {
                scaled.extend([power_of_two(k), -power_of_two(k)].map(|by| known(x * x_of(by))));
            }
        }
    });
    let mut shared = Vec::new();
    for size in [0.7e-250, 1e-250, 1.5e-250, 0.7e-9, 1.0] {
        for wide in [1.001, 1e3] {
            for k in [-60, -31, -30, -29, -28, -1, 1, 28, 29, 30, 31, 60] {
                for sign in [1.0, -1.0] {
                    shared.push(evaluate(setting, || {
                        let x = Tracked::input(0, [1.0, 1.001]);
                        let c = Tracked::input(1, [size, size * wide]);
                        let (p, q) = x.two_prod(c);
                        let multiple = x * x_of(sign * power_of_two(k));
                        let (r, s) = multiple.two_prod(c);
                        let (t, _) = c.two_prod(multiple * x_of(2.0));
                        [p, q, r, s, t].map(|x| (known(x), x.result()))
                    }));
                }
            }
        }
    }
    let grids = [-969, -970, -971, -1000].map(|k| {
        evaluate(setting, || {
            let x = Tracked::input(0, [1.0, 1.1]);
            let (p, q) = x.two_prod(Tracked::input(1, [1.0, 1.1].map(|c| c * power_of_two(k))));
            let subnormal =
                Tracked::input(0, [power_of_two(k), power_of_two(k)]) * x_of(power_of_two(-53));
            [p, q, subnormal].map(known)
        })
    });
    let found = [
        counted("scaled", scaled),
        counted("end", [ended]),
        counted("shared", shared),
        counted("grids", grids),
    ];
    let due = [
        ("scaled", 0xa9fafbf140e3e56f, 784.0),
        ("end", 0xc7e7b0ba58a446df, 1.0),
        ("shared", 0x0156c1fcbaa45a89, 240.0),
        ("grids", 0x58a50774a3fdeaa9, 4.0),
    ];
    bit_by_bit(&found, &due);
}

/// Checks what is decided at equality, how far decisions are followed, and what stands for a number
/// that has failed.
#[test]
fn decisions_bit_by_bit() {
    let of = |lo: f64, hi: f64| {
        let x = || Tracked::input(0, [lo, hi]);
        let all = ways(|| {
            x().fma(x_of(1.0), x_of(ROUND))
                .constant()
                .expect("a number")
                - ROUND
        });
        all.map(|w| (w[0], w.len()))
    };
    let integers = [
        of(0.4, 4095.4),
        of(0.4, 4094.4),
        of(0.4, 4096.4),
        of(1e9f64.next_down(), 1e9f64.next_down()),
        of(1e9, 1e9),
        of(-2.5, 2.5),
    ];
    let chosen = [2, 4096, 4097, 4098].map(|n| ways(|| here(|e| e.choose(n))).map(|w| w.len()));
    let products = [
        0.0, 1e-291, 0.75e-290, 1e-290, 1.5e-290, 3e-290, 1e-100, 0.1,
    ];
    let products = products
        .iter()
        .flat_map(|x| [1.0, 0.5, 0.1].map(|y| exact_product(*x, y)));
    let sums = [0.0, 1.0, 3.0, -1.0, 0.1, 1e-17, 1e300];
    let sums = sums.iter().flat_map(|x| sums.map(|y| exact_sum(*x, y)));
    let mut seen = Vec::new();
    let failed = ways(|| {
        let x = Tracked::input(0, [1.0, 2.0]);
        let y = here(|e| e.fail("planted"));
        seen.push((known(y), x.is_odd(), x_of(3.0).is_odd()));
    });
    let below = [
        [1.0, 2.0],
        [2.0, 3.0],
        [2.5, 3.0],
        [0.5, 1.0],
        [1.0, 1.0],
        [2.0, 2.0],
    ];
    let below = below.map(|y| ways(|| Tracked::input(0, [1.0, 2.0]).below(Tracked::input(1, y))));
    let mixed = Setting {
        sigma: Exact::coordinate(Interval::new(1e-9, 1e-3), 0),
        ..setting(Rounding::default())
    };
    let alike = evaluate(mixed, || {
        let all = [
            Tracked::sigma(),
            x_of(0.0),
            Tracked::input(1, [1.0, 2.0]),
            x_of(2.0),
        ];
        let pairs = all.iter().flat_map(|x| all.map(|y| (*x, y)));
        let both =
            |(x, y)| here(|e: &mut Evaluation| (e.alike(x, y), e.factors(x, y), e.exact_sum(x, y)));
        pairs.map(both).collect::<Vec<_>>()
    });
    let twice = Setting {
        rounding: Rounding {
            fma_rounds_twice: true,
            truncates: Some(2),
        },
        ..mixed
    };
    let mut faults = Vec::new();
    let ended = evaluate(twice, || {
        let all = pool();
        let three = all.iter().zip(&all[3..]).zip(&all[7..]);
        let f = |((x, y), z): ((&Tracked, &Tracked), &Tracked)| [x.fma(*y, *z), x.two_prod(*y).1];
        faults.extend(three.flat_map(f).map(known));
    });
    let found = [
        counted("integers", integers),
        counted("chosen", chosen),
        counted("products", products),
        counted("sums", sums),
        counted("failed", [format!("{failed:?} {seen:?}")]),
        counted("below", below),
        counted("alike", alike.expect("no division").into_iter().flatten()),
        counted("faults", faults),
        counted("end", [ended]),
    ];
    let due = [
        ("integers", 0x1473f3b077d9e67c, 6.0),
        ("chosen", 0x87e3d6cb428b8f11, 4.0),
        ("products", 0xda8d4bf1b02dff9b, 24.0),
        ("sums", 0x6d82bd60f5c26b02, 49.0),
        ("failed", 0x56288913b6a8a50d, 1.0),
        ("below", 0x798935e53b8cb608, 6.0),
        ("alike", 0xcd10db365fb2e98a, 16.0),
        ("faults", 0x8dc996219b201756, 40.0),
        ("end", 0xc7e7b0ba58a446df, 1.0),
    ];
    bit_by_bit(&found, &due);
}
