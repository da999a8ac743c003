//! Motors, drives, models and the run-up.

use super::linkages::side;
use super::{any_f64, cases, numbers, said};
use mechaudit::solvers::dyad::{FourBar, SliderCrank};
use mechaudit::solvers::reduction::{Body, MomentOfInertia};
use mechaudit::solvers::run_up::{
    ConstantInertia, Drive, Equation, FourBarModel, Kloss, Motor, ReducedModel, Resistance,
    SliderCrankModel, Splined, TableReading, TorqueTable, inertia_range,
};
use mechaudit::solvers::units::{
    Acceleration, Angle, AngularVelocity, Inertia, Length, Mass, Torque,
};
use proptest::prelude::*;

fn motor() -> impl Strategy<Value = Option<Motor>> {
    let (speed, torque) = (AngularVelocity::from_rad_per_s, Torque::from_n_m);
    prop_oneof![
        any_f64().prop_map(move |m| said(Motor::constant(torque(m)))),
        numbers::<2>().prop_map(move |[m, w]| said(Motor::linear(torque(m), speed(w)))),
        numbers::<4>().prop_map(move |[w, m, k, s]| {
            said(Kloss::rated(speed(w), torque(m), k, s)).map(Motor::Kloss)
        }),
        (1.0f64..20.0, 1.0f64..300.0, 1.1f64..3.0, 0.01f64..0.2).prop_map(move |(w, m, k, s)| {
            said(Kloss::rated(speed(w), torque(m), k, s)).map(Motor::Kloss)
        }),
        numbers::<3>().prop_map(move |[w, m, s]| {
            said(Kloss::critical(speed(w), torque(m), s)).map(Motor::Kloss)
        }),
        (
            prop::collection::vec((any_f64(), any_f64()), 0..6),
            any::<bool>(),
            any::<bool>()
        )
            .prop_map(|(mut points, sort, smooth)| {
                if sort {
                    points.sort_by(|a, b| a.0.total_cmp(&b.0));
                }
                let reading = if smooth {
                    TableReading::Cubic
                } else {
                    TableReading::Linear
                };
                said(TorqueTable::new(&points, reading)).map(Motor::Table)
            }),
    ]
}

fn drive() -> impl Strategy<Value = Option<Drive>> {
    (motor(), numbers::<6>(), any::<bool>()).prop_map(|(motor, v, direct)| {
        if direct {
            return motor.map(Drive::direct);
        }
        let resistance = Resistance {
            constant: Torque::from_n_m(v[3]),
            viscous_n_m_s: v[4],
            quadratic_n_m_s2: v[5],
        };
        let (rotor, crank) = (Inertia::from_kg_m2(v[1]), Inertia::from_kg_m2(v[2]));
        said(Drive::new(motor?, v[0], rotor, crank, resistance))
    })
}

fn body(v: &[f64]) -> Body {
    Body {
        mass: Mass::from_kg(v[0]),
        inertia: MomentOfInertia::AboutCentreOfMass(Inertia::from_kg_m2(v[1])),
        radius: Length::from_m(v[2]),
        angle: Angle::from_rad(v[3]),
    }
}

#[derive(Clone, Debug)]
enum Model {
    Constant(ConstantInertia),
    FourBar(FourBarModel),
    SliderCrank(SliderCrankModel),
}

impl Model {
    fn reduced(&self) -> &dyn ReducedModel {
        match self {
            Model::Constant(m) => m,
            Model::FourBar(m) => m,
            Model::SliderCrank(m) => m,
        }
    }
}

fn model() -> impl Strategy<Value = Option<Model>> {
    let m = Length::from_m;
    let gravity = Acceleration::from_m_per_s2;
    let lengths = prop_oneof![numbers::<4>(), Just([1.0, 3.0, 2.5, 2.8])];
    prop_oneof![
        any_f64().prop_map(|i| Some(Model::Constant(ConstantInertia(i)))),
        (lengths.clone(), numbers::<13>(), any::<bool>()).prop_map(
            move |([a, b, c, d], v, left)| {
                let bar = said(FourBar::new(m(a), m(b), m(c), m(d)))?;
                let bodies = [body(&v), body(&v[4..]), body(&v[8..])];
                let model = FourBarModel::new(bar, side(left), bodies, gravity(v[12]));
                Some(Model::FourBar(said(model)?))
            }
        ),
        (lengths, numbers::<10>(), any::<bool>()).prop_map(move |([a, b, e, delta], v, left)| {
            let crank = said(SliderCrank::new(
                m(a),
                m(b),
                m(e / 3.0),
                Angle::from_rad(delta),
            ))?;
            let (bodies, slider) = ([body(&v), body(&v[4..])], Mass::from_kg(v[8]));
            let model = SliderCrankModel::new(crank, side(left), bodies, slider, gravity(v[9]));
            Some(Model::SliderCrank(said(model)?))
        }),
    ]
}

proptest! {
    #![proptest_config(cases(800))]

    #[test]
    fn motors(motor in motor(), speeds in prop::collection::vec(any_f64(), 1..5)) {
        let Some(motor) = motor else { return Ok(()) };
        let _ = (motor.kinks().len(), motor.pull_out_speed());
        for w in speeds {
            let _ = said(motor.torque_and_slope(w));
        }
    }

    #[test]
    fn forces(model in model(), drive in drive(), v in numbers::<4>(), forward: bool) {
        let (Some(model), Some(drive)) = (model, drive) else { return Ok(()) };
        let _ = (drive.kinks(), drive.pull_out_speed(), said(drive.motor_torque(v[0])));
        let _ = said(drive.with_flywheel(Inertia::from_kg_m2(v[3])));
        let equation = Equation::new(model.reduced(), &drive);
        let _ = said(equation.forces(v[0], v[1], if forward { 1.0 } else { -1.0 }));
        let _ = said(inertia_range(model.reduced(), v[2]));
        if let Some(s) = said(Splined::new(model.reduced(), v[2], 12)) {
            let _ = said(s.coefficients(v[0]));
        }
    }
}

#[cfg(feature = "run-up")]
mod integrated {
    use super::*;
    use mechaudit::solvers::run_up::{Method, Plan, Settings, flywheel, run, steady_cycle};

    proptest! {
        #![proptest_config(cases(150))]

        #[test]
        fn run_ups(
            model in model(), drive in drive(), v in numbers::<7>(), method in 0usize..3,
            given in any::<[bool; 3]>(), tolerance in prop_oneof![Just(1e-6), any_f64()],
        ) {
            let (Some(model), Some(drive)) = (model, drive) else { return Ok(()) };
            let equation = Equation::new(model.reduced(), &drive);
            let settings = Settings { tolerance, method: Method::ALL[method], max_steps: 300, switch_when_stiff: method == 0 };
            let plan = Plan {
                psi: v[2],
                target: given[0].then_some(v[3]),
                settled: given[1].then_some(v[4]),
                // At most some thousand samples.
                sampling: given[2].then_some(v[5].max(1e-3 * v[1])),
                settings,
                ..Plan::new(v[0], v[1])
            };
            if let Some(motion) = said(run(&equation, &plan)) {
                let ordered = motion.samples.windows(2).all(|s| s[0].t <= s[1].t);
                prop_assert!(ordered && motion.samples.iter().all(|s| s.psi.is_finite()));
            }
            let _ = said(steady_cycle(&equation, v[0], v[6], settings));
        }
    }

    proptest! {
        #![proptest_config(cases(30))]

        #[test]
        fn flywheels(model in model(), drive in drive(), v in numbers::<3>()) {
            let (Some(model), Some(drive)) = (model, drive) else { return Ok(()) };
            let settings = Settings { tolerance: 1e-4, max_steps: 200, ..Settings::default() };
            let _ = said(flywheel(&Equation::new(model.reduced(), &drive), v[0], v[1], v[2], settings));
        }
    }
}
