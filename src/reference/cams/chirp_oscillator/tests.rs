use super::*;
use crate::gauss_legendre::GaussLegendre;
use crate::{Ball, ComplexBall, Mag};
use proptest::prelude::*;
use rug::Rational;

fn problem(values: [f64; 9]) -> Problem {
    Problem::new(&values.map(|x| Rational::from_f64(x).unwrap())).unwrap()
}

fn overlap(a: &Response, b: &Response, what: &str) {
    for (x, y) in a.components().into_iter().zip(b.components()) {
        assert!(x.overlaps(y), "{what}: {} {}", x.mid(), y.mid());
    }
}

/// Next to critical damping.
const ABOVE: f64 = 10.0 * (1.0 + 1e-12);
const BELOW: f64 = 10.0 * (1.0 - 1e-12);

/// w, n, ε, Ω₀, k, δ, y₀, v₀, t
const CASES: &[[f64; 9]] = &[
    [10.0, 0.5, 4.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.5],
    [10.0, 0.5, -4.0, 30.0, 2.0, 0.3, 0.1, -2.0, 8.0],
    [10.0, 10.0, 4.0, 0.0, 2.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, ABOVE, 4.0, 0.0, 2.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, BELOW, 4.0, 0.0, 2.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 40.0, -4.0, 10.0, 1.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 0.0, 0.0, 10.0, 1.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 0.0, 0.0, -10.0, 1.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 0.0, 0.0, 3.0, 1.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 10.0, 0.0, 3.0, 1.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 0.1, 5.0, 3.0, 0.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 0.0, 1e-9, 10.0, 1.0, 0.3, 0.0, 0.0, 3.0],
    [10.0, 0.1, 100.0, -30.0, 1.0, 0.3, 0.0, 0.0, 2.0],
    [10.0, 0.1, 1.0, -3.0, 3.0, 0.3, 0.0, 0.0, 0.001],
    [10.0, 0.1, 1.0, -3.0, 3.0, 0.3, 0.5, 0.25, 0.0],
    [10.0, 0.1, 1.0, -3.0, 3.0, 0.3, 0.0, 0.0, 1.0],
];

#[test]
fn the_closed_form_and_the_panels_overlap() {
    for case in CASES {
        let p = problem(*case);
        let what = format!("{case:?}");
        let closed = enclose(&p, 160);
        let panels = taylor::enclose(&p, 160).unwrap();
        overlap(&closed, &panels, &what);
        for x in panels.components() {
            assert!(x.rad() < Mag::power_of_two(-120), "{what}: {:?}", x.rad());
        }
        // The accuracy promised of the closed form.
        let decided = response(&p, 100).unwrap();
        overlap(&decided, &panels, &what);
        for x in decided.components() {
            assert!(x.is_zero() || x.accuracy_bits() >= 100, "{what}");
        }
    }
}

#[test]
fn hundreds_of_digits() {
    let p = problem(CASES[1]);
    let (a, b) = (enclose(&p, 1200), taylor::enclose(&p, 1200).unwrap());
    overlap(&a, &b, "1200 bits");
    assert!(a.y.accuracy_bits() > 1150 && b.y.accuracy_bits() > 1150);
}

#[test]
fn too_many_panels_are_refused() {
    let p = problem([1.0, 0.1, 0.0, 1e9, 1.0, 0.0, 0.0, 0.0, 1e3]);
    assert!(taylor::enclose(&p, 100).is_err());
    assert!(response(&p, 100).is_ok());
}

#[test]
fn what_is_no_problem() {
    let at =
        |w: i32, n: i32, t: i32| Problem::new(&[w, n, 1, 1, 1, 0, 0, 0, t].map(Rational::from));
    assert_eq!(at(0, 1, 1).unwrap_err().name(), "not positive");
    assert_eq!(at(1, -1, 1).unwrap_err().name(), "negative");
    assert_eq!(
        at(1, 1, -1).unwrap_err().to_string(),
        "t must not be negative"
    );
}

/// Condition numbers against the closed solution of a constant force on an undamped oscillator,
/// `y = 1 − cos wt`: w and t have `wt sin wt` each, δ = 0.
#[test]
fn conditions_of_a_constant_force() {
    let p = problem([2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.7]);
    let c = conditions(&p).unwrap();
    let slope = 1.4 * 1.4f64.sin();
    assert!((c[0] / (2.0 * slope) - 1.0).abs() < 1e-9, "{c:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    /// Enclosures at low and at high precision contain the same number, by either way.
    #[test]
    fn containment(
        w in 0.5f64..8.0, zeta in 0.0f64..3.0, near in 0u32..3, eps in -4.0f64..4.0, omega0 in -6.0f64..6.0,
        k in -5i32..6, delta in -3.0f64..3.0, y0 in -1.0f64..1.0, t in 0.0f64..5.0, bits in 20u32..140,
    ) {
        let n = match near { 0 => w, 1 => w * (1.0 + 1e-9 * (zeta - 1.5)), _ => w * zeta };
        let p = problem([w, n, eps, omega0, f64::from(k), delta, y0, 0.5, t]);
        let high = enclose(&p, 400);
        let low = enclose(&p, bits);
        let panels = taylor::enclose(&p, bits.max(40)).unwrap();
        for ((a, b), c) in high.components().into_iter().zip(low.components()).zip(panels.components()) {
            prop_assert!(a.accuracy_bits() > 200 || a.magnitude() < Mag::power_of_two(-60));
            prop_assert!(a.overlaps(b) && a.overlaps(c), "{} {} {}", a.mid(), b.mid(), c.mid());
        }
    }
}

/// `A` by Gauss–Legendre panels: with N points and the integrand bounded by M within the Bernstein
/// ellipse ρ the error is at most `(64/15) M ρ^{−2(N−1)}/(1 − ρ^{−2})` (Trefethen, *Approximation
/// Theory and Approximation Practice*, Theorem 19.3) times the half-width. Within the ellipse `|s −
/// c| ≤ r = h (ρ + 1/ρ)/2`, and there `|K h| ≤ (|K| + |K′|/w) e^{(w + 2n + |q| + κr) r}` as for the
/// panels.
fn by_gauss_legendre(values: [f64; 9], prec: u32) -> ComplexBall {
    const POINTS: usize = 40;
    const RHO: f64 = 16.0;
    let p = problem(values);
    let [w, n, eps, omega0, k, _, _, _, t] = values;
    let rule = GaussLegendre::new(POINTS, prec).unwrap();
    let fastest = (k * omega0).abs().max((k * (omega0 + eps * t)).abs());
    let panels = ((w + 2.0 * n + fastest) * t / 2.0).ceil() as u32;
    let half = Rational::from(&p.t / (2 * panels));
    let omega = p.kappa() * &p.t + p.nu();
    let h = Ball::rational(prec, &half);
    let (omega, kappa) = (
        Ball::rational(prec, &omega),
        Ball::rational(prec, &p.kappa()),
    );
    let w3 = (-Ball::rational(prec, &p.square())).sqrt();
    let damping = Ball::rational(prec, &p.n);
    let mut sum = ComplexBall::zero(prec);
    for j in 0..panels {
        let centre = Ball::rational(prec, &Rational::from(&half * (2 * j + 1)));
        let integrand = |s: &Ball| {
            let decay = (-(&damping * s)).exp() / &w3;
            let sine = (&w3 * s).sin_cos().0;
            let angle = s * (&omega - &(&kappa * s).shift(-1));
            ComplexBall::unit(&angle).scaled(&(decay * sine))
        };
        for (x, weight) in &rule.nodes {
            sum = &sum + &integrand(&(&centre + &(&h * x))).scaled(&(weight * &h));
        }
        // K and K′/w are at most e^{−ns} (s + (1 + ns)/w) ≤ t + 2/w in modulus.
        let size = t + 2.0 / w;
        let r = h.to_f64() * (RHO + 1.0 / RHO) / 2.0 * (1.0 + 1e-12);
        let q = (&omega - &(&kappa * &centre)).magnitude().to_f64();
        let growth = (w + 2.0 * n + q + (k * eps).abs() * r) * r * (1.0 + 1e-12);
        let bound = Ball::exact(prec, growth).exp().magnitude();
        let mut error = bound
            .mul(Mag::from_f64(size * 64.0 / 15.0 * 1.01))
            .mul(h.magnitude());
        for _ in 0..2 * (POINTS - 1) {
            error = error.div(Mag::from_f64(RHO));
        }
        sum = sum.widened(error);
    }
    sum.scaled(&Ball::rational(prec, &Rational::from(p.w.square_ref())))
}

#[test]
fn gauss_legendre_bears_witness() {
    for case in [CASES[0], CASES[1], CASES[12], CASES[13]] {
        let witness = by_gauss_legendre(case, 200);
        let closed = enclose(&problem(case), 200).amplitude;
        assert!(witness.overlaps(&closed), "{case:?}");
        assert!(
            witness.radius() < Mag::power_of_two(-85),
            "{case:?}: {:?}",
            witness.radius()
        );
    }
}

/// Within the ball, whose radius is small.
fn holds(found: &Ball, due: &Ball, bits: i64) -> bool {
    let scale = Mag::from_f64(1.0).add(due.magnitude());
    found.overlaps(due) && found.rad() < scale.shift(-bits) && due.rad() < scale.shift(-bits)
}

/// Free vibration by its elementary solutions: damped below, above and at the critical value, at
/// times where series are summed and where they are not.
#[test]
fn free_vibration_has_its_elementary_solutions() {
    let r = |n: i32, d: i32| Rational::from((n, d));
    let ball = |x: &Rational| Ball::rational(200, x);
    let whole = |n: i64| Ball::integer(200, n);
    // w, n
    for (w, n) in [(5, 3), (4, 5), (2, 2)] {
        for (y0, v0) in [
            (r(1, 1), r(0, 1)),
            (r(0, 1), r(1, 1)),
            (r(2, 3), r(-5, 7)),
            (r(0, 1), r(0, 1)),
        ] {
            for t in [r(0, 1), r(1, 1000), r(1, 8), r(1, 4), r(1, 1), r(7, 2)] {
                let p = Problem {
                    w: r(w, 1),
                    n: r(n, 1),
                    eps: r(1, 1),
                    omega0: r(1, 1),
                    k: r(1, 1),
                    delta: r(0, 1),
                    y0: y0.clone(),
                    v0: v0.clone(),
                    t: t.clone(),
                };
                let (y, v, time) = (ball(&y0), ball(&v0), ball(&t));
                let decay = |rate: i64| (-(whole(rate) * &time)).exp();
                let due = match (w, n) {
                    // e^{−3t} (a cos 4t + b sin 4t), differentiated twice.
                    (5, 3) => {
                        let (sine, cosine) = (whole(4) * &time).sin_cos();
                        let (mut a, mut b) = (y.clone(), (v + whole(3) * &y).shift(-2));
                        [(); 3].map(|()| {
                            let value = decay(3) * (&a * &cosine + &b * &sine);
                            let next = b.shift(2) - whole(3) * &a;
                            b = -(a.shift(2) + whole(3) * &b);
                            a = next;
                            value
                        })
                    }
                    // c e^{−2t} + d e^{−8t}
                    (4, 5) => {
                        let c = (y.shift(3) + &v) / whole(6) * decay(2);
                        let d = -(y.shift(1) + &v) / whole(6) * decay(8);
                        [&c + &d, -(c.shift(1) + d.shift(3)), c.shift(2) + d.shift(6)]
                    }
                    // e^{−2t} (y₀ + ct)
                    _ => {
                        let c = v + y.shift(1);
                        let y = y + &c * &time;
                        let v = &c - y.shift(1);
                        let a = -(&c + &v).shift(1);
                        [y, v, a].map(|x| x * decay(2))
                    }
                };
                let found = super::free::vibration(&p, 160);
                for (k, (found, due)) in found.iter().zip(&due).enumerate() {
                    assert!(
                        holds(found, due, 130),
                        "{w} {n} {y0} {v0} {t} {k}: {found:?} {due:?}"
                    );
                }
            }
        }
    }
}

/// `sin wt/w` and `cos wt` with few bits of numbers that all are exact: what the series leave out
/// is most of the radius.
#[test]
fn what_the_series_of_free_vibration_leave_out() {
    let p = problem([4.0, 0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 0.0, 0.125]);
    let (sin, cos) = Ball::exact(200, 0.5).with_prec(200).sin_cos();
    for prec in [12, 20, 30, 40] {
        let (k, rate) = super::free::impulse(&p, &p.t, prec);
        assert!(k.contains_ball(&sin.shift(-2)) && rate.contains_ball(&cos));
        let most = Mag::power_of_two(-i64::from(prec) - 4);
        assert!(
            k.rad() <= most && rate.rad() <= most,
            "{prec} {k:?} {rate:?}"
        );
    }
}

/// Undamped and at constant speed, from rest:
/// `y = w²/(w² − ν²) (cos(νt + δ) − cos δ cos wt + (ν/w) sin δ sin wt)`.
#[test]
fn the_phase_leads_the_harmonic() {
    for (nu, delta, t) in [(1.0, 0.75, 1.5), (-1.0, 0.75, 1.5), (5.0, -2.0, 0.25)] {
        // w = 2
        let p = problem([2.0, 0.0, 0.0, nu, 1.0, delta, 0.0, 0.0, t]);
        let ball = |x: f64| Ball::exact(200, x).with_prec(200);
        let (sin, cos) = ball(2.0 * t).sin_cos();
        let (sin_delta, cos_delta) = ball(delta).sin_cos();
        let (sin_now, cos_now) = ball(nu * t + delta).sin_cos();
        let gain = ball(4.0) / ball(4.0 - nu * nu);
        let y = &gain * (&cos_now - &cos_delta * &cos + (&sin_delta * &sin * ball(nu)).shift(-1));
        let v = &gain
            * (-(&sin_now * ball(nu))
                + (&cos_delta * &sin).shift(1)
                + &sin_delta * &cos * ball(nu));
        let a = (&cos_now - &y).shift(2);
        let found = enclose(&p, 160);
        for (found, due) in [&found.y, &found.v, &found.a].into_iter().zip([y, v, a]) {
            assert!(holds(found, &due, 130), "{nu} {delta}: {found:?} {due:?}");
        }
    }
}

/// A constant force on an oscillator that already is where the force holds it: it stays there, `y′
/// = 0`, which no number of bits shows. As many as the documentation says are tried.
#[test]
fn a_component_that_is_zero_is_undecided() {
    let p = problem([3.0, 0.5, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 2.0]);
    for bits in [40, 100] {
        let undecided = response(&p, bits).unwrap_err();
        assert_eq!(undecided.bits, 4 * bits + 16384);
    }
}

/// In the first moments y is about `w²t²/2`, and Im A smaller still: all components have the digits
/// asked for.
#[test]
fn all_components_have_the_digits_asked_for() {
    let p = problem([3.0, 0.5, 1.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1e-12]);
    let found = response(&p, 100).unwrap();
    for x in found.components() {
        assert!(x.accuracy_bits() >= 100, "{x:?}");
    }
    assert!((found.y.mid().to_f64() / 4.5e-24 - 1.0).abs() < 1e-11);
}

/// The integrand of (1) is real under a constant force, and so are `A` and `ψ′` where the phase is
/// zero.
#[test]
fn a_constant_force_has_real_parts() {
    let p = problem([3.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0]);
    let parts = super::closed_form::parts(&p, 100);
    assert!(parts.amplitude.im.is_zero());
    assert!(parts.forced.iter().all(|z| z.im.is_zero()));
}

/// With few bits a force next to the resonance, or a damping next to none, looks like undamped
/// resonance. After 160 periods it makes a difference of many last bits.
#[test]
fn next_to_undamped_resonance() {
    let tiny = |k: i32| 2f64.powi(-k);
    for (n, nu) in [
        (0.0, 1.0 + tiny(25)),
        (0.0, -1.0 - tiny(25)),
        (tiny(27), 1.0),
        (tiny(27), -1.0),
    ] {
        let p = problem([1.0, n, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 1000.0]);
        overlap(&enclose(&p, 24), &enclose(&p, 300), &format!("{n} {nu}"));
    }
    // At resonance A = (−iwt + …)/2 itself: w = ν = 1, y = (t sin t)/2.
    let p = problem([1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1000.0]);
    let due = Ball::integer(200, 500) * Ball::integer(200, 1000).sin_cos().0;
    assert!(holds(&enclose(&p, 160).y, &due, 130));
}
