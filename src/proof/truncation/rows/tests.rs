use super::*;
use crate::tables::{cell_at, disc_at, imaginary_axis_at, real_axis_at};
use mechaudit_solvers::faddeeva::proof::real_line::{OfRows, row as row_of};

fn errors(parts: Vec<[f64; 2]>, centre: (f64, f64)) -> RowErrors {
    RowErrors { centre, parts }
}

fn near(x: f64, due: f64) -> bool {
    x >= due * (1.0 - 1e-14) && x <= due * (1.0 + 1e-12)
}

/// `Σ |e_n| Dⁿ`, of a component about a centre on an axis what its symmetry leaves, and the tail.
#[test]
fn errors_of_coefficients_add_up() {
    let parts: Vec<[f64; 2]> = (0..41)
        .map(|n| [1e-9 * f64::from(n + 1), 3e-9 / f64::from(n + 1)])
        .collect();
    for (dx, dy) in [(0.1, 0.05), (0.0, 0.12), (0.12, 0.0), (0.6, 0.79)] {
        let d = f64::hypot(dx, dy);
        let power = |n: usize| d.powi(n as i32);
        let slope = |n: usize| if n == 0 { 0.0 } else { n as f64 * power(n - 1) };
        let size = |e: &[f64; 2]| e[0].hypot(e[1]);
        let sum = |f: &dyn Fn(usize, &[f64; 2]) -> f64| {
            let all = parts.iter().enumerate().map(|(n, e)| f(n, e));
            all.sum::<f64>() + 100.0 * MOST[0] * (d / RADIUS).powi(40)
        };
        let norm = sum(&|n, e| size(e) * power(n));
        let re = sum(&|n, e| e[0] * power(n) + dy * e[1] * slope(n));
        let im = sum(&|n, e| size(e) * slope(n));
        let within = |centre| errors(parts.clone(), centre).within(dx, dy);
        let inside = within((1.0, 2.0));
        assert!(near(inside.norm, norm) && inside.re == inside.norm && inside.im == inside.norm);
        let real = within((1.0, 0.0));
        assert!(
            near(real.norm, norm) && near(real.re, re) && real.im == real.norm,
            "{real:?} {re}"
        );
        let imaginary = within((0.0, 2.0));
        assert!(
            near(imaginary.norm, norm) && near(imaginary.im, im) && imaginary.re == imaginary.norm
        );
    }
    let far = errors(parts, (1.0, 1.0)).within(0.8, 0.7);
    assert!([far.norm, far.re, far.im].iter().all(|x| x.is_infinite()));
    // Above what |w| may be on the circle, and the sum of the tail.
    for (most, least) in MOST.into_iter().zip([9.0, 16.0]) {
        assert!(most >= 2.0 * f64::exp(least) && most < 2.01 * f64::exp(least));
    }
    for (y, most) in [(0.5, MOST[0]), (0.0, MOST[0]), (-0.5, MOST[1])] {
        let none = errors(vec![[0.0; 2]; TERMS], (0.5, y));
        assert_eq!(none.within(1.0, 0.0).norm, tail(1.0, most));
    }
    let row = disc_at(0.5, 0.5).1;
    assert!(RowErrors::of(row, (0.5, (-1f64).next_down())).is_err());
    for q in [0.1, 1.0 / 3.0] {
        let tail: f64 = (41..400).map(|n| f64::from(n) * f64::powi(q, n - 1)).sum();
        assert!(tail <= 100.0 * q.powi(40) && 41.0 / (1.0 - q).powi(2) <= 100.0);
    }
}

/// Every entry of a row is compared with its coefficient: a change of one shows in the error of
/// that one alone.
#[test]
fn each_entry_stands_for_its_coefficient() {
    let centre = (1.5, 1.75);
    let row = *cell_at(1.5, 1.75).1;
    let sound = RowErrors::of(&row, centre).expect("decided");
    assert_eq!((sound.parts.len(), sound.centre), (TERMS, centre));
    for (n, e) in sound.parts.iter().enumerate().take(STORED) {
        let least = if n < 2 { 1e-30 } else { 3e-17 };
        assert!(e[0].max(e[1]) < least, "{n} {e:?}");
    }
    assert!(
        sound.parts[STORED..]
            .iter()
            .all(|e| e[0] > 0.0 && e[1] > 0.0)
    );
    let by = 1e-3;
    for n in 0..STORED {
        for part in 0..2 {
            let places = match n {
                0 => vec![2 * part, 2 * part + 1],
                1 => vec![4 + 2 * part, 5 + 2 * part],
                _ => vec![8 + 8 * ((n - 2) / 4) + 4 * part + (n - 2) % 4],
            };
            for at in places {
                let mut row = row;
                row[at] += by;
                let found = RowErrors::of(&row, centre).expect("decided");
                for (m, (p, q)) in found.parts.iter().zip(&sound.parts).enumerate() {
                    for i in 0..2 {
                        let due = if (m, i) == (n, part) { by } else { 0.0 };
                        assert!((p[i] - q[i] - due).abs() < 1e-12, "{n} {part} {at} {m}");
                    }
                }
            }
        }
    }
}

/// Rows of one component: that of erfcx is iⁿ c_n, that of Dawson's function the imaginary part,
/// and that of erf has the derivative's.
#[test]
fn rows_of_one_component() {
    type Of = fn(&[f64], f64) -> Result<RowErrors, ProofError>;
    let (s, erfcx) = imaginary_axis_at(1.3);
    let (dawson, from_t) = row_of(OfRows::Dawson, 0.74);
    let (erf, from_u) = row_of(OfRows::Erf, 0.74);
    let [t, u] = [from_t, from_u].map(|by| 0.74 - by);
    for (of, row, at, centre) in [
        (RowErrors::on_axis as Of, &erfcx[..], s, (0.0, s)),
        (RowErrors::of_dawson, dawson, t, (t, 0.0)),
        (RowErrors::of_erf, erf, u, (u, 0.0)),
    ] {
        let stored = row.len() - 2;
        let found = of(row, at).expect("decided");
        assert_eq!(found.centre, centre);
        for (n, e) in found.parts.iter().enumerate().take(stored) {
            assert!(
                e[0] < if n < 2 { 1e-30 } else { 3e-16 } && e[1] == 0.0,
                "{n} {e:?}"
            );
        }
        assert!(
            found.parts[stored..]
                .iter()
                .all(|e| e[0] > 0.0 && e[1] == 0.0)
        );
        for n in 0..stored {
            let place = if n < 2 { 2 * n } else { n + 2 };
            for k in if n < 2 {
                vec![place, place + 1]
            } else {
                vec![place]
            } {
                let mut row = row.to_vec();
                row[k] += 1e-3;
                let faulty = of(&row, at).expect("decided");
                assert!((faulty.parts[n][0] - 1e-3).abs() < 1e-9, "{n} {k}");
            }
        }
    }
}

#[test]
fn components_that_are_zero_by_symmetry() {
    let centre = cell_at(0.0, 1.75).0;
    assert_eq!(centre.0, 0.0);
    let row = *cell_at(0.0, 1.75).1;
    let sound = RowErrors::of(&row, centre).expect("decided");
    assert!(sound.is_symmetric());
    let axis = real_axis_at(4.0);
    assert!(
        !RowErrors::of(axis.1, (axis.0, 0.0))
            .expect("decided")
            .is_symmetric()
    );
    for (n, part) in [(0, 1), (1, 0), (4, 1), (7, 0)] {
        let mut other = sound.clone();
        other.parts[n][part] = 1e-300;
        assert!(!other.is_symmetric(), "{n}");
        let mut other = sound.clone();
        other.parts[n][1 - part] = 1e-3;
        assert!(other.is_symmetric());
    }
    let off = errors(vec![[1.0, 0.0]], (0.5, 1.0));
    assert!(!off.is_symmetric());
}
