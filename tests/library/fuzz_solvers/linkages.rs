//! Dyads, class-III linkages, reduction.

use super::{all_finite, any_f64, cases, numbers, said, usual};
use mechaudit::solvers::class_iii::{ClassIii, Geometry, Link, Positions};
use mechaudit::solvers::dyad::{
    Assembly, FourBar, Guide, PointMotion, RrpDyad, RrrDyad, SliderCrank,
};
use mechaudit::solvers::reduction::{Body, Masses, MomentOfInertia};
use mechaudit::solvers::units::{Acceleration, Angle, AngularVelocity, Inertia, Length, Mass};
use proptest::prelude::*;

pub fn side(left: bool) -> Assembly {
    match left {
        true => Assembly::Positive,
        false => Assembly::Negative,
    }
}

/// The sand screen, its lengths changed by the factors.
fn scaled(factors: &[f64; 11]) -> [f64; 11] {
    let screen = [
        0.1, 1.04, 0.6, 0.64, 0.485, 0.22, -0.686, 0.75, 0.93, 1.285, 1.035,
    ];
    std::array::from_fn(|i| screen[i] * factors[i])
}

fn body(v: &[f64], about_pivot: bool) -> Body {
    let inertia = Inertia::from_kg_m2(v[1]);
    Body {
        mass: Mass::from_kg(v[0]),
        inertia: match about_pivot {
            true => MomentOfInertia::AboutPivot(inertia),
            false => MomentOfInertia::AboutCentreOfMass(inertia),
        },
        radius: Length::from_m(v[2]),
        angle: Angle::from_rad(v[3]),
    }
}

proptest! {
    #![proptest_config(cases(1500))]

    #[test]
    fn dyads(v in numbers::<12>(), y in any_f64(), left: bool) {
        let (m, rad, side) = (Length::from_m, Angle::from_rad, side(left));
        if let Some(bar) = said(FourBar::new(m(v[0]), m(v[1]), m(v[2]), m(v[3]))) {
            let _ = (bar.grashof_type(), bar.crank_range(), bar.dead_positions(side).swing());
            for phi in [y, v[4]] {
                let Some(at) = said(bar.position(rad(phi), side)) else { continue };
                let (b, c) = (at.coupler, at.rocker);
                prop_assert!(all_finite(&[b.angle.rad(), c.angle.rad(), b.first, c.first]));
                prop_assert!(all_finite(&[b.second, c.second, at.transmission.rad()]));
                prop_assert!((0.0..=3.2).contains(&at.transmission.rad().abs()));
                prop_assert!(at.pressure_angle().rad().is_finite());
            }
        }
        if let Some(crank) = said(SliderCrank::new(m(v[0]), m(v[1]), m(v[2]), rad(v[3]))) {
            let _ = (crank.turns_fully(), crank.crank_limits(), crank.dead_centres(side), crank.stroke());
            for phi in [y, v[4]] {
                let Some(at) = said(crank.position(rad(phi), side)) else { continue };
                prop_assert!(all_finite(&[at.slider_m, at.slider_first_m, at.slider_second_m]));
                prop_assert!(all_finite(&[at.rod.angle.rad(), at.rod.first, at.rod.second]));
            }
        }
        let point = |k: usize| PointMotion {
            position_m: [v[k], v[k + 1]],
            first_m: [v[k + 2], v[k + 3]],
            second_m: [v[k + 4], v[k + 5]],
        };
        if let Some(dyad) = said(RrrDyad::new(m(v[0]), m(y), side)) {
            let _ = said(dyad.solve(&point(0), &point(6))).map(|d| d.pressure_angle());
        }
        let guide = Guide { origin_m: [v[6], v[7]], direction: rad(v[8]) };
        if let Some(dyad) = said(RrpDyad::new(m(y), side)) {
            let _ = said(dyad.solve(&point(0), &guide));
        }
    }
}

proptest! {
    #![proptest_config(cases(120))]

    #[test]
    fn class_iii(
        any in numbers::<11>(), factors in prop::array::uniform11(0.8f64..1.25), near: bool,
        phi in any_f64(), to in any_f64(), small in -3.0f64..3.0, m in numbers::<22>(),
        guess in numbers::<4>(), pivots in any::<[bool; 5]>(),
    ) {
        let values = if near { scaled(&factors) } else { any };
        let Some(linkage) = said(ClassIii::new(Geometry::from_values(&values))) else {
            return Ok(());
        };
        let bodies = std::array::from_fn(|i| body(&m[4 * i..4 * i + 4], pivots[i]));
        let masses = said(Masses::new(bodies, Acceleration::from_m_per_s2(m[20])));
        for at in [phi, small] {
            let rad = Angle::from_rad;
            let guess = Positions::from_array(guess);
            let _ = said(linkage.state_near(rad(at), guess));
            let _ = (linkage.state(rad(at), guess), linkage.velocities(rad(at), guess));
            let modes = linkage.assembly_modes(rad(at)).modes;
            prop_assert!(modes.len() <= 6);
            for mode in modes {
                prop_assert!(all_finite(&mode.to_array()));
                let Some(state) = said(linkage.state_near(rad(at), mode)) else { continue };
                prop_assert!(all_finite(&state.positions.wrapped().to_array()));
                prop_assert!(all_finite(state.joints().as_flattened()));
                let _ = state.rates.at_crank_speed(AngularVelocity::from_rad_per_s(m[21]), m[20]);
                let _ = state.point(Link::Link4, m[0], m[1]);
                let _ = said(linkage.follow(&state, rad(to.clamp(-10.0, 10.0))));
                let _ = linkage.dead_positions(&state, rad(at + 0.1)).map_err(|e| e.1.to_string());
                let _ = linkage.sweep(&state, [at, at + 0.01, to.min(20.0)].map(rad)).is_ok();
                #[cfg(feature = "parallel")]
                let _ = linkage.sweep_parallel(&state, &[at, at + 0.01].map(rad)).is_ok();
                if let Some(masses) = &masses {
                    let _ = (masses.reduce(&state), masses.motions(&state));
                    let _ = linkage.rows(masses, &state, [at, small].map(rad)).is_ok();
                }
            }
        }
        let _ = linkage.trace_branches(&[small, small + 0.01, small - 0.02].map(Angle::from_rad));
        let _ = linkage.trace_branches(&[Angle::from_rad(phi)]);
    }

    #[test]
    fn units(x in usual()) {
        let relative = |a: f64| (a - x).abs() <= 4.0 * f64::EPSILON * x.abs();
        prop_assert!(relative(Angle::from_deg(x).deg()) && relative(Length::from_cm(x).m() * 100.0));
    }
}
