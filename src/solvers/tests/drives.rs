//! Parts of a run-up: drives, motors, tables of coefficients, the range of the inertia.

use crate::dyad::{Assembly, SliderCrank};
use crate::reduction::{Body, MomentOfInertia};
use crate::run_up::{
    Coefficients, ConstantInertia, Drive, Equation, Hybrid, ModelError, Motor, ReducedModel,
    Resistance, SliderCrankModel, Splined, inertia_range,
};
use crate::units::{Acceleration, Angle, AngularVelocity, Inertia, Length, Mass, Torque};
use std::f64::consts::TAU;

fn n_m(x: f64) -> Torque {
    Torque::from_n_m(x)
}

fn w(x: f64) -> AngularVelocity {
    AngularVelocity::from_rad_per_s(x)
}

/// `I = 2 + cos(φ − 0.3)`, with a place where it turns back and one where it is not smooth.
struct Waves(Vec<f64>, Vec<f64>);

impl ReducedModel for Waves {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        Ok(Coefficients {
            inertia: 2.0 + (phi - 0.3).cos(),
            inertia_derivative: -(phi - 0.3).sin(),
            moment: 1.5 * (phi + 0.2).sin(),
        })
    }
    fn knots(&self) -> &[f64] {
        &self.0
    }
    fn dead_positions(&self) -> &[f64] {
        &self.1
    }
}

fn waves() -> Waves {
    Waves(vec![0.5, 2.5], vec![1.25, 4.0, 5.5])
}

fn resistance() -> Resistance {
    Resistance {
        constant: n_m(2.0),
        viscous_n_m_s: 0.3,
        quadratic_n_m_s2: 0.05,
    }
}

fn drive(motor: Motor) -> Drive {
    let inertia = Inertia::from_kg_m2;
    Drive::new(motor, -4.0, inertia(0.01), inertia(0.5), resistance()).expect("a drive")
}

/// `I φ″ + ½ I′ φ′² = M`, and what the damping is the derivative of.
#[test]
fn forces_balance() {
    let model = waves();
    let d = drive(Motor::linear(n_m(30.0), w(60.0)).expect("a motor"));
    let equation = Equation::new(&model, &d);
    for phi in [0.1, 1.3, 2.9, 5.0] {
        for psi in [-6.0f64, -1.0, 2.0, 9.0] {
            let f = equation.forces(phi, psi, psi.signum()).expect("forces");
            let c = model.coefficients(phi).expect("coefficients");
            assert_eq!((f.linkage, f.inertia), (c, c.inertia + d.inertia()));
            let inertial = f.inertia * f.acceleration + 0.5 * psi * psi * c.inertia_derivative;
            let torque = d.motor_torque(psi).expect("a torque").0
                + d.resisting_torque(psi, psi.signum()).0
                + c.moment;
            assert!(
                (inertial - torque).abs() < 1e-12 * (1.0 + torque.abs()),
                "{phi} {psi}"
            );
            let h = 1e-6;
            let at = |x: f64| {
                equation
                    .forces(phi, x, psi.signum())
                    .expect("forces")
                    .acceleration
            };
            let rate = (at(psi + h) - at(psi - h)) / (2.0 * h);
            assert!(
                (f.damping - rate).abs() < 1e-7 * (1.0 + rate.abs()),
                "{phi} {psi}"
            );
        }
    }
}

#[test]
fn places_are_passed_on() {
    let model = waves();
    let by_reference: &dyn ReducedModel = &&model;
    assert_eq!(by_reference.knots(), model.knots());
    assert_eq!(by_reference.dead_positions(), model.dead_positions());
    let none = ConstantInertia(3.0);
    assert!(none.knots().is_empty() && none.dead_positions().is_empty());
    let splined = Splined::new(&model, 0.4, 64).expect("a spline");
    assert_eq!(splined.dead_positions(), model.dead_positions());
    assert_eq!(splined.knots().len(), 64);
    for (j, k) in splined.knots().iter().enumerate() {
        assert!((k - (0.4 + TAU * j as f64 / 64.0)).abs() < 1e-14);
    }
    let hybrid = Hybrid::new(waves(), 0.4, 64).expect("a spline");
    assert_eq!(hybrid.dead_positions(), model.dead_positions());
    assert_eq!(hybrid.knots(), splined.knots());
    for phi in [-3.0, 0.0, 0.4, 2.0, 9.0] {
        let (exact, h) = (model.coefficients(phi), hybrid.coefficients(phi));
        let (exact, h) = (exact.expect("coefficients"), h.expect("coefficients"));
        assert_eq!((h.inertia, h.moment), (exact.inertia, exact.moment));
        assert!((h.inertia_derivative - exact.inertia_derivative).abs() < 1e-4);
        let s = splined.coefficients(phi).expect("coefficients");
        assert_eq!(s.inertia_derivative, h.inertia_derivative);
        assert!((s.inertia - exact.inertia).abs() < 1e-5 && (s.moment - exact.moment).abs() < 1e-5);
    }
}

#[test]
fn ranges_of_the_inertia() {
    let least = 0.3 + TAU / 2.0;
    for from in [-20.0, -1.0, 0.0, 2.0, 100.0] {
        let r = inertia_range(&waves(), from).expect("a range");
        assert!(
            (r.most - 3.0).abs() < 1e-4 && (r.least - 1.0).abs() < 1e-4,
            "{r:?}"
        );
        assert!(
            from <= r.least_at && r.least_at < from + TAU,
            "{from}: {r:?}"
        );
        let off = (r.least_at - least).rem_euclid(TAU);
        assert!(off.min(TAU - off) < 0.01, "{from}: {r:?}");
        // A dead position is looked at itself.
        let dead = Waves(vec![], vec![least]);
        let r = inertia_range(&dead, from).expect("a range");
        assert!((r.least - 1.0).abs() < 1e-12, "{from}: {r:?}");
    }
    // Of two that are equal the first is told.
    let flat = inertia_range(&ConstantInertia(2.0), 1.0).expect("a range");
    assert_eq!((flat.least, flat.least_at, flat.most), (2.0, 1.0, 2.0));
}

/// A slider alone on an inclined guide: `m x′²`, and the weight's component along the guide.
#[test]
fn a_slider_on_a_slope() {
    let (l, tilt) = (Length::from_m, 0.6f64);
    let linkage = SliderCrank::new(l(0.05), l(0.18), l(0.015), Angle::from_rad(tilt)).expect("it");
    let none = Body {
        mass: Mass::from_kg(1e-12),
        inertia: MomentOfInertia::AboutCentreOfMass(Inertia::from_kg_m2(0.0)),
        radius: l(0.0),
        angle: Angle::from_rad(0.0),
    };
    let side = Assembly::Positive;
    let g = Acceleration::from_m_per_s2(9.81);
    let model = SliderCrankModel::new(linkage, side, [none; 2], Mass::from_kg(2.0), g);
    let model = model.expect("a model");
    for k in 0..20 {
        let phi = 0.3 * f64::from(k);
        let m = linkage
            .position(Angle::from_rad(phi), side)
            .expect("a position");
        let c = model.coefficients(phi).expect("coefficients");
        let v = m.slider_first_m;
        assert!((c.inertia - 2.0 * v * v).abs() < 1e-13, "{phi}");
        assert!(
            (c.inertia_derivative - 4.0 * v * m.slider_second_m).abs() < 1e-13,
            "{phi}"
        );
        let weight = -2.0 * 9.81 * tilt.sin() * v;
        assert!(
            (c.moment - weight).abs() < 1e-11,
            "{phi}: {} {weight}",
            c.moment
        );
    }
}
