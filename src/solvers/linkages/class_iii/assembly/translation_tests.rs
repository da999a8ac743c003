//! Links that move in parallel: one of the two linear equations for joint C vanishes.

use super::super::{Geometry, loops};
use super::*;

/// The linkage turned about O1.
fn turned(mut v: [f64; 11], turn: f64) -> ClassIii {
    for k in [7, 9] {
        let z = Complex64::new(v[k], v[k + 1]) * unit(turn);
        (v[k], v[k + 1]) = (z.re, z.im);
    }
    ClassIii::new(Geometry::from_values(&v)).expect("a linkage")
}

/// Turned by anything, the linkage has the same modes, `n` of them, `parallel` with φ4 = `theta`.
fn hold(v: [f64; 11], phi1: f64, n: usize, (theta, parallel): (f64, usize)) {
    let due = turned(v, 0.0).assembly_modes(Angle::from_rad(phi1)).modes;
    assert_eq!(due.len(), n, "{v:?}");
    for k in 0..100 {
        let turn = 0.0628 * f64::from(k);
        let linkage = turned(v, turn);
        let e1 = unit(phi1 + turn);
        let modes = linkage.assembly_modes(Angle::from_rad(phi1 + turn)).modes;
        assert_eq!(modes.len(), n, "{v:?} {turn}");
        let near = |m: &&Positions| wrap(m.phi4 - theta - turn).abs() < 1e-6;
        assert_eq!(modes.iter().filter(near).count(), parallel, "{v:?} {turn}");
        for (i, m) in modes.iter().enumerate() {
            let f = loops::Frame::new(&linkage.l, m);
            let (a, b) = linkage.residual(e1, &f);
            assert!(
                a.norm().max(b.norm()) < 1e-15 * v[1].max(10.0),
                "{v:?} {turn}"
            );
            let back = m.plus([-turn; 4]);
            assert!(due.iter().any(|d| d.distance(back) < 1e-7), "{v:?} {turn}");
            assert!(modes[..i].iter().all(|o| o.distance(*m) > 1e-3));
        }
    }
}

const PARALLELOGRAM: [f64; 11] = [1.0, 5.6, 2.0, 2.0, 2.0, 1.0, -0.7, 5.0, 3.0, 7.0, 3.0];

/// l3 = l5 and l4 = |O3 O5|, also but for rounding or a little more: p vanishes or nearly so.
#[test]
fn rockers_in_parallel() {
    for gap in [0.0, 1e-15, -1e-15, 1e-13, 1e-10, 9e-8, -9e-8, 1e-6] {
        let mut v = PARALLELOGRAM;
        v[3] *= 1.0 + gap;
        hold(v, 0.17, 4, (0.0, 2));
        // Rockers much longer than the links between them.
        (v[1], v[2], v[4]) = (1e3, 1e3, 1e3);
        hold(v, 0.17, 4, (0.0, 2));
    }
}

/// l2 = l3 and lB = |O3 A|: q vanishes.
#[test]
fn link_2_and_rocker_in_parallel() {
    let phi1 = 0.3;
    let q0 = Complex64::new(5.0, 3.0) - unit(phi1);
    for gap in [0.0, 1e-13, -1e-9] {
        for l5 in [4.0, 4.5] {
            let lb = q0.norm() * (1.0 + gap);
            let v = [1.0, 3.0, 3.0, 4.0, l5, lb, 0.7, 5.0, 3.0, 8.0, 4.0];
            hold(v, phi1, 4, ((-q0).arg() - 0.7, 2));
        }
    }
}

/// `p` and `q` parallel at the angle `phi4` of a linkage built about it, with the lengths `p` and
/// `q` (negative: opposed): joint C may lie on either side of them.
fn mirrored(phi1: f64, phi4: f64, p: f64, q: f64) -> (ClassIii, [Complex64; 2]) {
    let (o3, way) = (Complex64::new(2.0, 1.5), unit(0.4));
    let o5 = o3 + unit(phi4) * 2.2 - way * p;
    let b = way * q - o3 + unit(phi1);
    let u = way * Complex64::new(0.3, 1.7);
    let (l5, l2) = ((u + way * p).norm(), (u + way * q).norm());
    let (l3, lb, phi_b) = (u.norm(), b.norm(), b.arg() - phi4);
    let v = [1.0, l2, l3, 2.2, l5, lb, phi_b, o3.re, o3.im, o5.re, o5.im];
    let linkage = ClassIii::new(Geometry::from_values(&v)).expect("a linkage");
    (linkage, [u, way * Complex64::new(0.3, -1.7)])
}

/// Two modes with one φ4: T touches zero without changing its sign.
#[test]
fn modes_mirrored_in_parallel_lines() {
    for k in 0..60 {
        let (phi1, phi4) = (0.1 * f64::from(k), 0.37 * f64::from(k));
        for (p, q) in [
            (1.0, 2.0),
            (1.3, -0.8),
            (-0.7, 1.1),
            (1.2, 1e-4),
            (1e-6, 1.1),
        ] {
            let (linkage, pair) = mirrored(phi1, phi4, p, q);
            // Also where the two have parted by less than the noise of T shows, or more.
            for off in [0.0, 1e-12, -1e-9, 1e-8, -1e-7, 1e-6] {
                let modes = linkage.assembly_modes(Angle::from_rad(phi1 + off)).modes;
                for u in pair {
                    let near = |m: &&Positions| {
                        wrap(m.phi4 - phi4).abs() < 1e-3 && wrap(m.phi3 - u.arg()).abs() < 1e-3
                    };
                    assert_eq!(modes.iter().filter(near).count(), 1, "{k} {p} {q} {off}");
                }
            }
        }
    }
}

/// The angle at which the equation vanishes, and the equation that is left.
#[test]
fn vanishing_equations() {
    for (gap, due) in [
        (0.0, 1),
        (0.9e-7, 1),
        (-0.9e-7, 1),
        (1.1e-7, 0),
        (-1.1e-7, 0),
    ] {
        for size in [0.01, 1.0, 100.0] {
            let mut v = PARALLELOGRAM;
            v[3] *= 1.0 + gap;
            for k in [0, 1, 2, 3, 4, 5, 7, 8, 9, 10] {
                v[k] *= size;
            }
            let linkage = turned(v, 1.0);
            let r = Resultant::new(&linkage.l, unit(1.2));
            let found = r.translations();
            assert_eq!(found.len(), due, "{gap} {size}");
            for (theta, line) in found {
                assert!((theta - 1.0).abs() < 1e-15);
                assert_eq!(line.normal, r.value(theta).lines[1].normal);
            }
        }
    }
    let q0 = Complex64::new(5.0, 3.0) - unit(0.3);
    for (gap, due) in [(0.0, 1), (0.9e-7, 1), (1.1e-7, 0)] {
        let lb = q0.norm() * (1.0 + gap);
        let v = [1.0, 3.0, 3.0, 4.0, 4.5, lb, 0.7, 5.0, 3.0, 8.0, 4.0];
        let linkage = turned(v, 0.0);
        let r = Resultant::new(&linkage.l, unit(0.3));
        let found = r.translations();
        assert_eq!(found.len(), due, "{gap}");
        for (theta, line) in found {
            assert!(wrap(theta - (-q0).arg() + 0.7).abs() < 1e-15);
            assert_eq!(line.normal, r.value(theta).lines[0].normal);
        }
    }
}

/// The points of a line on a circle: two, or twice the nearest.
#[test]
fn lines_and_circles() {
    let line = |c: f64| Line {
        normal: Complex64::new(3.0, 4.0),
        c,
        terms: 1.0,
    };
    // 2 Re(u n̄) = 2 · 15: at 3 from 0 along (3, 4)/5, and 4 to either side.
    let due = [Complex64::new(-1.4, 4.8), Complex64::new(5.0, 0.0)];
    for (got, due) in line(30.0).on_circle(5.0).iter().zip(due) {
        assert!((got - due).norm() < 1e-15, "{got}");
    }
    let nearest = Complex64::new(3.6, 4.8);
    assert!(
        line(60.0)
            .on_circle(5.0)
            .iter()
            .all(|u| (u - nearest).norm() < 1e-15)
    );
}

/// The distance of a line is the better known, the smaller its terms and the longer its normal.
#[test]
fn doubts_about_lines() {
    let doubt = |x: f64, y: f64, terms: f64| {
        let normal = Complex64::new(x, y);
        Line {
            normal,
            c: 0.0,
            terms,
        }
        .doubt()
    };
    assert_eq!(doubt(3.0, 4.0, 10.0), 2.0);
    assert_eq!(doubt(0.0, 0.0, 10.0), f64::INFINITY);
    // Parallel lines in an assembly: q is longer, but its terms are larger still.
    let v = [1.0, 50.0, 2.0, 3.0, 2.5, 4.0, 0.0, 4.0, 0.0, 6.0, 0.0];
    let linkage = turned(v, 0.0);
    let r = Resultant::new(&linkage.l, unit(0.0));
    let [p, q] = r.value(0.0).lines;
    assert!(p.normal.norm() < q.normal.norm() && p.doubt() < q.doubt());
    assert_eq!(r.candidates(0.0), p.on_circle(2.0));
}

/// Which of the two ways to joint C is taken.
#[test]
fn candidates_by_what_is_known() {
    let linkage = turned(PARALLELOGRAM, 1.0);
    let r = Resultant::new(&linkage.l, unit(1.17));
    // On both lines while they meet at an angle, two on one of them next to where p vanishes.
    assert_eq!(r.candidates(0.3), [r.value(0.3).u]);
    for off in [0.0, 1e-12, 1e-9] {
        let at = 1.0 + off;
        let q = r.value(at).lines[1];
        assert_eq!(r.candidates(at), q.on_circle(2.0), "{off}");
    }
}
