//! Motions whose error is known in closed form: the bounds of a step hold it, and not much more.

use super::super::motor::{Characteristic, Motor};
use super::*;
use rug::Rational;

const BITS: u32 = 120;
/// The errors are first order in this.
const SMALL: f64 = 1e-9;

fn exact(x: f64) -> Ball {
    Ball::exact(BITS, x)
}

fn model(c: &[f64]) -> TaylorModel {
    TaylorModel::polynomial(c.iter().map(|x| Float::with_val(BITS, *x)).collect())
}

/// `M_d = n_0 + n_1 v`.
fn linear(n0: f64, n1: f64) -> Characteristic {
    let motor = Motor::Linear {
        standstill: Rational::from_f64(n0).unwrap(),
        slope: Rational::from_f64(-n1).unwrap(),
    };
    motor.at(BITS)
}

/// A step along which the candidate's speed is `chi` (times u from rest).
struct Case {
    rest: bool,
    chi: Vec<f64>,
    inverse: Vec<f64>,
    inertia: TaylorModel,
    slope: Vec<f64>,
    /// σ_1 M_o.
    moment: Vec<f64>,
    motor: Characteristic,
    s1: Ball,
    /// The distance of the speed at the start from the candidate's.
    start: f64,
}

impl Case {
    /// At rest relative to the equilibrium `v = 2`: no inertia's slope, no torque there, σ_1 = 1/2.
    fn equilibrium(n1: f64) -> Case {
        Case {
            rest: false,
            chi: vec![2.0],
            inverse: vec![0.5],
            inertia: model(&[1.0]),
            slope: vec![0.0],
            moment: vec![0.0],
            motor: linear(-2.0 * n1, n1),
            s1: exact(0.5),
            start: SMALL,
        }
    }

    fn bounds(self) -> Result<Bounds, Refusal> {
        let set = Setting {
            bits: BITS,
            order: 64,
            half_width: exact(1.0),
            rotor: exact(0.0),
            motor: self.motor,
            backward: false,
        };
        let start = exact(self.chi[0]).widened(Mag::from_f64(self.start));
        let proof = Proof {
            set: &set,
            rest: self.rest,
            chi: model(&self.chi),
            inertia: self.inertia,
            slope: model(&self.slope),
            moment: model(&self.moment),
            s1: &self.s1,
        };
        proof.bound((!self.rest).then_some(&start), &model(&self.inverse))
    }

    /// Checks that the errors of the speed at the end and anywhere are within the bounds, and that the bounds are at
    /// most `most` times as large.
    fn check(self, name: &str, end: f64, anywhere: f64, most: f64) -> Bounds {
        let last: f64 = self.chi.iter().sum();
        let found = self.bounds().unwrap_or_else(|why| panic!("{name}: {why}"));
        let near = |x: Mag, due: f64| (0.9999999..most).contains(&(x.to_f64() / due));
        assert!(
            near(found.speed.rad(), end),
            "{name}, end: {:?} {end}",
            found.speed.rad()
        );
        assert!(
            near(found.chi_error, anywhere),
            "{name}: {:?} {anywhere}",
            found.chi_error
        );
        assert!((found.speed.mid().to_f64() - last).abs() < 1e-15, "{name}");
        found
    }
}

/// `e' = a e + b`, or `a e + b u` from rest: the end, the most and the mean of e over the step.
#[test]
fn growth_is_that_of_the_differential_equation() {
    for rate in [-6.0f64, -1.0, -0.25, 0.0, 0.25, 2.0] {
        for (start, defect) in [(1.0, 0.0), (0.0, 1.0), (3.0, 2.0)] {
            // Of e^{as} over [0, 1], and of its integral.
            let (first, second) = match rate {
                0.0 => (1.0, 0.5),
                a => (a.exp_m1() / a, (a.exp_m1() - a) / (a * a)),
            };
            let end = start * rate.exp() + defect * first;
            let mean = start * first + defect * second;
            let bound = growth(false, rate, Mag::from_f64(start), Mag::from_f64(defect));
            for (found, due) in [
                (bound.end, end),
                (bound.most, end.max(start)),
                (bound.mean, mean),
            ] {
                let more = found.to_f64() / due;
                assert!(
                    (1.0 - 1e-12..8.0).contains(&more),
                    "{rate} {start} {defect}: {more}"
                );
            }
        }
        // |e|/u² at the end and at the start.
        let end = match rate {
            0.0 => 0.5,
            a => (a.exp_m1() - a) / (a * a),
        };
        let bound = growth(true, rate, Mag::ZERO, Mag::from_f64(1.0));
        for found in [bound.end, bound.most, bound.mean] {
            let more = found.to_f64() / end.max(0.5);
            assert!((1.0 - 1e-12..4.0).contains(&more), "{rate}: {more}");
        }
    }
}

/// About an equilibrium an error of the start grows or decays as e^{ā}; the equation has no other.
#[test]
fn start_errors_grow_as_the_motor_s_slope_tells() {
    // σ_1 n_1/(J v) = ±3.
    Case::equilibrium(12.0).check("unstable", SMALL * 3f64.exp(), SMALL * 3f64.exp(), 1.001);
    Case::equilibrium(-12.0).check("stable", SMALL * (-3f64).exp(), SMALL, 1.001);
    // σ_1 in 0.4 … 0.6.
    for (n1, s1) in [(12.0, 0.6), (-12.0, 0.4)] {
        let case = Case {
            s1: exact(0.5).widened(Mag::from_f64(0.1)),
            ..Case::equilibrium(n1)
        };
        let grown: f64 = n1 * s1 / 2.0;
        case.check(
            "uncertain length",
            SMALL * grown.exp(),
            SMALL * grown.exp().max(1.0),
            1.001,
        );
    }
    // A slope below one is positive all the same.
    let case = Case {
        s1: exact(0.5).widened(Mag::from_f64(0.1)),
        ..Case::equilibrium(0.9)
    };
    let end = SMALL * (0.9f64 * 0.6 / 2.0).exp();
    case.check("a small slope", end, end, 1.001);
    // J = 1 ∓ 0.4 u with its own slope: e = J v δ.
    for (n1, bent) in [(12.0, -0.4f64), (0.9, -0.4), (-12.0, 0.4)] {
        let case = Case {
            inertia: model(&[1.0, bent]),
            slope: vec![bent],
            // ½ G v²
            moment: vec![2.0 * bent],
            ..Case::equilibrium(n1)
        };
        let grown = n1 / 4.0 * (1.0 + bent).ln() / bent;
        let end = SMALL * grown.exp() / (1.0 + bent);
        case.check("an inertia that changes", end, end.max(SMALL), 12.0);
    }
    // v = 2 ∓ ½ u, held there by the load.
    for (n1, bent) in [(12.0, -0.5f64), (-12.0, 0.5)] {
        let case = Case {
            chi: vec![2.0, bent],
            inverse: vec![0.5, -bent / 4.0, bent * bent / 8.0],
            // J v v_u − σ_1 n_1 (v − 2)
            moment: vec![2.0 * bent, bent * bent - n1 * bent / 2.0],
            ..Case::equilibrium(n1)
        };
        let grown = 0.5 * n1 * (1.0 + bent / 2.0).ln() / bent;
        let end = SMALL * 2.0 * grown.exp() / (2.0 + bent);
        case.check("a speed that changes", end, end.max(SMALL), 8.0);
    }
}

/// Without a slope of J in the equation a free motion keeps its speed, and `e = ½ J (v² − p²)`
/// grows with J; where J is another than its polynomial, e grows though v obeys the slope.
#[test]
fn start_errors_grow_with_the_inertia() {
    let free = Case {
        inertia: model(&[1.0, 0.5]),
        ..Case::equilibrium(0.0)
    };
    free.check("J grows", SMALL, SMALL, 8.0);
    let other = Case {
        inertia: model(&[1.0, 0.2]).widened(Mag::from_f64(0.3)),
        slope: vec![0.2],
        moment: vec![0.4],
        ..Case::equilibrium(0.0)
    };
    // J = 1.3 + 0.2 u.
    other.check("J is greater", SMALL * 1.3 / 1.5, SMALL, 3.0);
    // J = 0.55 + 0.01 u: nothing but the growth of e is wider than it has to be.
    let other = Case {
        inertia: model(&[0.5, 0.01]).widened(Mag::from_f64(0.05)),
        slope: vec![0.01],
        moment: vec![0.02],
        ..Case::equilibrium(0.0)
    };
    other.check("J is little greater", SMALL * 0.55 / 0.56, SMALL, 1.1);
}

/// A torque that the candidate does not know is a defect, and adds to the speed what the equation
/// says.
#[test]
fn defects_add_up() {
    let free = |load: f64| Case {
        moment: vec![load],
        start: 0.0,
        ..Case::equilibrium(0.0)
    };
    // v δ = σ_1 M u/J.
    free(SMALL).check("a load", SMALL / 2.0, SMALL / 2.0, 1.001);
    free(-SMALL).check("a load", SMALL / 2.0, SMALL / 2.0, 1.001);
    let light = Case {
        inertia: model(&[1.0]).widened(Mag::from_f64(0.5)),
        ..free(SMALL)
    };
    light.check("J is half its polynomial", SMALL, SMALL, 1.001);
    for n1 in [12.0, -12.0, -1.0] {
        let case = Case {
            moment: vec![SMALL],
            start: 0.0,
            ..Case::equilibrium(n1)
        };
        let rate: f64 = n1 / 4.0;
        let end = SMALL / 2.0 * rate.exp_m1() / rate;
        case.check("a load and a slope", end, end, 3.5);
    }
    // Kloss: D = S² + S_k² at the slip 1/2 is 26 times its least.
    let kloss = Motor::Kloss {
        breakdown_torque: Rational::from(1),
        breakdown_slip: Rational::from((1, 10)),
        synchronous: Rational::from(4),
    };
    let motor = kloss.at(BITS);
    let torque = motor.torque(&exact(2.0));
    let case = Case {
        // The torque is balanced but for a small load.
        moment: vec![-torque.to_f64() / 2.0 + SMALL],
        motor,
        start: 0.0,
        ..Case::equilibrium(0.0)
    };
    let rate = case.motor.slope(&exact(2.0)).to_f64() / 4.0;
    let end = SMALL / 2.0 * rate.exp_m1() / rate;
    case.check("a quotient", end, end, 28.0);
    // p = 2 + u/4 without a torque: J p p_u is the defect, and a slope of J against it another.
    let case = Case {
        chi: vec![2.0, SMALL],
        ..free(0.0)
    };
    case.check("a candidate that rises", SMALL, SMALL, 1.001);
    let case = Case {
        slope: vec![SMALL],
        ..free(0.0)
    };
    case.check("a slope", SMALL, SMALL, 1.001);
}

/// From rest: `χ² = σ_1 T/J`, and with a slope of the motor the error of u χ grows.
#[test]
fn defects_from_rest() {
    let rest = |load: f64, n1: f64| Case {
        rest: true,
        chi: vec![2.0],
        inverse: vec![0.5],
        inertia: model(&[1.0]),
        slope: vec![0.0],
        // J χ² − σ_1 (n_0 + n_1 u χ)
        moment: vec![4.0 - 0.5 + load, -n1],
        motor: linear(1.0, n1),
        s1: exact(0.5),
        start: 0.0,
    };
    // e/u² = ½ b, and χ δ is as much.
    rest(SMALL, 0.0).check("a load", SMALL / 4.0, SMALL / 4.0, 1.001);
    let rate = 3.0f64;
    let end = SMALL / 2.0 * (rate.exp_m1() - rate) / (rate * rate);
    rest(SMALL, 12.0).check("a slope", end, end, 6.0);
    rest(SMALL, -12.0).check("a falling slope", SMALL / 4.0 * 0.5, SMALL / 4.0, 2.5);
    let bent = Case {
        slope: vec![SMALL],
        ..rest(0.0, 0.0)
    };
    // F/u = ½ G χ² u²/u, G = SMALL u: e = ∫ ½ SMALL u · 4 u² du.
    bent.check("a slope of J", SMALL / 4.0, SMALL / 4.0, 4.5);
}

/// From rest `G = u slope`, and an inertia that rises otherwise lets the error grow.
#[test]
fn slopes_from_rest() {
    // J = 1 + u/2, G = u/2.
    let case = Case {
        rest: true,
        chi: vec![2.0],
        inverse: vec![0.5],
        inertia: model(&[1.0, 0.5]),
        slope: vec![0.5],
        // J χ² + ½ u G χ² − σ_1 n_0 + load
        moment: vec![4.0 - 0.5 + SMALL, 2.0, 1.0],
        motor: linear(1.0, 0.0),
        s1: exact(0.5),
        start: 0.0,
    };
    // e' = (1 − u)/(2 + u) e + SMALL u
    let (steps, mut e) = (4000, 0.0f64);
    for k in 0..steps {
        let step = 1.0 / f64::from(steps);
        let u = (f64::from(k) + 0.5) * step;
        let rate = (1.0 - u) / (2.0 + u);
        e = (e + 0.5 * step * (rate * e) + step * u * SMALL) / (1.0 - 0.5 * step * rate);
    }
    // δ = e/(J χ)
    let end = e / (1.5 * 2.0);
    assert!(end > SMALL / 2.0 / 3.0 * 1.01, "{end}");
    case.check("a slope", end, end, 40.0);
}

/// `½ J |v² − p²|` at both ends of an uncertain speed, wide or narrow.
#[test]
fn start_errors_hold_both_ends() {
    for k in 0..400 {
        let part = 1.0 + f64::from(k) / 400.0;
        let inertia =
            Float::with_val(200, 1) + (Float::with_val(200, (-52f64).exp2()) - (-90f64).exp2());
        for rad in [0.25 * part, part * (-20f64).exp2(), part * (-100f64).exp2()] {
            let v = Ball::new(inertia.clone(), Mag::from_f64(rad));
            let found = start_error(&inertia, &v).to_float();
            for end in [-rad, rad] {
                let x = Float::with_val(200, end) + &inertia;
                let change = Float::with_val(200, x.square() - inertia.clone().square()).abs();
                let due = Float::with_val(200, &inertia * change) / 2u32;
                assert!(due <= found && found < due * 2.5f64, "{rad}");
            }
        }
    }
}

/// `e^x` from above, also where 64 bits of it end in zeros.
#[test]
fn exponentials_from_above() {
    for k in -20_000..=20_000 {
        let x = f64::from(k) / 1000.0;
        let due = Float::with_val(200, x).exp();
        let found = exp_above(x).to_float();
        assert!(due <= found && found <= due * (1.0 + 1e-15), "{x}");
    }
}

/// Time: `σ_1/v` integrated, with what the reciprocal's polynomial and the speed's error leave out.
#[test]
fn time_holds_what_the_speed_and_its_reciprocal_leave_out() {
    let one = exact(1.0);
    let radius = |case: Case| {
        let found = case.bounds().unwrap();
        // t_u = 1/4 at v = 2, and no speed in the tube is slower than that by more than 2^−16.
        let rate = found.time_rate.to_f64();
        assert!(
            rate <= 0.25 / (1.0 + 1.0 / 65536.0) && rate > 0.2499,
            "{rate}"
        );
        found.time.eval(&one).rad().to_f64()
    };
    let near = |x: f64, due: f64| (0.99999..1.001).contains(&(x / due));
    // σ_1 δ/v²
    let found = radius(Case::equilibrium(0.0));
    assert!(near(found, SMALL / 8.0), "{found}");
    let light = Case {
        inertia: model(&[0.5]),
        ..Case::equilibrium(0.0)
    };
    let found = radius(light);
    assert!(near(found, SMALL / 8.0), "{found}");
    // σ_1 up to 0.6.
    let long = Case {
        s1: exact(0.5).widened(Mag::from_f64(0.1)),
        ..Case::equilibrium(0.0)
    };
    let found = long.bounds().unwrap().time.eval(&one).rad().to_f64() - 0.05;
    assert!(
        (0.9999..1.01).contains(&(found / (0.6 * SMALL / 4.0))),
        "{found}"
    );
    // The mean of e^{−3u}.
    let found = radius(Case::equilibrium(-12.0));
    assert!(
        found >= SMALL / 8.0 * (1.0 - (-3f64).exp()) / 3.0 && found < SMALL / 8.0 * 0.334,
        "{found}"
    );
    // A reciprocal that is off by a part of 2^−20.
    let case = Case {
        inverse: vec![0.5 + 1.0 / f64::from(1 << 21)],
        start: 0.0,
        ..Case::equilibrium(0.0)
    };
    let found = radius(case);
    assert!(near(found, 0.25 / f64::from(1 << 20)), "{found}");
}

/// A motion that may stop, an inertia that may vanish, an error as wide as the tube.
#[test]
fn what_is_not_proved_is_refused() {
    let with = |chi: f64, inertia: TaylorModel, start: f64| {
        let case = Case {
            chi: vec![2.0, chi],
            inertia,
            start,
            ..Case::equilibrium(0.0)
        };
        case.bounds().err()
    };
    let one = model(&[1.0]);
    // J p p_u is a defect: even a slow fall is one.
    assert_eq!(with(0.0, one.clone(), SMALL), None);
    assert_eq!(
        with(-2.0, one.clone(), 0.0),
        Some("the speed may vanish within the step")
    );
    for inertia in [
        model(&[1.0, -1.0]),
        one.clone().widened(Mag::from_f64(1.0)),
        model(&[-1.0]),
    ] {
        assert_eq!(
            with(0.0, inertia, SMALL),
            Some("the speed may vanish within the step")
        );
    }
    let tube = 2.0 / 65536.0;
    assert_eq!(with(0.0, one.clone(), 0.99 * tube), None);
    for start in [1.01 * tube, 2.0 * tube, 0.1] {
        assert_eq!(
            with(0.0, one.clone(), start),
            Some("the error leaves its tube")
        );
    }
    // A motor that drives away from the equilibrium carries a smaller one out.
    let case = Case {
        start: 0.5 * tube,
        ..Case::equilibrium(12.0)
    };
    assert_eq!(case.bounds().err(), Some("the error leaves its tube"));
}

#[test]
fn quotients_below() {
    for (a, b) in [(1.0, 3.0), (-2.0, 7.0), (5.0, 2.0)] {
        let x = below_quotient(&exact(a), Mag::from_f64(b)).to_f64();
        let due = f64::abs(a) / b;
        assert!(x <= due && x > due * (1.0 - 1e-8), "{x} {due}");
    }
    let x = below_quotient(&exact(1.0).widened(Mag::from_f64(0.5)), Mag::from_f64(2.0));
    assert!(x.to_f64() <= 0.25 && x.to_f64() > 0.2499);
}

/// From rest a motor passes all speeds up to the tube's.
#[test]
fn speeds_from_rest_begin_at_zero() {
    let tube = exact(3.0).widened(Mag::from_f64(0.5));
    let ends = |x: Ball| (x.lower().to_f64(), x.upper().to_f64());
    let (low, high) = ends(speeds(&tube, true));
    assert!(low <= 0.0 && low > -1e-9 && (3.5..3.5 + 1e-9).contains(&high));
    let (low, high) = ends(speeds(&tube, false));
    assert!((2.5 - 1e-9..=2.5).contains(&low) && (3.5..3.5 + 1e-9).contains(&high));
}
