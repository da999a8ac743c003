//! Tests of the remainder of Taylor panels.

use super::*;

fn problem(w: (i32, i32)) -> Problem {
    let mut values = [0, 0, 0, 0, 0, 0, 0, 0, 1].map(Rational::from);
    values[0] = Rational::from(w);
    Problem::new(&values).unwrap()
}

/// `f = e^{as + bs²}` grows as fast as the bound allows: `|f| ≤ f(R)` on `|s| ≤ R`. The tail holds
/// what m terms leave of its integral, and is greater by Cauchy's estimate alone: by less than `8
/// (m + 1)` times `√(2πm)`.
#[test]
fn the_tail_of_the_fastest_growth() {
    for (a, b) in [(1.0f64, 0.0f64), (2.0, 0.5), (0.25, 2.0), (0.0, 1.0)] {
        for half in [0.25, 1.0, 3.0] {
            for m in [8usize, 16, 40] {
                // k f_k = a f_{k−1} + 2b f_{k−2}, in units of half^k.
                let mut f = vec![1.0, a * half];
                for k in 2..m + 400 {
                    f.push((a * half * f[k - 1] + 2.0 * b * half * half * f[k - 2]) / k as f64);
                }
                let left: f64 = (m..f.len())
                    .filter(|k| k % 2 == 0)
                    .map(|k| f[k] / (k + 1) as f64)
                    .sum();
                let left = 2.0 * half * left;
                let terms = m as f64;
                let radius = 2.0 * terms / (a + (a * a + 8.0 * b * terms).sqrt());
                let ratio = (radius / half).floor();
                if ratio < 2.0 {
                    continue;
                }
                let tail = Tail {
                    start: Mag::from_f64(1.0),
                    rate: Mag::from_f64(a),
                    kappa: Mag::from_f64(b),
                    half: Mag::from_f64(half),
                    ratio,
                };
                let more = tail.after(m as i64).to_f64() / left;
                let most = 8.0 * (terms + 1.0) * (8.0 * terms).sqrt();
                assert!(
                    (1.0..most).contains(&more),
                    "{a} {b} {half} {m}: {more} {most}"
                );
            }
        }
    }
}

/// w + 2n + |q| from above, be they numbers of 64 bits or not.
#[test]
fn the_rate_of_growth_has_three_parts() {
    for (w, n, q, due) in [
        ((3, 1), (0, 1), (0, 1), (3, 1)),
        ((3, 1), (1, 4), (0, 1), (7, 2)),
        ((3, 1), (1, 4), (-5, 1), (17, 2)),
        ((1, 3), (1, 7), (1, 11), (164, 231)),
    ] {
        let mut p = problem(w);
        p.n = Rational::from(n);
        let found = growth_rate(&p, &Rational::from(q))
            .to_float()
            .to_rational()
            .unwrap();
        let due = Rational::from(due);
        assert!(found >= due && found < due * Rational::from((1_000_000_001, 1_000_000_000)));
    }
}

/// `|(wP, Q)|` of vectors with whole lengths.
#[test]
fn the_norm_is_euclid_s() {
    let z = |x: f64, y: f64| ComplexBall::new(Ball::exact(64, x), Ball::exact(64, y));
    for (p, q, due) in [
        (z(1.0, 0.0), z(0.0, 3.0), 5.0),
        (z(0.0, -1.0), z(3.0, 0.0), 5.0),
        (z(0.0, 0.0), z(3.0, -4.0), 5.0),
        (z(0.75, 1.0), z(0.0, 12.0), 13.0),
    ] {
        let found = norm(&problem((4, 1)), &(p, q)).to_f64();
        assert!((due..due * 1.000001).contains(&found), "{found} {due}");
    }
}

/// A constant force on an undamped oscillator: P is a sine, Q a cosine, and over 355/113 for π to
/// either side of an extreme the integrals all but vanish. What is left out outweighs the rounding
/// there.
#[test]
fn panels_hold_integrals_that_cancel() {
    let zero = Rational::new();
    for w in [(1, 1), (1, 4096), (4096, 1)] {
        let p = problem(w);
        let half = Rational::from((355, 113)) / &p.w;
        for prec in (8..120).step_by(5) {
            for (centre, part) in [(Rational::from(&half / 2), 0), (half.clone(), 1)] {
                let (a, b) = panel(&p, &zero, &zero, &centre, &half, prec);
                // ∫ sin ws/w ds = 2 sin wc sin wh/w², ∫ cos ws ds = 2 cos wc sin wh/w.
                let at = |x: &Rational| Ball::rational(300, &Rational::from(x * &p.w)).sin_cos();
                let (sine, cosine) = at(&centre);
                let per_w = Ball::rational(300, &p.w).recip();
                let twice = at(&half).0.shift(1) * &per_w;
                let due = [&twice * &sine * &per_w, &twice * &cosine];
                assert!(
                    a.re.contains_ball(&due[0]) && b.re.contains_ball(&due[1]),
                    "{w:?} {prec} {part}"
                );
                let size = Mag::power_of_two(1 - i64::from(prec)).mul(per_w.magnitude());
                assert!(
                    a.re.rad() <= size.mul(per_w.magnitude()) && b.re.rad() <= size,
                    "{w:?} {prec}: {a:?} {b:?}"
                );
            }
        }
    }
}
