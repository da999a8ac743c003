//! Laws judge values changed one by one, and apply up to their limits.

use super::*;

/// The sine of the transmission angle is 1/2 to the last bit at the second offset.
#[test]
fn rates_are_compared_above_thirty_degrees() {
    let law = |e: f64| velocity(&[1.0, 1.0625, e, 0.0, 0.0, 1.0]);
    assert!(law(0.920_151_991_520_965).is_some_and(|r| r < 1.0));
    assert_eq!(law(0.920_151_991_520_966), None);
    assert_eq!(law(0.920_151_991_520_967), None);
}

/// Crank and rod in line: lengths of 9.9 and 10.1 for a rod of 1.
#[test]
fn rates_are_compared_for_rods_that_are_not_too_short() {
    let law = |a: f64| velocity(&[a, 1.0, 0.0, 0.0, 0.0, 1.0]);
    assert!(law(8.9).is_some_and(|r| r < 1.0));
    assert_eq!([law(9.0), law(9.1)], [None, None]);
    // The offset counts as a length, whatever its sign.
    for e in [0.25, -0.25] {
        let law = velocity(&[8.9, 1.0, e, 0.0, 0.0, 1.0]);
        assert_eq!(law, None, "{e}");
    }
}

#[test]
fn one_value_that_is_not_mirrored_breaks_the_law() {
    let here = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
    let there = [1.0, -2.0, 3.0, -4.0, 5.0, -6.0, 7.0];
    for assembly in [1.0, -1.0] {
        assert!(mirrored(&here, &there, assembly));
        for k in 0..7 {
            let mut off = there;
            off[k] = -off[k];
            let due = k == 3 && assembly < 0.0;
            assert_eq!(mirrored(&here, &off, assembly), due, "{k} {assembly}");
        }
    }
}

#[test]
fn one_value_in_other_units_breaks_the_law() {
    let here = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
    let there = [128.0, 256.0, 384.0, 4.0, 5.0, 6.0, 7.0];
    assert!(scaled(&here, &there));
    for k in 0..7 {
        let mut off = there;
        off[k] *= 2.0;
        assert!(!scaled(&here, &off), "{k}");
    }
}
