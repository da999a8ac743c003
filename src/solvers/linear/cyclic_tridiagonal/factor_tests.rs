//! Describes what a cyclic sweep keeps of a matrix, and the row it stops at.

use super::*;

#[test]
fn sums_of_rows_and_columns() {
    let (lower, diagonal) = ([1.0, -2.0, 4.0, 8.0], [16.0, -32.0, 64.0, 128.0]);
    let upper = [0.5, 0.25, -0.125, 0.0625];
    let s = CyclicSweep::factor(&lower, &diagonal, &upper).unwrap();
    assert_eq!(s.row_sums, [17.5, 34.25, 68.125, 136.0625]);
    // Column i: upper of the row before, diagonal, lower of the row after. The last: −⅛, 128, 1.
    assert_eq!(s.norm_1, 129.125);
    assert_eq!(
        (s.lambda.len(), s.shape.phi.len(), s.pivot.len()),
        (2, 3, 4)
    );
    for (at, due) in [(0, 18.0625), (1, 36.5), (2, 72.25), (3, 129.125)] {
        let mut d = [0.0; 4];
        d[at] = 512.0;
        for (i, d) in d.iter_mut().enumerate() {
            *d += diagonal[i];
        }
        let s = CyclicSweep::factor(&lower, &d, &upper).unwrap();
        assert_eq!(
            s.norm_1,
            due - diagonal[at].abs() + (512.0 + diagonal[at]).abs()
        );
    }
}

/// Growth by hand: pivots 0.5 and −3, in row 1 (|fill| + |pivot| + |last column|) / sum.
#[test]
fn growth_in_the_middle_and_in_the_last_row() {
    let growth = |l0: f64, u2: f64, d2: f64| {
        CyclicSweep::factor(&[l0, 2.0, 1.0], &[0.5, 1.0, d2], &[1.0, 1.0, u2])
            .unwrap()
            .growth
    };
    // φ0 = −1, last column −2 + 1: (4 + 3 + 1)/4.
    assert_eq!(growth(0.5, 2.0, 4.0), 2.0);
    // φ0 = −4, φ1 = −7/3, last row 8 and −16 + 1: (1 + 32 + 35)/10.
    assert!((growth(2.0, 8.0, 1.0) - 6.8).abs() < 1e-14);
}

/// A multiplier that overflows is named by its row, whichever of the three it is.
#[test]
fn multipliers_that_overflow() {
    let row = |lower: [f64; 4], diagonal: [f64; 4], upper: [f64; 4]| match CyclicSweep::factor(
        &lower, &diagonal, &upper,
    ) {
        Err(Error::Pivot { row, .. }) => Some(row),
        Ok(_) => None,
        Err(other) => panic!("{other}"),
    };
    let d = [1e-10, 1.0, 1.0, 1.0];
    // The last column of row 0; its entry on the right; the first of the last row, times that.
    assert_eq!(row([1e300, 0.0, 0.0, 0.0], d, [0.0; 4]), Some(0));
    assert_eq!(row([0.0; 4], d, [1e300, 0.0, 0.0, 0.0]), Some(0));
    let left = [1e200, 0.0, 0.0, 1e200];
    assert_eq!(row([0.0; 4], [1.0; 4], left), Some(1));
    assert_eq!(row([0.0; 4], [1.0; 4], [1e100, 0.0, 0.0, 1e100]), None);
}

/// In the last row but one the entry on the right is part of the last column: where the two cancel
/// nothing overflows.
#[test]
fn an_entry_that_cancels() {
    let s = CyclicSweep::factor(&[-1.0, -1e300, 1.0], &[1.0, 1e-10, 1.0], &[0.0, 1e300, 1.0]);
    let s = s.unwrap();
    assert_eq!((s.shape.phi, s.lambda.len()), (vec![1.0, -0.0], 1));
}
