use super::*;
use crate::cubic_spline::End;
use approx::assert_relative_eq;
use std::f64::consts::{PI, TAU};

pub(crate) fn all() -> Vec<MotionLaw> {
    let mut laws: Vec<MotionLaw> = NAMES
        .iter()
        .map(|n| MotionLaw::by_name(n).unwrap())
        .collect();
    laws.push(MotionLaw::scca(0.2, 0.3, 0.5).unwrap());
    laws.push(MotionLaw::scca(0.7, 0.2, 0.1).unwrap());
    laws.push(MotionLaw::scca(1.0, 0.0, 0.0).unwrap());
    for fraction in [0.3, 0.8] {
        for name in ["0050", "К", "modified-sine", "3-4-5", "4-5-6-7"] {
            let law = MotionLaw::by_name(name).unwrap();
            laws.push(law.with_acceleration_fraction(fraction).unwrap());
        }
    }
    laws.push(MotionLaw::polynomial(&[0.0, 0.0, 0.0, 10.0, -15.0, 6.0]).unwrap());
    laws.push(MotionLaw::polynomial(&[0.0, 0.0, 3.0, -2.0]).unwrap());
    let x: Vec<f64> = (0..=20).map(|i| f64::from(i) / 20.0).collect();
    let y = x.iter().map(|x| x - (2.0 * PI * x).sin() / (2.0 * PI));
    let mut y: Vec<f64> = y.collect();
    (y[0], y[20]) = (0.0, 1.0);
    laws.push(MotionLaw::tabulated(x, y, [End::FirstDerivative(0.0); 2]).unwrap());
    laws
}

#[test]
fn each_is_the_derivative_of_the_one_before() {
    let h = 1e-6;
    for law in all() {
        for k in 1..200 {
            let x = f64::from(k) / 200.0 + 1e-4 * 3f64.sqrt();
            let [m, at, p] = [x - h, x, x + h].map(|x| law.motion(x).unwrap());
            let d = |f: fn(&Motion) -> f64| (f(&p) - f(&m)) / (2.0 * h);
            let close = |a: f64, b: f64| (a - b).abs() < 1e-6 * (1.0 + a.abs() + b.abs());
            assert!(close(d(|m| m.displacement), at.velocity), "{law:?} {x}");
            // Off the joints, at which the jerk jumps.
            if (p.jerk - m.jerk).abs() < 0.01 * (1.0 + at.jerk.abs()) {
                assert!(close(d(|m| m.velocity), at.acceleration), "{law:?} {x}");
                let tolerance = 1e-3 * (1.0 + at.jerk.abs());
                assert!(
                    (d(|m| m.acceleration) - at.jerk).abs() < tolerance,
                    "{law:?} {x}"
                );
            }
            assert!((at.displacement + law.remaining(x).unwrap() - 1.0).abs() < 1e-15);
        }
        let ends = [0.0, 1.0].map(|x| law.motion(x).unwrap().displacement);
        assert_eq!(ends, [0.0, 1.0], "{law:?}");
        assert_eq!(law.remaining(1.0).unwrap(), 0.0, "{law:?}");
    }
}

#[test]
fn peaks_are_reached_and_not_exceeded() {
    for law in all() {
        let p = law.peaks();
        let mut found = [0.0f64; 4];
        let places = (0..=20_000).map(|k| f64::from(k) / 20_000.0);
        for x in places {
            let m = law.motion(x).unwrap();
            let values = [
                m.velocity.abs(),
                m.acceleration,
                -m.acceleration,
                m.jerk.abs(),
            ];
            for (f, v) in found.iter_mut().zip(values) {
                *f = f.max(v);
            }
        }
        let peaks = [p.velocity, p.acceleration, p.deceleration, p.jerk];
        for (peak, found) in peaks.into_iter().zip(found) {
            assert!(found <= peak * (1.0 + 1e-14), "{law:?} {found} {peak}");
            assert!(
                found >= peak * 0.999 || peak.is_infinite(),
                "{law:?} {found} {peak}"
            );
        }
    }
}

#[test]
fn constants_of_the_known_laws() {
    let table = [
        ("0050", 2.0, 4.0, f64::INFINITY),
        ("K", PI / 2.0, 4.934_802_200_544_679, f64::INFINITY),
        (
            "modified-trapezoid",
            2.0,
            4.888_123_762_813_258,
            61.425_974_812_367_32,
        ),
        (
            "modified-sine",
            1.759_603_385_953_770_5,
            5.527_957_070_544_091,
            69.466_357_288_724_28,
        ),
        ("cycloidal", 2.0, 2.0 * PI, 39.478_417_604_357_43),
        ("3-4-5", 1.875, 5.773_502_691_896_258, 60.0),
        ("4-5-6-7", 2.1875, 7.513_188_404_399_293, 52.5),
    ];
    for (name, cv, ca, cj) in table {
        let p = MotionLaw::by_name(name).unwrap().peaks();
        assert_relative_eq!(p.velocity, cv, max_relative = 1e-15);
        assert_relative_eq!(p.acceleration, ca, max_relative = 1e-15);
        assert_relative_eq!(p.jerk, cj, max_relative = 1e-15);
    }
}

#[test]
fn digits_near_the_ends() {
    // s ~ C x^k: the ratio to the leading term, whose correction is known.
    let x = 2f64.powi(-30);
    let ratio = |law: &MotionLaw, k: i32| law.motion(x).unwrap().displacement / x.powi(k);
    let b = MotionLaw::cycloidal();
    assert_relative_eq!(ratio(&b, 3), 4.0 * PI * PI / 6.0, max_relative = 1e-15);
    let p = MotionLaw::polynomial(&[0.0, 0.0, 0.0, 10.0, -15.0, 6.0]).unwrap();
    assert_relative_eq!(ratio(&p, 3), 10.0 - 15.0 * x, max_relative = 1e-15);
    assert_eq!(p.remaining(1.0 - x), Ok(p.motion(x).unwrap().displacement));
    let q = MotionLaw::polynomial_4567();
    assert_relative_eq!(ratio(&q, 4), 35.0 - 84.0 * x, max_relative = 1e-15);
    assert_eq!(q.remaining(1.0 - x), Ok(q.motion(x).unwrap().displacement));
}

/// Beside the middle of the stroke the acceleration vanishes as `C_a π(1/2 − x)/d`.
#[test]
fn digits_near_the_middle() {
    let law = MotionLaw::scca(0.25, 0.25, 0.5).unwrap();
    let ca = law.peaks().acceleration;
    for k in [10, 20, 30, 40] {
        let off = 2f64.powi(-k);
        let due = ca * (PI * off / 0.5).sin();
        let ratio = |x: f64| law.motion(x).unwrap().acceleration / due;
        assert_relative_eq!(ratio(0.5 - off), 1.0, max_relative = 1e-14);
        assert_relative_eq!(ratio(0.5 + off), -1.0, max_relative = 1e-14);
    }
}

/// Checks what remains of a stroke that is nearly over before its middle: `(1 − x)(1 − 2x)`.
#[test]
fn digits_of_what_remains() {
    let law = MotionLaw::polynomial(&[0.0, 3.0, -2.0]).unwrap();
    for x in [0.49, 0.4999, 0.499_999_9] {
        let due = (1.0 - x) * (1.0 - 2.0 * x);
        let ratio = law.remaining(x).unwrap() / due;
        assert_relative_eq!(ratio, 1.0, max_relative = 1e-15);
    }
    // x²(3 − 2x) by a table: a cubic through its own values.
    let x = vec![0.0, 0.25, 0.5, 1.0];
    let y: Vec<f64> = x.iter().map(|x| x * x * (3.0 - 2.0 * x)).collect();
    let ends = [End::FirstDerivative(0.0); 2];
    let law = MotionLaw::tabulated(x, y, ends).unwrap();
    for k in [4, 10, 20, 30] {
        let z = 2f64.powi(-k);
        let due = z * z * (3.0 - 2.0 * z);
        let ratio = law.remaining(1.0 - z).unwrap() / due;
        // A rounding of the slope at the end, which is zero.
        let allowed = 1e-14 + f64::EPSILON / z;
        assert!((ratio - 1.0).abs() <= allowed, "{k}: {ratio}");
    }
}

/// Whole turns are taken away; a phase begins where the one before ends.
#[test]
fn seams_of_a_cycle() {
    let quarter = || Stroke {
        law: MotionLaw::cycloidal(),
        turns: 0.25,
    };
    let cycle = CamCycle::new(1.0, quarter(), 0.25, quarter(), 0.25).unwrap();
    for (turns, start) in [(2.25, 0.25), (-1.25, -0.25), (0.5, 0.5), (3.0, 0.0)] {
        let cycle = cycle.clone().starting_at(turns).unwrap();
        assert_eq!(cycle.start(), start);
        use Phase::{HighDwell, LowDwell, Return, Rise};
        for (after, phase) in [
            (0.0, Rise),
            (0.25 - 2f64.powi(-40), Rise),
            (0.25, HighDwell),
            (0.5, Return),
            (0.75, LowDwell),
            (1.0, Rise),
        ] {
            assert_eq!(cycle.phase(start + after), phase, "{turns} {after}");
        }
    }
}

fn stroke(degrees: f64) -> Stroke {
    Stroke {
        law: MotionLaw::modified_trapezoid(),
        turns: degrees / 360.0,
    }
}

#[test]
fn cycles() {
    let turn = |deg: f64| deg / 360.0;
    let cycle = CamCycle::new(3.0, stroke(120.0), turn(60.0), stroke(90.0), turn(90.0)).unwrap();
    let cycle = cycle.starting_at(turn(30.0)).unwrap();
    let at = |deg: f64| cycle.at(turn(deg)).unwrap();
    assert_eq!(at(0.0).displacement, 0.0);
    assert_relative_eq!(at(90.0).displacement, 1.5, max_relative = 1e-14);
    assert_relative_eq!(
        at(90.0).velocity,
        3.0 * 2.0 / (2.0 * PI / 3.0),
        max_relative = 1e-14
    );
    assert_eq!(
        at(180.0),
        Motion {
            displacement: 3.0,
            ..Motion::default()
        }
    );
    assert_relative_eq!(
        at(255.0).velocity,
        -3.0 * 2.0 / (PI / 2.0),
        max_relative = 1e-14
    );
    assert_eq!(at(-15.0).displacement, 0.0);
    let phases = [0.0, 31.0, 151.0, 211.0, 301.0].map(|d| cycle.phase(turn(d)));
    let expected = [
        Phase::LowDwell,
        Phase::Rise,
        Phase::HighDwell,
        Phase::Return,
        Phase::LowDwell,
    ];
    assert_eq!(phases, expected);
    let indexing = CamCycle::rise_dwell(1.0, stroke(90.0), 0.75).unwrap();
    assert_eq!(indexing.at(0.9).unwrap().displacement, 1.0);
    assert!(CamCycle::rise_return(1.0, stroke(180.0), stroke(180.0)).is_ok());
}

#[test]
fn refusals() {
    let says = |e: Result<MotionLaw, CamLawError>, part: &str| {
        let text = e.unwrap_err().to_string();
        assert!(text.contains(part), "{text}");
    };
    says(MotionLaw::scca(0.5, 0.5, 0.5), "b + c + d = 1.5");
    says(
        MotionLaw::scca(0.333, 0.333, 0.333),
        "b + c + d = 0.999, but",
    );
    says(
        MotionLaw::scca(0.333, 0.333, 0.333),
        "add up to 1 but for their rounding",
    );
    says(
        MotionLaw::scca(0.25, 0.5, 0.25 + 1e-14),
        "b + c + d = 1.00000000000001, but",
    );
    says(
        MotionLaw::scca(-0.5, 1.0, 0.5),
        "b = -0.5 must not be negative",
    );
    says(MotionLaw::scca(f64::NAN, 1.0, 0.5), "b = NaN is not finite");
    says(MotionLaw::by_name("cyclic"), "unknown law \"cyclic\"");
    says(MotionLaw::by_name("C0"), "defined nowhere");
    says(MotionLaw::by_name("0000"), "defined nowhere");
    says(MotionLaw::polynomial(&[0.1, 0.9]), "starts at 0.1");
    says(MotionLaw::polynomial(&[0.0, 0.9]), "add up to 0.9");
    says(MotionLaw::polynomial(&[0.0]), "degree 0");
    let line = || MotionLaw::polynomial(&[0.0, 1.0]).unwrap();
    says(line().with_acceleration_fraction(0.4), "halves");
    let k = MotionLaw::simple_harmonic;
    says(k().with_acceleration_fraction(1.0), "fraction 1 must lie");
    let free = [End::NotAKnot; 2];
    says(
        MotionLaw::tabulated(vec![0.0, 2.0], vec![0.0, 1.0], free),
        "to (2, 1)",
    );
    says(
        MotionLaw::tabulated(vec![0.0, 0.0], vec![0.0, 1.0], free),
        "no spline",
    );
    assert!(k().motion(1.5).is_err() && k().motion(f64::NAN).is_err());

    let cycle = |e: Result<CamCycle, CamLawError>, part: &str| {
        let text = e.unwrap_err().to_string();
        assert!(text.contains(part), "{text}");
    };
    let new = |a, b, c, d| CamCycle::new(1.0, stroke(a), b, stroke(c), d);
    cycle(new(120.0, 0.1, 90.0, 0.1), "one turn");
    cycle(
        new(0.0, 0.5, 90.0, 0.25),
        "rise of 0 turns must be positive",
    );
    cycle(
        new(120.0, -0.5, 90.0, 0.25),
        "high dwell of -0.5 turns must not be negative",
    );
    cycle(
        CamCycle::rise_return(0.0, stroke(180.0), stroke(180.0)),
        "lift",
    );
    cycle(
        CamCycle::rise_dwell(f64::NAN, stroke(180.0), 0.5),
        "lift = NaN",
    );
}

/// Beside the middle of a stroke with a short half before it; certified to 20 digits.
#[test]
fn beside_a_middle_that_comes_early() {
    let law = MotionLaw::polynomial_4567();
    let law = law
        .with_acceleration_fraction(0.125_151_795_815_745_93)
        .unwrap();
    let m = law.motion(0.147_651_720_746_098_03).unwrap();
    let near = |got: f64, due: f64, ulps: f64| {
        let off = (got - due).abs() / (due.abs().next_up() - due.abs());
        assert!(off <= ulps, "{got} {due}: {off} ulps");
    };
    near(m.velocity, 2.183_162_107_855_129_6, 2.0);
    near(m.acceleration, -0.385_336_593_684_384_08, 5.0);
    near(m.jerk, -17.080_785_699_970_844, 3.0);
}

/// Beside the ends of a table with zero slopes; certified to 20 digits.
#[test]
fn beside_the_ends_of_a_table() {
    let x = vec![0.0, 0.247_884_233_553_147_54, 0.699_372_558_184_867_3, 1.0];
    let y = vec![0.0, 0.287_555_283_674_423_07, 0.513_447_214_173_901_2, 1.0];
    let law = MotionLaw::tabulated(x, y, [End::FirstDerivative(0.0); 2]).unwrap();
    let near = |got: f64, due: f64| assert!((got / due - 1.0).abs() < 4e-16, "{got} {due}");
    let start = law.motion(0.000_964_517_228_756_345_3).unwrap();
    near(start.displacement, 8.849_295_714_946_18e-6);
    near(
        law.remaining(0.999_511_728_7).unwrap(),
        2.631_807_992_088_733e-6,
    );
}

/// Where the longer half of the stroke begins, the displacement (or what remains of it) is a sum
/// from where the halves meet: `s` of a law with the share λ at `λ + 2(1 − λ) r` is λ more than
/// that of the symmetric law at `1/2 + r` less a half, times `2(1 − λ)`.
#[test]
fn beside_where_a_short_half_meets_a_long_one() {
    let laws = [
        MotionLaw::constant_acceleration(),
        MotionLaw::simple_harmonic(),
        MotionLaw::modified_trapezoid(),
        MotionLaw::cycloidal(),
        MotionLaw::scca(0.25, 0.0, 0.75).unwrap(),
        MotionLaw::scca(0.5, 0.5, 0.0).unwrap(),
        MotionLaw::polynomial_345(),
        MotionLaw::polynomial_4567(),
    ];
    for law in laws {
        let late = law.clone().with_acceleration_fraction(0.0625).unwrap();
        let early = law.clone().with_acceleration_fraction(0.9375).unwrap();
        for k in 0..120 {
            // Exact: r, 2 (1 − λ) r and the places.
            let r = f64::from(k) / 256.0;
            let from_middle = 0.5 - law.motion(0.5 - r).unwrap().displacement;
            let due = 0.0625 + 1.875 * from_middle;
            if due > 0.5 {
                continue;
            }
            let got = late.motion(0.0625 + 1.875 * r).unwrap().displacement;
            // The due value has lost what is meant to be kept here.
            assert!((got - due).abs() < 8e-16, "{law:?} {r}: {got} {due}");
            let mirrored = early.remaining(0.9375 - 1.875 * r).unwrap();
            assert!(
                (got - mirrored).abs() <= 2e-16 * due,
                "{r}: {got} {mirrored}"
            );
        }
        let at = |x: f64| late.motion(x).unwrap().displacement;
        assert_eq!(at(0.0625), 0.0625);
        // Over 2⁻³⁰ of the stroke the velocity is that of the middle.
        let step = 2f64.powi(-30);
        let gone = (at(0.0625 + step) - 0.0625) / step;
        assert!(
            (gone - law.motion(0.5).unwrap().velocity).abs() < 3e-8,
            "{gone}"
        );
    }
}

/// Certified to 20 digits.
#[test]
fn displacements_after_a_middle_that_comes_early() {
    let near = |got: f64, due: f64| assert!((got / due - 1.0).abs() < 5e-16, "{got} {due}");
    let law = MotionLaw::scca(1.0, 0.0, 0.0).unwrap();
    let law = law
        .with_acceleration_fraction(0.090_675_256_897_089_98)
        .unwrap();
    let m = law.motion(0.090_701_484_745_050_91).unwrap();
    near(m.displacement, 0.090_747_432_683_818_09);
    let law = MotionLaw::simple_harmonic();
    let law = law.with_acceleration_fraction(0.25).unwrap();
    // 1 − s = (1 − λ)(1 − cos(π(1 − x)/(2 − 2λ))) at x = 1/2: a third of a turn's half.
    near(law.motion(0.5).unwrap().displacement, 1.0 - 0.75 * 0.5);
}

fn table(ends: [End; 2]) -> MotionLaw {
    let x = vec![0.0, 0.2, 0.35, 0.6, 0.85, 1.0];
    let y = vec![0.0, 0.05, 0.4, 0.55, 1.05, 1.0];
    MotionLaw::tabulated(x, y, ends).expect("a law")
}

#[test]
fn peaks_of_tables() {
    use End::{FirstDerivative as First, NotAKnot, SecondDerivative as Second};
    // The derivative that jumps at the ends: the velocity, or the acceleration alone.
    for (ends, velocity, acceleration) in [
        ([First(0.0); 2], false, true),
        ([NotAKnot; 2], true, true),
        ([First(0.0), NotAKnot], true, true),
        ([NotAKnot, First(0.0)], true, true),
        ([Second(0.0), First(0.0)], true, true),
        ([First(0.0), First(-0.5)], true, true),
        ([First(0.4), First(0.0)], true, true),
    ] {
        let law = table(ends);
        let n = 40_000;
        let at = |i: u32| law.motion(f64::from(i) / f64::from(n)).expect("a place");
        let all: Vec<Motion> = (0..=n).map(at).collect();
        let most = |f: fn(&Motion) -> f64| all.iter().map(f).fold(0.0, f64::max);
        let p = law.peaks();
        let near = |got: f64, due: f64| (got / due - 1.0).abs() < 1e-6;
        assert!(
            near(p.velocity, most(|m| m.velocity.abs())),
            "{ends:?} {p:?}"
        );
        assert!(near(p.deceleration, most(|m| -m.acceleration)), "{ends:?}");
        match velocity {
            true => assert_eq!(p.acceleration, f64::INFINITY, "{ends:?}"),
            false => assert!(near(p.acceleration, most(|m| m.acceleration)), "{ends:?}"),
        }
        match acceleration {
            true => assert_eq!(p.jerk, f64::INFINITY, "{ends:?}"),
            false => assert!(near(p.jerk, most(|m| m.jerk.abs())), "{ends:?}"),
        }
    }
    // Neither jumps.
    let x: Vec<f64> = (0..=8).map(|k| f64::from(k) / 8.0).collect();
    let y = x.iter().map(|x| x - (TAU * x).sin() / TAU).collect();
    let law = MotionLaw::tabulated(x.clone(), y, [Second(0.0), Second(0.0)]).expect("a law");
    let v = law.motion(0.0).expect("a place").velocity;
    assert!(v.abs() > 0.0 && law.peaks().acceleration == f64::INFINITY);
    // A spline from data with zero slope and curvature: an odd one about the middle.
    let one_end = table([Second(0.0), First(0.0)]);
    assert_eq!(one_end.motion(0.0).expect("a place").acceleration, 0.0);
    assert_eq!(one_end.motion(1.0).expect("a place").velocity, 0.0);
}

/// Derivatives of a cycle in radians of the shaft, by differences.
#[test]
fn motions_of_a_cycle() {
    let stroke = |law: MotionLaw, turns| Stroke { law, turns };
    let (rise, fall) = (
        stroke(MotionLaw::polynomial_4567(), 0.3),
        stroke(MotionLaw::cycloidal(), 0.25),
    );
    let cycle = CamCycle::new(0.7, rise.clone(), 0.2, fall, 0.25)
        .and_then(|c| c.starting_at(2.1))
        .expect("a cycle");
    let indexing = CamCycle::rise_dwell(0.7, rise, 0.7).expect("a cycle");
    for cycle in [cycle, indexing] {
        for k in 0..170 {
            let at = |x: f64| cycle.at(x).expect("an angle");
            let (x, h) = (f64::from(k) / 170.0 + 1e-3, 1e-6);
            let (a, m, b) = (at(x - h), at(x), at(x + h));
            let per = 2.0 * h * TAU;
            let close = |got: f64, due: f64, size: f64| {
                assert!((got - due).abs() < 1e-6 * size, "{x}: {got} {due}");
            };
            close(m.velocity, (b.displacement - a.displacement) / per, 3.0);
            close(m.acceleration, (b.velocity - a.velocity) / per, 30.0);
            close(m.jerk, (b.acceleration - a.acceleration) / per, 600.0);
            // Whole turns on, the same.
            close(at(x + 1.0).displacement, m.displacement, 1e-6);
            close(at(x - 3.0).velocity, m.velocity, 1e-6);
        }
    }
}

#[test]
fn shares_of_the_stroke() {
    let law = MotionLaw::cycloidal;
    let least = 1e-3f64;
    let (below, above) = (least.next_down(), (1.0 - least).next_up());
    for bad in [0.0, 5e-324, below, above, 1.0, -0.1, 1.1, f64::NAN] {
        assert!(law().with_acceleration_fraction(bad).is_err(), "{bad}");
    }
    for good in [least, 1.0 - least] {
        let m = law()
            .with_acceleration_fraction(good)
            .expect("a law")
            .motion(good);
        assert!((m.expect("a place").velocity - 2.0).abs() < 1e-14, "{good}");
    }
    // Symmetric halves stretched to 2λ and 2 − 2λ.
    for share in [0.2, 0.5, 0.7] {
        let (a, p) = (
            law().peaks(),
            law().with_acceleration_fraction(share).expect("a law"),
        );
        assert_eq!(p.acceleration_fraction(), share);
        let (p, up, down) = (p.peaks(), 2.0 * share, 2.0 - 2.0 * share);
        let close = |got: f64, due: f64| assert!((got / due - 1.0).abs() < 1e-14);
        close(p.velocity, a.velocity);
        close(p.acceleration, a.acceleration / up);
        close(p.deceleration, a.deceleration / down);
        close(p.jerk, a.jerk / up.min(down).powi(2));
    }
}
