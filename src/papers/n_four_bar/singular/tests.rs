use super::super::data::{self, gravity, inertia, weight};
use super::*;
use crate::reference::Ball;
use crate::reference::planar::{
    Attachment, Body, Drive, Forces, Joint, Linkage, Mechanism, MechanismError,
};
use std::collections::BTreeSet;

#[test]
fn ranks_fall_by_n_on_one_line_only() {
    for n in [1usize, 2, 3, 10] {
        assert_eq!(jacobian_rank(&parallelogram(n)), 2 * n);
        for right in 0..=n + 1 {
            let due = Meeting {
                rank: n,
                curves: n + 1,
                tangents: n + 1,
                admissible: true,
            };
            assert_eq!(meeting(n, right), due, "{n} {right}");
        }
    }
}

/// On every circle all windows are closed, and a rank is missing for every window whose cranks both
/// lie on the ground.
#[test]
fn circles_keep_to_the_loops() {
    for n in 1..=4usize {
        for l in 0..=n {
            for r in l..=n {
                let at = on_circle(n, l, r);
                for k in 0..n {
                    let [a, b, c] = [&at.cranks[k], &at.cranks[k + 1], &at.rods[k]];
                    assert!(
                        Rational::from(&a[0] + &c[0]) == Rational::from(&b[0] + 1u32),
                        "{n} {l} {r}"
                    );
                    assert!(Rational::from(&a[1] + &c[1]) == b[1], "{n} {l} {r}");
                }
                let lost = l.saturating_sub(1) + (n - r).saturating_sub(1);
                assert_eq!(jacobian_rank(&at), 2 * n - lost, "{n} {l} {r}");
            }
        }
    }
}

/// Every position of a window is one of three; words over them give the circles that the text
/// counts.
#[test]
fn the_circles_are_all_that_there_is() {
    // A crank's angle on a component: fixed to the right or to the left, or free as one of a group.
    for n in 1..=5usize {
        let mut circles = BTreeSet::new();
        for word in 0..3usize.pow(n as u32) {
            let letter = |k: usize| word / 3usize.pow(k as u32) % 3;
            // Groups of cranks that turn alike, cut at folded windows.
            let mut fixed = vec![None; n + 1];
            let mut possible = true;
            let mut group = vec![0usize; n + 1];
            for k in 0..n {
                group[k + 1] = group[k] + usize::from(letter(k) != 0);
            }
            for k in 0..n {
                let (crank, sign) = match letter(k) {
                    0 => continue,
                    1 => (k, 1),
                    _ => (k + 1, -1),
                };
                for j in (0..=n).filter(|&j| group[j] == group[crank]) {
                    possible &= fixed[j].is_none_or(|s| s == sign);
                    fixed[j] = Some(sign);
                }
            }
            if possible {
                let free: BTreeSet<usize> = (0..=n)
                    .filter(|&j| fixed[j].is_none())
                    .map(|j| group[j])
                    .collect();
                assert_eq!(free.len(), 1, "one degree of freedom");
                circles.insert(fixed);
            }
        }
        assert_eq!(circles.len(), (n + 1) * (n + 2) / 2);
        for c in &circles {
            let free: Vec<usize> = (0..=n).filter(|&k| c[k].is_none()).collect();
            let (l, r) = (free[0], free[free.len() - 1]);
            assert_eq!(free.len(), r - l + 1);
            assert!((0..l).all(|k| c[k] == Some(1)) && (r + 1..=n).all(|k| c[k] == Some(-1)));
        }
    }
}

/// Rates in the kernel that break the second order are no tangents: two cranks at rates 1 and 2.
#[test]
fn the_kernel_is_wider_than_the_tangents() {
    let at = on_one_line(1, 2);
    let rates = |u: i32, v: i32| [u, v, v - u].map(Rational::from);
    assert!(admissible(&at, &rates(1, 1)) && admissible(&at, &rates(0, 1)));
    for (u, v) in [(1, 2), (1, 0), (1, -1)] {
        assert!(!admissible(&at, &rates(u, v)), "{u} {v}");
    }
    assert!(!admissible(&at, &[1, 1, 1].map(Rational::from)));
}

/// Two windows by hand: 27/22 for the outer cranks, 12/11 for the middle one, 7/6 on the branch;
/// one window: 6/5 both ways.
#[test]
fn accelerations_without_a_branch_are_others() {
    let q = |n: i32, d: i32| Rational::from((n, d));
    assert_eq!(
        accelerations_without_branch(2).unwrap(),
        [q(27, 22), q(12, 11), q(27, 22)]
    );
    assert_eq!(accelerations_without_branch(1).unwrap(), [q(6, 5), q(6, 5)]);
    assert_eq!([data::fall(1), data::fall(2)], [q(6, 5), q(7, 6)]);
}

/// The limits of `sin θ F/(m g)` along the rods (ledger, nb-poles).
fn poles(n: u32) -> Vec<Rational> {
    let pole = |k: u32| Rational::from((2 * k as i32 + 1 - n as i32, 4 * (4 * n + 1)));
    (0..n).map(pole).collect()
}

/// The reference for any planar mechanism, 10⁻⁶ before the horizontal position: its multipliers are
/// the forces at the pins that close the loops, and `sin θ F` tends to the poles.
#[test]
fn forces_grow_as_the_poles_say() {
    for n in [1u32, 2, 3] {
        let k = n as usize;
        let mechanism = mechanism(k).unwrap();
        let linkage = Linkage::new(&mechanism, &Drive::coordinate(0), 192).unwrap();
        let theta = Ball::exact(192, 1e-6);
        let mut guess = vec![theta.mid().clone(); k + 1];
        guess.resize(2 * k + 1, rug::Float::new(64));
        let position = linkage.position(&theta, &guess).unwrap();
        let series = linkage.series(&position, 2).unwrap();
        let [force, _] = linkage.reduced_force(&series, &forces());
        let acceleration = force / Ball::rational(192, &data::inertia(n));
        let speed = Ball::integer(192, -3);
        let rates = linkage.in_time(&position, &speed, &acceleration).unwrap();
        let found = linkage.multipliers(&position, &rates, &forces()).unwrap();
        let scale = theta.sin_cos().0 / Ball::rational(192, &gravity());
        let found: Vec<f64> = found.iter().map(|f| (f * &scale).to_f64()).collect();
        for pole in poles(n) {
            let due = pole.to_f64();
            let near = |f: &f64| (f.abs() - due.abs()).abs() < 1e-4;
            assert!(found.iter().any(near), "{n}: {due} in {found:?}");
        }
        let largest = found.iter().fold(0.0f64, |m, f| m.max(f.abs()));
        let due = poles(n).iter().fold(0.0f64, |m, p| m.max(p.to_f64().abs()));
        assert!(largest < due + 1e-4, "{n}: {largest} {due}");
    }
}

/// Bars of other lengths, as far as the loops are told: a u + c w = b v and a u² + c w² = b v².
#[test]
fn both_orders_are_looked_at() {
    let direction = |x: i32| [Rational::from(x), Rational::new()];
    let at = Directions {
        cranks: vec![direction(1), direction(2)],
        rods: vec![direction(1)],
    };
    let rates = |of: [i32; 3]| of.map(Rational::from);
    assert!(admissible(&at, &rates([1, 1, 1])));
    assert!(admissible(&at, &rates([2, 2, 2])));
    // To the first order alone, and to the second alone.
    assert!(!admissible(&at, &rates([2, 1, 0])));
    assert!(!admissible(&at, &rates([1, -1, 1])));
}

/// Cranks to the right, then to the left; the rod between two that differ points left. On the
/// parallelograms all cranks turn.
#[test]
fn bars_point_as_they_are_said_to() {
    let signs = |all: &[Direction]| -> Vec<Rational> {
        assert!(all.iter().all(|d| d[1] == 0));
        all.iter().map(|d| d[0].clone()).collect()
    };
    let at = on_one_line(3, 2);
    assert_eq!(signs(&at.cranks), [1, 1, -1, -1]);
    assert_eq!(signs(&at.rods), [1, -1, 1]);
    let at = parallelogram(2);
    let turned = [Rational::from((3, 5)), Rational::from((4, 5))];
    assert_eq!(at.cranks, vec![turned; 3]);
    assert_eq!(signs(&at.rods), [1, 1]);
}

#[test]
fn ranks_are_exact() {
    fn matrix<const C: usize>(rows: &[[i32; C]]) -> Matrix {
        let row = |r: &[i32; C]| r.iter().map(|x| Rational::from(*x)).collect();
        rows.iter().map(row).collect()
    }
    assert_eq!(rank(matrix(&[[1, 2, 3], [2, 4, 6], [0, 0, 5]])), 2);
    assert_eq!(rank(matrix(&[[0, 0], [0, 0]])), 0);
    assert_eq!(rank(matrix(&[[0, 1], [3, 0], [3, 1]])), 2);
    let tall = [[1, 2, 3], [4, 5, 6], [7, 8, 9], [1, 1, 1]];
    assert_eq!(rank(matrix(&tall)), 2);
    assert_eq!(rank(matrix(&[[0, 0, 1], [0, 2, 1], [3, 1, 1]])), 3);
    assert_eq!(rank(Vec::new()), 0);
}

/// Cranks 0 to N by index, then rods 0 to N − 1; angles from x.
///
/// # Errors
/// None for these data.
fn mechanism(n: usize) -> Result<Mechanism, MechanismError> {
    let x = |x: usize| [Rational::from(x as u32), Rational::new()];
    let bar = |name: String| Body {
        name,
        mass: Rational::from(1),
        inertia: Rational::from((1, 12)),
        centre: [Rational::from((1, 2)), Rational::new()],
    };
    let cranks = (0..=n).map(|k| bar(format!("crank {k}")));
    let bodies = cranks.chain((0..n).map(|k| bar(format!("rod {k}"))));
    let pin = |a, b| Joint::Pin { a, b };
    let mut joints = Vec::new();
    for k in 0..=n {
        let (start, end) = (Attachment::body(k, x(0)), Attachment::body(k, x(1)));
        joints.push(pin(Attachment::ground(x(k)), start));
        if k < n {
            joints.push(pin(end.clone(), Attachment::body(n + 1 + k, x(0))));
        }
        if k > 0 {
            joints.push(pin(end, Attachment::body(n + k, x(1))));
        }
    }
    Mechanism::new(bodies.collect(), joints)
}

/// Weights alone.
fn forces() -> Forces {
    Forces {
        drive: Rational::new(),
        springs: Vec::new(),
        gravity: [Rational::new(), -gravity()],
    }
}

/// The reference for any planar mechanism finds the same inertia and force on the parallelogram
/// branch.
#[test]
fn inertia_and_weight_are_those_of_the_bars() {
    for n in [1usize, 2, 4] {
        let linkage = Linkage::new(&mechanism(n).unwrap(), &Drive::coordinate(0), 128).unwrap();
        // The angle from x whose sine and cosine are about 3/5 and 4/5.
        let theta = Ball::exact(128, 0.643_501_1);
        let mut guess = vec![theta.mid().clone(); n + 1];
        guess.resize(2 * n + 1, rug::Float::new(64));
        let position = linkage.position(&theta, &guess).unwrap();
        let series = linkage.series(&position, 2).unwrap();
        let i = linkage.reduced_inertia(&series);
        assert!(i[0].contains(&inertia(n as u32)) && i[1].contains(&Rational::new()));
        let [force, _] = linkage.reduced_force(&series, &forces());
        let due = Ball::rational(128, &(weight(n as u32) * gravity())) * theta.sin_cos().1;
        assert!((force + due).contains_zero());
    }
}
