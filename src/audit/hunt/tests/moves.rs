//! The moves of a climb.

use super::*;

#[test]
fn moves_stay_within_reach() {
    let mut draw = Draw::new(1, "m", "moves", 0);
    let x = [1.0, -2.0, 0.0, 5e-324];
    let near = (0..1000)
        .filter(|_| within_reach(&x, &moved(&x, &mut draw)))
        .count();
    assert!(near > 300, "{near}");
    assert!(!within_reach(&x, &[1.0, 2.0, 0.0, 5e-324]));
    assert!(!within_reach(&x, &[5.0, -2.0, 0.0, 5e-324]));
    assert!(!within_reach(&x, &[1.0, -2.0, 1e-300, 5e-324]));
}

/// A factor of four either way and no farther; nothing that is no number, nor another length.
#[test]
fn the_reach_is_a_factor_of_four() {
    for s in [1.0, -1.0] {
        for (x, expected) in [
            (4.0, true),
            (4f64.next_up(), false),
            (0.25, true),
            (0.25f64.next_down(), false),
            (0.0, false),
            (f64::NAN, false),
            (f64::INFINITY, false),
        ] {
            assert_eq!(within_reach(&[s], &[s * x]), expected, "{s} {x}");
        }
    }
    assert!(within_reach(&[0.0, 1.0], &[-0.0, 1.0]));
    assert!(!within_reach(&[1.0], &[1.0, 1.0]) && !within_reach(&[1.0, 1.0], &[1.0]));
    assert!(!within_reach(&[1.0, 1.0], &[1.0, 8.0]));
    assert!(!within_reach(&[f64::INFINITY], &[f64::INFINITY]));
}

#[test]
fn numbers_move_by_neighbours() {
    for (x, by, expected) in [
        (1.0, 1, 1f64.next_up()),
        (1.0, -1, 1f64.next_down()),
        (-1.0, 1, (-1f64).next_down()),
        (1.0, 1 << 52, 2.0),
        (0.0, 3, 3.0 * 5e-324),
        (f64::MAX, 1, f64::INFINITY),
        (f64::INFINITY, -1, f64::INFINITY),
        (f64::NEG_INFINITY, 1, f64::NEG_INFINITY),
    ] {
        let mut v = x;
        by_bits(&mut v, by);
        assert_eq!(v, expected, "{x} {by}");
    }
}

/// An edge keeps none to eight bits behind the point and is such a number or next to it, all alike
/// often.
#[test]
fn edges_have_few_bits() {
    // Every bit is set: cut off after j of them, 2 - 2^-j is left.
    let x = 2f64.next_down();
    let kept: Vec<f64> = (0..=8).map(|j| 2.0 - 2f64.powi(-j)).collect();
    let mut draw = Draw::new(1, "m", "edges", 0);
    let mut counts = [[0; 3]; 9];
    for _ in 0..5400 {
        let y = edge(&[x], &mut draw)[0];
        let place = kept.iter().enumerate().find_map(|(j, k)| {
            let beside = [k.next_down(), *k, k.next_up()];
            beside.iter().position(|b| *b == y).map(|side| (j, side))
        });
        let (j, side) = place.expect("a number of few bits");
        counts[j][side] += 1;
    }
    assert!(
        counts.as_flattened().iter().all(|n| (140..260).contains(n)),
        "{counts:?}"
    );
    for side in 0..3 {
        let n: i32 = counts.iter().map(|c| c[side]).sum();
        assert!((1650..1950).contains(&n), "{counts:?}");
    }
}

/// One coordinate becomes an edge, each as often; infinities and NaN stay.
#[test]
fn an_edge_is_one_coordinate() {
    let x = [1.3, -1.3, 1.3e100];
    let mut draw = Draw::new(2, "m", "edges", 0);
    let mut changed = [0; 3];
    for _ in 0..3000 {
        let y = edge(&x, &mut draw);
        let places: Vec<usize> = (0..3).filter(|k| y[*k] != x[*k]).collect();
        assert_eq!((y.len(), places.len()), (3, 1));
        changed[places[0]] += 1;
        // Less than half is cut off.
        let ratio = y[places[0]] / x[places[0]];
        assert!((0.5..=1.0).contains(&ratio), "{ratio}");
    }
    assert!(
        changed.iter().all(|n| (900..1100).contains(n)),
        "{changed:?}"
    );
    assert!(edge(&[], &mut draw).is_empty());
    for _ in 0..100 {
        assert_eq!(edge(&[f64::INFINITY], &mut draw), [f64::INFINITY]);
        assert!(edge(&[f64::NAN], &mut draw)[0].is_nan());
    }
}

/// Of ten moves five are a power of two of neighbours in one coordinate, two up to four neighbours
/// in all, two a factor on one, one an edge.
#[test]
fn moves_are_of_four_kinds() {
    const X: f64 = 1.3;
    const N: usize = 40_000;
    let mut draw = Draw::new(1, "m", "moves", 0);
    let [mut all, mut bits, mut factors, mut edges] = [0; 4];
    let mut steps = [[0; 9]; 3];
    let mut sizes = [[0; 2]; 46];
    let mut places = [0; 3];
    let (mut least, mut most) = ([1f64; 2], [0f64; 2]);
    for _ in 0..N {
        let y = moved(&[X; 3], &mut draw);
        let by = |k: usize| y[k].to_bits() as i64 - X.to_bits() as i64;
        let changed: Vec<usize> = (0..3).filter(|k| by(*k) != 0).collect();
        let &[k] = changed.as_slice() else {
            all += 1;
            (0..3).for_each(|k| steps[k][(by(k) + 4) as usize] += 1);
            continue;
        };
        places[k] += 1;
        let size = by(k).unsigned_abs();
        let below = y[k].to_bits().wrapping_add(1) & ((1 << 44) - 1);
        let up = usize::from(by(k) > 0);
        if size.is_power_of_two() {
            bits += 1;
            sizes[size.trailing_zeros() as usize][up] += 1;
        } else if below <= 2 {
            edges += 1;
        } else if size > 4 {
            factors += 1;
            let change = (y[k] / X - 1.0).abs();
            least[up] = least[up].min(change);
            most[up] = most[up].max(change);
        }
    }
    let near = |n: i32, share: f64| (f64::from(n) / N as f64 - share).abs() < 0.008;
    // One in thirty of the moves of all coordinates leaves two or three of them where they are.
    assert!(near(all, 0.2 * (1.0 - 24.0 / 729.0)), "{all}");
    assert!(
        near(bits, 0.5) && near(factors, 0.2) && near(edges, 0.1),
        "{bits} {factors} {edges}"
    );
    assert!(places.iter().all(|n| near(*n, 0.8 / 3.0)), "{places:?}");
    // Up to four neighbours either way, each about as often.
    let few = 0.7 * f64::from(all) / 9.0;
    assert!(
        steps.as_flattened().iter().all(|n| f64::from(*n) > few),
        "{steps:?}"
    );
    // Up to 2^44 neighbours, either way.
    assert!(
        sizes[..45].as_flattened().iter().all(|n| *n > 150),
        "{sizes:?}"
    );
    assert!(sizes[45].iter().all(|n| *n < 5), "{sizes:?}");
    // Factors between 1e-12 and one half from one.
    for up in 0..2 {
        assert!((0.999e-12..1.2e-12).contains(&least[up]), "{least:?}");
        assert!((0.45..=0.5).contains(&most[up]), "{most:?}");
    }
}

#[test]
fn nothing_cannot_be_moved() {
    let mut draw = Draw::new(1, "m", "moves", 0);
    assert!((0..100).all(|_| moved(&[], &mut draw).is_empty()));
    let same = (0..900)
        .filter(|_| moved(&[1.3], &mut draw) == [1.3])
        .count();
    assert!(same < 60, "{same}");
}

/// A climb from one: the inputs judged, the worst, and the evaluations made.
fn climbed(method: Planted, evaluations: u64) -> (Vec<f64>, Option<Worst>, u64) {
    climbed_by(method, evaluations, 0)
}

/// [`climbed`] by the moves of that stream.
fn climbed_by(method: Planted, evaluations: u64, k: u64) -> (Vec<f64>, Option<Worst>, u64) {
    let seen = Mutex::new(Vec::new());
    let Planted {
        solve,
        admits,
        outputs,
        ..
    } = method;
    let method = Planted {
        solve: Box::new(|x| {
            seen.lock().unwrap().push(x[0]);
            solve(x)
        }),
        admits,
        outputs,
        ..Planted::default()
    };
    let never = never();
    let mut h = hunter(&method, 2000, &|_| {}, &never);
    let answer = answer_of(&method, &[1.0]);
    let start = judged(&method, &h.settings, 1, vec![1.0], answer);
    let seed = Seed {
        found: start,
        kind: "edge",
        region: "middle",
    };
    let mut draw = Draw::new(1, "planted", "climb", k);
    h.climb(&seed, 0, evaluations, &mut draw);
    let (made, worst) = (h.made, h.worst.remove(0));
    assert_eq!(h.left, 2000 - made);
    let inputs = seen.lock().unwrap().split_off(1);
    (inputs, worst, made)
}

/// Ten rounds of sixteen without a gain end a climb; until then it walks on among equals.
#[test]
fn a_climb_without_gain_ends() {
    let mut far = 0;
    for k in 0..16 {
        let (seen, worst, made) = climbed_by(wrong_by(|_| 1), 1000, k);
        assert_eq!((made, seen.len()), (160, 160));
        // From one a single move reaches from 0.5 to 1.5.
        far += usize::from(seen.iter().any(|x| !(0.5..=1.5).contains(x)));
        let worst = worst.unwrap();
        assert!(is(worst.share, 0.25));
        assert_eq!(worst.output, "x");
        assert_eq!(worst.reason, "climbed from edge in middle");
    }
    assert!(far > 0);
}

/// A gain starts the count of rounds again.
#[test]
fn a_gain_gives_ten_more_rounds() {
    let (_, worst, made) = climbed(wrong_by(|x| u64::from(x[0] != 1.0)), 1000);
    assert_eq!(made, 176);
    assert!(is(worst.unwrap().share, 0.25));
}

/// A climb does not move to a smaller error.
#[test]
fn a_climb_never_goes_down() {
    let (seen, _, made) = climbed(wrong_by(|x| 2 * u64::from(x[0] == 1.0)), 1000);
    assert_eq!(made, 160);
    assert!(seen.iter().all(|x| (0.5..=1.5).contains(x)));
}

/// Where the error grows with the number, a climb comes to the end of its reach and no farther.
#[test]
fn a_climb_finds_the_worst_within_reach() {
    let method = Planted {
        outputs: vec![output("x", Limit::Absolute(1.0))],
        solve: Box::new(|x| SolverAnswer::Values(vec![2.0 * x[0]])),
        ..Planted::default()
    };
    let (seen, worst, made) = climbed(method, 1500);
    assert_eq!(made, 1500);
    assert!(seen.iter().all(|x| (0.25..=4.0).contains(x)));
    assert!(worst.unwrap().input[0] > 3.9);
}

/// A climb has its number of evaluations, even if the last round is cut.
#[test]
fn a_climb_uses_its_evaluations() {
    for evaluations in [0, 1, 16, 50, 159] {
        assert_eq!(climbed(wrong_by(|_| 0), evaluations).2, evaluations);
    }
    // No more than there are.
    let (_, _, made) = climbed(wrong_by(|x| (x[0].to_bits() >> 8) & 0xffff), u64::MAX);
    assert!(made <= 2000);
}

/// Eight times as many moves are tried as are judged; where none is admitted the climb ends.
#[test]
fn a_climb_ends_where_nothing_is_admitted() {
    let asked = AtomicUsize::new(0);
    let admits = |_: &[f64]| {
        asked.fetch_add(1, Ordering::Relaxed);
        false
    };
    let method = Planted {
        admits: Box::new(admits),
        ..wrong_by(|_| 0)
    };
    let (seen, _, made) = climbed(method, 1000);
    assert_eq!((seen.len(), made), (0, 0));
    assert_eq!(asked.load(Ordering::Relaxed), 128);
}

/// Admitted inputs may be rare; nothing else is judged.
#[test]
fn a_climb_stays_in_the_domain() {
    let method = Planted {
        admits: Box::new(|x| x[0].to_bits() % 2 == 0),
        ..wrong_by(|_| 0)
    };
    let (seen, _, made) = climbed(method, 1000);
    assert_eq!(made, 160);
    assert!(seen.iter().all(|x| x.to_bits() % 2 == 0));
}

/// A hunt finds the same inputs wherever it runs.
#[test]
fn moves_are_those_of_the_stream() {
    let mut draw = Draw::new(1, "m", "moves", 0);
    let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
    let mut last = Vec::new();
    for _ in 0..200 {
        last = moved(&[1.3, -2e-5], &mut draw);
        for x in &last {
            hash = (hash ^ x.to_bits()).wrapping_mul(0x0100_0000_01b3);
        }
    }
    let found = (
        hash,
        last.iter()
            .map(|x| crate::hex_float(*x))
            .collect::<Vec<_>>(),
    );
    let expected = r#"(9eb99c3593b8ce98, ["0x1.4cccccccccccdp+0", "-0x1.4f8b588e368efp-16"])"#;
    assert_eq!(format!("{found:x?}"), expected);
}

/// Seeds and moves are numbers of the format, and a climb does not stay where it is.
#[test]
fn a_hunt_draws_numbers_of_the_format() {
    let seen = Mutex::new(Vec::new());
    let method = Planted {
        format: Format::Single,
        solve: Box::new(|x| {
            seen.lock().unwrap().push(x[0]);
            SolverAnswer::Values(x.to_vec())
        }),
        ..Planted::default()
    };
    told(&method, 300);
    let mut seen = seen.lock().unwrap();
    assert_eq!(seen.len(), 300);
    assert!(seen.iter().all(|x| f64::from(*x as f32) == *x));
    seen.sort_by(f64::total_cmp);
    seen.dedup();
    assert!(seen.len() > 200, "{}", seen.len());
}
