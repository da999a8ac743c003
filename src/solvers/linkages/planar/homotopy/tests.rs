//! Tests of `homotopy`: closed forms, and what is counted where a path fails.

use super::*;

fn c(re: f64, im: f64) -> Complex64 {
    Complex64::new(re, im)
}

/// A circle, `|x - at|² = radius²`.
fn circle(at: Complex64, radius: f64) -> Bilinear {
    vec![
        vec![c(at.norm_sqr() - radius * radius, 0.0), -at],
        vec![-at.conj(), ONE],
    ]
}

/// A line, `Re(conj(normal) x) = height`.
fn line(normal: Complex64, height: f64) -> Bilinear {
    vec![
        vec![c(-2.0 * height, 0.0), normal],
        vec![normal.conj(), ZERO],
    ]
}

/// The forms of two unknowns, each of which has two of its own.
fn side_by_side(first: [Bilinear; 2], second: [Bilinear; 2]) -> Vec<Bilinear> {
    let place = |form: &Bilinear, at: usize| {
        let mut wide = vec![vec![ZERO; 3]; 3];
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            wide[i * at][j * at] = form[i][j];
        }
        wide
    };
    let first = first.iter().map(|f| place(f, 1));
    first.chain(second.iter().map(|f| place(f, 2))).collect()
}

/// Real ends, complex ones, those at infinity, singular ones and lost ones.
fn counts(of: &Ends) -> [usize; 5] {
    [of.real.len(), of.complex, of.infinite, of.singular, of.lost]
}

fn counted(forms: &[Bilinear]) -> [usize; 5] {
    counts(&all(forms))
}

fn assert_near(found: &[Complex64], due: &[Complex64], within: f64) {
    assert_eq!(found.len(), due.len());
    for (a, b) in found.iter().zip(due) {
        assert!((a - b).norm() <= within, "{found:?} {due:?}");
    }
}

/// Every expected point is found once.
fn assert_same(found: &[Vec<Complex64>], due: &[Vec<Complex64>], within: f64) {
    assert_eq!(found.len(), due.len());
    for p in due {
        let near = |q: &&Vec<Complex64>| q.iter().zip(p).all(|(a, b)| (a - b).norm() <= within);
        assert_eq!(found.iter().filter(near).count(), 1, "{found:?} {p:?}");
    }
}

/// The deformation `x² = from + (to - from) t`, written as `x y = …`, `x = y`.
fn root(from: Complex64, to: Complex64) -> Homotopy {
    let equal = vec![ZERO, -ONE, ONE, ZERO];
    Homotopy {
        width: 2,
        target: vec![vec![-to, ZERO, ZERO, ONE], equal.clone()],
        start: vec![vec![-from, ZERO, ZERO, ONE], equal],
        factors: Vec::new(),
        patches: [vec![ONE, c(0.1, 0.3)], vec![c(0.9, 0.2), c(-0.2, 0.1)]],
    }
}

/// `x = y` in the patches.
fn point(of: &Homotopy, x: Complex64) -> Vec<Complex64> {
    let patch = |p: &Vec<Complex64>| {
        let size = p[0] + p[1] * x;
        [size.inv(), x / size]
    };
    of.patches.iter().flat_map(patch).collect()
}

fn work() -> Work {
    Work {
        matrix: vec![ZERO; 16],
        right: vec![ZERO; 4],
        slope: [0; 4].map(|_| vec![ZERO; 4]),
        point: vec![ZERO; 4],
    }
}

/// The progress of a path, and whether its end is regular.
fn came(h: &Homotopy, v: &mut Vec<Complex64>, careful: bool) -> (f64, bool) {
    let end = h.follow(v, careful);
    (end.t, end.regular)
}

/// The published values of SplitMix64 for the seed 1234567.
#[test]
fn the_constants_are_those_of_split_mix() {
    let due = [
        6_457_827_717_110_365_317u64,
        3_203_168_211_198_807_973,
        9_817_491_932_198_370_423,
    ]
    .map(|z| (z >> 11) as f64 / (1u64 << 53) as f64);
    let mut random = Random(1_234_567);
    assert_eq!(due.map(|_| random.next()), due);
    let mut random = Random(1_234_567);
    for u in due {
        let z = random.phase();
        assert!((z.norm() - 1.0).abs() < 1e-15);
        let turns = z.arg() / std::f64::consts::TAU - u;
        assert!((turns - turns.round()).abs() < 1e-15);
    }
    // Vectors have sizes between a half and one.
    let sizes = Random(3).vector(400).into_iter().map(Complex64::norm);
    let (low, high) = (sizes.clone().fold(1.0, f64::min), sizes.fold(0.0, f64::max));
    assert!((0.5..0.51).contains(&low) && (0.99..=1.0).contains(&high));
}

#[test]
fn complex_systems_are_solved() {
    // The first pivot is zero, the second needs rows to change places.
    let rows = [
        [ZERO, c(2.0, 1.0), c(0.0, -1.0), ONE],
        [c(0.0, 1.0), c(1.0, 0.0), c(3.0, 0.0), ZERO],
        [c(0.0, -2.0), c(-2.0, 0.0), c(1.0, 5.0), c(0.5, 0.5)],
        [c(1.0, 1.0), ZERO, c(2.0, -2.0), c(0.0, 4.0)],
    ];
    let due = [c(1.0, -1.0), c(0.0, 2.0), c(-3.0, 0.5), c(0.25, 0.0)];
    let mut a = rows.concat();
    let mut b: Vec<Complex64> = rows.iter().map(|r| product(r, &due)).collect();
    assert!(solve(&mut a, &mut b));
    assert_near(&b, &due, 1e-14);
}

#[test]
fn singular_systems_are_refused() {
    let mut a = [c(1.0, 1.0), c(2.0, 0.0), c(2.0, 2.0), c(4.0, 0.0)];
    assert!(!solve(&mut a, &mut [ONE, ONE]));
    let mut a = [ZERO, ONE, ZERO, ONE];
    assert!(!solve(&mut a, &mut [ONE, ONE]));
    for wrong in [f64::NAN, f64::INFINITY] {
        let mut a = [c(wrong, 0.0), ONE, ONE, ZERO];
        assert!(!solve(&mut a, &mut [ONE, ONE]));
    }
}

/// No size of a group and neither seed has a start that is singular.
#[test]
fn factors_vanish_at_the_starts() {
    for n in 1..=MOST_UNKNOWNS {
        let forms = vec![vec![vec![ONE; n + 1]; n + 1]; 2 * n];
        for seed in [1, 2] {
            let h = Homotopy::new(&forms, seed);
            let flat = h.target.iter().chain(&h.start);
            assert!(flat.into_iter().all(|m| (norm(m) - 1.0).abs() < 1e-14));
            for set in subsets(2 * n, n) {
                let v = h.beginning(&set).unwrap();
                let (x, y) = v.split_at(h.width);
                for (first, [a, b]) in set.iter().zip(&h.factors) {
                    let gone = if *first { product(a, x) } else { product(b, y) };
                    assert!(gone.norm() < 1e-12 * norm(&v));
                }
                for (p, z) in h.patches.iter().zip([x, y]) {
                    assert!((product(p, z) - ONE).norm() < 1e-12 * norm(&v));
                }
            }
        }
    }
}

#[test]
fn newton_s_method_finds_the_root_nearby() {
    let h = root(ONE, c(4.0, 0.0));
    let x = 2.5f64.sqrt();
    let due = point(&h, c(x, 0.0));
    let mut v = point(&h, c(x + 1e-3, 2e-3));
    // Off the patch too.
    v.iter_mut().for_each(|z| *z *= 1.01);
    assert!(h.correct(0.5, &mut v, &mut work(), 6, 1e-13));
    assert_near(&v, &due, 1e-14);
    // A single round suffices at the root, and not elsewhere.
    for (off, enough) in [(0.0, true), (1e-3, false)] {
        let mut v = point(&h, c(x + off, 0.0));
        let found = h.correct(0.5, &mut v, &mut work(), 1, 1e-13);
        assert_eq!(found, enough);
    }
}

/// A correction that does not halve ends the search, however many rounds are left.
#[test]
fn newton_s_method_does_not_wander() {
    let h = root(ONE, ONE);
    for start in [c(0.02, 1.0), c(-0.05, 0.6), c(0.001, 0.3), c(0.01, -2.0)] {
        let mut v = point(&h, start);
        let found = h.correct(0.5, &mut v, &mut work(), 60, 1e-13);
        assert!(!found, "{start}");
    }
    let mut none = root(ONE, ONE);
    none.patches[0].fill(ZERO);
    let mut v = point(&h, ONE);
    assert!(!none.correct(0.5, &mut v, &mut work(), 60, 1e-13));
}

/// The error of a step falls with the fifth power of its length.
#[test]
fn steps_are_of_fourth_order() {
    let h = root(ONE, c(2.0, 2.0));
    let at = |t: f64| point(&h, (ONE + c(1.0, 2.0) * t).sqrt());
    let error = |step: f64| {
        let mut out = vec![ZERO; 4];
        assert!(h.predict(0.2, step, &at(0.2), &mut work(), &mut out));
        let off: Vec<Complex64> = out.iter().zip(at(0.2 + step)).map(|(a, b)| a - b).collect();
        norm(&off)
    };
    let ratio = error(0.1) / error(0.05);
    assert!((24.0..40.0).contains(&ratio), "{ratio}");
    assert!(error(0.1) < 1e-5);
}

/// The equations vanish half-way.
#[test]
fn steps_fail_where_the_equations_vanish() {
    let mut h = root(ONE, ONE);
    h.start.iter_mut().flatten().for_each(|z| *z = -*z);
    let v = point(&h, ONE);
    let mut out = vec![ZERO; 4];
    assert!(h.predict(0.0, 0.4, &v, &mut work(), &mut out));
    assert!(!h.predict(0.5, 0.1, &v, &mut work(), &mut out));
    // In the middle of the step, and at its end.
    assert!(!h.predict(0.0, 1.0, &v, &mut work(), &mut out));
    assert!(!h.predict(0.0, 0.5, &v, &mut work(), &mut out));
    let mut none = root(ONE, c(4.0, 0.0));
    none.patches[1].fill(ZERO);
    assert_eq!(came(&none, &mut v.clone(), false), (0.0, false));
}

/// Two roots that pass one another keep apart, however near they come.
#[test]
fn paths_do_not_jump() {
    for k in 0..120 {
        let (side, sign) = ([1.0, -1.0][k % 2], [1.0, -1.0][k / 2 % 2]);
        let past = side * 10f64.powf(-0.05 * k as f64);
        let h = root(c(-0.4, past), c(0.6, past));
        for careful in [false, true] {
            // The principal square root is continuous there.
            let mut v = point(&h, c(-0.4, past).sqrt() * sign);
            assert_eq!(came(&h, &mut v, careful), (1.0, true), "{past}");
            assert_near(&v, &point(&h, c(0.6, past).sqrt() * sign), 1e-14);
        }
    }
}

/// From the first step Newton's method settles, but in the other root.
#[test]
fn steps_to_another_root_are_refused() {
    let side = Complex64::from_polar(1.0, -1.25);
    let square = |t: f64| side * c(139.0 * (t - 0.0391), 0.028);
    let h = root(square(0.0), square(1.0));
    let due = |t: f64| point(&h, (square(t) / side).sqrt() * side.sqrt());
    let mut v = vec![ZERO; 4];
    assert!(h.predict(0.0, 0.05, &due(0.0), &mut work(), &mut v));
    assert!(h.correct(0.05, &mut v, &mut work(), 4, 1e-9));
    assert!(v.iter().zip(due(0.05)).any(|(a, b)| (a - b).norm() > 1.0));
    let mut v = due(0.0);
    assert_eq!(came(&h, &mut v, false), (1.0, true));
    assert_near(&v, &due(1.0), 1e-13);
}

/// On their way, or in a double root at the end.
#[test]
fn paths_that_meet_go_no_farther() {
    for (from, to, until) in [(c(-0.4, 0.0), c(0.6, 0.0), 0.4), (c(0.3, 0.8), ZERO, 1.0)] {
        let h = root(from, to);
        for careful in [false, true] {
            let mut v = point(&h, from.sqrt());
            let (t, regular) = came(&h, &mut v, careful);
            assert!((t - until).abs() < 1e-7 && t <= 1.0 && !regular);
            assert_near(&v, &point(&h, ZERO), 1e-3);
        }
    }
}

#[test]
fn two_circles() {
    let circles = |apart: f64| [circle(ZERO, 2.0), circle(c(apart, 0.0), 1.5)];
    // Both points have Re x = (apart² + 1.75) / (2 apart).
    let along = (6.25 + 1.75) / 5.0;
    let high = (4.0f64 - along * along).sqrt();
    let ends = all(&circles(2.5));
    assert_eq!(counts(&ends), [2, 0, 0, 0, 0]);
    let due = [vec![c(along, high)], vec![c(along, -high)]];
    assert_same(&ends.real, &due, 1e-13);
    // Too far apart, and one inside the other.
    assert_eq!(counted(&circles(4.0)), [0, 2, 0, 0, 0]);
    assert_eq!(counted(&circles(0.3)), [0, 2, 0, 0, 0]);
    // Tangent to one another, from without and from within, or so nearly that Newton's method
    // cannot tell.
    for apart in [3.5, 3.5 - 1e-13, 3.5 + 1e-13, 0.5] {
        let ends = all(&circles(apart));
        assert_eq!(counts(&ends), [2, 0, 0, 2, 0]);
        for x in &ends.real {
            assert_near(x, &[c(2.0, 0.0)], 1e-5);
        }
    }
    // Around one centre: the isotropic lines through it.
    assert_eq!(counted(&circles(0.0)), [0, 0, 2, 0, 0]);
    // Points far away, not at infinity.
    let far = 1e5;
    let wide = far * 2f64.sqrt();
    let ends = all(&[circle(ZERO, wide), circle(c(2.0 * far, 0.0), wide)]);
    assert_eq!(counts(&ends), [2, 0, 0, 0, 0]);
    let due = [vec![c(far, far)], vec![c(far, -far)]];
    assert_same(&ends.real, &due, 1e-6);
}

/// Tangent circles whose point is far away, not at infinity.
#[test]
fn far_ends_that_are_singular() {
    for far in [150.0, 1e3, 5e3] {
        let ends = all(&[circle(ZERO, far), circle(c(2.0 * far, 0.0), far)]);
        assert_eq!(counts(&ends), [2, 0, 0, 2, 0], "{far}");
        for x in &ends.real {
            assert_near(x, &[c(far, 0.0)], 0.05 * far);
        }
    }
}

/// Regular ends by their distance, singular ones where they still come nearer to infinity.
#[test]
fn where_paths_have_ended() {
    let fate = |t: f64, regular: bool, share: f64, earlier: f64| {
        Arrival {
            t,
            regular,
            share,
            earlier,
        }
        .fate()
    };
    for earlier in [1e-12, 1.0] {
        assert_eq!(fate(1.0, true, 0.9e-9, earlier), Fate::Infinite);
        assert_eq!(fate(1.0, true, 1e-9, earlier), Fate::Finite);
        assert_eq!(fate(1.0, false, 0.9e-9, earlier), Fate::Infinite);
    }
    assert_eq!(fate(1.0, false, 1e-2, 1.0), Fate::Finite);
    assert_eq!(fate(1.0, false, 0.0099, 1.0), Fate::Infinite);
    assert_eq!(fate(1.0, false, 0.001, 0.002), Fate::Finite);
    assert_eq!(fate(1.0, false, 0.001, 0.0021), Fate::Infinite);
    // Singular ends are those of paths that came there.
    let close = 1.0 - 1e-6;
    for (share, due) in [(1e-4, Fate::Infinite), (0.1, Fate::Finite)] {
        assert_eq!(fate(close + 1e-8, false, share, 1.0), due);
        assert_eq!(fate(close, false, share, 1.0), Fate::Lost);
        assert_eq!(fate(0.5, true, share, 1.0), Fate::Finite);
    }
    assert_eq!(fate(f64::NAN, false, 0.0, 1.0), Fate::Lost);
}

/// Doubled after some good steps, halved after one that was not, never above the longest.
#[test]
fn the_pace_of_steps() {
    let mut pace = Pace::new(0.25, 3);
    assert_eq!(
        (pace.step, pace.next(0.5), pace.next(0.9)),
        (0.125, 0.625, 1.0)
    );
    let mut steps = Vec::new();
    for _ in 0..7 {
        pace.accept();
        steps.push(pace.step);
    }
    assert_eq!(steps, [0.125, 0.125, 0.25, 0.25, 0.25, 0.25, 0.25]);
    // One that was not good begins the count anew, and so does a change.
    pace.accept();
    assert!(pace.refuse() && pace.step == 0.125);
    pace.accept();
    assert!(pace.refuse() && pace.step == 0.0625);
    for due in [0.0625, 0.0625, 0.125, 0.125, 0.125, 0.25] {
        pace.accept();
        assert_eq!(pace.step, due);
    }
    pace.step = 2.0 * SHORTEST;
    assert!(pace.refuse() && !pace.refuse());
}

/// The smaller one of both spaces, whatever the point's size.
#[test]
fn shares_of_the_first_coordinates() {
    let h = root(ONE, ONE);
    let v = [c(3.0, 0.0), c(0.0, 4.0), ONE, ZERO];
    for size in [1.0, 1e-3, 1e3] {
        let share = |from: usize| {
            let turned: Vec<Complex64> = (0..4).map(|k| v[(k + from) % 4] * size).collect();
            h.share(&turned)
        };
        assert!((share(0) - 0.6).abs() < 1e-15 && (share(2) - 0.6).abs() < 1e-15);
    }
}

/// To four digits of the whole point.
#[test]
fn predictions_that_hold() {
    assert!(is_close(&[ONE, c(0.0, 3.0)], &[ONE, c(0.0, 3.0003)]));
    assert!(!is_close(&[ONE, c(0.0, 3.0)], &[ONE, c(0.0, 3.000_33)]));
    assert!(!is_close(&[c(f64::NAN, 0.0)], &[ONE]));
}

#[test]
fn iterations_settle_or_are_given_up() {
    assert_eq!(judged(1e-9, 1.0, 1e-9), Some(true));
    assert_eq!(judged(1e-9, 1e-9, 1e-9), Some(true));
    assert_eq!(judged(1e-9f64.next_up(), 1.0, 1e-9), None);
    assert_eq!(judged(0.25, 0.5, 1e-9), None);
    assert_eq!(judged(0.25f64.next_up(), 0.5, 1e-9), Some(false));
    for size in [f64::NAN, f64::INFINITY] {
        assert_eq!(judged(size, f64::MAX, 1e-9), Some(false));
    }
}

#[test]
fn lines_meet_at_infinity_too() {
    let first = line(c(0.6, 0.8), 1.0);
    let ends = all(&[first.clone(), line(ONE, 0.5)]);
    assert_eq!(counts(&ends), [1, 0, 1, 0, 0]);
    assert_near(&ends.real[0], &[c(0.5, 0.875)], 1e-14);
    // Parallels: a double end.
    assert_eq!(counted(&[first, line(c(0.6, 0.8), -2.0)]), [0, 0, 2, 0, 0]);
}

/// Two of the six paths end where x₀ = y₀ = 0.
#[test]
fn pairs_of_circles_side_by_side() {
    let first = [circle(ZERO, 1.0), circle(ONE, 1.0)];
    let second = [circle(c(0.0, 1.0), 1.0), circle(c(0.0, -0.5), 0.9)];
    let apart = [circle(ZERO, 1.0), circle(c(3.0, 1.0), 1.0)];
    let ends = all(&side_by_side(first.clone(), second));
    assert_eq!(counts(&ends), [4, 0, 2, 0, 0]);
    let x = [0.75f64.sqrt(), -0.75f64.sqrt()].map(|h| c(0.5, h));
    // The squares of the distances differ by 3 h.
    let high: f64 = (0.25 - 0.81) / -3.0;
    let wide = (2.0 * high - high * high).sqrt();
    let y = [wide, -wide].map(|w| c(w, high));
    let due = [0, 1, 2, 3].map(|k| vec![x[k / 2], y[k % 2]]);
    assert_same(&ends.real, &due, 1e-13);
    for one in [first, apart.clone()] {
        let forms = side_by_side(one, apart.clone());
        assert_eq!(counted(&forms), [0, 4, 2, 0, 0]);
    }
}

/// A form without coefficients tells nothing: no path is followed.
#[test]
fn paths_that_cannot_begin_are_lost() {
    let forms = [vec![vec![ZERO; 2]; 2], circle(ZERO, 1.0)];
    assert_eq!(counted(&forms), [0, 0, 0, 0, 2]);
}

/// Equations that pass a double root on their way from the start of the first seed.
#[test]
fn other_constants_save_what_is_lost() {
    let start = Homotopy::new(&[circle(ZERO, 1.0), circle(ONE, 1.0)], 1).start;
    let tangent = [circle(ZERO, 1.0), circle(c(2.5, 0.0), 1.5)];
    let t = 0.8;
    // t u + (1 - t) s = λ m with |u| = 1.
    let forms = [0, 1].map(|k| {
        let (m, s) = (tangent[k].concat(), &start[k]);
        let dot: f64 = m.iter().zip(s).map(|(a, b)| (a.conj() * b).re).sum();
        let (size, p) = (norm(&m).powi(2), (1.0 - t) * dot);
        let lambda = (p + (p * p + size * (2.0 * t - 1.0)).sqrt()) / size;
        let u = |i: usize| (m[i] * lambda - s[i] * (1.0 - t)) / t;
        vec![vec![u(0), u(1)], vec![u(2), u(3)]]
    });
    for careful in [false, true] {
        assert_eq!(counts(&run(&forms, 1, careful)), [0, 0, 0, 0, 2]);
    }
    // They are not Hermitian, so no end has a partner.
    assert_eq!(counted(&forms), counts(&run(&forms, 2, true)));
    assert_eq!(all(&forms).complex, 2);
}

fn finite(x: &[Complex64], y: &[Complex64], regular: bool) -> Finite {
    let (x, y) = (x.to_vec(), y.to_vec());
    Finite { x, y, regular }
}

/// A solution and its partner.
fn pair(x: Complex64, y: Complex64, regular: bool) -> [Finite; 2] {
    [(x, y), (y.conj(), x.conj())].map(|(x, y)| finite(&[x], &[y], regular))
}

fn sorted(list: Vec<Finite>) -> [usize; 5] {
    let mut ends = Ends::default();
    sort(list, &mut ends);
    counts(&ends)
}

#[test]
fn real_ends_and_pairs_are_told_apart() {
    let (p, q) = (c(1.0, 2.0), c(-3.0, 0.5));
    let mut ends = Ends::default();
    let real = finite(&[p, q], &[p.conj(), q.conj()], true);
    sort(vec![real], &mut ends);
    assert_eq!(counts(&ends), [1, 0, 0, 0, 0]);
    assert_eq!(ends.real, [[p, q]]);
    assert_eq!(sorted(pair(p, q, true).into()), [0, 2, 0, 0, 0]);
    // One component alone is real.
    let half = finite(&[p, q], &[p.conj(), q], true);
    assert_eq!(sorted(vec![half]), [0, 1, 0, 0, 1]);
    // A pair that is nearly real is a pair, unless its ends are known no better.
    let near = c(1.0, -2.0 + 1e-5);
    assert_eq!(sorted(pair(p, near, true).into()), [0, 2, 0, 0, 0]);
    assert_eq!(sorted(pair(p, near, false).into()), [2, 0, 0, 0, 0]);
}

/// Twins agree to 1e-8 of one more than the largest coordinate, real ends to 1e-7, singular ones to
/// 1e-3.
#[test]
fn tolerances_grow_with_the_coordinates() {
    for p in [c(3.0, 4.0), c(0.3, -0.4), c(0.0, 0.0)] {
        let scale = 1.0 + p.norm();
        let twins = |off: f64| {
            let end = |x: Complex64| finite(&[x], &[x.conj()], true);
            sorted(vec![end(p), end(p + off * scale)])
        };
        assert_eq!(twins(0.95e-8), [1, 0, 0, 0, 1], "{p}");
        assert_eq!(twins(1.05e-8), [2, 0, 0, 0, 0], "{p}");
        for (regular, near) in [(true, 1e-7), (false, 1e-3)] {
            let real = |off: f64| {
                let pair = pair(p, p.conj() + off * scale, regular);
                sorted(pair.into())[0]
            };
            assert_eq!((real(0.95 * near), real(1.05 * near)), (2, 0), "{p}");
        }
        // A partner that is off by as much is missed.
        let missing = |off: f64| {
            let [a, mut b] = pair(p, p.conj() + 1.0, true);
            b.y[0] += off * (1.0 + p.norm().max((p.conj() + 1.0).norm()));
            sorted(vec![a, b])[4]
        };
        assert_eq!((missing(0.9e-7), missing(1.1e-7)), (0, 2), "{p}");
    }
}

#[test]
fn missing_partners_are_counted() {
    let (p, q, r) = (c(1.0, 2.0), c(-3.0, 0.5), c(0.5, -1.0));
    let end = |x: Complex64, y: Complex64| finite(&[x], &[y], true);
    let [first, second] = pair(p, q, true);
    assert_eq!(sorted(vec![first, end(r, p), second]), [0, 3, 0, 0, 1]);
    // Partners in x or y alone.
    for other in [end(q.conj(), r), end(r, p.conj())] {
        assert_eq!(sorted(vec![end(p, q), other]), [0, 2, 0, 0, 2]);
    }
    // Of singular ends no partner is asked.
    assert_eq!(sorted(vec![finite(&[p], &[q], false)]), [0, 1, 0, 0, 0]);
}

#[test]
fn twins_are_counted_as_lost() {
    for size in [1e-13, 1.0, 1e3] {
        let (p, q) = (c(size, 2.0 * size), c(-3.0 * size, 0.5 * size));
        let off = c(1e-12, 1e-12) * (1.0 + size);
        let real = |off| finite(&[p + off, q], &[p.conj(), q.conj()], true);
        assert_eq!(sorted(vec![real(ZERO), real(off)]), [1, 0, 0, 0, 1]);
    }
    let (p, q) = (c(1.0, 2.0), c(-3.0, 0.5));
    // Ends that agree in part, and opposite ones, are no twins.
    let list = [[p, q], [p, -q], [-p, q], [-p, -q]];
    let real = list.map(|x| finite(&x, &x.map(|z| z.conj()), true));
    assert_eq!(sorted(real.into()), [4, 0, 0, 0, 0]);
    // Nor are two that share x or y alone.
    for [first, second] in [[(p, q), (p, -q)], [(q, p), (-q, p)]] {
        let list = [first, second].into_iter();
        let list = list.flat_map(|(x, y)| pair(x, y, true)).collect();
        assert_eq!(sorted(list), [0, 4, 0, 0, 0]);
    }
    // Paths may meet in a singular end.
    let real = |regular| finite(&[p], &[p.conj()], regular);
    for (a, b) in [(false, false), (true, false), (false, true)] {
        assert_eq!(sorted(vec![real(a), real(b)]), [2, 0, 0, 0, 0]);
    }
    // Of three in one place two are lost.
    let three = vec![real(true), real(true), real(true)];
    assert_eq!(sorted(three), [1, 0, 0, 0, 2]);
}
