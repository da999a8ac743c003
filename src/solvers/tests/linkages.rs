//! Class-III linkages, reduced masses, four-bars and slider-cranks.

use super::{Answer, Line, hold, lines, same};
use crate::class_iii::{ClassIii, Geometry, Positions, State};
use crate::dyad::{Assembly, FourBar, SliderCrank};
use crate::reduction::{Body, Masses, MomentOfInertia};
use crate::units::{Acceleration, Angle, Inertia, Length, Mass};

fn linkage(x: &[f64]) -> Result<ClassIii, String> {
    let geometry = Geometry::from_values(x[..11].try_into().expect("eleven"));
    ClassIii::new(geometry).map_err(|e| e.name().into())
}

fn masses(x: &[f64]) -> Masses {
    let bodies = std::array::from_fn(|i| {
        let b = &x[14 + 4 * i..18 + 4 * i];
        let inertia = Inertia::from_kg_m2(b[1]);
        let about_pivot = i % 2 == 0 && x[34 + i / 2] != 0.0;
        Body {
            mass: Mass::from_kg(b[0]),
            inertia: match about_pivot {
                true => MomentOfInertia::AboutPivot(inertia),
                false => MomentOfInertia::AboutCentreOfMass(inertia),
            },
            radius: Length::from_m(b[2]),
            angle: Angle::from_rad(b[3]),
        }
    });
    Masses::new(bodies, Acceleration::from_m_per_s2(x[13])).expect("masses")
}

fn modes(x: &[f64]) -> Result<(ClassIii, Vec<Positions>), String> {
    let linkage = linkage(x)?;
    let modes = linkage.assembly_modes(Angle::from_rad(x[11])).modes;
    match modes.is_empty() {
        true => Err("cannot be assembled".into()),
        false => Ok((linkage, modes)),
    }
}

/// Linkage, the chosen state, masses.
fn chosen(x: &[f64]) -> Result<(ClassIii, State, Masses), String> {
    let (linkage, modes) = modes(x)?;
    let mode = modes[x[12] as usize % modes.len()];
    let state = linkage
        .state(Angle::from_rad(x[11]), mode)
        .map_err(|_| "singular")?;
    Ok((linkage, state, masses(x)))
}

fn row(state: &State, masses: &Masses) -> Vec<f64> {
    let r = masses.reduce(state);
    let mut all = state.positions.to_array().to_vec();
    all.extend(state.rates.first);
    all.extend(state.rates.second);
    all.extend([r.inertia_kg_m2, r.inertia_derivative_kg_m2]);
    all.extend([r.moment_n_m, r.moment_derivative_n_m]);
    all
}

#[test]
fn assembly_modes() {
    let all = |x: &[f64]| -> Answer {
        let modes = modes(x)?.1;
        Ok(modes.iter().flat_map(|m| m.to_array()).collect())
    };
    hold("class-iii-assembly-modes", &[("modes", &all)]);
}

#[test]
fn class_iii() {
    let direct = |x: &[f64]| -> Answer {
        let (_, state, masses) = chosen(x)?;
        Ok(row(&state, &masses))
    };
    // The calls of a run-up: velocities first, accelerations when they are wanted.
    let velocities = |x: &[f64]| -> Answer {
        let (linkage, state, masses) = chosen(x)?;
        let v = linkage
            .velocities(Angle::from_rad(x[11]), state.positions)
            .map_err(|_| "singular")?;
        let mut all = row(&state, &masses);
        all[4..8].copy_from_slice(&v.first);
        all[8..12].copy_from_slice(&v.accelerations().expect("regular"));
        let (inertia, moment) = masses.inertia_and_moment(&v);
        (all[12], all[14]) = (inertia, moment);
        Ok(all)
    };
    hold(
        "class-iii",
        &[("state", &direct), ("velocities", &velocities)],
    );
}

fn regular() -> impl Iterator<Item = (Line, ClassIii, State, Masses)> {
    lines("class-iii").into_iter().filter_map(|line| {
        let (linkage, state, masses) = chosen(&line.input).ok()?;
        (state.condition < 50.0).then_some((line, linkage, state, masses))
    })
}

/// Away on a branch and back, and all of it at once on all cores.
#[test]
fn branches_are_followed() {
    let mut met = 0;
    for (line, linkage, start, masses) in regular() {
        let there = start.phi1 + 0.01;
        let Ok(end) = linkage.follow(&start, Angle::from_rad(there)) else {
            continue;
        };
        assert!(same(end.phi1, there));
        let back = linkage
            .follow(&end, Angle::from_rad(start.phi1))
            .expect("the same way");
        line.check("class-iii, there and back,", &Ok(row(&back, &masses)));
        // Close by, where the derivatives say: an error of the third order.
        for i in 0..4 {
            let r = &start.rates;
            let due = start.positions.to_array()[i] + 0.01 * (r.first[i] + 0.005 * r.second[i]);
            let off = (end.positions.to_array()[i] - due).abs();
            assert!(
                off < 1e-6 * (1.0 + start.condition).powi(4),
                "{}: {off}",
                line.place
            );
        }
        let angles = [start.phi1, start.phi1 + 0.004, there].map(Angle::from_rad);
        let swept = linkage.sweep(&start, angles).expect("the same way");
        assert_eq!(swept.len(), 3);
        line.check("class-iii, sweep,", &Ok(row(&swept[0], &masses)));
        let last = swept[2].positions.to_array();
        let apart = |(a, b): (&f64, f64)| (a - b).abs();
        let off = last
            .iter()
            .zip(end.positions.to_array())
            .map(apart)
            .fold(0.0, f64::max);
        assert!(off < 1e-13 * (1.0 + end.condition), "{}: {off}", line.place);
        met += 1;
    }
    assert!(met > 15, "{met} linkages");
}

fn side(x: f64) -> Assembly {
    match x > 0.0 {
        true => Assembly::Positive,
        false => Assembly::Negative,
    }
}

#[test]
fn four_bar() {
    let position = |x: &[f64]| -> Answer {
        let [a, b, c, d] = [x[0], x[1], x[2], x[3]].map(Length::from_m);
        let bar = FourBar::new(a, b, c, d).map_err(|e| e.name().to_string())?;
        let at = bar.position(Angle::from_rad(x[4]), side(x[5]));
        let m = at.map_err(|e| e.name().to_string())?;
        let (b, c) = (m.coupler, m.rocker);
        let [x, y] = m.joint.position_m;
        let mu = m.transmission.rad();
        Ok(vec![
            b.angle.rad(),
            c.angle.rad(),
            b.first,
            c.first,
            b.second,
            c.second,
            mu,
            x,
            y,
        ])
    };
    hold("four-bar", &[("position", &position)]);
}

#[test]
fn slider_crank() {
    let position = |x: &[f64]| -> Answer {
        let [a, b, e] = [x[0], x[1], x[2]].map(Length::from_m);
        let delta = Angle::from_rad(x[3]);
        let crank = SliderCrank::new(a, b, e, delta).map_err(|e| e.name().to_string())?;
        let at = crank.position(Angle::from_rad(x[4]), side(x[5]));
        let m = at.map_err(|e| e.name().to_string())?;
        let slider = [m.slider_m, m.slider_first_m, m.slider_second_m];
        let rod = [
            m.rod.angle.rad(),
            m.rod.first,
            m.rod.second,
            m.transmission.rad(),
        ];
        Ok([&slider[..], &rod].concat())
    };
    hold("slider-crank", &[("position", &position)]);
}

/// On all cores the masses are reduced as one by one.
#[cfg(feature = "parallel")]
#[test]
fn masses_at_many_positions() {
    let (_, linkage, state, masses) = regular().next().expect("a linkage");
    let near = |k: u32| linkage.follow(&state, Angle::from_rad(state.phi1 + 1e-4 * f64::from(k)));
    let states: Vec<State> = (0..20).map_while(|k| near(k).ok()).collect();
    let one: Vec<_> = states.iter().map(|s| masses.reduce(s)).collect();
    assert!(!one.is_empty());
    assert_eq!(masses.reduce_parallel(&states), one);
}
