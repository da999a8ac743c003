//! Groups of points, lookups and ascending blocks, each for itself.

use super::super::lookup::{GROUP, Lookup, Plain};
use super::super::*;

fn spline(n: usize) -> UniformCubicSpline {
    let y: Vec<f64> = (0..n)
        .map(|i| ((i * i * 7 + 3) % 11) as f64 - 5.0)
        .collect();
    UniformCubicSpline::fit(-7.25, 0.125, y, Boundary::NATURAL).expect("a spline")
}

/// Points inside segments and at knots are evaluated as a group, with the bits of single points.
#[test]
fn groups_between_the_knots() {
    let s = spline(60);
    let group = |x: &[f64; GROUP]| s.grid.group(Plain, &s.y, &s.bend, x, None);
    for start in 0..50 {
        for off in [0.0, 0.25, 0.5, 0.999] {
            let x = std::array::from_fn(|j| s.grid.knot(start + j) + off * 0.125);
            let got = group(&x).expect("a group");
            for (x, got) in x.iter().zip(got) {
                assert_eq!(
                    s.value(*x).expect("a point").to_bits(),
                    got.to_bits(),
                    "{x}"
                );
            }
        }
    }
    // One before the first knot, at the last, behind it: the group is not taken.
    let (first, last) = s.grid.span();
    for out in [first.next_down(), first - 1.0, last, last + 1.0, f64::NAN] {
        for place in [0, 5] {
            let mut x = [first + 1.0; GROUP];
            x[place] = out;
            assert_eq!(group(&x), None, "{out}");
        }
    }
}

/// Every lookup of this processor finds the numbers, near each other or apart, up to the last.
#[test]
fn lookups_find_the_numbers() {
    let y: Vec<f64> = (0..40).map(f64::from).collect();
    let bend: Vec<f64> = y.iter().map(|y| 100.0 + y).collect();
    let mut sets: Vec<[u64; GROUP]> = vec![[38; GROUP], [0, 38, 3, 7, 20, 1, 30, 5]];
    for from in [0, 3, 20, 31] {
        sets.push(std::array::from_fn(|j| from + j as u64));
        for far in 1..8 {
            for j in 1..GROUP {
                let mut i = [from; GROUP];
                i[j] += far;
                sets.push(i);
            }
        }
    }
    for from in [0, 20] {
        for far in [8, 9, 10, 16] {
            let mut i = [from; GROUP];
            i[3] += far;
            sets.push(i);
        }
    }
    fn hold<L: Lookup>(lookup: L, y: &[f64], bend: &[f64], i: &[u64; GROUP]) {
        let found = lookup.ends(y, bend, i).expect("all in the table");
        for (j, &i) in i.iter().enumerate() {
            let i = i as f64;
            let due = [i, i + 1.0, i + 100.0, i + 101.0];
            assert_eq!(found.map(|lane| lane[j]), due);
        }
        // The last number of the table has no right neighbour.
        for beyond in [39, 40, u64::MAX] {
            let mut i = *i;
            i[6] = beyond;
            assert_eq!(lookup.ends(y, bend, &i), None);
        }
    }
    for i in &sets {
        hold(Plain, &y, &bend, i);
        #[cfg(all(target_arch = "x86_64", feature = "vectors"))]
        {
            use pulp::x86::{V3, V4};
            if let Some(v) = V3::try_new() {
                v.vectorize(|| hold(v, &y, &bend, i));
            }
            if let Some(v) = V4::try_new() {
                v.vectorize(|| hold(v, &y, &bend, i));
            }
        }
    }
}

/// Points out of order or outside are refused wherever in the blocks of 1024 they are.
#[test]
fn blocks_that_are_not_taken() {
    fn check<G: Grid>(s: &Spline<G>) {
        let refused = |x: &[f64]| match s.values_sorted(x, &mut vec![0.0; x.len()]) {
            Err(EvaluationError::NotSorted { index } | EvaluationError::Outside { index, .. }) => {
                Some(index)
            }
            Ok(()) => None,
            Err(other) => panic!("{other}"),
        };
        let (first, last) = s.grid().span();
        assert_eq!(refused(&[first, last]), None);
        assert_eq!(refused(&[first.next_down(), last]), Some(0));
        assert_eq!(refused(&[first, last.next_up()]), Some(1));
        assert_eq!(refused(&[last, first]), Some(1));
        let down: Vec<f64> = (0..7).map(|k| first + 0.25 * f64::from(7 - k)).collect();
        assert_eq!(refused(&down), Some(1));
        // The second block in itself ascends, but starts before the end of the first.
        let mut x = vec![first + 1.0; 1024];
        x.extend([first + 0.5, first + 0.75]);
        assert_eq!(refused(&x), Some(1024));
        let equal = vec![first + 1.0; 3000];
        assert_eq!(refused(&equal), None);
    }
    check(&spline(30));
    let x: Vec<f64> = (0..30).map(|k| 0.25 * f64::from(k) - 1.0).collect();
    let y: Vec<f64> = x.iter().map(|x| x * x).collect();
    check(&CubicSpline::fit(x, y, Boundary::NATURAL).expect("a spline"));
}

/// On all cores points are out of order at a seam of two parts, too.
#[cfg(feature = "parallel")]
#[test]
fn parts_of_all_cores() {
    let s = spline(30);
    let first = s.grid.span().0;
    let mut x = vec![first + 1.0; 140_000];
    let mut out = vec![0.0; x.len()];
    assert_eq!(s.par_values_sorted(&x, &mut out), Ok(()));
    x[..131_072].fill(first + 1.5);
    assert_eq!(
        s.par_values_sorted(&x, &mut out),
        Err(EvaluationError::NotSorted { index: 131_072 })
    );
}
