//! Dyads and the linkages made of them: what the certified lines do not hold.

use crate::dyad::{
    Assembly, CrankRange, DyadError, FourBar, Guide, LinkMotion, PointMotion, RrpDyad, RrrDyad,
    SliderCrank,
};
use crate::units::{Angle, AngularVelocity, Length};

fn bar(l: [f64; 4]) -> FourBar {
    let [a, b, c, d] = l.map(Length::from_m);
    FourBar::new(a, b, c, d).expect("a four-bar")
}

fn slide(l: [f64; 3], direction: f64) -> SliderCrank {
    let [a, b, e] = l.map(Length::from_m);
    SliderCrank::new(a, b, e, Angle::from_rad(direction)).expect("a slider-crank")
}

#[test]
fn lengths_are_given_back() {
    let b = bar([1.0, 3.0, 4.0, 5.0]);
    let got = [b.crank(), b.coupler(), b.rocker(), b.frame()].map(|l| l.m());
    assert_eq!(got, [1.0, 3.0, 4.0, 5.0]);
    let s = slide([1.0, 3.0, -0.5], 0.7);
    assert_eq!(
        [s.crank(), s.rod(), s.offset()].map(|l| l.m()),
        [1.0, 3.0, -0.5]
    );
    assert_eq!(s.direction().rad(), 0.7);
}

#[test]
fn links_at_the_speed_of_the_crank() {
    let angle = Angle::from_rad(0.3);
    let link = LinkMotion {
        angle,
        first: 0.5,
        second: -2.0,
    };
    let w = AngularVelocity::from_rad_per_s(10.0);
    assert_eq!(link.angular_velocity(w).rad_per_s(), 5.0);
    assert_eq!(link.angular_acceleration_rad_per_s2(w, 4.0), -198.0);
}

#[test]
fn points_that_are_no_numbers() {
    let rest = PointMotion::fixed([0.0, 0.0]);
    let there = PointMotion::fixed([2.0, 1.0]);
    let m = Length::from_m;
    let rrr = RrrDyad::new(m(2.0), m(3.0), Assembly::Positive).expect("a dyad");
    let rrp = RrpDyad::new(m(3.0), Assembly::Positive).expect("a dyad");
    let guide = Guide {
        origin_m: [0.0, 1.0],
        direction: Angle::from_rad(0.2),
    };
    assert!(rrr.solve(&rest, &there).is_ok() && rrp.solve(&rest, &guide).is_ok());
    for bad in [f64::NAN, f64::INFINITY] {
        for k in 0..6 {
            let mut p = there;
            [&mut p.position_m, &mut p.first_m, &mut p.second_m][k / 2][k % 2] = bad;
            let refused = |e: Result<(), DyadError>| matches!(e, Err(DyadError::NotFinite { .. }));
            assert!(refused(rrr.solve(&rest, &p).map(|_| ())), "{k}");
            assert!(refused(rrr.solve(&p, &rest).map(|_| ())), "{k}");
            assert!(refused(rrp.solve(&p, &guide).map(|_| ())), "{k}");
        }
    }
}

/// Limits of the crank, where lengths nearly cancel: `4ad sin²(φ/2) = (b + c)² − (a − d)²`, of
/// integers without error.
#[test]
fn limits_of_the_crank_between_nearly_equal_sums() {
    let unit = 2f64.powi(-40);
    let one: i128 = 1 << 40;
    for k in 0..60i128 {
        for (a, d) in [
            (2 * one + 12_345 * k, one + 777 * k),
            (one - 99 * k, 2 * one + 13 * k),
        ] {
            // b + c a little more than |a − d|, b and c of the same size.
            let gap = (a - d).abs() + 1 + 1000 * k * k;
            let b = gap / 3 + 5 * k;
            let c = gap - b;
            let l = [a, b, c, d].map(|x| x as f64 * unit);
            let [la, lb, lc, ld] = l.map(Length::from_m);
            let Ok(bar) = FourBar::new(la, lb, lc, ld) else {
                continue;
            };
            let limit = match bar.crank_range() {
                CrankRange::Within { limit } => limit,
                CrankRange::Between { upper, .. } => upper,
                other => panic!("{other:?}"),
            };
            let product = (b + c - a + d) * (b + c + a - d);
            let due = product as f64 / (4.0 * a as f64 * d as f64);
            let got = (0.5 * limit.rad()).sin().powi(2);
            assert!((got / due - 1.0).abs() < 2e-15, "{k}: {got} {due}");
        }
    }
}
