//! Places, residuals and their Jacobian for every kind of joint.

use super::super::equilibrium_tests::*;
use super::super::newton::Work;
use super::super::tests::*;
use super::super::*;
use super::*;

fn anywhere(mechanism: &Mechanism, random: &mut Random) -> Pose {
    let n = mechanism.chain.unknowns;
    let u = (0..n).map(|_| random.between(-3.0, 3.0)).collect();
    Pose::new(&mechanism.chain, random.between(-3.0, 3.0), u)
}

/// Positions at a drive of 0.4: all modes, or, as those of gears are not enumerated, what Newton's
/// method finds.
fn closed(mechanism: &Mechanism) -> Vec<State> {
    let mut states = mechanism.assembly_modes(0.4).states;
    let mut random = Random(21);
    for _ in 0..if states.is_empty() { 40 } else { 0 } {
        let mut pose = anywhere(mechanism, &mut random);
        pose.drive = 0.4;
        pose.place(&mechanism.chain, &mechanism.chain.order);
        let work = &mut Work::new(&mechanism.chain);
        if mechanism.chain.newton(&mut pose, None, work) {
            states.extend(State::new(mechanism, pose));
        }
    }
    assert!(!states.is_empty());
    states
}

/// The Jacobian is the derivative of the residual.
#[test]
fn jacobians_are_derivatives() {
    let mut random = Random(5);
    for (what, mechanism, _) in every() {
        let chain = &mechanism.chain;
        let n = chain.unknowns;
        let mut jacobian = Matrix::new(n, n + 1);
        for _ in 0..20 {
            let pose = anywhere(&mechanism, &mut random);
            pose.jacobian(chain, 0..chain.closures.len(), &mut jacobian);
            for column in 0..=n {
                let h = 1e-6;
                let [back, ahead] = [-h, h].map(|h| {
                    let mut u = pose.u.clone();
                    let mut drive = pose.drive;
                    match column < n {
                        true => u[column] += h,
                        false => drive += h,
                    }
                    let mut rows = Vec::new();
                    Pose::new(chain, drive, u).residual(chain, &chain.closures, &mut rows);
                    rows
                });
                for row in 0..n {
                    let due = (ahead[row] - back[row]) / (2.0 * h);
                    let off = (jacobian[(row, column)] - due).abs();
                    assert!(off < 1e-8, "{what}: {row} {column}: {off}");
                }
            }
        }
    }
}

/// A tie of two turning bodies: their angle less what is due, within half a turn; and its
/// derivatives.
#[test]
fn a_tie_is_an_angle_between_bodies() {
    let mut m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let (offset, by) = (0.25, 0.5);
    m.chain.closures = vec![Closure::Tie {
        a: 2,
        b: 3,
        offset,
        drive: by,
    }];
    m.chain.arms = vec![None];
    let chain = &m.chain;
    for (drive, u) in [(0.7, [0.3, 1.9]), (0.7, [-2.9, 3.1]), (-0.4, [40.0, -3.0])] {
        let pose = Pose::new(chain, drive, u.to_vec());
        let between = pose.angle(chain, 3) - pose.angle(chain, 2) - offset - by * drive;
        let mut rows = Vec::new();
        pose.residual(chain, &chain.closures, &mut rows);
        let turns = (rows[0] - between) / TAU;
        assert!(rows.len() == 1 && rows[0].abs() <= 3.2);
        assert!((turns - turns.round()).abs() < 1e-14, "{turns}");
        let mut jacobian = Matrix::new(2, 3);
        pose.jacobian(chain, 0..1, &mut jacobian);
        let of = |body: usize| chain.turns[body].unknown.unwrap();
        for (k, due) in [(of(3), 1.0), (of(2), -1.0), (2, -by)] {
            assert_eq!(jacobian[(0, k)], due, "{k}");
        }
    }
}

/// A closed mechanism is closed as its description has it: pins in one place, points on their
/// guides.
#[test]
fn joints_are_together() {
    for (what, mechanism, _) in every() {
        for state in closed(&mechanism) {
            let at = |p: &Point| mechanism.point(&state, p).r;
            let turn = |body: usize| mechanism.body_angle(&state, body).angle.rad();
            for joint in &mechanism.description().joints {
                let off = match &joint.part {
                    Joint::Pin { points } => {
                        let [x, y] = at(&points[0]);
                        let far = |p: &Point| (at(p)[0] - x).hypot(at(p)[1] - y);
                        points.iter().map(far).fold(0.0, f64::max)
                    }
                    Joint::Slide {
                        slider: p, guide, ..
                    }
                    | Joint::Slot {
                        pin: p,
                        slot: guide,
                    } => {
                        let (s, c) = (turn(guide.origin.body) + guide.direction.rad()).sin_cos();
                        let ([x, y], [a, b]) = (at(p), at(&guide.origin));
                        (c * (y - b) - s * (x - a)).abs()
                    }
                    Joint::Gears {
                        wheels: [a, b],
                        carrier,
                        ratio,
                        phase,
                    } => {
                        let [a, b] = [a, b].map(|&w| turn(w) - turn(*carrier));
                        (b - ratio * a - phase.rad()).abs()
                    }
                    Joint::Rack {
                        wheel,
                        slide,
                        radius,
                        phase,
                    } => {
                        let Joint::Slide { slider, guide, .. } =
                            &mechanism.description().joints[*slide].part
                        else {
                            unreachable!("a rack slides")
                        };
                        let (s, c) = (turn(guide.origin.body) + guide.direction.rad()).sin_cos();
                        let ([x, y], [a, b]) = (at(slider), at(&guide.origin));
                        let rolled = radius.m() * (turn(*wheel) - turn(guide.origin.body));
                        (c * (x - a) + s * (y - b) - rolled - phase.m()).abs()
                    }
                };
                assert!(off < 1e-14, "{what}: {} {off}", joint.name);
                if let Joint::Slide {
                    slider,
                    guide,
                    turn: due,
                } = &joint.part
                {
                    let between = turn(slider.body) - turn(guide.origin.body) - due.rad();
                    let off = between - (between / TAU).round() * TAU;
                    assert!(off.abs() < 1e-14, "{what}: {} {off}", joint.name);
                }
            }
            if let Drive::Displacement { joint } = mechanism.description().drive {
                let s = mechanism.joint_displacement(&state, joint).unwrap();
                assert!(
                    (s.s_m - 0.4).abs() < 1e-14 && (s.first_m - 1.0).abs() < 1e-12,
                    "{s:?}"
                );
            }
        }
    }
}

/// Directions turned by a step are those of the new angles.
#[test]
fn turns_by_steps() {
    let mut random = Random(9);
    for (what, mechanism, _) in every() {
        let chain = &mechanism.chain;
        // All by a little, by terms of the series, by more, and one alone by more.
        for (size, others) in [
            (LITTLE, 1.0),
            (SMALL, 1.0),
            (1e-3, 1e-9),
            (0.1, 1.0),
            (0.1, 1e-9),
        ] {
            let mut pose = anywhere(&mechanism, &mut random);
            let part = |k: usize| if k == 0 { size } else { size * others };
            let step: Vec<f64> = (0..pose.u.len())
                .map(|k| part(k) * pose.u[k].signum())
                .collect();
            pose.u.iter_mut().zip(&step).for_each(|(u, d)| *u += d);
            let due = Pose::new(chain, pose.drive, pose.u.clone());
            pose.turn_by(chain, &step);
            for b in 0..chain.body_count() {
                let off = (pose.e[b] - due.e[b])
                    .norm()
                    .max((pose.p[b] - due.p[b]).norm());
                assert!(off < 4e-15, "{what}: body {b} {off:e}");
                let anew = size > SMALL && others == 1.0;
                assert!(!anew || pose.e[b] == due.e[b], "{what}: body {b}");
            }
        }
    }
}

/// Rates of angles, points and displacements are the derivatives along the branch.
#[test]
fn rates_are_derivatives() {
    let large: (_, _, &[f64]) = ("double butterfly", double_butterfly(), &[]);
    for (what, mechanism, _) in every().into_iter().chain([large]) {
        let bodies = 1..mechanism.description().bodies.len();
        let values = |state: &State| -> Vec<[f64; 3]> {
            let mut all = Vec::new();
            for b in bodies.clone() {
                let a = mechanism.body_angle(state, b);
                let p = mechanism.point(state, &Point::from_m(b, [0.13, -0.21]));
                all.push([a.angle.rad(), a.first, a.second]);
                all.extend([0, 1].map(|i| [p.r[i], p.first[i], p.second[i]]));
            }
            let joints = 0..mechanism.description().joints.len();
            let slides = joints.filter_map(|j| mechanism.joint_displacement(state, j));
            all.extend(slides.map(|s| [s.s_m, s.first_m, s.second_m]));
            all
        };
        for state in closed(&mechanism) {
            const H: f64 = 1e-4;
            let beside = |h: f64| {
                mechanism.follow(&state, 0.4 + h).map(|s| {
                    let mut own = s.clone();
                    assert!(own.update(&mechanism.chain, &mut Work::new(&mechanism.chain)));
                    assert_eq!(own.rates, s.rates, "{what}");
                    values(&s)
                })
            };
            let (Ok(back), Ok(ahead)) = (beside(-H), beside(H)) else {
                continue;
            };
            for (k, [x, first, second]) in values(&state).into_iter().enumerate() {
                let slope = (ahead[k][0] - back[k][0]) / (2.0 * H);
                let bend = (ahead[k][0] - 2.0 * x + back[k][0]) / (H * H);
                let size = 1.0 + first.abs() + second.abs();
                let off = (first - slope).abs().max(0.01 * (second - bend).abs());
                assert!(
                    off < 1e-7 * size * size,
                    "{what}: {k}: {first} {slope} {second} {bend}"
                );
            }
        }
    }
}

/// Directions that have turned by the last correction close the loops better than those of the
/// rounded angles.
#[test]
fn settled_directions_close_better() {
    let mechanism = four_bar([0.1, 0.4, 0.3, 0.35]);
    let chain = &mechanism.chain;
    let (mut settled, mut rounded) = (0.0, 0.0);
    let mut rows = Vec::new();
    for k in 0..100 {
        for state in mechanism.assembly_modes(0.06 * f64::from(k)).states {
            let again = Pose::new(chain, state.pose.drive, state.pose.u.clone());
            for (pose, sum) in [(&state.pose, &mut settled), (&again, &mut rounded)] {
                pose.residual(chain, &chain.closures, &mut rows);
                *sum += rows[0].hypot(rows[1]);
            }
        }
    }
    println!("{settled:e} {rounded:e}");
    assert!(rounded > 1e-15 && settled < 0.75 * rounded);
}

/// A last correction of angles and directions alike where it is small; a larger one is none.
#[test]
fn the_last_correction_is_that_of_the_angles_too() {
    let m = four_bar([0.1, 0.4, 0.3, 0.35]);
    let state = m.assembly_modes(0.7).states.remove(0);
    let mut work = Work::new(&m.chain);
    for k in 0..m.chain.unknowns {
        for (off, corrected) in [(1e-9, true), (-3e-9, true), (1e-6, false)] {
            let mut u = state.pose.u.clone();
            u[k] += off;
            let given = Pose::new(&m.chain, state.pose.drive, u);
            let mut pose = given.clone();
            pose.settle(&m.chain, &state.factors, &mut work);
            let due = if corrected { &state.pose } else { &given };
            for (a, b) in pose.u.iter().zip(&due.u) {
                assert!((a - b).abs() < 1e-15, "{off}: {a} {b}");
            }
            for (a, b) in pose.e.iter().zip(&due.e) {
                assert!((a - b).norm() < 1e-15, "{off}: {a} {b}");
            }
        }
    }
}
