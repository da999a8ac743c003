//! Seams as text, named points.

use super::*;

#[test]
fn powers_of_two_are_named_where_decimals_are_long() {
    for (seam, text) in [
        (0.5, "0.5"),
        (512.0, "512"),
        (1024.0, "2^10"),
        (2f64.powi(-9), "0.001953125"),
        (2f64.powi(-10), "2^-10"),
        (2f64.powi(-60), "2^-60"),
        (3.75, "3.75"),
        (0.1 + 0.2, "0.3"),
        (1e-3, "0.001"),
        (0.999e-3, "9.99e-4"),
        (9_999_999.0, "9999999"),
        (1e7, "1e7"),
    ] {
        assert_eq!(listed(&[seam]), text);
    }
    assert_eq!(listed(&[3.0, 0.25]), "3, 0.25");
    assert_eq!(listed(&[]), "");
}

#[test]
fn named_points_end_with_the_first_zeros() {
    let zero = |k: usize| [k as f64, -1.0];
    for (count, due) in [(0, 1), (3, 4), (5, 6), (14, 6)] {
        let all = named_points(&[("one", 1.0, 2.0)], zero, count);
        assert_eq!(all.len(), due, "{count}");
        assert_eq!((all[0].name, &all[0].input[..]), ("one", &[1.0, 2.0][..]));
    }
    let all = named_points(&[], zero, 2);
    assert_eq!(
        (all[1].name, &all[1].input[..]),
        ("zero-2", &[2.0, -1.0][..])
    );
}

/// Recorded cases are found again: both parts have the bits of a cosine and a sine by themselves.
#[test]
fn points_in_a_direction_are_pinned() {
    let mut draw = Draw::new(1, "faddeeva", "directions", 0);
    let ends = [0.0, -0.0, PI, -PI, PI / 4.0, PI / 2.0, 1.0f64.next_down()];
    let small = (-30..-20).flat_map(|k| [1.0, 1.3, 1.7].map(|m| m * 2f64.powi(k)));
    let angles: Vec<f64> = ends.into_iter().chain(small).collect();
    let drawn = (0..20_000).map(|_| whole(&mut draw));
    for theta in angles.into_iter().chain(drawn) {
        let due = [3.0 * libm::cos(theta), 3.0 * libm::sin(theta)];
        let found = polar(3.0, theta);
        assert!(
            found
                .iter()
                .zip(due)
                .all(|(a, b)| a.to_bits() == b.to_bits()),
            "{theta}"
        );
    }
}
