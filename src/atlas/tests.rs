//! Each algorithm reaches about what its paper claims at ordinary points: its constants are those of the paper.

use crate::{Algorithm, Parts, Plane, all, find};
use mechaudit_solvers::faddeeva::faddeeva;
use num_complex::{Complex, Complex32, Complex64};
use std::collections::HashSet;

/// A lattice of ordinary points, off simple fractions.
fn ordinary(from: f64) -> impl Iterator<Item = Complex64> {
    let place = |k: i32| 0.41 * f64::from(k) + 0.013;
    (0..20).flat_map(move |i| (0..14).map(move |j| Complex::new(place(i), from + place(j))))
}

/// The largest relative errors of w, Re w and Im w.
fn worst(a: &Algorithm, from: f64) -> [f64; 3] {
    let mut worst = [0.0f64; 3];
    for z in ordinary(from) {
        let (got, due) = ((a.w)(z), faddeeva(z));
        let errors = match a.parts {
            Parts::Both => [
                (got - due).norm() / due.norm(),
                ((got.re - due.re) / due.re).abs(),
                ((got.im - due.im) / due.im).abs(),
            ],
            Parts::Real => [0.0, ((got.re - due.re) / due.re).abs(), 0.0],
        };
        for (w, e) in worst.iter_mut().zip(errors) {
            *w = if e.is_nan() { f64::INFINITY } else { w.max(e) };
        }
    }
    worst
}

/// By name: the largest error in the norm and of the real part where y ≥ 0.1, as the papers have it or as the
/// formula gives.
const REACHED: [(&str, f64, f64); 31] = [
    ("gautschi-1970", 1e-9, 2e-8),
    ("cernlib-wwerf", 1e-9, 2e-8),
    ("matta-reichel-1971", 1e-13, 1e-13),
    ("hunter-regan-1972", 1e-15, 1e-15),
    ("hui-armstrong-wray-1978", 1e-5, 3e-4),
    ("humlicek-1979", 2e-6, 4e-6),
    ("humlicek-1982", 1e-4, 2e-4),
    ("thompson-cox-hastings-1987", 0.0, 0.3),
    ("poppe-wijers-1990", 1e-14, 1e-13),
    ("mclean-1994", 0.0, 0.1),
    ("weideman-1994-16", 1e-6, 2e-5),
    ("weideman-1994-24", 1e-9, 2e-8),
    ("weideman-1994-32", 3e-13, 2e-11),
    ("wells-1999-r2", 1e-2, 1e-2),
    ("wells-1999-r3", 1e-3, 1e-3),
    ("wells-1999-r4", 1e-4, 1e-4),
    ("wells-1999-r5", 1e-4, 1e-4),
    ("zaghloul-ali-2011", 1e-14, 1e-13),
    ("zaghloul-ali-2011-1e-8", 1e-7, 1e-7),
    ("zaghloul-ali-2011-1e-4", 1e-3, 1e-3),
    ("tran-ngo-hartmann-2013-cpf", 2e-6, 4e-6),
    ("abrarov-quine-2011", 2e-15, 1e-14),
    ("abrarov-quine-2016", 2e-15, 1e-14),
    ("karbach-raven-schiller-2014", 2e-15, 1e-14),
    ("karbach-raven-schiller-2014-fast", 1e-6, 1e-5),
    ("zaghloul-2017", 4e-5, 4e-5),
    ("schreier-2011-hum1wei24", 1e-9, 2e-8),
    ("schreier-2018-16", 1e-5, 1e-5),
    ("schreier-2018-16-1.31183", 1e-5, 1e-5),
    ("schreier-2018-20", 1e-6, 1e-6),
    ("schreier-2018-hum2zpf16", 1e-6, 1e-6),
];

#[test]
fn all_reach_what_their_papers_say() {
    let mut names: HashSet<&str> = all().iter().map(|a| a.name).collect();
    for (name, norm, re) in REACHED {
        let a = find(name).expect(name);
        let found = worst(&a, 0.1);
        assert!(found[0] <= norm && found[1] <= re, "{name}: {found:?}");
        names.remove(name);
    }
    names.remove("al-azah-chandler-wilde-2021");
    assert!(names.is_empty(), "{names:?}");
    let bounded = worst(&find("al-azah-chandler-wilde-2021").unwrap(), 0.0);
    assert!(bounded[0] < 3e-15, "{bounded:?}");
}

#[test]
fn the_lower_half_plane_is_reached_by_reflection() {
    for a in all().iter().filter(|a| a.plane == Plane::Whole) {
        let z = Complex::new(0.7, -0.9);
        let error = ((a.w)(z) - faddeeva(z)).norm();
        assert!(error < 1e-3, "{}: {error}", a.name);
        let left = ((a.w)(-z.conj()) - (a.w)(z).conj()).norm();
        assert!(left < 1e-13, "{}", a.name);
    }
}

#[test]
fn single_precision_is_of_single_precision() {
    for a in all() {
        let Some(single) = a.single else { continue };
        for z in ordinary(0.1) {
            let rounded = Complex32::new(z.re as f32, z.im as f32);
            let z = Complex::new(f64::from(rounded.re), f64::from(rounded.im));
            let (got, due) = (single(rounded), (a.w)(z));
            let got = Complex::new(f64::from(got.re), f64::from(got.im));
            let error = (got - due).norm() / due.norm();
            assert!(error < 2e-4, "{} at {z}: {error:e}", a.name);
        }
    }
}
