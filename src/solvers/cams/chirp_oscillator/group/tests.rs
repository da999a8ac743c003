//! Describes what a group says of its four times.

use super::super::harmonic::tests::prepared;
use super::*;
use crate::lanes::{Task, with_best};

struct Clear<'a>(&'a Groups<'a>, [f64; 4]);

impl Task for Clear<'_> {
    type Output = (bool, [f64; 4]);

    fn run<L: Lanes>(self, lanes: L) -> (bool, [f64; 4]) {
        let group = self.0.at(lanes, self.1);
        (group.clear, group.distances)
    }
}

/// Clear is a group where at each time the closed form serves, both resonances are far, and, where
/// passages are no constants, none is behind.
#[test]
fn when_a_group_is_clear() {
    let mut met = [0; 2];
    for (w, n, omega0, eps) in [
        (1.25, 0.75, -3.0, 0.125),
        (1.25, 0.75, 20.0, 0.125),
        (1.25, 0.75, 0.1, 0.0),
        (1.0, 1.5, -30.0, 0.5),
        (1.0, 1.5, 30.0, 0.5),
        (1.0, 0.01, -300.0, 20.0),
        (1.0, 0.01, 3.0, 1e-4),
        (1.0, 40.0, 0.1, 0.01),
    ] {
        let roots = Roots::new(w, n);
        let h = prepared(&roots, omega0, eps);
        let groups = Groups::new(&h, &roots);
        for k in 0..4000 {
            let t = f64::from(k) * 0.0172;
            let (clear, distances) = with_best(Clear(&groups, [t; 4]));
            let omega = h.sweep.omega(t);
            let p = [0, 1].map(|i| roots.p(i, omega));
            let norms = p.map(|p| p.norm_sqr());
            let far = distances[0] > FAR;
            let behind = !groups.folded && (0..2).any(|i| groups.has_passed(p[i].im, i));
            let due = h.is_closed(norms, t) && far && !behind;
            assert_eq!(clear, due, "{w} {n} {omega0} {eps} {t}");
            met[usize::from(clear)] += 1;
        }
    }
    assert!(met[0] > 3000 && met[1] > 3000, "{met:?}");
    // One of the four is enough to make it unclear.
    let roots = Roots::new(1.25, 0.75);
    let h = prepared(&roots, 20.0, 0.125);
    let groups = Groups::new(&h, &roots);
    assert!(with_best(Clear(&groups, [9.0; 4])).0);
    for i in 0..4 {
        let mut four = [9.0; 4];
        four[i] = 0.1;
        assert!(!with_best(Clear(&groups, four)).0, "{i}");
    }
}

/// On its edge a resonance is not behind.
#[test]
fn the_edge_of_a_resonance() {
    let roots = Roots::new(1.25, 0.75);
    let h = prepared(&roots, -3.0, 0.125);
    let groups = Groups::new(&h, &roots);
    for r in [0, 1] {
        assert!(!groups.has_passed(0.75, r) && groups.has_passed(0.75f64.next_up(), r));
    }
}
