//! Cam laws, Fourier series, the oscillator under a chirp and its chart.

use super::{all_finite, any_f64, cases, numbers, said, usual};
use mechaudit::solvers::cam_law::{CamCycle, MotionLaw, NAMES, Stroke};
use mechaudit::solvers::chirp_chart::{CamDrive, CamResponse, Chart, Period, beat_zones};
use mechaudit::solvers::chirp_oscillator::{
    Chirp, ChirpResponse, Excitation, Forcing, Harmonic, InitialState, Oscillator,
};
use mechaudit::solvers::cubic_spline::End;
use mechaudit::solvers::fourier_series::FourierSeries;
use proptest::prelude::*;

fn law() -> impl Strategy<Value = Option<MotionLaw>> {
    let share = || prop_oneof![any_f64(), 0.01..0.99];
    prop_oneof![
        4 => (prop::sample::select(NAMES.to_vec()), share(), any::<bool>()).prop_map(|(name, share, even)| {
            let law = said(MotionLaw::by_name(name))?;
            if even { Some(law) } else { said(law.with_acceleration_fraction(share)) }
        }),
        1 => "[a-z0-9 -]{0,12}".prop_map(|name| said(MotionLaw::by_name(&name))),
        1 => numbers::<3>().prop_map(|[b, c, d]| said(MotionLaw::scca(b, c, d))),
        2 => (0.0f64..1.0, 0.0f64..1.0).prop_map(|(b, d)| said(MotionLaw::scca(b, 1.0 - b.max(d), b.min(d)))),
        1 => prop::collection::vec(any_f64(), 0..8).prop_map(|c| said(MotionLaw::polynomial(&c))),
        2 => prop::collection::vec(usual(), 1..8).prop_map(|mut c| {
            c[0] = 0.0;
            let rest: f64 = c.iter().sum();
            c.push(1.0 - rest);
            said(MotionLaw::polynomial(&c))
        }),
        1 => (prop::collection::vec(any_f64(), 0..6), prop::collection::vec(any_f64(), 0..6))
            .prop_map(|(x, y)| said(MotionLaw::tabulated(x, y, [End::NotAKnot; 2]))),
        2 => prop::collection::vec(0.01f64..1.0, 2..6).prop_map(|steps| {
            let sum: f64 = steps.iter().sum();
            let mut x = vec![0.0];
            x.extend(steps.iter().scan(0.0, |at, s| { *at += s / sum; Some(*at) }));
            *x.last_mut().expect("one") = 1.0;
            said(MotionLaw::tabulated(x.clone(), x, [End::FirstDerivative(0.0); 2]))
        }),
    ]
}

fn cycle() -> impl Strategy<Value = Option<CamCycle>> {
    let shares = prop_oneof![
        1 => numbers::<4>(),
        3 => (0.05f64..0.4, 0.0f64..0.2, 0.05f64..0.4).prop_map(|(r, d, f)| [r, d, f, 1.0 - r - d - f]),
    ];
    (
        law(),
        law(),
        shares,
        prop_oneof![any_f64(), usual()],
        any_f64(),
        0..4,
    )
        .prop_map(|(rise, fall, [r, high, f, low], lift, start, kind)| {
            let rise = Stroke {
                law: rise?,
                turns: r,
            };
            let fall = Stroke {
                law: fall?,
                turns: f,
            };
            let cycle = said(match kind {
                0 => CamCycle::rise_return(
                    lift,
                    rise,
                    Stroke {
                        turns: 1.0 - r,
                        ..fall
                    },
                ),
                1 => CamCycle::rise_dwell(lift, rise, 1.0 - r),
                _ => CamCycle::new(lift, rise, high, fall, low),
            })?;
            said(cycle.clone().starting_at(start)).or(Some(cycle))
        })
}

proptest! {
    #![proptest_config(cases(800))]

    #[test]
    fn cam_laws(law in law(), places in prop::collection::vec(any_f64(), 1..6)) {
        let Some(law) = law else { return Ok(()) };
        let _ = law.peaks();
        for x in places {
            let motion = said(law.motion(x));
            prop_assert_eq!(motion.is_some(), said(law.remaining(x)).is_some());
            if let Some(m) = motion {
                prop_assert!(m.displacement.is_finite(), "{} of {:?}", x, law);
            }
        }
    }

    #[test]
    fn cycles_and_their_series(
        cycle in cycle(), turns in any_f64(), order in any::<u32>(), tolerance in any_f64(),
        derivative in 0u32..6,
    ) {
        let Some(cycle) = cycle else { return Ok(()) };
        let _ = (cycle.phase(turns), said(cycle.at(turns)));
        let series = FourierSeries::new(&cycle);
        let _ = (series.mean(), series.tail_bound(order, derivative));
        let _ = said(series.harmonics_for(tolerance, derivative));
        for order in [order, order % 1000] {
            if let Some(h) = said(series.harmonic(order)) {
                prop_assert!(!h.amplitude().is_nan() && !h.phase().is_nan(), "{:?} of {:?}", h, cycle);
            }
        }
        prop_assert!(series.harmonics(order % 64).is_ok() == (order % 64 > 0) || order % 64 == 0);
    }

    #[test]
    fn oscillator(
        v in numbers::<9>(), more in numbers::<4>(), acceleration: bool,
        times in prop::collection::vec(any_f64(), 0..20), index in 0usize..4,
    ) {
        let harmonic = Harmonic { k: v[4], amplitude: more[0], phase: v[5] };
        let second = Harmonic { k: more[1], amplitude: more[2], phase: v[0] };
        let Some(oscillator) = said(Oscillator::new(v[0], v[1])) else { return Ok(()) };
        let excitation = Excitation {
            chirp: Chirp { omega0: v[3], eps: v[2] },
            forcing: if acceleration { Forcing::Acceleration } else { Forcing::Displacement },
            static_term: more[3],
            harmonics: vec![harmonic, second],
        };
        let initial = InitialState { displacement: v[6], velocity: v[7] };
        let Some(r) = said(ChirpResponse::new(oscillator, excitation, initial)) else {
            return Ok(());
        };
        for &t in times.iter().chain([&v[8], &0.0]) {
            let refused = !(t >= 0.0 && t.is_finite());
            prop_assert_eq!(r.motion(t).is_err(), refused);
            prop_assert_eq!(said(r.displacement(t)).is_none(), refused);
            prop_assert_eq!(said(r.envelope(t)).is_none(), refused);
            if let Some(h) = said(r.harmonic(index, t)) {
                let _ = (h.envelope(), h.phase());
            }
        }
        let refused = times.iter().any(|t| !(*t >= 0.0 && t.is_finite()));
        let n = times.len();
        prop_assert_eq!(r.displacements(&times, &mut vec![0.0; n]).is_err(), refused);
        prop_assert!(r.displacements(&times, &mut vec![0.0; n + 1]).is_err());
        prop_assert_eq!(r.motions(&times, &mut vec![Default::default(); n]).is_err(), refused);
        let _ = said(r.amplitudes(index, &times, &mut vec![Default::default(); n]));
    }
}

proptest! {
    #![proptest_config(cases(30))]

    #[test]
    fn charts(
        cycle in cycle(), v in numbers::<6>(), near in prop::array::uniform4(0.1f64..5.0),
        mild: bool, harmonics in 0u32..12, start: bool, xi in any_f64(), t in any_f64(),
    ) {
        let [w, n, omega0, eps] = if mild { near } else { [v[0], v[1], v[2], v[3]] };
        let Some(cycle) = cycle else { return Ok(()) };
        let Some(oscillator) = said(Oscillator::new(w, n)) else { return Ok(()) };
        let drive = CamDrive { oscillator, cycle, chirp: Chirp { omega0, eps } };
        let initial = InitialState { displacement: v[4], velocity: v[5] };
        let Some(r) = said(CamResponse::new(drive.clone(), harmonics, start.then_some(initial))) else {
            return Ok(());
        };
        let _ = (r.mean(), drive.speed(t), drive.turns(t));
        for period in [Period::Rise, Period::Turn] {
            for xi in [xi, 1.5] {
                let _ = said(drive.time_of(xi, period));
                if let Some(chart) = said(Chart::new(&r, period, &[xi])) {
                    let _ = chart.beats(|p| p.bound);
                }
            }
        }
        for t in [t, 0.7] {
            let _ = (said(r.state(t)), said(r.bounds(t)), said(r.free_vibration(t)));
            let _ = r.peaks(t);
        }
    }

    #[test]
    fn zones(points in prop::collection::vec((any_f64(), any_f64()), 0..40)) {
        prop_assert!(beat_zones(&points).len() <= points.len());
    }
}

#[test]
fn usual_cycles_are_met() {
    // The strategies are of no use if everything is refused.
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let made = (0..400).filter(|_| {
        let tree = cycle().new_tree(&mut runner).expect("a value");
        tree.current().is_some_and(|c| all_finite(&[c.lift()]))
    });
    assert!(made.count() > 40);
}

/// An oscillator that is very much faster than the shaft: its periods in a turn cannot all be
/// sampled.
#[test]
fn a_stiff_oscillator_does_not_fill_the_memory() {
    let law = MotionLaw::cycloidal;
    let stroke = || Stroke {
        law: law(),
        turns: 0.5,
    };
    let drive = CamDrive {
        oscillator: Oscillator::new(1e13, 1e12).expect("an oscillator"),
        cycle: CamCycle::rise_return(1.0, stroke(), stroke()).expect("a cycle"),
        chirp: Chirp {
            omega0: 1.0,
            eps: 0.1,
        },
    };
    let r = CamResponse::new(drive, 1, None).expect("a response");
    let peaks = r.peaks(3.0);
    assert!(peaks.displacement.is_finite() && peaks.acceleration.is_finite());
}
