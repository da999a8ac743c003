use super::*;

const ENDS: [End; 4] = [
    End::SecondDerivative(0.7),
    End::FirstDerivative(-0.4),
    End::NotAKnot,
    End::SecondDerivative(0.0),
];

fn wiggle(n: usize) -> Vec<f64> {
    (0..n)
        .map(|i| ((i * i * 7 + 3) % 11) as f64 - 5.0)
        .collect()
}

/// S, S' and S'' from both sides of every inner knot, the ordinates, and the end conditions.
fn check<G: Grid>(s: &Spline<G>, boundary: Boundary) {
    let n = s.grid.segments();
    let m = s.second_derivatives();
    let scale = m.iter().fold(1f64, |a, b| a.max(b.abs())) * 1e-11;
    for i in 0..n {
        assert_eq!(s.cell(i).value(s.grid.knot(i)), s.y[i]);
        assert_eq!(s.cell(i).value(s.grid.knot(i + 1)), s.y[i + 1]);
    }
    let jet = |i: usize, x: f64| s.jet_on(i, x);
    for i in 1..n {
        let x = s.grid.knot(i);
        let (a, b) = (jet(i - 1, x), jet(i, x));
        assert!(
            (a.first - b.first).abs() < scale,
            "S' at knot {i} of {n}: {boundary:?}"
        );
        assert!((a.second - b.second).abs() < scale);
    }
    let (first, last) = s.grid.span();
    let (a, b) = (jet(0, first), jet(n - 1, last));
    match boundary {
        Boundary::Periodic => {
            assert!((a.first - b.first).abs() < scale && (a.second - b.second).abs() < scale);
        }
        Boundary::Ends(l, r) => {
            for (end, at, own, next, edge) in
                [(l, a, 0, 1, first), (r, b, n - 1, n.max(2) - 2, last)]
            {
                match end {
                    End::SecondDerivative(v) => assert!((at.second - v).abs() < scale),
                    End::FirstDerivative(v) => {
                        assert_eq!(at.first, v);
                        // Beside the end (11) says the same.
                        let (h, cell) = (s.grid.interval(own).h, s.cell(own));
                        let inwards = if edge == first { h } else { -h };
                        for part in [0.0, 0.01, 0.1, 0.124, 0.126] {
                            let x = edge + part * inwards;
                            let plain = cell.jet_at(cell.fractions(x)).first;
                            assert!((plain - jet(own, x).first).abs() < scale, "{part}");
                        }
                    }
                    End::NotAKnot if n > 1 => {
                        let third = |i: usize| jet(i, s.grid.knot(i)).third;
                        let (p, q) = (third(own), third(next.min(n - 1)));
                        assert!((p - q).abs() < 100.0 * scale, "{p} {q} {n} {boundary:?}");
                    }
                    End::NotAKnot => assert_eq!(at.second, 0.0),
                }
            }
        }
    }
}

#[test]
fn conditions_hold_for_every_pair_of_ends_and_every_size() {
    for n in (2..80).chain([200, 1001]) {
        let x: Vec<f64> = (0..n)
            .map(|i| i as f64 + 0.3 * ((i * 5) % 3) as f64)
            .collect();
        for l in ENDS {
            for r in ENDS {
                let b = Boundary::Ends(l, r);
                let a = CubicSpline::fit(x.clone(), wiggle(n), b);
                let u = UniformCubicSpline::fit(-1.0, 0.25, wiggle(n), b);
                if n < 3 && (l == End::NotAKnot) != (r == End::NotAKnot) {
                    assert_eq!(
                        a.unwrap_err(),
                        CubicSplineError::TooFewKnots { needed: 3, got: 2 }
                    );
                    assert_eq!(
                        u.unwrap_err(),
                        CubicSplineError::TooFewKnots { needed: 3, got: 2 }
                    );
                    continue;
                }
                check(&a.unwrap(), b);
                check(&u.unwrap(), b);
            }
        }
        let mut y = wiggle(n);
        y[n - 1] = y[0];
        check(
            &CubicSpline::fit(x, y.clone(), Boundary::Periodic).unwrap(),
            Boundary::Periodic,
        );
        check(
            &UniformCubicSpline::fit(3.0, 0.5, y, Boundary::Periodic).unwrap(),
            Boundary::Periodic,
        );
    }
}

#[test]
fn sorted_batches_are_bit_identical() {
    let n = 300;
    let u = UniformCubicSpline::fit(-7.3, 0.1, wiggle(n), Boundary::NATURAL)
        .unwrap()
        .with_extrapolation(Extrapolation::Linear);
    let knots: Vec<f64> = (0..n).map(|i| (i as f64).sqrt() - 8.0).collect();
    let v = CubicSpline::fit(knots.clone(), wiggle(n), Boundary::NOT_A_KNOT)
        .unwrap()
        .with_extrapolation(Extrapolation::EndPolynomial);
    for step in [0.001, 0.0123, 0.4, 3.0] {
        let mut x: Vec<f64> = (0..6000).map(|i| -9.0 + step * i as f64).collect();
        x.extend(&knots);
        x.extend((0..n).map(|i| -7.3 + 0.1 * i as f64));
        x.sort_by(f64::total_cmp);
        let (mut a, mut b) = (vec![0.0; x.len()], vec![0.0; x.len()]);
        u.values_sorted(&x, &mut a).unwrap();
        v.values_sorted(&x, &mut b).unwrap();
        for (i, &x) in x.iter().enumerate() {
            assert_eq!(a[i].to_bits(), u.value(x).unwrap().to_bits());
            assert_eq!(b[i].to_bits(), v.value(x).unwrap().to_bits());
        }
        let mut c = vec![0.0; x.len()];
        u.values(&x, &mut c).unwrap();
        assert_eq!(a, c);
        #[cfg(feature = "parallel")]
        {
            u.par_values(&x, &mut c).unwrap();
            assert_eq!(a, c);
            u.par_values_sorted(&x, &mut c).unwrap();
            assert_eq!(a, c);
        }
    }
}

#[test]
fn extrapolation() {
    let y = vec![1.0, 3.0, 2.0, 1.0];
    let s = CubicSpline::fit(vec![0.0, 1.0, 2.0, 3.0], y, Boundary::Periodic).unwrap();
    assert!(matches!(
        s.value(3.5),
        Err(EvaluationError::Outside { index: 0, .. })
    ));
    assert!(matches!(
        s.value(f64::NAN),
        Err(EvaluationError::NotFinite { .. })
    ));
    let e = s.values_sorted(&[0.0, 2.0, 1.0], &mut [0.0; 3]);
    assert_eq!(e, Err(EvaluationError::NotSorted { index: 2 }));
    let e = s.values_sorted(&[0.0, f64::NAN, 1.0], &mut [0.0; 3]);
    assert!(matches!(
        e,
        Err(EvaluationError::NotFinite { index: 1, .. })
    ));
    let e = s.values(&[0.0], &mut []);
    assert_eq!(e, Err(EvaluationError::Length { points: 1, room: 0 }));
    let w = s.clone().with_extrapolation(Extrapolation::Wrap);
    assert_eq!(w.value(7.25), s.value(1.25));
    assert_eq!(w.value(-0.5), s.value(2.5));
    let c = s.clone().with_extrapolation(Extrapolation::Clamp);
    assert_eq!(
        c.jet(5.0).unwrap(),
        Jet {
            value: 1.0,
            ..Jet::default()
        }
    );
    let l = s.clone().with_extrapolation(Extrapolation::Linear);
    let slope = s.jet(0.0).unwrap().first;
    assert!((l.value(-2.0).unwrap() - (1.0 - 2.0 * slope)).abs() < 1e-14);
    let p = s.with_extrapolation(Extrapolation::EndPolynomial);
    let third = p.jet(3.0).unwrap().third;
    assert!((p.jet(4.0).unwrap().second - (p.jet(3.0).unwrap().second + third)).abs() < 1e-13);
}

#[test]
fn typed_errors() {
    use CubicSplineError as E;
    let fit = |x: &[f64], y: &[f64]| {
        CubicSpline::fit(x.to_vec(), y.to_vec(), Boundary::NATURAL).unwrap_err()
    };
    assert_eq!(fit(&[1.0], &[1.0]), E::TooFewKnots { needed: 2, got: 1 });
    assert_eq!(
        fit(&[], &[1.0]),
        E::Length {
            knots: 0,
            values: 1
        }
    );
    let e = fit(&[0.0, 1.0, 1.0], &[0.0; 3]);
    assert_eq!(
        e,
        E::NotIncreasing {
            index: 2,
            previous: 1.0,
            value: 1.0
        }
    );
    let e = fit(&[0.0, 1.0], &[0.0, f64::INFINITY]);
    assert!(matches!(
        e,
        E::NotFinite {
            name: "values",
            index: 1,
            ..
        }
    ));
    assert_eq!(fit(&[0.0, 1.0], &[1e305, 0.0]), E::Overflow { knot: 0 });
    assert_eq!(fit(&[-1e308, 1e308], &[0.0; 2]), E::Overflow { knot: 0 });
    assert_eq!(fit(&[0.0, 1e155], &[0.0; 2]), E::Overflow { knot: 0 });
    let uniform = |o: f64, h: f64, y: &[f64], b| UniformCubicSpline::fit(o, h, y.to_vec(), b);
    for h in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-310, 1e-17] {
        let e = uniform(1.0, h, &[0.0; 4], Boundary::NATURAL).unwrap_err();
        assert!(matches!(e, E::Step { .. }), "{h}: {e}");
    }
    for i in 0..200 {
        for bad in [f64::NAN, f64::INFINITY] {
            let mut y = wiggle(200);
            y[i] = bad;
            let e = uniform(0.0, 1.0, &y, Boundary::NATURAL).unwrap_err();
            assert!(matches!(e, E::NotFinite { index, .. } if index == i), "{e}");
        }
        let mut y = wiggle(200);
        y[i] = 1e302;
        let e = uniform(0.0, 1.0, &y, Boundary::NOT_A_KNOT).unwrap_err();
        assert_eq!(e, E::Overflow { knot: i });
    }
    for (o, h) in [(-1e308, 1e307), (0.0, 1e308), (-1e300, 1e301)] {
        let e = uniform(o, h, &[0.0; 30], Boundary::NATURAL).unwrap_err();
        assert!(matches!(e, E::Overflow { .. }), "{o} {h}: {e}");
    }
    let e = uniform(0.0, 1.0, &[0.0, 1.0, 2.0], Boundary::Periodic).unwrap_err();
    assert!(matches!(e, E::NotPeriodic { .. }));
    let e = uniform(0.0, 1.0, &[0.0; 3], Boundary::clamped(0.0, f64::NAN)).unwrap_err();
    assert!(matches!(
        e,
        E::NotFinite {
            name: "ends",
            index: 1,
            ..
        }
    ));
}

/// Values with each lookup that this processor has, beside those of single points. Returns how many
/// lookups there were.
fn every_lookup_agrees(s: &UniformCubicSpline, x: &[f64], sorted: bool) -> usize {
    let single: Vec<u64> = x.iter().map(|x| s.value(*x).unwrap().to_bits()).collect();
    let mut tried = 0;
    let mut compare = |name: &str, run: &mut dyn FnMut(batch::Batch<UniformKnots>)| {
        let mut out = vec![f64::NAN; x.len()];
        run(batch::Batch {
            spline: s,
            offset: 0,
            x,
            out: &mut out,
            sorted,
        });
        for (i, out) in out.iter().enumerate() {
            assert_eq!(out.to_bits(), single[i], "{name}, S({:e}) = {out:e}", x[i]);
        }
        tried += 1;
    };
    use lookup::Work;
    compare("plain", &mut |b| b.run(lookup::Plain).unwrap());
    #[cfg(all(target_arch = "x86_64", feature = "vectors"))]
    {
        use pulp::x86::{V3, V4};
        if let Some(v) = V3::try_new() {
            compare("256 bits", &mut |b| {
                v.vectorize(
                    #[inline(always)]
                    || b.run(v),
                )
                .unwrap()
            });
        }
        if let Some(v) = V4::try_new() {
            compare("512 bits", &mut |b| {
                v.vectorize(
                    #[inline(always)]
                    || b.run(v),
                )
                .unwrap()
            });
        }
    }
    tried
}

#[test]
fn every_lookup_gives_the_bits_of_single_points() {
    for (n, origin, step) in [
        (2, 0.0, 1.0),
        (9, -1e9, 3.7),
        (10, 0.1, 0.1),
        (41, 0.0, 0.25),
        (300, -7.3, 1e-3),
        (5000, 1e6, 0.3),
    ] {
        // Values beside given slopes have a form of their own.
        let boundary = match n % 2 {
            0 => Boundary::NATURAL,
            _ => Boundary::clamped(3.0, -2.0),
        };
        let s = UniformCubicSpline::fit(origin, step, wiggle(n), boundary).unwrap();
        let (first, last) = s.grid.span();
        // From many points in a segment to many segments between points; knots and their
        // neighbours among them.
        for count in [1, 7, 8, 9, 64, 4001, 60_000] {
            let mut x: Vec<f64> = (0..count)
                .map(|i| first + (last - first) * (i as f64 / count as f64))
                .collect();
            if count > 8 {
                for i in 0..n {
                    let knot = s.grid.knot(i);
                    x.extend([knot.next_down(), knot, knot.next_up()]);
                }
            }
            x.retain(|x| (first..=last).contains(x));
            x.sort_by(f64::total_cmp);
            let tried = every_lookup_agrees(&s, &x, true);
            assert_eq!(every_lookup_agrees(&s, &x, false), tried);
            // Descending, and in leaps.
            x.reverse();
            every_lookup_agrees(&s, &x, false);
            let leaps: Vec<f64> = (0..x.len()).map(|i| x[i * 7919 % x.len()]).collect();
            every_lookup_agrees(&s, &leaps, false);
        }
    }
}
