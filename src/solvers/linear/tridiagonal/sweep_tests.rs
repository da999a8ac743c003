//! Describes what the sweep keeps of a matrix, number by number.

use super::*;

const LOWER: [f64; 3] = [1.0, -2.0, 4.0];
const DIAGONAL: [f64; 4] = [8.0, -16.0, 32.0, 64.0];
const UPPER: [f64; 3] = [0.5, 0.25, -0.125];

#[test]
fn sums_and_factors() {
    let s = Sweep::factor(&LOWER, &DIAGONAL, &UPPER).unwrap();
    assert_eq!(s.row_sums, [8.5, 17.25, 34.125, 68.0]);
    assert_eq!(s.norm_1, 64.125);
    assert_eq!((s.pivot.len(), s.lambda.len()), (4, 3));
    // With the largest column first, in the middle, and made by the entry below or above.
    for (lower, diagonal, upper, due) in [
        ([7.0, 1.0], [2.0, 3.0, 4.0], [1.0, 2.0], 9.0),
        ([1.0, 7.0], [2.0, 3.0, 4.0], [1.0, 2.0], 11.0),
        ([1.0, 2.0], [2.0, 3.0, 4.0], [7.0, 2.0], 12.0),
        ([1.0, 1.0], [2.0, 3.0, 4.0], [1.0, 7.0], 11.0),
    ] {
        assert_eq!(
            Sweep::factor(&lower, &diagonal, &upper).unwrap().norm_1,
            due
        );
    }
}

/// Both neighbours count, in rows and in columns.
#[test]
fn dominance_by_rows_and_by_columns() {
    let dominant = |lower: [f64; 2], upper: [f64; 2]| {
        Sweep::factor(&lower, &[4.0; 3], &upper)
            .unwrap()
            .is_dominant()
    };
    // Sums of rows 4, 4, 4, then of columns.
    assert!(dominant([1.0, 4.0], [-4.0, 3.0]) && dominant([3.0, 4.0], [-4.0, 1.0]));
    assert!(dominant([4.0, 3.0], [-1.0, 4.0]) && dominant([4.0, 1.0], [-3.0, 4.0]));
    // By neither, though the differences are small.
    assert!(!dominant([3.0, 3.0], [3.0, 3.0]) && !dominant([-3.0, 3.0], [-3.0, 3.0]));
    assert!(!dominant([3.0, -3.0], [-3.0, 3.0]));
}

/// `Aᵀ x = b` with integers, without rounding.
#[test]
fn the_transposed_matrix() {
    let s = Sweep::factor(&[2.0, 1.0], &[2.0, 4.0, 2.0], &[2.0, 2.0]).unwrap();
    // Pivots 2, 4 − 2, 2 − 1.
    assert_eq!(s.pivot, [2.0, 2.0, 1.0]);
    // x = (1, 2, 3): (2 + 2·2, 2 + 4·2 + 3, 2·2 + 2·3).
    let mut x = [6.0, 13.0, 10.0];
    Open::run_transposed(&s, &mut x);
    assert_eq!(x, [1.0, 2.0, 3.0]);
    // (2 + 2·2, 2 + 4·2 + 2·3, 2 + 2·3)
    let mut x = [6.0, 16.0, 8.0];
    Open::run(&s, &mut x);
    assert_eq!(x, [1.0, 2.0, 3.0]);
}
